//! One page's socket: what it says goes to the stage, and what there is to be seen comes back.
//!
//! A page that does not read holds up nobody: the next picture is made when the one before has gone out.

use crate::guard::Guard;
use crate::stage::{Seen, Stage};
use crate::visit::Visit;
use crate::wire::Say;
use axum::extract::ws::{CloseFrame, Message, WebSocket};
use futures_util::StreamExt;
use std::sync::Arc;
use std::time::Duration;
use tokio::sync::Semaphore;
use tokio::time::{Instant, interval, sleep_until, timeout};

/// A message of a page is no longer than this (ours).
pub const LONGEST_MESSAGE_BYTES: usize = 64 << 10;

/// No page sees more pictures than sixty a second.
const FRAME: Duration = Duration::from_micros(16_000);

/// How many rows come with a picture at most: as many as a table shows (ours).
const MOST_ROWS: usize = 500;

/// Who does not say the token by then is sent away (ours).
const LONGEST_HELLO: Duration = Duration::from_secs(10);

/// What a socket is closed with whose token is wrong.
const WRONG_TOKEN: u16 = 4401;

/// What a socket is closed with where too many pages look already: it may try again later.
const TOO_MANY: u16 = 1013;

/// A page that has not read what was sent to it for so long is gone (ours).
const LONGEST_UNREAD: Duration = Duration::from_secs(900);

/// Serves a page until it goes. It takes one of `pages` once it has said the token.
pub async fn serve(mut socket: WebSocket, visit: Visit, guard: Guard, pages: Arc<Semaphore>, stage: Stage) {
    let hello = timeout(LONGEST_HELLO, socket.recv()).await;
    let is_known = match &hello {
        Ok(Some(Ok(Message::Text(text)))) => match serde_json::from_str(text) {
            Ok(Say::Hello { token }) => guard.knows(&token, &visit),
            _ => false,
        },
        _ => false,
    };
    if !is_known {
        guard.delay(visit.from()).await;
        return close(socket, WRONG_TOKEN, "the token is missing or wrong").await;
    }
    let Ok(_place) = pages.try_acquire() else {
        return close(socket, TOO_MANY, "too many pages look already").await;
    };
    visit.mark_page();
    let held = Held { stage: &stage, keys: false };
    // The page is gone when either side of it is.
    let _ = talk(socket, held).await;
}

async fn close(mut socket: WebSocket, code: u16, reason: &'static str) {
    let _ = socket.send(Message::Close(Some(CloseFrame { code, reason: reason.into() }))).await;
}

/// The keys that a page holds, which are let go when it goes.
struct Held<'a> {
    stage: &'a Stage,
    keys: bool,
}

impl Drop for Held<'_> {
    fn drop(&mut self) {
        if self.keys {
            self.stage.say(Say::Hold { keys: Vec::new() });
        }
    }
}

async fn talk(socket: WebSocket, mut held: Held<'_>) -> Option<()> {
    let stage = held.stage;
    let mut changed = stage.changed();
    let mut seen = Seen::default();
    let mut next = Instant::now();
    let (mut out, mut heard) = socket.split();
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
                    Ok(say) => {
                        if let Say::Hold { keys } = &say {
                            held.keys = !keys.is_empty();
                        }
                        stage.say(say);
                    }
                    Err(_) => return None,
                },
                Message::Close(_) => return None,
                Message::Binary(_) | Message::Ping(_) | Message::Pong(_) => {}
            },
            change = fresh => {
                change.ok()?;
                next = Instant::now() + FRAME;
                let news = stage.news(&mut seen, MOST_ROWS);
                let sending = async {
                    for tell in news.tells {
                        feed(&mut out, Message::Text(serde_json::to_string(&tell).ok()?.into())).await?;
                    }
                    let Some(frame) = news.frame else { return Some(()) };
                    feed(&mut out, Message::Binary(rmp_serde::to_vec_named(&frame).ok()?.into())).await
                };
                timeout(LONGEST_UNREAD, sending).await.ok()??;
            }
            _ = alive.tick() => timeout(LONGEST_UNREAD, feed(&mut out, Message::Ping(Default::default()))).await.ok()??,
        }
    }
}

async fn feed(out: &mut (impl futures_util::Sink<Message> + Unpin), message: Message) -> Option<()> {
    futures_util::SinkExt::send(out, message).await.ok()
}
