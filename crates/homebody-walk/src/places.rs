//! Where things are done in this home: the places, seats and things that it names after them.

use super::standing::{around_in_room, beside, just_inside, sides_of};
use super::stations::{chore, is_opened};
use crate::mesh::Mesh;
use homebody_core::geometry::{self, Point};
use homebody_core::home::plan::{Origin, Plan};
use homebody_core::role::{ROLES, Role};
use homebody_core::scenario::home::HomeFile;
use homebody_core::scenario::path::Posture;
use std::collections::BTreeMap;

/// A place to be, and how the body is there.
#[derive(Clone, Debug, PartialEq)]
pub struct Spot {
    /// In small letters; empty for anywhere in a room.
    pub name: String,
    /// Metres, in the plan's coordinates.
    pub at: Point,
    /// How the body is there.
    pub posture: Posture,
    /// Index of the plan's room.
    pub room: Option<usize>,
    /// Whether it is the room itself, where nothing in it is called so.
    pub is_room: bool,
    /// Whether there is a way to it from most of the home.
    pub is_reachable: bool,
    /// The role that the home says of it, which is then its only one.
    pub said: Option<Role>,
    /// The places of those who share it, where several have room: the sides of a bed, the seats of a sofa.
    pub sides: Vec<Point>,
}

impl Spot {
    /// Anywhere in a room.
    pub fn to_stand(at: Point, room: usize) -> Spot {
        let (name, posture) = (String::new(), Posture::Standing);
        Spot { name, at, posture, room: Some(room), is_room: true, is_reachable: true, said: None, sides: Vec::new() }
    }

    /// Where somebody is in it, the best place first: its middle for who has it to themself, else one's own side.
    pub fn sides_for(&self, rank: usize, is_shared: bool) -> impl Iterator<Item = Point> {
        let has_own = is_shared && !self.sides.is_empty() && !is_somebodys(&self.name);
        let middle = (!has_own).then_some(self.at);
        let count = self.sides.len();
        middle.into_iter().chain((0..count).map(move |index| self.sides[(index + rank) % count]))
    }

    /// Whether it fills the role, whosever it is.
    pub fn is_of(&self, role: Role) -> bool {
        self.said.map_or_else(|| role.is_called(&self.name), |said| said == role)
    }
}

/// A place that somebody rises for.
#[derive(Clone, Debug)]
pub struct Station {
    /// Where it is.
    pub spot: Spot,
    /// What is done there, as the truth calls it.
    pub chore: &'static str,
    /// What is opened there.
    pub opened: Option<u32>,
}

/// The places of a home as one resident uses them: what is called after them is theirs before what is anybody's.
#[derive(Clone, Debug)]
pub struct Places {
    spots: Vec<Spot>,
    /// The resident's name in small letters, with an s: `margaret's`.
    whose: String,
    /// The way out, inside the door, and the door.
    door: Option<(Spot, Option<usize>)>,
    /// The names of the plan's things, in small letters, each with the role that the home says of it.
    things: Vec<(String, Option<Role>)>,
    /// Where the lamps begin among them.
    lamps: usize,
    /// What to look at or dust on a round through the home: the places that it names, and whatever can be opened.
    stations: Vec<Station>,
    /// By role, where it is filled and the thing that fills it: lives ask for them all day.
    of_role: Vec<(Option<Spot>, Option<u32>)>,
}

impl Places {
    /// The places of a home for a resident who walks by `mesh`.
    pub fn new(home: &HomeFile, plan: &Plan, mesh: &Mesh, resident: &str) -> Places {
        Places::from_hub(home, plan, mesh, resident, None)
    }

