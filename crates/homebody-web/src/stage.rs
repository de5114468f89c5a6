//! The thread on which the run is lived, at its pace, with everybody's wishes heard in between.
//!
//! It never waits for a page. What pages look at is put on a board; a page that is slow finds the next picture there when it
//! comes for it.
//!
//! The thread outlives its runs: one that fails, or breaks in the middle, is told about, its files are completed as far as it
//! came, and another can be begun.

use crate::folders::HomeFolders;
use crate::live_counts::LiveCounts;
use crate::messages::StageMessage;
use crate::request_error::{note, sentence};
use crate::staged_run::{StagedRun, Start, Unbegun};
use crate::wire::{FiringView, LiveCountsView, PageCommand, RunFrame, RunNotice, RunState, RunView};
pub use commands::PageCommands;
use commands::{CommandQueue, CommandReceiver, NextCommand, StageCommand, command_queue};
use homebody_core::problem::{Diagnose, Diagnostic};
use homebody_core::time::{RunTime, Span};
use homebody_log::error::no_thread;
use homebody_simulation::{pace::Pace, pace::Speed};
use std::any::Any;
use std::collections::VecDeque;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::channel;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};
use tokio::sync::watch;

/// How often the run is advanced, and looked at.
const FRAME: Duration = Duration::from_micros(16_667);

/// Time for commands before the next picture.
const LONGEST_TURN: Duration = Duration::from_millis(100);

/// How often a paused run looks after its log.
const IDLE: Duration = Duration::from_millis(250);

/// Number of the latest rows that a page may request (our choice).
const MOST_ROWS: usize = 2000;

/// Number of the latest notes (our choice).
const MOST_NOTES: usize = 20;

/// The run that everybody looks at. A clone is another view of the same.
#[derive(Clone)]
pub struct Stage {
    queue: CommandQueue,
    board: Arc<Mutex<Board>>,
    changed: watch::Receiver<u64>,
}

/// What there is to be seen.
struct Board {
    /// Which run it is, of all that there were.
    run: u64,
    /// Grows with each run and each change of what is told of it.
    number: u64,
    /// Nothing as long as no run could be begun.
    lived: Option<ShownRun>,
    rows: VecDeque<FiringView>,
    /// What was told, numbered from 0.
    notes: VecDeque<(u64, RunNotice)>,
    next_note: u64,
    /// Why the run has ended, if it failed: a page that comes later is told, too.
    failure: Option<RunNotice>,
    /// Why no run could be begun when that was last tried, and how often none could.
    unbegun: Option<RunNotice>,
    unbegun_count: u64,
}

/// What there is to be seen of a run.
struct ShownRun {
    view: Arc<RunView>,
    live_counts: Arc<Mutex<LiveCounts>>,
    frame: RunFrame,
}

impl ShownRun {
    fn new(act: &mut StagedRun, state: RunState, speed: Speed) -> ShownRun {
        ShownRun { view: Arc::new(act.view()), live_counts: act.live_counts(), frame: act.frame(state, times(speed)) }
    }
}

/// What a page has seen already.
#[derive(Clone, Copy, Debug, Default)]
pub struct Seen {
    run: u64,
    number: Option<u64>,
    unbegun: u64,
    row: u64,
    note: Option<u64>,
}

/// What a page has not seen yet.
pub struct News {
    pub tells: Vec<RunNotice>,
    /// Nothing as long as there is no run.
    pub frame: Option<RunFrame>,
}

impl Stage {
    /// Opens the scenario on the shelf, and keeps its run at its start until somebody says so. Of a scenario with problems there is
    /// no run until they are mended and one is begun.
    pub fn open(folders: HomeFolders) -> Result<Stage, Diagnostic> {
        let act = caught(|| StagedRun::new(&folders, &folders.entry, Start::default()));
        Stage::of(folders, act)
    }

