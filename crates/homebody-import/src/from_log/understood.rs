//! What each sensor of a log is, and in which room: by what somebody says of it, by its name, by what was done as it spoke, and
//! last by which sensors speak before and after it.

use super::words::{DEEDS, Deed, ROOM_KINDS, RoomKind, Thing};
use super::{LogSensor, LogWay, Speaks};
use crate::names::clean;
use homebody_core::names::words;
use std::collections::BTreeMap;

/// A room that a log tells of.
#[derive(Clone, Debug)]
pub struct Room {
    pub name: String,
    pub kind: &'static RoomKind,
    /// Whether somebody has drawn or named it, or it is only what a home needs besides.
    pub is_told: bool,
}

/// What a sensor looks at, or hangs on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum What {
    /// Its whole room.
    Area,
    /// A part of its room that is larger than a thing.
    Wide,
    /// A thing in it, or the floor before it.
    Thing(&'static Thing),
    /// The door to the room that it has most to do with.
    Door,
    /// The way out of the home.
    FrontDoor,
    /// Some spot on the floor.
    Spot,
}

/// The rooms of a log, and of each sensor its room and what it is for.
#[derive(Debug)]
pub struct Understood {
    pub rooms: Vec<Room>,
    /// By sensor.
    pub sensors: Vec<(usize, What)>,
    /// What was guessed, a sentence each.
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
/// Words of names that tell nothing of a place.
const NOISE: [&str; 16] = [
    "area",
    "sensor",
    "motion",
    "pir",
    "detector",
    "contact",
    "occupancy",
    "binary",
    "mag",
    "ceiling",
    "wall",
    "all",
    "whole",
    "room",
    "m",
    "d",
];
/// Words that tell rooms of one kind apart.
const APART: [&str; 14] = [
    "main",
    "master",
    "guest",
    "front",
    "back",
    "second",
    "first",
    "upstairs",
    "downstairs",
    "left",
    "right",
    "small",
    "large",
    "spare",
];

/// What the words of a name tell: a room, and the words besides.
struct Told {
    room: Option<(&'static RoomKind, String)>,
    rest: Vec<String>,
}

fn told(name: &str) -> Told {
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
    let Some((at, count, kind)) = hit else { return Told { room: None, rest: words } };
    let is_apart = |word: &String| APART.contains(&word.as_str());
    let begin = (0..at).rev().take_while(|&before| is_apart(&words[before])).last().unwrap_or(at);
    let is_number = |word: &String| word.parse::<u32>().is_ok() || word.len() == 1;
    let end = at + count + usize::from(words.get(at + count).is_some_and(is_number));
    let label = words[begin..end].join(" ");
    let rest = words[..begin].iter().chain(&words[end..]).cloned().collect();
    Told { room: Some((kind, label)), rest }
}

/// The rooms while they are found.
#[derive(Default)]
struct Rooms(Vec<Room>);

impl Rooms {
    /// The room of a name, a new one if there is none.
    fn of_name(&mut self, kind: &'static RoomKind, name: &str) -> usize {
        let name = clean(name);
        let known = self.0.iter().position(|room| room.name.to_lowercase() == name.to_lowercase());
        known.unwrap_or_else(|| {
            self.0.push(Room { name, kind, is_told: true });
            self.0.len() - 1
        })
    }

