//! A run: residents with their drivers in a world, and the one loop of the program.

use crate::drivers::absent::Absent;
use crate::drivers::error::{DriverError, DriverFault, MOST_ANSWERS, WALL_M};
use crate::drivers::input::Input;
use crate::drivers::live::{KeyTrack, LiveDriver};
use crate::drivers::path::PathDriver;
use crate::drivers::{Driver, Next, Occupant, Surroundings};
use crate::event::{Events, Fact, ThingUse};
use crate::home::Home;
use crate::ids::{ResidentId, RoomId, SensorId, ThingId};
use crate::intervention::{Intervention, TimedIntervention};
use crate::link::{self, Link};
use crate::motion::{MotionSegment, MotionState};
use crate::outside::{OutsideMessage, Refusal, ResolvedIntervention};
use crate::plan::Plan;
use crate::plan::sun::Sun;
use crate::resident::Build;
use crate::scenario::load::{self, Scenario};
use crate::scene::{Presence, Scene};
use crate::sensor_set::SensorSet;
use crate::sensors::Sensor;
use crate::stride::Stride;
use crate::time::{HOUR, Interval, RunTime, Span};
use crate::world::World;
use std::borrow::Cow;
use std::collections::VecDeque;
use std::sync::Arc;

/// A run of a scenario. A clone continues exactly as the original.
#[derive(Clone, Debug)]
pub struct Run {
    world: World,
    names: Vec<String>,
    /// By resident: the driver, the movement of the body, and the truth about its place.
    drivers: Vec<Box<dyn Driver>>,
    occupants: Vec<Occupant>,
    truths: Vec<TruthSoFar>,
    /// By thing of the plan: the residents who have turned it on, or opened it.
    users: Vec<Vec<ResidentId>>,
    /// By thing of the plan: whether it is on, or open, and whether an intervention did that.
    on: Vec<bool>,
    by_outside: Vec<bool>,
    /// `None` if all messages of sensors reach the logger at once.
    link: Option<Box<Link>>,
    length: Span,
    seed: u64,
    /// The interventions that are still to come, in order of time.
    outside: VecDeque<TimedIntervention>,
    failure: Option<DriverError>,
}

#[derive(Clone, Debug, Default)]
struct TruthSoFar {
    room: Option<RoomId>,
    /// Whether any room was reported yet.
    located: bool,
    /// The start of the present movement, which is reported at its end. All before it is reported.
    since: RunTime,
}

/// A source of drivers that this crate does not have.
pub trait DriverProvider {
    /// The guests: bodies that come into the home in addition to the scenario's residents.
    fn guests(&self) -> Vec<Guest>;

    /// The driver of a body: the scenario's residents first, then the guests. `None` where the scenario says all; one that
    /// is given moves the body whatever the scenario says.
    fn driver(&self, body: usize, home: &Arc<Home>, seed: u64) -> Option<Box<dyn Driver>>;
}

/// A scenario of paths and keys needs no other drivers.
impl DriverProvider for () {
    fn guests(&self) -> Vec<Guest> {
        Vec::new()
    }

    fn driver(&self, _body: usize, _home: &Arc<Home>, _seed: u64) -> Option<Box<dyn Driver>> {
        None
    }
}

/// A visitor.
#[derive(Clone, Debug, PartialEq)]
pub struct Guest {
    /// The name in the truth, such as `margaret's daughter`.
    pub name: String,
    /// The build of their body.
    pub build: Build,
}

fn builds(scenario: &Scenario, guests: &[Guest]) -> Vec<Build> {
    let residents = scenario.residents.iter().map(|resident| Build::new(&resident.file));
    residents.chain(guests.iter().map(|guest| guest.build)).collect()
}

impl Run {
    /// A run of a scenario from its start, `length` long.
    pub fn new(scenario: &Scenario, drivers_of: &dyn DriverProvider, seed: u64, length: Span) -> Run {
        let home = Arc::new(Run::home_of(scenario, &drivers_of.guests()));
        Run::in_home(home, scenario, drivers_of, seed, length)
    }

    /// The home of a scenario's runs, baked for all residents and visitors. It does not depend on the seed.
    pub fn home_of(scenario: &Scenario, guests: &[Guest]) -> Home {
        let places = scenario.link.as_ref().map(|link| link::other_places(link, &scenario.home.sensors));
        let moved = places.map_or(Cow::Borrowed(&scenario.home), |more| Cow::Owned(scenario.home.with_sensors(more)));
        let mut home = Home::bake(&moved, &builds(scenario, guests));
        home.sun = Sun::new(&scenario.calendar, scenario.home.latitude_deg);
        home
    }

