//! Lives by a script: asks it what comes next, and lets the body do it.
//!
//! Two layers decide. `next` is asked whenever the body is free, and says what is to be done. `notice` is asked whenever
//! something around has changed while that is done: what it answers comes first, and what was interrupted goes on
//! afterwards. What takes no time, such as turning on a lamp, breaks no walk.
//!
//! We assume that somebody sees and hears what happens in the whole home, half a second later at most while they walk, and
//! a second while they stay. Left out: waiting for others who are in the way.

use crate::cast::Cast;
use crate::engine::{counted, to_step};
use crate::messages::ScriptMessage;
use crate::moment::{Around, Moment, Other, Streams};
use crate::program::Program;
use crate::step::Step;
use homebody_core::drivers::{Driver, MotionSegment, Next, Surroundings};
use homebody_core::event::{MotionState, ThingUse};
use homebody_core::geometry::{self, Point};
use homebody_core::ids::ThingId;
use homebody_core::random::Stream;
use homebody_core::role::Role;
use homebody_core::scenario::path::Posture;
use homebody_core::time::{Micros, SECOND, micros};
use homebody_walk::Wanderers;
use homebody_walk::body::Body;
use homebody_walk::places::Spot;
use rhai::Dynamic;
use std::collections::VecDeque;
use std::sync::Arc;

/// Number of decisions in a row without duration after which a script is stuck (our choice).
const MOST_DECISIONS: u32 = 100;

/// Largest number of operations for an hour of the run (our choice): some decisions a second, each of some hundreds. No
/// script takes the time of all others.
const MOST_OPERATIONS_AN_HOUR: u64 = 5_000_000;

/// Operations that a decision costs in addition to those of the script (our choice).
const OPERATIONS_OF_ASKING: u64 = 100;

/// Largest number of steps that may wait (our choice).
const MOST_STEPS: usize = 500;

const HOUR: Micros = 3_600 * SECOND;

/// Interval at which a walking person looks around, and at which a staying one does (our choice).
const LOOKS_WALKING: Micros = SECOND / 2;
const LOOKS_STAYING: Micros = SECOND;

/// Time that a person who finds no way, or has an obstacle before them, stands still, so that an attempt takes time
/// (our choice).
const AT_A_LOSS: Micros = SECOND;

/// Shortest step, in metres (our choice).
const SHORTEST_STEP_M: f64 = 0.02;

/// Time at the open front door, as in routines (our choice).
const AT_THE_DOOR: Micros = 5 * SECOND;

/// A resident who lives by a script. A copy has the same memory and draws the same numbers.
#[derive(Clone, Debug)]
pub struct ScriptDriver {
    program: Arc<Program>,
    cast: Arc<Cast>,
    body: Body,
    whereabouts: Whereabouts,
    /// What the script remembers: its `this`. `None` before it was asked for the first time.
    memory: Option<Dynamic>,
    streams: Streams,
    /// For how fast one walks and how often one stirs.
    own: Stream,
    /// What is to be done, the next step first.
    steps: VecDeque<Step>,
    /// The step that is being done, as far as `moves` do not have it.
    under_way: Option<Step>,
    moves: VecDeque<MotionSegment>,
    /// What comes before them, and takes no time.
    at_once: VecDeque<Next>,
    /// What is done is called so, and as it was told last.
    activity: Option<String>,
    told: Option<String>,
    /// How often in a row the script has decided on nothing that takes time.
    idle: u32,
    /// An hour of the run, and the operations that it has taken.
    spent: (Micros, u64),
    seen: Option<Seen>,
}

/// Where a body is.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Whereabouts {
    /// The run has just begun.
    Nowhere,
    Home,
    Out,
}

/// What may change around somebody, and is noticed.
#[derive(Clone, Debug, PartialEq)]
struct Seen {
    on: Vec<bool>,
    own: (Option<usize>, Option<Posture>),
    others: Vec<(usize, Option<usize>, Posture)>,
    is_dark: bool,
}