    /// The same, with ways from one place; without it, from where there is a way to most others.
    pub fn from_hub(home: &HomeFile, plan: &Plan, mesh: &Mesh, resident: &str, from: Option<Point>) -> Places {
        let seats = plan.solids.iter().filter_map(|solid| match solid.origin {
            Origin::Furniture(index) if home.furniture[index].enterable => Some(&home.furniture[index].name),
            _ => None,
        });
        let seats: Vec<&String> = seats.collect();
        let said = home.furniture.iter().filter_map(|piece| Some((piece.name.to_lowercase(), piece.role?)));
        let said: BTreeMap<String, Role> = said.collect();
        let spot = |name: &str, at, posture| {
            let name = name.to_lowercase();
            let is_room = home.rooms.iter().any(|room| room.name.to_lowercase() == name);
            let said = said.get(&name).copied().filter(|_| !is_room);
            Spot { name, at, posture, room: plan.room_at(at), is_room, is_reachable: true, said, sides: Vec::new() }
        };
        let place = |(name, at): &(String, Point)| {
            let lower = name.to_lowercase();
            let posture = match said.get(&lower).and_then(|role| role.row().posture) {
                _ if !seats.contains(&name) => Posture::Standing,
                Some(posture) => posture,
                None if is_stood_in(&lower) => Posture::Standing,
                None if words(&lower).any(|word| word.ends_with("bed")) => Posture::Lying,
                None => Posture::Sitting,
            };
            spot(name, *at, posture)
        };
        let mut spots: Vec<Spot> = plan.places.iter().map(place).collect();
        // What nobody can be in, people stand beside, on any side that there is a way to.
        let mut sides: Vec<(usize, Vec<Point>)> = Vec::new();
        for (index, piece) in home.furniture.iter().enumerate() {
            let name = piece.name.to_lowercase();
            let known = spots.iter().any(|spot| spot.name == name && (spot.said.is_some() || piece.role.is_none()));
            let solid = plan.solids.iter().find(|solid| solid.origin == Origin::Furniture(index));
            if let (false, Some(solid)) = (known, solid) {
                let around = beside(plan, &solid.outline);
                let at = around.first().copied().unwrap_or_else(|| geometry::inner_point(&solid.outline));
                sides.push((spots.len(), around));
                spots.push(spot(&piece.name, at, Posture::Standing));
            }
        }
        for spot in spots.iter_mut().filter(|spot| spot.posture != Posture::Standing) {
            let piece =
                home.furniture.iter().position(|piece| piece.enterable && piece.name.to_lowercase() == spot.name);
            let solid =
                plan.solids.iter().find(|solid| piece.is_some_and(|piece| solid.origin == Origin::Furniture(piece)));
            spot.sides = solid.map_or_else(Vec::new, |solid| sides_of(&solid.outline, spot.posture));
        }
        let hub = from.or_else(|| hub(&spots, mesh));
        let is_reachable = |at: Point| hub.is_some_and(|hub| mesh.can_reach(hub, at));
        find_ways(plan, &mut spots, sides, is_reachable);
        let roles = home.doors.iter().map(|_| None).chain(home.furniture.iter().map(|piece| piece.role));
        let roles = roles.chain(std::iter::repeat(None));
        let things = plan.things.iter().map(|thing| thing.name.to_lowercase()).zip(roles).collect();
        let mut places = Places {
            spots,
            whose: format!("{}'s", resident.to_lowercase()),
            door: None,
            things,
            lamps: plan.things.len() - plan.rooms.len(),
            stations: Vec::new(),
            of_role: Vec::new(),
        };
        places.door = places.find_door(home, plan);
        if let Some((spot, _)) = &mut places.door {
            spot.is_reachable = is_reachable(spot.at);
        }
        places.stations = places.find_stations(home);
        places.of_role =
            ROLES.iter().map(|row| (places.find(row.role).cloned(), places.find_thing(row.role))).collect();
        places
    }

    /// All of them: places, furniture and rooms.
    pub fn all(&self) -> &[Spot] {
        &self.spots
    }

