//! The local web app: a server that simulates runs, and its page.
//!
//! The page draws and sends input. The server computes everything, with the engine and the files of any other run. The run has a thread
//! of its own, the stage. A page that is slow or closed misses frames, never rows.
//!
//! In reading order:

pub mod wire;

pub mod catalogue;
pub mod messages;
mod request_error;

pub mod folders;

/// The run that pages watch and control.
pub mod staged_run;
mod dates;
mod draw;
mod live_counts;
mod manual_control;
mod budget;
mod live_cameras;

/// Files that a person edits in the page.
mod write_locks;
pub mod drafts;
mod free_text;
pub mod stage;

/// Stored runs, and located logs as runs.
mod stored_silhouettes;
mod stored_log;
mod located_log;
pub mod playback;

mod trash;
mod stored_runs;

/// Folders of homes.
mod folder_copy;
pub mod library;

/// Logs that a page opens or compares.
pub mod locating;
mod log_reports;

mod notes;

/// Access, connections, and answers.
mod client;
pub mod guard;
mod connections;
mod browser_file;
pub mod address_file;
mod page;
mod answers;
mod open_home;
mod open_homes;
pub mod server;
mod socket;
mod metrics;

pub use metrics::serve_metrics;
pub use page::has_page;
pub use server::{Offer, Options, PageAddress, ServeError, serve};
