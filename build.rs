//! SPIR-V of the crate. By default the checked-in `shaders/spirv` is used, after a check that it was made from the
//! sources beside it. The feature `compile-shaders` compiles the sources.
//!
//! With the feature, `GPC_SPIRV=write` replaces the checked-in files, and `GPC_SPIRV=check` fails if they differ. Both
//! also apply to the Rust file with the interfaces of the crate's shaders.

#[cfg(feature = "compile-shaders")]
#[path = "build/reflect.rs"]
mod reflect;

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

/// Shaders of the example `forward`, a host in C++.
const FORWARD: &[Variant] = &[
    ("forward_vertex", "forward.vert", &[]),
    ("forward_fragment", "forward.frag", &[]),
    ("samples", "samples.comp", &[]),
];

/// Shaders of the example `visibility`, a host in Rust.
const VISIBILITY: &[Variant] = &[
    ("pose", "pose.comp", &[]),
    ("ids_vertex", "ids.vert", &[]),
    ("ids_fragment", "ids.frag", &[]),
    ("ids_masked_vertex", "ids.vert", &[("MASKED", "")]),
    ("ids_masked_fragment", "ids.frag", &[("MASKED", "")]),
    ("screen_vertex", "screen.vert", &[]),
    ("screen_fragment", "screen.frag", &[]),
    ("samples", "samples.comp", &[]),
    ("lens", "lens.comp", &[]),
];

/// Shaders of the example `culling`, a host whose device decides what is drawn.
const CULLING: &[Variant] = &[
    ("cull", "cull.comp", &[]),
    ("object_vertex", "object.vert", &[]),
    ("object_fragment", "object.frag", &[]),
    ("samples", "samples.comp", &[]),
];

/// The shader of the tests' host in C, which `tests/hosts/frozen` has a copy of.
const SAMPLES: &[Variant] = &[("samples", "samples.comp", &[])];

/// Shaders of the tests' host in Rust.
const HOST: &[Variant] =
    &[("samples", "samples.comp", &[]), ("corners", "corners.comp", &[]), ("filters", "filters.comp", &[])];

/// Shaders of the tests of teams and of subgroups.
const TEAMS: &[Variant] = &[("teams", "teams.comp", &[]), ("append", "append.comp", &[])];

/// The shader with which a test reads what the host writes.
const ROWS: &[Variant] = &[("rows", "rows.comp", &[])];

