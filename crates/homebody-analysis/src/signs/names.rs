use homebody_core::names::words;
use homebody_core::role::Role;
use homebody_core::sensed::domain_of;
use homebody_core::vocabulary::{
    CONTACT_WORDS, DEVICE_WORDS, DOOR_WORDS, MOTION_WORDS, OCCUPANCY_WORDS, ROLE_WORDS, WINDOW_WORDS, has_any,
};
use homebody_log::text::one_word;
use homebody_log::{Log, SensorInfo};

/// The kind of a sensor by its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NamedKind {
    /// It has a word for motion, or a name that CASAS gives to its motion sensors: `M001`, `MA015`.
    Motion,
    Contact,
    /// A thing that is used, though it says `ON`.
    Thing,
    /// A device's battery, its network or its program.
    Device,
    /// A door or a window, which has a contact, or else where a motion sensor looks.
    Door,
    /// A bed or a seat, which is used, or else where a motion sensor looks.
    Seat,
    /// Another thing that is used, or else where a motion sensor looks.
    Place,
}

/// Things that are used, though they say `ON`.
const THINGS: &str = "light lamp switch pressure mattress mat item power water flow tv flush faucet tap burner electric dishwasher \
    washingmachine microwave toaster freezer cupboard drawer machine maker fan kettle dryer disposal box dvd plug outlet socket \
    licht lampe lampada lámpara luz luce lumière lampa ljus свет 灯 照明 schalter steckdose interrupteur prise interruptor enchufe \
    schakelaar stopcontact strömbrytare wasserkocher bouilloire hervidor waterkoker";

/// Pieces of furniture that are used though they say `ON`, and those where a motion sensor may look instead.
const THINGS_BY_ROLE: [Role; 5] =
    [Role::FoodWarmer, Role::WashingMachine, Role::Dryer, Role::Television, Role::Drawers];
const PLACES_BY_ROLE: [Role; 3] = [Role::Fridge, Role::Stove, Role::Wardrobe];
const SEATS_BY_ROLE: [Role; 4] = [Role::Bed, Role::Sofa, Role::Armchair, Role::DiningSeat];

/// Other places that are used, or else where a motion sensor looks.
const PLACES: &str = "cabinet closet computer";
const SEATS: &str = "bed chair seat";

pub fn named(name: &str) -> Option<(NamedKind, String)> {
    let words = words(name);
    let by = |known: &str| words.iter().find(|word| has_any(std::slice::from_ref(word), known)).cloned();
    let by_role = |roles: &[Role]| {
        let known = ROLE_WORDS.iter().filter(|(role, _)| roles.contains(role));
        // Words that go together, such as `washing machine`, are found in the whole name.
        known.filter(|(_, known)| has_any(&words, known)).map(|(_, known)| by(known).unwrap_or(words.join(" "))).next()
    };
    let is_numbered = |letters: &str| {
        let rest = name.strip_prefix(letters).filter(|rest| !rest.is_empty());
        rest.is_some_and(|rest| rest.chars().all(|c| c.is_ascii_digit()))
    };
    let letter =
        |letters: &[&str]| letters.iter().find(|letters| is_numbered(letters)).map(|letters| (*letters).to_owned());
    let seat = || by(SEATS).or_else(|| by_role(&SEATS_BY_ROLE));
    None.or_else(|| by(DEVICE_WORDS).map(|word| (NamedKind::Device, word)))
        .or_else(|| by(MOTION_WORDS).or_else(|| letter(&["M", "MA"])).map(|word| (NamedKind::Motion, word)))
        .or_else(|| {
            let occupied = by(OCCUPANCY_WORDS)?;
            Some(seat().map_or((NamedKind::Motion, occupied), |word| (NamedKind::Thing, word)))
        })
        .or_else(|| by(CONTACT_WORDS).map(|word| (NamedKind::Contact, word)))
        .or_else(|| {
            let thing = by(THINGS).or_else(|| letter(&["L", "I"])).or_else(|| by_role(&THINGS_BY_ROLE));
            thing.map(|word| (NamedKind::Thing, word))
        })
        .or_else(|| seat().map(|word| (NamedKind::Seat, word)))
        .or_else(|| by(PLACES).or_else(|| by_role(&PLACES_BY_ROLE)).map(|word| (NamedKind::Place, word)))
        .or_else(|| by(DOOR_WORDS).or_else(|| by(WINDOW_WORDS)).map(|word| (NamedKind::Door, word)))
}

