//! Cohorts that were killed or stopped, to be gone on with.

use crate::cohort::{COHORT, Cohort, LivedCohort, lived_before};
use crate::cohort_members::MemberLived;
use crate::cohort_place::CohortPlace;
use crate::error::Error;
use crate::run::Progress;
use homebody_log::Cancel;
use homebody_log::lock::FolderLock;
use std::path::Path;

/// A cohort that was killed or stopped, to be gone on with in the folder that it left: who was lived to the end stays, all
/// others are lived as [`Unfinished`](crate::Unfinished) runs are. In the end the folder has the bytes of a cohort that nothing
/// has disturbed.
///
/// ```no_run
/// let lived = homebody_kit::UnfinishedCohort::open("runs/tigerplace-1")?.go_on(|_| ())?;
/// println!("{} lives", lived.list.members.len());
/// # Ok::<(), homebody_kit::Error>(())
/// ```
pub struct UnfinishedCohort {
    cohort: Cohort,
    place: CohortPlace,
    found: Vec<Option<MemberLived>>,
}

impl UnfinishedCohort {
    /// Finds out who was to be lived in a cohort's folder, or below the URL of an object store.
    ///
    /// # Errors
    ///
    /// [`Error::NotFolder`] if it is a file, [`Error::NoRecording`], [`Error::File`] or [`Error::Recording`] if the folder has no
    /// list of a cohort, [`Error::Complete`] if all were lived to their end, [`Error::OtherVersion`] if another version of the
    /// program began it, [`Error::Problems`] if something is wrong with the scenario in it, [`Error::Member`] if what is in the
    /// place of a member is of somebody else.
    pub fn open(folder: impl AsRef<Path>) -> Result<UnfinishedCohort, Error> {
        let folder = folder.as_ref();
        let (cohort, listed) = Cohort::left_in(folder)?;
        let place = CohortPlace::of(folder)?;
        let found = cohort.found_in(&place)?;
        // One that was killed as it wrote the list has lived all of them.
        if listed == cohort.count() && found.iter().all(Option::is_some) {
            return Err(Error::Complete { what: COHORT, folder: folder.into() });
        }
        Ok(UnfinishedCohort { cohort, place, found })
    }

    /// Nobody else is begun, and those who are lived end early, once this handle says so.
    pub fn cancel(mut self, cancel: &Cancel) -> UnfinishedCohort {
        self.cohort.cancel = cancel.clone();
        self
    }

    /// How long all lives together are, and how much of that was lived to its end already.
    pub fn progress(&self) -> Progress {
        Progress { lived: lived_before(&self.found), ..self.cohort.progress() }
    }

    /// Lives all members to their ends, or until it is cancelled; `progress` is called after each batch of anybody's, from
    /// several threads.
    ///
    /// # Errors
    ///
    /// [`Error::Log`] if what is there is not the beginning of these lives, or cannot be written.
    pub fn go_on(self, progress: impl Fn(Progress) + Sync) -> Result<LivedCohort, Error> {
        drop(FolderLock::take(self.place.path())?);
        self.cohort.live_into(&self.place, self.found, progress)
    }
}
