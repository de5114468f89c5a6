//! Finds out what the words of a CASAS text mean: by their behaviour in its beginning, not by their position alone.
//!
//! In a sensor log few names repeat, each with values of a small set or numbers. The lines of a program's log begin with a date
//! and a time, too, but their words vary.

use super::words::{CasasTime, is_damaged, is_number, is_value, part, parted_note, when};
use crate::log::ColumnRole;
use crate::source::instant::InstantReader;
use crate::source::messages::FormMessage;
use crate::source::reading::LogReading;
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};

/// The number of rows that decide.
const LOOKED_AT_ROWS: usize = 1000;

/// From so many rows on, names have to repeat.
const MANY_ROWS: usize = 20;

/// Largest number of words before the value.
const MOST_BEFORE: usize = 3;

/// Before the kind of a sensor there is always its value.
pub(crate) const KIND: &[u8] = b"Control4-";

/// The words between a sensor and its value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum BetweenWords {
    Nothing,
    /// The sensor once more.
    Again,
    /// The name of the reading, as in `Hall_PIR motion: on`.
    Reading,
    Room,
    RoomAndPlace,
}

/// The meaning of the words behind a row's time.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct CasasLayout {
    /// Whether tabs part the words, which may have blanks in them.
    pub is_tabbed: bool,
    pub between: BetweenWords,
    /// Which word is the value.
    pub value: usize,
    /// Whether the sensor's kind is behind the value.
    pub has_kind: bool,
    /// Whether pairs of numbers follow the value: a person and an activity.
    pub has_people: bool,
    /// Whether most rows have a label: then a word such as `week-end` is one.
    pub is_labelled: bool,
    /// Frequent values, which cannot be damage.
    usual: BTreeSet<String>,
    of_time: usize,
    /// The names of the columns, where the first line has them.
    heading: Vec<String>,
    /// Counts of rows, of sensors, of rows with a state or a number, and of rows with further words.
    counts: [usize; 4],
}

/// Words behind the time of a row.
type RowWords = Vec<String>;

struct FirstLines {
    rows: Vec<RowWords>,
    /// The number of other lines.
    others: usize,
    is_tabbed: bool,
    of_time: usize,
    heading: Vec<String>,
}

impl CasasLayout {
    /// The layout of a text whose first lines these are, or a message that says what they look like.
    pub fn find<'l>(lines: impl Iterator<Item = Cow<'l, str>>) -> Result<CasasLayout, FormMessage> {
        let rows = FirstLines::read(lines);
        let layout = rows.layout();
        match rows.objection(&layout) {
            None => Ok(layout),
            Some(objection) => Err(objection),
        }
    }

    /// The likeliest layout of a text that the user calls CASAS, however its lines look.
    pub fn said<'l>(lines: impl Iterator<Item = Cow<'l, str>>) -> CasasLayout {
        FirstLines::read(lines).layout()
    }

    pub fn is_heading(&self, line: &[u8]) -> bool {
        !self.heading.is_empty() && heading(&String::from_utf8_lossy(line)) == self.heading
    }

    /// Whether rows have more about a sensor than its value.
    pub fn tells_of_sensors(&self) -> bool {
        self.has_kind || matches!(self.between, BetweenWords::Reading | BetweenWords::Room | BetweenWords::RoomAndPlace)
    }

    /// Whether a value looks like a usual one that was damaged, such as `ONc`.
    pub fn is_damaged(&self, value: &str) -> bool {
        is_damaged(value) && !self.usual.contains(value)
    }

    /// Whether a value is odd: neither a state nor a number, where nearly all are.
    pub fn is_odd(&self, value: &str) -> bool {
        let [rows, _, valued, _] = self.counts;
        valued * 10 >= rows * 9 && !is_value(value) && !self.usual.contains(value)
    }

    pub fn record(&self, reading: &mut LogReading<'_>) {
        let [rows, sensors, valued, behind] = self.counts;
        if rows == 0 {
            return;
        }
        let mut column = |place: usize, role: ColumnRole, because: String| {
            let name = self.heading.get(place).filter(|_| self.is_tabbed);
            let name = name.cloned().unwrap_or_else(|| format!("column {}", place + 1));
            reading.column(&name, role, &because);
        };
        for place in 0..self.of_time {
            column(place, ColumnRole::Time, "each row begins with a date and a time".into());
        }
        let first = self.of_time;
        column(first, ColumnRole::Sensor, format!("{sensors} names repeat in the first {rows} rows"));
        match self.between {
            BetweenWords::Nothing => {}
            BetweenWords::Again => column(first + 1, ColumnRole::Unused, "it repeats the sensor".into()),
            BetweenWords::Reading => {
                column(first + 1, ColumnRole::Kind, "a colon is behind the name of a reading".into())
            }
            BetweenWords::Room => column(first + 1, ColumnRole::Room, "each sensor has one word here".into()),
            BetweenWords::RoomAndPlace => {
                column(first + 1, ColumnRole::Room, "each sensor has one word here".into());
                column(first + 2, ColumnRole::Room, "each sensor has one word here: its place in the room".into());
            }
        }
        let value = first + self.value;
        column(value, ColumnRole::Value, format!("a state or a number in {valued} of the first {rows} rows"));
        if self.has_kind {
            column(value + 1, ColumnRole::Kind, "it names a kind of sensor, one for each sensor".into());
        }
        if behind > 0 {
            let place = value + 1 + usize::from(self.has_kind);
            let what = match (self.has_people, self.is_labelled) {
                (true, _) => "the numbers of a person and an activity",
                (false, true) => "a label",
                (false, false) => "a note",
            };
            column(place, ColumnRole::Label, format!("{what} in {behind} of the first {rows} rows"));
        }
    }
}

