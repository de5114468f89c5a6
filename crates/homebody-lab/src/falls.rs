//! Falls and what looks like them, in a room with two cameras and motion sensors: what silhouettes find, what passive sensors find,
//! what both find together, and how often for nothing.
//!
//! Each case is a while in one living room with a bed, an armchair and a table: somebody falls, in one of five ways, and lies
//! there for 2 to 59 minutes, or does one of eight things that look like it. Cameras sleep until a motion sensor wakes them. What
//! is kept of a case is looked at by both cameras together, by each alone, by the motion sensors alone, and by both kinds of
//! sensors; and the case is lived again without noise, with more of it, and behind more furniture.
//!
//! An alarm finds a fall if it comes while somebody lies there. How often a day somebody does what looks like a fall is ours; false
//! alarms a day follow from it and from how many of these cases have an alarm, of which the first counts. What is told before
//! somebody falls finds nothing, and counts nowhere.
//!
//! Cases from seed 1 on are there to fit rules on; what is judged are those from [`FIRST_SEED`] on.
//!
//! Left out: two people at once, poor light, and falls that begin where no camera looks.

mod cases;
mod intervals;
mod look;
mod room;
mod weeks;

pub use cases::Case;
pub use look::{Method, WAYS, Way};
pub use room::Condition;
pub use weeks::{Home, OfWeeks};

use homebody_analysis::falls::rules::FallRules;
use homebody_core::drivers::error::DriverError;
use homebody_core::event::Events;
use homebody_core::run::Run;
use homebody_core::scenario::load::Scenario;
use homebody_core::time::{RunTime, SECOND, Span};
use homebody_picture::{TotalsLine, totals_chart};
use intervals::Counted;
use look::{Look, settings};
use rayon::prelude::*;
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt;

/// The seed of the first case that is judged; cases before it are there to fit rules on.
pub const FIRST_SEED: u64 = 1001;

/// A case goes on for so long after its story, so that the truth of it is told.
const AFTERWARDS: Span = SECOND.times(5);

/// How good a way of looking is.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// The way.
    #[serde(flatten)]
    pub way: Way,
    /// How many falls there were.
    pub falls: u32,
    /// The share of falls that were found.
    pub sensitivity: f64,
    /// Its interval of 95 % (Wilson 1927).
    pub sensitivity_interval: [f64; 2],
    /// Alarms a day without a fall.
    pub false_alarms_per_day: f64,
    /// Its interval of 95 %: exact Poisson limits of the sum of counts (Dobson et al. 1991).
    pub false_alarms_per_day_interval: [f64; 2],
    /// From a fall to its alarm, the median of those found; None where none was.
    pub seconds_to_alarm: Option<f64>,
    /// The interval of the median, by ranks.
    pub seconds_to_alarm_interval: Option<[f64; 2]>,
    /// The share of cases with an alarm, by what somebody does.
    pub alarms: BTreeMap<&'static str, f64>,
    /// False alarms a day and sensitivity with other limits, from the loosest.
    pub curve: Vec<(f64, f64)>,
}

/// What was found.
#[derive(Clone, Debug, Serialize)]
pub struct FallsExperiment {
    /// How many cases of each kind.
    pub cases: u32,
    /// The seed of the first.
    pub seed: u64,
    /// A row for each way of looking.
    pub rows: Vec<Row>,
    /// The same of weeks of a life.
    pub weeks: Vec<OfWeeks>,
}

/// Of a case, by setting: the seconds from the fall to its alarm, or 0 for an alarm without a fall.
type Outcome = Vec<Option<f64>>;

