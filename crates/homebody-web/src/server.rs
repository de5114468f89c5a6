//! The server: its address, its routes, its limits.

use crate::connections;
use crate::desk::Desk;
use crate::doorway::Doorway;
use crate::guard::{self, Guard};
use crate::keeping;
use crate::notes::{Notes, Unnoted};
use crate::page;
use crate::playback::{Playback, Refusal};
use crate::shelf::Shelf;
use crate::socket;
use crate::stage::Stage;
use crate::told::{Logs, Which};
use crate::visit::{LONGEST_UNTAKEN, Visit};
use crate::walks::{HomeOf, LARGEST_LOG_BYTES, Unwalked, Walks};
use crate::wire::{Connect, Draft, Explain, Find, Forget, Month, NoteIt, Rename, RunAbout, Save, WalkingView};
use axum::body::Body;
use axum::extract::ws::WebSocketUpgrade;
use axum::extract::{DefaultBodyLimit, Path, State};
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{IntoResponse, Response};
use axum::routing::{get, post};
use axum::{Extension, Json, Router};
use futures_util::StreamExt;
use futures_util::stream::{Stream, try_unfold};
use homebody_import::{MOST_BYTES, NotImported};
use homebody_kit::Cancel;
use homebody_log::places::RECORDING;
use serde::Serialize;
use std::io::{self, ErrorKind};
use std::net::{IpAddr, Ipv4Addr, SocketAddr};
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;
use tokio::io::{AsyncRead, AsyncReadExt, AsyncWriteExt};
use tokio::net::{TcpListener, TcpSocket};
use tokio::sync::Semaphore;
use tower_http::timeout::RequestBodyTimeoutLayer;

pub use crate::guard::SOCKET;

/// What a page may send by HTTP (ours).
const LARGEST_BODY_BYTES: usize = 8 << 20;

/// So many pages may look at once (ours).
const MOST_PAGES: usize = 32;

/// What to serve, and where.
#[derive(Clone, Debug)]
pub struct Options {
    pub shelf: Shelf,
    /// Loopback, unless somebody wants others to come.
    pub ip: IpAddr,
    /// Nothing for the first one that is free, from [`FIRST_PORT`] on.
    pub port: Option<u16>,
    /// Whether a browser is going to be opened: then there is a file for it.
    pub browser: bool,
}

/// Where the page is.
#[derive(Clone, Copy, Debug)]
pub struct Address<'a> {
    /// For its user alone: it holds the token, behind a `#`, and browsers send to no server what is behind that.
    pub url: &'a str,
    /// For a browser: a file that only its user can read, and which leads there. It is removed once somebody has come with the
    /// token, and after a minute. `None` where no browser is to be opened, and where no file could be made.
    pub file: Option<&'a std::path::Path>,
}

/// Where free ports are looked for first.
pub const FIRST_PORT: u16 = 8642;
/// How long is waited at the end for answers that are on their way (ours).
const FAREWELL: Duration = Duration::from_millis(500);
/// How long the file stands that leads a browser to the page, if none comes (ours).
const DOORWAY: Duration = Duration::from_secs(60);
/// How many bytes of an answer the system keeps for who does not read them (ours): else it would be megabytes for each.
const MOST_SENT_AHEAD_BYTES: u32 = 256 << 10;
/// How many may have come and not been let in yet (ours).
const MOST_WAITING: u32 = 1024;
/// How many ports are tried.
const PORTS: u16 = 20;

/// Why there is no server.
#[derive(Debug, thiserror::Error)]
pub enum ServeError {
    #[error("{0}")]
    Scenario(String),
    #[error("no port from {first} to {last} is free on {ip}\n  hint: name another port")]
    NoPort { ip: IpAddr, first: u16, last: u16 },
    #[error(
        "this machine has no address {0}\n  hint: `ip address` lists those it has; 127.0.0.1 is for this machine alone"
    )]
    Foreign(IpAddr),
    #[error("{address} cannot be listened to: {source}\n  hint: another program may be there; name another port")]
    Port { address: SocketAddr, source: std::io::Error },
    #[error("there is no randomness for a token: {0}")]
    Token(getrandom::Error),
    #[error("the server cannot run: {0}")]
    Broken(std::io::Error),
}

