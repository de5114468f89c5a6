//! The motion density map of Wang and Skubic (2008): the movement in each hour of each day, and the absences.
//!
//! A cell is an hour of a day on the clock on the wall. If the zone is known, an hour that clocks leave out has no data, and an hour that
//! they repeat has two hours. The density is the number of motion events divided by the hours at home in it, `events / at_home_h`; below
//! ten minutes at home, the hour is away and has no density. An hour is without data if less than a quarter of it is recorded. An event is
//! a row with which a motion sensor reports a beginning: `ON`, `FIRE`, `true`. Contacts, lights and readings do not count. `away` finds the
//! times with an empty home, and `texture` compares neighbouring hours.
//!
//! | figure | unit | definition |
//! |---|---|---|
//! | density of a day, an hour of the day, or all | firings an hour | the events of its cells that are at home, divided by the hours at home of these |
//! | away | hours a day | the hours away divided by the days recorded |
//! | distance of two maps | 0 to 2.24 | the Euclidean distance of their five features, each divided by the most it can be: homogeneity by 1, contrast by 49, entropy by ln 64, density by the top of the maps' common scale, away by 24 |
//!
//! Wang & Skubic define density, features and distance. Ten minutes, the quarter, the scale of a feature and the top are our choice: eight
//! steps of a round height, such that one in a hundred cells is above the top. To judge a distance, compare it with those among the weeks
//! of the log it is taken from.
//!
//! We take a log for recorded from its first row to its last, or as long as its run was. A silence of a day and more outside absences is an
//! hour without data: a network that works does not keep so quiet. Left out: visitors, whom the 2008 map takes out by fuzzy rules.

pub(crate) mod distance;
mod away;
mod cell;
mod entrance;
mod map;
mod table;
mod texture;

use homebody_log::Log;
use serde::Serialize;

pub use away::{HomeAbsence, LEAST, Leaving, PresenceSign, SEATED, absences};
pub use cell::{CellSum, DensityCell, HourState};
pub use entrance::{Entrance, EntranceSource};
pub use map::{DensityOptions, Hour, Map, MapDay, Mapping, NoMap, SILENCE, Signs};
pub use texture::{LEVELS, Texture, level};

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Density {
    /// The height of one of the eight levels of texture and picture, in firings an hour.
    pub step_per_h: f64,
    #[serde(flatten)]
    pub of: TexturedMap,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub against: Option<Against>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TexturedMap {
    #[serde(flatten)]
    pub map: Map,
    /// The similarity of neighbouring hours; `None` where no two neighbours are known.
    pub texture: Option<Texture>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Against {
    #[serde(flatten)]
    pub of: TexturedMap,
    /// `None` where one of the two has no texture.
    pub distance: Option<f64>,
    /// The median and the greatest distance of the whole weeks of the other log, if it has two weeks.
    pub weeks_apart: Option<[f64; 2]>,
}

pub fn density(
    log: (&str, &Log, &DensityOptions),
    against: Option<(&str, &Log, &DensityOptions)>,
) -> Result<Density, NoMap> {
    let map = Map::from_log(log.0, log.1, log.2)?;
    let other = against.map(|(name, log, asked)| Map::from_log(name, log, asked)).transpose()?;
    Ok(density_of(map, other))
}

pub fn density_of(map: Map, other: Option<Map>) -> Density {
    let step_per_h = step_per_h([Some(&map), other.as_ref()].into_iter().flatten());
    let of = measured(map, step_per_h);
    let against = other.map(|other| {
        let other = measured(other, step_per_h);
        let features = |measured: &TexturedMap| features(&measured.map.cells, step_per_h);
        let distance = features(&of).zip(features(&other)).map(|(a, b)| distance(&a, &b));
        Against { distance, weeks_apart: weeks_apart(&other.map.cells, step_per_h), of: other }
    });
    Density { step_per_h, of, against }
}

/// A round height of eight levels, such that one cell in a hundred is above the top.
fn step_per_h<'a>(maps: impl Iterator<Item = &'a Map>) -> f64 {
    step_of(maps.flat_map(|map| map.cells.iter().flatten()))
}

fn step_of<'a>(cells: impl Iterator<Item = &'a DensityCell>) -> f64 {
    let mut densities: Vec<f64> = cells.filter_map(DensityCell::density).collect();
    densities.sort_by(f64::total_cmp);
    let top =
        densities.get((densities.len() * 99 / 100).min(densities.len().saturating_sub(1))).copied().unwrap_or(0.0);
    let mut power = 1.0;
    loop {
        let round = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0].map(|step| step * power);
        if let Some(&step) = round.iter().find(|&&step| step * LEVELS as f64 >= top) {
            return step;
        }
        power *= 10.0;
    }
}

fn measured(map: Map, step_per_h: f64) -> TexturedMap {
    let texture = Texture::from_levels(&levels(&map.cells, step_per_h));
    TexturedMap { map, texture }
}

fn levels(cells: &[[DensityCell; 24]], step_per_h: f64) -> Vec<[Option<usize>; 24]> {
    cells.iter().map(|day| day.map(|cell| cell.density().map(|density| level(density, step_per_h)))).collect()
}

fn features(cells: &[[DensityCell; 24]], step_per_h: f64) -> Option<[f64; 5]> {
    let texture = Texture::from_levels(&levels(cells, step_per_h))?;
    let all = CellSum::from_cells(cells.iter().flatten());
    let (steps, kinds_of_pairs) = ((LEVELS - 1) as f64, (LEVELS * LEVELS) as f64);
    Some([
        texture.homogeneity,
        texture.contrast / (steps * steps),
        texture.entropy / kinds_of_pairs.ln(),
        all.density_per_h? / (LEVELS as f64 * step_per_h),
        all.away_h / all.recorded_h,
    ])
}

fn distance(a: &[f64; 5], b: &[f64; 5]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

/// The median and the greatest distance of the whole weeks of a map, two by two.
fn weeks_apart(cells: &[[DensityCell; 24]], step_per_h: f64) -> Option<[f64; 2]> {
    let weeks: Vec<[f64; 5]> = cells.chunks_exact(7).filter_map(|week| features(week, step_per_h)).collect();
    let pairs = weeks.iter().enumerate().flat_map(|(i, a)| weeks[..i].iter().map(move |b| distance(a, b)));
    let mut apart: Vec<f64> = pairs.collect();
    apart.sort_by(f64::total_cmp);
    Some([*apart.get(apart.len() / 2)?, *apart.last()?])
}

#[cfg(test)]
mod real_data;
#[cfg(test)]
mod tests;
