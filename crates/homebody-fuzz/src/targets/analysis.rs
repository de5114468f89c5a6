//! All uses of a readable log, whatever its form.

use super::messages;
use crate::target::ReadVerdict;
use homebody_analysis::compare::compare;
use homebody_analysis::dates;
use homebody_analysis::day::DayRecord;
use homebody_analysis::density::density;
use homebody_analysis::look::Looker;
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::scenario::scheme::Scheme;
use homebody_core::time::TimeScale;
use homebody_log::{Log, LogSource, Transfer, WriteMode, convert, label, read, read_timeline, survey, truth_at};
use homebody_picture::{DayChart, day_chart, density_map, look_page, png};
use homebody_query::LoadedLog;
use homebody_simulation::Url;
use std::path::Path;

/// A time zone whose clock is set twice a year.
const ZONE: &str = "America/Chicago";

/// Converts, compares, maps and draws a log, and labels it by a truth.
pub fn all(from: &LogSource, mapping: &LoggerFile, truth: &Path, folder: &Path) -> Result<ReadVerdict, String> {
    let survey = match survey(from, mapping) {
        Ok(survey) => survey,
        Err(error) => {
            messages::refusal(&error)?;
            if read(from, mapping).is_ok() {
                return Err("what cannot be surveyed can be read".into());
            }
            return Ok(ReadVerdict::Refused);
        }
    };
    let mut log = read(from, mapping).map_err(|error| format!("what can be surveyed cannot be read: {error}"))?;
    if log.events.len() as u64 != survey.rows || log.rows != survey.rows {
        return Err(format!("{} rows are surveyed, {} are read", survey.rows, log.events.len()));
    }
    for scheme in [Scheme::Csv, Scheme::Sqlite, Scheme::Casas] {
        carried(from, mapping, &survey, &log, scheme, folder)?;
    }
    labelled(from, mapping, &survey, truth, folder)?;
    let scale = TimeScale::one();
    match read_timeline(&truth_at(&truth.to_string_lossy()), &scale) {
        Ok(known) => log.activities = known.map(|at| scale.run_to_wall(at)).into_activities(),
        Err(error) => messages::refusal(&error)?,
    }
    let _ = compare(&log, &log).to_string();
    let mut looker = Looker::new(None);
    looker.take(&log);
    let look = looker.look("a log", from.form().name, &survey, &|_| None, None);
    drop((look.to_string(), look_page(&look, None)));
    if look.rows != survey.rows || look.sensors.iter().map(|sensor| sensor.rows).sum::<u64>() != survey.rows {
        return Err(format!("{} rows are looked at, {} are surveyed", look.rows, survey.rows));
    }
    // In the wall time of a home, as the commands for days and density read it.
    match LoadedLog::read(&from.to_string(), Some(ZONE)) {
        Ok(given) => drawn(&given)?,
        Err(error) => messages::refusal(&error)?,
    }
    Ok(ReadVerdict::Accepted)
}

/// Converts a log into another form and back: rows keep their number and instants.
fn carried(
    from: &LogSource,
    mapping: &LoggerFile,
    survey: &Log,
    log: &Log,
    scheme: Scheme,
    folder: &Path,
) -> Result<(), String> {
    let to = Url::new(scheme, folder.join(format!("carried.{}", scheme.row().name)));
    let transfer = Transfer { from, mapping, to: &to, name: "a log", zone: ZONE, how: WriteMode::Create };
    let rows = match convert(&transfer, survey, |_| ()) {
        Ok(rows) => rows,
        // The form cannot distinguish two sensors.
        Err(error) => return messages::refusal(&error),
    };
    if rows != survey.rows {
        return Err(format!("{rows} rows of {} came into {}", survey.rows, scheme.row().name));
    }
    if rows == 0 {
        return Ok(());
    }
    let again = read(&to, &LoggerFile::default()).map_err(|error| format!("what was converted is refused: {error}"))?;
    if again.rows != rows {
        let name = scheme.row().name;
        return Err(format!(
            "of {rows} rows converted to {name}, {} are read: {:?}",
            again.rows,
            again.problems.first()
        ));
    }
    // The form of CASAS has local time only.
    let is_same =
        scheme == Scheme::Casas || again.events.iter().zip(&log.events).all(|(one, other)| one.at == other.at);
    if is_same { Ok(()) } else { Err(format!("instants differ in {}", scheme.row().name)) }
}

fn labelled(from: &LogSource, mapping: &LoggerFile, survey: &Log, truth: &Path, folder: &Path) -> Result<(), String> {
    let to = Url::new(Scheme::Csv, folder.join("labelled.csv"));
    let transfer = Transfer { from, mapping, to: &to, name: "a log", zone: ZONE, how: WriteMode::Create };
    match label(&transfer, survey, &truth_at(&truth.to_string_lossy()), &TimeScale::one(), |_| ()) {
        Ok(labelled) if labelled.rows != survey.rows => Err(format!("{} rows of {}", labelled.rows, survey.rows)),
        Ok(_) => Ok(()),
        Err(error) => messages::refusal(&error),
    }
}

fn drawn(given: &LoadedLog) -> Result<(), String> {
    if let Some((first, last)) = given.dates() {
        for date in [first, last] {
            let day = DayRecord::from_log(&given.name, &given.log, &given.timeline.people, given.ended(), date);
            let _ = day.to_string();
            let svg = day_chart(&DayChart::new(&day));
            // Rasterising takes time, so only some days are drawn.
            if svg.len().is_multiple_of(32)
                && let Err(error) = png(&svg, 400)
            {
                messages::refusal(&error)?;
            }
        }
        let _ = dates::DayChoice::First.within((first, last));
    }
    let asked = given.density_asked();
    match density((&given.name, &given.log, &asked), Some((&given.name, &given.log, &asked))) {
        Ok(density) => drop((density.to_string(), density_map(&density), density.of.map.csv())),
        Err(why) => messages::refusal(&why)?,
    }
    Ok(())
}
