//! The path of an annotated recording.
//!
//! Known are the rooms of the person, and the movements: walking, turning, sitting, lying. Each part of the path has the annotated times
//! and posture, and the person passes a door at the instant at which the room changes.
//!
//! We assume the goals of walks inside a room. A goal is a floor point whose path has the right length at a usual pace; a long walk goes
//! to and fro between far ends of the room. A person who sits or lies next goes to a seat or bed. An annotated posture is kept still, and an
//! annotated change of posture is one movement on the spot.
//!
//! For each stay in a room, the module cuts the annotation into pieces, finds the doors before and after, gives each walk a goal, and
//! lengthens a hurried walk at the expense of the time before and after it.
//!
//! Left out: kneeling and squatting are as low as sitting, bending as high as standing.

use super::house::SphereHouse;
use super::{AnnotatedRun, Interval};
use homebody_core::drivers::path::form::{Go, PathFile, PathStep, StirFile, Wait};
use homebody_core::geometry::Point;
use homebody_core::plan::Plan;
use homebody_core::plan::form::Spot;
use homebody_core::posture::Posture;
use homebody_core::time::{RunTime, SECOND, Span};

/// Pace of adults who follow a script indoors, in metres a second.
const PACE_MPS: f64 = 0.8;
/// Speed above which a walk takes time from the stays before and after it (our choice).
const HURRIED_MPS: f64 = 1.5;
/// Time before leaving a room after which a person does not stand in its door (our choice).
const IN_DOORWAY: Span = SECOND.times(3);
/// Shortest walk between two points (our choice).
const LEAST_WALK_M: f64 = 0.4;

homebody_core::messages! {
    /// Reasons why a recording cannot be placed in a home.
    #[derive(Clone, PartialEq, Eq)]
    pub enum PlacementError in "sphere" {
        /// The recording names a room that the home does not have, or one whose furniture leaves no place for a body.
        Room(room: String) error "no-room" ("the home has no room {room:?}, or the room has no space for a person");
        /// The person of the recording walks from one room to the other. In the home no doors and rooms connect them.
        Way { from: String, to: String } error "no-way" ("no way leads from {from:?} to {to:?}");
        /// The annotations of the SPHERE challenge have some twenty names of movements. This one is another.
        Movement(name: String) error "unknown-movement" ("the annotation {name:?} is not a known movement");
    }
}

/// The path of a recording through a home. Its second 0 is the first annotated instant, [`AnnotatedRun::begin_s`].
pub fn path_of(run: &AnnotatedRun, house: &mut SphereHouse) -> Result<PathFile, PlacementError> {
    let plan = house.plan;
    let stays = stays(run, plan)?;
    let doors = doors(&stays, house)?;
    let mut here = start(&stays[0], doors.first().copied(), house)
        .ok_or_else(|| PlacementError::Room(plan.rooms[stays[0].room].name.clone()))?;
    let start = spot(here);
    let posture = stays[0].pieces.first().map_or(Posture::Standing, |piece| piece.doing.posture());
    let rooms: Vec<usize> = stays.iter().map(|stay| stay.room).collect();
    let mut steps = Vec::new();
    for (index, mut stay) in stays.into_iter().enumerate() {
        let ways = walk(&mut stay, &mut here, doors.get(index).copied(), house).ok_or_else(|| {
            let name = |room: usize| plan.rooms[room].name.clone();
            // Only a door can be out of reach.
            PlacementError::Way { from: name(rooms[index]), to: name(*rooms.get(index + 1).unwrap_or(&rooms[index])) }
        })?;
        unhurry(&mut stay.pieces, &ways);
        let mut ways = ways.into_iter();
        for piece in &stay.pieces {
            let way = if piece.doing == Annotated::Walk { ways.next() } else { None };
            steps.extend(step(piece, way));
        }
    }
    Ok(PathFile { schema: None, start, posture, steps })
}

struct PathStay {
    room: usize,
    pieces: Vec<Piece>,
}

