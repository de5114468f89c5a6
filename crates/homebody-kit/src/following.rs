//! Where everybody is, by a log that goes on: told from what was said until then, as it is said.

use crate::error::Error;
use crate::translation::{Heard, TranslationMessage, bodies};
use homebody_core::scenario::load::Scenario;
use homebody_core::time::{Micros, SECOND};
use homebody_infer::{Follower, Guess, Kind, Senses};
use homebody_log::Log;
use serde::Serialize;
use std::fmt;

/// Interval, in the time of the log, of the positions between two rows (our choice): silence is evidence, too.
const ASKED: Micros = 30 * SECOND;

/// What is known of a home before its log is read: how its sensors answer to who may be there.
pub struct Learnt {
    bodies: Vec<Senses>,
    nobody: Senses,
    people: Vec<String>,
    rooms: Vec<String>,
    sensors: Vec<String>,
}

/// Where somebody is now, and how sure that is.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Presence {
    /// On the clock on the wall.
    pub time: String,
    /// Who: a resident, or somebody else where one lives alone.
    pub who: String,
    /// The room; nothing of who is out or between the rooms.
    pub room: Option<String>,
    /// What they do there.
    pub doing: &'static str,
    /// How likely the room is, from 0 to 1.
    pub chance: f64,
    /// Where, in metres; nothing of who is out.
    pub at_m: Option<[f64; 2]>,
}

/// A log that is followed through the plan of its home.
pub struct Following<'a> {
    learnt: &'a Learnt,
    scenario: &'a Scenario,
    follower: Follower<'a>,
    /// When the row was that was taken last, and how many of that instant were taken.
    last: Option<(Micros, usize)>,
    /// When it is asked next.
    next: Micros,
    /// What was told of each.
    told: Vec<Option<(Whereabouts, Doubt)>>,
}

/// A room, or being out, or between the rooms.
type Whereabouts = (bool, Option<usize>);

/// How sure somebody can be of a room, in words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Doubt {
    Sure,
    Likely,
    Unsure,
}

/// Smallest probability of a position that is sure, and of one that is likely (our choice).
const SURE: f64 = 0.9;
const LIKELY: f64 = 0.6;
/// Margin beyond its limit that a probability has to pass before the word for it changes (our choice).
const BEYOND: f64 = 0.05;

impl Learnt {
    /// Of the home of a scenario, which is only read.
    ///
    /// # Errors
    ///
    /// [`Error::Translation`] where it has nobody to be followed.
    pub fn of(scenario: &Scenario) -> Result<Learnt, Error> {
        let (bodies, people) = bodies(scenario)?;
        let Some(first) = bodies.first() else {
            return Err(Error::Translation(TranslationMessage::NoResidents.into()));
        };
        let nobody = first.nobody();
        let rooms = scenario.home.plan().rooms.iter().map(|room| room.name.clone()).collect();
        let sensors = scenario.home.placed_sensors().iter().map(|sensor| sensor.name.clone()).collect();
        Ok(Learnt { nobody, people, rooms, sensors, bodies })
    }
}

impl<'a> Following<'a> {
    /// Of a log of which nothing has been read.
    pub fn new(learnt: &'a Learnt, scenario: &'a Scenario) -> Following<'a> {
        let follower = Follower::new(&learnt.bodies, &learnt.nobody);
        let told = vec![None; learnt.people.len()];
        Following { learnt, scenario, follower, last: None, next: 0, told }
    }

    /// Takes the rows that have come since the log was given last, and tells of everybody whose room, or how sure that is, has
    /// changed. Rows that are older than one that was taken are left out.
    ///
    /// # Errors
    ///
    /// [`Error::Translation`] where the log has rows, and none of them is of the home's sensors.
    pub fn take(&mut self, log: &Log, mut tell: impl FnMut(Presence)) -> Result<(), Error> {
        if log.events.is_empty() {
            return Ok(());
        }
        let heard = Heard::new(log, self.scenario, &self.learnt.sensors)?;
        let (last, mut taken) = self.last.unwrap_or((Micros::MIN, 0));
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

    fn tell(&mut self, heard: &Heard, tell: &mut impl FnMut(Presence)) {
        let now = self.follower.now();
        let (told, learnt) = (&mut self.told, self.learnt);
        let mut people = learnt.people.iter().zip(told);
        now.tell(|guess, _| {
            let Some((who, told)) = people.next() else { return };
            let place = (guess.state.at.is_none(), guess.state.room);
            let doubt = match told {
                Some((before, doubt)) if *before == place => doubt.after(guess.chance),
                _ => Doubt::of(guess.chance),
            };
            // Of somebody who may visit it is told once they do.
            let is_new = told.is_some() || !place.0 || learnt.people.first() == Some(who);
            if is_new && told.replace((place, doubt)) != Some((place, doubt)) {
                tell(presence(heard.calendar.wall_clock(now.at), who, &guess, &learnt.rooms));
            }
        });
    }
}

fn presence(time: String, who: &str, guess: &Guess, rooms: &[String]) -> Presence {
    let rounded = |metres: f64| (metres * 100.0).round() / 100.0;
    Presence {
        time,
        who: who.to_owned(),
        room: guess.state.room.map(|room| rooms[room].clone()),
        doing: match guess.state.kind {
            Kind::Out => "out",
            Kind::Walks => "walks",
            Kind::Stands => "stands",
            Kind::Busy => "busy",
            Kind::Still => "still",
            Kind::Motionless => "motionless",
        },
        chance: (guess.chance * 1_000.0).round() / 1_000.0,
        at_m: guess.state.at.map(|at| [rounded(at.x), rounded(at.y)]),
    }
}

impl Doubt {
    fn of(chance: f64) -> Doubt {
        match chance {
            _ if chance >= SURE => Doubt::Sure,
            _ if chance >= LIKELY => Doubt::Likely,
            _ => Doubt::Unsure,
        }
    }

    /// The word that comes after this one: the same, as long as the chance is hardly beyond its limits.
    fn after(self, chance: f64) -> Doubt {
        match [chance - BEYOND, chance + BEYOND].map(Doubt::of).contains(&self) {
            true => self,
            false => Doubt::of(chance),
        }
    }
}

impl fmt::Display for Presence {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Presence { time, who, room, doing, chance, .. } = self;
        let place = match (room, self.at_m) {
            (Some(room), _) => format!("in the {room}, {doing}"),
            (None, Some(_)) => format!("between rooms, {doing}"),
            (None, None) => "out".to_owned(),
        };
        let doubt = match Doubt::of(*chance) {
            Doubt::Sure => "surely",
            Doubt::Likely => "likely",
            Doubt::Unsure => "perhaps",
        };
        write!(f, "{} {who}: {doubt} {place} ({chance:.2})", &time[..19.min(time.len())])
    }
}
