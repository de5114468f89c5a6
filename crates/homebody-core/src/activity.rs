//! The table of activities, on which runs, studies, pictures and the page depend.
//!
//! A label is the name in the truth. It stays, because logs contain it. Scenarios and real logs have names of their own, such as
//! `Cook` or `Personal_Hygiene`: the kind of a name outside the table follows from its words.

use crate::names::words;
use crate::role::Role;
use crate::sensors::form::Colour;
use serde::Serialize;

crate::worded::worded! {
    /// A kind of activity of daily living. Each has one colour in all pictures.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
    #[serde(rename_all = "snake_case")]
    pub enum ActivityKind {
        /// In bed at night, and naps.
        Sleep = "sleep",
        /// Of the body: toilet, washing, dressing.
        Care = "toilet, washing, dressing",
        /// Meals and drinks, their preparation and the dishes.
        Food = "meals and kitchen",
        /// Laundry and cleaning.
        Housework = "housework",
        /// Pleasure and work.
        Leisure = "leisure and work",
        /// Taking medicine.
        Medicine = "medicine",
        /// Out of the home, leaving and coming back.
        Out = "out of the home",
        /// All else.
        Other = "other",
    }
    /// In the order of the table.
    ALL
    /// For people.
    fn in_words
}

crate::worded::worded! {
    /// A use of time, as in time-use surveys.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
    #[serde(rename_all = "snake_case")]
    pub enum TimeUse {
        /// In bed at night, asleep or not, and naps.
        Sleep = "sleep and bed",
        /// Of the body, with medicine.
        Care = "care of the body",
        /// Meals, snacks and drinks.
        Eating = "eating and drinking",
        /// Cooking, dishes, laundry, cleaning.
        Household = "household",
        /// Watching television.
        Television = "television",
        /// Reading.
        Reading = "reading",
        /// Doing nothing in particular.
        Relaxing = "relaxing",
        /// Talking to visitors and on the telephone.
        Company = "company",
        /// At the computer.
        Computer = "computer",
        /// Out of the home, leaving and coming back.
        Out = "out of the home",
        /// All else.
        Other = "else",
    }
    /// In the order of lists of the hours of a day.
    ALL
    /// For people.
    fn in_words
}

/// A row of the table of activities.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KnownActivity {
    /// The name in the truth.
    pub label: &'static str,
    /// The beginning of a sentence about the activity.
    pub about: &'static str,
    /// The kind, which has a colour in pictures and on the page.
    pub kind: ActivityKind,
    /// The category in sums of hours of a day.
    pub time_use: TimeUse,
    /// The usual duration; `None` if it follows from another activity.
    pub usual: Option<UsualLength>,
    /// The places of the activity; empty if it has none.
    pub roles: &'static [Role],
    /// The usual time of day, if any.
    pub clock: Option<UsualClock>,
    /// The part of a visitor who does it for the resident or with them.
    pub help: Option<Help>,
    /// Whether it stays the same activity with any object, as in "reads westerns".
    pub takes_object: bool,
}

/// The lognormal distribution of a duration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UsualLength {
    /// In minutes.
    pub median_min: f64,
    /// The standard deviation of the logarithm.
    pub sigma: f64,
}

/// A usual time of day.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UsualClock {
    /// Hours since midnight.
    pub around_h: f64,
    /// Largest deviation, in minutes.
    pub spread_min: f64,
}

/// The part of a visitor in an activity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Help {
    /// The visitor helps the resident.
    Together,
    /// The visitor does it, and the resident does not.
    Instead,
}

/// The columns that few rows set.
const OPTIONAL: KnownActivity = KnownActivity {
    label: "",
    about: "",
    kind: ActivityKind::Other,
    time_use: TimeUse::Other,
    usual: None,
    roles: &[],
    clock: None,
    help: None,
    takes_object: false,
};

