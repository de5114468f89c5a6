//! The purposes of furniture: one table of roles, for routines, the check, the page and the documents.
//!
//! The name of a piece implies its roles: a `couch` is a sofa. If `home.json` gives the piece a `role`, it has that role
//! alone.

use crate::posture::Posture;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A row of the table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoleRow {
    /// The role that the row is about.
    pub role: Role,
    /// The purpose of a piece with this role, in one sentence.
    pub about: &'static str,
    /// The names of pieces that have this role, in lower case, the best first.
    pub names: &'static [&'static str],
    /// The roles that are taken instead where no piece has this one, the best first.
    pub instead: &'static [Role],
    /// The posture of a body in an enterable piece with this `role` in `home.json`; `None` for the posture that the
    /// piece's name implies.
    pub posture: Option<Posture>,
}

macro_rules! roles {
    ($(#[doc = $about:literal] $(#[$more:meta])* $role:ident $names:tt or [$($instead:ident),*], $posture:expr;)*) => {
        /// What a piece of furniture is for, and what an activity needs.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
        #[serde(rename_all = "snake_case")]
        #[schemars(title = "role")]
        pub enum Role {
            $(#[doc = $about] $(#[$more])* $role),*
        }

        /// All roles, in the order of [`Role`].
        pub static ROLES: &[RoleRow] = &[$(RoleRow {
            role: Role::$role,
            about: $about.trim_ascii(),
            names: &$names,
            instead: &[$(Role::$instead),*],
            posture: $posture,
        }),*];
    };
}

const LYING: Option<Posture> = Some(Posture::Lying);
const SITTING: Option<Posture> = Some(Posture::Sitting);
const STANDING: Option<Posture> = Some(Posture::Standing);

roles! {
    /// A place to sleep.
    Bed ["bed", "double bed", "single bed"] or [Sofa, Armchair], LYING;
    /// The toilet.
    Toilet ["toilet", "wc", "lavatory", "loo", "bathroom"] or [], SITTING;
    /// A place to wash.
    Washbasin ["washbasin", "basin", "bathroom sink", "bathroom"] or [Toilet], STANDING;
    /// A place to take a shower or a bath.
    Shower ["shower", "bathtub", "bath", "bath tub", "bathroom"] or [Washbasin], STANDING;
    /// A place to dress, with clothes.
    Wardrobe ["wardrobe", "closet", "dresser", "chest of drawers", "bedside", "bedroom"] or [Bed], STANDING;
    /// Cold storage of food.
    Fridge ["fridge", "refrigerator", "freezer", "kitchen"] or [], STANDING;
    /// A place to cook.
    Stove ["stove", "cooker", "oven", "hob", "kettle", "kitchen"] or [], STANDING;
    /// A place to warm food other than the stove.
    FoodWarmer ["microwave", "microwave oven", "toaster", "toaster oven", "air fryer"] or [Stove, Counter], STANDING;
    /// A surface to prepare food on.
    Counter ["counter", "kitchen counter", "worktop", "kitchen table", "kitchen"] or [Stove], STANDING;
    /// A place to wash dishes.
    Sink ["sink", "kitchen sink", "kitchen"] or [Counter, Stove], STANDING;
    /// Storage of pots and plates.
    Drawers ["drawers", "drawer", "cupboard", "kitchen drawers", "cabinet", "kitchen"] or [Counter], STANDING;
    /// Storage of medicine.
    Medicine ["medicine cabinet", "medicine", "pill box"] or [Counter, Washbasin], STANDING;
    /// A seat for meals.
    DiningSeat ["dining chair", "kitchen chair", "chair", "dining table", "kitchen table", "dining room"] or [Armchair], SITTING;
    /// A seat to read, watch television and rest in.
    Armchair ["armchair", "recliner", "easy chair", "rocking chair", "living room"] or [Sofa, DiningSeat], SITTING;
    /// A seat for several people.
    Sofa ["sofa", "couch", "settee"] or [Armchair, DiningSeat], SITTING;
    /// A seat for a visitor.
    GuestSeat ["guest chair", "second armchair", "sofa", "couch", "settee"] or [DiningSeat, Armchair], SITTING;
    /// The television set.
    Television ["tv", "television", "tv bench", "tv set", "tv stand"] or [], STANDING;
    /// A place to telephone.
    Telephone ["telephone", "phone"] or [Sofa, Armchair, DiningSeat], None;
    /// A place to use a computer.
    Desk ["desk chair", "computer chair", "desk", "computer", "study"] or [DiningSeat, Armchair], SITTING;
    /// A machine that washes clothes.
    WashingMachine ["washing machine", "washer", "laundry", "laundry closet"] or [Washbasin], STANDING;
    /// A machine or a line that dries clothes.
    Dryer ["dryer", "tumble dryer", "clothes line"] or [WashingMachine, Washbasin], STANDING;
    /// Storage of coats.
    Coats ["coats", "coat rack", "coat cupboard", "coat hooks"] or [FrontDoor], STANDING;
    /// Storage of books.
    Bookcase ["bookcase", "bookshelf", "shelf"] or [Armchair], STANDING;
    /// The way out: a door or a place, not a piece of furniture.
    #[serde(skip)]
    FrontDoor ["front door", "entrance", "apartment door", "door", "entrance door", "hall"] or [], STANDING;
    /// A place for a pet to eat.
    FoodBowl ["food bowl", "bowl"] or [Fridge, Sink], STANDING;
    /// A place for a pet to sleep.
    Basket ["basket", "cat bed", "dog bed"] or [Sofa, Armchair, Bed], None;
}

impl Role {
    /// Its row of the table.
    pub fn row(self) -> &'static RoleRow {
        &ROLES[self as usize]
    }

    /// The key in `home.json`, such as `dining_seat`; `None` for the way out, which is not furniture.
    pub fn key(self) -> Option<String> {
        let key = serde_json::to_value(self).ok()?;
        key.as_str().map(str::to_owned)
    }

    /// Whether a name in lower case implies this role, whosever the thing is: `wardrobe`, `margaret's wardrobe`.
    pub fn is_called(self, name: &str) -> bool {
        let is_whole = |of: &str| of.is_empty() || of.ends_with("'s ");
        self.row().names.iter().any(|own| name.strip_suffix(own).is_some_and(is_whole))
    }

    /// The roles that a name in lower case implies, in the order of the table.
    pub fn from_name(name: &str) -> impl Iterator<Item = Role> {
        ROLES.iter().map(|row| row.role).filter(move |role| role.is_called(name))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn each_role_has_its_own_row() {
        for (index, row) in ROLES.iter().enumerate() {
            assert_eq!((row.role as usize, row.role.row().role), (index, row.role));
            assert!(row.about.ends_with('.') && !row.instead.contains(&row.role), "{:?}", row.role);
            let names: BTreeSet<&str> = row.names.iter().copied().collect();
            assert_eq!(names.len(), row.names.len(), "{:?}", row.role);
            assert!(row.names.iter().all(|name| *name == name.to_lowercase()), "{:?}", row.role);
        }
    }

    #[test]
    fn a_role_is_said_as_its_key() {
        let keys: BTreeSet<String> = ROLES.iter().filter_map(|row| row.role.key()).collect();
        assert_eq!(keys.len(), ROLES.len() - 1);
        assert_eq!(Role::FrontDoor.key(), None);
        for row in ROLES.iter().filter(|row| row.role != Role::FrontDoor) {
            let key = row.role.key().unwrap();
            assert_eq!(serde_json::from_value::<Role>(key.into()).unwrap(), row.role);
        }
        assert!(serde_json::from_value::<Role>("front_door".into()).is_err());
    }

    #[test]
    fn one_name_may_imply_several_roles() {
        assert_eq!(Role::from_name("couch").collect::<Vec<_>>(), [Role::Sofa, Role::GuestSeat]);
        assert_eq!(Role::from_name("table").count(), 0);
        assert_eq!(Role::from_name("margaret's couch").collect::<Vec<_>>(), [Role::Sofa, Role::GuestSeat]);
        // A name that only ends like this is another thing.
        assert_eq!(Role::from_name("toy couch").count(), 0);
    }
}
