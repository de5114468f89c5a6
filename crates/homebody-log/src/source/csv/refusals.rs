//! Refuses tables with instants that are not logs of sensors: lists of calls, purchases and visits, and logs of programs.

use super::pick::Pick;
use crate::limits::beginning;
use crate::log::ColumnRole;
use crate::source::columns::{CERTAIN, is_certain_sensor, is_price, plain};
use crate::source::messages::TableMessage;
use homebody_core::names::words;
use homebody_core::role::Role;
use homebody_core::sensed::{Kind, Meaning, meaning};
use homebody_core::vocabulary::{DOOR_WORDS, ROLE_WORDS, has_any};
use std::collections::BTreeSet;

/// Headings of what is bought and used at home: such lists may have prices.
const USED: [&str; 10] = ["kwh", "wh", "kw", "m³", "m3", "usage", "consumption", "energy", "gas", "verbrauch"];

type IsText = fn(&str) -> bool;

impl Pick<'_> {
    /// Refuses rows without a heading of a time, a number and a thing that is used or opened, in any order: nothing says whether the
    /// number is a duration or a reading.
    pub fn no_lengths(&self, sensor: usize, value: usize) -> Result<(), TableMessage> {
        /// Longest use of a thing, in seconds (our choice).
        const LONGEST_S: f64 = 1e6;
        let (things, numbers) = (self.cells(sensor), self.cells(value));
        let may_last = |text: &String| {
            text.replace(',', ".").parse::<f64>().is_ok_and(|number| number > 0.0 && number < LONGEST_S)
        };
        let may_be = !self.first.has_heading
            && numbers.texts.len() > 2
            && numbers.texts.keys().all(may_last)
            && things.texts.keys().all(|name| is_used(name))
            && things.texts.keys().any(|name| measures_nothing(name));
        if !may_be {
            return Ok(());
        }
        let names = |number: &'static str| {
            let mut columns: Vec<(usize, &str)> = vec![(sensor, "sensor"), (value, number)];
            let times: Vec<usize> = self.all_taken(ColumnRole::Time).collect();
            let names_of_times = if times.len() > 1 { &["date", "time"][..] } else { &["time"] };
            columns.extend(times.into_iter().zip(names_of_times.iter().copied()));
            columns.sort_unstable();
            columns.iter().map(|(_, name)| *name).collect::<Vec<_>>().join(",")
        };
        let (intervals, readings) = (names("duration"), names("value"));
        Err(TableMessage::OpenNumbers { column: value + 1, intervals, readings })
    }

    /// Refuses a table by what its columns hold, if none is certain to name sensors.
    pub fn no_other_list(&self) -> Result<(), TableMessage> {
        let columns = || (0..self.first.cells.len()).filter(|&column| self.cells(column).filled > 0);
        let names = &self.first.names;
        if !self.first.has_heading || columns().any(|column| is_certain_sensor(&names[column])) {
            return Ok(());
        }
        let is_of = |column: usize, is: IsText| {
            let cells = self.cells(column);
            cells.are_mostly(cells.texts.iter().filter(|(text, _)| is(text)).map(|(_, count)| count).sum())
        };
        let kinds: [(IsText, &'static str); 3] =
            [(is_page, "addresses of web pages"), (is_mail, "e-mail addresses"), (is_phone, "telephone numbers")];
        let found = kinds.iter().find_map(|(is, what)| Some((columns().find(|&column| is_of(column, *is))?, *what)));
        let other_list =
            |column: usize, content| TableMessage::OtherList { column: beginning(&names[column]), content };
        if let Some((column, what)) = found {
            return Err(other_list(column, what));
        }
        if let Some(question) = columns().find(|&column| names[column].ends_with('?') && names[column].contains(' ')) {
            return Err(other_list(question, "answers to a question"));
        }
        let all: Vec<String> = names.iter().map(|name| plain(name)).collect();
        let has = |wanted: &[&str]| columns().any(|column| wanted.contains(&all[column].as_str()));
        let moves = |wanted: &[&str]| {
            columns().any(|column| wanted.contains(&all[column].as_str()) && self.cells(column).hardly_come_again())
        };
        if moves(&["latitude", "lat"]) && moves(&["longitude", "lon", "lng", "long"]) {
            return Err(TableMessage::Track);
        }
        if has(&["subject"]) && has(&["startdate"]) && has(&["enddate"]) {
            return Err(TableMessage::Calendar);
        }
        let is_used = |column: usize| {
            let is_of = |text: &str| USED.contains(&text.to_lowercase().as_str());
            let mut words = names[column].split(|c: char| !c.is_alphanumeric());
            words.any(is_of) || self.cells(column).texts.keys().any(|text| is_of(text))
        };
        match columns().find(|&column| is_price(&names[column]) || self.cells(column).are(self.cells(column).money)) {
            Some(price) if !columns().any(is_used) => Err(other_list(price, "prices")),
            _ => Ok(()),
        }
    }

    /// Refuses names that hardly come again, and values that are sentences: these are other tables.
    pub fn no_keys(&self, sensor: usize, value: Option<usize>) -> Result<(), TableMessage> {
        let cells = self.cells(sensor);
        let is_certain = self.first.has_heading && is_certain_sensor(&self.first.names[sensor]);
        let name = |column: usize| beginning(&self.first.names[column]);
        if cells.hardly_come_again() && !is_certain {
            let (column, names, rows) = (name(sensor), cells.texts.len(), cells.filled);
            return Err(TableMessage::ManyNames { column, names, rows });
        }
        if let Some(sentences) = value.and_then(|value| self.devices_in_sentences(sensor, value)) {
            return Err(TableMessage::DevicesInSentences { column: name(sentences), measured: name(sensor) });
        }
        if let Some(value) = value
            && let cells = self.cells(value)
            && cells.are_mostly(cells.sentences)
            && cells.hardly_come_again()
        {
            return Err(TableMessage::Sentences { column: name(value) });
        }
        Ok(())
    }

    pub fn no_program_log(&self) -> Result<(), TableMessage> {
        let columns = 0..self.first.cells.len();
        let is_known = |role| {
            columns.clone().any(|column| self.heading(column).is_some_and(|(of, rank)| of == role && rank < CERTAIN))
        };
        let grave = (0..self.first.cells.len()).find(|&column| {
            let cells = self.cells(column);
            cells.are(cells.severities) && cells.filled > 1
        });
        match grave {
            Some(column) if !(is_known(ColumnRole::Sensor) && is_known(ColumnRole::Value)) => {
                let words: Vec<&str> = self.cells(column).texts.keys().map(String::as_str).take(3).collect();
                let column = beginning(&self.first.names[column]);
                Err(TableMessage::ProgramLog { column, levels: words.join(", ") })
            }
            _ => Ok(()),
        }
    }
}

impl Pick<'_> {
    /// A column of sentences that say more than what is measured and its value, where no column names devices.
    fn devices_in_sentences(&self, sensor: usize, value: usize) -> Option<usize> {
        let cells = self.cells(sensor);
        if !self.first.has_heading || !cells.are(cells.kinds) || self.all_taken(ColumnRole::Room).next().is_some() {
            return None;
        }
        let pairs: BTreeSet<(&str, &str)> = self.first.column(sensor).zip(self.first.column(value)).collect();
        self.free().into_iter().find(|column| {
            let of = self.cells(*column);
            of.are_mostly(of.sentences) && of.texts.len() > pairs.len() && of.come_again()
        })
    }

    /// The free column whose texts hardly come again, as those of titles and messages.
    pub fn prose(&self) -> Option<usize> {
        let is_prose = |column: &usize| {
            let cells = self.cells(*column);
            let has_words = cells.texts.keys().filter(|text| text.trim().contains(' ')).count();
            cells.hardly_come_again() && cells.numbers == 0 && 2 * has_words > cells.texts.len()
        };
        self.free().into_iter().find(is_prose)
    }
}

