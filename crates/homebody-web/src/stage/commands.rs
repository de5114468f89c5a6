//! The queue of commands from pages. A page with too many waiting commands is refused, so that other pages do not wait for it.

use crate::wire::PageCommand;
use std::collections::VecDeque;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::Sender;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Largest number of waiting commands of a page. A page that sends more gets the answer that the run is busy.
pub(crate) const MOST_WAITING: usize = 32;

pub(super) enum StageCommand {
    /// The number of the page, and its command.
    PageCommand(u64, PageCommand),
    /// Complete all files, then report it.
    Close(Sender<()>),
}

pub(super) struct CommandReceiver(Arc<SharedQueue>);

/// A clone is one more sender; after the last is dropped, the stage ends.
#[derive(Clone)]
pub(super) struct CommandQueue(Arc<QueueEnd>);

/// Its drop ends the stage.
struct QueueEnd(Arc<SharedQueue>);

/// The part that a page has already.
#[derive(Clone, Copy, Debug, Default)]
pub struct Seen {
    /// The number of the page.
    pub(super) page: Option<u64>,
    pub(super) run: u64,
    pub(super) number: Option<u64>,
    pub(super) unbegun: u64,
    pub(super) row: u64,
    pub(super) note: Option<u64>,
}

pub struct PageCommands {
    queue: CommandQueue,
    page: u64,
    waiting: Arc<AtomicUsize>,
}

#[derive(Default)]
struct SharedQueue {
    waiting: Mutex<WaitingCommands>,
    changed: Condvar,
}

#[derive(Default)]
struct WaitingCommands {
    commands: VecDeque<(StageCommand, WaitingCount)>,
    is_over: bool,
    /// The number of pages so far.
    pages: u64,
}

struct WaitingCount(Arc<AtomicUsize>);

impl Drop for WaitingCount {
    fn drop(&mut self) {
        self.0.fetch_sub(1, Ordering::Relaxed);
    }
}

impl WaitingCount {
    fn new(waiting: &Arc<AtomicUsize>) -> WaitingCount {
        waiting.fetch_add(1, Ordering::Relaxed);
        WaitingCount(waiting.clone())
    }
}

impl SharedQueue {
    fn lock(&self) -> MutexGuard<'_, WaitingCommands> {
        // No panic leaves it half changed.
        self.waiting.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Drop for QueueEnd {
    fn drop(&mut self) {
        self.0.lock().is_over = true;
        self.0.changed.notify_all();
    }
}

pub(super) fn command_queue() -> (CommandQueue, CommandReceiver) {
    let queue = Arc::<SharedQueue>::default();
    (CommandQueue(Arc::new(QueueEnd(queue.clone()))), CommandReceiver(queue))
}

impl CommandQueue {
    pub fn page_commands(&self) -> PageCommands {
        let mut waiting = self.0.0.lock();
        waiting.pages += 1;
        PageCommands { queue: self.clone(), page: waiting.pages, waiting: Arc::default() }
    }

    /// Discards all waiting commands and ends the stage.
    pub fn close(&self, done: Sender<()>) {
        let queue = &self.0.0;
        let mut waiting = queue.lock();
        waiting.commands.retain(|(command, _)| matches!(command, StageCommand::Close(_)));
        waiting.commands.push_back((StageCommand::Close(done), WaitingCount::new(&Arc::default())));
        queue.changed.notify_all();
    }
}

impl PageCommands {
    /// A page that has nothing of the stage yet.
    pub fn seen(&self) -> Seen {
        Seen { page: Some(self.page), ..Seen::default() }
    }

    /// Queues a command. False if too many commands of this page wait.
    pub fn send(&self, say: PageCommand) -> bool {
        let queue = &self.queue.0.0;
        let mut waiting = queue.lock();
        if matches!(say, PageCommand::Stop) {
            let is_ended =
                |command: &StageCommand| matches!(command, StageCommand::PageCommand(_, say) if is_ended_by_stop(say));
            waiting.commands.retain(|(command, _)| !is_ended(command));
        } else if self.waiting.load(Ordering::Relaxed) >= MOST_WAITING {
            return false;
        }
        waiting.commands.push_back((StageCommand::PageCommand(self.page, say), WaitingCount::new(&self.waiting)));
        queue.changed.notify_all();
        true
    }

