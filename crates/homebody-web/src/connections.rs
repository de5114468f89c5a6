//! The connections of a server: so many at once, and none that says nothing.

use axum::Router;
use hyper::server::conn::http1;
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::service::TowerToHyperService;
use std::io;
use std::sync::Arc;
use std::time::Duration;
use tokio::net::TcpListener;
use tokio::sync::Semaphore;

/// So many are open at once; others wait to be let in (ours).
const MOST: usize = 256;

/// The head of a request comes within this time, or the connection is closed (ours).
const PATIENCE: Duration = Duration::from_secs(10);

/// How long to wait where the system has no more room for connections.
const REST: Duration = Duration::from_millis(100);

/// Serves whoever comes, for as long as it is polled.
pub async fn serve(listener: TcpListener, routes: Router) -> io::Error {
    let places = Arc::new(Semaphore::new(MOST));
    loop {
        let Ok(place) = places.clone().acquire_owned().await else {
            return io::Error::other("the server is closed");
        };
        let stream = match listener.accept().await {
            Ok((stream, _)) => stream,
            Err(error) if is_of_one(&error) => continue,
            Err(error) if error.kind() == io::ErrorKind::InvalidInput => return error,
            Err(_) => {
                tokio::time::sleep(REST).await;
                continue;
            }
        };
        // Keys and frames are small, and each is wanted at once.
        let _ = stream.set_nodelay(true);
        let service = TowerToHyperService::new(routes.clone());
        tokio::spawn(async move {
            let mut http = http1::Builder::new();
            http.timer(TokioTimer::new()).header_read_timeout(PATIENCE);
            // Who breaks off has nobody to be told of it.
            let _ = http.serve_connection(TokioIo::new(stream), service).with_upgrades().await;
            drop(place);
        });
    }
}

/// Whether an error is of one connection alone.
fn is_of_one(error: &io::Error) -> bool {
    use io::ErrorKind::{ConnectionAborted, ConnectionRefused, ConnectionReset, Interrupted};
    matches!(error.kind(), ConnectionAborted | ConnectionRefused | ConnectionReset | Interrupted)
}
