//! Assembles a schematic home.

use super::arrangement::{RoomNeed, arrange};
use super::doors::{DoorGap, between, out};
use super::interpretation::{Interpretation, LogRoom, SensorAim, interpret};
use super::measured_rooms::rectangles;
use super::pieces::{NeededPiece, pieces};
use super::placement::{Placement, PlacementSite, placed};
use super::sensors::{Furnished, make, place_sensors};
use super::shape::{Rect, rounded};
use super::{LogSensor, LogWay};
use crate::error::ImportError;
use crate::names::{NamePool, clean};
use crate::{SCHEMA, soundness};
use homebody_core::geometry::Point;
use homebody_core::home::form::HomeFile;
use homebody_core::plan::form::{DoorFile, FurnitureFile, RoomFile, WallFile};
use homebody_core::problem::counted;
use std::collections::{BTreeMap, BTreeSet};

#[derive(Clone, Debug, PartialEq)]
pub struct Schematic {
    pub home_json: String,
    /// By sensor of the home, its id in the log.
    pub ids: BTreeMap<String, String>,
    /// Duration of an ON, if the log has OFF.
    pub hold_s: Option<f64>,
    pub remarks: Vec<String>,
}

homebody_core::messages! {
    /// Errors of making a home from a log.
    #[derive(Clone, PartialEq, Eq)]
    pub enum SchematicError in "home-from-log" {
        /// Homebody places rooms by the sensors of movement and of doors in them. The log has none.
        NoSensors error "no-sensors" ("no sensor of the log detects movement or doors")
            hint ("give a log of motion sensors or contacts");
        /// The names of these sensors have no room in them, and no table gives one:
        ///
        /// ```text
        /// id,room,place
        /// M001,hall,front door
        /// ```
        UnknownRooms(sensors: Vec<String>) error "no-rooms-of-sensors"
            ("cannot find the rooms of {count}: {names}", count = counted(sensors.len(), "sensor", "sensors"), names = listed(sensors))
            hint ("list them with their rooms: --sensors FILE, a table with the columns id, room and place");
        /// Homebody places up to this number of rooms next to each other, because the time that it needs grows fast with their number.
        TooManyRooms(rooms: usize) error "too-many-rooms" ("the sensors are in {rooms} rooms, and Homebody places at most {MOST_ROOMS}")
            hint ("give several sensors the same room: --sensors FILE");
        /// The home must pass the same check as a home that is written by hand.
        Unsound(reason: String) error "unsound" ("the log does not give a valid home: {reason}")
            hint ("list its sensors with other rooms: --sensors FILE");
    }
}

/// Largest number of rooms that are arranged (our choice): the time grows steeply.
pub const MOST_ROOMS: usize = 40;

/// Largest number of names in a list (our choice).
const LISTED: usize = 12;

/// Area of floor that each thing in a room takes, with the free floor before it (our choice).
const THING_TAKES_M2: f64 = 2.0;
/// Width of a way, and its length beyond its sensors (our choice).
const WAY_WIDE_M: f64 = 1.4;
const WAY_BEYOND_M: f64 = 1.6;
/// Walking speed along a way (our choice).
const PACE_MPS: f64 = 0.8;
/// Factor on the size of a room if a thing does not fit, and largest number of times that it is applied (our choice).
const LARGER: f64 = 1.35;
const ROUNDS: usize = 5;
/// Thickness of outer and inner walls (our choice).
const OUTER_WALL_M: f64 = 0.2;
const INNER_WALL_M: f64 = 0.1;

fn listed(names: &[String]) -> String {
    let more = if names.len() > LISTED { " and others" } else { "" };
    names.iter().take(LISTED).map(String::as_str).collect::<Vec<_>>().join(", ") + more
}

