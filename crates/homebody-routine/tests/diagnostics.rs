//! What is wrong is said by name, at the very words, with what could be written instead.

mod home;

use home::{home, problems, understood};
use homebody_core::problem::Problems;
use homebody_routine::language::condition;

/// The text has one problem with this code, which underlines these words; the hint contains that.
#[track_caller]
fn refused(text: &str, underlined: &str, code: &str, hint: &str) {
    let found = problems(text);
    let shown = Problems(found.clone()).render();
    assert_eq!(found.len(), 1, "{text}\n{shown}");
    let excerpt = found[0].excerpt.as_ref().expect("an excerpt");
    let width = excerpt.text.chars().skip(excerpt.before as usize).take(excerpt.width as usize);
    assert_eq!(width.collect::<String>(), underlined, "{shown}");
    assert_eq!(found[0].code, format!("routine::{code}"), "{shown}");
    assert!(found[0].hint.as_deref().unwrap_or_default().contains(hint), "{hint}\n{shown}");
}

#[test]
fn rejects_unknown_verbs() {
    let known = "did you mean \"watches television\"?";
    refused("She wtches television at 7 pm.", "wtches television", "unknown-verb", known);
    refused("She wtches television in the armchair for 1 hour.", "wtches television", "unknown-verb", known);
    refused("She whittles.", "whittles", "unknown-verb", "she whittles in the armchair for 20 minutes");
    refused("She whittles on the sofa.", "whittles", "unknown-verb", "she whittles on the sofa for 20 minutes");
    refused("She does not whittle.", "whittle", "unknown-verb", "");
    understood("She knits. She knits in the armchair.");
}

#[test]
fn late_and_early_are_no_time_of_what_comes_after_something() {
    let (code, hint) = ("not-understood", "say at what time");
    refused("She has dinner at 18:00. She goes to bed late after dinner.", "late", code, hint);
    refused("She reads at 21:00. On Monday she goes to bed early after she reads.", "early", code, hint);
    understood("She goes to bed late, at about 1 am. She naps late in the afternoon.");
}

#[test]
fn every_other_of_several_days() {
    let (code, hint) = ("several-weekdays", "every other Saturday");
    refused("Her daughter visits every other weekend.", "every other weekend", code, hint);
    refused("She naps every third Monday and Friday.", "every third Monday and Friday", code, hint);
    assert_eq!(problems("She naps every third Monday."), []);
}

#[test]
fn rejects_unknown_places() {
    refused("She reads in the armchiar.", "armchiar", "unknown-place-or-time", "did you mean \"armchair\"?");
    refused("She has lunch on the roof.", "roof", "unknown-place-or-time", "there are \"armchair\"");
    refused("She whittles on the balcony for 1 hour.", "balcony", "unknown-place-or-time", "");
    refused("She goes to the batroom.", "batroom", "unknown-place-or-time", "did you mean \"bathroom\"?");
}

#[test]
fn an_unknown_room_of_a_rule() {
    let text = "Whenever she has been in the batroom for 20 minutes, she goes to bed.";
    refused(text, "batroom", "unknown-place", "did you mean \"bathroom\"?");
}

#[test]
fn an_unknown_thing() {
    refused("She forgets the oven on 5 % of occasions.", "oven", "unknown-thing", "\"stove\"");
    let text = "Whenever the stve has been on for 20 minutes, she turns it off.";
    refused(text, "stve", "unknown-thing", "did you mean \"stove\"?");
}

#[test]
fn an_unknown_condition() {
    refused("She shows mild depresion.", "depresion", "unknown-condition", "did you mean \"depression\"?");
    refused("She shows gout.", "gout", "unknown-condition", "\"heart-failure\"");
}

#[test]
fn an_unknown_person() {
    refused("Robert is 80.", "Robert", "other-person", "");
    refused("Robert gets up at 7:00.", "Robert", "other-person", "");
    refused("Margret is 82.", "Margret", "other-person", "did you mean \"Margaret\"?");
}

