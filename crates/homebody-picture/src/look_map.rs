//! A log as a map: a row for each sensor, a column for each day, shaded by how many rows the log has of it there.

use super::page::{begun, table};
use super::paint::{DENSITY, HAIRLINE, INK, MUTED, Paint, QUIET};
use super::svg::{Anchor, Px, Svg, Type, escaped};
use homebody_analysis::look::{LogOverview, SensorLook};
use homebody_core::geometry::Point;
use std::fmt::Write;

const WIDTH: f64 = 1200.0;
const LEFT: f64 = 250.0;
const RIGHT: f64 = WIDTH - 40.0;
const TOP: f64 = 132.0;
const ROW: f64 = 16.0;
/// Height of the line of silences above the sensors.
const LINE: f64 = 10.0;
const HATCH: &str = "silent";
const AXIS: Type = Type::new(12.0, MUTED);

/// Smallest number of rows a day for each of the colours of a cell (our choice). Fewer have the first.
const STEPS: [u32; 8] = [1, 3, 10, 30, 100, 300, 1_000, 3_000];

/// Largest number of sensors in the map, those with the most rows (our choice).
const MOST_SENSORS: usize = 400;

/// Largest number of letters of a name (our choice).
const LONGEST_NAME: usize = 30;

pub fn look_map(look: &LogOverview) -> String {
    let span = match (&look.first, &look.last) {
        (Some(first), Some(last)) => format!("{first} to {last}"),
        _ => "without a row".into(),
    };
    let words = format!("{}: {} rows of {} sensors, {span}", look.name, look.rows, look.sensors.len());
    let title = "Rows of each sensor by day";
    let mut svg = Svg::new(title, &words);
    svg.hatch(HATCH, "#eceef0", "#c4c9cf");
    svg.text(title, Point::new(40.0, 36.0), &Type::new(24.0, INK));
    svg.text(&words, Point::new(40.0, 64.0), &Type::new(14.0, INK));
    legend(&mut svg);
    let drawn = drawn(look);
    let bottom = TOP + LINE + ROW * drawn.len() as f64;
    if look.days.is_empty() {
        let why = if look.rows == 0 { "There is no row." } else { "The days are too many to draw." };
        svg.text(why, Point::new(LEFT, TOP), &AXIS);
    } else {
        map(&mut svg, look, &drawn, bottom);
    }
    let left_out = look.sensors.len() - drawn.len();
    if left_out > 0 {
        svg.text(&format!("and {left_out} sensors with fewer rows"), Point::new(LEFT, bottom + 44.0), &AXIS);
    }
    svg.finish(WIDTH, bottom + 64.0)
}

fn drawn(look: &LogOverview) -> Vec<&SensorLook> {
    let mut rows: Vec<u64> = look.sensors.iter().map(|sensor| sensor.rows).collect();
    rows.sort_unstable_by(|a, b| b.cmp(a));
    let least = rows.get(MOST_SENSORS).map_or(0, |next| next + 1);
    look.sensors.iter().filter(|sensor| sensor.rows >= least).take(MOST_SENSORS).collect()
}

fn legend(svg: &mut Svg) {
    const Y: f64 = 96.0;
    const BOX: Point = Point::new(54.0, 16.0);
    let hatch = format!("url(#{HATCH})");
    for (x, fill, what) in
        [(40.0, hatch.as_str(), "no sensor says anything"), (250.0, QUIET, "no row"), (350.0, INK, "12 h of silence")]
    {
        svg.rectangle(Point::new(x, Y - BOX.y / 2.0), Point::new(26.0, BOX.y), &Paint::fill(fill).outlined(MUTED, 0.8));
        svg.text(what, Point::new(x + 34.0, Y), &Type::new(13.0, INK));
    }
    let left = RIGHT - BOX.x * STEPS.len() as f64;
    svg.text("rows a day from", Point::new(left - 10.0, Y), &Type::new(13.0, INK).anchored(Anchor::End));
    for (place, (colour, from)) in DENSITY.iter().zip(STEPS).enumerate() {
        let corner = Point::new(left + BOX.x * place as f64, Y - BOX.y / 2.0);
        svg.rectangle(corner, BOX, &Paint::fill(colour));
        svg.text(&from.to_string(), corner + Point::new(0.0, BOX.y + 10.0), &AXIS.anchored(Anchor::Middle));
    }
}

/// The number of the colour of a count above 0.
fn level(count: u32) -> Option<usize> {
    STEPS.iter().rposition(|&from| count >= from)
}

