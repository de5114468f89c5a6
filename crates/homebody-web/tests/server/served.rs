//! A server with a scenario, and clients of it: browsers and others.

use homebody_scaffold::{create, from_template, write};
use homebody_simulation::{Cancel, Template};
use homebody_web::folders::HomeFolders;
use homebody_web::library::Library;
use homebody_web::server::SOCKET;
use homebody_web::{Options, serve};
use std::fs;
use std::io::{Read, Write};
use std::net::{IpAddr, Ipv4Addr, SocketAddr, TcpStream};
use std::path::PathBuf;
use std::sync::mpsc::channel;
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};
use tempfile::TempDir;
use tungstenite::client::IntoClientRequest;
use tungstenite::{Message, WebSocket};

/// Dropping it ends the server, with complete files.
pub struct Served {
    pub folder: TempDir,
    pub address: SocketAddr,
    pub token: String,
    cancel: Cancel,
    thread: Option<JoinHandle<()>>,
}

/// An answer of the server.
#[derive(Debug)]
pub struct Answer {
    pub code: u16,
    pub head: String,
    pub body: Vec<u8>,
}

impl Answer {
    /// The code, the sentences and the data of a refusal.
    pub fn refusal(&self) -> serde_json::Value {
        serde_json::from_slice(&self.body).unwrap_or_default()
    }
}

pub type Socket = WebSocket<TcpStream>;

/// The longest wait for a frame, enough for a busy machine.
pub const LONGEST_WAIT: Duration = Duration::from_secs(300);

impl Served {
    /// Serves a copy of a scenario of the repository.
    pub fn scenario(name: &str) -> Served {
        Served::at(name, Ipv4Addr::LOCALHOST.into())
    }

    /// The same at another address of this machine.
    pub fn at(name: &str, ip: IpAddr) -> Served {
        let folder = tempfile::tempdir().unwrap();
        let scenario = folder.path().join(name);
        fs::create_dir(&scenario).unwrap();
        for (file, text) in Template::named(name).unwrap().files() {
            fs::write(scenario.join(file), text).unwrap();
        }
        let shelf = HomeFolders {
            scenario,
            entry: "scenario.json".into(),
            is_trusted: false,
            runs: folder.path().join("runs"),
        };
        Served::of(folder, Options { ip, port: Some(0), ..Options::new(shelf) })
    }

    /// Serves a folder of homes from templates.
    pub fn library(templates: &[&str]) -> Served {
        let folder = tempfile::tempdir().unwrap();
        for name in templates {
            create(&folder.path().join(name), |part, _| {
                write(part, &from_template(Template::named(name).unwrap(), name))
            })
            .unwrap();
        }
        let library = Library::new(folder.path().to_owned(), false);
        Served::of(folder, Options { port: Some(0), ..Options::new(library) })
    }

    /// Serves a folder.
    pub fn of(folder: TempDir, options: Options) -> Served {
        let cancel = Cancel::new();
        let (ready, is_ready) = channel();
        let handle = cancel.clone();
        let thread = thread::spawn(move || {
            serve(options, &handle, |address| ready.send(address.url.to_owned()).unwrap()).unwrap();
        });
        let address = is_ready.recv_timeout(Duration::from_secs(60)).expect("a server");
        let (place, token) = address.strip_prefix("http://").unwrap().split_once("#token=").unwrap();
        let (address, token) = (place.split('/').next().unwrap().parse().unwrap(), token.to_owned());
        Served { folder, address, token, cancel, thread: Some(thread) }
    }

    /// Ends the server, as Ctrl-C does.
    pub fn close(&mut self) {
        self.cancel.cancel();
        if let Some(thread) = self.thread.take() {
            thread.join().unwrap();
        }
    }