    /// Releases all keys after the last command, even if too many wait.
    pub fn release_keys(self) {
        let queue = &self.queue.0.0;
        let command = StageCommand::PageCommand(self.page, PageCommand::Hold { keys: Vec::new() });
        queue.lock().commands.push_back((command, WaitingCount::new(&self.waiting)));
        queue.changed.notify_all();
    }
}

/// A stop discards these waiting commands, which may take long.
fn is_ended_by_stop(say: &PageCommand) -> bool {
    matches!(say, PageCommand::Start { .. } | PageCommand::Replay { .. } | PageCommand::Jump { .. } | PageCommand::Stop)
}

pub(super) enum NextCommand {
    Command(StageCommand),
    Nothing,
    /// All senders are dropped.
    Over,
}

impl CommandReceiver {
    pub fn next(&self, wait: Duration) -> NextCommand {
        let until = Instant::now() + wait;
        let mut waiting = self.0.lock();
        loop {
            if let Some((command, _)) = waiting.commands.pop_front() {
                return NextCommand::Command(command);
            }
            if waiting.is_over {
                return NextCommand::Over;
            }
            let left = until.saturating_duration_since(Instant::now());
            if left.is_zero() {
                return NextCommand::Nothing;
            }
            waiting = self.0.changed.wait_timeout(waiting, left).unwrap_or_else(PoisonError::into_inner).0;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_simulation::RunOptions;
    use std::sync::mpsc::channel;

    fn start() -> PageCommand {
        PageCommand::Start { driven: None, options: RunOptions::default() }
    }

    fn all(receiver: &CommandReceiver) -> Vec<StageCommand> {
        let next = || match receiver.next(Duration::ZERO) {
            NextCommand::Command(command) => Some(command),
            NextCommand::Nothing | NextCommand::Over => None,
        };
        std::iter::from_fn(next).collect()
    }

    #[test]
    fn refuses_only_the_page_with_too_many_commands() {
        let (queue, receiver) = command_queue();
        let (loud, quiet) = (queue.page_commands(), queue.page_commands());
        let taken = (0..20_000).filter(|_| loud.send(start())).count();
        assert_eq!((taken, quiet.send(PageCommand::Play)), (MOST_WAITING, true));
        assert_eq!(all(&receiver).len(), MOST_WAITING + 1);
        assert!(loud.send(PageCommand::Play), "what was done makes room");
        loud.release_keys();
        assert!(matches!(
            all(&receiver)[..],
            [StageCommand::PageCommand(1, PageCommand::Play), StageCommand::PageCommand(1, PageCommand::Hold { .. })]
        ));
    }

    #[test]
    fn executes_a_stop_before_long_commands() {
        let (queue, receiver) = command_queue();
        let loud = queue.page_commands();
        while loud.send(start()) {}
        assert!(loud.send(PageCommand::Stop) && loud.send(PageCommand::Stop) && loud.send(PageCommand::Play));
        assert!(matches!(
            all(&receiver)[..],
            [StageCommand::PageCommand(_, PageCommand::Stop), StageCommand::PageCommand(_, PageCommand::Play)]
        ));
        while loud.send(start()) {}
        queue.close(channel().0);
        assert!(matches!(all(&receiver)[..], [StageCommand::Close(_)]));
    }

    #[test]
    fn ends_after_the_last_sender() {
        let (queue, receiver) = command_queue();
        let voice = queue.page_commands();
        drop(queue);
        assert!(matches!(receiver.next(Duration::ZERO), NextCommand::Nothing));
        drop(voice);
        assert!(matches!(receiver.next(Duration::from_secs(600)), NextCommand::Over));
    }
}
