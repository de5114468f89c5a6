//! The wishes of pages, in their order. A page that says much is refused, so that no other page waits for it.

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
    /// To complete all files, and then to say so.
    Close(Sender<()>),
}

/// The wishes that wait, as the stage hears them.
pub(super) struct Heard(Arc<Queue>);

/// The speakers to a stage. A clone is one more; when the last is gone, the stage is over.
#[derive(Clone)]
pub(super) struct Speakers(Arc<Last>);

/// The last speaker ends the stage.
struct Last(Arc<Queue>);

/// One speaker to a stage, such as a page.
pub struct Voice {
    speakers: Speakers,
    /// How many of its wishes wait.
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

/// One of the wishes of a voice that wait, for as long as it does.
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
        // No panic leaves it half changed.
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
    /// One more who says what is wanted.
    pub fn voice(&self) -> Voice {
        Voice { speakers: self.clone(), waiting: Arc::default() }
    }

    /// Asks for the end, before all else: nothing that waits is done any more.
    pub fn close(&self, done: Sender<()>) {
        let queue = &self.0.0;
        let mut waiting = queue.lock();
        waiting.wishes.retain(|(wish, _)| matches!(wish, Wish::Close(_)));
        waiting.wishes.push_back((Wish::Close(done), Counted::of(&Arc::default())));
        queue.changed.notify_all();
    }
}

impl Voice {
    /// Asks for something. False where so much of this voice waits already that it is not heard.
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

    /// Lets go of all keys, for the last time: however much waits, no key stays held.
    pub fn let_go(self) {
        let queue = &self.speakers.0.0;
        let wish = Wish::Say(Say::Hold { keys: Vec::new() });
        queue.lock().wishes.push_back((wish, Counted::of(&self.waiting)));
        queue.changed.notify_all();
    }
}

/// A stop comes before these: each of them may take long.
fn is_ended_by_stop(say: &Say) -> bool {
    matches!(say, Say::Start { .. } | Say::Replay { .. } | Say::Jump { .. } | Say::Stop)
}

/// The end of waiting for a wish.
pub(super) enum Next {
    Wish(Wish),
    Nothing,
    /// Nobody is left who could wish for anything.
    Over,
}

impl Heard {
    /// The next wish, which is waited for so long.
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
    use std::sync::mpsc::channel;

    fn start() -> Say {
        Say::Start { driven: None, without: Vec::new(), seed: Some(1) }
    }

    fn all(heard: &Heard) -> Vec<Wish> {
        let next = || match heard.next(Duration::ZERO) {
            Next::Wish(wish) => Some(wish),
            Next::Nothing | Next::Over => None,
        };
        std::iter::from_fn(next).collect()
    }

    #[test]
    fn a_page_that_says_much_is_refused_and_no_other_is() {
        let (speakers, heard) = wishes();
        let (loud, quiet) = (speakers.voice(), speakers.voice());
        let taken = (0..20_000).filter(|_| loud.say(start())).count();
        assert_eq!((taken, quiet.say(Say::Play)), (MOST_WAITING, true));
        assert_eq!(all(&heard).len(), MOST_WAITING + 1);
        assert!(loud.say(Say::Play), "what was done makes room");
        loud.let_go();
        assert!(matches!(all(&heard)[..], [Wish::Say(Say::Play), Wish::Say(Say::Hold { .. })]));
    }

    #[test]
    fn a_stop_is_heard_before_what_takes_long_and_an_end_before_all() {
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
    fn a_stage_is_over_when_nobody_is_left_to_speak() {
        let (speakers, heard) = wishes();
        let voice = speakers.voice();
        drop(speakers);
        assert!(matches!(heard.next(Duration::ZERO), Next::Nothing));
        drop(voice);
        assert!(matches!(heard.next(Duration::from_secs(600)), Next::Over));
    }
}
