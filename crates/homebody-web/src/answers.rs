//! How answers are made: by threads for what takes its time, in JSON or MessagePack.

use crate::messages::PageMessage;
use crate::refusal::{Refusal, sentence};
use crate::wire::RefusedView;
use axum::Json;
use axum::body::{Body, Bytes};
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{IntoResponse, Response};
use futures_util::StreamExt;
use homebody_core::problem::{Diagnose, Diagnostic};
use homebody_import::MOST_BYTES;
use homebody_simulation::Cancel;
use serde::Serialize;
use std::fmt::Display;
use std::path::Path;
use tokio::io::AsyncWriteExt;
use tokio::sync::{Semaphore, SemaphorePermit};

/// A refused request: the status of HTTP, and the message.
#[derive(Debug)]
pub struct Refused {
    pub status: StatusCode,
    message: Diagnostic,
}

impl Refused {
    /// A request refused with a message.
    pub fn of(status: StatusCode, message: impl Diagnose) -> Refused {
        Refused { status, message: message.diagnostic() }
    }

    /// A request refused because of an error of the system.
    pub fn failed(error: impl Display) -> Refused {
        Refused::of(StatusCode::INTERNAL_SERVER_ERROR, PageMessage::System { why: error.to_string() })
    }
}

impl IntoResponse for Refused {
    fn into_response(self) -> Response {
        let what = sentence(&self.message);
        let Diagnostic { code, data, .. } = self.message;
        let code = (!code.is_empty()).then(|| code.to_owned());
        (self.status, Json(RefusedView { code, what, data })).into_response()
    }
}

/// Why a thing that is stored is not told.
pub fn refused(refusal: Refusal) -> Refused {
    let (status, message) = match refusal {
        Refusal::Unknown(message) => (StatusCode::NOT_FOUND, message),
        Refusal::Damaged(message) => (StatusCode::UNPROCESSABLE_ENTITY, message),
        Refusal::Early(message) => (StatusCode::SERVICE_UNAVAILABLE, message),
    };
    Refused { status, message }
}

/// What a thread for work that takes its time has found.
pub async fn found<T: Send + 'static>(find: impl FnOnce() -> T + Send + 'static) -> Result<T, Refused> {
    tokio::task::spawn_blocking(find).await.map_err(Refused::failed)
}

/// The same for work that stops when nobody waits for it any more.
pub async fn found_while_waited_for<T: Send + 'static>(
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

pub fn json(found: Result<impl Serialize, Refused>) -> Response {
    found.map_or_else(Refused::into_response, |found| Json(found).into_response())
}

/// In MessagePack, for what is large.
pub fn packed(found: Result<impl Serialize, Refused>) -> Response {
    let pack = |found| match rmp_serde::to_vec_named(&found) {
        Ok(bytes) => ([(header::CONTENT_TYPE, "application/msgpack")], bytes).into_response(),
        Err(error) => Refused::failed(error).into_response(),
    };
    found.map_or_else(Refused::into_response, pack)
}

/// How long a request's body is to be, if that is told.
pub fn told_length(headers: &HeaderMap) -> Option<u64> {
    headers.get(header::CONTENT_LENGTH)?.to_str().ok()?.parse().ok()
}

/// Largest number of plans at once: each is in memory until it is read.
const MOST_PLANS: usize = 2;

/// The places for plans; a later plan waits for one.
static PLANS: Semaphore = Semaphore::const_new(MOST_PLANS);

/// A plan of another program, and a place among those that are taken at once, which is free again when this is dropped.
pub struct PlanBytes {
    pub bytes: Bytes,
    _turn: SemaphorePermit<'static>,
}

/// The bytes of a plan of another program.
pub async fn plan_of(headers: &HeaderMap, body: Body) -> Result<PlanBytes, Refused> {
    let too_large =
        || Refused::of(StatusCode::PAYLOAD_TOO_LARGE, PageMessage::PlanTooLarge { limit_mb: MOST_BYTES >> 20 });
    if told_length(headers).is_some_and(|length| length > MOST_BYTES) {
        return Err(too_large());
    }
    let closed = |error| Refused { status: StatusCode::SERVICE_UNAVAILABLE, ..Refused::failed(error) };
    let turn = PLANS.acquire().await.map_err(closed)?;
    let bytes = axum::body::to_bytes(body, MOST_BYTES as usize).await.map_err(|_| too_large())?;
    Ok(PlanBytes { bytes, _turn: turn })
}

/// Writes what comes into a file, up to so many bytes; false where nobody wants it any more.
pub async fn received(
    body: Body,
    into: &Path,
    (most, too_large): (u64, impl Fn() -> Refused),
    is_cancelled: impl Fn() -> bool,
) -> Result<bool, Refused> {
    let mut file = tokio::fs::File::create(into).await.map_err(Refused::failed)?;
    let (mut parts, mut length) = (body.into_data_stream(), 0);
    while let Some(part) = parts.next().await {
        let Ok(part) = part else {
            return Err(Refused::of(StatusCode::BAD_REQUEST, PageMessage::LogIncomplete));
        };
        length += part.len() as u64;
        if length > most {
            return Err(too_large());
        }
        if is_cancelled() {
            return Ok(false);
        }
        file.write_all(&part).await.map_err(Refused::failed)?;
    }
    file.flush().await.map_err(Refused::failed)?;
    Ok(true)
}
