//! Episodes: the days of a resident differ from a reference for some time.
//!
//! The reference is the first four weeks that count, or four weeks from a marked day on, so that a slow change does not become usual.
//! Days are taken one after the other, and no decision uses a later day. Several measures that change together are the signs of one
//! episode. An episode ends when the days are as usual again.
//!
//! A day does not count if it is not whole, or if the resident was out for most of it. A measure is not known while a sensor is silent
//! that it needs.

mod change;
mod detector;
mod headline;
mod patterns;
mod reference;
mod signs;
mod wording;

use crate::measures::{DayMeasures, MEASURES, Measures, SilentSensor};
use crate::phrases::{in_full, write_remarks};
use detector::{Leading, Sum, Sums, beyond, mean_distances};
use homebody_core::problem::counted;
use homebody_core::statistics::mean;
use jiff::civil::Date;
use reference::GrowingReference;
use serde::Serialize;
use signs::{WatchedColumns, moved, signs};
use std::fmt;
use std::ops::Range;

pub use change::{ChangeEpisode, Course, DaysAway, SeenWith};
pub use headline::{Headline, HeadlineState};
pub use patterns::{ConditionPattern, Distances, PatternMeasure, Patterns};
pub use reference::{LEAST_DAYS, REFERENCE_DAYS, ReferenceDays, Usual};
pub use signs::Sign;

/// Evidence for usual days at which an episode is over (our choice).
const OVER: f64 = 4.0;
/// Least number of things that move together in an episode (our choice).
const LEAST_SIGNS: usize = 2;
/// Largest distance of a measure of a day that counts, in standard deviations (our choice): a single measure does not decide.
const MOST_DISTANCE_SD: f64 = 3.5;
/// Least likelihood ratio of a named condition, and least share of its evidence in the highest (our choice).
const LEAST_RATIO: f64 = 2.0;
const NEAR_SHARE: f64 = 0.8;
/// Difference of the evidence of a day at which an episode grows or eases (our choice).
const COURSE_EVIDENCE: f64 = 1.5;
/// Number of days whose evidence gives the course (our choice).
const COURSE_DAYS: usize = 14;

/// How the days of a log differ from the reference.
#[derive(Clone, Debug, Serialize)]
pub struct WatchedDays {
    pub name: String,
    /// The number of days, and of those that count.
    pub days: usize,
    pub days_that_count: usize,
    pub headline: Headline,
    /// `None` before the first day that counts.
    pub reference: Option<ReferenceDays>,
    /// The earliest found first.
    pub episodes: Vec<ChangeEpisode>,
    /// News by day. The news of a day follows from the days until then.
    pub news: Vec<EpisodeNews>,
    pub absences: Vec<DaysAway>,
    /// Sensors that are silent, in sentences.
    pub silent: Vec<String>,
    pub remarks: Vec<String>,
    /// By day, the usual values of all measures on it.
    #[serde(skip)]
    pub usual: Vec<Vec<Option<Usual>>>,
}

/// An episode is found, is worse, or is over.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct EpisodeNews {
    /// The day after whose end it is known.
    pub date: Date,
    pub kind: NewsKind,
    /// The estimated first day of the episode.
    pub since: Date,
    /// The measures of the signs by then, the strongest first.
    pub measures: Vec<&'static str>,
    /// A sentence, without a full stop.
    pub words: String,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum NewsKind {
    Found,
    Worse,
    Over,
}

/// Choices of the user.
#[derive(Clone, Copy, Debug, Default)]
pub struct WatchOptions<'a> {
    /// First days of new references, such as the return from a hospital.
    pub marked: &'a [Date],
    /// The evidence at which an episode is found, if not that of the patterns.
    pub threshold: Option<f64>,
    /// Patterns in place of the fitted ones.
    pub patterns: Option<&'a Patterns>,
}

/// An episode by the numbers of its days.
#[derive(Clone, Debug)]
struct FoundEpisode {
    since: usize,
    found: usize,
    /// The days after whose end it was known to have become worse.
    worse: Vec<usize>,
    over: Option<usize>,
    /// The day after whose end it is known to be over.
    closed: Option<usize>,
    leading: Leading,
    /// Evidence that the days are as usual again.
    against: Sum,
    /// The mean distances of the episode when it was found or became worse.
    level: Distances,
}

