//! Activities that drawn statements name: their words, labels, and what else brings them about.

use homebody_core::activity::{
    AWAY, BAKING, CARING_FOR_PLANTS, CHECKING_HEALTH, DOING_PUZZLES, DRINKING, EATING_BREAKFAST, EATING_DINNER,
    EATING_LUNCH, EXERCISING, FALLEN, GARDENING, GETTING_UP, GOING_TO_BED, GROOMING, HANDICRAFT, HAVING_A_SNACK,
    HOUSEWORK, LAUNDRY, LISTENING, LOOKING_OUT, LYING_AWAKE, MAKING_MUSIC, NAPPING, PACING, PRAYING, READING,
    RESTING_IN_BED, SHOWERING, STUMBLING, TAKING_MEDICINE, TELEPHONING, USING_BATHROOM, USING_COMPUTER, VISITING,
    WANDERING, WATCHING_TELEVISION, WRITING,
};

/// The occurrences of an activity without a statement.
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
    deed("bakes a cake", BAKING, false, 50.0),
    deed("prays", PRAYING, true, 15.0),
    deed("does the crossword", DOING_PUZZLES, true, 40.0),
    deed("knits", HANDICRAFT, true, 45.0),
    deed("writes letters", WRITING, true, 30.0),
    deed("listens to the radio", LISTENING, true, 45.0),
    deed("plays the piano", MAKING_MUSIC, true, 30.0),
    deed("looks out of the window", LOOKING_OUT, true, 20.0),
    deed("waters her plants", CARING_FOR_PLANTS, false, 8.0),
    deed("brushes her hair", GROOMING, false, 10.0),
    deed("checks her blood pressure", CHECKING_HEALTH, false, 5.0),
    deed("rests in bed", RESTING_IN_BED, false, 60.0),
    deed("exercises", EXERCISING, true, 16.0),
    deed("takes her pills", TAKING_MEDICINE, false, 2.0),
    deed("does the gardening", GARDENING, false, 45.0),
    deed("paces", PACING, false, 1.7),
    deed("wanders", WANDERING, false, 1.7),
];

pub const USUAL: [Deed; 3] = [
    with(Background::Usual, "takes a shower", SHOWERING, 12.0),
    with(Background::Usual, "does the laundry", LAUNDRY, 12.0),
    with(Background::Usual, "naps", NAPPING, 40.0),
];

pub const SPARE_TIME: [Deed; 5] = [
    with(Background::SpareTime, "watches television", WATCHING_TELEVISION, 75.0),
    with(Background::SpareTime, "reads", READING, 35.0),
    with(Background::SpareTime, "phones", TELEPHONING, 14.0),
    with(Background::SpareTime, "uses the computer", USING_COMPUTER, 30.0),
    with(Background::SpareTime, "does the housework", HOUSEWORK, 35.0),
];

pub const MEALS: [Deed; 3] = [
    with(Background::Meal, "eats breakfast", EATING_BREAKFAST, 22.0),
    with(Background::Meal, "eats lunch", EATING_LUNCH, 27.0),
    with(Background::Meal, "eats dinner", EATING_DINNER, 27.0),
];

pub const NEEDS: [Deed; 3] = [
    with(Background::Need, "has a drink", DRINKING, 4.0),
    with(Background::Need, "has a snack", HAVING_A_SNACK, 7.0),
    with(Background::Need, "goes to the bathroom", USING_BATHROOM, 5.0),
];

/// Activities of the night.
pub const NIGHTS: [Deed; 4] = [
    with(Background::Need, "goes to the bathroom", USING_BATHROOM, 5.0),
    deed("wanders", WANDERING, false, 1.7),
    with(Background::Usual, "lies awake", LYING_AWAKE, 25.0),
    deed("paces", PACING, false, 1.7),
];

pub const UP: Deed = with(Background::Meal, "gets up", GETTING_UP, 2.0);
pub const BED: Deed = with(Background::Meal, "goes to bed", GOING_TO_BED, 5.0);
pub const OUT: Deed = with(Background::Usual, "goes out", AWAY, 110.0);
pub const FALL: Deed = deed("falls", FALLEN, false, 20.0);
pub const STUMBLE: Deed = deed("stumbles", STUMBLING, false, 0.5);
pub const VISIT: Deed = deed("visits", VISITING, false, 90.0);

/// Activities that others follow or precede: the words after "after" and "before", and the label.
pub const ANCHORS: [(&str, &str); 6] = [
    ("breakfast", EATING_BREAKFAST),
    ("lunch", EATING_LUNCH),
    ("dinner", EATING_DINNER),
    ("she gets up", GETTING_UP),
    ("she goes to bed", GOING_TO_BED),
    ("she takes a shower", SHOWERING),
];
