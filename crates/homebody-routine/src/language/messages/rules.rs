//! The messages about rules.

homebody_core::messages! {
    /// Problems with a rule of a routine: a sentence with "whenever".
    pub enum RuleSentenceMessage in "routine" {
        /// A rule says what the person of the routine does.
        NotTheResident {
            /// The words.
            text: String,
        } error "not-the-resident" ("a rule is about the person of the routine, not about {text:?}")
            hint ("write what the person does: \"..., she turns it off\"");
        /// A rule has a second part with an activity.
        NoAnswer error "no-answer" ("the rule does not say what she does then")
            hint ("end the rule with an activity: \"..., she turns it off\"");
        /// "It" stands for the thing that the first part of the rule names. Here the first part names none.
        WhichThing error "which-thing" ("the rule does not say what \"it\" is")
            hint ("write the name of the thing instead of \"it\"");
        /// A thing can be turned on or off.
        OnOrOff error "on-or-off" ("the rule does not say whether she turns the thing on or off")
            hint ("write \"she turns it off\"");
        /// A rule has one activity with a place and a duration. It cannot change a habit.
        ChangeInRule {
            /// The words.
            text: String,
        } error "change-in-rule" ("{text:?} does not fit here: a rule has an activity, not a change");
        /// "Otherwise" and "after that" continue the rule before.
        NoRuleBefore error "no-rule-before" ("this rule continues another rule, and no rule stands before it")
            hint ("write what starts the rule: \"whenever she has eaten lunch\"");
        /// After "and", "if", "while" or "unless", a rule has a circumstance.
        NoCircumstance error "no-circumstance" ("cannot read the circumstance of this rule")
            hint ("write \"and she is alone\", \"and it is dark\", \"unless she is in bed\" or \"and the lamp is off\"");
        /// A rule about the person begins with a place or a state that lasts.
        NoWhere error "no-where" ("the rule does not say where she is")
            hint ("write \"she has been in the bathroom for 45 minutes\"");
        /// A rule about a thing begins with its state.
        NoState {
            /// The thing.
            thing: String,
        } error "no-state" ("the rule does not name a state of the {thing}")
            hint ("write \"the {thing} has been on for 20 minutes\" or \"has been open for 5 minutes\"");
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
