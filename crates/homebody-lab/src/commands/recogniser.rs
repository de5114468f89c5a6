use super::evaluation::evaluate_each;
use crate::messages::ExperimentMessage;
use crate::recogniser::{Prepared, RecogniserError};
use homebody::shared::{Failure, LogOptions, json_text, print_json, print_text, read_log, write_file};
use homebody_core::messages::Diagnose;
use homebody_core::problem::Diagnostic;
use homebody_log::run::places::can_be_written;
use std::path::{Path, PathBuf};

/// Train a recogniser on simulated days, and test it on a real flat
///
/// Homebody compares this recogniser with one that is trained on real days of the flat. The flat is home A of the data set "ADLs
/// Recognition Using Binary Sensors" (Ordonez et al. 2013), which does not come with Homebody. The folder needs
/// uci_adl_ordonez/OrdonezA_Sensors.txt and OrdonezA_ADLs.txt. The simulated routine comes from the first half of the real days. The
/// test uses only the second half.
#[derive(clap::Args)]
#[command(after_long_help = "Examples:
  homebody-lab recogniser --data uci
  homebody-lab recogniser --data uci --seeds 20 --days 56 --json recogniser.json")]
pub struct RecogniserLabArguments {
    /// Folder of the data set, or the folder above it
    #[arg(long, value_name = "FOLDER")]
    data: PathBuf,
    /// Number of repetitions, each with other simulated days and other random real days
    #[arg(long, value_name = "N", default_value_t = 10, value_parser = clap::value_parser!(u32).range(1..=1000))]
    seeds: u32,
    /// Simulated days of each repetition
    #[arg(long, value_name = "N", default_value_t = 28, value_parser = clap::value_parser!(u32).range(3..=366))]
    days: u32,
    /// Write the result to FILE as JSON; - prints it
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Replace an existing file
    #[arg(short, long)]
    force: bool,
}

/// The data set's folder, and the file of home A's sensors in it.
const FOLDER: &str = "uci_adl_ordonez";
const SENSORS: &str = "OrdonezA_Sensors.txt";

impl RecogniserLabArguments {
    pub fn run(self) -> Result<(), Failure> {
        let file = self.json.as_deref().filter(|path| path.as_os_str() != "-");
        can_be_written(&file.into_iter().collect::<Vec<&Path>>(), &[], self.force)?;
        let path =
            [self.data.join(FOLDER).join(SENSORS), self.data.join(SENSORS)].into_iter().find(|path| path.is_file());
        let Some(path) = path else {
            return Err(Failure::file(ExperimentMessage::NoData { folder: self.data, file: SENSORS.to_owned() }));
        };
        let log = path.display().to_string();
        let refused = |why: RecogniserError| Failure::asked(Diagnostic::of_file(&log, why.diagnostic(), None));
        let prepared =
            Prepared::new(&read_log(&path.to_string_lossy(), None, &LogOptions::default())?.log).map_err(refused)?;
        let seeds: Vec<u64> = (1..=u64::from(self.seeds)).collect();
        let cases = evaluate_each(&seeds, "seeds", |&seed| prepared.case(seed, self.days).map_err(refused))?;
        let experiment = prepared.experiment(cases, self.days);
        match file {
            Some(path) => {
                write_file(path, json_text(&experiment)?.as_bytes(), self.force)?;
                print_text(&experiment.to_string())
            }
            None if self.json.is_some() => print_json(&experiment),
            None => print_text(&experiment.to_string()),
        }
    }
}
