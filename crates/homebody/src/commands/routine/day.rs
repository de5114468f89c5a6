//! `homebody routine day`: one simulated day.

use super::messages::RoutinesMessage;
use crate::commands::result_output::ResultOutput;
use crate::commands::scenario::ScenarioArguments;
use crate::failure::Failure;
use homebody_analysis::day::DayRecord;
use homebody_core::time::{RunTime, Span, TimeScale, WallTime};
use homebody_log::Log;
use homebody_picture::{DayChart, day_chart};
use homebody_simulation::{RunLength, RunOptions, Simulation, VariantOptions};
use homebody_timeline::{PersonTimeline, TimelineBuilder};

/// Simulate a day and show activities and rooms, with a chart
///
/// The day is the same as in a run of the scenario with the same seed.
#[derive(clap::Args)]
#[command(after_long_help = "Examples:
  homebody routine day scenarios/tigerplace
  homebody routine day scenarios/tigerplace-depression 2009-06-01 --svg day.svg
  homebody routine day scenarios/tigerplace-depression 2009-06-01 --without depression")]
pub struct RoutineDayArguments {
    #[command(flatten)]
    scenario: ScenarioArguments,
    /// Date, such as 2009-03-02 (default: the second day of the run, because the first begins at night)
    #[arg(value_name = "DATE")]
    date: Option<jiff::civil::Date>,
    #[command(flatten)]
    variant: VariantOptions,
    #[command(flatten)]
    answer: ResultOutput,
}

impl RoutineDayArguments {
    pub fn run(self) -> Result<(), Failure> {
        let opened = self.scenario.source()?.open()?;
        let scenario = opened.scenario();
        let answer = self.answer.check([""], &opened.paths())?;
        let first = scenario.calendar.local(RunTime::START).date();
        let date = self.date.unwrap_or_else(|| first.saturating_add(jiff::Span::new().days(1)));
        let day = (date - first).get_days();
        if !(0..36_525).contains(&day) {
            let (scenario, first, date) = (scenario.file.name.clone(), first.to_string(), date.to_string());
            return Err(Failure::asked(RoutinesMessage::NoDay { scenario, first, date }));
        }
        let [begin, end] = [day, day + 1].map(|day| scenario.calendar.instant(day, Span::ZERO));
        let length = end - RunTime::START;
        let options = RunOptions { length: Some(RunLength::Span(length)), ..self.variant.into() };
        let people = simulate(options.setup(&opened)?.start()?, begin, &scenario.calendar.scale(length))?;
        let name = format!("{}, simulated", scenario.file.name);
        let day = DayRecord::from_log(&name, &Log::default(), &people, None, date);
        answer.write(&day, [&|| day_chart(&DayChart::new(&day))])
    }
}

/// Simulates a run to its end. Returns the activities and rooms of each person from an instant on.
fn simulate(mut run: Simulation, from: RunTime, scale: &TimeScale) -> Result<Vec<PersonTimeline<WallTime>>, Failure> {
    let rooms = run.home().plan.rooms.iter().map(|room| room.name.clone()).collect();
    let mut timeline = TimelineBuilder::new(run.residents(), rooms);
    while let Some(batch) = run.next_batch()? {
        timeline.take(batch.facts);
    }
    let timeline = timeline.finish(RunTime::START + run.progress().length).map(|at| scale.run_to_wall(at));
    let from = scale.run_to_wall(from);
    let known = timeline.people.into_iter().map(|mut person| {
        person.forget_before(from);
        person
    });
    Ok(known.filter(|person| !person.is_empty()).collect())
}
