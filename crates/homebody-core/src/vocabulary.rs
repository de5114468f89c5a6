//! Words for furniture, doors and sensors in many languages, and a search for them in names.
//!
//! The import of plans and the readers of logs need the same words: they stand here once.

use crate::role::Role;

/// Whether any of some known words, with blanks between, is among the words.
///
/// `a+b` asks for both of two; `-bett` is also the end of a longer word, as in `Doppelbett`. Words in scripts without blanks
/// may stand anywhere in another. An English plural is its singular, too. Programs write `Haustür` as `haustuer` or `haustur`.
pub fn has_any(words: &[String], known: &str) -> bool {
    let has = |known: &str| words.iter().any(|word| is_word(word, known));
    known.split_whitespace().any(|known| known.split('+').all(has))
}

fn is_word(word: &str, known: &str) -> bool {
    /// The first character of the scripts that put no blanks between words, Chinese and Japanese.
    const WITHOUT_BLANKS: char = '\u{2e80}';
    match known.strip_prefix('-') {
        Some(end) => word.ends_with(end) || !end.is_ascii() && word.ends_with(&in_ascii(end, true)),
        None if known.starts_with(|c| c >= WITHOUT_BLANKS) => word.contains(known),
        None if known.is_ascii() => word == known || word.strip_suffix('s') == Some(known),
        None => word == known || [true, false].into_iter().any(|is_long| is_written(word, known, is_long)),
    }
}

/// Whether a word is a known one without the marks on its letters.
fn is_written(word: &str, known: &str, is_long: bool) -> bool {
    let mut left = word;
    for c in known.chars() {
        let rest = match in_letters(c, is_long) {
            Some(letters) => left.strip_prefix(letters),
            None => left.strip_prefix(c),
        };
        match rest {
            Some(rest) => left = rest,
            None => return false,
        }
    }
    left.is_empty()
}

/// A word without the marks on its letters. The long form writes `ü` as `ue`, as people do; the short one as `u`, as programs do.
pub(crate) fn in_ascii(word: &str, is_long: bool) -> String {
    let mut plain = String::with_capacity(word.len());
    for c in word.chars() {
        match in_letters(c, is_long) {
            Some(letters) => plain.push_str(letters),
            None => plain.push(c),
        }
    }
    plain
}

/// A letter without its marks; `None` for any other character.
fn in_letters(c: char, is_long: bool) -> Option<&'static str> {
    const LONG: [(char, &str); 4] = [('ä', "ae"), ('ö', "oe"), ('ü', "ue"), ('ø', "oe")];
    const SHORT: [(&str, &str); 15] = [
        ("àáâãäåąă", "a"),
        ("çćč", "c"),
        ("ď", "d"),
        ("èéêëęě", "e"),
        ("ìíîï", "i"),
        ("ł", "l"),
        ("ñńň", "n"),
        ("òóôõöøő", "o"),
        ("ř", "r"),
        ("śš", "s"),
        ("ť", "t"),
        ("ùúûüůű", "u"),
        ("ý", "y"),
        ("źżž", "z"),
        ("ß", "ss"),
    ];
    if c.is_ascii() {
        return None;
    }
    let long = LONG.iter().find(|(marked, _)| is_long && *marked == c).map(|(_, plain)| *plain);
    long.or_else(|| SHORT.iter().find(|(marked, _)| marked.contains(c)).map(|(_, plain)| *plain))
}