macro_rules! activities {
    ($($name:ident $label:literal: $about:literal, $kind:ident, $time_use:ident, $usual:expr, [$($role:ident),*]
        $(, $column:ident: $value:expr)*;)*) => {
        $(
            #[doc = concat!($about, ": the label `", $label, "`.")]
            pub const $name: &str = $label;
        )*

        /// All activities, in the order of documents.
        #[allow(clippy::needless_update, reason = "some rows set all columns")]
        pub const ACTIVITIES: &[KnownActivity] = &[$(KnownActivity {
            label: $name,
            about: $about,
            kind: ActivityKind::$kind,
            time_use: TimeUse::$time_use,
            usual: $usual,
            roles: &[$(Role::$role),*],
            $($column: $value,)*
            ..OPTIONAL
        }),*];
    };
}

const fn around(median_min: f64, sigma: f64) -> Option<UsualLength> {
    Some(UsualLength { median_min, sigma })
}

const fn at(around_h: f64, spread_min: f64) -> Option<UsualClock> {
    Some(UsualClock { around_h, spread_min })
}

const TOGETHER: Option<Help> = Some(Help::Together);
const INSTEAD: Option<Help> = Some(Help::Instead);

// Label, beginning of a sentence, kind, use of time, the usual length as median in minutes and sigma, and the roles of furniture,
// then the optional columns. All lengths and times are our choice: for the toilet by day and night, for eating and for preparing,
// the field has defaults without a source. Durations in smart homes have coefficients of variation of 0.4-0.8. No norms of
// the times of meals were found.
activities! {
    GETTING_UP "getting_up": "Getting up: sitting on the edge of the bed", Care, Care, around(2.0, 0.4), [Bed];
    USING_BATHROOM "using_bathroom": "Using the toilet, and washing hands after it",
        Care, Care, around(5.0, 0.6), [Toilet, Washbasin];
    SHOWERING "showering": "Taking a shower or a bath, and drying after it",
        Care, Care, around(12.0, 0.35), [Shower, Washbasin], clock: at(7.25, 40.0);
    WASHING "washing": "Washing oneself, brushing teeth", Care, Care, around(6.0, 0.4), [Washbasin], clock: at(7.25, 40.0);
    DRESSING "dressing": "Getting dressed", Care, Care, around(8.0, 0.4), [Wardrobe], clock: at(7.25, 40.0);
    TAKING_MEDICINE "taking_medicine": "Taking medicine, with water",
        Medicine, Care, around(2.0, 0.4), [Medicine, Sink], clock: at(7.75, 30.0), takes_object: true;
    PREPARING_BREAKFAST "preparing_breakfast": "Preparing breakfast",
        Food, Household, around(14.0, 0.35), [Fridge, Drawers, Counter, Stove, FoodWarmer, Sink], clock: at(7.75, 30.0), help: INSTEAD, takes_object: true;
    PREPARING_LUNCH "preparing_lunch": "Preparing lunch",
        Food, Household, around(22.0, 0.4), [Fridge, Drawers, Counter, Stove, FoodWarmer, Sink], clock: at(11.8, 30.0), help: INSTEAD, takes_object: true;
    PREPARING_DINNER "preparing_dinner": "Preparing dinner",
        Food, Household, around(25.0, 0.4), [Fridge, Drawers, Counter, Stove, FoodWarmer, Sink], clock: at(17.25, 40.0), help: INSTEAD, takes_object: true;
    EATING_BREAKFAST "eating_breakfast": "Eating breakfast", Food, Eating, around(22.0, 0.3), [DiningSeat], clock: at(8.0, 30.0), takes_object: true;
    EATING_LUNCH "eating_lunch": "Eating lunch", Food, Eating, around(27.0, 0.3), [DiningSeat], clock: at(12.25, 30.0), takes_object: true;
    EATING_DINNER "eating_dinner": "Eating dinner", Food, Eating, around(27.0, 0.3), [DiningSeat], clock: at(17.75, 40.0), takes_object: true;
    WASHING_UP "washing_up": "Doing the dishes", Food, Household, around(9.0, 0.4), [Sink], help: INSTEAD;
    WATCHING_TELEVISION "watching_television": "Watching television",
        Leisure, Television, around(75.0, 0.5), [Armchair], takes_object: true;
    READING "reading": "Reading", Leisure, Reading, around(35.0, 0.5), [Armchair], takes_object: true;
    TELEPHONING "telephoning": "Telephoning", Leisure, Company, around(14.0, 0.7), [Telephone], takes_object: true;
    NAPPING "napping": "Napping by day, in bed or on a seat", Sleep, Sleep, around(40.0, 0.5), [Bed, Armchair], clock: at(14.75, 45.0);
    LAUNDRY "laundry": "Washing and drying clothes", Housework, Household, around(12.0, 0.4), [WashingMachine, Dryer], help: INSTEAD, takes_object: true;
    HOUSEWORK "housework": "Going round the home: cleaning, dusting, tidying",
        Housework, Household, around(35.0, 0.5), [], help: INSTEAD, takes_object: true;
    TIDYING "tidying": "A small errand: putting things where they belong, looking for something",
        Housework, Household, None, [];
    SEEING_TO_KITCHEN "seeing_to_kitchen": "A small errand in the kitchen: putting dishes away, wiping, looking for food",
        Housework, Household, None, [];
    PUTTING_CLOTHES_AWAY "putting_clothes_away": "A small errand at wardrobes and washing machines: clothes and linen",
        Housework, Household, None, [];
    AIRING "airing": "A small errand: a window opened for air, a look out of it",
        Housework, Household, None, [];
    FETCHING_MAIL "fetching_mail": "Fetching the mail, from the mailbox or from outside the door",
        Housework, Household, around(2.0, 0.4), [FrontDoor];
    FRESHENING_UP "freshening_up": "A small errand to the washbasin: hands, face, hair", Care, Care, None, [];
    LEAVING_HOME "leaving_home": "Putting on a coat and going to the door", Out, Out, None, [Coats, FrontDoor];
    AWAY "away": "Out of the home", Out, Out, around(110.0, 0.5), [Coats, FrontDoor], takes_object: true;
    COMING_HOME "coming_home": "Coming home and settling in", Out, Out, around(2.0, 0.3), [];
    VISIT "visit": "With a visitor: the host lets them in and talks to them",
        Other, Company, around(90.0, 0.4), [FrontDoor, Armchair, GuestSeat], clock: at(15.0, 90.0), takes_object: true;
    VISITING "visiting": "Visiting, from the door to the seat and back",
        Other, Other, None, [FrontDoor, GuestSeat];
    GOING_TO_BED "going_to_bed": "Lying down at night, and falling asleep", Sleep, Sleep, around(5.0, 0.4), [Bed];
    SLEEPING "sleeping": "Asleep at night; for a pet, at any time", Sleep, Sleep, None, [Bed];
    LYING_AWAKE "lying_awake": "Awake in bed at night", Other, Sleep, around(25.0, 0.5), [Bed];
    DRINKING "drinking": "Making a drink and having it", Food, Eating, around(4.0, 0.5), [Stove, Sink, DiningSeat], takes_object: true;
    HAVING_A_SNACK "having_a_snack": "Eating a snack from the refrigerator at the table",
        Food, Eating, around(7.0, 0.5), [Fridge, DiningSeat], takes_object: true;
    EXERCISING "exercising": "Exercising", Other, Other, around(16.0, 0.4), [Armchair];
    USING_COMPUTER "using_computer": "Using the computer", Leisure, Computer, around(30.0, 0.5), [Desk];
    RELAXING "relaxing": "Sitting and doing nothing in particular", Leisure, Relaxing, around(25.0, 0.5), [Armchair];
    PRAYING "praying": "Praying or meditating", Leisure, Other, around(15.0, 0.5), [Armchair];
    DOING_PUZZLES "doing_puzzles": "Doing puzzles, games or cards", Leisure, Other, around(40.0, 0.5), [DiningSeat, Armchair], takes_object: true;
    HANDICRAFT "handicraft": "Handicraft: knitting, sewing, drawing, mending", Leisure, Other, around(45.0, 0.5), [Armchair], takes_object: true;
    WRITING "writing": "Writing letters, a diary or bills", Leisure, Other, around(30.0, 0.5), [Desk, DiningSeat], takes_object: true;
    LISTENING "listening": "Listening to the radio or to music", Leisure, Other, around(45.0, 0.5), [Armchair], takes_object: true;
    MAKING_MUSIC "making_music": "Playing an instrument, singing", Leisure, Other, around(30.0, 0.5), [Armchair], takes_object: true;
    LOOKING_OUT "looking_out": "Looking out of the window", Leisure, Relaxing, around(20.0, 0.6), [Armchair];
    CARING_FOR_PET "caring_for_pet": "Feeding, brushing and playing with a pet", Other, Household, around(8.0, 0.5), [FoodBowl, Sink], help: INSTEAD;
    CARING_FOR_PLANTS "caring_for_plants": "Watering and repotting plants in the home",
        Housework, Household, around(8.0, 0.5), [Sink], help: INSTEAD, takes_object: true;
    BAKING "baking": "Baking bread or cakes", Food, Household, around(50.0, 0.4), [Counter, Stove], help: INSTEAD, takes_object: true;
    SMOKING "smoking": "Smoking outside the door", Leisure, Other, around(6.0, 0.3), [FrontDoor];
    GARDENING "gardening": "Being in the garden: weeding, mowing, sitting there", Out, Other, around(45.0, 0.5), [Coats, FrontDoor], help: INSTEAD, takes_object: true;
    RESTING_IN_BED "resting_in_bed": "In bed by day, awake", Sleep, Relaxing, around(60.0, 0.5), [Bed];
    GROOMING "grooming": "Caring for hair, nails and skin, and shaving", Care, Care, around(10.0, 0.5), [Washbasin], help: TOGETHER;
    CHECKING_HEALTH "checking_health": "Measuring blood pressure, blood sugar, weight or oxygen", Medicine, Care, around(5.0, 0.5), [Medicine], help: TOGETHER;
    BEING_CARED_FOR "being_cared_for": "Having dressings, foot care or injections, by a visitor or alone",
        Medicine, Care, around(15.0, 0.5), [Armchair], help: TOGETHER;
    // 20.1 cycles and 43.9 minutes a day of residents who wander (Algase 1997): 2.2 minutes each.
    WANDERING "wandering": "Walking without a goal", Other, Other, around(1.7, 0.7), [];
    PACING "pacing": "Walking to and fro", Other, Other, around(1.7, 0.7), [];
    LAPPING "lapping": "Walking round and round", Other, Other, around(1.7, 0.7), [];
    FALLEN "fallen": "On the floor after a fall, and getting up from there", Other, Other, around(20.0, 0.8), [];
    WALKING "walking": "Walking to the place of an activity", Other, Other, None, [];
    WAITING "waiting": "Waiting for a person: at an occupied place, or for a meal that is not ready",
        Other, Other, None, [];
    HELPING "helping": "A visitor's help with washing, dressing or another activity of the host", Other, Other, None, [];
    STUMBLING "stumbling": "Losing one's footing, and catching oneself", Other, Other, around(0.5, 0.3), [];
    RESTING "resting": "A pet sits and looks around", Leisure, Other, None, [];
    ROAMING "roaming": "A pet makes short rounds through the home, to its bowl and its places",
        Other, Other, None, [FoodBowl];
}

