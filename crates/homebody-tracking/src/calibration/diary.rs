//! The places of a person as a diary: nights, outings, meals, the bathroom.
//!
//! | what | when |
//! |---|---|
//! | night | from noon to noon the longest time in bed, of three hours and more; up to an hour and a half out of bed do not end it |
//! | in bed by day | any other time in bed of twenty minutes and more |
//! | outing | out for five minutes and more |
//! | toilet, shower, washing | at the toilet, the shower, the washbasin for longer than a way past; washing after the toilet is part of it |
//! | sitting | on an armchair, a sofa or a chair at a desk for ten minutes and more; up to five minutes elsewhere do not end it |
//! | meal | at stove, counter, fridge or sink for four minutes and more, until one sits at the table: the longest in the morning, around noon and around six of each day |
//!
//! All limits are our choice.

use crate::translation::{PersonStay, Translation};
use homebody_core::geometry::Point;
use homebody_core::role::Role;
use homebody_core::scenario::load::Scenario;
use homebody_core::time::{DAY, HOUR, Interval, MINUTE, RunTime, SECOND, Span, WallTime, joined};
use homebody_infer::StateKind;
use homebody_routine::rhythm::{DiaryEntry, sentences};
use homebody_routine::routine::{Activity, Meal};
use homebody_timeline::Episode;
use homebody_walk::Mesh;
use homebody_walk::places::HomePlaces;
use std::collections::BTreeMap;
use std::ops::Range;

/// Distance within which a person is at a place.
const AT_M: f64 = 1.0;
/// Longest absence from bed that does not end the night.
const UP_AT_NIGHT: Span = MINUTE.times(90);
const SHORTEST_NAP: Span = MINUTE.times(20);
/// Longest absence from a seat that does not end the sitting.
const SITS_ON: Span = MINUTE.times(5);
const SHORTEST_SITTING: Span = MINUTE.times(10);
const SHORTEST_NIGHT: Span = HOUR.times(3);
const SHORTEST_OUTING: Span = MINUTE.times(5);
/// Longest absence from the kitchen that does not end the meal.
const GOES_ON: Span = MINUTE.times(4);
const SHORTEST_MEAL: Span = MINUTE.times(4);
/// Shortest time at the table that is eating.
const SHORTEST_EATING: Span = MINUTE.times(3);
/// Longest time after the toilet in which washing is washing of hands.
const HANDS: Span = MINUTE.times(3);

/// Personal care by its place, with its shortest and longest time.
const CARE: [(Role, Activity, Range<Span>); 3] = [
    (Role::Toilet, Activity::UseBathroom, SECOND.times(20)..MINUTE.times(40)),
    (Role::Shower, Activity::Shower, MINUTE.times(2)..HOUR),
    (Role::Washbasin, Activity::Wash, MINUTE..HOUR),
];

/// Seats for long sittings other than meals.
const SEATS: [Role; 3] = [Role::Armchair, Role::Sofa, Role::Desk];

/// Places of meals: where food is prepared, and where it is eaten.
const MEAL_PLACES: [Role; 6] = [Role::Stove, Role::Counter, Role::Fridge, Role::Sink, Role::Drawers, Role::DiningSeat];

/// When meals are prepared, as times of day.
const MEALS: [(Meal, Range<Span>); 3] = [
    (Meal::Breakfast, HOUR.times(4)..MINUTE.times(630)),
    (Meal::Lunch, MINUTE.times(630)..HOUR.times(15)),
    (Meal::Dinner, HOUR.times(16)..HOUR.times(21)),
];

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UsualNight {
    bed: Span,
    up: Span,
}

impl UsualNight {
    /// True if the hour that begins at an instant is one of the night, false if it is one of the day; `None` if it is of both.
    pub fn covers_hour(&self, begin: WallTime) -> Option<bool> {
        let length = (self.up - self.bed).rem_euclid(DAY);
        let since = |at: WallTime| (at - self.bed).time_of_day();
        let ends = [begin, begin + HOUR - Span::MICROSECOND].map(|at| since(at) < length);
        (ends[0] == ends[1]).then_some(ends[0])
    }
}

pub struct Rhythm {
    noted: Vec<DiaryEntry>,
}