    /// As [`Run::new`], in a home that was baked before by [`Run::home_of`]: many runs of a scenario share one.
    pub fn in_home(
        home: Arc<Home>,
        scenario: &Scenario,
        drivers_of: &dyn DriverProvider,
        seed: u64,
        length: Span,
    ) -> Run {
        let guests = drivers_of.guests();
        let builds = builds(scenario, &guests);
        let start_of_day = scenario.calendar.start_of_day();
        let link = scenario
            .link
            .as_ref()
            .map(|file| Link::new(file, &scenario.home.sensors, scenario.home.numbers(), start_of_day, seed));
        let drivers = (0..builds.len()).map(|body| {
            let given = drivers_of.driver(body, &home, seed);
            let resident = scenario.residents.get(body);
            let own = || resident.and_then(|resident| driver(resident, &home.plan, start_of_day));
            given.or_else(own).unwrap_or_else(|| Box::new(Absent))
        });
        let drivers = drivers.collect();
        let mut run = Run { link: link.map(Box::new), ..Run::from_drivers(home, builds, drivers, seed, length) };
        let names = scenario.residents.iter().map(|resident| resident.file.name.clone());
        run.names = names.chain(guests.into_iter().map(|guest| guest.name)).collect();
        run
    }

    /// A run of any drivers in a baked home.
    pub fn from_drivers(
        home: Arc<Home>,
        builds: Vec<Build>,
        drivers: Vec<Box<dyn Driver>>,
        seed: u64,
        length: Span,
    ) -> Run {
        let users = vec![Vec::new(); home.plan.things.len()];
        let on: Vec<bool> = home.plan.things.iter().map(|thing| thing.on).collect();
        let by_outside = vec![false; on.len()];
        let world = World::new(home, drivers.len(), seed);
        let names = (1..=drivers.len()).map(|number| format!("resident {number}")).collect();
        Run {
            world,
            names,
            occupants: builds.into_iter().map(Occupant::new).collect(),
            truths: vec![TruthSoFar::default(); drivers.len()],
            drivers,
            users,
            on,
            by_outside,
            link: None,
            length,
            seed,
            outside: VecDeque::new(),
            failure: None,
        }
    }

    /// The home that the run happens in.
    pub fn home(&self) -> &Home {
        self.world.home()
    }

    /// The names of the scenario's residents, then of those who come to visit.
    pub fn names(&self) -> Vec<String> {
        self.names.clone()
    }

    /// The sensors that the logger knows, in the order in which firings count them. The home has more if a sensor is
    /// moved during the run.
    pub fn sensors(&self) -> &[Sensor] {
        let sensors = &self.home().sensors;
        &sensors[..self.link.as_ref().map_or(sensors.len(), |link| link.sensors())]
    }

    /// The instant that the run has reached.
    pub fn now(&self) -> RunTime {
        self.world.now()
    }

    /// The time before which all firings are final: the present instant, unless a sensor's clock is behind.
    pub fn settled(&self) -> RunTime {
        self.link.as_ref().map_or(self.now(), |link| link.settled(self.now()))
    }

    /// The whole length.
    pub fn length(&self) -> Span {
        self.length
    }

    fn end(&self) -> RunTime {
        RunTime::START + self.length
    }

    /// The driver of a resident.
    pub fn driver(&self, resident: ResidentId) -> Option<&dyn Driver> {
        self.drivers.get(resident.index()).map(Box::as_ref)
    }

    /// The state of the run now.
    pub fn scene(&self) -> Scene {
        let body = |resident: ResidentId| {
            Some(Presence {
                at: self.world.position(resident)?,
                heading: self.world.heading(resident),
                posture: self.world.posture(resident),
                room: self.truths[resident.index()].room,
            })
        };
        let all = (0..self.drivers.len()).map(ResidentId::new);
        let mut awake = SensorSet::default();
        let sensors = (0..self.sensors().len()).map(SensorId::new);
        sensors.filter(|&sensor| self.world.is_awake(sensor)).for_each(|sensor| awake.insert(sensor));
        Scene {
            now: self.now(),
            bodies: all.clone().map(body).collect(),
            seeing: all.fold(SensorSet::default(), |seeing, resident| seeing | self.world.seeing(resident)),
            on: (0..self.on.len()).filter(|&thing| self.on[thing]).map(ThingId::new).collect(),
            awake,
        }
    }

    /// From now on the input of a resident comes from the caller, after the input in its file. False if its driver
    /// takes none.
    pub fn open_input(&mut self, resident: ResidentId) -> bool {
        self.drivers.get_mut(resident.index()).is_some_and(|driver| driver.open_input())
    }

