//! The errors of a real background subtraction, applied to a clean silhouette.
//!
//! Borders flicker, limbs of the colour of the background leave holes, some of the shadow on the floor is taken for a
//! body, single specks appear, and for a moment after a lamp goes on or off much of the picture changes.
//!
//! We assume that each of these is independent of the others and from one frame to the next, but for holes, which stay for a
//! second.
//!
//! Their rates and sizes are our choice: published pictures of silhouettes have all of them, and no publication counts
//! them.
//!
//! Left out: moved chairs, which stay in the picture until the background has been learned anew, television, sunlight, rain.

use super::lens::Lens;
use super::painter::paint;
use super::scenery::Scenery;
use super::silhouette::Silhouette;
use crate::body::figure::{Capsule, Point3};
use crate::numbers::Numbers;
use crate::random::{DrawnValue, Marks, poisson_by_inversion};

crate::numbers! {
    /// Share of a silhouette's border pixels, on both sides, that a frame assigns to the other side.
    static FLICKER = "camera.flicker": 0.15, "1", [0.0, 0.5];
    /// Probability that a silhouette has a hole.
    static HOLES = "camera.holes": 0.15, "1", [0.0, 1.0];
    /// Share of a shadow's pixels on the floor that count as body.
    static SHADOW = "camera.shadow": 0.25, "1", [0.0, 1.0];
    /// Mean number of specks of up to four pixels in a frame.
    static SPECKS = "camera.specks": 0.5, "1", [0.0, 20.0];
    /// Share of the pixels that change as a lamp is turned on or off.
    static LIGHT = "camera.light": 0.5, "1", [0.0, 1.0];
    /// Time that a camera needs to adapt to a lamp that is turned on or off.
    pub static LIGHT_S = "camera.light_lasts": 1.5, "s", [0.0, 60.0];
}

/// The noise of a camera's silhouettes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Noise {
    flicker: f64,
    holes: f64,
    shadow: f64,
    specks: f64,
    light: f64,
}

/// Number of frames that a hole stays (our choice).
const HOLE_FRAMES: u64 = 5;

/// Share of a hole's area with a ragged border (our choice).
const RAGGED: f64 = 0.5;

/// Reach of a shadow from the feet, and its width, in metres (our choice).
const SHADOW_M: [f64; 2] = [0.6, 0.12];

impl Noise {
    /// As the scenario has it.
    pub fn new(numbers: &Numbers) -> Noise {
        let of = |number| numbers.of(number);
        Noise { flicker: of(&FLICKER), holes: of(&HOLES), shadow: of(&SHADOW), specks: of(&SPECKS), light: of(&LIGHT) }
    }

    /// No noise.
    pub const NONE: Noise = Noise { flicker: 0.0, holes: 0.0, shadow: 0.0, specks: 0.0, light: 0.0 };

    /// Does to the clean silhouette of these bodies what happens in a frame. `lit` is how much of a lamp's change is still there,
    /// from 0 to 1.
    pub fn disturb(
        &self,
        picture: &mut Silhouette,
        bodies: &[Vec<Capsule>],
        (lens, scenery): (&Lens, &Scenery),
        (marks, frame): (Marks, u64),
        lit: f64,
    ) {
        let mut drawn = Drawing { drawn: marks.of(frame), next: 0 };
        let size = (picture.columns(), picture.rows());
        if self.shadow > 0.0 {
            let mut shadow = Silhouette::new(lens.columns, lens.rows);
            bodies.iter().for_each(|body| paint(&shadow_of(body), lens, scenery, &mut shadow));
            for (column, row) in shadow.pixels() {
                if drawn.unit() < self.shadow {
                    picture.set(column, row, true);
                }
            }
        }
        if self.flicker > 0.0 {
            for (column, row) in picture.border() {
                if drawn.unit() < self.flicker {
                    let is_set = picture.is_set(column, row);
                    picture.set(column, row, !is_set);
                }
            }
        }
        let mut hole = Drawing { drawn: marks.of(u64::MAX - frame / HOLE_FRAMES), next: 0 };
        if hole.unit() < self.holes
            && let Some(features) = picture.features()
        {
            clear_hole(picture, features.box_px, &mut hole);
        }
        let specks = poisson_by_inversion(self.specks, drawn.unit());
        for _ in 0..specks {
            let column = (drawn.unit() * size.0 as f64) as usize;
            let row = (drawn.unit() * size.1 as f64) as usize;
            for (right, below) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
                if column + right < size.0 && row + below < size.1 && drawn.unit() < 0.6 {
                    picture.set(column + right, row + below, true);
                }
            }
        }
        if lit > 0.0 && self.light > 0.0 {
            for row in 0..size.1 {
                for column in 0..size.0 {
                    if drawn.unit() < self.light * lit {
                        picture.set(column, row, true);
                    }
                }
            }
        }
    }
}

/// Numbers of one frame, one after the other.
struct Drawing {
    drawn: DrawnValue,
    next: u32,
}

