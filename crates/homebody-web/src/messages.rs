//! The messages of the server. Each is the reason for a refused request, and the page shows it as a sentence.

use homebody_core::problem::counted;
use homebody_log::run::places::RUNS;

homebody_core::messages! {
    /// Reasons why the server refuses a request about runs, logs or notes.
    #[derive(Clone, PartialEq, Eq)]
    pub enum PageMessage in "page" {
        /// The folder of runs has no run of this name. Another window may have deleted it.
        NoRun {
            /// The name of the run.
            run: String,
        } error "no-run" ("there is no run {run:?}");
        /// A run has as many days as its length. The first is day 0.
        NoDay {
            /// The name of the run.
            run: String,
            /// The number of its days.
            days: usize,
        } error "no-day" ("the run {run:?} has no such day: it has {count}, numbered from 0", count = counted(*days, "day", "days"));
        /// The address of a request has a number of a day or an instant, and it is not a number.
        Number error "invalid-number" ("the address has an invalid number: days count from 0, and times are in microseconds");
        /// Silhouettes exist only for runs whose home has cameras.
        NoSilhouettes {
            /// The name of the run.
            run: String,
        } error "no-silhouettes" ("the run {run:?} has no silhouettes");
        /// Homebody reads a long log while the page shows its first days. The part that was requested is not read yet.
        StillReading error "still-reading" ("Homebody is still reading this run");
        /// A search between two times of day needs two different times.
        SameHours error "same-hours" ("the two times of day must differ");
        /// A search for spans has a shortest duration.
        Duration error "duration" ("the shortest duration must be a number of seconds");
        /// The page analyses a log in memory, and its limit protects the memory. The commands have no such limit.
        LogTooLong {
            /// The name of the log.
            log: String,
            /// The number of its rows.
            rows: u64,
            /// The limit.
            limit: u64,
        } error "log-too-long" ("the log {log:?} is too long for this page: it has {rows} rows, and the limit is {limit}");
        /// The page reads and writes in the folder of the run only. A link leads elsewhere.
        LinkOutside {
            /// The name of the file.
            file: String,
        } error "link-outside" ("the file {file} is a link to a place outside the folder of the run");
        /// A run has a title and a note, which the page shows in its lists.
        TitleLength {
            /// Largest number of characters of the title.
            title: usize,
            /// Largest number of characters of the note.
            note: usize,
        } error "title-length" ("the name of a run has at most {title} characters, and its note at most {note}");
        /// A file in the folder of the run cannot be read, or it is not what Homebody wrote.
        NotRead {
            /// The name of the file.
            file: String,
            /// The reason.
            why: String,
        } error "not-read" ("cannot read {file}: {why}");
        /// A file in the folder of the run cannot be written.
        NotWritten {
            /// The name of the file.
            file: String,
            /// The reason.
            why: String,
        } error "not-written" ("cannot write {file}: {why}");
        /// The page deletes a run or a home by moving its folder into a hidden folder. That was not possible.
        NotDeleted {
            /// The name.
            name: String,
            /// The reason.
            why: String,
        } error "not-deleted" ("cannot delete {name}: {why}");
        /// Deleted runs and homes are in a hidden folder until a person removes them there. It has none with this key.
        NothingDeleted {
            /// `run` or `home`.
            kind: &'static str,
            /// The key.
            key: String,
        } error "nothing-deleted" ("there is no deleted {kind} {key:?}");
        /// A deleted run or home comes back under its old name, and something has that name now.
        NameTaken {
            /// `run` or `home`.
            kind: &'static str,
            /// The name.
            name: String,
        } error "name-taken" ("another {kind} now has the name {name}")
            advice ((*kind == "home").then(|| "rename the other home first".to_owned()));
        /// A deleted run or home cannot be moved back.
        NotRestored {
            /// The key.
            key: String,
            /// The reason.
            why: String,
        } error "not-restored" ("cannot restore {key}: {why}");
        /// A note is about a day of a run.
        NoteDay error "note-day" ("a note needs a day, such as 2009-03-02");
        /// The limit of a note keeps the list of notes readable.
        NoteLength {
            /// Largest number of characters.
            limit: usize,
        } error "note-length" ("a note has at most {limit} characters");
        /// The limit of the notes of a run keeps their file small.
        TooManyNotes {
            /// Largest number of notes.
            limit: usize,
        } error "too-many-notes" ("this run has too many notes: the limit is {limit}");
        /// Another window has changed this note since the page read it. The page does not replace what it has not seen.
        NoteChanged error "note-changed" ("this note was changed in another window");
        /// A run that is being simulated cannot be deleted.
        RunRunning error "run-running" ("a run cannot be deleted while it is running")
            hint ("stop the run first");
        /// A plan of another program comes into memory, and its limit protects the memory.
        PlanTooLarge {
            /// The limit.
            limit_mb: u64,
        } error "plan-too-large" ("the plan is too large: the limit is {limit_mb} MB");
        /// A log that the page sends comes into memory, and its limit protects the memory. The commands have no such limit.
        LogTooLarge {
            /// The limit.
            limit_mb: u64,
            /// The command for larger logs.
            command: &'static str,
        } error "log-too-large" ("the log is too large for the page: the limit is {limit_mb} MB")
            hint ("for a larger log, use {command}");
        /// The connection ended before all of the log had arrived.
        LogIncomplete error "log-incomplete" ("the connection ended before the whole log had arrived")
            hint ("send the log again");
        /// Homebody locates the people of one log at a time.
        Locating {
            /// The name of the log.
            log: String,
        } error "locating" ("Homebody is still locating people in {log}")
            hint ("wait until it has finished, or stop it");
        /// The page locates people in memory, and its limit protects the memory.
        TooManyRows {
            /// The number of rows of the log.
            rows: usize,
            /// The limit.
            limit: usize,
        } error "too-many-rows" ("the log has {rows} rows; the limit of the page is {limit}")
            hint ("open a shorter log, or use the command homebody locate, which has no limit");
        /// The page locates people in memory, and its limit protects the memory.
        TooManyDays {
            /// The number of days that the log covers.
            days: usize,
            /// The limit.
            limit: i64,
        } error "too-many-days" ("the log covers {days}; the limit of the page is {limit}", days = counted(*days, "day", "days"))
            hint ("open a shorter log, or use the command homebody locate, which has no limit");
        /// Homebody has an error. The log is not changed.
        LocatingBroke error "locating-broke" ("cannot locate people because of an error in Homebody");
        /// A model answers one text at a time.
        FreeTextBusy error "free-text-busy" ("another text is still becoming statements")
            hint ("wait until it has finished, or cancel it");
        /// Another window has started another text, or the server was started anew.
        FreeTextOther error "free-text-other" ("these rows are not the latest any more")
            hint ("make the sentences again");
        /// Homebody has an error. Nothing is changed.
        FreeTextBroke error "free-text-broke" ("cannot read the text because of an error in Homebody");
        /// The file underlay.json names an image in the folder of the scenario, and the image is not there.
        NoImage error "no-image" ("the home has no image beneath its plan");
        /// A run has a recording, and a log where its logger writes a file.
        NoFile error "no-file" ("this run does not have this file");
        /// The system reports an error, for example that a file cannot be opened.
        System {
            /// The message of the system.
            why: String,
        } error "system" ("the server cannot answer: {why}");
        /// The server answers requests under the address that it printed, so that a page of another server cannot reach it under a name of
        /// its own.
        ForeignHost error "foreign-host" ("this server answers only at the address that it printed, not at this host name");
        /// The browser sends the address of the page with a request. It was the page of another server.
        ForeignPage error "foreign-page" ("this server answers requests from its own page only");
        /// Requests carry the token of the address that the server printed. A server without `--address-file` makes a new token when it
        /// starts.
        Token error "token" ("the token is missing or wrong");
    }
}

