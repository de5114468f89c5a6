//! A picture of black and white, and its description in a few numbers.

use serde::{Deserialize, Serialize};

/// A picture of pixels that are set or not.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Silhouette {
    columns: usize,
    rows: usize,
    /// Words of 64 pixels, a whole number of them a row.
    words: Vec<u64>,
}

/// The description of a silhouette.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Features {
    /// The number of set pixels.
    pub area_px: u32,
    /// The first and last column and row with a pixel: left, top, right, bottom.
    pub box_px: [u32; 4],
    /// The mean column and row of the pixels' middles.
    pub centroid_px: [f64; 2],
    /// The direction of the longest extent: 0 is level, 90 upright; from 0 up to 180.
    pub orientation_deg: f64,
    /// The ratio of the standard deviations along and across that direction.
    pub elongation: f64,
}

/// The data that a camera keeps of a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// The silhouette, as [`Silhouette::packed`] writes it.
    pub packed: Vec<u8>,
    /// The description.
    pub features: Features,
}

const WORD: usize = 64;

impl Silhouette {
    /// A picture of this size without set pixels.
    pub fn new(columns: u32, rows: u32) -> Silhouette {
        let (columns, rows) = (columns as usize, rows as usize);
        Silhouette { columns, rows, words: vec![0; columns.div_ceil(WORD) * rows] }
    }

    /// Pixels in a row.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// The number of rows.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Whether a pixel is set; none outside of the picture is.
    pub fn is_set(&self, column: usize, row: usize) -> bool {
        column < self.columns && row < self.rows && {
            let (word, bit) = self.place(column, row);
            self.words[word] >> bit & 1 != 0
        }
    }

    /// Sets a pixel of the picture, or clears it.
    pub fn set(&mut self, column: usize, row: usize, on: bool) {
        let (word, bit) = self.place(column, row);
        self.words[word] = self.words[word] & !(1 << bit) | u64::from(on) << bit;
    }

    fn place(&self, column: usize, row: usize) -> (usize, usize) {
        (row * self.columns.div_ceil(WORD) + column / WORD, column % WORD)
    }

    /// The number of set pixels.
    pub fn area_px(&self) -> u32 {
        self.words.iter().map(|word| word.count_ones()).sum()
    }

    fn row(&self, row: usize) -> &[u64] {
        let words = self.columns.div_ceil(WORD);
        &self.words[row * words..(row + 1) * words]
    }

    /// The pixels that are set, row by row.
    pub fn pixels(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        (0..self.rows).flat_map(move |row| {
            self.row(row)
                .iter()
                .enumerate()
                .flat_map(move |(word, &bits)| bits_of(bits).map(move |bit| (word * WORD + bit, row)))
        })
    }

    /// The pixels at the border: set ones next to one that is not, and those next to a set one.
    pub fn border(&self) -> Vec<(usize, usize)> {
        let words = self.columns.div_ceil(WORD);
        let last = if self.columns.is_multiple_of(WORD) { u64::MAX } else { (1 << (self.columns % WORD)) - 1 };
        let mut border = Vec::new();
        let none = vec![0; words];
        for row in 0..self.rows {
            let here = self.row(row);
            let above = if row > 0 { self.row(row - 1) } else { &none };
            let below = if row + 1 < self.rows { self.row(row + 1) } else { &none };
            if here.iter().chain(above).chain(below).all(|&word| word == 0) {
                continue;
            }
            for word in 0..words {
                let before = if word > 0 { here[word - 1] >> (WORD - 1) } else { 0 };
                let after = here.get(word + 1).map_or(0, |next| next << (WORD - 1));
                let (left, right) = (here[word] << 1 | before, here[word] >> 1 | after);
                let any = left | right | above[word] | below[word];
                let all = left & right & above[word] & below[word];
                let within = if word + 1 == words { last } else { u64::MAX };
                let at_border = (here[word] & !all | !here[word] & any) & within;
                border.extend(bits_of(at_border).map(|bit| (word * WORD + bit, row)));
            }
        }
        border
    }

