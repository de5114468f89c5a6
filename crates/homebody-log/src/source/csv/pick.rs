//! Takes the columns of a table for what they are, one after the other: by headings, then by cells. Each is taken once.

use super::cells::{CellCounts, Reads};
use super::first_rows::FirstRows;
use crate::limits::beginning;
use crate::log::{ColumnRole, ColumnUse};
use crate::source::columns::{CERTAIN, is_certain_sensor, is_id, is_price, is_remark, plain, role_of};
use crate::source::messages::TableMessage;
use crate::source::options::{DateOrder, HomeColumn};
use homebody_core::problem::readable;
use homebody_core::time::{DAY, HOUR, MINUTE, SECOND, Span};
use std::collections::BTreeSet;

/// The columns that have been taken so far.
pub(crate) struct Pick<'f> {
    pub first: &'f FirstRows,
    taken: Vec<Option<(ColumnRole, String)>>,
    /// A value that the reader supplies where no column has one.
    supplied: Option<String>,
    pub remarks: Vec<String>,
}

#[derive(Clone, Copy)]
pub(crate) struct TimeColumns {
    pub column: usize,
    /// The time of day, where it has a column of its own.
    pub of_day: Option<usize>,
    /// Whether it is a number of seconds since an unknown start.
    pub is_since_start: bool,
    /// Whether it is the number of a day in a spreadsheet.
    pub has_day_numbers: bool,
}

impl TimeColumns {
    pub fn at(column: usize) -> TimeColumns {
        TimeColumns { column, of_day: None, is_since_start: false, has_day_numbers: false }
    }
}

#[derive(Clone, Copy)]
pub(crate) enum EndColumn {
    At(usize),
    /// A duration in units of this length, or as hours, minutes and seconds.
    After(usize, Span),
}

/// So many rows show that a column of ids is one.
const LEAST_NUMBERED: usize = 4;

/// The reader's own word for a row without a value.
pub(crate) const FIRING: &str = "ON";

/// Words of what people do, as they stand in labels.
const ACTIVITIES: [&str; 33] = [
    "sleep", "bath", "toilet", "breakfast", "lunch", "dinner", "snack", "leav", "groom", "shower", "spare", "relax",
    "cook", "eat", "meal", "work", "dress", "medic", "wash", "clean", "watch", "read", "rest", "nap", "walk",
    "exercis", "hygiene", "prepar", "drink", "iron", "guest", "phone", "laundr",
];

impl<'f> Pick<'f> {
    pub fn from_rows(first: &'f FirstRows) -> Pick<'f> {
        let mut pick = Pick { first, taken: vec![None; first.cells.len()], supplied: None, remarks: Vec::new() };
        for (column, cells) in first.cells.iter().enumerate() {
            match () {
                () if cells.filled == 0 => pick.take(column, ColumnRole::Unused, "its cells are empty"),
                () if cells.is_numbering && pick.may_be_a_number(column) => {
                    pick.take(column, ColumnRole::Unused, "it numbers the rows")
                }
                () => {}
            }
        }
        pick
    }

    /// Whether a column may be that of the numbers of rows: a counter under a heading of its own is a sensor.
    fn may_be_a_number(&self, column: usize) -> bool {
        let is_nameless = self.first.names[column] == format!("column {}", column + 1);
        is_nameless || self.heading(column).is_some_and(|(role, _)| role == ColumnRole::Unused)
    }

    pub fn take(&mut self, column: usize, role: ColumnRole, because: &str) {
        self.taken[column] = Some((role, because.to_owned()));
    }

    pub fn add_reason(&mut self, column: usize, because: &str) {
        if let Some((_, reason)) = &mut self.taken[column] {
            *reason = format!("{reason}; {because}");
        }
    }

    /// The column that has been taken for this.
    pub fn taken(&self, role: ColumnRole) -> Option<usize> {
        self.taken.iter().position(|taken| taken.as_ref().is_some_and(|(taken, _)| *taken == role))
    }

    /// The columns that nothing has taken, those behind the time first.
    pub fn free(&self) -> Vec<usize> {
        let time = self.taken(ColumnRole::Time).unwrap_or(0);
        let is_free = |column: &usize| self.taken[*column].is_none();
        let (mut behind, before): (Vec<usize>, Vec<usize>) =
            (0..self.taken.len()).filter(is_free).partition(|column| *column >= time);
        behind.extend(before);
        behind
    }

    pub fn cells(&self, column: usize) -> &'f CellCounts {
        &self.first.cells[column]
    }

