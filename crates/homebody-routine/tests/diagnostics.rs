//! Diagnostics of the routine language: codes, underlined words and hints.

use crate::home::{home, problems};
use homebody_core::problem::Problems;
use homebody_routine::language::condition;

/// Each row of `diagnostics.txt`: the text has exactly one problem, with this code, these underlined words, and this in its
/// hint; or none.
#[test]
fn texts_have_the_expected_problem() {
    let lines = include_str!("diagnostics.txt").lines();
    let rows = lines.filter(|line| !line.is_empty() && !line.starts_with('#'));
    for row in rows {
        let cells: Vec<&str> = row.splitn(4, " | ").collect();
        let text = cells.last().unwrap().replace("\\n", "\n");
        let found = problems(&text);
        let shown = Problems(found.clone()).render();
        let [code, underlined, hint, _] = cells[..] else {
            assert_eq!((cells[0], cells.len()), ("ok", 2), "{row}");
            assert_eq!(found, [], "{text}\n{shown}");
            continue;
        };
        assert_eq!(found.len(), 1, "{text}\n{shown}");
        let excerpt = found[0].excerpt.as_ref().expect("an excerpt");
        let width = excerpt.text.chars().skip(excerpt.before as usize).take(excerpt.width as usize);
        assert_eq!(width.collect::<String>(), underlined, "{shown}");
        assert_eq!(found[0].code, format!("routine::{code}"), "{shown}");
        assert!(found[0].hint.as_deref().unwrap_or_default().contains(hint), "{hint}\n{shown}");
    }
}

#[test]
fn an_order_that_goes_in_a_circle() {
    let text = "She reads after lunch.\nShe eats lunch after she reads.";
    let found = problems(text);
    assert_eq!(found.len(), 2);
    assert!(found[0].what.contains("this sentence and line 2 wait for each other"), "{}", found[0].what);
    assert!(found[1].what.contains("this sentence and line 1 wait"), "{}", found[1].what);
}

#[test]
fn a_condition_names_no_person() {
    let problem = |text: &str| condition("x.routine", text, &home()).1.remove(0).code;
    assert_eq!(problem("Margaret is 82."), "routine::condition-name");
    assert_eq!(problem("She is 82."), "routine::condition-fact");
    let text =
        "# A moderate case.\nThe person walks 10 % slower.\nShe skips lunch on 30 % of days.\nShe shows depression.";
    assert_eq!(condition("x.routine", text, &home()).1, []);
    assert_eq!(condition("x.routine", "Over 3 weeks they read after lunch for 1 hour.", &home()).1, []);
}

#[test]
fn all_problems_come_at_once_in_the_order_of_their_places() {
    let found = problems("She wtches TV.\nShe reads at 25:00 in the balcony for 0 minutes.\nShe reads at 7.");
    let places: Vec<(u32, u32)> = found.iter().map(|problem| (problem.line, problem.column)).collect();
    assert_eq!(places, [(1, 5), (2, 14), (2, 27), (2, 39), (3, 14)]);
}

#[test]
fn renders_a_problem_with_its_line_and_hint() {
    let found = Problems(problems("Every day\n  she wtches television")).render();
    let wanted = "\
margaret.routine:2:7: error[routine::unknown-verb]: \"wtches television\" is not a known activity
    2 |   she wtches television
      |       ^^^^^^^^^^^^^^^^^
  hint: did you mean \"watches television\"?
";
    assert_eq!(found, wanted);
}

#[test]
fn columns_count_characters_and_fit_any_way_of_writing() {
    let found = problems("\u{feff}# caf\u{e9}\r\n\tShe\u{a0}reads in the caf\u{e9}\u{2019}s yard.");
    assert_eq!((found[0].line, found[0].column), (2, 2));
    assert_eq!((found[1].line, found[1].column), (2, 19));
    assert_eq!(found[1].excerpt.as_ref().unwrap().width, 11);
}

#[test]
fn only_the_first_hundred_problems_are_listed() {
    let found = problems(&"She flies.\n".repeat(250));
    assert_eq!(found.len(), 101);
    assert_eq!((found[100].code, &found[100].data["count"]), ("problems::more", &150.into()));
}

#[test]
fn texts_that_are_too_long_are_refused() {
    let found = problems(&"she reads, ".repeat(200_000));
    assert_eq!(found.len(), 1);
    assert!(found[0].what.contains("more than 2000 characters"));
    let found = problems(&"She reads.\n".repeat(2_001));
    assert!(found[0].what.contains("at most 2000 sentences"), "{}", found[0].what);
}

#[test]
fn every_sentence_that_a_hint_proposes_is_understood() {
    let texts = [
        "She collects stamps.",
        "She urinates purple.",
        "She walks slowly.",
        "She goes out whenever it thunders.",
        "She watches a lot of television in the evening.",
        "She is up three times a night.",
        "She reads blorp thrice at 10:00 because her eyes are bad.",
        "She becomes agitated in the evening.",
        "Her lunch visits on Sunday for 2 hours.",
        "When she cannot sleep, she reads at night.",
        "She gets a letter.",
        "She whittles on the sofa.",
        "She flies to the moon on Sunday.",
        "Her cat sleeps on the sofa.",
        "She goes to bed at 22:00 with her three teddies.",
    ];
    let mut with_sentence = 0;
    for text in texts {
        let found = problems(text);
        assert!(!found.is_empty(), "{text}");
        for problem in found {
            let hint = problem.hint.unwrap_or_default();
            for quoted in hint.split('"').skip(1).step_by(2).filter(|quoted| quoted.to_lowercase().starts_with("she "))
            {
                assert_eq!(problems(quoted), [], "{text}: {hint}");
                with_sentence += 1;
            }
        }
    }
    assert!(with_sentence >= 6, "{with_sentence}");
}
