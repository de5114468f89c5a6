//! The program `homebody`, which is in the library.

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(homebody::run(std::env::args_os().collect()))
}
