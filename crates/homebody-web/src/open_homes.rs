//! The open homes of a library, and the requests of its first page.
//!
//! The first request of its page opens a home. If too many homes are open, an idle one without a page is closed.

use crate::answers::{LogBody, answer, in_background, json, plan_of};
use crate::client::ClientConnection;
use crate::guard::{Guard, HOMES};
use crate::library::Library;
use crate::messages::LibraryMessage;
use crate::open_home::{LARGEST_BODY_BYTES, OpenHome};
use crate::page::{self, FIRST_PAGE};
use crate::request_error::RequestError;
use crate::socket;
use crate::wire::{CallHome, CardView, DeletedKey, MadeView, NewHome};
use axum::body::Body;
use axum::extract::ws::WebSocketUpgrade;
use axum::extract::{DefaultBodyLimit, Path, Request, State};
use axum::http::{Extensions, HeaderMap, StatusCode, Uri};
use axum::response::{IntoResponse, Redirect, Response};
use axum::routing::{any, get, post};
use axum::{Extension, Json, Router};
use std::sync::Arc;
use std::time::Duration;
use tokio::sync::{Mutex, Semaphore};
use tokio::time::timeout;
use tower_service::Service;

/// Largest number of open homes (our choice): each has a thread, and a run at its start.
const MOST_OPEN: usize = 16;

/// Longest time that a card of a home waits for others to be opened or closed (our choice).
const LONGEST_WAIT_FOR_OTHERS: Duration = Duration::from_secs(3);

#[derive(Clone)]
pub struct OpenHomes {
    library: Library,
    guard: Guard,
    pages: Arc<Semaphore>,
    /// By the last request, the latest last.
    open: Arc<Mutex<Vec<HomeRoutes>>>,
}

#[derive(Clone)]
struct HomeRoutes {
    name: String,
    home: OpenHome,
    routes: Router,
}

impl OpenHomes {
    pub fn new(library: Library, guard: Guard, pages: Arc<Semaphore>) -> OpenHomes {
        OpenHomes { library, guard, pages, open: Arc::default() }
    }

    pub fn routes(self) -> Router {
        Router::new()
            .route("/", get(async || Redirect::temporary(FIRST_PAGE)))
            .route("/api/library", get(answer(json, |homes: &OpenHomes, (), _| Ok(homes.library.view()))))
            .route(
                "/api/library/homes/{name}",
                get(card).delete(delete).post(answer(
                    json,
                    |homes: &OpenHomes, (Path(name), Json(from)): (Path<String>, Json<NewHome>), _| {
                        homes.library.begin(&name, &from)
                    },
                )),
            )
            .route("/api/library/homes/{name}/name", post(rename))
            .route(
                "/api/library/homes/{name}/copy",
                post(answer(json, |homes: &OpenHomes, (Path(name), Json(to)): (Path<String>, Json<CallHome>), _| {
                    homes.library.duplicate(&name, &to.name)
                })),
            )
            .route(
                "/api/library/homes/{name}/runs/{run}",
                get(answer(json, |homes: &OpenHomes, Path((name, run)): Path<(String, String)>, _| {
                    homes.library.picture(&name, &run)
                })),
            )
            .route("/api/library/plans/{name}", post(import))
            .route("/api/library/logs/{name}/{file}", post(from_log))
            .route(
                "/api/library/put-aside/{key}",
                post(answer(json, |homes: &OpenHomes, Path(key): Path<String>, _| homes.library.restore(&key))),
            )
            .route("/api/homes/{name}/live", get(live))
            .route("/api/homes/{name}/{*rest}", any(of_home))
            .fallback(get(page::file))
            .layer(DefaultBodyLimit::max(LARGEST_BODY_BYTES))
            .with_state(self)
    }

    /// Returns when the files of all runs are complete.
    pub async fn close(&self) {
        for opened in self.open.lock().await.drain(..) {
            let _ = in_background(move || opened.home.close()).await;
        }
    }

    /// The routes of a home, which is opened if necessary.
    async fn opened(&self, name: &str) -> Result<HomeRoutes, RequestError> {
        let mut open = self.open.lock().await;
        if let Some(at) = open.iter().position(|opened| opened.name == name) {
            // The folder of runs may have become a link since the home was opened.
            self.library.has_own_runs(name)?;
            let opened = open.remove(at);
            open.push(opened.clone());
            return Ok(opened);
        }
        let (library, sought) = (self.library.clone(), name.to_owned());
        let folders = in_background(move || library.home(&sought)).await??;
        if open.len() >= MOST_OPEN {
            let idle = open.iter().position(|opened| !opened.home.is_busy());
            let full =
                || RequestError::new(StatusCode::SERVICE_UNAVAILABLE, LibraryMessage::TooManyOpen { limit: MOST_OPEN });
            let idle = open.remove(idle.ok_or_else(full)?);
            in_background(move || idle.home.close()).await?;
        }
        let (guard, pages) = (self.guard.clone(), self.pages.clone());
        let home = in_background(move || OpenHome::open(folders, guard, pages)).await?;
        let home = home.map_err(|why| RequestError::new(StatusCode::INTERNAL_SERVER_ERROR, why))?;
        let opened = HomeRoutes { name: name.to_owned(), routes: home.clone().routes(), home };
        open.push(opened.clone());
        Ok(opened)
    }

