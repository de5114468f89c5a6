//! `docs/logs.md` is what the table of forms says.
//!
//! `HOMEBODY_REWRITE=1 cargo test -p homebody-log --test log_forms` writes it anew. What the forms hold is tested in
//! `crates/homebody-log/tests/recorded.rs`.

#[path = "../../../tests/generated.rs"]
mod generated;

use generated::is_generated;
use homebody_log::source::FORMS;

const HEAD: &str = "\
# Logs that are read

Commands that take a log take the folder of a run, a file, or the folder of a data set with one log in it. A file is known by how it
begins. Where that misleads, its form is named before it, as in `casas:home.txt`. This page is made from the table in
`crates/homebody-log/src/source/forms.rs`.

```sh
homebody look kasteren
homebody look week.csv --png week.png
homebody convert mit:activities_data.csv --to csv:mit.csv
```

## Forms

";

const TAIL: &str = "
A program that is built with the feature `parquet` also reads `parquet`, files and folders of files by run and day, and `arrow`, files of
Arrow IPC: `docs/parquet.md`. Any text may be packed by gzip, and by Zstandard with that feature; it is known by how it begins, and
unpacked as it is read. One that is cut short or damaged is refused.

A log of any size is read in little memory. Databases are opened to be read only, but for one that a run of ours left in the middle of a
transaction. Nothing of a log goes anywhere but where a command is told to write.

## Rows and lines

Each row has an instant, a sensor and what it said. A line that cannot be understood is left out and named with its number and why;
the first hundred are listed, all are counted, and no other line is lost with it. A log is in local time or in UTC, as most of its
first rows are; rows on the other clock are named. Instants may have fractions of any length, or none. What is longer than
`docs/limits.md` says is no log.

Intervals become an ON and an OFF, in the order of time as far as a million rows are apart; one that ends before it begins is named. In
tables of each second only changes become rows. ARAS tells no dates: its day is told as that of January 1970.

A home that is read from a table with odd names needs a `logger.json` that tells the names of table and columns: `--mapping logger.json`
(`docs/logger.md`). A folder with `sensors.csv`, as a run leaves it, tells names, kinds and rooms of sensors.
A person may write it, too: `id,kind` is enough, and a kind is `motion`, `contact`, `used`, `reading` or `other`. It overrides the
log's source and the names of its sensors. `homebody look` shows the evidence for the kind of each sensor.

## Activities

What a log tells of activities is read with it: notes that they begin and end (`Sleep begin`, `Sleep=\"end\"`), a label on each row, or a
text or table beside the rows, such as `kasterenActData.txt` beside `kasterenSenseData.txt`, `OrdonezA_ADLs.txt` beside
`OrdonezA_Sensors.txt`, `activities.csv` beside `devices.csv`. A label holds from its row up to the first row with another.

`homebody convert` writes them along. Each row has the labels of what goes on in the column `activity`, parted by `|`, and a table has
them whole, as `start_time,end_time,activity`: in a database it is called `activity`, elsewhere it is a file beside the log, such as
`week.activity.csv`, which pyadlml reads. In the form of CASAS a note stands at the first row from that instant on that has none yet. A run's
own truth goes along with `--activities` alone.

## Texts that are written

`csv:FILE`, `casas:FILE` and `jsonl:FILE` write texts: a row a line, in JSON Lines an object with the names of the columns as keys. A name that ends
in `.gz` is packed by gzip, one that ends in `.zst` by Zstandard, with the feature `parquet`. Written to `-`, rows go to standard output
and nothing else does; a run ends when nobody reads them any more.

| place | while the run goes on | of a killed run |
|---|---|---|
| `jsonl:FILE` | has its name from the first row on, so that `tail -f` follows it | what was written, perhaps with half a line at its end |
| `jsonl:-`, `csv:-`, `casas:-` | a row is there within a tenth of a second | what was read |
| `sqlite:FILE` | may be read while it grows | all rows up to the last second or so |
| `csv:FILE`, `casas:FILE` of `homebody live` | as `jsonl:FILE` | as `jsonl:FILE` |
| `csv:FILE`, `casas:FILE` of other runs, all that is packed | has its name once it is whole | nothing under its name |
| `parquet:FOLDER` | has each day once it is over | whole days |
| `parquet:FILE.parquet`, `arrow:FILE` | has its name once it is whole | nothing under its name |

`homebody run --resume` goes on with each of them to the bytes of a run that nothing has disturbed.

```sh
homebody run scenarios/tigerplace --for 1d --quiet --out jsonl:day.jsonl
homebody convert day.jsonl --to csv:day.csv.gz
homebody look day.csv.gz
```

## What is odd

`homebody look` tells it, and `homebody convert` counts it.

| word | meaning |
|---|---|
| repeated | a row says that what is on comes on, such as an ON after an ON |
| missing | a row says that something ends that has not begun, such as an OFF without an ON |
| doubled | a row is the sensor's last once more: the same instant, the same value |
| set back | a row is earlier than the one before it |
| silence | nothing says anything for 12 h or more |
| dead | a sensor says nothing more for two days or more before the log ends, and for three times as long as ever before |
| stuck | a motion sensor is on for 6 h or more; or all of 50 readings or more over a day are one number |

Sensors of which no row says that something ends repeat nothing, and numbers do not either.
";

#[test]
fn the_page_of_forms_is_that_of_the_table() {
    let row = |name: &str, what: &str| format!("| `{name}` | {} |\n", what.replace('|', "\\|"));
    let rows: String = FORMS.iter().map(|form| row(form.name, form.what)).collect();
    is_generated("docs/logs.md", &format!("{HEAD}| form | what it is |\n|---|---|\n{rows}{TAIL}"));
}