    pub fn heading(&self, column: usize) -> Option<(ColumnRole, usize)> {
        self.first.has_heading.then(|| role_of(&self.first.names[column])).flatten()
    }

    /// The free columns whose headings say this, the most certain first.
    pub fn headed(&self, role: ColumnRole) -> Vec<usize> {
        let rank = |column: &usize| self.heading(*column).filter(|(of, _)| *of == role).map(|(_, rank)| rank);
        let mut found: Vec<usize> = self.free().into_iter().filter(|column| rank(column).is_some()).collect();
        found.sort_by_key(rank);
        found
    }

    /// All columns that have been taken for this.
    pub fn all_taken(&self, role: ColumnRole) -> impl Iterator<Item = usize> + '_ {
        let is_taken = move |taken: &Option<(ColumnRole, String)>| taken.as_ref().is_some_and(|(of, _)| *of == role);
        self.taken.iter().enumerate().filter(move |(_, taken)| is_taken(taken)).map(|(column, _)| column)
    }

    pub fn release(&mut self, column: usize, because: &str) {
        self.take(column, ColumnRole::Unused, because);
    }

    pub fn by_heading(&self, role: ColumnRole) -> Option<usize> {
        self.headed(role).first().copied()
    }

    pub fn all_by_name(&mut self, [time, sensor, value]: [usize; 3], label: Option<usize>) {
        self.take(time, ColumnRole::Time, ColumnUse::HEADING);
        self.take(sensor, ColumnRole::Sensor, ColumnUse::HEADING);
        self.take(value, ColumnRole::Value, ColumnUse::HEADING);
        if let Some(label) = label {
            self.take(label, ColumnRole::Label, ColumnUse::HEADING);
        }
    }

    /// Takes the column of homes: the one that is asked for, or one with a heading of homes or persons.
    pub fn home(&mut self, asked: Option<&HomeColumn>) -> Result<(), TableMessage> {
        let Some(asked) = asked else {
            // Numbers that hardly come again, or states, are readings; texts that hardly come again are titles.
            let is_home = |column: &usize| {
                let cells = self.cells(*column);
                !cells.is_switch() && !cells.hardly_come_again() && (cells.numbers == 0 || cells.come_again())
            };
            if let Some(column) = self.headed(ColumnRole::Home).into_iter().find(is_home) {
                self.take(column, ColumnRole::Home, ColumnUse::HEADING);
            }
            return Ok(());
        };
        let names = &self.first.names;
        let found = names.iter().position(|name| *name == asked.column);
        match found.or_else(|| names.iter().position(|name| name.eq_ignore_ascii_case(&asked.column))) {
            Some(column) => self.take(column, ColumnRole::Home, "--home-column names it"),
            None => {
                let column = beginning(&asked.column);
                return Err(TableMessage::NoHomeColumn { column, columns: self.names() });
            }
        }
        Ok(())
    }

    fn names(&self) -> String {
        /// The longest quotation of headings, in characters.
        const LONGEST: usize = 200;
        readable(self.first.names.join(", ").chars().take(LONGEST).collect::<String>())
    }

    pub fn lacks(&self, wanted: &'static str) -> TableMessage {
        TableMessage::NoColumns { wanted, among: self.all_names() }
    }

    /// The names of the columns, or their number without a heading.
    fn all_names(&self) -> String {
        match self.first.has_heading {
            true => self.names(),
            false => format!("its {} columns without a heading", self.taken.len()),
        }
    }

    /// Takes the column of the time, or the two of date and time of day.
    pub fn time(&mut self) -> Result<TimeColumns, TableMessage> {
        let headed = self.headed(ColumnRole::Time);
        let with = |is: &dyn Fn(&CellCounts) -> bool| headed.iter().copied().find(|column| is(self.cells(*column)));
        let by_heading =
            with(&|cells| cells.are_mostly(cells.instants)).or(with(&|cells| cells.are_mostly(cells.epochs)));
        let all = self.free();
        let find = |is: &dyn Fn(&CellCounts) -> bool| all.iter().copied().find(|column| is(self.cells(*column)));
        let date = with(&|cells| cells.are_mostly(cells.dates)).or(find(&|cells| cells.are(cells.dates)));
        let of_day = with(&|cells| cells.are_mostly(cells.times)).or(find(&|cells| cells.are(cells.times)));
        let of_numbers = |is: &dyn Fn(usize) -> bool| {
            all.iter().copied().find(|&column| self.cells(column).are(self.cells(column).epochs) && is(column))
        };
        // An id is not an instant. Numbers that count up by one are the last choice.
        let is_key = |column: usize| self.is_key(column);
        let by_cells = find(&|cells| cells.are(cells.instants))
            .or_else(|| of_numbers(&|column| !is_key(column) && !self.cells(column).is_counting))
            .or_else(|| {
                all.iter().copied().find(|&at| !is_key(at) && self.cells(at).are_mostly(self.cells(at).moments()))
            });
        if let Some(column) = by_heading {
            self.take(column, ColumnRole::Time, ColumnUse::HEADING);
            return Ok(TimeColumns::at(column));
        }
        if let (Some(date), Some(of_day)) = (date, of_day) {
            for (column, cells) in [(date, "dates"), (of_day, "times of day")] {
                let because = match headed.contains(&column) {
                    true => format!("{}; its cells are {cells}", ColumnUse::HEADING),
                    false => format!("its cells are {cells}"),
                };
                self.take(column, ColumnRole::Time, &because);
            }
            return Ok(TimeColumns { of_day: Some(of_day), ..TimeColumns::at(date) });
        }
        if let Some(column) = by_cells {
            let cells = self.cells(column);
            let because = format!("{} of {} cells are instants", cells.moments(), cells.filled);
            self.take(column, ColumnRole::Time, &because);
            return Ok(TimeColumns::at(column));
        }
        self.seconds_or_none(&headed, date, of_day)
    }

    /// Whether a column of numbers names something: its heading says so, or it never changes.
    fn is_key(&self, column: usize) -> bool {
        let cells = self.cells(column);
        let is_time = self.heading(column).is_some_and(|(role, _)| role == ColumnRole::Time);
        let is_id = self.first.has_heading && is_id(&self.first.names[column]);
        cells.are(cells.numbers) && !is_time && (is_id || cells.is_constant())
    }

    /// A time as a number of seconds since a start, with another of ends; or the reason against one.
    fn seconds_or_none(
        &mut self,
        headed: &[usize],
        date: Option<usize>,
        of_day: Option<usize>,
    ) -> Result<TimeColumns, TableMessage> {
        let is_day_number = |column: &&usize| {
            let cells = self.cells(**column);
            cells.are(cells.numbers) && cells.are_mostly(cells.day_numbers)
        };
        if let Some(&column) = headed.iter().find(is_day_number) {
            let because = format!("{}; its cells are numbers of days, as spreadsheets count them", ColumnUse::HEADING);
            self.take(column, ColumnRole::Time, &because);
            return Ok(TimeColumns { has_day_numbers: true, ..TimeColumns::at(column) });
        }
        let name = |column: usize| beginning(&self.first.names[column]);
        if let (Some(&begin), Some(end)) = (headed.first(), self.by_heading(ColumnRole::End))
            && [begin, end].iter().all(|column| self.cells(*column).are(self.cells(*column).numbers))
        {
            self.take(begin, ColumnRole::Time, &format!("{}; its cells are seconds since a start", ColumnUse::HEADING));
            return Ok(TimeColumns { is_since_start: true, ..TimeColumns::at(begin) });
        }
        if let Some(date) = date {
            return Err(TableMessage::DatesAlone { column: name(date) });
        }
        if let Some(of_day) = of_day {
            return Err(TableMessage::TimesAlone { column: name(of_day) });
        }
        match headed.first().copied().filter(|&column| self.heading(column).is_some_and(|(_, rank)| rank < CERTAIN)) {
            // Each row is left out with its reason.
            Some(column) if self.by_heading(ColumnRole::Sensor).is_some() => {
                self.take(column, ColumnRole::Time, ColumnUse::HEADING);
                Ok(TimeColumns::at(column))
            }
            _ => Err(TableMessage::NoInstants { among: self.all_names() }),
        }
    }

    /// Takes the columns of labels and units.
    pub fn besides(&mut self) {
        for (role, is) in [
            (ColumnRole::Label, (|cells: &CellCounts| !cells.are_mostly(cells.moments())) as fn(&CellCounts) -> bool),
            (ColumnRole::Unit, |cells| cells.numbers == 0),
        ] {
            if let Some(column) = self.headed(role).into_iter().find(|column| is(self.cells(*column))) {
                self.take(column, role, ColumnUse::HEADING);
            }
        }
    }

    pub fn end(&mut self, time: &TimeColumns) -> Option<EndColumn> {
        let headed = |pick: &Self, role, is: &dyn Fn(&CellCounts) -> bool| {
            pick.headed(role).into_iter().find(|column| is(pick.cells(*column)))
        };
        let is_end = |cells: &CellCounts| {
            cells.are_mostly(cells.moments()) || time.is_since_start && cells.are_mostly(cells.numbers)
        };
        // A start and an end next to a time are those of a query.
        let is_start = |column: &usize| matches!(plain(&self.first.names[*column]).as_str(), "start" | "begin");
        let is_of_query = self.first.has_heading && self.free().iter().any(is_start) && !time.is_since_start;
        if let Some(column) = headed(self, ColumnRole::End, &is_end).filter(|_| !is_of_query) {
            self.take(column, ColumnRole::End, ColumnUse::HEADING);
            self.other_instants();
            return Some(EndColumn::At(column));
        }
        let is_length = |cells: &CellCounts| cells.are_mostly(cells.numbers) || cells.are_mostly(cells.times);
        if let Some(column) = headed(self, ColumnRole::Duration, &is_length) {
            let (unit, name) = unit_of_duration(&self.first.names[column]);
            self.take(column, ColumnRole::Duration, &format!("{}, in {name}", ColumnUse::HEADING));
            self.other_instants();
            return Some(EndColumn::After(column, unit));
        }
        let is_named = self.heading(time.column).is_some_and(|(role, rank)| role == ColumnRole::Time && rank < CERTAIN);
        let ends: Vec<usize> = self.free().into_iter().filter(|column| self.is_end_of(time.column, *column)).collect();
        if let Some(&column) = ends.first().filter(|_| !is_named && time.of_day.is_none()) {
            self.take(column, ColumnRole::End, "its cells are instants, none of them before that of the time");
            self.other_instants();
            return Some(EndColumn::At(column));
        }
        self.other_instants();
        None
    }

    /// Whether the cells of a column are instants after those of another, by lengths that differ from those between zones.
    fn is_end_of(&self, begin: usize, column: usize) -> bool {
        let (cells, begins) = (self.cells(column), self.cells(begin));
        let are_numbers = !self.first.has_heading && cells.are(cells.epochs) && begins.are(begins.epochs);
        if !cells.are(cells.instants) && !are_numbers || self.heading(column).is_some() {
            return false;
        }
        let mut reads = Reads::new();
        let order = Some(DateOrder::DayFirst).filter(|_| cells.order.day + cells.order.both > 0);
        let mut moment = |cell: &str| reads.moment(cell, order);
        let pairs = self.first.column(begin).zip(self.first.column(column));
        let lengths: Vec<Span> = pairs.filter_map(|(begin, end)| Some(moment(end)? - moment(begin)?)).collect();
        let different: BTreeSet<Span> = lengths.iter().copied().collect();
        let is_of_zones = different.len() <= 2 && different.iter().all(|&length| length % (15 * MINUTE) == Span::ZERO);
        let before = lengths.iter().filter(|length| **length < Span::ZERO).count();
        // Numbers may be counts that are as large: no interval is longer than a month.
        let is_near = !are_numbers || lengths.iter().all(|length| *length < 31 * DAY);
        !lengths.is_empty() && 20 * before <= lengths.len() && !is_of_zones && is_near
    }

    pub fn other_instants(&mut self) {
        for column in self.free() {
            let cells = self.cells(column);
            if cells.are(cells.instants)
                || cells.are(cells.epochs) && self.heading(column).is_some_and(|(role, _)| role == ColumnRole::Time)
            {
                self.take(column, ColumnRole::Unused, "its cells are other instants");
            }
        }
    }

    /// Free columns behind the time that hold values which differ.
    pub fn value_columns(&self) -> Vec<usize> {
        let is_value = |column: &usize| {
            let cells = self.cells(*column);
            let role = self.heading(*column).map(|(role, _)| role);
            let is_other = role.is_some_and(|role| !matches!(role, ColumnRole::Value | ColumnRole::Unused));
            cells.are_mostly(cells.values())
                && !is_other
                && !self.names_something(*column)
                && (cells.texts.len() > 1 || role == Some(ColumnRole::Value) || self.first.rows.len() < 4)
        };
        self.free().into_iter().filter(is_value).collect()
    }

    /// Whether a column tells no values, by its heading: it names rows or things, or has prices or labels.
    pub fn names_something(&self, column: usize) -> bool {
        self.no_value(column).is_some()
    }

    /// Why a column tells no values, if it does not.
    pub fn no_value(&self, column: usize) -> Option<&'static str> {
        let (name, cells) = (&self.first.names[column], self.cells(column));
        let is_label =
            name.to_lowercase().strip_prefix("label").is_some_and(|rest| rest.starts_with([':', '_', ' ', '.']));
        let is_row_number = cells.is_counting && cells.filled >= LEAST_NUMBERED;
        match () {
            () if !self.first.has_heading => None,
            () if is_id(name) && cells.are_whole() && is_row_number => {
                Some("its heading is that of ids, and it numbers the rows")
            }
            () if is_remark(name) => Some("its heading is that of remarks"),
            () if is_id(name) && cells.is_constant() => Some("its heading is that of ids, and it never changes"),
            () if is_id(name) && cells.are_whole() && cells.filled >= LEAST_NUMBERED => {
                Some("its heading is that of ids: numbers that name something")
            }
            () if is_label => Some("its heading is that of labels"),
            () if is_price(name) || cells.are(cells.money) => Some("it holds prices"),
            () => None,
        }
    }

    /// Whether numbers are names of sensors, as they come again and are whole.
    pub fn are_numbered_sensors(&self, column: usize) -> bool {
        let cells = self.cells(column);
        cells.come_again() && cells.texts.keys().all(|text| text.bytes().all(|byte| byte.is_ascii_digit()))
    }

    pub fn reason_for_sensor(&self, column: usize) -> String {
        let cells = self.cells(column);
        match self.heading(column) {
            Some((ColumnRole::Sensor | ColumnRole::Room | ColumnRole::Kind, _)) => ColumnUse::HEADING.to_owned(),
            _ => format!("its texts come again: {} in {} rows", cells.texts.len(), cells.filled),
        }
    }

    /// Takes the column of what a sensor says, if there is one.
    pub fn value(&mut self, sensor: usize) -> Option<usize> {
        if let Some(column) = self.by_heading(ColumnRole::Value) {
            self.take(column, ColumnRole::Value, ColumnUse::HEADING);
            return Some(column);
        }
        let free = self.free();
        let is_value = |column: &usize| self.cells(*column).are_mostly(self.cells(*column).values());
        let is_open = |column: &usize| {
            self.heading(*column).is_none_or(|(role, _)| role == ColumnRole::Kind) && !self.names_something(*column)
        };
        let open: Vec<usize> = free.into_iter().filter(is_open).collect();
        let mut behind = open.iter().copied().filter(|column| *column > sensor);
        let changes = |column: &usize| is_value(column) && !self.cells(*column).is_constant();
        let by_cells = behind.clone().find(changes).or(open.iter().copied().find(changes));
        let by_cells = by_cells.or(behind.clone().find(is_value)).or(open.iter().copied().find(is_value));
        if let Some(column) = by_cells {
            let cells = self.cells(column);
            let because = format!("{} of {} cells are numbers or words of states", cells.values(), cells.filled);
            self.take(column, ColumnRole::Value, &because);
            return Some(column);
        }
        let is_state = |column: &usize| {
            let cells = self.cells(*column);
            let is_state = cells.come_again() && cells.sentences == 0 && self.heading(*column).is_none();
            is_state && (!self.first.has_heading || !cells.is_constant()) && !cells.are_mostly(cells.moments())
        };
        let column = behind.find(is_state).filter(|column| *column == sensor + 1 || self.first.has_heading)?;
        self.take(column, ColumnRole::Value, "its few texts come again, and it follows the sensor");
        Some(column)
    }

    /// Each row is a firing, where it has no value: that is certain if the sensor has a heading or comes again.
    pub fn firings(&mut self, sensor: usize) -> Result<(), TableMessage> {
        let cells = self.cells(sensor);
        let is_known = self.heading(sensor).is_some_and(|(role, _)| role != ColumnRole::Unused);
        let comes_again = cells.filled >= 4 && 2 * cells.texts.len() <= cells.filled;
        if !is_known && !comes_again {
            return Err(self.lacks("time, sensor and value"));
        }
        let is_told =
            |&column: &usize| column != sensor && self.cells(column).sentences > 0 && !self.cells(column).is_constant();
        if let Some(column) =
            (0..self.first.cells.len()).find(is_told).filter(|_| !self.first.has_heading && cells.is_constant())
        {
            return Err(TableMessage::RowsInSentences { column: column + 1 });
        }
        if let Some(prose) =
            self.prose().filter(|_| self.first.has_heading && !is_certain_sensor(&self.first.names[sensor]))
        {
            return Err(TableMessage::Prose { column: beginning(&self.first.names[prose]) });
        }
        self.supplied =
            Some(format!("no column has a value: each row is a firing, and {FIRING} is the reader's own word"));
        Ok(())
    }

    /// Takes the label that follows the value, where no heading says so.
    pub fn label_behind(&mut self, value: usize) -> Option<usize> {
        if let Some(label) = self.taken(ColumnRole::Label) {
            return Some(label);
        }
        let column = value + 1;
        let is_free = self.taken.get(column).is_some_and(Option::is_none) && !self.first.has_heading;
        let cells = self.first.cells.get(column).filter(|cells| is_free && cells.numbers == 0 && cells.come_again())?;
        let because =
            format!("it follows the value, and its texts come again: {} in {}", cells.texts.len(), cells.filled);
        self.take(column, ColumnRole::Label, &because);
        Some(column)
    }

    /// The column of activities in rows without a heading of them: the words say what people do.
    pub fn activities(&mut self) -> Option<usize> {
        if self.first.has_heading {
            return None;
        }
        let free = self.free();
        let [column] = free[..] else { return None };
        let does = |text: &String| ACTIVITIES.iter().any(|word| text.to_lowercase().contains(word));
        let texts = &self.cells(column).texts;
        let known = texts.keys().filter(|text| does(text)).count();
        (2 * known > texts.len()).then(|| self.take(column, ColumnRole::Label, "its words are those of activities"))?;
        Some(column)
    }

    pub fn uses(&self) -> Vec<ColumnUse> {
        let mut uses: Vec<ColumnUse> = Vec::new();
        for (column, taken) in self.first.names.iter().zip(&self.taken) {
            let (used_as, because) = match taken {
                Some((role, because)) => (*role, because.as_str()),
                None => (ColumnRole::Unused, "nothing says what it is"),
            };
            uses.push(ColumnUse::of_table(column.clone(), used_as, because.to_owned()));
        }
        if let Some(because) = &self.supplied {
            uses.push(ColumnUse::of_table(String::new(), ColumnRole::Value, because.clone()));
        }
        uses
    }
}

fn unit_of_duration(heading: &str) -> (Span, &'static str) {
    let lower = heading.to_lowercase();
    let ends = |endings: &[&str]| endings.iter().any(|ending| lower.trim_end_matches([')', ']']).ends_with(ending));
    match () {
        () if ends(&["_ms", "(ms", "[ms", "millis", "milliseconds"]) => (Span::from_millis(1), "milliseconds"),
        () if ends(&["_min", "(min", "[min", "minutes", "_mins"]) => (MINUTE, "minutes"),
        () if ends(&["_h", "(h", "[h", "hours"]) => (HOUR, "hours"),
        () => (SECOND, "seconds"),
    }
}