impl Options {
    /// The scenario and the runs on this machine's loopback.
    pub fn new(shelf: Shelf) -> Options {
        Options { shelf, ip: Ipv4Addr::LOCALHOST.into(), port: None, browser: false }
    }
}

/// Serves until it is cancelled, then completes the files of the run; `ready` hears where the page is.
pub fn serve(options: Options, cancel: &Cancel, ready: impl FnOnce(Address)) -> Result<(), ServeError> {
    let runtime = tokio::runtime::Builder::new_multi_thread().worker_threads(2).enable_all().build();
    let runtime = runtime.map_err(ServeError::Broken)?;
    let served = runtime.block_on(async {
        let listener = listen(&options)?;
        let address = listener.local_addr().map_err(ServeError::Broken)?;
        let guard = Guard::new(address).map_err(ServeError::Token)?;
        let stage = Stage::open(options.shelf.clone()).map_err(ServeError::Scenario)?;
        let playback = Playback::new(options.shelf.clone());
        let desk = Desk::new(options.shelf.clone());
        let walks = Walks::new(options.shelf.clone());
        let logs = Logs::new(options.shelf.clone());
        let notes = Notes::new(options.shelf.clone());
        let pages = Arc::new(Semaphore::new(MOST_PAGES));
        let (ended, shelf) = (walks.clone(), options.shelf);
        let house = House { guard, stage: stage.clone(), shelf, playback, desk, walks, logs, notes, pages };
        let url = format!("http://{address}/#token={}", house.guard.token());
        let doorway = if options.browser { Doorway::to(&url).ok() } else { None };
        ready(Address { url: &url, file: doorway.as_ref().map(Doorway::file) });
        let guard = house.guard.clone();
        tokio::spawn(async move {
            // A cancelled task drops it as well.
            let _doorway = doorway;
            let _ = tokio::time::timeout(DOORWAY, guard.entered()).await;
        });
        let served = tokio::select! {
            error = connections::serve(listener, routes(house)) => Err(error),
            () = cancelled(cancel) => Ok(()),
        };
        stage.close();
        ended.close();
        served.map_err(ServeError::Broken)
    });
    // Who has asked for a month of days does not keep the program from ending.
    runtime.shutdown_timeout(FAREWELL);
    served
}

async fn cancelled(cancel: &Cancel) {
    while !cancel.is_cancelled() {
        tokio::time::sleep(Duration::from_millis(50)).await;
    }
}

fn listen(options: &Options) -> Result<TcpListener, ServeError> {
    // The page has one name: an IPv4 address that is written as an IPv6 one is taken as IPv4.
    let ip = options.ip.to_canonical();
    if let Some(port) = options.port {
        let address = SocketAddr::new(ip, port);
        return bind(address).map_err(|source| match source.kind() {
            ErrorKind::AddrNotAvailable => ServeError::Foreign(ip),
            _ => ServeError::Port { address, source },
        });
    }
    let last = FIRST_PORT + PORTS - 1;
    for port in FIRST_PORT..=last {
        match bind(SocketAddr::new(ip, port)) {
            Ok(listener) => return Ok(listener),
            Err(error) if error.kind() == ErrorKind::AddrNotAvailable => return Err(ServeError::Foreign(ip)),
            Err(_) => {}
        }
    }
    Err(ServeError::NoPort { ip, first: FIRST_PORT, last })
}

pub(crate) fn bind(address: SocketAddr) -> io::Result<TcpListener> {
    let socket = if address.is_ipv4() { TcpSocket::new_v4()? } else { TcpSocket::new_v6()? };
    // A server that has just ended leaves connections that block its port. Elsewhere than on Unix the option means another thing.
    #[cfg(unix)]
    socket.set_reuseaddr(true)?;
    // Connections have what their listener has.
    socket.set_send_buffer_size(MOST_SENT_AHEAD_BYTES)?;
    socket.bind(address)?;
    socket.listen(MOST_WAITING)
}

/// What answers are made from.
#[derive(Clone)]
struct House {
    guard: Guard,
    stage: Stage,
    shelf: Shelf,
    playback: Playback,
    desk: Desk,
    walks: Walks,
    logs: Logs,
    notes: Notes,
    pages: Arc<Semaphore>,
}

