//! The coverage map: how many sensors see each place of a home, and where none does.

use homebody_core::geometry::{self, Point};
use homebody_core::home::form::HomeFile;
use homebody_core::plan::Plan;

use super::label::Block;
use super::layers;
use super::legend::Legend;
use super::paint::{DEAD, DEAD_GROUND, DEAD_TEXT, FURNITURE_EDGE, INK, MUTED, Paint, SEEN, SENSOR, WHITE};
use super::shade;
use super::sheet::Sheet;
use super::svg::{Anchor, Svg, Type, polyline, rings};
use homebody_analysis::coverage::{Coverage, CoverageGrid, LEAST_DEAD_ZONE_M2, SeenFloor};

/// Number of rows of a table in the legend.
const MOST_ROWS: usize = 20;
const HATCH: &str = "unseen";
/// The numbers written on floor that one, two and more sensors see, and the smallest piece of floor with a number.
const COUNTS: [&str; 3] = ["1", "2", "3+"];
const NUMBERED_M2: f64 = 0.4;
const COUNT: Type = Type { halo: true, ..Type::new(13.0, INK) };

/// Draws coverage over its home, as SVG. A beam is the index of its sensor in the home's list, and its
/// two ends on the plan.
pub fn coverage_map(home: &HomeFile, coverage: &Coverage, beams: &[(usize, Point, Point)]) -> String {
    let plan = Plan::new(home);
    let subtitle = "Coverage: how many motion sensors see a person who moves";
    let mut sheet = Sheet::new(&home.name, subtitle, &in_words(coverage), plan.bounds());
    sheet.svg.hatch(HATCH, DEAD_GROUND, DEAD);
    layers::frames(&mut sheet, home);
    layers::floors(&mut sheet, &plan);
    let dead = shades(&mut sheet, coverage);
    layers::furniture(
        &mut sheet,
        home,
        &Paint::fill(WHITE).outlined(FURNITURE_EDGE, 1.0),
        &Paint::line(MUTED, 1.0).dashed("5 2.5"),
    );
    beam_lines(&mut sheet, home, beams);
    layers::ceiling_areas(&mut sheet, home, "none");
    for (outline, zone) in dead.iter().zip(1..) {
        sheet.svg.group("dead-zone", &zone.to_string(), |svg| svg.path(outline, &Paint::line(DEAD_TEXT, 1.6)));
    }
    layers::walls(&mut sheet, home, &plan);
    sheet.dimensions(layers::ways_in_on_west(home, &plan));
    layers::doors(&mut sheet, home, &plan);
    layers::sensors(&mut sheet, home, &plan);
    dead_zone_numbers(&mut sheet, coverage);
    layers::names(&mut sheet, home, &plan, Type { halo: true, ..Type::new(12.0, INK) });
    counts(&mut sheet, coverage);
    sheet.labels.draw(&mut sheet.svg);

    let end = legend(&mut sheet, coverage, !beams.is_empty());
    sheet.finish(end)
}

/// The floor by the number of sensors that see it; returns the outlines of the dead zones.
fn shades(sheet: &mut Sheet, coverage: &Coverage) -> Vec<String> {
    let grid = &coverage.grid;
    let class = |cell: usize| class(grid, cell);
    let hatch = format!("url(#{HATCH})");
    let mut dead = Vec::new();
    for (watchers, fill) in [hatch.as_str(), SEEN[0], SEEN[1], SEEN[2]].into_iter().enumerate() {
        let mut whole = String::new();
        let mut regions = grid.regions(|cell| class(cell) == watchers + 1);
        // In the order in which dead zones are numbered.
        regions.sort_by_key(|region| std::cmp::Reverse(region.cells.len()));
        for region in regions {
            let shape = shade::smooth(grid, &region, &class);
            let shape: Vec<Vec<Point>> = shape.iter().map(|ring| sheet.outline(ring)).collect();
            let shape = rings(shape.iter().map(Vec::as_slice));
            whole += &shape;
            if watchers == 0 && grid.area_m2(&region) >= LEAST_DEAD_ZONE_M2 {
                dead.push(shape);
            }
        }
        sheet.svg.group("seen-by", &watchers.to_string(), |svg| {
            svg.path(&whole, &Paint::fill(fill).outlined(WHITE, 0.8));
        });
    }
    dead
}

