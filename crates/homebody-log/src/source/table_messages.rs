//! Why a table is not a log that Homebody reads.

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
