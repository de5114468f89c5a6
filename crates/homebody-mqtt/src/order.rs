//! What a home is told by messages on its own topic `command`, as JSON: `{"do": "pause"}`.
//!
//! Each order is answered on `command/result`, with its `id` if it has one. What is kept by the broker from before, is not
//! understood or names what the home does not have is not obeyed.

use homebody_core::problem::readable;
use homebody_core::scenario::nearest::nearest;
use homebody_log::RunInfo;
use serde::Deserialize;
use serde_json::{Value, json};

/// An order is no longer (ours).
const LONGEST_BYTES: usize = 4096;

/// What a run is asked for.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(tag = "do", rename_all = "snake_case", deny_unknown_fields)]
pub enum Order {
    /// Go no further.
    Pause {},
    /// Go on.
    Resume {},
    /// Go on by so many seconds, then pause.
    Step {
        /// How many.
        seconds: f64,
    },
    /// Go on at this many times the pace of life.
    Speed {
        /// How many.
        times: f64,
    },
    /// End the run here.
    Stop {},
    /// Open a door or a piece of furniture.
    Open {
        /// Its name.
        thing: String,
    },
    /// Close it.
    Close {
        /// Its name.
        thing: String,
    },
    /// Turn a thing on.
    On {
        /// Its name.
        thing: String,
    },
    /// Turn it off.
    Off {
        /// Its name.
        thing: String,
    },
    /// A sensor has a fault from now on.
    Fault {
        /// Its name.
        sensor: String,
        /// Which fault, as a link file calls it.
        kind: String,
    },
    /// A resident falls now.
    Fall {
        /// Their name.
        resident: String,
    },
}

/// Who obeys orders, or says why not. It is called on the connection's own thread, so it must not wait.
pub type TakesOrders = Box<dyn FnMut(&Order) -> Result<(), String> + Send>;

/// What becomes of an order.
pub(crate) struct Answer {
    /// For the topic of results.
    pub payload: String,
    /// The order, if it was obeyed.
    pub obeyed: Option<Order>,
}

/// Hears an order, has it obeyed, and says what has become of it.
pub(crate) fn answer(payload: &[u8], is_kept: bool, run: &RunInfo, takes: Option<&mut TakesOrders>) -> Answer {
    let (id, what, order) = match is_kept {
        true => (
            None,
            None,
            Err("a message that the broker keeps is no order: it would be obeyed at every beginning".into()),
        ),
        false => understood(payload),
    };
    let done = order.and_then(|order| {
        known(&order, run)?;
        let takes = takes.ok_or("this run takes no orders")?;
        takes(&order).map(|()| order)
    });
    let mut answer = json!({ "id": id, "do": what, "ok": done.is_ok() });
    if let Err(why) = &done {
        answer["why"] = readable(why.clone()).into();
    }
    Answer { payload: answer.to_string(), obeyed: done.ok() }
}

/// The order that a message is.
///
/// # Errors
///
/// Why it is none, in words for whoever has sent it.
pub fn order_of(payload: &[u8]) -> Result<Order, String> {
    understood(payload).2.map_err(readable)
}

/// The order's id, its word, and the order.
fn understood(payload: &[u8]) -> (Option<Value>, Option<Value>, Result<Order, String>) {
    if payload.len() > LONGEST_BYTES {
        return (None, None, Err(format!("no order is longer than {LONGEST_BYTES} bytes")));
    }
    let mut value: Value = match serde_json::from_slice(payload) {
        Ok(value) => value,
        Err(why) => return (None, None, Err(format!("this is no JSON: {why}"))),
    };
    let id = value.as_object_mut().and_then(|order| order.remove("id"));
    // An answer repeats what can be an id, and no more.
    let id = id.filter(|id| id.is_number() || id.as_str().is_some_and(|id| id.len() <= 100));
    let what = value.get("do").filter(|what| what.as_str().is_some_and(|what| what.len() <= 100)).cloned();
    let order = serde_json::from_value(value).map_err(|why| format!("this is no order: {why}")).and_then(possible);
    (id, what, order)
}

/// Numbers that can be meant.
fn possible(order: Order) -> Result<Order, String> {
    match order {
        Order::Step { seconds } if !(seconds > 0.0 && seconds < 1e9) => Err("seconds is no number above 0".into()),
        Order::Speed { times } if !(0.1..=1000.0).contains(&times) => Err("times is no number from 0.1 to 1000".into()),
        order => Ok(order),
    }
}

/// Whether the home has what is named.
fn known(order: &Order, run: &RunInfo) -> Result<(), String> {
    let among = |what: &str, name: &String, known: &[String]| match known.contains(name) {
        true => Ok(()),
        false => Err(match nearest(name, known.iter().map(String::as_str)) {
            Some(near) => format!("there is no {what} {name:?}; did you mean {near:?}?"),
            None => format!("there is no {what} {name:?}"),
        }),
    };
    match order {
        Order::Open { thing } | Order::Close { thing } | Order::On { thing } | Order::Off { thing } => {
            among("thing", thing, &run.things)
        }
        Order::Fault { sensor, .. } => among("sensor", sensor, &run.sensor_names()),
        Order::Fall { resident } => among("resident", resident, &run.residents),
        _ => Ok(()),
    }
}
