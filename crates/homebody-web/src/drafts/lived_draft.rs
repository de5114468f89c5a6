//! The life that a draft comes to, with copies that are kept every few days, so that a later month begins nearby.

use crate::budget::SimulationBudget;
use crate::dates;
use crate::live_counts::LiveCounts;
use crate::wire::MonthView;
use homebody_core::drivers::error::DriverError;
use homebody_core::event::{Events, Fact};
use homebody_core::run::Run;
use homebody_core::scenario::load::Scenario;
use homebody_core::sensors::Sensor;
use homebody_core::snapshots::Snapshots;
use homebody_core::time::{DAY, HOUR, Interval, RunTime, Span};
use homebody_routine::household::Household;
use homebody_simulation::Cancel;
use homebody_timeline::{Episode, Timeline, TimelineBuilder};
use std::collections::BTreeMap;

/// The draft that was lived last. As long as it is the same, its life is.
pub struct LivedDraft {
    /// The texts of all files that the scenario is made of, by name.
    sources: BTreeMap<String, String>,
    without: Vec<String>,
    moments: Snapshots<Moment>,
}

impl LivedDraft {
    /// Of a draft that has not been lived.
    pub fn new(scenario: &Scenario, without: Vec<String>) -> LivedDraft {
        LivedDraft { sources: scenario.sources.clone(), without, moments: Snapshots::new(MOMENTS) }
    }

    /// Whether a draft is the same.
    pub fn is(&self, scenario: &Scenario, without: &[String]) -> bool {
        self.sources == scenario.sources && self.without == without
    }

    /// Some days of its life, as far as they go into an answer, and as long as somebody waits for it.
    pub fn month(
        &mut self,
        scenario: &Scenario,
        household: &Household,
        from: u32,
        days: u32,
        cancel: &Cancel,
    ) -> Result<MonthView, DriverError> {
        lived(scenario, household, from, days, &mut self.moments, &mut SimulationBudget::new(cancel, LONGEST_STRETCH))
    }
}

/// Initial distance between saved moments (our choice): a simulation between them takes some milliseconds.
const MOMENTS: Span = DAY.times(4);

/// Longest stretch that is simulated at once (our choice).
const LONGEST_STRETCH: Span = HOUR;

/// A life at an instant, and what is known of it by then.
#[derive(Clone)]
struct Moment {
    run: Run,
    timeline: TimelineBuilder,
    live_counts: LiveCounts,
    activities: Vec<String>,
}

impl Moment {
    /// The beginning of a life.
    fn first(scenario: &Scenario, household: &Household, length: Span) -> Moment {
        let run = Run::new(scenario, household, scenario.file.seed, length);
        let is_motion = run.sensors().iter().map(Sensor::senses_motion).collect();
        let residents = scenario.residents.iter().map(|resident| resident.file.name.clone()).collect();
        let timeline = TimelineBuilder::new(residents, room_names(&run));
        Moment {
            run,
            timeline,
            live_counts: LiveCounts::new(&scenario.calendar, length, is_motion),
            activities: Vec::new(),
        }
    }

    /// Lives on, and adds what has ended. Returns whether it came to `until`; if not, `ended.cut` says why.
    fn live(
        &mut self,
        until: RunTime,
        ended: &mut EndedSpans,
        budget: &mut SimulationBudget,
    ) -> Result<bool, DriverError> {
        let mut events = Events::default();
        while self.run.now() < until {
            if let Err(why) = budget.check(ended.spans.iter().chain(&ended.stays).map(Vec::len).sum()) {
                ended.cut = Some(why);
                return Ok(false);
            }
            let lived = budget.advance(&mut self.run, until, &mut events);
            self.learn(&events.facts, ended);
            self.live_counts.add(&events.firings, self.run.now());
            events.clear();
            lived?;
        }
        Ok(true)
    }

