//! The homes of a library that are open, each with its own stage, and what the first page asks.
//!
//! A home is opened when its page first asks for something. Where too many are open, one that nobody looks at and in which nothing
//! goes on makes room.

use crate::answers::{Refused, found, json, plan_of, received, refused, told_length};
use crate::guard::{Guard, HOMES};
use crate::house::{House, LARGEST_BODY_BYTES};
use crate::library::Library;
use crate::messages::{LibraryMessage, PageMessage};
use crate::page::{self, FIRST_PAGE};
use crate::socket;
use crate::visit::Visit;
use crate::walks::LARGEST_LOG_BYTES;
use crate::wire::{CallHome, CardView, MadeView, NewHome, PutAside};
use axum::body::Body;
use axum::extract::ws::WebSocketUpgrade;
use axum::extract::{DefaultBodyLimit, Path, Request, State};
use axum::http::{Extensions, HeaderMap, StatusCode, Uri};
use axum::response::{IntoResponse, Redirect, Response};
use axum::routing::{any, get, post};
use axum::{Extension, Json, Router};
use std::sync::Arc;
use tokio::sync::{Mutex, Semaphore};
use tower_service::Service;

/// Largest number of open homes (our choice): each has a thread, and a run at its start.
const MOST_OPEN: usize = 16;

/// All homes of a library. A clone is the same.
#[derive(Clone)]
pub struct Homes {
    library: Library,
    guard: Guard,
    pages: Arc<Semaphore>,
    /// The last one that was asked comes last.
    open: Arc<Mutex<Vec<Opened>>>,
}

#[derive(Clone)]
struct Opened {
    name: String,
    house: House,
    routes: Router,
}

impl Homes {
    pub fn new(library: Library, guard: Guard, pages: Arc<Semaphore>) -> Homes {
        Homes { library, guard, pages, open: Arc::default() }
    }

    /// What the first page and those of the homes may ask.
    pub fn routes(self) -> Router {
        Router::new()
            .route("/", get(async || Redirect::temporary(FIRST_PAGE)))
            .route("/api/library", get(library))
            .route("/api/library/homes/{name}", get(card).post(begin).delete(put_aside))
            .route("/api/library/homes/{name}/name", post(rename))
            .route("/api/library/homes/{name}/copy", post(duplicate))
            .route("/api/library/homes/{name}/runs/{run}", get(picture))
            .route("/api/library/plans/{name}", post(import))
            .route("/api/library/logs/{name}/{file}", post(from_log))
            .route("/api/library/put-aside/{key}", post(fetch_back))
            .route("/api/homes/{name}/live", get(live))
            .route("/api/homes/{name}/{*rest}", any(of_home))
            .fallback(get(page::file))
            .layer(DefaultBodyLimit::max(LARGEST_BODY_BYTES))
            .with_state(self)
    }

    /// Closes all, and comes back when the files of their runs are complete.
    pub async fn close(&self) {
        for opened in self.open.lock().await.drain(..) {
            // One that cannot be closed has said why.
            let _ = found(move || opened.house.close()).await;
        }
    }

    /// What answers for a home, which is opened if need be.
    async fn opened(&self, name: &str) -> Result<Opened, Refused> {
        let mut open = self.open.lock().await;
        if let Some(at) = open.iter().position(|opened| opened.name == name) {
            // One that is open already may have been given a link since.
            self.library.has_own_runs(name).map_err(refused)?;
            let opened = open.remove(at);
            open.push(opened.clone());
            return Ok(opened);
        }
        let (library, sought) = (self.library.clone(), name.to_owned());
        let shelf = found(move || library.home(&sought)).await?.map_err(refused)?;
        if open.len() >= MOST_OPEN {
            let idle = open.iter().position(|opened| !opened.house.is_busy());
            let full =
                || Refused::of(StatusCode::SERVICE_UNAVAILABLE, LibraryMessage::TooManyOpen { limit: MOST_OPEN });
            let idle = open.remove(idle.ok_or_else(full)?);
            found(move || idle.house.close()).await?;
        }
        let (guard, pages) = (self.guard.clone(), self.pages.clone());
        let house = found(move || House::open(shelf, guard, pages)).await?;
        let house = house.map_err(|why| Refused::of(StatusCode::INTERNAL_SERVER_ERROR, why))?;
        let opened = Opened { name: name.to_owned(), routes: house.clone().routes(), house };
        open.push(opened.clone());
        Ok(opened)
    }

    /// Does something to a home that nobody has open meanwhile.
    async fn closed<T: Send + 'static>(
        self,
        name: String,
        change: impl FnOnce(&Library, &str) -> T + Send + 'static,
    ) -> Result<T, Refused> {
        let mut open = self.open.lock().await;
        let opened = open.iter().position(|opened| opened.name == name).map(|at| open.remove(at));
        let library = self.library;
        found(move || {
            if let Some(opened) = opened {
                opened.house.send_away();
                opened.house.close();
            }
            change(&library, &name)
        })
        .await
    }
}

async fn library(State(homes): State<Homes>) -> Response {
    json(found(move || homes.library.view()).await)
}

async fn card(State(homes): State<Homes>, Path(name): Path<String>) -> Response {
    // A card waits for no home that is being opened or closed.
    let goes_on =
        homes.open.try_lock().ok().and_then(|open| open.iter().find(|opened| opened.name == name)?.house.goes_on());
    let card = move || Ok(CardView { goes_on, ..homes.library.card(&name)? });
    json(found(card).await.and_then(|card| card.map_err(refused)))
}

