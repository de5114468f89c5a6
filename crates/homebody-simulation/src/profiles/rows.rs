//! Reads the rows of a table as profiles, and checks each cell.

use super::messages::{ProfileMessage, among};
use super::profile::{Base, OtherHome, OtherRoutine, Profile};
use super::sentences::OwnSentences;
use super::table::{ProfileTable, TableCell};
use crate::limits::MOST_MEMBERS;
use homebody_core::nearest::nearest;
use homebody_core::problem::Problem;
use homebody_core::scenario::GREATEST_SEED;
use homebody_core::scenario::inside::{WHERE, outside_folder};
use homebody_core::scenario::load::NoText;
use homebody_log::run::places::LIST;
use homebody_routine::household::CONDITIONS;
use homebody_routine::language::{self, KnownNames};
use homebody_routine::routine::{Effect, Routine};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// The columns of a row.
const COLUMNS: [&str; 12] = [
    "name",
    "seed",
    "age",
    "pace_mps",
    "conditions",
    "severity",
    "onset",
    "over",
    "until",
    "routine",
    "resident",
    "home",
];

/// The columns that do not describe a resident.
const OTHER_COLUMNS: [&str; 3] = ["name", "seed", "home"];

/// The words before the name of a condition.
const SHOWS: &str = "the person shows ";

pub(crate) fn read(table: &ProfileTable, base: &Base, without: &[String]) -> (Vec<Profile>, Vec<Problem>) {
    let mut reader = RowReader {
        table,
        base,
        problems: Vec::new(),
        routines: BTreeMap::new(),
        homes: BTreeMap::new(),
        routines_of_sentences: BTreeMap::new(),
    };
    let profiles = reader.profiles(without);
    (profiles, reader.problems)
}

struct RowReader<'a> {
    table: &'a ProfileTable<'a>,
    base: &'a Base<'a>,
    problems: Vec<Problem>,
    /// The other routines of residents; `None` for those with problems.
    routines: BTreeMap<(Option<usize>, String), Option<Arc<OtherRoutine>>>,
    /// The other homes; `None` for unreadable ones.
    homes: BTreeMap<String, Option<Arc<OtherHome>>>,
    /// The routines of sentences, each with a condition of the scenario's own: many rows share a sentence.
    routines_of_sentences: BTreeMap<(String, Option<String>), Routine>,
}

/// The overrides of a row: home, resident, routine and sentences.
type RowDifference = (Option<String>, Option<usize>, Option<String>, OwnSentences);

struct CheckedDifference {
    conditions: Vec<String>,
    /// The texts that they need, by name, as they were read.
    texts: Arc<BTreeMap<String, String>>,
}

type SentencePart<'a> = (&'a str, Option<&'a TableCell>);

/// A row's cells by column; those that are empty are missing.
type ProfileRow<'a> = BTreeMap<&'static str, &'a TableCell>;

impl<'a> RowReader<'a> {
    fn fault(&mut self, cell: &TableCell, message: ProfileMessage) {
        self.problems.push(self.table.problem(cell, message, None));
    }

