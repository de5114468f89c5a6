//! The words of summaries: what each measure is in a sentence.

use super::sentence::About;
use super::set::Set;
use crate::dates::clock_of_hours;
use homebody_core::fuzzy::Quantifier;

/// What kind of sets a measure's values are told by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// How many times.
    Count,
    /// How many hours.
    Hours,
    /// Which time of day.
    Clock,
    /// Not at all: only changes are told.
    Change,
}

/// How a measure is spoken of. The numbers are ours.
pub(super) struct Spoken {
    /// Its name.
    pub measure: &'static str,
    /// What it is about: of several measures about one thing, one is told.
    pub thing: &'static str,
    pub kind: Kind,
    pub is_of_night: bool,
    /// What its values can be.
    pub range: (f64, f64),
    /// A standard deviation is taken to be so much at least.
    pub least_sd: f64,
    /// What somebody did; `{}` is how many, how long or when.
    pub did: &'static str,
    /// What somebody did not do.
    pub did_not: &'static str,
    /// What somebody did more than before, and less.
    pub more: &'static str,
    pub less: &'static str,
}

macro_rules! spoken {
    ($($measure:ident of $thing:literal: $kind:ident $night:literal $range:expr, $least_sd:literal,
        $did:literal, $did_not:literal, $more:literal, $less:literal;)*) => {
        /// All that is spoken of.
        pub(super) static SPOKEN: &[Spoken] = &[$(Spoken {
            measure: stringify!($measure),
            thing: $thing,
            kind: Kind::$kind,
            is_of_night: $night,
            range: $range,
            least_sd: $least_sd,
            did: $did,
            did_not: $did_not,
            more: $more,
            less: $less,
        }),*];
    };
}

spoken! {
    bedtime of "going to bed": Clock true (18.0, 30.0), 0.4,
        "went to bed {}", "", "went to bed later", "went to bed earlier";
    rising of "getting up": Clock true (3.0, 14.0), 0.4,
        "got up {}", "", "got up later", "got up earlier";
    sleep of "the night": Hours true (0.0, 14.0), 0.4,
        "slept {}", "", "slept longer", "slept less";
    time_in_bed of "the night": Hours true (0.0, 16.0), 0.4,
        "was in bed {}", "", "was in bed longer", "was in bed for a shorter time";
    restlessness of "restlessness": Change true (0.0, 60.0), 0.7,
        "", "", "was more restless in bed", "lay quieter in bed";
    bathroom_night of "the bathroom by night": Count true (0.0, 8.0), 0.7,
        "went to the bathroom {}", "did not go to the bathroom", "went to the bathroom more often", "went to the bathroom less often";
    bathroom_day of "the bathroom by day": Change false (0.0, 40.0), 1.5,
        "", "", "went to the bathroom more often", "went to the bathroom less often";
    showers of "showers": Count false (0.0, 3.0), 0.5,
        "took a shower {}", "took no shower", "took a shower more often", "took a shower less often";
    meals of "meals": Count false (0.0, 6.0), 0.6,
        "was in the kitchen for a meal {}", "had no meal in the kitchen", "had more meals", "had fewer meals";
    time_out of "being out": Hours false (0.0, 16.0), 0.7,
        "was out {}", "", "was out longer", "was out less";
    outings of "being out": Count false (0.0, 6.0), 0.7,
        "left home {}", "did not leave home", "left home more often", "left home less often";
    sedentary of "moving": Hours false (0.0, 18.0), 0.8,
        "sat or rested {} by day", "", "sat or rested longer", "sat or rested less";
    room_changes of "moving": Change false (0.0, 1000.0), 15.0,
        "", "", "moved about at home more", "moved about at home less";
    density_morning of "moving": Change false (0.0, 500.0), 10.0,
        "", "", "was livelier in the morning", "was quieter in the morning";
    density_night of "moving by night": Change true (0.0, 500.0), 8.0,
        "", "", "moved about more at night", "moved about less at night";
    pace of "walking": Change false (0.0, 3.0), 0.03,
        "", "", "walked faster", "walked more slowly";
    pacing of "going to and fro": Change false (0.0, 50.0), 1.0,
        "", "", "went to and fro more often", "went to and fro less often";
}

/// What a measure is about.
pub(super) fn thing(measure: &str) -> &'static str {
    SPOKEN.iter().find(|spoken| spoken.measure == measure).map_or("", |spoken| spoken.thing)
}

/// A sentence without numbers that nobody asked for.
pub(super) fn plain(spoken: &Spoken, quantifier: Quantifier, set: Set, about: About, days: usize) -> String {
    let what = match set {
        Set::Exactly(0) => spoken.did_not.to_owned(),
        Set::Exactly(times) => spoken.did.replace("{}", &so_often(times)),
        Set::AtLeast(times) => spoken.did.replace("{}", &format!("{} or more", so_often(times))),
        Set::Between(from, to) if spoken.kind == Kind::Clock => {
            spoken.did.replace("{}", &format!("between {} and {}", clock_of_hours(from), clock_of_hours(to)))
        }
        Set::Between(from, to) => spoken.did.replace("{}", &hours(from, to)),
        Set::Beyond { is_more: true, .. } => format!("{} than before", spoken.more),
        Set::Beyond { is_more: false, .. } => format!("{} than before", spoken.less),
    };
    let occasions = if spoken.is_of_night { "nights" } else { "days" };
    let span = if days == 14 { "the last two weeks".to_owned() } else { format!("the last {days} days") };
    let on = match quantifier {
        Quantifier::Every => format!("Every {} of {span}", &occasions[..occasions.len() - 1]),
        Quantifier::AlmostAlways => format!("On nearly all {occasions} of {span}"),
        Quantifier::Most => format!("On most {occasions} of {span}"),
        Quantifier::Often => format!("On many {occasions} of {span}"),
        Quantifier::AboutHalf => format!("On about half of the {occasions} of {span}"),
        Quantifier::Sometimes => format!("On some {occasions} of {span}"),
        Quantifier::Rarely => format!("On few {occasions} of {span}"),
        Quantifier::AlmostNever => format!("On hardly any {occasions} of {span}"),
    };
    format!("{on}, {} {what}.", about.subject)
}

/// The same with the numbers that it is from.
pub(super) fn expert(
    spoken: &Spoken,
    plain: &str,
    (so, known): (usize, usize),
    (mean, before): (f64, Option<f64>),
    truth: f64,
) -> String {
    let value = |value: f64| match spoken.kind {
        Kind::Clock => clock_of_hours(value),
        Kind::Hours => format!("{value:.1} h"),
        Kind::Count | Kind::Change => format!("{value:.2}"),
    };
    let before = before.map_or(String::new(), |before| format!(", {} before", value(before)));
    let plain = plain.trim_end_matches('.');
    format!("{plain} (truth {truth:.2}; {so} of {known}; mean {}{before}).", value(mean))
}

fn so_often(times: u32) -> String {
    match times {
        1 => "once".into(),
        2 => "twice".into(),
        times => format!("{times} times"),
    }
}

fn hours(from: f64, to: f64) -> String {
    let told = |hours: f64| if hours.fract() == 0.0 { format!("{hours:.0}") } else { format!("{hours:.1}") };
    let noun = if to == 1.0 { "hour" } else { "hours" };
    if from == 0.0 {
        format!("for {} {noun} at most", told(to))
    } else {
        format!("for {} to {} {noun}", told(from), told(to))
    }
}
