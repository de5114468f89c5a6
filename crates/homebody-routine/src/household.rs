//! Everybody of a scenario who lives by a routine or a script: the residents, and those who visit them.

mod many;

use crate::completion::{self, Word};
use crate::language::lexicon::OWN_FILE;
use crate::language::{self, Known, Lexicon};
use crate::living;
use crate::living::account::{self, Difference};
use crate::living::body::Body;
use crate::living::company::{Company, People};
use crate::living::driver::RoutineDriver;
use crate::living::life::Life;
use crate::living::pet::PetDriver;
use crate::living::places::Places;
use crate::messages::HouseholdMessage;
use crate::needs_of_home;
use crate::routine::{Effect, Kind, Routine, USUAL, shows};
use homebody_core::drivers;
use homebody_core::home::plan::Plan;
use homebody_core::home::{Build, Home};
use homebody_core::ids::ResidentId;
use homebody_core::models;
use homebody_core::numbers::Number;
use homebody_core::outside;
use homebody_core::problem::{Problem, Problems};
use homebody_core::recording::Recording;
use homebody_core::run::{DriverProvider, Guest, Run};
use homebody_core::scenario::home::HomeFile;
use homebody_core::scenario::load::{Driver, DriverText, Files, Language, NoText, Scenario, too_long};
use homebody_core::scenario::resident::WanderingFile;
use homebody_core::time::DAY;
use homebody_script::{Cast, Names, Program, ScriptDriver};
use homebody_walk::{Gains, Mesh};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

pub use many::ManyRuns;

/// The routines of a scenario, understood.
#[derive(Clone, Debug)]
pub struct Household {
    scenario: Scenario,
    /// By resident; nothing for those who follow a path or keys.
    routines: Vec<Option<Routine>>,
    /// The scripts of those who live by one, by resident.
    scripts: BTreeMap<usize, Arc<Program>>,
    conditions: BTreeMap<String, Routine>,
    /// What people do where their routines say nothing of it.
    ordinary: Routine,
    guests: Vec<Visitor>,
    is_one_of_many: bool,
}

/// Somebody who visits a resident.
#[derive(Clone, Debug)]
struct Visitor {
    /// Index of the one who is visited.
    host: usize,
    /// What the routine calls them: `daughter`.
    name: String,
}

/// A resident's routine as far as it is understood, whatever is wrong with it.
#[derive(Clone, Debug)]
pub struct Understood {
    pub routine: Routine,
    /// What it leaves unsaid, and goes as it usually does.
    pub unsaid: Routine,
    /// The conditions that it shows, by name.
    pub conditions: BTreeMap<String, Routine>,
    /// What is wrong with any of these.
    pub problems: Vec<Problem>,
    /// What may be written in it.
    pub words: Vec<Word>,
    life: Life,
}

impl Understood {
    /// How severe a condition is on a day: 0 where it is not there, 1 for a moderate case.
    pub fn severity(&self, condition: &str, day: i32) -> f64 {
        self.life.severity(condition, day)
    }
}

/// The conditions that the program knows, by name, as texts.
pub const CONDITIONS: [(&str, &str); 8] = [
    ("cognitive-decline", include_str!("../../../conditions/cognitive-decline.routine")),
    ("depression", include_str!("../../../conditions/depression.routine")),
    ("frailty", include_str!("../../../conditions/frailty.routine")),
    ("grief", include_str!("../../../conditions/grief.routine")),
    ("heart-failure", include_str!("../../../conditions/heart-failure.routine")),
    ("insomnia", include_str!("../../../conditions/insomnia.routine")),
    ("recovery", include_str!("../../../conditions/recovery.routine")),
    ("urinary-tract-infection", include_str!("../../../conditions/urinary-tract-infection.routine")),
];

homebody_core::numbers! {
    /// Walking speed of a visitor: younger than the residents, and without haste.
    static GUEST_PACE_MPS = "visit.pace": 0.9, "m/s", [0.2, 2.0];
}

/// All numbers that a scenario may set: those of lives, of walking, and of what sensors and link make of it.
pub fn numbers() -> Vec<Number> {
    let own = NUMBERS.iter().map(|number| (*number).clone()).chain(living::numbers());
    own.chain(homebody_walk::numbers()).chain(models::numbers()).collect()
}

/// Largest number of conditions in a scenario (our choice).
const MOST_CONDITIONS: usize = 64;

