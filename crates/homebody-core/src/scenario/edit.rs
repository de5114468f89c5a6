//! Scenarios made and changed by code: as data, with the texts that follow from it.
//!
//! The result is checked by loading it, as a file of a user. An existing file keeps its other parts.

use super::ScenarioFile;
use super::load::{Files, Overlay, Scenario};
use super::logger::LoggerFile;
use crate::drivers::input::InputFile;
use crate::drivers::path::form::{PathFile, PathStep};
use crate::geometry::At;
use crate::home::form::HomeFile;
use crate::link::form::LinkFile;
use crate::problem::Problems;
use crate::resident::{DriverFile, LiveFile, ResidentFile};
use serde::Serialize;
use serde_json::Value;
use std::collections::BTreeMap;

/// A scenario that is being made or changed.
#[derive(Clone, Debug, PartialEq)]
pub struct ScenarioEdit {
    entry: String,
    file: ScenarioFile,
    home: HomeFile,
    residents: Vec<ResidentFile>,
    texts: BTreeMap<String, String>,
}

impl Scenario {
    /// An editor of this scenario.
    pub fn edit(&self) -> ScenarioEdit {
        ScenarioEdit::from_scenario(self)
    }
}

impl ScenarioEdit {
    /// A scenario of this home without residents. Its own file is `scenario.json`; the home gets the file that
    /// `file.home` names.
    pub fn new(file: ScenarioFile, home: HomeFile) -> ScenarioEdit {
        let entry = "scenario.json".to_owned();
        let file = ScenarioFile { residents: Vec::new(), ..file };
        let texts = BTreeMap::from([(entry.clone(), text_of(&file)), (file.home.clone(), text_of(&home))]);
        ScenarioEdit { entry, file, home, residents: Vec::new(), texts }
    }

    fn from_scenario(scenario: &Scenario) -> ScenarioEdit {
        ScenarioEdit {
            entry: scenario.entry.clone(),
            file: scenario.file.clone(),
            home: HomeFile::clone(&scenario.home),
            residents: scenario.residents.iter().map(|resident| resident.file.clone()).collect(),
            texts: scenario.sources.clone(),
        }
    }

    /// Changes the scenario's own file.
    pub fn file(mut self, change: impl FnOnce(&mut ScenarioFile)) -> ScenarioEdit {
        let before = self.file.clone();
        change(&mut self.file);
        put(&mut self.texts, &self.entry, &before, &self.file);
        self
    }

    /// Changes the home.
    pub fn home(mut self, change: impl FnOnce(&mut HomeFile)) -> ScenarioEdit {
        let before = self.home.clone();
        change(&mut self.home);
        put(&mut self.texts, &self.file.home, &before, &self.home);
        self
    }

    /// Says where the log goes and how it looks, in `logger.json` where the scenario has no such file.
    pub fn logger(self, logger: &LoggerFile) -> ScenarioEdit {
        let name = self.file.logger.clone().unwrap_or_else(|| "logger.json".into());
        self.text(&name, text_of(logger)).file(|file| file.logger = Some(name))
    }

    /// Says how messages come to the logger, in `link.json` where the scenario has no such file.
    pub fn link(self, link: &LinkFile) -> ScenarioEdit {
        let name = self.file.link.clone().unwrap_or_else(|| "link.json".into());
        self.text(&name, text_of(link)).file(|file| file.link = Some(name))
    }

    /// Adds a resident, in a file of this name. The text that the driver links is added by [`ScenarioEdit::text`], or
    /// by naming a driver anew.
    pub fn add_resident(mut self, name: &str, resident: ResidentFile) -> ScenarioEdit {
        self.texts.insert(name.into(), text_of(&resident));
        self.residents.push(resident);
        self.file(|file| file.residents.push(name.into()))
    }

    /// Changes a resident, whose index must be in range.
    ///
    /// # Panics
    ///
    /// If `index` is not below the number of residents.
    pub fn resident(mut self, index: usize, change: impl FnOnce(&mut ResidentFile)) -> ScenarioEdit {
        let before = self.residents[index].clone();
        change(&mut self.residents[index]);
        put(&mut self.texts, &self.file.residents[index], &before, &self.residents[index]);
        self
    }

