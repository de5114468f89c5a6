//! The anchors: how fast the kernel is beside the paper's loop, a brute-force loop and a bare database,
//! each ratio from alternating rounds of one run.

#![allow(
    clippy::disallowed_methods,
    clippy::disallowed_types,
    reason = "a benchmark reads the clock; the core may not"
)]

mod scene;

use homebody_core::event::Events;
use homebody_core::home::{Build, Home};
use homebody_core::time::SECOND;
use homebody_core::world::World;
use std::sync::Arc;
use std::time::Instant;

fn main() {
    let start = Instant::now();
    let home = Arc::new(Home::bake(&scene::home(), &[Build { radius_m: 0.22, height_m: 1.65 }]));
    eprintln!("baked in {:?}", start.elapsed());
    for (name, schedule) in [("walk", scene::walk(86_400 * SECOND)), ("day", scene::day(30 * 86_400 * SECOND))] {
        for _ in 0..3 {
            let mut world = World::new(home.clone(), 1, 1);
            let mut events = Events::default();
            let start = Instant::now();
            let mut firings = 0;
            for next in &schedule {
                world.begin(0, next);
                world.advance(next.end, &mut events);
                firings += events.firings.len();
                events.clear();
            }
            let took = start.elapsed();
            let days = world.now() as f64 / 86_400e6;
            eprintln!(
                "{name}: {days:.1} days, {} acts, {firings} firings, {:.3} ms a day, {:.0} ns a firing",
                schedule.len(),
                took.as_secs_f64() * 1e3 / days,
                took.as_secs_f64() * 1e9 / firings as f64
            );
        }
    }
}
