//! How somebody is, for those who care: the last day beside the usual, what has changed, what was worth a visit, and charts.
//!
//! All of it is of measures, alerts and summaries, in words without sensors. A day's usual is the mean and the standard deviation of the
//! days before it that count, as alerts have it.

use crate::alerts::{Alert, Rules, alerts, counts, usual_before};
use crate::dates::clock_of_hours;
use crate::measures::{Day, Measures};
use crate::summaries::{About, Sentence, summarise};
use jiff::civil::Date;

/// How somebody is.
#[derive(Clone, Debug)]
pub struct Care {
    /// The last whole day, which is held against the usual.
    pub day: Option<Date>,
    /// What cannot be said, in sentences.
    pub remarks: Vec<String>,
    /// Whether enough days lie before the last two weeks to say what has changed.
    pub is_compared: bool,
    /// All days in order, each by what carers ask about.
    pub days: Vec<DayTold>,
    /// Sentences about the last two weeks: what has changed first.
    pub sentences: Vec<Sentence>,
    /// What was worth a visit, the latest first.
    pub alerts: Vec<Alert>,
    /// A chart for each thing that carers ask about.
    pub charts: Vec<Chart>,
}

/// A day in words.
#[derive(Clone, Debug, PartialEq)]
pub struct DayTold {
    /// The day.
    pub date: Date,
    /// What is known of it.
    pub known: Known,
    /// What carers ask about; nothing of a day that does not count, and of what is guessed.
    pub told: Vec<Today>,
}

/// What is known of a day.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Known {
    /// All of it: it counts.
    Whole,
    /// Nobody was at home for most of it.
    Away,
    /// More than an hour of it is unknown.
    Partly,
}

/// A measure of a day.
#[derive(Clone, Debug, PartialEq)]
pub struct Today {
    /// Its name.
    pub measure: &'static str,
    /// In words, such as `Slept 7.2 h, as usual`.
    pub words: String,
    /// More than usual, or less; `None` as usual.
    pub is_more: Option<bool>,
}

/// A measure day by day.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// Its name.
    pub measure: &'static str,
    /// What it is called.
    pub title: &'static str,
    /// What its values are in.
    pub unit: Unit,
    /// What is less than this apart is the same.
    pub little: f64,
    /// Whether it is guessed.
    pub is_guess: bool,
    /// Its days, in order.
    pub days: Vec<Point>,
}

/// What values of a chart are in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// Hours.
    Hours,
    /// A time of day, in hours since midnight.
    Clock,
    /// So many times.
    Times,
    /// Multiples of what is usual.
    OfUsual,
    /// Metres a second.
    MetresASecond,
}

/// A day of a chart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// The day.
    pub date: Date,
    /// The measure; `None` where it is not known, or the day does not count.
    pub value: Option<f64>,
    /// What was usual by then: from a standard deviation below the mean to one above.
    pub usual: Option<(f64, f64)>,
}

/// What carers ask about, in the order of a day's account.
struct Asked {
    measure: &'static str,
    title: &'static str,
    unit: Unit,
    /// A standard deviation is taken to be so much at least.
    least_sd: f64,
    said: &'static str,
}

/// Sentences are about so many of the last days.
pub const LAST_DAYS: usize = 14;

/// Standard deviations from the mean at which a day is unusual, and difference below which a day is usual in any case
/// (our choice).
const UNUSUAL_SD: f64 = 2.0;
/// Difference of the pace, in percent, below which it is unchanged (our choice).
const SAME_PACE_PERCENT: f64 = 5.0;
const ASKED: [Asked; 11] = [
    Asked { measure: "time_in_bed", title: "In bed", unit: Unit::Hours, least_sd: 0.5, said: "Was in bed for {}" },
    Asked { measure: "sleep", title: "Sleep", unit: Unit::Hours, least_sd: 0.5, said: "Slept {}" },
    Asked { measure: "bedtime", title: "To bed", unit: Unit::Clock, least_sd: 0.4, said: "Went to bed at {}" },
    Asked { measure: "rising", title: "Up", unit: Unit::Clock, least_sd: 0.4, said: "Got up at {}" },
    Asked {
        measure: "bathroom_night",
        title: "Bathroom by night",
        unit: Unit::Times,
        least_sd: 0.7,
        said: "Bathroom by night: {}",
    },
    Asked {
        measure: "bathroom_day",
        title: "Bathroom by day",
        unit: Unit::Times,
        least_sd: 1.5,
        said: "Bathroom by day: {}",
    },
    Asked { measure: "meals", title: "Meals", unit: Unit::Times, least_sd: 0.6, said: "Meals in the kitchen: {}" },
    Asked { measure: "time_out", title: "Out of the home", unit: Unit::Hours, least_sd: 0.7, said: "Was out for {}" },
    Asked { measure: "pace", title: "Walking pace", unit: Unit::OfUsual, least_sd: 0.04, said: "" },
    Asked {
        measure: "walking_speed",
        title: "Walking speed",
        unit: Unit::MetresASecond,
        least_sd: 0.03,
        said: "Walked at {}",
    },
    Asked {
        measure: "company",
        title: "Visitors",
        unit: Unit::Hours,
        least_sd: 0.5,
        said: "Visitors were there for {}",
    },
];

