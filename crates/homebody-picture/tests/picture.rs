//! Pictures: well-formed, escaped, of the size asked for, and with the text in them.

#[path = "../../homebody-analysis/tests/home/mod.rs"]
mod home;

use homebody_analysis::coverage::{STEP_M, coverage, of_home};
use homebody_analysis::day::DayRecord;
use homebody_analysis::density::{DensityOptions, density};
use homebody_analysis::parts::PartsList;
use homebody_core::geometry::{Point, direction, point};
use homebody_core::home::form::HomeFile;
use homebody_core::plan::Plan;
use homebody_core::resident::Build;
use homebody_core::sensors::kinds::SensorFile;
use homebody_core::time::{HOUR, Interval, WallTime};
use homebody_log::{Event, Log};
use homebody_picture::{
    BandContent, DayBand, DayChart, FiringLane, Lane, Panel, PngError, Reference, Ticks, TotalsLine, coverage_map,
    day_chart, density_map, firing_chart, floor_plan, installing, pdf, png, span_chart, totals_chart,
};
use homebody_timeline::Episode;
use resvg::usvg;
use serde_json::json;

fn map(file: &HomeFile) -> String {
    let plan = Plan::new(file);
    let names: Vec<String> = file.sensors.iter().map(|sensor| sensor.name().to_owned()).collect();
    let seen = coverage(&plan, 0.25, &names, STEP_M, &|p| home::sees(file, &plan, p));
    coverage_map(file, &seen, &beams(file, &plan))
}

fn activities() -> Vec<FiringLane> {
    let activity = |(index, portion): (usize, char)| FiringLane {
        label: format!("{} feet & more", 5 + 5 * (index % 2)),
        portion,
        firings_s: (0..30 + index).map(|firing| firing as f64 * 8.0).collect(),
    };
    "AABBCC".chars().enumerate().map(activity).collect()
}

fn totals() -> String {
    let line = |turning: f64| TotalsLine {
        label: format!("turning <{turning} s>"),
        points: (3..8).map(|length| (f64::from(length), 200.0 + 7.0 * f64::from(length) - turning)).collect(),
    };
    let reference = Reference { label: "published: 230".to_owned(), total: 230.0 };
    totals_chart("Totals", ["walk in m", "firings"], &[line(0.0), line(1.0)], Some(&reference))
}

fn spans() -> String {
    let lane = |label: &str, told: [Vec<[f64; 2]>; 2]| Lane { label: label.to_owned(), truth: vec![[5.0, 60.0]], told };
    let lanes =
        vec![lane("hall <&>", [vec![[6.0, 9.0], [20.0, 30.0]], vec![[7.0, 11.0]]]), lane("bath", [vec![], vec![]])];
    let panels = [Panel { label: "recording 1".to_owned(), duration_s: 90.0, lanes }];
    span_chart("Spans", "is there", ["real", "simulated"], &panels)
}

/// A log of a sensor that fires every ten minutes, for so many days.
fn steady(days: i64) -> Log {
    let at = |number: i64| WallTime::EPOCH + number * (HOUR / 6);
    let events = (0..days * 144).map(|number| Event { at: at(number), sensor: 0, value: 0 });
    Log { sensors: vec!["hall <&>".into()], values: vec!["ON".into()], events: events.collect(), ..Log::default() }
}

fn days_map(days: i64) -> String {
    let (log, asked) = (steady(days), DensityOptions::default());
    density_map(&density(("a & <b>", &log, &asked), Some(("other", &log, &asked))).expect("a map"))
}

fn planned_day() -> DayChart {
    let spans = vec![(0.0, 25_000.0, "sleeping".to_owned()), (25_000.0, 25_060.0, "taking <pills>".to_owned())];
    let rooms = vec![(0.0, 99_999.0, "bedroom".to_owned())];
    let bands = vec![
        DayBand { name: "Ann & Bob".to_owned(), holds: BandContent::Activities, spans },
        DayBand { name: "rooms".to_owned(), holds: BandContent::Rooms, spans: rooms },
    ];
    DayChart { title: "A plan".to_owned(), bands, ticks: Vec::new() }
}

