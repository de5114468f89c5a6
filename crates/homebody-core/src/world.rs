//! The world: bodies move, fields see them, machines fire.
//!
//! One slice of time after another: within a slice every moving body stays in one cell of its
//! field, so masks hold the sensors that surely see it; for the others, the instant of touching is
//! computed. Sensors do not know of each other, so within a slice each runs by itself, and only the
//! timers bring their firings into order.
//!
//! Times are compared as whole microseconds, never as floats. A slice is half-open: what happens at
//! its end belongs to the next. At one instant, touches and changes come before timers.

use crate::body::figure::Stature;
use crate::event::{Events, Fact, Firing, Frame, Provenance, ThingUse, Trigger, Value, Vitals};
use crate::geometry::Point;
use crate::home::Home;
use crate::home::field::{Field, FieldCell};
use crate::ids::{ResidentId, SensorId};
use crate::motion::{MotionSegment, MotionState};
use crate::posture::Posture;
use crate::random::{Marks, Stream};
use crate::resident::BodySize;
use crate::sensor_set::{BLOCK, BLOCKS, Mask, SensorSet, bit, bits, blocks};
use crate::sensors::Sensor;
use crate::sensors::kinds::{SensorDevice, SensorKind};
use crate::sensors::looking::{DetectionLevel, LookingModel};
use crate::sensors::motion::Motion;
use crate::sensors::notice::{Glance, NoticeChance};
use crate::sensors::outbox::{Change, DeviceModel, Outbox};
use crate::sensors::timing::{Machine, Sighting, TimerOutcome};
use crate::sensors::zones::Pulses;
use crate::stride::Stride;
use crate::time::{RunTime, Span};
use crate::timers::Timers;
use std::ops::RangeInclusive;
use std::sync::Arc;

/// The bodies and the sensors of a home at an instant.
#[derive(Clone, Debug)]
pub struct World {
    home: Arc<Home>,
    now: RunTime,
    bodies: Vec<TrackedBody>,
    machines: Vec<Machine>,
    /// The devices by sensor, with their messages of this instant that are not sent yet; `None` for sensors that look
    /// for movement.
    devices: Vec<Option<(SensorDevice, Outbox)>>,
    /// The numbers of the devices, and of those devices that react to movements of bodies.
    reacting: Vec<usize>,
    feeling: Vec<usize>,
    /// The devices that see bodies of any weight; and by sensor, those that it wakes.
    watching: Vec<usize>,
    wakes: Vec<Vec<usize>>,
    blocks: usize,
    want: [Mask; BLOCKS],
    timers: Timers,
    /// By sensor: whether it takes any change in a beam for movement.
    plain: Vec<bool>,
    /// By sensor: its looks, if it does not notice all.
    looks: Vec<Option<(NoticeChance, Marks)>>,
    pulses: Vec<Pulses>,
    seq: u64,
    chances: Marks,
    /// Bodies of a smaller radius are not felt.
    light_m: f64,
    /// By block: the bodies that move in the present slice, and the sensors that may see one of them.
    movers: [Vec<Mover>; BLOCKS],
    may: [Mask; BLOCKS],
}

crate::numbers! {
    /// Radius below which a body is too light for bed sensors and mats: that of a cat is 0.1 m.
    static LIGHT_M = "body.light": 0.15, "m", [0.0, 0.3];
}

#[derive(Clone, Debug)]
struct TrackedBody {
    posture: Posture,
    motion: BodyMotion,
    heading: Point,
}

#[derive(Clone, Copy, Debug)]
enum Listeners {
    All,
    Feeling,
    Watching,
}

#[derive(Clone, Copy, Debug)]
enum BodyMotion {
    Stride(Stride),
    InPlace { at: Point, amplitude_m: f64 },
    Rest { at: Point },
    Away,
}

/// A body that moves in the present slice, and the entry of a block for its cell.
#[derive(Clone, Copy, Debug)]
struct Mover {
    body: u32,
    cell: FieldCell,
}

