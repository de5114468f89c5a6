//! Sensors that cannot be believed for a time: they say the same again and again, or nothing at all.
//!
//! Both are told by a sensor's own messages, beside those of the others. One that repeats itself at even spaces is stuck; one
//! that was heard daily, and is silent while others are heard as usual, is dead.

use crate::said::{Message, Said};
use homebody_core::time::{DAY, Micros, SECOND};
use serde::Serialize;

/// A sensor that cannot be believed from one instant to another.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Spell {
    /// Index into the home's sensors.
    pub sensor: usize,
    /// From its first message that cannot be believed, or its last that can, in microseconds since the start.
    pub from: Micros,
    /// Until the last that cannot be believed, or the first that can again.
    pub to: Micros,
    /// What is wrong with it.
    pub ill: Ill,
}

/// What is wrong with a sensor.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Ill {
    /// It repeats itself at even spaces.
    Stuck,
    /// It says nothing.
    Dead,
}

/// Repetitions of a stuck sensor at even intervals, largest difference of these intervals, and shortest interval, which
/// is that of a sensor with a moving person in view (our choice).
const REPEATS: usize = 8;
const EVEN: Micros = SECOND / 2;
const LEAST_SPACE: Micros = 20 * SECOND;
/// Shortest silence that is examined (our choice): people sleep, and go out for a day.
const SILENCE: Micros = 18 * 3_600 * SECOND;
/// Smallest values of a missed sensor (our choice): share of days with events, expected hours of events in a silence,
/// and relative activity of the other sensors.
const DAILY: f64 = 0.8;
const MISSED_H: f64 = 9.0;
const OTHERS: f64 = 0.4;

/// A bit for each hour of a day.
type Hours = u32;

/// What is known of one sensor's messages.
#[derive(Clone, Debug, Default)]
struct Heard {
    count: u64,
    last: Option<Micros>,
    /// The space before the last message, and how many even ones there are in a row, since when.
    space: Micros,
    even: usize,
    since: Micros,
    silences: Vec<(Micros, Micros)>,
}

/// The spells of all sensors, of messages in order of time, up to `end`.
pub fn spells(messages: impl IntoIterator<Item = Message>, sensors: usize, end: Micros) -> Vec<Spell> {
    let mut heard = vec![Heard::default(); sensors];
    // By day and sensor: in which hours it was heard.
    let mut days: Vec<Vec<Hours>> = Vec::new();
    let mut spells = Vec::new();
    for message in messages {
        let day = (message.at.max(0) / DAY) as usize;
        if days.len() <= day {
            days.resize(day + 1, vec![0; sensors]);
        }
        days[day][message.sensor] |= 1 << (message.at.max(0) % DAY * 24 / DAY);
        if message.said != Said::Off {
            heard[message.sensor].hear(message.at, |from, to| {
                spells.push(Spell { sensor: message.sensor, from, to, ill: Ill::Stuck });
            });
        }
    }
    for (sensor, heard) in heard.iter_mut().enumerate() {
        heard.hear_end(end, |from, to| spells.push(Spell { sensor, from, to, ill: Ill::Stuck }));
        for &(from, to) in &heard.silences {
            // One that is silent for as long now and then is well.
            let is_usual = |&(begin, end): &(Micros, Micros)| begin != from && (end - begin) * 2 > to - from;
            if !heard.silences.iter().any(is_usual) && is_missed(sensor, (from, to), &days) {
                spells.push(Spell { sensor, from, to, ill: Ill::Dead });
            }
        }
    }
    spells.sort_by_key(|spell| (spell.from, spell.sensor));
    spells
}

