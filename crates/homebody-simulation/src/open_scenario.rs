//! A scenario that was opened: checked, with its routines read, ready to be simulated any number of times.

use crate::error::SimulationError;
use crate::profiles::{self, Base, Profile};
use crate::scenario_source::{ScenarioSource, Template};
use crate::scenario_warnings::ScenarioWarning;
use crate::{idle_sensors, missing_parts};
use homebody_core::numbers::{self, Number};
use homebody_core::problem::{Problem, Problems};
use homebody_core::scenario::ScenarioFile;
use homebody_core::scenario::load::{Files, Scenario};
use homebody_core::scenario::remarks::scenario_remarks;
use homebody_core::time::{DAY, Span};
use homebody_routine::behaviour::difference::Difference;
use homebody_routine::household::{self, Household};
use homebody_routine::routine::Routine;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Opens a scenario by its folder or its `scenario.json`.
///
/// ```
/// let scenario = homebody_simulation::open("../../scenarios/tigerplace")?;
/// assert_eq!(scenario.name(), "tigerplace");
/// # Ok::<(), homebody_simulation::SimulationError>(())
/// ```
///
/// # Errors
///
/// [`SimulationError::Unreadable`] without such a folder, [`SimulationError::Problems`] with all problems of its files.
pub fn open(path: impl AsRef<Path>) -> Result<OpenScenario, SimulationError> {
    ScenarioSource::at(path)?.open()
}

/// Opens a scenario that comes with the program.
///
/// ```
/// let scenario = homebody_simulation::template("older-adult")?;
/// assert!(homebody_simulation::template("older adult").is_err());
/// # Ok::<(), homebody_simulation::SimulationError>(())
/// ```
///
/// # Errors
///
/// [`SimulationError::Template`] without a template of this name.
pub fn template(name: &str) -> Result<OpenScenario, SimulationError> {
    Template::named(name)?.source().open()
}

/// All parameters of the models that a scenario may set, each with its unit and its range.
pub fn numbers() -> Vec<Number> {
    household::numbers()
}

/// A scenario that has passed every check, with its routines. A clone is cheap.
#[derive(Clone)]
pub struct OpenScenario {
    pub(crate) scenario: Arc<Scenario>,
    pub(crate) household: Arc<Household>,
    pub(crate) source: ScenarioSource,
}

impl ScenarioSource {
    /// Checks the scenario and reads its routines.
    ///
    /// # Errors
    ///
    /// [`SimulationError::Problems`]: everything that is wrong with its files; [`SimulationError::File`] if the system could not read one.
    pub fn open(self) -> Result<OpenScenario, SimulationError> {
        let loaded = Household::load(self.files(), self.entry(), &[]);
        let (scenario, household) = loaded.map_err(|problems| self.why(problems))?;
        Ok(OpenScenario { scenario: Arc::new(scenario), household: Arc::new(household), source: self })
    }
}

impl OpenScenario {
    /// Opens the scenario of files in memory; `entry` is the name of the scenario's own file among them.
    ///
    /// # Errors
    ///
    /// All problems of the files.
    pub fn from_files(files: &dyn Files, entry: &str) -> Result<OpenScenario, Problems> {
        let (scenario, household) = Household::load(files, entry, &[])?;
        let source = ScenarioSource::from_texts(scenario.sources.clone(), entry);
        Ok(OpenScenario { scenario: Arc::new(scenario), household: Arc::new(household), source })
    }

    /// The name of the scenario.
    pub fn name(&self) -> &str {
        &self.scenario.file.name
    }

    /// The content of its files.
    pub fn scenario(&self) -> &Scenario {
        &self.scenario
    }

    /// The routines of its residents, and their conditions.
    pub fn household(&self) -> &Household {
        &self.household
    }

    /// Its files as they were opened.
    pub fn source(&self) -> &ScenarioSource {
        &self.source
    }

