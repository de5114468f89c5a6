//! Walking back: where people were, by the log of their home alone, held against the truth, beside two baselines.
//!
//! A scenario is simulated, and its log is given to the inference, which knows the home but no routines. Each second of each
//! person is judged; seconds between two rooms, as in a door, are left out. Of several people who was where cannot be told by
//! sensors that know nobody: the rooms that are told are held against the rooms that they are in, whoever is in which.

mod baselines;
pub(crate) mod truth;

use baselines::{last_firing, rooms_only};
use homebody_core::geometry::Point;
use homebody_core::link::form::LinkFile;
use homebody_core::time::{DAY, RunTime, SECOND, Span};
use homebody_infer::{InstantEstimate, LogMessage, Senses, fault_intervals, follow, translate};
use serde::Serialize;
pub use truth::{Home, LocatingError};
use truth::{MessagesWithTruth, Place, second_begins};

/// The result for one log.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Case {
    /// The scenario's name.
    pub home: String,
    /// The number that all randomness of the lives comes from.
    pub seed: u64,
    /// Number of residents.
    pub residents: usize,
    /// The sensors and the link have faults.
    pub faults: bool,
    /// Number of messages in the log.
    pub messages: usize,
    /// Share of the time in which the right room was told; being out is one of them.
    pub room_right: f64,
    /// The same, told at once: by what was said until then.
    pub room_right_live: f64,
    /// Share of the stays of 10 s or longer in a room in which that room was told at some time.
    pub visits_found: f64,
    /// Median distance from where the person was, in metres, while at home; nothing where several live.
    pub p50_m: Option<f64>,
    /// The distance that is not exceeded in 9 of 10 seconds.
    pub p90_m: Option<f64>,
    /// Share of the time in which the room of the sensor that fired last is right; of several people, the rooms that fired last.
    pub last_firing_right: f64,
    /// Share of the time in which a hidden Markov model is right that knows rooms alone.
    pub rooms_only_right: f64,
    /// Share of the time in which visitors were there that somebody besides the residents was told; nothing without visitors,
    /// or where several live.
    pub visitors_found: Option<f64>,
    /// Share of the other time in which somebody was told who was not there.
    pub visitors_invented: Option<f64>,
}

/// Interval between questions about the present state (our choice).
const ASKED: Span = SECOND.times(30);
/// Stay below which a person only passes through a room (our choice).
const VISIT: Span = SECOND.times(10);

/// Simulates a home for some days, and locates its residents from the log.
///
/// # Errors
///
/// If the simulation fails, or the response of a sensor cannot be computed.
pub fn case(home: &Home, seed: u64, days: u32) -> Result<Case, LocatingError> {
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
    let mut judge = judged(&bodies, &simulated, &home.people, scenario.home.plan().rooms.len());
    let visitors = has_visitor.then_some(judge.visitors);
    let part = |[missed, told]: [u64; 2]| (missed + told > 0).then(|| told as f64 / (missed + told) as f64);
    judge.distances_m.sort_by(f64::total_cmp);
    let distance = |share: f64| {
        let place = (judge.distances_m.len() as f64 * share) as usize;
        judge.distances_m.get(place).copied()
    };
    let share = |right: u64| right as f64 / judge.seconds as f64;
    Ok(Case {
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

/// Walks a log back, and judges each second of the people.
pub(crate) fn judged<'a>(
    bodies: &[Senses],
    simulated: &MessagesWithTruth,
    people: &'a [usize],
    rooms: usize,
) -> Judge<'a> {
    let seconds = simulated.places.first().map_or(0, Vec::len);
    let told = told(bodies, simulated, second_begins(seconds));
    let mut judge = Judge::new(people);
    let live = live(bodies, simulated);
    let (mut place, mut live_place) = (0, 0);
    let last = last_firing(simulated, people.len());
    let rooms = rooms_only(simulated, rooms, people.len());
    for second in 0..seconds {
        let at = second_begins(second);
        while place + 1 < told.len() && told[place].0 + (told[place + 1].0 - told[place].0) / 2 <= at {
            place += 1;
        }
        while live_place + 1 < live.len() && live[live_place + 1].0 <= at {
            live_place += 1;
        }
        let told_live = live.get(live_place).map_or(&[][..], |told| &told.1);
        judge.second(simulated, second, [&told[place].1, told_live], &last[second], &rooms[second]);
    }
    judge
}

/// An instant, and where each body was then, by the log.
type Told = (RunTime, Vec<(Place, Option<Point>)>);

fn told(bodies: &[Senses], simulated: &MessagesWithTruth, end: RunTime) -> Vec<Told> {
    let mut told = Vec::new();
    let messages = || simulated.messages.iter().copied();
    let faults = fault_intervals(messages(), simulated.room_of.len(), end);
    translate(bodies, &faults, messages(), end, |instant| told.push(places(&instant)));
    told
}

/// The same, told as the messages come.
fn live(bodies: &[Senses], simulated: &MessagesWithTruth) -> Vec<Told> {
    let mut told = Vec::new();
    let length = simulated.places.first().map_or(0, Vec::len) as i64 * SECOND;
    let asked = (1..length / ASKED).map(|number| (RunTime::START + number * ASKED, None));
    let said = simulated.messages.iter().map(|&message| (message.at, Some(message)));
    let mut instants: Vec<(RunTime, Option<LogMessage>)> = asked.chain(said).collect();
    instants.sort_by_key(|(at, _)| *at);
    follow(bodies, instants, |instant| told.push(places(&instant)));
    told
}

fn places(instant: &InstantEstimate) -> Told {
    let guesses = instant.guesses();
    let each = guesses.iter().map(|guess| (Place::of(guess.state.at, guess.state.room), guess.state.at)).collect();
    (instant.at, each)
}

/// The judgement of the seconds so far.
pub(crate) struct Judge<'a> {
    people: &'a [usize],
    /// Seconds of all people, and those of them that were right: by walking back, at once, by the last firing, and by rooms alone.
    pub seconds: u64,
    pub right: u64,
    pub live_right: u64,
    pub last_right: u64,
    pub rooms_right: u64,
    distances_m: Vec<f64>,
    /// Without and with a visitor: seconds in which nobody and in which somebody was told.
    visitors: [[u64; 2]; 2],
    pub visits: u64,
    pub found: u64,
    /// By person: the room they are in, since which second, and whether it was told.
    stays: Vec<Option<(usize, usize, bool)>>,
}

