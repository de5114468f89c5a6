//! Figures of the log of a run, updated as it grows.

use crate::dates;
use crate::wire::LiveCountsView;
use homebody_core::calendar::Calendar;
use homebody_core::event::Firing;
use homebody_core::time::{HOUR, Interval, MINUTE, RunTime, SECOND, Span};

/// Number of firings of a day that are stored one by one (our choice).
const MOST_TODAY: usize = 100_000;

/// Firings of motion sensors by day and hour, and all firings of the last day.
#[derive(Clone, Debug)]
pub struct LiveCounts {
    calendar: Calendar,
    /// The instants at which clocks are set.
    turns: Vec<RunTime>,
    is_motion: Vec<bool>,
    hours: Vec<Vec<u32>>,
    /// At most [`MOST_TODAY`].
    today: Vec<(RunTime, u32)>,
    /// The number of firings of the day that are not in `today`.
    left_out: u64,
    /// The present hour of the clock, its day and its number.
    now: (Interval<RunTime>, usize, usize),
}

impl LiveCounts {
    /// At the start of a run. `is_motion` tells the motion sensors.
    pub fn new(calendar: &Calendar, length: Span, is_motion: Vec<bool>) -> LiveCounts {
        let mut live_counts = LiveCounts {
            calendar: calendar.clone(),
            turns: calendar.scale(length).run_changes().map(|turn| turn.at).collect(),
            is_motion,
            hours: vec![vec![0; 24]],
            today: Vec::new(),
            left_out: 0,
            now: (Interval::default(), 0, 0),
        };
        live_counts.come_to(RunTime::START);
        live_counts
    }

    /// Adds the firings before `until`.
    pub fn add(&mut self, firings: &[Firing], until: RunTime) {
        for firing in firings {
            self.come_to(firing.at);
            let (_, day, hour) = self.now;
            if self.is_motion.get(firing.sensor.index()) == Some(&true) {
                self.hours[day][hour] += 1;
            }
            if day + 1 == self.hours.len() {
                if self.today.len() < MOST_TODAY {
                    self.today.push((firing.at, firing.sensor.0));
                } else {
                    self.left_out += 1;
                }
            }
        }
        // Midnight itself belongs to a day that has not begun.
        self.come_to((until - Span::MICROSECOND).max(RunTime::START));
    }

    pub fn view(&self) -> LiveCountsView {
        let today = self.today.iter().map(|&(at, sensor)| (at.micros(), sensor)).collect();
        LiveCountsView { hours: self.hours.clone(), today, left_out: self.left_out }
    }

    /// Moves to the hour of an instant.
    fn come_to(&mut self, at: RunTime) {
        if self.now.0.contains(at) {
            return;
        }
        let local = self.calendar.local(at);
        let since = i64::from(local.minute()) * MINUTE
            + i64::from(local.second()) * SECOND
            + Span::from_micros(i64::from(local.subsec_nanosecond()) / 1000);
        let day = usize::try_from(self.calendar.day(at)).unwrap_or(0);
        if day >= self.hours.len() {
            self.hours.resize(day + 1, vec![0; 24]);
            self.today.clear();
            self.left_out = 0;
        }
        // Setting clocks cuts an hour short.
        let turned = self.turns.partition_point(|&turn| turn <= at);
        let begin = (at - since).max(turned.checked_sub(1).map_or(RunTime::MIN, |last| self.turns[last]));
        let end = (at - since + HOUR).min(self.turns.get(turned).copied().unwrap_or(RunTime::MAX));
        self.now = (Interval::new(begin, end), day, dates::hour(&self.calendar, at));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_core::event::Value;
    use homebody_core::ids::SensorId;
    use homebody_core::time::DAY;

    /// Each firing counts for the day and the hour of the wall clock, whenever clocks are set.
    #[test]
    fn firings_count_for_the_hour_on_the_wall() {
        // In St. John's they were set at one minute past midnight, on Lord Howe Island by half an hour.
        for (start, zone) in [
            ("2009-03-07T12:00:00", "America/St_Johns"),
            ("2009-10-31T12:00:00", "America/St_Johns"),
            ("2009-04-04T12:00:00", "Australia/Lord_Howe"),
            ("2009-10-03T12:00:00", "Australia/Lord_Howe"),
            ("2009-10-17T12:00:00", "America/Sao_Paulo"),
            ("2009-03-07T12:00:00", "America/Chicago"),
        ] {
            let calendar = Calendar::new(start, zone).unwrap();
            let length = 3 * DAY;
            let mut live_counts = LiveCounts::new(&calendar, length, vec![true]);
            let mut wanted = vec![vec![0_u32; 24]; dates::last_day(&calendar, length) as usize + 1];
            for seq in 0..length / (7 * MINUTE) {
                let at = RunTime::START + seq * 7 * MINUTE;
                let firing = Firing { seq: seq as u64, at, sensor: SensorId(0), value: Value::Fire };
                live_counts.add(&[firing], at + SECOND);
                wanted[calendar.day(at) as usize][dates::hour(&calendar, at)] += 1;
            }
            live_counts.add(&[], RunTime::START + length);
            assert_eq!(live_counts.view().hours, wanted, "{start} {zone}");
        }
    }
}
