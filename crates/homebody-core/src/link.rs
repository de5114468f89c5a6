//! The link: the way from the sensors to the logger, and the faults of both.
//!
//! A sensor sends its messages, or fails to: it misses a movement, its battery is empty, it is stuck or off its place.
//! A message crosses a radio channel on which others may send at the same time. It may get lost by chance, be damaged
//! or delayed, arrive twice, or meet a logger that is not running.
//!
//! We assume that each of these is independent of the others, and that what is lost stays lost.
//!
//! All happens in order of time: messages from the world, false firings of sensors, and the stages of messages under
//! way, which wait in a heap. The link knows all of an instant before any later one, so the number of steps of a run
//! makes no difference. A message that is still under way at the end of the run never arrives, and does not count as
//! lost.
//!
//! Left out: receipts, meshes and their routes, and what a network does to keep itself together.

mod clock;
pub mod form;
mod message;
pub(crate) mod radio;
mod sources;
mod channel;

use crate::event::{Events, Fact, Firing, Loss, Provenance, Trigger, Value};
use crate::ids::SensorId;
use crate::intervention::SensorFailure;
use crate::link::form::{FaultFile, LinkFile, MovedFile};
use crate::numbers::Numbers;
use crate::random::Stream;
use crate::sensors::kinds::SensorFile;
use crate::time::{Interval, RunTime, Span};
use channel::Channel;
use clock::SensorClocks;
use message::{LinkChance, MessageUnderWay, garbled_id, garbled_value};
use radio::Radio;
use sources::{Utterance, UtteranceSources};
use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

crate::numbers! {
    /// Share of the damaged messages with a damaged id. The others have a damaged value.
    static DAMAGED_IDS = "link.damaged_ids": 0.5, "1", [0.01, 0.99];
}

/// The way of all sensors' messages to the logger. A clone continues exactly as the original.
#[derive(Clone, Debug)]
pub struct Link {
    channels: Vec<Channel>,
    /// The sensors with other places, in the order of the sensors after those of the home.
    places: Vec<SensorId>,
    sources: UtteranceSources,
    radio: Option<Radio>,
    clocks: SensorClocks,
    outages: Vec<Interval<RunTime>>,
    /// The share of damaged messages with a wrong id.
    damaged_ids: f64,
    under_way: BinaryHeap<Reverse<Due>>,
    /// Tells messages apart that are due at one instant.
    order: u64,
    seq: u64,
}

#[derive(Clone, Debug)]
struct Due {
    at: RunTime,
    stage: MessageStage,
    order: u64,
    message: MessageUnderWay,
}

#[derive(Clone, Copy, Debug)]
enum MessageStage {
    /// A copy of it has been on the air.
    Sent {
        begin: RunTime,
        copy: u32,
    },
    Arrives,
    /// No firing can come any more that belongs before it.
    Settled {
        stamp: RunTime,
    },
}

/// The places to which the link's file moves sensors, each as a sensor of its own for the baking of the home.
pub fn other_places(file: &LinkFile, sensors: &[SensorFile]) -> Vec<SensorFile> {
    moves(file).filter_map(|moved| moved_sensor(moved, sensors)).collect()
}

/// The sensor as it hangs once it has been moved; nothing for sensors that cannot be.
pub fn moved_sensor(moved: &MovedFile, sensors: &[SensorFile]) -> Option<SensorFile> {
    let mut sensor = sensors.iter().find(|sensor| sensor.name() == moved.sensor)?.clone();
    sensor.relocate(moved.at, moved.facing_deg).then_some(sensor)
}

fn moves(file: &LinkFile) -> impl Iterator<Item = &MovedFile> {
    file.faults.iter().filter_map(|fault| match fault {
        FaultFile::Moved(moved) => Some(moved),
        _ => None,
    })
}