impl Seen {
    fn of(moment: &Moment) -> Seen {
        let plan = &moment.cast.home.plan;
        let other = |other: &Other| (other.index, plan.room_at(other.at), other.posture);
        Seen {
            on: moment.on.clone(),
            own: (moment.body.and_then(|(at, _)| plan.room_at(at)), moment.body.map(|(_, posture)| posture)),
            others: moment.others.iter().map(other).collect(),
            is_dark: moment.is_dark(),
        }
    }
}

impl ScriptDriver {
    /// A resident at the beginning of a run. Where the first step leads, they are already.
    pub fn new(program: Arc<Program>, cast: Cast) -> ScriptDriver {
        let body = Body::new(cast.home.clone(), cast.mesh.clone(), cast.pace_mps);
        let own = Stream::named(cast.seed, &format!("script body/{}", cast.name));
        ScriptDriver {
            program,
            cast: Arc::new(cast),
            body,
            whereabouts: Whereabouts::Nowhere,
            memory: None,
            streams: Streams::new(),
            own,
            steps: VecDeque::new(),
            under_way: None,
            moves: VecDeque::new(),
            at_once: VecDeque::new(),
            activity: None,
            told: None,
            idle: 0,
            spent: (0, 0),
            seen: None,
        }
    }

    /// What comes next, or why there is nothing.
    fn decide(&mut self, around: &Surroundings) -> Result<Next, String> {
        let now = around.now();
        loop {
            if self.whereabouts == Whereabouts::Home && self.is_busy() && self.program.notices() {
                self.notice(around)?;
            }
            if let Some(next) = self.next_answer(now) {
                return Ok(next);
            }
            let goes_on = self.under_way.take().filter(|step| matches!(step, Step::Wait { left, .. } if *left > 0));
            if let Some(step) = goes_on.or_else(|| self.steps.pop_front()) {
                self.take(step, now)?;
                continue;
            }
            let answer = self.ask(around, |program, around, memory| program.next(around, memory))?;
            let step = to_step(answer).map_err(|error| self.program.answered(*error))?;
            self.plan(step)?;
        }
    }

    /// Whether anything is to be done.
    fn is_busy(&self) -> bool {
        !(self.moves.is_empty() && self.at_once.is_empty() && self.steps.is_empty() && self.under_way.is_none())
    }

    /// The next answer of those that are ready; what is done is named first.
    fn next_answer(&mut self, now: Micros) -> Option<Next> {
        if self.at_once.is_empty() && self.moves.is_empty() {
            return None;
        }
        if self.told != self.activity {
            self.told.clone_from(&self.activity);
            return Some(Next::Activity(self.activity.clone()));
        }
        if let Some(next) = self.at_once.pop_front() {
            return Some(next);
        }
        let mut next = self.moves.pop_front()?;
        self.idle = 0;
        let is_walk = matches!(next.doing, MotionState::Stride { .. });
        let look = now + if is_walk { LOOKS_WALKING } else { LOOKS_STAYING };
        if next.end > look && self.program.notices() && next.doing != MotionState::Away {
            let first = next.until(look);
            let doing = match (first.to(), next.doing) {
                (Some(from), MotionState::Stride { to, .. }) => MotionState::Stride { from, to },
                (_, doing) => doing,
            };
            self.moves.push_front(MotionSegment { begin: look, doing, ..next });
            next = first;
        }
        self.body.follow(&next);
        Some(Next::Segment(next))
    }

    /// Asks the script, which may have no more of operations than an hour has.
    fn ask(
        &mut self,
        around: &Surroundings,
        question: impl FnOnce(&Program, &Around, &mut Dynamic) -> Result<Dynamic, String>,
    ) -> Result<Dynamic, String> {
        self.idle += 1;
        if self.idle > MOST_DECISIONS {
            return Err(self.program.at_next(ScriptMessage::NoTime { most: MOST_DECISIONS }));
        }
        let place = self.body.spot().filter(|spot| self.is_at(spot)).map_or("", |spot| spot.name.as_str());
        let streams = std::mem::take(&mut self.streams);
        let moment = Around::new(Moment::new(self.cast.clone(), self.program.constants(), around, place, streams));
        let program = self.program.clone();
        let mut memory = match self.memory.take() {
            Some(memory) => memory,
            None => program.begin(&moment)?,
        };
        let (answer, operations) = counted(|| question(&program, &moment, &mut memory));
        self.memory = Some(memory);
        self.streams = std::mem::take(&mut moment.moment().streams);
        let hour = around.now().div_euclid(HOUR);
        if self.spent.0 != hour {
            self.spent = (hour, 0);
        }
        self.spent.1 += operations + OPERATIONS_OF_ASKING;
        if self.spent.1 > MOST_OPERATIONS_AN_HOUR {
            return Err(program.at_next(ScriptMessage::SlowHour { most: MOST_OPERATIONS_AN_HOUR }));
        }
        answer
    }

