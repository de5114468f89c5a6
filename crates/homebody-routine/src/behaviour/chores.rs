//! Small errands: opening a window, putting dishes away, fetching the mail.

use super::manner::Manner;
use super::places::{ChoreStation, HomePlace};
use super::script::{ActivitySetting, ActivityStep, Interruptible, StayStep};
use homebody_core::activity::FETCHING_MAIL;
use homebody_core::numbers::Numbers;
use homebody_core::posture::Posture;
use homebody_core::random::Stream;
use homebody_core::role::Role;
use homebody_core::time::{SECOND, Span};
use std::collections::VecDeque;

/// Median time that a person is busy at one place (our choice).
const MOMENT_S: f64 = 45.0;

/// Probability of choosing the nearer of two things to do (our choice).
const STAYS_NEAR: f64 = 0.5;

homebody_core::numbers! {
    /// Earliest time of day for fetching the mail.
    static MAIL_FROM_H = "chores.mail_from": 10.0, "h", [0.0, 24.0];
    /// Latest time of day for fetching the mail, at the next errand.
    static MAIL_UNTIL_H = "chores.mail_until": 14.0, "h", [0.0, 24.0];
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Errand {
    /// Once a day.
    Mail,
    /// Any other errand, mostly near the seat.
    Any,
}

/// The hour after which the mail is fetched.
pub fn mail_hour(stream: &mut Stream, numbers: &Numbers) -> f64 {
    let [from, until] = [&MAIL_FROM_H, &MAIL_UNTIL_H].map(|number| numbers.of(number));
    from + stream.unit() * (until - from).max(0.0)
}

/// Steps of an errand of about this length: one kind of chore, at one place after the other.
pub fn errand(errand: Errand, lasts: Span, setting: &mut ActivitySetting) -> VecDeque<ActivityStep> {
    let places = setting.places;
    let mut steps = VecDeque::new();
    if errand == Errand::Mail {
        let mailbox = places.stations().iter().find(|station| station.chore == FETCHING_MAIL);
        let mailbox = mailbox.map(|station| (&station.spot, station.opened));
        let door = places.for_role(Role::FrontDoor).filter(|door| door.is_reachable);
        if let Some((spot, thing)) = mailbox.or(door.map(|door| (door, places.thing(Role::FrontDoor)))) {
            steps.push_back(ActivityStep::Name(FETCHING_MAIL.into()));
            visit(spot, thing, lasts, setting, &mut steps);
            return steps;
        }
    }
    let Some(mut station) = nearer(&|_| true, setting) else { return steps };
    let chore = station.chore;
    steps.push_back(ActivityStep::Name(chore.into()));
    let mut left = lasts;
    loop {
        left -= visit(&station.spot, station.opened, left, setting, &mut steps);
        match nearer(&|station| station.chore == chore, setting).filter(|_| left > Span::ZERO) {
            Some(next) => station = next,
            None => return steps,
        }
    }
}

/// Mostly the nearer of two stations, because people avoid the stairs for errands (our assumption).
fn nearer<'a>(fits: &dyn Fn(&ChoreStation) -> bool, setting: &mut ActivitySetting<'a>) -> Option<&'a ChoreStation> {
    let stations = setting.places.stations();
    let count = stations.iter().filter(|station| fits(station)).count();
    if count == 0 {
        return None;
    }
    let mut any = || {
        let drawn = (setting.stream.unit() * count as f64) as usize % count;
        stations.iter().filter(|station| fits(station)).nth(drawn)
    };
    let (one, other) = (any()?, any()?);
    let seat = setting.places.for_role(Role::Armchair).map(|seat| seat.at);
    let far = |station: &ChoreStation| seat.map_or(0.0, |seat| seat.distance(station.spot.at));
    let stays_near = setting.stream.chance(STAYS_NEAR);
    Some(if stays_near && far(other) < far(one) { other } else { one })
}

/// A moment at a place, with its thing open. Returns the duration.
fn visit(
    spot: &HomePlace,
    thing: Option<u32>,
    left: Span,
    setting: &mut ActivitySetting,
    steps: &mut VecDeque<ActivityStep>,
) -> Span {
    let span = Span::from_seconds(setting.stream.lognormal(MOMENT_S, 0.4)).clamp(SECOND, left.max(SECOND));
    // An open thing is not left for other activities.
    let may = if thing.is_some() { Interruptible::Rules } else { Interruptible::Interrupt };
    setting.at = spot.at;
    steps.push_back(ActivityStep::Go(spot.clone()));
    steps.extend(thing.map(|thing| ActivityStep::Act(thing, true)));
    let stay = StayStep { posture: Posture::Standing, manner: Manner::BUSY, left: span, until: None, may };
    steps.push_back(ActivityStep::Stay(stay));
    steps.extend(thing.map(|thing| ActivityStep::Act(thing, false)));
    span
}
