//! Parquet and Arrow IPC: files, and data sets of files by run and day, as destinations of logs and truths and as sources of logs.
//!
//! This crate does not know what rows mean: it turns the tables of `homebody-log` into columns, and columns into rows.
//! Reading order: `layout.rs` says which types columns have and what a file tells of itself, `columns.rs` collects rows,
//! `encoded.rs` makes bytes of them, and `sink/` puts these where they belong; `source/` is the way back.

mod columns;
mod encoded;
mod fault;
mod frame;
mod layout;
mod messages;
mod sink;
mod source;
#[cfg(feature = "cloud")]
mod store;

pub use arrow_schema::ArrowError;
pub use arrow_schema::SchemaRef;
pub use frame::{ColumnTable, TextColumn};
use homebody_core::scenario::scheme::Scheme;
use homebody_log::Policy;
use homebody_log::registry::PlacePlugin;
pub use messages::MESSAGES;
pub use source::whole_file;
#[cfg(feature = "cloud")]
pub use store::Store;

pub const PLUGIN: PlacePlugin = PlacePlugin {
    schemes: &[Scheme::Parquet, Scheme::Arrow],
    open: sink::open,
    fleet: None,
    policy: Policy::default,
    forms: &source::FORMS,
    tables: Some(source::read_tables),
    truth_of: None,
    examine: source::examine,
};
