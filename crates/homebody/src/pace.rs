//! Pace: how fast a run goes by the clock on the wall. It decides when the run is advanced, never how:
//! the world knows nothing of it.

use crate::print::tell;
use homebody_core::time::{Micros, SECOND};
use std::io::BufRead;
use std::str::FromStr;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::thread;
use std::time::{Duration, Instant};

/// How many seconds of the run go by in a second.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Speed {
    Times(f64),
    Max,
}

impl FromStr for Speed {
    type Err = String;

    fn from_str(text: &str) -> Result<Speed, String> {
        if text == "max" {
            return Ok(Speed::Max);
        }
        match text.parse() {
            Ok(times) if (0.1..=1000.0).contains(&times) => Ok(Speed::Times(times)),
            _ => Err("a speed is a number from 0.1 to 1000, or max".into()),
        }
    }
}

/// What somebody who watches a run may say, a line each.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Say {
    Pause,
    Resume,
    /// Go on by so much, then pause.
    Step(Micros),
    Speed(Speed),
    Stop,
}

impl FromStr for Say {
    type Err = String;

    fn from_str(line: &str) -> Result<Say, String> {
        let words: Vec<&str> = line.split_whitespace().collect();
        match words[..] {
            ["pause"] => Ok(Say::Pause),
            ["resume"] => Ok(Say::Resume),
            ["stop"] => Ok(Say::Stop),
            ["step"] => Ok(Say::Step(SECOND)),
            ["step", span] => match span.parse::<f64>() {
                Ok(span) if span > 0.0 && span < 1e9 => Ok(Say::Step(homebody_core::time::micros(span))),
                _ => Err(format!("{span:?} is no number of seconds")),
            },
            ["speed", speed] => speed.parse().map(Say::Speed),
            _ => Err(format!("{line:?} is none of: pause, resume, step [SECONDS], speed X, stop")),
        }
    }
}

/// How fast a run goes, and who may change that.
#[derive(clap::Args)]
pub struct Asked {
    /// Seconds of the run in a second: 0.1 to 1000, or max. It changes no byte of the log
    #[arg(long, default_value = "max")]
    speed: Speed,
    /// Take commands by lines on standard input: pause, resume, step [SECONDS], speed X, stop.
    /// Each waits until a step before it is done; when the lines end, the run goes on
    #[arg(long)]
    control: bool,
    /// Begin paused, and wait for commands
    #[arg(long, requires = "control")]
    paused: bool,
}

impl Asked {
    /// As fast as it goes.
    pub fn unpaced() -> Asked {
        Asked { speed: Speed::Max, control: false, paused: false }
    }
}

/// Lets a run go at its pace.
pub struct Pace {
    speed: Speed,
    /// Ends the run when set.
    stop: Arc<AtomicBool>,
    /// Where the run was, and when, at the last change of pace.
    from: (Micros, Instant),
    /// A paused run goes no further than this.
    paused_at: Option<Micros>,
    listener: Option<Receiver<Say>>,
}

/// The most of a run that is advanced at once, so that its events need little memory.
const STEP: Micros = 3600 * SECOND;

/// How often a paced run is advanced.
const FRAME: Duration = Duration::from_millis(16);

impl Pace {
    /// A pace from the run's start, until `stop` is set.
    pub fn new(asked: &Asked, stop: Arc<AtomicBool>) -> Pace {
        let listener = asked.control.then(|| {
            let (sender, listener) = channel();
            thread::spawn(move || {
                for line in std::io::stdin().lock().split(b'\n').map_while(Result::ok) {
                    match String::from_utf8_lossy(&line).trim_end().parse() {
                        Ok(say) if sender.send(say).is_err() => break,
                        Ok(_) => {}
                        Err(error) => tell(error),
                    }
                }
            });
            listener
        });
        let paused_at = asked.paused.then_some(0);
        Pace { speed: asked.speed, stop, from: (0, Instant::now()), paused_at, listener }
    }

    /// Waits a moment, and says until when the run may go on: until `now` if it is paused. Nothing if it shall stop.
    pub fn next(&mut self, now: Micros) -> Option<Micros> {
        while !self.stop.load(Ordering::Relaxed) {
            let until = self.allowed(now);
            let wait = if until > now && self.speed == Speed::Max { Duration::ZERO } else { FRAME };
            match self.heard(wait, now) {
                Some(Say::Stop) => break,
                Some(say) => self.obey(say, now),
                None => return Some(until.max(now)),
            }
        }
        None
    }

    /// How far the run may go by now.
    fn allowed(&self, now: Micros) -> Micros {
        let (begin, since) = self.from;
        let most = now + STEP;
        let until = match self.speed {
            Speed::Max => most,
            Speed::Times(times) => begin + (since.elapsed().as_secs_f64() * times * SECOND as f64) as Micros,
        };
        until.min(most).min(self.paused_at.unwrap_or(most))
    }

    fn heard(&mut self, wait: Duration, now: Micros) -> Option<Say> {
        let stepping = self.paused_at.is_some_and(|paused_at| now < paused_at);
        let Some(listener) = self.listener.as_ref().filter(|_| !stepping) else {
            thread::sleep(wait);
            return None;
        };
        match listener.recv_timeout(wait) {
            Ok(say) => Some(say),
            Err(RecvTimeoutError::Timeout) => None,
            Err(RecvTimeoutError::Disconnected) => {
                // Nobody is left to say resume.
                self.listener = None;
                Some(Say::Resume)
            }
        }
    }

    fn obey(&mut self, say: Say, now: Micros) {
        self.from = (now, Instant::now());
        match say {
            Say::Pause => self.paused_at = Some(now),
            Say::Resume => self.paused_at = None,
            Say::Step(span) => self.paused_at = Some(now + span),
            Say::Speed(speed) => self.speed = speed,
            Say::Stop => {}
        }
    }
}