/// Name of a compiled shader, its source file, and its macro definitions.
type Variant = (&'static str, &'static str, &'static [(&'static str, &'static str)]);

const VARIANTS: &[Variant] = &[
    ("pose", "pose.comp", &[]),
    ("stroke", "stroke.comp", &[]),
    ("prefilter", "prefilter.comp", &[]),
    ("raster_vertex", "raster.vert", &[]),
    ("raster_opaque", "raster.frag", &[]),
    ("raster_masked", "raster.frag", &[("MASKED", "")]),
    ("raster_opaque_bytes", "raster.frag", &[("BYTES", "")]),
    ("raster_masked_bytes", "raster.frag", &[("MASKED", ""), ("BYTES", "")]),
    ("filter", "filter.comp", &[]),
    ("detect", "detect.comp", &[]),
    ("thin", "thin.comp", &[]),
    ("detect_multisampled", "detect.comp", &[("MULTISAMPLED", "")]),
    ("grow", "grow.comp", &[]),
    ("neighbours", "neighbours.comp", &[]),
    ("cull", "cull.comp", &[]),
    ("bin", "bin.comp", &[]),
    ("setup", "setup.comp", &[]),
    ("refine", "refine.comp", &[]),
    ("scatter", "scatter.comp", &[]),
    ("spans", "spans.comp", &[]),
    ("tally", "tally.comp", &[]),
    ("schedule", "schedule.comp", &[]),
    ("enlist", "enlist.comp", &[]),
    ("crossings", "crossings.comp", &[]),
    ("distribute", "distribute.comp", &[]),
    ("groups", "groups.comp", &[]),
    ("indirect", "indirect.comp", &[]),
    ("arguments", "arguments.comp", &[]),
    ("sample", "sample.comp", &[("LAYERED", "false"), ("UNLISTED", "false")]),
    ("sample_layered", "sample.comp", &[("LAYERED", "true"), ("UNLISTED", "false")]),
    ("sample_unlisted", "sample.comp", &[("LAYERED", "false"), ("UNLISTED", "true")]),
    ("sample_layered_unlisted", "sample.comp", &[("LAYERED", "true"), ("UNLISTED", "true")]),
    ("sample_lines", "sample_lines.comp", &[]),
    ("sort", "sort.comp", &[]),
    ("receivers", "receivers.comp", &[]),
    ("occlude", "occlude.comp", &[]),
    ("merge", "merge.comp", &[]),
    ("shade", "shade.comp", &[]),
    ("composite", "composite.comp", &[]),
    ("resolve", "resolve.comp", &[]),
    ("resolve_drawn", "resolve.comp", &[("DRAWN", "")]),
    ("resolve_filtered", "resolve.comp", &[("FILTERED", "")]),
    ("resolve_drawn_filtered", "resolve.comp", &[("DRAWN", ""), ("FILTERED", "")]),
    ("points", "points.comp", &[]),
    ("box_filter", "box_filter.comp", &[]),
    ("pixel_filter", "pixel_filter.comp", &[]),
    ("multisample", "multisample.comp", &[]),
    ("attributes", "attributes.comp", &[]),
    ("encode", "encode.comp", &[]),
    ("adopt", "adopt.comp", &[]),
    ("transform", "transform.comp", &[]),
    ("coordinates", "coordinates.comp", &[]),
    ("alpha_map", "alpha_map.comp", &[]),
    ("take", "take.comp", &[]),
    ("centres", "centres.comp", &[]),
    ("patch_vertex", "patch.vert", &[]),
    ("patch_fragment", "patch.frag", &[]),
];

/// Shaders that are compiled and checked in together.
struct Group {
    /// Folder of the sources; compiled shaders are in its subfolder `spirv`.
    sources: PathBuf,
    /// Folder of the includes.
    includes: PathBuf,
    variants: &'static [Variant],
}

fn main() {
    println!("cargo:rerun-if-changed=shaders");
    println!("cargo:rerun-if-changed=examples/culling/shaders");
    println!("cargo:rerun-if-changed=examples/forward/shaders");
    println!("cargo:rerun-if-changed=examples/visibility/shaders");
    println!("cargo:rerun-if-changed=tests/gpu/host/shaders");
    println!("cargo:rerun-if-changed=tests/gpu/teams/shaders");
    println!("cargo:rerun-if-changed=tests/hosts/shaders");
    println!("cargo:rerun-if-changed=tests/rows/shaders");
    println!("cargo:rerun-if-changed=build.rs");
    println!("cargo:rerun-if-changed=build");
    println!("cargo:rerun-if-env-changed=GPC_SPIRV");
    let root = PathBuf::from(std::env::var("CARGO_MANIFEST_DIR").expect("cargo sets CARGO_MANIFEST_DIR"));
    let out = PathBuf::from(std::env::var("OUT_DIR").expect("cargo sets OUT_DIR"));
    let group =
        |folder: &str, variants| Group { sources: root.join(folder), includes: root.join("shaders/include"), variants };
    spirv(&group("examples/culling/shaders", CULLING), &out);
    spirv(&group("examples/forward/shaders", FORWARD), &out);
    spirv(&group("examples/visibility/shaders", VISIBILITY), &out);
    spirv(&group("tests/gpu/host/shaders", HOST), &out);
    spirv(&group("tests/gpu/teams/shaders", TEAMS), &out);
    spirv(&group("tests/hosts/shaders", SAMPLES), &out);
    spirv(&group("tests/rows/shaders", ROWS), &out);
    let own = group("shaders", VARIANTS);
    let folder = spirv(&own, &out);
    #[cfg(feature = "compile-shaders")]
    interfaces(&own, &folder, &root.join("src/engine/spirv.rs"));
    let mut code = String::new();
    // Paths begin with a variable, so that built files stay valid if the sources are moved.
    let (variable, beside) = if folder.starts_with(&out) { ("OUT_DIR", &out) } else { ("CARGO_MANIFEST_DIR", &root) };
    let folder = folder.strip_prefix(beside).expect("a folder of ours");
    for (name, source, _) in VARIANTS {
        let path = Path::new("/").join(folder).join(format!("{name}.spv"));
        writeln!(
            code,
            "/// `shaders/{source}`\npub static {}: &[u8] = include_bytes!(concat!(env!({variable:?}), {path:?}));",
            name.to_uppercase(),
        )
        .expect("writing to a string");
    }
    fs::write(out.join("spirv.rs"), code).expect("OUT_DIR is writable");
    shared_files(&root);
}

/// Sets the cfg `shared_files` if the tests' files in `../shared` exist, or if `CI` is set, so that their absence is
/// an error there. Elsewhere the tests that need them are ignored. Files that appear later are found by the next run
/// of this script; if cargo watched missing files, it would rebuild everything each time.
fn shared_files(root: &Path) {
    println!("cargo:rustc-check-cfg=cfg(shared_files)");
    let index = root.join("../shared/scenes/index.json");
    if index.is_file() {
        println!("cargo:rerun-if-changed={}", index.display());
    } else {
        println!("cargo:rerun-if-env-changed=CI");
        if std::env::var_os("CI").is_none() {
            return;
        }
    }
    println!("cargo:rustc-cfg=shared_files");
}

impl Group {
    fn checked_in(&self) -> PathBuf {
        self.sources.join("spirv")
    }

    /// Fingerprint of all source files and of the list of variants (64-bit FNV-1a).
    fn fingerprint(&self) -> String {
        let mut files: Vec<PathBuf> = [&self.sources, &self.includes]
            .iter()
            .flat_map(|folder| fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display())))
            .map(|entry| entry.expect("a folder's entry").path())
            .filter(|path| path.is_file())
            .collect();
        files.sort();
        let mut hash = 0xcbf2_9ce4_8422_2325_u64;
        let mut add = |bytes: &[u8]| {
            for byte in bytes.iter().filter(|byte| **byte != b'\r') {
                hash = (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
            }
        };
        for file in &files {
            add(file.file_name().expect("a file's name").as_encoded_bytes());
            add(&fs::read(file).unwrap_or_else(|e| panic!("{}: {e}", file.display())));
        }
        add(format!("{:?}", self.variants).as_bytes());
        format!("{hash:016x}\n")
    }
}

