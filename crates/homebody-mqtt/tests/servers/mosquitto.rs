//! A mosquitto for one test.

use homebody_log::Url;
use std::fs;
use std::net::{TcpListener, TcpStream};
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// The longest wait of a test, on however slow a machine (our choice).
pub const SOON: Duration = Duration::from_secs(60);

pub struct Broker {
    pub folder: TempDir,
    pub port: u16,
    child: Option<Child>,
}

impl Broker {
    /// A broker without logins; None without mosquitto, which is reported.
    pub fn start() -> Option<Broker> {
        // However slow a listener is, nothing is left out for it.
        Broker::with("allow_anonymous true\nmax_queued_messages 0\n")
    }

    /// A broker with these lines in its configuration, where `FOLDER` is its own folder.
    pub fn with(lines: &str) -> Option<Broker> {
        let folder = tempfile::tempdir().unwrap();
        let broker = Broker { port: free_port(), folder, child: None };
        let lines = lines.replace("FOLDER", &broker.folder.path().display().to_string());
        let config = format!("user root\nlistener {} 127.0.0.1\n{lines}", broker.port);
        fs::write(broker.folder.path().join("mosquitto.conf"), config).unwrap();
        is_installed().then(|| broker.again())
    }

    /// The same one, begun again after it was killed.
    pub fn again(mut self) -> Broker {
        self.begin();
        self
    }

    pub fn begin(&mut self) {
        let config = self.folder.path().join("mosquitto.conf");
        let log = fs::File::create(self.folder.path().join("log")).unwrap();
        let child = Command::new(program().unwrap()).arg("-c").arg(config).stdout(Stdio::null()).stderr(log).spawn();
        self.child = Some(child.unwrap());
        let begun = Instant::now();
        while TcpStream::connect(("127.0.0.1", self.port)).is_err() {
            assert!(begun.elapsed() < SOON, "{}", fs::read_to_string(self.folder.path().join("log")).unwrap());
            thread::sleep(Duration::from_millis(5));
        }
    }

    pub fn kill(&mut self) {
        if let Some(mut child) = self.child.take() {
            child.kill().unwrap();
            child.wait().unwrap();
        }
    }

    #[allow(dead_code, reason = "one of the programs of tests stops it")]
    pub fn stop(&mut self) {
        if let Some(mut child) = self.child.take() {
            assert!(Command::new("kill").arg(child.id().to_string()).status().unwrap().success());
            child.wait().unwrap();
        }
    }

    pub fn signal(&self, signal: &str) {
        let id = self.child.as_ref().unwrap().id().to_string();
        assert!(Command::new("kill").args([signal, &id]).status().unwrap().success());
    }

    pub fn url(&self, rest: &str) -> Url {
        format!("mqtt://127.0.0.1:{}/{rest}", self.port).parse().unwrap()
    }

    pub fn say(&self, topic: &str, payload: &str, more: &[&str]) {
        let port = self.port.to_string();
        let args = ["-h", "127.0.0.1", "-p", &port, "-q", "1", "-t", topic, "-m", payload];
        assert!(Command::new("mosquitto_pub").args(args).args(more).status().unwrap().success());
    }
}

impl Drop for Broker {
    fn drop(&mut self) {
        self.kill();
    }
}

/// Debian puts it outside the usual PATH.
fn program() -> Option<PathBuf> {
    let path = std::env::var_os("PATH").unwrap_or_default();
    let folders = std::env::split_paths(&path).chain(["/usr/sbin".into(), "/usr/local/sbin".into()]);
    folders.map(|folder| folder.join("mosquitto")).find(|program| program.exists())
}

/// Whether mosquitto is installed; an error if it must be and is not.
pub fn is_installed() -> bool {
    let clients = || Command::new("mosquitto_sub").arg("--help").stdout(Stdio::null()).status().is_ok();
    let is_there = program().is_some() && clients();
    if !is_there {
        println!("skipped: mosquitto and mosquitto-clients are not installed");
        assert!(std::env::var("HOMEBODY_SERVERS").as_deref() != Ok("required"), "mosquitto is required");
    }
    is_there
}

pub fn free_port() -> u16 {
    TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port()
}
