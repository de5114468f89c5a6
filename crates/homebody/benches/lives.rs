//! Lives: what the whole model costs beside the bare kernel, what a year of a life into SQLite costs beside a bare loop of
//! inserts, and what a cohort costs beside as many programs of one life each.
//!
//! Both sides of a ratio take turns in one run, so that a noisy machine disturbs both.
//!
//! Ends with one line per figure: `RATIO <name> <median> <min>..<max>` and `DECLINE seconds <median>`. Names after `--` ask
//! for those figures alone.

#[path = "../../homebody-core/benches/measure/mod.rs"]
mod measure;

use homebody_core::event::Events;
use homebody_core::home::Home;
use homebody_core::home::form::HomeFile;
use homebody_core::home::resolved::ResolvedHome;
use homebody_core::ids::ResidentId;
use homebody_core::link::form::{LinkFile, Network};
use homebody_core::motion::MotionSegment;
use homebody_core::recording::Recording;
use homebody_core::resident::Build;
use homebody_core::run::Run;
use homebody_core::scenario::load::{Files, NoText, Overlay, Scenario};
use homebody_core::time::{DAY, HOUR, RunTime, Span};
use homebody_core::world::World;
use homebody_log::run::places::SILHOUETTES;
use homebody_log::run_log::destinations;
use homebody_log::silhouettes::{SilhouetteLog, cameras};
use homebody_log::{Logger, RunInfo, Url, WriteMode};
use homebody_routine::household::Household;
use measure::{Spread, insert, rows};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::Arc;
use std::time::Instant;

const ROUNDS: usize = 7;
const YEAR: Span = DAY.times(365);
/// How often a run hands over what it has.
const STEP: Span = HOUR.times(6);
/// Members of the cohort, and how long each lives.
const MEMBERS: usize = 16;
const MEMBERS_DAYS: usize = 60;
/// Why a run is lived to its end.
const SOUND: &str = "drivers whose answers bodies can follow";

/// Measures what the figure of a name says.
type Figure<'a> = &'a dyn Fn(&str) -> String;

fn main() {
    let zigbee = || LinkFile { preset: Network::Zigbee, ..LinkFile::default() };
    homebody_simulation::install_sinks();
    let figures: [(&str, Figure); 8] = [
        ("life_vs_kernel", &|name| against_kernel(name, None, 90 * DAY)),
        ("life_with_link_vs_kernel", &|name| against_kernel(name, Some(zigbee()), 90 * DAY)),
        ("life_sqlite_vs_bare", &|name| against_inserts(name, YEAR)),
        ("parquet_vs_none", &|name| against_no_place(name, YEAR)),
        ("script_vs_life", &script_against_life),
        ("cameras_vs_none", &cameras_against_none),
        ("DECLINE", &decline),
        ("cohort_vs_programs", &cohort_against_programs),
    ];
    let asked: Vec<String> = std::env::args().skip(1).filter(|arg| !arg.starts_with('-')).collect();
    let is_asked = |name: &str| asked.is_empty() || asked.iter().any(|asked| asked == name);
    let lines: Vec<String> =
        figures.iter().filter(|(name, _)| is_asked(name)).map(|(name, figure)| figure(name)).collect();
    lines.iter().for_each(|line| println!("{line}"));
}

