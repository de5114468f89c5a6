//! `homebody run`: live a scenario.

use super::check::tell_remark;
use super::cohort;
use super::lived::{Output, all_are_elsewhere, failure, go_on_by, go_on_in, is_not_yet, live, report, show};
use super::scenario::Trust;
use crate::failure::Failure;
use crate::length::{Length, length};
use crate::pace::Asked;
use crate::print::print_text;
use crate::signals::Signals;
use crate::start::Start;
use crate::watched::Watched;
use clap::builder::UnknownArgumentValueParser;
use homebody_core::time::Micros;
use homebody_kit::{
    CohortLayout, CohortSetup, Error, LIST, LivedCohort, MOST_MEMBERS, OpenScenario, TruthKept, Unfinished,
    UnfinishedCohort, Url,
};
use indicatif::ProgressBar;
use std::path::{Path, PathBuf};

/// Lives a scenario and stores what its sensors say.
///
/// Without --out, everything goes into a new folder under runs/: the log as the scenario's logger.json
/// says, the ground truth apart from it, and the recording that replays the run.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  homebody run scenarios/tigerplace
  homebody run scenarios/tigerplace --for 2h --speed 60
  homebody run scenarios/tigerplace-depression --without depression
  homebody run scenarios/tigerplace --set gait.slowest=0.25 --set stay.reading.gap=120
  homebody run scenarios/tigerplace --residents 100 --for 28d
  homebody run scenarios/tigerplace --residents 1000 --for 28d --out parquet:cohort
  homebody run scenarios/tigerplace --residents 1000 --for 28d --out parquet:s3://bucket/cohort
  homebody run scenarios/tigerplace --profiles people.csv --for 28d
  homebody run my-home --out sqlite:log.db --out csv:log.csv --truth truth.db --force
  homebody run scenarios/tigerplace --start now --for 1h --speed 1 --out jsonl:-
  homebody run --resume runs/tigerplace-1
  printf 'step 60\\nstop\\n' | homebody run my-home --control --paused

Of a cohort, --out names one folder for all members, in any form of files: with parquet:cohort,
logs are cohort/log/member=0001/log.parquet and so on, truths lie apart in cohort/truth, and
cohort/cohort.json says what was asked, by which version, and has a digest of each member. In a build with
the feature cloud the folder may be in an object store.

Columns of --profiles:
  name        what the member's folder is called
  seed        a number of their own; without it, it follows from the name and the seed of the run
  age         in years: the routine says so, and nothing else follows from it
  pace_mps    how fast they walk, in metres a second
  conditions  those that they show instead of the routine's, with + between several; or none
  severity    mild, moderate or severe; with + between several, or one for all, as in the next three
  onset       from when on: week 6, day 40 or 2009-04-13; from the beginning without it
  over        how long it takes to come, from its onset: 10 days, 4 weeks
  until       until when: week 12, day 80, 2009-06-01
  routine     a text in the scenario's folder to live by instead
  resident    whom the row is about, where several live by routines
  home        a home in the scenario's folder to live in instead")]
