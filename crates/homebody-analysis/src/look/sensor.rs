use super::overview::{SensorLook, SensorTrouble};
use crate::signs::{Classification, Kind, Says, SensorTally};
use homebody_core::time::{DAY, HOUR, Interval, Span, WallTime};

/// A dead sensor sends nothing for this long before the end of the log, and for this many times its longest silence
/// (our choice).
const DEAD: Span = DAY.times(2);
const DEAD_TIMES: i64 = 3;

/// Time on after which a motion sensor is stuck (our choice).
const STUCK: Span = HOUR.times(6);

/// Number of equal readings, and the time that they span, of a stuck sensor (our choice).
const STUCK_READINGS: u64 = 50;
const STUCK_FOR: Span = DAY;

/// Largest number of values that are counted for a sensor (our choice).
const VALUES: usize = 8;

pub(super) struct Recorder<'a> {
    pub gaps: &'a [Interval<WallTime>],
    /// It stores states as it starts, so that the first row of a sensor may repeat an earlier state.
    pub restores: bool,
}

#[derive(Clone, Default)]
pub(super) struct SensorHistory {
    pub tally: SensorTally,
    rows: u64,
    days: u64,
    day: i64,
    first: WallTime,
    latest: WallTime,
    last: Option<(WallTime, u32)>,
    /// The longest time without a row.
    quiet: Span,
    is_on: bool,
    on_since: WallTime,
    /// The longest time on, and its begin.
    on_longest: (Span, WallTime),
    on_after_on: u64,
    off_without_on: u64,
    ends: u64,
    doubled: u64,
    /// Rows with an unknown state, and rows that restore a state after that.
    unknown: u64,
    restored: u64,
    values: Vec<(u32, u64)>,
    numbers: u64,
    range: Option<[f64; 2]>,
}

impl SensorHistory {
    pub fn take(&mut self, (at, value): (WallTime, u32), (says, number): (Says, Option<f64>), recorder: &Recorder) {
        let said = self.tally.take(at, says, number.is_some(), recorder.gaps);
        let is_first = self.rows == 0 && recorder.restores;
        match self.last {
            Some(last) if last == (at, value) => self.doubled += 1,
            Some((last, _)) => self.quiet = self.quiet.max(at - last),
            None => (self.first, self.latest) = (at, at),
        }
        let day = at.day_number();
        if self.rows == 0 || day != self.day {
            (self.days, self.day) = (self.days + 1, day);
        }
        (self.first, self.latest) = (self.first.min(at), self.latest.max(at));
        self.last = Some((at, value));
        self.rows += 1;
        self.unknown += u64::from(says == Says::Unknown);
        self.restored += u64::from(said.is_restored);
        if let Some(unknown) = said.unknown_from.filter(|_| self.is_on) {
            self.goes_off(unknown);
        }
        match says {
            Says::Begins | Says::Opens if self.is_on => self.on_after_on += 1,
            Says::Begins | Says::Opens => (self.is_on, self.on_since) = (true, at),
            Says::Ends | Says::Closes => {
                self.ends += 1;
                match self.is_on {
                    true => self.goes_off(at),
                    // An end after a stretch that is not known is not missing a beginning.
                    false => self.off_without_on += u64::from(said.unknown_from.is_none() && !is_first),
                }
            }
            Says::Unknown | Says::Else => {}
        }
        if let Some(number) = number.filter(|number| number.is_finite()) {
            self.numbers += u64::from(says == Says::Else);
            let [least, most] = self.range.unwrap_or([number; 2]);
            self.range = Some([least.min(number), most.max(number)]);
        }
        match self.values.iter().position(|(known, _)| *known == value) {
            Some(known) => self.values[known].1 += 1,
            None if self.values.len() < VALUES => self.values.push((value, 1)),
            None => {}
        }
    }

    fn goes_off(&mut self, at: WallTime) {
        self.is_on = false;
        if at - self.on_since > self.on_longest.0 {
            self.on_longest = (at - self.on_since, self.on_since);
        }
    }

    pub fn look(
        &self,
        (id, taken): (&str, Classification),
        name: Option<String>,
        values: &[String],
        by_day: Vec<u32>,
        end: WallTime,
        text: &dyn Fn(WallTime) -> String,
    ) -> SensorLook {
        // One that never says that something ends only begins things, and numbers do neither.
        let is_of_two = self.ends > 0 && self.numbers == 0 && taken.kind != Kind::Other;
        let of_two = |count: u64| if is_of_two { count } else { 0 };
        let mut said: Vec<(String, u64)> = match self.numbers {
            0 => self.values.iter().map(|&(value, times)| (values[value as usize].clone(), times)).collect(),
            _ => Vec::new(),
        };
        said.sort_by_key(|(_, times)| std::cmp::Reverse(*times));
        let days = match by_day.is_empty() {
            true => self.days,
            false => by_day.iter().filter(|&&count| count > 0).count() as u64,
        };
        SensorLook {
            id: id.to_owned(),
            name: name.filter(|name| name != id),
            kind: taken.kind,
            by: taken.by,
            because: taken.because,
            rows: self.rows,
            days,
            by_day,
            first: text(self.first),
            last: text(self.latest),
            values: said,
            range: self.range.filter(|_| self.numbers > 0),
            repeated: of_two(self.on_after_on),
            missing: of_two(self.off_without_on),
            doubled: self.doubled,
            unknown: self.unknown,
            restored: self.restored,
            trouble: self.trouble(taken.kind, is_of_two, values, end, text),
        }
    }

    fn trouble(
        &self,
        kind: Kind,
        is_of_two: bool,
        values: &[String],
        end: WallTime,
        text: &dyn Fn(WallTime) -> String,
    ) -> Option<SensorTrouble> {
        let mut longest = self.on_longest;
        if self.is_on && end - self.on_since > longest.0 {
            longest = (end - self.on_since, self.on_since);
        }
        if kind == Kind::Motion && is_of_two && longest.0 >= STUCK {
            return Some(SensorTrouble::StuckOn { since: text(longest.1), hours: longest.0.seconds() / 3600.0 });
        }
        if let [(value, times)] = self.values[..]
            && kind == Kind::Reading
            && times >= STUCK_READINGS
            && self.latest - self.first >= STUCK_FOR
        {
            return Some(SensorTrouble::StuckAt { value: values[value as usize].clone() });
        }
        let silent = end - self.latest;
        let is_dead = self.rows > 1 && silent >= DEAD && silent / DEAD_TIMES >= self.quiet;
        is_dead.then(|| SensorTrouble::Dead { since: text(self.latest) })
    }
}
