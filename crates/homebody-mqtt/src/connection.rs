//! The connection to a broker, in a thread of its own: it sends what is on its way, hears acknowledgements and what its speaker
//! listens to, and connects again when it is lost.

use crate::address::BrokerAddress;
use crate::flight::{BrokerLink, Flight, FlightGoal, MOST_IN_FLIGHT, Sent};
use crate::messages::BrokerMessage;
use crate::speech::Message;
use crate::trouble::BrokerError;
use homebody_core::messages::Diagnose;
use rumqttc::{
    AsyncClient, ClientError, ConnectionError, Event, EventLoop, LastWill, MqttOptions, Outgoing, Packet, PubAckReason,
    Publish, PublishOptions, QoS, RetainForwardRule, SubscribeFilterInput, TlsConfiguration, Transport, ValidatedTopic,
};
use std::cell::RefCell;
use std::collections::{HashMap, VecDeque};
use std::fs;
use std::sync::Arc;
use std::time::{Duration, SystemTime, UNIX_EPOCH};
use tokio::runtime::Builder;

/// Time that a broker may take to accept a connection (our choice). A run that begins reports a failure within 5 s.
const CONNECT_WITHIN: Duration = Duration::from_secs(4);

/// After how long without a word each side asks whether the other is there, as ESPHome does.
const KEEP_ALIVE_S: u16 = 15;

/// Wait before the first repetition, and longest wait before a later one (our choice).
const FIRST_WAIT: Duration = Duration::from_millis(50);
const LONGEST_WAIT: Duration = Duration::from_secs(5);

/// Largest size of an incoming message (our choice).
const LONGEST_INCOMING_BYTES: u32 = 64 * 1024;

/// Number of topics that are remembered (our choice). A fleet has a hundred thousand.
const MOST_TOPICS: usize = 4096;

/// Messages that wait inside the client (our choice).
const IN_CLIENT: usize = 64;

pub(crate) struct BrokerConnection {
    pub flight: Arc<Flight>,
    pub options: MqttOptions,
    pub speaker: Box<dyn Speaker>,
}

/// The owner of a connection: its greeting, and the topics that it listens to.
pub(crate) trait Speaker: Send {
    /// The messages before all others on each connection.
    fn greeting(&mut self) -> Vec<Message>;

    /// Topics to listen to, without their retained messages.
    fn topics(&self) -> Vec<String>;

    /// Somebody has said something there.
    fn hear(&mut self, publish: &Publish, flight: &Arc<Flight>) -> Result<(), BrokerError>;

    /// Below which topic they speak.
    fn base(&self) -> &str;
}

/// A text that no other program has.
pub(crate) fn instance() -> String {
    let now = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
    format!("{:x}-{:x}", std::process::id(), now.as_nanos())
}

