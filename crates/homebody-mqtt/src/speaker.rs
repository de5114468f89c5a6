//! One home on a broker: it says what it is, and hears orders, that Home Assistant has begun anew, and what others say in its name.

use crate::address::BrokerAddress;
use crate::connection::Speaker;
use crate::flight::Flight;
use crate::greeting::{greeting, is_of_another};
use crate::order::{Order, Reply, TakesOrders, heard};
use crate::place::HomeTopics;
use crate::speech::Message;
use crate::trouble::BrokerError;
use homebody_core::scenario::logger::TimeFormat;
use homebody_log::RunInfo;
use homebody_log::table::InstantWriter;
use rumqttc::Publish;
use std::sync::{Arc, Mutex, PoisonError};

pub(crate) struct HomeSpeaker {
    pub address: BrokerAddress,
    pub place: Arc<HomeTopics>,
    pub run: Arc<RunInfo>,
    pub orders: Option<Arc<Mutex<TakesOrders>>>,
    /// Tells this connection from that of another program with the same home.
    pub instance: String,
}

impl Speaker for HomeSpeaker {
    fn greeting(&mut self) -> Vec<Message> {
        greeting(&self.address, &self.place, &self.run, &self.instance, self.orders.is_some())
    }

    fn topics(&self) -> Vec<String> {
        [self.place.command(), self.birth(), self.place.topic("run"), self.place.status().0].into()
    }

    fn base(&self) -> &str {
        &self.place.base
    }

    fn hear(&mut self, publish: &Publish, flight: &Arc<Flight>) -> Result<(), BrokerError> {
        let (status, [online, _]) = self.place.status();
        if publish.topic == self.place.command() {
            self.ordered(publish, flight);
        } else if publish.topic == self.birth() && *publish.payload == *b"online" {
            let greeting = self.greeting();
            flight.change(|state| state.greet_again(greeting));
        } else if publish.topic == self.place.topic("run") && is_of_another(&publish.payload, &self.instance) {
            return Err(BrokerError::another());
        } else if publish.topic == status && publish.payload != online {
            // The last will of an earlier program with this home, whose death the broker has only now noticed.
            flight.change(|state| state.say(Message::kept(status, online)));
        }
        Ok(())
    }
}

impl HomeSpeaker {
    /// The topic on which Home Assistant reports its start.
    fn birth(&self) -> String {
        format!("{}/status", self.address.discovery_prefix)
    }

    fn ordered(&mut self, publish: &Publish, flight: &Arc<Flight>) {
        let (asked, order) = heard(&publish.payload, publish.retain, &self.run);
        let running = match order {
            Ok(Order::Pause {}) => Some("OFF"),
            Ok(Order::Resume {}) => Some("ON"),
            _ => None,
        };
        let running = running.map(|running| Message::kept(self.place.topic("running"), running));
        let topic: Arc<str> = self.place.topic("command/result").into();
        let (flight, run) = (flight.clone(), self.run.clone());
        let reply = Reply::new(move |outcome| {
            let mut clock = InstantWriter::new(&run.calendar, TimeFormat::LocalOffset);
            let payload = asked.answer(&outcome, &mut clock).into();
            flight.change(|state| {
                state.answer(Message { topic, payload, retain: false, then: None });
                running.into_iter().filter(|_| outcome.is_ok()).for_each(|running| state.say(running));
            });
        });
        match (order, &self.orders) {
            (Err(why), _) => reply.refused(why, ""),
            (Ok(_), None) => reply.refused("this run takes no orders", ""),
            (Ok(order), Some(takes)) => takes.lock().unwrap_or_else(PoisonError::into_inner)(order, reply),
        }
    }
}
