//! Runs: progress and results.

use super::check::tell_remark;
use super::early_warnings::{EarlyWarnings, MOST_DIFFERENCES};
use super::replacing::Replacing;
use super::run_messages::{ReplayMessage, RunMessage};
use crate::failure::Failure;
use crate::print::{ResultMessage, counted, grouped, print_json, print_text, tell, tell_message, warn};
use crate::progress::bar_unless;
use crate::signals::Signals;
use homebody_core::calendar::Calendar;
use homebody_core::messages::Diagnose;
use homebody_core::problem::Diagnostic;
use homebody_core::recording::Recording;
use homebody_core::scenario::scheme::{NoPlace, Scheme, SchemeRow};
use homebody_core::time::{DAY, HOUR, MINUTE, RunTime, SECOND, Span, UtcTime};
use homebody_log::LogError;
use homebody_log::files::open::log_beside;
use homebody_simulation::{
    Destinations, RunProgress, RunSummary, Simulation, SimulationError, Treatment, Url, VERSION, WhenDown,
    difference_warnings, shortened,
};
use indicatif::ProgressBar;
use jiff::Timestamp;
use serde_json::json;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// The destinations of a run, and what it prints.
#[derive(clap::Args)]
#[command(next_help_heading = "Output")]
pub struct Output {
    /// Write the log here: log.db, week.csv, jsonl:-, a server (homebody convert --help lists all forms); repeatable
    #[arg(short, long, value_name = "DESTINATION")]
    pub out: Vec<Url>,
    /// Write the ground truth here: an SQLite file, a server, or csv:FILE and so on with a file for each table
    #[arg(long, value_name = "DESTINATION", value_parser = truth_place)]
    pub truth: Option<Url>,
    #[command(flatten)]
    pub away: Away,
    #[command(flatten)]
    pub replacing: Replacing,
    /// Print warnings and errors only
    #[arg(short, long)]
    pub quiet: bool,
    /// Print the result as one JSON object on standard output
    #[arg(long)]
    pub json: bool,
}

impl Output {
    pub fn progress(&self, length: Span) -> ProgressBar {
        bar_unless(self.quiet || self.json, length.micros() as u64, "{bar:40} {percent:>3} %  {msg}  {eta} left")
    }
}

/// The options for unavailable destinations.
#[derive(clap::Args)]
#[command(next_help_heading = "Unavailable destinations")]
pub struct Away {
    /// Action while a server is unavailable
    ///
    /// A program that reads standard output counts as a server.
    #[arg(long, value_name = "ACTION", value_enum, default_value_t)]
    on_unavailable: OnUnavailable,
    /// Folder for rows that wait for a server, with --on-unavailable spool
    #[arg(long, value_name = "FOLDER", default_value = "spool")]
    spool: PathBuf,
    /// Largest size of the rows stored for each server, in MB; at this limit the run stops, and you can resume it
    #[arg(long, value_name = "MB", default_value_t = 1024)]
    spool_mb: u64,
    #[command(flatten)]
    deadline: DestinationTimeout,
}

/// The longest answer time of a destination.
#[derive(clap::Args)]
#[command(next_help_heading = "Unavailable destinations")]
pub struct DestinationTimeout {
    /// Treat a server as unavailable if one request takes longer than this: 500ms, 10s or 2m
    ///
    /// A program that reads standard output counts as a server.
    #[arg(long, value_name = "DURATION", value_parser = timeout, default_value = "10s")]
    destination_timeout: Duration,
}

impl DestinationTimeout {
    pub fn within(&self) -> Duration {
        self.destination_timeout
    }
}

pub fn timeout(text: &str) -> Result<Duration, String> {
    const UNITS: [(&str, f64); 4] = [("ms", 0.001), ("s", 1.0), ("m", 60.0), ("h", 3600.0)];
    let hint = || "write a duration from 100ms to 1h, such as 10s".to_owned();
    let unit = UNITS.iter().find_map(|(unit, seconds)| Some((text.strip_suffix(unit)?, seconds)));
    let (number, seconds) = unit.ok_or_else(hint)?;
    let number = number.trim().parse::<f64>().ok().filter(|number| number.is_finite()).ok_or_else(hint)?;
    let span = number * seconds;
    if (0.1..=3600.0).contains(&span) { Ok(Duration::from_secs_f64(span)) } else { Err(hint()) }
}