    /// Keeps this run at its start.
    fn of(folders: HomeFolders, act: Result<StagedRun, Unbegun>) -> Result<Stage, Diagnostic> {
        let (mut act, unbegun) = match act {
            Ok(act) => (Some(act), None),
            Err(why) => (None, Some(why.tell())),
        };
        let board = Board {
            run: 0,
            number: 0,
            lived: act.as_mut().map(|act| ShownRun::new(act, RunState::Paused, Speed::Times(1.0))),
            rows: VecDeque::new(),
            notes: VecDeque::new(),
            next_note: 0,
            failure: None,
            unbegun_count: u64::from(unbegun.is_some()),
            unbegun,
        };
        let board = Arc::new(Mutex::new(board));
        let (queue, receiver) = command_queue();
        let (change, changed) = watch::channel(0);
        let pace = Pace::paused(Speed::Times(1.0));
        let director = Director { folders, act, is_broken: false, pace, receiver, board: board.clone(), change };
        let thread = thread::Builder::new().name("stage".into()).spawn(move || director.direct());
        thread.map_err(|error| no_thread("to simulate a run", error).diagnostic())?;
        Ok(Stage { queue, board, changed })
    }

    /// A voice for one more page. The board shows the answer.
    pub fn page_commands(&self) -> PageCommands {
        self.queue.page_commands()
    }

    /// Ends the run, and comes back when its files are complete.
    pub fn close(&self) {
        let (done, is_done) = channel();
        self.queue.close(done);
        // The thread only ends with the program.
        let _ = is_done.recv();
    }

    /// What the log of the run has got so far.
    pub fn live_counts(&self) -> LiveCountsView {
        let live_counts = locked(&self.board).lived.as_ref().map(|lived| lived.live_counts.clone());
        let Some(live_counts) = live_counts else { return LiveCountsView::default() };
        // The run is not kept waiting while this is put into words.
        let live_counts = locked(&live_counts).clone();
        live_counts.view()
    }

    /// The run that is being recorded now.
    pub fn recorded(&self) -> Option<String> {
        let board = locked(&self.board);
        let lived = board.lived.as_ref().filter(|lived| lived.frame.state != RunState::Over && !lived.view.replay);
        lived.and_then(|lived| lived.view.id.clone())
    }

    /// Whether a run is going on now.
    pub fn is_playing(&self) -> bool {
        locked(&self.board).lived.as_ref().is_some_and(|lived| lived.frame.state == RunState::Playing)
    }

    /// Changes whenever there is something new to be seen.
    pub fn changed(&self) -> watch::Receiver<u64> {
        self.changed.clone()
    }

    /// What is new since a page has looked last.
    pub fn news(&self, seen: &mut Seen, most_rows: usize) -> News {
        let board = locked(&self.board);
        let mut tells = Vec::new();
        if seen.number != Some(board.number) {
            seen.number = Some(board.number);
            tells.extend(board.lived.as_ref().map(|lived| RunNotice::Run { run: Box::new((*lived.view).clone()) }));
        }
        if seen.unbegun != board.unbegun_count {
            seen.unbegun = board.unbegun_count;
            tells.extend(board.unbegun.clone());
        }
        if let (None, Some(failure)) = (seen.note, board.failure.clone()) {
            tells.push(failure);
        }
        let first = seen.note.unwrap_or(board.next_note);
        tells.extend(board.notes.iter().filter(|(number, _)| *number >= first).map(|(_, tell)| tell.clone()));
        seen.note = Some(board.next_note);
        let Some(mut frame) = board.lived.as_ref().map(|lived| lived.frame.clone()) else {
            return News { tells, frame: None };
        };
        // Each run counts its rows from 0.
        if seen.run != board.run {
            (seen.run, seen.row) = (board.run, 0);
        }
        let fresh = board.rows.iter().rev().take_while(|row| row.seq >= seen.row).take(most_rows);
        frame.firings = fresh.cloned().collect();
        frame.firings.reverse();
        seen.row = frame.told;
        News { tells, frame: Some(frame) }
    }
}

/// A speed as the page is told it: nothing where it is as fast as it goes.
fn times(speed: Speed) -> Option<f64> {
    match speed {
        Speed::Times(times) => Some(times),
        Speed::Max => None,
    }
}