#[cfg(not(feature = "compile-shaders"))]
fn spirv(group: &Group, _out: &Path) -> PathBuf {
    let checked_in = group.checked_in();
    let made_from = fs::read_to_string(checked_in.join("fingerprint")).unwrap_or_default();
    assert!(
        made_from.trim() == group.fingerprint().trim(),
        "\n\n{} is not what its sources compile to: run `make shaders` (needs cmake and a C++ compiler) and commit the result\n",
        checked_in.display()
    );
    checked_in
}

#[cfg(feature = "compile-shaders")]
fn spirv(group: &Group, out: &Path) -> PathBuf {
    let compiled = compile(group, shaderc::OptimizationLevel::Performance);
    let checked_in = group.checked_in();
    let mode = std::env::var("GPC_SPIRV").unwrap_or_default();
    let folder = out.join("spirv");
    fs::create_dir_all(&folder).expect("OUT_DIR is writable");
    if mode == "write" {
        let _ = fs::remove_dir_all(&checked_in);
        fs::create_dir_all(&checked_in).expect("the sources' folder is writable");
        fs::write(checked_in.join("fingerprint"), group.fingerprint()).expect("the sources' folder is writable");
    }
    if mode == "check" {
        let made_from = fs::read_to_string(checked_in.join("fingerprint")).unwrap_or_default();
        assert!(
            made_from == group.fingerprint(),
            "\n\n{}/fingerprint is stale: run `make shaders`\n",
            checked_in.display()
        );
    }
    for (name, words) in compiled {
        let file = format!("{name}.spv");
        if mode == "write" {
            fs::write(checked_in.join(&file), &words).expect("the sources' folder is writable");
        }
        if mode == "check" {
            let found = fs::read(checked_in.join(&file)).unwrap_or_default();
            assert!(
                found == words,
                "\n\n{}/{file} is not what its source compiles to: run `make shaders`\n",
                checked_in.display()
            );
        }
        fs::write(folder.join(&file), &words).expect("OUT_DIR is writable");
    }
    folder
}