/// Makes a home with this name from a log. `about` is its description.
pub fn schematic(name: &str, about: &str, sensors: &[LogSensor], ways: &[LogWay]) -> Result<Schematic, SchematicError> {
    if sensors.is_empty() {
        return Err(SchematicError::NoSensors);
    }
    let mut interpretation = interpret(sensors, ways).map_err(SchematicError::UnknownRooms)?;
    let is_measured = sensors.iter().any(|sensor| sensor.at.is_some());
    let told = interpretation.rooms.len();
    let pieces = pieces(&mut interpretation, sensors);
    if interpretation.rooms.len() > MOST_ROOMS {
        return Err(SchematicError::TooManyRooms(told));
    }
    let mut larger = vec![1.0; interpretation.rooms.len()];
    let mut laid = lay_out(&interpretation, (sensors, ways), &pieces, &larger)?;
    for _ in 0..ROUNDS {
        let without = (0..pieces.len()).filter(|&piece| laid.places.pieces[piece].is_none());
        let rooms: BTreeSet<usize> = without.map(|piece| pieces[piece].room).collect();
        if rooms.is_empty() || is_measured {
            break;
        }
        rooms.into_iter().for_each(|room| larger[room] *= LARGER);
        laid = lay_out(&interpretation, (sensors, ways), &pieces, &larger)?;
    }
    let mut remarks = std::mem::take(&mut interpretation.guesses);
    if is_measured {
        remarks.push("walls are drawn half way between the sensors of two rooms: move them to where they are".into());
    }
    let AssembledHome { mut home, ids, hold_s } = put_together(&interpretation, sensors, laid, &pieces, &mut remarks);
    home.name = Some(clean(name)).filter(|name| !name.is_empty()).unwrap_or_else(|| "home".to_owned());
    home.about = about.to_owned();
    let home_json = soundness::text(home, &mut remarks).map_err(|error| match error {
        ImportError::Unsound(why) => SchematicError::Unsound(why),
        other => SchematicError::Unsound(other.to_string()),
    })?;
    Ok(Schematic { home_json, ids, hold_s, remarks })
}

struct HomeLayout {
    rects: Vec<Rect>,
    walls: Vec<(Point, Point)>,
    doors: Vec<DoorGap>,
    places: Placement,
}

/// Lays rooms out, each enlarged by its factor, and places everything.
fn lay_out(
    interpretation: &Interpretation,
    (sensors, ways): (&[LogSensor], &[LogWay]),
    pieces: &[NeededPiece],
    larger: &[f64],
) -> Result<HomeLayout, SchematicError> {
    let outs = ways_out(interpretation, sensors);
    let rects = match sensors.iter().any(|sensor| sensor.at.is_some()) {
        true => measured(interpretation, sensors, pieces)?,
        false => {
            // Daily ways count more than rare ones, but not a hundred times.
            let ties = between_rooms(interpretation, ways, |way| (way.times as f64).sqrt());
            let mut wanted = room_areas(interpretation, ways, pieces, outs.first().copied());
            wanted.iter_mut().zip(larger).for_each(|(room, larger)| room.area_m2 *= larger);
            arrange(&wanted, &ties)
        }
    };
    let metric = |at: Point| Point::from(rounded(at.into()));
    let rects: Vec<Rect> =
        rects.iter().map(|rect| Rect { least: metric(rect.least), most: metric(rect.most) }).collect();
    let is_way: Vec<bool> = interpretation.rooms.iter().map(|room| room.kind.is_way).collect();
    let times = between_rooms(interpretation, ways, |way| way.times as f64);
    let mut doors = between(&rects, &times, &is_way);
    doors.extend(out(&rects, &outs));
    let site = PlacementSite { sensors, ways, what: &interpretation.sensors, rects: &rects, doors: &doors, pieces };
    let places = placed(&site);
    Ok(HomeLayout { walls: walls(&rects), rects, doors, places })
}

/// By two rooms, the sum of the weights of their ways.
fn between_rooms(interpretation: &Interpretation, ways: &[LogWay], counts: impl Fn(&LogWay) -> f64) -> Vec<Vec<f64>> {
    let mut sums = vec![vec![0.0; interpretation.rooms.len()]; interpretation.rooms.len()];
    for way in ways {
        let [a, b] = way.between.map(|sensor| interpretation.sensors[sensor].0);
        if a != b {
            sums[a][b] += counts(way);
            sums[b][a] += counts(way);
        }
    }
    sums
}

/// The rooms that may have the way out, the likeliest first.
fn ways_out(interpretation: &Interpretation, sensors: &[LogSensor]) -> Vec<usize> {
    let has_contact =
        |room: usize| interpretation.sensors.iter().any(|&(of, what)| of == room && what == SensorAim::FrontDoor);
    let at_silence = |room: usize| -> u64 {
        sensors
            .iter()
            .zip(&interpretation.sensors)
            .filter(|(_, (of, _))| *of == room)
            .map(|(sensor, _)| sensor.at_silence)
            .sum()
    };
    let rank = |room: &usize| {
        let LogRoom { name, kind, is_in_log } = &interpretation.rooms[*room];
        let is_front = name.split(' ').any(|word| ["main", "front"].contains(&word));
        let place = match kind.name {
            _ if has_contact(*room) => 0,
            "entry" if is_front => 1,
            "entry" => 2,
            "bedroom" | "bathroom" | "toilet" | "closet" => 5,
            _ if *is_in_log => 3,
            _ => 4,
        };
        (place, std::cmp::Reverse(at_silence(*room)))
    };
    let mut rooms: Vec<usize> = (0..interpretation.rooms.len()).collect();
    rooms.sort_by_key(rank);
    rooms
}

