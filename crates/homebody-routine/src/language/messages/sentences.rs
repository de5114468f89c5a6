//! The messages about sentences and their order.

homebody_core::messages! {
    /// Problems with a sentence of a routine.
    pub enum SentenceMessage in "routine" {
        /// A line has a limit, which is our choice. The reader of routines works sentence by sentence.
        LongLine {
            /// The limit.
            most: usize,
        } error "long-line" ("this line has more than {most} characters")
            hint ("write each sentence on a line of its own");
        /// The first line of a routine may name its language, such as "Language: German".
        UnknownLanguage {
            /// The name.
            name: String,
        } error "unknown-language" ("{name:?} is not a language of routines")
            hint ("write \"Language: English\" or \"Language: German\"");
        /// A routine has a limit, which is our choice.
        TooManySentences {
            /// The limit.
            most: usize,
        } error "too-many-sentences" ("a routine has at most {most} sentences")
            hint ("leave some of the sentences out");
        /// A sentence has a limited number of words, which is our choice.
        TooManyWords {
            /// The limit.
            most: usize,
        } error "too-many-words" ("a sentence has at most {most} words")
            hint ("make several sentences");
        /// The words of the sentence can be read in two ways that mean different things.
        TwoMeanings {
            /// A sentence with one meaning.
            first: String,
            /// A sentence with the other.
            second: String,
        } error "two-meanings" ("the sentence has two meanings")
            hint ("write {first:?} or {second:?}");
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
            hint ("write who does what, such as \"she reads\"; if the line is a heading, do not indent it");
        /// A heading holds for the indented lines below it.
        EmptyHeading error "empty-heading" ("this heading has no lines below it")
            hint ("indent the lines that belong to it, or write the activity in the same sentence");
        /// The sentence has no activity.
        Unfinished error "unfinished" ("the sentence ends without an activity")
            hint ("write what she does, such as \"she reads\"");
        /// A sentence with both words can be read in several ways.
        AndOr error "and-or" ("\"and\" and \"or\" in one sentence can be read in several ways")
            hint ("make two sentences");
        /// Some words at the end of a sentence can belong to the last activity or to all of them.
        SharedPart {
            /// The words.
            text: String,
        } error "shared-part" ("{text:?} may belong to one activity or to both")
            hint ("make two sentences, or move these words to the beginning if they belong to both");
        /// A sentence of this kind cannot have these words. The text names the reason.
        DoesNotFit {
            /// The words.
            text: String,
            /// The reason.
            reason: String,
        } error "does-not-fit" ("{text:?} does not fit here: {reason}")
            hint ("leave these words out");
        /// A fact about the person, such as the age, occurs once.
        SaidBefore {
            /// The words.
            text: String,
        } error "said-before" ("{text:?} is about a fact that another sentence already states")
            hint ("leave one of the two sentences out");
        /// "Then" places an activity after the activity before it.
        NothingBeforeThen error "nothing-before-then" ("\"then\" has no activity before it")
            hint ("write an activity before \"then\"");
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
        } error "once-a-day" ("{text:?} does not fit here: she gets up and goes to bed once a day")
            hint ("for a break in the night, write \"goes to the bathroom\", \"lies awake\" or \"wanders\"");
        /// Help with getting up or going to bed happens at a time.
        WhenHelped error "when-helped" ("the sentence does not say at what time the help comes")
            hint ("add a time, such as \"at about 8:00\"");
        /// A kind of days needs the days that are of this kind.
        WhichDays error "which-days" ("the sentence does not say which days")
            hint ("write the days, such as \"on Sunday she has a quiet day\"");
        /// Outings have one frequency and one duration together.
        OneOuting {
            /// The words.
            text: String,
        } error "one-outing" ("cannot change {text:?} alone: a change of outings applies to all kinds of outings")
            hint ("write \"she goes out half as often\", or end the habit: \"until week 12 she goes for a walk\"");
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
        } error "open-change" ("the sentence does not say how {text:?} changes")
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
        } error "how-often" ("the sentence does not say how often this happens: {text:?}")
            hint ("write {example:?}");
    }
}