fn map(svg: &mut Svg, look: &LogOverview, drawn: &[&SensorLook], bottom: f64) {
    let column = (RIGHT - LEFT) / look.days.len() as f64;
    let x = |days: f64| (LEFT + column * days).clamp(LEFT, RIGHT);
    let top = TOP + LINE;
    svg.rectangle(Point::new(LEFT, top), Point::new(RIGHT - LEFT, bottom - top), &Paint::fill(QUIET));
    let silent: Vec<bool> = (0..look.days.len()).map(|day| look.is_silent(day)).collect();
    for run in runs(&silent) {
        let size = Point::new(x(run.end as f64) - x(run.start as f64), bottom - top);
        svg.rectangle(Point::new(x(run.start as f64), top), size, &Paint::fill(&format!("url(#{HATCH})")));
    }
    for (number, colour) in DENSITY.iter().enumerate() {
        let mut path = String::new();
        for (row, sensor) in drawn.iter().enumerate() {
            let is_it: Vec<bool> = sensor.by_day.iter().map(|&count| level(count) == Some(number)).collect();
            let (from, to) = (top + ROW * row as f64, top + ROW * (row + 1) as f64);
            for run in runs(&is_it) {
                let (left, right) = (x(run.start as f64), x(run.end as f64));
                let _ = write!(path, "M{} {}H{}V{}H{}Z", Px(left), Px(from), Px(right), Px(to), Px(left));
            }
        }
        if !path.is_empty() {
            svg.crisp(|svg| svg.path(&path, &Paint::fill(colour).joined()));
        }
    }
    for (row, sensor) in drawn.iter().enumerate() {
        let middle = top + ROW * (row as f64 + 0.5);
        let name = sensor.name.as_ref().unwrap_or(&sensor.id);
        let is_cut = name.chars().count() > LONGEST_NAME;
        let name: String = name.chars().take(LONGEST_NAME).chain(is_cut.then_some('…')).collect();
        // A sign shows the problem, too.
        let sign = if sensor.trouble.is_some() { "! " } else { "" };
        svg.text(&format!("{sign}{name}"), Point::new(LEFT - 8.0, middle), &Type::new(12.0, INK).anchored(Anchor::End));
    }
    for silence in &look.silences {
        let [from, to] = silence.at_days.map(x);
        svg.rectangle(Point::new(from, TOP), Point::new((to - from).max(1.0), LINE - 2.0), &Paint::fill(INK));
    }
    svg.rectangle(Point::new(LEFT, top), Point::new(RIGHT - LEFT, bottom - top), &Paint::line(HAIRLINE, 1.0));
    dates(svg, look, column, bottom);
}

fn runs(list: &[bool]) -> Vec<std::ops::Range<usize>> {
    let mut at = 0;
    let mut runs = Vec::new();
    for run in list.chunk_by(|a, b| a == b) {
        if run[0] {
            runs.push(at..at + run.len());
        }
        at += run.len();
    }
    runs
}

/// A date below every so many days.
fn dates(svg: &mut Svg, look: &LogOverview, column: f64, bottom: f64) {
    let apart = (90.0 / column).ceil().max(1.0) as usize;
    for (number, date) in look.days.iter().enumerate().step_by(apart) {
        let x = LEFT + column * number as f64;
        svg.line(Point::new(x, bottom), Point::new(x, bottom + 6.0), &Paint::line(MUTED, 1.0));
        if x + 60.0 < RIGHT {
            svg.text(&date.to_string(), Point::new(x, bottom + 18.0), &AXIS);
        }
    }
}

/// One HTML page with the overview of a log: its words, its map, and its density where that is known.
pub fn look_page(look: &LogOverview, density: Option<&str>) -> String {
    let mut page = begun(&format!("What {} holds", look.name));
    for svg in std::iter::once(look_map(look).as_str()).chain(density) {
        let _ = writeln!(page, "<figure>{svg}</figure>");
    }
    let row = |sensor: &SensorLook| {
        vec![
            sensor.id.clone(),
            sensor.name.clone().unwrap_or_default(),
            sensor.kind.word().to_owned(),
            sensor.rows.to_string(),
            sensor.days.to_string(),
            sensor.first.clone(),
            sensor.last.clone(),
            sensor.in_words(),
        ]
    };
    let header = ["sensor", "name", "kind", "rows", "dates", "first", "last", "what it says"];
    table(&mut page, &header, &look.sensors.iter().map(row).collect::<Vec<_>>());
    let _ = writeln!(page, "<pre>{}</pre>\n</html>", escaped(&look.to_string()));
    page
}
