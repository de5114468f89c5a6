//! A run: residents with their drivers in a world, and the one loop of the program.

use crate::drivers::live::{Input, KeyTrack, LiveDriver};
use crate::drivers::path::PathDriver;
use crate::drivers::{Body, Decide, Driver, MotionSegment, Next};
use crate::event::{Events, Fact, MotionState, ThingUse};
use crate::geometry::{self, Point};
use crate::home::plan::Plan;
use crate::home::{Build, Home, Sun};
use crate::ids::{ResidentId, RoomId, ThingId};
use crate::link::{self, Link};
use crate::scenario::load::{self, Scenario};
use crate::scene::{Presence, Scene};
use crate::sensor_set::SensorSet;
use crate::sensors::Sensor;
use crate::stride::Stride;
use crate::time::{Micros, NEVER, SECOND};
use crate::world::World;
use std::borrow::Cow;
use std::sync::Arc;

/// A scenario being lived. A clone continues exactly as the original.
#[derive(Clone, Debug)]
pub struct Run {
    world: World,
    residents: Vec<Resident>,
    names: Vec<String>,
    /// By thing of the plan: who has turned it on, or opened it.
    users: Vec<Vec<ResidentId>>,
    /// By thing of the plan: whether it is on, or open.
    on: Vec<bool>,
    /// Nothing where all that sensors say reaches the logger at once.
    link: Option<Box<Link>>,
    length: Micros,
}

#[derive(Clone, Debug)]
struct Resident {
    build: Build,
    driver: Driver,
    /// Until when the world knows what the resident does.
    until: Micros,
    room: Option<RoomId>,
    /// Whether any room was told yet.
    located: bool,
    /// Where the move that was told last ends; nothing while away.
    last: Option<Point>,
}

/// Who decides for those whose driver is not of this crate.
pub trait DriverProvider {
    /// Who comes into the home besides the scenario's residents.
    fn guests(&self) -> Vec<Guest>;

    /// The driver of a body: the scenario's residents first, then the guests. Nothing where the scenario says all.
    fn driver(&self, body: usize, home: &Arc<Home>, seed: u64) -> Option<Box<dyn Decide>>;
}

/// A scenario of paths and keys needs nobody.
impl DriverProvider for () {
    fn guests(&self) -> Vec<Guest> {
        Vec::new()
    }

    fn driver(&self, _body: usize, _home: &Arc<Home>, _seed: u64) -> Option<Box<dyn Decide>> {
        None
    }
}

/// Somebody who comes and goes.
#[derive(Clone, Debug, PartialEq)]
pub struct Guest {
    pub name: String,
    pub build: Build,
}

impl Run {
    /// A run of a scenario from its start, `length` long.
    pub fn new(scenario: &Scenario, drivers_of: &dyn DriverProvider, seed: u64, length: Micros) -> Run {
        let guests = drivers_of.guests();
        let residents = scenario.residents.iter().map(|resident| Build::of(&resident.file));
        let builds: Vec<Build> = residents.chain(guests.iter().map(|guest| guest.build)).collect();
        let start_of_day = scenario.calendar.start_of_day();
        let link = scenario.link.as_ref().map(|file| Link::new(file, &scenario.home.sensors, start_of_day, seed));
        let mut file = Cow::Borrowed(&scenario.home);
        if let Some(link) = &scenario.link {
            file.to_mut().sensors.extend(link::other_places(link, &scenario.home.sensors));
        }
        let mut home = Home::bake(&file, &builds);
        home.sun = Sun::of(&scenario.calendar, scenario.home.latitude_deg);
        let home = Arc::new(home);
        let drivers = (0..builds.len()).map(|body| {
            let given = || drivers_of.driver(body, &home, seed).map(Driver::Other);
            let resident = scenario.residents.get(body);
            let own = resident.and_then(|resident| driver(resident, &home.plan, start_of_day));
            own.or_else(given).unwrap_or(Driver::Absent)
        });
        let drivers = drivers.collect();
        let mut run = Run { link: link.map(Box::new), ..Run::of(home, builds, drivers, seed, length) };
        let names = scenario.residents.iter().map(|resident| resident.file.name.clone());
        run.names = names.chain(guests.into_iter().map(|guest| guest.name)).collect();
        run
    }

    /// A run of any drivers in a baked home.
    pub fn of(home: Arc<Home>, builds: Vec<Build>, drivers: Vec<Driver>, seed: u64, length: Micros) -> Run {
        let users = vec![Vec::new(); home.plan.things.len()];
        let on = home.plan.things.iter().map(|thing| thing.on).collect();
        let world = World::new(home, drivers.len(), seed);
        let resident = |(build, driver)| Resident { build, driver, until: 0, room: None, located: false, last: None };
        let names = (1..=drivers.len()).map(|number| format!("resident {number}")).collect();
        Run {
            world,
            residents: builds.into_iter().zip(drivers).map(resident).collect(),
            names,
            users,
            on,
            link: None,
            length,
        }
    }

