//! Plans of Sweet Home 3D with everything that a resident needs, each with a feature of real plans that blocks residents if the import
//! misreads it.

use crate::imports::plan;
use std::f64::consts::FRAC_PI_2;

pub fn wall([x, y]: [f64; 2], [to_x, to_y]: [f64; 2], thickness: f64) -> String {
    format!("<wall xStart='{x}' yStart='{y}' xEnd='{to_x}' yEnd='{to_y}' thickness='{thickness}'/>")
}

pub fn room(name: &str, [left, top, right, bottom]: [f64; 4]) -> String {
    let points = [[left, top], [right, top], [right, bottom], [left, bottom]];
    let points: String = points.iter().map(|[x, y]| format!("<point x='{x}' y='{y}'/>")).collect();
    format!("<room name='{name}'>{points}</room>")
}

pub fn door(name: &str, [x, y]: [f64; 2], angle: f64) -> String {
    format!("<doorOrWindow name='{name}' x='{x}' y='{y}' angle='{angle}' width='90' depth='20' height='208'/>")
}

/// A piece by its name, its name in the catalogue, its middle, its width, depth and height.
fn piece(name: &str, catalog: &str, [x, y]: [f64; 2], [width, depth, height]: [f64; 3]) -> String {
    let catalog = if catalog.is_empty() { String::new() } else { format!("catalogId='eTeks#{catalog}'") };
    format!(
        "<pieceOfFurniture name='{name}' {catalog} x='{x}' y='{y}' width='{width}' depth='{depth}' height='{height}'/>"
    )
}

/// The walls around 8 by 6 metres.
fn outer(thickness: f64) -> String {
    let corners = [[0.0, 0.0], [800.0, 0.0], [800.0, 600.0], [0.0, 600.0]];
    (0..4).map(|side| wall(corners[side], corners[(side + 1) % 4], thickness)).collect()
}

/// A large room in the west, a kitchen and a bathroom in the east, without their names and furniture.
fn flat() -> String {
    [
        outer(20.0),
        wall([500.0, 0.0], [500.0, 600.0], 10.0),
        wall([500.0, 300.0], [800.0, 300.0], 10.0),
        door("Front door", [250.0, 600.0], 0.0),
        door("Kitchen door", [500.0, 150.0], FRAC_PI_2),
        door("Bathroom door", [500.0, 450.0], FRAC_PI_2),
    ]
    .concat()
}

fn rooms([living, kitchen, bathroom]: [&str; 3]) -> String {
    [
        room(living, [10.0, 10.0, 495.0, 590.0]),
        room(kitchen, [505.0, 10.0, 790.0, 295.0]),
        room(bathroom, [505.0, 305.0, 790.0, 590.0]),
    ]
    .concat()
}

/// A bed, a sofa, a fridge and a toilet, each with its name and its name in the catalogue.
fn furniture(named: [[&str; 2]; 4]) -> String {
    let places = [[90.0, 120.0], [400.0, 60.0], [740.0, 60.0], [740.0, 540.0]];
    let sizes = [[140.0, 200.0, 55.0], [150.0, 85.0, 85.0], [60.0, 66.0, 185.0], [40.0, 70.0, 62.0]];
    let pieces = named.iter().zip(places.iter().zip(sizes));
    pieces.map(|([name, catalog], (at, size))| piece(name, catalog, *at, size)).collect()
}

const NAMED: [&str; 3] = ["Living room", "Kitchen", "Bathroom"];
const PLAIN: [[&str; 2]; 4] = [["Bed", "bed"], ["Sofa", "sofa"], ["Fridge", "fridge"], ["Toilet", ""]];

