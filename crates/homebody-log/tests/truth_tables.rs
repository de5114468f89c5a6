//! `docs/reference/truth.md` agrees with the tables of the truth.
//!
//! `HOMEBODY_REWRITE=1 cargo test -p homebody-log --test all truth_tables::` writes it anew. That its queries run, and what they
//! answer, is tested with the command.

use crate::generated::is_generated;
use homebody_log::table::truth::tables;
use homebody_log::table::{Column, ColumnKind, Table};

const HEAD: &str = "\
# The truth

This page lists the tables of the ground truth: each resident's position and activities, and the cause of each firing.

A run writes its truth to `truth.db`, an SQLite database in the run's folder. Pass `--truth` to choose another destination: `--truth
csv:truth.csv` writes a file for each table, such as `truth.cause.csv`. The log contains no ground truth. This page is made from the tables
in `crates/homebody-log/src/table/truth.rs`.

- In SQLite, each table begins with the column `run_id`, the same id as in the log's rows.
- The table `run` has one row: its `run_id`, the `home` of a cohort's member, the `scenario`, the `seed`, the times `started_at` and
  `ended_at`, and the `version` of the program.
- Instants have the format of the log, set by `time` in `logger.json`. Sensors have the ids of the log. An empty value is `NULL`.

The rows depend on the scenario:

| table | rows |
|---|---|
| `movement`, `room`, `cause`, `resident`, `home` | in every run |
| `activity` | from a routine or a path |
| `act` | from a routine, from the keyboard, or from an action from outside, which has no resident |
| `need`, `condition` | from a routine |
| `off` | if the log's messages are `on_off` or `occupancy` |
| `lost`, and the causes `duplicate` and `false` | if the scenario has a [link file](link.md), or if an action from outside makes a sensor fail |
| `outside` | if [commands](../how-to/mqtt-and-home-assistant.md) change the home during the run |

A large cohort leaves out `cause`, `off`, `movement` and `lost`, unless you [ask for them](../how-to/simulate-a-cohort.md).

## Join the log and the truth

`cause` has a row for each firing that reached the logger. Its `row` is the `seq` of the log's row with the firing:

- With `fire_only`, each firing has its own row, and each row of the log has a cause.
- With `on_off` and `occupancy`, several firings may share one row: the first causes the ON, and the others prolong it. The *hold* is the
  time that the ON lasts. A row that ends a hold has no cause, but `off` names the last firing of the hold.
- A message that the link lost has no row in the log. It is in `lost` only.

`homebody label` joins a whole log with its truth. You can also join them in SQL. This query, with the table and column names of
`scenarios/tigerplace/logger.json`, covers the first morning. It returns the resident who caused each event, and the activity of this
resident when the cause was first detected.

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

In a log with ON and OFF, such as that of `scenarios/studio/` in SQLite, this query returns the resident whose movement each OFF followed:

```sql
ATTACH 'truth.db' AS truth;
SELECT firing.fired_at, firing.sensor, firing.value, cause.resident, cause.seen_at
FROM firing
JOIN truth.off ON off.run_id = firing.run_id AND off.row = firing.seq
JOIN truth.cause ON cause.run_id = off.run_id AND cause.firing = off.firing
ORDER BY firing.seq;
```

The truth alone gives a resident's hours by activity, and by room:

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

/// Sentences about columns that another page has.
const ELSEWHERE: [(&str, &str, &str); 1] = [("activity", "name", "; the labels are in [activities](activities.md)")];

/// The whole page.
fn document(tables: &[Table]) -> String {
    HEAD.to_owned() + &tables.iter().map(section).collect::<String>()
}

fn section(table: &Table) -> String {
    let Table { name, about, columns, .. } = table;
    let rows: String = columns.iter().map(|column| row(name, column)).collect();
    format!(
        "\n## `{name}`\n\n{}.\n\n| column | type | unit | description |\n|---|---|---|---|\n{rows}",
        sentence(about)
    )
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
fn the_document_describes_the_tables() {
    let text = document(&tables());
    is_generated("docs/reference/truth.md", &text);
    // The control: another column makes another page.
    let mut others = tables();
    others[0].columns.pop();
    assert!(document(&others) != text);
}
