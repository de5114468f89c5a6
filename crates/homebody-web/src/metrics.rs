//! Metrics of a run for monitoring programs, at an address of their own.

use crate::connections;
use crate::guard::{Guard, watch};
use crate::server::{ServeError, bind};
use axum::http::header;
use axum::routing::get;
use axum::{Router, middleware};
use std::io::{self, ErrorKind};
use std::net::SocketAddr;
use std::sync::mpsc::sync_channel;
use std::thread;

/// The text format of Prometheus, version 0.0.4.
const TEXT: &str = "text/plain; version=0.0.4; charset=utf-8";

/// Serves a text at `/metrics`, computed for each request, until the program ends. Returns its address. Requests need one of the
/// address's own host names, as for the page, but no token: the text has counts and no personal data.
///
/// # Errors
///
/// [`ServeError::Port`] or [`ServeError::Foreign`] if the address cannot be listened to.
pub fn serve_metrics(
    address: SocketAddr,
    text: impl Fn() -> String + Clone + Send + Sync + 'static,
) -> Result<SocketAddr, ServeError> {
    let (bound, is_bound) = sync_channel(1);
    let serving = move || {
        let runtime = tokio::runtime::Builder::new_multi_thread().worker_threads(1).enable_all().build();
        let begun = runtime.map_err(ServeError::Broken).and_then(|runtime| {
            let _entered = runtime.enter();
            let listener = bind(address).map_err(|source| match source.kind() {
                ErrorKind::AddrNotAvailable => ServeError::Foreign(address.ip().to_string()),
                _ => ServeError::Port { address: address.to_string(), source },
            })?;
            let address = listener.local_addr().map_err(ServeError::Broken)?;
            let guard = Guard::new(address, None)?;
            drop(_entered);
            Ok((runtime, listener, address, guard))
        });
        match begun {
            Err(error) => drop(bound.send(Err(error))),
            Ok((runtime, listener, address, guard)) => {
                let answer = move || {
                    let text = text();
                    async move { ([(header::CONTENT_TYPE, TEXT)], text) }
                };
                let routes = Router::new().route("/metrics", get(answer));
                let routes = routes.layer(middleware::from_fn_with_state(guard, watch));
                if bound.send(Ok(address)).is_ok() {
                    // It ends with the program.
                    let _ = runtime.block_on(connections::serve(listener, routes));
                }
            }
        }
    };
    thread::Builder::new().name("metrics".into()).spawn(serving).map_err(ServeError::Broken)?;
    is_bound.recv().unwrap_or_else(|_| Err(ServeError::Broken(io::ErrorKind::BrokenPipe.into())))
}
