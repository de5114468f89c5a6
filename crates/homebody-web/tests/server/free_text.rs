//! Texts that become statements: in the background, by a played model or by hand, and nothing is written.

use super::served::Served;
use crate::played_server::{PlayedServer, Reply};
use serde_json::{Value, json};
use std::fs;
use std::thread;
use std::time::{Duration, Instant};

const TEXT: &str = "Walter gets up at seven. After lunch he has a nap. He misses his wife.";

const KEY: &str = "sk-secret-of-a-test";

fn answer(first: &str) -> String {
    let line = |source: &str, statements: &[&str], cannot: &[&str]| json!({ "source": source, "statements": statements, "assumed": [], "cannot_be_said": cannot });
    json!({ "lines": [
        line("Walter gets up at seven.", &[first], &[]),
        line("After lunch he has a nap.", &["He naps after lunch for 40 minutes."], &[]),
        line("He misses his wife.", &[], &["a feeling"]),
    ] })
    .to_string()
}

fn by_model(url: &str) -> Value {
    json!({ "kind": "model", "url": url, "name": null, "key": KEY })
}

fn by_hand(answers: &[String]) -> Value {
    json!({ "kind": "assistant", "answers": answers })
}

impl Served {
    fn free_text(&self, text: &str, by: &Value) -> Value {
        self.free_text_about("walter.routine", text, by)
    }

    fn free_text_about(&self, file: &str, text: &str, by: &Value) -> Value {
        let request = json!({ "draft": { "texts": {} }, "file": file, "text": text, "by": by });
        let begun = self.post_json("/api/free-text", &request);
        assert_eq!(begun.0, 200, "{}", begun.1);
        self.free_text_ended()
    }

    fn free_text_ended(&self) -> Value {
        let begun = Instant::now();
        loop {
            let now = self.free_text_now();
            if !["beginning", "asking", "checking"].contains(&now["state"].as_str().unwrap_or_default()) {
                return now;
            }
            assert!(begun.elapsed() < Duration::from_secs(180), "{now}");
            thread::sleep(Duration::from_millis(50));
        }
    }

    fn free_text_now(&self) -> Value {
        serde_json::from_slice(&self.api("/api/free-text").body).unwrap()
    }

    fn post_json(&self, path: &str, body: &Value) -> (u16, Value) {
        let (address, token, body) = (self.address, &self.token, body.to_string());
        let head = format!(
            "POST {path} HTTP/1.1\r\nHost: {address}\r\nConnection: close\r\nx-homebody-token: {token}\r\n\
             Content-Type: application/json\r\nContent-Length: {}\r\n\r\n",
            body.len()
        );
        let answer = self.ask(&[head.as_bytes(), body.as_bytes()].concat());
        (answer.code, serde_json::from_slice(&answer.body).unwrap_or_default())
    }
}

#[test]
fn a_model_is_asked_and_accepted_lines_become_a_text() {
    let served = Served::scenario("studio");
    assert_eq!(served.free_text_now(), Value::Null);
    let routine = served.folder.path().join("studio/walter.routine");
    let before = fs::read_to_string(&routine).unwrap();
    let played =
        PlayedServer::playing([answer("He gets up sevenish."), answer("He gets up at 07:00.")].map(Reply::Content));
    let done = served.free_text(TEXT, &by_model(&played.url));
    assert_eq!((&done["state"], &done["prompt"]), (&"done".into(), &Value::Null), "{done}");
    assert_eq!(done["model"], format!("small at {}", played.url));
    assert!(played.requests()[0].head.contains(KEY) && !done.to_string().contains(KEY), "{done}");
    let rounds = done["rounds"].as_array().unwrap();
    assert_eq!(rounds.len(), 2, "{done}");
    assert!(rounds[0]["problems"][0].as_str().unwrap().contains("sevenish") && rounds[1]["problems"] == json!([]));
    let nap = &done["lines"][1]["statements"][0];
    assert!(nap["sentences"][0]["in_words"].as_str().unwrap().contains("40 minutes"), "{nap}");
    assert!(nap["sentences"][0]["lasts_s"][1].as_f64().is_some_and(|mean| (2300.0..2500.0).contains(&mean)), "{nap}");
    assert_eq!(done["lines"][2]["cannot_be_said"], json!(["a feeling"]));

    let accept = |number: &Value, accepted: &[bool]| {
        served.post_json("/api/free-text/routine", &json!({ "number": number, "accepted": accepted }))
    };
    let (code, put) = accept(&done["number"], &[true, false, true]);
    let text = put["text"].as_str().unwrap();
    assert!(code == 200 && text.contains("\n# Walter gets up at seven.\nHe gets up at 07:00.\n"), "{put}");
    assert!(text.contains("#   not accepted: He naps after lunch"), "{put}");
    // Rows of another text are not accepted.
    let (code, told) = accept(&json!(99), &[true]);
    assert_eq!((code, &told["code"]), (409, &"page::free-text-other".into()));
    assert_eq!(fs::read_to_string(&routine).unwrap(), before, "nothing is written");
}

