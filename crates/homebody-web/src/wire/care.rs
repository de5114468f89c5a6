//! The state of a resident, for carers.

use homebody_analysis::care::{Care, CareDay, MeasureChart};
use homebody_analysis::episodes::{ChangeEpisode, DaysAway, Headline, ReferenceDays, WatchedDays};
use homebody_analysis::summaries::SummarySentence;
use serde::{Deserialize, Serialize};
use ts_rs::TS;

/// The report for carers about a stored run or a log.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct CareView {
    /// The name of the run.
    pub name: String,
    pub person: String,
    /// The last day that counts, as `2009-03-02`.
    pub day: Option<String>,
    pub headline: Headline,
    /// The reference days; null before the first day that counts.
    pub reference: Option<ReferenceDays>,
    pub remarks: Vec<String>,
    /// Sensors that are silent, in sentences.
    pub silent: Vec<String>,
    /// The content of its playback.
    pub walks: PlaybackContent,
    /// In order.
    pub days: Vec<CareDay>,
    /// Days on which the home was empty for most of the day.
    pub absences: Vec<DaysAway>,
    /// About the last two weeks.
    pub sentences: Vec<CareSentenceView>,
    /// The latest first.
    pub episodes: Vec<ChangeEpisode>,
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
    pub days: Vec<String>,
}

/// A note about an episode or a day.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct NoteView {
    /// As `2009-03-02`: the day, or that on which the episode was found.
    pub day: String,
    pub about: NoteSubject,
    /// True once a person has dealt with it.
    pub seen: bool,
    pub note: String,
    /// The name of the person who has written it; empty if none is given.
    #[serde(default)]
    pub who: String,
    /// The time at which it was stored, as `2009-03-02T14:05`, by the clock of the server; empty in a new note.
    #[serde(default)]
    pub at: String,
}

/// The subject of a note.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum NoteSubject {
    Day,
    Episode,
    /// A new reference begins on the day.
    Reference,
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
        let WatchedDays { headline, reference, mut episodes, absences, silent, .. } = care.watched;
        episodes.reverse();
        CareView {
            name: name.to_owned(),
            person: person.to_owned(),
            day: care.day.map(|day| day.to_string()),
            headline,
            reference,
            remarks: care.remarks.iter().map(remark).collect(),
            silent,
            walks,
            days: care.days,
            absences,
            sentences: care.sentences.iter().map(CareSentenceView::from).collect(),
            episodes,
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
            days: sentence.shown_by.iter().map(ToString::to_string).collect(),
        }
    }
}
