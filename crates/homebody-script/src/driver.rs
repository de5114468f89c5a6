//! The driver that asks a script what to do.
//!
//! Two layers decide. `next` is asked whenever the body is free. `notice` is asked whenever something around has changed:
//! its answer comes first, and the interrupted steps continue afterwards. Steps without duration, such as turning on a
//! lamp, interrupt no walk.
//!
//! We assume that a resident notices changes in the whole home, within half a second while walking, and a second while
//! staying. Left out: waiting for others who are in the way.

use crate::cast::Cast;
use crate::engine::{counted, to_step};
use crate::messages::ScriptMessage;
use crate::moment::{Around, OtherResident, ScriptMoment, Streams};
use crate::program::Program;
use crate::step::ScriptStep;
use homebody_core::drivers::{Driver, Next, Surroundings};
use homebody_core::event::ThingUse;
use homebody_core::geometry::{self, Point};
use homebody_core::ids::ThingId;
use homebody_core::motion::{MotionSegment, MotionState};
use homebody_core::posture::Posture;
use homebody_core::random::Stream;
use homebody_core::role::Role;
use homebody_core::time::{HOUR, RunTime, SECOND, Span};
use homebody_walk::Wanderers;
use homebody_walk::body::WalkingBody;
use homebody_walk::places::HomePlace;
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

/// Interval at which a walking person looks around, and at which a staying one does (our choice).
const LOOKS_WALKING: Span = Span::from_millis(500);
const LOOKS_STAYING: Span = SECOND;

/// Time that a person who finds no way, or has an obstacle before them, stands still, so that an attempt takes time
/// (our choice).
const AT_A_LOSS: Span = SECOND;

/// Shortest step, in metres (our choice).
const SHORTEST_STEP_M: f64 = 0.02;

/// Time at the open front door, as in routines (our choice).
const AT_THE_DOOR: Span = SECOND.times(5);

/// A resident with a script. A copy has the same memory and draws the same numbers.
#[derive(Clone, Debug)]
pub struct ScriptDriver {
    program: Arc<Program>,
    cast: Arc<Cast>,
    body: WalkingBody,
    whereabouts: BodyWhereabouts,
    /// The script's `this`; `None` before the first question.
    memory: Option<Dynamic>,
    streams: Streams,
    /// Draws the pace and the movements on the spot.
    own: Stream,
    /// The next step first.
    steps: VecDeque<ScriptStep>,
    /// The part of the current step that is not yet in `moves`.
    under_way: Option<ScriptStep>,
    moves: VecDeque<MotionSegment>,
    /// Answers without duration, which come before `moves`.
    at_once: VecDeque<Next>,
    /// The current activity, and the one in the ground truth.
    activity: Option<String>,
    told: Option<String>,
    /// Decisions in a row without duration.
    idle: u32,
    /// Hour of the run, and operations in it.
    spent: (i64, u64),
    seen: Option<NoticedState>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum BodyWhereabouts {
    /// Before the first step.
    Nowhere,
    Home,
    Out,
}

/// A change of any of these is noticed.
#[derive(Clone, Debug, PartialEq)]
struct NoticedState {
    on: Vec<bool>,
    own: (Option<usize>, Option<Posture>),
    others: Vec<(usize, Option<usize>, Posture)>,
    is_dark: bool,
}

impl NoticedState {
    fn from_moment(moment: &ScriptMoment) -> NoticedState {
        let plan = &moment.cast.home.plan;
        let other = |other: &OtherResident| (other.index, plan.room_at(other.at), other.posture);
        NoticedState {
            on: moment.on.clone(),
            own: (moment.body.and_then(|(at, _)| plan.room_at(at)), moment.body.map(|(_, posture)| posture)),
            others: moment.others.iter().map(other).collect(),
            is_dark: moment.is_dark(),
        }
    }
}

impl ScriptDriver {
    /// The body starts where the first step leads.
    pub fn new(program: Arc<Program>, cast: Cast) -> ScriptDriver {
        let body = WalkingBody::new(cast.home.clone(), cast.mesh.clone(), cast.pace_mps);
        let own = Stream::named(cast.seed, &format!("script body/{}", cast.name));
        ScriptDriver {
            program,
            cast: Arc::new(cast),
            body,
            whereabouts: BodyWhereabouts::Nowhere,
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

    fn decide(&mut self, around: &Surroundings) -> Result<Next, String> {
        let now = around.now();
        loop {
            if self.whereabouts == BodyWhereabouts::Home && self.is_busy() && self.program.notices() {
                self.notice(around)?;
            }
            if let Some(next) = self.next_answer(now) {
                return Ok(next);
            }
            let goes_on = self
                .under_way
                .take()
                .filter(|step| matches!(step, ScriptStep::Wait { left, .. } if *left > Span::ZERO));
            if let Some(step) = goes_on.or_else(|| self.steps.pop_front()) {
                self.take(step, now)?;
                continue;
            }
            let answer = self.ask(around, |program, around, memory| program.next(around, memory))?;
            let step = to_step(answer).map_err(|error| self.program.answered(*error))?;
            self.plan(step)?;
        }
    }

    fn is_busy(&self) -> bool {
        !(self.moves.is_empty() && self.at_once.is_empty() && self.steps.is_empty() && self.under_way.is_none())
    }

    /// The next answer that is ready, preceded by its activity.
    fn next_answer(&mut self, now: RunTime) -> Option<Next> {
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
            let [first, rest] = next.split(look);
            self.moves.push_front(rest);
            next = first;
        }
        self.body.follow(&next);
        Some(Next::Segment(next))
    }

    /// Asks the script within the operations left in this hour.
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
        let moment =
            Around::new(ScriptMoment::new(self.cast.clone(), self.program.constants(), around, place, streams));
        let program = self.program.clone();
        let mut memory = match self.memory.take() {
            Some(memory) => memory,
            None => program.begin(&moment)?,
        };
        let (answer, operations) = counted(|| question(&program, &moment, &mut memory));
        self.memory = Some(memory);
        self.streams = std::mem::take(&mut moment.moment().streams);
        let hour = around.now().since_zero().div_euclid(HOUR);
        if self.spent.0 != hour {
            self.spent = (hour, 0);
        }
        self.spent.1 += operations + OPERATIONS_OF_ASKING;
        if self.spent.1 > MOST_OPERATIONS_AN_HOUR {
            return Err(program.at_next(ScriptMessage::SlowHour { most: MOST_OPERATIONS_AN_HOUR }));
        }
        answer
    }