    fn profiles(&mut self, without: &[String]) -> Vec<Profile> {
        let columns = self.columns();
        if self.table.rows.is_empty() {
            self.problems.push(self.table.problem_of_file(ProfileMessage::NoMembers));
        }
        if self.table.rows.len() > MOST_MEMBERS as usize {
            let message = ProfileMessage::TooMany { members: self.table.rows.len(), most: MOST_MEMBERS };
            self.problems.push(self.table.problem_of_file(message));
            return Vec::new();
        }
        let mut names = BTreeSet::new();
        let mut seen: BTreeMap<RowDifference, Result<CheckedDifference, Vec<Problem>>> = BTreeMap::new();
        let mut profiles = Vec::new();
        for cells in &self.table.rows {
            let before = self.problems.len();
            let row = self.row(&columns, cells);
            let name = self.name(&row, cells, &mut names);
            let mut profile = self.profile(name, &row, &columns);
            if self.problems.len() > before {
                continue;
            }
            // Rows with the same overrides are checked once.
            let routine = profile.routine.as_ref().map(|other| other.routine.file.clone());
            let home = profile.home.as_ref().map(|other| other.file.clone());
            let key = (home, profile.resident, routine, profile.sentences.clone());
            let CheckedDifference { conditions, texts } = match seen.entry(key).or_insert_with(|| self.check(&profile))
            {
                Ok(seen) => seen,
                Err(problems) => {
                    for problem in problems {
                        let message = ProfileMessage::Scenario {
                            place: place(problem),
                            problem: problem.what.clone(),
                            problem_code: problem.code,
                            problem_hint: problem.hint.clone(),
                        };
                        self.fault(row["name"], message);
                    }
                    continue;
                }
            };
            profile.without = without.iter().filter(|name| conditions.contains(name)).cloned().collect();
            profile.texts = texts.clone();
            profiles.push(profile);
        }
        let shown: BTreeSet<&str> =
            seen.values().flatten().flat_map(|seen| &seen.conditions).map(String::as_str).collect();
        let nobodys = without.iter().filter(|name| self.problems.is_empty() && !shown.contains(name.as_str()));
        let nobodys = nobodys.map(|name| {
            self.table.problem_of_file(ProfileMessage::NoCondition {
                condition: name.clone(),
                near: nearest(name, shown.iter().copied()).map(str::to_owned),
                known: shown.iter().map(|&name| name.to_owned()).collect(),
            })
        });
        let nobodys: Vec<Problem> = nobodys.collect();
        self.problems.extend(nobodys);
        profiles
    }

    fn check(&self, profile: &Profile) -> Result<CheckedDifference, Vec<Problem>> {
        let (scenario, household) = self.base.with(profile, &[]).map_err(|problems| problems.0)?;
        let conditions = household.conditions().keys().cloned().collect();
        let read = |name: &str, text: &str| self.base.files.read(name).is_ok_and(|read| read == text);
        let texts = scenario.sources.into_iter().filter(|(name, text)| read(name, text)).collect();
        Ok(CheckedDifference { conditions, texts: Arc::new(texts) })
    }

