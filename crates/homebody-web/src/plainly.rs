//! Alerts and sentences in everyday words, for who knows nothing of sensors or statistics.

use homebody_analysis::alerts::{Alert, Method, Rules, SENSOR};
use homebody_analysis::dates::clock_of_hours;
use homebody_analysis::measures::Measure;
use homebody_analysis::summaries::Sentence;

/// Ratio to the usual of a large decrease, and of a large increase (our choice).
const MUCH_LESS: f64 = 0.7;
const MUCH_MORE: f64 = 1.5;
/// Smallest large change of times of day in hours, and of the pace as a share (our choice).
const MUCH_LATER_H: f64 = 1.5;
const MUCH_SLOWER: f64 = 0.15;

/// How a measure is spoken of.
struct Spoken {
    measure: &'static str,
    /// What there is of it where there is more than usual, and less.
    more: &'static str,
    less: &'static str,
    /// The thing itself.
    thing: &'static str,
    kind: Kind,
    is_of_night: bool,
}

/// What its numbers are.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Hours,
    /// A time of day, in hours since midnight.
    Clock,
    Times,
    /// How fast somebody walks.
    Pace,
    /// Nothing that anybody counts: it is told by how much it differs.
    Amount,
}

macro_rules! spoken {
    ($($measure:ident $kind:ident $night:literal: $more:literal, $less:literal, $thing:literal;)*) => {
        static SPOKEN: &[Spoken] = &[$(Spoken {
            measure: stringify!($measure),
            more: $more,
            less: $less,
            thing: $thing,
            kind: Kind::$kind,
            is_of_night: $night,
        }),*];
    };
}

spoken! {
    time_in_bed Hours true: "more time in bed", "less time in bed", "the time in bed";
    bedtime Clock true: "later to bed", "earlier to bed", "going to bed";
    rising Clock true: "later up in the morning", "earlier up in the morning", "getting up";
    sleep Hours true: "more sleep", "less sleep", "sleep";
    restlessness Amount true: "more restless in bed", "less restless in bed", "restlessness in bed";
    bathroom_night Times true: "more often in the bathroom by night", "less often in the bathroom by night", "the bathroom by night";
    bathroom_day Times false: "more often in the bathroom by day", "less often in the bathroom by day", "the bathroom by day";
    showers Times false: "more often a shower", "less often a shower", "showers";
    meals Times false: "more often a meal in the kitchen", "less often a meal in the kitchen", "meals";
    time_out Hours false: "more time out of the home", "less time out of the home", "time out of the home";
    outings Times false: "more often out of the home", "less often out of the home", "outings";
    room_changes Amount false: "more moving about at home", "less moving about at home", "moving about at home";
    pace Pace false: "faster on foot", "slower on foot", "walking pace";
    pace_slow Pace false: "faster on the slowest ways", "slower on the slowest ways", "the slowest ways";
    walking_speed Amount false: "faster on foot", "slower on foot", "walking speed";
    walking_speed_slow Amount false: "faster on slow walks", "slower on slow walks", "slow walks";
    walking_speed_fast Amount false: "faster on fast walks", "slower on fast walks", "fast walks";
    company Hours false: "more time with company", "less time with company", "time with company";
    visits Times false: "more often visitors", "less often visitors", "visitors";
    pacing Times false: "more often to and fro between rooms", "less often to and fro between rooms", "going to and fro";
    lapping Times false: "more often round and round the rooms", "less often round and round the rooms", "going round and round";
    sedentary Hours false: "more sitting and resting by day", "less sitting and resting by day", "sitting and resting";
    density_night Amount true: "more movement at night", "less movement at night", "movement at night";
    density_morning Amount false: "more movement in the morning", "less movement in the morning", "movement in the morning";
    density_afternoon Amount false: "more movement in the afternoon", "less movement in the afternoon", "movement in the afternoon";
    density_evening Amount false: "more movement in the evening", "less movement in the evening", "movement in the evening";
    density_distance Amount false: "more change in when and how much she moves", "less change in when and how much she moves", "the course of the day";
    interdaily_stability Amount false: "days more alike", "days less alike", "how alike days are";
    intradaily_variability Amount false: "days more broken up", "days less broken up", "how broken up days are";
}

