//! The thread on which the run is lived, at its pace, with everybody's wishes heard in between.
//!
//! It never waits for a page. What pages look at is put on a board; a page that is slow finds the next picture there when it
//! comes for it.

use crate::growth::Growth;
use crate::shelf::Shelf;
use crate::staged_run::{StagedRun, Start};
use crate::wire::{FiringView, Frame, GrowthView, RunView, Say, State, Tell};
use homebody_core::time::{Micros, SECOND, micros};
use homebody_kit::pace::{Pace, Speed};
use std::collections::VecDeque;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};
use tokio::sync::watch;

/// How often the run is advanced, and looked at.
const FRAME: Duration = Duration::from_micros(16_667);

/// How much is lived at once where it goes as fast as it can, before the clock is looked at again.
const STRETCH: Micros = 60 * SECOND;

/// How often a paused run looks after its log.
const IDLE: Duration = Duration::from_millis(250);

/// How many of the latest rows a page may still ask for (ours).
const KEPT: usize = 2000;

/// How many notes (ours).
const NOTES: usize = 20;

/// The run that everybody looks at. A clone is another view of the same.
#[derive(Clone)]
pub struct Stage {
    wishes: Sender<Wish>,
    board: Arc<Mutex<Board>>,
    changed: watch::Receiver<u64>,
}

/// What the stage is asked for.
enum Wish {
    Say(Say),
    /// To complete all files, and then to say so.
    Close(Sender<()>),
}

/// What there is to be seen.
struct Board {
    /// Which run it is, of all that there were.
    run: u64,
    /// Grows with each run and each change of what is told of it.
    number: u64,
    view: Arc<RunView>,
    growth: Arc<Mutex<Growth>>,
    frame: Frame,
    rows: VecDeque<FiringView>,
    /// What was told, numbered from 0.
    notes: VecDeque<(u64, Tell)>,
    next_note: u64,
}

impl Board {
    fn tell_again(&mut self, view: Arc<RunView>, growth: Arc<Mutex<Growth>>) {
        (self.view, self.growth) = (view, growth);
        self.number += 1;
    }
}

/// What a page has seen already.
#[derive(Clone, Copy, Debug, Default)]
pub struct Seen {
    run: u64,
    number: Option<u64>,
    row: u64,
    note: Option<u64>,
}

/// What a page has not seen yet.
pub struct News {
    pub tells: Vec<Tell>,
    pub frame: Frame,
}

impl Stage {
    /// Opens the scenario on the shelf, and keeps its run at its start until somebody says so.
    pub fn open(shelf: Shelf) -> Result<Stage, String> {
        let mut act = StagedRun::new(&shelf, &shelf.entry, Start::default())?;
        let board = Board {
            run: 0,
            number: 0,
            view: Arc::new(act.view()),
            growth: act.growth(),
            frame: act.frame(State::Paused, times(Speed::Times(1.0))),
            rows: VecDeque::new(),
            notes: VecDeque::new(),
            next_note: 0,
        };
        let board = Arc::new(Mutex::new(board));
        let (wishes, heard) = channel();
        let (change, changed) = watch::channel(0);
        let director =
            Director { shelf, act, pace: Pace::paused(Speed::Times(1.0)), heard, board: board.clone(), change };
        let begun = thread::Builder::new().spawn(move || director.direct());
        begun.map_err(|error| format!("there is no thread to live on: {error}"))?;
        Ok(Stage { wishes, board, changed })
    }

    /// Asks for something. What comes of it is on the board.
    pub fn say(&self, say: Say) {
        // The thread only ends with the program.
        let _ = self.wishes.send(Wish::Say(say));
    }

    /// Ends the run, and comes back when its files are complete.
    pub fn close(&self) {
        let (done, is_done) = channel();
        if self.wishes.send(Wish::Close(done)).is_ok() {
            let _ = is_done.recv();
        }
    }

    /// What the log of the run has got so far.
    pub fn growth(&self) -> GrowthView {
        let growth = locked(&self.board).growth.clone();
        // The run is not kept waiting while this is put into words.
        let growth = locked(&growth).clone();
        growth.view()
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
            tells.push(Tell::Run { run: Box::new((*board.view).clone()) });
        }
        let first = seen.note.unwrap_or(board.next_note);
        tells.extend(board.notes.iter().filter(|(number, _)| *number >= first).map(|(_, tell)| tell.clone()));
        seen.note = Some(board.next_note);
        let mut frame = board.frame.clone();
        // Each run counts its rows from 0.
        if seen.run != board.run {
            (seen.run, seen.row) = (board.run, 0);
        }
        let fresh = board.rows.iter().rev().take_while(|row| row.seq >= seen.row).take(most_rows);
        frame.firings = fresh.cloned().collect();
        frame.firings.reverse();
        seen.row = frame.told;
        News { tells, frame }
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

/// Who decides when the run is advanced, and how far.
struct Director {
    shelf: Shelf,
    act: StagedRun,
    pace: Pace,
    heard: Receiver<Wish>,
    board: Arc<Mutex<Board>>,
    change: watch::Sender<u64>,
}

impl Director {
    fn direct(mut self) {
        loop {
            match self.heard.recv_timeout(self.wait()) {
                Ok(wish) => {
                    self.fulfil(wish);
                    // What else was said meanwhile is done before the next picture.
                    while let Ok(wish) = self.heard.try_recv() {
                        self.fulfil(wish);
                    }
                }
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => return,
            }
            self.go_on();
            self.show();
        }
    }

