//! One thing to do: what, where, when and for how long.

use super::life::SentenceId;
use crate::routine::{Activity, Falling};
use homebody_core::time::Micros;

/// One thing to do.
#[derive(Clone, Debug, PartialEq)]
pub struct Item {
    /// Tells its random numbers from those of all others of the day.
    pub key: String,
    pub activity: Activity,
    pub place: Option<String>,
    pub falling: Option<Falling>,
    pub visitor: Option<String>,
    pub start: Micros,
    pub lasts: Micros,
    /// It ends then, however late it begins.
    pub until: Option<Micros>,
    /// It is left out if it cannot begin by then.
    pub latest: Micros,
    /// The sentence that it comes from, if it was planned.
    pub of: Option<SentenceId>,
    /// Whether no sentence of the routine says it.
    pub is_unsaid: bool,
    /// Whether it waits for what has its time: what nobody says, and what is overdue.
    pub waits: bool,
    /// Whether its time is said, and not just a part of the day.
    pub has_its_time: bool,
    /// Whether it is done so many times a day, whatever else is done: at home, if it can be.
    pub is_counted: bool,
    /// What it comes after, and how long after the end of that.
    pub follows: Option<(SentenceId, Micros)>,
}

impl Item {
    /// Something that nobody planned, to be done at once.
    pub fn now(key: String, activity: Activity, lasts: Micros) -> Item {
        Item {
            key,
            activity,
            place: None,
            falling: None,
            visitor: None,
            start: 0,
            lasts,
            until: None,
            latest: Micros::MAX,
            of: None,
            is_unsaid: true,
            waits: true,
            has_its_time: false,
            is_counted: false,
            follows: None,
        }
    }

    /// Whether what is done for pleasure is interrupted for it: meals and medicine.
    pub fn is_essential(&self) -> bool {
        let is = matches!(self.activity, Activity::Prepare(_) | Activity::Eat(_) | Activity::TakeMedicine);
        is && self.visitor.is_none()
    }
}
