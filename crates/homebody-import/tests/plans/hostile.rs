//! Broken and hostile files give an error soon, and never a panic.

use crate::plans::plan::{archive, door, file, import, packed, piece, room, two_rooms, wall};
use homebody_core::geometry::Point;
use homebody_core::messages::Diagnose;
use homebody_core::random::Stream;
use homebody_import::ImportError;
use std::f64::consts::FRAC_PI_2;
use std::time::{Duration, Instant};
use zip::CompressionMethod;

/// Much more than any of it takes, also where the machine is busy with other things: nothing here takes minutes.
const SOON: Duration = Duration::from_secs(20);

#[track_caller]
fn refused(bytes: &[u8]) -> ImportError {
    let begun = Instant::now();
    let error = import(bytes).unwrap_err();
    assert!(begun.elapsed() < SOON, "{:?}: {error}", begun.elapsed());
    let text = error.to_string();
    assert!(text.contains("\n  hint: ") && text.len() < 2_000, "{text}");
    error
}

#[test]
fn rejects_files_that_are_not_plans() {
    for bytes in [&b""[..], b"PK", b"<home/>", &[0; 1000], &[0xff; 1000]] {
        assert_eq!(refused(bytes), ImportError::NoArchive);
    }
    for entries in [&[][..], &[("home.xml", &b"<home/>"[..])], &[("a/Home.xml", b"<home/>")]] {
        assert_eq!(refused(&archive(entries)), ImportError::NoHomeXml);
    }
    let xml = |xml: &[u8]| refused(&archive(&[("Home.xml", xml)])).diagnostic().code;
    assert_eq!(xml(b""), "import::not-xml");
    assert_eq!(xml(b"<home>"), "import::not-xml");
    assert_eq!(xml(b"<home><wall xStart='1' xStart='1'/></home>"), "import::not-xml");
    assert_eq!(xml(b"\xff\xfe<\0h\0"), "import::not-utf-8");
    for empty in ["<home/>", "<other><wall/></other>", "\u{feff}<home/>"] {
        assert_eq!(xml(empty.as_bytes()), "import::no-rooms");
    }
}

#[test]
fn bombs_do_not_go_off() {
    let zeros = vec![0; 40 << 20];
    assert!(matches!(refused(&archive(&[("Home.xml", &zeros)])), ImportError::TooLarge { .. }));
    // Small enough, and shrunk more than any text.
    let blanks = vec![b' '; 20 << 20];
    assert!(matches!(refused(&archive(&[("Home.xml", &blanks)])), ImportError::TooLarge { .. }));
    // Other entries are not unpacked.
    assert!(import(&archive(&[("Home", &zeros), ("Home.xml", home(&two_rooms()).as_bytes())])).is_ok());
    assert!(matches!(refused(&vec![b'P'; (64 << 20) + 1]), ImportError::TooLarge { .. }));
    let entries: Vec<String> = (0..20_001).map(|index| index.to_string()).collect();
    let entries: Vec<(&str, &[u8])> = entries.iter().map(|name| (&name[..], &b""[..])).collect();
    assert!(matches!(refused(&archive(&entries)), ImportError::TooLarge { unit: "entries", .. }));
}

fn home(drawn: &str) -> String {
    format!("<home>{drawn}</home>")
}

#[test]
fn an_entry_that_lies_about_its_size_is_refused() {
    let mut bytes = archive(&[("Home.xml", &vec![0; 40 << 20])]);
    // Both headers have the size; they claim 1,000 bytes.
    let size = (40_u32 << 20).to_le_bytes();
    let at: Vec<usize> = (0..bytes.len() - 4).filter(|&at| bytes[at..at + 4] == size).collect();
    assert!(!at.is_empty());
    for at in at {
        bytes[at..at + 4].copy_from_slice(&1_000_u32.to_le_bytes());
    }
    refused(&bytes);
}

