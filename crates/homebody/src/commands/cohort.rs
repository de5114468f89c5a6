//! Many lives of one scenario side by side, on all processors.

use super::live::{Live, Output, speed_in_words, stop_on_signal};
use crate::failure::Failure;
use crate::pace::{Asked, Pace};
use crate::print::{json_text, print_json, print_text};
use crate::profiles::{Base, Profile};
use homebody_core::recording::Recording;
use homebody_core::run::Run;
use homebody_core::scenario::load::Scenario;
use homebody_core::time::Micros;
use homebody_log::Places;
use homebody_log::fresh::FreshFile;
use homebody_routine::household::Household;
use indicatif::ProgressBar;
use rayon::prelude::*;
use serde_json::{Value, json};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// A cohort that is about to be lived.
pub struct Cohort<'a> {
    pub base: Base<'a>,
    /// Of the scenario's own life; each member's has a seed of its own.
    pub recording: Recording,
    pub sources: Vec<PathBuf>,
    pub output: Output,
}

/// The file beside the members' folders that lists them.
pub const LIST: &str = "cohort.json";

/// Threads for each processor (ours).
const THREADS_EACH: usize = 4;

/// Who is to live: so many of whom nothing else is known, or those of a list.
pub enum Members {
    Many(u32),
    Listed(Vec<Profile>),
}

/// What has become of one member.
struct Member {
    name: String,
    seed: u64,
    /// What was said of the member alone, by column.
    row: Option<BTreeMap<String, String>>,
    firings: u64,
    rows: u64,
    /// How far it was lived: less than asked for if it was stopped.
    lived: Micros,
}

impl Cohort<'_> {
    /// Lives all members, each in a folder of its own in a new one, with a list of them beside.
    pub fn live(self, members: &Members) -> Result<(), Failure> {
        let folder = Places::cohort(self.base.scenario)?;
        let started = Instant::now();
        let stop = stop_on_signal();
        let household = self.base.household.one_of_many();
        let (length, count) = (self.recording.length_us, members.count());
        let progress = self.output.progress(length.saturating_mul(count as Micros));
        // More threads than processors: who waits for the disk lets others go on.
        let threads = std::thread::available_parallelism().map_or(1, usize::from) * THREADS_EACH;
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let pool = pool.map_err(|error| Failure::io(&folder, format!("there are no threads: {error}")))?;
        let all = || {
            (0..count)
                .into_par_iter()
                .map(|index| {
                    if stop.load(Ordering::Relaxed) {
                        return Ok(None);
                    }
                    self.member(&folder, members, index, &household, &stop, &progress).map(Some)
                })
                .collect()
        };
        let lived: Result<Vec<Option<Member>>, Failure> = pool.install(all);
        progress.finish_and_clear();
        let lived: Vec<Member> = lived?.into_iter().flatten().collect();
        let list = folder.join(LIST);
        let mut file = FreshFile::create(&list, false)?;
        file.write(json_text(&self.list(&lived))?.as_bytes())?;
        file.finish()?;
        self.report(&folder, count, &lived, started)
    }

    fn member(
        &self,
        folder: &Path,
        members: &Members,
        index: usize,
        household: &Household,
        stop: &Arc<AtomicBool>,
        progress: &ProgressBar,
    ) -> Result<Member, Failure> {
        let (name, seed, row) = members.who(self.recording.seed, index);
        let home = Some(name.clone());
        let recording = Recording { seed, one_of_many: true, home, ..self.recording.clone() };
        match members {
            Members::Many(_) => self.lived(folder, name, row, self.base.scenario, household, recording, stop, progress),
            Members::Listed(profiles) => {
                let (scenario, household) = self.base.lived(&profiles[index])?;
                let (files, without) = (scenario.sources.clone(), profiles[index].without.clone());
                let recording = Recording { files, without, ..recording };
                self.lived(folder, name, row, &scenario, &household, recording, stop, progress)
            }
        }
    }

    #[expect(clippy::too_many_arguments, reason = "they are all that a member's life depends on, and where it goes")]
    fn lived(
        &self,
        folder: &Path,
        name: String,
        row: Option<BTreeMap<String, String>>,
        scenario: &Scenario,
        household: &Household,
        recording: Recording,
        stop: &Arc<AtomicBool>,
        progress: &ProgressBar,
    ) -> Result<Member, Failure> {
        let seed = recording.seed;
        let places = Places::member(folder, &name, scenario)?;
        let mut run = Run::new(scenario, household, seed, recording.length_us);
        let output = Output { out: Vec::new(), truth: None, force: false, quiet: true, json: false };
        let live = Live { scenario, recording, record: None, output, sources: self.sources.clone() };
        let pace = Pace::new(&Asked::unpaced(), stop.clone());
        let lived = live.live_into(&places, &mut run, pace, progress)?;
        Ok(Member { name, seed, row, firings: lived.recording.firings, rows: lived.stored.rows, lived: run.now() })
    }

    fn list(&self, lived: &[Member]) -> Value {
        let calendar = &self.base.scenario.calendar;
        let member = |member: &Member| {
            let mut told = json!({ "name": member.name, "seed": member.seed, "firings": member.firings,
                "rows": member.rows, "days": calendar.days_lived(member.lived) });
            if let Some(row) = &member.row {
                told["profile"] = json!(row);
            }
            told
        };
        json!({
            "scenario": self.base.scenario.file.name,
            "seed": self.recording.seed,
            "days": calendar.days_lived(self.recording.length_us),
            "members": lived.iter().map(member).collect::<Vec<_>>(),
        })
    }

    fn report(&self, folder: &Path, members: usize, lived: &[Member], started: Instant) -> Result<(), Failure> {
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
        let (name, count) = (&self.base.scenario.file.name, lived.len());
        let stopped = if count < members { format!(" of {members}, stopped") } else { String::new() };
        print_text(&format!(
            "{name}: {count} lives{stopped} in {:.1} s, {} \n\nrows       {rows} in all\nfolder     {}\nmembers    {}\n",
            took.as_secs_f64(),
            speed_in_words(all, took),
            folder.display(),
            folder.join(LIST).display(),
        ))
    }
}

impl Members {
    fn count(&self) -> usize {
        match self {
            Members::Many(count) => *count as usize,
            Members::Listed(profiles) => profiles.len(),
        }
    }

    /// The name and the seed of a member, and what is said of them in the list. Neither depends on who else is one.
    fn who(&self, seed: u64, index: usize) -> (String, u64, Option<BTreeMap<String, String>>) {
        match self {
            Members::Many(count) => {
                let (number, width) = (index as u32 + 1, count.to_string().len().max(4));
                (format!("{number:0width$}"), seed_of(seed, "member/", &number.to_le_bytes()), None)
            }
            Members::Listed(profiles) => {
                let Profile { name, seed: own, row, .. } = &profiles[index];
                let own = own.unwrap_or_else(|| seed_of(seed, "profile/", name.as_bytes()));
                (name.clone(), own, Some(row.clone()))
            }
        }
    }
}

/// A seed for each member; at most what every JSON reader keeps exactly.
fn seed_of(seed: u64, kind: &str, member: &[u8]) -> u64 {
    let hash = Sha256::new().chain_update(seed.to_le_bytes()).chain_update(kind).chain_update(member).finalize();
    let bytes: [u8; 8] = std::array::from_fn(|index| hash[index]);
    u64::from_le_bytes(bytes) >> 11
}
