//! A report for carers: the headline, the episodes, the days, and a chart of each measure.
//!
//! It comes from measures, episodes and summaries, in words without sensors. Days are compared with the reference of the episodes.

use crate::episodes::{Usual, WatchOptions, WatchedDays, watch};
use crate::measures::{DailyMeasure, DayMeasures, MEASURES, MeasureGroup, Measures, ValueForm};
use crate::summaries::{SummarySentence, SummarySubject, summarise};
use jiff::civil::Date;
use serde::Serialize;

#[derive(Clone, Debug)]
pub struct Care {
    /// The last day that counts.
    pub day: Option<Date>,
    pub watched: WatchedDays,
    pub remarks: Vec<String>,
    pub days: Vec<CareDay>,
    /// Sentences about the last two weeks.
    pub sentences: Vec<SummarySentence>,
    pub charts: Vec<MeasureChart>,
}

/// A day in words.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "wire", derive(ts_rs::TS))]
pub struct CareDay {
    #[serde(rename = "day")]
    #[cfg_attr(feature = "wire", ts(type = "string"))]
    pub date: Date,
    pub known: DayKnowledge,
    /// The measures; none on a day that does not count.
    pub told: Vec<MeasureWords>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[cfg_attr(feature = "wire", derive(ts_rs::TS))]
pub enum DayKnowledge {
    /// The whole day is known: it counts.
    Whole,
    /// The resident was out for most of the day.
    #[serde(rename = "nobody_home")]
    Away,
    /// More than an hour of the day is unknown.
    Partly,
}

/// A measure of a day.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "wire", derive(ts_rs::TS))]
pub struct MeasureWords {
    pub measure: &'static str,
    /// In words, such as `Slept for 7.2 hours, as usual`.
    pub words: String,
    pub beside: BesideUsual,
}

/// A value of a day, compared with the usual one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[cfg_attr(feature = "wire", derive(ts_rs::TS))]
pub enum BesideUsual {
    More,
    Less,
    AsUsual,
    /// Too few days lie before.
    NotKnown,
}

/// A measure day by day.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "wire", derive(ts_rs::TS))]
pub struct MeasureChart {
    pub measure: &'static str,
    pub title: &'static str,
    pub group: MeasureGroup,
    pub unit: ValueForm,
    /// Smaller differences do not count.
    pub little: f64,
    /// The measure is a guess.
    pub is_guess: bool,
    pub days: Vec<ChartPoint>,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "wire", derive(ts_rs::TS))]
pub struct ChartPoint {
    #[serde(rename = "day")]
    #[cfg_attr(feature = "wire", ts(type = "string"))]
    pub date: Date,
    /// The measure; `None` where it is unknown, or the day does not count.
    pub value: Option<f64>,
    /// The usual range on that day.
    pub usual: Option<(f64, f64)>,
}

/// Number of the last days that sentences are about.
pub const LAST_DAYS: usize = 14;

/// Standard deviations from the usual value at which a day is unusual (our choice).
const UNUSUAL_SD: f64 = 2.0;

/// The numbers of the measures in a report, by group. The better of two measures of one thing replaces the other if it has values: sleep
/// needs movements in the bedroom, speed needs a home.
fn rows(measures: &Measures) -> Vec<usize> {
    let has_values = |number: usize| measures.days.iter().any(|day| day.values[number].is_some());
    let is_replaced =
        |name: &str| MEASURES.iter().enumerate().any(|(better, of)| of.instead_of == Some(name) && has_values(better));
    let mut rows: Vec<usize> =
        (0..MEASURES.len()).filter(|&number| has_values(number) && !is_replaced(MEASURES[number].name)).collect();
    rows.sort_by_key(|&number| MEASURES[number].group);
    rows
}

/// A report by the measures of days; `subject` is the resident in its sentences.
pub fn care(measures: &Measures, options: WatchOptions, subject: &str) -> Care {
    let watched = watch(measures, options);
    let mut days: Vec<CareDay> = measures.days.iter().map(without_words).collect();
    let mut charts = Vec::new();
    for number in rows(measures) {
        let (measure, is_guess) = (&MEASURES[number], measures.guesses.contains(&MEASURES[number].name));
        let mut points = Vec::new();
        for (day, of) in measures.days.iter().enumerate() {
            let value = of.values[number].filter(|_| of.counts());
            let usual = watched.usual[day][number];
            if let Some(value) = value.filter(|_| !is_guess) {
                days[day].told.extend(measure_words(measure, value, of.date, usual));
            }
            // Nothing that is measured is below 0.
            let range = |usual: Usual| {
                let (middle, wide) = (usual.on(of.date), UNUSUAL_SD * usual.spread);
                ((middle - wide).max(0.0), middle + wide)
            };
            points.push(ChartPoint { date: of.date, value, usual: usual.map(range) });
        }
        let DailyMeasure { name, title, group, unit, least_sd, .. } = *measure;
        charts.push(MeasureChart {
            measure: name,
            title,
            group,
            unit: unit.form,
            little: least_sd,
            is_guess,
            days: points,
        });
    }
    let summary = summarise(measures, SummarySubject { subject, last: LAST_DAYS });
    Care {
        day: measures.days.iter().rfind(|day| day.counts()).map(|day| day.date),
        watched,
        remarks: summary.remarks,
        days,
        sentences: summary.sentences.into_iter().filter(|sentence| sentence.is_more.is_none()).collect(),
        charts,
    }
}

