//! What the system says to the program while it works: signals that ask it to end, and one that it does not want.

use crate::failure::Failure;
use homebody_log::error::no_thread;
use homebody_simulation::Cancel;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicI32, Ordering};

/// A program that a signal ends has this exit code and the signal's number in it, as shells count.
const SIGNALLED: i32 = 128;

/// Listens for the signals that ask a program to end: SIGINT (Ctrl-C), SIGTERM, and SIGHUP, for a terminal that is closed.
///
/// Until somebody takes the handle by [`Signals::cancel`], a signal ends the program at once. After that the first one cancels, so
/// that what was lived is stored, and the second ends the program at once.
#[derive(Clone, Default)]
pub struct Signals {
    cancel: Cancel,
    is_taken: Arc<AtomicBool>,
    /// The number of the first signal; 0 until there is one.
    first: Arc<AtomicI32>,
}

impl Signals {
    /// Begins to listen. Nobody may have begun a thread before.
    pub fn listen() -> Result<Signals, Failure> {
        let signals = Signals::default();
        let heard = signals.clone();
        system::listen(move |number| heard.hear(number))
            .map_err(|error| Failure::file(no_thread("to listen for signals", error)))?;
        Ok(signals)
    }

    /// What the first signal cancels from now on.
    pub fn cancel(&self) -> &Cancel {
        self.is_taken.store(true, Ordering::SeqCst);
        &self.cancel
    }

    /// A failure with the exit code of the first signal, if a signal has stopped the command early.
    pub fn ended(&self, is_stopped: bool) -> Result<(), Failure> {
        match self.first.load(Ordering::SeqCst) {
            number if number != 0 && is_stopped => Err(Failure::Signal((SIGNALLED + number) as u8)),
            _ => Ok(()),
        }
    }

    fn hear(&self, number: i32) {
        let _ = self.first.compare_exchange(0, number, Ordering::SeqCst, Ordering::SeqCst);
        if !self.is_taken.load(Ordering::SeqCst) || self.cancel.cancel() {
            std::process::exit(SIGNALLED + number);
        }
    }
}

/// A file that would grow beyond what the system allows is an error of writing, and does not kill the program. Nobody may have
/// begun a thread before.
pub fn outlive_full_files() {
    system::outlive_full_files();
}

/// Begins another program, to which signals mean what they mean anywhere: it would inherit what is blocked here.
pub fn begin_other<T>(begin: impl FnOnce() -> T) -> T {
    system::begin_other(begin)
}

#[cfg(unix)]
mod system {
    use nix::sys::signal::{SigSet, SigmaskHow, Signal};
    use std::io;
    use std::thread;

    /// Signals that are blocked here are blocked in all threads to come, and wait until one thread asks for them.
    pub fn listen(hear: impl Fn(i32) + Send + 'static) -> io::Result<()> {
        let asked: SigSet = [Signal::SIGINT, Signal::SIGTERM, Signal::SIGHUP].into_iter().collect();
        asked.thread_block()?;
        let listening = thread::Builder::new().name("signals".into()).spawn(move || {
            while let Ok(signal) = asked.wait() {
                hear(signal as i32);
            }
        });
        listening.map(|_| ())
    }

    pub fn outlive_full_files() {
        // Blocked, it waits in vain for somebody who asks, and writing fails. There is nothing to do where it cannot be.
        let _ = SigSet::from(Signal::SIGXFSZ).thread_block();
    }

    pub fn begin_other<T>(begin: impl FnOnce() -> T) -> T {
        let blocked = SigSet::empty().thread_swap_mask(SigmaskHow::SIG_SETMASK);
        let begun = begin();
        if let Ok(blocked) = blocked {
            let _ = blocked.thread_set_mask();
        }
        begun
    }
}

#[cfg(not(unix))]
mod system {
    use std::io;

    /// What Ctrl-C is called where there are no other signals.
    const SIGINT: i32 = 2;

    pub fn listen(hear: impl Fn(i32) + Send + 'static) -> io::Result<()> {
        ctrlc::set_handler(move || hear(SIGINT)).map_err(io::Error::other)
    }

    pub fn outlive_full_files() {}

    pub fn begin_other<T>(begin: impl FnOnce() -> T) -> T {
        begin()
    }
}
