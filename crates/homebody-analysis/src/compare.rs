//! Agreement of two logs: the number of firings of each sensor, and the times between firings.
//!
//! | measure | definition |
//! |---|---|
//! | agreement | `1 - |a - b| / b` for `a` firings against `b` in the reference: 1 is equal, and with more than twice the reference's firings it is below 0 |
//! | agreement by sensor | `1 - sum |a_k - b_k| / sum b_k` over the sensors `k`: an excess of one sensor does not make up for a lack of another |
//! | agreement by activity | the same over activities: an excess during cooking does not make up for a lack during sleep. A firing counts for every activity at its instant. This is the figure of Godsey & Skubic (2009) ("per activity [...] around 93% (difference of 16 in 230 total firings)"), as far as they define it |
//! | gaps | the Kolmogorov-Smirnov distance `sup |F_a(x) - F_b(x)|` of two samples of times between successive firings, where `F(x)` is the share of a sample that is `x` or less: 0 is equal, 1 is wholly apart |
//!
//! Gaps are a sensor's own; *pooled* they are those of all sensors in one sample; *anywhere* they are the times from each firing in the
//! home to the next. For comparison: the halves of one real home's log are 0.02-0.05 apart, two real homes 0.09-0.12 (the CASAS logs TM000
//! and HH111, its first week; pooled and anywhere).
//!
//! If the logs have different numbers of dates, all numbers of firings are those of a day: else a week would be compared with a quarter.
//! Logs of less than two days are compared as a whole.
//!
//! We assume that both logs name their sensors alike. A firing is a row that means a beginning: `ON`, `OPEN`, `1` and the like; all other
//! rows, such as those of an end, are left out. If the reference has no firings, the agreement is unknown.

