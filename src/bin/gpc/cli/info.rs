//! `gpc info`.

use super::{input, print, render, values};
use clap::Args;
use gpc::render::{FramePass, Headless, HeadlessOptions, RecordedPasses, Settings, Shadows, SuperpixelOptions};
use gpc::scene::{PoseRequest, Scene, SceneInfo};
use serde::Serialize;
use std::path::PathBuf;
use std::process::ExitCode;

/// Options of `gpc info`.
#[derive(Args)]
pub struct InfoArgs {
    /// A glTF, OBJ, STL or PLY file, or - for standard input
    scene: PathBuf,
    /// List the passes of a frame instead, and count its dispatches and barriers
    ///
    /// Each line has the shader, what decides the number of its workgroups, and what the shader may read and write.
    #[arg(long)]
    passes: bool,
    /// Size of the frame whose passes are listed, in pixels
    #[arg(long, value_name = "WxH", value_parser = values::size, default_value = "256x144", requires = "passes")]
    size: [u32; 2],
    /// Samples of a superpixel of the frame whose passes are listed
    #[arg(long, value_name = "N", default_value_t = 64, requires = "passes")]
    samples: u32,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct SceneReport<'a> {
    #[serde(flatten)]
    info: &'a SceneInfo,
    warnings: &'a [String],
}

pub fn run(args: &InfoArgs) -> anyhow::Result<ExitCode> {
    let loaded = input::load(&args.scene, None)?;
    for warning in &loaded.warnings {
        log::warn!("{warning}");
    }
    if args.passes {
        let passes = passes(&loaded.scene, args)?;
        if args.json {
            print::json(&passes)?;
        } else {
            print::line(&table(&passes))?;
        }
        return Ok(ExitCode::SUCCESS);
    }
    let info = loaded.scene.info();
    if args.json {
        print::json(&SceneReport { info: &info, warnings: &loaded.warnings })?;
    } else {
        print::line(&text(&info))?;
    }
    Ok(ExitCode::SUCCESS)
}

/// The passes of a frame with default settings otherwise, with shadows if the scene has lights.
fn passes(scene: &Scene, args: &InfoArgs) -> anyhow::Result<RecordedPasses> {
    let pose = scene.pose(&PoseRequest::default())?;
    let mut settings = Settings::new(args.size[0], args.size[1]).method(SuperpixelOptions::new(args.samples));
    if !pose.lights.is_empty() {
        settings.scene.shadows = Shadows::Exact;
    }
    let aspect = f64::from(args.size[0]) / f64::from(args.size[1]);
    let views = render::choose_views(&render::args::CameraArgs::default(), &pose, aspect)?;
    let Some(view) = views.first() else {
        anyhow::bail!("the scene has no camera");
    };
    let mut headless = Headless::new(&HeadlessOptions::default())?;
    let prepared = render::upload(&mut headless, scene, (&pose, None), &settings)?;
    let mut frame = headless.prepare(&prepared, &settings)?;
    // The first rendering finds how much memory the frame needs.
    headless.render(&mut frame, &view.camera)?;
    Ok(headless.passes(&mut frame, &view.camera)?)
}

/// A table with a line for each pass, and a line with the numbers of commands.
fn table(recorded: &RecordedPasses) -> String {
    let lines = recorded.passes.iter().map(|pass| {
        let FramePass { name, dispatch, .. } = pass;
        let (reads, writes) = (pass.reads.join(", "), pass.writes.join(", "));
        format!("{name:<16}{dispatch:<18}reads {reads}; writes {writes}")
    });
    let RecordedPasses { dispatches, barriers, .. } = recorded;
    let counts = format!("{dispatches} dispatches and {barriers} barriers");
    lines.chain([counts]).collect::<Vec<_>>().join("\n")
}

fn text(info: &SceneInfo) -> String {
    let name = |name: &Option<String>| name.clone().unwrap_or_else(|| "(unnamed)".to_owned());
    let list = |items: Vec<String>| {
        if items.is_empty() { "none".to_owned() } else { items.join(", ") }
    };
    let numbered = |items: Vec<String>| {
        let items = items.iter().enumerate();
        list(items.map(|(i, item)| format!("{i} {item}")).collect())
    };
    // Formats other than glTF have neither a version nor a generator.
    let origin = match (info.version.as_str(), info.generator.as_deref()) {
        ("", _) => info.format.to_owned(),
        (version, generator) => {
            let generator = generator.unwrap_or("an unnamed program");
            format!("{} {version} by {generator}", info.format)
        }
    };
    let cameras = info.cameras.iter();
    let animations = info.animations.iter();
    let images = info.images.iter();
    [
        origin,
        format!("scenes      {}", numbered(info.scenes.names.iter().map(name).collect())),
        format!(
            "geometry    {} triangles, {} lines and {} points in {} primitives, {} meshes, {} nodes",
            info.triangles, info.lines, info.points, info.primitives, info.meshes, info.nodes
        ),
        format!("variants    {}", numbered(info.variants.iter().map(|v| format!("\"{v}\"")).collect())),
        format!(
            "materials   {} opaque, {} mask, {} blend",
            info.materials.opaque, info.materials.mask, info.materials.blend
        ),
        format!("images      {}", list(images.map(|image| format!("{}x{}", image.width, image.height)).collect())),
        format!(
            "cameras     {}",
            numbered(cameras.map(|camera| format!("{} ({})", name(&camera.name), camera.kind)).collect())
        ),
        format!(
            "animations  {}",
            numbered(
                animations
                    .map(|a| format!("{} ({:.3} s: {})", name(&a.name), a.duration, a.changes.join(", ")))
                    .collect()
            )
        ),
        format!("lights      {}{}", info.lights, if info.environment { ", and light from all around" } else { "" }),
        format!("skins       {}", info.skins),
        format!("extensions  {}", list(info.extensions_used.clone())),
        format!("required    {}", list(info.extensions_required.clone())),
    ]
    .join("\n")
}