    pub fn home(&self) -> &Home {
        self.world.home()
    }

    /// The names of the scenario's residents, then of those who come to visit.
    pub fn names(&self) -> Vec<String> {
        self.names.clone()
    }

    /// The sensors that the logger knows, in the order in which firings count them. The home has more where a sensor
    /// is moved in the course of the run.
    pub fn sensors(&self) -> &[Sensor] {
        let sensors = &self.home().sensors;
        &sensors[..self.link.as_ref().map_or(sensors.len(), |link| link.sensors())]
    }

    /// How far the run has come.
    pub fn now(&self) -> Micros {
        self.world.now()
    }

    /// The time up to which all firings have been told: how far the run has come, unless a sensor's clock is behind.
    pub fn settled(&self) -> Micros {
        self.link.as_ref().map_or(self.now(), |link| link.settled(self.now()))
    }

    /// How long it is in all.
    pub fn length(&self) -> Micros {
        self.length
    }

    /// What the run looks like now.
    pub fn scene(&self) -> Scene {
        let body = |resident: ResidentId| {
            Some(Presence {
                at: self.world.position(resident)?,
                heading: self.world.heading(resident),
                posture: self.world.posture(resident),
                room: self.residents[resident.index()].room,
            })
        };
        let all = (0..self.residents.len()).map(ResidentId::of);
        Scene {
            now: self.now(),
            bodies: all.clone().map(body).collect(),
            seeing: all.fold(SensorSet::default(), |seeing, resident| seeing | self.world.seeing(resident)),
            on: (0..self.on.len()).filter(|&thing| self.on[thing]).map(ThingId::of).collect(),
        }
    }

    /// The input of a resident who is moved by keys comes from whoever lives the run, after what its file says. False if the
    /// resident is not moved by keys.
    pub fn open_input(&mut self, resident: ResidentId) -> bool {
        let driver = self.residents.get_mut(resident.index()).map(|resident| &mut resident.driver);
        let Some(Driver::Live(driver)) = driver else { return false };
        driver.open();
        true
    }

    /// From now on the input of a resident whose input is open is this.
    pub fn input(&mut self, resident: ResidentId, input: Input) {
        let now = self.now();
        if let Some(Driver::Live(driver)) =
            self.residents.get_mut(resident.index()).map(|resident| &mut resident.driver)
        {
            driver.input(now, input);
        }
    }

    /// Lives until `until` or the end of the run, whichever is first, and adds to `events` what happens
    /// before then. In how many steps a run is advanced changes nothing.
    pub fn advance(&mut self, until: Micros, events: &mut Events) {
        let until = until.min(self.length);
        let Some(mut link) = self.link.take() else {
            while self.now() < until {
                self.begin_due(events);
                self.go_on(until, events);
            }
            return;
        };
        let mut said = Events::default();
        while self.now() < until {
            self.begin_due(events);
            self.go_on(until, &mut said);
            link.carry(&mut said, self.now(), events);
        }
        self.link = Some(link);
    }

    /// Asks the drivers of all whose move is over what comes next.
    fn begin_due(&mut self, events: &mut Events) {
        for resident in (0..self.residents.len()).map(ResidentId::of) {
            if self.residents[resident.index()].until <= self.world.now() {
                self.begin_next(resident, events);
            }
        }
    }

    /// Lets the world go on until somebody's move is over, or `until`.
    fn go_on(&mut self, until: Micros, events: &mut Events) {
        let next = self.residents.iter().map(|resident| resident.until).min();
        self.world.advance(until.min(next.unwrap_or(until)), events);
    }

    /// Lives the run from its beginning and returns what each resident does, for those who want to live it in another
    /// way. Only for a run that has not been advanced: what is under way is not told again.
    pub fn moves(&self) -> Vec<Vec<MotionSegment>> {
        let mut run = Run { link: None, ..self.clone() };
        let mut moves = vec![Vec::new(); run.residents.len()];
        let mut events = Events::default();
        while run.now() < run.length {
            run.advance(run.now() + 3600 * SECOND, &mut events);
            for fact in events.facts.drain(..) {
                if let Fact::Movement { resident, begin, end, doing, posture } = fact {
                    moves[resident.index()].push(MotionSegment { begin, end, doing, posture });
                }
            }
            events.clear();
        }
        moves
    }

