//! The messages about sentences that do not fit together.

homebody_core::messages! {
    /// Problems between the sentences of a routine.
    pub enum CheckMessage in "routine" {
        /// Some activities happen once a day: getting up, going to bed, each meal.
        TwoTimes {
            /// The activity, as a part of a sentence.
            activity: String,
            /// The line of the other sentence.
            other_line: u32,
            /// The hint.
            help: String,
        } error "two-times" ("the person {activity} twice on the same day: line {other_line} has another time")
            hint ("{help}");
        /// Two sentences say the opposite of each other for the same days.
        Contradiction {
            /// The line of the other sentence.
            other_line: u32,
            /// The other sentence.
            other: String,
        } error "contradiction" ("line {other_line} says the opposite: {other:?}")
            hint ("leave one sentence out, or add to each sentence the days on which it holds, such as \"until day 100\"");
        /// The duration or the end of an outing already decides when the person comes home.
        HomeTwice {
            /// The line of the outing.
            other_line: u32,
            /// The sentence of the outing.
            other: String,
        } error "home-twice" ("line {other_line} already says when she comes home: {other:?}")
            hint ("change one of the two times, or write on which days each sentence holds: \"on weekdays\"");
        /// A meal at home needs the person at home.
        OutThen {
            /// The line of the outing.
            other_line: u32,
            /// The sentence of the outing.
            other: String,
        } error "out-then" ("the person is out at this time, as line {other_line} says: {other:?}")
            hint ("change one of the two times, or write on which days each sentence holds: \"on weekdays\"");
        /// The daily activities together do not fit between getting up and going to bed.
        FullDay {
            /// The lines of the other activities.
            other_lines: Vec<u32>,
            /// The hours between getting up and going to bed.
            awake_h: f64,
        } error "full-day"
            ("{with}this takes more than the {awake_h:.0} hours that she is awake", with = with_lines(other_lines))
            hint ("write shorter durations, or on which days she does each activity");
        /// The time of going to bed is in the morning of the same day. Probably it is meant in the evening.
        BedBeforeUp {
            /// The line with the time of getting up.
            other_line: u32,
        } error "bed-before-up" ("this bedtime is earlier than the time of getting up in line {other_line}")
            hint ("write bedtimes as 22:30 or 10:30 pm");
        /// A person who comes home has left before.
        HomeWithoutLeaving error "home-without-leaving" ("she comes home, but no sentence says that she leaves")
            hint ("write when she leaves: \"she leaves the apartment at about 10:00\"");
        /// The sentence places its activity before or after another activity, and the routine never mentions that one.
        NoAnchor {
            /// The other activity, as a part of a sentence.
            activity: String,
            /// A time for it.
            time: String,
        } error "no-anchor" ("no sentence says that she {activity}, so this sentence has no time")
            hint ("add a sentence such as \"she {activity} at about {time}\"");
        /// A fallen person waits for a visitor, and the routine never lets this visitor come.
        FinderNeverComes {
            /// The visitor.
            visitor: String,
        } error "finder-never-comes" ("the {visitor} cannot find her: no sentence says that the {visitor} visits")
            hint
                ("write \"until she reaches the phone\", or add a sentence such as \"her {visitor} visits every day at 9:00\"");
        /// Activities that wait for each other never start. The circle can have more than two sentences.
        Circle {
            /// The line of the other sentence.
            other_line: u32,
        } error "circle" ("this sentence and line {other_line} wait for each other, so neither starts")
            hint ("write a time of day for one of the activities");
        /// An activity cannot come before or after itself.
        AfterItself {
            /// The activity, as a part of a sentence.
            activity: String,
        } error "after-itself" ("the sentence says that she {activity} before or after the same activity")
            hint ("write a time of day instead, or another activity");
        /// The rule waits for a thing, and the person never uses the thing.
        NeverUsed {
            /// The thing.
            thing: String,
            /// An activity that uses it.
            activity: String,
        } error "never-used" ("this rule never starts: no sentence says that she uses the {thing}")
            hint ("add a sentence such as \"she {activity} at about 12:00\"");
        /// The rule waits for an outing, and the person never leaves.
        NeverOut error "never-out" ("this rule never starts: no sentence says that she leaves")
            hint ("add a sentence such as \"she leaves the apartment at about 10:00\"");
        /// The rule waits for an outing that lasts longer than all outings of the routine.
        NeverOutSoLong error "never-out-so-long" ("this rule never starts: she is never out for so long")
            hint ("write a shorter time in the rule, or longer outings");
        /// The rule waits for an activity, and the person never does it.
        NeverDone {
            /// The activity, as a part of a sentence.
            activity: String,
        } error "never-done" ("this rule never starts: no sentence says that she {activity}")
            hint ("add a sentence such as \"she {activity} at about 12:00\"");
    }
}

fn with_lines(lines: &[u32]) -> String {
    let lines: Vec<String> = lines.iter().map(u32::to_string).collect();
    if lines.is_empty() { String::new() } else { format!("together with lines {}, ", lines.join(", ")) }
}