homebody_core::messages! {
    /// Reasons why the server refuses a request about the homes of a library.
    #[derive(Clone, PartialEq, Eq)]
    pub enum LibraryMessage in "library" {
        /// The folder has no home of this name. Another window may have renamed or deleted it.
        NoHome {
            /// The name.
            name: String,
        } error "no-home" ("there is no home named {name} here");
        /// The runs of a home are in its folder. A link would lead them elsewhere.
        LinkedRuns {
            /// The name of the home.
            name: String,
        } error "linked-runs"
            ("{name}/{RUNS} is a link, and Homebody does not write runs outside the folder of the home")
            hint ("remove the link");
        /// Each home of a library has a name of its own, which is the name of its folder.
        NameUsed {
            /// The name.
            name: String,
        } error "name-used" ("the name {name} is already in use here")
            hint ("choose another name");
        /// The name of a home is the name of its folder on any system.
        InvalidName {
            /// The name.
            name: String,
            /// The faults of the name.
            why: Vec<String>,
        } error "invalid-name" ("{name:?} is not a valid name for a home: {}", why.join("; "));
        /// The folder of the library cannot be written, for example because it belongs to another user.
        NotWritable {
            /// The folder.
            folder: String,
            /// The reason.
            why: String,
        } error "not-writable" ("cannot write to {folder}: {why}");
        /// Each open home has a thread and a run at its start. A home without a page and without a simulation makes room for another.
        TooManyOpen {
            /// The limit.
            limit: usize,
        } error "too-many-open" ("{limit} homes are already open, each with a page or a running simulation")
            hint ("stop the simulation of another home, and close its page");
        /// The page copies plain files and folders only: a link may lead elsewhere.
        NotPlain {
            /// The path.
            path: String,
        } error "not-plain" ("{path} is a link or a special file, which Homebody does not copy")
            hint ("copy the folder with another program");
        /// A copy has limits, so that it does not fill the disk.
        TooLarge {
            /// The folder.
            folder: String,
            /// Largest number of files.
            files: usize,
            /// Largest size of the files.
            limit_mb: u64,
        } error "too-large" ("cannot copy {folder}: it has more than {files} files or {limit_mb} MB");
        /// A copy has limits, so that it ends.
        TooDeep {
            /// The folder.
            folder: String,
            /// Largest depth.
            limit: usize,
        } error "too-deep" ("cannot copy {folder}: its folders are nested more than {limit} deep");
        /// A file or folder of the home cannot be read or written.
        NotCopied {
            /// The file or folder.
            path: String,
            /// The reason.
            why: String,
        } error "not-copied" ("cannot copy {path}: {why}");
        /// A home that was copied or renamed has the name of its folder in its scenario, too. That name cannot be written.
        NotNamed {
            /// The file.
            file: String,
            /// The reason.
            why: String,
        } error "not-named" ("cannot write the new name into {file}: {why}");
    }
}

