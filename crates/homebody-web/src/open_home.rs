//! An opened home: the requests of its page, and their answers.

use crate::answers::{LogBody, in_background, json, packed, plan_of};
use crate::drafts::DraftService;
use crate::folders::HomeFolders;
use crate::free_text::FreeTextService;
use crate::guard::{Guard, SOCKET};
use crate::locating::{LocateService, LogHome};
use crate::log_reports::{LogChoice, LogReports};
use crate::messages::PageMessage;
use crate::notes::Notes;
use crate::playback::Playback;
use crate::request_error::{RequestError, not_found, unprocessable};
use crate::stage::Stage;
use crate::wire::LocatingView;
use crate::{answers, client::ClientConnection, page, socket, stored_runs};
use axum::body::Body;
use axum::extract::ws::{WebSocket, WebSocketUpgrade};
use axum::extract::{DefaultBodyLimit, FromRequest, Path, State};
use axum::handler::Handler;
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{IntoResponse, Response};
use axum::routing::{get, post};
use axum::{Extension, Json, Router};
use futures_util::stream::{Stream, try_unfold};
use homebody_core::problem::Diagnostic;
use homebody_core::time::{Interval, RunTime, Span};
use homebody_log::run::places::RECORDING;
use homebody_simulation::Cancel;
use serde::Serialize;
use std::io;
use std::path::PathBuf;
use std::str::FromStr;
use std::sync::Arc;
use tokio::io::{AsyncRead, AsyncReadExt};
use tokio::sync::{Semaphore, watch};

/// Largest size of a page's HTTP request (our choice).
pub const LARGEST_BODY_BYTES: usize = 8 << 20;

/// A home with its run, its stored runs and its drafts.
#[derive(Clone)]
pub struct OpenHome {
    guard: Guard,
    stage: Stage,
    folders: HomeFolders,
    playback: Playback,
    drafts: DraftService,
    locating: LocateService,
    free_text: FreeTextService,
    logs: LogReports,
    notes: Notes,
    pages: Arc<Semaphore>,
    /// The home was renamed or deleted.
    gone: watch::Sender<bool>,
}

impl OpenHome {
    /// Opens a scenario, with its run at its start.
    pub fn open(folders: HomeFolders, guard: Guard, pages: Arc<Semaphore>) -> Result<OpenHome, Diagnostic> {
        let drafts = DraftService::new(folders.clone());
        Ok(OpenHome {
            stage: Stage::open(folders.clone())?,
            playback: Playback::new(folders.clone()),
            free_text: FreeTextService::new(drafts.clone()),
            drafts,
            locating: LocateService::new(folders.clone()),
            logs: LogReports::new(folders.clone()),
            notes: Notes::new(folders.clone()),
            gone: watch::Sender::new(false),
            folders,
            guard,
            pages,
        })
    }

    /// True while a page shows the home, its run plays, a log is located, or a text becomes statements.
    pub fn is_busy(&self) -> bool {
        let works = self.stage.is_playing() || self.locating.is_active() || self.free_text.is_active();
        self.gone.receiver_count() > 0 || works
    }

    pub fn recorded_run(&self) -> Option<String> {
        self.stage.recorded()
    }

    pub fn disconnect_pages(&self) {
        self.gone.send_replace(true);
    }

    /// Returns when all files of its run are complete.
    pub fn close(&self) {
        self.free_text.stop();
        self.stage.close();
        self.locating.close();
    }

    /// Serves the socket of a page that has sent the token, until the page or the home closes.
    pub async fn show(&self, socket: WebSocket, client: ClientConnection) {
        socket::serve(socket, client, &self.pages, &self.stage, self.gone.subscribe()).await;
    }

    pub fn routes(self) -> Router {
        Router::new()
            .route(SOCKET, get(live))
            .route("/api/underlay/picture", get(picture))
            .route("/api/import", post(import))
            .route("/api/runs/{run}/{what}", get(file_of_run))
            .merge(draft_routes())
            .merge(run_routes())
            .merge(log_routes())
            .fallback(get(page::file))
            .layer(DefaultBodyLimit::max(LARGEST_BODY_BYTES))
            .with_state(self)
    }
}