/// Takes days one after the other.
struct DayWatcher<'a> {
    patterns: &'a Patterns,
    threshold: f64,
    reference: GrowingReference,
    /// Of a change from the usual days; within an episode, of a change from its level.
    sums: Sums,
    distances: Vec<Distances>,
    usual: Vec<Vec<Option<Usual>>>,
    episodes: Vec<FoundEpisode>,
}

impl<'a> DayWatcher<'a> {
    fn new(patterns: &'a Patterns, threshold: Option<f64>) -> DayWatcher<'a> {
        DayWatcher {
            patterns,
            threshold: threshold.unwrap_or(patterns.threshold),
            reference: GrowingReference::new(),
            sums: Sums::new(patterns),
            distances: Vec::new(),
            usual: Vec::new(),
            episodes: Vec::new(),
        }
    }

    /// Begins a new reference with the next day.
    fn mark(&mut self) {
        let today = self.distances.len();
        self.reference = GrowingReference::new();
        self.sums.clear();
        for open in self.episodes.iter_mut().filter(|episode| episode.over.is_none()) {
            (open.over, open.closed) = (Some(today), Some(today));
        }
    }

    fn take(&mut self, day: &DayMeasures, is_marked: bool) {
        let usual: Vec<Option<Usual>> =
            (0..MEASURES.len()).map(|measure| self.reference.usual(measure).copied()).collect();
        let distance = |(value, usual): (&Option<f64>, &Option<Usual>)| {
            let distance = usual.as_ref()?.distance(day.date, (*value)?);
            Some(distance.clamp(-MOST_DISTANCE_SD, MOST_DISTANCE_SD)).filter(|_| day.counts())
        };
        self.distances.push(day.values.iter().zip(&usual).map(distance).collect());
        self.usual.push(usual);
        if !day.counts() {
            return;
        }
        let is_open = self.episodes.last().is_some_and(|episode| episode.over.is_none());
        let is_found = if is_open { self.take_in_episode() } else { self.take_usual() };
        if !is_open && !is_found {
            self.reference.take(day, is_marked);
        }
    }

    /// Takes the last day outside of an episode, and says whether one is found.
    fn take_usual(&mut self) -> bool {
        let today = self.distances.len() - 1;
        self.sums.add(today, &self.patterns.evidence(&self.distances[today]));
        let Some(leading) = self.reached() else { return false };
        self.episodes.push(FoundEpisode {
            since: leading.sum.since,
            found: today,
            worse: Vec::new(),
            over: None,
            closed: None,
            leading,
            against: Sum::default(),
            level: mean_distances(&self.distances[leading.sum.since..]),
        });
        self.sums.clear();
        true
    }

    /// Takes the last day within an episode, and says whether it has become worse.
    fn take_in_episode(&mut self) -> bool {
        let today = self.distances.len() - 1;
        let Some(open) = self.episodes.last_mut() else { return false };
        let evidence = self.patterns.evidence(&self.distances[today]);
        open.against.add(-evidence[open.leading.pattern][open.leading.share], today);
        if open.against.value >= OVER {
            (open.over, open.closed) = (Some(open.against.since), Some(today));
            self.sums.clear();
            return false;
        }
        let mut worse = self.patterns.evidence(&beyond(&self.distances[today], &open.level));
        // A day that is nearer to the usual days than to the pattern is not worse.
        for (worse, evidence) in worse.iter_mut().flatten().zip(evidence.iter().flatten()) {
            *worse = worse.min(*evidence);
        }
        self.sums.add(today, &worse);
        let Some(leading) = self.reached() else { return false };
        if let Some(open) = self.episodes.last_mut() {
            open.worse.push(today);
            open.level = mean_distances(&self.distances[leading.sum.since..]);
            (open.leading, open.against) = (leading, Sum::default());
        }
        self.sums.clear();
        true
    }

    /// The pattern whose evidence reaches the threshold, if things moved together since then.
    fn reached(&self) -> Option<Leading> {
        let leading = self.sums.leading().filter(|leading| leading.sum.value >= self.threshold)?;
        (moved(&self.distances[leading.sum.since..]) >= LEAST_SIGNS).then_some(leading)
    }
}

fn watched<'a>(measures: &Measures, options: WatchOptions<'a>) -> DayWatcher<'a> {
    let mut watcher = DayWatcher::new(options.patterns.unwrap_or_else(|| Patterns::fitted()), options.threshold);
    let mut is_marked = false;
    for day in &measures.days {
        if options.marked.contains(&day.date) {
            watcher.mark();
            is_marked = true;
        }
        watcher.take(day, is_marked);
    }
    watcher
}

