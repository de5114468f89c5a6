//! The voxel person: the small cubes of the room that all cameras agree on.
//!
//! We assume that cameras are calibrated, that they take their pictures at the same instants, and that the furniture is known.
//!
//! The pixel of each cube in each camera that sees it is computed once. A cube is a person's if two cameras or more see it and all of these
//! have its pixel set.
//!
//! Left out: carving by cubes that are in part a body's.

use super::BodyShape;
use homebody_core::body::figure::Point3;
use homebody_core::camera::lens::Lens;
use homebody_core::camera::outlook::Outlook;
use homebody_core::camera::scenery::{Prism, Scenery};
use homebody_core::camera::silhouette::Silhouette;
use homebody_core::geometry::Point;
use homebody_core::plan::Plan;

/// Side of a cube, in metres (our choice). Anderson et al. had an inch, which takes eight times as long and shows no
/// more in 160 by 120 pixels.
pub const EDGE_M: f64 = 0.05;

/// Height of the topmost cubes, in metres.
const TOP_M: f64 = 2.1;

/// Smallest number of cubes of a person (our choice): a litre.
const LEAST: usize = 8;

/// Share of a body's cubes below its top (our choice): single cubes at the head are noise.
const BELOW_TOP: f64 = 0.98;

/// A camera does not see this cube.
const UNSEEN: u32 = u32::MAX;

/// The cubes of a home that two cameras or more see.
#[derive(Clone, Debug, Default)]
pub struct VoxelSpace {
    cameras: usize,
    columns: Vec<u32>,
    middles: Vec<Point3>,
    /// By cube and camera: the pixel that it is in.
    pixels: Vec<u32>,
    /// By camera and pixel: where its cubes begin among those of the camera.
    begins: Vec<Vec<u32>>,
    cubes: Vec<Vec<u32>>,
}

impl VoxelSpace {
    pub fn new(plan: &Plan, lenses: &[Lens]) -> VoxelSpace {
        let prisms: Vec<Prism> = Outlook::new(plan).prisms;
        let sceneries: Vec<Scenery> = lenses.iter().map(|lens| Scenery::new(lens, &prisms)).collect();
        let (least, most) = plan.bounds();
        let count = |from: f64, to: f64| ((to - from) / EDGE_M).ceil() as usize;
        let mut space = VoxelSpace {
            cameras: lenses.len(),
            columns: lenses.iter().map(|lens| lens.columns).collect(),
            ..VoxelSpace::default()
        };
        if lenses.len() < 2 {
            return space;
        }
        let mut seen_in = vec![UNSEEN; lenses.len()];
        for y in 0..count(least.y, most.y) {
            for x in 0..count(least.x, most.x) {
                let at = least + Point::new(x as f64 + 0.5, y as f64 + 0.5) * EDGE_M;
                if plan.room_at(at).is_none() {
                    continue;
                }
                for z in 0..count(0.0, TOP_M) {
                    let middle = at.extend((z as f64 + 0.5) * EDGE_M);
                    for (index, (lens, scenery)) in lenses.iter().zip(&sceneries).enumerate() {
                        seen_in[index] = pixel(lens, scenery, middle);
                    }
                    if seen_in.iter().filter(|&&pixel| pixel != UNSEEN).count() >= 2 {
                        space.middles.push(middle);
                        space.pixels.extend(&seen_in);
                    }
                }
            }
        }
        for (camera, lens) in lenses.iter().enumerate() {
            space.sort_by_pixel(camera, (lens.columns * lens.rows) as usize);
        }
        space
    }

    fn sort_by_pixel(&mut self, camera: usize, pixels: usize) {
        let of_camera = || self.pixels.iter().skip(camera).step_by(self.cameras).enumerate();
        let seen = || of_camera().filter(|(_, pixel)| **pixel != UNSEEN);
        let mut begins = vec![0u32; pixels + 1];
        seen().for_each(|(_, &pixel)| begins[pixel as usize + 1] += 1);
        for pixel in 0..pixels {
            begins[pixel + 1] += begins[pixel];
        }
        let mut next = begins.clone();
        let mut cubes = vec![0u32; begins[pixels] as usize];
        for (cube, &pixel) in seen() {
            cubes[next[pixel as usize] as usize] = cube as u32;
            next[pixel as usize] += 1;
        }
        self.begins.push(begins);
        self.cubes.push(cubes);
    }