/// What is told instead of what, where it is known: sleep is where the bed or the bedroom shows movements, speed where the home is known.
const INSTEAD: [(&str, &str); 2] = [("sleep", "time_in_bed"), ("walking_speed", "pace")];

/// How somebody is, by the measures of their days; `subject` is what sentences call them.
pub fn care(measures: &Measures, rules: &Rules, subject: &str) -> Care {
    let last = measures.days.iter().rposition(counts);
    let mut charts = Vec::new();
    let mut days: Vec<DayTold> = measures.days.iter().map(nothing_told).collect();
    let has = |measure: &str| measures.days.iter().any(|day| day.value(measure).is_some());
    let has_better = |asked: &&Asked| INSTEAD.iter().any(|(better, of)| asked.measure == *of && has(better));
    for asked in ASKED.iter().filter(|asked| !has_better(asked)) {
        let chart = chart(asked, measures);
        if !chart.is_guess {
            let values: Vec<Option<f64>> = chart.days.iter().map(|day| day.value).collect();
            for (number, value) in values.iter().enumerate() {
                let told = value.map(|value| of_day(asked, value, usual_before(&values, number, asked.least_sd)));
                days[number].told.extend(told);
            }
        }
        if chart.days.iter().any(|day| day.value.is_some()) {
            charts.push(chart);
        }
    }
    let summary = summarise(measures, About { subject, last: LAST_DAYS });
    let mut alerts = alerts(measures, rules).alerts;
    alerts.reverse();
    let day = last.map(|last| measures.days[last].date);
    Care {
        day,
        is_compared: summary.is_compared,
        remarks: summary.remarks,
        days,
        sentences: summary.sentences,
        alerts,
        charts,
    }
}

fn nothing_told(day: &Day) -> DayTold {
    let known = match (day.is_whole, counts(day)) {
        (false, _) => Known::Partly,
        (true, false) => Known::Away,
        (true, true) => Known::Whole,
    };
    DayTold { date: day.date, known, told: Vec::new() }
}

fn chart(asked: &Asked, measures: &Measures) -> Chart {
    let value = |day: &Day| day.value(asked.measure).filter(|_| counts(day));
    let values: Vec<Option<f64>> = measures.days.iter().map(value).collect();
    let point = |(number, day): (usize, &Day)| {
        // Nothing that is measured is below 0.
        let usual = usual_before(&values, number, asked.least_sd).map(|(mean, sd)| ((mean - sd).max(0.0), mean + sd));
        Point { date: day.date, value: values[number], usual }
    };
    let days = measures.days.iter().enumerate().map(point).collect();
    let is_guess = measures.guesses.contains(&asked.measure);
    Chart { measure: asked.measure, title: asked.title, unit: asked.unit, little: asked.least_sd, is_guess, days }
}

/// A measure of a day in words, beside the usual: mean and standard deviation.
fn of_day(asked: &Asked, value: f64, usual: Option<(f64, f64)>) -> Today {
    let told = match (asked.measure, value) {
        ("time_out", value) if value < 0.05 => "Was not out".to_owned(),
        // It is beside the whole log, so it says something where there is no usual yet.
        ("pace", value) => of_pace(value),
        (_, value) => asked.said.replace("{}", &said(asked.unit, value)),
    };
    let Some((mean, sd)) = usual else {
        return Today { measure: asked.measure, words: told, is_more: None };
    };
    let is_more = ((value - mean).abs() > UNUSUAL_SD * sd).then_some(value > mean);
    if matches!(asked.unit, Unit::OfUsual | Unit::MetresASecond) {
        let by = (value / mean - 1.0).abs() * 100.0;
        let words = match is_more {
            None => "Walked at the usual pace".to_owned(),
            Some(true) => format!("Walked {by:.0} % faster than usual"),
            Some(false) => format!("Walked {by:.0} % more slowly than usual"),
        };
        return Today { measure: asked.measure, words, is_more };
    }
    let beside = match (is_more, asked.unit) {
        (None, _) => "as usual".to_owned(),
        (Some(true), Unit::Clock) => format!("later than usual ({})", said(asked.unit, mean)),
        (Some(false), Unit::Clock) => format!("earlier than usual ({})", said(asked.unit, mean)),
        (Some(true), _) => format!("more than usual ({})", said(asked.unit, mean)),
        (Some(false), _) => format!("less than usual ({})", said(asked.unit, mean)),
    };
    Today { measure: asked.measure, words: format!("{told}, {beside}"), is_more }
}

