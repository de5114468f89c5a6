//! Checks files of columns: that each is whole, and that the rows of each run are there once, in their order.

use super::batches::OpenedTable;
use super::files::{about, all_files, runs_in};
use super::here::here;
use super::rows::each_batch;
use crate::layout::ROWS_BEFORE;
use arrow_array::cast::AsArray;
use arrow_array::types::Int64Type;
use homebody_core::problem::counted;
use homebody_log::examine::{Check, CheckOptions, RowNumbers, log_table, truth_tables};
use homebody_log::{LogError, Url};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

pub(crate) fn examine(url: &Url, asked: &CheckOptions) -> Result<Vec<Check>, LogError> {
    let (log, _) = log_table(asked.mapping)?;
    let (_kept, path) = match here(url.path()) {
        Ok(here) => here,
        Err(error @ (LogError::NoPlace(_) | LogError::CannotHold { .. })) => return Err(error),
        Err(error) => return Ok(vec![Check::of_error("store", &error)]),
    };
    let path = path.as_path();
    if !path.exists() {
        return Ok(vec![Check::of_error("files", &LogError::Missing { place: path.display().to_string() })]);
    }
    let seq = &log.columns[0].name;
    let mut checks = Vec::new();
    if !path.is_dir() {
        table("this file", &[path.into()], seq, &mut checks);
        return Ok(checks);
    }
    let truth = truth_tables(|name| path.join(name).is_dir());
    let is_truth = truth.iter().any(|table| path.join(&table.name).is_dir());
    let folders: Vec<(String, PathBuf)> = match is_truth {
        true => truth.iter().map(|table| (format!("{}, ", table.name), path.join(&table.name))).collect(),
        false => vec![(String::new(), path.to_owned())],
    };
    for (name, folder) in folders {
        if !folder.is_dir() {
            let hint = "run it again, or copy the table from the original";
            checks.push(Check::wrong("files", format!("there is no folder {}", folder.display()), hint));
            continue;
        }
        for (run, folder) in runs_in(&folder) {
            match all_files(&folder) {
                Ok((files, on_the_way)) => {
                    table(&format!("{name}{run}"), &files, seq, &mut checks);
                    left(&run, &on_the_way, &mut checks);
                }
                Err(error) => checks.push(Check::of_error("files", &error)),
            }
        }
    }
    Ok(checks)
}

/// Files without their names yet: of a run that is under way, or that was killed.
fn left(run: &str, on_the_way: &[PathBuf], checks: &mut Vec<Check>) {
    let Some(first) = on_the_way.first() else { return };
    let what = counted(on_the_way.len(), "file is", "files are");
    let says = format!("{run}: {what} incomplete, such as {}", first.display());
    checks.push(Check::warning(
        "files",
        says,
        "homebody run --resume FOLDER resumes the run, unless it is running now",
    ));
}

fn table(name: &str, files: &[PathBuf], seq: &str, checks: &mut Vec<Check>) {
    let mut in_order = BTreeMap::new();
    let mut is_whole = true;
    for file in files {
        match read(file, seq) {
            Ok(found) => drop(in_order.insert((found.before, file.clone()), found)),
            Err(error) => {
                is_whole = false;
                let check = Check::of_error("files", &error);
                let hint = "run it again: complete files stay, and others are written again";
                checks.push(Check { hint: check.hint.clone().or_else(|| Some(hint.into())), ..check });
            }
        }
    }
    let rows: u64 = in_order.values().map(|found| found.rows).sum();
    let told =
        format!("{name}: {} in {}", counted(rows as usize, "row", "rows"), counted(files.len(), "file", "files"));
    if is_whole && !files.is_empty() {
        checks.push(Check::ok("files", format!("{told}, and each is complete")));
    } else if files.is_empty() {
        checks.push(Check::warning("files", told, "a run that has just begun has no rows yet"));
    }
    let mut numbers = RowNumbers::default();
    let mut before = 0;
    for ((told, file), found) in &in_order {
        if let Some(told) = told.filter(|told| *told != before && is_whole) {
            let says = format!("{name}: {before} rows come before {}, and it says {told}", file.display());
            checks.push(Check::wrong(
                "files",
                says,
                "a file was removed, changed or copied from elsewhere: run it again",
            ));
            return;
        }
        before += found.rows;
        found.numbers.iter().for_each(|&number| numbers.push(number));
    }
    if numbers.rows() > 0 {
        checks.push(numbers.check(name));
    }
}

struct FileContent {
    rows: u64,
    /// The number of rows of the table before it, if it has one.
    before: Option<u64>,
    numbers: Vec<i64>,
}

fn read(file: &Path, seq: &str) -> Result<FileContent, LogError> {
    let opened = OpenedTable::open(file)?;
    let before = about(&opened, ROWS_BEFORE);
    let place = opened.schema.fields().iter().position(|field| field.name() == seq);
    // All columns are read, so that what is damaged shows.
    let columns: Vec<usize> = (0..opened.schema.fields().len()).collect();
    let mut found = FileContent { rows: 0, before, numbers: Vec::new() };
    each_batch(file, opened, &columns, &mut |rows, arrays| {
        found.rows += rows as u64;
        let numbers = place.and_then(|place| arrays[place].as_primitive_opt::<Int64Type>());
        found.numbers.extend(numbers.into_iter().flat_map(|numbers| numbers.iter().flatten()));
        Ok(())
    })?;
    Ok(found)
}
