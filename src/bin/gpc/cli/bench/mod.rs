//! `gpc bench`.

mod args;
mod choices;
mod csv;
mod front;
mod gallery;
mod growth;
mod html;
mod machine;
mod measure;
mod motion;
mod pictures;
mod progress;
mod results;
mod split;
mod stress;
mod subject;
mod summary;
mod table;
mod variants;

pub use args::BenchArgs;

use super::{exit, input};
use anyhow::Context;
use gpc::bench::stress::Check;
use gpc::bench::{Cache, Growth};
use gpc::output;
use gpc::render::{Headless, HeadlessOptions, MethodKind};
use progress::Progress;
use results::Results;
use std::path::Path;
use std::process::ExitCode;
use subject::Bench;

/// Every method, in the order of tables.
const METHODS: [MethodKind; 4] = [MethodKind::None, MethodKind::Msaa, MethodKind::Ssaa, MethodKind::Superpixel];

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
        bench.progress.suspend(|| table::print(&scene))?;
        results.scenes.push(scene);
        galleries.push(gallery);
        // Files are written after each scene, so that a failure loses no results.
        results.summary = summary::summarize(&results.scenes);
        write(&args.out, &results, &galleries)?;
    }
    for path in &args.motion {
        let scene = bench.motion(path, args.motion_size)?;
        bench.progress.suspend(|| motion::print(&scene))?;
        results.motion.push(scene);
        results.motion_summary = motion::summarize(&results.motion);
        write(&args.out, &results, &galleries)?;
    }
    if args.variants {
        for path in &args.scenes {
            let scene = bench.variants(path)?;
            bench.progress.suspend(|| variants::print(&scene))?;
            results.variants.push(scene);
            write(&args.out, &results, &galleries)?;
        }
    }
    if args.choices {
        for path in &args.scenes {
            let scene = bench.choices(path)?;
            bench.progress.suspend(|| choices::print(&scene))?;
            results.choices.push(scene);
            write(&args.out, &results, &galleries)?;
        }
    }
    if args.growth {
        for growth in Growth::ALL {
            let curve = bench.grow(growth)?;
            bench.progress.suspend(|| growth::print(&curve))?;
            results.growth.push(curve);
            write(&args.out, &results, &galleries)?;
        }
    }
    if args.stress {
        for check in Check::ALL {
            let stress = bench.stress(check)?;
            bench.progress.suspend(|| stress::print(&stress))?;
            results.stress.push(stress);
            write(&args.out, &results, &galleries)?;
        }
    }
    bench.progress.finish();
    table::print_summary(&results.summary)?;
    motion::print_summary(&results.motion_summary)?;
    Ok(ExitCode::SUCCESS)
}

fn write(folder: &Path, results: &Results, galleries: &[gallery::Gallery]) -> anyhow::Result<()> {
    let head = results.head(results.size);
    let mut files = vec![
        ("results.json", serde_json::to_string(results)? + "\n"),
        ("results.csv", head.clone() + &table::csv(&results.scenes)),
        ("report.html", html::page(results, galleries)),
    ];
    if let Some(moved) = results.motion.first() {
        let text = results.head(moved.size) + &motion::csv(&results.motion);
        files.push(("motion.csv", text));
    }
    if !results.variants.is_empty() {
        let text = head.clone() + &variants::csv(&results.variants);
        files.push(("variants.csv", text));
    }
    if !results.choices.is_empty() {
        let text = head.clone() + &choices::csv(&results.choices);
        files.push(("choices.csv", text));
    }
    if !results.growth.is_empty() {
        files.push(("growth.csv", head + &growth::csv(&results.growth)));
    }
    for (name, text) in files {
        output::write_atomically(&folder.join(name), text.as_bytes())?;
    }
    Ok(())
}
