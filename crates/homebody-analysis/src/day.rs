//! One day of a log: what each sensor said, and, where it is known, what residents did and where they were.
//!
//! A day is 24 hours on the clock on the wall, even where clocks are set: then one of them is empty, or holds two. A firing is a row by which a sensor says that something begins: `ON`,
//! `OPEN`, `FIRE`; it counts on the day on which it begins. Sensors that tell readings, such as temperatures, are left out.

use homebody_core::activity::ActivityKind;
use homebody_core::time::{DAY, Interval, Span, WallTime};
use homebody_log::Log;
use homebody_timeline::{Episode, PersonTimeline};
use jiff::civil::Date;
use serde::Serialize;
use std::fmt;

use crate::dates::{clock, clock_s};
use crate::signs::{Kind, kinds, said, spans_until};

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DayRecord {
    pub name: String,
    pub date: Date,
    /// The firings of all sensors except those with readings.
    pub firings: u64,
    pub first: Option<DayFiring>,
    pub last: Option<DayFiring>,
    /// The residents in the ground truth; one without a name where the log itself notes activities.
    pub residents: Vec<ResidentDay>,
    pub sensors: Vec<SensorDay>,
    /// The number of sensors with readings, which are left out.
    pub readings: usize,
    /// The number of sensors that are left out because they tell of no person, such as updates and automations.
    pub others: usize,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DayFiring {
    /// The time of day to the second, such as `07:12:03`.
    pub at: String,
    pub sensor: String,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ResidentDay {
    /// The resident's name; `None` where the log itself notes activities.
    pub name: Option<String>,
    /// The activities, in the order of the log or the truth.
    pub activities: Vec<DaySpan>,
    /// The rooms by name; empty where they are unknown.
    pub rooms: Vec<DaySpan>,
}

/// A part of the day, in seconds since midnight.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DaySpan {
    /// The begin, or the begin of the day.
    pub begin_s: f64,
    /// The end, or the end of the day.
    pub end_s: f64,
    pub what: String,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SensorDay {
    pub sensor: String,
    pub kind: Kind,
    /// The firings that begin on the day.
    pub firings: u64,
    /// The same by the hour of their begin, from midnight on.
    pub by_hour: [u64; 24],
    /// The times in which the sensor was on, in seconds since midnight.
    pub spans_s: Vec<(f64, f64)>,
}

impl DayRecord {
    /// A day of a log in local time, with the known timelines of its residents. A state without an end lasts until `ended`, the end of the
    /// recording, or until the last row if that is unknown.
    pub fn from_log(
        name: &str,
        log: &Log,
        people: &[PersonTimeline<WallTime>],
        ended: Option<WallTime>,
        date: Date,
    ) -> DayRecord {
        let begin = WallTime::midnight(date);
        let within = Interval::starting(begin, DAY);
        let ended = ended.or_else(|| log.events.iter().map(|event| event.at).max());
        let mut sensors = Vec::new();
        let (mut readings, mut others) = (0, 0);
        // A state that the system restores does not count as a firing.
        let mut restored: Vec<Vec<WallTime>> = vec![Vec::new(); log.sensors.len()];
        for (event, _) in log.events.iter().zip(said(log)).filter(|(_, said)| said.is_restored) {
            restored[event.sensor as usize].push(event.at);
        }
        // By instant, and the sensor's place.
        let mut ends: Vec<(WallTime, usize)> = Vec::new();
        let sensors_of_log = log.sensors.iter().zip(kinds(log)).zip(spans_until(log, ended)).zip(restored);
        for (((sensor, kind), spans), restored) in sensors_of_log {
            if matches!(kind, Kind::Reading | Kind::Other) {
                readings += usize::from(kind == Kind::Reading);
                others += usize::from(kind == Kind::Other);
                continue;
            }
            let mut by_hour = [0; 24];
            let begins = spans.iter().map(|span| span.begin);
            for at in begins.filter(|at| within.contains(*at) && !restored.contains(at)) {
                by_hour[((at - begin) * 24 / DAY) as usize] += 1;
                ends.push((at, sensors.len()));
            }
            // An interval that ends as the day begins is not of it; one that begins then is.
            let shown = spans.iter().filter(|span| span.overlaps(within) || span.begin == begin);
            let spans_s = shown.map(|&span| part(span, within)).collect();
            sensors.push(SensorDay { sensor: sensor.clone(), kind, firings: by_hour.iter().sum(), by_hour, spans_s });
        }
        let firing =
            |(at, sensor): &(WallTime, usize)| DayFiring { at: clock_s(*at), sensor: sensors[*sensor].sensor.clone() };
        let resident =
            |name: Option<&str>, activities: &[Episode<WallTime>], rooms: &[Episode<WallTime>]| ResidentDay {
                name: name.map(String::from),
                activities: stretches(activities, within),
                rooms: stretches(rooms, within),
            };
        let known = people.iter().map(|person| resident(Some(&person.name), &person.activities, &person.rooms));
        let mut residents: Vec<ResidentDay> = known.collect();
        if residents.is_empty() && !log.activities.is_empty() {
            residents.push(resident(None, &log.activities, &[]));
        }
        DayRecord {
            name: name.into(),
            date,
            firings: ends.len() as u64,
            first: ends.iter().min().map(firing),
            last: ends.iter().max().map(firing),
            residents,
            sensors,
            readings,
            others,
        }
    }
}

/// The part of a span that is in a day, in seconds since its beginning.
fn part(span: Interval<WallTime>, day: Interval<WallTime>) -> (f64, f64) {
    let part = span.intersection(day).map(|at| (at - day.begin).seconds());
    (part.begin, part.end)
}

fn stretches(all: &[Episode<WallTime>], day: Interval<WallTime>) -> Vec<DaySpan> {
    let shown = all.iter().filter(|one| one.time.overlaps(day));
    let stretch = |one: &Episode<WallTime>| {
        let (begin_s, end_s) = part(one.time, day);
        DaySpan { begin_s, end_s, what: one.label.clone() }
    };
    shown.map(stretch).collect()
}

impl fmt::Display for DayRecord {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}: {}", self.name, self.date.strftime("%A %F"))?;
        match self.sensors.len() {
            // Lived, without a log.
            0 => writeln!(f)?,
            1 => writeln!(f, ", {} firings of 1 sensor", self.firings)?,
            sensors => writeln!(f, ", {} firings of {sensors} sensors", self.firings)?,
        }
        for (what, firing) in [("First", &self.first), ("Last", &self.last)] {
            if let Some(DayFiring { at, sensor }) = firing {
                writeln!(f, "{:7} {at}  {sensor}", format!("{what}:"))?;
            }
        }
        for resident in &self.residents {
            writeln!(f, "\n{}", resident.name.as_deref().unwrap_or("Activities that the log notes"))?;
            if resident.activities.is_empty() {
                writeln!(f, "  no activity is known of this day")?;
            }
            for DaySpan { begin_s, end_s, what } in &resident.activities {
                let time = |at_s: f64| clock(Span::from_micros((at_s * 1e6) as i64));
                let kind = ActivityKind::from_name(what).in_words();
                writeln!(f, "  {}-{}  {:24}  {kind}", time(*begin_s), time(*end_s), what.replace('_', " "))?;
            }
        }
        if self.sensors.is_empty() && self.readings == 0 && self.others == 0 {
            return Ok(());
        }
        let names = self.sensors.iter().map(|sensor| sensor.sensor.chars().count());
        let width = names.max().unwrap_or(0).max(6);
        let most = self.sensors.iter().map(|sensor| sensor.firings).max().unwrap_or(0).max(1);
        writeln!(f)?;
        for SensorDay { sensor, firings, .. } in &self.sensors {
            let line =
                format!("  {sensor:width$} {firings:>8}  {}", "█".repeat((firings * 30).div_ceil(most) as usize));
            writeln!(f, "{}", line.trim_end())?;
        }
        writeln!(f, "  {:width$} {:>8}", "all", self.firings)?;
        self.by_hour(f, width)?;
        match self.readings {
            0 => {}
            1 => writeln!(f, "\nLeft out: 1 sensor that tells readings.")?,
            more => writeln!(f, "\nLeft out: {more} sensors that tell readings.")?,
        }
        match self.others {
            0 => Ok(()),
            1 => writeln!(f, "\nLeft out: 1 that is no sensor of somebody."),
            more => writeln!(f, "\nLeft out: {more} that are no sensors of somebody."),
        }
    }
}