    fn wait(&self) -> Duration {
        let runs = !self.is_paused() && !self.act.is_over();
        match (runs, self.pace.hurries(self.act.now())) {
            (false, _) => IDLE,
            (true, true) => Duration::ZERO,
            (true, false) => FRAME,
        }
    }

    fn is_paused(&self) -> bool {
        self.pace.is_paused(self.act.now())
    }

    fn state(&self) -> State {
        if self.is_paused() { State::Paused } else { State::Playing }
    }

    fn fulfil(&mut self, wish: Wish) {
        match wish {
            Wish::Say(say) => self.obey(say),
            Wish::Close(done) => {
                self.finish();
                // Whoever asked may be gone.
                let _ = done.send(());
            }
        }
    }

    fn obey(&mut self, say: Say) {
        let now = self.act.now();
        self.pace.count_from(now);
        match say {
            Say::Hello { .. } => {}
            // Where a jump pauses, it does so all the same.
            Say::Play if self.pace.is_jumping(now) => {}
            Say::Play => self.pace.resume(now),
            Say::Pause => self.pace.pause(now),
            Say::Step { seconds } if seconds.is_finite() && (0.0..=86_400.0).contains(&seconds) => {
                self.pace.jump(now, now + micros(seconds), true);
            }
            Say::Step { .. } => self.note("a step is at most a day long".into(), true),
            Say::Speed { times: None } => self.pace.set_speed(now, Speed::Max),
            Say::Speed { times: Some(times) } => match Speed::times(times) {
                Some(speed) => self.pace.set_speed(now, speed),
                None => self.note("a speed is from 0.1 to 1000 times".into(), true),
            },
            Say::Jump { to_us } => self.jump(to_us.clamp(0, self.act.length())),
            Say::Hold { keys } => self.act.hold(&keys),
            Say::Be { posture } => self.act.be(posture),
            Say::Use { thing, on } => self.act.use_thing(thing, on),
            Say::Start { seed: Some(seed), .. } if seed >= 1 << 53 => {
                self.note("a seed is below 2 to the power of 53".into(), true);
            }
            Say::Start { driven, without, seed } => {
                let start = Start { driven, without, seed, input: Vec::new() };
                let act = StagedRun::new(&self.shelf, &self.shelf.entry, start);
                self.change_act(act);
            }
            Say::Stop => self.finish(),
            Say::Replay { run } => {
                let act = self.shelf.recording(&run).and_then(StagedRun::again);
                if self.change_act(act) {
                    self.pace.resume(0);
                }
            }
        }
    }

    /// Forward as fast as it goes; back by living it again from a moment that was kept, or from the start with the same input.
    fn jump(&mut self, to: Micros) {
        let was_paused = self.is_paused();
        if to < self.act.now() {
            if self.act.go_back(to) {
                self.pace = Pace::paused(self.pace.speed());
                self.begin_anew();
            } else {
                let act = self.act.anew(to);
                if !self.change_act(act) {
                    return;
                }
            }
        }
        self.pace.jump(self.act.now(), to, was_paused);
    }

    /// Another run takes the stage, if there is one; the files of this one are completed before.
    fn change_act(&mut self, act: Result<StagedRun, String>) -> bool {
        match act {
            Ok(act) => {
                self.finish();
                self.act = act;
                self.pace = Pace::paused(self.pace.speed());
                self.begin_anew();
                true
            }
            Err(why) => {
                self.note(why, true);
                false
            }
        }
    }

    fn finish(&mut self) {
        match self.act.finish() {
            Ok(Some(text)) => self.note(text, false),
            Ok(None) => {}
            Err(why) => self.note(why, true),
        }
        self.pace.pause(self.act.now());
    }

    /// Lives what is due by now.
    fn go_on(&mut self) {
        if self.is_paused() || self.act.is_over() {
            return;
        }
        let begun = Instant::now();
        let due = self.pace.due().min(self.act.length());
        while self.act.now() < due && !self.is_paused() {
            let until = due.min(self.act.now() + STRETCH);
            match self.act.advance(until, &self.shelf) {
                Ok(true) => self.tell_run_again(),
                Ok(false) => {}
                Err(why) => {
                    self.note(why, true);
                    self.finish();
                }
            }
            if begun.elapsed() >= FRAME {
                break;
            }
        }
        self.pace.arrive(self.act.now());
        if self.act.now() >= self.act.length() {
            self.finish();
        }
    }

    /// Puts on the board what there is to be seen.
    fn show(&mut self) {
        let frame = self.act.frame(self.state(), times(self.pace.speed()));
        let mut board = locked(&self.board);
        board.frame = frame;
        board.rows.extend(self.act.take_rows());
        let superfluous = board.rows.len().saturating_sub(KEPT);
        board.rows.drain(..superfluous);
        drop(board);
        self.change.send_modify(|change| *change += 1);
    }

    /// Nobody sees a frame of the run before under the name of this one.
    fn begin_anew(&mut self) {
        let (view, frame) = (Arc::new(self.act.view()), self.act.frame(self.state(), times(self.pace.speed())));
        let mut board = locked(&self.board);
        board.run += 1;
        board.rows.clear();
        board.frame = frame;
        board.tell_again(view, self.act.growth());
        drop(board);
        self.change.send_modify(|change| *change += 1);
    }

    fn tell_run_again(&mut self) {
        let view = Arc::new(self.act.view());
        locked(&self.board).tell_again(view, self.act.growth());
    }

    fn note(&mut self, text: String, bad: bool) {
        let mut board = locked(&self.board);
        let number = board.next_note;
        board.notes.push_back((number, Tell::Note { text, bad }));
        board.next_note += 1;
        if board.notes.len() > NOTES {
            board.notes.pop_front();
        }
    }
}
