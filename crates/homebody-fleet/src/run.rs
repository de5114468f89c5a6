//! A fleet in real time: it advances the homes, delivers their messages, and reports.

use crate::error::FleetError;
use crate::homes::FleetSimulation;
use crate::report::{DestinationReport, FleetReport, late_ms, memory_mb, processor_s};
use crate::setup::FleetHomes;
use homebody_core::messages::Diagnose;
use homebody_core::problem::Problems;
use homebody_core::time::{Span, UtcTime};
use homebody_log::files::fresh::all_can_be_written;
use homebody_log::fleet::{
    Fleet, FleetEvent, FleetSink, Lateness, Now, Patience, Teller, fleet_sink as sink, has_rows_of_fleet,
};
use homebody_log::{Cancel, Url, WriteMode};
use jiff::Timestamp;
use std::sync::Arc;
use std::thread;
use std::time::Duration;

/// Number of rows that may wait for a destination, 40 bytes each (our choice). Beyond it, no more are produced.
const MOST_WAITING: usize = 200_000;

/// Number of rows that are handed over together (our choice).
const HANDFUL: usize = 10_000;

/// Shortest sleep, so that messages of a moment are sent together, and longest sleep (our choice).
const SHORTEST_SLEEP: Span = Span::from_millis(2);
const LONGEST_SLEEP: Span = Span::from_millis(50);

/// Longest simulation of homes without a check for rows that are due (our choice).
const LOOK: Span = Span::from_millis(2);

/// The destinations of a fleet, and its duration.
pub struct FleetRun {
    /// Each destination with the treatment of its present rows.
    sinks: Vec<(String, Box<dyn FleetSink>, WriteMode)>,
    /// The patience with an unavailable destination. Its handle ends the fleet.
    pub patience: Patience,
    pub lasts: Option<Duration>,
    pub every: Duration,
}

#[derive(Clone, Debug)]
pub enum FleetStatus<'r> {
    /// It simulates the time before now, and its homes connect.
    CatchesUp {
        /// The lag behind real time, in seconds.
        behind_s: f64,
        /// The number of messages on their way.
        waiting: usize,
    },
    Begun,
    Report(&'r FleetReport),
}

impl FleetRun {
    /// A fleet with these destinations. `is_fast` is true of a fleet that is faster than real time, and `how` decides the treatment of
    /// rows that a destination already has. It writes nothing yet.
    ///
    /// # Errors
    ///
    /// [`FleetError::Setup`] with all destinations that a fleet cannot use; [`FleetError::Simulation`] if a file cannot be written.
    pub fn new(out: &[Url], is_fast: bool, how: impl Fn(&Url) -> WriteMode) -> Result<FleetRun, FleetError> {
        let (mut sinks, mut wrong) = (Vec::new(), Vec::new());
        for url in out {
            match sink(url).and_then(|sink| sink.check(is_fast).map(|()| sink)) {
                Ok(sink) => sinks.push((url.to_string(), sink, how(url))),
                Err(error) => wrong.push(error.diagnostic()),
            }
        }
        if !wrong.is_empty() {
            return Err(FleetError::Setup(Problems(wrong)));
        }
        for (url, (.., how)) in out.iter().zip(&sinks) {
            let new = url.file().filter(|path| !has_rows_of_fleet(path));
            all_can_be_written(&Vec::from_iter(new), *how == WriteMode::Overwrite)?;
        }
        Ok(FleetRun { sinks, patience: Patience::default(), lasts: None, every: Duration::from_secs(5) })
    }
}

impl FleetHomes {
    /// Simulates all homes until the time is over or it is cancelled; `status` gets the status. Returns the report on the whole time.
    ///
    /// # Errors
    ///
    /// [`FleetError::Simulation`] if a destination cannot be opened, or fails for too long.
    pub fn run(self, run: FleetRun, status: impl FnMut(FleetStatus)) -> Result<FleetReport, FleetError> {
        self.simulate(run, status).map_err(|error| match error {
            FleetError::Simulation(error) => FleetError::Simulation(error.resumable_in(None)),
            error => error,
        })
    }

