//! Who may ask anything at all.
//!
//! A server on loopback can be reached by any page that the browser shows, and by anybody on the same machine. So a request is
//! only heard under a name of this machine (a foreign page can make its own name mean this machine), only from the page itself
//! (a foreign page can send requests, but not lie about whence), and, below `/api/`, only with the token that was printed when the
//! server began. The token comes in a header or, over the socket, in the first message: never in an address, which is logged and
//! kept.

use crate::answers::Refused;
use crate::messages::PageMessage;
use crate::visit::Visit;
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

/// The header that the token comes in.
pub const TOKEN: HeaderName = HeaderName::from_static("x-homebody-token");

/// How long a token is: twice as many digits.
pub const TOKEN_BYTES: usize = 32;

/// Where pages say what they want, and see what there is.
pub const SOCKET: &str = "/api/live";

/// Below this each home of a library has what a server of it alone has below `/api/`.
pub const HOMES: &str = "/api/homes/";

/// What scripts, pictures and connections the page may have: its own.
const POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; \
    connect-src 'self'; font-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// Delay of the answer to a wrong token (our choice).
const DELAY: Duration = Duration::from_millis(100);

/// What a server lets through.
#[derive(Clone, Debug)]
pub struct Guard {
    /// The names under which it may be asked, each with its port.
    hosts: Vec<String>,
    token: String,
    /// By where they come from: held by the one whose wrong token is being answered.
    wrong: Arc<Mutex<HashMap<IpAddr, Turn>>>,
    /// Whether somebody has come with the token.
    has_entered: watch::Sender<bool>,
}

type Turn = Arc<tokio::sync::Mutex<()>>;

impl Guard {
    /// A guard with this token, or with a new one of 256 bits.
    pub fn new(address: SocketAddr, token: Option<String>) -> Result<Guard, getrandom::Error> {
        let token = token.map_or_else(fresh_token, Ok)?;
        let has_entered = watch::Sender::new(false);
        Ok(Guard { hosts: hosts(address), token, wrong: Arc::default(), has_entered })
    }

    pub fn token(&self) -> &str {
        &self.token
    }

    /// Whether this is the token; how long that takes says nothing about it. If it is, the visit counts as known from then on.
    pub fn knows(&self, token: &str, visit: &Visit) -> bool {
        let is_known = token.as_bytes().ct_eq(self.token.as_bytes()).into();
        if is_known {
            visit.mark_known();
            self.has_entered.send_if_modified(|entered| !std::mem::replace(entered, true));
        }
        is_known
    }

    /// Comes back when somebody has come with the token.
    pub async fn entered(&self) {
        // The sender lives as long as this.
        let _ = self.has_entered.subscribe().wait_for(|entered| *entered).await;
    }

    /// Takes its time with a token that is wrong, one after the other of those from the same place: who guesses has ten guesses a
    /// second. Who comes from elsewhere does not wait for them, and who knows the token for nobody.
    pub async fn delay(&self, from: IpAddr) {
        let turn = {
            let mut wrong = self.wrong.lock().unwrap_or_else(PoisonError::into_inner);
            wrong.retain(|_, turn| Arc::strong_count(turn) > 1);
            wrong.entry(place_of(from)).or_default().clone()
        };
        let _turn = turn.lock().await;
        tokio::time::sleep(DELAY).await;
    }

    /// Whether the request comes under one of our names: exactly one `Host`, and the same in a whole address.
    fn is_for_us(&self, headers: &HeaderMap, uri: &Uri) -> bool {
        let mut named = headers.get_all(header::HOST).iter();
        let (Some(host), None) = (named.next(), named.next()) else { return false };
        let is_ours = |host: &str| self.hosts.iter().any(|ours| ours.eq_ignore_ascii_case(host));
        host.to_str().is_ok_and(is_ours) && uri.authority().is_none_or(|authority| is_ours(authority.as_str()))
    }

    /// Whether the request comes from our own page. A browser leaves `Origin` out of what a page of ours fetches plainly,
    /// never of what another page sends; what is no browser needs the token, which no page of others has.
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

    /// Whether a socket comes from our own page: its browser always says whence.
    pub fn is_socket_from_us(&self, headers: &HeaderMap) -> bool {
        headers.contains_key(header::ORIGIN) && self.is_from_us(headers)
    }
}

/// Whether a path is that of the socket of the scenario, or of some home.
fn is_socket(path: &str) -> bool {
    let of_home = path.strip_prefix(HOMES).and_then(|rest| rest.split_once('/'));
    path == SOCKET || of_home.is_some_and(|(_, rest)| rest == "live")
}

fn fresh_token() -> Result<String, getrandom::Error> {
    let mut bytes = [0; TOKEN_BYTES];
    getrandom::fill(&mut bytes)?;
    Ok(bytes.iter().map(|byte| format!("{byte:02x}")).collect())
}

/// Where somebody comes from. Of an IPv6 address it is the network: whoever has one address has all of its network.
fn place_of(from: IpAddr) -> IpAddr {
    match from {
        IpAddr::V6(ip) if !ip.is_loopback() => Ipv6Addr::from_bits(ip.to_bits() >> 64 << 64).into(),
        ip => ip,
    }
}

/// The names of a server at an address. The address that `localhost` stands for has three.
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

/// Lets a request through, or says why not; whatever the answer is, it tells the browser to be strict.
pub async fn watch(
    State(guard): State<Guard>,
    Extension(visit): Extension<Visit>,
    request: Request,
    next: Next,
) -> Response {
    let (headers, path) = (request.headers(), request.uri().path());
    let has_token = || {
        let given = headers.get(TOKEN).and_then(|token| token.to_str().ok());
        given.is_some_and(|token| guard.knows(token, &visit))
    };
    // The socket's token comes in its first message.
    let is_open = !path.starts_with("/api/") || is_socket(path);
    let mut response = if !guard.is_for_us(headers, request.uri()) {
        Refused::of(StatusCode::FORBIDDEN, PageMessage::ForeignHost).into_response()
    } else if !guard.is_from_us(headers) {
        Refused::of(StatusCode::FORBIDDEN, PageMessage::ForeignPage).into_response()
    } else if !is_open && !has_token() {
        guard.delay(visit.from()).await;
        Refused::of(StatusCode::UNAUTHORIZED, PageMessage::Token).into_response()
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
