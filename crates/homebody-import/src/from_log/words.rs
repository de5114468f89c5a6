//! Words for rooms, for things in them, and for activities there.

use homebody_core::role::Role;

#[derive(Debug, PartialEq)]
pub struct RoomKind {
    pub name: &'static str,
    pub words: &'static [&'static str],
    pub area_m2: f64,
    /// True for a room that people mostly pass through.
    pub is_way: bool,
}

macro_rules! room {
    ($name:literal, $words:tt, $area_m2:literal) => {
        room!($name, $words, $area_m2, false)
    };
    ($name:literal, $words:tt, $area_m2:literal, $is_way:literal) => {
        RoomKind { name: $name, words: &$words, area_m2: $area_m2, is_way: $is_way }
    };
}

/// All kinds; the last is for names without information.
pub static ROOM_KINDS: [RoomKind; 12] = [
    room!("bedroom", ["bedroom", "bed room", "guest room", "sleeping room", "master bedroom"], 13.0),
    room!("bathroom", ["bathroom", "bath room", "bath", "restroom", "washroom", "shower room"], 6.0),
    room!("toilet", ["wc", "toilet room", "lavatory"], 2.6),
    room!("kitchen", ["kitchen", "kitchenette"], 11.0),
    room!("dining room", ["dining room", "dining", "dining area"], 9.0),
    room!("living room", ["living room", "living", "lounge", "sitting room", "family room", "den", "tv room"], 19.0),
    room!("hall", ["hallway", "hall", "corridor", "landing", "passage", "stairs", "staircase"], 6.0, true),
    room!("entry", ["entryway", "entry", "foyer", "entrance", "vestibule", "porch"], 4.5, true),
    room!("study", ["office", "study", "work area", "work room", "computer room", "library"], 9.0),
    room!("laundry", ["laundry", "laundry room", "utility", "utility room"], 5.0),
    room!("closet", ["closet", "walk in closet", "storage", "pantry", "garage"], 4.0),
    room!("room", [], 10.0),
];

impl RoomKind {
    pub fn named(name: &str) -> &'static RoomKind {
        ROOM_KINDS.iter().find(|kind| kind.name == name).unwrap_or(&ROOM_KINDS[ROOM_KINDS.len() - 1])
    }
}

#[derive(Debug, PartialEq)]
pub struct RoomThing {
    pub name: &'static str,
    pub words: &'static [&'static str],
    /// The rooms for these words; empty for all rooms.
    pub only_in: &'static [&'static str],
    pub home: &'static str,
    /// Along the wall, and from the wall.
    pub size_m: [f64; 2],
    pub height_m: f64,
    /// True if a person who uses it is in it, not before it.
    pub enterable: bool,
    pub role: Option<Role>,
}

macro_rules! thing {
    ($name:literal, $words:tt in $only_in:tt, $home:literal, $size_m:tt, $height_m:literal, $enterable:literal, $role:expr) => {
        RoomThing {
            name: $name,
            words: &$words,
            only_in: &$only_in,
            home: $home,
            size_m: $size_m,
            height_m: $height_m,
            enterable: $enterable,
            role: $role,
        }
    };
}

