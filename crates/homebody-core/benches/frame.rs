//! The cost of a camera's frame: 160 by 120 pixels, three bodies and twenty pieces of furniture in view, with all
//! noise, to the packed silhouette.
//!
//! Ends with `FRAME us <median> <min>..<max>`, and the same of a frame without noise.

#![allow(
    clippy::disallowed_methods,
    clippy::disallowed_types,
    reason = "a benchmark reads the clock; the core may not"
)]

#[path = "measure/spread.rs"]
#[expect(dead_code, reason = "a figure here is no ratio")]
mod spread;

use homebody_core::body::figure::{Figure, Point3, Stature, person};
use homebody_core::body::joints::{Joints, Stance};
use homebody_core::camera::lens::Lens;
use homebody_core::camera::noise::Noise;
use homebody_core::camera::painter::paint;
use homebody_core::camera::scenery::{Prism, Scenery};
use homebody_core::camera::silhouette::Silhouette;
use homebody_core::geometry::Point;
use homebody_core::numbers::Numbers;
use homebody_core::random::Marks;
use spread::Spread;
use std::time::Instant;

const ROUNDS: usize = 41;
/// Frames of a round.
const FRAMES: u64 = 500;

fn main() {
    let lens = Lens::new(Point3::new(0.1, 0.1, 2.3), 0.7, 0.5, 1.5, [160, 120]);
    let corners = |at: Point| [(-0.2, -0.2), (0.2, -0.2), (0.2, 0.2), (-0.2, 0.2)].map(|(x, y)| at + Point::new(x, y));
    let piece = |number: u32| {
        let at = Point::new(f64::from(number % 5) + 0.9, f64::from(number / 5) + 1.2);
        Prism { outline: corners(at).into(), height_m: 0.3 + 0.05 * f64::from(number) }
    };
    let prisms: Vec<Prism> = (0..20).map(piece).collect();
    let start = Instant::now();
    let scenery = Scenery::new(&lens, &prisms);
    println!("the scenery of twenty pieces, once a run: {:.2} ms", start.elapsed().as_secs_f64() * 1e3);
    let lines = [("FRAME us", Noise::new(&Numbers::default())), ("FRAME without noise us", Noise::NONE)]
        .map(|(name, noise)| line(name, noise, &lens, &scenery));
    lines.iter().for_each(|line| println!("{line}"));
}

fn line(name: &str, noise: Noise, lens: &Lens, scenery: &Scenery) -> String {
    let stature = Stature { radius_m: 0.2, height_m: 1.7 };
    let marks = Marks::named(7, "frame");
    let mut seen_px = 0;
    let mut rounds_us = Vec::new();
    for _ in 0..ROUNDS {
        let start = Instant::now();
        for frame in 0..FRAMES {
            // They walk to and fro, so that no two frames are alike.
            let phase = frame as f64 * 0.2;
            let body = |stance: Stance, x: f64, y: f64| -> Figure {
                let at = Point::new(x + 0.3 * phase.sin(), y);
                person(&stature, &Joints::new(stance, stature.height_m, 0.0).at(at, phase).walking(phase, 0.7))
            };
            let bodies =
                [body(Stance::Standing, 2.4, 1.7), body(Stance::Sitting, 3.4, 2.7), body(Stance::Prone, 2.0, 2.9)];
            let mut picture = Silhouette::new(lens.columns, lens.rows);
            bodies.iter().for_each(|body| paint(body, lens, scenery, &mut picture));
            noise.disturb(&mut picture, &bodies, (lens, scenery), (marks, frame), 0.0);
            let features = picture.features().expect("three bodies");
            seen_px += u64::from(features.area_px) + picture.packed().len() as u64 % 2;
        }
        rounds_us.push(start.elapsed().as_secs_f64() / FRAMES as f64 * 1e6);
    }
    let Spread { least, median, most } = Spread::of(&rounds_us);
    println!("{name}: bodies fill {} pixels on average", seen_px / (FRAMES * ROUNDS as u64));
    format!("{name} {median:.1} {least:.1}..{most:.1}")
}