/// The words for pieces with a role, the first that fits; sofas come before beds, since a sofa bed is a sofa by day.
pub const ROLE_WORDS: &[(Role, &str)] = &[
    (Role::FoodWarmer, "microwave mikrowelle microonde microondas magnetron toaster"),
    (
        Role::WashingMachine,
        "washing+machine clothes+washer washer waschmaschine lave+linge lavatrice lavadora wasmachine \
        tvättmaskin pralka pračka 洗衣机 洗濯機",
    ),
    (Role::Dryer, "clothes+dryer tumble+dryer wäschetrockner sèche+linge asciugatrice secadora"),
    (
        Role::Fridge,
        "fridge refrigerator freezer kühlschrank frigo réfrigérateur frigorifero frigorífico nevera heladera \
        geladeira koelkast kylskåp lodówka lednice холодильник 冰箱 冷蔵庫",
    ),
    (
        Role::Stove,
        "stove cooker cooktop hob oven herd backofen kochfeld cuisinière fornelli forno estufa fogão fornuis spis \
        kuchenka sporák плита 炉 コンロ",
    ),
    (
        Role::Washbasin,
        "washbasin basin bathroom+sink lavabo waschbecken waschtisch lavamanos lavatório wastafel tvättställ \
        umywalka umyvadlo умывальник 洗面 洗手",
    ),
    (Role::Sink, "sink spüle évier lavello fregadero gootsteen diskbänk zlew dřez мойка 水槽"),
    (Role::Counter, "worktop countertop kitchen+counter kitchen+island arbeitsplatte"),
    (Role::Drawers, "kitchen+cabinet kitchen+cupboard kitchen+drawer küchenschrank"),
    (
        Role::Toilet,
        "toilet wc lavatory loo toilette klosett klo inodoro váter retrete sanita toalett toaleta záchod унитаз \
        马桶 便器 トイレ",
    ),
    (
        Role::Shower,
        "shower bath bathtub tub dusche -dusche badewanne douche baignoire doccia vasca ducha bañera chuveiro \
        banheira dusch badkar ligbad prysznic wanna sprcha vana душ ванна 浴缸 淋浴 シャワー 浴槽",
    ),
    (Role::Sofa, "sofa couch settee loveseat -sofa -couch canapé divano sofá soffa kanapa pohovka диван 沙发 ソファ"),
    (
        Role::Bed,
        "bed daybed futon mattress bett -bett matratze lit letto cama säng -säng łóżko postel кровать 床 ベッド",
    ),
    (
        Role::Armchair,
        "armchair arm+chair recliner easy+chair rocking+chair lounge+chair sessel -sessel fauteuil poltrona \
        sillón butaca leunstoel fåtölj fotel křeslo кресло 扶手椅 アームチェア",
    ),
    (
        Role::DiningSeat,
        "chair chaise sedia silla cadeira stuhl -stuhl stoel -stoel stol -stol krzesło židle стул 椅 いす",
    ),
    (Role::Television, "tv television fernseher télévision televisione televisor televisie телевизор 电视 テレビ"),
    (
        Role::Bookcase,
        "bookcase bookshelf bücherregal bibliothèque libreria librería boekenkast bokhylla regał 书架 本棚",
    ),
    (
        Role::Wardrobe,
        "wardrobe closet kleiderschrank armoire armadio armario guarda+roupa kledingkast garderob szafa šatní \
        шкаф 衣柜 chest+drawer commode kommode",
    ),
];

/// The words for doors.
pub const DOOR_WORDS: &str = "door doorway frontdoor maindoor backdoor gate tür -tür türe porte puerta porta portone deur -deur dörr \
    -dörr dør ovi drzwi dveře дверь 门 ドア 扉";

/// The words for the front door.
pub const FRONT_WORDS: &str = "front entrance entry main apartment haustür wohnungstür eingang -eingangstür entrée ingresso entrada \
    principal voordeur ytterdörr entré wejściowe vchodové входная 大门 前门 玄関";

/// The words for windows in the catalogue and in some languages.
pub const WINDOW_WORDS: &str = "window windows fenster -fenster fenetre fenêtre ventana finestra janela raam fönster vindu okno \
    okna окно 窗 窓";

/// The words for a sensor that sees movement.
pub const MOTION_WORDS: &str = "motion pir movement mmwave radar bewegung -bewegung bewegungsmelder bewegungssensor mouvement \
    movimiento movimento beweging bewegingsmelder bewegingssensor rörelse rörelsesensor rörelsevakt bevegelse bevægelse ruch ruchu \
    pohyb liike движение движения 人感 人体 移动 运动 動き モーション";

/// The words for a sensor of presence: it sees a person, or feels one who lies or sits on it.
pub const OCCUPANCY_WORDS: &str = "occupancy occupied presence anwesenheit präsenz präsenzmelder belegung belegt présence occupation \
    presencia ocupación presença ocupação presenza occupazione aanwezigheid bezet närvaro obecność přítomnost присутствие 在席 存在";

/// The words for a sensor that feels whether something is open.
pub const CONTACT_WORDS: &str = "contact kontakt -kontakt kontaktsensor magnetic magnet magnetkontakt reed reedkontakt contatto contacto \
    magnétique magnético magnetico kontaktron styk магнит геркон 门磁 門磁 開閉";

/// The words for a sensor of a device, its network or its program.
pub const DEVICE_WORDS: &str = "battery batterie akku batería bateria batteria batterij bateria batteri tamper sabotage connectivity online \
    reachable erreichbar update firmware linkquality rssi lqi wifi wlan uptime overheating overcurrent diagnostic indicator";

#[cfg(test)]
mod tests {
    use super::*;
    use crate::names::words;

    #[test]
    fn known_words_are_found_in_the_ways_of_languages() {
        let has = |name: &str, known: &str| has_any(&words(name), known);
        assert!(has("Washing machine", "washer washing+machine") && !has("Coffee machine", "washer washing+machine"));
        assert!(has("Doppelbett 180", "bed -bett") && !has("Bettkasten", "bed -bett"));
        assert!(has("haustuer", "-tür") && has("dorr", "dörr") && has("Küche", "küche") && has("kuche", "küche"));
        assert!(!has("Temperatur", "tür -tür"), "only people write one letter for two at the end of a longer word");
        assert!(has("双人床", "床") && has("Chairs", "chair") && !has("Chairman", "chair"));
    }
}
