//! The messages about rules.

homebody_core::messages! {
    /// Problems with a rule of a routine: a sentence with "whenever".
    pub enum RuleSentenceMessage in "routine" {
        /// "It" stands for the thing that the first part of the rule names. Here the first part names none.
        WhichThing error "which-thing" ("the rule does not say what \"it\" is")
            hint ("write the name of the thing instead of \"it\"");
        /// A rule has one activity with a place and a duration. It cannot change a habit.
        ChangeInRule {
            /// The words.
            text: String,
        } error "change-in-rule" ("{text:?} does not fit here: a rule has an activity, not a change");
        /// "Otherwise" and "after that" continue the rule before.
        NoRuleBefore error "no-rule-before" ("this rule continues another rule, and no rule stands before it")
            hint ("write what starts the rule: \"whenever she has eaten lunch\"");
        /// A state starts a rule after it has lasted for some time.
        NoLength error "no-length" ("the rule does not say how long the state lasts")
            hint ("add a duration, such as \"for 20 minutes\"");
        /// A state that has lasted for no time is the state itself, so the rule would start at once, again and again.
        Always {
            /// The words.
            text: String,
        } error "always" ("after {text:?}, this rule would start all the time")
            hint ("write a longer time, such as \"for 20 minutes\"");
    }
}
