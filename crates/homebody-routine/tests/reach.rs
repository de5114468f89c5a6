//! Unreachable places: reported before a run where they are needed, replaced where possible, and given up during a run.

mod stage;

use homebody_core::geometry::Point;
use homebody_core::motion::MotionState;
use homebody_core::run::Run;
use homebody_core::time::{DAY, HOUR, RunTime, Span};
use stage::{ORDINARY, activities, events, files, hour, household};
use std::collections::BTreeMap;

/// Name, position in the way, position elsewhere, and size in metres.
type Piece = (&'static str, [f64; 2], [f64; 2], [f64; 2]);

/// Tables around the dining chair, whose other sides are a wall and the dining table.
const TABLES: [Piece; 2] =
    [("west table", [7.48, 3.25], [6.2, 3.9], [0.4, 1.0]), ("north table", [7.85, 3.9], [5.0, 3.9], [1.2, 0.5])];

/// Screens around the place before the stove.
const SCREENS: [Piece; 3] = [
    ("west screen", [7.1, 1.2], [0.5, 6.3], [0.1, 0.98]),
    ("east screen", [7.9, 1.2], [0.8, 6.2], [0.1, 0.98]),
    ("north screen", [7.5, 1.75], [3.2, 6.3], [0.9, 0.1]),
];

type Pieces<'a> = &'a [Piece];

/// The scenario with these pieces in the way or elsewhere, and additional ones.
fn with_pieces(pieces: Pieces, in_the_way: bool, besides: &str) -> BTreeMap<String, String> {
    let piece = |(name, here, there, size): &(&str, [f64; 2], [f64; 2], [f64; 2])| {
        let at = if in_the_way { here } else { there };
        format!("{{ \"name\": \"{name}\", \"at\": {at:?}, \"size_m\": {size:?}, \"height_m\": 0.75 }},\n")
    };
    let mut files = files(ORDINARY, &[]);
    let pieces: String = pieces.iter().map(piece).collect();
    let home = files["home.json"].replace("\"furniture\": [", &format!("\"furniture\": [\n{pieces}{besides}"));
    files.insert("home.json".into(), home);
    files
}

fn with_bathroom_door(open: bool) -> BTreeMap<String, String> {
    let mut files = files(ORDINARY, &[]);
    let jambs = "\"from\": [2.6, 1.65], \"to\": [2.6, 2.55]";
    let home = files["home.json"].replace(jambs, &format!("{jambs}, \"open\": {open}"));
    assert_ne!(home, files["home.json"]);
    files.insert("home.json".into(), home);
    files
}

/// The problems of these files.
fn said(files: &BTreeMap<String, String>) -> String {
    household(files, &[]).err().unwrap_or_default()
}

#[test]
fn a_chair_boxed_in_by_tables_is_said_and_what_would_free_it() {
    assert_eq!(said(&with_pieces(&TABLES, false, "")), "");
    let said = said(&with_pieces(&TABLES, true, ""));
    assert!(said.contains("margaret cannot get from \"bed\" to \"dining chair\""), "{said}");
    assert!(said.contains("move \"west table\", or move \"north table\""), "{said}");
    assert_eq!(said.matches("cannot get").count(), 1, "{said}");
}

#[test]
fn so_is_a_stove_and_a_door_that_is_shut() {
    assert_eq!(said(&with_pieces(&SCREENS, false, "")), "");
    let stove = said(&with_pieces(&SCREENS, true, ""));
    assert!(stove.contains("margaret cannot get from \"bed\" to \"stove\""), "{stove}");
    assert!(stove.contains("move \"west screen\"") && stove.contains("move \"north screen\""), "{stove}");
    assert_eq!(stove.matches("cannot get").count(), 1, "{stove}");
    assert_eq!(said(&with_bathroom_door(true)), "");
    let bathroom = said(&with_bathroom_door(false));
    for place in ["toilet", "washbasin", "shower"] {
        assert!(bathroom.contains(&format!("cannot get from \"bed\" to \"{place}\"")), "{place}: {bathroom}");
    }
    assert!(bathroom.contains("open \"bathroom door\""), "{bathroom}");
}

#[test]
fn a_place_that_a_rule_names_is_said_with_its_line() {
    let mut files = with_pieces(&SCREENS, true, "");
    let routine =
        "Margaret is 82.\nWhenever she has been in bed for 2 hours, she relaxes at the stove for 5 minutes.\n";
    files.insert("margaret.routine".into(), routine.into());
    let said = said(&files);
    assert!(said.contains("to \"stove\""), "{said}");
    let walled_in = r#"{ "name": "west wardrobe", "at": [2.35, 5.0], "size_m": [0.2, 2.9], "height_m": 2.0 },
        { "name": "south wardrobe", "at": [1.2, 4.25], "size_m": [2.4, 0.1], "height_m": 2.0 },"#;
    let said = self::said(&with_pieces(&[], false, walled_in));
    assert!(said.contains("margaret cannot get from \"bed\" to the rest of the home"), "{said}");
    assert_eq!(said.matches("cannot get").count(), 1, "{said}");
}

/// Hours per day and beginnings per day of each activity.
fn days_of(run: Run, days: i64) -> BTreeMap<String, (f64, f64)> {
    let mut of: BTreeMap<String, (f64, f64)> = BTreeMap::new();
    for (time, name) in activities(&events(run, DAY), 0, days * DAY) {
        let (hours, times) = of.entry(name).or_default();
        *hours += time.length().ratio(HOUR) / days as f64;
        *times += 1.0 / days as f64;
    }
    of
}

#[track_caller]
fn assert_is_a_life(of: &BTreeMap<String, (f64, f64)>) {
    let hours = |name: &str| of.get(name).map_or(0.0, |(hours, _)| *hours);
    assert!((5.0..11.0).contains(&hours("sleeping")), "{of:?}");
    assert!(hours("drinking") < 2.0 && hours("having_a_snack") < 2.0 && hours("using_bathroom") < 2.0, "{of:?}");
    let meals: f64 = ["breakfast", "lunch", "dinner"].iter().map(|meal| hours(&format!("eating_{meal}"))).sum();
    assert!(meals > 0.7, "{of:?}");
}

#[test]
fn with_another_chair_the_routine_uses_that_one() {
    let other =
        r#"{ "name": "kitchen chair", "at": [6.6, 3.9], "size_m": [0.45, 0.45], "height_m": 0.9, "enterable": true },"#;
    let files = with_pieces(&TABLES, true, other);
    let (scenario, household) = household(&files, &[]).unwrap();
    let run = || Run::new(&scenario, &household, 3, 4 * DAY);
    assert_is_a_life(&days_of(run(), 4));
    let rests_at = |at: Point| -> Span {
        let moves = run().moves().unwrap().swap_remove(0);
        let rests =
            moves.iter().filter(|next| matches!(next.doing, MotionState::Rest { at: here } if here.distance(at) < 0.1));
        rests.map(|next| next.end - next.begin).sum()
    };
    assert!(rests_at(Point::new(6.6, 3.9)) > 3 * HOUR);
    assert_eq!(rests_at(Point::new(7.98, 3.25)), Span::ZERO);
}

/// A home in which a way was blocked after the check.
#[test]
fn an_unreachable_place_does_not_take_the_day() {
    let shown = |pieces, file: fn(Pieces, bool) -> BTreeMap<String, String>| {
        let (_, household) = household(&file(pieces, false), &[]).unwrap();
        let lived = |in_the_way| {
            let files = file(pieces, in_the_way);
            let scenario = homebody_core::scenario::load::Scenario::load(&files, "scenario.json").unwrap();
            days_of(Run::new(&scenario, &household, 3, 4 * DAY), 4)
        };
        (lived(false), lived(true))
    };
    for (pieces, file) in [
        (&TABLES[..], (|pieces, in_the_way| with_pieces(pieces, in_the_way, "")) as fn(Pieces, bool) -> _),
        (&SCREENS[..], |pieces, in_the_way| with_pieces(pieces, in_the_way, "")),
        (&[], |_, in_the_way| with_bathroom_door(!in_the_way)),
    ] {
        let (free, shut) = shown(pieces, file);
        assert_is_a_life(&free);
        assert_is_a_life(&shut);
        assert_ne!(free, shut);
        if pieces.is_empty() {
            // It is given up after a minute.
            let (hours, times) = shut["using_bathroom"];
            assert!(times >= 2.0 && hours / times < 0.05, "{shut:?}");
            assert!(
                free["using_bathroom"].0 > 3.0 * hours && !shut.contains_key("showering") || hours < 0.5,
                "{shut:?}"
            );
        }
    }
}

/// Hours per night of rest at the example's armchair.
fn asleep_in_the_armchair_h(sentence: &str) -> f64 {
    let (scenario, household) = household(&files(&format!("{ORDINARY}\n{sentence}\n"), &[]), &[]).unwrap();
    let run = || Run::new(&scenario, &household, 3, 3 * DAY);
    let armchair = scenario.home.plan().places.iter().find(|(name, _)| name == "armchair").unwrap().1;
    let moves = run().moves().unwrap().swap_remove(0);
    let is_night = |at: RunTime| (0.0..5.0).contains(&hour(at));
    let rests = moves.iter().filter(|next| {
        is_night(next.begin) && matches!(next.doing, MotionState::Rest { at } if at.distance(armchair) < 0.3)
    });
    rests.map(|next| next.end - next.begin).sum::<Span>().ratio(3 * HOUR)
}

#[test]
fn a_sleeper_in_the_recliner_does_not_use_the_bed() {
    let (recliner, bed) = (asleep_in_the_armchair_h("She sleeps in her recliner."), asleep_in_the_armchair_h(""));
    assert!(recliner > 3.0 && bed < 1.0, "{recliner} {bed}");
}
