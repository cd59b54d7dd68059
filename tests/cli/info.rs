//! `gpc info` and `gpc devices`.

use crate::command::{asset, command, files, finish, gpc};
use std::io::Write;
use std::process::Stdio;

#[test]
fn info_counts_what_the_scene_holds() {
    let folder = tempfile::tempdir().unwrap();
    let json = gpc(folder.path(), &["info", &asset("glass.glb"), "--json"]).ok().json();
    assert_eq!(json["version"], "2.0");
    assert_eq!(json["materials"]["blend"], 5);
    assert_eq!(json["cameras"][0]["name"], "front");
    assert_eq!(json["cameras"][1]["kind"], "perspective");
    assert_eq!(json["warnings"], serde_json::json!([]));
    assert!(json["triangles"].as_u64().unwrap() > 4_000);
    let text = gpc(folder.path(), &["info", &asset("glass.glb")]).ok().stdout;
    assert!(String::from_utf8(text).unwrap().contains("0 front (perspective)"));
    assert!(files(folder.path()).is_empty());
}

#[test]
fn a_scene_may_come_from_standard_input() {
    let folder = tempfile::tempdir().unwrap();
    let mut child = command(folder.path(), &["info", "-", "--json"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let bytes = std::fs::read(asset("foliage.glb")).unwrap();
    child.stdin.take().unwrap().write_all(&bytes).unwrap();
    let run = finish(child.wait_with_output().unwrap()).ok();
    assert_eq!(run.json()["materials"]["mask"], 2);
}

#[test]
fn devices_say_what_they_lack() {
    let folder = tempfile::tempdir().unwrap();
    let json = gpc(folder.path(), &["devices", "--json"]).ok().json();
    let devices = json["devices"].as_array().unwrap();
    assert!(devices.iter().any(|device| device["missing"] == serde_json::json!([])));
    for key in ["name", "kind", "driver", "api"] {
        assert!(devices.iter().all(|device| device[key].is_string()), "{key}");
    }
}

#[test]
fn without_a_driver_the_exit_code_is_3_with_advice() {
    let folder = tempfile::tempdir().unwrap();
    let scene = asset("glass.glb");
    for arguments in [&["devices"][..], &["render", &scene, "-o", "a.png"]] {
        let output = command(folder.path(), arguments)
            .env("VK_DRIVER_FILES", "/nonexistent.json")
            .env("VK_ICD_FILENAMES", "/nonexistent.json")
            .env_remove("VK_ADD_DRIVER_FILES")
            .output()
            .unwrap();
        finish(output).exits(3).says(&["mesa-vulkan-drivers"]);
    }
    assert!(files(folder.path()).is_empty());
}

#[test]
fn a_variant_that_is_not_there_is_wrong_usage() {
    let folder = tempfile::tempdir().unwrap();
    let scene = asset("glass.glb");
    let run = gpc(folder.path(), &["render", &scene, "-o", "a.png", "--variant", "night"]);
    assert_eq!(run.code, Some(2));
    let expected = "there is no variant \"night\"; the file has none";
    assert!(run.stderr.contains(expected), "{}", run.stderr);
    assert!(files(folder.path()).is_empty());
}

#[test]
fn other_formats_say_what_they_are() {
    let folder = tempfile::tempdir().unwrap();
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    std::fs::write(folder.path().join("a.bin"), text).unwrap();
    let json = gpc(folder.path(), &["info", "a.bin", "--json"]).ok().json();
    assert_eq!(json["format"], "OBJ");
    assert_eq!(json["triangles"], 1);
    let said = gpc(folder.path(), &["info", "a.bin"]).ok().stdout;
    assert!(said.starts_with(b"OBJ\n"), "{}", String::from_utf8_lossy(&said));
}

/// What a file has and is not drawn is named once, on standard error and in the JSON object.
#[test]
fn info_names_what_is_left_out() {
    let folder = tempfile::tempdir().unwrap();
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nbevel on\nlod 5\nlod 6\n";
    std::fs::write(folder.path().join("a.obj"), obj).unwrap();
    let expected = "a.obj: left out: OBJ statements (3: bevel, lod)";
    let said = gpc(folder.path(), &["info", "a.obj"]).ok().stderr;
    assert!(said.contains(expected), "{said}");
    let json = gpc(folder.path(), &["info", "a.obj", "--json"]).ok().json();
    assert_eq!(json["warnings"], serde_json::json!([expected]));
}
