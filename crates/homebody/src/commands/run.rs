//! `homebody run`: simulate a scenario.

use super::check::tell_remark;
use super::cohort;
use super::lived::{Output, all_are_elsewhere, failure, go_on_by, go_on_in, is_not_yet, live, report, show};
use super::run_messages::RunMessage;
use super::scenario::Trust;
use crate::failure::Failure;
use crate::length::{Length, length};
use crate::metrics::MetricsArguments;
use crate::pace::PaceArguments;
use crate::print::print_text;
use crate::signals::Signals;
use crate::start::StartTime;
use clap::builder::UnknownArgumentValueParser;
use homebody_core::problem::Diagnostic;
use homebody_core::time::Span;
use homebody_simulation::{
    CohortLayout, CohortSetup, CohortSummary, IncompleteCohort, IncompleteRun, LIST, MOST_MEMBERS, OpenScenario,
    SimulationError, TruthKept, Url,
};
use indicatif::ProgressBar;
use std::path::{Path, PathBuf};

/// Simulate a scenario and write its sensor log
///
/// Without --out, Homebody makes a new folder under runs/ with the log (in the form that logger.json names), the ground truth and the
/// recording that replays the run.
#[derive(clap::Args)]
#[command(after_long_help = "Examples:
  homebody run scenarios/tigerplace
  homebody run scenarios/tigerplace --for 2h --speed 60
  homebody run scenarios/tigerplace-depression --without depression
  homebody run scenarios/tigerplace --set gait.slowest=0.25 --set stay.reading.gap=120
  homebody run scenarios/tigerplace --members 100 --for 28d
  homebody run scenarios/tigerplace --members 1000 --for 28d --out parquet:cohort
  homebody run scenarios/tigerplace --members 1000 --for 28d --out parquet:s3://bucket/cohort
  homebody run scenarios/tigerplace --profiles people.csv --for 28d
  homebody run my-home --out log.db --out log.csv --truth truth.db --force
  homebody run scenarios/tigerplace --start now --for 1h --speed 1 --out jsonl:-
  homebody run --resume runs/tigerplace-1
  printf 'step 60\\nstop\\n' | homebody run my-home --control --paused

Cohorts (--members, --profiles): --out names one folder for all members, in any form of files. With
parquet:cohort, logs are cohort/log/member=0001/log.parquet and so on, and ground truths are in
cohort/truth. cohort/cohort.json has the options, the version and a digest of each member. A build
with the feature cloud can write the folder to an object store.

Columns of --profiles:
  name        name of the member's folder
  seed        the member's own seed; by default from the name and the seed of the run
  age         in years; Homebody writes it into the member's routine, and it has no other effect
  pace_mps    walking speed in metres a second
  conditions  conditions instead of the routine's, joined by +; or none
  severity    mild, moderate or severe; one value for all conditions, or one each, joined by +
  onset       start of the condition: week 6, day 40 or 2009-04-13; by default the start of the run; joined likewise
  over        time from the onset to the full effect: 10 days, 4 weeks; joined likewise
  until       end of the condition: week 12, day 80, 2009-06-01; joined likewise
  routine     another routine file in the scenario's folder
  resident    the resident that the row is about, in homes with several routines
  home        another home file in the scenario's folder")]
