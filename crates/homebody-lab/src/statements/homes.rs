//! Homes and basic routines, from which lives are drawn.

use super::numbers::Draw;
use homebody_core::activity::{
    AWAY, EATING_BREAKFAST, EATING_DINNER, EATING_LUNCH, FALLEN, GETTING_UP, GOING_TO_BED, HOUSEWORK, LAUNDRY,
    LYING_AWAKE, NAPPING, SHOWERING, USING_BATHROOM, WANDERING, WATCHING_TELEVISION,
};
use homebody_core::calendar::Calendar;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::ops::RangeInclusive;

macro_rules! home {
    ($folder:literal, $name:literal, $pronoun:literal, $seats:expr, $rooms:expr, $has_bed_sensor:literal: $($file:literal),*) => {
        DrawnHome {
            name: $folder,
            person: $name,
            pronoun: $pronoun,
            seats: &$seats,
            rooms: &$rooms,
            has_bed_sensor: $has_bed_sensor,
            files: &[$(($file, include_str!(concat!("../../../../scenarios/", $folder, "/", $file)))),*],
        }
    };
}

#[derive(Debug)]
pub struct DrawnHome {
    pub name: &'static str,
    /// The resident with the drawn routine.
    pub person: &'static str,
    pub pronoun: &'static str,
    /// Seats as a routine calls them, with the names of the furniture.
    pub seats: &'static [(&'static str, &'static str)],
    pub rooms: &'static [&'static str],
    pub has_bed_sensor: bool,
    files: &'static [(&'static str, &'static str)],
}

pub const HOMES: [DrawnHome; 5] = [
    home!(
        "tigerplace", "margaret", "she", [("armchair", "armchair"), ("sofa", "sofa")], ["kitchen", "bedroom", "living room"],
        true: "scenario.json", "home.json", "margaret.json", "margaret.routine"
    ),
    home!(
        "older-adult", "ada", "she", [("armchair", "armchair"), ("sofa", "sofa"), ("desk chair", "desk chair")],
        ["kitchen", "bedroom", "living room"], false: "scenario.json", "home.json", "ada.json", "ada.routine"
    ),
    home!(
        "house-two-floors", "eleanor", "she", [("armchair", "armchair"), ("sofa", "sofa")], ["kitchen", "bedroom", "living room"],
        false: "scenario.json", "home.json", "eleanor.json", "eleanor.routine"
    ),
    home!(
        "studio", "walter", "he", [("armchair", "armchair"), ("dining chair", "dining chair")], ["room"], false:
        "scenario.json", "home.json", "walter.json", "walter.routine"
    ),
    home!(
        "couple-with-cat", "ruth", "she", [("armchair", "ruth's armchair"), ("sofa", "sofa")], ["kitchen", "study", "living room", "bedroom"],
        false: "scenario.json", "home.json", "henry.json", "henry.routine", "ruth.json", "ruth.routine", "minka.json",
        "minka.routine"
    ),
];

/// Starts of runs and their time zones: winter, and the days before clocks change in spring and in autumn.
pub const STARTS: [(&str, &str); 4] = [
    ("2009-01-05", "America/Chicago"),
    ("2009-02-23", "America/Chicago"),
    ("2025-10-06", "Europe/London"),
    ("2026-03-16", "Europe/Berlin"),
];

impl DrawnHome {
    pub fn has_two(&self) -> bool {
        self.files.iter().filter(|(name, _)| name.ends_with(".routine")).count() > 1
    }

