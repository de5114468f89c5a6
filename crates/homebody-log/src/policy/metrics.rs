//! Metrics of a destination: counts that other threads read without making anyone wait, and news of its absence and return.

use crate::error::LogError;
use crate::table::{Batch, Cell};
use homebody_core::time::RunTime;
use std::fmt;
use std::sync::atomic::{AtomicBool, AtomicI64, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::time::Duration;

/// The counts of one destination.
#[derive(Default)]
pub struct SinkMetrics {
    rows: AtomicU64,
    durable: AtomicU64,
    retries: AtomicU64,
    spooled_bytes: AtomicU64,
    is_away: AtomicBool,
    last: AtomicI64,
    /// Why it is away, while it is.
    absence: Mutex<Option<SinkAbsence>>,
    tell: OnceLock<TellNews>,
}

/// The metrics at an instant.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MetricsReading {
    /// Rows that the destination has taken, or that were put aside for it.
    pub rows: u64,
    /// Rows that it has confirmed.
    pub durable: u64,
    /// The number of retries.
    pub retries: u64,
    /// Bytes in its spool on disk.
    pub spooled_bytes: u64,
    /// Whether it is away.
    pub is_away: bool,
    /// The instant of its last row.
    pub last: RunTime,
}

/// Hears that a destination is away, that the reason is another, and that it is back: each once.
pub type TellNews = Arc<dyn Fn(&SinkNews) + Send + Sync>;

/// A change of a destination's state, for users.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SinkNews {
    /// The name of the destination in errors.
    pub place: String,
    /// Why it is away; None once it is back.
    pub absence: Option<SinkAbsence>,
}

/// That a destination is away.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SinkAbsence {
    /// Why, as a part of a sentence.
    pub why: String,
    /// The longest wait of the run for it; None if the run continues and spools rows.
    pub waits: Option<Duration>,
}

impl fmt::Display for SinkNews {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let SinkNews { place, absence } = self;
        match absence {
            None => write!(f, "{place} is available again"),
            Some(SinkAbsence { why, waits: None }) => {
                write!(
                    f,
                    "warning: {place} is unavailable: {why}\n  Homebody stores rows in the spool until it is available"
                )
            }
            Some(SinkAbsence { why, waits: Some(waits) }) => {
                let seconds = waits.as_secs();
                write!(f, "warning: {place} is unavailable: {why}\n  the run waits for it for at most {seconds} s")
            }
        }
    }
}

impl fmt::Debug for SinkMetrics {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.debug_tuple("Meter").field(&self.read()).finish()
    }
}

impl SinkMetrics {
    /// The present metrics.
    pub fn read(&self) -> MetricsReading {
        MetricsReading {
            rows: self.rows.load(Ordering::Relaxed),
            durable: self.durable.load(Ordering::Relaxed),
            retries: self.retries.load(Ordering::Relaxed),
            spooled_bytes: self.spooled_bytes.load(Ordering::Relaxed),
            is_away: self.is_away.load(Ordering::Relaxed),
            last: RunTime::from_micros(self.last.load(Ordering::Relaxed)),
        }
    }

    /// Sets the listener for news; only the first one is kept.
    pub fn telling(&self, tell: TellNews) {
        let _ = self.tell.set(tell);
    }

    pub(crate) fn took(&self, batch: &Batch) {
        self.rows.fetch_add(batch.len() as u64, Ordering::Relaxed);
        let last = batch.len().checked_sub(1).map(|last| batch.row(last));
        let instant = |cell: &Cell| if let Cell::Instant(at) = *cell { Some(at) } else { None };
        if let Some(at) = last.and_then(|row| row.cells.iter().find_map(instant)) {
            self.last.store(at.micros(), Ordering::Relaxed);
        }
    }

    pub(crate) fn took_rows(&self, rows: u64) {
        let before = self.rows.fetch_add(rows, Ordering::Relaxed);
        self.made_sure(before + rows);
    }

    pub(crate) fn made_sure(&self, rows: u64) {
        self.durable.fetch_max(rows, Ordering::Relaxed);
    }

    pub(crate) fn tries_again(&self) {
        self.retries.fetch_add(1, Ordering::Relaxed);
    }

    pub(crate) fn puts_aside(&self, bytes: u64) {
        self.spooled_bytes.store(bytes, Ordering::Relaxed);
    }

    /// Notes that the destination with this name is away, by an error that passes; the run waits for so long, or continues.
    pub(crate) fn is_away(&self, place: &str, error: &LogError, waits: Option<Duration>) {
        let absence = Some(SinkAbsence { why: error.reason(), waits });
        self.is_away.store(true, Ordering::Relaxed);
        self.now(place, absence);
    }

    /// The destination, which errors call so, is there.
    pub(crate) fn is_there(&self, place: &str) {
        // Nearly all calls find it where it was.
        if self.is_away.swap(false, Ordering::Relaxed) {
            self.now(place, None);
        }
    }

    fn now(&self, place: &str, absence: Option<SinkAbsence>) {
        let mut before = self.absence.lock().unwrap_or_else(PoisonError::into_inner);
        if *before != absence {
            before.clone_from(&absence);
            drop(before);
            if let Some(tell) = self.tell.get() {
                tell(&SinkNews { place: place.into(), absence });
            }
        }
    }

    pub(crate) fn why_away(&self) -> Option<String> {
        let absence = self.absence.lock().unwrap_or_else(PoisonError::into_inner);
        absence.as_ref().map(|absence| absence.why.clone())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reports_absence_once_for_each_reason() {
        let (meter, told) = (SinkMetrics::default(), Arc::new(Mutex::new(Vec::new())));
        let heard = told.clone();
        meter.telling(Arc::new(move |news| heard.lock().unwrap().push(news.to_string())));
        let away = |why: &str| {
            let error = LogError::destination("a broker", why).passing();
            meter.is_away("a broker", &error, Some(Duration::from_secs(600)));
        };
        meter.is_there("a broker");
        ["nobody listens", "nobody listens", "no way there"].into_iter().for_each(away);
        assert_eq!((meter.read().is_away, meter.why_away().as_deref()), (true, Some("no way there")));
        meter.is_there("a broker");
        meter.is_there("a broker");
        let waits = "\n  the run waits for it for at most 600 s";
        let expected = [
            format!("warning: a broker is unavailable: nobody listens{waits}"),
            format!("warning: a broker is unavailable: no way there{waits}"),
            "a broker is available again".into(),
        ];
        assert_eq!(*told.lock().unwrap(), expected);
        assert_eq!((meter.read().is_away, meter.why_away()), (false, None));
    }
}
