//! The shipped scenarios: their people and pets behave plausibly.

use crate::folder::{Folder, ROOT};
use serde_json::Value as Json;

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

/// Three weeks with church on Sundays, a nurse at noon, and another sentence.
fn with_a_nurse(other: &str) -> Folder {
    let folder = Folder::with("tigerplace");
    let routine = format!(
        "Margaret is 82.\nShe gets up at 07:00.\nOn Sundays she goes to church at 9:30 and is back by noon.\n{other}\n\
         A nurse visits every day at 14:00 for 20 minutes.\nShe reads between 15:00 and 18:00 for 20 minutes.\n"
    );
    folder.write("tigerplace/margaret.routine", routine);
    folder.edit_json("tigerplace/scenario.json", |scenario| scenario["days"] = 21.into());
    folder
}

#[test]
fn sentences_without_room_are_warned_of() {
    const TELEVISION: &str = "warning[life::not-as-said]: margaret.routine:4";
    let commands = ["check tigerplace", "routine check tigerplace", "run tigerplace --quiet --out csv:log.csv"];
    let full = with_a_nurse("She watches television from 10:00 to 17:00.");
    let lived: Json = full.run("routine check tigerplace --lived --json").ok().json();
    let shares = lived["sentences"].as_array().unwrap().iter().map(|of| of["lost_share"].as_f64().unwrap());
    let shares: Vec<f64> = shares.collect();
    assert!(
        !shares.is_empty() && shares.is_sorted_by(|one, next| one >= next),
        "the largest loss comes first: {lived}"
    );
    for words in commands {
        let done = full.run(words).ok();
        assert!(done.err.contains(TELEVISION) && !done.err.contains("no problems"), "{words}: {}", done.err);
    }
    let free = with_a_nurse("She watches television from 19:00 to 20:00.");
    for words in commands {
        let done = free.run(words).ok();
        assert!(!done.err.contains("not-as-said"), "{words}: {}", done.err);
        assert_eq!(done.err.contains("no problems"), !words.starts_with("run"), "{words}: {}", done.err);
    }
}

#[test]
fn who_is_back_by_noon_is_not_reported() {
    let sentences = |other: &str| {
        let lived: Json = with_a_nurse(other).run("routine check tigerplace --lived --json").ok().json();
        lived["sentences"]
            .as_array()
            .unwrap()
            .iter()
            .map(|of| of["text"].as_str().unwrap().to_owned())
            .collect::<Vec<_>>()
    };
    assert_eq!(sentences(""), [""; 0]);
    let late = sentences("On Sunday she watches television from 08:30 to 12:20.");
    assert!(late.iter().any(|text| text == "is back by noon"), "{late:?}");
}
