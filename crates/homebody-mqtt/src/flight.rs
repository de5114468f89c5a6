//! Messages in flight: rows that were taken and are not acknowledged yet, in their order.
//!
//! Two threads share it: that of the destination, which brings rows and waits, and that of the connection, which sends them. A message
//! that is not acknowledged stays here when a connection is lost, and is sent again on the next one.

use crate::speech::Message;
use crate::trouble::BrokerError;
use homebody_log::{Cancel, Deadline};
use serde_json::json;
use std::collections::{HashMap, VecDeque};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};
use tokio::sync::Notify;

/// Largest number of messages that are sent and not acknowledged (our choice). Further ones wait.
pub(crate) const MOST_IN_FLIGHT: u16 = 1000;

/// Messages that are passed to the connection together (our choice).
const HANDFUL: usize = 64;

/// Time to wait, once the run is stopped, for a broker that acknowledges nothing (our choice).
const AFTER_STOP: Duration = Duration::from_millis(700);

/// The interval of checks for a silent broker.
const SILENCE_LOOK: Duration = Duration::from_millis(250);

/// Largest number of answers that wait to be sent (our choice).
const MOST_ASIDES: usize = 1000;

/// The state that both threads share.
#[derive(Default)]
pub(crate) struct Flight {
    state: Mutex<FlightState>,
    /// The destination's thread waits for this.
    changed: Condvar,
    /// The connection's thread waits for this.
    pub wake: Notify,
    cancel: Cancel,
    deadline: Deadline,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Sent {
    /// One that waits here for its acknowledgement, by its number.
    Row(u64),
    Greeting,
    /// One without a wait.
    Aside,
}

#[derive(Clone, Debug, Default)]
pub(crate) enum BrokerLink {
    #[default]
    New,
    /// It is there, and the broker has heard what the home is.
    Up,
    /// It was lost, for this reason, and is tried again.
    Down(BrokerError),
    /// It has ended, by this if it was not asked to.
    Over(Option<BrokerError>),
}

/// The request of the destination to the connection.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum FlightGoal {
    #[default]
    Live,
    /// To end once all is acknowledged.
    Finish,
    /// To end at once, without a word.
    GiveUp,
}

#[derive(Default)]
pub(crate) struct FlightState {
    /// Not acknowledged, with those before `first` left out; each with whether it is acknowledged out of turn.
    waiting: VecDeque<(Message, bool)>,
    /// The number of the first that waits: so many were acknowledged, without gaps.
    first: u64,
    /// The number of the next to be sent on this connection.
    next: u64,
    greeting: VecDeque<Message>,
    /// Of the greeting, how many are not acknowledged.
    greeting_left: usize,
    /// Messages before rows that are not waited for.
    asides: VecDeque<Message>,
    /// Answers that had no room among them: where they go, and how many.
    unanswered: Option<(Arc<str>, u64)>,
    /// The last message of each retained topic, in the order of first messages.
    told: Vec<TimedMessage>,
    by_topic: HashMap<Arc<str>, usize>,
    /// Whether retained messages are not kept here: a fleet has too many topics.
    pub forgets: bool,
    pub link: BrokerLink,
    pub wish: FlightGoal,
    /// Counts acknowledgements.
    answers: u64,
}

struct TimedMessage {
    message: Message,
    at: Instant,
}

impl Flight {
    /// A flight with a handle that ends waits, and a deadline for acknowledgements.
    pub fn new(cancel: &Cancel, deadline: &Deadline) -> Flight {
        Flight { cancel: cancel.clone(), deadline: deadline.clone(), ..Flight::default() }
    }

    pub fn lock(&self) -> MutexGuard<'_, FlightState> {
        // Nothing is left half done where a panic could come from.
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Changes what is shared, and tells both threads.
    pub fn change<T>(&self, change: impl FnOnce(&mut FlightState) -> T) -> T {
        let changed = change(&mut self.lock());
        self.changed.notify_all();
        self.wake.notify_one();
        changed
    }

    /// The broker has acknowledged a message. The waiting thread wakes when it has enough to do, not each time.
    pub fn acknowledge(&self, sent: Sent) {
        let (is_worth_it, is_ending) = {
            let mut state = self.lock();
            state.acknowledge(sent);
            self.deadline.asks();
            let left = state.waiting.len();
            (
                sent == Sent::Greeting || left == usize::from(MOST_IN_FLIGHT / 2) || left == 0,
                state.wish != FlightGoal::Live,
            )
        };
        if is_worth_it {
            self.changed.notify_all();
        }
        if is_ending {
            self.wake.notify_one();
        }
    }

