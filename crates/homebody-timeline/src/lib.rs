//! Timelines of people: where they were, doing what, and when.
//!
//! A [`Timeline`] has the activities and the rooms of each person, on one scale of time. A [`TimelineBuilder`] makes it from the facts of a
//! run; `read_timeline` of `homebody-log` makes it from a stored ground truth. Measures, experiments, labels, pictures and the page read
//! timelines.

#![warn(missing_docs)]

mod builder;

pub use builder::TimelineBuilder;

use homebody_core::time::{Interval, RunTime, Span, TimePoint};

/// An interval of time and its label: an activity, such as `sleeping`, or a room.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Episode<T = RunTime, L = String> {
    /// The activity, or the room; its name, or its number in a list of names.
    pub label: L,
    /// From when to when.
    pub time: Interval<T>,
}

/// The activities and rooms of one person, each in the order of time.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PersonTimeline<T = RunTime, L = String> {
    /// The person's name; empty where a log does not name them.
    pub name: String,
    /// The activities; nothing in particular between two episodes.
    pub activities: Vec<Episode<T, L>>,
    /// The rooms; between rooms or out of the home between two episodes.
    pub rooms: Vec<Episode<T, L>>,
}

/// The kind of an episode, by its label.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EpisodeKind {
    /// One of [`PersonTimeline::activities`].
    Activity,
    /// One of [`PersonTimeline::rooms`].
    Room,
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

    /// The length of the episode.
    pub fn length(&self) -> Span {
        self.time.length()
    }

    /// The same episode on another scale of time.
    pub fn map<U>(self, change: impl FnMut(T) -> U) -> Episode<U, L> {
        Episode { label: self.label, time: self.time.map(change) }
    }
}

// Not derived: that would ask for a `T` that has a default.
impl<T, L> Default for PersonTimeline<T, L> {
    fn default() -> PersonTimeline<T, L> {
        PersonTimeline::new(String::new())
    }
}

impl<T> Default for Timeline<T> {
    fn default() -> Timeline<T> {
        Timeline { people: Vec::new() }
    }
}

impl<T, L> PersonTimeline<T, L> {
    /// The timeline of a person with this name, without any episode.
    pub const fn new(name: String) -> PersonTimeline<T, L> {
        PersonTimeline { name, activities: Vec::new(), rooms: Vec::new() }
    }

    /// The episodes of a kind.
    pub fn episodes(&self, kind: EpisodeKind) -> &[Episode<T, L>] {
        match kind {
            EpisodeKind::Activity => &self.activities,
            EpisodeKind::Room => &self.rooms,
        }
    }

    /// The episodes of a kind, to be added to.
    pub fn episodes_mut(&mut self, kind: EpisodeKind) -> &mut Vec<Episode<T, L>> {
        match kind {
            EpisodeKind::Activity => &mut self.activities,
            EpisodeKind::Room => &mut self.rooms,
        }
    }
}

impl<T: TimePoint> PersonTimeline<T> {
    /// Nothing is known of the person.
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

    /// The same timeline on another scale of time.
    fn map<U>(self, change: &mut impl FnMut(T) -> U) -> PersonTimeline<U> {
        let mut map = |episodes: Vec<Episode<T>>| {
            episodes.into_iter().map(|episode| episode.map(&mut *change)).collect::<Vec<Episode<U>>>()
        };
        PersonTimeline { activities: map(self.activities), rooms: map(self.rooms), name: self.name }
    }

    /// Forgets the episodes that were over by an instant.
    pub fn forget_before(&mut self, at: T) {
        self.activities.retain(|episode| episode.end() > at);
        self.rooms.retain(|episode| episode.end() > at);
    }
}

impl<T: TimePoint> Timeline<T> {
    /// The same timelines on another scale of time.
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

/// The label at an instant of episodes in order, without overlaps.
fn label_at<T: TimePoint>(episodes: &[Episode<T>], at: T) -> Option<&str> {
    let next = episodes.partition_point(|episode| episode.begin() <= at);
    let last = episodes[..next].last()?;
    last.time.contains(at).then_some(&last.label)
}
