//! The members of a cohort: their names and seeds, and the layout of their files.

use crate::cohort::list::{AskedMembers, ListedMember};
use crate::error::SimulationError;
use crate::profiles::{self, Profile};
use homebody_core::scenario::load::Scenario;
use homebody_core::scenario::scheme::{Scheme, Stands};
use homebody_core::time::Span;
use homebody_log::run::places::{RECORDING, is_all_there};
use homebody_log::table::truth::TruthKept;
use homebody_log::{RunPlaces, Url};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

/// Bytes of a file that are read together (our choice).
const PART_BYTES: usize = 1 << 16;

/// The members of a cohort: a number of them, or those of a list.
#[derive(Clone, Debug)]
pub(crate) enum Members {
    Many(u32),
    Listed(Vec<Profile>),
}

/// A member of a cohort.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Member {
    /// The name in the list, or a number from 1 on, such as `0001`.
    pub name: String,
    /// The seed of its run.
    pub seed: u64,
    /// The cells of the member in the list, by column.
    pub row: Option<BTreeMap<String, String>>,
}

/// The result of one member.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MemberSummary {
    /// As the list has it.
    pub listed: ListedMember,
    /// The simulated time.
    pub length: Span,
    /// True of a member that ended early, as the cohort was cancelled.
    pub is_early: bool,
}

homebody_core::messages! {
    /// Problems with the place of a cohort.
    #[derive(Clone, PartialEq, Eq)]
    pub enum CohortMessage in "cohort" {
        /// A server stores each run by its own identifier. It has no folder for the members of a cohort.
        Server { place: String } error "server" ("a server cannot store a cohort: {place}")
            hint ("name a folder for all members, such as parquet:cohort");
        /// The logs of all members in one stream would be one log.
        Output { place: String } error "standard-output" ("cannot write a cohort to standard output: {place}")
            hint ("name a folder for all members, such as parquet:cohort");
        /// The part of the program that writes into object stores is the feature `cloud`.
        Store { place: String } error "object-store" ("this build of Homebody cannot write into object stores: {place}")
            hint ("build Homebody with --features cloud; or name a folder, such as parquet:cohort, and copy the folder");
    }
}

/// The layout of the members in the folder of a cohort.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CohortLayout {
    /// A folder for each member, as for a run.
    #[default]
    Folders,
    /// A data set of all logs that is partitioned by member, `log/member=0001/log.parquet`, and another of all truths, in this form.
    Set(Scheme),
}

impl CohortLayout {
    /// That of a place for all members together, such as `parquet:FOLDER`.
    ///
    /// # Errors
    ///
    /// If it is a server, standard output, or an object store that this program was built without.
    pub fn at(place: &Url) -> Result<CohortLayout, CohortMessage> {
        let place_text = || place.to_string();
        match () {
            () if place.scheme().row().stands == Stands::Server => Err(CohortMessage::Server { place: place_text() }),
            () if place.is_output() => Err(CohortMessage::Output { place: place_text() }),
            () if place.is_in_store() && !cfg!(feature = "cloud") => Err(CohortMessage::Store { place: place_text() }),
            () => Ok(CohortLayout::Set(place.scheme())),
        }
    }

    pub(crate) fn form(self) -> Option<String> {
        match self {
            CohortLayout::Folders => None,
            CohortLayout::Set(form) => Some(form.row().name.to_owned()),
        }
    }

    /// By the name of its form; None where there is no such form.
    pub(crate) fn named(form: Option<&str>) -> Option<CohortLayout> {
        let Some(form) = form else { return Some(CohortLayout::Folders) };
        let place: Url = format!("{form}:cohort").parse().ok()?;
        CohortLayout::at(&place).ok()
    }

    pub(crate) fn recording(self, cohort: &Path, member: &str) -> PathBuf {
        match self {
            CohortLayout::Folders => cohort.join(member).join(RECORDING),
            CohortLayout::Set(_) => cohort.join("members").join(member).join(RECORDING),
        }
    }

    pub(crate) fn is_all_there(self, cohort: &Path, member: &str, scenario: &Scenario, kept: TruthKept) -> bool {
        match self {
            CohortLayout::Folders => is_all_there(&cohort.join(member), &scenario.logger),
            CohortLayout::Set(_) => self.files(cohort, member, kept).iter().all(|file| file.is_file()),
        }
    }