impl World {
    /// A world at the start of a run, without bodies until [`World::begin`] gives the movement of each resident.
    pub fn new(home: Arc<Home>, residents: usize, seed: u64) -> World {
        let machine = |sensor: &Sensor| {
            Machine::new(sensor.timing, Stream::named(seed, &format!("sensor/{}/timing", sensor.name)))
        };
        let machines: Vec<Machine> = home.sensors.iter().map(machine).collect();
        let mut want = [0; BLOCKS];
        for sensor in (0..machines.len()).filter(|&sensor| home.sensors[sensor].senses_motion()) {
            want[sensor / BLOCK] |= bit(sensor);
        }
        let device = |sensor: &Sensor| {
            let SensorKind::Device(device) = &sensor.kind else { return None };
            let stream = Stream::named(seed, &format!("sensor/{}/device", sensor.name));
            Some((device.begin(stream, home.sun, &home.numbers), Outbox::default()))
        };
        let devices: Vec<Option<(SensorDevice, Outbox)>> = home.sensors.iter().map(device).collect();
        let mut timers = Timers::new(machines.len());
        let (mut reacting, mut feeling, mut watching) = (Vec::new(), Vec::new(), Vec::new());
        let mut wakes = vec![Vec::new(); devices.len()];
        for (sensor, device) in devices.iter().enumerate() {
            let Some((device, _)) = device else { continue };
            timers.set(sensor, device.timer());
            reacting.push(sensor);
            feeling.extend(device.feels_bodies().then_some(sensor));
            watching.extend(device.sees_bodies().then_some(sensor));
            // A sensor that is moved has several places, all of its name.
            for (waker, _) in home.sensors.iter().enumerate().filter(|(_, of)| device.woken_by().contains(&of.name)) {
                wakes[waker].push(sensor);
            }
        }
        let levels: Vec<Option<DetectionLevel>> =
            home.sensors.iter().map(|sensor| Some(sensor.kind.looking()?.level())).collect();
        let looks =
            |sensor: &Sensor| Some((sensor.chance?, Marks::named(seed, &format!("sensor/{}/notice", sensor.name))));
        let zoned = (0..levels.len()).filter(|&sensor| matches!(levels[sensor], Some(DetectionLevel::Zones { .. })));
        World {
            now: RunTime::START,
            bodies: vec![
                TrackedBody { posture: Posture::Standing, motion: BodyMotion::Away, heading: Point::X };
                residents
            ],
            blocks: blocks(machines.len()),
            want,
            timers,
            devices,
            reacting,
            feeling,
            watching,
            wakes,
            plain: levels.iter().map(|level| matches!(level, Some(DetectionLevel::Paper))).collect(),
            looks: home.sensors.iter().map(looks).collect(),
            pulses: zoned.map(|sensor| Pulses::new(sensor, residents)).collect(),
            seq: 0,
            chances: Marks::named(seed, "bodies"),
            light_m: home.numbers.of(&LIGHT_M),
            movers: Default::default(),
            may: [0; BLOCKS],
            machines,
            home,
        }
    }

    /// The instant up to which all has happened.
    pub fn now(&self) -> RunTime {
        self.now
    }

    /// The home that everything happens in.
    pub fn home(&self) -> &Home {
        &self.home
    }

    /// From now until the move's end, the resident does this; the move may have begun before now. The
    /// caller advances no further than its end before it says what comes next.
    pub fn begin(&mut self, resident: ResidentId, next: &MotionSegment) {
        let MotionSegment { begin, end, doing, posture } = *next;
        let motion = match doing {
            MotionState::Stride { from, to } => BodyMotion::Stride(Stride::new(from, to, begin, end)),
            MotionState::InPlace { at, amplitude_m } => BodyMotion::InPlace { at, amplitude_m },
            MotionState::Rest { at } => BodyMotion::Rest { at },
            MotionState::Away => BodyMotion::Away,
        };
        let TrackedBody { posture: before, motion: last, mut heading } = self.bodies[resident.index()];
        if let BodyMotion::Stride(stride) = motion {
            heading = (stride.to - stride.from).try_normalize().unwrap_or(heading);
        }
        let settles = before != posture || matches!(last, BodyMotion::Away);
        self.bodies[resident.index()] = TrackedBody { posture, motion, heading };
        if settles && !self.pulses.is_empty() {
            self.settle(resident);
        }
        let BodySize { radius_m, top_m } = self.home.field(resident.index(), Posture::Standing).size;
        let stature = Stature { radius_m, height_m: top_m };
        let chance = self.chances.of(begin.micros() as u64 ^ (u64::from(resident.0) << 56));
        let change = Change::Body { resident, stature, segment: next.clone(), chance };
        // A cat presses no mat, and lies next to the strip.
        if radius_m >= self.light_m {
            self.inform(&change, Listeners::Feeling);
        }
        self.inform(&change, Listeners::Watching);
    }