/// Beginnings of words in names outside the table, by kind (our choice). The first match counts.
pub const KIND_WORDS: [(ActivityKind, &[&str]); 8] = [
    (ActivityKind::Medicine, &["medic", "pill", "tablet"]),
    (ActivityKind::Food, &["dish", "washing up", "wash up"]),
    (
        ActivityKind::Care,
        &["toilet", "bath", "shower", "wash", "hygien", "groom", "dress", "getting up", "get up", "teeth", "shav"],
    ),
    (
        ActivityKind::Out,
        &["away", "out", "outing", "leav", "coming home", "enter home", "errand", "shop", "church", "visiting"],
    ),
    (ActivityKind::Sleep, &["sleep", "nap", "bed", "night"]),
    (
        ActivityKind::Food,
        &["cook", "eat", "meal", "breakfast", "lunch", "dinner", "supper", "snack", "drink", "tea", "coffee", "food"],
    ),
    (ActivityKind::Housework, &["laundry", "house", "clean", "tid", "vacuum", "iron", "chore"]),
    (
        ActivityKind::Leisure,
        &[
            "relax", "rest", "read", "tele", "tv", "watch", "knit", "phone", "work", "desk", "comput", "music", "sit",
            "hobby",
        ],
    ),
];

/// The label of a use of a thing because of a rule, such as `turning_off_stove`; `on` includes open.
pub fn turning(thing: &str, on: bool) -> String {
    format!("turning_{}_{thing}", if on { "on" } else { "off" })
}

