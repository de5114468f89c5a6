//! How somebody falls, and what becomes of it.

use super::PartOfDay;
use homebody_core::role::Role;
use serde::Serialize;

/// Share that "mostly", as in "mostly at night", stands for (our choice): three of four.
pub const USUAL_SHARE: f64 = 0.75;

/// How somebody falls, as far as it is said.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Falling {
    pub from: FallsFrom,
    /// Sinks to the floor rather than falls.
    pub slowly: bool,
    pub ends: FallEnds,
    /// [`USUAL_SHARE`] of them come at this time of the day, the others at another.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mostly: Option<PartOfDay>,
}

/// What somebody does as they fall.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum FallsFrom {
    /// Walks somewhere.
    #[default]
    Walking,
    /// Walks to the toilet.
    WayToToilet,
    /// Rises from a seat.
    Rising,
    /// Sits.
    Seat,
    /// Lies in bed.
    Bed,
}

/// How the lie on the floor ends.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum FallEnds {
    /// Gets up.
    #[default]
    Rises,
    /// Is found: somebody who is at home, or comes, helps them up.
    Found,
    /// Crawls to the telephone, and is helped up once somebody has come.
    Phone,
}

impl Falling {
    /// What the home has to have for it.
    pub fn roles(&self) -> Vec<Role> {
        let from = match self.from {
            FallsFrom::Walking => None,
            FallsFrom::WayToToilet => Some(Role::Toilet),
            FallsFrom::Rising | FallsFrom::Seat => Some(Role::Armchair),
            FallsFrom::Bed => Some(Role::Bed),
        };
        from.into_iter().chain((self.ends == FallEnds::Phone).then_some(Role::Telephone)).collect()
    }

    /// The same in words, behind "falls"; empty where nothing is said.
    pub fn words(&self) -> String {
        let from = match self.from {
            FallsFrom::Walking => "",
            FallsFrom::WayToToilet => "on the way to the bathroom",
            FallsFrom::Rising => "while rising from a seat",
            FallsFrom::Seat => "out of a seat",
            FallsFrom::Bed => "out of bed",
        };
        let ends = match self.ends {
            FallEnds::Rises => "",
            FallEnds::Found => "lies there until somebody comes",
            FallEnds::Phone => "lies there and crawls to the telephone",
        };
        let slowly = if self.slowly { "slowly" } else { "" };
        [slowly, from, ends].into_iter().filter(|words| !words.is_empty()).collect::<Vec<_>>().join(", ")
    }
}
