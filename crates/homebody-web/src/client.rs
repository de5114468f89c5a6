//! Connections of clients, and their limits.
//!
//! Until a client has sent the token, the server cannot tell it from the owner of the page. So it accepts every connection at once, as
//! one of a stranger. The number of strangers is limited: a new one replaces the oldest, so that strangers only disconnect each other.
//! A stranger also has a limited time, enough for the page and its files. A client with the token has a place of its own, for as long
//! as it likes.

use std::collections::BTreeMap;
use std::future::pending;
use std::io::{self, IoSlice};
use std::net::IpAddr;
use std::pin::Pin;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::task::{Context, Poll, ready};
use std::time::Duration;
use tokio::io::{AsyncRead, AsyncWrite, ReadBuf};
use tokio::net::TcpStream;
use tokio::sync::watch;
use tokio::time::{Instant, Sleep, sleep, timeout_at};

/// Largest number of connections without a token (our choice).
pub const MOST_STRANGERS: usize = 256;

/// Largest number of connections with a token (our choice). Those beyond it count as connections without one.
const MOST_KNOWN: usize = 256;

/// Time after which a connection without a token is closed (our choice).
const LONGEST_VISIT: Duration = Duration::from_secs(30);

/// Time without reading an answer after which a connection is closed (our choice).
pub const LONGEST_UNTAKEN: Duration = Duration::from_secs(60);

/// Clones share the places.
#[derive(Clone)]
pub struct ConnectionPlaces {
    taken: Arc<Mutex<TakenPlaces>>,
    strangers_time: Duration,
    stuck: Duration,
}

impl Default for ConnectionPlaces {
    fn default() -> ConnectionPlaces {
        ConnectionPlaces { taken: Arc::default(), strangers_time: LONGEST_VISIT, stuck: LONGEST_UNTAKEN }
    }
}

#[derive(Default)]
struct TakenPlaces {
    next: u64,
    /// By number, the oldest first, each with its signal to close.
    strangers: BTreeMap<u64, watch::Sender<bool>>,
    known: usize,
}

impl ConnectionPlaces {
    /// Adds a connection, and disconnects the oldest stranger if there are too many.
    pub fn enter(&self, from: IpAddr) -> ClientConnection {
        let (go, goes) = watch::channel(false);
        let mut taken = self.taken();
        while taken.strangers.len() >= MOST_STRANGERS {
            taken.disconnect_oldest();
        }
        let number = taken.next;
        taken.next += 1;
        taken.strangers.insert(number, go);
        drop(taken);
        let (is_known, is_page) = (AtomicBool::new(false), AtomicBool::new(false));
        ClientConnection(Arc::new(ConnectionState {
            places: self.clone(),
            number,
            from,
            since: Instant::now(),
            goes,
            is_known,
            is_page,
        }))
    }

    /// Makes room if the system has no more.
    pub fn disconnect_oldest(&self) {
        self.taken().disconnect_oldest();
    }

    fn taken(&self) -> MutexGuard<'_, TakenPlaces> {
        // No panic leaves it half changed.
        self.taken.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl TakenPlaces {
    fn disconnect_oldest(&mut self) {
        if let Some((_, go)) = self.strangers.pop_first() {
            go.send_replace(true);
        }
    }
}

/// Clones are the same connection. Its place is free after the last is dropped.
#[derive(Clone)]
pub struct ClientConnection(Arc<ConnectionState>);

struct ConnectionState {
    places: ConnectionPlaces,
    number: u64,
    from: IpAddr,
    since: Instant,
    /// Closed once nothing can disconnect it.
    goes: watch::Receiver<bool>,
    is_known: AtomicBool,
    is_page: AtomicBool,
}

impl ClientConnection {
    pub fn from(&self) -> IpAddr {
        self.0.from
    }

    /// The client has sent the token.
    pub fn mark_known(&self) {
        let mut taken = self.0.places.taken();
        if taken.known < MOST_KNOWN && taken.strangers.remove(&self.0.number).is_some() {
            taken.known += 1;
            self.0.is_known.store(true, Ordering::Relaxed);
        }
    }

    /// Marks the socket of a page, which closes by itself if the page does not read.
    pub fn mark_page(&self) {
        self.0.is_page.store(true, Ordering::Relaxed);
    }

    /// Returns when the connection has to close: for a newer stranger, or after its time.
    pub async fn closes(&self) {
        let mut goes = self.0.goes.clone();
        let signal = timeout_at(self.0.since + self.0.places.strangers_time, goes.wait_for(|goes| *goes)).await;
        let is_known = matches!(signal, Ok(Err(_)));
        drop(signal);
        if is_known {
            pending::<()>().await;
        }
    }
}

impl Drop for ConnectionState {
    fn drop(&mut self) {
        let mut taken = self.places.taken();
        if *self.is_known.get_mut() {
            taken.known -= 1;
        } else {
            taken.strangers.remove(&self.number);
        }
    }
}

/// The stream of a connection. Writing fails if the client reads nothing for [`LONGEST_UNTAKEN`].
pub struct LimitedStream {
    stream: TcpStream,
    client: ClientConnection,
    /// Runs while the client does not read.
    stuck: Option<Pin<Box<Sleep>>>,
}

impl LimitedStream {
    pub fn new(stream: TcpStream, client: ClientConnection) -> LimitedStream {
        LimitedStream { stream, client, stuck: None }
    }

