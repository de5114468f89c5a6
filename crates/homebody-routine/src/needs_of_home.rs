//! The furniture, doors and routes that a routine needs in a home.

use crate::behaviour::places::{HomePlace, HomePlaces};
use crate::behaviour::script::ACTED_ON;
use crate::messages::NeedMessage;
use crate::room_for::{self, MissingFurniture, NEEDS};
use crate::routine::{Activity, Effect, FallEnds, Habit, Quote, Response, Routine, RoutineRule, USUAL, shows};
use homebody_core::geometry;
use homebody_core::home::form::HomeFile;
use homebody_core::numbers::Numbers;
use homebody_core::plan::form::FurnitureFile;
use homebody_core::plan::{self, Plan};
use homebody_core::problem::{Advice, Problem};
use homebody_core::resident::ResidentFile;
use homebody_core::role::Role;
use homebody_core::scenario::load::Scenario;
use homebody_walk::Mesh;
use std::collections::{BTreeMap, BTreeSet};

/// Reports missing and unreachable places for one resident, with the conditions of the routine. `others` is the number of
/// other people in the home.
pub fn check(
    scenario: &Scenario,
    resident: &ResidentFile,
    routine: &Routine,
    conditions: &BTreeMap<String, Routine>,
    others: usize,
) -> Vec<Problem> {
    let plan = scenario.home.plan();
    let places = HomePlaces::new(&scenario.home, plan, &mesh(plan, resident, scenario.home.numbers()), &resident.name);
    let texts = with_conditions(routine, conditions);
    let mut check = NeedsCheck {
        home: &scenario.home,
        numbers: scenario.home.numbers(),
        resident,
        others,
        file: &routine.file,
        bed: String::new(),
        lacking: MissingFurniture::default(),
        told: BTreeSet::new(),
        problems: Vec::new(),
    };
    check.all(&places, &texts, routine.is_of_person());
    check.problems
}

/// The furniture that a routine needs and the home lacks, each piece in a free place. With all pieces, the home meets the
/// needs of all residents. `None` if the resident can reach everything.
pub fn additions(
    scenario: &Scenario,
    resident: &ResidentFile,
    routine: &Routine,
    conditions: &BTreeMap<String, Routine>,
) -> Vec<FurnitureFile> {
    let (home, plan, numbers) = (&scenario.home, scenario.home.plan(), scenario.home.numbers());
    let places = HomePlaces::new(home, plan, &mesh(plan, resident, numbers), &resident.name);
    let lacking = lacking(home, resident, numbers, &places, &with_conditions(routine, conditions));
    lacking.pieces.into_iter().filter_map(|(_, piece)| piece).collect()
}

fn lacking(
    home: &HomeFile,
    resident: &ResidentFile,
    numbers: &Numbers,
    places: &HomePlaces,
    texts: &[&Routine],
) -> MissingFurniture {
    let is_there = |role: &Role| places.for_role(*role).is_some_and(|spot| spot.is_reachable);
    let used = used_roles(places, texts).into_iter().map(|(role, _)| role);
    let unreached: Vec<Role> = used.filter(|&role| places.out_of_reach(role).is_some()).collect();
    if NEEDS.iter().all(is_there) && unreached.is_empty() {
        return MissingFurniture::default();
    }
    room_for::lacking(home, &unreached, resident, numbers)
}

/// Names, in lower case, of the things that a resident opens, turns on or lets run.
pub fn used_things(
    home: &HomeFile,
    plan: &Plan,
    resident: &ResidentFile,
    routine: &Routine,
    conditions: &BTreeMap<String, Routine>,
) -> BTreeSet<String> {
    let places = HomePlaces::new(home, plan, &mesh(plan, resident, &Numbers::default()), &resident.name);
    let texts = with_conditions(routine, conditions);
    let roles = used_roles(&places, &texts).into_iter().map(|(role, _)| role).filter(|role| ACTED_ON.contains(role));
    // Visitors fetch the mail too, and the television stands in front of its seat.
    let things = roles.chain([Role::FrontDoor, Role::Television]).filter_map(|role| places.thing(role));
    let things = things.map(|thing| places.thing_name(thing).to_owned());
    // All of these are used in turn.
    let warmers = places.all_for(Role::FoodWarmer).into_iter().map(|spot| spot.name.clone());
    let opened = places.stations().iter().filter(|station| station.opened.is_some());
    let opened = opened.map(|station| station.spot.name.clone());
    let answers = texts.iter().flat_map(|text| &text.rules).flat_map(RoutineRule::answers);
    let turned = answers.filter_map(|answer| match answer {
        Response::Turn { thing, .. } => Some(thing.to_lowercase()),
        Response::Do { .. } => None,
    });
    let meanwhile = texts.iter().flat_map(|text| &text.habits).filter_map(|habit| habit.thing_on.as_deref());
    let kept = texts.iter().flat_map(|text| &text.changes).filter_map(|change| match &change.effect {
        Effect::KeepsOn { thing } => Some(thing.as_str()),
        _ => None,
    });
    let on = meanwhile.chain(kept).map(str::to_lowercase);
    things.chain(warmers).chain(opened).chain(turned).chain(on).collect()
}

