//! The layers of plans: floors, furniture, walls, doors, sensors and their names.

use homebody_core::geometry::{self, Point};
use homebody_core::home::form::HomeFile;
use homebody_core::plan::form::DoorFile;
use homebody_core::plan::{Floor, Origin, Plan, floors as floors_of, furniture_outline, span_on_wall};
use homebody_core::sensors::Sensor;
use homebody_core::sensors::form::{Mount, Shape};
use homebody_core::sensors::kinds::SensorFile;

use super::font;
use super::paint::{FLOOR, FURNITURE_EDGE, INK, MUTED, Paint, SENSOR, WALL, WHITE};
use super::sheet::Sheet;
use super::svg::{Type, polyline, rings};

/// Sizes of marks, in pixels.
const SENSOR_SIZE: f64 = 15.0;
/// An opening wider than this has no door leaf, in metres.
const WIDEST_LEAF_M: f64 = 1.3;

pub const ROOM_NAME: Type = Type { halo: true, ..Type::new(17.0, INK) };
pub const FURNITURE_NAME: Type = Type::new(12.0, MUTED);
pub const SENSOR_NAME: Type = Type { halo: true, ..Type::new(12.5, "#004f7c").strong() };

pub fn floors(sheet: &mut Sheet, plan: &Plan) {
    let outlines: Vec<_> = plan.rooms.iter().map(|room| sheet.outline(&room.outline)).collect();
    for outline in &outlines {
        sheet.svg.polygon(outline, &Paint::fill(FLOOR));
    }
    for opening in &plan.openings {
        let opening = sheet.outline(&opening.outline);
        sheet.svg.polygon(&opening, &Paint::fill(FLOOR));
    }
    // Only seen where rooms meet without a wall.
    for outline in &outlines {
        sheet.svg.polygon(outline, &Paint::line(FURNITURE_EDGE, 1.0).dashed("1 5"));
    }
}

/// Distance of a floor's frame from its rooms, in metres: walls stay inside.
const FRAME_M: f64 = 0.35;
const FLOOR_NAME: Type = Type { halo: true, ..Type::new(15.0, MUTED).strong() };

/// A frame around each floor of a home that has several, and its name above it.
pub fn frames(sheet: &mut Sheet, home: &HomeFile) {
    for Floor { name, bounds: (least, most) } in floors_of(&home.rooms) {
        let (low, high) = (sheet.at(least - FRAME_M), sheet.at(most + FRAME_M));
        let (corner, size) = (Point::new(low.x, high.y), Point::new(high.x - low.x, low.y - high.y));
        sheet.svg.rectangle(corner, size, &Paint::line(MUTED, 1.2).dashed("10 5"));
        let shown = font::shortened(&name, FLOOR_NAME.size, size.x);
        sheet.svg.text(&shown, corner - Point::new(0.0, 6.0), &FLOOR_NAME);
    }
}

pub fn furniture(sheet: &mut Sheet, home: &HomeFile, solid: &Paint, enterable: &Paint) {
    for piece in &home.furniture {
        let outline = sheet.outline(&furniture_outline(piece));
        let paint = if piece.enterable { enterable } else { solid };
        sheet.svg.polygon(&outline, paint);
        sheet.labels.soft.push(outline);
    }
}

pub const FURNITURE: Paint = Paint::fill(WHITE).outlined(FURNITURE_EDGE, 1.2);
pub const ENTERABLE: Paint = Paint::fill("#fbfaf7").outlined(FURNITURE_EDGE, 1.2).dashed("5 2.5");

pub fn walls(sheet: &mut Sheet, home: &HomeFile, plan: &Plan) {
    let mut outlines: Vec<Vec<Point>> = plan
        .solids
        .iter()
        .filter(|solid| matches!(solid.origin, Origin::Wall(_)))
        .map(|solid| sheet.outline(&solid.outline))
        .collect();
    outlines.extend(corner_posts(home).iter().map(|post| sheet.outline(post)));
    sheet.svg.path(&rings(outlines.iter().map(Vec::as_slice)), &Paint::fill(WALL).joined());
    sheet.labels.rooms = plan.rooms.iter().map(|room| sheet.outline(&room.outline)).collect();
    sheet.labels.walls.clone_from(&outlines);
    sheet.labels.solid.extend(outlines);
}

