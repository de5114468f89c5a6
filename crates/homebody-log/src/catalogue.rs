//! The messages of this crate, for lists of all messages.

use crate::error::LogError;
use crate::{problems, reason, source, written};
use homebody_core::messages::{Catalogue, Entry};

/// The messages by area.
pub const MESSAGES: &[&[Entry]] = &{
    let [form, table] = source::MESSAGES;
    let [length, truth, other_run, changed, hold, output, count, thread, packed, sensor_table, mapping] =
        problems::ENTRIES;
    let (own, refused) = (reason::ENTRIES, written::REFUSED);
    [
        LogError::ENTRIES,
        own,
        form,
        table,
        length,
        truth,
        other_run,
        changed,
        hold,
        output,
        refused,
        count,
        thread,
        packed,
        sensor_table,
        mapping,
    ]
};
