//! How fast a run is asked to go, and who may change that by lines on standard input.

use crate::failure::Failure;
use crate::print::tell;
use homebody_kit::pace::{Command, Pace, Speed};
use homebody_log::error::no_thread;
use std::io::BufRead;
use std::sync::mpsc::{Receiver, channel};
use std::thread;

/// The help of `--control`: as a doc comment, its brackets would be a link.
const CONTROL: &str = "Take commands by lines on standard input: pause, resume, step [SECONDS], speed X, stop. \
    Each waits until a step before it is done; when the lines end, the run goes on";

/// How fast a run goes, and who may change that.
#[derive(clap::Args)]
pub struct Asked {
    /// Seconds of the run in a second: 0.1 to 1000, or max. It changes no byte of the log
    #[arg(long, default_value = "max")]
    speed: Speed,
    #[arg(long, help = CONTROL)]
    control: bool,
    /// Begin paused, and wait for commands
    #[arg(long, requires = "control")]
    paused: bool,
}

impl Asked {
    /// Whether anything but as fast as it can is asked for.
    pub fn is_said(&self) -> bool {
        self.control || self.speed != Speed::Max
    }

    pub fn pace(&self) -> Pace {
        if self.paused { Pace::paused(self.speed) } else { Pace::new(self.speed) }
    }

    /// The commands that come by lines, if any may.
    pub fn commands(&self) -> Result<Option<Receiver<Command>>, Failure> {
        if !self.control {
            return Ok(None);
        }
        let (sender, commands) = channel();
        let listen = move || {
            for line in std::io::stdin().lock().split(b'\n').map_while(Result::ok) {
                match String::from_utf8_lossy(&line).trim_end().parse() {
                    Ok(command) if sender.send(command).is_err() => break,
                    Ok(_) => {}
                    Err(error) => tell(error),
                }
            }
        };
        let none = |error| Failure::Io(no_thread("to take commands", error));
        thread::Builder::new().spawn(listen).map_err(none)?;
        Ok(Some(commands))
    }
}
