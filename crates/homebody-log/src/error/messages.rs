//! The reasons why a place does not serve, by area; [`LogError`](crate::LogError) names the place.

use crate::limits::{LONGEST_ROW_BYTES, MOST_CELLS};
use std::io;

homebody_core::messages! {
    /// Parts of a log that are longer than Homebody reads.
    pub(crate) enum LengthMessage in "log-length" {
        /// Homebody reads a line into memory as a whole, so it limits lines to one mebibyte. A file without line ends is rarely a log.
        Line error "line" ("the line is longer than {LONGEST_ROW_BYTES} bytes")
            hint ("check that the file is a log");
        /// Such a table has a column for everything, and its rows take much memory.
        Cells error "cells" ("the row has more than {MOST_CELLS} cells")
            hint ("keep the columns of time, sensor and value, and remove the others");
        /// A quotation mark that is never closed makes the rest of an XML file one tag.
        Tag error "tag" ("the tag is longer than {LONGEST_ROW_BYTES} bytes, or a quotation mark in it is not closed")
            hint ("check that the file is an event log in XES");
        /// Logs in JSON have a list of objects, perhaps inside of a few others.
        Depth { most: usize } error "json-depth" ("lists and objects are nested more than {most} levels deep")
            hint ("extract the list of rows from the file, for example with jq");
        /// A string in JSON ends with a quotation mark. One that is never closed makes the rest of the file one string.
        JsonText error "json-text" ("a text is longer than {LONGEST_ROW_BYTES} bytes, or its quotation mark is not closed")
            hint ("check that the file is complete");
        /// A key in JSON ends with a quotation mark. One that is never closed makes the rest of the file one key.
        JsonKey error "json-key" ("a key is longer than {LONGEST_ROW_BYTES} bytes, or its quotation mark is not closed")
            hint ("check that the file is complete");
        /// The table of a log has short cells. This one holds pictures or files, for example.
        DatabaseRow error "database-row" ("a row or a cell is longer than {LONGEST_ROW_BYTES} bytes")
            hint ("check that the table is a log");
    }
}

homebody_core::messages! {
    /// Problems with a place of a ground truth.
    pub enum TruthMessage in "truth" {
        /// A run writes its ground truth next to its log. A log that was copied elsewhere needs its truth there, too.
        NotBeside error "not-beside-log" ("its folder has no tables of a ground truth")
            hint ("copy the ground truth to the folder of the log");
        /// A ground truth has about a dozen tables, and the command reads some of them by name. docs/reference/truth.md lists them.
        Missing {
            /// The missing parts.
            missing: Vec<String>,
        } error "missing-parts" ("it has {missing}", missing = missing.join(", "))
            hint ("name the truth database of the same run; for a ground truth in files, pass csv:FILE or parquet:FOLDER");
        /// A ground truth has the tables that docs/reference/truth.md lists.
        NoTable {
            table: String,
            /// The tables that there are.
            known: Vec<String>,
        } error "no-table" ("it has no table {table:?}")
            hint ("the tables are {known}", known = known.join(", "));
        /// The file was changed, or is the table of another program.
        NoColumn { column: String } error "no-column" ("it has no column {column:?}")
            hint ("name the truth database of the same run, or csv:FILE or parquet:FOLDER where each table is a file");
        /// The columns of a table hold integers, numbers, texts or instants. docs/reference/truth.md lists the type of each.
        BadRow {
            /// The line, from 1.
            line: u64,
            table: String,
        } error "bad-row" ("line {line} is not a row of the table {table:?}")
            hint ("restore the file as the run has written it");
        /// Parquet and Arrow files have a type for each column. docs/reference/truth.md lists the type of each.
        ColumnType { column: String } error "column-type" ("the column {column:?} has another type than a run writes")
            hint ("restore the file as the run has written it");
        /// Homebody reads instants between the years 1 and 9999.
        InstantOutOfRange error "instant-out-of-range" ("an instant in it is out of range")
            hint ("restore the file as the run has written it");
        /// The text form of CASAS has a line for each sensor event. A ground truth needs several tables.
        CasasForm error "casas" ("a file in the form of CASAS cannot hold several tables")
            hint ("name a place of another form, such as sqlite:truth.db");
        /// Messages that were sent to a broker are gone. Homebody cannot read them back.
        Unstored error "not-stored" ("Homebody cannot read a truth from such a place")
            hint ("name a database, or files");
        /// A run writes its ground truth to an SQLite database unless asked otherwise.
        NotDatabase error "not-a-database" ("it is not an SQLite database")
            hint ("name the truth database of the run, or csv:FILE or parquet:FOLDER where each table is a file");
    }
}

