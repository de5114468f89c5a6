//! Difficult outlines for geometry.

use crate::choices::Choices;

/// A corner, in metres as a rule.
pub type Corner = [f64; 2];

/// Changes an outline into a degenerate one.
pub fn outline(corners: &mut Vec<Corner>, choices: &mut Choices) {
    if corners.is_empty() {
        return;
    }
    let at = choices.below(corners.len());
    let next = (at + 1) % corners.len();
    match choices.below(14) {
        // All on one line.
        0 => corners.iter_mut().for_each(|corner| corner[1] = corner[0]),
        1 => {
            let y = corners[at][1];
            corners.iter_mut().for_each(|corner| corner[1] = y);
        }
        // In one place.
        2 => corners[at] = corners[next],
        3 => {
            let corner = corners[at];
            corners.fill(corner);
        }
        // Crossing sides.
        4 => corners.swap(at, next),
        5 => {
            let other = choices.below(corners.len());
            corners.swap(at, other);
        }
        6 => corners.reverse(),
        // A spike: there and back.
        7 => {
            let [x, y] = corners[at];
            let reach = *choices.one(&[1e-9, 1e-4, 0.01, 1.0, 1e3, 1e9]);
            corners.splice(next..next, [[x + reach, y + reach * choices.between(-1.0, 1.0)], [x, y]]);
        }
        // Tiny or huge.
        8 => {
            let by = *choices.one(&[0.0, 1e-308, 1e-160, 1e-12, 1e-6, 1e-4, 0.01, 100.0, 1e6, 1e160, 1e300]);
            corners.iter_mut().flatten().for_each(|coordinate| *coordinate *= by);
        }
        9 => {
            let by = *choices.one(&[1e-308, 5e-324, 1e-17, 1e-9, 1e-6, 1e-4, -1e-4, 1e9, 1e16]);
            corners[at][choices.below(2)] += by;
        }
        10 => corners[at][choices.below(2)] = *choices.one(&[1e-308, -1e-308, 5e-324, 0.0, -0.0, 1e300]),
        // A ring of many corners, or a comb.
        11 => *corners = ring(corners[at], choices.size(2_000), *choices.one(&[1e-4, 0.5, 3.0, 1e4])),
        12 => *corners = comb(corners[at], choices.size(500)),
        _ => drop(corners.remove(at)),
    }
}

fn ring([x, y]: Corner, count: usize, radius: f64) -> Vec<Corner> {
    let angle = |corner: usize| std::f64::consts::TAU * corner as f64 / count as f64;
    (0..count).map(|corner| [x + radius * angle(corner).cos(), y + radius * angle(corner).sin()]).collect()
}

fn comb([x, y]: Corner, teeth: usize) -> Vec<Corner> {
    let tooth = |index: usize| {
        let left = x + index as f64 * 0.02;
        [[left, y], [left, y + 1.0], [left + 0.01, y + 1.0], [left + 0.01, y]]
    };
    let end = x + teeth as f64 * 0.02;
    (0..teeth).flat_map(tooth).chain([[end, y - 0.1], [x, y - 0.1]]).collect()
}
