//! Cohorts: many lives of one scenario side by side, on all processors.

use crate::VERSION;
use crate::cohort_list::{Asked, CohortFile, CohortList, ListedMember};
use crate::cohort_members::{CohortLayout, Member, MemberLived, Members};
use crate::cohort_place::CohortPlace;
use crate::error::Error;
use crate::pace::{Pace, Paced};
use crate::profiles::{MOST_MEMBERS, Profile};
use crate::recorded;
use crate::recording_file;
use crate::run::{Length, LiveRun, Progress};
use crate::scenario::OpenScenario;
use crate::source::Source;
use homebody_core::problem::readable;
use homebody_core::recording::Recording;
use homebody_core::run::Run;
use homebody_core::scenario::load::Scenario;
use homebody_core::time::{DAY, Micros};
use homebody_log::destination::Treatment;
use homebody_log::fresh::remove_parts;
use homebody_log::lock::FolderLock;
use homebody_log::places::LIST;
use homebody_log::truth::TruthKept;
use homebody_log::{Cancel, How, Places};
use homebody_routine::household::Household;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicI64, Ordering};
use std::time::{Duration, Instant};

/// What errors call a cohort.
pub(crate) const COHORT: &str = "cohort";

/// Days of all members together above which a cohort is large (our choice): a database needs about a megabyte a day. By
/// default, only the brief tables of its truths are written.
pub const LARGE_DAYS: Micros = 10_000;

/// Threads for each processor (our choice).
const THREADS_EACH: usize = 4;

/// What a cohort is to be; made by [`OpenScenario::cohort`] or [`OpenScenario::cohort_of`]. What is not asked for is as the
/// scenario says.
///
/// ```
/// let scenario = homebody_kit::template("older-adult")?;
/// let firings = scenario.cohort(3).seed(7).days(1).start()?.live(|member, mut run| {
///     let mut firings = 0;
///     while let Some(batch) = run.next_batch()? {
///         firings += batch.firings.len();
///     }
///     Ok::<_, homebody_kit::Error>((member.name.clone(), firings))
/// })?;
/// assert_eq!(firings.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>(), ["0001", "0002", "0003"]);
/// # Ok::<(), homebody_kit::Error>(())
/// ```
pub struct CohortSetup {
    scenario: OpenScenario,
    members: Members,
    seed: Option<u64>,
    length: Length,
    without: Vec<String>,
    numbers: BTreeMap<String, f64>,
    layout: CohortLayout,
    kept: Option<TruthKept>,
    cancel: Cancel,
}

/// A cohort that was lived into a folder.
#[derive(Clone, Debug)]
pub struct LivedCohort {
    /// The folder that holds a folder for each member.
    pub folder: PathBuf,
    /// What is in the file [`LIST`] in there.
    pub list: CohortList,
    /// How many members there were to be: more than are listed if it was cancelled.
    pub asked: usize,
    /// How many of those who are listed ended early, as it was cancelled.
    pub ended_early: usize,
    /// How many of those who are listed were complete before this program began: 0 unless the cohort was gone on with.
    pub found: usize,
    /// How much was lived by this program, in microseconds: not what those had lived who were complete before.
    pub lived: Micros,
    /// How long that took.
    pub took: Duration,
}

impl LivedCohort {
    /// Whether it was ended early: somebody was not begun, or not lived to the end.
    pub fn is_stopped(&self) -> bool {
        self.list.members.len() < self.asked || self.ended_early > 0
    }
}

/// How much of a cohort was lived before, in microseconds.
pub(crate) fn lived_before(found: &[Option<MemberLived>]) -> Micros {
    found.iter().flatten().map(|member| member.length).sum()
}

impl OpenScenario {
    /// So many lives of it side by side, each of which differs from the routines as people differ.
    pub fn cohort(&self, members: u32) -> CohortSetup {
        CohortSetup::new(self.clone(), Members::Many(members))
    }

    /// The lives of the members of a list side by side.
    pub fn cohort_of(&self, profiles: Vec<Profile>) -> CohortSetup {
        CohortSetup::new(self.clone(), Members::Listed(profiles))
    }
}

