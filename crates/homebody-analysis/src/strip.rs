//! A film strip: moments of a run, one after the other, with what happened in between.
//!
//! A moment has where everybody is and what they do. Between it and the one before lie the ways that they went, what they
//! used and which sensors fired; of the first moment, as long before it as between two moments.

use homebody_core::event::{Events, Fact, Firing};
use homebody_core::geometry::Point;
use homebody_core::motion::MotionState;
use homebody_core::posture::Posture;
use homebody_core::stride::Stride;
use homebody_core::time::{RunTime, Span};
use serde::Serialize;
use std::collections::BTreeSet;
use std::fmt;

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StoryStrip {
    pub name: String,
    pub every_s: f64,
    /// In order of time.
    pub moments: Vec<StripFrame>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StripFrame {
    /// By the clock on the wall, such as `2026-01-12 18:20:10`.
    pub at: String,
    pub at_s: f64,
    pub people: Vec<StripPerson>,
    pub used: Vec<String>,
    /// The sensors that fired, by name.
    pub fired: Vec<String>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StripPerson {
    pub name: String,
    /// The corners of their way, in metres; the last is their place. Empty if they are out, or were not there.
    pub path_m: Vec<[f64; 2]>,
    pub posture: Option<Posture>,
    pub activity: Option<String>,
}

pub struct RunNames<'a> {
    pub scenario: &'a str,
    pub people: Vec<String>,
    pub sensors: Vec<&'a str>,
    pub things: Vec<&'a str>,
    /// The number of these, from the first, that are doors.
    pub doors: usize,
}

pub struct StripRecorder {
    first: RunTime,
    every: Span,
    count: usize,
    kept: Events,
    /// The end of each body's known movements.
    told: Vec<RunTime>,
}

impl StripRecorder {
    pub fn new(first: RunTime, every: Span, count: usize, people: usize) -> StripRecorder {
        let every = every.max(Span::MICROSECOND);
        StripRecorder { first, every, count, kept: Events::default(), told: vec![RunTime::START; people] }
    }

    fn begin(&self) -> RunTime {
        self.first.saturating_sub(self.every)
    }

    fn end(&self) -> RunTime {
        self.first.saturating_add(self.every.saturating_mul(self.count as i64 - 1))
    }

    pub fn take(&mut self, firings: &[Firing], facts: &[Fact]) {
        let (begin, end) = (self.begin(), self.end());
        self.kept.firings.extend(firings.iter().filter(|firing| (begin..=end).contains(&firing.at)).copied());
        for fact in facts {
            let is_kept = match fact {
                Fact::Movement { resident, begin: from, end: to, .. } => {
                    if let Some(told) = self.told.get_mut(resident.index()) {
                        *told = *to;
                    }
                    *from <= end && *to >= begin
                }
                // An earlier activity continues.
                Fact::Activity { at, .. } => *at <= end,
                Fact::Use { at, .. } => (begin..=end).contains(at),
                _ => false,
            };
            if is_kept {
                self.kept.facts.push(fact.clone());
            }
        }
    }

    pub fn is_complete(&self) -> bool {
        self.told.iter().all(|told| *told > self.end())
    }

    pub fn strip(&self, names: &RunNames, clock: impl Fn(RunTime) -> String) -> StoryStrip {
        let moment = |index: usize| {
            let at = self.first + self.every * index as i64;
            self.moment(at, names, clock(at))
        };
        let moments = (0..self.count).map(moment).collect();
        StoryStrip { name: names.scenario.into(), every_s: self.every.seconds(), moments }
    }

    fn moment(&self, at: RunTime, names: &RunNames, clock: String) -> StripFrame {
        let since = at - self.every;
        let fired = self.kept.firings.iter().filter(|firing| firing.at > since && firing.at <= at);
        let fired: BTreeSet<usize> = fired.map(|firing| firing.sensor.index()).collect();
        let used = self.kept.facts.iter().filter_map(|fact| match fact {
            Fact::Use { at: used, act, .. } if *used > since && *used <= at => {
                let thing = names.things.get(act.thing.index()).copied().unwrap_or_default();
                Some(match (act.thing.index() < names.doors, act.on) {
                    (true, true) => format!("{thing} opened"),
                    (true, false) => format!("{thing} shut"),
                    (false, true) => format!("{thing} on"),
                    (false, false) => format!("{thing} off"),
                })
            }
            _ => None,
        });
        StripFrame {
            at: clock,
            at_s: at.seconds(),
            people: (0..names.people.len()).map(|person| self.person(person, since, at, names)).collect(),
            used: used.collect(),
            fired: fired.into_iter().filter_map(|sensor| names.sensors.get(sensor)).map(ToString::to_string).collect(),
        }
    }

    fn person(&self, person: usize, since: RunTime, at: RunTime, names: &RunNames) -> StripPerson {
        let (mut path_m, mut posture, mut activity) = (Vec::new(), None, None);
        for fact in &self.kept.facts {
            match fact {
                Fact::Movement { resident, begin, end, doing, posture: held }
                    if resident.index() == person && *begin <= at && *end > since =>
                {
                    let corners: Vec<Point> = match *doing {
                        MotionState::Stride { from, to } => {
                            let stride = Stride::new(from, to, *begin, *end);
                            vec![stride.position((*begin).max(since)), stride.position((*end).min(at))]
                        }
                        MotionState::InPlace { at, .. } | MotionState::Rest { at } => vec![at],
                        MotionState::Away => Vec::new(),
                    };
                    if corners.is_empty() {
                        path_m.clear();
                    }
                    posture = (!corners.is_empty()).then_some(*held);
                    path_m.extend(corners.into_iter().map(|corner| [corner.x, corner.y]));
                }
                Fact::Activity { resident, at: from, name } if resident.index() == person && *from <= at => {
                    activity.clone_from(name);
                }
                _ => {}
            }
        }
        path_m.dedup();
        StripPerson { name: names.people[person].clone(), path_m, posture, activity }
    }
}

impl fmt::Display for StoryStrip {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        writeln!(f, "{}: {} moments, {} s apart", self.name, self.moments.len(), self.every_s)?;
        for moment in &self.moments {
            writeln!(f, "{}", moment.at)?;
            for person in &moment.people {
                writeln!(f, "  {}", person.caption())?;
            }
            for (what, list) in [("used", &moment.used), ("fired", &moment.fired)] {
                if !list.is_empty() {
                    writeln!(f, "  {what}: {}", list.join(", "))?;
                }
            }
        }
        Ok(())
    }
}

impl StripPerson {
    pub fn caption(&self) -> String {
        let posture = match self.posture {
            Some(Posture::Standing) => "on their feet",
            Some(Posture::Sitting) => "sitting",
            Some(Posture::Lying) => "lying",
            Some(Posture::Bending) => "bending",
            Some(Posture::Kneeling) => "kneeling",
            Some(Posture::Down) => "on the floor",
            None => "out",
        };
        match &self.activity {
            Some(activity) => format!("{}: {posture}, {}", self.name, activity.replace('_', " ")),
            None => format!("{}: {posture}", self.name),
        }
    }
}
