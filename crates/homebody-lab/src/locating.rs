//! Residents located from the log of their home alone, compared with the ground truth and with two baselines.
//!
//! The inference gets the log of a simulated scenario. It knows the home but no routines. Each second of each person counts, except for
//! seconds between two rooms, as in a door. Sensors do not identify people, so with several people the located rooms are compared with the
//! occupied rooms, in any order.

mod baselines;
pub(crate) mod truth;

use baselines::{last_firing, rooms_only};
use homebody_core::geometry::Point;
use homebody_core::link::form::LinkFile;
use homebody_core::time::{DAY, RunTime, SECOND, Span};
use homebody_infer::{InstantEstimate, LogMessage, Senses, fault_intervals, follow, translate};
use serde::Serialize;
pub use truth::{LocatingError, SimulatedHome};
use truth::{MessagesWithTruth, PersonPlace, second_begins};

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LocatingCase {
    pub home: String,
    pub seed: u64,
    pub residents: usize,
    pub faults: bool,
    pub messages: usize,
    /// Share of the time with the right room; outdoors counts as a room.
    pub room_right: f64,
    /// The same, with the messages until each moment only.
    pub room_right_live: f64,
    /// Share of the stays of 10 s or longer whose room was found at some time.
    pub visits_found: f64,
    /// Median distance from the true position, in metres, while the person is at home; `None` with several residents.
    pub p50_m: Option<f64>,
    /// The distance that is not exceeded in 9 of 10 seconds.
    pub p90_m: Option<f64>,
    /// Share of the time with the right room by the last firing; with several people, by the last rooms that fired.
    pub last_firing_right: f64,
    /// Share of the time with the right room by a hidden Markov model that knows rooms alone.
    pub rooms_only_right: f64,
    /// Share of the time of visits in which another person was found; `None` without visitors or with several residents.
    pub visitors_found: Option<f64>,
    /// Share of the other time in which a person was found who was not there.
    pub visitors_invented: Option<f64>,
}

/// Interval between questions about the present state (our choice).
const ASKED: Span = SECOND.times(30);
/// Stay below which a person only passes through a room (our choice).
const VISIT: Span = SECOND.times(10);

pub fn case(home: &SimulatedHome, seed: u64, days: u32) -> Result<LocatingCase, LocatingError> {
    let scenario = home.scenario;
    let length = i64::from(days) * DAY;
    let residents = scenario.residents.len();
    let mut bodies = (0..residents).map(|body| Senses::learn(scenario, body)).collect::<Result<Vec<_>, _>>()?;
    // A single resident may have a visitor; with two residents, the model has no room for a third person.
    let has_visitor = residents == 1;
    if has_visitor {
        bodies.push(bodies[0].for_visitor());
    }
    let simulated = MessagesWithTruth::simulate(home, seed, length)?;
    let mut judge = score(&bodies, &simulated, &home.people, scenario.home.plan().rooms.len());
    let visitors = has_visitor.then_some(judge.visitors);
    let part = |[missed, located]: [u64; 2]| (missed + located > 0).then(|| located as f64 / (missed + located) as f64);
    judge.distances_m.sort_by(f64::total_cmp);
    let distance = |share: f64| {
        let place = (judge.distances_m.len() as f64 * share) as usize;
        judge.distances_m.get(place).copied()
    };
    let share = |right: u64| right as f64 / judge.seconds as f64;
    Ok(LocatingCase {
        home: scenario.file.name.clone(),
        seed,
        residents: home.people.len(),
        faults: scenario.link.as_ref().is_some_and(|link| *link != LinkFile::default()),
        messages: simulated.messages.len(),
        room_right: share(judge.right),
        room_right_live: share(judge.live_right),
        visits_found: judge.found as f64 / (judge.visits.max(1)) as f64,
        p50_m: distance(0.5),
        p90_m: distance(0.9),
        last_firing_right: share(judge.last_right),
        rooms_only_right: share(judge.rooms_right),
        visitors_found: visitors.and_then(|visitors| part(visitors[1])),
        visitors_invented: visitors.and_then(|visitors| part(visitors[0])),
    })
}

/// Locates the people of a log, and compares each second with the truth.
pub(crate) fn score<'a>(
    bodies: &[Senses],
    simulated: &MessagesWithTruth,
    people: &'a [usize],
    rooms: usize,
) -> LocatingScore<'a> {
    let seconds = simulated.places.first().map_or(0, Vec::len);
    let located = located(bodies, simulated, second_begins(seconds));
    let mut judge = LocatingScore::new(people);
    let live = located_live(bodies, simulated);
    let (mut place, mut live_place) = (0, 0);
    let last = last_firing(simulated, people.len());
    let rooms = rooms_only(simulated, rooms, people.len());
    for second in 0..seconds {
        let at = second_begins(second);
        while place + 1 < located.len() && located[place].0 + (located[place + 1].0 - located[place].0) / 2 <= at {
            place += 1;
        }
        while live_place + 1 < live.len() && live[live_place + 1].0 <= at {
            live_place += 1;
        }
        let located_so_far = live.get(live_place).map_or(&[][..], |located| &located.1);
        judge.add_second(simulated, second, [&located[place].1, located_so_far], &last[second], &rooms[second]);
    }
    judge
}

