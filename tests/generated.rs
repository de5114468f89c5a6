//! Files of the repository that are made from the code: each is held against it, or written anew.

use std::fs;
use std::path::Path;

/// Makes sure that a file is this text; `path` is its place in the repository. With `HOMEBODY_REWRITE=1` it is written anew.
pub fn is_generated(path: &str, text: &str) {
    let place = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(path);
    if std::env::var_os("HOMEBODY_REWRITE").is_some() {
        fs::create_dir_all(place.parent().unwrap()).unwrap();
        fs::write(&place, text).unwrap();
    }
    let written = fs::read_to_string(&place).unwrap_or_default();
    let line = 1 + written.lines().zip(text.lines()).take_while(|(written, made)| written == made).count();
    assert!(written == text, "{path}:{line} is not what the code says; HOMEBODY_REWRITE=1 writes it anew");
}

/// Makes sure that a part of a page, between the line `begin` and the line `<!-- end -->`, is this text.
#[allow(dead_code, reason = "some crates make whole files only")]
pub fn is_generated_between(path: &str, begin: &str, made: &str) {
    let page = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(path)).unwrap();
    let (before, rest) = page.split_once(begin).expect("the beginning of the part");
    let (_, after) = rest.split_once("<!-- end -->\n").expect("the end of the part");
    is_generated(path, &format!("{before}{begin}\n{made}<!-- end -->\n{after}"));
}
