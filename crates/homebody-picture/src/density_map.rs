//! The density map: hours of the day from top to bottom, days from left to right, and the movement in each.

use homebody_core::geometry::Point;
use homebody_core::time::{DAY, WallTime};
use std::fmt::Write;

use super::paint::{DENSITY, HAIRLINE, INK, MUTED, Paint, QUIET, WHITE};
use super::svg::{Anchor, Px, Svg, Type};
use homebody_analysis::density::{Density, DensityCell, HourState, Map, level};

const WIDTH: f64 = 1200.0;
const LEFT: f64 = 84.0;
const RIGHT: f64 = WIDTH - 40.0;
const TOP: f64 = 150.0;
const HOUR: f64 = 20.0;
/// Distance of two maps, for dates and a title.
const BETWEEN: f64 = 110.0;
/// Width from which columns have a gap between them and a date each, as far as there is room.
const WIDE: f64 = 9.0;
const HATCH: &str = "no-data";
const AXIS: Type = Type::new(13.0, MUTED);

pub fn density_map(density: &Density) -> String {
    let maps: Vec<&Map> = [&density.of]
        .into_iter()
        .chain(density.against.as_ref().map(|against| &against.of))
        .map(|of| &of.map)
        .collect();
    let said: Vec<String> = maps.iter().map(|map| in_words(map)).collect();
    let title = "Motion density: firings of motion sensors in each hour at home";
    let mut svg = Svg::new(title, &said.join(" "));
    svg.hatch(HATCH, "#eceef0", "#c4c9cf");
    svg.text(title, Point::new(40.0, 42.0), &Type::new(24.0, INK));
    legend(&mut svg, density.step_per_h);
    let mut top = TOP;
    for (map, words) in maps.iter().zip(&said) {
        svg.text(words, Point::new(LEFT, top - 18.0), &Type::new(15.0, INK));
        draw(&mut svg, map, top, density.step_per_h);
        if let Some(words) = guesses(map) {
            svg.text(&words, Point::new(LEFT, top + 24.0 * HOUR + 62.0), &AXIS);
        }
        top += 24.0 * HOUR + BETWEEN;
    }
    svg.finish(WIDTH, top - BETWEEN + 78.0)
}

fn in_words(map: &Map) -> String {
    let last = map.days.last().map_or(map.from, |day| day.date);
    let density =
        map.density_per_h.map_or("never at home".into(), |density| format!("{density:.0} firings an hour at home"));
    format!("{}, {} to {last}: {density}, {:.1} h a day away.", map.name, map.from, map.away_h_per_day)
}

fn guesses(map: &Map) -> Option<String> {
    let count = map.absences.iter().filter(|absence| absence.is_guess).count();
    let of = match map.absences.len() {
        1 => "The absence is estimated".to_owned(),
        all if all == count => "All absences are estimated".to_owned(),
        all => format!("{count} of {all} absences are estimated"),
    };
    let why = "movement at the entrance, then no movement at home";
    (count > 0).then(|| format!("{of}: {why}."))
}

/// The colours from left to right: first those without density, then the levels with the numbers between them.
fn legend(svg: &mut Svg, step_per_h: f64) {
    const Y: f64 = 82.0;
    const BOX: Point = Point::new(54.0, 18.0);
    let words = |svg: &mut Svg, x: f64, words: &str| {
        svg.text(words, Point::new(x + 28.0 + 8.0, Y), &Type::new(13.0, INK));
    };
    let hatch = format!("url(#{HATCH})");
    for (x, fill, what) in
        [(LEFT, hatch.as_str(), "no data"), (190.0, INK, "away"), (276.0, QUIET, "at home, no firing")]
    {
        let corner = Point::new(x, Y - BOX.y / 2.0);
        svg.rectangle(corner, Point::new(28.0, BOX.y), &Paint::fill(fill).outlined(MUTED, 0.8));
        words(svg, x, what);
    }
    let left = RIGHT - BOX.x * DENSITY.len() as f64 - 60.0;
    svg.text("firings an hour", Point::new(left - 12.0, Y), &Type::new(13.0, INK).anchored(Anchor::End));
    for (place, colour) in (0_u32..).zip(DENSITY) {
        let corner = Point::new(left + BOX.x * f64::from(place), Y - BOX.y / 2.0);
        svg.rectangle(corner, BOX, &Paint::fill(colour));
        let number = Px(step_per_h * f64::from(place)).to_string();
        svg.text(&number, corner + Point::new(0.0, BOX.y + 12.0), &AXIS.anchored(Anchor::Middle));
    }
    let end = Point::new(left + BOX.x * DENSITY.len() as f64, Y + BOX.y / 2.0 + 12.0);
    svg.text("and more", end, &AXIS.anchored(Anchor::Middle));
}

