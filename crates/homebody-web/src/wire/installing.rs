//! What is put up in a home: parts, layouts side by side, places that are suggested.

use super::{CoverageView, Draft, HomeView, ProblemView};
use serde::{Deserialize, Serialize};
use ts_rs::TS;

/// A sensor as who puts it up has to know it.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct PartView {
    pub number: usize,
    pub name: String,
    pub kind: String,
    /// Make and model, or the kind where any will do.
    pub device: String,
    pub network: String,
    /// Floor, room and place in words.
    pub place: String,
    /// Height, direction and field; null for what has no lens.
    pub aim: Option<String>,
}

/// Everything that is put up by a draft.
#[derive(Clone, Debug, Default, PartialEq, Serialize, TS)]
pub struct PartsView {
    /// Of the home; then there is nothing else.
    pub problems: Vec<ProblemView>,
    /// How many of which device, the most first.
    pub devices: Vec<(String, usize)>,
    pub parts: Vec<PartView>,
    /// The same as comma-separated values.
    pub csv: String,
}

/// Two drafts whose sensors are held against each other.
#[derive(Clone, Debug, PartialEq, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct Layouts {
    pub one: NamedLayout,
    pub other: NamedLayout,
}

#[derive(Clone, Debug, PartialEq, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct NamedLayout {
    pub name: String,
    pub draft: Draft,
}

/// Two layouts side by side.
#[derive(Clone, Debug, Default, PartialEq, Serialize, TS)]
pub struct LayoutsView {
    /// Of either home; then there is nothing else.
    pub problems: Vec<ProblemView>,
    pub layouts: Vec<LayoutView>,
    pub differences: Vec<DiffersView>,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct LayoutView {
    pub name: String,
    pub devices: Vec<(String, usize)>,
    pub home: HomeView,
    pub coverage: CoverageView,
}

/// A sensor that is not the same in both layouts.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct DiffersView {
    pub sensor: String,
    pub what: String,
}

/// Where are sensors to go?
#[derive(Clone, Debug, PartialEq, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct Suggest {
    pub draft: Draft,
    /// How many there may be.
    pub sensors: u16,
    /// What is to be seen, as `homebody suggest-sensors` has it.
    pub to_see: Vec<String>,
    /// How many people live there, where that is asked for which somebody has to.
    pub people: u32,
    /// What motion sensors are to be; null as in Godsey & Skubic 2009.
    pub device: Option<String>,
}

#[derive(Clone, Debug, Default, PartialEq, Serialize, TS)]
pub struct SuggestionView {
    /// Of the home, or of the lives in it; then there is nothing else.
    pub problems: Vec<ProblemView>,
    /// Why there is none, in a sentence.
    pub refused: Option<String>,
    /// The stable code of that message.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub code: Option<String>,
    /// The sensors as `home.json` takes them: a list in JSON.
    pub sensors: String,
    /// With one sensor, two, and so on.
    pub steps: Vec<StepView>,
    /// All of them, where some went for others in the end.
    pub whole: Option<StepView>,
    /// The sensors that the home has.
    pub own: Option<StepView>,
}

/// How much a layout tells.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct StepView {
    /// The name of the sensor that came last.
    pub sensor: String,
    /// The mean over all that is to be seen, from 0 to 1.
    pub score: f64,
    pub reached: Vec<ReachedView>,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct ReachedView {
    pub goal: String,
    pub score: f64,
    pub value: f64,
    pub unit: String,
}