/// All things. A word means the first thing that its room may have.
pub static THINGS: [RoomThing; 27] = [
    thing!("bed", ["bed", "mattress"] in [], "bedroom", [1.4, 2.0], 0.55, true, Some(Role::Bed)),
    thing!("toilet", ["toilet", "flush", "commode"] in [], "bathroom", [0.45, 0.65], 0.45, true, Some(Role::Toilet)),
    thing!("shower", ["shower", "bathtub", "tub", "bath"] in [], "bathroom", [0.85, 0.85], 0.05, true, Some(Role::Shower)),
    thing!("washbasin", ["sink", "basin", "washbasin", "faucet", "mirror", "vanity"] in ["bathroom", "toilet", "bedroom"], "bathroom", [0.6, 0.45], 0.85, false, Some(Role::Washbasin)),
    thing!("medicine cabinet", ["medicine", "pill", "pills", "med"] in [], "bathroom", [0.4, 0.2], 1.6, false, Some(Role::Medicine)),
    thing!("sink", ["sink", "faucet", "dishes"] in [], "kitchen", [0.6, 0.6], 0.9, false, Some(Role::Sink)),
    thing!("stove", ["stove", "oven", "burner", "hob", "cooker", "range"] in [], "kitchen", [0.6, 0.6], 0.9, false, Some(Role::Stove)),
    thing!("fridge", ["fridge", "refrigerator", "freezer"] in [], "kitchen", [0.6, 0.62], 1.6, false, Some(Role::Fridge)),
    thing!("microwave", ["microwave", "toaster", "coffee", "kettle"] in [], "kitchen", [0.6, 0.6], 0.9, false, None),
    thing!("drawers", ["drawer", "drawers", "cabinet", "cupboard", "pantry", "plates", "cups", "pans"] in ["kitchen", "dining room"], "kitchen", [0.6, 0.6], 0.9, false, Some(Role::Drawers)),
    thing!("dishwasher", ["dishwasher"] in [], "kitchen", [0.6, 0.6], 0.9, false, None),
    thing!("counter", ["counter", "worktop"] in [], "kitchen", [0.9, 0.6], 0.9, false, Some(Role::Counter)),
    thing!("desk chair", ["desk", "computer", "chair", "workstation"] in ["study"], "study", [0.6, 0.6], 0.9, true, Some(Role::Desk)),
    thing!("dining chair", ["dining", "table"] in ["dining room", "kitchen", "living room", "room"], "dining room", [0.5, 0.5], 0.9, true, Some(Role::DiningSeat)),
    thing!("dining chair", ["chair"] in ["dining room", "kitchen"], "dining room", [0.5, 0.5], 0.9, true, Some(Role::DiningSeat)),
    thing!("desk chair", ["desk", "computer", "workstation"] in [], "study", [0.6, 0.6], 0.9, true, Some(Role::Desk)),
    thing!("sofa", ["sofa", "couch", "settee", "loveseat"] in [], "living room", [1.8, 0.85], 0.8, true, Some(Role::Sofa)),
    thing!("armchair", ["armchair", "recliner", "chair", "seat", "rocker"] in [], "living room", [0.85, 0.85], 0.9, true, Some(Role::Armchair)),
    thing!("wardrobe", ["wardrobe", "closet", "dresser", "clothes"] in [], "bedroom", [1.0, 0.6], 1.9, false, Some(Role::Wardrobe)),
    thing!("television", ["tv", "television"] in [], "living room", [1.0, 0.4], 0.9, false, Some(Role::Television)),
    thing!("washing machine", ["washer", "washingmachine", "washing", "laundry"] in [], "laundry", [0.6, 0.6], 0.9, false, Some(Role::WashingMachine)),
    thing!("dryer", ["dryer"] in [], "laundry", [0.6, 0.6], 0.9, false, Some(Role::Dryer)),
    thing!("bookcase", ["bookcase", "bookshelf", "books", "shelf"] in [], "living room", [0.9, 0.3], 1.9, false, Some(Role::Bookcase)),
    thing!("telephone", ["phone", "telephone"] in [], "living room", [0.4, 0.4], 0.8, false, Some(Role::Telephone)),
    thing!("piano", ["piano"] in [], "living room", [1.4, 0.6], 1.1, false, None),
    thing!("bicycle", ["bicycle", "treadmill", "exercise"] in [], "living room", [0.7, 1.2], 1.1, false, None),
    thing!("drawers", ["drawer", "drawers", "cabinet", "cupboard"] in [], "bedroom", [0.8, 0.45], 0.9, false, None),
];

impl RoomThing {
    /// The thing of some words in a room of a kind, or anywhere if the room is not known.
    pub fn from_words(words: &[String], room: Option<&RoomKind>) -> Option<&'static RoomThing> {
        let fits = |thing: &&RoomThing| {
            let may_be = |room: &RoomKind| thing.only_in.is_empty() || thing.only_in.contains(&room.name);
            // Without a room, a word may stand for the thing in its usual one.
            room.is_none_or(may_be) && words.iter().any(|word| thing.words.contains(&word.as_str()))
        };
        THINGS.iter().find(fits)
    }

    pub fn named(name: &str) -> Option<&'static RoomThing> {
        THINGS.iter().find(|thing| thing.name == name)
    }
}

