//! The C API: its header, its installation, and programs in C and C++ that use it.

use crate::example::{self, figure};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// Where the library is installed for these tests.
fn prefix() -> &'static Path {
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

/// Runs a program and gives what it said.
fn said(program: &mut Command) -> String {
    let run = program.output().unwrap_or_else(|error| {
        panic!("{program:?}: {error}; tools/setup.sh build c installs what is needed")
    });
    let complained = String::from_utf8_lossy(&run.stderr);
    assert!(run.status.success(), "{program:?}:\n{complained}");
    String::from_utf8(run.stdout).unwrap()
}

/// Words of what pkg-config says of the installed library.
fn pkg_config(options: &[&str]) -> Vec<String> {
    let mut program = Command::new("pkg-config");
    program
        .args(options)
        .env("PKG_CONFIG_PATH", prefix().join("lib/pkgconfig"));
    let words = said(&mut program);
    words.split_whitespace().map(str::to_owned).collect()
}

/// Compiles a program against the installed library, without a warning.
fn compiled(compiler: &str, source: &str, options: &[&str], libraries: &[String]) -> PathBuf {
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
    let bindings = cbindgen::Builder::new()
        .with_src(root.join("src/capi/mod.rs"))
        .with_config(config)
        .generate()
        .unwrap();
    let mut made = Vec::new();
    bindings.write(&mut made);
    let made = String::from_utf8(made).unwrap();
    let header = root.join("include/gpc.h");
    if std::env::var_os("GPC_HEADER").is_some_and(|mode| mode == "write") {
        std::fs::write(&header, &made).unwrap();
    }
    let checked_in = std::fs::read_to_string(&header).unwrap_or_default();
    assert!(
        made == checked_in,
        "include/gpc.h is not what src/capi makes: run `make header`"
    );
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

/// In C99, and with the static library.
#[test]
fn misuse_is_answered_with_a_result_and_a_message() {
    let mut libraries = vec![prefix().join("lib/libgpc.a").display().to_string()];
    let private = pkg_config(&["--static", "--libs-only-l", "gpc", "vulkan"]);
    libraries.extend(private.into_iter().filter(|library| library != "-lgpc"));
    let options = ["-std=c99", "-pedantic"];
    let program = compiled("cc", "tests/hosts/misuse.c", &options, &libraries);
    example::validated(&mut Command::new(program));
}

/// In C++17, and with the shared library.
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
    example::takes_only(program, 2, "forward SPIRV_FOLDER OUT.ppm");
    let said = example::validated(
        program()
            .arg(Path::new(ROOT).join("examples/forward/shaders/spirv"))
            .arg(prefix().join("forward.ppm")),
    );
    assert!(said.contains(" 0 left over"), "{said}");
    let brute = figure(&said, "error of brute force: ");
    assert!(
        figure(&said, "error of one sample: ") > 20.0 * brute,
        "{said}"
    );
    assert!(
        figure(&said, "error of superpixels: ") < 1.4 * brute,
        "{said}"
    );
    let placed = figure(
        &said,
        "error of superpixels, samples where brute force has them: ",
    );
    assert!(placed <= 1.25 * brute, "{said}");
    let each = figure(
        &said,
        "error of superpixels, each of these samples shaded: ",
    );
    assert!(each <= 1.2 * brute, "{said}");
    assert!(figure(&said, "share of superpixels: ") < 0.45, "{said}");
}
