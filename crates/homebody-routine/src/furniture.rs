//! Furniture that routines need and the home lacks.

use crate::household::RoutineLanguage;
use crate::needs_of_home;
use homebody_core::plan::form::FurnitureFile;
use homebody_core::problem::Problems;
use homebody_core::scenario::load::{Files, Scenario};

///
/// The furniture that the first resident with a need lacks, each piece in a free place. Empty if no resident lacks any, or
/// if no piece fits.
///
/// # Errors
///
/// The problems of the scenario other than missing furniture.
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