impl<'a> Judge<'a> {
    fn new(people: &'a [usize]) -> Judge<'a> {
        Judge {
            people,
            seconds: 0,
            right: 0,
            live_right: 0,
            last_right: 0,
            rooms_right: 0,
            distances_m: Vec::new(),
            visitors: [[0; 2]; 2],
            visits: 0,
            found: 0,
            stays: vec![None; people.len()],
        }
    }

    fn second(
        &mut self,
        simulated: &MessagesWithTruth,
        second: usize,
        [told, live]: [&[(Place, Option<Point>)]; 2],
        last: &[Place],
        rooms: &[Place],
    ) {
        let truth: Vec<Place> = self.people.iter().map(|&body| simulated.places[body][second]).collect();
        let guesses: Vec<Place> = self.people.iter().map(|&body| told[body].0).collect();
        self.visit(&truth, &guesses, second);
        if truth.contains(&Place::Between) {
            return;
        }
        self.seconds += truth.len() as u64;
        self.right += together(&truth, &guesses);
        let live: Vec<Place> = self.people.iter().filter_map(|&body| live.get(body).map(|one| one.0)).collect();
        self.live_right += together(&truth, &live);
        self.last_right += together(&truth, last);
        self.rooms_right += together(&truth, rooms);
        let &[person] = self.people else { return };
        if let (Some(is), Some(told)) = (simulated.at[person][second], told[person].1) {
            self.distances_m.push(is.distance(told));
        }
        if let Some((place, _)) = told.get(1).filter(|_| simulated.residents == 1) {
            let is_there =
                (simulated.residents..simulated.places.len()).any(|body| simulated.places[body][second] != Place::Out);
            self.visitors[usize::from(is_there)][usize::from(*place != Place::Out)] += 1;
        }
    }

    /// Stays that go on or end.
    fn visit(&mut self, truth: &[Place], guesses: &[Place], second: usize) {
        for (stay, place) in self.stays.iter_mut().zip(truth) {
            let is_told = guesses.contains(place);
            match (stay.as_mut(), place) {
                (Some((room, _, found)), Place::Room(here)) if room == here => *found |= is_told,
                (ended, here) => {
                    let is_visit = |since: usize| (second - since) as i64 * SECOND >= VISIT;
                    if let Some((_, _, found)) = ended.filter(|(_, since, _)| is_visit(*since)) {
                        self.visits += 1;
                        self.found += u64::from(*found);
                    }
                    *stay = match here {
                        Place::Room(room) => Some((*room, second, is_told)),
                        _ => None,
                    };
                }
            }
        }
    }
}

/// The number of located places that are right, in any order of the people.
fn together(truth: &[Place], told: &[Place]) -> u64 {
    let mut left = truth.to_vec();
    let mut is_right = |place: &&Place| {
        let found = left.iter().position(|one| one == *place);
        found.map(|found| left.swap_remove(found)).is_some()
    };
    told.iter().filter(|place| is_right(place)).count() as u64
}
