//! MTL: base colours, opacities and their maps, for OBJ files.

use std::collections::BTreeSet;

use super::{
    shape::plain,
    text::{keyword, no_number, number, statements, text, words},
    texture_file::{NamedTextures, TextureFiles},
};
use crate::scene::{
    error::{Fault, Warnings},
    material::{AlphaMode, Material, TextureTransform, TextureUse},
};

/// Options of maps.
const OPTIONS: [&[u8]; 13] = [
    b"-blendu",
    b"-blendv",
    b"-bm",
    b"-boost",
    b"-cc",
    b"-clamp",
    b"-imfchan",
    b"-mm",
    b"-o",
    b"-s",
    b"-t",
    b"-texres",
    b"-type",
];

/// A material as its file describes it.
#[derive(Clone, Debug, Default)]
pub struct Description {
    pub name: String,
    /// Folder of the MTL file, relative to that of the scene.
    folder: String,
    /// `Kd`.
    diffuse: Option<[f32; 3]>,
    /// `d`.
    opacity: Option<f32>,
    /// `Tr`.
    transparency: Option<f32>,
    /// `map_Kd`.
    color_map: Option<Map>,
    /// `map_d`.
    opacity_map: Option<Map>,
    /// Statements that are not used.
    unused: BTreeSet<String>,
}

/// An image of a map statement, and its placement.
#[derive(Clone, Debug)]
struct Map {
    file: String,
    transform: TextureTransform,
}

/// Materials of an MTL file in `folder`, which is relative to the folder of the scene.
pub fn parse(mtl: &[u8], folder: &str, warnings: &mut Warnings) -> Vec<Description> {
    let mut materials: Vec<Description> = Vec::new();
    for (_, statement) in statements(mtl) {
        let (word, rest) = keyword(&statement);
        if word.is_empty() || word.starts_with(b"#") {
            continue;
        }
        if word.eq_ignore_ascii_case(b"newmtl") {
            materials.push(Description { name: text(rest), folder: folder.to_owned(), ..Description::default() });
        } else if let Some(material) = materials.last_mut() {
            material.add(word, rest, warnings);
        } else {
            warnings.leave_out("MTL statements before the first newmtl", 1, &text(word));
        }
    }
    materials
}

impl Description {
    /// Adds a statement. Programs differ in the case of its first word.
    fn add(&mut self, word: &[u8], rest: &[u8], warnings: &mut Warnings) {
        let numbers = || words(rest).take_while(|word| !word.starts_with(b"#"));
        let place = format!("newmtl {}/{}", self.name, text(word));
        let mut first = |numbers: &mut dyn Iterator<Item = &[u8]>| {
            let word = numbers.next()?;
            let value = number(word).filter(|x| x.is_finite());
            if value.is_none() {
                let fault = Fault::new(place.clone(), no_number(word));
                warnings.push(&fault.but("the default is used"));
            }
            value.map(|x| x as f32)
        };
        match word.to_ascii_lowercase().as_slice() {
            b"kd" if rest.starts_with(b"spectral") || rest.starts_with(b"xyz") => {
                let kind = text(words(rest).next().unwrap_or_default());
                self.unused.insert(format!("Kd {kind}"));
            }
            b"kd" => {
                let mut components = numbers();
                let mut color = Vec::new();
                for word in components.by_ref().take(3) {
                    match first(&mut [word].into_iter()) {
                        Some(value) => color.push(value),
                        None => return,
                    }
                }
                // Missing components repeat the last one, as the format says.
                self.diffuse = match *color.as_slice() {
                    [] => None,
                    [grey] => Some([grey; 3]),
                    [red, other] => Some([red, other, other]),
                    [red, green, blue, ..] => Some([red, green, blue]),
                };
            }
            b"d" => {
                let mut numbers = numbers().filter(|word| !word.starts_with(b"-h"));
                self.opacity = first(&mut numbers).or(self.opacity);
                if rest.starts_with(b"-h") {
                    self.unused.insert("-halo of d".to_owned());
                }
            }
            b"tr" => self.transparency = first(&mut numbers()).or(self.transparency),
            b"map_kd" => self.color_map = self.map("map_Kd", rest).or(self.color_map.take()),
            b"map_d" => self.opacity_map = self.map("map_d", rest).or(self.opacity_map.take()),
            lower if is_neutral(lower, numbers()) => {}
            _ => {
                self.unused.insert(text(word));
            }
        }
    }

    /// The file and the placement of a map: `-s` multiplies texture coordinates and `-o` adds to them. Other options
    /// are not used. Options stand before the file, and in files of some programs behind it.
    fn map(&mut self, statement: &str, map: &[u8]) -> Option<Map> {
        let mut placement = ([1.0; 2], [0.0; 2]);
        let mut rest = self.options(statement, map.trim_ascii(), &mut placement);
        let is_option = |at: &usize| {
            let is_behind = rest[..*at].ends_with(b" ");
            is_behind && OPTIONS.contains(&keyword(&rest[*at..]).0)
        };
        if let Some(behind) = (1..rest.len()).find(is_option) {
            let (file, options) = rest.split_at(behind);
            self.options(statement, options, &mut placement);
            rest = file.trim_ascii_end();
        }
        let (scale, offset) = placement;
        // In the format v points up.
        let rows = [[scale[0], 0.0, offset[0]], [0.0, scale[1], 1.0 - scale[1] - offset[1]]];
        let is_finite = rows.as_flattened().iter().all(|x| x.is_finite());
        let file = text(rest);
        let file = file.trim_matches('"').to_owned();
        (!file.is_empty()).then(|| Map {
            file,
            transform: if is_finite { TextureTransform(rows) } else { TextureTransform::default() },
        })
    }