    /// The files on disk that it was opened from: a run never replaces one of them.
    pub fn paths(&self) -> Vec<PathBuf> {
        self.source.paths(&self.scenario)
    }

    /// Warnings about a run of this length.
    pub fn remarks(&self, length: Span) -> Vec<Problem> {
        let mut all = scenario_remarks(&self.scenario, length);
        all.extend(idle_sensors::remarks(&self.scenario, &self.household));
        all.extend(self.missing_parts());
        all.extend(self.sentence_remarks(length));
        all
    }

    /// Warnings about sentences without effect on a run of this length.
    pub fn sentence_remarks(&self, length: Span) -> Vec<Problem> {
        let predicted = self.household.predicted_differences(days(length));
        let routines = (0..self.scenario.residents.len()).filter_map(|resident| self.household.routine(resident));
        predicted.iter().map(without_effect).chain(routines.filter_map(unsimulated)).collect()
    }

    /// Whether a resident has a routine.
    pub fn has_routine(&self) -> bool {
        (0..self.scenario.residents.len()).any(|resident| self.household.routine(resident).is_some())
    }

    /// Warnings about missing parts without which a run or its log is empty, such as sensors.
    pub fn missing_parts(&self) -> Vec<Problem> {
        missing_parts::remarks(&self.scenario)
    }

    /// Warnings about the profiles of a list, one for each combination of conditions and times; `list` is the name of the list in
    /// problems.
    ///
    /// # Errors
    ///
    /// [`SimulationError::Problems`] if a profile is not one of this scenario.
    pub fn remarks_on(&self, list: &str, profiles: &[Profile], length: Span) -> Result<Vec<Problem>, SimulationError> {
        let known = self.household.predicted_differences(days(length));
        let (mut seen, mut all) = (BTreeSet::new(), Vec::new());
        for profile in profiles {
            let cells = ["conditions", "severity", "onset", "over", "until", "routine", "home"]
                .map(|column| profile.row.get(column));
            if !seen.insert(cells) {
                continue;
            }
            let (_, household) = self.base().of_member(profile)?;
            let own = household.predicted_differences(days(length)).into_iter();
            all.extend(own.filter(|one| known.iter().all(|known| known.text != one.text)).map(|one| {
                let (sentence, effect) = (one_line(&one.text), one.lived);
                let message = ScenarioWarning::MemberWithoutEffect { member: profile.name.clone(), sentence, effect };
                Problem::of_file(list, message, None)
            }));
        }
        Ok(all)
    }

    /// The members of a list: a CSV file with a row for each. The conditions in `without` are left out of the members that have them.
    ///
    /// # Errors
    ///
    /// [`SimulationError::File`] or [`SimulationError::Unreadable`] if it cannot be read, [`SimulationError::Problems`] with all its problems.
    pub fn profiles(&self, path: impl AsRef<Path>, without: &[String]) -> Result<Vec<Profile>, SimulationError> {
        profiles::read(path.as_ref(), &self.base(), without)
    }

    /// The members of a list in memory: a table in CSV, whose first line names the columns. Problems call it `name`.
    ///
    /// ```
    /// let scenario = homebody_simulation::template("older-adult")?;
    /// let profiles = scenario.profiles_from_table("people.csv", "name,age\nanna,75\nbea,88\n", &[])?;
    /// assert_eq!(profiles.len(), 2);
    /// # Ok::<(), homebody_simulation::SimulationError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`SimulationError::Problems`] with all its problems.
    pub fn profiles_from_table(
        &self,
        name: &str,
        table: &str,
        without: &[String],
    ) -> Result<Vec<Profile>, SimulationError> {
        profiles::from_table(name, table, &self.base(), without)
    }

