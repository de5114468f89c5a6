//! The marks in a table's numbers: a point or a comma before decimals, the other between thousands, and units behind them.

use super::first_rows::FirstRows;
use super::measured::measured;
use crate::limits::beginning;
use crate::source::messages::TableMessage;
use crate::source::options::DecimalMark;
use std::borrow::Cow;

#[derive(Default)]
struct DecimalMarks {
    /// Numbers such as `21,5`, whose comma is before decimals.
    comma: usize,
    /// Numbers such as `21.5`, whose point is before decimals.
    point: usize,
    /// Numbers such as `1,234`, whose comma may part thousands.
    either: usize,
    /// Those of `point` whose points part thousands, such as `1.234`, if the comma is before decimals.
    groups: usize,
    /// Those of `point` that have commas between thousands.
    commas: usize,
}

/// The form of the numbers of a table.
#[derive(Default)]
pub(crate) struct NumberForm {
    /// Whether a comma is before decimals.
    pub has_comma: bool,
    /// The columns whose other mark parts thousands.
    thousands: Vec<usize>,
    /// The columns with units behind the numbers.
    measured: Vec<usize>,
}

impl NumberForm {
    /// The marks in the numbers of these columns.
    ///
    /// # Errors
    ///
    /// A sentence with a hint, where nothing decides.
    pub fn find(first: &FirstRows, columns: &[usize], asked: Option<DecimalMark>) -> Result<NumberForm, TableMessage> {
        let measured = columns.iter().copied().filter(|&column| first.cells[column].measured > 0).collect();
        let has_comma = decimal_comma(first, columns, asked)?;
        let parts = |column: &usize| {
            let mut marks = DecimalMarks::default();
            for cell in first.column(*column) {
                marks.take(number_of(cell));
            }
            if has_comma { marks.point == marks.groups } else { marks.commas > 0 }
        };
        let thousands = columns.iter().copied().filter(parts).collect();
        Ok(NumberForm { has_comma, thousands, measured })
    }

    /// Why the numbers of a column are read otherwise than they stand there.
    pub fn reason(&self, column: usize, first: &FirstRows) -> Option<String> {
        let has_mark = |mark: char| first.column(column).any(|cell| number_of(cell).contains(mark));
        let reasons = [
            (self.has_comma && has_mark(','), "a comma is before decimals"),
            (self.has_comma && self.thousands.contains(&column) && has_mark('.'), "a point parts thousands"),
            (!self.has_comma && self.thousands.contains(&column), "a comma parts thousands"),
            (self.measured.contains(&column), "a unit or brackets stand with its numbers"),
        ];
        let told: Vec<&str> = reasons.into_iter().filter(|(is_so, _)| *is_so).map(|(_, why)| why).collect();
        (!told.is_empty()).then(|| told.join("; "))
    }

    pub fn unit(&self, column: usize, cell: &[u8]) -> Option<String> {
        let cell = str::from_utf8(cell).ok().filter(|_| self.measured.contains(&column))?;
        let (_, unit) = measured(cell.trim())?;
        Some(unit.to_owned()).filter(|unit| !unit.is_empty())
    }

    /// A cell as a number with a point, where it is one; any other text as it stands there.
    #[inline]
    pub fn plain<'c>(&self, column: usize, cell: &'c [u8]) -> Cow<'c, [u8]> {
        if !self.has_comma && self.thousands.is_empty() && self.measured.is_empty() {
            return Cow::Borrowed(cell);
        }
        let cell = match str::from_utf8(cell).ok().and_then(measured).filter(|_| self.measured.contains(&column)) {
            Some((number, _)) => number.as_bytes(),
            None => cell,
        };
        let is_parted = self.thousands.contains(&column);
        let found = if self.has_comma { with_point(cell, is_parted) } else { without_commas(cell, is_parted) };
        found.map_or(Cow::Borrowed(cell), Cow::Owned)
    }
}

/// The number of a cell without its unit.
fn number_of(cell: &str) -> &str {
    let cell = cell.trim();
    measured(cell).map_or(cell, |(number, _)| number)
}

