//! The metrics of a run in the text format of Prometheus, with `--metrics`.

use crate::failure::Failure;
use crate::print::{tell, warn};
use crate::prometheus::{LastReport, PrometheusText, fleet_numbers, label};
use homebody_core::time::UtcTime;
use homebody_log::policy::MetricsReading;
use homebody_simulation::{RunMetrics, RunReading};
use homebody_web::serve_metrics;
use jiff::Timestamp;
use std::net::{Ipv4Addr, SocketAddr};
use std::sync::PoisonError;

homebody_core::messages! {
    /// Remarks on the metrics of a run.
    pub enum MetricsMessage in "metrics" {
        /// Metrics have the name of the scenario and the destinations of the run. Any program on any machine that can connect to the
        /// address reads them, without a password.
        Exposed { address: String } warning "exposed" ("anyone who reaches {address} can read the run's metrics")
            hint ("pass --metrics a port without an IP address to serve this machine only");
    }
}

/// The option for metrics.
#[derive(clap::Args)]
pub struct MetricsArguments {
    /// Serve metrics for Prometheus (rows, lag, retries, spooled bytes) at this port of 127.0.0.1, or at IP:PORT
    #[arg(long, value_name = "PORT", help_heading = "Output", value_parser = address)]
    metrics: Option<SocketAddr>,
}

fn address(text: &str) -> Result<SocketAddr, String> {
    let port = text.parse::<u16>().map(|port| (Ipv4Addr::LOCALHOST, port).into());
    port.or_else(|_| text.parse()).map_err(|_| "write a port, such as 9464, or IP:PORT".into())
}

impl MetricsArguments {
    pub fn is_given(&self) -> bool {
        self.metrics.is_some()
    }

    /// Begins to serve the metrics of a run, if the command asks for them. Reports each unavailable destination, unless the command is
    /// quiet.
    pub fn begin(&self, scenario: &str, is_quiet: bool) -> Result<RunMetrics, Failure> {
        let meters = if is_quiet { RunMetrics::default() } else { RunMetrics::telling(|news| tell(news)) };
        let (seen, name) = (meters.clone(), scenario.to_owned());
        self.serve(move || text(&name, &seen.read(), Timestamp::now()))?;
        Ok(meters)
    }

    /// The same for a fleet: serves its last report.
    pub fn begin_fleet(&self, scenarios: &str) -> Result<LastReport, Failure> {
        let look = LastReport::default();
        let (seen, name) = (look.clone(), scenarios.to_owned());
        self.serve(move || fleet_numbers(&name, &seen.lock().unwrap_or_else(PoisonError::into_inner)))?;
        Ok(look)
    }

    fn serve(&self, look: impl Fn() -> String + Clone + Send + Sync + 'static) -> Result<(), Failure> {
        let Some(address) = self.metrics else { return Ok(()) };
        if !address.ip().is_loopback() {
            warn(MetricsMessage::Exposed { address: address.to_string() });
        }
        let bound = serve_metrics(address, look)?;
        tell(format_args!("metrics    http://{bound}/metrics"));
        Ok(())
    }
}

/// A family of numbers: its name, its type, its help and the number of each destination.
type Family = (&'static str, &'static str, &'static str, fn(&MetricsReading) -> u64);

const OF_DESTINATIONS: [Family; 5] = [
    ("homebody_rows_total", "counter", "Rows that a destination has accepted, or that are spooled for it.", |r| r.rows),
    ("homebody_rows_durable_total", "counter", "Rows that a destination has confirmed.", |r| r.durable),
    ("homebody_retries_total", "counter", "Repeated calls to a destination.", |r| r.retries),
    ("homebody_spool_bytes", "gauge", "Bytes of rows that are spooled for a destination.", |r| r.spooled_bytes),
    ("homebody_destination_up", "gauge", "1 if a destination is reachable, else 0.", |r| u64::from(!r.is_away)),
];

fn text(scenario: &str, seen: &RunReading, now: Timestamp) -> String {
    let behind = seen.now.map(|at| (UtcTime::from(now) - UtcTime::from(at)).seconds());
    let mut numbers = PrometheusText::new(scenario);
    let help = "Simulated time of the run.";
    numbers.add("homebody_simulated_seconds_total", "counter", help, [(String::new(), seen.done.seconds())]);
    if let Some(behind) = behind {
        let help = "Lag of the run behind real time; negative if it is ahead.";
        numbers.add("homebody_lag_seconds", "gauge", help, [(String::new(), behind)]);
    }
    for (name, kind, help, value) in OF_DESTINATIONS {
        let of = seen.destinations.iter().map(|(place, reading)| (label("destination", place), value(reading)));
        numbers.add(name, kind, help, of);
    }
    numbers.text
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_core::time::{RunTime, SECOND};

    #[test]
    fn writes_the_text_format_of_prometheus() {
        let reading = MetricsReading {
            rows: 12,
            durable: 10,
            retries: 1,
            spooled_bytes: 99,
            is_away: true,
            last: RunTime::START,
        };
        let now = Timestamp::from_second(1000).unwrap();
        let seen = RunReading {
            now: Timestamp::from_second(998).ok(),
            done: 3 * SECOND / 2,
            destinations: vec![("csv:\"a\".csv".into(), reading)],
        };
        let text = text("studio", &seen, now);
        for line in [
            "# TYPE homebody_lag_seconds gauge",
            "homebody_lag_seconds{scenario=\"studio\"} 2",
            "homebody_simulated_seconds_total{scenario=\"studio\"} 1.5",
            "homebody_rows_total{scenario=\"studio\",destination=\"csv:\\\"a\\\".csv\"} 12",
            "homebody_spool_bytes{scenario=\"studio\",destination=\"csv:\\\"a\\\".csv\"} 99",
            "homebody_destination_up{scenario=\"studio\",destination=\"csv:\\\"a\\\".csv\"} 0",
        ] {
            assert!(text.lines().any(|told| told == line), "{line}\n{text}");
        }
    }
}
