//! Cohorts that were killed or stopped, to resume.

use crate::cohort::members::MemberSummary;
use crate::cohort::place::CohortPlace;
use crate::cohort::{COHORT, Cohort, CohortSummary, done_before};
use crate::error::SimulationError;
use crate::progress::RunProgress;
use homebody_log::Cancel;
use homebody_log::files::lock::FolderLock;
use std::path::Path;

/// A cohort that was killed or stopped, to resume in its folder: complete members stay, and the others are resumed as an
/// [`IncompleteRun`](crate::IncompleteRun) is. At the end the folder has the bytes of an undisturbed cohort.
///
/// ```no_run
/// let summary = homebody_simulation::IncompleteCohort::open("runs/tigerplace-1")?.resume(|_| ())?;
/// println!("{} members", summary.list.members.len());
/// # Ok::<(), homebody_simulation::SimulationError>(())
/// ```
pub struct IncompleteCohort {
    cohort: Cohort,
    place: CohortPlace,
    found: Vec<Option<MemberSummary>>,
}

impl IncompleteCohort {
    /// Reads the folder of a cohort, or the cohort below the URL of an object store.
    ///
    /// # Errors
    ///
    /// [`SimulationError::NotFolder`] if it is a file, [`SimulationError::NoRecording`], [`SimulationError::File`] or [`SimulationError::Recording`] if the folder has no
    /// list of a cohort, [`SimulationError::Complete`] if all members are complete, [`SimulationError::OtherVersion`] if another version of the
    /// program began it, [`SimulationError::Problems`] if something is wrong with the scenario in it, [`SimulationError::Member`] if what is in the
    /// place of a member belongs to another run.
    pub fn open(folder: impl AsRef<Path>) -> Result<IncompleteCohort, SimulationError> {
        let folder = folder.as_ref();
        let (cohort, listed) = Cohort::in_folder(folder)?;
        let place = CohortPlace::from_path(folder)?;
        let found = cohort.found_in(&place)?;
        // A cohort that was killed while it wrote the list has all members.
        if listed == cohort.count() && found.iter().all(Option::is_some) {
            return Err(SimulationError::Complete { what: COHORT, folder: folder.into() });
        }
        Ok(IncompleteCohort { cohort, place, found })
    }

    /// Ends the cohort early when this handle is cancelled.
    pub fn cancel(mut self, cancel: &Cancel) -> IncompleteCohort {
        self.cohort.cancel = cancel.clone();
        self
    }

    /// The length of all runs together, and of the complete ones.
    pub fn progress(&self) -> RunProgress {
        RunProgress { done: done_before(&self.found), ..self.cohort.progress() }
    }

    /// Simulates all members to their ends, or until it is cancelled; `progress` is called after each batch of any member, from
    /// several threads.
    ///
    /// # Errors
    ///
    /// [`SimulationError::Log`] if what is there is not the beginning of these runs, or cannot be written.
    pub fn resume(self, progress: impl Fn(RunProgress) + Sync) -> Result<CohortSummary, SimulationError> {
        drop(FolderLock::take(self.place.path())?);
        self.cohort.run_into(&self.place, self.found, progress)
    }
}
