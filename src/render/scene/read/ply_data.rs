//! Elements and properties of PLY files, as text or in binary.

use super::text::{broken, no_number, number, text, words};
use crate::scene::error::{Fault, Warnings};

/// Type of a number in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Type {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Type {
    fn named(name: &[u8]) -> Option<Self> {
        Some(match name {
            b"char" | b"int8" => Self::I8,
            b"uchar" | b"uint8" => Self::U8,
            b"short" | b"int16" => Self::I16,
            b"ushort" | b"uint16" => Self::U16,
            b"int" | b"int32" => Self::I32,
            b"uint" | b"uint32" => Self::U32,
            b"float" | b"float32" => Self::F32,
            b"double" | b"float64" => Self::F64,
            _ => return None,
        })
    }

    /// Value that stands for 1 in a colour of this type.
    pub fn full(self) -> f64 {
        match self {
            Self::I8 => 127.0,
            Self::U8 | Self::I32 | Self::U32 => 255.0,
            Self::I16 => 32_767.0,
            Self::U16 => 65_535.0,
            Self::F32 | Self::F64 => 1.0,
        }
    }
}

/// A property of an element: a number, or a list of numbers.
#[derive(Debug)]
pub struct Property {
    pub name: String,
    pub kind: Type,
    /// Type of a list's length.
    pub length: Option<Type>,
}

/// A kind of elements of a file.
#[derive(Debug)]
pub struct Element {
    pub name: String,
    pub count: usize,
    pub properties: Vec<Property>,
}

impl Element {
    /// Index of the first property with one of these names that is a number.
    pub fn number(&self, names: &[&str]) -> Option<usize> {
        let is = |p: &Property| p.length.is_none() && names.contains(&p.name.as_str());
        self.properties.iter().position(is)
    }

    /// Index of the first property with one of these names that is a list.
    pub fn list(&self, names: &[&str]) -> Option<usize> {
        let is = |p: &Property| p.length.is_some() && names.contains(&p.name.as_str());
        self.properties.iter().position(is)
    }
}

/// Values of the properties of one element.
#[derive(Debug, Default)]
pub struct Row {
    values: Vec<f64>,
    /// End of each property's values.
    ends: Vec<usize>,
}

impl Row {
    /// Values of a property.
    pub fn list(&self, property: Option<usize>) -> &[f64] {
        let Some(property) = property else {
            return &[];
        };
        let before = property.checked_sub(1);
        let start = before.map_or(0, |before| self.ends[before]);
        &self.values[start..self.ends[property]]
    }

    /// Value of a property.
    pub fn number(&self, property: usize) -> f64 {
        self.list(Some(property)).first().copied().unwrap_or(f64::NAN)
    }
}

/// Encoding of the elements.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Encoding {
    Text,
    LittleEndian,
    BigEndian,
}

/// Elements of a file, which are read in their order.
pub struct Data<'b> {
    pub elements: Vec<Element>,
    /// Images that comments name, as MeshLab writes them.
    pub textures: Vec<String>,
    encoding: Encoding,
    bytes: &'b [u8],
    /// Index of the next byte that is read.
    at: usize,
}

impl<'b> Data<'b> {
    /// Reads the header.
    pub fn new(bytes: &'b [u8], warnings: &mut Warnings) -> Result<Self, Fault> {
        // All lines of a header end as the first does. Only so it is clear where binary data begin.
        let is_cr = bytes.get(3) == Some(&b'\r') && bytes.get(4) != Some(&b'\n');
        let end = if is_cr { b'\r' } else { b'\n' };
        let mut encoding = None;
        let mut data = Self { elements: Vec::new(), textures: Vec::new(), encoding: Encoding::Text, bytes, at: 0 };
        for line in 1.. {
            let rest = &bytes[data.at..];
            let Some(length) = rest.iter().position(|byte| *byte == end) else {
                return Err(broken("PLY", format!("line {line}"), "its header does not end"));
            };
            data.at += length + 1;
            let statement = &rest[..length];
            let mut words = words(statement);
            let fault = |reason: &str| broken("PLY", format!("line {line}"), reason);
            match words.next() {
                Some(b"end_header") => break,
                Some(b"format") => {
                    encoding = Some(match words.next() {
                        Some(b"ascii") => Encoding::Text,
                        Some(b"binary_little_endian") => Encoding::LittleEndian,
                        Some(b"binary_big_endian") => Encoding::BigEndian,
                        other => {
                            let name = text(other.unwrap_or_default());
                            return Err(fault(&format!("\"{name}\" is no format")));
                        }
                    });
                }
                Some(b"element") => {
                    let (name, count) = (words.next(), words.next());
                    let count = count.and_then(|word| text(word).parse().ok());
                    let (Some(name), Some(count)) = (name, count) else {
                        return Err(fault("an element needs a name and a count"));
                    };
                    data.elements.push(Element { name: text(name), count, properties: Vec::new() });
                }
                Some(b"property") => {
                    let Some(element) = data.elements.last_mut() else {
                        return Err(fault("there is a property before the first element"));
                    };
                    let property = property(&mut words).map_err(|reason| fault(&reason))?;
                    element.properties.push(property);
                }
                Some(b"comment") => {
                    let comment = text(statement.trim_ascii());
                    let named = comment["comment".len()..].trim_start();
                    let named = named.strip_prefix("TextureFile").map(str::trim);
                    let named = named.filter(|name| !name.is_empty());
                    data.textures.extend(named.map(str::to_owned));
                }
                Some(b"ply") if line == 1 => {}
                Some(b"obj_info") | None => {}
                Some(other) => warnings.leave_out("header lines", 1, &text(other)),
            }
        }
        data.encoding = encoding.ok_or_else(|| broken("PLY", "header", "it names no format"))?;
        data.check()?;
        Ok(data)
    }