pub struct Arguments {
    /// Scenario folder, or its scenario.json
    #[arg(required_unless_present = "resume")]
    scenario: Option<PathBuf>,
    #[command(flatten)]
    trust: Trust,
    /// Duration of the run: 90s, 15m, 2h, 7d or 52w (default: that of the scenario)
    ///
    /// Days and weeks follow the calendar: a run of 7d ends at the hour at which it started, even if clocks change in between.
    #[arg(long = "for", value_name = "DURATION", value_parser = length)]
    length: Option<Length>,
    /// Other commands and Python have it; here it leads to `--for`, whose value has a unit.
    #[arg(long = "days", hide = true, value_parser = UnknownArgumentValueParser::suggest("--for sets the duration, such as --for 7d"))]
    _days: Option<()>,
    /// Start of the run in the home's local time: now, today, 2026-11-01 or 2026-11-01T08:00 (default: the start in the scenario)
    #[arg(long, value_name = "TIME")]
    start: Option<StartTime>,
    /// Seed of all random numbers (default: that of the scenario)
    #[arg(long, value_name = "N")]
    seed: Option<u64>,
    /// Leave out a condition of the routine; repeatable
    ///
    /// Homebody uses the same random numbers with and without the condition, except where the condition has an effect.
    #[arg(long, value_name = "CONDITION")]
    without: Vec<String>,
    /// Set a parameter of the models; repeatable
    ///
    /// `homebody parameters` lists all parameters with units and ranges. The recording stores the values.
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = number)]
    numbers: Vec<(String, f64)>,
    /// Simulate a cohort of N members, on all processors
    ///
    /// Members vary around the routine as real people do, and each has its own folder.
    #[arg(long, value_name = "N", help_heading = "Cohorts", value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST_MEMBERS)))]
    members: Option<u32>,
    /// Resume the interrupted run or cohort in this folder
    ///
    /// Homebody simulates the run again from its start, checks the existing files of the folder against it, and writes the missing
    /// rows. The finished log and ground truth are byte for byte those of an uninterrupted run. In a cohort, complete members stay
    /// and all others are resumed.
    #[arg(long, value_name = "FOLDER",
          conflicts_with_all = ["scenario", "length", "seed", "without", "numbers", "start", "members", "profiles", "truth_tables", "recording", "force", "replace_rows"])]
    resume: Option<PathBuf>,
    /// Simulate a cohort from a CSV file with a row for each member
    ///
    /// The first line names the columns; only the column name is required. An empty cell, or a column that is missing, keeps the
    /// value of the scenario. Members vary around this value as real people do.
    #[arg(long, value_name = "FILE", conflicts_with = "members", help_heading = "Cohorts")]
    profiles: Option<PathBuf>,
    /// Ground truth tables that a cohort stores
    ///
    /// By default a cohort stores all tables, but a cohort of more than 10,000 days in total stores only the brief ones. `homebody
    /// replay` of a member's recording writes the others.
    #[arg(long, value_name = "TABLES", value_enum, help_heading = "Cohorts")]
    truth_tables: Option<TruthTables>,
    #[command(flatten)]
    output: Output,
    /// Write the recording, which replays the run, to this file
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    recording: Option<PathBuf>,
    #[command(flatten)]
    pace: PaceArguments,
    #[command(flatten)]
    metrics: MetricsArguments,
}

#[derive(Clone, Copy, PartialEq, clap::ValueEnum)]
enum TruthTables {
    /// All tables
    All,
    /// All tables except cause, off, movement and lost, which have a row for each event or movement
    Brief,
}

/// The name and the value of a parameter.
fn number(text: &str) -> Result<(String, f64), String> {
    let (name, value) = text.split_once('=').ok_or("write NAME=VALUE, such as gait.slowest=0.25")?;
    let number: f64 = value.trim().parse().map_err(|_| format!("{value:?} is not a number"))?;
    if number.is_finite() { Ok((name.trim().to_owned(), number)) } else { Err(format!("{value:?} is not a number")) }
}

/// The options of the speed of a run.
const PACE_OPTIONS: &str = "--speed, --paused and --control";

/// Refuses two values of one parameter.
fn all_different(numbers: &[(String, f64)]) -> Result<(), Failure> {
    let mut twice: Vec<Diagnostic> = Vec::new();
    for (index, (name, value)) in numbers.iter().enumerate() {
        if let Some((_, first)) = numbers[..index].iter().find(|(other, _)| other == name) {
            let (name, first, other) = (name.clone(), *first, *value);
            twice.push(RunMessage::ParameterTwice { name, first, other }.into());
        }
    }
    if twice.is_empty() { Ok(()) } else { Err(Failure::all(twice)) }
}

