//! What is wrong with sensors, by what they say and by what they leave unsaid of people whom all sensors together tell of.

use crate::learn::Senses;
use crate::said::Message;
use crate::smooth::{Instant, Smoother};
use crate::spells::{Ill, Spell, spells};
use crate::steps::Steps;
use crate::watch::{Day, Watch};
use homebody_core::geometry::Point;
use homebody_core::time::{DAY, Micros};
use serde::Serialize;

/// What is wrong with a sensor.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(tag = "ailment", rename_all = "snake_case")]
pub enum Ailment {
    /// It repeats itself at even spaces.
    Stuck,
    /// It does not notice people any more, whether or not it fires for no reason.
    Dead,
    /// It noticed less and less before it noticed nothing: its battery is weak.
    Fading,
    /// It notices, or its messages arrive, this much more seldom than before: the share that is lost, from 0 to 1.
    Loses {
        /// The share.
        share: f64,
    },
    /// It fires for no reason.
    Noisy {
        /// How often, in firings an hour.
        per_h: f64,
    },
    /// It notices people elsewhere than where it looks by the plan.
    Moved,
    /// Its clock is off.
    Clock {
        /// How far it is ahead on the last day, in seconds; below 0 behind.
        ahead_s: f64,
        /// How much faster than it should it runs, in microseconds a second.
        ppm: f64,
    },
}

/// Something that is wrong with a sensor for a time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Finding {
    /// Index into the home's sensors.
    pub sensor: usize,
    /// Since when, in microseconds since the start.
    pub from: Micros,
    /// Until when.
    pub to: Micros,
    /// What it is.
    #[serde(flatten)]
    pub ailment: Ailment,
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

/// An examination of the sensors of a log: passes over the log, which are independent of each other, and the findings of all passes.
///
/// A sensor's messages move the people whom it is compared with. So the first pass hears all sensors, and each later pass leaves
/// some of them out and compares these with the people of all others.
pub struct Examination<'a> {
    bodies: &'a [Senses],
    messages: &'a [Message],
    end: Micros,
    /// By sensor, its messages.
    own: Vec<Vec<Message>>,
    spells: Vec<Spell>,
    /// By pass: the same, and those of the sensors that it leaves out.
    spells_of: Vec<Vec<Spell>>,
    /// The sensors that notice people.
    feel: Vec<usize>,
    nobody: Senses,
}

/// A pass that has begun.
pub struct Pass<'a> {
    messages: std::slice::Iter<'a, Message>,
    end: Micros,
    smoother: Smoother<'a>,
    watch: Watch<'a>,
}

/// The days of each sensor that one pass counted.
pub struct Counted(Vec<Vec<Day>>);

impl<'a> Examination<'a> {
    /// The number of passes.
    pub const PASSES: usize = 1 + PARTS;

