use super::*;
use homebody_core::drivers::{Driver, Next, Surroundings};
use homebody_core::event::Events;
use homebody_core::geometry::Point;
use homebody_core::home::Home;
use homebody_core::motion::{MotionSegment, MotionState};
use homebody_core::posture::Posture;
use homebody_core::recording::{Recording, RunDigest};
use homebody_core::run::{DriverProvider, Guest};
use homebody_core::time::{HOUR, SECOND};
use homebody_routine::household::Household;
use homebody_simulation::{RunLength, RunOptions, RunStart, Template, VariantOptions};
use tempfile::TempDir;

const WELL: Span = HOUR.times(9);

/// Follows the routine at first, and then takes an impossible step, or panics.
#[derive(Clone, Debug)]
struct Doomed {
    routine: Box<dyn Driver>,
    panics: bool,
}

impl Driver for Doomed {
    fn next(&mut self, around: &Surroundings) -> Next {
        if around.now().since_zero() < WELL {
            return self.routine.next(around);
        }
        assert!(!self.panics, "nobody has thought of this");
        let nowhere = MotionState::Rest { at: Point::new(f64::NAN, 0.0) };
        let (begin, posture) = (around.now(), Posture::Standing);
        Next::Segment(MotionSegment { begin, end: begin + SECOND, doing: nowhere, posture })
    }

    fn copy(&self) -> Box<dyn Driver> {
        Box::new(self.clone())
    }
}

struct AllDoomed<'h> {
    household: &'h Household,
    panics: bool,
}

impl DriverProvider for AllDoomed<'_> {
    fn guests(&self) -> Vec<Guest> {
        self.household.guests()
    }

    fn driver(&self, body: usize, home: &Arc<Home>, seed: u64) -> Option<Box<dyn Driver>> {
        let routine = self.household.driver(body, home, seed)?;
        Some(Box::new(Doomed { routine, panics: self.panics }))
    }
}

fn folders(folder: &TempDir) -> HomeFolders {
    let scenario = folder.path().join("home");
    std::fs::create_dir(&scenario).unwrap();
    for (file, text) in Template::named("tigerplace").unwrap().files() {
        std::fs::write(scenario.join(file), text).unwrap();
    }
    HomeFolders { scenario, entry: "scenario.json".into(), is_trusted: false, runs: folder.path().join("runs") }
}

fn look(stage: &Stage, seen: &mut Seen, is_wished: impl Fn(&News) -> bool) -> News {
    let begun = Instant::now();
    loop {
        let news = stage.news(seen, 10);
        if is_wished(&news) {
            return news;
        }
        assert!(begun.elapsed() < Duration::from_secs(60), "{:?}", news.frame);
        thread::sleep(Duration::from_millis(5));
    }
}

fn frame(news: &News) -> &RunFrame {
    news.frame.as_ref().expect("a run")
}

fn told(news: &News) -> Option<&str> {
    news.tells.iter().find_map(|tell| match tell {
        RunNotice::Note { text, bad: true, .. } => Some(text.as_str()),
        _ => None,
    })
}

