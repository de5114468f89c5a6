//! The anchors: the speed of the kernel compared with the paper's loop (P), a brute-force loop without a physics engine
//! (R) and a bare loop of inserts, and the cost of a step of live physics.
//!
//! Both sides of a ratio take turns in one run, so that a noisy machine disturbs both. The loops are too slow for whole
//! days: they run excerpts spread evenly over the same schedule, and are timed per simulated second.
//!
//! Ends with one line per figure: `RATIO <name> <median> <min>..<max>` and `LIVE step_us <median>`.

#![allow(
    clippy::disallowed_methods,
    clippy::disallowed_types,
    reason = "a benchmark reads the clock and writes files; the core may not"
)]

mod measure;
mod scene;

use homebody_core::calendar::Calendar;
use homebody_core::drivers::input::{DriveKey, InputFile, KeysFile};
use homebody_core::drivers::live::{KeyTrack, LiveDriver};
use homebody_core::event::Events;
use homebody_core::geometry::Point;
use homebody_core::home::Home;
use homebody_core::home::resolved::ResolvedHome;
use homebody_core::ids::ResidentId;
use homebody_core::motion::{MotionSegment, MotionState};
use homebody_core::posture::Posture;
use homebody_core::resident::Build;
use homebody_core::run::Run;
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::time::{DAY, HOUR, Interval, RunTime, SECOND, Span};
use homebody_core::world::World;
use homebody_log::run_log::destinations;
use homebody_log::{Log, Logger, RunInfo, Url, WriteMode};
use homebody_oracle::brute::BruteEye;
use homebody_oracle::paper::PaperEye;
use homebody_oracle::{Eye, Loop, Player, Remainder};
use measure::{Spread, insert, rows};
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

const ROUNDS: usize = 7;
/// A round of live steps takes a millisecond: after the first dozens caches and clocks are warm.
const LIVE_ROUNDS: usize = 500;
/// The interval at which a run into a database hands over its rows.
const STEP: Span = HOUR;
/// So many excerpts, each so long, are a round of a loop.
const EXCERPTS: i64 = 40;
const EXCERPT: Span = Span::from_millis(500);

fn main() {
    let build = Build { radius_m: 0.22, height_m: 1.65 };
    let start = Instant::now();
    let home = Arc::new(Home::bake(&ResolvedHome::new(scene::home()).expect("a home"), &[build]));
    println!("the bench scene, baked in {:.1} ms", start.elapsed().as_secs_f64() * 1e3);
    let mut lines = Vec::new();
    for (name, schedule) in [("day", scene::day(60 * DAY)), ("walk", scene::walk(4 * DAY))] {
        lines.extend(against_loops(name, &home, build, &schedule));
    }
    lines.push(against_inserts(&home, &scene::day(360 * DAY)));
    lines.push(live_step(home, build));
    lines.iter().for_each(|line| println!("{line}"));
}

/// The kernel against P and against R on one schedule.
fn against_loops(name: &str, home: &Arc<Home>, build: Build, schedule: &[MotionSegment]) -> Vec<String> {
    let excerpts = excerpts(schedule);
    let (mut kernel_s, mut paper_s, mut brute_s) = (Vec::new(), Vec::new(), Vec::new());
    for _ in 0..ROUNDS {
        kernel_s.push(kernel(home, schedule));
        let size = build.size(Posture::Standing, &home.numbers);
        paper_s.push(naive(PaperEye::new(home, size, 1), home, build, &excerpts));
        kernel_s.push(kernel(home, schedule));
        brute_s.push(naive(BruteEye::new(home, home.field(0, Posture::Standing)), home, build, &excerpts));
    }
    for (what, each_s) in [("kernel", &kernel_s), ("P", &paper_s), ("R", &brute_s)] {
        println!("{name}: {what} takes {:.3e} s for a simulated second", Spread::of(each_s).median);
    }
    // Each round of a loop against the kernel's turn just before it.
    let before = |turn: usize| kernel_s.iter().skip(turn).step_by(2);
    let ratios = |loop_s: &[f64], turn| loop_s.iter().zip(before(turn)).map(|(l, k)| l / k).collect::<Vec<_>>();
    vec![
        Spread::of(&ratios(&paper_s, 0)).line(&format!("{name}_vs_paper"), 0),
        Spread::of(&ratios(&brute_s, 1)).line(&format!("{name}_vs_brute"), 0),
    ]
}

/// Lives the schedule; seconds for a simulated second.
fn kernel(home: &Arc<Home>, schedule: &[MotionSegment]) -> f64 {
    let mut world = World::new(home.clone(), 1, 1);
    let mut events = Events::default();
    let start = Instant::now();
    for next in schedule {
        world.begin(ResidentId(0), next);
        world.advance(next.end, &mut events);
        events.clear();
    }
    start.elapsed().as_secs_f64() / world.now().seconds()
}

/// Lives the excerpts in a loop of 60 updates a second; seconds for a simulated second.
fn naive(eye: impl Eye, home: &Home, build: Build, excerpts: &[MotionSegment]) -> f64 {
    let mut naive = Loop::new(eye, home, 1, 1, Remainder::Kept);
    let mut firings = Vec::new();
    let until = excerpts[excerpts.len() - 1].end;
    let start = Instant::now();
    naive.run(&mut [Player::new(excerpts, build.radius_m)], until, &mut firings);
    start.elapsed().as_secs_f64() / until.seconds()
}