impl PathStay {
    /// Adds the next piece; a walk after a walk is the same walk.
    fn push(&mut self, piece: Piece) {
        match self.pieces.last_mut() {
            Some(last) if last.doing == Annotated::Walk && piece.doing == Annotated::Walk => last.end = piece.end,
            _ => self.pieces.push(piece),
        }
    }

    fn lasts(&self) -> Span {
        self.pieces.iter().map(Piece::lasts).sum()
    }
}

/// A part of a stay with one kind of movement. The run starts at the first annotated instant.
#[derive(Clone, Copy, Debug)]
struct Piece {
    begin: RunTime,
    end: RunTime,
    doing: Annotated,
}

impl Piece {
    fn lasts(&self) -> Span {
        self.end - self.begin
    }

    fn walked_m(&self) -> f64 {
        PACE_MPS * self.lasts().seconds()
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Annotated {
    Walk,
    InPlace {
        posture: Posture,
        amplitude_m: f64,
    },
    Still {
        posture: Posture,
        /// True for a seat or a bed, false for the floor.
        seated: bool,
    },
}

impl Annotated {
    /// The meaning of an annotation; `before` is the posture before it.
    ///
    /// The amplitudes are ours: the head and trunk of an adult who sits down or bends move down by half a metre, a turn moves the
    /// shoulders.
    fn parse(name: &str, before: Posture) -> Option<Annotated> {
        let in_place = |posture, amplitude_m| Annotated::InPlace { posture, amplitude_m };
        let still = |posture, seated| Annotated::Still { posture, seated };
        Some(match name {
            "a_walk" | "a_loadwalk" | "a_ascend" | "a_descend" => Annotated::Walk,
            "a_jump" => in_place(Posture::Standing, 0.3),
            "t_turn" => in_place(before, 0.3),
            "t_bend" | "t_straighten" | "t_stand_sit" | "t_sit_stand" | "t_stand_kneel" | "t_kneel_stand" => {
                in_place(Posture::Standing, 0.5)
            }
            "t_sit_lie" | "t_lie_sit" => in_place(Posture::Sitting, 0.5),
            "p_stand" | "p_bent" => still(Posture::Standing, false),
            "p_kneel" | "p_squat" => still(Posture::Sitting, false),
            "p_sit" => still(Posture::Sitting, true),
            "p_lie" => still(Posture::Lying, true),
            _ => return None,
        })
    }

    fn posture(self) -> Posture {
        match self {
            Annotated::Walk => Posture::Standing,
            Annotated::InPlace { posture, .. } | Annotated::Still { posture, .. } => posture,
        }
    }
}

/// The recording as stays, each with its pieces. A gap in the annotation keeps the posture before it, and a walk before and
/// after a gap continues.
fn stays(run: &AnnotatedRun, plan: &Plan) -> Result<Vec<PathStay>, PlacementError> {
    let begin_s = run.begin_s();
    let instant = |second: f64| RunTime::START + Span::from_seconds(second - begin_s);
    let mut pieces: Vec<Piece> = Vec::new();
    let mut posture = Posture::Standing;
    for Interval { start_s, end_s, name } in &run.movements {
        let doing = Annotated::parse(name, posture).ok_or_else(|| PlacementError::Movement(name.clone()))?;
        let before = pieces.last().copied().unwrap_or(Piece {
            begin: RunTime::START,
            end: RunTime::START,
            doing: Annotated::Still { posture, seated: false },
        });
        let walks_on = doing == Annotated::Walk && before.doing == Annotated::Walk;
        let gap = if walks_on { Annotated::Walk } else { Annotated::Still { posture, seated: false } };
        pieces.push(Piece { begin: before.end, end: instant(*start_s), doing: gap });
        pieces.push(Piece { begin: instant(*start_s), end: instant(*end_s), doing });
        posture = doing.posture();
    }
    let end = pieces.last().map_or(RunTime::START, |piece| piece.end);
    pieces.push(Piece { begin: end, end: instant(run.end_s()), doing: Annotated::Still { posture, seated: false } });

    let mut stays: Vec<PathStay> = Vec::new();
    for (index, Interval { start_s, name, .. }) in run.rooms.iter().enumerate() {
        let room = room_of(name, plan)?;
        let begin = if index == 0 { RunTime::START } else { instant(*start_s) };
        let end = run.rooms.get(index + 1).map_or(instant(run.end_s()), |next| instant(next.start_s));
        let cut = |piece: &Piece| Piece { begin: piece.begin.max(begin), end: piece.end.min(end), ..*piece };
        let within = pieces.iter().map(cut).filter(|piece| piece.end > piece.begin);
        if stays.last().is_none_or(|last| last.room != room) {
            stays.push(PathStay { room, pieces: Vec::new() });
        }
        let stay = stays.last_mut().expect("pushed where there was none");
        within.for_each(|piece| stay.push(piece));
    }
    Ok(stays)
}

/// The door of the person at the end of each stay but the last.
///
/// If rooms are not next to each other, the person walked through the one in between without an annotation. We count it to the
/// shorter of the two stays, which is a passage, too.
fn doors(stays: &[PathStay], house: &SphereHouse) -> Result<Vec<Point>, PlacementError> {
    let door = |[before, after]: [&PathStay; 2]| {
        door_between([before.room, after.room], before.lasts() < after.lasts(), house)
    };
    stays.windows(2).map(|pair| door([&pair[0], &pair[1]])).collect()
}

/// The door between two rooms: the last on the path if the rooms in between count to the first room, else the first.
pub(super) fn door_between(
    [from, to]: [usize; 2],
    in_first: bool,
    house: &SphereHouse,
) -> Result<Point, PlacementError> {
    let way = house.doors_between(from, to);
    let door = if in_first { way.last() } else { way.first() };
    let name = |room: usize| house.plan.rooms[room].name.clone();
    door.copied().ok_or_else(|| PlacementError::Way { from: name(from), to: name(to) })
}

pub(super) fn room_of(name: &str, plan: &Plan) -> Result<usize, PlacementError> {
    plan.rooms.iter().position(|room| room.name == name).ok_or_else(|| PlacementError::Room(name.to_owned()))
}

/// A point of the first room as far from its exit as the length of the walks in it.
fn start(stay: &PathStay, exit: Option<Point>, house: &mut SphereHouse) -> Option<Point> {
    let walks = stay.pieces.iter().filter(|piece| piece.doing == Annotated::Walk);
    let length_m: f64 = walks.map(Piece::walked_m).sum();
    let to_exit_m = exit.map(|exit| house.floor_distances_m(exit, stay.room));
    let floor = house.floor(stay.room);
    let off_m = |index: usize| to_exit_m.as_ref().map_or(0.0, |to_exit_m| (to_exit_m[index] - length_m).abs());
    least_off(floor.len(), off_m).map(|index| floor[index])
}

#[derive(Debug, Default)]
struct WalkRoute {
    to: Vec<Point>,
    length_m: f64,
}

/// Gives each walk of a stay its path, and moves `here` to the end of the last one; `None` if the exit cannot be reached.
fn walk(stay: &mut PathStay, here: &mut Point, exit: Option<Point>, house: &mut SphereHouse) -> Option<Vec<WalkRoute>> {
    let last_walk = stay.pieces.iter().rposition(|piece| piece.doing == Annotated::Walk);
    let pause = stay.pieces.iter().skip(last_walk.map_or(0, |index| index + 1));
    let pause: Span = pause.map(Piece::lasts).sum();
    if let Some(end) = stay.pieces.last().map(|piece| piece.end)
        && exit.is_some_and(|exit| exit != *here)
        && (last_walk.is_none() || pause > IN_DOORWAY)
    {
        // They left, but no walk to the door is annotated: one without length, to be lengthened.
        stay.pieces.push(Piece { begin: end, end, doing: Annotated::Walk });
    }
    let to_exit_m = exit.map(|exit| house.floor_distances_m(exit, stay.room));
    let walks: Vec<usize> =
        (0..stay.pieces.len()).filter(|&index| stay.pieces[index].doing == Annotated::Walk).collect();
    let mut ways = Vec::new();
    for (nth, &index) in walks.iter().enumerate() {
        let next = walks.get(nth + 1).copied();
        let length_m = stay.pieces[index].walked_m();
        let later_m: f64 = stay.pieces[index + 1..].iter().map(Piece::walked_m).sum();
        let pause = &stay.pieces[index + 1..next.unwrap_or(stay.pieces.len())];
        let goal = match (next, exit) {
            (None, Some(exit)) => Some(exit),
            _ => seat(pause, stay.room, *here, house),
        };
        let too_far_m =
            |floor: usize| to_exit_m.as_ref().map_or(0.0, |to_exit_m| (to_exit_m[floor] - later_m).max(0.0));
        ways.push(tour(here, goal, stay.room, length_m, too_far_m, house)?);
    }
    Some(ways)
}

/// The place of the pause after a walk, if not on the floor: the largest bed or the nearest seat.
fn seat(pause: &[Piece], room: usize, here: Point, house: &mut SphereHouse) -> Option<Point> {
    let postures = pause.iter().filter_map(|piece| match piece.doing {
        Annotated::Still { posture, seated: true } => Some(posture),
        _ => None,
    });
    let lowest = postures.max()?;
    let seats = house.seats(room).into_iter().filter_map(|(at, extent_m)| {
        let away_m = house.way(here, at)?.length_m;
        Some((at, if lowest == Posture::Lying { -extent_m } else { away_m }))
    });
    seats.min_by(|(_, a), (_, b)| a.total_cmp(b)).map(|(at, _)| at)
}

/// A walk of about this length from `here` to the goal, or to any floor point that is not too far from the next goal. A long
/// walk goes to and fro, first to the far end of the room. `None` without a path to the goal.
fn tour(
    here: &mut Point,
    goal: Option<Point>,
    room: usize,
    length_m: f64,
    too_far_m: impl Fn(usize) -> f64,
    house: &mut SphereHouse,
) -> Option<WalkRoute> {
    let to_goal_m = goal.map(|goal| house.floor_distances_m(goal, room));
    let (mut way, mut left_m) = (WalkRoute::default(), length_m);
    loop {
        let away_m = house.floor_distances_m(*here, room);
        let farthest =
            least_off(away_m.len(), |floor| if away_m[floor].is_finite() { -away_m[floor] } else { f64::INFINITY });
        let detour = farthest.filter(|&far| {
            let rest_m = to_goal_m.as_ref().map_or(0.0, |to_goal_m| to_goal_m[far]);
            away_m[far] > LEAST_WALK_M && away_m[far] + rest_m + too_far_m(far) < left_m
        });
        if let Some(far) = detour {
            extend(&mut way, here, house.floor(room)[far], house)?;
            left_m -= away_m[far];
            continue;
        }
        let fitting_m = left_m.max(LEAST_WALK_M);
        let off_m = |floor: usize| (away_m[floor] - fitting_m).abs() + too_far_m(floor);
        let fitting = || least_off(away_m.len(), off_m).map(|floor| house.floor(room)[floor]);
        if let Some(end) = goal.or_else(fitting) {
            extend(&mut way, here, end, house)?;
        }
        return Some(way);
    }
}

fn extend(walked: &mut WalkRoute, here: &mut Point, to: Point, house: &mut SphereHouse) -> Option<()> {
    let way = house.way(*here, to)?;
    for &corner in &*way.to {
        let last = walked.to.last().copied().unwrap_or(*here);
        // Corners that a file cannot tell apart are one.
        if spot(corner) != spot(last) {
            walked.to.push(corner);
        }
    }
    walked.length_m += way.length_m;
    *here = to;
    Some(())
}

/// The index with the least deviation; `None` if all are infinite.
fn least_off(count: usize, off_m: impl Fn(usize) -> f64) -> Option<usize> {
    let least = (0..count).map(|index| (index, off_m(index))).min_by(|(_, a), (_, b)| a.total_cmp(b));
    least.filter(|(_, off_m)| off_m.is_finite()).map(|(index, _)| index)
}

/// Lengthens each hurried walk, first into the time before it, then into the time after it.
fn unhurry(pieces: &mut [Piece], ways: &[WalkRoute]) {
    let walks: Vec<usize> = (0..pieces.len()).filter(|&index| pieces[index].doing == Annotated::Walk).collect();
    for (&walk, way) in walks.iter().zip(ways) {
        let needed = Span::from_seconds(way.length_m / HURRIED_MPS);
        let mut index = walk;
        while index > 0 && pieces[index - 1].doing != Annotated::Walk {
            index -= 1;
            let begin = pieces[index].begin.max(pieces[walk].end - needed).min(pieces[walk].begin);
            pieces[walk].begin = begin;
            pieces[index].end = pieces[index].end.min(begin);
        }
        let mut index = walk;
        while index + 1 < pieces.len() && pieces[index + 1].doing != Annotated::Walk {
            index += 1;
            let end = pieces[index].end.min(pieces[walk].begin + needed).max(pieces[walk].end);
            pieces[walk].end = end;
            pieces[index].begin = pieces[index].begin.max(end);
        }
    }
}

fn step(piece: &Piece, way: Option<WalkRoute>) -> Option<PathStep> {
    let span_s = piece.lasts().seconds();
    let wait = |posture, stir| PathStep::Wait(Wait { for_s: Some(span_s), until: None, posture, stir });
    // A stir is one movement that fills the span; the format wants a tenth of a second between two.
    let in_place = |amplitude_m| Some(StirFile { every_s: span_s.max(0.1), for_s: span_s, amplitude_m });
    let step = match (piece.doing, way) {
        (Annotated::Walk, Some(way)) if !way.to.is_empty() => PathStep::Go(Go {
            to: way.to.into_iter().map(spot).collect(),
            pace_mps: None,
            in_s: Some(span_s),
            arrive_at: None,
        }),
        (Annotated::Walk, _) => wait(Posture::Standing, in_place(0.3)),
        (Annotated::InPlace { posture, amplitude_m }, _) => wait(posture, in_place(amplitude_m)),
        (Annotated::Still { posture, .. }, _) => wait(posture, None),
    };
    (piece.end > piece.begin).then_some(step)
}

/// A point to the millimetre, as in a file.
fn spot(at: Point) -> Spot {
    let rounded = |metres: f64| (metres * 1000.0).round() / 1000.0;
    Spot::At([rounded(at.x), rounded(at.y)])
}

#[cfg(test)]
pub mod tests {
    use super::super::parse::{RecordingTexts, parse};
    use super::*;
    use homebody_core::geometry::point;
    use serde_json::json;

    /// Kitchen, hall and bedroom in a row from west to east, and a shed that no door leads to.
    pub fn plan() -> Plan {
        furnished(json!([]))
    }

    /// The same with a little more furniture.
    fn furnished(more: serde_json::Value) -> Plan {
        let wall = |from: [f64; 2], to: [f64; 2]| json!({ "from": from, "to": to });
        let room = |name: &str, west: f64, east: f64| json!({ "name": name, "outline": [[west, 0.0], [east, 0.0], [east, 3.0], [west, 3.0]] });
        let mut home = json!({
            "name": "three rooms and a shed",
            "rooms": [room("kitchen", 0.0, 3.0), room("hall", 3.0, 5.0), room("bedroom", 5.0, 9.0), room("shed", 9.0, 11.0)],
            "walls": [
                wall([0.0, 0.0], [11.0, 0.0]), wall([11.0, 0.0], [11.0, 3.0]), wall([11.0, 3.0], [0.0, 3.0]),
                wall([0.0, 3.0], [0.0, 0.0]), wall([3.0, 0.0], [3.0, 3.0]), wall([5.0, 0.0], [5.0, 3.0]),
                wall([9.0, 0.0], [9.0, 3.0])
            ],
            "doors": [
                { "name": "kitchen door", "from": [3.0, 0.4], "to": [3.0, 1.2] },
                { "name": "bedroom door", "from": [5.0, 1.8], "to": [5.0, 2.6] }
            ],
            "furniture": [
                { "name": "bed", "at": [8.2, 1.0], "size_m": [1.4, 1.8], "height_m": 0.5, "enterable": true },
                { "name": "chair", "at": [5.4, 0.4], "size_m": [0.4, 0.4], "height_m": 0.9, "enterable": true },
                { "name": "table", "at": [1.0, 2.5], "size_m": [1.0, 0.8], "height_m": 0.8 }
            ]
        });
        home["furniture"].as_array_mut().unwrap().extend(more.as_array().unwrap().iter().cloned());
        Plan::new(&serde_json::from_value(home).unwrap())
    }

    pub fn room(plan: &Plan, name: &str) -> usize {
        plan.rooms.iter().position(|room| room.name == name).unwrap()
    }

    /// The path through a home for the body of an older adult.
    fn placed(run: &AnnotatedRun, plan: &Plan) -> Result<PathFile, PlacementError> {
        path_of(run, &mut SphereHouse::new(plan, 0.22))
    }

    pub fn recording(rooms: &str, movements: &str) -> AnnotatedRun {
        let (location, annotations) = (rows(rooms), rows(movements));
        parse(&RecordingTexts { location: &location, annotations: &annotations, pir: &rows(""), second_location: None })
            .unwrap()
    }

    /// Rows of `start-end name`, separated by commas, as a file.
    fn rows(rows: &str) -> String {
        let row = |row: &str| {
            let (span, name) = row.trim().split_once(' ').unwrap();
            let (start, end) = span.split_once('-').unwrap();
            format!("{start},{end},{name},0\n")
        };
        let rows: String = rows.split(',').filter(|text| !text.trim().is_empty()).map(row).collect();
        format!("start,end,name,index\n{rows}")
    }

    /// The time and place at the end of each step.
    fn ends(path: &PathFile) -> Vec<(f64, Point)> {
        let at = |spot: &Spot| match spot {
            Spot::At(at) => point(*at),
            Spot::Place(name) => panic!("{name:?} is a name"),
        };
        let (mut now, mut here) = (0.0, at(&path.start));
        let step = |step: &PathStep| {
            match step {
                PathStep::Go(go) => (now, here) = (now + go.in_s.unwrap(), at(&go.to[go.to.len() - 1])),
                PathStep::Wait(wait) => now += wait.for_s.unwrap(),
                step => panic!("unexpected {step:?}"),
            }
            (now, here)
        };
        path.steps.iter().map(step).collect()
    }

    #[test]
    fn rooms_change_in_doors_at_the_annotated_time() {
        let rooms = "10-16 kitchen, 16.2-19 hall, 19-60 bedroom";
        let movements =
            "10-12 p_stand, 12-22 a_walk, 22-24 t_turn, 24-26 t_stand_sit, 26-40 p_sit, 40-42 t_sit_lie, 42-60 p_lie";
        let plan = plan();
        let path = placed(&recording(rooms, movements), &plan).unwrap();
        let ends = ends(&path);
        assert_eq!(ends[ends.len() - 1].0, 50.0);
        let at = |second: f64| ends.iter().find(|(end, _)| (end - second).abs() < 1e-9).map(|(_, at)| *at);
        assert_eq!(at(6.2), Some(point([3.0, 0.8])));
        assert_eq!(at(9.0), Some(point([5.0, 2.2])));
        assert_eq!(ends[ends.len() - 1].1, point([8.2, 1.0]), "who lies down does so in the bed");
        let postures = path.steps.iter().filter_map(|step| match step {
            PathStep::Wait(wait) => Some((wait.posture, wait.stir.is_some())),
            _ => None,
        });
        use Posture::{Lying, Sitting, Standing};
        let expected =
            [(Standing, false), (Standing, true), (Standing, true), (Sitting, false), (Sitting, true), (Lying, false)];
        assert_eq!(postures.collect::<Vec<_>>(), expected);
    }

    #[test]
    fn a_room_without_annotation_counts_to_the_shorter_stay() {
        let path = placed(&recording("0-8 kitchen, 8-40 bedroom", "0-40 a_walk"), &plan()).unwrap();
        let ends = ends(&path);
        assert!(ends.contains(&(8.0, point([5.0, 2.2]))), "{ends:?}");
        let path = placed(&recording("0-30 kitchen, 30-38 bedroom", "0-38 a_walk"), &plan()).unwrap();
        let ends = self::ends(&path);
        assert!(ends.contains(&(30.0, point([3.0, 0.8]))), "{ends:?}");
    }

    #[test]
    fn a_missing_walk_to_the_door_is_added_in_time() {
        let path = placed(&recording("0-20 kitchen, 20-30 hall", "0-4 a_walk, 4-20 p_stand, 20-30 p_stand"), &plan());
        let path = path.unwrap();
        let ends = ends(&path);
        let door = point([3.0, 0.8]);
        let arrival = ends.iter().position(|&(end, at)| (end - 20.0).abs() < 1e-9 && at == door).expect("in time");
        let (set_out, from) = ends[arrival - 1];
        assert!(from.distance(door) > 0.3, "not in the door all the while");
        assert!(from.distance(door) / (20.0 - set_out) < HURRIED_MPS + 0.01);
    }

    #[test]
    fn a_long_walk_goes_to_and_fro_at_the_usual_pace() {
        let path = placed(&recording("0-60 bedroom", "0-60 a_walk"), &plan()).unwrap();
        let [PathStep::Go(go)] = &path.steps[..] else { panic!("{:?}", path.steps) };
        assert!(go.to.len() > 10, "{} waypoints", go.to.len());
    }

    #[test]
    fn paths_avoid_obstacles() {
        let recording = recording("0-10 kitchen, 10-20 hall, 20-30 bedroom", "0-30 a_walk");
        assert!(placed(&recording, &plan()).is_ok());
        let shelf = json!([{ "name": "shelf", "at": [4.0, 1.5], "size_m": [0.3, 3.0], "height_m": 2.0 }]);
        let why = placed(&recording, &furnished(shelf)).unwrap_err();
        assert_eq!(why, PlacementError::Way { from: "hall".into(), to: "bedroom".into() });
    }

    #[test]
    fn a_seat_out_of_reach_is_not_sat_on() {
        let shelf = json!([{ "name": "shelf", "at": [7.0, 1.5], "size_m": [0.3, 3.0], "height_m": 2.0 }]);
        let recording = recording("0-10 hall, 10-30 bedroom", "0-15 a_walk, 15-30 p_lie");
        let ends = ends(&placed(&recording, &furnished(shelf)).unwrap());
        assert_eq!(ends[ends.len() - 1].1, point([5.4, 0.4]), "the bed is behind the shelf, the chair before it");
    }

    #[test]
    fn names_rooms_and_movements_that_cannot_be_placed() {
        let plan = plan();
        let why = |rooms, movements| placed(&recording(rooms, movements), &plan).unwrap_err();
        assert_eq!(why("0-9 attic", "0-9 a_walk"), PlacementError::Room("attic".into()));
        assert_eq!(
            why("0-9 hall, 9-12 shed", "0-9 a_walk"),
            PlacementError::Way { from: "hall".into(), to: "shed".into() }
        );
        assert_eq!(why("0-9 hall", "0-9 a_fly"), PlacementError::Movement("a_fly".into()));
    }
}
