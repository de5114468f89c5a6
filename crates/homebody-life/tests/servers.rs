//! Servers that are slow, gone, rude or babble: each has its message, in time, and no message has the key.

use crate::played_server::{PlayedServer, Reply};
use homebody_core::messages::Diagnose;
use homebody_life::{Conversation, FreeTextError, MOST_ANSWER_BYTES, ModelMessage, ModelServer};
use homebody_simulation::{Cancel, SimulationError, template};
use std::net::TcpListener;
use std::thread;
use std::time::{Duration, Instant};

const KEY: &str = "sk-secret-of-a-test";

const ANSWER: &str = r#"{"lines":[{"source":"She naps.","statements":["She naps at 14:00 for 30 minutes."]}]}"#;

fn asked(server: &ModelServer) -> Result<Conversation, FreeTextError> {
    let mut conversation = Conversation::new(template("studio").unwrap(), None, "She naps.").unwrap();
    conversation.converse(server, |_, _| ()).map(|()| conversation)
}

/// The error of a server that plays these replies.
fn error(replies: &[Reply]) -> ModelMessage {
    let played = PlayedServer::playing(replies.iter().cloned());
    let server = ModelServer::at(&played.url, None, Some(KEY.to_owned()), Duration::from_secs(2)).unwrap();
    let begun = Instant::now();
    let Err(FreeTextError::Model(error)) = asked(&server) else { panic!("{replies:?} gave an answer") };
    assert!(begun.elapsed() < Duration::from_secs(30), "{replies:?}");
    let message = error.diagnostic();
    assert!(message.hint.is_some(), "{message}");
    assert!(!format!("{message} {:?} {error:?}", message.data).contains(KEY), "{message}");
    error
}

#[test]
fn each_failure_has_its_message() {
    let status = |status: u16, body: &str| error(&[Reply::Status(status, body.to_owned())]);
    assert!(matches!(error(&[Reply::Silent]), ModelMessage::Slow { .. }));
    assert!(matches!(error(&[Reply::Gone]), ModelMessage::Unreachable { .. }));
    assert!(matches!(error(&[Reply::Half]), ModelMessage::Unreachable { .. }));
    assert!(matches!(error(&[Reply::Endless]), ModelMessage::Babble { most: MOST_ANSWER_BYTES, .. }));
    assert!(matches!(status(200, "<html><body>Welcome</body></html>"), ModelMessage::NotChat { .. }));
    assert!(matches!(status(200, "{\"choices\": []}"), ModelMessage::NotChat { .. }));
    assert!(matches!(status(404, "{\"error\": {\"message\": \"no such model\"}}"), ModelMessage::NotFound { .. }));
    assert!(matches!(error(&[Reply::MovedTo("http://elsewhere.example/".into())]), ModelMessage::Redirect { .. }));
    let refused = status(401, &format!("{{\"error\": {{\"message\": \"Incorrect API key provided: {KEY}\"}}}}"));
    assert!(matches!(refused, ModelMessage::Key { status: 401, is_sent: true, .. }));
    let ModelMessage::Status { status: 500, why, .. } = status(500, &format!("<h1>Oh</h1><p>{KEY} failed</p>")) else {
        panic!("a status")
    };
    assert_eq!(why, "Oh … failed");
}

#[test]
fn a_server_without_schemas_is_asked_without_one() {
    for status in [400, 422, 500] {
        let refusal = Reply::Status(status, "{\"error\": \"response_format is unknown\"}".into());
        let played = PlayedServer::playing([refusal, Reply::Content(ANSWER.into())]);
        let server = ModelServer::at(&played.url, None, None, Duration::from_secs(60)).unwrap();
        let conversation = asked(&server).unwrap();
        assert!(conversation.draft().unwrap().problems().is_empty());
        let requests = played.requests();
        assert!(requests[0].body.get("response_format").is_some());
        assert!(requests[1].body.get("response_format").is_none() && requests[1].body.get("temperature").is_none());
    }
}

#[test]
fn a_model_that_goes_in_the_middle_leaves_its_lines() {
    let first = ANSWER.replace("She naps at 14:00", "She frobs at 14:00");
    let played = PlayedServer::playing([Reply::Content(first), Reply::Gone]);
    let server = ModelServer::at(&played.url, None, None, Duration::from_secs(60)).unwrap();
    let mut conversation = Conversation::new(template("studio").unwrap(), None, "She naps.").unwrap();
    assert!(conversation.converse(&server, |_, _| ()).is_err());
    assert_eq!((conversation.rounds().len(), conversation.draft().unwrap().lines.len()), (1, 1));
}

#[test]
fn a_request_ends_when_it_is_cancelled() {
    let played = PlayedServer::playing([Reply::Silent]);
    let server = ModelServer::at(&played.url, None, None, Duration::from_secs(600)).unwrap();
    let cancel = Cancel::new();
    let mut conversation = Conversation::new(template("studio").unwrap(), None, "She naps.").unwrap();
    conversation.cancel(&cancel);
    let begun = Instant::now();
    thread::scope(|scope| {
        scope.spawn(|| {
            while played.requests().is_empty() {
                thread::sleep(Duration::from_millis(20));
            }
            cancel.cancel();
        });
        let ended = conversation.converse(&server, |_, _| ());
        assert!(matches!(ended, Err(FreeTextError::Simulation(SimulationError::Cancelled))));
    });
    assert!(begun.elapsed() < Duration::from_secs(60));
    // A simulation is cancelled, too.
    assert!(matches!(conversation.take(ANSWER), Err(SimulationError::Cancelled)));
    assert!(conversation.draft().is_err());
}

#[test]
fn a_key_goes_to_the_named_server_only() {
    let played = PlayedServer::playing([Reply::Content(ANSWER.into())]);
    let head = |key: Option<&str>| {
        let server = ModelServer::at(&played.url, None, key.map(str::to_owned), Duration::from_secs(60)).unwrap();
        assert_eq!(server.name(), format!("small at {}", played.url));
        asked(&server).unwrap();
        played.requests().pop().unwrap().head.to_lowercase()
    };
    assert!(head(Some(KEY)).contains(&format!("authorization: bearer {KEY}")));
    assert!(!head(None).contains("authorization"));
    assert!(!head(Some(" ")).contains("authorization"));
}

#[test]
fn servers_of_this_machine_are_tried_in_order() {
    let gone = TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap();
    let gone = format!("http://{gone}/v1");
    let played = PlayedServer::of_models(&["first", "second"], [Reply::Content(ANSWER.into())]);
    let of = |urls: &[&str], model: Option<&str>| ModelServer::first_of(urls, model, Duration::from_secs(60));
    let server = of(&[&gone, &played.url], None).map_err(|error| error.to_string()).unwrap();
    assert_eq!(server.name(), format!("first at {}", played.url));
    let server = of(&[&gone, &played.url], Some("second")).map_err(|error| error.to_string()).unwrap();
    asked(&server).unwrap();
    assert_eq!(played.requests()[0].body["model"], "second");
    let Err(ModelMessage::NoServer { tried }) = of(&[&gone], None) else { panic!("nobody listens") };
    assert_eq!(tried, [gone]);
}

#[test]
fn wrong_addresses_are_refused() {
    for url in ["", "here", "ftp://localhost/v1", "http://", "localhost:11434", "http://a b/v1"] {
        let server = ModelServer::at(url, Some("small"), None, Duration::from_secs(1));
        assert!(matches!(server, Err(ModelMessage::BadUrl { .. })), "{url:?}");
    }
}
