//! Activities as steps from place to place, with the things in use.

use super::manner::Manner;
use super::places::{HomePlace, HomePlaces};
use crate::routine::{Activity, Meal};
use homebody_core::activity::LEAVING_HOME;
use homebody_core::event::BodilyNeed;
use homebody_core::geometry::Point;
use homebody_core::posture::Posture;
use homebody_core::random::Stream;
use homebody_core::role::Role;
use homebody_core::time::{HOUR, MINUTE, RunTime, SECOND, Span};
use homebody_walk::WanderStyle;
use std::collections::VecDeque;

/// Roles whose things activities open, turn on or let run.
pub const ACTED_ON: [Role; 12] = [
    Role::Toilet,
    Role::Washbasin,
    Role::Shower,
    Role::Medicine,
    Role::Sink,
    Role::Fridge,
    Role::Drawers,
    Role::Stove,
    Role::FoodWarmer,
    Role::Television,
    Role::WashingMachine,
    Role::FrontDoor,
];

/// The visitor's next place, which a host at the door waits for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AwaitedGuest {
    In,
    /// On the way out, at the door or gone.
    AtDoor,
    Out,
}

#[derive(Clone, Debug)]
pub enum ActivityStep {
    /// The label in the ground truth from now on.
    Name(String),
    Go(HomePlace),
    /// On or open if true, else off or closed.
    Act(u32, bool),
    Stay(StayStep),
    /// Stays until another person has moved on.
    Wait(StayStep),
    /// Away for a span, or until an instant.
    Away {
        lasts: Span,
        until: Option<RunTime>,
    },
    /// Without a goal, or pacing.
    Wander {
        kind: WanderStyle,
        lasts: Span,
    },
    /// In night or day clothes: pulse and respiration change.
    LieDown,
    Meet(BodilyNeed),
    /// Waits this long for a visitor.
    Await {
        guest: AwaitedGuest,
        left: Span,
    },
    /// Waits outside for a free doorway; as a visitor, also to be let in.
    Ring {
        left: Span,
    },
    /// Waits for another person to finish cooking.
    AwaitMeal {
        left: Span,
    },
    /// As a visitor, does what the host's company asks for, until the end of the visit.
    KeepCompany,
    /// As a visitor, waits at the door to be seen out, and then opens it.
    Depart {
        left: Span,
    },
    AlongFloor {
        to: Point,
        mps: f64,
    },
    /// Waits on the floor to be found.
    LieUntilFound {
        left: Span,
    },
    Wake,
}

impl ActivityStep {
    /// Whether its end is the beginning of a way out or home.
    pub(super) fn is_before_way_out(&self) -> bool {
        matches!(self, ActivityStep::Away { .. } | ActivityStep::Await { .. })
    }
}

#[derive(Clone, Debug)]
pub struct StayStep {
    pub posture: Posture,
    pub manner: Manner,
    pub left: Span,
    /// A latest end in any case.
    pub until: Option<RunTime>,
    pub may: Interruptible,
}

/// The interruptions that a stay allows; each variant includes those before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interruptible {
    Nothing,
    /// Rules, falls and stumbles.
    Rules,
    /// Breaks of the plan; the stay continues afterwards.
    Breaks,
    /// Needs and meals; the stay continues afterwards.
    Interrupt,
    /// The next activity of the plan, which ends the stay.
    Yield,
}

/// Time that a host waits at the open door for a visitor who does not come (our choice).
const ARRIVAL_PATIENCE: Span = MINUTE.times(5);
/// Time that a host waits for a visitor to leave (our choice).
const FAREWELL_PATIENCE: Span = MINUTE.times(5);
/// Time that a person who comes home waits for another to leave the doorway (our choice).
const DOORWAY: Span = MINUTE.times(5);
/// Time that a person waits for a meal that another one still cooks (our choice).
const COOKING_PATIENCE: Span = MINUTE.times(45);

/// Probability that a meal uses each microwave and toaster, and mean duration (our choice): bread and a plate take two
/// minutes and more.
const WARMED: f64 = 0.5;
const WARMING_S: f64 = 150.0;

/// Shortest visit with meals and a bed for the visitor, and a usual day for the host (our choice).
pub(super) const STAYING_OVER: Span = HOUR.times(10);

