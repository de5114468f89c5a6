use super::evaluation::evaluate_each;
use crate::daily_life::{DailyLifeExperiment, PersonFigures, PersonRecord};
use crate::simulated::all_events;
use homebody::shared::{Failure, ResultOutput};
use homebody_core::drivers::error::DriverError;
use homebody_core::ids::ResidentId;
use homebody_core::random::Stream;
use homebody_core::run::Run;
use homebody_core::scenario::load::Scenario;
use homebody_core::scenario::logger::MessagesFile;
use homebody_core::sensors::kinds::SensorFile;
use homebody_core::time::{DAY, Span};
use homebody_routine::household::Household;
use homebody_timeline::{PersonTimeline, TimelineBuilder};

/// Compare simulated older adults with published figures
///
/// Each person has the routine and the apartment of the template `older-adult`, with the variation that exists between people.
/// Homebody measures sleep, toilet visits, meals, use of time, walks and events, and compares them with published figures. The
/// first day does not count.
#[derive(clap::Args)]
#[command(after_long_help = "Example:\n  homebody-lab daily-life --people 20 --days 14 --png people.png")]
pub struct DailyLifeLabArguments {
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
    output: ResultOutput,
}

const SCENARIO: &str = "older-adult";

impl DailyLifeLabArguments {
    pub fn run(self) -> Result<(), Failure> {
        let output = self.output.check(["", "hours"], &[])?;
        let opened = homebody_simulation::template(SCENARIO)?;
        let (scenario, household) = (opened.scenario(), opened.household().one_of_many());
        let numbers: Vec<u32> = (0..self.people).collect();
        let persons = evaluate_each(&numbers, "people", |&number| {
            simulate(scenario, &household, seed_of(self.seed, number), self.days)
        })?;
        let experiment = DailyLifeExperiment::from_people(persons, self.seed);
        output.write(&experiment, [&|| experiment.chart(), &|| experiment.hours()])
    }
}

/// The seed of a person, which does not depend on the number of people.
fn seed_of(seed: u64, number: u32) -> u64 {
    const WHOLE: f64 = (1_u64 << 53) as f64;
    (Stream::named(seed, &format!("experiment/daily-life/person/{number}")).unit() * WHOLE) as u64
}

fn simulate(scenario: &Scenario, household: &Household, seed: u64, days: u32) -> Result<PersonFigures, DriverError> {
    let length = i64::from(days) * DAY;
    let mut run = Run::new(scenario, household, seed, length);
    let events = all_events(&mut run)?;
    let is_motion: Vec<bool> = scenario.home.sensors.iter().map(SensorFile::senses_motion).collect();
    let hold = match &scenario.logger.messages {
        // Each firing is an ON of its own.
        MessagesFile::FireOnly => Span::MICROSECOND,
        MessagesFile::OnOff(on_off) => Span::from_seconds(on_off.hold_s),
        MessagesFile::Occupancy(occupancy) => Span::from_seconds(occupancy.timeout_s),
    };
    let mut timeline = TimelineBuilder::for_run(&run);
    timeline.take(&events.facts);
    let timeline = timeline.finish(scenario.calendar.instant(days as i32, Span::ZERO));
    Ok(PersonFigures::measure(&PersonRecord {
        events: &events,
        resident: ResidentId(0),
        timeline: timeline.people.first().unwrap_or(&PersonTimeline::default()),
        calendar: &scenario.calendar,
        days: 1..days as i32,
        hall: Some("hall"),
        is_motion: &is_motion,
        hold,
    }))
}
