//! Firings over time, an activity to a lane.

use homebody_core::geometry::Point;

use super::super::font;
use super::super::paint::{HAIRLINE, INK, MUTED, Paint, SERIES};
use super::super::svg::{Anchor, Px, Svg, Type, polyline};
use super::{AXIS_TEXT, GRID, TOP, WIDTH, heading, nice_step, steps};

#[derive(Clone, Debug, PartialEq)]
pub struct FiringLane {
    pub label: String,
    /// The part of the experiment; activities of one portion stand together.
    pub portion: char,
    pub firings_s: Vec<f64>,
}

const LEFT: f64 = 220.0;
const RIGHT: f64 = WIDTH - 90.0;
/// Height of a lane, and the gap between portions.
const LANE: f64 = 84.0;
const GAP: f64 = 22.0;

/// The firings of each activity as ticks in a lane of its own, under the line of their count so far.
/// All lanes have one scale, so that steeper is more often.
pub fn firing_chart(title: &str, activities: &[FiringLane], duration_s: f64) -> String {
    let total: usize = activities.iter().map(|activity| activity.firings_s.len()).sum();
    let totals: Vec<String> =
        activities.iter().map(|a| format!("{} {}: {}", a.portion, a.label, a.firings_s.len())).collect();
    let mut svg = Svg::new(title, &format!("{total} firings. {}.", totals.join(", ")));
    heading(&mut svg, title, &format!("{total} firings; each tick is one, the line counts them"));

    let most = activities.iter().map(|activity| activity.firings_s.len()).max().unwrap_or(0).max(1) as f64;
    let mut y = TOP;
    for (portion, of_portion) in activities.chunk_by(|a, b| a.portion == b.portion).enumerate() {
        portion_bracket(&mut svg, of_portion[0].portion, y, y + LANE * of_portion.len() as f64);
        for activity in of_portion {
            lane(&mut svg, activity, y, most, duration_s, SERIES[portion % SERIES.len()]);
            y += LANE;
        }
        y += GAP;
    }
    time_axis(&mut svg, y - GAP + 8.0, duration_s);
    svg.finish(WIDTH, y - GAP + 78.0)
}

fn lane(svg: &mut Svg, activity: &FiringLane, top: f64, most: f64, duration_s: f64, colour: &str) {
    let floor = top + LANE - 8.0;
    let y_of = |count: f64| floor - 22.0 - count / most * (LANE - 42.0);
    for count in steps(0.0, most, nice_step(most, 2.0)) {
        let left = Point::new(LEFT, y_of(count));
        svg.line(left, Point::new(RIGHT, left.y), &GRID);
        let set = Type::new(11.0, MUTED).anchored(Anchor::End);
        svg.text(&Px(count).to_string(), left - Point::new(8.0, 0.0), &set);
    }
    let mut fired = activity.firings_s.clone();
    fired.sort_by(f64::total_cmp);
    let total = fired.len() as f64;
    let mut count_line = vec![Point::new(LEFT, y_of(0.0))];
    let mut ticks = String::new();
    for (&seconds, count) in fired.iter().zip(0_u32..) {
        let x = x_of(seconds, duration_s);
        count_line.extend([0, 1].map(|step| Point::new(x, y_of(f64::from(count + step)))));
        ticks += &polyline(&[Point::new(x, floor - 16.0), Point::new(x, floor)]);
    }
    count_line.push(Point::new(RIGHT, y_of(total)));
    svg.line(Point::new(LEFT, floor), Point::new(RIGHT, floor), &Paint::line(HAIRLINE, 1.0));
    if !ticks.is_empty() {
        svg.path(&ticks, &Paint::line(colour, 1.8));
    }
    svg.path(&polyline(&count_line), &Paint::line(colour, 1.8));

    let set = Type::new(14.0, INK).anchored(Anchor::End);
    let label = font::shortened(&activity.label, set.size, 105.0);
    svg.text(&label, Point::new(LEFT - 42.0, top + LANE / 2.0), &set);
    svg.text(&total.to_string(), Point::new(RIGHT + 10.0, y_of(total)), &Type::new(16.0, INK).strong());
}

fn x_of(seconds: f64, duration_s: f64) -> f64 {
    LEFT + (RIGHT - LEFT) * if duration_s > 0.0 { seconds / duration_s } else { 0.0 }
}

fn portion_bracket(svg: &mut Svg, portion: char, top: f64, bottom: f64) {
    let x = 66.0;
    svg.line(Point::new(x, top + 6.0), Point::new(x, bottom - 6.0), &Paint::line(HAIRLINE, 2.0));
    let middle = Point::new(x - 14.0, (top + bottom) / 2.0);
    svg.text(&portion.to_string(), middle, &Type::new(24.0, INK).strong().anchored(Anchor::End));
}

/// Minutes where the duration has several, else seconds.
fn time_axis(svg: &mut Svg, y: f64, duration_s: f64) {
    let (unit_s, unit) = if duration_s >= 120.0 { (60.0, "minutes") } else { (1.0, "seconds") };
    svg.line(Point::new(LEFT, y), Point::new(RIGHT, y), &Paint::line(MUTED, 1.2));
    for time in steps(0.0, duration_s / unit_s, nice_step(duration_s / unit_s, 8.0)) {
        let foot = Point::new(x_of(time * unit_s, duration_s), y);
        svg.line(foot, foot + Point::new(0.0, 6.0), &Paint::line(MUTED, 1.2));
        svg.text(&Px(time).to_string(), foot + Point::new(0.0, 20.0), &AXIS_TEXT.anchored(Anchor::Middle));
    }
    let words = format!("{unit} since the start of the activity");
    let middle = Point::new((LEFT + RIGHT) / 2.0, y + 46.0);
    svg.text(&words, middle, &Type::new(14.0, INK).anchored(Anchor::Middle));
}
