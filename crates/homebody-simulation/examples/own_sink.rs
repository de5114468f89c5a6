//! Passes a run to a custom sink, which counts the firings of each sensor in each hour of the day, by the clock of the home.

use homebody_simulation::{BatchSink, BoxError, EventBatch, Simulation, SimulationError};
use std::collections::BTreeMap;

/// By sensor: the firings of each hour of the day.
#[derive(Default)]
pub struct ByHour(pub BTreeMap<String, [u64; 24]>);

impl BatchSink for ByHour {
    fn take(&mut self, run: &Simulation, batch: EventBatch) -> Result<(), BoxError> {
        let sensors: Vec<&str> = run.sensors().collect();
        for firing in batch.firings {
            let hour = run.calendar().local(firing.at).hour() as usize;
            self.0.entry(sensors[firing.sensor.index()].to_owned()).or_default()[hour] += 1;
        }
        Ok(())
    }

    fn finish(&mut self, run: &Simulation) -> Result<(), BoxError> {
        for name in run.sensors() {
            // A sensor without firings has 24 zeros.
            self.0.entry(name.to_owned()).or_default();
        }
        Ok(())
    }
}

pub fn by_hour(days: u32) -> Result<ByHour, SimulationError> {
    let run = homebody_simulation::template("tigerplace")?.run().days(days).start()?;
    let mut sink = ByHour::default();
    run.run_into(&mut sink, |progress| eprintln!("{} of {} microseconds", progress.done, progress.length))?;
    Ok(sink)
}

pub fn main() -> Result<(), SimulationError> {
    let ByHour(sensors) = by_hour(2)?;
    for (name, hours) in &sensors {
        println!("{name:24} {}", hours.map(|count| format!("{count:>4}")).concat());
    }
    println!("{}", sensors.values().flatten().sum::<u64>());
    Ok(())
}
