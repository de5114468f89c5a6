//! The shape of a body by one camera alone: its silhouette stands where its lowest pixels meet the floor.
//!
//! We assume that a person touches the floor at the lower end of the silhouette, and is either upright above that place or lies along the
//! floor.
//!
//! An upright body is as high as the ray through its top crosses the upright plane at its feet. A body lies if it appears across the
//! upright there, and would not be longer on the floor than a body is.
//!
//! A person who lies along the line of sight looks as one who kneels; one who is cut off by furniture or by the edge of the picture seems
//! nearer or further than they are: that needs a second camera.
//!
//! A person over a seat or a bed does not lie on the floor. Left out: the height of people who sit or lie there.

use super::BodyShape;
use homebody_core::body::figure::Point3;
use homebody_core::body::ground::{Ground, HIGHEST_SUPPORT_M};
use homebody_core::camera::lens::Lens;
use homebody_core::camera::silhouette::{Features, Silhouette};
use homebody_core::fuzzy::Fuzzy;
use homebody_core::geometry::Point;

/// Depth of a body, as a share of its visible width (our choice).
const DEEP: f64 = 0.6;

/// The degree to which a shape lies across the upright, by the angle between them in the picture, in degrees (our choice).
const ACROSS_DEG: Fuzzy = Fuzzy { low: 30.0, from: 50.0, to: 90.0, high: 90.0 };

/// The degree to which a shape has a direction at all, by its elongation (our choice).
const ELONGATED: Fuzzy = Fuzzy { low: 1.1, from: 1.4, to: f64::MAX, high: f64::MAX };

/// The degree to which a shape on the floor would be as short as a body, in metres (our choice).
const SHORT_M: Fuzzy = Fuzzy { low: 0.0, from: 0.0, to: 1.9, high: 2.4 };

/// Height of a lying person, in metres (our choice). The middle is at half of it.
const LYING_M: f64 = 0.3;

/// The shape of a body by one silhouette; `None` without a person, or if they stand beyond the horizon.
pub fn shape(lens: &Lens, silhouette: &Silhouette, ground: &Ground) -> Option<BodyShape> {
    let features = silhouette.features()?;
    let [left, top, right, bottom] = features.box_px.map(f64::from);
    let middle = features.centroid_px[0];
    let way = |x: f64, y: f64| lens.ray_through(x, y);
    let down = way(middle, bottom + 1.0);
    if down.z >= -1e-6 {
        return None;
    }
    let foot = lens.at + down * (lens.at.z / -down.z);
    let level = (foot - lens.at).with_z(0.0);
    let distance_m = level.length();
    // The point at which a ray crosses the upright plane through the foot, across the line of sight.
    let height_of = |y: f64| {
        let way: Point3 = way(middle, y);
        let times = level.dot(level) / way.with_z(0.0).dot(level);
        (lens.at.z + way.z * times).max(0.0)
    };
    let scale = lens.seen(foot).z / lens.focal_px;
    let wide_m = (right - left + 1.0) * scale;
    let tilt_deg = tilt_deg(lens, &features, foot);
    let across = ACROSS_DEG.agreement(tilt_deg) * ELONGATED.agreement(features.elongation);
    let lies = match across > 0.0 && !is_on_furniture(lens, &features, ground) {
        true => across.min(SHORT_M.agreement(length_on_floor_m(lens, silhouette))),
        false => 0.0,
    };
    let between = |upright: f64, lying: f64| upright + (lying.min(upright) - upright) * lies;
    let height_m = between(height_of(top), LYING_M);
    let centroid_up_m = between(height_of(features.centroid_px[1]), LYING_M / 2.0);
    let area_m2 = f64::from(features.area_px) * scale * scale;
    let volume_l = area_m2 * DEEP * wide_m.min(0.5) * 1000.0;
    (distance_m > 0.0).then_some(BodyShape { centroid_up_m, height_m, tilt_deg, volume_l, at_m: [foot.x, foot.y] })
}

/// The angle in the picture between the longest extent and what is upright above a place, in degrees: 0 upright, 90 across.
fn tilt_deg(lens: &Lens, features: &Features, foot: Point3) -> f64 {
    let upright_deg = match (lens.project(foot), lens.project(foot + Point3::Z)) {
        // Rows go down, angles up.
        (Some(foot), Some(above)) => (foot.y - above.y).atan2(above.x - foot.x).to_degrees(),
        _ => 90.0,
    };
    let apart = (features.orientation_deg - upright_deg).rem_euclid(180.0);
    apart.min(180.0 - apart)
}

fn is_on_furniture(lens: &Lens, features: &Features, ground: &Ground) -> bool {
    let way = lens.ray_through(features.centroid_px[0], features.centroid_px[1]);
    let at = lens.at + way * ((lens.at.z - HIGHEST_SUPPORT_M) / -way.z);
    way.z < -1e-6 && ground.support_m(at.truncate()) > 0.0
}

