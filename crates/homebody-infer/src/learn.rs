//! How the sensors of a home answer to a body, counted while one goes everywhere.

use crate::flow::Flow;
use crate::rover::{RESTS, Rover};
use crate::said::{KINDS, Last, Message, Said, Timing, channel};
use crate::states::{Kind, States};
use homebody_core::drivers::Driver;
use homebody_core::drivers::absent::Absent;
use homebody_core::drivers::error::DriverError;
use homebody_core::event::{Events, Fact, MotionState};
use homebody_core::home::Home;
use homebody_core::run::{DriverProvider, Guest, Run};
use homebody_core::scenario::load::Scenario;
use homebody_core::scenario::path::Posture;
use homebody_core::stride::Stride;
use homebody_core::time::{DAY, Micros, SECOND, seconds};
use homebody_log::{LogError, Rows};
use homebody_walk::Mesh;
use homebody_walk::places::Places;
use std::sync::Arc;

/// Time that the body walks about (our choice): it crosses each patch of floor some hundred times.
const LENGTH: Micros = 20 * DAY;
/// Time without movement after which a person who stays is motionless (our choice): gaps between stirs have a tail that
/// no single rate produces.
const MOTIONLESS: Micros = 90 * SECOND;
/// Where it walks is looked at so often.
const LOOK: Micros = SECOND / 5;
/// Time away, and time between visits, in seconds (our choice).
const OUT_S: f64 = 5_400.0;
const BETWEEN_VISITS_S: f64 = 100_000.0;
/// Rate, per second, of events without a cause (our choice): once in ten days for each sensor.
const OF_NOTHING: f64 = 1e-6;
/// Seconds of a mean rate that are added to the counts, so that an unobserved event is not impossible (our choice).
const BEFOREHAND_S: f64 = 20.0;
/// Share of a patch's rates that comes from the patches around it (our choice).
const SMEAR: f64 = 0.15;
/// Rate per second at which a sensor stops sensing a person who has left, and seconds of it that are added to the
/// counts (our choice).
const GONE: f64 = 0.5;
const GONE_BEFOREHAND_S: f64 = 4.0;

/// Share of a silence that counts (our choice): a sensor that missed a person misses them again, so that each second of
/// silence says less than the one before. Chosen on runs with the seeds 1 to 10, and on the first two recordings of
/// SPHERE.
pub(crate) const SILENCE: f64 = 0.5;

/// What is known of a home's sensors: how often each speaks in each state, and how states follow each other.
#[derive(Clone, Debug)]
pub struct Senses {
    states: States,
    /// By sensor.
    pub(crate) timing: Vec<Timing>,
    /// By channel and state: messages a second while the sensor can say so.
    pub(crate) rates: Vec<Vec<f32>>,
    /// By state, how often each sensor says ON: the same numbers.
    on_rates: Vec<f32>,
    /// By channel: the states in which it was heard, and by how much more often than what comes of nothing.
    heard_of: Vec<Vec<(u32, f32)>>,
    pub(crate) flow: Flow,
    counted: Counted,
    /// Whether it is somebody who comes now and then, and is out as a log begins.
    pub(crate) visits: bool,
}

/// What of the states' counts is kept: the time in each, and the turns between them.
#[derive(Clone, Debug)]
struct Counted {
    time_s: Vec<f64>,
    turns: Vec<Vec<f64>>,
}

homebody_core::messages! {
    /// Reasons why Homebody cannot compute how the sensors of a home respond.
    pub enum NotLearnt in "response" {
        /// Homebody lets the body of a resident go everywhere in the home, and counts the rows of the sensors. The home has no resident.
        Nobody error "no-residents" ("the scenario has no resident, so Homebody cannot compute how the sensors respond")
            hint ("add a file to \"residents\" in scenario.json");
        /// Homebody lets the body of a resident go everywhere in the home, and counts the rows of the sensors. The body could not continue.
        Walk(why: String) error "not-walkable" ("a resident cannot walk through the home: {why}");
        => inner {
            /// The rows of the sensors cannot be written.
            Log(LogError);
        }
    }
}

impl From<DriverError> for NotLearnt {
    fn from(error: DriverError) -> NotLearnt {
        NotLearnt::Walk(error.to_string())
    }
}

impl From<LogError> for NotLearnt {
    fn from(error: LogError) -> NotLearnt {
        NotLearnt::Log(error)
    }
}

/// Devices that feel whether somebody is there, by the keys of their kinds.
const FEELS: [&str; 2] = ["bed", "pressure"];

