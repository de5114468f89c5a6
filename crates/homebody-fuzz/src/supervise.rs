//! Doing the cases of a target in processes that may die or hang: what became of all of them.

use crate::case::{Done, End};
use crate::target::Target;
use crate::worker::{GREEDY, Said};
use std::io::{self, BufRead, BufReader};
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::thread;
use std::time::{Duration, Instant};

/// What a case may take in a build for users: longer, or more, is a failure.
pub const LONGEST: Duration = Duration::from_secs(1);
/// As [`LONGEST`], in bytes.
pub const MOST_BYTES: usize = 256 << 20;

/// How cases are done.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The program that does cases: this one.
    pub program: PathBuf,
    /// The seed of all cases.
    pub seed: u64,
    /// The number of the first.
    pub first: u64,
    /// How many there are at most.
    pub cases: u64,
    /// After this time no case is begun.
    pub until: Option<Duration>,
    /// How many processes do them side by side.
    pub workers: u64,
    /// A case that takes longer hangs, and is ended.
    pub hangs_after: Duration,
    /// Whether too long and too much count as failures: not in a build that is not optimised.
    pub is_measured: bool,
}

/// A case that failed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// The case's number.
    pub number: u64,
    /// What happened.
    pub what: String,
}

/// What became of the cases of a target.
#[derive(Clone, Debug, Default)]
pub struct Outcome {
    /// How many were done.
    pub cases: u64,
    /// Those that were read.
    pub accepted: u64,
    /// Those that were refused in words.
    pub refused: u64,
    /// The one that took longest, and its number.
    pub slowest: (Duration, u64),
    /// The most memory that one took, in bytes, and its number.
    pub largest: (usize, u64),
    /// Those that panicked, died, hung, broke an invariant, or took too much.
    pub findings: Vec<Finding>,
}

impl Outcome {
    fn add(&mut self, number: u64, done: Done, plan: &Plan) {
        self.cases += 1;
        self.slowest = self.slowest.max((done.took, number));
        self.largest = self.largest.max((done.peak_bytes, number));
        match done.end {
            End::Accepted => self.accepted += 1,
            End::Refused => self.refused += 1,
            End::Failed(what) => return self.findings.push(Finding { number, what }),
        }
        let (is_slow, is_large) = (done.took > LONGEST, done.peak_bytes > MOST_BYTES);
        if plan.is_measured && (is_slow || is_large) {
            let what = format!("{:.1} s, {} MiB", done.took.as_secs_f64(), done.peak_bytes >> 20);
            self.findings.push(Finding { number, what });
        }
    }

    fn merge(&mut self, other: Outcome) {
        self.cases += other.cases;
        self.accepted += other.accepted;
        self.refused += other.refused;
        self.slowest = self.slowest.max(other.slowest);
        self.largest = self.largest.max(other.largest);
        self.findings.extend(other.findings);
        self.findings.sort_by_key(|finding| finding.number);
    }
}

/// Does the cases of a target; `progress` is told of each that is done.
///
/// # Errors
///
/// The program could not be run.
pub fn supervise(target: &Target, plan: &Plan, progress: &(dyn Fn() + Sync)) -> io::Result<Outcome> {
    let begun = Instant::now();
    let shares = (0..plan.workers).map(|share| plan.first + share);
    thread::scope(|scope| {
        let workers: Vec<_> =
            shares.map(|first| scope.spawn(move || share(target, plan, first, begun, progress))).collect();
        let mut outcome = Outcome::default();
        for worker in workers {
            outcome.merge(worker.join().unwrap_or_else(|_| Err(io::Error::other("a watcher panicked")))?);
        }
        Ok(outcome)
    })
}

/// Does every so many cases from the first on, each worker as long as it lives.
fn share(
    target: &Target,
    plan: &Plan,
    first: u64,
    begun: Instant,
    progress: &(dyn Fn() + Sync),
) -> io::Result<Outcome> {
    let mut outcome = Outcome::default();
    let (mut next, end) = (first, plan.first.saturating_add(plan.cases));
    let is_over = || plan.until.is_some_and(|until| begun.elapsed() >= until);
    while next < end && !is_over() {
        let mut worker = Worker::start(target, plan, next, end)?;
        let mut under_way = None;
        loop {
            match worker.said.recv_timeout(plan.hangs_after) {
                Ok(Said::Begun(number)) => under_way = Some(number),
                Ok(Said::Done(number, done)) => {
                    outcome.add(number, done, plan);
                    progress();
                    (under_way, next) = (None, number + plan.workers);
                    if is_over() {
                        break;
                    }
                }
                Err(why) => {
                    let what = worker.lost(why, plan.hangs_after);
                    match (under_way, what) {
                        (Some(number), what) => {
                            let end = End::Failed(what);
                            outcome.add(number, Done { end, took: Duration::ZERO, peak_bytes: 0 }, plan);
                            progress();
                            next = number + plan.workers;
                        }
                        // All is done, or it never began.
                        (None, _) if next >= end => {}
                        (None, what) => {
                            return Err(io::Error::other(format!("{}: between cases: {what}", target.name)));
                        }
                    }
                    break;
                }
            }
        }
    }
    Ok(outcome)
}

/// A process that does cases.
struct Worker {
    child: Child,
    said: Receiver<Said>,
}

impl Worker {
    fn start(target: &Target, plan: &Plan, first: u64, end: u64) -> io::Result<Worker> {
        let numbers = [("--seed", plan.seed), ("--first", first), ("--step", plan.workers), ("--end", end)];
        let words = numbers.iter().flat_map(|(name, number)| [(*name).to_owned(), number.to_string()]);
        let mut command = Command::new(&plan.program);
        command.arg("work").arg("--target").arg(target.name).args(words);
        command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::null());
        let mut child = command.spawn()?;
        let out = child.stdout.take().ok_or_else(|| io::Error::other("a process without output"))?;
        let (tell, said) = channel();
        thread::spawn(move || {
            for line in BufReader::new(out).lines().map_while(Result::ok) {
                if let Some(said) = Said::of(&line)
                    && tell.send(said).is_err()
                {
                    return;
                }
            }
        });
        Ok(Worker { child, said })
    }

    /// Why nothing more is said; the process is ended.
    fn lost(&mut self, why: RecvTimeoutError, hangs_after: Duration) -> String {
        if why == RecvTimeoutError::Timeout {
            return format!("hangs: not over after {} s", hangs_after.as_secs());
        }
        match self.child.wait() {
            Ok(status) if status.code() == Some(GREEDY) => "takes more than 1 GiB".into(),
            Ok(status) => format!("died: {status}"),
            Err(error) => format!("died: {error}"),
        }
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        // One that is over already cannot be ended, and that is well.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
