//! Tables of a study. One list of columns makes the console's tables, the CSV and the tables of the report.

use super::measurement::{Cost, Spread};
use super::results::Results;
use crate::cli::print;
use serde::Serialize;

/// A value in a table.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// Not measured.
    Empty,
    Text(String),
    Count(u64),
    /// A number, and the digits after its point in tables for people.
    Number(f64, usize),
    /// A share of 1, which people see in percent with so many digits.
    Percent(f64, usize),
    /// Bytes, which people see in MiB.
    Bytes(u64),
}

impl Cell {
    pub fn text(value: impl ToString) -> Self {
        Self::Text(value.to_string())
    }

    /// A value that may not have been measured.
    pub fn optional<T>(value: Option<T>, cell: impl FnOnce(T) -> Self) -> Self {
        value.map_or(Self::Empty, cell)
    }

    /// The value in a CSV (RFC 4180): unrounded.
    fn exact(&self) -> String {
        match self {
            Self::Empty => String::new(),
            Self::Text(text) if text.contains([',', '"', '\n']) => format!("\"{}\"", text.replace('"', "\"\"")),
            Self::Text(text) => text.clone(),
            Self::Count(value) | Self::Bytes(value) => value.to_string(),
            Self::Number(value, _) | Self::Percent(value, _) => value.to_string(),
        }
    }

    /// The value in a table for people.
    fn shown(&self) -> String {
        match self {
            Self::Empty => "-".to_owned(),
            Self::Text(text) => text.clone(),
            Self::Count(value) => value.to_string(),
            Self::Number(value, digits) => format!("{value:.digits$}"),
            Self::Percent(share, digits) => format!("{:.digits$} %", 100.0 * share),
            Self::Bytes(bytes) => format!("{:.0}", *bytes as f64 / f64::from(1 << 20)),
        }
    }

    fn is_text(&self) -> bool {
        matches!(self, Self::Text(_))
    }
}

/// A function that makes the cell of a row.
type CellOf<S, R> = dyn Fn(&S, &R) -> Cell;

/// A column of a study's rows.
pub struct Column<S, R> {
    /// Name in the CSV; empty for a column that only people see.
    name: &'static str,
    /// Heading in tables for people; empty for a column that only the CSV has.
    heading: &'static str,
    cell: Box<CellOf<S, R>>,
}

/// A column. `name` is that in the CSV, `heading` that in tables for people; an empty one leaves the column out there.
pub fn column<S, R>(
    name: &'static str,
    heading: &'static str,
    cell: impl Fn(&S, &R) -> Cell + 'static,
) -> Column<S, R> {
    Column { name, heading, cell: Box::new(cell) }
}

/// Columns of the times of a row: the number of frames, and milliseconds on the device and of the wall clock.
pub fn times<S: 'static, R: 'static>(of: fn(&R) -> [&Spread; 2]) -> [Column<S, R>; 7] {
    let ms = |name, heading, value: fn([&Spread; 2]) -> f64| {
        column(name, heading, move |_: &S, row: &R| Cell::Number(value(of(row)), 1))
    };
    [
        column("frames", "frames", move |_, row| Cell::Count(of(row)[1].count as u64)),
        ms("gpu_ms_median", "GPU ms", |[gpu, _]| gpu.median),
        ms("gpu_ms_min", "min", |[gpu, _]| gpu.min),
        ms("gpu_ms_spread", "spread", |[gpu, _]| gpu.spread),
        ms("wall_ms_median", "wall ms", |[_, wall]| wall.median),
        ms("wall_ms_min", "", |[_, wall]| wall.min),
        ms("wall_ms_spread", "", |[_, wall]| wall.spread),
    ]
}

/// Both clocks of a cost.
pub fn clocks(cost: &Cost) -> [&Spread; 2] {
    [&cost.gpu_ms, &cost.wall_ms]
}

/// A further table of a study for people, with some of its columns beside the first ones of its main table.
pub struct Table<S, R> {
    /// What the columns are.
    pub caption: &'static str,
    pub columns: Vec<Column<S, R>>,
}

/// What was measured of one scene, curve or check: rows of figures.
pub trait Study: Serialize + Sized + 'static {
    type Row: 'static;
    /// Name of the CSV that holds all studies of this kind.
    const FILE: &'static str;

    fn title(&self) -> String;

    /// Notes on what was left out, and why.
    fn notes(&self) -> Vec<String> {
        Vec::new()
    }

    fn rows(&self) -> &[Self::Row];

    /// Columns of the main table.
    fn columns() -> Vec<Column<Self, Self::Row>>;

    /// Further tables, and the number of columns of the main table that say what a row is about and stand in all of them. A
    /// further table leaves out rows without figures.
    fn more() -> (usize, Vec<Table<Self, Self::Row>>) {
        (0, Vec::new())
    }

    /// Size of the images, if it is not that of the whole run.
    fn size(&self) -> Option<[u32; 2]> {
        None
    }
}

