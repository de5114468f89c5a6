//! A random forest that tells the days or hours of two logs apart, and how well it does.
//!
//! Each tree draws as many rows of the one log as of the other. Rows are judged by trees that were grown without their day, in turns
//! of five (fewer where there are fewer days). The area under the curve is the chance that a row of the second log is judged more
//! likely to be of it than one of the first: 0.5 is guessing, 1 is without fail.
//!
//! All draws come from a stream of a fixed name: the same logs give the same figures.

use crate::forest::{Examples, Forest};
use homebody_core::random::Stream;

/// Rows of figures, each of one of two logs.
pub struct FigureRows {
    pub figures: Vec<Vec<f64>>,
    pub is_second: Vec<bool>,
    /// The number of the row's day in its log: rows of one day are never on both sides of a turn.
    pub day: Vec<usize>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Separation {
    /// The area under the curve, from 0 to 1.
    pub auc: f64,
    /// The part of each figure in it; together 1, or 0 where nothing separates the rows.
    pub importance: Vec<f64>,
}

const TREES: usize = 60;
const TURNS: usize = 5;
/// Largest number of rows used from each log.
const MOST_ROWS: usize = 1_500;

impl FigureRows {
    /// The separation of the rows by a forest; `None` where a log has rows of less than `least` days.
    pub fn told_apart(&self, least: usize) -> Option<Separation> {
        let days = [false, true].map(|which| {
            let mut days: Vec<usize> = self.of(which).map(|row| self.day[row]).collect();
            days.sort_unstable();
            days.dedup();
            days
        });
        let turns = days.iter().map(Vec::len).min().unwrap_or(0).min(TURNS);
        if turns < least.max(2) {
            return None;
        }
        let stream = &mut Stream::named(1, "realism/forest");
        let turn_of = |row: usize| {
            let own = &days[usize::from(self.is_second[row])];
            own.partition_point(|&day| day < self.day[row]) % turns
        };
        let rows = [false, true].map(|which| fewer(self.of(which).collect(), stream));
        let class: Vec<usize> = self.is_second.iter().map(|&second| usize::from(second)).collect();
        let examples = Examples { figures: &self.figures, class: &class, classes: 2 };
        let mut judged = Vec::new();
        let mut importance = vec![0.0; self.figures[0].len()];
        for turn in 0..turns {
            let grown = rows
                .each_ref()
                .map(|rows| rows.iter().copied().filter(|&row| turn_of(row) != turn).collect::<Vec<usize>>());
            // As many rows of the one log as of the other.
            let each = grown.iter().map(Vec::len).min().unwrap_or(0);
            let forest = Forest::grow(examples, &grown, &[each; 2], TREES, stream);
            importance.iter_mut().zip(&forest.importance).for_each(|(all, one)| *all += one);
            for row in rows.iter().flatten().copied().filter(|&row| turn_of(row) == turn) {
                judged.push((forest.judge(&self.figures[row])[1], self.is_second[row]));
            }
        }
        let whole: f64 = importance.iter().sum();
        let importance = importance.iter().map(|one| if whole > 0.0 { one / whole } else { 0.0 }).collect();
        Some(Separation { auc: area_under_curve(judged)?, importance })
    }

    fn of(&self, is_second: bool) -> impl Iterator<Item = usize> {
        (0..self.is_second.len()).filter(move |&row| self.is_second[row] == is_second)
    }
}

/// At most [`MOST_ROWS`] of the rows, in their order.
fn fewer(rows: Vec<usize>, stream: &mut Stream) -> Vec<usize> {
    let mut left = rows.len();
    let mut wanted = MOST_ROWS.min(left);
    let keep = |_: &usize| {
        let kept = stream.chance(wanted as f64 / left as f64);
        left -= 1;
        wanted -= usize::from(kept);
        kept
    };
    rows.into_iter().filter(keep).collect()
}

/// The chance that a row of the second log is judged higher than one of the first; ties count half. Nothing where one log has
/// no row.
pub fn area_under_curve(mut judged: Vec<(f64, bool)>) -> Option<f64> {
    judged.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (mut below, mut wins) = (0.0, 0.0);
    for equal in judged.chunk_by(|a, b| a.0 == b.0) {
        let second = equal.iter().filter(|row| row.1).count() as f64;
        let first = equal.len() as f64 - second;
        wins += second * (below + first / 2.0);
        below += first;
    }
    let second = judged.len() as f64 - below;
    (below > 0.0 && second > 0.0).then(|| wins / (below * second))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_area_is_the_share_of_pairs_that_are_in_order() {
        // Of the pairs (0.1, 0.2), (0.1, 0.3), (0.2, 0.2), (0.2, 0.3) three and a half are in order.
        let judged = vec![(0.1, false), (0.2, false), (0.2, true), (0.3, true)];
        assert_eq!(area_under_curve(judged), Some(3.5 / 4.0));
        assert_eq!(area_under_curve(vec![(0.1, true), (0.2, false)]), Some(0.0));
        assert_eq!(area_under_curve(vec![(0.1, true)]), None);
    }

    #[test]
    fn random_areas_agree_with_all_pairs_counted() {
        let stream = &mut Stream::named(3, "areas");
        for _ in 0..100 {
            let judged: Vec<(f64, bool)> =
                (0..30).map(|_| ((stream.unit() * 6.0).floor(), stream.chance(0.4))).collect();
            let (mut pairs, mut wins) = (0.0, 0.0);
            for a in judged.iter().filter(|row| !row.1) {
                for b in judged.iter().filter(|row| row.1) {
                    pairs += 1.0;
                    wins += if b.0 > a.0 {
                        1.0
                    } else if b.0 == a.0 {
                        0.5
                    } else {
                        0.0
                    };
                }
            }
            assert!((area_under_curve(judged).unwrap() - wins / pairs).abs() < 1e-12);
        }
    }

    /// 40 days of 4 rows in each log; the second figure is `apart` larger in the second log.
    fn rows(apart: f64) -> FigureRows {
        let stream = &mut Stream::named(4, "rows");
        let mut rows = FigureRows { figures: Vec::new(), is_second: Vec::new(), day: Vec::new() };
        for row in 0..320 {
            let is_second = row % 2 == 1;
            let shift = if is_second { apart } else { 0.0 };
            rows.figures.push(vec![stream.normal(0.0, 1.0), stream.normal(shift, 1.0), stream.normal(0.0, 1.0)]);
            rows.is_second.push(is_second);
            rows.day.push(row / 8);
        }
        rows
    }

    #[test]
    fn separates_different_rows_and_guesses_equal_ones() {
        let alike = rows(0.0).told_apart(4).unwrap();
        assert!((0.38..0.62).contains(&alike.auc), "{alike:?}");
        // Two normal distributions that are 1.5 standard deviations apart: the best that can be is Phi(1.5 / sqrt 2) = 0.856.
        let apart = rows(1.5).told_apart(4).unwrap();
        assert!((0.76..0.9).contains(&apart.auc), "{apart:?}");
        assert!(apart.importance[1] > 0.5 && (apart.importance.iter().sum::<f64>() - 1.0).abs() < 1e-9, "{apart:?}");
        assert!(rows(20.0).told_apart(4).unwrap().auc > 0.999);
        assert_eq!(rows(1.5).told_apart(4), rows(1.5).told_apart(4), "the same rows give the same answer");
    }

    #[test]
    fn a_few_days_tell_nothing() {
        let mut few = rows(20.0);
        few.day.iter_mut().for_each(|day| *day %= 3);
        assert!(few.told_apart(4).is_none() && few.told_apart(3).is_some());
    }
}
