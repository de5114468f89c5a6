//! The messages of `homebody run` and `homebody replay`.

use crate::print::grouped;
use homebody_simulation::VERSION;
use std::path::PathBuf;

homebody_core::messages! {
    /// Problems with a run and its options.
    pub enum RunMessage in "run" {
        /// A resumed run continues its own files, and the rows on servers and in object stores. A new file would lack the first rows of
        /// the run.
        MiddleOfRun { place: String, is_truth: bool } error "middle-of-run"
            ("cannot write to {place}: if the run is resumed, this destination lacks the earlier rows")
            advice (Some(match is_truth {
                true => "leave out --truth, or name a server: Homebody completes the ground truth in the folder by itself".to_owned(),
                false => "leave out this destination; homebody convert copies the log in the folder to a file".to_owned(),
            }));
        /// The command line has two values of a parameter. Homebody does not guess which one counts.
        ParameterTwice { name: String, first: f64, other: f64 } error "parameter-twice"
            ("--set {name}={first} and --set {name}={other} set the same parameter")
            hint ("set each parameter once");
        /// The ground truth of a single run always has all tables. Only cohorts can leave some out.
        TruthTables error "truth-tables" ("--truth-tables applies to cohorts only")
            hint ("leave out --truth-tables; the ground truth of a single run has all tables");
        /// A cohort simulates many members at once, and writes the files of each into one folder. Some options make sense for single
        /// runs only.
        CohortOption { option: &'static str, why: &'static str } error "cohort-option" ("{option}: {why}")
            hint ("leave out {option} for a cohort");
        /// All members of a cohort go into one folder or object store.
        CohortDestinations { count: usize } error "cohort-destinations"
            ("a cohort has only one destination, and you gave {count}")
            hint ("pass --out once, such as --out parquet:cohort");
        /// The folder belongs to `homebody live`, which simulates a home until it is stopped. A run needs an end.
        HomeInRealTime { folder: PathBuf } error "home-in-real-time"
            ("{folder} contains a home of homebody live, and its simulation has no end", folder = folder.display())
            hint ("homebody live SCENARIO --folder {folder} resumes it", folder = folder.display());
        /// SQLite cannot complete a database while another program reads it. Copy both files, or wait until that program has ended.
        OpenDatabase { file: PathBuf, part: PathBuf } warning "open-database" (
            "another program is reading {file}: until it closes the database, keep {part} with the file",
            file = file.display(),
            part = part.display()
        );
    }
}

homebody_core::messages! {
    /// Differences between a replay and its recording.
    pub enum ReplayMessage in "replay" {
        /// A replay repeats each event of a run, and compares the digests of all events. The recording has other events than the same
        /// version makes from it.
        Differs { events: u64, recorded: u64 } error "differs" (
            "the replay differs from the recording: it has {events} events, and the recording {recorded}",
            events = grouped(*events),
            recorded = grouped(*recorded)
        )
            hint ("restore the recording, which was changed after the run, or run its scenario again");
        /// Versions of Homebody have different models, so the same scenario may have other events.
        OtherVersion { version: String, events: u64, recorded: u64 } error "other-version" (
            "the replay has {events} events and the recording {recorded}: version {version} recorded the run, this is version \
             {VERSION}",
            events = grouped(*events),
            recorded = grouped(*recorded)
        )
            hint ("replay the recording with version {version}, or run its scenario again");
    }
}
