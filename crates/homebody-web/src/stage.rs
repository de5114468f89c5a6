//! The thread that simulates the run at its pace, and takes the requests of all pages in between.
//!
//! It never waits for a page. The present state is on a board, and a slow page finds the latest state there.
//!
//! The thread outlives its runs. After an error or a panic it reports the failure and completes the files; another run can start.

use crate::folders::HomeFolders;
use crate::live_counts::LiveCounts;
use crate::messages::StageMessage;
use crate::request_error::{note, sentence};
use crate::staged_run::{StagedRun, StartError, StartRequest};
use crate::wire::{FiringView, LiveCountsView, PageCommand, RunFrame, RunNotice, RunState, RunView};
use commands::{CommandQueue, CommandReceiver, NextCommand, StageCommand, command_queue};
pub use commands::{PageCommands, Seen};
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

/// Interval between steps of the run, and between pictures.
const FRAME: Duration = Duration::from_micros(16_667);

/// Time for commands before the next picture.
const LONGEST_TURN: Duration = Duration::from_millis(100);

/// Interval between checks of the log of a paused run.
const IDLE: Duration = Duration::from_millis(250);

/// Number of the latest rows that a page may request (our choice).
const MOST_ROWS: usize = 2000;

/// Number of the latest notes (our choice).
const MOST_NOTES: usize = 20;

/// The run that all pages show. A clone is another handle to it.
#[derive(Clone)]
pub struct Stage {
    queue: CommandQueue,
    board: Arc<Mutex<Board>>,
    changed: watch::Receiver<u64>,
}

/// The state that pages read.
struct Board {
    /// The number of the run since the program started.
    run: u64,
    /// Grows with each run and each change of its view.
    number: u64,
    /// `None` until a run has started.
    shown: Option<ShownRun>,
    rows: VecDeque<FiringView>,
    notes: VecDeque<BoardNote>,
    next_note: u64,
    /// The failure of the run: pages that open later get it, too.
    failure: Option<RunNotice>,
    /// The error of the last failed start, and the number of failed starts.
    unbegun: Option<RunNotice>,
    unbegun_count: u64,
}

struct BoardNote {
    /// Counted from 0.
    number: u64,
    /// `None` for all pages.
    page: Option<u64>,
    notice: RunNotice,
}

/// The state of a run that pages read.
struct ShownRun {
    view: Arc<RunView>,
    live_counts: Arc<Mutex<LiveCounts>>,
    frame: RunFrame,
}

impl ShownRun {
    fn new(run: &mut StagedRun, state: RunState, speed: Speed) -> ShownRun {
        ShownRun { view: Arc::new(run.view()), live_counts: run.live_counts(), frame: run.frame(state, times(speed)) }
    }
}

/// The part that a page does not have yet.
pub struct News {
    pub tells: Vec<RunNotice>,
    /// `None` without a run.
    pub frame: Option<RunFrame>,
}

impl Stage {
    /// Opens the scenario of the folder, with its run paused at its start. A scenario with problems has no run until a page starts one
    /// without them.
    pub fn open(folders: HomeFolders) -> Result<Stage, Diagnostic> {
        let run = without_panic(|| StagedRun::new(&folders, &folders.entry, StartRequest::default()));
        Stage::with_run(folders, run)
    }

