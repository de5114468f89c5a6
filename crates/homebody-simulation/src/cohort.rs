//! Cohorts: many runs of one scenario, on all processors.

pub(crate) mod incomplete;
pub(crate) mod list;
pub(crate) mod members;
pub(crate) mod place;
mod remains;

use crate::cohort::list::{AskedMembers, CohortFile, CohortList, ListedMember};
use crate::cohort::members::{CohortLayout, Member, MemberSummary, Members};
use crate::cohort::place::CohortPlace;
use crate::error::SimulationError;
use crate::limits::{LARGE_DAYS, MOST_MEMBERS};
use crate::open_scenario::OpenScenario;
use crate::pace::{Pace, PaceKeeper};
use crate::profiles::Profile;
use crate::progress::RunProgress;
use crate::recording_file::{has_its_scenario, must_be_of_this_version};
use crate::scenario_source::ScenarioSource;
use crate::setup::{PlannedRun, RunSetup};
use crate::simulation::Simulation;
use homebody_core::problem::readable;
use homebody_core::recording::Recording;
use homebody_core::run::Run;
use homebody_core::scenario::load::Scenario;
use homebody_core::time::{DAY, RunTime, Span};
use homebody_log::destination::Treatment;
use homebody_log::files::fresh::remove_parts;
use homebody_log::files::lock::FolderLock;
use homebody_log::run::places::LIST;
use homebody_log::table::truth::TruthKept;
use homebody_log::{Cancel, RunPlaces, WriteMode};
use homebody_routine::household::Household;
use rayon::prelude::*;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicI64, Ordering};
use std::time::{Duration, Instant};

/// The word for a cohort in errors.
pub(crate) const COHORT: &str = "cohort";

/// Threads for each processor (our choice).
const THREADS_EACH: usize = 4;

/// The options of a cohort, made by [`OpenScenario::cohort`] or [`OpenScenario::cohort_of`]. An option that is not set is as the
/// scenario says.
///
/// ```
/// let scenario = homebody_simulation::template("older-adult")?;
/// let firings = scenario.cohort(3).seed(7).days(1).start()?.run_each(|member, mut run| {
///     let mut firings = 0;
///     while let Some(batch) = run.next_batch()? {
///         firings += batch.firings.len();
///     }
///     Ok::<_, homebody_simulation::SimulationError>((member.name.clone(), firings))
/// })?;
/// assert_eq!(firings.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>(), ["0001", "0002", "0003"]);
/// # Ok::<(), homebody_simulation::SimulationError>(())
/// ```
pub struct CohortSetup {
    run: RunSetup,
    members: Members,
    layout: CohortLayout,
    kept: Option<TruthKept>,
}

/// The result of a cohort that was stored.
#[derive(Clone, Debug)]
pub struct CohortSummary {
    /// The folder that holds a folder for each member.
    pub folder: PathBuf,
    /// The list in the file [`LIST`] of the folder.
    pub list: CohortList,
    /// The number of members asked for: more than are listed if it was cancelled.
    pub asked: usize,
    /// The number of listed members that ended early, as it was cancelled.
    pub ended_early: usize,
    /// The number of listed members that were complete before: 0 unless the cohort was resumed.
    pub found: usize,
    /// The time that was simulated now, without the members that were complete before.
    pub done: Span,
    /// The time that the simulation took.
    pub took: Duration,
}

impl CohortSummary {
    /// True of a cohort with a member that was not started, or not simulated to its end.
    pub fn is_stopped(&self) -> bool {
        self.list.members.len() < self.asked || self.ended_early > 0
    }
}

/// The time of a cohort that is simulated already.
pub(crate) fn done_before(found: &[Option<MemberSummary>]) -> Span {
    found.iter().flatten().map(|member| member.length).sum()
}

impl OpenScenario {
    /// A cohort with this number of members, who differ from the routines as people differ.
    pub fn cohort(&self, members: u32) -> CohortSetup {
        self.run().cohort(members)
    }

    /// A cohort of the members of a list.
    pub fn cohort_of(&self, profiles: Vec<Profile>) -> CohortSetup {
        self.run().cohort_of(profiles)
    }
}

