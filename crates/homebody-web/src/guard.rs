//! Access to the server.
//!
//! Any page in the browser, and any program on the same machine, can reach a server on loopback. So a request needs a host name of
//! this machine, because a foreign page can make its own name mean this machine. It must come from the own page: a foreign page can
//! send requests, but cannot hide its origin. Below `/api/` it also needs the token that the server printed at its start. The token
//! comes in a header or, over the socket, in the first message; never in an address, because addresses are logged and stored.

use crate::client::ClientConnection;
use crate::messages::PageMessage;
use crate::request_error::RequestError;
use axum::Extension;
use axum::extract::{Request, State};
use axum::http::{HeaderMap, HeaderName, HeaderValue, StatusCode, Uri, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use std::collections::HashMap;
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;
use subtle::ConstantTimeEq;
use tokio::sync::watch;

pub const TOKEN: HeaderName = HeaderName::from_static("x-homebody-token");

/// In hexadecimal, the token has twice as many digits.
pub const TOKEN_BYTES: usize = 32;

pub const SOCKET: &str = "/api/live";

/// The prefix for homes of a library; the rest is as below `/api/` of a server of that home alone.
pub const HOMES: &str = "/api/homes/";

/// The scripts, images and connections of the page: its own.
const POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; \
    connect-src 'self'; font-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// Delay of the answer to a wrong token (our choice).
const DELAY: Duration = Duration::from_millis(100);

#[derive(Clone, Debug)]
pub struct Guard {
    /// The valid host names, each with its port.
    hosts: Vec<String>,
    token: String,
    /// By the client's address: held while a wrong token of that address is being answered.
    wrong: Arc<Mutex<HashMap<IpAddr, Turn>>>,
    /// True once a client has sent the token.
    has_entered: watch::Sender<bool>,
}

type Turn = Arc<tokio::sync::Mutex<()>>;

impl Guard {
    /// With this token, or with a new one of 256 bits.
    pub fn new(address: SocketAddr, token: Option<String>) -> Result<Guard, getrandom::Error> {
        let token = token.map_or_else(fresh_token, Ok)?;
        let has_entered = watch::Sender::new(false);
        Ok(Guard { hosts: hosts(address), token, wrong: Arc::default(), has_entered })
    }

    pub fn token(&self) -> &str {
        &self.token
    }

    /// Compares a token in constant time. If it is right, the connection counts as known.
    pub fn knows(&self, token: &str, client: &ClientConnection) -> bool {
        let is_known = token.as_bytes().ct_eq(self.token.as_bytes()).into();
        if is_known {
            client.mark_known();
            self.has_entered.send_if_modified(|entered| !std::mem::replace(entered, true));
        }
        is_known
    }

    pub async fn entered(&self) {
        // The sender exists as long as this.
        let _ = self.has_entered.subscribe().wait_for(|entered| *entered).await;
    }

    /// Delays the answer to a wrong token, one after the other for each address, so that a client has ten guesses a second. Other
    /// addresses and clients with the token do not wait.
    pub async fn delay(&self, from: IpAddr) {
        let turn = {
            let mut wrong = self.wrong.lock().unwrap_or_else(PoisonError::into_inner);
            wrong.retain(|_, turn| Arc::strong_count(turn) > 1);
            wrong.entry(place_of(from)).or_default().clone()
        };
        let _turn = turn.lock().await;
        tokio::time::sleep(DELAY).await;
    }

    /// Whether the request has a valid host name: exactly one `Host`, and the same in an absolute address.
    fn is_for_us(&self, headers: &HeaderMap, uri: &Uri) -> bool {
        let mut named = headers.get_all(header::HOST).iter();
        let (Some(host), None) = (named.next(), named.next()) else { return false };
        let is_ours = |host: &str| self.hosts.iter().any(|ours| ours.eq_ignore_ascii_case(host));
        host.to_str().is_ok_and(is_ours) && uri.authority().is_none_or(|authority| is_ours(authority.as_str()))
    }

    /// Whether the request comes from the own page. A browser may omit `Origin` for requests of the own page, never for those of another.
    /// Programs other than browsers need the token.
    fn is_from_us(&self, headers: &HeaderMap) -> bool {
        let mut named = headers.get_all(header::ORIGIN).iter();
        match (named.next(), named.next()) {
            (None, _) => true,
            (Some(origin), None) => {
                let host = origin.to_str().ok().and_then(|origin| origin.strip_prefix("http://"));
                host.is_some_and(|host| self.hosts.iter().any(|ours| ours == host))
            }
            _ => false,
        }
    }

    /// Whether a socket comes from the own page: browsers always send its origin.
    pub fn is_socket_from_us(&self, headers: &HeaderMap) -> bool {
        headers.contains_key(header::ORIGIN) && self.is_from_us(headers)
    }
}

/// Whether a path is the socket of the scenario or of a home.
fn is_socket(path: &str) -> bool {
    let of_home = path.strip_prefix(HOMES).and_then(|rest| rest.split_once('/'));
    path == SOCKET || of_home.is_some_and(|(_, rest)| rest == "live")
}

fn fresh_token() -> Result<String, getrandom::Error> {
    let mut bytes = [0; TOKEN_BYTES];
    getrandom::fill(&mut bytes)?;
    Ok(bytes.iter().map(|byte| format!("{byte:02x}")).collect())
}

/// The address of a client; for IPv6 its network, because a client has all addresses of a network.
fn place_of(from: IpAddr) -> IpAddr {
    match from {
        IpAddr::V6(ip) if !ip.is_loopback() => Ipv6Addr::from_bits(ip.to_bits() >> 64 << 64).into(),
        ip => ip,
    }
}

/// The host names of a server at an address. Loopback has three.
fn hosts(address: SocketAddr) -> Vec<String> {
    let port = address.port();
    let named = |name: &str| if port == 80 { name.to_owned() } else { format!("{name}:{port}") };
    match address.ip() {
        IpAddr::V4(Ipv4Addr::LOCALHOST) | IpAddr::V6(Ipv6Addr::LOCALHOST) => {
            ["127.0.0.1", "localhost", "[::1]"].map(named).to_vec()
        }
        IpAddr::V4(ip) => vec![named(&ip.to_string())],
        IpAddr::V6(ip) => vec![named(&format!("[{ip}]"))],
    }
}

/// Checks a request, and adds strict policies to each answer.
pub async fn watch(
    State(guard): State<Guard>,
    Extension(client): Extension<ClientConnection>,
    request: Request,
    next: Next,
) -> Response {
    let (headers, path) = (request.headers(), request.uri().path());
    let has_token = || {
        let given = headers.get(TOKEN).and_then(|token| token.to_str().ok());
        given.is_some_and(|token| guard.knows(token, &client))
    };
    // The token of a socket comes in its first message.
    let is_open = !path.starts_with("/api/") || is_socket(path);
    let mut response = if !guard.is_for_us(headers, request.uri()) {
        RequestError::new(StatusCode::FORBIDDEN, PageMessage::ForeignHost).into_response()
    } else if !guard.is_from_us(headers) {
        RequestError::new(StatusCode::FORBIDDEN, PageMessage::ForeignPage).into_response()
    } else if !is_open && !has_token() {
        guard.delay(client.from()).await;
        RequestError::new(StatusCode::UNAUTHORIZED, PageMessage::Token).into_response()
    } else {
        next.run(request).await
    };
    let strict = [
        (header::CONTENT_SECURITY_POLICY, POLICY),
        (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
        (header::REFERRER_POLICY, "no-referrer"),
        (HeaderName::from_static("cross-origin-opener-policy"), "same-origin"),
        (HeaderName::from_static("cross-origin-resource-policy"), "same-origin"),
    ];
    for (name, value) in strict {
        response.headers_mut().insert(name, HeaderValue::from_static(value));
    }
    response
}