/// Including the conditions of conditions.
fn with_conditions<'t>(routine: &'t Routine, conditions: &'t BTreeMap<String, Routine>) -> Vec<&'t Routine> {
    let mut texts = vec![routine];
    let mut next = 0;
    while let Some(text) = texts.get(next) {
        let shown: Vec<&Routine> = shows(text).filter_map(|name| conditions.get(name)).collect();
        texts.extend(
            shown.into_iter().filter(|shown| !texts.iter().any(|known| known.file == shown.file)).collect::<Vec<_>>(),
        );
        next += 1;
    }
    texts
}

fn mesh(plan: &Plan, resident: &ResidentFile, numbers: &Numbers) -> Mesh {
    Mesh::with_numbers(plan, resident.radius_m, numbers)
}

/// Number of unreachable places whose obstacle is searched for (our choice): each takes a while.
const MOST_EXPLAINED: usize = 3;

/// Number of pieces of furniture that are tried for each (our choice).
const MOST_PIECES: usize = 12;

/// A role that all residents need, with the message about its absence.
type BasicNeed = (Role, fn(Advice) -> NeedMessage);

const BASIC_NEEDS: [BasicNeed; 4] = [
    (Role::Bed, |example| NeedMessage::NoBed { example }),
    (Role::Toilet, |example| NeedMessage::NoToilet { example }),
    (Role::Armchair, |example| NeedMessage::NoSeat { example }),
    (Role::Fridge, |example| NeedMessage::NoKitchen { example }),
];

struct NeedsCheck<'a> {
    home: &'a HomeFile,
    numbers: &'a Numbers,
    resident: &'a ResidentFile,
    others: usize,
    /// The routine's file.
    file: &'a str,
    bed: String,
    /// Unreachable roles, with a place for each.
    lacking: MissingFurniture,
    /// Places already reported.
    told: BTreeSet<String>,
    problems: Vec<Problem>,
}