impl Rhythm {
    /// The diary of the first resident of a located log.
    pub fn new(translation: &Translation, scenario: &Scenario) -> Rhythm {
        let resident = &scenario.residents[0].file;
        let plan = scenario.home.plan();
        let mesh = Mesh::with_numbers(plan, resident.radius_m, scenario.home.numbers());
        let places = HomePlaces::new(&scenario.home, plan, &mesh, &resident.name);
        let stays = stays(translation, &spots(&places));
        let mut noted = nights(&stays);
        let naps = naps(&stays, &noted);
        noted.extend(naps);
        noted.extend(SEATS.into_iter().flat_map(|seat| {
            let name = places.for_role(seat).map_or("", |spot| &spot.name);
            sittings(&stays, seat, name)
        }));
        let out = stays.iter().filter(|stay| stay.label == DiaryPlace::Out).map(|stay| stay.time);
        let outings = joined(out, Span::ZERO).into_iter().filter(|span| span.length() >= SHORTEST_OUTING);
        noted.extend(outings.map(|span| done(Activity::Leave, span)));
        noted.extend(care(&stays));
        noted.extend(meals(&stays));
        noted.sort_by_key(|one| (one.begin, one.end));
        Rhythm { noted }
    }

    /// Its sentences: of the entries alone, since a person may do what a log does not show.
    pub fn sentences(&self) -> Vec<String> {
        let known: Vec<Activity> = self.noted.iter().map(|one| one.what.clone()).collect();
        sentences(&self.noted, &known)
    }

    pub fn nights(&self) -> usize {
        self.noted.iter().filter(|one| one.what == Activity::GoToBed).count()
    }