    /// The same without parts of fewer pixels than these; pixels that touch at a side or a corner are of one part.
    pub fn without_specks(&self, least_px: usize) -> Silhouette {
        let mut left = self.clone();
        let mut kept = Silhouette::new(self.columns as u32, self.rows as u32);
        let mut part = Vec::new();
        for pixel in self.pixels() {
            if !left.is_set(pixel.0, pixel.1) {
                continue;
            }
            part.clear();
            part.push(pixel);
            left.set(pixel.0, pixel.1, false);
            let mut next = 0;
            while let Some(&(column, row)) = part.get(next) {
                next += 1;
                for row in row.saturating_sub(1)..=row + 1 {
                    for column in column.saturating_sub(1)..=column + 1 {
                        if left.is_set(column, row) {
                            left.set(column, row, false);
                            part.push((column, row));
                        }
                    }
                }
            }
            if part.len() >= least_px {
                part.iter().for_each(|&(column, row)| kept.set(column, row, true));
            }
        }
        kept
    }

    /// The description; `None` without set pixels.
    pub fn features(&self) -> Option<Features> {
        let (mut area, mut left, mut right, mut top, mut bottom) = (0u64, usize::MAX, 0, usize::MAX, 0);
        let (mut x, mut y, mut xx, mut yy, mut xy) = (0u64, 0u64, 0u64, 0u64, 0u64);
        for row in 0..self.rows {
            let (mut count, mut sum, mut squares) = (0u64, 0u64, 0u64);
            for (word, &bits) in self.row(row).iter().enumerate() {
                if bits == 0 {
                    continue;
                }
                left = left.min(word * WORD + bits.trailing_zeros() as usize);
                right = right.max(word * WORD + WORD - 1 - bits.leading_zeros() as usize);
                for bit in bits_of(bits) {
                    let column = (word * WORD + bit) as u64;
                    count += 1;
                    sum += column;
                    squares += column * column;
                }
            }
            if count > 0 {
                (top, bottom) = (top.min(row), row);
                let row = row as u64;
                area += count;
                x += sum;
                xx += squares;
                y += row * count;
                yy += row * row * count;
                xy += row * sum;
            }
        }
        if area == 0 {
            return None;
        }
        let n = area as f64;
        let (mean_x, mean_y) = (x as f64 / n, y as f64 / n);
        let (var_x, var_y) = (xx as f64 / n - mean_x * mean_x, yy as f64 / n - mean_y * mean_y);
        let covariance = xy as f64 / n - mean_x * mean_y;
        // Rows go down, angles up.
        let turn = 0.5 * libm::atan2(-2.0 * covariance, var_x - var_y);
        let spread = libm::sqrt((var_x - var_y) * (var_x - var_y) / 4.0 + covariance * covariance);
        let (along, across) = ((var_x + var_y) / 2.0 + spread, ((var_x + var_y) / 2.0 - spread).max(0.0));
        // A pixel is not a point: of a single one, both are 1 / sqrt(12).
        let pixel = 1.0 / 12.0;
        Some(Features {
            area_px: area as u32,
            box_px: [left as u32, top as u32, right as u32, bottom as u32],
            centroid_px: [mean_x + 0.5, mean_y + 0.5],
            orientation_deg: turn.to_degrees().rem_euclid(180.0),
            elongation: libm::sqrt((along + pixel) / (across + pixel)),
        })
    }

    /// The picture in few bytes: lengths of runs that are off and on in turns, row by row, beginning with off. Each is
    /// a number of seven bits a byte, the lowest first, whose last byte is below 128. Pixels after the last set one are
    /// left out.
    pub fn packed(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut push = |mut run: usize| {
            while run >= 128 {
                bytes.push(run as u8 | 128);
                run >>= 7;
            }
            bytes.push(run as u8);
        };
        let (mut done, mut begun) = (0, None::<usize>);
        for (column, row) in self.pixels() {
            let pixel = row * self.columns + column;
            match begun {
                Some(_) if done == pixel => done += 1,
                before => {
                    if let Some(begin) = before {
                        push(done - begin);
                    }
                    push(pixel - done);
                    (begun, done) = (Some(pixel), pixel + 1);
                }
            }
        }
        if let Some(begin) = begun {
            push(done - begin);
        }
        bytes
    }

