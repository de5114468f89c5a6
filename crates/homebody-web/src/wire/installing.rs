//! Installing sensors: sheets, comparison of layouts, suggested places.

use super::{CoverageView, Draft, HomeView, ProblemView};
use homebody_analysis::parts::SensorDifference;
use homebody_placement::search::Reached;
use serde::{Deserialize, Serialize};
use ts_rs::TS;

/// A sensor on an install sheet.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct PartView {
    pub number: usize,
    pub name: String,
    pub kind: String,
    /// Make and model, or the kind if any model will do.
    pub device: String,
    pub network: String,
    /// Floor, room and place in words.
    pub place: String,
    /// Height, direction and field; null for a sensor without a lens.
    pub aim: Option<String>,
}

/// The install sheet of a draft.
#[derive(Clone, Debug, Default, PartialEq, Serialize, TS)]
pub struct PartsView {
    /// Of the home; then the rest is empty.
    pub problems: Vec<ProblemView>,
    /// The number of each device, the largest first.
    pub devices: Vec<(String, usize)>,
    pub parts: Vec<PartView>,
    /// The same as comma-separated values.
    pub csv: String,
}

/// Two drafts to be compared.
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

#[derive(Clone, Debug, Default, PartialEq, Serialize, TS)]
pub struct LayoutsView {
    /// Of either home; then the rest is empty.
    pub problems: Vec<ProblemView>,
    pub layouts: Vec<LayoutView>,
    pub differences: Vec<SensorDifference>,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct LayoutView {
    pub name: String,
    pub devices: Vec<(String, usize)>,
    pub home: HomeView,
    pub coverage: CoverageView,
}

/// A request for suggested sensors.
#[derive(Clone, Debug, PartialEq, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct Suggest {
    pub draft: Draft,
    /// The largest number.
    pub sensors: u16,
    /// The goals, as in `homebody suggest-sensors`.
    pub to_see: Vec<String>,
    /// The number of people to simulate, for goals that need them.
    pub people: u32,
    /// The motion sensor to use; null for that of Godsey & Skubic 2009.
    pub device: Option<String>,
}

#[derive(Clone, Debug, Default, PartialEq, Serialize, TS)]
pub struct SuggestionView {
    /// Of the home or its routines; then the rest is empty.
    pub problems: Vec<ProblemView>,
    /// The reason of a refusal, in a sentence.
    pub refused: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub code: Option<String>,
    /// The list of sensors for `home.json`.
    pub sensors: String,
    /// With one sensor, two, and so on.
    pub steps: Vec<StepView>,
    /// The final layout, if exchanges improved the last step.
    pub whole: Option<StepView>,
    /// The sensors of the home.
    pub own: Option<StepView>,
}

/// The score of a layout.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct StepView {
    /// The name of the last sensor.
    pub sensor: String,
    /// The mean over the goals, from 0 to 1.
    pub score: f64,
    pub reached: Vec<Reached>,
}