    /// The scenario with these parameters set, by name. The recordings of its runs have them in the scenario's own file.
    ///
    /// ```
    /// let scenario = homebody_simulation::template("older-adult")?;
    /// let slower = scenario.with_numbers([("gait.fastest", 0.8)])?;
    /// assert_eq!(slower.scenario().file.numbers["gait.fastest"], 0.8);
    /// assert!(scenario.with_numbers([("gait.fastst", 0.8)]).is_err());
    /// # Ok::<(), homebody_simulation::SimulationError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`SimulationError::Problems`] with every unknown parameter and every value out of range, or if the residents cannot live
    /// in the home with them.
    pub fn with_numbers(
        &self,
        set: impl IntoIterator<Item = (impl Into<String>, f64)>,
    ) -> Result<OpenScenario, SimulationError> {
        let set: BTreeMap<String, f64> = set.into_iter().map(|(name, value)| (name.into(), value)).collect();
        if set.is_empty() {
            return Ok(self.clone());
        }
        let known = numbers();
        let wrong = set.iter().filter_map(|(name, &value)| numbers::wrong(&known, name, value));
        let problem = |message| Problem::of_file(self.name(), message, None);
        let problems: Vec<Problem> = wrong.map(problem).collect();
        if !problems.is_empty() {
            return Err(SimulationError::Problems(Problems(problems)));
        }
        self.with_file(|file| file.numbers.extend(set))
    }

    /// The scenario with another start on the clock of the home, such as `2026-11-01T08:00:00`.
    ///
    /// ```
    /// let scenario = homebody_simulation::template("studio")?.starting("2026-11-01T08:00:00")?;
    /// assert_eq!(scenario.scenario().calendar.wall_clock(homebody_core::time::RunTime::START), "2026-11-01 08:00:00");
    /// # Ok::<(), homebody_simulation::SimulationError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`SimulationError::Problems`] without such a date and time.
    pub fn starting(&self, start: impl Into<String>) -> Result<OpenScenario, SimulationError> {
        let start = start.into();
        self.with_file(|file| file.start = start)
    }

    /// The scenario with its own file changed, also in the recordings of its runs.
    fn with_file(&self, change: impl FnOnce(&mut ScenarioFile)) -> Result<OpenScenario, SimulationError> {
        let edit = self.scenario.edit().file(change);
        let (scenario, household) = Household::load(&edit.over(self.source.files()), self.source.entry(), &[])?;
        Ok(OpenScenario { scenario: Arc::new(scenario), household: Arc::new(household), source: self.source.clone() })
    }

    /// The routines without these conditions.
    ///
    /// # Errors
    ///
    /// [`SimulationError::Problems`] if no routine shows one of them.
    pub fn household_without(&self, conditions: &[String]) -> Result<Arc<Household>, SimulationError> {
        if conditions.is_empty() {
            return Ok(self.household.clone());
        }
        Ok(Arc::new(self.household.without(conditions)?))
    }

    pub(crate) fn base(&self) -> Base<'_> {
        Base { scenario: &self.scenario, household: &self.household, files: self.source.files() }
    }
}

fn days(length: Span) -> i32 {
    i32::try_from((length + DAY - Span::MICROSECOND).div_euclid(DAY)).unwrap_or(i32::MAX)
}

/// A warning of the sentences of a routine that are not simulated.
fn unsimulated(routine: &Routine) -> Option<Problem> {
    /// Largest number of names that are quoted (our choice).
    const QUOTED: usize = 3;
    let first = routine.remarks.first()?;
    let sentences: Vec<String> = routine.remarks.iter().take(QUOTED).map(|remark| remark.text.to_string()).collect();
    let more = routine.remarks.len() - sentences.len();
    let (line, column) = (first.line, first.column);
    let message = ScenarioWarning::Unsimulated { sentences, more };
    Some(Problem { line, column, ..Problem::of_file(&routine.file, message, None) })
}

fn without_effect(difference: &Difference) -> Problem {
    let Difference { file, line, text, lived, .. } = difference;
    let message = ScenarioWarning::WithoutEffect { sentence: one_line(text), effect: lived.to_string() };
    Problem { line: *line, ..Problem::of_file(file, message, None) }
}

pub(crate) fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
