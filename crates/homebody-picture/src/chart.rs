//! Charts of an experiment: firings over time, detected and true intervals, totals by assumption, figures with published ranges, and the
//! bands of the hours of a day.

mod firings;
mod hours;
mod ranges;
mod spans;
mod totals;

use homebody_core::geometry::Point;

use super::paint::{INK, MUTED, Paint};
use super::svg::{Svg, Type};

pub use firings::{FiringLane, firing_chart};
pub use hours::{HourShares, hour_chart};
pub use ranges::{RangeFigure, range_chart};
pub use spans::{Lane, Panel, span_chart};
pub use totals::{Reference, TotalsLine, totals_chart};

const WIDTH: f64 = 1200.0;
const TOP: f64 = 104.0;
const GRID: Paint = Paint::line("#e3e6e9", 1.0);
const AXIS_TEXT: Type = Type::new(13.0, MUTED);

pub(super) fn heading(svg: &mut Svg, title: &str, subtitle: &str) {
    svg.text(title, Point::new(40.0, 42.0), &Type::new(24.0, INK));
    svg.text(subtitle, Point::new(40.0, 72.0), &Type::new(15.0, MUTED));
}

/// One, two or five times a power of ten, such that a range has at most so many steps.
fn nice_step(range: f64, steps: f64) -> f64 {
    let mut step = 1e-6;
    let mut factors = [2.0, 2.5, 2.0].into_iter().cycle();
    while step * steps < range {
        step *= factors.next().unwrap_or(2.0);
    }
    step
}

fn steps(least: f64, most: f64, step: f64) -> impl Iterator<Item = f64> {
    let (first, last) = ((least / step - 1e-9).ceil() as i64, (most / step + 1e-9).floor() as i64);
    (first..=last).map(move |i| i as f64 * step)
}