fn routes(house: House) -> Router {
    Router::new()
        .route(SOCKET, get(live))
        .route("/api/files", get(files).post(save))
        .route("/api/files/versions", get(versions))
        .route("/api/underlay", get(underlay))
        .route("/api/underlay/picture", get(picture))
        .route("/api/check", post(check))
        .route("/api/rename", post(rename))
        .route("/api/forget", post(forget))
        .route("/api/mends", post(mends))
        .route("/api/plan", post(plan))
        .route("/api/import", post(import))
        .route("/api/explain", post(explain))
        .route("/api/month", post(month))
        .route("/api/rows", post(rows))
        .route("/api/connect", post(connect))
        .route("/api/growth", get(growth))
        .route("/api/runs", get(runs))
        .route("/api/runs/{run}", get(stored_run).delete(put_aside))
        .route("/api/put-aside/{key}", post(fetch_back))
        .route("/api/runs/{run}/about", post(call))
        .route("/api/runs/{run}/days/{day}", get(stored_day))
        .route("/api/runs/{run}/days/{day}/from/{from}", get(rest_of_day))
        .route("/api/runs/{run}/find", post(find))
        .route("/api/runs/{run}/lanes", get(lanes))
        .route("/api/runs/{run}/look", get(look))
        .route("/api/runs/{run}/care", get(care))
        .route("/api/runs/{run}/notes", get(notes).post(note))
        .route("/api/runs/{run}/realism/{beside}", get(realism))
        .route("/api/runs/{run}/{what}", get(file_of_run))
        .route("/api/walk", get(walking).delete(stop_walking))
        .route("/api/logs", get(kept_logs))
        .route("/api/logs/{log}", post(keep))
        .route("/api/walk/{log}", post(walk))
        .route("/api/walk/{log}/{run}", post(walk_in_home_of))
        .fallback(get(page::file))
        .layer(DefaultBodyLimit::max(LARGEST_BODY_BYTES))
        .layer(RequestBodyTimeoutLayer::new(LONGEST_UNTAKEN))
        .layer(axum::middleware::from_fn_with_state(house.guard.clone(), guard::watch))
        .with_state(house)
}

async fn live(
    State(house): State<House>,
    Extension(visit): Extension<Visit>,
    headers: HeaderMap,
    upgrade: WebSocketUpgrade,
) -> Response {
    if !house.guard.is_socket_from_us(&headers) {
        return (StatusCode::FORBIDDEN, "Only its own page may ask this server.").into_response();
    }
    let upgrade = upgrade.max_message_size(socket::LONGEST_MESSAGE_BYTES).max_frame_size(socket::LONGEST_MESSAGE_BYTES);
    upgrade.on_upgrade(async move |socket| {
        tokio::select! {
            () = socket::serve(socket, visit.clone(), house.guard, house.pages, house.stage) => {}
            () = visit.sent_away() => {}
        }
    })
}

/// Why there is no answer, and the code that says so.
type Refused = (StatusCode, String);

/// What a thread for work that takes its time has found.
async fn found<T: Send + 'static>(find: impl FnOnce() -> T + Send + 'static) -> Result<T, Refused> {
    tokio::task::spawn_blocking(find).await.map_err(|error| (StatusCode::INTERNAL_SERVER_ERROR, error.to_string()))
}

/// The same for work that stops when nobody waits for it any more.
async fn found_while_waited_for<T: Send + 'static>(
    find: impl FnOnce(&Cancel) -> T + Send + 'static,
) -> Result<T, Refused> {
    struct Waits(Cancel);
    impl Drop for Waits {
        fn drop(&mut self) {
            self.0.cancel();
        }
    }
    // An answer is dropped on its way when its connection ends.
    let waits = Waits(Cancel::new());
    let cancel = waits.0.clone();
    found(move || find(&cancel)).await
}

fn json(found: Result<impl Serialize, Refused>) -> Response {
    found.map_or_else(Refused::into_response, |found| Json(found).into_response())
}

/// In MessagePack, for what is large.
fn packed(found: Result<impl Serialize, Refused>) -> Response {
    let pack = |found| match rmp_serde::to_vec_named(&found) {
        Ok(bytes) => ([(header::CONTENT_TYPE, "application/msgpack")], bytes).into_response(),
        Err(error) => (StatusCode::INTERNAL_SERVER_ERROR, error.to_string()).into_response(),
    };
    found.map_or_else(Refused::into_response, pack)
}

