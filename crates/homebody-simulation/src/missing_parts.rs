//! Warnings of a scenario whose files are right but whose run has no life or no log: no residents, a resident that waits forever,
//! no sensors, no way out, or a room without a way in.

use crate::scenario_warnings::ScenarioWarning;
use homebody_core::drivers::path::form::{PathFile, PathStep};
use homebody_core::geometry::{self, Point};
use homebody_core::home::form::HomeFile;
use homebody_core::plan::Plan;
use homebody_core::problem::{Problem, Problems};
use homebody_core::resident::{Build, DriverFile};
use homebody_core::scenario::load::{ResidentDriver, Scenario};
use homebody_routine::household::Household;
use homebody_walk::Mesh;
use homebody_walk::places::HomePlaces;
use serde_json::json;

/// Number of walls above which a home is not searched for closed rooms: it would take too long.
const MOST_WALLS: usize = 1_000;

/// A routine to begin with.
const ANY_ROUTINE: &str = "Anna is 80.";

pub(crate) fn remarks(scenario: &Scenario) -> Vec<Problem> {
    let home = &scenario.home;
    let of_home = |message: ScenarioWarning| Problem::of_file(&scenario.file.home, message, None);
    let mut all = Vec::new();
    if home.sensors.is_empty() {
        all.push(of_home(ScenarioWarning::NoSensors { example: example_of_sensor(home, home.plan()) }));
    }
    if scenario.residents.is_empty() {
        all.push(Problem::of_file(&scenario.entry, ScenarioWarning::NoResidents, None));
    }
    let waits: Vec<usize> = (0..scenario.residents.len()).filter(|&resident| waits(scenario, resident)).collect();
    let is_alive = waits.len() < scenario.residents.len();
    if home.furniture.is_empty() && !is_alive {
        all.push(of_home(ScenarioWarning::NoFurniture));
    }
    let leads_out = home.doors.iter().any(|door| door.outside);
    if home.doors.is_empty() && !home.walls.is_empty() {
        all.push(of_home(ScenarioWarning::NoDoors));
    } else if !leads_out && !is_alive {
        all.push(of_home(ScenarioWarning::NoFrontDoor));
    }
    all.extend(waits.into_iter().flat_map(|resident| waiting(scenario, resident)));
    all.extend(closed_rooms(scenario));
    all
}

/// An example of a sensor above the largest room, for the hint for a home without sensors.
fn example_of_sensor(home: &HomeFile, plan: &Plan) -> String {
    /// Half the side of its area: the largest that fits.
    const HALF_M: [f64; 4] = [1.5, 1.0, 0.7, 0.3];
    let area = |room: &usize| geometry::signed_area(&plan.rooms[*room].outline).abs();
    let largest = (0..plan.rooms.len()).max_by(|a, b| area(a).total_cmp(&area(b)));
    let sensor = largest.map(|room| {
        let outline = &plan.rooms[room].outline;
        let middle = geometry::inner_point(outline);
        let corners = |half_m: f64| {
            [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| middle + Point::new(x, y) * half_m)
        };
        let fits = |half_m: &f64| corners(*half_m).iter().all(|&corner| geometry::contains(outline, corner));
        let half_m = HALF_M.into_iter().find(fits).unwrap_or(HALF_M[HALF_M.len() - 1]);
        let area = corners(half_m).map(|corner| [corner.x, corner.y].map(|length| (length * 1e3).round() / 1e3));
        let name = format!("{} motion", home.rooms[room].name);
        json!({ "kind": "ceiling_motion", "name": name, "area": area })
    });
    sensor.map(|sensor| format!(", such as {sensor}")).unwrap_or_default()
}

/// Whether a resident follows a path on which they never walk.
fn waits(scenario: &Scenario, resident: usize) -> bool {
    let Some(resident) = scenario.residents.get(resident) else { return false };
    let (ResidentDriver::Path(_), DriverFile::Path(file)) = (&resident.driver, &resident.file.driver) else {
        return false;
    };
    let path = scenario.sources.get(file).and_then(|text| serde_json::from_str::<PathFile>(text).ok());
    path.is_some_and(|path| !path.steps.iter().any(does_something))
}

/// Whether a step walks, goes out or is a named activity.
fn does_something(step: &PathStep) -> bool {
    match step {
        PathStep::Go(_) | PathStep::Away(_) | PathStep::Activity(_) => true,
        PathStep::Wait(_) => false,
        PathStep::Repeat(repeat) => repeat.steps.iter().any(does_something),
    }
}

/// The warnings about a resident who waits for ever: how to add a routine, and the parts that the home lacks for it.
fn waiting(scenario: &Scenario, resident: usize) -> Vec<Problem> {
    let (Some(own), Some(file)) = (scenario.residents.get(resident), scenario.file.residents.get(resident)) else {
        return Vec::new();
    };
    let DriverFile::Path(path) = &own.file.driver else { return Vec::new() };
    let name = &own.file.name;
    let stem = file.strip_suffix(".json").unwrap_or(file);
    let routine = format!("{stem}.routine");
    let edit = scenario.edit().routine(resident, &routine, format!("{ANY_ROUTINE}\n"));
    let entry = edit.entry().to_owned();
    let lacks = Household::load(&edit.into_texts(), &entry, &[]).err().map(|Problems(problems)| problems);
    let lack = |problem: Problem| {
        let message = ScenarioWarning::Lacks {
            resident: name.clone(),
            problem_hint: problem.advice(),
            problem: problem.what,
            problem_code: problem.code,
        };
        Problem::of_file(&scenario.file.home, message, None)
    };
    let message = ScenarioWarning::Waits {
        resident: name.clone(),
        path: path.clone(),
        file: file.clone(),
        driver: json!({ "routine": routine }).to_string(),
        routine,
        line: ANY_ROUTINE,
    };
    let first = Problem::of_file(file, message, None);
    std::iter::once(first).chain(lacks.into_iter().flatten().map(lack)).collect()
}

/// Names the rooms without a way in from the rest of the home.
fn closed_rooms(scenario: &Scenario) -> Option<Problem> {
    /// So many are named.
    const NAMED: usize = 8;
    if scenario.home.walls.len() > MOST_WALLS || scenario.home.rooms.len() < 2 {
        return None;
    }
    // A door that is shut may be opened.
    let mut home = HomeFile::clone(&scenario.home);
    home.doors.iter_mut().for_each(|door| door.open = true);
    let plan = &Plan::new(&home);
    let radius_m = scenario.residents.first().map_or(Build::adult().radius_m, |resident| resident.file.radius_m);
    let mesh = Mesh::with_numbers(plan, radius_m, scenario.home.numbers());
    let closed: Vec<usize> = HomePlaces::new(&home, plan, &mesh, "").closed_rooms().collect();
    let rooms = closed.iter().take(NAMED).map(|&room| home.rooms[room].name.clone()).collect();
    let message = ScenarioWarning::ClosedRooms { rooms, more: closed.len().saturating_sub(NAMED) };
    (!closed.is_empty()).then(|| Problem::of_file(&scenario.file.home, message, None))
}