/// Nobody panics while it is held; if somebody did, what is there is whole all the same.
fn locked<T>(held: &Mutex<T>) -> MutexGuard<'_, T> {
    held.lock().unwrap_or_else(PoisonError::into_inner)
}

/// What is made, or why not in words, also where making it panics.
fn caught<T>(make: impl FnOnce() -> Result<T, Unbegun>) -> Result<T, Unbegun> {
    let broken =
        |broken: Box<dyn Any + Send>| Unbegun::Why(StageMessage::NotStarted { why: said(&*broken) }.diagnostic());
    catch_unwind(AssertUnwindSafe(make)).unwrap_or_else(|why| Err(broken(why)))
}

/// The message of a panic.
fn said(broken: &(dyn Any + Send)) -> String {
    let text = broken.downcast_ref::<&str>().copied().or_else(|| broken.downcast_ref::<String>().map(String::as_str));
    text.unwrap_or("no details").trim_end_matches('.').to_owned()
}

/// Who decides when the run is advanced, and how far.
struct Director {
    folders: HomeFolders,
    /// Nothing where the scenario had problems when the program began.
    act: Option<StagedRun>,
    /// The run panicked: it is neither advanced nor looked at any more.
    is_broken: bool,
    pace: Pace,
    receiver: CommandReceiver,
    board: Arc<Mutex<Board>>,
    change: watch::Sender<u64>,
}

impl Director {
    fn direct(mut self) {
        loop {
            let command = match self.receiver.next(self.wait()) {
                NextCommand::Command(command) => Some(command),
                NextCommand::Nothing => None,
                NextCommand::Over => return,
            };
            if let Err(broken) = catch_unwind(AssertUnwindSafe(|| self.take_turn(command))) {
                self.give_up(&said(&*broken));
            }
        }
    }

    fn take_turn(&mut self, mut command: Option<StageCommand>) {
        // All other wishes are done before the next picture, unless that takes long.
        let begun = Instant::now();
        while let Some(next) = command.take() {
            self.fulfil(next);
            if begun.elapsed() < LONGEST_TURN
                && let NextCommand::Command(next) = self.receiver.next(Duration::ZERO)
            {
                command = Some(next);
            }
        }
        self.go_on();
        if let Some(Err(why)) = self.act.as_mut().map(StagedRun::keep_input) {
            self.fail(&why);
        }
        self.show();
    }

    fn now(&self) -> RunTime {
        self.act.as_ref().map_or(RunTime::START, StagedRun::now)
    }

    /// Whether there is a run that has not come to its end.
    fn is_under_way(&self) -> bool {
        self.act.as_ref().is_some_and(|act| !act.is_over())
    }

    fn wait(&self) -> Duration {
        let runs = !self.is_paused() && self.is_under_way();
        match (runs, self.pace.hurries(self.now())) {
            (false, _) => IDLE,
            (true, true) => Duration::ZERO,
            (true, false) => FRAME,
        }
    }

    fn is_paused(&self) -> bool {
        self.pace.is_paused(self.now())
    }

    fn state(&self) -> RunState {
        if self.is_paused() { RunState::Paused } else { RunState::Playing }
    }

    fn fulfil(&mut self, command: StageCommand) {
        match command {
            StageCommand::PageCommand(say) => self.obey(say),
            StageCommand::Close(done) => {
                self.finish();
                // Whoever asked may be gone.
                let _ = done.send(());
            }
        }
    }

    fn obey(&mut self, say: PageCommand) {
        match say {
            PageCommand::Start { seed: Some(seed), .. } if seed >= 1 << 53 => {
                self.warn(&StageMessage::Seed.diagnostic());
            }
            PageCommand::Start { driven, without, seed } => {
                let is_driven = driven.is_some();
                let start = Start { driven, without, seed, input: Vec::new() };
                let act = caught(|| StagedRun::new(&self.folders, &self.folders.entry, start));
                if self.change_act(act) && is_driven {
                    // At any other speed a key that is held for a moment is a walk through the home.
                    self.pace.set_speed(RunTime::START, Speed::Times(1.0));
                }
            }
            PageCommand::Replay { run } => {
                let recording = self.folders.recording(&run);
                let act = caught(|| StagedRun::again(recording?));
                if self.change_act(act) {
                    self.pace.resume(RunTime::START);
                }
            }
            say => self.obey_in_run(say),
        }
    }

