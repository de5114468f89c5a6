//! A member of a cohort: its row, and its scenario.

use super::sentences::OwnSentences;
use homebody_core::home::form::HomeFile;
use homebody_core::problem::Problems;
use homebody_core::scenario::edit::ScenarioEdit;
use homebody_core::scenario::load::{Files, ResidentDriver, Scenario};
use homebody_routine::household::Household;
use homebody_routine::routine::{ResidentKind, Routine};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// The profile of a member of a cohort.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// The name of the member and of the member's folder.
    pub name: String,
    /// The seed of the member.
    pub seed: Option<u64>,
    /// The texts of the other cells, by column.
    pub row: BTreeMap<String, String>,
    /// Index of the resident that it is about; `None` without overrides.
    pub(super) resident: Option<usize>,
    /// The routine instead of their own.
    pub(super) routine: Option<Arc<OtherRoutine>>,
    /// The home instead of the scenario's.
    pub(super) home: Option<Arc<OtherHome>>,
    pub(super) sentences: OwnSentences,
    /// The conditions of this member that are left out.
    pub without: Vec<String>,
    /// The texts that this member needs, by name: those of the scenario and of the row.
    pub(super) texts: Arc<BTreeMap<String, String>>,
}

#[derive(Debug, PartialEq)]
pub(super) struct OtherRoutine {
    pub routine: Routine,
    pub text: String,
}

#[derive(Debug, PartialEq)]
pub(super) struct OtherHome {
    pub file: String,
    pub text: String,
}

/// The routine of a member instead of the scenario's.
struct OwnRoutine {
    resident: usize,
    file: String,
    text: String,
}

pub(crate) struct Base<'a> {
    pub scenario: &'a Scenario,
    pub household: &'a Household,
    pub files: &'a (dyn Files + Sync),
}

impl Profile {
    pub(crate) fn texts(&self) -> &BTreeMap<String, String> {
        &self.texts
    }
}

impl Base<'_> {
    /// The scenario of a member, whose residents differ from their routines as people differ.
    pub fn of_member(&self, profile: &Profile) -> Result<(Scenario, Household), Problems> {
        let (scenario, household) = self.with(profile, &profile.without)?;
        Ok((scenario, household.one_of_many()))
    }

    /// The scenario with the overrides of a profile, and without these conditions.
    pub(super) fn with(&self, profile: &Profile, without: &[String]) -> Result<(Scenario, Household), Problems> {
        match self.edited(profile) {
            None => Ok((self.scenario.clone(), self.household.without(without)?)),
            Some(edit) => Household::load(&edit.over(self.files), &self.scenario.entry, without),
        }
    }

    /// The texts of a member that differ from the scenario, by name. It loads nothing.
    pub fn own_texts(&self, profile: &Profile) -> BTreeMap<String, String> {
        let texts = self.edited(profile).map(ScenarioEdit::into_texts).unwrap_or_default();
        let is_own = |(name, text): &(String, String)| self.scenario.sources.get(name) != Some(text);
        texts.into_iter().filter(is_own).collect()
    }

    /// The unchecked scenario with the overrides of a profile; `None` without overrides.
    fn edited(&self, profile: &Profile) -> Option<ScenarioEdit> {
        let (home, routine) = (profile.home.as_deref(), self.own_routine(profile));
        if home.is_none() && routine.is_none() {
            return None;
        }
        let mut edit = self.scenario.edit();
        if let Some(OtherHome { file, text }) = home {
            edit = edit.file(|scenario| scenario.home = file.clone()).text(file, text.clone());
            edit = self.with_its_ids(edit, text);
        }
        if let Some(OwnRoutine { resident, file, text }) = routine {
            edit = edit.routine(resident, &file, text);
        }
        Some(edit)
    }

    /// Another home needs only the ids of its own sensors in the logger.
    fn with_its_ids(&self, edit: ScenarioEdit, home: &str) -> ScenarioEdit {
        // Loading reports the problems of the home.
        let Ok(home) = serde_json::from_str::<HomeFile>(home) else { return edit };
        let mut logger = self.scenario.logger.clone();
        let known: BTreeSet<&str> = home.sensors.iter().map(|sensor| sensor.name()).collect();
        logger.ids.retain(|sensor, _| known.contains(sensor.as_str()));
        if logger == self.scenario.logger { edit } else { edit.logger(&logger) }
    }

    /// The routine of a member's resident; `None` for the scenario's.
    fn own_routine(&self, profile: &Profile) -> Option<OwnRoutine> {
        let resident = profile.resident?;
        let ResidentDriver::Routine { file, text } = &self.scenario.residents[resident].driver else { return None };
        let other = profile.routine.as_deref();
        let routine = other.map(|other| &other.routine).or(self.household.routine(resident));
        let (file, text) = other.map_or((file, text), |other| (&other.routine.file, &other.text));
        match routine.filter(|_| profile.sentences != OwnSentences::default()) {
            Some(routine) => {
                let own = file_of_own(self.scenario, resident, file);
                Some(OwnRoutine { resident, file: own, text: profile.sentences.within(text, routine) })
            }
            None => other.map(|_| OwnRoutine { resident, file: file.clone(), text: text.clone() }),
        }
    }

    /// Another routine for a resident, if it is sound.
    pub(super) fn other(&self, resident: usize, file: &str, text: String) -> Result<OtherRoutine, Problems> {
        let edit = self.scenario.edit().routine(resident, file, text.clone());
        let (_, household) = Household::load(&edit.over(self.files), &self.scenario.entry, &[])?;
        Ok(OtherRoutine { routine: household.routine(resident).cloned().unwrap_or_default(), text })
    }

    pub(super) fn people(&self) -> Vec<usize> {
        let is_person = |&resident: &usize| {
            let person = self.household.routine(resident).map(|routine| routine.person.as_ref());
            person.is_some_and(|person| person.is_none_or(|person| person.kind == ResidentKind::Person))
        };
        (0..self.scenario.residents.len()).filter(is_person).collect()
    }
}

/// A file for the routine of this resident alone, as other residents may share the original. It has the same name in another folder: the
/// unchanged sentences then draw the same random numbers.
fn file_of_own(scenario: &Scenario, resident: usize, file: &str) -> String {
    let folder = scenario.file.residents[resident].trim_end_matches(".json");
    let mut own = format!("{folder}/{}", file.rsplit('/').next().unwrap_or(file));
    while scenario.sources.contains_key(&own) {
        own = format!("{folder}/{own}");
    }
    own
}
