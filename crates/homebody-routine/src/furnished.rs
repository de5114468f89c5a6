//! The furniture that the routines of the residents need and the home lacks.

use crate::household::RoutineLanguage;
use crate::needs_of_home;
use homebody_core::problem::Problems;
use homebody_core::scenario::home::FurnitureFile;
use homebody_core::scenario::load::{Files, Scenario};

/// The pieces that the first resident lacks for its routine, each in a free place. Empty if no resident lacks anything, or if
/// no piece fits.
///
/// # Errors
///
/// The problems of the scenario besides what its home lacks.
pub fn additions(files: &dyn Files, entry: &str) -> Result<Vec<FurnitureFile>, Problems> {
    let mut language = RoutineLanguage::default();
    let scenario = Scenario::load_in(&mut language, files, entry)?;
    let RoutineLanguage { routines, conditions, .. } = language;
    let people = routines.iter().filter(|(_, routine)| routine.is_of_person());
    let of = |resident: usize, routine| {
        needs_of_home::additions(&scenario, &scenario.residents[resident].file, routine, &conditions)
    };
    Ok(people.map(|(&resident, routine)| of(resident, routine)).find(|pieces| !pieces.is_empty()).unwrap_or_default())
}
