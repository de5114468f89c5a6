//! The places, seats and things of a home, by name and role.

use super::standing::{around_in_room, beside, just_inside, sides_of};
use super::stations::{chore, is_opened};
use crate::mesh::Mesh;
use homebody_core::geometry::{self, Point};
use homebody_core::home::form::HomeFile;
use homebody_core::plan::{Origin, Plan};
use homebody_core::posture::Posture;
use homebody_core::role::{ROLES, Role};
use std::collections::BTreeMap;

/// A place, with the posture of a body there.
#[derive(Clone, Debug, PartialEq)]
pub struct HomePlace {
    /// In lower case; empty for anywhere in a room.
    pub name: String,
    pub at: Point,
    pub posture: Posture,
    /// Index of the plan's room.
    pub room: Option<usize>,
    /// The room itself.
    pub is_room: bool,
    /// From most of the home.
    pub is_reachable: bool,
    /// The role that the home states, which is then its only one.
    pub said: Option<Role>,
    /// Places of several people: the sides of a bed, the seats of a sofa.
    pub sides: Vec<Point>,
}

impl HomePlace {
    pub fn to_stand(at: Point, room: usize) -> HomePlace {
        HomePlace { is_room: true, ..HomePlace::named(String::new(), at, Some(room)) }
    }

    fn named(name: String, at: Point, room: Option<usize>) -> HomePlace {
        let (posture, sides) = (Posture::Standing, Vec::new());
        HomePlace { name, at, posture, room, is_room: false, is_reachable: true, said: None, sides }
    }

    /// The best place first: the middle if it is not shared, else the side of this rank.
    pub fn sides_for(&self, rank: usize, is_shared: bool) -> impl Iterator<Item = Point> {
        let has_own = is_shared && !self.sides.is_empty() && !has_owner(&self.name);
        let middle = (!has_own).then_some(self.at);
        let count = self.sides.len();
        middle.into_iter().chain((0..count).map(move |index| self.sides[(index + rank) % count]))
    }

    pub fn is_of(&self, role: Role) -> bool {
        self.said.map_or_else(|| role.is_called(&self.name), |said| said == role)
    }
}

#[derive(Clone, Debug)]
pub struct ChoreStation {
    pub spot: HomePlace,
    /// The activity there, a label of the ground truth.
    pub chore: &'static str,
    /// The thing to open there.
    pub opened: Option<u32>,
}

/// The places of a home for one resident, whose named places take precedence over shared ones.
#[derive(Clone, Debug)]
pub struct HomePlaces {
    spots: Vec<HomePlace>,
    /// The resident's name in lower case, with an s: `margaret's`.
    whose: String,
    /// Just inside the front door, and the door.
    door: Option<(HomePlace, Option<usize>)>,
    /// In lower case, with the role that the home states.
    things: Vec<(String, Option<Role>)>,
    /// Index of the first lamp.
    lamps: usize,
    /// Places that the home names, and all that can be opened.
    stations: Vec<ChoreStation>,
    /// The floor of each room, in lower case.
    floors: Vec<Option<String>>,
    /// By role, its place and its thing; cached, because they are looked up all day.
    of_role: Vec<(Option<HomePlace>, Option<u32>)>,
}

impl HomePlaces {
    pub fn new(home: &HomeFile, plan: &Plan, mesh: &Mesh, resident: &str) -> HomePlaces {
        HomePlaces::from_hub(home, plan, mesh, resident, None)
    }

    /// `hub` is the place that others must be reachable from; by default, the place with routes to most others.
    pub fn from_hub(home: &HomeFile, plan: &Plan, mesh: &Mesh, resident: &str, from: Option<Point>) -> HomePlaces {
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
            HomePlace { posture, is_room, said, ..HomePlace::named(name, at, plan.room_at(at)) }
        };
        let place = |(name, at): &(String, Point)| {
            let lower = name.to_lowercase();
            let posture = match said.get(&lower).and_then(|role| role.row().posture) {
                _ if !seats.contains(&name) => Posture::Standing,
                Some(posture) => posture,
                None if is_for_standing(&lower) => Posture::Standing,
                None if words(&lower).any(|word| word.ends_with("bed")) => Posture::Lying,
                None => Posture::Sitting,
            };
            spot(name, *at, posture)
        };
        let mut spots: Vec<HomePlace> = plan.places.iter().map(place).collect();
        // Furniture that is not entered is used from any reachable side.
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
        let mut places = HomePlaces {
            spots,
            whose: format!("{}'s", resident.to_lowercase()),
            door: None,
            things,
            lamps: plan.things.len() - plan.rooms.len(),
            stations: Vec::new(),
            floors: home.rooms.iter().map(|room| room.floor.as_ref().map(|floor| floor.to_lowercase())).collect(),
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

    pub fn all(&self) -> &[HomePlace] {
        &self.spots
    }

    pub fn closed_rooms(&self) -> impl Iterator<Item = usize> + '_ {
        self.spots.iter().filter(|spot| spot.is_room && !spot.is_reachable).filter_map(|spot| spot.room)
    }

