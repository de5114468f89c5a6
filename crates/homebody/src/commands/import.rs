//! `homebody import`: a scenario of one's own, from a plan of Sweet Home 3D.

use crate::failure::Failure;
use crate::print::tell;
use homebody_core::problem::{Problem, counted};
use homebody_core::scenario::load::Scenario;
use homebody_import::{MOST_BYTES, sweet_home};
use homebody_kit::begun::{Begun, begin, furnish, lack, lived_in, write};
use homebody_log::plain;
use homebody_routine::household::RoutineLanguage;
use std::io::Read;
use std::path::{Path, PathBuf};

/// Begins a scenario of your own in a new folder, from a plan drawn with Sweet Home 3D: rooms, walls, doors and furniture; of
/// several levels those that stairs join, beside each other. Says what was left out or guessed. Its resident is Anna, with an
/// ordinary routine. Names the furniture that the routine needs and the home lacks, each piece with a line for home.json, or adds it
/// with --furnish. Add sensors yourself.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  homebody import flat.sh3d my-home && homebody check my-home
  homebody import flat.sh3d my-home --furnish && homebody run my-home
  homebody import house.sh3d upstairs --level \"First floor\"
  homebody import house.sh3d downstairs --level 1

A picture of a plan is drawn over in the page: homebody new my-home --image plan.png, or \"New home\" in homebody serve.")]
pub struct Arguments {
    /// The plan: a file that Sweet Home 3D 5.3 or later has saved, or the Home.xml that is in it
    plan: PathBuf,
    /// The folder to create
    folder: PathBuf,
    /// Which level of the plan, by its name or by its number from below; else that by which people come home, and those that
    /// stairs join to it
    #[arg(long, value_name = "NAME")]
    level: Option<String>,
    /// Add the furniture that an ordinary routine needs and the plan lacks or makes unreachable
    #[arg(long)]
    furnish: bool,
}

/// A scenario that was made of a plan.
struct Made {
    remarks: Vec<String>,
    scenario: Scenario,
    lack: Vec<String>,
}

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        let bytes = read(&self.plan)?;
        let made = begin(&self.folder, |part, name| self.make(part, name, &bytes))?;
        self.say(&made);
        Ok(())
    }

    /// Writes the scenario of a plan into a folder.
    fn make(&self, folder: &Path, name: &str, bytes: &[u8]) -> Result<Made, Failure> {
        let imported = sweet_home(bytes, name, self.level.as_deref());
        let imported = imported
            .map_err(|error| Failure::asked(Problem::of_file(&self.plan.display().to_string(), error, None)))?;
        let mut begun = Begun::week(name, imported.home_json);
        let mut remarks = imported.remarks;
        if self.furnish {
            remarks.extend(furnish(&mut begun)?);
        }
        let texts = lived_in(&begun);
        let scenario = Scenario::load_in(&mut RoutineLanguage::default(), &texts, "scenario.json")?;
        write(folder, &texts)?;
        Ok(Made { remarks, scenario, lack: lack(&begun) })
    }

    fn say(&self, Made { remarks, scenario, lack }: &Made) {
        remarks.iter().for_each(|remark| tell(format_args!("{}: {remark}", self.plan.display())));
        lack.iter().for_each(|lack| tell(format_args!("nobody can live an ordinary life here yet: {lack}")));
        if !lack.is_empty() {
            let adds = lack.iter().any(|lack| lack.contains(PROPOSED));
            let or =
                if adds && !self.furnish { "; homebody import --furnish adds all that there is room for" } else { "" };
            tell(format_args!("anna lives there as soon as homebody check has no problem left{or}"));
        }
        let home = &scenario.home;
        tell(format_args!(
            "{} is ready: {}, {}, {}, and no sensors yet, which go into {}.\n  homebody check {0}\n  homebody serve {0}",
            self.folder.display(),
            counted(home.rooms.len(), "room", "rooms"),
            counted(home.doors.len(), "door", "doors"),
            counted(home.furniture.len(), "piece of furniture", "pieces of furniture"),
            self.folder.join(&scenario.file.home).display(),
        ));
    }
}

/// How a line for a home is proposed.
const PROPOSED: &str = "add to \"furniture\"";

/// The bytes of a file, or one more than any plan has.
fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    let mut bytes = Vec::new();
    let file = plain::open(path).map_err(|error| Failure::io(path, error))?;
    file.take(MOST_BYTES + 1).read_to_end(&mut bytes).map_err(|error| Failure::io(path, error))?;
    Ok(bytes)
}
