//! Drawings of what passes hand to each other, made from the passes that the library records.

use crate::data::root;
use gpc::camera::set::SamplingSet;
use gpc::camera::{Camera, Orbit, Pinhole};
use gpc::render::{
    CellOptions, FramePass, Headless, HeadlessOptions, PreparedScene, SceneRequest, SceneSettings, Settings, Shadows,
    SuperpixelOptions,
};
use gpc::scene::{PoseRequest, Scene};
use std::collections::BTreeSet;

/// Size of the images whose passes are drawn, in pixels.
const SIZE: [u32; 2] = [64, 48];

/// Data that nearly all passes share, which the drawings leave out.
const SHARED: [&str; 3] = ["frame", "counters", "arguments"];

/// Passes of a frame.
pub fn frame() -> String {
    draw(&of_frame("checker"))
}

/// Passes of a frame of the scene in the file `asset`.
pub fn of_frame(asset: &str) -> Vec<FramePass> {
    let (mut headless, scene, camera) = stage(asset, Shadows::None);
    let settings = Settings::new(SIZE[0], SIZE[1]).method(SuperpixelOptions::new(64));
    let mut frame = headless.prepare(&scene, &settings).unwrap();
    // The first rendering finds how much memory the frame needs.
    headless.render(&mut frame, &camera).unwrap();
    headless.passes(&mut frame, &camera).unwrap().passes
}

/// Passes of a list of locations that are sampled as superpixels.
pub fn list() -> String {
    let (mut headless, scene, camera) = stage("letters", Shadows::None);
    let pinhole = Pinhole::from_camera(&camera, SIZE).unwrap();
    let locations = SamplingSet::planar(SIZE).unwrap().locations();
    let (cells, settings) = (CellOptions::new(64), SceneSettings::default());
    let (sampled, recorded) =
        headless.passes_of(|headless| headless.sample_superpixels(&scene, &pinhole, &locations, &cells, &settings));
    sampled.unwrap();
    draw(&recorded.passes)
}

/// Passes by which an image of locations finds what aliases: among its cells, and beside its superpixels.
pub fn image() -> String {
    let (mut headless, scene, camera) = stage("letters", Shadows::None);
    let pinhole = Pinhole::from_camera(&camera, SIZE).unwrap();
    let rig = [(pinhole, SamplingSet::planar(SIZE).unwrap().locations())];
    let settings = Settings::new(SIZE[0], SIZE[1]);
    let (rendered, recorded) = headless.passes_of(|headless| headless.render_locations(&scene, &rig, &settings));
    rendered.unwrap();
    let passes = recorded.passes;
    let place = |name: &str| passes.iter().position(|pass| pass.name == name).unwrap();
    let found = place("crossings");
    let before = passes[..found].iter().rposition(|pass| pass.name == "distribute");
    let looks = &passes[before.unwrap()..=place("detect")];
    let grows = &passes[place("neighbours")..=place("grow")];
    draw(&[looks, grows].concat())
}

/// Passes by which a frame lists the casters of one light, and finds its shadows on the pixels' centres.
pub fn shadows() -> String {
    let (mut headless, scene, camera) = stage("fence", Shadows::Exact);
    let settings = Settings::new(SIZE[0], SIZE[1]).shadows(Shadows::Exact);
    let mut frame = headless.prepare(&scene, &settings).unwrap();
    // The first rendering finds how much memory the frame needs.
    headless.render(&mut frame, &camera).unwrap();
    let passes = headless.passes(&mut frame, &camera).unwrap().passes;
    let place = |name: &str| passes.iter().position(|pass| pass.name == name).unwrap();
    let lists = &passes[place("cull")..=place("refine")];
    let looks = &passes[place("receivers")..=place("occlude")];
    draw(&[lists, looks].concat())
}

/// Source files in which comments say what a pass reads from earlier passes of a frame, and what it writes.
pub const SOURCES: [&str; 2] = ["src/render/frame/recording.rs", "src/engine/sampler/mod.rs"];

/// Text of a source file. Its comments `// NAME: READS ─▶ WRITES` are written again from what the library records.
pub fn annotated(text: &str) -> String {
    const ARROW: &str = "─▶";
    let drawn = [frame(), shadows()].concat();
    let flow_of = |name: &str| {
        let of_pass = |line: &&str| line.contains(ARROW) && line.split_whitespace().next() == Some(name);
        let line = drawn.lines().find(of_pass).unwrap_or_else(|| panic!("no frame has the pass \"{name}\""));
        line.strip_prefix(name).unwrap().trim().to_owned()
    };
    let line = |line: &str| {
        let comment = line.trim_start().strip_prefix("// ").filter(|comment| comment.contains(ARROW));
        match comment.and_then(|comment| comment.split_once(':')) {
            Some((name, _)) => {
                format!("{}// {name}: {}\n", &line[..line.len() - line.trim_start().len()], flow_of(name))
            }
            None => format!("{line}\n"),
        }
    };
    text.lines().map(line).collect()
}

fn stage(asset: &str, shadows: Shadows) -> (Headless, PreparedScene, Camera) {
    let scene = Scene::load(&root().join(format!("assets/{asset}.glb"))).unwrap().scene;
    let pose = scene.pose(&PoseRequest::default()).unwrap();
    let camera = match &pose.cameras[..] {
        [camera, ..] => Camera::from_scene(camera),
        [] => {
            let (low, high) = pose.geometry.bounds().unwrap();
            Orbit::default().frame(low, high, 1.0).unwrap()
        }
    };
    let mut headless = Headless::new(&HeadlessOptions::default()).unwrap();
    let request = SceneRequest::new(&scene, &pose).shadowed(shadows);
    let prepared = headless.upload(request).unwrap();
    (headless, prepared, camera)
}

/// A line for each pass: the data that it reads and an earlier pass wrote, and the data that it writes. If passes at the end
/// repeat earlier ones, only the first and the last of them are named.
fn draw(passes: &[FramePass]) -> String {
    let is_again = |from: usize| {
        let known: BTreeSet<_> = passes[..from].iter().map(|pass| pass.name).collect();
        passes[from..].iter().all(|pass| known.contains(pass.name))
    };
    let end = (1..passes.len()).find(|from| is_again(*from)).unwrap_or(passes.len());
    let mut text = "```text\n".to_owned();
    let mut written = BTreeSet::new();
    let mut last: Option<&str> = None;
    for pass in &passes[..end] {
        let shown = |data: &&&str| !SHARED.contains(*data);
        let reads = pass.reads.iter().filter(shown);
        let reads: Vec<&str> = reads.filter(|data| written.contains(**data)).copied().collect();
        let writes: Vec<&str> = pass.writes.iter().filter(shown).copied().collect();
        written.extend(writes.iter().copied());
        // A pass that runs twice in a row counts once. `arguments`, which only computes sizes of dispatches, is left out.
        if pass.name != "arguments" && last.replace(pass.name) != Some(pass.name) {
            let name = pass.name.trim_end_matches("_fragment");
            let line = format!("{name:12} {} ─▶ {}", reads.join(", "), writes.join(", "));
            text += &format!("{}\n", line.trim_end());
        }
    }
    let again: Vec<_> = passes[end..].iter().map(|pass| pass.name).filter(|name| *name != "arguments").collect();
    if let [first, .., last] = again[..] {
        text += &format!("again        {first} to {last}\n");
    }
    text + "```"
}
