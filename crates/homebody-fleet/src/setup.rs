//! The setup of a fleet: it makes all homes.

use crate::churn::{Churn, HomePresence};
use crate::error::FleetError;
use crate::outages::Outages;
use homebody_core::problem::Problems;
use homebody_core::random::Stream;
use homebody_core::recording::Recording;
use homebody_core::run::Run;
use homebody_core::time::{LONGEST, RunTime, Span, UtcTime};
use homebody_log::RunInfo;
use homebody_log::fleet::{Fleet, FleetHome, FleetLayout, HomeRows};
use homebody_routine::household::ManyRuns;
use homebody_simulation::pace::Speed;
use homebody_simulation::{OpenScenario, PlannedRun, RunLength, RunOptions, VariantOptions, seed_of_member};
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
            /// The difference asked for.
            skew_us: Span,
        } error "skew" ("clocks cannot differ by {skew_us} microseconds")
            hint ("choose 0 or more");
    }
}

/// Largest number of homes of a fleet (our choice): their numbers have five digits.
pub const MOST_HOMES: u32 = 99_999;

/// The options of a fleet. The run of a home depends on its number, the seed and the scenarios, and on no other option.
pub struct FleetSetup {
    /// The scenarios, which the homes use in rotation: home 1 has the first. All have the start of the fleet.
    pub scenarios: Vec<OpenScenario>,
    pub homes: u32,
    /// The number of the first home: 1, unless other programs simulate earlier ones.
    pub first: u32,
    /// The options of each home. The default seed is that of the first scenario.
    pub variant: VariantOptions,
    /// The speed from the start of the scenarios on; `None` for real time.
    pub speed: Option<f64>,
    pub skew: Span,
    /// The times of homes online and offline; `None` for homes that stay online.
    pub churn: Option<Churn>,
    pub outages: Option<Outages>,
}

pub struct FleetHomes {
    pub fleet: Arc<Fleet>,
    pub(super) homes: Vec<UnstartedHome>,
    pub(super) speed: Option<f64>,
    pub(super) outages: Option<Outages>,
    /// The start of the runs of each layout.
    pub(super) starts: Vec<UtcTime>,
}

pub(super) struct UnstartedHome {
    pub run: Run,
    pub rows: HomeRows,
    pub presence: Option<HomePresence>,
    pub skew: Span,
}

/// The shared part of the homes of a scenario.
struct HomeKind {
    many: ManyRuns,
    recording: Recording,
}

impl FleetSetup {
    /// Makes all homes, on all processors; `made` gets the number of homes so far.
    ///
    /// # Errors
    ///
    /// [`FleetError::Setup`] if the number of homes, the speed or the skew is out of range; [`FleetError::Simulation`] if no routine shows a condition
    /// that is to be left out; [`FleetError::Simulation`] if a logger's names cannot be used.
    pub fn make(self, made: impl Fn(usize) + Sync) -> Result<FleetHomes, FleetError> {
        self.check()?;
        let seed = self.variant.seed.unwrap_or(self.scenarios[0].scenario().file.seed);
        let variant = VariantOptions { seed: Some(seed), ..self.variant };
        let (mut kinds, mut layouts) = (Vec::new(), Vec::new());
        for opened in &self.scenarios {
            let (kind, layout) = home_kind(opened, &variant)?;
            kinds.push(kind);
            layouts.push(layout);
        }
        let start = |opened: &OpenScenario| opened.scenario().calendar.timestamp(RunTime::START).into();
        let starts = self.scenarios.iter().map(start).collect();
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
            let unstarted = UnstartedHome {
                run: kinds[home.layout].many.run(home.seed, LONGEST),
                rows: layouts[home.layout].rows(home.seed),
                presence: self.churn.map(|churn| HomePresence::new(churn, home.seed)),
                skew: skew_of(home.seed, self.skew),
            };
            made(so_far.fetch_add(1, Ordering::Relaxed) + 1);
            unstarted
        };
        let made = homes.par_iter().map(make).collect();
        let fleet = Arc::new(Fleet { first: self.first, layouts, homes });
        Ok(FleetHomes { fleet, homes: made, speed: self.speed, outages: self.outages, starts })
    }

    fn check(&self) -> Result<(), FleetError> {
        let mut wrong = Vec::new();
        let last = u64::from(self.first) + u64::from(self.homes) - 1;
        if self.scenarios.is_empty() || self.homes == 0 || self.first == 0 || last > u64::from(MOST_HOMES) {
            wrong.push(FleetMessage::Homes { homes: self.homes, first: self.first }.into());
        }
        if let Some(speed) = self.speed.filter(|speed| Speed::times(*speed).is_none()) {
            wrong.push(FleetMessage::Speed { speed }.into());
        }
        if self.skew < Span::ZERO {
            wrong.push(FleetMessage::Skew { skew_us: self.skew }.into());
        }
        if wrong.is_empty() { Ok(()) } else { Err(FleetError::Setup(Problems(wrong))) }
    }
}

impl FleetHomes {
    /// The lead of the clock of a home.
    pub fn skew(&self, home: u32) -> Span {
        self.homes[home as usize].skew
    }

    pub fn is_there(&self, home: u32) -> bool {
        self.homes[home as usize].presence.as_ref().is_none_or(HomePresence::is_there)
    }
}

/// The lead of the clock of a home, by its seed: uniform from `-most` to `most`.
fn skew_of(seed: u64, most: Span) -> Span {
    let most = most.micros() as f64;
    Span::from_micros(Stream::named(seed, "fleet/clock").between(-most, most).round() as i64)
}

fn home_kind(opened: &OpenScenario, variant: &VariantOptions) -> Result<(HomeKind, FleetLayout), FleetError> {
    let (length, variant) = (Some(RunLength::Span(LONGEST)), variant.clone());
    let options = RunOptions { length, variant, one_of_many: true, ..RunOptions::default() };
    let PlannedRun { scenario, household, recording } = options.setup(opened)?.plan()?;
    let (scenario, many) = (scenario.scenario(), ManyRuns::new(household));
    let info = RunInfo::of(scenario, &many.run(recording.seed, LONGEST), &recording);
    let layout = FleetLayout::new(info, &scenario.logger)?;
    Ok((HomeKind { many, recording }, layout))
}
