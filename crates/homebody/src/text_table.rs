//! Tables of text, with columns of fixed widths.

use std::fmt::Display;

pub struct TextTable(Vec<(i8, &'static str)>);

impl TextTable {
    /// `columns` has a width and a heading for each column, with bars between them. A negative width aligns a column to the left.
    pub fn new(columns: &'static str) -> TextTable {
        let column = |column: &'static str| {
            let (width, heading) = column.split_once(' ').unwrap_or((column, ""));
            (width.parse().unwrap_or(0), heading)
        };
        TextTable(columns.split('|').map(column).collect())
    }

    pub fn heading(&self) -> String {
        self.line(self.0.iter().map(|(_, heading)| (*heading).to_owned()))
    }

    pub fn row(&self, cells: &[&dyn Display]) -> String {
        self.line(cells.iter().map(ToString::to_string))
    }

    fn line(&self, cells: impl Iterator<Item = String>) -> String {
        let padded = self.0.iter().zip(cells).map(|(&(width, _), cell)| {
            let size = usize::from(width.unsigned_abs());
            if width < 0 { format!("{cell:size$}") } else { format!("{cell:>size$}") }
        });
        padded.collect::<Vec<_>>().join(" ") + "\n"
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn aligns_texts_to_the_left_and_numbers_to_the_right() {
        let table = TextTable::new("-6 home|4 days|3 14 d");
        assert_eq!(table.heading(), "home   days 14 d\n");
        assert_eq!(table.row(&[&"Öz", &12, &0.5]), "Öz       12 0.5\n");
        assert_eq!(table.row(&[&"a long name", &1]), "a long name    1\n");
    }
}
