use homebody_core::activity::{self, ACTIVITIES, KnownActivity, UsualClock, UsualLength};
use homebody_core::fuzzy::Fuzzy;
use homebody_core::role::Role;
use schemars::JsonSchema;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Meal {
    Breakfast,
    Lunch,
    Dinner,
}

impl Meal {
    pub const ALL: [Meal; 3] = [Meal::Breakfast, Meal::Lunch, Meal::Dinner];
}

macro_rules! own_ways {
    ($($(#[$doc:meta])* $name:ident $(($meal:ident))?: $($label:ident $($of:ident)?),+;)*) => {
        /// An activity of Homebody, or one of your own, which needs a place and a length.
        #[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, JsonSchema)]
        #[schemars(with = "String")]
        pub enum Activity {
            $($(#[$doc])* $name $(($meal))?,)*
            /// An activity without own steps: its label in the table.
            Everyday(&'static str),
            /// An activity of the user's lexicon, such as `knits`.
            Other(String),
        }

        impl Activity {
            /// Activities with steps of their own.
            pub const OWN_WAYS: [Activity; [$($(activity::$label),+),*].len()] =
                [$($(Activity::$name $((Meal::$of))?),+),*];

            /// The label in the ground truth, such as `watching_television`; for the user's activities, the user's name.
            pub fn label(&self) -> &str {
                match self {
                    $($(Activity::$name $((Meal::$of))? => activity::$label,)+)*
                    Activity::Everyday(label) => label,
                    Activity::Other(words) => words,
                }
            }
        }
    };
}

// Activities with steps of their own, which `behaviour/script.rs` has: variant, and label in the table.
own_ways! {
    GetUp: GETTING_UP;
    UseBathroom: USING_BATHROOM;
    Shower: SHOWERING;
    Wash: WASHING;
    Dress: DRESSING;
    TakeMedicine: TAKING_MEDICINE;
    Prepare(Meal): PREPARING_BREAKFAST Breakfast, PREPARING_LUNCH Lunch, PREPARING_DINNER Dinner;
    Eat(Meal): EATING_BREAKFAST Breakfast, EATING_LUNCH Lunch, EATING_DINNER Dinner;
    WashUp: WASHING_UP;
    WatchTelevision: WATCHING_TELEVISION;
    Read: READING;
    Phone: TELEPHONING;
    Nap: NAPPING;
    Laundry: LAUNDRY;
    Housework: HOUSEWORK;
    Leave: AWAY;
    ComeHome: COMING_HOME;
    /// A visitor comes and stays a while.
    Visit: VISIT;
    GoToBed: GOING_TO_BED;
    /// Coffee, tea or water.
    Drink: DRINKING;
    Snack: HAVING_A_SNACK;
    Exercise: EXERCISING;
    UseComputer: USING_COMPUTER;
    /// Sitting without another activity.
    Relax: RELAXING;
    Wander: WANDERING;
    Pace: PACING;
    Lap: LAPPING;
    LieAwake: LYING_AWAKE;
    /// With a time on the floor.
    Fall: FALLEN;
    /// Without a fall.
    Stumble: STUMBLING;
}

/// As its label.
impl Serialize for Activity {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.label())
    }
}

impl<'de> Deserialize<'de> for Activity {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Activity, D::Error> {
        String::deserialize(deserializer).map(Activity::from)
    }
}

impl From<String> for Activity {
    /// An activity of the table by its label, or one in the words of the user.
    fn from(label: String) -> Activity {
        Activity::from_label(&label).unwrap_or(Activity::Other(label))
    }
}

impl Activity {
    /// All that a routine can name without a lexicon. Activities without a usual length only appear in the ground truth.
    pub fn all_of_table() -> impl Iterator<Item = Activity> {
        let is_own = |label: &str| Activity::OWN_WAYS.iter().any(|own| own.label() == label);
        let rows = ACTIVITIES.iter().filter(|known| known.usual.is_some()).map(|known| known.label);
        let everyday = rows.filter(move |label| !is_own(label)).map(Activity::Everyday);
        Activity::OWN_WAYS.into_iter().chain(everyday)
    }

    /// `None` for a label that no routine can name.
    pub fn from_label(label: &str) -> Option<Activity> {
        Activity::all_of_table().find(|activity| activity.label() == label)
    }

    /// `None` for the user's activities.
    pub fn row(&self) -> Option<&'static KnownActivity> {
        match self {
            Activity::Other(_) => None,
            _ => activity::known(self.label()),
        }
    }

    /// Without a stated duration.
    pub fn usual_length(&self) -> UsualLength {
        /// For the user's activities (our choice).
        const OWN: UsualLength = UsualLength { median_min: 30.0, sigma: 0.4 };
        self.row().and_then(|row| row.usual).unwrap_or(OWN)
    }

    /// Whether all people do it daily: a sentence about Sundays then leaves the usual habit on other days.
    pub(crate) fn is_of_every_day(&self) -> bool {
        use Activity::{Dress, Eat, GetUp, GoToBed, Prepare, Wash};
        matches!(self, GetUp | GoToBed | Dress | Wash | Prepare(_) | Eat(_))
    }

    /// As opposed to meals, washing and housework, which all people do.
    pub(crate) fn is_of_choice(&self) -> bool {
        !self.is_of_every_day() && !matches!(self, Activity::Shower | Activity::WashUp | Activity::Laundry)
    }

    /// The meal of a preparation, and the preparation of a meal.
    pub(crate) fn of_same_meal(&self) -> Option<Activity> {
        match self {
            Activity::Prepare(meal) => Some(Activity::Eat(*meal)),
            Activity::Eat(meal) => Some(Activity::Prepare(*meal)),
            _ => None,
        }
    }

    /// In seconds since midnight.
    pub(crate) fn usual_clock(&self) -> Option<Fuzzy> {
        let UsualClock { around_h, spread_min } = self.row()?.clock?;
        Some(Fuzzy::around(around_h * 3600.0, spread_min * 60.0))
    }

    /// The roles of its places; empty for activities that go anywhere.
    pub fn roles(&self) -> &'static [Role] {
        // The user's activities are done in an armchair.
        self.row().map_or(&[Role::Armchair], |row| row.roles)
    }
}
