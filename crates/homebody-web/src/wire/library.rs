//! Folders of homes.

use super::StoredView;
use serde::{Deserialize, Serialize};
use ts_rs::TS;

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct LibraryView {
    /// Its path on the server's machine.
    pub folder: String,
    /// The reason why homes cannot be changed.
    pub trouble: Option<String>,
    /// The latest change first.
    pub homes: Vec<HomeEntryView>,
    /// The number of homes that are not listed.
    pub more: u32,
    pub aside: Vec<DeletedHome>,
    pub templates: Vec<TemplateView>,
    /// The number of runs next to the homes, which belong to none.
    pub runs_beside: u32,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct HomeEntryView {
    /// The name of its folder.
    pub name: String,
    /// The name in its scenario; empty if that cannot be read.
    pub title: String,
    pub about: String,
    /// The last change of one of its files, in milliseconds since 1970.
    #[ts(type = "number | null")]
    pub changed_ms: Option<i64>,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct DeletedHome {
    /// The key by which it is restored.
    pub key: String,
    pub name: String,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct TemplateView {
    pub name: String,
    pub about: String,
}

/// The summary of a home.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct CardView {
    /// The text of its plan, valid or not.
    pub home: Option<String>,
    pub residents: Vec<String>,
    pub problems: u32,
    pub runs: u32,
    pub latest: Vec<StoredView>,
    /// The run that is being recorded.
    pub goes_on: Option<String>,
}

/// The origin of a new home.
#[derive(Clone, Debug, PartialEq, Deserialize, TS)]
#[serde(tag = "from", rename_all = "snake_case", deny_unknown_fields)]
pub enum NewHome {
    Empty,
    Template { name: String },
}

/// A new home.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct MadeView {
    pub name: String,
    /// Omissions, guesses and missing parts, in sentences.
    pub remarks: Vec<String>,
}

/// The new name of a home.
#[derive(Clone, Debug, PartialEq, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct CallHome {
    pub name: String,
}
