//! Samples as NPY arrays (numpy.lib.format, versions 1 to 3).

use super::table::{COLUMNS, Locations, SampleRow};

const MAGIC: &[u8] = b"\x93NUMPY";

/// Alignment of the data in bytes.
const ALIGNMENT: usize = 64;

/// Reads locations: an array of N x 2 (u, v) or N x 4 (u, v, row, column), float32 or float64.
pub fn read(bytes: &[u8]) -> Result<Locations, String> {
    let broken = || "it is no NPY file, or broken".to_owned();
    let rest = bytes.strip_prefix(MAGIC).ok_or_else(broken)?;
    let (version, rest) = rest.split_at_checked(2).ok_or_else(broken)?;
    // From version 2 on, the header's length has four bytes.
    let wide = if version.first() == Some(&1) { 2 } else { 4 };
    let (length, rest) = rest.split_at_checked(wide).ok_or_else(broken)?;
    let length = length.iter().rev().fold(0, |sum, byte| sum << 8 | usize::from(*byte));
    let (header, data) = rest.split_at_checked(length).ok_or_else(broken)?;
    let header = std::str::from_utf8(header).map_err(|_| broken())?;

    let value = |key: &str| {
        let (_, after) = header.split_once(&format!("'{key}':"))?;
        Some(after.trim_start())
    };
    let kind = value("descr").ok_or_else(broken)?;
    let shape = value("shape").and_then(shape).ok_or_else(broken)?;
    if value("fortran_order").is_none_or(|order| !order.starts_with("False")) {
        return Err("its array is in Fortran's order; save it in C's".to_owned());
    }
    let [rows, width] = shape[..] else {
        return Err(refuse(&shape));
    };
    if width != 2 && width != 4 {
        return Err(refuse(&shape));
    }
    let count = rows.checked_mul(width).ok_or_else(broken)?;
    let numbers: Vec<f64> = if kind.starts_with("'<f8'") {
        let (values, _) = data.as_chunks::<8>();
        values.iter().map(|value| f64::from_le_bytes(*value)).collect()
    } else if kind.starts_with("'<f4'") {
        let (values, _) = data.as_chunks::<4>();
        values.iter().map(|value| f64::from(f32::from_le_bytes(*value))).collect()
    } else {
        return Err("its numbers must be float32 or float64, little endian".to_owned());
    };
    match numbers.get(..count) {
        Some(numbers) => Locations::from_rows(width, numbers),
        None => Err(format!("it holds {} numbers; its shape promises {count}", numbers.len())),
    }
}

fn refuse(shape: &[usize]) -> String {
    format!("its shape is {shape:?}; it must be N x 2 (u, v) or N x 4 (u, v, row, column)")
}

/// The numbers of a tuple at the start of `text`, such as `(3, 2), }`.
fn shape(text: &str) -> Option<Vec<usize>> {
    let (inside, _) = text.strip_prefix('(')?.split_once(')')?;
    let numbers = inside.split(',').map(str::trim).filter(|number| !number.is_empty());
    numbers.map(|number| number.parse().ok()).collect()
}

/// Writes an array of N x 12 float64.
pub fn write(rows: &[SampleRow]) -> Vec<u8> {
    let mut header =
        format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({}, {}), }}", rows.len(), COLUMNS.len());
    let before = MAGIC.len() + 4;
    while !(before + header.len() + 1).is_multiple_of(ALIGNMENT) {
        header.push(' ');
    }
    header.push('\n');
    let mut bytes = MAGIC.to_vec();
    bytes.extend([1, 0]);
    bytes.extend((header.len() as u16).to_le_bytes());
    bytes.extend(header.as_bytes());
    bytes.extend(rows.as_flattened().iter().flat_map(|value| value.to_le_bytes()));
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;
    use gpc::camera::set::Sample;

    fn array(descr: &str, order: &str, shape: &str, data: &[u8]) -> Vec<u8> {
        let header = format!("{{'descr': '{descr}', 'fortran_order': {order}, 'shape': {shape}, }}\n");
        let length = (header.len() as u16).to_le_bytes();
        [MAGIC, &[1, 0], &length, header.as_bytes(), data].concat()
    }

    #[test]
    fn both_precisions_are_read() {
        let doubles: Vec<u8> = [1.5_f64, -2.0, 3.0, 4.0].iter().flat_map(|v| v.to_le_bytes()).collect();
        let found = read(&array("<f8", "False", "(2, 2)", &doubles)).unwrap();
        assert_eq!(found.samples.iter().map(|sample| sample.uv).collect::<Vec<_>>(), [[1.5, -2.0], [3.0, 4.0]]);
        let floats: Vec<u8> = [1.5_f32, -2.0, 3.0, 4.0].iter().flat_map(|v| v.to_le_bytes()).collect();
        let found = read(&array("<f4", "False", "(1, 4)", &floats)).unwrap();
        assert!(found.has_cells);
        assert_eq!(found.samples, [Sample { uv: [1.5, -2.0], row: 3, col: 4 }]);
    }

    #[test]
    fn other_arrays_are_refused() {
        let cases = [
            (array("<i4", "False", "(1, 2)", &[0; 8]), "float32"),
            (array("<f8", "True", "(1, 2)", &[0; 16]), "Fortran"),
            (array("<f8", "False", "(2,)", &[0; 16]), "[2]"),
            (array("<f8", "False", "(1, 3)", &[0; 24]), "[1, 3]"),
            (array("<f8", "False", "(9, 2)", &[0; 16]), "promises 18"),
            (b"u,v\n1,2\n".to_vec(), "no NPY"),
            (b"\x93NUMPY\x01\x00\xff\xff{".to_vec(), "no NPY"),
        ];
        for (bytes, expected) in cases {
            let message = read(&bytes).unwrap_err();
            assert!(message.contains(expected), "{message}");
        }
    }

    #[test]
    fn written_arrays_start_aligned() {
        let bytes = write(&[[0.5; 12]; 3]);
        assert!((bytes.len() - 3 * 12 * 8).is_multiple_of(ALIGNMENT));
        assert!(read(&bytes).unwrap_err().contains("[3, 12]"));
    }
}
