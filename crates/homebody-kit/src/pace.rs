//! Pace: how fast a run goes by the clock on the wall. It decides when a run is advanced, never how: the run knows nothing of
//! it, so the log has the same bytes at any pace.

use crate::outside::Asked;
use homebody_core::problem::readable;
use homebody_core::time::{Micros, SECOND, micros};
use homebody_log::Cancel;
use jiff::Timestamp;
use std::str::FromStr;
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::thread;
use std::time::{Duration, Instant};

/// How many seconds of the run go by in a second.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Speed {
    /// So many times as fast as life, from 0.1 to 1000.
    Times(f64),
    /// As fast as it goes.
    Max,
}

homebody_core::messages! {
    /// Problems with a speed, or with a command to a run.
    #[derive(Clone, PartialEq, Eq)]
    pub enum PaceMessage in "pace" {
        /// A run goes so many times as fast as the clock. `max` is as fast as the computer can simulate.
        Speed {
            /// The text.
            text: String,
        } error "speed" ("{text:?} is not a valid speed")
            hint ("write a number from 0.1 to 1000, or max");
        /// `step 2.5` continues a paused run by 2.5 seconds of its own time.
        Seconds {
            /// The text.
            text: String,
        } error "seconds" ("{text:?} is not a number of seconds")
            hint ("write a number above 0, such as step 10");
        /// With `--control`, the program reads commands from standard input, one a line.
        Command {
            /// The line.
            line: String,
        } error "command" ("there is no command {line:?}")
            hint ("the commands are pause, resume, step [SECONDS], speed X, stop");
    }
}

impl Speed {
    /// A number of times as fast as life; nothing where it is not from 0.1 to 1000.
    pub fn times(times: f64) -> Option<Speed> {
        (0.1..=1000.0).contains(&times).then_some(Speed::Times(times))
    }
}

impl FromStr for Speed {
    type Err = PaceMessage;

    fn from_str(text: &str) -> Result<Speed, PaceMessage> {
        if text == "max" {
            return Ok(Speed::Max);
        }
        let speed = text.parse().ok().and_then(Speed::times);
        speed.ok_or_else(|| PaceMessage::Speed { text: readable(text.to_owned()) })
    }
}

/// What somebody who watches a run may ask of it. As text: `pause`, `resume`, `step [SECONDS]`, `speed X`, `stop`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Command {
    /// Go no further.
    Pause,
    /// Go on.
    Resume,
    /// Go on by so many microseconds, then pause.
    Step(Micros),
    /// Go on at this speed.
    Speed(Speed),
    /// End the run here.
    Stop,
}

impl FromStr for Command {
    type Err = PaceMessage;

    fn from_str(line: &str) -> Result<Command, PaceMessage> {
        let words: Vec<&str> = line.split_whitespace().collect();
        match words[..] {
            ["pause"] => Ok(Command::Pause),
            ["resume"] => Ok(Command::Resume),
            ["stop"] => Ok(Command::Stop),
            ["step"] => Ok(Command::Step(SECOND)),
            ["step", span] => match span.parse::<f64>() {
                Ok(span) if span > 0.0 && span < 1e9 => Ok(Command::Step(micros(span))),
                _ => Err(PaceMessage::Seconds { text: readable(span.to_owned()) }),
            },
            ["speed", speed] => speed.parse().map(Command::Speed),
            _ => Err(PaceMessage::Command { line: readable(line.to_owned()) }),
        }
    }
}

/// How far a run may go by now. All instants are microseconds since the run's start.
#[derive(Clone, Debug)]
pub struct Pace {
    speed: Speed,
    /// Where the run was, and when, at the last change of pace.
    from: (Micros, Instant),
    /// It goes no further than this.
    holds_at: Option<Micros>,
    /// Up to here it goes as fast as it can, whatever its speed.
    hurries_to: Option<Micros>,
    /// The instant of the world at which the run starts, in microseconds since 1970: it is where the world's clock is.
    on_wall: Option<i64>,
}

impl Default for Pace {
    /// As fast as it goes.
    fn default() -> Pace {
        Pace::new(Speed::Max)
    }
}

impl Pace {
    /// From the run's start at this speed.
    pub fn new(speed: Speed) -> Pace {
        Pace { speed, from: (0, Instant::now()), holds_at: None, hurries_to: None, on_wall: None }
    }

