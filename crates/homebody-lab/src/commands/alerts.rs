use super::evaluation::evaluate_each;
use crate::alerting::people::{StoredPerson, WatchedPerson};
use crate::alerting::protocol::{FoundRow, Judged, MethodResult, WITHIN, judge};
use crate::alerting::{BEARABLE_PER_WEEK, fit_baselines, fit_patterns, later, methods};
use crate::simulated::every_fault;
use homebody::shared::{Failure, JsonOutput, TextTable, show, write_file};
use homebody_analysis::measures::Measures;
use homebody_core::link::form::LinkFile;
use homebody_core::scenario::load::Scenario;
use homebody_core::sensors::Sensor;
use homebody_log::LogError;
use homebody_placement::adequacy::{Adequacy, Person, Watched, adequacy};
use homebody_placement::people::{CONDITIONS, LoadedScenario, People, PersonRun};
use homebody_simulation::template;
use rayon::prelude::*;
use serde::Serialize;
use std::fmt;
use std::path::{Path, PathBuf};

/// Measure how early changes are found, and how often news of them is false
///
/// Homebody simulates people in five homes, one of them with two residents. Half of them get one of eight conditions, mild, moderate or
/// severe, from a random day on. All have a holiday, most a guest, some a stay in hospital, and half of the homes have every sensor
/// fault. News comes day by day, from the log alone. The table compares the episodes of `homebody alerts` with three simple
/// methods. The threshold of each was fitted on other people.
#[derive(clap::Args)]
#[command(after_long_help = "Examples:
  homebody-lab alerts --people 400 --seed 7
  homebody-lab alerts --people 400 --save people.jsonl --json alerts.json
  homebody-lab alerts --load people.jsonl
  homebody-lab alerts --people 600 --seed 1 --fit
  homebody-lab alerts --layouts --people 200 --days 120

--fit writes the patterns and thresholds that come with the program, from the root of its sources.")]
pub struct AlertsLabArguments {
    /// Number of people
    #[arg(long, value_name = "N", default_value_t = 400, value_parser = clap::value_parser!(u32).range(9..=100_000))]
    people: u32,
    /// Days to simulate for each person
    #[arg(long, value_name = "N", default_value_t = 365, value_parser = clap::value_parser!(u32).range(90..=3660))]
    days: u32,
    /// Seed of all random numbers
    #[arg(long, value_name = "N", default_value_t = 7)]
    seed: u64,
    /// Also write the measures of all people to a file
    #[arg(long, value_name = "FILE")]
    save: Option<PathBuf>,
    /// Take people from files of --save, instead of simulating; repeatable
    #[arg(long, value_name = "FILE")]
    load: Vec<PathBuf>,
    /// Fit the patterns and the thresholds on these people
    #[arg(long)]
    fit: bool,
    /// Measure the delay with sensor faults, with one motion sensor per room, and without each sensor in turn, in the home of older-adult
    #[arg(long, conflicts_with_all = ["fit", "save", "load"])]
    layouts: bool,
    #[command(flatten)]
    output: JsonOutput,
}

const SCENARIO: &str = "older-adult";
/// The files that `--fit` writes.
const PATTERNS: &str = "crates/homebody-analysis/src/episodes/patterns.json";
const BASELINES: &str = "crates/homebody-lab/src/alerting/baselines.json";

/// The measures of a person: with all sensors, then with each of the other subsets.
type OfLayouts = Vec<Measures>;

impl AlertsLabArguments {
    pub fn run(self) -> Result<(), Failure> {
        let output = self.output.check(&[])?;
        if self.layouts {
            return output.write(&LayoutsExperiment { people: self.people, layouts: self.layouts()? }, []);
        }
        let people = self.judged()?;
        if self.fit {
            return self.write_fit(&people);
        }
        let methods: Vec<MethodResult> = methods().par_iter().map(|method| judge(&people, method)).collect();
        let days = people.first().map_or(0, |one| one.measures.days.len());
        output.write(&AlertsExperiment { people: people.len(), days, methods }, [])
    }

    /// The people with their measures, simulated or from files.
    fn judged(&self) -> Result<Vec<Judged>, Failure> {
        let stored = if self.load.is_empty() { self.simulated()? } else { loaded(&self.load)? };
        if let Some(file) = &self.save {
            let lines: Vec<String> = stored.iter().filter_map(|one| serde_json::to_string(one).ok()).collect();
            write_file(file, (lines.join("\n") + "\n").as_bytes(), false)?;
        }
        Ok(stored.iter().map(Judged::stored).collect())
    }

    fn simulated(&self) -> Result<Vec<StoredPerson>, Failure> {
        let people: Vec<WatchedPerson> =
            (0..self.people).map(|number| WatchedPerson::draw(number, (self.days, self.seed))).collect();
        // A problem of the last person would come late.
        evaluate_each(&people, "scenarios", |person| person.scenario().map(drop))?;
        evaluate_each(&people, "people", |person| {
            Ok::<_, Failure>(StoredPerson::new(person.number, self.seed, &person.measures()?))
        })
    }

