//! Where the person of a recording was, by the real sensors alone.

use super::{AnnotatedRun, at_moment};
use crate::walk_back::judged;
use crate::walk_back::lived::{Lived, Place};
use homebody_core::scenario::load::Scenario;
use homebody_core::time::{Micros, SECOND, micros};
use homebody_infer::{Message, Said, Senses};
use serde::Serialize;

/// How a recording was walked back through the plan.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct WalkedBack {
    /// Share of the annotated time in which the right room was told.
    pub room_right: f64,
    /// The same, of the room of the sensor that fired last.
    pub last_firing_right: f64,
    /// The same, of a hidden Markov model that knows rooms alone.
    pub rooms_only_right: f64,
    /// Share of the stays of 10 s or longer in a room in which that room was told at some time.
    pub visits_found: f64,
    /// Share of the sensors' ON messages that came from other rooms than the person's: of somebody else, or late.
    pub said_elsewhere: f64,
}

/// Walks a recording back, as of one person alone.
pub(crate) fn walked_back(run: &AnnotatedRun, house: &Scenario, bodies: &[Senses], rooms: &[String]) -> WalkedBack {
    let plan = house.home.plan();
    let index_of = |room: &str| plan.rooms.iter().position(|one| one.name == room);
    let begin_s = run.begin_s();
    let seconds = (run.end_s() - begin_s).max(0.0) as usize;
    let mut messages: Vec<Message> = Vec::new();
    for interval in &run.pir {
        if let Some(sensor) = rooms.iter().position(|room| *room == interval.name) {
            let at = |second: f64| micros((second - begin_s).max(0.0));
            messages.push(Message { at: at(interval.start_s), sensor, said: Said::On });
            messages.push(Message { at: at(interval.end_s), sensor, said: Said::Off });
        }
    }
    messages.sort_by_key(|message| message.at);
    let place = |second: usize| {
        let room = at_moment(&run.rooms, begin_s + second as f64 + 0.5).and_then(index_of);
        room.map_or(Place::Between, Place::Room)
    };
    let lived = Lived {
        messages,
        room_of: rooms.iter().map(|room| index_of(room)).collect(),
        residents: 1,
        places: vec![(0..seconds).map(place).collect()],
        at: vec![vec![None; seconds]],
    };
    let judge = judged(bodies, &lived, &[0], plan.rooms.len());
    let place_at = |at: Micros| lived.places[0].get((at / SECOND) as usize);
    let elsewhere = |message: &&Message| match (place_at(message.at), lived.room_of[message.sensor]) {
        (Some(Place::Room(room)), Some(own)) => *room != own,
        _ => false,
    };
    let begins: Vec<&Message> = lived.messages.iter().filter(|message| message.said == Said::On).collect();
    let said_elsewhere = begins.iter().copied().filter(|message| elsewhere(message)).count();
    let share = |right: u64| right as f64 / judge.seconds.max(1) as f64;
    WalkedBack {
        room_right: share(judge.right),
        last_firing_right: share(judge.last_right),
        rooms_only_right: share(judge.rooms_right),
        visits_found: judge.found as f64 / judge.visits.max(1) as f64,
        said_elsewhere: said_elsewhere as f64 / begins.len().max(1) as f64,
    }
}