    /// Fails if an element claims more entries than the file can hold, with at least a byte for each.
    fn check(&self) -> Result<(), Fault> {
        for Element { name, count, properties } in &self.elements {
            let place = format!("element {name}");
            if *count > 0 && properties.is_empty() {
                return Err(Fault::new(place, "has no properties"));
            }
            if *count > self.bytes.len() {
                let bytes = self.bytes.len();
                let reason = format!("claims {count} elements, but the file has {bytes} bytes");
                return Err(Fault::new(place, reason));
            }
        }
        Ok(())
    }

    /// Reads the elements with this index, which have to be the next ones.
    pub fn read(&mut self, index: usize, each: impl FnMut(&Row)) -> Result<(), Fault> {
        let elements = std::mem::take(&mut self.elements);
        let result = elements.get(index).map_or(Ok(()), |element| match self.encoding {
            Encoding::Text => self.read_rows(element, each, |data, _| data.read_word()),
            Encoding::LittleEndian => self.read_rows(element, each, |data, kind| data.read_binary::<false>(kind)),
            Encoding::BigEndian => self.read_rows(element, each, |data, kind| data.read_binary::<true>(kind)),
        });
        self.elements = elements;
        result.map_err(|reason: String| broken("PLY", self.place(), &reason))
    }

    /// Reads elements whose numbers `next` reads.
    fn read_rows(
        &mut self,
        element: &Element,
        mut each: impl FnMut(&Row),
        mut next: impl FnMut(&mut Self, Type) -> Result<f64, String>,
    ) -> Result<(), String> {
        let mut row = Row::default();
        for _ in 0..element.count {
            row.values.clear();
            row.ends.clear();
            for property in &element.properties {
                let mut count = 1;
                if let Some(kind) = property.length {
                    let length = next(self, kind)?;
                    let is_length = length.fract() == 0.0 && (0.0..=1e15).contains(&length);
                    if !is_length || length > (self.bytes.len() - self.at) as f64 {
                        let name = &property.name;
                        let claim = format!("a list {name} claims {length} numbers");
                        return Err(format!("{claim}, which are not there"));
                    }
                    count = length as usize;
                }
                for _ in 0..count {
                    row.values.push(next(self, property.kind)?);
                }
                row.ends.push(row.values.len());
            }
            each(&row);
        }
        Ok(())
    }

    /// Number of bytes behind the elements.
    pub fn rest(&self) -> usize {
        let rest = self.bytes.get(self.at..).unwrap_or_default();
        rest.trim_ascii().len()
    }

    /// The place of the next byte.
    fn place(&self) -> String {
        match self.encoding {
            Encoding::Text => {
                let before = self.bytes[..self.at].iter();
                let lines = before.filter(|byte| **byte == b'\n').count();
                format!("line {}", lines + 1)
            }
            _ => format!("byte {}", self.at),
        }
    }

    fn read_word(&mut self) -> Result<f64, String> {
        let rest = &self.bytes[self.at..];
        let start = rest.iter().position(|byte| !byte.is_ascii_whitespace());
        let Some(start) = start else {
            self.at = self.bytes.len();
            return Err(ENDS.to_owned());
        };
        let rest = &rest[start..];
        let end = rest.iter().position(u8::is_ascii_whitespace);
        let word = &rest[..end.unwrap_or(rest.len())];
        self.at += start;
        let number = number(word).ok_or_else(|| no_number(word))?;
        self.at += word.len();
        Ok(number)
    }

    #[inline]
    fn read_binary<const BIG: bool>(&mut self, kind: Type) -> Result<f64, String> {
        match kind {
            Type::I8 => self.take::<BIG, 1>(|b| i8::from_le_bytes(b).into()),
            Type::U8 => self.take::<BIG, 1>(|b| u8::from_le_bytes(b).into()),
            Type::I16 => self.take::<BIG, 2>(|b| i16::from_le_bytes(b).into()),
            Type::U16 => self.take::<BIG, 2>(|b| u16::from_le_bytes(b).into()),
            Type::I32 => self.take::<BIG, 4>(|b| i32::from_le_bytes(b).into()),
            Type::U32 => self.take::<BIG, 4>(|b| u32::from_le_bytes(b).into()),
            Type::F32 => self.take::<BIG, 4>(|b| f32::from_le_bytes(b).into()),
            Type::F64 => self.take::<BIG, 8>(f64::from_le_bytes),
        }
    }

    /// The next `N` bytes as a number, which `convert` makes of them in little-endian order.
    #[inline]
    fn take<const BIG: bool, const N: usize>(&mut self, convert: impl Fn([u8; N]) -> f64) -> Result<f64, String> {
        let bytes = self.bytes[self.at..].first_chunk::<N>();
        let mut bytes = *bytes.ok_or(ENDS)?;
        self.at += N;
        if BIG {
            bytes.reverse();
        }
        Ok(convert(bytes))
    }
}

/// Reason to refuse a file that is too short.
const ENDS: &str = "it ends within its elements";

fn property<'w>(words: &mut impl Iterator<Item = &'w [u8]>) -> Result<Property, String> {
    let mut next = || words.next().unwrap_or_default();
    let kind_of = |word: &[u8]| Type::named(word).ok_or_else(|| format!("\"{}\" is no type", text(word)));
    let first = next();
    let (length, kind) = match first {
        b"list" => (Some(kind_of(next())?), kind_of(next())?),
        _ => (None, kind_of(first)?),
    };
    let name = text(next());
    if name.is_empty() {
        return Err("a property has no name".to_owned());
    }
    Ok(Property { name, kind, length })
}
