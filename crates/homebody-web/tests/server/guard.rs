//! Requests that the server accepts, and those that it refuses.

use super::served::Served;
use std::fs;
use std::net::{IpAddr, TcpListener};
use tungstenite::client::IntoClientRequest;

const SECRET: &str = "nobody outside shall read this";

/// Routes of every kind.
const ROUTES: [&str; 7] =
    ["/", "/favicon.svg", "/api/files", "/api/runs", "/api/runs/a/log", "/api/live", "/api/nothing"];

#[test]
fn rejects_other_host_names_on_every_route() {
    let served = Served::scenario("by-hand");
    let port = served.address.port();
    let mut names: Vec<String> = ["127.0.0.1", "localhost", "LOCALHOST", "[::1]"]
        .iter()
        .flat_map(|name| {
            [(*name).to_owned(), format!("{name}:1"), format!("{name}:{port}0"), format!("{name}.:{port}")]
        })
        .collect();
    for foreign in
        ["evil.com", "127.0.0.1.nip.io", "localhost.evil.com", "evil.com#localhost", "0.0.0.0", "127.1", "[::]"]
    {
        for shape in
            ["{}", "{}:PORT", "a.{}:PORT", "{}.:PORT", " {}:PORT x", "localhost@{}:PORT", "{}:PORT,localhost:PORT"]
        {
            names.push(shape.replace("{}", foreign).replace("PORT", &port.to_string()));
        }
    }
    names.retain(|name| !is_ours(name, port));
    let mut asked = 0;
    for name in &names {
        for route in ROUTES {
            let head = format!("Host: {name}\r\nx-homebody-token: {}\r\nConnection: close\r\n", served.token);
            let answer = served.ask(format!("GET {route} HTTP/1.1\r\n{head}\r\n").as_bytes());
            // An invalid host name is refused even earlier.
            assert!(matches!(answer.code, 400 | 403), "{name:?} may ask for {route}: {}", answer.head);
            asked += 1;
        }
    }
    assert!(asked >= 200, "{asked}");
    let two = format!("GET / HTTP/1.1\r\nHost: localhost:{port}\r\nHost: evil.com\r\nConnection: close\r\n\r\n");
    let none = "GET / HTTP/1.1\r\nConnection: close\r\n\r\n".to_owned();
    let whole = format!("GET http://evil.com/ HTTP/1.1\r\nHost: localhost:{port}\r\nConnection: close\r\n\r\n");
    for request in [two, none, whole] {
        let answer = served.ask(request.as_bytes());
        assert!(matches!(answer.code, 400 | 403), "{request:?}: {}", answer.head);
    }
    for name in ["127.0.0.1", "localhost", "LocalHost", "[::1]"] {
        let answer =
            served.ask(format!("GET / HTTP/1.1\r\nHost: {name}:{port}\r\nConnection: close\r\n\r\n").as_bytes());
        assert_eq!(answer.code, 200, "{name}");
    }
}

/// A server answers under its own address only.
#[test]
fn accepts_only_its_own_host_names() {
    for (ip, name) in [("127.0.0.2", "127.0.0.2"), ("::ffff:127.0.0.3", "127.0.0.3"), ("::ffff:127.0.0.1", "localhost")]
    {
        let ip: IpAddr = ip.parse().unwrap();
        // Linux has all addresses that begin with 127; other systems have the first only.
        if !cfg!(target_os = "linux") && TcpListener::bind((ip, 0)).is_err() {
            continue;
        }
        let served = Served::at("by-hand", ip);
        let port = served.address.port();
        assert_eq!(served.get("/", "").code, 200, "{ip}");
        assert_eq!(served.api("/api/runs").code, 200, "{ip}");
        served.page().until(|_| true);
        let asked = |name: &str| {
            served.ask(format!("GET / HTTP/1.1\r\nHost: {name}:{port}\r\nConnection: close\r\n\r\n").as_bytes()).code
        };
        assert_eq!(asked(name), 200, "{name}");
        assert_eq!(asked("127.0.0.4"), 403);
        if name != "localhost" {
            assert_eq!(asked("localhost"), 403, "that is another address than {ip}");
        }
    }
}

fn is_ours(name: &str, port: u16) -> bool {
    ["127.0.0.1", "localhost", "[::1]"].iter().any(|ours| name.eq_ignore_ascii_case(&format!("{ours}:{port}")))
}

/// Origins of other pages.
fn foreign_origins(port: u16) -> Vec<String> {
    let hosts =
        ["evil.com", "localhost.evil.com", "127.0.0.1.nip.io", "evil.com:8642", "0.0.0.0", "127.0.0.1@evil.com", "a"];
    let shapes = [
        "http://{}",
        "https://{}",
        "http://{}:PORT",
        "http://{}:PORT/",
        "ws://{}:PORT",
        "http://localhost:PORT.{}",
        "file://{}",
        "{}",
        "http://{}:PORT http://localhost:PORT",
    ];
    let mut origins: Vec<String> =
        hosts.iter().flat_map(|host| shapes.map(|shape| shape.replace("{}", host))).collect();
    for ours in ["localhost", "127.0.0.1", "[::1]"] {
        for shape in [
            "https://{}:PORT",
            "http://{}",
            "http://{}:1",
            "http://{}:PORT0",
            "http://{}:PORT/",
            "HTTP://{}:PORT",
            "http:{}:PORT",
            "http://x@{}:PORT",
            "http://{}:PORT\t",
            "chrome-extension://{}:PORT",
            "//{}:PORT",
            "{}:PORT",
        ] {
            origins.push(shape.replace("{}", ours));
        }
    }
    origins.push("null".into());
    origins.push(String::new());
    origins.iter().map(|origin| origin.replace("PORT", &port.to_string())).collect()
}