    pub fn len(&self) -> usize {
        self.middles.len()
    }

    /// No two cameras look at the same place.
    pub fn is_empty(&self) -> bool {
        self.middles.is_empty()
    }

    /// The cubes of a person, by the pictures; `None` for a camera without a picture of this instant.
    fn occupied(&self, pictures: &[Option<&Silhouette>]) -> Vec<Point3> {
        let mut occupied = Vec::new();
        for (camera, picture) in pictures.iter().enumerate() {
            let Some(picture) = picture else { continue };
            for (column, row) in picture.pixels() {
                let pixel = row * self.columns[camera] as usize + column;
                let of_pixel = self.begins[camera][pixel] as usize..self.begins[camera][pixel + 1] as usize;
                for &cube in &self.cubes[camera][of_pixel] {
                    if self.is_somebody(cube as usize, camera, pictures) {
                        occupied.push(self.middles[cube as usize]);
                    }
                }
            }
        }
        occupied
    }

    /// The cube is a person's, where a camera sees a person in its pixel. Only the first of the cameras that see it is asked.
    fn is_somebody(&self, cube: usize, first: usize, pictures: &[Option<&Silhouette>]) -> bool {
        let mut agreeing = 1;
        for (camera, picture) in pictures.iter().enumerate() {
            let (Some(picture), pixel) = (picture, self.pixels[cube * self.cameras + camera]) else { continue };
            if camera == first || pixel == UNSEEN {
                continue;
            }
            let columns = self.columns[camera];
            if camera < first || !picture.is_set((pixel % columns) as usize, (pixel / columns) as usize) {
                return false;
            }
            agreeing += 1;
        }
        agreeing >= 2
    }

    /// The shape of a person, and the middles of its cubes; `None` where fewer than two cameras have a picture, or their pictures agree on
    /// no cube.
    pub fn person(&self, pictures: &[Option<&Silhouette>]) -> Option<(BodyShape, Vec<Point3>)> {
        if pictures.iter().flatten().count() < 2 {
            return None;
        }
        let cubes = self.occupied(pictures);
        Some((shape(&cubes)?, cubes))
    }
}

/// The pixel of a camera that a point is in, unless something hides it.
fn pixel(lens: &Lens, scenery: &Scenery, point: Point3) -> u32 {
    let Some(at) = lens.project(point) else { return UNSEEN };
    if at.x < 0.0 || at.y < 0.0 || at.x >= f64::from(lens.columns) || at.y >= f64::from(lens.rows) {
        return UNSEEN;
    }
    let (column, row) = (at.x as usize, at.y as usize);
    let is_hidden = lens.seen(point).z > f64::from(scenery.depth_m(column, row)) + EDGE_M;
    if is_hidden { UNSEEN } else { (row * lens.columns as usize + column) as u32 }
}

/// The shape of a set of cubes; `None` where they are too few for a person.
fn shape(cubes: &[Point3]) -> Option<BodyShape> {
    if cubes.len() < LEAST {
        return None;
    }
    let n = cubes.len() as f64;
    let middle = cubes.iter().sum::<Point3>() / n;
    let mut spread = [[0.0; 3]; 3];
    for cube in cubes {
        let off = (*cube - middle).to_array();
        for row in 0..3 {
            for column in 0..3 {
                spread[row][column] += off[row] * off[column] / n;
            }
        }
    }
    let axis = longest_axis(&spread);
    let mut heights: Vec<f64> = cubes.iter().map(|cube| cube.z).collect();
    heights.sort_by(f64::total_cmp);
    let top = heights[((n * BELOW_TOP) as usize).min(cubes.len() - 1)] + EDGE_M / 2.0;
    Some(BodyShape {
        centroid_up_m: middle.z,
        height_m: top,
        tilt_deg: axis.z.abs().min(1.0).acos().to_degrees(),
        volume_l: n * EDGE_M * EDGE_M * EDGE_M * 1000.0,
        at_m: [middle.x, middle.y],
    })
}

