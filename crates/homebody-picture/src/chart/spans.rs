//! Spans of time in lanes: a sensor above the truth.

use homebody_core::geometry::Point;

use super::super::font;
use super::super::paint::{HAIRLINE, INK, MUTED, Paint, SERIES};
use super::super::svg::{Anchor, Px, Svg, Type};
use super::{AXIS_TEXT, GRID, TOP, WIDTH, heading, nice_step, steps};

#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    pub label: String,
    pub duration_s: f64,
    pub lanes: Vec<Lane>,
}

/// The spans of a sensor and those of the truth, in seconds since the panel's start.
#[derive(Clone, Debug, PartialEq)]
pub struct Lane {
    pub label: String,
    /// Shaded behind the tellings.
    pub truth: Vec<[f64; 2]>,
    /// The first is drawn above the second.
    pub told: [Vec<[f64; 2]>; 2],
}

const LEFT: f64 = 120.0;
const RIGHT: f64 = WIDTH - 40.0;
const LANE: f64 = 26.0;
/// Height of a bar; two of them share a lane.
const BAR: f64 = 10.0;
const HEAD: f64 = 30.0;
const FOOT: f64 = 64.0;
const SHADE: &str = "#d9dde1";

/// Panels under each other, all to one scale of time. `truth` and `told` say in words what the shade and the two
/// kinds of bars are.
pub fn span_chart(title: &str, truth: &str, told: [&str; 2], panels: &[Panel]) -> String {
    let count = |telling: usize| -> usize {
        panels.iter().flat_map(|panel| &panel.lanes).map(|lane| lane.told[telling].len()).sum()
    };
    let words = format!("{}: {} spans; {}: {} spans", told[0], count(0), told[1], count(1));
    let mut svg = Svg::new(title, &words);
    heading(&mut svg, title, &words);
    key(&mut svg, truth, told);
    let longest_s = panels.iter().map(|panel| panel.duration_s).fold(1.0, f64::max);
    let mut y = TOP + HEAD;
    for panel in panels {
        svg.text(&panel.label, Point::new(LEFT, y), &Type::new(15.0, INK).strong());
        let top = y + HEAD / 2.0;
        let bottom = top + LANE * panel.lanes.len() as f64;
        axis(&mut svg, top, bottom, longest_s);
        for (lane, row) in panel.lanes.iter().zip(0_u32..) {
            draw(&mut svg, lane, top + LANE * f64::from(row), longest_s);
        }
        y = bottom + FOOT;
    }
    svg.finish(WIDTH, y - 8.0)
}

fn draw(svg: &mut Svg, lane: &Lane, top: f64, longest_s: f64) {
    let x_of = |at_s: f64| LEFT + (RIGHT - LEFT) * at_s / longest_s;
    let bar = |svg: &mut Svg, [begin_s, end_s]: [f64; 2], y: f64, height: f64, colour| {
        let (from, to) = (x_of(begin_s), x_of(end_s));
        svg.rectangle(Point::new(from, y), Point::new((to - from).max(0.8), height), &Paint::fill(colour));
    };
    svg.line(Point::new(LEFT, top + LANE), Point::new(RIGHT, top + LANE), &Paint::line(HAIRLINE, 0.6));
    for &span in &lane.truth {
        bar(svg, span, top + 1.0, LANE - 2.0, SHADE);
    }
    for (spans, (telling, colour)) in lane.told.iter().zip((0_u32..).zip(SERIES)) {
        for &span in spans {
            bar(svg, span, top + 2.0 + f64::from(telling) * (BAR + 2.0), BAR, colour);
        }
    }
    let set = Type::new(13.0, INK).anchored(Anchor::End);
    let label = font::shortened(&lane.label, set.size, LEFT - 24.0);
    svg.text(&label, Point::new(LEFT - 10.0, top + LANE / 2.0), &set);
}

fn axis(svg: &mut Svg, top: f64, bottom: f64, longest_s: f64) {
    let minutes = longest_s / 60.0;
    for time in steps(0.0, minutes, nice_step(minutes, 10.0)) {
        let foot = Point::new(LEFT + (RIGHT - LEFT) * time / minutes, bottom);
        svg.line(Point::new(foot.x, top), foot, &GRID);
        let unit = if time == 0.0 { " min" } else { "" };
        svg.text(&format!("{}{unit}", Px(time)), foot + Point::new(0.0, 16.0), &AXIS_TEXT.anchored(Anchor::Middle));
    }
}

fn key(svg: &mut Svg, truth: &str, told: [&str; 2]) {
    let mut x = LEFT;
    let y = TOP - 4.0;
    let entries = [(truth, SHADE, -8.0, 20.0), (told[0], SERIES[0], -8.0, BAR), (told[1], SERIES[1], 2.0, BAR)];
    for (words, colour, off, height) in entries {
        svg.rectangle(Point::new(x, y + off), Point::new(28.0, height), &Paint::fill(colour));
        let set = Type::new(13.0, MUTED);
        svg.text(words, Point::new(x + 36.0, y + 2.0), &set);
        x += 36.0 + font::width(words, set.size) + 32.0;
    }
}