/// The body of one resident is the rover's; all others are out.
struct Alone<'a> {
    scenario: &'a Scenario,
    body: usize,
    places: Arc<Places>,
    mesh: Arc<Mesh>,
    states: &'a States,
}

impl DriverProvider for Alone<'_> {
    fn guests(&self) -> Vec<Guest> {
        Vec::new()
    }

    fn driver(&self, body: usize, home: &Arc<Home>, seed: u64) -> Option<Box<dyn Driver>> {
        if body != self.body {
            return Some(Box::new(Absent));
        }
        let spots = self.states.stations.iter().map(|station| station.spot.clone()).collect();
        let pace_mps = self.scenario.residents[body].file.pace_mps;
        let (places, mesh) = (self.places.clone(), self.mesh.clone());
        Some(Box::new(Rover::new(home.clone(), places, spots, mesh, pace_mps, seed)))
    }
}

/// What was counted.
struct Counts {
    /// By state, in seconds.
    time_s: Vec<f64>,
    /// By channel and state.
    messages: Vec<Vec<f64>>,
    /// By sensor and state, in seconds: how long it could say ON, and how long OFF.
    may_begin_s: Vec<Vec<f64>>,
    may_end_s: Vec<Vec<f64>>,
    /// From which state to which.
    turns: Vec<Vec<f64>>,
}

impl Senses {
    /// What the sensors of a home say of the body of one of its residents, through its link and its logger.
    ///
    /// # Errors
    ///
    /// If nobody lives there, or no body can go through it.
    pub fn learn(scenario: &Scenario, body: usize) -> Result<Senses, NotLearnt> {
        let resident = scenario.residents.get(body).ok_or(NotLearnt::Nobody)?;
        // What goes wrong on some day is what nobody knows beforehand.
        let mut scenario = scenario.clone();
        if let Some(link) = &mut scenario.link {
            link.faults.clear();
        }
        let scenario = &scenario;
        let plan = scenario.home.plan();
        let mesh = Arc::new(Mesh::with_numbers(plan, resident.file.radius_m, scenario.home.numbers()));
        let places = Arc::new(Places::new(&scenario.home, plan, &mesh, &resident.file.name));
        let states = States::new(plan, &places, &mesh);
        let alone = Alone { scenario, body, places, mesh, states: &states };
        let (track, messages, feels) = lived(scenario, &alone, &states)?;
        let timing = timing(&messages, &feels);
        let counts = Counts::of(&track, &messages, &timing, states.len());
        let mut rates = counts.rates(&timing);
        smear(&mut rates, &counts.turns, &states);
        let counted = Counted { time_s: counts.time_s, turns: counts.turns };
        let flow = counted.flow(&states, &rates, OUT_S);
        let heard_of = rates.iter().map(|rates| heard_of(rates)).collect();
        let on_rates = on_rates(&rates, states.len());
        Ok(Senses { states, timing, rates, on_rates, heard_of, flow, counted, visits: false })
    }

    /// The same for a body that is seldom at home: somebody who visits.
    pub fn of_visitor(&self) -> Senses {
        let flow = self.counted.flow(&self.states, &self.rates, BETWEEN_VISITS_S);
        Senses { flow, visits: true, ..self.clone() }
    }

    /// Nobody, who is beside a body that is alone.
    pub fn nobody(&self) -> Senses {
        // Whether what feels somebody is over depends on the other alone.
        let is_over = |channel: usize| channel % KINDS == Said::Off as usize && self.timing[channel / KINDS].feels;
        let of = |channel: usize| if is_over(channel) { f32::MAX } else { 0.0 };
        let rates: Vec<Vec<f32>> = (0..self.rates.len()).map(|channel| vec![of(channel)]).collect();
        let counted = Counted { time_s: Vec::new(), turns: Vec::new() };
        let (states, timing) = (States::nobody(), self.timing.clone());
        let heard_of = vec![Vec::new(); self.rates.len()];
        let on_rates = on_rates(&rates, 1);
        Senses { states, timing, rates, on_rates, heard_of, flow: Flow::nobody(), counted, visits: false }
    }

    /// How often a sensor says something, in messages a second while it can: by state.
    pub(crate) fn rate(&self, sensor: usize, said: Said) -> &[f32] {
        &self.rates[channel(sensor, said)]
    }

    /// How often each sensor says ON in a state.
    pub(crate) fn on_rates(&self, state: u32) -> &[f32] {
        let sensors = self.timing.len();
        &self.on_rates[state as usize * sensors..][..sensors]
    }

    /// In which states a sensor says something, and by how much more often a second than of nothing.
    pub(crate) fn heard_of(&self, sensor: usize, said: Said) -> &[(u32, f32)] {
        &self.heard_of[channel(sensor, said)]
    }

