//! The kinds of places: those of this crate, and those of plugins in crates of their own, which not every build has.
//!
//! A program builds one [`Registry`] and stores it once, before all else, by [`install`]. It is not handed over, since what depends on it
//! begins with a place alone: `Source::from_str`, `read`, `Destination::new` and nearly all else that this crate offers.

use crate::check::Examine;
use crate::error::{LogError, place_of};
use crate::policy::Policy;
use crate::preview::{self, Preview, ReadFirstRows};
use crate::sink::sqlite::Sqlite;
use crate::sink::{Begin, Casas, Csv, FleetJsonl, FleetSink, Jsonl, Sink, TextRows, Watermark};
use crate::source::messages::FormMessage;
use crate::source::table_files::{ReadTable, read_csv, read_jsonl};
use crate::source::{
    FileStart, LogForm, LogReading, ReadTables, Shows, casas, csv, domoticz, each_second, esphome, home_assistant,
    influx, intervals, json, jsonl, labels, mit, mosquitto, openhab, psql, sqlite, tasmota, xes, zigbee2mqtt,
};
use crate::table::Batch;
use crate::url::Url;
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::scenario::scheme::{NoPlace, SCHEMES, Scheme};
use homebody_core::time::RunTime;
use std::path::Path;
use std::sync::OnceLock;

/// Opens the sink of a fleet.
pub type OpenFleet = fn(&Url) -> Box<dyn FleetSink>;

/// A kind of place in a crate of its own.
#[derive(Clone, Copy)]
pub struct PlacePlugin {
    /// The kinds in `crates/homebody-core/src/scenario/scheme.rs` that it is about.
    pub schemes: &'static [Scheme],
    /// The sink of a place. Nothing is touched before it is begun.
    pub open: fn(&Url) -> Box<dyn Sink>,
    /// The sink of a fleet at such a place; None where no fleet can write there.
    pub fleet: Option<OpenFleet>,
    /// The usual policy of such a destination.
    pub policy: fn() -> Policy,
    /// The forms of logs that it reads.
    pub forms: &'static [LogForm],
    /// Reads the tables of a truth there; None where no place of this kind keeps one.
    pub tables: Option<ReadTables>,
    /// The truth of the run with a log at a place of this kind; None if the place cannot name one.
    pub truth_of: Option<fn(&Url) -> Option<Url>>,
    /// Checks such a place.
    pub examine: Examine,
}

/// The plugins of a build.
#[derive(Default)]
pub struct Registry {
    plugins: Vec<PlacePlugin>,
}

static INSTALLED: OnceLock<Registry> = OnceLock::new();

/// Stores the registry of the whole program. Only the first call does.
pub fn install(registry: Registry) {
    let _ = INSTALLED.set(registry);
}

impl Registry {
    /// The registry of a build with these plugins.
    pub fn new(plugins: Vec<PlacePlugin>) -> Registry {
        Registry { plugins }
    }
}

fn plugins() -> &'static [PlacePlugin] {
    INSTALLED.get().map(|registry| &registry.plugins[..]).unwrap_or_default()
}

/// The plugin of a kind of place.
///
/// # Errors
///
/// [`LogError::NotBuiltIn`] without one.
pub(crate) fn plugin(url: &Url) -> Result<&'static PlacePlugin, LogError> {
    plugins().iter().find(|plugin| plugin.schemes.contains(&url.scheme())).ok_or_else(|| not_built_in(url))
}

pub(crate) fn policy(url: &Url) -> Policy {
    let usual = if url.is_output() { Policy::of_server } else { Policy::default };
    plugin(url).map_or_else(|_| usual(), |plugin| (plugin.policy)())
}

/// The sink of a kind that is not in this build: to begin it is an error that says how to get it.
struct MissingSink(Url);

impl Sink for MissingSink {
    fn begin(&mut self, _: &Begin) -> Result<Watermark, LogError> {
        Err(not_built_in(&self.0))
    }

