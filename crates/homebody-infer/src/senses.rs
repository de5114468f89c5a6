//! The responses of a home's sensors to a body, counted in a simulated random walk.

use crate::message::{KINDS, LastMessage, LogMessage, MessageKind, ReportTiming, channel};
use crate::random_walk::{RESTS, RandomWalkModel};
use crate::states::{StateKind, States};
use crate::transition_matrices::TransitionMatrices;
use homebody_core::drivers::Driver;
use homebody_core::drivers::absent::Absent;
use homebody_core::drivers::error::DriverError;
use homebody_core::event::{Events, Fact};
use homebody_core::home::Home;
use homebody_core::motion::MotionState;
use homebody_core::posture::Posture;
use homebody_core::run::{DriverProvider, Guest, Run};
use homebody_core::scenario::load::Scenario;
use homebody_core::sensors::Sensor;
use homebody_core::stride::Stride;
use homebody_core::time::{DAY, HOUR, Interval, RunTime, SECOND, Span};
use homebody_log::{LogError, LogRows};
use homebody_walk::Mesh;
use homebody_walk::places::HomePlaces;
use std::sync::Arc;

/// Length of the random walk (our choice): each patch of floor is crossed some hundred times.
const LENGTH: Span = DAY.times(20);
const END: RunTime = RunTime::START.saturating_add(LENGTH);
/// Time without movement after which a person who stays is motionless (our choice): gaps between stirs have a tail that
/// no single rate produces.
const MOTIONLESS: Span = SECOND.times(90);
/// Interval at which walks are sampled.
const LOOK: Span = Span::from_millis(200);
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

/// Rates of each sensor's messages in each state, and of transitions between states.
#[derive(Clone, Debug)]
pub struct Senses {
    states: States,
    pub(crate) timing: Vec<ReportTiming>,
    /// By channel and state: messages per second while the sensor can send.
    pub(crate) rates: Vec<Vec<f32>>,
    /// The rates of ON, by state and sensor.
    on_rates: Vec<f32>,
    /// By channel: the states that raise its rate above that without a cause, and by how much.
    excess_rates: Vec<Vec<(u32, f32)>>,
    pub(crate) flow: TransitionMatrices,
    counted: StateCounts,
    /// Whether the body belongs to a visitor, who is out when a log begins.
    pub(crate) visits: bool,
}

#[derive(Clone, Debug)]
struct StateCounts {
    time_s: Vec<f64>,
    turns: Vec<Vec<f64>>,
}

homebody_core::messages! {
    /// Reasons why Homebody cannot compute how the sensors of a home respond.
    pub enum ResponseError in "response" {
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

impl From<DriverError> for ResponseError {
    fn from(error: DriverError) -> ResponseError {
        ResponseError::Walk(error.to_string())
    }
}

impl From<LogError> for ResponseError {
    fn from(error: LogError) -> ResponseError {
        ResponseError::Log(error)
    }
}

/// One resident walks at random; all others are out.
struct SingleResident<'a> {
    scenario: &'a Scenario,
    body: usize,
    places: Arc<HomePlaces>,
    mesh: Arc<Mesh>,
    states: &'a States,
}

impl DriverProvider for SingleResident<'_> {
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
        Some(Box::new(RandomWalkModel::new(home.clone(), places, spots, mesh, pace_mps, seed)))
    }
}

struct SensorCounts {
    /// In seconds, by state.
    time_s: Vec<f64>,
    /// By channel and state.
    messages: Vec<Vec<f64>>,
    /// In seconds, by sensor and state: time during which it could send ON, and OFF.
    may_begin_s: Vec<Vec<f64>>,
    may_end_s: Vec<Vec<f64>>,
    /// Transitions, from state to state.
    turns: Vec<Vec<f64>>,
}

impl Senses {
    ///
    /// Simulates the random walk of one resident, through the link and the logger of the scenario.
    ///
    /// # Errors
    ///
    /// If the home has no resident, or the resident cannot walk through it.
    pub fn learn(scenario: &Scenario, body: usize) -> Result<Senses, ResponseError> {
        let resident = scenario.residents.get(body).ok_or(ResponseError::Nobody)?;
        // Faults on particular days are unknown in advance.
        let mut scenario = scenario.clone();
        if let Some(link) = &mut scenario.link {
            link.faults.clear();
        }
        let scenario = &scenario;
        let plan = scenario.home.plan();
        let mesh = Arc::new(Mesh::with_numbers(plan, resident.file.radius_m, scenario.home.numbers()));
        let places = Arc::new(HomePlaces::new(&scenario.home, plan, &mesh, &resident.file.name));
        let states = States::new(plan, &places, &mesh);
        let alone = SingleResident { scenario, body, places, mesh, states: &states };
        let (track, messages, feels) = simulate(scenario, &alone, &states)?;
        let timing = timing(&messages, &feels);
        let counts = SensorCounts::from_track(&track, &messages, &timing, states.len());
        let mut rates = counts.rates(&timing);
        smear(&mut rates, &counts.turns, &states);
        let counted = StateCounts { time_s: counts.time_s, turns: counts.turns };
        let flow = counted.flow(&states, &rates, OUT_S);
        let excess_rates = rates.iter().map(|rates| excess_rates(rates)).collect();
        let on_rates = on_rates(&rates, states.len());
        Ok(Senses { states, timing, rates, on_rates, excess_rates, flow, counted, visits: false })
    }