#[test]
fn an_assistant_is_asked_by_hand() {
    let served = Served::scenario("studio");
    let first = served.free_text(TEXT, &by_hand(&[]));
    assert_eq!((&first["state"], &first["lines"]), (&"done".into(), &json!([])), "{first}");
    assert!(first["prompt"].as_str().unwrap().contains("1. Walter gets up at seven."), "{first}");
    let next = served.free_text(TEXT, &by_hand(&[answer("He gets up sevenish.")]));
    assert!(next["prompt"].as_str().unwrap().contains("\"He gets up sevenish.\" is refused"), "{next}");
    assert!(next["lines"][0]["statements"][0]["refused"].is_string(), "{next}");
    let done = served.free_text(TEXT, &by_hand(&[answer("He gets up sevenish."), answer("He gets up at 07:00.")]));
    assert_eq!((&done["prompt"], done["rounds"].as_array().unwrap().len()), (&Value::Null, 2), "{done}");
}

#[test]
fn a_text_is_cancelled_while_the_model_is_silent() {
    let mut served = Served::scenario("studio");
    let played = PlayedServer::playing([Reply::Silent]);
    let request =
        json!({ "draft": { "texts": {} }, "file": "walter.routine", "text": TEXT, "by": by_model(&played.url) });
    assert_eq!(served.post_json("/api/free-text", &request).0, 200);
    let (code, busy) = served.post_json("/api/free-text", &request);
    assert_eq!((code, &busy["code"]), (409, &"page::free-text-busy".into()));
    while played.requests().is_empty() {
        thread::sleep(Duration::from_millis(20));
    }
    assert_eq!(served.send("DELETE", "/api/free-text", b"").code, 200);
    let stopped = served.free_text_ended();
    assert_eq!((&stopped["state"], &stopped["problem"]), (&"stopped".into(), &Value::Null), "{stopped}");
    // A server that ends waits for no model.
    assert_eq!(served.post_json("/api/free-text", &request).0, 200);
    let begun = Instant::now();
    served.close();
    assert!(begun.elapsed() < Duration::from_secs(30));
}

#[test]
fn failures_are_told_and_lines_before_them_stay() {
    let served = Served::scenario("studio");
    let first = Reply::Content(answer("He gets up sevenish."));
    for (replies, code, lines) in [
        (vec![Reply::Gone], "model::unreachable", 0),
        (vec![Reply::Status(401, "{\"error\": \"no\"}".into())], "model::key", 0),
        (vec![Reply::Content("I cannot help.".into())], "free-text::nothing-usable", 0),
        (vec![first, Reply::Gone], "model::unreachable", 3),
    ] {
        let played = PlayedServer::playing(replies);
        let failed = served.free_text(TEXT, &by_model(&played.url));
        assert_eq!((&failed["state"], &failed["problem_code"]), (&"failed".into(), &code.into()), "{failed}");
        assert_eq!(failed["lines"].as_array().unwrap().len(), lines, "{failed}");
        assert!(!failed.to_string().contains(KEY), "{failed}");
    }
    for (file, text, code) in [
        ("walter.routine", "She naps after lunch. ".repeat(10_000), "free-text::too-long"),
        ("walter.routine", "...".to_owned(), "free-text::empty"),
        ("nobody.routine", TEXT.to_owned(), "desk::unused-routine"),
    ] {
        let failed = served.free_text_about(file, &text, &by_hand(&[]));
        assert_eq!((&failed["state"], &failed["problem_code"]), (&"failed".into(), &code.into()), "{failed}");
    }
}
