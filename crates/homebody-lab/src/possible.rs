//! Counts impossible events in simulations: people who walk through each other, guests who pass a shut door, activities with a
//! place that are done elsewhere, meals that are eaten before they are cooked, and others.
//!
//! The counts use the ground truth alone, so they apply to any driver in the same way.

use homebody_core::activity::{
    EATING_BREAKFAST, EATING_DINNER, EATING_LUNCH, FETCHING_MAIL, NAPPING, PREPARING_BREAKFAST, PREPARING_DINNER,
    PREPARING_LUNCH, SHOWERING, SLEEPING, USING_BATHROOM, VISIT, WAITING,
};
use homebody_core::event::Fact;
use homebody_core::motion::{MotionSegment, MotionState};
use homebody_core::posture::Posture;
use homebody_core::time::{DAY, HOUR, Interval, MINUTE, RunTime, SECOND, Span};
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt;

#[cfg(test)]
mod tests;

/// Distance from middle to middle that two people keep in passing (our choice): a chest of 25 cm, and some space.
pub const PASSING_M: f64 = 0.3;

/// Number of instants of a part of two movements at which their distance is measured (our choice).
const LOOKS: i64 = 5;

/// Time before the last dish is served within which a person may sit down to a meal (our choice).
const SERVING: Span = MINUTE;

/// Longest time that a person waits for another without doing something else (our choice).
const PATIENCE: Span = MINUTE.times(3);

/// Longest time from the end of cooking to the meal (our choice).
const WARM: Span = MINUTE.times(30);

/// Time within which a meal that is prepared later is the same meal (our choice).
const SAME_MEAL: Span = HOUR.times(2);

/// Longest time outside of the bathroom, within an activity of the bathroom (our choice): a step over the threshold.
const THRESHOLD: Span = SECOND.times(3);

const MEALS: [(&str, &str); 3] =
    [(EATING_BREAKFAST, PREPARING_BREAKFAST), (EATING_LUNCH, PREPARING_LUNCH), (EATING_DINNER, PREPARING_DINNER)];

/// A kind of impossible events.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ImpossibleKind {
    TooNear,
    LongWait,
    BathroomElsewhere,
    WalksAsleep,
    ThroughShutDoor,
    OpenedForNobody,
    OpenForAnInstant,
    HostAlone,
    VisitToNobody,
    HungryGuest,
    EatenUncooked,
    PreparedTooLate,
    EatenCold,
    NoLength,
}

impl ImpossibleKind {
    pub const ALL: [ImpossibleKind; 14] = [
        ImpossibleKind::TooNear,
        ImpossibleKind::LongWait,
        ImpossibleKind::BathroomElsewhere,
        ImpossibleKind::WalksAsleep,
        ImpossibleKind::ThroughShutDoor,
        ImpossibleKind::OpenedForNobody,
        ImpossibleKind::OpenForAnInstant,
        ImpossibleKind::HostAlone,
        ImpossibleKind::VisitToNobody,
        ImpossibleKind::HungryGuest,
        ImpossibleKind::EatenUncooked,
        ImpossibleKind::PreparedTooLate,
        ImpossibleKind::EatenCold,
        ImpossibleKind::NoLength,
    ];

    pub fn in_words(self) -> &'static str {
        match self {
            ImpossibleKind::TooNear => "two people within 30 cm, upright",
            ImpossibleKind::LongWait => "waits longer than 3 minutes",
            ImpossibleKind::BathroomElsewhere => "showers or uses the toilet in another room",
            ImpossibleKind::WalksAsleep => "walks while asleep",
            ImpossibleKind::ThroughShutDoor => "passes the shut front door",
            ImpossibleKind::OpenedForNobody => "opens the front door, nobody passes",
            ImpossibleKind::OpenForAnInstant => "front door open for an instant",
            ImpossibleKind::HostAlone => "has a visit without a visitor",
            ImpossibleKind::VisitToNobody => "visits an empty home",
            ImpossibleKind::HungryGuest => "guest does not eat with the host",
            ImpossibleKind::EatenUncooked => "eats while another person cooks it",
            ImpossibleKind::PreparedTooLate => "eats before preparing it",
            ImpossibleKind::EatenCold => "eats 30 minutes after cooking, or later",
            ImpossibleKind::NoLength => "row without length",
        }
    }
}

/// How often a kind of events occurs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct ImpossibleCount {
    pub events: u32,
    /// The sum of their durations, where they have one.
    pub seconds: f64,
    #[serde(skip)]
    pub first: Option<RunTime>,
}