#[test]
fn an_unknown_visitor() {
    refused("Anna visits on Sunday.", "Anna", "unknown-visitor", "her daughter visits");
    refused("Her daughter naps.", "Her daughter", "visitor-acts", "her daughter visits on Sunday");
    refused("Her cat sleeps.", "Her cat", "unknown-action", "her daughter visits");
    refused("Her daughter visits. Her dauhgter visits on Sunday.", "visits", "similar-visitors", "did you mean");
    refused("The stove is hot.", "The stove", "thing-acts", "she forgets the stove rarely");
}

#[test]
fn an_unknown_word() {
    refused("She reads abuot 7:30.", "abuot", "not-understood", "did you mean \"about\"?");
    refused("Evry day she reads.", "Evry", "not-understood", "did you mean \"every\"?");
    refused("She reads blorp.", "blorp", "not-understood", "expected where, when");
    understood("She reads quickly.");
    refused("She reads @ noon.", "@", "not-understood", "");
    understood("She reads 2 hours.");
    refused("In the last week she reads.", "In the last", "not-understood", "from week 6");
    refused("She is busy.", "busy", "not-understood", "is 30 % less active");
}

#[test]
fn an_impossible_time() {
    for time in ["25:00", "7:75", "14 am", "24:01", "99999999999:00", "6.75", "6.4"] {
        refused(&format!("She gets up at {time}."), time, "no-time", "");
    }
    refused("She gets up at 6.4.", "6.4", "no-time", "06:45");
}

#[test]
fn a_slip_within_a_time() {
    for (when, slip, meant) in [
        ("at 7:4o", "7:4o", "7:40"),
        ("at 7;40", "7;40", "7:40"),
        ("at l0:00", "l0:00", "10:00"),
        ("at 07h30", "07h30", "7:30"),
        ("at 7,40", "7,40", "7:40"),
        ("at 730", "730", "7:30"),
        ("about 7:4o", "7:4o", "7:40"),
        ("until 7:4o", "7:4o", "7:40"),
        ("from 7:4o to 8:00", "7:4o", "7:40"),
        ("between 7;40 and 8:00", "7;40", "7:40"),
        ("from 7:00 to 8;3o", "8;3o", "8:30"),
    ] {
        refused(&format!("She reads {when}."), slip, "no-time", &format!("did you mean \"{meant}\"?"));
    }
    refused("She reads at 7:40:00.", "7:40:00", "no-time", "");
    understood("She reads at 7:40, then naps. She phones from 10:00-11:00. She drinks at 7:00on Monday,for 5 minutes.");
}

#[test]
fn a_time_that_may_be_of_two_halves_of_the_day() {
    refused("She reads at 7.", "7", "ambiguous-time", "write \"7 am\" or \"7 pm\"");
    refused("She reads at 7 o'clock.", "7 o'clock", "ambiguous-time", "7 am");
    refused("She gets up at 3.", "3", "ambiguous-time", "3 am");
    understood("She goes to church on Sunday at 11 and to bingo on Friday evening.");
    understood(
        "She reads at 7 in the morning. She gets up at 7. She goes to bed at 10. She eats lunch at half past twelve.",
    );
    let both = "write \"half past seven in the morning\" or \"half past seven in the evening\"";
    refused("She reads at half past seven.", "half past seven", "ambiguous-time", both);
    let both = "write \"quarter to one at night\" or \"quarter to one in the afternoon\"";
    refused("She reads at quarter to one.", "quarter to one", "ambiguous-time", both);
    refused("She reads at half eight.", "half eight", "ambiguous-time", "half eight in the morning");
    understood("She naps in the morning and on Monday evening at 7 pm. She reads at 10:00 and at 12:00.");
}

#[test]
fn a_time_outside_its_part_of_the_day() {
    refused("In the morning she reads at 20:00.", "at 20:00", "part-of-day", "");
}

