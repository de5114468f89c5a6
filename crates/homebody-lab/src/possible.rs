//! Counts impossible events in simulations: two people on one spot, people who walk through each other, visits to an empty home, and meals
//! that are eaten before they are cooked.
//!
//! The counts use the ground truth alone, so they apply to any driver in the same way.

use homebody_core::activity::{
    EATING_BREAKFAST, EATING_DINNER, EATING_LUNCH, PREPARING_BREAKFAST, PREPARING_DINNER, PREPARING_LUNCH,
};
use homebody_core::event::Fact;
use homebody_core::motion::{MotionSegment, MotionState};
use homebody_core::time::{Interval, MINUTE, RunTime, Span};
use serde::Serialize;
use std::fmt;

/// Distance within which two people are at one place (our choice). A person who squeezes past another keeps further
/// away.
pub const ONE_SPOT_M: f64 = 0.2;

/// Number of instants of a part of two movements at which their distance is measured (our choice).
const LOOKS: i64 = 5;

/// Time before the last dish is served within which a person may sit down to a meal (our choice).
const SERVING: Span = MINUTE;

#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct ImpossibleCounts {
    pub on_one_spot: u32,
    pub on_one_spot_s: f64,
    /// Pairs of people of whom one walks through the other.
    pub through_somebody: u32,
    /// Time that visitors spend in a home without the host.
    pub visiting_nobody_s: f64,
    pub eaten_uncooked: u32,
    pub ends_before_it_begins: u32,
}

impl ImpossibleCounts {
    pub fn is_nothing(&self) -> bool {
        *self == ImpossibleCounts::default()
    }
}

#[derive(Clone, Debug, Default)]
pub struct HouseholdTruth {
    /// By body, in the order of [`ResidentId`](homebody_core::ids::ResidentId): the residents, then the visitors.
    moves: Vec<Vec<MotionSegment>>,
    doing: Vec<Vec<(RunTime, Option<String>)>>,
    /// By body: true for a person, false for a pet.
    are_people: Vec<bool>,
    /// Visitors and their hosts, by their indices among the bodies.
    hosts: Vec<(usize, usize)>,
}

impl HouseholdTruth {
    /// A household before its first fact. `hosts` has visitors and their hosts, by their indices among the bodies.
    pub fn new(are_people: Vec<bool>, hosts: Vec<(usize, usize)>) -> HouseholdTruth {
        let bodies = are_people.len();
        HouseholdTruth { moves: vec![Vec::new(); bodies], doing: vec![Vec::new(); bodies], are_people, hosts }
    }

    pub fn take(&mut self, fact: &Fact) {
        match fact {
            Fact::Movement { resident, begin, end, doing, posture } => {
                let (begin, end, doing, posture) = (*begin, *end, *doing, *posture);
                self.moves[resident.index()].push(MotionSegment { begin, end, doing, posture });
            }
            Fact::Activity { resident, at, name } => self.doing[resident.index()].push((*at, name.clone())),
            _ => {}
        }
    }

    pub fn visits(&self) -> usize {
        let is_out = |segment: &MotionSegment| segment.doing == MotionState::Away;
        let comings =
            |moves: &[MotionSegment]| moves.windows(2).filter(|pair| is_out(&pair[0]) && !is_out(&pair[1])).count();
        self.hosts.iter().map(|&(visitor, _)| comings(&self.moves[visitor])).sum()
    }

    pub fn impossible(&self) -> ImpossibleCounts {
        let mut found = ImpossibleCounts::default();
        let people: Vec<usize> = (0..self.moves.len()).filter(|&body| self.are_people[body]).collect();
        for (place, &first) in people.iter().enumerate() {
            for &second in &people[place + 1..] {
                meet(&self.moves[first], &self.moves[second], &mut found);
                found.eaten_uncooked += self.uncooked(first, second) + self.uncooked(second, first);
            }
        }
        for &(visitor, host) in &self.hosts {
            together(&self.moves[visitor], &self.moves[host], |visits, hosts, time| {
                let is_home = |segment: &MotionSegment| segment.doing != MotionState::Away;
                if is_home(visits) && !is_home(hosts) {
                    found.visiting_nobody_s += time.length().seconds();
                }
            });
        }
        let backwards = self.moves.iter().flatten().filter(|segment| segment.end < segment.begin).count();
        let turns = self.doing.iter().flat_map(|doing| doing.windows(2)).filter(|pair| pair[1].0 < pair[0].0).count();
        found.ends_before_it_begins = (backwards + turns) as u32;
        found
    }

    /// The number of meals that one person starts while the other still cooks.
    fn uncooked(&self, eats: usize, cooks: usize) -> u32 {
        let meals = [
            (EATING_BREAKFAST, PREPARING_BREAKFAST),
            (EATING_LUNCH, PREPARING_LUNCH),
            (EATING_DINNER, PREPARING_DINNER),
        ];
        let begins = self.doing[eats].iter().filter_map(|(at, name)| {
            let (_, cooking) = meals.iter().find(|(eating, _)| name.as_deref() == Some(eating))?;
            Some((*at, *cooking))
        });
        let is_cooking = |at: RunTime, cooking| [at, at + SERVING].iter().all(|&at| self.is_doing(cooks, at, cooking));
        begins.filter(|&(at, cooking)| is_cooking(at, cooking)).count() as u32
    }

