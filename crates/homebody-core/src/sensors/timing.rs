//! When a motion sensor fires: the timing state machine that all motion sensors share.
//!
//! The device sends a first message soon after it notices movement, and then one every few seconds for as long
//! as movement goes on (Godsey & Skubic 2009, section III.D: first after 1-2 s, then every 6-8 s where motion is
//! still detected).
//!
//! We assume that waits are drawn evenly from their range. Idle, the machine waits for a first detection at t and
//! fires at t + U(first_fire). Then it waits U(refire); at the end of the wait it fires again if movement
//! was seen within the last `persist`, both ends of that span included, else it is idle.
//!
//! The machine only ever runs forward: it says whether it *wants* to be told of movement, and when
//! its next *timer* is due. In between it costs nothing.
//!
//! Left out: warming up after power is switched on, waits that depend on temperature or battery, and what
//! becomes of a message on its way to the logger.

use crate::ids::ResidentId;
use crate::random::{Range, Stream};
use crate::scenario::home::Timing as TimingFile;
use crate::time::{Micros, NEVER, micros};

/// The numbers of the machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Timing {
    /// From the first movement to the first firing.
    pub first_fire: Range,
    /// From a firing to the decision about the next.
    pub refire: Range,
    /// How long before the decision a movement still counts, in microseconds.
    pub persist: Micros,
}

impl Timing {
    /// The numbers of a file, which has them in seconds.
    pub fn new(file: TimingFile) -> Timing {
        Timing {
            first_fire: Range::of_seconds(file.first_fire_s),
            refire: Range::of_seconds(file.refire_s),
            persist: micros(file.persist_s),
        }
    }
}

/// One sensor's machine.
#[derive(Clone, Debug)]
pub struct Machine {
    state: State,
    timing: Timing,
    stream: Stream,
    /// Whose movement was seen, and when.
    seen: Seen,
}

/// Whose movement a sensor saw, and when.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Seen {
    /// Whose movement it was.
    pub resident: ResidentId,
    /// When it began to be seen, in microseconds since the run's start.
    pub at: Micros,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    Idle,
    /// Movement was seen; fires when the timer is due.
    Delay {
        fire: Micros,
    },
    /// Nothing that happens earlier than `persist` before `decide` can matter to the decision.
    Asleep {
        decide: Micros,
    },
    Watching {
        decide: Micros,
    },
    /// Movement was seen while watching.
    Sure {
        decide: Micros,
    },
}

/// What the timer did.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TimerOutcome {
    /// The sensor fired, for this reason.
    Fired(Seen),
    /// It did not fire, and now wants to be told of movement.
    Wakes,
}

impl Machine {
    /// A machine that has seen nothing yet; it draws its waits from the stream.
    pub fn new(timing: Timing, stream: Stream) -> Machine {
        Machine { state: State::Idle, timing, stream, seen: Seen { resident: ResidentId(0), at: 0 } }
    }

    /// Whether movement matters to the machine now.
    pub fn wants(&self) -> bool {
        matches!(self.state, State::Idle | State::Watching { .. })
    }

    /// The last instant at which movement matters, if there is one.
    pub fn wants_until(&self) -> Micros {
        match self.state {
            State::Watching { decide } => decide,
            _ => NEVER,
        }
    }

    /// When the next timer is due.
    pub fn timer(&self) -> Micros {
        match self.state {
            State::Idle => NEVER,
            State::Delay { fire } => fire,
            State::Asleep { decide } => decide - self.timing.persist,
            State::Watching { decide } | State::Sure { decide } => decide,
        }
    }

    /// Movement was seen while the machine wanted to know.
    pub fn sees(&mut self, seen: Seen) {
        self.seen = seen;
        self.state = match self.state {
            State::Idle => State::Delay { fire: seen.at + self.stream.span(self.timing.first_fire) },
            State::Watching { decide } => State::Sure { decide },
            state => state,
        };
    }

    /// The timer is due; or, while watching, nothing will be seen any more before it is, so that the decision to
    /// become idle may be taken at once.
    pub fn on_timer(&mut self) -> TimerOutcome {
        match self.state {
            State::Delay { fire: at } | State::Sure { decide: at } => {
                self.state = State::Asleep { decide: at + self.stream.span(self.timing.refire) };
                TimerOutcome::Fired(self.seen)
            }
            State::Asleep { decide } => {
                self.state = State::Watching { decide };
                TimerOutcome::Wakes
            }
            State::Watching { .. } | State::Idle => {
                self.state = State::Idle;
                TimerOutcome::Wakes
            }
        }
    }
}