impl Link {
    /// The link of a home's sensors, as a file that has passed its checks describes it. In the world, the sensors of the
    /// home come first, then their other places.
    pub fn new(file: &LinkFile, sensors: &[SensorFile], numbers: &Numbers, start_of_day: Span, seed: u64) -> Link {
        let channel = |sensor: &SensorFile| Channel::new(file, sensor.name(), sensor.senses_motion(), seed);
        let mut channels: Vec<Channel> = sensors.iter().map(channel).collect();
        let mut places = Vec::new();
        for moved in moves(file).filter(|moved| moved_sensor(moved, sensors).is_some()) {
            let Some(owner) = sensors.iter().position(|sensor| sensor.name() == moved.sensor) else { continue };
            channels[owner].moves(RunTime::from_days(moved.from_day), SensorId::new(sensors.len() + places.len()));
            places.push(SensorId::new(owner));
        }
        let rate = |sensor: &SensorFile| file.rates(sensor.name(), sensor.senses_motion()).false_fires_per_h;
        let rates: Vec<(&str, f64)> = sensors.iter().map(|sensor| (sensor.name(), rate(sensor))).collect();
        let radio = file.channel().map(|file| Radio::new(&file, numbers));
        let on_air = radio.as_ref().map_or(Span::ZERO, Radio::longest);
        let slowest = channels.iter().map(|channel| channel.delay.most).max().unwrap_or(Span::ZERO);
        let outage = |fault: &FaultFile| match fault {
            FaultFile::Outage(_) => Some(fault.span_from(start_of_day)),
            _ => None,
        };
        Link {
            sources: UtteranceSources::new(file, &rates, start_of_day, seed),
            radio,
            clocks: SensorClocks {
                clocks: channels.iter().filter_map(|channel| channel.clock).collect(),
                // The second of two comes once more so late.
                longest: on_air + 2 * slowest,
            },
            outages: file.faults.iter().filter_map(outage).collect(),
            damaged_ids: numbers.of(&DAMAGED_IDS),
            under_way: BinaryHeap::new(),
            order: 0,
            seq: 0,
            channels,
            places,
        }
    }

    /// A link without losses, for sensors with these names that look for movement or do not. `sent` messages came
    /// before.
    pub(crate) fn perfect<'n>(
        sensors: impl Iterator<Item = (&'n str, bool)>,
        numbers: &Numbers,
        seed: u64,
        sent: u64,
    ) -> Link {
        let file = LinkFile::default();
        let sensors: Vec<(&str, bool)> = sensors.collect();
        Link {
            channels: sensors.iter().map(|&(name, looks)| Channel::new(&file, name, looks, seed)).collect(),
            places: Vec::new(),
            sources: UtteranceSources::new(&file, &[], Span::ZERO, seed),
            radio: None,
            clocks: SensorClocks { clocks: Vec::new(), longest: Span::ZERO },
            outages: Vec::new(),
            damaged_ids: numbers.of(&DAMAGED_IDS),
            under_way: BinaryHeap::new(),
            order: 0,
            seq: sent,
        }
    }

    /// Lets a sensor of this name fail for a time, in addition to the faults of the file.
    pub(crate) fn fails(
        &mut self,
        sensor: SensorId,
        failure: SensorFailure,
        span: Interval<RunTime>,
        name: &str,
        seed: u64,
    ) {
        let Some(channel) = self.channels.get_mut(sensor.index()) else { return };
        channel.fails(failure, span);
        if let SensorFailure::Stuck { every_us: Some(every) } = failure {
            self.sources.repeat(
                sensor,
                every,
                span,
                Stream::named(seed, &format!("sensor/{name}/outside/{}", span.begin)),
            );
        }
    }

    /// The number of sensors that the logger knows, without other places.
    pub fn sensors(&self) -> usize {
        self.channels.len()
    }

    /// The time before which all firings are final, at the instant `now` of the run.
    pub fn settled(&self, now: RunTime) -> RunTime {
        self.clocks.settled(now)
    }

