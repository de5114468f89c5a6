//! `homebody serve`: the web app, on this machine.

use super::scenario::Trust;
use crate::failure::Failure;
use crate::print::{print_text, tell};
use crate::signals::{Signals, begin_other};
use homebody_core::scenario::load::{Files, NoText};
use homebody_kit::Error;
use homebody_log::places::RUNS;
use homebody_web::kept_address::Unkept;
use homebody_web::library::Library;
use homebody_web::shelf::Shelf;
use homebody_web::{Address, Offer, Options, ServeError};
use serde_json::Value;
use std::net::{IpAddr, Ipv4Addr};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Opens a page on which a scenario is lived: seen, driven by keys, recorded and played again. Of a folder that holds scenarios, and of
/// the current folder where none is named, a first page shows all: new ones are begun there, copied, renamed, deleted and put back.
///
/// The page is served to this machine alone, and only to who has the address that is printed: it holds a token. A browser is led
/// there by a file that only you can read, and which is removed when it has come. Programs send the token, which is what stands
/// behind `#token=` in the address, in the header `X-Homebody-Token`. Runs go into new folders under runs/, as those
/// of homebody run; those of a home of a folder into its own folder runs/. A scenario with problems is served as well: the page says what is wrong, and mends it. Ctrl-C ends the run and the server, and that is no failure: the exit code is 0.
#[derive(clap::Args)]
#[command(after_long_help = "Examples:
  homebody serve scenarios/tigerplace
  homebody serve my-home --port 9000 --no-open
  homebody serve                                     all homes of the current folder
  homebody serve homes --keep-address ~/.homebody    under the same address next time")]
pub struct Arguments {
    /// The scenario's folder, or its scenario.json; or a folder of such folders
    #[arg(default_value = ".", hide_default_value = true)]
    scenario: PathBuf,
    #[command(flatten)]
    trust: Trust,
    /// The port to listen on; without it, the first free one from 8642 on
    #[arg(long)]
    port: Option<u16>,
    /// Keep port and token in this file, which only you can read, so that the address is the same next time; it is made if it is not
    /// there
    #[arg(long, value_name = "FILE")]
    keep_address: Option<PathBuf>,
    /// Only print the address, and open no browser
    #[arg(long)]
    no_open: bool,
    /// Listen on this address of the machine, and under its name alone; others than this machine can come unless it is loopback
    #[arg(long, value_name = "IP")]
    bind: Option<IpAddr>,
}

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        let signals = Signals::listen()?;
        let offer = self.offer()?;
        let ip = self.bind.unwrap_or(Ipv4Addr::LOCALHOST.into()).to_canonical();
        if ip.is_unspecified() {
            return Err(Failure::Usage(format!(
                "{ip} is every address of this machine, and the page must come under a single one\n  hint: name the one that others reach this machine by"
            )));
        }
        if !ip.is_loopback() {
            tell(format_args!(
                "warning: who can reach {ip} can reach this server, and what is said to it can be overheard on the way"
            ));
        }
        let browser = !self.no_open;
        let options = Options { ip, port: self.port, browser, kept: self.keep_address, ..Options::new(offer) };
        let ready = |address: Address| {
            // Nobody is there to read it where standard output is closed.
            let _ = print_text(&format!("{}\n", address.url));
            if browser && !address.file.is_some_and(open) {
                tell("open this address in a browser");
            }
        };
        Ok(homebody_web::serve(options, signals.cancel(), ready)?)
    }
}

impl Arguments {
    /// What is served: a scenario, or a folder of them.
    fn offer(&self) -> Result<Offer, Failure> {
        let is_trusted = self.trust.is_given();
        if is_library(&self.scenario) {
            tell(format_args!("{} has no scenario.json of its own: its homes are served", self.scenario.display()));
            return Ok(Library::new(self.scenario.clone(), is_trusted).into());
        }
        let source = self.trust.source(&self.scenario)?;
        let scenario = source.folder().unwrap_or(Path::new("")).to_owned();
        let shelf = Shelf { scenario, entry: source.entry().to_owned(), is_trusted, runs: Path::new(RUNS).into() };
        match source.open() {
            Err(Error::Problems(problems)) if can_be_mended(&shelf) => {
                let count = problems.0.len();
                tell(format_args!(
                    "warning: no run can be begun yet; the page shows what is wrong, and mends it ({count} problems)"
                ));
            }
            opened => drop(opened?),
        }
        Ok(shelf.into())
    }
}

/// Whether a path is a folder that is no scenario's.
fn is_library(path: &Path) -> bool {
    path.is_dir() && path.join("scenario.json").symlink_metadata().is_err()
}

/// Whether what is wrong with a scenario is in files that the page can show: what cannot be read, or leads out of the folder, it cannot.
fn can_be_mended(shelf: &Shelf) -> bool {
    let Ok(text) = shelf.read(&shelf.entry) else { return false };
    let Ok(root) = serde_json::from_str::<Value>(&text) else { return false };
    let residents = root["residents"].as_array().into_iter().flatten();
    let mut named =
        [&root["home"], &root["logger"], &root["link"]].into_iter().chain(residents).filter_map(Value::as_str);
    !named.any(|name| matches!(shelf.read(name), Err(NoText::Unreadable { .. })))
}

/// Opens the file that leads to the page in the browser that this machine has, if it has one: everybody may read what a
/// program is started with, so that the address itself, with its token, is not said there.
fn open(file: &Path) -> bool {
    let opener = if cfg!(target_os = "macos") { "open" } else { "xdg-open" };
    let mut command = Command::new(opener);
    command.arg(file).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    begin_other(|| command.spawn()).is_ok()
}

impl From<ServeError> for Failure {
    fn from(error: ServeError) -> Failure {
        match error {
            ServeError::Scenario(why) => Failure::Usage(why),
            ServeError::Foreign(_) | ServeError::Unkept(Unkept::Open(_) | Unkept::NoAddress(_)) => {
                Failure::usage(error)
            }
            ServeError::NoPort { .. } | ServeError::Port { .. } => Failure::Io(format!("{error}, by --port")),
            error => Failure::Io(error.to_string()),
        }
    }
}
