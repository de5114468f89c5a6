//! The ground truth of a run, read back from any kind of place.

mod causes;
mod movements;
mod recorded;
mod rows;
mod timeline;
mod turns;

pub(crate) use causes::{Cause, Causes};
pub use movements::{Movement, MovementKind, Movements};
pub(crate) use recorded::{LABEL_TABLES, RecordedTruth};
pub use recorded::{is_brief, is_truth_set, truth_at, truth_beside, truth_of};
pub use rows::{is_truth_of, truth_rows};
pub(crate) use timeline::timeline_of;
pub use timeline::{TakeEpisode, each_episode, read_timeline};