/// The parts of a visit at the front door that the host is there for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum DoorParts {
    SeesOut,
    Both,
    Neither,
}

/// Time that the host first sits with such a visitor (our choice).
const WELCOME: Span = HOUR;

/// The input of an activity's steps.
pub struct ActivitySetting<'a> {
    pub places: &'a HomePlaces,
    /// The body's place at the start.
    pub at: Point,
    pub stream: &'a mut Stream,
    /// Things that stay on this time, such as a forgotten stove.
    pub forgotten: Vec<u32>,
    /// Things that are not used today.
    pub spared: Vec<u32>,
    pub movement: f64,
}

/// The steps of a host who opens the door to a visitor, and returns to something else.
pub(super) fn let_in(setting: &mut ActivitySetting) -> VecDeque<ActivityStep> {
    let mut steps = StepBuilder { steps: VecDeque::new(), setting };
    steps.push(ActivityStep::Name(Activity::Visit.label().into()));
    steps.let_in();
    steps.steps
}

/// The steps of a visit, with these of its parts at the door.
pub(super) fn visit(
    lasts: Span,
    until: Option<RunTime>,
    door: DoorParts,
    setting: &mut ActivitySetting,
) -> VecDeque<ActivityStep> {
    let mut steps = StepBuilder { steps: VecDeque::new(), setting };
    steps.push(ActivityStep::Name(Activity::Visit.label().into()));
    steps.visit(lasts, until, door);
    steps.steps
}

struct StepBuilder<'a, 'b> {
    steps: VecDeque<ActivityStep>,
    setting: &'b mut ActivitySetting<'a>,
}

/// The steps of an activity of this length, at a stated or the usual place.
pub fn script(
    activity: &Activity,
    place: Option<&HomePlace>,
    lasts: Span,
    until: Option<RunTime>,
    setting: &mut ActivitySetting,
) -> VecDeque<ActivityStep> {
    let mut steps = StepBuilder { steps: VecDeque::new(), setting };
    if let Activity::Eat(_) = activity {
        // The person waits for a meal before eating.
        steps.push(ActivityStep::AwaitMeal { left: COOKING_PATIENCE });
    }
    steps.push(ActivityStep::Name(activity.label().into()));
    steps.act_out(activity, place, lasts, until);
    steps.steps
}

