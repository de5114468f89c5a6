//! The messages of this crate.

homebody_core::messages! {
    /// Files and data sets in Parquet or Arrow IPC.
    pub(crate) enum ColumnsMessage in "parquet" {
        /// The file was copied while a program wrote it, or the copy is not complete. Parquet has its table of contents at the end of the
        /// file, so nothing can be read from the beginning alone.
        Damaged { form: &'static str, reason: String }
            error "damaged" ("it begins as {form}, but is damaged or cut short: {reason}")
            hint ("copy the file again, or restore it");
        /// Homebody tells the two forms by the first bytes of a file, and these are of neither.
        OtherForm error "other-form" ("it is neither Parquet nor Arrow IPC")
            hint ("remove \"parquet:\" or \"arrow:\" before the name, so that Homebody recognises the form");
        /// Homebody looks at each file of a data set before it reads the first row, so it limits their number.
        ManyFiles { most: usize }
            error "many-files" ("the data set has more than {most} files")
            hint ("name a part of the data set, such as one run");
        /// The parts of a file have different columns.
        MissingColumn error "missing-column" ("a part of the file lacks a column")
            hint ("write the file again from its source");
        /// Homebody finds the columns of time, sensor and value by their names, or as an instant followed by two texts. `--mapping logger.json`
        /// names them:
        ///
        /// ```json
        /// {"columns": {"time": "when", "sensor": "what", "value": "state"}}
        /// ```
        NoColumns { columns: String }
            error "missing-columns" ("cannot find columns of time, sensor and value among {columns}")
            hint ("name the columns with --mapping logger.json");
        /// The time must be an instant, a number or a text; sensor and value must be texts, numbers or truth values.
        ColumnType { column: String }
            error "column-type" ("the column {column:?} has a type that Homebody cannot read as a time, a sensor or a value")
            hint ("write times as timestamps, and sensors and values as text or numbers");
        /// The types at the beginning of the file are not those of its parts.
        OtherType error "other-type" ("a column has another type than the file declares")
            hint ("write the file again from its source");
        /// The table of activities of a log has two instants and a text.
        ActivityType error "activity-type" ("a column of its table of activities has another type than a run writes")
            hint ("restore the file, or remove it to read the log without activities");
        /// A data set is a folder with files in folders such as `run=1/day=2009-03-02`.
        NoFiles error "no-files" ("the folder has no .parquet file, and neither has a subfolder such as run=1/day=2009-03-02")
            hint ("name a file, or the folder of a data set");
        /// A log is of one run. A data set may have several, each in a folder of its own.
        SeveralRuns { runs: Vec<String> }
            error "several-runs" ("it is a data set of several runs")
            hint ("name one of {runs}", runs = runs.join(", "));
        /// A resumed run makes the same rows again and compares them with those in the file. One row differs: the file was changed, or
        /// the scenario has changed since.
        OtherRows { first: usize, last: usize }
            error "other-rows" ("one of its rows {first} to {last} differs from the row of the run")
            hint ("restore the file, or start a new run");
        /// The columns come from `logger.json`, which has changed since the run began.
        OtherColumns error "other-columns" ("it has other columns than the run")
            hint ("restore the file, or start a new run");
        /// The data set has a file of a day that the run did not reach this time: the run was stopped earlier than before, or another
        /// program has added the file.
        ExtraFile error "extra-file" ("the file is of a day that the run did not reach")
            hint ("let the run last as long as before, or remove the file");
        /// A data set has a file for each day. A log that jumps between days would make a file for each jump.
        Disorder error "disorder" ("rows that are not in order of time")
            hint ("write the rows to one file, such as \"parquet:log.parquet\"");
        /// A data set is a folder. A file with this name exists.
        NotFolder error "not-a-folder" ("it is not a folder, but a data set must be a folder")
            hint ("choose another name, or write to one file, such as \"parquet:log.parquet\"");
    }
}

#[cfg(feature = "cloud")]
homebody_core::messages! {
    /// Object stores, such as S3.
    pub(crate) enum StoreMessage in "object-store" {
        /// The store has no bucket or file of this name.
        NotFound { answer: String }
            error "not-found" ("no such bucket or file: {answer}")
            hint ("correct the URL, or create the bucket");
        /// The store does not know the user, or the user may not read or write there. Homebody takes names and keys from the environment, as
        /// the tools of AWS do.
        Denied { answer: String }
            error "denied" ("the store denies access: {answer}")
            hint ("set AWS_ACCESS_KEY_ID and AWS_SECRET_ACCESS_KEY, or give the machine a role");
        /// The store cannot be reached, or answers something that Homebody does not expect. A run tries again for some time.
        NoAnswer { answer: String }
            error "no-answer" ("the store does not answer as expected: {answer}")
            hint ("set AWS_ENDPOINT and AWS_REGION, and check the network");
    }
}

/// The messages of this crate, by area.
pub const MESSAGES: &[&[homebody_core::messages::CatalogueEntry]] = &[
    <ColumnsMessage as homebody_core::messages::Catalogue>::ENTRIES,
    #[cfg(feature = "cloud")]
    <StoreMessage as homebody_core::messages::Catalogue>::ENTRIES,
];
