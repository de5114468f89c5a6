//! A film strip: the plan at several moments side by side, with the ways that people went in between.

use homebody_analysis::strip::{StoryStrip, StripFrame, StripPerson};
use homebody_core::geometry::{self, Point};
use homebody_core::home::form::HomeFile;
use homebody_core::plan::Plan;
use homebody_core::posture::Posture;
use homebody_core::sensors::Sensor;

use super::font;
use super::layers;
use super::paint::{FURNITURE_EDGE, HAIRLINE, INK, MUTED, Paint, SENSOR, SERIES, WHITE};
use super::sheet::{Sheet, WIDTH};
use super::svg::{Svg, Type, polyline};

const MARGIN: f64 = 40.0;
const TOP: f64 = 104.0;
const COLUMNS: usize = 3;
const GAP: f64 = 28.0;
const WIDE: f64 = (WIDTH - 2.0 * MARGIN - GAP * (COLUMNS as f64 - 1.0)) / COLUMNS as f64;
const TALLEST: f64 = 420.0;
const LINE: f64 = 16.0;
/// Distance of a plan from its words; the arrow at the front door stands there.
const BELOW: f64 = 30.0;
const BODY: f64 = 7.0;
const CAPTION: Type = Type::new(12.0, INK);
/// Largest number of lines of people in a picture (our choice).
const MOST_PEOPLE: usize = 6;

pub fn film_strip(home: &HomeFile, strip: &StoryStrip) -> String {
    let plan = Plan::new(home);
    let (least, most) = plan.bounds();
    let extent = most - least;
    let high = (WIDE / extent.x * extent.y).min(TALLEST);
    let lines = strip.moments.first().map_or(0, |moment| moment.people.len().min(MOST_PEOPLE)) + 2;
    let row = 26.0 + high + BELOW + LINE * lines as f64 + GAP;
    let subtitle = format!("{} moments, {} s apart", strip.moments.len(), strip.every_s);
    let mut svg = Svg::new(&format!("{}: {subtitle}", strip.name), &strip.to_string());
    let title = font::shortened(&strip.name, 26.0, WIDTH - 2.0 * MARGIN);
    svg.text(&title, Point::new(MARGIN, 40.0), &Type::new(26.0, INK));
    svg.text(&subtitle, Point::new(MARGIN, 70.0), &Type::new(15.0, MUTED));
    for (index, moment) in strip.moments.iter().enumerate() {
        let (column, line) = (index % COLUMNS, index / COLUMNS);
        let corner = Point::new(MARGIN + column as f64 * (WIDE + GAP), TOP + line as f64 * row);
        svg = frame(svg, home, &plan, moment, corner, high);
    }
    let end = TOP + row * strip.moments.len().div_ceil(COLUMNS) as f64;
    legend(&mut svg, end);
    svg.finish(WIDTH, end + 40.0)
}

fn frame(mut svg: Svg, home: &HomeFile, plan: &Plan, moment: &StripFrame, corner: Point, high: f64) -> Svg {
    svg.text(&moment.at, corner + Point::new(0.0, 8.0), &Type::new(14.0, INK).strong());
    let mut sheet = Sheet::in_box(svg, plan.bounds(), corner + Point::new(0.0, 26.0), Point::new(WIDE, high));
    layers::floors(&mut sheet, plan);
    layers::furniture(&mut sheet, home, &layers::FURNITURE, &layers::ENTERABLE);
    layers::walls(&mut sheet, home, plan);
    layers::doors(&mut sheet, home, plan);
    fired(&mut sheet, home, plan, &moment.fired);
    for (person, colour) in moment.people.iter().zip(colours()) {
        body(&mut sheet, person, colour);
    }
    let mut svg = sheet.svg;
    let mut y = corner.y + 26.0 + high + BELOW;
    let mut line = |svg: &mut Svg, words: &str, left: f64, set: Type| {
        svg.text(&font::shortened(words, set.size, WIDE - left), Point::new(corner.x + left, y), &set);
        y += LINE;
        y - LINE
    };
    for (person, colour) in moment.people.iter().zip(colours()).take(MOST_PEOPLE) {
        let at = line(&mut svg, &person.caption(), 16.0, CAPTION);
        svg.circle(Point::new(corner.x + 6.0, at), 4.5, &Paint::fill(colour));
    }
    for (what, list) in [("used", &moment.used), ("fired", &moment.fired)] {
        let words = if list.is_empty() { format!("nothing {what}") } else { format!("{what}: {}", list.join(", ")) };
        line(&mut svg, &words, 0.0, Type::new(12.0, MUTED));
    }
    svg
}