    /// The run is where the world's clock is, whose instant `start` is the run's start. What is behind, it catches up with as
    /// fast as it can.
    pub fn on_wall(start: Timestamp) -> Pace {
        Pace { on_wall: Some(start.as_microsecond()), ..Pace::new(Speed::Times(1.0)) }
    }

    /// At this speed, once somebody says so.
    pub fn paused(speed: Speed) -> Pace {
        Pace { holds_at: Some(0), ..Pace::new(speed) }
    }

    /// The speed at which the run goes while it is not paused.
    pub fn speed(&self) -> Speed {
        self.speed
    }

    /// How far the run may go by now: [`Micros::MAX`] where nothing holds it.
    pub fn due(&self) -> Micros {
        let (begin, since) = self.from;
        let due = match (self.hurries_to, self.on_wall, self.speed) {
            (Some(to), ..) => to,
            (None, Some(start), _) => Timestamp::now().as_microsecond() - start,
            (None, None, Speed::Max) => Micros::MAX,
            (None, None, Speed::Times(times)) => {
                begin.saturating_add((since.elapsed().as_secs_f64() * times * SECOND as f64) as Micros)
            }
        };
        due.min(self.holds_at.unwrap_or(Micros::MAX))
    }

    /// Whether a run that has come to `now` goes no further until somebody says so.
    pub fn is_paused(&self, now: Micros) -> bool {
        self.holds_at.is_some_and(|at| now >= at)
    }

    /// Whether a run that has come to `now` goes as fast as it can.
    pub fn hurries(&self, now: Micros) -> bool {
        self.speed == Speed::Max || self.is_jumping(now)
    }

    /// Whether a run that has come to `now` is on its way to where a jump ends.
    pub fn is_jumping(&self, now: Micros) -> bool {
        self.hurries_to.is_some_and(|to| now < to)
    }

    /// Whether a run that has come to `now` is on its way to where it is going to pause.
    fn is_stepping(&self, now: Micros) -> bool {
        self.holds_at.is_some_and(|at| now < at)
    }

    /// The clock counts from here, where the run is `now`.
    pub fn count_from(&mut self, now: Micros) {
        self.from = (now, Instant::now());
    }

    /// The run, which is at `now`, goes no further.
    pub fn pause(&mut self, now: Micros) {
        self.count_from(now);
        (self.holds_at, self.hurries_to) = (Some(now), None);
    }

    /// The run, which is at `now`, goes on.
    pub fn resume(&mut self, now: Micros) {
        self.count_from(now);
        self.holds_at = None;
    }

    /// The run, which is at `now`, goes on by `span` at its speed, then pauses.
    pub fn step(&mut self, now: Micros, span: Micros) {
        self.count_from(now);
        self.holds_at = Some(now.saturating_add(span));
    }

    /// The run, which is at `now`, goes to an instant as fast as it can; there it pauses, or goes on at its speed.
    pub fn jump(&mut self, now: Micros, to: Micros, pauses_there: bool) {
        self.hurries_to = (to > now).then_some(to);
        self.holds_at = pauses_there.then_some(to);
    }

    /// The run has come to `now`: where a jump ends, the clock begins to count again.
    pub fn arrive(&mut self, now: Micros) {
        if self.hurries_to.is_some_and(|to| now >= to) {
            self.hurries_to = None;
            self.count_from(now);
        }
    }

    /// The run, which is at `now`, goes at this speed.
    pub fn set_speed(&mut self, now: Micros, speed: Speed) {
        self.count_from(now);
        self.speed = speed;
    }
}

/// How often a paced run is advanced.
const FRAME: Duration = Duration::from_millis(16);

/// Lag behind the world's clock at which a run hurries (our choice).
const BEHIND: Micros = SECOND;

/// Number of commands to a run between two checks of the clock (our choice). The others wait.
const AT_ONCE: usize = 100;

/// Keeps a run at its pace: waits, and does what is said meanwhile.
pub(crate) struct Paced {
    pace: Pace,
    cancel: Cancel,
    commands: Option<Receiver<Command>>,
    /// What comes from afar: when nobody is left to say anything, the run goes on as it does.
    from_afar: Vec<Receiver<Command>>,
    /// Whether it goes no faster than life, whatever it is told.
    keeps_to_life: bool,
    /// What is asked to be done to the run.
    pub(crate) outside: Vec<Receiver<Asked>>,
}