    /// Keeps this run at its start.
    fn with_run(folders: HomeFolders, run: Result<StagedRun, StartError>) -> Result<Stage, Diagnostic> {
        let (mut run, unbegun) = match run {
            Ok(run) => (Some(run), None),
            Err(why) => (None, Some(why.tell())),
        };
        let board = Board {
            run: 0,
            number: 0,
            shown: run.as_mut().map(|run| ShownRun::new(run, RunState::Paused, Speed::Times(1.0))),
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
        let stage_thread =
            StageThread { folders, run, is_broken: false, pace, receiver, asking: 0, board: board.clone(), change };
        let thread = thread::Builder::new().name("stage".into()).spawn(move || stage_thread.run());
        thread.map_err(|error| no_thread("to simulate a run", error).diagnostic())?;
        Ok(Stage { queue, board, changed })
    }

    /// The commands of one more page. The answers are on the board.
    pub fn page_commands(&self) -> PageCommands {
        self.queue.page_commands()
    }

    /// Ends the run, and returns when its files are complete.
    pub fn close(&self) {
        let (done, is_done) = channel();
        self.queue.close(done);
        // The thread only ends with the program.
        let _ = is_done.recv();
    }

    /// The counts of the rows of the run so far.
    pub fn live_counts(&self) -> LiveCountsView {
        let live_counts = locked(&self.board).shown.as_ref().map(|shown| shown.live_counts.clone());
        let Some(live_counts) = live_counts else { return LiveCountsView::default() };
        // The run continues meanwhile.
        let live_counts = locked(&live_counts).clone();
        live_counts.view()
    }

    pub fn recorded(&self) -> Option<String> {
        let board = locked(&self.board);
        let shown = board.shown.as_ref().filter(|shown| shown.frame.state != RunState::Over && !shown.view.replay);
        shown.and_then(|shown| shown.view.id.clone())
    }

    pub fn is_playing(&self) -> bool {
        locked(&self.board).shown.as_ref().is_some_and(|shown| shown.frame.state == RunState::Playing)
    }

    /// Changes with each change of the board.
    pub fn changed(&self) -> watch::Receiver<u64> {
        self.changed.clone()
    }

    /// The changes since the last call for a page.
    pub fn news(&self, seen: &mut Seen, most_rows: usize) -> News {
        let board = locked(&self.board);
        let mut tells = Vec::new();
        if seen.number != Some(board.number) {
            seen.number = Some(board.number);
            tells.extend(board.shown.as_ref().map(|shown| RunNotice::Run { run: Box::new((*shown.view).clone()) }));
        }
        if seen.unbegun != board.unbegun_count {
            seen.unbegun = board.unbegun_count;
            tells.extend(board.unbegun.clone());
        }
        if let (None, Some(failure)) = (seen.note, board.failure.clone()) {
            tells.push(failure);
        }
        let (first, page) = (seen.note.unwrap_or(board.next_note), seen.page);
        let notes =
            board.notes.iter().filter(|note| note.number >= first && (note.page.is_none() || note.page == page));
        tells.extend(notes.map(|note| note.notice.clone()));
        seen.note = Some(board.next_note);
        let Some(mut frame) = board.shown.as_ref().map(|shown| shown.frame.clone()) else {
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

/// A speed as pages have it: `None` is as fast as possible.
fn times(speed: Speed) -> Option<f64> {
    match speed {
        Speed::Times(times) => Some(times),
        Speed::Max => None,
    }
}

/// A panic of a holder leaves a complete value.
fn locked<T>(held: &Mutex<T>) -> MutexGuard<'_, T> {
    held.lock().unwrap_or_else(PoisonError::into_inner)
}

fn without_panic<T>(make: impl FnOnce() -> Result<T, StartError>) -> Result<T, StartError> {
    let broken = |broken: Box<dyn Any + Send>| {
        StartError::Other(StageMessage::NotStarted { why: panic_message(&*broken) }.diagnostic())
    };
    catch_unwind(AssertUnwindSafe(make)).unwrap_or_else(|why| Err(broken(why)))
}

fn panic_message(broken: &(dyn Any + Send)) -> String {
    let text = broken.downcast_ref::<&str>().copied().or_else(|| broken.downcast_ref::<String>().map(String::as_str));
    text.unwrap_or("no details").trim_end_matches('.').to_owned()
}

struct StageThread {
    folders: HomeFolders,
    /// `None` for a scenario with problems at the start of the program.
    run: Option<StagedRun>,
    /// The run panicked: it is neither advanced nor looked at any more.
    is_broken: bool,
    pace: Pace,
    receiver: CommandReceiver,
    /// The number of the page whose command is executed.
    asking: u64,
    board: Arc<Mutex<Board>>,
    change: watch::Sender<u64>,
}

impl StageThread {
    fn run(mut self) {
        loop {
            let command = match self.receiver.next(self.wait()) {
                NextCommand::Command(command) => Some(command),
                NextCommand::Nothing => None,
                NextCommand::Over => return,
            };
            if let Err(broken) = catch_unwind(AssertUnwindSafe(|| self.take_turn(command))) {
                self.give_up(&panic_message(&*broken));
            }
        }
    }

    fn take_turn(&mut self, mut command: Option<StageCommand>) {
        // All waiting requests come before the next picture, unless they take long.
        let begun = Instant::now();
        while let Some(next) = command.take() {
            self.fulfil(next);
            if begun.elapsed() < LONGEST_TURN
                && let NextCommand::Command(next) = self.receiver.next(Duration::ZERO)
            {
                command = Some(next);
            }
        }
        self.advance();
        if let Some(Err(why)) = self.run.as_mut().map(StagedRun::keep_input) {
            self.fail(&why);
        }
        self.show();
    }

    fn now(&self) -> RunTime {
        self.run.as_ref().map_or(RunTime::START, StagedRun::now)
    }

    /// Whether there is a run that has not come to its end.
    fn is_under_way(&self) -> bool {
        self.run.as_ref().is_some_and(|run| !run.is_over())
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
            StageCommand::PageCommand(page, say) => {
                self.asking = page;
                self.obey(say);
            }
            StageCommand::Close(done) => {
                self.finish();
                // The sender may be gone.
                let _ = done.send(());
            }
        }
    }

    fn obey(&mut self, say: PageCommand) {
        match say {
            PageCommand::Start { options, .. } if options.variant.seed.is_some_and(|seed| seed >= 1 << 53) => {
                self.refuse(StartError::in_option("seed", &StageMessage::Seed.diagnostic(), &[]));
            }
            PageCommand::Start { driven, options } => {
                let is_driven = driven.is_some();
                let request = StartRequest { driven, options, input: Vec::new() };
                let run = without_panic(|| StagedRun::new(&self.folders, &self.folders.entry, request));
                if self.change_run(run) && is_driven {
                    // At any other speed a key that is held for a moment is a walk through the home.
                    self.pace.set_speed(RunTime::START, Speed::Times(1.0));
                }
            }
            PageCommand::Replay { run } => {
                let recording = self.folders.recording(&run);
                let run = without_panic(|| StagedRun::replay(recording?));
                if self.change_run(run) {
                    self.pace.resume(RunTime::START);
                }
            }
            say => self.control(say),
        }
    }

    /// Applies a request to the present run.
    fn control(&mut self, say: PageCommand) {
        let now = self.now();
        self.pace.count_from(now);
        let Some(run) = &mut self.run else { return };
        match say {
            // A jump that pauses at its end still pauses.
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
                let to = RunTime::from_micros(to_us).clamp(RunTime::START, run.end());
                self.jump(to);
            }
            PageCommand::Hold { keys } => run.hold(&keys),
            PageCommand::Be { posture } => run.set_posture(posture),
            PageCommand::Use { thing, on } => run.use_thing(thing, on),
            PageCommand::Stop => self.finish(),
            PageCommand::Hello { .. } | PageCommand::Start { .. } | PageCommand::Replay { .. } => {}
        }
    }

    /// Jumps forward as fast as possible, and back to a snapshot or to the start, from where it simulates again with the same input.
    fn jump(&mut self, to: RunTime) {
        let was_paused = self.is_paused();
        let Some(run) = &mut self.run else { return };
        if to < run.now() {
            if run.rewind(to) {
                self.pace = Pace::paused(self.pace.speed());
                self.show_from_start();
            } else {
                let ends = run.recording_folder();
                let run = without_panic(|| run.restarted(to));
                if !self.change_run(run) {
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

    /// Replaces the run, unless the new one has an error. The files of the present run are completed before.
    fn change_run(&mut self, run: Result<StagedRun, StartError>) -> bool {
        match run {
            Ok(run) => {
                self.finish();
                self.run = Some(run);
                self.pace = Pace::paused(self.pace.speed());
                self.show_from_start();
                true
            }
            Err(why) => {
                self.refuse(why);
                false
            }
        }
    }

    /// Reports an error of a new run; the present run continues.
    fn refuse(&mut self, why: StartError) {
        match why {
            StartError::Other(why) => self.warn(&why),
            StartError::Option { .. } => self.tell(Some(self.asking), why.tell()),
            StartError::Problems(_) => {
                let mut board = locked(&self.board);
                board.unbegun = Some(why.tell());
                board.unbegun_count += 1;
            }
        }
        self.change.send_modify(|change| *change += 1);
    }

    fn finish(&mut self) {
        match self.run.as_mut().map(StagedRun::finish) {
            Some(Ok(Some(text))) => self.note(text),
            Some(Ok(None)) | None => {}
            Some(Err(why)) => self.warn(&why),
        }
        self.pace.pause(self.now());
    }

    /// Ends a run that failed, and completes its files.
    fn fail(&mut self, why: &Diagnostic) {
        locked(&self.board).failure = Some(note(why));
        self.warn(why);
        self.finish();
    }

    /// Ends a run that panicked: completes its files and tells all pages.
    fn give_up(&mut self, why: &str) {
        // Completing its files may panic, too.
        let kept = catch_unwind(AssertUnwindSafe(|| self.run.as_mut().map_or(Ok(None), StagedRun::give_up)));
        let files = match kept.map_err(|broken| panic_message(&*broken)) {
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
        if let Some(shown) = &mut board.shown {
            shown.frame.state = RunState::Over;
        }
        drop(board);
        self.warn(&message);
        self.change.send_modify(|change| *change += 1);
    }

    /// Simulates the part that is due by now.
    fn advance(&mut self) {
        if self.is_paused() || !self.is_under_way() {
            return;
        }
        let Some(end) = self.run.as_ref().map(StagedRun::end) else { return };
        let begun = Instant::now();
        let due = self.pace.due().min(end);
        while self.now() < due && !self.is_paused() {
            match self.run.as_mut().map(|run| run.advance(due, &self.folders)) {
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

    fn show(&mut self) {
        let (state, speed) = (self.state(), times(self.pace.speed()));
        let Some(run) = self.run.as_mut().filter(|_| !self.is_broken) else { return };
        let frame = run.frame(state, speed);
        let mut board = locked(&self.board);
        if let Some(shown) = &mut board.shown {
            shown.frame = frame;
        }
        board.rows.extend(run.take_rows());
        let superfluous = board.rows.len().saturating_sub(MOST_ROWS);
        board.rows.drain(..superfluous);
        drop(board);
        self.change.send_modify(|change| *change += 1);
    }

    /// Puts a new run on the board, without a frame of the run before.
    fn show_from_start(&mut self) {
        self.is_broken = false;
        let (state, speed) = (self.state(), self.pace.speed());
        let shown = self.run.as_mut().map(|run| ShownRun::new(run, state, speed));
        let mut board = locked(&self.board);
        board.run += 1;
        board.number += 1;
        board.rows.clear();
        (board.failure, board.unbegun) = (None, None);
        // A page gets the run before the notes, so an earlier refusal would look like a later one.
        board.notes.retain(|note| !matches!(note.notice, RunNotice::Unbegun { .. }));
        board.shown = shown;
        drop(board);
        self.change.send_modify(|change| *change += 1);
    }

    fn tell_run_again(&mut self) {
        let told = self.run.as_ref().map(|run| (Arc::new(run.view()), run.live_counts()));
        let mut board = locked(&self.board);
        if let (Some(shown), Some((view, live_counts))) = (&mut board.shown, told) {
            (shown.view, shown.live_counts) = (view, live_counts);
            board.number += 1;
        }
    }

    fn note(&mut self, text: String) {
        self.tell(None, RunNotice::Note { text, bad: false, code: None });
    }

    fn warn(&mut self, message: &Diagnostic) {
        self.tell(None, note(message));
    }

    /// Tells a page, or all pages.
    fn tell(&mut self, page: Option<u64>, notice: RunNotice) {
        let mut board = locked(&self.board);
        let number = board.next_note;
        board.notes.push_back(BoardNote { number, page, notice });
        board.next_note += 1;
        if board.notes.len() > MOST_NOTES {
            board.notes.pop_front();
        }
    }
}

mod commands;

#[cfg(test)]
mod tests;