    /// The chances of the states before anything was said.
    pub(crate) fn begins(&self) -> Vec<f32> {
        let size = self.states.len();
        match self.visits {
            true => (0..size).map(|state| if state == 0 { 1.0 } else { 0.0 }).collect(),
            false => {
                // Somewhere to stay: who walks as a log begins is somewhere soon.
                let stays = |state: usize| !matches!(self.states.all[state].kind, Kind::Walks | Kind::Stands);
                let chances: Vec<f32> = (0..size).map(|state| if stays(state) { 1.0 } else { 0.0 }).collect();
                let sum: f32 = chances.iter().sum();
                chances.into_iter().map(|chance| chance / sum).collect()
            }
        }
    }

    /// The states that somebody can be in.
    pub fn states(&self) -> &States {
        &self.states
    }
}

/// How often each sensor says ON, state by state.
fn on_rates(rates: &[Vec<f32>], states: usize) -> Vec<f32> {
    let of = |state: usize| (0..rates.len() / KINDS).map(move |sensor| rates[channel(sensor, Said::On)][state]);
    (0..states).flat_map(of).collect()
}

/// In which states something is said, by how often it is in each. What comes of nothing is the same in all others.
fn heard_of(rates: &[f32]) -> Vec<(u32, f32)> {
    let of_nothing = OF_NOTHING as f32;
    let more = (0..).zip(rates).map(|(state, rate)| (state, rate - of_nothing));
    more.filter(|(_, more)| *more > of_nothing).collect()
}

/// Gives each patch of floor a part of the rates of those that are walked to from it: bodies differ in pace and in how they
/// cut corners, so that what one patch makes speak is heard on the next.
fn smear(rates: &mut [Vec<f32>], turns: &[Vec<f64>], states: &States) {
    let patches: Vec<usize> = states.patches().map(|(walks, _)| walks).collect();
    for rates in rates.iter_mut() {
        let old = rates.clone();
        for &patch in &patches {
            let (mut sum, mut weight) = (0.0, 0.0);
            for &other in patches.iter().filter(|&&other| other != patch) {
                let count = turns[patch][other] + turns[other][patch];
                sum += count * f64::from(old[other]);
                weight += count;
            }
            if weight > 0.0 {
                rates[patch] = ((1.0 - SMEAR) * f64::from(old[patch]) + SMEAR * sum / weight) as f32;
            }
        }
    }
}

impl Counted {
    fn flow(&self, states: &States, rates: &[Vec<f32>], out_s: f64) -> Flow {
        Flow::new(states, &self.time_s, &self.turns, &silence(rates, states.len()), out_s)
    }
}

/// The rate at which silence grows unlikely in a state, as long as nothing is on.
fn silence(rates: &[Vec<f32>], states: usize) -> Vec<f64> {
    let is_counted = |channel: &usize| channel % KINDS != Said::Off as usize;
    let of =
        |state: usize| (0..rates.len()).filter(is_counted).map(|channel| f64::from(rates[channel][state])).sum::<f64>();
    (0..states).map(|state| SILENCE * of(state)).collect()
}

/// When the rover was in which state, what the sensors said, and which of them feel whether somebody is there.
type Heard = (Vec<(Micros, usize)>, Vec<Message>, Vec<bool>);

/// Lets the rover go about.
fn lived(scenario: &Scenario, alone: &Alone, states: &States) -> Result<Heard, NotLearnt> {
    const SEED: u64 = 1;
    // Cameras say nothing in a log, and cost a hundred times as much as all other sensors.
    let all = scenario.home.placed_sensors();
    let blind = Scenario { home: scenario.home.without_cameras(), ..scenario.clone() };
    let mut run = Run::new(&blind, alone, SEED, LENGTH);
    let names: Vec<String> = run.sensors().iter().map(|sensor| sensor.name.clone()).collect();
    let number_of = |name: &String| all.iter().position(|sensor| sensor.name == *name);
    let numbers: Vec<Option<usize>> = names.iter().map(number_of).collect();
    let mut rows = Rows::new(&scenario.logger, SEED, &names, &scenario.calendar)?;
    let (mut track, mut messages) = (Vec::new(), Vec::new());
    let mut rests = false;
    let mut rested: Vec<(Micros, bool)> = Vec::new();
    let mut events = Events::default();
    let mut enter = |at: Micros, state: usize| {
        if track.last().is_none_or(|&(_, last)| last != state) {
            track.push((at, state));
        }
    };
    while run.now() < LENGTH {
        run.advance(run.now() + DAY / 24, &mut events)?;
        for fact in &events.facts {
            match fact {
                Fact::Activity { at, name, resident } if resident.index() == alone.body => {
                    rested.push((*at, name.as_deref() == Some(RESTS)))
                }
                Fact::Movement { resident, begin, end, doing, posture } if resident.index() == alone.body => {
                    while rested.first().is_some_and(|(at, _)| at <= begin) {
                        rests = rested.remove(0).1;
                    }
                    enter_all(states, (*begin, *end), *doing, *posture, rests, &mut enter);
                }
                _ => {}
            }
        }
        let said = rows.of(&events.firings, run.settled());
        messages.extend(said.filter_map(|row| {
            Some(Message { at: row.at, sensor: numbers[row.sensor.index()]?, said: Said::of(&row.value)? })
        }));
        events.clear();
    }
    messages.sort_by_key(|message: &Message| message.at);
    let feels = all.iter().map(|sensor| sensor.senses_motion() || FEELS.contains(&sensor.row.key)).collect();
    Ok((track, messages, feels))
}