    fn write(&mut self, _: &Batch) -> Result<(), LogError> {
        Err(not_built_in(&self.0))
    }

    fn make_durable(&mut self) -> Result<Watermark, LogError> {
        Err(not_built_in(&self.0))
    }

    fn finish(&mut self, _: RunTime) -> Result<(), LogError> {
        Err(not_built_in(&self.0))
    }
}

fn not_built_in(url: &Url) -> LogError {
    let row = url.scheme().row();
    LogError::NotBuiltIn { place: url.to_string(), name: row.name, feature: row.feature.unwrap_or(row.name) }
}

/// A kind of place that every build can write.
pub(crate) struct BuiltIn {
    scheme: Scheme,
    /// The sink of a place; a text file that is followed has its name from its first line on, so that it can be read while it grows.
    open: fn(&Url, bool) -> Box<dyn Sink>,
    fleet: Option<OpenFleet>,
    first_rows: ReadFirstRows,
    /// The form that reads a log there.
    form: &'static LogForm,
    /// Reads the file of one table; None if tables have no files of their own.
    pub table: Option<ReadTable>,
}

const BUILT_IN: &[BuiltIn] = &[
    BuiltIn {
        scheme: Scheme::Sqlite,
        open: |url, _| Box::new(Sqlite::new(url.file().map(Into::into).unwrap_or_default())),
        fleet: None,
        first_rows: preview::database,
        form: &sqlite::FORM,
        table: None,
    },
    BuiltIn {
        scheme: Scheme::Csv,
        open: TextRows::<Csv>::at,
        fleet: None,
        first_rows: preview::values,
        form: &csv::FORM,
        table: Some(read_csv),
    },
    BuiltIn {
        scheme: Scheme::Casas,
        open: TextRows::<Casas>::at,
        fleet: None,
        first_rows: preview::lines,
        form: &casas::FORM,
        table: None,
    },
    BuiltIn {
        scheme: Scheme::Jsonl,
        open: TextRows::<Jsonl>::at,
        fleet: Some(|url| Box::new(FleetJsonl::new(url))),
        first_rows: preview::objects,
        form: &jsonl::FORM,
        table: Some(read_jsonl),
    },
];

pub(crate) fn built_in(scheme: Scheme) -> Option<&'static BuiltIn> {
    BUILT_IN.iter().find(|row| row.scheme == scheme)
}

/// The kind of place that every build can write, by the form of its logs.
pub(crate) fn built_in_with_form(form: &LogForm) -> Option<&'static BuiltIn> {
    BUILT_IN.iter().find(|row| row.form == form)
}

/// The sink of a place. Nothing is touched before it is begun.
pub fn sink(url: &Url) -> Box<dyn Sink> {
    sink_as(url, false)
}

/// The same; a text file that `is_followed` has its name from its first line on, so that it can be read while it grows.
pub(crate) fn sink_as(url: &Url, is_followed: bool) -> Box<dyn Sink> {
    match (built_in(url.scheme()), plugin(url)) {
        (Some(row), _) => (row.open)(url, is_followed),
        (None, Ok(plugin)) => (plugin.open)(url),
        (None, Err(_)) => Box::new(MissingSink(url.clone())),
    }
}

/// The sink of a fleet at a place. Nothing is touched before it is begun.
///
/// # Errors
///
/// [`LogError::NoPlace`] for a kind of place that no fleet can write, which lists the others; [`LogError::NotBuiltIn`] for one that
/// this build does not have.
pub fn fleet_sink(url: &Url) -> Result<Box<dyn FleetSink>, LogError> {
    if !url.scheme().row().takes_fleets {
        return Err(no_fleet(url));
    }
    let open = match built_in(url.scheme()) {
        Some(row) => row.fleet,
        None => plugin(url)?.fleet,
    };
    open.map(|open| open(url)).ok_or_else(|| no_fleet(url))
}

