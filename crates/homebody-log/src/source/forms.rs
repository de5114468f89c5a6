//! All forms of logs, and the form of a file.

use super::form::{Form, Shows};
use super::form_messages::FormMessage;
use super::reading::Reading;
use super::start::Start;
use super::{
    casas, csv, domoticz, each_second, esphome, home_assistant, influx_csv, influx_lines, intervals, json, jsonl,
    labels, mit, mosquitto, openhab, psql, sqlite, tasmota, xes, zigbee2mqtt,
};
use crate::elsewhere;
use crate::error::{LogError, place_of};
use crate::url::Url;
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::scenario::scheme::{SCHEMES, Scheme};
use std::path::Path;

/// All forms that every build has. A file is of the first whose signs it shows.
pub const FORMS: [Form; 23] = [
    home_assistant::FORM,
    domoticz::FORM,
    sqlite::FORM,
    jsonl::FORM,
    json::FORM,
    zigbee2mqtt::FORM,
    esphome::FORM,
    tasmota::FORM,
    mosquitto::FORM,
    influx_lines::FORM,
    influx_csv::FORM,
    xes::FORM,
    psql::FORM,
    mit::FORM,
    intervals::FORM,
    each_second::ARAS,
    each_second::OPENSHS,
    csv::INTERVALS,
    csv::WIDE,
    labels::FORM,
    openhab::FORM,
    csv::FORM,
    casas::FORM,
];

/// The forms that this build has, with those of crates of their own.
pub fn forms() -> impl Iterator<Item = &'static Form> + Clone {
    const OWN: &[Form] = &FORMS;
    OWN.iter().chain(elsewhere::installed().iter().flat_map(|elsewhere| elsewhere.forms))
}

/// The form of a kind of place. Where this build cannot read it, reading it is an error that says so.
pub(super) fn of_scheme(scheme: Scheme) -> &'static Form {
    let row = scheme.row();
    let absent = ABSENT.iter().find(|form| form.name == row.name);
    forms().find(|form| form.name == row.name).or(absent).unwrap_or(&UNREAD)
}

/// Kinds of places that a build may not be able to read.
pub(super) const ABSENT: &[Form] = &[absent::<4>(), absent::<5>(), absent::<6>()];

/// Kinds of places from which nothing is read.
const UNREAD: Form = Form {
    name: "mqtt",
    what: "a broker, which keeps no log",
    shows: |_| Shows::Nothing,
    read: |path, _, _| Err(LogError::no_log(place_of(path), FormMessage::Broker)),
};

/// The form of a row of the table of kinds.
const fn absent<const ROW: usize>() -> Form {
    fn read<const ROW: usize>(path: &Path, _: &LoggerFile, _: &mut Reading) -> Result<(), LogError> {
        Err(elsewhere::not_built_in(&Url::new(SCHEMES[ROW].scheme, path)))
    }
    Form { name: SCHEMES[ROW].name, what: SCHEMES[ROW].what, shows: |_| Shows::Nothing, read: read::<ROW> }
}

/// The form that a file shows, and what of it.
pub(super) fn shown(start: &Start) -> Option<(&'static Form, Shows)> {
    forms().map(|form| (form, (form.shows)(start))).find(|(_, shows)| *shows != Shows::Nothing)
}
