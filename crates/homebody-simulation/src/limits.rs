//! Limits of cohorts.

/// Largest number of members of a cohort (our choice).
pub const MOST_MEMBERS: u32 = 100_000;

/// Days of all members together above which a cohort is large (our choice): a database needs about a megabyte a day. By
/// default, only the brief tables of its ground truths are written.
pub const LARGE_DAYS: i64 = 10_000;
