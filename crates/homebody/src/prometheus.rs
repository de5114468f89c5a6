//! Numbers in the text format of Prometheus.

use homebody_fleet::{DestinationReport, FleetReport};
use std::fmt::{Display, Write};
use std::sync::{Arc, Mutex};

pub type LastReport = Arc<Mutex<FleetReport>>;

pub struct PrometheusText {
    pub text: String,
    scenario: String,
}

impl PrometheusText {
    /// Starts a text without numbers for a scenario.
    pub fn new(scenario: &str) -> PrometheusText {
        PrometheusText { text: String::new(), scenario: escaped(scenario) }
    }

    /// Adds a family of numbers, each with its additional [labels](label).
    pub fn add<N: Display>(
        &mut self,
        name: &str,
        kind: &str,
        help: &str,
        values: impl IntoIterator<Item = (String, N)>,
    ) {
        let PrometheusText { text, scenario } = self;
        // Writing to a string cannot fail.
        let _ = writeln!(text, "# HELP {name} {help}\n# TYPE {name} {kind}");
        for (labels, value) in values {
            let _ = writeln!(text, "{name}{{scenario=\"{scenario}\"{labels}}} {value}");
        }
    }
}

pub fn label(name: &str, value: &str) -> String {
    format!(",{name}=\"{}\"", escaped(value))
}

fn escaped(text: &str) -> String {
    text.replace('\\', "\\\\").replace('"', "\\\"").replace('\n', "\\n")
}

pub fn fleet_numbers(scenario: &str, report: &FleetReport) -> String {
    let mut numbers = PrometheusText::new(scenario);
    let mut one = |name: &str, help: &str, value: f64| numbers.add(name, "gauge", help, [(String::new(), value)]);
    one("homebody_homes", "Homes that are online.", report.homes as f64);
    one("homebody_messages_per_second", "Messages sent a second.", report.messages_per_s);
    one("homebody_behind_seconds", "Age of the oldest message that is due and not sent.", report.behind_s);
    one("homebody_ahead_seconds", "How far homes are simulated ahead of the clock.", report.ahead_s);
    let late = [("0.5", report.late_median_ms), ("0.99", report.late_99_ms), ("1", report.late_most_ms)];
    let late = late.map(|(share, ms)| (label("quantile", share), ms / 1000.0));
    numbers.add("homebody_late_seconds", "gauge", "Delay of messages since the last report.", late);
    let of = |value: fn(&DestinationReport) -> u64| {
        report.destinations.iter().map(move |one| (label("destination", &one.place), value(one)))
    };
    let retries = "Repeated calls to a destination.";
    numbers.add("homebody_retries_total", "counter", retries, of(|one| one.retries));
    numbers.add("homebody_waiting", "gauge", "Messages that are due and not sent.", of(|one| one.waiting as u64));
    let up = "1 if a destination is reachable, else 0.";
    numbers.add("homebody_destination_up", "gauge", up, of(|one| u64::from(!one.is_away)));
    numbers.text
}