#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[serde(transparent)]
pub struct ImpossibleCounts(pub BTreeMap<ImpossibleKind, ImpossibleCount>);

impl ImpossibleCounts {
    pub fn of(&self, kind: ImpossibleKind) -> ImpossibleCount {
        self.0.get(&kind).copied().unwrap_or_default()
    }

    pub fn is_nothing(&self) -> bool {
        self.0.values().all(|count| count.events == 0)
    }

    fn add_all(&mut self, other: &ImpossibleCounts) {
        for (&kind, &ImpossibleCount { events, seconds, first }) in &other.0 {
            let count = self.0.entry(kind).or_default();
            *count = ImpossibleCount {
                events: count.events + events,
                seconds: count.seconds + seconds,
                first: count.first.or(first),
            };
        }
    }

    fn add(&mut self, kind: ImpossibleKind, at: RunTime, lasts: Span) {
        let count = self.0.entry(kind).or_default();
        count.events += 1;
        count.seconds += lasts.seconds();
        count.first = count.first.or(Some(at));
    }
}

/// The front door and the bathrooms of a home.
#[derive(Clone, Debug, Default)]
pub struct HouseholdHome {
    /// The index of the front door among the plan's things.
    pub front_door: Option<usize>,
    /// By room of the plan.
    pub are_bathrooms: Vec<bool>,
}

/// A row of the truth: a name and its time.
type ActivityRow<'a> = (&'a str, Interval<RunTime>);

#[derive(Clone, Debug, Default)]
pub struct HouseholdTruth {
    /// By body, in the order of [`ResidentId`](homebody_core::ids::ResidentId): the residents, then the visitors.
    moves: Vec<Vec<MotionSegment>>,
    doing: Vec<Vec<(RunTime, Option<String>)>>,
    rooms: Vec<Vec<(RunTime, Option<usize>)>>,
    /// The instants at which the front door was opened (true) and shut, each with the user.
    door: Vec<(RunTime, bool, Option<usize>)>,
    /// By body: true for a person, false for a pet.
    are_people: Vec<bool>,
    /// Visitors and their hosts, by their indices among the bodies.
    hosts: Vec<(usize, usize)>,
    home: HouseholdHome,
}

impl HouseholdTruth {
    /// A household before its first fact. `hosts` has visitors and their hosts, by their indices among the bodies.
    pub fn new(are_people: Vec<bool>, hosts: Vec<(usize, usize)>, home: HouseholdHome) -> HouseholdTruth {
        let bodies = are_people.len();
        let (moves, doing, rooms) = (vec![Vec::new(); bodies], vec![Vec::new(); bodies], vec![Vec::new(); bodies]);
        HouseholdTruth { moves, doing, rooms, door: Vec::new(), are_people, hosts, home }
    }

    pub fn take(&mut self, fact: &Fact) {
        match fact {
            Fact::Movement { resident, begin, end, doing, posture } => {
                let (begin, end, doing, posture) = (*begin, *end, *doing, *posture);
                self.moves[resident.index()].push(MotionSegment { begin, end, doing, posture });
            }
            Fact::Activity { resident, at, name } => self.doing[resident.index()].push((*at, name.clone())),
            Fact::Room { resident, at, room } => {
                self.rooms[resident.index()].push((*at, room.map(|room| room.index())));
            }
            Fact::Use { resident, at, act } if self.home.front_door == Some(act.thing.index()) => {
                self.door.push((*at, act.on, resident.map(|who| who.index())));
            }
            _ => {}
        }
    }

    pub fn visits(&self) -> usize {
        self.hosts.iter().map(|&(visitor, _)| self.passes(visitor).filter(|(_, comes)| *comes).count()).sum()
    }

    pub fn impossible(&self) -> ImpossibleCounts {
        let mut found = ImpossibleCounts::default();
        let people: Vec<usize> = (0..self.moves.len()).filter(|&body| self.are_people[body]).collect();
        for (place, &first) in people.iter().enumerate() {
            for &second in &people[place + 1..] {
                meet(&self.moves[first], &self.moves[second], &mut found);
                self.uncooked(first, second, &mut found);
                self.uncooked(second, first, &mut found);
            }
        }
        people.iter().for_each(|&body| self.rows_of(body, &mut found));
        self.meals(&mut found);
        self.front_door(&people, &mut found);
        self.company(&mut found);
        let backwards = |segment: &&MotionSegment| segment.end < segment.begin;
        for segment in self.moves.iter().flatten().filter(backwards) {
            found.add(ImpossibleKind::NoLength, segment.end, Span::ZERO);
        }
        found
    }

