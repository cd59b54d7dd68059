//! `gpc bench`.

mod args;
mod choices;
mod columns;
mod front;
mod gallery;
mod growth;
mod machine;
mod measure;
mod measurement;
mod motion;
mod pareto;
mod pictures;
mod progress;
mod quality;
mod report;
mod results;
mod split;
mod stress;
mod subject;
mod summary;
mod variants;

pub use args::BenchArgs;
pub use measurement::Spread;

use super::{exit, input};
use anyhow::Context;
use columns::Study;
use gpc::output;
use gpc::render::{Headless, HeadlessOptions, MethodKind};
use measurement::stress::Check;
use measurement::{Cache, Growth};
use progress::Progress;
use results::Results;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use subject::Bench;

/// Every method, in the order of tables.
const METHODS: [MethodKind; 6] = [
    MethodKind::None,
    MethodKind::Msaa,
    MethodKind::Ssaa,
    MethodKind::Accumulate,
    MethodKind::Rotated,
    MethodKind::Superpixel,
];

pub fn run(args: &BenchArgs) -> anyhow::Result<ExitCode> {
    let mut files = args.scenes.iter().chain(&args.motion);
    if files.any(|path| input::is_standard(path)) {
        exit::usage!("a benchmark reads its scenes from files, not from standard input");
    }
    let Some(cache) = args.cache.clone().or_else(Cache::default_folder) else {
        exit::usage!("there is no home folder to keep references in; name a folder with --cache");
    };
    std::fs::create_dir_all(&args.out).with_context(|| format!("{}: the folder can't be made", args.out.display()))?;
    let scenes = args.scenes.iter().map(PathBuf::as_path);
    let moved = args.motion.iter().map(PathBuf::as_path);
    let timed = scenes.clone().filter(|_| args.variants);
    let chosen = scenes.clone().filter(|_| args.choices);
    let curves = Growth::ALL.into_iter().filter(|_| args.growth);
    let checks = Check::ALL.into_iter().filter(|_| args.stress);
    let scene_parts = [scenes.len(), moved.len(), timed.clone().count(), chosen.clone().count()];
    let parts = scene_parts.iter().sum::<usize>() + curves.clone().count() + checks.clone().count();
    let mut bench = Bench {
        headless: Headless::new(&HeadlessOptions::default().device(args.device.clone()))?,
        cache: Cache::new(&cache),
        args,
        progress: Progress::new(parts),
    };
    let mut results = Results::new(args, bench.headless.gpu().limits());
    each(&mut bench, &mut results, scenes, Bench::measure, |results| &mut results.scenes)?;
    each(&mut bench, &mut results, moved, Bench::motion, |results| &mut results.motion)?;
    each(&mut bench, &mut results, timed, Bench::variants, |results| &mut results.variants)?;
    each(&mut bench, &mut results, chosen, Bench::choices, |results| &mut results.choices)?;
    each(&mut bench, &mut results, curves, Bench::grow, |results| &mut results.growth)?;
    each(&mut bench, &mut results, checks, Bench::stress, |results| &mut results.stress)?;
    bench.progress.finish();
    results.summary.iter().try_for_each(columns::print)?;
    results.motion_summary.iter().try_for_each(columns::print)?;
    Ok(ExitCode::SUCCESS)
}

/// Makes a study of each subject, and adds it to `studies`. Files are written after each study, so that a failure loses no
/// results.
fn each<'a, T, S: Study>(
    bench: &mut Bench<'a>,
    results: &mut Results,
    subjects: impl Iterator<Item = T>,
    study: impl Fn(&mut Bench<'a>, T) -> anyhow::Result<S>,
    studies: fn(&mut Results) -> &mut Vec<S>,
) -> anyhow::Result<()> {
    for subject in subjects {
        let study = study(bench, subject)?;
        bench.progress.suspend(|| columns::print(&study))?;
        studies(results).push(study);
        results.summarize();
        write(&bench.args.out, results)?;
    }
    Ok(())
}

fn write(folder: &Path, results: &Results) -> anyhow::Result<()> {
    let json = serde_json::to_string(results)? + "\n";
    let files = [("results.json", json), ("report.html", report::page(results))];
    let tables = [
        columns::csv(&results.scenes, results),
        columns::csv(&results.summary, results),
        columns::csv(&results.motion, results),
        columns::csv(results.motion_summary.as_slice(), results),
        columns::csv(&results.variants, results),
        columns::csv(&results.choices, results),
        columns::csv(&results.growth, results),
        columns::csv(&results.stress, results),
    ];
    for (name, text) in files.into_iter().chain(tables.into_iter().flatten()) {
        output::write_atomically(&folder.join(name), text.as_bytes())?;
    }
    Ok(())
}
