//! Watching files for changes.

use notify::{EventKind, RecommendedWatcher, RecursiveMode, Watcher};
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

/// Extensions of files that scene files refer to. Other programs rarely write such files.
const BESIDE: [&str; 2] = ["bin", "mtl"];

/// Calls `changed` in another thread whenever a scene file, or a data file in its folder, is written or replaced, until
/// the watcher is dropped.
///
/// # Errors
/// If the system can't watch the file's folder.
pub fn watch(path: &Path, changed: impl Fn() + Send + 'static) -> notify::Result<RecommendedWatcher> {
    let folder = match path.parent() {
        Some(folder) if folder != Path::new("") => folder.to_owned(),
        _ => PathBuf::from("."),
    };
    let name = path.file_name().map(OsStr::to_owned);
    let mut watcher = notify::recommended_watcher(move |event: notify::Result<notify::Event>| {
        let Ok(event) = event else {
            return;
        };
        let is_ours = |path: &PathBuf| {
            let beside = path
                .extension()
                .is_some_and(|extension| BESIDE.iter().any(|known| extension.eq_ignore_ascii_case(known)));
            path.file_name() == name.as_deref() || beside
        };
        if matches!(event.kind, EventKind::Create(_) | EventKind::Modify(_)) && event.paths.iter().any(is_ours) {
            changed();
        }
    })?;
    // The folder is watched instead of the file, because editors replace files.
    watcher.watch(&folder, RecursiveMode::NonRecursive)?;
    Ok(watcher)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::mpsc::channel;
    use std::time::Duration;

    #[test]
    fn writing_and_replacing_is_seen_and_other_files_are_not() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.gltf");
        std::fs::write(&path, "1").unwrap();
        let (sender, changes) = channel();
        let _watcher = watch(&path, move || {
            let _ = sender.send(());
        })
        .unwrap();
        let long = Duration::from_secs(20);
        std::fs::write(&path, "2").unwrap();
        changes.recv_timeout(long).unwrap();
        let other = folder.path().join("b.tmp");
        std::fs::write(&other, "3").unwrap();
        while changes.recv_timeout(Duration::from_millis(300)).is_ok() {}
        std::fs::write(&other, "4").unwrap();
        assert!(changes.recv_timeout(Duration::from_millis(300)).is_err());
        std::fs::rename(&other, &path).unwrap();
        changes.recv_timeout(long).unwrap();
        while changes.recv_timeout(Duration::from_millis(300)).is_ok() {}
        std::fs::write(folder.path().join("a.bin"), "5").unwrap();
        changes.recv_timeout(long).unwrap();
    }
}
