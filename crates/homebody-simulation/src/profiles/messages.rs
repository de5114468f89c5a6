//! The messages about lists of members.

use homebody_core::problem::Advice;
use homebody_core::scenario::GREATEST_SEED;

/// The hint for a name that is not one of the known names.
pub(super) fn among(near: Option<&str>, known: &[&str]) -> Advice {
    match near {
        Some(near) => Advice::meant(near),
        None => format!("there are {}", known.join(", ")).into(),
    }
}

homebody_core::messages! {
    /// Problems with a list of members.
    pub enum ProfileMessage in "members" {
        /// The list of the members of a cohort is a CSV file. Its first line names the columns, and each further line is a member:
        ///
        /// ```text
        /// name,age,conditions
        /// anna,75,
        /// bea,88,depression
        /// ```
        NoFile error "no-file" ("there is no such file")
            hint ("name a CSV file with a row for each member");
        /// The list of the members is one CSV file, and this path is a folder.
        Folder error "folder" ("this is a folder, and a CSV file was expected")
            hint ("name a CSV file");
        /// Names of members may have any letters, so the text of the list must be in one known encoding. Spreadsheets call it
        /// `CSV UTF-8`.
        NotUtf8 error "not-utf-8" ("the file is not text in UTF-8")
            hint ("save it as CSV in UTF-8");
        /// A cell that begins with a double quote ends with another one. Everything after the first one belongs to the cell, across lines.
        OpenQuote error "open-quote" ("the double quote of this cell is never closed")
            hint ("end the cell with a double quote; inside the cell, write each double quote twice");
        /// The list has a line with the names of the columns and no row below it, so the cohort has no member.
        NoMembers error "no-members" ("the list has no members")
            hint ("write a row for each member below the names of the columns");
        /// Homebody numbers the members of a cohort and stores a folder for each. The limit is our choice.
        TooMany { members: usize, most: u32 } error "too-many"
            ("the list has {members} members, and a cohort has at most {most}")
            hint ("split the list, and simulate a cohort of each part");
        /// The list as a whole is sound, but a member cannot be simulated in this scenario. The text quotes the problem that the
        /// scenario has with the values of this row, such as a home without a bed.
        Scenario { place: String, problem: String, problem_code: &'static str, problem_hint: Option<String> }
            error "scenario" ("the values of this row cause a problem at {place}: {problem}")
            advice (problem_hint.clone());
        /// `--without` names a condition that no member has, so that it removes nothing. Conditions come from the column `conditions`
        /// and from the routines.
        NoCondition { condition: String, near: Option<String>, known: Vec<String> } error "no-condition"
            ("no member of the list shows {condition:?}")
            advice (Some(match (near, known.is_empty()) {
                (Some(near), _) => format!("did you mean {near:?}?"),
                (None, true) => "leave the condition out: no member shows one".into(),
                (None, false) => format!("name a condition that the members show: {}", known.join(", ")),
            }));
        /// A column has one place in the list, because a member has one value for it.
        SameColumn { column: String } error "same-column" ("two columns are called {column:?}")
            hint ("delete or rename one of the two columns");
        /// The name of a column decides what its cells mean. `homebody run --help` explains each column.
        UnknownColumn { column: String, known: Advice } error "unknown-column" ("there is no column {column:?}")
            advice (Some(known.clone()));
        /// Each member needs a name: the member's folder gets it. Names stand in the column `name`.
        NoNameColumn { others: Vec<String> } error "no-name-column" ("no column is called \"name\"")
            hint ("write the column names into the first line: name, and any of {others}", others = others.join(", "));
        /// The row has more cells than the first line has names, or the first line has an empty name here.
        NoColumn error "no-column" ("this cell has no column name above it")
            hint ("name the column in the first line, or delete the cell");
        /// Each member needs a name: the member's folder gets it.
        NoName error "no-name" ("this member has no name")
            hint ("write a name into the column \"name\"");
        /// The name of a member is the name of a folder, on every system. Slashes, colons, quotes and some other characters cannot be
        /// in one.
        BadName { name: String } error "bad-name" ("the member name {name:?} is not valid as the name of a folder")
            hint ("use at most 100 letters, digits, spaces, - and _");
        /// Homebody writes the list of the members into a file with this name in the cohort's folder.
        ReservedName { name: String } error "reserved-name"
            ("a member cannot be called {name:?}: the list of the cohort has this name")
            hint ("choose another name");
        /// Two members would share one folder. Upper and lower case count as the same, as some systems have it.
        SameName { name: String } error "same-name" ("two members are called {name:?}")
            hint ("give each member its own name");
        /// A seed decides all randomness of one member. Without one, Homebody makes it from the seed of the scenario and the number of the
        /// member.
        Seed { text: String } error "seed" ("{text:?} is not a valid seed")
            hint ("write a whole number from 0 to {GREATEST_SEED}, or leave the cell empty");
        /// The row changes a resident, and every resident of this scenario follows a path or a script. Only routines have an age, a pace or
        /// conditions.
        NoRoutine error "no-routine" ("this cell changes a routine, and no resident of the scenario has one")
            hint ("give a resident a routine, or leave this cell empty");
        /// The scenario has several residents with routines, and the row changes one of them.
        WhichResident { residents: Vec<String> } error "which-resident"
            ("the list does not say which resident this row changes")
            hint ("add a column \"resident\" with the value {residents}", residents = residents.join(" or "));
        /// The column `resident` names the resident that the row changes. The resident must have a routine.
        NoResident { name: String, known: Advice } error "no-resident" ("no resident with a routine is called {name:?}")
            advice (Some(known.clone()));
        /// The column `routine` or `home` names a file in the scenario's folder.
        Unreadable { file: String, why: String, kind: String } error "unreadable" ("cannot read {file:?}: {why}")
            hint ("name the file of a {kind} in the scenario's folder");
        /// Ages and paces are numbers above 0, such as `82` and `0.65`.
        Number { text: String, what: &'static str } error "number" ("{text:?} is not a valid {what}")
            hint ("write a number above 0 with a decimal point, such as 0.65");
        /// Severity, onset, `over` and `until` describe conditions, and this member has none.
        NothingToDescribe error "no-condition-in-row" ("this cell describes a condition, and the row has no condition")
            hint ("write a condition into the column \"conditions\", or leave this cell empty");
        /// A member with several conditions has one value for all of them, or one for each in the same order:
        ///
        /// ```text
        /// name,conditions,severity
        /// anna,depression + insomnia,mild + severe
        /// ```
        ValueCount { values: usize, conditions: usize } error "value-count"
            ("the cell has {values} values for {conditions} conditions")
            hint ("write one value for all conditions, or one for each with + between");
        /// A member shows a condition once, in one severity.
        SameCondition { condition: String } error "same-condition" ("the condition {condition:?} occurs twice")
            hint ("delete one of the two");
        /// The column `severity` scales a condition.
        Severity { text: String, known: Advice } error "severity" ("{text:?} is not a valid severity")
            advice (Some(known.clone()));
        /// Homebody builds a sentence of the routine language from the cells of a row. A cell has letters, digits, spaces, hyphens,
        /// points and percent signs.
        NotPlain { text: String } error "not-plain" ("cannot read {text:?}")
            hint ("use only letters, digits, spaces, hyphens, points and %, with + between several values");
        /// The sentence that Homebody builds from this cell has another meaning than its column, such as a habit in the column
        /// `conditions`.
        OtherMeaning { sentence: String } error "other-meaning"
            ("the cell makes the sentence {sentence:?}, which does not fit this column")
            hint ("write only values of this column, with + between several");
    }
}
