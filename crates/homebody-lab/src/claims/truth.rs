//! The ground truth of a run in little memory: activities, rooms, walks, and things that were on or open.

use super::subject::{Filter, Subject};
use homebody_core::activity::{
    AWAY, DRINKING, EATING_BREAKFAST, EATING_DINNER, EATING_LUNCH, HAVING_A_SNACK, LAPPING, LYING_AWAKE, PACING,
    PREPARING_BREAKFAST, PREPARING_DINNER, PREPARING_LUNCH, SLEEPING, TAKING_MEDICINE, USING_BATHROOM, WANDERING,
};
use homebody_core::calendar::Calendar;
use homebody_core::event::{Events, Fact};
use homebody_core::geometry::Point;
use homebody_core::motion::MotionState;
use homebody_core::posture::Posture;
use homebody_core::run::Run;
use homebody_core::time::{HOUR, Interval, MINUTE, RunTime, SECOND, Span};
use homebody_timeline::{Episode, PersonTimeline, TimelineBuilder};

/// Interruption within which an activity is one, apart from the time of meals, medicine and the toilet (our choice).
const INTERRUPTED: Span = MINUTE.times(20);

/// Gap below which two intervals are one: they touch or overlap.
const TOUCHING: Span = Span::MICROSECOND;

/// Activities that interrupt others, which continue after them: their time does not count as a gap.
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

/// Short activities: each time counts alone.
const EACH_ALONE: [&str; 9] =
    [AWAY, DRINKING, HAVING_A_SNACK, LYING_AWAKE, PACING, TAKING_MEDICINE, USING_BATHROOM, LAPPING, WANDERING];

/// Shortest time at one point that counts as a stay there (our choice).
const LEAST_STAY: Span = SECOND.times(5);

/// Distance from the middle of a seat or a place within which a person is there, in metres (our choice).
const AT_PLACE_M: f64 = 1.0;

/// Shortest stride with a known speed, in metres (our choice).
const LEAST_M: f64 = 1.0;

/// An interval of an activity, or of a thing that was on or open; `lasted` omits interruptions.
#[derive(Clone, Debug, PartialEq)]
pub struct Occurrence {
    pub day: i32,
    pub time: Interval<RunTime>,
    pub lasted: Span,
    /// The start, in minutes of the day.
    pub clock_min: f64,
}

#[derive(Clone, Debug)]
pub struct ClaimTruth {
    calendar: Calendar,
    days: i32,
    /// The beginning of each day: the calendar is too slow for each movement.
    midnights: Vec<RunTime>,
    builder: TimelineBuilder,
    /// The activities and rooms of each body, once the run has ended.
    people: Vec<PersonTimeline>,
    things: Vec<(String, Vec<(RunTime, bool)>)>,
    lamps_from: usize,
    bodies: Vec<Body>,
    said: Vec<(RunTime, String)>,
    fired: Vec<RunTime>,
    /// Places and enterable furniture, by name.
    furniture: Vec<(String, Point)>,
}

/// A time at one point.
#[derive(Clone, Copy, Debug)]
struct TimeAtPoint {
    time: Interval<RunTime>,
    at: Point,
    posture: Posture,
}

#[derive(Clone, Debug, Default)]
struct Body {
    /// By day: metres, speeds of long strides with the metres that they are of, seconds of walking, and of movement in bed.
    metres: Vec<f64>,
    paces: Vec<(f64, f64)>,
    walking_s: Vec<f64>,
    turning_s: Vec<f64>,
    /// The severities of conditions, with their start.
    severities: Vec<(RunTime, String, f64)>,
    /// Times at one point of at least [`LEAST_STAY`].
    stays: Vec<TimeAtPoint>,
    /// Times in the home.
    home: Vec<(Interval<RunTime>, Span)>,
}

