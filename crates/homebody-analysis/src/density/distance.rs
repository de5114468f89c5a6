use super::{DensityCell, features};

pub(crate) fn step_per_h(cells: &[[DensityCell; 24]]) -> f64 {
    super::step_of(cells.iter().flatten())
}

/// The distance of two weeks; `None` where one has no two neighbouring hours that are known.
pub(crate) fn distance(a: &[[DensityCell; 24]], b: &[[DensityCell; 24]], step_per_h: f64) -> Option<f64> {
    Some(super::distance(&features(a, step_per_h)?, &features(b, step_per_h)?))
}
