//! An opened home: what its page asks, and who answers.

use crate::answers::{Refused, found, found_while_waited_for, json, packed, plan_of, received, refused, told_length};
use crate::desk::Desk;
use crate::guard::{Guard, SOCKET};
use crate::messages::PageMessage;
use crate::notes::{Notes, Unnoted};
use crate::playback::Playback;
use crate::refusal::Refusal;
use crate::shelf::Shelf;
use crate::stage::Stage;
use crate::told::{Logs, Which};
use crate::visit::Visit;
use crate::walks::{HomeOf, LARGEST_LOG_BYTES, Unwalked, Walks};
use crate::wire::{
    Connect, Draft, Explain, Find, Forget, Layouts, Month, NoteIt, Rename, RunAbout, Save, Suggest, WalkingView,
};
use crate::{keeping, page, socket};
use axum::body::Body;
use axum::extract::ws::{WebSocket, WebSocketUpgrade};
use axum::extract::{DefaultBodyLimit, Path, State};
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{IntoResponse, Response};
use axum::routing::{get, post};
use axum::{Extension, Json, Router};
use futures_util::stream::{Stream, try_unfold};
use homebody_core::problem::{Diagnose, Diagnostic};
use homebody_core::time::{Interval, RunTime, Span};
use homebody_log::run::places::RECORDING;
use homebody_simulation::Cancel;
use std::io;
use std::path::PathBuf;
use std::sync::Arc;
use tokio::io::{AsyncRead, AsyncReadExt};
use tokio::sync::{Semaphore, watch};

/// Largest size of a page's HTTP request (our choice).
pub const LARGEST_BODY_BYTES: usize = 8 << 20;

/// What answers are made from.
#[derive(Clone)]
pub struct House {
    guard: Guard,
    stage: Stage,
    shelf: Shelf,
    playback: Playback,
    desk: Desk,
    walks: Walks,
    logs: Logs,
    notes: Notes,
    pages: Arc<Semaphore>,
    /// Whether it has another name now, or none.
    gone: watch::Sender<bool>,
}

impl House {
    /// Opens a scenario, with its run at its start.
    pub fn open(shelf: Shelf, guard: Guard, pages: Arc<Semaphore>) -> Result<House, Diagnostic> {
        Ok(House {
            stage: Stage::open(shelf.clone())?,
            playback: Playback::new(shelf.clone()),
            desk: Desk::new(shelf.clone()),
            walks: Walks::new(shelf.clone()),
            logs: Logs::new(shelf.clone()),
            notes: Notes::new(shelf.clone()),
            gone: watch::Sender::new(false),
            shelf,
            guard,
            pages,
        })
    }

    /// Whether a page looks at it, or it is doing something.
    pub fn is_busy(&self) -> bool {
        self.gone.receiver_count() > 0 || self.stage.is_playing() || self.walks.is_going_on()
    }

    /// The run of it that is being lived.
    pub fn goes_on(&self) -> Option<String> {
        self.stage.recorded()
    }

    /// Tells who looks at it that it is not here any more.
    pub fn send_away(&self) {
        self.gone.send_replace(true);
    }

    /// Comes back when all files of its run are complete.
    pub fn close(&self) {
        self.stage.close();
        self.walks.close();
    }

    /// Shows what there is to be seen to a page that has said the token, until it goes or the home does.
    pub async fn show(&self, socket: WebSocket, visit: Visit) {
        socket::serve(socket, visit, &self.pages, &self.stage, self.gone.subscribe()).await;
    }

    /// What its page may ask.
    pub fn routes(self) -> Router {
        routes(self)
    }
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
        .route("/api/parts", post(parts))
        .route("/api/sheet", post(sheet))
        .route("/api/beside", post(beside))
        .route("/api/suggest", get(suggested).post(suggest))
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
        .route("/api/runs/{run}/silhouettes/{from}/{to}/{every}", get(silhouettes))
        .route("/api/runs/{run}/lanes", get(lanes))
        .route("/api/runs/{run}/reading", get(reading))
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
        .with_state(house)
}

async fn live(
    State(house): State<House>,
    Extension(visit): Extension<Visit>,
    headers: HeaderMap,
    upgrade: WebSocketUpgrade,
) -> Response {
    let guard = house.guard.clone();
    socket::upgraded(upgrade, &headers, visit, guard, async move |socket, visit| house.show(socket, visit).await)
}

async fn files(State(house): State<House>) -> Response {
    json(found(move || house.desk.files()).await)
}

async fn underlay(State(house): State<House>) -> Response {
    json(found(move || house.desk.underlay()).await)
}

/// The picture below the plan.
async fn picture(State(house): State<House>) -> Response {
    download(move || house.shelf.picture(&house.desk.underlay()?.picture), PageMessage::NoImage).await
}

async fn versions(State(house): State<House>) -> Response {
    json(found(move || house.desk.versions()).await)
}