/// The row of a label.
pub fn known(label: &str) -> Option<&'static KnownActivity> {
    ACTIVITIES.iter().find(|known| known.label == label)
}

impl ActivityKind {
    /// The kind of a name: that of the row with this label in any spelling, else by the words of the name.
    pub fn from_name(name: &str) -> ActivityKind {
        let label = words(name).join("_");
        known(&label).map_or_else(|| ActivityKind::by_words(name), |known| known.kind)
    }

    fn by_words(name: &str) -> ActivityKind {
        let name = format!(" {}", words(name).join(" "));
        let fits = |begin: &&str| name.contains(&format!(" {begin}"));
        let found = KIND_WORDS.iter().find(|(_, begins)| begins.iter().any(fits));
        found.map_or(ActivityKind::Other, |(kind, _)| *kind)
    }

    /// The colour in all pictures; `None` for the colour of text.
    pub fn colour(self) -> Option<Colour> {
        match self {
            ActivityKind::Sleep => Some(Colour::Blue),
            ActivityKind::Care => Some(Colour::Sky),
            ActivityKind::Food => Some(Colour::Orange),
            ActivityKind::Housework => Some(Colour::Purple),
            ActivityKind::Leisure => Some(Colour::Green),
            ActivityKind::Medicine => Some(Colour::Vermillion),
            ActivityKind::Out => None,
            ActivityKind::Other => Some(Colour::Yellow),
        }
    }
}

