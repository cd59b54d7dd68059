//! OBJ: polygons, lines and points, with the base colours of its MTL files. A file without polygons, lines and points
//! shows its vertices as points.

use std::{
    collections::{BTreeSet, HashMap},
    path::Path,
};

use glam::DVec3;

use super::{
    mtl::{self, Description},
    obj_part::{Corner, Part, Pool, Welder},
    shape::{Drawing, origin_of, plain},
    text::{self, broken, keyword, no_number, number, statements, words},
    texture_file::{NamedTextures, fetch},
    uri,
};
use crate::scene::error::{Fault, Warnings};

/// Statements with which OBJ files start, apart from comments.
const STATEMENTS: [&[u8]; 12] = [b"v", b"vt", b"vn", b"vp", b"o", b"g", b"s", b"f", b"l", b"p", b"mtllib", b"usemtl"];

/// Whether `bytes` look like an OBJ file: it begins with a statement of the format, and has a vertex.
pub fn is_obj(bytes: &[u8]) -> bool {
    let mut words =
        statements(bytes).map(|(_, statement)| keyword(&statement).0.to_vec()).filter(|word| !word.is_empty());
    let first = words.find(|word| !word.starts_with(b"#"));
    let Some(first) = first.filter(|word| STATEMENTS.contains(&word.as_slice())) else {
        return false;
    };
    first == b"v" || words.any(|word| word == b"v")
}

/// Reads an OBJ file; files that it names are in the folder `base`.
pub fn read(bytes: &[u8], base: Option<&Path>, warnings: &mut Warnings) -> Result<Drawing, Fault> {
    let mut reader = Reader::default();
    for (line, statement) in statements(bytes) {
        reader.add(&statement, line, warnings).map_err(|reason| broken("OBJ", format!("line {line}"), &reason))?;
    }
    reader.check()?;
    reader.into_drawing(base, warnings)
}

/// Elements to which indices refer, in the order of a face's corner.
const NAMED: [&str; 3] = ["vertex", "texture coordinate", "normal"];

fn out_of_range(kind: usize, index: i64, count: usize) -> String {
    let name = NAMED[kind];
    format!("{name} {index} is named, and there are {count}, counted from 1")
}

/// Contents of a file, while it is read. Faces may name elements that come after them.
#[derive(Default)]
struct Reader {
    pool: Pool,
    parts: Vec<Part>,
    part: Part,
    /// Largest index of each kind of element that was named, and its line.
    largest: [(i64, usize); 3],
    /// Names of materials, and their indices in the order in which they appear.
    materials: HashMap<String, u32>,
    /// Operands of `mtllib`.
    libraries: Vec<String>,
    /// Names of smoothing groups, and their numbers.
    groups: HashMap<Vec<u8>, u32>,
    /// Largest component of a vertex colour.
    largest_code: f32,
}

impl Reader {
    /// Adds a statement. The error is a reason without the place.
    fn add(&mut self, statement: &[u8], line: usize, warnings: &mut Warnings) -> Result<(), String> {
        let (word, rest) = keyword(statement);
        match word {
            b"v" => self.add_vertex(rest, warnings)?,
            b"vt" => {
                let [u, v, w] = numbers(rest, 1)?.1;
                self.pool.uvs.push([u as f32, v as f32]);
                warnings.leave_out("third texture coordinates", usize::from(w != 0.0), "");
            }
            b"vn" => {
                let normal = numbers::<3>(rest, 3)?.1;
                self.pool.normals.push(normal.map(|x| x as f32));
            }
            b"f" | b"fo" => {
                for word in operands(rest) {
                    let corner = self.corner(word, line)?;
                    self.part.corners.push(corner);
                }
                self.part.ends.push(self.part.corners.len());
            }
            b"l" => {
                let mut before = None;
                for word in operands(rest) {
                    let corner = self.corner(word, line)?;
                    self.part.lines.extend(before.map(|before| [before, corner]));
                    before = Some(corner);
                }
            }
            b"p" => {
                for word in operands(rest) {
                    let corner = self.corner(word, line)?;
                    self.part.points.push(corner);
                }
            }
            b"o" | b"g" => {
                self.begin_part();
                self.part.name = Some(text::text(rest)).filter(|name| !name.is_empty());
            }
            b"usemtl" => {
                let name = unquoted(rest);
                let next = self.materials.len() as u32;
                let material = Some(*self.materials.entry(name).or_insert(next));
                if self.part.material != material {
                    self.begin_part();
                    self.part.material = material;
                }
            }
            b"mtllib" => self.libraries.push(text::text(rest)),
            b"s" => {
                let group = match rest {
                    b"off" | b"0" | b"" => None,
                    name => {
                        let next = self.groups.len() as u32;
                        Some(*self.groups.entry(name.to_owned()).or_insert(next))
                    }
                };
                self.part.set_smoothing(group);
            }
            b"" => {}
            comment if comment.starts_with(b"#") => {}
            other => {
                let shown = text::text(&other[..other.len().min(24)]);
                warnings.leave_out("OBJ statements", 1, &shown);
            }
        }
        Ok(())
    }