    fn simulate(self, run: FleetRun, mut status: impl FnMut(FleetStatus)) -> Result<FleetReport, FleetError> {
        let now: Now = Arc::new(|| Timestamp::now().into());
        let FleetRun { sinks, patience, lasts, every } = run;
        let cancel = patience.cancel.clone();
        let fleet = self.fleet.clone();
        let open = |(place, sink, how)| Teller::begin(place, sink, (&fleet, how), &patience, &now);
        let tellers = sinks.into_iter().map(open).collect::<Result<Vec<Teller>, _>>()?;
        let is_on_wall = self.speed.is_none();
        let created = now();
        let mut running =
            RunningFleet { homes: FleetSimulation::new(self, created), tellers, due: Vec::new(), now, fleet };
        let first = running.homes.first_messages();
        running.tellers.iter().for_each(|teller| teller.tell(&first));
        // A fleet with a speed of its own waits at its start until all homes are ready.
        let clock = |running: &RunningFleet| if is_on_wall { (running.now)() } else { created };
        while !cancel.is_cancelled() && (!running.homes.is_ready(clock(&running)) || running.waiting() > 0) {
            let now = clock(&running);
            running.turn(now, &cancel, is_on_wall)?;
            if running.homes.is_ready(now) {
                thread::sleep(SHORTEST_SLEEP.to_duration());
            }
            let behind = (now - running.homes.simulated_to()).max(Span::ZERO);
            status(FleetStatus::CatchesUp { behind_s: behind.seconds(), waiting: running.waiting() });
        }
        let started = (running.now)();
        running.homes.start_delivery(started);
        running.tellers.iter().for_each(|teller| teller.count_from(started));
        status(FleetStatus::Begun);
        let mut counts = ReportCounts::new(&running, started);
        let end = lasts.map_or(UtcTime::MAX, |lasts| started.saturating_add(lasts.into()));
        let every = Span::from(every);
        let mut next_report = started + every;
        while !cancel.is_cancelled() && (running.now)() < end {
            running.turn((running.now)(), &cancel, true)?;
            if (running.now)() >= next_report {
                next_report += every;
                status(FleetStatus::Report(&counts.report(&mut running)));
            }
            running.rest(next_report.min(end));
        }
        let end = (running.now)();
        // An unavailable destination does not keep others from completion.
        let ended: Vec<_> = running.tellers.iter_mut().map(|teller| teller.finish(end)).collect();
        ended.into_iter().collect::<Result<(), _>>()?;
        Ok(counts.last(&mut running))
    }
}

struct RunningFleet {
    homes: FleetSimulation,
    tellers: Vec<Teller>,
    due: Vec<FleetEvent>,
    now: Now,
    fleet: Arc<Fleet>,
}

impl RunningFleet {
    /// The number of messages that wait for the slowest destination.
    fn waiting(&self) -> usize {
        self.tellers.iter().map(Teller::waiting).max().unwrap_or(0)
    }

    /// Delivers the messages that are due, if delivery has started, and advances homes for a moment.
    fn turn(&mut self, now: UtcTime, cancel: &Cancel, delivers: bool) -> Result<(), FleetError> {
        self.tellers.iter_mut().try_for_each(Teller::check)?;
        if self.waiting() > MOST_WAITING {
            thread::sleep(Duration::from_millis(1));
            return Ok(());
        }
        self.due.clear();
        if delivers {
            self.homes.due(now, HANDFUL, &mut self.due);
            self.tellers.iter().filter(|_| !self.due.is_empty()).for_each(|teller| teller.tell(&self.due));
        }
        let began = (self.now)();
        let until = self.homes.next_due().map_or(began + LOOK, |due| due.clamp(began, began + LOOK));
        let mut advances = true;
        while advances && !cancel.is_cancelled() {
            advances = self.homes.advance_one(now) && (self.now)() < until;
        }
        Ok(())
    }

    /// Sleeps until the next message or step, or until an instant.
    fn rest(&self, until: UtcTime) {
        let next = self.homes.next_due().unwrap_or(UtcTime::MAX).min(self.homes.next_step()).min(until);
        let now = (self.now)();
        if next > now {
            thread::sleep((next - now).clamp(SHORTEST_SLEEP, LONGEST_SLEEP).to_duration());
        }
    }
}

