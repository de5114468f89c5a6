//! The messages of this crate and of the inference of places, for lists of all messages.

use crate::measures::NotMeasured;
use crate::walk_back::NotWalked;
use crate::{people, recogniser, sphere};
use homebody_core::messages::{Catalogue, Entry};
use homebody_infer::NotLearnt;

/// The messages by area.
pub const MESSAGES: &[&[Entry]] = &[
    NotLearnt::ENTRIES,
    NotWalked::ENTRIES,
    NotMeasured::ENTRIES,
    people::NotLived::ENTRIES,
    recogniser::NotRecognised::ENTRIES,
    recogniser::NotLived::ENTRIES,
    sphere::Undone::ENTRIES,
    sphere::Unplaced::ENTRIES,
    sphere::RowMessage::ENTRIES,
];
