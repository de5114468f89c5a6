//! The life that a draft comes to, with copies that are kept every few days, so that a later month begins nearby.

use crate::dates;
use crate::effort::Effort;
use crate::growth::Growth;
use crate::wire::MonthView;
use homebody_core::drivers::error::DriverError;
use homebody_core::event::{Events, Fact};
use homebody_core::run::Run;
use homebody_core::scenario::load::Scenario;
use homebody_core::sensors::Sensor;
use homebody_core::snapshots::Snapshots;
use homebody_core::time::{DAY, Micros, SECOND};
use homebody_kit::Cancel;
use homebody_routine::household::Household;
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
        lived(scenario, household, from, days, &mut self.moments, &mut Effort::new(cancel, LONGEST_STRETCH))
    }
}

/// Initial distance between saved moments (our choice): a simulation between them takes some milliseconds.
const MOMENTS: Micros = 4 * DAY;

/// Longest stretch that is simulated at once (our choice).
const LONGEST_STRETCH: Micros = 3600 * SECOND;

/// A life at an instant, and what is known of it by then.
#[derive(Clone)]
struct Moment {
    run: Run,
    known: Known,
    growth: Growth,
    activities: Vec<String>,
}

impl Moment {
    /// The beginning of a life.
    fn first(scenario: &Scenario, household: &Household, length: Micros) -> Moment {
        let run = Run::new(scenario, household, scenario.file.seed, length);
        let is_motion = run.sensors().iter().map(Sensor::senses_motion).collect();
        let known = Known::of(scenario.residents.len());
        Moment { run, known, growth: Growth::new(&scenario.calendar, length, is_motion), activities: Vec::new() }
    }

    /// Lives on, and adds what has ended to the view. Returns whether it came to `until`; if not, `view.cut` says why.
    fn live(&mut self, until: Micros, view: &mut MonthView, effort: &mut Effort) -> Result<bool, DriverError> {
        let mut events = Events::default();
        while self.run.now() < until {
            if let Err(why) = effort.goes_on(view.spans.iter().chain(&view.stays).map(Vec::len).sum()) {
                view.cut = Some(why);
                return Ok(false);
            }
            let lived = effort.live(&mut self.run, until, &mut events);
            self.known.learn(&events, &mut self.activities, view);
            self.growth.add(&events.firings, self.run.now());
            events.clear();
            lived?;
        }
        Ok(true)
    }
}

fn lived(
    scenario: &Scenario,
    household: &Household,
    from: u32,
    days: u32,
    moments: &mut Snapshots<Moment>,
    effort: &mut Effort,
) -> Result<MonthView, DriverError> {
    let calendar = &scenario.calendar;
    let length = calendar.span_of_days(scenario.file.days);
    let last = dates::last(calendar, length);
    let from = from.min(last);
    let days = dates::some(calendar, length, from..(from + days).min(last + 1));
    let (begin, end) = (days.first().map_or(0, |day| day.begin_us), days.last().map_or(0, |day| day.end_us));
    let kept = moments.nearest_before(begin).cloned();
    let mut life = kept.unwrap_or_else(|| Moment::first(scenario, household, length));
    let mut view = MonthView {
        residents: scenario.residents.iter().map(|resident| resident.file.name.clone()).collect(),
        rooms: life.run.home().plan.rooms.iter().map(|room| room.name.clone()).collect(),
        spans: vec![Vec::new(); scenario.residents.len()],
        stays: vec![Vec::new(); scenario.residents.len()],
        days,
        ..MonthView::default()
    };
    // What was before the first day is only lived to come to it.
    let mut goes_on = true;
    while goes_on && life.run.now() < begin {
        moments.keep(life.run.now(), || life.clone());
        goes_on = life.live(begin.min(life.run.now() + DAY), &mut view, effort)?;
        view.spans.iter_mut().chain(&mut view.stays).for_each(Vec::clear);
    }
    for day in 0..view.days.len() {
        if goes_on {
            moments.keep(life.run.now(), || life.clone());
            goes_on = life.live(view.days[day].end_us, &mut view, effort)?;
        }
    }
    let end = end.min(life.run.now());
    life.known.end(end, &mut view);
    if let Some(why) = &mut view.cut {
        *why = format!("The days are shown up to {}. {why}", calendar.wall_clock(end));
    }
    // A stride may come to another room later.
    view.stays.iter_mut().flatten().for_each(|stay| stay.1 = stay.1.min(end));
    let mut hours = life.growth.view().hours;
    hours.resize(hours.len().max(from as usize + view.days.len()), vec![0; 24]);
    (view.activities, view.hours) = (life.activities, hours.split_off(from as usize));
    Ok(view)
}

/// What each resident does, and where they are, since when.
#[derive(Clone)]
struct Known {
    doing: Vec<(Micros, Option<u32>)>,
    being: Vec<(Micros, Option<u32>)>,
}

impl Known {
    /// Of so many residents; of others nothing is told.
    fn of(residents: usize) -> Known {
        Known { doing: vec![(0, None); residents], being: vec![(0, None); residents] }
    }

    /// Adds what has ended to the view.
    fn learn(&mut self, events: &Events, activities: &mut Vec<String>, view: &mut MonthView) {
        for fact in &events.facts {
            match fact {
                Fact::Activity { resident, at, name } => {
                    let resident = resident.index();
                    let Some(doing) = self.doing.get_mut(resident) else { continue };
                    let name = name.as_ref().map(|name| numbered(activities, name));
                    change(doing, *at, name, &mut view.spans[resident]);
                }
                Fact::Room { resident, at, room } => {
                    let resident = resident.index();
                    let Some(being) = self.being.get_mut(resident) else { continue };
                    change(being, *at, room.map(|room| room.0), &mut view.stays[resident]);
                }
                _ => {}
            }
        }
    }

    /// What goes on at the end ends there.
    fn end(&mut self, end: Micros, view: &mut MonthView) {
        for (doing, spans) in self.doing.iter_mut().zip(&mut view.spans) {
            change(doing, end, None, spans);
        }
        for (being, stays) in self.being.iter_mut().zip(&mut view.stays) {
            change(being, end, None, stays);
        }
    }
}

/// Ends what was, and begins what is.
fn change(was: &mut (Micros, Option<u32>), at: Micros, is: Option<u32>, spans: &mut Vec<(Micros, Micros, u32)>) {
    if let (since, Some(what)) = *was
        && since < at
    {
        spans.push((since, at, what));
    }
    *was = (at, is);
}

/// The number of a name among those that are known.
fn numbered(names: &mut Vec<String>, name: &str) -> u32 {
    let known = names.iter().position(|known| known == name);
    let number = known.unwrap_or_else(|| {
        names.push(name.to_owned());
        names.len() - 1
    });
    number as u32
}