    /// The usual night: the median of beds and risings; `None` with less than two nights.
    pub fn night(&self) -> Option<UsualNight> {
        let nights: Vec<&DiaryEntry> = self.noted.iter().filter(|one| one.what == Activity::GoToBed).collect();
        // From noon on, so that midnight parts none.
        let median = |of: fn(&DiaryEntry) -> WallTime| {
            let mut times: Vec<Span> = nights.iter().map(|one| (of(one) + DAY / 2).time_of_day()).collect();
            times.sort_unstable();
            times.get(times.len() / 2).map(|time| (*time + DAY / 2).rem_euclid(DAY))
        };
        let (bed, up) = (median(|one| one.begin)?, median(|one| one.end)?);
        (nights.len() >= 2).then_some(UsualNight { bed, up })
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum DiaryPlace {
    Out,
    At(Role),
    Elsewhere,
}

type DiaryStay = Episode<WallTime, DiaryPlace>;

/// The home's own pieces with their places.
type Spots = Vec<(Role, Point)>;

fn spots(places: &HomePlaces) -> Spots {
    let roles = CARE.into_iter().map(|(role, ..)| role).chain(MEAL_PLACES).chain(SEATS);
    let own = [Role::Bed].into_iter().chain(roles).filter(|role| places.has(*role));
    own.filter_map(|role| Some((role, places.for_role(role)?.at))).collect()
}

fn stays(translation: &Translation, spots: &Spots) -> Vec<DiaryStay> {
    let own: Vec<&PersonStay> = translation.whereabouts.iter().filter(|one| one.who == 0).collect();
    let end = |index: usize| own.get(index + 1).map_or(RunTime::START + translation.length, |next| next.at);
    let stay = |(index, one): (usize, &&PersonStay)| {
        let place = match one.kind {
            StateKind::Out => DiaryPlace::Out,
            StateKind::Walks => DiaryPlace::Elsewhere,
            _ => one.place.and_then(|at| at_what(at, spots)).map_or(DiaryPlace::Elsewhere, DiaryPlace::At),
        };
        Episode::new(place, Interval::new(one.at, end(index)).map(|at| translation.wall(at)))
    };
    own.iter().enumerate().map(stay).collect()
}

/// The nearest of the spots, if any is near.
fn at_what(at: Point, spots: &Spots) -> Option<Role> {
    let nearest = spots.iter().min_by(|a, b| a.1.distance(at).total_cmp(&b.1.distance(at)))?;
    (nearest.1.distance(at) < AT_M).then_some(nearest.0)
}

fn done(what: Activity, Interval { begin, end }: Interval<WallTime>) -> DiaryEntry {
    DiaryEntry { what, begin, end }
}

/// The times at one of these roles; a gap of at most `gap` between two does not count.
fn times_at(stays: &[DiaryStay], gap: Span, roles: &[Role]) -> Vec<Interval<WallTime>> {
    let is_there = |stay: &&DiaryStay| matches!(&stay.label, DiaryPlace::At(role) if roles.contains(role));
    joined(stays.iter().filter(is_there).map(|stay| stay.time), gap)
}

/// From noon to noon the longest time in bed; a shorter one is a nap.
fn nights(stays: &[DiaryStay]) -> Vec<DiaryEntry> {
    let in_bed = times_at(stays, UP_AT_NIGHT, &[Role::Bed]);
    let mut longest: BTreeMap<i64, Interval<WallTime>> = BTreeMap::new();
    for span in in_bed.into_iter().filter(|span| span.length() >= SHORTEST_NIGHT) {
        let middle = span.begin + span.length() / 2;
        let night = longest.entry((middle - DAY / 2).day_number()).or_insert(span);
        if span.length() > night.length() {
            *night = span;
        }
    }
    longest.into_values().map(|span| done(Activity::GoToBed, span)).collect()
}

/// The times in bed outside the nights.
fn naps(stays: &[DiaryStay], nights: &[DiaryEntry]) -> Vec<DiaryEntry> {
    let in_bed = times_at(stays, SITS_ON, &[Role::Bed]);
    let is_nap = |span: &Interval<WallTime>| {
        let is_of_night = nights.iter().any(|night| Interval::new(night.begin, night.end).overlaps(*span));
        span.length() >= SHORTEST_NAP && !is_of_night
    };
    let nap = || Activity::Other("naps in bed".into());
    in_bed.into_iter().filter(is_nap).map(|span| done(nap(), span)).collect()
}

fn sittings(stays: &[DiaryStay], seat: Role, name: &str) -> Vec<DiaryEntry> {
    let spans = times_at(stays, SITS_ON, &[seat]);
    let long = spans.into_iter().filter(|span| span.length() >= SHORTEST_SITTING);
    long.map(|span| done(Activity::Other(format!("sits in the {name}")), span)).collect()
}

fn care(stays: &[DiaryStay]) -> Vec<DiaryEntry> {
    let mut noted: Vec<DiaryEntry> = Vec::new();
    for (role, what, lasts) in CARE {
        let spans = times_at(stays, MINUTE, &[role]);
        let spans = spans.into_iter().filter(|span| lasts.contains(&span.length()));
        noted.extend(spans.map(|span| done(what.clone(), span)));
    }
    let toilets: Vec<WallTime> =
        noted.iter().filter(|one| one.what == Activity::UseBathroom).map(|one| one.end).collect();
    let is_hands = |one: &DiaryEntry| toilets.iter().any(|&end| (-MINUTE..HANDS).contains(&(one.begin - end)));
    noted.retain(|one| one.what != Activity::Wash || !is_hands(one));
    noted
}

/// Of each day and meal the longest time in the kitchen and at the table: prepared until one sits down, then eaten.
fn meals(stays: &[DiaryStay]) -> Vec<DiaryEntry> {
    let spans = times_at(stays, GOES_ON, &MEAL_PLACES);
    let seated = times_at(stays, MINUTE, &[Role::DiningSeat]);
    let first = spans.first().map_or(0, |span| span.begin.day_number());
    let last = spans.last().map_or(0, |span| span.end.day_number() + 1);
    let days = (first..last).flat_map(|day| MEALS.iter().map(move |(meal, hours)| (day, *meal, hours)));
    let mut noted = Vec::new();
    for (day, meal, hours) in days {
        let of_meal = spans.iter().filter(|span| hours.contains(&(span.begin - day * DAY).since_zero()));
        let Some(span) = of_meal.max_by_key(|span| span.length()) else { continue };
        let is_eating = |sits: &&Interval<WallTime>| {
            sits.begin > span.begin && sits.begin < span.end && sits.length() >= SHORTEST_EATING
        };
        let eats = seated.iter().find(is_eating);
        let prepared = Interval::new(span.begin, eats.map_or(span.end, |eats| eats.begin));
        if prepared.length() >= SHORTEST_MEAL {
            noted.push(done(Activity::Prepare(meal), prepared));
            noted.extend(eats.map(|eats| done(Activity::Eat(meal), *eats)));
        }
    }
    noted
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_core::geometry::point;

    fn span(from: i64, to: i64) -> Interval<WallTime> {
        Interval::new(WallTime::EPOCH + from * MINUTE, WallTime::EPOCH + to * MINUTE)
    }

    fn stay(from: i64, to: i64, at: Option<Role>) -> DiaryStay {
        Episode::new(at.map_or(DiaryPlace::Elsewhere, DiaryPlace::At), span(from, to))
    }

    const BED: Option<Role> = Some(Role::Bed);
    const STOVE: Option<Role> = Some(Role::Stove);
    const SEAT: Option<Role> = Some(Role::DiningSeat);

    #[test]
    fn takes_the_nearest_of_several_spots() {
        let spots = vec![(Role::Stove, point([1.0, 1.0])), (Role::DiningSeat, point([1.5, 1.0]))];
        let told = [1.1, 1.4, 2.4, 2.6].map(|x| at_what(point([x, 1.0]), &spots));
        assert_eq!(told, [STOVE, SEAT, SEAT, None]);
    }

    #[test]
    fn short_time_out_of_bed_does_not_end_the_night() {
        let stays = [
            stay(0, 200, BED),
            stay(200, 210, Some(Role::Toilet)),
            stay(210, 400, BED),
            stay(400, 600, None),
            stay(600, 640, BED),
        ];
        assert_eq!(nights(&stays), [done(Activity::GoToBed, span(0, 400))]);
    }

    #[test]
    fn long_nap_is_not_a_night() {
        let day = 24 * 60;
        let stays = [
            stay(0, 400, BED),
            stay(14 * 60, 18 * 60, BED),
            stay(22 * 60, day + 400, BED),
            stay(day + 22 * 60, 2 * day, BED),
        ];
        // The nap and the night after it lie between the same noons; the last night is cut off.
        let wanted = [(0, 400), (22 * 60, day + 400)].map(|(from, to)| done(Activity::GoToBed, span(from, to)));
        assert_eq!(nights(&stays), wanted);
    }

    #[test]
    fn a_meal_is_the_longest_time_in_the_kitchen_around_its_hour_until_one_sits_down() {
        let day = 24 * 60;
        let stays = [
            stay(420, 425, STOVE),
            stay(480, 490, STOVE),
            stay(490, 491, SEAT),
            stay(493, 500, STOVE),
            stay(500, 520, SEAT),
            stay(520, 530, Some(Role::Sink)),
            stay(720, 723, STOVE),
            stay(day + 1020, day + 1050, Some(Role::Counter)),
        ];
        let wanted = [
            done(Activity::Prepare(Meal::Breakfast), span(480, 500)),
            done(Activity::Eat(Meal::Breakfast), span(500, 520)),
            done(Activity::Prepare(Meal::Dinner), span(day + 1020, day + 1050)),
        ];
        assert_eq!(meals(&stays), wanted);
    }

    #[test]
    fn washing_right_after_the_toilet_is_part_of_it() {
        let [toilet, basin] = [Role::Toilet, Role::Washbasin].map(Some);
        let stays = [stay(0, 5, toilet), stay(6, 8, basin), stay(60, 63, basin), stay(90, 92, toilet)];
        let told: Vec<Activity> = care(&stays).into_iter().map(|one| one.what).collect();
        assert_eq!(told, [Activity::UseBathroom, Activity::UseBathroom, Activity::Wash]);
    }

    #[test]
    fn hours_are_of_the_night_or_of_the_day() {
        let night = UsualNight { bed: 23 * HOUR + 30 * MINUTE, up: 7 * HOUR };
        let told = [22, 23, 24, 30, 31].map(|hour| night.covers_hour(WallTime::EPOCH + hour * HOUR));
        assert_eq!(told, [Some(false), None, Some(true), Some(true), Some(false)]);
    }
}