    /// What is said to the run that there is.
    fn obey_in_run(&mut self, say: PageCommand) {
        let now = self.now();
        self.pace.count_from(now);
        let Some(act) = &mut self.act else { return };
        match say {
            // Where a jump pauses, it does so all the same.
            PageCommand::Play if self.pace.is_jumping(now) => {}
            PageCommand::Play => self.pace.resume(now),
            PageCommand::Pause => self.pace.pause(now),
            PageCommand::Step { seconds } if seconds.is_finite() && (0.0..=86_400.0).contains(&seconds) => {
                self.pace.jump(now, now + Span::from_seconds(seconds), true);
            }
            PageCommand::Step { .. } => self.warn(&StageMessage::Step.diagnostic()),
            PageCommand::Speed { times: None } => self.pace.set_speed(now, Speed::Max),
            PageCommand::Speed { times: Some(times) } => match Speed::times(times) {
                Some(speed) => self.pace.set_speed(now, speed),
                None => self.warn(&StageMessage::Speed.diagnostic()),
            },
            PageCommand::Jump { to_us } => {
                let to = RunTime::from_micros(to_us).clamp(RunTime::START, act.end());
                self.jump(to);
            }
            PageCommand::Hold { keys } => act.hold(&keys),
            PageCommand::Be { posture } => act.be(posture),
            PageCommand::Use { thing, on } => act.use_thing(thing, on),
            PageCommand::Stop => self.finish(),
            PageCommand::Hello { .. } | PageCommand::Start { .. } | PageCommand::Replay { .. } => {}
        }
    }

    /// Forward as fast as it goes; back by living it again from a moment that was kept, or from the start with the same input.
    fn jump(&mut self, to: RunTime) {
        let was_paused = self.is_paused();
        let Some(act) = &mut self.act else { return };
        if to < act.now() {
            if act.go_back(to) {
                self.pace = Pace::paused(self.pace.speed());
                self.begin_anew();
            } else {
                let ends = act.goes_on_in();
                let act = caught(|| act.anew(to));
                if !self.change_act(act) {
                    return;
                }
                if let Some(name) = ends {
                    let text = format!(
                        "Going back stopped {name}, which stays in Playback. From here on, Homebody records a new run."
                    );
                    self.note(text);
                }
            }
        }
        self.pace.jump(self.now(), to, was_paused);
    }

    /// Another run takes the stage, if there is one; the files of this one are completed before.
    fn change_act(&mut self, act: Result<StagedRun, Unbegun>) -> bool {
        match act {
            Ok(act) => {
                self.finish();
                self.act = Some(act);
                self.pace = Pace::paused(self.pace.speed());
                self.begin_anew();
                true
            }
            Err(why) => {
                self.unbegun(why);
                false
            }
        }
    }

    /// No run is begun; what there was goes on.
    fn unbegun(&mut self, why: Unbegun) {
        match why {
            Unbegun::Why(why) => self.warn(&why),
            Unbegun::Problems(_) => {
                let mut board = locked(&self.board);
                board.unbegun = Some(why.tell());
                board.unbegun_count += 1;
                drop(board);
                self.change.send_modify(|change| *change += 1);
            }
        }
    }

    fn finish(&mut self) {
        match self.act.as_mut().map(StagedRun::finish) {
            Some(Ok(Some(text))) => self.note(text),
            Some(Ok(None)) | None => {}
            Some(Err(why)) => self.warn(&why),
        }
        self.pace.pause(self.now());
    }

    /// The run cannot go on; what it has stored is completed.
    fn fail(&mut self, why: &Diagnostic) {
        locked(&self.board).failure = Some(note(why));
        self.warn(why);
        self.finish();
    }