    /// From now on the input of a resident whose input is open is this.
    pub fn input(&mut self, resident: ResidentId, input: Input) {
        let now = self.now();
        if let Some(driver) = self.drivers.get_mut(resident.index()) {
            driver.input(now, input);
        }
    }

    /// From now on this is done to the run from outside as well, each at its instant; what is past is done now.
    pub fn intervene(&mut self, done: impl IntoIterator<Item = TimedIntervention>) {
        self.outside.extend(done);
        // At one instant, the order of the requests holds.
        self.outside.make_contiguous().sort_by_key(|one| one.at_us);
    }

    /// Lives until `until` or the end of the run, whichever is first, and adds to `events` what happens
    /// before then. In how many steps a run is advanced changes nothing.
    ///
    /// # Errors
    ///
    /// If a driver answers with what no body can do. The run has come to the instant at which it was asked, `events` has what
    /// happened before, and the run goes no further: it gives the same error from then on.
    pub fn advance(&mut self, until: RunTime, events: &mut Events) -> Result<(), DriverError> {
        self.advance_within(until, usize::MAX, events)
    }

    /// As [`Run::advance`], but goes no further once `events` has `most` firings and facts or more, so that a resident who does
    /// a million things a second needs time and not memory. [`Run::now`] says how far it has come.
    ///
    /// # Errors
    ///
    /// As [`Run::advance`].
    pub fn advance_within(&mut self, until: RunTime, most: usize, events: &mut Events) -> Result<(), DriverError> {
        let until = until.min(self.end());
        let mut link = self.link.take();
        let mut said = Events::default();
        while self.now() < until && self.failure.is_none() && events.len() < most {
            while self.outside.front().is_some_and(|first| first.at_us <= self.now()) {
                self.apply_intervention(&mut link, events);
            }
            self.failure = self.begin_due(events).err();
            if self.failure.is_some() {
                break;
            }
            match &mut link {
                None => self.advance_world(until, events),
                Some(link) => {
                    self.advance_world(until, &mut said);
                    // Pictures have a wire of their own.
                    events.frames.append(&mut said.frames);
                    link.carry(&mut said, self.now(), events);
                }
            }
        }
        self.link = link;
        if self.now() >= self.end() || self.failure.is_some() {
            events.facts.extend(self.under_way());
            let now = self.now();
            self.truths.iter_mut().for_each(|truth| truth.since = now);
        }
        self.failure.clone().map_or(Ok(()), Err)
    }

    /// The movement of each resident that is not reported yet, up to now. At the end of the run there is none; this is
    /// for callers that stop a run before its end.
    pub fn under_way(&self) -> impl Iterator<Item = Fact> {
        (0..self.drivers.len()).map(ResidentId::new).filter_map(|resident| self.movement(resident))
    }

    fn movement(&self, resident: ResidentId) -> Option<Fact> {
        let begin = self.truths[resident.index()].since;
        let MotionSegment { end, doing, posture, .. } = self.occupants[resident.index()].segment.until(self.now());
        (begin < end).then_some(Fact::Movement { resident, begin, end, doing, posture })
    }

    /// Why the run goes no further, if it is for a driver's answer.
    pub fn failure(&self) -> Option<&DriverError> {
        self.failure.as_ref()
    }

    /// Asks the drivers of all residents whose move is over.
    fn begin_due(&mut self, events: &mut Events) -> Result<(), DriverError> {
        for resident in (0..self.drivers.len()).map(ResidentId::new) {
            if self.occupants[resident.index()].segment.end <= self.now() {
                self.begin_next(resident, events).map_err(|fault| DriverError {
                    resident: self.names[resident.index()].clone(),
                    at: self.now(),
                    fault,
                })?;
            }
        }
        Ok(())
    }

    /// Advances the world until a resident's move is over, or to `until`.
    fn advance_world(&mut self, until: RunTime, events: &mut Events) {
        let next = self.occupants.iter().map(|occupant| occupant.segment.end).min();
        let done = self.outside.front().map_or(until, |first| first.at_us);
        self.world.advance(until.min(next.unwrap_or(until)).min(done), events);
    }

    /// Runs from the beginning and returns the movements of each resident, for callers with another kernel.
    ///
    /// # Errors
    ///
    /// As [`Run::advance`].
    pub fn moves(&self) -> Result<Vec<Vec<MotionSegment>>, DriverError> {
        let mut run = Run { link: None, outside: VecDeque::new(), ..self.clone() };
        let mut moves = vec![Vec::new(); run.drivers.len()];
        let mut events = Events::default();
        while run.now() < run.end() {
            run.advance(run.now() + HOUR, &mut events)?;
            for fact in events.facts.drain(..) {
                if let Fact::Movement { resident, begin, end, doing, posture } = fact {
                    moves[resident.index()].push(MotionSegment { begin, end, doing, posture });
                }
            }
            events.clear();
        }
        Ok(moves)
    }

