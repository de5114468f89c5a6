//! A server of the program, as a page and other clients see it.

use homebody_web::server::SOCKET;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::process::Child;
use std::time::Duration;
use tungstenite::client::IntoClientRequest;
use tungstenite::{Message, WebSocket};

/// The answer of a server to GET, with its head.
pub fn get(address: &str, host: &str, path: &str, head: &str) -> String {
    let mut stream = TcpStream::connect(address).unwrap();
    write!(stream, "GET {path} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n{head}\r\n").unwrap();
    let mut answer = String::new();
    stream.read_to_string(&mut answer).unwrap();
    answer
}

/// The address and the token that a started server prints.
pub fn address_of(server: &mut Child) -> (String, String) {
    let mut said = String::new();
    BufReader::new(server.stdout.take().unwrap()).read_line(&mut said).unwrap();
    let (address, token) = said.trim().strip_prefix("http://").unwrap().split_once("/#token=").unwrap();
    (address.to_owned(), token.to_owned())
}

/// The socket of the page of a server, with the page's first words.
pub fn page_of(address: &str, token: &str) -> WebSocket<TcpStream> {
    let mut request = format!("ws://{address}{SOCKET}").into_client_request().unwrap();
    request.headers_mut().insert("origin", format!("http://{address}").parse().unwrap());
    let stream = TcpStream::connect(address).unwrap();
    stream.set_read_timeout(Some(Duration::from_secs(60))).unwrap();
    let mut page = tungstenite::client(request, stream).unwrap().0;
    page.send(Message::Text(format!(r#"{{"say":"hello","token":"{token}"}}"#).into())).unwrap();
    page
}
