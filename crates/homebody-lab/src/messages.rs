use std::path::PathBuf;

homebody_core::messages! {
    /// Problems with the data of an experiment, and results that fail.
    pub enum ExperimentMessage in "experiment" {
        /// Some experiments compare simulations with published data sets. These do not come with Homebody.
        NoData { folder: PathBuf, file: String } error "no-data"
            ("{folder} does not contain {file}", folder = folder.display())
            hint ("download the data set, which is not part of Homebody, and name its folder with --data");
        /// The experiment compares simulations with a published data set, and looks for it in the folder of `--data`.
        NoFolder { folder: PathBuf } error "no-folder" ("the folder {folder} does not exist", folder = folder.display())
            hint ("download the data set, which is not part of Homebody, and name its folder with --data");
        /// The recordings of the SPHERE challenge are folders with `location_0.csv`, `annotations_0.csv` and `pir.csv`.
        NoRecordings { folder: PathBuf } error "no-recordings"
            ("no folder in {folder} contains a file pir.csv", folder = folder.display())
            hint ("name the folder `train` of the SPHERE challenge");
        /// The experiment compares measures from sensors with noted activities, such as sleeping, eating and going out. The log notes
        /// none of those.
        NoActivities { log: String } error "no-activities" ("{log}: no measure corresponds to an activity of this log")
            hint ("homebody inspect LOG lists its activities; docs/reference/logs.md says where Homebody looks for them");
        /// The table of cases that comes with the program is damaged. This is an error of the program: report it.
        Cases { why: String } error "cases" ("cannot read the table of cases: {why}");
        /// Each claim of a sentence must be true in the simulation, or Homebody must warn before the run. The table lists the claims
        /// that fail both.
        ClaimsFail { count: usize } error "claims-fail"
            ("claims that the simulation did not follow, without a warning before the run: {count}");
        /// Each field of a random statement must happen in the simulation, or Homebody must report before the run that it cannot. The table
        /// lists the fields that fail both; `--only` repeats one.
        StatementsFail { count: usize } error "statements-fail"
            ("fields of statements that did not happen, without a report before the run: {count}");
        /// Each kind of impossible event is a row of the table. The experiment succeeds only if all counts are 0.
        Impossible error "impossible-events" ("the simulations have impossible events");
    }
}