pub struct ActivitySite {
    /// Beginnings of the words of its label.
    pub words: &'static [&'static str],
    /// The kind of the room; `None` for activities at the way out.
    pub room: Option<&'static str>,
    pub at: &'static str,
}

/// The places of activities by their labels in data sets; the first row with a matching word decides.
pub const ACTIVITY_SITES: [ActivitySite; 11] = [
    ActivitySite { words: &["toilet"], room: Some("bathroom"), at: "toilet" },
    ActivitySite { words: &["leav", "enter", "outing"], room: None, at: "front door" },
    ActivitySite { words: &["sleep", "bed", "nap"], room: Some("bedroom"), at: "bed" },
    ActivitySite { words: &["bath", "shower"], room: Some("bathroom"), at: "shower" },
    ActivitySite { words: &["hygiene", "groom", "teeth", "shav", "makeup"], room: Some("bathroom"), at: "washbasin" },
    ActivitySite { words: &["dish"], room: Some("kitchen"), at: "sink" },
    ActivitySite { words: &["cook", "meal", "prepar", "kitchen", "snack"], room: Some("kitchen"), at: "stove" },
    ActivitySite { words: &["eat", "din", "lunch", "breakfast"], room: Some("dining room"), at: "dining chair" },
    ActivitySite { words: &["work", "desk", "computer", "study"], room: Some("study"), at: "desk chair" },
    ActivitySite { words: &["relax", "watch", "tv", "read", "rest"], room: Some("living room"), at: "armchair" },
    ActivitySite { words: &["dress"], room: Some("bedroom"), at: "wardrobe" },
];

impl ActivitySite {
    pub fn from_label(label: &str) -> Option<&'static ActivitySite> {
        let words = homebody_core::names::words(label);
        ACTIVITY_SITES
            .iter()
            .find(|site| words.iter().any(|word| site.words.iter().any(|begin| word.starts_with(begin))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_core::names::words;

    #[test]
    fn a_word_means_a_thing_of_its_room() {
        let name = |text: &str, room: &str| {
            RoomThing::from_words(&words(text), Some(RoomKind::named(room))).map(|thing| thing.name)
        };
        assert_eq!(name("Sink", "bathroom"), Some("washbasin"));
        assert_eq!(name("Sink", "kitchen"), Some("sink"));
        assert_eq!([name("Chair", "study"), name("Chair", "living room")], [Some("desk chair"), Some("armchair")]);
        assert_eq!([name("DiningChair", "kitchen"), name("Window", "kitchen")], [Some("dining chair"), None]);
        assert_eq!(RoomThing::from_words(&words("bed"), None).map(|thing| thing.home), Some("bedroom"));
    }

    #[test]
    fn labels_decide_the_site_of_an_activity() {
        let at = |label: &str| ActivitySite::from_label(label).map(|site| site.at);
        assert_eq!(
            [at("Bed_Toilet_Transition"), at("Sleep"), at("Personal_Hygiene")],
            [Some("toilet"), Some("bed"), Some("washbasin")]
        );
        assert_eq!(
            [at("Wash_Dishes"), at("Leave_Home"), at("Other_Activity")],
            [Some("sink"), Some("front door"), None]
        );
    }

    #[test]
    fn every_thing_has_a_room_of_a_known_kind() {
        let is_kind = |name: &str| ROOM_KINDS.iter().any(|kind| kind.name == name);
        for thing in &THINGS {
            assert!(is_kind(thing.home) && thing.only_in.iter().all(|room| is_kind(room)), "{}", thing.name);
        }
        for site in &ACTIVITY_SITES {
            assert!(
                site.room.is_none_or(is_kind) && (site.at == "front door" || RoomThing::named(site.at).is_some()),
                "{}",
                site.at
            );
        }
    }
}
