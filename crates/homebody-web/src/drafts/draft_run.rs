//! The simulation of a draft. Its snapshots let a later month start nearby.

use crate::budget::{SimulationBudget, draft_steps};
use crate::dates;
use crate::dates::NumberedEpisode;
use crate::live_counts::LiveCounts;
use crate::wire::MonthView;
use homebody_core::event::{Events, Fact};
use homebody_core::scenario::load::Scenario;
use homebody_core::sensors::Sensor;
use homebody_core::snapshots::Snapshots;
use homebody_core::time::{DAY, HOUR, RunTime, Span};
use homebody_simulation::{OpenScenario, Simulation, SimulationError, StepError};
use homebody_timeline::{Episode, Timeline, TimelineBuilder};

/// The simulation of the latest draft. It is of use as long as the draft stays the same.
pub struct DraftRun {
    without: Vec<String>,
    simulation: Simulation,
    state: DraftState,
    snapshots: Snapshots<DraftState>,
}

#[derive(Clone)]
struct DraftState {
    timeline: TimelineBuilder,
    live_counts: LiveCounts,
    /// The names of activities, in the order of their first starts.
    activities: Vec<String>,
}

/// Initial distance between snapshots (our choice): a simulation between them takes some milliseconds.
const SNAPSHOTS: Span = DAY.times(4);

/// Longest step (our choice).
const LONGEST_STEP: Span = HOUR;

impl DraftRun {
    pub fn new(opened: &OpenScenario, without: Vec<String>) -> Result<DraftRun, SimulationError> {
        let simulation = opened.run().without(&without).plan()?.simulation();
        let simulation = simulation.stepping(draft_steps(LONGEST_STEP)).with_snapshots(SNAPSHOTS);
        let is_motion = simulation.placed_sensors().iter().map(Sensor::senses_motion).collect();
        let residents = simulation.scenario().residents.iter().map(|resident| resident.file.name.clone()).collect();
        let state = DraftState {
            timeline: TimelineBuilder::new(residents, room_names(&simulation)),
            live_counts: LiveCounts::new(simulation.calendar(), simulation.progress().length, is_motion),
            activities: Vec::new(),
        };
        Ok(DraftRun { without, simulation, state, snapshots: Snapshots::new(SNAPSHOTS) })
    }

    /// Whether it is the run of this draft without these conditions.
    pub fn is_of(&self, scenario: &Scenario, without: &[String]) -> bool {
        self.simulation.scenario().sources == scenario.sources && self.without == without
    }

    /// Some days of the run, unless they exceed the limits of an answer.
    pub fn month(&mut self, from: u32, days: u32, mut budget: SimulationBudget) -> Result<MonthView, StepError> {
        let (calendar, length) = (self.simulation.calendar().clone(), self.simulation.progress().length);
        let last = dates::last_day(&calendar, length);
        let from = from.min(last);
        let days = dates::days(&calendar, length, from..(from + days).min(last + 1));
        let begin = days.first().map_or(RunTime::START, |day| day.interval().begin);
        let end = days.last().map_or(RunTime::START, |day| day.interval().end);
        if let Some(state) = self.simulation.rewind(begin).and_then(|now| self.snapshots.nearest_before(now)) {
            self.state = state.clone();
        }
        let nothing = vec![Vec::new(); self.simulation.scenario().residents.len()];
        let mut ended = EndedEpisodes { activities: nothing.clone(), rooms: nothing, cut: None };
        // The answer does not contain the days before the first.
        while self.simulation.now() < begin && ended.cut.is_none() {
            self.simulate(begin.min(self.simulation.now() + DAY), &mut ended, &mut budget)?;
            ended.activities.iter_mut().chain(&mut ended.rooms).for_each(Vec::clear);
        }
        if ended.cut.is_none() {
            self.simulate(end, &mut ended, &mut budget)?;
        }
        let end = end.min(self.simulation.now());
        let rooms = room_names(&self.simulation);
        ended.add(self.state.timeline.clone().finish(end), &self.state.activities, &rooms);
        if let Some(why) = &mut ended.cut {
            *why = format!("The days are shown up to {}. {why}", calendar.wall_clock(end));
        }
        // A stride may reach another room after the end.
        ended.rooms.iter_mut().flatten().for_each(|stay| stay.time.end = stay.end().min(end));
        let mut hours = self.state.live_counts.view().hours;
        hours.resize(hours.len().max(from as usize + days.len()), vec![0; 24]);
        let spans = |all: Vec<NumberedEpisodes>| {
            all.iter().map(|episodes| episodes.iter().map(dates::in_micros).collect()).collect()
        };
        Ok(MonthView {
            residents: self.simulation.scenario().residents.iter().map(|resident| resident.file.name.clone()).collect(),
            rooms,
            days,
            activities: self.state.activities.clone(),
            spans: spans(ended.activities),
            stays: spans(ended.rooms),
            hours: hours.split_off(from as usize),
            cut: ended.cut,
            ..MonthView::default()
        })
    }

    /// Simulates up to an instant and adds the episodes that have ended. `ended.cut` is the reason for an earlier end.
    fn simulate(
        &mut self,
        until: RunTime,
        ended: &mut EndedEpisodes,
        budget: &mut SimulationBudget,
    ) -> Result<(), StepError> {
        while self.simulation.now() < until {
            if let Err(why) = budget.check(ended.activities.iter().chain(&ended.rooms).map(Vec::len).sum()) {
                ended.cut = Some(why);
                return Ok(());
            }
            self.snapshots.keep(self.simulation.now(), || self.state.clone());
            let stepped = budget.step(&mut self.simulation, until);
            self.state.take(self.simulation.events(), self.simulation.now(), ended, &room_names(&self.simulation));
            stepped?;
        }
        Ok(())
    }
}

impl DraftState {
    /// Takes the events of a step up to an instant, and adds the episodes that have ended.
    fn take(&mut self, events: &Events, now: RunTime, ended: &mut EndedEpisodes, rooms: &[String]) {
        for fact in &events.facts {
            if let Fact::Activity { resident, name: Some(name), .. } = fact
                && resident.index() < ended.activities.len()
                && !self.activities.contains(name)
            {
                self.activities.push(name.clone());
            }
        }
        self.timeline.take(&events.facts);
        ended.add(self.timeline.take_ended(), &self.activities, rooms);
        self.live_counts.add(&events.firings, now);
    }
}

fn room_names(simulation: &Simulation) -> Vec<String> {
    simulation.home().plan.rooms.iter().map(|room| room.name.clone()).collect()
}

/// The episodes of a resident, each with the number of its label.
type NumberedEpisodes = Vec<NumberedEpisode>;

/// The episodes that have ended, by resident.
struct EndedEpisodes {
    activities: Vec<NumberedEpisodes>,
    rooms: Vec<NumberedEpisodes>,
    /// The reason why later ones are missing.
    cut: Option<String>,
}

impl EndedEpisodes {
    /// Adds episodes, with the numbers of their labels among the names of activities and of rooms.
    fn add(&mut self, timeline: Timeline, activities: &[String], rooms: &[String]) {
        for (resident, person) in timeline.people.into_iter().enumerate() {
            self.activities[resident].extend(numbered(person.activities, activities));
            self.rooms[resident].extend(numbered(person.rooms, rooms));
        }
    }
}

fn numbered(episodes: Vec<Episode>, names: &[String]) -> impl Iterator<Item = NumberedEpisode> {
    let lasting = episodes.into_iter().filter(|episode| !episode.time.is_empty());
    lasting.filter_map(|Episode { label, time }| {
        Some(Episode::new(names.iter().position(|name| *name == label)? as u32, time))
    })
}