/// The failure of `--resume`, with a hint.
fn not_resumed(error: SimulationError) -> Failure {
    match error {
        SimulationError::NoRecording { .. } => Failure::from(error).advising("name the folder of an interrupted run or cohort"),
        SimulationError::Recording { .. } => Failure::from(error).advising(
            "the run cannot be resumed without its recording; its logs are still readable, and homebody run starts a new run",
        ),
        error => error.into(),
    }
}

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        let signals = Signals::listen()?;
        if let Some(folder) = &self.resume {
            return self.go_on(folder, &signals);
        }
        all_different(&self.numbers)?;
        let source = self.trust.source(self.scenario.as_deref().unwrap_or(Path::new("")))?;
        let opened = source.open()?.with_numbers(self.numbers.clone())?;
        let opened = self.start.as_ref().map_or(Ok(opened.clone()), |start| start.of(&opened))?;
        let scenario = opened.scenario();
        let seed = self.seed.unwrap_or(scenario.file.seed);
        let length = self.length.unwrap_or(Length::Days(scenario.file.days)).by(&scenario.calendar);
        let cohort = match (&self.profiles, self.members) {
            // Only the list knows who shows a condition that is left out.
            (Some(file), _) => {
                let profiles = opened.profiles(file, &self.without)?;
                if !self.output.quiet {
                    let remarks = opened.remarks_on(&file.display().to_string(), &profiles, length)?;
                    remarks.iter().for_each(tell_remark);
                }
                Some(opened.cohort_of(profiles))
            }
            (None, members) => members.map(|count| opened.cohort(count)),
        };
        let cancel = signals.cancel();
        if let Some(cohort) = cohort {
            self.suits_a_cohort()?;
            let cohort = cohort.seed(seed).length(length).without(&self.without).cancel(cancel);
            return self.live_cohort(&opened, cohort, length, &signals);
        }
        if self.truth_tables.is_some() {
            return Err(Failure::asked(RunMessage::TruthTables));
        }
        let run = opened.run().seed(seed).length(length).without(&self.without);
        let run = run.pace(self.pace.pace()).commands(self.pace.commands()?).cancel(cancel).start()?;
        let run = run.metered(&self.metrics.begin(opened.name(), self.output.quiet)?);
        self.remark(&opened, length);
        live(run, self.recording, &self.output, &signals)
    }

    /// Simulates a cohort.
    fn live_cohort(
        &self,
        opened: &OpenScenario,
        setup: CohortSetup,
        length: Span,
        signals: &Signals,
    ) -> Result<(), Failure> {
        let to = self.cohorts_place()?;
        let layout = to.map_or(Ok(CohortLayout::Folders), CohortLayout::at).map_err(Failure::asked)?;
        let setup = match self.truth_tables {
            Some(TruthTables::All) => setup.truth(TruthKept::All),
            Some(TruthTables::Brief) => setup.truth(TruthKept::Brief),
            None => setup,
        };
        let cohort = setup.layout(layout).start()?;
        self.remark(opened, length);
        if !self.output.quiet {
            cohort::foretell(&cohort, self.truth_tables.is_some());
        }
        let progress = self.output.progress(cohort.progress().length);
        let lived = match to {
            Some(place) => cohort.store_in(place.path(), |lived| show(&progress, Span::ZERO, lived)),
            None => cohort.store(|lived| show(&progress, Span::ZERO, lived)),
        };
        self.tell_cohort(&progress, &lived?, signals)
    }

    /// Refuses all options that a cohort does not have.
    fn suits_a_cohort(&self) -> Result<(), Failure> {
        const NEW: &str = "a cohort replaces nothing; it needs a new folder";
        const TRUTH: &str =
            "the cohort's folder holds the ground truth of each member; --truth-tables selects its tables";
        const PACE: &str = "a cohort runs as fast as possible; homebody fleet simulates many homes in real time";
        let refused = [
            (self.output.truth.is_some(), "--truth", TRUTH),
            (self.recording.is_some(), "--recording", "each member has a recording in the cohort's folder"),
            (self.output.replacing.force, "--force", NEW),
            (self.output.replacing.replace_rows, "--replace-rows", NEW),
            (self.pace.is_given(), PACE_OPTIONS, PACE),
            (self.metrics.is_given(), "--metrics", "only single runs and fleets have metrics"),
        ];
        let refused = refused.into_iter().filter(|(is_asked, ..)| *is_asked);
        let refused: Vec<Diagnostic> =
            refused.map(|(_, option, why)| RunMessage::CohortOption { option, why }.into()).collect();
        if refused.is_empty() { Ok(()) } else { Err(Failure::all(refused)) }
    }

    /// The destination of all members of a cohort; None for a folder each.
    fn cohorts_place(&self) -> Result<Option<&Url>, Failure> {
        match &self.output.out[..] {
            [] => Ok(None),
            [place] => Ok(Some(place)),
            all => Err(Failure::asked(RunMessage::CohortDestinations { count: all.len() })),
        }
    }

    /// Resumes an interrupted run or cohort.
    fn go_on(&self, folder: &Path, signals: &Signals) -> Result<(), Failure> {
        // Of a cohort in a store, both its URL and what --out was are understood.
        let place = folder.to_str().and_then(|text| text.parse::<Url>().ok()).filter(Url::is_in_store);
        let folder = place.as_ref().map_or(folder, Url::path);
        if folder.to_string_lossy().contains("://") || folder.join(LIST).is_file() {
            if self.pace.is_given() {
                let why = "a cohort runs as fast as possible";
                return Err(Failure::asked(RunMessage::CohortOption { option: PACE_OPTIONS, why }));
            }
            if self.output.truth.is_some() {
                let why = "the cohort's folder holds the ground truth of each member";
                return Err(Failure::asked(RunMessage::CohortOption { option: "--truth", why }));
            }
            let cohort = IncompleteCohort::open(folder).map_err(not_resumed)?.cancel(signals.cancel());
            let before = cohort.progress().done;
            let progress = self.output.progress(cohort.progress().length);
            let lived = cohort.resume(|lived| show(&progress, before, lived));
            let lived = lived.or_else(|error| self.not_yet(error, folder, &progress, signals))?;
            return self.tell_cohort(&progress, &lived, signals);
        }
        let run = IncompleteRun::open(folder).map_err(not_resumed)?;
        if run.has_no_end() && !self.pace.is_given() {
            return Err(Failure::asked(RunMessage::HomeInRealTime { folder: folder.to_owned() }));
        }
        let run = run.paced(self.pace.pace(), self.pace.commands()?, signals.cancel());
        all_are_elsewhere(&self.output.out)?;
        let run = self.with_truth(run)?;
        let servers = self.output.away.treatment()?;
        let meters = self.metrics.begin(&run.scenario().file.name, self.output.quiet)?;
        let run = run.metered(&meters);
        let name = run.scenario().file.name.clone();
        let progress = self.output.progress(run.progress().length);
        let lived = run.resume_beside(&self.output.out, &servers, |lived| show(&progress, Span::ZERO, lived));
        let lived = lived.or_else(|error| self.not_yet(error, folder, &progress, signals))?;
        progress.finish_and_clear();
        report(&name, &lived, &self.output)?;
        signals.ended(lived.is_stopped())
    }

    /// A truth on a server continues there. A truth in the folder needs no option.
    fn with_truth(&self, run: IncompleteRun) -> Result<IncompleteRun, Failure> {
        match &self.output.truth {
            None => Ok(run),
            Some(truth) if truth.server().is_some() => Ok(run.with_truth(truth)),
            Some(truth) => Err(Failure::asked(RunMessage::MiddleOfRun { place: truth.to_string(), is_truth: true })),
        }
    }

    /// A signal before the run has caught up with its folder leaves the folder unchanged; the message names the command that resumes.
    fn not_yet<T>(
        &self,
        error: SimulationError,
        folder: &Path,
        progress: &ProgressBar,
        signals: &Signals,
    ) -> Result<T, Failure> {
        progress.finish_and_clear();
        let ended = signals.ended(is_not_yet(&error));
        if ended.is_err() && !self.output.quiet && !self.output.json {
            print_text(&format!("stopped    while it resumed; the folder is unchanged\n{}", go_on_in(folder)))?;
        }
        ended.and(Err(failure(error, go_on_by, signals)))
    }

    fn tell_cohort(&self, progress: &ProgressBar, lived: &CohortSummary, signals: &Signals) -> Result<(), Failure> {
        progress.finish_and_clear();
        cohort::report(&self.output, lived)?;
        signals.ended(lived.is_stopped())
    }

    /// Warns of likely mistakes.
    fn remark(&self, opened: &OpenScenario, length: Span) {
        if !self.output.quiet {
            opened.remarks(length).iter().for_each(tell_remark);
        }
    }
}
