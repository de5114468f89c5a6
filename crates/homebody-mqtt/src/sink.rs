//! The destination: rows become messages, and are durable once the broker has acknowledged them.

use crate::address::BrokerAddress;
use crate::connection::{BrokerConnection, instance, options};
use crate::flight::{Flight, FlightGoal, FlightState};
use crate::greeting::{at_rest, farewell};
use crate::line::Line;
use crate::messages::BrokerMessage;
use crate::order::TakesOrders;
use crate::place::HomeTopics;
use crate::speaker::HomeSpeaker;
use crate::speech::Speech;
use homebody_core::time::RunTime;
use homebody_log::table::{Batch, Cell, thousandths};
use homebody_log::{Begin, LogError, Policy, Sink, Url, Watermark};
use std::net::{IpAddr, ToSocketAddrs};
use std::sync::{Arc, Mutex};
use std::time::Duration;

/// Time without a broker after which the run is given up (our choice).
const AWAY_FOR: Duration = Duration::from_secs(600);

/// A broker as a destination: required, and waited for ten minutes if it goes away on the way; there at the beginning.
pub fn policy() -> Policy {
    Policy { retry_for: AWAY_FOR, retries_beginning: false, retry_after: Duration::from_secs(1), ..Policy::of_server() }
}

/// A broker as a destination.
pub struct MqttSink {
    url: Url,
    /// Whether the run is in real time.
    is_live: bool,
    orders: Option<Arc<Mutex<TakesOrders>>>,
    open: Option<OpenBrokerLog>,
}

struct OpenBrokerLog {
    line: Line,
    speech: Speech,
    farewell: Arc<HomeTopics>,
    /// The number of the next row.
    next: u64,
    number: String,
}

impl MqttSink {
    /// For rows that come at any pace, which the place has to allow. Nothing is touched before it is begun.
    pub fn new(url: &Url) -> MqttSink {
        MqttSink { url: url.clone(), is_live: false, orders: None, open: None }
    }

    /// For a run that goes no faster than life.
    pub fn in_real_time(url: &Url) -> MqttSink {
        MqttSink { is_live: true, ..MqttSink::new(url) }
    }

    pub fn with_orders(self, orders: TakesOrders) -> MqttSink {
        MqttSink { orders: Some(Arc::new(Mutex::new(orders))), ..self }
    }

    fn begun(&mut self) -> Result<&mut OpenBrokerLog, LogError> {
        // By its kind alone: the place may have a password in it.
        let stopped = || LogError::Stopped { place: self.url.scheme().row().name.into() };
        self.open.as_mut().ok_or_else(stopped)
    }
}

impl Sink for MqttSink {
    fn begin(&mut self, begin: &Begin) -> Result<Watermark, LogError> {
        let address = BrokerAddress::from_url(&self.url)?;
        if !self.is_live {
            address.may_go_fast()?;
        }
        let place_told = address.place();
        if begin.tables.len() != 1 || !begin.tables[0].is_numbered {
            return Err(LogError::cannot_hold(place_told, BrokerMessage::RowsOnly));
        }
        not_public(&address)?;
        let place = Arc::new(HomeTopics::for_run(&address, &begin.run));
        let instance = instance();
        let (topic, [_, offline]) = place.status();
        let options = options(&address, (topic, offline), &place.id, &instance);
        let options = options.map_err(|trouble| trouble.error(&place_told))?;
        let flight = Arc::new(Flight::new(&begin.cancel, &begin.deadline));
        flight.change(|shared| at_rest(&place).iter().for_each(|message| shared.keep_in_mind(message)));
        let speaker = HomeSpeaker {
            address,
            place: place.clone(),
            run: begin.run.clone(),
            orders: self.orders.clone(),
            instance,
        };
        let line = Line::begin(BrokerConnection { flight, options, speaker: Box::new(speaker) }, place_told)?;
        let speech = Speech::new(&begin.run, place.clone());
        self.open = Some(OpenBrokerLog { line, speech, farewell: place, next: 0, number: String::new() });
        Ok(Watermark::none())
    }

    fn write(&mut self, batch: &Batch) -> Result<(), LogError> {
        let open = self.begun()?;
        for row in batch.rows() {
            let &[Cell::Integer(seq), Cell::Instant(at), sensor, value, ..] = row.cells else {
                return Err(LogError::destination(&open.line.place, BrokerMessage::OtherRow));
            };
            // After an error that passes the same rows come again.
            if (seq as u64) < open.next {
                continue;
            }
            let Cell::Text(sensor) = sensor else {
                return Err(LogError::destination(&open.line.place, BrokerMessage::NoSensor));
            };
            let said = match value {
                Cell::Text(text) => batch.text(text),
                Cell::Thousandths(reading) => {
                    thousandths(reading, &mut open.number);
                    &open.number
                }
                _ => "",
            };
            let message = open.speech.message(seq, at, batch.text(sensor), said)?;
            open.line.take(message)?;
            open.next = seq as u64 + 1;
        }
        Ok(())
    }

    fn make_durable(&mut self) -> Result<Watermark, LogError> {
        let Some(open) = &mut self.open else { return Ok(Watermark::none()) };
        open.line.wait(FlightState::is_empty)?;
        Ok(Watermark(vec![open.line.flight.lock().acknowledged()]))
    }

    fn finish(&mut self, _end: RunTime) -> Result<(), LogError> {
        self.make_durable()?;
        let Some(open) = &mut self.open else { return Ok(()) };
        if open.line.flight.lock().wish != FlightGoal::Finish {
            let farewell = farewell(&open.farewell);
            open.line.flight.change(|shared| {
                farewell.into_iter().for_each(|message| shared.take(message));
                shared.wish = FlightGoal::Finish;
            });
        }
        open.line.ended()?;
        self.open = None;
        Ok(())
    }
}

/// Refuses a public broker without a login, unless the URL allows it.
pub(crate) fn not_public(address: &BrokerAddress) -> Result<(), LogError> {
    if address.user.is_some() || address.public || !is_public(address) {
        return Ok(());
    }
    Err(LogError::destination(address.place(), BrokerMessage::Public))
}

/// Whether an address of the host is public. The connection reports a host that is unknown.
fn is_public(address: &BrokerAddress) -> bool {
    let Ok(found) = (address.host.as_str(), address.port).to_socket_addrs() else { return false };
    found.map(|found| found.ip()).any(|ip| match ip.to_canonical() {
        IpAddr::V4(ip) => {
            let shared = ip.octets()[0] == 100 && ip.octets()[1] & 0xc0 == 64;
            !(ip.is_loopback() || ip.is_private() || ip.is_link_local() || ip.is_unspecified() || shared)
        }
        IpAddr::V6(ip) => {
            !(ip.is_loopback() || ip.is_unique_local() || ip.is_unicast_link_local() || ip.is_unspecified())
        }
    })
}