/// A table's caption, heads and rows of texts, with the columns that are aligned to the left.
pub struct Shown {
    pub caption: &'static str,
    pub heads: Vec<&'static str>,
    pub rows: Vec<Vec<String>>,
    pub is_text: Vec<bool>,
}

/// The tables of a study, as people see them.
pub fn shown<S: Study>(study: &S) -> Vec<Shown> {
    let main = S::columns();
    let (keys, more) = S::more();
    let more = more.iter().map(|more| table(study, more.caption, &main[..keys], &more.columns));
    std::iter::once(table(study, "", &[], &main)).chain(more).filter(|table| !table.rows.is_empty()).collect()
}

/// A table of rows that have figures besides the keys.
fn table<S: Study>(
    study: &S,
    caption: &'static str,
    keys: &[Column<S, S::Row>],
    figures: &[Column<S, S::Row>],
) -> Shown {
    let is_shown = |column: &&Column<S, S::Row>| !column.heading.is_empty();
    let columns: Vec<_> = keys.iter().chain(figures).filter(is_shown).collect();
    let keys = keys.iter().filter(is_shown).count();
    let mut is_text = vec![false; columns.len()];
    let mut rows = Vec::new();
    for row in study.rows() {
        let cells: Vec<_> = columns.iter().map(|column| (column.cell)(study, row)).collect();
        if cells.iter().skip(keys).all(|cell| *cell == Cell::Empty) {
            continue;
        }
        for (is_text, cell) in is_text.iter_mut().zip(&cells) {
            *is_text |= cell.is_text();
        }
        rows.push(cells.iter().map(Cell::shown).collect());
    }
    Shown { caption, heads: columns.iter().map(|column| column.heading).collect(), rows, is_text }
}

/// Prints a study.
pub fn print<S: Study>(study: &S) -> anyhow::Result<()> {
    print::line(&format!("\n{}", study.title()))?;
    for note in study.notes() {
        print::line(&format!("  {note}"))?;
    }
    for table in shown(study) {
        if !table.caption.is_empty() {
            print::line(&format!("  {}:", table.caption))?;
        }
        for line in table.lines() {
            print::line(&format!("  {line}"))?;
        }
    }
    Ok(())
}

impl Shown {
    /// The heads and the rows, in columns of equal width.
    fn lines(&self) -> Vec<String> {
        let heads: Vec<_> = self.heads.iter().map(|head| (*head).to_owned()).collect();
        let all = || std::iter::once(&heads).chain(&self.rows);
        let widths: Vec<_> = (0..heads.len())
            .map(|index| all().filter_map(|row| row.get(index)).map(|text| text.chars().count()).max().unwrap_or(0))
            .collect();
        let line = |row: &Vec<String>| {
            let cells = row.iter().zip(&widths).zip(&self.is_text);
            let cells: Vec<_> = cells
                .map(
                    |((text, width), is_text)| {
                        if *is_text { format!("{text:<width$}") } else { format!("{text:>width$}") }
                    },
                )
                .collect();
            cells.join("  ").trim_end().to_owned()
        };
        all().map(line).collect()
    }
}

/// The CSV of all studies of a kind, with its name; `None` without studies.
pub fn csv<S: Study>(studies: &[S], results: &Results) -> Option<(&'static str, String)> {
    let size = studies.first()?.size().unwrap_or(results.size);
    let (_, more) = S::more();
    let columns = S::columns().into_iter().chain(more.into_iter().flat_map(|table| table.columns));
    let columns: Vec<_> = columns.filter(|column| !column.name.is_empty()).collect();
    let names: Vec<_> = columns.iter().map(|column| column.name).collect();
    let mut text = results.head(size) + &names.join(",") + "\n";
    for study in studies {
        for row in study.rows() {
            let cells: Vec<_> = columns.iter().map(|column| (column.cell)(study, row).exact()).collect();
            text += &(cells.join(",") + "\n");
        }
    }
    Some((S::FILE, text))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_hold_numbers_as_they_are_and_people_see_them_rounded() {
        let cells = [
            (Cell::Number(0.123_456, 3), "0.123456", "0.123"),
            (Cell::Percent(0.125, 1), "0.125", "12.5 %"),
            (Cell::Bytes(3 << 20), "3145728", "3"),
            (Cell::Number(f64::INFINITY, 2), "inf", "inf"),
            (Cell::Empty, "", "-"),
            (Cell::text("pixels, \"all\""), "\"pixels, \"\"all\"\"\"", "pixels, \"all\""),
        ];
        for (cell, exact, shown) in cells {
            assert_eq!((cell.exact().as_str(), cell.shown().as_str()), (exact, shown));
        }
    }

    #[test]
    fn columns_have_equal_widths() {
        let row = |a: &str, b: &str| vec![a.to_owned(), b.to_owned()];
        let table = Shown {
            caption: "",
            heads: vec!["method", "N"],
            rows: vec![row("ssaa", "64"), row("superpixel", "1024")],
            is_text: vec![true, false],
        };
        assert_eq!(table.lines(), ["method         N", "ssaa          64", "superpixel  1024"]);
    }
}
