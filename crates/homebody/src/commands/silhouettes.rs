//! `homebody silhouettes`: the stored silhouettes of a run's cameras, as pictures, a film or a table.

pub mod messages;
mod outputs;
mod selection;

use super::falls::{looking_bar, position};
use super::result_output::ResultOutput;
use crate::failure::{EXIT_CODES, Failure};
use homebody_core::problem::counted;
use homebody_core::time::{Interval, RunTime, SECOND, Span};
use homebody_log::LogError;
use homebody_log::run::places::SILHOUETTES;
use homebody_log::silhouettes::KeptSilhouettes;
use homebody_picture::{SilhouetteStrip, StripMoment, silhouette_strip};
use homebody_query::{LogRef, RunSilhouettes};
use homebody_simulation::run_length::span;
use outputs::{SilhouetteCount, SilhouetteOutput, SilhouetteOutputs, WrittenOutput};
use selection::SilhouetteSelection;
use serde::Serialize;
use std::fmt;
use std::path::PathBuf;

const STRIP_EVERY: Span = SECOND;

/// Export the silhouettes of a run's cameras: pictures, film or table
///
/// Silhouettes are the only pictures that a simulated camera stores. Without an output, Homebody prints their number by camera and their
/// times. --png and --svg draw moments side by side, with a row for each camera.
///
/// --out writes all silhouettes in a form that depends on the extension. .apng is a film of the cameras side by side, which
/// browsers can play. .csv and .jsonl have a row for each silhouette: box, centre, direction, elongation, and the position and
/// height of the body by this camera alone. Any other name is a new folder of PNG files, in folders by camera.
#[derive(clap::Args)]
#[command(after_long_help = format!("Examples:
  homebody silhouettes runs/cameras-1
  homebody silhouettes runs/cameras-1 --from 2025-06-03T03:12 --every 0.5s --frames 8 --png fall.png
  homebody silhouettes runs/cameras-1 --from 2025-06-03T03:12 --to 2025-06-03T03:14 --out fall.apng
  homebody silhouettes runs/cameras-1 --camera 'camera east' --every 1m --out features.csv --out pictures

If two pictures are more than a second apart, a film shows them one second apart.

{EXIT_CODES}."))]
pub struct SilhouettesArguments {
    /// Folder of a run with cameras
    run: String,
    /// Export only this camera; repeatable
    #[arg(long, value_name = "NAME")]
    camera: Vec<String>,
    /// First moment: a date and time such as 2025-06-03T03:12:05, or a time in the first 24 hours of the run
    #[arg(long, value_name = "TIME")]
    from: Option<String>,
    /// Last moment, in the same form as --from
    #[arg(long, value_name = "TIME")]
    to: Option<String>,
    /// Time between two pictures (default: 1s for --png and --svg, and all pictures for --out)
    #[arg(long, value_name = "DURATION", value_parser = span)]
    every: Option<Span>,
    /// Number of moments in --png and --svg
    #[arg(long, value_name = "N", help_heading = "Output", default_value_t = 8, value_parser = clap::value_parser!(u8).range(1..=64))]
    frames: u8,
    /// Write FILE.apng, FILE.csv, FILE.jsonl or a new folder; repeatable
    #[arg(short, long, value_name = "DESTINATION", help_heading = "Output")]
    out: Vec<PathBuf>,
    /// Size of each camera pixel in the output, in pixels
    #[arg(long, value_name = "N", help_heading = "Output", default_value_t = 3, value_parser = clap::value_parser!(u32).range(1..=32))]
    scale: u32,
    #[command(flatten)]
    output: ResultOutput,
}

impl SilhouettesArguments {
    pub fn run(self) -> Result<(), Failure> {
        let named = LogRef::find(&self.run)?;
        let kept = RunSilhouettes::beside(&named)?;
        let mut sources = named.place.files();
        sources.push(named.place.path().with_file_name(SILHOUETTES));
        let strip = self.output.has_pictures().then(|| self.every.unwrap_or(STRIP_EVERY) * i64::from(self.frames - 1));
        let selection =
            SilhouetteSelection::parse(&kept, (&self.camera[..], self.from.as_deref(), self.to.as_deref()), strip)?;
        let outputs = SilhouetteOutput::check_all(&self.out, &sources, self.output.replaces())?;
        let checked = self.output.check([""], &sources)?;
        let bar = looking_bar(&named);
        let mut answered = self.survey(&named.name, &kept, &selection, &bar)?;
        let mut film = self
            .output
            .has_pictures()
            .then(|| StripMoments::new(&selection, self.every.unwrap_or(STRIP_EVERY), self.frames));
        let counted = SilhouetteCount { pictures: answered.pictures, instants: answered.instants };
        let scale = self.scale;
        let mut outputs =
            SilhouetteOutputs::begin(outputs, &kept, &selection.cameras, counted, scale, self.output.replaces())?;
        if film.is_some() || !outputs.is_empty() {
            let mut thinned = Thinned::new(self.every);
            selection.for_each::<Failure>(&kept, |kept, camera| {
                bar.set_position(position(kept.at));
                if let Some(film) = &mut film {
                    film.take(camera, &kept);
                }
                if thinned.takes(kept.at) { outputs.take(camera, &kept) } else { Ok(()) }
            })?;
        }
        bar.finish_and_clear();
        answered.written = outputs.finish()?;
        let names: Vec<&str> = answered.cameras.iter().map(|camera| camera.name.as_str()).collect();
        let draw = || {
            let strip = film.as_ref().map(|film| film.strip(&named.name, &names, |at| selection::clock(&kept, at)));
            strip.as_ref().map_or_else(String::new, silhouette_strip)
        };
        checked.write(&answered, [&draw])
    }