    /// The files of a member of a set, existing or not.
    pub(crate) fn files(self, cohort: &Path, member: &str, kept: TruthKept) -> Vec<PathBuf> {
        match self {
            CohortLayout::Folders => Vec::new(),
            CohortLayout::Set(form) => RunPlaces::of_set(cohort, member, form, kept).files(),
        }
    }

    /// The places of a member; the folders are created.
    pub(crate) fn places(
        self,
        cohort: &Path,
        member: &str,
        scenario: &Scenario,
        kept: TruthKept,
    ) -> Result<RunPlaces, SimulationError> {
        Ok(match self {
            CohortLayout::Folders => RunPlaces::member(cohort, member, scenario, kept)?,
            CohortLayout::Set(form) => RunPlaces::in_set(cohort, member, form, kept)?,
        })
    }

    /// A digest of all files of a member, each with its path in the cohort's folder; none where each has a folder of its own, with
    /// databases in it whose bytes say how they were written.
    pub(crate) fn digest(
        self,
        cohort: &Path,
        member: &str,
        kept: TruthKept,
    ) -> Result<Option<String>, SimulationError> {
        if self == CohortLayout::Folders {
            return Ok(None);
        }
        let mut files = self.files(cohort, member, kept);
        files.sort();
        let mut digest = Sha256::new();
        for path in files {
            let name = path.strip_prefix(cohort).unwrap_or(&path).to_string_lossy().into_owned();
            let mut file = File::open(&path).map_err(|error| SimulationError::io(&path, error))?;
            let length = file.metadata().map_err(|error| SimulationError::io(&path, error))?.len();
            digest.update(format!("{name}\0{length}\0"));
            let mut part = vec![0; PART_BYTES];
            loop {
                match file.read(&mut part).map_err(|error| SimulationError::io(&path, error))? {
                    0 => break,
                    read => digest.update(&part[..read]),
                }
            }
        }
        Ok(Some(digest.finalize().iter().map(|byte| format!("{byte:02x}")).collect()))
    }
}

impl Members {
    pub fn count(&self) -> usize {
        match self {
            Members::Many(count) => *count as usize,
            Members::Listed(profiles) => profiles.len(),
        }
    }

    /// The first of them, at most so many.
    pub fn first(&self, most: usize) -> Members {
        match self {
            Members::Many(count) => Members::Many((*count).min(most as u32)),
            Members::Listed(profiles) => Members::Listed(profiles[..profiles.len().min(most)].to_vec()),
        }
    }

    pub fn asked(&self) -> AskedMembers {
        match self {
            Members::Many(count) => AskedMembers::Residents(*count),
            Members::Listed(profiles) => AskedMembers::Profiles(profiles::table(profiles)),
        }
    }

    /// The name, the seed and the row of a member. They do not depend on the other members.
    pub fn member(&self, seed: u64, index: usize) -> Member {
        match self {
            Members::Many(count) => {
                let (number, width) = (index as u32 + 1, count.to_string().len().max(4));
                let seed = seed_of_member(seed, number);
                Member { name: format!("{number:0width$}"), seed, row: None }
            }
            Members::Listed(profiles) => {
                let Profile { name, seed: own, row, .. } = &profiles[index];
                let seed = own.unwrap_or_else(|| seed_of(seed, "profile/", name.as_bytes()));
                Member { name: name.clone(), seed, row: Some(row.clone()) }
            }
        }
    }
}

/// The seed of a member without a profile, by number from 1 on.
pub fn seed_of_member(seed: u64, number: u32) -> u64 {
    seed_of(seed, "member/", &number.to_le_bytes())
}

/// A seed for each member, which every JSON reader keeps exactly.
fn seed_of(seed: u64, kind: &str, member: &[u8]) -> u64 {
    let hash = Sha256::new().chain_update(seed.to_le_bytes()).chain_update(kind).chain_update(member).finalize();
    let bytes: [u8; 8] = std::array::from_fn(|index| hash[index]);
    u64::from_le_bytes(bytes) >> 11
}
