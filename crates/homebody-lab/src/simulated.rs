use homebody_core::drivers::error::DriverError;
use homebody_core::event::Events;
use homebody_core::link::form::LinkFile;
use homebody_core::run::Run;
use homebody_core::scenario::load::Scenario;
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

/// The link of a real network with every fault in some days, each in another motion sensor.
pub fn every_fault(scenario: &Scenario, home: usize, (from_day, days): (f64, f64)) -> LinkFile {
    let sensors = scenario.home.placed_sensors();
    let motion: Vec<&str> =
        sensors.iter().filter(|sensor| sensor.senses_motion()).map(|sensor| sensor.name.as_str()).collect();
    let nth = |number: usize| motion[(home * 3 + number * 2) % motion.len()];
    let within = |share: f64| share * days;
    let day = |share: f64| from_day + within(share);
    let faults = serde_json::json!([
        { "kind": "battery", "sensor": nth(0), "from_day": day(0.3), "fading_days": within(0.2), "days": within(0.4) },
        { "kind": "falls_off", "sensor": nth(1), "from_day": day(0.6), "days": within(0.3) },
        { "kind": "stuck", "sensor": nth(2), "from_day": day(0.5), "days": within(0.1), "every_s": 60 },
        { "kind": "drift", "sensor": nth(3), "ppm": 20 },
        { "kind": "false_fires", "sensor": nth(4), "per_h": 2, "between": ["10:00", "15:00"] },
        { "kind": "outage", "from_day": day(0.4), "at": "13:00", "hours": 3 }
    ]);
    let link = serde_json::json!({ "preset": "zigbee", "duplicates": 0.01, "corruption": 0.001, "faults": faults });
    serde_json::from_value(link).unwrap_or_default()
}
