//! How things are done: each activity as steps from place to place, with the things that are used on the way.

use super::manner::Manner;
use super::places::{Places, Spot};
use crate::routine::{Activity, Meal};
use homebody_core::activity::LEAVING_HOME;
use homebody_core::event::Need;
use homebody_core::geometry::Point;
use homebody_core::random::Stream;
use homebody_core::role::Role;
use homebody_core::scenario::path::Posture;
use homebody_core::time::{Micros, SECOND, micros, seconds};
use homebody_walk::Wandering;
use std::collections::VecDeque;

/// The roles whose things activities use: open, turn on, let run.
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

/// One step of a script.
#[derive(Clone, Debug)]
pub enum Step {
    /// From now on the truth calls it this.
    Name(String),
    Go(Spot),
    /// Turns a thing on or opens it (true), or off or closes it (false).
    Act(u32, bool),
    Stay(Stay),
    /// Out of the home for so long, or until then.
    Away {
        lasts: Micros,
        until: Option<Micros>,
    },
    /// Through the home without a goal, or to and fro.
    Wander {
        kind: Wandering,
        lasts: Micros,
    },
    /// The clothes of the night, or of the day: heart and lungs are told anew.
    LieDown,
    /// A need is met.
    Meet(Need),
    /// Who comes to visit is let in (true) or seen off (false): one waits so long.
    Await {
        arrival: bool,
        left: Micros,
    },
    /// Who is outside waits so long for the doorway to be free; a visitor to be let in as well.
    Ring {
        left: Micros,
    },
    /// Nobody eats while somebody else still cooks: one waits so long.
    AwaitMeal {
        left: Micros,
    },
    /// Along the floor to a point, on hands and knees.
    AlongFloor {
        to: Point,
        mps: f64,
    },
    /// Who lies on the floor waits so long to be found.
    LieUntilFound {
        left: Micros,
    },
    /// The day is over: the next one's plan is made.
    Wake,
}

/// Staying in one place.
#[derive(Clone, Debug)]
pub struct Stay {
    pub posture: Posture,
    pub manner: Manner,
    /// How long it still lasts.
    pub left: Micros,
    /// It ends then in any case.
    pub until: Option<Micros>,
    pub may: Interruptible,
}

/// What may end or break a stay.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interruptible {
    /// Nothing.
    Nothing,
    /// Only rules, falls and stumbles.
    Rules,
    /// These, and what the plan says is done meanwhile; it goes on afterwards.
    Breaks,
    /// These, needs and meals; it goes on afterwards.
    Interrupt,
    /// These, and whatever is next on the plan, which ends it.
    Yield,
}

/// Time that a host waits at the open door for a visitor who does not come (our choice).
const ARRIVAL_PATIENCE: Micros = 5 * 60 * SECOND;
/// Time that a host waits for a visitor to leave (our choice).
const FAREWELL_PATIENCE: Micros = 5 * 60 * SECOND;
/// Time that a person who comes home waits for another to leave the doorway (our choice).
const DOORWAY: Micros = 2 * 60 * SECOND;
/// Time that a person waits for a meal that another one still cooks (our choice).
const COOKING_PATIENCE: Micros = 45 * 60 * SECOND;

/// Probability that a meal uses each microwave and toaster, and mean duration (our choice): bread and a plate take two
/// minutes and more.
const WARMED: f64 = 0.5;
const WARMING_S: f64 = 150.0;

/// Shortest visit with meals and a bed for the visitor, and a usual day for the host (our choice).
pub(super) const STAYING_OVER: Micros = 10 * 3600 * SECOND;

/// Time that the host first sits with such a visitor (our choice).
const WELCOME: Micros = 3600 * SECOND;

/// What a script is made from.
pub struct Setting<'a> {
    pub places: &'a Places,
    /// Where the body is as it begins.
    pub at: Point,
    pub stream: &'a mut Stream,
    /// Which things stay on this time: the stove that is forgotten.
    pub forgotten: Vec<u32>,
    /// How many times the usual movement there is.
    pub movement: f64,
}

