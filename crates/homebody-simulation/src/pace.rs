//! The pace of a run: its speed against real time. It decides when a run is advanced, never how, so the log has the same bytes at any
//! pace.

use crate::interventions::InterventionRequest;
use homebody_core::problem::readable;
use homebody_core::time::{RunTime, SECOND, Span, UtcTime};
use homebody_log::Cancel;
use jiff::Timestamp;
use std::str::FromStr;
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::thread;
use std::time::{Duration, Instant};

/// The seconds of the run in a second of real time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Speed {
    /// A factor of real time, from 0.1 to 1000.
    Times(f64),
    /// As fast as possible.
    Max,
}

homebody_core::messages! {
    /// Problems with a speed, or with a command to a run.
    #[derive(Clone, PartialEq, Eq)]
    pub enum PaceMessage in "pace" {
        /// A run goes so many times as fast as the clock. `max` is as fast as the computer can simulate.
        Speed { text: String } error "speed" ("{text:?} is not a valid speed")
            hint ("write a number from 0.1 to 1000, or max");
        /// `step 2.5` continues a paused run by 2.5 seconds of its own time.
        Seconds { text: String } error "seconds" ("{text:?} is not a number of seconds")
            hint ("write a number above 0, such as step 10");
        /// With `--control`, the program reads commands from standard input, one a line.
        RunCommand { line: String } error "command" ("there is no command {line:?}")
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

/// A command to a run. As text: `pause`, `resume`, `step [SECONDS]`, `speed X`, `stop`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RunCommand {
    /// Pause the run.
    Pause,
    /// Resume the run.
    Resume,
    /// Continue by this span, then pause.
    Step(Span),
    /// Continue at this speed.
    Speed(Speed),
    /// End the run here.
    Stop,
}

impl FromStr for RunCommand {
    type Err = PaceMessage;

    fn from_str(line: &str) -> Result<RunCommand, PaceMessage> {
        let words: Vec<&str> = line.split_whitespace().collect();
        match words[..] {
            ["pause"] => Ok(RunCommand::Pause),
            ["resume"] => Ok(RunCommand::Resume),
            ["stop"] => Ok(RunCommand::Stop),
            ["step"] => Ok(RunCommand::Step(SECOND)),
            ["step", span] => match span.parse::<f64>() {
                Ok(span) if span > 0.0 && span < 1e9 => Ok(RunCommand::Step(Span::from_seconds(span))),
                _ => Err(PaceMessage::Seconds { text: readable(span.to_owned()) }),
            },
            ["speed", speed] => speed.parse().map(RunCommand::Speed),
            _ => Err(PaceMessage::RunCommand { line: readable(line.to_owned()) }),
        }
    }
}

/// The pace of a run: how far it may go by now.
#[derive(Clone, Debug)]
pub struct Pace {
    speed: Speed,
    from: (RunTime, Instant),
    /// The instant of the next pause.
    pauses_at: Option<RunTime>,
    /// The end of a jump: the run is as fast as possible before it.
    jumps_to: Option<RunTime>,
    /// The real time of the start of a run in real time.
    on_wall: Option<UtcTime>,
}

impl Default for Pace {
    /// As fast as possible.
    fn default() -> Pace {
        Pace::new(Speed::Max)
    }
}

impl Pace {
    /// From the run's start at this speed.
    pub fn new(speed: Speed) -> Pace {
        Pace { speed, from: (RunTime::START, Instant::now()), pauses_at: None, jumps_to: None, on_wall: None }
    }

    /// Real time, with the start of the run at `start`. A run that is behind catches up as fast as possible.
    pub fn on_wall(start: Timestamp) -> Pace {
        Pace { on_wall: Some(start.into()), ..Pace::new(Speed::Times(1.0)) }
    }

    /// Paused, and then at this speed.
    pub fn paused(speed: Speed) -> Pace {
        Pace { pauses_at: Some(RunTime::START), ..Pace::new(speed) }
    }

    /// The speed between pauses.
    pub fn speed(&self) -> Speed {
        self.speed
    }

    /// The latest instant that the run may reach by now: [`RunTime::MAX`] without a limit.
    pub fn due(&self) -> RunTime {
        let (begin, since) = self.from;
        let due = match (self.jumps_to, self.on_wall, self.speed) {
            (Some(to), ..) => to,
            (None, Some(start), _) => RunTime::START + (UtcTime::from(Timestamp::now()) - start),
            (None, None, Speed::Max) => RunTime::MAX,
            (None, None, Speed::Times(times)) => {
                let micros = since.elapsed().as_secs_f64() * times * SECOND.micros() as f64;
                begin.saturating_add(Span::from_micros(micros as i64))
            }
        };
        due.min(self.pauses_at.unwrap_or(RunTime::MAX))
    }

    /// Whether a run at `now` is paused.
    pub fn is_paused(&self, now: RunTime) -> bool {
        self.pauses_at.is_some_and(|at| now >= at)
    }

    /// Whether a run at `now` is as fast as possible.
    pub fn hurries(&self, now: RunTime) -> bool {
        self.speed == Speed::Max || self.is_jumping(now)
    }

    /// Whether a run at `now` is in a jump.
    pub fn is_jumping(&self, now: RunTime) -> bool {
        self.jumps_to.is_some_and(|to| now < to)
    }

    /// Whether a run at `now` has a pause ahead.
    fn is_stepping(&self, now: RunTime) -> bool {
        self.pauses_at.is_some_and(|at| now < at)
    }

    /// The clock counts from here, where the run is `now`.
    pub fn count_from(&mut self, now: RunTime) {
        self.from = (now, Instant::now());
    }

    /// The run, which is at `now`, goes no further.
    pub fn pause(&mut self, now: RunTime) {
        self.count_from(now);
        (self.pauses_at, self.jumps_to) = (Some(now), None);
    }

    /// Resumes the run, which is at `now`.
    pub fn resume(&mut self, now: RunTime) {
        self.count_from(now);
        self.pauses_at = None;
    }

    /// Continues the run, which is at `now`, by `span` at its speed, and then pauses it.
    pub fn step(&mut self, now: RunTime, span: Span) {
        self.count_from(now);
        self.pauses_at = Some(now.saturating_add(span));
    }

    /// Moves the run, which is at `now`, to an instant as fast as possible; there it pauses, or continues at its speed.
    pub fn jump(&mut self, now: RunTime, to: RunTime, pauses_there: bool) {
        self.jumps_to = (to > now).then_some(to);
        self.pauses_at = pauses_there.then_some(to);
    }

    /// The run has come to `now`: where a jump ends, the clock begins to count again.
    pub fn arrive(&mut self, now: RunTime) {
        if self.jumps_to.is_some_and(|to| now >= to) {
            self.jumps_to = None;
            self.count_from(now);
        }
    }

    /// The run, which is at `now`, goes at this speed.
    pub fn set_speed(&mut self, now: RunTime, speed: Speed) {
        self.count_from(now);
        self.speed = speed;
    }
}

/// The interval between the steps of a paced run.
const FRAME: Duration = Duration::from_millis(16);

/// Lag behind real time at which a run is as fast as possible (our choice).
const BEHIND: Span = SECOND;

/// Number of commands to a run between two checks of the clock (our choice). The others wait.
const AT_ONCE: usize = 100;

pub(crate) struct PaceKeeper {
    pace: Pace,
    cancel: Cancel,
    commands: Option<Receiver<RunCommand>>,
    /// The commands of brokers. When such a channel is closed, the pace stays.
    remote_commands: Vec<Receiver<RunCommand>>,
    /// Limits the speed to real time, whatever the commands.
    is_limited: bool,
    /// The requested interventions.
    pub(crate) interventions: Vec<Receiver<InterventionRequest>>,
}

impl PaceKeeper {
    pub fn new(pace: Pace, cancel: Cancel, commands: Option<Receiver<RunCommand>>) -> PaceKeeper {
        PaceKeeper { pace, cancel, commands, remote_commands: Vec::new(), is_limited: false, interventions: Vec::new() }
    }

    /// Obeys the commands of a broker, too.
    #[cfg_attr(not(feature = "mqtt"), allow(dead_code, reason = "for brokers"))]
    pub fn add_commands(&mut self, commands: Receiver<RunCommand>) {
        self.remote_commands.push(commands);
    }

    /// The handle that ends the run.
    pub fn cancel(&self) -> &Cancel {
        &self.cancel
    }

    pub fn is_cancelled(&self) -> bool {
        self.cancel.is_cancelled()
    }

    /// The interventions that were requested by now.
    pub fn requests(&self) -> Vec<InterventionRequest> {
        self.interventions.iter().flat_map(|requests| requests.try_iter()).take(AT_ONCE).collect()
    }

    /// Whether a run at `now` is behind real time.
    pub fn is_behind(&self, now: RunTime) -> bool {
        self.pace.on_wall.is_some() && self.pace.due().saturating_since(now) > BEHIND
    }

    /// Whether the speed is at most real time.
    #[cfg_attr(not(feature = "mqtt"), allow(dead_code, reason = "for brokers"))]
    pub fn is_at_most_real_time(&self) -> bool {
        matches!(self.pace.speed, Speed::Times(times) if times <= 1.0)
    }

    /// Limits the speed to real time from now on: a higher speed becomes real time.
    #[cfg_attr(not(feature = "mqtt"), allow(dead_code, reason = "for brokers"))]
    pub fn limit_to_real_time(&mut self) {
        self.is_limited = true;
    }

    /// Waits a moment, and returns the instant to which the run may continue: `now` if it is paused. `None` if it must stop.
    pub fn next(&mut self, now: RunTime) -> Option<RunTime> {
        while !self.cancel.is_cancelled() {
            let until = self.pace.due();
            let hurries = self.pace.speed == Speed::Max || self.is_behind(now);
            let wait = if until > now && hurries { Duration::ZERO } else { FRAME };
            match self.next_command(wait, now) {
                Some(RunCommand::Stop) => break,
                Some(command) => self.obey(command, now),
                None => return Some(until.max(now)),
            }
        }
        None
    }

    fn next_command(&mut self, wait: Duration, now: RunTime) -> Option<RunCommand> {
        if !self.pace.is_stepping(now)
            && let Some(command) = self.remote_commands.iter().find_map(|commands| commands.try_recv().ok())
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
                // No sender is left for a resume.
                self.commands = None;
                Some(RunCommand::Resume)
            }
        }
    }

    fn obey(&mut self, command: RunCommand, now: RunTime) {
        match command {
            RunCommand::Pause => self.pace.pause(now),
            RunCommand::Resume => self.pace.resume(now),
            RunCommand::Step(span) => self.pace.step(now, span),
            RunCommand::Speed(speed) => {
                let is_too_fast = self.is_limited && !matches!(speed, Speed::Times(times) if times <= 1.0);
                self.pace.set_speed(now, if is_too_fast { Speed::Times(1.0) } else { speed });
            }
            RunCommand::Stop => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_core::time::{HOUR, MINUTE};
    use std::sync::mpsc::channel;

    #[test]
    fn a_step_and_a_jump_end_at_their_instants() {
        let (start, there) = (RunTime::START, RunTime::START + 90 * SECOND);
        let mut pace = Pace::paused(Speed::Times(0.1));
        assert_eq!((pace.due(), pace.is_paused(start)), (start, true));
        pace.jump(start, there, true);
        assert_eq!((pace.due(), pace.is_paused(start), pace.hurries(start)), (there, false, true));
        pace.arrive(there);
        assert!(pace.is_paused(there) && !pace.hurries(there));
        pace.step(there, SECOND);
        assert!(!pace.is_paused(there) && pace.due() < there + SECOND, "a step keeps the speed");
        pace.set_speed(there, Speed::Max);
        assert_eq!(pace.due(), there + SECOND);
        pace.jump(there + SECOND, there + SECOND, true);
        assert!(pace.is_paused(there + SECOND), "a jump to the present takes no time");
        pace.resume(there + SECOND);
        assert_eq!(pace.due(), RunTime::MAX);
    }

    #[test]
    fn a_run_in_real_time_follows_the_clock() {
        let hours = |hours| jiff::SignedDuration::from_hours(hours);
        let behind = Pace::on_wall(Timestamp::now() - hours(3));
        let due = RunTime::START + 3 * HOUR;
        assert!((due..due + MINUTE).contains(&behind.due()));
        let mut paced = PaceKeeper::new(behind, Cancel::new(), None);
        let begun = Instant::now();
        assert!((0..1000).all(|_| paced.next(RunTime::START).is_some_and(|until| until >= due)));
        assert!(begun.elapsed() < 1000 * FRAME / 2, "it does not wait while it is behind");
        let early = Pace::on_wall(Timestamp::now() + hours(1));
        assert!(early.due() < RunTime::START);
        let mut waits = PaceKeeper::new(early, Cancel::new(), None);
        assert_eq!(waits.next(RunTime::START), Some(RunTime::START), "a home with a later start waits");
    }

    #[test]
    fn quotes_an_unknown_command_in_part() {
        let why = |line: &str| line.parse::<RunCommand>().unwrap_err().to_string();
        let hint = "the commands are pause, resume, step [SECONDS], speed X, stop";
        assert_eq!(why("halt"), format!("there is no command \"halt\"\n  hint: {hint}"));
        assert!(why(&"x".repeat(1 << 20)).len() < 1000);
        assert!(why(&format!("step {}", "9".repeat(1 << 20))).len() < 1000);
    }

    #[test]
    fn obeys_commands_in_order_and_resumes_without_a_sender() {
        let (say, commands) = channel();
        let mut paced = PaceKeeper::new(Pace::paused(Speed::Max), Cancel::new(), Some(commands));
        let start = RunTime::START;
        assert_eq!(paced.next(start), Some(start));
        say.send(RunCommand::Step(MINUTE)).unwrap();
        assert_eq!(paced.next(start), Some(start + MINUTE));
        drop(say);
        assert_eq!(paced.next(start + MINUTE), Some(RunTime::MAX));
        paced.cancel.cancel();
        assert_eq!(paced.next(start + MINUTE), None);
    }

    #[test]
    fn a_limited_run_gets_no_faster_and_obeys_remote_commands() {
        let (say, afar) = channel();
        let mut paced = PaceKeeper::new(Pace::new(Speed::Times(1.0)), Cancel::new(), None);
        assert!(paced.is_at_most_real_time());
        paced.add_commands(afar);
        paced.limit_to_real_time();
        for (command, speed) in [("speed max", 1.0), ("speed 0.5", 0.5), ("speed 2", 1.0)] {
            say.send(command.parse().unwrap()).unwrap();
            assert!(paced.next(RunTime::START).unwrap() < RunTime::START + SECOND);
            assert_eq!(paced.pace.speed(), Speed::Times(speed), "{command}");
        }
        say.send(RunCommand::Pause).unwrap();
        assert_eq!(paced.next(RunTime::START), Some(RunTime::START));
        drop(say);
        assert_eq!(paced.next(RunTime::START), Some(RunTime::START), "a closed remote channel does not resume the run");
        assert!(!PaceKeeper::new(Pace::default(), Cancel::new(), None).is_at_most_real_time());
    }

    #[test]
    fn reads_commands() {
        assert_eq!("step".parse(), Ok(RunCommand::Step(SECOND)));
        assert_eq!("step 1.5".parse(), Ok(RunCommand::Step(Span::from_millis(1500))));
        assert_eq!("speed max".parse(), Ok(RunCommand::Speed(Speed::Max)));
        for wrong in ["", "steps", "step -1", "step x", "speed 0", "speed 1001", "pause now"] {
            assert!(wrong.parse::<RunCommand>().is_err(), "{wrong}");
        }
    }
}