    /// Closes a home, and then changes it.
    async fn closed<T: Send + 'static>(
        self,
        name: String,
        change: impl FnOnce(&Library, &str) -> T + Send + 'static,
    ) -> Result<T, RequestError> {
        let mut open = self.open.lock().await;
        let opened = open.iter().position(|opened| opened.name == name).map(|at| open.remove(at));
        let library = self.library;
        in_background(move || {
            if let Some(opened) = opened {
                opened.home.disconnect_pages();
                opened.home.close();
            }
            change(&library, &name)
        })
        .await
    }
}

async fn card(State(homes): State<OpenHomes>, Path(name): Path<String>) -> Response {
    let open = timeout(LONGEST_WAIT_FOR_OTHERS, homes.open.lock()).await.ok();
    let goes_on = open.and_then(|open| open.iter().find(|opened| opened.name == name)?.home.recorded_run());
    let card = move || Ok(CardView { goes_on, ..homes.library.card(&name)? });
    json(in_background(card).await.flatten())
}

async fn import(
    State(homes): State<OpenHomes>,
    Path(name): Path<String>,
    headers: HeaderMap,
    body: Body,
) -> Result<Response, RequestError> {
    let plan = plan_of(&headers, body).await?;
    Ok(json(in_background(move || homes.library.import(&name, &plan.bytes)).await.flatten()))
}

async fn from_log(
    State(homes): State<OpenHomes>,
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
) -> Result<MadeView, RequestError> {
    let body = LogBody::new(headers, body, "homebody new --from-log")?;
    library.is_free(&name)?;
    let hidden = library.hidden()?;
    // The form of a log also follows from the end of its name.
    let is_ending =
        |ending: &&str| (1..=8).contains(&ending.len()) && ending.bytes().all(|byte| byte.is_ascii_alphanumeric());
    let ending = file.rsplit_once('.').map(|(_, ending)| ending).filter(is_ending).unwrap_or("txt");
    let log = hidden.path().join(format!("log.{ending}"));
    body.save(&log, || false).await?;
    let made = in_background(move || {
        let made = library.from_log(&name, &file, &log);
        drop(hidden);
        made
    });
    made.await?
}

async fn rename(State(homes): State<OpenHomes>, Path(name): Path<String>, Json(to): Json<CallHome>) -> Response {
    // An invalid name leaves the home open.
    json(match homes.library.is_free(&to.name) {
        Ok(()) => homes.closed(name, move |library, name| library.rename(name, &to.name)).await.flatten(),
        Err(error) => Err(error),
    })
}

async fn delete(State(homes): State<OpenHomes>, Path(name): Path<String>) -> Response {
    json(homes.closed(name, Library::delete).await.flatten().map(|key| DeletedKey { key }))
}

/// The socket of a page of a home. The home is opened once the page has sent the token.
async fn live(
    State(homes): State<OpenHomes>,
    Extension(client): Extension<ClientConnection>,
    Path(name): Path<String>,
    headers: HeaderMap,
    upgrade: WebSocketUpgrade,
) -> Response {
    let guard = homes.guard.clone();
    socket::upgraded(upgrade, &headers, client, guard, async move |socket, client| match homes.opened(&name).await {
        Ok(opened) => opened.home.show(socket, client).await,
        Err(error) if error.status == StatusCode::NOT_FOUND => socket::close_without_home(socket).await,
        Err(_) => socket::close_for_now(socket).await,
    })
}

/// A request of the page of a home. It gets the answer that a server of that home alone would give.
async fn of_home(
    State(homes): State<OpenHomes>,
    Extension(client): Extension<ClientConnection>,
    Path((name, _)): Path<(String, String)>,
    request: Request,
) -> Result<Response, RequestError> {
    let mut routes = homes.opened(&name).await?.routes;
    let Some(request) = without_home(request, client) else {
        return Ok(StatusCode::NOT_FOUND.into_response());
    };
    Ok(routes.call(request).await.into_response())
}

fn without_home(request: Request, client: ClientConnection) -> Option<Request> {
    let (mut parts, body) = request.into_parts();
    let (_, rest) = parts.uri.path().strip_prefix(HOMES)?.split_once('/')?;
    let query = parts.uri.query().map_or_else(String::new, |query| format!("?{query}"));
    parts.uri = format!("/api/{rest}{query}").parse::<Uri>().ok()?;
    // The parameters of the path are read anew.
    parts.extensions = Extensions::new();
    parts.extensions.insert(client);
    Some(Request::from_parts(parts, body))
}
