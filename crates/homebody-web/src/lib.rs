//! The local web app: a server that lives runs, and the page that looks at them.
//!
//! The page draws and sends input; everything that counts happens here, on the same engine as every other run, into the same
//! files. A run has one thread of its own, the stage. Pages come and go: what they miss are pictures, never firings.
//!
//! In reading order:

/// What the page and the server say to each other.
pub mod wire;

/// The messages of the server.
pub mod catalogue;
pub mod messages;
mod refusal;

/// The folders that the page may see: the scenario, and the runs.
pub mod shelf;

/// A run that is lived, paused, driven, lived again.
pub mod staged_run;
mod dates;
mod draw;
mod growth;
mod driven;
mod effort;
mod looks;

/// Files that are written in the page.
mod turns;
pub mod desk;
pub mod stage;

/// Runs that are stored, day by day; logs that were walked back are played as runs.
mod film;
mod stored_log;
mod walked;
pub mod playback;

/// What stored runs are called, and what becomes of them.
mod aside;
mod keeping;

/// A folder of homes.
mod copied;
pub mod library;

/// Logs that are opened in the page, and what they hold.
pub mod walks;
mod told;

/// Notes about alerts and days.
mod notes;

/// Who may ask what, and who answers.
mod visit;
pub mod guard;
mod connections;
mod doorway;
pub mod kept_address;
mod page;
mod answers;
mod house;
mod homes;
pub mod server;
mod socket;
mod metrics;

pub use metrics::serve_metrics;
pub use page::has_page;
pub use server::{Address, Offer, Options, ServeError, serve};
