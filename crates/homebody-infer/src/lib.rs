//! Locates the people of a home at each instant from a log, with probabilities.
//!
//! [`Senses::learn`] simulates a body that goes everywhere and does everything equally often, and counts the responses of
//! the sensors. The result holds the home, the fields, timing and link of its sensors and the time of walks, but no habits
//! of residents. [`translate`] then computes the places that explain the messages and silences of a log best.
//!
//! The model is a Markov-modulated Poisson process: in each state (walking or standing on a patch of floor, a seat, a bed,
//! being out) every sensor sends messages at a rate of its own. Messages and silences both count.
//!
//! Instants are run time; for a log without a known run, the wall time is taken for the run time. Places are metres in the
//! plan's coordinates.

mod belief;
mod exponential;
mod transition_matrices;
mod examination;
mod senses;
mod body_pair;
mod random_walk;
mod message;
mod smoother;
mod fault_interval;
mod states;
mod log_step;
mod track;
mod transition;
mod visits;
mod sensor_day;

pub use examination::{Examination, ExaminationPass, FaultFinding, PassCounts, SensorFault, health};
pub use fault_interval::{FaultInterval, FaultIntervalKind, fault_intervals};
pub use log_step::MessageContent;
pub use message::{LogMessage, MessageKind};
pub use senses::{ResponseError, Senses};
pub use smoother::{Chances, Follower, Guess, InstantEstimate, follow, translate};
pub use states::{BodyState, StateKind, States};
pub use track::Track;
