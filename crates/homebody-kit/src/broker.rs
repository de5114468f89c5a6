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
    use crate::pace::{Command, Speed};
    use homebody_core::time::micros;
    use homebody_mqtt::{Address, MqttSink, Order, TakesOrders, clean, policy};
    use std::sync::mpsc::{Receiver, sync_channel};

    /// So many orders wait to be done (ours).
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
        let (takes, commands) = orders(is_live);
        paced.hear(commands);
        let sink = if is_live { MqttSink::live(url) } else { MqttSink::new(url) };
        Ok(Some(Destination::own(url.to_string(), sink.with_orders(takes), policy())))
    }

    /// Who takes orders for a run, and where they come out as what a run can be told.
    fn orders(is_live: bool) -> (TakesOrders, Receiver<Command>) {
        let (say, commands) = sync_channel(MOST_WAITING);
        let takes = move |order: &Order| {
            let command = match *order {
                Order::Pause {} => Command::Pause,
                Order::Resume {} => Command::Resume,
                Order::Step { seconds } => Command::Step(micros(seconds)),
                Order::Speed { times } if is_live && times > 1.0 => {
                    return Err("this broker is told at the pace of life: times is at most 1".into());
                }
                Order::Speed { times } => Command::Speed(Speed::times(times).ok_or("no run goes at this speed")?),
                Order::Stop {} => Command::Stop,
                Order::Open { .. } | Order::Close { .. } | Order::On { .. } | Order::Off { .. } => {
                    return Err("what is used in this run is decided by who lives there".into());
                }
                Order::Fault { .. } => return Err("the faults of this run are those of its link file".into()),
                Order::Fall { .. } => return Err("what happens to who lives there is in their routine".into()),
            };
            say.try_send(command).map_err(|_| "the run has not done yet what it was told before".into())
        };
        (Box::new(takes), commands)
    }

    #[cfg(test)]
    mod tests {
        use super::*;

        #[test]
        fn a_run_is_told_what_it_can_do_and_the_rest_is_refused() {
            let (mut takes, commands) = orders(true);
            for order in [Order::Pause {}, Order::Resume {}, Order::Step { seconds: 1.5 }, Order::Speed { times: 0.5 }]
            {
                assert_eq!(takes(&order), Ok(()));
            }
            assert_eq!(takes(&Order::Stop {}), Ok(()));
            let said: Vec<Command> = commands.try_iter().collect();
            let step = Command::Step(1_500_000);
            assert_eq!(said, [Command::Pause, Command::Resume, step, Command::Speed(Speed::Times(0.5)), Command::Stop]);
            let (thing, sensor, resident) = ("stove".to_owned(), "bed".to_owned(), "margaret".to_owned());
            for order in [
                Order::Open { thing },
                Order::Fault { sensor, kind: "dead".into() },
                Order::Fall { resident },
                Order::Speed { times: 2.0 },
            ] {
                assert!(takes(&order).is_err(), "{order:?}");
            }
            assert_eq!(commands.try_iter().count(), 0);
            let (mut takes, commands) = orders(false);
            assert!(takes(&Order::Speed { times: 2.0 }).is_ok());
            drop(commands);
            assert!(takes(&Order::Speed { times: 2.0 }).is_err(), "nobody is there to be told");
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
