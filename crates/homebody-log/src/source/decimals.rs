//! The mark before the decimals of a table's numbers: a point or a comma.

use super::first_rows::FirstRows;
use super::options::DecimalMark;
use crate::limits::beginning;

/// Counts of numbers by their marks.
#[derive(Default)]
struct Marks {
    /// Numbers such as `21,5`, whose comma is before decimals.
    comma: usize,
    /// Numbers such as `21.5`, whose point is before decimals.
    point: usize,
    /// Numbers such as `1,234`, whose comma may part thousands.
    either: usize,
}

/// Whether a comma is before the decimals in these columns.
///
/// # Errors
///
/// A sentence with a hint, where nothing decides.
pub(super) fn decimal_comma(first: &FirstRows, columns: &[usize], asked: Option<DecimalMark>) -> Result<bool, String> {
    let mut marks = Marks::default();
    let mut example = "";
    for &column in columns {
        for cell in first.column(column) {
            if marks.take(cell.trim()) && example.is_empty() {
                example = cell;
            }
        }
    }
    match (asked, marks) {
        (Some(mark), Marks { comma, either, .. }) => Ok(mark == DecimalMark::Comma && comma + either > 0),
        (_, Marks { comma: 0, either: 0, .. }) => Ok(false),
        (_, Marks { comma: 1.., .. }) => Ok(true),
        (_, Marks { point: 1.., .. }) => Ok(false),
        _ => Err(format!(
            "nothing decides whether the comma in {} parts thousands or decimals\n  hint: --decimals comma or --decimals point \
             decides it",
            beginning(example.trim())
        )),
    }
}

impl Marks {
    /// Takes a cell; whether it is a number that may be either.
    fn take(&mut self, cell: &str) -> bool {
        let digits = cell.strip_prefix(['-', '+']).unwrap_or(cell);
        if digits.is_empty() || !digits.bytes().all(|byte| byte.is_ascii_digit() || byte == b',' || byte == b'.') {
            return false;
        }
        match (digits.find(','), digits.rfind(',')) {
            (Some(first), Some(last)) if first == last => {
                let (whole, decimals) = (&digits[..first], &digits[first + 1..]);
                match () {
                    () if decimals.contains('.') => self.point += 1,
                    () if whole.contains('.') || decimals.len() != 3 || whole.starts_with('0') => self.comma += 1,
                    () => {
                        self.either += 1;
                        return true;
                    }
                }
            }
            // Several commas part thousands.
            (Some(_), _) => self.point += 1,
            _ => self.point += usize::from(digits.contains('.')),
        }
        false
    }
}

/// A number with a decimal comma as one with a point; `None` of any other text.
pub(super) fn with_point(cell: &[u8]) -> Option<Vec<u8>> {
    let digits = cell.strip_prefix(b"-").or(cell.strip_prefix(b"+")).unwrap_or(cell);
    let is_number = digits.iter().all(|byte| byte.is_ascii_digit() || b",.".contains(byte));
    let commas = digits.iter().filter(|byte| **byte == b',').count();
    (is_number && commas == 1).then(|| {
        let without_thousands = cell.iter().filter(|byte| **byte != b'.');
        without_thousands.map(|&byte| if byte == b',' { b'.' } else { byte }).collect()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_of_numbers_are_counted() {
        for (cell, counts) in [
            ("21,5", [1, 0, 0]),
            ("-0,125", [1, 0, 0]),
            ("1.234,5", [1, 0, 0]),
            ("1,234", [0, 0, 1]),
            ("1,234.5", [0, 1, 0]),
            ("1,234,567", [0, 1, 0]),
            ("21.5", [0, 1, 0]),
            ("21", [0, 0, 0]),
            ("a,b", [0, 0, 0]),
        ] {
            let mut marks = Marks::default();
            marks.take(cell);
            assert_eq!([marks.comma, marks.point, marks.either], counts, "{cell}");
        }
        assert_eq!(with_point(b"-1.234,5").unwrap(), b"-1234.5");
        assert_eq!((with_point(b"21.5"), with_point(b"ON")), (None, None));
    }
}
