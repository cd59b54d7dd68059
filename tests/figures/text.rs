//! Numbers and tables as Markdown.

/// A number with two or three significant digits.
pub fn short(value: f64) -> String {
    if value >= 100.0 {
        grouped(value.round() as u64)
    } else if value >= 10.0 {
        format!("{value:.0}")
    } else if value >= 1.0 {
        format!("{value:.1}")
    } else {
        format!("{value:.2}")
    }
}

/// An integer with a comma before every three digits.
pub fn grouped(value: u64) -> String {
    let digits = value.to_string();
    let mut text = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// An error of 0 to 1 as text, times 10^5.
pub fn error(value: f64) -> String {
    short(value * 1e5)
}

/// A Markdown table.
pub struct Table(String);

impl Table {
    pub fn new(head: &[String]) -> Self {
        let mut table = Self(String::new());
        table.row(head);
        let rule: Vec<_> = head.iter().map(|_| "---".to_owned()).collect();
        table.0 += &format!("|{}|\n", rule.join("|"));
        table
    }

    pub fn row(&mut self, cells: &[String]) {
        self.0 += &format!("| {} |\n", cells.join(" | "));
    }

    pub fn finish(self) -> String {
        self.0
    }
}

/// Cells with these texts.
pub fn cells(texts: &[&str]) -> Vec<String> {
    texts.iter().map(|text| (*text).to_owned()).collect()
}

#[test]
fn numbers_are_short() {
    for (value, expected) in
        [(0.123, "0.12"), (1.26, "1.3"), (12.6, "13"), (999.7, "1,000"), (1_234_567.0, "1,234,567")]
    {
        assert_eq!(short(value), expected);
    }
}