fn draw(svg: &mut Svg, map: &Map, top: f64, step_per_h: f64) {
    let column = (RIGHT - LEFT) / map.cells.len().max(1) as f64;
    let bottom = top + 24.0 * HOUR;
    svg.rectangle(
        Point::new(LEFT, top),
        Point::new(RIGHT - LEFT, bottom - top),
        &Paint::fill(&format!("url(#{HATCH})")),
    );
    let fills = [INK, QUIET].into_iter().chain(DENSITY).enumerate();
    for (class, fill) in fills {
        let path = cells(map, top, column, |cell| self::class(cell, step_per_h) == Some(class));
        if !path.is_empty() {
            svg.crisp(|svg| svg.path(&path, &Paint::fill(fill).joined()));
        }
    }
    for hour in (0..=24_u32).step_by(3) {
        let y = top + HOUR * f64::from(hour);
        svg.line(Point::new(LEFT - 6.0, y), Point::new(LEFT, y), &Paint::line(MUTED, 1.0));
        svg.text(&format!("{hour:02}:00"), Point::new(LEFT - 10.0, y), &AXIS.anchored(Anchor::End));
    }
    if column >= WIDE {
        for day in 1..map.cells.len() {
            let x = LEFT + column * day as f64;
            svg.line(Point::new(x, top), Point::new(x, bottom), &Paint::line(WHITE, 1.5));
        }
    }
    svg.rectangle(Point::new(LEFT, top), Point::new(RIGHT - LEFT, bottom - top), &Paint::line(HAIRLINE, 1.0));
    dates(svg, map, bottom, column);
}

/// `None` without data, else 0 for away, 1 for no firing, and from 2 on the levels.
fn class(cell: &DensityCell, step_per_h: f64) -> Option<usize> {
    match cell.state() {
        HourState::NoData => None,
        HourState::Away => Some(0),
        HourState::Density(0.0) => Some(1),
        HourState::Density(density) => Some(2 + level(density, step_per_h)),
    }
}

/// The outlines of the cells that belong to it, hours under each other as one.
fn cells(map: &Map, top: f64, column: f64, belongs: impl Fn(&DensityCell) -> bool) -> String {
    let mut path = String::new();
    for (number, day) in (0_u32..).zip(&map.cells) {
        let (left, right) = (LEFT + column * f64::from(number), LEFT + column * f64::from(number + 1));
        let mut hour = 0_u32;
        for run in day.chunk_by(|a, b| belongs(a) == belongs(b)) {
            let from = top + HOUR * f64::from(hour);
            hour += run.len() as u32;
            if belongs(&run[0]) {
                let to = top + HOUR * f64::from(hour);
                let _ = write!(path, "M{} {}H{}V{}H{}Z", Px(left), Px(from), Px(right), Px(to), Px(left));
            }
        }
    }
    path
}

/// A name below its day: all days where there is room, else Mondays, else the first of months, else of years.
fn dates(svg: &mut Svg, map: &Map, bottom: f64, column: f64) {
    let mut free = f64::NEG_INFINITY;
    let midnight = WallTime::midnight(map.from);
    let days: Vec<_> = (0..map.cells.len() as i64).map(|number| (midnight + number * DAY).date()).collect();
    let (format, apart, takes): (&str, f64, fn(&jiff::civil::Date) -> bool) = match column {
        70.0.. => ("%a %-d %b", 70.0, |_| true),
        9.0.. => ("%-d %b", 58.0, |day| day.weekday() == jiff::civil::Weekday::Monday),
        1.0.. => ("%b %Y", 78.0, |day| day.day() == 1),
        _ => ("%Y", 60.0, |day| day.day() == 1 && day.month() == 1),
    };
    let middle = if column >= 70.0 { column / 2.0 } else { 0.0 };
    let marked = |(number, day): &(usize, &jiff::civil::Date)| takes(day) || *number == 0 && days.len() < 15;
    for (number, day) in days.iter().enumerate().filter(marked) {
        let x = LEFT + column * number as f64 + middle;
        svg.line(Point::new(x, bottom), Point::new(x, bottom + 6.0), &Paint::line(MUTED, 1.0));
        if x >= free && (column >= 70.0 || x + apart <= RIGHT + 30.0) {
            let anchor = if middle > 0.0 { Anchor::Middle } else { Anchor::Start };
            svg.text(&day.strftime(format).to_string(), Point::new(x, bottom + 20.0), &AXIS.anchored(anchor));
            free = x + apart;
        }
    }
    let (first, last) = (map.from, days.last().copied().unwrap_or(map.from));
    if column < 70.0 {
        let span = format!("{} to {}", first.strftime("%-d %B %Y"), last.strftime("%-d %B %Y"));
        svg.text(&span, Point::new((LEFT + RIGHT) / 2.0, bottom + 42.0), &AXIS.anchored(Anchor::Middle));
    } else {
        let year = first.strftime("%Y").to_string();
        svg.text(&year, Point::new((LEFT + RIGHT) / 2.0, bottom + 42.0), &AXIS.anchored(Anchor::Middle));
    }
}