/// What a routine that says nothing of it leaves to be ordinary.
const ORDINARY: &str = include_str!("ordinary.routine");

impl Household {
    /// Loads a scenario with its routines and the conditions that they show, each from the scenario's own files or, if there
    /// is none of that name, from those the program knows. All texts that were read are in the scenario's sources, and each
    /// was read once.
    ///
    /// `without` names conditions that are left out; one that nobody shows is a problem.
    pub fn load(files: &dyn Files, entry: &str, without: &[String]) -> Result<(Scenario, Household), Problems> {
        let mut language = RoutineLanguage::default();
        let mut scenario = Scenario::load_in(&mut language, files, entry)?;
        let RoutineLanguage { mut routines, scripts, conditions, sources } = language;
        scenario.sources.extend(sources);
        let household = Household {
            routines: (0..scenario.residents.len()).map(|resident| routines.remove(&resident)).collect(),
            scripts,
            conditions,
            ordinary: ordinary(&scenario.home, scenario.home.plan()),
            guests: Vec::new(),
            is_one_of_many: false,
            scenario: scenario.clone(),
        };
        let mut problems = household.not_shown(without);
        let people = household.people().residents;
        for (resident, routine) in scenario.residents.iter().zip(&household.routines) {
            if let Some(routine) = routine {
                let others = people - usize::from(routine.is_of_person());
                let known = &household.conditions;
                problems.extend(needs_of_home::check(&scenario, &resident.file, routine, known, others));
            }
        }
        if !problems.is_empty() {
            return Err(Problems(problems));
        }
        Ok((scenario, household.leaving_out(without)))
    }

    /// The same household in which nobody shows these conditions; one that nobody shows anyway is a problem.
    pub fn without(&self, conditions: &[String]) -> Result<Household, Problems> {
        let problems = self.not_shown(conditions);
        if problems.is_empty() { Ok(self.clone().leaving_out(conditions)) } else { Err(Problems(problems)) }
    }

    fn leaving_out(mut self, conditions: &[String]) -> Household {
        self.conditions.retain(|name, _| !conditions.contains(name));
        self.guests = self.find_guests();
        self
    }

    /// A problem for each of these conditions that nobody shows.
    fn not_shown(&self, conditions: &[String]) -> Vec<Problem> {
        let routines = || self.routines.iter().flatten();
        let is_shown = |name: &String| {
            let shown = |routine: &Routine| shows(routine).any(|condition| condition == name);
            routines().chain(self.conditions.values()).any(shown)
        };
        let problem = |name: &String| {
            let known = routines().flat_map(shows).map(str::to_owned).collect();
            let message = HouseholdMessage::NotShown { condition: name.clone(), known };
            Problem::of_file(&self.scenario.file.name, message, None)
        };
        conditions.iter().filter(|name| !is_shown(name)).map(problem).collect()
    }

    /// How the routine of a resident is understood; nothing for who lives by none. The scenario is sound but for its routines.
    pub fn understand(scenario: &Scenario, files: &dyn Files, resident: usize) -> Option<Understood> {
        let Driver::Routine { file, text } = &scenario.residents.get(resident)?.driver else { return None };
        let person = scenario.residents[resident].file.name.as_str();
        let plan = scenario.home.plan();
        let first = Some(scenario.calendar.date(0));
        let mut reader = Reader::new(files, &scenario.home, plan, first);
        let routine = reader.routine(file, text, Some(person));
        let names = reader.may_be_named(Some(person), reader.names(text));
        let Reader { known: conditions, problems, .. } = reader;
        let mut routines = vec![None; scenario.residents.len()];
        routines[resident] = Some(routine.clone());
        let household = Household {
            scenario: scenario.clone(),
            routines,
            scripts: BTreeMap::new(),
            conditions,
            ordinary: ordinary(&scenario.home, plan),
            guests: Vec::new(),
            is_one_of_many: false,
        };
        let life = household.life(resident, scenario.file.seed)?;
        let (unsaid, words) = (life.unsaid(), completion::words(&names, text));
        Some(Understood { routine, unsaid, conditions: household.conditions, problems, words, life })
    }

