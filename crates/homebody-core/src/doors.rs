//! The way that a door leads by its name: out of the home, or to a room or a thing inside.
//!
//! A thing inside wins, then a front door, then a room: a `living room front door` leads out, and a `main bedroom door` does not. The
//! languages that join words put the door last, as in `Kühlschranktür`, `koelkastdeur` and `badrumsdörr`. The word before it counts, too.

use crate::languages::{RoomUse, room_use};
use crate::names::words;
use crate::vocabulary::{CONTACT_WORDS, DOOR_WORDS, FRONT_WORDS, ROLE_WORDS, WINDOW_WORDS, has_any};

/// The way that a door leads by its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Leads {
    /// Its name speaks of an entrance, the house or outside.
    Out,
    /// It is that of a room, a piece of furniture, an appliance, a vehicle, a pet or a letter box.
    Inside,
    /// Its name says no more than that it is a door or a contact.
    Bare,
    /// Its name has a word that no table has.
    Unknown,
}

/// Beginnings of words that speak of an entrance.
const ENTRANCES: &str = "entr front foyer vestibule exit porch";

/// Words that speak of a way out next to a door, or before it in one word.
const OUTSIDE: &str = "front main house home outside outdoor outer exterior back rear street entrance entry apartment unit haus wohnung \
    eingang außen aussen vorder hinter haupt etagen principale calle rue rua voor achter buiten huis ytter entré hoved yder gade inngang \
    indgang ulko etu frontowe hlavní вход 外";

/// Words for doors in one word with others, longest first.
const DOORS: [&str; 14] =
    ["türen", "türe", "tür", "tuere", "tuer", "tur", "deur", "dörren", "dörr", "dorr", "døren", "dør", "door", "ovi"];

/// Letters that join two words.
const JOINTS: [&str; 5] = ["", "s", "n", "en", "es"];

/// Beginnings of English words for rooms inside a home, and for things in them.
const INNER_ROOMS: &str = "bed bath toilet shower kitchen living dining office study laundry room pantry";
const INNER_THINGS: &str = "closet wardrobe cabinet cupboard drawer fridge refrigerator freezer oven microwave \
    stove dishwasher washer medicine medication pill window";

/// Words for rooms inside a home that the plan importer needs no use of.
const ROOMS: &str = "-zimmer -kammer büro keller bureau oficina ufficio escritório kantoor -kamer kontor arbetsrum -rum -rom -værelse \
    -huone -huoneen keittiö keittiön sauna saunan vessa vessan parveke parvekkeen kuchyň salle camera vardagsrum shed greenhouse loft";

/// Words for furniture, appliances, vehicles, flaps for pets and letter boxes: they open, and no person goes through them.
const THINGS: &str = "schrank -schrank schublade -schublade lade truhe -truhe tresor safe locker garderobe kast -kast skåp -skåp skap -skap \
    skab -skab garderob -garderob kaappi -kaappi kaapin -kaapin laatikko placard tiroir cassetto armadietto cajón gaveta szafka szuflada \
    skříň skříňka zásuvka ящик 柜 抽屉 引き出し \
    ofen -ofen geschirrspüler spülmaschine waschmaschine trockner kühler congélateur congelatore congelador vriezer frys -frys pakastin \
    zamrażarka mraznička lave+vaisselle lavastoviglie lavavajillas vaatwasser diskmaskin opvaskemaskine oppvaskmaskin astianpesukone \
    zmywarka myčka dryer machine cooler humidor vitrine \
    car vehicle van truck trunk auto kofferraum voiture coche carro macchina bil samochód auta машина 车 車 \
    flap catflap petflap cat dog pet hamster klappe -klappe luik -luik lucka -lucka chatière gattaiola gatera \
    mailbox letterbox postbox letter mail parcel briefkasten -kasten kasten boîte boite boites lettres cassetta buzón brievenbus \
    brevlåda postkasse postilaatikko skrzynka schránka почтовый 信箱 郵便 \
    lid bin trash dustbin deckel mülleimer box";

/// Words that say no more than that something is a door or a sensor, or where it is from.
const PLAIN: &str =
    "binary sensor state status opening open d dw door contact windows reed aqara sonoff shelly tuya ikea zigbee lumi";

