use super::*;

fn said(text: &str, known: &KnownNames) -> (Routine, Vec<String>) {
    let (routine, problems) = routine("a.routine", text, known);
    (routine, problems.into_iter().map(|problem| problem.what).collect())
}

#[test]
fn the_text_may_say_the_name_where_nothing_else_does() {
    let (routine, problems) = said("Mrs. Miller is 82. Mrs. Miller reads. She naps.", &KnownNames::default());
    assert_eq!(problems, Vec::<String>::new());
    assert_eq!(routine.person.map(|person| person.name).as_deref(), Some("Mrs. Miller"));
    assert_eq!(routine.habits.len(), 2);
}

#[test]
fn who_has_no_name_yet_does_nothing() {
    let (_, problems) = said("Margaret reads.", &KnownNames::default());
    assert_eq!(problems, ["the routine does not introduce \"Margaret\""]);
}

#[test]
fn a_name_is_known_however_it_is_written() {
    let known = KnownNames {
        person: Some("Mrs. Miller".into()),
        places: vec!["Tom's chair".into(), "bedroom 2".into(), "The Window-Seat".into(), "morning room".into()],
        ..KnownNames::default()
    };
    let text = "mrs miller reads in tom\u{2019}s chair. In the morning room she reads.\n\
        She reads in Bedroom 2. She reads at the window seat in the morning.";
    let (routine, problems) = said(text, &known);
    assert_eq!(problems, Vec::<String>::new());
    let places: Vec<_> = routine.habits.iter().filter_map(|habit| habit.place.as_deref()).collect();
    assert_eq!(places, ["Tom's chair", "morning room", "bedroom 2", "The Window-Seat"]);
}

#[test]
fn what_was_said_is_kept_with_its_place() {
    let (routine, _) = said("# caf\u{e9}\n  \nShe reads. She cooks lunch,  then eats .", &KnownNames::default());
    let said: Vec<_> = routine.habits.iter().map(|h| (h.said.line, h.said.column, h.said.text.as_str())).collect();
    assert_eq!(said, [(3, 1, "She reads"), (3, 12, "She cooks lunch"), (3, 30, "then eats")]);
}

#[test]
fn a_sentence_under_a_heading_says_what_differs_itself() {
    let text = "On Monday, in the evening, often\n  she reads\n  she naps on Tuesday\n  she rests rarely\n  she drinks at 10:00";
    let (routine, problems) = said(text, &KnownNames::default());
    assert_eq!(problems, Vec::<String>::new());
    let days: Vec<u8> = routine.habits.iter().map(|habit| habit.when.days.weekdays).collect();
    assert_eq!(days, [1, 2, 1, 1]);
    let chances: Vec<f64> = routine.habits.iter().map(|habit| habit.when.chance.probability).collect();
    assert_eq!(chances, [0.7, 0.7, 0.1, 0.7]);
    assert!(matches!(routine.habits[3].when.time, crate::routine::HabitTime::At(at) if at.from == 36_000.0));
}