impl StepBuilder<'_, '_> {
    fn act_out(&mut self, activity: &Activity, place: Option<&HomePlace>, lasts: Span, until: Option<RunTime>) {
        match activity {
            Activity::GetUp => self.stay(
                Posture::Sitting,
                Manner::TURNING,
                Span::from_seconds(lasts.seconds().clamp(30.0, 600.0)),
                Interruptible::Rules,
            ),
            Activity::UseBathroom => self.use_bathroom(place, lasts),
            Activity::Shower => self.shower(place, lasts),
            Activity::Wash => self.with_water(Role::Washbasin, place, lasts, Manner::WASHING),
            Activity::Dress => self.at(Role::Wardrobe, place, lasts, Manner::WASHING, Interruptible::Rules),
            Activity::TakeMedicine => self.take_medicine(place, lasts),
            Activity::Prepare(meal) => self.prepare(*meal, place, lasts),
            Activity::Eat(_) => {
                self.at(Role::DiningSeat, place, lasts, Manner::EATING, Interruptible::Rules);
                self.push(ActivityStep::Meet(BodilyNeed::Hunger));
                self.push(ActivityStep::Meet(BodilyNeed::Thirst));
            }
            Activity::WashUp => self.with_water(Role::Sink, place, lasts, Manner::BUSY),
            Activity::WatchTelevision => self.watch_television(place, lasts),
            Activity::Read => self.at(Role::Armchair, place, lasts, Manner::READING, Interruptible::Interrupt),
            Activity::Phone => self.at(Role::Telephone, place, lasts, Manner::TALKING, Interruptible::Interrupt),
            Activity::Nap => self.nap(place, lasts),
            Activity::Laundry => self.laundry(place, lasts),
            Activity::Housework => self.housework(place, lasts),
            Activity::Leave => self.leave(activity.label(), lasts, until),
            Activity::ComeHome | Activity::GoToBed => {}
            Activity::Visit => self.visit(lasts, until, DoorParts::Both),
            Activity::Drink => self.drink(place, lasts),
            Activity::Snack => self.snack(place, lasts),
            Activity::Exercise => self.at(Role::Armchair, place, lasts, Manner::BUSY, Interruptible::Interrupt),
            Activity::UseComputer => self.at(Role::Desk, place, lasts, Manner::READING, Interruptible::Interrupt),
            Activity::Relax => self.at(Role::Armchair, place, lasts, Manner::STILL, Interruptible::Interrupt),
            Activity::Wander => self.push(ActivityStep::Wander { kind: WanderStyle::Random, lasts }),
            Activity::Pace => self.push(ActivityStep::Wander { kind: WanderStyle::Pacing, lasts }),
            Activity::Lap => self.push(ActivityStep::Wander { kind: WanderStyle::Lapping, lasts }),
            Activity::LieAwake => self.stay(Posture::Lying, Manner::AWAKE_IN_BED, lasts, Interruptible::Interrupt),
            // Its steps depend on details: see `fallen`.
            Activity::Fall => {}
            Activity::Stumble => {
                self.stay(Posture::Bending, Manner::TURNING, 2 * SECOND, Interruptible::Nothing);
                self.stay(Posture::Standing, Manner::STILL, lasts, Interruptible::Nothing);
            }
            // Garden work is outdoors, unless a place of the home is stated.
            Activity::Everyday(label) if place.is_none() && activity.roles().contains(&Role::FrontDoor) => {
                self.leave(label, lasts, until);
            }
            Activity::Everyday(_) => {
                let has = |role: &&Role| self.setting.places.has(**role);
                let role = activity.roles().iter().find(has).copied().unwrap_or(Role::Armchair);
                let spot = place.or_else(|| self.setting.places.for_role(role)).cloned();
                let posture = spot.as_ref().map_or(Posture::Standing, |spot| spot.posture);
                let manner = if posture == Posture::Standing { Manner::BUSY } else { Manner::READING };
                self.at(role, spot.as_ref(), lasts, manner, Interruptible::Interrupt);
            }
            Activity::Other(_) => {
                let posture = place.map_or(Posture::Standing, |spot| spot.posture);
                let manner = if posture == Posture::Standing { Manner::BUSY } else { Manner::READING };
                self.at(Role::Armchair, place, lasts, manner, Interruptible::Interrupt);
            }
        }
    }

    fn push(&mut self, step: ActivityStep) {
        self.steps.push_back(step);
    }

    fn go(&mut self, role: Role, place: Option<&HomePlace>) -> Posture {
        let places = self.setting.places;
        let spot = place.or_else(|| match role {
            Role::Toilet | Role::Washbasin => places.nearest(role, self.setting.at),
            _ => places.for_role(role),
        });
        let spot = spot.cloned();
        if let Some(spot) = &spot {
            self.setting.at = spot.at;
        }
        let posture = spot.as_ref().map_or(Posture::Standing, |spot| spot.posture);
        self.steps.extend(spot.map(ActivityStep::Go));
        posture
    }

    /// The furniture of a stated room, or else the stated place itself.
    fn in_room(&self, role: Role, place: Option<&HomePlace>) -> Option<HomePlace> {
        let place = place?;
        let mut furniture = self.setting.places.all_for(role).into_iter();
        furniture.find(|spot| place.is_room && spot.room == place.room).or(Some(place)).cloned()
    }

    fn act(&mut self, role: Role, on: bool) {
        if let Some(thing) = self.setting.places.thing(role) {
            self.turn(thing, on);
        }
    }

    fn turn(&mut self, thing: u32, on: bool) {
        let ActivitySetting { forgotten, spared, .. } = &*self.setting;
        if !spared.contains(&thing) && (on || !forgotten.contains(&thing)) {
            self.push(ActivityStep::Act(thing, on));
        }
    }

    fn is_spared(&self, role: Role) -> bool {
        self.setting.places.thing(role).is_some_and(|thing| self.setting.spared.contains(&thing))
    }

    fn stay(&mut self, posture: Posture, manner: Manner, lasts: Span, may: Interruptible) {
        self.push(ActivityStep::Stay(StayStep { posture, manner, left: lasts, until: None, may }));
    }

