//! `homebody look`: what a log holds.

use super::answer::Answer;
use super::read_log::{Mapped, go_on};
use crate::failure::{EXIT_CODES, Failure};
use crate::print::{tell, write_file};
use crate::progress::Working;
use homebody_analysis::density::density;
use homebody_analysis::look::{HomeSensor, Look, Looker, looked};
use homebody_core::scenario::calendar::Calendar;
use homebody_kit::{LogWithRun, NamedLog, home_sensors};
use homebody_log::SensorMap;
use homebody_log::places::can_be_written;
use homebody_picture::{density_map, look_map, look_page};
use std::path::{Path, PathBuf};

/// Says and draws what a log holds: its span, its sensors with what they are taken for and how often they speak, and what is
/// odd: silences, sensors that are dead or stuck, messages that are repeated or missing, lines that are not understood.
///
/// The picture has a row for each sensor and a column for each day; beside it comes the density map, where the log has motion
/// sensors.
#[derive(clap::Args)]
#[command(after_help = format!("Examples:
  homebody look casas:aruba.txt
  homebody look runs/tigerplace-1 --png look.png
  homebody look week.csv --home scenarios/tigerplace --sensors sensors.csv --json look.json --html look.html

Repeated are ONs after an ON, missing those before an OFF without one. Dead is what says nothing for
two days or more before the log ends, and for three times as long as ever before; stuck is a motion
sensor that is on for 6 h, or 50 readings of one number over a day.

Each sensor is taken for motion, contact, used, reading or other by the best evidence: the kind in a
sensors.csv in the log's folder (id,kind is enough), the log's source, the home, the values, the name,
and last a guess by how long it is on. A state such as unavailable, and a gap of the recorder, end
what was on; a state that is restored after it is no firing, and nothing is missing before it.

{EXIT_CODES}."))]
pub struct Arguments {
    #[command(flatten)]
    log: Mapped,
    /// Say how the sensors fit the home of this scenario: which it does not have, which say nothing, which are another kind
    #[arg(long, value_name = "SCENARIO")]
    home: Option<PathBuf>,
    /// A table with the columns id and name, which tells what the home calls the log's sensors
    #[arg(long, value_name = "FILE")]
    sensors: Option<PathBuf>,
    /// The home's time zone, for logs in UTC; a run knows its own
    #[arg(long, value_name = "ZONE")]
    time_zone: Option<String>,
    /// Write everything as one page with pictures, which needs no other file
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
    #[command(flatten)]
    answer: Answer,
}

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        let named = self.log.find()?;
        let sources: Vec<PathBuf> = named.place.files().into_iter().chain(self.sensors.clone()).collect();
        let html: Vec<&Path> = self.html.as_deref().into_iter().collect();
        can_be_written(&html, &sources, self.answer.replaces())?;
        self.answer.check(["", DENSITY], &sources)?;
        let look = self.look(&named)?;
        if let Some(run) = named.unfinished() {
            tell(format_args!("warning: {}: its run has not come to its end\n  hint: {}", named.name, go_on(&run)));
        }
        let drawn = self.html.is_some() || self.answer.draws();
        let density = if drawn { self.density() } else { None };
        if let Some(page) = &self.html {
            write_file(page, look_page(&look, density.as_deref()).as_bytes(), self.answer.replaces())?;
        }
        let map = || look_map(&look);
        match &density {
            Some(density) => {
                let answer = self.answer.check(["", DENSITY], &sources)?;
                answer.give(&look, [&map, &|| density.clone()])
            }
            None => self.answer.check([""], &sources)?.give(&look, [&map]),
        }
    }

    fn look(&self, named: &NamedLog) -> Result<Look, Failure> {
        let zone = self.time_zone.as_deref().map(Calendar::zone).transpose().map_err(Failure::asked)?;
        let map = self.sensors.as_deref().map(SensorMap::read).transpose()?.unwrap_or_default();
        let home: Option<(String, Vec<HomeSensor>)> = match &self.home {
            Some(path) => {
                let scenario = homebody_kit::Source::at(path)?.scenario()?;
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

    /// The density map; none where the log has no motion sensors, or days that are too many.
    fn density(&self) -> Option<String> {
        let log = LogWithRun::of(self.log.find().ok()?, self.time_zone.as_deref()).ok()?;
        let asked = log.density_asked();
        density((&log.name, &log.log, &asked), None).ok().map(|density| density_map(&density))
    }
}

/// What the name of the density map's file ends in.
const DENSITY: &str = "density";
