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

use crate::geometry::Point;
use crate::sensors::looking::DetectionLevel;
use crate::sensors::motion::Motion;
use crate::stride::{self, Beam, Stride};
use crate::time::RunTime;

/// The pulses that one sensor has counted.
#[derive(Clone, Debug)]
pub struct Pulses {
    /// The sensor that counts, by its index in the home.
    pub sensor: usize,
    /// For each body the beams that it touches, by their index among the sensor's beams.
    touching: Vec<Vec<u32>>,
    /// The instants of the latest pulses of alternating sign, and the sign of the last.
    chain: Vec<RunTime>,
    last_positive: bool,
    pulses: Vec<Pulse>,
    detections: Vec<Pulse>,
    /// Spare room for `touching`.
    still: Vec<u32>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Pulse {
    at: RunTime,
    beam: u32,
    body: u32,
    positive: bool,
}

impl Pulses {
    /// A sensor without pulses so far, in a home with a number of bodies.
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
        from: RunTime,
        end: RunTime,
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
        let DetectionLevel::Zones { pulses, window, .. } = motion.level else { return };
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
    pub fn first_detection(&self, body: u32, from: RunTime) -> Option<RunTime> {
        self.detections.iter().find(|pulse| pulse.body == body && pulse.at >= from).map(|pulse| pulse.at)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry;
    use crate::sensors::motion::Blade;
    use crate::time::{SECOND, Span};

    const RADIUS_M: f64 = 0.2;
    /// When, in microseconds, a body that walks north 2 m before the lens at 1 m/s from 3 m south of it on comes to the zones at -45, 0
    /// and 45 degrees: at y = -2 - 0.2 * sqrt(2), -0.2 and 2 - 0.2 * sqrt(2).
    const CROSSED: [i64; 3] = [717_158, 2_800_000, 4_717_158];

    /// A lens at the origin that looks east, with a positive zone between two others or the other way round.
    fn motion(pulses: u32, window: Span, middle_positive: bool) -> Motion {
        let blade = |bearing_deg: f64| Blade {
            direction: geometry::direction(bearing_deg),
            least_depression: f64::NEG_INFINITY,
            greatest_depression: f64::INFINITY,
            positive: middle_positive == (bearing_deg == 0.0),
        };
        let blades = [-45.0, 0.0, 45.0].map(blade).to_vec();
        let level = DetectionLevel::Zones { pulses, window, pitch_rad: std::f64::consts::FRAC_PI_4 };
        Motion { lens: Point::ZERO, height_m: 1.65, reach_m: 5.0, blades, level }
    }

    fn beams(motion: &Motion) -> Vec<Beam> {
        let blades = (0..).zip(&motion.blades);
        blades
            .map(|(number, blade)| Beam { start: Point::ZERO, direction: blade.direction, length: 5.0, number })
            .collect()
    }

    fn walk(from: (f64, f64), to: (f64, f64), begin: i64) -> Stride {
        let (from, to) = (Point::from(from), Point::from(to));
        let begin = RunTime::from_micros(begin);
        Stride::new(from, to, begin, begin + Span::from_seconds(from.distance(to)))
    }

    /// The instants, in microseconds, of the detections of bodies that walk one after another or at once, in slices of a tenth of a second.
    fn detections(motion: &Motion, walks: &[(u32, Stride)]) -> Vec<(i64, u32)> {
        let mut pulses = Pulses::new(0, 2);
        let mut found = Vec::new();
        let end = walks.iter().map(|(_, stride)| stride.end).max().unwrap_or_default();
        for from in (0..end.micros()).step_by(100_000).map(RunTime::from_micros) {
            pulses.begin_slice();
            for (body, stride) in walks.iter().filter(|(_, stride)| (stride.begin..stride.end).contains(&from)) {
                pulses.walk(*body, stride, &beams(motion), motion, RADIUS_M, from, from + SECOND / 10);
            }
            pulses.count(motion);
            found.extend(pulses.detections.iter().map(|pulse| (pulse.at.micros(), pulse.body)));
        }
        found
    }

    #[test]
    fn which_sign_comes_first_does_not_matter() {
        let across = [(0, walk((2.0, -3.0), (2.0, 3.0), 0))];
        let found = detections(&motion(2, Span::from_millis(2_100), true), &across);
        assert_eq!(found, [(CROSSED[1], 0), (CROSSED[2], 0)]);
    }

    #[test]
    fn two_pulses_of_one_sign_are_one() {
        // Over the southern zone and back.
        let there_and_back = [(0, walk((2.0, -3.0), (2.0, -1.5), 0)), (0, walk((2.0, -1.5), (2.0, -3.0), 1_500_000))];
        // Left 0.283 m beyond y = -2 and come to again from there, 0.217 m after turning.
        assert_eq!(detections(&motion(1, SECOND, false), &there_and_back), [(717_158, 0), (1_717_158, 0)]);
        assert_eq!(detections(&motion(2, 60 * SECOND, false), &there_and_back), []);
    }

    #[test]
    fn a_zone_that_is_touched_already_makes_no_pulse() {
        // A quarter of a metre before the lens all three zones are less than 0.2 m away.
        let (motion, stride) = (motion(1, SECOND, false), walk((0.25, 0.0), (3.0, 0.0), 0));
        let mut pulses = Pulses::new(0, 1);
        let pulses_of_walk = |pulses: &mut Pulses| {
            pulses.begin_slice();
            pulses.walk(0, &stride, &beams(&motion), &motion, RADIUS_M, RunTime::START, stride.end);
            pulses.pulses.len()
        };
        pulses.settle(0, &beams(&motion), stride.from, RADIUS_M);
        assert_eq!(pulses_of_walk(&mut pulses), 0);
        pulses.leave(0);
        assert_eq!(pulses_of_walk(&mut pulses), 3);
    }

    #[test]
    fn the_first_detection_is_the_bodys_own_and_not_before_the_instant_asked_for() {
        let motion = motion(1, SECOND, false);
        let stride = walk((2.0, -3.0), (2.0, 3.0), 0);
        let mut pulses = Pulses::new(0, 2);
        pulses.walk(1, &stride, &beams(&motion), &motion, RADIUS_M, RunTime::START, stride.end);
        pulses.count(&motion);
        let first_detection =
            |body, from| pulses.first_detection(body, RunTime::from_micros(from)).map(RunTime::micros);
        assert_eq!(first_detection(1, 0), Some(CROSSED[0]));
        assert_eq!(first_detection(1, CROSSED[0]), Some(CROSSED[0]));
        assert_eq!(first_detection(1, CROSSED[0] + 1), Some(CROSSED[1]));
        assert_eq!(first_detection(1, CROSSED[2] + 1), None);
        assert_eq!(first_detection(0, 0), None);
    }
}