#[test]
fn a_time_that_is_left_open() {
    refused("She reads after 20:00.", "after 20:00", "open-time", "between 20:00 and 22:00");
}

#[test]
fn an_end_that_is_no_time_of_day() {
    let before = "for 2 hours before she goes to bed";
    let text = "She watches television from 20:00 until she goes to bed.";
    refused(text, "until she goes to bed", "until-activity", before);
    refused("She reads until bedtime.", "until bedtime", "until-activity", "for 2 hours before bedtime");
    refused("She reads from 20:00.", "from 20:00", "no-end", "write \"at 20:00\"");
    understood("She watches television for 2 hours before she goes to bed.");
}

#[test]
fn how_long_within_a_day_without_from_when() {
    refused("She reads all day.", "all day", "part-of-each-day", "from 14:00 to 17:00");
    understood("She sits in the armchair most of the afternoon. Most of the days she reads. All days she naps.");
}

#[test]
fn something_done_every_few_hours() {
    refused("She drinks every two hours.", "every two hours", "every-hours", "\"8 times a day\"");
    refused("She drinks every hour.", "every hour", "every-hours", "\"16 times a day\"");
}

#[test]
fn a_way_without_a_purpose() {
    let text = "She goes to the kitchen.";
    refused(text, "goes to the kitchen", "only-goes", "she sits in the kitchen for 20 minutes");
    refused("She goes to the stove for 1 hour.", "goes to the stove", "only-goes", "she sits at the stove");
    let outside = "for what is outside, write \"she goes out at 10:00 for 2 hours\"";
    refused("She goes to the volcano on Friday.", "volcano", "unknown-place-or-time", outside);
    understood("She goes to the hairdresser on Friday.");
    understood("She is in hospital from day 30.");
    understood("She sits in the kitchen for 20 minutes.");
}

#[test]
fn a_purpose() {
    let code = "purpose";
    refused("She reads at 4:00 to use the toilet.", "to use the toilet", code, "then she uses the toilet");
    understood("She gets up at 4:00 to use the toilet. She likes to sit by the bed.");
}

#[test]
fn what_is_not_done_stays_so() {
    let until = "until week 12 she whittles in the armchair for 1 hour";
    refused("She does not whittle in the armchair for 1 hour.", "whittle", "unknown-verb", until);
    refused("She no longer flies.", "flies", "unknown-verb", until);
    refused("She does not raed.", "raed", "unknown-verb", "did you mean \"reads\"?");
    refused("She cooks lunch, then does not eat.", "eat", "which-meal", "name the meal");
}

#[test]
fn what_is_left_out_on_some_weekdays() {
    refused("She forgets her pills.", "forgets her pills", "how-often", "she skips pills on 30 % of days");
    understood("She forgets her pills on Sundays. She does not eat lunch on Sunday and Tuesday.");
    understood("She takes medicine from Monday to Saturday. She skips pills on 14 % of days.");
}

#[test]
fn a_verb_that_goes_with_something_else() {
    let known = "known activities are ";
    refused("She makes herself a kite.", "makes herself a kite", "unknown-verb", known);
    let own = "a new activity needs a place and a duration: \"she whittles wood in the hall for 20 minutes\"";
    refused("She whittles wood in the hall.", "whittles wood", "unknown-verb", own);
    refused("She has dreams.", "has dreams", "unknown-verb", "known activities are");
    let rule = "\"whenever she has been in bed for 10 hours, she gets up\"";
    refused("She paces when the moon is full.", "when", "not-understood", rule);
    understood("Her son phones on Sunday.");
}

#[test]
fn no_duration_or_more_than_a_day() {
    refused("She reads for 0 minutes.", "0 minutes", "no-duration", "");
    refused("She reads for 25 hours.", "for 25 hours", "longer-than-a-day", "");
    understood("On Tuesday she is out for 25 hours.");
    refused("She reads for -5 minutes.", "-5 minutes", "not-a-length", "");
    refused("She reads for 3 beats.", "3 beats", "not-a-length", "");
}

