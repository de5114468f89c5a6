//! Episodes: times in which the days of a resident differ from a reference.
//!
//! The reference is the first four weeks that count, or four weeks from a marked day on, so that a slow change does not become usual.
//! Days are taken one after the other, and no decision uses a later day. Several measures that change together are the signs of one
//! episode. An episode ends when the days are as usual again.
//!
//! A day does not count if it is not whole, or if the resident was out for most of it. A measure is not known while a sensor is silent
//! that it needs.

mod detector;
mod headline;
mod patterns;
mod reference;
mod signs;
mod wording;

use crate::measures::{DayMeasures, MEASURES, Measures, SilentSensor};
use crate::phrases::{in_full, listed, write_remarks};
use detector::{Distances, Leading, Sum, Sums};
use homebody_core::names::capitalised;
use homebody_core::problem::counted;
use homebody_core::statistics::mean;
use jiff::civil::Date;
use reference::Reference;
use serde::Serialize;
use signs::{LAST_DAYS, WatchedColumns, signs};
use std::fmt;

pub use headline::{Headline, HeadlineState};
pub use patterns::{Pattern, PatternMeasure, Patterns};
pub use reference::{LEAST_DAYS, REFERENCE_DAYS, ReferenceDays, Usual};
pub use signs::Sign;

/// Evidence for usual days at which an episode is over (our choice).
const OVER: f64 = 4.0;
/// Largest distance of a measure of a day that counts, in standard deviations (our choice): a single measure does not decide.
const MOST_DISTANCE_SD: f64 = 3.5;
/// Least likelihood ratio with which a condition is named, and factor by which signs have grown or eased (our choice).
const LEAST_RATIO: f64 = 2.0;
const GROWN: f64 = 1.3;

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
    /// In the order in which they were found.
    pub episodes: Vec<Episode>,
    /// What was found day by day, by the days until then alone.
    pub news: Vec<EpisodeNews>,
    pub absences: Vec<DaysAway>,
    /// Sensors that are silent, in sentences.
    pub silent: Vec<String>,
    pub remarks: Vec<String>,
    /// By day, the usual values of all measures on it.
    #[serde(skip)]
    pub usual: Vec<Vec<Option<Usual>>>,
}

/// Signs that moved together.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "wire", derive(ts_rs::TS))]
pub struct Episode {
    /// The estimated first day.
    #[cfg_attr(feature = "wire", ts(type = "string"))]
    pub since: Date,
    /// The day after whose end it was found.
    #[cfg_attr(feature = "wire", ts(type = "string"))]
    pub found: Date,
    /// The first day that was as usual again; `None` while it lasts.
    #[cfg_attr(feature = "wire", ts(type = "string | null"))]
    pub over: Option<Date>,
    pub course: Course,
    /// The strongest first.
    pub signs: Vec<Sign>,
    /// Conditions that make such signs in simulated lives, the likeliest first.
    pub seen_with: Vec<SeenWith>,
    /// The signs in a sentence, without a full stop.
    pub words: String,
}

/// An episode is found, or is over.
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
    Over,
}

/// How strong the signs are by now, beside their strongest week.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[cfg_attr(feature = "wire", derive(ts_rs::TS))]
pub enum Course {
    Growing,
    Steady,
    Easing,
    Over,
}

/// A condition that makes such signs.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "wire", derive(ts_rs::TS))]
pub struct SeenWith {
    pub condition: String,
    pub likelihood_ratio: f64,
}

/// Whole days on which nobody was at home for most of the day.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "wire", derive(ts_rs::TS))]
pub struct DaysAway {
    #[cfg_attr(feature = "wire", ts(type = "string"))]
    pub from: Date,
    #[cfg_attr(feature = "wire", ts(type = "string"))]
    pub to: Date,
}

/// What somebody decides about the days.
#[derive(Clone, Copy, Debug, Default)]
pub struct WatchOptions<'a> {
    /// Days from which on a new reference counts, such as the return from a hospital.
    pub marked: &'a [Date],
    /// The evidence at which an episode is found, if not that of the patterns.
    pub threshold: Option<f64>,
}

