//! `homebody live`: a home in real time.

use super::run_output::{Away, check_destinations, failure, future_start, is_unchanged, report_live};
use super::scenario::Trust;
use crate::failure::{EXIT_CODES, Failure};
use crate::metrics::MetricsArguments;
use crate::print::tell;
use crate::progress::on_terminal;
use crate::signals::Signals;
use homebody_core::time::{RunTime, UtcTime};
use homebody_simulation::{LiveHome, RunMetrics, RunOptions, RunStart, Url, VariantOptions};
use indicatif::ProgressBar;
use jiff::Timestamp;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

homebody_core::messages! {
    /// Problems with a home in real time.
    pub enum LiveMessage in "live" {
        /// The folder holds the home of another scenario. Each home in real time has a folder of its own.
        Home { folder: PathBuf, holds: String, scenario: String } error "other-home"
            ("{folder} already contains another home, {holds}", folder = folder.display())
            hint ("name another folder for {scenario} with --folder");
        /// The home of the folder started at another time. Homebody resumes it and cannot change its past.
        Start { folder: PathBuf, start: String } error "other-start"
            ("the home in {folder} started at {start}, and --start cannot change it", folder = folder.display())
            hint ("leave out --start to resume the home, or name another folder with --folder");
        /// The home of the folder has another seed. Homebody resumes it and cannot change its past.
        Seed { folder: PathBuf, seed: u64 } error "other-seed"
            ("the home in {folder} has the seed {seed}, and --seed cannot change it", folder = folder.display())
            hint ("leave out --seed to resume the home, or name another folder with --folder");
    }
}

/// Simulate a home in real time until you stop it
///
/// Homebody writes the log, the ground truth and the recording into live/NAME, where NAME is the name in scenario.json, or into
/// --folder. --out sends the rows to servers and to standard output as they come.
///
/// After a stop or a crash, the same command resumes: Homebody simulates the time in between as fast as possible. No row is missing.
/// Brokers and readers may receive a row twice, with the same number.
#[derive(clap::Args)]
#[command(after_long_help = format!("Examples:
  homebody live scenarios/tigerplace
  homebody live scenarios/tigerplace --start 2026-11-01 --out postgresql://ann@localhost/homes
  homebody live scenarios/tigerplace --out mqtt://localhost/homebody --on-unavailable spool
  homebody live scenarios/tigerplace --out jsonl:- --metrics 9464 | consumer

{EXIT_CODES},
129, 130 or 143 SIGHUP, SIGINT or SIGTERM ended it; what was simulated is stored."))]
pub struct LiveArguments {
    /// Scenario folder, or its scenario.json
    scenario: PathBuf,
    #[command(flatten)]
    trust: Trust,
    /// Start of the simulation in the home's local time: now, today, 2026-11-01 or 2026-11-01T08:00
    ///
    /// Homebody simulates the time before now as fast as possible.
    #[arg(long, value_name = "TIME", default_value = "now")]
    start: RunStart,
    /// Folder for the files of the home (default: live/NAME, with the name in scenario.json)
    #[arg(long, value_name = "FOLDER")]
    folder: Option<PathBuf>,
    #[command(flatten)]
    variant: VariantOptions,
    /// Also send the rows to this server, or to standard output as jsonl:-, csv:- or casas:-; repeatable
    #[arg(short, long, value_name = "DESTINATION")]
    out: Vec<Url>,
    #[command(flatten)]
    away: Away,
    #[command(flatten)]
    metrics: MetricsArguments,
    /// Print errors only
    #[arg(short, long)]
    quiet: bool,
}

const LIVE: &str = "live";

