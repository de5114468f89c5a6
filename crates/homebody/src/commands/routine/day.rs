//! `homebody routine day`: one simulated day.

use super::messages::RoutinesMessage;
use crate::commands::answer::Answer;
use crate::commands::scenario::Chosen;
use crate::failure::Failure;
use homebody_analysis::dates::{date_of, on_wall};
use homebody_analysis::day::Day;
use homebody_core::event::Fact;
use homebody_core::time::Micros;
use homebody_kit::LiveRun;
use homebody_log::{Activity, Life, Log};
use homebody_picture::{DayChart, day_chart};

/// Simulate a day and show activities and rooms, with a chart
///
/// The day is the same as in a run of the scenario with the same seed.
#[derive(clap::Args)]
#[command(after_long_help = "Examples:
  homebody routine day scenarios/tigerplace
  homebody routine day scenarios/tigerplace-depression 2009-06-01 --svg day.svg
  homebody routine day scenarios/tigerplace-depression 2009-06-01 --without depression")]
pub struct Arguments {
    #[command(flatten)]
    scenario: Chosen,
    /// Date, such as 2009-03-02 (default: the second day of the run, because the first begins at night)
    #[arg(value_name = "DATE")]
    date: Option<jiff::civil::Date>,
    /// Seed of all random numbers (default: that of the scenario)
    #[arg(long, value_name = "N")]
    seed: Option<u64>,
    /// Leave out a condition of the routine; repeatable
    #[arg(long, value_name = "CONDITION")]
    without: Vec<String>,
    #[command(flatten)]
    answer: Answer,
}

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        let opened = self.scenario.source()?.open()?;
        let scenario = opened.scenario();
        let answer = self.answer.check([""], &opened.paths())?;
        let zone = scenario.calendar.local(0).time_zone().clone();
        let wall = |at: Micros| on_wall(scenario.calendar.timestamp(at).as_microsecond(), &zone);
        let first = date_of(wall(0));
        let date = self.date.unwrap_or_else(|| first.saturating_add(jiff::Span::new().days(1)));
        let day = (date - first).get_days();
        if !(0..36_525).contains(&day) {
            let (scenario, first, date) = (scenario.file.name.clone(), first.to_string(), date.to_string());
            return Err(Failure::asked(RoutinesMessage::NoDay { scenario, first, date }));
        }
        let (begin, end) = (scenario.calendar.instant(day, 0), scenario.calendar.instant(day + 1, 0));
        let run = opened.run().seed(self.seed.unwrap_or(scenario.file.seed)).length(end).without(&self.without);
        let run = run.start()?;
        let mut lives = Lived::new(&run);
        lives.live(run, begin, wall)?;
        let name = format!("{}, simulated", scenario.file.name);
        let day = Day::of(&name, &Log::default(), &lives.lives, None, date);
        answer.give(&day, [&|| day_chart(&DayChart::of(&day))])
    }
}

/// What everybody does, and where, as a run tells it.
struct Lived {
    lives: Vec<Life>,
    rooms: Vec<String>,
}

impl Lived {
    fn new(run: &LiveRun) -> Lived {
        let life = |resident| Life { resident, ..Life::default() };
        let rooms = run.home().plan.rooms.iter().map(|room| room.name.clone()).collect();
        Lived { lives: run.residents().into_iter().map(life).collect(), rooms }
    }

    /// Lives the run to its end, and keeps what goes on from an instant on.
    fn live(&mut self, mut run: LiveRun, from: Micros, wall: impl Fn(Micros) -> Micros) -> Result<(), Failure> {
        while let Some(batch) = run.next_batch()? {
            for fact in batch.facts {
                match fact {
                    Fact::Activity { resident, at, name } => {
                        turn(&mut self.lives[resident.index()].activities, wall(*at), name.clone());
                    }
                    Fact::Room { resident, at, room } => {
                        let name = room.map(|room| self.rooms[room.index()].clone());
                        turn(&mut self.lives[resident.index()].rooms, wall(*at), name);
                    }
                    _ => {}
                }
            }
        }
        let end = wall(run.progress().length);
        for life in &mut self.lives {
            turn(&mut life.activities, end, None);
            turn(&mut life.rooms, end, None);
            life.activities.retain(|activity| activity.end > wall(from));
            life.rooms.retain(|room| room.end > wall(from));
        }
        self.lives.retain(|life| !life.activities.is_empty() || !life.rooms.is_empty());
        Ok(())
    }
}

/// Ends what goes on and begins what is next.
fn turn(spans: &mut Vec<Activity>, at: Micros, next: Option<String>) {
    if let Some(last) = spans.last_mut().filter(|last| last.end == Micros::MAX) {
        last.end = at;
    }
    spans.extend(next.map(|name| Activity { name, begin: at, end: Micros::MAX }));
}