    /// Takes from `said` what the world has said up to `now`, firings and their causes alone, and adds to `events` what the
    /// logger receives before then, and what of it is lost.
    pub fn carry(&mut self, said: &mut Events, now: RunTime, events: &mut Events) {
        let due = self.under_way.peek().map_or(RunTime::NEVER, |Reverse(due)| due.at);
        if said.firings.is_empty() && due.min(self.sources.next()) >= now {
            return;
        }
        let mut told = 0;
        loop {
            let of_world = said.firings.get(told).map_or(RunTime::NEVER, |firing| firing.at);
            let of_sources = self.sources.next();
            let due = self.under_way.peek().map_or(RunTime::NEVER, |Reverse(due)| due.at);
            if of_world <= of_sources.min(due) {
                let (Some(&firing), Some(&Fact::Provenance { provenance, .. })) =
                    (said.firings.get(told), said.facts.get(told))
                else {
                    break;
                };
                self.says(firing, provenance, events);
                told += 1;
            } else if of_sources.min(due) >= now {
                break;
            } else if of_sources <= due {
                let Some(spoken) = self.sources.speak() else { break };
                self.send_without_cause(&spoken, events);
            } else {
                let Some(Reverse(due)) = self.under_way.pop() else { break };
                self.next_stage(due, events);
            }
        }
        said.clear();
    }

    fn says(&mut self, firing: Firing, provenance: Provenance, events: &mut Events) {
        let Firing { at, sensor: place, value, .. } = firing;
        let own = self.channels.len();
        let sensor = if place.index() < own { place } else { self.places[place.index() - own] };
        let channel = &mut self.channels[sensor.index()];
        if channel.place(at).unwrap_or(sensor) != place {
            return;
        }
        let draws = channel.draw();
        let message = MessageUnderWay { sent_at: at, sensor, id: sensor, value, provenance, draws };
        match channel.lost_by_device(at, draws) {
            Some(loss) => lose(&message, loss, events),
            None => {
                channel.said = Some(value);
                self.send(message, events);
            }
        }
    }

    fn send_without_cause(&mut self, told: &Utterance, events: &mut Events) {
        let Utterance { at, sensor, repeats, draws } = *told;
        let channel = &self.channels[sensor.index()];
        let provenance = Provenance { resident: None, seen_at: at, trigger: Trigger::False };
        let value = if repeats { channel.said } else { Some(Value::Fire) };
        let Some(value) = value.filter(|_| repeats || !channel.is_numb(at)) else { return };
        let message = MessageUnderWay { sent_at: at, sensor, id: sensor, value, provenance, draws };
        match channel.lost_by_battery(at, draws) {
            true => lose(&message, Loss::Battery, events),
            false => self.send(message, events),
        }
    }

    fn send(&mut self, message: MessageUnderWay, events: &mut Events) {
        let Some(radio) = &mut self.radio else { return self.receive(message.sent_at, message, events) };
        match radio.begin(message.sensor, message.sent_at) {
            Some(begin) => self.send_copy(begin, 0, message, events),
            None => lose(&message, Loss::Collision, events),
        }
    }

    fn send_copy(&mut self, begin: RunTime, copy: u32, message: MessageUnderWay, events: &mut Events) {
        match self.radio.as_ref().and_then(|radio| radio.end(begin, copy)) {
            Some(end) => self.wait(end, MessageStage::Sent { begin, copy }, message),
            None => lose(&message, Loss::Collision, events),
        }
    }

    fn wait(&mut self, at: RunTime, stage: MessageStage, message: MessageUnderWay) {
        self.under_way.push(Reverse(Due { at, stage, order: self.order, message }));
        self.order += 1;
    }

