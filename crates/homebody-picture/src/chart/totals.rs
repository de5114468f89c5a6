//! Totals against an assumption, a line for each value of another.

use homebody_core::geometry::Point;

use super::super::font;
use super::super::paint::{INK, MUTED, Paint, SERIES, WHITE};
use super::super::svg::{Anchor, Px, Svg, Type, polyline};
use super::{AXIS_TEXT, GRID, TOP, WIDTH, heading, nice_step, steps};

#[derive(Clone, Debug, PartialEq)]
pub struct TotalsLine {
    pub label: String,
    pub points: Vec<(f64, f64)>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    pub label: String,
    /// The total, in the unit of the totals of the lines.
    pub total: f64,
}

const LEFT: f64 = 110.0;
const RIGHT: f64 = WIDTH - 240.0;
const BOTTOM: f64 = 640.0;

/// Totals as lines with a mark for each point; what was published is a dashed line across. `axes` says
/// what goes to the right and what goes up.
pub fn totals_chart(title: &str, axes: [&str; 2], lines: &[TotalsLine], reference: Option<&Reference>) -> String {
    let said = lines.iter().map(|line| {
        let points: Vec<String> = line.points.iter().map(|&(x, y)| format!("{} at {}", Px(y), Px(x))).collect();
        format!("{}: {}", line.label, points.join(", "))
    });
    let mut svg = Svg::new(title, &format!("{} by {}. {}.", axes[1], axes[0], said.collect::<Vec<_>>().join("; ")));
    heading(&mut svg, title, axes[1]);
    let scale = TotalsAxes::new(lines, reference);
    scale.draw(&mut svg, axes[0]);

    let mut names = Vec::new();
    if let Some(reference) = reference {
        let y = scale.at((scale.x.0, reference.total)).y;
        svg.line(Point::new(LEFT, y), Point::new(RIGHT, y), &Paint::line(INK, 1.6).dashed("8 5"));
        names.push(Name { y, end: y, words: &reference.label, line: None });
    }
    for (index, line) in lines.iter().enumerate() {
        let colour = SERIES[index % SERIES.len()];
        let points: Vec<Point> = line.points.iter().map(|&point| scale.at(point)).collect();
        if points.len() > 1 {
            svg.path(&polyline(&points), &Paint::line(colour, 2.0));
        }
        for &point in &points {
            mark(&mut svg, index, point, 5.5);
        }
        if let Some(end) = points.last() {
            names.push(Name { y: end.y, end: end.y, words: &line.label, line: Some(index) });
        }
    }
    draw_names(&mut svg, names);
    svg.finish(WIDTH, BOTTOM + 86.0)
}

struct TotalsAxes {
    x: (f64, f64),
    y: (f64, f64),
    steps: (f64, f64),
}

impl TotalsAxes {
    fn new(lines: &[TotalsLine], reference: Option<&Reference>) -> TotalsAxes {
        let points = || lines.iter().flat_map(|line| line.points.iter());
        let published = reference.map(|reference| reference.total);
        let x = range(points().map(|&(x, _)| x));
        let y = range(points().map(|&(_, y)| y).chain(published));
        let steps = (nice_step(x.1 - x.0, 8.0), nice_step(y.1 - y.0, 6.0));
        let y = ((y.0 / steps.1).floor() * steps.1, (y.1 / steps.1).ceil() * steps.1);
        TotalsAxes { x, y, steps }
    }

    fn at(&self, (x, y): (f64, f64)) -> Point {
        let margin = (self.x.1 - self.x.0) * 0.03;
        let right = (x - self.x.0 + margin) / (self.x.1 - self.x.0 + 2.0 * margin);
        let up = (y - self.y.0) / (self.y.1 - self.y.0);
        Point::new(LEFT + right * (RIGHT - LEFT), BOTTOM - up * (BOTTOM - TOP))
    }

