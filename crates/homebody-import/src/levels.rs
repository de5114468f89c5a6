//! The levels of a plan, each with its drawing.

use crate::drawing::{LevelId, PlanDrawing, PlanLevel};
use crate::error::ImportError;
use crate::names;

/// Largest number of levels in a sentence (our choice).
const MOST_NAMED: usize = 12;

/// Largest number of levels that are read, unless a further one is requested (our choice): no house has as many.
const MOST_COUNTED: usize = 100;

/// Largest number of levels with content (our choice). Of more, those with the most walls are used.
const MOST_STOREYS: usize = 8;

/// Height below which a level is a ceiling, a roof or the thickness of a floor (our choice).
const LEAST_HEIGHT_M: f64 = 1.2;

#[derive(Debug)]
pub struct PlanLevels {
    pub storeys: Vec<Storey>,
    /// All levels by number and name, including empty ones.
    named: Vec<String>,
    is_asked_for: bool,
}

#[derive(Debug)]
pub struct Storey {
    /// `None` in a plan with one level.
    pub name: Option<String>,
    /// Its place among all levels.
    index: usize,
    pub elevation_m: f64,
    pub drawing: PlanDrawing,
}

/// The levels with content, or only the requested one.
///
/// Things without a level are on all of them; only plans without levels have such things.
pub fn split(mut drawing: PlanDrawing, wanted: Option<&str>) -> Result<PlanLevels, ImportError> {
    let mut levels = std::mem::take(&mut drawing.levels);
    levels.sort_by(|a, b| a.elevation_m.total_cmp(&b.elevation_m).then(a.index.total_cmp(&b.index)));
    let named = (0..levels.len()).map(|index| named(&levels, index)).collect();
    let walls = |index: usize| drawing.walls.iter().filter(|wall| wall.level == Some(levels[index].id)).count();
    let chosen = match wanted {
        Some(wanted) => vec![find(&levels, wanted)?],
        None => {
            let is_drawn = |&index: &usize| {
                let has_rooms = || drawing.rooms.iter().any(|room| room.level == Some(levels[index].id));
                levels[index].is_viewable && (walls(index) > 0 || has_rooms())
            };
            let is_thin = |&index: &usize| levels[index].height_m.is_some_and(|height_m| height_m < LEAST_HEIGHT_M);
            let counted = 0..levels.len().min(MOST_COUNTED);
            let (thin, mut drawn): (Vec<usize>, Vec<usize>) = counted.clone().filter(is_drawn).partition(is_thin);
            if drawn.is_empty() {
                drawn = if thin.is_empty() { counted.collect() } else { thin };
            }
            drawn.sort_by_key(|&index| (std::cmp::Reverse(walls(index)), index));
            drawn.truncate(MOST_STOREYS);
            drawn.sort_unstable();
            drawn
        }
    };
    let storeys = match levels.is_empty() {
        true => vec![Storey { name: None, index: 0, elevation_m: 0.0, drawing }],
        false => chosen.into_iter().map(|index| storey(&levels, index, &drawing)).collect(),
    };
    Ok(PlanLevels { storeys, named, is_asked_for: wanted.is_some() })
}

impl PlanLevels {
    /// Reports these storeys, the reason, and those that are left out.
    pub fn report(&self, taken: &[usize], why: &str, remarks: &mut Vec<String>) {
        let taken: Vec<usize> = taken.iter().map(|&storey| self.storeys[storey].index).collect();
        let others: Vec<usize> = (0..self.named.len()).filter(|index| !taken.contains(index)).collect();
        if others.is_empty() {
            return;
        }
        let names = |of: &[usize]| listed(of.iter().map(|&index| self.named[index].clone()));
        let (these, others, count) = (names(&taken), names(&others), self.named.len());
        let why = if self.is_asked_for { "as was asked" } else { why };
        let are = if taken.len() > 1 { "these are" } else { "this is" };
        remarks.push(format!("of {count} levels, {are} {these}, {why}; left out are {others}"));
    }
}

fn storey(levels: &[PlanLevel], index: usize, all: &PlanDrawing) -> Storey {
    let level = &levels[index];
    let is_here = |on: Option<LevelId>| on.is_none_or(|on| on == level.id);
    let drawing = PlanDrawing {
        levels: Vec::new(),
        walls: all.walls.iter().filter(|wall| is_here(wall.level)).cloned().collect(),
        rooms: all.rooms.iter().filter(|room| is_here(room.level)).cloned().collect(),
        openings: all.openings.iter().filter(|opening| is_here(opening.level)).cloned().collect(),
        pieces: all.pieces.iter().filter(|piece| is_here(piece.level)).cloned().collect(),
        labels: all.labels.iter().filter(|label| is_here(label.level)).cloned().collect(),
        latitude_deg: all.latitude_deg,
        unread: 0,
    };
    let name = (levels.len() > 1).then(|| names::clean(&level.name));
    Storey { name, index, elevation_m: level.elevation_m, drawing }
}

/// The level with a name, or a number counted from the lowest.
fn find(levels: &[PlanLevel], wanted: &str) -> Result<usize, ImportError> {
    let folded = |name: &str| name.trim().to_lowercase();
    let by_name = || levels.iter().position(|level| folded(&level.name) == folded(wanted));
    let by_number = || wanted.trim().parse::<usize>().ok().and_then(|number| number.checked_sub(1));
    by_name().or_else(|| by_number().filter(|&index| index < levels.len())).ok_or_else(|| {
        let known = match levels.is_empty() {
            true => "no levels".to_owned(),
            false => listed((0..levels.len()).map(|index| named(levels, index))),
        };
        ImportError::NoSuchLevel { wanted: names::clean(wanted), known }
    })
}

/// A level by number and name, such as `2 "First floor"`.
fn named(levels: &[PlanLevel], index: usize) -> String {
    format!("{} {:?}", index + 1, names::clean(&levels[index].name))
}

fn listed(names: impl Iterator<Item = String>) -> String {
    let names: Vec<String> = names.collect();
    let more = names.len().saturating_sub(MOST_NAMED);
    let named = names[..names.len() - more].join(", ");
    if more > 0 { format!("{named} and {more} more") } else { named }
}
