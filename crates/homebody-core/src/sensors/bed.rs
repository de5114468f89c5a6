//! A pneumatic strip in a bed.
//!
//! The device is a tube of air across the bed under the trunk. Its pressure shows the presence of a person in the bed,
//! the length of each movement, and a low, normal or high pulse and respiration of a person who lies still (Godsey &
//! Skubic 2009, section III.D; the University of Virginia's page on ALARM-NET).
//!
//! We assume that a body is in the bed if it sits or lies with its middle within the bed's outline; a body that stands or
//! walks there is not. Every movement of a body that lies is felt. Of two people, the strip measures the one who came first.
//! A person without vitals in the truth has a pulse of 62 and 15 breaths a minute. The error of a reading is normal,
//! with a standard deviation of 2 beats and 1 breath a minute (all ours).
//!
//! A movement begins when a person in the bed begins to move, and ends when all lie still. Movements without a pause
//! between them are one. The sensor sends `RESTLESS_1` to `RESTLESS_4` when a movement reaches the length of each
//! level. Pulse and respiration are read first when the person measured has lain there for `still_s` without any
//! movement in the bed, and then every `vitals_every_s`. A reading that is due during a movement waits until all have
//! lain still for `still_s` again. A change of the true vitals into another class brings the next reading forward. All
//! changes of one instant are known before the sensor decides on a message.
//!
//! Left out: people who lie next to the strip, pets, the strength of a movement, the effect of breathing on the pulse's
//! signal, drift of the pressure.

use super::entities::{EntityForm, EntityRow};
use super::meaning::{Kind, Meaning};
use super::messages::SensorMessage;
use super::outbox::{Change, DeviceModel, Outbox};
use crate::event::{Band, Trigger, Value, Vitals};
use crate::geometry::{self, Point};
use crate::ids::ResidentId;
use crate::motion::{MotionSegment, MotionState};
use crate::numbers::Numbers;
use crate::plan::sun::Sun;
use crate::posture::Posture;
use crate::random::{Stream, no_stream};
use crate::sensors::form::{Bearer, Colour, FormProblem, KindRow, Mount, ReportedInstant, SensorForm, Shape, Site};
use crate::time::{RunTime, Span};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Bands of pulse and respiration.
const BANDS: EntityForm = EntityForm::Choice(&["low", "normal", "high"]);

/// The row of the kind.
pub static ROW: KindRow = KindRow {
    key: "bed",
    label: "bed",
    mount: Mount::Thing(&[Bearer::Enterable]),
    unit: None,
    values: &[
        Value::In,
        Value::Out,
        Value::Restless(1),
        Value::Restless(2),
        Value::Restless(3),
        Value::Restless(4),
        Value::Pulse(Band::Low),
        Value::Pulse(Band::Normal),
        Value::Pulse(Band::High),
        Value::Respiration(Band::Low),
        Value::Respiration(Band::Normal),
        Value::Respiration(Band::High),
    ],
    shape: Shape::Pill,
    colour: Colour::Purple,
    casas: "I",
    meaning: Meaning::Is(Kind::Used),
    entities: &[
        EntityRow::switch("occupancy", "occupancy"),
        EntityRow::prefixed("RESTLESS", "restlessness", "Restlessness", EntityForm::Number, None),
        EntityRow::prefixed("PULSE", "pulse", "Pulse", BANDS, Some("enum")),
        EntityRow::prefixed("RESPIRATION", "respiration", "Respiration", BANDS, Some("enum")),
    ],
};

/// A pneumatic strip in a bed. Its events are `IN` and `OUT`, `RESTLESS_1` to `RESTLESS_4`, and low, normal or high
/// pulse and respiration.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "bed sensor")]
pub struct BedFile {
    /// Name of the sensor, unique in the home. The log uses it unless `logger.json` gives another id.
    #[schemars(length(min = 1, max = 100))]
    pub name: String,
    /// Enterable piece of furniture that the strip is in.
    pub on: String,
    /// Duration of a movement that reaches each level of restlessness.
    #[serde(default = "levels")]
    #[schemars(length(min = 1, max = 4), inner(range(min = 0, max = 3_600)))]
    pub levels_s: Vec<f64>,
    /// Interval between readings of pulse and respiration while the person keeps still.
    #[serde(default = "vitals_every")]
    #[schemars(range(min = 1, max = 86_400))]
    pub vitals_every_s: f64,
    /// Limits of the normal pulse. A lower one is low, a higher one is high.
    #[serde(default = "pulse")]
    #[schemars(inner(range(min = 1, max = 300)))]
    pub pulse_bpm: [f64; 2],
    /// Limits of the normal respiration. A lower one is low, a higher one is high.
    #[serde(default = "respiration")]
    #[schemars(inner(range(min = 1, max = 100)))]
    pub respiration_pm: [f64; 2],
    /// Time that the person has to lie still before the first reading of pulse and respiration.
    #[serde(default = "still")]
    #[schemars(range(min = 0, max = 3_600))]
    pub still_s: f64,
}

