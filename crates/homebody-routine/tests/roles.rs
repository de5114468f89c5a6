//! Roles of furniture that a home states, whatever its name.

use crate::stage::{ORDINARY, files, household};
use homebody_core::geometry::Point;
use homebody_core::motion::MotionState;
use homebody_core::posture::Posture;
use homebody_core::run::Run;
use homebody_core::time::{DAY, HOUR, Span};

const BED: Point = Point::new(1.1, 5.1);

/// Hours per night of lying at the example's bed under another name.
fn lies_h(name: &str, more: &str) -> f64 {
    let mut files = files(ORDINARY, &[]);
    let mut home = files["home.json"].clone();
    let piece = format!("\"name\": {name:?}, {more}\"at\": [1.1, 5.1]");
    for (was, is) in
        [("\"name\": \"bed\", \"at\": [1.1, 5.1]", piece), ("\"on\": \"bed\"", format!("\"on\": {name:?}"))]
    {
        assert_eq!(home.matches(was).count(), 1, "{was}");
        home = home.replace(was, &is);
    }
    files.insert("home.json".into(), home);
    let (scenario, household) = household(&files, &[]).unwrap();
    let moves = Run::new(&scenario, &household, 3, 3 * DAY).moves().unwrap().swap_remove(0);
    let lies = moves.iter().filter(|next| {
        next.posture == Posture::Lying && matches!(next.doing, MotionState::Rest { at } if at.distance(BED) < 0.3)
    });
    lies.map(|next| next.end - next.begin).sum::<Span>().ratio(3 * HOUR)
}

#[test]
fn a_table_whose_role_is_bed_is_slept_in() {
    let asleep = lies_h("bed", "");
    assert!(asleep > 4.0, "{asleep} h a night");
    assert_eq!(lies_h("table", "\"role\": \"bed\", "), asleep);
    // The control: without its role a table does not count as a bed.
    assert_eq!(lies_h("table", ""), 0.0);
}

#[test]
fn a_role_wins_over_a_name() {
    assert_eq!(lies_h("bed", "\"role\": \"wardrobe\", "), 0.0);
}