    /// Asks the resident's driver for the next move, and gives it to the world.
    fn begin_next(&mut self, resident: ResidentId, events: &mut Events) -> Result<(), DriverFault> {
        let now = self.world.now();
        let things = self.on.len();
        let here = self.occupants[resident.index()].segment.to();
        let mut answers = 0;
        let next = loop {
            let around = Surroundings::new(now, resident, &self.world.home().plan, &self.occupants, &self.on);
            let answer = self.drivers[resident.index()].next(&around);
            DriverFault::in_answer(&answer, now, here, things).map_or(Ok(()), Err)?;
            match answer {
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
                Next::Failed(why) => return Err(DriverFault::Failed { why }),
            }
            answers += 1;
            if answers == MOST_ANSWERS {
                return Err(DriverFault::NoEnd { answers });
            }
        };
        let rooms = self.rooms_of(resident, &next)?;
        // A rest that is reported several times in a row is one movement.
        if !next.continues(&self.occupants[resident.index()].segment) {
            events.facts.extend(self.movement(resident));
            self.truths[resident.index()].since = now;
        }
        self.tell_rooms(resident, rooms, events);
        self.world.begin(resident, &next);
        self.occupants[resident.index()].segment = next;
        Ok(())
    }

    /// Whether this can be done from outside now.
    ///
    /// # Errors
    ///
    /// A refusal: the home has no such thing, sensor or resident; it is in this state already; or the resident is out
    /// or has a driver that cannot fall.
    pub fn check_intervention(&self, intervention: &Intervention) -> Result<(), Refusal> {
        match self.known(self.now(), intervention)? {
            ResolvedIntervention::Use { thing, on } if self.state_after_interventions(thing) == on => {
                let state = if on { "open or on" } else { "closed or off" };
                Err(OutsideMessage::AlreadySo { state }.into())
            }
            ResolvedIntervention::Fall { resident, lies } => self.can_fall(resident, lies),
            _ => Ok(()),
        }
    }

    fn known(&self, at: RunTime, intervention: &Intervention) -> Result<ResolvedIntervention, OutsideMessage> {
        let sensors: Vec<&str> = self.sensors().iter().map(|sensor| sensor.name.as_str()).collect();
        let names = self.names();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        ResolvedIntervention::new(intervention, at, &self.home().plan, &sensors, &names)
    }

    fn can_fall(&self, resident: ResidentId, lies: Span) -> Result<(), Refusal> {
        let around = self.surroundings(resident);
        if around.body().is_none() {
            return Err(OutsideMessage::NotAtHome.into());
        }
        // Whether a driver can is known once it has.
        match self.driver(resident).is_some_and(|driver| driver.copy().falls(&around, lies)) {
            true => Ok(()),
            false => Err(OutsideMessage::CannotFall.into()),
        }
    }

