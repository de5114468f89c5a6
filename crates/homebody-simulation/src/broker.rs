//! Brokers: destinations that get events in real time and may send orders to a run.

use crate::error::SimulationError;
use crate::pace::PaceKeeper;
use homebody_log::{Destination, LogError, Url};

/// The topics of Homebody on a broker.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct BrokerCleanup {
    /// The homes, by their topics.
    pub homes: Vec<String>,
    /// The topics with retained messages.
    pub topics: Vec<String>,
    /// The number of other topics below the prefix, which stay.
    pub others: usize,
}

#[cfg(feature = "mqtt")]
mod built {
    use super::*;
    use crate::interventions::{InterventionRequest, OrderedIntervention, Refusal, SensorFailure};
    use crate::pace::{RunCommand, Speed};
    use crate::simulation::orders::OrderMessage;
    use homebody_core::time::Span;
    use homebody_mqtt::{BrokerAddress, MqttSink, Order, OrderedFault, Reply, TakesOrders, clean, policy};
    use std::sync::mpsc::{Receiver, sync_channel};

    /// Largest number of waiting commands (our choice).
    const MOST_WAITING: usize = 1000;

    pub fn tidy_up(url: &Url, only_look: bool) -> Result<BrokerCleanup, SimulationError> {
        let cleaned = clean(url, only_look)?;
        Ok(BrokerCleanup { homes: cleaned.homes, topics: cleaned.topics, others: cleaned.others })
    }

    pub fn destination(url: &Url, paced: &mut PaceKeeper) -> Result<Option<Destination>, SimulationError> {
        if !BrokerAddress::is_broker(url) {
            return Ok(None);
        }
        let address = BrokerAddress::from_url(url)?;
        let is_live = !address.allow_fast;
        if is_live {
            if !paced.is_at_most_real_time() {
                address.may_go_fast()?;
            }
            paced.limit_to_real_time();
        }
        let (takes, commands, requests) = orders(is_live);
        paced.add_commands(commands);
        paced.interventions.push(requests);
        let sink = if is_live { MqttSink::in_real_time(url) } else { MqttSink::new(url) };
        Ok(Some(Destination::own(url.to_string(), sink.with_orders(takes), policy())))
    }

    fn orders(is_live: bool) -> (TakesOrders, Receiver<RunCommand>, Receiver<InterventionRequest>) {
        let (say, commands) = sync_channel(MOST_WAITING);
        let (request, requests) = sync_channel(MOST_WAITING);
        let takes = move |order: Order, reply: Reply| match meant(order, is_live) {
            Err(message) => refuse(reply, message),
            Ok(OrderMeaning::Pace(command)) => match say.try_send(command) {
                Ok(()) => reply.done(),
                Err(_) => refuse(reply, OrderMessage::Busy),
            },
            Ok(OrderMeaning::Intervention(intervention)) => {
                // A full queue refuses the order as busy. If the run is over, the dropped answer says so.
                let answer = Box::new(move |outcome: Result<_, Refusal>| match outcome {
                    Ok(at) => reply.done_at(at),
                    Err(refusal) => reply.refused(refusal.why, refusal.hint),
                });
                if let Err(std::sync::mpsc::TrySendError::Full(InterventionRequest { answer, .. })) =
                    request.try_send(InterventionRequest { intervention, answer })
                {
                    answer(Err(OrderMessage::Busy.into()));
                }
            }
        };
        (Box::new(takes), commands, requests)
    }

    fn refuse(reply: Reply, message: OrderMessage) {
        let refusal = Refusal::from(message);
        reply.refused(refusal.why, refusal.hint)
    }

    /// The meaning of an order.
    enum OrderMeaning {
        Pace(RunCommand),
        Intervention(OrderedIntervention),
    }

    fn meant(order: Order, is_live: bool) -> Result<OrderMeaning, OrderMessage> {
        let minutes = |minutes: f64| Span::from_seconds(minutes * 60.0);
        Ok(OrderMeaning::Intervention(match order {
            Order::Pause {} => return Ok(OrderMeaning::Pace(RunCommand::Pause)),
            Order::Resume {} => return Ok(OrderMeaning::Pace(RunCommand::Resume)),
            Order::Step { seconds } => return Ok(OrderMeaning::Pace(RunCommand::Step(Span::from_seconds(seconds)))),
            Order::Stop {} => return Ok(OrderMeaning::Pace(RunCommand::Stop)),
            Order::Speed { times } if is_live && times > 1.0 => {
                return Err(OrderMessage::RealTime);
            }
            Order::Speed { times } => {
                let speed = Speed::times(times).ok_or(OrderMessage::Speed { times })?;
                return Ok(OrderMeaning::Pace(RunCommand::Speed(speed)));
            }
            Order::Open { thing } | Order::On { thing } => OrderedIntervention::Use { thing, on: true },
            Order::Close { thing } | Order::Off { thing } => OrderedIntervention::Use { thing, on: false },
            Order::Fault { sensor, kind, minutes: lasts, fading_minutes, every_s, loss } => {
                let failure = match kind {
                    OrderedFault::Dead => SensorFailure::Battery { fades_us: Span::ZERO },
                    OrderedFault::Battery => {
                        SensorFailure::Battery { fades_us: fading_minutes.map_or(Span::ZERO, minutes) }
                    }
                    OrderedFault::Stuck => SensorFailure::Stuck { every_us: every_s.map(Span::from_seconds) },
                    OrderedFault::FallsOff => SensorFailure::FallsOff,
                    OrderedFault::BadLink => {
                        SensorFailure::BadLink { lost_ppm: (loss.unwrap_or(1.0) * 1e6).round() as u32 }
                    }
                };
                OrderedIntervention::Fail { sensor, failure, lasts: lasts.map(minutes) }
            }
            Order::Fall { resident, minutes: lies } => OrderedIntervention::Fall { resident, lies: lies.map(minutes) },
        }))
    }