    /// The run broke in the middle. What it has stored is completed, and everybody is told.
    fn give_up(&mut self, why: &str) {
        // What is asked of it now may break as well.
        let kept = catch_unwind(AssertUnwindSafe(|| self.act.as_mut().map_or(Ok(None), StagedRun::give_up)));
        let files = match kept.map_err(|broken| said(&*broken)) {
            Ok(Ok(Some(stored))) => format!("Its data up to here is saved: {stored}"),
            Ok(Ok(None)) => String::from("It had no files to complete."),
            Ok(Err(why)) => format!("Its stored data is kept, but incomplete: {}", sentence(&why)),
            Err(why) => format!("Its stored data is kept, but incomplete: {why}"),
        };
        let message = StageMessage::Broke { why: why.to_owned(), files }.diagnostic();
        self.is_broken = true;
        self.pace.pause(self.now());
        let mut board = locked(&self.board);
        board.failure = Some(note(&message));
        if let Some(lived) = &mut board.lived {
            lived.frame.state = RunState::Over;
        }
        drop(board);
        self.warn(&message);
        self.change.send_modify(|change| *change += 1);
    }

    /// Lives what is due by now.
    fn go_on(&mut self) {
        if self.is_paused() || !self.is_under_way() {
            return;
        }
        let Some(end) = self.act.as_ref().map(StagedRun::end) else { return };
        let begun = Instant::now();
        let due = self.pace.due().min(end);
        while self.now() < due && !self.is_paused() {
            match self.act.as_mut().map(|act| act.advance(due, &self.folders)) {
                Some(Ok(true)) => self.tell_run_again(),
                Some(Ok(false)) | None => {}
                Some(Err(why)) => self.fail(&why),
            }
            if begun.elapsed() >= FRAME {
                break;
            }
        }
        self.pace.arrive(self.now());
        if self.now() >= end {
            self.finish();
        }
    }

    /// Puts on the board what there is to be seen.
    fn show(&mut self) {
        let (state, speed) = (self.state(), times(self.pace.speed()));
        let Some(act) = self.act.as_mut().filter(|_| !self.is_broken) else { return };
        let frame = act.frame(state, speed);
        let mut board = locked(&self.board);
        if let Some(lived) = &mut board.lived {
            lived.frame = frame;
        }
        board.rows.extend(act.take_rows());
        let superfluous = board.rows.len().saturating_sub(MOST_ROWS);
        board.rows.drain(..superfluous);
        drop(board);
        self.change.send_modify(|change| *change += 1);
    }

    /// Nobody sees a frame of the run before under the name of this one.
    fn begin_anew(&mut self) {
        self.is_broken = false;
        let (state, speed) = (self.state(), self.pace.speed());
        let lived = self.act.as_mut().map(|act| ShownRun::new(act, state, speed));
        let mut board = locked(&self.board);
        board.run += 1;
        board.number += 1;
        board.rows.clear();
        (board.failure, board.unbegun) = (None, None);
        board.lived = lived;
        drop(board);
        self.change.send_modify(|change| *change += 1);
    }

    fn tell_run_again(&mut self) {
        let told = self.act.as_ref().map(|act| (Arc::new(act.view()), act.live_counts()));
        let mut board = locked(&self.board);
        if let (Some(lived), Some((view, live_counts))) = (&mut board.lived, told) {
            (lived.view, lived.live_counts) = (view, live_counts);
            board.number += 1;
        }
    }

    /// Tells all pages what was done.
    fn note(&mut self, text: String) {
        self.tell(RunNotice::Note { text, bad: false, code: None });
    }

    /// Tells all pages what could not be done.
    fn warn(&mut self, message: &Diagnostic) {
        self.tell(note(message));
    }

    fn tell(&mut self, tell: RunNotice) {
        let mut board = locked(&self.board);
        let number = board.next_note;
        board.notes.push_back((number, tell));
        board.next_note += 1;
        if board.notes.len() > MOST_NOTES {
            board.notes.pop_front();
        }
    }
}

mod commands;

#[cfg(test)]
mod tests;
