//! `homebody new`: a scenario from a template, from an image of a plan, or from the log of a home.

use super::log_input::{LogOptions, read_log};
use super::messages::NewHomeMessage;
use crate::failure::{EXIT_CODES, Failure};
use crate::print::{tell, warn, write_file};
use homebody_core::calendar::Calendar;
use homebody_core::problem::counted;
use homebody_scaffold::{
    GivenLog, KnownPoint, PlanPicture, ScenarioFromLog, create, empty, from_log, from_template, read_table, write,
};
use homebody_simulation::Template;
use std::path::{Path, PathBuf};

/// Make a scenario from a template, a log or an image of a plan
///
/// Homebody creates the folder and a scenario in it: a copy of a template, an empty home, or a schematic home from a log.
///
/// Start with an empty home and draw it on the page of homebody serve, over an image of the plan if you have one. The resident is
/// Anna, with an ordinary routine. homebody check lists the furniture that the routine needs and the home lacks.
///
/// From a log, Homebody guesses a schematic home. It takes rooms, furniture and positions from the names of the sensors and from
/// the activities. It takes neighbouring rooms from the order and the delay of events. If you give an image of the plan and the
/// position of each sensor on it, Homebody places the sensors there. The Plan view then shows the image beneath the drawing.
#[derive(clap::Args)]
#[command(after_long_help = format!("Templates:
{}
Examples:
  homebody new my-home --template tigerplace && homebody run my-home
  homebody new my-flat --template empty && homebody serve my-flat
  homebody new my-flat --image plan.png --known 120,640=0,0 --known 900,640=8.5,0 && homebody serve my-flat
  homebody new their-home --from-log casas:tm000.txt
  homebody new their-home --from-log week.csv --sensors sensors.csv
  homebody locate week.csv --home their-home --out located
  homebody new their-home --from-log week.csv --sensors sensors.csv --image plan.png \\
    --known 120,640=0,0 --known 900,640=8.5,0 && homebody serve their-home

sensors.csv has the header id,room,place,x,y and a line for each sensor: its name in the log, its room,
what it watches (free text), and its position in pixels of the image, or in metres without an image. Only
id is required. A column kind (motion or contact) corrects a wrong guess.

{EXIT_CODES}.", templates()))]
pub struct NewArguments {
    /// New folder for the scenario
    folder: PathBuf,
    /// Template to start from, listed below
    #[arg(long, value_name = "NAME", default_value = "tigerplace", value_parser = starting_point)]
    template: StartingPoint,
    /// Make a schematic home from this log: a file, a run folder, a data set folder, or FORM:FILE
    #[arg(long, value_name = "LOG", conflicts_with = "template")]
    from_log: Option<String>,
    #[command(flatten)]
    how: LogOptions,
    /// CSV file with the log's sensors: id, room, place, x, y
    #[arg(long, value_name = "FILE", requires = "from_log")]
    sensors: Option<PathBuf>,
    /// Image of the plan (PNG or JPEG), to draw over on the page
    #[arg(long, value_name = "FILE", conflicts_with = "template")]
    image: Option<PathBuf>,
    /// A point of the image, in pixels from its upper left corner, and the same point in metres east and north of the origin;
    /// give two points
    #[arg(long, value_name = "X,Y=EAST,NORTH", requires = "image")]
    known: Vec<KnownPoint>,
    /// The home's time zone, for a log in UTC; not needed for a run folder, which stores it
    #[arg(long, value_name = "ZONE", requires = "from_log")]
    time_zone: Option<String>,
}

/// The file with the position of the image below the plan, for the page.
const UNDERLAY: &str = "underlay.json";

/// The start of a scenario without a log.
#[derive(Clone, Copy, Debug)]
enum StartingPoint {
    Empty,
    Template(Template),
}

/// The name of the empty scenario among the templates.
const EMPTY: &str = "empty";

const EMPTY_ABOUT: &str = "An empty home, to draw on the page";

fn starting_point(name: &str) -> Result<StartingPoint, String> {
    if name == EMPTY {
        return Ok(StartingPoint::Empty);
    }
    Template::named(name).map(StartingPoint::Template).map_err(|_| {
        let names: Vec<_> = [EMPTY.to_owned()].into_iter().chain(Template::all().map(Template::name)).collect();
        format!("there is no such template; templates are: {}", names.join(", "))
    })
}

fn templates() -> String {
    let width = Template::all().map(|template| template.name().len()).max().unwrap_or(0);
    let row = |name: &str, about: &str| format!("  {name:width$}  {about}\n");
    let line = |template: Template| {
        let text = template.files().find(|(name, _)| name == "scenario.json").map(|(_, text)| text);
        let scenario: serde_json::Value = text.and_then(|text| serde_json::from_str(&text).ok()).unwrap_or_default();
        row(&template.name(), first_words(scenario["about"].as_str().unwrap_or_default()))
    };
    [row(EMPTY, EMPTY_ABOUT)].into_iter().chain(Template::all().map(line)).collect()
}