    fn next_stage(&mut self, due: Due, events: &mut Events) {
        let Due { at, stage, message, .. } = due;
        match stage {
            MessageStage::Sent { begin, copy } => {
                let is_clean = self.radio.as_ref().is_none_or(|radio| radio.is_clean(message.sensor, begin, copy));
                if is_clean {
                    self.receive(at, message, events);
                } else {
                    self.send_copy(begin, copy + 1, message, events);
                }
            }
            MessageStage::Arrives => self.arrives(at, message, events),
            MessageStage::Settled { stamp } => self.tell(stamp, &message, events),
        }
    }

    /// A message has come through the air, unless chance takes it.
    fn receive(&mut self, at: RunTime, mut message: MessageUnderWay, events: &mut Events) {
        let channel = &self.channels[message.sensor.index()];
        let draws = message.draws;
        if channel.lost_on_the_way(message.sent_at, draws) {
            return lose(&message, Loss::Radio, events);
        }
        if draws.of(LinkChance::Corruption) < channel.corruption && !self.garble(&mut message) {
            return lose(&message, Loss::Garbled, events);
        }
        let arrives = at + channel.delay(draws.of(LinkChance::Delay));
        let again = (draws.of(LinkChance::Duplicate) < channel.duplicates)
            .then(|| arrives + channel.delay(draws.of(LinkChance::Again)));
        self.wait(arrives, MessageStage::Arrives, message);
        if let Some(again) = again {
            message.provenance.trigger = Trigger::Duplicate;
            self.wait(again, MessageStage::Arrives, message);
        }
    }

    /// Damages a message's id or its value; whether it can still be understood.
    fn garble(&self, message: &mut MessageUnderWay) -> bool {
        let (damage, of_ids) = (message.draws.of(LinkChance::Damage), self.damaged_ids);
        if damage < of_ids {
            let id = garbled_id(self.channels[message.sensor.index()].id, damage / of_ids);
            let owner = self.channels.iter().position(|channel| channel.id == id);
            message.id = owner.map_or(message.id, SensorId::new);
            return owner.is_some();
        }
        let value = garbled_value(message.value, (damage - of_ids) / (1.0 - of_ids));
        message.value = value.unwrap_or(message.value);
        value.is_some()
    }

    fn arrives(&mut self, at: RunTime, message: MessageUnderWay, events: &mut Events) {
        if self.outages.iter().any(|outage| outage.contains(at)) {
            return lose(&message, Loss::Outage, events);
        }
        let clock = self.channels[message.sensor.index()].clock;
        let stamp = clock.map_or(at, |clock| clock.shows(message.sent_at));
        if self.clocks.clocks.is_empty() {
            self.tell(stamp, &message, events);
        } else {
            self.wait(self.clocks.settles(stamp), MessageStage::Settled { stamp }, message);
        }
    }

    fn tell(&mut self, stamp: RunTime, message: &MessageUnderWay, events: &mut Events) {
        let MessageUnderWay { id, value, provenance, .. } = *message;
        events.firings.push(Firing { seq: self.seq, at: stamp, sensor: id, value });
        events.facts.push(Fact::Provenance { seq: self.seq, provenance });
        self.seq += 1;
    }
}

fn lose(message: &MessageUnderWay, loss: Loss, events: &mut Events) {
    let MessageUnderWay { sent_at, sensor, value, provenance, .. } = *message;
    events.facts.push(Fact::Lost { at: sent_at, sensor, value, provenance, loss });
}

impl Due {
    /// At one instant the air comes first; messages arrive in the order in which they were sent.
    fn key(&self) -> (RunTime, u8, RunTime, u64) {
        let (stage, stamp) = match self.stage {
            MessageStage::Sent { .. } => (0, RunTime::START),
            MessageStage::Arrives => (1, RunTime::START),
            MessageStage::Settled { stamp } => (2, stamp),
        };
        (self.at, stage, stamp, self.order)
    }
}

impl Ord for Due {
    fn cmp(&self, other: &Due) -> Ordering {
        self.key().cmp(&other.key())
    }
}

impl PartialOrd for Due {
    fn partial_cmp(&self, other: &Due) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Due {
    fn eq(&self, other: &Due) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Due {}
