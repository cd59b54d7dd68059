//! The layout of the structs of `gpc.h`, which programs that were compiled with an earlier header rely on.
//!
//! `frozen/layout-VERSION.txt` has the layout in a released version: a line for each struct with its size, for each member
//! with its offset and size, and for each enumerator with its value.

use crate::capi::{ROOT, compiled, pkg_config, prefix, said};
use std::collections::HashMap;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Structs that never change: they are members of other structs, or elements of arrays without a stride.
const FIXED: [&str; 5] = ["GpcImageState", "GpcImage", "GpcLocation", "GpcInstance", "GpcMemory"];

/// Struct and function of a line `GpcResult gpc_init_device(struct GpcDevice *device,`.
fn initialiser(line: &str) -> Option<(&str, &str)> {
    let (function, rest) = line.strip_prefix("GpcResult ")?.split_once("(struct ")?;
    function.strip_prefix("gpc_init_")?;
    Some((rest.split_once(' ')?.0, function))
}

/// Name of the member that a line declares.
fn member(line: &str) -> Option<&str> {
    let declaration = line.trim().strip_suffix(';')?;
    if let Some((_, pointer)) = declaration.split_once("(*") {
        return Some(pointer.split_once(')')?.0);
    }
    let name = declaration.split('[').next()?;
    name.rsplit([' ', '*']).next()
}

/// A program that prints the layout, made from the header's text.
fn program(header: &str) -> String {
    let mut lines = String::new();
    let mut of = None;
    for line in header.lines().filter(|line| !line.trim().starts_with("//")) {
        if let Some(rest) = line.strip_prefix("typedef struct ")
            && let Some(name) = rest.strip_suffix(" {")
        {
            of = Some(name);
            writeln!(lines, "printf(\"{name} %zu\\n\", sizeof({name}));").unwrap();
        } else if line.starts_with('}') {
            of = None;
        } else if let (Some(name), Some(member)) = (of, member(line)) {
            writeln!(
                lines,
                "printf(\"{name}.{member} %zu %zu\\n\", offsetof({name}, {member}), sizeof((({name} *)0)->{member}));"
            )
            .unwrap();
        } else if let Some((name, _)) = line.trim().split_once(" = ")
            && name.starts_with("GPC_")
        {
            writeln!(lines, "printf(\"{name} %u\\n\", (unsigned){name});").unwrap();
        }
    }
    format!("#include <gpc.h>\n#include <stddef.h>\n#include <stdio.h>\nint main(void) {{\n{lines}return 0;\n}}\n")
}

/// Compiles a program in C against the installed library, and returns what it prints.
fn ran(name: &str, source: &str) -> String {
    let path = prefix().join(name);
    std::fs::write(&path, source).unwrap();
    let libraries = pkg_config(&["--libs", "gpc"]);
    let program = compiled("cc", path.to_str().unwrap(), &["-std=c99", "-pedantic"], &libraries);
    said(Command::new(program).env("LD_LIBRARY_PATH", prefix().join("lib")))
}

/// Layout of the present header.
fn present() -> String {
    let header = std::fs::read_to_string(Path::new(ROOT).join("include/gpc.h")).unwrap();
    ran("layout.c", &program(&header))
}

/// Path and text of the layout of each released version, and of the present one.
fn released() -> &'static [(PathBuf, String)] {
    static RELEASED: OnceLock<Vec<(PathBuf, String)>> = OnceLock::new();
    RELEASED.get_or_init(|| {
        let folder = Path::new(ROOT).join("tests/hosts/frozen");
        let path = folder.join(format!("layout-{VERSION}.txt"));
        if !path.exists() && std::env::var_os("GPC_LAYOUT").is_some_and(|mode| mode == "write") {
            std::fs::write(&path, present()).unwrap();
        }
        assert!(
            path.exists(),
            "{} is missing; this writes it: \
             GPC_LAYOUT=write cargo test --release --features capi --test hosts layout",
            path.display()
        );
        let files = std::fs::read_dir(&folder).unwrap();
        let files = files.map(|file| file.unwrap().path());
        let layouts = files.filter(|path| path.extension().is_some_and(|end| end == "txt"));
        let read = |path: PathBuf| {
            let text = std::fs::read_to_string(&path).unwrap();
            (path, text)
        };
        layouts.map(read).collect()
    })
}

