//! The rows of a log that are signs of a person, and the sensors that they are of.
//!
//! The best evidence decides what a sensor is, and `look` shows which evidence that was:
//!
//! | evidence | what it is |
//! |---|---|
//! | table | the kind in `sensors.csv` in the log's folder |
//! | source | a class of device, a type, a unit, the domain of an id |
//! | home | the kind in the home of the log |
//! | values | numbers, `OPEN` and `CLOSE` |
//! | name | words of its name or id, in any language of the plan importer |
//! | guess | how long it is `ON` |
//!
//! Words of kinds have their meanings in `homebody_core::sensed`, words of names in `homebody_core::vocabulary`, words of states in
//! `homebody_core::states`.
//!
//! A name with `door` or `bed` may be that of a contact or a mattress, or of a motion sensor that looks there. It is a motion sensor if it
//! is `ON` for moments and no sensor of the log has a word for motion in its name, or if it is named as CASAS names them, such as
//! `BedroomADoor`. If nothing but doors and fridges is `ON` for moments, no sensor looks.
//!
//! A state that is not known, such as `unavailable`, ends what was on, and so does a gap of the recorder. The first state after it begins
//! nothing if it is the same as the last before it: a system restores states as it starts.

mod course;
mod evidence;
mod meanings;
mod names;
mod spans;
mod tally;
mod classification;

pub use classification::{Beforehand, LogSensors, kind_in_home, kinds, taken};
pub use course::{RowMeaning, SensorCourse, said};
pub use evidence::{Classification, Evidence};
pub use homebody_core::sensed::Kind;
pub use homebody_core::states::{Says, says};
pub use meanings::{Meanings, OwnWords, is_number};
pub use names::is_seat;
pub use spans::{UnknownStates, spans, spans_until};
pub use tally::SensorTally;

#[cfg(test)]
mod tests;