    fn is_at(&self, spot: &Spot) -> bool {
        self.whereabouts == Whereabouts::Home && self.body.at().distance(spot.at) < 0.01
    }

    /// Asks whether something is to be done at once, where anything has changed.
    fn notice(&mut self, around: &Surroundings) -> Result<(), String> {
        let seen = Seen::of(&Moment::new(self.cast.clone(), self.program.constants(), around, "", Streams::new()));
        if self.seen.as_ref() == Some(&seen) {
            return Ok(());
        }
        self.seen = Some(seen);
        let answer = self.ask(around, |program, around, memory| program.notice(around, memory))?;
        if answer.is_unit() {
            return Ok(());
        }
        let step = to_step(answer).map_err(|error| self.program.answered(*error))?;
        if step.is_instant() {
            self.do_at_once(step);
            return Ok(());
        }
        self.interrupt(around.now());
        let later = std::mem::take(&mut self.steps);
        let drops_them = step.drops_the_rest();
        self.plan(step)?;
        if !drops_them {
            self.steps.extend(later);
        }
        self.not_too_many()
    }

    /// What takes no time, before what is under way goes on.
    fn do_at_once(&mut self, step: Step) {
        match step {
            Step::All(steps) => steps.into_iter().for_each(|step| self.do_at_once(step)),
            Step::Use { thing, on } => self.use_thing(thing, on),
            Step::Activity(label) => self.activity = label,
            _ => {}
        }
    }

    fn use_thing(&mut self, thing: u32, on: bool) {
        self.at_once.push_back(Next::Use(ThingUse { thing: ThingId(thing), on }));
    }

    /// What is under way is broken off, to go on later where it was.
    fn interrupt(&mut self, now: Micros) {
        let still = self.moves.back().map_or(0, |last| last.end - now);
        self.moves.clear();
        let resumed = match self.under_way.take() {
            Some(Step::Wait { left, manner, .. }) => Some(Step::wait(left + still, manner)),
            Some(Step::Rest { .. }) => Some(Step::Rest { left: still }),
            Some(Step::Wander { kind, .. }) => Some(Step::Wander { kind, left: still }),
            Some(step @ (Step::Go(_) | Step::GoTo(_))) => Some(step),
            _ => None,
        };
        let Some(step) = resumed.filter(|step| still > 0 || matches!(step, Step::Wait { left, .. } if *left > 0))
        else {
            return;
        };
        let stays = matches!(step, Step::Wait { .. } | Step::Rest { .. });
        self.steps.push_front(step);
        if stays {
            let there = self.body.spot().filter(|spot| self.is_at(spot));
            let back =
                |spot: &Spot| Step::Go(Spot { at: self.body.at(), posture: self.body.posture(), ..spot.clone() });
            self.steps.push_front(there.map_or(Step::GoTo(self.body.at()), back));
        }
        self.steps.push_front(Step::Activity(self.activity.clone()));
    }

    /// Adds what a script answered to what is to be done.
    fn plan(&mut self, step: Step) -> Result<(), String> {
        match step {
            Step::All(steps) => steps.into_iter().try_for_each(|step| self.plan(step)),
            Step::Instead => {
                self.steps.clear();
                Ok(())
            }
            step => {
                self.steps.push_back(step);
                self.not_too_many()
            }
        }
    }

    fn not_too_many(&self) -> Result<(), String> {
        if self.steps.len() <= MOST_STEPS {
            return Ok(());
        }
        Err(self.program.at_next(ScriptMessage::TooManySteps { most: MOST_STEPS }))
    }

