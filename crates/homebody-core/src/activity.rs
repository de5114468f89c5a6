//! What activities are called, and of which groups they are: the one table that lives, studies, pictures and the page go by.
//!
//! A label is what the truth says: once there are logs with it, it stays. Scenarios and real logs name activities as they like,
//! too, `Cook` or `Personal_Hygiene`: what is not in the table is of the kind whose words its own words begin with.

use crate::names::words;
use serde::Serialize;

/// A kind of activity of daily living, which has one colour in all pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ActivityKind {
    /// In bed at night, and naps.
    Sleep,
    /// Of the body: toilet, washing, dressing.
    Care,
    /// Meals and drinks, their preparation and the dishes.
    Food,
    /// Laundry and cleaning.
    Housework,
    /// What is done for pleasure, and work.
    Leisure,
    /// Taking medicine.
    Medicine,
    /// Out of the home, leaving and coming back, and being a guest.
    Out,
    /// All else.
    Other,
}

/// What time is used for, as time-use surveys group it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum TimeUse {
    /// In bed at night, asleep or not, and naps.
    Sleep,
    /// Of the body, with medicine.
    Care,
    /// Meals, snacks and drinks.
    Eating,
    /// Cooking, dishes, laundry, cleaning.
    Household,
    /// Watching television.
    Television,
    /// Reading.
    Reading,
    /// Doing nothing in particular.
    Relaxing,
    /// Talking to somebody who visits or phones.
    Company,
    /// At the computer.
    Computer,
    /// Out of the home, leaving and coming back.
    Out,
    /// All else.
    Other,
}

/// An activity that lives tell of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KnownActivity {
    /// What the truth calls it.
    pub label: &'static str,
    pub kind: ActivityKind,
    pub time_use: TimeUse,
    /// How long it usually takes where nothing is said; nothing for what lasts as long as something else does.
    pub usual: Option<UsualLength>,
}

/// The lognormal distribution of a duration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UsualLength {
    /// In minutes.
    pub median_min: f64,
    /// The standard deviation of the logarithm.
    pub sigma: f64,
}

macro_rules! activities {
    ($($name:ident $label:literal $kind:ident $time_use:ident $usual:expr;)*) => {
        $(
            #[doc = concat!("The label `", $label, "`.")]
            pub const $name: &str = $label;
        )*

        /// All that lives tell of.
        pub const ACTIVITIES: &[KnownActivity] = &[$(KnownActivity {
            label: $name,
            kind: ActivityKind::$kind,
            time_use: TimeUse::$time_use,
            usual: $usual,
        }),*];
    };
}

const fn around(median_min: f64, sigma: f64) -> Option<UsualLength> {
    Some(UsualLength { median_min, sigma })
}

// Label, kind, use of time, and the usual length: median in minutes, and sigma. Toilet by day and night, eating and preparing
// are defaults of the field without a source; durations in smart homes have coefficients of variation of 0.4-0.8. All are ours.
activities! {
    GETTING_UP "getting_up" Care Care around(2.0, 0.4);
    USING_BATHROOM "using_bathroom" Care Care around(5.0, 0.6);
    SHOWERING "showering" Care Care around(12.0, 0.35);
    WASHING "washing" Care Care around(6.0, 0.4);
    DRESSING "dressing" Care Care around(8.0, 0.4);
    TAKING_MEDICINE "taking_medicine" Medicine Care around(2.0, 0.4);
    PREPARING_BREAKFAST "preparing_breakfast" Food Household around(14.0, 0.35);
    PREPARING_LUNCH "preparing_lunch" Food Household around(22.0, 0.4);
    PREPARING_DINNER "preparing_dinner" Food Household around(25.0, 0.4);
    EATING_BREAKFAST "eating_breakfast" Food Eating around(22.0, 0.3);
    EATING_LUNCH "eating_lunch" Food Eating around(27.0, 0.3);
    EATING_DINNER "eating_dinner" Food Eating around(27.0, 0.3);
    WASHING_UP "washing_up" Food Household around(9.0, 0.4);
    WATCHING_TELEVISION "watching_television" Leisure Television around(75.0, 0.5);
    READING "reading" Leisure Reading around(35.0, 0.5);
    TELEPHONING "telephoning" Leisure Company around(14.0, 0.7);
    NAPPING "napping" Sleep Sleep around(40.0, 0.5);
    LAUNDRY "laundry" Housework Household around(12.0, 0.4);
    HOUSEWORK "housework" Housework Household around(35.0, 0.5);
    LEAVING_HOME "leaving_home" Out Out None;
    AWAY "away" Out Out around(110.0, 0.5);
    COMING_HOME "coming_home" Out Out around(2.0, 0.3);
    VISIT "visit" Other Company around(90.0, 0.4);
    VISITING "visiting" Out Other None;
    GOING_TO_BED "going_to_bed" Sleep Sleep around(5.0, 0.4);
    SLEEPING "sleeping" Sleep Sleep None;
    LYING_AWAKE "lying_awake" Other Sleep around(25.0, 0.5);
    DRINKING "drinking" Food Eating around(4.0, 0.5);
    HAVING_A_SNACK "having_a_snack" Food Eating around(7.0, 0.5);
    EXERCISING "exercising" Other Other around(16.0, 0.4);
    USING_COMPUTER "using_computer" Leisure Computer around(30.0, 0.5);
    RELAXING "relaxing" Leisure Relaxing around(25.0, 0.5);
    // 20.1 cycles and 43.9 minutes a day of residents who wander (Algase 1997): 2.2 minutes each.
    WANDERING "wandering" Other Other around(1.7, 0.7);
    PACING "pacing" Other Other around(1.7, 0.7);
    LAPPING "lapping" Other Other around(1.7, 0.7);
    FALLEN "fallen" Other Other around(20.0, 0.8);
    RESTING "resting" Leisure Other None;
    ROAMING "roaming" Other Other None;
}