    fn is_at(&self, spot: &HomePlace) -> bool {
        self.whereabouts == BodyWhereabouts::Home && self.body.at().distance(spot.at) < 0.01
    }

    fn notice(&mut self, around: &Surroundings) -> Result<(), String> {
        let seen = NoticedState::from_moment(&ScriptMoment::new(
            self.cast.clone(),
            self.program.constants(),
            around,
            "",
            Streams::new(),
        ));
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

    fn do_at_once(&mut self, step: ScriptStep) {
        match step {
            ScriptStep::All(steps) => steps.into_iter().for_each(|step| self.do_at_once(step)),
            ScriptStep::Use { thing, on } => self.use_thing(thing, on),
            ScriptStep::Activity(label) => self.activity = label,
            _ => {}
        }
    }

    fn use_thing(&mut self, thing: u32, on: bool) {
        self.at_once.push_back(Next::Use(ThingUse { thing: ThingId(thing), on }));
    }

    /// Interrupts the current step, so that it can continue later.
    fn interrupt(&mut self, now: RunTime) {
        let still = self.moves.back().map_or(Span::ZERO, |last| last.end - now);
        self.moves.clear();
        let resumed = match self.under_way.take() {
            Some(ScriptStep::Wait { left, manner, .. }) => Some(ScriptStep::wait(left + still, manner)),
            Some(ScriptStep::Rest { .. }) => Some(ScriptStep::Rest { left: still }),
            Some(ScriptStep::Wander { kind, .. }) => Some(ScriptStep::Wander { kind, left: still }),
            Some(step @ (ScriptStep::Go(_) | ScriptStep::GoTo(_))) => Some(step),
            _ => None,
        };
        let Some(step) = resumed
            .filter(|step| still > Span::ZERO || matches!(step, ScriptStep::Wait { left, .. } if *left > Span::ZERO))
        else {
            return;
        };
        let stays = matches!(step, ScriptStep::Wait { .. } | ScriptStep::Rest { .. });
        self.steps.push_front(step);
        if stays {
            let there = self.body.spot().filter(|spot| self.is_at(spot));
            let back = |spot: &HomePlace| {
                ScriptStep::Go(HomePlace { at: self.body.at(), posture: self.body.posture(), ..spot.clone() })
            };
            self.steps.push_front(there.map_or(ScriptStep::GoTo(self.body.at()), back));
        }
        self.steps.push_front(ScriptStep::Activity(self.activity.clone()));
    }

    fn plan(&mut self, step: ScriptStep) -> Result<(), String> {
        match step {
            ScriptStep::All(steps) => steps.into_iter().try_for_each(|step| self.plan(step)),
            ScriptStep::Instead => {
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

    fn take(&mut self, step: ScriptStep, now: RunTime) -> Result<(), String> {
        if self.begins_elsewhere(&step)? {
            return Ok(());
        }
        match step {
            ScriptStep::Go(_)
            | ScriptStep::GoTo(_)
            | ScriptStep::Stand
            | ScriptStep::Straight { .. }
            | ScriptStep::Wander { .. } => {
                self.walk(step, now)?;
            }
            ScriptStep::Wait { left, manner, stirs } => self.wait(left, manner, stirs, now),
            ScriptStep::Rest { left } => {
                self.stay(MotionState::Rest { at: self.body.at() }, left, now);
                self.under_way = Some(step);
            }
            ScriptStep::Use { thing, on } => self.use_thing(thing, on),
            ScriptStep::Activity(label) => self.activity = label,
            ScriptStep::LeaveHome if self.whereabouts == BodyWhereabouts::Home => {
                let door = self.front_door()?;
                let at_the_door = self.through_the_door();
                self.steps.push_front(ScriptStep::Outside);
                at_the_door.into_iter().rev().for_each(|step| self.steps.push_front(step));
                self.steps.push_front(ScriptStep::Go(door));
            }
            ScriptStep::Outside => self.whereabouts = BodyWhereabouts::Out,
            // At home there is nowhere to come from, and a list was expanded before.
            ScriptStep::LeaveHome | ScriptStep::ComeHome | ScriptStep::Instead | ScriptStep::All(_) => {}
        }
        Ok(())
    }

    /// Places a body that has no place yet, or is out, at the start of the step; true if that completes the step.
    fn begins_elsewhere(&mut self, step: &ScriptStep) -> Result<bool, String> {
        let needs_body = !matches!(
            step,
            ScriptStep::Activity(_)
                | ScriptStep::Use { .. }
                | ScriptStep::LeaveHome
                | ScriptStep::Outside
                | ScriptStep::Instead
        );
        match self.whereabouts {
            BodyWhereabouts::Nowhere if matches!(step, ScriptStep::LeaveHome) => {
                self.whereabouts = BodyWhereabouts::Out;
                Ok(true)
            }
            BodyWhereabouts::Nowhere if needs_body => {
                let is_there = matches!(step, ScriptStep::Go(_) | ScriptStep::ComeHome);
                let spot = match step {
                    ScriptStep::Go(spot) => spot.clone(),
                    ScriptStep::ComeHome => self.front_door()?,
                    ScriptStep::GoTo(at) if self.cast.mesh.is_free(*at) => HomePlace::to_stand(*at, 0),
                    _ => self
                        .cast
                        .places
                        .for_role(Role::Armchair)
                        .cloned()
                        .ok_or_else(|| self.program.at_next(ScriptMessage::NoStart))?,
                };
                let posture = spot.posture;
                self.body.place(spot, posture);
                self.whereabouts = BodyWhereabouts::Home;
                Ok(is_there)
            }
            BodyWhereabouts::Out if matches!(step, ScriptStep::ComeHome) => {
                let door = self.front_door()?;
                self.body.place(door, Posture::Standing);
                self.whereabouts = BodyWhereabouts::Home;
                let at_the_door = self.through_the_door();
                at_the_door.into_iter().rev().for_each(|step| self.steps.push_front(step));
                Ok(true)
            }
            BodyWhereabouts::Out
                if needs_body && !matches!(step, ScriptStep::Wait { .. } | ScriptStep::Rest { .. }) =>
            {
                self.steps.push_front(step.clone());
                self.steps.push_front(ScriptStep::ComeHome);
                Ok(true)
            }
            _ => Ok(false),
        }
    }

    fn front_door(&self) -> Result<HomePlace, String> {
        let door = self.cast.places.for_role(Role::FrontDoor).cloned();
        door.ok_or_else(|| self.program.at_next(ScriptMessage::NoFrontDoor))
    }

    fn through_the_door(&self) -> Vec<ScriptStep> {
        let act = |on| self.cast.places.thing(Role::FrontDoor).map(|thing| ScriptStep::Use { thing, on });
        let stands = Some(ScriptStep::wait(AT_THE_DOOR, None));
        [act(true), stands, act(false)].into_iter().flatten().collect()
    }

    fn walk(&mut self, step: ScriptStep, now: RunTime) -> Result<(), String> {
        let hour = self.cast.hour(now);
        let moves = match &step {
            ScriptStep::Go(spot) => self
                .go(spot, hour, now)
                .ok_or_else(|| self.program.at_next(ScriptMessage::NoWay { place: spot.name.clone() }))?,
            ScriptStep::GoTo(at) => {
                let room = self.cast.home.plan.room_at(*at);
                let moves = room.and_then(|room| self.go(&HomePlace::to_stand(*at, room), hour, now));
                moves.unwrap_or_else(|| vec![self.at_a_loss(now)])
            }
            ScriptStep::Stand => self.body.get_up(now, hour, 1.0, &mut self.own),
            ScriptStep::Wander { kind, left } => self.body.wander(
                *kind,
                *left,
                now,
                hour,
                1.0,
                Wanderers { gains: self.cast.gains, others: &[] },
                &mut self.own,
            ),
            ScriptStep::Straight { degrees, metres } => {
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

    /// `None` without a route.
    fn go(&mut self, spot: &HomePlace, hour: f64, now: RunTime) -> Option<Vec<MotionSegment>> {
        if !self.is_at(spot) || self.body.posture() == spot.posture {
            return self.body.go(spot, now, hour, 1.0, &mut self.own);
        }
        Some(match spot.posture {
            Posture::Standing => self.body.get_up(now, hour, 1.0, &mut self.own),
            posture => vec![self.body.sit_down(posture, now, 1.0, &mut self.own)],
        })
    }

    /// As far as the floor is free, at the usual pace.
    fn straight(&mut self, degrees: f64, metres: f64, now: RunTime) -> MotionSegment {
        let from = self.body.at();
        let free = self.cast.mesh.free_way(from, degrees, metres);
        if free < SHORTEST_STEP_M {
            return self.at_a_loss(now);
        }
        let to: Point = from + geometry::direction(degrees) * free;
        let end = now + Span::from_seconds(free / self.cast.pace_mps).max(Span::MICROSECOND);
        MotionSegment { begin: now, end, doing: MotionState::Stride { from, to }, posture: Posture::Standing }
    }

    fn at_a_loss(&self, now: RunTime) -> MotionSegment {
        let doing = MotionState::Rest { at: self.body.at() };
        MotionSegment { begin: now, end: now + AT_A_LOSS, doing, posture: self.body.posture() }
    }

    /// One pause or movement of a stay.
    fn wait(&mut self, left: Span, manner: Option<homebody_walk::manner::Manner>, stirs: bool, now: RunTime) {
        if self.whereabouts == BodyWhereabouts::Out {
            return self.stay(MotionState::Away, left, now);
        }
        let usual = manner
            .unwrap_or_else(|| ScriptStep::usual_manner(self.body.posture()))
            .with_numbers(&self.cast.home.numbers);
        let at = self.body.at();
        let (span, doing) = match stirs {
            true => (usual.bout(&mut self.own), MotionState::InPlace { at, amplitude_m: usual.amplitude_m }),
            false => (usual.gap(1.0, &mut self.own), MotionState::Rest { at }),
        };
        let span = span.min(left);
        self.stay(doing, span, now);
        self.under_way = Some(ScriptStep::Wait { left: left - span, manner, stirs: !stirs });
    }

    fn stay(&mut self, doing: MotionState, lasts: Span, now: RunTime) {
        let doing = if self.whereabouts == BodyWhereabouts::Out { MotionState::Away } else { doing };
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