impl Paced {
    pub fn new(pace: Pace, cancel: Cancel, commands: Option<Receiver<Command>>) -> Paced {
        Paced { pace, cancel, commands, from_afar: Vec::new(), keeps_to_life: false, outside: Vec::new() }
    }

    /// Does what is said there, too.
    #[cfg_attr(not(feature = "mqtt"), allow(dead_code, reason = "brokers say it"))]
    pub fn hear(&mut self, commands: Receiver<Command>) {
        self.from_afar.push(commands);
    }

    /// What stops the run.
    pub fn cancel(&self) -> &Cancel {
        &self.cancel
    }

    /// Whether the run shall stop.
    pub fn is_cancelled(&self) -> bool {
        self.cancel.is_cancelled()
    }

    /// What was asked to be done to the run by now.
    pub fn asked(&self) -> Vec<Asked> {
        self.outside.iter().flat_map(|asked| asked.try_iter()).take(AT_ONCE).collect()
    }

    /// Whether it has to catch up with the world's clock.
    pub fn is_behind(&self, now: Micros) -> bool {
        self.pace.on_wall.is_some() && self.pace.due().saturating_sub(now) > BEHIND
    }

    /// Whether it goes no faster than life by now.
    #[cfg_attr(not(feature = "mqtt"), allow(dead_code, reason = "brokers ask"))]
    pub fn is_no_faster_than_life(&self) -> bool {
        matches!(self.pace.speed, Speed::Times(times) if times <= 1.0)
    }

    /// From now on no command makes it faster than life: that it goes at the pace of life is what comes of a higher speed.
    #[cfg_attr(not(feature = "mqtt"), allow(dead_code, reason = "brokers want it"))]
    pub fn keep_to_life(&mut self) {
        self.keeps_to_life = true;
    }

    /// Waits a moment, and says until when the run may go on: until `now` if it is paused. Nothing if it shall stop.
    pub fn next(&mut self, now: Micros) -> Option<Micros> {
        while !self.cancel.is_cancelled() {
            let until = self.pace.due();
            let hurries = self.pace.speed == Speed::Max || self.is_behind(now);
            let wait = if until > now && hurries { Duration::ZERO } else { FRAME };
            match self.heard(wait, now) {
                Some(Command::Stop) => break,
                Some(command) => self.obey(command, now),
                None => return Some(until.max(now)),
            }
        }
        None
    }

    fn heard(&mut self, wait: Duration, now: Micros) -> Option<Command> {
        if !self.pace.is_stepping(now)
            && let Some(command) = self.from_afar.iter().find_map(|commands| commands.try_recv().ok())
        {
            return Some(command);
        }
        let Some(commands) = self.commands.as_ref().filter(|_| !self.pace.is_stepping(now)) else {
            thread::sleep(wait);
            return None;
        };
        match commands.recv_timeout(wait) {
            Ok(command) => Some(command),
            Err(RecvTimeoutError::Timeout) => None,
            Err(RecvTimeoutError::Disconnected) => {
                // Nobody is left to say resume.
                self.commands = None;
                Some(Command::Resume)
            }
        }
    }

