//! The residents of a new scenario, and its files.

use crate::error::ScaffoldError;
use crate::texts::ScenarioTexts;
use homebody_core::geometry::{self, Point};
use homebody_core::plan::Plan;
use homebody_core::problem::{Problem, Problems};
use homebody_core::scenario::load::Scenario;
use homebody_routine::household::Household;
use serde_json::json;

/// The start of a scenario without a date.
const MONDAY: &str = "2026-01-05T00:00:00";

pub struct NewScenario<'a> {
    pub name: &'a str,
    /// May be empty.
    pub about: &'a str,
    /// On the clock of its home.
    pub start: &'a str,
    /// Such as `Europe/Vienna`.
    pub time_zone: &'a str,
    pub days: f64,
    pub home: String,
    pub logger: Option<String>,
}

impl<'a> NewScenario<'a> {
    /// A week in a home with nothing but a plan.
    pub fn week(name: &'a str, home: String) -> NewScenario<'a> {
        NewScenario { name, about: "", start: MONDAY, time_zone: "UTC", days: 7.0, home, logger: None }
    }
}

pub struct InhabitedHome {
    pub texts: ScenarioTexts,
    pub scenario: Scenario,
    /// The problems of an ordinary routine in its home.
    pub lack: Vec<String>,
}

/// The files of a scenario with a resident: with an ordinary routine, or standing in place if the home lacks something
/// for it.
pub fn inhabited(new: &NewScenario) -> Result<InhabitedHome, ScaffoldError> {
    let texts = inhabited_texts(new);
    if let Ok(scenario) = load(&texts) {
        return Ok(InhabitedHome { texts, scenario, lack: Vec::new() });
    }
    let lack = lack(new);
    let empty = with(new, "", Vec::new());
    let scenario = load(&empty)?;
    let path = path(roomiest(scenario.home.plan()));
    let standing = with(new, "\"anna.json\"", resident("path", "anna.path.json", path));
    // A home without a free place to stand gets no resident.
    Ok(match load(&standing) {
        Ok(scenario) => InhabitedHome { texts: standing, scenario, lack },
        Err(_) => InhabitedHome { texts: empty, scenario, lack },
    })
}

/// The problems of an ordinary routine in the home of a new scenario, a sentence and a hint each.
pub fn lack(new: &NewScenario) -> Vec<String> {
    let Err(Problems(problems)) = load(&inhabited_texts(new)) else { return Vec::new() };
    problems.iter().map(Problem::text).collect()
}

/// The files of a scenario with an ordinary routine, which may have problems in its home.
pub fn inhabited_texts(new: &NewScenario) -> ScenarioTexts {
    with(new, "\"anna.json\"", resident("routine", "anna.routine", ROUTINE.to_owned()))
}

fn with(new: &NewScenario, residents: &str, files: Vec<(String, String)>) -> ScenarioTexts {
    let mut texts = ScenarioTexts::from([("scenario.json".to_owned(), scenario(new, residents))]);
    texts.insert("home.json".to_owned(), new.home.clone());
    texts.extend(new.logger.iter().map(|logger| ("logger.json".to_owned(), logger.clone())));
    texts.extend(files);
    texts
}

fn scenario(new: &NewScenario, residents: &str) -> String {
    let NewScenario { name, about, start, time_zone, days, .. } = new;
    let about = if about.is_empty() { String::new() } else { format!("  \"about\": {},\n", json!(about)) };
    let logger = if new.logger.is_some() { "  \"logger\": \"logger.json\",\n" } else { "" };
    format!(
        r#"{{
  "$schema": "./schemas/scenario.schema.json",
  "name": {},
{about}  "start": {},
  "time_zone": {},
  "days": {days},
  "seed": 1,
  "home": "home.json",
{logger}  "residents": [{residents}]
}}
"#,
        json!(name),
        json!(start),
        json!(time_zone)
    )
}

const ROUTINE: &str = "\
# Anna is invented. What is not said here goes as it usually does; each sentence more is about her.
Anna is 80. She walks at about 0.65 m/s.
";

fn resident(driver: &str, file: &str, text: String) -> Vec<(String, String)> {
    let resident = format!(
        r#"{{
  "$schema": "./schemas/resident.schema.json",
  "name": "anna",
  "driver": {{ "{driver}": "{file}" }}
}}
"#
    );
    vec![("anna.json".to_owned(), resident), (file.to_owned(), text)]
}

fn path(at: Point) -> String {
    format!(
        r#"{{
  "$schema": "./schemas/path.schema.json",
  "start": [{}, {}],
  "steps": [
    {{ "repeat": {{ "steps": [{{ "wait": {{ "for_s": 3600, "stir": {{ "every_s": 60, "for_s": 2 }} }} }}] }} }}
  ]
}}
"#,
        at.x, at.y
    )
}

fn load(texts: &ScenarioTexts) -> Result<Scenario, Problems> {
    Ok(Household::load(texts, "scenario.json", &[])?.0)
}

/// The place in a home with the most room around it.
fn roomiest(plan: &Plan) -> Point {
    /// Number of places tried in each direction, in addition to the middle of each room (our choice).
    const STEPS: u32 = 60;
    let (least, most) = plan.bounds();
    let steps = (0..=STEPS).flat_map(|x| (0..=STEPS).map(move |y| Point::new(f64::from(x), f64::from(y))));
    let places = steps.map(|step| least + (most - least) * step / f64::from(STEPS));
    let places = plan.rooms.iter().map(|room| geometry::inner_point(&room.outline)).chain(places);
    let free_m = |p: Point| {
        let solids = plan.solids.iter().filter(|solid| solid.stops_bodies);
        let walls = plan.rooms.iter().map(|room| geometry::distance_to_border(&room.outline, p));
        solids.map(|solid| geometry::distance_to_area(&solid.outline, p)).chain(walls).fold(f64::INFINITY, f64::min)
    };
    let inside = places.filter(|&p| plan.room_at(p).is_some()).map(|p| (free_m(p), p));
    let best = inside.max_by(|(a, _), (b, _)| a.total_cmp(b));
    best.map_or(least, |(_, p)| (p * 1e3).round() / 1e3)
}
