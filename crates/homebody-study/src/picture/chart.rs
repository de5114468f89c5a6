//! Charts of an experiment: firings over time, and totals against what was assumed.

use homebody_core::geometry::Point;

use super::paint::{HAIRLINE, INK, MUTED, Paint, SERIES, WHITE};
use super::svg::{Anchor, Px, Svg, Type, polyline};

/// The firings of one activity, such as walking slowly at five feet.
#[derive(Clone, Debug, PartialEq)]
pub struct Activity {
    pub label: String,
    /// The part of the experiment it belongs to; activities of one portion stand together.
    pub portion: char,
    /// When the sensor fired, from the activity's start.
    pub firings_s: Vec<f64>,
}

/// Totals for a row of assumptions, all else equal.
#[derive(Clone, Debug, PartialEq)]
pub struct TotalsLine {
    pub label: String,
    /// What was assumed, and the total that came of it.
    pub points: Vec<(f64, f64)>,
}

/// A total that others published.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    pub label: String,
    pub total: f64,
}

const WIDTH: f64 = 1200.0;
const LEFT: f64 = 220.0;
const RIGHT: f64 = WIDTH - 90.0;
const TOP: f64 = 104.0;
const GRID: Paint = Paint::line("#e3e6e9", 1.0);
const AXIS_TEXT: Type = Type::new(13.0, MUTED);

/// The firings of each activity as ticks in a lane of its own, under the line of their count so far.
/// All lanes have one scale, so that steeper is more often.
pub fn firing_chart(title: &str, activities: &[Activity], duration_s: f64) -> String {
    const LANE: f64 = 84.0;
    const GAP: f64 = 22.0;
    let total: usize = activities.iter().map(|activity| activity.firings_s.len()).sum();
    let totals: Vec<String> =
        activities.iter().map(|a| format!("{} {}: {}", a.portion, a.label, a.firings_s.len())).collect();
    let mut svg = Svg::new(title, &format!("{total} firings. {}.", totals.join(", ")));
    heading(&mut svg, title, &format!("{total} firings; each tick is one, the line counts them"));

    let most = activities.iter().map(|activity| activity.firings_s.len()).max().unwrap_or(0).max(1) as f64;
    let count_step = nice_step(most, 2.0);
    let x_of = |seconds: f64| LEFT + seconds / duration_s.max(f64::MIN_POSITIVE) * (RIGHT - LEFT);
    let mut portions: Vec<char> = Vec::new();
    let mut y = TOP;
    for (index, activity) in activities.iter().enumerate() {
        if portions.last() != Some(&activity.portion) {
            y += if portions.is_empty() { 0.0 } else { GAP };
            portions.push(activity.portion);
            let same = activities[index..].iter().take_while(|other| other.portion == activity.portion).count();
            portion_bracket(&mut svg, activity.portion, y, y + LANE * same as f64);
        }
        let colour = SERIES[(portions.len() - 1) % SERIES.len()];
        let (floor, count_floor, height) = (y + LANE - 8.0, y + LANE - 30.0, LANE - 42.0);
        let y_of = |count: f64| count_floor - count / most * height;
        for step in 0..=(most / count_step) as usize {
            let count = step as f64 * count_step;
            svg.line(Point::new(LEFT, y_of(count)), Point::new(RIGHT, y_of(count)), &GRID);
            let at = Point::new(LEFT - 8.0, y_of(count));
            svg.text(&Px(count).to_string(), at, &Type::new(11.0, MUTED).anchored(Anchor::End));
        }
        let mut fired: Vec<f64> = activity.firings_s.clone();
        fired.sort_by(f64::total_cmp);
        let mut steps = vec![Point::new(LEFT, y_of(0.0))];
        let mut ticks = String::new();
        for (count, &seconds) in fired.iter().enumerate() {
            let x = x_of(seconds);
            steps.extend([Point::new(x, y_of(count as f64)), Point::new(x, y_of(count as f64 + 1.0))]);
            ticks += &polyline(&[Point::new(x, floor - 16.0), Point::new(x, floor)]);
        }
        steps.push(Point::new(RIGHT, y_of(fired.len() as f64)));
        svg.line(Point::new(LEFT, floor), Point::new(RIGHT, floor), &Paint::line(HAIRLINE, 1.0));
        if !ticks.is_empty() {
            svg.path(&ticks, &Paint::line(colour, 1.8));
        }
        svg.path(&polyline(&steps), &Paint::line(colour, 1.8));
        let set = Type::new(14.0, INK).anchored(Anchor::End);
        svg.text(&activity.label, Point::new(LEFT - 44.0, y + LANE / 2.0), &set);
        let end = Point::new(RIGHT + 10.0, y_of(fired.len() as f64));
        svg.text(&fired.len().to_string(), end, &Type::new(16.0, INK).strong());
        y += LANE;
    }
    time_axis(&mut svg, y + 8.0, duration_s, x_of);
    svg.finish(WIDTH, y + 78.0)
}

