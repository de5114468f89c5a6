//! A pressure pad in a chair, or a mat on the floor.
//!
//! The device is a pair of foils that a weight presses together: it says `ON` and `OFF`.
//!
//! We assume that a pad in a piece of furniture feels people who sit or lie with their middle within its outline, and
//! not those who walk or stand there; and that a mat, which is an area of the floor or furniture at most 5 cm high (our
//! choice), feels every body with its middle over it.
//!
//! Without movement, it does not change. A stride crosses a convex outline once: the fractions of it at which it enters
//! and leaves, to the nearest microsecond, are the instants at which it presses and releases a mat. A state that lasts
//! for the delay is a message. All changes of one instant are known before the state is decided, so that an arrival at
//! the instant of a departure changes nothing.
//!
//! Left out: weight, feet and their pace, pets, things that are put down.

use super::entities::EntityRow;
use super::meaning::Meaning;
use super::messages::SensorMessage;
use super::outbox::{Change, DeviceModel, Outbox};
use crate::event::{Trigger, Value};
use crate::geometry::{self, At, Point};
use crate::ids::ResidentId;
use crate::motion::{MotionSegment, MotionState};
use crate::posture::Posture;
use crate::sensors::form::{
    Bearer, Colour, FormProblem, KindRow, Mount, ReportedInstant, SensorForm, Shape, Site, is_zero,
};
use crate::time::{Interval, RunTime, Span};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The row of the kind.
pub static ROW: KindRow = KindRow {
    key: "pressure",
    label: "pressure",
    mount: Mount::Thing(&[Bearer::Enterable]),
    unit: None,
    values: &[Value::On, Value::Off],
    shape: Shape::Hexagon,
    colour: Colour::Green,
    casas: "I",
    meaning: Meaning::UseOrReading,
    entities: &[EntityRow::switch("occupancy", "occupancy")],
};

/// A pressure pad in a chair or a mat on the floor. Its events are `ON` and `OFF`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "pressure sensor")]
pub struct PressureFile {
    /// Name of the sensor, unique in the home. The log uses it unless `logger.json` gives another id.
    #[schemars(length(min = 1, max = 100))]
    pub name: String,
    /// Enterable piece of furniture that the sensor is in. In one of at most 5 cm, the sensor is a mat.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub on: Option<String>,
    /// Convex area of a mat on the floor, instead of `on`: its corners in order.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(length(min = 3, max = 64), inner(inner(range(min = -10_000, max = 10_000))))]
    pub area: Option<Vec<At>>,
    /// Time that the pad is pressed, or free, before it sends an event.
    #[serde(default, skip_serializing_if = "is_zero")]
    #[schemars(range(min = 0, max = 3_600), extend("default" = 0))]
    pub delay_s: f64,
}

impl SensorForm for PressureFile {
    fn on(&self) -> Option<&str> {
        self.on.as_deref()
    }

    fn area(&self) -> Option<&[At]> {
        self.area.as_deref()
    }

    fn wrong(&self) -> Vec<FormProblem> {
        match (&self.on, &self.area) {
            (Some(_), Some(_)) => vec![FormProblem::new("/area", SensorMessage::TwoPlaces)],
            (None, None) => {
                let sensor = self.name.clone();
                vec![FormProblem::new("", SensorMessage::NoPlace { sensor, mat_height_m: MAT_HEIGHT_M })]
            }
            _ => Vec::new(),
        }
    }

    fn moment(&self) -> Option<ReportedInstant<'_>> {
        Some(ReportedInstant::Pressed(self.on.as_deref()?, Span::from_seconds(self.delay_s)))
    }
}

/// Greatest height of a mat (our choice).
pub const MAT_HEIGHT_M: f64 = 0.05;

/// A pressure sensor.
#[derive(Clone, Debug, PartialEq)]
pub struct Pressure {
    outline: Vec<Point>,
    is_mat: bool,
    delay: Span,
    timer: RunTime,
    /// The interval in which each resident presses it, as far as known.
    spans: Vec<Interval<RunTime>>,
    /// The state, its start, and the last resident who pressed it.
    pressed: bool,
    since: RunTime,
    by: ResidentId,
    says_on: bool,
}

impl Pressure {
    /// A sensor of the outline of this site.
    pub fn new(file: &PressureFile, site: &Site) -> Pressure {
        Pressure {
            outline: site.outline.clone(),
            is_mat: site.height_m <= MAT_HEIGHT_M,
            delay: Span::from_seconds(file.delay_s),
            timer: RunTime::NEVER,
            spans: Vec::new(),
            pressed: false,
            since: RunTime::START,
            by: ResidentId(0),
            says_on: false,
        }
    }
}

impl DeviceModel for Pressure {
    fn feels_bodies(&self) -> bool {
        true
    }

    fn on_event(&mut self, at: RunTime, change: &Change, _outbox: &mut Outbox) {
        let Change::Body { resident, ref segment, .. } = *change else { return };
        let MotionSegment { begin, end, doing, posture } = *segment;
        let resident = resident.index();
        if resident >= self.spans.len() {
            self.spans.resize(resident + 1, NOT);
        }
        let span = match doing {
            MotionState::Stride { from, to } if self.is_mat => self.crossing(from, to, begin, end),
            MotionState::InPlace { at: place, .. } | MotionState::Rest { at: place }
                if (self.is_mat || matches!(posture, Posture::Sitting | Posture::Lying))
                    && geometry::covers(&self.outline, place) =>
            {
                Interval::ALL
            }
            _ => NOT,
        };
        if span != self.spans[resident] {
            self.spans[resident] = span;
            self.timer = at;
        }
    }

    fn timer(&self) -> RunTime {
        self.timer
    }

    fn on_timer(&mut self, at: RunTime, outbox: &mut Outbox) {
        let by = self.spans.iter().position(|span| span.contains(at));
        if let Some(by) = by {
            self.by = ResidentId::new(by);
        }
        if by.is_some() != self.pressed {
            (self.pressed, self.since) = (by.is_some(), at);
        }
        let says_at = if self.pressed == self.says_on { RunTime::NEVER } else { self.since.saturating_add(self.delay) };
        if says_at <= at {
            self.says_on = self.pressed;
            outbox.send(
                if self.pressed { Value::On } else { Value::Off },
                Some(self.by),
                self.since,
                Trigger::Movement,
            );
        }
        let changes = self.spans.iter().flat_map(|span| [span.begin, span.end]).filter(|&change| change > at);
        let says_at = if says_at > at { says_at } else { RunTime::NEVER };
        self.timer = changes.fold(says_at, Ord::min);
    }
}

impl Pressure {
    /// The interval in which a stride presses a mat: without end, until the next movement, if it ends there.
    fn crossing(&self, from: Point, to: Point, begin: RunTime, end: RunTime) -> Interval<RunTime> {
        let Some((enter, leave)) = geometry::segment_inside_convex(&self.outline, from, to) else { return NOT };
        let instant = |share: f64| begin + (end - begin).scaled(share);
        let span = Interval {
            begin: if enter > 0.0 { instant(enter) } else { RunTime::MIN },
            end: if leave < 1.0 { instant(leave) } else { RunTime::NEVER },
        };
        if span.is_empty() { NOT } else { span }
    }
}

/// The interval of a resident who does not press it.
const NOT: Interval<RunTime> = Interval::instant(RunTime::NEVER);