/// The length of the silhouette if all of it lay on the floor, in metres; infinite if a part of it is above the horizon. An even rod is as
/// long as its standard deviation times the root of 12.
fn length_on_floor_m(lens: &Lens, silhouette: &Silhouette) -> f64 {
    let (mut n, mut sum, mut squares, mut product) = (0.0, Point::ZERO, Point::ZERO, 0.0);
    for (column, row) in silhouette.pixels() {
        let way = lens.ray_in_home(column as u32, row as u32);
        if way.z >= -1e-6 {
            return f64::INFINITY;
        }
        let at = (way * (lens.at.z / -way.z)).truncate();
        n += 1.0;
        sum += at;
        squares += at * at;
        product += at.x * at.y;
    }
    let variance = squares / n - (sum / n) * (sum / n);
    let covariance = product / n - sum.x * sum.y / (n * n);
    let half = (variance.x - variance.y) / 2.0;
    let along = (variance.x + variance.y) / 2.0 + (half * half + covariance * covariance).sqrt();
    (12.0 * along.max(0.0)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_core::body::figure::{Stature, person};
    use homebody_core::body::joints::{Joints, Stance};
    use homebody_core::camera::painter::paint;
    use homebody_core::camera::scenery::Scenery;
    use homebody_core::camera::silhouette::Silhouette;
    use homebody_core::geometry::Point;

    #[test]
    fn a_silhouette_stands_where_its_feet_are_and_is_as_high_as_the_body() {
        let lens = Lens::new(Point3::new(0.0, 0.0, 2.3), 0.0, 0.5, 1.3, [160, 120]);
        let build = Stature { radius_m: 0.2, height_m: 1.65 };
        let seen = |stance| {
            let joints = Joints::new(stance, build.height_m, 0.0).at(Point::new(3.0, 0.4), 1.6);
            let mut picture = Silhouette::new(160, 120);
            paint(&person(&build, &joints), &lens, &Scenery::new(&lens, &[]), &mut picture);
            shape(&lens, &picture, &Ground::floor()).unwrap()
        };
        let standing = seen(Stance::Standing);
        assert!((standing.height_m - build.height_m).abs() < 0.15, "{standing:?}");
        assert!((standing.at_m[0] - 3.0).abs() < 0.2 && (standing.at_m[1] - 0.4).abs() < 0.2, "{standing:?}");
        assert!(standing.tilt_deg < 15.0);
        let lying = seen(Stance::Prone);
        assert!(lying.height_m < 0.6 && lying.tilt_deg > 50.0, "{lying:?}");
    }

    #[test]
    fn lying_is_low_and_standing_is_high_for_each_camera() {
        // High up in the corner of a small room, and far away in a large one.
        let near = Lens::new(Point3::new(0.0, 0.0, 2.3), 0.7, 0.8, 1.75, [160, 120]);
        let far = Lens::new(Point3::new(-3.5, -2.0, 2.3), 0.6, 0.4, 1.6, [160, 120]);
        let build = Stature { radius_m: 0.2, height_m: 1.65 };
        for lens in [near, far] {
            let low = |stance, facing: f64| {
                let joints = Joints::new(stance, build.height_m, 0.0).at(Point::new(1.1, 1.1), facing);
                let mut picture = Silhouette::new(160, 120);
                paint(&person(&build, &joints), &lens, &Scenery::new(&lens, &[]), &mut picture);
                shape(&lens, &picture, &Ground::floor()).unwrap().height_m < 0.7
            };
            // Across the line of sight to within 50 degrees.
            for facing in [1.45, 2.0, 2.36, 2.8, 3.2] {
                let lies = [Stance::Prone, Stance::Lying, Stance::OnLeftSide].map(|stance| low(stance, facing));
                assert!(lies.iter().filter(|lies| **lies).count() >= 2, "{facing}: {lies:?}");
                let upright = [Stance::Standing, Stance::Kneeling].map(|stance| low(stance, facing));
                assert_eq!(upright, [false; 2], "{facing}");
            }
        }
    }

    #[test]
    fn lying_on_a_bed_is_not_low() {
        let lens = Lens::new(Point3::new(0.0, 0.0, 2.3), 0.7, 0.4, 1.6, [160, 120]);
        let (at, half) = (Point::new(2.2, 2.0), Point::new(1.0, 0.45));
        let outline = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| at + Point::new(x, y) * half);
        let bed = Ground::floor().and_support(outline.to_vec(), 0.5);
        let joints = Joints::new(Stance::Lying, 1.65, 0.5).at(at, 0.0);
        let mut picture = Silhouette::new(160, 120);
        paint(
            &person(&Stature { radius_m: 0.2, height_m: 1.65 }, &joints),
            &lens,
            &Scenery::new(&lens, &[]),
            &mut picture,
        );
        let height_m = |ground: &Ground| shape(&lens, &picture, ground).unwrap().height_m;
        assert!(height_m(&Ground::floor()) < 0.6 && height_m(&bed) > 0.7, "{}", height_m(&bed));
    }
}
