//! The residents of a scenario with a routine or a script, and their visitors.

mod many;

use crate::behaviour;
use crate::behaviour::body::WalkingBody;
use crate::behaviour::company::{Company, HouseholdMembers};
use crate::behaviour::difference::{self, Difference, Measured};
use crate::behaviour::driver::RoutineDriver;
use crate::behaviour::pet::PetDriver;
use crate::behaviour::places::HomePlaces;
use crate::behaviour::resident_routine::ResidentRoutine;
use crate::completion::{self, Completion};
use crate::language::lexicon::OWN_FILE;
use crate::language::{self, KnownNames, Lexicon};
use crate::messages::HouseholdMessage;
use crate::needs_of_home;
use crate::routine::{Effect, ResidentKind, Routine, USUAL, shows};
use homebody_core::drivers;
use homebody_core::home::Home;
use homebody_core::home::form::HomeFile;
use homebody_core::ids::ResidentId;
use homebody_core::models;
use homebody_core::numbers::Number;
use homebody_core::outside;
use homebody_core::plan::{self, Plan};
use homebody_core::problem::{Problem, Problems};
use homebody_core::recording::Recording;
use homebody_core::resident::{Build, WanderingFile};
use homebody_core::run::{DriverProvider, Guest, Run};
use homebody_core::scenario::load::{DriverLanguages, DriverText, Files, NoText, ResidentDriver, Scenario, too_long};
use homebody_script::{Cast, Program, ScriptDriver, ScriptNames};
use homebody_walk::{Gains, Mesh};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

pub use many::ManyRuns;

/// The routines and scripts of a scenario.
#[derive(Clone, Debug)]
pub struct Household {
    scenario: Scenario,
    /// By resident; `None` for one with a path or keys.
    routines: Vec<Option<Routine>>,
    scripts: BTreeMap<usize, Arc<Program>>,
    conditions: BTreeMap<String, Routine>,
    /// Habits for whatever a routine leaves unsaid.
    ordinary: Routine,
    guests: Vec<HouseholdVisitor>,
    is_one_of_many: bool,
}

#[derive(Clone, Debug)]
struct HouseholdVisitor {
    /// Index of the resident.
    host: usize,
    /// The name in the routine, such as `daughter`.
    name: String,
}

/// The understood part of a resident's routine, with its problems.
#[derive(Clone, Debug)]
pub struct RoutineReading {
    pub routine: Routine,
    /// The usual habits that the routine leaves unsaid.
    pub unsaid: Routine,
    pub conditions: BTreeMap<String, Routine>,
    pub problems: Vec<Problem>,
    pub words: Vec<Completion>,
    life: ResidentRoutine,
}

impl RoutineReading {
    /// Severity of a condition on a day: 0 if absent, 1 for a moderate case.
    pub fn severity(&self, condition: &str, day: i32) -> f64 {
        self.life.severity(condition, day)
    }
}

/// The texts of the built-in conditions, by name.
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

/// All parameters that a scenario can set: of behaviour, walking, sensors and link.
pub fn numbers() -> Vec<Number> {
    let own = NUMBERS.iter().map(|number| (*number).clone()).chain(behaviour::numbers());
    own.chain(homebody_walk::numbers()).chain(models::numbers()).collect()
}

/// Largest number of conditions in a scenario (our choice).
const MOST_CONDITIONS: usize = 64;

/// Usual habits, for routines that do not mention them.
const ORDINARY: &str = include_str!("ordinary.routine");

impl Household {
    /// Loads a scenario with its routines and their conditions. A file of the scenario takes precedence over a built-in
    /// condition of that name. The sources of the scenario then hold all texts, each read once.
    ///
    /// `without` names conditions to leave out; one that no routine shows is a problem.
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

    /// The same household without these conditions; one that no routine shows is a problem.
    pub fn without(&self, conditions: &[String]) -> Result<Household, Problems> {
        let problems = self.not_shown(conditions);
        if problems.is_empty() { Ok(self.clone().leaving_out(conditions)) } else { Err(Problems(problems)) }
    }

    fn leaving_out(mut self, conditions: &[String]) -> Household {
        self.conditions.retain(|name, _| !conditions.contains(name));
        self.guests = self.find_guests();
        self
    }

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

