//! A log that a command is given, and what is remarked on it.

use super::convert::tell_remarks;
use crate::failure::Failure;
use crate::print::tell;
use homebody_kit::LogWithRun;
use homebody_log::source::Clock;

/// Reads a log on the clock on the wall of its home, and tells what is left out of it.
pub fn read_log(text: &str, zone: Option<&str>) -> Result<LogWithRun, Failure> {
    let read = LogWithRun::read(text, zone)?;
    tell_remarks(text, &read.log);
    if read.log.skipped > 0 {
        tell(format_args!("{text}: {} lines were left out; homebody convert says which", read.log.skipped));
    }
    if read.log.clock == Clock::Utc {
        tell(format_args!("{text}: its hours are those of UTC; --time-zone tells the home's own"));
    }
    Ok(read)
}
