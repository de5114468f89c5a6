//! One page's socket: what it says goes to the stage, and what there is to be seen comes back.
//!
//! A page that does not read holds up nobody: the next picture is made when the one before has gone out.

use crate::answers::Refused;
use crate::guard::Guard;
use crate::messages::{PageMessage, StageMessage};
use crate::refusal::note;
use crate::stage::{Seen, Stage, Voice};
use crate::visit::Visit;
use crate::wire::Say;
use axum::extract::ws::{CloseFrame, Message, WebSocket, WebSocketUpgrade};
use axum::http::{HeaderMap, StatusCode};
use axum::response::{IntoResponse, Response};
use futures_util::StreamExt;
use futures_util::stream::{SplitSink, SplitStream};
use homebody_core::problem::Diagnose;
use std::time::Duration;
use tokio::sync::{Semaphore, watch};
use tokio::time::{Instant, interval, sleep_until, timeout};

/// Largest size of a page's message (our choice).
const LONGEST_MESSAGE_BYTES: usize = 64 << 10;

/// No page sees more pictures than sixty a second.
const FRAME: Duration = Duration::from_micros(16_000);

/// Largest number of rows with a picture (our choice): as many as a table shows.
const MOST_ROWS: usize = 500;

/// Time within which a page has to send the token (our choice).
const LONGEST_HELLO: Duration = Duration::from_secs(10);

/// What a socket is closed with whose token is wrong.
const WRONG_TOKEN: u16 = 4401;

/// What a socket is closed with where too many pages look already: it may try again later.
const TOO_MANY: u16 = 1013;

/// What a socket is closed with whose home is not there, or not any more.
const NO_HOME: u16 = 4404;

/// Time without reading after which a page is disconnected (our choice).
const LONGEST_UNREAD: Duration = Duration::from_secs(900);

/// Takes a socket of our own page, which is shown what there is once it has said the token.
pub fn upgraded<F: Future<Output = ()> + Send>(
    upgrade: WebSocketUpgrade,
    headers: &HeaderMap,
    visit: Visit,
    guard: Guard,
    show: impl FnOnce(WebSocket, Visit) -> F + Send + 'static,
) -> Response {
    if !guard.is_socket_from_us(headers) {
        return Refused::of(StatusCode::FORBIDDEN, PageMessage::ForeignPage).into_response();
    }
    let upgrade = upgrade.max_message_size(LONGEST_MESSAGE_BYTES).max_frame_size(LONGEST_MESSAGE_BYTES);
    upgrade.on_upgrade(async move |socket| {
        let shown = async {
            if let Some(socket) = let_in(socket, &visit, &guard).await {
                show(socket, visit.clone()).await;
            }
        };
        tokio::select! {
            () = shown => {}
            () = visit.sent_away() => {}
        }
    })
}

/// Serves a page that was let in until it goes, or its home does. It takes one of `pages`.
pub async fn serve(socket: WebSocket, visit: Visit, pages: &Semaphore, stage: &Stage, mut gone: watch::Receiver<bool>) {
    let Ok(_place) = pages.try_acquire() else { return close_for_now(socket).await };
    visit.mark_page();
    let held = Held { voice: Some(stage.voice()), keys: false };
    let (mut out, mut heard) = socket.split();
    // The page is gone when either side of it is.
    let is_home_gone = tokio::select! {
        _ = talk(&mut out, &mut heard, stage, held) => false,
        // Who tells lives as long as this.
        _ = gone.wait_for(|gone| *gone) => true,
    };
    if let (true, Ok(socket)) = (is_home_gone, out.reunite(heard)) {
        close_without_home(socket).await;
    }
}

/// Tells a page that there is no such home, or not any more.
pub async fn close_without_home(socket: WebSocket) {
    close(socket, NO_HOME, "this home does not exist").await;
}

/// Tells a page that it may try again later.
pub async fn close_for_now(socket: WebSocket) {
    close(socket, TOO_MANY, "too many pages are open").await;
}

/// The socket again once its page has said the token; else it is closed.
async fn let_in(mut socket: WebSocket, visit: &Visit, guard: &Guard) -> Option<WebSocket> {
    let hello = timeout(LONGEST_HELLO, socket.recv()).await;
    let is_known = match &hello {
        Ok(Some(Ok(Message::Text(text)))) => match serde_json::from_str(text) {
            Ok(Say::Hello { token }) => guard.knows(&token, visit),
            _ => false,
        },
        _ => false,
    };
    if is_known {
        return Some(socket);
    }
    guard.delay(visit.from()).await;
    close(socket, WRONG_TOKEN, "the token is missing or wrong").await;
    None
}

async fn close(mut socket: WebSocket, code: u16, reason: &'static str) {
    let _ = socket.send(Message::Close(Some(CloseFrame { code, reason: reason.into() }))).await;
}

/// The voice of a page, and the keys that it holds, which are let go when it goes.
struct Held {
    voice: Option<Voice>,
    keys: bool,
}

impl Held {
    /// False where so much of what the page has said waits that this is not heard.
    fn say(&mut self, say: Say) -> bool {
        let holds = if let Say::Hold { keys } = &say { Some(!keys.is_empty()) } else { None };
        let is_heard = self.voice.as_ref().is_some_and(|voice| voice.say(say));
        // A page that could not let go of a key holds it.
        self.keys = holds.filter(|&holds| is_heard || holds).unwrap_or(self.keys);
        is_heard
    }
}

impl Drop for Held {
    fn drop(&mut self) {
        if let (true, Some(voice)) = (self.keys, self.voice.take()) {
            voice.let_go();
        }
    }
}

async fn talk(
    out: &mut SplitSink<WebSocket, Message>,
    heard: &mut SplitStream<WebSocket>,
    stage: &Stage,
    mut held: Held,
) -> Option<()> {
    let mut is_refused = false;
    let mut changed = stage.changed();
    let mut seen = Seen::default();
    let mut next = Instant::now();
    let mut alive = interval(Duration::from_secs(20));
    changed.mark_changed();
    loop {
        let fresh = async {
            sleep_until(next).await;
            changed.changed().await
        };
        tokio::select! {
            message = heard.next() => match message?.ok()? {
                Message::Text(text) => match serde_json::from_str(&text) {
                    Ok(say) => is_refused |= !held.say(say),
                    Err(_) => return None,
                },
                Message::Close(_) => return None,
                Message::Binary(_) | Message::Ping(_) | Message::Pong(_) => {}
            },
            change = fresh => {
                change.ok()?;
                next = Instant::now() + FRAME;
                let mut news = stage.news(&mut seen, MOST_ROWS);
                if std::mem::take(&mut is_refused) {
                    // It said more than the run can do.
                    news.tells.push(note(&StageMessage::Busy.diagnostic()));
                }
                let sending = async {
                    for tell in news.tells {
                        feed(out, Message::Text(serde_json::to_string(&tell).ok()?.into())).await?;
                    }
                    let Some(frame) = news.frame else { return Some(()) };
                    feed(out, Message::Binary(rmp_serde::to_vec_named(&frame).ok()?.into())).await
                };
                timeout(LONGEST_UNREAD, sending).await.ok()??;
            }
            _ = alive.tick() => timeout(LONGEST_UNREAD, feed(out, Message::Ping(Default::default()))).await.ok()??,
        }
    }
}

async fn feed(out: &mut SplitSink<WebSocket, Message>, message: Message) -> Option<()> {
    futures_util::SinkExt::send(out, message).await.ok()
}
