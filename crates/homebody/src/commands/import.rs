//! `homebody import`: a scenario of one's own, from a plan of Sweet Home 3D.

use crate::beginning::begin;
use crate::failure::Failure;
use crate::print::{tell, write_file};
use homebody_core::geometry::{self, Point};
use homebody_core::home::plan::Plan;
use homebody_core::problem::{Problems, counted};
use homebody_core::scenario::load::Scenario;
use homebody_import::{MOST_BYTES, sweet_home};
use homebody_log::plain;
use homebody_routine::household::Household;
use serde_json::json;
use std::collections::BTreeMap;
use std::io::Read;
use std::path::{Path, PathBuf};

/// Begins a scenario of your own in a new folder, from a plan drawn with Sweet Home 3D: rooms, walls, doors and furniture. Says
/// what was left out or guessed. Somebody lives an ordinary life there, or stands in a room where the home lacks what that
/// needs. Sensors are yours to add.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  homebody import flat.sh3d my-home && homebody check my-home
  homebody import house.sh3d upstairs --level \"First floor\"
  homebody import house.sh3d downstairs --level 1")]
pub struct Arguments {
    /// The plan: a file that Sweet Home 3D 5.3 or later has saved
    plan: PathBuf,
    /// The folder to create
    folder: PathBuf,
    /// Which level of the plan, by its name or by its number from below; else the one with the most walls
    #[arg(long, value_name = "NAME")]
    level: Option<String>,
}

/// A scenario's files by name.
type Texts = BTreeMap<String, String>;

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        let folder = &self.folder;
        let bytes = read(&self.plan)?;
        let mut told = None;
        begin(folder, |name| {
            let imported = sweet_home(&bytes, name, self.level.as_deref());
            let imported = imported.map_err(|error| Failure::usage(format!("{}: {error}", self.plan.display())))?;
            let (texts, scenario, lack) = furnish(name, imported.home_json)?;
            for (file, text) in &texts {
                write_file(&folder.join(file), text.as_bytes(), false)?;
            }
            told = Some((imported.remarks, scenario, lack));
            Ok(())
        })?;
        let Some((remarks, scenario, lack)) = told else { return Ok(()) };
        remarks.iter().for_each(|remark| tell(format_args!("{}: {remark}", self.plan.display())));
        lack.iter().for_each(|lack| tell(format_args!("nobody can live an ordinary life here yet: {lack}")));
        let home = &scenario.home;
        tell(format_args!(
            "{} is ready: {}, {}, {}, and no sensors yet, which go into {}.\n  homebody check {0}\n  homebody serve {0}",
            folder.display(),
            counted(home.rooms.len(), "room", "rooms"),
            counted(home.doors.len(), "door", "doors"),
            counted(home.furniture.len(), "piece of furniture", "pieces of furniture"),
            folder.join(&scenario.file.home).display(),
        ));
        Ok(())
    }
}

/// The bytes of a file, or one more than any plan has.
fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    let mut bytes = Vec::new();
    let file = plain::open(path).map_err(|error| Failure::io(path, error))?;
    file.take(MOST_BYTES + 1).read_to_end(&mut bytes).map_err(|error| Failure::io(path, error))?;
    Ok(bytes)
}

/// The files of a scenario in a home, with what an ordinary life lacks there.
fn furnish(name: &str, home: String) -> Result<(Texts, Scenario, Vec<String>), Failure> {
    let inhabited = |resident: &str, files: Vec<(String, String)>| {
        let mut texts = Texts::from([("scenario.json".to_owned(), scenario(name, resident))]);
        texts.insert("home.json".to_owned(), home.clone());
        texts.extend(files);
        texts
    };
    let alive = inhabited("\"anna.json\"", resident("routine", "anna.routine", ROUTINE.to_owned()));
    let problems = match load(&alive) {
        Ok(scenario) => return Ok((alive, scenario, Vec::new())),
        Err(problems) => problems,
    };
    let lack = problems.0.into_iter().map(|problem| match problem.hint {
        Some(hint) => format!("{}\n  hint: {hint}", problem.what),
        None => problem.what,
    });
    let lack = lack.collect();
    let empty = inhabited("", Vec::new());
    let scenario = load(&empty)?;
    let path = path(roomiest(scenario.home.plan()));
    let standing = inhabited("\"anna.json\"", resident("path", "anna.path.json", path));
    // Where furniture leaves no place to stand, nobody does.
    Ok(match load(&standing) {
        Ok(scenario) => (standing, scenario, lack),
        Err(_) => (empty, scenario, lack),
    })
}

/// A week from a Monday on; residents as a list of JSON has them.
fn scenario(name: &str, residents: &str) -> String {
    format!(
        r#"{{
  "$schema": "./schemas/scenario.schema.json",
  "name": {},
  "start": "2026-01-05T00:00:00",
  "time_zone": "UTC",
  "days": 7,
  "seed": 1,
  "home": "home.json",
  "residents": [{residents}]
}}
"#,
        json!(name)
    )
}

/// Who lives in a home that was imported.
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
    /// So many places are tried each way, besides the middle of each room (ours).
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
