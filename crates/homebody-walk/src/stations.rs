//! Chores at places, and what can be opened, by the words in their names.

use homebody_core::activity::{AIRING, FETCHING_MAIL, FRESHENING_UP, PUTTING_CLOTHES_AWAY, SEEING_TO_KITCHEN, TIDYING};
use homebody_core::names::words;

/// Chores by words in the names of places; the first match counts (our choice).
const CHORES: [(&str, &str); 5] = [
    (AIRING, "window balcony"),
    (FETCHING_MAIL, "mailbox letterbox mail"),
    (PUTTING_CLOTHES_AWAY, "wardrobe closet dresser chest linen machine dryer clothes coats"),
    (FRESHENING_UP, "washbasin basin mirror"),
    (
        SEEING_TO_KITCHEN,
        "fridge refrigerator freezer stove oven kettle counter worktop sink microwave toaster dishwasher kitchen drawers drawer cupboard \
         cabinet pantry",
    ),
];

/// Last words of the names of things that are opened for their contents or for air (our choice).
const OPENED: &str = "fridge refrigerator freezer microwave drawers drawer cupboard cabinet pantry wardrobe closet dresser chest mailbox \
    letterbox window dishwasher";

pub fn is_opened(name: &str) -> bool {
    words(name).last().is_some_and(|word| OPENED.split(' ').any(|known| known == word))
}

pub fn chore(name: &str) -> &'static str {
    let words = words(name);
    let fits = |(_, known): &&(&str, &str)| known.split(' ').any(|known| words.iter().any(|word| word == known));
    CHORES.iter().find(fits).map_or(TIDYING, |(label, _)| label)
}
