//! The process that does the cases, and tells the one that watches it.
//!
//! It says a line as each case begins and one as it ends, so that whoever reads knows which one it died of.

use crate::case::{self, Done, End};
use crate::memory::Memory;
use crate::target::Target;
use serde_json::{Value, json};
use std::io::Write;
use std::time::Duration;
use std::{io, process, thread};

/// Memory above which a case is ended at once, to protect the machine (our choice).
const MOST_BYTES: usize = 1 << 30;

/// The cases of a worker: from the first on, every so many, up to the last.
#[derive(Clone, Copy, Debug)]
pub struct Share {
    /// The seed of all cases.
    pub seed: u64,
    /// The number of the first.
    pub first: u64,
    /// How far the next one is.
    pub step: u64,
    /// None of this number or beyond is done.
    pub end: u64,
}

/// What a worker says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Said {
    /// A case begins.
    Begun(u64),
    /// It has ended.
    Done(u64, Done),
}

/// Does a share of a target's cases.
///
/// # Errors
///
/// Nobody listens any more.
pub fn work(target: &Target, share: Share) -> io::Result<()> {
    case::keep_panics();
    let whole = Memory::begin();
    thread::spawn(move || {
        while whole.now_bytes() < MOST_BYTES {
            thread::sleep(Duration::from_millis(5));
        }
        process::exit(GREEDY);
    });
    let target = *target;
    // A thread as those of the program are, whose stack is smaller than the first one's.
    let done = thread::spawn(move || {
        let corpus = (target.corpus)();
        for number in (share.first..share.end).step_by(share.step as usize) {
            tell(&Said::Begun(number))?;
            let files = target.case(&corpus, share.seed, number);
            tell(&Said::Done(number, case::run(&target, &files)))?;
        }
        Ok(())
    });
    done.join().unwrap_or_else(|_| Err(io::Error::other("a mutator panicked")))
}

/// The exit code of a worker whose case takes too much memory.
pub const GREEDY: i32 = 86;

fn tell(said: &Said) -> io::Result<()> {
    let mut out = io::stdout().lock();
    writeln!(out, "{}", said.line())?;
    out.flush()
}

impl Said {
    fn line(&self) -> Value {
        match self {
            Said::Begun(number) => json!({ "begun": number }),
            Said::Done(number, Done { end, took, peak_bytes }) => {
                let (end, why) = match end {
                    End::Accepted => ("accepted", ""),
                    End::Refused => ("refused", ""),
                    End::Failed(why) => ("failed", why.as_str()),
                };
                json!({ "done": number, "end": end, "why": why, "us": took.as_micros() as u64, "peak_bytes": peak_bytes })
            }
        }
    }

    /// What a line says; None where a worker would not say so.
    pub fn of(line: &str) -> Option<Said> {
        let said: Value = serde_json::from_str(line).ok()?;
        if let Some(number) = said["begun"].as_u64() {
            return Some(Said::Begun(number));
        }
        let end = match said["end"].as_str()? {
            "accepted" => End::Accepted,
            "refused" => End::Refused,
            _ => End::Failed(said["why"].as_str()?.to_owned()),
        };
        let took = Duration::from_micros(said["us"].as_u64()?);
        Some(Said::Done(said["done"].as_u64()?, Done { end, took, peak_bytes: said["peak_bytes"].as_u64()? as usize }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_said_is_understood() {
        let done = |end| Done { end, took: Duration::from_micros(1234), peak_bytes: 77 };
        for said in [
            Said::Begun(3),
            Said::Done(3, done(End::Accepted)),
            Said::Done(4, done(End::Refused)),
            Said::Done(5, done(End::Failed("a \"panic\"\nof two lines".into()))),
        ] {
            assert_eq!(Said::of(&said.line().to_string()), Some(said));
        }
        assert_eq!(Said::of("thread panicked"), None);
    }
}
