//! The server: its address, its routes and its limits.

use crate::address_file::{self, AddressFileError};
use crate::browser_file::BrowserFile;
use crate::client::LONGEST_UNTAKEN;
use crate::connections;
use crate::folders::HomeFolders;
use crate::guard::{self, Guard};
use crate::library::Library;
use crate::open_home::OpenHome;
use crate::open_homes::OpenHomes;
use crate::page::FIRST_PAGE;
use axum::Router;
use axum::http::{Extensions, HeaderMap, StatusCode, Version, header};
use homebody_core::problem::Diagnostic;
use homebody_simulation::Cancel;
use std::io::{self, ErrorKind};
use std::net::{IpAddr, Ipv4Addr, SocketAddr};
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;
use tokio::net::{TcpListener, TcpSocket};
use tokio::sync::Semaphore;
use tower_http::compression::CompressionLayer;
use tower_http::compression::predicate::{Predicate, SizeAbove};
use tower_http::timeout::RequestBodyTimeoutLayer;

pub use crate::guard::SOCKET;

/// Largest number of connected pages (our choice).
const MOST_PAGES: usize = 32;

#[derive(Clone, Debug)]
pub enum Offer {
    Scenario(HomeFolders),
    /// A folder of homes, with a first page that lists them.
    Library(Library),
}

impl From<HomeFolders> for Offer {
    fn from(folders: HomeFolders) -> Offer {
        Offer::Scenario(folders)
    }
}

impl From<Library> for Offer {
    fn from(library: Library) -> Offer {
        Offer::Library(library)
    }
}

#[derive(Clone, Debug)]
pub struct Options {
    pub offer: Offer,
    /// Loopback, unless other machines may connect.
    pub ip: IpAddr,
    /// The first free port from [`FIRST_PORT`] on if `None`.
    pub port: Option<u16>,
    /// Whether a browser will open the page: then there is a file for it.
    pub browser: bool,
    /// A file that keeps port and token for the next server.
    pub kept: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug)]
pub struct PageAddress<'a> {
    /// For its user only: it has the token after a `#`, which browsers do not send to servers.
    pub url: &'a str,
    /// For a browser: a private file that leads to the page. It is removed once a client has sent the token, and after a minute.
    /// `None` without a browser, or if no file could be written.
    pub file: Option<&'a std::path::Path>,
}

pub const FIRST_PORT: u16 = 8642;
/// Time to wait at the end for answers on their way (our choice).
const FAREWELL: Duration = Duration::from_millis(500);
/// Lifetime of the file that leads a browser to the page (our choice).
const BROWSER_FILE_TIME: Duration = Duration::from_secs(60);
/// Bytes of an answer that the system buffers for a page that does not read them (our choice). The default is megabytes
/// for each page.
const MOST_SENT_AHEAD_BYTES: u32 = 256 << 10;
/// Largest number of connections that wait to be accepted (our choice).
const MOST_WAITING: u32 = 1024;
/// Number of ports tried, one after the other.
const PORTS: u16 = 20;

homebody_core::messages! {
    /// Reasons why the server of the page cannot start.
    pub enum ServeError in "serve" {
        /// The server listens at the first free port of a range. Other programs, such as other servers of Homebody, use all of them.
        NoPort {
            /// The address of the machine.
            ip: String,
            /// The first port.
            first: u16,
            /// The last port.
            last: u16,
        } error "no-port" ("no port from {first} to {last} is free on {ip}")
            hint ("name another port with --port");
        /// A server listens at an address of its own machine.
        Foreign(ip: String) error "foreign-address" ("this machine has no address {ip}")
            hint ("choose an address that `ip address` lists, or leave out --bind to serve this machine only");
        /// Another program listens at this port, or the user may not open it: on most systems ports below 1024 are for the administrator.
        Port {
            /// The address and the port.
            address: String,
            /// The message of the system.
            source: io::Error,
        } error "port" ("cannot listen at {address}: {source}")
            hint ("name another port with --port; another program may be using this one")
            cause (Some(source));
        /// The token of the page is a random number, which the system makes.
        Token(why: String) error "no-token" ("cannot get a random number for the token: {why}");
        /// The system reports an error of the network or of threads.
        Broken(source: io::Error) error "broken" ("the server cannot run: {source}")
            cause (Some(source));
        => inner {
            /// The scenario cannot be opened.
            Scenario(Diagnostic);
            /// The file of the address cannot be used.
            AddressFile(AddressFileError);
        }
    }
}

impl From<AddressFileError> for ServeError {
    fn from(error: AddressFileError) -> ServeError {
        ServeError::AddressFile(error)
    }
}

impl From<getrandom::Error> for ServeError {
    fn from(error: getrandom::Error) -> ServeError {
        ServeError::Token(error.to_string())
    }
}

impl Options {
    /// A scenario or a library on loopback.
    pub fn new(offer: impl Into<Offer>) -> Options {
        Options { offer: offer.into(), ip: Ipv4Addr::LOCALHOST.into(), port: None, browser: false, kept: None }
    }
}