    /// The same for a visitor, who is seldom at home.
    pub fn for_visitor(&self) -> Senses {
        let flow = self.counted.flow(&self.states, &self.rates, BETWEEN_VISITS_S);
        Senses { flow, visits: true, ..self.clone() }
    }

    /// An empty body, as the partner of a body that is alone.
    pub fn empty_body(&self) -> Senses {
        // A presence sensor turns off depending on the other body only.
        let is_over =
            |channel: usize| channel % KINDS == MessageKind::Off as usize && self.timing[channel / KINDS].feels;
        let of = |channel: usize| if is_over(channel) { f32::MAX } else { 0.0 };
        let rates: Vec<Vec<f32>> = (0..self.rates.len()).map(|channel| vec![of(channel)]).collect();
        let counted = StateCounts { time_s: Vec::new(), turns: Vec::new() };
        let (states, timing) = (States::empty(), self.timing.clone());
        let excess_rates = vec![Vec::new(); self.rates.len()];
        let on_rates = on_rates(&rates, 1);
        Senses {
            states,
            timing,
            rates,
            on_rates,
            excess_rates,
            flow: TransitionMatrices::empty(),
            counted,
            visits: false,
        }
    }

    pub(crate) fn rate(&self, sensor: usize, said: MessageKind) -> &[f32] {
        &self.rates[channel(sensor, said)]
    }

    pub(crate) fn on_rates(&self, state: u32) -> &[f32] {
        let sensors = self.timing.len();
        &self.on_rates[state as usize * sensors..][..sensors]
    }

    pub(crate) fn excess_rates(&self, sensor: usize, said: MessageKind) -> &[(u32, f32)] {
        &self.excess_rates[channel(sensor, said)]
    }

    pub(crate) fn initial_chances(&self) -> Vec<f32> {
        let size = self.states.len();
        match self.visits {
            true => (0..size).map(|state| if state == 0 { 1.0 } else { 0.0 }).collect(),
            false => {
                // Staying states only: a person who walks when a log begins soon stays somewhere.
                let stays = |state: usize| !matches!(self.states.all[state].kind, StateKind::Walks | StateKind::Stands);
                let chances: Vec<f32> = (0..size).map(|state| if stays(state) { 1.0 } else { 0.0 }).collect();
                let sum: f32 = chances.iter().sum();
                chances.into_iter().map(|chance| chance / sum).collect()
            }
        }
    }

    pub fn states(&self) -> &States {
        &self.states
    }
}

fn on_rates(rates: &[Vec<f32>], states: usize) -> Vec<f32> {
    let of = |state: usize| (0..rates.len() / KINDS).map(move |sensor| rates[channel(sensor, MessageKind::On)][state]);
    (0..states).flat_map(of).collect()
}

fn excess_rates(rates: &[f32]) -> Vec<(u32, f32)> {
    let of_nothing = OF_NOTHING as f32;
    let more = (0..).zip(rates).map(|(state, rate)| (state, rate - of_nothing));
    more.filter(|(_, more)| *more > of_nothing).collect()
}

/// Mixes the rates of each patch with those of its neighbours: bodies differ in pace and in how they cut corners.
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

impl StateCounts {
    fn flow(&self, states: &States, rates: &[Vec<f32>], out_s: f64) -> TransitionMatrices {
        TransitionMatrices::new(states, &self.time_s, &self.turns, &silence(rates, states.len()), out_s)
    }
}

/// The rate of messages in each state while no sensor is on, scaled by [`SILENCE`].
fn silence(rates: &[Vec<f32>], states: usize) -> Vec<f64> {
    let is_counted = |channel: &usize| channel % KINDS != MessageKind::Off as usize;
    let of =
        |state: usize| (0..rates.len()).filter(is_counted).map(|channel| f64::from(rates[channel][state])).sum::<f64>();
    (0..states).map(|state| SILENCE * of(state)).collect()
}

/// Instants of new states, the messages, and which sensors detect presence.
type TrainingData = (Vec<(RunTime, usize)>, Vec<LogMessage>, Vec<bool>);