    /// The rooms without a way in, as indices into the plan's rooms.
    pub fn closed_rooms(&self) -> impl Iterator<Item = usize> + '_ {
        self.spots.iter().filter(|spot| spot.is_room && !spot.is_reachable).filter_map(|spot| spot.room)
    }

    /// The spot of a name that the user wrote: a place, a piece of furniture, or a room.
    pub fn named(&self, name: &str) -> Option<&Spot> {
        let name = name.to_lowercase();
        self.own_spot(&name).or_else(|| self.spot(&name))
    }

    /// The same for who sleeps elsewhere at night than in a bed.
    pub fn sleeping_at(mut self, name: Option<&str>) -> Places {
        if let Some(spot) = name.and_then(|name| self.named(name)).cloned() {
            self.of_role[Role::Bed as usize].0 = Some(spot);
        }
        self
    }

    /// Where the role is filled, if anything in the home will do: the best that there is a way to, else the best.
    pub fn of(&self, role: Role) -> Option<&Spot> {
        self.of_role[role as usize].0.as_ref()
    }

    fn find(&self, role: Role) -> Option<&Spot> {
        if role == Role::FrontDoor
            && let Some((spot, _)) = &self.door
        {
            return Some(spot);
        }
        let all = || self.own(role).chain(self.instead(role));
        all().find(|spot| spot.is_reachable).or_else(|| all().next())
    }

    /// What fills the role itself, the best first: what is called after the resident before what is anybody's, and of each
    /// what the home says it of before what is only called so.
    fn own(&self, role: Role) -> impl Iterator<Item = &Spot> {
        let names = role.row().names;
        let said = || self.spots.iter().filter(move |spot| spot.said == Some(role));
        let own = said().filter(|spot| self.own_name(&spot.name).is_some());
        let own = own.chain(names.iter().filter_map(|name| self.called(|spot| self.own_name(spot) == Some(name))));
        own.chain(said().filter(|spot| !is_somebodys(&spot.name)))
            .chain(names.iter().filter_map(|name| self.called(|spot| spot == *name)))
    }

    /// The first spot of a name by which its role is known.
    fn called(&self, fits: impl Fn(&str) -> bool) -> Option<&Spot> {
        self.spots.iter().find(|spot| spot.said.is_none() && fits(&spot.name))
    }

    /// What will do where nothing fills the role itself.
    fn instead(&self, role: Role) -> impl Iterator<Item = &Spot> {
        role.row().instead.iter().flat_map(|&role| self.own(role))
    }

    /// What would fill the role if there were a way to it: nothing where there is one to something as good. Standing is not as
    /// good as sitting, nor a room as what stands in it.
    pub fn out_of_reach(&self, role: Role) -> Option<&Spot> {
        let door = self.door.as_ref().map(|(spot, _)| spot).filter(|_| role == Role::FrontDoor);
        let mut all: Vec<&Spot> = door.map_or_else(|| self.own(role).collect(), |door| vec![door]);
        if all.is_empty() {
            all = self.instead(role).collect();
        }
        let best = *all.first()?;
        let is_as_good =
            |spot: &&Spot| spot.is_reachable && spot.posture == best.posture && (best.is_room || !spot.is_room);
        (!all.iter().any(is_as_good)).then_some(best)
    }

    /// Whether the home has it itself, and not only something that will do.
    pub fn has(&self, role: Role) -> bool {
        self.spots.iter().any(|spot| spot.is_of(role))
    }

    /// Of several toilets or washbasins that there is a way to the nearest as the crow flies, else as [`Places::of`].
    pub fn nearest(&self, role: Role, at: Point) -> Option<&Spot> {
        let best = role.row().names[0];
        let is_of = |spot: &&Spot| spot.said.map_or_else(|| spot.name.ends_with(best), |said| said == role);
        let several = self.spots.iter().filter(|spot| spot.is_reachable && !spot.name.contains('\'')).filter(is_of);
        let nearest = several.min_by(|a, b| a.at.distance(at).total_cmp(&b.at.distance(at)));
        let is_own = self.of(role).is_some_and(|spot| spot.name.starts_with(&self.whose));
        if is_own { self.of(role) } else { nearest.or_else(|| self.of(role)) }
    }

    /// What will do where somebody has a spot: others of its role, and of seats any other that is nobody else's, the nearest
    /// first.
    pub fn instead_of(&self, spot: &Spot) -> Vec<&Spot> {
        let is_mine = |other: &&Spot| !is_somebodys(&other.name) || self.own_name(&other.name).is_some();
        let is_alike = |other: &&Spot| {
            let shares_role = || ROLES.iter().any(|row| spot.is_of(row.role) && other.is_of(row.role));
            match spot.posture {
                Posture::Sitting => {
                    other.posture == Posture::Sitting && !is_toilet(other) && !is_toilet(spot) || shares_role()
                }
                _ => shares_role(),
            }
        };
        let others = self.spots.iter().filter(|other| other.name != spot.name && other.is_reachable);
        let mut others: Vec<&Spot> =
            others.filter(|other| other.posture == spot.posture).filter(is_mine).filter(is_alike).collect();
        others.sort_by(|a, b| a.at.distance(spot.at).total_cmp(&b.at.distance(spot.at)));
        others
    }

    /// All that fill the role and that there is a way to, whosever they are: a pet asks nobody.
    pub fn anybodys(&self, role: Role) -> Vec<&Spot> {
        self.spots.iter().filter(|spot| spot.is_reachable && spot.is_of(role)).collect()
    }

    /// The thing of a role, to turn on or open.
    pub fn thing(&self, role: Role) -> Option<u32> {
        self.of_role[role as usize].1
    }

    fn find_thing(&self, role: Role) -> Option<u32> {
        if role == Role::FrontDoor
            && let Some((_, thing)) = &self.door
        {
            return thing.map(|thing| thing as u32);
        }
        let names = role.row().names;
        // The lamp of the kitchen is no stove.
        let things = &self.things[..self.lamps];
        let said =
            |fits: &dyn Fn(&str) -> bool| things.iter().position(|(thing, said)| *said == Some(role) && fits(thing));
        let called = |fits: &dyn Fn(&str, &str) -> bool| {
            let thing = |name| things.iter().position(|(thing, said)| said.is_none() && fits(thing, name));
            names.iter().find_map(|name| thing(name))
        };
        let thing = said(&|thing| self.own_name(thing).is_some())
            .or_else(|| called(&|thing, name| self.own_name(thing) == Some(name)))
            .or_else(|| said(&|thing| !is_somebodys(thing)))
            .or_else(|| called(&|thing, name| thing == name));
        thing.map(|thing| thing as u32)
    }

    /// The thing of a name that the user wrote; the name of a room is its lamp.
    pub fn thing_named(&self, name: &str) -> Option<u32> {
        let name = name.to_lowercase();
        self.things.iter().position(|(thing, _)| *thing == name).map(|index| index as u32)
    }

    /// The lamp of a room.
    pub fn lamp(&self, room: usize) -> u32 {
        (self.lamps + room) as u32
    }

    /// The name of a thing, in small letters.
    pub fn thing_name(&self, thing: u32) -> &str {
        &self.things[thing as usize].0
    }

    /// What to look at on a round through the home.
    pub fn stations(&self) -> &[Station] {
        &self.stations
    }

    /// Whether a room is a bathroom: it has a toilet or a shower.
    pub fn is_bathroom(&self, room: usize) -> bool {
        let has = |role| self.spots.iter().any(|spot| spot.room == Some(room) && !spot.is_room && spot.is_of(role));
        has(Role::Toilet) || has(Role::Shower)
    }

    /// What is called so after the resident.
    fn own_spot(&self, name: &str) -> Option<&Spot> {
        self.spots.iter().find(|spot| self.own_name(&spot.name) == Some(name))
    }

    /// What a name says besides whose it is, if that is the resident.
    fn own_name<'a>(&self, name: &'a str) -> Option<&'a str> {
        name.strip_prefix(&self.whose)?.strip_prefix(' ')
    }

    fn spot(&self, name: &str) -> Option<&Spot> {
        self.spots.iter().find(|spot| spot.name == name)
    }

    /// The way out, and its door: the one that the home calls so, else where a place of that name is.
    fn find_door(&self, home: &HomeFile, plan: &Plan) -> Option<(Spot, Option<usize>)> {
        let names = Role::FrontDoor.row().names;
        let outside = home.doors.iter().position(|door| door.outside);
        let is_place = |spot: &&Spot| home.places.iter().any(|place| place.name.to_lowercase() == spot.name);
        let place = names.iter().find_map(|name| self.spot(name).filter(is_place)).cloned();
        let room = names.iter().find_map(|name| self.called(|spot| spot == *name)).cloned();
        let thing =
            outside.or_else(|| names.iter().find_map(|name| self.things.iter().position(|(thing, _)| thing == name)));
        let at_door = || {
            let door = &plan.things[outside?];
            let at = just_inside(plan, door.at);
            let (name, room) = (door.name.to_lowercase(), plan.room_at(at));
            Some(Spot {
                name,
                at,
                posture: Posture::Standing,
                room,
                is_room: false,
                is_reachable: true,
                said: None,
                sides: Vec::new(),
            })
        };
        place.or_else(at_door).or(room).map(|spot| (spot, thing))
    }

    /// Places to stand at that there is a way to, of all rooms; beds, seats and doors aside.
    fn find_stations(&self, home: &HomeFile) -> Vec<Station> {
        let named = home.places.iter().map(|place| place.name.to_lowercase());
        let door = self.door.as_ref().map(|(spot, _)| spot.name.clone());
        let named: Vec<String> = named.filter(|name| Some(name) != door.as_ref()).collect();
        let reachable = || self.spots.iter().filter(|spot| spot.is_reachable);
        let is_used = |spot: &&Spot| named.contains(&spot.name) || !spot.is_room && is_opened(&spot.name);
        let standing = reachable().filter(|spot| spot.posture == Posture::Standing).filter(is_used);
        let stations: Vec<Station> = standing.map(|spot| self.station(spot)).collect();
        if !stations.is_empty() {
            return stations;
        }
        reachable().filter(|spot| spot.is_room).map(|spot| self.station(spot)).collect()
    }

    fn station(&self, spot: &Spot) -> Station {
        let opened = self.thing_named(&spot.name).filter(|_| is_opened(&spot.name));
        Station { spot: spot.clone(), chore: chore(&spot.name), opened }
    }
}

