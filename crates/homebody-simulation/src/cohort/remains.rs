//! The present files of a cohort: the complete members, and checks that the files are theirs.

use crate::cohort::Cohort;
use crate::cohort::list::ListedMember;
use crate::cohort::members::{Member, MemberSummary, Members};
use crate::cohort::place::CohortPlace;
use crate::error::SimulationError;
use crate::recording_file;
use homebody_core::messages::Diagnose;
use homebody_core::recording::Recording;
use homebody_core::time::RunTime;
use rayon::prelude::*;
use std::path::Path;

impl Cohort {
    /// The results of the complete members, by member.
    pub(crate) fn found_in(&self, place: &CohortPlace) -> Result<Vec<Option<MemberSummary>>, SimulationError> {
        (0..self.count()).into_par_iter().map(|index| self.found(place, index)).collect()
    }

    /// The result of a member, if it is complete.
    pub(crate) fn found(&self, place: &CohortPlace, index: usize) -> Result<Option<MemberSummary>, SimulationError> {
        let member = self.members.member(self.recording.seed, index);
        let here = place.here()?;
        place.bring(&here, &[self.layout.recording(here.path(), &member.name)])?;
        let found = self.found_recording(place, here.path(), &member, index)?;
        let Some(recording) = found.filter(Recording::is_whole) else { return Ok(None) };
        place.bring(&here, &self.layout.files(here.path(), &member.name, self.kept))?;
        match self.layout.is_all_there(here.path(), &member.name, self.scenario.scenario(), self.kept) {
            true => self.ended(here.path(), &member, &recording).map(Some),
            false => Ok(None),
        }
    }

    /// The recording of a member, complete or not; [`SimulationError::Member`] if the folder has something else.
    fn found_recording(
        &self,
        place: &CohortPlace,
        here: &Path,
        member: &Member,
        index: usize,
    ) -> Result<Option<Recording>, SimulationError> {
        let path = self.layout.recording(here, &member.name);
        let folder = path.parent().unwrap_or(here);
        // Users know the files by the place of the cohort.
        let there = |path: &Path| place.path().join(path.strip_prefix(here).unwrap_or(path));
        let wrong = |why: String| SimulationError::Member { folder: there(folder), why };
        if folder.is_file() {
            let is_file = there(folder);
            return Err(wrong(format!("{} is a file, and a member's folder is to be there", is_file.display())));
        }
        match recording_file::recording(&path) {
            Err(SimulationError::NoRecording { .. }) => Ok(None),
            Err(error) => {
                let [local, known] = [here, place.path()].map(|path| path.display().to_string());
                Err(wrong(error.diagnostic().what.replace(&local, &known)))
            }
            Ok(found) if self.is_of(&found, member, index) => Ok(Some(found)),
            Ok(_) => Err(wrong(format!("{}: it is of another cohort", there(&path).display()))),
        }
    }

    /// Whether a recording is one of this member, by its texts alone.
    fn is_of(&self, found: &Recording, member: &Member, index: usize) -> bool {
        let mut expected = self.recording_of(member);
        if let Members::Listed(profiles) = &self.members {
            let profile = &profiles[index];
            let own = self.scenario.base().own_texts(profile);
            // Only loading shows which texts of the scenario a member does not use.
            let is_same = |(name, text): (&String, &String)| {
                own.get(name).or(expected.files.get(name)).is_none_or(|expected| expected == text)
            };
            if !own.keys().all(|name| found.files.contains_key(name)) || !found.files.iter().all(is_same) {
                return false;
            }
            expected.without.clone_from(&profile.without);
            if !own.is_empty() {
                expected.files = found.files.clone();
            }
        }
        let length = found.stopped_of_us.unwrap_or(found.length_us);
        found.run_id() == expected.run_id() && length == expected.length_us
    }

    pub(crate) fn recording_of(&self, member: &Member) -> Recording {
        Recording { seed: member.seed, home: Some(member.name.clone()), ..self.recording.clone() }
    }

    pub(crate) fn ended(
        &self,
        folder: &Path,
        member: &Member,
        recording: &Recording,
    ) -> Result<MemberSummary, SimulationError> {
        Ok(MemberSummary {
            listed: ListedMember {
                name: member.name.clone(),
                seed: member.seed,
                firings: recording.firings,
                rows: recording.rows.unwrap_or(recording.firings),
                days: self.scenario.scenario().calendar.days_lived(RunTime::START + recording.length_us),
                profile: member.row.clone(),
                sha256: self.layout.digest(folder, &member.name, self.kept)?,
            },
            length: recording.length_us,
            is_early: recording.stopped_of_us.is_some(),
        })
    }
}