impl NeedsCheck<'_> {
    fn all(&mut self, places: &HomePlaces, texts: &[&Routine], is_person: bool) {
        let anybodys = || places.all_for(Role::Bed).into_iter().next().filter(|_| !is_person);
        if is_person {
            self.lacking = lacking(self.home, self.resident, self.numbers, places, texts);
            self.missing(places);
        }
        let Some(bed) = places.for_role(Role::Bed).or_else(anybodys) else {
            if !is_person {
                self.say(None, NeedMessage::NoBed { example: Advice::from("") });
            }
            return;
        };
        self.bed = bed.name.clone();
        // A resident who cannot leave the bed reaches nothing.
        let boxed_in = places.out_of_reach(Role::Bed).filter(|_| is_person);
        if let Some(bed) = boxed_in {
            let help = self.instead(Role::Bed).after(&self.what_to_do(bed));
            let (resident, from) = (self.resident.name.clone(), bed.name.clone());
            return self.say(None, NeedMessage::BoxedIn { resident, from, help });
        }
        let of_pets = [(Role::Basket, None), (Role::FoodBowl, None)];
        let used = if is_person { used_roles(places, texts) } else { of_pets.into() };
        for (role, said) in used {
            if let Some(spot) = places.out_of_reach(role) {
                self.no_way(spot, said, self.instead(role));
            }
        }
        for (place, said) in texts.iter().flat_map(|text| named_places(text)) {
            if let Some(spot) = places.named(place).filter(|spot| !spot.is_reachable) {
                self.no_way(&HomePlace { name: place.to_owned(), ..spot.clone() }, Some(said), Advice::from(""));
            }
        }
        let goes_out = |activity: &Activity| matches!(activity, Activity::Leave | Activity::Visit);
        let outing = texts[0].habits.iter().find(|habit| goes_out(&habit.activity));
        if let (Some(habit), None) = (outing, places.for_role(Role::FrontDoor)) {
            self.say(Some((self.file, &habit.said)), NeedMessage::NoWayOut);
        }
        self.unfound(texts);
    }

    /// A resident waits on the floor for help, and no other person lives there or visits.
    fn unfound(&mut self, texts: &[&Routine]) {
        let habits = || texts.iter().flat_map(|text| text.habits.iter().map(move |habit| (text.file.as_str(), habit)));
        if self.others > 0 || habits().any(|(_, habit)| habit.visitor.is_some()) {
            return;
        }
        let waits = |habit: &Habit| habit.falling.is_some_and(|falling| falling.ends == FallEnds::Found);
        if let Some((file, habit)) = habits().find(|(_, habit)| waits(habit)) {
            let resident = self.resident.name.clone();
            self.say(Some((file, &habit.said)), NeedMessage::Unfound { resident });
        }
    }

    /// Reports each missing basic piece with a place for it. With all of them, each routine can run.
    fn missing(&mut self, places: &HomePlaces) {
        for (role, message) in BASIC_NEEDS {
            if places.for_role(role).is_none() {
                let piece = self.lacking.piece(role);
                let example = piece.map_or_else(|| Advice::from(self.no_room()), |piece| self.example(piece));
                self.say(None, message(example.after("; ")));
            }
        }
    }

    /// Another piece for an unreachable role, if there is room.
    fn instead(&self, role: Role) -> Advice {
        let example = self.lacking.piece(role).map(|piece| self.example(piece));
        example.map_or_else(|| Advice::from(""), |example| example.after(", or another such piece; "))
    }

    /// As an entry of `home.json`, with its room.
    fn example(&self, piece: &FurnitureFile) -> Advice {
        let outline = plan::furniture_outline(piece);
        let room = Plan::new(self.home).room_at(geometry::inner_point(&outline));
        let room = room.map(|room| self.home.rooms[room].name.clone());
        Advice::addition(serde_json::to_value(piece).unwrap_or_default(), room)
    }

    fn no_room(&self) -> String {
        /// Largest number of names in one message (our choice).
        const NAMED: usize = 6;
        let rooms = &self.lacking.rooms;
        let named: Vec<String> = rooms.iter().take(NAMED).map(|room| format!("{room:?}")).collect();
        let more = if rooms.len() > NAMED { " and others" } else { "" };
        match named.is_empty() {
            true => "no room has space to stand".to_owned(),
            false => format!("no space for one is left in the accessible rooms {}{more}", named.join(", ")),
        }
    }

    fn no_way(&mut self, spot: &HomePlace, said: Option<(&str, &Quote)>, instead: Advice) {
        if self.told.insert(spot.name.to_lowercase()) {
            let help = instead.after(&self.what_to_do(spot));
            let (resident, from, to) = (self.resident.name.clone(), self.bed.clone(), spot.name.clone());
            self.say(said, NeedMessage::NoWay { resident, from, to, help });
        }
    }

    fn say(&mut self, said: Option<(&str, &Quote)>, message: NeedMessage) {
        let mut problem = Problem::of_file(said.map_or(self.file, |(file, _)| file), message, None);
        if let Some((_, said)) = said {
            (problem.line, problem.column) = (said.line, said.column);
        }
        self.problems.push(problem);
    }

    /// Single doors to open or pieces to move that would make a route; else the surrounding pieces.
    fn what_to_do(&self, to: &HomePlace) -> String {
        let mut ways: Vec<String> = Vec::new();
        if self.told.len() <= MOST_EXPLAINED {
            for (index, door) in self.home.doors.iter().enumerate().filter(|(_, door)| !door.open && !door.outside) {
                let mut home = self.home.clone();
                home.doors[index].open = true;
                ways.extend(self.is_reachable_in(&home, to).then(|| format!("open {:?}", door.name)));
            }
            for index in self.nearest_pieces(to, f64::INFINITY) {
                let mut home = self.home.clone();
                let piece = home.furniture.remove(index);
                ways.extend(self.is_reachable_in(&home, to).then(|| format!("move {:?}", piece.name)));
            }
        }
        if !ways.is_empty() {
            return ways.join(", or ");
        }
        let mut hint =
            "draw the home with `homebody plan` and look for a closed door, a wall or furniture in the way".to_owned();
        let around: Vec<String> = self
            .nearest_pieces(to, 2.0 * self.resident.radius_m)
            .iter()
            .map(|&index| format!("{:?}", self.home.furniture[index].name))
            .collect();
        if !around.is_empty() {
            hint += &format!(" such as {}", around.join(", "));
        }
        hint
    }

    fn is_reachable_in(&self, home: &HomeFile, to: &HomePlace) -> bool {
        let plan = Plan::new(home);
        let places = HomePlaces::new(home, &plan, &mesh(&plan, self.resident, self.numbers), &self.resident.name);
        places.named(&to.name).is_some_and(|spot| spot.is_reachable)
    }

    /// Pieces within a distance of a place, without the place itself, the nearest first.
    fn nearest_pieces(&self, to: &HomePlace, most_m: f64) -> Vec<usize> {
        let others = self
            .home
            .furniture
            .iter()
            .enumerate()
            .filter(|(_, piece)| piece.name.to_lowercase() != to.name.to_lowercase());
        let away =
            others.map(|(index, piece)| (index, geometry::distance_to_area(&plan::furniture_outline(piece), to.at)));
        let mut near: Vec<(usize, f64)> = away.filter(|(_, away_m)| *away_m <= most_m).collect();
        near.sort_by(|a, b| a.1.total_cmp(&b.1));
        near.into_iter().take(MOST_PIECES).map(|(index, _)| index).collect()
    }
}