/// The part of the first sentence that fits into a line.
fn first_words(about: &str) -> &str {
    const WIDTH: usize = 110;
    let ends = |(at, mark): (usize, &str)| {
        let rest = about[at + mark.len()..].strip_prefix(' ');
        // "et al. 2016" does not end a sentence.
        rest.is_some_and(|rest| mark != "." || rest.starts_with(char::is_uppercase)).then_some(at)
    };
    let end = about.match_indices([':', ';', '.']).find_map(ends).unwrap_or(about.len());
    let sentence = about[..end].trim_end_matches('.');
    let fits = |&at: &usize| sentence[..at].chars().count() <= WIDTH;
    let commas = sentence.match_indices(", ").map(|(at, _)| at);
    let end = commas.chain([sentence.len()]).filter(fits).max().unwrap_or(sentence.len());
    &sentence[..end]
}

impl NewArguments {
    pub fn run(self) -> Result<(), Failure> {
        if let Some(log) = &self.from_log {
            return self.make_of(log);
        }
        let folder = &self.folder;
        let picture = self.picture()?;
        let starting_point = if picture.is_some() { StartingPoint::Empty } else { self.template };
        let texts = |name: &str| match starting_point {
            StartingPoint::Empty => empty(name),
            StartingPoint::Template(template) => from_template(template, name),
        };
        create(folder, |part, name| {
            write(part, &texts(name))?;
            self.lay_below(part, picture.as_ref())
        })?;
        let folder = folder.display();
        tell(match starting_point {
            StartingPoint::Empty if picture.is_some() => {
                format!("{folder} is ready: draw over the image in Plan on the page.\n  homebody serve {folder}")
            }
            StartingPoint::Empty => format!("{folder} is ready, and empty.\n  homebody serve {folder}"),
            StartingPoint::Template(_) => {
                format!("{folder} is ready.\n  homebody check {folder}\n  homebody run {folder}")
            }
        });
        Ok(())
    }

    fn picture(&self) -> Result<Option<PlanPicture>, Failure> {
        Ok(self.image.as_deref().map(|image| PlanPicture::read(image, &self.known)).transpose()?)
    }

    /// Writes the image of the plan into the folder of the scenario, where the page shows it below the drawing.
    fn lay_below(&self, folder: &Path, picture: Option<&PlanPicture>) -> Result<(), Failure> {
        let Some(picture) = picture else { return Ok(()) };
        write_file(&folder.join(picture.file), &picture.bytes, false)?;
        write_file(&folder.join(UNDERLAY), picture.lies().as_bytes(), false)
    }

    fn make_of(&self, log: &str) -> Result<(), Failure> {
        let folder = &self.folder;
        let picture = self.picture()?;
        let table = self.sensors.as_deref().map(read_table).transpose()?.unwrap_or_default();
        let time_zone = self.time_zone.as_deref();
        time_zone.map(Calendar::zone).transpose().map_err(Failure::asked)?;
        let read = read_log(log, time_zone, &self.how)?;
        let path = Path::new(log);
        let file = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
        let given = GivenLog { named: log, file: &file, read: &read, time_zone, table, picture: picture.as_ref() };
        let ScenarioFromLog { scenario, remarks } = create(folder, |part, name| {
            let of_log = from_log(name, &given)?;
            write(part, &of_log.scenario.texts)?;
            self.lay_below(part, picture.as_ref())?;
            Ok::<_, Failure>(of_log)
        })?;
        remarks.iter().for_each(|remark| tell(format_args!("{log}: {remark}")));
        scenario.lack.iter().for_each(|lack| warn(NewHomeMessage::RoutineLacks { lack: lack.clone() }));
        let file = &scenario.scenario.home;
        tell(format_args!(
            "{} is ready, with a schematic home: {}, {}, {}.\n  homebody check {0}\n  homebody locate {log} --home {0} --out located\n  \
             homebody serve {0}",
            folder.display(),
            counted(file.rooms.len(), "room", "rooms"),
            counted(file.furniture.len(), "piece of furniture", "pieces of furniture"),
            counted(file.sensors.len(), "sensor", "sensors"),
        ));
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_template_has_a_line_of_description() {
        let long = "A house (Twomey et al. 2016), with one motion sensor in each room that had one, of which there were nine or ten, \
            and a walk through all of them. Its date is ours.";
        let short = "A house (Twomey et al. 2016), with one motion sensor in each room that had one";
        assert_eq!(first_words(long), short);
        assert_eq!(first_words("A couple: Henry, and Ruth."), "A couple");
        assert_eq!(first_words("A life. Another."), "A life");
        assert_eq!(first_words("A life."), "A life");
        assert_eq!(first_words(""), "");
        for line in templates().lines() {
            let words = line.split_whitespace().count();
            assert!(words > 4 && line.chars().count() < 140, "{line}");
        }
        assert_eq!(templates().lines().count(), Template::all().count() + 1);
    }
}