impl SensorForm for BedFile {
    fn on(&self) -> Option<&str> {
        Some(&self.on)
    }

    fn wrong(&self) -> Vec<FormProblem> {
        let mut wrong = Vec::new();
        if let Some(index) = self.levels_s.windows(2).position(|pair| pair[0] >= pair[1]) {
            let (level_s, before_s) = (self.levels_s[index + 1], self.levels_s[index]);
            let message = SensorMessage::LevelsOrder { level_s, before_s };
            wrong.push(FormProblem::new(format!("/levels_s/{}", index + 1), message));
        }
        for (key, [low, high]) in [("pulse_bpm", self.pulse_bpm), ("respiration_pm", self.respiration_pm)] {
            if low >= high {
                wrong.push(FormProblem::new(format!("/{key}"), SensorMessage::VitalLimits { key, low, high }));
            }
        }
        wrong
    }

    fn moment(&self) -> Option<ReportedInstant<'_>> {
        Some(ReportedInstant::Pressed(&self.on, Span::ZERO))
    }
}

crate::numbers! {
    /// Pulse of a person with no pulse in the truth.
    static PULSE_BPM = "bed.pulse": 62.0, "1/min", [40.0, 120.0];
    /// Respiration of a person with no respiration in the truth.
    static RESPIRATION_PM = "bed.respiration": 15.0, "1/min", [8.0, 30.0];
    /// Standard deviation of the error of a reading of the pulse.
    static PULSE_NOISE_BPM = "bed.pulse_noise": 2.0, "1/min", [0.0, 20.0];
    /// Standard deviation of the error of a reading of the respiration.
    static RESPIRATION_NOISE_PM = "bed.respiration_noise": 1.0, "1/min", [0.0, 10.0];
}

