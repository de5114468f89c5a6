//! Motion sensors that stay on for a hold time after the last movement that they see.
//!
//! Such a sensor reports `ON` once for all movements that follow each other within its hold time, often 10 s to some minutes. So its
//! reports do not show the length of a movement. Its last movement was one hold time before its `OFF`, and until then no two were farther apart.
//!
//! The hold time of a sensor is the second shortest of its times on so far. A single movement keeps it on for that long. With
//! less than 10 s its `ON` says enough: those of two CASAS homes have 1.1 s. `docs/reference/devices.md` lists devices that report again after 10 s to a minute.

use crate::rows::StateRow;
use crate::signs::{Kind, Says};
use homebody_core::time::{MINUTE, SECOND, Span, WallTime};

/// Hold time below which a sensor hides no movement (our choice).
const SHORTEST: Span = SECOND.times(10);

/// Longest hold time: a sensor that is always on for longer sees movement all the time (our choice).
pub const LONGEST: Span = MINUTE.times(5);

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct HiddenMovement {
    pub at: WallTime,
    /// The sensor, by its number in the log.
    pub sensor: u32,
    /// Time by which it may have been earlier: 0 for the last one before an `OFF`, or else the hold time.
    pub within: Span,
}

#[derive(Clone, Debug, Default)]
pub struct HoldTimes {
    sensors: Vec<SensorHold>,
    on: Vec<u32>,
    /// Instant before which no movement is known that is not yet returned.
    due: WallTime,
    hides_any: bool,
}

#[derive(Clone, Copy, Debug)]
struct SensorHold {
    /// The begin of the current ON, and its last movement so far.
    on: Option<(WallTime, WallTime)>,
    shortest: [Span; 2],
}

impl SensorHold {
    /// The hold time, unless its reports show all.
    fn hold(&self) -> Option<Span> {
        let is_known = (SHORTEST..Span::MAX).contains(&self.shortest[1]);
        is_known.then(|| self.shortest[1].min(LONGEST))
    }

    /// The next movement that is certain while it is still on at `now`.
    fn next(&self, now: WallTime) -> Option<WallTime> {
        let (hold, (_, last)) = (self.hold()?, self.on?);
        (last + hold <= now - hold).then_some(last + hold)
    }
}

impl HoldTimes {
    pub fn new(sensors: usize) -> HoldTimes {
        let sensor = SensorHold { on: None, shortest: [Span::MAX; 2] };
        HoldTimes { sensors: vec![sensor; sensors], on: Vec::new(), due: WallTime::MAX, hides_any: false }
    }

    pub fn hold(&self, sensor: usize) -> Option<Span> {
        self.sensors.get(sensor)?.hold()
    }

    pub fn hide_any(&self) -> bool {
        self.hides_any
    }

    /// Takes a row, in the order of time. Adds the movements that are known with it: none lies more than [`LONGEST`] before it.
    pub fn take(&mut self, row: &StateRow, kind: Kind, found: &mut Vec<HiddenMovement>) {
        self.pass(row.at, found);
        if kind != Kind::Motion {
            return;
        }
        let sensor = &mut self.sensors[row.sensor as usize];
        match row.said.says {
            Says::Begins if row.said.unknown_from.is_some() || sensor.on.is_none() => {
                if sensor.on.replace((row.at, row.at)).is_none() {
                    self.on.push(row.sensor);
                }
            }
            // It reports again that it is on: its row is a sign of its own.
            Says::Begins => sensor.on = sensor.on.map(|(since, _)| (since, row.at)),
            says => {
                if says == Says::Ends && row.said.unknown_from.is_none() {
                    sensor.end(row, found);
                    self.hides_any |= sensor.hold().is_some();
                }
                sensor.on = None;
                self.on.retain(|on| *on != row.sensor);
            }
        }
        self.due = self.on.iter().filter_map(|on| self.sensors[*on as usize].due()).min().unwrap_or(WallTime::MAX);
    }

