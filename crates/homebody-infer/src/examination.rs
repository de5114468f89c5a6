//! Sensor faults, found by comparing each sensor with the people that all sensors together locate.

use crate::fault_interval::{FaultInterval, FaultIntervalKind, fault_intervals};
use crate::log_step::LogSteps;
use crate::message::LogMessage;
use crate::senses::Senses;
use crate::sensor_day::{SensorDayCounts, SensorWatch};
use crate::smoother::{InstantEstimate, Smoother};
use homebody_core::geometry::Point;
use homebody_core::time::{DAY, RunTime, Span};
use serde::Serialize;

#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(tag = "ailment", rename_all = "snake_case")]
pub enum SensorFault {
    /// It repeats itself at even intervals.
    Stuck,
    /// It detects no people, whether or not it fires without a cause.
    Dead,
    /// It detected less and less until it detected nothing, as with a weak battery.
    Fading,
    /// A share of its detections or messages is lost.
    Loses {
        /// From 0 to 1.
        share: f64,
    },
    Noisy {
        /// Firings per hour.
        per_h: f64,
    },
    /// It detects people in another place than the plan says.
    Moved,
    Clock {
        /// Error on the last day in seconds; negative if slow.
        ahead_s: f64,
        /// Drift in microseconds per second; positive if fast.
        ppm: f64,
    },
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct FaultFinding {
    pub sensor: usize,
    pub from: RunTime,
    pub to: RunTime,
    #[serde(flatten)]
    pub ailment: SensorFault,
}

/// Share of its usual detections below which a sensor detects nothing, and share that a faulty sensor has lost (our
/// choice).
const NOTHING: f64 = 0.12;
const LOST: f64 = 0.7;
/// Smallest number of expected detections, on a day and in all, of evidence that counts (our choice).
const LEAST: f64 = 8.0;
const MISSED: f64 = 15.0;
/// Smallest number of other days for comparison, smallest variation of their mean, and standard errors of the
/// difference (our choice).
const OTHER_DAYS: f64 = 3.0;
const VARIES: f64 = 0.1;
const SURE: f64 = 6.0;
/// Number of days over which a sensor fades (our choice).
const FADES: usize = 2;
/// Number of groups of sensors (our choice). One group at a time is left out.
const PARTS: usize = 4;
/// Smallest number of unexplained firings a day of a noisy sensor, and their smallest share of all (our choice).
const NOISE: f64 = 6.0;
const NOISE_SHARE: f64 = 0.15;
/// Share of the unexplained firings with people within this distance of one place if a sensor looks elsewhere (our
/// choice).
const TOGETHER: f64 = 0.6;
const TOGETHER_M: f64 = 2.0;
/// Smallest number of days, and of seconds, of a clock's error, and largest difference of the error between those days
/// (our choice).
const CLOCK_DAYS: usize = 4;
const CLOCK_S: f64 = 15.0;

/// Passes over a log, which are independent of each other, and the findings of all passes.
///
/// A sensor's messages move the people whom it is compared with. So the first pass uses all sensors, and each later pass
/// leaves out some and compares these with the people that the others locate.
pub struct Examination<'a> {
    bodies: &'a [Senses],
    messages: &'a [LogMessage],
    end: RunTime,
    own: Vec<Vec<LogMessage>>,
    faults: Vec<FaultInterval>,
    /// By pass: the intervals of all sensors, and the whole log for those that the pass leaves out.
    intervals_by_pass: Vec<Vec<FaultInterval>>,
    feel: Vec<usize>,
    empty_body: Senses,
}

pub struct ExaminationPass<'a> {
    messages: std::slice::Iter<'a, LogMessage>,
    end: RunTime,
    smoother: Smoother<'a>,
    watch: SensorWatch<'a>,
}

pub struct PassCounts(Vec<Vec<SensorDayCounts>>);

impl<'a> Examination<'a> {
    pub const PASSES: usize = 1 + PARTS;

