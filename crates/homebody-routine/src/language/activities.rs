//! The usual words for activities.

use super::lexicon::Lexicon;
use super::verb_forms::third_person;
use crate::routine::Activity;
use std::sync::LazyLock;

/// The usual way of saying an activity: "watches television".
pub fn phrase(activity: &Activity) -> String {
    match activity {
        Activity::Other(words) => words.clone(),
        known => Lexicon::built_in().usual(known).unwrap_or_default().to_owned(),
    }
}

pub fn usual_phrases(lexicon: &Lexicon) -> impl Iterator<Item = String> {
    lexicon.told().map(str::to_owned)
}

pub fn all_phrases() -> &'static [String] {
    static ALL: LazyLock<Vec<String>> = LazyLock::new(spell_out);
    &ALL
}

/// The ways of saying activities without words that may be missing, in the third person.
fn spell_out() -> Vec<String> {
    let mut all = Vec::new();
    for (written, _) in &Lexicon::built_in().ways {
        let said = || {
            written.split(' ').filter(|wanted| !wanted.starts_with('[')).map(|wanted| wanted.trim_start_matches('*'))
        };
        if said().any(|wanted| wanted.chars().all(|c| c.is_ascii_uppercase() || c == '|')) {
            continue;
        }
        let mut phrases = vec![String::new()];
        for wanted in said() {
            let forms: Vec<String> = match wanted.strip_prefix('~') {
                Some(verbs) => verbs.split('|').map(third_person).collect(),
                None => wanted.split('|').map(str::to_owned).collect(),
            };
            let longer =
                |said: &String| forms.iter().map(|form| format!("{said} {form}").trim().to_owned()).collect::<Vec<_>>();
            phrases = phrases.iter().flat_map(longer).collect();
        }
        all.extend(phrases);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::routine::Meal;

    #[test]
    fn what_can_be_said_is_in_the_table_of_activities_and_all_else_there_has_a_reason() {
        use homebody_core::activity::{
            ACTIVITIES, AIRING, FRESHENING_UP, HELPING, LEAVING_HOME, PUTTING_CLOTHES_AWAY, RESTING, ROAMING,
            SEEING_TO_KITCHEN, SLEEPING, TIDYING, VISITING, WAITING, WALKING,
        };
        let said: Vec<Activity> = Activity::all_of_table().collect();
        let mut labels: Vec<&str> = said.iter().map(Activity::label).collect();
        // The night, parts of outings and visits, and pets.
        labels.extend([SLEEPING, LEAVING_HOME, VISITING, HELPING, RESTING, ROAMING]);
        // Ways and waits belong to the activity that follows.
        labels.extend([WAITING, WALKING]);
        // Small errands, of which nobody speaks: together they are housework.
        labels.extend([TIDYING, SEEING_TO_KITCHEN, PUTTING_CLOTHES_AWAY, AIRING, FRESHENING_UP]);
        labels.sort();
        let mut known: Vec<&str> = ACTIVITIES.iter().map(|known| known.label).collect();
        known.sort();
        assert_eq!(labels, known);
        let lexicon = Lexicon::built_in();
        for activity in &said {
            assert!(homebody_core::activity::known(activity.label()).unwrap().usual.is_some(), "{activity:?}");
            assert!(lexicon.usual(activity).is_some(), "{activity:?}");
            assert!(
                lexicon.ways.iter().any(|(_, known)| known == activity) || *activity == Activity::Visit,
                "{activity:?}"
            );
        }
    }

    #[test]
    fn phrases_are_spoken_in_the_third_person() {
        assert_eq!(phrase(&Activity::WatchTelevision), "watches television");
        assert_eq!(phrase(&Activity::Eat(Meal::Dinner)), "eats dinner");
        assert!(all_phrases().contains(&"takes bath".to_owned()));
    }
}
