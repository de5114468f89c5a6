//! Measures as HL7 FHIR R4: a bundle of observations, one for each measure of each day.
//!
//! Codes are our own, under [`SYSTEM`], as no terminology has most of these measures; units are UCUM's. A day is an
//! `effectivePeriod` by dates, as a clock on the wall has no zone; times of day are a `valueTime`. An estimate has a note.

use super::measure::{DailyMeasure, MeasureUnit};
use super::values::{DayMeasures, Measures};
use crate::dates::clock_of_hours;
use serde_json::{Value, json};

/// The system of the codes of measures.
pub const SYSTEM: &str = "urn:homebody:measure";

impl Measures {
    /// A bundle of the type `collection`; `patient` is the name of the patient, and no identifier.
    pub fn fhir(&self, patient: &str) -> Value {
        let of_day = |day: &DayMeasures| -> Vec<Value> {
            let known = self.measures.iter().zip(&day.values).filter_map(|(measure, value)| Some((measure, (*value)?)));
            known
                .map(|(measure, value)| json!({ "resource": self.observation(patient, day, measure, value) }))
                .collect()
        };
        let entries: Vec<Value> = self.days.iter().flat_map(of_day).collect();
        let mut bundle = json!({ "resourceType": "Bundle", "type": "collection" });
        // FHIR knows no empty lists.
        if !entries.is_empty() {
            bundle["entry"] = entries.into();
        }
        bundle
    }

    fn observation(&self, patient: &str, day: &DayMeasures, measure: &DailyMeasure, value: f64) -> Value {
        let date = day.date.to_string();
        let mut observation = json!({
            "resourceType": "Observation",
            "status": "final",
            "category": [{ "coding": [{
                "system": "http://terminology.hl7.org/CodeSystem/observation-category",
                "code": "activity"
            }] }],
            "code": {
                "coding": [{ "system": SYSTEM, "code": measure.name, "display": measure.title }],
                "text": measure.definition
            },
            "subject": { "display": patient },
            "effectivePeriod": { "start": date, "end": date },
            "device": { "display": "Homebody, by the sensors of the home" }
        });
        if measure.is_clock() {
            observation["valueTime"] = format!("{}:00", clock_of_hours(value)).into();
        } else {
            let MeasureUnit { name, ucum, .. } = measure.unit;
            observation["valueQuantity"] =
                json!({ "value": value, "unit": name, "system": "http://unitsofmeasure.org", "code": ucum });
        }
        if self.guesses.contains(&measure.name) {
            observation["note"] = json!([{ "text": "Estimated: no sensor of the home measures it directly." }]);
        }
        observation
    }
}

#[cfg(test)]
mod tests {
    use super::super::registry::MEASURES;
    use super::*;
    use jiff::civil::date;
    use std::path::Path;

    /// The day of the example, which `checks/fhir` holds against FHIR's own form. `HOMEBODY_REWRITE` writes it anew.
    #[test]
    fn a_bundle_is_the_example() {
        let values = MEASURES.iter().enumerate().map(|(number, _)| (number != 3).then_some(1.5)).collect();
        let day = DayMeasures { date: date(2024, 2, 29), is_whole: true, values };
        let measures = Measures {
            name: "log".into(),
            measures: MEASURES,
            guesses: vec!["showers"],
            days: vec![day],
            ..Measures::default()
        };
        let bundle = measures.fhir("Ada");
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../checks/fhir/observations.json");
        if std::env::var_os("HOMEBODY_REWRITE").is_some() {
            std::fs::write(&path, serde_json::to_string_pretty(&bundle).unwrap() + "\n").unwrap();
        }
        let example: Value = serde_json::from_str(&std::fs::read_to_string(&path).unwrap()).unwrap();
        assert_eq!(bundle, example, "checks/fhir/observations.json is not that of the code");
        let none = Measures { days: Vec::new(), ..measures };
        assert!(none.fhir("Ada").get("entry").is_none(), "FHIR knows no empty lists");
    }
}