    pub fn named(&self, name: &str) -> Option<&HomePlace> {
        let name = name.to_lowercase();
        self.own_spot(&name).or_else(|| self.spot(&name))
    }

    /// With a named place as the bed.
    pub fn sleeping_at(mut self, name: &str) -> HomePlaces {
        if let Some(spot) = self.named(name).cloned() {
            self.of_role[Role::Bed as usize].0 = Some(spot);
        }
        self
    }

    /// Without the rooms that a person does not enter: for each name of a room or floor, those outside of it if it is true,
    /// else those inside. A bed, a toilet and the front door are used elsewhere if none is left.
    pub fn within(mut self, ranges: &[(String, bool)]) -> HomePlaces {
        const NEEDED: [Role; 4] = [Role::Bed, Role::Toilet, Role::Washbasin, Role::FrontDoor];
        let is_called = |room: usize, name: &str| {
            self.things[self.lamps + room].0 == name || self.floors[room].as_deref() == Some(name)
        };
        let is_in = |room: usize| ranges.iter().all(|(name, inside)| is_called(room, &name.to_lowercase()) == *inside);
        let rooms: Vec<bool> = (0..self.floors.len()).map(is_in).collect();
        let is_within = |spot: &HomePlace| spot.room.is_none_or(|room| rooms.get(room).copied().unwrap_or(true));
        self.spots.retain(&is_within);
        self.stations.retain(|station| is_within(&station.spot));
        for row in ROLES {
            let (place, thing) = &self.of_role[row.role as usize];
            let is_left = place.as_ref().is_none_or(&is_within);
            let found = match is_left {
                true => (place.clone(), *thing),
                false if NEEDED.contains(&row.role) => (self.find(row.role).or(place.as_ref()).cloned(), *thing),
                false => (self.find(row.role).cloned(), None),
            };
            self.of_role[row.role as usize] = found;
        }
        self
    }

    /// The best reachable place for the role, or a substitute; else an unreachable one.
    pub fn for_role(&self, role: Role) -> Option<&HomePlace> {
        self.of_role[role as usize].0.as_ref()
    }

    fn find(&self, role: Role) -> Option<&HomePlace> {
        if role == Role::FrontDoor
            && let Some((spot, _)) = &self.door
        {
            return Some(spot);
        }
        let all = || self.own(role).chain(self.substitutes(role));
        all().find(|spot| spot.is_reachable).or_else(|| all().next())
    }

    /// Places of the role, best first: the resident's own before shared ones, stated roles before those of names.
    fn own(&self, role: Role) -> impl Iterator<Item = &HomePlace> {
        let names = role.row().names;
        let said = || self.spots.iter().filter(move |spot| spot.said == Some(role));
        let own = said().filter(|spot| self.own_name(&spot.name).is_some());
        let own = own.chain(names.iter().filter_map(|name| self.called(|spot| self.own_name(spot) == Some(name))));
        own.chain(said().filter(|spot| !has_owner(&spot.name)))
            .chain(names.iter().filter_map(|name| self.called(|spot| spot == *name)))
    }

    fn called(&self, fits: impl Fn(&str) -> bool) -> Option<&HomePlace> {
        self.spots.iter().find(|spot| spot.said.is_none() && fits(&spot.name))
    }

    /// Places of substitute roles.
    fn substitutes(&self, role: Role) -> impl Iterator<Item = &HomePlace> {
        role.row().instead.iter().flat_map(|&role| self.own(role))
    }

