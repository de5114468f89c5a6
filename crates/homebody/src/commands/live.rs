//! Living a run: advancing it at its pace, handing what happens to the logs, telling people how far it is.

use crate::failure::Failure;
use crate::pace::{Asked, Pace};
use crate::print::{print_json, print_text};
use homebody_core::event::Events;
use homebody_core::recording::Recording;
use homebody_core::run::Run;
use homebody_core::scenario::load::Scenario;
use homebody_core::scenario::scheme::{NoPlace, SCHEMES, Scheme};
use homebody_core::time::{Micros, SECOND, seconds};
use homebody_log::{How, Places, RunLog, Stored, Url};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use serde_json::json;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Where a run goes, and how much it says.
#[derive(clap::Args)]
pub struct Output {
    /// Write the log here: sqlite:FILE, csv:FILE or casas:FILE; may be given several times
    #[arg(long, value_name = "URL")]
    pub out: Vec<Url>,
    /// Write the ground truth into this SQLite file, or to csv:FILE, with a file for each table
    #[arg(long, value_name = "FILE", value_parser = truth_place)]
    pub truth: Option<Url>,
    /// Replace files that exist
    #[arg(long)]
    pub force: bool,
    /// Say nothing but errors
    #[arg(long)]
    pub quiet: bool,
    /// Print the summary as one JSON object on standard output
    #[arg(long)]
    pub json: bool,
}

impl Output {
    /// A bar that shows how far the run is, where somebody looks.
    pub fn progress(&self, length: Micros) -> ProgressBar {
        let hidden = self.quiet || self.json;
        let target = if hidden { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
        let style = ProgressStyle::with_template("{bar:40} {percent:>3} %  {msg}  {eta} left");
        let style = style.unwrap_or_else(|_| ProgressStyle::default_bar());
        ProgressBar::with_draw_target(Some(length as u64), target).with_style(style)
    }
}

/// A run that is about to be lived.
pub struct Live<'a> {
    pub scenario: &'a Scenario,
    /// What to record, or, if it has a seal already, to be the same as.
    pub recording: Recording,
    pub record: Option<PathBuf>,
    pub output: Output,
    /// The files that the run comes from, which nothing replaces.
    pub sources: Vec<PathBuf>,
}

/// What has become of a run.
pub struct Lived {
    /// As it was lived: its length is where it was stopped.
    pub recording: Recording,
    pub stored: Stored,
    took: Duration,
}

impl Live<'_> {
    /// Lives the run to its end, or until it is told to stop.
    pub fn live(self, mut run: Run, pace: &Asked) -> Result<(), Failure> {
        let Output { out, truth, force, .. } = &self.output;
        let (out, truth, record) = (out.clone(), truth.clone(), self.record.clone());
        let places = Places::find(out, truth, record, self.scenario, &self.sources, *force)?;
        let progress = self.output.progress(run.length());
        let lived = self.live_into(&places, &mut run, Pace::new(pace, stop_on_signal()), &progress);
        progress.finish_and_clear();
        match lived {
            Ok(lived) => self.report(&places, &run, &lived),
            Err(failure) => {
                // What was stored before the failure stays.
                places.give_up();
                Err(failure)
            }
        }
    }

    /// Lives the run into files, and adds to the progress what has been lived.
    pub fn live_into(
        &self,
        places: &Places,
        run: &mut Run,
        pace: Pace,
        progress: &ProgressBar,
    ) -> Result<Lived, Failure> {
        let started = Instant::now();
        let recording = Recording { version: VERSION.into(), ..self.recording.clone() };
        let how = if self.output.force { How::Replace } else { How::New };
        let mut log = RunLog::open(places, self.scenario, run, &recording, how)?;
        advance(run, pace, &mut log, progress)?;
        let (stored, recording) = log.finish(run, recording)?;
        Ok(Lived { recording, stored, took: started.elapsed() })
    }

    /// Tells people and scripts what has become of the run.
    fn report(&self, places: &Places, run: &Run, lived: &Lived) -> Result<(), Failure> {
        let Lived { recording, stored, took } = lived;
        let stopped = run.now() < run.length();
        let is_replay = !self.recording.sha256.is_empty();
        let same = (self.recording.sha256 == recording.sha256) && (self.recording.firings == recording.firings);
        let agrees = (is_replay && !stopped).then_some(same);
        if self.output.json {
            print_json(&json!({
                "scenario": self.scenario.file.name,
                "seed": recording.seed,
                "simulated_s": seconds(run.now()),
                "stopped": stopped,
                "took_s": took.as_secs_f64(),
                "firings": recording.firings,
                "sha256": recording.sha256,
                "agrees_with_recording": agrees,
                "rows": stored.rows,
                "rows_by_sensor": self.by_sensor(run, stored).map(|(name, rows)| (name.into(), rows.into()))
                    .collect::<serde_json::Map<String, serde_json::Value>>(),
                "log": stored.places,
                "truth": places.truth.as_ref().map(told),
                "recording": places.recording.as_ref().map(|path| path.display().to_string()),
            }))?;
        } else if !self.output.quiet {
            print_text(&self.summary(places, run, lived, agrees))?;
        }
        if agrees != Some(false) {
            return Ok(());
        }
        let (by, hint) = match self.recording.version.as_str() {
            VERSION => (String::new(), "the recording is not as the run wrote it".to_owned()),
            version => (format!(", which version {version} made"), "replay it with that version".to_owned()),
        };
        let (theirs, ours) = (self.recording.firings, recording.firings);
        Err(Failure::Usage(format!(
            "the replay differs from the recording{by}: {ours} firings, and {theirs} in the recording\n  hint: {hint}"
        )))
    }

    fn by_sensor<'s>(&self, run: &'s Run, stored: &'s Stored) -> impl Iterator<Item = (&'s str, u64)> {
        run.sensors().iter().map(|sensor| sensor.name.as_str()).zip(stored.by_sensor.iter().copied())
    }

    fn summary(&self, places: &Places, run: &Run, lived: &Lived, agrees: Option<bool>) -> String {
        let Lived { recording, stored, took } = lived;
        let span = match run.now() < run.length() {
            true => format!("stopped after {} of {},", span_in_words(run.now()), span_in_words(run.length())),
            false => span_in_words(run.now()),
        };
        let (name, took, seed) = (&self.scenario.file.name, took.as_secs_f64(), recording.seed);
        let mut text = format!("{name}: {span} lived in {took:.2} s, seed {seed}\n\n");
        let most = stored.by_sensor.iter().copied().max().unwrap_or(0).max(1);
        let width = self.by_sensor(run, stored).map(|(name, _)| name.chars().count()).max().unwrap_or(0);
        for (name, rows) in self.by_sensor(run, stored) {
            let bar = "█".repeat((rows * 30).div_ceil(most) as usize);
            text += &format!("  {name:width$} {rows:>8}  {bar}\n");
        }
        text += &format!("  {:width$} {:>8}\n\n", "rows", stored.rows);
        for url in &stored.places {
            text += &format!("log        {url}\n");
        }
        let recording_at = places.recording.as_ref().map(|path| path.display().to_string());
        for (what, place) in [("truth", places.truth.as_ref().map(told)), ("recording", recording_at)] {
            if let Some(place) = place {
                text += &format!("{what:10} {place}\n");
            }
        }
        text += &format!("firings    {} with SHA-256 {}\n", recording.firings, recording.sha256);
        if agrees == Some(true) {
            text += "replay     the same as the recording, firing by firing\n";
        }
        text
    }
}

