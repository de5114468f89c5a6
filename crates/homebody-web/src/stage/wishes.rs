//! The queue of requests of pages. A page with too many requests is refused, so that no other page waits for it.

use crate::wire::Say;
use std::collections::VecDeque;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::Sender;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Largest number of waiting commands of a page. A page that sends more gets the answer that the run is busy.
pub(crate) const MOST_WAITING: usize = 32;

/// A request to the stage.
pub(super) enum Wish {
    Say(Say),
    /// Completes all files, and then answers.
    Close(Sender<()>),
}

/// The receiver of the queue.
pub(super) struct Heard(Arc<Queue>);

/// The senders to a stage. Dropping the last clone ends the stage.
#[derive(Clone)]
pub(super) struct Speakers(Arc<Last>);

/// Ends the stage when it is dropped.
struct Last(Arc<Queue>);

/// One sender to a stage, such as a page.
pub struct Voice {
    speakers: Speakers,
    /// The number of its waiting requests.
    waiting: Arc<AtomicUsize>,
}

#[derive(Default)]
struct Queue {
    waiting: Mutex<Waiting>,
    changed: Condvar,
}

#[derive(Default)]
struct Waiting {
    wishes: VecDeque<(Wish, Counted)>,
    is_over: bool,
}

/// Counts a waiting request until it is dropped.
struct Counted(Arc<AtomicUsize>);

impl Drop for Counted {
    fn drop(&mut self) {
        self.0.fetch_sub(1, Ordering::Relaxed);
    }
}

impl Counted {
    fn of(waiting: &Arc<AtomicUsize>) -> Counted {
        waiting.fetch_add(1, Ordering::Relaxed);
        Counted(waiting.clone())
    }
}

impl Queue {
    fn lock(&self) -> MutexGuard<'_, Waiting> {
        // A panic of a holder leaves a complete value.
        self.waiting.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Drop for Last {
    fn drop(&mut self) {
        self.0.lock().is_over = true;
        self.0.changed.notify_all();
    }
}

/// Both ends of a queue.
pub(super) fn wishes() -> (Speakers, Heard) {
    let queue = Arc::<Queue>::default();
    (Speakers(Arc::new(Last(queue.clone()))), Heard(queue))
}

impl Speakers {
    pub fn voice(&self) -> Voice {
        Voice { speakers: self.clone(), waiting: Arc::default() }
    }

    /// Requests the end of the stage, and drops all waiting requests.
    pub fn close(&self, done: Sender<()>) {
        let queue = &self.0.0;
        let mut waiting = queue.lock();
        waiting.wishes.retain(|(wish, _)| matches!(wish, Wish::Close(_)));
        waiting.wishes.push_back((Wish::Close(done), Counted::of(&Arc::default())));
        queue.changed.notify_all();
    }
}

impl Voice {
    /// Sends a request. False if too many requests of this voice wait.
    pub fn say(&self, say: Say) -> bool {
        let queue = &self.speakers.0.0;
        let mut waiting = queue.lock();
        if matches!(say, Say::Stop) {
            waiting.wishes.retain(|(wish, _)| !matches!(wish, Wish::Say(waits) if is_ended_by_stop(waits)));
        } else if self.waiting.load(Ordering::Relaxed) >= MOST_WAITING {
            return false;
        }
        waiting.wishes.push_back((Wish::Say(say), Counted::of(&self.waiting)));
        queue.changed.notify_all();
        true
    }

    /// Releases all keys at the end of a page, however many requests wait.
    pub fn let_go(self) {
        let queue = &self.speakers.0.0;
        let wish = Wish::Say(Say::Hold { keys: Vec::new() });
        queue.lock().wishes.push_back((wish, Counted::of(&self.waiting)));
        queue.changed.notify_all();
    }
}

/// Requests that may take long, which a stop drops.
fn is_ended_by_stop(say: &Say) -> bool {
    matches!(say, Say::Start { .. } | Say::Replay { .. } | Say::Jump { .. } | Say::Stop)
}

/// The result of waiting for a request.
pub(super) enum Next {
    Wish(Wish),
    Nothing,
    /// The last sender is gone.
    Over,
}

impl Heard {
    /// Waits this long for the next request.
    pub fn next(&self, wait: Duration) -> Next {
        let until = Instant::now() + wait;
        let mut waiting = self.0.lock();
        loop {
            if let Some((wish, _)) = waiting.wishes.pop_front() {
                return Next::Wish(wish);
            }
            if waiting.is_over {
                return Next::Over;
            }
            let left = until.saturating_duration_since(Instant::now());
            if left.is_zero() {
                return Next::Nothing;
            }
            waiting = self.0.changed.wait_timeout(waiting, left).unwrap_or_else(PoisonError::into_inner).0;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_simulation::VariantOptions;
    use std::sync::mpsc::channel;

    fn start() -> Say {
        Say::Start { driven: None, variant: VariantOptions { seed: Some(1), ..VariantOptions::default() } }
    }

    fn all(heard: &Heard) -> Vec<Wish> {
        let next = || match heard.next(Duration::ZERO) {
            Next::Wish(wish) => Some(wish),
            Next::Nothing | Next::Over => None,
        };
        std::iter::from_fn(next).collect()
    }

    #[test]
    fn refuses_only_the_page_with_too_many_requests() {
        let (speakers, heard) = wishes();
        let (loud, quiet) = (speakers.voice(), speakers.voice());
        let taken = (0..20_000).filter(|_| loud.say(start())).count();
        assert_eq!((taken, quiet.say(Say::Play)), (MOST_WAITING, true));
        assert_eq!(all(&heard).len(), MOST_WAITING + 1);
        assert!(loud.say(Say::Play), "a finished request makes room");
        loud.let_go();
        assert!(matches!(all(&heard)[..], [Wish::Say(Say::Play), Wish::Say(Say::Hold { .. })]));
    }

    #[test]
    fn a_stop_comes_before_long_requests_and_an_end_before_all() {
        let (speakers, heard) = wishes();
        let loud = speakers.voice();
        while loud.say(start()) {}
        assert!(loud.say(Say::Stop) && loud.say(Say::Stop) && loud.say(Say::Play));
        assert!(matches!(all(&heard)[..], [Wish::Say(Say::Stop), Wish::Say(Say::Play)]));
        while loud.say(start()) {}
        speakers.close(channel().0);
        assert!(matches!(all(&heard)[..], [Wish::Close(_)]));
    }

    #[test]
    fn a_stage_ends_with_its_last_sender() {
        let (speakers, heard) = wishes();
        let voice = speakers.voice();
        drop(speakers);
        assert!(matches!(heard.next(Duration::ZERO), Next::Nothing));
        drop(voice);
        assert!(matches!(heard.next(Duration::from_secs(600)), Next::Over));
    }
}
