//! Reads logs back: files of Parquet and of Arrow IPC, ours and those of pandas, polars and others, and data sets of them.

mod batches;
mod cells;
mod examine;
mod files;
mod guard;
mod here;
mod ipc;
mod pages;
mod rows;
mod tables;

pub(crate) use batches::Batches;
pub use batches::whole_file;
pub(crate) use examine::examine;
use homebody_log::source::{FileStart, LogForm, Shows};
pub(crate) use tables::read_tables;

pub(crate) const FORMS: [LogForm; 2] = [
    LogForm {
        name: "parquet",
        what: "Parquet, a file or a folder of them by run and day: columns of time, sensor and value under common names or those of Homebody",
        shows: |start| shows(start, batches::PARQUET),
        read: rows::read,
    },
    LogForm {
        name: "arrow",
        what: "a file of Arrow IPC (Feather, version 2), with columns as in Parquet",
        shows: |start| shows(start, batches::ARROW),
        read: rows::read,
    },
];

fn shows(start: &FileStart, magic: &[u8]) -> Shows {
    match start.begins_with(magic) {
        true if rows::are_activities(&start.path) => Shows::Activities,
        is_it => Shows::rows_if(is_it),
    }
}
