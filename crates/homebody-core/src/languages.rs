//! One table of words in many languages: the names of rooms, and the names of the things that a life needs.

use crate::names::words;
use crate::role::Role;
use crate::vocabulary::has_any;

/// The use of a room, by its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RoomUse {
    /// People sleep there.
    Bedroom,
    /// It has a toilet, a shower or a bath.
    Bathroom,
    /// People cook there.
    Kitchen,
    /// People sit there.
    LivingRoom,
    /// People come in by it, or go through it.
    Hall,
    /// A balcony, a cellar, a garage or stairs.
    Aside,
}

const USES: [RoomUse; 6] =
    [RoomUse::Bathroom, RoomUse::Kitchen, RoomUse::Bedroom, RoomUse::LivingRoom, RoomUse::Hall, RoomUse::Aside];

/// The words of a language; those for rooms as [`has_any`] reads them, in the order of [`USES`].
struct Language {
    rooms: [&'static str; 6],
    /// The names of things, in the order of [`NAMED`].
    things: [&'static str; 8],
}

/// The things that have names here.
const NAMED: [Role; 8] = [
    Role::Bed,
    Role::Toilet,
    Role::Armchair,
    Role::Fridge,
    Role::DiningSeat,
    Role::Stove,
    Role::Washbasin,
    Role::Shower,
];

/// The languages. If two know equally many rooms, the first counts.
const LANGUAGES: [Language; 14] = [
    Language {
        rooms: [
            "bathroom bath toilet wc restroom washroom lavatory ensuite loo powder+room shower+room",
            "kitchen kitchenette pantry+kitchen",
            "bedroom bed sleeping guest+room master nursery",
            "living lounge livingroom sitting family+room",
            "hall hallway entrance entry foyer corridor landing vestibule lobby porch",
            "stairs stair staircase balcony terrace garage cellar basement storage closet garden patio attic deck laundry pantry",
        ],
        things: ["bed", "toilet", "armchair", "fridge", "chair", "stove", "washbasin", "shower"],
    },
    Language {
        rooms: [
            "badezimmer bad -badezimmer toilette klo wc gästewc duschbad waschraum",
            "küche -küche kueche kochnische wohnküche",
            "schlafzimmer -schlafzimmer schlafraum kinderzimmer gästezimmer elternschlafzimmer",
            "wohnzimmer -wohnzimmer stube wohnraum wohnbereich",
            "flur diele eingang vorzimmer vorraum gang windfang hausflur korridor garderobe",
            "treppe -treppe treppenhaus balkon terrasse keller -keller abstellraum abstellkammer dachboden loggia speisekammer hauswirtschaftsraum",
        ],
        things: ["Bett", "Toilette", "Sessel", "Kühlschrank", "Stuhl", "Herd", "Waschbecken", "Dusche"],
    },
    Language {
        rooms: [
            "salle+bain bains toilettes toilette douche sanitaire sdb",
            "cuisine kitchenette",
            "chambre dortoir",
            "séjour salon sejour salle+manger pièce+vie",
            "entrée entree couloir vestibule dégagement palier",
            "escalier balcon terrasse cave cellier grenier buanderie placard véranda",
        ],
        things: ["lit", "toilettes", "fauteuil", "réfrigérateur", "chaise", "cuisinière", "lavabo", "douche"],
    },
    Language {
        rooms: [
            "bagno bagnetto servizi antibagno",
            "cucina cucinotto angolo+cottura",
            "camera letto cameretta matrimoniale singola",
            "soggiorno salotto sala salone",
            "ingresso corridoio disimpegno andito anticamera",
            "scala scale balcone terrazza terrazzo cantina ripostiglio soffitta lavanderia box giardino",
        ],
        things: ["letto", "water", "poltrona", "frigorifero", "sedia", "fornelli", "lavandino", "doccia"],
    },
    Language {
        rooms: [
            "baño aseo bano lavabo servicio",
            "cocina cocineta",
            "dormitorio habitación alcoba recámara cuarto",
            "salón comedor estar sala",
            "recibidor pasillo entrada vestíbulo zaguán",
            "escalera escaleras balcón terraza sótano trastero garaje desván lavadero jardín patio",
        ],
        things: ["cama", "inodoro", "sillón", "nevera", "silla", "estufa", "lavamanos", "ducha"],
    },
    Language {
        rooms: [
            "banheiro lavabo wc banho casa+banho",
            "cozinha copa",
            "quarto dormitório suíte",
            "sala estar sala+jantar",
            "corredor hall entrada",
            "escada varanda sacada terraço garagem porão despensa lavanderia jardim",
        ],
        things: ["cama", "sanita", "poltrona", "geladeira", "cadeira", "fogão", "lavatório", "chuveiro"],
    },
    Language {
        rooms: [
            "badkamer toilet wc douche",
            "keuken -keuken",
            "slaapkamer -slaapkamer logeerkamer kinderkamer",
            "woonkamer -woonkamer zitkamer huiskamer",
            "gang hal inkomhal overloop entree",
            "trap balkon terras kelder berging zolder schuur bijkeuken tuin",
        ],
        things: ["bed", "wc", "leunstoel", "koelkast", "stoel", "fornuis", "wastafel", "douche"],
    },
    Language {
        rooms: [
            "badrum toalett dusch wc badeværelse bad baderom",
            "kök pentry køkken kjøkken",
            "sovrum gästrum soveværelse soverom barnrum",
            "vardagsrum stue allrum",
            "korridor entré hall tambur gang",
            "trappa balkong terrass altan källare förråd vind garage tvättstuga",
        ],
        things: ["säng", "toalett", "fåtölj", "kylskåp", "stol", "spis", "tvättställ", "dusch"],
    },
    Language {
        rooms: [
            "łazienka toaleta wc ubikacja",
            "kuchnia aneks+kuchenny",
            "sypialnia pokój+dziecka",
            "salon pokój+dzienny living",
            "korytarz przedpokój hol sień wiatrołap",
            "schody balkon taras piwnica garaż strych spiżarnia pralnia",
        ],
        things: ["łóżko", "sedes", "fotel", "lodówka", "krzesło", "kuchenka", "umywalka", "prysznic"],
    },
    Language {
        rooms: [
            "koupelna toaleta záchod wc",
            "kuchyně kuchyň kuchyňský",
            "ložnice dětský ložnica",
            "obývák obývací",
            "předsíň chodba hala zádveří",
            "schodiště balkón balkon terasa sklep garáž půda spíž komora lodžie",
        ],
        things: ["postel", "záchod", "křeslo", "lednice", "židle", "sporák", "umyvadlo", "sprcha"],
    },
    Language {
        rooms: [
            "ванная туалет санузел уборная",
            "кухня",
            "спальня детская",
            "гостиная зал",
            "прихожая коридор холл",
            "лестница балкон лоджия терраса подвал гараж кладовая",
        ],
        things: ["кровать", "унитаз", "кресло", "холодильник", "стул", "плита", "умывальник", "душ"],
    },
    Language {
        rooms: [
            "浴室 卫 洗手间 厕所 衛生間",
            "厨房 廚房",
            "卧 臥室 儿童房",
            "客厅 客廳 起居室 餐厅",
            "玄关 走廊 门厅 過道",
            "楼梯 阳台 陽台 车库 储藏 露台 衣帽间",
        ],
        things: ["床", "马桶", "扶手椅", "冰箱", "椅子", "炉灶", "洗手盆", "淋浴"],
    },
    Language {
        rooms: [
            "トイレ 風呂 バス 洗面所",
            "キッチン 台所",
            "寝室 和室 洋室",
            "リビング 居間",
            "玄関 廊下 ホール",
            "階段 ベランダ バルコニー 物置 車庫 テラス",
        ],
        things: ["ベッド", "トイレ", "アームチェア", "冷蔵庫", "椅子", "コンロ", "洗面台", "シャワー"],
    },
    Language {
        rooms: [
            "vệ+sinh phòng+tắm tắm toilet wc",
            "bếp",
            "ngủ",
            "khách phòng+khách",
            "hành+lang sảnh hiên",
            "thang ban+công kho sân gara",
        ],
        things: ["giường", "bồn cầu", "ghế bành", "tủ lạnh", "ghế", "bếp nấu", "chậu rửa", "vòi sen"],
    },
];

/// The use of a room of this name, if its words say so in any language.
pub fn room_use(name: &str) -> Option<RoomUse> {
    let words = words(name);
    let says =
        |(index, _): &(usize, &RoomUse)| LANGUAGES.iter().any(|language| has_any(&words, language.rooms[*index]));
    USES.iter().enumerate().find(says).map(|(_, room_use)| *room_use)
}

/// The name of a thing of a role, in the language of most of these rooms. `None` for a role without a name here.
pub fn called<'a>(role: Role, rooms: impl Iterator<Item = &'a str>) -> Option<&'static str> {
    let rooms: Vec<Vec<String>> = rooms.map(words).collect();
    let known = |language: &Language| {
        let is_known = |words: &&Vec<String>| language.rooms.iter().any(|known| has_any(words, known));
        rooms.iter().filter(is_known).count()
    };
    let named = NAMED.iter().position(|named| *named == role)?;
    // The first of the best.
    let best = LANGUAGES.iter().rev().max_by_key(|language| known(language))?;
    Some(best.things[named])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn knows_rooms_in_many_languages() {
        #[rustfmt::skip]
        let cases = [
            ("Schlafzimmer", RoomUse::Bedroom), ("Bad", RoomUse::Bathroom), ("Wohnküche", RoomUse::Kitchen),
            ("camera da letto", RoomUse::Bedroom), ("Salle de bain", RoomUse::Bathroom),
            ("Séjour", RoomUse::LivingRoom), ("Baño 2", RoomUse::Bathroom), ("Cozinha", RoomUse::Kitchen),
            ("slaapkamer", RoomUse::Bedroom), ("Badrum", RoomUse::Bathroom), ("Łazienka", RoomUse::Bathroom),
            ("Ložnice", RoomUse::Bedroom), ("спальня", RoomUse::Bedroom), ("客厅", RoomUse::LivingRoom),
            ("主卫", RoomUse::Bathroom), ("主卧", RoomUse::Bedroom), ("Phòng ngủ", RoomUse::Bedroom),
            ("Flur", RoomUse::Hall), ("Cantina", RoomUse::Aside), ("MasterBedroom", RoomUse::Bedroom),
        ];
        for (name, known) in cases {
            assert_eq!(room_use(name), Some(known), "{name}");
        }
        for name in ["Room", "Zimmer 3", "", "Studio", "Flat"] {
            assert_eq!(room_use(name), None, "{name}");
        }
    }

    #[test]
    fn names_things_in_the_language_of_the_rooms() {
        let bed = |rooms: &[&str]| called(Role::Bed, rooms.iter().copied());
        assert_eq!(bed(&["Wohnzimmer", "Küche", "WC"]), Some("Bett"));
        assert_eq!(bed(&["Soggiorno", "Bagno"]), Some("letto"));
        assert_eq!(bed(&["Room", "Kitchen"]), Some("bed"));
        // Rooms that no language knows count as English.
        assert_eq!(bed(&["A", "B"]), Some("bed"));
        assert_eq!(called(Role::Telephone, ["Bad"].into_iter()), None);
    }

    #[test]
    fn every_language_has_all_of_its_names_apart() {
        for language in &LANGUAGES {
            let mut things = language.things.map(str::to_lowercase).to_vec();
            things.sort();
            things.dedup();
            assert_eq!(things.len(), NAMED.len(), "{:?}", language.things);
            assert!(language.rooms.iter().all(|words| !words.trim().is_empty()));
        }
    }
}
