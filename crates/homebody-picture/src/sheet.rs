//! The sheet that a plan is drawn on: title, scale, dimensions and north.

use homebody_core::geometry::Point;

use super::font;
use super::label::{Block, Labels};
use super::paint::{HAIRLINE, INK, MUTED, Paint, WHITE};
use super::svg::{Anchor, Px, Svg, Type};

/// The width of every sheet, in pixels.
pub const WIDTH: f64 = 1200.0;
/// The left edge and the width of the legend.
pub const LEGEND: (f64, f64) = (WIDTH - 290.0, 250.0);
pub const TOP: f64 = 112.0;

const MARGIN: f64 = 40.0;
/// Around the plan, for dimensions and for what lies outside the front door.
const SURROUND: f64 = 62.0;
/// Largest height of a home.
const TALLEST: f64 = 1100.0;

/// A sheet with a plan: metres to the east and north become pixels to the right and up.
pub struct Sheet {
    pub svg: Svg,
    pub labels: Labels,
    pub px_per_m: f64,
    /// The plan's least and greatest corner, in metres.
    bounds: (Point, Point),
    /// The pixel of the north-west corner of `bounds`.
    corner: Point,
}

impl Sheet {
    pub fn new(title: &str, subtitle: &str, description: &str, bounds: (Point, Point)) -> Sheet {
        let extent = bounds.1 - bounds.0;
        let room = Point::new(LEGEND.0 - 2.0 * SURROUND - MARGIN, TALLEST) / extent;
        let mut svg = Svg::new(&format!("{title}: {subtitle}"), description);
        let room_for_title = WIDTH - 2.0 * MARGIN;
        let size =
            [28.0, 24.0, 20.0].into_iter().find(|&size| font::width(title, size) <= room_for_title).unwrap_or(18.0);
        let shown = font::shortened(title, size, room_for_title);
        svg.text(&shown, Point::new(MARGIN, 46.0), &Type::new(size, INK));
        svg.text(subtitle, Point::new(MARGIN, 76.0), &Type::new(15.0, MUTED));
        let px_per_m = room.min_element();
        let spare = LEGEND.0 - 2.0 * SURROUND - MARGIN - extent.x * px_per_m;
        let corner = Point::new(MARGIN + SURROUND + spare / 2.0, TOP + SURROUND * 0.6);
        let mut labels = Labels::default();
        // Off the sheet, the legend's column, and the title.
        let (left, legend) = (Point::new(-WIDTH, -WIDTH), Point::new(LEGEND.0 - 8.0, -WIDTH));
        labels.take(Block { least: left, most: Point::new(8.0, f64::INFINITY) });
        labels.take(Block { least: legend, most: Point::INFINITY });
        labels.take(Block { least: left, most: Point::new(WIDTH, TOP - 16.0) });
        Sheet { svg, labels, px_per_m, bounds, corner }
    }

    /// A plan in a box of another picture: its corner and size in pixels. `svg` is the picture so far.
    pub fn in_box(svg: Svg, bounds: (Point, Point), corner: Point, size: Point) -> Sheet {
        let extent = bounds.1 - bounds.0;
        let px_per_m = (size / extent).min_element();
        let corner = corner + (size - extent * px_per_m) / 2.0;
        Sheet { svg, labels: Labels::default(), px_per_m, bounds, corner }
    }

    pub fn at(&self, p: Point) -> Point {
        self.corner + Point::new(p.x - self.bounds.0.x, self.bounds.1.y - p.y) * self.px_per_m
    }

    pub fn outline(&self, outline: &[Point]) -> Vec<Point> {
        outline.iter().map(|&p| self.at(p)).collect()
    }

