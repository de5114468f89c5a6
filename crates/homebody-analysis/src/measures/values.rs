use super::measure::DailyMeasure;
use super::registry::MEASURES;
use crate::phrases::{in_full, listed};
use homebody_core::problem::counted;
use jiff::civil::Date;
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};
use std::collections::BTreeMap;
use std::fmt;

/// Smallest number of hours away at which a day does not count (our choice).
const AWAY_H: f64 = 16.0;

#[derive(Clone, Debug, Default, Serialize)]
pub struct Measures {
    pub name: String,
    /// The measures, in the order of the values.
    pub measures: &'static [DailyMeasure],
    pub remarks: Vec<String>,
    /// The names of measures that are a guess, as no sensor gives them: see the remarks.
    pub guesses: Vec<&'static str>,
    /// Sensors that fell silent: measures that need them have no value meanwhile.
    pub silent: Vec<SilentSensor>,
    /// Differences between measures by the sensors and by the log's notes of activities, if it has any.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub noted: Vec<NoteComparison>,
    /// The measures that the log's notes give, with the days on which they do.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub from_notes: Vec<NotedMeasure>,
    /// The rooms of sensors by id, if only the words of the ids name them.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub guessed_rooms: BTreeMap<String, String>,
    pub days: Vec<DayMeasures>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DayMeasures {
    pub date: Date,
    /// Less than an hour of it is unknown.
    pub is_whole: bool,
    /// By measure; `None` if unknown.
    #[serde(serialize_with = "by_name")]
    pub values: Vec<Option<f64>>,
}

impl DayMeasures {
    pub fn value(&self, name: &str) -> Option<f64> {
        *self.values.get(MEASURES.iter().position(|measure| measure.name == name)?)?
    }

    /// The day shows usual days: it is whole, and a person was at home for most of it.
    pub fn counts(&self) -> bool {
        self.is_whole && self.value("time_out").is_none_or(|hours| hours < AWAY_H)
    }
}

fn by_name<S: Serializer>(values: &[Option<f64>], serializer: S) -> Result<S::Ok, S::Error> {
    let mut map = serializer.serialize_map(None)?;
    for (measure, value) in MEASURES.iter().zip(values) {
        if let Some(value) = value {
            map.serialize_entry(measure.name, value)?;
        }
    }
    map.end()
}

/// The difference of a measure by the sensors from the same by the notes of a log, over the days on which both are known.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct NoteComparison {
    pub measure: &'static str,
    pub unit: &'static str,
    pub days: usize,
    pub by_notes: f64,
    pub by_sensors: f64,
    /// The average difference of the two on a day.
    pub apart: f64,
    pub by_day: Vec<NotedDay>,
}

/// The values of a day on which both are known.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct NotedDay {
    pub date: Date,
    pub by_notes: f64,
    pub by_sensors: f64,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct NotedMeasure {
    pub measure: &'static str,
    pub days: Vec<Date>,
}

impl fmt::Display for NoteComparison {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let NoteComparison { measure, unit, days, by_notes, by_sensors, apart, .. } = self;
        let days = counted(*days, "day", "days");
        write!(
            f,
            "{measure}: {by_notes:.2} {unit} by the log's notes, {by_sensors:.2} {unit} by the sensors; \
             the mean difference of a day is {apart:.2} ({days})"
        )
    }
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SilentSensor {
    pub sensor: String,
    pub since: Date,
    pub told: Date,
    /// The day of its next report, if there is one.
    pub until: Option<Date>,
}

impl SilentSensor {
    /// In words, for sensors with the same days together: each time the first of them, and the sentence.
    pub fn sentences(silent: &[SilentSensor]) -> Vec<(&SilentSensor, String)> {
        let mut told: Vec<(&SilentSensor, Vec<&str>)> = Vec::new();
        for one in silent {
            let same = |(other, _): &&mut (&SilentSensor, Vec<&str>)| {
                (other.since, other.told, other.until) == (one.since, one.told, one.until)
            };
            match told.iter_mut().find(same) {
                Some((_, sensors)) => sensors.push(&one.sensor),
                None => told.push((one, vec![&one.sensor])),
            }
        }
        let in_words = |(first, sensors): (&'_ SilentSensor, Vec<&str>)| {
            let (noun, has) = if sensors.len() == 1 { ("sensor", "has") } else { ("sensors", "have") };
            let since = in_full(first.since);
            let silence = match first.until {
                Some(until) => format!("sent nothing from {since} to {}", in_full(until)),
                None => format!("{has} sent nothing since {since}"),
            };
            format!("The {noun} {} {silence}", listed(&sensors))
        };
        told.into_iter().map(|(first, sensors)| (first, in_words((first, sensors)))).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use jiff::civil::date;

    #[test]
    fn joins_sensors_that_fall_silent_together() {
        let one = |sensor: &str, until: Option<Date>| SilentSensor {
            sensor: sensor.into(),
            since: date(2024, 1, 15),
            told: date(2024, 1, 17),
            until,
        };
        let back = Some(date(2024, 1, 30));
        let silent = [one("kitchen", back), one("hall", None), one("bed", back)];
        let told: Vec<String> = SilentSensor::sentences(&silent).into_iter().map(|(_, words)| words).collect();
        assert_eq!(
            told,
            [
                "The sensors kitchen and bed sent nothing from 15 January 2024 to 30 January 2024",
                "The sensor hall has sent nothing since 15 January 2024"
            ]
        );
    }
}