    #[cfg(test)]
    mod tests {
        use super::*;
        use homebody_core::time::MINUTE;

        fn command(order: Order, is_live: bool) -> Option<RunCommand> {
            match meant(order, is_live) {
                Ok(OrderMeaning::Pace(command)) => Some(command),
                _ => None,
            }
        }

        fn wish(order: serde_json::Value) -> OrderedIntervention {
            match meant(serde_json::from_value(order).expect("it is an order"), true) {
                Ok(OrderMeaning::Intervention(intervention)) => intervention,
                _ => panic!("no intervention"),
            }
        }

        #[test]
        fn orders_become_commands_and_interventions() {
            assert_eq!(command(Order::Step { seconds: 1.5 }, true), Some(RunCommand::Step(Span::from_millis(1500))));
            assert_eq!(command(Order::Speed { times: 0.5 }, true), Some(RunCommand::Speed(Speed::Times(0.5))));
            assert_eq!(command(Order::Speed { times: 2.0 }, true), None);
            assert_eq!(command(Order::Speed { times: 2.0 }, false), Some(RunCommand::Speed(Speed::Times(2.0))));
            let door = |on| OrderedIntervention::Use { thing: "door".into(), on };
            assert_eq!(wish(serde_json::json!({ "do": "open", "thing": "door" })), door(true));
            assert_eq!(wish(serde_json::json!({ "do": "off", "thing": "door" })), door(false));
            let fails = |failure, lasts| OrderedIntervention::Fail { sensor: "bed".into(), failure, lasts };
            for (order, failure, lasts) in [
                (serde_json::json!({ "kind": "dead" }), SensorFailure::Battery { fades_us: Span::ZERO }, None),
                (
                    serde_json::json!({ "kind": "battery", "fading_minutes": 2, "minutes": 3 }),
                    SensorFailure::Battery { fades_us: 2 * MINUTE },
                    Some(3 * MINUTE),
                ),
                (
                    serde_json::json!({ "kind": "stuck", "every_s": 7 }),
                    SensorFailure::Stuck { every_us: Some(Span::from_seconds(7.0)) },
                    None,
                ),
                (
                    serde_json::json!({ "kind": "bad_link", "loss": 0.25 }),
                    SensorFailure::BadLink { lost_ppm: 250_000 },
                    None,
                ),
            ] {
                let mut whole = order.clone();
                (whole["do"], whole["sensor"]) = ("fault".into(), "bed".into());
                assert_eq!(wish(whole), fails(failure, lasts), "{order}");
            }
            let fall = wish(serde_json::json!({ "do": "fall", "resident": "margaret", "minutes": 0.5 }));
            assert_eq!(fall, OrderedIntervention::Fall { resident: "margaret".into(), lies: Some(MINUTE / 2) });
        }
    }
}

#[cfg(not(feature = "mqtt"))]
mod built {
    use super::*;

    pub fn tidy_up(url: &Url, _: bool) -> Result<BrokerCleanup, SimulationError> {
        let row = url.scheme().row();
        let place = format!("{}://", row.name);
        Err(LogError::NotBuiltIn { place, name: row.name, feature: row.feature.unwrap_or(row.name) }.into())
    }

    pub fn destination(_: &Url, _: &mut PaceKeeper) -> Result<Option<Destination>, SimulationError> {
        Ok(None)
    }
}

/// Removes the retained messages of homes below the prefix of a place; with `only_look` they are only listed.
///
/// # Errors
///
/// [`SimulationError::Log`] if the place is not a broker, cannot be reached, or this build has no MQTT.
pub fn tidy_up(url: &Url, only_look: bool) -> Result<BrokerCleanup, SimulationError> {
    use homebody_core::scenario::scheme::{NoPlace, Scheme};
    match url.scheme() {
        Scheme::Mqtt | Scheme::Mqtts => built::tidy_up(url, only_look),
        scheme => {
            let what = format!("{}: is no broker", scheme.row().name);
            Err(LogError::NoPlace(NoPlace { what, hint: "write mqtt://HOST/PREFIX".into() }).into())
        }
    }
}

/// The destination of a broker, whose orders the run obeys; `None` for other places. A run that is faster than the broker allows is
/// refused; a slower one stays slow enough, whatever the orders.
pub(crate) fn destination(url: &Url, paced: &mut PaceKeeper) -> Result<Option<Destination>, SimulationError> {
    built::destination(url, paced)
}
