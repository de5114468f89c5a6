//! Orders to a home, as JSON messages on its topic `command`: `{"do": "pause"}`.
//!
//! Each order is answered on `command/result`, with its `id` if it has one. A retained order, one that is not understood and one that
//! names a part that the home lacks are refused.

use homebody_core::nearest::nearest;
use homebody_core::problem::readable;
use homebody_core::time::RunTime;
use homebody_log::RunInfo;
use homebody_log::table::InstantWriter;
use serde::Deserialize;
use serde_json::{Value, json};

/// Longest command (our choice).
const LONGEST_BYTES: usize = 4096;

/// An order to a run.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(tag = "do", rename_all = "snake_case", deny_unknown_fields)]
pub enum Order {
    /// Go no further.
    Pause {},
    Resume {},
    /// Go on by so many seconds, then pause.
    Step {
        seconds: f64,
    },
    /// Go on at this many times the pace of life.
    Speed {
        times: f64,
    },
    /// End the run here.
    Stop {},
    /// Open a door or a piece of furniture.
    Open {
        thing: String,
    },
    Close {
        thing: String,
    },
    /// Turn a thing on.
    On {
        thing: String,
    },
    Off {
        thing: String,
    },
    /// A sensor has a fault from now on.
    Fault {
        sensor: String,
        /// Which fault, as a link file calls it; `dead` is an empty battery.
        kind: OrderedFault,
        /// The length of the fault; by default to the end of the run.
        minutes: Option<f64>,
        /// Of a battery: how long it fades before it is empty.
        fading_minutes: Option<f64>,
        /// Of one that is stuck: how often it says again what it said last.
        every_s: Option<f64>,
        /// Of a bad link: which share of its messages is lost; all without this.
        loss: Option<f64>,
    },
    /// A resident falls now.
    Fall {
        resident: String,
        /// The time on the floor.
        minutes: Option<f64>,
    },
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum OrderedFault {
    /// Its battery is empty.
    Dead,
    Battery,
    /// It hears nothing any more.
    Stuck,
    /// It has come off its place.
    FallsOff,
    /// Its messages are lost on the way.
    BadLink,
}

/// Obeys orders or refuses them. It is called on the connection's own thread, so it must not wait: the answer may come later, from any
/// thread.
pub type TakesOrders = Box<dyn FnMut(Order, Reply) + Send>;

/// Takes the outcome of an order, once. If it is dropped before, the run has ended.
pub struct Reply(Option<Box<dyn FnOnce(Outcome) + Send>>);

/// The outcome of an order.
pub(crate) type Outcome = Result<Option<RunTime>, (String, String)>;

impl Reply {
    pub(crate) fn new(tell: impl FnOnce(Outcome) + Send + 'static) -> Reply {
        Reply(Some(Box::new(tell)))
    }

    pub fn done(self) {
        self.tell(Ok(None));
    }

    /// It was obeyed when the run had come to this instant.
    pub fn done_at(self, at: RunTime) {
        self.tell(Ok(Some(at)));
    }

    /// It was not, for a reason; a hint says what to do instead, and may be empty.
    pub fn refused(self, why: impl Into<String>, hint: impl Into<String>) {
        self.tell(Err((why.into(), hint.into())));
    }

    fn tell(mut self, outcome: Outcome) {
        if let Some(tell) = self.0.take() {
            tell(outcome);
        }
    }
}

impl Drop for Reply {
    fn drop(&mut self) {
        if let Some(tell) = self.0.take() {
            tell(Err(("the run ended before it was done".into(), String::new())));
        }
    }
}

impl std::fmt::Debug for Reply {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str("Reply")
    }
}

/// The parts of an order that its answer repeats.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct OrderRequest {
    id: Option<Value>,
    what: Option<Value>,
}

impl OrderRequest {
    /// The answer as JSON, with the instant on the clock of the run.
    pub fn answer(self, outcome: &Outcome, clock: &mut InstantWriter) -> String {
        let mut answer = json!({ "id": self.id, "do": self.what, "ok": outcome.is_ok() });
        match outcome {
            Ok(Some(at)) => answer["sim_time"] = clock.text(*at).into(),
            Ok(None) => {}
            Err((why, hint)) => {
                answer["why"] = readable(why.clone()).into();
                if !hint.is_empty() {
                    answer["hint"] = readable(hint.clone()).into();
                }
            }
        }
        answer.to_string()
    }
}

/// Reads an order, or why it cannot be obeyed.
pub(crate) fn heard(payload: &[u8], is_kept: bool, run: &RunInfo) -> (OrderRequest, Result<Order, String>) {
    if is_kept {
        let why = "a message that the broker keeps is no order: it would be obeyed at every beginning";
        return (OrderRequest { id: None, what: None }, Err(why.into()));
    }
    let (id, what, order) = understood(payload);
    (OrderRequest { id, what }, order.and_then(|order| known(&order, run).map(|()| order)))
}

/// Reads an order from a message.
///
/// # Errors
///
/// The reason for the sender, if it is not an order.
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

/// Largest number of minutes: a hundred years, the longest run.
const LONGEST_MIN: f64 = 52_594_920.0;

/// Numbers that can be meant.
fn possible(order: Order) -> Result<Order, String> {
    match order {
        Order::Step { seconds } if !(seconds > 0.0 && seconds < 1e9) => Err("seconds is no number above 0".into()),
        Order::Speed { times } if !(0.1..=1000.0).contains(&times) => Err("times is no number from 0.1 to 1000".into()),
        Order::Fall { minutes: Some(minutes), .. } if !(0.02..=1440.0).contains(&minutes) => {
            Err("minutes is no number from 0.02 to 1440".into())
        }
        Order::Fault { kind, minutes, fading_minutes, every_s, loss, .. } => {
            let wrong = [
                (
                    minutes.is_some_and(|minutes| !(minutes > 0.0 && minutes <= LONGEST_MIN)),
                    "minutes is no number above 0",
                ),
                (
                    fading_minutes.is_some_and(|minutes| {
                        kind != OrderedFault::Battery || !(0.0..=LONGEST_MIN).contains(&minutes)
                    }),
                    "fading_minutes is a number from 0 on, and of a battery",
                ),
                (
                    every_s.is_some_and(|every| kind != OrderedFault::Stuck || !(0.1..=86_400.0).contains(&every)),
                    "every_s is a number from 0.1 to 86400, and of a sensor that is stuck",
                ),
                (
                    loss.is_some_and(|loss| kind != OrderedFault::BadLink || !(0.0..=1.0).contains(&loss)),
                    "loss is a number from 0 to 1, and of a bad_link",
                ),
            ];
            wrong.iter().find(|(is_wrong, _)| *is_wrong).map_or(Ok(order), |(_, why)| Err((*why).into()))
        }
        order => Ok(order),
    }
}

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
        Order::Fall { resident, .. } => among("resident", resident, &run.residents),
        _ => Ok(()),
    }
}