    /// The meaning of a resident's routine; `None` without one. The rest of the scenario must be sound.
    pub fn understand(scenario: &Scenario, files: &dyn Files, resident: usize) -> Option<RoutineReading> {
        let ResidentDriver::Routine { file, text } = &scenario.residents.get(resident)?.driver else { return None };
        let person = scenario.residents[resident].file.name.as_str();
        let plan = scenario.home.plan();
        let first = Some(scenario.calendar.date(0));
        let mut reader = RoutineReader::new(files, &scenario.home, plan, first);
        let routine = reader.routine(file, text, Some(person));
        let names = reader.may_be_named(Some(person), reader.names(text));
        let RoutineReader { known: conditions, problems, .. } = reader;
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
        Some(RoutineReading { routine, unsaid, conditions: household.conditions, problems, words, life })
    }

    /// The scenario of a recording, with its household.
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

    /// The same household as a member of a cohort: each seed makes residents differ as people do.
    pub fn one_of_many(&self) -> Household {
        Household { is_one_of_many: true, ..self.clone() }
    }

    /// The same household with another routine of a resident, such as one that was built from values.
    pub fn with_routine(&self, resident: usize, routine: Routine) -> Household {
        let mut household = self.clone();
        household.routines.iter_mut().skip(resident).take(1).for_each(|of| *of = Some(routine.clone()));
        household.guests = household.find_guests();
        household
    }

    pub fn routine(&self, resident: usize) -> Option<&Routine> {
        self.routines.get(resident)?.as_ref()
    }

    /// The usual habits that the routine of a resident leaves unsaid.
    pub fn unsaid(&self, resident: usize) -> Option<Routine> {
        self.life(resident, 0).map(|life| life.unsaid())
    }

    pub fn conditions(&self) -> &BTreeMap<String, Routine> {
        &self.conditions
    }