/// Lives `cases` of each kind, and so many weeks of a life in a home with cameras, and looks at them in all ways.
///
/// # Errors
///
/// If that life comes to a bad end.
pub fn experiment(
    cases: u32,
    seed: u64,
    rules: &FallRules,
    (home, weeks): (&Home, u32),
) -> Result<FallsExperiment, DriverError> {
    // The room is the same in all cases of a condition.
    let room = |way: &Way| room::scenario(Case::Cat, 0, way.condition).0;
    let looks: Vec<Look> = WAYS.iter().map(|way| Look::new(*way, &room(way).home, rules)).collect();
    let of_kind = |case: Case| (0..u64::from(cases)).map(move |number| (case, seed + number));
    let all: Vec<(Case, u64)> = Case::ALL.into_iter().flat_map(of_kind).collect();
    let outcomes: Vec<Vec<Outcome>> = all.par_iter().map(|&(case, seed)| lived(case, seed, &looks)).collect();
    let row = |(index, &way): (usize, &Way)| {
        let of_way = all.iter().zip(&outcomes).map(|(&(case, _), outcome)| (case, &outcome[index]));
        row(way, cases, &of_way.collect::<Vec<_>>())
    };
    let rows = WAYS.iter().enumerate().map(row).collect();
    Ok(FallsExperiment { cases, seed, rows, weeks: weeks::looked_at(home, weeks, seed, rules)? })
}

fn row(way: Way, cases: u32, outcomes: &[(Case, &Outcome)]) -> Row {
    let alarms = |case: Case, setting: usize| {
        outcomes.iter().filter(|(of, outcome)| *of == case && outcome[setting].is_some()).count() as u32
    };
    let all = |is_fall: bool| Case::ALL.into_iter().filter(move |case| case.is_fall() == is_fall);
    let falls = cases * all(true).count() as u32;
    let found = |setting: usize| intervals::share(all(true).map(|case| alarms(case, setting)).sum(), falls);
    let wrong = |setting: usize| {
        let counted = |case: Case| Counted { events: alarms(case, setting), days: f64::from(cases) / case.per_day() };
        intervals::per_day(&all(false).map(counted).collect::<Vec<_>>())
    };
    let times = outcomes.iter().filter(|(case, _)| case.is_fall()).filter_map(|(_, outcome)| outcome[0]);
    let after = intervals::median(times.collect());
    let (sensitivity, sensitivity_interval) = found(0);
    let (false_alarms_per_day, false_alarms_per_day_interval) = wrong(0);
    let mut curve: Vec<(f64, f64)> =
        (0..settings(way.method).len()).map(|setting| (wrong(setting).0, found(setting).0)).collect();
    curve.sort_by(|a, b| b.0.total_cmp(&a.0).then(b.1.total_cmp(&a.1)));
    Row {
        way,
        falls,
        sensitivity,
        sensitivity_interval,
        false_alarms_per_day,
        false_alarms_per_day_interval,
        seconds_to_alarm: after.map(|(median, _)| median),
        seconds_to_alarm_interval: after.map(|(_, interval)| interval),
        alarms: Case::ALL
            .into_iter()
            .map(|case| (case.name(), f64::from(alarms(case, 0)) / f64::from(cases)))
            .collect(),
        curve,
    }
}

/// Lives a case under each condition, and looks at it in all ways.
fn lived(case: Case, seed: u64, looks: &[Look]) -> Vec<Outcome> {
    let mut outcomes = vec![Vec::new(); looks.len()];
    for condition in Condition::ALL {
        let (scenario, length_s) = room::scenario(case, seed, condition);
        let end = RunTime::START + Span::from_seconds(length_s) + AFTERWARDS;
        let events = life(&scenario, seed, end);
        let lies = weeks::lies(&events).first().copied();
        for (look, outcome) in looks.iter().zip(&mut outcomes).filter(|(look, _)| look.way.condition == condition) {
            let first = |alarms: Vec<RunTime>| match lies {
                Some(lie) => {
                    let of_it = alarms.into_iter().find(|alarm| (lie.begin..=lie.end).contains(alarm));
                    of_it.map(|alarm| (alarm - lie.begin).seconds())
                }
                None => alarms.first().map(|_| 0.0),
            };
            *outcome = look.alarms(&events, end).into_iter().map(first).collect();
        }
    }
    outcomes
}

fn life(scenario: &Scenario, seed: u64, end: RunTime) -> Events {
    let mut run = Run::new(scenario, &(), seed, end.since_zero());
    let mut events = Events::default();
    // A path asks for nothing that no body can do.
    let _ = run.advance(end, &mut events);
    events
}

