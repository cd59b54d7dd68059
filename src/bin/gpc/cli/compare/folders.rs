//! `gpc compare` of two folders of images.

use super::{CompareArgs, junit};
use crate::cli::{exit, print};
use anyhow::Context;
use clap::ValueEnum;
use gpc::compare::{self, Comparison};
use gpc::names::name;
use gpc::output;
use serde::Serialize;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Result of comparing an image.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Status {
    /// Difference within the bound.
    Equal,
    /// Difference above the bound, or no comparison possible.
    Different,
    /// Image in the reference's folder only.
    Missing,
    /// Image in the other folder only.
    New,
}

/// An image of either folder, and its result.
#[derive(Serialize)]
pub struct ComparedImage {
    /// Its path below the folder, with `/` between folders.
    pub name: String,
    pub status: Status,
    #[serde(flatten)]
    pub comparison: Option<Comparison>,
    /// Reason why the image is not equal.
    pub reason: Option<String>,
}

impl ComparedImage {
    fn new(name: &str, status: Status, comparison: Option<Comparison>, reason: Option<String>) -> Self {
        Self { name: name.to_owned(), status, comparison, reason }
    }
}

/// Output of `--json`.
#[derive(Serialize)]
struct ComparisonReport<'a> {
    equal: usize,
    different: usize,
    missing: usize,
    new: usize,
    images: &'a [ComparedImage],
}

pub fn run(args: &CompareArgs) -> anyhow::Result<ExitCode> {
    let bound = args.max_rmse.unwrap_or(0.0);
    let [expected, found] = [names(&args.a)?, names(&args.b)?];
    if expected.is_empty() && found.is_empty() {
        anyhow::bail!("neither {} nor {} has a .png, .jpg, .jpeg or .exr file", args.a.display(), args.b.display());
    }
    let absent_from = |folder: &Path| Some(format!("it is not in {}", folder.display()));
    let mut images = Vec::new();
    for name in expected.union(&found) {
        images.push(match (expected.contains(name), found.contains(name)) {
            (true, false) => ComparedImage::new(name, Status::Missing, None, absent_from(&args.b)),
            (false, _) => ComparedImage::new(name, Status::New, None, absent_from(&args.a)),
            (true, true) => compared(args, name, bound)?,
        });
    }
    if let Some(path) = &args.junit {
        let suite = args.a.display().to_string();
        output::write_atomically(path, junit::report(&suite, &images)?.as_bytes())?;
    }
    let count = |status| images.iter().filter(|image| image.status == status).count();
    let [equal, different, missing, new] = [Status::Equal, Status::Different, Status::Missing, Status::New].map(count);
    if args.json {
        print::json(&ComparisonReport { equal, different, missing, new, images: &images })?;
    } else {
        for image in &images {
            print::line(&line(image))?;
        }
        print::line(&format!("{equal} equal, {different} different, {missing} missing, {new} new"))?;
    }
    if equal == images.len() {
        return Ok(ExitCode::SUCCESS);
    }
    log::error!("{} of {} images are not equal within an rmse of {bound}", images.len() - equal, images.len());
    Ok(ExitCode::from(exit::OVER_BOUND))
}

/// The images below a folder, as paths relative to it.
fn names(folder: &Path) -> anyhow::Result<BTreeSet<String>> {
    let mut names = BTreeSet::new();
    let mut others = 0;
    let mut waiting = vec![(folder.to_owned(), String::new())];
    while let Some((folder, prefix)) = waiting.pop() {
        let unreadable = || format!("{}: the folder can't be read", folder.display());
        for entry in std::fs::read_dir(&folder).with_context(unreadable)? {
            let entry = entry.with_context(unreadable)?;
            let path = entry.path();
            let Ok(name) = entry.file_name().into_string() else {
                anyhow::bail!("{}: the name is not UTF-8", path.display());
            };
            let name = format!("{prefix}{name}");
            if path.is_dir() {
                waiting.push((path, name + "/"));
            } else if is_image(&path) {
                names.insert(name);
            } else {
                others += 1;
            }
        }
    }
    if others > 0 {
        log::info!("{}: {others} files are no images", folder.display());
    }
    Ok(names)
}

fn is_image(path: &Path) -> bool {
    let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase());
    extension.is_some_and(|e| ["png", "jpg", "jpeg", "exr"].contains(&e.as_str()))
}

/// Compares the two images with this name, and writes the error map if they differ.
fn compared(args: &CompareArgs, name: &str, bound: f64) -> anyhow::Result<ComparedImage> {
    let compare = || -> anyhow::Result<_> {
        let (a, b) = (output::read(&args.a.join(name))?, output::read(&args.b.join(name))?);
        let comparison = compare::compare(&a, &b)?;
        Ok((a, b, comparison))
    };
    let (a, b, comparison) = match compare() {
        Ok(compared) => compared,
        Err(error) => return Ok(ComparedImage::new(name, Status::Different, None, Some(error.to_string()))),
    };
    if comparison.rmse <= bound {
        return Ok(ComparedImage::new(name, Status::Equal, Some(comparison), None));
    }
    if let Some(folder) = &args.heatmap {
        let path = difference_path(folder, name);
        if let Some(parent) = path.parent() {
            std::fs::create_dir_all(parent)
                .with_context(|| format!("{}: the folder can't be made", parent.display()))?;
        }
        let pixels = compare::heatmap(&a, &b)?;
        output::write_atomically(&path, &output::encode_rgb(a.size, &pixels)?)?;
    }
    let reason = format!("its rmse is {:.6}, above {bound}", comparison.rmse);
    Ok(ComparedImage::new(name, Status::Different, Some(comparison), Some(reason)))
}

/// Path of the error map of an image: the image's name in `folder`, with `.png` appended unless it ends so already.
fn difference_path(folder: &Path, name: &str) -> PathBuf {
    if name.to_lowercase().ends_with(".png") { folder.join(name) } else { folder.join(format!("{name}.png")) }
}

fn line(image: &ComparedImage) -> String {
    let status = name(&image.status);
    match &image.reason {
        Some(reason) => format!("{status:<9}  {}: {reason}", image.name),
        None => format!("{status:<9}  {}", image.name),
    }
}
