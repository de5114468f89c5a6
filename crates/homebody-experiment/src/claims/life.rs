//! A life as the truth tells it, kept in little memory: activities, rooms, ways, and what was on or open.

use super::subject::{Filter, Subject};
use homebody_core::activity::{
    AWAY, DRINKING, EATING_BREAKFAST, EATING_DINNER, EATING_LUNCH, HAVING_A_SNACK, LAPPING, LYING_AWAKE, PACING,
    PREPARING_BREAKFAST, PREPARING_DINNER, PREPARING_LUNCH, SLEEPING, TAKING_MEDICINE, USING_BATHROOM, WANDERING,
};
use homebody_core::event::{Events, Fact, MotionState};
use homebody_core::ids::RoomId;
use homebody_core::run::Run;
use homebody_core::scenario::calendar::Calendar;
use homebody_core::scenario::path::Posture;
use homebody_core::time::{Micros, SECOND, seconds};

/// Interruption within which an activity is one, apart from the time of meals, medicine and the toilet (our choice).
const INTERRUPTED: Micros = 20 * 60 * SECOND;

/// What interrupts other things, which are gone on with after it: its time is none of the gap's.
const INTERRUPTING: [&str; 10] = [
    DRINKING,
    EATING_BREAKFAST,
    EATING_DINNER,
    EATING_LUNCH,
    HAVING_A_SNACK,
    PREPARING_BREAKFAST,
    PREPARING_DINNER,
    PREPARING_LUNCH,
    TAKING_MEDICINE,
    USING_BATHROOM,
];

/// What is short, so that each time is one of its own.
const EACH_ALONE: [&str; 9] =
    [AWAY, DRINKING, HAVING_A_SNACK, LYING_AWAKE, PACING, TAKING_MEDICINE, USING_BATHROOM, LAPPING, WANDERING];

/// Shortest stride with a known speed, in metres (our choice).
const LEAST_M: f64 = 1.0;

/// From when to when something was done, was on, or was open; `lasted` leaves interruptions out.
#[derive(Clone, Debug, PartialEq)]
pub struct Occurrence {
    /// The day, or the night, that it counts to.
    pub day: i32,
    pub begin: Micros,
    pub end: Micros,
    pub lasted: Micros,
    /// When it begins, in minutes of the day.
    clock_min: f64,
}

/// The truth of a run, as far as claims ask for it.
#[derive(Clone, Debug)]
pub struct Life {
    calendar: Calendar,
    days: i32,
    rooms: Vec<String>,
    things: Vec<(String, Vec<(Micros, bool)>)>,
    lamps_from: usize,
    bodies: Vec<Body>,
    said: Vec<(Micros, String)>,
    fired: Vec<Micros>,
}

#[derive(Clone, Debug, Default)]
struct Body {
    name: String,
    /// What is done from when on.
    done: Vec<(Micros, String)>,
    rooms: Vec<(Micros, Option<RoomId>)>,
    /// By day: metres, speeds with the metres that they are of, and seconds of movement in bed.
    metres: Vec<f64>,
    paces: Vec<(f64, f64)>,
    turning_s: Vec<f64>,
    /// The severities of conditions, from when on.
    severities: Vec<(Micros, String, f64)>,
}

impl Life {
    pub fn new(run: &Run, calendar: &Calendar, days: i32) -> Life {
        let plan = &run.home().plan;
        let many = days.max(0) as usize + 1;
        let body = |name: String| Body {
            name,
            metres: vec![0.0; many],
            paces: vec![(0.0, 0.0); many],
            turning_s: vec![0.0; many],
            ..Body::default()
        };
        Life {
            calendar: calendar.clone(),
            days,
            rooms: plan.rooms.iter().map(|room| room.name.clone()).collect(),
            things: plan.things.iter().map(|thing| (thing.name.to_lowercase(), vec![(0, thing.on)])).collect(),
            lamps_from: plan.things.len() - plan.rooms.len(),
            bodies: run.names().into_iter().map(body).collect(),
            said: Vec::new(),
            fired: Vec::new(),
        }
    }

