//! `homebody experiment realism`.

use super::messages::ExperimentMessage;
use crate::commands::answer::Answer;
use crate::commands::messages::not_comparable;
use crate::commands::read_log::{HowRead, read_log};
use crate::failure::Failure;
use homebody_analysis::dates::midnight;
use homebody_analysis::realism::{Realism, Told, realism};
use homebody_core::event::Events;
use homebody_core::run::Run;
use homebody_core::scenario::home::{Preset, SensorFile};
use homebody_core::scenario::load::Scenario;
use homebody_core::scenario::logger::{LoggerFile, LumpFile, MessagesFile, OnOffFile, TimeFormat};
use homebody_core::time::{DAY, Micros};
use homebody_log::{Event, Log, Rows};
use homebody_picture::realism_chart;
use homebody_routine::household::Household;
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
#[command(after_long_help = "Example:\n  homebody experiment realism --data casas --json realism.json")]
pub struct Arguments {
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
    answer: Answer,
}

/// The logs of homes with Control4 units, below the folder of the data, and from which day on somebody is at home.
const LOGS: [(&str, Option<jiff::civil::Date>); 2] = [
    ("casas_hh111_week1/hh111week1.csv", None),
    ("casas_tm000/tm000.multiday_absence.txt", Some(jiff::civil::date(2016, 7, 17))),
];

/// The scenario that is lived.
const SCENARIO: &str = "older-adult";

#[derive(Serialize)]
struct Experiment {
    seed: u64,
    homes: Vec<Realism>,
}

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        let answer = self.answer.check(["", "other"], &[])?;
        let mut logs = Vec::new();
        for (file, from) in LOGS {
            let path = self.data.join(file);
            if !path.is_file() {
                return Err(Failure::file(ExperimentMessage::NoData { folder: self.data, file: file.to_owned() }));
            }
            let read = read_log(&path.to_string_lossy(), None, &HowRead::default())?;
            let last = read.log.events.iter().map(|event| event.at).max().unwrap_or(0);
            logs.push((read, from.map(|from| midnight(from)..last + 1)));
        }
        let lived = lived(self.seed, self.days)?;
        let simulated = Told { name: SCENARIO, log: &lived, recorded: None };
        let mut homes = Vec::new();
        for (real, at_home) in &logs {
            let told = Told { name: &real.name, log: &real.log, recorded: at_home.as_ref() };
            homes.push(realism(told, simulated).map_err(|problems| not_comparable(&problems))?);
        }
        let experiment = Experiment { seed: self.seed, homes };
        let [first, second] = [0, 1].map(|home| &experiment.homes[home]);
        answer.give(&experiment, [&|| realism_chart(first), &|| realism_chart(second)])
    }
}

/// The log of the template's life, sensed by Control4 units.
fn lived(seed: u64, days: u32) -> Result<Log, Failure> {
    let opened = homebody_kit::template(SCENARIO)?;
    let follow = |sensor: &mut SensorFile| match sensor {
        SensorFile::Motion(motion) => motion.preset = Preset::CasasFollow,
        SensorFile::CeilingMotion(motion) => motion.preset = Preset::CasasFollow,
        _ => {}
    };
    // Read off both logs: the shortest ONs, a third of all, last 1.06 to 1.14 s.
    let lumps = vec![LumpFile { share: 1.0, parts: [0.96, 1.04] }];
    let messages = MessagesFile::OnOff(OnOffFile { hold_s: 1.1, lumps });
    let logger = LoggerFile { messages, time: TimeFormat::Local, ..LoggerFile::default() };
    let edit = opened.scenario().edit().home(|home| home.sensors.iter_mut().for_each(follow)).logger(&logger);
    let scenario = edit.load()?;
    log_of(&scenario, opened.household(), &logger, seed, Micros::from(days) * DAY)
}

fn log_of(
    scenario: &Scenario,
    household: &Household,
    logger: &LoggerFile,
    seed: u64,
    length: Micros,
) -> Result<Log, Failure> {
    let mut run = Run::new(scenario, household, seed, length);
    let names: Vec<String> = run.home().sensors.iter().map(|sensor| sensor.name.clone()).collect();
    let is_motion: Vec<bool> = run.home().sensors.iter().map(|sensor| sensor.senses_motion()).collect();
    let mut rows = Rows::new(logger, seed, &names, &scenario.calendar)?;
    let start = scenario.calendar.local(0);
    let wall = midnight(start.date());
    let mut log = Log { sensors: names, values: vec!["ON".into(), "OFF".into()], ..Log::default() };
    let mut events = Events::default();
    while run.now() < length {
        let until = (run.now() + DAY / 24).min(length);
        run.advance(until, &mut events)?;
        for row in rows.of(&events.firings, until).filter(|row| is_motion[row.sensor.index()]) {
            let value = u32::from(row.value != "ON");
            log.events.push(Event { at: wall + row.at, sensor: row.sensor.0, value });
        }
        events.clear();
    }
    Ok(log)
}

impl fmt::Display for Experiment {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        for (index, home) in self.homes.iter().enumerate() {
            let part = if index > 0 { "\n" } else { "" };
            write!(f, "{part}{home}")?;
        }
        Ok(())
    }
}