fn without_words(day: &DayMeasures) -> CareDay {
    let known = match (day.is_whole, day.counts()) {
        (false, _) => DayKnowledge::Partly,
        (true, false) => DayKnowledge::Away,
        (true, true) => DayKnowledge::Whole,
    };
    CareDay { date: day.date, known, told: Vec::new() }
}

/// A measure of a day in words; `None` where only a usual value would give it a meaning.
fn measure_words(measure: &'static DailyMeasure, value: f64, date: Date, usual: Option<Usual>) -> Option<MeasureWords> {
    let beside = usual.map_or(BesideUsual::NotKnown, |usual| match usual.distance(date, value) {
        by if by > UNUSUAL_SD => BesideUsual::More,
        by if by < -UNUSUAL_SD => BesideUsual::Less,
        _ => BesideUsual::AsUsual,
    });
    let is_more = match beside {
        BesideUsual::More => Some(true),
        BesideUsual::Less => Some(false),
        BesideUsual::AsUsual | BesideUsual::NotKnown => None,
    };
    let words = measure.day_words(value, usual.map(|usual| (usual.on(date), is_more)))?;
    Some(MeasureWords { measure: measure.name, words, beside })
}

#[cfg(test)]
mod tests {
    use super::*;
    use jiff::civil::date;

    fn measures(sleep: &[f64]) -> Measures {
        crate::sample::days(&[("sleep", sleep.iter().copied().map(Some).collect())])
    }

    #[test]
    fn compares_a_day_with_the_reference() {
        let of = |days: &[f64]| care(&measures(days), WatchOptions::default(), "Ada");
        let same = of(&[7.0; 20]);
        assert_eq!(same.days[19].told[0].words, "Slept for 7.0 hours, as usual");
        let short = of(&[[7.0; 20].as_slice(), &[4.0]].concat());
        assert_eq!(short.days[20].told[0].words, "Slept for 4.0 hours, less than usual (7.0)");
        assert_eq!((short.days[20].told[0].beside, short.day), (BesideUsual::Less, Some(date(2024, 1, 21))));
        assert_eq!((short.charts.len(), short.charts[0].days.len()), (1, 21));
        assert_eq!(short.charts[0].days[20].usual, Some((6.2, 7.8)));
        assert_eq!(short.charts[0].days[3].usual, None, "three days are no reference");
        assert_eq!(short.days[3].told[0].beside, BesideUsual::NotKnown);
    }

    #[test]
    fn every_measure_with_values_has_a_chart_and_words() {
        let columns: Vec<(&str, Vec<Option<f64>>)> = (MEASURES.iter())
            .filter(|measure| measure.instead_of.is_none() && measure.name != "time_out")
            .map(|measure| (measure.name, (0..30).map(|day| Some(f64::from(day % 3) + 1.0)).collect()))
            .collect();
        let care = care(&crate::sample::days(&columns), WatchOptions::default(), "Ada");
        assert_eq!((care.charts.len(), care.days[29].told.len()), (columns.len(), columns.len()));
    }

    #[test]
    fn days_away_and_partial_days_have_no_words() {
        let mut days = measures(&[7.0; 5]);
        let out = MEASURES.iter().position(|measure| measure.name == "time_out").unwrap();
        days.days[1].values[out] = Some(23.0);
        days.days[2].is_whole = false;
        let told = care(&days, WatchOptions::default(), "Ada").days;
        let known: Vec<DayKnowledge> = told.iter().map(|day| day.known).collect();
        assert_eq!(
            known,
            [DayKnowledge::Whole, DayKnowledge::Away, DayKnowledge::Partly, DayKnowledge::Whole, DayKnowledge::Whole]
        );
        let words: Vec<usize> = told.iter().map(|day| day.told.len()).collect();
        assert_eq!(words, [1, 0, 0, 1, 1]);
    }
}
