//! `scenario.json`: its start, its time zone and the numbers that it sets.

use super::{Report, folded, nearest};
use crate::numbers::{Number, wrong};
use crate::problem::Problem;
use crate::scenario::ScenarioFile;
use crate::scenario::calendar::Calendar;
use crate::scenario::source::{Source, pointer_part};
use jiff::civil::DateTime;
use jiff::tz::TimeZoneDatabase;

/// Years for which the rules of time zones mean something.
const YEARS: std::ops::RangeInclusive<i16> = 1900..=2199;

/// Checks the file; gives the calendar if there can be one.
pub fn check(source: &Source, file: &ScenarioFile, problems: &mut Vec<Problem>) -> Option<Calendar> {
    let report = &mut Report { source, problems };
    report.name("/name", &file.name);
    let zone = Calendar::zone(&file.time_zone).is_ok();
    if !zone {
        report.hinted("/time_zone", format!("there is no time zone {:?}", file.time_zone), zone_hint(&file.time_zone));
    }
    let start: Option<DateTime> = file.start.parse().ok();
    let Some(start) = start else {
        report.hinted("/start", format!("{:?} is no date and time", file.start), "write it as \"2009-03-02T00:00:00\"");
        return None;
    };
    // The parser would pass over a zone written here, and the run would begin at another instant than it says. A zone follows the date,
    // whose year has six digits where it has a sign.
    let date_bytes = if file.start.starts_with(['+', '-']) { 13 } else { 10 };
    if file.start.get(date_bytes..).is_some_and(|rest| rest.contains(['+', '-', '[', 'Z', 'z'])) {
        let hint = "write local time, and the zone as \"time_zone\"";
        report.hinted("/start", format!("{:?} must not name a time zone", file.start), hint);
        return None;
    }
    if !YEARS.contains(&start.year()) {
        let what = format!("the year {} must be from {} to {}", start.year(), YEARS.start(), YEARS.end());
        report.add("/start", what);
        return None;
    }
    if !zone {
        return None;
    }
    let calendar = Calendar::new(&file.start, &file.time_zone);
    calendar.map_err(|why| report.add("/start", why)).ok()
}

/// Checks the numbers that the file sets by those that there are.
pub fn check_numbers(source: &Source, file: &ScenarioFile, known: &[Number], problems: &mut Vec<Problem>) {
    for (name, &value) in &file.numbers {
        let Some((what, hint)) = wrong(known, name, value) else { continue };
        let pointer = format!("/numbers/{}", pointer_part(name));
        problems.push(match known.iter().any(|number| number.name == *name) {
            true => source.problem(&pointer, what, Some(hint)),
            false => source.problem_with_key(&pointer, what, Some(hint)),
        });
    }
}

/// The zone that was probably meant: a slip of the keys, or a city without its continent.
fn zone_hint(name: &str) -> String {
    let known: Vec<String> = TimeZoneDatabase::bundled().available().map(|name| name.to_string()).collect();
    let is_city = |zone: &&String| zone.rsplit('/').next().is_some_and(|city| folded(city) == folded(name));
    match nearest(name, known.iter().map(String::as_str)).or(known.iter().find(is_city).map(String::as_str)) {
        Some(near) => format!("did you mean {near:?}?"),
        None => "write an IANA name such as \"America/Chicago\"".into(),
    }
}
