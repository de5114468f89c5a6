//! Compares the entry of each run in a database with its rows.
//!
//! A home of a fleet may have come and gone: then its rows have gaps in their numbers, which look the same as lost rows.

use crate::connection::DatabaseConnection;
use crate::schema::{RUNS, ident, quoted};
use crate::source::columns_of;
use homebody_core::problem::counted;
use homebody_log::LogError;
use homebody_log::examine::{Check, CheckVerdict, found_of};
use homebody_log::table::Table;
use std::collections::BTreeMap;

/// Number of runs without problems above which one line reports them together (our choice).
const MOST_TOLD_ALONE: usize = 10;

struct ExaminedRun {
    run: i64,
    tables: Vec<(String, i64)>,
    is_ended: bool,
    is_of_fleet: bool,
}

pub(crate) fn runs(
    connection: &DatabaseConnection,
    schema: &str,
    tables: &[Table],
    there: &[String],
    run_column: &str,
    checks: &mut Vec<Check>,
) -> Result<(), LogError> {
    let sql = format!(
        "SELECT run_id, tables, rows, ended_at IS NOT NULL, coalesce(home ~ '^home[0-9]{{5}}$', false) FROM {} ORDER BY 1",
        quoted(schema, RUNS)
    );
    let told = connection.wait(connection.client.query(&sql, &[]))?.into_iter().map(|row| {
        let (names, rows): (Vec<String>, Vec<i64>) = (row.get(1), row.get(2));
        ExaminedRun {
            run: row.get(0),
            tables: names.into_iter().zip(rows).collect(),
            is_ended: row.get(3),
            is_of_fleet: row.get(4),
        }
    });
    let told: Vec<ExaminedRun> = told.collect();
    let mut found = RunFindings::default();
    for told in &told {
        rows_of(connection, schema, there, run_column, told, &mut found)?;
    }
    for table in tables.iter().filter(|table| table.is_numbered && there.contains(&table.name)) {
        numbers(connection, schema, table, run_column, &told, &mut found)?;
    }
    found.tell(checks);
    Ok(())
}

#[derive(Default)]
struct RunFindings {
    not_well: Vec<Check>,
    well: BTreeMap<&'static str, Vec<(Check, i64)>>,
    /// The number of homes of a fleet that lack row numbers, and of the numbers.
    lacking: (usize, i64),
}

impl RunFindings {
    fn well(&mut self, about: &'static str, says: String, rows: i64) {
        self.well.entry(about).or_default().push((Check::ok(about, says), rows));
    }

    fn lacks(&mut self, numbers: i64) {
        self.lacking = (self.lacking.0 + 1, self.lacking.1 + numbers);
    }

    fn tell(self, checks: &mut Vec<Check>) {
        for (about, well) in self.well.into_iter().rev() {
            if well.len() <= MOST_TOLD_ALONE {
                checks.extend(well.into_iter().map(|(check, _)| check));
                continue;
            }
            let rows: i64 = well.iter().map(|(_, rows)| rows).sum();
            let how =
                if about == "runs" { "as many as homebody_run says" } else { "numbered from 0 without a gap in each" };
            checks.push(Check::ok(about, format!("{} runs: {rows} rows, {how}", well.len())));
        }
        if self.lacking.0 > 0 {
            let homes = counted(self.lacking.0, "home of a fleet lacks", "homes of a fleet lack");
            let says = format!("{homes} the rows of {} numbers", self.lacking.1);
            let hint = "with --churn homes send nothing while they are offline, and all is well; otherwise rows were removed: run the fleet again with --replace-rows";
            checks.push(Check::warning("rows", says, hint));
        }
        checks.extend(self.not_well);
    }
}

