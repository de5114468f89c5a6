//! The hours that a map is made of, and what they come to.

use serde::Serialize;

/// Time at home in an hour below which the hour counts as away (our choice: Wang & Skubic give none).
pub const LEAST_AT_HOME_H: f64 = 1.0 / 6.0;

/// Time with data below which an hour is unknown (our choice): a few firings in some minutes would make it the darkest
/// of all.
pub const LEAST_RECORDED_H: f64 = 1.0 / 4.0;

#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct CellSum {
    pub events: u64,
    pub recorded_h: f64,
    /// The hours with data in which the home was empty.
    pub away_h: f64,
    /// Events an hour at home, over the cells with a person at home; `None` where no cell has one.
    pub density_per_h: Option<f64>,
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DensityCell {
    pub events: u64,
    pub recorded_h: f64,
    /// The recorded part in which the home was empty, in hours.
    pub away_h: f64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum HourState {
    /// Less than a quarter of the hour was recorded.
    NoData,
    /// A person was at home for less than ten minutes.
    Away,
    Density(f64),
}

impl DensityCell {
    /// The recorded time with a person at home, in hours.
    pub fn at_home_h(&self) -> f64 {
        (self.recorded_h - self.away_h).max(0.0)
    }

    pub fn state(&self) -> HourState {
        match () {
            () if self.recorded_h < LEAST_RECORDED_H => HourState::NoData,
            () if self.at_home_h() < LEAST_AT_HOME_H => HourState::Away,
            () => HourState::Density(self.events as f64 / self.at_home_h()),
        }
    }

    /// Firings an hour at home, if a person was at home.
    pub fn density(&self) -> Option<f64> {
        if let HourState::Density(density) = self.state() { Some(density) } else { None }
    }
}

impl CellSum {
    /// The sum of some cells, with the density of those with a person at home.
    pub fn from_cells<'a>(cells: impl IntoIterator<Item = &'a DensityCell>) -> CellSum {
        let mut sum = CellSum::default();
        let (mut events, mut at_home_h) = (0, 0.0);
        for cell in cells {
            sum.events += cell.events;
            sum.recorded_h += cell.recorded_h;
            sum.away_h += cell.away_h.min(cell.recorded_h);
            if cell.density().is_some() {
                events += cell.events;
                at_home_h += cell.at_home_h();
            }
        }
        sum.density_per_h = (at_home_h > 0.0).then(|| events as f64 / at_home_h);
        sum
    }
}