/// An episode by the numbers of its days.
#[derive(Clone, Copy, Debug)]
struct FoundEpisode {
    since: usize,
    found: usize,
    over: Option<usize>,
    /// The day after whose end it is known to be over.
    closed: Option<usize>,
    leading: Leading,
    /// Evidence that the days are as usual again.
    against: Sum,
}

/// Takes days one after the other.
struct Watcher<'a> {
    patterns: &'a Patterns,
    threshold: f64,
    reference: Reference,
    sums: Sums<'a>,
    distances: Vec<Distances>,
    usual: Vec<Vec<Option<Usual>>>,
    episodes: Vec<FoundEpisode>,
}

impl<'a> Watcher<'a> {
    fn new(patterns: &'a Patterns, threshold: Option<f64>) -> Watcher<'a> {
        Watcher {
            patterns,
            threshold: threshold.unwrap_or(patterns.threshold),
            reference: Reference::new(),
            sums: Sums::new(patterns),
            distances: Vec::new(),
            usual: Vec::new(),
            episodes: Vec::new(),
        }
    }

    /// Begins a new reference with the next day.
    fn mark(&mut self) {
        let today = self.distances.len();
        self.reference = Reference::new();
        self.sums.clear();
        self.episodes.iter_mut().filter(|episode| episode.over.is_none()).for_each(|episode| {
            (episode.over, episode.closed) = (Some(today), Some(today));
        });
    }

    fn take(&mut self, day: &DayMeasures, is_marked: bool) {
        let number = self.distances.len();
        let usual: Vec<Option<Usual>> = (0..MEASURES.len()).map(|measure| self.reference.usual(measure).copied()).collect();
        let distance = |(value, usual): (&Option<f64>, &Option<Usual>)| {
            let distance = usual.as_ref()?.distance(day.date, (*value)?);
            Some(distance.clamp(-MOST_DISTANCE_SD, MOST_DISTANCE_SD)).filter(|_| day.counts())
        };
        let distances: Distances = day.values.iter().zip(&usual).map(distance).collect();
        self.distances.push(distances);
        self.usual.push(usual);
        if !day.counts() {
            return;
        }
        let distances = &self.distances[number];
        self.sums.take(number, distances);
        match self.episodes.last_mut().filter(|episode| episode.over.is_none()) {
            Some(open) => {
                let pattern = &self.patterns.patterns[open.leading.pattern];
                open.against.add(-pattern.evidence(distances, open.leading.amplitude), number);
                if open.against.value >= OVER {
                    (open.over, open.closed) = (open.against.since, Some(number));
                    self.sums.clear();
                }
            }
            None => {
                let leading = self.sums.leading().filter(|leading| leading.sum.value >= self.threshold);
                self.episodes.extend(leading.map(|leading| FoundEpisode {
                    since: leading.sum.since.unwrap_or(number),
                    found: number,
                    over: None,
                    closed: None,
                    leading,
                    against: Sum::default(),
                }));
                if leading.is_none() {
                    self.reference.take(day, is_marked);
                }
            }
        }
    }
}

fn watched(measures: &Measures, options: WatchOptions) -> Watcher<'static> {
    let mut watcher = Watcher::new(Patterns::fitted(), options.threshold);
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

/// The numbers of the days on which episodes were found.
pub fn found_days(measures: &Measures, options: WatchOptions) -> Vec<usize> {
    watched(measures, options).episodes.iter().map(|episode| episode.found).collect()
}

/// The episodes of a log.
pub fn watch(measures: &Measures, options: WatchOptions) -> WatchedDays {
    let watcher = watched(measures, options);
    let episodes: Vec<Episode> = watcher.episodes.iter().map(|found| watcher.episode(found, &measures.days)).collect();
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

impl Watcher<'_> {
    /// An episode with its dates and its signs, by what is known at the end of the days.
    fn episode(&self, found: &FoundEpisode, days: &[DayMeasures]) -> Episode {
        let date = |number: usize| days[number].date;
        let until = found.over.unwrap_or(days.len());
        let watched = WatchedColumns { days, distances: &self.distances, usual: &self.usual };
        // An episode that is over so soon has the signs of the days until it was found.
        let signs = signs(&watched, found.since..until.max(found.found + 1));
        let since = date(found.since);
        let words = wording::episode_words(since, found.over.map(date), &signs);
        Episode {
            since,
            found: date(found.found),
            over: found.over.map(date),
            course: self.course(found, until),
            seen_with: self.seen_with(found),
            signs,
            words,
        }
    }

    /// What was found day by day.
    fn news(&self, days: &[DayMeasures]) -> Vec<EpisodeNews> {
        let watched = WatchedColumns { days, distances: &self.distances, usual: &self.usual };
        let mut news = Vec::new();
        for episode in &self.episodes {
            let since = days[episode.since].date;
            let signs = signs(&watched, episode.since..episode.found + 1);
            let measures: Vec<&'static str> = signs.iter().map(|sign| sign.measure).collect();
            let words = wording::episode_words(since, None, &signs);
            let found = days[episode.found].date;
            news.push(EpisodeNews { date: found, kind: NewsKind::Found, since, measures: measures.clone(), words });
            if let Some((closed, over)) = episode.closed.zip(episode.over) {
                let words = format!("As usual again since {}", in_full(days[over].date));
                news.push(EpisodeNews { date: days[closed].date, kind: NewsKind::Over, since, measures, words });
            }
        }
        news
    }

    /// The evidence of the last week beside that of the strongest week.
    fn course(&self, found: &FoundEpisode, until: usize) -> Course {
        if found.over.is_some() {
            return Course::Over;
        }
        let pattern = &self.patterns.patterns[found.leading.pattern];
        let known: Vec<&Distances> =
            self.distances[found.since..until].iter().filter(|day| day.iter().any(Option::is_some)).collect();
        let weeks: Vec<f64> = known.windows(LAST_DAYS).map(|week| mean_of(week.iter().map(|day| pattern.match_with(day)))).collect();
        let (Some(last), Some(first)) = (weeks.last(), weeks.first()) else { return Course::Steady };
        let most = weeks.iter().copied().fold(f64::MIN, f64::max);
        match () {
            () if *last > first * GROWN && *last >= most / GROWN => Course::Growing,
            () if *last < most / GROWN => Course::Easing,
            () => Course::Steady,
        }
    }

    /// The condition of the pattern, if the pattern says something of it.
    fn seen_with(&self, found: &FoundEpisode) -> Vec<SeenWith> {
        let mut seen: Vec<SeenWith> = found.leading.ranked(self.patterns);
        seen.retain(|with| with.likelihood_ratio >= LEAST_RATIO);
        seen
    }
}

fn mean_of(values: impl Iterator<Item = f64>) -> f64 {
    mean(&values.collect::<Vec<f64>>()).unwrap_or(0.0)
}

/// Runs of days on which nobody was at home for most of the day.
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

/// What reports about a resident say at their end.
pub const NOT_A_DEVICE: &str = "For research: this is not a medical device, and no diagnosis.";

impl DaysAway {
    pub fn words(&self) -> String {
        match self.from == self.to {
            true => format!("Away on {}", in_full(self.from)),
            false => format!("Away from {} to {}", in_full(self.from), in_full(self.to)),
        }
    }
}

impl fmt::Display for Episode {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        writeln!(f, "{}. Found on {}, {}.", self.words, in_full(self.found), self.course.words())?;
        for sign in &self.signs {
            let direction = if sign.numbers.is_empty() { String::new() } else { format!(": {}", sign.numbers) };
            writeln!(f, "  {}{direction} ({} days show it)", capitalised(&sign.words), sign.shown_by.len())?;
        }
        if !self.seen_with.is_empty() {
            let with: Vec<String> = self.seen_with.iter().map(SeenWith::to_string).collect();
            writeln!(f, "  Seen with {} in simulated lives. Ask.", listed(&with))?;
        }
        Ok(())
    }
}

impl fmt::Display for SeenWith {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{} (likelihood ratio {:.1})", self.condition.replace('-', " "), self.likelihood_ratio)
    }
}

impl Course {
    fn words(self) -> &'static str {
        match self {
            Course::Growing => "still growing",
            Course::Steady => "still so",
            Course::Easing => "easing",
            Course::Over => "over",
        }
    }
}