pub struct Arguments {
    /// The scenario's folder, or its scenario.json
    #[arg(required_unless_present = "resume")]
    scenario: Option<PathBuf>,
    #[command(flatten)]
    trust: Trust,
    /// How long to live: 90s, 15m, 2h, 7d or 52w; the scenario's days without it
    ///
    /// Days and weeks are those of the calendar: a run of 7d ends at the hour at which it began, also where clocks change.
    #[arg(long = "for", value_name = "SPAN", value_parser = length)]
    length: Option<Length>,
    /// Asked of other commands and in Python, and here of no use: a span has a unit.
    #[arg(long = "days", hide = true, value_parser = UnknownArgumentValueParser::suggest("how long to live is said by --for, such as --for 7d"))]
    _days: Option<()>,
    /// When the run begins, instead of when the scenario says: now, today, 2026-11-01 or 2026-11-01T08:00, on the clock of the home
    #[arg(long, value_name = "TIME")]
    start: Option<Start>,
    /// The number all randomness comes from, instead of the scenario's
    #[arg(long)]
    seed: Option<u64>,
    /// Leave out a condition that a routine shows; may be given several times
    ///
    /// All that the condition does not touch draws the same random numbers with it and without.
    #[arg(long, value_name = "CONDITION")]
    without: Vec<String>,
    /// Set a number of the models to another value; may be given several times
    ///
    /// `homebody numbers` lists them, with units and ranges. The recording has them.
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = number)]
    numbers: Vec<(String, f64)>,
    /// Live so many lives side by side, on all processors: each differs from the routines as people differ, and goes into
    /// a folder of its own
    #[arg(long, value_name = "NUMBER", value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST_MEMBERS)))]
    residents: Option<u32>,
    /// Go on with the run or the cohort in this folder, which was killed or stopped
    ///
    /// It is lived again from its beginning: what is there is compared, what is missing is written. In the end log and truth have
    /// the bytes of a run that nothing has disturbed. Of a cohort, those who were lived to the end stay, all others are gone on with.
    #[arg(long, value_name = "FOLDER",
          conflicts_with_all = ["scenario", "length", "seed", "without", "numbers", "start", "residents", "profiles", "truth_tables", "record", "force", "replace_rows"])]
    resume: Option<PathBuf>,
    /// Live the members of this list side by side: a CSV file with a row for each
    ///
    /// Its first line names the columns, of which only the name is needed; what a row leaves empty is as in the scenario. All
    /// that it does not say differs as people differ.
    #[arg(long, value_name = "FILE", conflicts_with = "residents")]
    profiles: Option<PathBuf>,
    /// How much of the truths of a cohort is kept: all tables, or only those without a row for each firing or movement
    ///
    /// Without it, a cohort keeps all, and a large one, of more than 10000 days for all members together, what is brief: the tables cause,
    /// off, movement and lost are left out. `homebody replay` of a member's recording has them.
    #[arg(long, value_name = "WHICH", value_enum)]
    truth_tables: Option<TruthTables>,
    #[command(flatten)]
    output: Output,
    /// Record what is needed to replay the run into this file
    #[arg(long, value_name = "FILE")]
    record: Option<PathBuf>,
    #[command(flatten)]
    pace: Asked,
    #[command(flatten)]
    watched: Watched,
}

#[derive(Clone, Copy, PartialEq, clap::ValueEnum)]
enum TruthTables {
    All,
    Brief,
}

/// The name of a number and what it is set to.
fn number(text: &str) -> Result<(String, f64), String> {
    let (name, value) = text.split_once('=').ok_or("write NAME=VALUE, such as gait.slowest=0.25")?;
    let number: f64 = value.trim().parse().map_err(|_| format!("{value:?} is no number"))?;
    if number.is_finite() { Ok((name.trim().to_owned(), number)) } else { Err(format!("{value:?} is no number")) }
}

/// Nobody can mean two values of one number.
fn all_different(numbers: &[(String, f64)]) -> Result<(), Failure> {
    let mut twice = Vec::new();
    for (index, (name, value)) in numbers.iter().enumerate() {
        if let Some((_, first)) = numbers[..index].iter().find(|(other, _)| other == name) {
            twice.push(format!("--set {name}={first} and --set {name}={value} set one number"));
        }
    }
    if twice.is_empty() { Ok(()) } else { Err(Failure::Usage(twice.join("\n") + "\n  hint: say each number once")) }
}

