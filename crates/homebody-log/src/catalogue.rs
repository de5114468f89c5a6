//! The messages of this crate, for lists of all messages.

use crate::error::{ENTRIES, LogError, reason};
use crate::source::messages::{FormMessage, TableMessage};
use homebody_core::messages::{Catalogue, CatalogueEntry};

/// The messages by area.
pub const MESSAGES: &[&[CatalogueEntry]] = &{
    let [length, truth, other_run, changed, hold, output, refused, count, thread, packed, sensor_table, mapping] =
        ENTRIES;
    let (form, table) = (FormMessage::ENTRIES, TableMessage::ENTRIES);
    [
        LogError::ENTRIES,
        reason::ENTRIES,
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