    fn at(&mut self, role: Role, place: Option<&HomePlace>, lasts: Span, manner: Manner, may: Interruptible) {
        let posture = self.go(role, place);
        self.stay(posture, manner, lasts, may);
    }

    /// A random span around a median.
    fn around(&mut self, median_s: f64) -> Span {
        Span::from_seconds(self.setting.stream.lognormal(median_s, 0.4))
    }

    fn use_bathroom(&mut self, place: Option<&HomePlace>, lasts: Span) {
        let toilet = self.in_room(Role::Toilet, place);
        self.at(Role::Toilet, toilet.as_ref(), lasts, Manner::ON_TOILET, Interruptible::Rules);
        self.act(Role::Toilet, true);
        self.act(Role::Toilet, false);
        self.push(ActivityStep::Meet(BodilyNeed::Toilet));
        let washing = self.around(25.0);
        self.with_water(Role::Washbasin, None, washing, Manner::WASHING);
    }

    /// With a tap that runs now and then.
    fn with_water(&mut self, role: Role, place: Option<&HomePlace>, lasts: Span, manner: Manner) {
        let posture = self.go(role, place);
        let mut left = lasts;
        while left > Span::ZERO {
            let span = self.around(120.0).min(left);
            let running = self.around(20.0).min(span);
            self.act(role, true);
            self.stay(posture, manner, running, Interruptible::Rules);
            self.act(role, false);
            self.stay(posture, manner, span - running, Interruptible::Rules);
            left -= span;
        }
    }

    fn shower(&mut self, place: Option<&HomePlace>, lasts: Span) {
        self.go(Role::Shower, place);
        self.act(Role::Shower, true);
        self.stay(Posture::Standing, Manner::WASHING, lasts * 7 / 10, Interruptible::Rules);
        self.act(Role::Shower, false);
        self.at(Role::Washbasin, None, lasts * 3 / 10, Manner::WASHING, Interruptible::Rules);
    }

    fn take_medicine(&mut self, place: Option<&HomePlace>, lasts: Span) {
        self.go(Role::Medicine, place);
        self.act(Role::Medicine, true);
        self.stay(Posture::Standing, Manner::BUSY, lasts * 2 / 3, Interruptible::Rules);
        self.act(Role::Medicine, false);
        self.with_water(Role::Sink, None, lasts / 3, Manner::BUSY);
    }

    /// Between fridge, drawers, counter, sink and stove; hot food is not left alone. A stated appliance is used, and neither
    /// the stove nor another.
    fn prepare(&mut self, meal: Meal, place: Option<&HomePlace>, lasts: Span) {
        let hot = meal != Meal::Breakfast || self.setting.stream.chance(0.5);
        let places = self.setting.places;
        let appliance = place.filter(|place| !place.is_room).and_then(|place| {
            let thing = places.thing_named(&place.name)?;
            Some((place, thing))
        });
        if let Some((place, thing)) = appliance {
            return self.prepare_in(place, thing, lasts);
        }
        let hot = hot && !self.is_spared(Role::Stove);
        let mut left = lasts;
        let opening = [Role::Fridge, Role::Drawers, Role::Counter];
        for role in opening {
            left -= self.station(role, left);
        }
        if hot {
            self.go(Role::Stove, None);
            self.act(Role::Stove, true);
        }
        left -= self.warm(hot, left);
        while left > Span::ZERO {
            left -= self.next_station(hot, left);
        }
        if hot {
            self.go(Role::Stove, None);
            self.act(Role::Stove, false);
        }
    }

    fn prepare_in(&mut self, place: &HomePlace, thing: u32, lasts: Span) {
        let mut left = lasts;
        for role in [Role::Fridge, Role::Drawers, Role::Counter] {
            left -= self.station(role, left);
        }
        self.push(ActivityStep::Go(place.clone()));
        self.turn(thing, true);
        while left > Span::ZERO {
            left -= self.next_station(false, left);
        }
        self.push(ActivityStep::Go(place.clone()));
        self.turn(thing, false);
    }

    /// Mostly stove or counter. Returns the duration.
    fn next_station(&mut self, hot: bool, left: Span) -> Span {
        let roles =
            [if hot { Role::Stove } else { Role::Counter }, Role::Counter, Role::Sink, Role::Fridge, Role::Drawers];
        let role = roles[self.setting.stream.pick(&[0.45, 0.25, 0.12, 0.09, 0.09])];
        self.station(role, left)
    }