#[test]
fn a_range_upside_down() {
    refused("She reads for 3 to 2 hours.", "3 to 2 hours", "reversed-numbers", "smaller");
    refused("She reads between 16:00 and 14:00.", "16:00 and 14:00", "reversed-times", "earlier");
    refused("She reads at 20:00 until 19:00.", "until 19:00", "end-before-begin", "");
}

#[test]
fn more_than_all() {
    refused("She reads on 130 % of days.", "130 %", "more-than-all", "at most 100 %");
    refused("She walks 120 % slower.", "120 %", "less-than-nothing", "at most 100 %");
    refused("She reads on 0 % of days.", "0 %", "never", "");
    refused("She reads on 8 days a week.", "8 days", "days-a-week", "");
}

#[test]
fn a_quantifier_where_none_fits() {
    refused("She is often 82.", "often", "does-not-fit", "leave these words out");
    refused("She often shows depression.", "often", "does-not-fit", "");
    refused("She is almost never from week 6.", "is almost never from week 6", "open-change", "");
}

#[test]
fn two_quantifiers() {
    refused("Often she sometimes reads.", "sometimes", "twice", "");
    refused("Every day she rarely reads.", "rarely", "twice", "");
}

#[test]
fn two_of_a_kind() {
    refused("She reads at 7:30 at 8:30.", "at 8:30", "twice", "");
    refused("She reads for 20 minutes for 30 minutes.", "for 30 minutes", "twice", "");
    refused("She reads for 1 hour until 19:00.", "until 19:00", "two-ends", "");
    refused("She reads on the sofa in the armchair.", "in the armchair", "two-places", "");
    refused("She is 82. She is 83.", "is 83", "said-before", "");
    refused("Margaret is a cat. Margaret is a dog.", "is a dog", "said-before", "");
}

#[test]
fn two_times_of_getting_up_on_the_same_day() {
    let text = "She gets up at 7:00.\nOn Sunday she gets up at 9:00.";
    refused(text, "gets up", "two-times", "on weekdays");
    understood("From Monday to Saturday she gets up at 7:00.\nOn Sunday she gets up at 9:00.");
    understood("Until day 50 she gets up at 7:00.\nFrom day 50 she gets up at 9:00.");
    understood("Often she gets up at 7:00.\nSometimes she gets up at 9:00.");
}

#[test]
fn getting_up_more_than_once() {
    refused("She gets up twice a night.", "twice a night", "once-a-day", "goes to the bathroom");
    refused("At night she gets up.", "At night", "once-a-day", "wanders");
}

#[test]
fn bed_before_getting_up() {
    let text = "She gets up at 7:00.\nShe goes to bed at 6:30.";
    refused(text, "goes to bed", "bed-before-up", "22:30");
    understood("She gets up at 7:00.\nShe goes to bed at 0:30.");
}

#[test]
fn coming_home_without_leaving() {
    refused("She comes home at 12:00.", "comes home", "home-without-leaving", "");
}

#[test]
fn an_order_that_goes_in_a_circle() {
    let text = "She reads after lunch.\nShe eats lunch after she reads.";
    let found = problems(text);
    assert_eq!(found.len(), 2);
    assert!(found[0].what.contains("this sentence and line 2 wait for each other"), "{}", found[0].what);
    assert!(found[1].what.contains("this sentence and line 1 wait"), "{}", found[1].what);
    refused("She reads after she reads.", "reads", "after-itself", "");
}

#[test]
fn something_after_what_is_never_done() {
    refused("She reads after lunch.", "reads", "no-anchor", "she eats lunch at about 12:00");
}

#[test]
fn then_with_nothing_before_it() {
    refused("Then she reads.", "Then", "nothing-before-then", "");
}