    /// The place that would serve the role if it were reachable; `None` if one as good is. A seat is better than standing,
    /// and furniture better than a room.
    pub fn out_of_reach(&self, role: Role) -> Option<&HomePlace> {
        let door = self.door.as_ref().map(|(spot, _)| spot).filter(|_| role == Role::FrontDoor);
        let mut all: Vec<&HomePlace> = door.map_or_else(|| self.own(role).collect(), |door| vec![door]);
        if all.is_empty() {
            all = self.substitutes(role).collect();
        }
        let best = *all.first()?;
        let is_as_good =
            |spot: &&HomePlace| spot.is_reachable && spot.posture == best.posture && (best.is_room || !spot.is_room);
        (!all.iter().any(is_as_good)).then_some(best)
    }

    /// Without substitutes.
    pub fn has(&self, role: Role) -> bool {
        self.spots.iter().any(|spot| spot.is_of(role))
    }

    /// The nearest reachable toilet or washbasin in a straight line; for other roles, [`HomePlaces::for_role`].
    pub fn nearest(&self, role: Role, at: Point) -> Option<&HomePlace> {
        let best = role.row().names[0];
        let is_of = |spot: &&HomePlace| spot.said.map_or_else(|| spot.name.ends_with(best), |said| said == role);
        let several = self.spots.iter().filter(|spot| spot.is_reachable && !spot.name.contains('\'')).filter(is_of);
        let nearest = several.min_by(|a, b| a.at.distance(at).total_cmp(&b.at.distance(at)));
        let is_own = self.for_role(role).is_some_and(|spot| spot.name.starts_with(&self.whose));
        if is_own { self.for_role(role) } else { nearest.or_else(|| self.for_role(role)) }
    }

    /// Substitutes for an occupied place: others of its role and, for a seat, any seat that belongs to no other person, the
    /// nearest first.
    pub fn substitutes_for(&self, spot: &HomePlace) -> Vec<&HomePlace> {
        let is_mine = |other: &&HomePlace| !has_owner(&other.name) || self.own_name(&other.name).is_some();
        let is_alike = |other: &&HomePlace| {
            let shares_role = || ROLES.iter().any(|row| spot.is_of(row.role) && other.is_of(row.role));
            match spot.posture {
                Posture::Sitting => {
                    other.posture == Posture::Sitting && !is_toilet(other) && !is_toilet(spot) || shares_role()
                }
                _ => shares_role(),
            }
        };
        let others = self.spots.iter().filter(|other| other.name != spot.name && other.is_reachable);
        let mut others: Vec<&HomePlace> =
            others.filter(|other| other.posture == spot.posture).filter(is_mine).filter(is_alike).collect();
        others.sort_by(|a, b| a.at.distance(spot.at).total_cmp(&b.at.distance(spot.at)));
        others
    }