fn no_fleet(url: &Url) -> LogError {
    let rows = SCHEMES.iter().filter(|row| row.takes_fleets);
    let can: Vec<String> = rows.map(|row| format!("{}:{}", row.name, row.at)).collect();
    let what = format!("{url} has no room for many homes");
    LogError::NoPlace(NoPlace { what, hint: format!("a fleet writes {}, and jsonl:-", can.join(", ")) })
}

/// The first rows of a complete log, which was written with this mapping; none of servers and files that are not text.
pub fn first_rows(url: &Url, file: &LoggerFile, most: usize) -> Result<Preview, LogError> {
    let path = url.file().unwrap_or(Path::new(""));
    built_in(url.scheme()).map_or_else(|| Ok(Preview::default()), |row| (row.first_rows)(path, file, most))
}

/// The forms of logs that every build has. A file is of the first whose signs it shows.
pub const FORMS: &[LogForm] = &[
    home_assistant::FORM,
    domoticz::FORM,
    sqlite::FORM,
    jsonl::FORM,
    json::FORM,
    zigbee2mqtt::FORM,
    esphome::FORM,
    tasmota::FORM,
    mosquitto::FORM,
    influx::lines::FORM,
    influx::csv::FORM,
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

/// The forms that this build has, with those of plugins.
pub fn forms() -> impl Iterator<Item = &'static LogForm> + Clone {
    FORMS.iter().chain(plugins().iter().flat_map(|plugin| plugin.forms))
}

/// The form of this name; also one that this build cannot read.
pub(crate) fn form_named(name: &str) -> Option<&'static LogForm> {
    forms().chain(MISSING).find(|form| form.name == name)
}

/// The form of a kind of place. If this build cannot read it, reading it is an error that says so.
pub(crate) fn form_of_scheme(scheme: Scheme) -> &'static LogForm {
    built_in(scheme).map(|row| row.form).or_else(|| form_named(scheme.row().name)).unwrap_or(&BROKER)
}

pub(crate) fn form_shown(start: &FileStart) -> Option<(&'static LogForm, Shows)> {
    forms().map(|form| (form, (form.shows)(start))).find(|(_, shows)| *shows != Shows::Nothing)
}

/// The forms of plugins that a build may lack.
const MISSING: &[LogForm] = &[
    missing::<{ Scheme::Parquet as usize }>(),
    missing::<{ Scheme::Arrow as usize }>(),
    missing::<{ Scheme::Postgresql as usize }>(),
];

/// A form whose reading says how to get the plugin of a kind of place.
const fn missing<const SCHEME: usize>() -> LogForm {
    fn read<const SCHEME: usize>(path: &Path, _: &LoggerFile, _: &mut LogReading) -> Result<(), LogError> {
        Err(not_built_in(&Url::new(SCHEMES[SCHEME].scheme, path)))
    }
    LogForm { name: SCHEMES[SCHEME].name, what: SCHEMES[SCHEME].what, shows: |_| Shows::Nothing, read: read::<SCHEME> }
}

/// The form of places that cannot be read.
const BROKER: LogForm = LogForm {
    name: "mqtt",
    what: "a broker, which keeps no log",
    shows: |_| Shows::Nothing,
    read: |path, _, _| Err(LogError::no_log(place_of(path), FormMessage::Broker)),
};

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_core::scenario::scheme::{Stands, TablePlacement};

    #[test]
    fn each_place_of_this_crate_has_a_form_of_its_name_and_a_reader_of_its_tables() {
        for row in SCHEMES.iter().filter(|row| row.feature.is_none()) {
            let built_in = built_in(row.scheme).expect("every build has it");
            assert!(built_in.form.name == row.name && FORMS.contains(built_in.form), "{}", row.name);
            assert_eq!(built_in.table.is_some(), row.tables == TablePlacement::FileEach, "{}", row.name);
            assert_eq!(built_in.fleet.is_some(), row.takes_fleets, "{}", row.name);
            assert_ne!(row.stands, Stands::Server, "{}", row.name);
        }
        assert!(BUILT_IN.iter().all(|row| row.scheme.row().feature.is_none()));
    }
}
