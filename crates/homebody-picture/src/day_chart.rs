//! One day from left to right: what residents did and where they were as bands, and below them what each sensor said.
//!
//! Its input is plain data, so that a day which is only planned can be drawn as well: bands without ticks.

use homebody_analysis::day::{DayRecord, ResidentDay, SensorDay};
use homebody_core::activity::{AWAY, ActivityKind};
use homebody_core::geometry::Point;
use homebody_core::sensors::form::Colour;
use std::fmt::Write;

use super::chart::heading;
use super::font;
use super::paint::{FLOOR, HAIRLINE, INK, MUTED, Paint, WALL, WHITE};
use super::svg::{Anchor, Px, Svg, Type};

/// The content of a chart of a day. Times are seconds since its midnight; times outside the day are cut off.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DayChart {
    pub title: String,
    pub bands: Vec<DayBand>,
    pub ticks: Vec<Ticks>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Ticks {
    pub sensor: String,
    /// The spans of its ON state; a firing has no length.
    pub spans: Vec<(f64, f64)>,
    /// The number of spans that began on the day.
    pub firings: u64,
}

#[derive(Clone, Debug, PartialEq)]
pub struct DayBand {
    pub name: String,
    /// The kind of its labels.
    pub holds: BandContent,
    pub spans: Vec<(f64, f64, String)>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BandContent {
    /// Labels of activities, which are coloured by their kind.
    Activities,
    Rooms,
}

/// True for a name of a visitor, such as `margaret's daughter`.
fn is_visitor(name: &str, names: &[&str]) -> bool {
    names.iter().any(|host| name.strip_prefix(host).is_some_and(|rest| rest.starts_with("'s ")))
}

impl DayChart {
    /// The chart of a day of a log or a simulation.
    pub fn new(day: &DayRecord) -> DayChart {
        let mut bands = Vec::new();
        let names: Vec<&str> = day.residents.iter().filter_map(|resident| resident.name.as_deref()).collect();
        for ResidentDay { name, activities, rooms } in &day.residents {
            // A visitor's day elsewhere is not of this home.
            let is_visitor = name.as_deref().is_some_and(|name| is_visitor(name, &names));
            let name = name.as_deref().unwrap_or("activities");
            for (name, holds, stretches) in [
                (name.to_owned(), BandContent::Activities, activities),
                (format!("{name}: room"), BandContent::Rooms, rooms),
            ] {
                let here = stretches.iter().filter(|part| !is_visitor || part.what != AWAY);
                let spans: Vec<_> = here.map(|part| (part.begin_s, part.end_s, part.what.clone())).collect();
                if !spans.is_empty() {
                    bands.push(DayBand { name, holds, spans });
                }
            }
        }
        let ticks = day.sensors.iter().map(|SensorDay { sensor, spans_s, firings, .. }| Ticks {
            sensor: sensor.clone(),
            spans: spans_s.clone(),
            firings: *firings,
        });
        let title = format!("{}: {}", day.name, day.date.strftime("%A %-d %B %Y"));
        DayChart { title, bands, ticks: ticks.collect() }
    }
}

const WIDTH: f64 = 1200.0;
const LEFT: f64 = 210.0;
const RIGHT: f64 = WIDTH - 80.0;
const TOP: f64 = 138.0;
const BAND: f64 = 30.0;
/// Height of a band with upright names, which are too wide for their spans.
const TALL: f64 = 84.0;
const LABEL: f64 = 12.0;
const ROW: f64 = 19.0;
const DAY_S: f64 = 86_400.0;
const NAME: Type = Type::new(13.0, INK);
const AXIS: Type = Type::new(13.0, MUTED);

pub fn day_chart(day: &DayChart) -> String {
    let words = in_words(day);
    let mut svg = Svg::new(&day.title, &words);
    heading(&mut svg, &font::shortened(&day.title, 24.0, WIDTH - 80.0), &words);
    legend(&mut svg, day);
    let bands: f64 = day.bands.iter().map(height).sum();
    let gap = if day.bands.is_empty() || day.ticks.is_empty() { 0.0 } else { 16.0 };
    let bottom = TOP + bands + gap + ROW * day.ticks.len() as f64;
    hours(&mut svg, bottom);
    let mut y = TOP;
    for band in &day.bands {
        draw_band(&mut svg, band, y);
        y += height(band);
    }
    y += gap;
    if !day.ticks.is_empty() {
        let above = Point::new(WIDTH - 12.0, y - 8.0);
        svg.text("firings", above, &Type::new(12.0, MUTED).anchored(Anchor::End));
    }
    for (number, ticks) in (0_u32..).zip(&day.ticks) {
        draw_ticks(&mut svg, ticks, y + ROW * f64::from(number));
    }
    svg.finish(WIDTH, bottom + 46.0)
}

fn in_words(day: &DayChart) -> String {
    let activities = day.bands.iter().filter(|band| band.holds == BandContent::Activities);
    let activities: usize = activities.map(|band| band.spans.len()).sum();
    let firings: u64 = day.ticks.iter().map(|ticks| ticks.firings).sum();
    let counted = |count: u64, one: &str, more: &str| format!("{count} {}", if count == 1 { one } else { more });
    let activities = (!day.bands.is_empty()).then(|| counted(activities as u64, "activity", "activities"));
    let ticks = (!day.ticks.is_empty()).then(|| {
        let sensors = counted(day.ticks.len() as u64, "sensor", "sensors");
        format!("{} of {sensors}", counted(firings, "firing", "firings"))
    });
    activities.into_iter().chain(ticks).collect::<Vec<_>>().join(", ")
}

fn legend(svg: &mut Svg, day: &DayChart) {
    let bands = day.bands.iter().filter(|band| band.holds == BandContent::Activities);
    let there: Vec<ActivityKind> =
        bands.flat_map(|band| &band.spans).map(|(_, _, label)| ActivityKind::from_name(label)).collect();
    let mut x = 40.0;
    for kind in ActivityKind::ALL.into_iter().filter(|kind| there.contains(kind)) {
        svg.rectangle(Point::new(x, 94.0), Point::new(22.0, 14.0), &Paint::fill(colour(kind).0));
        svg.text(kind.in_words(), Point::new(x + 29.0, 101.0), &NAME);
        x += 29.0 + font::width(kind.in_words(), NAME.size) + 22.0;
    }
}

/// The colour of a kind, and of a text on it.
fn colour(kind: ActivityKind) -> (&'static str, &'static str) {
    match kind.colour() {
        Some(Colour::Blue) => ("#0072b2", WHITE),
        Some(Colour::Sky) => ("#56b4e9", INK),
        Some(Colour::Orange) => ("#e69f00", INK),
        Some(Colour::Purple) => ("#cc79a7", INK),
        Some(Colour::Green) => ("#009e73", INK),
        Some(Colour::Vermillion) => ("#d55e00", INK),
        Some(Colour::Yellow) => ("#f0e442", INK),
        None => ("#000000", WHITE),
    }
}

/// The hours as lines behind all, named above and below.
fn hours(svg: &mut Svg, bottom: f64) {
    for hour in 0..=24_u32 {
        let x = x_of(f64::from(hour) * 3600.0);
        let strong = hour.is_multiple_of(6);
        let line = if strong { Paint::line(HAIRLINE, 1.4) } else { Paint::line("#e3e6e9", 0.8) };
        svg.line(Point::new(x, TOP - 4.0), Point::new(x, bottom), &line);
        if hour.is_multiple_of(2) {
            let words = format!("{hour:02}:00");
            for y in [TOP - 13.0, bottom + 16.0] {
                svg.text(&words, Point::new(x, y), &AXIS.anchored(Anchor::Middle));
            }
        }
    }
}

fn draw_band(svg: &mut Svg, band: &DayBand, top: f64) {
    let height = height(band);
    name(svg, &band.name, top + height / 2.0);
    for (begin_s, end_s, label) in &band.spans {
        let Some((from, to)) = within(*begin_s, *end_s) else { continue };
        let (fill, ink) = match band.holds {
            BandContent::Activities => colour(ActivityKind::from_name(label)),
            BandContent::Rooms => (FLOOR, INK),
        };
        let edge = if band.holds == BandContent::Rooms { HAIRLINE } else { WHITE };
        let (corner, size) = (Point::new(from, top + 3.0), Point::new((to - from).max(1.2), height - 6.0));
        // An edge would hide a span as narrow as itself.
        let paint = if size.x > 3.0 { Paint::fill(fill).outlined(edge, 0.8) } else { Paint::fill(fill) };
        svg.rectangle(corner, size, &paint);
        let words = label.replace('_', " ");
        let set = Type::new(LABEL, ink).anchored(Anchor::Middle);
        if fits(&words, size.x) {
            svg.text(&words, corner + size / 2.0, &set);
        } else if stands(size.x) {
            let words = font::shortened(&words, LABEL, size.y - 6.0);
            svg.text(&words, corner + size / 2.0, &Type { upright: true, ..set });
        }
    }
}

fn height(band: &DayBand) -> f64 {
    let spans = band.spans.iter().filter_map(|(begin_s, end_s, label)| Some((within(*begin_s, *end_s)?, label)));
    let mut wide = spans.map(|((from, to), label)| (to - from, label.replace('_', " ")));
    if wide.any(|(room, words)| !fits(&words, room) && stands(room)) { TALL } else { BAND }
}

fn fits(words: &str, room: f64) -> bool {
    room > LABEL && font::width(words, LABEL) <= room - 8.0
}

fn stands(room: f64) -> bool {
    room >= LABEL + 1.0
}

/// The spans of a sensor in one path, and its number of firings to the right.
fn draw_ticks(svg: &mut Svg, ticks: &Ticks, top: f64) {
    let Ticks { sensor, spans, firings } = ticks;
    name(svg, sensor, top + ROW / 2.0);
    svg.line(Point::new(LEFT, top + ROW), Point::new(RIGHT, top + ROW), &Paint::line("#e3e6e9", 0.6));
    let mut path = String::new();
    let mut drawn = f64::NEG_INFINITY;
    for &(begin_s, end_s) in spans {
        let Some((from, to)) = within(begin_s, end_s) else { continue };
        let to = to.max(from + 1.0);
        // A tick within the last one would not be seen.
        if to > drawn + 0.1 {
            let (from, low, high) = (from.max(drawn.min(to)), top + ROW - 3.0, top + 3.0);
            let _ = write!(path, "M{} {}H{}V{}H{}Z", Px(from), Px(low), Px(to), Px(high), Px(from));
            drawn = to;
        }
    }
    if !path.is_empty() {
        svg.path(&path, &Paint::fill(WALL).joined());
    }
    let ink = if *firings == 0 { MUTED } else { INK };
    svg.text(
        &firings.to_string(),
        Point::new(WIDTH - 12.0, top + ROW / 2.0),
        &Type::new(12.0, ink).anchored(Anchor::End),
    );
}

fn name(svg: &mut Svg, words: &str, y: f64) {
    let words = font::shortened(words, NAME.size, LEFT - 40.0);
    svg.text(&words, Point::new(LEFT - 14.0, y), &NAME.anchored(Anchor::End));
}

fn x_of(at_s: f64) -> f64 {
    LEFT + (RIGHT - LEFT) * at_s / DAY_S
}

/// The part of a span that is within the day, in pixels.
fn within(begin_s: f64, end_s: f64) -> Option<(f64, f64)> {
    let is_in = end_s >= 0.0 && begin_s < DAY_S && begin_s <= end_s;
    is_in.then(|| (x_of(begin_s.max(0.0)), x_of(end_s.min(DAY_S))))
}
