//! The places of people by a growing log, from the rows until now.

use crate::error::TrackingError;
use crate::translation::{HomeMessages, TranslationMessage, bodies};
use homebody_core::scenario::load::Scenario;
use homebody_core::time::{RunTime, SECOND, Span};
use homebody_infer::{Follower, Guess, Senses, StateKind};
use homebody_log::Log;
use serde::Serialize;
use std::fmt;

/// Interval, in the time of the log, between positions without a row (our choice): silence is evidence, too.
const ASKED: Span = SECOND.times(30);

pub struct FollowedHome {
    bodies: Vec<Senses>,
    nobody: Senses,
    people: Vec<String>,
    rooms: Vec<String>,
    sensors: Vec<String>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PersonLocation {
    pub time: String,
    /// The resident, or a guest if there is one resident.
    pub who: String,
    /// `None` outside and between rooms.
    pub room: Option<String>,
    pub doing: &'static str,
    /// The probability of the room, from 0 to 1.
    pub chance: f64,
    /// The position in metres; `None` outside.
    pub at_m: Option<[f64; 2]>,
}

pub struct LogFollower<'a> {
    learnt: &'a FollowedHome,
    scenario: &'a Scenario,
    follower: Follower<'a>,
    /// The time of the last row, and the number of rows at that time.
    last: Option<(RunTime, usize)>,
    /// The time of the next position without a row.
    next: RunTime,
    /// The last report of each person.
    told: Vec<Option<(RoomState, Confidence)>>,
}

/// True if the person is out; the room, if they are in a room.
type RoomState = (bool, Option<usize>);

/// The confidence in a room, in words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Confidence {
    Sure,
    Likely,
    Unsure,
}

/// Smallest probability of a position that is sure, and of one that is likely (our choice).
const SURE: f64 = 0.9;
const LIKELY: f64 = 0.6;
/// Margin beyond its limit that a probability has to pass before the word for it changes (our choice).
const BEYOND: f64 = 0.05;

impl FollowedHome {
    /// Of the home of a scenario, which is only read.
    pub fn new(scenario: &Scenario) -> Result<FollowedHome, TrackingError> {
        let (bodies, people) = bodies(scenario)?;
        let Some(first) = bodies.first() else {
            return Err(TrackingError::Translation(TranslationMessage::NoResidents.into()));
        };
        let nobody = first.empty_body();
        let rooms = scenario.home.plan().rooms.iter().map(|room| room.name.clone()).collect();
        let sensors = scenario.home.placed_sensors().iter().map(|sensor| sensor.name.clone()).collect();
        Ok(FollowedHome { nobody, people, rooms, sensors, bodies })
    }
}

impl<'a> LogFollower<'a> {
    pub fn new(learnt: &'a FollowedHome, scenario: &'a Scenario) -> LogFollower<'a> {
        let follower = Follower::new(&learnt.bodies, &learnt.nobody);
        let told = vec![None; learnt.people.len()];
        LogFollower { learnt, scenario, follower, last: None, next: RunTime::START, told }
    }

    /// Takes the rows that have come since the log was given last, and tells of everybody whose room, or how sure that is, has
    /// changed. Rows that are older than one that was taken are left out.
    pub fn take(&mut self, log: &Log, mut tell: impl FnMut(PersonLocation)) -> Result<(), TrackingError> {
        if log.events.is_empty() {
            return Ok(());
        }
        let heard = HomeMessages::new(log, self.scenario, &self.learnt.sensors)?;
        let (last, mut taken) = self.last.unwrap_or((RunTime::MIN, 0));
        for message in heard.messages.iter().filter(|message| message.at >= last) {
            if message.at == last && taken > 0 {
                taken -= 1;
                continue;
            }
            // Before the first row nothing is known.
            if self.last.is_none() {
                self.next = message.at;
            }
            while self.next < message.at {
                self.follower.wait(self.next);
                self.tell(&heard, &mut tell);
                self.next += ASKED;
            }
            self.follower.hear(message);
            self.last = match self.last {
                Some((at, count)) if at == message.at => Some((at, count + 1)),
                _ => Some((message.at, 1)),
            };
            self.tell(&heard, &mut tell);
        }
        Ok(())
    }

    fn tell(&mut self, heard: &HomeMessages, tell: &mut impl FnMut(PersonLocation)) {
        let now = self.follower.now();
        let (told, learnt) = (&mut self.told, self.learnt);
        let mut people = learnt.people.iter().zip(told);
        now.report(|guess, _| {
            let Some((who, told)) = people.next() else { return };
            let place = (guess.state.at.is_none(), guess.state.room);
            let doubt = match told {
                Some((before, doubt)) if *before == place => doubt.after(guess.chance),
                _ => Confidence::from_chance(guess.chance),
            };
            // A guest is reported once they come.
            let is_new = told.is_some() || !place.0 || learnt.people.first() == Some(who);
            if is_new && told.replace((place, doubt)) != Some((place, doubt)) {
                tell(presence(heard.calendar.wall_clock(now.at), who, &guess, &learnt.rooms));
            }
        });
    }
}

fn presence(time: String, who: &str, guess: &Guess, rooms: &[String]) -> PersonLocation {
    let rounded = |metres: f64| (metres * 100.0).round() / 100.0;
    PersonLocation {
        time,
        who: who.to_owned(),
        room: guess.state.room.map(|room| rooms[room].clone()),
        doing: match guess.state.kind {
            StateKind::Out => "out",
            StateKind::Walks => "walks",
            StateKind::Stands => "stands",
            StateKind::Busy => "busy",
            StateKind::Still => "still",
            StateKind::Motionless => "motionless",
        },
        chance: (guess.chance * 1_000.0).round() / 1_000.0,
        at_m: guess.state.at.map(|at| [rounded(at.x), rounded(at.y)]),
    }
}

impl Confidence {
    fn from_chance(chance: f64) -> Confidence {
        match chance {
            _ if chance >= SURE => Confidence::Sure,
            _ if chance >= LIKELY => Confidence::Likely,
            _ => Confidence::Unsure,
        }
    }

    /// The next word: the same, as long as the chance is hardly beyond its limits.
    fn after(self, chance: f64) -> Confidence {
        match [chance - BEYOND, chance + BEYOND].map(Confidence::from_chance).contains(&self) {
            true => self,
            false => Confidence::from_chance(chance),
        }
    }
}

impl fmt::Display for PersonLocation {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let PersonLocation { time, who, room, doing, chance, .. } = self;
        let place = match (room, self.at_m) {
            (Some(room), _) => format!("in the {room}, {doing}"),
            (None, Some(_)) => format!("between rooms, {doing}"),
            (None, None) => "out".to_owned(),
        };
        let doubt = match Confidence::from_chance(*chance) {
            Confidence::Sure => "surely",
            Confidence::Likely => "likely",
            Confidence::Unsure => "perhaps",
        };
        write!(f, "{} {who}: {doubt} {place} ({chance:.2})", &time[..19.min(time.len())])
    }
}