    /// Adds what has ended. Activities have numbers in the order of their first beginnings.
    fn learn(&mut self, facts: &[Fact], ended: &mut EndedSpans) {
        for fact in facts {
            if let Fact::Activity { resident, name: Some(name), .. } = fact
                && resident.index() < ended.spans.len()
                && !self.activities.contains(name)
            {
                self.activities.push(name.clone());
            }
        }
        self.timeline.take(facts);
        ended.add(self.timeline.take_ended(), &self.activities, &room_names(&self.run));
    }
}

fn room_names(run: &Run) -> Vec<String> {
    run.home().plan.rooms.iter().map(|room| room.name.clone()).collect()
}

fn lived(
    scenario: &Scenario,
    household: &Household,
    from: u32,
    days: u32,
    moments: &mut Snapshots<Moment>,
    budget: &mut SimulationBudget,
) -> Result<MonthView, DriverError> {
    let calendar = &scenario.calendar;
    let length = calendar.span_of_days(scenario.file.days);
    let last = dates::last_day(calendar, length);
    let from = from.min(last);
    let days = dates::days(calendar, length, from..(from + days).min(last + 1));
    let begin = days.first().map_or(RunTime::START, |day| day.interval().begin);
    let end = days.last().map_or(RunTime::START, |day| day.interval().end);
    let kept = moments.nearest_before(begin).cloned();
    let mut life = kept.unwrap_or_else(|| Moment::first(scenario, household, length));
    let nothing = vec![Vec::new(); scenario.residents.len()];
    let mut ended = EndedSpans { spans: nothing.clone(), stays: nothing, cut: None };
    // What was before the first day is only lived to come to it.
    let mut goes_on = true;
    while goes_on && life.run.now() < begin {
        moments.keep(life.run.now(), || life.clone());
        goes_on = life.live(begin.min(life.run.now() + DAY), &mut ended, budget)?;
        ended.spans.iter_mut().chain(&mut ended.stays).for_each(Vec::clear);
    }
    for day in &days {
        if goes_on {
            moments.keep(life.run.now(), || life.clone());
            goes_on = life.live(day.interval().end, &mut ended, budget)?;
        }
    }
    let end = end.min(life.run.now());
    let rooms = room_names(&life.run);
    ended.add(std::mem::take(&mut life.timeline).finish(end), &life.activities, &rooms);
    if let Some(why) = &mut ended.cut {
        *why = format!("The days are shown up to {}. {why}", calendar.wall_clock(end));
    }
    // A stride may come to another room later.
    ended.stays.iter_mut().flatten().for_each(|(stay, _)| stay.end = stay.end.min(end));
    let mut hours = life.live_counts.view().hours;
    hours.resize(hours.len().max(from as usize + days.len()), vec![0; 24]);
    let told = |all: Vec<Spans>| all.iter().map(|spans| spans.iter().map(dates::in_micros).collect()).collect();
    Ok(MonthView {
        residents: scenario.residents.iter().map(|resident| resident.file.name.clone()).collect(),
        rooms,
        days,
        activities: life.activities,
        spans: told(ended.spans),
        stays: told(ended.stays),
        hours: hours.split_off(from as usize),
        cut: ended.cut,
        ..MonthView::default()
    })
}

/// Of a resident: from when until when, and a number of what.
type Spans = Vec<(Interval<RunTime>, u32)>;

/// What has ended of lives, by resident, and why there is no more.
struct EndedSpans {
    spans: Vec<Spans>,
    stays: Vec<Spans>,
    cut: Option<String>,
}

impl EndedSpans {
    /// Adds episodes, with the numbers of their labels among the names of activities and of rooms.
    fn add(&mut self, timeline: Timeline, activities: &[String], rooms: &[String]) {
        for (resident, person) in timeline.people.into_iter().enumerate() {
            self.spans[resident].extend(numbered(person.activities, activities));
            self.stays[resident].extend(numbered(person.rooms, rooms));
        }
    }
}

fn numbered(episodes: Vec<Episode>, names: &[String]) -> impl Iterator<Item = (Interval<RunTime>, u32)> {
    let lasting = episodes.into_iter().filter(|episode| !episode.time.is_empty());
    lasting.filter_map(|Episode { label, time }| Some((time, names.iter().position(|name| *name == label)? as u32)))
}
