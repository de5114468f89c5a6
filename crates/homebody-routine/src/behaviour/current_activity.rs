//! An activity in progress.

use super::help::VisitorWork;
use super::item::Item;
use super::places::HomePlace;
use super::resident_routine::SentenceId;
use super::script::{ActivityStep, Interruptible, StayStep};
use crate::routine::Response;
use homebody_core::geometry::Point;
use homebody_core::ids::ResidentId;
use homebody_core::random::Stream;
use homebody_core::time::{RunTime, Span};
use std::collections::VecDeque;

#[derive(Clone, Debug)]
pub(super) struct Playing {
    pub(super) steps: VecDeque<ActivityStep>,
    pub(super) stream: Stream,
    pub(super) name: String,
    /// The label at its start.
    pub(super) label: String,
    /// The place at its interruption.
    pub(super) spot: Option<HomePlace>,
    pub(super) is_interrupted: bool,
    /// The sentence, and the start.
    pub(super) of: Option<SentenceId>,
    pub(super) since: RunTime,
    /// Time that other planned activities took in the middle of it.
    pub(super) paused: Span,
    pub(super) walks: WalkPurpose,
    /// The stated end, after which the rest is left out.
    pub(super) until: Option<RunTime>,
    /// Leisure and company, which meals and medicine interrupt.
    pub(super) gives_way: bool,
    /// The activity that it begins with.
    pub(super) goes_with: Option<SentenceId>,
    /// Until when only stated meals interrupt it.
    pub(super) undisturbed: RunTime,
    pub(super) is_essential: bool,
    /// The rule that it answers, and the remaining responses, the next last.
    pub(super) answers: Option<usize>,
    pub(super) still: Vec<Response>,
    /// Whether the stay continues with a movement.
    pub(super) stirs: bool,
    /// Whether it has begun at its place.
    pub(super) is_there: bool,
    /// Waits in a row for an occupied place.
    pub(super) waits: u32,
    /// Whether it fills a wait of the activity below.
    pub(super) is_in_between: bool,
    /// Whether the activity below lasts on meanwhile.
    pub(super) is_meanwhile: bool,
    /// Whether its stays are left for a visitor at the door: for naps and meals, as opposed to a shower.
    pub(super) hears_the_bell: bool,
    /// The visitor of a visit.
    pub(super) guest: Option<GuestOfVisit>,
}

/// The visitor whom a visit of the host's plan is about.
#[derive(Clone, Copy, Debug)]
pub(super) struct GuestOfVisit {
    pub(super) who: ResidentId,
    pub(super) has_come: bool,
    /// The end of the visit.
    pub(super) until: RunTime,
}

/// The part of an activity that a movement belongs to. The way to its place, and waiting, have labels of their own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ActivityPart {
    Itself,
    Way,
    Wait,
}

impl Playing {
    /// An unplanned activity; the plan adds what it knows.
    pub(super) fn new(steps: VecDeque<ActivityStep>, stream: Stream, name: &str) -> Playing {
        Playing {
            steps,
            stream,
            label: name.into(),
            name: name.into(),
            spot: None,
            is_interrupted: false,
            of: None,
            since: RunTime::START,
            paused: Span::ZERO,
            walks: WalkPurpose::Need,
            until: None,
            gives_way: false,
            goes_with: None,
            undisturbed: RunTime::MIN,
            is_essential: false,
            answers: None,
            still: Vec::new(),
            stirs: true,
            is_there: false,
            waits: 0,
            is_in_between: false,
            is_meanwhile: false,
            guest: None,
            hears_the_bell: false,
        }
    }

    /// The time since its start, without that of other planned activities. Company stays while the host cooks.
    pub(super) fn own_time(&self, now: RunTime) -> Span {
        let paused = if self.guest.is_some() { Span::ZERO } else { self.paused };
        now - self.since - paused
    }

    /// By needs, meals and breaks of the plan.
    pub(super) fn may_be_interrupted(&self) -> bool {
        let may = |stay: &StayStep| matches!(stay.may, Interruptible::Interrupt | Interruptible::Yield);
        matches!(self.steps.front(), Some(ActivityStep::Stay(stay)) if may(stay))
    }

    /// Leaves out what is left, except for what is on, which is turned off, and the needs that it meets.
    pub(super) fn end_early(&mut self, is_on: impl Fn(u32) -> bool) {
        let mut way = None;
        for step in std::mem::take(&mut self.steps) {
            match step {
                ActivityStep::Go(_) => way = Some(step),
                ActivityStep::Act(thing, false) if is_on(thing) => {
                    self.steps.extend(way.take().into_iter().chain([step]))
                }
                ActivityStep::Meet(_) => self.steps.push_back(step),
                _ => {}
            }
        }
        self.until = None;
    }
}

/// The present visit, as the visitor has it.
#[derive(Clone, Debug, Default)]
pub(super) struct VisitorStay {
    /// `None` until the visitor is in.
    pub(super) until: Option<RunTime>,
    pub(super) said_until: Option<RunTime>,
    /// The visit of the host's plan, until the visitor is in.
    pub(super) visit: Option<Item>,
    pub(super) lasts: Span,
    /// The visitor sleeps there, and stays while the host is out.
    pub(super) stays_over: bool,
    pub(super) has_key: bool,
    pub(super) bathroom_at: RunTime,
    pub(super) work: VecDeque<VisitorWork>,
    /// Whether the visitor may be in the bathroom with the host.
    pub(super) helps: bool,
}

/// The sleep of the present night, and of those before.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct SleepRecord {
    pub(super) awake: Span,
    pub(super) awake_since: Option<RunTime>,
    /// Whether the waking is still to be answered by rules: after a way to the toilet.
    pub(super) is_open: bool,
    /// Number of poor nights in a row.
    pub(super) poor: u32,
}

/// The purpose of walks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum WalkPurpose {
    Need,
    Errand,
    /// Back from an errand.
    Back,
    /// Within the kitchen, or with a duster: less active residents stay longer at each place instead.
    Cooking,
    Roaming,
}

/// How long people have been in the way.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct BlockedWay {
    /// Waits in a row.
    pub(super) pauses: u32,
    /// How often the person has turned back, and when and where the last time.
    pub(super) turns: u32,
    pub(super) turned: RunTime,
    pub(super) at: Point,
}
