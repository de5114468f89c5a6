//! How somebody is, for those who care.

use homebody_analysis::alerts::Alert;
use homebody_analysis::care::{Care, Chart, Point, Today, Unit};
use homebody_analysis::summaries::Sentence;
use serde::Serialize;
use ts_rs::TS;

/// How somebody is, by a stored run or a log.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct CareView {
    /// What the run is called.
    pub name: String,
    /// Whom it is about.
    pub person: String,
    /// The day that is told of, as `2009-03-02`.
    pub day: Option<String>,
    /// What cannot be said.
    pub remarks: Vec<String>,
    pub today: Vec<TodayView>,
    /// About the last two weeks, what has changed first.
    pub sentences: Vec<CareSentenceView>,
    /// The latest first.
    pub alerts: Vec<AlertView>,
    pub charts: Vec<ChartView>,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct TodayView {
    pub measure: String,
    pub words: String,
    /// More than usual, or less; null as usual.
    pub is_more: Option<bool>,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct CareSentenceView {
    pub words: String,
    /// The same with numbers.
    pub numbers: String,
    pub measure: String,
    pub is_change: bool,
    pub days: Vec<String>,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct AlertView {
    pub day: String,
    pub rule: String,
    pub words: String,
    /// The days that show it.
    pub days: Vec<String>,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct ChartView {
    pub measure: String,
    pub title: String,
    pub unit: CareUnit,
    pub is_guess: bool,
    pub days: Vec<PointView>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum CareUnit {
    Hours,
    Clock,
    Times,
    OfUsual,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct PointView {
    pub day: String,
    pub value: Option<f64>,
    /// From where to where it was usual.
    pub usual: Option<[f64; 2]>,
}

impl CareView {
    pub fn of(care: &Care, name: &str, person: &str) -> CareView {
        CareView {
            name: name.to_owned(),
            person: person.to_owned(),
            day: care.day.map(|day| day.to_string()),
            remarks: care.remarks.clone(),
            today: care.today.iter().map(TodayView::from).collect(),
            sentences: care.sentences.iter().map(CareSentenceView::from).collect(),
            alerts: care.alerts.iter().map(AlertView::from).collect(),
            charts: care.charts.iter().map(ChartView::from).collect(),
        }
    }
}

impl From<&Today> for TodayView {
    fn from(today: &Today) -> TodayView {
        TodayView { measure: today.measure.to_owned(), words: today.words.clone(), is_more: today.is_more }
    }
}

impl From<&Sentence> for CareSentenceView {
    fn from(sentence: &Sentence) -> CareSentenceView {
        CareSentenceView {
            words: sentence.plain.clone(),
            numbers: sentence.expert.clone(),
            measure: sentence.measure.to_owned(),
            is_change: sentence.is_more.is_some(),
            days: sentence.shown_by.iter().map(ToString::to_string).collect(),
        }
    }
}

impl From<&Alert> for AlertView {
    fn from(alert: &Alert) -> AlertView {
        AlertView {
            day: alert.date.to_string(),
            rule: alert.rule.clone(),
            words: alert.words.clone(),
            days: alert.shown_by.iter().map(ToString::to_string).collect(),
        }
    }
}

impl From<&Chart> for ChartView {
    fn from(chart: &Chart) -> ChartView {
        ChartView {
            measure: chart.measure.to_owned(),
            title: chart.title.to_owned(),
            unit: CareUnit::from(chart.unit),
            is_guess: chart.is_guess,
            days: chart.days.iter().map(PointView::from).collect(),
        }
    }
}

impl From<Unit> for CareUnit {
    fn from(unit: Unit) -> CareUnit {
        match unit {
            Unit::Hours => CareUnit::Hours,
            Unit::Clock => CareUnit::Clock,
            Unit::Times => CareUnit::Times,
            Unit::OfUsual => CareUnit::OfUsual,
        }
    }
}

impl From<&Point> for PointView {
    fn from(point: &Point) -> PointView {
        let usual = point.usual.map(|(low, high)| [low, high]);
        PointView { day: point.date.to_string(), value: point.value, usual }
    }
}