    /// The named rows of a body; the last one has no end.
    fn rows(&self, body: usize) -> impl Iterator<Item = ActivityRow<'_>> {
        let doing = &self.doing[body];
        doing.windows(2).filter_map(|pair| Some((pair[0].1.as_deref()?, Interval::new(pair[0].0, pair[1].0))))
    }

    /// The instants at which a body leaves the home (false) and comes in (true).
    fn passes(&self, body: usize) -> impl Iterator<Item = (RunTime, bool)> + '_ {
        let is_out = |segment: &MotionSegment| segment.doing == MotionState::Away;
        let pairs = self.moves[body].windows(2).filter(move |pair| is_out(&pair[0]) != is_out(&pair[1]));
        pairs.map(move |pair| (pair[1].begin, is_out(&pair[0])))
    }

    /// The movements of a body in an interval.
    fn moves_in(&self, body: usize, time: Interval<RunTime>) -> impl Iterator<Item = &MotionSegment> {
        let moves = &self.moves[body];
        let first = moves.partition_point(|segment| segment.end <= time.begin);
        moves[first..].iter().take_while(move |segment| segment.begin < time.end)
    }

    fn is_home(&self, body: usize, time: Interval<RunTime>) -> bool {
        self.moves_in(body, time).any(|segment| segment.doing != MotionState::Away)
    }

    /// Whether a body is at home for the whole of an interval.
    fn is_home_throughout(&self, body: usize, time: Interval<RunTime>) -> bool {
        self.is_home(body, time) && self.moves_in(body, time).all(|segment| segment.doing != MotionState::Away)
    }

    /// Rows that contradict the movements of the same body.
    fn rows_of(&self, body: usize, found: &mut ImpossibleCounts) {
        for (name, time) in self.rows(body) {
            if time.end <= time.begin {
                found.add(ImpossibleKind::NoLength, time.begin, Span::ZERO);
            }
            if name == WAITING && time.length() > PATIENCE {
                found.add(ImpossibleKind::LongWait, time.begin, time.length());
            }
            if [USING_BATHROOM, SHOWERING].contains(&name) {
                let elsewhere = self.outside_of_bathrooms(body, time);
                if elsewhere > THRESHOLD {
                    found.add(ImpossibleKind::BathroomElsewhere, time.begin, elsewhere);
                }
            }
            if [SLEEPING, NAPPING].contains(&name) {
                let walks = |segment: &&MotionSegment| {
                    matches!(segment.doing, MotionState::Stride { .. }) && segment.posture == Posture::Standing
                };
                let walked: Span = self.moves_in(body, time).filter(walks).map(|walk| walk.end - walk.begin).sum();
                if walked > Span::ZERO {
                    found.add(ImpossibleKind::WalksAsleep, time.begin, walked);
                }
            }
        }
    }

    fn outside_of_bathrooms(&self, body: usize, time: Interval<RunTime>) -> Span {
        let rooms = &self.rooms[body];
        if !self.home.are_bathrooms.contains(&true) {
            return Span::ZERO;
        }
        let first = rooms.partition_point(|(at, _)| *at <= time.begin).saturating_sub(1);
        let spans = rooms[first..].iter().enumerate().take_while(|(_, (at, _))| *at < time.end);
        let outside = spans.filter(|(_, (_, room))| room.is_none_or(|room| !self.home.are_bathrooms[room]));
        let lasts = outside.map(|(index, (at, _))| {
            let until = rooms.get(first + index + 1).map_or(time.end, |next| next.0);
            Interval::new(*at, until).intersection(time).length().max(Span::ZERO)
        });
        lasts.sum()
    }

    /// Counts meals that one person eats while another still cooks them.
    fn uncooked(&self, eats: usize, cooks: usize, found: &mut ImpossibleCounts) {
        for (at, name) in &self.doing[eats] {
            let Some((_, cooking)) = MEALS.iter().find(|(eating, _)| name.as_deref() == Some(eating)) else { continue };
            if [*at, *at + SERVING].iter().all(|&at| self.is_doing(cooks, at, cooking)) {
                found.add(ImpossibleKind::EatenUncooked, *at, Span::ZERO);
            }
        }
    }

    /// Meals that one person cooks and eats: cooked before, and still warm.
    fn meals(&self, found: &mut ImpossibleCounts) {
        for (eating, cooking) in MEALS {
            for body in (0..self.doing.len()).filter(|&body| self.are_people[body]) {
                let begins: Vec<RunTime> =
                    self.rows(body).filter(|(name, _)| *name == eating).map(|(_, time)| time.begin).collect();
                let cooked: Vec<Interval<RunTime>> =
                    self.rows(body).filter(|(name, _)| *name == cooking).map(|(_, time)| time).collect();
                for (index, time) in cooked.iter().enumerate() {
                    let next = begins.iter().find(|&&at| at >= time.end);
                    let is_last =
                        cooked.get(index + 1).is_none_or(|later| next.is_none_or(|&eats| later.begin >= eats));
                    if let Some(&eats) = next.filter(|&&eats| is_last && eats < time.end + 12 * HOUR)
                        && eats > time.end + WARM
                    {
                        found.add(ImpossibleKind::EatenCold, time.end, eats - time.end);
                    }
                }
                for &at in &begins {
                    let same = |time: &&Interval<RunTime>| (at - SAME_MEAL..at + SAME_MEAL).contains(&time.begin);
                    if cooked.iter().find(same).is_some_and(|first| first.begin > at) {
                        found.add(ImpossibleKind::PreparedTooLate, at, Span::ZERO);
                    }
                }
            }
        }
    }

    fn front_door(&self, people: &[usize], found: &mut ImpossibleCounts) {
        if self.home.front_door.is_none() {
            return;
        }
        let mut open: Vec<Interval<RunTime>> = Vec::new();
        let mut passes: Vec<RunTime> = people.iter().flat_map(|&body| self.passes(body)).map(|(at, _)| at).collect();
        passes.sort();
        let passed_in = |time: Interval<RunTime>| {
            let next = passes.partition_point(|&at| at < time.begin);
            passes.get(next).is_some_and(|&at| at <= time.end)
        };
        let mut opened: Option<(RunTime, Option<usize>)> = None;
        for &(at, on, by) in &self.door {
            match (on, opened) {
                (true, None) => opened = Some((at, by)),
                (false, Some((begin, by))) => {
                    opened = None;
                    let time = Interval::new(begin, at);
                    open.push(time);
                    if begin == at {
                        found.add(ImpossibleKind::OpenForAnInstant, at, Span::ZERO);
                    }
                    let is_for_mail = by.is_some_and(|by| self.is_doing(by, begin, FETCHING_MAIL));
                    if !is_for_mail && !passed_in(time) {
                        found.add(ImpossibleKind::OpenedForNobody, begin, time.length());
                    }
                }
                _ => {}
            }
        }
        open.extend(opened.map(|(begin, _)| Interval::new(begin, RunTime::NEVER)));
        for at in passes {
            let next = open.partition_point(|time| time.end < at);
            if open.get(next).is_none_or(|time| time.begin > at) {
                found.add(ImpossibleKind::ThroughShutDoor, at, Span::ZERO);
            }
        }
    }

    fn company(&self, found: &mut ImpossibleCounts) {
        let mut hosts: Vec<usize> = self.hosts.iter().map(|(_, host)| *host).collect();
        hosts.dedup();
        for &host in &hosts {
            let guests: Vec<usize> = self.hosts.iter().filter(|(_, of)| *of == host).map(|(guest, _)| *guest).collect();
            for (name, time) in self.rows(host) {
                if name == VISIT && !guests.iter().any(|&guest| self.is_home(guest, time)) {
                    found.add(ImpossibleKind::HostAlone, time.begin, time.length());
                }
                if !MEALS.iter().any(|(eating, _)| *eating == name) || time.length() < 10 * MINUTE {
                    continue;
                }
                for &guest in guests.iter().filter(|&&guest| self.is_home_throughout(guest, time)) {
                    let eats = self.rows(guest).any(|(name, of)| {
                        MEALS.iter().any(|(eating, _)| *eating == name) && !of.intersection(time).is_empty()
                    });
                    if !eats {
                        found.add(ImpossibleKind::HungryGuest, time.begin, time.length());
                    }
                }
            }
        }
        for &(visitor, host) in &self.hosts {
            together(&self.moves[visitor], &self.moves[host], |visits, hosts, time| {
                let is_home = |segment: &MotionSegment| segment.doing != MotionState::Away;
                // A guest leaves with the host.
                if is_home(visits) && !is_home(hosts) && time.length() > PATIENCE {
                    found.add(ImpossibleKind::VisitToNobody, time.begin, time.length());
                }
            });
        }
    }

    fn is_doing(&self, body: usize, at: RunTime, what: &str) -> bool {
        let next = self.doing[body].partition_point(|(begin, _)| *begin <= at);
        self.doing[body][..next].last().is_some_and(|(_, name)| name.as_deref() == Some(what))
    }
}