homebody_core::messages! {
    /// Problems with the files of a scenario that are written in the page.
    #[derive(Clone, PartialEq, Eq)]
    pub enum DraftMessage in "desk" {
        /// A request to save has each file once.
        SameFile error "same-file" ("the request names a file twice");
        /// The page writes the files of a scenario: those that end in .json or .routine, in its folder or in the folder of conditions.
        FileName {
            /// The name.
            name: String,
        } error "file-name" ("{name:?} is not a valid file name in this scenario");
        /// A file of the scenario cannot be written. The page keeps its text.
        NotWritten {
            /// The name of the file.
            file: String,
            /// The reason.
            why: String,
            /// The way to solve it, where it is known.
            solution: Option<String>,
            /// The files that were written before.
            written: Vec<String>,
        } error "not-written" (
            "cannot write {file:?}: {why}{before}",
            before = if written.is_empty() { String::new() } else { format!("; already written: {}", written.join(", ")) }
        )
            advice (solution.clone());
        /// The folder of the scenario was deleted while the page showed it.
        NoFolder {
            /// The reason.
            why: String,
        } error "no-folder" ("the folder of the scenario was deleted, and Homebody cannot create it again: {why}");
        /// A draft names a file that cannot be read.
        NotRead {
            /// The name of the file.
            file: String,
            /// The reason.
            why: String,
        } error "not-read" ("cannot read {file:?}: {why}");
        /// The file of the scenario is not JSON.
        NotJson {
            /// The reason, with the line and the column.
            why: String,
        } error "not-json" ("cannot parse the file: {why}");
        /// The file of the scenario names the file of its home:
        ///
        /// ```json
        /// { "home": "home.json" }
        /// ```
        NoHome error "no-home" ("scenario.json does not name the file of the home")
            hint ("add the name of the file, such as \"home\": \"home.json\"");
        /// The page explains a routine as its resident uses it. This routine has no resident.
        UnusedRoutine error "unused-routine" ("no resident uses this routine");
        /// The form of *Life* writes sentences in English. A routine in another language does not read them.
        OtherLanguage error "other-language" ("this routine is in another language, and the form writes English sentences")
            hint ("write the sentence as text");
        /// A sentence says something about the resident. The statement of the form has no value yet that a sentence says.
        NothingSaid error "nothing-said" ("the statement says nothing yet")
            hint ("fill in a field");
        /// The form replaces the sentence of a statement. Another window may have changed the routine.
        NoStatement error "no-statement" ("the routine has no such statement any more")
            hint ("close the form and open it again");
        /// A routine is about one person, whose age, pace and rests are one statement.
        SecondPerson error "second-person" ("the routine already has a statement about the person")
            hint ("edit that statement");
        /// The program reads the text again with the new sentence. Another sentence of it then has another meaning, for example because
        /// of the heading above it.
        ChangesOthers error "changes-others" ("here the sentence changes the meaning of another sentence")
            hint ("put it after another sentence, or write it as text");
        /// The program reads the sentence of a statement again. It then reads another value of a field: the language has no words for the
        /// value of the form.
        NotSaid {
            /// The JSON pointer of the field.
            field: String,
        } error "not-said" ("no sentence says this value")
            hint ("choose another value, or leave the field empty");
        /// A sheet has the devices of a home. The file of this home has problems.
        HomeProblems {
            /// The problems, each with its file.
            problems: Vec<String>,
        } error "home-problems" ("the home has problems: {}", problems.join("; "));
        /// A suggestion of sensors has goals, as `homebody suggest-sensors` has. These have other names.
        UnknownGoals {
            /// The names.
            goals: Vec<String>,
        } error "unknown-goals" ("unknown goals: {}", goals.join(", ").escape_debug());
        /// A suggestion of sensors has at least one goal.
        NoGoals error "no-goals" ("choose at least one goal");
        /// Homebody knows some models of motion sensors. This name is another.
        UnknownDevice {
            /// The name.
            device: String,
        } error "unknown-device" ("the device {device:?} is not known");
        /// A condition changes a routine, and the first resident has another driver. The floor that sensors see needs no resident.
        NoRoutine error "no-routine" ("the first resident has no routine, so no condition can be simulated")
            hint ("choose only the goal “Most of the floor”");
    }
}