    /// A thing is used, now; by a resident unless it is from outside.
    pub fn act(&mut self, resident: Option<ResidentId>, act: ThingUse) {
        let ThingUse { thing, on } = act;
        self.inform(&Change::Use { resident, thing, on }, Listeners::All);
    }

    /// The number of messages that have left the sensors.
    pub fn message_count(&self) -> u64 {
        self.seq
    }

    /// From now on a resident's heart and lungs are like this.
    pub fn feel(&mut self, resident: ResidentId, vitals: Vitals) {
        self.inform(&Change::Vitals { resident, vitals }, Listeners::Feeling);
    }

    /// Informs devices of a change. Their messages of this instant leave in the order of the sensors.
    fn inform(&mut self, change: &Change, listeners: Listeners) {
        let listeners = match listeners {
            Listeners::All => &self.reacting,
            Listeners::Feeling => &self.feeling,
            Listeners::Watching => &self.watching,
        };
        for &sensor in listeners {
            let Some((device, outbox)) = &mut self.devices[sensor] else { continue };
            device.on_event(self.now, change, outbox);
            self.timers.set(sensor, if outbox.messages.is_empty() { device.timer() } else { self.now });
        }
    }

    fn send(&mut self, at: RunTime, sensor: usize, value: Value, provenance: Provenance, events: &mut Events) {
        events.firings.push(Firing { seq: self.seq, at, sensor: SensorId::new(sensor), value });
        events.facts.push(Fact::Provenance { seq: self.seq, provenance });
        self.seq += 1;
        for &woken in &self.wakes[sensor] {
            let Some((device, outbox)) = &mut self.devices[woken] else { continue };
            device.on_event(at, &Change::Fired, outbox);
            self.timers.set(woken, if outbox.messages.is_empty() { device.timer() } else { at });
        }
    }

    /// A body that changes its posture or appears touches other beams from one instant to the next. That is not a
    /// pulse.
    fn settle(&mut self, resident: ResidentId) {
        let field = self.home.field(resident.index(), self.bodies[resident.index()].posture);
        let at = self.position(resident);
        for pulses in &mut self.pulses {
            let beams = &field.beams[field.range(pulses.sensor)];
            match at {
                Some(at) => pulses.settle(resident.0, beams, at, field.size.radius_m),
                None => pulses.leave(resident.0),
            }
        }
    }

    /// The position of a resident; `None` while away.
    pub fn position(&self, resident: ResidentId) -> Option<Point> {
        match self.bodies[resident.index()].motion {
            BodyMotion::Stride(stride) => Some(stride.position(self.now)),
            BodyMotion::InPlace { at, .. } | BodyMotion::Rest { at } => Some(at),
            BodyMotion::Away => None,
        }
    }

    /// The direction of a resident's last stride, of length one.
    pub fn heading(&self, resident: ResidentId) -> Point {
        self.bodies[resident.index()].heading
    }

    /// Whether a camera is awake; no other sensor is.
    pub fn is_awake(&self, sensor: SensorId) -> bool {
        self.devices[sensor.index()].as_ref().is_some_and(|(device, _)| device.is_awake())
    }

    /// The sensors with this resident's movement in their field.
    pub fn seeing(&self, resident: ResidentId) -> SensorSet {
        let TrackedBody { posture, motion, .. } = &self.bodies[resident.index()];
        let field = self.home.field(resident.index(), *posture);
        match motion {
            BodyMotion::Stride(stride) => field.seen_at(stride.position(self.now)),
            BodyMotion::InPlace { at, .. } => field.seen_at(*at),
            BodyMotion::Rest { .. } | BodyMotion::Away => SensorSet::default(),
        }
    }

    /// The present posture of a resident.
    pub fn posture(&self, resident: ResidentId) -> Posture {
        self.bodies[resident.index()].posture
    }

    /// Lets everything happen that happens before `until`.
    pub fn advance(&mut self, until: RunTime, events: &mut Events) {
        if self.blocks == 1 {
            self.advance_blocks::<true>(until, events)
        } else {
            self.advance_blocks::<false>(until, events)
        }
    }

