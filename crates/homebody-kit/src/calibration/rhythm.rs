//! Where somebody was, as a diary: nights, outings, meals, the bathroom.
//!
//! | what | when |
//! |---|---|
//! | night | from noon to noon the longest time in bed, of three hours and more; who is back in bed within an hour and a half was not up |
//! | in bed by day | any other time in bed of twenty minutes and more |
//! | outing | out for five minutes and more |
//! | toilet, shower, washing | at the toilet, the shower, the washbasin for so long that it is no way past; washing after the toilet is part of it |
//! | sitting | on an armchair, a sofa or a chair at a desk for ten minutes and more; who is back within five minutes sat on |
//! | meal | at stove, counter, fridge or sink for four minutes and more, until one sits at the table: the longest in the morning, around noon and around six of each day |
//!
//! All limits are ours.

use crate::translation::{Translation, Whereabouts};
use homebody_core::geometry::Point;
use homebody_core::role::Role;
use homebody_core::scenario::load::Scenario;
use homebody_core::time::{DAY, Micros, SECOND};
use homebody_infer::Kind;
use homebody_routine::rhythm::{Noted, sentences};
use homebody_routine::routine::{Activity, Meal};
use homebody_walk::Mesh;
use homebody_walk::places::Places;
use std::collections::BTreeMap;
use std::ops::Range;

const MINUTE: Micros = 60 * SECOND;
const HOUR: Micros = 60 * MINUTE;

/// Who is nearer than this to a place is at it.
const AT_M: f64 = 1.0;
/// Who is back in bed within so long was not up.
const UP_AT_NIGHT: Micros = 90 * MINUTE;
/// Who lies down by day for less does not rest there.
const SHORTEST_NAP: Micros = 20 * MINUTE;
/// Who is back in the seat within so long sat on.
const SITS_ON: Micros = 5 * MINUTE;
const SHORTEST_SITTING: Micros = 10 * MINUTE;
const SHORTEST_NIGHT: Micros = 3 * HOUR;
const SHORTEST_OUTING: Micros = 5 * MINUTE;
/// Who is back in the kitchen within so long goes on with the meal.
const GOES_ON: Micros = 4 * MINUTE;
const SHORTEST_MEAL: Micros = 4 * MINUTE;
/// Who sits at the table for less does not eat yet.
const SHORTEST_EATING: Micros = 3 * MINUTE;
/// Who washes so soon after the toilet washes their hands.
const HANDS: Micros = 3 * MINUTE;

/// What is done where, for how long at least and at most.
const CARE: [(Role, Activity, Range<Micros>); 3] = [
    (Role::Toilet, Activity::UseBathroom, 20 * SECOND..40 * MINUTE),
    (Role::Shower, Activity::Shower, 2 * MINUTE..HOUR),
    (Role::Washbasin, Activity::Wash, MINUTE..HOUR),
];

/// Where somebody sits for long, other than for a meal.
const SEATS: [Role; 3] = [Role::Armchair, Role::Sofa, Role::Desk];

/// Where food is prepared.
const KITCHEN: [Role; 5] = [Role::Stove, Role::Counter, Role::Fridge, Role::Sink, Role::Drawers];

/// What somebody may be at.
const AT: [Role; 13] = [
    Role::Bed,
    Role::Toilet,
    Role::Shower,
    Role::Washbasin,
    Role::Stove,
    Role::Counter,
    Role::Fridge,
    Role::Sink,
    Role::Drawers,
    Role::DiningSeat,
    Role::Armchair,
    Role::Sofa,
    Role::Desk,
];

/// When meals are prepared, as times of day.
const MEALS: [(Meal, Range<Micros>); 3] = [
    (Meal::Breakfast, 4 * HOUR..10 * HOUR + 30 * MINUTE),
    (Meal::Lunch, 10 * HOUR + 30 * MINUTE..15 * HOUR),
    (Meal::Dinner, 16 * HOUR..21 * HOUR),
];

/// The usual night, as times of day.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Night {
    bed: Micros,
    up: Micros,
}

