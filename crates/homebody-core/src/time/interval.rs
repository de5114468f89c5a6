//! Intervals of time, and sets of them.

use super::{Span, TimePoint};
use serde::{Deserialize, Serialize};

/// From one instant to another of the same scale; the end is not part of it.
///
/// The functions of this module take and return intervals in the order of time.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, schemars::JsonSchema,
)]
pub struct Interval<T> {
    /// The first instant that belongs to it.
    pub begin: T,
    /// The first instant after it.
    pub end: T,
}

impl<T: TimePoint> Interval<T> {
    /// All time.
    pub const ALL: Interval<T> = Interval { begin: T::MIN, end: T::MAX };

    /// From one instant to another.
    pub const fn new(begin: T, end: T) -> Interval<T> {
        Interval { begin, end }
    }

    /// From an instant on, for a time.
    pub fn starting(begin: T, length: Span) -> Interval<T> {
        Interval { begin, end: begin + length }
    }

    /// The instant, which has no length.
    pub const fn instant(at: T) -> Interval<T> {
        Interval { begin: at, end: at }
    }

    /// The length.
    pub fn length(self) -> Span {
        self.end - self.begin
    }

    /// Whether no instant belongs to it.
    pub fn is_empty(self) -> bool {
        self.begin >= self.end
    }

    /// Whether an instant belongs to it.
    pub fn contains(self, at: T) -> bool {
        self.begin <= at && at < self.end
    }

    /// Whether some instant belongs to both.
    pub fn overlaps(self, other: Interval<T>) -> bool {
        self.begin < other.end && other.begin < self.end
    }

    /// The part that belongs to both; empty, and perhaps with its end before its begin, if they do not overlap.
    pub fn intersection(self, other: Interval<T>) -> Interval<T> {
        Interval { begin: self.begin.max(other.begin), end: self.end.min(other.end) }
    }

    /// The length of the overlap.
    pub fn overlap(self, other: Interval<T>) -> Span {
        let both = self.intersection(other);
        if both.is_empty() { Span::ZERO } else { both.length() }
    }

    /// The shortest interval that has both.
    pub fn hull(self, other: Interval<T>) -> Interval<T> {
        Interval { begin: self.begin.min(other.begin), end: self.end.max(other.end) }
    }

    /// The same with both instants changed, as to another scale.
    pub fn map<U>(self, mut change: impl FnMut(T) -> U) -> Interval<U> {
        Interval { begin: change(self.begin), end: change(self.end) }
    }
}

/// Intervals, with those that are no farther apart than `apart` joined.
pub fn joined<T: TimePoint>(intervals: impl IntoIterator<Item = Interval<T>>, apart: Span) -> Vec<Interval<T>> {
    let mut joined: Vec<Interval<T>> = Vec::new();
    for interval in intervals {
        match joined.last_mut().filter(|last| interval.begin - last.end <= apart) {
            Some(last) => last.end = last.end.max(interval.end),
            None => joined.push(interval),
        }
    }
    joined
}

/// The time of all of these; those that overlap or touch become one.
pub fn union<T: TimePoint>(intervals: impl IntoIterator<Item = Interval<T>>) -> Vec<Interval<T>> {
    let mut all: Vec<Interval<T>> = intervals.into_iter().collect();
    all.sort_unstable();
    let mut union: Vec<Interval<T>> = Vec::with_capacity(all.len());
    for interval in all {
        match union.last_mut().filter(|last| interval.begin <= last.end) {
            Some(last) => last.end = last.end.max(interval.end),
            None => union.push(interval),
        }
    }
    union
}

/// The time that two lists have in common.
pub fn intersection<T: TimePoint>(some: &[Interval<T>], others: &[Interval<T>]) -> Vec<Interval<T>> {
    let mut all = Vec::new();
    let (mut some, mut others) = (some.iter().peekable(), others.iter().peekable());
    while let (Some(&&one), Some(&&other)) = (some.peek(), others.peek()) {
        let both = one.intersection(other);
        if !both.is_empty() {
            all.push(both);
        }
        if one.end < other.end {
            some.next()
        } else {
            others.next()
        };
    }
    all
}

/// The time of some that lies outside others: with one interval as `some`, the gaps between the others in it.
pub fn without<T: TimePoint>(some: &[Interval<T>], others: &[Interval<T>]) -> Vec<Interval<T>> {
    let mut left = Vec::new();
    let mut first = 0;
    for interval in some {
        while others.get(first).is_some_and(|other| other.end <= interval.begin) {
            first += 1;
        }
        let mut from = interval.begin;
        for other in others[first..].iter().take_while(|other| other.begin < interval.end) {
            if other.begin > from {
                left.push(Interval::new(from, other.begin));
            }
            from = from.max(other.end);
        }
        if from < interval.end {
            left.push(Interval::new(from, interval.end));
        }
    }
    left
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::time::RunTime;

    fn intervals(of: &[(i64, i64)]) -> Vec<Interval<RunTime>> {
        let at = RunTime::from_micros;
        of.iter().map(|&(begin, end)| Interval::new(at(begin), at(end))).collect()
    }

    #[test]
    fn joins_what_is_near() {
        let near = joined(intervals(&[(0, 2), (3, 5), (9, 10)]), Span::MICROSECOND);
        assert_eq!(near, intervals(&[(0, 5), (9, 10)]));
        assert_eq!(union(intervals(&[(3, 5), (0, 3), (4, 6), (8, 8)])), intervals(&[(0, 6), (8, 8)]));
    }

    #[test]
    fn sets_agree_with_a_count_of_their_instants() {
        let mut stream = crate::random::Stream::named(7, "intervals");
        let mut random_set = || {
            let count = stream.below(6);
            let ends = (0..count).map(|_| (i64::from(stream.below(20)), i64::from(stream.below(6)) + 1));
            union(intervals(&ends.map(|(begin, length)| (begin, begin + length)).collect::<Vec<_>>()))
        };
        for _ in 0..500 {
            let (some, others) = (random_set(), random_set());
            let has =
                |set: &[Interval<RunTime>], at| set.iter().any(|interval| interval.contains(RunTime::from_micros(at)));
            let (both, left) = (intersection(&some, &others), without(&some, &others));
            for at in -1..30 {
                let (in_some, in_others) = (has(&some, at), has(&others, at));
                assert_eq!(has(&both, at), in_some && in_others, "{at}: {some:?} and {others:?}");
                assert_eq!(has(&left, at), in_some && !in_others, "{at}: {some:?} without {others:?}");
            }
            let overlap: Span = some.iter().flat_map(|one| others.iter().map(|other| one.overlap(*other))).sum();
            assert_eq!(overlap, both.iter().map(|both| both.length()).sum());
        }
    }
}
