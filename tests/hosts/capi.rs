//! The C API: its header, its installation, and programs in C and C++ that use it.

use crate::example::{self, figure};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

pub const ROOT: &str = env!("CARGO_MANIFEST_DIR");

const EXAMPLE: &str = "examples/forward/forward.cpp";
const EXAMPLE_SHADER: &str = "examples/forward/shaders/spirv/samples.spv";

/// Folder in which the library is installed for these tests.
pub fn prefix() -> &'static Path {
    static PREFIX: OnceLock<PathBuf> = OnceLock::new();
    PREFIX.get_or_init(|| {
        let prefix = Path::new(env!("CARGO_TARGET_TMPDIR")).join("capi");
        let _ = std::fs::remove_dir_all(&prefix);
        let mut install = Command::new("make");
        install
            .args(["--directory", ROOT, "install"])
            .arg(format!("PREFIX={}", prefix.display()))
            .env("CARGO", env!("CARGO"));
        said(&mut install);
        prefix
    })
}

/// Runs a program and returns its standard output.
pub fn said(program: &mut Command) -> String {
    let run = program
        .output()
        .unwrap_or_else(|error| panic!("{program:?}: {error}; tools/setup.sh build c installs what is needed"));
    let complained = String::from_utf8_lossy(&run.stderr);
    assert!(run.status.success(), "{program:?}:\n{complained}");
    String::from_utf8(run.stdout).unwrap()
}

/// Options that pkg-config prints for the installed library.
pub fn pkg_config(options: &[&str]) -> Vec<String> {
    let mut program = Command::new("pkg-config");
    program.args(options).env("PKG_CONFIG_PATH", prefix().join("lib/pkgconfig"));
    let words = said(&mut program);
    words.split_whitespace().map(str::to_owned).collect()
}

/// Compiles a program against the installed library; warnings are errors.
pub fn compiled(compiler: &str, source: &str, options: &[&str], libraries: &[String]) -> PathBuf {
    let source = Path::new(ROOT).join(source);
    let program = prefix().join(source.file_stem().unwrap());
    let flags = pkg_config(&["--cflags", "gpc", "vulkan"]);
    said(
        Command::new(compiler)
            .args(["-Wall", "-Wextra", "-Werror"])
            .args(options)
            .args(flags)
            .arg(source)
            .arg("-o")
            .arg(&program)
            .args(libraries),
    );
    program
}

#[test]
fn the_header_is_made_of_the_sources() {
    let root = Path::new(ROOT);
    let config = cbindgen::Config::from_file(root.join("cbindgen.toml")).unwrap();
    let bindings =
        cbindgen::Builder::new().with_src(root.join("src/capi/mod.rs")).with_config(config).generate().unwrap();
    let mut made = Vec::new();
    bindings.write(&mut made);
    let made = String::from_utf8(made).unwrap();
    let header = root.join("include/gpc.h");
    if std::env::var_os("GPC_HEADER").is_some_and(|mode| mode == "write") {
        std::fs::write(&header, &made).unwrap();
    }
    let checked_in = std::fs::read_to_string(&header).unwrap_or_default();
    assert!(made == checked_in, "include/gpc.h is not what src/capi makes: run `make header`");
}

#[test]
fn what_shaders_include_is_installed() {
    let folder = pkg_config(&["--variable=shaders", "gpc"]);
    let installed = std::fs::read_dir(&folder[0]).unwrap().count();
    assert_eq!(installed, gpc::host::SHADER_INCLUDES.len());
    for (name, text) in gpc::host::SHADER_INCLUDES {
        let found = std::fs::read_to_string(Path::new(&folder[0]).join(name)).unwrap();
        assert_eq!(found, text, "{name}");
    }
}