async fn files(State(house): State<House>) -> Response {
    json(found(move || house.desk.files()).await)
}

async fn underlay(State(house): State<House>) -> Response {
    json(found(move || house.desk.underlay()).await)
}

/// The picture below the plan.
async fn picture(State(house): State<House>) -> Response {
    download(move || house.shelf.picture(&house.desk.underlay()?.picture), "There is no picture below the plan.").await
}

async fn versions(State(house): State<House>) -> Response {
    json(found(move || house.desk.versions()).await)
}

async fn save(State(house): State<House>, Json(save): Json<Save>) -> Response {
    let refused = |why: String| (StatusCode::UNPROCESSABLE_ENTITY, why);
    json(found(move || house.desk.save(save)).await.and_then(|saved| saved.map_err(refused)))
}

async fn check(State(house): State<House>, Json(draft): Json<Draft>) -> Response {
    json(found(move || house.desk.check(draft)).await)
}

async fn rename(State(house): State<House>, Json(asked): Json<Rename>) -> Response {
    json(found(move || house.desk.rename(asked)).await)
}

async fn forget(State(house): State<House>, Json(asked): Json<Forget>) -> Response {
    json(found(move || house.desk.forget(asked)).await)
}

async fn mends(State(house): State<House>, Json(draft): Json<Draft>) -> Response {
    json(found(move || house.desk.mends(draft)).await)
}

async fn plan(State(house): State<House>, Json(draft): Json<Draft>) -> Response {
    packed(found(move || house.desk.plan(draft)).await)
}

/// A plan of another program, as its file's bytes.
async fn import(State(house): State<House>, headers: HeaderMap, body: Body) -> Response {
    let too_large = || (StatusCode::PAYLOAD_TOO_LARGE, format!("A plan has at most {} MB.", MOST_BYTES >> 20));
    if told_length(&headers).is_some_and(|length| length > MOST_BYTES) {
        return too_large().into_response();
    }
    let Ok(bytes) = axum::body::to_bytes(body, MOST_BYTES as usize).await else {
        return too_large().into_response();
    };
    let refused = |why: NotImported| (StatusCode::UNPROCESSABLE_ENTITY, why.to_string());
    json(found(move || house.desk.import(&bytes)).await.and_then(|made| made.map_err(refused)))
}

async fn explain(State(house): State<House>, Json(asked): Json<Explain>) -> Response {
    json(found(move || house.desk.explain(asked)).await)
}

async fn month(State(house): State<House>, Json(asked): Json<Month>) -> Response {
    packed(found_while_waited_for(move |cancel| house.desk.month(asked, cancel)).await)
}

async fn rows(State(house): State<House>, Json(draft): Json<Draft>) -> Response {
    json(found_while_waited_for(move |cancel| house.desk.rows(draft, cancel)).await)
}

async fn connect(State(house): State<House>, Json(asked): Json<Connect>) -> Response {
    json(found(move || house.desk.connect(asked)).await)
}

async fn growth(State(house): State<House>) -> Response {
    json(Ok(house.stage.growth()))
}

async fn runs(State(house): State<House>) -> Response {
    json(found(move || house.playback.list()).await)
}

/// A stored run as a whole.
async fn stored_run(State(house): State<House>, Path(run): Path<String>) -> Response {
    let run = found(move || house.playback.run(&run)).await.and_then(|run| run.map_err(refused));
    run.map_or_else(Refused::into_response, |view| Json(&*view).into_response())
}

/// A day of a stored run.
async fn stored_day(State(house): State<House>, Path((run, day)): Path<(String, String)>) -> Response {
    let Ok(day) = day.parse() else {
        return (StatusCode::NOT_FOUND, "The days of a run are numbered from 0.").into_response();
    };
    packed(found(move || house.playback.day(&run, day)).await.and_then(|day| day.map_err(refused)))
}

/// What a day's answer had no time for: movements from an instant on.
async fn rest_of_day(State(house): State<House>, Path((run, day, from)): Path<(String, String, String)>) -> Response {
    let (Ok(day), Ok(from)) = (day.parse(), from.parse()) else {
        return (StatusCode::NOT_FOUND, "The days of a run are numbered from 0, its instants counted in microseconds.")
            .into_response();
    };
    packed(found(move || house.playback.rest_of_day(&run, day, from)).await.and_then(|day| day.map_err(refused)))
}