    /// [`World::advance`], compiled for homes of `ONE` block of sensors, as most are, and for others.
    fn advance_blocks<const ONE: bool>(&mut self, until: RunTime, events: &mut Events) {
        while self.now < until {
            self.now = self.coast::<ONE>(until, events);
            if self.now < until {
                let end = self.next_slice::<ONE>(until);
                self.run_slice::<ONE>(end, events);
                self.now = end;
            }
        }
    }

    /// Lets timers run out until a body comes to a cell where a sensor that wants to know of movement may see it;
    /// returns that instant.
    fn coast<const ONE: bool>(&mut self, until: RunTime, events: &mut Events) -> RunTime {
        let mut unseen = until;
        for block in 0..self.blocks::<ONE>() {
            unseen = self.unseen_until(block, self.want[block], self.now, unseen);
        }
        while let (at, sensor) = self.timers.next()
            && at < unseen
        {
            self.ring(at, sensor, events);
            if self.devices[sensor].is_none() && self.machines[sensor].wants() {
                unseen = self.unseen_until(block_of::<ONE>(sensor), bit(sensor), at, unseen);
                // It decides unseen and at once, because no message depends on it.
                let machine = &mut self.machines[sensor];
                if machine.wants_until() < unseen {
                    machine.on_timer();
                }
            }
            self.note::<ONE>(sensor);
        }
        unseen
    }

    fn blocks<const ONE: bool>(&self) -> usize {
        if ONE { 1 } else { self.blocks }
    }

    /// The first instant from `now` on at which a body is in a cell where a sensor of `want`, all of one block, may see
    /// it move; `until` if no body is before then.
    fn unseen_until(&self, block: usize, want: Mask, now: RunTime, until: RunTime) -> RunTime {
        if !self.pulses.is_empty() {
            // They count what they saw before they woke, too.
            return now;
        }
        let mut until = until;
        for (body, TrackedBody { posture, motion, .. }) in self.bodies.iter().enumerate() {
            let field = self.home.field(body, *posture);
            match motion {
                BodyMotion::Stride(stride) => until = field.unseen_until(block, stride, want, now, until),
                BodyMotion::InPlace { at, .. } if field.cell(block, *at).may & want != 0 => until = now,
                BodyMotion::InPlace { .. } | BodyMotion::Rest { .. } | BodyMotion::Away => {}
            }
        }
        until
    }

    /// Finds the bodies that move in the slice that begins now, and returns the slice's end.
    fn next_slice<const ONE: bool>(&mut self, until: RunTime) -> RunTime {
        let blocks = self.blocks::<ONE>();
        self.movers[..blocks].iter_mut().for_each(Vec::clear);
        let mut end = until;
        for (body, TrackedBody { posture, motion, .. }) in self.bodies.iter().enumerate() {
            let (at, leaves) = match motion {
                BodyMotion::Stride(stride) => (stride.position(self.now), Some(stride)),
                BodyMotion::InPlace { at, .. } => (*at, None),
                BodyMotion::Rest { .. } | BodyMotion::Away => continue,
            };
            let field = self.home.field(body, *posture);
            if let Some(stride) = leaves {
                let after = Span::from_micros(field.leaves_cell(at, stride) as i64);
                end = end.min(self.now.saturating_add(after).saturating_add(Span::MICROSECOND));
            }
            for (block, movers) in self.movers[..blocks].iter_mut().enumerate() {
                movers.push(Mover { body: body as u32, cell: *field.cell(block, at) });
            }
        }
        end
    }

    /// Runs all events from now to `end`.
    fn run_slice<const ONE: bool>(&mut self, end: RunTime, events: &mut Events) {
        if !self.pulses.is_empty() {
            self.count_pulses(end);
        }
        for block in 0..self.blocks::<ONE>() {
            let may = self.movers[block].iter().fold(0, |mask, mover| mask | mover.cell.may);
            self.may[block] = may;
            for number in bits(self.want[block] & may) {
                self.look::<ONE>(block * BLOCK + number, self.now, end);
            }
        }
        while let (at, sensor) = self.timers.next()
            && at < end
        {
            self.ring(at, sensor, events);
            self.note::<ONE>(sensor);
            let block = block_of::<ONE>(sensor);
            if (self.want[block] & self.may[block]) >> (sensor % BLOCK) & 1 != 0 {
                self.look::<ONE>(sensor, at, end);
            }
        }
    }

