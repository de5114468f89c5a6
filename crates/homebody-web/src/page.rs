//! The files of the page, which are built into the program.

use axum::http::{StatusCode, Uri, header};
use axum::response::{IntoResponse, Response};
use include_dir::{Dir, include_dir};

/// The first page of a library.
pub const FIRST_PAGE: &str = "/library/";

static PAGE: Dir = include_dir!("$HOMEBODY_PAGE");

/// Whether the page was built into this program; otherwise a substitute gives the reason.
pub fn has_page() -> bool {
    PAGE.get_dir("assets").is_some()
}

/// A file of the page, looked up by name, so that no path leads elsewhere.
pub async fn file(uri: Uri) -> Response {
    let name = match uri.path() {
        "/" => "index.html",
        // The first page of a library and those of its homes differ by their address only.
        path if path == FIRST_PAGE || is_of_home(path) => "index.html",
        path => path.trim_start_matches('/'),
    };
    let Some(file) = PAGE.get_file(name) else {
        return (StatusCode::NOT_FOUND, "This page does not exist.").into_response();
    };
    // The names of built files contain a digest of their contents.
    let cache = if name.starts_with("assets/") { "public, max-age=31536000, immutable" } else { "no-cache" };
    let headers = [(header::CONTENT_TYPE, kind(name)), (header::CACHE_CONTROL, cache)];
    (headers, file.contents()).into_response()
}

/// Whether a path is `/homes/NAME/`.
fn is_of_home(path: &str) -> bool {
    let name = path.strip_prefix("/homes/").and_then(|rest| rest.strip_suffix('/'));
    name.is_some_and(|name| !name.is_empty() && !name.contains('/'))
}

fn kind(name: &str) -> &'static str {
    match name.rsplit_once('.').map_or("", |(_, end)| end) {
        "html" => "text/html; charset=utf-8",
        "js" => "text/javascript; charset=utf-8",
        "css" => "text/css; charset=utf-8",
        "svg" => "image/svg+xml",
        "json" => "application/json",
        "woff2" => "font/woff2",
        "png" => "image/png",
        _ => "application/octet-stream",
    }
}