/// A run whose driver panics or takes an invalid step ends. Its stored part is complete, every page gets the reason, and another run
/// starts.
#[test]
fn reports_and_stores_a_failed_run_and_starts_another() {
    for panics in [true, false] {
        let folder = tempfile::tempdir().unwrap();
        let folders = folders(&folder);
        let run = StagedRun::new(&folders, &folders.entry, StartRequest::default()).unwrap();
        let household = Household::load(&folders, &folders.entry, &[]).unwrap().1;
        let run = run.driven_by(&AllDoomed { household: &household, panics });
        let stage = Stage::with_run(folders.clone(), Ok(run)).unwrap();
        let mut seen = Seen::default();
        stage.page_commands().send(PageCommand::Speed { times: None });
        stage.page_commands().send(PageCommand::Play);
        let news = look(&stage, &mut seen, |news| told(news).is_some());
        let why = told(&news).unwrap().to_owned();
        assert!(why.contains(if panics { "nobody has thought of this" } else { "margaret" }), "{why}");
        look(&stage, &mut seen, |news| frame(news).state == RunState::Over);
        let late = stage.news(&mut Seen::default(), 10);
        assert_eq!(told(&late), Some(&why[..]), "who comes later is told, too");
        assert!(stage.changed().has_changed().is_ok(), "nobody's socket is closed");

        // The stored part is the run up to there.
        let run = folders.runs().pop().unwrap();
        let recording: Recording = folders.recording(&run).unwrap();
        assert!(recording.is_complete() && recording.firings > 0, "{recording:?}");
        assert!(recording.length_us <= WELL + HOUR && recording.length_us > WELL / 2);
        let (scenario, household) = Household::recorded(&recording).unwrap();
        let mut again = recording.run(&scenario, &household);
        let (mut events, mut digest) = (Events::default(), RunDigest::default());
        again.advance(RunTime::START + recording.length_us, &mut events).unwrap();
        digest.add(&events.firings);
        assert_eq!((digest.firings(), digest.hex()), (recording.firings, recording.sha256.clone()));
        let log = rusqlite::Connection::open(folders.runs.join(&run).join("log.db")).unwrap();
        let rows: i64 = log.query_row("SELECT count(*) FROM event", [], |row| row.get(0)).unwrap();
        assert_eq!(rows as u64, recording.firings);

        stage.page_commands().send(PageCommand::Start { driven: None, options: RunOptions::default() });
        stage.page_commands().send(PageCommand::Speed { times: None });
        stage.page_commands().send(PageCommand::Play);
        look(&stage, &mut seen, |news| {
            frame(news).state == RunState::Playing && frame(news).now_us > (WELL + SECOND).micros()
        });
        assert_eq!(told(&stage.news(&mut Seen::default(), 10)), None, "what was, is over");
        stage.close();
    }
}

/// An invalid scenario has no run until its problems are solved; later problems leave the present run alone.
#[test]
fn starts_no_run_of_an_invalid_scenario() {
    let folder = tempfile::tempdir().unwrap();
    let folders = folders(&folder);
    let logger = folders.scenario.join("logger.json");
    let whole = std::fs::read_to_string(&logger).unwrap();
    std::fs::write(&logger, whole.replace("hall motion", "corridor motion")).unwrap();
    let stage = Stage::open(folders.clone()).unwrap();
    let unbegun = |news: &News| {
        news.tells
            .iter()
            .any(|tell| matches!(tell, RunNotice::Unbegun { problems, .. } if problems[0].file == "logger.json"))
    };
    let mut seen = Seen::default();
    let news = stage.news(&mut seen, 10);
    assert!(unbegun(&news) && news.frame.is_none());
    let start = PageCommand::Start { driven: None, options: RunOptions::default() };
    for say in [PageCommand::Play, PageCommand::Jump { to_us: 5 }, PageCommand::Stop, start.clone()] {
        stage.page_commands().send(say);
    }
    look(&stage, &mut seen, unbegun);
    std::fs::write(&logger, &whole).unwrap();
    stage.page_commands().send(start.clone());
    look(&stage, &mut seen, |news| news.tells.iter().any(|tell| matches!(tell, RunNotice::Run { .. })));
    stage.page_commands().send(PageCommand::Play);
    look(&stage, &mut seen, |news| frame(news).state == RunState::Playing && frame(news).now_us > 0);
    std::fs::write(&logger, "{").unwrap();
    stage.page_commands().send(start);
    let news = look(&stage, &mut seen, unbegun);
    assert_eq!(frame(&news).state, RunState::Playing, "the run that goes on is left alone");
    stage.close();
}

