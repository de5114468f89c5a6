//! The socket of a page: commands go to the stage, and frames come back.
//!
//! A page that does not read delays no other: it gets the next frame once it has read the one before.

use crate::client::ClientConnection;
use crate::guard::Guard;
use crate::messages::{PageMessage, StageMessage};
use crate::request_error::{RequestError, note};
use crate::stage::{PageCommands, Seen, Stage};
use crate::wire::PageCommand;
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

/// At most sixty frames a second.
const FRAME: Duration = Duration::from_micros(16_000);

/// Largest number of rows with a picture (our choice): as many as a table shows.
const MOST_ROWS: usize = 500;

/// Time within which a page has to send the token (our choice).
const LONGEST_HELLO: Duration = Duration::from_secs(10);

const WRONG_TOKEN: u16 = 4401;

/// The close code for too many pages, which may try again later.
const TOO_MANY: u16 = 1013;

const NO_HOME: u16 = 4404;

/// Time without reading after which a page is disconnected (our choice).
const LONGEST_UNREAD: Duration = Duration::from_secs(900);

/// Accepts a socket of the own page, and shows it the run once it has sent the token.
pub fn upgraded<F: Future<Output = ()> + Send>(
    upgrade: WebSocketUpgrade,
    headers: &HeaderMap,
    client: ClientConnection,
    guard: Guard,
    show: impl FnOnce(WebSocket, ClientConnection) -> F + Send + 'static,
) -> Response {
    if !guard.is_socket_from_us(headers) {
        return RequestError::new(StatusCode::FORBIDDEN, PageMessage::ForeignPage).into_response();
    }
    let upgrade = upgrade.max_message_size(LONGEST_MESSAGE_BYTES).max_frame_size(LONGEST_MESSAGE_BYTES);
    upgrade.on_upgrade(async move |socket| {
        let shown = async {
            if let Some(socket) = let_in(socket, &client, &guard).await {
                show(socket, client.clone()).await;
            }
        };
        tokio::select! {
            () = shown => {}
            () = client.closes() => {}
        }
    })
}

/// Serves a page until it or its home closes. It takes one of `pages`.
pub async fn serve(
    socket: WebSocket,
    client: ClientConnection,
    pages: &Semaphore,
    stage: &Stage,
    mut gone: watch::Receiver<bool>,
) {
    let Ok(_place) = pages.try_acquire() else { return close_for_now(socket).await };
    client.mark_page();
    let commands = stage.page_commands();
    let seen = commands.seen();
    let held = PageKeys { commands: Some(commands), keys: false };
    let (mut out, mut heard) = socket.split();
    // The page is gone when either direction fails.
    let is_home_gone = tokio::select! {
        _ = talk(&mut out, &mut heard, stage, seen, held) => false,
        // The sender exists as long as this.
        _ = gone.wait_for(|gone| *gone) => true,
    };
    if let (true, Ok(socket)) = (is_home_gone, out.reunite(heard)) {
        close_without_home(socket).await;
    }
}

pub async fn close_without_home(socket: WebSocket) {
    close(socket, NO_HOME, "this home does not exist").await;
}

pub async fn close_for_now(socket: WebSocket) {
    close(socket, TOO_MANY, "too many pages are open").await;
}

/// The socket once its page has sent the token; otherwise it is closed.
async fn let_in(mut socket: WebSocket, client: &ClientConnection, guard: &Guard) -> Option<WebSocket> {
    let hello = timeout(LONGEST_HELLO, socket.recv()).await;
    let is_known = match &hello {
        Ok(Some(Ok(Message::Text(text)))) => match serde_json::from_str(text) {
            Ok(PageCommand::Hello { token }) => guard.knows(&token, client),
            _ => false,
        },
        _ => false,
    };
    if is_known {
        return Some(socket);
    }
    guard.delay(client.from()).await;
    close(socket, WRONG_TOKEN, "the token is missing or wrong").await;
    None
}

async fn close(mut socket: WebSocket, code: u16, reason: &'static str) {
    let _ = socket.send(Message::Close(Some(CloseFrame { code, reason: reason.into() }))).await;
}

/// The commands and the held keys of a page. Its drop releases the keys.
struct PageKeys {
    commands: Option<PageCommands>,
    keys: bool,
}

impl PageKeys {
    /// False if too many commands of the page wait.
    fn send(&mut self, say: PageCommand) -> bool {
        let holds = if let PageCommand::Hold { keys } = &say { Some(!keys.is_empty()) } else { None };
        let is_heard = self.commands.as_ref().is_some_and(|commands| commands.send(say));
        // A key stays held if its release was refused.
        self.keys = holds.filter(|&holds| is_heard || holds).unwrap_or(self.keys);
        is_heard
    }
}

impl Drop for PageKeys {
    fn drop(&mut self) {
        if let (true, Some(commands)) = (self.keys, self.commands.take()) {
            commands.release_keys();
        }
    }
}

async fn talk(
    out: &mut SplitSink<WebSocket, Message>,
    heard: &mut SplitStream<WebSocket>,
    stage: &Stage,
    mut seen: Seen,
    mut held: PageKeys,
) -> Option<()> {
    let mut is_refused = false;
    let mut changed = stage.changed();
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
                    Ok(say) => is_refused |= !held.send(say),
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
                    // The page sent more commands than the run can execute.
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