    /// Returns once a broker that was sent something has not acknowledged anything for as long as it may take: its connection is half
    /// open, or it stands still.
    pub async fn silence(&self) -> BrokerError {
        let within = self.deadline.within();
        let mut since = (0, Instant::now());
        loop {
            tokio::time::sleep(SILENCE_LOOK.min(within / 4)).await;
            let state = self.lock();
            if state.answers != since.0 || !state.waits_for_broker() {
                since = (state.answers, Instant::now());
            }
            if since.1.elapsed() >= within {
                return BrokerError::silent(since.1.elapsed());
            }
        }
    }

    /// Waits until it is so. Gives up when the connection is over, and when no acknowledgement comes for this long without a connection,
    /// or within the deadline with one. Once the run is stopped, it gives up at once without a connection, and after a second with one.
    pub fn wait(
        &self,
        patience: Duration,
        is_so: impl Fn(&FlightState) -> bool,
    ) -> Result<MutexGuard<'_, FlightState>, BrokerError> {
        let mut state = self.lock();
        let mut since = (state.answers, Instant::now());
        loop {
            if is_so(&state) {
                return Ok(state);
            }
            if let BrokerLink::Over(why) = &state.link {
                return Err(why.clone().unwrap_or_else(BrokerError::ended));
            }
            if state.answers != since.0 {
                since = (state.answers, Instant::now());
            }
            let (without_link, with_link) = match self.cancel.is_cancelled() {
                true => (Duration::ZERO, AFTER_STOP),
                false => (patience.min(self.deadline.within()), self.deadline.within() + SILENCE_LOOK),
            };
            match &state.link {
                BrokerLink::Down(why) if since.1.elapsed() >= without_link => return Err(why.clone()),
                _ if since.1.elapsed() >= with_link => return Err(BrokerError::silent(since.1.elapsed())),
                _ => {}
            }
            let (after, _) =
                self.changed.wait_timeout(state, Duration::from_millis(50)).unwrap_or_else(PoisonError::into_inner);
            state = after;
        }
    }
}

impl FlightState {
    /// Takes a message, to be sent until it is acknowledged.
    pub fn take(&mut self, message: Message) {
        self.waiting.push_back((message, false));
    }

    /// Takes a message that goes before all rows, without a wait.
    pub fn say(&mut self, message: Message) {
        self.asides.push_back(message);
    }

    /// Takes the answer to an order. If more come than the broker takes, one answer stands for many.
    pub fn answer(&mut self, message: Message) {
        match self.asides.len() < MOST_ASIDES {
            true => self.say(message),
            false => self.unanswered.get_or_insert((message.topic, 0)).1 += 1,
        }
    }

    pub fn has_room(&self) -> bool {
        self.waiting.len() < usize::from(MOST_IN_FLIGHT)
    }

    pub fn has_much_room(&self) -> bool {
        self.waiting.len() <= usize::from(MOST_IN_FLIGHT / 2)
    }

    pub fn is_empty(&self) -> bool {
        self.waiting.is_empty() && self.asides.is_empty() && self.unanswered.is_none()
    }

    pub fn acknowledged(&self) -> u64 {
        self.first
    }

    /// Whether a message of this connection is not acknowledged.
    fn waits_for_broker(&self) -> bool {
        self.next > self.first || self.greeting_left > 0
    }

    /// Begins a connection: all that is not acknowledged goes again, after the greeting and what is kept.
    pub fn begin_connection(&mut self, greeting: Vec<Message>) {
        self.next = self.first;
        let again: Vec<&Arc<str>> = self.waiting.iter().map(|(message, _)| &message.topic).collect();
        let told = self.told.iter().filter(|told| !again.contains(&&told.message.topic)).filter_map(TimedMessage::now);
        self.greeting = greeting.into_iter().chain(told).collect();
        self.greeting_left = self.greeting.len();
    }

    /// Sends the greeting again, since a listener has started anew and does not know the home.
    pub fn greet_again(&mut self, greeting: Vec<Message>) {
        let all: Vec<Message> = greeting.into_iter().chain(self.told.iter().filter_map(TimedMessage::now)).collect();
        self.greeting_left += all.len();
        self.greeting.extend(all);
    }

