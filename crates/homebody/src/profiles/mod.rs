//! A list of profiles: who the members of a cohort are, and in what each differs from the scenario.
//!
//! A profile is said in the language of routines: the routine of the resident whom it is about gets its sentences, and
//! loses those that say otherwise. So a member's recording holds all that the member's life depends on, and nobody who lives
//! or replays it knows of profiles.

mod rows;
mod sentences;
mod table;

use crate::failure::Failure;
use homebody_core::problem::{Problem, Problems};
use homebody_core::scenario::load::{Driver, Files, Scenario};
use homebody_routine::household::{CONDITIONS, Household};
use homebody_routine::language::Known;
use homebody_routine::routine::Kind;
use sentences::Said;
use std::collections::BTreeMap;
use std::fs;
use std::io::ErrorKind;
use std::path::Path;
use table::Table;

/// Who one member of a cohort is.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    pub name: String,
    pub seed: Option<u64>,
    /// What the row says besides, by column, as it is written.
    pub row: BTreeMap<String, String>,
    /// Index of the resident whom it is about; nobody where nothing differs.
    resident: Option<usize>,
    routine: Option<String>,
    said: Said,
    /// Of the conditions that are asked to be left out, those that this member would show.
    pub without: Vec<String>,
}

/// A scenario that members differ from.
pub struct Base<'a> {
    pub scenario: &'a Scenario,
    pub household: &'a Household,
    pub files: &'a (dyn Files + Sync),
}

/// Reads a file of profiles: all of them, or all that is wrong.
pub fn read(path: &Path, base: &Base, without: &[String]) -> Result<Vec<Profile>, Failure> {
    let file = path.display().to_string();
    let bytes = fs::read(path).map_err(|error| match error.kind() {
        ErrorKind::NotFound => {
            Failure::io(path, "there is no such file\n  hint: it is a CSV file with a row for each member")
        }
        ErrorKind::IsADirectory => Failure::io(path, "it is a folder\n  hint: name a CSV file"),
        _ => Failure::io(path, error),
    })?;
    let text = String::from_utf8(bytes).map_err(|_| {
        let hint = Some("save it as CSV in UTF-8".to_owned());
        Failure::Problems(Problems(vec![Problem::of_file(&file, "it is not text in UTF-8", hint)]))
    })?;
    let table = Table::read(&file, &text).map_err(|problem| Failure::Problems(Problems(vec![problem])))?;
    let (profiles, problems) = rows::read(&table, base, without);
    if problems.is_empty() { Ok(profiles) } else { Err(Failure::Problems(in_order(problems, &file))) }
}

/// Problems in the order of their places, those of other files than the list last.
fn in_order(mut problems: Vec<Problem>, file: &str) -> Problems {
    /// Nobody reads more.
    const MOST_TOLD: usize = 100;
    problems.sort_by_key(|problem| (problem.file != file, problem.file.clone(), problem.line, problem.column));
    // Of several conditions that begin at once, each has the same to say.
    problems.dedup();
    let more = problems.len().saturating_sub(MOST_TOLD);
    problems.truncate(MOST_TOLD);
    if more > 0 {
        problems.push(Problem::of_file(file, format!("there are {more} more problems"), None));
    }
    Problems(problems)
}

impl Base<'_> {
    /// The scenario as this member lives it, one of many.
    pub fn lived(&self, profile: &Profile) -> Result<(Scenario, Household), Problems> {
        let (scenario, household) = self.with(profile.resident, profile.routine.as_deref(), &profile.said)?;
        match profile.without.is_empty() {
            true => Ok((scenario, household.one_of_many())),
            false => {
                let mut scenario = scenario;
                let household = Household::read(&mut scenario, self.files, &profile.without)?;
                Ok((scenario, household.one_of_many()))
            }
        }
    }

    /// The scenario with another routine of a resident, and with this said in it.
    fn with(
        &self,
        resident: Option<usize>,
        file: Option<&str>,
        said: &Said,
    ) -> Result<(Scenario, Household), Problems> {
        let mut scenario = self.scenario.clone();
        let mut household = self.household.clone();
        let Some(resident) = resident else { return Ok((scenario, household)) };
        if let Some(file) = file {
            let text = self.files.read(file).map_err(|why| Problems(vec![Problem::of_file(file, why, None)]))?;
            give_routine(&mut scenario, resident, file, text);
            household = Household::read(&mut scenario, self.files, &[])?;
        }
        if *said == Said::default() {
            return Ok((scenario, household));
        }
        let known = self.known(resident, Vec::new());
        if let (Some(routine), Driver::Routine { file, text }) =
            (household.routine(resident), &mut scenario.residents[resident].driver)
        {
            *text = said.within(text, routine, &known);
            scenario.sources.insert(file.clone(), text.clone());
        }
        let household = Household::read(&mut scenario, self.files, &[])?;
        Ok((scenario, household))
    }

    /// What sentences about a resident may name.
    fn known(&self, resident: usize, own: Vec<String>) -> Known {
        let conditions = CONDITIONS.iter().map(|(name, _)| (*name).to_owned()).chain(own).collect();
        let person = Some(self.scenario.residents[resident].file.name.clone());
        Known { person, conditions, first_date: Some(self.scenario.calendar.date(0)), ..Known::default() }
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

/// Makes a resident live by another routine, also in the text of their file.
fn give_routine(scenario: &mut Scenario, resident: usize, file: &str, text: String) {
    let links = |text: &str, resident: &str| {
        let json: serde_json::Value = serde_json::from_str(text.trim_start_matches('\u{feff}')).ok()?;
        (json["name"] == resident && json.pointer("/driver/routine").is_some()).then_some(json)
    };
    let one = &mut scenario.residents[resident];
    one.driver = Driver::Routine { file: file.into(), text: text.clone() };
    let links = scenario.sources.iter().find_map(|(name, text)| Some((name.clone(), links(text, &one.file.name)?)));
    if let Some((name, mut json)) = links {
        json["driver"]["routine"] = file.into();
        scenario.sources.insert(name, format!("{json:#}\n"));
    }
    scenario.sources.insert(file.into(), text);
}
