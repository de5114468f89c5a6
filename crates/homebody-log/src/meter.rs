//! What can be said from outside of a destination while rows go there: counts that whoever likes may look at, without anybody
//! waiting for them.

use crate::table::{Batch, Cell};
use homebody_core::time::Micros;
use std::sync::atomic::{AtomicBool, AtomicI64, AtomicU64, Ordering};

/// The counts of one destination.
#[derive(Debug, Default)]
pub struct Meter {
    rows: AtomicU64,
    durable: AtomicU64,
    retries: AtomicU64,
    spooled_bytes: AtomicU64,
    is_away: AtomicBool,
    last: AtomicI64,
}

/// What a meter shows at an instant.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Reading {
    /// Rows that the destination has taken, or that were put aside for it.
    pub rows: u64,
    /// Rows that it has confirmed.
    pub durable: u64,
    /// How often a call was made again.
    pub retries: u64,
    /// How much is put aside for it on disk, in bytes.
    pub spooled_bytes: u64,
    /// Whether it is away.
    pub is_away: bool,
    /// The instant of its last row, in microseconds since the run's start.
    pub last: Micros,
}

impl Meter {
    /// What it shows.
    pub fn read(&self) -> Reading {
        Reading {
            rows: self.rows.load(Ordering::Relaxed),
            durable: self.durable.load(Ordering::Relaxed),
            retries: self.retries.load(Ordering::Relaxed),
            spooled_bytes: self.spooled_bytes.load(Ordering::Relaxed),
            is_away: self.is_away.load(Ordering::Relaxed),
            last: self.last.load(Ordering::Relaxed),
        }
    }

    /// Rows were taken.
    pub(crate) fn took(&self, batch: &Batch) {
        self.rows.fetch_add(batch.len() as u64, Ordering::Relaxed);
        let last = batch.len().checked_sub(1).map(|last| batch.row(last));
        let instant = |cell: &Cell| if let Cell::Instant(at) = *cell { Some(at) } else { None };
        if let Some(at) = last.and_then(|row| row.cells.iter().find_map(instant)) {
            self.last.store(at, Ordering::Relaxed);
        }
    }

    /// So many rows were taken, and are durable.
    pub(crate) fn took_rows(&self, rows: u64) {
        let before = self.rows.fetch_add(rows, Ordering::Relaxed);
        self.made_sure(before + rows);
    }

    /// So many rows are durable.
    pub(crate) fn made_sure(&self, rows: u64) {
        self.durable.fetch_max(rows, Ordering::Relaxed);
    }

    /// A call is made again.
    pub(crate) fn tries_again(&self) {
        self.retries.fetch_add(1, Ordering::Relaxed);
    }

    /// The destination is away or back, and so much is put aside for it.
    pub(crate) fn puts_aside(&self, is_away: bool, bytes: u64) {
        self.is_away.store(is_away, Ordering::Relaxed);
        self.spooled_bytes.store(bytes, Ordering::Relaxed);
    }
}