use crate::signs::{said, says};
use homebody_core::time::{Span, WallTime};
use homebody_log::Log;
use homebody_timeline::Episode;
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt;

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LogComparison {
    /// The sensors that fired in either log, in the natural order of their names.
    pub sensors: Vec<SensorComparison>,
    pub firings: AgreementCounts,
    /// From the first row of each log to its last.
    pub span_s: [f64; 2],
    /// From the date of the first row of each to that of its last, both counted.
    pub dates: [u64; 2],
    /// Agreements are those of firings a day, since the logs have different numbers of dates.
    pub is_by_day: bool,
    pub sensors_in_common: usize,
    /// Sensor by sensor, as the table above defines it; `None` where the reference has no firings.
    pub agreement_by_sensor: Option<f64>,
    /// The activities of either log by name; a log without activities has those of the other.
    pub activities: Vec<ActivityComparison>,
    /// Activity by activity, as the table above defines it; `None` where no activity of the reference has a firing.
    pub agreement_by_activity: Option<f64>,
    /// The distance of the pooled gaps, from 0 to 1; `None` where a log has none.
    pub gaps_pooled: Option<f64>,
    /// The distance of the gaps anywhere, from 0 to 1; `None` where a log has none.
    pub gaps_anywhere: Option<f64>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SensorComparison {
    pub sensor: String,
    pub firings: AgreementCounts,
    /// The distance of its own gaps, from 0 to 1; `None` where it fired less than twice in a log.
    pub gaps: Option<f64>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ActivityComparison {
    pub activity: String,
    pub firings: AgreementCounts,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct AgreementCounts {
    pub a: u64,
    pub b: u64,
    /// The agreement: 1 is equal; `None` where the reference has no firings.
    pub agreement: Option<f64>,
}

/// Compares log `a` with the reference `b`.
pub fn compare(a: &Log, b: &Log) -> LogComparison {
    let mut by_sensor: BTreeMap<&str, [Vec<WallTime>; 2]> = BTreeMap::new();
    for (which, log) in [a, b].into_iter().enumerate() {
        for event in log.events.iter().zip(said(log)).filter_map(|(event, said)| said.begins().then_some(event)) {
            by_sensor.entry(log.sensor(event)).or_default()[which].push(event.at);
        }
    }
    let mut by_sensor: Vec<(&str, [Vec<WallTime>; 2])> = by_sensor.into_iter().collect();
    by_sensor.sort_by_cached_key(|(sensor, _)| natural(sensor));
    let (dates, span_s) = ([a, b].map(dates), [a, b].map(span_s));
    let is_by_day = dates[0] != dates[1] && span_s.iter().any(|&span_s| span_s >= LONG_S);
    let per = if is_by_day { dates.map(|dates| dates.max(1) as f64) } else { [1.0; 2] };
    let count = |a: u64, b: u64| AgreementCounts::from_counts([a, b], per);
    let mut sensors = Vec::new();
    let (mut pooled, mut anywhere) = ([Vec::new(), Vec::new()], [Vec::new(), Vec::new()]);
    let mut apart = 0.0;
    for (sensor, times) in by_sensor {
        let firings = count(times[0].len() as u64, times[1].len() as u64);
        apart += firings.apart(per);
        let gaps = times.each_ref().map(|times| gaps(times.clone()));
        for which in 0..2 {
            pooled[which].extend_from_slice(&gaps[which]);
            anywhere[which].extend_from_slice(&times[which]);
        }
        sensors.push(SensorComparison { sensor: sensor.into(), firings, gaps: distance(gaps) });
    }
    let firings = count(anywhere[0].len() as u64, anywhere[1].len() as u64);
    let activities = by_activity([a, b], per, &mut anywhere);
    let reference: f64 = activities.iter().map(|activity| activity.firings.b as f64 / per[1]).sum();
    let apart_by_activity = activities.iter().map(|activity| activity.firings.apart(per)).sum();
    LogComparison {
        sensors_in_common: sensors.iter().filter(|sensor| sensor.firings.a > 0 && sensor.firings.b > 0).count(),
        sensors,
        firings,
        span_s,
        dates,
        is_by_day,
        agreement_by_sensor: agreement(apart, firings.b as f64 / per[1]),
        agreement_by_activity: agreement(apart_by_activity, reference),
        activities,
        gaps_pooled: distance(pooled),
        gaps_anywhere: distance(anywhere.map(gaps)),
    }
}

/// From the first row of a log to its last; real logs are not always in order.
fn span_s(log: &Log) -> f64 {
    let times = || log.events.iter().map(|event| event.at);
    times().max().zip(times().min()).map_or(0.0, |(last, first)| (last - first).seconds())
}

/// Length below which a log is compared as a whole (our choice).
const LONG_S: f64 = 2.0 * 86_400.0;

/// From the date of a log's first row to that of its last, both counted.
fn dates(log: &Log) -> u64 {
    let days = || log.events.iter().map(|event| event.at.day_number());
    days().max().zip(days().min()).map_or(0, |(last, first)| (last - first + 1) as u64)
}

impl AgreementCounts {
    fn from_counts([a, b]: [u64; 2], days: [f64; 2]) -> AgreementCounts {
        let counts = AgreementCounts { a, b, agreement: None };
        AgreementCounts { agreement: agreement(counts.apart(days), b as f64 / days[1]), ..counts }
    }

    fn apart(&self, [of_a, of_b]: [f64; 2]) -> f64 {
        (self.a as f64 / of_a - self.b as f64 / of_b).abs()
    }
}

/// The firings during each activity. It sorts the times of each log on the way.
fn by_activity(logs: [&Log; 2], per: [f64; 2], times: &mut [Vec<WallTime>; 2]) -> Vec<ActivityComparison> {
    let mut counts: BTreeMap<&str, [u64; 2]> = BTreeMap::new();
    for which in 0..2 {
        let (own, others) = (&logs[which].activities, &logs[1 - which].activities);
        times[which].sort_unstable();
        for Episode { label, time } in if own.is_empty() { others } else { own } {
            let before = |instant: WallTime| times[which].partition_point(|&at| at < instant);
            counts.entry(label).or_default()[which] += before(time.end).saturating_sub(before(time.begin)) as u64;
        }
    }
    let compared = |(activity, [a, b]): (&str, [u64; 2])| ActivityComparison {
        activity: activity.into(),
        firings: AgreementCounts::from_counts([a, b], per),
    };
    counts.into_iter().map(compared).collect()
}

/// A name such that A3 comes before A11: words in turn with numbers, these by their lengths and digits.
pub(crate) fn natural(name: &str) -> Vec<(usize, &str)> {
    let parts = name.as_bytes().chunk_by(|a, b| a.is_ascii_digit() == b.is_ascii_digit());
    let ends = parts.scan(0, |end, part| {
        let begin = *end;
        *end += part.len();
        Some(&name[begin..*end])
    });
    let sized = ends.map(|part| match part.trim_start_matches('0') {
        digits if part.starts_with(|c: char| c.is_ascii_digit()) => (digits.len(), digits),
        _ => (usize::MAX, part),
    });
    sized.collect()
}

pub fn begins(value: &str) -> bool {
    says(value).is_on()
}

fn agreement(apart: f64, reference: f64) -> Option<f64> {
    (reference > 0.0).then(|| 1.0 - apart / reference)
}

/// The times from each firing to the next; real logs are not always in order.
fn gaps(mut times: Vec<WallTime>) -> Vec<Span> {
    times.sort_unstable();
    times.windows(2).map(|pair| pair[1] - pair[0]).collect()
}

/// The Kolmogorov-Smirnov distance of two samples; none where one is empty.
pub(crate) fn distance<T: Copy + Ord>(mut samples: [Vec<T>; 2]) -> Option<f64> {
    samples.iter_mut().for_each(|sample| sample.sort_unstable());
    let [a, b] = &samples;
    if a.is_empty() || b.is_empty() {
        return None;
    }
    let (mut of_a, mut of_b, mut widest) = (0, 0, 0.0_f64);
    while of_a < a.len() && of_b < b.len() {
        // Both shares step past all that equals the next value before they are compared.
        let next = a[of_a].min(b[of_b]);
        of_a += a[of_a..].iter().take_while(|&&gap| gap == next).count();
        of_b += b[of_b..].iter().take_while(|&&gap| gap == next).count();
        widest = widest.max((of_a as f64 / a.len() as f64 - of_b as f64 / b.len() as f64).abs());
    }
    Some(widest)
}

impl fmt::Display for LogComparison {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let sensors = self.sensors.iter().map(|sensor| sensor.sensor.as_str());
        let activities = self.activities.iter().map(|activity| activity.activity.as_str());
        let last = (!self.activities.is_empty()).then_some(ACTIVITY_BY_ACTIVITY);
        let names = sensors.chain(activities).chain([SENSOR_BY_SENSOR]).chain(last);
        let width = names.map(|name| name.chars().count()).max().unwrap_or(0);
        writeln!(
            f,
            "{:width$}  {:>9}  {:>9}  {:>9}  {:>10}",
            "sensor", "firings", "reference", "agreement", "gaps apart"
        )?;
        let line = |f: &mut fmt::Formatter,
                    name: &str,
                    counts: Option<&AgreementCounts>,
                    agreement: Option<f64>,
                    gaps: &str| {
            let [a, b] = [counts.map(|counts| counts.a), counts.map(|counts| counts.b)];
            let shown = |count: Option<u64>, dates: u64| match count {
                Some(count) if self.is_by_day => format!("{:.1}", count as f64 / dates.max(1) as f64),
                Some(count) => count.to_string(),
                None => String::new(),
            };
            let [a, b] = [shown(a, self.dates[0]), shown(b, self.dates[1])];
            let agreement = agreement.map_or("-".into(), |share| format!("{:.1} %", share * 100.0));
            let line = format!("{name:width$}  {a:>9}  {b:>9}  {agreement:>9}  {gaps:>10}");
            writeln!(f, "{}", line.trim_end())
        };
        let shown = |gaps: Option<f64>| gaps.map_or("-".into(), |distance| format!("{distance:.3}"));
        for sensor in &self.sensors {
            line(f, &sensor.sensor, Some(&sensor.firings), sensor.firings.agreement, &shown(sensor.gaps))?;
        }
        line(f, "all together", Some(&self.firings), self.firings.agreement, &shown(self.gaps_anywhere))?;
        line(f, SENSOR_BY_SENSOR, None, self.agreement_by_sensor, &shown(self.gaps_pooled))?;
        if self.is_by_day {
            let [a, b] = self.dates;
            writeln!(f, "\nThe logs have {a} and {b} dates: all numbers of firings are those of a day.")?;
        }
        if self.sensors_in_common == 0 {
            writeln!(f, "\nNo sensor fired in both: where names differ, only what is together can be compared.")?;
        }
        if !self.activities.is_empty() {
            writeln!(f, "\n{:width$}  {:>9}  {:>9}  {:>9}", "activity", "firings", "reference", "agreement")?;
            for ActivityComparison { activity, firings } in &self.activities {
                line(f, activity, Some(firings), firings.agreement, "")?;
            }
            line(f, ACTIVITY_BY_ACTIVITY, None, self.agreement_by_activity, "")?;
        }
        write!(f, "\n{MEASURES}")
    }
}

/// The measures, for readers.
pub const MEASURES: &str = "\
agreement   1 - |firings - reference| / reference, after Godsey & Skubic (2009). 100 % means equal
            numbers; 0 % means none, or twice as many; negative values mean more than twice as many.
            The \"By\" lines sum absolute differences, so that a surplus in one place does not cancel a
            deficit in another. Logs of different lengths are compared by firings per day.
gaps apart  the Kolmogorov-Smirnov distance between the distributions of the times from one firing to
            the next: 0 means equal, 1 means disjoint. Two halves of a real home's log are 0.02 to
            0.05 apart, two real homes 0.09 to 0.12. The line \"all together\" uses the times between
            firings of any two sensors; all other lines use the times of one sensor.
";

const SENSOR_BY_SENSOR: &str = "sensor by sensor";
const ACTIVITY_BY_ACTIVITY: &str = "activity by activity";

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_core::time::{DAY, Interval, MINUTE};
    use homebody_log::Event;

    /// A log of firings: sensor and instant; the sensor's name in capitals makes it an OFF.
    fn log(rows: &[(&str, i64)]) -> Log {
        let mut log = Log { values: vec!["ON".into(), "OFF".into()], ..Default::default() };
        for &(name, micros) in rows {
            let (lower, off) = (name.to_lowercase(), name != name.to_lowercase());
            let known = log.sensors.iter().position(|sensor| *sensor == lower);
            let sensor = known.unwrap_or_else(|| {
                log.sensors.push(lower);
                log.sensors.len() - 1
            });
            log.events.push(Event { at: WallTime::from_micros(micros), sensor: sensor as u32, value: off.into() });
        }
        log
    }

    #[test]
    fn a_log_agrees_with_itself() {
        let log = log(&[("a", 0), ("b", 5), ("a", 9), ("A", 10), ("b", 12)]);
        let same = compare(&log, &log);
        assert_eq!(same.firings, AgreementCounts { a: 4, b: 4, agreement: Some(1.0) });
        assert_eq!((same.agreement_by_sensor, same.gaps_pooled, same.gaps_anywhere), (Some(1.0), Some(0.0), Some(0.0)));
    }

    #[test]
    fn too_many_of_one_do_not_make_up_for_too_few_of_another() {
        let a = log(&[("a", 0), ("a", 1), ("a", 2), ("b", 3)]);
        let b = log(&[("b", 0), ("a", 1), ("a", 2), ("b", 3)]);
        let compared = compare(&a, &b);
        assert_eq!(compared.firings.agreement, Some(1.0));
        assert_eq!(compared.agreement_by_sensor, Some(0.5));
        let by_sensor: Vec<_> = compared.sensors.iter().map(|sensor| sensor.firings.agreement).collect();
        assert_eq!(by_sensor, [Some(0.5), Some(0.5)]);
    }

    #[test]
    fn agreement_needs_a_reference() {
        let some = log(&[("a", 0), ("a", 1)]);
        let compared = compare(&some, &Log::default());
        assert_eq!(compared.firings, AgreementCounts { a: 2, b: 0, agreement: None });
        assert_eq!((compared.agreement_by_sensor, compared.gaps_pooled), (None, None));
        let compared = compare(&Log::default(), &some);
        assert_eq!(compared.firings.agreement, Some(0.0));
        assert!(compare(&Log::default(), &Log::default()).sensors.is_empty());
    }

    #[test]
    fn far_too_many_firings_agree_less_than_not_at_all() {
        let many = log(&[("a", 0), ("a", 1), ("a", 2)]);
        assert_eq!(compare(&many, &log(&[("a", 0)])).firings.agreement, Some(-1.0));
    }

    #[test]
    fn the_words_for_people_say_what_the_measures_are() {
        let some = log(&[("a", 0), ("a", 1), ("a", 2)]);
        let text = compare(&some, &log(&[("a", 0)])).to_string();
        assert!(text.contains("-100.0 %"), "{text}");
        let legend = text.rsplit("\n\n").next().unwrap_or_default();
        assert_eq!(legend, MEASURES);
        for heading in ["agreement ", "gaps apart "] {
            let is_shown = text.lines().next().is_some_and(|line| line.contains(heading.trim()));
            assert!(is_shown && legend.lines().any(|line| line.starts_with(heading)), "{heading}");
        }
    }

    #[test]
    fn distances_of_samples_are_those_of_their_shares() {
        assert_eq!(distance([vec![1, 2, 3], vec![3, 1, 2]]), Some(0.0));
        assert_eq!(distance([vec![1, 2], vec![3, 4, 5]]), Some(1.0));
        assert_eq!(distance([vec![1, 1, 2, 2], vec![1, 2, 2, 2]]), Some(0.25));
        assert_eq!(distance([vec![1, 3], vec![2, 4]]), Some(0.5));
        assert_eq!(distance([vec![7], vec![]]), None);
    }

    #[test]
    fn random_distances_agree_with_the_definition() {
        let mut numbers = crate::sample::TestRandom(5);
        for _ in 0..200 {
            let mut sample = || -> Vec<i64> { (0..1 + numbers.below(20)).map(|_| numbers.below(15)).collect() };
            let samples = [sample(), sample()];
            let share = |sample: &[i64], x| sample.iter().filter(|&&gap| gap <= x).count() as f64 / sample.len() as f64;
            let apart = (0..15).map(|x| (share(&samples[0], x) - share(&samples[1], x)).abs());
            assert_eq!(distance(samples.clone()), Some(apart.fold(0.0, f64::max)));
        }
    }

    #[test]
    fn activities_are_compared_whenever_they_were_done() {
        let during = |name: &str, begin, end| {
            let [begin, end] = [begin, end].map(WallTime::from_micros);
            Episode::new(name.to_owned(), Interval::new(begin, end))
        };
        let mut a = log(&[("m", 0), ("m", 5), ("m", 9), ("m", 20)]);
        let mut b = log(&[("m", 100), ("m", 105), ("m", 120)]);
        assert!(compare(&a, &b).activities.is_empty());
        a.activities = vec![during("cook", 0, 9), during("sleep", 9, 30)];
        b.activities = vec![during("sleep", 90, 102), during("cook", 102, 130)];
        let compared = compare(&a, &b);
        let counts: Vec<_> = compared.activities.iter().map(|of| (of.activity.as_str(), of.firings)).collect();
        assert_eq!(
            counts,
            [
                ("cook", AgreementCounts::from_counts([2, 2], [1.0; 2])),
                ("sleep", AgreementCounts::from_counts([2, 1], [1.0; 2]))
            ]
        );
        assert_eq!(compared.agreement_by_activity, Some(1.0 - 1.0 / 3.0));
        b.activities.clear();
        let compared = compare(&a, &b);
        assert_eq!(
            compared.activities[0].firings,
            AgreementCounts::from_counts([2, 0], [1.0; 2]),
            "the other's activities are taken for its own"
        );
    }

    #[test]
    fn sensors_come_in_the_order_of_their_numbers() {
        let log = log(&[("a11", 0), ("a3", 1), ("b", 2), ("a3 x2", 3), ("a", 4), ("a3 x10", 5), ("ä007", 6), ("3", 7)]);
        let compared = compare(&log, &log);
        let names: Vec<&str> = compared.sensors.iter().map(|sensor| sensor.sensor.as_str()).collect();
        assert_eq!(names, ["3", "a", "a3", "a3 x2", "a3 x10", "a11", "b", "ä007"]);
    }

    #[test]
    fn logs_of_different_spans_and_names_say_so() {
        let day = DAY.micros();
        let (a, b) = (log(&[("a", 0), ("a", 7 * day)]), log(&[("b", 0), ("b", 5), ("b", day)]));
        let compared = compare(&a, &b);
        assert_eq!((compared.span_s, compared.sensors_in_common), ([604_800.0, 86_400.0], 0));
        assert_eq!((compared.dates, compared.is_by_day), ([8, 2], true));
        let table = compared.to_string();
        assert!(table.contains("The logs have 8 and 2 dates: all numbers of firings are those of a day."), "{table}");
        assert!(table.contains("No sensor fired in both"), "{table}");
    }

    #[test]
    fn logs_of_different_lengths_are_compared_by_day() {
        let daily = |days: i64, a_day: i64| {
            let at = |on: i64, which: i64| (on * DAY + which * MINUTE).micros();
            let rows: Vec<(&str, i64)> =
                (0..days).flat_map(|on| (0..a_day).map(move |which| ("a", at(on, which)))).collect();
            log(&rows)
        };
        let compared = compare(&daily(90, 10), &daily(7, 10));
        assert_eq!((compared.firings.a, compared.firings.b), (900, 70));
        assert_eq!((compared.firings.agreement, compared.agreement_by_sensor), (Some(1.0), Some(1.0)));
        assert_eq!(compare(&daily(90, 5), &daily(7, 10)).firings.agreement, Some(0.5));
        // As many dates: plain counts.
        assert!(!compare(&daily(7, 5), &daily(7, 10)).is_by_day);
        assert!(compared.to_string().contains("10.0       10.0    100.0 %"), "{compared}");
    }

    #[test]
    fn people_get_a_table() {
        let a = log(&[("kitchen motion", 0), ("kitchen motion", 7), ("fridge", 9)]);
        let b = log(&[("kitchen motion", 0), ("kitchen motion", 8)]);
        let table = compare(&a, &b).to_string();
        assert_eq!(
            table.trim_end_matches(MEASURES),
            "sensor              firings  reference  agreement  gaps apart\n\
             fridge                    1          0          -           -\n\
             kitchen motion            2          2    100.0 %       1.000\n\
             all together              3          2     50.0 %       1.000\n\
             sensor by sensor                           50.0 %       1.000\n\n"
        );
    }
}
