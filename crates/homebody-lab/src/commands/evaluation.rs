use homebody::shared::{self, Failure};
use homebody_simulation::SimulationError;
use rayon::prelude::*;

/// Evaluates each case, on all processors, and shows the progress. The results are in the order of the cases.
pub fn evaluate_each<C: Sync, T: Send, E: Into<Failure>>(
    cases: &[C],
    noun: &str,
    ask: impl Fn(&C) -> Result<T, E> + Sync,
) -> Result<Vec<T>, Failure> {
    let pool = rayon::ThreadPoolBuilder::new().build();
    let pool = pool.map_err(|error| SimulationError::Threads { why: error.to_string() })?;
    let template = format!("{{bar:40}} {{pos}} of {{len}} {noun}  {{eta}} left");
    shared::show(cases.len() as u64, &template, |progress| {
        let ask = |case: &C| ask(case).map_err(Into::into).inspect(|_| progress.inc(1));
        pool.install(|| cases.par_iter().map(ask).collect())
    })
}
