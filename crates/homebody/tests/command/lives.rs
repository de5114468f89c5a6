//! The shipped scenarios: their people and pets behave plausibly.

use crate::folder::{Folder, ROOT};

/// Lives a scenario of the repository for a while, into `log.db` and `truth.db`.
fn lived(scenario: &str, span: &str) -> Folder {
    let folder = Folder::new();
    let out = "--out sqlite:log.db --truth truth.db --quiet";
    folder.run(&format!("run {ROOT}/scenarios/{scenario} --for {span} {out}")).ok();
    folder
}

fn number(folder: &Folder, sql: &str) -> f64 {
    folder.query("truth.db", sql)[0].parse().unwrap()
}

#[test]
fn a_couple_and_a_cat_share_a_home() {
    let folder = lived("couple-with-cat", "7d");
    let sensors = folder.query("truth.db", "SELECT count(DISTINCT sensor) FROM cause");
    assert_eq!(sensors, ["13"], "every sensor fires in a week");
    // Each sleeps in a bed of their own, and the cat's weight is nothing to a bed.
    let beds = "SELECT DISTINCT sensor, resident FROM cause WHERE sensor LIKE '%bed sensor' ORDER BY sensor";
    assert_eq!(folder.query("truth.db", beds), ["henry's bed sensor|henry", "ruth's bed sensor|ruth"]);
    let on_beds = "SELECT count(*) FROM movement WHERE resident = 'minka' AND kind = 'rest' \
                   AND from_x BETWEEN 0.12 AND 2.12 AND from_y BETWEEN 4.5 AND 6.3";
    assert!(number(&folder, on_beds) > 10.0, "it is on the beds all the same");
    let hours = |who: &str, what: &str| {
        let hours = "sum(julianday(end_at) - julianday(begin_at)) * 24 / 7";
        let of = format!("resident = '{who}' AND name = '{what}'");
        number(&folder, &format!("SELECT {hours} FROM activity WHERE {of}"))
    };
    for (who, least, most) in [("henry", 5.5, 9.0), ("ruth", 5.5, 9.0), ("minka", 11.0, 17.0)] {
        let slept = hours(who, "sleeping");
        assert!((least..most).contains(&slept), "{who} sleeps {slept} h a day");
    }
    // Planned naps have their length, and tiredness adds few.
    assert!(hours("henry", "napping") < 1.0);
    for meal in ["eating_breakfast", "eating_lunch", "eating_dinner"] {
        let both = format!("SELECT count(*) FROM activity WHERE name = '{meal}' AND resident IN ('henry', 'ruth')");
        assert!((14.0..18.0).contains(&number(&folder, &both)), "{meal}");
    }
}

#[test]
fn residents_upstairs_use_the_stairs() {
    let folder = lived("house-two-floors", "7d");
    let rooms = "SELECT count(*) FROM room WHERE resident = 'eleanor' AND room = 'stairs'";
    let a_day = number(&folder, rooms) / 7.0;
    assert!((8.0..60.0).contains(&a_day), "{a_day} times a day");
    let sensors = folder.query("truth.db", "SELECT count(DISTINCT sensor) FROM cause");
    assert_eq!(sensors, ["15"], "every sensor fires in a week");
}