    /// Uses microwave and toaster if the home has them; they turn themselves off while the person continues. Returns the
    /// duration.
    fn warm(&mut self, hot: bool, left: Span) -> Span {
        let mut passed = Span::ZERO;
        for spot in self.setting.places.all_for(Role::FoodWarmer) {
            let thing = self.setting.places.thing_named(&spot.name);
            let Some(thing) = thing.filter(|_| passed < left && self.setting.stream.chance(WARMED)) else { continue };
            if self.setting.spared.contains(&thing) {
                continue;
            }
            self.push(ActivityStep::Go(spot.clone()));
            self.push(ActivityStep::Act(thing, true));
            let until = (passed + self.around(WARMING_S)).min(left);
            while passed < until {
                passed += self.next_station(hot, until - passed);
            }
            self.push(ActivityStep::Act(thing, false));
        }
        passed
    }

    /// A moment at a place of the kitchen. Returns the duration.
    fn station(&mut self, role: Role, left: Span) -> Span {
        let span = match role {
            Role::Fridge => self.around(12.0),
            Role::Drawers => self.around(15.0),
            Role::Sink => self.around(30.0),
            _ => self.around(45.0),
        };
        // Less active residents change places less often.
        let span = Span::from_seconds(span.seconds() / self.setting.movement.clamp(0.2, 1.0)).min(left);
        match role {
            Role::Sink => self.with_water(role, None, span, Manner::BUSY),
            Role::Fridge | Role::Drawers => {
                self.go(role, None);
                self.act(role, true);
                self.stay(Posture::Standing, Manner::BUSY, span, Interruptible::Rules);
                self.act(role, false);
            }
            _ => self.at(role, None, span, Manner::BUSY, Interruptible::Breaks),
        }
        span.max(SECOND)
    }

    fn watch_television(&mut self, place: Option<&HomePlace>, lasts: Span) {
        self.at(Role::Armchair, place, lasts, Manner::STILL, Interruptible::Interrupt);
        // Turned on after sitting down.
        let sitting = self.steps.pop_back();
        self.act(Role::Television, true);
        self.steps.extend(sitting);
        self.act(Role::Television, false);
    }

    fn nap(&mut self, place: Option<&HomePlace>, lasts: Span) {
        let role = if self.setting.stream.chance(0.5) { Role::Bed } else { Role::Armchair };
        // Met at the start, so that a nap is not followed by one from tiredness.
        self.push(ActivityStep::Meet(BodilyNeed::Tiredness));
        // A nap is not interrupted by thirst and other needs.
        self.at(role, place, lasts, Manner::ASLEEP, Interruptible::Rules);
    }

    fn laundry(&mut self, place: Option<&HomePlace>, lasts: Span) {
        let machine = self.in_room(Role::WashingMachine, place);
        self.at(Role::WashingMachine, machine.as_ref(), lasts * 6 / 10, Manner::BUSY, Interruptible::Rules);
        self.act(Role::WashingMachine, true);
        let dryer = self.in_room(Role::Dryer, place);
        self.at(Role::Dryer, dryer.as_ref(), lasts * 4 / 10, Manner::BUSY, Interruptible::Rules);
        self.act(Role::WashingMachine, false);
    }

    /// A round through the home or the stated room.
    fn housework(&mut self, place: Option<&HomePlace>, lasts: Span) {
        let stations = self.setting.places.stations().iter().map(|station| &station.spot);
        let mut stations: Vec<&HomePlace> =
            stations.filter(|spot| place.is_none_or(|place| spot.room == place.room)).collect();
        stations.extend(place.filter(|_| stations.is_empty()));
        let mut left = lasts;
        while left > Span::ZERO && !stations.is_empty() {
            let spot = stations[(self.setting.stream.unit() * stations.len() as f64) as usize % stations.len()];
            let span = self.around(45.0);
            // Less active residents stay longer at each place.
            let span = Span::from_seconds(span.seconds() / self.setting.movement.clamp(0.2, 1.0))
                .clamp(SECOND, left.max(SECOND));
            self.push(ActivityStep::Go(spot.clone()));
            self.stay(Posture::Standing, Manner::BUSY, span, Interruptible::Interrupt);
            left -= span;
        }
    }