impl RunSetup {
    /// A cohort with this number of members, who differ from the routines as people differ.
    pub fn cohort(self, members: u32) -> CohortSetup {
        CohortSetup::new(self, Members::Many(members))
    }

    /// A cohort of the members of a list, whose profiles already leave out their conditions.
    pub fn cohort_of(self, profiles: Vec<Profile>) -> CohortSetup {
        CohortSetup::new(self, Members::Listed(profiles))
    }
}

impl CohortSetup {
    fn new(run: RunSetup, members: Members) -> CohortSetup {
        CohortSetup { run: run.one_of_many(), members, layout: CohortLayout::default(), kept: None }
    }

    /// Sets the seed of all randomness.
    pub fn seed(self, seed: u64) -> CohortSetup {
        CohortSetup { run: self.run.seed(seed), ..self }
    }

    /// Sets the length of each run in days of the home's time zone.
    pub fn days(self, days: impl Into<f64>) -> CohortSetup {
        CohortSetup { run: self.run.days(days), ..self }
    }

    /// Sets a parameter of the models for all members; [`numbers`](crate::numbers) lists all. Each recording has it in the
    /// scenario's own file.
    pub fn number(self, name: impl Into<String>, value: f64) -> CohortSetup {
        CohortSetup { run: self.run.number(name, value), ..self }
    }

    /// Sets the layout of the folder.
    pub fn layout(mut self, layout: CohortLayout) -> CohortSetup {
        self.layout = layout;
        self
    }

    /// Sets how much of each ground truth is kept: by default all of it, unless the cohort has more than [`LARGE_DAYS`] days.
    pub fn truth(mut self, kept: TruthKept) -> CohortSetup {
        self.kept = Some(kept);
        self
    }

    /// Ends the cohort early when this handle is cancelled.
    pub fn cancel(self, cancel: &Cancel) -> CohortSetup {
        CohortSetup { run: self.run.cancel(cancel), ..self }
    }

    /// The cohort at its start.
    ///
    /// # Errors
    ///
    /// [`SimulationError::Problems`] if no routine shows a condition that is to be left out, or a parameter is out of range;
    /// [`SimulationError::Length`] or [`SimulationError::Members`] if the length or the number of members is out of range.
    pub fn start(mut self) -> Result<Cohort, SimulationError> {
        if let Members::Many(count) = self.members
            && !(1..=MOST_MEMBERS).contains(&count)
        {
            return Err(SimulationError::Members { count });
        }
        let without = match self.members {
            Members::Many(_) => Vec::new(),
            Members::Listed(_) => std::mem::take(&mut self.run.options.variant.without),
        };
        let PlannedRun { scenario, household, mut recording } = self.run.plan()?;
        recording.without.extend(without);
        let CohortSetup { run: RunSetup { cancel, .. }, members, layout, kept } = self;
        let is_large = recording.length_us.saturating_mul(members.count() as i64) > LARGE_DAYS * DAY;
        let kept = kept.unwrap_or(if is_large { TruthKept::Brief } else { TruthKept::All });
        Ok(Cohort { scenario, household, members, recording, layout, kept, cancel })
    }
}

/// Many runs of one scenario. The run of a member depends on the cohort's seed and on the member's number or name, and not on the
/// other members.
pub struct Cohort {
    pub(crate) scenario: OpenScenario,
    household: Arc<Household>,
    pub(crate) members: Members,
    /// The shared part of the members' recordings.
    pub(crate) recording: Recording,
    pub(crate) layout: CohortLayout,
    pub(crate) kept: TruthKept,
    pub(crate) cancel: Cancel,
}

impl Cohort {
    /// The number of members.
    pub fn count(&self) -> usize {
        self.members.count()
    }

    /// Returns a small cohort with the first days of its first members.
    pub fn beginning(&self, most_members: usize, length: Span) -> Cohort {
        let members = self.members.first(most_members);
        let recording = Recording { length_us: length.min(self.recording.length_us), ..self.recording.clone() };
        let (scenario, household, cancel) = (self.scenario.clone(), self.household.clone(), self.cancel.clone());
        Cohort { scenario, household, members, recording, layout: self.layout, kept: self.kept, cancel }
    }

