//! What is being done, as far as it has come.

use super::life::SentenceId;
use super::places::Spot;
use super::script::{Stay, Step};
use crate::routine::Response;
use homebody_core::random::Stream;
use homebody_core::time::Micros;
use std::collections::VecDeque;

/// A script that is being played.
#[derive(Clone, Debug)]
pub(super) struct Playing {
    pub(super) steps: VecDeque<Step>,
    pub(super) stream: Stream,
    pub(super) name: String,
    /// What it was called as it began.
    pub(super) label: String,
    /// Where it was when it was interrupted.
    pub(super) spot: Option<Spot>,
    pub(super) is_interrupted: bool,
    /// The sentence that it comes from, and since when it is played.
    pub(super) of: Option<SentenceId>,
    pub(super) since: Micros,
    pub(super) walks: Walks,
    /// Whether meals and medicine interrupt it: what is done for pleasure, and company.
    pub(super) gives_way: bool,
    pub(super) is_essential: bool,
    /// Which rule it answers, by its place, and what that asks for still, the next last.
    pub(super) answers: Option<usize>,
    pub(super) still: Vec<Response>,
    /// Whether the stay's next move is a movement.
    pub(super) stirs: bool,
}

impl Playing {
    /// Whether nothing is left but a stay whose time is over: nobody goes back for that.
    pub(super) fn is_nearly_over(&self, now: Micros) -> bool {
        let is_over = |stay: &Stay| stay.until.is_some_and(|until| until <= now);
        matches!(self.steps.front(), Some(Step::Stay(stay)) if self.steps.len() == 1 && is_over(stay))
    }
}

/// What the ways of a script are walked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Walks {
    Need,
    /// An errand.
    Errand,
    /// Back from one, to what is done next.
    Back,
    /// To and fro in the kitchen, or with a duster: who moves less takes longer at each place instead.
    Cooking,
    /// Wandering, which is counted for itself.
    Roaming,
}