/// The states of a body over a span.
fn enter_all(
    states: &States,
    (begin, end): (Micros, Micros),
    doing: MotionState,
    posture: Posture,
    rests: bool,
    enter: &mut impl FnMut(Micros, usize),
) {
    match doing {
        MotionState::Away => enter(begin, 0),
        MotionState::InPlace { at, .. } | MotionState::Rest { at } => {
            let stirs = end - begin < MOTIONLESS || !matches!(doing, MotionState::Rest { .. });
            let kind = match (rests, stirs) {
                (_, false) => Kind::Motionless,
                (false, true) => Kind::Busy,
                (true, true) => Kind::Still,
            };
            enter(begin, states.staying(at, posture, kind));
        }
        MotionState::Stride { from, to } => {
            let stride = Stride::new(from, to, begin, end);
            let looks = (0..).map(|look| begin + look * LOOK).take_while(|&at| at < end);
            looks.for_each(|at| enter(at, states.walking(stride.position(at))));
        }
    }
}

/// Whether each sensor says OFF, and for how long it is blind after a message.
fn timing(messages: &[Message], feels: &[bool]) -> Vec<Timing> {
    /// Share of the shortest gaps that is left out, because they may be chance or a fault (our choice).
    const SHORTEST: f64 = 0.02;
    let mut timing: Vec<Timing> = feels.iter().map(|&feels| Timing { feels, ..Timing::default() }).collect();
    let mut gaps: Vec<Vec<Micros>> = vec![Vec::new(); feels.len()];
    let mut last: Vec<Option<Micros>> = vec![None; feels.len()];
    for message in messages.iter().filter(|message| message.said == Said::Off) {
        timing[message.sensor].has_off = true;
    }
    for message in messages.iter().filter(|message| message.said != Said::Word) {
        let sensor = message.sensor;
        if let Some(last) = last[sensor].filter(|_| message.said == Said::On) {
            gaps[sensor].push(message.at - last);
        }
        let counts = message.said == Said::Off || !timing[sensor].has_off;
        last[sensor] = counts.then_some(message.at);
    }
    for (timing, mut gaps) in timing.iter_mut().zip(gaps) {
        gaps.sort_unstable();
        timing.blind = gaps.get((gaps.len() as f64 * SHORTEST) as usize).copied().unwrap_or(0).max(0);
    }
    timing
}

impl Counts {
    fn of(track: &[(Micros, usize)], messages: &[Message], timing: &[Timing], states: usize) -> Counts {
        let sensors = timing.len();
        let mut counts = Counts {
            time_s: vec![0.0; states],
            messages: vec![vec![0.0; states]; sensors * KINDS],
            may_begin_s: vec![vec![0.0; states]; sensors],
            may_end_s: vec![vec![0.0; states]; sensors],
            turns: vec![vec![0.0; states]; states],
        };
        for pair in track.windows(2) {
            counts.time_s[pair[0].1] += seconds(pair[1].0 - pair[0].0);
            counts.turns[pair[0].1][pair[1].1] += 1.0;
        }
        if let Some(&(at, state)) = track.last() {
            counts.time_s[state] += seconds(LENGTH - at);
        }
        for sensor in 0..sensors {
            counts.may_begin_s[sensor].clone_from(&counts.time_s);
        }
        let mut last = vec![Last::default(); sensors];
        let mut since = vec![0; sensors];
        for message in messages {
            let sensor = message.sensor;
            let place = track.partition_point(|&(at, _)| at <= message.at).saturating_sub(1);
            counts.messages[channel(sensor, message.said)][track[place].1] += 1.0;
            if message.said != Said::Word {
                counts.unheard(track, sensor, &last[sensor], (since[sensor], message.at));
                last[sensor].hear(message, &timing[sensor]);
                since[sensor] = message.at;
            }
        }
        for sensor in 0..sensors {
            counts.unheard(track, sensor, &last[sensor], (since[sensor], LENGTH));
        }
        counts
    }

