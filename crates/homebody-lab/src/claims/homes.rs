//! The homes of cases: two templates.

use super::text::ClaimHome;
use std::collections::BTreeMap;

macro_rules! files {
    ($folder:literal: $($name:literal),*) => {
        &[$(($name, include_str!(concat!("../../../../scenarios/", $folder, "/", $name)))),*]
    };
}

const APARTMENT: &[(&str, &str)] =
    files!("tigerplace": "scenario.json", "home.json", "logger.json", "margaret.json", "margaret.routine");

const COUPLE: &[(&str, &str)] = files!(
    "couple-with-cat": "scenario.json", "home.json", "logger.json", "henry.json", "henry.routine", "ruth.json",
    "ruth.routine", "minka.json", "minka.routine"
);

impl ClaimHome {
    /// The files of the home, in UTC, so that no clock changes, from a day on.
    pub fn files(self, start: &str) -> BTreeMap<String, String> {
        let (files, known) = match self {
            ClaimHome::Apartment => (APARTMENT, ["2009-03-02", "America/Chicago"]),
            ClaimHome::Couple => (COUPLE, ["2025-09-01", "Europe/London"]),
        };
        let text = |name: &str, text: &str| match name {
            "scenario.json" => text.replace(known[0], start).replace(known[1], "UTC"),
            _ => text.to_owned(),
        };
        files.iter().map(|(name, of)| ((*name).to_owned(), text(name, of))).collect()
    }
}