#[test]
fn a_rule_that_never_comes_true() {
    let text = "Whenever the stove has been on for 20 minutes, she turns it off.";
    refused(text, "the stove has been on", "never-used", "she prepares breakfast");
    understood(&format!("She cooks lunch.\n{text}"));
    let text = "Whenever she has been out for 4 hours, she takes a nap.";
    refused(text, "she has been out", "never-out", "");
    refused(&format!("She goes out for 1 hour.\n{text}"), "for 4 hours", "never-out-so-long", "");
    understood(&format!("She goes out for 4 hours.\n{text}"));
}

#[test]
fn a_rule_that_always_comes_true() {
    let text = "She cooks lunch.\nWhenever the stove has been on for 0 minutes, she turns it off.";
    refused(text, "0 minutes", "always", "for 20 minutes");
}

#[test]
fn a_rule_longer_than_a_day() {
    let text = "Whenever she has been in bed for 30 hours, she gets up.";
    refused(text, "30 hours", "longer-than-a-day", "");
}

#[test]
fn a_rule_that_is_not_complete() {
    let cook = |rule: &str| format!("She cooks lunch.\n{rule}");
    refused(&cook("Whenever the stove is on, she turns it off."), ",", "no-length", "");
    let text = cook("Whenever the stove has been on for 20 minutes, turns it off.");
    refused(&text, "turns", "no-subject", "");
    refused(&cook("Whenever the stove has been hot."), "hot", "no-state", "has been on");
    let text = "Whenever she has been in bed for 10 hours, she turns it off.";
    refused(text, "it", "which-thing", "the name of the thing");
    let text = "Whenever she has been in bed for 10 hours, her daughter visits.";
    refused(text, "her daughter", "not-the-resident", "");
    refused("Whenever she reads", "reads", "no-answer", "");
}

#[test]
fn a_phase_that_ends_before_it_begins() {
    refused("From week 6 to week 2 she shows depression.", "to week 2", "end-before-begin", "");
    refused("From 2009-05-01 to 2009-04-01 she reads.", "to 2009-04-01", "end-before-begin", "");
    refused("From day 100 until 2009-04-01 she reads.", "until 2009-04-01", "end-before-begin", "");
    refused("From day 0 she reads.", "day 0", "no-day", "from 1 to 36525");
    let text = "From week 6 she reads rarely at first, often by week 2.";
    refused(text, "rarely at first, often by week 2", "change-before-begin", "a later day");
    refused("From March she reads.", "March", "which-day", "2009-03-01");
    refused("From 2009-02-30 she reads.", "2009-02-30", "no-date", "2009-05-01");
}

#[test]
fn a_change_over_a_time_without_a_beginning() {
    refused("Over 4 weeks she shows depression.", "Over 4 weeks", "no-beginning", "From week 6, over 4 weeks");
    refused("She shows depression, fading over 2 weeks.", "fading over 2 weeks", "no-end-to-fade", "");
}

#[test]
fn a_change_said_of_some_days_only() {
    understood("On Tuesday she walks 10 % slower. She gets up 1 hour later on Sunday. She naps 30 % longer in winter.");
    refused("On Tuesday she shows depression.", "On Tuesday", "does-not-fit", "leave these words out");
    refused("She gets up 1 hour later in the kitchen.", "in the kitchen", "does-not-fit", "");
}

#[test]
fn a_change_that_may_mean_two_things() {
    refused("She watches television 30 % more.", "30 % more", "more-or-longer", "30 % longer");
    refused("She walks.", "walks", "open-change", "walks 10 % slower");
    refused("She sleeps.", "sleeps", "open-change", "30 % more restlessly");
    refused("She eats.", "eats", "which-meal", "breakfast");
}

#[test]
fn how_often_is_not_said_where_it_is_needed() {
    refused("She skips lunch.", "skips lunch", "how-often", "she skips lunch on 30 % of days");
    refused("She forgets the stove.", "forgets the stove", "how-often", "on 5 % of occasions");
    refused("She reads often at first.", "first", "at-first", "often by day 160");
    refused("She reads rarely at first, often.", "often", "by-when", "often by day 160");
}