    /// The scenario of a recording, and who lives there.
    pub fn recorded(recording: &Recording) -> Result<(Scenario, Household), Problems> {
        let (scenario, household) = Household::load(&recording.files, &recording.entry, &recording.without)?;
        let household = if recording.one_of_many { household.one_of_many() } else { household };
        let residents = scenario.residents.iter().map(|resident| resident.file.name.clone());
        let all: Vec<String> = residents.chain(household.guests().into_iter().map(|guest| guest.name)).collect();
        match outside::check(&recording.outside, &scenario, &all, "recording.json") {
            problems if problems.0.is_empty() => Ok((scenario, household)),
            problems => Err(problems),
        }
    }

    /// The same household as one of a cohort: everybody differs from what is written as people differ, each seed in its
    /// own way.
    pub fn one_of_many(&self) -> Household {
        Household { is_one_of_many: true, ..self.clone() }
    }

    /// The routine of a resident, if they live by one.
    pub fn routine(&self, resident: usize) -> Option<&Routine> {
        self.routines.get(resident)?.as_ref()
    }

    /// What the routine of a resident leaves unsaid, and goes as it usually does.
    pub fn unsaid(&self, resident: usize) -> Option<Routine> {
        self.life(resident, 0).map(|life| life.unsaid())
    }

    /// The conditions that are shown, by name.
    pub fn conditions(&self) -> &BTreeMap<String, Routine> {
        &self.conditions
    }

    /// The life of a resident who lives by a routine.
    pub fn life(&self, resident: usize, seed: u64) -> Option<Life> {
        let routine = self.routine(resident)?.clone();
        let file = &self.scenario.residents[resident].file;
        let ordinary = match routine.person.as_ref().map(|person| person.kind) {
            Some(Kind::Cat | Kind::Dog) => Routine::default(),
            _ => self.ordinary.clone(),
        };
        let calendar = &self.scenario.calendar;
        let mut life = Life::new(
            &file.name,
            seed,
            calendar,
            file.pace_mps,
            routine,
            ordinary,
            &self.conditions,
            self.is_one_of_many,
            self.scenario.home.numbers(),
        );
        life.gains = gains(&file.wandering);
        Some(life)
    }

    /// The sentences of everybody's routines whose lives in a run, as far as it has come, differ from their words.
    pub fn differences(run: &Run) -> Vec<Difference> {
        let days = i32::try_from(run.now().div_euclid(DAY)).unwrap_or(i32::MAX);
        let drivers = (0..run.names().len()).filter_map(|body| run.driver(ResidentId::of(body))?.as_any());
        let lives: Vec<&RoutineDriver> = drivers.filter_map(|driver| driver.downcast_ref()).collect();
        account::differences_of_all(&lives, days)
    }

    /// The things of the home that anybody's life uses, by their names in small letters; `None` where somebody lives by something
    /// else than a routine, and may use any.
    pub fn used_things(&self) -> Option<BTreeSet<String>> {
        let (home, plan) = (&self.scenario.home, self.scenario.home.plan());
        let mut all = BTreeSet::new();
        for (resident, routine) in self.scenario.residents.iter().zip(&self.routines) {
            let routine = routine.as_ref()?;
            if routine.is_of_person() {
                all.extend(needs_of_home::used_things(home, plan, &resident.file, routine, &self.conditions));
            }
        }
        Some(all)
    }

    /// What of this can be told before a run of so many days.
    pub fn foretold(&self, days: i32) -> Vec<Difference> {
        let lives = (0..self.routines.len()).filter_map(|resident| self.life(resident, 0));
        lives.flat_map(|life| account::foretold(&life, days)).collect()
    }

    fn find_guests(&self) -> Vec<Visitor> {
        let of = |host: usize| {
            let names = self.life(host, 0).map(|life| life.visitors()).unwrap_or_default();
            names.into_iter().map(move |name| Visitor { host, name }).collect::<Vec<_>>()
        };
        (0..self.routines.len()).flat_map(of).collect()
    }

    /// Everybody who lives or comes there.
    fn people(&self) -> Arc<People> {
        let is_person = |routine: &Option<Routine>| routine.as_ref().is_none_or(Routine::is_of_person);
        let mut are_people: Vec<bool> = self.routines.iter().map(is_person).collect();
        let residents = are_people.iter().filter(|&&is| is).count();
        let first = are_people.len();
        let visitor = |(index, of): (usize, &Visitor)| (ResidentId::of(first + index), of.host, of.name.clone());
        let visitors: Vec<_> = self.guests.iter().enumerate().map(visitor).collect();
        are_people.resize(first + visitors.len(), true);
        Arc::new(People { are_people, visitors, residents })
    }

