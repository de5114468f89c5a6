//! Suggestions for editors that complete a routine: the usual forms of the language.

use crate::language::activities::usual_phrases;
use crate::language::{KnownNames, severities};
use serde::Serialize;

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "wire", derive(ts_rs::TS))]
pub struct Completion {
    pub text: String,
    pub kind: CompletionKind,
    pub about: String,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[cfg_attr(feature = "wire", derive(ts_rs::TS))]
pub enum CompletionKind {
    /// With its full stop.
    Sentence,
    Activity,
    Time,
    Place,
    Condition,
}

/// Sentences of each form, about `she`, called `NAME`.
const SENTENCES: [(&str, &str); 26] = [
    ("NAME is 82.", "who it is about, and how old"),
    ("She walks at about 0.65 m/s.", "how fast"),
    ("She gets up at about 06:45, give or take 30 minutes.", "when, and how regularly"),
    ("She goes to bed at about 22:30, give or take 45 minutes.", "when, and how regularly"),
    ("She prepares lunch at about 11:50 for 25 minutes, then eats for 20 minutes.", "one thing after another"),
    ("She washes up after lunch.", "after something else"),
    ("She takes her medicine with breakfast.", "together with something else"),
    ("She watches television in the evening for about 2 hours.", "part of the day, and how long"),
    ("Often she reads in the afternoon for about 40 minutes.", "how often"),
    ("On 30 % of days she naps at about 14:30 for 30 to 50 minutes.", "how likely on a day"),
    ("On Monday and Thursday she takes a shower 30 minutes after she gets up.", "on some days of the week"),
    ("On Tuesday and Friday she leaves the apartment at about 10:00 for 2 to 3 hours.", "going out"),
    ("Most nights she goes to the bathroom once or twice.", "how many times"),
    ("Sometimes her daughter visits on Sunday afternoon for 2 hours.", "a visitor"),
    ("She knits in the living room in the evening for about 1 hour.", "an activity of one's own: place and duration"),
    ("Whenever the stove has been on for 90 minutes, she turns it off.", "a rule"),
    ("Whenever she has been out for 4 hours, she takes a nap.", "a rule"),
    ("From week 6, over 4 weeks, she shows moderate depression.", "a condition that comes slowly"),
    ("From week 6 to week 12, fading over 2 weeks, she shows mild grief.", "a condition that goes again"),
    ("From week 10 she walks 10 % slower.", "a change of pace"),
    ("From week 10, over 8 weeks, she gets up 45 to 90 minutes later.", "a change of time"),
    ("From week 10 she leaves the apartment half as often.", "a change of how often"),
    ("From week 10 she skips lunch on 30 % of days.", "a change of meals"),
    ("From week 10 her hours vary twice as much.", "days less regular"),
    ("From week 10 she forgets to turn off the stove on 5 % of occasions.", "what is forgotten"),
    ("She wanders rarely at first, often by week 20.", "more often as time goes by"),
];

const TIMES: [(&str, &str); 33] = [
    ("in the morning", "part of the day"),
    ("at noon", "part of the day"),
    ("in the afternoon", "part of the day"),
    ("in the evening", "part of the day"),
    ("at night", "while in bed"),
    ("at about 08:00", "time of day"),
    ("at about 08:00, give or take 30 minutes", "time of day, and how regularly"),
    ("between 14:00 and 16:00", "some time between"),
    ("after breakfast", "after something else"),
    ("after lunch", "after something else"),
    ("after dinner", "after something else"),
    ("before bed", "before something else"),
    ("30 minutes after she gets up", "after something else"),
    ("for about 1 hour", "how long"),
    ("for 20 to 40 minutes", "how long"),
    ("for half an hour", "how long"),
    ("until about 12:00", "until when"),
    ("every day", "on each day"),
    ("every other day", "on each second day"),
    ("on most days", "on 4 days in 5 or so"),
    ("often", "how often"),
    ("sometimes", "how often"),
    ("rarely", "how often"),
    ("on 30 % of days", "how likely on a day"),
    ("3 times a week", "how often"),
    ("once or twice", "how many times"),
    ("on Monday and Thursday", "days of the week"),
    ("on weekdays", "Monday to Friday"),
    ("at weekends", "Saturday and Sunday"),
    ("in winter", "time of the year"),
    ("from week 6", "from a week of the run on"),
    ("until week 12", "up to a week of the run"),
    ("from 1 May 2026", "from a date on"),
];

pub fn words(known: &KnownNames, text: &str) -> Vec<Completion> {
    let name = known.person.as_deref().map(capital);
    let is_he = is_about_him(text);
    let adapted = |said: &str| {
        let said = name.as_ref().map_or_else(|| said.replace("NAME", "She"), |name| said.replace("NAME", name));
        if is_he { about_him(&said) } else { said }
    };
    let word = |text: String, kind: CompletionKind, about: &str| Completion { text, kind, about: about.to_owned() };
    let sentences = SENTENCES.iter().map(|(said, about)| word(adapted(said), CompletionKind::Sentence, about));
    let activities = usual_phrases(&known.lexicon).map(|phrase| word(phrase, CompletionKind::Activity, "activity"));
    let times = TIMES.iter().map(|(said, about)| word(adapted(said), CompletionKind::Time, about));
    let mut places: Vec<(&String, &str)> = known.rooms.iter().map(|room| (room, "room")).collect();
    places.extend(known.places.iter().map(|place| (place, "place")));
    places.extend(known.things.iter().map(|thing| (thing, "thing")));
    // A wardrobe is a place and a thing.
    let mut seen: Vec<String> = Vec::new();
    places.retain(|(place, _)| {
        let is_new = !seen.contains(&place.to_lowercase());
        seen.push(place.to_lowercase());
        is_new
    });
    let places = places.into_iter().map(|(place, about)| word(place.clone(), CompletionKind::Place, about));
    let severe = |condition: &String| {
        let condition = condition.replace('-', " ");
        let severe = usual_severities().map(move |severe| format!("{severe} {condition}"));
        severe.map(|shown| word(shown, CompletionKind::Condition, "condition")).collect::<Vec<_>>()
    };
    let conditions = known.conditions.iter().flat_map(severe);
    sentences.chain(activities).chain(times).chain(places).chain(conditions).collect()
}

fn usual_severities() -> impl Iterator<Item = &'static str> {
    severities().filter(|word| ["mild", "moderate", "severe"].contains(word))
}