/// A bed sensor.
#[derive(Clone, Debug, PartialEq)]
pub struct Bed {
    outline: Vec<Point>,
    levels: Vec<Span>,
    every: Span,
    still: Span,
    limits: Limits,
    /// The vitals of a person without vitals in the truth, and the standard deviations of readings.
    ordinary: Vitals,
    noise: Vitals,
    stream: Stream,
    timer: RunTime,
    sleepers: Vec<Sleeper>,
    /// The first of the people in the bed.
    first: Option<usize>,
    movement: Option<BedMovement>,
    /// Start of the time in which a person lies there without any movement.
    still_since: Option<RunTime>,
    read_at: Option<RunTime>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Limits {
    pulse: [f64; 2],
    respiration: [f64; 2],
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Sleeper {
    /// The start of their time in the bed.
    since: Option<RunTime>,
    lies: bool,
    stirs: bool,
    vitals: Vitals,
    /// The last change of the true vitals into another class without a reading since.
    news: Option<RunTime>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct BedMovement {
    onset: RunTime,
    said: usize,
}

impl Bed {
    /// A sensor in the bed of this site.
    pub fn new(file: &BedFile, site: &Site) -> Bed {
        Bed {
            outline: site.outline.clone(),
            levels: file.levels_s.iter().map(|&level| Span::from_seconds(level)).collect(),
            every: Span::from_seconds(file.vitals_every_s),
            still: Span::from_seconds(file.still_s),
            limits: Limits { pulse: file.pulse_bpm, respiration: file.respiration_pm },
            ordinary: Vitals { pulse: PULSE_BPM.value, respiration: RESPIRATION_PM.value },
            noise: Vitals { pulse: 0.0, respiration: 0.0 },
            stream: no_stream(),
            timer: RunTime::NEVER,
            sleepers: Vec::new(),
            first: None,
            movement: None,
            still_since: None,
            read_at: None,
        }
    }
}

impl DeviceModel for Bed {
    fn begin(&self, stream: Stream, _sun: Sun, numbers: &Numbers) -> Bed {
        let vitals = |pulse, respiration| Vitals { pulse: numbers.of(pulse), respiration: numbers.of(respiration) };
        let (ordinary, noise) = (vitals(&PULSE_BPM, &RESPIRATION_PM), vitals(&PULSE_NOISE_BPM, &RESPIRATION_NOISE_PM));
        Bed { stream, ordinary, noise, ..self.clone() }
    }

    fn feels_bodies(&self) -> bool {
        true
    }

    fn on_event(&mut self, at: RunTime, change: &Change, _outbox: &mut Outbox) {
        let (Change::Body { resident, .. } | Change::Vitals { resident, .. }) = *change else { return };
        let resident = resident.index();
        if resident >= self.sleepers.len() {
            let awake = Sleeper { since: None, lies: false, stirs: false, vitals: self.ordinary, news: None };
            self.sleepers.resize(resident + 1, awake);
        }
        let before = self.sleepers[resident];
        let mut after = before;
        match *change {
            Change::Body { segment: MotionSegment { doing, posture, .. }, .. } => {
                let place = match doing {
                    MotionState::InPlace { at, .. } | MotionState::Rest { at } => Some(at),
                    MotionState::Stride { .. } | MotionState::Away => None,
                };
                let is_in = matches!(posture, Posture::Sitting | Posture::Lying)
                    && place.is_some_and(|p| geometry::covers(&self.outline, p));
                after.since = if is_in { before.since.or(Some(at)) } else { None };
                after.lies = posture == Posture::Lying;
                after.stirs = matches!(doing, MotionState::InPlace { .. });
            }
            Change::Vitals { vitals, .. } => {
                after.vitals = vitals;
                if self.limits.bands(vitals) != self.limits.bands(before.vitals) {
                    after.news = Some(at);
                }
            }
            Change::Use { .. } | Change::Fired => {}
        }
        if after != before {
            self.sleepers[resident] = after;
            self.timer = at;
        }
    }

    fn timer(&self) -> RunTime {
        self.timer
    }

    fn on_timer(&mut self, at: RunTime, outbox: &mut Outbox) {
        self.settle_presence(at, outbox);
        let next_level = self.settle_movement(at, outbox);
        let next_reading = self.settle_vitals(at, outbox);
        self.timer = next_level.min(next_reading);
    }
}

impl Bed {
    fn settle_presence(&mut self, at: RunTime, outbox: &mut Outbox) {
        let inside = self.sleepers.iter().enumerate().filter_map(|(who, sleeper)| Some((sleeper.since?, who)));
        let first = inside.min().map(|(_, who)| who);
        match (self.first, first) {
            (None, Some(who)) => outbox.send(Value::In, Some(ResidentId::new(who)), at, Trigger::Movement),
            (Some(who), None) => outbox.send(Value::Out, Some(ResidentId::new(who)), at, Trigger::Movement),
            _ => {}
        }
        if self.first != first {
            (self.first, self.still_since, self.read_at) = (first, None, None);
        }
    }

    /// Sends the level of the present movement; returns the instant of the next level.
    fn settle_movement(&mut self, at: RunTime, outbox: &mut Outbox) -> RunTime {
        let moves = |sleeper: &Sleeper| sleeper.since.is_some() && sleeper.lies && sleeper.stirs;
        let Some(who) = self.sleepers.iter().position(moves) else {
            self.movement = None;
            return RunTime::NEVER;
        };
        let movement = self.movement.get_or_insert(BedMovement { onset: at, said: 0 });
        let mut levels = self.levels.iter().map(|level| movement.onset + *level).skip(movement.said);
        let mut next = levels.next();
        while next.is_some_and(|next| next <= at) {
            movement.said += 1;
            outbox.send(
                Value::Restless(movement.said as u8),
                Some(ResidentId::new(who)),
                movement.onset,
                Trigger::Movement,
            );
            next = levels.next();
        }
        next.unwrap_or(RunTime::NEVER)
    }

    /// Reads pulse and respiration if due; returns the instant of the next reading.
    fn settle_vitals(&mut self, at: RunTime, outbox: &mut Outbox) -> RunTime {
        let measured = self.first.filter(|&who| self.sleepers[who].lies && self.movement.is_none());
        let Some(who) = measured else {
            self.still_since = None;
            return RunTime::NEVER;
        };
        let can = *self.still_since.get_or_insert(at) + self.still;
        let next = match (self.read_at, self.sleepers[who].news) {
            (None, _) => can,
            (Some(_), Some(news)) => can.max(news),
            (Some(read_at), None) => can.max(read_at + self.every),
        };
        if next > at {
            return next;
        }
        let Vitals { pulse, respiration } = self.sleepers[who].vitals;
        let felt = Vitals {
            pulse: self.stream.normal(pulse, self.noise.pulse),
            respiration: self.stream.normal(respiration, self.noise.respiration),
        };
        let (pulse, respiration) = self.limits.bands(felt);
        outbox.send(Value::Pulse(pulse), Some(ResidentId::new(who)), at, Trigger::Reading);
        outbox.send(Value::Respiration(respiration), Some(ResidentId::new(who)), at, Trigger::Reading);
        (self.read_at, self.sleepers[who].news) = (Some(at), None);
        at + self.every
    }
}

impl Limits {
    fn bands(&self, vitals: Vitals) -> (Band, Band) {
        let band = |number: f64, [least, most]: [f64; 2]| match number {
            low if low < least => Band::Low,
            high if high > most => Band::High,
            _ => Band::Normal,
        };
        (band(vitals.pulse, self.pulse), band(vitals.respiration, self.respiration))
    }
}

super::form::usual! {
    /// Our choice. The patent of Skubic et al., paragraphs 137 to 142, states that the bed sensors at TigerPlace report
    /// restlessness by the persistence of movement; the page of the University of Virginia on ALARM-NET has four levels.
    fn levels() -> Vec<f64> = vec![0.0, 3.0, 6.0, 9.0];
    /// Ours.
    fn vitals_every() -> f64 = 900.0;
    /// Ours.
    fn pulse() -> [f64; 2] = [30.0, 100.0];
    /// Ours.
    fn respiration() -> [f64; 2] = [6.0, 30.0];
    /// Ours.
    fn still() -> f64 = 60.0;
}
