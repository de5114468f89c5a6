//! The small things that somebody rises for: a window is opened, dishes are put away, the mail is fetched.

use super::manner::Manner;
use super::places::{Places, Spot, is_opened};
use super::script::{Interruptible, Setting, Stay, Step};
use homebody_core::activity::{AIRING, FETCHING_MAIL, FRESHENING_UP, PUTTING_CLOTHES_AWAY, SEEING_TO_KITCHEN, TIDYING};
use homebody_core::names::words;
use homebody_core::numbers::Numbers;
use homebody_core::random::Stream;
use homebody_core::role::Role;
use homebody_core::scenario::path::Posture;
use homebody_core::time::{Micros, SECOND, micros};
use std::collections::VecDeque;

/// What somebody rises for, by the words in the names of the places where it is done; the first that fits counts. The lists are
/// ours.
const CHORES: [(&str, &[&str]); 5] = [
    (AIRING, &["window", "balcony"]),
    (FETCHING_MAIL, &["mailbox", "letterbox", "mail"]),
    (
        PUTTING_CLOTHES_AWAY,
        &["wardrobe", "closet", "dresser", "chest", "linen", "machine", "dryer", "clothes", "coats"],
    ),
    (FRESHENING_UP, &["washbasin", "basin", "mirror"]),
    (
        SEEING_TO_KITCHEN,
        &[
            "fridge",
            "refrigerator",
            "freezer",
            "stove",
            "oven",
            "kettle",
            "counter",
            "worktop",
            "sink",
            "microwave",
            "dishwasher",
            "kitchen",
            "drawers",
            "drawer",
            "cupboard",
            "cabinet",
            "pantry",
        ],
    ),
];

/// How long somebody is busy at one place, the median (ours).
const MOMENT_S: f64 = 45.0;

/// How often somebody takes the nearer of two things to do (ours).
const STAYS_NEAR: f64 = 0.5;

homebody_core::numbers! {
    /// When the mail is fetched at the earliest.
    static MAIL_FROM_H = "chores.mail_from": 10.0, "h", [0.0, 24.0];
    /// When the mail is fetched at the latest, at the next errand.
    static MAIL_UNTIL_H = "chores.mail_until": 14.0, "h", [0.0, 24.0];
}

/// What somebody rises for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Errand {
    /// The mail, which comes once a day.
    Mail,
    /// Whatever there is to do, mostly near where one sits.
    Any,
}

/// From which hour of a day on the mail is fetched.
pub fn mail_hour(stream: &mut Stream, numbers: &Numbers) -> f64 {
    let [from, until] = [&MAIL_FROM_H, &MAIL_UNTIL_H].map(|number| numbers.of(number));
    from + stream.unit() * (until - from).max(0.0)
}

/// The steps of an errand that takes about so long: one kind of thing, at one place of it after the other.
pub fn errand(errand: Errand, lasts: Micros, setting: &mut Setting) -> VecDeque<Step> {
    let places = setting.places;
    let front_door = places.of(Role::FrontDoor).filter(|spot| errand == Errand::Mail && spot.is_reachable);
    let mailbox = || places.stations().iter().find(|spot| chore(&spot.name) == FETCHING_MAIL);
    let mut steps = VecDeque::new();
    if let Some(spot) = mailbox().filter(|_| errand == Errand::Mail).or(front_door) {
        let thing = if spot.name == places.of(Role::FrontDoor).map_or("", |door| &door.name) {
            places.thing(Role::FrontDoor)
        } else {
            opened(places, &spot.name)
        };
        steps.push_back(Step::Name(FETCHING_MAIL.into()));
        visit(spot, thing, lasts, setting, &mut steps);
        return steps;
    }
    let Some(first) = nearer(&|_| true, setting) else { return steps };
    let label = chore(&first.name);
    steps.push_back(Step::Name(label.into()));
    let (mut left, mut spot) = (lasts, first);
    loop {
        left -= visit(spot, opened(places, &spot.name), left, setting, &mut steps);
        let next = nearer(&|spot| chore(&spot.name) == label, setting).filter(|_| left > 0);
        match next {
            Some(next) => spot = next,
            None => return steps,
        }
    }
}

/// Mostly of two stations the nearer to where one sits: nobody takes the stairs for every errand, as we assume.
fn nearer<'a>(fits: &dyn Fn(&Spot) -> bool, setting: &mut Setting<'a>) -> Option<&'a Spot> {
    let stations: Vec<&Spot> = setting.places.stations().iter().filter(|spot| fits(spot)).collect();
    if stations.is_empty() {
        return None;
    }
    let seat = setting.places.of(Role::Armchair).map(|seat| seat.at);
    let mut any = || stations[(setting.stream.unit() * stations.len() as f64) as usize % stations.len()];
    let (one, other) = (any(), any());
    let far = |spot: &Spot| seat.map_or(0.0, |seat| seat.distance(spot.at));
    let stays_near = setting.stream.chance(STAYS_NEAR);
    Some(if stays_near && far(other) < far(one) { other } else { one })
}

/// A moment at a place, with what has to be opened for it open; how long.
fn visit(spot: &Spot, thing: Option<u32>, left: Micros, setting: &mut Setting, steps: &mut VecDeque<Step>) -> Micros {
    let span = micros(setting.stream.lognormal(MOMENT_S, 0.4)).clamp(SECOND, left.max(SECOND));
    // What is open is not left for something else.
    let may = if thing.is_some() { Interruptible::Rules } else { Interruptible::Interrupt };
    setting.at = spot.at;
    steps.push_back(Step::Go(spot.clone()));
    steps.extend(thing.map(|thing| Step::Act(thing, true)));
    let stay = Stay { posture: Posture::Standing, manner: Manner::BUSY, left: span, until: None, may };
    steps.push_back(Step::Stay(stay));
    steps.extend(thing.map(|thing| Step::Act(thing, false)));
    span
}

/// What is done at a place of this name.
fn chore(name: &str) -> &'static str {
    let words = words(name);
    let fits = |(_, known): &&(&str, &[&str])| words.iter().any(|word| known.contains(&word.as_str()));
    CHORES.iter().find(fits).map_or(TIDYING, |(label, _)| label)
}

/// What is opened at a place of this name.
fn opened(places: &Places, name: &str) -> Option<u32> {
    places.thing_named(name).filter(|_| is_opened(name))
}