    /// The kept part of each ground truth.
    pub fn kept(&self) -> TruthKept {
        self.kept
    }

    /// The progress at the start: the length is that of all runs together.
    pub fn progress(&self) -> RunProgress {
        RunProgress { done: Span::ZERO, length: self.recording.length_us.saturating_mul(self.count() as i64) }
    }

    /// The cohort of a folder, and the number of members in its list.
    ///
    /// # Errors
    ///
    /// As [`crate::IncompleteCohort::open`], but for [`SimulationError::Complete`] and [`SimulationError::Member`].
    pub fn in_folder(folder: &Path) -> Result<(Cohort, usize), SimulationError> {
        let (text, path) = (CohortPlace::from_path(folder)?.list()?, folder.join(LIST));
        let wrong = |error: serde_json::Error| SimulationError::Recording {
            path: path.clone(),
            why: readable(error.to_string()),
        };
        let CohortFile { list, form, truth, asked, recording } = serde_json::from_str(&text).map_err(wrong)?;
        let layout = CohortLayout::named(form.as_deref()).ok_or_else(|| SimulationError::Recording {
            path: path.clone(),
            why: format!("members have no form {}", form.unwrap_or_default()),
        })?;
        must_be_of_this_version(COHORT, folder, &recording)?;
        has_its_scenario(&path, &recording)?;
        let scenario = ScenarioSource::from_texts(recording.files, recording.entry).open()?;
        let members = match asked {
            AskedMembers::Residents(count @ 1..=MOST_MEMBERS) => Members::Many(count),
            AskedMembers::Residents(count) => {
                let why = format!("{count} residents are none, or more than {MOST_MEMBERS}");
                return Err(SimulationError::Recording { path, why });
            }
            AskedMembers::Profiles(table) => {
                Members::Listed(scenario.profiles_from_table(LIST, &table, &recording.without)?)
            }
        };
        let run = scenario.run().seed(recording.seed).length(recording.length_us).without(recording.without);
        let setup = CohortSetup::new(run, members).layout(layout).truth(truth.into());
        Ok((setup.start()?, list.members.len()))
    }

    /// Writes the options of the cohort into a folder or below the URL of an object store, so that members can be simulated there one by
    /// one by [`Cohort::run_member`], on any machine. The folder is created if it does not exist; if it has this very cohort, nothing
    /// changes.
    ///
    /// # Errors
    ///
    /// [`SimulationError::Member`] if another cohort is there, [`SimulationError::NotEmpty`] if something else is there,
    /// [`SimulationError::Log`] if nothing can be written there.
    pub fn create(&self, folder: &Path) -> Result<(), SimulationError> {
        let place = CohortPlace::from_path(folder)?;
        place.create()?;
        if !place.has_list()? {
            place.must_be_empty()?;
            return self.write(&place, Vec::new(), WriteMode::Create).map(|_| ());
        }
        let (there, _) = Cohort::in_folder(folder)?;
        let asked = |cohort: &Cohort| serde_json::to_string(&cohort.members.asked()).unwrap_or_default();
        let storage = |cohort: &Cohort| (cohort.layout, cohort.kept);
        let is_same =
            there.recording == self.recording && storage(&there) == storage(self) && asked(&there) == asked(self);
        match is_same {
            true => Ok(()),
            false => {
                let why = format!("{}: another cohort was begun there", folder.join(LIST).display());
                Err(SimulationError::Member { folder: folder.into(), why })
            }
        }
    }

    /// Simulates one member, by index, into the folder of the cohort, unless it is complete there. Its files have the same bytes
    /// wherever it is simulated. `progress` gets the simulated time.
    ///
    /// # Errors
    ///
    /// [`SimulationError::Log`] if its files cannot be written, or another program is writing them.
    pub fn run_member(
        &self,
        folder: &Path,
        index: usize,
        progress: impl FnMut(Span),
    ) -> Result<MemberSummary, SimulationError> {
        let place = CohortPlace::from_path(folder)?;
        if let Some(found) = self.found(&place, index)? {
            return Ok(found);
        }
        let member = self.members.member(self.recording.seed, index);
        let run = self.run(&member, index)?;
        self.member_into(&place, &member, run, progress)
    }

