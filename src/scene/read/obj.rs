//! OBJ with the base colours of its MTL files.

use std::{
    borrow::Cow,
    cell::RefCell,
    panic::{AssertUnwindSafe, catch_unwind},
    path::Path,
};

use tobj::{LoadError, LoadOptions};

use super::{
    image::Images,
    shape::{Drawing, Shape, linear, plain},
    uri,
};
use crate::scene::{
    Loaded, SceneError,
    error::{Fault, Warnings},
    material::{AlphaMode, Material, Sampler, Texture, TextureTransform, TextureUse},
};

/// Most bytes of an MTL file, and of an image that it names.
const MAX_FILE: u64 = 1 << 30;

/// The statements that OBJ files start with, comments aside.
const STATEMENTS: [&[u8]; 10] = [
    b"v", b"vt", b"vn", b"vp", b"o", b"g", b"s", b"f", b"mtllib", b"usemtl",
];

/// Whether `bytes` look like an OBJ file: the first statement is one, and the text has a vertex.
pub fn is_obj(bytes: &[u8]) -> bool {
    let word = |line: &[u8]| {
        let mut words = line.split(u8::is_ascii_whitespace).map(<[u8]>::to_vec);
        words.find(|word| !word.is_empty())
    };
    let mut words = bytes.split(|&byte| byte == b'\n').filter_map(word);
    let first = words.find(|word| !word.starts_with(b"#"));
    let Some(first) = first.filter(|word| STATEMENTS.contains(&word.as_slice())) else {
        return false;
    };
    first == b"v" || words.any(|word| word == b"v")
}

/// Reads an OBJ file; what it names lies in the folder `base`.
pub fn read(bytes: &[u8], file: &str, base: Option<&Path>) -> Result<Loaded, SceneError> {
    let options = LoadOptions {
        triangulate: true,
        single_index: true,
        ignore_points: true,
        ignore_lines: true,
    };
    let faults = RefCell::new(Vec::new());
    let load_mtl = |path: &Path| {
        let name = path.to_string_lossy();
        let fetched = uri::fetch(&name, base, MAX_FILE);
        let fetched = fetched.map_err(|reason| (reason, LoadError::OpenFileFailed));
        let parsed = fetched.and_then(|bytes| {
            tobj::load_mtl_buf(&mut complete_colours(&bytes).as_slice())
                .map_err(|error| (format!("the MTL file is broken: {error}"), error))
        });
        parsed.map_err(|(reason, error)| {
            let fault = Fault::new(format!("mtllib {name}"), reason);
            faults
                .borrow_mut()
                .push(fault.but("its materials are grey"));
            error
        })
    };
    // With checks of overflow, the parser panics at an index before the first vertex.
    let parse = || tobj::load_obj_buf(&mut &*bytes, &options, load_mtl);
    let loaded = catch_unwind(AssertUnwindSafe(parse)).unwrap_or(Err(LoadError::GenericFailure));
    let (models, materials) = loaded.map_err(|error| {
        let reason = format!("the OBJ file is broken: {error}; export it again");
        Fault::new("statements", reason).into_error(file)
    })?;
    let mut warnings = Warnings::new(file);
    warnings.extend(faults.into_inner());

    let mut drawing = Drawing::default();
    let mut images = Images::default();
    for material in materials.unwrap_or_default() {
        let read = read_material(
            &material,
            base,
            &mut images,
            &mut drawing.textures,
            &mut warnings,
        );
        drawing.materials.push(read);
    }
    drawing.images = images.into_decoded();
    // Of shapes without a material.
    let grey = drawing.materials.len();
    drawing.materials.push(plain());
    for tobj::Model { mesh, name } in models {
        drawing.shapes.push(Shape {
            name: Some(name),
            material: mesh.material_id.unwrap_or(grey),
            triangles: mesh.indices.as_chunks().0.to_vec(),
            positions: mesh.positions.as_chunks().0.to_vec(),
            normals: mesh.normals.as_chunks().0.to_vec(),
            uvs: mesh.texcoords.as_chunks().0.to_vec(),
            colors: opaque(&mesh.vertex_color),
        });
    }
    drawing.into_scene("OBJ", file, warnings)
}

/// An MTL file whose colours have three components each, without which the parser panics. Where there
/// are fewer, the last one stands for the others, as the format says.
fn complete_colours(mtl: &[u8]) -> Vec<u8> {
    let mut completed = Vec::with_capacity(mtl.len());
    for line in mtl.split(|&byte| byte == b'\n') {
        let words = line.split(u8::is_ascii_whitespace);
        let words: Vec<&[u8]> = words.filter(|word| !word.is_empty()).collect();
        match words.as_slice() {
            [b"Ka" | b"Kd" | b"Ks" | b"Ke"] => continue,
            [b"Ka" | b"Kd" | b"Ks" | b"Ke", components @ ..] if components.len() < 3 => {
                completed.extend(words.join(&b' '));
                for _ in components.len()..3 {
                    completed.push(b' ');
                    completed.extend(components[components.len() - 1]);
                }
            }
            _ => completed.extend(line),
        }
        completed.push(b'\n');
    }
    completed
}

/// Colours of vertices, which the format knows without alpha.
fn opaque(colors: &[f32]) -> Vec<[f32; 4]> {
    let (colors, _) = colors.as_chunks();
    let opaque = |color: &[f32; 3]| {
        let [r, g, b] = color.map(|x| linear(x.into()));
        [r, g, b, 1.0]
    };
    colors.iter().map(opaque).collect()
}

fn read_material(
    item: &tobj::Material,
    base: Option<&Path>,
    images: &mut Images,
    textures: &mut Vec<Texture>,
    warnings: &mut Warnings,
) -> Material {
    let unit = |x: f32| {
        if x.is_finite() {
            x.clamp(0.0, 1.0)
        } else {
            1.0
        }
    };
    let [r, g, b] = item.diffuse.unwrap_or([0.8; 3]).map(unit);
    let alpha = unit(item.dissolve.unwrap_or(1.0));
    let mut material = Material {
        name: Some(item.name.clone()),
        base_color: [r, g, b, alpha],
        ..plain()
    };
    if alpha < 1.0 {
        material.alpha_mode = AlphaMode::Blend;
    }
    if let Some(name) = &item.diffuse_texture {
        // Programs of Windows write its separators.
        let uri = name.replace('\\', "/");
        let image =
            uri::fetch(&uri, base, MAX_FILE).and_then(|bytes| images.add(Cow::Owned(bytes)));
        match image {
            Ok(image) => {
                material.base_color_texture = Some(TextureUse {
                    texture: textures.len() as u32,
                    uv_set: 0,
                    transform: TextureTransform::default(),
                });
                textures.push(Texture {
                    image,
                    sampler: Sampler::default(),
                });
            }
            Err(reason) => {
                let place = format!("newmtl {}/map_Kd", item.name);
                warnings.push(&Fault::new(place, reason).but("the texture is left out"));
            }
        }
    }
    material
}
