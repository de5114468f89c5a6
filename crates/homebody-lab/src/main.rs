//! The program `homebody-lab`: its experiments are in the library.

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(homebody_lab::run(std::env::args_os().collect()))
}