homebody_core::messages! {
    /// Problems with the run of the live view.
    #[derive(Clone, PartialEq, Eq)]
    pub enum StageMessage in "stage" {
        /// A seed is a whole number that JavaScript holds exactly.
        Seed error "seed" ("the seed must be a whole number below 9007199254740992, which is 2 to the power of 53");
        /// A step continues a paused run.
        Step error "step" ("the step is too long: the limit is one day");
        /// A run goes so many times as fast as the clock.
        Speed error "speed" ("the speed must be 0.1 to 1000 times real time");
        /// The page sends commands faster than the run obeys them.
        Busy error "busy" ("the run is still busy with earlier commands and dropped this one")
            hint ("try again a little later");
        /// The residents of a scenario are numbered from 0. The page asked for one that is not there.
        NoResident {
            /// The number.
            number: usize,
        } error "no-resident" ("there is no resident with the number {number}");
        /// A driver of another program moved a resident in this run. The recording does not contain that driver.
        OwnDrivers {
            /// The names of the residents.
            residents: Vec<String>,
        } error "own-driver" ("cannot replay this run: a driver of another program moved {}", residents.join(", "));
        /// A replay has the same events as its recording. Another version of Homebody may have simulated it differently.
        Differs error "replay-differs" ("the replay differs from the recording");
        /// Homebody has an error. The scenario is not changed.
        NotStarted {
            /// The message of the error.
            why: String,
        } error "not-started" ("cannot start the run because of an error in Homebody: {why}");
        /// Homebody has an error, or a driver of another program has. The rows up to here are stored.
        Broke {
            /// The message of the error.
            why: String,
            /// The state of the files of the run, as a sentence.
            files: String,
        } error "broke" ("the run stopped because of an error in Homebody: {why}. {files}")
            hint ("start a new run");
    }
}