impl FallsExperiment {
    /// The ways of the usual room as curves of false alarms and falls found, as SVG.
    pub fn picture(&self) -> String {
        let usual = self.rows.iter().filter(|row| row.way.condition == Condition::Usual);
        let line = |row: &Row| {
            let points = row.curve.iter().map(|&(wrong, found)| (wrong, 100.0 * found));
            TotalsLine { label: row.way.name.into(), points: points.collect() }
        };
        let lines: Vec<TotalsLine> = usual.map(line).collect();
        let title = format!("Falls found and false alarms, {} cases of each kind", self.cases);
        totals_chart(&title, ["false alarms a day", "% of falls found"], &lines, None)
    }
}

impl fmt::Display for FallsExperiment {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        writeln!(f, "{} cases of each kind, from seed {}\n", self.cases, self.seed)?;
        writeln!(f, "{:46} {:>18} {:>24} {:>24}", "looked at by", "falls found", "false alarms a day", "told after")?;
        for row in &self.rows {
            let [from, to] = row.sensitivity_interval.map(|share| 100.0 * share);
            let found = format!("{:.0} % [{from:.0} to {to:.0}]", 100.0 * row.sensitivity);
            let [least, most] = row.false_alarms_per_day_interval;
            let wrong = format!("{:.2} [{least:.2} to {most:.2}]", row.false_alarms_per_day);
            let after = row.seconds_to_alarm.zip(row.seconds_to_alarm_interval);
            let after =
                after.map_or("-".into(), |(median, [from, to])| format!("{median:.0} s [{from:.0} to {to:.0}]"));
            let name = format!("{}, {}", row.way.name, row.way.condition.name());
            writeln!(f, "{name:46} {found:>18} {wrong:>24} {after:>24}")?;
        }
        writeln!(f, "\nshare with an alarm in %, by what somebody does, in the order of these rows:")?;
        for case in Case::ALL {
            let shares: Vec<String> =
                self.rows.iter().map(|row| format!("{:>4.0}", 100.0 * row.alarms[case.name()])).collect();
            writeln!(f, "  {:24} {}", case.name(), shares.join(" "))?;
        }
        for of in &self.weeks {
            write!(f, "\n{of}")?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One case of each kind, lived under all conditions.
    #[test]
    fn cases_are_lived_to_their_end_and_falls_are_told_by_the_truth() {
        for case in Case::ALL {
            for condition in Condition::ALL {
                let (scenario, length_s) = room::scenario(case, 3, condition);
                let end = RunTime::START + Span::from_seconds(length_s) + AFTERWARDS;
                let events = life(&scenario, 3, end);
                let lies = weeks::lies(&events);
                assert_eq!(lies.len(), usize::from(case.is_fall()), "{case:?}");
                // A cat far away is less than cameras keep.
                let is_seen = !events.frames.is_empty() || case == Case::Cat;
                assert!(is_seen && !events.firings.is_empty(), "{case:?} {condition:?}");
                if let Some(lie) = lies.first() {
                    assert!((120.0..3541.0).contains(&lie.length().seconds()), "{case:?}: {lie:?}");
                }
            }
        }
    }

    #[test]
    fn falls_before_two_cameras_are_found_and_who_sits_down_raises_no_alarm() {
        let rules = FallRules::default();
        let (scenario, _) = room::scenario(Case::FallsWalking, 2, Condition::Usual);
        let home = Home { scenario: &scenario, drivers: &() };
        let lived = || experiment(1, 2, &rules, (&home, 1)).unwrap();
        let found = lived();
        assert_eq!(found.rows.len(), WAYS.len());
        let two = &found.rows[0];
        assert!(two.sensitivity >= 0.6 && two.seconds_to_alarm.unwrap() < 120.0, "{two:?}");
        assert_eq!(two.alarms["sits in the armchair"], 0.0, "{two:?}");
        // The same again, on however many threads.
        assert_eq!(serde_json::to_string(&found).unwrap(), serde_json::to_string(&lived()).unwrap());
        // In its week somebody falls once.
        assert_eq!((found.weeks[0].falls, found.weeks[0].found), (1, 1), "{:?}", found.weeks);
        let svg = found.picture();
        assert!(svg.contains("motion sensors") && svg.contains("false alarms a day"), "{svg}");
    }
}