#[derive(Clone, Copy, Default, PartialEq, clap::ValueEnum)]
enum OnUnavailable {
    /// End the run with an error
    #[default]
    Error,
    /// Wait until the server answers, for a day at most
    Retry,
    /// Store rows on disk, and send them once the server answers
    Spool,
}

/// Longest wait for a server (our choice): to wait longer, stop the run and resume it later.
const RETRY_FOR: Duration = Duration::from_secs(86_400);

impl Away {
    /// The same options for the library. Creates the folder of spooled rows.
    pub fn treatment(&self) -> Result<Treatment, Failure> {
        let when_down = match self.on_unavailable {
            OnUnavailable::Error => WhenDown::Error,
            OnUnavailable::Retry => WhenDown::Retry(RETRY_FOR),
            OnUnavailable::Spool => {
                std::fs::create_dir_all(&self.spool).map_err(|error| LogError::file(&self.spool, error))?;
                WhenDown::Spool(self.spool.clone(), self.spool_mb.saturating_mul(1 << 20))
            }
        };
        Ok(Treatment { when_down, answers_within: Some(self.deadline.within()), ..Treatment::default() })
    }
}

/// Refuses files: a resumed run continues its folder, servers and object stores, and another file would lack its first rows.
pub fn check_destinations(out: &[Url]) -> Result<(), Failure> {
    let Some(file) = out.iter().find(|url| url.server().is_none() && !url.is_in_store()) else { return Ok(()) };
    Err(Failure::asked(RunMessage::MiddleOfRun { place: file.to_string(), is_truth: false }))
}

/// Simulates a run to its end or until it is stopped, and prints the result.
///
/// The result has the differences of the whole run, so early warnings of its first days are of use only before its end.
pub fn store(
    run: Simulation,
    record: Option<PathBuf>,
    output: &Output,
    signals: &Signals,
    early: Option<EarlyWarnings>,
) -> Result<(), Failure> {
    let Output { out, truth, replacing, away, .. } = output;
    let to = Destinations {
        log: out.clone(),
        truth: truth.clone(),
        recording: record,
        replace: replacing.force,
        replace_rows: replacing.replace_rows,
        servers: away.treatment()?,
        ..Destinations::default()
    };
    if output.json && out.iter().any(Url::is_output) {
        return Err(Failure::asked(ResultMessage::StandardOutput { what: "result" }));
    }
    let name = run.scenario().file.name.clone();
    let progress = output.progress(run.progress().length);
    let summary = run.store(&to, |done| {
        show(&progress, Span::ZERO, done);
        early.iter().for_each(|early| early.tell_soon(&progress));
    });
    progress.finish_and_clear();
    let summary = summary.map_err(|error| failure(error, resume_command, signals))?;
    report(&name, &summary, output)?;
    signals.ended(summary.is_stopped())
}

/// Updates a progress bar; `before` was simulated before this program began.
pub fn show(progress: &ProgressBar, before: Span, RunProgress { done, length }: RunProgress) {
    if !progress.is_hidden() {
        progress.set_position(done.micros() as u64);
        let speed = speed_in_words(done - before, progress.elapsed());
        progress.set_message(format!("{} of {}, {speed}", span_in_words(done), span_in_words(length)));
    }
}