/// Marks the spots that there is a way to. What has places around it is reached by the first of them that there is a way to, and a
/// room in whose middle something stands beside that.
fn find_ways(plan: &Plan, spots: &mut [Spot], sides: Vec<(usize, Vec<Point>)>, is_reachable: impl Fn(Point) -> bool) {
    /// Number of places of such a room that are tried (our choice): each costs a search for a way.
    const MOST_TRIED: usize = 20;
    spots.iter_mut().for_each(|spot| spot.is_reachable = is_reachable(spot.at));
    let around_middle = |(index, spot): (usize, &Spot)| {
        let room = spot.room.filter(|_| spot.is_room && !spot.is_reachable)?;
        Some((index, around_in_room(plan, room, spot.at).into_iter().take(MOST_TRIED).collect()))
    };
    let rooms = spots.iter().enumerate().filter_map(around_middle);
    let around: Vec<(usize, Vec<Point>)> = rooms.chain(sides).collect();
    for (index, around) in around {
        let spot = &mut spots[index];
        if let Some(at) = around.into_iter().find(|&at| !spot.is_reachable && is_reachable(at)) {
            *spot = Spot { at, room: plan.room_at(at), is_reachable: true, ..spot.clone() };
        }
    }
}

/// A place from which there is a way to most of the others; nothing where there is no place to stand at all.
fn hub(spots: &[Spot], mesh: &Mesh) -> Option<Point> {
    let mut parts: Vec<(Point, usize)> = Vec::new();
    for spot in spots.iter().filter(|spot| mesh.approach(spot.at).is_some()) {
        match parts.iter_mut().find(|(of, _)| mesh.can_reach(*of, spot.at)) {
            Some((_, count)) => *count += 1,
            None => parts.push((spot.at, 1)),
        }
    }
    parts.into_iter().reduce(|a, b| if b.1 > a.1 { b } else { a }).map(|(of, _)| of)
}

