//! What a log has got so far, counted as it grows.

use crate::dates;
use crate::wire::GrowthView;
use homebody_core::event::Firing;
use homebody_core::scenario::calendar::Calendar;
use homebody_core::time::{Micros, SECOND};
use std::ops::Range;

const HOUR: Micros = 3600 * SECOND;

/// How often motion sensors have fired, by day and hour, and all firings of the last day.
#[derive(Clone, Debug)]
pub struct Growth {
    calendar: Calendar,
    length: Micros,
    is_motion: Vec<bool>,
    hours: Vec<Vec<u32>>,
    today: Vec<(Micros, u32)>,
    /// An hour on the clock: from when to when, of which day, and which.
    now: (Range<Micros>, usize, usize),
}

impl Growth {
    /// Of a run of this length, before it begins; which of its sensors look for movement.
    pub fn new(calendar: &Calendar, length: Micros, is_motion: Vec<bool>) -> Growth {
        let mut growth = Growth {
            calendar: calendar.clone(),
            length,
            is_motion,
            hours: vec![vec![0; 24]],
            today: Vec::new(),
            now: (0..0, 0, 0),
        };
        growth.come_to(0);
        growth
    }

    /// Counts what was fired before `until`.
    pub fn add(&mut self, firings: &[Firing], until: Micros) {
        for firing in firings {
            self.come_to(firing.at);
            let (_, day, hour) = self.now;
            if self.is_motion.get(firing.sensor as usize) == Some(&true) {
                self.hours[day][hour] += 1;
            }
            if day + 1 == self.hours.len() {
                self.today.push((firing.at, firing.sensor));
            }
        }
        // Midnight itself is of a day that has not begun.
        self.come_to((until - 1).max(0));
    }

    pub fn view(&self) -> GrowthView {
        GrowthView {
            days: dates::some(&self.calendar, self.length, 0..self.hours.len() as u32),
            hours: self.hours.clone(),
            today: self.today.clone(),
        }
    }

    /// Finds the hour of an instant, where it is another than that of the one before.
    fn come_to(&mut self, at: Micros) {
        if self.now.0.contains(&at) {
            return;
        }
        let local = self.calendar.local(at);
        let since = Micros::from(local.minute()) * 60 * SECOND
            + Micros::from(local.second()) * SECOND
            + Micros::from(local.subsec_nanosecond()) / 1000;
        let day = usize::try_from(self.calendar.day(at)).unwrap_or(0);
        if day >= self.hours.len() {
            self.hours.resize(day + 1, vec![0; 24]);
            self.today.clear();
        }
        // Clocks are set at whole hours or at halves of them: an hour that is cut short is looked at again.
        let end = at - since + if since < HOUR / 2 { HOUR / 2 } else { HOUR };
        self.now = (at - since..end, day, dates::hour(&self.calendar, at));
    }
}
