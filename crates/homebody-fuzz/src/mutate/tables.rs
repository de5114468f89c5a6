//! Tables in text: logs as CSV and as CASAS has them, lists of members.

use super::{numbers, texts};
use crate::dice::Dice;

/// Instants that clocks and calendars trip over.
const INSTANTS: [&str; 26] = [
    "2009-03-08 02:30:00",
    "2009-03-08T02:30:00-05:00",
    "2009-11-01 01:30:00",
    "2016-12-31T23:59:60Z",
    "2009-02-29 00:00:00",
    "0000-01-01 00:00:00",
    "-9999-01-01T00:00:00Z",
    "9999-12-31T23:59:59.999999999Z",
    "1970-01-01 00:00:00",
    "2009-03-02 24:00:00",
    "2009-03-02 7:5:3",
    "2009-03-02T07:12:03.1234567890123456789Z",
    "2009-03-02T07:12:03+99:99",
    "2009-03-02T07:12:03+00:00[Europe/Berlin]",
    "2009-03-02",
    "07:12:03",
    "1235977923",
    "1235977923000",
    "1235977923000000",
    "1e300",
    "-1",
    "NaN",
    "",
    " 2009-03-02 07:12:03 ",
    "٢٠٠٩-03-02 07:12:03",
    "2009/03/02 07:12:03",
];

/// Changes lines and cells of a table whose cells are parted by one of `,`, `;`, a tab or a blank.
pub fn table(text: &mut String, dice: &mut Dice) {
    let first = text.lines().next().unwrap_or_default();
    let mark = *[',', ';', '\t', ' '].iter().max_by_key(|&&mark| first.matches(mark).count()).unwrap_or(&',');
    let mut lines: Vec<Vec<String>> = text.lines().map(|line| line.split(mark).map(str::to_owned).collect()).collect();
    for _ in 0..dice.size(5) {
        once(&mut lines, dice);
    }
    let mark = if dice.is(0.05) { *dice.one(&[',', ';', '\t', ' ', '|']) } else { mark };
    let end = if dice.is(0.9) { "\n" } else { dice.one(&["\r\n", "\r", "\n\n", "\u{2028}"]) };
    let lines: Vec<String> = lines.into_iter().map(|cells| cells.join(&mark.to_string())).collect();
    *text = lines.join(end) + end;
}

fn once(lines: &mut Vec<Vec<String>>, dice: &mut Dice) {
    let at = dice.below(lines.len());
    let Some(line) = lines.get_mut(at) else { return };
    if line.is_empty() {
        line.push(String::new());
    }
    let column = dice.below(line.len());
    match dice.below(12) {
        0..=2 => line[column] = cell(&line[column], dice),
        3 => line[0] = (*dice.one(&INSTANTS)).to_owned(),
        4 => drop(line.remove(column)),
        5 => line.insert(column, line[column].clone()),
        6 => drop(lines.remove(at)),
        7 => {
            let other = dice.below(lines.len());
            lines.swap(at, other);
        }
        8 => {
            // A column that is odd throughout.
            let odd = cell("", dice);
            let most = super::times(odd.len(), lines.len());
            lines.iter_mut().take(most).filter_map(|line| line.get_mut(column)).for_each(|cell| cell.clone_from(&odd));
        }
        9 => {
            let copy = line.clone();
            let times = dice.size(super::times(copy.iter().map(String::len).sum(), 5_000));
            lines.splice(at..at, (0..times).map(|_| copy.clone()));
        }
        10 if dice.is(0.3) => line.extend((0..dice.size(50_000)).map(|_| String::new())),
        _ => {
            let number = line[column].trim().parse().unwrap_or(0.0);
            line[column] = numbers::other(number, dice);
        }
    }
}

fn cell(cell: &str, dice: &mut Dice) -> String {
    match dice.below(5) {
        0 => texts::other(cell, dice),
        1 => numbers::other(cell.parse().unwrap_or(1.0), dice),
        2 => (*dice.one(&INSTANTS)).to_owned(),
        3 => format!("\"{cell}"),
        _ => format!("\"{}\"", cell.replace('a', "\"\"")),
    }
}

/// An instant, or none.
pub fn instant(dice: &mut Dice) -> &'static str {
    dice.one::<&str>(&INSTANTS)
}
