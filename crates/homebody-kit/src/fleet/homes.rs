//! Which homes a fleet has, and making them.

use super::churn::{Churn, Presence};
use super::storms::Storms;
use crate::VERSION;
use crate::cohort_members::seed_of_member;
use crate::error::Error;
use crate::pace::Speed;
use crate::scenario::OpenScenario;
use homebody_core::problem::Problems;
use homebody_core::random::Stream;
use homebody_core::recording::{LONGEST, Recording};
use homebody_core::run::Run;
use homebody_core::time::Micros;
use homebody_log::RunInfo;
use homebody_log::fleet::{Fleet, FleetHome, HomeRows, Layout};
use homebody_routine::household::ManyRuns;
use rayon::prelude::*;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

homebody_core::messages! {
    /// Problems with a fleet before it starts.
    pub enum FleetMessage in "fleet" {
        /// The homes of a fleet have names with five digits, such as `home00001`. Several programs can simulate parts of one fleet: each
        /// part has its own first number.
        Homes {
            /// The homes asked for.
            homes: u32,
            /// The number of the first one.
            first: u32,
        } error "homes" ("a fleet cannot have {homes} homes from number {first} on")
            hint ("choose at least one home, with numbers from 1 to {MOST_HOMES}");
        /// A fleet runs at the speed of the clock, or faster or slower by this factor.
        Speed {
            /// The factor asked for.
            speed: f64,
        } error "speed" ("a fleet cannot run {speed} times as fast as the clock")
            hint ("choose a number from 0.1 to 1000");
        /// The clocks of homes are ahead of the true time, or behind, by up to this much.
        Skew {
            /// The difference asked for, in microseconds.
            skew_us: Micros,
        } error "skew" ("clocks cannot differ by {skew_us} microseconds")
            hint ("choose 0 or more");
    }
}

/// Largest number of homes of a fleet (our choice): their numbers have five digits.
pub const MOST_HOMES: u32 = 99_999;

/// What a fleet is to be. A home's life depends on its number, on the seed and on the scenarios, and on nothing else that is here.
pub struct FleetSetup {
    /// The scenarios, in turn: home 1 has the first. All begin when the fleet does.
    pub scenarios: Vec<OpenScenario>,
    /// How many homes.
    pub homes: u32,
    /// The number of the first of them: 1, unless other programs live those before.
    pub first: u32,
    /// The number that all randomness comes from; None for that of the first scenario.
    pub seed: Option<u64>,
    /// Conditions that the routines show and nobody of the fleet does.
    pub without: Vec<String>,
    /// How many times as fast as life it goes, from the start of the scenarios on. None: it is where the world's clock is.
    pub speed: Option<f64>,
    /// The clock of no home is further off, in microseconds.
    pub skew: Micros,
    /// Homes that come and go.
    pub churn: Option<Churn>,
    /// When the network of all homes is away.
    pub storms: Option<Storms>,
}

/// The homes of a fleet, all of them made.
pub struct FleetOf {
    /// Which they are.
    pub fleet: Arc<Fleet>,
    pub(super) homes: Vec<HomeOf>,
    pub(super) speed: Option<f64>,
    pub(super) storms: Option<Storms>,
    /// When each layout's runs start, in microseconds since 1970.
    pub(super) starts: Vec<i64>,
}

/// One home at its beginning.
pub(super) struct HomeOf {
    pub run: Run,
    pub rows: HomeRows,
    pub presence: Option<Presence>,
    /// How much its clock is ahead of the world's, in microseconds.
    pub skew: Micros,
}

/// What homes of one scenario are made by.
struct Kind {
    many: ManyRuns,
    recording: Recording,
}