/// A house of two floors: a flight of stairs leads from the hall below to the landing above.
pub fn house() -> String {
    let on = |level: &str, drawn: &str| {
        let tags = ["wall", "room", "doorOrWindow", "pieceOfFurniture"];
        tags.iter()
            .fold(drawn.to_owned(), |text, tag| text.replace(&format!("<{tag} "), &format!("<{tag} level='{level}' ")))
    };
    let stairs = piece("Staircase", "staircase", [650.0, 60.0], [220.0, 80.0, 280.0]);
    let below = [
        flat(),
        rooms(["Living room", "Hall", "Kitchen"]),
        piece("Sofa", "sofa", [400.0, 60.0], [150.0, 85.0, 85.0]),
        piece("Fridge &amp; Freezer", "fridgeFreezer", [740.0, 540.0], [60.0, 66.0, 185.0]),
        stairs,
    ];
    let above = [
        flat().replace("Front door", "Balcony door"),
        rooms(["Bedroom", "Landing", "Bathroom"]),
        piece("Bed", "bed", [90.0, 120.0], [140.0, 200.0, 55.0]),
        piece("Toilet unit", "toiletUnit", [740.0, 540.0], [40.0, 70.0, 62.0]),
    ];
    let levels = "<level id='a' name='Ground floor' elevation='0' height='250'/>\
        <level id='b' name='First floor' elevation='262' height='250'/>";
    format!("{levels}{}{}", on("a", &below.concat()), on("b", &above.concat()))
}

pub fn whole_plans() -> Vec<(String, Vec<u8>)> {
    let carpets = [
        piece("Box", "texturableBox", [500.0, 450.0], [120.0, 90.0, 0.7]),
        piece("Cylinder", "texturableCylinder", [250.0, 480.0], [400.0, 180.0, 0.5]),
        piece("Box", "texturableBox", [500.0, 150.0], [120.0, 90.0, 4.0]),
    ];
    let italian = [
        ["Letto", "bed140x190"],
        ["Divano a due posti", ""],
        ["Frigorifero e congelatore", "fridgeFreezer"],
        ["Vaso", "toiletUnit"],
    ];
    let japanese = [["ベッド", ""], ["ソファ", ""], ["冷蔵庫", ""], ["トイレ", ""]];
    let unlike =
        [["Bed cherry", "bed"], ["Corner sofa", "cornerSofa"], ["Dispensa", ""], ["Toilet unit", "toiletUnit"]];
    let sliding = "<doorOrWindow name='Slider window' catalogId='eTeks#sliderWindow126x200' x='250' y='600' width='132' depth='27' \
        height='210' elevation='11'/>";
    let front = door("Front door", [250.0, 600.0], 0.0);
    let thick = |thickness: f64| {
        let face = thickness / 2.0;
        let walls = [
            outer(thickness),
            wall([500.0, face], [500.0, 600.0 - face], 10.0),
            wall([505.0, 300.0], [800.0 - face, 300.0], 10.0),
            front.clone(),
            door("Kitchen door", [500.0, 150.0], FRAC_PI_2),
            door("Bathroom door", [500.0, 450.0], FRAC_PI_2),
        ];
        walls.concat()
    };
    let whole = wall([500.0, 0.0], [500.0, 600.0], 10.0);
    let gaps = [[0.0, 105.0], [195.0, 405.0], [495.0, 600.0]].map(|[from, to]| wall([500.0, from], [500.0, to], 10.0));
    let plans = [
        ("carpets", [flat(), rooms(NAMED), furniture(PLAIN), carpets.concat()].concat()),
        ("Italian", [flat(), rooms(["Soggiorno", "Cucina", "Bagno"]), furniture(italian)].concat()),
        ("Japanese", [flat(), rooms(["", "", ""]), furniture(japanese)].concat()),
        ("other names", [flat(), rooms(["Lounge", "Kitchen/Dining", "WC"]), furniture(unlike)].concat()),
        ("sliding window", [flat().replace(&front, sliding), rooms(NAMED), furniture(PLAIN)].concat()),
        ("thick walls", [thick(50.0), furniture(PLAIN)].concat()),
        ("stone walls", [thick(60.0), furniture(PLAIN)].concat()),
        ("gaps", [flat().replace(&whole, &gaps.concat()), furniture(PLAIN)].concat()),
        ("two floors", house()),
    ];
    plans.into_iter().map(|(name, drawn)| (name.to_owned(), plan(&drawn))).collect()
}