    /// The dimensions of the whole along its south side and its west or east side, which texts then keep off.
    pub fn dimensions(&mut self, on_east: bool) {
        let (south_west, north_east) = (self.at(self.bounds.0), self.at(self.bounds.1));
        let extent = self.bounds.1 - self.bounds.0;
        let set = Type::new(12.0, MUTED).anchored(Anchor::Middle);
        let line = Paint::line(MUTED, 0.9);
        let off = SURROUND * 0.62;

        let y = south_west.y + off;
        let (west, east) = (Point::new(south_west.x, y), Point::new(north_east.x, y));
        self.dimension_line(west, east, &line);
        let middle = (west + east) / 2.0;
        self.svg.rectangle(middle - Point::new(28.0, 8.0), Point::new(56.0, 16.0), &Paint::fill(WHITE));
        self.svg.text(&format!("{:.2} m", extent.x), middle, &set);

        let x = if on_east { north_east.x + off } else { south_west.x - off };
        let (south, north) = (Point::new(x, south_west.y), Point::new(x, north_east.y));
        self.dimension_line(south, north, &line);
        let middle = (south + north) / 2.0;
        self.svg.rectangle(middle - Point::new(8.0, 28.0), Point::new(16.0, 56.0), &Paint::fill(WHITE));
        self.svg.text(&format!("{:.2} m", extent.y), middle, &Type { upright: true, ..set });

        self.labels.take(Block { least: Point::new(west.x, y - 8.0), most: Point::new(east.x, y + 8.0) });
        self.labels.take(Block { least: Point::new(x - 8.0, north.y), most: Point::new(x + 8.0, south.y) });
    }

    /// Scale bar and north arrow below the plan, and the whole sheet's text; `legend_end` is where the legend ends.
    pub fn finish(mut self, legend_end: f64) -> String {
        let plan_end = self.at(self.bounds.0).y + SURROUND + 14.0;
        self.scale_bar(Point::new(self.corner.x, plan_end + 16.0));
        let end = (plan_end + 60.0).max(legend_end + MARGIN);
        self.svg.finish(WIDTH, end)
    }

    fn dimension_line(&mut self, from: Point, to: Point, paint: &Paint) {
        self.svg.line(from, to, paint);
        let along = (to - from).normalize_or_zero();
        for end in [from, to] {
            let slant = (along + along.perp()) * 4.5;
            self.svg.line(end - along.perp() * 7.0, end + along.perp() * 7.0, &Paint::line(HAIRLINE, 0.9));
            self.svg.line(end - slant, end + slant, &Paint { width: 1.4, ..*paint });
        }
    }

    fn scale_bar(&mut self, at: Point) {
        let longest = (self.bounds.1 - self.bounds.0).x / 3.0;
        let length = [0.5, 1.0, 2.0, 5.0, 10.0, 20.0].into_iter().rfind(|&length| length <= longest).unwrap_or(0.2);
        let half = Point::new(length / 2.0 * self.px_per_m, 6.0);
        for (part, fill) in [(0.0, INK), (1.0, WHITE)] {
            let corner = at + Point::new(part * half.x, 0.0);
            self.svg.rectangle(corner, half, &Paint::fill(fill).outlined(INK, 1.0));
        }
        for part in [0.0, 1.0, 2.0] {
            let metres = part / 2.0 * length;
            let unit = if part == 2.0 { " m" } else { "" };
            let middle = at + Point::new(part * half.x, 18.0);
            let set = Type::new(12.0, MUTED).anchored(Anchor::Middle);
            self.svg.text(&format!("{}{unit}", Px(metres)), middle, &set);
        }

        let north = at + Point::new(2.0 * half.x + 64.0, 6.0);
        let (tip, tail) = (Point::new(0.0, -17.0), Point::new(0.0, 8.0));
        let wing = Point::new(7.0, 12.0);
        self.svg.polygon(&[north + tip, north + wing, north + tail - Point::new(0.0, 2.0)], &Paint::fill(INK));
        let west_half = [north + tip, north + wing * Point::new(-1.0, 1.0), north + tail - Point::new(0.0, 2.0)];
        self.svg.polygon(&west_half, &Paint::fill(WHITE).outlined(INK, 1.0));
        self.svg.text("N", north + Point::new(16.0, -8.0), &Type::new(13.0, INK).strong());
    }
}
