//! A fleet on the clock: homes are lived, places are told, and it is said how that goes.

use super::homes::FleetOf;
use super::living::Living;
use super::report::{FleetReport, OfDestination, late_ms, memory_mb, processor_s};
use crate::error::Error;
use homebody_core::messages::Diagnose;
use homebody_core::problem::Problems;
use homebody_core::time::SECOND;
use homebody_log::fleet::{Fleet, FleetSink, Lateness, Now, Patience, Teller, Told, has_rows_of_fleet, sink};
use homebody_log::fresh::all_can_be_written;
use homebody_log::{Cancel, How, Url};
use jiff::Timestamp;
use std::sync::Arc;
use std::thread;
use std::time::Duration;

/// Number of rows that may wait for a destination, 40 bytes each (our choice). Beyond it, no more are produced.
const MOST_WAITING: usize = 200_000;

/// Number of rows that are handed over together (our choice).
const HANDFUL: usize = 10_000;

/// Shortest sleep, so that messages of a moment are sent together, and longest sleep (our choice).
const SHORTEST_SLEEP: i64 = 2_000;
const LONGEST_SLEEP: i64 = 50_000;

/// Longest simulation of homes without a check for rows that are due (our choice).
const LOOK: i64 = 2_000;

/// Where a fleet tells what it has to say, and how long.
pub struct FleetRun {
    /// Each place with what becomes of what is there already.
    sinks: Vec<(String, Box<dyn FleetSink>, How)>,
    /// How a place that is away is waited for. What ends that early ends the fleet.
    pub patience: Patience,
    /// How long it tells; None until it is cancelled.
    pub lasts: Option<Duration>,
    /// How often it reports.
    pub every: Duration,
}

/// What there is to say of a fleet on its way.
#[derive(Clone, Debug)]
pub enum FleetLived<'r> {
    /// It lives what was before now, and its homes say that they have come.
    CatchesUp {
        /// How far it is behind the clock, in seconds.
        behind_s: f64,
        /// How much is on its way to places.
        waiting: usize,
    },
    /// It has begun to tell what happens now.
    Begun,
    /// How it goes.
    Report(&'r FleetReport),
}

impl FleetRun {
    /// A fleet that tells these places; `is_fast` where it goes faster than life, and `how` says what becomes of what is at a place
    /// already. Nothing is touched yet.
    ///
    /// # Errors
    ///
    /// [`Error::Fleet`] with all places that a fleet cannot tell, and why; [`Error::Log`] if a file cannot be written.
    pub fn new(out: &[Url], is_fast: bool, how: impl Fn(&Url) -> How) -> Result<FleetRun, Error> {
        let (mut sinks, mut wrong) = (Vec::new(), Vec::new());
        for url in out {
            match sink(url).and_then(|sink| sink.check(is_fast).map(|()| sink)) {
                Ok(sink) => sinks.push((url.to_string(), sink, how(url))),
                Err(error) => wrong.push(error.diagnostic()),
            }
        }
        if !wrong.is_empty() {
            return Err(Error::Fleet(Problems(wrong)));
        }
        for (url, (.., how)) in out.iter().zip(&sinks) {
            let new = url.file().filter(|path| !has_rows_of_fleet(path));
            all_can_be_written(&Vec::from_iter(new), *how == How::Replace)?;
        }
        Ok(FleetRun { sinks, patience: Patience::default(), lasts: None, every: Duration::from_secs(5) })
    }
}

impl FleetOf {
    /// Lives all homes until the time is over or it is cancelled; `say` is told how that goes. Returns the report on the whole.
    ///
    /// # Errors
    ///
    /// [`Error::Log`] if a place cannot be begun, or fails and is not back in time.
    pub fn live(self, run: FleetRun, say: impl FnMut(FleetLived)) -> Result<FleetReport, Error> {
        self.lived(run, say).map_err(|error| error.of_run_in(None))
    }