impl DayRecord {
    fn by_hour(&self, f: &mut fmt::Formatter, width: usize) -> fmt::Result {
        let fired: Vec<&SensorDay> = self.sensors.iter().filter(|sensor| sensor.firings > 0).collect();
        if fired.is_empty() {
            return Ok(());
        }
        let most = fired.iter().flat_map(|sensor| sensor.by_hour).max().unwrap_or(0);
        let wide = most.to_string().len().max(2) + 1;
        let hours: String = (0..24).map(|hour| format!("{hour:>wide$}")).collect();
        writeln!(f, "\n  {:width$} {hours}", "hour")?;
        for sensor in fired {
            let cell = |count: &u64| if *count == 0 { format!("{:>wide$}", ".") } else { format!("{count:>wide$}") };
            let cells: String = sensor.by_hour.iter().map(cell).collect();
            writeln!(f, "  {:width$} {cells}", sensor.sensor)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample::{at, log, parsed};
    use jiff::civil::date;

    const H: i64 = 3600;

    fn told() -> DayRecord {
        let mut log = log(&parsed(
            "23:00:00 hall ON, 25:00:00 hall OFF, 26:00:00 T1 21.5, 30:00:00 door OPEN, 47:00:00 hall ON, \
             49:00:00 hall OFF, 20:00:00 door OPEN, 24:00:00 door CLOSE, 30:00:05 door CLOSE",
        ));
        let activity = |from: i64, to: i64| Episode::new("Cook".to_owned(), Interval::new(at(from), at(to)));
        log.activities = vec![activity(0, 24 * H), activity(24 * H + 60, 25 * H), activity(40 * H, 50 * H)];
        DayRecord::from_log("log", &log, &[], None, date(1970, 1, 2))
    }

    #[test]
    fn a_day_is_cut_out_of_its_log() {
        let day = told();
        let at = |firing: &Option<DayFiring>| firing.as_ref().map(|it| (it.at.clone(), it.sensor.clone()));
        assert_eq!((day.firings, day.readings), (2, 1));
        assert_eq!(at(&day.first), Some(("06:00:00".into(), "door".into())));
        assert_eq!(at(&day.last), Some(("23:00:00".into(), "hall".into())));
        // An interval over midnight is shown on both days, and counts on the first.
        assert_eq!(day.sensors[0].spans_s, [(0.0, 3600.0), (82_800.0, 86_400.0)]);
        assert_eq!((day.sensors[0].firings, day.sensors[0].by_hour[23]), (1, 1));
        assert_eq!(day.sensors[1].spans_s, [(21_600.0, 21_605.0)]);
        let spans: Vec<_> = day.residents[0].activities.iter().map(|part| (part.begin_s, part.end_s)).collect();
        assert_eq!(spans, [(60.0, 3600.0), (57_600.0, 86_400.0)]);
    }

    #[test]
    fn open_states_last_until_the_log_ends() {
        let log =
            log(&[(20 * H, "bed", "IN"), (21 * H, "bed", "OUT"), (22 * H, "bed", "IN"), (23 * H, "hall", "FIRE")]);
        let told = |ended, day: i8| {
            DayRecord::from_log("log", &log, &[], ended, date(1970, 1, day)).sensors[0].spans_s.clone()
        };
        assert_eq!(told(None, 1), [(72_000.0, 75_600.0), (79_200.0, 82_800.0)], "to its last row");
        let ended = Some(at(26 * H));
        assert_eq!((told(ended, 1)[1], told(ended, 2)), ((79_200.0, 86_400.0), vec![(0.0, 7200.0)]));
        assert_eq!(
            DayRecord::from_log("log", &log, &[], ended, date(1970, 1, 1)).sensors[1].spans_s,
            [(82_800.0, 82_800.0)]
        );
    }

    #[test]
    fn puts_a_day_into_words() {
        let day = told();
        let words = day.to_string();
        for part in [
            "Friday 1970-01-02, 2 firings of 2 sensors",
            "First:  06:00:00  door",
            "16:00-24:00  Cook",
            "Left out: 1 sensor",
        ] {
            assert!(words.contains(part), "{words}");
        }
    }
}
