//! Living a run: advancing it at its pace, handing what happens to the logs, telling people how far it is.

use super::{print_json, print_text};
use crate::failure::Failure;
use crate::pace::{Pace, Speed};
use homebody_core::event::Events;
use homebody_core::recording::{Recording, Seal};
use homebody_core::run::Run;
use homebody_core::scenario::load::Scenario;
use homebody_core::time::{Micros, SECOND, seconds};
use homebody_log::truth::Names;
use homebody_log::{Logger, RunInfo, Stored, TruthLog, Url};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use serde_json::json;
use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// Where a run goes, and how much it says.
#[derive(clap::Args)]
pub struct Output {
    /// Write the log here: sqlite:FILE, csv:FILE or casas:FILE; may be given several times
    #[arg(long, value_name = "URL")]
    out: Vec<Url>,
    /// Write the ground truth into this SQLite file
    #[arg(long, value_name = "FILE")]
    truth: Option<PathBuf>,
    /// Replace files that exist
    #[arg(long)]
    force: bool,
    /// Say nothing but errors
    #[arg(long)]
    quiet: bool,
    /// Print the summary as one JSON object on standard output
    #[arg(long)]
    json: bool,
}

/// A run that is about to be lived.
pub struct Live<'a> {
    pub scenario: &'a Scenario,
    /// What to record, or, if it has a seal already, to be the same as.
    pub recording: Recording,
    pub record: Option<PathBuf>,
    pub output: Output,
}

/// The files of a run.
struct Places {
    log: Vec<Url>,
    truth: Option<PathBuf>,
    recording: Option<PathBuf>,
    /// The folder made for the run.
    folder: Option<PathBuf>,
}