type LocatedInstant = (RunTime, Vec<(PersonPlace, Option<Point>)>);

fn located(bodies: &[Senses], simulated: &MessagesWithTruth, end: RunTime) -> Vec<LocatedInstant> {
    let mut located = Vec::new();
    let messages = || simulated.messages.iter().copied();
    let faults = fault_intervals(messages(), simulated.room_of.len(), end);
    translate(bodies, &faults, messages(), end, |instant| located.push(places(&instant)));
    located
}

/// The same, with the messages until each instant only.
fn located_live(bodies: &[Senses], simulated: &MessagesWithTruth) -> Vec<LocatedInstant> {
    let mut located = Vec::new();
    let length = simulated.places.first().map_or(0, Vec::len) as i64 * SECOND;
    let asked = (1..length / ASKED).map(|number| (RunTime::START + number * ASKED, None));
    let said = simulated.messages.iter().map(|&message| (message.at, Some(message)));
    let mut instants: Vec<(RunTime, Option<LogMessage>)> = asked.chain(said).collect();
    instants.sort_by_key(|(at, _)| *at);
    follow(bodies, instants, |instant| located.push(places(&instant)));
    located
}

fn places(instant: &InstantEstimate) -> LocatedInstant {
    let guesses = instant.guesses();
    let each =
        guesses.iter().map(|guess| (PersonPlace::new(guess.state.at, guess.state.room), guess.state.at)).collect();
    (instant.at, each)
}

#[derive(Default)]
pub(crate) struct LocatingScore<'a> {
    people: &'a [usize],
    /// Seconds of all people, and the right ones: by all messages, by those until then, by the last firing, and by rooms alone.
    pub seconds: u64,
    pub right: u64,
    pub live_right: u64,
    pub last_right: u64,
    pub rooms_right: u64,
    distances_m: Vec<f64>,
    /// Without and with a visitor: seconds in which no visitor and in which a visitor was found.
    visitors: [[u64; 2]; 2],
    pub visits: u64,
    pub found: u64,
    /// By person: the room, the second of its start, and whether it was found.
    stays: Vec<Option<(usize, usize, bool)>>,
}

impl<'a> LocatingScore<'a> {
    fn new(people: &'a [usize]) -> LocatingScore<'a> {
        LocatingScore { people, stays: vec![None; people.len()], ..LocatingScore::default() }
    }

    fn add_second(
        &mut self,
        simulated: &MessagesWithTruth,
        second: usize,
        [located, live]: [&[(PersonPlace, Option<Point>)]; 2],
        last: &[PersonPlace],
        rooms: &[PersonPlace],
    ) {
        let truth: Vec<PersonPlace> = self.people.iter().map(|&body| simulated.places[body][second]).collect();
        let guesses: Vec<PersonPlace> = self.people.iter().map(|&body| located[body].0).collect();
        self.visit(&truth, &guesses, second);
        if truth.contains(&PersonPlace::Between) {
            return;
        }
        self.seconds += truth.len() as u64;
        self.right += matching(&truth, &guesses);
        let live: Vec<PersonPlace> = self.people.iter().filter_map(|&body| live.get(body).map(|one| one.0)).collect();
        self.live_right += matching(&truth, &live);
        self.last_right += matching(&truth, last);
        self.rooms_right += matching(&truth, rooms);
        let &[person] = self.people else { return };
        if let (Some(is), Some(located)) = (simulated.at[person][second], located[person].1) {
            self.distances_m.push(is.distance(located));
        }
        if let Some((place, _)) = located.get(1).filter(|_| simulated.residents == 1) {
            let is_there = (simulated.residents..simulated.places.len())
                .any(|body| simulated.places[body][second] != PersonPlace::Out);
            self.visitors[usize::from(is_there)][usize::from(*place != PersonPlace::Out)] += 1;
        }
    }

    /// Extends or ends the stays of people in rooms.
    fn visit(&mut self, truth: &[PersonPlace], guesses: &[PersonPlace], second: usize) {
        for (stay, place) in self.stays.iter_mut().zip(truth) {
            let is_found = guesses.contains(place);
            match (stay.as_mut(), place) {
                (Some((room, _, found)), PersonPlace::Room(here)) if room == here => *found |= is_found,
                (ended, here) => {
                    let is_visit = |since: usize| (second - since) as i64 * SECOND >= VISIT;
                    if let Some((_, _, found)) = ended.filter(|(_, since, _)| is_visit(*since)) {
                        self.visits += 1;
                        self.found += u64::from(*found);
                    }
                    *stay = match here {
                        PersonPlace::Room(room) => Some((*room, second, is_found)),
                        _ => None,
                    };
                }
            }
        }
    }
}

/// The number of right places, in any order of the people.
fn matching(truth: &[PersonPlace], located: &[PersonPlace]) -> u64 {
    let mut left = truth.to_vec();
    let mut is_right = |place: &&PersonPlace| {
        let found = left.iter().position(|one| one == *place);
        found.map(|found| left.swap_remove(found)).is_some()
    };
    located.iter().filter(|place| is_right(place)).count() as u64
}