    /// Reads options with which a text begins; returns the rest of it.
    fn options<'t>(
        &mut self,
        statement: &str,
        text_of: &'t [u8],
        (scale, offset): &mut ([f32; 2], [f32; 2]),
    ) -> &'t [u8] {
        let mut rest = text_of;
        while rest.starts_with(b"-") {
            let (option, after) = keyword(rest);
            rest = after;
            let (most, are_numbers) = match option {
                b"-o" | b"-s" | b"-t" => (3, true),
                b"-mm" => (2, true),
                _ => (1, false),
            };
            let mut numbers = Vec::new();
            for _ in 0..most {
                let (word, after) = keyword(rest);
                match number(word) {
                    Some(number) => numbers.push(number as f32),
                    None if are_numbers => break,
                    None => {}
                }
                rest = after;
            }
            let place = match option {
                b"-s" => &mut *scale,
                b"-o" => &mut *offset,
                _ => {
                    self.unused.insert(format!("{} of {statement}", text(option)));
                    continue;
                }
            };
            place.iter_mut().zip(numbers).for_each(|(to, x)| *to = x);
        }
        rest
    }

    /// The material, and its textures among `textures`.
    pub fn read(&self, textures: &mut NamedTextures<'_>, warnings: &mut Warnings) -> Material {
        for unused in &self.unused {
            warnings.leave_out("MTL statements", 1, unused);
        }
        let place = |statement: &str| format!("newmtl {}/{statement}", self.name);
        let mut unit = |x: f32, statement: &str| {
            let clamped = x.clamp(0.0, 1.0);
            if clamped != x {
                let reason = format!("{x} is not within 0 to 1, and {clamped} is used");
                warnings.push(&Fault::new(place(statement), reason));
            }
            clamped
        };
        let color = match (self.diffuse, &self.color_map) {
            // Programs write black beside a map, and users expect the map's colours (docs/decisions.md).
            (Some([0.0, 0.0, 0.0]) | None, Some(_)) => [1.0; 3],
            (None, None) => [0.8; 3],
            (Some(color), _) => color.map(|x| unit(x, "Kd")),
        };
        let alpha = match (self.opacity, self.transparency) {
            (Some(opacity), _) => unit(opacity, "d"),
            (None, Some(1.0)) => {
                let reason =
                    "1 would make the material invisible. Some programs mean its opacity, so that it is opaque";
                warnings.push(&Fault::new(place("Tr"), reason));
                1.0
            }
            (None, Some(transparency)) => 1.0 - unit(transparency, "Tr"),
            (None, None) => 1.0,
        };
        let mut material =
            Material { name: Some(self.name.clone()), base_color: [color[0], color[1], color[2], alpha], ..plain() };
        self.add_textures(&mut material, textures, warnings);
        if alpha < 1.0 {
            material.alpha_mode = AlphaMode::Blend;
        }
        material
    }

    fn add_textures(&self, material: &mut Material, textures: &mut NamedTextures<'_>, warnings: &mut Warnings) {
        let mut color = self.color_map.as_ref();
        let mut opacity = self.opacity_map.as_ref();
        if let (Some(a), Some(b)) = (color, opacity)
            && a.transform != b.transform
        {
            warnings.leave_out("placements of map_d that differ from that of map_Kd", 1, &b.file);
        }
        // If one of the images is missing, the other is used alone.
        while let Some(map) = color.or(opacity) {
            let files = TextureFiles {
                folder: self.folder.clone(),
                color: color.map(|map| map.file.clone()),
                alpha: opacity.map(|map| map.file.clone()),
            };
            let fault = match textures.get(files) {
                Ok(texture) => {
                    material.base_color_texture = Some(TextureUse { texture, uv_set: 0, transform: map.transform });
                    if opacity.is_some() {
                        material.alpha_mode = match textures.is_cutout(texture) {
                            true => AlphaMode::Mask { cutoff: 0.5 },
                            false => AlphaMode::Blend,
                        };
                    }
                    return;
                }
                Err(fault) => fault,
            };
            let is_color = color.take_if(|map| map.file == fault.file).is_some();
            if !is_color {
                opacity = None;
            }
            let statement = if is_color { "map_Kd" } else { "map_d" };
            fault.report(&format!("newmtl {}/{statement}", self.name), warnings);
        }
    }
}

/// Whether a statement has no effect by its value: no light of that kind, no filter, no change.
fn is_neutral<'w>(lower: &[u8], mut numbers: impl Iterator<Item = &'w [u8]>) -> bool {
    let neutral: &[f64] = match lower {
        b"ka" | b"ks" | b"ke" | b"ps" | b"pc" | b"pcr" | b"aniso" | b"anisor" => &[0.0],
        b"tf" | b"ni" => &[1.0],
        // Without highlights, and with them.
        b"illum" => &[1.0, 2.0],
        _ => return false,
    };
    numbers.all(|word| number(word).is_some_and(|x| neutral.contains(&x)))
}