impl Drawing {
    fn unit(&mut self) -> f64 {
        self.next += 1;
        self.drawn.unit(self.next)
    }
}

/// The shadow on the floor of a body below a lamp: from the feet, opposite the facing.
fn shadow_of(body: &[Capsule]) -> Vec<Capsule> {
    let (least, most) = crate::body::figure::bounds(body);
    if body.is_empty() {
        return Vec::new();
    }
    let feet = ((least + most) / 2.0).with_z(0.0);
    let to = feet + Point3::new(SHADOW_M[0], 0.3 * SHADOW_M[0], 0.0);
    vec![Capsule { from: feet, to, radius_m: SHADOW_M[1] }]
}

/// Clears a ragged spot of the box around a silhouette: up to half of its width, and a quarter of its height.
fn clear_hole(picture: &mut Silhouette, [left, top, right, bottom]: [u32; 4], drawn: &mut Drawing) {
    let (width, height) = (f64::from(right - left + 1), f64::from(bottom - top + 1));
    let (wide, high) = (width * (0.2 + 0.3 * drawn.unit()), height * (0.05 + 0.2 * drawn.unit()));
    let column = f64::from(left) + (width - wide) * drawn.unit();
    let row = f64::from(top) + (height - high) * drawn.unit();
    let off = |at: usize, from: f64, span: f64| (at as f64 + 0.5 - from - span / 2.0) / (span / 2.0);
    for at_row in row as usize..(row + high).ceil() as usize {
        for at_column in column as usize..(column + wide).ceil() as usize {
            let (across, down) = (off(at_column, column, wide), off(at_row, row, high));
            let is_within = across * across + down * down < 1.0 - RAGGED * drawn.unit();
            if is_within && at_column < picture.columns() && at_row < picture.rows() {
                picture.set(at_column, at_row, false);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scene() -> (Lens, Scenery, Vec<Capsule>, Silhouette) {
        let lens = Lens::new(Point3::new(0.0, 0.0, 2.2), 0.0, 0.4, 1.2, [160, 120]);
        let scenery = Scenery::new(&lens, &[]);
        let body = vec![Capsule { from: Point3::new(3.0, 0.0, 0.2), to: Point3::new(3.0, 0.0, 1.5), radius_m: 0.2 }];
        let mut clean = Silhouette::new(160, 120);
        paint(&body, &lens, &scenery, &mut clean);
        (lens, scenery, body, clean)
    }

    fn disturbed(noise: Noise, frame: u64, lit: f64) -> Silhouette {
        let (lens, scenery, body, mut picture) = scene();
        noise.disturb(&mut picture, &[body], (&lens, &scenery), (Marks::named(7, "test"), frame), lit);
        picture
    }

    fn apart(a: &Silhouette, b: &Silhouette) -> usize {
        (0..120)
            .flat_map(|row| (0..160).map(move |column| (column, row)))
            .filter(|&(column, row)| a.is_set(column, row) != b.is_set(column, row))
            .count()
    }

    #[test]
    fn without_noise_a_silhouette_does_not_change() {
        let (_, _, _, clean) = scene();
        assert_eq!(disturbed(Noise::NONE, 1, 1.0), clean);
    }

    #[test]
    fn as_many_border_pixels_flicker_as_the_number_says() {
        let (_, _, _, clean) = scene();
        let border = clean.border().len() as f64;
        let noise = Noise { flicker: 0.15, ..Noise::NONE };
        let mean = (0..200).map(|frame| apart(&disturbed(noise, frame, 0.0), &clean) as f64).sum::<f64>() / 200.0;
        assert!((mean / border - 0.15).abs() < 0.01, "{mean} of {border}");
    }

    #[test]
    fn a_frame_has_the_same_noise_whenever_it_is_asked_for_and_another_than_its_neighbour() {
        let noise = Noise { flicker: 0.15, holes: 0.5, shadow: 0.25, specks: 1.0, light: 0.5 };
        assert_eq!(disturbed(noise, 5, 0.0), disturbed(noise, 5, 0.0));
        assert_ne!(disturbed(noise, 5, 0.0), disturbed(noise, 6, 0.0));
    }

    #[test]
    fn shadows_add_to_a_body_holes_take_from_it_and_a_lamp_lights_up_all() {
        let (_, _, _, clean) = scene();
        let all = clean.area_px();
        assert!(disturbed(Noise { shadow: 0.25, ..Noise::NONE }, 1, 0.0).area_px() > all);
        let holed =
            (0..100).filter(|frame| disturbed(Noise { holes: 1.0, ..Noise::NONE }, frame * 5, 0.0).area_px() < all);
        assert!(holed.count() > 90);
        let lit = disturbed(Noise { light: 0.5, ..Noise::NONE }, 1, 1.0);
        assert!((f64::from(lit.area_px()) / 19_200.0 - 0.5).abs() < 0.05);
    }
}