fn simulate(scenario: &Scenario, alone: &SingleResident, states: &States) -> Result<TrainingData, ResponseError> {
    const SEED: u64 = 1;
    // Cameras write no rows, and cost a hundred times as much as all other sensors.
    let all = scenario.home.placed_sensors();
    let blind = Scenario { home: scenario.home.without_cameras(), ..scenario.clone() };
    let mut run = Run::new(&blind, alone, SEED, LENGTH);
    let names: Vec<String> = run.sensors().iter().map(|sensor| sensor.name.clone()).collect();
    let number_of = |name: &String| all.iter().position(|sensor| sensor.name == *name);
    let numbers: Vec<Option<usize>> = names.iter().map(number_of).collect();
    let mut rows = LogRows::new(&scenario.logger, SEED, &names, &scenario.calendar)?;
    let (mut track, mut messages) = (Vec::new(), Vec::new());
    let mut rests = false;
    let mut rested: Vec<(RunTime, bool)> = Vec::new();
    let mut events = Events::default();
    let mut enter = |at: RunTime, state: usize| {
        if track.last().is_none_or(|&(_, last)| last != state) {
            track.push((at, state));
        }
    };
    while run.now() < END {
        run.advance(run.now() + HOUR, &mut events)?;
        for fact in &events.facts {
            match fact {
                Fact::Activity { at, name, resident } if resident.index() == alone.body => {
                    rested.push((*at, name.as_deref() == Some(RESTS)))
                }
                Fact::Movement { resident, begin, end, doing, posture } if resident.index() == alone.body => {
                    while rested.first().is_some_and(|(at, _)| at <= begin) {
                        rests = rested.remove(0).1;
                    }
                    enter_all(states, Interval::new(*begin, *end), *doing, *posture, rests, &mut enter);
                }
                _ => {}
            }
        }
        let said = rows.of(&events.firings, run.settled());
        messages.extend(said.filter_map(|row| {
            Some(LogMessage {
                at: row.at,
                sensor: numbers[row.sensor.index()]?,
                said: MessageKind::from_value(&row.value)?,
            })
        }));
        events.clear();
    }
    messages.sort_by_key(|message: &LogMessage| message.at);
    let feels = all.iter().map(Sensor::detects_presence).collect();
    Ok((track, messages, feels))
}

