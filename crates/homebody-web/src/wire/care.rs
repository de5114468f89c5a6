//! The state of a resident, for carers.

use homebody_analysis::alerts::Alert;
use homebody_analysis::care::{Care, CareDay, MeasureChart};
use homebody_analysis::summaries::SummarySentence;
use homebody_core::names::capitalised;
use serde::{Deserialize, Serialize};
use ts_rs::TS;

/// The report for carers about a stored run or a log.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct CareView {
    /// The name of the run.
    pub name: String,
    pub person: String,
    /// The reported day, as `2009-03-02`.
    pub day: Option<String>,
    /// True with enough days before the last two weeks for a comparison.
    pub is_compared: bool,
    pub remarks: Vec<String>,
    /// The content of its playback.
    pub walks: PlaybackContent,
    /// In order.
    pub days: Vec<CareDay>,
    /// About the last two weeks, changes first.
    pub sentences: Vec<CareSentenceView>,
    /// The latest first.
    pub alerts: Vec<AlertView>,
    pub charts: Vec<MeasureChart>,
}

/// The content of the playback of a run or a log.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum PlaybackContent {
    /// The movements of the ground truth.
    Lived,
    /// The estimates for a located log.
    WalkedBack,
    /// Sensor events only.
    Sensors,
    /// Nothing: the home of the log is not known.
    NoHome,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct CareSentenceView {
    pub words: String,
    /// The number of days, and the result.
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
    /// The value, and the usual value.
    pub numbers: String,
    pub measures: Vec<String>,
    /// The days with the evidence.
    pub days: Vec<String>,
}

/// A note about an alert or a day.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct NoteView {
    /// As `2009-03-02`.
    pub day: String,
    /// The rule of the alert; empty for a note about the day.
    pub rule: String,
    /// True once a person has dealt with it.
    pub seen: bool,
    pub note: String,
}

/// A new or changed note.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct NoteChange {
    /// The note that the page has read; null if there was none.
    pub before: Option<NoteView>,
    /// An empty note that is not marked as seen is removed.
    pub note: NoteView,
}

/// A log that is stored for the care view only.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, TS)]
pub struct KeptLogView {
    /// The name of its folder.
    pub name: String,
    /// The name of its file.
    pub log: String,
}

impl CareView {
    pub fn new(care: Care, (name, person): (&str, &str), walks: PlaybackContent) -> CareView {
        // Hints at options of the command do not apply to the page.
        let remark = |remark: &String| remark.split("; pass --").next().unwrap_or(remark).to_owned();
        CareView {
            name: name.to_owned(),
            person: person.to_owned(),
            day: care.day.map(|day| day.to_string()),
            is_compared: care.is_compared,
            remarks: care.remarks.iter().map(remark).collect(),
            walks,
            days: care.days,
            sentences: care.sentences.iter().map(CareSentenceView::from).collect(),
            alerts: care.alerts.iter().map(AlertView::from).collect(),
            charts: care.charts,
        }
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