    /// Begins another part with the name and the material of the present one, unless that is empty.
    fn begin_part(&mut self) {
        if self.part.is_empty() {
            return;
        }
        let next = Part {
            name: self.part.name.clone(),
            material: self.part.material,
            smoothing: self.part.present_smoothing(),
            ..Part::default()
        };
        self.parts.push(std::mem::replace(&mut self.part, next));
    }

    /// Adds a vertex: x, y and z; then its weight in curves, or a colour.
    fn add_vertex(&mut self, rest: &[u8], warnings: &mut Warnings) -> Result<(), String> {
        let (count, [x, y, z, a, b, c, d]) = numbers(rest, 3)?;
        self.pool.positions.push(DVec3::new(x, y, z));
        match count {
            4 => warnings.leave_out("weights of vertices", usize::from(a != 1.0), ""),
            6.. => {
                let color = [a, b, c].map(|x| x as f32);
                let is_number = color.iter().all(|x| x.is_finite());
                warnings.leave_out("undefined colours of vertices", usize::from(!is_number), "");
                self.largest_code = color.into_iter().fold(self.largest_code, f32::max);
                let before = self.pool.positions.len() - 1;
                self.pool.colors.resize(before, [1.0; 3]);
                self.pool.colors.push(color);
                let is_alpha = count > 6 && d != 1.0;
                warnings.leave_out("seventh numbers of vertices", usize::from(is_alpha), "");
            }
            _ => {}
        }
        Ok(())
    }

    /// A corner, written `vertex/texture coordinate/normal`; the last two may be missing.
    fn corner(&mut self, word: &[u8], line: usize) -> Result<Corner, String> {
        let mut named = [Corner::NONE; 3];
        let mut parts = word.split(|&byte| byte == b'/');
        let no_corner = || format!("\"{}\" names no corner", text::text(&word[..word.len().min(40)]));
        for (kind, place) in named.iter_mut().enumerate() {
            let Some(part) = parts.next() else { break };
            if part.is_empty() {
                continue;
            }
            let index = integer(part).ok_or_else(no_corner)?;
            *place = self.resolve(kind, index, line)?;
        }
        if named[0] == Corner::NONE || parts.next().is_some() {
            return Err(no_corner());
        }
        Ok(Corner(named))
    }

    /// Index from 0 of an element that is named by its number from 1, or by how far before the statement it stands.
    fn resolve(&mut self, kind: usize, index: i64, line: usize) -> Result<u32, String> {
        let count = self.pool.counts()[kind];
        let resolved = match index {
            1.. => {
                if index > self.largest[kind].0 {
                    self.largest[kind] = (index, line);
                }
                u32::try_from(index - 1).unwrap_or(Corner::NONE - 1)
            }
            // The corner has neither a texture coordinate nor a normal.
            0 if kind > 0 => Corner::NONE,
            // Indices to a kind of element that the file lacks are ignored.
            ..0 if kind > 0 && count == 0 => Corner::NONE,
            _ => {
                let back = usize::try_from(index.unsigned_abs()).unwrap_or(usize::MAX);
                let found = count.checked_sub(back).filter(|_| back > 0);
                found.ok_or_else(|| out_of_range(kind, index, count))? as u32
            }
        };
        Ok(resolved)
    }

    /// Fails if an element is named that the file lacks.
    fn check(&self) -> Result<(), Fault> {
        for (kind, count) in self.pool.counts().into_iter().enumerate() {
            let (index, line) = self.largest[kind];
            let is_ignored = kind > 0 && count == 0;
            if index > count as i64 && !is_ignored {
                return Err(broken("OBJ", format!("line {line}"), &out_of_range(kind, index, count)));
            }
        }
        Ok(())
    }

