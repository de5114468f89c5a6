//! Brokers: places that are told what happens as it happens, and that may tell a run what to do.

use crate::error::Error;
use crate::pace::Paced;
use homebody_log::{Destination, LogError, Url};

/// What was found on a broker of homes of ours.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Tidied {
    /// The homes, by their topics.
    pub homes: Vec<String>,
    /// The topics of which the broker kept something.
    pub topics: Vec<String>,
    /// How many topics below the prefix are of nobody that we know: they stay.
    pub others: usize,
}

#[cfg(feature = "mqtt")]
mod built {
    use super::*;
    use crate::outside::{Asked, Failure, Refusal, Wish};
    use crate::pace::{Command, Speed};
    use crate::touched::OrderMessage;
    use homebody_core::time::micros;
    use homebody_mqtt::{Address, Kind, MqttSink, Order, Reply, TakesOrders, clean, policy};
    use std::sync::mpsc::{Receiver, sync_channel};

    /// Largest number of waiting commands (our choice).
    const MOST_WAITING: usize = 1000;

    pub fn tidy_up(url: &Url, only_look: bool) -> Result<Tidied, Error> {
        let cleaned = clean(url, only_look)?;
        Ok(Tidied { homes: cleaned.homes, topics: cleaned.topics, others: cleaned.others })
    }

    pub fn destination(url: &Url, paced: &mut Paced) -> Result<Option<Destination>, Error> {
        if !Address::is_of(url) {
            return Ok(None);
        }
        let address = Address::of(url)?;
        let is_live = !address.allow_fast;
        if is_live {
            if !paced.is_no_faster_than_life() {
                address.may_go_fast()?;
            }
            paced.keep_to_life();
        }
        let (takes, commands, asked) = orders(is_live);
        paced.hear(commands);
        paced.outside.push(asked);
        let sink = if is_live { MqttSink::live(url) } else { MqttSink::new(url) };
        Ok(Some(Destination::own(url.to_string(), sink.with_orders(takes), policy())))
    }

    /// Who takes orders for a run, and where they come out as what a run can be told, and as what is to be done to it.
    fn orders(is_live: bool) -> (TakesOrders, Receiver<Command>, Receiver<Asked>) {
        let (say, commands) = sync_channel(MOST_WAITING);
        let (ask, asked) = sync_channel(MOST_WAITING);
        let takes = move |order: Order, reply: Reply| match meant(order, is_live) {
            Err(message) => refuse(reply, message),
            Ok(Meant::Pace(command)) => match say.try_send(command) {
                Ok(()) => reply.done(),
                Err(_) => refuse(reply, OrderMessage::Busy),
            },
            Ok(Meant::Deed(wish)) => {
                // What has no room is told so, and what nobody hears any more, that the run is over.
                let answer = Box::new(move |outcome: Result<_, Refusal>| match outcome {
                    Ok(at) => reply.done_at(at),
                    Err(refusal) => reply.refused(refusal.why, refusal.hint),
                });
                if let Err(std::sync::mpsc::TrySendError::Full(Asked { answer, .. })) =
                    ask.try_send(Asked { wish, answer })
                {
                    answer(Err(OrderMessage::Busy.into()));
                }
            }
        };
        (Box::new(takes), commands, asked)
    }

    fn refuse(reply: Reply, message: OrderMessage) {
        let refusal = Refusal::from(message);
        reply.refused(refusal.why, refusal.hint)
    }

    /// What an order means to a run.
    enum Meant {
        Pace(Command),
        Deed(Wish),
    }

    fn meant(order: Order, is_live: bool) -> Result<Meant, OrderMessage> {
        let minutes = |minutes: f64| micros(minutes * 60.0);
        Ok(Meant::Deed(match order {
            Order::Pause {} => return Ok(Meant::Pace(Command::Pause)),
            Order::Resume {} => return Ok(Meant::Pace(Command::Resume)),
            Order::Step { seconds } => return Ok(Meant::Pace(Command::Step(micros(seconds)))),
            Order::Stop {} => return Ok(Meant::Pace(Command::Stop)),
            Order::Speed { times } if is_live && times > 1.0 => {
                return Err(OrderMessage::RealTime);
            }
            Order::Speed { times } => {
                let speed = Speed::times(times).ok_or(OrderMessage::Speed { times })?;
                return Ok(Meant::Pace(Command::Speed(speed)));
            }
            Order::Open { thing } | Order::On { thing } => Wish::Use { thing, on: true },
            Order::Close { thing } | Order::Off { thing } => Wish::Use { thing, on: false },
            Order::Fault { sensor, kind, minutes: lasts, fading_minutes, every_s, loss } => {
                let failure = match kind {
                    Kind::Dead => Failure::Battery { fades_us: 0 },
                    Kind::Battery => Failure::Battery { fades_us: fading_minutes.map_or(0, minutes) },
                    Kind::Stuck => Failure::Stuck { every_us: every_s.map(micros) },
                    Kind::FallsOff => Failure::FallsOff,
                    Kind::BadLink => Failure::BadLink { lost_ppm: (loss.unwrap_or(1.0) * 1e6).round() as u32 },
                };
                Wish::Fail { sensor, failure, lasts: lasts.map(minutes) }
            }
            Order::Fall { resident, minutes: lies } => Wish::Fall { resident, lies: lies.map(minutes) },
        }))
    }