fn spoken(measure: &str) -> Option<&'static Spoken> {
    SPOKEN.iter().find(|spoken| spoken.measure == measure)
}

/// What a measure is about, in the middle of a sentence.
fn thing(measure: &str) -> String {
    let title = || Measure::named(measure).map_or(measure, |measure| measure.title).to_lowercase();
    spoken(measure).map_or_else(title, |spoken| spoken.thing.to_owned())
}

/// What was worth a look.
pub fn alert(alert: &Alert, rules: &Rules) -> String {
    if alert.rule == SENSOR {
        return format!("{}; its battery may be empty", alert.words);
    }
    let (&[measure], Some(is_more)) = (&alert.measures[..], alert.is_more) else {
        let things: Vec<String> = alert.measures.iter().map(|measure| thing(measure)).collect();
        return format!("Several things were unusual at once: {}", listed(&things));
    };
    let what = match spoken(measure) {
        Some(spoken) if is_more => spoken.more.to_owned(),
        Some(spoken) => spoken.less.to_owned(),
        None => format!("{} {}", if is_more { "more" } else { "less" }, thing(measure)),
    };
    let kind = spoken(measure).map_or(Kind::Amount, |spoken| spoken.kind);
    let is_much = alert.value.zip(alert.usual).is_some_and(|(value, usual)| is_much(kind, value, usual));
    let (beside, since) = match (method(alert, rules), alert.shown_by.len()) {
        (Some(Method::Ewma), _) => ("before", ", little by little over some days".to_owned()),
        (_, 2) => ("usual", ", two days in a row".to_owned()),
        (_, days @ 3..) => ("usual", format!(", {days} days in a row")),
        _ => ("usual", String::new()),
    };
    let much = if is_much { "much " } else { "" };
    // What begins with "days" does not take a "much" before it.
    let what = if what.starts_with("days ") { what } else { format!("{much}{what}") };
    capital(&format!("{what} than {beside}{since}"))
}

/// By which method an alert was found.
fn method(alert: &Alert, rules: &Rules) -> Option<Method> {
    rules.rules.iter().find(|rule| rule.name == alert.rule).map(|rule| rule.method)
}

fn is_much(kind: Kind, value: f64, usual: f64) -> bool {
    match kind {
        Kind::Clock => (value - usual).abs() >= MUCH_LATER_H,
        Kind::Pace => (value / usual - 1.0).abs() >= MUCH_SLOWER,
        _ => value <= usual * MUCH_LESS || value >= usual * MUCH_MORE,
    }
}

/// What an alert came to, and what was usual.
pub fn numbers_of_alert(alert: &Alert, rules: &Rules) -> String {
    let (&[measure], Some(value), Some(usual)) = (&alert.measures[..], alert.value, alert.usual) else {
        return String::new();
    };
    let of = if method(alert, rules) == Some(Method::Ewma) { "On average" } else { "On that day" };
    beside(measure, (of, value), usual, "usually")
}

/// On how many of so many days a sentence is so, and what it comes to.
pub fn numbers_of_sentence(sentence: &Sentence, days: usize) -> String {
    let known = (sentence.focus * days as f64).round();
    let occasions = if spoken(sentence.measure).is_some_and(|spoken| spoken.is_of_night) { "nights" } else { "days" };
    let so = format!("So on {} of {known:.0} {occasions}", sentence.shown_by.len());
    let mean = match sentence.before {
        Some(before) => beside(sentence.measure, ("On average", sentence.mean), before, "before"),
        None => told(sentence.measure, sentence.mean).map_or_else(String::new, |told| format!("On average {told}.")),
    };
    format!("{so}. {mean}").trim_end().to_owned()
}