    /// The files with a routine, without the sensors that no measure reads.
    pub fn files(&self, start: &str, zone: &str, routine: &str) -> BTreeMap<String, String> {
        let mut files: BTreeMap<String, String> =
            self.files.iter().map(|(name, text)| ((*name).to_owned(), (*text).to_owned())).collect();
        let mut change = |name: &str, change: &dyn Fn(&mut Value)| {
            let Some(text) = files.get_mut(name) else { return };
            if let Ok(mut value) = serde_json::from_str(text) {
                change(&mut value);
                *text = value.to_string();
            }
        };
        change("scenario.json", &|scenario| {
            scenario["start"] = json!(format!("{start}T00:00:00"));
            scenario["time_zone"] = json!(zone);
            scenario.as_object_mut().into_iter().for_each(|scenario| {
                scenario.remove("link");
                scenario.remove("logger");
            });
        });
        change("home.json", &|home| {
            let is_read = |sensor: &Value| sensor["kind"] == "bed";
            home["sensors"].as_array_mut().into_iter().for_each(|sensors| sensors.retain(is_read));
        });
        files.insert(format!("{}.routine", self.person), routine.to_owned());
        files
    }

    /// Words of a woman as those of this person.
    pub fn of_person(&self, words: &str) -> String {
        if self.pronoun == "she" {
            return words.to_owned();
        }
        let of = |word: &str| match word {
            "she" => "he".to_owned(),
            "her" => "his".to_owned(),
            word => word.to_owned(),
        };
        words.split(' ').map(of).collect::<Vec<_>>().join(" ")
    }
}

/// The routine that statements are added to.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnBase {
    pub up_min: f64,
    /// After midnight above 1440.
    pub bed_min: f64,
    pub sentences: Vec<String>,
    /// Labels that its sentences and conditions are about.
    pub about: Vec<&'static str>,
}

/// The home, the basic routine and the days of a run. Statements are drawn for them.
#[derive(Clone, Debug)]
pub struct LifeContext {
    pub days: i32,
    pub home: &'static DrawnHome,
    /// The date, and the time zone.
    pub start: (&'static str, &'static str),
    pub base: DrawnBase,
}

impl LifeContext {
    pub fn draw(draw: &mut Draw, days: &RangeInclusive<i32>) -> LifeContext {
        let days = days.start() + draw.below((days.end() - days.start() + 1).max(1) as u32) as i32;
        let home = &HOMES[draw.below(HOMES.len() as u32) as usize];
        let start = STARTS[draw.below(STARTS.len() as u32) as usize];
        LifeContext { days, home, start, base: DrawnBase::draw(draw, home, days) }
    }

    /// The run begins at midnight.
    pub fn calendar(&self) -> Calendar {
        let (start, zone) = self.start;
        Calendar::new(&format!("{start}T00:00:00"), zone).expect("the start is a time of its zone")
    }
}

pub fn clock(minute: f64) -> String {
    let minute = minute.rem_euclid(1440.0) as u32;
    format!("{:02}:{:02}", minute / 60, minute % 60)
}

