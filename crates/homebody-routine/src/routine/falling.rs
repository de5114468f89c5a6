//! Details of falls.

use super::PartOfDay;
use homebody_core::role::Role;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The share of "mostly", as in "mostly at night" (our choice).
pub const USUAL_SHARE: f64 = 0.75;

/// Details of a fall, as far as stated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Falling {
    pub from: FallsFrom,
    /// Sinks to the floor instead of falling.
    pub slowly: bool,
    pub ends: FallEnds,
    /// [`USUAL_SHARE`] of the falls occur in this part of the day.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mostly: Option<PartOfDay>,
}

/// The activity before a fall.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FallsFrom {
    #[default]
    Walking,
    WayToToilet,
    Rising,
    Seat,
    Bed,
}

/// The end of the time on the floor.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FallEnds {
    #[default]
    Rises,
    Found,
    /// Crawls to the telephone, and is helped up by a person who comes.
    Phone,
}

impl Falling {
    /// Furniture that it needs.
    pub fn roles(&self) -> Vec<Role> {
        let from = match self.from {
            FallsFrom::Walking => None,
            FallsFrom::WayToToilet => Some(Role::Toilet),
            FallsFrom::Rising | FallsFrom::Seat => Some(Role::Armchair),
            FallsFrom::Bed => Some(Role::Bed),
        };
        from.into_iter().chain((self.ends == FallEnds::Phone).then_some(Role::Telephone)).collect()
    }

    /// In words, to follow "falls"; empty without details.
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
