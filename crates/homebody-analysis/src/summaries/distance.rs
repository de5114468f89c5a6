//! How far summaries are apart, after Wilbik & Keller (2012): by what they mean, how true they are, and how many days they are from.

use super::sentence::{SummarySentence, VerbalSummary};
use super::set::Set;
use homebody_core::fuzzy::Fuzzy;

/// How far two sentences are apart, from 0 to 1: by whatever they differ in most, so that it is a metric.
///
/// Fuzzy sets are as far apart as what they share is less than both together (Jaccard). Sentences about different measures, or
/// about a level and a change, are 1 apart.
pub fn between(a: &SummarySentence, b: &SummarySentence) -> f64 {
    if a.measure != b.measure || a.is_more != b.is_more {
        return 1.0;
    }
    let quantifiers = apart(a.quantifier.share(), b.quantifier.share(), (0.0, 1.0));
    // Changes are both in the same direction: by how much is told by their truth.
    let sets = match (a.set, b.set) {
        (Set::Beyond { .. }, Set::Beyond { .. }) => 0.0,
        (of_a, of_b) => apart(of_a.fuzzy(), of_b.fuzzy(), RANGE),
    };
    [quantifiers, sets, (a.truth - b.truth).abs(), (a.focus - b.focus).abs()].into_iter().fold(0.0, f64::max)
}

/// How far two summaries are apart: the mean over all sentences of both of how far the nearest of the other is; 0 if neither has any.
pub fn of_summaries(a: &VerbalSummary, b: &VerbalSummary) -> f64 {
    let nearest = |of: &SummarySentence, among: &[SummarySentence]| {
        among.iter().map(|other| between(of, other)).fold(1.0, f64::min)
    };
    let of_a = a.sentences.iter().map(|sentence| nearest(sentence, &b.sentences));
    let of_b = b.sentences.iter().map(|sentence| nearest(sentence, &a.sentences));
    let all: Vec<f64> = of_a.chain(of_b).collect();
    all.iter().sum::<f64>() / all.len().max(1) as f64
}

/// Sets of levels lie within these values.
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
    // What holds at one point alone has no area: equal points are no distance apart.
    if both > 0.0 { 1.0 - shared / both } else { f64::from(u8::from(a != b)) }
}
