//! `homebody inspect`: the contents of a log.

use super::log_input::{LogArguments, warn_of_incomplete};
use super::result_output::ResultOutput;
use crate::failure::{EXIT_CODES, Failure};
use crate::print::write_file;
use crate::progress::Working;
use homebody_analysis::density::density;
use homebody_analysis::look::{HomeSensor, LogOverview, Looker, looked};
use homebody_core::calendar::Calendar;
use homebody_log::SensorMap;
use homebody_log::run::places::can_be_written;
use homebody_picture::{density_map, look_map, look_page};
use homebody_query::{LoadedLog, LogRef, home_sensors};
use std::path::{Path, PathBuf};

/// Describe a log: its sensors, its days and its oddities
///
/// The report has the time span, each sensor with its kind and its event count, and oddities: silences, dead or stuck sensors,
/// repeated or missing messages, and lines that Homebody cannot parse.
///
/// The picture has a row for each sensor and a column for each day. A log with motion sensors also gets a density map.
#[derive(clap::Args)]
#[command(after_long_help = format!("Examples:
  homebody inspect casas:aruba.txt
  homebody inspect runs/tigerplace-1 --png log.png
  homebody inspect week.csv --home scenarios/tigerplace --sensors sensors.csv --json log.json --html log.html

For a sensor that reports OFF, an ON after an ON counts as a repeated message. An OFF without an ON
before it counts as a missing ON. A sensor is dead if it has sent nothing for the last two days or
more, and for at least three times its longest earlier silence. A motion sensor is stuck if it is on
for 6 h. A sensor with readings, such as a thermometer, is stuck if it repeats one value 50 times or more, over a day or more.

The kind of a sensor is motion, contact, used (of a thing that people use, such as a tap), reading or
other. Homebody takes it from the first of: a sensors.csv in the log's folder (columns id,kind), the
log's source, the home, the values, the name, the length of its ONs.

An ON ends at a state such as unavailable, and at a gap of the recorder. The first state after either
is neither an event nor a missing message.

{EXIT_CODES}."))]
pub struct InspectArguments {
    #[command(flatten)]
    log: LogArguments,
    /// Compare with the home of this scenario, and report sensors that are unknown, silent or of another kind
    #[arg(long, value_name = "SCENARIO")]
    home: Option<PathBuf>,
    /// CSV file with the columns id (a sensor in the log) and name (the same sensor in the home)
    #[arg(long, value_name = "FILE")]
    sensors: Option<PathBuf>,
    /// The home's time zone, for a log in UTC; not needed for a run folder, which stores it
    #[arg(long, value_name = "ZONE")]
    time_zone: Option<String>,
    /// Write the report as one HTML page with pictures
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    html: Option<PathBuf>,
    #[command(flatten)]
    output: ResultOutput,
}

impl InspectArguments {
    pub fn run(self) -> Result<(), Failure> {
        let named = self.log.find()?;
        let sources: Vec<PathBuf> = named.place.files().into_iter().chain(self.sensors.clone()).collect();
        let html: Vec<&Path> = self.html.as_deref().into_iter().collect();
        can_be_written(&html, &sources, self.output.replaces())?;
        self.output.check(["", DENSITY], &sources)?;
        let look = self.look(&named)?;
        warn_of_incomplete(&named.name, named.incomplete().as_ref());
        let drawn = self.html.is_some() || self.output.has_pictures();
        let density = if drawn { self.density() } else { None };
        if let Some(page) = &self.html {
            write_file(page, look_page(&look, density.as_deref()).as_bytes(), self.output.replaces())?;
        }
        let map = || look_map(&look);
        match &density {
            Some(density) => {
                let output = self.output.check(["", DENSITY], &sources)?;
                output.write(&look, [&map, &|| density.clone()])
            }
            None => self.output.check([""], &sources)?.write(&look, [&map]),
        }
    }

    fn look(&self, named: &LogRef) -> Result<LogOverview, Failure> {
        let zone = self.time_zone.as_deref().map(Calendar::zone).transpose().map_err(Failure::asked)?;
        let map = self.sensors.as_deref().map(SensorMap::read).transpose()?.unwrap_or_default();
        let home: Option<(String, Vec<HomeSensor>)> = match &self.home {
            Some(path) => {
                let scenario = homebody_simulation::ScenarioSource::at(path)?.scenario()?;
                Some((scenario.file.name.clone(), home_sensors(&scenario)))
            }
            None => None,
        };
        let zone = zone.or_else(|| named.zone());
        let reading = Working::on(format!("reading {}", named.name));
        let (looker, mut about) = looked(Looker::new(zone).by_own_zone(), &mut |take| named.stream(take))?;
        drop(reading);
        named.know_home(&mut about);
        let known = |id: &str| about.known.iter().find(|known| known.id == id).map(|known| known.name.as_str());
        let name = |id: &str| map.name(id).or_else(|| named.name_of(id)).or_else(|| known(id)).map(str::to_owned);
        let home = home.as_ref().map(|(name, sensors)| (name.as_str(), &sensors[..]));
        Ok(looker.look(&named.name, named.place.form().name, &about, &name, home))
    }

    /// The density map; `None` for a log without motion sensors, or with too many days.
    fn density(&self) -> Option<String> {
        let log = LoadedLog::from_ref(self.log.find().ok()?, self.time_zone.as_deref()).ok()?;
        let asked = log.density_asked();
        density((&log.name, &log.log, &asked), None).ok().map(|density| density_map(&density))
    }
}

const DENSITY: &str = "density";