/// Writes or checks the Rust file with the shaders' interfaces; their modules are in `folder`.
#[cfg(feature = "compile-shaders")]
fn interfaces(group: &Group, folder: &Path, file: &Path) {
    /// Include through which shaders of hosts bind a set.
    const LENT: &str = "include/gpc_visibility.glsl";
    let read = |path: &Path| fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    // Only modules that are not optimised keep the names.
    let named = compile(group, shaderc::OptimizationLevel::Zero);
    let shaders = group.variants.iter().zip(named);
    let mut all: Vec<_> = shaders
        .map(|((name, source, _), (_, named))| {
            let text = read(&group.sources.join(source));
            reflect::Compiled {
                name: (*name).to_owned(),
                source: (*source).to_owned(),
                in_frame: text.contains("#include \"include/frame.glsl\""),
                lent: false,
                optimised: fs::read(folder.join(format!("{name}.spv"))).expect("was written"),
                named,
            }
        })
        .collect();
    let text = format!(
        "#version 460\n#extension GL_GOOGLE_include_directive : require\n#include \"{LENT}\"\nlayout(local_size_x = 1) in;\nvoid main() {{}}\n"
    );
    let lent = compile_text(group, (LENT, "lent.comp", &text), &[], shaderc::OptimizationLevel::Zero);
    all.push(reflect::Compiled {
        name: "lent".to_owned(),
        source: LENT.to_owned(),
        in_frame: false,
        lent: true,
        optimised: lent.clone(),
        named: lent,
    });
    let code = reflect::rust(&all, &read(&group.includes.join("interface.glsl")));
    match std::env::var("GPC_SPIRV").unwrap_or_default().as_str() {
        "write" => fs::write(file, code).expect("the sources' folder is writable"),
        "check" => {
            assert!(read(file) == code, "\n\n{} is not what the shaders say: run `make shaders`\n", file.display())
        }
        _ => {}
    }
}

#[cfg(feature = "compile-shaders")]
fn compile(group: &Group, optimization: shaderc::OptimizationLevel) -> Vec<(&'static str, Vec<u8>)> {
    let variants = group.variants.iter();
    variants
        .map(|(name, source, definitions)| {
            let text = fs::read_to_string(group.sources.join(source)).unwrap_or_else(|e| panic!("{source}: {e}"));
            let words = compile_text(group, (name, source, &text), definitions, optimization);
            (*name, words)
        })
        .collect()
}

/// Compiles the text of a shader as if it were a file with this name in the group's folder.
#[cfg(feature = "compile-shaders")]
fn compile_text(
    group: &Group,
    (name, source, text): (&str, &str, &str),
    definitions: &[(&str, &str)],
    optimization: shaderc::OptimizationLevel,
) -> Vec<u8> {
    let sources = &group.sources;
    let compiler = shaderc::Compiler::new().expect("shaderc starts");
    let mut options = shaderc::CompileOptions::new().expect("shaderc options");
    options.set_target_env(shaderc::TargetEnv::Vulkan, shaderc::EnvVersion::Vulkan1_3 as u32);
    options.set_optimization_level(optimization);
    options.set_include_callback(|requested, _, from, _| {
        let nested = Path::new(from).parent().map(|folder| sources.join(folder).join(requested));
        let beside = [sources, &group.includes].map(|folder| Some(folder.join(requested)));
        let path = [nested]
            .into_iter()
            .chain(beside)
            .flatten()
            .find(|path| path.is_file())
            .ok_or_else(|| format!("{requested} is in no folder of includes"))?;
        let content = fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?;
        let resolved_name = path.strip_prefix(sources).unwrap_or(&path).display().to_string();
        Ok(shaderc::ResolvedInclude { resolved_name, content })
    });
    for (key, value) in definitions {
        options.add_macro_definition(key, Some(value));
    }
    let kind = match Path::new(source).extension().and_then(|e| e.to_str()) {
        Some("vert") => shaderc::ShaderKind::Vertex,
        Some("frag") => shaderc::ShaderKind::Fragment,
        _ => shaderc::ShaderKind::Compute,
    };
    let artifact = compiler
        .compile_into_spirv(text, kind, source, "main", Some(&options))
        .unwrap_or_else(|e| panic!("\n\n{source} as {name}:\n{e}\n"));
    artifact.as_binary_u8().to_vec()
}