/// The names of columns in a line, if it looks like a heading: words without digits that say what columns hold.
fn heading(line: &str) -> Vec<String> {
    const NAMES: [&str; 9] =
        ["date", "time", "datetime", "timestamp", "sensor", "message", "value", "translate01", "sensortype"];
    let has_tabs = line.contains('\t');
    let delimiter = |c: char| if has_tabs { c == '\t' } else { c.is_whitespace() };
    let words: Vec<String> = line.split(delimiter).map(|word| word.trim().trim_matches('"').to_owned()).collect();
    let known = words.iter().filter(|word| NAMES.contains(&word.to_ascii_lowercase().as_str())).count();
    if known >= 2 { words } else { Vec::new() }
}

impl FirstLines {
    fn read<'l>(lines: impl Iterator<Item = Cow<'l, str>>) -> FirstLines {
        let mut instants = InstantReader::default();
        let (mut behind, mut others, mut of_time, mut names) = (Vec::new(), 0, 2, Vec::new());
        for (number, line) in lines.take(LOOKED_AT_ROWS).enumerate() {
            match when(line.as_bytes(), &mut instants) {
                Some(CasasTime { behind: rest, words, .. }) => {
                    if behind.is_empty() {
                        of_time = words;
                    }
                    behind.push(String::from_utf8_lossy(rest).into_owned());
                }
                None if number == 0 && !heading(&line).is_empty() => names = heading(&line),
                None => others += 1,
            }
        }
        // A word of its own in most rows, and not only a tab before a note.
        let tabbed = behind.iter().filter(|rest| rest.trim().split('\t').count() >= 2).count();
        let tabs =
            behind.iter().filter(|rest| rest.trim().split('\t').next().is_some_and(|word| !is_row(word))).count();
        let is_tabbed = !behind.is_empty() && tabbed * 10 >= behind.len() * 8 && tabs * 10 >= behind.len() * 8;
        let words = |rest: &String| {
            let mut places = Vec::new();
            part(rest.as_bytes(), is_tabbed, &mut places);
            places.into_iter().map(|place| rest[place].to_owned()).collect()
        };
        let rows: Vec<RowWords> = behind.iter().map(words).filter(|words: &RowWords| words.len() >= 2).collect();
        let others = others + behind.len() - rows.len();
        FirstLines { rows, others, is_tabbed, of_time, heading: names }
    }

    fn layout(&self) -> CasasLayout {
        let (value, between) = self.value();
        let has_kind = self.has_kind(value);
        let behind = value + 1 + usize::from(has_kind);
        let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
        for word in self.rows.iter().filter_map(|row| row.get(value)) {
            *counts.entry(word).or_default() += 1;
        }
        let often = (self.rows.len() / 100).max(2);
        let usual = counts.iter().filter(|(_, count)| **count > often).map(|(word, _)| (*word).to_owned()).collect();
        let with_more = self.rows.iter().filter(|row| row.len() > behind).count();
        let names: BTreeSet<&str> = self.rows.iter().map(|row| row[0].as_str()).collect();
        CasasLayout {
            is_tabbed: self.is_tabbed,
            between,
            value,
            has_kind,
            has_people: self.has_people(behind),
            is_labelled: with_more * 10 >= self.rows.len() * 6 && !self.has_pairs(behind),
            usual,
            of_time: self.of_time,
            heading: self.heading.clone(),
            counts: [self.rows.len(), names.len(), self.valued(value), with_more],
        }
    }

    /// The number of rows with a state or a number in this place.
    fn valued(&self, place: usize) -> usize {
        self.rows.iter().filter(|row| row.get(place).is_some_and(|word| is_value(word))).count()
    }

    /// The place of the value, and the words before it.
    fn value(&self) -> (usize, BetweenWords) {
        let rows = self.rows.len();
        if self.valued(1) * 2 >= rows {
            return (1, BetweenWords::Nothing);
        }
        let found = (2..=MOST_BEFORE).find(|&place| {
            // Numbers alone stand in any text.
            let is_state = |row: &RowWords| row.get(place).is_some_and(|word| is_value(word) && !is_number(word));
            let has_values = self.valued(place) * 10 >= rows * 8 && self.rows.iter().any(is_state);
            has_values && (1..place).all(|before| self.is_of_sensor(before))
        });
        let again = self.rows.iter().filter(|row| row.len() > 2 && row[0] == row[1]).count();
        match found {
            Some(2) if again == rows => (2, BetweenWords::Again),
            Some(2) if self.rows.iter().all(|row| row.len() > 2 && row[1].ends_with(':')) => (2, BetweenWords::Reading),
            Some(2) => (2, BetweenWords::Room),
            Some(place) => (place, BetweenWords::RoomAndPlace),
            None if rows > 0 && again * 10 >= rows * 9 => (2, BetweenWords::Again),
            None => (1, BetweenWords::Nothing),
        }
    }

    /// Whether a word in this place belongs to the sensor: each sensor has one.
    fn is_of_sensor(&self, place: usize) -> bool {
        let mut words: BTreeMap<&str, BTreeMap<&str, usize>> = BTreeMap::new();
        for row in &self.rows {
            let word = row.get(place).map_or("", String::as_str);
            *words.entry(&row[0]).or_default().entry(word).or_default() += 1;
        }
        let first: usize = words.values().filter_map(|words| words.values().max()).sum();
        first * 10 >= self.rows.len() * 9
    }

    /// Whether kinds of sensors are behind the value.
    fn has_kind(&self, value: usize) -> bool {
        let is_kind = |row: &&RowWords| row.get(value + 1).is_some_and(|word| kind(word).is_some());
        let kinds = self.rows.iter().filter(is_kind).count();
        kinds > 0 && kinds * 10 >= self.rows.len() * 8 && self.is_of_sensor(value + 1)
    }

    /// Whether most rows end in pairs of small numbers: a person, and what the person did.
    fn has_people(&self, behind: usize) -> bool {
        let is_pair = |row: &&RowWords| people(row.get(behind..).unwrap_or_default()).is_some();
        let pairs = self.rows.iter().filter(is_pair).count();
        let persons: BTreeSet<&String> = self.rows.iter().filter_map(|row| row.get(behind)).collect();
        pairs > 0 && pairs * 10 >= self.rows.len() * 6 && persons.len() <= MOST_PEOPLE
    }

    /// Whether some note says that an activity begins and another that it ends.
    fn has_pairs(&self, behind: usize) -> bool {
        let mut told: BTreeMap<String, [bool; 2]> = BTreeMap::new();
        for row in self.rows.iter().filter(|row| row.len() > behind) {
            let note = row[behind..].join(" ");
            if let (name, Some(begins)) = parted_note(&note, true) {
                told.entry(name.to_owned()).or_default()[usize::from(begins)] = true;
            }
        }
        told.values().any(|ends| *ends == [true; 2])
    }

    /// Says why the rows do not belong to a sensor log.
    fn objection(&self, layout: &CasasLayout) -> Option<FormMessage> {
        let [rows, sensors, valued, _] = layout.counts;
        if rows == 0 {
            return Some(FormMessage::NoTextRows);
        }
        if self.others > rows {
            return Some(FormMessage::FewTextRows { rows, lines: rows + self.others });
        }
        let share = |count: usize, percent: usize| count * 100 >= rows * percent;
        let programs = self.rows.iter().filter(|row| is_of_program(&row[0])).count();
        if share(programs, 30) {
            return program(format!("behind the time of line 1 is {:?}", short(&self.rows[0])));
        }
        let numbers = self.rows.iter().filter(|row| row[0].contains(['.', ',']) && is_number(&row[0])).count();
        let more_numbers = self.rows.iter().filter(|row| row.len() > 3 && row.iter().all(|word| is_number(word)));
        if share(numbers, 50) || share(more_numbers.count(), 50) {
            return Some(FormMessage::UnnamedColumns);
        }
        let nameless = self.rows.iter().filter(|row| !row[0].contains(char::is_alphanumeric)).count();
        let is_prose = rows < MANY_ROWS && !share(valued, 50) && !self.has_short_rows(layout);
        if share(nameless, 50) || is_prose || self.has_free_text(layout) {
            let words: usize = self.rows.iter().map(Vec::len).sum();
            return program(format!("{} words a line, and few that repeat as sensors do", words / rows));
        }
        if rows >= MANY_ROWS && sensors * 2 > rows {
            return Some(FormMessage::ManyNames { rows: rows as u64, names: sensors });
        }
        let values: BTreeSet<&String> = self.rows.iter().filter_map(|row| row.get(layout.value)).collect();
        let is_few = values.len() * 5 <= rows || values.len() <= 3;
        let has_values = share(valued, 50) || (is_few && (self.has_short_rows(layout) || layout.has_kind));
        match has_values {
            true => None,
            false => program(format!("only {valued} of its first {rows} rows have a state such as ON, or a number")),
        }
    }

    /// Whether sentences are behind the values of most rows: texts that hardly repeat, or are long.
    fn has_free_text(&self, layout: &CasasLayout) -> bool {
        /// Labels have fewer words.
        const MOST_WORDS: usize = 3;
        let [rows, _, _, with_more] = layout.counts;
        let behind = |row: &'_ RowWords| row.get(layout.value + 1..).unwrap_or_default().join(" ");
        let texts: BTreeSet<String> = self.rows.iter().map(behind).filter(|text| !text.is_empty()).collect();
        let words: usize = self.rows.iter().map(|row| row.len().saturating_sub(layout.value + 1)).sum();
        let is_long = !self.is_tabbed && words > with_more * MOST_WORDS;
        let is_free = texts.len() * 3 > with_more || is_long;
        is_free && with_more * 2 > rows && rows >= MANY_ROWS && !layout.has_kind && !self.has_pairs(layout.value + 1)
    }

    /// Whether nearly all rows have a sensor and a value, and nothing more.
    fn has_short_rows(&self, layout: &CasasLayout) -> bool {
        let short = self.rows.iter().filter(|row| row.len() == layout.value + 1).count();
        let is_name = |word: &str| self.is_tabbed || word.contains(|c: char| c.is_ascii_digit() || "_.-".contains(c));
        let named = self.rows.iter().filter(|row| is_name(&row[0])).count();
        let repeats = self.rows.len() >= MANY_ROWS || named * 2 >= self.rows.len();
        short * 10 >= self.rows.len() * 9 && repeats
    }
}