/// What is looked for over a whole stored run.
async fn find(State(house): State<House>, Path(run): Path<String>, Json(asked): Json<Find>) -> Response {
    let look = move || house.playback.find(&run, &asked, || house.logs.care(&run).map(|care| care.alerts));
    json(found(look).await.and_then(|found| found.map_err(refused)))
}

/// How often each sensor of a stored run spoke, over the whole of it.
async fn lanes(State(house): State<House>, Path(run): Path<String>) -> Response {
    packed(found(move || house.playback.lanes(&run)).await.and_then(|lanes| lanes.map_err(refused)))
}

/// A run is called something.
async fn call(State(house): State<House>, Path(run): Path<String>, Json(about): Json<RunAbout>) -> Response {
    json(found(move || keeping::call(&house.shelf, &run, about)).await.and_then(|about| about.map_err(refused)))
}

async fn put_aside(State(house): State<House>, Path(run): Path<String>) -> Response {
    if house.stage.records(&run) {
        return (StatusCode::CONFLICT, "This run is being lived: stop it first.").into_response();
    }
    json(found(move || keeping::put_aside(&house.shelf, &run)).await.and_then(|aside| aside.map_err(refused)))
}

async fn fetch_back(State(house): State<House>, Path(key): Path<String>) -> Response {
    json(found(move || keeping::fetch_back(&house.shelf, &key)).await.and_then(|run| run.map_err(refused)))
}

fn refused(refusal: Refusal) -> Refused {
    match refusal {
        Refusal::Unknown(why) => (StatusCode::NOT_FOUND, why),
        Refusal::Damaged(why) => (StatusCode::UNPROCESSABLE_ENTITY, why),
    }
}

/// How the resident of a stored run is, by its log.
async fn care(State(house): State<House>, Path(run): Path<String>) -> Response {
    let care = found(move || house.logs.care(&run)).await.and_then(|care| care.map_err(refused));
    care.map_or_else(Refused::into_response, |care| Json(care).into_response())
}

/// What was noted about a stored run.
async fn notes(State(house): State<House>, Path(run): Path<String>) -> Response {
    json(found(move || house.notes.of(&run)).await.and_then(|notes| notes.map_err(refused)))
}

async fn note(State(house): State<House>, Path(run): Path<String>, Json(note): Json<NoteIt>) -> Response {
    let unnoted = |why: Unnoted| match why {
        Unnoted::Refused(refusal) => refused(refusal),
        Unnoted::Changed(why) => (StatusCode::CONFLICT, why),
    };
    json(found(move || house.notes.note(&run, note)).await.and_then(|notes| notes.map_err(unnoted)))
}

/// The logs that are kept for the care view alone.
async fn kept_logs(State(house): State<House>) -> Response {
    json(found(move || house.logs.kept()).await)
}

/// A log, as its file's bytes, that is kept without a home from now on.
async fn keep(State(house): State<House>, Path(log): Path<String>, headers: HeaderMap, body: Body) -> Response {
    json(begun(house.walks, (log, HomeOf::Nobody), &headers, body).await)
}

/// What the log of a stored run holds, as a page.
async fn look(State(house): State<House>, Path(run): Path<String>) -> Response {
    written(found(move || house.logs.look(&run)).await)
}

/// The log of a stored run as one that is real, and how near another is; beside itself the log that was walked back is held
/// against what was lived again.
async fn realism(State(house): State<House>, Path((run, beside)): Path<(String, String)>) -> Response {
    let which = if run == beside { Which::Own } else { Which::Given };
    written(found(move || house.logs.realism((&run, Which::Given), (&beside, which))).await)
}

/// A page as a command writes it, which the page of ours shows: by itself a browser would show none of its style.
fn written(page: Result<Result<String, Refusal>, Refused>) -> Response {
    let page = page.and_then(|page| page.map_err(refused));
    page.map_or_else(Refused::into_response, |page| {
        ([(header::CONTENT_TYPE, "text/plain; charset=utf-8")], page).into_response()
    })
}

async fn walking(State(house): State<House>) -> Response {
    json(Ok(house.walks.now()))
}

async fn stop_walking(State(house): State<House>) -> Response {
    house.walks.stop();
    json(Ok(house.walks.now()))
}