pub(crate) fn is_about_him(text: &str) -> bool {
    let count = |wanted: &str| {
        let words = text.split(|c: char| !c.is_alphanumeric());
        words.filter(|word| word.eq_ignore_ascii_case(wanted)).count()
    };
    count("he") > count("she")
}

fn about_him(said: &str) -> String {
    let word = |word: &str| match word {
        "She" => "He".to_owned(),
        "she" => "he".to_owned(),
        "Her" => "His".to_owned(),
        "her" => "his".to_owned(),
        other => other.to_owned(),
    };
    said.split(' ').map(word).collect::<Vec<_>>().join(" ")
}

fn capital(name: &str) -> String {
    let mut letters = name.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().collect::<String>() + letters.as_str())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::household::CONDITIONS;
    use crate::language;
    use crate::routine::USUAL;

    fn home() -> KnownNames {
        let names = |names: &[&str]| names.iter().map(|&name| name.to_owned()).collect::<Vec<_>>();
        KnownNames {
            person: Some("margaret".into()),
            places: names(&["armchair", "wardrobe"]),
            things: names(&["stove", "fridge", "wardrobe"]),
            rooms: names(&["kitchen", "living room", "bathroom", "bedroom"]),
            conditions: CONDITIONS.iter().map(|(name, _)| (*name).to_owned()).collect(),
            first_date: Some((2026, 3, 2)),
            usual: USUAL.to_vec(),
            ..KnownNames::default()
        }
    }

    #[test]
    fn whatever_is_offered_is_understood() {
        let mut wrong = Vec::new();
        for who in ["She", "He"] {
            for Completion { text, kind, .. } in words(&home(), &format!("{who} reads.")) {
                let said = match kind {
                    CompletionKind::Sentence => text,
                    CompletionKind::Activity if text == "visits" => continue,
                    CompletionKind::Activity => format!("{who} {text}."),
                    CompletionKind::Time => format!("{who} reads {text}."),
                    CompletionKind::Place => format!("{who} dusts in the {text} for 10 minutes."),
                    CompletionKind::Condition => format!("{who} shows {text}."),
                };
                let (_, problems) = language::routine("a.routine", &said, &home());
                wrong.extend(problems.iter().map(|problem| format!("{said} {problem}")));
            }
        }
        assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    }

    #[test]
    fn completions_are_about_the_person() {
        let about_her = words(&home(), "Margaret is 82. She reads. He is out.\nShe knits.");
        assert!(about_her.iter().any(|word| word.text == "Margaret is 82."));
        assert!(about_her.iter().any(|word| word.text.starts_with("Sometimes her daughter visits")));
        let about_him = words(&home(), "He reads.");
        assert!(about_him.iter().any(|word| word.text.starts_with("Sometimes his daughter visits")));
        assert!(!about_him.iter().any(|word| word.text.to_lowercase().contains("she ")));
        let wardrobes = about_her.iter().filter(|word| word.text == "wardrobe").count();
        assert_eq!(wardrobes, 1, "once a place, though it is a thing as well");
    }
}