/// Zero where people cannot be, else one more than the sensors that see it, four standing for three and more.
fn class(grid: &CoverageGrid, cell: usize) -> usize {
    grid.watchers(cell).map_or(0, |watchers| 1 + watchers.min(3))
}

/// The number of sensors, written on each larger piece that they see.
fn counts(sheet: &mut Sheet, coverage: &Coverage) {
    let grid = &coverage.grid;
    for (watchers, words) in COUNTS.into_iter().enumerate().map(|(index, words)| (index + 1, words)) {
        for region in grid.regions(|cell| class(grid, cell) == watchers + 1) {
            let belongs = |cell: &usize| region.cells.binary_search(cell).is_ok();
            let deepest = [grid.deepest(&region)].into_iter().filter(|_| grid.area_m2(&region) >= NUMBERED_M2);
            let inner = region.cells.iter().copied().filter(|&cell| grid.near(cell, 4).all(|near| belongs(&near)));
            let spots = deepest.chain(inner).filter(|cell| grid.near(*cell, 2).all(|near| belongs(&near)));
            let spots: Vec<Point> = spots.map(|cell| sheet.at(grid.middle(cell))).collect();
            sheet.labels.at_first(words, &spots, COUNT);
        }
    }
}

fn beam_lines(sheet: &mut Sheet, home: &HomeFile, beams: &[(usize, Point, Point)]) {
    for (index, sensor) in home.sensors.iter().enumerate() {
        let own = beams.iter().filter(|(of, ..)| *of == index);
        let path: String = own.map(|&(_, from, to)| polyline(&[sheet.at(from), sheet.at(to)])).collect();
        if !path.is_empty() {
            sheet.svg.group("beams", sensor.name(), |svg| svg.path(&path, &Paint::line(INK, 0.7).faint(0.26)));
        }
    }
}

/// A numbered badge on each dead zone, with its area if there is space; the legend has the area, too.
fn dead_zone_numbers(sheet: &mut Sheet, coverage: &Coverage) {
    for zone in &coverage.dead_zones {
        let at = sheet.at(geometry::point(zone.middle));
        let set = Type { halo: true, ..Type::new(12.0, DEAD_TEXT).strong() };
        badge(&mut sheet.svg, at, zone.number);
        sheet.labels.take(Block::around(at, Point::splat(17.0)));
        sheet.labels.beside_if_free(&format!("{:.2}\u{a0}m²", zone.area_m2), at, 0.0, set);
    }
}

fn badge(svg: &mut Svg, at: Point, number: usize) {
    svg.circle(at, 8.5, &Paint::fill(WHITE).outlined(DEAD_TEXT, 1.6));
    let set = Type::new(if number < 10 { 12.0 } else { 10.0 }, DEAD_TEXT).strong();
    svg.text(&number.to_string(), at, &set.anchored(Anchor::Middle));
}

fn legend(sheet: &mut Sheet, coverage: &Coverage, with_beams: bool) -> f64 {
    let svg = &mut sheet.svg;
    let mut legend = Legend::new();
    explain(svg, &mut legend, coverage, with_beams);
    tables(svg, &mut legend, coverage);
    let note = format!(
        "The colours cover the floor on which a body of {}\u{a0}m radius can stand: {:.1}\u{a0}m² ± {:.1}\u{a0}m².",
        coverage.body_radius_m, coverage.whole.floor_m2, coverage.whole.floor_error_m2
    );
    legend.note(svg, &note);
    legend.end()
}

