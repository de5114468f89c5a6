//! `homebody experiment locate`.

use crate::commands::answer::Figures;
use crate::failure::Failure;
use crate::progress::bar;
use homebody_core::scenario::link::LinkFile;
use homebody_core::scenario::load::Scenario;
use homebody_experiment::walk_back::{Case, Home, case};
use homebody_kit::{OpenScenario, template};
use homebody_routine::routine::Kind;
use rayon::prelude::*;
use serde::Serialize;
use std::fmt;

/// Measure how well the command homebody locate finds residents
///
/// Homebody compares the located rooms with the ground truth, and with two simpler methods. The homes cycle through the templates,
/// each with its own seed; every fifth home has two residents and a cat. Each home has two logs: one without losses, and one with
/// every sensor fault. The method knows the home and its sensors, and nothing of the routines.
#[derive(clap::Args)]
#[command(after_long_help = "Examples:
  homebody experiment locate
  homebody experiment locate --homes 5 --days 3 --json locate.json")]
pub struct Arguments {
    /// Number of homes
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = clap::value_parser!(u32).range(1..=1000))]
    homes: u32,
    /// Days to simulate for each home
    #[arg(long, value_name = "N", default_value_t = 7, value_parser = clap::value_parser!(u32).range(1..=366))]
    days: u32,
    #[command(flatten)]
    figures: Figures,
}

/// The templates whose homes are walked back, in turn.
const HOMES: [&str; 5] = ["tigerplace", "older-adult", "studio", "house-two-floors", "couple-with-cat"];

#[derive(Serialize)]
struct WalkBack {
    days: u32,
    cases: Vec<Case>,
}

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        let answer = self.figures.check(&[])?;
        let asked: Vec<(usize, bool)> =
            (0..self.homes as usize).flat_map(|home| [(home, false), (home, true)]).collect();
        let cases = of_homes(
            &asked,
            |&(home, _)| home,
            |opened, &(home, faults)| {
                let link = if faults {
                    every_fault(opened.scenario(), home, (0.0, self.days.into()))
                } else {
                    LinkFile::default()
                };
                lived(opened, &link, |lived| case(lived, 1 + home as u64, self.days))
            },
        )?;
        answer.give(&WalkBack { days: self.days, cases }, [])
    }
}

/// The number of a home among all homes, by its number among those with one resident, which come before the last of [`HOMES`].
pub(super) fn of_one(number: usize) -> usize {
    let of_one = HOMES.len() - 1;
    number / of_one * HOMES.len() + number % of_one
}

/// Asks something of each case, on all processors: the template of its home goes by the home's number.
pub(super) fn of_homes<Case: Sync, T: Send>(
    cases: &[Case],
    home: impl Fn(&Case) -> usize + Sync,
    ask: impl Fn(&OpenScenario, &Case) -> Result<T, Failure> + Sync,
) -> Result<Vec<T>, Failure> {
    let opened = HOMES.map(template).into_iter().collect::<Result<Vec<OpenScenario>, _>>()?;
    let progress = bar(cases.len() as u64, "{bar:40} {pos} of {len} logs  {eta} left");
    let ask = |case: &Case| {
        let answer = ask(&opened[home(case) % HOMES.len()], case);
        progress.inc(1);
        answer
    };
    let answers = cases.par_iter().map(ask).collect();
    progress.finish_and_clear();
    answers
}

/// Asks a question of a home with this link.
pub(super) fn lived<T, E: fmt::Display>(
    opened: &OpenScenario,
    link: &LinkFile,
    ask: impl FnOnce(&Home) -> Result<T, E>,
) -> Result<T, Failure> {
    let household = opened.household();
    let is_person = |body: &usize| {
        let person = household.routine(*body).and_then(|routine| routine.person.as_ref());
        person.is_none_or(|person| person.kind == Kind::Person)
    };
    let people: Vec<usize> = (0..opened.scenario().residents.len()).filter(is_person).collect();
    let scenario = opened.scenario().edit().link(link).load()?;
    ask(&Home { scenario: &scenario, drivers: household, people }).map_err(Failure::not_measured)
}

