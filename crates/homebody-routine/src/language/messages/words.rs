//! The messages about words and names.

use homebody_core::problem::Advice;

homebody_core::messages! {
    /// Problems with a word or a name in a routine.
    pub enum WordMessage in "routine" {
        /// After this word, a sentence has a place of the home or a time. Homebody knows the words as neither.
        UnknownPlaceOrTime {
            /// The words.
            text: String,
            /// The hint, with the nearest name or all of them.
            help: Option<Advice>,
        } error "unknown-place-or-time" ("{text:?} is neither a place in this home nor a time")
            advice (help.clone());
        /// Homebody does not know the verb or its object. The reference of the routine language lists the activities. A new activity needs
        /// a place and a duration:
        ///
        /// ```text
        /// She collects stamps at the desk for 40 minutes.
        /// ```
        UnknownVerb {
            /// The words.
            text: String,
            /// The hint.
            help: Option<Advice>,
        } error "unknown-verb" ("{text:?} is not a known activity")
            advice (help.clone());
        /// The reader of routines expected something else in this part of the sentence. The rest of the sentence may be correct.
        NotUnderstood {
            /// The words.
            text: String,
            /// The hint.
            help: Option<Advice>,
        } error "not-understood" ("cannot read {text:?} here")
            advice (help.clone());
        /// Only a thing of the home can be on during an activity. Lamps belong to their rooms; a television or a radio is a piece of furniture.
        NoThing {
            /// The thing.
            thing: String,
        } error "no-thing" ("this home has no {thing}")
            hint ("add a piece of furniture with the name {thing:?} to \"furniture\" in home.json, or leave these words out");
        /// Visitors are people with a relation or a profession, so that the routine says who comes.
        UnknownVisitor {
            /// The name.
            name: String,
        } error "unknown-visitor" ("{name:?} is not a known visitor")
            hint ("write the relation or the profession: \"her daughter visits\" or \"a nurse visits\"");
        /// A routine describes one person. Each resident has a routine of its own.
        OtherPerson {
            /// The person of the routine.
            person: String,
            /// The name.
            name: String,
            /// The hint.
            help: Advice,
        } error "other-person" ("this routine is about {person:?}, not about {name:?}")
            advice (Some(help.clone()));
        /// A file with a condition describes changes that hold for every person who shows it.
        ConditionName {
            /// The name.
            name: String,
        } error "condition-name" ("a condition holds for any person, so it cannot name {name:?}")
            hint ("write \"she\", \"he\", \"they\" or \"the person\"");
        /// A condition describes changes that hold for every person who shows it, so it cannot state facts such as an age.
        ConditionFact {
            /// The words.
            text: String,
        } error "condition-fact" ("a condition holds for any person, so it cannot state {text:?}")
            hint ("write a change: \"she walks 10 % slower\"");
        /// A routine may use the person's name after it has introduced the person.
        UnknownPerson {
            /// The name.
            name: String,
        } error "unknown-person" ("the routine does not introduce {name:?}")
            hint ("begin with \"{name} is 82.\"");
        /// Each sentence has a person who does something.
        NoSubject {
            /// The hint.
            help: String,
        } error "no-subject" ("the sentence does not say who does this")
            hint ("{help}");
        /// The sentence begins with words that are neither the person of the routine nor a visitor.
        NotAPerson {
            /// The words.
            text: String,
        } error "not-a-person" ("{text:?} is neither the person of this routine nor a known visitor")
            hint ("a sentence says who does what: \"she gets up at about 06:45\", \"her daughter visits on Sunday\"");
        /// Homebody includes some conditions. A scenario can add its own as `conditions/NAME.routine`.
        UnknownCondition {
            /// The words.
            text: String,
            /// The hint, with the nearest name or all of them.
            help: Option<Advice>,
        } error "unknown-condition" ("{text:?} is not a known condition")
            advice (help.clone());
        /// A comparison of two names that differ by a letter: probably one of them is a mistake.
        SimilarVisitors {
            /// The name here.
            name: String,
            /// The name in another sentence.
            other: String,
        } error "similar-visitors" ("the visitors {name:?} and {other:?} have nearly the same name")
            hint ("did you mean {other:?}?");
    }
}