    /// A resident follows this path, in a file of this name.
    pub fn path(self, resident: usize, name: &str, path: &PathFile) -> ScenarioEdit {
        self.text(name, text_of_path(path))
            .resident(resident, |resident| resident.driver = DriverFile::Path(name.into()))
    }

    /// Gives a resident this routine, in a file of this name.
    pub fn routine(self, resident: usize, name: &str, routine: impl Into<String>) -> ScenarioEdit {
        self.text(name, routine).resident(resident, |resident| resident.driver = DriverFile::Routine(name.into()))
    }

    /// A resident is moved by these keys, in a file of this name, from a point in metres.
    pub fn keys(self, resident: usize, name: &str, keys: &InputFile, start: At) -> ScenarioEdit {
        let driver = DriverFile::Live(LiveFile { keys: name.into(), start });
        self.text(name, text_of(keys)).resident(resident, |resident| resident.driver = driver)
    }

    /// Any other file of the scenario as a text, such as a condition.
    pub fn text(mut self, name: &str, text: impl Into<String>) -> ScenarioEdit {
        self.texts.insert(name.into(), text.into());
        self
    }

    /// The texts of all files by name, as a recording holds them.
    pub fn into_texts(self) -> BTreeMap<String, String> {
        self.texts
    }

    /// The texts laid over other files, to be loaded by [`ScenarioEdit::entry`].
    pub fn over(self, others: &dyn Files) -> Overlay<'_> {
        Overlay { texts: self.texts, others }
    }

    /// The name of the scenario's own file.
    pub fn entry(&self) -> &str {
        &self.entry
    }

    /// The scenario with every check passed, without a look into routines; or all that is wrong with it.
    pub fn load(&self) -> Result<Scenario, Problems> {
        Scenario::load(&self.texts, &self.entry)
    }
}

/// Writes what has changed into the text of a file, and leaves the rest of it as its author wrote it.
fn put<T: Serialize>(texts: &mut BTreeMap<String, String>, name: &str, before: &T, after: &T) {
    let written = texts.get(name).and_then(|text| serde_json::from_str(text).ok());
    let (Some(Value::Object(mut fields)), Value::Object(old), Value::Object(new)) =
        (written, value_of(before), value_of(after))
    else {
        texts.insert(name.into(), text_of(after));
        return;
    };
    fields.retain(|key, _| new.contains_key(key) || !old.contains_key(key));
    for (key, value) in new {
        if old.get(&key) != Some(&value) {
            fields.insert(key, value);
        }
    }
    texts.insert(name.into(), text_of(&Value::Object(fields)));
}

/// Files are numbers, texts and lists of them, which JSON can always hold.
const WRITABLE: &str = "a file's data can be written as JSON";

fn value_of(file: &impl Serialize) -> Value {
    serde_json::to_value(file).expect(WRITABLE)
}

/// A path as its file has it: one step a line, so that months of steps stay a file that is read.
pub fn text_of_path(path: &PathFile) -> String {
    let head = text_of(&PathFile { steps: Vec::new(), ..path.clone() });
    let mut text = head.trim_end().trim_end_matches(['}', ']', '\n']).to_owned();
    steps_into(&path.steps, 1, &mut text);
    text + "\n}\n"
}

/// Writes the steps of a list that has been opened, and closes it.
fn steps_into(steps: &[PathStep], depth: usize, text: &mut String) {
    let indent = |depth: usize| "  ".repeat(depth);
    for (number, step) in steps.iter().enumerate() {
        text.push_str(if number == 0 { "\n" } else { ",\n" });
        text.push_str(&indent(depth + 1));
        match step {
            PathStep::Repeat(repeat) => {
                let times = repeat.times.map_or(String::new(), |times| format!("\"times\": {times}, "));
                text.push_str(&format!("{{\"repeat\": {{{times}\"steps\": ["));
                steps_into(&repeat.steps, depth + 1, text);
                text.push_str("}}");
            }
            step => text.push_str(&serde_json::to_string(step).expect(WRITABLE)),
        }
    }
    text.push_str(&format!("\n{}]", indent(depth)));
}