    /// `messages` are in order of time and end before `end`. `None` without a body.
    pub fn new(bodies: &'a [Senses], messages: &'a [LogMessage], end: RunTime) -> Option<Examination<'a>> {
        let sensors = bodies.first()?.timing.len();
        let mut own = vec![Vec::new(); sensors];
        messages.iter().for_each(|message| own[message.sensor].push(*message));
        let feel: Vec<usize> = (0..sensors).filter(|&sensor| bodies[0].timing[sensor].feels).collect();
        let faults = fault_intervals(messages.iter().copied(), sensors, end);
        let dead =
            |sensor: usize| FaultInterval { sensor, from: RunTime::START, to: end, ill: FaultIntervalKind::Dead };
        let of_pass = |pass: usize| faults.iter().copied().chain(left_out(&feel, pass).into_iter().map(dead)).collect();
        let intervals_by_pass = (0..Examination::PASSES).map(of_pass).collect();
        let empty_body = bodies[0].empty_body();
        Some(Examination { bodies, messages, end, own, faults, intervals_by_pass, feel, empty_body })
    }

    pub fn pass(&self, pass: usize) -> ExaminationPass<'_> {
        let timing = &self.bodies[0].timing;
        ExaminationPass {
            messages: self.messages.iter(),
            end: self.end,
            smoother: Smoother::new(
                self.bodies,
                &self.empty_body,
                LogSteps::new(timing, &self.intervals_by_pass[pass]),
            ),
            watch: SensorWatch::new(timing, &self.own),
        }
    }

    pub fn findings(&self, passes: &[PassCounts]) -> Vec<FaultFinding> {
        let mut findings: Vec<FaultFinding> = self.faults.iter().map(FaultFinding::from_interval).collect();
        let Some((PassCounts(all), others)) = passes.split_first() else { return findings };
        for &sensor in &self.feel {
            // The messages alone give these intervals to the second.
            let known: Vec<FaultFinding> =
                findings.iter().filter(|finding| finding.sensor == sensor).copied().collect();
            for finding in fault_days(&all[sensor]).into_iter().map(|days| FaultFinding::from_days(sensor, days)) {
                match known.iter().find(|known| known.from < finding.to && finding.from < known.to) {
                    Some(known) if finding.ailment == SensorFault::Fading => {
                        findings.retain(|one| one != known);
                        findings.push(FaultFinding { to: known.to, ..finding });
                    }
                    Some(_) => {}
                    None => findings.push(finding),
                }
            }
        }
        let mut clocks = Vec::new();
        for (part, PassCounts(of_others)) in others.iter().enumerate() {
            for sensor in left_out(&self.feel, part + 1) {
                let days = &of_others[sensor];
                let of_all_time = |ailment| FaultFinding { sensor, from: RunTime::START, to: self.end, ailment };
                clocks.extend(clock(days).map(of_all_time));
                let is_doubtful = findings.iter().any(|finding| finding.sensor == sensor);
                let moved = moved(days).filter(|_| is_doubtful).map(|found| FaultFinding::from_days(sensor, found));
                moved.into_iter().for_each(|moved| moved.put_into(&mut findings));
            }
        }
        odd_clocks(clocks).into_iter().for_each(|clock| clock.put_into(&mut findings));
        findings.sort_by_key(|finding| (finding.from, finding.sensor));
        findings
    }
}

pub fn health(bodies: &[Senses], messages: &[LogMessage], end: RunTime) -> Vec<FaultFinding> {
    let Some(examination) = Examination::new(bodies, messages, end) else { return Vec::new() };
    let counted = |pass: usize| {
        let mut pass = examination.pass(pass);
        while pass.advance().is_some() {}
        pass.counted()
    };
    examination.findings(&(0..Examination::PASSES).map(counted).collect::<Vec<PassCounts>>())
}

fn left_out(feel: &[usize], pass: usize) -> Vec<usize> {
    let of_part = |part: usize| feel.iter().copied().skip(part).step_by(PARTS).collect();
    pass.checked_sub(1).map(of_part).unwrap_or_default()
}