#[test]
fn markup_that_no_plan_has_is_refused() {
    let refused = |xml: &str| {
        // Not packed, since much of the same would be taken for a bomb.
        refused(&packed(&[("Home.xml", xml.as_bytes())], CompressionMethod::Stored)).to_string()
    };
    let entities: String = (1..10)
        .map(|depth| {
            let ten = format!("&e{};", depth - 1).repeat(10);
            format!("<!ENTITY e{depth} \"{ten}\">")
        })
        .collect();
    let bomb = format!("<!DOCTYPE home [<!ENTITY e0 \"e\">{entities}]><home><room name='&e9;'/></home>");
    assert!(refused(&bomb).contains("a document type"));
    assert!(refused("<!DOCTYPE home SYSTEM 'file:///etc/passwd'><home/>").contains("a document type"));
    let groups = "<furnitureGroup>".repeat(100_000) + &"</furnitureGroup>".repeat(100_000);
    assert!(refused(&home(&groups)).contains("nested"));
    let attributes: String = (0..100_000).map(|index| format!(" a{index}='1'")).collect();
    assert!(refused(&home(&format!("<wall{attributes}/>"))).contains("more attributes"));
    // The comment continues after its first `>`, and its content does not hide the wall behind it.
    let hidden = format!("<!--><![CDATA[--><wall{}/><!--]]>-->", &attributes[..4_000]);
    assert!(refused(&home(&hidden)).contains("more attributes"));
    let namespaces: String = (0..100).map(|index| format!(" xmlns:a{index}='{index}'")).collect();
    assert!(refused(&home(&format!("<wall{namespaces}/>"))).contains("a namespace"));
    assert!(refused(&home(&"<a/>".repeat(1_100_000))).contains("more elements"));
    assert!(refused(&home(&format!("<a b='{}'/>", "=".repeat(4_100_000)))).contains("more elements"));
    assert!(refused(&home("<room name='&nothing;'/>")).contains("nothing"));
}

#[test]
fn reads_markup_that_only_looks_bad() {
    let drawn =
        "<!-- <!DOCTYPE <a <a --><!--><!DOCTYPE <a --><property name='xmlns:a' value='a=b > c'/><![CDATA[<!DOCTYPE]]>"
            .to_owned();
    assert!(import(&file(&(drawn + &two_rooms()))).is_ok());
}

#[test]
fn numbers_that_are_none_are_left_out() {
    let odd = ["NaN", "nan", "Infinity", "-inf", "1e308", "1e7", "1,5", "", "0x10", "--1", "1e999", "ten", "٣"];
    for number in odd {
        let drawn = two_rooms()
            + &format!("<wall xStart='{number}' yStart='100' xEnd='300' yEnd='100' thickness='10'/>")
            + &format!(
                "<wall xStart='150' yStart='150' xEnd='200' yEnd='150' thickness='{number}' arcExtent='{number}'/>"
            )
            + &format!("<pieceOfFurniture name='a' x='300' y='{number}' width='10' depth='10' height='10'/>")
            + &format!("<pieceOfFurniture name='b' x='300' y='300' width='10' depth='{number}' height='10'/>")
            + &format!(
                "<pieceOfFurniture name='c' x='300' y='300' width='10' depth='10' height='10' angle='{number}'/>"
            )
            + &format!("<doorOrWindow name='d' x='300' y='100' width='{number}'/>")
            + &format!("<room name='e'><point x='{number}' y='1'/><point x='9' y='1'/><point x='5' y='9'/></room>");
        let home = crate::plans::plan::Home::of(&drawn);
        assert_eq!((home.file.walls.len(), home.file.furniture.len(), home.file.doors.len()), (6, 1, 2), "{number}");
        assert_eq!(home.rooms().len(), 2);
        home.remarks("left out: 5 things without place or size");
    }
}

#[test]
fn attributes_may_be_missing() {
    let bare = ["wall", "room", "doorOrWindow", "pieceOfFurniture", "light", "level", "furnitureGroup", "compass"];
    let bare: String = bare.iter().map(|tag| format!("<{tag}/>")).collect();
    let home = crate::plans::plan::Home::of(&(two_rooms() + &bare + "<room><point/><point/><point/></room><room/>"));
    assert_eq!(home.rooms().len(), 2);
}

#[test]
fn great_numbers_of_things_are_refused_soon() {
    let many = |count: usize, thing: &dyn Fn(f64) -> String| -> String {
        (0..count).map(|index| thing(index as f64)).collect()
    };
    let line = |at: f64| wall([at % 1000.0, at / 1000.0], [at % 1000.0 + 50.0, at / 500.0]);
    let count = |drawn: String| match refused(&file(&(two_rooms() + &drawn))) {
        ImportError::TooMany { what, count, .. } => (what, count),
        error => panic!("{error}"),
    };
    assert_eq!(count(many(100_000, &line)), ("walls", 100_005));
    assert_eq!(count(many(30_000, &|_| door("", [300.0, 100.0], 0.0, ""))), ("doors", 30_002));
    let small = |_| piece("chair", [300.0, 300.0], [10.0, 10.0, 10.0], "");
    assert_eq!(count(many(30_000, &small)), ("pieces of furniture", 30_000));
    assert_eq!(count(many(30_000, &|at| room("", &[[at, 0.0], [at, 1.0], [0.0, 1.0]]))), ("rooms", 30_002));
    let star: Vec<[f64; 2]> = (0..30_000).map(|at| [f64::from(at * 7_919 % 30_011), f64::from(at)]).collect();
    assert_eq!(count(room("", &star)), ("corners of rooms", 30_008));
    let level = |at: f64| format!("<level id='{at}' name='a' elevation='0'/>");
    let begun = Instant::now();
    assert!(import(&file(&(two_rooms() + &many(100_000, &level)))).is_ok());
    assert!(begun.elapsed() < SOON);
}

