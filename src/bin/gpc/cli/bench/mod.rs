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

use super::{exit, input};
use anyhow::Context;
use gpc::output;
use gpc::render::{Headless, HeadlessOptions, MethodKind};
use measurement::stress::Check;
use measurement::{Cache, Growth};
use progress::Progress;
use results::Results;
use std::path::Path;
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
    let curves = if args.growth { Growth::ALL.len() } else { 0 };
    let checks = if args.stress { Check::ALL.len() } else { 0 };
    let timed = if args.variants { args.scenes.len() } else { 0 };
    let chosen = if args.choices { args.scenes.len() } else { 0 };
    let moved = args.motion.len();
    let parts = args.scenes.len() + moved + timed + chosen + curves + checks;
    let mut bench = Bench {
        headless: Headless::new(&HeadlessOptions::default().device(args.device.clone()))?,
        cache: Cache::new(&cache),
        args,
        progress: Progress::new(parts),
    };
    let mut results = Results::new(args, bench.headless.gpu().limits());
    let mut galleries = Vec::new();
    for path in &args.scenes {
        let (scene, gallery) = bench.measure(path)?;
        bench.progress.suspend(|| columns::print(&scene))?;
        results.scenes.push(scene);
        galleries.push(gallery);
        // Files are written after each scene, so that a failure loses no results.
        results.summary = summary::summarize(&results.scenes);
        write(&args.out, &results, &galleries)?;
    }
    for path in &args.motion {
        let scene = bench.motion(path, args.motion_size)?;
        bench.progress.suspend(|| columns::print(&scene))?;
        results.motion.push(scene);
        results.motion_summary = Some(motion::summarize(&results.motion));
        write(&args.out, &results, &galleries)?;
    }
    if args.variants {
        for path in &args.scenes {
            let scene = bench.variants(path)?;
            bench.progress.suspend(|| columns::print(&scene))?;
            results.variants.push(scene);
            write(&args.out, &results, &galleries)?;
        }
    }
    if args.choices {
        for path in &args.scenes {
            let scene = bench.choices(path)?;
            bench.progress.suspend(|| columns::print(&scene))?;
            results.choices.push(scene);
            write(&args.out, &results, &galleries)?;
        }
    }
    if args.growth {
        for growth in Growth::ALL {
            let curve = bench.grow(growth)?;
            bench.progress.suspend(|| columns::print(&curve))?;
            results.growth.push(curve);
            write(&args.out, &results, &galleries)?;
        }
    }
    if args.stress {
        for check in Check::ALL {
            let stress = bench.stress(check)?;
            bench.progress.suspend(|| columns::print(&stress))?;
            results.stress.push(stress);
            write(&args.out, &results, &galleries)?;
        }
    }
    bench.progress.finish();
    results.summary.iter().try_for_each(columns::print)?;
    results.motion_summary.iter().try_for_each(columns::print)?;
    Ok(ExitCode::SUCCESS)
}

fn write(folder: &Path, results: &Results, galleries: &[gallery::Gallery]) -> anyhow::Result<()> {
    let json = serde_json::to_string(results)? + "\n";
    let files = [("results.json", json), ("report.html", report::page(results, galleries))];
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
