//! Sensors that have fallen silent, and the measures that cannot be taken without them.
//!
//! A day follows from the rows up to its end: if a sensor dies, earlier days keep their values. A measure that needs a room, or the
//! entrance, is not known already on the first day on which all sensors there are quiet, though one reports on most days.

use super::measure::{DailyMeasure, Needs};
use super::rooms::{Purpose, SensorRooms};
use super::timeline::within_h;
use super::values::SilentSensor;
use crate::signs::Kind;
use homebody_core::time::{DAY, Interval, Span, WallTime};

/// A silent sensor sends nothing for this long while a person is at home, and for this many times its longest silence,
/// as in `inspect` (our choice).
const SILENT: Span = DAY.times(2);
const SILENT_TIMES: i64 = 3;
/// Silence after which a sensor that reports on most days is doubted, and factor on its longest silence before.
const DOUBTED: Span = DAY;
const DOUBTED_TIMES: i64 = 2;
/// Days with events that a sensor of a used or opened thing needs before a silence counts, and their share of all days
/// (our choice): a drawer may stay closed for a week.
const LEAST_DAYS: i64 = 4;
const OF_DAYS: (i64, i64) = (3, 4);

/// The reports of sensors so far, and their silences.
#[derive(Default)]
pub struct Listening {
    sensors: Vec<SensorReports>,
    over: Vec<SensorSilence>,
}

#[derive(Clone, Default)]
struct SensorReports {
    before: Option<WallTime>,
    /// The longest time without a report that was not a silence.
    longest: Span,
    first_day: i64,
    days: i64,
    /// The day at whose end the current silence was first known.
    told: Option<WallTime>,
}

/// A silence of a sensor. `told` is the first instant at which it is certain.
struct SensorSilence {
    sensor: usize,
    span: Interval<WallTime>,
    told: WallTime,
}

impl SensorReports {
    /// The time without a report, less absences, if it is longer than ever.
    fn quiet(&self, at: WallTime, away: &[Interval<WallTime>]) -> Option<Span> {
        let quiet = self.before.map(|since| Interval::new(since, at)).filter(|quiet| quiet.length() > self.longest)?;
        let away = (within_h(away, quiet) * DAY.micros() as f64 / 24.0) as i64;
        Some(quiet.length() - Span::from_micros(away))
    }

    fn speaks_on_most_days(&self) -> bool {
        let so_far = self.before.map_or(0, WallTime::day_number) - self.first_day + 1;
        self.days >= LEAST_DAYS && self.days * OF_DAYS.1 >= so_far * OF_DAYS.0
    }

    /// The silence at an instant, if there is one.
    fn silence(&self, sensor: usize, kind: Kind, at: WallTime, away: &[Interval<WallTime>]) -> Option<SensorSilence> {
        let quiet = self.quiet(at, away)?;
        let least = SILENT.max(self.longest * SILENT_TIMES);
        let is_regular = kind == Kind::Motion && self.longest > Span::ZERO || self.speaks_on_most_days();
        let since =
            self.before.filter(|_| quiet >= least && is_regular && !matches!(kind, Kind::Reading | Kind::Other))?;
        Some(SensorSilence { sensor, span: Interval::new(since, at), told: self.told.unwrap_or(at) })
    }
}

impl Listening {
    pub fn new(sensors: usize) -> Listening {
        Listening { sensors: vec![SensorReports::default(); sensors], over: Vec::new() }
    }

    pub fn take(&mut self, at: WallTime, sensor: usize, kind: Kind, away: &[Interval<WallTime>]) {
        let of = &mut self.sensors[sensor];
        match of.silence(sensor, kind, at, away) {
            Some(silence) => self.over.push(silence),
            None => {
                let quiet = of.quiet(at, away).unwrap_or_default();
                of.longest = of.longest.max(quiet);
            }
        }
        of.told = None;
        let day = at.day_number();
        match of.before.replace(at) {
            None => (of.first_day, of.days) = (day, 1),
            Some(before) => of.days += i64::from(before.day_number() < day),
        }
    }

    /// The missing sensors of a day, as known when it ends.
    pub fn on_day(&mut self, day: Interval<WallTime>, kinds: &[Kind], away: &[Interval<WallTime>]) -> MissingSensors {
        let over = self.over.iter().rev().take_while(|silence| silence.span.end >= day.begin);
        let mut silent: Vec<usize> = over.map(|silence| silence.sensor).collect();
        let mut doubted = Vec::new();
        for (sensor, (of, kind)) in self.sensors.iter_mut().zip(kinds).enumerate() {
            if of.silence(sensor, *kind, day.end, away).is_some() {
                of.told = of.told.or(Some(day.begin));
                silent.push(sensor);
            } else if *kind != Kind::Reading && of.speaks_on_most_days() {
                let least = DOUBTED.max(of.longest * DOUBTED_TIMES);
                doubted.extend(of.quiet(day.end, away).filter(|quiet| *quiet >= least).map(|_| sensor));
            }
        }
        let spoke = self.sensors.iter().map(|of| of.before.is_some_and(|before| before >= day.begin)).collect();
        MissingSensors { silent, doubted, spoke }
    }

