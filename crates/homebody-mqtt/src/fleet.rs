//! Many homes on one connection: each has topics of its own, as a home alone has them.
//!
//! A broker finds a dead program by its connection, so it can say of the fleet that it is not there any more, on `fleet00001/status`,
//! and not of each home. A home that comes says what it is; one that goes, that it is not there.

use crate::address::BrokerAddress;
use crate::connection::{BrokerConnection, Speaker, instance, options};
use crate::flight::{Flight, FlightGoal, FlightState};
use crate::greeting::{PROGRAM, at_rest, farewell, greeting, is_of_another};
use crate::line::Line;
use crate::names::{id_of_home, level};
use crate::place::HomeTopics;
use crate::sink::not_public;
use crate::speech::{Message, Speech};
use crate::trouble::BrokerError;
use homebody_core::event::Value as Said;
use homebody_core::time::UtcTime;
use homebody_log::fleet::{Fleet, FleetEvent, FleetRow, FleetSink};
use homebody_log::{Cancel, Deadline, LogError, Url, WriteMode};
use rumqttc::Publish;
use serde_json::{Map, Value, json};
use std::sync::{Arc, Mutex, PoisonError};

pub struct MqttFleet {
    url: Url,
    open: Option<OpenBrokerFleet>,
}

struct OpenBrokerFleet {
    line: Line,
    address: BrokerAddress,
    fleet: Arc<Fleet>,
    instance: String,
    /// By layout: what homes of it say, and below which topic the one is that it was made for.
    kinds: Vec<(Speech, String)>,
    homes: Vec<FleetHomeState>,
    /// The homes that are online; they report so again on a new connection.
    there: There,
    status: String,
    buffer: String,
    has_said_farewell: bool,
}

/// By the number of a home, whether it is online.
type There = Arc<Mutex<Vec<bool>>>;

#[derive(Clone, Default)]
struct FleetHomeState {
    next: u64,
    /// Of Zigbee2MQTT: by sensor, all that it has said last.
    last: Vec<Map<String, Value>>,
}

fn own_name(fleet: &Fleet) -> String {
    format!("fleet{:05}", fleet.first)
}

impl MqttFleet {
    /// The broker of a URL. Nothing is touched before it is begun.
    pub fn new(url: &Url) -> MqttFleet {
        MqttFleet { url: url.clone(), open: None }
    }

    fn begun(&mut self) -> Result<&mut OpenBrokerFleet, LogError> {
        let stopped = || LogError::Stopped { place: self.url.scheme().row().name.into() };
        self.open.as_mut().ok_or_else(stopped)
    }
}

impl FleetSink for MqttFleet {
    fn check(&self, is_fast: bool) -> Result<(), LogError> {
        let address = BrokerAddress::from_url(&self.url)?;
        if is_fast { address.may_go_fast() } else { Ok(()) }
    }

    fn begin(&mut self, fleet: &Arc<Fleet>, _: WriteMode, deadline: &Deadline) -> Result<Vec<u64>, LogError> {
        let address = BrokerAddress::from_url(&self.url)?;
        not_public(&address)?;
        let (told, instance, name) = (address.place(), instance(), own_name(fleet));
        let base = format!("{}/{name}", address.prefix);
        let status = format!("{base}/status");
        let id = id_of_home(&address.prefix, &name);
        let options = options(&address, (status.clone(), "offline"), &id, &instance);
        let options = options.map_err(|trouble| trouble.error(&told))?;
        let flight = Arc::new(Flight::new(&Cancel::new(), deadline));
        flight.lock().forgets = true;
        let there = There::new(Mutex::new(vec![false; fleet.homes.len()]));
        let speaker = FleetSpeaker {
            fleet: fleet.clone(),
            address: address.clone(),
            base,
            instance: instance.clone(),
            there: there.clone(),
        };
        let line = Line::begin(BrokerConnection { flight, options, speaker: Box::new(speaker) }, told)?;
        let speech = |layout: usize| {
            let first = fleet.homes.iter().position(|home| home.layout == layout);
            let run = fleet.run_of(first.unwrap_or_default() as u32);
            let place = Arc::new(HomeTopics::for_run(&address, &run));
            (Speech::new(&run, place.clone()), place.base.clone())
        };
        self.open = Some(OpenBrokerFleet {
            kinds: (0..fleet.layouts.len()).map(speech).collect(),
            line,
            address,
            fleet: fleet.clone(),
            instance,
            homes: vec![FleetHomeState::default(); fleet.homes.len()],
            there,
            status,
            buffer: String::new(),
            has_said_farewell: false,
        });
        Ok(vec![0; fleet.homes.len()])
    }

