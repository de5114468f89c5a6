//! `homebody life from`: nothing is written before it is accepted, and nothing is lost.

use crate::folder::{Done, Folder};
use crate::played_server::{PlayedServer, Reply};
use serde_json::{Value, json};

const TEXT: &str = "Walter gets up at seven. After lunch he has a nap. He misses his wife.";

fn folder() -> Folder {
    let folder = Folder::with("studio");
    folder.write("text.txt", TEXT);
    folder
}

/// The command has printed a result that lacks something.
#[track_caller]
fn lacks(done: Done, said: &str) -> Done {
    assert_eq!(done.code, Some(2), "{}", done.err);
    assert!(!done.out.is_empty());
    done.says(&[said])
}

fn answer(first: &str) -> String {
    let line = |source: &str, statements: &[&str], cannot: &[&str]| json!({ "source": source, "statements": statements, "assumed": [], "cannot_be_said": cannot });
    json!({ "lines": [
        line("Walter gets up at seven.", &[first], &[]),
        line("After lunch he has a nap.", &["He naps after lunch for 40 minutes."], &[]),
        line("He misses his wife.", &[], &["a feeling"]),
    ] })
    .to_string()
}

const RIGHT: &str = "He gets up at 07:00.";

#[test]
fn an_accepted_answer_is_written_with_its_rounds_and_made_again() {
    let folder = folder();
    folder.write("answer.txt", format!("Here you are:\n```json\n{}\n```", answer(RIGHT)));
    let before = folder.read("studio/walter.routine");
    let words = "life from text.txt --home studio --answer answer.txt";
    folder.run(&format!("{words} --yes")).fails(1, "already exists");
    folder.run(words).fails(2, "no-terminal").says(&["--yes", "nothing is written yet"]);
    folder.run(&format!("{words} --json")).ok();
    assert_eq!(folder.read("studio/walter.routine"), before, "nothing is written unasked");
    assert!(!folder.path("studio/walter.rounds.json").exists());
    let done = folder.run(&format!("{words} --yes --force")).ok();
    assert!(done.out.contains("Walter gets up at seven.") && done.out.contains("a feeling"), "{}", done.out);
    let routine = folder.read("studio/walter.routine");
    assert!(routine.contains("\n# Walter gets up at seven.\nHe gets up at 07:00.\n"), "{routine}");
    assert!(routine.contains("#   cannot be said: a feeling\n"), "{routine}");
    folder.run("check studio").ok();
    folder.run("life from --rounds studio/walter.rounds.json --out again.routine").ok();
    assert_eq!(folder.read("again.routine"), routine);
    assert!(!folder.path("again.rounds.json").exists(), "the rounds are there already");
}

#[test]
fn without_a_model_the_prompts_are_printed() {
    let folder = folder();
    let first = folder.run("life from text.txt --home studio --prompt").ok();
    for word in ["Walter", "1. Walter gets up at seven.", "cannot_be_said", "naps"] {
        assert!(first.out.contains(word), "{word}: {}", first.out);
    }
    folder.write("answer.txt", answer("He gets up sevenish."));
    let next = lacks(folder.run("life from text.txt --home studio --answer answer.txt"), "not-yet");
    assert!(next.out.contains("\"He gets up sevenish.\" is refused") && next.out.contains("hint: "), "{}", next.out);
    folder.write("second.txt", answer(RIGHT));
    let words = "life from text.txt --home studio --answer answer.txt --answer second.txt --json";
    let result: Value = serde_json::from_str(&folder.run(words).ok().out).unwrap();
    assert_eq!((&result["rounds"], &result["routine"]), (&2.into(), &Value::Null));
    assert_eq!(result["draft"]["lines"][0]["statements"][0]["text"], RIGHT);
}

