//! `homebody import`: a scenario of one's own, from a plan of Sweet Home 3D.

use crate::failure::Failure;
use crate::print::tell;
use homebody_core::problem::counted;
use homebody_import::{MOST_BYTES, sweet_home};
use homebody_kit::begun::{Begun, Inhabited, begin, inhabited, write};
use homebody_log::plain;
use std::io::Read;
use std::path::{Path, PathBuf};

/// Begins a scenario of your own in a new folder, from a plan drawn with Sweet Home 3D: rooms, walls, doors and furniture; of
/// several levels those that stairs join, beside each other. Says what was left out or guessed. Somebody lives an ordinary life
/// there, or stands in a room where the home lacks what that needs, and you are told where that could go. Sensors are yours to add.
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
    /// Which level of the plan, by its name or by its number from below; else that by which people come home, and those that
    /// stairs join to it
    #[arg(long, value_name = "NAME")]
    level: Option<String>,
}

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        let folder = &self.folder;
        let bytes = read(&self.plan)?;
        let (remarks, scenario, lack) = begin(folder, |part, name| {
            let imported = sweet_home(&bytes, name, self.level.as_deref());
            let imported = imported.map_err(|error| Failure::usage(format!("{}: {error}", self.plan.display())))?;
            let Inhabited { texts, scenario, lack } = inhabited(&Begun::week(name, imported.home_json))?;
            write(part, &texts)?;
            Ok::<_, Failure>((imported.remarks, scenario, lack))
        })?;
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