impl FleetSetup {
    /// Makes all homes, on all processors; `made` is told how many there are by now.
    ///
    /// # Errors
    ///
    /// [`Error::Fleet`] if there are to be none or too many, or the speed is none; [`Error::Problems`] if nobody shows a condition
    /// that is to be left out; [`Error::Log`] if a logger's names cannot be used.
    pub fn make(self, made: impl Fn(usize) + Sync) -> Result<FleetOf, Error> {
        self.is_possible()?;
        let seed = self.seed.unwrap_or(self.scenarios[0].scenario.file.seed);
        let (mut kinds, mut layouts) = (Vec::new(), Vec::new());
        for opened in &self.scenarios {
            let (kind, layout) = kind_of(opened, &self.without, seed)?;
            kinds.push(kind);
            layouts.push(layout);
        }
        let starts = self.scenarios.iter().map(|opened| opened.scenario.calendar.timestamp(0).as_microsecond());
        let starts = starts.collect();
        let home = |index: u32| {
            let number = self.first + index;
            let layout = (number as usize - 1) % kinds.len();
            let (name, seed) = (format!("home{number:05}"), seed_of_member(seed, number));
            let recording = Recording { seed, home: Some(name.clone()), ..kinds[layout].recording.clone() };
            FleetHome { name, layout, run: recording.run_id(), seed }
        };
        let homes: Vec<FleetHome> = (0..self.homes).into_par_iter().map(home).collect();
        let so_far = AtomicUsize::new(0);
        let make = |home: &FleetHome| {
            let of = HomeOf {
                run: kinds[home.layout].many.run(home.seed, LONGEST),
                rows: layouts[home.layout].rows(home.seed),
                presence: self.churn.map(|churn| Presence::new(churn, home.seed)),
                skew: skew_of(home.seed, self.skew),
            };
            made(so_far.fetch_add(1, Ordering::Relaxed) + 1);
            of
        };
        let made = homes.par_iter().map(make).collect();
        let fleet = Arc::new(Fleet { first: self.first, layouts, homes });
        Ok(FleetOf { fleet, homes: made, speed: self.speed, storms: self.storms, starts })
    }

    fn is_possible(&self) -> Result<(), Error> {
        let mut wrong = Vec::new();
        let last = u64::from(self.first) + u64::from(self.homes) - 1;
        if self.scenarios.is_empty() || self.homes == 0 || self.first == 0 || last > u64::from(MOST_HOMES) {
            wrong.push(FleetMessage::Homes { homes: self.homes, first: self.first }.into());
        }
        if let Some(speed) = self.speed.filter(|speed| Speed::times(*speed).is_none()) {
            wrong.push(FleetMessage::Speed { speed }.into());
        }
        if self.skew < 0 {
            wrong.push(FleetMessage::Skew { skew_us: self.skew }.into());
        }
        if wrong.is_empty() { Ok(()) } else { Err(Error::Fleet(Problems(wrong))) }
    }
}

impl FleetOf {
    /// How much the clock of a home is ahead of the world's, in microseconds.
    pub fn skew(&self, home: u32) -> Micros {
        self.homes[home as usize].skew
    }

    /// Whether a home is there as the fleet begins.
    pub fn is_there(&self, home: u32) -> bool {
        self.homes[home as usize].presence.as_ref().is_none_or(Presence::is_there)
    }
}

/// How much the clock of the home of a seed is ahead: any value from `-most` to `most` is as likely.
fn skew_of(seed: u64, most: Micros) -> Micros {
    Stream::named(seed, "fleet/clock").between(-(most as f64), most as f64).round() as Micros
}

fn kind_of(opened: &OpenScenario, without: &[String], seed: u64) -> Result<(Kind, Layout), Error> {
    let OpenScenario { scenario, source, .. } = opened;
    let household = Arc::new(opened.household_without(without)?.one_of_many());
    let recording = Recording::of(scenario, VERSION, source.entry(), seed, LONGEST);
    let recording = Recording { without: without.to_vec(), one_of_many: true, ..recording };
    let many = ManyRuns::new(household);
    let info = RunInfo::of(scenario, &many.run(seed, LONGEST), &recording);
    let layout = Layout::new(info, &scenario.logger)?;
    Ok((Kind { many, recording }, layout))
}
