//! The connections of a server: it accepts all at once, and closes those that send or read nothing.

use crate::client::{ConnectionPlaces, LimitedStream};
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

/// Pause when the system has no more room for connections.
const REST: Duration = Duration::from_millis(100);

/// Serves connections as long as it is polled. Each request carries its `ClientConnection`.
pub async fn serve(listener: TcpListener, routes: Router) -> io::Error {
    let places = ConnectionPlaces::default();
    loop {
        let (stream, from) = match listener.accept().await {
            Ok(accepted) => accepted,
            Err(error) if is_of_one(&error) => continue,
            Err(error) if error.kind() == io::ErrorKind::InvalidInput => return error,
            Err(_) => {
                places.disconnect_oldest();
                tokio::time::sleep(REST).await;
                continue;
            }
        };
        // Keys and frames are small and urgent.
        let _ = stream.set_nodelay(true);
        let client = places.enter(from.ip().to_canonical());
        let (routes, visitor) = (routes.clone(), client.clone());
        let service = service_fn(move |mut request: Request<hyper::body::Incoming>| {
            request.extensions_mut().insert(visitor.clone());
            routes.clone().call(request)
        });
        tokio::spawn(async move {
            let mut http = http1::Builder::new();
            http.timer(TokioTimer::new()).header_read_timeout(LONGEST_HEAD);
            let stream = TokioIo::new(LimitedStream::new(stream, client.clone()));
            tokio::select! {
                // A client that disconnects needs no answer.
                _ = http.serve_connection(stream, service).with_upgrades() => {}
                () = client.closes() => {}
            }
        });
    }
}

/// Whether an error concerns one connection only.
fn is_of_one(error: &io::Error) -> bool {
    use io::ErrorKind::{ConnectionAborted, ConnectionRefused, ConnectionReset, Interrupted};
    matches!(error.kind(), ConnectionAborted | ConnectionRefused | ConnectionReset | Interrupted)
}