/// The direction in which a set of points is longest, by their covariances: power iteration.
fn longest_axis(spread: &[[f64; 3]; 3]) -> Point3 {
    const STEPS: usize = 60;
    let rows = spread.map(Point3::from_array);
    // Not at a right angle to any likely answer.
    let mut axis = Point3::new(0.37, 0.53, 0.76);
    for _ in 0..STEPS {
        let next = Point3::new(rows[0].dot(axis), rows[1].dot(axis), rows[2].dot(axis));
        axis = next.normalize_or(axis);
    }
    axis
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_core::body::figure::{Figure, Stature, person};
    use homebody_core::body::joints::{Joints, Stance};
    use homebody_core::camera::painter::paint;
    use homebody_core::home::form::HomeFile;
    use serde_json::json;

    const ADULT: Stature = Stature { radius_m: 0.2, height_m: 1.65 };

    fn room() -> Plan {
        let home: HomeFile = serde_json::from_value(json!({ "name": "flat", "walls": [],
            "rooms": [{ "name": "room", "outline": [[0, 0], [5, 0], [5, 4], [0, 4]] }] }))
        .unwrap();
        Plan::new(&home)
    }

    fn lenses() -> Vec<Lens> {
        let corner =
            |x: f64, y: f64, facing: f64| Lens::new(Point3::new(x, y, 2.3), facing.to_radians(), 0.5, 1.3, [160, 120]);
        vec![corner(0.1, 0.1, 40.0), corner(4.9, 0.1, 140.0)]
    }

    fn seen(stance: Stance, support_m: f64) -> BodyShape {
        let figure: Figure =
            person(&ADULT, &Joints::new(stance, ADULT.height_m, support_m).at(Point::new(2.5, 2.0), 0.9));
        let (plan, lenses) = (room(), lenses());
        let space = VoxelSpace::new(&plan, &lenses);
        let pictures: Vec<Silhouette> = lenses
            .iter()
            .map(|lens| {
                let mut picture = Silhouette::new(160, 120);
                paint(&figure, lens, &Scenery::new(lens, &Outlook::new(&plan).prisms), &mut picture);
                picture
            })
            .collect();
        space.person(&pictures.iter().map(Some).collect::<Vec<_>>()).unwrap().0
    }

    #[test]
    fn separates_standing_from_lying() {
        let (standing, lying) = (seen(Stance::Standing, 0.0), seen(Stance::Prone, 0.0));
        let height_m = ADULT.height_m;
        assert!((standing.height_m - height_m).abs() < 0.12, "{standing:?}");
        assert!((0.75..1.05).contains(&standing.centroid_up_m) && standing.tilt_deg < 15.0, "{standing:?}");
        assert!(lying.height_m < 0.55 && lying.centroid_up_m < 0.3 && lying.tilt_deg > 60.0, "{lying:?}");
        // The hull that two cameras agree on is larger than the body, and holds it.
        assert!((50.0..260.0).contains(&standing.volume_l), "{standing:?}");
        assert!((standing.at_m[0] - 2.5).abs() < 0.15 && (standing.at_m[1] - 2.0).abs() < 0.15);
        let (kneeling, sitting) = (seen(Stance::Kneeling, 0.0), seen(Stance::Sitting, 0.45));
        assert!(kneeling.height_m > 1.0 && sitting.height_m > 1.0, "{kneeling:?} {sitting:?}");
    }

    #[test]
    fn one_camera_alone_makes_no_voxel_person() {
        let space = VoxelSpace::new(&room(), &lenses());
        assert!(!space.is_empty());
        let picture = Silhouette::new(160, 120);
        assert_eq!(space.person(&[Some(&picture), None]), None);
        assert_eq!(space.person(&[Some(&picture), Some(&picture)]), None);
    }

    #[test]
    fn the_longest_axis_is_that_of_a_tilted_pole() {
        let direction = Point3::new(0.6, 0.0, 0.8);
        let cubes: Vec<Point3> = (0..100).map(|step| direction * (f64::from(step) * 0.02)).collect();
        let tilt = shape(&cubes).unwrap().tilt_deg;
        assert!((tilt - 36.87).abs() < 0.1, "{tilt}");
    }
}
