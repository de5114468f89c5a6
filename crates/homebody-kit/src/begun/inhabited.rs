//! A home that somebody lives in, with the files of its scenario.

use super::Texts;
use crate::error::Error;
use homebody_core::geometry::{self, Point};
use homebody_core::home::plan::Plan;
use homebody_core::problem::{Problem, Problems};
use homebody_core::scenario::load::Scenario;
use homebody_routine::household::Household;
use serde_json::json;

/// When the week of a scenario begins of which nothing says when.
const MONDAY: &str = "2026-01-05T00:00:00";

/// What a scenario begins with.
pub struct Begun<'a> {
    /// What it is called.
    pub name: &'a str,
    /// What it says of itself; nothing where it is empty.
    pub about: &'a str,
    /// When it begins, on the clock of its home.
    pub start: &'a str,
    /// The home's zone, as `Europe/Vienna`.
    pub time_zone: &'a str,
    /// How long it is, in days.
    pub days: f64,
    /// The text of its home.
    pub home: String,
    /// The text of its logger.
    pub logger: Option<String>,
}

impl<'a> Begun<'a> {
    /// A week from a Monday on in a home of which no more is known than its plan.
    pub fn week(name: &'a str, home: String) -> Begun<'a> {
        Begun { name, about: "", start: MONDAY, time_zone: "UTC", days: 7.0, home, logger: None }
    }
}

/// A scenario in which somebody lives.
pub struct Inhabited {
    /// Its files.
    pub texts: Texts,
    /// The same, loaded.
    pub scenario: Scenario,
    /// What an ordinary life lacks there.
    pub lack: Vec<String>,
}

/// The files of a scenario: somebody lives an ordinary life in its home, or stands there where the home lacks what that needs.
///
/// # Errors
///
/// [`Error::Problems`]: what is wrong with the home or the logger themselves.
pub fn inhabited(begun: &Begun) -> Result<Inhabited, Error> {
    let texts = lived_in(begun);
    if let Ok(scenario) = load(&texts) {
        return Ok(Inhabited { texts, scenario, lack: Vec::new() });
    }
    let lack = lack(begun);
    let empty = with(begun, "", Vec::new());
    let scenario = load(&empty)?;
    let path = path(roomiest(scenario.home.plan()));
    let standing = with(begun, "\"anna.json\"", resident("path", "anna.path.json", path));
    // Where furniture leaves no place to stand, nobody does.
    Ok(match load(&standing) {
        Ok(scenario) => Inhabited { texts: standing, scenario, lack },
        Err(_) => Inhabited { texts: empty, scenario, lack },
    })
}

/// The problems that an ordinary life has in the home of a scenario that begins, a sentence and a hint each.
pub fn lack(begun: &Begun) -> Vec<String> {
    let Err(Problems(problems)) = load(&lived_in(begun)) else { return Vec::new() };
    problems.iter().map(Problem::text).collect()
}

/// The files of a scenario in whose home somebody lives an ordinary life, as soon as it has what that needs.
pub fn lived_in(begun: &Begun) -> Texts {
    with(begun, "\"anna.json\"", resident("routine", "anna.routine", ROUTINE.to_owned()))
}

fn with(begun: &Begun, residents: &str, files: Vec<(String, String)>) -> Texts {
    let mut texts = Texts::from([("scenario.json".to_owned(), scenario(begun, residents))]);
    texts.insert("home.json".to_owned(), begun.home.clone());
    texts.extend(begun.logger.iter().map(|logger| ("logger.json".to_owned(), logger.clone())));
    texts.extend(files);
    texts
}

/// The file of the scenario; residents as a list of JSON has them.
fn scenario(begun: &Begun, residents: &str) -> String {
    let Begun { name, about, start, time_zone, days, .. } = begun;
    let about = if about.is_empty() { String::new() } else { format!("  \"about\": {},\n", json!(about)) };
    let logger = if begun.logger.is_some() { "  \"logger\": \"logger.json\",\n" } else { "" };
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

/// Who lives there.
const ROUTINE: &str = "\
# Anna is invented. What is not said here goes as it usually does; each sentence more is about her.
Anna is 80. She walks at about 0.65 m/s.
";

/// The files of a resident.
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

/// Somebody who stands in one place and moves a little.
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

fn load(texts: &Texts) -> Result<Scenario, Problems> {
    Ok(Household::load(texts, "scenario.json", &[])?.0)
}

/// The place of a home that has the most room around it.
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
