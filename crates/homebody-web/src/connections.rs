//! The connections of a server: nobody waits to be let in, and nobody stays who says or takes nothing.

use crate::visit::{Places, Stream};
use axum::Router;
use axum::extract::Request;
use hyper::server::conn::http1;
use hyper::service::service_fn;
use hyper_util::rt::{TokioIo, TokioTimer};
use std::io;
use std::time::Duration;
use tokio::net::TcpListener;
use tower_service::Service;

/// Time for the head of a request before the connection is closed, and time between two requests (our choice).
const LONGEST_HEAD: Duration = Duration::from_secs(10);

/// How long to wait where the system has no more room for connections.
const REST: Duration = Duration::from_millis(100);

/// Serves whoever comes, for as long as it is polled. Each request carries the visit of its connection.
pub async fn serve(listener: TcpListener, routes: Router) -> io::Error {
    let places = Places::default();
    loop {
        let (stream, from) = match listener.accept().await {
            Ok(accepted) => accepted,
            Err(error) if is_of_one(&error) => continue,
            Err(error) if error.kind() == io::ErrorKind::InvalidInput => return error,
            Err(_) => {
                places.send_oldest_away();
                tokio::time::sleep(REST).await;
                continue;
            }
        };
        // Keys and frames are small, and each is wanted at once.
        let _ = stream.set_nodelay(true);
        let visit = places.enter(from.ip().to_canonical());
        let (routes, visitor) = (routes.clone(), visit.clone());
        let service = service_fn(move |mut request: Request<hyper::body::Incoming>| {
            request.extensions_mut().insert(visitor.clone());
            routes.clone().call(request)
        });
        tokio::spawn(async move {
            let mut http = http1::Builder::new();
            http.timer(TokioTimer::new()).header_read_timeout(LONGEST_HEAD);
            let stream = TokioIo::new(Stream::new(stream, visit.clone()));
            tokio::select! {
                // Who breaks off has nobody to be told of it.
                _ = http.serve_connection(stream, service).with_upgrades() => {}
                () = visit.sent_away() => {}
            }
        });
    }
}

/// Whether an error is of one connection alone.
fn is_of_one(error: &io::Error) -> bool {
    use io::ErrorKind::{ConnectionAborted, ConnectionRefused, ConnectionReset, Interrupted};
    matches!(error.kind(), ConnectionAborted | ConnectionRefused | ConnectionReset | Interrupted)
}
