//! `scenario.json`: its start, its time zone and the numbers that it sets.

use super::ProblemReport;
use crate::calendar::{Calendar, TimeMessage};
use crate::numbers::{Number, wrong};
use crate::problem::Problem;
use crate::scenario::ScenarioFile;
use crate::scenario::source::{JsonSource, pointer_part};
use jiff::civil::DateTime;

/// Years with known rules of time zones.
const YEARS: std::ops::RangeInclusive<i16> = 1900..=2199;

/// Checks the file; gives the calendar if there can be one.
pub fn check(source: &JsonSource, file: &ScenarioFile, problems: &mut Vec<Problem>) -> Option<Calendar> {
    let report = &mut ProblemReport { source, problems };
    report.name("/name", &file.name);
    let unknown = Calendar::zone(&file.time_zone).err();
    let is_known = unknown.is_none();
    if let Some(unknown) = unknown {
        report.add("/time_zone", unknown);
    }
    let start: Option<DateTime> = file.start.parse().ok();
    let Some(start) = start else {
        report.add("/start", TimeMessage::InvalidStart { text: file.start.clone() });
        return None;
    };
    // The parser would pass over a zone written here, and the run would begin at another instant than it says. A zone follows the date,
    // whose year has six digits where it has a sign.
    let date_bytes = if file.start.starts_with(['+', '-']) { 13 } else { 10 };
    if file.start.get(date_bytes..).is_some_and(|rest| rest.contains(['+', '-', '[', 'Z', 'z'])) {
        report.add("/start", TimeMessage::ZoneInStart { text: file.start.clone() });
        return None;
    }
    if !YEARS.contains(&start.year()) {
        let [year, first, last] = [start.year(), *YEARS.start(), *YEARS.end()].map(i64::from);
        report.add("/start", TimeMessage::Year { year, first, last });
        return None;
    }
    if !is_known {
        return None;
    }
    let calendar = Calendar::new(&file.start, &file.time_zone);
    calendar.map_err(|why| report.add("/start", why)).ok()
}

/// Checks the numbers that the file sets by those that there are.
pub fn check_numbers(source: &JsonSource, file: &ScenarioFile, known: &[Number], problems: &mut Vec<Problem>) {
    for (name, &value) in &file.numbers {
        let Some(message) = wrong(known, name, value) else { continue };
        let pointer = format!("/numbers/{}", pointer_part(name));
        problems.push(match known.iter().any(|number| number.name == *name) {
            true => source.problem(&pointer, message, None),
            false => source.problem_with_key(&pointer, message, None),
        });
    }
}