    /// Sends exactly these bytes, and reads the answer.
    pub fn ask(&self, request: &[u8]) -> Answer {
        let mut stream = TcpStream::connect(self.address).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(20))).unwrap();
        // A server that refuses a request may close before all is sent.
        let _ = stream.write_all(request);
        let mut answer = Vec::new();
        let _ = stream.read_to_end(&mut answer);
        let end = answer.windows(4).position(|bytes| bytes == b"\r\n\r\n").unwrap_or(answer.len());
        let head = String::from_utf8_lossy(&answer[..end]).into_owned();
        let code = head.split(' ').nth(1).and_then(|code| code.parse().ok()).unwrap_or(0);
        Answer { code, head, body: answer.get(end + 4..).unwrap_or_default().to_vec() }
    }

    /// Requests a path as the own page does, with further headers.
    pub fn get(&self, path: &str, more: &str) -> Answer {
        let address = self.address;
        self.ask(format!("GET {path} HTTP/1.1\r\nHost: {address}\r\nConnection: close\r\n{more}\r\n").as_bytes())
    }

    /// A GET below `/api/` with the token.
    pub fn api(&self, path: &str) -> Answer {
        self.get(path, &format!("x-homebody-token: {}\r\n", self.token))
    }

    /// JSON below `/api/` with the token.
    pub fn post(&self, path: &str, body: &serde_json::Value) -> Answer {
        self.send("POST", path, body.to_string().as_bytes())
    }

    /// A body below `/api/` with the token.
    pub fn send(&self, method: &str, path: &str, body: &[u8]) -> Answer {
        let (address, token, length) = (self.address, &self.token, body.len());
        let head = format!(
            "{method} {path} HTTP/1.1\r\nHost: {address}\r\nConnection: close\r\nx-homebody-token: {token}\r\n\
             Content-Type: application/json\r\nContent-Length: {length}\r\n\r\n"
        );
        self.ask(&[head.as_bytes(), body].concat())
    }

    /// A socket of the own page before its first message.
    pub fn socket(&self) -> Socket {
        self.socket_at(SOCKET)
    }

    /// The same of the page of a home.
    pub fn socket_at(&self, path: &str) -> Socket {
        let mut request = format!("ws://{}{path}", self.address).into_client_request().unwrap();
        request.headers_mut().insert("origin", format!("http://{}", self.address).parse().unwrap());
        let stream = TcpStream::connect(self.address).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(30))).unwrap();
        tungstenite::client(request, stream).unwrap().0
    }

    /// A page that has sent the token.
    pub fn page(&self) -> Page {
        self.page_at(SOCKET)
    }

    /// The same of a home.
    pub fn page_at(&self, path: &str) -> Page {
        let mut page = Page { socket: self.socket_at(path) };
        page.say(&format!(r#"{{"say":"hello","token":"{}"}}"#, self.token));
        page
    }

    /// The folder of the only run.
    pub fn only_run(&self) -> PathBuf {
        let runs: Vec<PathBuf> =
            fs::read_dir(self.folder.path().join("runs")).unwrap().map(|entry| entry.unwrap().path()).collect();
        let [run] = &runs[..] else { panic!("{runs:?}") };
        run.clone()
    }
}

impl Drop for Served {
    fn drop(&mut self) {
        self.close();
    }
}

/// The page's side of a socket.
pub struct Page {
    pub socket: Socket,
}

/// A message to the page.
#[derive(Debug)]
pub enum Heard {
    Frame(serde_json::Value),
    Tell(serde_json::Value),
}

impl Page {
    pub fn say(&mut self, say: &str) {
        self.socket.send(Message::Text(say.into())).unwrap();
    }

    pub fn hear(&mut self) -> Heard {
        loop {
            match self.socket.read().unwrap() {
                Message::Text(text) => return Heard::Tell(serde_json::from_str(&text).unwrap()),
                Message::Binary(bytes) => return Heard::Frame(rmp_serde::from_slice(&bytes).unwrap()),
                _ => {}
            }
        }
    }

    /// Reads until a frame fits, and returns it with all rows and notes before it. A running run does not repeat a frame, so the wait
    /// is limited.
    pub fn until(&mut self, is_wished: impl Fn(&serde_json::Value) -> bool) -> Seen {
        let begun = Instant::now();
        let mut seen = Seen::default();
        loop {
            assert!(begun.elapsed() < LONGEST_WAIT, "no such frame has come; last it was {}", seen.frame);
            match self.hear() {
                Heard::Tell(tell) if tell["tell"] == "note" => seen.notes.push(tell["text"].as_str().unwrap().into()),
                Heard::Tell(tell) => seen.run = tell["run"].clone(),
                Heard::Frame(frame) => {
                    seen.rows.extend(frame["firings"].as_array().unwrap().iter().map(|row| row["row"].clone()));
                    seen.frame = frame;
                    if is_wished(&seen.frame) {
                        return seen;
                    }
                }
            }
        }
    }
}

impl Page {
    /// Reads until a note holds the text, and returns everything before it and the frame after it.
    pub fn until_told(&mut self, text: &str) -> Seen {
        let begun = Instant::now();
        let mut seen = Seen::default();
        while !seen.notes.iter().any(|note| note.contains(text)) {
            assert!(begun.elapsed() < LONGEST_WAIT, "no note holds {text:?}: {:?}", seen.notes);
            let next = self.until(|_| true);
            seen.rows.extend(next.rows);
            seen.notes.extend(next.notes);
            seen.frame = next.frame;
        }
        seen
    }
}

/// The messages to a page.
#[derive(Debug, Default)]
pub struct Seen {
    pub frame: serde_json::Value,
    pub run: serde_json::Value,
    pub rows: Vec<serde_json::Value>,
    pub notes: Vec<String>,
}
