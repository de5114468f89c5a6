//! A scenario's lexicon: read together with its routines, checked, and kept with the recording.

use crate::stage::{ORDINARY, files, household};
use homebody_routine::language::lexicon::{Lexicon, OWN_FILE};
use homebody_routine::routine::Activity;

const WORDS: &str = "\
# What Margaret's daughter calls things.
[reading]
~leaf through catalogue|catalogues

[tending bonsai] tends the bonsai; 40 minutes; armchair
~tend bonsai

[OUTSIDE]
chess cafe

[MEANS]
at elevenses => at about 11:00
";

const SAID: &str = "She leafs through her catalogues in the evening.\nShe tends the bonsai at elevenses.\nShe goes to the chess cafe on Sunday.\n";

fn with_words(words: &str, routine: &str) -> Result<Vec<Activity>, String> {
    let files = files(&format!("{ORDINARY}\n{routine}"), &[(OWN_FILE, words)]);
    let (scenario, household) = household(&files, &[])?;
    assert!(scenario.sources.contains_key(OWN_FILE));
    let habits = household.routine(0).unwrap().habits.iter();
    Ok(habits.rev().take(3).map(|habit| habit.activity.clone()).collect())
}

#[test]
fn a_scenario_has_words_of_its_own() {
    let said = with_words(WORDS, SAID).unwrap();
    assert_eq!(said, [Activity::Leave, Activity::Other("tending bonsai".into()), Activity::Read]);
    let without = household(&files(&format!("{ORDINARY}\n{SAID}"), &[]), &[]).unwrap_err();
    assert!(without.contains("leafs through"), "{without}");
}

#[test]
fn reports_problems_of_a_lexicon_with_their_lines() {
    for (words, wanted) in [
        ("~read", "own.words:1:1: this line has no section above it"),
        ("[readng]\n~leaf", "did you mean \"[reading]\"?"),
        ("[MEANS]\nat elevenses", "does not give the meaning of its words"),
        ("[reading]\n~leaf through\n~leaf through", "occurs twice"),
        ("[tending bonsai] tends; 9000 minutes", "is not a valid usual length"),
    ] {
        let said = with_words(words, "").expect_err(words);
        assert!(said.contains(wanted), "{wanted}: {said}");
    }
}

#[test]
fn no_phrase_of_the_language_is_said_twice_and_each_is_understood_as_what_it_says() {
    let lexicon = Lexicon::built_in();
    assert!(lexicon.count() > 600, "{}", lexicon.count());
    let mut written: Vec<&str> = lexicon.ways.iter().map(|(way, _)| way.as_str()).collect();
    let all = written.len();
    written.sort();
    written.dedup();
    assert_eq!(written.len(), all);
}