    /// Takes in what has happened.
    pub fn absorb(&mut self, events: &Events) {
        for fact in &events.facts {
            match fact {
                Fact::Activity { resident, at, name } => {
                    self.bodies[resident.index()].done.push((*at, name.clone().unwrap_or_default()));
                }
                Fact::Room { resident, at, room } => self.bodies[resident.index()].rooms.push((*at, *room)),
                Fact::Use { at, act, .. } => self.things[act.thing.0 as usize].1.push((*at, act.on)),
                Fact::Condition { resident, at, name, severity } => {
                    self.bodies[resident.index()].severities.push((*at, name.clone(), *severity));
                }
                Fact::Movement { resident, begin, end, doing, posture } => {
                    let day = self.calendar.day(*begin).clamp(0, self.days) as usize;
                    self.bodies[resident.index()].moved(day, seconds(end - begin), doing, *posture);
                }
                _ => {}
            }
        }
        for firing in &events.firings {
            self.fired.push(firing.at);
            self.said.push((firing.at, firing.value.to_string()));
        }
    }

    /// A body by its name, or the last part of it, such as `daughter`; the one at `else_of` without a name.
    pub fn body(&self, name: Option<&str>, else_of: usize) -> Option<usize> {
        let Some(name) = name else { return Some(else_of) };
        self.bodies.iter().position(|body| body.name.to_lowercase().ends_with(&name.to_lowercase()))
    }

    /// The days that count; of nights, those that are lived to their end.
    pub fn days(&self, filter: &Filter, nights: bool) -> Vec<i32> {
        let last = if nights { self.days - 1 } else { self.days };
        (0..last).filter(|&day| filter.is_day(day, self.calendar.weekday(day))).collect()
    }

    /// The Mondays of the weeks that are lived whole.
    pub fn whole_weeks(&self) -> Vec<i32> {
        (0..=self.days - 7).filter(|&day| self.calendar.weekday(day) == 0).collect()
    }

    /// Midnight before an instant.
    pub fn midnight(&self, at: Micros) -> Micros {
        self.calendar.instant(self.calendar.day(at), 0)
    }

    /// Each time of what counts, in order of time.
    pub fn occurrences(&self, who: usize, subject: &Subject, filter: &Filter, nights: bool) -> Vec<Occurrence> {
        let days = self.days(filter, nights);
        let mut all = self.spans(who, subject);
        for one in &mut all {
            // A night goes from noon to noon.
            one.day = self.calendar.day(if nights { one.begin - 12 * 3600 * SECOND } else { one.begin });
        }
        all.retain(|one| {
            let is_then = filter.between.is_none_or(|(from, to)| {
                let minute = one.clock_min();
                (from..to).contains(&minute) || (from..to).contains(&(minute + 1440.0))
            });
            let is_long = filter.at_least.is_none_or(|least| seconds(one.end - one.begin) >= least * 60.0);
            is_then && is_long && days.binary_search(&one.day).is_ok()
        });
        all
    }

    /// Each time of a subject, in order of time; what is interrupted counts once.
    pub fn spans(&self, who: usize, subject: &Subject) -> Vec<Occurrence> {
        let end = self.calendar.instant(self.days, 0);
        match subject {
            Subject::Activity(name) => {
                let apart = EACH_ALONE.contains(&name.as_str());
                let done = &self.bodies[who].done;
                // By what interrupts: how long it had taken in all, whenever something begins.
                let (mut taken, mut spans) = (0, Vec::new());
                for (index, (at, of)) in done.iter().enumerate() {
                    let over = done.get(index + 1).map_or(end, |(at, _)| *at);
                    if of == name {
                        spans.push((*at, over, taken));
                    } else if INTERRUPTING.contains(&of.as_str()) {
                        taken += over - at;
                    }
                }
                self.joined(spans.into_iter(), if apart { 1 } else { INTERRUPTED })
            }
            Subject::Thing(name) => {
                let is_it = |index: &usize| self.things[*index].0 == *name && *index < self.lamps_from;
                self.while_on((0..self.lamps_from).filter(is_it), end)
            }
            Subject::Room(name) => self.joined(self.in_room(who, name, end).into_iter(), 1),
            Subject::Lamps => self.while_on(self.lamps_from..self.things.len(), end),
            Subject::Says(value) => {
                self.joined(self.said.iter().filter(|(_, of)| of == value).map(|(at, _)| (*at, *at, 0)), 1)
            }
            _ => Vec::new(),
        }
    }

    fn in_room(&self, who: usize, name: &str, end: Micros) -> Vec<(Micros, Micros, Micros)> {
        let rooms = &self.bodies[who].rooms;
        let is_it = |of: &Option<RoomId>| of.is_some_and(|of| self.rooms[of.index()] == name);
        let stays = rooms.iter().enumerate().filter(|(_, (_, of))| is_it(of));
        stays.map(|(index, (at, _))| (*at, rooms.get(index + 1).map_or(end, |(at, _)| *at), 0)).collect()
    }