impl ExaminationPass<'_> {
    /// Processes some thousands of instants. Returns the share of the log that is done, or `None` at its end.
    pub fn advance(&mut self) -> Option<f64> {
        let ExaminationPass { messages, end, smoother, watch } = self;
        let mut done = RunTime::START;
        let mut see = |instant: InstantEstimate| {
            watch.see(&instant);
            done = instant.at;
        };
        if messages.any(|message| smoother.hear(message, &mut see)) {
            return Some(done.since_zero().ratio(end.since_zero().max(Span::MICROSECOND)));
        }
        smoother.end(*end, &mut see);
        None
    }

    pub fn counted(self) -> PassCounts {
        PassCounts(self.watch.finish())
    }
}

impl FaultFinding {
    fn from_interval(interval: &FaultInterval) -> FaultFinding {
        let ailment = match interval.ill {
            FaultIntervalKind::Stuck => SensorFault::Stuck,
            FaultIntervalKind::Dead => SensorFault::Dead,
        };
        FaultFinding { sensor: interval.sensor, from: interval.from, to: interval.to, ailment }
    }

    fn put_into(self, findings: &mut Vec<FaultFinding>) {
        findings.retain(|one| one.sensor != self.sensor || one.to <= self.from || one.from >= self.to);
        findings.push(self);
    }