fn rows_of(
    connection: &DatabaseConnection,
    schema: &str,
    there: &[String],
    run_column: &str,
    told: &ExaminedRun,
    found: &mut RunFindings,
) -> Result<(), LogError> {
    let run = told.run;
    if !told.is_ended {
        let hint = "homebody run --resume FOLDER resumes it, unless it is running now";
        found.not_well.push(Check::warning("runs", format!("run {run} is not complete"), hint));
    }
    let before = found.not_well.len();
    let mut rows = 0;
    for (name, told_rows) in &told.tables {
        // A table that another mapping has named is not among those that are wanted.
        let column = match there.contains(name) {
            true => run_column.to_owned(),
            false => match columns_of(connection, schema, name)?.into_iter().next() {
                Some((column, _)) => column,
                None => {
                    let says = format!("run {run}: its table {name:?} is gone");
                    found.not_well.push(Check::wrong("runs", says, "run it again with --replace-rows"));
                    continue;
                }
            },
        };
        let there_are = count(connection, schema, name, &column, run)?;
        rows += there_are;
        // A home of a fleet lacks rows where its numbers have gaps.
        if there_are > *told_rows || there_are < *told_rows && !told.is_of_fleet {
            let says = format!("run {run}: {name:?} has {there_are} rows, and {RUNS:?} says {told_rows}");
            let hint = "rows were added or removed by hand: run it again with --replace-rows";
            found.not_well.push(Check::wrong("runs", says, hint));
        }
    }
    let told_rows: i64 = told.tables.iter().map(|(_, rows)| rows).sum();
    if found.not_well.len() == before && told_rows == rows {
        let tables = counted(told.tables.len(), "table", "tables");
        found.well("runs", format!("run {run}: {rows} rows in {tables}, as many as {RUNS:?} says"), rows);
    }
    Ok(())
}

fn count(
    connection: &DatabaseConnection,
    schema: &str,
    table: &str,
    run_column: &str,
    run: i64,
) -> Result<i64, LogError> {
    let sql = format!("SELECT count(*) FROM {} WHERE {} = $1", quoted(schema, table), ident(run_column));
    Ok(connection.wait(connection.client.query_one(&sql, &[&run]))?.get(0))
}

fn numbers(
    connection: &DatabaseConnection,
    schema: &str,
    table: &Table,
    run_column: &str,
    told: &[ExaminedRun],
    found: &mut RunFindings,
) -> Result<(), LogError> {
    let (run, seq, name) = (ident(run_column), ident(&table.columns[0].name), quoted(schema, &table.name));
    let sql = format!(
        "SELECT {run}::bigint, count(*), count(DISTINCT {seq}), coalesce(max({seq}), -1)::bigint, \
         (SELECT number FROM (SELECT {seq} AS number, lead({seq}) OVER (ORDER BY {seq}) AS next FROM {name} AS other \
          WHERE other.{run} = one.{run}) AS pairs WHERE next > number + 1 ORDER BY 1 LIMIT 1)::bigint, min({seq})::bigint \
         FROM {name} AS one GROUP BY {run} ORDER BY 1"
    );
    for row in connection.wait(connection.client.query(&sql, &[]))? {
        let (id, rows, distinct, last): (i64, i64, i64, i64) = (row.get(0), row.get(1), row.get(2), row.get(3));
        let (before_gap, first): (Option<i64>, Option<i64>) = (row.get(4), row.get(5));
        let missing = last.saturating_add(1).saturating_sub(distinct).max(0);
        let first_missing = match first {
            Some(1..) => Some(0),
            _ => before_gap.map(|number| number + 1),
        };
        let known = told.iter().find(|told| told.run == id);
        let check = found_of(&format!("run {id}"), rows, (missing, first_missing), (rows - distinct, None));
        match check.verdict {
            CheckVerdict::Ok => found.well("rows", check.says, rows),
            _ if known.is_some_and(|told| told.is_of_fleet) && rows == distinct => found.lacks(missing),
            _ => found.not_well.push(check),
        }
        if known.is_none() {
            let says = format!("there are rows of run {id}, and {RUNS:?} has no such run");
            let hint = "another program wrote them, or the run was removed by hand: remove its rows, too";
            found.not_well.push(Check::wrong("runs", says, hint));
        }
    }
    Ok(())
}
