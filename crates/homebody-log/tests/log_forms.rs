//! `docs/reference/logs.md` agrees with the table of forms.
//!
//! `HOMEBODY_REWRITE=1 cargo test -p homebody-log --test all log_forms::` writes it again. The forms themselves are tested in
//! `crates/homebody-log/tests/recorded.rs`.

use crate::generated::is_generated;
use homebody_log::registry::FORMS;

const HEAD: &str = "\
# Logs that Homebody reads

This page lists the forms of logs that Homebody reads, explains how it reads them, and describes the text files that it writes.

A command that takes a log accepts the folder of a run, a file, or the folder of a data set with one log in it. Homebody recognises
the form of a file by its first lines. To name the form yourself, write it in front of the file: `casas:home.txt`. The table of forms
comes from `crates/homebody-log/src/registry.rs`.

```sh
homebody inspect kasteren
homebody inspect week.csv --png week.png
homebody convert mit:activities_data.csv --out csv:mit.csv
```

## Forms

";

const TAIL: &str = "
If Homebody is built with the feature `parquet`, it also reads `parquet` (files, and folders of files by run and day) and `arrow` (files of
Arrow IPC): see [Parquet and Arrow](../how-to/parquet.md). A text file may be compressed with gzip or, with that feature, with Zstandard.
Homebody recognises the compression by the first bytes and unpacks while it reads. It refuses a compressed file that is truncated or
damaged.

Homebody reads a log of any size in little memory. It opens databases read-only, except one that an interrupted run of Homebody left
in the middle of a transaction. It writes parts of a log only to the places that the command names.

## Rows and lines

Each row has a timestamp, a sensor and a value.

| case | Homebody |
|---|---|
| a line that it cannot parse | leaves the line out and reports its number and the reason; it lists the first hundred, counts all, and loses no other line |
| local time or UTC | takes the clock of most of the first rows, and reports rows on the other clock |
| fractions of seconds | accepts any length |
| a line or value longer than the [limits](limits.md) | refuses the log |
| an interval (start and end) | makes an ON and an OFF, and sorts up to a million rows by time; it reports an interval that ends before it begins |
| a table with a row for each second | makes a row for each change only. A pause of more than a minute is a gap: all states and activities end with the last row before it |
| ARAS, which has no dates | day n becomes day n of 1970 |

Homebody accepts a form only on evidence. For example, a text has the form `casas` if its first lines repeat a small number of names, with
states such as ON or with numbers. The log of a program, such as a web server, is an error, and the message says so. These files are errors,
too: packed archives, pictures, web pages, database dumps, MATLAB, NumPy and R files, Git LFS pointers. The message names the kind of the
file and a way to a log.

In the form `casas`, a word between sensor and value is the sensor's room or place, if each sensor always has the same word. Homebody leaves
out and reports a damaged state such as `ONc`. If nearly all values are states or numbers, it also counts the remaining values.

A folder with a file for each day is one log: all files have one form, their names differ by numbers, and their times do not overlap.
Numbers after words such as `home` or `patient` mean different homes, so Homebody does not join such files. A silence of twelve hours
between two files is a gap.

## Tables

Homebody reads a table by its headings and by the cells of its first thousand rows. `homebody inspect` lists the meaning of each column with
the reason, also with `--json`. If other commands recognise a column by its cells alone, they report that on standard error.

| rows | read as |
|---|---|
| time, sensor, value | one event each; a column of kinds, rooms or units describes the sensor |
| time and sensor, without a value | one firing each, with the value `ON`, which Homebody adds |
| start and end, or start and duration | an ON and an OFF of a sensor, or an activity |
| start and end with numbers, or words other than ON | one event each, at the start |
| time, and a column for each sensor | each change of a sensor with states, each cell of a sensor with numbers |

| cells | read as |
|---|---|
| date and time of day in two columns, with AM and PM or without | one timestamp |
| dates such as `02/03/2009` | dates; the rows decide whether the day or the month comes first, by a number above 12, consecutive days, points between the numbers, or AM and PM |
| decimal commas and thousands separators | recognised by the numbers |
| a unit after a number, as in `21.4 °C` | the unit of the sensor |
| `24:00` | the next midnight |
| months as words | dates |
| a heading with UTC | the clock of the column |
| numbers since 1970 | seconds, milliseconds, microseconds or nanoseconds |
| timestamps with an offset, such as `2009-03-02T07:12:03-06:00` | wall-clock time of the home with that offset |

- Homebody skips lines above the heading, such as titles, comments and `sep=;`, with a remark.
- It reads text that is not UTF-8 as Windows text.
- Ids, prices and units are not sensor names.
- If a device has several attributes, the sensor is `device attribute`.

Homebody refuses a table, with the reason, if:

- its rows do not decide the order of its dates
- its rows come from several homes or persons
- it does not hold a log: its names hardly repeat, its values are sentences, or its dates have no time of day
- it is a list of calls, purchases, pages or places
- Homebody can read hardly any of its rows

Options decide cases that the rows leave open:

| option | meaning |
|---|---|
| `--home-column home_id=H12` | the column (in JSON the key) of homes or persons, and the one to read; `home_id=*` reads all as one home |
| `--dates day-first`, `--dates month-first` | the first number in a date |
| `--decimals comma`, `--decimals point` | the decimal mark |
| `--wide` | each column is a sensor; `wide:FILE` means the same |