    pub fn handful(&mut self, into: &mut Vec<(Sent, Message)>) {
        into.extend(self.greeting.drain(..).map(|message| (Sent::Greeting, message)));
        if let Some((topic, many)) = self.unanswered.take() {
            let why = format!("{many} orders came faster than they could be answered one by one");
            let payload = json!({ "id": null, "do": null, "ok": false, "why": why }).to_string().into();
            self.say(Message { topic, payload, retain: false, then: None });
        }
        into.extend(self.asides.drain(..).map(|message| (Sent::Aside, message)));
        while into.len() < HANDFUL
            && let Some((message, _)) = self.waiting.get((self.next - self.first) as usize)
        {
            into.push((Sent::Row(self.next), message.clone()));
            self.next += 1;
        }
        for (_, message) in into.iter().filter(|(sent, _)| *sent != Sent::Greeting) {
            self.keep_in_mind(message);
        }
    }

    /// The broker has acknowledged a message.
    pub fn acknowledge(&mut self, sent: Sent) {
        self.answers += 1;
        match sent {
            Sent::Row(number) => {
                if let Some(entry) = number.checked_sub(self.first).and_then(|at| self.waiting.get_mut(at as usize)) {
                    entry.1 = true;
                }
                while self.waiting.front().is_some_and(|(_, is_acknowledged)| *is_acknowledged) {
                    self.waiting.pop_front();
                    self.first += 1;
                }
                self.next = self.next.max(self.first);
            }
            Sent::Greeting => {
                self.greeting_left = self.greeting_left.saturating_sub(1);
                if self.greeting_left == 0 {
                    self.link = BrokerLink::Up;
                }
            }
            Sent::Aside => {}
        }
    }

    /// Keeps the last message of a topic for later listeners.
    pub fn keep_in_mind(&mut self, message: &Message) {
        if self.forgets || !message.retain && message.then.is_none() {
            return;
        }
        let told = TimedMessage { message: message.clone(), at: Instant::now() };
        match self.by_topic.get(&message.topic) {
            Some(&index) => self.told[index] = told,
            None => {
                self.by_topic.insert(message.topic.clone(), self.told.len());
                self.told.push(told);
            }
        }
    }
}

/// Time until a state that ends by itself is reported as over (our choice): longer than a usual `off-delay`.
const PASSES_WITHIN: Duration = Duration::from_secs(15);

impl TimedMessage {
    /// The current state of the topic; None while a momentary state may still hold.
    fn now(&self) -> Option<Message> {
        match &self.message.then {
            None => Some(self.message.clone()),
            Some(_) if self.at.elapsed() < PASSES_WITHIN => None,
            Some(then) => Some(Message::kept(self.message.topic.clone(), then.clone())),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(number: usize) -> Message {
        Message::kept(format!("home/{}", number % 3), number.to_string())
    }

    fn sent(state: &mut FlightState) -> Vec<(Sent, String)> {
        let mut all = Vec::new();
        state.handful(&mut all);
        all.into_iter().map(|(sent, message)| (sent, message.payload.to_string())).collect()
    }

    #[test]
    fn sends_only_unacknowledged_messages_again_in_order() {
        let mut state = FlightState::default();
        (0..5).for_each(|number| state.take(row(number)));
        assert_eq!(sent(&mut state).len(), 5);
        for number in [0, 1, 3] {
            state.acknowledge(Sent::Row(number));
        }
        assert_eq!((state.acknowledged(), state.is_empty()), (2, false));
        state.begin_connection(Vec::new());
        let again = sent(&mut state);
        // 3 was acknowledged out of turn, and goes again: after a gap, no row is sure. It includes the last message of topic 0.
        let rows: Vec<&str> = again.iter().map(|(_, payload)| payload.as_str()).collect();
        assert_eq!(rows, ["2", "3", "4"]);
        (2..5).for_each(|number| state.acknowledge(Sent::Row(number)));
        assert!(state.is_empty() && state.acknowledged() == 5);
        // The next connection gets the current state, once each.
        state.begin_connection(vec![Message::kept("status", "online")]);
        let greeting: Vec<String> = sent(&mut state).into_iter().map(|(_, payload)| payload).collect();
        assert_eq!(greeting, ["online", "3", "4", "2"]);
    }

    #[test]
    fn does_not_repeat_momentary_states() {
        let mut state = FlightState::default();
        state.keep_in_mind(&Message::kept("motion", "OFF"));
        state.take(Message { topic: "motion".into(), payload: "ON".into(), retain: false, then: Some("OFF".into()) });
        assert_eq!(sent(&mut state).len(), 1);
        state.acknowledge(Sent::Row(0));
        state.begin_connection(Vec::new());
        assert!(sent(&mut state).is_empty(), "it may still be on");
    }
}