    /// A room of a kind, a new one if there is none.
    fn of_kind(&mut self, kind: &'static RoomKind) -> usize {
        match self.0.iter().position(|room| *room.kind == *kind) {
            Some(known) => known,
            None => self.of_name(kind, kind.name),
        }
    }
}

/// What the sensors of a log are; those of which nothing tells where they are.
pub fn understand(sensors: &[LogSensor], ways: &[LogWay]) -> Result<Understood, Vec<String>> {
    let mut rooms = Rooms::default();
    let mut guesses = Vec::new();
    let mut placed: Vec<Option<(usize, What)>> = sensors.iter().map(|sensor| by_name(sensor, &mut rooms)).collect();
    let by_deeds = by_deeds(sensors, ways, &mut placed, &mut rooms);
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
    let mut placed: Vec<(usize, What)> = placed.into_iter().flatten().collect();
    if by_deeds {
        guesses.push(
            "rooms of sensors without names are guessed: from what was done there, and from who follows whom".into(),
        );
    }
    settle_doors(sensors, ways, &mut placed);
    several_spots(&rooms.0, sensors, &mut placed);
    Ok(Understood { rooms: renamed(rooms.0), sensors: placed, guesses })
}

/// What a sensor is by its name and what somebody says of it.
fn by_name(sensor: &LogSensor, rooms: &mut Rooms) -> Option<(usize, What)> {
    let own = told(&sensor.id);
    let said = sensor.room.as_deref().filter(|room| !room.trim().is_empty());
    let room = match said {
        Some(name) => Some((told(name).room.map_or(RoomKind::named("room"), |(kind, _)| kind), name.to_owned())),
        None => own.room,
    };
    let rest = sensor.place.as_deref().map_or(own.rest, |place| {
        let place = told(place);
        // A place may be called as a room is: the bath in a bathroom.
        place.room.map(|(_, label)| words(&label)).into_iter().flatten().chain(place.rest).collect()
    });
    let kind = room.as_ref().map(|(kind, _)| *kind);
    let what = what(sensor, &rest, kind);
    let room = match (room, what) {
        (Some((kind, name)), _) => rooms.of_name(kind, &name),
        (None, Some(What::Thing(thing))) => rooms.of_kind(RoomKind::named(thing.home)),
        (None, Some(What::FrontDoor)) => rooms.of_kind(RoomKind::named("entry")),
        (None, _) => return None,
    };
    Some((room, what.unwrap_or(What::Spot)))
}

/// What a sensor is for, by the words beside its room; nothing where they do not tell.
fn what(sensor: &LogSensor, rest: &[String], room: Option<&'static RoomKind>) -> Option<What> {
    let has = |wanted: &[&str]| rest.iter().any(|word| wanted.contains(&word.as_str()));
    let is_outside = has(&["front", "outside", "outer", "main", "exterior", "frontdoor", "apartment"]);
    let is_entry = room.is_some_and(|room| room.name == "entry");
    let is_door = has(&["door", "doorway", "frontdoor", "threshold"]);
    let thing = || Thing::of(rest, room).map(What::Thing);
    match sensor.speaks {
        _ if is_door && (is_outside || is_entry) => Some(What::FrontDoor),
        Speaks::Contact => thing().or(is_door.then_some(What::Door)).or(is_entry.then_some(What::FrontDoor)),
        Speaks::Motion if is_door => Some(What::Door),
        Speaks::Motion => {
            let says_nothing = rest.iter().all(|word| NOISE.contains(&word.as_str()) || word.parse::<u32>().is_ok());
            match thing() {
                None if says_nothing && room.is_some() => Some(What::Area),
                other => other,
            }
        }
    }
}

/// Gives rooms to sensors without them by what was done as they spoke, all those together that see somebody at once; whether it
/// gave any.
fn by_deeds(sensors: &[LogSensor], ways: &[LogWay], placed: &mut [Option<(usize, What)>], rooms: &mut Rooms) -> bool {
    let mut of_room: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for together in at_once(sensors, ways, placed) {
        let Some(deed) = prevailing(sensors, &together) else { continue };
        let room = rooms.of_kind(RoomKind::named(deed.room.unwrap_or("entry")));
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

/// Of a room's sensors the one that speaks most while something is done is at what it is done with.
fn at_their_things(sensors: &[LogSensor], here: &[usize], room: &RoomKind, placed: &mut [Option<(usize, What)>]) {
    // What is done in such rooms comes first; one rests and eats in any.
    let is_seat = |thing: &Thing| thing.enterable && thing.home != room.name && SEATS.contains(&thing.name);
    for own in [true, false] {
        let deeds = DEEDS.iter().filter_map(|deed| Some((deed, Thing::named(deed.at)?)));
        let deeds = deeds.filter(|(deed, thing)| if own { deed.room == Some(room.name) } else { is_seat(thing) });
        let counts = deeds.flat_map(|(deed, thing)| {
            here.iter().map(move |&number| (counted(&sensors[number], deed.at), thing, number))
        });
        let mut counts: Vec<(u64, &'static Thing, usize)> =
            counts.filter(|(count, ..)| *count >= LEAST_FIRINGS / 4).collect();
        counts.sort_by_key(|(count, ..)| std::cmp::Reverse(*count));
        for (_, thing, number) in counts {
            let is_taken = here.iter().any(|&other| placed[other].is_some_and(|(_, what)| what == What::Thing(thing)));
            let is_free =
                sensors[number].speaks == Speaks::Motion && placed[number].is_some_and(|(_, what)| what == What::Spot);
            if is_free && !is_taken {
                placed[number] = placed[number].map(|(room, _)| (room, What::Thing(thing)));
            }
        }
    }
}

/// What somebody sits on in any room.
const SEATS: [&str; 3] = ["armchair", "dining chair", "desk chair"];

/// The sensors without a room, those together that see somebody at once.
fn at_once(sensors: &[LogSensor], ways: &[LogWay], placed: &[Option<(usize, What)>]) -> Vec<Vec<usize>> {
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

/// How often a sensor spoke while what is done at a thing was done.
fn counted(sensor: &LogSensor, at: &str) -> u64 {
    sensor
        .done
        .iter()
        .filter(|(label, _)| Deed::of(label).is_some_and(|deed| deed.at == at))
        .map(|(_, count)| count)
        .sum()
}

/// The deed that tells where sensors are: that of the room in which most was done as they spoke.
fn prevailing(sensors: &[LogSensor], together: &[usize]) -> Option<&'static Deed> {
    let mut of_room: BTreeMap<Option<&str>, (u64, &'static Deed)> = BTreeMap::new();
    let firings: u64 = together.iter().map(|&number| sensors[number].firings).sum();
    for (label, count) in together.iter().flat_map(|&number| &sensors[number].done) {
        if let Some(deed) = Deed::of(label) {
            of_room.entry(deed.room).or_insert((0, deed)).0 += count;
        }
    }
    let (count, deed) = of_room.into_values().max_by_key(|(count, _)| *count)?;
    (firings >= LEAST_FIRINGS && count as f64 >= LEAST_SHARE * firings as f64).then_some(deed)
}

/// What a sensor is for whose name says nothing but its kind, as CASAS calls them: `MA` is one over an area.
fn nameless(sensor: &LogSensor) -> What {
    match (sensor.speaks, words(&sensor.id).first().map(String::as_str)) {
        (Speaks::Contact, _) if counted(sensor, "front door") > 0 => What::FrontDoor,
        (Speaks::Contact, _) => Thing::named("drawers").map_or(What::Spot, What::Thing),
        (_, Some("ma")) => What::Area,
        _ => What::Spot,
    }
}

/// Gives rooms to the sensors that are left: that of whom nearly all ways lead to, or one of their own, through which one goes.
fn by_ways(sensors: &[LogSensor], ways: &[LogWay], placed: &mut [Option<(usize, What)>], rooms: &mut Rooms) {
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
        let hall = rooms.of_kind(RoomKind::named("hall"));
        placed[number] = Some((hall, nameless(&sensors[number])));
    }
}

/// A motion sensor at a door hangs on that side of it where one is seen next.
fn settle_doors(sensors: &[LogSensor], ways: &[LogWay], placed: &mut [(usize, What)]) {
    let before = placed.to_vec();
    for (number, (room, what)) in placed.iter_mut().enumerate() {
        if *what != What::Door || sensors[number].speaks != Speaks::Motion || sensors[number].at.is_some() {
            continue;
        }
        let mut to: BTreeMap<usize, u64> = BTreeMap::new();
        for way in ways {
            if let Some((other_room, other)) = way.other(number).map(|other| before[other])
                && other != What::Door
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

/// Where one goes through, each of several sensors sees a part of the way; of several over one room the one that speaks most sees
/// all of it.
fn several_spots(rooms: &[Room], sensors: &[LogSensor], placed: &mut [(usize, What)]) {
    for (room, Room { kind, .. }) in rooms.iter().enumerate() {
        let is_here = |number: &usize| placed[*number].0 == room && sensors[*number].speaks == Speaks::Motion;
        let here: Vec<usize> = (0..placed.len()).filter(is_here).collect();
        let is_area = |number: &&usize| placed[**number].1 == What::Area;
        let mut areas: Vec<usize> = here.iter().filter(is_area).copied().collect();
        areas.sort_by_key(|&number| std::cmp::Reverse(sensors[number].firings));
        let is_parted = kind.is_way && here.len() > 1;
        for number in areas.into_iter().skip(usize::from(!is_parted)) {
            let is_code = told(&sensors[number].id).room.is_none();
            placed[number].1 = if kind.is_way && !is_code { What::Spot } else { What::Wide };
        }
    }
}

/// A letter or a number at the end of a room's name tells nothing where there is no other of its kind.
fn renamed(mut rooms: Vec<Room>) -> Vec<Room> {
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

    fn told_of(sensors: &[LogSensor], ways: &[LogWay]) -> Vec<(String, String)> {
        let understood = understand(sensors, ways).unwrap();
        let what = |what: What| match what {
            What::Thing(thing) => thing.name.to_owned(),
            other => format!("{other:?}"),
        };
        understood.sensors.iter().map(|&(room, of)| (understood.rooms[room].name.clone(), what(of))).collect()
    }

    #[test]
    fn names_tell_rooms_and_things() {
        let ids = [
            "BedroomAArea",
            "BedroomABed",
            "BedroomBArea",
            "BathroomASink",
            "KitchenADiningChair",
            "MainEntryway",
            "HallwayA",
            "OfficeAChair",
            "living room armchair motion",
            "stove",
        ];
        let sensors: Vec<LogSensor> = ids.into_iter().map(motion).collect();
        let wanted = [
            ("bedroom a", "Area"),
            ("bedroom a", "bed"),
            ("bedroom b", "Area"),
            ("bathroom", "washbasin"),
            ("kitchen", "dining chair"),
            ("main entryway", "Area"),
            ("hallway", "Area"),
            ("office", "desk chair"),
            ("living room", "armchair"),
            ("kitchen", "stove"),
        ];
        let told = told_of(&sensors, &[]);
        assert_eq!(told.iter().map(|(room, what)| (room.as_str(), what.as_str())).collect::<Vec<_>>(), wanted);
    }

    #[test]
    fn what_is_done_and_who_follows_whom_tell_the_rest() {
        let done = |id: &str, label: &str| LogSensor { done: vec![(label.into(), 80)], ..motion(id) };
        let sensors = [
            done("M1", "Sleep"),
            done("M2", "Cook"),
            motion("M3"),
            motion("MA4"),
            LogSensor { speaks: Speaks::Contact, ..done("D1", "Leave_Home") },
        ];
        // M3 lies between both, MA4 is beside the bed.
        let told = told_of(&sensors, &[way(0, 2, 50), way(1, 2, 50), way(0, 3, 90), way(2, 3, 5)]);
        let wanted =
            [("bedroom", "bed"), ("kitchen", "stove"), ("hall", "Spot"), ("bedroom", "Area"), ("entry", "FrontDoor")];
        assert_eq!(told.iter().map(|(room, what)| (room.as_str(), what.as_str())).collect::<Vec<_>>(), wanted);
    }

    #[test]
    fn a_sensor_at_a_door_is_where_one_is_seen_next() {
        let sensors = ["BedroomArea", "BedroomDoor", "Hallway"].map(motion);
        assert_eq!(told_of(&sensors, &[way(0, 1, 10), way(1, 2, 90)])[1].0, "hallway");
        assert_eq!(told_of(&sensors, &[way(0, 1, 90), way(1, 2, 10)])[1].0, "bedroom");
    }

    #[test]
    fn those_of_which_nothing_tells_are_named() {
        assert_eq!(understand(&["M1", "Kitchen", "M2"].map(motion), &[]).unwrap_err(), ["M1", "M2"]);
    }
}