fn draft_routes() -> Router<OpenHome> {
    Router::new()
        .route(
            "/api/files",
            get(answer(json, |home, (), _| Ok(home.drafts.files())))
                .post(answer(json, |home, Json(save), _| home.drafts.save(save).map_err(unprocessable))),
        )
        .route("/api/files/versions", get(answer(json, |home, (), _| Ok(home.drafts.versions()))))
        .route("/api/underlay", get(answer(json, |home, (), _| Ok(home.drafts.underlay()))))
        .route("/api/check", post(answer(json, |home, Json(draft), _| Ok(home.drafts.check(draft)))))
        .route("/api/rename", post(answer(json, |home, Json(rename), _| Ok(home.drafts.rename(rename)))))
        .route("/api/forget", post(answer(json, |home, Json(forget), _| Ok(home.drafts.forget(forget)))))
        .route("/api/mends", post(answer(json, |home, Json(draft), _| Ok(home.drafts.mends(draft)))))
        .route("/api/plan", post(answer(packed, |home, Json(draft), _| Ok(home.drafts.plan(draft)))))
        .route("/api/parts", post(answer(json, |home, Json(draft), _| Ok(home.drafts.parts(draft)))))
        .route("/api/sheet", post(answer(pdf, |home, Json(draft), _| home.drafts.sheet(draft).map_err(unprocessable))))
        .route("/api/beside", post(answer(packed, |home, Json(layouts), _| Ok(home.drafts.compare(layouts)))))
        .route(
            "/api/suggest",
            get(answer(json, |home, (), _| Ok(home.drafts.suggestion_progress())))
                .post(answer(json, |home, Json(asked), cancel| Ok(home.drafts.suggest(asked, cancel)))),
        )
        .route("/api/explain", post(answer(json, |home, Json(asked), _| Ok(home.drafts.explain(asked)))))
        .route("/api/statements", post(answer(json, |home, Json(asked), _| Ok(home.drafts.statements(asked)))))
        .route("/api/statement", post(answer(json, |home, Json(asked), _| Ok(home.drafts.write_statement(asked)))))
        .route(
            "/api/free-text",
            get(answer(json, |home, (), _| Ok(home.free_text.now())))
                .post(answer(json, |home, Json(request), _| home.free_text.begin(request)))
                .delete(answer(json, |home, (), _| Ok(home.free_text.stop()))),
        )
        .route("/api/free-text/routine", post(answer(json, |home, Json(lines), _| home.free_text.accept(&lines))))
        .route("/api/month", post(answer(packed, |home, Json(asked), cancel| Ok(home.drafts.month(asked, cancel)))))
        .route("/api/rows", post(answer(json, |home, Json(draft), cancel| Ok(home.drafts.rows(draft, cancel)))))
        .route("/api/connect", post(answer(json, |home, Json(asked), _| Ok(home.drafts.connect(asked)))))
}

