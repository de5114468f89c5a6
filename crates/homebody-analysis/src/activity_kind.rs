//! What kind of activity a name is of, so that one kind has one colour in all pictures.
//!
//! Scenarios and real logs name activities as they like: `preparing_lunch`, `Cook`, `Personal_Hygiene`. We go by how the
//! words of a name begin; the lists are ours. What fits nowhere is of another kind.

use crate::signs::words;
use serde::Serialize;

/// A kind of activity of daily living.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ActivityKind {
    Sleep,
    Care,
    Food,
    Housework,
    Leisure,
    Medicine,
    Out,
    Other,
}

impl ActivityKind {
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

    /// The kind that a name is of: the first whose words are in it.
    pub fn of(name: &str) -> ActivityKind {
        use ActivityKind::*;
        const WORDS: [(ActivityKind, &[&str]); 9] = [
            (Medicine, &["medic", "pill", "tablet"]),
            (Food, &["dish", "washing up", "wash up"]),
            (
                Care,
                &[
                    "toilet",
                    "bath",
                    "shower",
                    "wash",
                    "hygien",
                    "groom",
                    "dress",
                    "getting up",
                    "get up",
                    "teeth",
                    "shav",
                ],
            ),
            (
                Out,
                &["away", "out", "outing", "leav", "coming home", "enter home", "errand", "shop", "church", "visiting"],
            ),
            (Sleep, &["sleep", "nap", "bed", "night"]),
            (
                Food,
                &[
                    "cook",
                    "eat",
                    "meal",
                    "breakfast",
                    "lunch",
                    "dinner",
                    "supper",
                    "snack",
                    "drink",
                    "tea",
                    "coffee",
                    "food",
                ],
            ),
            (Housework, &["laundry", "house", "clean", "tid", "vacuum", "iron", "chore"]),
            (
                Leisure,
                &[
                    "relax", "rest", "read", "tele", "tv", "watch", "knit", "phone", "work", "desk", "comput", "music",
                    "sit", "hobby",
                ],
            ),
            (Other, &[]),
        ];
        let name = format!(" {}", words(name).join(" "));
        let fits = |begin: &&str| name.contains(&format!(" {begin}"));
        WORDS.iter().find(|(_, begins)| begins.iter().any(fits)).map_or(Other, |(kind, _)| *kind)
    }

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_of_their_kinds() {
        use ActivityKind::*;
        for (name, kind) in [
            ("sleeping", Sleep),
            ("going_to_bed", Sleep),
            ("Bed_Toilet_Transition", Care),
            ("Personal_Hygiene", Care),
            ("getting_up", Care),
            ("washing", Care),
            ("washing_up", Food),
            ("Wash_Dishes", Food),
            ("preparing_lunch", Food),
            ("drinking_tea", Food),
            ("Eat", Food),
            ("laundry", Housework),
            ("television", Leisure),
            ("telephone", Leisure),
            ("Work", Leisure),
            ("Take_Medicine", Medicine),
            ("away", Out),
            ("coming_home", Out),
            ("Leave_Home", Out),
            ("Enter_Home", Out),
            ("strolling", Other),
            ("", Other),
        ] {
            assert_eq!(ActivityKind::of(name), kind, "{name}");
        }
    }
}