/// Name and numbers of each line of a layout.
fn entries(layout: &str) -> Vec<(&str, Vec<usize>)> {
    layout
        .lines()
        .map(|line| {
            let mut words = line.split(' ');
            let name = words.next().unwrap();
            (name, words.map(|word| word.parse().unwrap()).collect())
        })
        .collect()
}

/// Lines of a released layout with which the present one does not agree. Structs may have grown at their ends.
fn broken(released: &str, present: &str) -> Vec<String> {
    let now: HashMap<_, _> = entries(present).into_iter().collect();
    let changed = |(name, was): &(&str, Vec<usize>)| {
        let grows = name.starts_with("Gpc") && !name.contains('.') && !FIXED.contains(name);
        now.get(name).is_none_or(|is| if grows { is < was } else { is != was })
    };
    let entries = entries(released).into_iter();
    entries.filter(changed).map(|(name, was)| format!("{name} was {was:?} and is {:?}", now.get(name))).collect()
}

#[test]
fn members_and_enumerators_are_where_released_headers_have_them() {
    let present = present();
    for (path, released) in released() {
        let broken = broken(released, &present);
        assert!(broken.is_empty(), "{}: {broken:#?}", path.display());
    }
}

#[test]
fn a_moved_member_breaks_the_layout_and_a_new_one_at_the_end_does_not() {
    let was = "GpcA 16\nGpcA.a 0 4\nGpcA.b 8 8\nGpcImage 4\nGpcImage.c 0 4\nGPC_X 1\n";
    let changed = |from: &str, to: &str| broken(was, &was.replace(from, to)).len();
    assert_eq!(changed("", ""), 0);
    assert_eq!(changed("GpcA 16\n", "GpcA 24\nGpcA.new 16 8\n"), 0);
    assert_eq!(changed("GpcA.a 0 4", "GpcA.a 4 4"), 1);
    assert_eq!(changed("GpcA.b 8 8", "GpcA.b 8 4"), 1);
    assert_eq!(changed("GpcA.b 8 8\n", ""), 1);
    assert_eq!(changed("GpcA 16", "GpcA 8"), 1);
    assert_eq!(changed("GpcImage 4", "GpcImage 8"), 1);
    assert_eq!(changed("GPC_X 1", "GPC_X 2"), 1);
}

/// The shared library fills structs of the sizes that they have in released headers, and writes no further.
#[test]
fn the_library_fills_structs_of_released_sizes() {
    let header = std::fs::read_to_string(Path::new(ROOT).join("include/gpc.h")).unwrap();
    let functions: HashMap<_, _> = header.lines().filter_map(initialiser).collect();
    assert_eq!(functions.len(), 10);
    let mut calls = String::new();
    let mut count = 0;
    for (_, released) in released() {
        for (name, numbers) in entries(released) {
            let Some(function) = functions.get(name) else {
                continue;
            };
            let size = numbers[0];
            count += 1;
            writeln!(
                calls,
                "memset(room, 0xab, sizeof room);
    if ({function}((struct {name} *)room, {size}) != GPC_RESULT_SUCCESS) puts(gpc_last_error());
    if (*(uint32_t *)room != {size} || ((unsigned char *)room)[{size}] != 0xab) puts(\"{name} of {size} bytes\");"
            )
            .unwrap();
        }
    }
    assert!(count >= functions.len());
    let source = format!(
        "#include <gpc.h>\n#include <stdio.h>\n#include <string.h>\nstatic uint64_t room[256];\nint main(void) {{\n{calls}return 0;\n}}\n"
    );
    assert_eq!(ran("fill.c", &source), "");
}