/// A script that is being put together.
struct Steps<'a, 'b> {
    steps: VecDeque<Step>,
    setting: &'b mut Setting<'a>,
}

/// The steps of an activity that lasts so long in all, at a place that was said or where it is usually done.
pub fn script(
    activity: &Activity,
    place: Option<&Spot>,
    lasts: Micros,
    until: Option<Micros>,
    setting: &mut Setting,
) -> VecDeque<Step> {
    let mut steps = Steps { steps: VecDeque::new(), setting };
    if let Activity::Eat(_) = activity {
        // Who waits for a meal does not eat yet.
        steps.push(Step::AwaitMeal { left: COOKING_PATIENCE });
    }
    steps.push(Step::Name(activity.label().into()));
    steps.act_out(activity, place, lasts, until);
    steps.steps
}

impl Steps<'_, '_> {
    fn act_out(&mut self, activity: &Activity, place: Option<&Spot>, lasts: Micros, until: Option<Micros>) {
        match activity {
            Activity::GetUp => self.stay(
                Posture::Sitting,
                Manner::TURNING,
                micros(seconds(lasts).clamp(30.0, 600.0)),
                Interruptible::Rules,
            ),
            Activity::UseBathroom => self.use_bathroom(lasts),
            Activity::Shower => self.shower(place, lasts),
            Activity::Wash => self.with_water(Role::Washbasin, place, lasts, Manner::WASHING),
            Activity::Dress => self.at(Role::Wardrobe, place, lasts, Manner::WASHING, Interruptible::Rules),
            Activity::TakeMedicine => self.take_medicine(place, lasts),
            Activity::Prepare(meal) => self.prepare(*meal, lasts),
            Activity::Eat(_) => {
                self.at(Role::DiningSeat, place, lasts, Manner::EATING, Interruptible::Rules);
                self.push(Step::Meet(Need::Hunger));
                self.push(Step::Meet(Need::Thirst));
            }
            Activity::WashUp => self.with_water(Role::Sink, place, lasts, Manner::BUSY),
            Activity::WatchTelevision => self.watch_television(place, lasts, until),
            Activity::Read => self.until(Role::Armchair, place, lasts, until, Manner::READING),
            Activity::Phone => self.until(Role::Telephone, place, lasts, until, Manner::TALKING),
            Activity::Nap => self.nap(place, lasts, until),
            Activity::Laundry => self.laundry(lasts),
            Activity::Housework => self.housework(place, lasts),
            Activity::Leave => self.leave(activity.label(), lasts, until),
            Activity::ComeHome | Activity::GoToBed => {}
            Activity::Visit => self.visit(lasts, until),
            Activity::Drink => self.drink(lasts),
            Activity::Snack => self.snack(lasts),
            Activity::Exercise => self.at(Role::Armchair, place, lasts, Manner::BUSY, Interruptible::Interrupt),
            Activity::UseComputer => self.until(Role::Desk, place, lasts, until, Manner::READING),
            Activity::Relax => self.until(Role::Armchair, place, lasts, until, Manner::STILL),
            Activity::Wander => self.push(Step::Wander { kind: Wandering::Random, lasts }),
            Activity::Pace => self.push(Step::Wander { kind: Wandering::Pacing, lasts }),
            Activity::Lap => self.push(Step::Wander { kind: Wandering::Lapping, lasts }),
            Activity::LieAwake => self.stay(Posture::Lying, Manner::AWAKE_IN_BED, lasts, Interruptible::Interrupt),
            // Its steps follow from how it is said: see `fallen`.
            Activity::Fall => {}
            Activity::Stumble => {
                self.stay(Posture::Bending, Manner::TURNING, 2 * SECOND, Interruptible::Nothing);
                self.stay(Posture::Standing, Manner::STILL, lasts, Interruptible::Nothing);
            }
            // What is done in the garden is done outside, but where a place of the home is named.
            Activity::Everyday(label) if place.is_none() && activity.roles().contains(&Role::FrontDoor) => {
                self.leave(label, lasts, until);
            }
            Activity::Everyday(_) => {
                let has = |role: &&Role| self.setting.places.has(**role);
                let role = activity.roles().iter().find(has).copied().unwrap_or(Role::Armchair);
                let spot = place.or_else(|| self.setting.places.of(role)).cloned();
                let posture = spot.as_ref().map_or(Posture::Standing, |spot| spot.posture);
                let manner = if posture == Posture::Standing { Manner::BUSY } else { Manner::READING };
                self.until(role, spot.as_ref(), lasts, until, manner);
            }
            Activity::Other(_) => {
                let posture = place.map_or(Posture::Standing, |spot| spot.posture);
                let manner = if posture == Posture::Standing { Manner::BUSY } else { Manner::READING };
                self.until(Role::Armchair, place, lasts, until, manner);
            }
        }
    }

