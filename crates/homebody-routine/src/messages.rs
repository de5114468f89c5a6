//! The messages about households: conditions, and the needs of residents.

use homebody_core::problem::Advice;

homebody_core::messages! {
    /// Problems with the conditions of a household.
    pub enum HouseholdMessage in "condition" {
        /// `--without` names a condition that no resident shows, so that it removes nothing.
        NotShown {
            condition: String,
            known: Vec<String>,
        } error "not-shown" ("no resident shows {condition:?}")
            advice (Some(match known.is_empty() {
                true => "leave the condition out: no routine of this scenario shows one".to_owned(),
                false => format!("name a condition that the routines show: {}", known.join(", ")),
            }));
        /// A condition can show another condition. These conditions show each other, so that reading them would never end.
        Circle {
            conditions: Vec<String>,
        } error "circle" ("the conditions {conditions} show each other", conditions = conditions.join(" and "))
            hint ("remove the sentence that shows the other condition from one of the files");
        /// The routines of a scenario read a limited number of files with conditions. The limit is our choice.
        TooMany {
            file: String,
            most: usize,
        } error "too-many" ("a scenario has at most {most} conditions, and {file:?} is one more")
            hint ("remove conditions from the routines");
        /// A file with a condition has a limit, which is our choice.
        TooLong {
            file: String,
            why: String,
        } error "too-long" ("{file:?} is too long: {why}")
            hint ("shorten the file, or remove it");
        /// The scenario has a file with this condition, so Homebody does not use its own condition instead.
        Unreadable {
            file: String,
            why: String,
        } error "unreadable" ("cannot read {file:?}: {why}")
            hint ("replace the file with a readable text file, or remove it");
    }
}

homebody_core::messages! {
    /// Problems of a home that lacks something for the life of a resident.
    pub enum NeedMessage in "need" {
        /// Every resident with a routine sleeps at night.
        NoBed {
            example: Advice,
        } error "no-bed" ("the home has no place to sleep")
            hint ("add an enterable piece of furniture with the name or the role \"bed\"{example}")
            fix (example.fix.clone());
        /// Every resident with a routine uses a toilet.
        NoToilet {
            example: Advice,
        } error "no-toilet" ("the home has no toilet")
            hint ("add a place \"toilet\", or a piece of furniture with the name or the role \"toilet\"{example}")
            fix (example.fix.clone());
        /// Every resident with a routine rests in a seat between activities.
        NoSeat {
            example: Advice,
        } error "no-seat" ("the home has no place to sit")
            hint ("add an enterable piece of furniture with the name or the role \"armchair\"{example}")
            fix (example.fix.clone());
        /// Every resident with a routine prepares meals.
        NoKitchen {
            example: Advice,
        } error "no-kitchen" ("the home has no kitchen")
            hint
                ("add a room \"kitchen\", a place \"fridge\", or a piece of furniture with the role \"fridge\"{example}")
            fix (example.fix.clone());
        /// A body of this size finds no way out of the bed, so it cannot do anything else.
        BoxedIn {
            resident: String,
            from: String,
            help: Advice,
        } error "boxed-in" ("{resident} cannot get from {from:?} to the rest of the home")
            advice (Some(help.clone()));
        /// The routine uses this place, and a body of this size finds no way to it.
        NoWay {
            resident: String,
            from: String,
            to: String,
            help: Advice,
        } error "no-way" ("{resident} cannot get from {from:?} to {to:?}")
            advice (Some(help.clone()));
        /// The routine has outings, and the home has no door for them.
        NoWayOut error "no-way-out" ("the home has no way out")
            hint ("write \"outside\": true at a door, or add a place \"front door\"");
        /// The routine lets a fallen resident wait for a person, and no person ever comes.
        Unfound {
            resident: String,
        } error "unfound" ("no person can find {resident} after a fall: the home has no other resident and no visitor")
            hint
                ("add a visitor: \"her daughter visits every morning for 20 minutes\"; or add a duration: \"and lies there for 2 hours\"");
    }
}
