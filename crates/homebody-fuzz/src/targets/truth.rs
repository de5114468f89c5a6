//! Truths: what residents did, why sensors spoke, how bodies moved.

use super::{database, log, told};
use crate::dice::Dice;
use crate::target::{Files, Target, Verdict};
use homebody_core::scenario::calendar::Calendar;
use homebody_core::time::{DAY, SECOND};
use homebody_log::source::{Clock, RunClock, truth_at};
use homebody_log::{LogError, Movements, Url, activities, lives};
use std::fs;
use std::path::Path;

pub const TARGET: Target =
    Target { name: "truth", about: "truth databases: lives, movements, labels", cases: 1_000, corpus, mutate, run };

/// A log of which such a truth may tell.
const LOG: &str = "seq,time,sensor,value\n\
                   0,2009-03-02 07:12:03.000000,bed motion,ON\n\
                   1,2009-03-02 07:12:05.500000,hall motion,ON\n\
                   2,2009-03-02 07:12:09.250000,bed motion,OFF\n";

fn corpus() -> Vec<Files> {
    let mut corpus = database::scripts(TARGET.name, log::TRUTH);
    corpus.iter_mut().for_each(|files| drop(files.insert(log::FILE.to_owned(), LOG.as_bytes().to_vec())));
    corpus
}

fn mutate(files: &mut Files, _: &[Files], dice: &mut Dice) {
    database::remade(files, log::TRUTH, dice);
}

fn run(files: &Files, folder: &Path) -> Result<Verdict, String> {
    let path = folder.join(log::TRUTH);
    fs::write(&path, files.get(log::TRUTH).map(Vec::as_slice).unwrap_or_default())
        .map_err(|error| error.to_string())?;
    let (url, as_told) = (truth_at(&path.to_string_lossy()), RunClock::as_told());
    let told = [activities(&url, &as_told).map(drop), lives(&url, &as_told).map(drop), movements(&url)];
    for error in told.iter().filter_map(|told| told.as_ref().err()) {
        told::message(&error.to_string())?;
    }
    log::read_and_analyse(files, folder)?;
    Ok(if told.iter().all(Result::is_ok) { Verdict::Accepted } else { Verdict::Refused })
}

fn movements(truth: &Url) -> Result<(), LogError> {
    let calendar = Calendar::new("2009-03-02T00:00:00", "America/Chicago").expect("a date and a zone that there are");
    let clock = RunClock::new(&calendar, DAY, Clock::Local);
    let residents = ["Margaret".to_owned(), "a".to_owned()];
    let mut movements = Movements::open(truth, &residents, clock)?;
    for span in [(0, DAY), (7 * 3600 * SECOND, 8 * 3600 * SECOND), (DAY, 0), (-DAY, i64::MAX)] {
        movements.of(span.0, span.1)?;
    }
    Ok(())
}
