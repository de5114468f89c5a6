//! Pulses: what a wall sensor with alternating positive and negative zones makes of movement.
//!
//! Behind each facet of the lens lie a positive and a negative element. A warm body that comes into a zone
//! makes a pulse of that zone's sign; the electronics count pulses of alternating sign.
//!
//! We assume that each blade of the fan is one zone, its sign alternating from blade to blade and from row to
//! row; that coming to touch a zone's beam is the pulse; and that `pulses` of alternating sign within
//! `window` make a detection, the last of them being its instant. A stir is seen where it spans at
//! least one zone's pitch.
//!
//! Which beams each body touches is kept from slice to slice, so that a beam which is still touched makes
//! no second pulse. Pulses of all bodies are counted together, in order of time: the sensor cannot tell
//! people apart.
//!
//! Left out: the shape and height of a pulse, and so pulses that cancel out or that are too quick or too
//! slow for the amplifier (0.4 to 10 Hz).

use super::motion::{Level, Motion};
use crate::geometry::Point;
use crate::stride::{self, Beam, Stride};
use crate::time::Micros;

/// What one sensor has counted.
#[derive(Clone, Debug)]
pub struct Pulses {
    pub sensor: usize,
    /// For each body the beams that it touches, by their index among the sensor's beams.
    touching: Vec<Vec<u32>>,
    /// The instants of the latest pulses of alternating sign, and the sign of the last.
    chain: Vec<Micros>,
    last_positive: bool,
    /// The pulses and the detections of the present slice.
    pulses: Vec<Pulse>,
    detections: Vec<Pulse>,
    /// Spare room for `touching`.
    still: Vec<u32>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Pulse {
    at: Micros,
    beam: u32,
    body: u32,
    positive: bool,
}

impl Pulses {
    pub fn new(sensor: usize, bodies: usize) -> Pulses {
        Pulses {
            sensor,
            touching: vec![Vec::new(); bodies],
            chain: Vec::new(),
            last_positive: false,
            pulses: Vec::new(),
            detections: Vec::new(),
            still: Vec::new(),
        }
    }

    /// Forgets the pulses of the last slice, not what is touched.
    pub fn begin_slice(&mut self) {
        self.pulses.clear();
        self.detections.clear();
    }

    /// The body is where the sensor sees nothing.
    pub fn leave(&mut self, body: u32) {
        self.touching[body as usize].clear();
    }

    /// The body is at `at` and touches what it touches there.
    pub fn settle(&mut self, body: u32, beams: &[Beam], at: Point, radius: f64) {
        let touching = &mut self.touching[body as usize];
        touching.clear();
        touching.extend((0u32..).zip(beams).filter(|(_, beam)| stride::touches(beam, at, radius)).map(|(i, _)| i));
    }

    /// Notes the pulses of a body that walks from `from` until `end`.
    #[allow(clippy::too_many_arguments, reason = "a stride, what it meets, and when")]
    pub fn walk(
        &mut self,
        body: u32,
        stride: &Stride,
        beams: &[Beam],
        motion: &Motion,
        radius: f64,
        from: Micros,
        end: Micros,
    ) {
        let touching = &mut self.touching[body as usize];
        self.still.clear();
        for (index, beam) in (0u32..).zip(beams) {
            let Some(at) = stride.first_touch(beam, radius, from).filter(|&at| at < end) else { continue };
            if at > from || !touching.contains(&index) {
                let positive = motion.blades[beam.number as usize].positive;
                self.pulses.push(Pulse { at, beam: index, body, positive });
            }
            if stride::touches(beam, stride.position(end), radius) {
                self.still.push(index);
            }
        }
        std::mem::swap(touching, &mut self.still);
    }

    /// Counts the pulses of the slice, of all bodies, in order of time.
    pub fn count(&mut self, motion: &Motion) {
        let Level::Zones { pulses, window, .. } = motion.level else { return };
        self.pulses.sort_unstable();
        for &pulse in &self.pulses {
            if pulse.positive == self.last_positive {
                self.chain.clear();
            }
            self.last_positive = pulse.positive;
            self.chain.push(pulse.at);
            self.chain.retain(|&at| pulse.at - at <= window);
            if self.chain.len() >= pulses as usize {
                self.detections.push(pulse);
                self.chain.remove(0);
            }
        }
    }

    /// The first instant of the slice, from `from` on, at which this body's pulse made a detection.
    pub fn first_detection(&self, body: u32, from: Micros) -> Option<Micros> {
        self.detections.iter().find(|pulse| pulse.body == body && pulse.at >= from).map(|pulse| pulse.at)
    }
}