/// Whether it is called after somebody, such as `ruth's bed`.
fn is_somebodys(name: &str) -> bool {
    name.contains("'s ")
}

fn is_toilet(spot: &Spot) -> bool {
    spot.is_of(Role::Toilet)
}

/// What people stand in although they can enter it.
fn is_stood_in(name: &str) -> bool {
    words(name).any(|word| ["shower", "rug", "mat", "carpet"].iter().any(|end| word.ends_with(end)))
}

fn words(name: &str) -> impl Iterator<Item = &str> {
    name.split(|c: char| !c.is_alphanumeric())
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    /// One room with these pieces of furniture, all of them enterable but for the desk.
    fn places(names: &[&str], resident: &str) -> Places {
        let piece = |(index, name): (usize, &&str)| {
            let at = [1.0 + 1.5 * index as f64, 1.0];
            json!({ "name": name, "at": at, "size_m": [0.8, 0.8], "height_m": 0.6, "enterable": *name != "desk" })
        };
        let furniture: Vec<_> = names.iter().enumerate().map(piece).collect();
        let outline = [[0, 0], [20, 0], [20, 4], [0, 4]];
        let home = json!({
            "name": "one room", "rooms": [{ "name": "studio", "outline": outline }], "walls": [], "furniture": furniture,
        });
        let home: HomeFile = serde_json::from_value(home).unwrap();
        let plan = Plan::new(&home);
        Places::new(&home, &plan, &Mesh::new(&plan, 0.22), resident)
    }

    fn names(spots: &[&Spot]) -> Vec<String> {
        spots.iter().map(|spot| spot.name.clone()).collect()
    }

    #[test]
    fn what_is_called_after_somebody_is_theirs() {
        let all = ["Henry's bed", "Ruth's bed", "armchair"];
        let name = |resident, role| places(&all, resident).of(role).unwrap().name.clone();
        assert_eq!(name("henry", Role::Bed), "henry's bed");
        assert_eq!(name("Ruth", Role::Bed), "ruth's bed");
        // Nobody else's bed, even where there is no other.
        assert_eq!(name("anna", Role::Bed), "armchair");
        assert_eq!(places(&all, "ruth").named("bed").unwrap().name, "ruth's bed");
    }

    #[test]
    fn a_pet_may_have_anybodys() {
        let places = places(&["henry's bed", "ruth's bed", "bed", "bunk bed", "sofa"], "minka");
        assert_eq!(names(&places.anybodys(Role::Bed)), ["henry's bed", "ruth's bed", "bed"]);
        assert_eq!(names(&places.anybodys(Role::Sofa)), ["sofa"]);
        assert!(places.anybodys(Role::Basket).is_empty());
    }

    #[test]
    fn the_way_out_is_before_a_door_however_thick_its_wall_is() {
        for thickness_m in [0.1, 0.5, 0.6, 1.0] {
            let door = json!({ "name": "front door", "from": [4.0, 0.0], "to": [5.0, 0.0], "outside": true });
            let wall = json!({ "from": [0.0, 0.0], "to": [8.0, 0.0], "thickness_m": thickness_m });
            let outline = [[0, 0], [8, 0], [8, 4], [0, 4]];
            let home = json!({
                "name": "stone", "rooms": [{ "name": "hall", "outline": outline }], "walls": [wall], "doors": [door],
                "furniture": [{ "name": "bed", "at": [1.0, 2.5], "size_m": [0.9, 2.0], "height_m": 0.5, "enterable": true }],
            });
            let home: HomeFile = serde_json::from_value(home).unwrap();
            let plan = Plan::new(&home);
            let places = Places::new(&home, &plan, &Mesh::new(&plan, 0.22), "anna");
            let (way_out, _) = places.door.clone().unwrap();
            assert!(way_out.is_reachable, "{thickness_m}");
            assert!(
                way_out.at.distance(Point::new(4.5, 0.0)) < thickness_m / 2.0 + 0.55,
                "{thickness_m}: {}",
                way_out.at
            );
        }
    }

    #[test]
    fn people_stand_beside_what_is_in_the_middle_of_a_room() {
        let home = json!({
            "name": "island", "rooms": [{ "name": "kitchen", "outline": [[0, 0], [6, 0], [6, 4], [0, 4]] }], "walls": [],
            "furniture": [
                { "name": "island", "at": [3.0, 2.0], "size_m": [2.2, 1.5], "height_m": 0.9 },
                { "name": "bed", "at": [0.6, 2.0], "size_m": [0.9, 2.0], "height_m": 0.5, "enterable": true },
            ],
        });
        let home: HomeFile = serde_json::from_value(home).unwrap();
        let plan = Plan::new(&home);
        let places = Places::new(&home, &plan, &Mesh::new(&plan, 0.22), "anna");
        let kitchen = places.named("kitchen").unwrap();
        assert!(kitchen.is_room && kitchen.is_reachable && plan.is_walkable(kitchen.at, 0.22), "{}", kitchen.at);
        assert!(kitchen.at.distance(Point::new(3.0, 2.0)) < 1.2, "{}", kitchen.at);
    }

    #[test]
    fn people_sit_at_a_desk() {
        let places = places(&["desk", "desk chair"], "anna");
        let spot = places.of(Role::Desk).unwrap();
        assert_eq!((spot.name.as_str(), spot.posture), ("desk chair", Posture::Sitting));
    }

    #[test]
    fn how_one_is_in_something_is_told_by_its_words() {
        for (name, posture) in [
            ("henry's bed", Posture::Lying),
            ("daybed", Posture::Lying),
            ("bedroom chair", Posture::Sitting),
            ("bedside bench", Posture::Sitting),
            ("walk-in shower", Posture::Standing),
            ("bathmat", Posture::Standing),
            ("matted armchair", Posture::Sitting),
        ] {
            assert_eq!(places(&[name], "anna").named(name).unwrap().posture, posture, "{name}");
        }
    }

    #[test]
    fn what_stands_in_a_narrow_place_is_reached_over() {
        let wall = json!({ "from": [0, 0], "to": [0, 4], "thickness_m": 0.1 });
        let outline = [[0, 0], [4, 0], [4, 4], [0, 4]];
        let is_reached = |tables: &[[f64; 4]]| {
            let table = |(index, [x, y, width, depth]): (usize, &[f64; 4])| json!({ "name": format!("table {index}"), "at": [x, y], "size_m": [width, depth], "height_m": 0.7 });
            let basin = json!({ "name": "basin", "at": [0.35, 2], "size_m": [0.6, 0.6], "height_m": 0.9 });
            let furniture: Vec<_> = tables.iter().enumerate().map(table).chain([basin]).collect();
            let home = json!({
                "name": "one room", "rooms": [{ "name": "bath", "outline": outline }], "walls": [wall], "furniture": furniture,
            });
            let home: HomeFile = serde_json::from_value(home).unwrap();
            let plan = Plan::new(&home);
            Places::new(&home, &plan, &Mesh::new(&plan, 0.22), "anna").of(Role::Washbasin).unwrap().is_reachable
        };
        // A table before it, and two that leave half a metre beside it.
        let before = [1.05, 2.0, 0.7, 0.6];
        assert!(is_reached(&[before, [0.9, 3.0, 0.6, 1.1], [0.9, 1.0, 0.6, 1.1]]));
        // There is no way to the gap.
        let around = [[0.5, 3.0, 1.0, 1.1], [0.5, 1.0, 1.0, 1.1]];
        assert!(!is_reached(&[before, around[0], around[1]]));
    }
}