#[test]
fn rejects_other_pages_even_with_the_token() {
    let served = Served::scenario("by-hand");
    let origins = foreign_origins(served.address.port());
    assert!(origins.len() >= 100, "{}", origins.len());
    for origin in &origins {
        let more = format!("Origin: {origin}\r\nx-homebody-token: {}\r\n", served.token);
        // Spaces around a value do not count.
        let is_ours = origin.trim().strip_prefix("http://").is_some_and(|host| is_ours(host, served.address.port()));
        let answer = served.get("/api/runs", &more);
        assert_eq!(answer.code, if is_ours { 200 } else { 403 }, "{origin:?} may ask: {}", answer.head);
        let mut request = format!("ws://{}/api/live", served.address).into_client_request().unwrap();
        let Ok(value) = origin.parse() else { continue };
        request.headers_mut().insert("origin", value);
        let stream = std::net::TcpStream::connect(served.address).unwrap();
        assert_eq!(tungstenite::client(request, stream).is_ok(), is_ours, "{origin:?} has a socket");
    }
    let request = format!("ws://{}/api/live", served.address).into_client_request().unwrap();
    let stream = std::net::TcpStream::connect(served.address).unwrap();
    assert!(tungstenite::client(request, stream).is_err(), "a socket from nowhere");
}

#[test]
fn answers_nothing_without_the_token() {
    let served = Served::scenario("by-hand");
    let wrong = "0".repeat(64);
    let short = &served.token[..63];
    for token in [None, Some(""), Some(&wrong[..]), Some(short), Some(&format!("{}0", served.token))] {
        let more = token.map(|token| format!("x-homebody-token: {token}\r\n")).unwrap_or_default();
        for route in ["/api/runs", "/api/runs/a/log", "/api/nothing"] {
            assert_eq!(served.get(route, &more).code, 401, "{token:?} opens {route}");
        }
    }
    assert_eq!(served.get(&format!("/api/runs?x-homebody-token={}", served.token), "").code, 401);
    assert_eq!(served.api("/api/runs").code, 200);
    for hello in [
        r#"{"say":"hello","token":""}"#,
        r#"{"say":"play"}"#,
        "",
        "{",
        &format!(r#"{{"say":"hello","token":"{wrong}"}}"#),
    ] {
        let mut socket = served.socket();
        socket.send(tungstenite::Message::Text(hello.into())).unwrap();
        let tungstenite::Message::Close(Some(frame)) = socket.read().unwrap() else { panic!("{hello} is heard") };
        assert_eq!(u16::from(frame.code), 4401, "{hello}");
    }
}

#[test]
fn follows_no_path_out_of_the_page() {
    let served = Served::scenario("by-hand");
    let root = served.folder.path();
    fs::write(root.join("secret.txt"), SECRET).unwrap();
    fs::create_dir_all(root.join("runs/one/inner")).unwrap();
    for file in ["runs/one/recording.json", "runs/one/inner/log.db", "runs/recording.json", "runs/log.db"] {
        fs::write(root.join(file), SECRET).unwrap();
    }
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink(root.join("secret.txt"), root.join("runs/one/log.db")).unwrap();
        std::os::unix::fs::symlink(root, root.join("runs/two")).unwrap();
    }
    fs::remove_file(root.join("runs/one/recording.json")).unwrap();
    fs::write(root.join("runs/one/recording.json"), "{}").unwrap();
    let up = [
        "..",
        "%2e%2e",
        "..%2f..",
        "%2e%2e%2f%2e%2e",
        "..%5c..",
        "....//",
        ".%00.",
        "%252e%252e",
        "..;",
        "%c0%ae%c0%ae",
    ];
    let ends =
        ["secret.txt", "etc/passwd", "proc/self/environ", "scenario.json", "log", "recording", "inner/log.db", ""];
    let starts = ["/", "/api/runs/", "/api/runs/one/", "/assets/", "/api/runs/two/", "//", "/C:/"];
    let mut asked = 0;
    for start in starts {
        for up in up {
            for end in ends {
                let path = format!("{start}{up}/{end}");
                let answer = served.api(&path);
                let body = String::from_utf8_lossy(&answer.body).into_owned();
                assert!(!body.contains(SECRET) && !body.contains("root:"), "{path} is read: {}", answer.head);
                assert!(matches!(answer.code, 400 | 404), "{path}: {}", answer.head);
                asked += 1;
            }
        }
    }
    assert!(asked >= 500, "{asked}");
    for path in ["/api/runs/one/log", "/api/runs/two/log", "/api/runs/./log", "/api/runs/one/inner"] {
        assert_eq!(served.api(path).code, 404, "{path}");
    }
    assert_eq!(served.api("/api/runs/one/recording").code, 200);
}

#[test]
fn sends_strict_policies_and_rejects_large_requests() {
    let served = Served::scenario("by-hand");
    for route in ROUTES {
        for head in [served.api(route).head, served.get(route, "Origin: http://evil.com\r\n").head] {
            let head = head.to_lowercase();
            for line in
                ["content-security-policy: default-src 'none'", "x-content-type-options: nosniff", "referrer-policy"]
            {
                assert!(head.contains(line), "{route} lacks {line}: {head}");
            }
            assert!(!head.contains("access-control-allow-origin") && !head.contains("unsafe"), "{route}: {head}");
        }
    }
    let mut page = served.page();
    page.hear();
    let long = format!(r#"{{"say":"hold","keys":["{}"]}}"#, "x".repeat(100_000));
    let _ = page.socket.send(tungstenite::Message::Text(long.into()));
    let end = std::iter::from_fn(|| Some(page.socket.read())).take(1000).find(Result::is_err);
    assert!(end.is_some(), "a message of 100 kB is heard");
}