    /// The unpacked picture of this size; `None` if the bytes are not such a picture.
    pub fn unpacked(bytes: &[u8], columns: u32, rows: u32) -> Option<Silhouette> {
        let mut picture = Silhouette::new(columns, rows);
        let most = picture.columns * picture.rows;
        let (mut pixel, mut run, mut shift, mut on) = (0usize, 0usize, 0, false);
        for &byte in bytes {
            if shift > 28 {
                return None;
            }
            run |= usize::from(byte & 127) << shift;
            if byte >= 128 {
                shift += 7;
                continue;
            }
            let end = pixel.checked_add(run).filter(|&end| end <= most)?;
            if on {
                (pixel..end).for_each(|pixel| picture.set(pixel % columns as usize, pixel / columns as usize, true));
            }
            (pixel, run, shift, on) = (end, 0, 0, !on);
        }
        (shift == 0).then_some(picture)
    }
}

fn bits_of(bits: u64) -> impl Iterator<Item = usize> {
    let mut left = bits;
    std::iter::from_fn(move || {
        let bit = left.trailing_zeros() as usize;
        (left != 0).then(|| {
            left &= left - 1;
            bit
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rectangle(left: usize, top: usize, width: usize, height: usize) -> Silhouette {
        let mut picture = Silhouette::new(160, 120);
        for row in top..top + height {
            (left..left + width).for_each(|column| picture.set(column, row, true));
        }
        picture
    }

    #[test]
    fn features_of_a_rectangle_follow_from_its_sides() {
        let features = rectangle(60, 20, 10, 40).features().unwrap();
        assert_eq!((features.area_px, features.box_px), (400, [60, 20, 69, 59]));
        assert_eq!(features.centroid_px, [65.0, 40.0]);
        assert!((features.orientation_deg - 90.0).abs() < 1e-9);
        // The standard deviation of a span of n pixels, as a continuous one, is n / sqrt(12).
        assert!((features.elongation - 4.0).abs() < 1e-9, "{}", features.elongation);
        assert!(rectangle(0, 0, 50, 5).features().unwrap().orientation_deg.abs() < 1e-9);
        assert_eq!(Silhouette::new(160, 120).features(), None);
    }

    #[test]
    fn parts_that_are_too_small_go_and_the_others_stay() {
        let body = rectangle(60, 20, 10, 40);
        let mut seen = body.clone();
        [(5, 5), (6, 6), (7, 6), (159, 119), (0, 0)].iter().for_each(|&(column, row)| seen.set(column, row, true));
        assert_eq!(seen.without_specks(4), body);
        // The three that touch at a corner and at a side stay together.
        assert_eq!(seen.without_specks(3).area_px(), body.area_px() + 3);
        assert_eq!(seen.without_specks(1), seen);
    }

    #[test]
    fn a_slope_that_rises_to_the_right_is_below_a_right_angle() {
        let mut picture = Silhouette::new(160, 120);
        (0..50).for_each(|step| picture.set(20 + step, 100 - step, true));
        assert!((picture.features().unwrap().orientation_deg - 45.0).abs() < 1e-6);
    }

    #[test]
    fn a_border_is_one_pixel_to_each_side() {
        let picture = rectangle(62, 20, 6, 5);
        let border = picture.border();
        // 2 * (6 + 5) - 4 inside, 2 * (6 + 5) outside.
        assert_eq!(border.len(), 18 + 22);
        assert!(border.contains(&(62, 20)) && border.contains(&(61, 20)) && !border.contains(&(61, 19)));
        // Pixels at the edge of the picture have no neighbours outside.
        assert!(rectangle(155, 100, 5, 20).border().iter().all(|&(column, row)| column < 160 && row < 120));
    }

    #[test]
    fn packed_pictures_come_back_and_are_small() {
        let pictures = [
            Silhouette::new(160, 120),
            rectangle(0, 0, 160, 120),
            rectangle(60, 20, 20, 60),
            rectangle(159, 119, 1, 1),
        ];
        for picture in pictures {
            let packed = picture.packed();
            assert_eq!(Silhouette::unpacked(&packed, 160, 120), Some(picture));
        }
        assert!(rectangle(60, 20, 20, 60).packed().len() < 200);
    }

    #[test]
    fn bytes_that_are_no_picture_are_refused() {
        for bytes in [&[255u8; 8][..], &[0, 128], &[200, 200, 9], &[255, 255, 127, 1]] {
            assert_eq!(Silhouette::unpacked(bytes, 160, 120), None, "{bytes:?}");
        }
    }
}