    /// Begins a step.
    fn take(&mut self, step: Step, now: Micros) -> Result<(), String> {
        if self.begins_elsewhere(&step)? {
            return Ok(());
        }
        match step {
            Step::Go(_) | Step::GoTo(_) | Step::Stand | Step::Straight { .. } | Step::Wander { .. } => {
                self.walk(step, now)?;
            }
            Step::Wait { left, manner, stirs } => self.wait(left, manner, stirs, now),
            Step::Rest { left } => {
                self.stay(MotionState::Rest { at: self.body.at() }, left, now);
                self.under_way = Some(step);
            }
            Step::Use { thing, on } => self.use_thing(thing, on),
            Step::Activity(label) => self.activity = label,
            Step::LeaveHome if self.whereabouts == Whereabouts::Home => {
                let door = self.front_door()?;
                let at_the_door = self.through_the_door();
                self.steps.push_front(Step::Outside);
                at_the_door.into_iter().rev().for_each(|step| self.steps.push_front(step));
                self.steps.push_front(Step::Go(door));
            }
            Step::Outside => self.whereabouts = Whereabouts::Out,
            // Who is at home comes from nowhere, and what a list has stands among the steps.
            Step::LeaveHome | Step::ComeHome | Step::Instead | Step::All(_) => {}
        }
        Ok(())
    }

    /// Lets a body that is nowhere yet, or out, be where the step can begin; true where that was the whole of it.
    fn begins_elsewhere(&mut self, step: &Step) -> Result<bool, String> {
        let needs_body =
            !matches!(step, Step::Activity(_) | Step::Use { .. } | Step::LeaveHome | Step::Outside | Step::Instead);
        match self.whereabouts {
            Whereabouts::Nowhere if matches!(step, Step::LeaveHome) => {
                self.whereabouts = Whereabouts::Out;
                Ok(true)
            }
            Whereabouts::Nowhere if needs_body => {
                let is_there = matches!(step, Step::Go(_) | Step::ComeHome);
                let spot = match step {
                    Step::Go(spot) => spot.clone(),
                    Step::ComeHome => self.front_door()?,
                    Step::GoTo(at) if self.cast.mesh.is_free(*at) => Spot::to_stand(*at, 0),
                    _ => self
                        .cast
                        .places
                        .of(Role::Armchair)
                        .cloned()
                        .ok_or_else(|| self.program.at_next(ScriptMessage::NoStart))?,
                };
                let posture = spot.posture;
                self.body.place(spot, posture);
                self.whereabouts = Whereabouts::Home;
                Ok(is_there)
            }
            Whereabouts::Out if matches!(step, Step::ComeHome) => {
                let door = self.front_door()?;
                self.body.place(door, Posture::Standing);
                self.whereabouts = Whereabouts::Home;
                let at_the_door = self.through_the_door();
                at_the_door.into_iter().rev().for_each(|step| self.steps.push_front(step));
                Ok(true)
            }
            Whereabouts::Out if needs_body && !matches!(step, Step::Wait { .. } | Step::Rest { .. }) => {
                self.steps.push_front(step.clone());
                self.steps.push_front(Step::ComeHome);
                Ok(true)
            }
            _ => Ok(false),
        }
    }

    fn front_door(&self) -> Result<Spot, String> {
        let door = self.cast.places.of(Role::FrontDoor).cloned();
        door.ok_or_else(|| self.program.at_next(ScriptMessage::NoFrontDoor))
    }

    /// What is done at the front door by who goes in or out.
    fn through_the_door(&self) -> Vec<Step> {
        let act = |on| self.cast.places.thing(Role::FrontDoor).map(|thing| Step::Use { thing, on });
        let stands = Some(Step::wait(AT_THE_DOOR, None));
        [act(true), stands, act(false)].into_iter().flatten().collect()
    }