fn run_routes() -> Router<OpenHome> {
    type RunPath = Path<String>;
    Router::new()
        .route("/api/growth", get(answer(json, |home, (), _| Ok(home.stage.live_counts()))))
        .route("/api/runs", get(answer(json, |home, (), _| Ok(home.playback.list()))))
        .route(
            "/api/runs/{run}",
            get(answer(shared_json, |home, Path(run): RunPath, _| home.playback.run(&run))).delete(answer(
                json,
                |home, Path(run): RunPath, _| {
                    if home.stage.recorded().as_ref() == Some(&run) {
                        return Err(RequestError::new(StatusCode::CONFLICT, PageMessage::RunRunning));
                    }
                    stored_runs::delete(&home.folders, &run)
                },
            )),
        )
        .route(
            "/api/put-aside/{key}",
            post(answer(json, |home, Path(key): Path<String>, _| stored_runs::restore(&home.folders, &key))),
        )
        .route(
            "/api/runs/{run}/about",
            post(answer(json, |home, (Path(run), Json(about)): (RunPath, _), _| {
                stored_runs::set_about(&home.folders, &run, about)
            })),
        )
        .route(
            "/api/runs/{run}/days/{day}",
            get(answer(packed, |home, Path((run, day)): Path<(String, String)>, _| {
                home.playback.day(&run, number(&day)?)
            })),
        )
        .route(
            "/api/runs/{run}/days/{day}/from/{from}",
            get(answer(packed, |home, Path((run, day, from)): Path<(String, String, String)>, _| {
                home.playback.rest_of_day(&run, number(&day)?, RunTime::from_micros(number(&from)?))
            })),
        )
        .route(
            "/api/runs/{run}/find",
            post(answer(json, |home, (Path(run), Json(asked)): (RunPath, _), cancel| {
                home.playback.find(&run, &asked, cancel, || home.logs.care(&run).map(|care| care.episodes))
            })),
        )
        .route(
            "/api/runs/{run}/silhouettes/{from}/{to}/{every}",
            get(answer(packed, |home, Path((run, from, to, every)): Path<(String, String, String, String)>, _| {
                let [from, to] = [number(&from)?, number(&to)?].map(RunTime::from_micros);
                home.playback.silhouettes(&run, Interval::new(from, to), Span::from_micros(number(&every)?))
            })),
        )
        .route("/api/runs/{run}/lanes", get(answer(packed, |home, Path(run): RunPath, _| home.playback.lanes(&run))))
        .route("/api/runs/{run}/reading", get(answer(json, |home, Path(run): RunPath, _| home.playback.reading(&run))))
        .route("/api/runs/{run}/care", get(answer(json, |home, Path(run): RunPath, _| home.logs.care(&run))))
        .route(
            "/api/runs/{run}/notes",
            get(answer(json, |home, Path(run): RunPath, _| home.notes.all(&run)))
                .post(answer(json, |home, (Path(run), Json(note)): (RunPath, _), _| home.notes.note(&run, note))),
        )
        .route("/api/runs/{run}/look", get(answer(page_text, |home, Path(run): RunPath, _| home.logs.look(&run))))
        .route(
            "/api/runs/{run}/realism/{beside}",
            get(answer(page_text, |home, Path((run, other)): Path<(String, String)>, _| {
                // A located log is compared with the run that was simulated from it.
                let which = if run == other { LogChoice::Own } else { LogChoice::Given };
                home.logs.realism((&run, LogChoice::Given), (&other, which))
            })),
        )
}

fn log_routes() -> Router<OpenHome> {
    Router::new()
        .route(
            "/api/walk",
            get(answer(json, |home, (), _| Ok(home.locating.now()))).delete(answer(json, |home, (), _| {
                home.locating.stop();
                Ok(home.locating.now())
            })),
        )
        .route("/api/logs", get(answer(json, |home, (), _| Ok(home.logs.kept()))))
        .route("/api/logs/{log}", post(keep))
        .route("/api/walk/{log}", post(locate))
        .route("/api/walk/{log}/{run}", post(locate_in_home_of))
}

/// As in [`answers`], where this type of the state cannot be inferred.
fn answer<E, M, T>(
    form: fn(Result<T, RequestError>) -> Response,
    find: fn(&OpenHome, E, &Cancel) -> Result<T, RequestError>,
) -> impl Handler<(M, State<OpenHome>, E), OpenHome>
where
    E: FromRequest<OpenHome, M> + Send + 'static,
    M: Send + 'static,
    T: 'static,
{
    answers::answer(form, find)
}

fn number<T: FromStr>(text: &str) -> Result<T, RequestError> {
    text.parse().map_err(|_| not_found(PageMessage::Number))
}

fn shared_json<T: Serialize>(found: Result<Arc<T>, RequestError>) -> Response {
    found.map_or_else(RequestError::into_response, |found| Json(&*found).into_response())
}

fn pdf(found: Result<Vec<u8>, RequestError>) -> Response {
    typed("application/pdf", found)
}

/// A page as a command writes it. Sent as HTML, the policy of the server would leave it without style.
fn page_text(found: Result<String, RequestError>) -> Response {
    typed("text/plain; charset=utf-8", found)
}