impl TimeUse {
    /// The category of an activity; `Other` outside the table.
    pub fn from_label(label: &str) -> TimeUse {
        known(label).map_or(TimeUse::Other, |known| known.time_use)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kinds_of_names_follow_from_their_words() {
        use ActivityKind::*;
        #[rustfmt::skip]
        let cases = [
            ("Bed_Toilet_Transition", Care), ("Personal_Hygiene", Care), ("Wash_Dishes", Food), ("drinking_tea", Food),
            ("Eat", Food), ("television", Leisure), ("telephone", Leisure), ("Work", Leisure),
            ("Take_Medicine", Medicine), ("Leave_Home", Out), ("Enter_Home", Out), ("strolling", Other), ("", Other),
        ];
        for (name, kind) in cases {
            assert_eq!(ActivityKind::from_name(name), kind, "{name}");
        }
    }

    #[test]
    fn labels_have_their_kind_in_any_spelling() {
        for known in ACTIVITIES {
            assert_eq!(words(known.label).join("_"), known.label);
            for name in [known.label.to_owned(), known.label.to_uppercase(), known.label.replace('_', " ")] {
                assert_eq!(ActivityKind::from_name(&name), known.kind, "{name}");
            }
        }
        // The words alone would have it in bed.
        assert_eq!(
            (ActivityKind::from_name("Lying_Awake"), ActivityKind::from_name("Lying in bed")),
            (ActivityKind::Other, ActivityKind::Sleep)
        );
    }

    #[test]
    fn labels_are_unique() {
        let labels: std::collections::BTreeSet<&str> = ACTIVITIES.iter().map(|known| known.label).collect();
        assert_eq!(labels.len(), ACTIVITIES.len());
    }
}
