//! Samples as comma-separated values.

use super::table::{COLUMNS, Locations, Row};
use std::fmt::Write;

/// Reads locations: a header `u,v` or `u,v,row,col`, and a line for each.
pub fn read(bytes: &[u8]) -> Result<Locations, String> {
    let text = std::str::from_utf8(bytes).map_err(|_| "it is not UTF-8".to_owned())?;
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut lines = text.lines().enumerate();
    let header = lines.next().map_or("", |(_, line)| line);
    let names: Vec<_> = header.split(',').map(str::trim).collect();
    let width = match names.as_slice() {
        ["u", "v"] => 2,
        ["u", "v", "row", "col"] => 4,
        _ => {
            return Err(format!(
                "its first line is \"{}\"; it must be u,v or u,v,row,col",
                header.chars().take(40).collect::<String>()
            ));
        }
    };
    let mut numbers = Vec::new();
    for (index, line) in lines.filter(|(_, line)| !line.trim().is_empty()) {
        let before = numbers.len();
        for field in line.split(',') {
            let number = field.trim().parse::<f64>();
            numbers.push(number.map_err(|_| {
                format!("line {}: \"{}\" is not a number", index + 1, field.trim())
            })?);
        }
        let found = numbers.len() - before;
        if found != width {
            return Err(format!(
                "line {} has {found} numbers; the header promises {width}",
                index + 1
            ));
        }
    }
    Ok(Locations::from_rows(width, &numbers))
}

/// Writes a header and a line for each row, with as many digits as tell each value from its neighbours.
pub fn write(rows: &[Row]) -> Vec<u8> {
    let mut text = COLUMNS.join(",");
    for row in rows {
        text.push('\n');
        for (column, value) in row.iter().enumerate() {
            let comma = if column == 0 { "" } else { "," };
            // Locations are what was given; the rest was 32 bits wide.
            let written = if column < 2 {
                write!(text, "{comma}{value}")
            } else {
                write!(text, "{comma}{}", *value as f32)
            };
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
    fn locations_are_read_with_and_without_cells() {
        let found = read(b"\xef\xbb\xbfu, v\r\n1,2\r\n\r\n-3.5, 4e2\r\n").unwrap();
        assert_eq!(found.uv, [[1.0, 2.0], [-3.5, 400.0]]);
        assert_eq!(found.cells, None);
        let found = read(b"u,v,row,col\n1,2,3,4").unwrap();
        assert_eq!(found.cells, Some(vec![[3.0, 4.0]]));
        assert_eq!(found.samples().unwrap()[0].col, 4);
    }

    #[test]
    fn what_is_wrong_is_named_with_its_line() {
        for (text, expected) in [
            ("1,2\n", "u,v"),
            ("", "u,v"),
            ("u,v\n1,2\n3,x\n", "line 3"),
            ("u,v\n1,2,3\n", "line 2 has 3"),
        ] {
            let message = read(text.as_bytes()).unwrap_err();
            assert!(message.contains(expected), "{message}");
        }
        for cell in ["-1,0", "0.5,0", "nan,0", "0,1e99"] {
            let found = read(format!("u,v,row,col\n1,2,{cell}").as_bytes()).unwrap();
            assert!(found.samples().is_err(), "{cell}");
        }
        assert!(read(b"u,v\n\xff").is_err());
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
