use super::locate::{single_home, with_and_without_faults};
use crate::measures::{MeasureError, MeasuresCase, case, errors_between};
use crate::messages::ExperimentMessage;
use homebody::shared::{Failure, JsonOutput, LogOptions, TextTable, not_measurable, read_log, within};
use homebody_analysis::measures::Measures;
use homebody_query::LoadedLog;
use homebody_simulation::ScenarioSource;
use serde::Serialize;
use std::fmt;
use std::path::PathBuf;

/// Measure the accuracy of the command homebody measures
///
/// Homebody compares the measures from logs with those from the ground truth. The homes cycle through the templates that have one
/// resident, each with its own seed. Each home has two logs: one without losses, and one with every sensor fault. The log without losses
/// is measured a second time without the sensors in beds.
///
/// With --data, it compares the measures from sensors of real homes with the activities that their logs note.
#[derive(clap::Args)]
#[command(after_long_help = "Examples:
  homebody-lab measures
  homebody-lab measures --homes 8 --days 14 --json measures.json
  homebody-lab measures --data OrdonezA_Sensors.txt --data kasterenSenseData.txt")]
pub struct MeasuresLabArguments {
    /// Number of homes
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = clap::value_parser!(u32).range(1..=1000))]
    homes: u32,
    /// Days to simulate for each home
    #[arg(long, value_name = "N", default_value_t = 28, value_parser = clap::value_parser!(u32).range(2..=366))]
    days: u32,
    /// Log of a real home with activities, instead of simulated homes; repeatable
    #[arg(long, value_name = "LOG", conflicts_with_all = ["homes", "days"])]
    data: Vec<String>,
    /// Scenario with the home of the logs, for the rooms of their sensors
    #[arg(long, value_name = "SCENARIO", requires = "data")]
    home: Option<PathBuf>,
    #[command(flatten)]
    output: JsonOutput,
}

#[derive(Serialize)]
struct RealLogsExperiment {
    logs: Vec<RealLogErrors>,
}

#[derive(Serialize)]
struct RealLogErrors {
    name: String,
    errors: Vec<MeasureError>,
}

#[derive(Serialize)]
struct MeasuresExperiment {
    days: u32,
    /// Over all homes, with a perfect link.
    clean: Vec<MeasureError>,
    faults: Vec<MeasureError>,
    /// With a perfect link, and without the sensors in beds.
    without_bed: Vec<MeasureError>,
}

impl MeasuresLabArguments {
    pub fn run(self) -> Result<(), Failure> {
        if !self.data.is_empty() {
            return self.compare_real_logs();
        }
        let output = self.output.check(&[])?;
        let cases = with_and_without_faults(self.homes, self.days, single_home, case)?;
        let over = |faults: bool, errors: fn(&MeasuresCase) -> &Vec<MeasureError>| {
            let same = cases.iter().filter(|(with_faults, _)| *with_faults == faults);
            MeasureError::over_homes(same.flat_map(|(_, case)| errors(case)).collect::<Vec<_>>().into_iter())
        };
        let experiment = MeasuresExperiment {
            days: self.days,
            clean: over(false, |case| &case.all),
            faults: over(true, |case| &case.all),
            without_bed: over(false, |case| &case.without_bed),
        };
        output.write(&experiment, [])
    }
}

impl MeasuresLabArguments {
    fn compare_real_logs(self) -> Result<(), Failure> {
        let read = |log: &String| read_log(log, None, &LogOptions::default());
        let mut read = self.data.iter().map(read).collect::<Result<Vec<_>, _>>()?;
        let sources: Vec<PathBuf> = read.iter().flat_map(|read| read.sources.clone()).collect();
        let output = self.output.check(&sources)?;
        if let Some(home) = &self.home {
            let home = ScenarioSource::at(home)?.scenario()?;
            read.iter_mut().for_each(|read| {
                read.place_in(&home);
            });
        }
        let of_log = |(log, read): (&String, &mut LoadedLog)| {
            // A measure by the notes alone cannot be compared with the notes.
            let notes = std::mem::take(&mut read.log.activities);
            let heard = read.measures().map_err(|why| not_measurable(log, &why))?;
            let noted = Measures::from_notes(&read.name, &notes, within(read).unwrap_or_default());
            let noted = noted.ok_or_else(|| Failure::asked(ExperimentMessage::NoActivities { log: log.clone() }))?;
            Ok(RealLogErrors { name: read.name.clone(), errors: errors_between(&heard, &noted) })
        };
        let logs = self.data.iter().zip(&mut read).map(of_log).collect::<Result<Vec<_>, Failure>>()?;
        output.write(&RealLogsExperiment { logs }, [])
    }
}

fn write_errors(f: &mut fmt::Formatter, errors: &[MeasureError]) -> fmt::Result {
    let table = TextTable::new("-20   measure|-8 unit|6 days|10 true|8 bias|11 mean error|10 90 % error|7 r");
    f.write_str(&table.heading())?;
    for MeasureError { measure, unit, days, mean_true, bias, mean_error, p90_error, correlation, .. } in errors {
        let [truth, bias, mean, p90] = [mean_true, bias, mean_error, p90_error].map(|value| format!("{value:.2}"));
        let r = correlation.map_or("-".to_owned(), |r| format!("{r:.2}"));
        f.write_str(&table.row(&[&format_args!("  {measure}"), unit, days, &truth, &bias, &mean, &p90, &r]))?;
    }
    writeln!(f)
}

impl fmt::Display for MeasuresExperiment {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        writeln!(f, "Measures of {} days from logs, compared with the ground truth\n", self.days)?;
        let links = [
            ("With no losses", &self.clean),
            ("With every sensor fault", &self.faults),
            ("With no losses, and without sensors in beds", &self.without_bed),
        ];
        for (link, errors) in links {
            writeln!(f, "{link}")?;
            write_errors(f, errors)?;
        }
        Ok(())
    }
}

impl fmt::Display for RealLogsExperiment {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        writeln!(f, "Measures from sensors of real homes, compared with noted activities\n")?;
        for RealLogErrors { name, errors } in &self.logs {
            writeln!(f, "{name}")?;
            write_errors(f, errors)?;
        }
        Ok(())
    }
}
