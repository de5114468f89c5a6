//! Builds the page in `web/` with npm, into the program. If that fails, the program is built with a page that gives the reason: the
//! command line needs no page.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

fn main() {
    let web = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default()).join("../../web");
    let page = PathBuf::from(env::var_os("OUT_DIR").unwrap_or_default()).join("page");
    for watched in
        ["src", "public", "index.html", "package.json", "package-lock.json", "vite.config.ts", "with-node.sh"]
    {
        println!("cargo:rerun-if-changed={}", web.join(watched).display());
    }
    // The plan's editor and the form of statements take their fields from them.
    for schema in ["home.schema.json", "statements.schema.json"] {
        println!("cargo:rerun-if-changed={}", web.join("../schemas").join(schema).display());
    }
    println!("cargo:rustc-env=HOMEBODY_PAGE={}", page.display());
    if let Err(why) = build(&web, &page) {
        println!("cargo:warning=the web page is not built: {why}; all but `homebody serve` works without it");
        say_why(&page, &why);
    }
}

fn build(web: &Path, page: &Path) -> Result<(), String> {
    if !web.join("package.json").is_file() {
        return Err("its source is not here".into());
    }
    let lock = fs::read(web.join("package-lock.json")).map_err(|error| format!("web/package-lock.json: {error}"))?;
    // Skips the installation of an unchanged lock file.
    let stamp = web.join("node_modules/.homebody-lock");
    if fs::read(&stamp).ok().as_ref() != Some(&lock) {
        npm(web, &["ci", "--no-audit", "--no-fund"])?;
        fs::write(&stamp, &lock).map_err(|error| format!("web/node_modules: {error}"))?;
    }
    let out = page.to_string_lossy();
    npm(web, &["run", "build", "--", "--outDir", &out, "--emptyOutDir"])
}

/// Runs npm with a suitable Node.js, which is installed if the system's is too old.
fn npm(web: &Path, words: &[&str]) -> Result<(), String> {
    let done = Command::new("sh").args(["with-node.sh", "npm"]).args(words).current_dir(web).output();
    let done = done.map_err(|error| format!("npm cannot be run ({error})"))?;
    if done.status.success() {
        return Ok(());
    }
    let said = String::from_utf8_lossy(&done.stderr).into_owned() + &String::from_utf8_lossy(&done.stdout);
    let last: Vec<&str> = said.lines().filter(|line| !line.trim().is_empty()).rev().take(5).collect();
    let last: Vec<&str> = last.into_iter().rev().collect();
    Err(format!("npm {} has failed: {}", words.join(" "), last.join(" | ")))
}

/// A page with the reason of the failure.
fn say_why(page: &Path, why: &str) {
    let why = why.replace('&', "&amp;").replace('<', "&lt;");
    let text = format!(
        "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><title>Homebody</title><h1>This page was not built</h1>\
         <p>{why}</p><p>Once that is mended, run <code>touch web/package.json</code>, and build the program again.</p></html>\n"
    );
    let _ = fs::remove_dir_all(page);
    let written = fs::create_dir_all(page).and_then(|()| fs::write(page.join("index.html"), text));
    if let Err(error) = written {
        println!("cargo:warning=there is not even a page that says so: {error}");
    }
}
