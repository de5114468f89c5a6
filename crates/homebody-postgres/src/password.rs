//! Sources of passwords, as for libpq: `PGPASSWORD`, else a password file that other users cannot read.

use crate::server::{Host, Server};
use homebody_log::files::plain::others_may_read;
use std::fs;
use std::path::{Path, PathBuf};

/// A password, and why a file that may have one was not read. It is in memory only while a connection is made.
#[derive(Default)]
pub(crate) struct PasswordSearch {
    pub password: Option<String>,
    pub ignored: Option<String>,
}

/// Largest number of bytes that are read from a password file (our choice).
const LARGEST_BYTES: u64 = 1 << 20;

pub(crate) fn find(server: &Server) -> PasswordSearch {
    if let Ok(password) = std::env::var("PGPASSWORD") {
        return PasswordSearch { password: Some(password), ignored: None };
    }
    let home = || std::env::var_os("HOME").map(|home| Path::new(&home).join(".pgpass"));
    let named = server.password_file.clone().or_else(|| std::env::var_os("PGPASSFILE").map(PathBuf::from));
    named.or_else(home).map_or_else(PasswordSearch::default, |file| in_file(&file, server))
}

fn in_file(file: &Path, server: &Server) -> PasswordSearch {
    let Ok(found) = fs::metadata(file) else { return PasswordSearch::default() };
    let ignored =
        |why: &str| PasswordSearch { password: None, ignored: Some(format!("{} is ignored: {why}", file.display())) };
    if !found.is_file() || found.len() > LARGEST_BYTES {
        return ignored("it is not a file of passwords");
    }
    if others_may_read(&found) {
        return ignored("others may read it; protect it with chmod 600");
    }
    match fs::read_to_string(file) {
        Ok(text) => PasswordSearch { password: text.lines().find_map(|line| of_line(line, server)), ignored: None },
        Err(error) => ignored(&error.to_string()),
    }
}

/// The password of a line `host:port:database:user:password`, if it is of this server. A star is anything.
fn of_line(line: &str, server: &Server) -> Option<String> {
    if line.starts_with('#') {
        return None;
    }
    let [host, port, database, user, password] = fields(line)?;
    let is_host = match &server.host {
        Host::Name(name) => host == *name,
        Host::Socket(folder) => host == "localhost" || Path::new(&host) == folder,
    };
    let fits = |said: &str, wanted: &str| said == "*" || said == wanted;
    let is_it = (host == "*" || is_host)
        && fits(&port, &server.port.to_string())
        && fits(&database, &server.database)
        && fits(&user, &server.user);
    is_it.then_some(password)
}

/// The fields of a line; a backslash escapes the next character.
fn fields(line: &str) -> Option<[String; 5]> {
    let mut fields: [String; 5] = Default::default();
    let mut field = 0;
    let mut letters = line.chars();
    while let Some(letter) = letters.next() {
        match letter {
            '\\' => fields[field].extend(letters.next()),
            ':' if field < 4 => field += 1,
            letter => fields[field].push(letter),
        }
    }
    (field == 4).then_some(fields)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn server(url: &str) -> Server {
        Server::parse(url).unwrap()
    }

    #[test]
    fn a_line_is_of_its_server_alone() {
        let here = server("postgresql://ann@host:5433/homes");
        for (line, password) in [
            ("host:5433:homes:ann:p:w", Some("p:w")),
            ("*:*:*:*:all\\:of\\\\it", Some("all:of\\it")),
            ("host:5432:homes:ann:p", None),
            ("host:5433:homes:bob:p", None),
            ("#host:5433:homes:ann:p", None),
            ("host:5433:homes", None),
        ] {
            assert_eq!(of_line(line, &here).as_deref(), password, "{line}");
        }
        let socket = server("postgresql://ann@/homes?host=/tmp");
        assert!(of_line("localhost:5432:homes:ann:p", &socket).is_some());
        assert!(of_line("/tmp:5432:homes:ann:p", &socket).is_some());
    }

    #[cfg(unix)]
    #[test]
    fn ignores_a_readable_password_file_and_says_so() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("pgpass");
        fs::write(&file, "# ours\n*:*:*:ann:right\n").unwrap();
        let here = server("postgresql://ann@host/homes");
        for (mode, is_read) in [(0o600, true), (0o400, true), (0o640, false), (0o604, false)] {
            fs::set_permissions(&file, fs::Permissions::from_mode(mode)).unwrap();
            let found = in_file(&file, &here);
            assert_eq!(found.password.as_deref(), is_read.then_some("right"), "{mode:o}");
            assert_eq!(found.ignored.is_some(), !is_read, "{mode:o}");
        }
        assert!(in_file(&folder.path().join("none"), &here).password.is_none());
    }
}
