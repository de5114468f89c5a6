//! A scenario that was opened: checked, its routines understood, ready to be lived any number of times.

use crate::error::Error;
use crate::idle_sensors;
use crate::life_messages::LifeMessage;
use crate::lifeless;
use crate::profiles::{self, Base, Profile};
use crate::source::{Source, Template};
use homebody_core::numbers::{self, Number};
use homebody_core::problem::{Problem, Problems};
use homebody_core::scenario::ScenarioFile;
use homebody_core::scenario::load::Scenario;
use homebody_core::scenario::remarks;
use homebody_core::time::{DAY, Micros};
use homebody_routine::household::{self, Household};
use homebody_routine::living::account::Difference;
use homebody_routine::routine::Routine;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Opens a scenario by its folder or its `scenario.json`.
///
/// ```
/// let scenario = homebody_kit::open("../../scenarios/tigerplace")?;
/// assert_eq!(scenario.name(), "tigerplace");
/// # Ok::<(), homebody_kit::Error>(())
/// ```
///
/// # Errors
///
/// [`Error::Unreadable`] without such a folder, [`Error::Problems`] with all problems of its files.
pub fn open(path: impl AsRef<Path>) -> Result<OpenScenario, Error> {
    Source::at(path)?.open()
}

/// Opens a scenario that came with the program.
///
/// ```
/// let scenario = homebody_kit::template("older-adult")?;
/// assert!(homebody_kit::template("older adult").is_err());
/// # Ok::<(), homebody_kit::Error>(())
/// ```
///
/// # Errors
///
/// [`Error::Template`] if there is none of this name.
pub fn template(name: &str) -> Result<OpenScenario, Error> {
    Template::named(name)?.source().open()
}

/// All numbers of the models that a scenario may set, each with its unit and its range.
pub fn numbers() -> Vec<Number> {
    household::numbers()
}

/// A scenario that has passed every check, with the routines of those who live there understood. A clone is cheap.
#[derive(Clone)]
pub struct OpenScenario {
    pub(crate) scenario: Arc<Scenario>,
    pub(crate) household: Arc<Household>,
    pub(crate) source: Source,
}

impl Source {
    /// The scenario checked and its routines understood, to be lived.
    ///
    /// # Errors
    ///
    /// [`Error::Problems`]: everything that is wrong with its files; [`Error::File`] if the system could not read one.
    pub fn open(self) -> Result<OpenScenario, Error> {
        let loaded = Household::load(self.files(), self.entry(), &[]);
        let (scenario, household) = loaded.map_err(|problems| self.why(problems))?;
        Ok(OpenScenario { scenario: Arc::new(scenario), household: Arc::new(household), source: self })
    }
}

impl OpenScenario {
    /// What the scenario is called.
    pub fn name(&self) -> &str {
        &self.scenario.file.name
    }

    /// What its files say.
    pub fn scenario(&self) -> &Scenario {
        &self.scenario
    }

    /// Who lives by routines there, and whom they show.
    pub fn household(&self) -> &Household {
        &self.household
    }

    /// Its files as they were opened.
    pub fn source(&self) -> &Source {
        &self.source
    }

    /// The files on disk that it was opened from: a run never replaces one of them.
    pub fn paths(&self) -> Vec<PathBuf> {
        self.source.paths(&self.scenario)
    }

    /// What is right in it but hardly meant, in a run of `length` microseconds.
    pub fn remarks(&self, length: Micros) -> Vec<Problem> {
        let mut all = remarks::of(&self.scenario, length);
        all.extend(idle_sensors::remarks(&self.scenario, &self.household));
        all.extend(self.lifeless());
        all.extend(self.household.foretold(days(length)).iter().map(foretold));
        let routines = (0..self.scenario.residents.len()).filter_map(|resident| self.household.routine(resident));
        all.extend(routines.filter_map(not_lived));
        all
    }

    /// The remarks on what a life or a log lacks although the files are right, such as a home without sensors.
    pub fn lifeless(&self) -> Vec<Problem> {
        lifeless::remarks(&self.scenario)
    }

    /// The remarks on what the profiles of a list say besides, each combination of conditions and times once; `list` is what
    /// problems call the list.
    ///
    /// # Errors
    ///
    /// [`Error::Problems`] if a profile is not one of this scenario.
    pub fn remarks_on(&self, list: &str, profiles: &[Profile], length: Micros) -> Result<Vec<Problem>, Error> {
        let known = self.household.foretold(days(length));
        let (mut told, mut all) = (BTreeSet::new(), Vec::new());
        for profile in profiles {
            let says = ["conditions", "severity", "onset", "over", "until", "routine", "home"]
                .map(|column| profile.row.get(column));
            if !told.insert(says) {
                continue;
            }
            let (_, household) = self.base().lived(profile)?;
            let own = household.foretold(days(length)).into_iter();
            all.extend(own.filter(|one| known.iter().all(|known| known.text != one.text)).map(|one| {
                let (sentence, effect) = (one_line(&one.text), one.lived);
                let message = LifeMessage::MemberWithoutEffect { member: profile.name.clone(), sentence, effect };
                Problem::of_file(list, message, None)
            }));
        }
        Ok(all)
    }