impl LiveArguments {
    pub fn run(self) -> Result<(), Failure> {
        let signals = Signals::listen()?;
        let opened = self.trust.source(&self.scenario)?.open()?;
        let folder = self.folder.clone().unwrap_or_else(|| Path::new(LIVE).join(opened.name()));
        let elsewhere: Vec<Url> = self.out.iter().filter(|url| !url.is_output()).cloned().collect();
        check_destinations(&elsewhere)?;
        let servers = self.away.treatment()?;
        let home = match LiveHome::is_there(&folder) {
            true => LiveHome::resume(&folder)?,
            false => {
                let (start, variant) = (Some(self.start.clone()), self.variant.clone());
                let options = RunOptions { start, variant, ..RunOptions::default() };
                LiveHome::create(options.setup(&opened)?, &folder)?
            }
        };
        if home.is_resumed() && home.scenario().file.name != opened.name() {
            let (holds, scenario) = (home.scenario().file.name.clone(), opened.name().to_owned());
            return Err(Failure::asked(LiveMessage::Home { folder, holds, scenario }));
        }
        if home.is_resumed() {
            self.check_resumed_home(&home, &folder)?;
        }
        if !self.quiet {
            tell(format_args!("{} {}; press Ctrl-C to stop", opened.name(), start_message(&home, &folder)));
        }
        let (name, meters) = (opened.name().to_owned(), self.metrics.begin(opened.name(), self.quiet)?);
        let mut shown = LiveProgress::new(self.quiet, &meters);
        let summary = home.run(&self.out, &servers, &meters, signals.cancel(), |_| shown.update());
        shown.bar.finish_and_clear();
        let summary = match summary {
            Err(error) if is_unchanged(&error) => {
                // It had not yet caught up with its folder, so the stop is not a failure.
                if !self.quiet {
                    tell(format_args!("{name}: stopped while it resumed; the folder is unchanged"));
                }
                return signals.ended(true).and(Err(error.into()));
            }
            summary => summary.map_err(|error| failure(error, |_| "the same command".into(), &signals))?,
        };
        if !self.quiet {
            report_live(&name, &folder, &summary);
        }
        signals.ended(true)
    }

    /// Refuses another start or another seed than those of the home in the folder. `now` and `today` fit any start.
    fn check_resumed_home(&self, home: &LiveHome, folder: &Path) -> Result<(), Failure> {
        let folder = folder.to_owned();
        let start = home.scenario().calendar.local(RunTime::START).datetime().to_string();
        if let RunStart::At(at) = &self.start
            && *at != start
        {
            return Err(Failure::asked(LiveMessage::Start { folder, start }));
        }
        match self.variant.seed {
            Some(seed) if seed != home.seed() => Err(Failure::asked(LiveMessage::Seed { folder, seed: home.seed() })),
            _ => Ok(()),
        }
    }
}

/// The folder and the start of a home. A start in the future comes with the time until then, as clocks may differ.
fn start_message(home: &LiveHome, folder: &Path) -> String {
    let verb = if home.is_resumed() { "resumes" } else { "starts" };
    let calendar = &home.scenario().calendar;
    match future_start(calendar) {
        None => format!("{verb} in {}; simulated from {}", folder.display(), calendar.wall_clock(RunTime::START)),
        Some(ahead) => format!("{verb} in {}; simulated from {ahead}", folder.display()),
    }
}

struct LiveProgress<'m> {
    bar: ProgressBar,
    meters: &'m RunMetrics,
    updated: Instant,
}

/// Interval between two updates of the progress.
const LOOK: Duration = Duration::from_millis(500);

impl<'m> LiveProgress<'m> {
    fn new(is_quiet: bool, meters: &'m RunMetrics) -> LiveProgress<'m> {
        let bar = on_terminal(is_quiet, None, "{spinner} {msg}");
        LiveProgress { bar, meters, updated: Instant::now() }
    }

    fn update(&mut self) {
        if self.bar.is_hidden() || self.updated.elapsed() < LOOK {
            return;
        }
        self.updated = Instant::now();
        let reading = self.meters.read();
        let Some(now) = reading.now else { return };
        let behind = (UtcTime::from(Timestamp::now()) - UtcTime::from(now)).seconds();
        let places = reading.destinations.iter().map(|(place, meter)| {
            let away = if meter.is_away {
                format!(" (unavailable, {} kB spooled)", meter.spooled_bytes / 1000)
            } else {
                String::new()
            };
            format!("{place} {} rows{away}", meter.rows)
        });
        let places: Vec<String> = places.collect();
        self.bar.set_message(format!("{now:.0}  {behind:.2} s behind  {}", places.join("  ")));
        self.bar.tick();
    }
}