fn enter_all(
    states: &States,
    span: Interval<RunTime>,
    doing: MotionState,
    posture: Posture,
    rests: bool,
    enter: &mut impl FnMut(RunTime, usize),
) {
    let Interval { begin, end } = span;
    match doing {
        MotionState::Away => enter(begin, 0),
        MotionState::InPlace { at, .. } | MotionState::Rest { at } => {
            let stirs = span.length() < MOTIONLESS || !matches!(doing, MotionState::Rest { .. });
            let kind = match (rests, stirs) {
                (_, false) => StateKind::Motionless,
                (false, true) => StateKind::Busy,
                (true, true) => StateKind::Still,
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

fn timing(messages: &[LogMessage], feels: &[bool]) -> Vec<ReportTiming> {
    /// Share of the shortest gaps that is left out, because they may be chance or a fault (our choice).
    const SHORTEST: f64 = 0.02;
    let mut timing: Vec<ReportTiming> =
        feels.iter().map(|&feels| ReportTiming { feels, ..ReportTiming::default() }).collect();
    let mut gaps: Vec<Vec<Span>> = vec![Vec::new(); feels.len()];
    let mut last: Vec<Option<RunTime>> = vec![None; feels.len()];
    for message in messages.iter().filter(|message| message.said == MessageKind::Off) {
        timing[message.sensor].has_off = true;
    }
    for message in messages.iter().filter(|message| message.said != MessageKind::Word) {
        let sensor = message.sensor;
        if let Some(last) = last[sensor].filter(|_| message.said == MessageKind::On) {
            gaps[sensor].push(message.at - last);
        }
        let counts = message.said == MessageKind::Off || !timing[sensor].has_off;
        last[sensor] = counts.then_some(message.at);
    }
    for (timing, mut gaps) in timing.iter_mut().zip(gaps) {
        gaps.sort_unstable();
        timing.blind = gaps.get((gaps.len() as f64 * SHORTEST) as usize).copied().unwrap_or_default().max(Span::ZERO);
    }
    timing
}

impl SensorCounts {
    fn from_track(
        track: &[(RunTime, usize)],
        messages: &[LogMessage],
        timing: &[ReportTiming],
        states: usize,
    ) -> SensorCounts {
        let sensors = timing.len();
        let mut counts = SensorCounts {
            time_s: vec![0.0; states],
            messages: vec![vec![0.0; states]; sensors * KINDS],
            may_begin_s: vec![vec![0.0; states]; sensors],
            may_end_s: vec![vec![0.0; states]; sensors],
            turns: vec![vec![0.0; states]; states],
        };
        for pair in track.windows(2) {
            counts.time_s[pair[0].1] += (pair[1].0 - pair[0].0).seconds();
            counts.turns[pair[0].1][pair[1].1] += 1.0;
        }
        if let Some(&(at, state)) = track.last() {
            counts.time_s[state] += (END - at).seconds();
        }
        for sensor in 0..sensors {
            counts.may_begin_s[sensor].clone_from(&counts.time_s);
        }
        let mut last = vec![LastMessage::default(); sensors];
        let mut since = vec![RunTime::START; sensors];
        for message in messages {
            let sensor = message.sensor;
            let place = track.partition_point(|&(at, _)| at <= message.at).saturating_sub(1);
            counts.messages[channel(sensor, message.said)][track[place].1] += 1.0;
            if message.said != MessageKind::Word {
                counts.count_off_time(track, sensor, &last[sensor], Interval::new(since[sensor], message.at));
                last[sensor].hear(message, &timing[sensor]);
                since[sensor] = message.at;
            }
        }
        for sensor in 0..sensors {
            counts.count_off_time(track, sensor, &last[sensor], Interval::new(since[sensor], END));
        }
        counts
    }

    /// Counts the time during which a sensor was on, and could not send ON, as time during which it could send OFF.
    fn count_off_time(
        &mut self,
        track: &[(RunTime, usize)],
        sensor: usize,
        last: &LastMessage,
        span: Interval<RunTime>,
    ) {
        let until = span.begin + last.deaf(span);
        let first = track.partition_point(|&(at, _)| at <= span.begin).saturating_sub(1);
        for (place, &(at, state)) in track.iter().enumerate().skip(first) {
            if at >= until {
                break;
            }
            let end = track.get(place + 1).map_or(END, |next| next.0).min(until);
            let span_s = (end - at.max(span.begin)).seconds();
            self.may_begin_s[sensor][state] -= span_s;
            if last.is_on {
                self.may_end_s[sensor][state] += span_s;
            }
        }
    }

    /// Per second, by channel and state.
    fn rates(&self, timing: &[ReportTiming]) -> Vec<Vec<f32>> {
        let mut rates = Vec::with_capacity(self.messages.len());
        for (sensor, timing) in timing.iter().enumerate() {
            for said in [MessageKind::On, MessageKind::Off, MessageKind::Word] {
                let messages = &self.messages[channel(sensor, said)];
                let time_s = match said {
                    MessageKind::On => &self.may_begin_s[sensor],
                    MessageKind::Off => &self.may_end_s[sensor],
                    MessageKind::Word => &self.time_s,
                };
                // A presence sensor turns off at once elsewhere; all other messages are not expected where none was
                // counted.
                let (usual, beforehand_s) = match said {
                    MessageKind::Off if timing.feels => (GONE, GONE_BEFOREHAND_S),
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

    pub(crate) const END: RunTime = RunTime::START.saturating_add(SECOND.times(900));

    /// A bed and a chair, because a person who is seen when a log begins was somewhere.
    const FURNITURE: &str = r#""furniture": [
        { "name": "bed", "at": [6, 2.2], "size_m": [2, 1.4], "height_m": 0.55, "enterable": true, "role": "bed" },
        { "name": "chair", "at": [3.2, 0.5], "size_m": [0.5, 0.5], "height_m": 0.9, "enterable": true, "role": "dining_seat" }
    ],
    "sensors""#;

    pub(crate) fn senses() -> Senses {
        let home = include_str!("../../../tests/flat/home.json").replace("\"sensors\"", FURNITURE);
        let files = [
            ("scenario.json", include_str!("../../../tests/flat/scenario.json")),
            ("home.json", home.as_str()),
            ("logger.json", include_str!("../../../tests/flat/logger.json")),
            ("ann.json", include_str!("../../../tests/flat/ann.json")),
            ("ann.path.json", include_str!("../../../tests/flat/ann.path.json")),
            // Bob repeats Ann's path; his own keys would differ in each test.
            ("bob.json", r#"{ "name": "Bob", "driver": { "path": "ann.path.json" } }"#),
        ];
        let files: BTreeMap<String, String> =
            files.into_iter().map(|(name, text)| (name.to_owned(), text.to_owned())).collect();
        Senses::learn(&Scenario::load(&files, "scenario.json").unwrap(), 0).unwrap()
    }

    /// A walk from the kitchen to the bedroom and back.
    pub(crate) fn walk() -> Vec<LogMessage> {
        const KITCHEN: usize = 1;
        const BEDROOM: usize = 3;
        let at_s = [(3, KITCHEN), (5, KITCHEN), (9, BEDROOM), (12, BEDROOM), (300, BEDROOM), (640, KITCHEN)];
        let message = |(at_s, sensor)| LogMessage { at: RunTime::START + at_s * SECOND, sensor, said: MessageKind::On };
        at_s.map(message).to_vec()
    }
}
