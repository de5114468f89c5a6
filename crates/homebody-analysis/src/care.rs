//! A report for carers: the last day compared with the usual, changes, alerts and charts.
//!
//! It comes from measures, alerts and summaries, in words without sensors. The usual value of a day is the mean of the complete
//! days before it, with their standard deviation, as in alerts.

use crate::alerts::{Alert, Rules, alerts, usual_before};
use crate::measures::{DailyMeasure, DayMeasures, MEASURES, Measures, ValueForm};
use crate::summaries::{SummarySentence, SummarySubject, summarise};
use jiff::civil::Date;
use serde::Serialize;

#[derive(Clone, Debug)]
pub struct Care {
    /// The last whole day, which is compared with the usual.
    pub day: Option<Date>,
    pub remarks: Vec<String>,
    /// Enough days lie before the last two weeks to show changes.
    pub is_compared: bool,
    pub days: Vec<CareDay>,
    /// Sentences about the last two weeks: first those about changes.
    pub sentences: Vec<SummarySentence>,
    /// The alerts, the latest first.
    pub alerts: Vec<Alert>,
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
    /// The measures for carers; none on a day that does not count, and none that is a guess.
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
    /// More than usual, or less; `None` as usual.
    pub is_more: Option<bool>,
}

/// A measure day by day.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "wire", derive(ts_rs::TS))]
pub struct MeasureChart {
    pub measure: &'static str,
    pub title: &'static str,
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
    /// The usual range at that time: from a standard deviation below the mean to one above.
    pub usual: Option<(f64, f64)>,
}

/// Number of the last days that sentences are about.
pub const LAST_DAYS: usize = 14;

/// Standard deviations from the mean at which a day is unusual, and difference below which a day is usual in any case
/// (our choice).
const UNUSUAL_SD: f64 = 2.0;
/// The measures of the report with their least standard deviations, in the order of a day's account. The better of two measures
/// of one thing follows the other and replaces it if it has values: sleep needs movements in the bedroom, speed needs a home.
fn rows(measures: &Measures) -> Vec<(&'static DailyMeasure, f64)> {
    let number = |name: &str| MEASURES.iter().position(|measure| measure.name == name);
    let uses = || MEASURES.iter().filter_map(|measure| Some((measure, measure.care?)));
    let has_values = |measure: &DailyMeasure| measures.days.iter().any(|day| day.value(measure.name).is_some());
    let is_replaced = |name: &str| uses().any(|(better, care)| care.instead_of == Some(name) && has_values(better));
    let mut rows: Vec<_> = uses().filter(|(measure, _)| !is_replaced(measure.name)).collect();
    rows.sort_by_key(|(measure, care)| number(care.instead_of.unwrap_or(measure.name)));
    rows.into_iter().map(|(measure, care)| (measure, care.least_sd)).collect()
}

/// A report by the measures of days; `subject` is the resident in its sentences.
pub fn care(measures: &Measures, rules: &Rules, subject: &str) -> Care {
    let last = measures.days.iter().rposition(DayMeasures::counts);
    let mut charts = Vec::new();
    let mut days: Vec<CareDay> = measures.days.iter().map(nothing_told).collect();
    for (measure, least_sd) in rows(measures) {
        let chart = chart(measure, least_sd, measures);
        if !chart.is_guess {
            let values: Vec<Option<f64>> = chart.days.iter().map(|day| day.value).collect();
            for (number, value) in values.iter().enumerate() {
                let told = value.map(|value| of_day(measure, value, usual_before(&values, number, least_sd)));
                days[number].told.extend(told);
            }
        }
        if chart.days.iter().any(|day| day.value.is_some()) {
            charts.push(chart);
        }
    }
    let summary = summarise(measures, SummarySubject { subject, last: LAST_DAYS });
    let mut alerts = alerts(measures, rules).alerts;
    alerts.reverse();
    let day = last.map(|last| measures.days[last].date);
    Care {
        day,
        is_compared: summary.is_compared,
        remarks: summary.remarks,
        days,
        sentences: summary.sentences,
        alerts,
        charts,
    }
}

