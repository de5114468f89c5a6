//! `homebody experiment daily-life`.

use crate::commands::answer::Answer;
use crate::failure::Failure;
use crate::progress::bar;
use homebody_core::drivers::error::DriverError;
use homebody_core::event::Events;
use homebody_core::ids::{ResidentId, RoomId};
use homebody_core::random::Stream;
use homebody_core::run::Run;
use homebody_core::scenario::home::SensorFile;
use homebody_core::scenario::load::Scenario;
use homebody_core::scenario::logger::MessagesFile;
use homebody_core::time::{DAY, micros};
use homebody_experiment::daily_life::{Experiment, Lived, Person};
use homebody_kit::Error;
use homebody_routine::household::Household;
use rayon::prelude::*;

/// Compare simulated older adults with published figures
///
/// Each person has the routine and the apartment of the template `older-adult`, with the variation that exists between people.
/// Homebody measures sleep, toilet visits, meals, use of time, walks and events, and compares them with published figures. The
/// first day does not count.
#[derive(clap::Args)]
#[command(after_long_help = "Example:\n  homebody experiment daily-life --people 20 --days 14 --png people.png")]
pub struct Arguments {
    /// Number of people
    #[arg(long, value_name = "N", default_value_t = 100, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    people: u32,
    /// Days to simulate for each person; the first day does not count
    #[arg(long, value_name = "N", default_value_t = 28, value_parser = clap::value_parser!(u32).range(2..=3660))]
    days: u32,
    /// Seed of all random numbers
    #[arg(long, value_name = "N", default_value_t = 2012)]
    seed: u64,
    #[command(flatten)]
    answer: Answer,
}

/// The scenario that all of them live.
const SCENARIO: &str = "older-adult";

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        let answer = self.answer.check(["", "hours"], &[])?;
        let opened = homebody_kit::template(SCENARIO)?;
        let (scenario, household) = (opened.scenario(), opened.household().one_of_many());
        let progress = bar(u64::from(self.people), "{bar:40} {pos} of {len} people  {eta} left");
        let live = |number: u32| {
            let seed = seed_of(self.seed, number);
            let person = live(scenario, &household, seed, self.days)?;
            progress.inc(1);
            Ok(person)
        };
        // In order of their numbers, whichever is done first.
        let pool = rayon::ThreadPoolBuilder::new().build();
        let pool = pool.map_err(|error| Error::Threads { why: error.to_string() })?;
        let persons: Result<Vec<Person>, DriverError> =
            pool.install(|| (0..self.people).into_par_iter().map(live).collect());
        progress.finish_and_clear();
        let persons = persons?;
        let experiment = Experiment::of(persons, self.seed);
        answer.give(&experiment, [&|| experiment.chart(), &|| experiment.hours()])
    }
}

/// A person's own seed: the same person, however many others there are.
fn seed_of(seed: u64, number: u32) -> u64 {
    const WHOLE: f64 = (1_u64 << 53) as f64;
    (Stream::named(seed, &format!("experiment/daily-life/person/{number}")).unit() * WHOLE) as u64
}

/// One person's days, measured.
fn live(scenario: &Scenario, household: &Household, seed: u64, days: u32) -> Result<Person, DriverError> {
    let length = i64::from(days) * DAY;
    let mut run = Run::new(scenario, household, seed, length);
    let mut events = Events::default();
    run.advance(length, &mut events)?;
    let is_motion: Vec<bool> = scenario.home.sensors.iter().map(SensorFile::senses_motion).collect();
    let hold = match &scenario.logger.messages {
        // Each firing is an ON of its own.
        MessagesFile::FireOnly => 1,
        MessagesFile::OnOff(on_off) => micros(on_off.hold_s),
        MessagesFile::Occupancy(occupancy) => micros(occupancy.timeout_s),
    };
    let rooms = &run.home().plan.rooms;
    let hall = rooms.iter().position(|room| room.name == "hall").map(RoomId::of);
    Ok(Person::of(&Lived {
        events: &events,
        resident: ResidentId(0),
        calendar: &scenario.calendar,
        days: 1..days as i32,
        hall,
        is_motion: &is_motion,
        hold,
    }))
}
