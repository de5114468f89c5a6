use super::locate::{each_home, with_link};
use crate::sensor_faults::{FaultCase, PLANTED_KINDS, PlantedFault, case, faulty};
use homebody::shared::{Failure, JsonOutput, TextTable};
use serde::Serialize;
use std::fmt;

/// Measure how well the command homebody sensor-faults finds faults
///
/// The homes cycle through the templates, each with its own seed. Each home has four faults, in four different motion sensors; odd
/// and even homes have different kinds of fault.
#[derive(clap::Args)]
#[command(after_long_help = "Examples:
  homebody-lab sensor-faults
  homebody-lab sensor-faults --homes 5 --days 21 --json sensor-faults.json")]
pub struct SensorFaultsLabArguments {
    /// Number of homes
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = clap::value_parser!(u32).range(1..=1000))]
    homes: u32,
    /// Days to simulate for each home
    #[arg(long, value_name = "N", default_value_t = 14, value_parser = clap::value_parser!(u32).range(7..=366))]
    days: u32,
    #[command(flatten)]
    output: JsonOutput,
}

#[derive(Serialize)]
struct FaultsExperiment {
    days: u32,
    kinds: Vec<FaultKindResult>,
    /// Findings about intact sensors, and the number of sensor-days.
    false_alarms: usize,
    sensor_days: u64,
    cases: Vec<FaultCase>,
}

#[derive(Serialize)]
struct FaultKindResult {
    kind: &'static str,
    planted: usize,
    found: usize,
    named: usize,
    /// Median number of days from the start of the fault to the start of the finding.
    late_days: Option<f64>,
}

impl SensorFaultsLabArguments {
    pub fn run(self) -> Result<(), Failure> {
        let output = self.output.check(&[])?;
        let homes: Vec<usize> = (0..self.homes as usize).collect();
        let cases = each_home(
            &homes,
            |&home| home,
            |opened, &number| {
                let link = faulty(opened.scenario(), number, self.days);
                with_link(opened, &link, |home| case(home, 1 + number as u64, self.days))
            },
        )?;
        output.write(&FaultsExperiment::from_cases(cases, self.days), [])
    }
}

impl FaultsExperiment {
    fn from_cases(cases: Vec<FaultCase>, days: u32) -> FaultsExperiment {
        let of_kind = |kind: &&'static str| {
            let all: Vec<&PlantedFault> =
                cases.iter().flat_map(|case| &case.faults).filter(|fault| fault.kind == *kind).collect();
            let mut late: Vec<f64> = all.iter().filter_map(|fault| fault.late_days).collect();
            late.sort_by(f64::total_cmp);
            FaultKindResult {
                kind,
                planted: all.len(),
                found: all.iter().filter(|fault| fault.found).count(),
                named: all.iter().filter(|fault| fault.named).count(),
                late_days: late.get(late.len() / 2).copied(),
            }
        };
        FaultsExperiment {
            days,
            kinds: PLANTED_KINDS.iter().map(of_kind).collect(),
            false_alarms: cases.iter().map(|case| case.false_alarms.len()).sum(),
            sensor_days: cases.iter().map(|case| case.sensors as u64 * u64::from(case.days)).sum(),
            cases,
        }
    }
}

impl fmt::Display for FaultsExperiment {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        writeln!(f, "Sensor faults found from the logs of {} days\n", self.days)?;
        let table = TextTable::new("-18 fault|7 planted|6 found|6 named|10 days late");
        f.write_str(&table.heading())?;
        for FaultKindResult { kind, planted, found, named, late_days } in &self.kinds {
            let late = late_days.map_or("-".into(), |late| format!("{late:.1}"));
            f.write_str(&table.row(&[kind, planted, found, named, &late]))?;
        }
        let per_year = self.false_alarms as f64 / self.sensor_days.max(1) as f64 * 365.0;
        writeln!(f, "\nfalse alarms: {}, {per_year:.2} per sensor and year", self.false_alarms)
    }
}