    /// The name of a member, by index.
    pub fn name_of(&self, index: usize) -> String {
        self.members.member(self.recording.seed, index).name
    }

    /// Completes the list of a cohort whose members were simulated one by one.
    ///
    /// # Errors
    ///
    /// [`SimulationError::Log`] if it cannot be written.
    pub fn finish(&self, folder: &Path, members: Vec<MemberSummary>) -> Result<CohortList, SimulationError> {
        self.write(
            &CohortPlace::from_path(folder)?,
            members.into_iter().map(|member| member.listed).collect(),
            WriteMode::Overwrite,
        )
    }

    /// Gives the run of each member to a function, on all processors, and returns the results in the order of members; after a
    /// cancellation, those of the started members.
    ///
    /// # Errors
    ///
    /// The first error of the function or of making a member's run.
    pub fn run_each<T: Send, E: From<SimulationError> + Send>(
        &self,
        run: impl Fn(&Member, Simulation) -> Result<T, E> + Sync,
    ) -> Result<Vec<T>, E> {
        self.run_missing(|_| None, run)
    }

    /// As [`Cohort::run_each`], except for members whose results `found` has, by index.
    fn run_missing<T: Send, E: From<SimulationError> + Send>(
        &self,
        found: impl Fn(usize) -> Option<T> + Sync,
        run: impl Fn(&Member, Simulation) -> Result<T, E> + Sync,
    ) -> Result<Vec<T>, E> {
        // More threads than processors, because some wait for the disk.
        let threads = std::thread::available_parallelism().map_or(1, usize::from) * THREADS_EACH;
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let pool = pool.map_err(|error| SimulationError::Threads { why: error.to_string() })?;
        let one = |index| {
            if let Some(found) = found(index) {
                return Ok(Some(found));
            }
            if self.cancel.is_cancelled() {
                return Ok(None);
            }
            let member = self.members.member(self.recording.seed, index);
            let simulation = self.run(&member, index)?;
            run(&member, simulation).map(Some)
        };
        let results: Result<Vec<Option<T>>, E> = pool.install(|| (0..self.count()).into_par_iter().map(one).collect());
        Ok(results?.into_iter().flatten().collect())
    }

    /// Simulates all members into a new folder under `runs/`: each into a folder of its own, with a list of them. `progress` is
    /// called after each batch of any member, from several threads.
    ///
    /// # Errors
    ///
    /// As [`Cohort::run_each`], and [`SimulationError::Log`] if a file cannot be written.
    pub fn store(&self, progress: impl Fn(RunProgress) + Sync) -> Result<CohortSummary, SimulationError> {
        self.store_in(RunPlaces::cohort(&self.scenario.scenario)?, progress)
    }

    /// As [`Cohort::store`], into this folder, which is created if it does not exist, or below this URL of an object store, such as
    /// `s3://bucket/lives`, where each member appears as a whole.
    ///
    /// # Errors
    ///
    /// As [`Cohort::store`], and [`SimulationError::NotEmpty`] if something is there.
    pub fn store_in(
        &self,
        folder: impl Into<PathBuf>,
        progress: impl Fn(RunProgress) + Sync,
    ) -> Result<CohortSummary, SimulationError> {
        let place = CohortPlace::from_path(&folder.into())?;
        place.create()?;
        place.must_be_empty()?;
        self.write(&place, Vec::new(), WriteMode::Create)?;
        self.run_into(&place, vec![None; self.count()], progress)
    }