impl ClaimTruth {
    pub fn new(run: &Run, calendar: &Calendar, days: i32) -> ClaimTruth {
        let plan = &run.home().plan;
        let many = days.max(0) as usize + 1;
        let body = |_| Body {
            metres: vec![0.0; many],
            paces: vec![(0.0, 0.0); many],
            walking_s: vec![0.0; many],
            turning_s: vec![0.0; many],
            ..Body::default()
        };
        ClaimTruth {
            calendar: calendar.clone(),
            days,
            midnights: (0..=days + 1).map(|day| calendar.instant(day, Span::ZERO)).collect(),
            furniture: plan.places.iter().map(|(name, at)| (name.to_lowercase(), *at)).collect(),
            builder: TimelineBuilder::for_run(run),
            people: Vec::new(),
            things: plan
                .things
                .iter()
                .map(|thing| (thing.name.to_lowercase(), vec![(RunTime::START, thing.on)]))
                .collect(),
            lamps_from: plan.things.len() - plan.rooms.len(),
            bodies: run.names().into_iter().map(body).collect(),
            said: Vec::new(),
            fired: Vec::new(),
        }
    }

    pub fn absorb(&mut self, events: &Events) {
        self.builder.take(&events.facts);
        for fact in &events.facts {
            match fact {
                Fact::Use { at, act, .. } => self.things[act.thing.0 as usize].1.push((*at, act.on)),
                Fact::Condition { resident, at, name, severity } => {
                    self.bodies[resident.index()].severities.push((*at, name.clone(), *severity));
                }
                Fact::Movement { resident, begin, end, doing, posture } => {
                    let day = self.day_of(*begin).clamp(0, self.days) as usize;
                    self.bodies[resident.index()].moved(day, Interval::new(*begin, *end), doing, *posture);
                }
                _ => {}
            }
        }
        for firing in &events.firings {
            self.fired.push(firing.at);
            self.said.push((firing.at, firing.value.to_string()));
        }
    }

    /// Ends the activities and stays at the end of the run. Claims can be judged after that.
    pub fn finish(&mut self) {
        self.people = std::mem::take(&mut self.builder).finish(self.end()).people;
    }

    fn end(&self) -> RunTime {
        self.calendar.instant(self.days, Span::ZERO)
    }

    /// A body by its name, or the last part of it, such as `daughter`; `else_of` without a name.
    pub fn body(&self, name: Option<&str>, else_of: usize) -> Option<usize> {
        let Some(name) = name else { return Some(else_of) };
        self.people.iter().position(|person| person.name.to_lowercase().ends_with(&name.to_lowercase()))
    }

    /// The days that count; for nights, those that the run completes.
    pub fn days(&self, filter: &Filter, nights: bool) -> Vec<i32> {
        let last = if nights { self.days - 1 } else { self.days };
        (0..last).filter(|&day| filter.is_day(day, self.calendar.weekday(day))).collect()
    }

    pub fn whole_weeks(&self) -> Vec<i32> {
        (0..=self.days - 7).filter(|&day| self.calendar.weekday(day) == 0).collect()
    }

    pub fn midnight(&self, at: RunTime) -> RunTime {
        match self.midnights.get(usize::try_from(self.day_of(at)).unwrap_or(usize::MAX)) {
            Some(midnight) => *midnight,
            None => self.calendar.instant(self.calendar.day(at), Span::ZERO),
        }
    }

    /// Minutes since midnight on the clock on the wall, also on a day on which clocks change.
    pub fn clock_min(&self, at: RunTime) -> f64 {
        let local = self.calendar.local(at);
        f64::from(local.hour()) * 60.0 + f64::from(local.minute()) + f64::from(local.second()) / 60.0
    }

    pub fn calendar(&self) -> &Calendar {
        &self.calendar
    }

    /// The day of an instant; the first is 0.
    pub fn day_of(&self, at: RunTime) -> i32 {
        let day = self.midnights.partition_point(|midnight| *midnight <= at);
        if (1..self.midnights.len()).contains(&day) { day as i32 - 1 } else { self.calendar.day(at) }
    }

    /// The times of a body in the home.
    pub fn at_home(&self, body: usize) -> Vec<Occurrence> {
        self.joined(self.bodies[body].home.iter().copied(), TOUCHING)
    }

    /// The times that a body sits, wherever it does.
    pub fn sitting(&self, who: usize) -> Vec<Occurrence> {
        let sits = self.bodies[who].stays.iter().filter(|stay| stay.posture == Posture::Sitting);
        self.joined(sits.map(|stay| (stay.time, Span::ZERO)), LEAST_STAY)
    }

