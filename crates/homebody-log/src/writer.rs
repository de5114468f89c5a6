//! A thread that writes rows, so that what makes them need not wait for the disk.
//!
//! Rows come in batches through a bounded channel: when the disk is the slower, the maker waits for it, and memory
//! stays small. An error ends the thread; it comes out of the next call to the writer.

use crate::error::LogError;
use homebody_core::time::Micros;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

/// Rows of one batch. This and the numbers below are ours.
pub(crate) const BATCH: usize = 4096;

/// Batches on their way to the thread.
const ON_THEIR_WAY: usize = 4;

/// How long rows wait for a batch to fill. Whoever watches a live run sees them a little later.
pub(crate) const BATCH_WAITS: Duration = Duration::from_millis(100);

/// Rows after which a sink makes sure of them. That takes a database three waits for the disk, so not too often.
const SETTLE_ROWS: usize = 200_000;

/// How long rows may be unsure, the time it takes to write a batch aside.
const SETTLE_AFTER: Duration = Duration::from_secs(1);

/// Where rows end up. One file each kind, all in this shape.
///
/// Its life: `open` (each kind's own), then any number of `write` and `settle`, then `finish`, or `drop` where the run
/// is given up. After an error nothing more is called but `drop`.
pub(crate) trait Sink: Send {
    type Row;

    /// The file that errors are about.
    fn path(&self) -> &Path;

    /// Takes rows; they may be lost until the next `settle`.
    fn write(&mut self, rows: &[Self::Row]) -> Result<(), LogError>;

    /// Makes sure of the rows taken.
    fn settle(&mut self) -> Result<(), LogError>;

    /// Makes sure of everything, and marks the run as ended at `end`.
    fn finish(self: Box<Self>, end: Micros) -> Result<(), LogError>;
}

/// A sink in a thread of its own.
pub(crate) struct Writer<Row> {
    path: PathBuf,
    messages: Option<SyncSender<Message<Row>>>,
    thread: Option<JoinHandle<Result<(), LogError>>>,
}

enum Message<Row> {
    Rows(Arc<Vec<Row>>),
    Finish(Micros),
}

impl<Row: Send + Sync + 'static> Writer<Row> {
    pub fn spawn(sink: Box<dyn Sink<Row = Row>>) -> Writer<Row> {
        let path = sink.path().to_owned();
        let (messages, incoming) = sync_channel(ON_THEIR_WAY);
        let thread = thread::spawn(move || write(sink, incoming));
        Writer { path, messages: Some(messages), thread: Some(thread) }
    }

    /// Hands over rows; the thread's error, if it has ended by one.
    pub fn send(&mut self, rows: Arc<Vec<Row>>) -> Result<(), LogError> {
        self.pass(Message::Rows(rows))
    }

    /// The thread's error, if it has ended by one.
    pub fn check(&mut self) -> Result<(), LogError> {
        match &self.thread {
            Some(thread) if !thread.is_finished() => Ok(()),
            _ => self.join(),
        }
    }

    /// Waits until all rows are safe and the run is marked as ended.
    pub fn finish(mut self, end: Micros) -> Result<(), LogError> {
        self.pass(Message::Finish(end))?;
        self.join()
    }

    fn pass(&mut self, message: Message<Row>) -> Result<(), LogError> {
        match &self.messages {
            Some(messages) if messages.send(message).is_ok() => Ok(()),
            _ => self.join(),
        }
    }

    fn join(&mut self) -> Result<(), LogError> {
        self.messages = None;
        match self.thread.take() {
            Some(thread) => thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)),
            None => Err(LogError::Stopped { path: self.path.clone() }),
        }
    }
}

impl<Row> Drop for Writer<Row> {
    /// Waits for the thread, so that nothing writes on after the run has been given up.
    fn drop(&mut self) {
        self.messages = None;
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

/// The thread's work.
fn write<Row>(mut sink: Box<dyn Sink<Row = Row>>, incoming: Receiver<Message<Row>>) -> Result<(), LogError> {
    let mut unsettled = 0;
    let mut settle_at = None;
    loop {
        let message = match settle_at {
            Some(at) => incoming.recv_timeout(Instant::saturating_duration_since(&at, Instant::now())),
            None => incoming.recv().map_err(|_| RecvTimeoutError::Disconnected),
        };
        match message {
            Ok(Message::Rows(rows)) => {
                sink.write(&rows)?;
                unsettled += rows.len();
                settle_at.get_or_insert_with(|| Instant::now() + SETTLE_AFTER);
            }
            Ok(Message::Finish(end)) => return sink.finish(end),
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => return sink.settle(),
        }
        // Where rows never cease to come, no wait for them ever ends by its time.
        if unsettled >= SETTLE_ROWS || settle_at.is_some_and(|at| Instant::now() >= at) {
            sink.settle()?;
            unsettled = 0;
            settle_at = None;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicUsize, Ordering};

    /// A disk slower than what makes the rows.
    struct Slow(Arc<AtomicUsize>);

    impl Sink for Slow {
        type Row = u8;

        fn path(&self) -> &Path {
            Path::new("slow")
        }

        fn write(&mut self, _: &[u8]) -> Result<(), LogError> {
            thread::sleep(Duration::from_millis(2));
            Ok(())
        }

        fn settle(&mut self) -> Result<(), LogError> {
            self.0.fetch_add(1, Ordering::Relaxed);
            Ok(())
        }

        fn finish(mut self: Box<Self>, _: Micros) -> Result<(), LogError> {
            self.settle()
        }
    }

    #[test]
    fn rows_settle_though_more_of_them_always_wait() {
        let settled = Arc::new(AtomicUsize::new(0));
        let mut writer = Writer::spawn(Box::new(Slow(settled.clone())));
        let begun = Instant::now();
        while settled.load(Ordering::Relaxed) == 0 {
            assert!(begun.elapsed() < 10 * SETTLE_AFTER, "nothing is sure after {:?}", begun.elapsed());
            writer.send(Arc::new(vec![0])).unwrap();
        }
        writer.finish(0).unwrap();
        assert!(settled.load(Ordering::Relaxed) >= 2);
    }
}