impl CohortSetup {
    fn new(scenario: OpenScenario, members: Members) -> CohortSetup {
        let (seed, length, without, numbers) = (None, Length::Own, Vec::new(), BTreeMap::new());
        let (layout, kept, cancel) = (CohortLayout::default(), None, Cancel::new());
        CohortSetup { scenario, members, seed, length, without, numbers, layout, kept, cancel }
    }

    /// The number all randomness comes from.
    pub fn seed(mut self, seed: u64) -> CohortSetup {
        self.seed = Some(seed);
        self
    }

    /// How many days of the home's own time each lives.
    pub fn days(mut self, days: impl Into<f64>) -> CohortSetup {
        self.length = Length::Days(days.into());
        self
    }

    /// How long each lives, in microseconds.
    pub fn length(mut self, length: Micros) -> CohortSetup {
        self.length = Length::Span(length);
        self
    }

    /// Conditions that the routines show and nobody of this cohort does; of members of a list, the list knows that.
    pub fn without(mut self, conditions: impl IntoIterator<Item = impl Into<String>>) -> CohortSetup {
        self.without.extend(conditions.into_iter().map(Into::into));
        self
    }

    /// A number of the models is otherwise for all of them than it is, or than the scenario says; [`numbers`](crate::numbers)
    /// knows all. It is in each recording, with the scenario's own file.
    pub fn number(mut self, name: impl Into<String>, value: f64) -> CohortSetup {
        self.numbers.insert(name.into(), value);
        self
    }

    /// How its members lie in its folder.
    pub fn layout(mut self, layout: CohortLayout) -> CohortSetup {
        self.layout = layout;
        self
    }

    /// How much of each truth is kept: all of it, unless the cohort lives more than [`LARGE_DAYS`] together.
    pub fn truth(mut self, kept: TruthKept) -> CohortSetup {
        self.kept = Some(kept);
        self
    }

    /// Nobody else is begun, and those who are lived end early, once this handle says so.
    pub fn cancel(mut self, cancel: &Cancel) -> CohortSetup {
        self.cancel = cancel.clone();
        self
    }

    /// The cohort, of which nobody has been lived yet.
    ///
    /// # Errors
    ///
    /// [`Error::Problems`] if nobody shows a condition that is to be left out, or a number cannot be set like that,
    /// [`Error::Length`] if a life can not be this long, [`Error::Members`] if nobody is to live, or too many are.
    pub fn start(mut self) -> Result<Cohort, Error> {
        if let Members::Many(count) = self.members
            && !(1..=MOST_MEMBERS).contains(&count)
        {
            return Err(Error::Members { count });
        }
        let opened = self.scenario.with_numbers(std::mem::take(&mut self.numbers))?;
        let OpenScenario { scenario, source, .. } = &opened;
        let household = match self.members {
            Members::Many(_) => opened.household_without(&self.without)?,
            Members::Listed(_) => opened.household.clone(),
        };
        let (seed, length) = (self.seed.unwrap_or(scenario.file.seed), self.length.of(scenario)?);
        let recording = Recording::of(scenario, VERSION, source.entry(), seed, length);
        let recording = Recording { without: std::mem::take(&mut self.without), one_of_many: true, ..recording };
        let household = household.one_of_many();
        let CohortSetup { members, layout, kept, cancel, .. } = self;
        let is_large = length.saturating_mul(members.count() as Micros) > LARGE_DAYS * DAY;
        let kept = kept.unwrap_or(if is_large { TruthKept::Brief } else { TruthKept::All });
        Ok(Cohort { scenario: opened, household, members, recording, layout, kept, cancel })
    }
}

/// Many lives of one scenario, to be lived side by side. A member's life depends on the cohort's seed and on their own number or
/// name, and not on who else is in it.
pub struct Cohort {
    pub(crate) scenario: OpenScenario,
    household: Household,
    pub(crate) members: Members,
    /// What is recorded of each member, but for what is their own.
    pub(crate) recording: Recording,
    pub(crate) layout: CohortLayout,
    pub(crate) kept: TruthKept,
    pub(crate) cancel: Cancel,
}

impl Cohort {
    /// How many members there are.
    pub fn count(&self) -> usize {
        self.members.count()
    }

