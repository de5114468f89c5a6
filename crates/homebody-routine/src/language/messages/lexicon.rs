//! The messages about a scenario's own words.

homebody_core::messages! {
    /// Problems with `words.txt`, the words that a scenario adds to the routine language.
    pub enum LexiconMessage in "words" {
        /// A file with words has a limit, which is our choice.
        TooManyLines {
            /// The limit.
            most: usize,
        } error "too-many-lines" ("a file with words has at most {most} lines")
            hint ("leave some of them out");
        /// A line of a file with words has one phrase.
        LongLine {
            /// The limit.
            most: usize,
        } error "long-line" ("this line has more than {most} characters")
            hint ("write each phrase on a line of its own");
        /// Words belong to the section above them. A section begins with the label of an activity:
        ///
        /// ```text
        /// [reading]
        /// ~leaf through the paper
        /// ```
        NoSection error "no-section" ("this line has no section above it")
            hint ("write a section above the line, such as \"[reading]\"");
        /// A section in brackets is the label of an activity. A new activity needs a sentence part that describes it.
        UnknownActivity {
            /// The label.
            label: String,
            /// The nearest known label.
            near: Option<String>,
        } error "unknown-activity" ("{label:?} is not a known activity")
            advice (Some(format!(
                "{}describe a new activity after its bracket: \"[tending bonsai] tends the bonsai\"",
                near.as_ref().map_or_else(String::new, |near| format!("did you mean \"[{near}]\"? Or "))
            )));
        /// The usual length of a new activity is a number of minutes.
        Minutes {
            /// The text.
            text: String,
        } error "minutes" ("{text:?} is not a valid usual length")
            hint ("write 1 to 1440 minutes, such as \"40 minutes\"");
        /// The same words cannot have two meanings.
        SameLine {
            /// The line.
            text: String,
        } error "same-line" ("the line {text:?} occurs twice")
            hint ("delete one of the two lines");
        /// In this section, each line has new words, an arrow, and known words with the same meaning.
        NoMeaning {
            /// The line.
            text: String,
        } error "no-meaning" ("the line {text:?} does not give the meaning of its words")
            hint ("write the new words, then \"=>\" and known words: \"settee => sofa\"");
    }
}
