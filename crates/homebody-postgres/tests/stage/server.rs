//! A server of PostgreSQL for tests.
#![allow(dead_code, reason = "each test file uses a part of it")]

use sha2::{Digest, Sha256};
use std::fs;
use std::io::Write;
use std::os::unix::fs::{MetadataExt, PermissionsExt, chown};
use std::os::unix::process::CommandExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::OnceLock;
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// The user for a server where root may not run one: `nobody`.
const NOBODY: u32 = 65_534;

/// Starts a server, and ends it once the other end of its input is closed, by a drop or a death. Unless the folder stays, it removes that,
/// too: a test program's one shared server, or one that died, has no other cleaner.
const KEEPER: &str = r#"folder=$PWD; "$@" & server=$!; said=$(cat); kill -QUIT $server 2> /dev/null; wait $server
                        [ "$said" = stays ] || { cd /; rm -rf "$folder"; }"#;

const WHO: &str = "local all ann scram-sha-256\nlocal all all trust\nhost all ann 127.0.0.1/32 scram-sha-256\n\
                   host all all 127.0.0.1/32 trust\n";

/// A server of PostgreSQL in a folder of its own, reached by its socket there, and by TCP where a port was asked for.
pub struct Server {
    programs: PathBuf,
    folder: TempDir,
    keeper: Option<Child>,
    settings: Vec<String>,
    port: u16,
}

impl Server {
    pub fn start() -> Option<Server> {
        Server::start_with(&["fsync=off"])
    }

    pub fn start_with(settings: &[&str]) -> Option<Server> {
        Server::start_at(5432, settings, &[])
    }

    /// A server with these files next to its data.
    pub fn start_at(port: u16, settings: &[&str], files: &[(&str, Vec<u8>)]) -> Option<Server> {
        let Some(programs) = programs() else {
            let why = "PostgreSQL is not installed: no initdb in /usr/lib/postgresql/*/bin nor on the PATH";
            assert_ne!(std::env::var("HOMEBODY_SERVERS").as_deref(), Ok("required"), "{why}");
            println!("skipped: {why}");
            return None;
        };
        let folder = tempfile::Builder::new().prefix("homebody-pg-").tempdir_in("/tmp").unwrap();
        if is_root() {
            chown(folder.path(), Some(NOBODY), Some(NOBODY)).unwrap();
        }
        let settings = settings.iter().map(|setting| (*setting).to_owned()).collect();
        let mut server = Server { programs, folder, keeper: None, settings, port };
        let made = server
            .program("initdb")
            .args(["-U", "postgres", "-E", "UTF8", "--locale", "C", "--no-sync", "-A", "trust", "-D"])
            .arg(server.data())
            .stdout(Stdio::null())
            .status()
            .unwrap();
        assert!(made.success(), "initdb makes a database");
        fs::write(server.data().join("pg_hba.conf"), WHO).unwrap();
        for (name, bytes) in files {
            let path = server.data().join(name);
            fs::write(&path, bytes).unwrap();
            fs::set_permissions(&path, fs::Permissions::from_mode(0o600)).unwrap();
            if is_root() {
                chown(&path, Some(NOBODY), Some(NOBODY)).unwrap();
            }
        }
        server.restart();
        Some(server)
    }

