//! Finds the columns that name a table's sensors: the device, its room, and what of it a row tells.

use super::cells::{CellCounts, is_blank};
use super::pick::Pick;
use crate::limits::beginning;
use crate::log::{ColumnRole, ColumnUse};
use crate::source::columns::{ATTRIBUTES, CERTAIN, is_certain_sensor, is_id, plain};
use crate::source::messages::TableMessage;
use std::collections::{BTreeMap, BTreeSet};

/// Words of rooms in English and German, as they stand in names.
const ROOMS: [&str; 22] = [
    "kitchen", "bath", "bedroom", "living", "hall", "toilet", "dining", "entrance", "office", "lounge", "corridor",
    "stairs", "garage", "study", "wc", "küche", "kueche", "bad", "schlaf", "wohn", "flur", "diele",
];

/// Words of the way that a message goes, in lower case.
const DIRECTIONS: [&str; 12] =
    ["in", "out", "incoming", "outgoing", "inbound", "outbound", "missed", "from bus", "to bus", "rx", "tx", "both"];

/// So many rows at least show that a sensor has two at one instant, or values of two kinds.
const LEAST_ROWS: usize = 3;

/// So many rows of a sensor show what they have in common.
const LEAST_ROWS_OF_SENSOR: usize = 4;

/// Number of distinct texts above which a column does not give the measured quantity.
const MOST_ATTRIBUTES: usize = 60;

