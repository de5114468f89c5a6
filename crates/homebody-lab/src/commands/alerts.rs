//! `homebody-lab alerts`.

use super::locate::every_fault;
use crate::alerting::{Curve, OfMethod, Quality, later, quality};
use homebody::shared::{Answer, Failure, alert_rules, bar};
use homebody_analysis::alerts::Rules;
use homebody_analysis::measures::Measures;
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
pub struct Arguments {
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
    #[command(flatten)]
    answer: Answer,
}

/// The scenario of all people.
const SCENARIO: &str = "older-adult";

/// The measures of a person: by the home as it is, then by each of the other layouts.
type OfLayouts = Vec<Measures>;

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        let answer = self.answer.check([""], &[])?;
        let rules = alert_rules(self.rules.as_deref())?;
        let template = template(SCENARIO)?;
        let home = LoadedScenario { scenario: template.scenario().clone(), household: template.household().clone() };
        let people = People::new(&home, &CONDITIONS, self.people, (self.days, self.seed))?;
        let layouts = if self.layouts { Layout::all(&home.scenario) } else { vec![Layout::AsItIs] };
        let measure = |person: &PersonRun| -> Result<OfLayouts, Failure> {
            let logged = person.simulate(&LinkFile::default())?;
            let heard = |layout: &Layout| match layout {
                Layout::AsItIs => logged.measures().map_err(Failure::not_measured),
                Layout::WithFaults => {
                    let half = f64::from(self.days) / 2.0;
                    // Faults come as often before conditions as after.
                    let from_day = half * [0.0, 0.5, 1.0][person.number % 3];
                    let link = every_fault(&person.home.scenario, person.number, (from_day, half));
                    person.simulate(&link)?.measures().map_err(Failure::not_measured)
                }
                Layout::OneInEachRoom(kept) => {
                    logged.measures_by(&|sensor| kept.iter().any(|name| name == sensor)).map_err(Failure::not_measured)
                }
                Layout::Without(taken) => logged.measures_by(&|sensor| sensor != taken).map_err(Failure::not_measured),
            };
            layouts.iter().map(heard).collect()
        };
        let progress = bar(u64::from(people.count()), "{bar:40} {pos} of {len} people  {eta} left");
        let one_more = || {
            progress.inc(1);
            true
        };
        let watched: Vec<(Person, OfLayouts)> = people.each(one_more, measure)?;
        progress.finish_and_clear();
        let by = |layout: usize| -> Vec<Watched> {
            watched.iter().map(|(person, measures)| Watched { person, measures: &measures[layout] }).collect()
        };
        let found =
            Found { quality: quality(&by(0), &rules, self.days), layouts: beside_each_other(&layouts, &by, &rules) };
        answer.give(&found, [&|| curves(&found.quality.curves)])
    }
}

/// A layout of sensors.
enum Layout {
    AsItIs,
    WithFaults,
    OneInEachRoom(Vec<String>),
    Without(String),
}

impl Layout {
    fn all(scenario: &Scenario) -> Vec<Layout> {
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
        let without = sensors.iter().map(|sensor| Layout::Without(sensor.name.clone()));
        [Layout::AsItIs, Layout::WithFaults, Layout::OneInEachRoom(one_each)].into_iter().chain(without).collect()
    }
}

impl fmt::Display for Layout {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Layout::AsItIs => f.write_str("all sensors"),
            Layout::WithFaults => f.write_str("all sensors, with every fault"),
            Layout::OneInEachRoom(kept) => write!(f, "{} motion sensors, one per room", kept.len()),
            Layout::Without(sensor) => write!(f, "without {sensor}"),
        }
    }
}

/// The delay until people are found by one layout.
#[derive(Serialize)]
struct OfLayout {
    layout: String,
    #[serde(flatten)]
    adequacy: Adequacy,
    /// How many days later than by all sensors, on average.
    later_days: f64,
    /// The interval of 95 %.
    later_95: [f64; 2],
}

