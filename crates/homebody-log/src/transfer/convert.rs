//! Carries a log from one form into another, with what it tells of activities.

use super::{Besides, Rewrite, Transfer};
use crate::error::{HoldMessage, LogError, place_of};
use crate::log::{CHANGE, Event, GoingOn, LABEL, Log, RowNotes};
use crate::table::{Cell, Column, ColumnKind, TextPool};
use homebody_core::scenario::scheme::TablePlacement;
use std::path::Path;

/// Writes a log to another place; returns the number of rows. `about` is its [`survey`](crate::read::survey); `progress` gets the number
/// of written rows.
///
/// Its activities go with it: into a table of their own and onto the rows, or as notes at rows if the form has these.
///
/// # Errors
///
/// [`LogError::CannotHold`] if the form has notes at rows, and the log fewer rows than notes.
pub fn convert(transfer: &Transfer, about: &Log, mut progress: impl FnMut(u64)) -> Result<u64, LogError> {
    convert_as(transfer, about, None, &mut progress)
}

/// The same with changed rows; `about` has them after the change.
pub(crate) fn convert_as(
    transfer: &Transfer,
    about: &Log,
    rewrite: Option<&Rewrite>,
    progress: &mut dyn FnMut(u64),
) -> Result<u64, LogError> {
    if about.activities.is_empty() {
        let besides = Besides { rewrite, ..Besides::of_log() };
        return transfer.write(about, besides, &mut |_, _, _, _, _| Ok(()), progress);
    }
    let text = |name: &str, about| Column { name: name.into(), kind: ColumnKind::Text, unit: "", about };
    if transfer.to.scheme().row().tables != TablePlacement::OneWithNotes {
        let mut going_on = GoingOn::for_log(about);
        let mut more = |_: u64, event: &Event, _: &Log, texts: &mut TextPool, cells: &mut Vec<Cell>| {
            cells.push(going_on.at(event.at).map_or(Cell::Null, |label| Cell::Text(texts.id(&label))));
            Ok(())
        };
        let columns = vec![text(LABEL, "what goes on, by the log itself")];
        let besides = Besides { columns, spans: &about.activities, rewrite, ..Besides::of_log() };
        return transfer.write(about, besides, &mut more, progress);
    }
    let cannot_hold = || {
        let place = place_of(transfer.to.file().unwrap_or(Path::new("")));
        let (activities, rows) = (about.activities.len(), about.rows);
        LogError::cannot_hold(place, HoldMessage::CasasActivities { activities, rows })
    };
    let mut notes = RowNotes::for_log(about).ok_or_else(cannot_hold)?;
    let mut more = |seq: u64, event: &Event, _: &Log, texts: &mut TextPool, cells: &mut Vec<Cell>| {
        let note = notes.of_row(event.at, about.rows - seq);
        cells.extend(
            note.map_or([Cell::Null; 2], |(name, change)| [name, change].map(|text| Cell::Text(texts.id(text)))),
        );
        Ok(())
    };
    let columns = vec![text(LABEL, "what begins or ends here"), text(CHANGE, "begin or end")];
    transfer.write(about, Besides { columns, rewrite, ..Besides::of_log() }, &mut more, progress)
}