#[test]
fn a_routine_that_lacks_something_is_written_with_exit_code_2() {
    let folder = folder();
    let words = "life from text.txt --home studio --answer answer.txt --yes --force";
    folder.write("answer.txt", answer("He gets up sevenish."));
    lacks(folder.run(words), "life-from::incomplete").says(&["refused sentences: 1"]);
    let routine = folder.read("studio/walter.routine");
    assert!(routine.contains("\nHe naps after lunch for 40 minutes.\n"), "{routine}");
    lacks(folder.run(&format!("{words} --json")), "life-from::incomplete");
    folder.write("answer.txt", answer(RIGHT).replace("a feeling", "He reads at 15:00."));
    let done = lacks(folder.run(words), "sentences among the notes of the answer: 1").says(&["free-text::misplaced"]);
    assert!(done.out.contains("(under \"cannot_be_said\")"), "{}", done.out);
    assert!(!folder.read("studio/walter.routine").contains("\nHe reads"));
    folder.write("answer.txt", answer("He gets up sevenish.").replace("He naps", "He frobs"));
    lacks(folder.run(words), "life-from::none-accepted");
    lacks(folder.run(&words.replace("--yes", "--json")), "life-from::not-all");
}

#[test]
fn a_model_is_asked_and_its_key_is_never_told() {
    const KEY: &str = "sk-secret-of-a-test";
    let folder = folder();
    let played = PlayedServer::playing([answer("He gets up sevenish."), answer(RIGHT)].map(Reply::Content));
    let words = format!("life from text.txt --home studio --model {} --yes --force", played.url);
    let done = folder.command(&words).env("HOMEBODY_MODEL_KEY", KEY).output().unwrap();
    let (out, err) = (String::from_utf8_lossy(&done.stdout), String::from_utf8_lossy(&done.stderr));
    assert!(done.status.success(), "{err}");
    let requests = played.requests();
    assert_eq!(requests.len(), 2);
    assert!(requests[0].head.contains(KEY));
    let rounds = folder.read("studio/walter.rounds.json");
    assert!(rounds.contains("sevenish") && rounds.contains(&played.url), "{rounds}");
    for text in [&*out, &*err, &rounds, &folder.read("studio/walter.routine")] {
        assert!(!text.contains(KEY), "{text}");
    }
}

#[test]
fn a_model_that_fails_changes_nothing_and_its_answers_are_shown() {
    let folder = folder();
    let before = folder.files();
    let routine = folder.read("studio/walter.routine");
    let refused = |status: u16| Reply::Status(status, "{\"error\": \"no\"}".into());
    let first = Reply::Content(answer("He gets up sevenish."));
    for (replies, code, says) in [
        (vec![Reply::Gone], 1, "model::unreachable"),
        (vec![Reply::Silent], 1, "model::slow"),
        (vec![refused(401)], 1, "HOMEBODY_MODEL_KEY"),
        (vec![refused(500)], 1, "model::status"),
        (vec![Reply::Endless], 1, "model::babble"),
        (vec![Reply::Content("I cannot help.".into())], 2, "free-text::nothing-usable"),
        (vec![first, Reply::Gone], 1, "model::unreachable"),
    ] {
        let played = PlayedServer::playing(replies.clone());
        let words = format!("life from text.txt --home studio --model {} --timeout 3s --yes --force", played.url);
        let done = folder.run(&words).fails(code, says).says(&["hint"]);
        if replies.len() > 1 {
            done.says(&["(refused) He gets up sevenish."]);
        }
        assert_eq!((folder.files(), folder.read("studio/walter.routine")), (before.clone(), routine.clone()));
    }
}

#[test]
fn wrong_texts_and_options_are_refused() {
    let folder = folder();
    folder.write("long.txt", "She naps after lunch. ".repeat(10_000));
    folder.write("empty.txt", "...\n");
    folder.write("bytes.txt", [0xff, 0xfe, 0x00]);
    folder.write("rounds.json", "{}");
    for (words, code, says) in [
        ("long.txt --home studio --prompt", 2, "at most 20000"),
        ("empty.txt --home studio --prompt", 2, "no sentence"),
        ("bytes.txt --home studio --prompt", 1, "bytes.txt"),
        ("gone.txt --home studio --prompt", 1, "gone.txt"),
        ("text.txt --home gone --prompt", 1, "no such scenario"),
        ("text.txt --home studio --resident ada --prompt", 2, "walter"),
        ("text.txt --home studio --model here --yes --force", 2, "model::bad-url"),
        ("text.txt --home studio --model http://127.0.0.1:9/v1 --yes --force", 1, "model::unreachable"),
        ("text.txt --home studio", 2, "no-terminal"),
        ("- --home studio", 2, "text-and-lines"),
        ("--rounds rounds.json", 2, "free-text::not-rounds"),
        ("text.txt", 2, "--home"),
    ] {
        folder.run(&format!("life from {words}")).fails(code, says);
    }
}
