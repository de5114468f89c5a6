//! How somebody is, for those who care.

use homebody_analysis::alerts::Alert;
use homebody_analysis::care::{Care, CareDay, ChartPoint, DayKnowledge, MeasureChart, MeasureWords};
use homebody_analysis::measures::ValueForm;
use homebody_analysis::summaries::SummarySentence;
use homebody_core::names::capitalised;
use serde::{Deserialize, Serialize};
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
    /// Whether enough days lie before the last two weeks to say what has changed.
    pub is_compared: bool,
    /// What cannot be said.
    pub remarks: Vec<String>,
    /// Who walks when it is played back.
    pub walks: WalksView,
    /// All days in order.
    pub days: Vec<CareDayView>,
    /// About the last two weeks, what has changed first.
    pub sentences: Vec<CareSentenceView>,
    /// The latest first.
    pub alerts: Vec<AlertView>,
    pub charts: Vec<ChartView>,
}

/// What of a run or a log can be seen in playback.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum WalksView {
    /// Everybody as the truth has it.
    Lived,
    /// Everybody as the log was walked back.
    WalkedBack,
    /// What sensors said alone: there is no truth, and the log was not walked back.
    Sensors,
    /// Nothing: the log is of no home that is known.
    NoHome,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct CareDayView {
    pub day: String,
    pub known: KnownView,
    /// Nothing of a day that is not whole.
    pub told: Vec<TodayView>,
}

/// What is known of a day.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum KnownView {
    Whole,
    /// Nobody was at home for most of it.
    NobodyHome,
    /// More than an hour of it is unknown.
    Partly,
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
    /// On how many days, and what it comes to.
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
    /// What it came to, and what was usual.
    pub numbers: String,
    /// The measures that it is about.
    pub measures: Vec<String>,
    /// The days that show it.
    pub days: Vec<String>,
}

/// What somebody has noted about an alert, or about a day.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct NoteView {
    /// As `2009-03-02`.
    pub day: String,
    /// The alert's rule; empty for the day itself.
    pub rule: String,
    /// Whether somebody has seen to it.
    pub seen: bool,
    pub note: String,
}

/// A note to be kept.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct NoteIt {
    /// What the page has seen there before; null where nothing was noted.
    pub before: Option<NoteView>,
    /// With no note, and seen to by nobody, nothing is kept of it.
    pub note: NoteView,
}

/// A log that is kept for the care view alone.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, TS)]
pub struct KeptLogView {
    /// The name of its folder.
    pub name: String,
    /// The name of its file.
    pub log: String,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct ChartView {
    pub measure: String,
    pub title: String,
    pub unit: CareUnit,
    /// What is less than this apart is the same.
    pub little: f64,
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
    MetresASecond,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct PointView {
    pub day: String,
    pub value: Option<f64>,
    /// From where to where it was usual.
    pub usual: Option<[f64; 2]>,
}

impl CareView {
    pub fn of(care: &Care, (name, person): (&str, &str), walks: WalksView) -> CareView {
        // The page has no options.
        let remark = |remark: &String| remark.split("; pass --").next().unwrap_or(remark).to_owned();
        CareView {
            name: name.to_owned(),
            person: person.to_owned(),
            day: care.day.map(|day| day.to_string()),
            is_compared: care.is_compared,
            remarks: care.remarks.iter().map(remark).collect(),
            walks,
            days: care.days.iter().map(CareDayView::from).collect(),
            sentences: care.sentences.iter().map(CareSentenceView::from).collect(),
            alerts: care.alerts.iter().map(AlertView::from).collect(),
            charts: care.charts.iter().map(ChartView::from).collect(),
        }
    }
}

impl From<&CareDay> for CareDayView {
    fn from(day: &CareDay) -> CareDayView {
        let known = match day.known {
            DayKnowledge::Whole => KnownView::Whole,
            DayKnowledge::Away => KnownView::NobodyHome,
            DayKnowledge::Partly => KnownView::Partly,
        };
        CareDayView { day: day.date.to_string(), known, told: day.told.iter().map(TodayView::from).collect() }
    }
}

impl From<&MeasureWords> for TodayView {
    fn from(today: &MeasureWords) -> TodayView {
        TodayView { measure: today.measure.to_owned(), words: today.words.clone(), is_more: today.is_more }
    }
}

impl From<&SummarySentence> for CareSentenceView {
    fn from(sentence: &SummarySentence) -> CareSentenceView {
        CareSentenceView {
            words: sentence.plain.clone(),
            numbers: sentence.numbers.clone(),
            measure: sentence.measure.to_owned(),
            is_change: sentence.is_more.is_some(),
            days: sentence.shown_by.iter().map(ToString::to_string).collect(),
        }
    }
}

impl From<&Alert> for AlertView {
    fn from(alert: &Alert) -> AlertView {
        let stop = if alert.numbers.is_empty() { "" } else { "." };
        AlertView {
            day: alert.date.to_string(),
            rule: alert.rule.clone(),
            words: alert.headline.clone(),
            numbers: capitalised(&alert.numbers) + stop,
            measures: alert.measures.iter().map(|&measure| measure.to_owned()).collect(),
            days: alert.shown_by.iter().map(ToString::to_string).collect(),
        }
    }
}

impl From<&MeasureChart> for ChartView {
    fn from(chart: &MeasureChart) -> ChartView {
        ChartView {
            measure: chart.measure.to_owned(),
            title: chart.title.to_owned(),
            unit: CareUnit::from(chart.unit),
            little: chart.little,
            is_guess: chart.is_guess,
            days: chart.days.iter().map(PointView::from).collect(),
        }
    }
}

impl From<ValueForm> for CareUnit {
    fn from(unit: ValueForm) -> CareUnit {
        match unit {
            ValueForm::Hours => CareUnit::Hours,
            ValueForm::Clock => CareUnit::Clock,
            ValueForm::Times | ValueForm::Amount => CareUnit::Times,
            ValueForm::OfUsual => CareUnit::OfUsual,
            ValueForm::MetresASecond => CareUnit::MetresASecond,
        }
    }
}

impl From<&ChartPoint> for PointView {
    fn from(point: &ChartPoint) -> PointView {
        let usual = point.usual.map(|(low, high)| [low, high]);
        PointView { day: point.date.to_string(), value: point.value, usual }
    }
}