/// Totals as lines with a mark for each point; what was published is a dashed line across.
pub fn totals_chart(title: &str, axes: [&str; 2], lines: &[TotalsLine], reference: Option<&Reference>) -> String {
    const BOTTOM: f64 = 640.0;
    const LEFT: f64 = 110.0;
    const RIGHT: f64 = WIDTH - 220.0;
    let points = || lines.iter().flat_map(|line| line.points.iter().copied());
    let published = reference.map(|reference| reference.total);
    let (least_x, most_x) = range(points().map(|(x, _)| x));
    let (least_y, most_y) = range(points().map(|(_, y)| y).chain(published));
    let (x_step, y_step) = (nice_step(most_x - least_x, 8.0), nice_step(most_y - least_y, 6.0));
    let (least_y, most_y) = ((least_y / y_step).floor() * y_step, (most_y / y_step).ceil() * y_step);
    let margin = (most_x - least_x) * 0.03;
    let at = |(x, y): (f64, f64)| {
        let right = (x - least_x + margin) / (most_x - least_x + 2.0 * margin);
        Point::new(LEFT + right * (RIGHT - LEFT), BOTTOM - (y - least_y) / (most_y - least_y) * (BOTTOM - TOP))
    };

    let said = lines.iter().map(|line| {
        let points: Vec<String> = line.points.iter().map(|&(x, y)| format!("{} at {}", Px(y), Px(x))).collect();
        format!("{}: {}", line.label, points.join(", "))
    });
    let mut svg = Svg::new(title, &format!("{} by {}. {}.", axes[1], axes[0], said.collect::<Vec<_>>().join("; ")));
    heading(&mut svg, title, axes[1]);
    for y in steps(least_y, most_y, y_step) {
        let left = Point::new(LEFT, at((least_x, y)).y);
        svg.line(left, Point::new(RIGHT, left.y), &GRID);
        svg.text(&Px(y).to_string(), left - Point::new(12.0, 0.0), &AXIS_TEXT.anchored(Anchor::End));
    }
    svg.line(Point::new(LEFT, BOTTOM), Point::new(RIGHT, BOTTOM), &Paint::line(MUTED, 1.2));
    for x in steps(least_x, most_x, x_step) {
        let foot = Point::new(at((x, least_y)).x, BOTTOM);
        svg.line(foot, foot + Point::new(0.0, 6.0), &Paint::line(MUTED, 1.2));
        svg.text(&Px(x).to_string(), foot + Point::new(0.0, 20.0), &AXIS_TEXT.anchored(Anchor::Middle));
    }
    let below = Point::new((LEFT + RIGHT) / 2.0, BOTTOM + 50.0);
    svg.text(axes[0], below, &Type::new(14.0, INK).anchored(Anchor::Middle));

    // Names stand at the ends of their lines, moved apart where those meet.
    let mut names: Vec<(f64, f64, &str, &'static str)> = Vec::new();
    if let Some(reference) = reference {
        let y = at((least_x, reference.total)).y;
        svg.line(Point::new(LEFT, y), Point::new(RIGHT, y), &Paint::line(INK, 1.6).dashed("8 5"));
        names.push((y, y, &reference.label, INK));
    }
    for (index, line) in lines.iter().enumerate() {
        let colour = SERIES[index % SERIES.len()];
        let points: Vec<Point> = line.points.iter().map(|&point| at(point)).collect();
        if points.len() > 1 {
            svg.path(&polyline(&points), &Paint::line(colour, 2.0));
        }
        for &point in &points {
            mark(&mut svg, index, point, 5.5, colour);
        }
        if let Some(end) = points.last() {
            names.push((end.y, end.y, &line.label, colour));
        }
    }
    names.sort_by(|a, b| a.0.total_cmp(&b.0));
    spread(&mut names, 20.0);
    for (y, end, name, colour) in names {
        let from = Point::new(RIGHT + 8.0, end);
        svg.line(from, Point::new(RIGHT + 22.0, y), &Paint::line(colour, 1.0));
        if let Some(index) = lines.iter().position(|line| std::ptr::eq(line.label.as_str(), name)) {
            mark(&mut svg, index, Point::new(RIGHT + 30.0, y), 4.5, colour);
        }
        svg.text(name, Point::new(RIGHT + 42.0, y), &Type::new(13.0, INK));
    }
    svg.finish(WIDTH, BOTTOM + 86.0)
}

fn heading(svg: &mut Svg, title: &str, subtitle: &str) {
    svg.text(title, Point::new(40.0, 42.0), &Type::new(24.0, INK));
    svg.text(subtitle, Point::new(40.0, 72.0), &Type::new(15.0, MUTED));
}

fn portion_bracket(svg: &mut Svg, portion: char, top: f64, bottom: f64) {
    let x = 66.0;
    svg.line(Point::new(x, top + 6.0), Point::new(x, bottom - 6.0), &Paint::line(HAIRLINE, 2.0));
    let middle = Point::new(x - 14.0, (top + bottom) / 2.0);
    svg.text(&portion.to_string(), middle, &Type::new(24.0, INK).strong().anchored(Anchor::End));
}

/// Minutes where the duration has several, else seconds.
fn time_axis(svg: &mut Svg, y: f64, duration_s: f64, x_of: impl Fn(f64) -> f64) {
    let (unit_s, unit) = if duration_s >= 120.0 { (60.0, "minutes") } else { (1.0, "seconds") };
    svg.line(Point::new(LEFT, y), Point::new(RIGHT, y), &Paint::line(MUTED, 1.2));
    for time in steps(0.0, duration_s / unit_s, nice_step(duration_s / unit_s, 8.0)) {
        let foot = Point::new(x_of(time * unit_s), y);
        svg.line(foot, foot + Point::new(0.0, 6.0), &Paint::line(MUTED, 1.2));
        svg.text(&Px(time).to_string(), foot + Point::new(0.0, 20.0), &AXIS_TEXT.anchored(Anchor::Middle));
    }
    let words = format!("{unit} since the start of the activity");
    let middle = Point::new((LEFT + RIGHT) / 2.0, y + 46.0);
    svg.text(&words, middle, &Type::new(14.0, INK).anchored(Anchor::Middle));
}

/// The mark of a line's points: each line has a shape of its own beside its colour.
fn mark(svg: &mut Svg, index: usize, at: Point, size: f64, colour: &str) {
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

/// Moves sorted heights apart to at least `gap`, each group around where it was.
fn spread(names: &mut [(f64, f64, &str, &'static str)], gap: f64) {
    for _ in 0..50 {
        for i in 1..names.len() {
            let lacking = gap - (names[i].0 - names[i - 1].0);
            if lacking > 0.0 {
                names[i - 1].0 -= lacking / 2.0;
                names[i].0 += lacking / 2.0;
            }
        }
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

/// One, two or five times a power of ten, such that a range takes about so many steps.
fn nice_step(range: f64, steps: f64) -> f64 {
    let mut step = 1e-6;
    let mut factors = [2.0, 2.5, 2.0].into_iter().cycle();
    while step * steps < range {
        step *= factors.next().unwrap_or(2.0);
    }
    step
}

/// The multiples of a step in a range.
fn steps(least: f64, most: f64, step: f64) -> impl Iterator<Item = f64> {
    let (first, last) = ((least / step - 1e-9).ceil() as i64, (most / step + 1e-9).floor() as i64);
    (first..=last).map(move |i| i as f64 * step)
}
