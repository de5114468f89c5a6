//! Figures with their published ranges: a dot against a bar.

use homebody_core::geometry::Point;

use super::super::font;
use super::super::paint::{DEAD, DEAD_TEXT, HAIRLINE, INK, MUTED, Paint, SENSOR, WHITE};
use super::super::svg::{Anchor, Svg, Type};
use super::{TOP, WIDTH, heading};

#[derive(Clone, Debug, PartialEq)]
pub struct RangeFigure {
    pub label: String,
    pub words: String,
    pub low: f64,
    pub high: f64,
    pub value: f64,
}

const LEFT: f64 = 230.0;
const RIGHT: f64 = WIDTH - 400.0;
const ROW: f64 = 22.0;
/// The begin and end of a range as shares of the width: figures further out than that again are at the edge.
const BAR: (f64, f64) = (0.35, 0.65);

/// One row a figure, all ranges drawn alike: the bar is the published range, the dot is ours; where it lies outside, it is
/// a diamond.
pub fn range_chart(title: &str, figures: &[RangeFigure]) -> String {
    let inside = figures.iter().filter(|figure| figure.is_inside()).count();
    let said: Vec<String> = figures.iter().map(|figure| format!("{}: {}", figure.label, figure.words)).collect();
    let mut svg = Svg::new(title, &said.join("; "));
    let subtitle = format!(
        "{inside} of {} figures lie inside: a bar is what was published, a dot is ours, a diamond is ours outside",
        figures.len()
    );
    heading(&mut svg, title, &subtitle);
    let bar = (place(BAR.0), place(BAR.1));
    let bottom = TOP + ROW * figures.len() as f64;
    for (figure, row) in figures.iter().zip(0_u32..) {
        let y = TOP + ROW * (f64::from(row) + 0.5);
        svg.line(Point::new(LEFT, y), Point::new(RIGHT, y), &Paint::line(HAIRLINE, 0.6));
        svg.rectangle(Point::new(bar.0, y - 7.0), Point::new(bar.1 - bar.0, 14.0), &Paint::fill("#cfe1ee"));
        draw(&mut svg, figure, Point::new(place(figure.share()), y));
        let label = font::shortened(&figure.label, 13.0, LEFT - 30.0);
        svg.text(&label, Point::new(LEFT - 14.0, y), &Type::new(13.0, INK).anchored(Anchor::End));
        let set = Type::new(13.0, if figure.is_inside() { MUTED } else { DEAD_TEXT });
        svg.text(&font::shortened(&figure.words, 13.0, WIDTH - RIGHT - 40.0), Point::new(RIGHT + 16.0, y), &set);
    }
    svg.finish(WIDTH, bottom + 30.0)
}

impl RangeFigure {
    fn is_inside(&self) -> bool {
        (self.low..=self.high).contains(&self.value)
    }

    fn share(&self) -> f64 {
        let width = (self.high - self.low).max(f64::MIN_POSITIVE);
        (BAR.0 + (self.value - self.low) / width * (BAR.1 - BAR.0)).clamp(0.0, 1.0)
    }
}

fn place(share: f64) -> f64 {
    LEFT + share * (RIGHT - LEFT)
}

fn draw(svg: &mut Svg, figure: &RangeFigure, at: Point) {
    if figure.is_inside() {
        return svg.circle(at, 5.5, &Paint::fill(SENSOR).outlined(WHITE, 1.0));
    }
    let off = |x: f64, y: f64| at + Point::new(x, y) * 7.5;
    let corners = [off(0.0, -1.0), off(1.0, 0.0), off(0.0, 1.0), off(-1.0, 0.0)];
    svg.polygon(&corners, &Paint::fill(DEAD).outlined(WHITE, 1.0));
}
