use super::evaluation::evaluate_each;
use crate::alerting::people::WatchedPerson;
use crate::alerting::{AlertCurve, AlertQuality, AlertsRow, MethodQuality, later, quality};
use crate::simulated::every_fault;
use homebody::shared::{Failure, ResultOutput, TextTable, alert_rules, show};
use homebody_analysis::alerts::Rules;
use homebody_analysis::measures::{DayMeasures, Measures};
use homebody_core::link::form::LinkFile;
use homebody_core::scenario::load::Scenario;
use homebody_core::sensors::Sensor;
use homebody_picture::{TotalsLine, totals_chart};
use homebody_placement::adequacy::{Adequacy, Person, Watched, adequacy};
use homebody_placement::people::{CONDITIONS, LoadedScenario, ONSET, People, PersonRun};
use homebody_simulation::template;
use serde::Serialize;
use std::fmt;
use std::path::PathBuf;

/// Measure how early alerts find conditions, and how often alerts are false
///
/// Homebody simulates people with and without conditions in the apartment of the template `older-adult`, with the variation that
/// exists between people. One in nine has no condition. Each of the others has one of the program's conditions from day 61 on,
/// mild, moderate or severe in turn. Conditions build up over their known time: infections over days, depression over weeks. The
/// alerts are those of `homebody alerts`, from the log alone.
#[derive(clap::Args)]
#[command(after_long_help = "Examples:
  homebody-lab alerts --people 200
  homebody-lab alerts --people 36 --rules rules.json --json alerts.json
  homebody-lab alerts --layouts --png curves.png

JSON has \"rows\", each with condition, rule, sensitivity, lead_days and false_alarms_per_week, with 95 %
confidence intervals; and \"curves\", the same for alert rules with other thresholds, in standard deviations.")]
pub struct AlertsLabArguments {
    /// Number of people
    #[arg(long, value_name = "N", default_value_t = 200, value_parser = clap::value_parser!(u32).range(9..=100_000))]
    people: u32,
    /// Days to simulate for each person
    #[arg(long, value_name = "N", default_value_t = 120, value_parser = clap::value_parser!(u32).range(90..=3660))]
    days: u32,
    /// Seed of all random numbers
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Also measure the delay with sensor faults, with one motion sensor per room, and without each sensor in turn
    #[arg(long)]
    layouts: bool,
    /// JSON file with alert rules, instead of the default rules
    #[arg(long, value_name = "FILE")]
    rules: Option<PathBuf>,
    /// Write the measures of each person to a file, a JSON object a line
    #[arg(long, value_name = "FILE")]
    values: Option<PathBuf>,
    #[command(flatten)]
    output: ResultOutput,
}

/// A person with the measures of each day.
#[derive(Serialize)]
struct PersonValues {
    #[serde(flatten)]
    person: WatchedPerson,
    guesses: Vec<&'static str>,
    days: Vec<(bool, DayMeasures)>,
}

const SCENARIO: &str = "older-adult";

/// The measures of a person: with all sensors, then with each of the other subsets.
type OfLayouts = Vec<Measures>;