impl Heard {
    fn hear(&mut self, at: Micros, stuck: impl FnOnce(Micros, Micros)) {
        let last = self.last.unwrap_or(0);
        let space = at - last;
        if space > SILENCE {
            self.silences.push((last, at));
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

    fn end_row(&mut self, stuck: impl FnOnce(Micros, Micros)) {
        if let Some(last) = self.last.filter(|_| self.even >= REPEATS) {
            stuck(self.since, last);
        }
        self.even = 0;
    }

    fn hear_end(&mut self, end: Micros, stuck: impl FnOnce(Micros, Micros)) {
        self.end_row(stuck);
        if let Some(last) = self.last.filter(|last| end - last > SILENCE) {
            self.silences.push((last, end));
        }
    }
}

/// Whether so much would have been said in a silence that it is none of the person's. Who is out makes nobody speak: what counts
/// of the others is what they say in the silence itself, and not on the rest of the days on which it begins and ends.
fn is_missed(sensor: usize, (from, to): (Micros, Micros), days: &[Vec<Hours>]) -> bool {
    let silent_of = |day: usize| {
        let begin = day as Micros * DAY;
        (from.max(begin) - begin, to.min(begin + DAY) - begin)
    };
    let share = |day: usize| {
        let (from, to) = silent_of(day);
        (to - from).max(0) as f64 / DAY as f64
    };
    let median = |mut of_days: Vec<u32>| {
        of_days.sort_unstable();
        of_days.get(of_days.len() / 2).copied().map_or(0.0, f64::from)
    };
    // In how many hours it is heard on a day that is not silent.
    let is_loud = |day: &usize| share(*day) == 0.0;
    let loud: Vec<u32> = (0..days.len()).filter(is_loud).map(|day| days[day][sensor].count_ones()).collect();
    let heard = loud.iter().filter(|&&hours| hours > 0).count() as f64;
    if loud.is_empty() || heard < DAILY * loud.len() as f64 {
        return false;
    }
    let usual = median(loud);
    let others = |day: usize, hours: Hours| -> u32 {
        let of = |(other, of_other): (usize, &Hours)| if other == sensor { 0 } else { (of_other & hours).count_ones() };
        days[day].iter().enumerate().map(of).sum()
    };
    let usual_of_others = median((0..days.len()).filter(is_loud).map(|day| others(day, Hours::MAX)).collect());
    let silent: f64 = (0..days.len()).map(share).sum();
    let of_others: u32 = (0..days.len()).map(|day| others(day, hours_of(silent_of(day)))).sum();
    usual * silent >= MISSED_H && f64::from(of_others) >= OTHERS * usual_of_others * silent
}

/// The hours of a day that lie within a span of it.
fn hours_of((from, to): (Micros, Micros)) -> Hours {
    const HOUR: Micros = DAY / 24;
    (0..24).filter(|hour| hour * HOUR >= from && (hour + 1) * HOUR <= to).map(|hour| 1 << hour).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    const HOUR: Micros = 3_600 * SECOND;

    fn message(sensor: usize, at: Micros) -> Message {
        Message { at, sensor, said: Said::On }
    }

    /// Ten days on which two sensors speak every seven to eleven minutes of the day.
    fn usual() -> Vec<Message> {
        let mut messages = Vec::new();
        for day in 0..10 {
            for turn in 0..80 {
                let at = day * DAY + 8 * HOUR + turn * 9 * 60 * SECOND + turn % 7 * 20 * SECOND;
                messages.extend([message(0, at), message(1, at + 5 * SECOND)]);
            }
        }
        messages
    }

    #[test]
    fn sensors_that_are_well_have_no_spells() {
        assert_eq!(spells(usual(), 2, 10 * DAY), []);
    }

    #[test]
    fn one_that_is_silent_while_others_speak_is_dead_and_one_of_an_empty_home_is_not() {
        let is_silent = |message: &Message| (4 * DAY..6 * DAY).contains(&message.at);
        let dead: Vec<Message> = usual().into_iter().filter(|one| one.sensor == 0 || !is_silent(one)).collect();
        let found = spells(dead, 2, 10 * DAY);
        assert_eq!(found.iter().map(|spell| (spell.sensor, spell.ill)).collect::<Vec<_>>(), [(1, Ill::Dead)]);
        assert!(found[0].from < 4 * DAY && found[0].to > 6 * DAY, "{found:?}");
        let away: Vec<Message> = usual().into_iter().filter(|one| !is_silent(one)).collect();
        assert_eq!(spells(away, 2, 10 * DAY), []);
    }

    #[test]
    fn who_is_away_for_days_leaves_no_sensor_dead_however_late_each_is_heard_again() {
        // Out from the noon of one day to the evening of another; the second sensor is heard the day after.
        let (out, back) = (3 * DAY + 12 * HOUR, 5 * DAY + 18 * HOUR);
        let is_said = |message: &Message| {
            let back = if message.sensor == 1 { 6 * DAY } else { back };
            !(out..back).contains(&message.at)
        };
        let away: Vec<Message> = usual().into_iter().filter(is_said).collect();
        assert_eq!(spells(away.clone(), 2, 10 * DAY), []);
        // Were the first heard all the while, the second would be dead.
        let of_one = |message: &Message| message.sensor == 0 && (out..back).contains(&message.at);
        let mut at_home: Vec<Message> = away.into_iter().chain(usual().into_iter().filter(of_one)).collect();
        at_home.sort_by_key(|message| message.at);
        let found = spells(at_home, 2, 10 * DAY);
        assert_eq!(found.iter().map(|spell| (spell.sensor, spell.ill)).collect::<Vec<_>>(), [(1, Ill::Dead)]);
    }

    #[test]
    fn one_that_repeats_itself_at_even_spaces_is_stuck_for_as_long_as_it_does() {
        let mut messages = usual();
        messages.extend((0..60).map(|turn| message(1, 3 * DAY + HOUR + turn * 60 * SECOND)));
        messages.sort_by_key(|message| message.at);
        let found = spells(messages, 2, 10 * DAY);
        assert_eq!(found.len(), 1, "{found:?}");
        assert_eq!((found[0].sensor, found[0].ill), (1, Ill::Stuck));
        assert_eq!(found[0].to - found[0].from, 59 * 60 * SECOND);
    }
}
