//! Truths: activities of residents, causes of firings, movements of bodies.

use super::{database, log, messages};
use crate::choices::Choices;
use crate::target::{CaseFiles, ReadVerdict, Target};
use homebody_core::calendar::Calendar;
use homebody_core::time::{DAY, HOUR, Interval, RunTime, TimeScale};
use homebody_log::{LogError, Movements, Url, read_timeline, truth_at};
use std::fs;
use std::path::Path;

pub const TARGET: Target = Target { name: "truth", cases: 1_000, seeds, mutate, run };

const LOG: &str = "seq,time,sensor,value\n\
                   0,2009-03-02 07:12:03.000000,bed motion,ON\n\
                   1,2009-03-02 07:12:05.500000,hall motion,ON\n\
                   2,2009-03-02 07:12:09.250000,bed motion,OFF\n";

fn seeds() -> Vec<CaseFiles> {
    let mut seeds = database::scripts(TARGET.name, log::TRUTH);
    seeds.iter_mut().for_each(|files| drop(files.insert(log::FILE.to_owned(), LOG.as_bytes().to_vec())));
    seeds
}

fn mutate(files: &mut CaseFiles, _: &[CaseFiles], choices: &mut Choices) {
    database::remade(files, log::TRUTH, choices);
}

fn run(files: &CaseFiles, folder: &Path) -> Result<ReadVerdict, String> {
    let path = folder.join(log::TRUTH);
    fs::write(&path, files.get(log::TRUTH).map(Vec::as_slice).unwrap_or_default())
        .map_err(|error| error.to_string())?;
    let (url, scale) = (truth_at(&path.to_string_lossy()), TimeScale::one());
    let read = [read_timeline(&url, &scale).map(drop), movements(&url)];
    for error in read.iter().filter_map(|told| told.as_ref().err()) {
        messages::refusal(&error)?;
    }
    log::read_and_analyse(files, folder)?;
    Ok(if read.iter().all(Result::is_ok) { ReadVerdict::Accepted } else { ReadVerdict::Refused })
}

fn movements(truth: &Url) -> Result<(), LogError> {
    let calendar = Calendar::new("2009-03-02T00:00:00", "America/Chicago").expect("a date and a zone that there are");
    let residents = ["Margaret".to_owned(), "a".to_owned()];
    let mut movements = Movements::open(truth, &residents, calendar.scale(DAY))?;
    let (start, day) = (RunTime::START, RunTime::START + DAY);
    let (seven, eight) = (start + 7 * HOUR, start + 8 * HOUR);
    for (begin, end) in [(start, day), (seven, eight), (day, start), (start - DAY, RunTime::MAX)] {
        movements.of(Interval::new(begin, end))?;
    }
    Ok(())
}