    fn obey(&mut self, command: Command, now: Micros) {
        match command {
            Command::Pause => self.pace.pause(now),
            Command::Resume => self.pace.resume(now),
            Command::Step(span) => self.pace.step(now, span),
            Command::Speed(speed) => {
                let is_too_fast = self.keeps_to_life && !matches!(speed, Speed::Times(times) if times <= 1.0);
                self.pace.set_speed(now, if is_too_fast { Speed::Times(1.0) } else { speed });
            }
            Command::Stop => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::mpsc::channel;

    #[test]
    fn a_step_ends_where_it_was_asked_to_and_a_jump_hurries_there() {
        let mut pace = Pace::paused(Speed::Times(0.1));
        assert_eq!((pace.due(), pace.is_paused(0)), (0, true));
        pace.jump(0, 90 * SECOND, true);
        assert_eq!((pace.due(), pace.is_paused(0), pace.hurries(0)), (90 * SECOND, false, true));
        pace.arrive(90 * SECOND);
        assert!(pace.is_paused(90 * SECOND) && !pace.hurries(90 * SECOND));
        pace.step(90 * SECOND, SECOND);
        assert!(!pace.is_paused(90 * SECOND) && pace.due() < 91 * SECOND, "a step goes at its speed");
        pace.set_speed(90 * SECOND, Speed::Max);
        assert_eq!(pace.due(), 91 * SECOND);
        pace.jump(91 * SECOND, 91 * SECOND, true);
        assert!(pace.is_paused(91 * SECOND), "a jump to where it is takes no time");
        pace.resume(91 * SECOND);
        assert_eq!(pace.due(), Micros::MAX);
    }

    #[test]
    fn a_run_on_the_worlds_clock_is_where_that_is() {
        let hours = |hours| jiff::SignedDuration::from_hours(hours);
        let behind = Pace::on_wall(Timestamp::now() - hours(3));
        assert!((10_800 * SECOND..10_860 * SECOND).contains(&behind.due()));
        let mut paced = Paced::new(behind, Cancel::new(), None);
        let begun = Instant::now();
        assert!((0..1000).all(|_| paced.next(0).is_some_and(|until| until >= 10_800 * SECOND)));
        assert!(begun.elapsed() < 1000 * FRAME / 2, "it hurries while it is behind");
        let early = Pace::on_wall(Timestamp::now() + hours(1));
        assert!(early.due() < 0);
        assert_eq!(Paced::new(early, Cancel::new(), None).next(0), Some(0), "one that starts later waits");
    }

    #[test]
    fn quotes_an_unknown_command_in_part() {
        let why = |line: &str| line.parse::<Command>().unwrap_err().to_string();
        let hint = "the commands are pause, resume, step [SECONDS], speed X, stop";
        assert_eq!(why("halt"), format!("there is no command \"halt\"\n  hint: {hint}"));
        assert!(why(&"x".repeat(1 << 20)).len() < 1000);
        assert!(why(&format!("step {}", "9".repeat(1 << 20))).len() < 1000);
    }

    #[test]
    fn commands_are_done_in_order_and_a_run_goes_on_when_nobody_is_left_to_say_so() {
        let (say, commands) = channel();
        let mut paced = Paced::new(Pace::paused(Speed::Max), Cancel::new(), Some(commands));
        assert_eq!(paced.next(0), Some(0));
        say.send(Command::Step(60 * SECOND)).unwrap();
        assert_eq!(paced.next(0), Some(60 * SECOND));
        drop(say);
        assert_eq!(paced.next(60 * SECOND), Some(Micros::MAX));
        paced.cancel.cancel();
        assert_eq!(paced.next(60 * SECOND), None);
    }

    #[test]
    fn a_run_that_keeps_to_life_is_made_no_faster_and_hears_from_afar() {
        let (say, afar) = channel();
        let mut paced = Paced::new(Pace::new(Speed::Times(1.0)), Cancel::new(), None);
        assert!(paced.is_no_faster_than_life());
        paced.hear(afar);
        paced.keep_to_life();
        for (said, speed) in [("speed max", 1.0), ("speed 0.5", 0.5), ("speed 2", 1.0)] {
            say.send(said.parse().unwrap()).unwrap();
            assert!(paced.next(0).unwrap() < SECOND);
            assert_eq!(paced.pace.speed(), Speed::Times(speed), "{said}");
        }
        say.send(Command::Pause).unwrap();
        assert_eq!(paced.next(0), Some(0));
        drop(say);
        assert_eq!(paced.next(0), Some(0), "whoever is afar and falls silent has not said to go on");
        assert!(!Paced::new(Pace::default(), Cancel::new(), None).is_no_faster_than_life());
    }

    #[test]
    fn a_command_is_understood_as_it_is_written() {
        assert_eq!("step".parse(), Ok(Command::Step(SECOND)));
        assert_eq!("step 1.5".parse(), Ok(Command::Step(1_500_000)));
        assert_eq!("speed max".parse(), Ok(Command::Speed(Speed::Max)));
        for wrong in ["", "steps", "step -1", "step x", "speed 0", "speed 1001", "pause now"] {
            assert!(wrong.parse::<Command>().is_err(), "{wrong}");
        }
    }
}
