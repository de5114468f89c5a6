//! Numbers in the text format of Prometheus.

use std::fmt::{Display, Write};

/// Some of them.
pub struct Numbers {
    pub text: String,
    scenario: String,
}

impl Numbers {
    /// None yet, of what this scenario is called.
    pub fn of(scenario: &str) -> Numbers {
        Numbers { text: String::new(), scenario: escaped(scenario) }
    }

    /// Adds a family of numbers: each with its further [labels](label).
    pub fn add<N: Display>(
        &mut self,
        name: &str,
        kind: &str,
        help: &str,
        values: impl IntoIterator<Item = (String, N)>,
    ) {
        let Numbers { text, scenario } = self;
        // A string takes whatever is written to it.
        let _ = writeln!(text, "# HELP {name} {help}\n# TYPE {name} {kind}");
        for (labels, value) in values {
            let _ = writeln!(text, "{name}{{scenario=\"{scenario}\"{labels}}} {value}");
        }
    }
}

/// A label of a number.
pub fn label(name: &str, value: &str) -> String {
    format!(",{name}=\"{}\"", escaped(value))
}

/// A label's value, as the format wants it.
fn escaped(text: &str) -> String {
    text.replace('\\', "\\\\").replace('"', "\\\"").replace('\n', "\\n")
}