    /// The time at a piece of furniture or a place, within an interval.
    pub fn time_at(&self, who: usize, name: &str, within: Interval<RunTime>) -> Span {
        let at: Vec<Point> = self.furniture.iter().filter(|(of, _)| of == name).map(|(_, at)| *at).collect();
        let stays = &self.bodies[who].stays;
        let first = stays.partition_point(|stay| stay.time.end <= within.begin);
        let until = stays[first..].iter().take_while(|stay| stay.time.begin < within.end);
        let is_there = |stay: &&TimeAtPoint| at.iter().any(|at| at.distance(stay.at) < AT_PLACE_M);
        until.filter(is_there).map(|stay| stay.time.overlap(within)).sum()
    }

    /// Whether a thing is on or open at an instant.
    pub fn is_on(&self, name: &str, at: RunTime) -> bool {
        let of = self.things[..self.lamps_from].iter().filter(|(of, _)| of == name);
        of.filter_map(|(_, acts)| acts[..acts.partition_point(|(when, _)| *when <= at)].last()).any(|(_, on)| *on)
    }

    /// Whether a thing is turned on or opened within an interval.
    pub fn is_used(&self, name: &str, within: Interval<RunTime>) -> bool {
        let mut acts = self.things[..self.lamps_from].iter().filter(|(of, _)| of == name).flat_map(|(_, acts)| acts);
        acts.any(|(at, on)| *on && within.contains(*at))
    }

    /// The occurrences that count, in order of time.
    pub fn occurrences(&self, who: usize, subject: &Subject, filter: &Filter, nights: bool) -> Vec<Occurrence> {
        let days = self.days(filter, nights);
        let mut all = self.spans(who, subject);
        for one in &mut all {
            // A night goes from noon to noon.
            one.day = self.day_of(if nights { one.time.begin - 12 * HOUR } else { one.time.begin });
        }
        all.retain(|one| {
            let is_then = filter.between.is_none_or(|(from, to)| {
                let minute = one.clock_min;
                (from..to).contains(&minute) || (from..to).contains(&(minute + 1440.0))
            });
            let is_long = filter.at_least.is_none_or(|least| one.time.length().seconds() >= least * 60.0);
            is_then && is_long && days.binary_search(&one.day).is_ok()
        });
        all
    }

    /// All occurrences of a subject, in order of time; an interrupted one counts once.
    pub fn spans(&self, who: usize, subject: &Subject) -> Vec<Occurrence> {
        match subject {
            Subject::Activity(name) => {
                let apart = EACH_ALONE.contains(&name.as_str());
                // The time that interruptions took until each episode.
                let (mut taken, mut spans) = (Span::ZERO, Vec::new());
                for Episode { label, time } in &self.people[who].activities {
                    if label == name {
                        spans.push((*time, taken));
                    } else if INTERRUPTING.contains(&label.as_str()) {
                        taken += time.length();
                    }
                }
                self.joined(spans.into_iter(), if apart { TOUCHING } else { INTERRUPTED })
            }
            Subject::Thing(name) => {
                let is_it = |index: &usize| self.things[*index].0 == *name && *index < self.lamps_from;
                self.while_on((0..self.lamps_from).filter(is_it))
            }
            Subject::Room(name) => {
                let stays = self.people[who].rooms.iter().filter(|stay| stay.label == *name);
                self.joined(stays.map(|stay| (stay.time, Span::ZERO)), TOUCHING)
            }
            Subject::Lamps => self.while_on(self.lamps_from..self.things.len()),
            Subject::Says(value) => {
                let said = self.said.iter().filter(|(_, of)| of == value);
                self.joined(said.map(|(at, _)| (Interval::instant(*at), Span::ZERO)), TOUCHING)
            }
            _ => Vec::new(),
        }
    }