pub fn report(name: &str, summary: &RunSummary, output: &Output) -> Result<(), Failure> {
    let RunSummary { recording, stored, truth, recorded, progress, agrees, before, took, .. } = summary;
    let Recording { firings, sha256, .. } = recording;
    let path = |path: &Option<PathBuf>| path.as_ref().map(|path| path.display().to_string());
    if output.json {
        print_json(&json!({
            "scenario": name,
            "seed": recording.seed,
            "simulated_s": progress.done.seconds(),
            "stopped": summary.is_stopped(),
            "took_s": took.as_secs_f64(),
            "firings": firings,
            "sha256": sha256,
            "sentences": summary.differences,
            "agrees_with_recording": agrees,
            "rows": stored.rows,
            "rows_by_sensor": summary.rows_by_sensor().map(|(name, rows)| (name.into(), rows.into()))
                .collect::<serde_json::Map<String, serde_json::Value>>(),
            "log": stored.places,
            "truth": truth.as_ref().map(truth_text),
            "recording": path(recorded),
            "folder": path(&summary.folder),
        }))?;
    } else if !output.quiet {
        let text = summary_text(name, summary);
        // Rows on standard output stay alone there.
        match output.out.iter().any(Url::is_output) {
            true => tell(text.trim_end()),
            false => print_text(&text)?,
        }
    }
    if !output.json {
        let days = |span: Span| span.ratio(DAY);
        let warnings = difference_warnings(&summary.differences, days(progress.done), days(progress.length));
        shortened(warnings, MOST_DIFFERENCES).iter().for_each(tell_remark);
    }
    if !output.quiet {
        stored
            .places
            .iter()
            .filter_map(|place| place.parse().ok())
            .chain(truth.clone())
            .for_each(|url| warn_of_reader(&url));
    }
    let Some(before) = before.as_ref().filter(|_| *agrees == Some(false)) else { return Ok(()) };
    let (events, recorded) = (*firings, before.firings);
    Err(Failure::asked(match before.version.as_str() {
        VERSION => ReplayMessage::Differs { events, recorded },
        version => ReplayMessage::OtherVersion { version: version.to_owned(), events, recorded },
    }))
}

/// Warns of a program that reads a complete database, which then has a part in a second file.
fn warn_of_reader(place: &Url) {
    if let (Scheme::Sqlite, Some(file)) = (place.scheme(), place.file())
        && let Some(beside) = log_beside(file)
    {
        warn(RunMessage::OpenDatabase { file: file.to_owned(), part: beside });
    }
}

fn summary_text(name: &str, summary: &RunSummary) -> String {
    let RunSummary { recording, stored, truth, recorded, progress, agrees, took, .. } = summary;
    let span = match summary.is_stopped() {
        true => format!("stopped after {} of {}", span_in_words(progress.done), span_in_words(progress.length)),
        false => format!("simulated {}", span_in_words(progress.done)),
    };
    let (took, seed) = (took.as_secs_f64(), recording.seed);
    let mut text = format!("{name}: {span} in {took:.2} s, seed {seed}\n\n");
    let most = stored.by_sensor.iter().copied().max().unwrap_or(0).max(1);
    let width = summary.rows_by_sensor().map(|(name, _)| name.chars().count()).max().unwrap_or(0);
    for (name, rows) in summary.rows_by_sensor() {
        let bar = "█".repeat((rows * 30).div_ceil(most) as usize);
        text += &format!("  {name:width$} {:>9}  {bar}\n", grouped(rows));
    }
    text += &format!("  {:width$} {:>9}\n\n", "rows", grouped(stored.rows));
    for url in &stored.places {
        text += &format!("log        {url}\n");
    }
    let recorded = recorded.as_ref().map(|path| path.display().to_string());
    for (what, place) in [("truth", truth.as_ref().map(truth_text)), ("recording", recorded)] {
        if let Some(place) = place {
            text += &format!("{what:10} {place}\n");
        }
    }
    for (place, error) in &stored.failed {
        text += &format!("failed     {place}: {error}\n");
    }
    text += &format!("events     {}, SHA-256 {}\n", grouped(recording.firings), recording.sha256);
    if *agrees == Some(true) {
        text += "replay     identical to the recording, event by event\n";
    }
    match &summary.folder {
        _ if !summary.is_stopped() => {}
        Some(folder) => text += &resume_line(folder),
        None => text += "resume     not possible: only a run without --out has a folder to resume\n",
    }
    text
}

