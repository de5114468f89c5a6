//! The ground truth of a run, read back from any kind of place.

mod causes;
mod lives;
mod movements;
mod recorded;
mod rows;
pub(crate) mod text;
mod turns;

pub(crate) use causes::{Cause, Causes};
pub(crate) use lives::lives_of;
pub use lives::{Life, LifeSpan, SpanKind, activities, life_spans, lives};
pub use movements::{Movement, MovementKind, Movements};
pub(crate) use recorded::{LABEL_TABLES, RecordedTruth};
pub use recorded::{is_brief, is_truth_set, truth_at, truth_beside, truth_of};
pub use rows::{is_truth_of, truth_rows};