impl Night {
    /// Whether the hour that begins at an instant is one of the night (true) or of the day; nothing where it is of both.
    pub fn covers_hour(&self, begin: Micros) -> Option<bool> {
        let length = (self.up - self.bed).rem_euclid(DAY);
        let since = |at: Micros| (at - self.bed).rem_euclid(DAY);
        let ends = [begin, begin + HOUR - 1].map(|at| since(at) < length);
        (ends[0] == ends[1]).then_some(ends[0])
    }
}

/// A diary read off a log.
pub struct Rhythm {
    noted: Vec<Noted>,
}

impl Rhythm {
    /// Of the first resident of a log that was walked back.
    pub fn of(translation: &Translation, scenario: &Scenario) -> Rhythm {
        let resident = &scenario.residents[0].file;
        let plan = scenario.home.plan();
        let mesh = Mesh::with_numbers(plan, resident.radius_m, scenario.home.numbers());
        let places = Places::new(&scenario.home, plan, &mesh, &resident.name);
        let stays = stays(translation, &spots(&places));
        let mut noted = nights(&stays);
        let naps = naps(&stays, &noted);
        noted.extend(naps);
        noted.extend(SEATS.into_iter().flat_map(|seat| {
            let name = places.of(seat).map_or("", |spot| &spot.name);
            sittings(&stays, seat, name)
        }));
        let out = merged(&stays, 0, |stay| stay.is_out);
        let outings = out.into_iter().filter(|span| span.end - span.start >= SHORTEST_OUTING);
        noted.extend(outings.map(|span| done(Activity::Leave, span)));
        noted.extend(care(&stays));
        noted.extend(meals(&stays));
        noted.sort_by_key(|one| (one.begin, one.end));
        Rhythm { noted }
    }

    /// Its sentences: of what is noted, since what a log does not show may be done all the same.
    pub fn sentences(&self) -> Vec<String> {
        let known: Vec<Activity> = self.noted.iter().map(|one| one.what.clone()).collect();
        sentences(&self.noted, &known)
    }

    /// How many nights it has.
    pub fn nights(&self) -> usize {
        self.noted.iter().filter(|one| one.what == Activity::GoToBed).count()
    }

    /// The usual night: the median of beds and risings; nothing where there are less than two nights.
    pub fn night(&self) -> Option<Night> {
        let nights: Vec<&Noted> = self.noted.iter().filter(|one| one.what == Activity::GoToBed).collect();
        // From noon on, so that midnight parts none.
        let median = |of: fn(&Noted) -> Micros| {
            let mut times: Vec<Micros> = nights.iter().map(|one| (of(one) + DAY / 2).rem_euclid(DAY)).collect();
            times.sort_unstable();
            times.get(times.len() / 2).map(|time| (time + DAY / 2).rem_euclid(DAY))
        };
        let (bed, up) = (median(|one| one.begin)?, median(|one| one.end)?);
        (nights.len() >= 2).then_some(Night { bed, up })
    }
}

/// A stay of the first resident, in microseconds since 1970 on the clock on the wall.
struct Stay {
    span: Range<Micros>,
    /// What is there.
    at: Option<Role>,
    is_out: bool,
}

/// What there is to be at: of the home's own pieces, where each is.
type Spots = Vec<(Role, Point)>;

fn spots(places: &Places) -> Spots {
    let own = AT.into_iter().filter(|role| places.has(*role));
    own.filter_map(|role| Some((role, places.of(role)?.at))).collect()
}

fn stays(translation: &Translation, spots: &Spots) -> Vec<Stay> {
    let own: Vec<&Whereabouts> = translation.whereabouts.iter().filter(|one| one.who == 0).collect();
    let end = |index: usize| own.get(index + 1).map_or(translation.length, |next| next.at);
    let stay = |(index, one): (usize, &&Whereabouts)| {
        let (is_out, walks) = (one.kind == Kind::Out, one.kind == Kind::Walks);
        Stay {
            span: translation.wall(one.at)..translation.wall(end(index)),
            at: one.place.filter(|_| !walks).and_then(|at| at_what(at, spots)),
            is_out,
        }
    };
    own.iter().enumerate().map(stay).collect()
}

