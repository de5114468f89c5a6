//! A server that plays the part of a model's server: it gives recorded answers, or it fails in a chosen way.

use serde_json::{Value, json};
use std::io::{BufRead, BufReader, Read, Write};
use std::net::{TcpListener, TcpStream};
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::Duration;

/// Its reply to a request for a chat.
#[derive(Clone, Debug)]
pub enum Reply {
    /// A completion with this content.
    Content(String),
    /// A status with this body.
    Status(u16, String),
    /// A redirection.
    MovedTo(String),
    /// It never answers.
    Silent,
    /// It closes the connection at once.
    Gone,
    /// It closes the connection in the middle of its answer.
    Half,
    /// It never stops.
    Endless,
}

pub struct PlayedServer {
    /// With `/v1`.
    pub url: String,
    requests: Arc<Mutex<Vec<PlayedRequest>>>,
}

/// A request for a chat.
#[derive(Clone, Debug)]
pub struct PlayedRequest {
    pub head: String,
    pub body: Value,
}

impl PlayedServer {
    /// One reply for each request; the last one again if there are more.
    pub fn playing(replies: impl IntoIterator<Item = Reply>) -> PlayedServer {
        PlayedServer::of_models(&["small"], replies)
    }

    pub fn of_models(models: &[&str], replies: impl IntoIterator<Item = Reply>) -> PlayedServer {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let url = format!("http://{}/v1", listener.local_addr().unwrap());
        let requests = Arc::new(Mutex::new(Vec::new()));
        let (noted, mut replies) = (requests.clone(), replies.into_iter().collect::<Vec<_>>().into_iter());
        let models: Vec<Value> = models.iter().map(|model| json!({ "id": model })).collect();
        let list = json!({ "data": models }).to_string();
        thread::spawn(move || {
            let mut latest = Reply::Gone;
            for stream in listener.incoming() {
                let mut stream = stream.unwrap();
                let Some(request) = request(&stream) else { continue };
                if request.head.starts_with("GET /v1/models ") {
                    answer(&mut stream, 200, &list);
                    continue;
                }
                noted.lock().unwrap().push(request);
                latest = replies.next().unwrap_or(latest);
                let reply = latest.clone();
                // A silent or endless answer holds up no other.
                thread::spawn(move || play(stream, reply));
            }
        });
        PlayedServer { url, requests }
    }

    /// The requests for chats so far.
    pub fn requests(&self) -> Vec<PlayedRequest> {
        self.requests.lock().unwrap().clone()
    }
}

impl PlayedRequest {
    /// The content of the last message.
    pub fn asks(&self) -> &str {
        self.body["messages"].as_array().and_then(|all| all.last()?["content"].as_str()).unwrap()
    }
}

fn request(stream: &TcpStream) -> Option<PlayedRequest> {
    let mut reader = BufReader::new(stream);
    let mut head = String::new();
    while !head.ends_with("\r\n\r\n") {
        if reader.read_line(&mut head).ok()? == 0 {
            return None;
        }
    }
    let length = head.lines().find_map(|line| line.to_lowercase().strip_prefix("content-length: ")?.parse().ok());
    let mut body = vec![0; length.unwrap_or(0)];
    reader.read_exact(&mut body).ok()?;
    Some(PlayedRequest { head, body: serde_json::from_slice(&body).unwrap_or_default() })
}

fn play(mut stream: TcpStream, reply: Reply) {
    match reply {
        Reply::Content(text) => {
            let message = json!({ "role": "assistant", "content": text });
            answer(&mut stream, 200, &json!({ "choices": [{ "message": message }] }).to_string());
        }
        Reply::Status(status, body) => answer(&mut stream, status, &body),
        Reply::MovedTo(to) => {
            let _ = write!(stream, "HTTP/1.1 307 Moved\r\nLocation: {to}\r\nContent-Length: 0\r\n\r\n");
        }
        Reply::Silent => thread::sleep(Duration::from_secs(600)),
        Reply::Gone => {}
        Reply::Half => {
            let _ = write!(stream, "HTTP/1.1 200 OK\r\nContent-Length: 1000\r\n\r\n{{\"choices\": [");
        }
        Reply::Endless => {
            let _ = write!(stream, "HTTP/1.1 200 OK\r\n\r\n{{\"choices\": [");
            while stream.write_all(&[b' '; 65_536]).is_ok() {}
        }
    }
}

fn answer(stream: &mut TcpStream, status: u16, body: &str) {
    let length = body.len();
    let _ = write!(stream, "HTTP/1.1 {status} Played\r\nContent-Length: {length}\r\nConnection: close\r\n\r\n{body}");
}