/// Programs with nothing but the library, linked in each way that is promised.
#[test]
fn the_library_is_linked_by_pkg_config_and_cmake_shared_and_static() {
    let run = |program: PathBuf| {
        let library = prefix().join("lib");
        let said = said(Command::new(program).env("LD_LIBRARY_PATH", library));
        assert_eq!(said, "linked\n");
    };
    let source = "tests/hosts/linked.c";
    let archive = prefix().join("lib/libgpc.a").display().to_string();
    let private = pkg_config(&["--static", "--libs-only-l", "gpc"]);
    let private = private.into_iter().filter(|library| library != "-lgpc");
    let static_only: Vec<_> = [archive].into_iter().chain(private).collect();
    let options = ["-std=c99", "-pedantic"];
    run(compiled("cc", source, &options, &static_only));
    // Wholly static, as for containers without libraries.
    let all = pkg_config(&["--static", "--libs", "gpc"]);
    run(compiled("cc", source, &["-std=c99", "-static"], &all));

    let folder = prefix().join("cmake");
    std::fs::create_dir_all(&folder).unwrap();
    let lists = format!(
        "cmake_minimum_required(VERSION 3.13)
project(linked C)
find_package(gpc 0.2 REQUIRED CONFIG)
find_package(Vulkan REQUIRED)
if(NOT EXISTS ${{gpc_SHADERS}}/gpc_visibility.glsl)
    message(FATAL_ERROR \"no includes in ${{gpc_SHADERS}}\")
endif()
foreach(kind gpc gpc_static)
    add_executable(with_${{kind}} {ROOT}/{source})
    target_link_libraries(with_${{kind}} gpc::${{kind}})
endforeach()
find_package(gpc 99 QUIET CONFIG)
if(gpc_FOUND)
    message(FATAL_ERROR \"a later version was found\")
endif()
"
    );
    std::fs::write(folder.join("CMakeLists.txt"), lists).unwrap();
    let built = folder.join("built");
    let configured = format!("-DCMAKE_PREFIX_PATH={}", prefix().display());
    said(Command::new("cmake").arg("-S").arg(&folder).arg("-B").arg(&built).arg(configured));
    said(Command::new("cmake").arg("--build").arg(&built));
    run(built.join("with_gpc"));
    run(built.join("with_gpc_static"));
}

#[test]
fn the_libraries_show_the_interface_alone() {
    for (library, options) in
        [("libgpc.a", ["--extern-only", "--defined-only"]), ("libgpc.so", ["--dynamic", "--defined-only"])]
    {
        let symbols = said(Command::new("nm").args(options).arg(prefix().join("lib").join(library)));
        let names: Vec<_> = symbols.lines().filter_map(|line| line.split_whitespace().nth(2)).collect();
        assert!(names.contains(&"gpc_frame_record"), "{library}: {names:?}");
        let other: Vec<_> = names.iter().filter(|name| !name.starts_with("gpc_")).collect();
        assert!(other.is_empty(), "{library}: {other:?}");
    }
}

#[test]
fn a_standard_without_what_the_header_needs_is_refused_by_name() {
    let source = prefix().join("old.cpp");
    std::fs::write(&source, "#include <gpc.h>\n").unwrap();
    let run = Command::new("c++")
        .args(["-std=c++98", "-pedantic", "-fsyntax-only"])
        .args(pkg_config(&["--cflags", "gpc"]))
        .arg(&source)
        .output()
        .unwrap();
    let complained = String::from_utf8_lossy(&run.stderr);
    assert!(!run.status.success());
    assert!(complained.contains("gpc.h needs C++11 or later: compile with -std=c++11"), "{complained}");
}

#[test]
fn the_manual_the_example_and_the_licences_are_installed() {
    for (folder, file, source) in [
        ("doc/gpc/pictures", "besides-right.png", "docs/pictures/besides-right.png"),
        ("doc/gpc", "LICENSE-MIT", "LICENSE-MIT"),
        ("doc/gpc", "LICENSE-APACHE", "LICENSE-APACHE"),
        ("gpc", EXAMPLE, EXAMPLE),
        ("gpc", EXAMPLE_SHADER, EXAMPLE_SHADER),
    ] {
        let found = prefix().join("share").join(folder).join(file);
        let found = std::fs::read(found).unwrap();
        assert_eq!(found, std::fs::read(Path::new(ROOT).join(source)).unwrap());
    }
}

/// Places that the links of a page lead to, without anchors.
fn links(page: &str) -> Vec<&str> {
    let after = page.split("](").skip(1);
    let places = after.filter_map(|rest| rest.split([')', '#']).next());
    places.filter(|place| !place.is_empty() && !place.starts_with("http")).collect()
}

#[test]
fn links_of_the_installed_manual_lead_to_files() {
    let folder = prefix().join("share/doc/gpc");
    let mut found = 0;
    for page in ["embedding", "embedding-reference", "fits", "swapchains", "CHANGELOG"] {
        let text = std::fs::read_to_string(folder.join(page).with_extension("md")).unwrap();
        for link in links(&text) {
            assert!(folder.join(link).exists(), "{page}.md: {link}");
            found += 1;
        }
    }
    assert!(found > 20, "{found}");
}

/// The program is compiled as C99 and linked with the static library.
#[test]
fn misuse_is_answered_with_a_result_and_a_message() {
    let mut libraries = vec![prefix().join("lib/libgpc.a").display().to_string()];
    let private = pkg_config(&["--static", "--libs-only-l", "gpc", "vulkan"]);
    libraries.extend(private.into_iter().filter(|library| library != "-lgpc"));
    let options = ["-std=c99", "-pedantic"];
    let program = compiled("cc", "tests/hosts/misuse.c", &options, &libraries);
    example::validated(&mut Command::new(program));
}

/// The program, its header and its SPIR-V are of the first version of the binary interface: see CONTRIBUTING.md.
#[test]
fn a_program_of_an_earlier_header_runs_with_the_shared_library() {
    let frozen = Path::new(ROOT).join("tests/hosts/frozen");
    let libraries = pkg_config(&["--libs", "gpc", "vulkan"]);
    let include = format!("-I{}", frozen.display());
    let options = ["-std=c99", "-pedantic", &include];
    let program = compiled("cc", "tests/hosts/frozen/program.c", &options, &libraries);
    let needed = said(Command::new("readelf").arg("--dynamic").arg(&program));
    assert!(needed.contains("[libgpc.so.1]"), "{needed}");
    example::validated(
        Command::new(program).arg(frozen.join("samples.spv")).env("LD_LIBRARY_PATH", prefix().join("lib")),
    );
}

/// The program is compiled as C++17 and linked with the shared library.
#[test]
fn a_forward_renderer_is_antialiased_as_by_its_brute_force() {
    let libraries = pkg_config(&["--libs", "gpc", "vulkan"]);
    let options = ["-std=c++17", "-O2", "-Wno-missing-field-initializers"];
    let program = compiled("c++", "examples/forward/forward.cpp", &options, &libraries);
    let program = || {
        let mut command = Command::new(&program);
        command.env("LD_LIBRARY_PATH", prefix().join("lib"));
        command
    };
    let usage = "forward SPIRV_FOLDER OUT.ppm, or forward SPIRV_FOLDER --sizes WIDTHxHEIGHT,...";
    example::takes_only(program, 2, usage);
    let shaders = Path::new(ROOT).join("examples/forward/shaders/spirv");
    let said = example::validated(program().arg(&shaders).arg(prefix().join("forward.ppm")));
    assert!(said.contains(" 0 left over"), "{said}");
    assert!(said.contains("after two resizes: the same picture"), "{said}");
    let brute = figure(&said, "error of brute force: ");
    assert!(figure(&said, "error of one sample: ") > 20.0 * brute, "{said}");
    assert!(figure(&said, "error of superpixels: ") <= 0.97 * brute, "{said}");
    let placed = figure(&said, "error of superpixels, samples where brute force has them: ");
    assert!(placed <= 1.2 * brute, "{said}");
    let each = figure(&said, "error of superpixels, each of these samples shaded: ");
    assert!(each <= 1.15 * brute, "{said}");
    assert!(figure(&said, "share of superpixels: ") < 0.45, "{said}");

    let said = example::validated(program().arg(&shaders).args(["--sizes", "48x27,64x36"]));
    let rows: Vec<Vec<&str>> = (said.lines().skip(1)).map(|line| line.split(',').collect()).collect();
    let of_size = |size: [&'static str; 2]| {
        let methods = [["none", "1"], ["own", "64"], ["own", "256"], ["superpixel", "64"], ["superpixel", "256"]];
        methods.map(|[method, samples]| [size[0], size[1], method, samples])
    };
    let expected = [of_size(["48", "27"]), of_size(["64", "36"])].concat();
    let found: Vec<_> = rows.iter().map(|row| row[..4].to_vec()).collect();
    assert_eq!(found, expected, "{said}");
    for row in &rows {
        let [wall, cpu, error, share] = [5, 6, 7, 8].map(|i| row[i].parse::<f64>().unwrap());
        assert!(wall > 0.0 && cpu > 0.0, "{said}");
        let is_of_the_library = row[2] == "superpixel";
        assert!((share > 0.1) == is_of_the_library && (error < 0.01) == (row[2] != "none"), "{said}");
    }
    let mut wrong = program();
    wrong.arg(&shaders).args(["--sizes", "48x27,"]);
    let complained = String::from_utf8(wrong.output().unwrap().stderr).unwrap();
    assert!(complained.starts_with("\"48x27,\" is no list of sizes such as 240x135,480x270; usage: "), "{complained}");
}
