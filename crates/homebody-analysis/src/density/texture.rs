//! The texture of a density map, by Haralick's grey-level co-occurrence matrix.
//!
//! Each cell is one of eight levels, steps of equal height from none up to the map's top. The matrix `p` counts the pairs of levels `i` and
//! `j` of neighbours: hours that follow each other on one day, and the same hour of days that follow each other, in both directions; it
//! sums to 1. A neighbour that is away or unknown does not count, and a day's last hour is not a neighbour of the next day's first. Then
//!
//! | feature | formula | is |
//! |---|---|---|
//! | homogeneity | `sum p / (1 + abs(i - j))` | 1 where all neighbours are alike |
//! | contrast | `sum p (i - j)^2` | 0 where all are alike, 49 where none and most alternate |
//! | entropy | `-sum p ln p` | 0 where all are alike, ln 64 where any pair is as likely |
//!
//! Wang & Skubic (2008) take these three, contrast as *local variation*, with the density at home and the time away as the features of a
//! map. Levels, neighbours and the handling of absences are our choice.

use serde::Serialize;

/// The number of levels.
pub const LEVELS: usize = 8;

#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Texture {
    /// From 0 to 1, as the table above defines it: 1 where all neighbours are alike.
    pub homogeneity: f64,
    /// From 0 to 49, as the table above defines it: 0 where all neighbours are alike.
    pub contrast: f64,
    /// In nats.
    pub entropy: f64,
    pub pairs: u64,
}

pub fn level(density: f64, step_per_h: f64) -> usize {
    // The highest level has the densities above the top, too.
    ((density / step_per_h) as usize).min(LEVELS - 1)
}

impl Texture {
    /// From levels by day and hour; `None` where no two neighbours are known.
    pub fn from_levels<Row: AsRef<[Option<usize>]>>(days: &[Row]) -> Option<Texture> {
        let hours = days.iter().flat_map(|day| day.as_ref().windows(2).map(|pair| (pair[0], pair[1])));
        let next_days =
            days.windows(2).flat_map(|pair| pair[0].as_ref().iter().copied().zip(pair[1].as_ref().iter().copied()));
        let mut counts = [[0_u64; LEVELS]; LEVELS];
        let mut pairs = 0;
        for (a, b) in hours.chain(next_days).filter_map(|(a, b)| a.zip(b)) {
            counts[a][b] += 1;
            counts[b][a] += 1;
            pairs += 1;
        }
        let mut texture = Texture { homogeneity: 0.0, contrast: 0.0, entropy: 0.0, pairs };
        for (i, row) in counts.iter().enumerate() {
            for (j, &count) in row.iter().enumerate().filter(|(_, count)| **count > 0) {
                let (p, apart) = (count as f64 / (2 * pairs) as f64, i.abs_diff(j) as f64);
                texture.homogeneity += p / (1.0 + apart);
                texture.contrast += p * apart * apart;
                texture.entropy -= p * p.ln();
            }
        }
        (pairs > 0).then_some(texture)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(a: f64, b: f64) {
        assert!((a - b).abs() < 1e-12, "{a} is not {b}");
    }

    /// Worked by hand. Neighbours: `00` twice, `11` twice, `22` twice, `01` once, `12` twice, `02` three times.
    #[test]
    fn three_days_of_three_hours() {
        let days = [[0, 0, 1], [0, 2, 1], [2, 2, 1]].map(|day| day.map(Some));
        let texture = Texture::from_levels(&days).unwrap();
        assert_eq!(texture.pairs, 12);
        close(texture.homogeneity, (6.0 + 3.0 / 2.0 + 3.0 / 3.0) / 12.0);
        close(texture.contrast, (3.0 + 3.0 * 4.0) / 12.0);
        let term = |count: f64| -(count / 24.0) * (count / 24.0).ln();
        close(texture.entropy, 3.0 * term(4.0) + 2.0 * (term(1.0) + term(2.0) + term(3.0)));
    }

    #[test]
    fn all_alike_has_no_texture() {
        let texture = Texture::from_levels(&[[Some(3); 24]; 5]).unwrap();
        assert_eq!((texture.homogeneity, texture.contrast, texture.entropy), (1.0, 0.0, 0.0));
        assert_eq!(texture.pairs, 5 * 23 + 4 * 24);
    }

    #[test]
    fn unknown_cells_have_no_neighbours() {
        assert_eq!(Texture::from_levels(&[[Some(1), None, Some(5)]]), None);
        assert_eq!(Texture::from_levels::<[Option<usize>; 24]>(&[]), None);
        let texture = Texture::from_levels(&[[Some(1), Some(1)], [None, Some(2)]]).unwrap();
        assert_eq!((texture.pairs, texture.contrast), (2, 0.5));
    }

    #[test]
    fn levels_are_steps_of_equal_height() {
        let levels = [0.0, 9.9, 10.0, 69.9, 70.0, 1e300].map(|density| level(density, 10.0));
        assert_eq!(levels, [0, 0, 1, 6, 7, 7]);
    }
}