    fn surroundings(&self, resident: ResidentId) -> Surroundings<'_> {
        Surroundings::new(self.now(), resident, &self.home().plan, &self.occupants, &self.on)
    }

    fn state_after_interventions(&self, thing: ThingId) -> bool {
        let name = &self.home().plan.things[thing.index()].name;
        let said = self.outside.iter().rev().find_map(|one| match &one.intervention {
            Intervention::Use { thing, on } if thing == name => Some(*on),
            _ => None,
        });
        said.unwrap_or(self.on[thing.index()])
    }

    /// Applies the next intervention. Unknown names were refused before.
    fn apply_intervention(&mut self, link: &mut Option<Box<Link>>, events: &mut Events) {
        let Some(TimedIntervention { intervention, .. }) = self.outside.pop_front() else { return };
        let now = self.now();
        let Ok(known) = self.known(now, &intervention) else { return };
        events.facts.push(Fact::Outside { at: now, intervention });
        match known {
            ResolvedIntervention::Use { thing, on } => {
                // No resident has it in use.
                self.users[thing.index()].clear();
                self.by_outside[thing.index()] = true;
                if self.on[thing.index()] != on {
                    let act = ThingUse { thing, on };
                    self.on[thing.index()] = on;
                    events.facts.push(Fact::Use { resident: None, at: now, act });
                    self.world.act(None, act);
                }
            }
            ResolvedIntervention::Fail { sensor, failure, until } => {
                let link = link.get_or_insert_with(|| Box::new(self.perfect_link()));
                let name = &self.world.home().sensors[sensor.index()].name;
                let span = Interval::new(now, until.unwrap_or(RunTime::NEVER));
                link.fails(sensor, failure, span, name, self.seed);
            }
            ResolvedIntervention::Fall { resident, lies } => self.fall(resident, lies, events),
        }
    }

    /// A link without faults, for a run that had none until now.
    fn perfect_link(&self) -> Link {
        let home = self.world.home();
        let sensors = home.sensors.iter().map(|sensor| (sensor.name.as_str(), sensor.senses_motion()));
        Link::perfect(sensors, &home.numbers, self.seed, self.world.message_count())
    }

    /// A resident falls on the spot, which ends the present movement.
    fn fall(&mut self, resident: ResidentId, lies: Span, events: &mut Events) {
        let now = self.now();
        let cut = self.occupants[resident.index()].segment.until(now);
        let here = cut.to();
        self.occupants[resident.index()].segment = cut;
        let around = Surroundings::new(now, resident, &self.world.home().plan, &self.occupants, &self.on);
        self.drivers[resident.index()].falls(&around, lies);
        // They are not going to come through the rooms that were still before them.
        if let Some(here) = here {
            let room = self.home().plan.room_at(here);
            self.tell_rooms(resident, vec![(now, room)], events);
        }
    }

    /// A resident uses a thing. A thing that several have turned on goes off with the last of them; a thing that a
    /// resident has left on, any resident turns off.
    fn act(&mut self, resident: ResidentId, act: ThingUse, now: RunTime, events: &mut Events) {
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
        // An intervention is not repeated by a resident.
        let is_done = self.by_outside[act.thing.index()] && self.on[act.thing.index()] == act.on;
        if changes && !is_done {
            self.by_outside[act.thing.index()] = false;
            self.on[act.thing.index()] = act.on;
            events.facts.push(Fact::Use { resident: Some(resident), at: now, act });
            self.world.act(Some(resident), act);
        }
    }

    /// The rooms along a resident's movement, each with its instant; without those that are the same as before.
    fn rooms_of(
        &self,
        resident: ResidentId,
        next: &MotionSegment,
    ) -> Result<Vec<(RunTime, Option<usize>)>, DriverFault> {
        let plan = &self.home().plan;
        let before = self.occupants[resident.index()].segment.to();
        // Mostly the room stays the same, which needs no search.
        match next.doing {
            MotionState::InPlace { at, .. } | MotionState::Rest { at } if before == Some(at) => return Ok(Vec::new()),
            MotionState::Stride { from, to } if before == Some(from) => {
                let here = self.truths[resident.index()].room.map(|room| &plan.rooms[room.index()]);
                if here.is_some_and(|room| room.surely_holds(from, to)) {
                    return Ok(Vec::new());
                }
            }
            _ => {}
        }
        let rooms = match next.doing {
            MotionState::Stride { from, to } => plan.rooms_along(&Stride::new(from, to, next.begin, next.end)),
            MotionState::InPlace { at, .. } | MotionState::Rest { at } => vec![(next.begin, plan.room_at(at))],
            MotionState::Away => vec![(next.begin, None)],
        };
        let ends_in_none = rooms.last().is_none_or(|(_, room)| room.is_none());
        match next.to().filter(|&at| ends_in_none && plan.distance_outside(at) > WALL_M) {
            Some(at) => Err(DriverFault::Outside { at }),
            None => Ok(rooms),
        }
    }

    /// Reports the rooms along a resident's movement.
    fn tell_rooms(&mut self, resident: ResidentId, rooms: Vec<(RunTime, Option<usize>)>, events: &mut Events) {
        let end = self.end();
        let TruthSoFar { room, located, .. } = &mut self.truths[resident.index()];
        for (at, new) in rooms.into_iter().filter(|&(at, _)| at < end) {
            let new = new.map(RoomId::new);
            if !*located || *room != new {
                (*located, *room) = (true, new);
                events.facts.push(Fact::Room { resident, at, room: new });
            }
        }
    }
}

fn driver(resident: &load::Resident, plan: &Plan, start_of_day: Span) -> Option<Box<dyn Driver>> {
    let load::Resident { file, driver } = resident;
    match driver {
        load::ResidentDriver::Path(path) => Some(Box::new(PathDriver::new(path, start_of_day))),
        load::ResidentDriver::Live { input, start } => {
            let keys = KeyTrack::written(input, plan);
            Some(Box::new(LiveDriver::new(plan, *start, file.radius_m, file.pace_mps, keys)))
        }
        load::ResidentDriver::Routine { .. } | load::ResidentDriver::Script { .. } => None,
    }
}