    /// A step on one's feet.
    fn walk(&mut self, step: Step, now: Micros) -> Result<(), String> {
        let hour = self.cast.hour(now);
        let moves = match &step {
            Step::Go(spot) => self
                .go(spot, hour, now)
                .ok_or_else(|| self.program.at_next(ScriptMessage::NoWay { place: spot.name.clone() }))?,
            Step::GoTo(at) => {
                let room = self.cast.home.plan.room_at(*at);
                let moves = room.and_then(|room| self.go(&Spot::to_stand(*at, room), hour, now));
                moves.unwrap_or_else(|| vec![self.at_a_loss(now)])
            }
            Step::Stand => self.body.get_up(now, hour, 1.0, &mut self.own),
            Step::Wander { kind, left } => self.body.wander(
                *kind,
                *left,
                now,
                hour,
                1.0,
                Wanderers { gains: self.cast.gains, others: &[] },
                &mut self.own,
            ),
            Step::Straight { degrees, metres } => {
                let stands = self.body.posture() == Posture::Standing && self.cast.mesh.is_free(self.body.at());
                let first = if stands { Vec::new() } else { self.body.get_up(now, hour, 1.0, &mut self.own) };
                if first.is_empty() {
                    vec![self.straight(*degrees, *metres, now)]
                } else {
                    self.steps.push_front(step.clone());
                    first
                }
            }
            _ => Vec::new(),
        };
        self.moves.extend(moves);
        self.under_way = Some(step);
        Ok(())
    }

    /// The moves to a place, whatever the posture there; `None` where no way leads.
    fn go(&mut self, spot: &Spot, hour: f64, now: Micros) -> Option<Vec<MotionSegment>> {
        if !self.is_at(spot) || self.body.posture() == spot.posture {
            return self.body.go(spot, now, hour, 1.0, &mut self.own);
        }
        Some(match spot.posture {
            Posture::Standing => self.body.get_up(now, hour, 1.0, &mut self.own),
            posture => vec![self.body.settle(posture, now, 1.0, &mut self.own)],
        })
    }

    /// Straight ahead as far as it is free, at one's usual pace.
    fn straight(&mut self, degrees: f64, metres: f64, now: Micros) -> MotionSegment {
        let from = self.body.at();
        let free = self.cast.mesh.free_way(from, degrees, metres);
        if free < SHORTEST_STEP_M {
            return self.at_a_loss(now);
        }
        let to: Point = from + geometry::direction(degrees) * free;
        let end = now + micros(free / self.cast.pace_mps).max(1);
        MotionSegment { begin: now, end, doing: MotionState::Stride { from, to }, posture: Posture::Standing }
    }

    fn at_a_loss(&self, now: Micros) -> MotionSegment {
        let doing = MotionState::Rest { at: self.body.at() };
        MotionSegment { begin: now, end: now + AT_A_LOSS, doing, posture: self.body.posture() }
    }

    /// Stays, and stirs now and then: one pause or movement of it.
    fn wait(&mut self, left: Micros, manner: Option<homebody_walk::manner::Manner>, stirs: bool, now: Micros) {
        if self.whereabouts == Whereabouts::Out {
            return self.stay(MotionState::Away, left, now);
        }
        let usual = manner.unwrap_or_else(|| Step::usual_manner(self.body.posture())).by(&self.cast.home.numbers);
        let at = self.body.at();
        let (span, doing) = match stirs {
            true => (usual.bout(&mut self.own), MotionState::InPlace { at, amplitude_m: usual.amplitude_m }),
            false => (usual.gap(1.0, &mut self.own), MotionState::Rest { at }),
        };
        let span = span.min(left);
        self.stay(doing, span, now);
        self.under_way = Some(Step::Wait { left: left - span, manner, stirs: !stirs });
    }

    fn stay(&mut self, doing: MotionState, lasts: Micros, now: Micros) {
        let doing = if self.whereabouts == Whereabouts::Out { MotionState::Away } else { doing };
        let posture = if doing == MotionState::Away { Posture::Standing } else { self.body.posture() };
        self.moves.push_back(MotionSegment { begin: now, end: now + lasts, doing, posture });
    }
}

impl Driver for ScriptDriver {
    fn next(&mut self, around: &Surroundings) -> Next {
        self.decide(around).unwrap_or_else(Next::Failed)
    }

    fn copy(&self) -> Box<dyn Driver> {
        Box::new(self.clone())
    }
}