#[test]
fn headings_and_indents() {
    refused("  she reads", "she reads", "indented", "Every day");
    refused("Every day\nshe reads", "Every day", "empty-heading", "indent");
    refused("Every day\n  in the morning", "in the morning", "nothing-done", "");
}

#[test]
fn a_sentence_that_is_not_complete() {
    refused("She", "She", "unfinished", "");
    refused("Get up at 7:00.", "Get up", "no-subject", "she gets up");
    understood("Gets up at 7:00.");
    refused("She reads and naps or knits.", "or", "and-or", "two sentences");
}

#[test]
fn a_condition_is_about_nobody_in_particular() {
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
    assert_eq!(places, [(1, 5), (2, 14), (2, 27), (3, 14)]);
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
fn changes_beyond_all_bounds() {
    refused("She gets up later by 100 hours.", "100 hours", "too-great", "write at most a day");
    refused("She gets up 100 hours later.", "100 hours", "too-great", "write at most a day");
    refused("She drinks 1000 times as often.", "1000 times", "too-great", "write at most 100 times");
    refused("She naps 100000 % longer.", "100000 %", "too-great", "write at most 100 times");
    refused("Her pulse rises by 1000 beats.", "1000 beats", "too-great", "");
    refused("She breathes 1000 breaths a minute faster.", "1000 breaths a minute", "too-great", "");
    refused("She walks 5 m/s faster every week.", "5 m/s", "too-great", "");
    refused("She walks at 0.5 to 500 m/s.", "0.5 to 500 m/s", "pace", "0.2 to 1.6 m/s");
    let text = "She gets up at 7:00, give or take 13 hours.";
    refused(text, "give or take 13 hours", "spread-of-time", "at most 12 hours");
}

#[test]
fn what_never_happens() {
    refused("She reads on 0 days a week.", "0 days", "never", "leave the sentence out");
    refused("She falls 0 times a month.", "0 times", "never", "leave the sentence out");
}

#[test]
fn two_ends_and_parts_of_days() {
    let text = "From day 20, for 10 days, until day 25, she naps.";
    refused(text, "for 10 days", "two-ends", "leave one of them out");
    refused("From day 20, for 1.5 days, she naps.", "1.5 days", "whole-days", "for 10 days");
    refused("She reads at 10:00 until 8:00.", "until 8:00", "end-before-begin", "write an end after the beginning");
}

#[test]
fn what_was_looked_at_before_it_was_read_is_told_once() {
    refused("Her daughter at 25:00 visits.", "25:00", "no-time", "");
    refused("Her nice daughter for 0 minutes visits.", "0 minutes", "no-duration", "");
    refused("Anna at 25:00 visits.", "Anna", "other-person", "");
    refused("Her sister often reads.", "Her sister", "visitor-acts", "her sister visits on Sunday");
}

#[test]
fn sentences_that_contradict_each_other() {
    let not = "contradiction";
    refused("She naps every day.\nShe never naps.", "naps", not, "leave one sentence out");
    understood("She naps every day.\nFrom week 6 she no longer naps. She does not nap on Sunday.");
    refused("She eats dinner at 18:00.\nShe eats dinner at 20:00.", "eats dinner", "two-times", "");
    let out = "out-then";
    refused("She goes out from 10:00 to 15:00.\nShe eats lunch at 12:30.", "eats lunch", out, "on which days");
    understood("On Monday she goes out from 10:00 to 15:00.\nFrom Tuesday to Sunday she eats lunch at 12:30.");
    let home = "home-twice";
    refused("She goes out at 10:00 for 2 hours.\nShe comes home at 14:00.", "comes home", home, "");
    let full =
        "She gets up at 8:00.\nShe goes to bed at 22:00.\nShe reads for 8 hours.\nShe watches television for 9 hours.";
    refused(full, "watches television", "full-day", "shorter");
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
    assert!(with_sentence >= 12, "{with_sentence}");
}
