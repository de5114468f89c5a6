//! What is said about a folder of homes.

use super::StoredView;
use serde::{Deserialize, Serialize};
use ts_rs::TS;

/// A folder of homes.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct LibraryView {
    /// Its path on the server's machine.
    pub folder: String,
    /// Why nothing can be changed in it, if that is so.
    pub trouble: Option<String>,
    /// Those that were changed last come first.
    pub homes: Vec<HomeEntryView>,
    /// How many more there are, which are not shown.
    pub more: u32,
    /// What was deleted, and can be put back.
    pub aside: Vec<AsideView>,
    pub templates: Vec<TemplateView>,
    /// How many runs lie beside the homes, and belong to none.
    pub runs_beside: u32,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct HomeEntryView {
    /// The name of its folder.
    pub name: String,
    /// What its scenario calls itself; empty where that cannot be read.
    pub title: String,
    pub about: String,
    /// When one of its files was changed last, in milliseconds since 1970, where that is known.
    #[ts(type = "number | null")]
    pub changed_ms: Option<i64>,
}

/// A home that was deleted.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct AsideView {
    /// The name under which it is put back.
    pub key: String,
    /// What it is called then.
    pub name: String,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct TemplateView {
    pub name: String,
    pub about: String,
}

/// What is shown of a home.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct CardView {
    /// The text of its plan, right or wrong; nothing where it cannot be read.
    pub home: Option<String>,
    pub residents: Vec<String>,
    /// How much is wrong with it.
    pub problems: u32,
    /// How many runs it has.
    pub runs: u32,
    /// Those that were lived last.
    pub latest: Vec<StoredView>,
    /// The one that is being lived in the page.
    pub goes_on: Option<String>,
}

/// What a new home begins with.
#[derive(Clone, Debug, PartialEq, Deserialize, TS)]
#[serde(tag = "from", rename_all = "snake_case", deny_unknown_fields)]
pub enum NewHome {
    Empty,
    Template { name: String },
}

/// A home that was made.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct MadeView {
    pub name: String,
    /// What was left out or guessed, and what is missing, in sentences.
    pub remarks: Vec<String>,
}

/// What a home is to be called.
#[derive(Clone, Debug, PartialEq, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct CallHome {
    pub name: String,
}
