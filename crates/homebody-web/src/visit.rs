//! Who is connected, and for how long.
//!
//! Before somebody has shown the token, nobody can tell them from the one whom the page is for. So whoever comes is let in at
//! once, as a stranger. Strangers have so many places; where all are taken, the one who has been a stranger longest has to go, so
//! that those who come and hold on keep out nobody but each other. A stranger has so much time for all that they want: a page and
//! what belongs to it. Whoever shows the token has a place among those who are known, for as long as they like.

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

/// The places of all who are connected. A clone has the same places.
#[derive(Clone)]
pub struct Places {
    taken: Arc<Mutex<Taken>>,
    strangers_time: Duration,
    stuck: Duration,
}

impl Default for Places {
    fn default() -> Places {
        Places { taken: Arc::default(), strangers_time: LONGEST_VISIT, stuck: LONGEST_UNTAKEN }
    }
}

#[derive(Default)]
struct Taken {
    /// How many have come.
    next: u64,
    /// By their number, so that the first has been here longest; each with what tells them to go.
    strangers: BTreeMap<u64, watch::Sender<bool>>,
    known: usize,
}

impl Places {
    /// Lets somebody in from an address, and sends a stranger away if there are too many.
    pub fn enter(&self, from: IpAddr) -> Visit {
        let (go, goes) = watch::channel(false);
        let mut taken = self.taken();
        while taken.strangers.len() >= MOST_STRANGERS {
            taken.send_oldest_away();
        }
        let number = taken.next;
        taken.next += 1;
        taken.strangers.insert(number, go);
        drop(taken);
        let (is_known, is_page) = (AtomicBool::new(false), AtomicBool::new(false));
        Visit(Arc::new(Visitor { places: self.clone(), number, from, since: Instant::now(), goes, is_known, is_page }))
    }

    /// Makes room where the system has no more of it.
    pub fn send_oldest_away(&self) {
        self.taken().send_oldest_away();
    }

    fn taken(&self) -> MutexGuard<'_, Taken> {
        // What it holds is whole between any two of its changes.
        self.taken.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Taken {
    fn send_oldest_away(&mut self) {
        if let Some((_, go)) = self.strangers.pop_first() {
            go.send_replace(true);
        }
    }
}

/// One connection. Clones are the same one; its place is free when the last is gone.
#[derive(Clone)]
pub struct Visit(Arc<Visitor>);

struct Visitor {
    places: Places,
    number: u64,
    from: IpAddr,
    since: Instant,
    /// Closed once nobody sends it away any more.
    goes: watch::Receiver<bool>,
    is_known: AtomicBool,
    is_page: AtomicBool,
}

impl Visit {
    /// The address that it comes from.
    pub fn from(&self) -> IpAddr {
        self.0.from
    }

    /// The token has been shown.
    pub fn mark_known(&self) {
        let mut taken = self.0.places.taken();
        if taken.known < MOST_KNOWN && taken.strangers.remove(&self.0.number).is_some() {
            taken.known += 1;
            self.0.is_known.store(true, Ordering::Relaxed);
        }
    }

    /// From now on it is a page's socket, which closes by itself when the page does not read.
    pub fn mark_page(&self) {
        self.0.is_page.store(true, Ordering::Relaxed);
    }

    /// Comes back when it has to go: a stranger who is in the way of others, or has been here too long.
    pub async fn sent_away(&self) {
        let mut goes = self.0.goes.clone();
        let told = timeout_at(self.0.since + self.0.places.strangers_time, goes.wait_for(|goes| *goes)).await;
        let is_known = matches!(told, Ok(Err(_)));
        drop(told);
        if is_known {
            pending::<()>().await;
        }
    }
}

impl Drop for Visitor {
    fn drop(&mut self) {
        let mut taken = self.places.taken();
        if *self.is_known.get_mut() {
            taken.known -= 1;
        } else {
            taken.strangers.remove(&self.number);
        }
    }
}

/// A connection's stream. Where nothing of what is written is taken for [`LONGEST_UNTAKEN`], writing fails.
pub struct Stream {
    stream: TcpStream,
    visit: Visit,
    /// Runs while somebody lets an answer wait.
    stuck: Option<Pin<Box<Sleep>>>,
}

impl Stream {
    pub fn new(stream: TcpStream, visit: Visit) -> Stream {
        Stream { stream, visit, stuck: None }
    }

