//! Faults in the meaning of a scenario's files: one file here for each of theirs.

pub mod home;
pub mod input;
pub mod link;
pub mod logger;
pub mod messages;
pub mod path;
pub mod resident;
pub mod scenario;

use crate::geometry::{self, At, Point, point};
use crate::home::form::HomeFile;
use crate::nearest::{nearest, some_names};
use crate::plan::{Origin, Plan, Solid};
use crate::problem::{Diagnostic, MOST_PER_FILE, Problem};
use crate::scenario::source::JsonSource;
use messages::{NameMessage, RangeMessage};

/// The home, for the checks of other files.
pub struct HomeInCheck<'a> {
    /// Nothing if its shape is wrong.
    pub home: Option<&'a HomeFile>,
    /// Nothing if its rooms, walls, doors or furniture are wrong: the way through them would be, too.
    pub plan: Option<&'a Plan>,
}

/// Nearer than this counts as touching.
const TOLERANCE_M: f64 = 1e-6;

struct ProblemReport<'a> {
    source: &'a JsonSource,
    problems: &'a mut Vec<Problem>,
}

impl ProblemReport<'_> {
    fn add(&mut self, pointer: &str, what: impl Into<Diagnostic>) {
        self.problems.push(self.source.problem(pointer, what, None));
    }

    /// A problem with a key rather than with its value.
    fn add_to_key(&mut self, pointer: &str, what: impl Into<Diagnostic>) {
        self.problems.push(self.source.problem_with_key(pointer, what, None));
    }

    fn count(&self) -> usize {
        self.problems.len()
    }

    /// The nearest known name and some of the known names, for problems that are shown only: the search takes long with many names
    /// on both sides.
    fn names_for<'a>(&self, name: &str, known: impl Iterator<Item = &'a str> + Clone) -> (Option<String>, Vec<String>) {
        match self.count() < MOST_PER_FILE {
            true => (nearest(name, known.clone()).map(str::to_owned), some_names(known)),
            false => (None, Vec::new()),
        }
    }

    /// Names that are blank, or contain characters that would break a table or a terminal.
    fn name(&mut self, pointer: &str, name: &str) {
        if name.trim().is_empty() {
            self.add(pointer, NameMessage::Blank);
        } else if name.chars().any(char::is_control) {
            self.add(pointer, NameMessage::ControlCharacter { name: name.to_owned() });
        }
    }

    /// A pair of a least and a most value in the wrong order.
    fn range(&mut self, pointer: &str, key: &str, [first, second]: [f64; 2]) {
        if first > second {
            self.add(pointer, RangeMessage::Reversed { key: key.to_owned(), first, second });
        }
    }
}

/// Names as far as they tell things apart: case and surrounding blanks do not.
fn folded(name: &str) -> String {
    name.trim().to_lowercase()
}

/// A point as messages write it.
fn at(p: Point) -> String {
    let short = |value: f64| (value * 1000.0).round() / 1000.0 + 0.0;
    format!("({}, {})", short(p.x), short(p.y))
}

fn solid_name(home: &HomeFile, solid: &Solid) -> String {
    match solid.origin {
        Origin::Wall(index) => {
            let wall = &home.walls[index];
            wall_name(home, &solid.outline)
                .unwrap_or_else(|| format!("the wall from {} to {}", at(point(wall.from)), at(point(wall.to))))
        }
        Origin::Door(index) => format!("the closed door {:?}", home.doors[index].name),
        Origin::Furniture(index) => format!("{:?}", home.furniture[index].name),
    }
}

/// A piece of a wall by the rooms on its sides; `None` if there are several on both.
fn wall_name(home: &HomeFile, piece: &[Point]) -> Option<String> {
    /// Distance from a wall to the room that it bounds, in metres (our choice).
    const BESIDE_M: f64 = 0.15;
    // The corners run along the wall, then across.
    let &[a, b, c, d] = piece else { return None };
    let across = (c - b).normalize_or_zero();
    let rooms = |from: Point, to: Point, off: Point| {
        let probes = (1..8).map(move |part| from.lerp(to, f64::from(part) / 8.0) + off);
        let holds = |outline: &[At], p: Point| geometry::contains(&geometry::points(outline), p);
        let all: Vec<&str> = (home.rooms.iter())
            .filter(|room| probes.clone().any(|probe| holds(&room.outline, probe)))
            .map(|room| room.name.as_str())
            .collect();
        all
    };
    match (&rooms(a, b, -across * BESIDE_M)[..], &rooms(d, c, across * BESIDE_M)[..]) {
        ([one], [other]) if one == other => Some(format!("a wall in {one:?}")),
        ([one], [other]) => Some(format!("the wall between {:?} and {:?}", one.min(other), one.max(other))),
        ([room], []) => Some(format!("the {} wall of {room:?}", geometry::compass(across))),
        ([], [room]) => Some(format!("the {} wall of {room:?}", geometry::compass(-across))),
        ([_, ..], []) => Some(format!("the {} wall", geometry::compass(across))),
        ([], [_, ..]) => Some(format!("the {} wall", geometry::compass(-across))),
        _ => None,
    }
}

/// Whether the point is in the solid, deeper than its surface.
fn is_within(solid: &Solid, p: Point) -> bool {
    geometry::contains(&solid.outline, p) && geometry::distance_to_border(&solid.outline, p) > TOLERANCE_M
}

/// The first solid that stops bodies and has the point in it.
fn blocking(plan: &Plan, p: Point) -> Option<&Solid> {
    plan.solids.iter().find(|solid| solid.stops_bodies && is_within(solid, p))
}
