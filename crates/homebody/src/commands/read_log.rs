//! A log that a command is given, and what is remarked on it.

use super::convert::tell_remarks;
use crate::failure::Failure;
use crate::print::tell;
use homebody_kit::{LogWithRun, Unended};
use homebody_log::source::Clock;

/// Reads a log on the clock on the wall of its home, and tells what is left out of it.
pub fn read_log(text: &str, zone: Option<&str>) -> Result<LogWithRun, Failure> {
    let read = LogWithRun::read(text, zone)?;
    tell_remarks(text, &read.log);
    if read.log.skipped > 0 {
        tell(format_args!("{text}: {} lines were left out; homebody convert says which", read.log.skipped));
    }
    tell_unfinished(text, read.unfinished.as_ref());
    if read.log.clock == Clock::Utc {
        tell(format_args!("{text}: its hours are those of UTC; --time-zone tells the home's own"));
    }
    Ok(read)
}

/// Warns of a run that was not lived to its end, so that its log is a part of what it is going to be.
pub fn tell_unfinished(text: &str, unfinished: Option<&Unended>) {
    if let Some(run) = unfinished {
        tell(format_args!("warning: {text}: its run has not come to its end\n  hint: {}", go_on(run)));
    }
}

/// How a run comes to its end.
pub fn go_on(run: &Unended) -> String {
    format!("homebody run --resume {} goes on with it", run.folder.display())
}