struct ReportCounts {
    started: UtcTime,
    reported: UtcTime,
    /// At the start, and at the last report.
    processor_s: [Option<f64>; 2],
    /// By destination, since the start.
    totals: Vec<(u64, Lateness)>,
}

impl ReportCounts {
    fn new(running: &RunningFleet, started: UtcTime) -> ReportCounts {
        // Messages of the time before delivery are not part of a report.
        running.tellers.iter().for_each(|teller| drop(teller.since()));
        let totals = vec![Default::default(); running.tellers.len()];
        ReportCounts { started, reported: started, processor_s: [processor_s(); 2], totals }
    }

    fn report(&mut self, running: &mut RunningFleet) -> FleetReport {
        let counts = self.take(running);
        let (now, processor_s) = ((running.now)(), processor_s());
        let report = self.make(running, (self.reported, now), &counts, (self.processor_s[1], processor_s));
        (self.reported, self.processor_s[1]) = (now, processor_s);
        report
    }

    fn last(&mut self, running: &mut RunningFleet) -> FleetReport {
        self.take(running);
        let now = (running.now)();
        let report = self.make(running, (self.started, now), &self.totals, (self.processor_s[0], processor_s()));
        FleetReport { is_last: true, ..report }
    }

    fn take(&mut self, running: &mut RunningFleet) -> Vec<(u64, Lateness)> {
        let since: Vec<_> = running.tellers.iter().map(Teller::since).collect();
        for ((rows, lateness), since) in self.totals.iter_mut().zip(&since) {
            *rows += since.rows;
            lateness.join(&since.lateness);
        }
        since.into_iter().map(|since| (since.rows, since.lateness)).collect()
    }

    fn make(
        &self,
        running: &RunningFleet,
        (from, now): (UtcTime, UtcTime),
        counts: &[(u64, Lateness)],
        processor_s: (Option<f64>, Option<f64>),
    ) -> FleetReport {
        let RunningFleet { homes, tellers, fleet, .. } = running;
        let (mut all, span_s) = (Lateness::default(), (now - from).seconds().max(1e-6));
        counts.iter().for_each(|(_, lateness)| all.join(lateness));
        let destination = |(teller, (messages, lateness)): (&Teller, &(u64, Lateness))| {
            let [late_median_ms, late_99_ms, late_most_ms] = late_ms(lateness);
            let meter = teller.meter().read();
            DestinationReport {
                place: teller.place().to_owned(),
                messages: *messages,
                late_median_ms,
                late_99_ms,
                late_most_ms,
                waiting: teller.waiting(),
                retries: meter.retries,
                is_away: meter.is_away,
            }
        };
        let destinations: Vec<DestinationReport> = tellers.iter().zip(counts).map(destination).collect();
        let messages: u64 = counts.iter().map(|(messages, _)| messages).sum();
        let [late_median_ms, late_99_ms, late_most_ms] = late_ms(&all);
        let oldest = tellers.iter().filter_map(Teller::oldest_due).chain(homes.next_due()).min();
        let (storms, is_away) = homes.outages(now);
        FleetReport {
            time: format!("{:.3}", now.timestamp()),
            running_s: (now - self.started).seconds(),
            span_s,
            is_last: false,
            homes: homes.there,
            homes_in_all: fleet.homes.len(),
            came: homes.came,
            went: homes.went,
            failed: homes.failed.len(),
            messages,
            messages_per_s: messages as f64 / span_s,
            timed: all.count(),
            late_median_ms,
            late_99_ms,
            late_most_ms,
            behind_s: oldest.map_or(0.0, |oldest| (now - oldest).max(Span::ZERO).seconds()),
            waiting: destinations.iter().map(|destination| destination.waiting).sum(),
            ahead_s: homes.simulated_to().saturating_since(now).seconds(),
            storms,
            is_away,
            retries: destinations.iter().map(|destination| destination.retries).sum(),
            memory_mb: memory_mb(),
            processors: processor_s.0.zip(processor_s.1).map(|(before, after)| (after - before) / span_s),
            destinations,
        }
    }
}
