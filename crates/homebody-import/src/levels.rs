//! Which level of a plan is imported: a home is one plane.

use crate::drawing::{Drawing, Level, LevelId};
use crate::error::NotImported;
use crate::names;

/// So many levels are named in a sentence (ours).
const MOST_NAMED: usize = 12;

/// Keeps what is on one level: the wanted one, or the one with the most walls; gives its name if there are several.
///
/// What is on no level is on all of them: plans have that only where they have no levels.
pub fn keep_one(
    drawing: &mut Drawing,
    wanted: Option<&str>,
    remarks: &mut Vec<String>,
) -> Result<Option<String>, NotImported> {
    let mut levels = std::mem::take(&mut drawing.levels);
    levels.sort_by(|a, b| a.elevation_m.total_cmp(&b.elevation_m).then(a.index.total_cmp(&b.index)));
    let walls = |level: &Level| drawing.walls.iter().filter(|wall| wall.level == Some(level.id)).count();
    let chosen = match wanted {
        Some(wanted) => Some(find(&levels, wanted)?),
        // Of equals the lowest.
        None => (0..levels.len().min(MOST_COUNTED)).rev().max_by_key(|&index| walls(&levels[index])),
    };
    let Some(chosen) = chosen else { return Ok(None) };
    if levels.len() > 1 {
        let why = if wanted.is_some() { "as was asked" } else { "which has the most walls" };
        let others = (0..levels.len()).filter(|&index| index != chosen).map(|index| named(&levels, index));
        let (level, others) = (named(&levels, chosen), listed(others));
        remarks.push(format!("of {} levels, this is {level}, {why}; left out are {others}", levels.len()));
    }
    let id = levels[chosen].id;
    let is_here = |level: Option<LevelId>| level.is_none_or(|level| level == id);
    drawing.walls.retain(|wall| is_here(wall.level));
    drawing.rooms.retain(|room| is_here(room.level));
    drawing.openings.retain(|opening| is_here(opening.level));
    drawing.pieces.retain(|piece| is_here(piece.level));
    Ok((levels.len() > 1).then(|| names::clean(&levels[chosen].name)))
}

/// Further levels are not looked at unless they are asked for (ours): no house has as many.
const MOST_COUNTED: usize = 100;

/// The level of a name, or of a number counted from the lowest.
fn find(levels: &[Level], wanted: &str) -> Result<usize, NotImported> {
    let folded = |name: &str| name.trim().to_lowercase();
    let by_name = || levels.iter().position(|level| folded(&level.name) == folded(wanted));
    let by_number = || wanted.trim().parse::<usize>().ok().and_then(|number| number.checked_sub(1));
    by_name().or_else(|| by_number().filter(|&index| index < levels.len())).ok_or_else(|| {
        let known = match levels.is_empty() {
            true => "no levels".to_owned(),
            false => listed((0..levels.len()).map(|index| named(levels, index))),
        };
        NotImported::NoSuchLevel { wanted: names::clean(wanted), known }
    })
}

/// A level by number and name, such as `2 "First floor"`.
fn named(levels: &[Level], index: usize) -> String {
    format!("{} {:?}", index + 1, names::clean(&levels[index].name))
}

fn listed(names: impl Iterator<Item = String>) -> String {
    let names: Vec<String> = names.collect();
    let more = names.len().saturating_sub(MOST_NAMED);
    let named = names[..names.len() - more].join(", ");
    if more > 0 { format!("{named} and {more} more") } else { named }
}