    /// Examines messages in order of time and up to `end`, by these bodies. `None` without a body.
    pub fn new(bodies: &'a [Senses], messages: &'a [Message], end: Micros) -> Option<Examination<'a>> {
        let sensors = bodies.first()?.timing.len();
        let mut own = vec![Vec::new(); sensors];
        messages.iter().for_each(|message| own[message.sensor].push(*message));
        let feel: Vec<usize> = (0..sensors).filter(|&sensor| bodies[0].timing[sensor].feels).collect();
        let spells = spells(messages.iter().copied(), sensors, end);
        let dead = |sensor: usize| Spell { sensor, from: 0, to: end, ill: Ill::Dead };
        let of_pass = |pass: usize| spells.iter().copied().chain(left_out(&feel, pass).into_iter().map(dead)).collect();
        let spells_of = (0..Examination::PASSES).map(of_pass).collect();
        let nobody = bodies[0].nobody();
        Some(Examination { bodies, messages, end, own, spells, spells_of, feel, nobody })
    }

    /// Begins one pass.
    pub fn pass(&self, pass: usize) -> Pass<'_> {
        let timing = &self.bodies[0].timing;
        Pass {
            messages: self.messages.iter(),
            end: self.end,
            smoother: Smoother::new(self.bodies, &self.nobody, Steps::new(timing, &self.spells_of[pass])),
            watch: Watch::new(timing, &self.own),
        }
    }

    /// The findings of all passes, in order of time.
    pub fn findings(&self, passes: &[Counted]) -> Vec<Finding> {
        let mut findings: Vec<Finding> = self.spells.iter().map(Finding::of_spell).collect();
        let Some((Counted(all), others)) = passes.split_first() else { return findings };
        for &sensor in &self.feel {
            // The messages alone tell a spell to the second.
            let known: Vec<Finding> = findings.iter().filter(|finding| finding.sensor == sensor).copied().collect();
            for finding in of_days(&all[sensor]).into_iter().map(|of_days| Finding::of_days(sensor, of_days)) {
                match known.iter().find(|known| known.from < finding.to && finding.from < known.to) {
                    Some(known) if finding.ailment == Ailment::Fading => {
                        findings.retain(|one| one != known);
                        findings.push(Finding { to: known.to, ..finding });
                    }
                    Some(_) => {}
                    None => findings.push(finding),
                }
            }
        }
        let mut clocks = Vec::new();
        for (part, Counted(of_others)) in others.iter().enumerate() {
            for sensor in left_out(&self.feel, part + 1) {
                let days = &of_others[sensor];
                clocks.extend(clock(days).map(|ailment| Finding { sensor, from: 0, to: self.end, ailment }));
                let is_doubtful = findings.iter().any(|finding| finding.sensor == sensor);
                let moved = moved(days).filter(|_| is_doubtful).map(|found| Finding::of_days(sensor, found));
                moved.into_iter().for_each(|moved| moved.put_into(&mut findings));
            }
        }
        odd_clocks(clocks).into_iter().for_each(|clock| clock.put_into(&mut findings));
        findings.sort_by_key(|finding| (finding.from, finding.sensor));
        findings
    }
}

/// Examines the sensors of a log, one pass after the other.
pub fn health(bodies: &[Senses], messages: &[Message], end: Micros) -> Vec<Finding> {
    let Some(examination) = Examination::new(bodies, messages, end) else { return Vec::new() };
    let counted = |pass: usize| {
        let mut pass = examination.pass(pass);
        while pass.go_on().is_some() {}
        pass.counted()
    };
    examination.findings(&(0..Examination::PASSES).map(counted).collect::<Vec<Counted>>())
}

/// The sensors that a pass leaves out, of those that notice people.
fn left_out(feel: &[usize], pass: usize) -> Vec<usize> {
    let of_part = |part: usize| feel.iter().copied().skip(part).step_by(PARTS).collect();
    pass.checked_sub(1).map(of_part).unwrap_or_default()
}

impl Pass<'_> {
    /// Goes on by some thousands of instants: the share of the log that is done, from 0 to 1; `None` at its end.
    pub fn go_on(&mut self) -> Option<f64> {
        let Pass { messages, end, smoother, watch } = self;
        let mut done = 0;
        let mut see = |instant: Instant| {
            watch.see(&instant);
            done = instant.at;
        };
        if messages.any(|message| smoother.hear(message, &mut see)) {
            return Some(done as f64 / (*end).max(1) as f64);
        }
        smoother.end(*end, &mut see);
        None
    }

    /// The days of each sensor, once it is at its end.
    pub fn counted(self) -> Counted {
        Counted(self.watch.finish())
    }
}

impl Finding {
    fn of_spell(spell: &Spell) -> Finding {
        let ailment = match spell.ill {
            Ill::Stuck => Ailment::Stuck,
            Ill::Dead => Ailment::Dead,
        };
        Finding { sensor: spell.sensor, from: spell.from, to: spell.to, ailment }
    }

    /// Takes the place of all that is found of its sensor at its time.
    fn put_into(self, findings: &mut Vec<Finding>) {
        findings.retain(|one| one.sensor != self.sensor || one.to <= self.from || one.from >= self.to);
        findings.push(self);
    }

    fn of_days(sensor: usize, OfDays { first, last, ailment }: OfDays) -> Finding {
        Finding { sensor, from: first as Micros * DAY, to: (last as Micros + 1) * DAY, ailment }
    }
}

/// What is wrong with one sensor from one day to another.
#[derive(Clone, Copy, Debug, PartialEq)]
struct OfDays {
    first: usize,
    last: usize,
    ailment: Ailment,
}