impl Live<'_> {
    /// Lives the run to its end, or until it is told to stop.
    pub fn live(mut self, mut run: Run, speed: Speed, control: bool) -> Result<(), Failure> {
        let places = self.places()?;
        let lived = self.live_into(&places, &mut run, speed, control);
        if let (Err(_), Some(folder)) = (&lived, &places.folder) {
            // Gone if nothing is in it; what was stored before an error stays.
            let _ = fs::remove_dir(folder);
        }
        let (seal, stored, started) = lived?;
        self.finish(&places, &run, &seal, &stored, started)
    }

    fn live_into(
        &self,
        places: &Places,
        run: &mut Run,
        speed: Speed,
        control: bool,
    ) -> Result<(Seal, Stored, Instant), Failure> {
        let stop = stop_on_signal();
        let (mut logger, mut truth) = self.open(places, run)?;
        let progress = self.progress(run.length());
        let mut pace = Pace::new(speed, control);
        let mut seal = Seal::default();
        let mut events = Events::default();
        let started = Instant::now();
        while run.now() < run.length() && !stop.load(Ordering::Relaxed) {
            let Some(until) = pace.next(run.now()) else { break };
            run.advance(until, &mut events);
            seal.add(&events.firings);
            logger.store(&events.firings, run.now())?;
            if let Some(truth) = &mut truth {
                truth.store(&events)?;
            }
            events.clear();
            progress.set_position(run.now() as u64 / SECOND as u64);
        }
        progress.finish_and_clear();
        let stored = logger.finish()?;
        if let Some(truth) = truth {
            truth.finish(run.now())?;
        }
        Ok((seal, stored, started))
    }

    /// Decides which files to write; makes the run's folder if it needs one.
    fn places(&self) -> Result<Places, Failure> {
        let mut places = Places {
            log: self.output.out.clone(),
            truth: self.output.truth.clone(),
            recording: self.record.clone(),
            folder: None,
        };
        if places.log.is_empty() {
            let folder = new_folder(Path::new("runs"), &self.scenario.file.name)?;
            let to = &self.scenario.logger.to;
            let default = [String::from("sqlite:log.db")];
            for url in if to.is_empty() { &default[..] } else { to } {
                places.log.push(url.parse::<Url>().map_err(Failure::usage)?.within(&folder));
            }
            places.truth.get_or_insert_with(|| folder.join("truth.db"));
            places.recording.get_or_insert_with(|| folder.join("recording.json"));
            places.folder = Some(folder);
        }
        match &places.recording {
            Some(path) if path.exists() && !self.output.force => {
                Err(Failure::Io(format!("{} exists already\n  hint: --force replaces it", path.display())))
            }
            _ => Ok(places),
        }
    }

    fn open(&self, places: &Places, run: &Run) -> Result<(Logger, Option<TruthLog>), Failure> {
        let sensors: Vec<String> = run.home().sensors.iter().map(|sensor| sensor.name.clone()).collect();
        let rooms: Vec<String> = run.home().plan.rooms.iter().map(|room| room.name.clone()).collect();
        let residents: Vec<String> = self.scenario.residents.iter().map(|one| one.file.name.clone()).collect();
        let Scenario { file, logger, calendar, .. } = self.scenario;
        let info = RunInfo {
            id: 1,
            scenario: file.name.clone(),
            seed: self.recording.seed,
            version: self.recording.version.clone(),
        };
        let force = self.output.force;
        let log = Logger::open(&places.log, logger, &sensors, calendar, &info, force)?;
        let names = Names { residents: &residents, rooms: &rooms, sensors: &sensors };
        let truth = places.truth.as_ref();
        let truth = truth.map(|path| TruthLog::open(path, &places.log, logger, names, calendar, &info, force));
        Ok((log, truth.transpose()?))
    }

    /// A bar that shows how far the run is, where somebody looks.
    fn progress(&self, length: Micros) -> ProgressBar {
        let hidden = self.output.quiet || self.output.json;
        let target = if hidden { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
        let style = ProgressStyle::with_template("{bar:40} {percent:>3} %  {msg}  {eta} left");
        let style = style.unwrap_or_else(|_| ProgressStyle::default_bar());
        let bar = ProgressBar::with_draw_target(Some(length as u64 / SECOND as u64), target).with_style(style);
        bar.with_message(format!("of {}", span_in_words(length)))
    }

    /// Writes the recording, and tells people and scripts what has become of the run.
    fn finish(
        &mut self,
        places: &Places,
        run: &Run,
        seal: &Seal,
        stored: &Stored,
        started: Instant,
    ) -> Result<(), Failure> {
        let whole = run.now() == self.recording.length_us;
        let was = std::mem::replace(&mut self.recording.sha256, seal.hex());
        (self.recording.firings, self.recording.length_us) = (seal.firings(), run.now());
        if let Some(path) = &places.recording {
            let text = serde_json::to_string_pretty(&self.recording).map_err(Failure::usage)? + "\n";
            fs::write(path, text).map_err(|error| Failure::io(path, error))?;
        }
        let replayed = !was.is_empty() && whole;
        if self.output.json {
            print_json(&json!({
                "scenario": self.scenario.file.name,
                "seed": self.recording.seed,
                "simulated_s": seconds(run.now()),
                "took_s": started.elapsed().as_secs_f64(),
                "firings": seal.firings(),
                "sha256": seal.hex(),
                "rows": stored.rows,
                "rows_by_sensor": self.by_sensor(run, stored).map(|(name, rows)| (name.into(), rows.into()))
                    .collect::<serde_json::Map<String, serde_json::Value>>(),
                "log": stored.places.iter().map(Url::to_string).collect::<Vec<_>>(),
                "truth": places.truth,
                "recording": places.recording,
            }))?;
        } else if !self.output.quiet {
            print_text(&self.summary(places, run, seal, stored, started))?;
        }
        if replayed && was != seal.hex() {
            return Err(Failure::Usage(format!(
                "the replay differs from the recording: it was made by version {}\n  hint: replay it with that version",
                self.recording.version
            )));
        }
        Ok(())
    }

    fn by_sensor<'s>(&self, run: &'s Run, stored: &'s Stored) -> impl Iterator<Item = (&'s str, u64)> {
        run.home().sensors.iter().map(|sensor| sensor.name.as_str()).zip(stored.by_sensor.iter().copied())
    }

    fn summary(&self, places: &Places, run: &Run, seal: &Seal, stored: &Stored, started: Instant) -> String {
        let took = started.elapsed().as_secs_f64();
        let mut text = format!(
            "{}: {} lived in {took:.2} s, seed {}\n\n",
            self.scenario.file.name,
            span_in_words(run.now()),
            self.recording.seed
        );
        let most = stored.by_sensor.iter().copied().max().unwrap_or(0).max(1);
        let width = self.by_sensor(run, stored).map(|(name, _)| name.chars().count()).max().unwrap_or(0);
        for (name, rows) in self.by_sensor(run, stored) {
            let bar = "█".repeat((rows * 30).div_ceil(most) as usize);
            text += &format!("  {name:width$} {rows:>8}  {bar}\n");
        }
        text += &format!("  {:width$} {:>8}\n\n", "all", stored.rows);
        for url in &stored.places {
            text += &format!("log        {url}\n");
        }
        for (what, path) in [("truth", &places.truth), ("recording", &places.recording)] {
            if let Some(path) = path {
                text += &format!("{what:10} {}\n", path.display());
            }
        }
        text + &format!("firings    {} with SHA-256 {}\n", seal.firings(), seal.hex())
    }
}

/// A new folder under `parent`, named after the scenario and numbered.
fn new_folder(parent: &Path, name: &str) -> Result<PathBuf, Failure> {
    fs::create_dir_all(parent).map_err(|error| Failure::io(parent, error))?;
    let plain: String = name.chars().map(|c| if c.is_alphanumeric() { c.to_ascii_lowercase() } else { '-' }).collect();
    let words: Vec<&str> = plain.split('-').filter(|word| !word.is_empty()).collect();
    for number in 1.. {
        let folder = parent.join(format!("{}-{number}", words.join("-")));
        match fs::create_dir(&folder) {
            Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
            Err(error) => return Err(Failure::io(&folder, error)),
            Ok(()) => return Ok(folder),
        }
    }
    unreachable!("there is always a next number")
}

/// A flag that the first interrupt sets; the second ends the program at once.
fn stop_on_signal() -> Arc<AtomicBool> {
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

fn span_in_words(span: Micros) -> String {
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