/// Serves until it is cancelled, then completes the files of the run; `ready` gets the address of the page.
pub fn serve(options: Options, cancel: &Cancel, ready: impl FnOnce(PageAddress)) -> Result<(), ServeError> {
    let runtime = tokio::runtime::Builder::new_multi_thread().worker_threads(2).enable_all().build();
    let runtime = runtime.map_err(ServeError::Broken)?;
    let served = runtime.block_on(async {
        let kept = options.kept.as_deref().map(address_file::read).transpose()?.flatten();
        let listener = listen(&options, kept.as_ref().map(|kept| kept.port))?;
        let address = listener.local_addr().map_err(ServeError::Broken)?;
        let guard = Guard::new(address, kept.map(|kept| kept.token))?;
        let pages = Arc::new(Semaphore::new(MOST_PAGES));
        let offered = OpenOffer::open(options.offer, &guard, pages).map_err(ServeError::Scenario)?;
        let url = format!("http://{address}{}#token={}", offered.first_page(), guard.token());
        if let Some(path) = &options.kept {
            address_file::write(path, &url)?;
        }
        let browser_file = if options.browser { BrowserFile::to(&url).ok() } else { None };
        ready(PageAddress { url: &url, file: browser_file.as_ref().map(BrowserFile::file) });
        let entered = guard.clone();
        tokio::spawn(async move {
            // A cancelled task drops it, too.
            let _browser_file = browser_file;
            let _ = tokio::time::timeout(BROWSER_FILE_TIME, entered.entered()).await;
        });
        let served = tokio::select! {
            error = connections::serve(listener, guarded(offered.routes(), guard)) => Err(error),
            () = cancelled(cancel) => Ok(()),
        };
        offered.close().await;
        served.map_err(ServeError::Broken)
    });
    // A request for a month of days does not keep the program from ending.
    runtime.shutdown_timeout(FAREWELL);
    served
}

/// Largest size in bytes of data that is sent uncompressed (our choice): compression would save no packet.
const LONGEST_PLAIN_BYTES: u64 = 1024;

/// Whether compression shortens an answer: it does for text and MessagePack. Files of runs and images are sent uncompressed, with their
/// length.
fn is_text(_: StatusCode, _: Version, headers: &HeaderMap, _: &Extensions) -> bool {
    let kind = headers.get(header::CONTENT_TYPE).and_then(|kind| kind.to_str().ok()).unwrap_or_default();
    let texts = ["text/", "application/json", "application/msgpack", "image/svg+xml"];
    texts.iter().any(|text| kind.starts_with(text))
}

/// Adds compression, a timeout for request bodies, and access control.
fn guarded(routes: Router, guard: Guard) -> Router {
    routes
        .layer(CompressionLayer::new().compress_when(SizeAbove::new(LONGEST_PLAIN_BYTES).and(is_text)))
        .layer(RequestBodyTimeoutLayer::new(LONGEST_UNTAKEN))
        .layer(axum::middleware::from_fn_with_state(guard, guard::watch))
}

enum OpenOffer {
    Scenario(Box<OpenHome>),
    Library(OpenHomes),
}

impl OpenOffer {
    fn open(offer: Offer, guard: &Guard, pages: Arc<Semaphore>) -> Result<OpenOffer, Diagnostic> {
        match offer {
            Offer::Scenario(folders) => {
                Ok(OpenOffer::Scenario(Box::new(OpenHome::open(folders, guard.clone(), pages)?)))
            }
            Offer::Library(library) => Ok(OpenOffer::Library(OpenHomes::new(library, guard.clone(), pages))),
        }
    }

    fn first_page(&self) -> &'static str {
        match self {
            OpenOffer::Scenario(_) => "/",
            OpenOffer::Library(_) => FIRST_PAGE,
        }
    }

    fn routes(&self) -> Router {
        match self {
            OpenOffer::Scenario(home) => (**home).clone().routes(),
            OpenOffer::Library(homes) => homes.clone().routes(),
        }
    }

    /// Returns when the files of all runs are complete.
    async fn close(self) {
        match self {
            OpenOffer::Scenario(home) => home.close(),
            OpenOffer::Library(homes) => homes.close().await,
        }
    }
}

async fn cancelled(cancel: &Cancel) {
    while !cancel.is_cancelled() {
        tokio::time::sleep(Duration::from_millis(50)).await;
    }
}

/// Listens at the chosen port, else at the kept one, else at the first free one.
fn listen(options: &Options, kept: Option<u16>) -> Result<TcpListener, ServeError> {
    // The page has one name: an IPv4 address written as IPv6 counts as IPv4.
    let ip = options.ip.to_canonical();
    if let Some(port) = options.port.or(kept) {
        let address = SocketAddr::new(ip, port);
        return bind(address).map_err(|source| match source.kind() {
            ErrorKind::AddrNotAvailable => ServeError::Foreign(ip.to_string()),
            _ => ServeError::Port { address: address.to_string(), source },
        });
    }
    let last = FIRST_PORT + PORTS - 1;
    for port in FIRST_PORT..=last {
        match bind(SocketAddr::new(ip, port)) {
            Ok(listener) => return Ok(listener),
            Err(error) if error.kind() == ErrorKind::AddrNotAvailable => {
                return Err(ServeError::Foreign(ip.to_string()));
            }
            Err(_) => {}
        }
    }
    Err(ServeError::NoPort { ip: ip.to_string(), first: FIRST_PORT, last })
}

pub(crate) fn bind(address: SocketAddr) -> io::Result<TcpListener> {
    let socket = if address.is_ipv4() { TcpSocket::new_v4()? } else { TcpSocket::new_v6()? };
    // A server that has just ended leaves connections that block its port. Elsewhere than on Unix the option has another meaning.
    #[cfg(unix)]
    socket.set_reuseaddr(true)?;
    // Connections inherit the options of their listener.
    socket.set_send_buffer_size(MOST_SENT_AHEAD_BYTES)?;
    socket.bind(address)?;
    socket.listen(MOST_WAITING)
}