/// Largest number of people of a home.
const MOST_PEOPLE: usize = 8;

/// Pairs of a person and an activity, each a small number.
pub(crate) fn people(words: &[impl AsRef<str>]) -> Option<Vec<(u8, u8)>> {
    let numbers: Vec<u8> = words.iter().map(|word| word.as_ref().parse().ok()).collect::<Option<_>>()?;
    let pairs: Vec<(u8, u8)> = numbers.chunks_exact(2).map(|pair| (pair[0], pair[1])).collect();
    (!pairs.is_empty() && numbers.len().is_multiple_of(2)).then_some(pairs)
}

/// The message about a text that a program wrote for its readers.
fn program(evidence: String) -> Option<FormMessage> {
    Some(FormMessage::ProgramLog { evidence })
}

/// Whether programs write such a word behind the time: a level, a thread in brackets, a name with a colon.
fn is_of_program(word: &str) -> bool {
    const LEVELS: [&str; 20] = [
        "info", "warn", "warning", "error", "err", "debug", "trace", "fatal", "notice", "critical", "severe", "fine",
        "finer", "inf", "wrn", "dbg", "vrb", "ftl", "verbose", "crit",
    ];
    let bare = word.trim_matches(|c: char| !c.is_alphanumeric()).to_ascii_lowercase();
    word.starts_with(['[', '(', '<', '{', '|']) || word.ends_with([':', ']', '|']) || LEVELS.contains(&bare.as_str())
}

fn short(row: &[String]) -> String {
    row.iter().take(4).map(String::as_str).collect::<Vec<_>>().join(" ").chars().take(60).collect()
}

/// Whether a text has a sensor and a value in it.
fn is_row(text: &str) -> bool {
    text.split_whitespace().nth(1).is_some_and(is_value)
}

/// The kind of sensor that a word names, as `home.json` writes it; empty for kinds that Homebody lacks.
pub(crate) fn kind(word: &str) -> Option<&'static str> {
    /// The words of the homes in small letters. The first match counts.
    const KINDS: [(&str, &str); 11] = [
        ("motion", "motion"),
        ("door", "contact"),
        ("contact", "contact"),
        ("magnet", "contact"),
        ("temperature", "temperature"),
        ("battery", ""),
        ("lightsensor", "light"),
        ("light", ""),
        ("control4-", ""),
        ("zigbee", ""),
        ("item", ""),
    ];
    let word = word.to_ascii_lowercase();
    KINDS.iter().find(|(part, _)| word.contains(part)).map(|(_, kind)| *kind)
}