    /// `None` for a resident without a routine.
    pub fn life(&self, resident: usize, seed: u64) -> Option<ResidentRoutine> {
        let routine = self.routine(resident)?.clone();
        let file = &self.scenario.residents[resident].file;
        let ordinary = match routine.person.as_ref().map(|person| person.kind) {
            Some(ResidentKind::Cat | ResidentKind::Dog) => Routine::default(),
            _ => self.ordinary.clone(),
        };
        let calendar = &self.scenario.calendar;
        let mut life = ResidentRoutine::new(
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

    /// Sentences that a run, so far, does not follow, the largest loss first.
    pub fn differences(run: &Run) -> Vec<Difference> {
        difference::of_run(run, Measured::Run)
    }

    /// Names, in lower case, of the things that routines use; `None` if a resident without a routine may use any.
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

    /// Those differences that are certain before a run of `days` days.
    pub fn predicted_differences(&self, days: i32) -> Vec<Difference> {
        let lives = (0..self.routines.len()).filter_map(|resident| self.life(resident, 0));
        lives.flat_map(|life| difference::predicted_differences(&life, days)).collect()
    }

    fn find_guests(&self) -> Vec<HouseholdVisitor> {
        let of = |host: usize| {
            let names = self.life(host, 0).map(|life| life.visitors()).unwrap_or_default();
            names.into_iter().map(move |name| HouseholdVisitor { host, name }).collect::<Vec<_>>()
        };
        (0..self.routines.len()).flat_map(of).collect()
    }

    fn people(&self) -> Arc<HouseholdMembers> {
        let is_person = |routine: &Option<Routine>| routine.as_ref().is_none_or(Routine::is_of_person);
        let mut are_people: Vec<bool> = self.routines.iter().map(is_person).collect();
        let residents = are_people.iter().filter(|&&is| is).count();
        let first = are_people.len();
        let visitor =
            |(index, of): (usize, &HouseholdVisitor)| (ResidentId::new(first + index), of.host, of.name.clone());
        let visitors: Vec<_> = self.guests.iter().enumerate().map(visitor).collect();
        are_people.resize(first + visitors.len(), true);
        Arc::new(HouseholdMembers { are_people, visitors, residents })
    }

    fn scripted(
        &self,
        body: usize,
        program: &Arc<Program>,
        home: &Arc<Home>,
        on: &DriverTemplate,
        seed: u64,
    ) -> ScriptDriver {
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

    fn mesh(&self, body: usize, home: &Home) -> Arc<Mesh> {
        let radius_m = self.scenario.residents.get(body).map_or(Build::adult().radius_m, |one| one.file.radius_m);
        Arc::new(Mesh::with_numbers(&home.plan, radius_m, &home.numbers))
    }

    /// `None` for an unknown body.
    fn footing(&self, body: usize, home: &Home) -> Option<DriverTemplate> {
        let host = match body.checked_sub(self.scenario.residents.len()) {
            Some(guest) => self.guests.get(guest)?.host,
            None => body,
        };
        let (mesh, name) = (self.mesh(body, home), &self.scenario.residents[host].file.name);
        let places = Arc::new(HomePlaces::new(&self.scenario.home, &home.plan, &mesh, name));
        Some(DriverTemplate { mesh, places, people: self.people(), life: self.life(host, 0), ways: None })
    }

    fn driver_on(
        &self,
        on: &DriverTemplate,
        body: usize,
        home: &Arc<Home>,
        seed: u64,
    ) -> Option<Box<dyn drivers::Driver>> {
        let company = |build: Build| Company::new(on.people.clone(), build.radius_m, &home.numbers);
        let life = |life: &ResidentRoutine| Arc::new(life.with_seed(seed));
        if let Some(guest) = body.checked_sub(self.scenario.residents.len()) {
            let HouseholdVisitor { host, name } = self.guests.get(guest)?;
            let own = on.body(home, home.numbers.of(&GUEST_PACE_MPS));
            let (who, company) =
                ((ResidentId::new(body), ResidentId::new(*host), name.as_str()), company(Build::adult()));
            let (life, places) = (life(on.life.as_ref()?), on.places.clone());
            return Some(Box::new(RoutineDriver::visitor(life, home.clone(), places, own, who, company)));
        }
        if let Some(program) = self.scripts.get(&body) {
            return Some(Box::new(self.scripted(body, program, home, on, seed)));
        }
        let (life, places) = (life(on.life.as_ref()?), on.places.clone());
        let kind = self.routine(body)?.person.as_ref().map_or(ResidentKind::Person, |person| person.kind);
        let own = on.body(home, life.pace_mps);
        match kind {
            ResidentKind::Person => {
                let company = company(Build::new(&self.scenario.residents[body].file));
                let id = ResidentId::new(body);
                Some(Box::new(RoutineDriver::new(life, home.clone(), places, own, id, company)))
            }
            ResidentKind::Cat | ResidentKind::Dog => Some(Box::new(PetDriver::new(life, places, own))),
        }
    }
}

/// The part of a body's driver that does not depend on the seed.
#[derive(Clone, Debug)]
struct DriverTemplate {
    mesh: Arc<Mesh>,
    places: Arc<HomePlaces>,
    people: Arc<HouseholdMembers>,
    /// The routine of the resident, or of a visitor's host, with seed 0. `None` without a routine.
    life: Option<ResidentRoutine>,
    /// Limit of the cache of routes; `None` for the usual one.
    ways: Option<usize>,
}

impl DriverTemplate {
    fn body(&self, home: &Arc<Home>, pace_mps: f64) -> WalkingBody {
        let body = WalkingBody::new(home.clone(), self.mesh.clone(), pace_mps);
        self.ways.into_iter().fold(body, WalkingBody::remembering)
    }
}

fn gains(file: &WanderingFile) -> Gains {
    let WanderingFile { goal, walls, noise, people, open_floor, pauses_pm: pauses } = *file;
    Gains { goal, walls, noise, people, open_floor, pauses }
}

impl DriverProvider for Household {
    fn guests(&self) -> Vec<Guest> {
        let name = |visitor: &HouseholdVisitor| {
            format!("{}'s {}", self.scenario.residents[visitor.host].file.name, visitor.name)
        };
        self.guests.iter().map(|visitor| Guest { name: name(visitor), build: Build::adult() }).collect()
    }

    fn driver(&self, body: usize, home: &Arc<Home>, seed: u64) -> Option<Box<dyn drivers::Driver>> {
        self.driver_on(&self.footing(body, home)?, body, home, seed)
    }
}

/// Reads the routines and scripts of a scenario while it loads.
#[derive(Clone, Debug, Default)]
pub struct RoutineLanguage {
    pub(crate) routines: BTreeMap<usize, Routine>,
    scripts: BTreeMap<usize, Arc<Program>>,
    pub(crate) conditions: BTreeMap<String, Routine>,
    /// Their texts, by file.
    sources: BTreeMap<String, String>,
}

impl DriverLanguages for RoutineLanguage {
    fn read(&mut self, said: &DriverText, home: &HomeFile, plan: &Plan, files: &dyn Files) -> Vec<Problem> {
        let mut reader = RoutineReader::new(files, home, plan, said.calendar.map(|calendar| calendar.date(0)));
        reader.known = std::mem::take(&mut self.conditions);
        let routine = reader.routine(said.file, said.text, said.resident);
        self.routines.insert(said.of, routine);
        self.conditions = reader.known;
        let are_told = self.sources.contains_key(OWN_FILE);
        self.sources.extend(reader.sources);
        // The lexicon is shared by all residents.
        reader.problems.into_iter().filter(|problem| !are_told || problem.file != OWN_FILE).collect()
    }

    fn read_script(&mut self, said: &DriverText, home: &HomeFile, plan: &Plan) -> Vec<Problem> {
        match Program::read(said.file, said.text, &ScriptNames::new(home, plan, said.resident)) {
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

fn ordinary(home: &HomeFile, plan: &Plan) -> Routine {
    language::condition("ordinary.routine", ORDINARY, &known(home, plan, None, Vec::new(), None)).0
}

fn known(
    home: &HomeFile,
    plan: &Plan,
    person: Option<&str>,
    conditions: Vec<String>,
    first_date: Option<(i16, u8, u8)>,
) -> KnownNames {
    let furniture = home.furniture.iter().map(|piece| piece.name.clone());
    let places = plan.places.iter().map(|(name, _)| name.clone());
    let mut places: Vec<String> = places.chain(furniture).collect();
    // A resident's own things have a short name in that resident's routine, such as "his armchair".
    let whose = person.map(|person| format!("{}'s ", person.to_lowercase()));
    let own = |name: &String| Some(name.to_lowercase().strip_prefix(whose.as_ref()?)?.to_owned());
    let own: Vec<String> = places.iter().filter_map(own).collect();
    places.extend(own);
    KnownNames {
        person: person.map(String::from),
        places,
        things: plan.things.iter().map(|thing| thing.name.clone()).collect(),
        rooms: plan.rooms.iter().map(|room| room.name.clone()).collect(),
        floors: plan::floors(&home.rooms).into_iter().map(|floor| floor.name).collect(),
        conditions,
        first_date,
        usual: USUAL.to_vec(),
        ..KnownNames::default()
    }
}

struct RoutineReader<'a> {
    files: &'a dyn Files,
    home: &'a HomeFile,
    plan: &'a Plan,
    /// Year, month and day of the first day of the run.
    first: Option<(i16, u8, u8)>,
    known: BTreeMap<String, Routine>,
    sources: BTreeMap<String, String>,
    problems: Vec<Problem>,
    /// The lexicon of the language, with the scenario's own words.
    lexicon: Lexicon,
}

impl<'a> RoutineReader<'a> {
    fn new(
        files: &'a dyn Files,
        home: &'a HomeFile,
        plan: &'a Plan,
        first: Option<(i16, u8, u8)>,
    ) -> RoutineReader<'a> {
        let (mut sources, mut problems, mut lexicon) = (BTreeMap::new(), Vec::new(), Lexicon::default());
        if let Ok(text) = files.read(OWN_FILE) {
            (lexicon, problems) = lexicon.with(OWN_FILE, &text);
            sources.insert(OWN_FILE.to_owned(), text);
        }
        RoutineReader { files, home, plan, first, known: BTreeMap::new(), sources, problems, lexicon }
    }

    fn routine(&mut self, file: &str, text: &str, person: Option<&str>) -> Routine {
        let known = self.may_be_named(person, self.names(text));
        let (routine, problems) = language::routine(file, text, &known);
        self.problems.extend(problems);
        self.follow(&routine, &mut Vec::new());
        routine
    }

    fn may_be_named(&self, person: Option<&str>, conditions: Vec<String>) -> KnownNames {
        KnownNames { lexicon: self.lexicon.clone(), ..known(self.home, self.plan, person, conditions, self.first) }
    }

    /// Names of built-in conditions and of the scenario's files that the text may mean.
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

    /// `path` holds the conditions that lead to this routine, to detect circles.
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
                // A file that cannot be read does not fall back to the built-in condition.
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

fn said_at(routine: &Routine, line: u32, column: u32, message: HouseholdMessage) -> Problem {
    Problem { line, column, ..Problem::of_file(&routine.file, message, None) }
}

fn file_of(condition: &str) -> String {
    format!("conditions/{condition}.routine")
}
