//! `homebody import`: a scenario from a plan of Sweet Home 3D.

use super::messages::NewHomeMessage;
use crate::failure::Failure;
use crate::print::{tell, warn};
use homebody_core::problem::{Problem, counted};
use homebody_core::scenario::load::Scenario;
use homebody_import::{MOST_BYTES, sweet_home};
use homebody_log::LogError;
use homebody_log::files::plain;
use homebody_routine::household::RoutineLanguage;
use homebody_scaffold::{NewScenario, create, furnish, inhabited_texts, lack, write};
use std::io::Read;
use std::path::{Path, PathBuf};

/// Make a scenario from a plan of Sweet Home 3D
///
/// Homebody imports rooms, walls, doors and furniture. If stairs connect several levels, it places the levels side by side on the
/// plan. It reports what it left out or guessed. The resident is Anna, with an ordinary routine. Homebody lists the furniture that the
/// routine needs and the home lacks, each with a line to paste into home.json. --furnish adds this furniture.
///
/// The new scenario has no sensors: add them on the page or in home.json.
#[derive(clap::Args)]
#[command(after_long_help = "Examples:
  homebody import flat.sh3d my-home && homebody check my-home
  homebody import flat.sh3d my-home --furnish && homebody run my-home
  homebody import house.sh3d upstairs --level \"First floor\"
  homebody import house.sh3d downstairs --level 1

To draw over an image of a plan: homebody new my-home --image plan.png, or \"New home\" in homebody serve.")]
pub struct ImportArguments {
    /// Plan: a file of Sweet Home 3D 5.3 or later, or the Home.xml in it
    plan: PathBuf,
    /// New folder for the scenario
    folder: PathBuf,
    /// Level of the plan, by its name or by its number from below (default: the level of the entrance, and those that stairs
    /// connect to it)
    #[arg(long, value_name = "NAME")]
    level: Option<String>,
    /// Add the furniture that the routine needs, if it is missing from the plan or cannot be reached
    #[arg(long)]
    furnish: bool,
}

struct ImportedScenario {
    remarks: Vec<String>,
    scenario: Scenario,
    lack: Vec<String>,
}

impl ImportArguments {
    pub fn run(self) -> Result<(), Failure> {
        let bytes = read(&self.plan)?;
        let made = create(&self.folder, |part, name| self.make(part, name, &bytes))?;
        self.say(&made);
        Ok(())
    }

    fn make(&self, folder: &Path, name: &str, bytes: &[u8]) -> Result<ImportedScenario, Failure> {
        let imported = sweet_home(bytes, name, self.level.as_deref());
        let imported = imported
            .map_err(|error| Failure::asked(Problem::of_file(&self.plan.display().to_string(), error, None)))?;
        let mut begun = NewScenario::week(name, imported.home_json);
        let mut remarks = imported.remarks;
        if self.furnish {
            remarks.extend(furnish(&mut begun)?);
        }
        let texts = inhabited_texts(&begun);
        let scenario = Scenario::load_in(&mut RoutineLanguage::default(), &texts, "scenario.json")?;
        write(folder, &texts)?;
        Ok(ImportedScenario { remarks, scenario, lack: lack(&begun) })
    }

    fn say(&self, ImportedScenario { remarks, scenario, lack }: &ImportedScenario) {
        remarks.iter().for_each(|remark| tell(format_args!("{}: {remark}", self.plan.display())));
        lack.iter().for_each(|lack| warn(NewHomeMessage::RoutineLacks { lack: lack.clone() }));
        if !lack.is_empty() {
            let adds = lack.iter().any(|lack| lack.contains(PROPOSED));
            let or =
                if adds && !self.furnish { "; homebody import --furnish adds the furniture that fits" } else { "" };
            tell(format_args!("Anna's routine can run once homebody check reports no problems{or}"));
        }
        let home = &scenario.home;
        tell(format_args!(
            "{} is ready: {}, {}, {}. It has no sensors yet; add them to {}.\n  homebody check {0}\n  homebody serve {0}",
            self.folder.display(),
            counted(home.rooms.len(), "room", "rooms"),
            counted(home.doors.len(), "door", "doors"),
            counted(home.furniture.len(), "piece of furniture", "pieces of furniture"),
            self.folder.join(&scenario.file.home).display(),
        ));
    }
}

const PROPOSED: &str = "add to \"furniture\"";

/// The bytes of a file, up to one more than the limit.
fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    let mut bytes = Vec::new();
    let file = plain::open(path).map_err(|error| LogError::reading(path, error))?;
    file.take(MOST_BYTES + 1).read_to_end(&mut bytes).map_err(|error| LogError::reading(path, error))?;
    Ok(bytes)
}
