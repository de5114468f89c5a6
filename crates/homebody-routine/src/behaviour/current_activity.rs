//! An activity in progress.

use super::places::HomePlace;
use super::resident_routine::SentenceId;
use super::script::{ActivityStep, Interruptible, StayStep};
use crate::routine::Response;
use homebody_core::random::Stream;
use homebody_core::time::RunTime;
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
