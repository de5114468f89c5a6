//! The middle and the ends of some measurements.

/// The middle and the ends of some measurements.
pub struct Spread {
    pub least: f64,
    pub median: f64,
    pub most: f64,
}

impl Spread {
    pub fn of(values: &[f64]) -> Spread {
        let mut values = values.to_vec();
        values.sort_by(f64::total_cmp);
        Spread { least: values[0], median: values[values.len() / 2], most: values[values.len() - 1] }
    }

    pub fn line(&self, name: &str, decimals: usize) -> String {
        format!("RATIO {name} {:.decimals$} {:.decimals$}..{:.decimals$}", self.median, self.least, self.most)
    }
}