fn room_areas(
    interpretation: &Interpretation,
    ways: &[LogWay],
    pieces: &[NeededPiece],
    way_out: Option<usize>,
) -> Vec<RoomNeed> {
    let of = |(number, room): (usize, &LogRoom)| {
        let things = pieces.iter().filter(|piece| piece.room == number).map(|piece| {
            let [width, depth] = piece.thing.size_m;
            width * depth + THING_TAKES_M2
        });
        let usual = room.kind.area_m2.max(things.sum::<f64>());
        let area_m2 = if room.kind.is_way { usual.max(way_area(interpretation, ways, number)) } else { usual };
        RoomNeed { area_m2, is_way: room.kind.is_way, has_way_out: way_out == Some(number) }
    };
    interpretation.rooms.iter().enumerate().map(of).collect()
}

/// The area of a passage with its sensors in a row.
fn way_area(interpretation: &Interpretation, ways: &[LogWay], room: usize) -> f64 {
    let is_here = |sensor: &usize| {
        interpretation.sensors[*sensor].0 == room && interpretation.sensors[*sensor].1 != SensorAim::Area
    };
    let here: Vec<usize> = (0..interpretation.sensors.len()).filter(is_here).collect();
    let mut inner: Vec<&LogWay> = ways.iter().filter(|way| way.between.iter().all(|end| here.contains(end))).collect();
    inner.sort_by_key(|way| std::cmp::Reverse(way.times));
    let mut group: Vec<usize> = here.clone();
    let mut length_m = 0.0;
    for way in inner {
        let [a, b] = way.between.map(|end| here.iter().position(|one| *one == end).map_or(end, |place| group[place]));
        if a != b {
            group.iter_mut().filter(|of| **of == b).for_each(|of| *of = a);
            length_m += (way.soon_s * PACE_MPS).clamp(1.0, 3.0);
        }
    }
    (length_m + WAY_BEYOND_M) * WAY_WIDE_M
}

/// The walls of rooms in a rectangle, each drawn once.
fn walls(rects: &[Rect]) -> Vec<(Point, Point)> {
    /// By position of a line, the spans of its walls.
    type Lines = BTreeMap<i64, Vec<(f64, f64)>>;
    let (mut upright, mut level) = (Lines::new(), Lines::new());
    let key = |at: f64| (at * 100.0).round() as i64;
    for (from, to) in rects.iter().flat_map(Rect::sides) {
        match key(from.x) == key(to.x) {
            true => upright.entry(key(from.x)).or_default().push((from.y, to.y)),
            false => level.entry(key(from.y)).or_default().push((from.x, to.x)),
        }
    }
    let joined = |mut spans: Vec<(f64, f64)>| {
        spans.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut joined: Vec<(f64, f64)> = Vec::new();
        for (from, to) in spans {
            match joined.last_mut() {
                Some(last) if from <= last.1 + 0.005 => last.1 = last.1.max(to),
                _ => joined.push((from, to)),
            }
        }
        joined
    };
    let at = |key: i64| key as f64 / 100.0;
    let upright = upright.into_iter().flat_map(|(x, spans)| {
        joined(spans).into_iter().map(move |(from, to)| (Point::new(at(x), from), Point::new(at(x), to)))
    });
    let level = level.into_iter().flat_map(|(y, spans)| {
        joined(spans).into_iter().map(move |(from, to)| (Point::new(from, at(y)), Point::new(to, at(y))))
    });
    upright.chain(level).collect()
}

/// Rooms around measured sensors; rooms without one share the largest of the others.
fn measured(
    interpretation: &Interpretation,
    sensors: &[LogSensor],
    pieces: &[NeededPiece],
) -> Result<Vec<Rect>, SchematicError> {
    let mut places: Vec<Vec<Point>> = vec![Vec::new(); interpretation.rooms.len()];
    for (sensor, &(room, _)) in sensors.iter().zip(&interpretation.sensors) {
        places[room].extend(sensor.at);
    }
    let mut rects = rectangles(&places);
    let area = |rect: Rect| rect.size().x * rect.size().y;
    for room in 0..rects.len() {
        if rects[room].is_none() {
            let needs = pieces.iter().filter(|piece| piece.room == room).count();
            let known = rects.iter().enumerate().filter_map(|(room, rect)| Some((room, (*rect)?)));
            let largest = known.max_by(|a, b| area(a.1).total_cmp(&area(b.1)));
            let Some((from, rect)) = largest else { continue };
            let is_upright = rect.size().x > rect.size().y;
            // The end of the shared room that is farthest from its own sensors.
            let share = if needs > 1 { 0.4 } else { 0.3 };
            let at = rect.least + rect.size() * share;
            let [first, second] = super::shape::cut(&rect, is_upright, if is_upright { at.x } else { at.y });
            (rects[room], rects[from]) = (Some(first), Some(second));
        }
    }
    let rects: Option<Vec<Rect>> = rects.into_iter().collect();
    rects.ok_or_else(|| SchematicError::Unsound("no sensor has a place on the image".into()))
}