/// Why a folder's run or cohort cannot be gone on with, and what to do instead.
fn not_gone_on_with(error: Error) -> Failure {
    match error {
        Error::NoRecording { .. } => {
            Failure::Io(format!("{error}\n  hint: name the folder of a run or a cohort that homebody run has left"))
        }
        Error::Recording { .. } => Failure::usage(format!(
            "{error}\n  hint: without it nobody can go on; what is in the logs can still be read, and homebody run begins anew"
        )),
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
        let cohort = match (&self.profiles, self.residents) {
            // Who shows a condition that is left out, only the list knows.
            (Some(file), _) => {
                let profiles = opened.profiles(file, &self.without)?;
                if !self.output.quiet {
                    let remarks = opened.remarks_on(&file.display().to_string(), &profiles, length)?;
                    remarks.iter().for_each(tell_remark);
                }
                Some(opened.cohort_of(profiles))
            }
            (None, residents) => residents.map(|count| opened.cohort(count)),
        };
        let cancel = signals.cancel();
        if let Some(cohort) = cohort {
            self.suits_a_cohort()?;
            let cohort = cohort.seed(seed).length(length).without(&self.without).cancel(cancel);
            return self.live_cohort(&opened, cohort, length, &signals);
        }
        if self.truth_tables.is_some() {
            let what = "--truth-tables is about the truths of a cohort";
            return Err(Failure::usage(format!("{what}\n  hint: the truth of one run has all tables: leave it out")));
        }
        let run = opened.run().seed(seed).length(length).without(&self.without);
        let run = run.pace(self.pace.pace()).commands(self.pace.commands()?).cancel(cancel).start()?;
        let run = run.metered(&self.watched.begin(opened.name(), self.output.quiet)?);
        self.remark(&opened, length);
        live(run, self.record, &self.output, &signals)
    }

    /// Lives many side by side.
    fn live_cohort(
        &self,
        opened: &OpenScenario,
        setup: CohortSetup,
        length: Micros,
        signals: &Signals,
    ) -> Result<(), Failure> {
        let to = self.cohorts_place()?;
        let layout = to.map_or(Ok(CohortLayout::Folders), CohortLayout::of).map_err(Failure::asked)?;
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
            Some(place) => cohort.store_in(place.path(), |lived| show(&progress, 0, lived)),
            None => cohort.store(|lived| show(&progress, 0, lived)),
        };
        self.tell_cohort(&progress, &lived?, signals)
    }

    /// Nobody is lived where something was asked that a cohort does not do: all of it is told.
    fn suits_a_cohort(&self) -> Result<(), Failure> {
        let refused = [
            (
                self.output.truth.is_some(),
                "--truth: the truth of each member lies apart from all logs where the cohort does; --truth-tables says how much of it is kept",
            ),
            (self.record.is_some(), "--record: each member has a recording where the cohort lies"),
            (self.output.replacing.force, "--force: a cohort replaces nothing; it begins where nothing is"),
            (
                self.output.replacing.replace_rows,
                "--replace-rows: a cohort replaces nothing; it begins where nothing is",
            ),
            (
                self.pace.is_said(),
                "--speed, --paused and --control: members are lived as fast as they can; homebody fleet lives many homes on the world's clock",
            ),
            (self.watched.is_said(), "--metrics: it is of one run, or of a fleet"),
        ];
        let refused: Vec<&str> = refused.iter().filter_map(|(is_asked, why)| is_asked.then_some(*why)).collect();
        match refused.is_empty() {
            true => Ok(()),
            false => Err(Failure::Usage(format!("{}\n  hint: leave that out of a cohort", refused.join("\n")))),
        }
    }

    /// Where all members of a cohort go together; None for a folder each.
    fn cohorts_place(&self) -> Result<Option<&Url>, Failure> {
        match &self.output.out[..] {
            [] => Ok(None),
            [place] => Ok(Some(place)),
            _ => Err(Failure::usage("a cohort goes into one place\n  hint: name one --out, such as parquet:cohort")),
        }
    }

    /// Goes on with a run or a cohort that was killed or stopped.
    fn go_on(&self, folder: &Path, signals: &Signals) -> Result<(), Failure> {
        // Of a cohort in a store, both its URL and what --out was are understood.
        let place = folder.to_str().and_then(|text| text.parse::<Url>().ok()).filter(Url::is_in_store);
        let folder = place.as_ref().map_or(folder, Url::path);
        if folder.to_string_lossy().contains("://") || folder.join(LIST).is_file() {
            if self.pace.is_said() {
                let what = "the members of a cohort are lived as fast as they can";
                return Err(Failure::usage(format!("{what}\n  hint: leave out --speed, --paused and --control")));
            }
            if self.output.truth.is_some() {
                let what = "the truth of each member of a cohort lies where the cohort does";
                return Err(Failure::usage(format!("{what}\n  hint: leave --truth out")));
            }
            let cohort = UnfinishedCohort::open(folder).map_err(not_gone_on_with)?.cancel(signals.cancel());
            let before = cohort.progress().lived;
            let progress = self.output.progress(cohort.progress().length);
            let lived = cohort.go_on(|lived| show(&progress, before, lived));
            let lived = lived.or_else(|error| self.not_yet(error, folder, &progress, signals))?;
            return self.tell_cohort(&progress, &lived, signals);
        }
        let run = Unfinished::open(folder).map_err(not_gone_on_with)?;
        if run.has_no_end() && !self.pace.is_said() {
            let what = format!("{} is a home on the world's clock, which has no end to be lived to", folder.display());
            let hint = format!("homebody live SCENARIO --folder {} goes on with it", folder.display());
            return Err(Failure::usage(format!("{what}\n  hint: {hint}")));
        }
        let run = run.paced(self.pace.pace(), self.pace.commands()?, signals.cancel());
        all_are_elsewhere(&self.output.out)?;
        let run = self.with_truth(run)?;
        let servers = self.output.away.treatment()?;
        let meters = self.watched.begin(&run.scenario().file.name, self.output.quiet)?;
        let run = run.metered(&meters);
        let name = run.scenario().file.name.clone();
        let progress = self.output.progress(run.progress().length);
        let lived = run.go_on_beside(&self.output.out, &servers, |lived| show(&progress, 0, lived));
        let lived = lived.or_else(|error| self.not_yet(error, folder, &progress, signals))?;
        progress.finish_and_clear();
        report(&name, &lived, &self.output)?;
        signals.ended(lived.is_stopped())
    }

    /// A truth on a server continues there. A truth in the folder needs no option.
    fn with_truth(&self, run: Unfinished) -> Result<Unfinished, Failure> {
        match &self.output.truth {
            None => Ok(run),
            Some(truth) if truth.server().is_some() => Ok(run.with_truth(truth)),
            Some(truth) => {
                let what = format!("{truth} cannot be begun in the middle of a run");
                let hint =
                    "leave --truth out: the truth in the folder is gone on with; only one on a server has to be named";
                Err(Failure::usage(format!("{what}\n  hint: {hint}")))
            }
        }
    }

    /// Who is asked by a signal to end before all that is there has been lived again has changed nothing, and says how to go on.
    fn not_yet<T>(&self, error: Error, folder: &Path, progress: &ProgressBar, signals: &Signals) -> Result<T, Failure> {
        progress.finish_and_clear();
        let ended = signals.ended(is_not_yet(&error));
        if ended.is_err() && !self.output.quiet && !self.output.json {
            print_text(&format!(
                "stopped    before it had come as far as before: all is as it was\n{}",
                go_on_in(folder)
            ))?;
        }
        ended.and(Err(failure(error, go_on_by, signals)))
    }

    fn tell_cohort(&self, progress: &ProgressBar, lived: &LivedCohort, signals: &Signals) -> Result<(), Failure> {
        progress.finish_and_clear();
        cohort::report(&self.output, lived)?;
        signals.ended(lived.is_stopped())
    }

    /// Warns of what is hardly meant.
    fn remark(&self, opened: &OpenScenario, length: Micros) {
        if !self.output.quiet {
            opened.remarks(length).iter().for_each(tell_remark);
        }
    }
}
