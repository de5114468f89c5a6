//! Many lives of one scenario side by side, on all processors.

use super::live::{Live, Output, speed_in_words, stop_on_signal};
use crate::failure::Failure;
use crate::length::days_lived;
use crate::pace::{Asked, Pace};
use crate::places::Places;
use crate::print::{json_text, print_json, print_text};
use homebody_core::recording::Recording;
use homebody_core::run::Run;
use homebody_core::scenario::load::Scenario;
use homebody_core::time::Micros;
use homebody_log::fresh::FreshFile;
use homebody_routine::household::Household;
use indicatif::ProgressBar;
use rayon::prelude::*;
use serde_json::{Value, json};
use sha2::{Digest, Sha256};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// A cohort that is about to be lived.
pub struct Cohort<'a> {
    pub scenario: &'a Scenario,
    pub household: &'a Household,
    /// Of the scenario's own life; each member's has a seed of its own.
    pub recording: Recording,
    pub sources: Vec<PathBuf>,
    pub output: Output,
}

/// Threads for each processor (ours).
const THREADS_EACH: usize = 4;

/// What has become of one member.
struct Member {
    name: String,
    seed: u64,
    firings: u64,
    rows: u64,
    /// How far it was lived: less than asked for if it was stopped.
    lived: Micros,
}

impl Cohort<'_> {
    /// Lives all members, each in a folder of its own in a new one, with a list of them beside.
    pub fn live(self, members: u32) -> Result<(), Failure> {
        let folder = Places::cohort(self.scenario)?;
        let started = Instant::now();
        let stop = stop_on_signal();
        let household = self.household.one_of_many();
        let length = self.recording.length_us;
        let progress = self.output.progress(length.saturating_mul(Micros::from(members)));
        let width = members.to_string().len().max(4);
        // More threads than processors: who waits for the disk lets others go on.
        let threads = std::thread::available_parallelism().map_or(1, usize::from) * THREADS_EACH;
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let pool = pool.map_err(|error| Failure::io(&folder, format!("there are no threads: {error}")))?;
        let all = || {
            (1..=members)
                .into_par_iter()
                .map(|number| {
                    if stop.load(Ordering::Relaxed) {
                        return Ok(None);
                    }
                    let name = format!("{number:0width$}");
                    self.member(&folder, number, name, &household, &stop, &progress).map(Some)
                })
                .collect()
        };
        let lived: Result<Vec<Option<Member>>, Failure> = pool.install(all);
        progress.finish_and_clear();
        let lived: Vec<Member> = lived?.into_iter().flatten().collect();
        let list = folder.join("cohort.json");
        let mut file = FreshFile::create(&list, false)?;
        file.write(json_text(&self.list(&lived))?.as_bytes())?;
        file.finish()?;
        self.report(&folder, members, &lived, started)
    }

    fn member(
        &self,
        folder: &Path,
        number: u32,
        name: String,
        household: &Household,
        stop: &Arc<AtomicBool>,
        progress: &ProgressBar,
    ) -> Result<Member, Failure> {
        let seed = seed_of(self.recording.seed, number);
        let places = Places::member(folder, &name, self.scenario)?;
        let recording = Recording { seed, one_of_many: true, ..self.recording.clone() };
        let mut run = Run::new(self.scenario, household, seed, recording.length_us);
        let output = Output { out: Vec::new(), truth: None, force: false, quiet: true, json: false };
        let live = Live { scenario: self.scenario, recording, record: None, output, sources: self.sources.clone() };
        let pace = Pace::new(&Asked::unpaced(), stop.clone());
        let lived = live.live_into(&places, &mut run, pace, progress)?;
        Ok(Member { name, seed, firings: lived.recording.firings, rows: lived.stored.rows, lived: run.now() })
    }

    fn list(&self, lived: &[Member]) -> Value {
        let member = |member: &Member| {
            json!({ "name": member.name, "seed": member.seed, "firings": member.firings, "rows": member.rows,
                "days": days_lived(&self.scenario.calendar, member.lived) })
        };
        json!({
            "scenario": self.scenario.file.name,
            "seed": self.recording.seed,
            "days": days_lived(&self.scenario.calendar, self.recording.length_us),
            "members": lived.iter().map(member).collect::<Vec<_>>(),
        })
    }

    fn report(&self, folder: &Path, members: u32, lived: &[Member], started: Instant) -> Result<(), Failure> {
        let took = started.elapsed();
        let rows: u64 = lived.iter().map(|member| member.rows).sum();
        if self.output.json {
            let mut list = self.list(lived);
            list["took_s"] = json!(took.as_secs_f64());
            list["folder"] = json!(folder.display().to_string());
            return print_json(&list);
        }
        if self.output.quiet {
            return Ok(());
        }
        let all = lived.iter().map(|member| member.lived).sum();
        let (name, count) = (&self.scenario.file.name, lived.len());
        let stopped = if count < members as usize { format!(" of {members}, stopped") } else { String::new() };
        print_text(&format!(
            "{name}: {count} lives{stopped} in {:.1} s, {} \n\nrows       {rows} in all\nfolder     {}\nmembers    {}\n",
            took.as_secs_f64(),
            speed_in_words(all, took),
            folder.display(),
            folder.join("cohort.json").display(),
        ))
    }
}

/// A seed for each member, whoever else is one; at most what every JSON reader keeps exactly.
fn seed_of(seed: u64, member: u32) -> u64 {
    let hash = Sha256::new()
        .chain_update(seed.to_le_bytes())
        .chain_update("member/")
        .chain_update(member.to_le_bytes())
        .finalize();
    let bytes: [u8; 8] = std::array::from_fn(|index| hash[index]);
    u64::from_le_bytes(bytes) >> 11
}