    /// All silences, including those that last at `now`.
    pub fn silent_sensors(
        &self,
        ids: &[String],
        kinds: &[Kind],
        away: &[Interval<WallTime>],
        now: WallTime,
    ) -> Vec<SilentSensor> {
        let told = |silence: &SensorSilence, speaks_again: bool| {
            let [since, until, told] = [silence.span.begin, silence.span.end, silence.told].map(WallTime::date);
            SilentSensor { sensor: ids[silence.sensor].clone(), since, told, until: speaks_again.then_some(until) }
        };
        let lasting = self.sensors.iter().zip(kinds).enumerate().filter(|(_, (of, _))| of.told.is_some());
        let lasting = lasting.filter_map(|(sensor, (of, kind))| of.silence(sensor, *kind, now, away));
        let over = self.over.iter().filter(|silence| kinds[silence.sensor] != Kind::Reading);
        over.map(|silence| told(silence, true)).chain(lasting.map(|silence| told(&silence, false))).collect()
    }
}

pub struct MissingSensors {
    silent: Vec<usize>,
    doubted: Vec<usize>,
    spoke: Vec<bool>,
}

impl MissingSensors {
    pub fn hinders(&self, measure: &DailyMeasure, rooms: &SensorRooms, at_entrance: &dyn Fn(usize) -> bool) -> bool {
        let needs = |sensor: usize| {
            needs(measure, rooms.of_sensors[sensor].map(|room| rooms.purpose(room)), at_entrance(sensor))
        };
        // Another sensor that the measure needs may report.
        let is_told = || (0..self.spoke.len()).any(|sensor| self.spoke[sensor] && needs(sensor) == Some(true));
        self.silent.iter().any(|&sensor| needs(sensor).unwrap_or(true))
            || self.doubted.iter().any(|&sensor| needs(sensor) == Some(true)) && !is_told()
    }
}

/// A measure needs a sensor, by the room of the sensor; `None` for a measure that needs all of them.
fn needs(measure: &DailyMeasure, room: Option<Purpose>, is_at_entrance: bool) -> Option<bool> {
    match measure.needs {
        Needs::AllSensors => None,
        Needs::Room(purpose) => Some(room == Some(purpose)),
        Needs::Entrance => Some(is_at_entrance),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_core::time::HOUR;
    use std::ops::Range;

    fn at(hour: i64) -> WallTime {
        WallTime::EPOCH + hour * HOUR
    }

    /// Ten days. One sensor reports each hour, the other each second hour, except for a time.
    fn listened(quiet: Range<i64>, kind: Kind, away: &[Interval<WallTime>]) -> Listening {
        let mut listening = Listening::new(2);
        for hour in 0..240 {
            listening.take(at(hour), 0, kind, away);
            if hour % 2 == 0 && !quiet.contains(&hour) {
                listening.take(at(hour), 1, kind, away);
            }
        }
        listening
    }

    fn found(quiet: Range<i64>, away: &[Interval<WallTime>]) -> Vec<(usize, i64, i64)> {
        found_of(quiet, Kind::Motion, away)
    }

    fn found_of(quiet: Range<i64>, kind: Kind, away: &[Interval<WallTime>]) -> Vec<(usize, i64, i64)> {
        let listening = listened(quiet, kind, away);
        let lasting =
            listening.sensors.iter().enumerate().filter_map(|(sensor, of)| of.silence(sensor, kind, at(240), away));
        let all = listening
            .over
            .iter()
            .map(|silence| (silence.sensor, silence.span))
            .chain(lasting.map(|silence| (silence.sensor, silence.span)));
        let hours = |span: Interval<WallTime>| span.map(|at| at.since_zero() / HOUR);
        all.map(|(sensor, span)| (sensor, hours(span).begin, hours(span).end)).collect()
    }

    #[test]
    fn a_sensor_that_says_nothing_for_days_is_silent() {
        assert_eq!(found(100..240, &[]), [(1, 98, 240)]);
        assert_eq!(found(100..160, &[]), [(1, 98, 160)]);
        assert_eq!(found(100..130, &[]), []);
        // A contact, if it has spoken on days enough.
        assert_eq!(found_of(100..240, Kind::Contact, &[]), [(1, 98, 240)]);
        assert_eq!(found_of(70..240, Kind::Contact, &[]), []);
        assert_eq!(found(70..240, &[]), [(1, 68, 240)]);
        // In an empty home it does not report.
        assert_eq!(found(100..160, &[Interval::new(at(101), at(150))]), []);
    }

    #[test]
    fn a_day_is_doubted_on_which_a_sensor_that_speaks_daily_says_nothing() {
        let mut listening = Listening::new(1);
        (0..110).for_each(|hour| listening.take(at(hour), 0, Kind::Motion, &[]));
        let mut lacks = |until: i64| {
            let day = Interval::new(at(until - 24), at(until));
            let lacking = listening.on_day(day, &[Kind::Motion], &[]);
            (lacking.silent, lacking.doubted)
        };
        assert_eq!(lacks(120), (vec![], vec![]));
        assert_eq!(lacks(144), (vec![], vec![0]), "nothing was said for a day");
        assert_eq!(lacks(168), (vec![0], vec![]), "nor for two");
    }
}
