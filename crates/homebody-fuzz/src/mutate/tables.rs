//! Tables in text: logs as CSV and in the form of CASAS, lists of members.

use super::{numbers, texts, word};
use crate::choices::Choices;

/// Changes lines and cells of a table with one of the separators `,`, `;`, tab and blank.
pub fn table(text: &mut String, choices: &mut Choices) {
    let first = text.lines().next().unwrap_or_default();
    let mark = *[',', ';', '\t', ' '].iter().max_by_key(|&&mark| first.matches(mark).count()).unwrap_or(&',');
    let mut lines: Vec<Vec<String>> = text.lines().map(|line| line.split(mark).map(str::to_owned).collect()).collect();
    for _ in 0..choices.size(5) {
        once(&mut lines, choices);
    }
    let mark = if choices.is(0.05) { *choices.one(&[',', ';', '\t', ' ', '|']) } else { mark };
    let end = if choices.is(0.9) { "\n" } else { choices.one(&["\r\n", "\r", "\n\n", "\u{2028}"]) };
    let lines: Vec<String> = lines.into_iter().map(|cells| cells.join(&mark.to_string())).collect();
    *text = lines.join(end) + end;
}

fn once(lines: &mut Vec<Vec<String>>, choices: &mut Choices) {
    let at = choices.below(lines.len());
    let Some(line) = lines.get_mut(at) else { return };
    if line.is_empty() {
        line.push(String::new());
    }
    let column = choices.below(line.len());
    match choices.below(12) {
        0..=2 => line[column] = cell(&line[column], choices),
        3 => line[0] = word(choices, "instants").to_owned(),
        4 => drop(line.remove(column)),
        5 => line.insert(column, line[column].clone()),
        6 => drop(lines.remove(at)),
        7 => {
            let other = choices.below(lines.len());
            lines.swap(at, other);
        }
        8 => {
            // One odd column.
            let odd = cell("", choices);
            let most = super::times(odd.len(), lines.len());
            lines.iter_mut().take(most).filter_map(|line| line.get_mut(column)).for_each(|cell| cell.clone_from(&odd));
        }
        9 => {
            let copy = line.clone();
            let times = choices.size(super::times(copy.iter().map(String::len).sum(), 5_000));
            lines.splice(at..at, (0..times).map(|_| copy.clone()));
        }
        10 if choices.is(0.3) => line.extend((0..choices.size(50_000)).map(|_| String::new())),
        _ => {
            let number = line[column].trim().parse().unwrap_or(0.0);
            line[column] = numbers::other(number, choices);
        }
    }
}

fn cell(cell: &str, choices: &mut Choices) -> String {
    match choices.below(5) {
        0 => texts::other(cell, choices),
        1 => numbers::other(cell.parse().unwrap_or(1.0), choices),
        2 => word(choices, "instants").to_owned(),
        3 => format!("\"{cell}"),
        _ => format!("\"{}\"", cell.replace('a', "\"\"")),
    }
}
