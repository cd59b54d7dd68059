//! Samples as comma-separated values.

use super::table::{COLUMNS, Locations, SampleRow};
use crate::cli::csv;
use std::fmt::Write;

/// Reads locations: a header `u,v` or `u,v,row,col`, and a line for each location.
pub fn read(bytes: &[u8]) -> Result<Locations, String> {
    let (width, numbers) = csv::numbers(bytes, &[&["u", "v"], &["u", "v", "row", "col"]])?;
    Locations::from_rows(width, &numbers)
}

/// Writes a header, and a line for each row. The numbers have enough digits to be read back exactly.
pub fn write(rows: &[SampleRow]) -> Vec<u8> {
    let mut text = COLUMNS.join(",");
    for row in rows {
        text.push('\n');
        for (column, value) in row.iter().enumerate() {
            let comma = if column == 0 { "" } else { "," };
            // Locations are the given 64-bit numbers; the renderer's values have 32 bits.
            let written =
                if column < 2 { write!(text, "{comma}{value}") } else { write!(text, "{comma}{}", *value as f32) };
            // Writing to a string can't fail.
            let _ = written;
        }
    }
    text.push('\n');
    text.into_bytes()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_and_columns_are_whole() {
        let read = |cell: &str| read(format!("u,v,row,col\n1,2,{cell}").as_bytes());
        assert_eq!(read("3,4").unwrap().samples[0].col, 4);
        for cell in ["-1,0", "0.5,0", "nan,0", "0,1e99"] {
            assert!(read(cell).is_err(), "{cell}");
        }
    }

    #[test]
    fn rows_come_with_a_header() {
        let mut row = [0.0; 12];
        row[0] = 0.1;
        row[2] = f64::from(0.1_f32);
        let text = String::from_utf8(write(&[row])).unwrap();
        let expected = "u,v,r,g,b,a,depth,id,hit,nx,ny,nz\n0.1,0,0.1,0,0,0,0,0,0,0,0,0\n";
        assert_eq!(text, expected);
    }
}