fn explain(svg: &mut Svg, legend: &mut Legend, coverage: &Coverage, with_beams: bool) {
    legend.heading(svg, "Walkable floor seen by");
    let hatch = format!("url(#{HATCH})");
    let seen = &coverage.whole.seen_by;
    let classes = [
        ("no sensor", "", seen.none, hatch.as_str()),
        ("one sensor", COUNTS[0], seen.one, SEEN[0]),
        ("two sensors", COUNTS[1], seen.two, SEEN[1]),
        ("three or more", COUNTS[2], seen.three_or_more, SEEN[2]),
    ];
    for (words, count, share, fill) in classes {
        legend.entry(svg, &format!("{words}: {:.1} %", 100.0 * share), |svg, least, most| {
            svg.rectangle(least, most - least, &Paint::fill(fill).outlined(MUTED, 0.8));
            svg.text(count, (least + most) / 2.0, &COUNT.anchored(Anchor::Middle));
        });
    }
    if with_beams {
        legend.entry(svg, "sensor and its beams", |svg, least, most| {
            let lens = Point::new(least.x + 4.0, (least.y + most.y) / 2.0);
            for end in [least.y, lens.y, most.y] {
                svg.line(lens, Point::new(most.x, end), &Paint::line(INK, 0.7).faint(0.5));
            }
            svg.polygon(&layers::dart(lens, Point::X), &Paint::fill(SENSOR));
        });
    }
}

fn tables(svg: &mut Svg, legend: &mut Legend, coverage: &Coverage) {
    const COLUMN: f64 = 60.0;
    let head = Type::new(12.0, MUTED);
    let row = Type::new(12.5, INK);
    legend.heading(svg, "Rooms");
    legend.row(svg, "", &["floor m²".into(), "unseen".into()], COLUMN, head);
    let numbers =
        |floor: &SeenFloor| [format!("{:.1}", floor.floor_m2), format!("{:.1} %", 100.0 * floor.seen_by.none)];
    for room in coverage.rooms.iter().take(MOST_ROWS) {
        legend.row(svg, &room.name, &numbers(room), COLUMN, row);
    }
    more(svg, legend, coverage.rooms.len());
    if let Some(doorways) = &coverage.doorways {
        legend.row(svg, &doorways.name, &numbers(doorways), COLUMN, row);
    }
    legend.row(svg, &coverage.whole.name, &numbers(&coverage.whole), COLUMN, row.strong());
    if !coverage.sensors.is_empty() {
        legend.heading(svg, "Sensors");
        legend.row(svg, "", &["sees m²".into(), "alone m²".into()], COLUMN, head);
        for sensor in coverage.sensors.iter().take(MOST_ROWS) {
            let numbers = [format!("{:.1}", sensor.seen_m2), format!("{:.1}", sensor.alone_m2)];
            legend.row(svg, &sensor.name, &numbers, COLUMN, row);
        }
        more(svg, legend, coverage.sensors.len());
    }
    if !coverage.dead_zones.is_empty() {
        legend.heading(svg, "Dead zones");
        for zone in coverage.dead_zones.iter().take(MOST_ROWS) {
            let name = format!("{}  {}", zone.number, zone.room.as_deref().unwrap_or("doorway"));
            legend.row(svg, &name, &[format!("{:.2} m²", zone.area_m2)], COLUMN, row);
        }
        more(svg, legend, coverage.dead_zones.len());
    }
}

fn more(svg: &mut Svg, legend: &mut Legend, rows: usize) {
    if rows > MOST_ROWS {
        legend.note(svg, &format!("and {} more", rows - MOST_ROWS));
    }
}

fn in_words(coverage: &Coverage) -> String {
    let seen = &coverage.whole.seen_by;
    let [none, one, two, more] = [seen.none, seen.one, seen.two, seen.three_or_more].map(|share| 100.0 * share);
    format!(
        "Of {:.1} square metres of walkable floor, {none:.1} % are seen by no sensor, {one:.1} % by one, {two:.1} % \
         by two, {more:.1} % by three or more. Dead zones: {}.",
        coverage.whole.floor_m2,
        coverage.dead_zones.len()
    )
}
