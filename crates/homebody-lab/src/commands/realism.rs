use crate::messages::ExperimentMessage;
use homebody::shared::{Failure, LogOptions, ResultOutput, not_comparable, read_log};
use homebody_analysis::realism::{ComparedLog, Realism, realism};
use homebody_core::scenario::logger::{LoggerFile, LumpFile, MessagesFile, OnOffFile, TimeFormat};
use homebody_core::sensors::Sensor;
use homebody_core::sensors::kinds::SensorFile;
use homebody_core::sensors::preset::Preset;
use homebody_core::time::{DAY, Interval, Span, WallTime};
use homebody_log::{Log, SimulatedRun};
use homebody_picture::realism_chart;
use serde::Serialize;
use std::fmt;
use std::path::PathBuf;

/// Compare real homes of CASAS with a simulated home
///
/// The simulated log comes from the template `older-adult`, with sensors that behave like those of the real homes. The real logs do not
/// come with Homebody: download them into the folder as casas_hh111_week1/hh111week1.csv and casas_tm000/tm000.multiday_absence.txt.
///
/// The parameters of sensors and movement were set by comparison with both logs. The result is therefore a fit, and not a test on
/// other homes. Homes and residents differ, so a perfect match is not possible.
#[derive(clap::Args)]
#[command(after_long_help = "Example:\n  homebody-lab realism --data casas --json realism.json")]
pub struct RealismLabArguments {
    /// Folder that contains the folders of the real logs
    #[arg(long, value_name = "FOLDER")]
    data: PathBuf,
    /// Days to simulate
    #[arg(long, value_name = "N", default_value_t = 28, value_parser = clap::value_parser!(u32).range(2..=366))]
    days: u32,
    /// Seed of all random numbers
    #[arg(long, value_name = "N", default_value_t = 2012)]
    seed: u64,
    #[command(flatten)]
    output: ResultOutput,
}

/// The logs of homes with Control4 units, below the folder of the data, and the day from which the resident is at home.
const LOGS: [(&str, Option<jiff::civil::Date>); 2] = [
    ("casas_hh111_week1/hh111week1.csv", None),
    ("casas_tm000/tm000.multiday_absence.txt", Some(jiff::civil::date(2016, 7, 17))),
];

const SCENARIO: &str = "older-adult";

#[derive(Serialize)]
struct RealismExperiment {
    seed: u64,
    homes: Vec<Realism>,
}

impl RealismLabArguments {
    pub fn run(self) -> Result<(), Failure> {
        let output = self.output.check(["", "other"], &[])?;
        let mut logs = Vec::new();
        for (file, from) in LOGS {
            let path = self.data.join(file);
            if !path.is_file() {
                return Err(Failure::file(ExperimentMessage::NoData { folder: self.data, file: file.to_owned() }));
            }
            let read = read_log(&path.to_string_lossy(), None, &LogOptions::default())?;
            let last = read.log.events.iter().map(|event| event.at).max().unwrap_or(WallTime::EPOCH);
            let at_home = |from| Interval::new(WallTime::midnight(from), last + Span::MICROSECOND);
            logs.push((read, from.map(at_home)));
        }
        let log = simulated_log(self.seed, self.days)?;
        let simulated = ComparedLog { name: SCENARIO, log: &log, recorded: None };
        let mut homes = Vec::new();
        for (real, at_home) in &logs {
            let compared = ComparedLog { name: &real.name, log: &real.log, recorded: *at_home };
            homes.push(realism(compared, simulated).map_err(|problems| not_comparable(&problems))?);
        }
        let experiment = RealismExperiment { seed: self.seed, homes };
        let [first, second] = [0, 1].map(|home| &experiment.homes[home]);
        output.write(&experiment, [&|| realism_chart(first), &|| realism_chart(second)])
    }
}

/// The log of the template, with Control4 units as sensors.
fn simulated_log(seed: u64, days: u32) -> Result<Log, Failure> {
    let opened = homebody_simulation::template(SCENARIO)?;
    let follow = |sensor: &mut SensorFile| sensor.change_settings(|settings| settings.preset = Preset::CasasFollow);
    // Read off both logs: the shortest ONs, a third of all, last 1.06 to 1.14 s.
    let lumps = vec![LumpFile { share: 1.0, parts: [0.96, 1.04] }];
    let messages = MessagesFile::OnOff(OnOffFile { hold_s: 1.1, lumps });
    let logger = LoggerFile { messages, time: TimeFormat::Local, ..LoggerFile::default() };
    let edit = opened.scenario().edit().home(|home| home.sensors.iter_mut().for_each(follow)).logger(&logger);
    let scenario = edit.load()?;
    let length = i64::from(days) * DAY;
    let run = SimulatedRun::new(&scenario, opened.household(), seed, length)?;
    let is_motion: Vec<bool> = run.run().sensors().iter().map(Sensor::senses_motion).collect();
    let scale = scenario.calendar.scale(length);
    let mut log = run.into_log(|at| scale.run_to_wall(at), |_| {})?;
    log.events.retain(|event| is_motion[event.sensor as usize]);
    Ok(log)
}

impl fmt::Display for RealismExperiment {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        for (index, home) in self.homes.iter().enumerate() {
            let part = if index > 0 { "\n" } else { "" };
            write!(f, "{part}{home}")?;
        }
        Ok(())
    }
}