    /// All reachable places of a role, including those of other residents, because pets use all.
    pub fn all_for(&self, role: Role) -> Vec<&HomePlace> {
        self.spots.iter().filter(|spot| spot.is_reachable && spot.is_of(role)).collect()
    }

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
        // A lamp in the kitchen does not count as a stove.
        let things = &self.things[..self.lamps];
        let said =
            |fits: &dyn Fn(&str) -> bool| things.iter().position(|(thing, said)| *said == Some(role) && fits(thing));
        let called = |fits: &dyn Fn(&str, &str) -> bool| {
            let thing = |name| things.iter().position(|(thing, said)| said.is_none() && fits(thing, name));
            names.iter().find_map(|name| thing(name))
        };
        let thing = said(&|thing| self.own_name(thing).is_some())
            .or_else(|| called(&|thing, name| self.own_name(thing) == Some(name)))
            .or_else(|| said(&|thing| !has_owner(thing)))
            .or_else(|| called(&|thing, name| thing == name));
        thing.map(|thing| thing as u32)
    }

    pub fn thing_named(&self, name: &str) -> Option<u32> {
        let name = name.to_lowercase();
        self.things.iter().position(|(thing, _)| *thing == name).map(|index| index as u32)
    }

    pub fn lamp(&self, room: usize) -> u32 {
        (self.lamps + room) as u32
    }

    pub fn thing_name(&self, thing: u32) -> &str {
        &self.things[thing as usize].0
    }

    pub fn stations(&self) -> &[ChoreStation] {
        &self.stations
    }

    /// A room with a toilet or a shower.
    pub fn is_bathroom(&self, room: usize) -> bool {
        let has = |role| self.spots.iter().any(|spot| spot.room == Some(room) && !spot.is_room && spot.is_of(role));
        has(Role::Toilet) || has(Role::Shower)
    }

    fn own_spot(&self, name: &str) -> Option<&HomePlace> {
        self.spots.iter().find(|spot| self.own_name(&spot.name) == Some(name))
    }

    /// The name without the resident's, if it begins with it.
    fn own_name<'a>(&self, name: &'a str) -> Option<&'a str> {
        name.strip_prefix(&self.whose)?.strip_prefix(' ')
    }

    fn spot(&self, name: &str) -> Option<&HomePlace> {
        self.spots.iter().find(|spot| spot.name == name)
    }

    fn find_door(&self, home: &HomeFile, plan: &Plan) -> Option<(HomePlace, Option<usize>)> {
        let names = Role::FrontDoor.row().names;
        let outside = home.doors.iter().position(|door| door.outside);
        let is_place = |spot: &&HomePlace| home.places.iter().any(|place| place.name.to_lowercase() == spot.name);
        let place = names.iter().find_map(|name| self.spot(name).filter(is_place)).cloned();
        let room = names.iter().find_map(|name| self.called(|spot| spot == *name)).cloned();
        let thing =
            outside.or_else(|| names.iter().find_map(|name| self.things.iter().position(|(thing, _)| thing == name)));
        let at_door = || {
            let door = &plan.things[outside?];
            let at = just_inside(plan, door.at);
            Some(HomePlace::named(door.name.to_lowercase(), at, plan.room_at(at)))
        };
        place.or_else(at_door).or(room).map(|spot| (spot, thing))
    }

    /// Reachable places to stand, without beds, seats and doors.
    fn find_stations(&self, home: &HomeFile) -> Vec<ChoreStation> {
        let named = home.places.iter().map(|place| place.name.to_lowercase());
        let door = self.door.as_ref().map(|(spot, _)| spot.name.clone());
        let named: Vec<String> = named.filter(|name| Some(name) != door.as_ref()).collect();
        let reachable = || self.spots.iter().filter(|spot| spot.is_reachable);
        let is_used = |spot: &&HomePlace| named.contains(&spot.name) || !spot.is_room && is_opened(&spot.name);
        let standing = reachable().filter(|spot| spot.posture == Posture::Standing).filter(is_used);
        let stations: Vec<ChoreStation> = standing.map(|spot| self.station(spot)).collect();
        if !stations.is_empty() {
            return stations;
        }
        reachable().filter(|spot| spot.is_room).map(|spot| self.station(spot)).collect()
    }

    fn station(&self, spot: &HomePlace) -> ChoreStation {
        let opened = self.thing_named(&spot.name).filter(|_| is_opened(&spot.name));
        ChoreStation { spot: spot.clone(), chore: chore(&spot.name), opened }
    }
}

/// Marks reachable places. A place with sides uses the first reachable side; a room with a blocked middle uses a point
/// near it.
fn find_ways(
    plan: &Plan,
    spots: &mut [HomePlace],
    sides: Vec<(usize, Vec<Point>)>,
    is_reachable: impl Fn(Point) -> bool,
) {
    /// Number of places of such a room that are tried (our choice): each costs a search for a way.
    const MOST_TRIED: usize = 20;
    spots.iter_mut().for_each(|spot| spot.is_reachable = is_reachable(spot.at));
    let around_middle = |(index, spot): (usize, &HomePlace)| {
        let room = spot.room.filter(|_| spot.is_room && !spot.is_reachable)?;
        Some((index, around_in_room(plan, room, spot.at).into_iter().take(MOST_TRIED).collect()))
    };
    let rooms = spots.iter().enumerate().filter_map(around_middle);
    let around: Vec<(usize, Vec<Point>)> = rooms.chain(sides).collect();
    for (index, around) in around {
        let spot = &mut spots[index];
        if let Some(at) = around.into_iter().find(|&at| !spot.is_reachable && is_reachable(at)) {
            *spot = HomePlace { at, room: plan.room_at(at), is_reachable: true, ..spot.clone() };
        }
    }
}

/// The place with routes to most others; `None` without a place to stand.
fn hub(spots: &[HomePlace], mesh: &Mesh) -> Option<Point> {
    let mut parts: Vec<(Point, usize)> = Vec::new();
    for spot in spots.iter().filter(|spot| mesh.approach(spot.at).is_some()) {
        match parts.iter_mut().find(|(of, _)| mesh.can_reach(*of, spot.at)) {
            Some((_, count)) => *count += 1,
            None => parts.push((spot.at, 1)),
        }
    }
    parts.into_iter().reduce(|a, b| if b.1 > a.1 { b } else { a }).map(|(of, _)| of)
}

