//! When a motion sensor fires: the timing state machine that all motion sensors share.
//!
//! The device sends a first message soon after it notices movement, and then one every few seconds until the movement
//! ends (Godsey & Skubic 2009, section III.D: first after 1-2 s, then every 6-8 s where motion is still detected).
//!
//! We assume that waits are drawn evenly from their range. Idle, the machine waits for a first detection at t and
//! fires at t + U(first_fire). Then it waits U(refire); at the end of the wait it fires again if movement
//! was seen within the last `persist`, both ends of that span included, else it is idle.
//!
//! The machine only ever runs forward: it reports whether it *wants* to hear of movement, and the instant of its next
//! *timer*. In between it costs nothing.
//!
//! Left out: warming up after power is switched on, waits that depend on temperature or battery, and what
//! becomes of a message on its way to the logger.

use crate::ids::ResidentId;
use crate::random::{SpanRange, Stream};
use crate::sensors::preset::TimingSeconds;
use crate::time::{RunTime, Span};

/// The numbers of the machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FiringTiming {
    /// From the first movement to the first firing.
    pub first_fire: SpanRange,
    /// From a firing to the decision about the next.
    pub refire: SpanRange,
    /// The time before the decision in which a movement still counts.
    pub persist: Span,
}

impl FiringTiming {
    /// The numbers of a file, which has them in seconds.
    pub fn new(file: TimingSeconds) -> FiringTiming {
        FiringTiming {
            first_fire: SpanRange::from_seconds(file.first_fire_s),
            refire: SpanRange::from_seconds(file.refire_s),
            persist: Span::from_seconds(file.persist_s),
        }
    }
}

/// One sensor's machine.
#[derive(Clone, Debug)]
pub struct Machine {
    state: MachineState,
    timing: FiringTiming,
    stream: Stream,
    seen: Sighting,
}

/// A resident whose movement a sensor saw, and the instant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sighting {
    /// The resident.
    pub resident: ResidentId,
    /// When it began to be seen.
    pub at: RunTime,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum MachineState {
    Idle,
    /// Movement was seen; fires when the timer is due.
    Delay {
        fire: RunTime,
    },
    /// Nothing that happens earlier than `persist` before `decide` can matter to the decision.
    Asleep {
        decide: RunTime,
    },
    Watching {
        decide: RunTime,
    },
    /// Movement was seen while watching.
    Sure {
        decide: RunTime,
    },
}

/// The outcome of the timer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TimerOutcome {
    /// The sensor fired, for this reason.
    Fired(Sighting),
    /// It did not fire, and now wants to hear of movement.
    Wakes,
}

impl Machine {
    /// A machine that has seen nothing yet; it draws its waits from the stream.
    pub fn new(timing: FiringTiming, stream: Stream) -> Machine {
        Machine {
            state: MachineState::Idle,
            timing,
            stream,
            seen: Sighting { resident: ResidentId(0), at: RunTime::START },
        }
    }

    /// Whether movement matters to the machine now.
    pub fn wants(&self) -> bool {
        matches!(self.state, MachineState::Idle | MachineState::Watching { .. })
    }

    /// The last instant at which movement matters, if there is one.
    pub fn wants_until(&self) -> RunTime {
        match self.state {
            MachineState::Watching { decide } => decide,
            _ => RunTime::NEVER,
        }
    }

    /// When the next timer is due.
    pub fn timer(&self) -> RunTime {
        match self.state {
            MachineState::Idle => RunTime::NEVER,
            MachineState::Delay { fire } => fire,
            MachineState::Asleep { decide } => decide - self.timing.persist,
            MachineState::Watching { decide } | MachineState::Sure { decide } => decide,
        }
    }

    /// Movement was seen while the machine wanted to know.
    pub fn sees(&mut self, seen: Sighting) {
        self.seen = seen;
        self.state = match self.state {
            MachineState::Idle => MachineState::Delay { fire: seen.at + self.stream.span(self.timing.first_fire) },
            MachineState::Watching { decide } => MachineState::Sure { decide },
            state => state,
        };
    }

    /// The timer is due; or, while watching, nothing will be seen any more before it is, so that the decision to
    /// become idle may be taken at once.
    pub fn on_timer(&mut self) -> TimerOutcome {
        match self.state {
            MachineState::Delay { fire: at } | MachineState::Sure { decide: at } => {
                self.state = MachineState::Asleep { decide: at + self.stream.span(self.timing.refire) };
                TimerOutcome::Fired(self.seen)
            }
            MachineState::Asleep { decide } => {
                self.state = MachineState::Watching { decide };
                TimerOutcome::Wakes
            }
            MachineState::Watching { .. } | MachineState::Idle => {
                self.state = MachineState::Idle;
                TimerOutcome::Wakes
            }
        }
    }
}
