//! The distance between summaries, after Wilbik & Keller (2012): by meaning, truth and the number of days.

use super::sentence::{SummarySentence, VerbalSummary};
use super::set::Set;
use homebody_core::fuzzy::Fuzzy;

/// The distance of two sentences, from 0 to 1: that of their largest difference, so that it is a metric.
///
/// The distance of fuzzy sets is 1 less the ratio of their intersection to their union (Jaccard). Sentences about different measures, or
/// about a level and a change, are 1 apart.
pub fn between(a: &SummarySentence, b: &SummarySentence) -> f64 {
    if a.measure != b.measure || a.is_more != b.is_more {
        return 1.0;
    }
    let quantifiers = apart(a.quantifier.share(), b.quantifier.share(), (0.0, 1.0));
    // Changes in the same direction: their truth has their size.
    let sets = match (a.set, b.set) {
        (Set::Beyond { .. }, Set::Beyond { .. }) => 0.0,
        (of_a, of_b) => apart(of_a.fuzzy(), of_b.fuzzy(), RANGE),
    };
    [quantifiers, sets, (a.truth - b.truth).abs(), (a.focus - b.focus).abs()].into_iter().fold(0.0, f64::max)
}

/// The distance of two summaries: the mean over all sentences of both of the distance to the nearest of the other; 0 if neither has any.
pub fn of_summaries(a: &VerbalSummary, b: &VerbalSummary) -> f64 {
    let nearest = |of: &SummarySentence, among: &[SummarySentence]| {
        among.iter().map(|other| between(of, other)).fold(1.0, f64::min)
    };
    let of_a = a.sentences.iter().map(|sentence| nearest(sentence, &b.sentences));
    let of_b = b.sentences.iter().map(|sentence| nearest(sentence, &a.sentences));
    let all: Vec<f64> = of_a.chain(of_b).collect();
    all.iter().sum::<f64>() / all.len().max(1) as f64
}

/// The range of sets of levels.
const RANGE: (f64, f64) = (0.0, 40.0);
const STEPS: u32 = 4_000;

/// 1 less the Jaccard index of two fuzzy numbers within a range, by the midpoint rule.
fn apart(a: Fuzzy, b: Fuzzy, (low, high): (f64, f64)) -> f64 {
    let (mut shared, mut both) = (0.0, 0.0);
    for step in 0..STEPS {
        let at = low + (f64::from(step) + 0.5) / f64::from(STEPS) * (high - low);
        let (in_a, in_b) = (a.agreement(at), b.agreement(at));
        (shared, both) = (shared + in_a.min(in_b), both + in_a.max(in_b));
    }
    // A set of one point has no area: equal points have the distance 0.
    if both > 0.0 { 1.0 - shared / both } else { f64::from(u8::from(a != b)) }
}
