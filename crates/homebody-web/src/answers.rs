//! Answers: computed in threads, sent as JSON or MessagePack.

use crate::locating::LARGEST_LOG_BYTES;
use crate::messages::PageMessage;
use crate::request_error::RequestError;
use axum::Json;
use axum::body::{Body, Bytes};
use axum::extract::{FromRequest, State};
use axum::handler::Handler;
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{IntoResponse, Response};
use futures_util::StreamExt;
use homebody_import::MOST_BYTES;
use homebody_simulation::Cancel;
use serde::Serialize;
use std::any::Any;
use std::path::Path;
use std::sync::Arc;
use tokio::io::AsyncWriteExt;
use tokio::sync::{Semaphore, SemaphorePermit};

/// Runs a function in a thread for blocking work.
pub async fn in_background<T: Send + 'static>(find: impl FnOnce() -> T + Send + 'static) -> Result<T, RequestError> {
    // With one type for all functions, the task of the thread is compiled once.
    let find: Box<dyn FnOnce() -> Box<dyn Any + Send> + Send> = Box::new(move || Box::new(find()));
    let found = tokio::task::spawn_blocking(find).await.map_err(RequestError::internal)?;
    found.downcast().map(|found| *found).map_err(|_| RequestError::internal("an answer has the wrong type"))
}

/// A function that answers the requests of a route. It is cancelled when the client disconnects.
type Answer<S, E> = Arc<dyn Fn(&S, E, &Cancel) -> Response + Send + Sync>;

/// A handler that calls a function in a thread of its own and answers in a form such as [`json`].
pub fn answer<S, E, M, T>(
    form: fn(Result<T, RequestError>) -> Response,
    find: fn(&S, E, &Cancel) -> Result<T, RequestError>,
) -> impl Handler<(M, State<S>, E), S>
where
    S: Clone + Send + Sync + 'static,
    E: FromRequest<S, M> + Send + 'static,
    M: Send + 'static,
    T: 'static,
{
    handler(Arc::new(move |state, asked, cancel| form(find(state, asked, cancel))))
}

/// The same handler for all routes with the same parts of a request, so that it is compiled once for them.
fn handler<S, E, M>(find: Answer<S, E>) -> impl Handler<(M, State<S>, E), S>
where
    S: Clone + Send + Sync + 'static,
    E: FromRequest<S, M> + Send + 'static,
    M: Send + 'static,
{
    struct CancelOnDrop(Cancel);
    impl Drop for CancelOnDrop {
        fn drop(&mut self) {
            self.0.cancel();
        }
    }
    move |State(state): State<S>, asked: E| async move {
        // The future of an answer is dropped when its connection ends.
        let guard = CancelOnDrop(Cancel::new());
        let cancel = guard.0.clone();
        in_background(move || find(&state, asked, &cancel)).await.unwrap_or_else(RequestError::into_response)
    }
}

pub fn json<T: Serialize>(found: Result<T, RequestError>) -> Response {
    found.map_or_else(RequestError::into_response, |found| Json(found).into_response())
}

/// MessagePack, for large answers.
pub fn packed<T: Serialize>(found: Result<T, RequestError>) -> Response {
    let pack = |found: T| match rmp_serde::to_vec_named(&found) {
        Ok(bytes) => ([(header::CONTENT_TYPE, "application/msgpack")], bytes).into_response(),
        Err(error) => RequestError::internal(error).into_response(),
    };
    found.map_or_else(RequestError::into_response, pack)
}

fn content_length(headers: &HeaderMap) -> Option<u64> {
    headers.get(header::CONTENT_LENGTH)?.to_str().ok()?.parse().ok()
}

/// Largest number of plans at once: each is in memory until it is read.
const MOST_PLANS: usize = 2;

/// The places for plans; a later plan waits for one.
static PLANS: Semaphore = Semaphore::const_new(MOST_PLANS);

/// A plan of another program. It takes one of the places for plans until it is dropped.
pub struct PlanBytes {
    pub bytes: Bytes,
    _turn: SemaphorePermit<'static>,
}

pub async fn plan_of(headers: &HeaderMap, body: Body) -> Result<PlanBytes, RequestError> {
    let too_large =
        || RequestError::new(StatusCode::PAYLOAD_TOO_LARGE, PageMessage::PlanTooLarge { limit_mb: MOST_BYTES >> 20 });
    if content_length(headers).is_some_and(|length| length > MOST_BYTES) {
        return Err(too_large());
    }
    let closed = |error| RequestError { status: StatusCode::SERVICE_UNAVAILABLE, ..RequestError::internal(error) };
    let turn = PLANS.acquire().await.map_err(closed)?;
    let bytes = axum::body::to_bytes(body, MOST_BYTES as usize).await.map_err(|_| too_large())?;
    Ok(PlanBytes { bytes, _turn: turn })
}

pub struct LogBody {
    body: Body,
    /// The command for larger logs.
    command: &'static str,
}

impl LogBody {
    /// Refuses a log whose announced length is too large.
    pub fn new(headers: &HeaderMap, body: Body, command: &'static str) -> Result<LogBody, RequestError> {
        let log = LogBody { body, command };
        match content_length(headers) {
            Some(length) if length > LARGEST_LOG_BYTES => Err(log.too_large()),
            _ => Ok(log),
        }
    }

    fn too_large(&self) -> RequestError {
        let (limit_mb, command) = (LARGEST_LOG_BYTES >> 20, self.command);
        RequestError::new(StatusCode::PAYLOAD_TOO_LARGE, PageMessage::LogTooLarge { limit_mb, command })
    }

    /// Writes the log into a file. False if it was cancelled.
    pub async fn save(mut self, into: &Path, is_cancelled: impl Fn() -> bool) -> Result<bool, RequestError> {
        let mut file = tokio::fs::File::create(into).await.map_err(RequestError::internal)?;
        let (mut parts, mut length) = (std::mem::take(&mut self.body).into_data_stream(), 0);
        while let Some(part) = parts.next().await {
            let Ok(part) = part else {
                return Err(RequestError::new(StatusCode::BAD_REQUEST, PageMessage::LogIncomplete));
            };
            length += part.len() as u64;
            if length > LARGEST_LOG_BYTES {
                return Err(self.too_large());
            }
            if is_cancelled() {
                return Ok(false);
            }
            file.write_all(&part).await.map_err(RequestError::internal)?;
        }
        file.flush().await.map_err(RequestError::internal)?;
        Ok(true)
    }
}
