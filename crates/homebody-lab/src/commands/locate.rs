use super::evaluation::evaluate_each;
use crate::locating::{LocatingCase, SimulatedHome, case};
use crate::simulated::every_fault;
use homebody::shared::{Failure, JsonOutput, TextTable};
use homebody_core::link::form::LinkFile;
use homebody_routine::household::Household;
use homebody_routine::routine::ResidentKind;
use homebody_simulation::{OpenScenario, template};
use serde::Serialize;
use std::fmt;

/// Measure how well the command homebody locate finds residents
///
/// Homebody compares the located rooms with the ground truth, and with two simpler methods. The homes cycle through the templates,
/// each with its own seed; every fifth home has two residents and a cat. Each home has two logs: one without losses, and one with
/// every sensor fault. The method knows the home and its sensors, and nothing of the routines.
#[derive(clap::Args)]
#[command(after_long_help = "Examples:
  homebody-lab locate
  homebody-lab locate --homes 5 --days 3 --json locate.json")]
pub struct LocateLabArguments {
    /// Number of homes
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = clap::value_parser!(u32).range(1..=1000))]
    homes: u32,
    /// Days to simulate for each home
    #[arg(long, value_name = "N", default_value_t = 7, value_parser = clap::value_parser!(u32).range(1..=366))]
    days: u32,
    #[command(flatten)]
    output: JsonOutput,
}

const HOMES: [&str; 5] = ["tigerplace", "older-adult", "studio", "house-two-floors", "couple-with-cat"];

#[derive(Serialize)]
struct LocatingExperiment {
    days: u32,
    cases: Vec<LocatingCase>,
}

impl LocateLabArguments {
    pub fn run(self) -> Result<(), Failure> {
        let output = self.output.check(&[])?;
        let cases = with_and_without_faults(self.homes, self.days, |home| home, case)?;
        let cases = cases.into_iter().map(|(_, case)| case).collect();
        output.write(&LocatingExperiment { days: self.days, cases }, [])
    }
}

/// The index of a home among all homes, by its index among those with one resident, which come before the last of [`HOMES`].
pub(super) fn single_home(number: usize) -> usize {
    let of_one = HOMES.len() - 1;
    number / of_one * HOMES.len() + number % of_one
}

/// Evaluates each case, on all processors, with the template of its home number.
pub(super) fn each_home<C: Sync, T: Send>(
    cases: &[C],
    home: impl Fn(&C) -> usize + Sync,
    ask: impl Fn(&OpenScenario, &C) -> Result<T, Failure> + Sync,
) -> Result<Vec<T>, Failure> {
    let opened = HOMES.map(template).into_iter().collect::<Result<Vec<OpenScenario>, _>>()?;
    evaluate_each(cases, "logs", |case| ask(&opened[home(case) % HOMES.len()], case))
}

/// Evaluates homes with a perfect link, and with every fault; each result says if it is with faults. `template` maps a home number to
/// that of its template.
pub(super) fn with_and_without_faults<T: Send, E: fmt::Display>(
    homes: u32,
    days: u32,
    template: impl Fn(usize) -> usize + Sync,
    ask: impl Fn(&SimulatedHome, u64, u32) -> Result<T, E> + Sync,
) -> Result<Vec<(bool, T)>, Failure> {
    let cases: Vec<(usize, bool)> = (0..homes as usize).flat_map(|home| [(home, false), (home, true)]).collect();
    let of_case = |opened: &OpenScenario, &(number, faults): &(usize, bool)| {
        let link = match faults {
            true => every_fault(opened.scenario(), number, (0.0, days.into())),
            false => LinkFile::default(),
        };
        Ok((faults, with_link(opened, &link, |home| ask(home, 1 + number as u64, days))?))
    };
    each_home(&cases, |&(number, _)| template(number), of_case)
}

pub(super) fn is_person(household: &Household, resident: usize) -> bool {
    let person = household.routine(resident).and_then(|routine| routine.person.as_ref());
    person.is_none_or(|person| person.kind == ResidentKind::Person)
}

pub(super) fn with_link<T, E: fmt::Display>(
    opened: &OpenScenario,
    link: &LinkFile,
    ask: impl FnOnce(&SimulatedHome) -> Result<T, E>,
) -> Result<T, Failure> {
    let household = opened.household();
    let residents = 0..opened.scenario().residents.len();
    let people = residents.filter(|&resident| is_person(household, resident)).collect();
    let scenario = opened.scenario().edit().link(link).load()?;
    ask(&SimulatedHome { scenario: &scenario, drivers: household, people }).map_err(Failure::not_measured)
}

impl fmt::Display for LocatingExperiment {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        writeln!(f, "Residents located from the logs of {} days; shares of the time in the right room\n", self.days)?;
        let table = TextTable::new(
            "-18 home|4 seed|6 people|6 faults|7 right|6 live|6 last|6 rooms|7 visits|6 p50 m|6 p90 m|7 guests|8 invented",
        );
        f.write_str(&table.heading())?;
        for case in &self.cases {
            let LocatingCase { home, seed, residents, room_right, room_right_live, visits_found, .. } = case;
            let share = |value: f64| format!("{value:.3}");
            let [right, live, visits] = [*room_right, *room_right_live, *visits_found].map(share);
            let [last, rooms] = [case.last_firing_right, case.rooms_only_right].map(share);
            let metres = |value: Option<f64>| value.map_or("-".into(), |value| format!("{value:.2}"));
            let [p50, p90] = [case.p50_m, case.p90_m].map(metres);
            let share = |value: Option<f64>| value.map_or("-".into(), share);
            let [guests, invented] = [case.visitors_found, case.visitors_invented].map(share);
            let faults = if case.faults { "every" } else { "none" };
            let cells: [&dyn fmt::Display; 13] =
                [home, seed, residents, &faults, &right, &live, &last, &rooms, &visits, &p50, &p90, &guests, &invented];
            f.write_str(&table.row(&cells))?;
        }
        writeln!(f)?;
        for (what, faults, several) in [
            ("one person, no faults", false, false),
            ("one person, every fault", true, false),
            ("two people, no faults", false, true),
            ("two people, every fault", true, true),
        ] {
            let fits = |case: &&LocatingCase| case.faults == faults && (case.residents > 1) == several;
            let cases: Vec<&LocatingCase> = self.cases.iter().filter(fits).collect();
            if cases.is_empty() {
                continue;
            }
            let mean =
                |of: fn(&LocatingCase) -> f64| cases.iter().map(|case| of(case)).sum::<f64>() / cases.len() as f64;
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
