//! Where somebody was at each instant, with how much doubt, from what the sensors of their home said.
//!
//! [`Senses::learn`] lets a body go everywhere in a home and do everything there equally often, and counts what the sensors say
//! of it: so it knows the home, its fields, the timing of its sensors, the faults of its link, and how long walking takes, and
//! nothing of how anybody lives. [`translate`] then asks of a log in which places a body that moves so would have made the
//! sensors speak, and be silent, as they did.
//!
//! The model is a Markov-modulated Poisson process: in each state (a patch of floor on which one walks or stands, a seat, a
//! bed, being out) every sensor speaks at a rate of its own. What is said and what is left unsaid both count.
//!
//! Instants are microseconds since the run's start, places metres in the plan's coordinates.

#![warn(missing_docs)]

mod belief;
mod exponential;
mod flow;
mod health;
mod learn;
mod pair;
mod rover;
mod said;
mod smooth;
mod spells;
mod states;
mod steps;
mod track;
mod turns;
mod visits;
mod watch;

pub use health::{Ailment, Counted, Examination, Finding, Pass, health};
pub use learn::{NotLearnt, Senses};
pub use said::{Message, Said};
pub use smooth::{Chances, Follower, Guess, Instant, follow, translate};
pub use spells::{Ill, Spell, spells};
pub use states::{Kind, State, States};
pub use steps::Heard;
pub use track::Track;