/// The distances of all days from a reference that ends with four weeks that count, whatever was found in them.
pub fn distances(measures: &Measures) -> Vec<Distances> {
    let mut watcher = DayWatcher::new(Patterns::fitted(), Some(f64::INFINITY));
    measures.days.iter().for_each(|day| watcher.take(day, false));
    watcher.distances
}

/// The numbers of the days on which episodes were found or became worse.
pub fn found_days(measures: &Measures, options: WatchOptions) -> Vec<usize> {
    let of = |episode: FoundEpisode| [episode.found].into_iter().chain(episode.worse);
    watched(measures, options).episodes.into_iter().flat_map(of).collect()
}

/// By day on which an episode was found or became worse, the conditions that its signs are seen with.
pub fn named_conditions(measures: &Measures, options: WatchOptions) -> Vec<(usize, Vec<String>)> {
    let watcher = watched(measures, options);
    let of = |episode: &FoundEpisode| {
        let day = episode.worse.last().copied().unwrap_or(episode.found);
        (day, watcher.near(episode.since..day + 1).map(|(pattern, _)| pattern.name.clone()).collect())
    };
    watcher.episodes.iter().map(of).collect()
}

/// The episodes of a log.
pub fn watch(measures: &Measures, options: WatchOptions) -> WatchedDays {
    let watcher = watched(measures, options);
    let episodes: Vec<ChangeEpisode> =
        watcher.episodes.iter().map(|found| watcher.episode(found, &measures.days)).collect();
    let absences = absences(&measures.days);
    WatchedDays {
        name: measures.name.clone(),
        days: measures.days.len(),
        days_that_count: measures.days.iter().filter(|day| day.counts()).count(),
        headline: Headline::new(measures, watcher.reference.days.as_ref(), &episodes, &absences),
        reference: watcher.reference.days,
        news: watcher.news(&measures.days),
        episodes,
        absences,
        silent: SilentSensor::sentences(&measures.silent).into_iter().map(|(_, words)| words).collect(),
        remarks: measures.remarks.clone(),
        usual: watcher.usual,
    }
}