    fn from_days(sensor: usize, FaultDays { first, last, ailment }: FaultDays) -> FaultFinding {
        let midnight = |day: usize| RunTime::START + day as i64 * DAY;
        FaultFinding { sensor, from: midnight(first), to: midnight(last + 1), ailment }
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct FaultDays {
    first: usize,
    last: usize,
    ailment: SensorFault,
}

fn fault_days(days: &[SensorDayCounts]) -> Vec<FaultDays> {
    let mut found: Vec<FaultDays> = noisy(days).into_iter().collect();
    found.extend(lost(days).into_iter().map(|LossDays { first, last, left, parts }| {
        let ailment = match () {
            () if fades(&parts) => SensorFault::Fading,
            () if left < NOTHING => SensorFault::Dead,
            () => SensorFault::Loses { share: 1.0 - left },
        };
        FaultDays { first, last, ailment }
    }));
    found
}

/// Of clocks that disagree, the minority: the others confirm each other.
fn odd_clocks(clocks: Vec<FaultFinding>) -> Vec<FaultFinding> {
    let is_ahead =
        |finding: &FaultFinding| matches!(finding.ailment, SensorFault::Clock { ahead_s, .. } if ahead_s > 0.0);
    let (ahead, behind): (Vec<FaultFinding>, Vec<FaultFinding>) = clocks.into_iter().partition(is_ahead);
    match (ahead.len(), behind.len()) {
        (a, b) if a < b && a > 0 => ahead,
        (a, b) if b < a && b > 0 => behind,
        _ => ahead.into_iter().chain(behind).collect(),
    }
}

fn moved(days: &[SensorDayCounts]) -> Option<FaultDays> {
    let lost = lost(days).into_iter().find(|lost| looks_elsewhere(&days[lost.first..=lost.last]))?;
    Some(FaultDays { first: lost.first, last: lost.last, ailment: SensorFault::Moved })
}

/// Days on which a sensor detects less than on its others.
#[derive(Clone, Debug, PartialEq)]
struct LossDays {
    first: usize,
    last: usize,
    /// Share of the usual detections.
    left: f64,
    /// By day with something to detect.
    parts: Vec<f64>,
}

/// The days in a row on which less is detected than on all others; the clearest come first and are excluded from later
/// comparisons.
fn lost(days: &[SensorDayCounts]) -> Vec<LossDays> {
    let mut part: Vec<Option<f64>> =
        days.iter().map(|day| (day.expected >= LEAST).then(|| f64::from(day.explained) / day.expected)).collect();
    let mut found = Vec::new();
    while let Some((mut first, last, usual)) = differs_most(&part) {
        // It begins on a day with few detections.
        while first < last && part[first].is_none_or(|part| part > LOST * usual) {
            first += 1;
        }
        let parts: Vec<f64> = part[first..=last].iter().flatten().map(|part| part / usual).collect();
        let left = parts.iter().sum::<f64>() / parts.len() as f64;
        let expected: f64 = days[first..=last].iter().map(|day| day.expected).sum();
        if expected * usual >= MISSED {
            found.push(LossDays { first, last, left, parts });
        }
        part[first..=last].fill(None);
    }
    found.sort_by_key(|lost| lost.first);
    found
}

/// The first and last day whose share is most surely below that of all others, and the mean of these.
fn differs_most(part: &[Option<f64>]) -> Option<(usize, usize, f64)> {
    let mut best: Option<(f64, (usize, usize, f64))> = None;
    // Prefix sums: number, sum, and sum of squares.
    let mut sums = vec![[0.0; 3]];
    for part in part {
        let [count, sum, squares] = sums.last().copied().unwrap_or_default();
        sums.push(part.map_or([count, sum, squares], |part| [count + 1.0, sum + part, squares + part * part]));
    }
    let all = sums.last().copied().unwrap_or_default();
    for (first, begin) in sums.iter().enumerate() {
        for (last, end) in sums.iter().enumerate().skip(first + 1).filter(|(last, _)| part[last - 1].is_some()) {
            let inside = [0, 1, 2].map(|sum| end[sum] - begin[sum]);
            let outside = [0, 1, 2].map(|sum| all[sum] - inside[sum]);
            if part[first].is_none() || inside[0] < 1.0 || outside[0] < OTHER_DAYS || outside[1] <= 0.0 {
                continue;
            }
            let [mean, usual] = [inside, outside].map(|[count, sum, _]| sum / count);
            let variance = (outside[2] / outside[0] - usual * usual).max(libm::pow(VARIES * usual, 2.0));
            let sure = (usual - mean) / libm::sqrt(variance * (1.0 / inside[0] + 1.0 / outside[0]));
            if mean <= LOST * usual && sure >= SURE && best.as_ref().is_none_or(|best| sure > best.0) {
                best = Some((sure, (first, last - 1, usual)));
            }
        }
    }
    best.map(|best| best.1)
}

fn fades(parts: &[f64]) -> bool {
    let nothing = parts.iter().position(|&part| part < NOTHING).unwrap_or(0);
    nothing >= FADES && parts[..=nothing].windows(2).filter(|pair| pair[1] > pair[0]).count() <= nothing / 3
}

fn noisy(days: &[SensorDayCounts]) -> Option<FaultDays> {
    let is_noisy = |day: &SensorDayCounts| {
        let count = day.unexplained.len() as f64;
        count >= NOISE && count >= NOISE_SHARE * (count + f64::from(day.explained))
    };
    let first = days.iter().position(is_noisy)?;
    let last = days.iter().rposition(is_noisy)?;
    let count: usize = days[first..=last].iter().map(|day| day.unexplained.len()).sum();
    let per_h = count as f64 / ((last + 1 - first) * 24) as f64;
    Some(FaultDays { first, last, ailment: SensorFault::Noisy { per_h } })
}

/// Whether the unexplained firings happen while people are in one other place.
fn looks_elsewhere(days: &[SensorDayCounts]) -> bool {
    let all = || days.iter().flat_map(|day| &day.unexplained);
    let home: Vec<Point> = all().flatten().copied().collect();
    let count = all().count();
    if (count as f64) < NOISE {
        return false;
    }
    let near = |at: &Point| home.iter().filter(|other| other.distance(*at) <= TOGETHER_M).count();
    let most = home.iter().map(near).max().unwrap_or(0);
    most as f64 >= TOGETHER * count as f64
}

/// The error must occur on most of the days that have an estimate, and be steady.
fn clock(days: &[SensorDayCounts]) -> Option<SensorFault> {
    let estimates: Vec<(f64, f64)> =
        days.iter().enumerate().filter_map(|(day, of)| Some((day as f64 + 0.5, of.ahead_s?))).collect();
    if estimates.len() < CLOCK_DAYS {
        return None;
    }
    // The median of all slopes is robust to single outliers.
    let slopes = estimates
        .iter()
        .enumerate()
        .flat_map(|(place, a)| estimates[place + 1..].iter().map(move |b| (b.1 - a.1) / (b.0 - a.0)));
    let slope = median(slopes.collect());
    let begin = median(estimates.iter().map(|(day, ahead)| ahead - slope * day).collect());
    let off = median(estimates.iter().map(|(day, ahead)| (ahead - begin - slope * day).abs()).collect());
    let is_off = median(estimates.iter().map(|one| one.1.abs()).collect()) >= CLOCK_S && off <= CLOCK_S;
    let end = days.len() as f64;
    is_off.then_some(SensorFault::Clock { ahead_s: begin + slope * end, ppm: slope / 86_400.0 * 1e6 })
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn day(expected: f64, explained: u32) -> SensorDayCounts {
        SensorDayCounts { expected, explained, ..SensorDayCounts::default() }
    }

    fn only(days: &[SensorDayCounts]) -> Option<SensorFault> {
        let found = fault_days(days);
        assert!(found.len() < 2, "{found:?}");
        found.first().map(|one| one.ailment)
    }

    #[test]
    fn sensor_with_expected_detections_has_no_fault() {
        let parts = [40, 44, 38, 30, 41, 39, 45, 28, 40, 42];
        assert_eq!(only(&parts.map(|noticed| day(42.0, noticed))), None);
    }

    #[test]
    fn missing_detections_mean_dead_fading_or_lossy() {
        let of = |parts: &[u32]| only(&parts.iter().map(|&noticed| day(40.0, noticed)).collect::<Vec<_>>());
        assert_eq!(of(&[40, 38, 41, 39, 40, 0, 0]), Some(SensorFault::Dead));
        assert_eq!(of(&[40, 38, 41, 39, 40, 25, 16, 9, 2]), Some(SensorFault::Fading));
        let Some(SensorFault::Loses { share }) = of(&[40, 38, 41, 39, 40, 20, 18, 21, 19]) else { panic!() };
        assert!((share - 0.5).abs() < 0.1, "{share}");
    }

    #[test]
    fn unexplained_firings_mean_noise_or_a_moved_sensor() {
        let mut noisy: Vec<SensorDayCounts> = (0..6).map(|_| day(40.0, 40)).collect();
        noisy[4].unexplained = (0..24).map(|one| (one % 3 > 0).then(|| Point::new(f64::from(one), 0.0))).collect();
        assert_eq!(only(&noisy), Some(SensorFault::Noisy { per_h: 1.0 }));
        let mut moved = noisy.clone();
        for day in &mut moved[3..] {
            day.explained = 2;
            day.unexplained = (0..24).map(|one| Some(Point::new(5.0 + f64::from(one % 2), 1.0))).collect();
        }
        assert_eq!(super::moved(&moved), Some(FaultDays { first: 3, last: 5, ailment: SensorFault::Moved }));
        assert_eq!(super::moved(&noisy), None);
    }

    #[test]
    fn fast_clock_has_a_growing_error() {
        let days: Vec<SensorDayCounts> = (0..6)
            .map(|number| SensorDayCounts { ahead_s: Some(20.0 + 10.0 * f64::from(number)), ..day(40.0, 10) })
            .collect();
        let Some(SensorFault::Clock { ahead_s, ppm }) = clock(&days) else { panic!("{days:?}") };
        assert!((ahead_s - 75.0).abs() < 1.0 && (ppm - 115.7).abs() < 1.0, "{ahead_s} {ppm}");
        let finding = |sensor: usize, ahead_s: f64| {
            let ailment = SensorFault::Clock { ahead_s, ppm };
            FaultFinding { sensor, from: RunTime::START, to: RunTime::START + DAY, ailment }
        };
        let all = vec![finding(0, -74.0), finding(1, 75.0), finding(2, -76.0)];
        assert_eq!(odd_clocks(all.clone()), [all[1]]);
        assert_eq!(odd_clocks(vec![all[1]]), [all[1]]);
    }
}