fn beside_each_other<'a>(layouts: &[Layout], by: &dyn Fn(usize) -> Vec<Watched<'a>>, rules: &Rules) -> Vec<OfLayout> {
    if layouts.len() < 2 {
        return Vec::new();
    }
    let of_each: Vec<Adequacy> = (0..layouts.len()).map(|layout| adequacy(&by(layout), rules)).collect();
    let beside = |(layout, adequacy): (&Layout, &Adequacy)| {
        let (later_days, later_95) = later(&of_each[0], adequacy);
        OfLayout { layout: layout.to_string(), adequacy: adequacy.clone(), later_days, later_95 }
    };
    layouts.iter().zip(&of_each).map(beside).collect()
}

/// Curves are drawn as far as anybody would bear.
const DRAWN_PER_WEEK: f64 = 1.0;

/// Sensitivity against false alarms: a line for each condition.
fn curves(curves: &[Curve]) -> String {
    let line = |curve: &Curve| TotalsLine {
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

/// The result as text.
#[derive(Serialize)]
struct Found {
    #[serde(flatten)]
    quality: Quality,
    /// Where layouts are asked for.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    layouts: Vec<OfLayout>,
}

impl fmt::Display for Found {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Quality { people, days, rows, false_alarms, .. } = &self.quality;
        writeln!(f, "Alerts of {people} people over {days} days; conditions begin on day {}\n", ONSET + 1)?;
        writeln!(
            f,
            "{:24} {:26} {:>6} {:>19} {:>7} {:>6} {:>6} {:>6} {:>11}",
            "condition", "rule", "people", "found (95 %)", "chance", "14 d", "28 d", "delay", "lead, days"
        )?;
        for row in rows {
            let within =
                |days: usize| row.within.iter().find(|(after, _)| *after == days).map_or(0.0, |(_, share)| *share);
            let [low, high] = row.sensitivity_95;
            let days = |days: Option<f64>| days.map_or("-".to_owned(), |days| format!("{days:.0}"));
            let found = format!("{:.2} ({low:.2}-{high:.2})", row.sensitivity);
            writeln!(
                f,
                "{:24} {:26} {:>6} {found:>19} {:>7.2} {:>6.2} {:>6.2} {:>6} {:>11}",
                row.condition,
                row.rule,
                row.people,
                row.by_chance,
                within(14),
                within(28),
                days(row.delay_days.map(|[_, middle, _]| middle)),
                days(row.lead_days)
            )?;
        }
        writeln!(f, "\n{:51} per person and week (95 %)", "false alarms")?;
        for idle in false_alarms {
            let [low, high] = idle.per_week_95;
            writeln!(f, "{:51} {:.3} ({low:.3}-{high:.3})", idle.rule, idle.per_week)?;
        }
        writeln!(f, "\nControl charts by method, with at most one false alarm per person in five weeks\n")?;
        writeln!(f, "{:12} {:>5} {:>13} {:>6} {:>8}", "method", "k", "false/week", "found", "days")?;
        for OfMethod { method, adequacy } in &self.quality.methods {
            let Adequacy { k_sd, false_alarms_per_week, found, days, .. } = adequacy;
            writeln!(f, "{method:12} {k_sd:>5} {false_alarms_per_week:>13.2} {found:>6.2} {days:>8.1}")?;
        }
        self.tell_layouts(f)
    }
}

impl Found {
    fn tell_layouts(&self, f: &mut fmt::Formatter) -> fmt::Result {
        if self.layouts.is_empty() {
            return Ok(());
        }
        writeln!(f, "\nWith at most one false alarm per person in five weeks:\n")?;
        writeln!(
            f,
            "{:32} {:>5} {:>13} {:>6} {:>8} {:>22}",
            "layout", "k", "false/week", "found", "days", "later, days (95 %)"
        )?;
        for OfLayout { layout, adequacy, later_days, later_95: [low, high] } in &self.layouts {
            let Adequacy { k_sd, false_alarms_per_week, found, days, .. } = adequacy;
            writeln!(
                f,
                "{layout:32} {k_sd:>5} {false_alarms_per_week:>13.2} {found:>6.2} {days:>8.1} {:>22}",
                format!("{later_days:+.1} ({low:+.1} to {high:+.1})")
            )?;
        }
        Ok(())
    }
}