/// A scenario that comes with the program, and who lives there.
fn scenario(name: &str) -> (Scenario, Household) {
    let folder = Folder(Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios").join(name));
    Household::load(&folder, "scenario.json", &[]).expect("a scenario without problems")
}

struct Folder(PathBuf);

impl Files for Folder {
    fn read(&self, name: &str) -> Result<String, NoText> {
        fs::read_to_string(self.0.join(name)).map_err(|_| NoText::Missing)
    }
}

/// The whole model (routine, needs, paths, all sensors, and the link if there is one) against the bare kernel on the same
/// movement.
fn against_kernel(name: &str, link: Option<LinkFile>, length: Span) -> String {
    let (mut scenario, household) = scenario("tigerplace");
    scenario.link = link;
    let moves = Run::new(&scenario, &household, scenario.file.seed, length).moves().expect(SOUND);
    let mut bare = HomeFile::clone(&scenario.home);
    bare.sensors.retain(|sensor| sensor.on().is_none());
    let builds: Vec<Build> = (0..moves.len())
        .map(|body| scenario.residents.get(body).map_or(Build::adult(), |resident| Build::new(&resident.file)))
        .collect();
    let home = Arc::new(Home::bake(&ResolvedHome::new(bare).expect("a home"), &builds));
    let mut ratios = Vec::new();
    for _ in 0..ROUNDS {
        let life_s = live(&scenario, &household, length);
        let kernel_s = kernel(&home, &moves, length);
        let days = length.ratio(DAY);
        println!("a day: whole model {:.0} us, bare kernel {:.0} us", life_s / days * 1e6, kernel_s / days * 1e6);
        ratios.push(kernel_s / life_s);
    }
    Spread::of(&ratios).line(name, 3)
}

/// Lives the scenario and forgets what happens; seconds, with the making of the run.
fn live(scenario: &Scenario, household: &Household, length: Span) -> f64 {
    let start = Instant::now();
    let mut run = Run::new(scenario, household, scenario.file.seed, length);
    let mut events = Events::default();
    while run.now() < RunTime::START + length {
        run.advance(run.now() + STEP, &mut events).expect(SOUND);
        events.clear();
    }
    start.elapsed().as_secs_f64()
}

/// Gives the kernel the moves of all bodies in their order; seconds.
fn kernel(home: &Arc<Home>, moves: &[Vec<MotionSegment>], length: Span) -> f64 {
    let mut world = World::new(home.clone(), moves.len(), 1);
    let mut events = Events::default();
    let mut next = vec![0; moves.len()];
    let start = Instant::now();
    let end = RunTime::START + length;
    while world.now() < end {
        let mut until = end;
        for (body, moves) in moves.iter().enumerate() {
            if let Some(due) = moves.get(next[body]).filter(|due| due.begin <= world.now()) {
                world.begin(ResidentId::new(body), due);
                next[body] += 1;
            }
            until = until.min(moves.get(next[body]).map_or(end, |due| due.begin));
        }
        world.advance(until, &mut events);
        events.clear();
    }
    start.elapsed().as_secs_f64()
}

/// A thousand decisions of a script a day against the rest of a life: what they add to a day on which nothing else happens,
/// beside a day of a routine in the same home.
fn script_against_life(name: &str) -> String {
    const DECIDES: &str = r#"
        fn begin() { #{ decisions: 0, late: 0 } }
        fn next(around) {
            this.decisions += 1;
            if around.hour > 22.0 && (around.is_light("bedroom") || around.others.len() > 3) { this.late += 1; }
            if around.room == "kitchen" && around.is_on("stove") { return turn_off("stove"); }
            if chance("wait", 0.5) { rest(random("longer", 86.4, 100)) } else { rest(random("shorter", 72.8, 86.4)) }
        }"#;
    let length = 90 * DAY;
    let [deciding, resting] = [DECIDES, "fn next(around) { rest(8640000) }"].map(with_script);
    let usual = scenario("tigerplace");
    let mut ratios = Vec::new();
    for _ in 0..ROUNDS {
        let [deciding_s, resting_s, life_s] =
            [&deciding, &resting, &usual].map(|(scenario, household)| live(scenario, household, length));
        let per_day = [deciding_s - resting_s, life_s].map(|all_s| all_s / length.ratio(DAY) * 1e6);
        println!("a day: a thousand decisions {:.0} us, a life by a routine {:.0} us", per_day[0], per_day[1]);
        ratios.push((deciding_s - resting_s) / life_s);
    }
    Spread::of(&ratios).line(name, 3)
}

/// Four weeks with two cameras that sensors wake, with their silhouettes in a file, against the same weeks without cameras: how many
/// times as long they take.
fn cameras_against_none(name: &str) -> String {
    let length = 28 * DAY;
    let folder = tempfile::tempdir().expect("a folder");
    let log = folder.path().join("run.db");
    let [two, none] = [2, 0].map(with_cameras);
    let mut ratios = Vec::new();
    for _ in 0..ROUNDS {
        let none_s = live_into_database(&log, &none.0, &none.1, length);
        let two_s = live_into_database(&log, &two.0, &two.1, length);
        println!("four weeks: two cameras {two_s:.2} s, none {none_s:.2} s");
        ratios.push(two_s / none_s);
    }
    Spread::of(&ratios).line(name, 2)
}

/// The studio with the first of its cameras.
fn with_cameras(count: usize) -> (Scenario, Household) {
    let folder = Folder(Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/cameras"));
    let text = folder.read("home.json").expect("a home");
    let mut home: HomeFile = serde_json::from_str(&text).expect("a home");
    let mut left = count;
    home.sensors.retain(|sensor| {
        let is_camera = sensor.row().key == "camera";
        let stays = !is_camera || left > 0;
        left -= usize::from(is_camera && stays);
        stays
    });
    let texts = [("home.json".to_owned(), serde_json::to_string(&home).expect("a home"))].into();
    let files = Overlay { texts, others: &folder };
    Household::load(&files, "scenario.json", &[]).expect("a scenario without problems")
}

/// The apartment with its resident driven by a script.
fn with_script(script: &str) -> (Scenario, Household) {
    let folder = Folder(Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/tigerplace"));
    let resident = r#"{ "name": "margaret", "driver": { "script": "margaret.rhai" } }"#;
    let texts = [("margaret.json", resident), ("margaret.rhai", script)];
    let texts = texts.map(|(name, text)| (name.to_owned(), text.to_owned())).into();
    let files = Overlay { texts, others: &folder };
    Household::load(&files, "scenario.json", &[]).expect("a scenario without problems")
}

/// A resident-year into SQLite against a bare loop that inserts the same rows: how many times as long it takes.
fn against_inserts(name: &str, length: Span) -> String {
    let folder = tempfile::tempdir().expect("a folder");
    let (run, bare) = (folder.path().join("run.db"), folder.path().join("bare.db"));
    let (scenario, household) = scenario("tigerplace");
    live_into_database(&run, &scenario, &household, length);
    let rows = rows(&run);
    let mut ratios = Vec::new();
    for _ in 0..ROUNDS {
        let bare_s = insert(&bare, &rows);
        let run_s = live_into_database(&run, &scenario, &household, length);
        println!("{} rows of a year: bare loop {bare_s:.2} s, life {run_s:.2} s", rows.len());
        ratios.push(run_s / bare_s);
    }
    Spread::of(&ratios).line(name, 3)
}

/// A resident-year without any place for its log against the same into Parquet, one file and a data set: the share of the rate that
/// stays. Only a build with the feature has Parquet.
fn against_no_place(name: &str, length: Span) -> String {
    if !cfg!(feature = "parquet") {
        return format!("{name}: --features parquet measures it");
    }
    let folder = tempfile::tempdir().expect("a folder");
    let (scenario, household) = scenario("tigerplace");
    let url = |name: &str| format!("parquet:{}", folder.path().join(name).display()).parse().expect("a URL");
    let (file, set): (Url, Url) = (url("log.parquet"), url("lives"));
    let (mut of_file, mut of_set) = (Vec::new(), Vec::new());
    for _ in 0..ROUNDS {
        let none_s = live_into(&[], &scenario, &household, length);
        let file_s = live_into(std::slice::from_ref(&file), &scenario, &household, length);
        let set_s = live_into(std::slice::from_ref(&set), &scenario, &household, length);
        println!("a year: nowhere {none_s:.2} s, a file {file_s:.2} s, a data set {set_s:.2} s");
        of_file.push(none_s / file_s);
        of_set.push(none_s / set_s);
    }
    format!("{}\n{}", Spread::of(&of_file).line(name, 3), Spread::of(&of_set).line("data_set_vs_none", 3))
}

/// Two years of decline, lived into SQLite: how many seconds.
fn decline(name: &str) -> String {
    let folder = tempfile::tempdir().expect("a folder");
    let run = folder.path().join("run.db");
    let (scenario, household) = scenario("tigerplace-decline");
    let length = Span::from_days(scenario.file.days);
    let each_s: Vec<f64> = (0..3).map(|_| live_into_database(&run, &scenario, &household, length)).collect();
    let rows = rows(&run);
    let bare_s = insert(&folder.path().join("bare.db"), &rows);
    let median = Spread::of(&each_s).median;
    println!("{} days of decline: {} rows in {median:.2} s, bare loop {bare_s:.2} s", scenario.file.days, rows.len());
    format!("{name} seconds {median:.2}, {:.2} of a bare loop's rate", bare_s / median)
}

/// Lives the scenario into a database; seconds.
fn live_into_database(path: &Path, scenario: &Scenario, household: &Household, length: Span) -> f64 {
    let url: Url = format!("sqlite:{}", path.display()).parse().expect("a URL");
    live_into(&[url], scenario, household, length)
}

/// Lives the scenario into these places, as a log is always made; seconds.
fn live_into(urls: &[Url], scenario: &Scenario, household: &Household, length: Span) -> f64 {
    let start = Instant::now();
    let mut run = Run::new(scenario, household, scenario.file.seed, length);
    let recording = Recording::new(scenario, "bench", "scenario.json", scenario.file.seed, length);
    let info = Arc::new(RunInfo::of(scenario, &run, &recording));
    let places = destinations(urls, WriteMode::Overwrite).expect("a place that can be written");
    let mut logger = Logger::open(places, &Default::default(), &info, WriteMode::Overwrite).expect("an open database");
    // Beside the log, as a run's folder has them.
    let beside = urls.first().map(|url| url.path().with_file_name(SILHOUETTES));
    let mut silhouettes = beside.filter(|_| cameras(&scenario.home).next().is_some()).map(|path| {
        let _ = fs::remove_file(&path);
        SilhouetteLog::open(&path, &scenario.home, &info, WriteMode::Overwrite).expect("an open database")
    });
    let mut events = Events::default();
    while run.now() < RunTime::START + length {
        run.advance(run.now() + STEP, &mut events).expect(SOUND);
        logger.store(&events.firings, run.now()).expect("stored firings");
        if let Some(silhouettes) = &mut silhouettes {
            silhouettes.store(&events.frames).expect("stored pictures");
        }
        events.clear();
    }
    logger.finish().expect("a finished log");
    if let Some(silhouettes) = silhouettes {
        silhouettes.finish().expect("a finished file");
    }
    start.elapsed().as_secs_f64()
}

/// A cohort in one program against as many programs started together: how many times as fast it is.
fn cohort_against_programs(name: &str) -> String {
    let program = env!("CARGO_BIN_EXE_homebody");
    let folder = tempfile::tempdir().expect("a folder");
    let scenario = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/tigerplace");
    let run = |more: &[&str]| -> Child {
        let mut command = Command::new(program);
        command.arg("run").arg(&scenario).args(["--quiet", "--for", &format!("{MEMBERS_DAYS}d")]).args(more);
        command.current_dir(folder.path()).stdout(Stdio::null()).spawn().expect("a running program")
    };
    let all_done = |children: Vec<Child>| {
        for mut child in children {
            assert!(child.wait().expect("an exit code").success());
        }
        fs::remove_dir_all(folder.path().join("runs")).expect("a folder of runs");
    };
    let mut ratios = Vec::new();
    for _ in 0..3 {
        let start = Instant::now();
        all_done((0..MEMBERS).map(|seed| run(&["--seed", &seed.to_string()])).collect());
        let programs_s = start.elapsed().as_secs_f64();
        let start = Instant::now();
        all_done(vec![run(&["--residents", &MEMBERS.to_string()])]);
        let cohort_s = start.elapsed().as_secs_f64();
        println!("{MEMBERS} lives of {MEMBERS_DAYS} days: programs {programs_s:.2} s, cohort {cohort_s:.2} s");
        ratios.push(programs_s / cohort_s);
    }
    Spread::of(&ratios).line(name, 2)
}
