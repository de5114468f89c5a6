//! Why a file or a table is not a log that Homebody reads.

homebody_core::messages! {
    /// Files that are not logs, or whose form Homebody does not know.
    pub(crate) enum FormMessage in "log-form" {
        /// A program that has just started may have created its log without a row so far.
        Empty error "empty" ("the file is empty")
            hint ("wait until the program that writes it has written its rows");
        /// The file has another purpose, or keeps its table in a form of its own. Save the table as CSV with a time, a sensor and a value in
        /// each row:
        ///
        /// ```text
        /// time,sensor,value
        /// 2026-03-02 07:12:03,hall motion,ON
        /// ```
        OtherKind { kind: &'static str, advice: &'static str }
            error "other-kind" ("the file is {kind}") hint ("{advice}");
        /// A repository keeps large files elsewhere, and has a short text in their place.
        Pointer { program: &'static str, command: &'static str }
            error "pointer" ("the file is a pointer of {program}, without the data")
            hint ("fetch the data: {command}");
        /// Homebody reads texts in UTF-8. Some programs of Windows save texts in UTF-16.
        Utf16 error "utf-16" ("the file is text in UTF-16")
            hint ("save it in UTF-8");
        /// Homebody reads files that are compressed with gzip or Zstandard, but not archives of several files. The files of spreadsheets
        /// are such archives.
        Archive { kind: &'static str }
            error "archive" ("the file is {kind}")
            hint ("extract the log from it, or save the sheet as CSV");
        /// Homebody reads files that are compressed with gzip or Zstandard.
        Packed error "packed" ("the file is compressed in a form that Homebody does not read")
            hint ("unpack it first, or compress it with gzip");
        /// A dump has the commands that make a database. Homebody reads the database itself, or a table of it as CSV.
        Dump { kind: &'static str, advice: &'static str }
            error "dump" ("the file is a dump of {kind}") hint ("{advice}");
        /// Logs are texts, SQLite databases, or files in Parquet or Arrow IPC. This file has bytes that no text has.
        Binary error "binary" ("the file is neither text nor a database")
            hint ("export the log from the program that wrote it, for example as CSV");
        /// Of the XML files, Homebody reads event logs in XES.
        Xml error "xml" ("the file is XML, and not an event log in XES")
            hint ("write its rows as CSV with a time, a sensor and a value");
        /// Homebody recognises a log by its first lines. docs/reference/logs.md lists all forms, and the signs of each.
        Unknown { first_line: String }
            error "unknown" ("the file has no form that Homebody knows: line 1 is {first_line}")
            hint ("write the form before the name, as in \"csv:FILE\"; docs/reference/logs.md lists the forms");
        /// The database was copied while a program wrote it, or the copy is not complete.
        DamagedDatabase { reason: String }
            error "damaged-database" ("the database is damaged or cut short: {reason}")
            hint ("copy it again with sqlite3 FILE '.backup COPY', or restore it");
        /// The name or the scheme says that the file is a database, and its first bytes are not those of one.
        NotDatabase error "not-a-database" ("the file is not an SQLite database")
            hint ("name the database, or remove \"sqlite:\" before the name, so that Homebody recognises the form");
        /// Homebody looks for a table with columns of a time, a sensor and a value, by their names. `--mapping logger.json` gives other names:
        ///
        /// ```json
        /// {"table": "events", "columns": {"time": "at", "sensor": "device", "value": "state"}}
        /// ```
        NoLogTable error "no-log-table" ("no table of the database has columns of time, sensor and value")
            hint ("name the table and its columns with --mapping logger.json");
        /// Home Assistant keeps the states of its entities in the tables `states` and `states_meta`.
        NoStates error "no-states" ("the database lacks the tables in which Home Assistant stores states")
            hint ("name Home Assistant's own home-assistant_v2.db, or a copy of it");
        /// Domoticz keeps its devices and their history in tables such as `DeviceStatus` and `LightingLog`.
        NoDevices error "no-devices" ("the database lacks the tables in which Domoticz stores devices and switches")
            hint ("name Domoticz's own domoticz.db, or a copy of it");
        /// A broker passes messages on and does not store them.
        Broker error "broker" ("an MQTT broker stores no log")
            hint ("record its messages to a file: mosquitto_sub -v -F '%U %t %p' -t '#' > log.txt");
        /// The folder has several files that are logs, and they are not parts of one.
        SeveralLogs { names: Vec<String>, has_more: bool }
            error "several-logs" ("the folder has several logs")
            hint ("name one of {names}{more}", names = names.join(", "), more = if *has_more { " and others" } else { "" });
        /// Homebody looks at each file of a folder to find the log in it, so it limits their number.
        ManyFiles { most: usize }
            error "many-files" ("the folder has more than {most} files")
            hint ("name the file of the log");
        /// The text in brackets or braces has no values.
        EmptyJson error "empty-json" ("the file has no rows: its JSON is empty")
            hint ("check that the program that writes it has written its rows");
        /// A row in JSON is an object with a time, a sensor and a value, or a list of times and values under a sensor's name:
        ///
        /// ```json
        /// [{"time": "2026-03-02T07:12:03Z", "sensor": "hall motion", "value": "ON"}]
        /// ```
        JsonWithoutRows { command: String }
            error "json-without-rows" ("no object of the JSON has a time, a sensor and a value")
            hint ("convert the file to JSON Lines, for example with {command}");
        /// No line of the file could be parsed. The first of them shows the problem.
        NoRow { line: u64, reason: String }
            error "no-row" ("line {line}: {reason}")
            hint ("correct the rows, or write the form before the name, as in \"csv:FILE\"");
        /// The lines of this program have times of day. Homebody takes the date of the first line from the name of the file.
        Dateless { program: &'static str }
            error "no-date" ("it is a log of {program}, whose lines have times without a date")
            hint ("put the date of the first line into the name of the file, such as hall-2026-02-02.log");
        /// Zigbee2MQTT logs the messages that it publishes only at the level `debug`, or `info` in older versions.
        NoMessages error "no-messages" ("it is a log of Zigbee2MQTT, and no line of it publishes a message")
            hint ("set log_level to debug, or record the messages with mosquitto_sub -t 'zigbee2mqtt/#' -F '%I %t %p'");
        /// The output of `psql` begins with a line of the names of columns.
        PsqlColumns error "psql-columns" ("its first line lacks columns of time, sensor and value")
            hint ("select a time, a sensor and a value, or name the columns with --mapping logger.json");
        /// The tables of OpenSHS have a column for each sensor, one for the time and one for the activity.
        OpenshsColumns error "openshs-columns" ("its first line lacks the columns of OpenSHS: timestamp, Activity and two or more sensors")
            hint ("remove \"openshs:\" before the name, so that Homebody recognises the form");
        /// Each row of a table of labels has two instants and a text.
        NoLabels error "no-labels" ("no row has a start, an end and a label")
            hint ("remove \"labels:\" before the name, so that Homebody recognises the form");
        /// A log of sensors repeats a few names, while a log of a program has sentences, levels and names of modules.
        ProgramLog { evidence: String }
            error "program-log" ("it looks like the log of a program: {evidence}")
            hint ("give a log with a time, a sensor and a value in each row");
        /// A log in the text form of CASAS has a date, a time, a sensor and a value in each line:
        ///
        /// ```text
        /// 2009-03-02 07:12:03.123456  M001  ON
        /// ```
        NoTextRows error "no-text-rows" ("no line has a date, a time, a sensor and a value")
            hint ("write the form before the name, as in \"csv:FILE\"; docs/reference/logs.md lists the forms");
        /// Most lines of a log begin with a date and a time.
        FewTextRows { rows: usize, lines: usize }
            error "few-text-rows" ("only {rows} of its first {lines} lines begin with a date and a time")
            hint ("remove the other lines, or write the form before the name, as in \"csv:FILE\"");
        /// The rows are a table with a column for each sensor, and nothing names the columns. With a heading Homebody reads it:
        ///
        /// ```text
        /// time,kitchen temperature,bedroom temperature
        /// 2026-03-02 07:12:03,21.5,19.0
        /// ```
        UnnamedColumns error "unnamed-columns" ("its lines are columns of numbers, and no line names the sensors")
            hint ("write a heading with a name for each column, and separate the cells by commas");
        /// The same sensors come again and again in a log. Here nearly each row has a name of its own.
        ManyNames { rows: u64, names: usize }
            error "many-names" ("its first {rows} rows have {names} different names, but the names of sensors recur")
            hint ("name the column of the sensors with --mapping logger.json");
    }
}

homebody_core::messages! {
    /// Tables that are not logs of sensors, or whose columns nothing explains.
    pub(crate) enum TableMessage in "log-table" {
        /// The only line of the table has the names of columns.
        NoRows error "no-rows" ("it has no rows: its only line is a heading")
            hint ("wait until the program that writes it has written its rows");
        /// A comma separates the cells and also stands in numbers such as `21,5`, so each such number becomes two cells.
        MoreCells { names: usize }
            error "more-cells" ("its heading has {names} cells, and most of its rows have more: numbers may have decimal commas")
            hint ("save the table with semicolons between the cells");
        /// Homebody finds the columns of time, sensor and value by their names, and else by their cells. `--mapping logger.json` names them:
        ///
        /// ```json
        /// {"columns": {"time": "when", "sensor": "what", "value": "state"}}
        /// ```
        NoColumns { wanted: &'static str, among: String }
            error "missing-columns" ("cannot find columns of {wanted} among {among}")
            hint ("write a heading such as time,sensor,value, or name the columns with --mapping logger.json");
        /// Each row of a log needs an instant. Homebody reads dates with a time of day, and numbers of seconds since 1970.
        NoInstants { among: String }
            error "no-instants" ("no column has dates with times; the columns are {among}")
            hint ("write a column of instants such as 2026-03-02 07:12:03");
        /// Each row of a log needs an instant, and dates alone are not precise enough.
        DatesAlone { column: String }
            error "dates-without-times" ("its instants, in the column {column}, are dates without a time of day")
            hint ("add the time of day to the dates, or in a column of its own");
        /// Each row of a log needs an instant. Homebody does not guess the date.
        TimesAlone { column: String }
            error "times-without-dates" ("its instants, in the column {column}, are times of day without a date")
            hint ("add a column of dates");
        /// The dates of a table have the same order throughout.
        MixedDates { column: String, day_first: usize, month_first: usize }
            error "mixed-dates" ("in the column {column}, {day_first} dates begin with the day and {month_first} with the month")
            hint ("pass --dates day-first or --dates month-first");
        /// In dates such as `02/03/2009` either number may be the day, and no date of the table decides it.
        OpenDates { column: String, example: String }
            error "ambiguous-dates" ("nothing says whether the day or the month is first in {example}, in the column {column}")
            hint ("pass --dates day-first or --dates month-first");
        /// In a number such as `1,234` the comma may separate thousands or decimals, and no number of the table decides it.
        OpenDecimals { example: String }
            error "ambiguous-decimals" ("nothing says whether the comma in {example} separates thousands or decimals")
            hint ("pass --decimals comma or --decimals point");
        /// Rows of a time, a thing and a number may be intervals or readings. A heading decides it.
        OpenNumbers { column: usize, intervals: String, readings: String }
            error "ambiguous-numbers" ("the numbers in column {column} may be durations of use or readings")
            hint ("write a first line: {intervals} for intervals in seconds, or {readings} for readings");
        /// Two columns have the same names in them, and neither has a heading that Homebody knows. A `logger.json` decides it:
        ///
        /// ```json
        /// {"columns": {"time": "when", "sensor": "who", "value": "state"}}
        /// ```
        OpenSensors { column: String, other: String }
            error "ambiguous-sensors" ("the columns {column} and {other} have the same values, and neither heading says which column has the sensors")
            hint ("name the column of the sensors with --mapping logger.json");
        /// Such lists have instants as logs have, but their rows are about other things than the sensors of a home.
        OtherList { column: String, content: &'static str }
            error "other-list" ("its column {column} has {content}: it is not a log of sensors")
            hint ("give a log of the sensors of a home");
        /// Rows with a changing latitude and longitude are the track of a person or a vehicle.
        Track error "track" ("its rows are places on a map: it is not a log of a home's sensors")
            hint ("give a log of the sensors of a home");
        /// A calendar has appointments. Homebody reads intervals of activities from a table with these names of columns:
        ///
        /// ```text
        /// start_time,end_time,activity
        /// ```
        Calendar error "calendar" ("it is a calendar: its rows have a subject, a start date and an end date")
            hint ("to read its entries as activities, name its columns start_time, end_time and activity");
        /// The same sensors come again and again in a log. The names of this column hardly come again.
        ManyNames { column: String, names: usize, rows: usize }
            error "many-names" ("the column {column} does not name sensors: its {rows} rows have {names} different names")
            hint ("name the column of the sensors with --mapping logger.json");
        /// The devices are named only inside of sentences, and two devices of a kind would be one sensor.
        DevicesInSentences { column: String, measured: String }
            error "devices-in-sentences" ("only the sentences in the column {column} name the devices; the column {measured} names quantities")
            hint ("write the device of each row into a column of its own, with the heading device");
        /// Values of sensors are numbers or a few words.
        Sentences { column: String }
            error "sentences" ("the column {column} has sentences, and not values of sensors")
            hint ("name the column of the values with --mapping logger.json");
        /// Sensors and values are inside of sentences, which Homebody does not parse.
        RowsInSentences { column: usize }
            error "rows-in-sentences" ("its sensors and values are in the sentences of column {column}")
            hint ("write a table with a column for the time, the sensor and the value");
        /// The texts of one column hardly come again, as those of titles and messages do, so the rows tell of something else than sensors.
        Prose { column: String }
            error "prose" ("the texts in the column {column} hardly recur, so the file is not a log of sensors")
            hint ("give a log with a time, a sensor and a value in each row");
        /// Logs of programs have a column of levels, such as INFO and ERROR.
        ProgramLog { column: String, levels: String }
            error "program-log" ("it is the log of a program: the column {column} has {levels}")
            hint ("give a log with a time, a sensor and a value in each row");
        /// Most rows could not be parsed, so the table is likely to have other columns than Homebody takes them for.
        ManyLost { skipped: u64, rows: u64 }
            error "many-lost" ("Homebody cannot read {skipped} of the {rows} rows: a time, a sensor or a value is missing, or differs in form from the other rows")
            hint ("correct the rows, or name the columns with --mapping logger.json");
        /// `--home-column` names a column of the heading.
        NoHomeColumn { column: String, columns: String }
            error "no-home-column" ("no column is called {column}; the columns are {columns}")
            hint ("name one of these columns in --home-column");
        /// A log is of one home. This one has several, and their sensors may have the same names.
        SeveralHomes { column: String, homes: String, key: String, first: String }
            error "several-homes" ("its rows are of several homes or persons: {column} has {homes}")
            hint ("pass --home-column '{key}={first}' to read one of them, or --home-column '{key}=*' to read all as one home");
        /// `--home-column KEY=HOME` reads the rows of one home.
        NoSuchHome { column: String, home: String, homes: Vec<String> }
            error "no-such-home" ("no row has {home} in {column}")
            advice (Some(match homes.is_empty() {
                true => "check --home-column: no other home is in the log".to_owned(),
                false => format!("the homes are {}", homes.join(", ")),
            }));
    }
}