/// A link of a real network with every fault on in a span of days, each of another of the motion sensors.
pub(super) fn every_fault(scenario: &Scenario, home: usize, (from_day, days): (f64, f64)) -> LinkFile {
    let sensors = scenario.home.placed_sensors();
    let motion: Vec<&str> =
        sensors.iter().filter(|sensor| sensor.senses_motion()).map(|sensor| sensor.name.as_str()).collect();
    let nth = |number: usize| motion[(home * 3 + number * 2) % motion.len()];
    let within = |share: f64| share * days;
    let day = |share: f64| from_day + within(share);
    let faults = serde_json::json!([
        { "kind": "battery", "sensor": nth(0), "from_day": day(0.3), "fading_days": within(0.2), "days": within(0.4) },
        { "kind": "falls_off", "sensor": nth(1), "from_day": day(0.6), "days": within(0.3) },
        { "kind": "stuck", "sensor": nth(2), "from_day": day(0.5), "days": within(0.1), "every_s": 60 },
        { "kind": "drift", "sensor": nth(3), "ppm": 20 },
        { "kind": "false_fires", "sensor": nth(4), "per_h": 2, "between": ["10:00", "15:00"] },
        { "kind": "outage", "from_day": day(0.4), "at": "13:00", "hours": 3 }
    ]);
    let link = serde_json::json!({ "preset": "zigbee", "duplicates": 0.01, "corruption": 0.001, "faults": faults });
    serde_json::from_value(link).unwrap_or_default()
}

impl fmt::Display for WalkBack {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        writeln!(f, "Residents located from the logs of {} days; shares of the time in the right room\n", self.days)?;
        writeln!(
            f,
            "{:<18} {:>4} {:>6} {:>6}  {:>6} {:>6} {:>6} {:>6}  {:>6} {:>6} {:>6}  {:>6} {:>8}",
            "home",
            "seed",
            "people",
            "faults",
            "right",
            "live",
            "last",
            "rooms",
            "visits",
            "p50 m",
            "p90 m",
            "guests",
            "invented"
        )?;
        for case in &self.cases {
            let share = |value: Option<f64>| value.map_or("-".into(), |value| format!("{value:.3}"));
            let metres = |value: Option<f64>| value.map_or("-".into(), |value| format!("{value:.2}"));
            writeln!(
                f,
                "{:<18} {:>4} {:>6} {:>6}  {:>6.3} {:>6.3} {:>6.3} {:>6.3}  {:>6.3} {:>6} {:>6}  {:>6} {:>8}",
                case.home,
                case.seed,
                case.residents,
                if case.faults { "every" } else { "none" },
                case.room_right,
                case.room_right_live,
                case.last_firing_right,
                case.rooms_only_right,
                case.visits_found,
                metres(case.p50_m),
                metres(case.p90_m),
                share(case.visitors_found),
                share(case.visitors_invented)
            )?;
        }
        writeln!(f)?;
        for (what, faults, several) in [
            ("one person, no faults", false, false),
            ("one person, every fault", true, false),
            ("two people, no faults", false, true),
            ("two people, every fault", true, true),
        ] {
            let fits = |case: &&Case| case.faults == faults && (case.residents > 1) == several;
            let cases: Vec<&Case> = self.cases.iter().filter(fits).collect();
            if cases.is_empty() {
                continue;
            }
            let mean = |of: fn(&Case) -> f64| cases.iter().map(|case| of(case)).sum::<f64>() / cases.len() as f64;
            writeln!(
                f,
                "{what:<24} right {:.3}, live {:.3}, by the last event {:.3}, by rooms alone {:.3}, visits found {:.3}",
                mean(|case| case.room_right),
                mean(|case| case.room_right_live),
                mean(|case| case.last_firing_right),
                mean(|case| case.rooms_only_right),
                mean(|case| case.visits_found)
            )?;
        }
        Ok(())
    }
}
