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
use homebody_simulation::{Template, VariantOptions};
use tempfile::TempDir;

/// The time before the failure.
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

fn shelf(folder: &TempDir) -> Shelf {
    let scenario = folder.path().join("home");
    std::fs::create_dir(&scenario).unwrap();
    for (file, text) in Template::named("tigerplace").unwrap().files() {
        std::fs::write(scenario.join(file), text).unwrap();
    }
    Shelf { scenario, entry: "scenario.json".into(), is_trusted: false, runs: folder.path().join("runs") }
}

/// Looks until there is what is wished.
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

fn frame(news: &News) -> &Frame {
    news.frame.as_ref().expect("a run")
}

fn told(news: &News) -> Option<&str> {
    news.tells.iter().find_map(|tell| match tell {
        Tell::Note { text, bad: true, .. } => Some(text.as_str()),
        _ => None,
    })
}

/// A run whose driver panics, or says what no body can do, is over; what it stored is a whole run up to there, whoever looks
/// is told, and another begins.
#[test]
fn a_run_that_dies_is_told_of_and_kept_and_another_begins() {
    for panics in [true, false] {
        let folder = tempfile::tempdir().unwrap();
        let shelf = shelf(&folder);
        let run = StagedRun::new(&shelf, &shelf.entry, StartRequest::default()).unwrap();
        let household = Household::load(&shelf, &shelf.entry, &[]).unwrap().1;
        let run = run.driven_by(&AllDoomed { household: &household, panics });
        let stage = Stage::with_run(shelf.clone(), Ok(run)).unwrap();
        let mut seen = Seen::default();
        stage.voice().say(Say::Speed { times: None });
        stage.voice().say(Say::Play);
        let news = look(&stage, &mut seen, |news| told(news).is_some());
        let why = told(&news).unwrap().to_owned();
        assert!(why.contains(if panics { "nobody has thought of this" } else { "margaret" }), "{why}");
        look(&stage, &mut seen, |news| frame(news).state == State::Over);
        let late = stage.news(&mut Seen::default(), 10);
        assert_eq!(told(&late), Some(&why[..]), "who comes later is told, too");
        assert!(stage.changed().has_changed().is_ok(), "nobody's socket is closed");

        // What is kept is the run up to there.
        let run = shelf.runs().pop().unwrap();
        let recording: Recording = shelf.recording(&run).unwrap();
        assert!(recording.is_complete() && recording.firings > 0, "{recording:?}");
        assert!(recording.length_us <= WELL + HOUR && recording.length_us > WELL / 2);
        let (scenario, household) = Household::recorded(&recording).unwrap();
        let mut again = recording.run(&scenario, &household);
        let (mut events, mut digest) = (Events::default(), RunDigest::default());
        again.advance(RunTime::START + recording.length_us, &mut events).unwrap();
        digest.add(&events.firings);
        assert_eq!((digest.firings(), digest.hex()), (recording.firings, recording.sha256.clone()));
        let log = rusqlite::Connection::open(shelf.runs.join(&run).join("log.db")).unwrap();
        let rows: i64 = log.query_row("SELECT count(*) FROM event", [], |row| row.get(0)).unwrap();
        assert_eq!(rows as u64, recording.firings);

        stage.voice().say(Say::Start { driven: None, variant: VariantOptions::default() });
        stage.voice().say(Say::Speed { times: None });
        stage.voice().say(Say::Play);
        look(&stage, &mut seen, |news| {
            frame(news).state == State::Playing && frame(news).now_us > (WELL + SECOND).micros()
        });
        assert_eq!(told(&stage.news(&mut Seen::default(), 10)), None, "what was, is over");
        stage.close();
    }
}

/// A scenario with problems has no run, and says why; one is begun once they are mended, and what is wrong then leaves it.
#[test]
fn a_scenario_with_problems_has_no_run_until_they_are_mended() {
    let folder = tempfile::tempdir().unwrap();
    let shelf = shelf(&folder);
    let logger = shelf.scenario.join("logger.json");
    let whole = std::fs::read_to_string(&logger).unwrap();
    std::fs::write(&logger, whole.replace("hall motion", "corridor motion")).unwrap();
    let stage = Stage::open(shelf.clone()).unwrap();
    let unbegun = |news: &News| {
        news.tells
            .iter()
            .any(|tell| matches!(tell, Tell::Unbegun { problems, .. } if problems[0].file == "logger.json"))
    };
    let mut seen = Seen::default();
    let news = stage.news(&mut seen, 10);
    assert!(unbegun(&news) && news.frame.is_none());
    let start = Say::Start { driven: None, variant: VariantOptions::default() };
    for say in [Say::Play, Say::Jump { to_us: 5 }, Say::Stop, start.clone()] {
        stage.voice().say(say);
    }
    look(&stage, &mut seen, unbegun);
    std::fs::write(&logger, &whole).unwrap();
    stage.voice().say(start.clone());
    look(&stage, &mut seen, |news| news.tells.iter().any(|tell| matches!(tell, Tell::Run { .. })));
    stage.voice().say(Say::Play);
    look(&stage, &mut seen, |news| frame(news).state == State::Playing && frame(news).now_us > 0);
    std::fs::write(&logger, "{").unwrap();
    stage.voice().say(start);
    let news = look(&stage, &mut seen, unbegun);
    assert_eq!(frame(&news).state, State::Playing, "the run that goes on is left alone");
    stage.close();
}

/// Whoever takes the keys walks at the speed of the world, however fast the run before was.
#[test]
fn taking_the_keys_sets_the_speed_to_once() {
    let folder = tempfile::tempdir().unwrap();
    let stage = Stage::open(shelf(&folder)).unwrap();
    let mut seen = Seen::default();
    stage.voice().say(Say::Speed { times: None });
    let start = |driven| Say::Start { driven, variant: VariantOptions::default() };
    stage.voice().say(start(None));
    look(&stage, &mut seen, |news| frame(news).speed.is_none());
    stage.voice().say(start(Some(0)));
    look(&stage, &mut seen, |news| frame(news).speed == Some(1.0));
    stage.close();
}

/// The control of a queue without an end is 20,000 starts, which take minutes.
#[test]
fn a_page_that_says_much_keeps_no_other_from_being_heard_nor_the_stage_from_its_end() {
    let folder = tempfile::tempdir().unwrap();
    let stage = Stage::open(shelf(&folder)).unwrap();
    let loud = stage.voice();
    let start = || Say::Start { driven: None, variant: VariantOptions { seed: Some(1), ..VariantOptions::default() } };
    let taken = (0..20_000).filter(|_| loud.say(start())).count();
    assert!(taken < 20_000, "it is refused");
    assert!(stage.voice().say(Say::Play));
    look(&stage, &mut Seen::default(), |news| frame(news).state == State::Playing);
    while loud.say(start()) {}
    let begun = Instant::now();
    stage.close();
    println!("closed after {:?}", begun.elapsed());
    assert!(begun.elapsed() < Duration::from_secs(30), "{:?}", begun.elapsed());
}