    fn push(&mut self, step: Step) {
        self.steps.push_back(step);
    }

    fn go(&mut self, role: Role, place: Option<&Spot>) -> Posture {
        let places = self.setting.places;
        let spot = place.or_else(|| match role {
            Role::Toilet | Role::Washbasin => places.nearest(role, self.setting.at),
            _ => places.of(role),
        });
        let spot = spot.cloned();
        if let Some(spot) = &spot {
            self.setting.at = spot.at;
        }
        let posture = spot.as_ref().map_or(Posture::Standing, |spot| spot.posture);
        self.steps.extend(spot.map(Step::Go));
        posture
    }

    fn act(&mut self, role: Role, on: bool) {
        let thing = self.setting.places.thing(role);
        if let Some(thing) = thing.filter(|thing| on || !self.setting.forgotten.contains(thing)) {
            self.push(Step::Act(thing, on));
        }
    }

    fn stay(&mut self, posture: Posture, manner: Manner, lasts: Micros, may: Interruptible) {
        self.push(Step::Stay(Stay { posture, manner, left: lasts, until: None, may }));
    }

    /// Goes to a place and stays there.
    fn at(&mut self, role: Role, place: Option<&Spot>, lasts: Micros, manner: Manner, may: Interruptible) {
        let posture = self.go(role, place);
        self.stay(posture, manner, lasts, may);
    }

    /// The same, to be interrupted, and over at a time of day if it was said.
    fn until(&mut self, role: Role, place: Option<&Spot>, lasts: Micros, until: Option<Micros>, manner: Manner) {
        let posture = self.go(role, place);
        let left = if until.is_some() { Micros::MAX / 4 } else { lasts };
        self.push(Step::Stay(Stay { posture, manner, left, until, may: Interruptible::Interrupt }));
    }

    /// A span around so many seconds.
    fn around(&mut self, median_s: f64) -> Micros {
        micros(self.setting.stream.lognormal(median_s, 0.4))
    }

    fn use_bathroom(&mut self, lasts: Micros) {
        self.at(Role::Toilet, None, lasts, Manner::ON_TOILET, Interruptible::Rules);
        self.act(Role::Toilet, true);
        self.act(Role::Toilet, false);
        self.push(Step::Meet(Need::Toilet));
        let washing = self.around(25.0);
        self.with_water(Role::Washbasin, None, washing, Manner::WASHING);
    }

    /// With the tap of a place running now and then; most of the time it is off.
    fn with_water(&mut self, role: Role, place: Option<&Spot>, lasts: Micros, manner: Manner) {
        let posture = self.go(role, place);
        let mut left = lasts;
        while left > 0 {
            let span = self.around(120.0).min(left);
            let running = self.around(20.0).min(span);
            self.act(role, true);
            self.stay(posture, manner, running, Interruptible::Rules);
            self.act(role, false);
            self.stay(posture, manner, span - running, Interruptible::Rules);
            left -= span;
        }
    }

