//! A logger's file that is being written: its first rows, as they would be stored, and whether its places take a log.

use super::{DraftService, problems};
use crate::budget::SimulationBudget;
use crate::wire::{Connect, ConnectView, Draft, PlaceRowsView, RowsView};
use homebody_core::event::Events;
use homebody_core::problem::{Diagnose, Problem};
use homebody_core::recording::Recording;
use homebody_core::run::Run;
use homebody_core::scenario::inside::outside_folder;
use homebody_core::scenario::load::Scenario;
use homebody_core::scenario::scheme::{self, NoPlace, Scheme};
use homebody_core::time::{DAY, MINUTE, RunTime, Span};
use homebody_log::preview::{preview, try_place};
use homebody_log::run_log::destinations;
use homebody_log::{LogError, Logger, RunInfo, Url, WriteMode};
use homebody_routine::household::Household;
use homebody_simulation::Cancel;
use std::path::Path;
use std::sync::{Arc, PoisonError};

/// Number of rows that are shown (our choice).
const MOST_ROWS: usize = 40;

/// Time of simulation after which a home without rows has none to show (our choice).
const LONGEST_LIVED: Span = DAY.times(3);

/// Longest stretch that is simulated at once (our choice).
const LONGEST_STRETCH: Span = MINUTE.times(10);

impl DraftService {
    /// The first rows of a draft's log, written where nobody else looks and read back, for as long as somebody waits for them.
    pub fn rows(&self, draft: Draft, cancel: &Cancel) -> RowsView {
        let kinds = Scheme::of_scenarios().map(|row| (format!("{}:", row.name), row.what.to_owned())).collect();
        let (problems, places, cut) = match self.load(&self.with(draft), &[]) {
            Err(wrong) => (problems(&wrong), Vec::new(), None),
            Ok((scenario, household)) => {
                let _simulating = self.simulated.lock().unwrap_or_else(PoisonError::into_inner);
                match first_rows(&scenario, &household, cancel) {
                    Ok((places, cut)) => (Vec::new(), places, cut),
                    Err(error) => {
                        let file = scenario.file.logger.as_deref().unwrap_or(&self.folders.entry);
                        (problems(&[Problem::of_file(file, error, None)]), Vec::new(), None)
                    }
                }
            }
        };
        RowsView { problems, places, cut, kinds }
    }

    /// Whether a log can be begun at a place.
    pub fn connect(&self, Connect { url }: Connect) -> ConnectView {
        let tried = url.parse().map_err(LogError::NoPlace).and_then(|url: Url| self.try_url(&url));
        match tried {
            Ok(said) => ConnectView { works: true, said, code: None },
            Err(error) => {
                let code = error.diagnostic().code;
                let code = (!code.is_empty()).then(|| code.to_owned());
                ConnectView { works: false, said: error.to_string(), code }
            }
        }
    }

    fn try_url(&self, url: &Url) -> Result<String, LogError> {
        let Some(file) = url.file() else { return try_place(url).map(|()| format!("Homebody can write to {url}.")) };
        if let Some(outside) = outside_folder(&file.to_string_lossy(), "the run's folder") {
            let what = outside.diagnostic().what;
            return Err(LogError::NoPlace(NoPlace { what, hint: "name a file in that folder".into() }));
        }
        // Each run has a folder of its own; what matters is whether it can be made.
        let there = self.folders.runs.ancestors().find(|folder| folder.is_dir() || folder.as_os_str().is_empty());
        let base = there.filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        try_place(&url.at(base.join(format!(".homebody-{}", std::process::id()))))?;
        let folder = self.folders.runs.display();
        Ok(format!(
            "Each run writes its own {} into a new folder in {folder}. Homebody can write there.",
            file.display()
        ))
    }
}

/// The rows of each place, and why there may be more that are not looked for.
fn first_rows(
    scenario: &Scenario,
    household: &Household,
    cancel: &Cancel,
) -> Result<(Vec<PlaceRowsView>, Option<String>), LogError> {
    let unmade = |source| LogError::Unmade { place: std::env::temp_dir().display().to_string(), source };
    let folder = tempfile::tempdir().map_err(unmade)?;
    let usual = [String::from(scheme::USUAL)];
    let to = if scenario.logger.to.is_empty() { &usual[..] } else { &scenario.logger.to };
    let urls: Vec<Url> = to.iter().map(|to| to.parse()).collect::<Result<_, NoPlace>>()?;
    let hidden = urls.iter().enumerate().map(|(number, url)| url.at(folder.path().join(number.to_string())));
    let hidden: Vec<Url> = hidden.collect();

    let seed = scenario.file.seed;
    let length = scenario.calendar.span_of_days(scenario.file.days).min(LONGEST_LIVED);
    let mut run = Run::new(scenario, household, seed, length);
    let recording = Recording::new(scenario, homebody_simulation::VERSION, "", seed, length);
    let info = Arc::new(RunInfo::of(scenario, &run, &recording));
    let mut logger =
        Logger::open(destinations(&hidden, WriteMode::Create)?, &scenario.logger, &info, WriteMode::Create)?;
    let (mut events, mut count, mut cut) = (Events::default(), 0, None);
    let mut budget = SimulationBudget::new(cancel, LONGEST_STRETCH);
    let end = RunTime::START + length;
    // Of messages that a link delays, and of OFFs that are held, some rows come later than their firings.
    while count < 2 * MOST_ROWS && run.now() < end {
        if let Err(why) = budget.check(0) {
            let clock = scenario.calendar.wall_clock(run.now());
            cut = Some(format!("Rows up to {clock} are shown. {why}"));
            break;
        }
        let lived = budget.advance(&mut run, end, &mut events);
        logger.store(&events.firings, run.settled())?;
        count += events.firings.len();
        events.clear();
        // What came before it stopped is shown.
        if lived.is_err() {
            break;
        }
    }
    logger.finish()?;

    let shown = |(to, url): (&String, &Url)| {
        let first = preview(url, &scenario.logger, MOST_ROWS)?;
        Ok(PlaceRowsView { to: to.clone(), table: first.table, columns: first.columns, rows: first.rows })
    };
    let places: Result<Vec<_>, LogError> = to.iter().zip(&hidden).map(shown).collect();
    Ok((places?, cut))
}