    /// A sensor's timer runs out; what its machine wants then is for [`World::note`].
    fn ring(&mut self, at: RunTime, sensor: usize, events: &mut Events) {
        if let Some((device, outbox)) = &mut self.devices[sensor] {
            if device.timer() <= at {
                device.on_timer(at, outbox);
            }
            let Outbox { messages, pictures } = std::mem::take(outbox);
            let frame = |picture| Frame { at, sensor: SensorId::new(sensor), picture };
            events.frames.extend(pictures.into_iter().map(frame));
            for (value, provenance) in messages {
                self.send(at, sensor, value, provenance, events);
            }
        } else if let TimerOutcome::Fired(seen) = self.machines[sensor].on_timer() {
            let provenance = Provenance { resident: Some(seen.resident), seen_at: seen.at, trigger: Trigger::Movement };
            self.send(at, sensor, Value::Fire, provenance, events);
        }
    }

    /// Looks for the first movement from `from` on and before `end` that `sensor`'s machine wants to
    /// know of, and tells it.
    fn look<const ONE: bool>(&mut self, sensor: usize, from: RunTime, end: RunTime) {
        let last = (end - Span::MICROSECOND).min(self.machines[sensor].wants_until());
        let mut first: Option<Sighting> = None;
        for mover in &self.movers[block_of::<ONE>(sensor)] {
            if mover.cell.may >> (sensor % BLOCK) & 1 == 0 {
                continue;
            }
            let at = match &self.looks[sensor] {
                None => self.first_movement(mover, sensor, from),
                Some((chance, marks)) => self.first_notice(mover, sensor, chance, *marks, from..=last),
            };
            if let Some(at) = at.filter(|&at| at <= last && first.is_none_or(|first| at < first.at)) {
                first = Some(Sighting { resident: ResidentId(mover.body), at });
            }
        }
        if let Some(seen) = first {
            self.machines[sensor].sees(seen);
            self.note::<ONE>(sensor);
        }
    }

    /// Keeps the wish and the next timer of a machine.
    fn note<const ONE: bool>(&mut self, sensor: usize) {
        if let Some((device, _)) = &self.devices[sensor] {
            return self.timers.set(sensor, device.timer());
        }
        let machine = &self.machines[sensor];
        let want = &mut self.want[block_of::<ONE>(sensor)];
        *want = if machine.wants() { *want | bit(sensor) } else { *want & !bit(sensor) };
        self.timers.set(sensor, machine.timer());
    }

    /// The first instant from `from` on at which the sensor sees the mover move; the slice's end
    /// does not limit the answer.
    fn first_movement(&self, mover: &Mover, sensor: usize, from: RunTime) -> Option<RunTime> {
        let TrackedBody { posture, motion, .. } = &self.bodies[mover.body as usize];
        let field = self.home.field(mover.body as usize, *posture);
        if self.plain[sensor] {
            return first_touch(field, &mover.cell, sensor, motion, from);
        }
        let pir = self.home.sensors[sensor].kind.fan()?;
        match pir.level {
            DetectionLevel::Paper => None,
            DetectionLevel::Sensitivity { reach_per_m } => {
                let (near, far) = span_of_notice(pir, motion, reach_per_m)?.into_inner();
                let at = first_touch(field, &mover.cell, sensor, motion, from.max(near))?;
                (at <= far).then_some(at)
            }
            DetectionLevel::Zones { pitch_rad, .. } => match *motion {
                BodyMotion::InPlace { at, amplitude_m } if amplitude_m >= pitch_rad * at.distance(pir.lens) => {
                    first_touch(field, &mover.cell, sensor, motion, from)
                }
                BodyMotion::InPlace { .. } => None,
                _ => self.pulses_of(sensor).first_detection(mover.body, from),
            },
        }
    }