impl AlertsLabArguments {
    pub fn run(self) -> Result<(), Failure> {
        let output = self.output.check([""], &[])?;
        if let Some(file) = &self.values {
            let people: Vec<WatchedPerson> =
                (0..self.people).map(|number| WatchedPerson::draw(number, (self.days, self.seed))).collect();
            evaluate_each(&people, "scenarios", |person| person.scenario().map(drop))?;
            let lines = evaluate_each(&people, "people", |person| {
                let Measures { guesses, days, .. } = person.measures()?;
                let days = days.into_iter().map(|day| (day.counts(), day)).collect();
                let values = PersonValues { person: person.clone(), guesses, days };
                Ok::<_, Failure>(serde_json::to_string(&values).unwrap_or_default() + "\n")
            })?;
            std::fs::write(file, lines.concat()).unwrap();
            return Ok(());
        }
        let rules = alert_rules(self.rules.as_deref())?;
        let template = template(SCENARIO)?;
        let home = LoadedScenario { scenario: template.scenario().clone(), household: template.household().clone() };
        let people = People::new(&home, &CONDITIONS, self.people, (self.days, self.seed))?;
        let layouts = if self.layouts { SensorSubset::all(&home.scenario) } else { vec![SensorSubset::AsItIs] };
        let measure = |person: &PersonRun| -> Result<OfLayouts, Failure> {
            let logged = person.simulate(&LinkFile::default())?;
            let heard = |layout: &SensorSubset| match layout {
                SensorSubset::AsItIs => logged.measures().map_err(Failure::not_measured),
                SensorSubset::WithFaults => {
                    let half = f64::from(self.days) / 2.0;
                    // Faults come as often before conditions as after.
                    let from_day = half * [0.0, 0.5, 1.0][person.number % 3];
                    let link = every_fault(&person.home.scenario, person.number, (from_day, half));
                    person.simulate(&link)?.measures().map_err(Failure::not_measured)
                }
                SensorSubset::OneInEachRoom(kept) => {
                    logged.measures_by(&|sensor| kept.iter().any(|name| name == sensor)).map_err(Failure::not_measured)
                }
                SensorSubset::Without(taken) => {
                    logged.measures_by(&|sensor| sensor != taken).map_err(Failure::not_measured)
                }
            };
            layouts.iter().map(heard).collect()
        };
        let template = "{bar:40} {pos} of {len} people  {eta} left";
        let watched: Vec<(Person, OfLayouts)> = show(u64::from(people.count()), template, |progress| {
            let advance = || {
                progress.inc(1);
                true
            };
            people.each(advance, measure)
        })?;
        let by = |layout: usize| -> Vec<Watched> {
            watched.iter().map(|(person, measures)| Watched { person, measures: &measures[layout] }).collect()
        };
        let found = AlertsExperiment {
            quality: quality(&by(0), &rules, self.days),
            layouts: compare_subsets(&layouts, &by, &rules),
        };
        output.write(&found, [&|| curves(&found.quality.curves)])
    }
}

enum SensorSubset {
    AsItIs,
    WithFaults,
    OneInEachRoom(Vec<String>),
    Without(String),
}

impl SensorSubset {
    fn all(scenario: &Scenario) -> Vec<SensorSubset> {
        let home = &scenario.home;
        let sensors = home.placed_sensors();
        let mut rooms = Vec::new();
        let of_new_room = |sensor: &&Sensor| {
            let room = sensor.info(home.plan()).room;
            let is_new = sensor.senses_motion() && room.is_some() && !rooms.contains(&room);
            rooms.push(room);
            is_new
        };
        let one_each: Vec<String> = sensors.iter().filter(of_new_room).map(|sensor| sensor.name.clone()).collect();
        let without = sensors.iter().map(|sensor| SensorSubset::Without(sensor.name.clone()));
        [SensorSubset::AsItIs, SensorSubset::WithFaults, SensorSubset::OneInEachRoom(one_each)]
            .into_iter()
            .chain(without)
            .collect()
    }
}

impl fmt::Display for SensorSubset {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            SensorSubset::AsItIs => f.write_str("all sensors"),
            SensorSubset::WithFaults => f.write_str("all sensors, with every fault"),
            SensorSubset::OneInEachRoom(kept) => write!(f, "{} motion sensors, one per room", kept.len()),
            SensorSubset::Without(sensor) => write!(f, "without {sensor}"),
        }
    }
}

/// The delay until people are found with some of the sensors.
#[derive(Serialize)]
struct SubsetQuality {
    layout: String,
    #[serde(flatten)]
    adequacy: Adequacy,
    /// Mean number of days later than with all sensors.
    later_days: f64,
    later_95: [f64; 2],
}

fn compare_subsets<'a>(
    layouts: &[SensorSubset],
    by: &dyn Fn(usize) -> Vec<Watched<'a>>,
    rules: &Rules,
) -> Vec<SubsetQuality> {
    if layouts.len() < 2 {
        return Vec::new();
    }
    let of_each: Vec<Adequacy> = (0..layouts.len()).map(|layout| adequacy(&by(layout), rules)).collect();
    let beside = |(layout, adequacy): (&SensorSubset, &Adequacy)| {
        let (later_days, later_95) = later(&of_each[0], adequacy);
        SubsetQuality { layout: layout.to_string(), adequacy: adequacy.clone(), later_days, later_95 }
    };
    layouts.iter().zip(&of_each).map(beside).collect()
}