/// How the words of other names begin, by kind; the first that fits counts. The lists are ours.
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

/// The row of a label, if the table has it.
pub fn known(label: &str) -> Option<&'static KnownActivity> {
    ACTIVITIES.iter().find(|known| known.label == label)
}

impl ActivityKind {
    /// In the order of the table.
    pub const ALL: [ActivityKind; 8] = [
        ActivityKind::Sleep,
        ActivityKind::Care,
        ActivityKind::Food,
        ActivityKind::Housework,
        ActivityKind::Leisure,
        ActivityKind::Medicine,
        ActivityKind::Out,
        ActivityKind::Other,
    ];

    /// The kind that a name is of, whoever gave it.
    pub fn of(name: &str) -> ActivityKind {
        known(name).map_or_else(|| ActivityKind::by_words(name), |known| known.kind)
    }

    /// The kind whose words a name's own begin with.
    fn by_words(name: &str) -> ActivityKind {
        let name = format!(" {}", words(name).join(" "));
        let fits = |begin: &&str| name.contains(&format!(" {begin}"));
        let found = KIND_WORDS.iter().find(|(_, begins)| begins.iter().any(fits));
        found.map_or(ActivityKind::Other, |(kind, _)| *kind)
    }

    /// For people.
    pub fn in_words(self) -> &'static str {
        match self {
            ActivityKind::Sleep => "sleep",
            ActivityKind::Care => "toilet, washing, dressing",
            ActivityKind::Food => "meals and kitchen",
            ActivityKind::Housework => "housework",
            ActivityKind::Leisure => "leisure and work",
            ActivityKind::Medicine => "medicine",
            ActivityKind::Out => "out of the home",
            ActivityKind::Other => "other",
        }
    }
}

impl TimeUse {
    /// In the order in which hours of a day are listed.
    pub const ALL: [TimeUse; 11] = [
        TimeUse::Sleep,
        TimeUse::Care,
        TimeUse::Eating,
        TimeUse::Household,
        TimeUse::Television,
        TimeUse::Reading,
        TimeUse::Relaxing,
        TimeUse::Company,
        TimeUse::Computer,
        TimeUse::Out,
        TimeUse::Other,
    ];

    /// What the time of an activity counts as; of one that the table does not have, as something else.
    pub fn of(label: &str) -> TimeUse {
        known(label).map_or(TimeUse::Other, |known| known.time_use)
    }

    /// For people.
    pub fn in_words(self) -> &'static str {
        match self {
            TimeUse::Sleep => "sleep and bed",
            TimeUse::Care => "care of the body",
            TimeUse::Eating => "eating and drinking",
            TimeUse::Household => "household",
            TimeUse::Television => "television",
            TimeUse::Reading => "reading",
            TimeUse::Relaxing => "relaxing",
            TimeUse::Company => "company",
            TimeUse::Computer => "computer",
            TimeUse::Out => "out of the home",
            TimeUse::Other => "else",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_of_their_kinds() {
        use ActivityKind::*;
        for (name, kind) in [
            ("Bed_Toilet_Transition", Care),
            ("Personal_Hygiene", Care),
            ("Wash_Dishes", Food),
            ("drinking_tea", Food),
            ("Eat", Food),
            ("television", Leisure),
            ("telephone", Leisure),
            ("Work", Leisure),
            ("Take_Medicine", Medicine),
            ("Leave_Home", Out),
            ("Enter_Home", Out),
            ("strolling", Other),
            ("", Other),
        ] {
            assert_eq!(ActivityKind::of(name), kind, "{name}");
        }
    }

    #[test]
    fn what_the_table_says_is_what_the_words_say() {
        for known in ACTIVITIES {
            assert_eq!(known.kind, ActivityKind::by_words(known.label), "{}", known.label);
            assert_eq!(words(known.label).join("_"), known.label);
        }
    }

    #[test]
    fn no_label_comes_twice() {
        let labels: std::collections::BTreeSet<&str> = ACTIVITIES.iter().map(|known| known.label).collect();
        assert_eq!(labels.len(), ACTIVITIES.len());
    }
}
