//! `docs/reference/logs.md` is what the table of forms says.
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
Arrow IPC: `docs/how-to/parquet.md`. Any text may be packed by gzip, and by Zstandard with that feature; it is known by how it begins, and
unpacked as it is read. One that is cut short or damaged is refused.

A log of any size is read in little memory. Databases are opened to be read only, but for one that a run of ours left in the middle of a
transaction. Nothing of a log goes anywhere but where a command is told to write.

## Rows and lines

Each row has an instant, a sensor and what it said. A line that cannot be understood is left out and named with its number and why;
the first hundred are listed, all are counted, and no other line is lost with it. A log is in local time or in UTC, as most of its
first rows are; rows on the other clock are named. Instants may have fractions of any length, or none. What is longer than
`docs/reference/limits.md` says is no log.

Intervals become an ON and an OFF, in the order of time as far as a million rows are apart; one that ends before it begins is named. In
tables of each second only changes become rows. A pause of more than a minute in such a table is a gap: sensors and activities end
with the last row before it. ARAS has no dates: day n becomes day n of 1970.

A form is accepted on evidence. A text is of the form `casas` if few names repeat in its first lines, with states such as ON or with
numbers. The log of a program is an error that says so. Other files are errors, too, which name their kind and a way to a log: packed
archives, pictures, pages of the web, dumps of databases, files of MATLAB, NumPy and R, pointers of Git LFS.

In the form `casas` a word between sensor and value is the sensor's room or place, if each sensor has only one. A damaged state such as
`ONc` is left out and named. Values that are neither states nor numbers are counted, where nearly all others are.

A folder with a file a day is one log: all files have one form, their names differ by numbers, and their spans do not overlap. Numbers
behind words such as `home` or `patient` count homes, so such files stay apart. A silence of twelve hours between two files is a gap.

## Tables

A table is read by its headings and by the cells of its first thousand rows. `homebody look` lists for each column what it was taken
for and why; `--json` has it, too. Other commands say on standard error which columns were found by their cells alone.

| rows | how they are read |
|---|---|
| time, sensor, value | an event each; a column of kinds, rooms or units goes with the sensor |
| time and sensor, without a value | a firing each, with the value `ON`, which is the reader's own |
| start and end, or start and duration | an ON and an OFF of a sensor, or an activity |
| start and end with numbers, or words other than ON | an event each, at the start |
| time, and a column for each sensor | of a sensor with states each change, of one with numbers each cell |

Date and time of day may stand in two columns, with AM and PM or without. Dates such as `02/03/2009` are read in the order of day and
month that the rows decide: by a number above 12, by days that follow each other, by points between the numbers, or by AM and PM. A
comma before decimals is known by the numbers, and so are thousands. A unit behind a number, as in `21.4 °C`, is the sensor's unit.
`24:00` is the next midnight, months may be words, and a heading with UTC says the clock. Numbers since 1970 may be in seconds, milliseconds, microseconds or nanoseconds.
Instants with an offset from UTC, such as `2009-03-02T07:12:03-06:00`, are put on the wall of the home that has it.

Lines above the heading, such as titles, comments and `sep=;`, are passed over with a remark. Text that is not in UTF-8 is read in the
letters of Windows. Ids, prices and units name no sensors. If a device has several attributes, the sensor is `device attribute`.

A table is refused with a sentence if nothing decides the order of its dates, if its rows are of several homes or persons, or if it
holds no log: its names hardly come again, its values are sentences, its dates have no time of day. Homebody also refuses
lists of calls, purchases, pages and places, and tables of which it can read hardly a row. An option decides what the rows
leave open:

| option | meaning |
|---|---|
| `--home-column home_id=H12` | the column, or in JSON the key, of homes or persons, and the one to read; `home_id=*` reads all as one home |
| `--dates day-first`, `--dates month-first` | the number that comes first in a date |
| `--decimals comma`, `--decimals point` | the mark before decimals |
| `--wide` | each column is a sensor; `wide:FILE` means the same |

A home that is read from a table with odd names needs a `logger.json` that tells the names of table and columns: `--mapping logger.json`
(`docs/reference/logger.md`). A folder with `sensors.csv`, as a run leaves it, tells names, kinds and rooms of sensors.
A person may write it, too: `id,kind` is enough, and a kind is `motion`, `contact`, `used`, `reading` or `other`. It overrides the
log's source and the names of its sensors. `homebody look` shows the evidence for the kind of each sensor.

## Activities

Activities are read with the log: from notes of their beginnings and ends (`Sleep begin`, `Sleep=\"end\"`, `1-end`, `Sleep_Begin`,
`begin Sleep`), from a label on each row, or from a table in the same folder. Some names of such tables are known, such as
`kasterenActData.txt` for `kasterenSenseData.txt`, `OrdonezA_ADLs.txt` for `OrdonezA_Sensors.txt`, `activities.csv` for `devices.csv`.
If the log has no activities of its own, a table of any name is read that has a start, an end and a label in each row of the same span
of time. `look` names it. If several fit, `look` names them all and none is read. A label holds from its row up to the first row
with another.

`homebody convert` writes them along. Each row has the labels of what goes on in the column `activity`, parted by `|`, and a table has
them whole, as `start_time,end_time,activity`: in a database it is called `activity`, elsewhere it is a file beside the log, such as
`week.activity.csv`, which pyadlml reads. In the form of CASAS a note stands at the first row from that instant on that has none yet. A run's
own truth goes along with `--activities` only. A log with labels of its own needs no option; with this one it is refused, as it has no
truth.

## Texts that are written

`csv:FILE`, `casas:FILE` and `jsonl:FILE` write texts: a row a line, in JSON Lines an object with the names of the columns as keys. A name that ends
in `.gz` is packed by gzip, one that ends in `.zst` by Zstandard, with the feature `parquet`. Written to `-`, rows go to standard output
and nothing else does; a run ends when nobody reads them any more.

A text outside a run's folder has its sensors in a file of its own, `week.sensors.csv` of `week.csv`: the id, name, kind, room, place in metres and
unit of each, and the time zone of the home. A run's folder has one such table, `sensors.csv`; SQLite has the table `sensor`, and the zone in
its table `run`. A log is read with the table of its own name, else with `sensors.csv`. A log with nothing but ids gets no table.

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
| not known | a row says that the state of the sensor is not known, such as `unavailable` |
| restored | a row says the state again after a stretch in which it was not known: after such a row, or after a gap of the recorder |

A log whose newest rows come first, or whose rows come sensor by sensor, is looked at in the order of time, and `look` says so.
Sensors of which no row says that something ends repeat nothing, and numbers do not either.

States are known by their words in the languages of the plan importer: `ON`, `No motion`, `geschlossen`, `有人`. A sensor that is named
as one of motion, a contact or a bed may say two other words in turn. Then `look` guesses which of them is ON and says why, or names both
as not understood.
";

#[test]
fn the_page_of_forms_is_that_of_the_table() {
    let row = |name: &str, what: &str| format!("| `{name}` | {} |\n", what.replace('|', "\\|"));
    let rows: String = FORMS.iter().map(|form| row(form.name, form.what)).collect();
    is_generated("docs/reference/logs.md", &format!("{HEAD}| form | what it is |\n|---|---|\n{rows}{TAIL}"));
}
