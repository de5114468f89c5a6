//! Destinations that answer as a test wants.

use homebody_core::time::RunTime;
use homebody_log::table::{Batch, Cell};
use homebody_log::{Begin, LogError, Sink, Watermark};
use std::collections::BTreeSet;

/// The calls of a destination.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Call {
    Begin,
    Write,
    MakeDurable,
    Finish,
}

/// A destination of the run of [`super::run`] with this answer to each call; the rows are those of a write.
pub fn sink(answer: impl FnMut(Call, &Batch) -> Result<Watermark, LogError> + Send + 'static) -> impl Sink {
    Answering(answer)
}

struct Answering<F>(F);

impl<F: FnMut(Call, &Batch) -> Result<Watermark, LogError> + Send> Sink for Answering<F> {
    fn begin(&mut self, begin: &Begin) -> Result<Watermark, LogError> {
        let watermark = (self.0)(Call::Begin, &Batch::default())?;
        assert_eq!(begin.run.sensor_names(), super::sensors());
        Ok(watermark)
    }

    fn write(&mut self, batch: &Batch) -> Result<(), LogError> {
        (self.0)(Call::Write, batch).map(drop)
    }

    fn make_durable(&mut self) -> Result<Watermark, LogError> {
        (self.0)(Call::MakeDurable, &Batch::default())
    }

    fn finish(&mut self, _: RunTime) -> Result<(), LogError> {
        (self.0)(Call::Finish, &Batch::default()).map(drop)
    }
}

/// The numbers of the rows that a destination has, their sensors, and whether the run has ended.
#[derive(Default)]
pub struct Got {
    pub rows: Vec<i64>,
    pub sensors: BTreeSet<String>,
    pub ended: bool,
}

impl Got {
    /// Takes what a call brings; how many rows there are.
    pub fn take(&mut self, call: Call, batch: &Batch) -> Watermark {
        for row in batch.rows() {
            let [Cell::Integer(number), _, Cell::Text(sensor), ..] = *row.cells else { panic!("a row of a log") };
            self.rows.push(number);
            self.sensors.insert(batch.text(sensor).to_owned());
        }
        self.ended |= call == Call::Finish;
        Watermark(vec![self.rows.len() as u64])
    }

    /// Whether these rows are there, each once and in its order.
    pub fn has(&self, rows: u64) -> bool {
        self.rows.iter().copied().eq(0..rows as i64)
    }
}