/// Of two walls that end at one point, each stops at its middle line and leaves a notch outside the
/// corner: posts that fill it, as a builder would.
fn corner_posts(home: &HomeFile) -> Vec<Vec<Point>> {
    let ends = home.walls.iter().flat_map(|wall| [(wall.from, wall.to, wall), (wall.to, wall.from, wall)]);
    let ends: Vec<_> =
        ends.map(|(end, other, wall)| (geometry::point(end), geometry::point(other), wall.thickness_m)).collect();
    let mut posts = Vec::new();
    for (i, &(end, other, thickness)) in ends.iter().enumerate() {
        let meets = |&(j, &(p, ..)): &(usize, &(Point, Point, f64))| j != i && p.distance(end) < 1e-6;
        let out = (end - other).normalize_or_zero();
        for (_, &(_, far, width)) in ends.iter().enumerate().filter(meets) {
            let across = (far - end).normalize_or_zero().dot(out).abs() < 0.2;
            posts.push(if across {
                geometry::thick_segment(end, end + out * (width / 2.0), thickness)
            } else {
                (0..16).map(|i| end + geometry::direction(f64::from(i) * 22.5) * (thickness.min(width) / 2.0)).collect()
            });
        }
    }
    posts
}

/// True if all ways in are in the west, so that the dimensions stand in the east.
pub fn ways_in_on_west(home: &HomeFile, plan: &Plan) -> bool {
    let (least, most) = plan.bounds();
    let ways_in = || home.doors.iter().filter(|door| door.outside).map(|door| door.from[0]);
    ways_in().any(|x| x - least.x < 0.5) && !ways_in().any(|x| most.x - x < 0.5)
}

/// Doors in their walls: open ones with their swing, closed ones as a bar, and arrows where one comes in.
pub fn doors(sheet: &mut Sheet, home: &HomeFile, plan: &Plan) {
    for door in &home.doors {
        let (from, to) = (geometry::point(door.from), geometry::point(door.to));
        let on_wall = home
            .walls
            .iter()
            .find(|wall| span_on_wall(geometry::point(wall.from), geometry::point(wall.to), from, to).is_some());
        let Some(wall) = on_wall else { continue };
        let across = (to - from).perp().normalize_or_zero();
        // The side a door opens to: inside, if it leads out; else where less stands in its way.
        let side = if swing_cost(plan, from, to, across) <= swing_cost(plan, from, to, -across) { 1.0 } else { -1.0 };
        let thickness = wall.thickness_m;
        if !door.open {
            let bar = geometry::thick_segment(from, to, thickness);
            let (bar, ends) = (sheet.outline(&bar), [sheet.at(from), sheet.at(to)]);
            sheet.svg.polygon(&bar, &Paint::fill(WHITE).outlined(WALL, 1.0));
            sheet.svg.line(ends[0], ends[1], &Paint::line(WALL, 2.6));
            sheet.labels.solid.push(bar);
        } else if from.distance(to) <= WIDEST_LEAF_M {
            swing(sheet, from, to, across * side, thickness);
        } else {
            for edge in [-0.5, 0.5] {
                let off = across * (edge * thickness);
                let (a, b) = (sheet.at(from + off), sheet.at(to + off));
                sheet.svg.line(a, b, &Paint::line(FURNITURE_EDGE, 1.0).dashed("4 3"));
            }
        }
        if door.outside {
            let out = if plan.is_inside((from + to) / 2.0 + across * (thickness / 2.0 + 0.1)) { -1.0 } else { 1.0 };
            way_in(sheet, door, (from + to) / 2.0 + across * (out * thickness / 2.0), across * -out);
        }
    }
}

/// A door leaf opened at a right angle, and the arc of its edge.
fn swing(sheet: &mut Sheet, hinge: Point, jamb: Point, towards: Point, thickness: f64) {
    let face = towards * (thickness / 2.0);
    let leaf = hinge + face + towards * hinge.distance(jamb);
    let steps = 24;
    let arc: Vec<Point> = (0..=steps)
        .map(|step| {
            let angle = 90.0 * f64::from(step) / f64::from(steps);
            let turned = geometry::direction(angle);
            sheet.at(hinge + face + (jamb - hinge) * turned.x + (leaf - hinge - face) * turned.y)
        })
        .collect();
    sheet.svg.path(&polyline(&arc), &Paint::line(FURNITURE_EDGE, 0.9));
    let (from, to) = (sheet.at(hinge + face), sheet.at(leaf));
    sheet.svg.line(from, to, &Paint::line(WALL, 1.8));
    let bulk = geometry::thick_segment(from, to, 4.0);
    sheet.labels.solid.push(bulk);
}