    /// Adds the movements that are known as time passes without a row.
    pub fn pass(&mut self, now: WallTime, found: &mut Vec<HiddenMovement>) {
        if now < self.due {
            return;
        }
        self.due = WallTime::MAX;
        for &number in &self.on {
            let sensor = &mut self.sensors[number as usize];
            while let Some(at) = sensor.next(now) {
                sensor.on = sensor.on.map(|(since, _)| (since, at));
                found.push(HiddenMovement { at, sensor: number, within: sensor.hold().unwrap_or_default() });
            }
            self.due = self.due.min(sensor.due().unwrap_or(WallTime::MAX));
        }
    }

    pub fn end_all(&mut self) {
        self.sensors.iter_mut().for_each(|sensor| sensor.on = None);
        self.on.clear();
        self.due = WallTime::MAX;
    }
}

impl SensorHold {
    /// Instant until which no further movement of it is certain.
    fn due(&self) -> Option<WallTime> {
        let (hold, (_, last)) = (self.hold()?, self.on?);
        Some(last + 2 * hold)
    }

    /// Learns from an `OFF`, and adds the last movement before it.
    fn end(&mut self, row: &StateRow, found: &mut Vec<HiddenMovement>) {
        let Some((since, last)) = self.on else { return };
        let length = row.at - since;
        if length < self.shortest[1] {
            self.shortest[1] = length;
            self.shortest.sort_unstable();
        }
        let Some(hold) = self.hold() else { return };
        let at = row.at - hold;
        if at > last {
            found.push(HiddenMovement { at, sensor: row.sensor, within: Span::ZERO });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample::at;
    use crate::signs::RowMeaning;

    /// The movements by rows of one sensor: the seconds of each `ON` and `OFF` in turn.
    fn movements(on_off: &[(i64, i64)]) -> (Vec<i64>, Option<i64>) {
        let (mut holds, mut found) = (HoldTimes::new(1), Vec::new());
        let said = |says| RowMeaning { says, unknown_from: None, is_restored: false };
        for &(on, off) in on_off {
            for (s, says) in [(on, Says::Begins), (off, Says::Ends)] {
                holds.take(&StateRow { at: at(s), sensor: 0, said: said(says) }, Kind::Motion, &mut found);
            }
        }
        (seconds(&found), holds.hold(0).map(|hold| hold / SECOND))
    }

    fn seconds(found: &[HiddenMovement]) -> Vec<i64> {
        found.iter().map(|movement| movement.at.since_zero() / SECOND).collect()
    }

    #[test]
    fn the_last_movement_is_one_hold_time_before_the_end() {
        assert_eq!(movements(&[(0, 90), (200, 290), (400, 500)]), (vec![410], Some(90)));
        // Before it no two are farther apart than the hold time.
        assert_eq!(movements(&[(0, 90), (200, 290), (400, 800)]).0, [490, 580, 670, 710]);
        // One short time alone gives no hold time.
        assert_eq!(movements(&[(0, 2), (200, 290), (400, 490)]).1, Some(90));
    }

    #[test]
    fn a_short_hold_time_hides_nothing() {
        assert_eq!(movements(&[(0, 1), (20, 22), (40, 60)]), (vec![], None));
    }

    #[test]
    fn movements_of_a_sensor_that_stays_on_are_known_as_time_passes() {
        let (mut holds, mut found) = (HoldTimes::new(1), Vec::new());
        let said = |says| RowMeaning { says, unknown_from: None, is_restored: false };
        let rows = [(0, Says::Begins), (60, Says::Ends), (100, Says::Begins), (160, Says::Ends), (300, Says::Begins)];
        for (s, says) in rows {
            holds.take(&StateRow { at: at(s), sensor: 0, said: said(says) }, Kind::Motion, &mut found);
        }
        assert!(found.is_empty());
        holds.pass(at(419), &mut found);
        assert!(found.is_empty());
        holds.pass(at(480), &mut found);
        assert_eq!(seconds(&found), [360, 420]);
        holds.end_all();
        holds.pass(at(900), &mut found);
        assert_eq!(found.len(), 2);
    }
}