    fn leave(&mut self, label: &str, lasts: Span, until: Option<RunTime>) {
        self.push(ActivityStep::Name(LEAVING_HOME.into()));
        let dressing = self.around(80.0);
        self.at(Role::Coats, None, dressing, Manner::BUSY, Interruptible::Rules);
        self.through_the_door();
        self.push(ActivityStep::Name(label.into()));
        self.push(ActivityStep::Away { lasts, until });
        self.push(ActivityStep::Ring { left: DOORWAY });
        self.push(ActivityStep::Name(Activity::ComeHome.label().into()));
        self.act(Role::FrontDoor, true);
        let inside = self.around(6.0);
        self.stay(Posture::Standing, Manner::BUSY, inside, Interruptible::Rules);
        self.act(Role::FrontDoor, false);
        let undressing = self.around(60.0);
        self.at(Role::Coats, None, undressing, Manner::BUSY, Interruptible::Rules);
    }

    fn through_the_door(&mut self) {
        self.go(Role::FrontDoor, None);
        self.act(Role::FrontDoor, true);
        let outside = self.around(5.0);
        self.stay(Posture::Standing, Manner::BUSY, outside, Interruptible::Rules);
        self.act(Role::FrontDoor, false);
    }

    fn let_in(&mut self) {
        self.go(Role::FrontDoor, None);
        self.act(Role::FrontDoor, true);
        self.push(ActivityStep::Await { guest: AwaitedGuest::In, left: ARRIVAL_PATIENCE });
        self.act(Role::FrontDoor, false);
        let welcome = self.around(40.0);
        self.at(Role::FrontDoor, None, welcome, Manner::TALKING, Interruptible::Rules);
    }

    /// Opens the door, sits with the visitor, sees them off.
    fn visit(&mut self, lasts: Span, until: Option<RunTime>, door: DoorParts) {
        if door == DoorParts::Both {
            self.let_in();
        }
        // During a visit of days, the host's routine continues.
        let (talk, until) = if lasts < STAYING_OVER { (lasts, until) } else { (WELCOME, None) };
        let posture = self.go(Role::Armchair, None);
        let may = Interruptible::Interrupt;
        self.push(ActivityStep::Stay(StayStep { posture, manner: Manner::TALKING, left: talk, until, may }));
        if lasts < STAYING_OVER && matches!(door, DoorParts::SeesOut | DoorParts::Both) {
            let farewell = self.around(60.0);
            self.at(Role::FrontDoor, None, farewell, Manner::TALKING, Interruptible::Rules);
            self.push(ActivityStep::Await { guest: AwaitedGuest::AtDoor, left: FAREWELL_PATIENCE });
            self.act(Role::FrontDoor, true);
            self.push(ActivityStep::Await { guest: AwaitedGuest::Out, left: FAREWELL_PATIENCE });
            self.act(Role::FrontDoor, false);
        }
    }

    fn drink(&mut self, place: Option<&HomePlace>, lasts: Span) {
        let hot = self.setting.stream.chance(0.3);
        if hot && !self.is_spared(Role::Stove) {
            self.go(Role::Stove, None);
            self.act(Role::Stove, true);
            let boiling = self.around(150.0);
            self.stay(Posture::Standing, Manner::BUSY, boiling, Interruptible::Rules);
            self.act(Role::Stove, false);
        }
        self.with_water(Role::Sink, None, (lasts / 4).max(10 * SECOND), Manner::BUSY);
        let seat = self.in_room(Role::DiningSeat, place);
        self.at(Role::DiningSeat, seat.as_ref(), lasts * 3 / 4, Manner::EATING, Interruptible::Rules);
        self.push(ActivityStep::Meet(BodilyNeed::Thirst));
    }

    fn snack(&mut self, place: Option<&HomePlace>, lasts: Span) {
        self.station(Role::Fridge, lasts);
        let seat = self.in_room(Role::DiningSeat, place);
        self.at(Role::DiningSeat, seat.as_ref(), lasts, Manner::EATING, Interruptible::Rules);
        self.push(ActivityStep::Meet(BodilyNeed::Hunger));
    }
}

#[cfg(test)]
mod tests;