impl DrawnBase {
    pub fn draw(draw: &mut Draw, home: &DrawnHome, days: i32) -> DrawnBase {
        let is_late = !home.has_two() && draw.one_in(5);
        let up_min = 5.0 * f64::from(if is_late { 108 + draw.below(24) } else { 75 + draw.below(18) });
        let bed_min = 5.0 * f64::from(if is_late { 288 + draw.below(18) } else { 255 + draw.below(24) });
        let mut base = DrawnBase { up_min, bed_min, sentences: Vec::new(), about: Vec::new() };
        let mut add = |sentence: &str, about: &[&'static str]| {
            base.sentences.push(sentence.to_owned());
            base.about.extend(about);
        };
        match draw.below(3) {
            _ if home.has_two() => {
                for sentence in [
                    "She prepares breakfast at about 07:40 for 15 minutes.",
                    "She eats breakfast at 08:00 for 25 minutes.",
                    "She prepares lunch at about 11:55 for 30 minutes.",
                    "She eats lunch at 12:30 for 25 minutes.",
                    "She prepares dinner at about 17:20 for 35 minutes.",
                    "She eats dinner at 18:00 for 30 minutes.",
                ] {
                    add(sentence, &[EATING_BREAKFAST, EATING_LUNCH, EATING_DINNER]);
                }
            }
            1 if !is_late => {
                add(
                    "She prepares breakfast at about 08:30 for 15 minutes, then eats for 20 minutes.",
                    &[EATING_BREAKFAST],
                );
                add("She prepares lunch at about 12:00 for 25 minutes, then eats for 25 minutes.", &[EATING_LUNCH]);
                add("She prepares dinner at about 17:30 for 30 minutes, then eats for 30 minutes.", &[EATING_DINNER]);
            }
            2 => add("She eats lunch at 12:45 for 25 minutes.", &[EATING_LUNCH]),
            _ => {}
        }
        if draw.one_in(3) {
            add("On Tuesday and Friday she goes out at 10:30 for 2 hours.", &[AWAY]);
        }
        if draw.one_in(5) {
            add("Her neighbour visits on Saturday at about 15:00 for 1 hour.", &["neighbour"]);
        }
        if draw.one_in(8) {
            let condition = ["depression", "frailty", "insomnia", "heart failure"][draw.below(4) as usize];
            let from = 2 + draw.below(days.max(4) as u32 / 3);
            let about = [
                "condition",
                "pace",
                GETTING_UP,
                GOING_TO_BED,
                AWAY,
                EATING_BREAKFAST,
                EATING_LUNCH,
                EATING_DINNER,
                HOUSEWORK,
                LYING_AWAKE,
                USING_BATHROOM,
                WATCHING_TELEVISION,
                FALLEN,
                SHOWERING,
                WANDERING,
                NAPPING,
                LAUNDRY,
            ];
            add(&format!("From day {from}, over 7 days, she shows mild {condition}."), &about);
        }
        base
    }

    /// A sentence with a time in the morning, which is later for a person who rises late.
    pub fn in_its_morning(&self, sentence: &str) -> String {
        let at = |minutes: f64, earliest: f64| clock((self.up_min + minutes).max(earliest));
        let later = sentence.replace("10:00", &at(120.0, 600.0)).replace("09:30", &at(90.0, 570.0));
        later.replace("09:00", &at(75.0, 540.0))
    }

    /// The text of the routine. A statement about rising or bedtime replaces the sentence here.
    pub fn text(&self, home: &DrawnHome, statements: &[&str], labels: &[&str]) -> String {
        let mut name = home.person.to_owned();
        name[..1].make_ascii_uppercase();
        let mut sentences = vec![format!("{name} is 80. {name} walks at 0.7 m/s.")];
        if !labels.contains(&GETTING_UP) {
            sentences.push(home.of_person(&format!("she gets up at {}.", clock(self.up_min))));
        }
        if !labels.contains(&GOING_TO_BED) {
            sentences.push(home.of_person(&format!("she goes to bed at {}.", clock(self.bed_min))));
        }
        let replaces = |label: &str| labels.contains(&label);
        let is_kept = |sentence: &&String| {
            let told =
                [("eats breakfast", EATING_BREAKFAST), ("eats lunch", EATING_LUNCH), ("eats dinner", EATING_DINNER)];
            let cooked = [("breakfast", EATING_BREAKFAST), ("lunch", EATING_LUNCH), ("dinner", EATING_DINNER)];
            let eats = told.iter().any(|(words, label)| sentence.contains(words) && replaces(label));
            let cooks_and_eats = sentence.contains("then eats")
                && cooked.iter().any(|(meal, label)| sentence.contains(meal) && replaces(label));
            !(eats || cooks_and_eats || sentence.contains("goes out") && replaces(AWAY))
        };
        sentences.extend(self.sentences.iter().filter(is_kept).map(|sentence| home.of_person(&lowered(sentence))));
        sentences.extend(statements.iter().map(|statement| (*statement).to_owned()));
        let mut text = sentences.join("\n");
        text.push('\n');
        text
    }
}

fn lowered(sentence: &str) -> String {
    let mut sentence = sentence.to_owned();
    sentence[..1].make_ascii_lowercase();
    sentence
}
