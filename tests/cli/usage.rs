//! Requests that the command refuses: exit codes and messages. No test here needs a device.

use gpc::render::PassTime;

use crate::command::{asset, files, gpc};

#[test]
fn wrong_usage_exits_with_2_and_names_what_can_be_had() {
    let folder = tempfile::tempdir().unwrap();
    let letters = asset("letters.glb");
    let cases: [(&[&str], &[&str]); 37] = [
        (&[], &["Usage"]),
        (&["-o", "a.tga"], &[".png", ".16.png", ".jpg", ".jpeg", ".exr"]),
        (&["-o", "a.png", "--size", "0x7"], &["1280x720"]),
        (&["-o", "a.png", "--region", "0,0,8"], &["640,360,320x180"]),
        (&["-o", "a.png", "--size", "64x32", "--region", "60,4,5x5"], &["5 x 5", "column 60, row 4", "64 x 32"]),
        (&["-o", "a.png", "--aa", "fxaa"], &["superpixel", "ssaa", "msaa"]),
        (&["-o", "a.png", "--aa", "none", "--samples", "4"], &["none", "4", "it can have 1"]),
        (&["-o", "a.png", "--pattern", "halton"], &["sobol", "lattice", "grid"]),
        (&["-o", "a.png", "--detect", "colour"], &["contrast", "edges", "exact"]),
        (&["-o", "a.png", "--contrast", "256"], &["256"]),
        (&["-o", "a.png", "--line-width", "-1"], &["pixels above 0"]),
        (&["-o", "a.png", "--eye", "1,2"], &["X,Y,Z"]),
        (&["-o", "a.png", "--target", "1,2,3"], &["--eye"]),
        (&["-o", "a.png", "--eye", "1,2,3", "--camera", "0"], &["--camera"]),
        (&["-o", "a.png", "--eye", "1,2,3", "--target", "1,2,3"], &["must differ"]),
        (&["-o", "a.png", "--fov", "180"], &["below 180"]),
        (&["-o", "a.png", "--camera", "side"], &["reader", "front"]),
        (&["-o", "a.png", "--camera", "front", "--fov", "30"], &["orthographic"]),
        (&["-o", "a.png", "--camera", "all"], &["{camera}"]),
        (&["-o", "a.png", "--turntable", "3"], &["{frame}"]),
        (&["-o", "a.png", "--frames", "0..4"], &["{frame}"]),
        (&["-o", "-", "--turntable", "3"], &["standard output"]),
        (&["-o", "-", "--turntable", "3"], &["--format"]),
        (&["-o", "a.png", "--format", "y4m"], &["-o -"]),
        (&["-o", "{frame}.png", "--turntable", "3", "--fps", "25"], &["--fps", "--frames", "y4m"]),
        (&["-o", "{frame}.png", "--shard", "1/2"], &["--turntable"]),
        (&["-o", "{frame}.png", "--turntable", "3", "--shard", "3/2"], &["1/4"]),
        (&["-o", "a.png", "--turntable", "3", "--shard", "1/3"], &["{frame}"]),
        (&["-o", "-", "--turntable", "3", "--shard", "1/3"], &["makes no film"]),
        (&["-o", "{name}.png"], &["{stem}", "{camera}", "{frame}"]),
        (&["-o", "{stem.png"], &["{ without a }"]),
        (&["-o", "a.png", "--background", "red"], &["#rrggbb"]),
        (&["-o", "a.png", "--aov", "albedo"], &["depth", "id", "normal", "superpixels", "samples"]),
        (&["-o", "-", "--aov", "depth"], &["--aov"]),
        (&["-o", "a.exr", "--tonemap", "neutral"], &["EXR"]),
        (&["-o", "a.png", "--max-memory", "lots"], &["512M"]),
        (&["-o", "a.png", "--scene", "7"], &["no scene 7"]),
    ];
    for (options, expected) in cases {
        let arguments = [&["render", &letters], options].concat();
        gpc(folder.path(), &arguments).exits(2).says(expected);
    }
    gpc(folder.path(), &["render", &letters, "-o", "a.png", "--animation", "walk"]).exits(2).says(&["walk"]);
    gpc(folder.path(), &["rendr"]).exits(2).says(&["render"]);
    assert!(files(folder.path()).is_empty());
}

