//! OBJ: polygons, lines and points, with the base colours of its MTL files.

use std::{
    borrow::Cow,
    cell::RefCell,
    panic::{AssertUnwindSafe, catch_unwind},
    path::Path,
};

use gltf::json::mesh::Mode;
use tobj::{LoadError, LoadOptions};

use super::{
    image::DecodedImages,
    obj_fault,
    shape::{Drawing, FileObject, linear, plain},
    uri,
};
use crate::scene::{
    Loaded, SceneError,
    error::{Fault, Warnings},
    material::{AlphaMode, Material, Sampler, Texture, TextureTransform, TextureUse},
};

/// Largest number of bytes of an MTL file, and of an image that it names.
const MAX_FILE: u64 = 1 << 30;

/// Statements with which OBJ files start, apart from comments.
const STATEMENTS: [&[u8]; 12] = [
    b"v", b"vt", b"vn", b"vp", b"o", b"g", b"s", b"f", b"l", b"p", b"mtllib", b"usemtl",
];

/// Whether `bytes` look like an OBJ file: it begins with a statement of the format, and has a vertex.
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

/// Reads an OBJ file; files that it names are in the folder `base`.
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
        let fetched = uri::fetch(&name, base, MAX_FILE).map(|file| file.bytes);
        let fetched = fetched.map_err(|reason| (reason, LoadError::OpenFileFailed));
        let parsed = fetched.and_then(|bytes| {
            tobj::load_mtl_buf(&mut complete_colours(&plain_text(&bytes)).as_slice())
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
    let parse =
        |text: &[u8], options: &LoadOptions, load_mtl: &dyn Fn(&Path) -> tobj::MTLLoadResult| {
            // With overflow checks, the parser panics at an index before the first vertex.
            let parse = || tobj::load_obj_buf(&mut &*text, options, load_mtl);
            let loaded = catch_unwind(AssertUnwindSafe(parse));
            loaded
                .unwrap_or(Err(LoadError::GenericFailure))
                .map_err(|error| {
                    let unplaced = || {
                        let reason = format!("the OBJ file is broken: {error}; export it again");
                        Fault::new("statements", reason)
                    };
                    let found = obj_fault::find(bytes);
                    found.unwrap_or_else(unplaced).into_error(file)
                })
        };
    let text = plain_text(bytes);
    let (faces, strokes) = split(&text);
    let (models, materials) = parse(&faces, &options, &load_mtl)?;
    let mut warnings = Warnings::new(file);
    warnings.extend(faults.take());
    let strokes = match strokes {
        Some(text) => {
            let options = LoadOptions {
                ignore_points: false,
                ignore_lines: false,
                ..options
            };
            // The MTL files have the same faults as in the first parse, which has reported them.
            let (mut models, _) = parse(&text, &options, &load_mtl)?;
            models.retain(|model| !model.mesh.indices.is_empty());
            models
        }
        None => Vec::new(),
    };

    let mut drawing = Drawing::default();
    let mut images = DecodedImages::default();
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
    // Index of the material for shapes without one.
    let grey = drawing.materials.len();
    drawing.materials.push(plain());
    let models = models.into_iter().map(|model| (model, false));
    let strokes = strokes.into_iter().map(|model| (model, true));
    for (tobj::Model { mesh, name }, is_strokes) in models.chain(strokes) {
        let corners: &[[u32; 3]] = mesh.indices.as_chunks().0;
        let triangles = if is_strokes { &[] } else { corners };
        let pairs = corners.iter().map(|&[a, b, _]| [a, b]);
        let (points, lines) = pairs.filter(|_| is_strokes).partition(|[a, b]| a == b);
        let points: Vec<[u32; 2]> = points;
        drawing.shapes.push(FileObject {
            name: Some(name),
            material: mesh.material_id.unwrap_or(grey),
            triangles: triangles.to_vec(),
            lines,
            points: points.into_iter().map(|[point, _]| point).collect(),
            positions: mesh.positions.as_chunks().0.to_vec(),
            normals: mesh.normals.as_chunks().0.to_vec(),
            uvs: mesh.texcoords.as_chunks().0.to_vec(),
            colors: opaque(&mesh.vertex_color),
        });
    }
    drawing.into_scene("OBJ", file, warnings)
}

/// Text that the parser can read: Unicode, with invalid bytes replaced so that they aren't part of a number, and with
/// each statement in a line of its own.
fn plain_text(bytes: &[u8]) -> Vec<u8> {
    let text = String::from_utf8_lossy(bytes);
    text.replace("\\\r\n", " ")
        .replace("\\\n", " ")
        .into_bytes()
}

/// An OBJ file's text without lines and points, and the text without faces if it has lines or points. The parser takes
/// a line of three vertices for a face, and knows no points; in the second text each line has two vertices, and a
/// point one.
fn split(obj: &[u8]) -> (Cow<'_, [u8]>, Option<Vec<u8>>) {
    let lines = || obj.split(|&byte| byte == b'\n');
    let words = |line: &'_ [u8]| -> Vec<Vec<u8>> {
        let words = line.split(u8::is_ascii_whitespace);
        words
            .filter(|word| !word.is_empty())
            .map(<[u8]>::to_vec)
            .collect()
    };
    let kind = |line: &[u8]| {
        let mut words = line.split(u8::is_ascii_whitespace);
        match words.find(|word| !word.is_empty()) {
            Some(b"l") => Some(Mode::Lines),
            Some(b"p") => Some(Mode::Points),
            Some(b"f") => Some(Mode::Triangles),
            _ => None,
        }
    };
    let is_stroke = |line: &&[u8]| matches!(kind(line), Some(Mode::Lines | Mode::Points));
    if !lines().any(|line| is_stroke(&line)) {
        return (Cow::Borrowed(obj), None);
    }
    let faces: Vec<&[u8]> = lines().filter(|line| !is_stroke(line)).collect();
    let mut strokes: Vec<Vec<u8>> = Vec::new();
    for line in lines() {
        let per_line = match kind(line) {
            Some(Mode::Lines) => 2,
            Some(Mode::Points) => 1,
            Some(_) => continue,
            None => {
                strokes.push(line.to_vec());
                continue;
            }
        };
        let words = words(line);
        let vertices = words.get(1..).unwrap_or(&[]).windows(per_line);
        strokes.extend(vertices.map(|ends| [b"l ", ends.join(&b' ').as_slice()].concat()));
    }
    (Cow::Owned(faces.join(&b'\n')), Some(strokes.join(&b'\n')))
}