    fn is_doing(&self, body: usize, at: RunTime, what: &str) -> bool {
        let next = self.doing[body].partition_point(|(begin, _)| *begin <= at);
        self.doing[body][..next].last().is_some_and(|(_, name)| name.as_deref() == Some(what))
    }
}

fn meet(a: &[MotionSegment], b: &[MotionSegment], found: &mut ImpossibleCounts) {
    together(a, b, |a, b, time| {
        let stays = |segment: &MotionSegment| !matches!(segment.doing, MotionState::Stride { .. });
        let nearest = nearest(a, b, time);
        if nearest < ONE_SPOT_M && stays(a) && stays(b) {
            found.on_one_spot += 1;
            found.on_one_spot_s += time.length().seconds();
        } else if nearest < ONE_SPOT_M && a.posture == b.posture {
            found.through_somebody += 1;
        }
    });
}

/// The least distance of two people in an interval; infinite while one is out.
fn nearest(a: &MotionSegment, b: &MotionSegment, time: Interval<RunTime>) -> f64 {
    let at = |instant: RunTime| -> Option<f64> { Some(a.position(instant)?.distance(b.position(instant)?)) };
    let instants = (0..LOOKS).map(|part| time.begin + time.length() * part / (LOOKS - 1));
    instants.filter_map(at).fold(f64::INFINITY, f64::min)
}

/// Passes on the simultaneous movements of two people, and their time.
fn together(
    a: &[MotionSegment],
    b: &[MotionSegment],
    mut each: impl FnMut(&MotionSegment, &MotionSegment, Interval<RunTime>),
) {
    let (mut of_a, mut of_b) = (a.iter().peekable(), b.iter().peekable());
    while let (Some(a), Some(b)) = (of_a.peek(), of_b.peek()) {
        let both = Interval::new(a.begin.max(b.begin), a.end.min(b.end));
        if !both.is_empty() {
            each(a, b, both);
        }
        if a.end <= b.end {
            of_a.next();
        } else {
            of_b.next();
        }
    }
}

#[derive(Clone, Debug, Default, Serialize)]
pub struct ImpossibleEvents {
    pub days: u32,
    /// In the order of the arguments.
    pub scenarios: Vec<ScenarioRow>,
}

#[derive(Clone, Debug, Serialize)]
pub struct ScenarioRow {
    pub scenario: String,
    pub people: usize,
    pub visits: usize,
    #[serde(flatten)]
    pub impossible: ImpossibleCounts,
}

impl ImpossibleEvents {
    pub fn is_clean(&self) -> bool {
        self.scenarios.iter().all(|row| row.impossible.is_nothing())
    }
}

impl fmt::Display for ImpossibleEvents {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let width = self.scenarios.iter().map(|row| row.scenario.chars().count()).max().unwrap_or(0).max(8);
        writeln!(
            f,
            "{:width$}  people  visits  one spot  through  visit to nobody  uncooked  backwards",
            format!("{} days", self.days)
        )?;
        for ScenarioRow { scenario, people, visits, impossible } in &self.scenarios {
            let ImpossibleCounts { on_one_spot, through_somebody, visiting_nobody_s, .. } = impossible;
            let ImpossibleCounts { eaten_uncooked, ends_before_it_begins, .. } = impossible;
            writeln!(
                f,
                "{scenario:width$}  {people:>6}  {visits:>6}  {on_one_spot:>8}  {through_somebody:>7}  {visiting_nobody_s:>13.0} s  {eaten_uncooked:>8}  {ends_before_it_begins:>9}"
            )?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_core::geometry::Point;
    use homebody_core::ids::ResidentId;
    use homebody_core::posture::Posture;
    use homebody_core::time::SECOND;

    #[test]
    fn impossible_events_are_counted() {
        let mut lives = HouseholdTruth::new(vec![true, true], vec![(1, 0)]);
        let second = |second: i64| RunTime::START + second * SECOND;
        let rest = |x: f64| MotionState::Rest { at: Point::new(x, 0.0) };
        let walk = MotionState::Stride { from: Point::new(1.0, 0.0), to: Point::new(-1.0, 0.0) };
        for (body, begin, end, doing) in [
            (0, 0, 10, rest(0.0)),
            (0, 10, 20, MotionState::Away),
            (1, 0, 4, rest(0.1)),
            (1, 4, 6, walk),
            (1, 6, 20, rest(3.0)),
            (1, 20, 19, rest(3.0)),
        ] {
            let (begin, end, posture) = (second(begin), second(end), Posture::Standing);
            lives.take(&Fact::Movement { resident: ResidentId::new(body), begin, end, doing, posture });
        }
        for (body, at, name) in [(0, 0, PREPARING_LUNCH), (1, 5, EATING_LUNCH), (0, 100, EATING_LUNCH)] {
            let (resident, name) = (ResidentId::new(body), Some(name.to_owned()));
            lives.take(&Fact::Activity { resident, at: second(at), name });
        }
        let expected = ImpossibleCounts {
            on_one_spot: 1,
            on_one_spot_s: 4.0,
            through_somebody: 1,
            visiting_nobody_s: 10.0,
            eaten_uncooked: 1,
            ends_before_it_begins: 1,
        };
        assert_eq!(lives.impossible(), expected);
        assert!(!expected.is_nothing() && ImpossibleCounts::default().is_nothing());
    }
}