    /// Returns a small cohort with the first days of its first members.
    pub fn beginning(&self, most_members: usize, length: Micros) -> Cohort {
        let members = self.members.first(most_members);
        let recording = Recording { length_us: length.min(self.recording.length_us), ..self.recording.clone() };
        let (scenario, household, cancel) = (self.scenario.clone(), self.household.clone(), self.cancel.clone());
        Cohort { scenario, household, members, recording, layout: self.layout, kept: self.kept, cancel }
    }

    /// How much of each truth is kept.
    pub fn kept(&self) -> TruthKept {
        self.kept
    }

    /// How far it has come before anybody has lived: the length is that of all lives together.
    pub fn progress(&self) -> Progress {
        Progress { lived: 0, length: self.recording.length_us.saturating_mul(self.count() as Micros) }
    }

    /// The cohort that is being lived in a folder, or was, and how many of its members its list has.
    ///
    /// # Errors
    ///
    /// As [`crate::UnfinishedCohort::open`], but for [`Error::Complete`] and [`Error::Member`].
    pub fn left_in(folder: &Path) -> Result<(Cohort, usize), Error> {
        let (text, path) = (CohortPlace::of(folder)?.list()?, folder.join(LIST));
        let wrong =
            |error: serde_json::Error| Error::Recording { path: path.clone(), why: readable(error.to_string()) };
        let CohortFile { list, form, truth, asked, recording } = serde_json::from_str(&text).map_err(wrong)?;
        let layout = CohortLayout::named(form.as_deref()).ok_or_else(|| Error::Recording {
            path: path.clone(),
            why: format!("members have no form {}", form.unwrap_or_default()),
        })?;
        recorded::must_be_of_this_version(COHORT, folder, &recording)?;
        recording_file::has_its_scenario(&path, &recording)?;
        let scenario = Source::of_texts(recording.files, recording.entry).open()?;
        let members = match asked {
            Asked::Residents(count @ 1..=MOST_MEMBERS) => Members::Many(count),
            Asked::Residents(count) => {
                let why = format!("{count} residents are none, or more than {MOST_MEMBERS}");
                return Err(Error::Recording { path, why });
            }
            Asked::Profiles(table) => Members::Listed(scenario.profiles_of(LIST, &table, &recording.without)?),
        };
        let setup = CohortSetup::new(scenario, members).seed(recording.seed).length(recording.length_us);
        let setup = setup.layout(layout).truth(truth.into()).without(recording.without);
        Ok((setup.start()?, list.members.len()))
    }

    /// Writes down in a folder, or below the URL of an object store, what the cohort is to be, so that its members can be lived there
    /// one by one, wherever that is, by [`Cohort::live_one`]. A folder is made if it is not there; if this very cohort was begun in it,
    /// nothing is changed.
    ///
    /// # Errors
    ///
    /// [`Error::Member`] if another cohort was begun there, [`Error::NotEmpty`] if something else is there, [`Error::Log`] if
    /// nothing can be written there.
    pub fn begin(&self, folder: &Path) -> Result<(), Error> {
        let place = CohortPlace::of(folder)?;
        place.make()?;
        if !place.has_list()? {
            place.must_be_empty()?;
            return self.write(&place, Vec::new(), How::New).map(|_| ());
        }
        let (there, _) = Cohort::left_in(folder)?;
        let asked = |cohort: &Cohort| serde_json::to_string(&cohort.members.asked()).unwrap_or_default();
        let lies_as = |cohort: &Cohort| (cohort.layout, cohort.kept);
        let is_same =
            there.recording == self.recording && lies_as(&there) == lies_as(self) && asked(&there) == asked(self);
        match is_same {
            true => Ok(()),
            false => {
                let why = format!("{}: another cohort was begun there", folder.join(LIST).display());
                Err(Error::Member { folder: folder.into(), why })
            }
        }
    }

