//! `docs/reference/truth.md` is what the tables of the truth say.
//!
//! `HOMEBODY_REWRITE=1 cargo test -p homebody-log --test truth_tables` writes it anew. That its queries run, and what they
//! answer, is tested with the command.

#[path = "../../../tests/generated.rs"]
mod generated;

use generated::is_generated;
use homebody_log::table::{Column, ColumnKind, Table};
use homebody_log::truth::tables;

const HEAD: &str = "\
# The truth

What was so in a run, beside what its sensors said: where everybody was, what they did, and why each sensor fired. It is in
`truth.db`, an SQLite database in the run's folder, or where `--truth` says; `--truth csv:truth.csv` is a file for each table, such as
`truth.cause.csv`. No log ever holds any of it. This page is made from the tables in `crates/homebody-log/src/truth/tables.rs`.

In SQLite each table has the column `run_id` before its own, which is that of the log's rows, and a table `run` has a row for the
run: its `run_id`, the `home` of a cohort's member, the `scenario`, the `seed`, when it `started_at` and `ended_at`, and the `version`
of the program. Instants are written as the log has them, by `time` in `logger.json`; sensors have the ids of the log. Empty is
`NULL`.

How much there is depends on the scenario. Movement, rooms and causes are always told. Activities come of a routine or of a
path, acts of a routine or of held keys, needs and conditions of a routine alone. `off` has rows only where the log's messages are `on_off` or
`occupancy`; `lost`, and the causes `duplicate` and `false`, only where the scenario has a link file (`docs/reference/link.md`), or a sensor has failed from
outside. `outside` has rows only where somebody has given orders while the run was lived (`docs/how-to/mqtt-and-home-assistant.md`); an act of theirs has no resident.
Of a large cohort, `cause`, `off`, `movement` and `lost` are left out unless they are asked for (`docs/how-to/simulate-a-cohort.md`).

## Log and truth together

`cause` has a row for each firing that reached the logger. Its `row` is the `seq` of the log's row that tells of it:

- With `fire_only` each firing is a row of its own, and each row of the log has its cause.
- With `on_off` and `occupancy` several firings may share a row, the ON that they prolonged. A row that says that a hold is over has
  no cause: `off` says which firing was the last that was held.
- Of what a link lost, the log has no row: it is in `lost` alone.

`homebody label` does the join for a whole log. In SQL, with the names that `scenarios/tigerplace/logger.json` gives the log's table and
columns, this is the first morning: who made which sensor speak, and what they were doing when that began to be noticed.

```sql
ATTACH 'truth.db' AS truth;
SELECT event.ts_local, event.sensor_id, event.event_code, cause.resident, cause.why, activity.name
FROM event
JOIN truth.cause ON cause.run_id = event.run_id AND cause.row = event.seq
LEFT JOIN truth.activity ON activity.run_id = cause.run_id AND activity.resident = cause.resident
  AND activity.begin_at <= cause.seen_at AND cause.seen_at < activity.end_at
WHERE event.ts_local < '2009-03-02 12:00'
ORDER BY event.seq;
```

In a log with ON and OFF, such as that of `scenarios/studio/` in SQLite, this is whose movement each OFF followed:

```sql
ATTACH 'truth.db' AS truth;
SELECT firing.fired_at, firing.sensor, firing.value, cause.resident, cause.seen_at
FROM firing
JOIN truth.off ON off.run_id = firing.run_id AND off.row = firing.seq
JOIN truth.cause ON cause.run_id = off.run_id AND cause.firing = off.firing
ORDER BY firing.seq;
```

The truth alone says how somebody's hours were spent, and in which rooms:

```sql
SELECT name, count(*) AS times, round(sum(julianday(end_at) - julianday(begin_at)) * 24, 1) AS hours
FROM activity
WHERE resident = 'margaret'
GROUP BY name
ORDER BY hours DESC;
```

```sql
SELECT room, round(sum(julianday(until) - julianday(at)) * 24, 1) AS hours
FROM (
  SELECT room, at, lead(at, 1, ended_at) OVER (PARTITION BY resident ORDER BY at) AS until
  FROM room JOIN run USING (run_id)
  WHERE resident = 'margaret'
)
GROUP BY room
ORDER BY hours DESC;
```
";

/// What a column's sentence leaves to another page.
const ELSEWHERE: [(&str, &str, &str); 1] = [("activity", "name", "; the labels are in [activities](activities.md)")];

/// The whole page.
fn document(tables: &[Table]) -> String {
    HEAD.to_owned() + &tables.iter().map(section).collect::<String>()
}

fn section(table: &Table) -> String {
    let Table { name, about, columns, .. } = table;
    let rows: String = columns.iter().map(|column| row(name, column)).collect();
    format!("\n## `{name}`\n\n{}.\n\n| column | type | unit | what it is |\n|---|---|---|---|\n{rows}", sentence(about))
}

fn row(table: &str, column: &Column) -> String {
    let Column { name, kind, unit, about } = column;
    let kind = match kind {
        ColumnKind::Instant => "instant",
        ColumnKind::Integer => "whole number",
        ColumnKind::Real => "number",
        ColumnKind::Text => "text",
    };
    let unit = if unit.is_empty() { " ".to_owned() } else { format!(" {unit} ") };
    let elsewhere =
        ELSEWHERE.iter().find(|(of, column, _)| (*of, *column) == (table, name)).map_or("", |(.., more)| more);
    format!("| `{name}` | {kind} |{unit}| {about}{elsewhere} |\n")
}

/// Words as the beginning of a sentence.
fn sentence(words: &str) -> String {
    let mut letters = words.chars();
    letters.next().map(|first| first.to_uppercase().chain(letters).collect()).unwrap_or_default()
}

#[test]
fn the_document_is_what_the_tables_say() {
    let text = document(&tables());
    is_generated("docs/reference/truth.md", &text);
    // The control: another column makes another page.
    let mut others = tables();
    others[0].columns.pop();
    assert!(document(&others) != text);
}