#[test]
fn a_wrong_command_line_is_told_the_right_one() {
    let folder = tempfile::tempdir().unwrap();
    let cases: [(&[&str], &str); 3] = [
        (&["a/b.GLB"], "gpc render a/b.GLB -o image.png"),
        (&["render", "a.glb", "b.png"], "-o b.png"),
        (&["view", "a.glb"], "--features view"),
    ];
    for (arguments, expected) in cases {
        gpc(folder.path(), arguments).exits(2).says(&["tip:", expected]);
    }
}

/// Text from the front page of a subcommand's help.
#[test]
fn help_says_what_files_hold() {
    let folder = tempfile::tempdir().unwrap();
    for (command, expected) in [
        ("render", "{camera}"),
        ("sample", "u,v,row,col"),
        ("project", "x,y,u,v"),
        ("compare", "missing (in A only)"),
        ("bench", "results.csv"),
    ] {
        let help = String::from_utf8(gpc(folder.path(), &[command, "--help"]).ok().stdout).unwrap();
        assert!(help.contains(expected), "{command}: {help}");
    }
}

#[test]
fn a_scene_that_is_none_exits_with_1_and_is_named() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("bad.glb"), b"glTF and then nothing").unwrap();
    for command in [&["render", "bad.glb", "-o", "a.png"][..], &["info", "bad.glb"]] {
        gpc(folder.path(), command).exits(1).says(&["bad.glb"]);
    }
    let letters = asset("letters.glb");
    gpc(folder.path(), &["render", &letters, "-o", "out/a.png"]).exits(1).says(&["-o out/a.png", "no folder out"]);
    gpc(folder.path(), &["render", "missing.glb", "-o", "a.png"]).exits(1).says(&["missing.glb", "No such file"]);
    assert_eq!(files(folder.path()), ["bad.glb"]);
}

#[test]
fn errors_are_said_once() {
    let folder = tempfile::tempdir().unwrap();
    let run = gpc(folder.path(), &["info", "missing.glb"]);
    assert_eq!(run.stderr.matches("No such file").count(), 1, "{}", run.stderr);
    assert_eq!(run.stderr.lines().count(), 1, "{}", run.stderr);
}

#[test]
fn help_lists_every_option_and_exit_code() {
    let folder = tempfile::tempdir().unwrap();
    let help = String::from_utf8(gpc(folder.path(), &["--help"]).ok().stdout).unwrap();
    assert!(help.contains("Exit codes") && help.contains("a difference above its bound"));
    let help = String::from_utf8(gpc(folder.path(), &["render", "--help"]).ok().stdout).unwrap();
    for option in [
        "output",
        "size",
        "region",
        "aa",
        "samples",
        "contrast",
        "detect",
        "pattern",
        "shading",
        "camera",
        "eye",
        "target",
        "up",
        "fov",
        "azimuth",
        "elevation",
        "zoom",
        "scene",
        "time",
        "animation",
        "background",
        "exposure",
        "tonemap",
        "aov",
        "device",
        "max-memory",
        "repeat",
        "json",
        "quiet",
        "frames",
        "fps",
        "turntable",
        "shard",
        "format",
    ] {
        assert!(help.contains(&format!("--{option}")), "--{option}");
    }
}

#[test]
fn no_arguments_show_three_examples() {
    let folder = tempfile::tempdir().unwrap();
    let run = gpc(folder.path(), &[]).exits(2).says(&["Examples:", "Commands:"]);
    let examples = run.stderr.lines().filter(|line| line.starts_with("  gpc "));
    assert_eq!(examples.count(), 3, "{}", run.stderr);
}

#[test]
fn short_help_fits_one_screen_and_long_help_groups_all_options() {
    let folder = tempfile::tempdir().unwrap();
    let help = |option| String::from_utf8(gpc(folder.path(), &["render", option]).ok().stdout).unwrap();
    let short = help("-h");
    assert!(short.lines().count() <= 45, "{} lines: {short}", short.lines().count());
    let widest = short.lines().map(|line| line.chars().count()).max().unwrap();
    assert!(widest <= 100, "{widest} columns: {short}");
    for option in ["--size", "--samples", "--camera", "--background", "--shadows", "--turntable"] {
        assert!(short.contains(option), "{option}");
    }
    let long = help("--help");
    for heading in ["Image:", "Antialiasing:", "Light and lines:", "View:", "Sequences:", "Device:", "Report:"] {
        assert!(long.contains(&format!("\n{heading}\n")), "{heading}");
    }
    let words = long.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words.contains(&format!("one time named {} covers", PassTime::ROUNDS)));
}