    /// Lives one member, by index, into a folder in which the cohort was begun; who was lived to the end there is not lived again.
    /// What it leaves are the same bytes, whoever lives it. `progress` is told how much was lived, in microseconds.
    ///
    /// # Errors
    ///
    /// [`Error::Log`] if its files cannot be written, or somebody else is writing them.
    pub fn live_one(&self, folder: &Path, index: usize, progress: impl FnMut(Micros)) -> Result<MemberLived, Error> {
        let place = CohortPlace::of(folder)?;
        if let Some(found) = self.found(&place, index)? {
            return Ok(found);
        }
        let member = self.members.who(self.recording.seed, index);
        let run = self.run(&member, index)?;
        self.member_into(&place, &member, run, progress)
    }

    /// The name of a member, by index.
    pub fn name_of(&self, index: usize) -> String {
        self.members.who(self.recording.seed, index).name
    }

    /// Completes the list of a cohort whose members have been lived one by one.
    ///
    /// # Errors
    ///
    /// [`Error::Log`] if it cannot be written.
    pub fn end(&self, folder: &Path, lived: Vec<MemberLived>) -> Result<CohortList, Error> {
        self.write(&CohortPlace::of(folder)?, lived.into_iter().map(|member| member.listed).collect(), How::Replace)
    }

    /// Gives the run of each member to a function, on all processors, and returns what it makes of them in the order of
    /// members; of those who were begun, if the cohort is cancelled.
    ///
    /// # Errors
    ///
    /// The first error of the function or of making a member's run.
    pub fn live<T: Send, E: From<Error> + Send>(
        &self,
        live: impl Fn(&Member, LiveRun) -> Result<T, E> + Sync,
    ) -> Result<Vec<T>, E> {
        self.live_but(|_| None, live)
    }

    /// The same, but `found` may have the result of a member already, by index: that member is not lived, and no home is made.
    fn live_but<T: Send, E: From<Error> + Send>(
        &self,
        found: impl Fn(usize) -> Option<T> + Sync,
        live: impl Fn(&Member, LiveRun) -> Result<T, E> + Sync,
    ) -> Result<Vec<T>, E> {
        // More threads than processors: who waits for the disk lets others go on.
        let threads = std::thread::available_parallelism().map_or(1, usize::from) * THREADS_EACH;
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let pool = pool.map_err(|error| Error::Threads { why: error.to_string() })?;
        let one = |index| {
            if let Some(found) = found(index) {
                return Ok(Some(found));
            }
            if self.cancel.is_cancelled() {
                return Ok(None);
            }
            let member = self.members.who(self.recording.seed, index);
            let run = self.run(&member, index)?;
            live(&member, run).map(Some)
        };
        let lived: Result<Vec<Option<T>>, E> = pool.install(|| (0..self.count()).into_par_iter().map(one).collect());
        Ok(lived?.into_iter().flatten().collect())
    }

    /// Lives all members into a new folder under `runs/`: each in a folder of its own, with a list of them beside. `progress` is
    /// called after each batch of anybody's, from several threads.
    ///
    /// # Errors
    ///
    /// As [`Cohort::live`], and [`Error::Log`] if a file cannot be written.
    pub fn store(&self, progress: impl Fn(Progress) + Sync) -> Result<LivedCohort, Error> {
        self.store_in(Places::cohort(&self.scenario.scenario)?, progress)
    }

    /// As [`Cohort::store`], into this folder, which is made if it is not there, or below this URL of an object store, such as
    /// `s3://bucket/lives`, where each member comes as a whole.
    ///
    /// # Errors
    ///
    /// As [`Cohort::store`], and [`Error::NotEmpty`] if something is there.
    pub fn store_in(
        &self,
        folder: impl Into<PathBuf>,
        progress: impl Fn(Progress) + Sync,
    ) -> Result<LivedCohort, Error> {
        let place = CohortPlace::of(&folder.into())?;
        place.make()?;
        place.must_be_empty()?;
        self.write(&place, Vec::new(), How::New)?;
        self.live_into(&place, vec![None; self.count()], progress)
    }