    fn draw(&self, svg: &mut Svg, below: &str) {
        for y in steps(self.y.0, self.y.1, self.steps.1) {
            let left = Point::new(LEFT, self.at((self.x.0, y)).y);
            svg.line(left, Point::new(RIGHT, left.y), &GRID);
            svg.text(&Px(y).to_string(), left - Point::new(12.0, 0.0), &AXIS_TEXT.anchored(Anchor::End));
        }
        svg.line(Point::new(LEFT, BOTTOM), Point::new(RIGHT, BOTTOM), &Paint::line(MUTED, 1.2));
        for x in steps(self.x.0, self.x.1, self.steps.0) {
            let foot = self.at((x, self.y.0));
            svg.line(foot, foot + Point::new(0.0, 6.0), &Paint::line(MUTED, 1.2));
            svg.text(&Px(x).to_string(), foot + Point::new(0.0, 20.0), &AXIS_TEXT.anchored(Anchor::Middle));
        }
        let middle = Point::new((LEFT + RIGHT) / 2.0, BOTTOM + 50.0);
        svg.text(below, middle, &Type::new(14.0, INK).anchored(Anchor::Middle));
    }
}

/// The name of a line, at its height, and the end of the line.
struct Name<'a> {
    y: f64,
    end: f64,
    words: &'a str,
    /// `None` for the reference.
    line: Option<usize>,
}

/// Names to the right of the ends of their lines, moved apart where those meet.
fn draw_names(svg: &mut Svg, mut names: Vec<Name>) {
    const APART: f64 = 20.0;
    names.sort_by(|a, b| a.y.total_cmp(&b.y));
    // Each round halves what is lacking between neighbours.
    for _ in 0..50 {
        for i in 1..names.len() {
            let lacking = (APART - (names[i].y - names[i - 1].y)).max(0.0);
            names[i - 1].y -= lacking / 2.0;
            names[i].y += lacking / 2.0;
        }
    }
    for name in names {
        let colour = name.line.map_or(INK, |index| SERIES[index % SERIES.len()]);
        svg.line(Point::new(RIGHT + 8.0, name.end), Point::new(RIGHT + 22.0, name.y), &Paint::line(colour, 1.0));
        if let Some(index) = name.line {
            mark(svg, index, Point::new(RIGHT + 30.0, name.y), 4.5);
        }
        let words = font::shortened(name.words, 13.0, WIDTH - RIGHT - 50.0);
        svg.text(&words, Point::new(RIGHT + 42.0, name.y), &Type::new(13.0, INK));
    }
}

/// The mark of a line's points: each line has a shape of its own, not only a colour.
fn mark(svg: &mut Svg, index: usize, at: Point, size: f64) {
    let colour = SERIES[index % SERIES.len()];
    let (filled, hollow) = (Paint::fill(colour).outlined(WHITE, 1.2), Paint::fill(WHITE).outlined(colour, 2.0));
    let off = |x: f64, y: f64| at + Point::new(x, y) * size;
    match index % 6 {
        0 => svg.circle(at, size, &filled),
        1 => svg.polygon(&[off(-0.9, -0.9), off(0.9, -0.9), off(0.9, 0.9), off(-0.9, 0.9)], &filled),
        2 => svg.polygon(&[off(0.0, -1.2), off(1.1, 0.9), off(-1.1, 0.9)], &filled),
        3 => svg.polygon(&[off(0.0, -1.3), off(1.3, 0.0), off(0.0, 1.3), off(-1.3, 0.0)], &filled),
        4 => svg.circle(at, size * 0.9, &hollow),
        _ => svg.polygon(&[off(-0.8, -0.8), off(0.8, -0.8), off(0.8, 0.8), off(-0.8, 0.8)], &hollow),
    }
}

/// Least and greatest of some numbers, at least a little apart.
fn range(numbers: impl Iterator<Item = f64>) -> (f64, f64) {
    let (least, most) = numbers.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), n| (a.min(n), b.max(n)));
    match (least, most) {
        _ if least > most => (0.0, 1.0),
        _ if least == most => (least - 0.5, most + 0.5),
        range => range,
    }
}
