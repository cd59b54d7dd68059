//! The passes of a frame: one file for each, with the name of its shader in `shaders/`. Passes that only the renderer needs are in
//! `src/render/passes`. The scalar twin of a pass, if it has one, has the same name in `twins/src`.
//!
//! `docs/architecture.md` has drawings of the order of passes, made from what the library records.
//! Some passes run only in some frames:
//!
//! - `prefilter` runs once for a scene with an environment, before the scene's first frame.
//! - If the frame samples a list of locations, `distribute` replaces the passes from `raster` to `detect`, and `crossings` replaces
//!   `thin`. `groups` runs after `enlist`, and `points` may replace `resolve`.
//! - If lights may be hidden, `receivers` runs before `shade` and finds the places that lights may reach. `occlude` looks them up in the
//!   lists of a light's plane. `merge` then merges samples of a triangle that the same lights reach.
//!
//! The file of a pass declares it as a [`Pass`](super::pipelines::Pass), or has a type and says why it can't be declared.
//! A pass reads the results of the passes before it from device memory, which is in [`super::data`].

pub(crate) mod adopt;
pub(crate) mod alpha_map;
pub(crate) mod arguments;
pub(crate) mod bin;
mod centres;
pub(crate) mod composite;
pub(crate) mod coordinates;
pub(crate) mod cull;
pub(crate) mod detect;
mod distribute;
mod enlist;
mod filter;
pub(crate) mod groups;
pub(crate) mod grow;
pub(crate) mod indirect;
mod patch;
pub(crate) mod pixel_filter;
pub(crate) mod points;
mod raster;
pub(crate) mod refine;
pub(crate) mod resolve;
pub(crate) mod sample;
mod sample_lines;
mod scatter;
pub(crate) mod schedule;
pub(crate) mod setup;
pub(crate) mod sort;
pub(crate) mod take;
pub(crate) mod tally;
pub(crate) mod thin;
pub(crate) mod transform;

pub(crate) use centres::Centres;
pub use distribute::{Distribute, ListRegion};
pub(crate) use patch::{Patch, Patched};
pub use raster::{Raster, RasterTargets};
pub(crate) use raster::{RasterPush, RasterRun};
pub use sample::{FragmentRate, LongLists, SampleBlocks, SampleOptions, TileList};

#[cfg(test)]
mod tests {
    use crate::engine::spirv::INTERFACES;
    use crate::vulkan::Access;
    use std::collections::BTreeSet;
    use std::path::Path;

    #[test]
    fn passes_have_the_names_of_their_shaders() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR"));
        let passes = ["src/engine/passes", "src/render/passes"].map(|folder| root.join(folder));
        for shader in std::fs::read_dir(root.join("shaders")).unwrap() {
            let shader = shader.unwrap().path();
            if shader.is_dir() {
                continue;
            }
            let name = shader.with_extension("rs");
            let name = name.file_name().unwrap();
            let files = passes.iter().filter(|folder| folder.join(name).is_file());
            assert_eq!(files.count(), 1, "{}", shader.display());
        }
    }

    /// What the comment at the head of a shader says that it accesses, from `begin` to `end`.
    fn named<'a>(head: &'a str, begin: &str, end: &str) -> &'a str {
        let from = head.find(begin).map_or(head.len(), |at| at + begin.len());
        let rest = &head[from..];
        &rest[..rest.find(end).unwrap_or(rest.len())]
    }

    #[test]
    fn shaders_access_what_their_comments_say() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders");
        let in_frame = INTERFACES.iter().filter(|shader| shader.in_frame);
        let of_frame = in_frame.flat_map(|shader| shader.uses).filter(|used| used.set < 2);
        let names = of_frame.map(|used| used.binding.name.trim_end_matches("_out"));
        let bindings: BTreeSet<_> = names.collect();
        let mut compared = 0;
        let mut wrong = Vec::new();
        for shader in INTERFACES {
            let Ok(text) = std::fs::read_to_string(folder.join(format!("{}.comp", shader.name))) else {
                continue;
            };
            let head: Vec<_> = text.lines().take_while(|line| line.starts_with("//")).collect();
            let head = head.join(" ");
            let claims =
                [(Access::Read, named(&head, "Reads:", "Writes:")), (Access::Write, named(&head, "Writes:", ". "))];
            for (access, claim) in claims {
                let accessed = shader.data(access);
                // Names of files and other passes are quoted.
                let words = claim.split('`').step_by(2);
                let words = words.flat_map(|text| text.split(|c: char| !(c.is_alphanumeric() || c == '_')));
                for word in words.filter(|word| bindings.contains(word)) {
                    if !accessed.contains(&word) {
                        wrong.push(format!("{}: {access:?} {word}", shader.name));
                    }
                    compared += 1;
                }
            }
        }
        assert_eq!(wrong, [""; 0]);
        assert!(compared > 80, "{compared}");
    }
}
