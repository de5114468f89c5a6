//! Signals of the system: those that end the program, and one that it ignores.

use crate::failure::Failure;
use homebody_log::error::no_thread;
use homebody_simulation::Cancel;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicI32, Ordering};

/// Exit code of a program that a signal ended, less the number of the signal, as in shells.
const SIGNALLED: i32 = 128;

/// Listens for the signals that end a program: SIGINT (Ctrl-C), SIGTERM, and SIGHUP for a closed terminal.
///
/// Before a call of [`Signals::cancel`], a signal ends the program at once. After it, the first signal cancels the work, so that the
/// simulated part is stored, and the second ends the program at once.
#[derive(Clone, Default)]
pub struct Signals {
    cancel: Cancel,
    is_taken: Arc<AtomicBool>,
    /// The number of the first signal, or 0.
    first: Arc<AtomicI32>,
}

impl Signals {
    /// Starts to listen. No thread may run before.
    pub fn listen() -> Result<Signals, Failure> {
        let signals = Signals::default();
        let heard = signals.clone();
        system::listen(move |number| heard.hear(number))
            .map_err(|error| Failure::file(no_thread("to listen for signals", error)))?;
        Ok(signals)
    }

    /// The handle that the first signal cancels from now on.
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

/// Makes a file beyond the limit of the system an error of writing, which does not kill the program. No thread may run before.
pub fn outlive_full_files() {
    system::outlive_full_files();
}

/// Starts another program with the default signal mask, because it would inherit the blocked signals.
pub fn begin_other<T>(begin: impl FnOnce() -> T) -> T {
    system::begin_other(begin)
}

#[cfg(unix)]
mod system {
    use nix::sys::signal::{SigSet, SigmaskHow, Signal};
    use std::io;
    use std::thread;

    /// Blocks the signals in all later threads, except for one thread that waits for them.
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
        // A blocked signal stays pending, and writing fails with an error. A failure to block it does not matter.
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

    /// The number of Ctrl-C on systems without other signals.
    const SIGINT: i32 = 2;

    pub fn listen(hear: impl Fn(i32) + Send + 'static) -> io::Result<()> {
        ctrlc::set_handler(move || hear(SIGINT)).map_err(io::Error::other)
    }

    pub fn outlive_full_files() {}

    pub fn begin_other<T>(begin: impl FnOnce() -> T) -> T {
        begin()
    }
}