#[test]
fn a_long_name_of_a_level_is_not_copied_to_all_that_is_on_it() {
    let level = "l".repeat(4 << 20);
    let group = format!("<furnitureGroup level='{level}'>{}</furnitureGroup>", "<label/>".repeat(50_000));
    let xml = home(&(format!("<level id='{level}' name='a'/>") + &two_rooms() + &group));
    let begun = Instant::now();
    assert!(import(&packed(&[("Home.xml", xml.as_bytes())], CompressionMethod::Stored)).is_ok());
    assert!(begun.elapsed() < SOON, "{:?}", begun.elapsed());
}

#[test]
fn computes_hard_plans_soon() {
    let timed = |what: &str, drawn: &str| {
        let begun = Instant::now();
        let remarks = import(&file(drawn)).map_or(0, |imported| imported.remarks.len());
        assert!(remarks < 50, "{what}: nobody reads {remarks} remarks");
        assert!(begun.elapsed() < SOON, "{what}: {:?}", begun.elapsed());
    };
    let star = |count: u32| -> String {
        let ray = |index: u32| {
            let (sin, cos) = f64::from(index).sin_cos();
            wall([cos * 900.0, sin * 900.0], [-cos * 900.0, -sin * 900.0])
        };
        (0..count).map(ray).collect()
    };
    timed("walls that all cross", &star(4_900));
    timed("fewer walls that all cross", &star(1_990));
    let grid = |count: u32, apart: f64| -> String {
        let line = |index: u32| {
            let at = f64::from(index) * apart;
            wall([at, 0.0], [at, 9_000.0]) + &wall([0.0, at], [9_000.0, at])
        };
        (0..count).map(line).collect()
    };
    timed("a grid of walls", &grid(2_400, 20.0));
    timed("a smaller grid of walls", &grid(70, 20.0));
    let strip = |index: u32| {
        let at = f64::from(index) * 40.0;
        room("strip", &[[at, 0.0], [at + 30.0, 0.0], [at + 1_030.0, 2_000.0], [at + 1_000.0, 2_000.0]])
    };
    let strips: String = (0..199).map(strip).collect();
    timed("a grid of spaces", &(grid(19, 100.0) + &strips));
    timed("a large grid of spaces", &(grid(90, 100.0) + &strips));
    let comb = |name: &str, is_upright: bool, shift: f64| {
        let teeth = (0..24).flat_map(|tooth| {
            let at = f64::from(tooth) * 20.0;
            [[at, 0.0], [at, 480.0], [at + 10.0, 480.0], [at + 10.0, -10.0]]
        });
        let turned = |[x, y]: [f64; 2]| if is_upright { [x + shift, y] } else { [y, x + shift] };
        room(name, &teeth.map(turned).collect::<Vec<_>>())
    };
    let combs: String = (0..20).map(|index| comb("comb", index % 2 == 0, f64::from(index) * 0.1)).collect();
    timed("combs across combs", &combs);
    let long_comb = |turn: f64| {
        let teeth = (0..248).flat_map(|tooth| {
            let x = f64::from(tooth) * 20.0;
            [[x, 0.0], [x, 4_960.0], [x + 10.0, 4_960.0], [x + 10.0, 0.0]]
        });
        let corners = teeth.chain([[4_960.0, -20.0], [0.0, -20.0]]);
        let turned = |[x, y]: [f64; 2]| Point::from_angle(turn).rotate(Point::new(x - 2_480.0, y - 2_480.0)).into();
        room("comb", &corners.map(turned).collect::<Vec<_>>())
    };
    timed("a long comb across another", &(long_comb(0.3) + &long_comb(0.9)));
    timed("a long comb upright on another", &(long_comb(0.0) + &long_comb(FRAC_PI_2)));
    let knot: Vec<[f64; 2]> = (0..1_990)
        .map(|index| (f64::from(index) * 2.4).sin_cos().into())
        .map(|[x, y]: [f64; 2]| [x * 500.0, y * 500.0])
        .collect();
    timed("a knot of a room", &room("knot", &knot));
    let doors: String = (0..990).map(|index| door("d", [f64::from(index % 900), 100.0], 0.0, "width='3'")).collect();
    timed("many doors", &(two_rooms() + &doors + &star(4_000)));
    let sheets: String = (0..4_000).map(|at| wall([100.0, 100.0 + f64::from(at) / 10.0], [900.0, 100.0])).collect();
    let deep: String = (0..990).map(|_| door("d", [500.0, 110.0], 0.0, "wallThickness='0.9'")).collect();
    timed("doors through many walls", &(two_rooms() + &sheets + &deep));
    let arcs: String = (0..4_000)
        .map(|index| {
            format!("<wall xStart='{index}' yStart='0' xEnd='{index}' yEnd='1' thickness='9' arcExtent='6.28'/>")
        })
        .collect();
    timed("many arcs", &arcs);
    let round = "<wall xStart='0' yStart='0' xEnd='900000' yEnd='0' thickness='9' arcExtent='3.1'/>";
    timed("a great arc", &(two_rooms() + round + &doors));
    let home = crate::plans::plan::Home::of(&(two_rooms() + round));
    home.remarks("more than 100 m away");
    assert_eq!(home.file.walls.len(), 5);
    let wide: String = (0..900).map(|index| piece("p", [300.0, f64::from(index)], [5_000.0, 1.0, 1.0], "")).collect();
    timed("furniture that reaches out", &(two_rooms() + &wide));
}