    fn into_drawing(mut self, base: Option<&Path>, warnings: &mut Warnings) -> Result<Drawing, Fault> {
        self.begin_part();
        let lacking = (1..3).filter(|kind| self.pool.counts()[*kind] == 0);
        for kind in lacking.filter(|kind| self.largest[*kind].0 > 0) {
            warnings.leave_out("elements that corners name and the file lacks", 1, NAMED[kind]);
        }
        let mut pool = std::mem::take(&mut self.pool);
        pool.finish(self.largest_code);
        let origin = origin_of(pool.used(&self.parts));
        pool.smooth(&mut self.parts, origin);

        let mut textures = NamedTextures::new(base);
        let (described, is_complete) = self.read_libraries(base, warnings);
        let by_name = described.iter().enumerate();
        let by_name: HashMap<&str, usize> = by_name.map(|(i, it)| (it.name.as_str(), i)).collect();
        let mut materials: Vec<_> = described.iter().map(|it| it.read(&mut textures, warnings)).collect();
        // Materials of parts without one: grey, or white if the vertices have colours.
        let mut grey = plain();
        if !pool.colors.is_empty() {
            grey.base_color = [1.0; 4];
        }
        let unnamed = materials.len();
        materials.push(grey);
        let mut places = vec![unnamed; self.materials.len()];
        let mut unknown = BTreeSet::new();
        for (name, index) in &self.materials {
            match by_name.get(name.as_str()) {
                Some(place) => places[*index as usize] = *place,
                // A file without a name means no material.
                None if name.is_empty() => {}
                None => drop(unknown.insert(name)),
            }
        }
        // If an MTL file is missing, a warning says so.
        if is_complete {
            for name in unknown {
                warnings.leave_out("materials that no MTL file has", 1, name);
            }
        }
        let (textures, images) = textures.into_parts();
        let mut drawing = Drawing { origin, materials, textures, images, ..Drawing::default() };
        if self.parts.is_empty() {
            drawing.shapes.push(pool.cloud(drawing.origin, unnamed));
        }
        let mut welder = Welder::new(&pool, drawing.origin);
        for part in &self.parts {
            let material = part.material.map_or(unnamed, |index| places[index as usize]);
            drawing.shapes.extend(welder.shapes(part, material, warnings)?);
        }
        Ok(drawing)
    }

    /// The materials of all MTL files, and whether no file is missing.
    fn read_libraries(&self, base: Option<&Path>, warnings: &mut Warnings) -> (Vec<Description>, bool) {
        let mut described = Vec::new();
        let mut is_complete = true;
        let mut known = BTreeSet::new();
        for library in &self.libraries {
            // Names have blanks, and a statement may name several files.
            let whole = unquoted(library.as_bytes());
            let names = match fetch(&whole, "", base) {
                Err(_) if whole.contains(char::is_whitespace) => several(library),
                _ => vec![whole],
            };
            for name in names {
                // A file counts once, however it is named.
                if !known.insert(uri::identity(&name.replace('\\', "/"), base).into_owned()) {
                    continue;
                }
                match fetch(&name, "", base) {
                    Ok(bytes) => {
                        let path = name.replace('\\', "/");
                        let folder = path.rsplit_once('/').map_or("", |(folder, _)| folder);
                        described.extend(mtl::parse(&text::utf8(&bytes), folder, warnings));
                    }
                    Err(reason) => {
                        let fault = Fault::new(format!("mtllib {name}"), reason);
                        warnings.push(&fault.but("its materials are grey"));
                        is_complete = false;
                    }
                }
            }
        }
        (described, is_complete)
    }
}

/// Names in a list, of which some may be in quotes.
fn several(list: &str) -> Vec<String> {
    let mut names = Vec::new();
    for (index, part) in list.split('"').enumerate() {
        if index % 2 == 1 {
            names.push(part.to_owned());
        } else {
            names.extend(part.split_whitespace().map(str::to_owned));
        }
    }
    names
}

/// A name without the quotes around it.
fn unquoted(name: &[u8]) -> String {
    let name = text::text(name);
    let inner = name.strip_prefix('"').and_then(|name| name.strip_suffix('"'));
    inner.filter(|inner| !inner.contains('"')).unwrap_or(&name).to_owned()
}

/// Operands of a statement, without a comment behind them.
fn operands(rest: &[u8]) -> impl Iterator<Item = &[u8]> {
    words(rest).take_while(|word| !word.starts_with(b"#"))
}

/// The first numbers of a statement, and how many there are. Those that are missing are zero, and at least `least` must
/// be there.
fn numbers<const N: usize>(rest: &[u8], least: usize) -> Result<(usize, [f64; N]), String> {
    let (mut count, mut found) = (0, [0.0; N]);
    for (place, word) in found.iter_mut().zip(operands(rest)) {
        *place = number(word).ok_or_else(|| no_number(word))?;
        count += 1;
    }
    if count < least {
        return Err(format!("{least} numbers are needed, and there are {count}"));
    }
    Ok((count, found))
}

/// A whole number.
fn integer(word: &[u8]) -> Option<i64> {
    let digits = word.strip_prefix(b"-").or_else(|| word.strip_prefix(b"+"));
    let is_negative = word.starts_with(b"-");
    let digits = digits.unwrap_or(word);
    if digits.is_empty() {
        return None;
    }
    let magnitude = digits.iter().try_fold(0_i64, |sum, byte| {
        let digit = i64::from(byte.checked_sub(b'0').filter(|digit| *digit < 10)?);
        sum.checked_mul(10)?.checked_add(digit)
    });
    magnitude.map(|magnitude| if is_negative { -magnitude } else { magnitude })
}
