//! Simulates a week without the depression of the routine, and counts the firings.

use homebody_simulation::SimulationError;

pub fn firings(days: u32) -> Result<usize, SimulationError> {
    let scenario = homebody_simulation::template("tigerplace-depression")?;
    let mut run = scenario.run().seed(7).days(days).without(["depression"]).start()?;
    let mut firings = 0;
    while let Some(batch) = run.next_batch()? {
        firings += batch.firings.len();
    }
    Ok(firings)
}

pub fn main() -> Result<(), SimulationError> {
    println!("{}", firings(7)?);
    Ok(())
}