/// The way that a door leads by its name.
pub fn leads(name: &str) -> Leads {
    let words = words(name);
    let stems: Vec<String> = words.iter().flat_map(|word| before_a_door(word)).collect();
    let all: Vec<String> = words.iter().chain(&stems).cloned().collect();
    let is_door = |word: &String| has_any(std::slice::from_ref(word), DOOR_WORDS);
    let is_front = |words: &[String]| has_any(words, OUTSIDE);
    let is_front_door = is_front(&stems) || words.windows(2).any(|two| is_front(&two[..1]) && is_door(&two[1]));
    if is_thing(&all) {
        return Leads::Inside;
    }
    if is_front_door {
        return Leads::Out;
    }
    if is_room(&all) {
        return Leads::Inside;
    }
    let has_door = words.iter().any(is_door) || !stems.is_empty();
    if begins(&words, ENTRANCES) || has_any(&words, FRONT_WORDS) || has_door && is_front(&words) {
        return Leads::Out;
    }
    let is_plain = |word: &String| {
        let alone = std::slice::from_ref(word);
        before_a_door(word).is_empty() && [PLAIN, DOOR_WORDS, CONTACT_WORDS].iter().any(|known| has_any(alone, known))
    };
    // Such as those of `D002` and `0x00158d`.
    let is_of_id =
        |word: &String| word.chars().count() == 1 || word.chars().all(|c| c.is_ascii_hexdigit() || c.is_numeric());
    if words.iter().all(|word| is_plain(word) || is_of_id(word)) { Leads::Bare } else { Leads::Unknown }
}

/// Words that may stand before a door in one word with it.
fn before_a_door(word: &str) -> Vec<String> {
    let Some(before) = DOORS.iter().find_map(|door| word.strip_suffix(door)) else { return Vec::new() };
    let stems = JOINTS.iter().filter_map(|joint| before.strip_suffix(joint));
    stems.filter(|stem| stem.chars().count() > 1).map(str::to_owned).collect()
}

fn begins(words: &[String], with: &str) -> bool {
    words.iter().any(|word| with.split_whitespace().any(|begin| word.starts_with(begin)))
}

fn is_thing(words: &[String]) -> bool {
    let is_role = || ROLE_WORDS.iter().any(|(_, known)| has_any(words, known));
    begins(words, INNER_THINGS) || has_any(words, THINGS) || has_any(words, WINDOW_WORDS) || is_role()
}

fn is_room(words: &[String]) -> bool {
    let is_use = |word: &String| room_use(word).is_some_and(|room| room != RoomUse::Hall);
    begins(words, INNER_ROOMS) || has_any(words, ROOMS) || words.iter().any(is_use)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_says_where_a_door_leads_in_any_language() {
        for (wanted, names) in [
            (
                Leads::Out,
                "front door|main entrance|House Door|home door|apartment_door|outside door|Back Door|binary_sensor.front_door|haustuer|\
                 Haustur|Haustür|Wohnungstür|wohnungstur|Eingangstür|Außentür|Hintertür|porte d'entrée|porte principale|\
                 puerta principal|puerta de la calle|porta d'ingresso|voordeur|achterdeur|ytterdörr|ytterdörren|hoveddør|ulko-ovi|\
                 etuovi|drzwi wejściowe|hlavní dveře|входная дверь|大门|frontdoor|MainEntryway|FrontDoor contact|hall front door|Living Room Front Door|Küche Haustür",
            ),
            (
                Leads::Inside,
                "Kühlschranktür|kuehlschranktuer|kuhlschranktur|Badtür|Schlafzimmertür|Zimmertür|Arbeitszimmertür|Duschtür|Schranktür|\
                 Backofentür|Garderobe|Garderobentür|Küchentür|Balkontür|Terrassentür|Kellertür|Autotür|Katzenklappe|Briefkasten|\
                 Schublade|Medikamentenschrank|car door|cat flap door|dog door|mailbox|letter box|main bedroom door|front closet door|\
                 entry closet|fridge door|bedroomdoor|hall closet door|washing machine door|porte du frigo|puerta nevera|\
                 porte de la chambre|koelkastdeur|slaapkamerdeur|badkamerdeur|kastdeur|brievenbus|kylskåpsdörr|badrumsdörr|sovrumsdörr|\
                 køleskabsdør|skabsdør|jääkaapin ovi|makuuhuoneen ovi|keittiön ovi|冰箱门|卧室门|车门|Haustür Fenster",
            ),
            (Leads::Bare, "door|Tür|D002|door 2|contact|Door Sensor|binary_sensor.door_contact|porta|Z2|ovi"),
            (Leads::Unknown, "Anna door|hall|Kulturtür|Temperatur|Flurtür"),
        ] {
            for name in names.split('|') {
                assert_eq!(leads(name), wanted, "{name}");
            }
        }
    }
}