/// The beams of the wall sensors' fans.
fn beams(home: &HomeFile, plan: &Plan) -> Vec<(usize, Point, Point)> {
    let mut beams = Vec::new();
    for (index, sensor) in home.sensors.iter().enumerate() {
        if let SensorFile::Motion(motion) = sensor {
            for beam in 0..motion.beams {
                let off = (f64::from(beam) + 0.5) / f64::from(motion.beams) - 0.5;
                let towards = direction(motion.facing_deg + off * motion.field_deg[0]);
                let lens = point(motion.at) + towards * 0.02;
                beams.push((index, lens, home::beam_end(plan, lens, lens + towards * motion.reach_m)));
            }
        }
    }
    beams
}

fn well_formed(svg: &str) {
    let tree = usvg::Tree::from_str(svg, &usvg::Options::default());
    assert!(tree.is_ok(), "{:?}", tree.err());
}

#[test]
fn every_picture_is_well_formed() {
    let file = home::furnished();
    for svg in [floor_plan(&file), map(&file), firing_chart("A & <B>", &activities(), 300.0), totals(), spans()] {
        well_formed(&svg);
    }
}

#[test]
fn maps_of_few_and_of_many_days_are_well_formed() {
    for days in [1, 7, 70, 730, 3660] {
        let svg = days_map(days);
        well_formed(&svg);
        assert!(svg.contains("a &amp; &lt;b&gt;, 1970-01-01 to") && svg.contains("and more"), "{days}");
    }
    assert!(days_map(7).contains(">Sat 3 Jan<") && days_map(730).contains("Jan 1971<"));
    assert!(days_map(730).len() < 1_000_000);
}

#[test]
fn a_day_is_drawn_with_firings_or_without() {
    let plan = planned_day();
    let svg = day_chart(&plan);
    well_formed(&svg);
    for words in ["2 activities<", "Ann &amp; Bob", ">sleeping<", ">bedroom<", "medicine", "24:00"] {
        assert!(svg.contains(words), "the chart lacks {words}");
    }
    assert!(!svg.contains("firings") && !svg.contains("meals"), "there are none");
    let spans = vec![(-10.0, 5.0), (5.0, 5.0), (86_399.0, 90_000.0), (100_000.0, 100_001.0)];
    let ticks = |sensor: &str, spans, firings| Ticks { sensor: sensor.to_owned(), spans, firings };
    let lived = DayChart { ticks: vec![ticks("door", spans, 2), ticks("silent", Vec::new(), 0)], ..plan };
    let svg = day_chart(&lived);
    well_formed(&svg);
    assert!(svg.contains("2 activities, 2 firings of 2 sensors") && svg.contains(">silent<"));
    well_formed(&day_chart(&DayChart::default()));
}

#[test]
fn the_chart_of_a_log_has_its_activities_and_firings() {
    let at = |hour: i64| WallTime::EPOCH + hour * HOUR;
    let event = |hour: i64, sensor, value| Event { at: at(hour), sensor, value };
    let log = Log {
        sensors: vec!["hall".into(), "door".into()],
        values: vec!["ON".into(), "OFF".into(), "OPEN".into(), "CLOSE".into()],
        // An activity over midnight is of both days, and counts on the first.
        events: vec![
            event(20, 1, 2),
            event(23, 0, 0),
            event(24, 1, 3),
            event(25, 0, 1),
            event(30, 1, 2),
            event(31, 1, 3),
            event(47, 0, 0),
            event(49, 0, 1),
        ],
        activities: vec![Episode::new("Cook".to_owned(), Interval::new(at(40), at(50)))],
        ..Log::default()
    };
    let chart = DayChart::new(&DayRecord::from_log("log", &log, &[], None, jiff::civil::date(1970, 1, 2)));
    assert_eq!(chart.title, "log: Friday 2 January 1970");
    assert_eq!((chart.bands.len(), chart.ticks.len()), (1, 2));
    // The number in the log, though three of them are seen.
    assert_eq!(chart.ticks.iter().map(|ticks| ticks.firings).collect::<Vec<_>>(), [1, 1]);
    assert!(day_chart(&chart).contains("2 firings of 2 sensors"));
    assert_eq!(chart.bands[0].spans, [(57_600.0, 86_400.0, "Cook".to_owned())]);
}

#[test]
fn names_are_escaped() {
    let file = home::furnished();
    for svg in [floor_plan(&file), map(&file)] {
        assert!(svg.contains("Two rooms &amp; a &lt;door&gt;"));
        assert!(svg.contains("bed &quot;ceiling&quot; &lt;1&gt;"));
        assert!(!svg.contains("<door>"));
    }
    let mut odd = home::furnished();
    odd.name = "bell \u{7} and null \0 and ]]>".to_owned();
    well_formed(&floor_plan(&odd));
}