homebody_core::messages! {
    /// Differences between a log and the ground truth of another run.
    pub(crate) enum OtherRunMessage in "other-run" {
        /// The ground truth refers to the rows of the log by their number, from 0. The log is shorter than the run's.
        FewerRows { row: u64, rows: u64 } error "fewer-rows" ("it refers to row {row}, and the log has {rows} rows")
            hint ("name the ground truth of the same run, and the whole log");
        /// The ground truth has a row for each row of the log. This one has none.
        NoRows error "no-rows" ("it refers to no row of the log")
            hint ("name the ground truth of the same run");
        /// The ground truth names the sensor of each row. The log has another sensor there.
        OtherSensor { row: u64, sensor: String } error "other-sensor" ("row {row} of the log is of {sensor}, but the ground truth names another sensor")
            hint ("name the ground truth of the same run");
    }
}

homebody_core::messages! {
    /// Differences between a destination and the run that Homebody resumes.
    pub enum ChangedMessage in "resume" {
        /// A resumed run makes the same rows again and compares them with those in the destination. One row differs: a person or a
        /// program has changed it, or the scenario has changed since.
        OtherRow {
            /// The row, from 0.
            row: u64,
            table: String,
        } error "other-row" ("row {row} of {table:?} differs from the row of the run")
            hint ("restore the rows of the run, or start a new run");
        /// A resumed run makes the same lines again and compares them with those in the file. One line differs.
        OtherLine {
            /// The line, from 1.
            line: u64,
        } error "other-line" ("line {line} differs from the line of the run")
            hint ("restore the file, or start a new run");
        /// The destination contains rows behind the last row of the run: another program has added them, or the run was longer before.
        MoreRows { rows: u64 } error "more-rows" ("it has more than the {rows} rows of the run")
            hint ("restore the rows of the run, or start a new run");
        /// The table contains rows behind the last row of the run.
        MoreRowsInTable { table: String, rows: u64, of_run: u64 }
            error "more-rows-in-table" ("{table:?} has {rows} rows, but the run makes {of_run}")
            hint ("restore the rows of the run, or start a new run");
        /// The destination has confirmed rows that the run did not make this time: the run was stopped earlier than before, or the
        /// scenario has changed since.
        RowsAhead { rows: u64 } error "rows-ahead" ("it has confirmed {rows} more rows than the run has made")
            hint ("resume the run, and let it run at least as long as before");
        /// A resumed run continues only its own database.
        ForeignDatabase error "foreign-database" ("it is a database of another program")
            hint ("restore the run's database, or start a new run");
        /// A database holds one run, and this one holds a run with another id.
        OtherRun error "other-run" ("it contains another run")
            hint ("restore the run's database, or start a new run");
        /// Each camera stores a silhouette for each picture. One row of them is damaged or was changed.
        Silhouette { reason: String } error "silhouette" ("cannot read a silhouette: {reason}")
            hint ("restore the file, or start a new run");
    }
}

homebody_core::messages! {
    /// Data that the form of a destination cannot hold.
    pub enum HoldMessage in "destination" {
        /// The text form of CASAS has one table, and a ground truth has several.
        CasasTruth error "casas-truth" ("the ground truth")
            hint ("write the ground truth to a place such as \"sqlite:truth.db\"");
        /// The text form of CASAS separates its parts by tabs and lines, so no text may contain these.
        ControlCharacters { text: String } error "control-characters" ("the control characters of {text}")
            hint ("write the log to a place such as \"csv:log.csv\" or \"sqlite:log.db\"");
        /// Standard output is one stream of text. A ground truth has several tables.
        OutputTables error "output-tables" ("several tables")
            hint ("write the tables to a database, such as \"sqlite:truth.db\"");
        /// The text form of CASAS notes the begin and the end of an activity at a row, so it has at most one note a row.
        CasasActivities { activities: usize, rows: u64 }
            error "casas-activities" ("{activities} activities: it has at most one activity for each row, and {rows} rows")
            hint ("write the log to a place such as \"csv:log.csv\" or \"sqlite:log.db\"");
        /// Homebody reaches object stores only when it is built with this feature.
        NoObjectStore error "no-object-store" ("files: this program was built without object stores")
            hint ("build Homebody with --features cloud, or write to a folder and copy the folder");
    }
}

homebody_core::messages! {
    /// Errors of the destinations of this crate.
    pub(crate) enum OutputMessage in "destination" {
        /// The program that reads standard output has ended, for example `head`. The run ends, too.
        Closed error "output-closed" ("the program that reads the output has ended, so the run has ended")
            hint ("write to a file to keep all rows");
        /// A fleet that appends to a file continues its own rows. These are of another fleet, or of the same fleet at another time.
        OtherHomes { difference: String } error "other-homes" ("it has rows of other homes: {difference}")
            hint ("pass --force to replace the file; to append to it, repeat the earlier command with the same --start");
    }
}