    fn lived(self, run: FleetRun, mut say: impl FnMut(FleetLived)) -> Result<FleetReport, Error> {
        let now: Now = Arc::new(|| Timestamp::now().as_microsecond());
        let FleetRun { sinks, patience, lasts, every } = run;
        let cancel = patience.cancel.clone();
        let fleet = self.fleet.clone();
        let begin_one = |(place, sink, how)| Teller::begin(place, sink, (&fleet, how), &patience, &now);
        let tellers = sinks.into_iter().map(begin_one).collect::<Result<Vec<Teller>, _>>()?;
        let is_on_wall = self.speed.is_none();
        let created = now();
        let mut running = Running { living: Living::new(self, created), tellers, told: Vec::new(), now, fleet };
        let first = running.living.first();
        running.tellers.iter().for_each(|teller| teller.tell(&first));
        // A fleet that goes at a speed of its own waits at its beginning until all is ready.
        let clock = |running: &Running| if is_on_wall { (running.now)() } else { created };
        while !cancel.is_cancelled() && (!running.living.is_ready(clock(&running)) || running.waiting() > 0) {
            let now = clock(&running);
            running.turn(now, &cancel, is_on_wall)?;
            if running.living.is_ready(now) {
                thread::sleep(Duration::from_micros(SHORTEST_SLEEP as u64));
            }
            let behind = (now - running.living.lived()).max(0);
            say(FleetLived::CatchesUp { behind_s: behind as f64 / SECOND as f64, waiting: running.waiting() });
        }
        let begun = (running.now)();
        running.living.begin(begun);
        running.tellers.iter().for_each(|teller| teller.count_from(begun));
        say(FleetLived::Begun);
        let mut books = Books::new(&running, begun);
        let end = lasts.map_or(i64::MAX, |lasts| begun.saturating_add(micros(lasts)));
        let mut next_report = begun + micros(every);
        while !cancel.is_cancelled() && (running.now)() < end {
            running.turn((running.now)(), &cancel, true)?;
            if (running.now)() >= next_report {
                next_report += micros(every);
                say(FleetLived::Report(&books.report(&mut running)));
            }
            running.rest(next_report.min(end));
        }
        let end = (running.now)();
        // One that is away keeps no other from being completed.
        let ended: Vec<_> = running.tellers.iter_mut().map(|teller| teller.finish(end)).collect();
        ended.into_iter().collect::<Result<(), _>>()?;
        Ok(books.last(&mut running))
    }
}

fn micros(span: Duration) -> i64 {
    i64::try_from(span.as_micros()).unwrap_or(i64::MAX)
}

struct Running {
    living: Living,
    tellers: Vec<Teller>,
    told: Vec<Told>,
    now: Now,
    fleet: Arc<Fleet>,
}

impl Running {
    /// How much waits for places, most of all for the slowest.
    fn waiting(&self) -> usize {
        self.tellers.iter().map(Teller::waiting).max().unwrap_or(0)
    }

    /// Tells what is due, if it is time for that, and lives homes on for a moment.
    fn turn(&mut self, now: i64, cancel: &Cancel, tells: bool) -> Result<(), Error> {
        self.tellers.iter_mut().try_for_each(Teller::check)?;
        if self.waiting() > MOST_WAITING {
            thread::sleep(Duration::from_millis(1));
            return Ok(());
        }
        self.told.clear();
        if tells {
            self.living.due(now, HANDFUL, &mut self.told);
            self.tellers.iter().filter(|_| !self.told.is_empty()).for_each(|teller| teller.tell(&self.told));
        }
        let begun = (self.now)();
        let until = self.living.next_due().map_or(begun + LOOK, |due| due.clamp(begun, begun + LOOK));
        let mut lives = true;
        while lives && !cancel.is_cancelled() {
            lives = self.living.live_one(now) && (self.now)() < until;
        }
        Ok(())
    }

    /// Sleeps until there is something to do, or until then.
    fn rest(&self, until: i64) {
        let next = self.living.next_due().unwrap_or(i64::MAX).min(self.living.next_life()).min(until);
        let now = (self.now)();
        if next > now {
            let sleep = (next - now).clamp(SHORTEST_SLEEP, LONGEST_SLEEP);
            thread::sleep(Duration::from_micros(sleep as u64));
        }
    }
}