/// Such as `ruth's bed`.
fn has_owner(name: &str) -> bool {
    name.contains("'s ")
}

fn is_toilet(spot: &HomePlace) -> bool {
    spot.is_of(Role::Toilet)
}

/// Enterable places for standing.
fn is_for_standing(name: &str) -> bool {
    words(name).any(|word| ["shower", "rug", "mat", "carpet"].iter().any(|end| word.ends_with(end)))
}

fn words(name: &str) -> impl Iterator<Item = &str> {
    name.split(|c: char| !c.is_alphanumeric())
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn places(names: &[&str], resident: &str) -> HomePlaces {
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
        HomePlaces::new(&home, &plan, &Mesh::new(&plan, 0.22), resident)
    }

    fn names(spots: &[&HomePlace]) -> Vec<String> {
        spots.iter().map(|spot| spot.name.clone()).collect()
    }

    #[test]
    fn places_named_after_a_resident_are_their_own() {
        let all = ["Henry's bed", "Ruth's bed", "armchair"];
        let name = |resident, role| places(&all, resident).for_role(role).unwrap().name.clone();
        assert_eq!(name("henry", Role::Bed), "henry's bed");
        assert_eq!(name("Ruth", Role::Bed), "ruth's bed");
        assert_eq!(name("anna", Role::Bed), "armchair");
        assert_eq!(places(&all, "ruth").named("bed").unwrap().name, "ruth's bed");
    }

    #[test]
    fn pets_use_places_of_all_residents() {
        let places = places(&["henry's bed", "ruth's bed", "bed", "bunk bed", "sofa"], "minka");
        assert_eq!(names(&places.all_for(Role::Bed)), ["henry's bed", "ruth's bed", "bed"]);
        assert_eq!(names(&places.all_for(Role::Sofa)), ["sofa"]);
        assert!(places.all_for(Role::Basket).is_empty());
    }

    #[test]
    fn way_out_is_inside_of_a_thick_wall() {
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
            let places = HomePlaces::new(&home, &plan, &Mesh::new(&plan, 0.22), "anna");
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
    fn blocked_middle_of_a_room_is_avoided() {
        let home = json!({
            "name": "island", "rooms": [{ "name": "kitchen", "outline": [[0, 0], [6, 0], [6, 4], [0, 4]] }], "walls": [],
            "furniture": [
                { "name": "island", "at": [3.0, 2.0], "size_m": [2.2, 1.5], "height_m": 0.9 },
                { "name": "bed", "at": [0.6, 2.0], "size_m": [0.9, 2.0], "height_m": 0.5, "enterable": true },
            ],
        });
        let home: HomeFile = serde_json::from_value(home).unwrap();
        let plan = Plan::new(&home);
        let places = HomePlaces::new(&home, &plan, &Mesh::new(&plan, 0.22), "anna");
        let kitchen = places.named("kitchen").unwrap();
        assert!(kitchen.is_room && kitchen.is_reachable && plan.is_walkable(kitchen.at, 0.22), "{}", kitchen.at);
        assert!(kitchen.at.distance(Point::new(3.0, 2.0)) < 1.2, "{}", kitchen.at);
    }

    #[test]
    fn desk_has_a_seat() {
        let places = places(&["desk", "desk chair"], "anna");
        let spot = places.for_role(Role::Desk).unwrap();
        assert_eq!((spot.name.as_str(), spot.posture), ("desk chair", Posture::Sitting));
    }

    #[test]
    fn name_decides_the_posture() {
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
    fn furniture_in_a_narrow_place_is_used_from_its_edge() {
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
            HomePlaces::new(&home, &plan, &Mesh::new(&plan, 0.22), "anna")
                .for_role(Role::Washbasin)
                .unwrap()
                .is_reachable
        };
        let before = [1.05, 2.0, 0.7, 0.6];
        assert!(is_reached(&[before, [0.9, 3.0, 0.6, 1.1], [0.9, 1.0, 0.6, 1.1]]));
        let around = [[0.5, 3.0, 1.0, 1.1], [0.5, 1.0, 1.0, 1.1]];
        assert!(!is_reached(&[before, around[0], around[1]]));
    }
}