/// The destination of a ground truth: by its form, by its extension, or an SQLite file.
fn truth_place(text: &str) -> Result<Url, String> {
    let is_kind = |(scheme, _): (&str, &str)| SchemeRow::named(scheme).is_some();
    match text.contains("://") || text.split_once(':').is_some_and(is_kind) {
        true => text.parse().map_err(|error: NoPlace| error.to_string()),
        false => Ok(text.parse().unwrap_or_else(|_| Url::new(Scheme::Sqlite, text))),
    }
}

/// A ground truth as a user writes it: a database by its path alone.
fn truth_text(truth: &Url) -> String {
    match (truth.scheme(), truth.file()) {
        (Scheme::Sqlite, Some(file)) => file.display().to_string(),
        _ => truth.to_string(),
    }
}

/// The last line of the result of a stopped run or cohort: the command that resumes it.
pub fn resume_line(folder: &Path) -> String {
    format!("resume     {}\n", resume_command(folder))
}

pub fn resume_command(folder: &Path) -> String {
    format!("homebody run --resume {}", folder.display())
}

/// The failure of an error. If a signal stopped the run while a server was unavailable, it prints the error and returns the signal's failure.
/// `resume` makes the command that resumes the run.
pub fn failure(error: SimulationError, resume: impl Fn(&Path) -> String, signals: &Signals) -> Failure {
    match (&error, signals.ended(true)) {
        (SimulationError::StoppedAway { folder, .. }, Err(signal)) => {
            let hint = |folder: &Path| format!("{} resumes the run once the server answers", resume(folder));
            let message = error.diagnostic();
            let hint = folder.as_deref().map(hint).or_else(|| message.hint.clone());
            tell_message(&Diagnostic { hint, ..message });
            signal
        }
        _ => error.into(),
    }
}

/// The speed: a factor as `--speed` has it, or above those the simulated time per second.
pub fn speed_in_words(simulated: Span, took: Duration) -> String {
    match simulated.seconds() / took.as_secs_f64() {
        times if times < 1050.0 => format!("{times:.0} times real time"),
        times => format!("{} per second", span_in_words(SECOND.share(times))),
    }
}

pub fn span_in_words(span: Span) -> String {
    let count = |unit: Span, name: &str| {
        let rounded = format!("{:.1}", span.ratio(unit));
        let number = rounded.trim_end_matches(".0");
        format!("{number} {name}{}", if number == "1" { "" } else { "s" })
    };
    match span / SECOND {
        0..120 => count(SECOND, "second"),
        120..7200 => count(MINUTE, "minute"),
        7200..172_800 => count(HOUR, "hour"),
        _ => count(DAY, "day"),
    }
}

/// The start of a home that lies in the future, the time until then, and the home's clock; None if the home has started.
pub fn future_start(calendar: &Calendar) -> Option<String> {
    let now = Timestamp::now();
    let ahead = UtcTime::from(calendar.timestamp(RunTime::START)) - UtcTime::from(now);
    let clock =
        now.to_zoned(calendar.local(RunTime::START).time_zone().clone()).strftime("%Y-%m-%d %H:%M:%S %Z").to_string();
    let since = calendar.wall_clock(RunTime::START);
    (ahead >= SECOND).then(|| format!("{since}, in {}; the home's clock shows {clock}", span_in_words(ahead)))
}

/// True of a resumed run that stopped before it had caught up: its folder is unchanged.
pub fn is_unchanged(error: &SimulationError) -> bool {
    matches!(error, SimulationError::Log(LogError::NotYet { .. }))
}

pub fn report_live(name: &str, folder: &Path, summary: &RunSummary) {
    let rows = summary.stored.rows;
    tell(format_args!(
        "{name}: simulated {}, {}, in {}",
        span_in_words(summary.progress.done),
        counted(rows, "row", "rows"),
        folder.display()
    ));
    summary.stored.failed.iter().for_each(|(place, error)| tell(format_args!("failed     {place}: {error}")));
}