    fn while_on(&self, things: impl Iterator<Item = usize>) -> Vec<Occurrence> {
        let end = self.end();
        let mut spans: Vec<(Interval<RunTime>, Span)> = Vec::new();
        for thing in things {
            let acts = &self.things[thing].1;
            for (index, (at, _)) in acts.iter().enumerate().filter(|(_, (_, on))| *on) {
                let until = acts.get(index + 1).map_or(end, |(at, _)| *at);
                spans.push((Interval::new(*at, until), Span::ZERO));
            }
        }
        spans.sort_unstable();
        self.joined(spans.into_iter(), TOUCHING)
    }

    /// Joins intervals with less than a gap between them. Each has the total time of interruptions until then.
    fn joined(&self, spans: impl Iterator<Item = (Interval<RunTime>, Span)>, gap: Span) -> Vec<Occurrence> {
        let (mut all, mut before): (Vec<Occurrence>, Span) = (Vec::new(), Span::ZERO);
        for (time, taken) in spans {
            let Interval { begin, end } = time;
            let interrupted = taken - std::mem::replace(&mut before, taken);
            match all.last_mut() {
                Some(last) if begin - last.time.end - interrupted < gap => {
                    last.lasted += end - begin.max(last.time.end).min(end);
                    last.time.end = last.time.end.max(end);
                }
                _ => {
                    let clock_min = self.clock_min(begin);
                    all.push(Occurrence { day: 0, time, lasted: time.length(), clock_min });
                }
            }
        }
        all
    }

    /// The time in a room within an interval.
    pub fn time_in(&self, who: usize, room: &str, within: Interval<RunTime>) -> Span {
        let stays = &self.people[who].rooms;
        let first = stays.partition_point(|stay| stay.end() <= within.begin);
        let until = stays[first..].iter().take_while(|stay| stay.begin() < within.end);
        until.filter(|stay| stay.label == room).map(|stay| stay.time.overlap(within)).sum()
    }

    pub fn daily(&self, who: usize, subject: &Subject, filter: &Filter) -> Vec<f64> {
        let body = &self.bodies[who];
        let days = self.days(filter, false);
        let of = |day: &i32| -> f64 {
            let index = *day as usize;
            match subject {
                Subject::Metres => body.metres[index],
                Subject::Pace => body.paces[index].0 / body.paces[index].1,
                Subject::Speed => body.metres[index] / body.walking_s[index],
                Subject::Firings => {
                    let (from, to) = filter.between.unwrap_or((0.0, 1440.0));
                    let at = |minute: f64| self.calendar.instant(*day, (minute * 60.0) as i64 * SECOND);
                    let before = |at: RunTime| self.fired.partition_point(|fired| *fired < at) as f64;
                    before(at(to)) - before(at(from))
                }
                Subject::Turning => {
                    // A sleep that began on the day before counts as far as it is on this day.
                    let midnight = |day: i32| self.calendar.instant(day, Span::ZERO);
                    let time = Interval::new(midnight(*day), midnight(*day + 1));
                    let asleep = self.spans(who, &Subject::Activity(SLEEPING.to_owned()));
                    let asleep: Span = asleep.iter().map(|of| of.time.overlap(time)).sum();
                    if asleep > Span::ZERO { body.turning_s[index] / asleep.ratio(HOUR) } else { f64::NAN }
                }
                Subject::Severity(name) => {
                    let noon = self.calendar.instant(*day, 12 * HOUR);
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
    fn moved(&mut self, day: usize, time: Interval<RunTime>, doing: &MotionState, posture: Posture) {
        let lasts_s = time.length().seconds();
        if *doing != MotionState::Away {
            match self.home.last_mut() {
                Some((last, _)) if last.end == time.begin => last.end = time.end,
                _ => self.home.push((time, Span::ZERO)),
            }
        }
        if let MotionState::InPlace { at, .. } | MotionState::Rest { at } = doing {
            match self.stays.last_mut() {
                Some(last) if last.time.end == time.begin && last.at == *at && last.posture == posture => {
                    last.time.end = time.end
                }
                _ if time.length() >= LEAST_STAY => self.stays.push(TimeAtPoint { time, at: *at, posture }),
                _ => {}
            }
        }
        match doing {
            MotionState::Stride { from, to } => {
                let length = from.distance(*to);
                self.metres[day] += length;
                self.walking_s[day] += lasts_s;
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
