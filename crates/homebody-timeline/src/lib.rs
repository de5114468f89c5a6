//! Who was where, doing what, when.
//!
//! A [`Timeline`] has the activities and the rooms of each person, on one scale of time. A [`TimelineBuilder`] makes it from the facts of a
//! run; `homebody-log` makes it from a stored ground truth. Whatever asks for the truth of a run reads a timeline: measures,
//! experiments, labels, pictures, the page.

#![warn(missing_docs)]

mod builder;

pub use builder::TimelineBuilder;

use homebody_core::time::{Interval, RunTime, Span, TimePoint};

/// An interval of a person's time and its label: an activity, such as `sleeping`, or a room.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Episode<T = RunTime, L = String> {
    /// The activity, or the name of the room.
    pub label: L,
    /// When it was.
    pub time: Interval<T>,
}

/// The activities and rooms of one person, each in the order of time.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PersonTimeline<T = RunTime> {
    /// The person's name; empty where a log does not name them.
    pub name: String,
    /// What they did; nothing in particular between two episodes.
    pub activities: Vec<Episode<T>>,
    /// Where they were; between rooms or out of the home between two episodes.
    pub rooms: Vec<Episode<T>>,
}

/// The timelines of all people of a home.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Timeline<T = RunTime> {
    /// The people, in the order of the scenario, or of their names where only a stored truth is known.
    pub people: Vec<PersonTimeline<T>>,
}

impl<T, L> Episode<T, L> {
    /// An episode with its label.
    pub const fn new(label: L, time: Interval<T>) -> Episode<T, L> {
        Episode { label, time }
    }
}

impl<T: TimePoint, L> Episode<T, L> {
    /// The first instant of the episode.
    pub fn begin(&self) -> T {
        self.time.begin
    }

    /// The first instant after it.
    pub fn end(&self) -> T {
        self.time.end
    }

    /// How long it lasted.
    pub fn length(&self) -> Span {
        self.time.length()
    }
}

// Not derived: that would ask for a `T` that has a default.
impl<T> Default for PersonTimeline<T> {
    fn default() -> PersonTimeline<T> {
        PersonTimeline { name: String::new(), activities: Vec::new(), rooms: Vec::new() }
    }
}

impl<T> Default for Timeline<T> {
    fn default() -> Timeline<T> {
        Timeline { people: Vec::new() }
    }
}

impl<T: TimePoint> PersonTimeline<T> {
    /// Whether nothing is known of the person.
    pub fn is_empty(&self) -> bool {
        self.activities.is_empty() && self.rooms.is_empty()
    }

    /// The activity at an instant.
    pub fn activity_at(&self, at: T) -> Option<&str> {
        label_at(&self.activities, at)
    }

    /// The room at an instant.
    pub fn room_at(&self, at: T) -> Option<&str> {
        label_at(&self.rooms, at)
    }

    /// The same on another scale.
    pub fn map<U>(self, change: &mut impl FnMut(T) -> U) -> PersonTimeline<U> {
        let mut map = |episodes: Vec<Episode<T>>| {
            let changed = |Episode { label, time }| Episode { label, time: time.map(&mut *change) };
            episodes.into_iter().map(changed).collect()
        };
        PersonTimeline { activities: map(self.activities), rooms: map(self.rooms), name: self.name }
    }

    /// Forgets what was over by an instant.
    pub fn forget_before(&mut self, at: T) {
        self.activities.retain(|episode| episode.end() > at);
        self.rooms.retain(|episode| episode.end() > at);
    }
}

impl<T: TimePoint> Timeline<T> {
    /// The same on another scale.
    pub fn map<U>(self, mut change: impl FnMut(T) -> U) -> Timeline<U> {
        Timeline { people: self.people.into_iter().map(|person| person.map(&mut change)).collect() }
    }

    /// The activities of all people, in the order of their beginnings.
    pub fn into_activities(self) -> Vec<Episode<T>> {
        let mut all: Vec<Episode<T>> = self.people.into_iter().flat_map(|person| person.activities).collect();
        all.sort_by_key(Episode::begin);
        all
    }
}

/// The label at an instant of episodes in order, of which no two overlap.
fn label_at<T: TimePoint>(episodes: &[Episode<T>], at: T) -> Option<&str> {
    let next = episodes.partition_point(|episode| episode.begin() <= at);
    let last = episodes[..next].last()?;
    last.time.contains(at).then_some(&last.label)
}