fn nothing_told(day: &DayMeasures) -> CareDay {
    let known = match (day.is_whole, day.counts()) {
        (false, _) => DayKnowledge::Partly,
        (true, false) => DayKnowledge::Away,
        (true, true) => DayKnowledge::Whole,
    };
    CareDay { date: day.date, known, told: Vec::new() }
}

fn chart(of: &DailyMeasure, little: f64, measures: &Measures) -> MeasureChart {
    let value = |day: &DayMeasures| day.value(of.name).filter(|_| day.counts());
    let values: Vec<Option<f64>> = measures.days.iter().map(value).collect();
    let point = |(number, day): (usize, &DayMeasures)| {
        // Nothing that is measured is below 0.
        let usual = usual_before(&values, number, little).map(|(mean, sd)| ((mean - sd).max(0.0), mean + sd));
        ChartPoint { date: day.date, value: values[number], usual }
    };
    let days = measures.days.iter().enumerate().map(point).collect();
    let is_guess = measures.guesses.contains(&of.name);
    MeasureChart { measure: of.name, title: of.title, unit: of.unit.form, little, is_guess, days }
}

/// A measure of a day in words, with the usual mean and standard deviation.
fn of_day(measure: &'static DailyMeasure, value: f64, usual: Option<(f64, f64)>) -> MeasureWords {
    let beside = usual.map(|(mean, sd)| (mean, ((value - mean).abs() > UNUSUAL_SD * sd).then_some(value > mean)));
    let is_more = beside.and_then(|(_, is_more)| is_more);
    MeasureWords { measure: measure.name, words: measure.day_words(value, beside), is_more }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::alerts::USUAL;
    use jiff::civil::date;

    fn measures(sleep: &[f64]) -> Measures {
        crate::sample::days(&[("sleep", sleep.iter().copied().map(Some).collect())])
    }

    #[test]
    fn the_last_day_is_held_against_the_usual() {
        let rules = Rules::read(USUAL).unwrap();
        let same = care(&measures(&[7.0; 20]), &rules, "Ada");
        assert_eq!(same.days[19].told[0].words, "Slept for 7.0 hours, as usual");
        let short = [[7.0; 20].as_slice(), &[4.0]].concat();
        let short = care(&measures(&short), &rules, "Ada");
        assert_eq!(short.days[20].told[0].words, "Slept for 4.0 hours, less than usual (7.0)");
        assert_eq!((short.days[20].told[0].is_more, short.day), (Some(false), Some(date(2024, 1, 21))));
        assert_eq!((short.charts.len(), short.charts[0].days.len()), (1, 21));
        assert_eq!(short.charts[0].days[20].usual, Some((6.5, 7.5)));
        assert_eq!(short.charts[0].days[3].usual, None, "three days are no usual");
        assert!(!same.is_compared);
        assert!(short.is_compared, "seven days lie before");
    }

    #[test]
    fn days_away_and_partial_days_have_no_words() {
        let mut days = measures(&[7.0; 5]);
        let out = MEASURES.iter().position(|measure| measure.name == "time_out").unwrap();
        days.days[1].values[out] = Some(23.0);
        days.days[2].is_whole = false;
        let told = care(&days, &Rules::read(USUAL).unwrap(), "Ada").days;
        let known: Vec<DayKnowledge> = told.iter().map(|day| day.known).collect();
        assert_eq!(
            known,
            [DayKnowledge::Whole, DayKnowledge::Away, DayKnowledge::Partly, DayKnowledge::Whole, DayKnowledge::Whole]
        );
        let words: Vec<usize> = told.iter().map(|day| day.told.len()).collect();
        assert_eq!(words, [1, 0, 0, 1, 1]);
    }
}