/// The area that a swinging door would cover; being out of the home counts most.
fn swing_cost(plan: &Plan, hinge: Point, jamb: Point, towards: Point) -> usize {
    let width = hinge.distance(jamb);
    let spots = (1..=9).flat_map(|angle| (1..=4).map(move |part| (f64::from(angle) * 10.0, f64::from(part) / 4.0)));
    let cost = |(angle, part): (f64, f64)| {
        let turned = geometry::direction(angle) * width * part;
        let spot = hinge + (jamb - hinge) / width * turned.x + towards * (turned.y + 0.1);
        let stands = plan.solids.iter().filter(|solid| geometry::contains(&solid.outline, spot)).count();
        stands + if plan.room_at(spot).is_none() { 20 } else { 0 }
    };
    spots.map(cost).sum()
}

/// An arrow from outside to the middle of a door, and the door's name.
fn way_in(sheet: &mut Sheet, door: &DoorFile, at: Point, inward: Point) {
    let tip = sheet.at(at) - flipped(inward) * 5.0;
    let back = tip - flipped(inward) * 14.0;
    let wing = flipped(inward).perp() * 8.0;
    let arrow = [tip, back + wing, back - wing];
    sheet.svg.polygon(&arrow, &Paint::fill(INK));
    sheet.labels.solid.push(arrow.to_vec());
    let outward_deg = (-inward.y).atan2(-inward.x).to_degrees();
    let set = Type { halo: true, ..Type::new(12.0, INK) };
    sheet.labels.beside_if_free(&door.name, (tip + back) / 2.0, outward_deg, set);
}

pub fn ceiling_areas(sheet: &mut Sheet, home: &HomeFile, fill: &str) {
    for sensor in &home.sensors {
        if let Some(area) = sensor.area_below() {
            let area = sheet.outline(&corners(area));
            sheet.svg.polygon(&area, &Paint::fill(fill).faint(0.14));
            sheet.svg.polygon(&area, &Paint::line(SENSOR, 1.6).dashed("7 4"));
            sheet.labels.soft.push(area);
        }
    }
}

pub fn mats(sheet: &mut Sheet, home: &HomeFile) {
    for sensor in &home.sensors {
        if let Some(area) = sensor.area() {
            let area = sheet.outline(&corners(area));
            sheet.svg.polygon(&area, &Paint::line(SENSOR, 1.2).dashed("2 3"));
            sheet.labels.soft.push(area);
        }
    }
}

/// Wall sensors as triangles that point ahead, ceiling sensors as rings, all others as squares.
pub fn sensors(sheet: &mut Sheet, home: &HomeFile, plan: &Plan) {
    for sensor in &home.sensors {
        let Some(Sensor { at, .. }) = Sensor::new(sensor, plan) else { continue };
        let at = sheet.at(at);
        let bulk = match sensor.row().shape {
            Shape::Arrow => {
                let triangle = dart(at, flipped(geometry::direction(facing_deg(sensor))));
                sheet.svg.group("sensor", sensor.name(), |svg| {
                    svg.polygon(&triangle, &Paint::fill(SENSOR).outlined(WHITE, 1.5));
                });
                triangle
            }
            Shape::Ring => {
                sheet.svg.group("sensor", sensor.name(), |svg| {
                    svg.circle(at, 5.5, &Paint::fill(WHITE).outlined(SENSOR, 2.0));
                    svg.circle(at, 1.8, &Paint::fill(SENSOR));
                });
                geometry::thick_segment(at - Point::new(6.5, 0.0), at + Point::new(6.5, 0.0), 13.0)
            }
            _ => {
                let (corner, size) = (at - Point::splat(4.0), Point::splat(8.0));
                sheet.svg.group("sensor", sensor.name(), |svg| {
                    svg.rectangle(corner, size, &Paint::fill(SENSOR).outlined(WHITE, 1.5));
                });
                geometry::thick_segment(at - Point::new(5.0, 0.0), at + Point::new(5.0, 0.0), 10.0)
            }
        };
        sheet.labels.solid.push(bulk);
    }
}

/// The names on the plan, the least movable first.
pub fn names(sheet: &mut Sheet, home: &HomeFile, plan: &Plan, furniture: Type) {
    for piece in &home.furniture {
        let outline = furniture_outline(piece);
        let middle = sheet.at(geometry::inner_point(&outline));
        let outline = sheet.outline(&outline);
        sheet.labels.on(&piece.name, &outline, middle, &[12.0, 11.0, 10.0], furniture);
    }
    for room in &plan.rooms {
        let middle = sheet.at(geometry::inner_point(&room.outline));
        let outline = sheet.outline(&room.outline);
        let sizes = [17.0, 15.0, 13.0, 11.0];
        if !sheet.labels.inside(&room.name, &outline, middle, &sizes, ROOM_NAME) {
            let small = Type { size: 11.0, ..ROOM_NAME };
            sheet.labels.beside(&room.name, middle, 0.0, small);
        }
    }
    for sensor in &home.sensors {
        let Some(Sensor { at, .. }) = Sensor::new(sensor, plan) else { continue };
        let at = sheet.at(at);
        sheet.labels.beside(sensor.name(), at, facing_deg(sensor), SENSOR_NAME);
    }
}

