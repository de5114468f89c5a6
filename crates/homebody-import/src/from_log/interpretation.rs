//! The room and purpose of each sensor of a log: by the user's table, by its name, by the activities during its
//! firings, and last by the sensors that fire before and after it.

use super::words::{ACTIVITY_SITES, ActivitySite, ROOM_KINDS, RoomKind, RoomThing};
use super::{LogSensor, LogWay, Speaks};
use crate::names::clean;
use homebody_core::names::words;
use std::collections::BTreeMap;

#[derive(Clone, Debug)]
pub struct LogRoom {
    pub name: String,
    pub kind: &'static RoomKind,
    /// False for a room that is only added because a home needs it.
    pub is_in_log: bool,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SensorAim {
    /// Its whole room.
    Area,
    /// A part of its room that is larger than a thing.
    Wide,
    /// A thing in it, or the floor before it.
    Thing(&'static RoomThing),
    Door,
    /// The way out of the home.
    FrontDoor,
    /// Some spot on the floor.
    Spot,
}

/// The rooms of a log, and by sensor its room and aim.
#[derive(Debug)]
pub struct Interpretation {
    pub rooms: Vec<LogRoom>,
    pub sensors: Vec<(usize, SensorAim)>,
    pub guesses: Vec<String>,
}

/// Smallest share of a sensor's events during one kind of activity that assigns its room (our choice).
const LEAST_SHARE: f64 = 0.25;
/// Number of firings below which activities do not assign a sensor's room (our choice).
const LEAST_FIRINGS: u64 = 40;
/// Time and share of ways within which two sensors see a person at once, and are therefore in one room (our choice).
const AT_ONCE_S: f64 = 0.3;
const AT_ONCE_SHARE: f64 = 0.38;
/// Share of its ways that lead to one room if a sensor is in that room (our choice).
const BELONGS_SHARE: f64 = 0.7;
/// Words of names without information on a place.
const NOISE: &str = "area sensor motion pir detector contact occupancy binary mag ceiling wall all whole room m d";
/// Words that distinguish rooms of one kind.
const APART: &str = "main master guest front back second first upstairs downstairs left right small large spare";

struct NameParts {
    room: Option<(&'static RoomKind, String)>,
    rest: Vec<String>,
}

fn is_one_of(known: &str, word: &str) -> bool {
    known.split(' ').any(|known| known == word)
}

fn name_parts(name: &str) -> NameParts {
    let words = words(name);
    let hit = (0..words.len()).find_map(|at| {
        let long = (1..=3usize).rev().filter(|count| at + count <= words.len());
        long.filter_map(|count| {
            let phrase = words[at..at + count].join(" ");
            let kind = ROOM_KINDS.iter().find(|kind| kind.words.contains(&phrase.as_str()))?;
            Some((at, count, kind))
        })
        .next()
    });
    let Some((at, count, kind)) = hit else { return NameParts { room: None, rest: words } };
    let is_apart = |word: &String| is_one_of(APART, word);
    let begin = (0..at).rev().take_while(|&before| is_apart(&words[before])).last().unwrap_or(at);
    let is_number = |word: &String| word.parse::<u32>().is_ok() || word.len() == 1;
    let end = at + count + usize::from(words.get(at + count).is_some_and(is_number));
    let label = words[begin..end].join(" ");
    let rest = words[..begin].iter().chain(&words[end..]).cloned().collect();
    NameParts { room: Some((kind, label)), rest }
}

#[derive(Default)]
struct RoomList(Vec<LogRoom>);

impl RoomList {
    fn named(&mut self, kind: &'static RoomKind, name: &str) -> usize {
        let name = clean(name);
        let known = self.0.iter().position(|room| room.name.to_lowercase() == name.to_lowercase());
        known.unwrap_or_else(|| {
            self.0.push(LogRoom { name, kind, is_in_log: true });
            self.0.len() - 1
        })
    }

    fn room_of_kind(&mut self, kind: &'static RoomKind) -> usize {
        match self.0.iter().position(|room| *room.kind == *kind) {
            Some(known) => known,
            None => self.named(kind, kind.name),
        }
    }
}

/// # Errors
///
/// The ids of the sensors without a room.
pub fn interpret(sensors: &[LogSensor], ways: &[LogWay]) -> Result<Interpretation, Vec<String>> {
    let mut rooms = RoomList::default();
    let mut guesses = Vec::new();
    let mut placed: Vec<Option<(usize, SensorAim)>> =
        sensors.iter().map(|sensor| by_name(sensor, &mut rooms)).collect();
    let by_activities = by_activities(sensors, ways, &mut placed, &mut rooms);
    by_ways(sensors, ways, &mut placed, &mut rooms);
    let unknown: Vec<String> = sensors
        .iter()
        .zip(&placed)
        .filter(|(_, placed)| placed.is_none())
        .map(|(sensor, _)| sensor.id.clone())
        .collect();
    if !unknown.is_empty() {
        return Err(unknown);
    }
    let mut placed: Vec<(usize, SensorAim)> = placed.into_iter().flatten().collect();
    if by_activities {
        guesses.push(
            "rooms of sensors without names are guessed: from what was done there, and from who follows whom".into(),
        );
    }
    choose_door_sides(sensors, ways, &mut placed);
    several_spots(&rooms.0, sensors, &mut placed);
    Ok(Interpretation { rooms: renamed(rooms.0), sensors: placed, guesses })
}

/// The room and aim of a sensor by its name and by the user's table.
fn by_name(sensor: &LogSensor, rooms: &mut RoomList) -> Option<(usize, SensorAim)> {
    let own = name_parts(&sensor.id);
    let said = sensor.room.as_deref().filter(|room| !room.trim().is_empty());
    let room = match said {
        Some(name) => Some((name_parts(name).room.map_or(RoomKind::named("room"), |(kind, _)| kind), name.to_owned())),
        None => own.room,
    };
    let rest = sensor.place.as_deref().map_or(own.rest, |place| {
        let place = name_parts(place);
        // A place may have the name of a room: the bath in a bathroom.
        place.room.map(|(_, label)| words(&label)).into_iter().flatten().chain(place.rest).collect()
    });
    let kind = room.as_ref().map(|(kind, _)| *kind);
    let what = aim(sensor, &rest, kind);
    let room = match (room, what) {
        (Some((kind, name)), _) => rooms.named(kind, &name),
        (None, Some(SensorAim::Thing(thing))) => rooms.room_of_kind(RoomKind::named(thing.home)),
        (None, Some(SensorAim::FrontDoor)) => rooms.room_of_kind(RoomKind::named("entry")),
        (None, _) => return None,
    };
    Some((room, what.unwrap_or(SensorAim::Spot)))
}

/// The aim of a sensor by the other words of its name.
fn aim(sensor: &LogSensor, rest: &[String], room: Option<&'static RoomKind>) -> Option<SensorAim> {
    let has = |wanted: &[&str]| rest.iter().any(|word| wanted.contains(&word.as_str()));
    let is_outside = has(&["front", "outside", "outer", "main", "exterior", "frontdoor", "apartment"]);
    let is_entry = room.is_some_and(|room| room.name == "entry");
    let is_door = has(&["door", "doorway", "frontdoor", "threshold"]);
    let thing = || RoomThing::from_words(rest, room).map(SensorAim::Thing);
    match sensor.speaks {
        _ if is_door && (is_outside || is_entry) => Some(SensorAim::FrontDoor),
        Speaks::Contact => thing().or(is_door.then_some(SensorAim::Door)).or(is_entry.then_some(SensorAim::FrontDoor)),
        Speaks::Motion if is_door => Some(SensorAim::Door),
        Speaks::Motion => {
            let says_nothing = rest.iter().all(|word| is_one_of(NOISE, word) || word.parse::<u32>().is_ok());
            match thing() {
                None if says_nothing && room.is_some() => Some(SensorAim::Area),
                other => other,
            }
        }
    }
}

/// Assigns rooms to sensors by the activities during their firings, together for all that see a person at once; true if
/// it assigned any.
fn by_activities(
    sensors: &[LogSensor],
    ways: &[LogWay],
    placed: &mut [Option<(usize, SensorAim)>],
    rooms: &mut RoomList,
) -> bool {
    let mut of_room: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for together in at_once(sensors, ways, placed) {
        let Some(site) = prevailing(sensors, &together) else { continue };
        let room = rooms.room_of_kind(RoomKind::named(site.room.unwrap_or("entry")));
        for number in together {
            placed[number] = Some((room, nameless(&sensors[number])));
            of_room.entry(room).or_default().push(number);
        }
    }
    for (&room, numbers) in &of_room {
        at_their_things(sensors, numbers, rooms.0[room].kind, placed);
    }
    !of_room.is_empty()
}

/// Aims the sensor of a room that fires most during an activity at its thing.
fn at_their_things(sensors: &[LogSensor], here: &[usize], room: &RoomKind, placed: &mut [Option<(usize, SensorAim)>]) {
    // The activities of such rooms come first; people rest and eat in any room.
    let is_seat = |thing: &RoomThing| thing.enterable && thing.home != room.name && SEATS.contains(&thing.name);
    for own in [true, false] {
        let sites = ACTIVITY_SITES.iter().filter_map(|site| Some((site, RoomThing::named(site.at)?)));
        let sites = sites.filter(|(site, thing)| if own { site.room == Some(room.name) } else { is_seat(thing) });
        let counts = sites.flat_map(|(site, thing)| {
            here.iter().map(move |&number| (firings_at(&sensors[number], site.at), thing, number))
        });
        let mut counts: Vec<(u64, &'static RoomThing, usize)> =
            counts.filter(|(count, ..)| *count >= LEAST_FIRINGS / 4).collect();
        counts.sort_by_key(|(count, ..)| std::cmp::Reverse(*count));
        for (_, thing, number) in counts {
            let is_taken =
                here.iter().any(|&other| placed[other].is_some_and(|(_, what)| what == SensorAim::Thing(thing)));
            let is_free = sensors[number].speaks == Speaks::Motion
                && placed[number].is_some_and(|(_, what)| what == SensorAim::Spot);
            if is_free && !is_taken {
                placed[number] = placed[number].map(|(room, _)| (room, SensorAim::Thing(thing)));
            }
        }
    }
}

/// Seats for any room.
const SEATS: [&str; 3] = ["armchair", "dining chair", "desk chair"];

/// The sensors without a room, grouped by those that see a person at once.
fn at_once(sensors: &[LogSensor], ways: &[LogWay], placed: &[Option<(usize, SensorAim)>]) -> Vec<Vec<usize>> {
    let all =
        |sensor: usize| ways.iter().filter(|way| way.other(sensor).is_some()).map(|way| way.times).sum::<u64>() as f64;
    let mut group: Vec<usize> = (0..sensors.len()).collect();
    for way in ways.iter().filter(|way| way.soon_s <= AT_ONCE_S) {
        let [a, b] = way.between;
        let is_much = way.times as f64 >= AT_ONCE_SHARE * all(a).min(all(b));
        if is_much && placed[a].is_none() && placed[b].is_none() && way.times >= LEAST_FIRINGS {
            let (kept, joined) = (group[a], group[b]);
            group.iter_mut().filter(|of| **of == joined).for_each(|of| *of = kept);
        }
    }
    let mut groups: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for number in (0..sensors.len()).filter(|&number| placed[number].is_none()) {
        groups.entry(group[number]).or_default().push(number);
    }
    groups.into_values().collect()
}

/// Firings of a sensor during the activities at a thing.
fn firings_at(sensor: &LogSensor, at: &str) -> u64 {
    sensor
        .done
        .iter()
        .filter(|(label, _)| ActivitySite::from_label(label).is_some_and(|site| site.at == at))
        .map(|(_, count)| count)
        .sum()
}

/// The site of the activity with most firings of these sensors.
fn prevailing(sensors: &[LogSensor], together: &[usize]) -> Option<&'static ActivitySite> {
    let mut of_room: BTreeMap<Option<&str>, (u64, &'static ActivitySite)> = BTreeMap::new();
    let firings: u64 = together.iter().map(|&number| sensors[number].firings).sum();
    for (label, count) in together.iter().flat_map(|&number| &sensors[number].done) {
        if let Some(site) = ActivitySite::from_label(label) {
            of_room.entry(site.room).or_insert((0, site)).0 += count;
        }
    }
    let (count, site) = of_room.into_values().max_by_key(|(count, _)| *count)?;
    (firings >= LEAST_FIRINGS && count as f64 >= LEAST_SHARE * firings as f64).then_some(site)
}

/// The aim of a sensor by a name of CASAS, which only gives its kind: `MA` sees an area.
fn nameless(sensor: &LogSensor) -> SensorAim {
    match (sensor.speaks, words(&sensor.id).first().map(String::as_str)) {
        (Speaks::Contact, _) if firings_at(sensor, "front door") > 0 => SensorAim::FrontDoor,
        (Speaks::Contact, _) => RoomThing::named("drawers").map_or(SensorAim::Spot, SensorAim::Thing),
        (_, Some("ma")) => SensorAim::Area,
        _ => SensorAim::Spot,
    }
}

/// Assigns the remaining sensors: to the room at the other end of nearly all ways, or to a passage of their own.
fn by_ways(sensors: &[LogSensor], ways: &[LogWay], placed: &mut [Option<(usize, SensorAim)>], rooms: &mut RoomList) {
    if placed.iter().all(Option::is_none) {
        return;
    }
    loop {
        let next = (0..sensors.len()).filter(|&number| placed[number].is_none()).find_map(|number| {
            let mut to: BTreeMap<Option<usize>, u64> = BTreeMap::new();
            for way in ways {
                if let Some(other) = way.other(number) {
                    *to.entry(placed[other].map(|(room, _)| room)).or_insert(0) += way.times;
                }
            }
            let all: u64 = to.values().sum();
            let (room, times) = to.into_iter().max_by_key(|(_, times)| *times)?;
            (times as f64 >= BELONGS_SHARE * all as f64).then_some((number, room?))
        });
        let Some((number, room)) = next else { break };
        placed[number] = Some((room, nameless(&sensors[number])));
    }
    let left: Vec<usize> = (0..sensors.len()).filter(|&number| placed[number].is_none()).collect();
    for &number in left.iter().filter(|&&number| ways.iter().any(|way| way.other(number).is_some())) {
        let hall = rooms.room_of_kind(RoomKind::named("hall"));
        placed[number] = Some((hall, nameless(&sensors[number])));
    }
}

/// A motion sensor at a door is on the side with the next firings.
fn choose_door_sides(sensors: &[LogSensor], ways: &[LogWay], placed: &mut [(usize, SensorAim)]) {
    let before = placed.to_vec();
    for (number, (room, what)) in placed.iter_mut().enumerate() {
        if *what != SensorAim::Door || sensors[number].speaks != Speaks::Motion || sensors[number].at.is_some() {
            continue;
        }
        let mut to: BTreeMap<usize, u64> = BTreeMap::new();
        for way in ways {
            if let Some((other_room, other)) = way.other(number).map(|other| before[other])
                && other != SensorAim::Door
            {
                *to.entry(other_room).or_insert(0) += way.times;
            }
        }
        let best = to.iter().max_by_key(|(_, times)| **times);
        if let Some((&best, _)) = best.filter(|(_, times)| **times > to.get(room).copied().unwrap_or(0)) {
            *room = best;
        }
    }
}

/// In a passage, each of several sensors sees a part of the way. Of several sensors over one room, the one with most
/// firings sees all of it.
fn several_spots(rooms: &[LogRoom], sensors: &[LogSensor], placed: &mut [(usize, SensorAim)]) {
    for (room, LogRoom { kind, .. }) in rooms.iter().enumerate() {
        let is_here = |number: &usize| placed[*number].0 == room && sensors[*number].speaks == Speaks::Motion;
        let here: Vec<usize> = (0..placed.len()).filter(is_here).collect();
        let is_area = |number: &&usize| placed[**number].1 == SensorAim::Area;
        let mut areas: Vec<usize> = here.iter().filter(is_area).copied().collect();
        areas.sort_by_key(|&number| std::cmp::Reverse(sensors[number].firings));
        let is_parted = kind.is_way && here.len() > 1;
        for number in areas.into_iter().skip(usize::from(!is_parted)) {
            let is_code = name_parts(&sensors[number].id).room.is_none();
            placed[number].1 = if kind.is_way && !is_code { SensorAim::Spot } else { SensorAim::Wide };
        }
    }
}

/// A letter or a number at the end of a room's name is dropped if no other room is of its kind.
fn renamed(mut rooms: Vec<LogRoom>) -> Vec<LogRoom> {
    for number in 0..rooms.len() {
        let has_sibling =
            rooms.iter().enumerate().any(|(other, room)| other != number && *room.kind == *rooms[number].kind);
        if let Some((name, last)) = rooms[number].name.rsplit_once(' ')
            && !has_sibling
            && (last.len() == 1 || last.parse::<u32>().is_ok())
        {
            rooms[number].name = name.to_owned();
        }
    }
    rooms
}

#[cfg(test)]
mod tests {
    use super::*;

    fn motion(id: &str) -> LogSensor {
        LogSensor::new(id, Speaks::Motion, 100)
    }

    fn way(a: usize, b: usize, times: u64) -> LogWay {
        LogWay { between: [a, b], times, soon_s: 1.0 }
    }

    fn rooms_and_aims(sensors: &[LogSensor], ways: &[LogWay]) -> Vec<(String, String)> {
        let interpretation = interpret(sensors, ways).unwrap();
        let what = |what: SensorAim| match what {
            SensorAim::Thing(thing) => thing.name.to_owned(),
            other => format!("{other:?}"),
        };
        interpretation.sensors.iter().map(|&(room, of)| (interpretation.rooms[room].name.clone(), what(of))).collect()
    }

    #[test]
    fn names_decide_rooms_and_things() {
        let wanted = [
            ("BedroomAArea", "bedroom a", "Area"),
            ("BedroomABed", "bedroom a", "bed"),
            ("BedroomBArea", "bedroom b", "Area"),
            ("BathroomASink", "bathroom", "washbasin"),
            ("KitchenADiningChair", "kitchen", "dining chair"),
            ("MainEntryway", "main entryway", "Area"),
            ("HallwayA", "hallway", "Area"),
            ("OfficeAChair", "office", "desk chair"),
            ("living room armchair motion", "living room", "armchair"),
            ("stove", "kitchen", "stove"),
        ];
        let told = rooms_and_aims(&wanted.map(|(id, ..)| motion(id)), &[]);
        assert_eq!(told, wanted.map(|(_, room, what)| (room.to_owned(), what.to_owned())));
    }

    #[test]
    fn activities_and_ways_decide_about_nameless_sensors() {
        let done = |id: &str, label: &str| LogSensor { done: vec![(label.into(), 80)], ..motion(id) };
        let sensors = [
            done("M1", "Sleep"),
            done("M2", "Cook"),
            motion("M3"),
            motion("MA4"),
            LogSensor { speaks: Speaks::Contact, ..done("D1", "Leave_Home") },
        ];
        // M3 lies between both, MA4 is next to the bed.
        let told = rooms_and_aims(&sensors, &[way(0, 2, 50), way(1, 2, 50), way(0, 3, 90), way(2, 3, 5)]);
        let wanted =
            [("bedroom", "bed"), ("kitchen", "stove"), ("hall", "Spot"), ("bedroom", "Area"), ("entry", "FrontDoor")];
        assert_eq!(told.iter().map(|(room, what)| (room.as_str(), what.as_str())).collect::<Vec<_>>(), wanted);
    }

    #[test]
    fn a_sensor_at_a_door_is_on_the_side_of_the_next_firing() {
        let sensors = ["BedroomArea", "BedroomDoor", "Hallway"].map(motion);
        assert_eq!(rooms_and_aims(&sensors, &[way(0, 1, 10), way(1, 2, 90)])[1].0, "hallway");
        assert_eq!(rooms_and_aims(&sensors, &[way(0, 1, 90), way(1, 2, 10)])[1].0, "bedroom");
    }

    #[test]
    fn unknown_sensors_are_named() {
        assert_eq!(interpret(&["M1", "Kitchen", "M2"].map(motion), &[]).unwrap_err(), ["M1", "M2"]);
    }
}