fn typed(kind: &'static str, found: Result<impl IntoResponse, RequestError>) -> Response {
    found.map_or_else(RequestError::into_response, |found| ([(header::CONTENT_TYPE, kind)], found).into_response())
}

async fn live(
    State(home): State<OpenHome>,
    Extension(client): Extension<ClientConnection>,
    headers: HeaderMap,
    upgrade: WebSocketUpgrade,
) -> Response {
    let guard = home.guard.clone();
    socket::upgraded(upgrade, &headers, client, guard, async move |socket, client| home.show(socket, client).await)
}

async fn picture(State(home): State<OpenHome>) -> Result<Response, RequestError> {
    download(move || home.folders.picture(&home.drafts.underlay()?.picture), PageMessage::NoImage).await
}

/// A plan of another program, as the bytes of its file.
async fn import(State(home): State<OpenHome>, headers: HeaderMap, body: Body) -> Result<Response, RequestError> {
    let plan = plan_of(&headers, body).await?;
    Ok(json(in_background(move || home.drafts.import(&plan.bytes).map_err(unprocessable)).await.flatten()))
}

/// A log, as the bytes of its file, that is stored without a home.
async fn keep(State(home): State<OpenHome>, Path(log): Path<String>, headers: HeaderMap, body: Body) -> Response {
    json(take_log(home.locating, (log, LogHome::Unknown), &headers, body).await)
}

/// A log that is located in the home of the scenario.
async fn locate(State(home): State<OpenHome>, Path(log): Path<String>, headers: HeaderMap, body: Body) -> Response {
    json(take_log(home.locating, (log, LogHome::Scenario), &headers, body).await)
}

/// A log that is located in the home of a stored run.
async fn locate_in_home_of(
    State(home): State<OpenHome>,
    Path((log, run)): Path<(String, String)>,
    headers: HeaderMap,
    body: Body,
) -> Response {
    json(take_log(home.locating, (log, LogHome::Run(run)), &headers, body).await)
}

async fn take_log(
    locating: LocateService,
    (log, home): (String, LogHome),
    headers: &HeaderMap,
    body: Body,
) -> Result<Option<LocatingView>, RequestError> {
    let body = LogBody::new(headers, body, "homebody locate")?;
    let incoming = locating.begin(&log, home)?;
    if body.save(&incoming.file(), || incoming.is_cancelled()).await? {
        incoming.locate();
    }
    Ok(locating.now())
}

async fn file_of_run(
    State(home): State<OpenHome>,
    Path((run, what)): Path<(String, String)>,
) -> Result<Response, RequestError> {
    let find = move || match what.as_str() {
        "log" => home.playback.log_of(&run),
        "recording" => home.folders.file_of_run(&run, RECORDING),
        _ => None,
    };
    download(find, PageMessage::NoFile).await
}

async fn download(
    find: impl FnOnce() -> Option<PathBuf> + Send + 'static,
    otherwise: PageMessage,
) -> Result<Response, RequestError> {
    let path = in_background(find).await?.ok_or_else(|| not_found(otherwise))?;
    let file = tokio::fs::File::open(&path).await.map_err(RequestError::internal)?;
    let length = file.metadata().await.map_err(RequestError::internal)?.len();
    let name = path.file_name().unwrap_or_default().to_string_lossy().replace(['"', '\\'], "_");
    let head = [
        (header::CONTENT_TYPE, "application/octet-stream".to_owned()),
        (header::CONTENT_DISPOSITION, format!("attachment; filename=\"{name}\"")),
        (header::CONTENT_LENGTH, length.to_string()),
    ];
    Ok((head, Body::from_stream(chunks(file.take(length)))).into_response())
}

/// The bytes of a file in chunks: a log may be larger than memory.
fn chunks(file: impl AsyncRead + Unpin) -> impl Stream<Item = io::Result<Vec<u8>>> {
    try_unfold(file, |mut file| async move {
        let mut chunk = vec![0; 1 << 16];
        let length = file.read(&mut chunk).await?;
        chunk.truncate(length);
        Ok((length > 0).then_some((chunk, file)))
    })
}