fn decimal_comma(first: &FirstRows, columns: &[usize], asked: Option<DecimalMark>) -> Result<bool, TableMessage> {
    let mut marks = DecimalMarks::default();
    let mut example = "";
    for &column in columns {
        for cell in first.column(column) {
            if marks.take(number_of(cell)) && example.is_empty() {
                example = cell;
            }
        }
    }
    match (asked, marks) {
        (Some(mark), DecimalMarks { comma, either, groups, .. }) => {
            Ok(mark == DecimalMark::Comma && comma + either + groups > 0)
        }
        (_, DecimalMarks { comma: 0, either: 0, .. }) => Ok(false),
        (_, DecimalMarks { comma: 1.., .. }) => Ok(true),
        (_, DecimalMarks { point: 1.., .. }) => Ok(false),
        _ => Err(TableMessage::OpenDecimals { example: beginning(example.trim()) }),
    }
}

impl DecimalMarks {
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
                    () if decimals.contains('.') => {
                        self.point += 1;
                        self.commas += 1;
                    }
                    () if whole.contains('.') || decimals.len() != 3 || whole.starts_with('0') => self.comma += 1,
                    () => {
                        self.either += 1;
                        return true;
                    }
                }
            }
            // Several commas part thousands.
            (Some(_), _) => {
                self.point += 1;
                self.commas += 1;
            }
            _ => {
                self.point += usize::from(digits.contains('.'));
                self.groups += usize::from(is_grouped(digits.as_bytes(), b'.'));
            }
        }
        false
    }
}

/// Whether marks part the digits of a number by threes.
fn is_grouped(digits: &[u8], mark: u8) -> bool {
    let mut groups = digits.split(|byte| *byte == mark);
    let first = groups.next().is_some_and(|first| (1..=3).contains(&first.len()) && first[0] != b'0');
    let rest: Vec<&[u8]> = groups.collect();
    let is_number = |group: &&[u8]| group.len() == 3 && group.iter().all(u8::is_ascii_digit);
    first && !rest.is_empty() && rest.iter().all(is_number)
}

/// The digits of a number behind its sign.
fn unsigned(cell: &[u8]) -> &[u8] {
    cell.strip_prefix(b"-").or(cell.strip_prefix(b"+")).unwrap_or(cell)
}

fn without(cell: &[u8], mark: u8) -> Vec<u8> {
    cell.iter().copied().filter(|byte| *byte != mark).collect()
}

/// A number with a decimal comma as one with a point; `None` of any other text.
fn with_point(cell: &[u8], has_thousands: bool) -> Option<Vec<u8>> {
    let digits = unsigned(cell);
    let is_number = digits.iter().all(|byte| byte.is_ascii_digit() || b",.".contains(byte));
    let commas = digits.iter().filter(|byte| **byte == b',').count();
    match commas {
        1 if is_number => {
            let mut number = without(cell, b'.');
            number.iter_mut().filter(|byte| **byte == b',').for_each(|byte| *byte = b'.');
            Some(number)
        }
        0 if has_thousands && is_grouped(digits, b'.') => Some(without(cell, b'.')),
        _ => None,
    }
}

/// A number without the commas that part its thousands; `None` of any other text.
fn without_commas(cell: &[u8], has_thousands: bool) -> Option<Vec<u8>> {
    let digits = unsigned(cell);
    let whole = digits.split(|byte| *byte == b'.').next().unwrap_or_default();
    let decimals = digits.get(whole.len() + 1..).unwrap_or_default();
    let is_number = is_grouped(whole, b',') && decimals.iter().all(u8::is_ascii_digit);
    (has_thousands && is_number).then(|| without(cell, b','))
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
            let mut marks = DecimalMarks::default();
            marks.take(cell);
            assert_eq!([marks.comma, marks.point, marks.either], counts, "{cell}");
        }
        assert_eq!(with_point(b"-1.234,5", false).unwrap(), b"-1234.5");
        assert_eq!(with_point(b"1.280", true).unwrap(), b"1280");
        for cell in [&b"1.28"[..], b"0.280", b"1.2804", b"1..280", b"ON", b"."] {
            assert_eq!(with_point(cell, true), None, "{}", cell.escape_ascii());
        }
        assert_eq!((with_point(b"1.280", false), without_commas(b"1,280", false)), (None, None));
        assert_eq!(without_commas(b"-1,234.5", true).unwrap(), b"-1234.5");
    }
}