/// What is wrong with one sensor, by its days.
fn of_days(days: &[Day]) -> Vec<OfDays> {
    let mut found: Vec<OfDays> = noisy(days).into_iter().collect();
    found.extend(lost(days).into_iter().map(|Lost { first, last, left, parts }| {
        let ailment = match () {
            () if fades(&parts) => Ailment::Fading,
            () if left < NOTHING => Ailment::Dead,
            () => Ailment::Loses { share: 1.0 - left },
        };
        OfDays { first, last, ailment }
    }));
    found
}

/// Of clocks that are off beside each other, some ahead and some behind, those that are fewer: the others agree.
fn odd_clocks(clocks: Vec<Finding>) -> Vec<Finding> {
    let is_ahead = |finding: &Finding| matches!(finding.ailment, Ailment::Clock { ahead_s, .. } if ahead_s > 0.0);
    let (ahead, behind): (Vec<Finding>, Vec<Finding>) = clocks.into_iter().partition(is_ahead);
    match (ahead.len(), behind.len()) {
        (a, b) if a < b && a > 0 => ahead,
        (a, b) if b < a && b > 0 => behind,
        _ => ahead.into_iter().chain(behind).collect(),
    }
}

/// Whether a sensor looks elsewhere, by what others tell, and on which days.
fn moved(days: &[Day]) -> Option<OfDays> {
    let lost = lost(days).into_iter().find(|lost| looks_elsewhere(&days[lost.first..=lost.last]))?;
    Some(OfDays { first: lost.first, last: lost.last, ailment: Ailment::Moved })
}

/// Days on which a sensor notices less than on its others.
#[derive(Clone, Debug, PartialEq)]
struct Lost {
    first: usize,
    last: usize,
    /// The part that is left, of what it notices else.
    left: f64,
    /// The same by day, of those on which there was something to notice.
    parts: Vec<f64>,
}

/// The days, each with others in a row, on which less is noticed than on all others: those that differ most come first, and
/// are left out for those that come next.
fn lost(days: &[Day]) -> Vec<Lost> {
    let mut part: Vec<Option<f64>> =
        days.iter().map(|day| (day.expected >= LEAST).then(|| f64::from(day.explained) / day.expected)).collect();
    let mut found = Vec::new();
    while let Some((mut first, last, usual)) = differs_most(&part) {
        // It begins on a day on which little is noticed.
        while first < last && part[first].is_none_or(|part| part > LOST * usual) {
            first += 1;
        }
        let parts: Vec<f64> = part[first..=last].iter().flatten().map(|part| part / usual).collect();
        let left = parts.iter().sum::<f64>() / parts.len() as f64;
        let expected: f64 = days[first..=last].iter().map(|day| day.expected).sum();
        if expected * usual >= MISSED {
            found.push(Lost { first, last, left, parts });
        }
        part[first..=last].fill(None);
    }
    found.sort_by_key(|lost| lost.first);
    found
}

