//! Lives a week without the depression that somebody would else show, and counts what the sensors said.

use homebody_kit::Error;

pub fn firings(days: u32) -> Result<usize, Error> {
    let scenario = homebody_kit::template("tigerplace-depression")?;
    let mut run = scenario.run().seed(7).days(days).without(["depression"]).start()?;
    let mut firings = 0;
    while let Some(batch) = run.next_batch()? {
        firings += batch.firings.len();
    }
    Ok(firings)
}

pub fn main() -> Result<(), Error> {
    println!("{}", firings(7)?);
    Ok(())
}