    /// Takes the span in which a sensor could not say ON from its time, and adds it to that in which it could say OFF.
    fn unheard(&mut self, track: &[(Micros, usize)], sensor: usize, last: &Last, (from, to): (Micros, Micros)) {
        let until = from + last.deaf(from, to);
        let first = track.partition_point(|&(at, _)| at <= from).saturating_sub(1);
        for (place, &(at, state)) in track.iter().enumerate().skip(first) {
            if at >= until {
                break;
            }
            let end = track.get(place + 1).map_or(LENGTH, |next| next.0).min(until);
            let span_s = seconds(end - at.max(from));
            self.may_begin_s[sensor][state] -= span_s;
            if last.is_on {
                self.may_end_s[sensor][state] += span_s;
            }
        }
    }

    /// Messages a second, by channel and state.
    fn rates(&self, timing: &[Timing]) -> Vec<Vec<f32>> {
        let mut rates = Vec::with_capacity(self.messages.len());
        for (sensor, timing) in timing.iter().enumerate() {
            for said in [Said::On, Said::Off, Said::Word] {
                let messages = &self.messages[channel(sensor, said)];
                let time_s = match said {
                    Said::On => &self.may_begin_s[sensor],
                    Said::Off => &self.may_end_s[sensor],
                    Said::Word => &self.time_s,
                };
                // What feels somebody is off at once where they are not; all else is not said where it was never heard.
                let (usual, beforehand_s) = match said {
                    Said::Off if timing.feels => (GONE, GONE_BEFOREHAND_S),
                    _ => (OF_NOTHING, BEFOREHAND_S),
                };
                let rate = |(count, time_s): (&f64, &f64)| {
                    let rate = (count + usual * beforehand_s) / (time_s.max(0.0) + beforehand_s);
                    rate.max(OF_NOTHING) as f32
                };
                rates.push(messages.iter().zip(time_s).map(rate).collect());
            }
        }
        rates
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use std::collections::BTreeMap;

    /// For so many seconds of [`walk`] a log is.
    pub(crate) const LENGTH_S: i64 = 900;

    /// A bed and a chair, to stay at: who is seen as a log begins was somewhere.
    const FURNITURE: &str = r#""furniture": [
        { "name": "bed", "at": [6, 2.2], "size_m": [2, 1.4], "height_m": 0.55, "enterable": true, "role": "bed" },
        { "name": "chair", "at": [3.2, 0.5], "size_m": [0.5, 0.5], "height_m": 0.9, "enterable": true, "role": "dining_seat" }
    ],
    "sensors""#;

    /// What is known of the flat that all tests are in, of one who lives there.
    pub(crate) fn senses() -> Senses {
        let home = include_str!("../../../tests/flat/home.json").replace("\"sensors\"", FURNITURE);
        let files = [
            ("scenario.json", include_str!("../../../tests/flat/scenario.json")),
            ("home.json", home.as_str()),
            ("logger.json", include_str!("../../../tests/flat/logger.json")),
            ("ann.json", include_str!("../../../tests/flat/ann.json")),
            ("ann.path.json", include_str!("../../../tests/flat/ann.path.json")),
            // Bob is moved by keys that each test has of its own; here he is another who goes Ann's way.
            ("bob.json", r#"{ "name": "Bob", "driver": { "path": "ann.path.json" } }"#),
        ];
        let files: BTreeMap<String, String> =
            files.into_iter().map(|(name, text)| (name.to_owned(), text.to_owned())).collect();
        Senses::learn(&Scenario::load(&files, "scenario.json").unwrap(), 0).unwrap()
    }

    /// What the flat's sensors say of somebody who goes from the kitchen to the bedroom and back.
    pub(crate) fn walk() -> Vec<Message> {
        const KITCHEN: usize = 1;
        const BEDROOM: usize = 3;
        let at_s = [(3, KITCHEN), (5, KITCHEN), (9, BEDROOM), (12, BEDROOM), (300, BEDROOM), (640, KITCHEN)];
        let message = |(at_s, sensor)| Message { at: at_s * SECOND, sensor, said: Said::On };
        at_s.map(message).to_vec()
    }
}
