//! The speed of a run, and commands on standard input that change it.

use crate::failure::Failure;
use crate::print::tell_message;
use homebody_core::messages::Diagnose;
use homebody_core::problem::Diagnostic;
use homebody_log::error::no_thread;
use homebody_simulation::{pace::Pace, pace::RunCommand, pace::Speed};
use std::io::{self, BufRead, Read};
use std::sync::mpsc::{Receiver, sync_channel};
use std::thread;

/// The help of `--control`: as a doc comment, its brackets would be a link.
const CONTROL: &str = "Read commands from standard input, one per line: pause, resume, step [SECONDS], speed X, stop. \
    A command after a step waits until the step has ended; at the end of the input the run continues";

/// Longest line of a command (our choice).
const LONGEST_COMMAND_BYTES: usize = 200;

/// Most commands in the queue (our choice); a sender of more waits.
const MOST_WAITING: usize = 1000;

homebody_core::messages! {
    /// Problems with commands on standard input.
    #[derive(Clone, Copy, PartialEq, Eq)]
    pub enum ControlMessage in "control" {
        /// With `--control`, each line of standard input is one short command. Homebody skips longer lines.
        TooLong error "too-long" ("the command is longer than {LONGEST_COMMAND_BYTES} bytes")
            hint ("write one command per line: pause, resume, step [SECONDS], speed X, stop");
    }
}

/// The speed of a run, and its control.
#[derive(clap::Args)]
#[command(next_help_heading = "Speed")]
pub struct PaceArguments {
    /// Simulated seconds per real second: 0.1 to 1000, or max; the speed does not change the log
    #[arg(long, value_name = "FACTOR", default_value = "max")]
    speed: Speed,
    #[arg(long, help = CONTROL)]
    control: bool,
    /// Start paused, and wait for commands
    #[arg(long, requires = "control")]
    paused: bool,
}

impl PaceArguments {
    pub fn is_given(&self) -> bool {
        self.control || self.paused || self.speed != Speed::Max
    }

    pub fn pace(&self) -> Pace {
        if self.paused { Pace::paused(self.speed) } else { Pace::new(self.speed) }
    }

    /// The commands on standard input, with `--control`.
    pub fn commands(&self) -> Result<Option<Receiver<RunCommand>>, Failure> {
        if !self.control {
            return Ok(None);
        }
        let (sender, commands) = sync_channel(MOST_WAITING);
        let listen = move || {
            let mut input = std::io::stdin().lock();
            while let Ok(Some(line)) = next_line(&mut input) {
                match command(line) {
                    Ok(command) if sender.send(command).is_err() => break,
                    Ok(_) => {}
                    Err(message) => tell_message(&message),
                }
            }
        };
        let none = |error| Failure::file(no_thread("to take commands", error));
        thread::Builder::new().spawn(listen).map_err(none)?;
        Ok(Some(commands))
    }
}

fn command(line: Result<String, ControlMessage>) -> Result<RunCommand, Diagnostic> {
    line.map_err(|message| message.diagnostic())?.parse::<RunCommand>().map_err(Diagnostic::from)
}

/// The next line, or its problem; `None` at the end. Stores only the start of a line that is too long.
fn next_line(input: &mut impl BufRead) -> io::Result<Option<Result<String, ControlMessage>>> {
    let mut line = Vec::new();
    if input.take(LONGEST_COMMAND_BYTES as u64 + 1).read_until(b'\n', &mut line)? == 0 {
        return Ok(None);
    }
    if line.len() > LONGEST_COMMAND_BYTES && !line.ends_with(b"\n") {
        input.skip_until(b'\n')?;
        return Ok(Some(Err(ControlMessage::TooLong)));
    }
    Ok(Some(Ok(String::from_utf8_lossy(&line).trim_end().to_owned())))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn skips_an_endless_line_in_little_memory() {
        let endless = io::repeat(b'x').take(50_000_000).chain(&b"\nstop\n\xff\nlast"[..]);
        let mut input = io::BufReader::new(endless);
        let mut said = Vec::new();
        while let Some(line) = next_line(&mut input).unwrap() {
            said.push(line);
        }
        assert_eq!(said, [Err(ControlMessage::TooLong), Ok("stop".into()), Ok("\u{fffd}".into()), Ok("last".into())]);
        let longest = "x".repeat(LONGEST_COMMAND_BYTES) + "\nstop";
        let mut input = longest.as_bytes();
        assert_eq!(next_line(&mut input).unwrap(), Some(Ok("x".repeat(LONGEST_COMMAND_BYTES))));
        assert_eq!(next_line(&mut input).unwrap(), Some(Ok("stop".into())));
    }
}
