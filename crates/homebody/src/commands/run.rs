//! `homebody run`: simulate a scenario.

use super::check::tell_remark;
use super::cohort;
use super::early_warnings::EarlyWarnings;
use super::run_messages::RunMessage;
use super::run_output::{
    Output, check_destinations, failure, is_unchanged, report, resume_command, resume_line, show, store,
};
use super::scenario::Trust;
use crate::failure::Failure;
use crate::metrics::MetricsArguments;
use crate::pace::PaceArguments;
use crate::print::print_text;
use crate::signals::Signals;
use clap::Args;
use clap::builder::UnknownArgumentValueParser;
use homebody_core::problem::Diagnostic;
use homebody_core::time::Span;
use homebody_simulation::{
    CohortLayout, CohortSetup, CohortSummary, IncompleteCohort, IncompleteRun, LIST, MOST_MEMBERS, OpenScenario,
    PlannedRun, RunOptions, SimulationError, TruthKept, Url,
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
pub struct RunArguments {
    /// Scenario folder, or its scenario.json
    #[arg(required_unless_present = "resume")]
    scenario: Option<PathBuf>,
    #[command(flatten)]
    trust: Trust,
    #[command(flatten)]
    options: RunOptions,
    /// Other commands and Python have this option. Here its error names `--for`, whose value has a unit.
    #[arg(long = "days", hide = true, value_parser = UnknownArgumentValueParser::suggest("--for sets the duration, such as --for 7d"))]
    _days: Option<()>,
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
    #[arg(long, value_name = "FOLDER", conflicts_with_all = options_of_new_runs())]
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

/// The options that `--resume` refuses, since the recording has their values or the files exist.
///
/// They are listed by name because clap leaves the group of [`RunOptions`] empty: its validation does not know groups within groups.
fn options_of_new_runs() -> Vec<clap::Id> {
    const OTHERS: [&str; 7] = ["scenario", "members", "profiles", "truth_tables", "recording", "force", "replace_rows"];
    let options = RunOptions::augment_args(clap::Command::new("run"));
    options.get_arguments().map(|option| option.get_id().clone()).chain(OTHERS.map(Into::into)).collect()
}

#[derive(Clone, Copy, PartialEq, clap::ValueEnum)]
enum TruthTables {
    /// All tables
    All,
    /// All tables except cause, off, movement and lost, which have a row for each event or movement
    Brief,
}

const PACE_OPTIONS: &str = "--speed, --paused and --control";

/// Refuses two values of one parameter.
fn check_parameters_differ(numbers: &[(String, f64)]) -> Result<(), Failure> {
    let mut twice: Vec<Diagnostic> = Vec::new();
    for (index, (name, value)) in numbers.iter().enumerate() {
        if let Some((_, first)) = numbers[..index].iter().find(|(other, _)| other == name) {
            let (name, first, other) = (name.clone(), *first, *value);
            twice.push(RunMessage::ParameterTwice { name, first, other }.into());
        }
    }
    if twice.is_empty() { Ok(()) } else { Err(Failure::all(twice)) }
}

fn not_resumed(error: SimulationError) -> Failure {
    match error {
        SimulationError::NoRecording { .. } => Failure::from(error).advising("name the folder of an interrupted run or cohort"),
        SimulationError::Recording { .. } => Failure::from(error).advising(
            "the run cannot be resumed without its recording; its logs are still readable, and homebody run starts a new run",
        ),
        error => error.into(),
    }
}

impl RunArguments {
    pub fn run(self) -> Result<(), Failure> {
        let signals = Signals::listen()?;
        if let Some(folder) = &self.resume {
            return self.resume(folder, &signals);
        }
        check_parameters_differ(&self.options.numbers)?;
        let source = self.trust.source(self.scenario.as_deref().unwrap_or(Path::new("")))?;
        let setup = self.options.clone().setup(&source.open()?)?.cancel(signals.cancel());
        let (opened, length) = (setup.scenario().clone(), setup.span()?);
        // The members of a list have conditions and routines of their own.
        let has_sample = opened.has_routine() && self.profiles.is_none();
        let sampled = if has_sample { Some(setup.plan()?) } else { None };
        let cohort = match (&self.profiles, self.members) {
            // Only the list knows who shows a condition that is left out.
            (Some(file), _) => {
                let profiles = opened.profiles(file, setup.without_conditions())?;
                let remarks = opened.remarks_on(&file.display().to_string(), &profiles, length)?;
                remarks.iter().for_each(tell_remark);
                setup.cohort_of(profiles)
            }
            (None, Some(count)) => setup.cohort(count),
            (None, None) => {
                if self.truth_tables.is_some() {
                    return Err(Failure::asked(RunMessage::TruthTables));
                }
                let run = setup.pace(self.pace.pace()).commands(self.pace.commands()?).start()?;
                let run = run.metered(&self.metrics.begin(opened.name(), self.output.quiet)?);
                opened.remarks(length).iter().for_each(tell_remark);
                let early = sampled.map(EarlyWarnings::begin).transpose()?;
                return store(run, self.recording, &self.output, &signals, early);
            }
        };
        self.check_cohort_options()?;
        self.run_cohort(&opened, cohort, length, sampled, &signals)
    }

    fn run_cohort(
        &self,
        opened: &OpenScenario,
        setup: CohortSetup,
        length: Span,
        sampled: Option<PlannedRun>,
        signals: &Signals,
    ) -> Result<(), Failure> {
        let to = self.cohort_place()?;
        let layout = to.map_or(Ok(CohortLayout::Folders), CohortLayout::at).map_err(Failure::asked)?;
        let setup = match self.truth_tables {
            Some(TruthTables::All) => setup.truth(TruthKept::All),
            Some(TruthTables::Brief) => setup.truth(TruthKept::Brief),
            None => setup,
        };
        let cohort = setup.layout(layout).start()?;
        opened.remarks(length).iter().for_each(tell_remark);
        let early = sampled.map(EarlyWarnings::begin).transpose()?;
        if !self.output.quiet {
            cohort::announce(&cohort, self.truth_tables.is_some());
        }
        let progress = self.output.progress(cohort.progress().length);
        let show_and_warn = |done| {
            show(&progress, Span::ZERO, done);
            early.iter().for_each(|early| early.tell_soon(&progress));
        };
        let summary = match to {
            Some(place) => cohort.store_in(place.path(), show_and_warn),
            None => cohort.store(show_and_warn),
        };
        early.iter().for_each(EarlyWarnings::tell_now);
        self.report_cohort(&progress, &summary?, signals)
    }

    fn check_cohort_options(&self) -> Result<(), Failure> {
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
    fn cohort_place(&self) -> Result<Option<&Url>, Failure> {
        match &self.output.out[..] {
            [] => Ok(None),
            [place] => Ok(Some(place)),
            all => Err(Failure::asked(RunMessage::CohortDestinations { count: all.len() })),
        }
    }

    fn resume(&self, folder: &Path, signals: &Signals) -> Result<(), Failure> {
        // A cohort in a store has a URL; the value of its --out is accepted, too.
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
            let summary = cohort.resume(|done| show(&progress, before, done));
            let summary = summary.or_else(|error| self.stopped_while_resuming(error, folder, &progress, signals))?;
            return self.report_cohort(&progress, &summary, signals);
        }
        let run = IncompleteRun::open(folder).map_err(not_resumed)?;
        if run.has_no_end() && !self.pace.is_given() {
            return Err(Failure::asked(RunMessage::HomeInRealTime { folder: folder.to_owned() }));
        }
        let run = run.paced(self.pace.pace(), self.pace.commands()?, signals.cancel());
        check_destinations(&self.output.out)?;
        let run = self.with_truth(run)?;
        let servers = self.output.away.treatment()?;
        let meters = self.metrics.begin(&run.scenario().file.name, self.output.quiet)?;
        let run = run.metered(&meters);
        let name = run.scenario().file.name.clone();
        let progress = self.output.progress(run.progress().length);
        let summary = run.resume_into(&self.output.out, &servers, |done| show(&progress, Span::ZERO, done));
        let summary = summary.or_else(|error| self.stopped_while_resuming(error, folder, &progress, signals))?;
        progress.finish_and_clear();
        report(&name, &summary, &self.output)?;
        signals.ended(summary.is_stopped())
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
    fn stopped_while_resuming<T>(
        &self,
        error: SimulationError,
        folder: &Path,
        progress: &ProgressBar,
        signals: &Signals,
    ) -> Result<T, Failure> {
        progress.finish_and_clear();
        let ended = signals.ended(is_unchanged(&error));
        if ended.is_err() && !self.output.quiet && !self.output.json {
            print_text(&format!("stopped    while it resumed; the folder is unchanged\n{}", resume_line(folder)))?;
        }
        ended.and(Err(failure(error, resume_command, signals)))
    }

    fn report_cohort(&self, progress: &ProgressBar, summary: &CohortSummary, signals: &Signals) -> Result<(), Failure> {
        progress.finish_and_clear();
        cohort::report(&self.output, summary)?;
        signals.ended(summary.is_stopped())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::error::ErrorKind;

    #[test]
    fn resume_refuses_each_option_of_a_run() {
        let command = RunArguments::augment_args(clap::Command::new("run"));
        let options = RunOptions::augment_args(clap::Command::new("options"));
        let names: Vec<&str> = options.get_arguments().filter_map(clap::Arg::get_long).collect();
        assert!(["for", "set", "seed", "without"].iter().all(|name| names.contains(name)), "{names:?}");
        for option in options.get_arguments() {
            let name = option.get_long().expect("an option has a name");
            let takes_value = option.get_action().takes_values();
            let with_any_value =
                |option: clap::Arg| if takes_value { option.value_parser(clap::value_parser!(String)) } else { option };
            let command = command.clone().mut_arg(option.get_id(), with_any_value);
            let word = if takes_value { format!("--{name}=1") } else { format!("--{name}") };
            let error = command.try_get_matches_from(["run", "--resume", "folder", &word]).unwrap_err();
            assert_eq!(error.kind(), ErrorKind::ArgumentConflict, "{error}");
        }
        command.try_get_matches_from(["run", "--resume", "folder", "--quiet"]).unwrap();
    }
}