    /// Asks the resident's driver what comes next, and tells the world.
    fn begin_next(&mut self, resident: ResidentId, events: &mut Events) {
        let now = self.world.now();
        let minds_others = self.residents[resident.index()].driver.minds_others();
        let others = if minds_others { self.others(resident) } else { Vec::new() };
        let next = loop {
            match self.residents[resident.index()].driver.next(now, &others, &self.on) {
                Next::Activity(name) => {
                    events.facts.push(Fact::Activity { resident, at: now, name });
                }
                Next::Use(act) => self.act(resident, act, now, events),
                Next::Vitals(vitals) => self.world.feel(resident, vitals),
                Next::Need(need, level) => {
                    events.facts.push(Fact::Need { resident, at: now, need, level });
                }
                Next::Condition(name, severity) => {
                    events.facts.push(Fact::Condition { resident, at: now, name, severity });
                }
                Next::Segment(next) => break next,
                Next::Done => break self.rest(resident),
            }
        };
        self.residents[resident.index()].until = next.end;
        self.tell_rooms(resident, &next, events);
        self.world.begin(resident, &next);
        let MotionSegment { end, doing, posture, .. } = next.until(self.length);
        events.facts.push(Fact::Movement { resident, begin: now, end, doing, posture });
    }

    /// A resident uses a thing. What several have turned on goes off with the last of them; what somebody else has left on,
    /// anybody turns off.
    fn act(&mut self, resident: ResidentId, act: ThingUse, now: Micros, events: &mut Events) {
        let users = &mut self.users[act.thing.index()];
        let was_on = !users.is_empty();
        if act.on {
            if !users.contains(&resident) {
                users.push(resident);
            }
        } else if users.contains(&resident) {
            users.retain(|user| *user != resident);
        } else {
            users.clear();
        }
        let changes = if act.on { !was_on } else { users.is_empty() };
        if changes {
            self.on[act.thing.index()] = act.on;
            events.facts.push(Fact::Use { resident, at: now, act });
            self.world.act(resident, act);
        }
    }

    /// The bodies of the others, where they are now.
    fn others(&self, resident: ResidentId) -> Vec<Body> {
        let others = (0..self.residents.len()).map(ResidentId::of).filter(|&other| other != resident);
        others
            .filter_map(|other| {
                Some(Body { at: self.world.position(other)?, radius_m: self.residents[other.index()].build.radius_m })
            })
            .collect()
    }

    /// Staying as one is, for ever.
    fn rest(&self, resident: ResidentId) -> MotionSegment {
        let (at, posture) = self.residents[resident.index()].driver.pose();
        MotionSegment { begin: self.world.now(), end: NEVER, doing: MotionState::Rest { at }, posture }
    }

    /// Tells the truth which rooms the resident comes through.
    fn tell_rooms(&mut self, resident: ResidentId, next: &MotionSegment, events: &mut Events) {
        let plan = &self.world.home().plan;
        let Resident { room, last, .. } = &mut self.residents[resident.index()];
        let before = std::mem::replace(
            last,
            match next.doing {
                MotionState::Stride { to, .. } => Some(to),
                MotionState::InPlace { at, .. } | MotionState::Rest { at } => Some(at),
                MotionState::Away => None,
            },
        );
        // Mostly the room stays the same, which needs no search.
        match next.doing {
            MotionState::InPlace { at, .. } | MotionState::Rest { at } if before == Some(at) => return,
            MotionState::Stride { from, to } if before == Some(from) => {
                let here = room.map(|room| &plan.rooms[room.index()]);
                if here.is_some_and(|room| room.is_convex && geometry::contains(&room.outline, to)) {
                    return;
                }
            }
            _ => {}
        }
        let rooms = match next.doing {
            MotionState::Stride { from, to } => plan.rooms_along(&Stride::new(from, to, next.begin, next.end)),
            MotionState::InPlace { at, .. } | MotionState::Rest { at } => vec![(next.begin, plan.room_at(at))],
            MotionState::Away => vec![(next.begin, None)],
        };
        let Resident { room, located, .. } = &mut self.residents[resident.index()];
        let length = self.length;
        for (at, new) in rooms.into_iter().filter(|&(at, _)| at < length) {
            let new = new.map(RoomId::of);
            if !*located || *room != new {
                (*located, *room) = (true, new);
                events.facts.push(Fact::Room { resident, at, room: new });
            }
        }
    }
}

/// The driver that a resident's files ask for, if this crate knows it.
fn driver(resident: &load::Resident, plan: &Plan, start_of_day: Micros) -> Option<Driver> {
    let load::Resident { file, driver } = resident;
    match driver {
        load::Driver::Path(path) => Some(Driver::Path(PathDriver::new(path, plan, file.pace_mps, start_of_day))),
        load::Driver::Live { input, start } => {
            let keys = KeyTrack::written(input, plan);
            Some(Driver::Live(Box::new(LiveDriver::new(plan, *start, file.radius_m, file.pace_mps, keys))))
        }
        load::Driver::Routine { .. } => None,
    }
}