/// Each with the first sentence that uses it, if any.
fn used_roles<'t>(places: &HomePlaces, texts: &[&'t Routine]) -> Vec<(Role, Option<(&'t str, &'t Quote)>)> {
    let mut used: Vec<(Activity, Option<(&str, &Quote)>)> = Vec::new();
    for text in texts {
        let done = text.habits.iter().filter(|habit| {
            habit.when.chance.probability > 0.0
                || habit.when.chance.becomes.is_some_and(|(probability, _)| probability > 0.0)
        });
        used.extend(done.map(|habit| (habit.activity.clone(), Some((text.file.as_str(), &habit.said)))));
        for rule in &text.rules {
            for answer in rule.answers() {
                if let Response::Do { activity, .. } = answer {
                    used.push((activity.clone(), Some((text.file.as_str(), &rule.said))));
                }
            }
        }
    }
    // Usual activities that the text does not mention.
    let is_mentioned = |activity: &Activity| texts[0].habits.iter().any(|habit| habit.activity == *activity);
    let unsaid = USUAL.iter().chain(&[Activity::Relax, Activity::Nap]).filter(|activity| !is_mentioned(activity));
    used.extend(unsaid.cloned().map(|activity| (activity, None)));
    if places.has(Role::Desk) {
        used.push((Activity::UseComputer, None));
    }
    let mut all: Vec<(Role, Option<(&str, &Quote)>)> = Vec::new();
    let falls = texts.iter().flat_map(|text| text.habits.iter().map(move |habit| (habit, text.file.as_str())));
    let falls = falls.filter_map(|(habit, file)| Some((habit.falling?.roles(), Some((file, &habit.said)))));
    let of_doing = used.into_iter().map(|(activity, said)| (activity.roles().to_vec(), said));
    for (roles, said) in of_doing.chain(falls) {
        for role in roles {
            if all.iter().all(|(known, _)| *known != role) {
                all.push((role, said));
            }
        }
    }
    all
}

/// Places of activities and switched things, each with its sentence.
fn named_places(text: &Routine) -> Vec<(&str, (&str, &Quote))> {
    let file = text.file.as_str();
    let habits = text.habits.iter().filter_map(|habit| Some((habit.place.as_deref()?, (file, &habit.said))));
    let answers = text.rules.iter().flat_map(|rule| rule.answers().map(move |answer| (rule, answer)));
    let rules = answers.filter_map(|(rule, answer)| {
        let place = match answer {
            Response::Turn { thing, .. } => Some(thing.as_str()),
            Response::Do { place, .. } => place.as_deref(),
        };
        Some((place?, (file, &rule.said)))
    });
    habits.chain(rules).collect()
}
