//! Destinations of the caller's own: what one needs to write a [`Sink`] that takes the rows of a log, and to say by a [`Policy`]
//! what becomes of the run if it fails or does not answer.
//!
//! ```
//! use homebody_simulation::destination::{Batch, Begin, Cell, ColumnKind, Destination, LogError, Policy, RunTime, Sink, Watermark};
//! use homebody_simulation::Destinations;
//! use std::sync::{Arc, Mutex};
//! use std::time::Duration;
//!
//! /// Keeps the instants of all rows.
//! #[derive(Clone, Default)]
//! struct Instants(Arc<Mutex<Vec<RunTime>>>);
//!
//! impl Sink for Instants {
//!     fn begin(&mut self, begin: &Begin) -> Result<Watermark, LogError> {
//!         match begin.tables[0].columns.iter().any(|column| column.kind == ColumnKind::Instant) {
//!             true => Ok(Watermark::none()),
//!             false => Err(LogError::destination("instants", "rows of this log have no instant")),
//!         }
//!     }
//!
//!     fn write(&mut self, batch: &Batch) -> Result<(), LogError> {
//!         let instant = |cell: &Cell| if let Cell::Instant(at) = *cell { Some(at) } else { None };
//!         let instants = batch.rows().filter_map(|row| row.cells.iter().find_map(instant));
//!         self.0.lock().expect("no thread panicked").extend(instants);
//!         Ok(())
//!     }
//!
//!     fn make_durable(&mut self) -> Result<Watermark, LogError> {
//!         Ok(Watermark::none()) // Memory is not durable.
//!     }
//!
//!     fn finish(&mut self, _end: RunTime) -> Result<(), LogError> {
//!         Ok(())
//!     }
//! }
//!
//! let instants = Instants::default();
//! // The run continues without it if it fails, or does not answer for ten seconds.
//! let policy = Policy { answers_within: Duration::from_secs(10), ..Policy::optional() };
//! let own = Destination::own("instants", instants.clone(), policy);
//! let run = homebody_simulation::template("studio")?.run().days(0.5).start()?;
//! let summary = run.store_with(&Destinations::own(), vec![own], |_| ())?;
//! assert!(summary.stored.failed.is_empty());
//! assert_eq!(instants.0.lock().unwrap().len() as u64, summary.stored.rows);
//! # Ok::<(), homebody_simulation::SimulationError>(())
//! ```

pub use homebody_core::calendar::Calendar;
pub use homebody_core::scenario::logger::TimeFormat;
pub use homebody_core::time::{RunTime, Span};
pub use homebody_log::table::{Batch, BatchRow, Cell, Column, ColumnKind, Table, TextId};
pub use homebody_log::{Begin, Sink, Watermark, WriteMode};
pub use homebody_log::{Destination, LogError, Policy, RunInfo, SensorInfo, Stored};
