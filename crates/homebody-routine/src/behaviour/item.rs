//! An activity of a plan: what, where, when, how long.

use super::resident_routine::SentenceId;
use crate::routine::{Activity, Falling, Habit};
use homebody_core::time::{Interval, MINUTE, RunTime, Span};

#[derive(Clone, Debug, PartialEq)]
pub struct Item {
    /// Name of its random numbers, unique within the day.
    pub key: String,
    pub activity: Activity,
    pub place: Option<String>,
    pub falling: Option<Falling>,
    pub visitor: Option<String>,
    pub start: RunTime,
    /// The latest stated start: later than `start` if the sentence gives a span of time.
    pub stated_by: RunTime,
    pub lasts: Span,
    /// A latest end, however late it begins.
    pub until: Option<RunTime>,
    /// Dropped if it cannot begin by then.
    pub latest: RunTime,
    /// `None` if unplanned.
    pub of: Option<SentenceId>,
    /// Of an outing, the sentence with the time of coming home.
    pub home: Option<SentenceId>,
    /// Not stated in the routine.
    pub is_unsaid: bool,
    /// It yields to activities with a time: unstated and overdue ones.
    pub waits: bool,
    /// A stated activity comes before it, with a gap between them.
    pub is_awaited: bool,
    /// A stated time, and not just a part of the day.
    pub has_its_time: bool,
    /// Possible starts, if the sentence gives a part of the day.
    pub open: Option<Interval<RunTime>>,
    /// A stated number per day, whatever else is done; at home if possible.
    pub is_counted: bool,
    /// Of a visit: whether the visitor has a key, and what they do.
    pub has_key: bool,
    pub does: Vec<Activity>,
    /// Whether the visitor was let in already, between two steps of another activity.
    pub is_let_in: bool,
    pub follows: Option<Follows>,
    /// Of an outing: whether it replaces a meal.
    pub eats_out: bool,
    /// A thing that is on as long as it lasts.
    pub thing_on: Option<String>,
    /// A thing that is turned on or off, and nothing else.
    pub turns: Option<Turning>,
    /// Done while the activity that it interrupts lasts.
    pub is_meanwhile: bool,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turning {
    pub thing: u32,
    pub on: bool,
    /// Until when it stays on, if planned.
    pub until: Option<RunTime>,
}

/// The activity that another waits for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Follows {
    pub of: SentenceId,
    pub how: Following,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Following {
    /// This long after its end.
    After(Span),
    /// At its own time, but not before the end of the other.
    NotBefore,
    /// As the other begins.
    With,
    /// While the other lasts.
    Meanwhile,
}

/// A thing that stays on until then, whatever else is done.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct HeldThing {
    pub(super) thing: u32,
    pub(super) until: RunTime,
}

/// Longest visit without a meal of the host alone (our choice).
const SHORT_VISIT: Span = MINUTE.times(45);

impl Item {
    pub fn now(key: String, activity: Activity, lasts: Span) -> Item {
        Item {
            key,
            activity,
            place: None,
            falling: None,
            visitor: None,
            start: RunTime::START,
            stated_by: RunTime::MIN,
            lasts,
            until: None,
            latest: RunTime::MAX,
            of: None,
            home: None,
            is_unsaid: true,
            waits: true,
            is_awaited: false,
            has_its_time: false,
            open: None,
            is_counted: false,
            has_key: false,
            does: Vec::new(),
            is_let_in: false,
            follows: None,
            eats_out: false,
            thing_on: None,
            turns: None,
            is_meanwhile: false,
        }
    }

    /// The stated time, even if something else moved the start.
    pub(super) fn due(&self) -> RunTime {
        if self.stated_by > RunTime::MIN { self.stated_by } else { self.start }
    }

    /// Meals and medicine, which interrupt leisure.
    pub fn is_essential(&self) -> bool {
        let is = matches!(self.activity, Activity::Prepare(_) | Activity::Eat(_) | Activity::TakeMedicine);
        is && self.visitor.is_none()
    }

    /// Leisure and company, which meals interrupt. A short visit is over before the meal.
    pub fn gives_way(&self, lasts: Span) -> bool {
        self.activity.gives_way_to_meals() && !(self.activity == Activity::Visit && lasts <= SHORT_VISIT)
    }

    /// Whether it is still done before bed when late.
    pub fn can_wait_for_bed(&self, bed: RunTime) -> bool {
        self.start < bed && self.lasts <= 20 * MINUTE
    }
}

impl Activity {
    /// Done at night if so stated, in or out of bed; all other activities are done before bed.
    pub(crate) fn is_of_the_night(&self) -> bool {
        use Activity::{Drink, Fall, Lap, Leave, LieAwake, Pace, Snack, Stumble, UseBathroom, Wander};
        matches!(self, UseBathroom | LieAwake | Fall | Stumble | Wander | Pace | Lap | Drink | Snack | Leave)
    }

    /// Whether it is done later if its time passed away from home or asleep; not if it is also done elsewhere.
    pub(super) fn can_come_later(&self) -> bool {
        matches!(self, Activity::Wander | Activity::Pace | Activity::Lap | Activity::Fall | Activity::Stumble)
    }

    /// As opposed to waiting for its turn.
    pub(super) fn interrupts(&self, at_night: bool) -> bool {
        match self {
            Activity::Wander | Activity::Pace | Activity::Lap | Activity::LieAwake | Activity::UseBathroom => true,
            Activity::Fall | Activity::Stumble => true,
            _ => at_night,
        }
    }
}

impl Habit {
    pub(super) fn is_done_on_a_day_in_bed(&self) -> bool {
        use Activity::{GetUp, GoToBed, Leave, TakeMedicine};
        let is_needed = matches!(self.activity, GetUp | GoToBed | TakeMedicine) || self.activity.is_of_the_night();
        self.visitor.is_some() || is_needed && self.activity != Leave
    }
}