fn text_of(file: &impl Serialize) -> String {
    serde_json::to_string_pretty(file).expect(WRITABLE) + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::form::{RoomFile, Spot, WallFile};
    use crate::posture::Posture;
    use crate::sensors::kinds::SensorFile;
    use crate::sensors::motion::MotionFile;

    #[test]
    fn a_path_is_one_step_a_line_and_reads_the_same() {
        let text = r#"{"start": [1, 2], "posture": "lying", "steps": [
            {"wait": {"for_s": 1.5, "stir": {"every_s": 2, "for_s": 1}}}, {"activity": "cooking"},
            {"repeat": {"times": 2, "steps": [{"go": {"to": [[1, 2], "bed"]}}, {"repeat": {"steps": [{"away": {"until": "07:30"}}]}}]}}]}"#;
        let path: PathFile = serde_json::from_str(text).unwrap();
        for path in [PathFile { steps: Vec::new(), ..path.clone() }, path] {
            let text = text_of_path(&path);
            assert_eq!(serde_json::from_str::<PathFile>(&text).unwrap(), path, "{text}");
            let steps = text.lines().filter(|line| line.contains('{') && line.len() > 1);
            assert_eq!(steps.count(), if path.steps.is_empty() { 0 } else { 6 }, "{text}");
        }
    }

    fn one_room() -> ScenarioEdit {
        let corners = [[0.0, 0.0], [4.0, 0.0], [4.0, 3.0], [0.0, 3.0]];
        let mut home = HomeFile::new("one room");
        home.rooms.push(RoomFile::new("room", corners.to_vec()));
        home.walls.extend((0..4).map(|side| WallFile::new(corners[side], corners[(side + 1) % 4])));
        home.sensors.push(SensorFile::Motion(MotionFile::new("motion", [0.05, 1.5], 0.0)));
        let path =
            PathFile { schema: None, start: Spot::At([2.0, 1.0]), posture: Posture::Standing, steps: Vec::new() };
        ScenarioEdit::new(ScenarioFile::new("made", "2009-03-02T00:00:00", 1.0), home)
            .add_resident("ann.json", ResidentFile::with_driver(DriverFile::Path(String::new())))
            .path(0, "ann.path.json", &path)
    }

    #[test]
    fn a_scenario_is_made_of_data_and_its_texts_load_again() {
        let made = one_room().load().unwrap();
        assert_eq!((made.home.sensors.len(), made.residents.len()), (1, 1));
        assert_eq!(Scenario::load(&made.sources, &made.entry).unwrap(), made);
        assert_eq!(made.edit().into_texts(), one_room().into_texts());
    }

    #[test]
    fn all_mistakes_of_an_edit_come_at_once() {
        let wrong = one_room()
            .home(|home| home.walls[0].thickness_m = -1.0)
            .resident(0, |resident| resident.pace_mps = 99.0)
            .file(|file| file.days = 0.0);
        let problems = wrong.load().unwrap_err();
        let files: Vec<&str> = problems.0.iter().map(|problem| problem.file.as_str()).collect();
        assert_eq!(files, ["scenario.json", "home.json", "ann.json"], "{problems}");
    }

    #[test]
    fn a_change_leaves_the_rest_of_a_file() {
        let mut texts = one_room().into_texts();
        let written = "{\"driver\": {\"path\": \"ann.path.json\"}, \"name\": \"Ann\"}";
        texts.insert("ann.json".into(), written.into());
        let scenario = Scenario::load(&texts, "scenario.json").unwrap();
        let same = scenario.edit().resident(0, |_| ()).into_texts();
        assert_eq!(same["ann.json"].split_whitespace().collect::<String>(), written.replace(' ', ""));
        let keys = InputFile { schema: None, keys: Vec::new() };
        let driven = scenario.edit().keys(0, "ann.keys.json", &keys, [1.0, 1.0]);
        let text = &driven.clone().into_texts()["ann.json"];
        assert!(text.find("driver") < text.find("name") && !text.contains("radius_m"), "{text}");
        assert_eq!(driven.load().unwrap().residents[0].file.name, "Ann");
        let gone = scenario.edit().file(|file| file.residents.clear());
        assert!(gone.load().unwrap().residents.is_empty());
    }
}