/// A value, and one to hold it against.
fn beside(measure: &str, (of, value): (&str, f64), other: f64, when: &str) -> String {
    if let (Some(value), Some(other)) = (told(measure, value), told(measure, other)) {
        return format!("{of} {value}; {when} {other}.");
    }
    if other <= 0.0 {
        return String::new();
    }
    let percent = ((value / other - 1.0) * 100.0).round();
    let (more, less) = match spoken(measure).map(|spoken| spoken.kind) {
        Some(Kind::Pace) => ("faster", "slower"),
        _ => ("more", "less"),
    };
    let when = if when == "usually" { "usual" } else { when };
    format!("{:.0} % {} than {when}.", percent.abs(), if percent < 0.0 { less } else { more })
}

/// A value as people say it; `None` where nobody counts it.
fn told(measure: &str, value: f64) -> Option<String> {
    match spoken(measure)?.kind {
        Kind::Hours => Some(format!("{value:.1} hours")),
        Kind::Clock => Some(format!("at {}", clock_of_hours(value))),
        Kind::Times if value.fract() == 0.0 => Some(format!("{value:.0} times")),
        Kind::Times => Some(format!("{value:.1} times")),
        Kind::Pace | Kind::Amount => None,
    }
}

/// What cannot be said, without what is asked of a command.
pub fn remark(remark: &str) -> String {
    remark.split("; --").next().unwrap_or(remark).to_owned()
}

fn listed(things: &[String]) -> String {
    match things {
        [] => String::new(),
        [one] => one.clone(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_analysis::alerts::USUAL;

    fn of(rule: &str, measure: &'static str, (value, usual): (f64, f64), days: usize) -> Alert {
        let shown_by = (1..=days).map(|day| format!("2024-01-{day:02}").parse().unwrap()).collect::<Vec<_>>();
        Alert {
            date: shown_by[shown_by.len() - 1],
            rule: rule.into(),
            measures: vec![measure],
            is_more: Some(value > usual),
            value: Some(value),
            usual: Some(usual),
            sd: Some(1.0),
            shown_by,
            words: "Density 6-12: 276.22 firings/h".into(),
        }
    }

    #[test]
    fn alerts_are_told_in_everyday_words() {
        let rules = Rules::read(USUAL).unwrap();
        let quiet = of("quiet mornings, slowly", "density_morning", (276.0, 451.0), 1);
        assert_eq!(
            alert(&quiet, &rules),
            "Much less movement in the morning than before, little by little over some days"
        );
        assert_eq!(numbers_of_alert(&quiet, &rules), "39 % less than usual.");
        let sleep = of("sleep", "sleep", (6.0, 7.25), 2);
        assert_eq!(alert(&sleep, &rules), "Less sleep than usual, two days in a row");
        assert_eq!(numbers_of_alert(&sleep, &rules), "On that day 6.0 hours; usually 7.2 hours.");
        let late = of("getting up late", "rising", (9.0, 7.25), 3);
        assert_eq!(alert(&late, &rules), "Much later up in the morning than usual, 3 days in a row");
        assert_eq!(numbers_of_alert(&late, &rules), "On that day at 09:00; usually at 07:15.");
        let several = Alert { measures: vec!["sleep", "meals", "rising"], is_more: None, ..sleep };
        assert_eq!(alert(&several, &rules), "Several things were unusual at once: sleep, meals and getting up");
        assert_eq!(numbers_of_alert(&several, &rules), "");
    }

    #[test]
    fn no_rule_is_told_in_the_words_of_sensors() {
        let rules = Rules::read(USUAL).unwrap();
        for rule in &rules.rules {
            let (_, measure) = rule.measure().unwrap();
            for values in [(1.0, 2.0), (2.0, 1.0)] {
                let one = of(&rule.name, measure.name, values, 1);
                let words = format!("{} {}", alert(&one, &rules), numbers_of_alert(&one, &rules));
                for jargon in ["ensity", "firing", "sensor", "average of", "_", "bouts", "sd"] {
                    assert!(!words.contains(jargon), "{words}");
                }
            }
        }
    }

    #[test]
    fn remarks_ask_for_no_option_of_a_command() {
        assert_eq!(remark("Nothing is known of rooms; --home tells which"), "Nothing is known of rooms");
        assert_eq!(remark("Nothing is known; it is so"), "Nothing is known; it is so");
    }
}