    fn shower(&mut self, place: Option<&Spot>, lasts: Micros) {
        self.go(Role::Shower, place);
        self.act(Role::Shower, true);
        self.stay(Posture::Standing, Manner::WASHING, lasts * 7 / 10, Interruptible::Rules);
        self.act(Role::Shower, false);
        self.at(Role::Washbasin, None, lasts * 3 / 10, Manner::WASHING, Interruptible::Rules);
    }

    fn take_medicine(&mut self, place: Option<&Spot>, lasts: Micros) {
        self.go(Role::Medicine, place);
        self.act(Role::Medicine, true);
        self.stay(Posture::Standing, Manner::BUSY, lasts * 2 / 3, Interruptible::Rules);
        self.act(Role::Medicine, false);
        self.with_water(Role::Sink, None, lasts / 3, Manner::BUSY);
    }

    /// To and fro between fridge, drawers, counter, sink and stove; what is hot has to be watched.
    fn prepare(&mut self, meal: Meal, lasts: Micros) {
        let hot = meal != Meal::Breakfast || self.setting.stream.chance(0.5);
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
        while left > 0 {
            left -= self.next_station(hot, left);
        }
        if hot {
            self.go(Role::Stove, None);
            self.act(Role::Stove, false);
        }
    }

    /// Most of the time at the stove or the counter; how long.
    fn next_station(&mut self, hot: bool, left: Micros) -> Micros {
        let roles =
            [if hot { Role::Stove } else { Role::Counter }, Role::Counter, Role::Sink, Role::Fridge, Role::Drawers];
        let role = roles[self.setting.stream.pick(&[0.45, 0.25, 0.12, 0.09, 0.09])];
        self.station(role, left)
    }

    /// Microwave and toaster, of those that the home has: they turn themselves off, and one goes on meanwhile; how long.
    fn warm(&mut self, hot: bool, left: Micros) -> Micros {
        let mut passed = 0;
        for spot in self.setting.places.anybodys(Role::FoodWarmer) {
            let thing = self.setting.places.thing_named(&spot.name);
            let Some(thing) = thing.filter(|_| passed < left && self.setting.stream.chance(WARMED)) else { continue };
            self.push(Step::Go(spot.clone()));
            self.push(Step::Act(thing, true));
            let until = (passed + self.around(WARMING_S)).min(left);
            while passed < until {
                passed += self.next_station(hot, until - passed);
            }
            self.push(Step::Act(thing, false));
        }
        passed
    }