/// A log, as its file's bytes, that is walked back through the home of the scenario from now on.
async fn walk(State(house): State<House>, Path(log): Path<String>, headers: HeaderMap, body: Body) -> Response {
    json(begun(house.walks, (log, HomeOf::Scenario), &headers, body).await)
}

/// The same through the home of a stored run.
async fn walk_in_home_of(
    State(house): State<House>,
    Path((log, run)): Path<(String, String)>,
    headers: HeaderMap,
    body: Body,
) -> Response {
    json(begun(house.walks, (log, HomeOf::Run(run)), &headers, body).await)
}

async fn begun(
    walks: Walks,
    (log, home): (String, HomeOf),
    headers: &HeaderMap,
    body: Body,
) -> Result<Option<WalkingView>, Refused> {
    let too_large = || {
        let what = format!("A log has at most {} MB here; homebody translate takes any.", LARGEST_LOG_BYTES >> 20);
        (StatusCode::PAYLOAD_TOO_LARGE, what)
    };
    let failed = |error: io::Error| (StatusCode::INTERNAL_SERVER_ERROR, error.to_string());
    if told_length(headers).is_some_and(|length| length > LARGEST_LOG_BYTES) {
        return Err(too_large());
    }
    let coming = walks.begin(&log, home).map_err(|why| match why {
        Unwalked::Busy(log) => (StatusCode::CONFLICT, format!("{log} is being walked back: wait for it, or stop it.")),
        Unwalked::NoPlace(error) => failed(error),
    })?;
    let mut file = tokio::fs::File::create(coming.file()).await.map_err(failed)?;
    let (mut parts, mut length) = (body.into_data_stream(), 0);
    while let Some(part) = parts.next().await {
        let Ok(part) = part else { return Err((StatusCode::BAD_REQUEST, "Not all of the log has come.".into())) };
        length += part.len() as u64;
        if length > LARGEST_LOG_BYTES {
            return Err(too_large());
        }
        if coming.is_cancelled() {
            return Ok(walks.now());
        }
        file.write_all(&part).await.map_err(failed)?;
    }
    file.flush().await.map_err(failed)?;
    coming.walk();
    Ok(walks.now())
}

/// How long a request's body is to be, if that is told.
fn told_length(headers: &HeaderMap) -> Option<u64> {
    headers.get(header::CONTENT_LENGTH)?.to_str().ok()?.parse().ok()
}

/// A file of a stored run, as a download.
async fn file_of_run(State(house): State<House>, Path((run, what)): Path<(String, String)>) -> Response {
    let find = move || match what.as_str() {
        "log" => house.playback.log_of(&run),
        "recording" => house.shelf.file_of_run(&run, RECORDING),
        _ => None,
    };
    download(find, "There is no such file of such a run.").await
}

/// A file, as a download.
async fn download(find: impl FnOnce() -> Option<PathBuf> + Send + 'static, otherwise: &'static str) -> Response {
    let path = match found(find).await {
        Ok(Some(path)) => path,
        Ok(None) => return (StatusCode::NOT_FOUND, otherwise).into_response(),
        Err(refused) => return refused.into_response(),
    };
    let failed = |error: io::Error| (StatusCode::INTERNAL_SERVER_ERROR, error.to_string()).into_response();
    let file = match tokio::fs::File::open(&path).await {
        Ok(file) => file,
        Err(error) => return failed(error),
    };
    let length = match file.metadata().await {
        Ok(known) => known.len(),
        Err(error) => return failed(error),
    };
    let name = path.file_name().unwrap_or_default().to_string_lossy().replace(['"', '\\'], "_");
    let head = [
        (header::CONTENT_TYPE, "application/octet-stream".to_owned()),
        (header::CONTENT_DISPOSITION, format!("attachment; filename=\"{name}\"")),
        (header::CONTENT_LENGTH, length.to_string()),
    ];
    (head, Body::from_stream(chunks(file.take(length)))).into_response()
}

/// What there is to read, piece by piece: a log may be larger than memory.
fn chunks(file: impl AsyncRead + Unpin) -> impl Stream<Item = io::Result<Vec<u8>>> {
    try_unfold(file, |mut file| async move {
        let mut chunk = vec![0; 1 << 16];
        let length = file.read(&mut chunk).await?;
        chunk.truncate(length);
        Ok((length > 0).then_some((chunk, file)))
    })
}
