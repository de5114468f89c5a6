//! A connection as a destination has it: messages are brought and waited for, while the connection lives in a thread of its own.

use crate::connection::Connection;
use crate::flight::{Flight, Link, State, Wish};
use crate::speech::Message;
use homebody_log::LogError;
use std::sync::Arc;
use std::thread::{self, JoinHandle};
use std::time::Duration;

/// Time without a broker after which a waiting row reports it (our choice). It is then retried, as the policy says.
const PATIENCE: Duration = Duration::from_secs(5);

/// A connection that lives.
pub(crate) struct Line {
    /// What errors call the broker.
    pub place: String,
    pub flight: Arc<Flight>,
    thread: Option<JoinHandle<()>>,
}

impl Line {
    /// Begins a connection, and waits until the broker has heard who it is of.
    pub fn begin(connection: Connection, place: String) -> Result<Line, LogError> {
        let flight = connection.flight.clone();
        let thread = thread::Builder::new().spawn(move || connection.live());
        let thread = thread.map_err(|source| LogError::NoThread { place: place.clone(), source })?;
        let line = Line { place, flight, thread: Some(thread) };
        line.wait(|shared| matches!(shared.link, Link::Up))?;
        Ok(line)
    }

    pub fn wait(&self, is_so: impl Fn(&State) -> bool) -> Result<(), LogError> {
        self.flight.wait(PATIENCE, is_so).map(drop).map_err(|trouble| trouble.error(&self.place))
    }

    /// Sends a message once there is room for it.
    pub fn take(&self, message: Message) -> Result<(), LogError> {
        if !self.flight.lock().has_room() {
            self.wait(State::has_much_room)?;
        }
        self.flight.lock().take(message);
        self.flight.wake.notify_one();
        Ok(())
    }

    /// Waits until all has arrived and the connection has ended, as was wished for.
    pub fn ended(&self) -> Result<(), LogError> {
        self.wait(|shared| matches!(shared.link, Link::Over(None)))
    }
}

impl Drop for Line {
    /// What is given up ends without a word: the broker then says by itself that it is not there any more.
    fn drop(&mut self) {
        self.flight.change(|shared| shared.wish = Wish::GiveUp);
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}
