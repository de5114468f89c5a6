use crate::messages::ExperimentMessage;
use crate::sphere::{AnnotatedRun, Interval, RecordingResult, RecordingTexts, SphereExperiment, SphereRowError, parse};
use homebody::shared::{Failure, ResultOutput};
use homebody_core::messages::Diagnose;
use homebody_core::problem::Problem;
use homebody_log::LogError;
use homebody_log::files::plain;
use homebody_log::limits::LARGEST_RECORDING_BYTES;
use homebody_picture::{Lane, Panel, span_chart};
use homebody_simulation::{ScenarioSource, Template};
use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// Compare a real house of the SPHERE challenge with its simulation
///
/// Homebody simulates the recorded walks of the resident, and compares the motion sensors. It also compares the rooms that homebody
/// locate infers with the recorded ones. The recordings (Twomey et al. 2016) do not come with Homebody. Each is a folder with
/// location_0.csv, annotations_0.csv and pir.csv.
#[derive(clap::Args)]
#[command(after_long_help = "Example:\n  homebody-lab sphere --data sphere_challenge --svg rooms.svg")]
pub struct SphereLabArguments {
    /// Folder of the recordings; if its name is `train`, the folder above it also works
    #[arg(long, value_name = "FOLDER")]
    data: PathBuf,
    /// Scenario with the house (default: the template `sphere-house`)
    #[arg(long, value_name = "SCENARIO")]
    house: Option<PathBuf>,
    /// Seed of all random numbers
    #[arg(long, value_name = "N", default_value_t = 2016)]
    seed: u64,
    #[command(flatten)]
    output: ResultOutput,
}

impl SphereLabArguments {
    pub fn run(self) -> Result<(), Failure> {
        let output = self.output.check([""], &[])?;
        let source = match &self.house {
            Some(path) => ScenarioSource::at(path)?,
            None => Template::named("sphere-house")?.source(),
        };
        let house = source.scenario()?;
        let recordings = recordings(&self.data)?;
        let experiment = SphereExperiment::run(&recordings, &house, self.seed).map_err(Failure::asked)?;
        output.write(&experiment, [&|| picture(&experiment)])
    }
}

/// The recordings by the names of their folders, in order of name.
fn recordings(data: &Path) -> Result<Vec<(String, AnnotatedRun)>, Failure> {
    let train = data.join("train");
    let data = if train.is_dir() { &train } else { data };
    let entries = fs::read_dir(data).map_err(|error| match error.kind() {
        ErrorKind::NotFound => Failure::file(ExperimentMessage::NoFolder { folder: data.to_owned() }),
        _ => LogError::reading(data, error).into(),
    })?;
    let mut folders = Vec::new();
    for entry in entries {
        let folder = entry.map_err(|error| LogError::reading(data, error))?.path();
        if folder.join("pir.csv").is_file() {
            folders.push(folder);
        }
    }
    folders.sort();
    if folders.is_empty() {
        return Err(Failure::file(ExperimentMessage::NoRecordings { folder: data.to_owned() }));
    }
    let (mut recordings, mut problems) = (Vec::new(), Vec::new());
    for folder in &folders {
        match recording(folder)? {
            Ok(recording) => recordings.push(recording),
            Err(found) => problems.extend(found),
        }
    }
    if problems.is_empty() { Ok(recordings) } else { Err(Failure::all(problems)) }
}

/// The recording of a folder by its name, or the problems of its files.
type Parsed = Result<(String, AnnotatedRun), Vec<Problem>>;

fn recording(folder: &Path) -> Result<Parsed, Failure> {
    let read = |name: &str| {
        let path = folder.join(name);
        plain::read_text(&path, LARGEST_RECORDING_BYTES)
            .map_err(|error| (error.kind(), Failure::from(LogError::reading(&path, error))))
    };
    let needed = |name: &str| read(name).map_err(|(_, failure)| failure);
    let (location, annotations, pir) = (needed("location_0.csv")?, needed("annotations_0.csv")?, needed("pir.csv")?);
    let second_location = match read("location_1.csv") {
        Ok(text) => Some(text),
        Err((ErrorKind::NotFound, _)) => None,
        Err((_, failure)) => return Err(failure),
    };
    let texts = RecordingTexts {
        location: &location,
        annotations: &annotations,
        pir: &pir,
        second_location: second_location.as_deref(),
    };
    let problem = |row: &SphereRowError| {
        let file = folder.join(row.file).display().to_string();
        Problem { line: row.line as u32, column: 1, ..Problem::of_file(&file, row.what.diagnostic(), None) }
    };
    Ok(match parse(&texts) {
        Ok(run) => Ok((folder.file_name().unwrap_or_default().to_string_lossy().into_owned(), run)),
        Err(rows) => Err(rows.iter().map(problem).collect()),
    })
}

/// The ON times of the real and the simulated sensor of each room, above the stays of the person.
fn picture(experiment: &SphereExperiment) -> String {
    let panels: Vec<Panel> = experiment.by_recording.iter().map(panel).collect();
    let told = ["the real sensor is ON", "the simulated sensor is ON"];
    span_chart("A real house and its simulation", "the person is in the room", told, &panels)
}

fn panel(recording: &RecordingResult) -> Panel {
    let RecordingResult { name, begin_s, end_s, .. } = recording;
    let lanes = recording.comparison.rooms.iter().map(|room| {
        let spans = |intervals: &[Interval]| -> Vec<[f64; 2]> {
            let of_room = intervals.iter().filter(|interval| interval.name == room.room);
            let within = of_room.map(|interval| [interval.start_s.max(*begin_s), interval.end_s.min(*end_s)]);
            within.filter(|[from, to]| from < to).map(|span| span.map(|at_s| at_s - begin_s)).collect()
        };
        let told = [spans(&recording.real), spans(&recording.simulated)];
        Lane { label: room.room.clone(), truth: spans(&recording.rooms), told }
    });
    Panel { label: format!("recording {name}"), duration_s: end_s - begin_s, lanes: lanes.collect() }
}