async fn picture(State(homes): State<Homes>, Path((name, run)): Path<(String, String)>) -> Response {
    json(found(move || homes.library.picture(&name, &run)).await.and_then(|hours| hours.map_err(refused)))
}

async fn begin(State(homes): State<Homes>, Path(name): Path<String>, Json(from): Json<NewHome>) -> Response {
    json(found(move || homes.library.begin(&name, &from)).await.and_then(|made| made.map_err(refused)))
}

async fn import(State(homes): State<Homes>, Path(name): Path<String>, headers: HeaderMap, body: Body) -> Response {
    let plan = match plan_of(&headers, body).await {
        Ok(plan) => plan,
        Err(refused) => return refused.into_response(),
    };
    json(found(move || homes.library.import(&name, &plan.bytes)).await.and_then(|made| made.map_err(refused)))
}

async fn from_log(
    State(homes): State<Homes>,
    Path((name, file)): Path<(String, String)>,
    headers: HeaderMap,
    body: Body,
) -> Response {
    json(made_of_log(homes.library, (name, file), &headers, body).await)
}

async fn made_of_log(
    library: Library,
    (name, file): (String, String),
    headers: &HeaderMap,
    body: Body,
) -> Result<MadeView, Refused> {
    let too_large = || {
        let (limit_mb, command) = (LARGEST_LOG_BYTES >> 20, "homebody new --from-log");
        Refused::of(StatusCode::PAYLOAD_TOO_LARGE, PageMessage::LogTooLarge { limit_mb, command })
    };
    if told_length(headers).is_some_and(|length| length > LARGEST_LOG_BYTES) {
        return Err(too_large());
    }
    library.is_free(&name).map_err(refused)?;
    let hidden = library.hidden().map_err(refused)?;
    // The form of a log is known by how its name ends, too.
    let is_ending =
        |ending: &&str| (1..=8).contains(&ending.len()) && ending.bytes().all(|byte| byte.is_ascii_alphanumeric());
    let ending = file.rsplit_once('.').map(|(_, ending)| ending).filter(is_ending).unwrap_or("txt");
    let log = hidden.path().join(format!("log.{ending}"));
    received(body, &log, (LARGEST_LOG_BYTES, too_large), || false).await?;
    let made = found(move || {
        let made = library.from_log(&name, &file, &log);
        drop(hidden);
        made
    });
    made.await?.map_err(refused)
}

async fn duplicate(State(homes): State<Homes>, Path(name): Path<String>, Json(to): Json<CallHome>) -> Response {
    json(found(move || homes.library.duplicate(&name, &to.name)).await.and_then(|made| made.map_err(refused)))
}

async fn rename(State(homes): State<Homes>, Path(name): Path<String>, Json(to): Json<CallHome>) -> Response {
    // A name that cannot be taken closes nothing.
    let free = homes.library.is_free(&to.name).map_err(refused);
    let renamed = match free {
        Ok(()) => homes.closed(name, move |library, name| library.rename(name, &to.name)).await,
        Err(refused) => return refused.into_response(),
    };
    json(renamed.and_then(|renamed| renamed.map_err(refused)))
}

async fn put_aside(State(homes): State<Homes>, Path(name): Path<String>) -> Response {
    let aside = homes.closed(name, Library::put_aside).await.and_then(|aside| aside.map_err(refused));
    json(aside.map(|key| PutAside { key }))
}

async fn fetch_back(State(homes): State<Homes>, Path(key): Path<String>) -> Response {
    json(found(move || homes.library.fetch_back(&key)).await.and_then(|name| name.map_err(refused)))
}

/// A page of a home comes to look. Its home is opened once it has said the token.
async fn live(
    State(homes): State<Homes>,
    Extension(visit): Extension<Visit>,
    Path(name): Path<String>,
    headers: HeaderMap,
    upgrade: WebSocketUpgrade,
) -> Response {
    let guard = homes.guard.clone();
    socket::upgraded(upgrade, &headers, visit, guard, async move |socket, visit| match homes.opened(&name).await {
        Ok(opened) => opened.house.show(socket, visit).await,
        Err(refused) if refused.status == StatusCode::NOT_FOUND => socket::close_without_home(socket).await,
        Err(_) => socket::close_for_now(socket).await,
    })
}

/// A request of the page of a home, which is answered as by a server of that home alone.
async fn of_home(
    State(homes): State<Homes>,
    Extension(visit): Extension<Visit>,
    Path((name, _)): Path<(String, String)>,
    request: Request,
) -> Response {
    let mut routes = match homes.opened(&name).await {
        Ok(opened) => opened.routes,
        Err(refused) => return refused.into_response(),
    };
    let Some(request) = without_home(request, visit) else { return StatusCode::NOT_FOUND.into_response() };
    routes.call(request).await.into_response()
}

/// The request as its home alone would get it.
fn without_home(request: Request, visit: Visit) -> Option<Request> {
    let (mut parts, body) = request.into_parts();
    let (_, rest) = parts.uri.path().strip_prefix(HOMES)?.split_once('/')?;
    let query = parts.uri.query().map_or_else(String::new, |query| format!("?{query}"));
    parts.uri = format!("/api/{rest}{query}").parse::<Uri>().ok()?;
    // What has been read from the path is not read again.
    parts.extensions = Extensions::new();
    parts.extensions.insert(visit);
    Some(Request::from_parts(parts, body))
}