#[test]
fn floors_have_frames_with_their_names() {
    let mut file = home::furnished();
    let frames = |svg: &str| svg.matches("stroke-dasharray=\"10 5\"").count();
    assert_eq!(frames(&floor_plan(&file)), 0);
    file.rooms[0].floor = Some("ground & <1>".to_owned());
    file.rooms[1].floor = Some("first floor".to_owned());
    for svg in [floor_plan(&file), map(&file)] {
        well_formed(&svg);
        assert!(svg.contains(">ground &amp; &lt;1&gt;<") && svg.contains(">first floor<"));
        assert_eq!(frames(&svg), 2);
    }
    let ground = file.rooms[0].floor.clone();
    file.rooms[1].floor = ground;
    assert_eq!(frames(&floor_plan(&file)), 1);
}

#[test]
fn a_png_has_the_size_asked_for() {
    let svg = floor_plan(&home::furnished());
    let tree = usvg::Tree::from_str(&svg, &usvg::Options::default()).expect("svg");
    for width in [300, 1200, 1777] {
        let png = png(&svg, width).expect("png");
        let side = |at: usize| u32::from_be_bytes(png[at..at + 4].try_into().expect("four bytes"));
        assert_eq!(side(16), width);
        let height = tree.size().height() / tree.size().width() * width as f32;
        assert!((side(20) as f32 - height).abs() <= 1.0);
    }
}

#[test]
fn rejects_svg_that_cannot_be_drawn() {
    let svg = floor_plan(&home::furnished());
    assert!(matches!(png("<svg", 100), Err(PngError::Svg(_))));
    assert!(matches!(png(&svg, 0), Err(PngError::Size { .. })));
    assert!(matches!(png(&svg, 1_000_000), Err(PngError::Size { .. })));
}

#[test]
fn text_appears_in_a_png() {
    let page = |words: &str| {
        format!(
            "<svg xmlns='http://www.w3.org/2000/svg' width='200' height='50' font-family='Nowhere'>\
             <text x='10' y='30' font-size='20'>{words}</text></svg>"
        )
    };
    let drawn = |words: &str| png(&page(words), 200).expect("png");
    assert_ne!(drawn("bedroom"), drawn(""));
    assert_ne!(drawn("bedroom"), drawn("kitchen"));
    assert_ne!(drawn("m²"), drawn("m"));
    assert_ne!(drawn("müde"), drawn("mde"));
}

#[test]
fn a_picture_is_the_same_bytes_each_time() {
    let file = home::furnished();
    assert_eq!(floor_plan(&file), floor_plan(&file));
    assert_eq!(map(&file), map(&file));
}

#[test]
fn a_coverage_map_stays_small() {
    let file = home::furnished();
    assert!(map(&file).len() < 100_000, "{} bytes", map(&file).len());
}

#[test]
fn the_map_shows_numbers_and_shares() {
    let svg = map(&home::furnished());
    for words in ["no sensor: 5.", "one sensor: 8", ">0.89\u{a0}m²<", "class=\"dead-zone\" data-name=\"2\"", ">1<"] {
        assert!(svg.contains(words), "the map lacks {words}");
    }
}

#[test]
fn each_firing_is_a_tick() {
    let svg = firing_chart("Walks", &activities(), 300.0);
    let ticks: usize = svg
        .lines()
        .filter(|line| line.starts_with("<path"))
        .filter_map(|line| line.split('"').nth(1))
        .map(|d| d.matches('M').count())
        .filter(|&moves| moves > 1)
        .sum();
    let firings: usize = activities().iter().map(|activity| activity.firings_s.len()).sum();
    assert_eq!(ticks, firings);
    assert!(svg.contains(&format!("{firings} firings")));
}

#[test]
fn charts_bear_having_nothing_to_show() {
    well_formed(&firing_chart("none", &[], 300.0));
    let silent = FiringLane { label: "silent".to_owned(), portion: 'A', firings_s: Vec::new() };
    well_formed(&firing_chart("silent", &[silent], 0.0));
    well_formed(&totals_chart("none", ["x", "y"], &[], None));
    let one = TotalsLine { label: "one".to_owned(), points: vec![(4.0, 230.0)] };
    well_formed(&totals_chart("one", ["x", "y"], &[one], None));
    well_formed(&span_chart("none", "true", ["one", "other"], &[]));
    let empty = Panel { label: "empty".to_owned(), duration_s: 0.0, lanes: Vec::new() };
    well_formed(&span_chart("empty", "true", ["one", "other"], &[empty]));
}

