//! `homebody serve`: the web app, on this machine.

use super::scenario::Trust;
use crate::failure::Failure;
use crate::print::{print_text, tell, warn};
use crate::signals::{Signals, begin_other};
use homebody_core::scenario::load::{Files, NoText};
use homebody_log::run::places::RUNS;
use homebody_simulation::SimulationError;
use homebody_web::address_file::AddressFileError;
use homebody_web::folders::HomeFolders;
use homebody_web::library::Library;
use homebody_web::{Offer, Options, PageAddress, ServeError};
use serde_json::Value;
use std::net::{IpAddr, Ipv4Addr};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

homebody_core::messages! {
    /// Problems with the page and its server.
    pub enum ServeMessage in "serve" {
        /// The page needs one address that browsers can open and that only belongs to this machine.
        EveryAddress { ip: String } error "every-address"
            ("{ip} means every address of this machine, and the page needs a single one")
            hint ("pass --bind the address at which other machines reach this one");
        /// The page needs the token of the printed address. Other machines can try to guess it, and see the traffic of the network.
        Exposed { ip: String } warning "exposed"
            ("anyone who reaches {ip} can reach this server, and its traffic is not encrypted")
            hint ("leave out --bind to serve this machine only");
        /// The page opens scenarios with problems, lists the problems, and helps to fix them. Runs are possible after that.
        Problems { count: usize } warning "problems"
            ("the scenario cannot run yet (problems: {count}); the page helps to fix them");
    }
}

/// Open the page of a scenario: watch, edit, steer and replay it
///
/// For a folder of scenarios (the current folder by default), a first page lists all homes. You can make, copy, rename, delete and
/// restore homes there.
///
/// By default, only this machine can reach the page. The address that Homebody prints contains a token, without which the page does
/// not open. To open the browser, Homebody writes the address to a file that only you can read. It then removes the file. Programs
/// send the token, the part of the address after `#token=`, in the header `X-Homebody-Token`.
///
/// Runs go into new folders under runs/, as with homebody run. For a folder of homes, they go into the runs/ of each home. The page
/// also opens a scenario with problems, and helps to fix them. Ctrl-C ends the run and the server with exit code 0.
#[derive(clap::Args)]
#[command(after_long_help = "Examples:
  homebody serve scenarios/tigerplace
  homebody serve my-home --port 9000 --no-open
  homebody serve                                     all homes of the current folder
  homebody serve homes --address-file ~/.homebody    the same address next time")]
pub struct ServeArguments {
    /// Scenario folder, its scenario.json, or a folder of scenarios
    #[arg(default_value = ".", hide_default_value = true)]
    scenario: PathBuf,
    #[command(flatten)]
    trust: Trust,
    /// Port (default: the first free one from 8642 on)
    #[arg(long)]
    port: Option<u16>,
    /// Store port and token in this file, so that the address stays the same. Only you can read the file
    #[arg(long, value_name = "FILE")]
    address_file: Option<PathBuf>,
    /// Print the address without opening a browser
    #[arg(long)]
    no_open: bool,
    /// Listen on this IP address instead of 127.0.0.1. Other machines can then connect, unless it is a loopback address
    #[arg(long, value_name = "IP")]
    bind: Option<IpAddr>,
}

impl ServeArguments {
    pub fn run(self) -> Result<(), Failure> {
        let signals = Signals::listen()?;
        let offer = self.offer()?;
        let ip = self.bind.unwrap_or(Ipv4Addr::LOCALHOST.into()).to_canonical();
        if ip.is_unspecified() {
            return Err(Failure::asked(ServeMessage::EveryAddress { ip: ip.to_string() }));
        }
        if !ip.is_loopback() {
            warn(ServeMessage::Exposed { ip: ip.to_string() });
        }
        let browser = !self.no_open;
        let options = Options { ip, port: self.port, browser, kept: self.address_file, ..Options::new(offer) };
        let ready = |address: PageAddress| {
            // A closed standard output does not matter.
            let _ = print_text(&format!("{}\n", address.url));
            if browser && !address.file.is_some_and(open) {
                tell("open this address in a browser");
            }
        };
        Ok(homebody_web::serve(options, signals.cancel(), ready)?)
    }
}

impl ServeArguments {
    fn offer(&self) -> Result<Offer, Failure> {
        let is_trusted = self.trust.is_given();
        if is_library(&self.scenario) {
            tell(format_args!("{} has no scenario.json: serving all homes in it", self.scenario.display()));
            return Ok(Library::new(self.scenario.clone(), is_trusted).into());
        }
        let source = self.trust.source(&self.scenario)?;
        let scenario = source.folder().unwrap_or(Path::new("")).to_owned();
        let folders =
            HomeFolders { scenario, entry: source.entry().to_owned(), is_trusted, runs: Path::new(RUNS).into() };
        match source.open() {
            Err(SimulationError::Problems(problems)) if can_be_mended(&folders) => {
                warn(ServeMessage::Problems { count: problems.0.len() });
            }
            opened => drop(opened?),
        }
        Ok(folders.into())
    }
}

/// True for a folder that does not belong to a scenario.
fn is_library(path: &Path) -> bool {
    path.is_dir() && path.join("scenario.json").symlink_metadata().is_err()
}

/// True if the page can show all files with problems. It cannot show unreadable files, and files outside the folder.
fn can_be_mended(folders: &HomeFolders) -> bool {
    let Ok(text) = folders.read(&folders.entry) else { return false };
    let Ok(root) = serde_json::from_str::<Value>(&text) else { return false };
    let residents = root["residents"].as_array().into_iter().flatten();
    let mut named =
        [&root["home"], &root["logger"], &root["link"]].into_iter().chain(residents).filter_map(Value::as_str);
    !named.any(|name| matches!(folders.read(name), Err(NoText::Unreadable { .. })))
}

/// Opens the browser with the file that leads to the page. All users of the machine can read the arguments of a program, so the
/// address with its token is not an argument.
fn open(file: &Path) -> bool {
    let opener = if cfg!(target_os = "macos") { "open" } else { "xdg-open" };
    let mut command = Command::new(opener);
    command.arg(file).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    begin_other(|| command.spawn()).is_ok()
}

impl From<ServeError> for Failure {
    fn from(error: ServeError) -> Failure {
        match error {
            ServeError::Scenario(_)
            | ServeError::Foreign(_)
            | ServeError::AddressFile(AddressFileError::Open(_) | AddressFileError::NoAddress(_)) => {
                Failure::asked(error)
            }
            ServeError::NoPort { .. } | ServeError::Port { .. } => {
                Failure::file(error).advising("choose another port with --port")
            }
            _ => Failure::file(error),
        }
    }
}