    #[cfg(test)]
    mod tests {
        use super::*;

        fn command(order: Order, is_live: bool) -> Option<Command> {
            match meant(order, is_live) {
                Ok(Meant::Pace(command)) => Some(command),
                _ => None,
            }
        }

        fn wish(order: serde_json::Value) -> Wish {
            match meant(serde_json::from_value(order).expect("it is an order"), true) {
                Ok(Meant::Deed(wish)) => wish,
                _ => panic!("no deed"),
            }
        }

        #[test]
        fn a_run_is_told_what_orders_mean() {
            assert_eq!(command(Order::Step { seconds: 1.5 }, true), Some(Command::Step(1_500_000)));
            assert_eq!(command(Order::Speed { times: 0.5 }, true), Some(Command::Speed(Speed::Times(0.5))));
            assert_eq!(command(Order::Speed { times: 2.0 }, true), None);
            assert_eq!(command(Order::Speed { times: 2.0 }, false), Some(Command::Speed(Speed::Times(2.0))));
            let door = |on| Wish::Use { thing: "door".into(), on };
            assert_eq!(wish(serde_json::json!({ "do": "open", "thing": "door" })), door(true));
            assert_eq!(wish(serde_json::json!({ "do": "off", "thing": "door" })), door(false));
            let fails = |failure, lasts| Wish::Fail { sensor: "bed".into(), failure, lasts };
            for (order, failure, lasts) in [
                (serde_json::json!({ "kind": "dead" }), Failure::Battery { fades_us: 0 }, None),
                (
                    serde_json::json!({ "kind": "battery", "fading_minutes": 2, "minutes": 3 }),
                    Failure::Battery { fades_us: 120_000_000 },
                    Some(180_000_000),
                ),
                (
                    serde_json::json!({ "kind": "stuck", "every_s": 7 }),
                    Failure::Stuck { every_us: Some(7_000_000) },
                    None,
                ),
                (serde_json::json!({ "kind": "bad_link", "loss": 0.25 }), Failure::BadLink { lost_ppm: 250_000 }, None),
            ] {
                let mut whole = order.clone();
                (whole["do"], whole["sensor"]) = ("fault".into(), "bed".into());
                assert_eq!(wish(whole), fails(failure, lasts), "{order}");
            }
            let fall = wish(serde_json::json!({ "do": "fall", "resident": "margaret", "minutes": 0.5 }));
            assert_eq!(fall, Wish::Fall { resident: "margaret".into(), lies: Some(30_000_000) });
        }
    }
}

#[cfg(not(feature = "mqtt"))]
mod built {
    use super::*;

    pub fn tidy_up(url: &Url, _: bool) -> Result<Tidied, Error> {
        let row = url.scheme().row();
        let place = format!("{}://", row.name);
        Err(LogError::NotBuiltIn { place, name: row.name, feature: row.feature.unwrap_or(row.name) }.into())
    }

    pub fn destination(_: &Url, _: &mut Paced) -> Result<Option<Destination>, Error> {
        Ok(None)
    }
}

/// Removes what a broker keeps of homes of ours below the prefix of a place; with `only_look` it is told and stays.
///
/// # Errors
///
/// [`Error::Log`] if the place is no broker, cannot be reached, or this build has no MQTT.
pub fn tidy_up(url: &Url, only_look: bool) -> Result<Tidied, Error> {
    use homebody_core::scenario::scheme::{NoPlace, Scheme};
    match url.scheme() {
        Scheme::Mqtt | Scheme::Mqtts => built::tidy_up(url, only_look),
        scheme => {
            let what = format!("{}: is no broker", scheme.row().name);
            Err(LogError::NoPlace(NoPlace { what, hint: "write mqtt://HOST/PREFIX".into() }).into())
        }
    }
}

/// The destination of a broker, which the run hears; None for places that are none. A run that is faster than it may be told is
/// refused; one that is not stays so, whatever it is told.
pub(crate) fn destination(url: &Url, paced: &mut Paced) -> Result<Option<Destination>, Error> {
    built::destination(url, paced)
}