fn is_page(text: &str) -> bool {
    text.starts_with("http://") || text.starts_with("https://") || text.starts_with("www.")
}

fn is_mail(text: &str) -> bool {
    text.split_once('@')
        .is_some_and(|(user, host)| !user.is_empty() && host.contains('.') && !text.contains([' ', '/']))
}

/// `+41 79 555 00 10`: more digits than a value has.
fn is_phone(text: &str) -> bool {
    let digits = text.bytes().filter(u8::is_ascii_digit).count();
    text.starts_with('+')
        && digits >= 8
        && text[1..].bytes().all(|byte| byte.is_ascii_digit() || b" -()/".contains(&byte))
}

/// Whether a name is that of a thing that people use or open, and none of what is measured.
fn is_used(name: &str) -> bool {
    match meaning(name, "") {
        Some(Meaning::Is(kind)) => matches!(kind, Kind::Used | Kind::Contact),
        Some(Meaning::UseOrReading | Meaning::ReadingOnly) => false,
        Some(Meaning::PresenceByName) => true,
        None => {
            let words = words(name);
            has_any(&words, DOOR_WORDS) || ROLE_WORDS.iter().any(|(_, known)| has_any(&words, known))
        }
    }
}

/// Whether it is that of a thing that measures no power and no warmth: a door, a bed, a seat, a toilet.
fn measures_nothing(name: &str) -> bool {
    const ROLES: [Role; 10] = [
        Role::Bed,
        Role::Sofa,
        Role::Armchair,
        Role::DiningSeat,
        Role::Toilet,
        Role::Shower,
        Role::Washbasin,
        Role::Wardrobe,
        Role::Drawers,
        Role::Bookcase,
    ];
    let words = words(name);
    let is_such = || ROLE_WORDS.iter().any(|(role, known)| ROLES.contains(role) && has_any(&words, known));
    has_any(&words, DOOR_WORDS) || is_such()
}