    /// Simulates the missing members, and then completes the list.
    pub(crate) fn run_into(
        &self,
        place: &CohortPlace,
        found: Vec<Option<MemberSummary>>,
        progress: impl Fn(RunProgress) + Sync,
    ) -> Result<CohortSummary, SimulationError> {
        let started = Instant::now();
        // A store has no locks: a member that is simulated twice there has the same bytes.
        let _lock = FolderLock::take(place.path())?;
        let RunProgress { length, .. } = self.progress();
        let before = done_before(&found);
        let in_all = AtomicI64::new(before.micros());
        let ended = self.run_missing(
            |index| found[index].clone(),
            |member, run| {
                let mut before = Span::ZERO;
                let member_progress = |done: Span| {
                    let more = done - std::mem::replace(&mut before, done);
                    let done = Span::from_micros(in_all.fetch_add(more.micros(), Ordering::Relaxed)) + more;
                    progress(RunProgress { done, length });
                };
                self.member_into(place, member, run, member_progress)
            },
        )?;
        let ended_early = ended.iter().filter(|member| member.is_early).count();
        let list = self.write(place, ended.into_iter().map(|member| member.listed).collect(), WriteMode::Overwrite)?;
        Ok(CohortSummary {
            folder: place.path().into(),
            list,
            asked: self.count(),
            ended_early,
            found: found.iter().flatten().count(),
            done: Span::from_micros(in_all.into_inner()) - before,
            took: started.elapsed(),
        })
    }

    /// Simulates the missing part of one member; `progress` gets the simulated time.
    fn member_into(
        &self,
        place: &CohortPlace,
        member: &Member,
        run: Simulation,
        mut progress: impl FnMut(Span),
    ) -> Result<MemberSummary, SimulationError> {
        let here = place.here()?;
        let places = self.layout.places(here.path(), &member.name, &run.scenario, self.kept)?;
        let recorded = self.layout.recording(here.path(), &member.name);
        let how = if recorded.exists() { WriteMode::Resume } else { WriteMode::Create };
        if how == WriteMode::Create {
            // A program that was killed while it wrote it has left a part.
            remove_parts(&recorded)?;
        }
        let files = places.files();
        let treatment = Treatment::default();
        let summary = run.store_into(places, Vec::new(), &treatment, how, |all| progress(all.done))?;
        let ended = self.ended(here.path(), member, &summary.recording)?;
        place.send(&here, files)?;
        Ok(ended)
    }

    fn write(
        &self,
        place: &CohortPlace,
        members: Vec<ListedMember>,
        how: WriteMode,
    ) -> Result<CohortList, SimulationError> {
        let (mut recording, asked) = (self.recording.clone(), self.members.asked());
        if let Members::Listed(profiles) = &self.members {
            // The scenario's own stay as they are simulated: parameters may be set in them.
            for (name, text) in profiles.iter().flat_map(|profile| profile.texts()) {
                recording.files.entry(name.clone()).or_insert_with(|| text.clone());
            }
            let without: BTreeSet<&String> = profiles.iter().flat_map(|profile| &profile.without).collect();
            recording.without = without.into_iter().cloned().collect();
        }
        let list = CohortList {
            scenario: self.scenario.name().to_owned(),
            seed: self.recording.seed,
            days: self.scenario.scenario.calendar.days_lived(RunTime::START + self.recording.length_us),
            members,
        };
        let file = CohortFile { list, form: self.layout.form(), truth: self.kept.into(), asked, recording };
        let text = serde_json::to_string_pretty(&file);
        let text = text.map_err(|error| SimulationError::file(&place.path().join(LIST), error.to_string()))?;
        place.write_list(text + "\n", how)?;
        Ok(file.list)
    }

    fn run(&self, member: &Member, index: usize) -> Result<Simulation, SimulationError> {
        let recording = self.recording_of(member);
        match &self.members {
            Members::Many(_) => Ok(self.simulation(self.scenario.scenario.clone(), &self.household, recording)),
            Members::Listed(profiles) => {
                let (scenario, household) = self.scenario.base().of_member(&profiles[index])?;
                let (files, without) = (scenario.sources.clone(), profiles[index].without.clone());
                let recording = Recording { files, without, ..recording };
                Ok(self.simulation(Arc::new(scenario), &household, recording))
            }
        }
    }

    fn simulation(&self, scenario: Arc<Scenario>, household: &Household, recording: Recording) -> Simulation {
        let run = Run::new(&scenario, household, recording.seed, recording.length_us);
        let paced = PaceKeeper::new(Pace::default(), self.cancel.clone(), None);
        Simulation::from_parts(scenario, run, recording, self.scenario.paths()).paced(paced)
    }
}
