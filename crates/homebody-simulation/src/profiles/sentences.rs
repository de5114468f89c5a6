//! Writes the sentences of a profile into a routine, and removes the sentences that contradict them.

use homebody_routine::language;
use homebody_routine::routine::{Effect, Routine};
use std::cmp::Reverse;
use std::ops::Range;

#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct OwnSentences {
    /// Such as "The person is 75".
    pub age: Option<String>,
    /// Such as "The person walks at 0.5 m/s".
    pub pace: Option<String>,
    /// Such as "From week 6 the person shows moderate depression"; nothing leaves conditions as they are.
    pub conditions: Option<Vec<String>>,
}

impl OwnSentences {
    /// The text of a routine with these sentences. Other sentences keep their lines, and their columns unless the length of an earlier
    /// sentence on the line changes.
    pub fn within(&self, text: &str, routine: &Routine) -> String {
        let person = routine.person.as_ref();
        let facts = [
            (&self.pace, person.and_then(|person| person.pace_said.as_ref())),
            (&self.age, person.and_then(|person| person.age_said.as_ref())),
        ];
        let (mut instead, mut added): (Vec<(Range<usize>, String)>, Vec<&String>) = (Vec::new(), Vec::new());
        for (sentence, place) in facts {
            match (sentence, place) {
                (Some(sentence), Some(place)) => instead.push((language::place(place, text), sentence.clone())),
                (Some(sentence), None) => added.push(sentence),
                (None, _) => {}
            }
        }
        if let Some(conditions) = &self.conditions {
            for change in routine.changes.iter().filter(|change| matches!(change.effect, Effect::Shows { .. })) {
                // Empty sentences: a blank would indent the next one, and a heading stays above.
                let nothing = ".".repeat(change.said.text.chars().count());
                instead.push((language::place(&change.said, text), nothing));
            }
            added.extend(conditions);
        }
        instead.sort_by_key(|(place, _)| Reverse(place.start));
        let mut text = text.to_owned();
        for (place, sentence) in instead {
            text.replace_range(place, &sentence);
        }
        for sentence in added {
            text += &format!("\n{sentence}.");
        }
        text + "\n"
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_routine::language::KnownNames;

    fn known() -> KnownNames {
        KnownNames {
            person: Some("Mrs. Miller".into()),
            conditions: vec!["depression".into(), "frailty".into()],
            ..KnownNames::default()
        }
    }

    fn read(text: &str) -> Routine {
        let (routine, problems) = language::routine("a.routine", text, &known());
        assert!(problems.is_empty(), "{text}\n{problems:?}");
        routine
    }

    fn within(own: &OwnSentences, text: &str) -> String {
        let new = own.within(text, &read(text));
        read(&new);
        new
    }

    #[test]
    fn removes_contradicting_sentences() {
        let own = OwnSentences {
            age: Some("The person is 75".into()),
            pace: Some("The person walks at 0.5 m/s".into()),
            ..OwnSentences::default()
        };
        let text = "# She is 82.\nShe is 82. She walks at about 0.65 m/s. # slow\nShe naps.\n";
        let new = "# She is 82.\nThe person is 75. The person walks at 0.5 m/s. # slow\nShe naps.\n\n";
        assert_eq!(within(&own, text), new);
        assert_eq!(within(&own, "She naps."), "She naps.\nThe person walks at 0.5 m/s.\nThe person is 75.\n");
    }

    #[test]
    fn a_sentence_ends_where_the_language_ends_it() {
        let own = OwnSentences { age: Some("The person is 75".into()), ..OwnSentences::default() };
        assert_eq!(within(&own, "She is 82! She naps."), "The person is 75! She naps.\n");
        assert_eq!(within(&own, "Mrs. Miller is 82. She naps."), "The person is 75. She naps.\n");
        assert_eq!(within(&own, "She reads.\rMrs. Miller is 82.\r"), "She reads.\rThe person is 75.\r\n");
    }

    #[test]
    fn other_conditions_are_shown_instead() {
        let none = OwnSentences { conditions: Some(Vec::new()), ..OwnSentences::default() };
        let one = OwnSentences { conditions: Some(vec!["The person shows frailty".into()]), ..OwnSentences::default() };
        let text = "She naps. From week 6 she shows mild depression. She reads.\r\nShe shows frailty.";
        let rest = "She naps. ...................................... She reads.\r\n..................";
        assert_eq!(within(&none, text), format!("{rest}\n"));
        assert_eq!(within(&one, text), format!("{rest}\nThe person shows frailty.\n"));
        assert_eq!(within(&OwnSentences::default(), text), format!("{text}\n"));
    }

    #[test]
    fn keeps_the_sentences_below_a_heading() {
        let none = OwnSentences { conditions: Some(Vec::new()), ..OwnSentences::default() };
        let days = |text: &str| -> Vec<u8> { read(text).habits.iter().map(|habit| habit.when.days.weekdays).collect() };
        for text in [
            "On Monday\n  she naps\nShe shows depression. She reads.",
            "She naps on Monday. From week 6:\n  she shows depression\n  # and more\n  she shows frailty\nShe reads.",
            "On Monday\n  she shows depression\n  she naps\nShe reads.",
        ] {
            let new = within(&none, text);
            assert_eq!((days(&new), read(&new).changes.len()), (vec![1, 0x7f], 0), "{new}");
        }
    }
}
