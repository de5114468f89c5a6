//! A pressure pad in a chair, or a mat on the floor.
//!
//! The device is a pair of foils that a weight presses together: it says `ON` and `OFF`.
//!
//! We assume that a pad in a piece of furniture feels who sits or lies with their middle within its outline, and nobody who
//! walks or stands there; and that a mat, which is an area of the floor or furniture at most 5 cm high (ours), feels every body
//! whose middle is over it, whatever it does.
//!
//! While nobody moves, nothing changes. A stride crosses a convex outline once: the fractions of it at which it enters and
//! leaves, to the nearest microsecond, are when it presses and releases a mat. What is pressed, or free, for the delay is said.
//! What is so at one instant is settled after all that happens then was told, so that who comes as another leaves changes
//! nothing.
//!
//! Left out: weight, feet and their pace, pets, things that are put down.

use super::outbox::{Change, Outbox};
use crate::event::{MotionState, Trigger, Value};
use crate::geometry::{self, Point};
use crate::ids::ResidentId;
use crate::scenario::device::PressureFile;
use crate::scenario::path::Posture;
use crate::time::{Micros, NEVER, micros};

/// Furniture up to this height is a mat (ours).
pub const MAT_HEIGHT_M: f64 = 0.05;

/// A pressure sensor.
#[derive(Clone, Debug, PartialEq)]
pub struct Pressure {
    outline: Vec<Point>,
    is_mat: bool,
    delay: Micros,
    timer: Micros,
    /// From when until when each resident presses it, as far as it was told.
    spans: Vec<(Micros, Micros)>,
    /// Whether it is pressed, since when it is so, and by whom it was last.
    pressed: bool,
    since: Micros,
    by: ResidentId,
    says_on: bool,
}

impl Pressure {
    /// A sensor of this convex outline.
    pub fn new(file: &PressureFile, outline: Vec<Point>, is_mat: bool) -> Pressure {
        Pressure {
            outline,
            is_mat,
            delay: micros(file.delay_s),
            timer: NEVER,
            spans: Vec::new(),
            pressed: false,
            since: 0,
            by: ResidentId(0),
            says_on: false,
        }
    }

    pub fn on_event(&mut self, at: Micros, change: &Change) {
        let Change::Body { resident, begin, end, doing, posture } = *change else { return };
        let resident = resident.index();
        if resident >= self.spans.len() {
            self.spans.resize(resident + 1, NOT);
        }
        let span = match doing {
            MotionState::Stride { from, to } if self.is_mat => self.crossing(from, to, begin, end),
            MotionState::InPlace { at: place, .. } | MotionState::Rest { at: place }
                if (self.is_mat || posture != Posture::Standing) && geometry::covers(&self.outline, place) =>
            {
                (Micros::MIN, NEVER)
            }
            _ => NOT,
        };
        if span != self.spans[resident] {
            self.spans[resident] = span;
            self.timer = at;
        }
    }

    pub fn timer(&self) -> Micros {
        self.timer
    }

    pub fn on_timer(&mut self, at: Micros, outbox: &mut Outbox) {
        let presses = |&(from, to): &(Micros, Micros)| from <= at && at < to;
        let by = self.spans.iter().position(presses);
        if let Some(by) = by {
            self.by = ResidentId::of(by);
        }
        if by.is_some() != self.pressed {
            (self.pressed, self.since) = (by.is_some(), at);
        }
        let says_at = if self.pressed == self.says_on { NEVER } else { self.since.saturating_add(self.delay) };
        if says_at <= at {
            self.says_on = self.pressed;
            outbox.say(if self.pressed { Value::On } else { Value::Off }, Some(self.by), self.since, Trigger::Movement);
        }
        let changes = self.spans.iter().flat_map(|&(from, to)| [from, to]).filter(|&change| change > at);
        let says_at = if says_at > at { says_at } else { NEVER };
        self.timer = changes.fold(says_at, Micros::min);
    }

    /// From when until when a stride presses a mat: until it is told what follows, if it ends there.
    fn crossing(&self, from: Point, to: Point, begin: Micros, end: Micros) -> (Micros, Micros) {
        let Some((enter, leave)) = geometry::segment_inside_convex(&self.outline, from, to) else { return NOT };
        let instant = |share: f64| begin + libm::round(share * (end - begin) as f64) as Micros;
        let span =
            (if enter > 0.0 { instant(enter) } else { Micros::MIN }, if leave < 1.0 { instant(leave) } else { NEVER });
        if span.0 < span.1 { span } else { NOT }
    }
}

/// The span of somebody who does not press it.
const NOT: (Micros, Micros) = (NEVER, NEVER);