fn meet(a: &[MotionSegment], b: &[MotionSegment], found: &mut ImpossibleCounts) {
    together(a, b, |a, b, time| {
        let strides = |segment: &MotionSegment| matches!(segment.doing, MotionState::Stride { .. });
        let is_up = |segment: &MotionSegment| segment.posture == Posture::Standing;
        // Two sides of a bed, and two who lie, sit or help each other there, are not.
        let are_up = is_up(a) && is_up(b);
        let are_still = !strides(a) && !strides(b) && a.posture == b.posture;
        if !are_up && !are_still {
            return;
        }
        let near = near(a, b, time);
        if near > Span::ZERO {
            found.add(ImpossibleKind::TooNear, time.begin, near);
        }
    });
}

/// Time in an interval with two people within [`PASSING_M`].
fn near(a: &MotionSegment, b: &MotionSegment, time: Interval<RunTime>) -> Span {
    let at = |instant: RunTime| -> Option<f64> { Some(a.position(instant)?.distance(b.position(instant)?)) };
    let instants = (0..LOOKS).map(|part| time.begin + time.length() * part / (LOOKS - 1));
    let near = instants.filter_map(at).filter(|&metres| metres < PASSING_M).count() as i64;
    time.length() * near / LOOKS
}

/// Passes on the simultaneous movements of two people, and their time.
fn together(
    a: &[MotionSegment],
    b: &[MotionSegment],
    mut each: impl FnMut(&MotionSegment, &MotionSegment, Interval<RunTime>),
) {
    let (mut of_a, mut of_b) = (a.iter().peekable(), b.iter().peekable());
    while let (Some(a), Some(b)) = (of_a.peek(), of_b.peek()) {
        let both = Interval::new(a.begin.max(b.begin), a.end.min(b.end));
        if !both.is_empty() {
            each(a, b, both);
        }
        if a.end <= b.end {
            of_a.next();
        } else {
            of_b.next();
        }
    }
}

