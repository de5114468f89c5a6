//! One radio channel for all sensors, on which no sensor listens before sending.
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
use crate::link::form::RadioFile;
use crate::numbers::Numbers;
use crate::time::{RunTime, Span};

/// The channel, with what is on the air or was so a moment ago.
#[derive(Clone, Debug)]
pub struct Radio {
    copies: u32,
    frame: Span,
    /// From the beginning of a copy to that of the next.
    period: Span,
    /// A message that would have to wait longer is forgotten.
    longest_wait: Span,
    on_air: Vec<Sending>,
}

/// A message on the air: sender and start.
#[derive(Clone, Copy, Debug)]
struct Sending {
    sensor: SensorId,
    begin: RunTime,
}

crate::numbers! {
    /// Longest wait of a message for its own sensor to be free. A message that would wait longer is dropped.
    static LONGEST_WAIT_S = "radio.longest_wait": 5.0, "s", [0.0, 600.0];
}

impl Radio {
    /// A silent channel, with the frames of a file and the numbers of a scenario.
    pub fn new(file: &RadioFile, numbers: &Numbers) -> Radio {
        let [frame, gap, longest_wait] =
            [file.frame_s, file.gap_s, numbers.of(&LONGEST_WAIT_S)].map(Span::from_seconds);
        Radio { copies: file.copies, frame, period: frame + gap, longest_wait, on_air: Vec::new() }
    }

    /// The instant at which a sensor begins to send a new message, if ever. All earlier messages have been given
    /// before.
    pub fn begin(&mut self, sensor: SensorId, at: RunTime) -> Option<RunTime> {
        let (whole, frame) = (self.period * i64::from(self.copies), self.frame);
        self.on_air.retain(|sending| sending.begin + whole > at - frame);
        let own = self.on_air.iter().filter(|sending| sending.sensor == sensor);
        let begin = own.map(|sending| sending.begin + whole).fold(at, RunTime::max);
        if begin - at > self.longest_wait {
            return None;
        }
        self.on_air.push(Sending { sensor, begin });
        Some(begin)
    }

    /// The end of a copy of a message that began at `begin`; `None` without such a copy.
    pub fn end(&self, begin: RunTime, copy: u32) -> Option<RunTime> {
        (copy < self.copies).then(|| begin + i64::from(copy) * self.period + self.frame)
    }

    /// Whether no other sensor's copy was on the air in any part of this one, which has just ended.
    pub fn is_clean(&self, sensor: SensorId, begin: RunTime, copy: u32) -> bool {
        let frame = begin + i64::from(copy) * self.period;
        !self.on_air.iter().any(|other| other.sensor != sensor && self.overlaps(frame, other.begin))
    }

    /// Whether a copy that begins at `frame` meets one of a message that began at `begin`.
    fn overlaps(&self, frame: RunTime, begin: RunTime) -> bool {
        let before = (frame - begin).div_euclid(self.period);
        let meets = |copy: i64| {
            (0..i64::from(self.copies)).contains(&copy) && (frame - begin - copy * self.period).abs() < self.frame
        };
        meets(before) || meets(before + 1)
    }

    /// From when a sensor has something to say until it has been received, at most.
    pub fn longest(&self) -> Span {
        self.longest_wait + self.period * i64::from(self.copies)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ms(ms: i64) -> RunTime {
        RunTime::START + Span::from_millis(ms)
    }

    /// The clean copies of two messages, of which the second begins a number of milliseconds later.
    fn clean(later: i64) -> [Vec<bool>; 2] {
        let mut radio = Radio::new(&RadioFile::default(), &Numbers::default());
        let begins = [(0, 0), (1, later)].map(|(sensor, at)| radio.begin(SensorId(sensor), ms(at)).unwrap());
        [0, 1].map(|sensor| (0..5).map(|copy| radio.is_clean(SensorId(sensor as u32), begins[sensor], copy)).collect())
    }

    #[test]
    fn two_messages_spoil_each_other_where_they_overlap() {
        let none = vec![false; 5];
        assert_eq!(clean(0), [none.clone(), none.clone()]);
        assert_eq!(clean(67), [none.clone(), none.clone()]);
        // Their copies alternate, but a silence is shorter than a copy.
        let first = |copies: usize| (0..5).map(|copy| copy < copies).collect::<Vec<_>>();
        let last = |copies: usize| first(copies).into_iter().rev().collect::<Vec<_>>();
        assert_eq!(clean(68), [first(1), last(1)]);
        assert_eq!(clean(175), [first(1), last(1)]);
        assert_eq!(clean(176), [first(2), last(2)]);
        assert_eq!(clean(499), [first(4), last(4)]);
        assert_eq!(clean(500), [first(5), last(5)]);
    }

    #[test]
    fn a_sensor_says_one_thing_after_the_other() {
        let mut radio = Radio::new(&RadioFile::default(), &Numbers::default());
        let begins: Vec<_> = (0..12).map(|_| radio.begin(SensorId(3), RunTime::START)).collect();
        assert_eq!(begins[..3], [0, 540, 1080].map(|at| Some(ms(at))));
        // Ten of them wait no longer than five seconds.
        assert_eq!(begins.iter().flatten().count(), 10);
        assert!(radio.is_clean(SensorId(3), RunTime::START, 4));
        assert_eq!((radio.end(ms(540), 4), radio.end(ms(540), 5)), (Some(ms(1040)), None));
    }
}
