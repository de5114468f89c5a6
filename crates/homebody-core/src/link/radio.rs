//! One radio channel for all sensors, on which nobody listens before sending.
//!
//! The device sends every message several times, copy after copy with a silence between, and nothing answers (X10: five
//! copies of 68 ms with 40 ms between; dokumen.tips, X10 RF receiver; rtl_433, `x10_rf.c`).
//!
//! We assume that all copies are of one length, that every sensor of the home is as loud at the receiver as any other,
//! and that a copy is received unless another sensor's copy is on the air in any part of it. A sensor that has more to
//! say while it sends says it afterwards, but does not remember it for longer than some seconds.
//!
//! A message is received at the end of its first clean copy, and lost if it has none. When a copy ends, all that was on
//! the air meanwhile is known, so nothing has to be taken back.
//!
//! Left out: the stronger of two that is received all the same, neighbours on the same channel, and the echo of a
//! message on the power line. Noise is the link's loss.

use crate::ids::SensorId;
use crate::numbers::Numbers;
use crate::scenario::link::RadioFile;
use crate::time::{Micros, micros};

/// The channel, with what is on the air or was so a moment ago.
#[derive(Clone, Debug)]
pub struct Radio {
    copies: u32,
    frame: Micros,
    /// From the beginning of a copy to that of the next.
    period: Micros,
    /// A message that would have to wait longer is forgotten.
    longest_wait: Micros,
    on_air: Vec<Sending>,
}

/// A message on the air: whose, and since when.
#[derive(Clone, Copy, Debug)]
struct Sending {
    sensor: SensorId,
    begin: Micros,
}

crate::numbers! {
    /// Longest wait of a message for its own sensor to be free. A message that would wait longer is dropped.
    static LONGEST_WAIT_S = "radio.longest_wait": 5.0, "s", [0.0, 600.0];
}

impl Radio {
    /// A silent channel, with the frames of a file and the numbers of a scenario.
    pub fn new(file: &RadioFile, numbers: &Numbers) -> Radio {
        let (frame, longest_wait) = (micros(file.frame_s), micros(numbers.of(&LONGEST_WAIT_S)));
        Radio { copies: file.copies, frame, period: frame + micros(file.gap_s), longest_wait, on_air: Vec::new() }
    }

    /// A sensor has something to say: when it begins to send it, if ever. What came before has been told before.
    pub fn begin(&mut self, sensor: SensorId, at: Micros) -> Option<Micros> {
        let (whole, frame) = (self.period * Micros::from(self.copies), self.frame);
        self.on_air.retain(|sending| sending.begin + whole > at - frame);
        let own = self.on_air.iter().filter(|sending| sending.sensor == sensor);
        let begin = own.map(|sending| sending.begin + whole).fold(at, Micros::max);
        if begin - at > self.longest_wait {
            return None;
        }
        self.on_air.push(Sending { sensor, begin });
        Some(begin)
    }

    /// When a copy of a message that began at `begin` ends; nothing where there is no such copy.
    pub fn end(&self, begin: Micros, copy: u32) -> Option<Micros> {
        (copy < self.copies).then(|| begin + Micros::from(copy) * self.period + self.frame)
    }

    /// Whether no other sensor's copy was on the air in any part of this one, which has just ended.
    pub fn is_clean(&self, sensor: SensorId, begin: Micros, copy: u32) -> bool {
        let frame = begin + Micros::from(copy) * self.period;
        !self.on_air.iter().any(|other| other.sensor != sensor && self.overlaps(frame, other.begin))
    }

    /// Whether a copy that begins at `frame` meets one of a message that began at `begin`.
    fn overlaps(&self, frame: Micros, begin: Micros) -> bool {
        let before = (frame - begin).div_euclid(self.period);
        let meets = |copy: Micros| {
            (0..Micros::from(self.copies)).contains(&copy) && (frame - begin - copy * self.period).abs() < self.frame
        };
        meets(before) || meets(before + 1)
    }

    /// From when a sensor has something to say until it has been received, at most.
    pub fn longest(&self) -> Micros {
        self.longest_wait + self.period * Micros::from(self.copies)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MS: Micros = 1000;

    /// Which copies of two messages are clean, the second of which begins so much later.
    fn clean(later: Micros) -> [Vec<bool>; 2] {
        let mut radio = Radio::new(&RadioFile::default(), &Numbers::default());
        let begins = [(0, 0), (1, later)].map(|(sensor, at)| radio.begin(SensorId(sensor), at).unwrap());
        [0, 1].map(|sensor| (0..5).map(|copy| radio.is_clean(SensorId(sensor as u32), begins[sensor], copy)).collect())
    }

    #[test]
    fn two_messages_spoil_each_other_where_they_overlap() {
        let none = vec![false; 5];
        assert_eq!(clean(0), [none.clone(), none.clone()]);
        assert_eq!(clean(67 * MS), [none.clone(), none.clone()]);
        // Their copies alternate, but a silence is shorter than a copy.
        let first = |copies: usize| (0..5).map(|copy| copy < copies).collect::<Vec<_>>();
        let last = |copies: usize| first(copies).into_iter().rev().collect::<Vec<_>>();
        assert_eq!(clean(68 * MS), [first(1), last(1)]);
        assert_eq!(clean(175 * MS), [first(1), last(1)]);
        assert_eq!(clean(176 * MS), [first(2), last(2)]);
        assert_eq!(clean(499 * MS), [first(4), last(4)]);
        assert_eq!(clean(500 * MS), [first(5), last(5)]);
    }

    #[test]
    fn a_sensor_says_one_thing_after_the_other() {
        let mut radio = Radio::new(&RadioFile::default(), &Numbers::default());
        let begins: Vec<_> = (0..12).map(|_| radio.begin(SensorId(3), 0)).collect();
        assert_eq!(begins[..3], [Some(0), Some(540 * MS), Some(1080 * MS)]);
        // Ten of them wait no longer than five seconds.
        assert_eq!(begins.iter().flatten().count(), 10);
        assert!(radio.is_clean(SensorId(3), 0, 4));
        assert_eq!((radio.end(540 * MS, 4), radio.end(540 * MS, 5)), (Some(1040 * MS), None));
    }
}
