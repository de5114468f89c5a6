//! What is done at the places that somebody rises for, and what is opened there: their names tell.

use homebody_core::activity::{AIRING, FETCHING_MAIL, FRESHENING_UP, PUTTING_CLOTHES_AWAY, SEEING_TO_KITCHEN, TIDYING};
use homebody_core::names::words;

/// What somebody rises for, by the words in the names of the places where it is done; the first that fits counts. The lists are
/// ours.
const CHORES: [(&str, &[&str]); 5] = [
    (AIRING, &["window", "balcony"]),
    (FETCHING_MAIL, &["mailbox", "letterbox", "mail"]),
    (
        PUTTING_CLOTHES_AWAY,
        &["wardrobe", "closet", "dresser", "chest", "linen", "machine", "dryer", "clothes", "coats"],
    ),
    (FRESHENING_UP, &["washbasin", "basin", "mirror"]),
    (
        SEEING_TO_KITCHEN,
        &[
            "fridge",
            "refrigerator",
            "freezer",
            "stove",
            "oven",
            "kettle",
            "counter",
            "worktop",
            "sink",
            "microwave",
            "toaster",
            "dishwasher",
            "kitchen",
            "drawers",
            "drawer",
            "cupboard",
            "cabinet",
            "pantry",
        ],
    ),
];

/// The last words of the names of what is opened to get at what is in it, or for air (ours).
const OPENED: [&str; 17] = [
    "fridge",
    "refrigerator",
    "freezer",
    "microwave",
    "drawers",
    "drawer",
    "cupboard",
    "cabinet",
    "pantry",
    "wardrobe",
    "closet",
    "dresser",
    "chest",
    "mailbox",
    "letterbox",
    "window",
    "dishwasher",
];

/// Whether what has this name is opened to get at what is in it, or for air.
pub fn is_opened(name: &str) -> bool {
    words(name).last().is_some_and(|word| OPENED.contains(&word.as_str()))
}

/// What is done at a place of this name.
pub fn chore(name: &str) -> &'static str {
    let words = words(name);
    let fits = |(_, known): &&(&str, &[&str])| words.iter().any(|word| known.contains(&word.as_str()));
    CHORES.iter().find(fits).map_or(TIDYING, |(label, _)| label)
}
