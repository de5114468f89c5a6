//! What a piece of furniture is for: by what the catalogue calls it and by its shape, then by its name in some languages.

use crate::drawing::Piece;
use homebody_core::names::has_any;
use homebody_core::role::Role;

/// The words for what has a role, the first that fits; sofas come before beds, since a sofa bed is a sofa by day.
const MEANT: &[(Role, &str)] = &[
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

/// What people lie, sit, stand or walk on besides, so that they can be where it is.
const ENTERABLE: &str = "bunk crib cot wheelchair deckchair seat ottoman rocker bidet rug carpet mat doormat teppich tapis \
    tappeto alfombra tapete";

/// Seats that are taken at table where there is no chair.
const STOOL: &str = "stool bench pouf hocker bank tabouret sgabello taburete banco kruk pall 凳";

/// What stands beside those that people are in, under a name that has theirs in it, such as a bed table.
const BESIDE: &str = "table stand nightstand lamp light cabinet shelf shelves cupboard drawer rack mirror curtain screen \
    sink basin washbasin heater radiator machine holder brush paper towel upper hood bedside side pillow toy tv work tisch -tisch";

/// What hangs above what people use.
const ABOVE: &str = "upper hood wall+cabinet dunstabzug hängeschrank";

/// What a piece is for, and whether people can be where it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Meaning {
    pub role: Option<Role>,
    pub is_enterable: bool,
    /// Whether it is a seat that is taken at table where there is no chair.
    pub is_stool: bool,
}

/// What a piece is by all that is known of it.
pub fn of(piece: &Piece) -> Meaning {
    // What the catalogue says is in one language, and its maker chose it; a name may be anything.
    let role = role(piece, &piece.catalog).or_else(|| role(piece, &piece.words));
    let is = |known: &str| {
        let is_in = |words: &[String]| has_any(words, known) && !has_any(words, BESIDE);
        is_in(&piece.catalog) || is_in(&piece.words)
    };
    let is_stool = is(STOOL) && is_seat(piece);
    let is_called = || MEANT.iter().any(|(role, known)| is_entered(*role) && is(known));
    let is_enterable = role.map_or_else(is_called, is_entered) || is(ENTERABLE) || is(STOOL);
    Meaning { role, is_enterable, is_stool }
}

/// Whether people are in a piece with the role, and not before it.
fn is_entered(role: Role) -> bool {
    matches!(role, Role::Bed | Role::Toilet | Role::Shower | Role::Sofa | Role::Armchair | Role::DiningSeat)
}

/// The role that some words say, if the piece has the shape of it.
fn role(piece: &Piece, words: &[String]) -> Option<Role> {
    let is_out = |role| has_any(words, if is_entered(role) { BESIDE } else { ABOVE });
    let said = MEANT.iter().find(|(role, known)| has_any(words, known) && !is_out(*role));
    said.map(|(role, _)| *role).filter(|role| has_shape(piece, *role))
}

/// Whether a piece is large enough to be used, and no larger than such things are: there are beds of dolls, and fridges
/// for the top of a counter.
fn has_shape(piece: &Piece, role: Role) -> bool {
    let (long_m, short_m) = (piece.width_m.max(piece.depth_m), piece.width_m.min(piece.depth_m));
    let top_m = piece.elevation_m + piece.height_m;
    match role {
        Role::Bed => long_m >= 1.6 && short_m >= 0.6,
        Role::Toilet => short_m >= 0.25 && long_m <= 1.5 && top_m <= 1.8,
        Role::Shower => short_m >= 0.5,
        Role::Sofa | Role::Armchair | Role::DiningSeat => is_seat(piece),
        Role::Fridge | Role::Stove => short_m >= 0.3,
        _ => true,
    }
}

/// Whether somebody can sit on it.
fn is_seat(piece: &Piece) -> bool {
    piece.width_m.min(piece.depth_m) >= 0.28 && piece.elevation_m <= 0.4 && (0.25..=1.8).contains(&piece.height_m)
}
