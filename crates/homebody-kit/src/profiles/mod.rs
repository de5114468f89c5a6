//! A list of profiles: who the members of a cohort are, and in what each differs from the scenario.
//!
//! A profile is said in the language of routines: the routine of the resident whom it is about gets its sentences, and
//! loses those that say otherwise. So a member's recording holds all that the member's life depends on, and nobody who lives
//! or replays it knows of profiles.

mod rows;
mod sentences;
mod table;

use crate::error::Error;
use homebody_core::problem::{Problem, Problems};
use homebody_core::scenario::load::{Driver, Files, Scenario};
use homebody_routine::household::Household;
use homebody_routine::routine::{Kind, Routine};
use sentences::OwnSentences;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io::ErrorKind;
use std::path::Path;
use std::sync::Arc;
use table::Table;

/// Who one member of a cohort is.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// What the member is called, and the member's folder.
    pub name: String,
    /// A number of their own that all their randomness comes from.
    pub seed: Option<u64>,
    /// What the row says besides, by column, as it is written.
    pub row: BTreeMap<String, String>,
    /// Index of the resident whom it is about; nobody where nothing differs.
    resident: Option<usize>,
    /// What they live by instead of their own routine.
    routine: Option<Arc<Other>>,
    said: OwnSentences,
    /// Of the conditions that are asked to be left out, those that this member would show.
    pub without: Vec<String>,
    /// The texts that this member needs, by name: the scenario's, and those that only the row names.
    texts: Arc<BTreeMap<String, String>>,
}

/// A routine beside the scenario's, with its text.
#[derive(Debug, PartialEq)]
struct Other {
    routine: Routine,
    text: String,
}

/// A scenario that members differ from.
pub(crate) struct Base<'a> {
    pub scenario: &'a Scenario,
    pub household: &'a Household,
    pub files: &'a (dyn Files + Sync),
}

impl Profile {
    /// The texts that this member needs, by name, as they were read.
    pub(crate) fn texts(&self) -> &BTreeMap<String, String> {
        &self.texts
    }
}

/// Reads a file of profiles: all of them, or all that is wrong.
pub(crate) fn read(path: &Path, base: &Base, without: &[String]) -> Result<Vec<Profile>, Error> {
    let file = path.display().to_string();
    let bytes = fs::read(path).map_err(|error| match error.kind() {
        ErrorKind::NotFound => {
            Error::file(path, "there is no such file\n  hint: it is a CSV file with a row for each member")
        }
        ErrorKind::IsADirectory => Error::file(path, "it is a folder\n  hint: name a CSV file"),
        _ => Error::io(path, error),
    })?;
    let text = String::from_utf8(bytes).map_err(|_| {
        let hint = Some("save it as CSV in UTF-8".to_owned());
        Problem::of_file(&file, "it is not text in UTF-8", hint)
    })?;
    of(&file, &text, base, without)
}

/// The profiles of a table that problems call `file`: all of them, or all that is wrong.
pub(crate) fn of(file: &str, text: &str, base: &Base, without: &[String]) -> Result<Vec<Profile>, Error> {
    let table = Table::read(file, text)?;
    let (profiles, problems) = rows::read(&table, base, without);
    if problems.is_empty() { Ok(profiles) } else { Err(Error::Problems(in_order(problems, file))) }
}

/// Profiles as a table of which [`of`] makes the same ones again.
pub(crate) fn table(profiles: &[Profile]) -> String {
    let columns: BTreeSet<&str> = profiles.iter().flat_map(|profile| profile.row.keys().map(String::as_str)).collect();
    let quoted = |text: &str| format!("\"{}\"", text.replace('"', "\"\""));
    let mut table = ["name", "seed"].into_iter().chain(columns.iter().copied()).collect::<Vec<_>>().join(",");
    for Profile { name, seed, row, .. } in profiles {
        table += &format!("\n{},{}", quoted(name), seed.map(|seed| seed.to_string()).unwrap_or_default());
        for column in &columns {
            table += &format!(",{}", row.get(*column).map(|text| quoted(text)).unwrap_or_default());
        }
    }
    table + "\n"
}

/// Problems in the order of their places, those of other files than the list last.
fn in_order(mut problems: Vec<Problem>, file: &str) -> Problems {
    problems.sort_by_key(|problem| (problem.file != file, problem.file.clone(), problem.line, problem.column));
    // Of several conditions that begin at once, each has the same to say.
    problems.dedup();
    Problems::truncated(&problems)
}

impl Base<'_> {
    /// The scenario as this member lives it, one of many.
    pub fn lived(&self, profile: &Profile) -> Result<(Scenario, Household), Problems> {
        let (scenario, household) = self.with(profile, &profile.without)?;
        Ok((scenario, household.one_of_many()))
    }

    /// The scenario with what a profile says in it, and without these conditions.
    fn with(&self, profile: &Profile, without: &[String]) -> Result<(Scenario, Household), Problems> {
        let Some((resident, edit)) = profile.resident.map(|resident| (resident, self.scenario.edit())) else {
            return Ok((self.scenario.clone(), self.household.without(without)?));
        };
        let Driver::Routine { file, text } = &self.scenario.residents[resident].driver else {
            return Ok((self.scenario.clone(), self.household.without(without)?));
        };
        let other = profile.routine.as_deref();
        let routine = other.map(|other| &other.routine).or(self.household.routine(resident));
        let (file, text) = other.map_or((file, text), |other| (&other.routine.file, &other.text));
        let edit = match routine.filter(|_| profile.said != OwnSentences::default()) {
            Some(routine) => {
                let own = file_of_own(self.scenario, resident, file);
                edit.routine(resident, &own, profile.said.within(text, routine))
            }
            None if other.is_some() => edit.routine(resident, file, text),
            None => return Ok((self.scenario.clone(), self.household.without(without)?)),
        };
        Household::load(&edit.over(self.files), &self.scenario.entry, without)
    }

    /// Another routine for a resident, if it is sound.
    fn other(&self, resident: usize, file: &str, text: String) -> Result<Other, Problems> {
        let edit = self.scenario.edit().routine(resident, file, text.clone());
        let (_, household) = Household::load(&edit.over(self.files), &self.scenario.entry, &[])?;
        Ok(Other { routine: household.routine(resident).cloned().unwrap_or_default(), text })
    }

    /// Those who live by a routine as people do.
    fn people(&self) -> Vec<usize> {
        let is_person = |&resident: &usize| {
            let person = self.household.routine(resident).map(|routine| routine.person.as_ref());
            person.is_some_and(|person| person.is_none_or(|person| person.kind == Kind::Person))
        };
        (0..self.scenario.residents.len()).filter(is_person).collect()
    }
}

/// A file for the routine of this resident alone, since others may live by the one that it is made from: of the same name, so
/// that their life is the same but for what is changed, in a folder of their own.
fn file_of_own(scenario: &Scenario, resident: usize, file: &str) -> String {
    let folder = scenario.file.residents[resident].trim_end_matches(".json");
    let mut own = format!("{folder}/{}", file.rsplit('/').next().unwrap_or(file));
    while scenario.sources.contains_key(&own) {
        own = format!("{folder}/{own}");
    }
    own
}