homebody_core::messages! {
    /// Problems with the file that counts the rows which a destination has confirmed.
    pub enum CountMessage in "row-count" {
        /// Homebody counts the rows that a server has confirmed in a small JSON file of the run's folder, so that a resumed run sends no
        /// row twice.
        Unreadable { place: String, reason: String } error "unreadable" ("cannot read {place}: {reason}")
            hint ("restore the file, or delete it to send all rows again");
        /// The number is larger than any run makes, so the file was changed. With it no row would be sent.
        TooMany { place: String, rows: u64 } error "too-many" ("{place} counts {rows} rows, more than any run has")
            hint ("restore the file, or delete it to send all rows again");
    }
}

homebody_core::messages! {
    /// Problems with threads of the program.
    pub enum ThreadMessage in "thread" {
        /// The system limits the threads of a user, and the memory that each needs.
        Unavailable {
            /// The use of the thread, such as `to take commands`.
            purpose: String,
            reason: String,
        } error "unavailable" ("cannot start a thread {purpose}: {reason}")
            hint ("raise this user's limits on threads or memory, or run fewer simulations at once");
    }
}

homebody_core::messages! {
    /// Problems with compressed files.
    #[derive(Clone, Copy)]
    pub enum PackedMessage in "packed" {
        /// The file was copied while a program wrote it, or the copy is not complete.
        Damaged error "damaged" ("the compressed text is damaged or cut short")
            hint ("copy the file again, or restore it");
        /// Homebody unpacks Zstandard only when it is built with the feature `parquet`.
        NoZstandard error "no-zstandard" ("the file is compressed with Zstandard, but this program was built without Zstandard")
            hint ("unpack it first: unzstd FILE");
    }
}

homebody_core::messages! {
    /// Problems with a table that names the sensors of a log.
    pub(crate) enum SensorTableMessage in "sensor-table" {
        /// The table has a heading and one line for each sensor, with its id in the log and its name in the home:
        ///
        /// ```text
        /// id,name
        /// M001,hall motion
        /// ```
        NoHeading error "no-heading" ("the first line lacks a column id or a column name")
            hint ("write id,name in the first line");
        /// Each line names one sensor. An empty cell names none.
        EmptyCell error "empty-cell" ("an id or a name is empty")
            hint ("write both, or remove the line");
        /// Two ids of a log would be the same sensor of the home.
        SameName { name: String, line: u64 } error "duplicate-name" ("the name {name} is already in line {line}")
            hint ("give each sensor its own name");
        /// One id of a log would be two sensors of the home.
        SameId { id: String } error "duplicate-id" ("the id {id} already has a name")
            hint ("keep one line for each id");
    }
}

homebody_core::messages! {
    /// Problems with a `logger.json` that is given by itself.
    pub(crate) enum MappingMessage in "mapping" {
        /// The file must be JSON with the keys of `logger.json`, which docs/reference/logger.md lists:
        ///
        /// ```json
        /// {"table": "events", "columns": {"time": "at", "sensor": "device", "value": "state"}}
        /// ```
        Invalid { reason: String } error "invalid" ("this is not a valid logger.json: {reason}")
            hint ("correct the file; docs/reference/logger.md lists its keys");
    }
}

homebody_core::messages! {
    /// Why a file is not opened, besides what the system says.
    #[derive(Clone, Copy, PartialEq, Eq)]
    pub(crate) enum FileRefusal in "own-file" {
        /// The file is a link, or a folder on the way to it is one. A run's folder may come from another person, and a link in it could
        /// lead anywhere.
        Link error "link" ("it is a link, or lies in a folder that is a link")
            hint ("check where the link leads; then remove it, or choose another name");
        /// Homebody writes regular files only. A folder, a pipe or a device has this name.
        NoPlain error "not-regular" ("it is a folder, a pipe or a device")
            hint ("remove it, or choose another name");
        /// A hard link gives a file a second name, so it may be another file of the user.
        TwoNames error "second-name" ("it has a second name elsewhere (a hard link)")
            hint ("check what the file is; then remove it, or choose another name");
        /// The file belongs neither to this user nor to the owner of its folder.
        Foreign error "other-user" ("it belongs to another user")
            hint ("check what the file is; then remove it, or choose another name");
    }
}

impl FileRefusal {
    /// The refusal in an error, if it is one.
    pub fn from_error(error: &io::Error) -> Option<FileRefusal> {
        error.get_ref()?.downcast_ref().copied()
    }
}

impl From<FileRefusal> for io::Error {
    fn from(refused: FileRefusal) -> io::Error {
        io::Error::new(io::ErrorKind::InvalidInput, refused)
    }
}