/// The pace of a day beside that of all days, in words.
fn of_pace(of_usual: f64) -> String {
    let percent = ((of_usual - 1.0) * 100.0).round();
    match percent {
        percent if percent.abs() < SAME_PACE_PERCENT => "Walked as fast as on most days".to_owned(),
        percent if percent > 0.0 => format!("Walked {percent:.0} % faster than on most days"),
        percent => format!("Walked {:.0} % more slowly than on most days", -percent),
    }
}

/// A value in words.
fn said(unit: Unit, value: f64) -> String {
    match unit {
        Unit::Hours if (value - 1.0).abs() < 0.05 => "1 hour".to_owned(),
        Unit::Hours => format!("{value:.1} hours"),
        Unit::Clock => clock_of_hours(value),
        Unit::Times if value == 1.0 => "once".to_owned(),
        Unit::Times if value.fract() == 0.0 => format!("{value:.0} times"),
        Unit::Times => format!("{value:.1} times"),
        Unit::OfUsual => format!("{:.0} %", value * 100.0),
        Unit::MetresASecond => format!("{value:.2} m/s"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::alerts::USUAL;
    use crate::measures::MEASURES;
    use jiff::civil::date;

    fn measures(sleep: &[f64]) -> Measures {
        let number = MEASURES.iter().position(|measure| measure.name == "sleep").unwrap();
        let day = |(index, &hours): (usize, &f64)| {
            let mut values = vec![None; MEASURES.len()];
            values[number] = Some(hours);
            Day { date: date(2024, 1, 1).saturating_add(jiff::Span::new().days(index as i64)), is_whole: true, values }
        };
        let days = sleep.iter().enumerate().map(day).collect();
        let (remarks, guesses, silent) = (Vec::new(), Vec::new(), Vec::new());
        Measures { name: "log".into(), measures: MEASURES, remarks, guesses, silent, days, ..Measures::default() }
    }

    #[test]
    fn the_last_day_is_held_against_the_usual() {
        let rules = Rules::read(USUAL).unwrap();
        let same = care(&measures(&[7.0; 20]), &rules, "Ada");
        assert_eq!(same.days[19].told[0].words, "Slept 7.0 hours, as usual");
        let short = [[7.0; 20].as_slice(), &[4.0]].concat();
        let short = care(&measures(&short), &rules, "Ada");
        assert_eq!(short.days[20].told[0].words, "Slept 4.0 hours, less than usual (7.0 hours)");
        assert_eq!((short.days[20].told[0].is_more, short.day), (Some(false), Some(date(2024, 1, 21))));
        assert_eq!((short.charts.len(), short.charts[0].days.len()), (1, 21));
        assert_eq!(short.charts[0].days[20].usual, Some((6.5, 7.5)));
        assert_eq!(short.charts[0].days[3].usual, None, "three days are no usual");
        assert!(!same.is_compared);
        assert!(short.is_compared, "seven days lie before");
    }

    #[test]
    fn days_away_and_days_that_are_not_whole_are_told_apart_and_have_no_words() {
        let mut days = measures(&[7.0; 5]);
        let out = MEASURES.iter().position(|measure| measure.name == "time_out").unwrap();
        days.days[1].values[out] = Some(23.0);
        days.days[2].is_whole = false;
        let told = care(&days, &Rules::read(USUAL).unwrap(), "Ada").days;
        let known: Vec<Known> = told.iter().map(|day| day.known).collect();
        assert_eq!(known, [Known::Whole, Known::Away, Known::Partly, Known::Whole, Known::Whole]);
        let words: Vec<usize> = told.iter().map(|day| day.told.len()).collect();
        assert_eq!(words, [1, 0, 0, 1, 1]);
    }
}
