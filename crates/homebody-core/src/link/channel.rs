//! One sensor and its way to the logger: how often things go wrong, and what is wrong with it when.

use super::clock::SensorClock;
use super::message::{Draws, IDS, LinkChance};
use crate::event::{Loss, Value};
use crate::ids::SensorId;
use crate::intervention::SensorFailure;
use crate::link::form::{FaultFile, LinkFile};
use crate::random::{SpanRange, Stream};
use crate::time::{Interval, RunTime, Span};

/// One sensor's way.
#[derive(Clone, Debug)]
pub struct Channel {
    misses: f64,
    loss: f64,
    pub corruption: f64,
    pub duplicates: f64,
    pub delay: SpanRange,
    /// The clock whose time its messages bear, where that is not the logger's.
    pub clock: Option<SensorClock>,
    /// The id that its messages bear on the air.
    pub id: u32,
    /// The last value of its device; for sensors that look for movement, their only value.
    pub said: Option<Value>,
    faults: Vec<(Interval<RunTime>, ChannelFault)>,
    /// The places that it moves to, in order, each as a sensor of the home, with the instant.
    moves: Vec<(RunTime, SensorId)>,
    stream: Stream,
}

#[derive(Clone, Copy, Debug)]
enum ChannelFault {
    /// Loss grows evenly from nothing at its beginning to everything after this time, as we assume.
    Battery {
        fades: Span,
    },
    Stuck,
    FallsOff,
    BadLink {
        loss: f64,
    },
}

impl Channel {
    /// The way of the sensor that the file calls so; only sensors that look for movement can miss it.
    pub fn new(file: &LinkFile, sensor: &str, looks: bool, seed: u64) -> Channel {
        let rates = file.rates(sensor, looks);
        let own = file.faults.iter().filter(|fault| fault.sensor() == Some(sensor));
        let fault = |file: &FaultFile| {
            let fault = match file {
                FaultFile::Battery(file) => ChannelFault::Battery { fades: Span::from_days(file.fading_days) },
                FaultFile::Stuck(_) => ChannelFault::Stuck,
                FaultFile::FallsOff(_) => ChannelFault::FallsOff,
                FaultFile::BadLink(file) => ChannelFault::BadLink { loss: file.loss },
                FaultFile::Moved(_) | FaultFile::Drift(_) | FaultFile::FalseFires(_) | FaultFile::Outage(_) => {
                    return None;
                }
            };
            Some((file.span(), fault))
        };
        Channel {
            misses: rates.misses,
            loss: rates.loss,
            corruption: rates.corruption,
            duplicates: rates.duplicates,
            delay: SpanRange::from_seconds(rates.delay_s),
            clock: own.clone().find_map(|fault| match fault {
                FaultFile::Drift(file) => Some(SensorClock::new(file)),
                _ => None,
            }),
            // Of its name alone, whatever the seed and the other sensors.
            id: Stream::named(0, &format!("sensor/{sensor}/id")).below(IDS),
            said: looks.then_some(Value::Fire),
            faults: own.filter_map(fault).collect(),
            moves: Vec::new(),
            stream: Stream::named(seed, &format!("sensor/{sensor}/link")),
        }
    }

    /// Its device or its way fails for a time.
    pub fn fails(&mut self, failure: SensorFailure, span: Interval<RunTime>) {
        let fault = match failure {
            SensorFailure::Battery { fades_us } => ChannelFault::Battery { fades: fades_us },
            SensorFailure::Stuck { .. } => ChannelFault::Stuck,
            SensorFailure::FallsOff => ChannelFault::FallsOff,
            SensorFailure::BadLink { lost_ppm } => ChannelFault::BadLink { loss: f64::from(lost_ppm) / 1e6 },
        };
        self.faults.push((span, fault));
    }

    /// From an instant on the sensor is another of the home's.
    pub fn moves(&mut self, at: RunTime, to: SensorId) {
        self.moves.push((at, to));
        self.moves.sort_unstable();
    }

    /// Which of the home's sensors it is at an instant, if it has been moved by then.
    pub fn place(&self, at: RunTime) -> Option<SensorId> {
        self.moves.iter().rev().find(|(from, _)| *from <= at).map(|&(_, place)| place)
    }

    pub fn draw(&mut self) -> Draws {
        Draws::draw(&mut self.stream)
    }

    fn faults(&self, at: RunTime) -> impl Iterator<Item = (RunTime, ChannelFault)> {
        let now = self.faults.iter().filter(move |(span, _)| span.contains(at));
        now.map(|&(span, fault)| (span.begin, fault))
    }

    /// Why its device does not say what it ought to, if it does not.
    pub fn lost_by_device(&self, at: RunTime, draws: Draws) -> Option<Loss> {
        let of_fault = |(begin, fault)| match fault {
            ChannelFault::Battery { fades } => {
                (draws.of(LinkChance::Battery) < spent(at - begin, fades)).then_some(Loss::Battery)
            }
            ChannelFault::Stuck => Some(Loss::Stuck),
            ChannelFault::FallsOff => Some(Loss::Place),
            ChannelFault::BadLink { .. } => None,
        };
        let missed = || (draws.of(LinkChance::Miss) < self.misses).then_some(Loss::Miss);
        self.faults(at).find_map(of_fault).or_else(missed)
    }

    /// Whether its device has not enough power to send this.
    pub fn lost_by_battery(&self, at: RunTime, draws: Draws) -> bool {
        self.faults(at).any(|(begin, fault)| match fault {
            ChannelFault::Battery { fades } => draws.of(LinkChance::Battery) < spent(at - begin, fades),
            ChannelFault::Stuck | ChannelFault::FallsOff | ChannelFault::BadLink { .. } => false,
        })
    }

    /// Whether its device is past firing for no reason.
    pub fn is_numb(&self, at: RunTime) -> bool {
        self.faults(at).any(|(begin, fault)| match fault {
            ChannelFault::Battery { fades } => at - begin >= fades,
            ChannelFault::Stuck => true,
            ChannelFault::FallsOff | ChannelFault::BadLink { .. } => false,
        })
    }

    /// Whether its message, sent at this instant, gets lost on the way by chance.
    pub fn lost_on_the_way(&self, sent_at: RunTime, draws: Draws) -> bool {
        let by_link =
            |(_, fault)| matches!(fault, ChannelFault::BadLink { loss } if draws.of(LinkChance::BadLink) < loss);
        draws.of(LinkChance::Loss) < self.loss || self.faults(sent_at).any(by_link)
    }

    /// A delay, by a number from 0 up to 1.
    pub fn delay(&self, draws: f64) -> Span {
        let SpanRange { least, most } = self.delay;
        let values = (most - least + Span::MICROSECOND).micros();
        least + Span::from_micros((draws * values as f64) as i64)
    }
}

/// The share of its messages that a battery does not send, some time after it began to fade.
fn spent(since: Span, fades: Span) -> f64 {
    if since >= fades { 1.0 } else { since.ratio(fades) }
}