/// The colours of people, one after the other, without that of sensors.
fn colours() -> impl Iterator<Item = &'static str> {
    SERIES.into_iter().filter(|colour| *colour != SENSOR).cycle()
}

/// The sensors as dots: those that fired are filled, and larger.
fn fired(sheet: &mut Sheet, home: &HomeFile, plan: &Plan, fired: &[String]) {
    for sensor in &home.sensors {
        let Some(Sensor { at, .. }) = Sensor::new(sensor, plan) else { continue };
        let at = sheet.at(at);
        let has_fired = fired.iter().any(|name| name == sensor.name());
        sheet.svg.group("sensor", sensor.name(), |svg| match has_fired {
            true => svg.circle(at, 5.5, &Paint::fill(SENSOR).outlined(WHITE, 1.2)),
            false => svg.circle(at, 3.0, &Paint::fill(WHITE).outlined(SENSOR, 1.2)),
        });
    }
}

fn body(sheet: &mut Sheet, person: &StripPerson, colour: &str) {
    let path: Vec<Point> = person.path_m.iter().map(|&corner| sheet.at(geometry::point(corner))).collect();
    let Some(&at) = path.last() else { return };
    sheet.svg.group("body", &person.name, |svg| {
        svg.path(&polyline(&path), &Paint::line(colour, 2.2));
        match person.posture {
            Some(posture) => mark(svg, at, posture, colour),
            None => svg.circle(at, 2.0, &Paint::fill(colour)),
        }
    });
}

/// Standing is a disc, sitting a ring, lying a bar.
fn mark(svg: &mut Svg, at: Point, posture: Posture, colour: &str) {
    match posture {
        Posture::Standing | Posture::Bending => svg.circle(at, BODY, &Paint::fill(colour).outlined(WHITE, 1.5)),
        Posture::Sitting | Posture::Kneeling => svg.circle(at, BODY - 1.0, &Paint::fill(WHITE).outlined(colour, 3.0)),
        Posture::Lying | Posture::Down => {
            let half = Point::new(BODY + 4.0, BODY - 3.0);
            svg.rectangle(at - half, half * 2.0, &Paint::fill(colour).outlined(WHITE, 1.5));
        }
    }
}

fn legend(svg: &mut Svg, y: f64) {
    svg.line(Point::new(MARGIN, y - 14.0), Point::new(WIDTH - MARGIN, y - 14.0), &Paint::line(HAIRLINE, 1.0));
    let mut left = MARGIN;
    let mut entry = |svg: &mut Svg, words: &str, draw: &dyn Fn(&mut Svg, Point)| {
        draw(svg, Point::new(left + 12.0, y + 6.0));
        svg.text(words, Point::new(left + 32.0, y + 6.0), &Type::new(12.5, MUTED));
        left += 32.0 + font::width(words, 12.5) + 26.0;
    };
    for (words, posture) in
        [("on their feet", Posture::Standing), ("sitting", Posture::Sitting), ("lying", Posture::Lying)]
    {
        entry(svg, words, &|svg, at| mark(svg, at, posture, FURNITURE_EDGE));
    }
    entry(svg, "path since the previous moment", &|svg, at| {
        svg.line(at - Point::new(10.0, 0.0), at + Point::new(10.0, 0.0), &Paint::line(FURNITURE_EDGE, 2.2));
    });
    entry(svg, "sensor that fired since then", &|svg, at| svg.circle(at, 5.5, &Paint::fill(SENSOR)));
    entry(svg, "other sensor", &|svg, at| svg.circle(at, 3.0, &Paint::fill(WHITE).outlined(SENSOR, 1.2)));
}