fn facing_deg(sensor: &SensorFile) -> f64 {
    let lens = sensor.orientation().filter(|_| sensor.senses_motion());
    lens.map_or(0.0, |lens| lens.facing_deg)
}

/// Samples of the marks that this home's plan shows.
pub fn explain(sheet: &mut Sheet, legend: &mut super::legend::Legend, home: &HomeFile) {
    let svg = &mut sheet.svg;
    let [wall_sensors, ceiling_sensors] =
        [Mount::Wall, Mount::Ceiling].map(|mount| home.sensors.iter().any(|sensor| sensor.row().mount == mount));
    if wall_sensors {
        legend.entry(svg, "motion sensor on the wall, points where it looks", |svg, least, most| {
            svg.polygon(&dart((least + most) / 2.0, Point::X), &Paint::fill(SENSOR).outlined(WHITE, 1.5));
        });
    }
    if ceiling_sensors {
        legend.entry(svg, "motion sensor on the ceiling, and the area it looks down on", |svg, least, most| {
            let middle = (least + most) / 2.0;
            svg.rectangle(least, most - least, &Paint::line(SENSOR, 1.6).dashed("5 3"));
            svg.circle(middle, 4.5, &Paint::fill(WHITE).outlined(SENSOR, 2.0));
        });
    }
    if home.sensors.iter().any(|sensor| !sensor.senses_motion()) {
        legend.entry(svg, "other sensor, on a thing, in a room or on the floor", |svg, least, most| {
            let middle = (least + most) / 2.0;
            svg.rectangle(middle - Point::splat(4.0), Point::splat(8.0), &Paint::fill(SENSOR).outlined(WHITE, 1.5));
        });
    }
    if home.doors.iter().any(|door| door.open) {
        legend.entry(svg, "open door", |svg, least, most| {
            let (hinge, radius) = (Point::new(least.x + 4.0, most.y), most.y - least.y);
            let arc: Vec<Point> =
                (0..=12).map(|step| hinge + flipped(geometry::direction(f64::from(step) * 7.5)) * radius).collect();
            svg.path(&polyline(&arc), &Paint::line(FURNITURE_EDGE, 0.9));
            svg.line(hinge, hinge - Point::new(0.0, radius), &Paint::line(WALL, 1.8));
        });
    }
    if home.doors.iter().any(|door| !door.open) {
        legend.entry(svg, "closed door", |svg, least, most| {
            let (y, size) = ((least.y + most.y) / 2.0, Point::new(most.x - least.x, 8.0));
            svg.rectangle(Point::new(least.x, y - 4.0), size, &Paint::fill(WHITE).outlined(WALL, 1.0));
            svg.line(Point::new(least.x, y), Point::new(most.x, y), &Paint::line(WALL, 2.6));
        });
    }
    if home.doors.iter().any(|door| door.outside) {
        legend.entry(svg, "way in from outside", |svg, least, most| {
            let middle = (least + most) / 2.0;
            let (back, wing) = (Point::new(-7.0, 0.0), Point::new(0.0, 8.0));
            svg.polygon(
                &[middle + Point::new(7.0, 0.0), middle + back + wing, middle + back - wing],
                &Paint::fill(INK),
            );
        });
    }
    if home.furniture.iter().any(|piece| !piece.enterable) {
        legend.entry(svg, "furniture", |svg, least, most| svg.rectangle(least, most - least, &FURNITURE));
    }
    if home.furniture.iter().any(|piece| piece.enterable) {
        legend.entry(svg, "furniture that people get on or into", |svg, least, most| {
            svg.rectangle(least, most - least, &ENTERABLE);
        });
    }
}

/// A triangle that points ahead; its notched back tells the point from the other corners.
pub fn dart(at: Point, ahead: Point) -> Vec<Point> {
    let ahead = ahead * SENSOR_SIZE;
    let (back, wing) = (at - ahead * 0.45, ahead.perp() * 0.52);
    vec![at + ahead * 0.85, back + wing, at - ahead * 0.2, back - wing]
}

fn corners(area: &[[f64; 2]]) -> Vec<Point> {
    area.iter().map(|&at| geometry::point(at)).collect()
}

/// A direction of the plan on the sheet, where y points down.
fn flipped(direction: Point) -> Point {
    direction * Point::new(1.0, -1.0)
}