/// The place of a truth: a database where no kind is said.
fn truth_place(text: &str) -> Result<Url, String> {
    let is_kind = |(scheme, _): (&str, &str)| SCHEMES.iter().any(|row| row.name == scheme);
    match text.split_once(':').is_some_and(is_kind) {
        true => text.parse().map_err(|error: NoPlace| error.to_string()),
        false => Ok(Url::new(Scheme::Sqlite, text)),
    }
}

/// A database by its path alone, as it may be asked for.
fn told(truth: &Url) -> String {
    match (truth.scheme(), truth.file()) {
        (Scheme::Sqlite, Some(file)) => file.display().to_string(),
        _ => truth.to_string(),
    }
}

/// Lets the run go at its pace, and hands what happens to the logs.
fn advance(run: &mut Run, mut pace: Pace, log: &mut RunLog, progress: &ProgressBar) -> Result<(), Failure> {
    let mut events = Events::default();
    while run.now() < run.length() {
        let before = run.now();
        let Some(until) = pace.next(before) else { break };
        let lived = run.advance(until, &mut events);
        log.store(run, &events)?;
        lived?;
        events.clear();
        if !progress.is_hidden() {
            progress.inc((run.now() - before) as u64);
            let (lived, all) = (progress.position() as Micros, progress.length().unwrap_or(0) as Micros);
            let speed = speed_in_words(lived, progress.elapsed());
            progress.set_message(format!("{} of {}, {speed}", span_in_words(lived), span_in_words(all)));
        }
    }
    Ok(())
}

/// A flag that the first interrupt sets; the second ends the program at once.
pub fn stop_on_signal() -> Arc<AtomicBool> {
    let stop = Arc::new(AtomicBool::new(false));
    let set = stop.clone();
    // Without a handler an interrupt just ends the program, which loses nothing that was committed.
    let _ = ctrlc::set_handler(move || {
        if set.swap(true, Ordering::Relaxed) {
            std::process::exit(130);
        }
    });
    stop
}

/// How fast it goes: as a pace that one may ask for, or beyond those in what goes by in a second.
pub fn speed_in_words(lived: Micros, took: Duration) -> String {
    match seconds(lived) / took.as_secs_f64() {
        times if times < 1050.0 => format!("{times:.0} times as fast as life"),
        times => format!("{} a second", span_in_words((times * SECOND as f64) as Micros)),
    }
}

pub fn span_in_words(span: Micros) -> String {
    let of = |unit: Micros, name: &str| {
        let count = span as f64 / (unit * SECOND) as f64;
        let rounded = format!("{count:.1}");
        let count = rounded.trim_end_matches(".0");
        format!("{count} {name}{}", if count == "1" { "" } else { "s" })
    };
    match span / SECOND {
        0..120 => of(1, "second"),
        120..7200 => of(60, "minute"),
        7200..172_800 => of(3600, "hour"),
        _ => of(86_400, "day"),
    }
}