#[derive(Clone, Debug, Default, Serialize)]
pub struct ImpossibleEvents {
    pub days: u32,
    /// In the order of the arguments.
    pub scenarios: Vec<ScenarioRow>,
    /// The random routines, by their first statement.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub routines: Vec<ScenarioRow>,
}

#[derive(Clone, Debug, Default, Serialize)]
pub struct ScenarioRow {
    pub scenario: String,
    pub people: usize,
    pub visits: usize,
    pub impossible: ImpossibleCounts,
}

impl ImpossibleEvents {
    pub fn is_clean(&self) -> bool {
        self.scenarios.iter().chain(&self.routines).all(|row| row.impossible.is_nothing())
    }

    /// The sum of the random routines.
    fn all_routines(&self) -> Option<ScenarioRow> {
        let mut sum = ScenarioRow { scenario: format!("{} routines", self.routines.len()), ..ScenarioRow::default() };
        for row in &self.routines {
            sum.people += row.people;
            sum.visits += row.visits;
            sum.impossible.add_all(&row.impossible);
        }
        (!self.routines.is_empty()).then_some(sum)
    }
}

impl fmt::Display for ImpossibleEvents {
    /// A table with the kinds as rows and the scenarios as columns, then the first event of each kind of a random routine.
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let columns: Vec<ScenarioRow> = self.scenarios.iter().cloned().chain(self.all_routines()).collect();
        let names: Vec<String> = columns.iter().map(|row| row.scenario.clone()).collect();
        let width = |name: &String| name.chars().count().max(8);
        let line = |f: &mut fmt::Formatter, head: &str, cells: &dyn Fn(&ScenarioRow) -> String| {
            write!(f, "{head:44}")?;
            for (row, name) in columns.iter().zip(&names) {
                write!(f, "  {:>width$}", cells(row), width = width(name))?;
            }
            writeln!(f)
        };
        line(f, &format!("{} days", self.days), &|row| row.scenario.clone())?;
        line(f, "people", &|row| row.people.to_string())?;
        line(f, "visits", &|row| row.visits.to_string())?;
        for kind in ImpossibleKind::ALL {
            line(f, kind.in_words(), &|row| row.impossible.of(kind).events.to_string())?;
        }
        for row in &self.routines {
            let first = |kind: &ImpossibleKind| Some((*kind, row.impossible.of(*kind).first?));
            for (kind, at) in ImpossibleKind::ALL.iter().filter_map(first) {
                writeln!(
                    f,
                    "{}: {}, first after {:.2} days",
                    row.scenario,
                    kind.in_words(),
                    at.seconds() / DAY.seconds()
                )?;
            }
        }
        Ok(())
    }
}