    /// The driver of a resident who lives by a script.
    fn scripted(&self, body: usize, program: &Arc<Program>, home: &Arc<Home>, on: &Footing, seed: u64) -> ScriptDriver {
        let file = &self.scenario.residents[body].file;
        let residents = self.scenario.residents.iter().map(|resident| resident.file.name.clone());
        let cast = Cast {
            places: on.places.clone(),
            home: home.clone(),
            mesh: on.mesh.clone(),
            calendar: self.scenario.calendar.clone(),
            names: residents.chain(self.guests().into_iter().map(|guest| guest.name)).collect(),
            name: file.name.clone(),
            pace_mps: file.pace_mps,
            gains: gains(&file.wandering),
            seed,
        };
        ScriptDriver::new(program.clone(), cast)
    }

    /// What a body walks by.
    fn mesh(&self, body: usize, home: &Home) -> Arc<Mesh> {
        let radius_m = self.scenario.residents.get(body).map_or(Build::adult().radius_m, |one| one.file.radius_m);
        Arc::new(Mesh::with_numbers(&home.plan, radius_m, &home.numbers))
    }

    /// What a body's driver stands on. Nothing for a body that nobody knows.
    fn footing(&self, body: usize, home: &Home) -> Option<Footing> {
        let host = match body.checked_sub(self.scenario.residents.len()) {
            Some(guest) => self.guests.get(guest)?.host,
            None => body,
        };
        let (mesh, name) = (self.mesh(body, home), &self.scenario.residents[host].file.name);
        let asleep_at = self.routine(body).and_then(Routine::sleeps_at);
        let places = Arc::new(Places::new(&self.scenario.home, &home.plan, &mesh, name).sleeping_at(asleep_at));
        Some(Footing { mesh, places, people: self.people(), life: self.life(host, 0), ways: None })
    }

    /// The driver of a body that stands on this.
    fn driver_on(&self, on: &Footing, body: usize, home: &Arc<Home>, seed: u64) -> Option<Box<dyn drivers::Driver>> {
        let company = |build: Build| Company::new(on.people.clone(), build.radius_m, &home.numbers);
        let life = |life: &Life| Arc::new(life.of_seed(seed));
        if let Some(guest) = body.checked_sub(self.scenario.residents.len()) {
            let Visitor { host, name } = self.guests.get(guest)?;
            let own = on.body(home, home.numbers.of(&GUEST_PACE_MPS));
            let (host, company) = (ResidentId::of(*host), company(Build::adult()));
            let (life, places) = (life(on.life.as_ref()?), on.places.clone());
            return Some(Box::new(RoutineDriver::visitor(life, home.clone(), places, own, (host, name), company)));
        }
        if let Some(program) = self.scripts.get(&body) {
            return Some(Box::new(self.scripted(body, program, home, on, seed)));
        }
        let (life, places) = (life(on.life.as_ref()?), on.places.clone());
        let kind = self.routine(body)?.person.as_ref().map_or(Kind::Person, |person| person.kind);
        let own = on.body(home, life.pace_mps);
        match kind {
            Kind::Person => {
                let company = company(Build::of(&self.scenario.residents[body].file));
                let id = ResidentId::of(body);
                Some(Box::new(RoutineDriver::new(life, home.clone(), places, own, id, company)))
            }
            Kind::Cat | Kind::Dog => Some(Box::new(PetDriver::new(life, places, own))),
        }
    }
}

/// What of a body's driver does not depend on the seed.
#[derive(Clone, Debug)]
struct Footing {
    mesh: Arc<Mesh>,
    places: Arc<Places>,
    people: Arc<People>,
    /// The life of whose it is, as seed 0 has it; of a guest that of the host. None for who lives by no routine.
    life: Option<Life>,
    /// How many ways a body remembers at most; None for the usual number.
    ways: Option<usize>,
}

impl Footing {
    fn body(&self, home: &Arc<Home>, pace_mps: f64) -> Body {
        let body = Body::new(home.clone(), self.mesh.clone(), pace_mps);
        self.ways.into_iter().fold(body, Body::remembering)
    }
}

/// The gains that a resident's file says.
fn gains(file: &WanderingFile) -> Gains {
    let WanderingFile { goal, walls, noise, people, open_floor, pauses_pm: pauses } = *file;
    Gains { goal, walls, noise, people, open_floor, pauses }
}