    /// The members of a list: a CSV file with a row for each. The conditions in `without` are left out of the lives of those
    /// who would show them.
    ///
    /// # Errors
    ///
    /// [`Error::File`] or [`Error::Unreadable`] if it cannot be read, [`Error::Problems`] with everything that is wrong in it.
    pub fn profiles(&self, path: impl AsRef<Path>, without: &[String]) -> Result<Vec<Profile>, Error> {
        profiles::read(path.as_ref(), &self.base(), without)
    }

    /// The members of a list in memory: a table in CSV, whose first line names the columns; problems name it `name`.
    ///
    /// ```
    /// let scenario = homebody_kit::template("older-adult")?;
    /// let profiles = scenario.profiles_of("people.csv", "name,age\nanna,75\nbea,88\n", &[])?;
    /// assert_eq!(profiles.len(), 2);
    /// # Ok::<(), homebody_kit::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`Error::Problems`] with everything that is wrong in it.
    pub fn profiles_of(&self, name: &str, table: &str, without: &[String]) -> Result<Vec<Profile>, Error> {
        profiles::of(name, table, &self.base(), without)
    }

    /// The same scenario with these numbers of its models set, by name, whatever it sets itself. What is recorded of its runs
    /// has them in the text of the scenario's own file.
    ///
    /// ```
    /// let scenario = homebody_kit::template("older-adult")?;
    /// let slower = scenario.with_numbers([("gait.fastest", 0.8)])?;
    /// assert_eq!(slower.scenario().file.numbers["gait.fastest"], 0.8);
    /// assert!(scenario.with_numbers([("gait.fastst", 0.8)]).is_err());
    /// # Ok::<(), homebody_kit::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`Error::Problems`] with every number that there is none of or that cannot be set to that, or if nobody can live there
    /// with them.
    pub fn with_numbers(&self, set: impl IntoIterator<Item = (impl Into<String>, f64)>) -> Result<OpenScenario, Error> {
        let set: BTreeMap<String, f64> = set.into_iter().map(|(name, value)| (name.into(), value)).collect();
        if set.is_empty() {
            return Ok(self.clone());
        }
        let known = numbers();
        let wrong = set.iter().filter_map(|(name, &value)| numbers::wrong(&known, name, value));
        let problem = |message| Problem::of_file(self.name(), message, None);
        let problems: Vec<Problem> = wrong.map(problem).collect();
        if !problems.is_empty() {
            return Err(Error::Problems(Problems(problems)));
        }
        self.with_file(|file| file.numbers.extend(set))
    }

    /// The same scenario, begun at another date and time on the clock of the home, such as `2026-11-01T08:00:00`.
    ///
    /// ```
    /// let scenario = homebody_kit::template("studio")?.starting("2026-11-01T08:00:00")?;
    /// assert_eq!(scenario.scenario().calendar.wall_clock(0), "2026-11-01 08:00:00");
    /// # Ok::<(), homebody_kit::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`Error::Problems`] if there is no such date and time.
    pub fn starting(&self, start: impl Into<String>) -> Result<OpenScenario, Error> {
        let start = start.into();
        self.with_file(|file| file.start = start)
    }

    /// The same scenario with its own file changed. What is recorded of its runs has the change.
    fn with_file(&self, change: impl FnOnce(&mut ScenarioFile)) -> Result<OpenScenario, Error> {
        let edit = self.scenario.edit().file(change);
        let (scenario, household) = Household::load(&edit.over(self.source.files()), self.source.entry(), &[])?;
        Ok(OpenScenario { scenario: Arc::new(scenario), household: Arc::new(household), source: self.source.clone() })
    }

    /// The same scenario without these conditions, which its routines show.
    ///
    /// # Errors
    ///
    /// [`Error::Problems`] if nobody shows one of them.
    pub(crate) fn household_without(&self, conditions: &[String]) -> Result<Arc<Household>, Error> {
        if conditions.is_empty() {
            return Ok(self.household.clone());
        }
        Ok(Arc::new(self.household.without(conditions)?))
    }

    pub(crate) fn base(&self) -> Base<'_> {
        Base { scenario: &self.scenario, household: &self.household, files: self.source.files() }
    }
}

/// In how many days a run is lived, the last of them perhaps in part.
fn days(length: Micros) -> i32 {
    i32::try_from((length + DAY - 1).div_euclid(DAY)).unwrap_or(i32::MAX)
}

/// What a routine says beside what is lived, in one remark.
fn not_lived(routine: &Routine) -> Option<Problem> {
    /// Largest number of names that are quoted (our choice).
    const QUOTED: usize = 3;
    let first = routine.remarks.first()?;
    let sentences: Vec<String> = routine.remarks.iter().take(QUOTED).map(|remark| remark.text.to_string()).collect();
    let more = routine.remarks.len() - sentences.len();
    let (line, column) = (first.line, first.column);
    let message = LifeMessage::Unsimulated { sentences, more };
    Some(Problem { line, column, ..Problem::of_file(&routine.file, message, None) })
}

/// What can be told of a sentence before the run.
fn foretold(told: &Difference) -> Problem {
    let Difference { file, line, text, lived, .. } = told;
    let message = LifeMessage::WithoutEffect { sentence: one_line(text), effect: lived.to_string() };
    Problem { line: *line, ..Problem::of_file(file, message, None) }
}

/// A sentence with single blanks.
fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