    /// One server for all tests of a program, which ends with it.
    pub fn shared() -> Option<&'static Server> {
        static SHARED: OnceLock<Option<Server>> = OnceLock::new();
        SHARED.get_or_init(Server::start).as_ref()
    }

    /// A new database on that server, and its URL.
    pub fn with_database(name: &str) -> Option<(&'static Server, String, String)> {
        let server = Server::shared()?;
        let database = server.database(name);
        let url = server.url("postgres", &database, "");
        Some((server, database, url))
    }

    pub fn folder(&self) -> &Path {
        self.folder.path()
    }

    fn data(&self) -> PathBuf {
        self.folder.path().join("data")
    }

    fn program(&self, name: &str) -> Command {
        self.as_nobody(self.programs.join(name))
    }

    fn as_nobody(&self, program: impl AsRef<std::ffi::OsStr>) -> Command {
        let mut command = Command::new(program);
        command.current_dir(self.folder.path());
        if is_root() {
            command.uid(NOBODY).gid(NOBODY);
        }
        command
    }

    /// Starts the server; one that was killed just now leaves others of its processes for a moment.
    pub fn restart(&mut self) {
        self.stop();
        let began = Instant::now();
        loop {
            let mut command = self.as_nobody("sh");
            command.args(["-c", KEEPER, "keeper"]).arg(self.programs.join("postgres"));
            command.arg("-D").arg(self.data()).arg("-k").arg(self.folder.path());
            command.args(["-p", &self.port.to_string()]);
            for setting in ["listen_addresses=", "max_connections=50", "shared_buffers=32MB"] {
                command.args(["-c", setting]);
            }
            for setting in &self.settings {
                command.args(["-c", setting]);
            }
            let log = fs::File::create(self.folder.path().join("log")).unwrap();
            command.stdin(Stdio::piped()).stdout(Stdio::null()).stderr(log);
            self.keeper = Some(command.spawn().unwrap());
            let tried = Instant::now();
            while tried.elapsed() < Duration::from_secs(10) {
                if self.try_psql("postgres", "SELECT 1").is_ok() {
                    return;
                }
                std::thread::sleep(Duration::from_millis(20));
                if self.pid().is_none() && tried.elapsed() > Duration::from_millis(500) {
                    break;
                }
            }
            self.stop();
            let log = fs::read_to_string(self.folder.path().join("log")).unwrap_or_default();
            assert!(began.elapsed() < Duration::from_secs(60), "the server starts: {log}");
        }
    }

    /// Kills the server's first process, and lets nothing else of it end orderly.
    pub fn kill(&self) {
        if let Some(pid) = self.pid() {
            let _ = Command::new("kill").args(["-9", &pid.to_string()]).status();
        }
    }

    pub fn stop(&mut self) {
        if let Some(mut keeper) = self.keeper.take() {
            // It is gone where the server has never begun.
            let _ = keeper.stdin.take().map(|mut input| input.write_all(b"stays"));
            let began = Instant::now();
            while keeper.try_wait().is_ok_and(|ended| ended.is_none()) {
                if began.elapsed() > Duration::from_secs(10) {
                    self.kill();
                    let _ = keeper.kill();
                }
                std::thread::sleep(Duration::from_millis(5));
            }
        }
    }

    fn pid(&self) -> Option<u32> {
        fs::read_to_string(self.data().join("postmaster.pid")).ok()?.lines().next()?.parse().ok()
    }

    pub fn socket(&self) -> PathBuf {
        self.folder.path().join(".s.PGSQL.5432")
    }

    pub fn url(&self, user: &str, database: &str, more: &str) -> String {
        format!("postgresql://{user}@/{database}?host={}{more}", self.folder.path().display())
    }

    pub fn database(&self, name: &str) -> String {
        self.psql("postgres", &format!("CREATE DATABASE {name}"));
        name.to_owned()
    }

    pub fn psql(&self, database: &str, sql: &str) -> String {
        self.try_psql(database, sql).unwrap_or_else(|error| panic!("{sql}: {error}"))
    }

    pub fn try_psql(&self, database: &str, sql: &str) -> Result<String, String> {
        let mut command = self.program("psql");
        command.args(["-XAtq", "-v", "ON_ERROR_STOP=1", "-U", "postgres", "-h"]).arg(self.folder.path());
        command.args(["-p", &self.port.to_string()]);
        let said = command.args(["-d", database, "-c", sql]).stdin(Stdio::null()).output().unwrap();
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).trim_end().to_owned();
        if said.status.success() { Ok(text(&said.stdout)) } else { Err(text(&said.stderr)) }
    }

    /// The SHA-256 of all rows of a run without its id, table by table in an order of their own, and of its entry.
    pub fn dump(&self, database: &str, schema: &str, run: i64) -> String {
        let tables = format!("SELECT unnest(tables) FROM {schema}.homebody_run WHERE run_id = {run}");
        let mut digest = Sha256::new();
        let about = "holds, home, scenario, seed, version, zone, started_at, ended_at, tables, rows";
        digest.update(self.psql(database, &format!("SELECT {about} FROM {schema}.homebody_run WHERE run_id = {run}")));
        for table in self.psql(database, &tables).lines() {
            let columns = format!(
                "SELECT string_agg(quote_ident(attname), ', ' ORDER BY attnum) FROM pg_attribute \
                 WHERE attrelid = '{schema}.{table}'::regclass AND attnum > 1"
            );
            let columns = self.psql(database, &columns);
            let rows = format!("SELECT {columns} FROM {schema}.{table} WHERE run_id = {run} ORDER BY {columns}");
            digest.update(self.psql(database, &rows));
        }
        digest.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
    }

    /// Of the log and of the truth.
    pub fn dumps(&self, database: &str, run: i64) -> [String; 2] {
        ["public", "truth"].map(|schema| self.dump(database, schema, run))
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        self.stop();
    }
}

fn is_root() -> bool {
    fs::metadata("/proc/self").is_ok_and(|found| found.uid() == 0)
}

/// The folder of a server's programs: the newest that is installed.
fn programs() -> Option<PathBuf> {
    let versions = fs::read_dir("/usr/lib/postgresql").into_iter().flatten().flatten();
    let mut found: Vec<PathBuf> = versions.map(|version| version.path().join("bin")).collect();
    found.sort();
    found.reverse();
    let path = std::env::var_os("PATH").unwrap_or_default();
    found.extend(std::env::split_paths(&path));
    found.into_iter().find(|folder| ["initdb", "postgres", "psql"].iter().all(|name| folder.join(name).is_file()))
}