/// Largest drawn rate of false alarms.
const DRAWN_PER_WEEK: f64 = 1.0;

fn curves(curves: &[AlertCurve]) -> String {
    let line = |curve: &AlertCurve| TotalsLine {
        label: curve.condition.clone(),
        points: (curve.points.iter().rev())
            .map(|point| (point.false_alarms_per_week, point.sensitivity))
            .filter(|(false_alarms, _)| *false_alarms <= DRAWN_PER_WEEK)
            .collect(),
    };
    let lines: Vec<TotalsLine> = curves.iter().map(line).collect();
    let axes = ["false alarms per person and week", "share found within 28 days"];
    totals_chart("Found conditions and false alarms, by number of standard deviations", axes, &lines, None)
}

#[derive(Serialize)]
struct AlertsExperiment {
    #[serde(flatten)]
    quality: AlertQuality,
    /// With `--layouts` only.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    layouts: Vec<SubsetQuality>,
}

impl fmt::Display for AlertsExperiment {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let AlertQuality { people, days, rows, false_alarms, .. } = &self.quality;
        writeln!(f, "Alerts of {people} people over {days} days; conditions begin on day {}\n", ONSET + 1)?;
        let table = TextTable::new(
            "-24 condition|-26 rule|6 people|19 found (95 %)|7 chance|6 14 d|6 28 d|6 delay|11 lead, days",
        );
        f.write_str(&table.heading())?;
        for row in rows {
            let AlertsRow { condition, rule, people, sensitivity, sensitivity_95: [low, high], within, .. } = row;
            let after = |days: usize| within.iter().find(|(after, _)| *after == days).map_or(0.0, |(_, share)| *share);
            let days = |days: Option<f64>| days.map_or("-".to_owned(), |days| format!("{days:.0}"));
            let found = format!("{sensitivity:.2} ({low:.2}-{high:.2})");
            let [chance, two, four] = [row.by_chance, after(14), after(28)].map(|share| format!("{share:.2}"));
            let [delay, lead] = [row.delay_days.map(|[_, middle, _]| middle), row.lead_days].map(days);
            let cells: [&dyn fmt::Display; 9] = [condition, rule, people, &found, &chance, &two, &four, &delay, &lead];
            f.write_str(&table.row(&cells))?;
        }
        writeln!(f, "\n{:51} per person and week (95 %)", "false alarms")?;
        for idle in false_alarms {
            let [low, high] = idle.per_week_95;
            writeln!(f, "{:51} {:.3} ({low:.3}-{high:.3})", idle.rule, idle.per_week)?;
        }
        writeln!(f, "\nControl charts by method, with at most one false alarm per person in five weeks\n")?;
        let table = TextTable::new("-12 method|5 k|13 false/week|6 found|8 days");
        f.write_str(&table.heading())?;
        for MethodQuality { method, adequacy } in &self.quality.methods {
            let [per_week, found, days] = adequacy_cells(adequacy);
            f.write_str(&table.row(&[method, &adequacy.k_sd, &per_week, &found, &days]))?;
        }
        self.write_layouts(f)
    }
}

impl AlertsExperiment {
    fn write_layouts(&self, f: &mut fmt::Formatter) -> fmt::Result {
        if self.layouts.is_empty() {
            return Ok(());
        }
        writeln!(f, "\nWith at most one false alarm per person in five weeks:\n")?;
        let table = TextTable::new("-32 layout|5 k|13 false/week|6 found|8 days|22 later, days (95 %)");
        f.write_str(&table.heading())?;
        for SubsetQuality { layout, adequacy, later_days, later_95: [low, high] } in &self.layouts {
            let [per_week, found, days] = adequacy_cells(adequacy);
            let later = format!("{later_days:+.1} ({low:+.1} to {high:+.1})");
            f.write_str(&table.row(&[layout, &adequacy.k_sd, &per_week, &found, &days, &later]))?;
        }
        Ok(())
    }
}

/// False alarms a week, found people, and days until they are found.
fn adequacy_cells(adequacy: &Adequacy) -> [String; 3] {
    let Adequacy { false_alarms_per_week, found, days, .. } = adequacy;
    [format!("{false_alarms_per_week:.2}"), format!("{found:.2}"), format!("{days:.1}")]
}