async fn save(State(house): State<House>, Json(save): Json<Save>) -> Response {
    json(found(move || house.desk.save(save)).await.and_then(|saved| saved.map_err(unprocessable)))
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

/// What is put up by a draft.
async fn parts(State(house): State<House>, Json(draft): Json<Draft>) -> Response {
    json(found(move || house.desk.parts(draft)).await)
}

/// Sheets to print.
async fn sheet(State(house): State<House>, Json(draft): Json<Draft>) -> Response {
    let bytes = found(move || house.desk.sheet(draft)).await.and_then(|bytes| bytes.map_err(unprocessable));
    bytes.map_or_else(Refused::into_response, |bytes| {
        ([(header::CONTENT_TYPE, "application/pdf")], bytes).into_response()
    })
}

async fn beside(State(house): State<House>, Json(layouts): Json<Layouts>) -> Response {
    packed(found(move || house.desk.beside(layouts)).await)
}

async fn suggest(State(house): State<House>, Json(asked): Json<Suggest>) -> Response {
    json(found_while_waited_for(move |cancel| house.desk.suggest(asked, cancel)).await)
}

/// How far a suggestion is.
async fn suggested(State(house): State<House>) -> Response {
    json(Ok(house.desk.suggested()))
}

/// A plan of another program, as its file's bytes.
async fn import(State(house): State<House>, headers: HeaderMap, body: Body) -> Response {
    let plan = match plan_of(&headers, body).await {
        Ok(plan) => plan,
        Err(refused) => return refused.into_response(),
    };
    json(found(move || house.desk.import(&plan.bytes)).await.and_then(|made| made.map_err(unprocessable)))
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
        return Refused::of(StatusCode::NOT_FOUND, PageMessage::Number).into_response();
    };
    packed(found(move || house.playback.day(&run, day)).await.and_then(|day| day.map_err(refused)))
}

/// What a day's answer had no time for: movements from an instant on.
async fn rest_of_day(State(house): State<House>, Path((run, day, from)): Path<(String, String, String)>) -> Response {
    let (Ok(day), Ok(from)) = (day.parse(), from.parse().map(RunTime::from_micros)) else {
        return Refused::of(StatusCode::NOT_FOUND, PageMessage::Number).into_response();
    };
    packed(found(move || house.playback.rest_of_day(&run, day, from)).await.and_then(|day| day.map_err(refused)))
}

/// What is looked for over a whole stored run.
async fn find(State(house): State<House>, Path(run): Path<String>, Json(asked): Json<Find>) -> Response {
    let look = move |cancel: &Cancel| {
        house.playback.find(&run, &asked, cancel, || house.logs.care(&run).map(|care| care.alerts))
    };
    json(found_while_waited_for(look).await.and_then(|found| found.map_err(refused)))
}

/// What cameras of a stored run have kept from an instant to another, of instants so far apart.
async fn silhouettes(
    State(house): State<House>,
    Path((run, from, to, every)): Path<(String, String, String, String)>,
) -> Response {
    let instant = |text: &str| text.parse().map(RunTime::from_micros);
    let (Ok(from), Ok(to), Ok(every)) = (instant(&from), instant(&to), every.parse().map(Span::from_micros)) else {
        return Refused::of(StatusCode::NOT_FOUND, PageMessage::Number).into_response();
    };
    let span = Interval::new(from, to);
    packed(found(move || house.playback.film(&run, span, every)).await.and_then(|film| film.map_err(refused)))
}

/// How far the log of a stored run is read.
async fn reading(State(house): State<House>, Path(run): Path<String>) -> Response {
    json(found(move || house.playback.reading(&run)).await.and_then(|reading| reading.map_err(refused)))
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
    if house.stage.recorded().as_ref() == Some(&run) {
        return Refused::of(StatusCode::CONFLICT, PageMessage::RunRunning).into_response();
    }
    json(found(move || keeping::put_aside(&house.shelf, &run)).await.and_then(|aside| aside.map_err(refused)))
}

async fn fetch_back(State(house): State<House>, Path(key): Path<String>) -> Response {
    json(found(move || keeping::fetch_back(&house.shelf, &key)).await.and_then(|run| run.map_err(refused)))
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
        Unnoted::Changed(why) => Refused::of(StatusCode::CONFLICT, why),
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
        let (limit_mb, command) = (LARGEST_LOG_BYTES >> 20, "homebody locate");
        Refused::of(StatusCode::PAYLOAD_TOO_LARGE, PageMessage::LogTooLarge { limit_mb, command })
    };
    if told_length(headers).is_some_and(|length| length > LARGEST_LOG_BYTES) {
        return Err(too_large());
    }
    let coming = walks.begin(&log, home).map_err(|why| match why {
        Unwalked::Busy(log) => Refused::of(StatusCode::CONFLICT, PageMessage::Locating { log }),
        Unwalked::NoPlace(error) => Refused::failed(error),
    })?;
    let whole = received(body, &coming.file(), (LARGEST_LOG_BYTES, too_large), || coming.is_cancelled()).await?;
    if !whole {
        return Ok(walks.now());
    }
    coming.walk();
    Ok(walks.now())
}

/// A file of a stored run, as a download.
async fn file_of_run(State(house): State<House>, Path((run, what)): Path<(String, String)>) -> Response {
    let find = move || match what.as_str() {
        "log" => house.playback.log_of(&run),
        "recording" => house.shelf.file_of_run(&run, RECORDING),
        _ => None,
    };
    download(find, PageMessage::NoFile).await
}

/// A request refused because of its contents, or because of a file.
fn unprocessable(message: impl Diagnose) -> Refused {
    Refused::of(StatusCode::UNPROCESSABLE_ENTITY, message)
}

/// A file, as a download.
async fn download(find: impl FnOnce() -> Option<PathBuf> + Send + 'static, otherwise: PageMessage) -> Response {
    let path = match found(find).await {
        Ok(Some(path)) => path,
        Ok(None) => return Refused::of(StatusCode::NOT_FOUND, otherwise).into_response(),
        Err(refused) => return refused.into_response(),
    };
    let failed = |error: io::Error| Refused::failed(error).into_response();
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