struct AssembledHome {
    home: HomeFile,
    ids: BTreeMap<String, String>,
    hold_s: Option<f64>,
}

fn put_together(
    interpretation: &Interpretation,
    sensors: &[LogSensor],
    laid: HomeLayout,
    pieces: &[NeededPiece],
    remarks: &mut Vec<String>,
) -> AssembledHome {
    let HomeLayout { rects, walls, doors, places } = laid;
    let mut names = NamePool::default();
    let rooms: Vec<LogRoom> = interpretation
        .rooms
        .iter()
        .map(|room| LogRoom { name: names.give(&room.name, "room"), ..room.clone() })
        .collect();
    let stand = |piece: usize| places.pieces[piece].is_some();
    let no_room: Vec<String> =
        (0..pieces.len()).filter(|&piece| !stand(piece)).map(|piece| pieces[piece].thing.name.to_owned()).collect();
    if !no_room.is_empty() {
        remarks.push(format!("for these there is no space in their rooms: {}", listed(&no_room)));
    }
    let piece_names: Vec<Option<String>> =
        (0..pieces.len()).map(|piece| stand(piece).then(|| names.give(pieces[piece].thing.name, "piece"))).collect();
    let mut door_names = NamePool::default();
    let named = |door: DoorGap| {
        let name = match door.rooms {
            [Some(a), Some(b)] => format!("{} to {}", rooms[a].name, rooms[b].name),
            _ => "front door".to_owned(),
        };
        (door_names.give(&name, "door"), door)
    };
    let doors: Vec<(String, DoorGap)> = doors.into_iter().map(named).collect();
    let home =
        Furnished { rooms: &rooms, rects: &rects, doors: &doors, pieces, piece_names: &piece_names, places: &places };
    let make = make(sensors);
    let (hung, left) = place_sensors(sensors, &interpretation.sensors, &home, make);
    if !left.is_empty() {
        remarks.push(format!("for these sensors there is no place: {}", listed(&left)));
    }
    let ids = hung.iter().map(|(file, id)| (file.name().to_owned(), id.clone())).collect();
    let outer = Rect::around_all(&rects);
    let is_outer = |(from, to): &(Point, Point)| {
        let side = |a: f64, b: f64, of: [f64; 2]| a == b && of.contains(&a);
        side(from.x, to.x, [outer.least.x, outer.most.x]) || side(from.y, to.y, [outer.least.y, outer.most.y])
    };
    let at = |p: Point| rounded(p.into());
    let wall = |ends: (Point, Point)| WallFile {
        from: at(ends.0),
        to: at(ends.1),
        thickness_m: if is_outer(&ends) { OUTER_WALL_M } else { INNER_WALL_M },
    };
    let door = |(name, door): (String, DoorGap)| {
        let outside = door.rooms[1].is_none();
        DoorFile { name, from: at(door.from), to: at(door.to), open: !outside, shut_behind: false, outside }
    };
    let furniture = pieces.iter().zip(&piece_names).zip(&places.pieces).filter_map(|((piece, name), stands)| {
        let rect = stands.as_ref()?.rect;
        Some(FurnitureFile {
            name: name.clone()?,
            at: Some(at(rect.middle())),
            size_m: Some(at(rect.size())),
            turn_deg: 0.0,
            outline: None,
            height_m: piece.thing.height_m,
            enterable: piece.thing.enterable,
            role: piece.thing.role,
        })
    });
    let room = |(room, rect): (&LogRoom, &Rect)| RoomFile::new(&room.name, rect.corners());
    let home = HomeFile {
        schema: Some(SCHEMA.to_owned()),
        rooms: rooms.iter().zip(&rects).map(room).collect(),
        walls: walls.into_iter().map(wall).collect(),
        doors: doors.into_iter().map(door).collect(),
        furniture: furniture.collect(),
        sensors: hung.into_iter().map(|(file, _)| file).collect(),
        ..HomeFile::new("")
    };
    AssembledHome { home, ids, hold_s: make.hold_s }
}
