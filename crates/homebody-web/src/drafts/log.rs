//! The logger of a draft: the first rows as they would be stored, and a test of the destinations.

use super::{DraftService, problems};
use crate::budget::{SimulationBudget, draft_steps};
use crate::wire::{Connect, ConnectView, Draft, PlaceRowsView, RowsView};
use homebody_core::problem::{Diagnose, Problem};
use homebody_core::scenario::inside::outside_folder;
use homebody_core::scenario::scheme::{self, NoPlace, Scheme};
use homebody_core::time::{DAY, MINUTE, RunTime, Span};
use homebody_log::preview::try_place;
use homebody_log::registry;
use homebody_log::run_log::destinations;
use homebody_log::{LogError, Logger, Url, WriteMode};
use homebody_simulation::{Cancel, OpenScenario, SimulationError};
use std::path::Path;
use std::sync::{Arc, PoisonError};

/// Number of rows that are shown (our choice).
const MOST_ROWS: usize = 40;

/// Longest simulation for the first rows (our choice).
const LONGEST_RUN: Span = DAY.times(3);

/// Longest step (our choice).
const LONGEST_STEP: Span = MINUTE.times(10);

impl DraftService {
    /// The first rows of a draft's log, written into a temporary folder and read back, unless the request is cancelled.
    pub fn rows(&self, draft: Draft, cancel: &Cancel) -> RowsView {
        let kinds = Scheme::of_scenarios().map(|row| (format!("{}:", row.name), row.what.to_owned())).collect();
        let (problems, places, cut) = match self.open(&self.with(draft)) {
            Err(wrong) => (problems(&wrong), Vec::new(), None),
            Ok(opened) => {
                let _one_at_a_time = self.draft_run.lock().unwrap_or_else(PoisonError::into_inner);
                match first_rows(&opened, cancel) {
                    Ok((places, cut)) => (Vec::new(), places, cut),
                    Err(error) => {
                        let file = opened.scenario().file.logger.as_deref().unwrap_or(&self.folders.entry);
                        (problems(&[Problem::of_file(file, error, None)]), Vec::new(), None)
                    }
                }
            }
        };
        RowsView { problems, places, cut, kinds }
    }

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
        // Each run has a new folder, so the test is whether a folder can be created.
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

/// The first rows of each destination, and the reason why later ones are missing.
fn first_rows(opened: &OpenScenario, cancel: &Cancel) -> Result<(Vec<PlaceRowsView>, Option<String>), SimulationError> {
    let scenario = opened.scenario();
    let unmade = |source| LogError::Unmade { place: std::env::temp_dir().display().to_string(), source };
    let folder = tempfile::tempdir().map_err(unmade)?;
    let usual = [String::from(scheme::USUAL)];
    let to = if scenario.logger.to.is_empty() { &usual[..] } else { &scenario.logger.to };
    let urls: Vec<Url> = to.iter().map(|to| to.parse()).collect::<Result<_, NoPlace>>().map_err(LogError::NoPlace)?;
    let hidden = urls.iter().enumerate().map(|(number, url)| url.at(folder.path().join(number.to_string())));
    let hidden: Vec<Url> = hidden.collect();

    let length = scenario.calendar.span_of_days(scenario.file.days).min(LONGEST_RUN);
    let mut run = opened.run().length(length).plan()?.simulation().stepping(draft_steps(LONGEST_STEP));
    let mut logger = Logger::open(
        destinations(&hidden, WriteMode::Create)?,
        &scenario.logger,
        &Arc::new(run.info()),
        WriteMode::Create,
    )?;
    let (mut budget, mut count, mut cut) = (SimulationBudget::new(cancel), 0, None);
    // Some rows come later than their firings: a link delays messages, and sensors hold OFFs.
    while count < 2 * MOST_ROWS && !run.is_over() {
        if let Err(why) = budget.check(0) {
            let clock = scenario.calendar.wall_clock(run.now());
            cut = Some(format!("Rows up to {clock} are shown. {why}"));
            break;
        }
        let stepped = budget.step(&mut run, RunTime::START + length);
        logger.store(&run.events().firings, run.settled())?;
        count += run.events().firings.len();
        // The rows before an error of a driver are shown.
        if stepped.is_err() {
            break;
        }
    }
    logger.finish()?;

    let shown = |(to, url): (&String, &Url)| {
        let first = registry::first_rows(url, &scenario.logger, MOST_ROWS)?;
        Ok(PlaceRowsView { to: to.clone(), table: first.table, columns: first.columns, rows: first.rows })
    };
    let places: Result<Vec<_>, LogError> = to.iter().zip(&hidden).map(shown).collect();
    Ok((places?, cut))
}