#[test]
fn truncated_files_are_refused_or_read() {
    let bytes = file(&(two_rooms() + &piece("Bed", [800.0, 300.0], [160.0, 200.0, 50.0], "")));
    assert!(import(&bytes).is_ok());
    for length in (0..bytes.len()).step_by(97) {
        assert!(import(&bytes[..length]).is_err(), "{length} of {}", bytes.len());
    }
    let xml = home(&two_rooms());
    for length in (0..xml.len()).step_by(7) {
        assert!(import(&archive(&[("Home.xml", &xml.as_bytes()[..length])])).is_err());
    }
}

/// Files with some bytes changed, and plans with some changed, moved or repeated.
#[test]
fn mutants_make_nobody_panic() {
    let drawn = two_rooms()
        + &door("Window", [400.0, 100.0], 0.1, "elevation='85'")
        + "<wall xStart='500' yStart='100' xEnd='500' yEnd='500' thickness='10' arcExtent='1.5'/>"
        + "<level id='a' name='b' elevation='0'/><furnitureGroup name='g'>"
        + &piece("Bed", [800.0, 300.0], [160.0, 200.0, 50.0], "angle='0.3'")
        + "</furnitureGroup>";
    let (bytes, xml) = (file(&drawn), home(&drawn).into_bytes());
    let (mut sound, mut wrong) = (0, 0);
    for case in 0..3_000 {
        let dice = &mut Stream::named(case, "mutant");
        let mutant = match case % 3 {
            0 => mutated(&bytes, dice),
            _ => archive(&[("Home.xml", &mutated(&xml, dice))]),
        };
        match import(&mutant) {
            Ok(imported) => {
                crate::plans::plan::Home::from(imported);
                sound += 1;
            }
            Err(error) => {
                assert!(error.to_string().contains("\n  hint: "), "{error}");
                wrong += 1;
            }
        }
    }
    assert!(sound > 300 && wrong > 300, "{sound} were imported, {wrong} refused");
}

fn mutated(bytes: &[u8], dice: &mut Stream) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    for _ in 0..=(dice.unit() * 4.0) as usize {
        let at = |dice: &mut Stream| (dice.unit() * bytes.len() as f64) as usize;
        let (place, other, length) = (at(dice), at(dice), (dice.unit() * 12.0) as usize + 1);
        let end = (other + length).min(bytes.len());
        match (dice.unit() * 6.0) as u32 {
            0 => bytes[place] = (dice.unit() * 256.0) as u8,
            // Digits stay digits, so that what changes is the drawing.
            1 | 2 => {
                let digit = (place..bytes.len()).find(|&at| bytes[at].is_ascii_digit());
                digit.iter().for_each(|&at| bytes[at] = b"0123456789.-e"[(dice.unit() * 13.0) as usize]);
            }
            3 => {
                let part = bytes[other..end].to_vec();
                let place = place.min(bytes.len() - part.len());
                bytes[place..place + part.len()].copy_from_slice(&part);
            }
            4 => {
                let part = bytes[other..end].to_vec();
                bytes.splice(place..place, part);
            }
            _ => {
                bytes.drain(other..end);
            }
        }
        if bytes.is_empty() {
            break;
        }
    }
    bytes
}
