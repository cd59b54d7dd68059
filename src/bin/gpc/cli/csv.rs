//! Numbers from comma-separated values.

/// Parses a CSV whose header is one of `headers` and whose other lines hold a number for each column. Returns the
/// number of columns, which tells the headers apart, and all numbers row by row.
pub fn numbers(bytes: &[u8], headers: &[&[&str]]) -> Result<(usize, Vec<f64>), String> {
    let text = std::str::from_utf8(bytes).map_err(|_| "it is no text in UTF-8, as a CSV must be".to_owned())?;
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut lines = text.lines().enumerate();
    let header = lines.next().map_or("", |(_, line)| line);
    let names: Vec<_> = header.split(',').map(str::trim).collect();
    if !headers.contains(&names.as_slice()) {
        let known: Vec<_> = headers.iter().map(|header| header.join(",")).collect();
        let known = known.join(" or ");
        if text.trim().is_empty() {
            return Err(format!("it is empty; its first line must be {known}"));
        }
        return Err(format!(
            "its first line is \"{}\"; it must be {known}",
            header.chars().take(40).collect::<String>(),
        ));
    }
    let mut numbers = Vec::new();
    for (index, line) in lines.filter(|(_, line)| !line.trim().is_empty()) {
        let before = numbers.len();
        for field in line.split(',').map(str::trim) {
            let number = field.parse::<f64>();
            numbers.push(number.map_err(|_| format!("line {}: \"{field}\" is not a number", index + 1))?);
        }
        let found = numbers.len() - before;
        if found != names.len() {
            return Err(format!("line {} has {found} numbers; the header promises {}", index + 1, names.len()));
        }
    }
    Ok((names.len(), numbers))
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEADERS: &[&[&str]] = &[&["u", "v"], &["u", "v", "row", "col"]];

    #[test]
    fn either_header_will_do() {
        let found = numbers(b"\xef\xbb\xbfu, v\r\n1,2\r\n\r\n-3.5, 4e2\r\n", HEADERS);
        assert_eq!(found, Ok((2, vec![1.0, 2.0, -3.5, 400.0])));
        let found = numbers(b"u,v,row,col\n1,2,3,4", HEADERS);
        assert_eq!(found, Ok((4, vec![1.0, 2.0, 3.0, 4.0])));
    }

    #[test]
    fn what_is_wrong_is_named_with_its_line() {
        for (text, expected) in [
            ("1,2\n", "u,v or u,v,row,col"),
            ("", "u,v"),
            ("u,v\n1,2\n3,x\n", "line 3"),
            ("u,v\n1,2,3\n", "line 2 has 3"),
        ] {
            let message = numbers(text.as_bytes(), HEADERS).unwrap_err();
            assert!(message.contains(expected), "{message}");
        }
        assert!(numbers(b"u,v\n\xff", HEADERS).is_err());
    }
}
