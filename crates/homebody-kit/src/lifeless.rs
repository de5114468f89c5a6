//! Warnings of a scenario whose files are right but whose run has no life or no log: no residents, a resident that waits forever,
//! no sensors, no way out, or a room without a way in.

use homebody_core::geometry::{self, Point};
use homebody_core::home::Build;
use homebody_core::home::plan::Plan;
use homebody_core::problem::{Problem, Problems};
use homebody_core::scenario::home::HomeFile;
use homebody_core::scenario::load::{Driver, Scenario};
use homebody_core::scenario::path::{PathFile, Step};
use homebody_core::scenario::resident::DriverFile;
use homebody_routine::household::Household;
use homebody_walk::Mesh;
use homebody_walk::places::Places;
use serde_json::json;

/// Number of walls above which a home is not searched for closed rooms: it would take too long.
const MOST_WALLS: usize = 1_000;

/// A routine to begin with.
const ANY_ROUTINE: &str = "Anna is 80.";

/// A remark for each.
pub(crate) fn remarks(scenario: &Scenario) -> Vec<Problem> {
    let home = &scenario.home;
    let of_home = |what: &str, hint: String| Problem::of_file(&scenario.file.home, what, Some(hint));
    let mut all = Vec::new();
    if home.sensors.is_empty() {
        let what = "the home has no sensors: a run has a ground truth and no firings";
        all.push(of_home(what, no_sensors(home, home.plan())));
    }
    if scenario.residents.is_empty() {
        let what = "nobody lives here: a run has no firings of movement";
        let hint = "add a file to \"residents\", as homebody new has them".to_owned();
        all.push(Problem::of_file(&scenario.entry, what, Some(hint)));
    }
    let waits: Vec<usize> = (0..scenario.residents.len()).filter(|&resident| waits(scenario, resident)).collect();
    let is_alive = waits.len() < scenario.residents.len();
    if home.furniture.is_empty() && !is_alive {
        let hint = "add pieces to \"furniture\", or import the plan with --furnish".to_owned();
        all.push(of_home("the home has no furniture: nobody sleeps, sits or eats there", hint));
    }
    let leads_out = home.doors.iter().any(|door| door.outside);
    if home.doors.is_empty() && !home.walls.is_empty() {
        let hint = "add the front door to \"doors\", with \"outside\": true".to_owned();
        all.push(of_home("the home has no doors: nobody leaves it, and nobody comes", hint));
    } else if !leads_out && !is_alive {
        let hint = "say \"outside\": true of the front door in \"doors\"".to_owned();
        all.push(of_home("no door leads out of the home: nobody leaves it, and nobody comes", hint));
    }
    all.extend(waits.into_iter().flat_map(|resident| waiting(scenario, resident)));
    all.extend(closed_rooms(scenario));
    all
}

/// The hint for a home without sensors, with one above the largest room.
fn no_sensors(home: &HomeFile, plan: &Plan) -> String {
    /// How large what it looks at is: half a side, the largest that fits.
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
    let example = sensor.map(|sensor| format!(", such as {sensor}")).unwrap_or_default();
    format!(
        "add some to \"sensors\"{example}; homebody suggest-sensors proposes where, and the page's Plan has them to drag"
    )
}

/// Whether a resident follows a path on which they never walk.
fn waits(scenario: &Scenario, resident: usize) -> bool {
    let Some(resident) = scenario.residents.get(resident) else { return false };
    let (Driver::Path(_), DriverFile::Path(file)) = (&resident.driver, &resident.file.driver) else { return false };
    let path = scenario.sources.get(file).and_then(|text| serde_json::from_str::<PathFile>(text).ok());
    path.is_some_and(|path| !path.steps.iter().any(does_something))
}

/// Whether a step walks, goes out or is a named activity.
fn does_something(step: &Step) -> bool {
    match step {
        Step::Go(_) | Step::Away(_) | Step::Activity(_) => true,
        Step::Wait(_) => false,
        Step::Repeat(repeat) => repeat.steps.iter().any(does_something),
    }
}

/// Says that a resident waits for ever, how to give them a routine, and what the home lacks for it.
fn waiting(scenario: &Scenario, resident: usize) -> Vec<Problem> {
    let (Some(own), Some(file)) = (scenario.residents.get(resident), scenario.file.residents.get(resident)) else {
        return Vec::new();
    };
    let DriverFile::Path(path) = &own.file.driver else { return Vec::new() };
    let name = &own.file.name;
    let stem = file.strip_suffix(".json").unwrap_or(file);
    let routine = format!("{stem}.routine");
    let what = format!("{name} waits for ever and does nothing: {path} has no walk");
    let driver = json!({ "routine": routine });
    let hint = format!(
        "for an ordinary life, let {file} say \"driver\": {driver}, and write {routine} with the line: {ANY_ROUTINE}"
    );
    let edit = scenario.edit().routine(resident, &routine, format!("{ANY_ROUTINE}\n"));
    let entry = edit.entry().to_owned();
    let lacks = Household::load(&edit.into_texts(), &entry, &[]).err().map(|Problems(problems)| problems);
    let lack = |problem: Problem| {
        let what = format!("for a life of {name}: {}", problem.what);
        Problem::of_file(&scenario.file.home, what, problem.hint)
    };
    let first = Problem::of_file(file, what, Some(hint));
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
    let closed: Vec<usize> = Places::new(&home, plan, &mesh, "").closed_rooms().collect();
    let named: Vec<String> = closed.iter().take(NAMED).map(|&room| format!("{:?}", home.rooms[room].name)).collect();
    let more = if closed.len() > NAMED { format!(" and {} more", closed.len() - NAMED) } else { String::new() };
    let what = format!("nobody gets into {}{more}", named.join(", "));
    let hint = "add a door to \"doors\", or move what is in the way; where nobody is to get in, leave it".to_owned();
    (!closed.is_empty()).then(|| Problem::of_file(&scenario.file.home, what, Some(hint)))
}