impl DriverProvider for Household {
    fn guests(&self) -> Vec<Guest> {
        let name =
            |visitor: &Visitor| format!("{}'s {}", self.scenario.residents[visitor.host].file.name, visitor.name);
        self.guests.iter().map(|visitor| Guest { name: name(visitor), build: Build::adult() }).collect()
    }

    fn driver(&self, body: usize, home: &Arc<Home>, seed: u64) -> Option<Box<dyn drivers::Driver>> {
        self.driver_on(&self.footing(body, home)?, body, home, seed)
    }
}

/// Reads the routines and scripts of a scenario as it is loaded, and keeps what it has understood.
#[derive(Clone, Debug, Default)]
pub struct RoutineLanguage {
    /// By resident.
    pub(crate) routines: BTreeMap<usize, Routine>,
    /// By resident.
    scripts: BTreeMap<usize, Arc<Program>>,
    /// Those that any of them shows, by name.
    pub(crate) conditions: BTreeMap<String, Routine>,
    /// The texts of these, by file.
    sources: BTreeMap<String, String>,
}

impl Language for RoutineLanguage {
    fn read(&mut self, said: &DriverText, home: &HomeFile, plan: &Plan, files: &dyn Files) -> Vec<Problem> {
        let mut reader = Reader::new(files, home, plan, said.calendar.map(|calendar| calendar.date(0)));
        reader.known = std::mem::take(&mut self.conditions);
        let routine = reader.routine(said.file, said.text, said.resident);
        self.routines.insert(said.of, routine);
        self.conditions = reader.known;
        let are_told = self.sources.contains_key(OWN_FILE);
        self.sources.extend(reader.sources);
        // The words of a scenario are those of all who live there.
        reader.problems.into_iter().filter(|problem| !are_told || problem.file != OWN_FILE).collect()
    }

    fn read_script(&mut self, said: &DriverText, home: &HomeFile, plan: &Plan) -> Vec<Problem> {
        match Program::read(said.file, said.text, &Names::of(home, plan, said.resident)) {
            Ok(program) => {
                self.scripts.insert(said.of, Arc::new(program));
                Vec::new()
            }
            Err(problems) => problems,
        }
    }

    fn numbers(&self) -> Option<Vec<Number>> {
        Some(numbers())
    }
}

/// What people do where their routines say nothing of it.
fn ordinary(home: &HomeFile, plan: &Plan) -> Routine {
    language::condition("ordinary.routine", ORDINARY, &known(home, plan, None, Vec::new(), None)).0
}

/// What may be named in a scenario's routines.
fn known(
    home: &HomeFile,
    plan: &Plan,
    person: Option<&str>,
    conditions: Vec<String>,
    first_date: Option<(i16, u8, u8)>,
) -> Known {
    let furniture = home.furniture.iter().map(|piece| piece.name.clone());
    let places = plan.places.iter().map(|(name, _)| name.clone());
    let mut places: Vec<String> = places.chain(furniture).collect();
    // What is called after somebody is "his armchair" to himself.
    let whose = person.map(|person| format!("{}'s ", person.to_lowercase()));
    let own = |name: &String| Some(name.to_lowercase().strip_prefix(whose.as_ref()?)?.to_owned());
    let own: Vec<String> = places.iter().filter_map(own).collect();
    places.extend(own);
    Known {
        person: person.map(String::from),
        places,
        things: plan.things.iter().map(|thing| thing.name.clone()).collect(),
        rooms: plan.rooms.iter().map(|room| room.name.clone()).collect(),
        conditions,
        first_date,
        usual: USUAL.to_vec(),
        ..Known::default()
    }
}

/// Reads routines, and conditions as they ask for them.
struct Reader<'a> {
    files: &'a dyn Files,
    home: &'a HomeFile,
    plan: &'a Plan,
    /// Year, month and day of the run's first day, if it is known.
    first: Option<(i16, u8, u8)>,
    known: BTreeMap<String, Routine>,
    sources: BTreeMap<String, String>,
    problems: Vec<Problem>,
    /// The words of the language, and the scenario's own.
    lexicon: Lexicon,
}

