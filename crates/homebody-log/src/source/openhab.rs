//! The events.log of openHAB: a line for each event, such as the change of an item.
//!
//! `Item 'Hall_Motion' changed from OFF to ON` since openHAB 3, `Hall_Motion changed from OFF to ON` before, and
//! `Hall_Motion state updated to ON` in the first. Left out: commands, which are wishes and not states; things and rules; groups,
//! which change through their members.

use super::instant::InstantReader;
use super::lines::LineReader;
use super::reading::LogReading;
use super::start::FileStart;
use super::{LogForm, Shows};
use crate::error::LogError;
use crate::files::plain::text;
use crate::limits::beginning;
use crate::log::{ColumnRole, SensorInfo};
use crate::source::casas::words::{CasasTime, is_number, when};
use homebody_core::problem::counted;
use homebody_core::scenario::logger::LoggerFile;
use std::collections::BTreeMap;
use std::path::Path;

pub(crate) const FORM: LogForm = LogForm {
    name: "openhab",
    what: "the events.log of openHAB: lines with the old and the new state of an item",
    shows,
    read,
};

/// At least one line in so many is about an item.
const FEWEST: usize = 50;

fn shows(start: &FileStart) -> Shows {
    let mut instants = InstantReader::default();
    let (mut lines, mut events) = (0, 0);
    for line in start.lines() {
        lines += 1;
        let event = when(line.as_bytes(), &mut instants).and_then(|when| event(&text(when.behind)).map(|_| ()));
        events += usize::from(event.is_some());
    }
    Shows::rows_if(events > 0 && events * FEWEST >= lines)
}

struct ItemEvent<'l> {
    item: &'l str,
    state: &'l str,
    /// Whether the state may be the same as before.
    is_update: bool,
    /// Whether a member changed it: then it is a group.
    is_group: bool,
}

/// The event behind a line's time, if it is about an item: `[INFO ] [openhab.event.ItemStateChangedEvent   ] - Item ...`.
fn event(behind: &str) -> Option<ItemEvent<'_>> {
    let behind = behind.trim();
    behind.starts_with('[').then_some(())?;
    let said = behind.split_once("] - ")?.1;
    let said = said.strip_prefix("Item ").unwrap_or(said);
    let (item, rest) = match said.strip_prefix('\'') {
        Some(quoted) => quoted.split_once('\'')?,
        None => said.split_at(said.find(' ')?),
    };
    let is_name = !item.is_empty() && item.chars().all(|c| c.is_alphanumeric() || "_-.:".contains(c));
    let rest = rest.trim_start();
    let changed = rest.strip_prefix("changed from ").and_then(|states| Some((states.split_once(" to ")?.1, false)));
    let updated = ["updated to ", "state updated to "].iter().find_map(|words| rest.strip_prefix(words));
    let (state, is_update) = changed.or(updated.map(|state| (state, true))).filter(|_| is_name)?;
    let (state, group) = state.split_once(" through ").map_or((state, false), |(state, _)| (state, true));
    let state = state.split_once(" (source: ").map_or(state, |(state, _)| state);
    // Things are online, and named by their binding: `astro:sun:local`.
    (!item.contains(':')).then_some(ItemEvent { item, state: state.trim(), is_update, is_group: group })
}

fn read(path: &Path, _: &LoggerFile, reading: &mut LogReading<'_>) -> Result<(), LogError> {
    reading.columns_of_form(&[
        ("the date and time of a line", ColumnRole::Time),
        ("the item", ColumnRole::Sensor),
        ("the state that it changed to", ColumnRole::Value),
    ]);
    let mut lines = LineReader::open(path)?;
    // The last state of each item: an update without a change adds no row.
    let mut last: BTreeMap<String, String> = BTreeMap::new();
    let (mut others, mut of_groups) = (0, 0);
    while let Some((number, line)) = lines.next()? {
        if line.trim_ascii().is_empty() {
            continue;
        }
        let Some(CasasTime { at, behind, .. }) = when(line, &mut reading.instants) else {
            reading.skip(number, format!("{} does not begin with a date and a time", beginning(text(line).trim())));
            continue;
        };
        let behind = text(behind);
        let Some(event) = event(&behind) else {
            others += 1;
            continue;
        };
        if event.is_group {
            of_groups += 1;
            continue;
        }
        let (state, unit) = measured(event.state);
        if event.is_update && last.get(event.item).is_some_and(|last| last == state) {
            continue;
        }
        if reading.event(number, at, event.item, state)? {
            last.insert(event.item.into(), state.into());
            if let Some(unit) = unit.map(str::to_owned) {
                reading.know(SensorInfo { unit: Some(unit), ..SensorInfo::named(event.item) });
            }
        }
    }
    for (count, what) in [(others, "no change of an item"), (of_groups, "changes of groups, which their members tell")]
    {
        if count > 0 {
            reading.log.remarks.push(format!("{} passed over: {what}", counted(count, "line is", "lines are")));
        }
    }
    Ok(())
}

/// A state without its unit, and the unit: `21.5 °C`. An unknown state becomes `unavailable`, as in other forms.
fn measured(state: &str) -> (&str, Option<&str>) {
    match state.split_once(' ') {
        _ if state == "NULL" || state == "UNDEF" => ("unavailable", None),
        Some((number, unit)) if is_number(number) && !unit.contains(' ') => (number, Some(unit)),
        _ => (state, None),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_has_one_item_or_none() {
        for (behind, told) in [
            (
                " [INFO ] [openhab.event.ItemStateChangedEvent   ] - Item 'Hall_Motion' changed from OFF to ON",
                Some(("Hall_Motion", "ON")),
            ),
            (" [vent.ItemStateChangedEvent] - Hall_Motion changed from OFF to ON", Some(("Hall_Motion", "ON"))),
            (" [INFO ] [runtime.busevents] - Front_Door state updated to OPEN", Some(("Front_Door", "OPEN"))),
            (
                " [INFO ] [openhab.event.ItemStateChangedEvent] - Item 'T' changed from 21.4 °C to 21.5 °C (source: mqtt)",
                Some(("T", "21.5 °C")),
            ),
            (" [INFO ] [openhab.event.ItemCommandEvent] - Item 'Light' received command ON", None),
            (" [INFO ] [ab.event.ThingStatusInfoChangedEvent] - Thing 'astro:sun:local' changed from A to B", None),
            (" [INFO ] [hab.event.ThingStatusInfoChangedEvent] - 'astro:sun:local' changed from A to B", None),
            (" M001 ON", None),
        ] {
            assert_eq!(event(behind).map(|event| (event.item, event.state)), told, "{behind}");
        }
    }

    #[test]
    fn separates_a_unit_from_its_number() {
        assert_eq!(measured("21.5 °C"), ("21.5", Some("°C")));
        assert_eq!(measured("UNDEF"), ("unavailable", None));
        assert_eq!(measured("Living Room"), ("Living Room", None));
    }
}
