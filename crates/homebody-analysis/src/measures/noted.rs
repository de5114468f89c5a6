//! Measures by the notes of activities in a log, compared with measures by its sensors.

use super::held::{Measures, Noted};
use super::kinds::MEASURES;
use homebody_core::statistics::mean;
use homebody_core::time::Micros;
use homebody_log::Activity;
use std::ops::Range;

impl Measures {
    /// Compares measures by sensors with measures by the notes of a log. A measure that no sensor has given yet is taken from the notes.
    pub(super) fn hold_beside(&mut self, notes: &[Activity], recorded: Range<Micros>) {
        let Some(told) = Measures::told(&self.name, notes, recorded) else { return };
        for (number, measure) in MEASURES.iter().enumerate() {
            let noted = |date| told.days.iter().find(|day| day.date == date)?.values[number];
            let both = self.days.iter().filter_map(|day| day.values[number].zip(noted(day.date)));
            let (by_sensors, by_notes): (Vec<f64>, Vec<f64>) = both.unzip();
            let apart: Vec<f64> = by_sensors.iter().zip(&by_notes).map(|(a, b)| (a - b).abs()).collect();
            let days = apart.len();
            if let (Some(by_notes), Some(by_sensors), Some(apart)) = (mean(&by_notes), mean(&by_sensors), mean(&apart))
            {
                self.noted.push(Noted { measure: measure.name, unit: measure.unit, days, by_notes, by_sensors, apart });
            }
            let silent = self.days.iter().position(|day| day.values[number].is_some()).unwrap_or(self.days.len());
            let mut is_taken = false;
            for day in &mut self.days[..silent] {
                day.values[number] = noted(day.date);
                is_taken |= day.values[number].is_some();
            }
            if is_taken {
                self.from_notes.push(measure.name);
            }
        }
        if !self.from_notes.is_empty() {
            self.remarks.push(format!(
                "Taken from the log's notes until a sensor gives a value: {}",
                self.from_notes.join(", ")
            ));
        }
    }
}
