//! The explanation of a routine, in numbers and in words.

use crate::home::understood;
use homebody_routine::explain::{ExplanationRow, explain};

fn row(sentence: &str) -> ExplanationRow {
    explain(&understood(sentence)).sentences.remove(0)
}

#[test]
fn every_sentence_is_said_again_in_words() {
    for (sentence, words) in [
        (
            "Most mornings she naps on the sofa for about 2 hours.",
            "On 85 % of days, she naps on the sofa in the morning for about 2 hours.",
        ),
        (
            "On Tuesday he goes out at about 10:00, give or take 30 minutes.",
            "On Tuesday, he leaves the apartment at 10:00, give or take 30 minutes.",
        ),
        ("She reads every 3 days on Monday.", "Every 3 weeks on Monday, she reads."),
        ("In January she reads every other day, 2 to 3 times.", "Every 2 days, in January, she reads 2 to 3 times."),
        (
            "From week 6 to week 12, over 10 days, fading over 2 weeks, she shows severe depression.",
            "From day 36, over 10 days, until day 85, fading over 14 days, she shows severe depression.",
        ),
        ("She gets up 45 to 90 minutes earlier.", "She gets up 45 to 90 minutes earlier."),
        ("She does not go out on Sunday.", "On Sunday, she never leaves the apartment."),
        (
            "Whenever he has been in bed for 10 hours, he often gets up.",
            "Whenever he has been in bed for 10 hours, he gets up on 70 % of occasions.",
        ),
        ("Sometimes her daughter visits on Sunday.", "On Sunday, on 20 % of days, her daughter visits."),
    ] {
        assert_eq!(row(sentence).in_words, words);
    }
}

#[test]
fn the_table_has_a_line_for_everything_that_was_understood() {
    let text = explain(&understood(
        "Margaret is 82. She walks at about 0.65 m/s.\nShe cooks lunch at 12:00 for 20 minutes, then eats.\nShe walks 10 % slower.",
    ))
    .to_text();
    let wanted = "\
line  what                                       on   when         lasts             from
1     82 years old, walks at 0.585 to 0.715 m/s
2     prepares lunch                             p 1  11:55-12:05  18 min to 22 min
2     eats lunch                                 p 1  then
3     walking speed 0.9 times
";
    assert!(text.starts_with(wanted), "{text}");
}

#[test]
fn tells_the_wait_of_a_rule_from_its_duration() {
    let text = "She cooks lunch.\nWhenever the stove has been on for 20 minutes, she rests on the sofa for 1 hour.";
    let explained = explain(&understood(text));
    let json = serde_json::to_value(&explained.sentences[1]).unwrap();
    let mean = |what: &str| json[what]["mean"].as_f64().unwrap().round();
    assert_eq!((mean("waits"), mean("lasts")), (1_200.0, 3_600.0));
    let turns = "She cooks lunch.\nWhenever the stove has been on for 20 minutes, she turns it off.";
    let text = explain(&understood(turns)).to_text();
    let line = text.lines().nth(2).unwrap();
    assert!(line.ends_with("p 1  whenever the stove has been on or open for 18 min to 22 min"), "{text}");
}

#[test]
fn names_the_person_with_the_line() {
    let row = row("# Well until the sixth week.\nMargaret is 82. She walks at 0.65 m/s.");
    assert_eq!((row.line, row.said.as_str()), (2, "Margaret is 82"));
    assert_eq!(row.in_words, "Margaret is 82 years old. Margaret walks at 0.65 m/s.");
}

#[test]
fn the_numbers_are_there_for_programs() {
    let json = serde_json::to_value(row("She rarely goes out at about 10:00 for 2 to 3 hours.")).unwrap();
    assert_eq!(json["kind"], "habit");
    assert_eq!(json["probability"], 0.1);
    assert_eq!(json["start"]["least"], 34_800.0);
    assert_eq!(json["lasts"]["mean"], 9_000.0);
}