    /// The first look of a sensor in a span, which lies within the present slice, that notices the mover.
    fn first_notice(
        &self,
        mover: &Mover,
        sensor: usize,
        chance: &NoticeChance,
        marks: Marks,
        span: RangeInclusive<RunTime>,
    ) -> Option<RunTime> {
        let TrackedBody { posture, motion, .. } = &self.bodies[mover.body as usize];
        let field = self.home.field(mover.body as usize, *posture);
        let moved_m = match motion {
            BodyMotion::Stride(stride) => stride.speed_mps(),
            BodyMotion::InPlace { amplitude_m, .. } => *amplitude_m,
            BodyMotion::Rest { .. } | BodyMotion::Away => return None,
        };
        let looking = self.home.sensors[sensor].kind.looking()?;
        let level = looking.level();
        let chance_at = |at: Point| {
            let view = looking.view(at);
            let is_too_small =
                matches!(level, DetectionLevel::Sensitivity { reach_per_m } if moved_m * reach_per_m < view.distance_m);
            if is_too_small { 0.0 } else { chance.of(view, moved_m, field.size.radius_m) }
        };
        // A body that stays is equally likely to be noticed at each look.
        let (stays_at, likely) = match motion {
            BodyMotion::InPlace { at, .. } => (*at, chance_at(*at)),
            _ => (Point::ZERO, 1.0),
        };
        let notices = |look: &Glance| {
            if look.mark >= likely {
                return false;
            }
            let (at, likely) = match motion {
                BodyMotion::Stride(stride) => {
                    let at = stride.position(look.at);
                    (at, chance_at(at))
                }
                _ => (stays_at, likely),
            };
            look.mark < likely
                && (mover.cell.sure >> (sensor % BLOCK) & 1 != 0 || field.sees_in(&mover.cell, sensor, at))
                && !chance.misses(marks, mover.body, look.at)
        };
        chance.looks(marks, mover.body, span).find(notices).map(|look| look.at)
    }

    fn pulses_of(&self, sensor: usize) -> &Pulses {
        &self.pulses[self.pulses.partition_point(|pulses| pulses.sensor < sensor)]
    }

    fn count_pulses(&mut self, end: RunTime) {
        for pulses in &mut self.pulses {
            let sensor = pulses.sensor;
            let Some(pir) = self.home.sensors[sensor].kind.fan() else { continue };
            pulses.begin_slice();
            for (index, TrackedBody { posture, motion, .. }) in self.bodies.iter().enumerate() {
                let mover = self.movers[sensor / BLOCK].iter().find(|mover| mover.body as usize == index);
                let field = self.home.field(index, *posture);
                match motion {
                    BodyMotion::Stride(stride) if mover.is_some_and(|mover| mover.cell.may & bit(sensor) != 0) => {
                        let beams = &field.beams[field.range(sensor)];
                        pulses.walk(index as u32, stride, beams, pir, field.size.radius_m, self.now, end);
                    }
                    BodyMotion::Stride(_) | BodyMotion::Away => pulses.leave(index as u32),
                    BodyMotion::InPlace { .. } | BodyMotion::Rest { .. } => {}
                }
            }
            pulses.count(pir);
        }
    }
}

fn block_of<const ONE: bool>(sensor: usize) -> usize {
    if ONE { 0 } else { sensor / BLOCK }
}

/// The first instant from `from` on at which the body, which is in the cell, touches what the sensor sees.
fn first_touch(field: &Field, cell: &FieldCell, sensor: usize, motion: &BodyMotion, from: RunTime) -> Option<RunTime> {
    if cell.sure >> (sensor % BLOCK) & 1 != 0 {
        return Some(from);
    }
    match motion {
        BodyMotion::Stride(stride) if field.over_area(sensor, stride.position(from)) => Some(from),
        BodyMotion::Stride(stride) => {
            let beams = field.to_test(cell, sensor).iter();
            beams.filter_map(|beam| stride.first_touch(beam, field.size.radius_m, from)).min()
        }
        BodyMotion::InPlace { at, .. } => field.sees_in(cell, sensor, *at).then_some(from),
        BodyMotion::Rest { .. } | BodyMotion::Away => None,
    }
}

/// The instants, both included, between which the movement is large enough as seen from the lens.
fn span_of_notice(pir: &Motion, motion: &BodyMotion, reach_per_m: f64) -> Option<RangeInclusive<RunTime>> {
    match motion {
        BodyMotion::Stride(stride) => stride.span_within(pir.lens, stride.speed_mps() * reach_per_m),
        BodyMotion::InPlace { at, amplitude_m } => {
            (at.distance(pir.lens) <= amplitude_m * reach_per_m).then_some(RunTime::MIN..=RunTime::MAX)
        }
        BodyMotion::Rest { .. } | BodyMotion::Away => None,
    }
}