    /// Counts the silhouettes, before any output starts.
    fn survey(
        &self,
        name: &str,
        kept: &RunSilhouettes,
        selection: &SilhouetteSelection,
        bar: &indicatif::ProgressBar,
    ) -> Result<SilhouettesAnswer, Failure> {
        let mut seen = vec![(0u64, None::<(RunTime, RunTime)>); selection.cameras.len()];
        let (mut instants, mut last) = (0, RunTime::MIN);
        let mut thinned = Thinned::new(self.every);
        selection.for_each::<LogError>(kept, |kept, camera| {
            bar.set_position(position(kept.at));
            if !thinned.takes(kept.at) {
                return Ok(());
            }
            instants += u64::from(kept.at != last);
            last = kept.at;
            let (count, span) = &mut seen[camera];
            *count += 1;
            *span = Some((span.map_or(kept.at, |(first, _)| first), kept.at));
            Ok(())
        })?;
        if instants == 0 {
            return Err(selection.nothing(kept)?);
        }
        let cameras = selection.cameras.iter().zip(seen).map(|(&camera, (pictures, span))| {
            let file = &kept.silhouettes.cameras[camera].file;
            CameraSummary {
                name: file.name.clone(),
                columns: file.pixels[0],
                rows: file.pixels[1],
                frames_per_s: file.frames_per_s,
                pictures,
                first: span.map(|(first, _)| selection::clock(kept, first)),
                last: span.map(|(_, last)| selection::clock(kept, last)),
            }
        });
        let cameras: Vec<CameraSummary> = cameras.collect();
        let pictures = cameras.iter().map(|camera| camera.pictures).sum();
        Ok(SilhouettesAnswer { name: name.into(), pictures, instants, cameras, written: Vec::new() })
    }
}

/// Selects instants with at least this time between them, for all cameras at once.
struct Thinned {
    every: Span,
    taken: Option<RunTime>,
}

impl Thinned {
    fn new(every: Option<Span>) -> Thinned {
        Thinned { every: every.unwrap_or(Span::ZERO), taken: None }
    }

    fn takes(&mut self, at: RunTime) -> bool {
        let is_taken = self.taken.is_none_or(|taken| at == taken || at >= taken + self.every);
        if is_taken {
            self.taken = Some(at);
        }
        is_taken
    }
}

struct StripMoments {
    moments: Vec<(RunTime, Vec<Option<KeptSilhouettes>>)>,
    /// Time for which a picture is the latest, by camera.
    periods: Vec<Span>,
    sizes: Vec<[u32; 2]>,
}

impl StripMoments {
    fn new(selection: &SilhouetteSelection, every: Span, count: u8) -> StripMoments {
        let moment = |index| (selection.span.begin + every * i64::from(index), vec![None; selection.cameras.len()]);
        let within = |(at, _): &(RunTime, _)| *at < selection.span.end;
        StripMoments {
            moments: (0..count).map(moment).filter(within).collect(),
            periods: selection.files.iter().map(|file| file.period()).collect(),
            sizes: selection.files.iter().map(|file| file.pixels).collect(),
        }
    }

    fn take(&mut self, camera: usize, kept: &KeptSilhouettes) {
        let shown = Interval::starting(kept.at, self.periods[camera]);
        for (_, seen) in self.moments.iter_mut().filter(|(at, _)| shown.contains(*at)) {
            seen[camera] = Some(kept.clone());
        }
    }

    fn strip(&self, name: &str, names: &[&str], clock: impl Fn(RunTime) -> String) -> SilhouetteStrip {
        let moment = |(at, seen): &(RunTime, Vec<Option<KeptSilhouettes>>)| StripMoment {
            at: clock(*at),
            silhouettes: seen.iter().map(|kept| kept.as_ref().map(|kept| kept.silhouette.clone())).collect(),
        };
        SilhouetteStrip {
            name: name.into(),
            cameras: names.iter().map(ToString::to_string).zip(self.sizes.iter().copied()).collect(),
            moments: self.moments.iter().map(moment).collect(),
        }
    }
}

/// The silhouettes, and the outputs that were written.
#[derive(Serialize)]
struct SilhouettesAnswer {
    name: String,
    pictures: u64,
    instants: u64,
    cameras: Vec<CameraSummary>,
    written: Vec<WrittenOutput>,
}

#[derive(Serialize)]
struct CameraSummary {
    name: String,
    columns: u32,
    rows: u32,
    frames_per_s: f64,
    pictures: u64,
    /// In local time.
    first: Option<String>,
    last: Option<String>,
}

impl fmt::Display for SilhouettesAnswer {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let pictures = counted(self.pictures as usize, "silhouette", "silhouettes");
        let instants = counted(self.instants as usize, "instant", "instants");
        writeln!(f, "{}: {pictures} at {instants}", self.name)?;
        for CameraSummary { name, columns, rows, frames_per_s, pictures, first, last } in &self.cameras {
            write!(f, "  {name}, {columns} x {rows}, {frames_per_s} per second: ")?;
            match (first, last) {
                (Some(first), Some(last)) => writeln!(f, "{pictures}, {first} to {last}")?,
                _ => writeln!(f, "0")?,
            }
        }
        for WrittenOutput { path, what } in &self.written {
            writeln!(f, "{path}: {what}")?;
        }
        Ok(())
    }
}