    fn unless_stuck<T>(&mut self, context: &mut Context<'_>, done: Poll<io::Result<T>>) -> Poll<io::Result<T>> {
        if done.is_ready() || self.client.0.is_page.load(Ordering::Relaxed) {
            self.stuck = None;
            return done;
        }
        let patience = self.client.0.places.stuck;
        let stuck = self.stuck.get_or_insert_with(|| Box::pin(sleep(patience)));
        ready!(stuck.as_mut().poll(context));
        Poll::Ready(Err(io::ErrorKind::TimedOut.into()))
    }
}

impl AsyncRead for LimitedStream {
    fn poll_read(mut self: Pin<&mut Self>, context: &mut Context<'_>, into: &mut ReadBuf<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_read(context, into)
    }
}

impl AsyncWrite for LimitedStream {
    fn poll_write(mut self: Pin<&mut Self>, context: &mut Context<'_>, bytes: &[u8]) -> Poll<io::Result<usize>> {
        let done = Pin::new(&mut self.stream).poll_write(context, bytes);
        self.unless_stuck(context, done)
    }

    fn poll_write_vectored(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        slices: &[IoSlice<'_>],
    ) -> Poll<io::Result<usize>> {
        let done = Pin::new(&mut self.stream).poll_write_vectored(context, slices);
        self.unless_stuck(context, done)
    }

    fn is_write_vectored(&self) -> bool {
        self.stream.is_write_vectored()
    }

    fn poll_flush(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_flush(context)
    }

    fn poll_shutdown(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_shutdown(context)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::net::Ipv4Addr;
    use tokio::io::AsyncWriteExt;
    use tokio::net::TcpListener;
    use tokio::time::timeout;

    async fn goes(client: &ClientConnection) -> bool {
        timeout(Duration::from_millis(1), client.closes()).await.is_ok()
    }

    /// A client with the token keeps its connection, and frees a place among strangers.
    #[tokio::test(start_paused = true)]
    async fn strangers_disconnect_only_each_other() {
        let places = ConnectionPlaces::default();
        let enter = || places.enter(Ipv4Addr::LOCALHOST.into());
        let (known, first) = (enter(), enter());
        known.mark_known();
        let others: Vec<ClientConnection> = (1..MOST_STRANGERS).map(|_| enter()).collect();
        assert!(!goes(&first).await, "there is room for {MOST_STRANGERS}");
        let last = enter();
        assert!(goes(&first).await, "who has been a stranger longest goes");
        assert!(!goes(&known).await && !goes(&others[0]).await && !goes(&last).await);
        drop(others);
        let again: Vec<ClientConnection> = (1..MOST_STRANGERS).map(|_| enter()).collect();
        assert!(!goes(&last).await, "places become free");
        drop((known, first, last, again));
        let taken = places.taken();
        assert_eq!((taken.strangers.len(), taken.known), (0, 0));
    }

    #[tokio::test(start_paused = true)]
    async fn connections_beyond_the_known_places_stay_strangers() {
        let places = ConnectionPlaces::default();
        let all: Vec<ClientConnection> = (0..=MOST_KNOWN).map(|_| places.enter(Ipv4Addr::LOCALHOST.into())).collect();
        for client in &all[1..] {
            client.mark_known();
        }
        assert!(goes(&all[0]).await, "who was first was in the way of the last");
        let late = places.enter(Ipv4Addr::LOCALHOST.into());
        late.mark_known();
        assert_eq!(places.taken().known, MOST_KNOWN);
        assert!(!goes(&all[1]).await);
    }

    const SOON: Duration = Duration::from_millis(50);

    fn hasty() -> ConnectionPlaces {
        ConnectionPlaces { strangers_time: SOON, stuck: SOON, ..ConnectionPlaces::default() }
    }

    #[tokio::test(start_paused = true)]
    async fn limits_the_time_of_strangers_only() {
        let places = hasty();
        let (stranger, known) = (places.enter(Ipv4Addr::LOCALHOST.into()), places.enter(Ipv4Addr::LOCALHOST.into()));
        known.mark_known();
        assert!(!goes(&stranger).await);
        assert!(timeout(10 * SOON, stranger.closes()).await.is_ok());
        assert!(timeout(4 * SOON, known.closes()).await.is_err());
    }

    /// Writes more than the client reads.
    async fn written(is_page: bool) -> Option<io::Error> {
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).await.unwrap();
        let _reader = TcpStream::connect(listener.local_addr().unwrap()).await.unwrap();
        let client = hasty().enter(Ipv4Addr::LOCALHOST.into());
        client.mark_known();
        if is_page {
            client.mark_page();
        }
        let mut stream = LimitedStream::new(listener.accept().await.unwrap().0, client);
        timeout(10 * SOON, stream.write_all(&vec![0; 64 << 20])).await.ok()?.err()
    }

    #[tokio::test(start_paused = true)]
    async fn disconnects_clients_that_read_nothing_except_pages() {
        assert_eq!(written(false).await.map(|error| error.kind()), Some(io::ErrorKind::TimedOut));
        assert!(written(true).await.is_none());
    }
}