#[test]
fn a_bare_home_can_be_drawn() {
    let file = home::two_rooms(json!([]), json!([]));
    well_formed(&floor_plan(&file));
    well_formed(&map(&file));
}

#[test]
fn spans_are_counted_and_named() {
    let svg = spans();
    for words in ["real: 2 spans; simulated: 1 spans", "hall &lt;&amp;&gt;", "bath", "recording 1", "is there"] {
        assert!(svg.contains(words), "the chart lacks {words}");
    }
}

#[test]
fn a_room_too_small_for_its_name_has_it_all_the_same() {
    let mut file = home::two_rooms(json!([]), json!([]));
    file.rooms[1].name =
        "a bedroom with a name so long that no line and no two lines in it could ever hold it".to_owned();
    assert!(floor_plan(&file).contains("a bedroom with a name"));
}

#[test]
fn table_notes_omitted_rows_before_its_sum() {
    let mut file = home::two_rooms(json!([]), json!([]));
    for number in 0..25 {
        let mut room = file.rooms[0].clone();
        room.name = format!("room {number}");
        file.rooms.push(room);
    }
    let svg = map(&file);
    let place = |words: &str| svg.find(words).unwrap_or_else(|| panic!("the map lacks {words}"));
    assert!(place("and 7 more") < place(">all<"));
}

#[test]
fn sheets_are_pages_of_a_pdf_with_words_that_can_be_copied() {
    let file = home::furnished();
    let parts = PartsList::from_home(&file);
    let pages = installing(&file, &of_home(&file, Build::adult(), STEP_M), &parts);
    let whole = pdf(&file.name, &pages).unwrap();
    assert!(whole.starts_with(b"%PDF-1.7") && whole.trim_ascii_end().ends_with(b"%%EOF"));
    let count = |what: &str| whole.windows(what.len()).filter(|bytes| *bytes == what.as_bytes()).count();
    assert_eq!(count("/Type /Page\n"), pages.len());
    // One font, a part of it in the file, with the meanings of its letters; the hatch of dead zones is a pattern.
    assert!(count("/ToUnicode") >= 1 && count("/FontFile2") >= 1 && count("/PatternType 1") >= 1, "{}", whole.len());
    // Letters of both fonts whole would be half a megabyte.
    assert!(whole.len() < 200_000, "{} bytes", whole.len());
    assert_eq!(pdf(&file.name, &pages).unwrap(), whole, "the same pages are the same bytes");
    let words: Vec<&str> = pages.last().unwrap().split('>').filter_map(|part| part.strip_suffix("</text")).collect();
    for part in &parts.parts {
        assert!(words.iter().any(|line| part.place.starts_with(line) || line.contains(&part.place)), "{}", part.place);
    }

    // The controls: a text without a picture, and content that a page cannot have.
    assert!(pdf("", &["<svg".into()]).is_err());
    let masked = "<svg xmlns='http://www.w3.org/2000/svg' width='9' height='9'><linearGradient id='g'><stop offset='0' \
                  stop-color='red'/><stop offset='1' stop-color='blue'/></linearGradient><rect width='9' height='9' fill='url(#g)'/></svg>";
    assert!(pdf("", &[masked.into()]).unwrap_err().to_string().contains("gradients"));
}

#[test]
fn a_long_list_goes_over_sheets_and_a_long_name_stays_on_its_own() {
    let sensor = |number: usize| {
        let name = if number == 7 { "very ".repeat(800) } else { format!("sensor {number}") };
        json!({ "kind": "motion", "name": name, "at": [2.0, 3.95], "facing_deg": 270 })
    };
    let file = home::two_rooms(json!([]), (0..60).map(sensor).collect());
    let seen = of_home(&file, Build::adult(), STEP_M);
    let pages = installing(&file, &seen, &PartsList::from_home(&file));
    assert!(pages.len() > 4, "{}", pages.len());
    let all: String = pages[2..].concat();
    assert!((0..60).all(|number| number == 7 || all.contains(&format!(">sensor {number}</text>"))));
    // Nothing is wider than its sheet.
    for page in &pages[2..] {
        let tree = usvg::Tree::from_str(page, &usvg::Options::default()).unwrap();
        assert_eq!((tree.size().width(), tree.size().height()), (1200.0, 1697.0));
    }
    assert!(!all.contains(&"very ".repeat(60)), "the name is cut");
}
