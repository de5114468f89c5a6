//! The messages about words and names.

use homebody_core::problem::Advice;

homebody_core::messages! {
    /// Problems with a word or a name in a routine.
    pub enum WordMessage in "routine" {
        /// Places of a routine are the places, the pieces of furniture and the rooms that `home.json` names.
        UnknownPlace {
            /// The words.
            text: String,
            /// The hint, with the nearest name or all of them.
            help: Option<Advice>,
        } error "unknown-place" ("{text:?} is not a place in this home")
            advice (help.clone());
        /// After this word, a sentence has a place of the home or a time. Homebody knows the words as neither.
        UnknownPlaceOrTime {
            /// The words.
            text: String,
            /// The hint, with the nearest name or all of them.
            help: Option<Advice>,
        } error "unknown-place-or-time" ("{text:?} is neither a place in this home nor a time")
            advice (help.clone());
        /// Things of a routine are the doors and the pieces of furniture that `home.json` names.
        UnknownThing {
            /// The words.
            text: String,
            /// The hint, with the nearest name or all of them.
            help: Option<Advice>,
        } error "unknown-thing" ("{text:?} is not a thing in this home")
            advice (help.clone());
        /// A routine rings a bell or a telephone that the home has as a piece of furniture.
        NothingRings {
            /// The words.
            text: String,
        } error "nothing-rings" ("no bell or telephone of this home fits {text:?}")
            hint ("add the bell or telephone to \"furniture\" in home.json, under the name that the sentence uses");
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
        /// The sentence begins with words for a person or a thing, and Homebody cannot read the rest.
        UnknownAction {
            /// The words at the beginning.
            text: String,
        } error "unknown-action" ("cannot read what {text:?} does")
            hint ("write \"she reads\" for the person of the routine, or \"her daughter visits on Sunday\"");
        /// This word names an activity, such as lunch, and not a person.
        NotAVisitor {
            /// The words.
            text: String,
            /// The activity, as a part of a sentence.
            activity: String,
        } error "not-a-visitor" ("{text:?} is not a visitor")
            hint ("write \"she {activity}\", or name the visitor: \"her daughter visits\"");
        /// Things change only when a person uses them.
        ThingActs {
            /// The words.
            text: String,
            /// The name of the thing.
            thing: String,
        } error "thing-acts" ("{text:?} cannot act by itself")
            hint ("write what she does: \"she forgets the {thing} rarely\"");
        /// Visitors come, bring things and help. They have no routine of their own here.
        VisitorActs {
            /// The words.
            text: String,
            /// The name of the visitor.
            visitor: String,
        } error "visitor-acts" ("a sentence about {text:?} can only describe a visit")
            hint ("write \"her {visitor} visits on Sunday for 2 hours\"");
        /// The sentence begins with words that are neither the person of the routine nor a visitor.
        NotAPerson {
            /// The words.
            text: String,
        } error "not-a-person" ("{text:?} is neither the person of this routine nor a known visitor")
            hint ("a sentence says who does what: \"she gets up at about 06:45\", \"her daughter visits on Sunday\"");
        /// Homebody includes some conditions. A scenario can add its own as `conditions/NAME.routine`.
        UnknownCondition {
            /// The words, perhaps none at all.
            text: String,
            /// The hint, with the nearest name or all of them.
            help: Option<Advice>,
        } error "unknown-condition"
            ("{name} is not a known condition", name = if text.is_empty() { "this".to_owned() } else { format!("{text:?}") })
            advice (help.clone());
        /// A routine describes habits, in the present tense.
        PastTense {
            /// The words.
            text: String,
            /// The verb in the present tense.
            verb: String,
        } error "past-tense" ("{text:?} is in the past tense, and a routine describes habits")
            hint ("write it in the present tense: \"she {verb} ...\"");
        /// The hours, the pulse and the breathing of a person can change in a few ways only.
        BodyChange {
            /// The words at the beginning.
            text: String,
        } error "body-change" ("cannot read the change of {text:?}")
            hint ("write \"her hours vary twice as much\", \"her pulse rises by 20 beats\" or \"her breathing rises by 6 breaths a minute\"");
        /// Meals have different times, so a sentence about eating names one.
        WhichMeal {
            /// The words.
            text: String,
            /// The names of the meals.
            meals: Vec<String>,
        } error "which-meal" ("{text:?} does not name the meal")
            hint ("name the meal: {meals}", meals = meals.join(", "));
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