For a table with unusual names, write a `logger.json` with the names of the table and its columns, and pass it with `--mapping logger.json`
([logger](logger.md)). A file `sensors.csv` in the same folder, as a run writes it, gives the names, kinds and rooms of sensors. You may
write it yourself. The columns `id` and `kind` are enough, and a kind is `motion`, `contact`, `used`, `reading` or `other`. The file
overrides the kinds that Homebody finds in the log's source and in the names of sensors. `homebody inspect` shows the evidence for the kind
of each sensor.

## Activities

Homebody reads activities with the log, from one of these:

- notes of their beginnings and ends: `Sleep begin`, `Sleep=\"end\"`, `1-end`, `Sleep_Begin`, `begin Sleep`
- a label on each row, which holds up to the first row with another label
- a table in the same folder with a known name: `kasterenActData.txt` for `kasterenSenseData.txt`, `OrdonezA_ADLs.txt` for
  `OrdonezA_Sensors.txt`, `activities.csv` for `devices.csv`
- if the log has no activities of its own, a table of any name in the same folder, with a start, an end and a label in each row, over
  the same time; `inspect` names it. If several tables fit, `inspect` lists them and Homebody reads none of them

`homebody convert` also writes the activities. Each row has the labels of its time in the column `activity`, separated by `|`. A separate
table has a row for each activity, with `start_time,end_time,activity`. In a database this table is called `activity`; otherwise it is a
file next to the log, such as `week.activity.csv`, which pyadlml reads. In the form `casas`, Homebody writes a note into the first row that
has no other note and is not earlier than the note. `--activities` adds the ground truth of a run. A log with labels of its own does not
need this option, and `convert` refuses it there, because such a log has no truth.

## Text files that Homebody writes

`csv:FILE`, `casas:FILE` and `jsonl:FILE` write text with one row per line; in JSON Lines, an object whose keys are the column names.
A name that ends in `.gz` is compressed with gzip. A name that ends in `.zst` is compressed with Zstandard, with the feature
`parquet`. With `-` as the file, rows go to standard output, and nothing else does; the run ends when the reader closes it.

A text file outside a run's folder has a table of its sensors next to it, such as `week.sensors.csv` for `week.csv`. The table has the id,
name, kind, room, position in metres and unit of each sensor, and the time zone of the home. A run's folder has one such table,
`sensors.csv`. SQLite has the table `sensor`, and the zone in its table `run`. Homebody reads a log with the table of the same name,
otherwise with `sensors.csv`. If a log has only the ids of its sensors, Homebody writes no table.

| destination | during the run | after a killed run |
|---|---|---|
| `jsonl:FILE` | has its name from the first row, so `tail -f` can follow it | has the written rows, and possibly half a line at the end |
| `jsonl:-`, `csv:-`, `casas:-` | each row arrives within a tenth of a second | the rows that the reader received |
| `sqlite:FILE` | can be read while it grows | all rows except about the last second |
| `csv:FILE`, `casas:FILE` of `homebody live` | as `jsonl:FILE` | as `jsonl:FILE` |
| `csv:FILE`, `casas:FILE` of other runs, all compressed files | gets its name when it is complete | no file of that name |
| `parquet:FOLDER` | has each day after its end | complete days |
| `parquet:FILE.parquet`, `arrow:FILE` | gets its name when it is complete | no file of that name |

`homebody run --resume` continues each of them. The result has the same bytes as an uninterrupted run.

```sh
homebody run scenarios/tigerplace --for 1d --quiet --out jsonl:day.jsonl
homebody convert day.jsonl --out csv:day.csv.gz
homebody inspect day.csv.gz
```

## Irregularities

`homebody inspect` reports these irregularities, and `homebody convert` counts them.

| word | meaning |
|---|---|
| repeated | a row turns on a sensor that is already on, such as an ON after an ON |
| missing | a row ends a state that has not begun, such as an OFF without an ON |
| doubled | a row repeats the sensor's last row: the same time, the same value |
| set back | a row is earlier than the one before it |
| silence | no sensor reports for 12 h or more |
| dead | a sensor sends nothing for the last two days of the log or longer; this silence is three times as long as any before it |
| stuck | a motion sensor is on for 6 h or more; or 50 readings or more, over a day or longer, have the same number |
| not known | a row reports that the state of the sensor is not known, such as `unavailable` |
| restored | a row repeats the state after a period in which it was not known: after such a row, or after a gap of the recorder |

If the newest rows come first, or the rows come sensor by sensor, Homebody examines the log in the order of time, and `inspect` reports
that. Homebody reports no repeated rows for a sensor without rows that end a state, and none for numbers.

Homebody recognises states by their words in the languages of the plan importer: `ON`, `No motion`, `geschlossen`, `有人`. A sensor
whose name indicates motion, a contact or a bed may alternate between two other words. Then `inspect` guesses which of them is ON and
gives its reason, or reports both as not understood.
";

#[test]
fn the_page_of_forms_is_that_of_the_table() {
    let row = |name: &str, what: &str| format!("| `{name}` | {} |\n", what.replace('|', "\\|"));
    let rows: String = FORMS.iter().map(|form| row(form.name, form.what)).collect();
    is_generated("docs/reference/logs.md", &format!("{HEAD}| form | description |\n|---|---|\n{rows}{TAIL}"));
}