    fn unless_stuck<T>(&mut self, context: &mut Context<'_>, done: Poll<io::Result<T>>) -> Poll<io::Result<T>> {
        if done.is_ready() || self.visit.0.is_page.load(Ordering::Relaxed) {
            self.stuck = None;
            return done;
        }
        let patience = self.visit.0.places.stuck;
        let stuck = self.stuck.get_or_insert_with(|| Box::pin(sleep(patience)));
        ready!(stuck.as_mut().poll(context));
        Poll::Ready(Err(io::ErrorKind::TimedOut.into()))
    }
}

impl AsyncRead for Stream {
    fn poll_read(mut self: Pin<&mut Self>, context: &mut Context<'_>, into: &mut ReadBuf<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_read(context, into)
    }
}

impl AsyncWrite for Stream {
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

    async fn goes(visit: &Visit) -> bool {
        timeout(Duration::from_millis(1), visit.sent_away()).await.is_ok()
    }

    /// Strangers take the places of strangers; who has shown the token is sent away by nobody, and leaves a place behind.
    #[tokio::test(start_paused = true)]
    async fn strangers_are_only_in_the_way_of_each_other() {
        let places = Places::default();
        let enter = || places.enter(Ipv4Addr::LOCALHOST.into());
        let (known, first) = (enter(), enter());
        known.mark_known();
        let others: Vec<Visit> = (1..MOST_STRANGERS).map(|_| enter()).collect();
        assert!(!goes(&first).await, "there is room for {MOST_STRANGERS}");
        let last = enter();
        assert!(goes(&first).await, "who has been a stranger longest goes");
        assert!(!goes(&known).await && !goes(&others[0]).await && !goes(&last).await);
        drop(others);
        let again: Vec<Visit> = (1..MOST_STRANGERS).map(|_| enter()).collect();
        assert!(!goes(&last).await, "places become free");
        drop((known, first, last, again));
        let taken = places.taken();
        assert_eq!((taken.strangers.len(), taken.known), (0, 0));
    }

    #[tokio::test(start_paused = true)]
    async fn who_is_known_beyond_the_places_for_it_stays_a_stranger() {
        let places = Places::default();
        let all: Vec<Visit> = (0..=MOST_KNOWN).map(|_| places.enter(Ipv4Addr::LOCALHOST.into())).collect();
        for visit in &all[1..] {
            visit.mark_known();
        }
        assert!(goes(&all[0]).await, "who was first was in the way of the last");
        let late = places.enter(Ipv4Addr::LOCALHOST.into());
        late.mark_known();
        assert_eq!(places.taken().known, MOST_KNOWN);
        assert!(!goes(&all[1]).await);
    }

    const SOON: Duration = Duration::from_millis(50);

    fn hasty() -> Places {
        Places { strangers_time: SOON, stuck: SOON, ..Places::default() }
    }

    #[tokio::test(start_paused = true)]
    async fn a_stranger_has_so_much_time_and_who_is_known_has_all() {
        let places = hasty();
        let (stranger, known) = (places.enter(Ipv4Addr::LOCALHOST.into()), places.enter(Ipv4Addr::LOCALHOST.into()));
        known.mark_known();
        assert!(!goes(&stranger).await);
        assert!(timeout(10 * SOON, stranger.sent_away()).await.is_ok());
        assert!(timeout(4 * SOON, known.sent_away()).await.is_err());
    }

    /// Writes more than anybody takes.
    async fn written(is_page: bool) -> Option<io::Error> {
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).await.unwrap();
        let _reader = TcpStream::connect(listener.local_addr().unwrap()).await.unwrap();
        let visit = hasty().enter(Ipv4Addr::LOCALHOST.into());
        visit.mark_known();
        if is_page {
            visit.mark_page();
        }
        let mut stream = Stream::new(listener.accept().await.unwrap().0, visit);
        timeout(10 * SOON, stream.write_all(&vec![0; 64 << 20])).await.ok()?.err()
    }

    #[tokio::test(start_paused = true)]
    async fn who_takes_nothing_is_gone_but_for_a_page_which_is_waited_for_elsewhere() {
        assert_eq!(written(false).await.map(|error| error.kind()), Some(io::ErrorKind::TimedOut));
        assert!(written(true).await.is_none());
    }
}
