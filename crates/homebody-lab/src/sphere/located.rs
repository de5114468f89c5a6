//! The person of a recording, located by the real sensors alone.

use super::{AnnotatedRun, at_moment};
use crate::locating::score;
use crate::locating::truth::{MessagesWithTruth, PersonPlace};
use homebody_core::scenario::load::Scenario;
use homebody_core::time::{RunTime, SECOND, Span};
use homebody_infer::{LogMessage, MessageKind, Senses};
use serde::Serialize;

#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct LocatedRecording {
    pub room_right: f64,
    /// The same, by the room of the last firing.
    pub last_firing_right: f64,
    /// The same, by a hidden Markov model that knows rooms alone.
    pub rooms_only_right: f64,
    /// Share of the stays of 10 s or longer whose room was found at some time.
    pub visits_found: f64,
    /// Share of ON messages from rooms without the person: of another person, or late.
    pub said_elsewhere: f64,
}

pub(crate) fn locate_recording(
    run: &AnnotatedRun,
    house: &Scenario,
    bodies: &[Senses],
    rooms: &[String],
) -> LocatedRecording {
    let plan = house.home.plan();
    let index_of = |room: &str| plan.rooms.iter().position(|one| one.name == room);
    let begin_s = run.begin_s();
    let seconds = (run.end_s() - begin_s).max(0.0) as usize;
    let mut messages: Vec<LogMessage> = Vec::new();
    for interval in &run.pir {
        if let Some(sensor) = rooms.iter().position(|room| *room == interval.name) {
            let at = |second: f64| RunTime::START + Span::from_seconds((second - begin_s).max(0.0));
            messages.push(LogMessage { at: at(interval.start_s), sensor, said: MessageKind::On });
            messages.push(LogMessage { at: at(interval.end_s), sensor, said: MessageKind::Off });
        }
    }
    messages.sort_by_key(|message| message.at);
    let place = |second: usize| {
        let room = at_moment(&run.rooms, begin_s + second as f64 + 0.5).and_then(index_of);
        room.map_or(PersonPlace::Between, PersonPlace::Room)
    };
    let simulated = MessagesWithTruth {
        messages,
        room_of: rooms.iter().map(|room| index_of(room)).collect(),
        residents: 1,
        places: vec![(0..seconds).map(place).collect()],
        at: vec![vec![None; seconds]],
    };
    let judge = score(bodies, &simulated, &[0], plan.rooms.len());
    let place_at = |at: RunTime| simulated.places[0].get((at.since_zero() / SECOND) as usize);
    let elsewhere = |message: &&LogMessage| match (place_at(message.at), simulated.room_of[message.sensor]) {
        (Some(PersonPlace::Room(room)), Some(own)) => *room != own,
        _ => false,
    };
    let begins: Vec<&LogMessage> =
        simulated.messages.iter().filter(|message| message.said == MessageKind::On).collect();
    let said_elsewhere = begins.iter().copied().filter(|message| elsewhere(message)).count();
    let share = |right: u64| right as f64 / judge.seconds.max(1) as f64;
    LocatedRecording {
        room_right: share(judge.right),
        last_firing_right: share(judge.last_right),
        rooms_only_right: share(judge.rooms_right),
        visits_found: judge.found as f64 / judge.visits.max(1) as f64,
        said_elsewhere: said_elsewhere as f64 / begins.len().max(1) as f64,
    }
}
