//! The measures of summaries.

use crate::measures::Measure;

/// A measure of summaries. The figures are our choice.
pub(super) struct Topic {
    pub measure: &'static Measure,
    /// The range of its values; `None` if only its changes have sentences.
    pub range: Option<(f64, f64)>,
    /// A standard deviation is taken to be so much at least.
    pub least_sd: f64,
}

/// By name: subject, range, least standard deviation. Of several measures with one subject, a summary has one.
const TOPICS: [(&str, &str, Option<(f64, f64)>, f64); 17] = [
    ("bedtime", "bedtime", Some((18.0, 30.0)), 0.4),
    ("rising", "getting up", Some((3.0, 14.0)), 0.4),
    ("sleep", "night", Some((0.0, 14.0)), 0.4),
    ("time_in_bed", "night", Some((0.0, 16.0)), 0.4),
    ("restlessness", "restlessness", None, 0.7),
    ("bathroom_night", "bathroom at night", Some((0.0, 8.0)), 0.7),
    ("bathroom_day", "bathroom by day", None, 1.5),
    ("showers", "showers", Some((0.0, 3.0)), 0.5),
    ("meals", "meals", Some((0.0, 6.0)), 0.6),
    ("time_out", "outings", Some((0.0, 16.0)), 0.7),
    ("outings", "outings", Some((0.0, 6.0)), 0.7),
    ("sedentary", "movement", Some((0.0, 18.0)), 0.8),
    ("room_changes", "movement", None, 15.0),
    ("density_morning", "movement", None, 10.0),
    ("density_night", "movement at night", None, 8.0),
    ("pace", "walking", None, 0.03),
    ("pacing", "pacing", None, 1.0),
];

/// All measures of summaries.
pub(super) fn topics() -> impl Iterator<Item = Topic> {
    TOPICS
        .into_iter()
        .filter_map(|(name, _, range, least_sd)| Some(Topic { measure: Measure::named(name)?, range, least_sd }))
}

/// The subject of a measure.
pub(super) fn subject(measure: &str) -> &'static str {
    TOPICS.iter().find(|(name, ..)| *name == measure).map_or("", |(_, subject, ..)| subject)
}