    /// Lives what is not there yet of the members, and then completes their list.
    pub(crate) fn live_into(
        &self,
        place: &CohortPlace,
        found: Vec<Option<MemberLived>>,
        progress: impl Fn(Progress) + Sync,
    ) -> Result<LivedCohort, Error> {
        let started = Instant::now();
        // A store has no locks: who lives a member twice there leaves the same bytes.
        let _lock = FolderLock::take(place.path())?;
        let Progress { length, .. } = self.progress();
        let before = lived_before(&found);
        let in_all = AtomicI64::new(before);
        let ended = self.live_but(
            |index| found[index].clone(),
            |member, run| {
                let mut before = 0;
                let lived_on = |lived| {
                    let more = lived - std::mem::replace(&mut before, lived);
                    let lived = in_all.fetch_add(more, Ordering::Relaxed) + more;
                    progress(Progress { lived, length });
                };
                self.member_into(place, member, run, lived_on)
            },
        )?;
        let ended_early = ended.iter().filter(|member| member.is_early).count();
        let list = self.write(place, ended.into_iter().map(|member| member.listed).collect(), How::Replace)?;
        Ok(LivedCohort {
            folder: place.path().into(),
            list,
            asked: self.count(),
            ended_early,
            found: found.iter().flatten().count(),
            lived: in_all.into_inner() - before,
            took: started.elapsed(),
        })
    }

    /// Lives what is not there yet of one member; `lived_on` is told how far it has come.
    fn member_into(
        &self,
        place: &CohortPlace,
        member: &Member,
        run: LiveRun,
        mut lived_on: impl FnMut(Micros),
    ) -> Result<MemberLived, Error> {
        let here = place.here()?;
        let places = self.layout.places(here.path(), &member.name, &run.scenario, self.kept)?;
        let recorded = self.layout.recording(here.path(), &member.name);
        let how = if recorded.exists() { How::GoOn } else { How::New };
        if how == How::New {
            // A program that died while it wrote it has left a part.
            remove_parts(&recorded)?;
        }
        let lived =
            run.store_into(&places, Vec::new(), &Treatment::default(), how, |progress| lived_on(progress.lived))?;
        let ended = self.ended(here.path(), member, &lived.recording)?;
        place.send(&here, places.files())?;
        Ok(ended)
    }

    /// Writes the list of the members, as text with a line for each value, and returns it.
    fn write(&self, place: &CohortPlace, members: Vec<ListedMember>, how: How) -> Result<CohortList, Error> {
        let (mut recording, asked) = (self.recording.clone(), self.members.asked());
        if let Members::Listed(profiles) = &self.members {
            // The scenario's own stay as they are lived: numbers may have been set in them.
            for (name, text) in profiles.iter().flat_map(|profile| profile.texts()) {
                recording.files.entry(name.clone()).or_insert_with(|| text.clone());
            }
            let without: BTreeSet<&String> = profiles.iter().flat_map(|profile| &profile.without).collect();
            recording.without = without.into_iter().cloned().collect();
        }
        let list = CohortList {
            scenario: self.scenario.name().to_owned(),
            seed: self.recording.seed,
            days: self.scenario.scenario.calendar.days_lived(self.recording.length_us),
            members,
        };
        let file = CohortFile { list, form: self.layout.form(), truth: self.kept.into(), asked, recording };
        let text = serde_json::to_string_pretty(&file);
        let text = text.map_err(|error| Error::file(&place.path().join(LIST), error.to_string()))?;
        place.write_list(text + "\n", how)?;
        Ok(file.list)
    }

    /// A member's run at its beginning.
    fn run(&self, member: &Member, index: usize) -> Result<LiveRun, Error> {
        let recording = self.recording_of(member);
        match &self.members {
            Members::Many(_) => Ok(self.live_run(self.scenario.scenario.clone(), &self.household, recording)),
            Members::Listed(profiles) => {
                let (scenario, household) = self.scenario.base().lived(&profiles[index])?;
                let (files, without) = (scenario.sources.clone(), profiles[index].without.clone());
                let recording = Recording { files, without, ..recording };
                Ok(self.live_run(Arc::new(scenario), &household, recording))
            }
        }
    }

    fn live_run(&self, scenario: Arc<Scenario>, household: &Household, recording: Recording) -> LiveRun {
        let run = Run::new(&scenario, household, recording.seed, recording.length_us);
        let paced = Paced::new(Pace::default(), self.cancel.clone(), None);
        LiveRun { paced, ..LiveRun::of(scenario, run, recording, self.scenario.paths()) }
    }
}