/// The nearest of the spots, if any is near.
fn at_what(at: Point, spots: &Spots) -> Option<Role> {
    let nearest = spots.iter().min_by(|a, b| a.1.distance(at).total_cmp(&b.1.distance(at)))?;
    (nearest.1.distance(at) < AT_M).then_some(nearest.0)
}

fn done(what: Activity, span: Range<Micros>) -> Noted {
    Noted { what, begin: span.start, end: span.end }
}

/// The spans of the stays that fit; those that are no more than `gap` apart are one.
fn merged(stays: &[Stay], gap: Micros, fits: impl Fn(&Stay) -> bool) -> Vec<Range<Micros>> {
    let mut spans: Vec<Range<Micros>> = Vec::new();
    for stay in stays.iter().filter(|stay| fits(stay)) {
        match spans.last_mut().filter(|last| stay.span.start - last.end <= gap) {
            Some(last) => last.end = stay.span.end,
            None => spans.push(stay.span.clone()),
        }
    }
    spans
}

fn is_at(stay: &Stay, roles: &[Role]) -> bool {
    stay.at.is_some_and(|at| roles.contains(&at))
}

/// From noon to noon the longest time in bed; what is shorter is a nap.
fn nights(stays: &[Stay]) -> Vec<Noted> {
    let in_bed = merged(stays, UP_AT_NIGHT, |stay| is_at(stay, &[Role::Bed]));
    let mut longest: BTreeMap<Micros, Range<Micros>> = BTreeMap::new();
    for span in in_bed.into_iter().filter(|span| span.end - span.start >= SHORTEST_NIGHT) {
        let middle = span.start / 2 + span.end / 2;
        let night = longest.entry((middle - DAY / 2).div_euclid(DAY)).or_insert(span.clone());
        if span.end - span.start > night.end - night.start {
            *night = span;
        }
    }
    longest.into_values().map(|span| done(Activity::GoToBed, span)).collect()
}

/// Times in bed that are none of the nights.
fn naps(stays: &[Stay], nights: &[Noted]) -> Vec<Noted> {
    let in_bed = merged(stays, SITS_ON, |stay| is_at(stay, &[Role::Bed]));
    let is_nap = |span: &Range<Micros>| {
        let is_of_night = nights.iter().any(|night| night.begin < span.end && span.start < night.end);
        span.end - span.start >= SHORTEST_NAP && !is_of_night
    };
    let nap = || Activity::Other("naps in bed".into());
    in_bed.into_iter().filter(is_nap).map(|span| done(nap(), span)).collect()
}

/// Times in a seat of this name.
fn sittings(stays: &[Stay], seat: Role, name: &str) -> Vec<Noted> {
    let spans = merged(stays, SITS_ON, |stay| is_at(stay, &[seat]));
    let long = spans.into_iter().filter(|span| span.end - span.start >= SHORTEST_SITTING);
    long.map(|span| done(Activity::Other(format!("sits in the {name}")), span)).collect()
}

fn care(stays: &[Stay]) -> Vec<Noted> {
    let mut noted: Vec<Noted> = Vec::new();
    for (role, what, lasts) in CARE {
        let spans = merged(stays, MINUTE, |stay| is_at(stay, &[role]));
        let spans = spans.into_iter().filter(|span| lasts.contains(&(span.end - span.start)));
        noted.extend(spans.map(|span| done(what.clone(), span)));
    }
    let toilets: Vec<Micros> =
        noted.iter().filter(|one| one.what == Activity::UseBathroom).map(|one| one.end).collect();
    let is_hands = |one: &Noted| toilets.iter().any(|&end| (-MINUTE..HANDS).contains(&(one.begin - end)));
    noted.retain(|one| one.what != Activity::Wash || !is_hands(one));
    noted
}