impl<'a> Reader<'a> {
    fn new(files: &'a dyn Files, home: &'a HomeFile, plan: &'a Plan, first: Option<(i16, u8, u8)>) -> Reader<'a> {
        let (mut sources, mut problems, mut lexicon) = (BTreeMap::new(), Vec::new(), Lexicon::default());
        if let Ok(text) = files.read(OWN_FILE) {
            (lexicon, problems) = lexicon.with(OWN_FILE, &text);
            sources.insert(OWN_FILE.to_owned(), text);
        }
        Reader { files, home, plan, first, known: BTreeMap::new(), sources, problems, lexicon }
    }

    /// Reads a person's routine and the conditions that it shows.
    fn routine(&mut self, file: &str, text: &str, person: Option<&str>) -> Routine {
        let known = self.may_be_named(person, self.names(text));
        let (routine, problems) = language::routine(file, text, &known);
        self.problems.extend(problems);
        self.follow(&routine, &mut Vec::new());
        routine
    }

    /// What a text may name, in the words of the scenario.
    fn may_be_named(&self, person: Option<&str>, conditions: Vec<String>) -> Known {
        Known { lexicon: self.lexicon.clone(), ..known(self.home, self.plan, person, conditions, self.first) }
    }

    /// The names of the conditions that may be meant in a text: those the program knows, and the scenario's own files.
    fn names(&self, text: &str) -> Vec<String> {
        let mut names: Vec<String> = CONDITIONS.iter().map(|(name, _)| (*name).to_owned()).collect();
        for line in text.lines().filter(|line| line.len() < 1_000) {
            let words: Vec<String> = line
                .split(|c: char| !c.is_alphanumeric() && c != '-')
                .filter(|word| !word.is_empty())
                .map(str::to_lowercase)
                .collect();
            let Some(verb) = words.iter().position(|word| word == "shows" || word == "show") else { continue };
            for first in verb + 1..words.len().min(verb + 6) {
                for last in first + 1..=words.len().min(first + 4) {
                    let name = words[first..last].join("-");
                    if !names.contains(&name) && self.files.read(&file_of(&name)) != Err(NoText::Missing) {
                        names.push(name);
                    }
                }
            }
        }
        names
    }

    /// Reads the conditions that a routine shows, and those that these show; `path` are the ones on the way here.
    fn follow(&mut self, routine: &Routine, path: &mut Vec<String>) {
        for change in &routine.changes {
            let Effect::Shows { condition, .. } = &change.effect else { continue };
            if path.contains(condition) {
                let message = HouseholdMessage::Circle { conditions: path.clone() };
                self.problems.push(said_at(routine, change.said.line, change.said.column, message));
                continue;
            }
            if self.known.contains_key(condition) {
                continue;
            }
            let file = file_of(condition);
            let built_in = || CONDITIONS.iter().find(|(name, _)| name == condition).map(|(_, text)| (*text).to_owned());
            let read = match self.files.read(&file) {
                Ok(_) if self.known.len() >= MOST_CONDITIONS => {
                    Err(HouseholdMessage::TooMany { file: file.clone(), most: MOST_CONDITIONS })
                }
                Ok(text) => match too_long(&text) {
                    Some(why) => Err(HouseholdMessage::TooLong { file: file.clone(), why: why.to_string() }),
                    None => Ok(Some(text)),
                },
                // Only where there is none of its own: one that cannot be read is not passed over.
                Err(NoText::Missing) => Ok(built_in()),
                Err(why) => Err(HouseholdMessage::Unreadable { file: file.clone(), why: why.to_string() }),
            };
            let text = match read {
                Ok(Some(text)) => text,
                Ok(None) => continue,
                Err(message) => {
                    self.problems.push(said_at(routine, change.said.line, change.said.column, message));
                    continue;
                }
            };
            let names = self.names(&text);
            let (routine, problems) = language::condition(&file, &text, &self.may_be_named(None, names));
            self.problems.extend(problems);
            self.sources.insert(file, text);
            self.known.insert(condition.clone(), routine.clone());
            path.push(condition.clone());
            self.follow(&routine, path);
            path.pop();
        }
    }
}

/// A problem with what is said at a place of a routine.
fn said_at(routine: &Routine, line: u32, column: u32, message: HouseholdMessage) -> Problem {
    Problem { line, column, ..Problem::of_file(&routine.file, message, None) }
}

fn file_of(condition: &str) -> String {
    format!("conditions/{condition}.routine")
}
