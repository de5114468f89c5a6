//! The destination's end of a connection: it brings messages and waits for them, while a thread of its own runs the connection.

use crate::connection::BrokerConnection;
use crate::flight::{BrokerLink, Flight, FlightGoal, FlightState};
use crate::speech::Message;
use homebody_log::LogError;
use std::sync::Arc;
use std::thread::{self, JoinHandle};
use std::time::Duration;

/// Time without a broker after which a waiting row reports it (our choice). It is then retried, as the policy says.
const PATIENCE: Duration = Duration::from_secs(5);

pub(crate) struct Line {
    pub place: String,
    pub flight: Arc<Flight>,
    thread: Option<JoinHandle<()>>,
}

impl Line {
    /// Begins a connection, and waits until the broker has heard who it is of.
    pub fn begin(connection: BrokerConnection, place: String) -> Result<Line, LogError> {
        let flight = connection.flight.clone();
        let thread = thread::Builder::new().spawn(move || connection.run());
        let thread = thread.map_err(|source| LogError::NoThread { place: place.clone(), source })?;
        let line = Line { place, flight, thread: Some(thread) };
        line.wait(|shared| matches!(shared.link, BrokerLink::Up))?;
        Ok(line)
    }

    pub fn wait(&self, is_so: impl Fn(&FlightState) -> bool) -> Result<(), LogError> {
        self.flight.wait(PATIENCE, is_so).map(drop).map_err(|trouble| trouble.error(&self.place))
    }

    pub fn take(&self, message: Message) -> Result<(), LogError> {
        if !self.flight.lock().has_room() {
            self.wait(FlightState::has_much_room)?;
        }
        self.flight.lock().take(message);
        self.flight.wake.notify_one();
        Ok(())
    }

    pub fn ended(&self) -> Result<(), LogError> {
        self.wait(|shared| matches!(shared.link, BrokerLink::Over(None)))
    }
}

impl Drop for Line {
    /// Given up, it ends without a farewell: the broker then reports by itself that the home is offline.
    fn drop(&mut self) {
        self.flight.change(|shared| shared.wish = FlightGoal::GiveUp);
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}
