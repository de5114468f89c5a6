//! The home as a run uses it: checked, resolved, baked, and never changed.

pub mod plan;