/// The first and the last of the days whose part is most surely smaller than that of all others, and the mean of these.
fn differs_most(part: &[Option<f64>]) -> Option<(usize, usize, f64)> {
    let mut best: Option<(f64, (usize, usize, f64))> = None;
    // Up to each day: how many parts there are, their sum, and the sum of their squares.
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

/// Whether less and less is noticed, until it is nothing.
fn fades(parts: &[f64]) -> bool {
    let nothing = parts.iter().position(|&part| part < NOTHING).unwrap_or(0);
    nothing >= FADES && parts[..=nothing].windows(2).filter(|pair| pair[1] > pair[0]).count() <= nothing / 3
}

/// Whether a sensor fires for no reason, on which days, and how often.
fn noisy(days: &[Day]) -> Option<OfDays> {
    let is_noisy = |day: &Day| {
        let count = day.unexplained.len() as f64;
        count >= NOISE && count >= NOISE_SHARE * (count + f64::from(day.explained))
    };
    let first = days.iter().position(is_noisy)?;
    let last = days.iter().rposition(is_noisy)?;
    let count: usize = days[first..=last].iter().map(|day| day.unexplained.len()).sum();
    let per_h = count as f64 / ((last + 1 - first) * 24) as f64;
    Some(OfDays { first, last, ailment: Ailment::Noisy { per_h } })
}

/// Whether what is unexplained comes while people are in one other place.
fn looks_elsewhere(days: &[Day]) -> bool {
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

/// Whether a sensor's clock is off, of the days on which that can be told: it is so on most, and goes on evenly.
fn clock(days: &[Day]) -> Option<Ailment> {
    let told: Vec<(f64, f64)> =
        days.iter().enumerate().filter_map(|(day, of)| Some((day as f64 + 0.5, of.ahead_s?))).collect();
    if told.len() < CLOCK_DAYS {
        return None;
    }
    // The median of all slopes minds no day that is far off.
    let slopes =
        told.iter().enumerate().flat_map(|(place, a)| told[place + 1..].iter().map(move |b| (b.1 - a.1) / (b.0 - a.0)));
    let slope = median(slopes.collect());
    let begin = median(told.iter().map(|(day, ahead)| ahead - slope * day).collect());
    let off = median(told.iter().map(|(day, ahead)| (ahead - begin - slope * day).abs()).collect());
    let is_off = median(told.iter().map(|one| one.1.abs()).collect()) >= CLOCK_S && off <= CLOCK_S;
    let end = days.len() as f64;
    is_off.then_some(Ailment::Clock { ahead_s: begin + slope * end, ppm: slope / 86_400.0 * 1e6 })
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn day(expected: f64, explained: u32) -> Day {
        Day { expected, explained, ..Day::default() }
    }

    fn only(days: &[Day]) -> Option<Ailment> {
        let found = of_days(days);
        assert!(found.len() < 2, "{found:?}");
        found.first().map(|one| one.ailment)
    }

    #[test]
    fn a_sensor_that_notices_what_it_should_is_well() {
        let parts = [40, 44, 38, 30, 41, 39, 45, 28, 40, 42];
        assert_eq!(only(&parts.map(|noticed| day(42.0, noticed))), None);
    }

    #[test]
    fn one_that_notices_nothing_less_and_less_or_a_part_is_dead_fading_or_on_a_bad_way() {
        let of = |parts: &[u32]| only(&parts.iter().map(|&noticed| day(40.0, noticed)).collect::<Vec<_>>());
        assert_eq!(of(&[40, 38, 41, 39, 40, 0, 0]), Some(Ailment::Dead));
        assert_eq!(of(&[40, 38, 41, 39, 40, 25, 16, 9, 2]), Some(Ailment::Fading));
        let Some(Ailment::Loses { share }) = of(&[40, 38, 41, 39, 40, 20, 18, 21, 19]) else { panic!() };
        assert!((share - 0.5).abs() < 0.1, "{share}");
    }

    #[test]
    fn what_has_no_reason_is_noise_and_what_has_one_elsewhere_is_moved() {
        let mut noisy: Vec<Day> = (0..6).map(|_| day(40.0, 40)).collect();
        noisy[4].unexplained = (0..24).map(|one| (one % 3 > 0).then(|| Point::new(f64::from(one), 0.0))).collect();
        assert_eq!(only(&noisy), Some(Ailment::Noisy { per_h: 1.0 }));
        let mut moved = noisy.clone();
        for day in &mut moved[3..] {
            day.explained = 2;
            day.unexplained = (0..24).map(|one| Some(Point::new(5.0 + f64::from(one % 2), 1.0))).collect();
        }
        assert_eq!(super::moved(&moved), Some(OfDays { first: 3, last: 5, ailment: Ailment::Moved }));
        assert_eq!(super::moved(&noisy), None);
    }

    #[test]
    fn a_clock_that_runs_too_fast_is_further_ahead_each_day() {
        let days: Vec<Day> =
            (0..6).map(|number| Day { ahead_s: Some(20.0 + 10.0 * f64::from(number)), ..day(40.0, 10) }).collect();
        let Some(Ailment::Clock { ahead_s, ppm }) = clock(&days) else { panic!("{days:?}") };
        assert!((ahead_s - 75.0).abs() < 1.0 && (ppm - 115.7).abs() < 1.0, "{ahead_s} {ppm}");
        // One that runs right is off beside one that does not.
        let finding = |sensor: usize, ahead_s: f64| {
            let ailment = Ailment::Clock { ahead_s, ppm };
            Finding { sensor, from: 0, to: DAY, ailment }
        };
        let all = vec![finding(0, -74.0), finding(1, 75.0), finding(2, -76.0)];
        assert_eq!(odd_clocks(all.clone()), [all[1]]);
        assert_eq!(odd_clocks(vec![all[1]]), [all[1]]);
    }
}