    fn tell(&mut self, told: &[FleetEvent]) -> Result<(), LogError> {
        let open = self.begun()?;
        for told in told {
            match *told {
                FleetEvent::Row(row) => open.row(&row)?,
                FleetEvent::Comes(home) => open.comes(home)?,
                FleetEvent::Goes(home) => open.goes(home)?,
            }
        }
        // It has arrived once the broker says so.
        open.line.wait(FlightState::is_empty)
    }

    fn finish(&mut self, _: UtcTime) -> Result<(), LogError> {
        let Some(open) = &mut self.open else { return Ok(()) };
        if !open.has_said_farewell {
            let there = open.there.lock().unwrap_or_else(PoisonError::into_inner).clone();
            for home in (0..there.len()).filter(|&home| there[home]) {
                open.goes(home as u32)?;
            }
            open.line.take(Message::kept(open.status.clone(), "offline"))?;
            open.has_said_farewell = true;
            open.line.flight.change(|shared| shared.wish = FlightGoal::Finish);
        }
        open.line.ended()?;
        self.open = None;
        Ok(())
    }
}

impl OpenBrokerFleet {
    fn row(&mut self, row: &FleetRow) -> Result<(), LogError> {
        let OpenBrokerFleet { fleet, kinds, homes, buffer, .. } = self;
        let home = &fleet.homes[row.home as usize];
        let FleetHomeState { next, last } = &mut homes[row.home as usize];
        // After an error that passes the same rows come again.
        if row.seq < *next {
            return Ok(());
        }
        let (speech, base) = &mut kinds[home.layout];
        let said = match row.value {
            Said::Reading(number) => {
                homebody_log::table::thousandths(number, buffer);
                buffer.as_str()
            }
            value => fleet.layouts[home.layout].value(value, buffer),
        };
        speech.turn_to(home.run, last);
        let mut message = speech.said(row.sensor.index(), row.seq as i64, row.at, said);
        speech.turn_to(home.run, last);
        if let Some(rest) = message.topic.strip_prefix(base.as_str()) {
            message.topic = format!("{}/{}{rest}", self.address.prefix, level(&home.name)).into();
        }
        let next_row = row.seq + 1;
        self.line.take(message)?;
        self.homes[row.home as usize].next = next_row;
        Ok(())
    }

    fn comes(&mut self, home: u32) -> Result<(), LogError> {
        let run = self.fleet.run_of(home);
        let place = HomeTopics::for_run(&self.address, &run);
        let rest = if place.is_discovered { at_rest(&place) } else { Vec::new() };
        for message in greeting(&self.address, &place, &run, &self.instance, false).into_iter().chain(rest) {
            self.line.take(message)?;
        }
        self.is_there(home, true);
        Ok(())
    }

    fn goes(&mut self, home: u32) -> Result<(), LogError> {
        self.is_there(home, false);
        let place = HomeTopics::for_run(&self.address, &self.fleet.run_of(home));
        farewell(&place).into_iter().try_for_each(|message| self.line.take(message))
    }

    fn is_there(&self, home: u32, is_there: bool) {
        self.there.lock().unwrap_or_else(PoisonError::into_inner)[home as usize] = is_there;
    }
}

struct FleetSpeaker {
    fleet: Arc<Fleet>,
    address: BrokerAddress,
    base: String,
    instance: String,
    there: There,
}

impl Speaker for FleetSpeaker {
    /// Reports that the fleet is online and, after a connection was lost, that each of its homes is: the broker may have forgotten them.
    /// Home Assistant keeps discovery messages itself.
    fn greeting(&mut self) -> Vec<Message> {
        let layout = &self.fleet.layouts[0].run;
        let mark = json!({
            "program": PROGRAM,
            "version": layout.version,
            "homes": self.fleet.homes.len(),
            "first": self.fleet.first,
            "instance": self.instance,
        });
        let mut all = vec![
            Message::kept(format!("{}/run", self.base), mark.to_string()),
            Message::kept(format!("{}/status", self.base), "online"),
        ];
        let address = BrokerAddress { discovery: crate::Discovery::Off, ..self.address.clone() };
        let there = self.there.lock().unwrap_or_else(PoisonError::into_inner).clone();
        for home in (0..there.len()).filter(|&home| there[home]) {
            let run = self.fleet.run_of(home as u32);
            let place = HomeTopics::for_run(&address, &run);
            all.extend(greeting(&address, &place, &run, &self.instance, false));
        }
        all
    }

    fn topics(&self) -> Vec<String> {
        vec![format!("{}/run", self.base)]
    }

    fn hear(&mut self, publish: &Publish, _: &Arc<Flight>) -> Result<(), BrokerError> {
        match is_of_another(&publish.payload, &self.instance) {
            true => Err(BrokerError::another()),
            false => Ok(()),
        }
    }

    fn base(&self) -> &str {
        &self.base
    }
}