/// Short stretches from the whole schedule, one after the other from the start on.
fn excerpts(schedule: &[MotionSegment]) -> Vec<MotionSegment> {
    let end = schedule[schedule.len() - 1].end;
    let length = end.since_zero();
    let mut excerpts = Vec::new();
    for index in 0..EXCERPTS {
        // Off the middle, so that the excerpts fall on all times of day.
        let begin = RunTime::START + (2 * index + 1) * length / (2 * EXCERPTS) + index * DAY / EXCERPTS;
        let excerpt = Interval::starting(begin.min(end - EXCERPT), EXCERPT);
        let shift = RunTime::START + index * EXCERPT - excerpt.begin;
        let within = schedule.iter().filter(|piece| Interval::new(piece.begin, piece.end).overlaps(excerpt));
        excerpts.extend(within.map(|piece| cut(piece, excerpt, shift)));
    }
    excerpts
}

/// The part of a move in an excerpt, shifted in time.
fn cut(piece: &MotionSegment, excerpt: Interval<RunTime>, shift: Span) -> MotionSegment {
    let Interval { begin, end } = Interval::new(piece.begin, piece.end).intersection(excerpt);
    let doing = match piece.doing {
        MotionState::Stride { from, to } => {
            let at = |now: RunTime| from.lerp(to, (now - piece.begin).ratio(piece.end - piece.begin));
            MotionState::Stride { from: at(begin), to: at(end) }
        }
        other => other,
    };
    MotionSegment { begin: begin + shift, end: end + shift, doing, posture: piece.posture }
}

/// A run into a database against a bare loop that inserts the same rows.
fn against_inserts(home: &Arc<Home>, schedule: &[MotionSegment]) -> String {
    let folder = tempfile::tempdir().expect("a folder for databases");
    let (run, bare) = (folder.path().join("run.db"), folder.path().join("bare.db"));
    run_into(&run, home, schedule);
    let rows = rows(&run);
    println!("a run into a database: {} rows", rows.len());
    let mut ratios = Vec::new();
    for _ in 0..ROUNDS {
        let bare_s = insert(&bare, &rows);
        let run_s = run_into(&run, home, schedule);
        println!("rows a second: bare loop {:.0}, run {:.0}", rows.len() as f64 / bare_s, rows.len() as f64 / run_s);
        ratios.push(bare_s / run_s);
    }
    Spread::of(&ratios).line("sqlite_vs_bare", 3)
}

/// Lives the schedule into a database, by the hour; seconds.
fn run_into(path: &Path, home: &Arc<Home>, schedule: &[MotionSegment]) -> f64 {
    let sensors: Vec<String> = home.sensors.iter().map(|sensor| sensor.name.clone()).collect();
    let url: Url = format!("sqlite:{}", path.display()).parse().expect("a URL");
    let calendar = Calendar::new("2026-01-01T00:00:00", "America/Chicago").expect("a calendar");
    let log = Log { sensors, ..Log::default() };
    let info = Arc::new(RunInfo::of_log("bench", calendar, &log));
    let start = Instant::now();
    let places = destinations(&[url], WriteMode::Overwrite).expect("a place that can be written");
    let mut logger =
        Logger::open(places, &LoggerFile::default(), &info, WriteMode::Overwrite).expect("an open database");
    let mut world = World::new(home.clone(), 1, 1);
    let mut events = Events::default();
    let mut handed_over = RunTime::START;
    for next in schedule {
        world.begin(ResidentId(0), next);
        world.advance(next.end, &mut events);
        if next.end >= handed_over + STEP {
            logger.store(&events.firings, next.end).expect("stored firings");
            events.clear();
            handed_over = next.end;
        }
    }
    logger.store(&events.firings, world.now()).expect("stored firings");
    logger.finish().expect("a finished log");
    start.elapsed().as_secs_f64()
}

/// The cost of a sixtieth of a second with keys that move one resident, physics and sensors together.
fn live_step(home: Arc<Home>, build: Build) -> String {
    const STEPS: i64 = 60 * 60;
    let turns = [DriveKey::Up, DriveKey::Right, DriveKey::Down, DriveKey::Left];
    // Into walls and furniture, round the room and through doors.
    let keys = (0..STEPS / 40).map(|turn| {
        let held = vec![turns[turn as usize % 4], turns[(turn as usize / 3) % 4]];
        KeysFile { at_s: (turn * 40 * SECOND / 60).seconds(), held, posture: Posture::Standing, uses: Vec::new() }
    });
    let input = InputFile { schema: None, keys: keys.collect() };
    let each_us = (0..LIVE_ROUNDS).map(|_| {
        let driver = LiveDriver::new(
            &home.plan,
            Point::new(1.75, 1.5),
            build.radius_m,
            1.0,
            KeyTrack::written(&input, &home.plan),
        );
        let length = STEPS * SECOND / 60;
        let mut run = Run::from_drivers(home.clone(), vec![build], vec![Box::new(driver)], 1, length);
        let mut events = Events::default();
        let start = Instant::now();
        for step in 1..=STEPS {
            run.advance(RunTime::START + step * SECOND / 60, &mut events)
                .expect("a driver whose answers bodies can follow");
            events.clear();
        }
        start.elapsed().as_secs_f64() * 1e6 / STEPS as f64
    });
    format!("LIVE step_us {:.2}", Spread::of(&each_us.collect::<Vec<_>>()).median)
}
