//! A recording: the scenario with its live input, the seed, the length, and digests that show whether a replay is the
//! same. A run depends on nothing else, so a recording is enough to replay it byte for byte.

use crate::event::{Firing, Value};
use crate::intervention::TimedIntervention;
use crate::problem::Problems;
use crate::run::{DriverProvider, Run};
use crate::scenario::load::Scenario;
pub use crate::time::LONGEST;
use crate::time::Span;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;

/// A run that can be replayed, unless a driver of the caller's own moved a resident.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Recording {
    /// The version of the program that made it, with what tells apart builds whose models differ.
    pub version: String,
    /// The name of the scenario's own file among `files`.
    pub entry: String,
    /// The text of every file of the scenario, by name.
    pub files: BTreeMap<String, String>,
    /// The number that all randomness of the run comes from.
    pub seed: u64,
    /// The length of the run.
    pub length_us: Span,
    /// Conditions that the routines show, but this run does not.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub without: Vec<String>,
    /// Whether the residents are one of many: not quite as their routines are written.
    #[serde(default, skip_serializing_if = "is_false")]
    pub one_of_many: bool,
    /// The names of the residents that a driver of the caller's own moved. No file contains this driver, so such a run
    /// cannot be replayed; its recording still gives the place, the names and the clock of its log.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub own_drivers: Vec<String>,
    /// Which home of several it is: the name of a member of a cohort.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub home: Option<String>,
    /// The id that the rows of the run have; None where it follows from the rest.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub run_id: Option<i64>,
    /// The intended length, if the run was stopped earlier.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stopped_of_us: Option<Span>,
    /// The interventions from outside, in order of time.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub outside: Vec<TimedIntervention>,
    /// The number of rows in each place of its log; `None` until the run is complete, and for rows that were not
    /// counted.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rows: Option<u64>,
    /// The number of its firings, and their SHA-256: empty until the run is complete.
    pub firings: u64,
    /// The SHA-256 of all firings, in hexadecimal digits: see [`RunDigest`].
    pub sha256: String,
}

fn is_false(value: &bool) -> bool {
    !value
}

impl Recording {
    /// The recording of a run of a scenario that has not begun; `entry` is the name of the scenario's own file. Unless
    /// set otherwise, it has all conditions of the scenario and belongs to no cohort.
    pub fn new(scenario: &Scenario, version: &str, entry: &str, seed: u64, length: Span) -> Recording {
        Recording {
            version: version.into(),
            entry: entry.into(),
            files: scenario.sources.clone(),
            seed,
            length_us: length,
            without: Vec::new(),
            one_of_many: false,
            own_drivers: Vec::new(),
            home: None,
            run_id: None,
            stopped_of_us: None,
            outside: Vec::new(),
            rows: None,
            firings: 0,
            sha256: String::new(),
        }
    }

    /// The same with its id settled: what is done at the keys later does not change it.
    pub fn begun(self) -> Recording {
        Recording { run_id: Some(self.run_id()), ..self }
    }

    /// Whether the run was completed, at its end or where it was stopped: a run that was killed is not.
    pub fn is_complete(&self) -> bool {
        !self.sha256.is_empty()
    }

    /// Whether the run can be replayed from it: no driver of the caller's own moved a resident.
    pub fn can_replay(&self) -> bool {
        self.own_drivers.is_empty()
    }

    /// Whether the run reached its end.
    pub fn is_whole(&self) -> bool {
        self.is_complete() && self.stopped_of_us.is_none()
    }

    /// The recording of the same run from its start to its intended end.
    pub fn restarted(&self) -> Recording {
        let length_us = self.stopped_of_us.unwrap_or(self.length_us);
        let (firings, sha256) = (0, String::new());
        Recording { length_us, stopped_of_us: None, rows: None, firings, sha256, ..self.clone() }
    }

    /// The id of the run: the same for the same texts, seed, conditions left out and home, whatever its length. It is a
    /// number from 1 to 2^47 - 1, so that it takes six bytes in a database and is exact in JSON.
    pub fn run_id(&self) -> i64 {
        self.run_id.unwrap_or_else(|| {
            let mut hash = Sha256::new();
            let mut add = |text: &str| {
                hash.update((text.len() as u64).to_le_bytes());
                hash.update(text);
            };
            add(&self.entry);
            self.files.iter().for_each(|(name, text)| [name, text].into_iter().for_each(|part| add(part)));
            self.without.iter().for_each(|condition| add(condition));
            add(self.home.as_deref().unwrap_or_default());
            add(&self.seed.to_string());
            add(if self.one_of_many { "one of many" } else { "" });
            let digest = hash.finalize();
            let bytes: [u8; 8] = std::array::from_fn(|index| digest[index]);
            ((u64::from_le_bytes(bytes) >> 17) as i64).max(1)
        })
    }

    /// The scenario that was recorded.
    pub fn scenario(&self) -> Result<Scenario, Problems> {
        Scenario::load(&self.files, &self.entry)
    }

    /// The recorded run from its start, with what was done to it from outside.
    pub fn run(&self, scenario: &Scenario, drivers_of: &dyn DriverProvider) -> Run {
        let mut run = Run::new(scenario, drivers_of, self.seed, self.length_us);
        run.intervene(self.outside.iter().cloned());
        run
    }
}

/// A sign of all firings of a run: the SHA-256 of their instants, sensors and values.
#[derive(Clone, Debug, Default)]
pub struct RunDigest {
    hash: Sha256,
    firings: u64,
}

impl RunDigest {
    /// Takes in further firings, in order of time.
    pub fn add(&mut self, firings: &[Firing]) {
        for firing in firings {
            self.hash.update(firing.at.micros().to_le_bytes());
            self.hash.update(firing.sensor.0.to_le_bytes());
            // Motion sensors have but one thing to say.
            if firing.value != Value::Fire {
                self.hash.update(firing.value.to_string());
            }
        }
        self.firings += firings.len() as u64;
    }

    /// The number of firings so far.
    pub fn firings(&self) -> u64 {
        self.firings
    }

    /// The sign as 64 hexadecimal digits.
    pub fn hex(&self) -> String {
        self.hash.clone().finalize().iter().map(|byte| format!("{byte:02x}")).collect()
    }
}