/// The page that asks shows all messages of an option at its field. Other pages, and pages that open later, get none.
#[test]
fn names_the_option_that_prevents_a_run_to_the_page_that_asks() {
    let folder = tempfile::tempdir().unwrap();
    let stage = Stage::open(folders(&folder)).unwrap();
    let (page, other) = (stage.page_commands(), stage.page_commands());
    let (mut seen, mut other) = (page.seen(), other.seen());
    let refused = |news: &News| news.tells.iter().any(|tell| matches!(tell, RunNotice::Unbegun { .. }));
    assert!(!refused(&stage.news(&mut seen, 10)) && !refused(&stage.news(&mut other, 10)));
    let seed = |seed| VariantOptions { seed: Some(seed), ..VariantOptions::default() };
    let numbers = vec![("gait.slowest".into(), -1.0), ("gait.fastest_of_all".into(), 1.0)];
    for (option, words, options) in [
        ("days", &[][..], RunOptions { length: Some(RunLength::Days(0.0)), ..RunOptions::default() }),
        ("start", &["noon"], RunOptions { start: Some(RunStart::At("noon".into())), ..RunOptions::default() }),
        ("seed", &["seed"], seed(1 << 53).into()),
        ("without", &["flu"], VariantOptions { without: vec!["flu".into()], ..VariantOptions::default() }.into()),
        ("numbers", &["gait.slowest", "\n", "gait.fastest_of_all"], RunOptions { numbers, ..RunOptions::default() }),
    ] {
        page.send(PageCommand::Start { driven: None, options });
        let news = look(&stage, &mut seen, refused);
        let named = news.tells.iter().find_map(|tell| match tell {
            RunNotice::Unbegun { why, option, problems, .. } if problems.is_empty() => Some((option.as_deref()?, why)),
            _ => None,
        });
        let (named, why) = named.unwrap();
        assert!(named == option && words.iter().all(|word| why.contains(*word)), "{named}: {why}");
        assert!(!refused(&stage.news(&mut other, 10)) && !refused(&stage.news(&mut stage.page_commands().seen(), 10)));
    }
    stage.page_commands().send(PageCommand::Start { driven: None, options: seed((1 << 53) - 1).into() });
    look(&stage, &mut seen, |news| news.tells.iter().any(|tell| matches!(tell, RunNotice::Run { .. })));
    stage.close();
}

/// The files of a run that starts again have its start and its parameters already; the page compares the files without them.
#[test]
fn a_run_that_starts_again_keeps_its_options() {
    let folder = tempfile::tempdir().unwrap();
    let folders = folders(&folder);
    let options = RunOptions {
        length: Some(RunLength::Days(2.0)),
        start: Some(RunStart::Now),
        variant: VariantOptions { seed: Some(7), ..VariantOptions::default() },
        numbers: vec![("gait.slowest".into(), 0.25)],
        one_of_many: true,
    };
    let plain = StagedRun::new(&folders, &folders.entry, StartRequest::default()).unwrap().view();
    let run = StagedRun::new(&folders, &folders.entry, StartRequest { options, ..StartRequest::default() }).unwrap();
    let (view, again) = (run.view(), run.restarted(RunTime::START).unwrap().view());
    // Clocks may change on these days.
    assert!(view.seed == 7 && (47..=49).contains(&(view.length_us / HOUR.micros())));
    assert_eq!((&view.files, &again), (&plain.files, &view));
    assert_ne!(view.days, plain.days);
}

/// Manual control starts at real time, whatever the speed before.
#[test]
fn manual_control_starts_at_real_time() {
    let folder = tempfile::tempdir().unwrap();
    let stage = Stage::open(folders(&folder)).unwrap();
    let mut seen = Seen::default();
    stage.page_commands().send(PageCommand::Speed { times: None });
    let start = |driven| PageCommand::Start { driven, options: RunOptions::default() };
    stage.page_commands().send(start(None));
    look(&stage, &mut seen, |news| frame(news).speed.is_none());
    stage.page_commands().send(start(Some(0)));
    look(&stage, &mut seen, |news| frame(news).speed == Some(1.0));
    stage.close();
}

/// The control is a queue without a limit: 20,000 starts take minutes.
#[test]
fn many_commands_of_a_page_delay_neither_others_nor_the_end() {
    let folder = tempfile::tempdir().unwrap();
    let stage = Stage::open(folders(&folder)).unwrap();
    let loud = stage.page_commands();
    let start = || PageCommand::Start { driven: None, options: RunOptions::default() };
    let taken = (0..20_000).filter(|_| loud.send(start())).count();
    assert!(taken < 20_000, "it is refused");
    assert!(stage.page_commands().send(PageCommand::Play));
    look(&stage, &mut Seen::default(), |news| frame(news).state == RunState::Playing);
    while loud.send(start()) {}
    let begun = Instant::now();
    stage.close();
    println!("closed after {:?}", begun.elapsed());
    assert!(begun.elapsed() < Duration::from_secs(30), "{:?}", begun.elapsed());
}
