use homebody_core::drivers::error::DriverError;
use homebody_core::event::Events;
use homebody_core::run::Run;
use homebody_core::time::{RunTime, Span};

/// Advances a run to its end, and passes on the events of each step.
pub fn each_step(run: &mut Run, step: Span, mut each: impl FnMut(&Events)) -> Result<(), DriverError> {
    let mut events = Events::default();
    while run.now() < RunTime::START + run.length() {
        run.advance(run.now() + step, &mut events)?;
        each(&events);
        events.clear();
    }
    Ok(())
}

pub fn all_events(run: &mut Run) -> Result<Events, DriverError> {
    let mut events = Events::default();
    run.advance(RunTime::START + run.length(), &mut events)?;
    Ok(events)
}
