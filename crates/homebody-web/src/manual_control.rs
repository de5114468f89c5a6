//! A scenario with a resident who is moved by keys.

use crate::messages::StageMessage;
use homebody_core::drivers::input::{InputFile, KeysFile};
use homebody_core::geometry::Point;
use homebody_core::plan::Plan;
use homebody_core::scenario::edit::ScenarioEdit;
use homebody_core::scenario::load::Scenario;

/// Lets keys move a resident. Returns the name of the file of keys, too.
pub fn drive(scenario: &Scenario, driven: usize, input: &[KeysFile]) -> Result<(ScenarioEdit, String), StageMessage> {
    let resident = scenario.residents.get(driven).ok_or(StageMessage::NoResident { number: driven })?;
    let name = format!("{}.keys.json", scenario.file.residents[driven].trim_end_matches(".json"));
    let at = standing_place(scenario.home.plan(), resident.file.radius_m);
    let keys = InputFile { schema: None, keys: input.to_vec() };
    Ok((scenario.edit().keys(driven, &name, &keys, [at.x, at.y]), name))
}

/// The first place of the resident: a named place with free floor around it, or else any free place.
fn standing_place(plan: &Plan, radius_m: f64) -> Point {
    /// Room next to the body, so that it can leave the place (our choice).
    const ROOM_M: f64 = 0.1;
    let (least, most) = plan.bounds();
    let named = plan.places.iter().map(|(_, at)| *at);
    let steps = || (1..40).map(|step| f64::from(step) / 40.0);
    let all = steps().flat_map(|x| steps().map(move |y| least + (most - least) * Point::new(x, y)));
    named.chain(all).find(|&at| plan.is_walkable(at, radius_m + ROOM_M)).unwrap_or((least + most) / 2.0)
}
