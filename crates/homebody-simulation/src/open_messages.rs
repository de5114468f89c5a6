//! The messages about files that a command names.

homebody_core::messages! {
    /// Problems with a file that a command names.
    pub enum OpenMessage in "open" {
        /// A scenario is a folder with a file `scenario.json`, or such a file.
        NoScenario { template: Option<String>, near: Option<String> } error "no-scenario" ("there is no such scenario")
            advice (Some(match (template, near) {
                (Some(name), _) => format!("this is the name of a template: run homebody new {name} --template {name}"),
                (None, Some(near)) => format!("did you mean {near:?}?"),
                (None, None) => "name a scenario's folder, or its scenario.json".into(),
            }));
        /// A folder is a scenario if it has a file `scenario.json`.
        NoEntry error "no-scenario-file" ("there is no such file")
            hint ("name a folder with a scenario.json");
        /// A device or a pipe has the name of a scenario's file.
        NotPlain error "not-plain" ("this is not a regular file")
            hint ("name a folder with a scenario.json");
        /// The recording of a run is a file in the run's folder.
        RecordingFolder error "recording-folder" ("this is a folder, and a recording was expected")
            hint ("name the recording.json in the folder");
        /// Homebody reads the tables that it writes itself, with the same columns.
        BadRow { table_line: u64 } error "bad-row" ("line {table_line} is not a row of this table")
            hint ("locate the residents again: the table was changed");
        /// The table is longer than a run of some years can make it.
        TooManyRows { most: usize } error "too-many-rows" ("the table of located residents has more than {most} rows")
            hint ("locate the residents again, with a shorter log");
    }
}
