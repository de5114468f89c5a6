//! Who a member is: what a row says, and the scenario as this member lives it.

use super::sentences::OwnSentences;
use homebody_core::problem::Problems;
use homebody_core::scenario::edit::ScenarioEdit;
use homebody_core::scenario::home::HomeFile;
use homebody_core::scenario::load::{Driver, Files, Scenario};
use homebody_routine::household::Household;
use homebody_routine::routine::{Kind, Routine};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

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
    pub(super) resident: Option<usize>,
    /// What they live by instead of their own routine.
    pub(super) routine: Option<Arc<Other>>,
    /// Where they live instead of in the scenario's home.
    pub(super) home: Option<Arc<OtherHome>>,
    pub(super) said: OwnSentences,
    /// Of the conditions that are asked to be left out, those that this member would show.
    pub without: Vec<String>,
    /// The texts that this member needs, by name: the scenario's, and those that only the row names.
    pub(super) texts: Arc<BTreeMap<String, String>>,
}

/// A routine beside the scenario's, with its text.
#[derive(Debug, PartialEq)]
pub(super) struct Other {
    pub routine: Routine,
    pub text: String,
}

/// A home beside the scenario's, with its text.
#[derive(Debug, PartialEq)]
pub(super) struct OtherHome {
    pub file: String,
    pub text: String,
}

/// A routine that a member lives by instead of the scenario's.
struct OwnRoutine {
    /// Index of the resident.
    resident: usize,
    file: String,
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

impl Base<'_> {
    /// The scenario as this member lives it, one of many.
    pub fn lived(&self, profile: &Profile) -> Result<(Scenario, Household), Problems> {
        let (scenario, household) = self.with(profile, &profile.without)?;
        Ok((scenario, household.one_of_many()))
    }

    /// The scenario with what a profile says in it, and without these conditions.
    pub(super) fn with(&self, profile: &Profile, without: &[String]) -> Result<(Scenario, Household), Problems> {
        match self.edited(profile) {
            None => Ok((self.scenario.clone(), self.household.without(without)?)),
            Some(edit) => Household::load(&edit.over(self.files), &self.scenario.entry, without),
        }
    }

    /// The texts by which a member's life differs from the scenario, by name; none where it is as the scenario says. Nothing is
    /// loaded for it.
    pub fn own_texts(&self, profile: &Profile) -> BTreeMap<String, String> {
        let texts = self.edited(profile).map(ScenarioEdit::into_texts).unwrap_or_default();
        let is_own = |(name, text): &(String, String)| self.scenario.sources.get(name) != Some(text);
        texts.into_iter().filter(is_own).collect()
    }

    /// The scenario with what a profile says in it, unchecked; `None` where it is as it was.
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

    /// In another home, the logger knows the ids of the sensors that it has: others keep their name.
    fn with_its_ids(&self, edit: ScenarioEdit, home: &str) -> ScenarioEdit {
        // What is wrong with a home is said when it is loaded.
        let Ok(home) = serde_json::from_str::<HomeFile>(home) else { return edit };
        let mut logger = self.scenario.logger.clone();
        let known: BTreeSet<&str> = home.sensors.iter().map(|sensor| sensor.name()).collect();
        logger.ids.retain(|sensor, _| known.contains(sensor.as_str()));
        if logger == self.scenario.logger { edit } else { edit.logger(&logger) }
    }

    /// What a profile has its resident live by; `None` where it is what the scenario says.
    fn own_routine(&self, profile: &Profile) -> Option<OwnRoutine> {
        let resident = profile.resident?;
        let Driver::Routine { file, text } = &self.scenario.residents[resident].driver else { return None };
        let other = profile.routine.as_deref();
        let routine = other.map(|other| &other.routine).or(self.household.routine(resident));
        let (file, text) = other.map_or((file, text), |other| (&other.routine.file, &other.text));
        match routine.filter(|_| profile.said != OwnSentences::default()) {
            Some(routine) => {
                let own = file_of_own(self.scenario, resident, file);
                Some(OwnRoutine { resident, file: own, text: profile.said.within(text, routine) })
            }
            None => other.map(|_| OwnRoutine { resident, file: file.clone(), text: text.clone() }),
        }
    }

    /// Another routine for a resident, if it is sound.
    pub(super) fn other(&self, resident: usize, file: &str, text: String) -> Result<Other, Problems> {
        let edit = self.scenario.edit().routine(resident, file, text.clone());
        let (_, household) = Household::load(&edit.over(self.files), &self.scenario.entry, &[])?;
        Ok(Other { routine: household.routine(resident).cloned().unwrap_or_default(), text })
    }

    /// Those who live by a routine as people do.
    pub(super) fn people(&self) -> Vec<usize> {
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