    fn while_on(&self, things: impl Iterator<Item = usize>, end: Micros) -> Vec<Occurrence> {
        let mut spans: Vec<(Micros, Micros, Micros)> = Vec::new();
        for thing in things {
            let acts = &self.things[thing].1;
            for (index, (at, _)) in acts.iter().enumerate().filter(|(_, (_, on))| *on) {
                spans.push((*at, acts.get(index + 1).map_or(end, |(at, _)| *at), 0));
            }
        }
        spans.sort_unstable();
        self.joined(spans.into_iter(), 1)
    }

    /// Spans with less than a gap between them as one: from when, to when, and how long interruptions had taken by then.
    fn joined(&self, spans: impl Iterator<Item = (Micros, Micros, Micros)>, gap: Micros) -> Vec<Occurrence> {
        let (mut all, mut before): (Vec<Occurrence>, Micros) = (Vec::new(), 0);
        for (begin, end, taken) in spans {
            let interrupted = taken - std::mem::replace(&mut before, taken);
            match all.last_mut() {
                Some(last) if begin - last.end - interrupted < gap => {
                    last.lasted += end - begin.max(last.end).min(end);
                    last.end = last.end.max(end);
                }
                _ => {
                    let clock_min = seconds(begin - self.midnight(begin)) / 60.0;
                    all.push(Occurrence { day: 0, begin, end, lasted: end - begin, clock_min });
                }
            }
        }
        all
    }

    /// How much of a span is spent in a room.
    pub fn time_in(&self, who: usize, room: &str, begin: Micros, end: Micros) -> Micros {
        let rooms = &self.bodies[who].rooms;
        let is_it = |of: &Option<RoomId>| of.is_some_and(|of| self.rooms[of.index()] == room);
        let first = rooms.partition_point(|(at, _)| *at <= begin).saturating_sub(1);
        let mut whole = 0;
        for (index, (at, of)) in rooms.iter().enumerate().skip(first) {
            if *at >= end {
                break;
            }
            let over = rooms.get(index + 1).map_or(end, |(at, _)| *at);
            whole += if is_it(of) { (over.min(end) - (*at).max(begin)).max(0) } else { 0 };
        }
        whole
    }

    /// A number for each day that counts.
    pub fn daily(&self, who: usize, subject: &Subject, filter: &Filter) -> Vec<f64> {
        let body = &self.bodies[who];
        let days = self.days(filter, false);
        let of = |day: &i32| -> f64 {
            let index = *day as usize;
            match subject {
                Subject::Metres => body.metres[index],
                Subject::Pace => body.paces[index].0 / body.paces[index].1,
                Subject::Firings => {
                    let (from, to) = filter.between.unwrap_or((0.0, 1440.0));
                    let at = |minute: f64| self.calendar.instant(*day, (minute * 60.0) as Micros * SECOND);
                    let before = |at: Micros| self.fired.partition_point(|fired| *fired < at) as f64;
                    before(at(to)) - before(at(from))
                }
                Subject::Turning => {
                    let one = Filter { days: Some((day + 1, day + 1)), ..Filter::default() };
                    let asleep = self.occurrences(who, &Subject::Activity(SLEEPING.to_owned()), &one, false);
                    body.turning_s[index] / (asleep.iter().map(|of| seconds(of.lasted)).sum::<f64>() / 3600.0)
                }
                Subject::Severity(name) => {
                    let noon = self.calendar.instant(*day, 12 * 3600 * SECOND);
                    let mut known = body.severities.iter().filter(|(at, of, _)| *at <= noon && of == name);
                    known.next_back().map_or(0.0, |(.., severity)| *severity)
                }
                _ => f64::NAN,
            }
        };
        days.iter().map(of).filter(|value| !value.is_nan()).collect()
    }
}

impl Body {
    fn moved(&mut self, day: usize, lasts_s: f64, doing: &MotionState, posture: Posture) {
        match doing {
            MotionState::Stride { from, to } => {
                let length = from.distance(*to);
                self.metres[day] += length;
                if length >= LEAST_M {
                    self.paces[day].0 += length;
                    self.paces[day].1 += lasts_s;
                }
            }
            MotionState::InPlace { .. } if posture == Posture::Lying => self.turning_s[day] += lasts_s,
            _ => {}
        }
    }
}

impl Occurrence {
    /// When it begins, in minutes of the day.
    pub fn clock_min(&self) -> f64 {
        self.clock_min
    }
}