pub(crate) fn options(
    address: &BrokerAddress,
    (topic, offline): (String, &'static str),
    id: &str,
    instance: &str,
) -> Result<MqttOptions, BrokerError> {
    let mut options = open(address, &format!("homebody-{id}-{instance}"))?;
    options.set_last_will(LastWill::new(topic, offline, QoS::AtLeastOnce, true, None));
    Ok(options)
}

pub(crate) fn open(address: &BrokerAddress, client: &str) -> Result<MqttOptions, BrokerError> {
    let mut options = MqttOptions::new(client, (address.host.clone(), address.port));
    options.set_keep_alive(KEEP_ALIVE_S).set_clean_start(true).set_connect_timeout(CONNECT_WITHIN);
    options.set_max_packet_size(Some(LONGEST_INCOMING_BYTES));
    // At each flush the client looks at the place of each message that may be in flight, taken or not.
    options.set_outgoing_inflight_upper_limit(MOST_IN_FLIGHT);
    // A message is not held back for the next one: with acknowledgements that wait in turn, that is 40 ms.
    let mut network = options.network_options();
    network.set_tcp_nodelay(true);
    options.set_network_options(network);
    let password = address.password().map_err(|error| BrokerError::new(error.diagnostic()).finally())?;
    match (&address.user, password) {
        (Some(user), Some(password)) => drop(options.set_credentials(user.clone(), password)),
        (Some(user), None) => drop(options.set_username(user.clone())),
        (None, _) => {}
    }
    if address.tls {
        let untrusted = |reason: String| BrokerError::new(BrokerMessage::Untrusted { reason }).finally();
        let tls = match &address.ca {
            Some(file) => {
                let ca = fs::read(file).map_err(|why| untrusted(format!("{}: {why}", file.display())))?;
                TlsConfiguration::Simple { ca, alpn: None, client_auth: None }
            }
            None => TlsConfiguration::try_default_rustls().map_err(|why| untrusted(why.to_string()))?,
        };
        options.set_transport(Transport::tls_with_config(tls));
    }
    Ok(options)
}

impl BrokerConnection {
    /// The thread's life: connects, and connects again, until it is to end.
    pub fn run(mut self) {
        let runtime = match Builder::new_current_thread().enable_all().build() {
            Ok(runtime) => runtime,
            Err(error) => {
                let reason = error.to_string();
                return self.over(Some(BrokerError::new(BrokerMessage::NoRuntime { reason }).finally()));
            }
        };
        let mut wait = FIRST_WAIT;
        loop {
            match runtime.block_on(self.connect()) {
                Ok(()) => return self.over(None),
                Err(trouble) => {
                    let was_up = matches!(self.flight.lock().link, BrokerLink::Up);
                    let is_new = matches!(self.flight.lock().link, BrokerLink::New);
                    // The caller of `begin` gets the error, and decides whether to try again.
                    if trouble.is_final || is_new {
                        return self.over(Some(trouble));
                    }
                    wait = if was_up { FIRST_WAIT } else { (2 * wait).min(LONGEST_WAIT) };
                    self.flight.change(|state| state.link = BrokerLink::Down(trouble));
                }
            }
            // A caller that gives up does not wait for this; one that finishes waits for the next connection.
            runtime.block_on(async {
                let _ = tokio::time::timeout(wait, async {
                    while self.flight.lock().wish != FlightGoal::GiveUp {
                        self.flight.wake.notified().await;
                    }
                })
                .await;
            });
            if self.flight.lock().wish == FlightGoal::GiveUp {
                return self.over(None);
            }
        }
    }

    fn over(&self, why: Option<BrokerError>) {
        self.flight.change(|state| state.link = BrokerLink::Over(why));
    }

    /// One connection, until it is lost or all is done.
    async fn connect(&mut self) -> Result<(), BrokerError> {
        let (client, events) = AsyncClient::builder(self.options.clone()).capacity(IN_CLIENT).build();
        let greeting = self.speaker.greeting();
        self.flight.change(|state| state.begin_connection(greeting));
        let sent = RefCell::new(VecDeque::new());
        let flight = self.flight.clone();
        let filters = self.speaker.topics().into_iter().map(listened_to).collect();
        let mut send = std::pin::pin!(send(client, &flight, filters, &sent));
        let mut hear = std::pin::pin!(self.hear(events, &sent));
        tokio::select! {
            ended = &mut send => match ended {
                // All is sent; the last answers are still to come.
                Ok(EndReason::Said) => hear.await,
                Ok(EndReason::GivenUp) => Ok(()),
                Err(_) => hear.await,
            },
            heard = &mut hear => heard,
            silent = flight.silence() => Err(silent),
        }
    }

    /// Reads from the broker until the connection is lost, or ends on request.
    async fn hear(&mut self, mut events: EventLoop, sent: &RefCell<VecDeque<Sent>>) -> Result<(), BrokerError> {
        let mut by_packet: HashMap<u16, Sent> = HashMap::new();
        loop {
            match events.poll().await {
                Ok(Event::Outgoing(Outgoing::Publish(packet))) => {
                    if let Some(sent) = sent.borrow_mut().pop_front() {
                        by_packet.insert(packet, sent);
                    }
                }
                Ok(Event::Incoming(Packet::PubAck(ack))) => {
                    if !matches!(ack.reason, PubAckReason::Success | PubAckReason::NoMatchingSubscribers) {
                        let (base, code) = (self.speaker.base().to_owned(), format!("{:?}", ack.reason));
                        return Err(BrokerError::new(BrokerMessage::NotTaken { base, code }).finally());
                    }
                    if let Some(sent) = by_packet.remove(&ack.pkid) {
                        self.flight.acknowledge(sent);
                    }
                }
                Ok(Event::Incoming(Packet::Publish(publish))) => self.speaker.hear(&publish, &self.flight)?,
                Ok(Event::Outgoing(Outgoing::Disconnect)) | Err(ConnectionError::RequestsDone) => return Ok(()),
                Ok(_) => {}
                Err(error) => return Err(BrokerError::from_connection(&error)),
            }
        }
    }
}

/// A subscription to the messages of a topic from now on.
fn listened_to(topic: String) -> SubscribeFilterInput {
    let filter = SubscribeFilterInput::new(topic, QoS::AtLeastOnce).no_local(true);
    filter.retain_forward_rule(RetainForwardRule::Never)
}

/// Why nothing more is sent.
enum EndReason {
    /// All is acknowledged, and the broker knows that this is the end.
    Said,
    /// Nobody wants to say anything any more.
    GivenUp,
}

/// Sends what is on its way, as it comes.
async fn send(
    client: AsyncClient,
    flight: &Flight,
    filters: Vec<SubscribeFilterInput>,
    sent: &RefCell<VecDeque<Sent>>,
) -> Result<EndReason, ClientError> {
    for filter in filters {
        client.subscribe_many([filter]).await?;
    }
    let mut topics: HashMap<Arc<str>, ValidatedTopic> = HashMap::new();
    let mut next = Vec::new();
    loop {
        let (wish, is_empty) = {
            let mut state = flight.lock();
            state.handful(&mut next);
            (state.wish, state.is_empty())
        };
        match wish {
            FlightGoal::GiveUp => return Ok(EndReason::GivenUp),
            FlightGoal::Finish if is_empty && next.is_empty() => {
                client.disconnect().await?;
                return Ok(EndReason::Said);
            }
            _ => {}
        }
        if next.is_empty() {
            flight.wake.notified().await;
        }
        for (which, message) in next.drain(..) {
            let topic = match topics.get(&message.topic) {
                Some(topic) => topic.clone(),
                None => {
                    if topics.len() >= MOST_TOPICS {
                        topics.clear();
                    }
                    let Ok(topic) = ValidatedTopic::new(&*message.topic) else { continue };
                    topics.insert(message.topic.clone(), topic.clone());
                    topic
                }
            };
            sent.borrow_mut().push_back(which);
            let options = PublishOptions::new(QoS::AtLeastOnce).retain(message.retain);
            client.publish(topic, message.payload.as_bytes().to_vec(), options).await?;
        }
    }
}