    /// A moment at a place of the kitchen; how long.
    fn station(&mut self, role: Role, left: Micros) -> Micros {
        let span = match role {
            Role::Fridge => self.around(12.0),
            Role::Drawers => self.around(15.0),
            Role::Sink => self.around(30.0),
            _ => self.around(45.0),
        };
        // Who moves less goes to and fro less.
        let span = micros(seconds(span) / self.setting.movement.clamp(0.2, 1.0)).min(left);
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

    fn watch_television(&mut self, place: Option<&Spot>, lasts: Micros, until: Option<Micros>) {
        self.until(Role::Armchair, place, lasts, until, Manner::STILL);
        // On once one sits before it.
        let sitting = self.steps.pop_back();
        self.act(Role::Television, true);
        self.steps.extend(sitting);
        self.act(Role::Television, false);
    }

    fn nap(&mut self, place: Option<&Spot>, lasts: Micros, until: Option<Micros>) {
        let role = if self.setting.stream.chance(0.5) { Role::Bed } else { Role::Armchair };
        // Met as it begins: who naps does not take another nap for being tired.
        self.push(Step::Meet(Need::Tiredness));
        let posture = self.go(role, place);
        let left = if until.is_some() { Micros::MAX / 4 } else { lasts };
        // Who naps sleeps on through thirst and the rest.
        self.push(Step::Stay(Stay { posture, manner: Manner::ASLEEP, left, until, may: Interruptible::Rules }));
    }

    fn laundry(&mut self, lasts: Micros) {
        self.at(Role::WashingMachine, None, lasts * 6 / 10, Manner::BUSY, Interruptible::Rules);
        self.act(Role::WashingMachine, true);
        self.at(Role::Dryer, None, lasts * 4 / 10, Manner::BUSY, Interruptible::Rules);
        self.act(Role::WashingMachine, false);
    }

    /// A round through the home, or through the room that was said, a moment here and there.
    fn housework(&mut self, place: Option<&Spot>, lasts: Micros) {
        let stations = self.setting.places.stations().iter().map(|station| &station.spot);
        let mut stations: Vec<&Spot> =
            stations.filter(|spot| place.is_none_or(|place| spot.room == place.room)).collect();
        stations.extend(place.filter(|_| stations.is_empty()));
        let mut left = lasts;
        while left > 0 && !stations.is_empty() {
            let spot = stations[(self.setting.stream.unit() * stations.len() as f64) as usize % stations.len()];
            let span = self.around(45.0);
            // Who moves less stays longer at each place.
            let span = micros(seconds(span) / self.setting.movement.clamp(0.2, 1.0)).clamp(SECOND, left.max(SECOND));
            self.push(Step::Go(spot.clone()));
            self.stay(Posture::Standing, Manner::BUSY, span, Interruptible::Interrupt);
            left -= span;
        }
    }

    fn leave(&mut self, label: &str, lasts: Micros, until: Option<Micros>) {
        self.push(Step::Name(LEAVING_HOME.into()));
        let dressing = self.around(80.0);
        self.at(Role::Coats, None, dressing, Manner::BUSY, Interruptible::Rules);
        self.through_the_door();
        self.push(Step::Name(label.into()));
        self.push(Step::Away { lasts, until });
        self.push(Step::Ring { left: DOORWAY });
        self.push(Step::Name(Activity::ComeHome.label().into()));
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

    /// Opens the door, sits with the visitor, sees them off.
    fn visit(&mut self, lasts: Micros, until: Option<Micros>) {
        self.go(Role::FrontDoor, None);
        self.act(Role::FrontDoor, true);
        self.push(Step::Await { arrival: true, left: ARRIVAL_PATIENCE });
        self.act(Role::FrontDoor, false);
        let welcome = self.around(40.0);
        self.at(Role::FrontDoor, None, welcome, Manner::TALKING, Interruptible::Rules);
        // With who stays for days, life goes on.
        let (talk, until) = if lasts < STAYING_OVER { (lasts, until) } else { (WELCOME, None) };
        let posture = self.go(Role::Armchair, None);
        let may = Interruptible::Interrupt;
        self.push(Step::Stay(Stay { posture, manner: Manner::TALKING, left: talk, until, may }));
        if lasts < STAYING_OVER {
            let farewell = self.around(60.0);
            self.at(Role::FrontDoor, None, farewell, Manner::TALKING, Interruptible::Rules);
            self.act(Role::FrontDoor, true);
            self.push(Step::Await { arrival: false, left: FAREWELL_PATIENCE });
            self.act(Role::FrontDoor, false);
        }
    }

    fn drink(&mut self, lasts: Micros) {
        let hot = self.setting.stream.chance(0.3);
        if hot {
            self.go(Role::Stove, None);
            self.act(Role::Stove, true);
            let boiling = self.around(150.0);
            self.stay(Posture::Standing, Manner::BUSY, boiling, Interruptible::Rules);
            self.act(Role::Stove, false);
        }
        self.with_water(Role::Sink, None, (lasts / 4).max(10 * SECOND), Manner::BUSY);
        self.at(Role::DiningSeat, None, lasts * 3 / 4, Manner::EATING, Interruptible::Rules);
        self.push(Step::Meet(Need::Thirst));
    }

    fn snack(&mut self, lasts: Micros) {
        self.station(Role::Fridge, lasts);
        self.at(Role::DiningSeat, None, lasts, Manner::EATING, Interruptible::Rules);
        self.push(Step::Meet(Need::Hunger));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::routine::USUAL;
    use homebody_core::home::plan::Plan;
    use homebody_core::scenario::home::HomeFile;
    use homebody_walk::Mesh;
    use std::collections::BTreeSet;

    /// Where an activity leads in the example's apartment, over many days, by name.
    fn ways(activity: &Activity, places: &Places) -> BTreeSet<String> {
        let steps = (0..40).flat_map(|seed| {
            let mut stream = Stream::named(seed, "script");
            let at = places.of(Role::Armchair).unwrap().at;
            let mut setting = Setting { places, at, stream: &mut stream, forgotten: Vec::new(), movement: 1.0 };
            script(activity, None, 1200 * SECOND, None, &mut setting)
        });
        let goes = steps.filter_map(|step| match step {
            Step::Go(spot) => Some(spot.name),
            _ => None,
        });
        goes.collect()
    }

    #[test]
    fn the_roles_that_are_acted_on_are_those_of_the_scripts() {
        let home = include_str!("../../../../scenarios/tigerplace/home.json");
        let home: HomeFile = serde_json::from_str(&home.replace("\"nightstand\"", "\"medicine cabinet\"")).unwrap();
        let plan = Plan::new(&home);
        let places = Places::new(&home, &plan, &Mesh::new(&plan, 0.22), "margaret");
        let mut acted = BTreeSet::new();
        for activity in USUAL.iter().chain(&[Activity::Shower, Activity::TakeMedicine, Activity::Visit]) {
            for seed in 0..40 {
                let (mut stream, at) = (Stream::named(seed, "script"), places.of(Role::Armchair).unwrap().at);
                let mut setting =
                    Setting { places: &places, at, stream: &mut stream, forgotten: Vec::new(), movement: 1.0 };
                let steps = script(activity, None, 1200 * SECOND, None, &mut setting);
                acted.extend(steps.into_iter().filter_map(|step| match step {
                    Step::Act(thing, _) => Some(places.thing_name(thing).to_owned()),
                    _ => None,
                }));
            }
        }
        let things = ACTED_ON.iter().filter_map(|&role| places.thing(role));
        assert_eq!(acted, things.map(|thing| places.thing_name(thing).to_owned()).collect());
    }

    #[test]
    fn the_roles_of_an_activity_are_those_that_its_script_goes_to() {
        let home = include_str!("../../../../scenarios/tigerplace/home.json");
        let home: HomeFile = serde_json::from_str(home).unwrap();
        let plan = Plan::new(&home);
        let places = Places::new(&home, &plan, &Mesh::new(&plan, 0.22), "margaret");
        let more = [
            Activity::Shower,
            Activity::TakeMedicine,
            Activity::Nap,
            Activity::Exercise,
            Activity::UseComputer,
            Activity::Relax,
            Activity::ComeHome,
            Activity::Other("knits".into()),
        ];
        for activity in USUAL.iter().chain(&more) {
            // The night and getting up have scripts of their own.
            if matches!(activity, Activity::GetUp | Activity::GoToBed) {
                continue;
            }
            let names = activity.roles().iter().map(|&role| places.of(role).unwrap().name.clone());
            assert_eq!(ways(activity, &places), names.collect(), "{activity:?}");
        }
        // The seat of who visits is none of the host's script.
        let names = [Role::FrontDoor, Role::Armchair].map(|role| places.of(role).unwrap().name.clone());
        assert_eq!(ways(&Activity::Visit, &places), names.into());
    }
}