pub fn known_and_named<'a, T>(log: &'a Log<T>, id: &str) -> (Option<&'a SensorInfo>, Option<(NamedKind, String)>) {
    let known = log.known.iter().find(|known| known.id == id || one_word(&known.id) == id);
    let name = known.map(|known| known.name.as_str()).filter(|name| *name != id);
    // The domain of an id such as `binary_sensor.hall_pir` is not part of its name.
    let own = domain_of(id).map_or(id, |domain| &id[domain.len() + 1..]);
    (known, name.and_then(named).or_else(|| named(own)))
}

/// The name is that of a place to lie or sit. While such a sensor is on, the place is occupied.
pub fn is_seat(name: &str) -> bool {
    let words = words(name);
    has_any(&words, SEATS)
        || ROLE_WORDS.iter().any(|(role, known)| SEATS_BY_ROLE.contains(role) && has_any(&words, known))
}

/// A name has a word for a program, a network, a calendar or a thing that people carry with them.
pub fn is_of_program(name: &str) -> bool {
    const WORDS: &str = "ping router network internet wan vpn nas server printer workday holiday calendar api cloud raspberry supervisor addon \
        phone iphone ipad android pixel smartphone handy tablet watch laptop werktag feiertag netzwerk drucker";
    has_any(&words(name), WORDS)
}

/// CASAS names motion sensors so: a room, a letter, and a place in the room, such as `BedroomADoor`.
pub fn is_room_letter_place(name: &str) -> bool {
    let words = words(name);
    let is_letter = |word: &String| word.len() == 1 && word.chars().all(|c| c.is_ascii_alphabetic());
    let is_joined = name.chars().all(|c| c.is_ascii_alphabetic());
    is_joined && words.len() > 2 && words[1..words.len() - 1].iter().any(is_letter)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_of_a_name_say_what_a_sensor_is_in_any_language() {
        for (name, wanted) in [
            ("hall_pir", Some(NamedKind::Motion)),
            ("Door PIR Bedroom", Some(NamedKind::Motion)),
            ("Bewegungsmelder Flur", Some(NamedKind::Motion)),
            ("mouvement entrée", Some(NamedKind::Motion)),
            ("M001", Some(NamedKind::Motion)),
            ("MA015", Some(NamedKind::Motion)),
            ("Präsenz Küche", Some(NamedKind::Motion)),
            ("bed occupied", Some(NamedKind::Thing)),
            ("front_door_contact", Some(NamedKind::Contact)),
            ("Maindoor Magnetic Entrance", Some(NamedKind::Contact)),
            ("eingang_kontakt", Some(NamedKind::Contact)),
            ("haustuer", Some(NamedKind::Door)),
            ("Haustür", Some(NamedKind::Door)),
            ("Schlafzimmerfenster", Some(NamedKind::Door)),
            ("porte d'entrée", Some(NamedKind::Door)),
            ("Doppelbett", Some(NamedKind::Seat)),
            ("koelkast", Some(NamedKind::Place)),
            ("Washing machine", Some(NamedKind::Thing)),
            ("L012", Some(NamedKind::Thing)),
            ("hall motion battery", Some(NamedKind::Device)),
            ("hall", None),
            ("Temperatur", None),
            ("MB1", None),
        ] {
            assert_eq!(named(name).map(|(named, _)| named), wanted, "{name}");
        }
    }

    #[test]
    fn seats_are_known_by_their_names() {
        for (name, is) in [
            ("BedroomABed", true),
            ("bedroom motion", false),
            ("OfficeAChair", true),
            ("sofa mat", true),
            ("binary_sensor.bett", true),
        ] {
            assert_eq!(is_seat(name), is, "{name}");
        }
    }

    #[test]
    fn casas_names_have_a_letter_between_room_and_place() {
        for (name, is) in [
            ("BedroomADoor", true),
            ("KitchenADiningChair", true),
            ("HallwayA", false),
            ("front door", false),
            ("binary_sensor.plan_b_door", false),
        ] {
            assert_eq!(is_room_letter_place(name), is, "{name}");
        }
    }
}
