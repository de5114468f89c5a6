//! `homebody storyboard`: moments of a recorded run side by side.

use super::messages::MomentMessage;
use super::result_output::ResultOutput;
use crate::failure::Failure;
use homebody_analysis::strip::{RunNames, StripRecorder};
use homebody_core::calendar::Calendar;
use homebody_core::time::{Interval, RunTime, Span};
use homebody_log::run::places::RECORDING;
use homebody_picture::film_strip;
use homebody_simulation::RecordedRun;
use homebody_simulation::run_length::span;
use std::path::PathBuf;

/// Draw moments of a run as a strip of pictures
///
/// Homebody replays the run. Each picture shows the residents, their paths, the furniture that they used and the sensors that fired.
#[derive(clap::Args)]
#[command(after_long_help = "Examples:
  homebody storyboard runs/dark-hall-1 18:40 --every 5s --png strip.png
  homebody storyboard runs/tigerplace-1 2009-03-03T07:00 --every 30s --frames 9 --png morning.png")]
pub struct StoryboardArguments {
    /// Run folder, or its recording
    run: PathBuf,
    /// First moment: a date and time such as 2026-01-12T18:40:05, or a time in the first 24 hours of the run
    #[arg(value_name = "FROM")]
    from: String,
    /// Time between two pictures
    #[arg(long, value_name = "DURATION", default_value = "10s", value_parser = span)]
    every: Span,
    /// Number of pictures
    #[arg(long, value_name = "N", default_value_t = 6, value_parser = clap::value_parser!(u8).range(1..=60))]
    frames: u8,
    #[command(flatten)]
    output: ResultOutput,
}

impl StoryboardArguments {
    pub fn run(self) -> Result<(), Failure> {
        let path = if self.run.is_dir() { self.run.join(RECORDING) } else { self.run.clone() };
        let output = self.output.check([""], std::slice::from_ref(&path))?;
        let recorded = RecordedRun::open(&path)?;
        let home = recorded.scenario().home.clone();
        let calendar = recorded.scenario().calendar.clone();
        let whole = Interval::starting(RunTime::START, recorded.recording().length_us);
        let first = self.first(&calendar, whole)?;
        let fits = (whole.end - first - Span::MICROSECOND) / self.every + 1;
        let count = usize::from(self.frames).min(usize::try_from(fits).unwrap_or(usize::MAX));
        let mut run = recorded.start();
        let mut film = StripRecorder::new(first, self.every, count, run.residents().len());
        while !film.is_complete() {
            let Some(batch) = run.next_batch()? else { break };
            film.take(batch.firings, batch.facts);
        }
        let names = RunNames {
            scenario: &run.scenario().file.name,
            people: run.residents(),
            sensors: run.sensors().collect(),
            doors: home.doors.len(),
            things: home.plan().things.iter().map(|thing| thing.name.as_str()).collect(),
        };
        let strip = film.strip(&names, |at| calendar.wall_clock(at));
        output.write(&strip, [&|| film_strip(&home, &strip)])
    }

    /// The instant of the first moment, within the run.
    fn first(&self, calendar: &Calendar, whole: Interval<RunTime>) -> Result<RunTime, Failure> {
        let wrong = || Failure::asked(MomentMessage::NotATime { text: self.from.clone() });
        let at = calendar.written(&self.from).ok_or_else(wrong)?;
        if whole.contains(at) {
            return Ok(at);
        }
        let [begin, end] = [whole.begin, whole.end].map(|at| calendar.wall_clock(at));
        Err(Failure::asked(MomentMessage::OutsideRun { asked: self.from.clone(), begin, end }))
    }
}