impl Pick<'_> {
    /// Takes the column of the sensor. Next to several columns of values, one without a known heading is one only if it changes
    /// from row to row, or parts rows of one instant: a state such as the weather's stays.
    ///
    /// # Errors
    ///
    /// A message, where two columns are equally good.
    pub fn sensor(&mut self, beside_values: bool) -> Result<Option<usize>, TableMessage> {
        let is_sure = |column: &usize| {
            self.heading(*column).is_some_and(|(_, rank)| rank < CERTAIN) || self.cells(*column).come_again()
        };
        let mut all: Vec<usize> = self.headed(ColumnRole::Sensor).into_iter().filter(is_sure).collect();
        all.retain(|&column| self.has_names(column));
        let is_apart = |column: &usize| {
            !beside_values || !self.first.has_heading || self.changes(*column) || self.parts_instants(&[], *column)
        };
        all.extend(self.named_by_cells().into_iter().filter(is_apart));
        let is_kind = |column: &usize| !self.cells(*column).are_mostly(self.cells(*column).switches);
        if all.is_empty() {
            all.extend(self.by_heading(ColumnRole::Room).or(self.headed(ColumnRole::Kind).into_iter().find(is_kind)));
        }
        let Some(sensor) = self.best(&all) else { return Ok(None) };
        self.no_rival(sensor, &all)?;
        let because = self.reason_for_sensor(sensor);
        self.take(sensor, ColumnRole::Sensor, &because);
        self.kind_and_room();
        Ok(Some(sensor))
    }

    /// The first of these columns: one whose text never changes loses to others, and so does one with several rows at an instant.
    fn best(&self, all: &[usize]) -> Option<usize> {
        let &first = all.first()?;
        if self.first.has_heading && is_certain_sensor(&self.first.names[first]) {
            return Some(first);
        }
        let differ: Vec<usize> = all.iter().copied().filter(|column| !self.cells(*column).is_constant()).collect();
        let &first = differ.first().unwrap_or(&first);
        let clashes = self.clashes(&[first]);
        // The name of a measurement stands behind the name of its device.
        let is_device = self.heading(first).is_some() || self.is_attribute(first);
        let is_better = |column: &usize| !self.is_attribute(*column) && 10 * self.clashes(&[*column]) <= clashes;
        let better = differ.iter().copied().find(is_better).filter(|_| self.are_many(clashes) && !is_device);
        Some(better.unwrap_or(first))
    }

    /// Refuses a table with another column as good as that of the sensor: the same names stand in both.
    fn no_rival(&self, sensor: usize, all: &[usize]) -> Result<(), TableMessage> {
        let is_open = |column: usize| self.first.has_heading && self.heading(column).is_none();
        let texts = |column: usize| &self.cells(column).texts;
        let is_rival = |other: usize| {
            let shared = texts(other).keys().filter(|text| texts(sensor).contains_key(*text)).count();
            other != sensor && is_open(other) && shared > 1 && 2 * shared >= texts(other).len().min(texts(sensor).len())
        };
        match all.iter().copied().find(|&other| is_open(sensor) && is_rival(other)) {
            Some(other) => {
                let [sensor, other] = [sensor, other].map(|column| beginning(&self.first.names[column]));
                Err(TableMessage::OpenSensors { column: sensor, other })
            }
            None => Ok(()),
        }
    }

    /// The free columns whose texts come again as names do; those of kinds come last.
    fn named_by_cells(&self) -> Vec<usize> {
        let is_name = |column: &usize| {
            let cells = self.cells(*column);
            let is_free = self.heading(*column).is_none_or(|(role, _)| role == ColumnRole::Unused);
            let others = [cells.values(), cells.moments(), cells.dates, cells.times, cells.sentences];
            let is_other = others.iter().any(|count| cells.are_mostly(*count));
            let is_id = is_id(&self.first.names[*column]) && cells.are_whole() && cells.texts.len() > 1;
            let is_number = is_id && self.first.has_heading && !cells.is_counting;
            is_free
                && (!is_other || is_number)
                && cells.come_again()
                && !cells.are(cells.severities)
                && 10 * cells.filled >= 9 * self.first.rows.len()
                && self.has_names(*column)
        };
        let is_kind = |column: &usize| self.cells(*column).are(self.cells(*column).kinds);
        let is_number = |column: &usize| self.cells(*column).are_whole();
        let mut names: Vec<usize> = self.free().into_iter().filter(is_name).collect();
        // The target of a message says more than its source, and a name more than a number.
        let rank = |column: &usize| {
            let heading = self.first.names[*column].to_lowercase();
            let says = |words: &[&str]| words.iter().any(|word| heading.contains(word));
            let is_target = self.first.has_heading && says(&["destination", "target", "ziel"]);
            let is_address = self.first.has_heading && says(&["address", "adresse"]);
            (is_kind(column), self.is_attribute(*column), is_number(column), !is_target, is_address)
        };
        names.sort_by_key(rank);
        // Of texts that never change, a number of a meter says more than a state of its readings.
        let is_constant = |column: &usize| self.cells(*column).is_constant();
        let is_key = |column: &usize| {
            is_id(&self.first.names[*column]) && self.cells(*column).are_whole() && is_constant(column)
        };
        let are_constant = !names.is_empty() && self.first.has_heading && names.iter().all(is_constant);
        if let Some(key) = self.free().into_iter().find(is_key).filter(|_| are_constant) {
            names.insert(0, key);
        }
        names
    }

    /// Whether texts may be names: units, directions and signs alone may not.
    fn has_names(&self, column: usize) -> bool {
        let cells = self.cells(column);
        let is_direction = |text: &String| DIRECTIONS.contains(&text.to_lowercase().as_str());
        let has_letter = |text: &String| text.chars().any(char::is_alphanumeric);
        !cells.are(cells.units)
            && !cells.are(cells.money)
            && !cells.texts.keys().all(is_direction)
            && cells.texts.keys().any(has_letter)
    }

    /// The number of rows with the instant and these texts of an earlier row.
    fn clashes(&self, columns: &[usize]) -> usize {
        let mut columns = columns.to_vec();
        columns.extend(self.all_taken(ColumnRole::Time));
        let key = |row: &'_ Vec<String>| -> Vec<String> {
            columns.iter().map(|&column| row.get(column).cloned().unwrap_or_default()).collect()
        };
        let different: BTreeSet<Vec<String>> = self.first.rows.iter().map(key).collect();
        self.first.rows.len() - different.len()
    }

    fn are_many(&self, clashes: usize) -> bool {
        clashes >= LEAST_ROWS && 10 * clashes >= self.first.rows.len()
    }

    /// Whether several rows have one instant, and this column parts them.
    fn parts_instants(&self, columns: &[usize], column: usize) -> bool {
        let clashes = self.clashes(columns);
        let mut with = columns.to_vec();
        with.push(column);
        self.are_many(clashes) && 10 * self.clashes(&with) <= clashes
    }

    /// Takes the columns of kinds and rooms that go with a sensor.
    fn kind_and_room(&mut self) {
        // A text that never changes and is of no known kind says nothing.
        let is_kind = |column: &usize| {
            let cells = self.cells(*column);
            !cells.are_mostly(cells.values()) && (!cells.is_constant() || cells.kinds > 0)
        };
        let by_heading = self.headed(ColumnRole::Kind).into_iter().find(is_kind);
        let may_be = |column: &usize| {
            let cells = self.cells(*column);
            cells.are(cells.kinds) && self.heading(*column).is_none_or(|(role, _)| role == ColumnRole::Sensor)
        };
        let by_cells = self.free().into_iter().find(may_be);
        match (by_heading, by_cells) {
            (Some(kind), _) => self.take(kind, ColumnRole::Kind, ColumnUse::HEADING),
            (None, Some(kind)) => self.take(kind, ColumnRole::Kind, "its cells are kinds of sensors"),
            _ => {}
        }
        if let Some(room) = self.by_heading(ColumnRole::Room) {
            self.take(room, ColumnRole::Room, ColumnUse::HEADING);
        }
    }

    /// Whether a text is another one than in the row before in a fifth of the rows.
    fn changes(&self, column: usize) -> bool {
        let texts: Vec<&str> = self.first.column(column).collect();
        let changes = texts.windows(2).filter(|pair| pair[0] != pair[1]).count();
        5 * changes >= texts.len().saturating_sub(1)
    }

    /// The columns that name a sensor together: what stands in several rooms, or measures several things, is several sensors.
    pub fn apart(&mut self, sensor: usize, value: Option<usize>) -> Vec<usize> {
        let mut columns = vec![sensor];
        for (role, what) in [(ColumnRole::Room, "rooms"), (ColumnRole::Kind, "kinds")] {
            let Some(column) = self.taken(role) else { continue };
            let mut of: BTreeMap<&str, &str> = BTreeMap::new();
            let mut pairs = self.first.column(sensor).zip(self.first.column(column)).filter(|(_, of)| !is_blank(of));
            let several = pairs.find(|(name, text)| *of.entry(name).or_insert(text) != *text);
            if let Some((name, _)) = several {
                let because = format!("it stands in the sensor's name, too: {} has several {what}", beginning(name));
                self.add_reason(column, &because);
                if role == ColumnRole::Room { columns.insert(0, column) } else { columns.push(column) }
            }
        }
        if let Some((attribute, because)) = value.and_then(|value| self.attribute(&columns, value)) {
            let are_kinds = self.cells(attribute).are_mostly(self.cells(attribute).kinds);
            if let Some(other) = self.taken(ColumnRole::Kind).filter(|other| are_kinds && !columns.contains(other)) {
                self.release(other, "another column says what is measured");
            }
            self.take(attribute, if are_kinds { ColumnRole::Kind } else { ColumnRole::Sensor }, &because);
            columns.push(attribute);
        }
        columns
    }

    /// The column of what a row tells of a device, and why: without it a device has several values at an instant, or values of
    /// several kinds, or its heading says so.
    fn attribute(&self, device: &[usize], value: usize) -> Option<(usize, String)> {
        let may_be = |column: &usize| {
            let cells = self.cells(*column);
            (2..=MOST_ATTRIBUTES).contains(&cells.texts.len())
                && cells.come_again()
                && 2 * cells.sentences <= cells.filled
                && 10 * cells.filled >= 9 * self.first.rows.len()
                && self.has_names(*column)
                && self.parts(device, *column)
                && self.is_free_of(*column, value)
        };
        let with = |column: usize| [device, &[column]].concat();
        let mut open: Vec<usize> = self.free().into_iter().filter(may_be).collect();
        open.sort_by_key(|column| self.cells(*column).are_whole());
        let rows = |count: usize, what: &str| format!("a sensor has {what} in {count} rows, which its texts part");
        if let Some(&column) = open.iter().find(|column| self.is_attribute(**column)) {
            return Some((column, format!("{}: a device has several of its texts", ColumnUse::HEADING)));
        }
        let mixed = self.mixed(device, value);
        let is_apart = |column: &&usize| mixed >= LEAST_ROWS && 10 * self.mixed(&with(**column), value) <= mixed;
        if let Some(&column) = open.iter().find(is_apart) {
            return Some((column, rows(mixed, "numbers and words")));
        }
        let is_told = |column: &&usize| self.first.has_heading && self.parts_instants(device, **column);
        let column = *open.iter().find(is_told)?;
        Some((column, rows(self.clashes(device), "several values at one instant")))
    }

    /// Whether a column describes several sensors: each sensor has the same text in all of its rows.
    pub fn describes(&self, sensor: usize, column: usize) -> bool {
        let sensors = self.cells(sensor).texts.len();
        self.first.has_heading
            && sensors > 1
            && self.cells(column).texts.len() > 1
            && self.first.rows.len() >= LEAST_ROWS_OF_SENSOR * sensors
            && !self.parts(&[sensor], column)
    }

    /// Releases the column of homes if it says who did something: persons share sensors, and their rows alternate.
    pub fn check_home(&mut self, sensors: &[usize], is_asked: bool) {
        const DOERS: [&str; 6] = ["user", "userid", "username", "person", "client", "subject"];
        let Some(home) = self.taken(ColumnRole::Home).filter(|_| !is_asked) else { return };
        if !DOERS.contains(&plain(&self.first.names[home]).as_str()) {
            return;
        }
        let homes: Vec<&str> = self.first.column(home).filter(|text| !is_blank(text)).collect();
        let turns = homes.windows(2).filter(|pair| pair[0] != pair[1]).count();
        let count = self.cells(home).texts.len();
        let is_in_spans = turns < 2 * count;
        let few_rows = homes.len() < LEAST_ROWS_OF_SENSOR * count;
        let has_gaps = 10 * homes.len() < 9 * self.first.rows.len();
        let has_several = sensors.iter().any(|&sensor| self.parts(&[home], sensor));
        if count > 1 && (few_rows || has_gaps || !has_several && !is_in_spans) {
            self.release(home, "it says who did something: its persons have no sensors of their own");
        }
    }

    /// Whether a heading says that the column tells what is measured.
    fn is_attribute(&self, column: usize) -> bool {
        self.first.has_heading && ATTRIBUTES.contains(&plain(&self.first.names[column]).as_str())
    }

    /// Whether a device has several texts of this column.
    fn parts(&self, device: &[usize], column: usize) -> bool {
        let mut of: BTreeMap<Vec<&str>, &str> = BTreeMap::new();
        self.first.rows.iter().any(|row| {
            let cell = |column: usize| row.get(column).map_or("", String::as_str);
            let key: Vec<&str> = device.iter().map(|&column| cell(column)).collect();
            !is_blank(cell(column)) && *of.entry(key).or_insert(cell(column)) != cell(column)
        })
    }

    /// Whether one text of a column comes with several values: else it only says them again.
    fn is_free_of(&self, column: usize, value: usize) -> bool {
        self.parts(&[column], value)
    }

    /// The number of rows with a number where others of the same names have words, or the reverse: the smaller of both.
    fn mixed(&self, columns: &[usize], value: usize) -> usize {
        let mut of: BTreeMap<Vec<&str>, [usize; 2]> = BTreeMap::new();
        for row in &self.first.rows {
            let cell = |column: usize| row.get(column).map_or("", String::as_str);
            if !is_blank(cell(value)) {
                let key = columns.iter().map(|&column| cell(column)).collect();
                of.entry(key).or_default()[usize::from(cell(value).parse::<f64>().is_ok())] += 1;
            }
        }
        of.values().map(|[words, numbers]| words.min(numbers)).sum()
    }

    /// Takes a column of rooms that no heading names.
    pub fn leftover_room(&mut self) {
        let is_room = |text: &String| ROOMS.iter().any(|room| text.to_lowercase().contains(room));
        let are_rooms = |column: &usize| {
            let CellCounts { texts, sentences, filled, .. } = self.cells(*column);
            self.heading(*column).is_none()
                && 2 * sentences <= *filled
                && 2 * texts.keys().filter(|text| is_room(text)).count() > texts.len()
        };
        if self.taken(ColumnRole::Room).is_none()
            && let Some(column) = self.free().into_iter().find(are_rooms)
        {
            self.take(column, ColumnRole::Room, "its words are those of rooms");
        }
    }
}