    fn write_fit(&self, people: &[Judged]) -> Result<(), Failure> {
        let by = format!("homebody-lab alerts --fit, {} people", people.len());
        let patterns = fit_patterns(people, by);
        let baselines = fit_baselines(people, BEARABLE_PER_WEEK);
        let write = |file: &str, text: Result<String, serde_json::Error>| {
            write_file(Path::new(file), (text.unwrap_or_default() + "\n").as_bytes(), true)
        };
        write(PATTERNS, serde_json::to_string_pretty(&patterns))?;
        write(BASELINES, serde_json::to_string_pretty(&baselines))
    }

    fn layouts(&self) -> Result<Vec<SubsetQuality>, Failure> {
        let template = template(SCENARIO)?;
        let home = LoadedScenario { scenario: template.scenario().clone(), household: template.household().clone() };
        let people = People::new(&home, &CONDITIONS, self.people, (self.days, self.seed))?;
        let layouts = SensorSubset::all(&home.scenario);
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
        Ok(compare_subsets(&layouts, &by))
    }
}

/// The people of files that `--save` wrote.
fn loaded(files: &[PathBuf]) -> Result<Vec<StoredPerson>, Failure> {
    let mut people = Vec::new();
    for file in files {
        let text = std::fs::read_to_string(file).map_err(|error| LogError::reading(file, error))?;
        for line in text.lines() {
            let one = serde_json::from_str(line);
            people.push(one.map_err(|error| LogError::reading(file, std::io::Error::other(error)))?);
        }
    }
    Ok(people)
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

fn compare_subsets<'a>(layouts: &[SensorSubset], by: &dyn Fn(usize) -> Vec<Watched<'a>>) -> Vec<SubsetQuality> {
    let of_each: Vec<Adequacy> = (0..layouts.len()).map(|layout| adequacy(&by(layout))).collect();
    let beside = |(layout, adequacy): (&SensorSubset, &Adequacy)| {
        let (later_days, later_95) = later(&of_each[0], adequacy);
        SubsetQuality { layout: layout.to_string(), adequacy: adequacy.clone(), later_days, later_95 }
    };
    layouts.iter().zip(&of_each).map(beside).collect()
}

#[derive(Serialize)]
struct AlertsExperiment {
    people: usize,
    days: usize,
    methods: Vec<MethodResult>,
}

impl fmt::Display for AlertsExperiment {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        writeln!(f, "News about {} people over {} days\n", self.people, self.days)?;
        let table = TextTable::new("-20 method|9 threshold|23 false per week (95 %)|9 precision|5 AUPRC|9 condition");
        f.write_str(&table.heading())?;
        for MethodResult { method, threshold, false_per_week, false_95: [low, high], precision, area, .. } in
            &self.methods
        {
            let per_week = format!("{false_per_week:.3} ({low:.3}-{high:.3})");
            let cells = [format!("{threshold:.2}"), per_week, format!("{precision:.2}"), format!("{area:.2}")];
            let [threshold, per_week, precision, area] = &cells;
            f.write_str(&table.row(&[method, threshold, per_week, precision, area]))?;
        }
        for MethodResult { method, rows, .. } in &self.methods {
            writeln!(f, "\n{method}: share found (95 %)\n")?;
            let table = TextTable::new(
                "-24 condition|-9 severity|6 people|17 7 days|17 14 days|17 28 days|14 days (quartiles)",
            );
            f.write_str(&table.heading())?;
            rows.iter().try_for_each(|row| f.write_str(&found_row(&table, row)))?;
        }
        Ok(())
    }
}

fn found_row(table: &TextTable, FoundRow { condition, severity, people, within, days }: &FoundRow) -> String {
    let share = |wanted: usize| {
        let of = within.iter().find(|(days, ..)| *days == wanted);
        of.map_or(String::new(), |(_, share, [low, high])| format!("{share:.2} ({low:.2}-{high:.2})"))
    };
    let [week, two, four] = WITHIN.map(share);
    let days = days.map_or("-".to_owned(), |[low, middle, high]| format!("{middle:.0} ({low:.0}-{high:.0})"));
    table.row(&[condition, severity, people, &week, &two, &four, &days])
}

#[derive(Serialize)]
struct LayoutsExperiment {
    people: u32,
    layouts: Vec<SubsetQuality>,
}

impl fmt::Display for LayoutsExperiment {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        writeln!(f, "{} people, with at most one false episode per person in ten weeks:\n", self.people)?;
        let table = TextTable::new("-32 layout|9 threshold|10 false/week|6 found|8 days|22 later, days (95 %)");
        f.write_str(&table.heading())?;
        for SubsetQuality { layout, adequacy, later_days, later_95: [low, high] } in &self.layouts {
            let Adequacy { threshold, false_episodes_per_week, found, days, .. } = adequacy;
            let cells = [format!("{false_episodes_per_week:.2}"), format!("{found:.2}"), format!("{days:.1}")];
            let later = format!("{later_days:+.1} ({low:+.1} to {high:+.1})");
            let [per_week, found, days] = &cells;
            f.write_str(&table.row(&[layout, threshold, per_week, found, days, &later]))?;
        }
        Ok(())
    }
}
