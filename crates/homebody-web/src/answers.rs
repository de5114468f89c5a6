//! Answers: computed in threads, sent as JSON or MessagePack.

use crate::messages::PageMessage;
use crate::request_error::RequestError;
use axum::Json;
use axum::body::{Body, Bytes};
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{IntoResponse, Response};
use futures_util::StreamExt;
use homebody_import::MOST_BYTES;
use homebody_simulation::Cancel;
use serde::Serialize;
use std::path::Path;
use tokio::io::AsyncWriteExt;
use tokio::sync::{Semaphore, SemaphorePermit};

/// Runs a function in a thread for blocking work.
pub async fn in_background<T: Send + 'static>(find: impl FnOnce() -> T + Send + 'static) -> Result<T, RequestError> {
    tokio::task::spawn_blocking(find).await.map_err(RequestError::internal)
}

/// Runs a function that is cancelled when the client disconnects.
pub async fn cancellable<T: Send + 'static>(
    find: impl FnOnce(&Cancel) -> T + Send + 'static,
) -> Result<T, RequestError> {
    struct CancelOnDrop(Cancel);
    impl Drop for CancelOnDrop {
        fn drop(&mut self) {
            self.0.cancel();
        }
    }
    // The future of an answer is dropped when its connection ends.
    let guard = CancelOnDrop(Cancel::new());
    let cancel = guard.0.clone();
    in_background(move || find(&cancel)).await
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

/// The announced length of a request's body.
pub fn content_length(headers: &HeaderMap) -> Option<u64> {
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

/// Writes a request's body of at most `most` bytes into a file. False if it was cancelled.
pub async fn save_body(
    body: Body,
    into: &Path,
    (most, too_large): (u64, impl Fn() -> RequestError),
    is_cancelled: impl Fn() -> bool,
) -> Result<bool, RequestError> {
    let mut file = tokio::fs::File::create(into).await.map_err(RequestError::internal)?;
    let (mut parts, mut length) = (body.into_data_stream(), 0);
    while let Some(part) = parts.next().await {
        let Ok(part) = part else {
            return Err(RequestError::new(StatusCode::BAD_REQUEST, PageMessage::LogIncomplete));
        };
        length += part.len() as u64;
        if length > most {
            return Err(too_large());
        }
        if is_cancelled() {
            return Ok(false);
        }
        file.write_all(&part).await.map_err(RequestError::internal)?;
    }
    file.flush().await.map_err(RequestError::internal)?;
    Ok(true)
}
