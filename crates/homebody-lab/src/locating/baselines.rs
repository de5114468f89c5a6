//! Two simpler methods for comparison, which know rooms only.

use super::truth::{MessagesWithTruth, PersonPlace, second_begins};
use homebody_core::time::SECOND;
use homebody_infer::MessageKind;

/// By second: the rooms of the sensors that fired last, one for each person.
pub(crate) fn last_firing(simulated: &MessagesWithTruth, people: usize) -> Vec<Vec<PersonPlace>> {
    let seconds = simulated.places.first().map_or(0, Vec::len);
    let mut recent: Vec<PersonPlace> = Vec::new();
    let mut messages = simulated.messages.iter().peekable();
    let mut rooms = Vec::with_capacity(seconds);
    for second in 0..seconds {
        while let Some(message) = messages.next_if(|message| message.at <= second_begins(second)) {
            if let Some(room) = simulated.room_of[message.sensor].filter(|_| message.said != MessageKind::Off) {
                recent.retain(|one| *one != PersonPlace::Room(room));
                recent.insert(0, PersonPlace::Room(room));
                recent.truncate(people);
            }
        }
        rooms.push(recent.clone());
    }
    rooms
}

/// Duration of one look at the home, in seconds (our choice).
const LOOK_S: usize = 10;
/// Probabilities of a firing in a look (our choice): in the person's own room, in another room, and while the person is
/// out. Of six sets of values, these do best with this model in these homes.
const SEEN: f64 = 0.01;
const SEEN_ELSEWHERE: f64 = 0.0005;
const SEEN_OUT: f64 = 0.0001;
/// Probability of the same room in the next look (our choice, selected in the same way).
const STAYS: f64 = 0.999;

/// By second: the room by a hidden Markov model that knows the sensors of each room and no more. Its states are the rooms and
/// being out; it observes whether sensors of each room fired within ten seconds. Several people all get the same room.
pub(crate) fn rooms_only(simulated: &MessagesWithTruth, rooms: usize, people: usize) -> Vec<Vec<PersonPlace>> {
    let seconds = simulated.places.first().map_or(0, Vec::len);
    let looks = seconds.div_ceil(LOOK_S);
    let mut fired = vec![vec![false; rooms]; looks];
    for message in simulated.messages.iter().filter(|message| message.said != MessageKind::Off) {
        let look = (message.at.since_zero() / SECOND) as usize / LOOK_S;
        if let Some(room) = simulated.room_of[message.sensor].filter(|_| look < looks) {
            fired[look][room] = true;
        }
    }
    // The last state is being out.
    let states = rooms + 1;
    let chance = |state: usize, look: &[bool]| -> f64 {
        let of = |(room, &fired): (usize, &bool)| {
            let seen = match state {
                _ if state == rooms => SEEN_OUT,
                _ if state == room => SEEN,
                _ => SEEN_ELSEWHERE,
            };
            if fired { seen } else { 1.0 - seen }
        };
        look.iter().enumerate().map(of).product()
    };
    let leaves = (1.0 - STAYS) / states as f64;
    let step = |before: &[f64]| -> Vec<f64> {
        let all: f64 = before.iter().sum();
        before.iter().map(|one| one * STAYS + all * leaves).collect()
    };
    let mut ahead: Vec<Vec<f64>> = Vec::with_capacity(looks);
    let mut now = vec![1.0; states];
    for look in &fired {
        now = normal(step(&now).iter().enumerate().map(|(state, one)| one * chance(state, look)).collect());
        ahead.push(now.clone());
    }
    let mut located = vec![PersonPlace::Out; looks];
    let mut after = vec![1.0; states];
    for look in (0..looks).rev() {
        let both = |state: &usize| ahead[look][*state] * after[*state];
        let best = (0..states).max_by(|a, b| both(a).total_cmp(&both(b))).unwrap_or(rooms);
        located[look] = if best == rooms { PersonPlace::Out } else { PersonPlace::Room(best) };
        after = normal(step(
            &after.iter().enumerate().map(|(state, one)| one * chance(state, &fired[look])).collect::<Vec<f64>>(),
        ));
    }
    (0..seconds).map(|second| vec![located[second / LOOK_S]; people]).collect()
}

fn normal(mut chances: Vec<f64>) -> Vec<f64> {
    let sum: f64 = chances.iter().sum();
    chances.iter_mut().for_each(|chance| *chance /= sum);
    chances
}