/// Of each day and meal the longest time in the kitchen and at the table: prepared until one sits down, then eaten.
fn meals(stays: &[Stay]) -> Vec<Noted> {
    let spans = merged(stays, GOES_ON, |stay| is_at(stay, &KITCHEN) || is_at(stay, &[Role::DiningSeat]));
    let seated = merged(stays, MINUTE, |stay| is_at(stay, &[Role::DiningSeat]));
    let first = spans.first().map_or(0, |span| span.start.div_euclid(DAY));
    let last = spans.last().map_or(0, |span| span.end.div_euclid(DAY) + 1);
    let days = (first..last).flat_map(|day| MEALS.iter().map(move |(meal, hours)| (day, *meal, hours)));
    let mut noted = Vec::new();
    for (day, meal, hours) in days {
        let of_meal = spans.iter().filter(|span| hours.contains(&(span.start - day * DAY)));
        let Some(span) = of_meal.max_by_key(|span| span.end - span.start) else { continue };
        let is_eating = |sits: &&Range<Micros>| {
            sits.start > span.start && sits.start < span.end && sits.end - sits.start >= SHORTEST_EATING
        };
        let eats = seated.iter().find(is_eating);
        let prepared = span.start..eats.map_or(span.end, |eats| eats.start);
        if prepared.end - prepared.start >= SHORTEST_MEAL {
            noted.push(done(Activity::Prepare(meal), prepared));
            noted.extend(eats.map(|eats| done(Activity::Eat(meal), eats.clone())));
        }
    }
    noted
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_core::geometry::point;

    fn stay(from: Micros, to: Micros, at: Option<Role>) -> Stay {
        Stay { span: from * MINUTE..to * MINUTE, at, is_out: false }
    }

    const BED: Option<Role> = Some(Role::Bed);
    const STOVE: Option<Role> = Some(Role::Stove);
    const SEAT: Option<Role> = Some(Role::DiningSeat);

    #[test]
    fn who_is_near_several_is_at_the_nearest() {
        let spots = vec![(Role::Stove, point([1.0, 1.0])), (Role::DiningSeat, point([1.5, 1.0]))];
        let told = [1.1, 1.4, 2.4, 2.6].map(|x| at_what(point([x, 1.0]), &spots));
        assert_eq!(told, [STOVE, SEAT, SEAT, None]);
    }

    #[test]
    fn who_is_back_in_bed_soon_was_not_up() {
        let stays = [
            stay(0, 200, BED),
            stay(200, 210, Some(Role::Toilet)),
            stay(210, 400, BED),
            stay(400, 600, None),
            stay(600, 640, BED),
        ];
        assert_eq!(nights(&stays), [done(Activity::GoToBed, 0..400 * MINUTE)]);
    }

    #[test]
    fn a_long_nap_is_no_night() {
        let day = 24 * 60;
        let stays = [
            stay(0, 400, BED),
            stay(14 * 60, 18 * 60, BED),
            stay(22 * 60, day + 400, BED),
            stay(day + 22 * 60, 2 * day, BED),
        ];
        // The nap and the night after it lie between the same noons; the last night is cut off.
        let wanted =
            [0..400, 22 * 60..day + 400].map(|span| done(Activity::GoToBed, span.start * MINUTE..span.end * MINUTE));
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
            done(Activity::Prepare(Meal::Breakfast), 480 * MINUTE..500 * MINUTE),
            done(Activity::Eat(Meal::Breakfast), 500 * MINUTE..520 * MINUTE),
            done(Activity::Prepare(Meal::Dinner), (day + 1020) * MINUTE..(day + 1050) * MINUTE),
        ];
        assert_eq!(meals(&stays), wanted);
    }

    #[test]
    fn who_washes_right_after_the_toilet_washes_their_hands() {
        let [toilet, basin] = [Role::Toilet, Role::Washbasin].map(Some);
        let stays = [stay(0, 5, toilet), stay(6, 8, basin), stay(60, 63, basin), stay(90, 92, toilet)];
        let told: Vec<Activity> = care(&stays).into_iter().map(|one| one.what).collect();
        assert_eq!(told, [Activity::UseBathroom, Activity::UseBathroom, Activity::Wash]);
    }

    #[test]
    fn hours_are_of_the_night_or_of_the_day() {
        let night = Night { bed: 23 * HOUR + 30 * MINUTE, up: 7 * HOUR };
        let told = [22, 23, 24, 30, 31].map(|hour| night.covers_hour(hour * HOUR));
        assert_eq!(told, [Some(false), None, Some(true), Some(true), Some(false)]);
    }
}
