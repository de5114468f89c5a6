//! Intervals during which a sensor is stuck or dead, found from messages alone.
//!
//! A sensor that repeats itself at even intervals is stuck. One with daily messages that is silent while others are as
//! active as usual is dead.

use crate::message::{LogMessage, MessageKind};
use homebody_core::time::{DAY, HOUR, Interval, RunTime, SECOND, Span};
use serde::Serialize;

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct FaultInterval {
    pub sensor: usize,
    /// The first implausible message, or the last before the silence.
    pub from: RunTime,
    /// The last implausible message, or the first after the silence.
    pub to: RunTime,
    pub ill: FaultIntervalKind,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum FaultIntervalKind {
    Stuck,
    Dead,
}

/// Repetitions of a stuck sensor at even intervals, largest difference of these intervals, and shortest interval, which
/// is that of a sensor with a moving person in view (our choice).
const REPEATS: usize = 8;
const EVEN: Span = Span::from_millis(500);
const LEAST_SPACE: Span = SECOND.times(20);
/// Shortest silence that is examined (our choice): people sleep, and go out for a day.
const SILENCE: Span = HOUR.times(18);
/// Smallest values of a missed sensor (our choice): share of days with events, expected hours of events in a silence,
/// and relative activity of the other sensors.
const DAILY: f64 = 0.8;
const MISSED_H: f64 = 9.0;
const OTHERS: f64 = 0.4;

/// One bit for each hour of a day.
type HourMask = u32;

#[derive(Clone, Debug, Default)]
struct MessageHistory {
    count: u64,
    last: Option<RunTime>,
    /// The last interval, the number of even ones in a row, and their start.
    space: Span,
    even: usize,
    since: RunTime,
    silences: Vec<Interval<RunTime>>,
}

/// `messages` are in order of time, up to `end`.
pub fn fault_intervals(
    messages: impl IntoIterator<Item = LogMessage>,
    sensors: usize,
    end: RunTime,
) -> Vec<FaultInterval> {
    let mut heard = vec![MessageHistory::default(); sensors];
    // By day and sensor, the hours with messages.
    let mut days: Vec<Vec<HourMask>> = Vec::new();
    let mut faults = Vec::new();
    let interval = |sensor, of: Interval<RunTime>, ill| FaultInterval { sensor, from: of.begin, to: of.end, ill };
    for message in messages {
        let at = message.at.max(RunTime::START).since_zero();
        let day = (at / DAY) as usize;
        if days.len() <= day {
            days.resize(day + 1, vec![0; sensors]);
        }
        days[day][message.sensor] |= 1 << (at % DAY / HOUR);
        if message.said != MessageKind::Off {
            heard[message.sensor]
                .hear(message.at, |stuck| faults.push(interval(message.sensor, stuck, FaultIntervalKind::Stuck)));
        }
    }
    for (sensor, heard) in heard.iter_mut().enumerate() {
        heard.hear_end(end, |stuck| faults.push(interval(sensor, stuck, FaultIntervalKind::Stuck)));
        for &silence in &heard.silences {
            // A sensor with several such silences is not faulty.
            let is_usual =
                |other: &Interval<RunTime>| other.begin != silence.begin && other.length() * 2 > silence.length();
            if !heard.silences.iter().any(is_usual) && is_missed(sensor, silence, &days) {
                faults.push(interval(sensor, silence, FaultIntervalKind::Dead));
            }
        }
    }
    faults.sort_by_key(|interval| (interval.from, interval.sensor));
    faults
}

impl MessageHistory {
    fn hear(&mut self, at: RunTime, stuck: impl FnOnce(Interval<RunTime>)) {
        let last = self.last.unwrap_or_default();
        let space = at - last;
        if space > SILENCE {
            self.silences.push(Interval::new(last, at));
        }
        let is_even = self.count > 1 && (space - self.space).abs() <= EVEN && space >= LEAST_SPACE;
        if is_even {
            self.even += 1;
        } else {
            self.end_row(stuck);
            self.since = last;
        }
        (self.space, self.last) = (space, Some(at));
        self.count += 1;
    }

    fn end_row(&mut self, stuck: impl FnOnce(Interval<RunTime>)) {
        if let Some(last) = self.last.filter(|_| self.even >= REPEATS) {
            stuck(Interval::new(self.since, last));
        }
        self.even = 0;
    }

    fn hear_end(&mut self, end: RunTime, stuck: impl FnOnce(Interval<RunTime>)) {
        self.end_row(stuck);
        if let Some(last) = self.last.filter(|&last| end - last > SILENCE) {
            self.silences.push(Interval::new(last, end));
        }
    }
}

/// Whether a silence is too long for an absence of the person. A person who is out triggers no sensor: only the others'
/// messages within the silence count, not those of its first and last day.
fn is_missed(sensor: usize, silence: Interval<RunTime>, days: &[Vec<HourMask>]) -> bool {
    let midnight = |day: usize| RunTime::START + day as i64 * DAY;
    let silent_of = |day: usize| silence.intersection(Interval::starting(midnight(day), DAY));
    let share = |day: usize| silent_of(day).length().max(Span::ZERO).ratio(DAY);
    let median = |mut of_days: Vec<u32>| {
        of_days.sort_unstable();
        of_days.get(of_days.len() / 2).copied().map_or(0.0, f64::from)
    };
    let is_loud = |day: &usize| share(*day) == 0.0;
    let loud: Vec<u32> = (0..days.len()).filter(is_loud).map(|day| days[day][sensor].count_ones()).collect();
    let heard = loud.iter().filter(|&&hours| hours > 0).count() as f64;
    if loud.is_empty() || heard < DAILY * loud.len() as f64 {
        return false;
    }
    let usual = median(loud);
    let others = |day: usize, hours: HourMask| -> u32 {
        let of =
            |(other, of_other): (usize, &HourMask)| if other == sensor { 0 } else { (of_other & hours).count_ones() };
        days[day].iter().enumerate().map(of).sum()
    };
    let usual_of_others = median((0..days.len()).filter(is_loud).map(|day| others(day, HourMask::MAX)).collect());
    let silent: f64 = (0..days.len()).map(share).sum();
    let of_others: u32 = (0..days.len()).map(|day| others(day, hours_of(midnight(day), silent_of(day)))).sum();
    usual * silent >= MISSED_H && f64::from(of_others) >= OTHERS * usual_of_others * silent
}

fn hours_of(midnight: RunTime, within: Interval<RunTime>) -> HourMask {
    let at = |hour: i64| midnight + hour * HOUR;
    (0..24).filter(|&hour| at(hour) >= within.begin && at(hour + 1) <= within.end).map(|hour| 1 << hour).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_core::time::MINUTE;

    const END: RunTime = day(10);

    const fn day(number: i64) -> RunTime {
        RunTime::START.saturating_add(DAY.times(number))
    }

    fn message(sensor: usize, at: RunTime) -> LogMessage {
        LogMessage { at, sensor, said: MessageKind::On }
    }

    /// Ten days on which two sensors send a message every seven to eleven minutes of the day.
    fn usual() -> Vec<LogMessage> {
        let mut messages = Vec::new();
        for number in 0..10 {
            for turn in 0..80 {
                let at = day(number) + 8 * HOUR + turn * 9 * MINUTE + turn % 7 * 20 * SECOND;
                messages.extend([message(0, at), message(1, at + 5 * SECOND)]);
            }
        }
        messages
    }

    #[test]
    fn working_sensors_have_no_fault_interval() {
        assert_eq!(fault_intervals(usual(), 2, END), []);
    }

    #[test]
    fn silence_is_a_fault_only_while_others_are_active() {
        let is_silent = |message: &LogMessage| (day(4)..day(6)).contains(&message.at);
        let dead: Vec<LogMessage> = usual().into_iter().filter(|one| one.sensor == 0 || !is_silent(one)).collect();
        let found = fault_intervals(dead, 2, END);
        assert_eq!(
            found.iter().map(|interval| (interval.sensor, interval.ill)).collect::<Vec<_>>(),
            [(1, FaultIntervalKind::Dead)]
        );
        assert!(found[0].from < day(4) && found[0].to > day(6), "{found:?}");
        let away: Vec<LogMessage> = usual().into_iter().filter(|one| !is_silent(one)).collect();
        assert_eq!(fault_intervals(away, 2, END), []);
    }

    #[test]
    fn absence_for_days_leaves_no_sensor_dead() {
        // Away from noon of one day to the evening of another; the second sensor is active the day after.
        let (out, back) = (day(3) + 12 * HOUR, day(5) + 18 * HOUR);
        let is_said = |message: &LogMessage| {
            let back = if message.sensor == 1 { day(6) } else { back };
            !(out..back).contains(&message.at)
        };
        let away: Vec<LogMessage> = usual().into_iter().filter(is_said).collect();
        assert_eq!(fault_intervals(away.clone(), 2, END), []);
        // Control: if the first were active all the while, the second would be dead.
        let of_one = |message: &LogMessage| message.sensor == 0 && (out..back).contains(&message.at);
        let mut at_home: Vec<LogMessage> = away.into_iter().chain(usual().into_iter().filter(of_one)).collect();
        at_home.sort_by_key(|message| message.at);
        let found = fault_intervals(at_home, 2, END);
        assert_eq!(
            found.iter().map(|interval| (interval.sensor, interval.ill)).collect::<Vec<_>>(),
            [(1, FaultIntervalKind::Dead)]
        );
    }

    #[test]
    fn even_repetitions_are_stuck_while_they_last() {
        let mut messages = usual();
        messages.extend((0..60).map(|turn| message(1, day(3) + HOUR + turn * MINUTE)));
        messages.sort_by_key(|message| message.at);
        let found = fault_intervals(messages, 2, END);
        assert_eq!(found.len(), 1, "{found:?}");
        assert_eq!((found[0].sensor, found[0].ill), (1, FaultIntervalKind::Stuck));
        assert_eq!(found[0].to - found[0].from, 59 * MINUTE);
    }
}
