//! Messages that several commands have in common: about logs, moments, pictures and new homes.

use crate::failure::Failure;
use homebody_analysis::density::NoMap;
use homebody_core::messages::Diagnose;
use homebody_core::problem::Diagnostic;
use homebody_picture::PngError;
use std::path::PathBuf;

/// The failure to compare two logs, with all reasons.
pub fn not_comparable(reasons: &[impl Diagnose]) -> Failure {
    Failure::all(reasons.iter().map(Diagnose::diagnostic).collect())
}

/// The failure to measure a log.
pub fn not_measurable(log: &str, why: &NoMap) -> Failure {
    Failure::asked(Diagnostic::of_file(log, why.diagnostic(), None))
}

/// The failure to draw a picture; the option makes it smaller.
pub fn undrawn(error: &PngError, option: &str) -> Failure {
    let failure = Failure::asked(error.diagnostic());
    match error {
        PngError::Size { .. } => failure.advising(&format!("choose a smaller {option}")),
        _ => failure,
    }
}

homebody_core::messages! {
    /// Problems with the contents of a log.
    pub enum LogContentMessage in "log-content" {
        /// A log without rows has no days. The run may have just begun, or no line of the file is a row: `homebody inspect` lists the
        /// lines that Homebody cannot parse.
        NoRows { log: String } error "no-rows" ("{log}: the log has no rows")
            hint ("name another log, or simulate a longer run");
        /// Days are dates in the local time of the home. The words first and last also name days of a log.
        NoDay {
            log: String,
            /// The date asked for, or `first` or `last`.
            day: String,
            first: String,
            last: String,
        } error "no-day" ("{log} has no day {day}")
            hint ("choose a day from {first} to {last}, or write first or last");
        /// The command needs the ground truth of the run that wrote the log. Homebody looks for it in the run's folder.
        NoTruth { log: String, command: &'static str } error "no-truth" ("{log} has no ground truth")
            advice (Some(match *command {
                "convert" => "name the folder of a run with its ground truth, or leave out --activities to convert the log's activities".to_owned(),
                _ => "name the ground truth after the log, such as truth.db, csv:FILE or parquet:FILE".to_owned(),
            }));
        /// The run was interrupted or still continues, so the log lacks its later rows. A resumed run writes them.
        IncompleteRun { log: String, resume: PathBuf } warning "incomplete-run" ("{log}: this run is incomplete")
            hint ("homebody run --resume {resume} completes it", resume = resume.display());
        /// The run was killed, so its log and its ground truth may end at different rows. The rows in between would have no labels.
        UnequalEnds { log: String, resume: PathBuf } error "unequal-ends"
            ("{log}: this run is incomplete, so its log and its ground truth may end at different rows")
            hint ("homebody run --resume {resume} completes it", resume = resume.display());
    }
}

homebody_core::messages! {
    /// Problems with moments of a run.
    pub enum MomentMessage in "moment" {
        /// A moment of a run is a date and a time, or a time alone: then it is in the first 24 hours of the run. Times are those of the
        /// home's clock.
        NotATime { text: String } error "not-a-time" ("{text:?} is not a time")
            hint ("write a time such as 2026-01-12T18:40:05, or 18:40:05 in the first 24 hours of the run");
        /// The run begins later than this moment, or has ended before it. A moment without a date is in the first 24 hours of the run.
        OutsideRun { asked: String, begin: String, end: String } error "outside-run" ("the time {asked} is outside the run")
            hint ("choose a time from {begin} to {end}");
        /// The last moment is at or before the first one, so no moment is between them. Perhaps the last one has no date: a time alone is in
        /// the first 24 hours of the run.
        NoSpan { from: String, to: String } error "no-span" ("--to is {to}, which is not later than --from, {from}")
            hint ("pass a later time to --to, or an earlier time to --from");
    }
}

homebody_core::messages! {
    /// Problems with pictures.
    pub enum PictureMessage in "picture" {
        /// The command draws a picture and prints nothing else.
        NoFile error "no-file" ("the command has no file for the picture")
            hint ("name a file with --svg or --png");
        /// The extension of the file is that of another form of pictures. Other programs would not open the file.
        Form {
            /// The option without its dashes: `svg` or `png`.
            form: &'static str,
            extension: String,
            path: PathBuf,
        } error "form" ("--{form} cannot write the file {path}, because its name ends in .{extension}", path = path.display())
            advice (Some(match extension.as_str() {
                "svg" | "png" => format!("use --{extension} for this file"),
                _ => format!("name the file {}", path.with_extension(form).display()),
            }));
    }
}

homebody_core::messages! {
    /// Remarks on homes that Homebody has made from a plan or a log.
    pub enum NewHomeMessage in "new-home" {
        /// Homebody gives the resident of a new home an ordinary routine. The routine needs furniture, such as a bed and a toilet, that
        /// the resident can reach.
        RoutineLacks { lack: String } warning "routine-lacks" ("the ordinary routine cannot run yet: {lack}");
    }
}

homebody_core::messages! {
    /// Errors of `homebody explain`.
    pub enum ExplainMessage in "explain" {
        /// Messages have codes such as `log::exists`. No message has the code that was asked for.
        UnknownCode { code: String, nearest: Option<String> } error "unknown-code" ("no message has the code {code:?}")
            advice (Some(match nearest {
                Some(nearest) => format!("did you mean {nearest}?"),
                None => "homebody explain lists all codes".to_owned(),
            }));
        /// The experiments judge the claims of Homebody. They are a program of their own, which explains the codes of its messages:
        ///
        /// ```sh
        /// cargo run --release --package homebody-lab -- explain experiment::no-data
        /// ```
        OfExperiments { code: String } error "of-experiments"
            ("the program of the experiments explains the code {code:?}")
            hint ("in a clone of the repository, run `cargo run --release --package homebody-lab -- explain {code}`");
    }
}