/// What reports are made from.
struct Books {
    begun: i64,
    reported: i64,
    /// At the beginning, and at the last report.
    processor_s: [Option<f64>; 2],
    /// By destination, since the beginning.
    of_all: Vec<(u64, Lateness)>,
}

impl Books {
    fn new(running: &Running, begun: i64) -> Books {
        // What it has caught up with is no part of a report.
        running.tellers.iter().for_each(|teller| drop(teller.since()));
        let of_all = vec![Default::default(); running.tellers.len()];
        Books { begun, reported: begun, processor_s: [processor_s(); 2], of_all }
    }

    /// The report since the last one.
    fn report(&mut self, running: &mut Running) -> FleetReport {
        let of_now = self.take(running);
        let (now, processor_s) = ((running.now)(), processor_s());
        let report = self.told(running, (self.reported, now), &of_now, (self.processor_s[1], processor_s));
        (self.reported, self.processor_s[1]) = (now, processor_s);
        report
    }

    /// The report on the whole.
    fn last(&mut self, running: &mut Running) -> FleetReport {
        self.take(running);
        let now = (running.now)();
        let report = self.told(running, (self.begun, now), &self.of_all, (self.processor_s[0], processor_s()));
        FleetReport { is_last: true, ..report }
    }

    fn take(&mut self, running: &mut Running) -> Vec<(u64, Lateness)> {
        let since: Vec<_> = running.tellers.iter().map(Teller::since).collect();
        for ((rows, lateness), since) in self.of_all.iter_mut().zip(&since) {
            *rows += since.rows;
            lateness.join(&since.lateness);
        }
        since.into_iter().map(|since| (since.rows, since.lateness)).collect()
    }

    fn told(
        &self,
        running: &Running,
        (from, now): (i64, i64),
        of: &[(u64, Lateness)],
        processor_s: (Option<f64>, Option<f64>),
    ) -> FleetReport {
        let Running { living, tellers, fleet, .. } = running;
        let in_s = |span: i64| span as f64 / SECOND as f64;
        let (mut all, span_s) = (Lateness::default(), in_s(now - from).max(1e-6));
        of.iter().for_each(|(_, lateness)| all.join(lateness));
        let destination = |(teller, (messages, lateness)): (&Teller, &(u64, Lateness))| {
            let [late_median_ms, late_99_ms, late_most_ms] = late_ms(lateness);
            let meter = teller.meter().read();
            OfDestination {
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
        let destinations: Vec<OfDestination> = tellers.iter().zip(of).map(destination).collect();
        let messages: u64 = of.iter().map(|(messages, _)| messages).sum();
        let [late_median_ms, late_99_ms, late_most_ms] = late_ms(&all);
        let oldest = tellers.iter().filter_map(Teller::oldest_due).chain(living.next_due()).min();
        let (storms, is_away) = living.storms(now);
        FleetReport {
            time: Timestamp::from_microsecond(now).map(|now| format!("{now:.3}")).unwrap_or_default(),
            running_s: in_s(now - self.begun),
            span_s,
            is_last: false,
            homes: living.there,
            homes_in_all: fleet.homes.len(),
            came: living.came,
            went: living.went,
            failed: living.failed.len(),
            messages,
            messages_per_s: messages as f64 / span_s,
            timed: all.count(),
            late_median_ms,
            late_99_ms,
            late_most_ms,
            behind_s: oldest.map_or(0.0, |oldest| in_s((now - oldest).max(0))),
            waiting: destinations.iter().map(|destination| destination.waiting).sum(),
            ahead_s: in_s(living.lived().saturating_sub(now)),
            storms,
            is_away,
            retries: destinations.iter().map(|destination| destination.retries).sum(),
            memory_mb: memory_mb(),
            processors: processor_s.0.zip(processor_s.1).map(|(before, after)| (after - before) / span_s),
            destinations,
        }
    }
}
