//! The program `homebody`: all of it is in the library beside.

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(homebody::run(std::env::args_os().collect()))
}
