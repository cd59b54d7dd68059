//! The workflow that `docs/ci.md` recommends; its steps are run one by one.

use crate::command::{asset, files};
use std::path::Path;
use std::process::{Command, Output, Stdio};
use yaml_rust2::{Yaml, YamlLoader};

const WORKFLOW: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/ci/golden-images.yml");

/// Steps that install packages; all other steps are run.
const INSTALLS: [&str; 2] = ["Install the driver", "Install gpc"];

/// The workflow's only job.
fn job() -> Yaml {
    let text = std::fs::read_to_string(WORKFLOW).unwrap();
    let mut documents = YamlLoader::load_from_str(&text).unwrap();
    documents.remove(0)["jobs"]["images"].clone()
}

/// Runs the script of a step in a folder as the forge does, with the built command in PATH.
fn run(job: &Yaml, step: &str, folder: &Path) -> Output {
    let steps = job["steps"].as_vec().unwrap();
    let found = steps.iter().find(|found| found["name"].as_str() == Some(step));
    let found = found.unwrap_or_else(|| panic!("no step \"{step}\""));
    let programs = Path::new(env!("CARGO_BIN_EXE_gpc")).parent().unwrap();
    let path = format!("{}:{}", programs.display(), std::env::var("PATH").unwrap());
    let mut command = Command::new("bash");
    command
        .args(["-e", "-o", "pipefail", "-c", found["run"].as_str().unwrap()])
        .current_dir(folder)
        .env("PATH", path)
        .env_remove("RUST_LOG")
        .stdin(Stdio::null());
    for (name, value) in job["env"].as_hash().unwrap() {
        // The variable would change the kernels in the driver's cache, which all tests share.
        if name.as_str() != Some("LP_NATIVE_VECTOR_WIDTH") {
            command.env(name.as_str().unwrap(), value.as_str().unwrap());
        }
    }
    command.output().unwrap()
}

#[track_caller]
fn exits(output: &Output, code: i32) {
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    let (out, err) = (text(&output.stdout), text(&output.stderr));
    assert_eq!(output.status.code(), Some(code), "{out}{err}");
}

#[test]
fn every_step_is_run_here_or_installs_packages() {
    let job = job();
    let steps = job["steps"].as_vec().unwrap();
    let scripts = steps.iter().filter(|step| !step["run"].is_badvalue());
    let names: Vec<_> = scripts.map(|step| step["name"].as_str().unwrap()).collect();
    assert_eq!(names, [INSTALLS[0], INSTALLS[1], "Name the device", "Render", "Compare"]);
    for step in INSTALLS {
        let found = steps.iter().find(|found| found["name"].as_str() == Some(step));
        let script = found.unwrap()["run"].as_str().unwrap();
        assert!(script.lines().all(|line| line.starts_with("apt-get ")), "{script}");
    }
}

#[test]
fn the_steps_accept_golden_images_and_notice_changes() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for name in ["scenes", "golden", "images"] {
        std::fs::create_dir(folder.join(name)).unwrap();
    }
    std::fs::copy(asset("letters.glb"), folder.join("scenes/letters.glb")).unwrap();
    let job = job();
    exits(&run(&job, "Name the device", folder), 0);
    exits(&run(&job, "Render", folder), 0);
    assert_eq!(files(&folder.join("images")), ["letters.png"]);

    // No golden image exists yet.
    exits(&run(&job, "Compare", folder), 5);
    // As the page says, copying an image accepts it.
    std::fs::copy(folder.join("images/letters.png"), folder.join("golden/letters.png")).unwrap();
    exits(&run(&job, "Compare", folder), 0);

    // One pixel is inverted.
    let mut image = image::open(folder.join("images/letters.png")).unwrap().to_rgb8();
    let pixel = image.get_pixel_mut(11, 7);
    pixel.0 = pixel.0.map(|code| if code > 127 { 0 } else { 255 });
    image.save(folder.join("images/letters.png")).unwrap();
    exits(&run(&job, "Compare", folder), 5);
    assert_eq!(files(&folder.join("differences")), ["letters.png"]);
    let report = std::fs::read_to_string(folder.join("golden-images.xml")).unwrap();
    assert!(report.contains("failures=\"1\""), "{report}");
}
