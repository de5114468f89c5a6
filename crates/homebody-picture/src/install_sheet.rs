//! Sheets for installers: the plan, the coverage, and the list of sensors with their places.

use super::coverage_map::coverage_map;
use super::floor_plan::floor_plan;
use super::font;
use super::legend::wrapped;
use super::paint::{HAIRLINE, INK, MUTED, Paint, WHITE};
use super::svg::{Svg, Type};
use homebody_analysis::coverage::SeenHome;
use homebody_analysis::parts::{Count, PartsList, SensorPart};
use homebody_core::geometry::Point;
use homebody_core::home::form::HomeFile;
use homebody_core::problem::counted;

/// A sheet of A4, as wide as those with plans, in pixels.
const SHEET: Point = Point::new(1200.0, 1697.0);
const MARGIN: f64 = 40.0;
/// Left edge of the words about a part, after a box to tick and a number.
const WORDS: f64 = MARGIN + 84.0;
const LINE: f64 = 21.0;
/// Distance of the line above a part from the middle of its first words.
const ABOVE: f64 = 20.0;
const HEAD: Type = Type::new(17.0, INK).strong();
const WORD: Type = Type::new(15.0, INK);
const NOTE: Type = Type::new(14.0, MUTED);

/// The sheets in their order: plan, coverage, and as many with parts as they need.
pub fn installing(home: &HomeFile, seen: &SeenHome, parts: &PartsList) -> Vec<String> {
    let mut pages = vec![floor_plan(home), coverage_map(&seen.home, &seen.coverage, &seen.beams())];
    pages.extend(list(parts));
    pages
}

struct PartEntry<'a> {
    part: &'a SensorPart,
    lines: Vec<(String, Type)>,
}

impl PartEntry<'_> {
    fn new(part: &SensorPart) -> PartEntry<'_> {
        let room = SHEET.x - MARGIN - WORDS;
        let mut lines = vec![(font::shortened(&part.name, HEAD.size, room), HEAD)];
        let network = if part.network.is_empty() { String::new() } else { format!(", {}", part.network) };
        let mut add = |words: &str, set: Type| {
            lines.extend(wrapped(words, set.size, room).into_iter().map(|line| (line, set)));
        };
        add(&format!("{}{network}", part.device), NOTE);
        add(&part.whereabouts(), WORD);
        if let Some(aim) = part.aim() {
            add(&aim, WORD);
        }
        PartEntry { part, lines }
    }

    fn height(&self) -> f64 {
        ABOVE + self.lines.len() as f64 * LINE
    }
}

fn list(parts: &PartsList) -> Vec<String> {
    let mut pages = Vec::new();
    let mut sheet = PartsSheet::begun(parts, 1);
    sheet.devices(&parts.devices);
    for entry in parts.parts.iter().map(PartEntry::new) {
        if sheet.y + entry.height() > SHEET.y - MARGIN {
            let next = PartsSheet::begun(parts, pages.len() + 2);
            pages.push(std::mem::replace(&mut sheet, next).svg.finish(SHEET.x, SHEET.y));
        }
        sheet.entry(&entry);
    }
    pages.push(sheet.svg.finish(SHEET.x, SHEET.y));
    pages
}

struct PartsSheet {
    svg: Svg,
    y: f64,
}

impl PartsSheet {
    fn begun(parts: &PartsList, page: usize) -> PartsSheet {
        let title = format!("{}: what goes where", parts.home);
        let sensors = counted(parts.parts.len(), "sensor", "sensors");
        let mut svg = Svg::new(&title, &format!("{sensors}, sheet {page}."));
        let shown = font::shortened(&parts.home, 28.0, SHEET.x - 2.0 * MARGIN);
        svg.text(&shown, Point::new(MARGIN, 46.0), &Type::new(28.0, INK));
        let below = format!(
            "What goes where: {sensors}, sheet {page}. Distances are measured from the faces of walls to the lens."
        );
        svg.text(&below, Point::new(MARGIN, 78.0), &Type::new(15.0, MUTED));
        PartsSheet { svg, y: 112.0 }
    }

    fn devices(&mut self, devices: &[Count]) {
        for Count { device, count } in devices {
            for line in wrapped(&format!("{count} × {device}"), WORD.size, SHEET.x - 2.0 * MARGIN) {
                self.svg.text(&line, Point::new(MARGIN, self.y), &WORD);
                self.y += LINE;
            }
        }
        self.y += 10.0;
    }

    fn entry(&mut self, entry: &PartEntry) {
        let from = Point::new(MARGIN, self.y);
        self.svg.line(from, Point::new(SHEET.x - MARGIN, self.y), &Paint::line(HAIRLINE, 1.0));
        self.y += ABOVE;
        let tick = Point::new(MARGIN, self.y - 9.0);
        self.svg.rectangle(tick, Point::splat(18.0), &Paint::fill(WHITE).outlined(INK, 1.2));
        self.svg.text(&entry.part.number.to_string(), Point::new(MARGIN + 34.0, self.y), &HEAD);
        for (line, set) in &entry.lines {
            self.svg.text(line, Point::new(WORDS, self.y), set);
            self.y += LINE;
        }
    }
}