impl DayWatcher<'_> {
    /// An episode with its dates and its signs, by what is known at the end of the days.
    fn episode(&self, found: &FoundEpisode, days: &[DayMeasures]) -> ChangeEpisode {
        let date = |number: usize| days[number].date;
        let until = found.over.unwrap_or(days.len());
        let watched = WatchedColumns { days, distances: &self.distances, usual: &self.usual };
        let mut kept = signs(&watched, found.since..until);
        // In a long episode that eases, the days until it was found show it best.
        if kept.is_empty() {
            kept = signs(&watched, found.since..found.found + 1);
        }
        let since = date(found.since);
        let words = wording::episode_words(since, found.over.map(date), &kept);
        ChangeEpisode {
            since,
            found: date(found.found),
            worse: found.worse.iter().copied().map(date).collect(),
            over: found.over.map(date),
            course: self.course(found, until),
            seen_with: self.seen_with(found.since..until.max(found.found + 1)),
            signs: kept,
            words,
        }
    }

    /// News by day, from the days until then.
    fn news(&self, days: &[DayMeasures]) -> Vec<EpisodeNews> {
        let watched = WatchedColumns { days, distances: &self.distances, usual: &self.usual };
        let mut news = Vec::new();
        for episode in &self.episodes {
            let since = days[episode.since].date;
            let mut tell = |on: usize, kind: NewsKind, over: Option<usize>| {
                let signs = signs(&watched, episode.since..over.unwrap_or(on + 1).max(episode.found + 1));
                let words = match (kind, over) {
                    (NewsKind::Over, Some(over)) => format!("As usual again since {}", in_full(days[over].date)),
                    (NewsKind::Worse, _) => format!("More of it. {}", wording::episode_words(since, None, &signs)),
                    _ => wording::episode_words(since, None, &signs),
                };
                let measures = signs.iter().map(|sign| sign.measure).collect();
                news.push(EpisodeNews { date: days[on].date, kind, since, measures, words });
            };
            tell(episode.found, NewsKind::Found, None);
            episode.worse.iter().for_each(|on| tell(*on, NewsKind::Worse, None));
            if let Some(closed) = episode.closed {
                tell(closed.min(days.len() - 1), NewsKind::Over, episode.over);
            }
        }
        news
    }

    /// Compares the evidence of the last two weeks with that of the first and of the strongest two.
    fn course(&self, found: &FoundEpisode, until: usize) -> Course {
        if found.over.is_some() {
            return Course::Over;
        }
        let pattern = &self.patterns.conditions[found.leading.pattern];
        let known: Vec<f64> = self.distances[found.since..until]
            .iter()
            .filter(|day| day.iter().any(Option::is_some))
            .map(|day| pattern.evidence(day, 1.0))
            .collect();
        let weeks: Vec<f64> = known.rchunks(COURSE_DAYS).rev().filter_map(mean).collect();
        let (Some(last), Some(first)) = (weeks.last(), weeks.first()) else { return Course::Steady };
        let most = weeks.iter().copied().fold(f64::MIN, f64::max);
        match () {
            () if last - first > COURSE_EVIDENCE && most - last < COURSE_EVIDENCE => Course::Growing,
            () if most - last > COURSE_EVIDENCE => Course::Easing,
            () => Course::Steady,
        }
    }

    /// The conditions with about as much evidence as the one with the most, in some days.
    fn near(&self, days: Range<usize>) -> impl Iterator<Item = (&ConditionPattern, f64)> {
        let evidence = self.patterns.mean_evidence(&self.distances[days]);
        let most = evidence.iter().copied().fold(0.0, f64::max);
        let all = self.patterns.conditions.iter().zip(evidence);
        all.filter(move |(_, evidence)| *evidence > 0.0 && *evidence >= NEAR_SHARE * most)
    }

    /// The conditions that such signs are seen with, the one with the most evidence first.
    fn seen_with(&self, days: Range<usize>) -> Vec<SeenWith> {
        let mut near: Vec<(&ConditionPattern, f64)> =
            self.near(days).filter(|(pattern, _)| pattern.likelihood_ratio >= LEAST_RATIO).collect();
        near.sort_by(|a, b| b.1.total_cmp(&a.1));
        let seen = |(pattern, _): (&ConditionPattern, f64)| SeenWith {
            condition: pattern.name.clone(),
            likelihood_ratio: pattern.likelihood_ratio,
        };
        near.into_iter().map(seen).collect()
    }
}

/// Runs of days on which the home was empty for most of the day.
fn absences(days: &[DayMeasures]) -> Vec<DaysAway> {
    let away = |day: &DayMeasures| day.is_whole && !day.counts();
    let runs = days.chunk_by(|a, b| away(a) == away(b)).filter(|run| away(&run[0]));
    runs.map(|run| DaysAway { from: run[0].date, to: run[run.len() - 1].date }).collect()
}

impl fmt::Display for WatchedDays {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let WatchedDays { name, days, days_that_count, headline, .. } = self;
        let days = counted(*days, "day", "days");
        writeln!(f, "{name}: {days}, {days_that_count} of them complete and at home\n\n{}.", headline.words)?;
        if let Some(reference) = &self.reference {
            let ReferenceDays { from, to, days, .. } = reference;
            let days = counted(*days, "complete day", "complete days");
            writeln!(f, "Compared with {} to {} ({days}).", in_full(*from), in_full(*to))?;
        }
        for episode in &self.episodes {
            write!(f, "\n{}", episode)?;
        }
        for away in &self.absences {
            writeln!(f, "\n{}.", away.words())?;
        }
        write_remarks(f, &self.silent)?;
        write_remarks(f, &self.remarks)?;
        writeln!(f, "\n{NOT_A_DEVICE}")
    }
}

/// The end of reports about a resident.
pub const NOT_A_DEVICE: &str = "For research: this is not a medical device, and no diagnosis.";

#[cfg(test)]
mod tests;