/// An MTL file whose colours all have three components, without which the parser panics. Missing components repeat the
/// last one, as the format says.
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

/// Vertex colours with an alpha of 1, because the format has none.
fn opaque(colors: &[f32]) -> Vec<[f32; 4]> {
    let (colors, _) = colors.as_chunks();
    let opaque = |color: &[f32; 3]| {
        let [r, g, b] = color.map(|x| linear(x.into()));
        [r, g, b, 1.0]
    };
    colors.iter().map(opaque).collect()
}

/// Name of the file in a map statement, and its placement: `-s` multiplies coordinates and `-o` adds to them. Other
/// options don't affect a base colour.
fn placed(map: &str) -> (&str, TextureTransform) {
    let (mut scale, mut offset) = ([1.0; 2], [0.0; 2]);
    let mut rest = map.trim();
    let next = |text: &'_ str| -> Option<(String, usize)> {
        let word = text.split_ascii_whitespace().next()?;
        let start = text.find(word)?;
        Some((word.to_owned(), start + word.len()))
    };
    while rest.trim_start().starts_with('-') {
        let Some((option, end)) = next(rest) else {
            break;
        };
        rest = &rest[end..];
        let (most, are_numbers) = match option.as_str() {
            "-o" | "-s" | "-t" => (3, true),
            "-mm" => (2, true),
            _ => (1, false),
        };
        let mut numbers = Vec::new();
        for _ in 0..most {
            let Some((word, end)) = next(rest) else {
                break;
            };
            match word.parse::<f32>() {
                Ok(number) => numbers.push(number),
                Err(_) if are_numbers => break,
                Err(_) => {}
            }
            rest = &rest[end..];
        }
        let place = match option.as_str() {
            "-s" => &mut scale,
            "-o" => &mut offset,
            _ => continue,
        };
        place.iter_mut().zip(numbers).for_each(|(to, x)| *to = x);
    }
    // In the format v points up.
    let rows = [
        [scale[0], 0.0, offset[0]],
        [0.0, scale[1], 1.0 - scale[1] - offset[1]],
    ];
    let is_finite = rows.as_flattened().iter().all(|x| x.is_finite());
    let transform = is_finite.then_some(TextureTransform(rows));
    (rest.trim(), transform.unwrap_or_default())
}

fn read_material(
    item: &tobj::Material,
    base: Option<&Path>,
    images: &mut DecodedImages,
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
        let (name, transform) = placed(name);
        // Programs on Windows write backslashes.
        let uri = name.replace('\\', "/");
        let image =
            uri::fetch(&uri, base, MAX_FILE).and_then(|file| images.add(Cow::Owned(file.bytes)));
        match image {
            Ok(image) => {
                material.base_color_texture = Some(TextureUse {
                    texture: textures.len() as u32,
                    uv_set: 0,
                    transform,
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
