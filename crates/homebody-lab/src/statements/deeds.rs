//! Activities that drawn statements name: their words, labels, and what else brings them about.

/// What happens of an activity without a statement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Background {
    /// Nothing.
    Nothing,
    /// Usual habits, which a statement replaces while it holds.
    Usual,
    /// A meal of every day, which a statement replaces on its days.
    Meal,
    /// Spare time.
    SpareTime,
    /// Needs, which a number of times a day replaces.
    Need,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deed {
    /// In the third person; "her" becomes "his".
    pub words: &'static str,
    /// As in "after she ...".
    pub label: &'static str,
    pub background: Background,
    /// Whether it is done in other places, too.
    pub goes_anywhere: bool,
    /// Usual length in minutes.
    pub usual_min: f64,
}

const fn deed(words: &'static str, label: &'static str, goes_anywhere: bool, usual_min: f64) -> Deed {
    Deed { words, label, background: Background::Nothing, goes_anywhere, usual_min }
}

const fn with(background: Background, words: &'static str, label: &'static str, usual_min: f64) -> Deed {
    Deed { words, label, background, goes_anywhere: false, usual_min }
}

pub const PASTIMES: [Deed; 17] = [
    deed("bakes a cake", "baking", false, 50.0),
    deed("prays", "praying", true, 15.0),
    deed("does the crossword", "doing_puzzles", true, 40.0),
    deed("knits", "handicraft", true, 45.0),
    deed("writes letters", "writing", true, 30.0),
    deed("listens to the radio", "listening", true, 45.0),
    deed("plays the piano", "making_music", true, 30.0),
    deed("looks out of the window", "looking_out", true, 20.0),
    deed("waters her plants", "caring_for_plants", false, 8.0),
    deed("brushes her hair", "grooming", false, 10.0),
    deed("checks her blood pressure", "checking_health", false, 5.0),
    deed("rests in bed", "resting_in_bed", false, 60.0),
    deed("exercises", "exercising", true, 16.0),
    deed("takes her pills", "taking_medicine", false, 2.0),
    deed("does the gardening", "gardening", false, 45.0),
    deed("paces", "pacing", false, 1.7),
    deed("wanders", "wandering", false, 1.7),
];

pub const USUAL: [Deed; 3] = [
    with(Background::Usual, "takes a shower", "showering", 12.0),
    with(Background::Usual, "does the laundry", "laundry", 12.0),
    with(Background::Usual, "naps", "napping", 40.0),
];

pub const SPARE_TIME: [Deed; 5] = [
    with(Background::SpareTime, "watches television", "watching_television", 75.0),
    with(Background::SpareTime, "reads", "reading", 35.0),
    with(Background::SpareTime, "phones", "telephoning", 14.0),
    with(Background::SpareTime, "uses the computer", "using_computer", 30.0),
    with(Background::SpareTime, "does the housework", "housework", 35.0),
];

pub const MEALS: [Deed; 3] = [
    with(Background::Meal, "eats breakfast", "eating_breakfast", 22.0),
    with(Background::Meal, "eats lunch", "eating_lunch", 27.0),
    with(Background::Meal, "eats dinner", "eating_dinner", 27.0),
];

pub const NEEDS: [Deed; 3] = [
    with(Background::Need, "has a drink", "drinking", 4.0),
    with(Background::Need, "has a snack", "having_a_snack", 7.0),
    with(Background::Need, "goes to the bathroom", "using_bathroom", 5.0),
];

/// Activities of the night.
pub const NIGHTS: [Deed; 4] = [
    with(Background::Need, "goes to the bathroom", "using_bathroom", 5.0),
    deed("wanders", "wandering", false, 1.7),
    with(Background::Usual, "lies awake", "lying_awake", 25.0),
    deed("paces", "pacing", false, 1.7),
];

pub const UP: Deed = with(Background::Meal, "gets up", "getting_up", 2.0);
pub const BED: Deed = with(Background::Meal, "goes to bed", "going_to_bed", 5.0);
pub const OUT: Deed = with(Background::Usual, "goes out", "away", 110.0);
pub const FALL: Deed = deed("falls", "fallen", false, 20.0);
pub const STUMBLE: Deed = deed("stumbles", "stumbling", false, 0.5);
pub const VISIT: Deed = deed("visits", "visiting", false, 90.0);

/// Activities that others follow or precede: the words after "after" and "before", and the label.
pub const ANCHORS: [(&str, &str); 6] = [
    ("breakfast", "eating_breakfast"),
    ("lunch", "eating_lunch"),
    ("dinner", "eating_dinner"),
    ("she gets up", "getting_up"),
    ("she goes to bed", "going_to_bed"),
    ("she takes a shower", "showering"),
];
