//! An activity in progress.

use super::help::VisitorWork;
use super::places::HomePlace;
use super::resident_routine::SentenceId;
use super::script::{ActivityStep, Interruptible, StayStep};
use crate::routine::Response;
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
    pub(super) walks: WalkPurpose,
    /// Leisure and company, which meals and medicine interrupt.
    pub(super) gives_way: bool,
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
    /// By needs, meals and breaks of the plan.
    pub(super) fn may_be_interrupted(&self) -> bool {
        let may = |stay: &StayStep| matches!(stay.may, Interruptible::Interrupt | Interruptible::Yield);
        matches!(self.steps.front(), Some(ActivityStep::Stay(stay)) if may(stay))
    }

    /// Only an expired stay is left, which is not resumed.
    pub(super) fn is_nearly_over(&self, now: RunTime) -> bool {
        let is_over = |stay: &StayStep| stay.until.is_some_and(|until| until <= now);
        matches!(self.steps.front(), Some(ActivityStep::Stay(stay)) if self.steps.len() == 1 && is_over(stay))
    }
}

/// The present visit, as the visitor has it.
#[derive(Clone, Debug, Default)]
pub(super) struct VisitorStay {
    /// `None` until the visitor is in.
    pub(super) until: Option<RunTime>,
    pub(super) said_until: Option<RunTime>,
    pub(super) lasts: Span,
    /// The visitor sleeps there, and stays while the host is out.
    pub(super) stays_over: bool,
    pub(super) has_key: bool,
    pub(super) bathroom_at: RunTime,
    pub(super) work: VecDeque<VisitorWork>,
    /// Whether the visitor may be in the bathroom with the host.
    pub(super) helps: bool,
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
