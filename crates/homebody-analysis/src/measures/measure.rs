//! The row of a measure in the [registry](super::MEASURES).

use super::measured_day::MeasuredDay;
use super::rooms::Purpose;
use serde::{Serialize, Serializer};
use std::fmt;

/// A measure of a day. In tables and JSON it has its first five fields.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct DailyMeasure {
    pub name: &'static str,
    pub unit: MeasureUnit,
    /// The name in pictures and, with a small letter, in sentences.
    pub title: &'static str,
    pub definition: &'static str,
    pub source: &'static str,
    /// `night` for a measure of the night that ends on the day, else `day`.
    #[serde(skip)]
    pub occasion: &'static str,
    /// The hour at which the measured part of the day begins, if the measure is about a part of the day.
    #[serde(skip)]
    pub first_hour: Option<u8>,
    /// A higher value in words, such as `more sleep`.
    #[serde(skip)]
    pub more: &'static str,
    #[serde(skip)]
    pub less: &'static str,
    /// The predicate of a sentence about the resident, with `{}` for the value; empty if no sentence has the value.
    #[serde(skip)]
    pub did: &'static str,
    /// The predicate for the value 0, if the sentence needs other words.
    #[serde(skip)]
    pub did_not: &'static str,
    /// The sensors without which a day has no value.
    #[serde(skip)]
    pub needs: Needs,
    #[serde(skip)]
    pub noted: Option<NoteMeaning>,
    /// The heading under which reports for carers have the measure.
    #[serde(skip)]
    pub group: MeasureGroup,
    /// The coarser measure of the same thing. A report for carers has the coarser one if the finer has no value at all.
    #[serde(skip)]
    pub instead_of: Option<&'static str>,
    /// The least standard deviation of usual values: smaller differences do not count.
    #[serde(skip)]
    pub least_sd: f64,
    /// The place in summaries, if these have the measure.
    #[serde(skip)]
    pub summary: Option<SummaryUse>,
    /// The words with which the page offers the measure as a goal of suggested sensors. Commands take each measure as a goal.
    #[serde(skip)]
    pub goal: Option<&'static str>,
    /// Whether the Python environment `DecideVisits` observes the measure. Measures that follow from many days are left out.
    #[serde(skip)]
    pub is_observed: bool,
    #[serde(skip)]
    pub of: fn(&MeasuredDay) -> Option<f64>,
}

/// A measure of the day, before its row says more.
pub(super) const DAY: DailyMeasure = DailyMeasure {
    name: "",
    unit: TIMES,
    title: "",
    definition: "",
    source: "",
    occasion: "day",
    first_hour: None,
    more: "",
    less: "",
    did: "",
    did_not: "",
    needs: Needs::AllSensors,
    noted: None,
    group: MeasureGroup::Moving,
    instead_of: None,
    least_sd: 1.0,
    summary: None,
    goal: None,
    is_observed: false,
    of: |_| None,
};

/// A measure of the night, before its row says more.
pub(super) const NIGHT: DailyMeasure = DailyMeasure { occasion: "night", ..DAY };

/// The sensors that a measure needs. All must work if no place is named.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Needs {
    AllSensors,
    Room(Purpose),
    Entrance,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoteMeaning {
    Shower,
    Bathroom,
    Bed,
    /// A meal by its name.
    Meal,
    /// Food that may be a meal or a bite.
    Eats,
    Cooks,
    /// A time out; only its beginning if other notes mean coming home.
    Leaves,
    Comes,
}

/// A group of measures, in the order of reports.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
#[cfg_attr(feature = "wire", derive(ts_rs::TS))]
pub enum MeasureGroup {
    Night,
    Bathroom,
    Meals,
    Out,
    Moving,
    Rhythm,
}

/// A measure in summaries. The figures are our choice.
#[derive(Clone, Copy, Debug)]
pub struct SummaryUse {
    /// Of two sentences that say as much, the lower rank comes first.
    pub rank: u8,
    pub subject: &'static str,
    /// The range of the values; `None` if only changes have sentences.
    pub range: Option<(f64, f64)>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MeasureUnit {
    /// The unit in tables and JSON.
    pub name: &'static str,
    /// The code in the Unified Code for Units of Measure, for FHIR.
    pub ucum: &'static str,
    pub form: ValueForm,
}

/// The form of values in sentences.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[cfg_attr(feature = "wire", derive(ts_rs::TS))]
pub enum ValueForm {
    Hours,
    /// A time of day, in hours since midnight: 24.5 is half past midnight.
    Clock,
    Times,
    /// Multiples of the usual value.
    OfUsual,
    MetresASecond,
    /// Any other amount: sentences give the difference in per cent.
    Amount,
}

const fn unit(name: &'static str, ucum: &'static str, form: ValueForm) -> MeasureUnit {
    MeasureUnit { name, ucum, form }
}

pub(super) const HOURS: MeasureUnit = unit("h", "h", ValueForm::Hours);
pub(super) const CLOCK: MeasureUnit = unit("h of day", "1", ValueForm::Clock);
pub(super) const VISITS: MeasureUnit = unit("visits", "{visits}", ValueForm::Times);
pub(super) const TIMES: MeasureUnit = unit("times", "{times}", ValueForm::Times);
pub(super) const BOUTS_AN_HOUR: MeasureUnit = unit("bouts/h", "{bouts}/h", ValueForm::Amount);
pub(super) const OF_USUAL: MeasureUnit = unit("of usual", "1", ValueForm::OfUsual);
pub(super) const METRES_A_SECOND: MeasureUnit = unit("m/s", "m/s", ValueForm::MetresASecond);
pub(super) const FIRINGS_AN_HOUR: MeasureUnit = unit("firings/h", "{firings}/h", ValueForm::Amount);
pub(super) const PATTERN_DISTANCE: MeasureUnit = unit("0-2.24", "1", ValueForm::Amount);
pub(super) const SHARE: MeasureUnit = unit("0-1", "1", ValueForm::Amount);
pub(super) const RATIO: MeasureUnit = unit("ratio", "1", ValueForm::Amount);

impl fmt::Display for MeasureUnit {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.pad(self.name)
    }
}

impl Serialize for MeasureUnit {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name)
    }
}
