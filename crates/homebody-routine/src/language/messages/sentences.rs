//! The messages about sentences and their order.

homebody_core::messages! {
    /// Problems with a sentence of a routine.
    pub enum SentenceMessage in "routine" {
        /// A line has a limit, which is our choice. The reader of routines works sentence by sentence.
        LongLine {
            /// The limit.
            most: usize,
        } error "long-line" ("this line has more than {most} characters")
            hint ("write one sentence a line");
        /// A routine has a limit, which is our choice.
        TooManySentences {
            /// The limit.
            most: usize,
        } error "too-many-sentences" ("a routine has at most {most} sentences")
            hint ("leave some of the sentences out");
        /// Days in front of a semicolon can hold for the first sentence or for both.
        AfterSemicolon {
            /// The words for the days.
            text: String,
        } error "after-semicolon" ("nothing says whether {text:?} also holds after the semicolon")
            hint ("make two sentences, and write the days in both");
        /// Indented lines belong to the heading above them:
        ///
        /// ```text
        /// On Sunday
        ///   she gets up at 9:00
        /// ```
        Indented error "indented" ("this line is indented without a heading above it")
            hint ("indent only lines below a heading such as \"Every day\"");
        /// An indented line has to be a sentence with a person and an activity.
        NothingDone error "nothing-done" ("this sentence has no activity")
            hint ("a heading is not indented; a sentence says who does what");
        /// A heading holds for the indented lines below it.
        EmptyHeading error "empty-heading" ("this heading has no lines below it")
            hint ("indent the lines that belong to it, or write the activity in the same sentence");
        /// The sentence has no activity.
        Unfinished error "unfinished" ("the sentence ends before its activity")
            hint ("write what she does, such as \"she reads\"");
        /// An activity happens in one place.
        TwoPlaces {
            /// The words.
            text: String,
            /// The first place.
            first: String,
        } error "two-places" ("{text:?} is a second place, after {first:?}")
            hint ("leave one of them out, or make two sentences");
        /// A sentence describes one change.
        SecondChange {
            /// The words.
            text: String,
        } error "second-change" ("{text:?} is a second change in one sentence")
            hint ("make two sentences");
        /// Homebody simulates activities, and ignores purposes.
        Purpose {
            /// The words.
            text: String,
            /// The activity as a sentence.
            activity: String,
        } error "purpose" ("{text:?} is a purpose")
            hint ("write what she does, not what for: \"then she {activity}\"");
        /// The verb before this activity has no meaning for Homebody, or another one.
        Roundabout {
            /// The words.
            text: String,
            /// The hint.
            help: Option<String>,
        } error "roundabout" ("{text:?} is more than an activity")
            advice (help.clone());
        /// A rule begins with "whenever", and a place belongs behind it.
        BeforeRule {
            /// The words.
            text: String,
        } error "before-rule" ("{text:?} does not fit before a rule")
            hint ("write \"whenever she has been in the kitchen for 20 minutes\"");
        /// A sentence has a limited number of activities, which is our choice.
        TooManyActivities {
            /// The limit.
            most: usize,
        } error "too-many-activities" ("a sentence has at most {most} activities")
            hint ("begin a new sentence with \"Then she\"");
        /// A sentence with both words can be read in several ways.
        AndOr error "and-or" ("\"and\" and \"or\" in one sentence can be read in several ways")
            hint ("make two sentences");
        /// Some words at the end of a sentence can belong to the last activity or to all of them.
        SharedPart {
            /// The words.
            text: String,
        } error "shared-part" ("{text:?} may belong to one activity or to both")
            hint ("make two sentences, or begin the sentence with it if it is about both");
        /// A sentence of this kind cannot have these words. The text names the reason.
        DoesNotFit {
            /// The words.
            text: String,
            /// The reason.
            reason: String,
        } error "does-not-fit" ("{text:?} does not fit here: {reason}")
            hint ("leave it out");
        /// A fact about the person, such as the age, occurs once.
        SaidBefore {
            /// The words.
            text: String,
        } error "said-before" ("another sentence already has a value for {text:?}")
            hint ("leave one of the two sentences out");
        /// "Then" places an activity after the activity before it.
        NothingBeforeThen error "nothing-before-then" ("\"then\" has no activity before it")
            hint ("write the activity before it first");
        /// A person goes to a place for an activity.
        OnlyGoes {
            /// The words.
            text: String,
            /// `in` or `at`.
            at: &'static str,
            /// The place.
            place: String,
        } error "only-goes" ("{text:?} does not say what she does there")
            hint ("write what she does there, and for how long: \"she sits {at} the {place} for 20 minutes\"");
        /// A day begins with getting up and ends with going to bed. Breaks of the night have their own verbs.
        OnceADay {
            /// The words.
            text: String,
        } error "once-a-day" ("{text:?} does not fit here: a day begins and ends once")
            hint ("for the nights, write \"goes to the bathroom\", \"lies awake\" or \"wanders\"");
        /// Help with getting up or going to bed happens at a time.
        WhenHelped error "when-helped" ("the sentence does not say when")
            hint ("write at what time, such as \"at about 8:00\"");
        /// A kind of days needs the days that are of this kind.
        WhichDays error "which-days" ("the sentence does not say which days")
            hint ("write the days, such as \"on Sunday she has a quiet day\"");
        /// Outings have one frequency and one duration together.
        OneOuting {
            /// The words.
            text: String,
        } error "one-outing" ("{text:?} cannot change by itself: a change holds for all outings")
            hint ("write \"she goes out half as often\", or say until when: \"until week 12 she goes for a walk\"");
        /// "More" can be a higher frequency or a longer duration.
        MoreOrLonger {
            /// The words.
            text: String,
        } error "more-or-longer" ("{text:?} may mean more often or for longer")
            hint ("write \"30 % longer\" or \"30 % more often\"");
        /// A change says what is different and by how much.
        OpenChange {
            /// The words.
            text: String,
            /// The hint.
            help: String,
        } error "open-change" ("{text:?} does not say how it changes")
            hint ("{help}");
        /// The activity cannot change in this way.
        OtherChange {
            /// The words.
            text: String,
            /// The hint.
            help: String,
        } error "other-change" ("{text:?} does not fit this activity")
            hint ("{help}");
        /// A sentence of this kind is not a change. The text names the reason.
        NotAChange {
            /// The words.
            text: String,
            /// The reason.
            reason: String,
        } error "not-a-change" ("{text:?} does not fit here: {reason}");
        /// Skipping and forgetting happen on a share of the days or occasions.
        HowOften {
            /// The words.
            text: String,
            /// A sentence that says it.
            example: String,
        } error "how-often" ("the sentence does not say how often she {text:?}")
            hint ("write {example:?}");
    }
}
