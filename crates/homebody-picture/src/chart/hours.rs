//! The use of the hours of a day: bands on top of each other over 24 hours.

use homebody_core::geometry::Point;

use super::super::font;
use super::super::paint::{INK, MUTED, Paint, WHITE};
use super::super::svg::{Anchor, Svg, Type};
use super::{AXIS_TEXT, GRID, TOP, WIDTH, heading};

/// Bands by name, and for each hour of the day the share of each.
#[derive(Clone, Debug, PartialEq)]
pub struct HourShares {
    pub names: Vec<String>,
    /// By hour of the day, the share of each band: from 0 to 1, together at most 1.
    pub shares: Vec<Vec<f64>>,
}

const LEFT: f64 = 70.0;
const RIGHT: f64 = WIDTH - 230.0;
const BOTTOM: f64 = 600.0;

/// Okabe & Ito's palette and tints of it; neighbours differ in lightness, too.
const BANDS: [&str; 11] = [
    "#31445b", "#56b4e9", "#e69f00", "#f7dc8b", "#0072b2", "#9ad3bd", "#009e73", "#e9b4d0", "#cc79a7", "#d55e00",
    "#c9cdd2",
];

/// A column is as wide as an hour, so that the bands step from hour to hour.
pub fn hour_chart(title: &str, hours: &HourShares) -> String {
    let count = hours.shares.len().max(1) as f64;
    let whole = |band: usize| hours.shares.iter().filter_map(|hour| hour.get(band)).sum::<f64>() * 24.0 / count;
    let said: Vec<String> =
        hours.names.iter().enumerate().map(|(band, name)| format!("{name} {:.1} h", whole(band))).collect();
    let mut svg = Svg::new(title, &format!("By hour of the day. In all: {}.", said.join(", ")));
    heading(&mut svg, title, "share of each hour of the day");
    let at = |hour: f64, share: f64| Point::new(LEFT + hour / count * (RIGHT - LEFT), BOTTOM - share * (BOTTOM - TOP));
    let mut below = vec![0.0; hours.shares.len()];
    let mut middles = Vec::new();
    for (band, name) in hours.names.iter().enumerate() {
        let colour = BANDS[band % BANDS.len()];
        let (mut top, mut foot) = (Vec::new(), Vec::new());
        for (hour, (shares, below)) in hours.shares.iter().zip(&mut below).enumerate() {
            let (from, to) = (*below, *below + shares.get(band).copied().unwrap_or(0.0));
            top.extend([at(hour as f64, to), at(hour as f64 + 1.0, to)]);
            foot.extend([at(hour as f64, from), at(hour as f64 + 1.0, from)]);
            *below = to;
        }
        top.extend(foot.into_iter().rev());
        svg.polygon(&top, &Paint::fill(colour).outlined(WHITE, 0.8));
        middles.push((name, colour, whole(band)));
    }
    axes(&mut svg, count, &at);
    for ((name, colour, hours), row) in middles.into_iter().rev().zip(0_u32..) {
        let y = TOP + 14.0 + 26.0 * f64::from(row);
        svg.rectangle(Point::new(RIGHT + 24.0, y - 8.0), Point::new(20.0, 16.0), &Paint::fill(colour));
        let words = font::shortened(&format!("{name}, {hours:.1} h"), 13.0, WIDTH - RIGHT - 60.0);
        svg.text(&words, Point::new(RIGHT + 52.0, y), &Type::new(13.0, INK));
    }
    svg.finish(WIDTH, BOTTOM + 60.0)
}

fn axes(svg: &mut Svg, count: f64, at: &dyn Fn(f64, f64) -> Point) {
    for quarter in 0..=4 {
        let share = f64::from(quarter) / 4.0;
        svg.line(at(0.0, share), at(count, share), &GRID);
        let words = format!("{} %", quarter * 25);
        svg.text(&words, at(0.0, share) - Point::new(10.0, 0.0), &AXIS_TEXT.anchored(Anchor::End));
    }
    for hour in (0..=count as u32).step_by(3) {
        let foot = at(f64::from(hour), 0.0);
        svg.line(foot, foot + Point::new(0.0, 6.0), &Paint::line(MUTED, 1.2));
        svg.text(&format!("{hour:02}:00"), foot + Point::new(0.0, 20.0), &AXIS_TEXT.anchored(Anchor::Middle));
    }
}