    fn columns(&mut self) -> Vec<Option<&'static str>> {
        let table = self.table;
        let mut columns: Vec<Option<&'static str>> = Vec::new();
        for cell in &table.header {
            let name = cell.text.to_lowercase();
            let known = COLUMNS.into_iter().find(|known| *known == name);
            if let Some(known) = known.filter(|known| columns.contains(&Some(known))) {
                self.fault(cell, ProfileMessage::SameColumn { column: known.into() });
            } else if known.is_none() && !name.is_empty() {
                let known = among(nearest(&name, COLUMNS), &COLUMNS);
                self.fault(cell, ProfileMessage::UnknownColumn { column: cell.text.clone(), known });
            }
            columns.push(known);
        }
        if !columns.contains(&Some("name")) {
            let others = COLUMNS[1..].iter().map(|&column| column.to_owned()).collect();
            self.problems.push(table.problem_of_file(ProfileMessage::NoNameColumn { others }));
        }
        columns
    }

    fn row(&mut self, columns: &[Option<&'static str>], cells: &'a [TableCell]) -> ProfileRow<'a> {
        let mut row = ProfileRow::new();
        for (index, cell) in cells.iter().enumerate().filter(|(_, cell)| !cell.text.is_empty()) {
            match columns.get(index) {
                Some(Some(column)) => drop(row.insert(column, cell)),
                // A column of a name that is not known is a problem once.
                Some(None) if !self.table.header[index].text.is_empty() => {}
                _ => self.fault(cell, ProfileMessage::NoColumn),
            }
        }
        row
    }

    fn name(&mut self, row: &ProfileRow, cells: &[TableCell], names: &mut BTreeSet<String>) -> String {
        let Some(cell) = row.get("name") else {
            if let Some(first) = cells.iter().find(|cell| !cell.text.is_empty()) {
                self.fault(first, ProfileMessage::NoName);
            }
            return String::new();
        };
        let name = &cell.text;
        let is_odd = |c: char| c.is_control() || "/\\:*?\"<>|".contains(c);
        if name.contains(is_odd) || name.starts_with('.') || name.ends_with('.') || name.len() > 100 {
            self.fault(cell, ProfileMessage::BadName { name: name.clone() });
        } else if name.to_lowercase() == LIST {
            self.fault(cell, ProfileMessage::ReservedName { name: name.clone() });
        } else if !names.insert(name.to_lowercase()) {
            self.fault(cell, ProfileMessage::SameName { name: name.clone() });
        }
        name.clone()
    }

    fn profile(&mut self, name: String, row: &ProfileRow, columns: &[Option<&str>]) -> Profile {
        let seed = row.get("seed").and_then(|cell| {
            let seed = cell.text.parse().ok().filter(|&seed: &u64| seed <= GREATEST_SEED);
            if seed.is_none() {
                self.fault(cell, ProfileMessage::Seed { text: cell.text.clone() });
            }
            seed
        });
        let cells = row.iter().filter(|(column, _)| !["name", "seed"].contains(column));
        let mut cells: BTreeMap<String, String> =
            cells.map(|(column, cell)| ((*column).to_owned(), cell.text.clone())).collect();
        if columns.contains(&Some("home")) {
            // A list with several homes names the home of each member.
            cells.entry("home".into()).or_insert_with(|| self.base.scenario.file.home.clone());
        }
        let mut profile = Profile {
            name,
            seed,
            row: cells,
            resident: None,
            routine: None,
            home: row.get("home").and_then(|cell| self.home(cell)),
            sentences: OwnSentences::default(),
            without: Vec::new(),
            texts: Arc::default(),
        };
        if row.keys().any(|column| !OTHER_COLUMNS.contains(column)) {
            profile.resident = self.resident(row);
            profile.routine = row.get("routine").and_then(|cell| self.routine(profile.resident, cell));
            profile.sentences = self.sentences(row);
        }
        profile
    }

    fn resident(&mut self, row: &ProfileRow) -> Option<usize> {
        let residents = &self.base.scenario.residents;
        let people = self.base.people();
        let names: Vec<&str> = people.iter().map(|&person| residents[person].file.name.as_str()).collect();
        let Some(cell) = row.get("resident") else {
            if people.len() != 1 {
                let message = match people.is_empty() {
                    true => ProfileMessage::NoRoutine,
                    false => {
                        ProfileMessage::WhichResident { residents: names.iter().map(|&name| name.to_owned()).collect() }
                    }
                };
                if let Some((_, cell)) = row.iter().find(|(column, _)| !OTHER_COLUMNS.contains(column)) {
                    self.fault(cell, message);
                }
            }
            return people.first().copied().filter(|_| people.len() == 1);
        };
        let found =
            people.iter().find(|&&person| residents[person].file.name.to_lowercase() == cell.text.to_lowercase());
        if found.is_none() {
            let known = among(nearest(&cell.text, names.iter().copied()), &names);
            self.fault(cell, ProfileMessage::NoResident { name: cell.text.clone(), known });
        }
        found.copied()
    }

    /// Another routine, if it exists and has no problems; each is read once.
    fn routine(&mut self, resident: Option<usize>, cell: &TableCell) -> Option<Arc<OtherRoutine>> {
        let key = (resident, cell.text.clone());
        if !self.routines.contains_key(&key) {
            let other = self.read_routine(resident, cell).map(Arc::new);
            self.routines.insert(key.clone(), other);
        }
        self.routines[&key].clone()
    }

    fn read_routine(&mut self, resident: Option<usize>, cell: &TableCell) -> Option<OtherRoutine> {
        let text = self.text(cell, "routine")?;
        let other = self.base.other(resident?, &cell.text, text);
        other.map_err(|wrong| self.problems.extend(wrong.0)).ok()
    }

    /// Another home, if it is readable; the check of the whole row finds its problems. Each is read once.
    fn home(&mut self, cell: &TableCell) -> Option<Arc<OtherHome>> {
        if cell.text == self.base.scenario.file.home {
            return None;
        }
        if !self.homes.contains_key(&cell.text) {
            let text = self.text(cell, "home");
            let other = text.map(|text| Arc::new(OtherHome { file: cell.text.clone(), text }));
            self.homes.insert(cell.text.clone(), other);
        }
        self.homes[&cell.text].clone()
    }

    /// The text of a file in the scenario's folder, such as a routine.
    fn text(&mut self, cell: &TableCell, kind: &str) -> Option<String> {
        if let Some(what) = outside_folder(&cell.text, "the scenario's folder") {
            self.problems.push(self.table.problem(cell, what, Some(WHERE.into())));
            return None;
        }
        let read = self.base.files.read(&cell.text);
        let unread = |why: NoText| {
            let (file, why, kind) = (cell.text.clone(), why.to_string(), kind.to_owned());
            self.fault(cell, ProfileMessage::Unreadable { file, why, kind });
        };
        read.map_err(unread).ok()
    }

    fn sentences(&mut self, row: &ProfileRow) -> OwnSentences {
        let fact = |reader: &mut RowReader, column: &str, words: [&str; 2], what: &'static str| {
            let cell = row.get(column)?;
            if !cell.text.parse::<f64>().is_ok_and(|number| number.is_finite() && number > 0.0) {
                reader.fault(cell, ProfileMessage::Number { text: cell.text.clone(), what });
                return None;
            }
            let pieces = [(words[0], None), (cell.text.as_str(), Some(*cell)), (words[1], None)];
            reader.sentence(&pieces, cell, None).map(|(text, _)| text)
        };
        OwnSentences {
            age: fact(self, "age", ["The person is ", ""], "age in years"),
            pace: fact(self, "pace_mps", ["The person walks at ", " m/s"], "pace in metres per second"),
            conditions: self.conditions(row),
        }
    }

    fn conditions(&mut self, row: &ProfileRow) -> Option<Vec<String>> {
        const OF_CONDITIONS: [&str; 4] = ["severity", "onset", "over", "until"];
        let named = row.get("conditions").filter(|cell| cell.text.to_lowercase() != "none");
        let Some(cell) = named else {
            for cell in OF_CONDITIONS.iter().filter_map(|column| row.get(column)) {
                self.fault(cell, ProfileMessage::NothingToDescribe);
            }
            return row.contains_key("conditions").then(Vec::new);
        };
        let conditions = cell.parts();
        let mut of_each: BTreeMap<&str, Vec<TableCell>> = BTreeMap::new();
        for (column, cell) in OF_CONDITIONS.into_iter().filter_map(|column| Some((column, *row.get(column)?))) {
            let parts = cell.parts();
            if parts.len() != 1 && parts.len() != conditions.len() {
                let (values, conditions) = (parts.len(), conditions.len());
                self.fault(cell, ProfileMessage::ValueCount { values, conditions });
            }
            of_each.insert(column, parts);
        }
        let (mut sentences, mut shown) = (Vec::new(), BTreeSet::new());
        for (index, condition) in conditions.iter().enumerate() {
            let of = |column| of_each.get(column).map(|parts: &Vec<TableCell>| parts.get(index).unwrap_or(&parts[0]));
            let own = condition.text.to_lowercase().split_whitespace().collect::<Vec<_>>().join("-");
            let is_name = own.chars().all(|c| c.is_alphanumeric() || c == '-');
            let file = format!("conditions/{own}.routine");
            let is_own = is_name && self.base.files.read(&file) != Err(NoText::Missing);
            let own = is_own.then_some(own.as_str());
            let alone = self.sentence(&[(SHOWS, None), (&condition.text, Some(condition))], condition, own);
            let name = alone.as_ref().and_then(|(_, routine)| shown_by(routine));
            if name.is_some_and(|name| !shown.insert(name.to_owned())) {
                self.fault(condition, ProfileMessage::SameCondition { condition: condition.text.clone() });
            }
            let together = self.condition(condition, own, alone.is_some(), of);
            sentences.extend(together.map(|(text, _)| text));
        }
        Some(sentences)
    }

    /// The sentence of a condition. Each cell is checked alone before the whole sentence.
    fn condition<'c>(
        &mut self,
        condition: &'c TableCell,
        own: Option<&str>,
        is_known: bool,
        of: impl Fn(&'static str) -> Option<&'c TableCell>,
    ) -> Option<(String, Routine)> {
        let before = self.problems.len();
        let of = |column| of(column).filter(|cell| !cell.text.is_empty());
        let (severity, mut known) = (of("severity"), language::severities());
        if let Some(cell) = severity.filter(|cell| !known.any(|known| known == cell.text.to_lowercase())) {
            let known = among(nearest(&cell.text, language::severities()), &Vec::from_iter(language::severities()));
            self.fault(cell, ProfileMessage::Severity { text: cell.text.clone(), known });
        }
        let phases = [("from ", "onset"), ("over ", "over"), ("until ", "until")];
        let phases: Vec<(&str, &TableCell)> =
            phases.into_iter().filter_map(|(words, of_it)| Some((words, of(of_it)?))).collect();
        for &(words, cell) in &phases {
            let from = if words == "over " { "from day 1, " } else { "" };
            let any = [(", ", None), (SHOWS, None), (CONDITIONS[0].0, None)];
            let pieces = [(from, None), (words, None), (cell.text.as_str(), Some(cell))];
            let so_far = self.problems.len();
            self.sentence(&[pieces, any].concat(), cell, None);
            let hint = match words {
                "over " => "write how long it takes to develop, such as 10 days or 4 weeks",
                _ => "write a week, a day or a date, such as week 6, day 40 or 2009-04-13",
            };
            for problem in &mut self.problems[so_far..] {
                (problem.hint, problem.fix) = (Some(hint.to_owned()), None);
            }
        }
        if !is_known || self.problems.len() > before {
            return None;
        }
        let mut pieces: Vec<SentencePart> = Vec::new();
        for (words, cell) in phases {
            pieces.extend([(words, None), (cell.text.as_str(), Some(cell)), (", ", None)]);
        }
        pieces.push((SHOWS, None));
        pieces.extend(severity.into_iter().flat_map(|cell| [(cell.text.as_str(), Some(cell)), (" ", None)]));
        pieces.push((&condition.text, Some(condition)));
        self.sentence(&pieces, condition, own)
    }

    /// A sentence of pieces with its routine, if it has one meaning. A problem belongs to the cell at its place. `own` is a condition of
    /// the scenario's own.
    fn sentence(&mut self, pieces: &[SentencePart], main: &TableCell, own: Option<&str>) -> Option<(String, Routine)> {
        let before = self.problems.len();
        for cell in pieces.iter().filter_map(|(_, cell)| *cell) {
            let is_odd = |c: char| !c.is_alphanumeric() && !" -.%".contains(c);
            if cell.text.is_empty() || cell.text.contains(is_odd) || cell.text.contains(". ") {
                self.fault(cell, ProfileMessage::NotPlain { text: cell.text.clone() });
            }
        }
        if self.problems.len() > before {
            return None;
        }
        let text: String = pieces.iter().map(|(text, _)| *text).collect();
        let text = text[..1].to_uppercase() + &text[1..];
        let key = (text, own.map(str::to_owned));
        if let Some(routine) = self.routines_of_sentences.get(&key) {
            return Some((key.0, routine.clone()));
        }
        let text = key.0.clone();
        let conditions = CONDITIONS.iter().map(|(name, _)| *name).chain(own).map(String::from).collect();
        let first_date = Some(self.base.scenario.calendar.date(0));
        let (routine, problems) =
            language::routine("", &text, &KnownNames { conditions, first_date, ..KnownNames::default() });
        for problem in problems {
            let mut end = 0;
            let at_or_after = |(text, cell): &SentencePart| {
                end += text.chars().count() as u32;
                cell.is_some() && end >= problem.column
            };
            let cell = pieces.iter().cloned().find(at_or_after).and_then(|(_, cell)| cell).unwrap_or(main);
            self.problems.push(self.table.problem(cell, problem, None));
        }
        let is_one = match &routine.changes[..] {
            [_] => shown_by(&routine).is_some() && routine.person.is_none(),
            [] => routine.person.is_some(),
            _ => false,
        };
        if self.problems.len() == before && !(is_one && routine.habits.is_empty() && routine.rules.is_empty()) {
            self.fault(main, ProfileMessage::OtherMeaning { sentence: text.trim().to_owned() });
        }
        (self.problems.len() == before).then(|| {
            self.routines_of_sentences.insert(key, routine.clone());
            (text, routine)
        })
    }
}

fn shown_by(sentence: &Routine) -> Option<&str> {
    sentence.changes.iter().find_map(|change| match &change.effect {
        Effect::Shows { condition, .. } => Some(condition.as_str()),
        _ => None,
    })
}

fn place(problem: &Problem) -> String {
    match problem.line {
        0 => problem.file.clone(),
        line => format!("{}:{line}:{}", problem.file, problem.column),
    }
}
