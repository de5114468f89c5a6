//! Reads the URL of a database: `postgresql://ann@host:5432/homes?schema=home1`, with the parameters of libpq.
//!
//! Parts that a URL lacks come from the environment, as for libpq: `PGHOST`, `PGPORT`, `PGUSER`, `PGDATABASE`, `PGSSLMODE`,
//! `PGSSLROOTCERT`. A password in a URL is refused: it would end up in histories, in lists of processes and in messages.

use crate::messages::ServerUrlMessage;
use homebody_core::nearest::nearest;
use homebody_core::problem::readable;
use homebody_core::problems::UrlProblems;
use homebody_log::LogError;
use homebody_log::url::percent_decoded;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// A database on a server, and who asks for what in it. It knows no password.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Server {
    /// The original URL, for errors.
    pub place: String,
    pub host: Host,
    pub port: u16,
    pub user: String,
    pub database: String,
    /// The schema that tables are in; None for the usual one.
    pub schema: Option<String>,
    /// Which run of several is read.
    pub run: Option<String>,
    pub tls: Tls,
    /// The certificates that the server's is checked with; None for the usual ones.
    pub root_certificates: Option<PathBuf>,
    /// The time that the server has to accept the connection.
    pub connect_within: Duration,
    pub password_file: Option<PathBuf>,
    /// The name of this program in lists of the server.
    pub application: String,
    /// Settings of the connection, as `-c name=value`.
    pub options: Option<String>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Host {
    Name(String),
    /// The folder of a Unix socket.
    Socket(PathBuf),
}

/// The encryption of a connection, as in `sslmode`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Tls {
    Disable,
    Prefer,
    /// Always; whose certificate it is, is not asked, unless a file says which are trusted.
    Require,
    /// By a certificate of who is trusted.
    VerifyCa,
    /// By a certificate of who is trusted, for this host.
    VerifyFull,
}

const MODES: [(&str, Tls); 6] = [
    ("disable", Tls::Disable),
    ("allow", Tls::Prefer),
    ("prefer", Tls::Prefer),
    ("require", Tls::Require),
    ("verify-ca", Tls::VerifyCa),
    ("verify-full", Tls::VerifyFull),
];

/// The parameters that a URL may have behind its question mark.
const PARAMETERS: [&str; 12] = [
    "schema",
    "run",
    "host",
    "port",
    "user",
    "dbname",
    "sslmode",
    "sslrootcert",
    "connect_timeout",
    "passfile",
    "application_name",
    "options",
];

/// Those that are secret, and refused.
const SECRET: [&str; 2] = ["password", "sslpassword"];

/// Time that a server may take to accept a connection (our choice): a run that begins reports a failure within five
/// seconds.
const CONNECT_WITHIN: Duration = Duration::from_secs(4);

/// The usual folders of a server's socket.
const SOCKETS: [&str; 2] = ["/var/run/postgresql", "/tmp"];

impl Server {
    /// Reads a URL, or reports all its problems.
    pub fn parse(url: &str) -> Result<Server, LogError> {
        Server::parse_with(url, &|name| std::env::var(name).ok().filter(|value| !value.is_empty()))
    }

    fn parse_with(url: &str, environment: &dyn Fn(&str) -> Option<String>) -> Result<Server, LogError> {
        let mut problems = UrlProblems::default();
        let parts = UrlParts::read(url, &mut problems);
        let said =
            |name: &str, variable: &str| parts.parameter(name).map(str::to_owned).or_else(|| environment(variable));
        let port = said("port", "PGPORT").or(parts.port.clone());
        let port = number("port", port, 5432, 1..=65_535, &mut problems) as u16;
        let host = parts.parameter("host").map(str::to_owned).or(parts.host.clone()).or_else(|| environment("PGHOST"));
        if host.as_ref().is_some_and(|host| host.contains(',')) {
            problems.add(ServerUrlMessage::SeveralHosts);
        }
        let mode = said("sslmode", "PGSSLMODE").unwrap_or_else(|| "prefer".into());
        let tls = MODES.iter().find(|(name, _)| *name == mode).map(|(_, tls)| *tls);
        let tls = tls.unwrap_or_else(|| {
            let known = MODES.map(|(name, _)| name).to_vec();
            problems.add(ServerUrlMessage::SslMode { value: mode.clone(), known });
            Tls::VerifyFull
        });
        let schema = parts.parameter("schema").map(str::to_owned);
        if let Some(schema) = schema.as_ref().filter(|schema| !is_plain_name(schema) || is_servers_own(schema)) {
            problems.add(ServerUrlMessage::Schema { name: schema.clone() });
        }
        let seconds = said("connect_timeout", "PGCONNECT_TIMEOUT");
        let seconds = number("connect_timeout", seconds, CONNECT_WITHIN.as_secs(), 1..=3600, &mut problems);
        let user = parts.parameter("user").map(str::to_owned).or(parts.user.clone());
        let user = user.or_else(|| environment("PGUSER")).or_else(|| environment("USER"));
        let user = user.unwrap_or_else(|| {
            problems.add(ServerUrlMessage::NoUser);
            String::new()
        });
        let database = parts.parameter("dbname").map(str::to_owned).or(parts.database.clone());
        problems.refuse().map_err(LogError::BadUrl)?;
        Ok(Server {
            place: parts.place.clone(),
            host: host.map_or_else(|| usual_host(port), Host::from_text),
            port,
            database: database.or_else(|| environment("PGDATABASE")).unwrap_or_else(|| user.clone()),
            user,
            schema,
            run: parts.parameter("run").map(str::to_owned),
            tls,
            root_certificates: said("sslrootcert", "PGSSLROOTCERT").map(PathBuf::from),
            connect_within: Duration::from_secs(seconds),
            password_file: parts.parameter("passfile").map(PathBuf::from),
            application: said("application_name", "PGAPPNAME").unwrap_or_else(|| "homebody".into()),
            options: said("options", "PGOPTIONS"),
        })
    }
}

impl Host {
    fn from_text(text: String) -> Host {
        if text.starts_with('/') { Host::Socket(text.into()) } else { Host::Name(text) }
    }
}

/// The host if neither URL nor environment names one.
fn usual_host(port: u16) -> Host {
    let has_socket = |folder: &&&str| Path::new(folder).join(format!(".s.PGSQL.{port}")).exists();
    SOCKETS.iter().find(has_socket).map_or_else(|| Host::Name("localhost".into()), |folder| Host::Socket(folder.into()))
}

/// A name that may reach SQL: `^[a-z_][a-z0-9_]{0,62}$`.
pub(crate) fn is_plain_name(name: &str) -> bool {
    let letter = |byte: u8| byte.is_ascii_lowercase() || byte == b'_';
    let begins = name.bytes().next().is_some_and(letter);
    begins && name.len() <= 63 && name.bytes().all(|byte| letter(byte) || byte.is_ascii_digit())
}

fn is_servers_own(schema: &str) -> bool {
    schema.starts_with("pg_") || schema == "information_schema"
}

#[derive(Default)]
struct UrlParts {
    /// The URL without a password.
    place: String,
    user: Option<String>,
    host: Option<String>,
    port: Option<String>,
    database: Option<String>,
    parameters: Vec<(String, String)>,
}

impl UrlParts {
    fn read(url: &str, problems: &mut UrlProblems) -> UrlParts {
        let rest = url.split_once("//").map_or(url, |(_, rest)| rest);
        let (main, query) = rest.split_once('?').unwrap_or((rest, ""));
        let (authority, database) = main.split_once('/').unwrap_or((main, ""));
        // A password may hold an at sign: what is before the last one is the user's.
        let (user, host) = authority.rsplit_once('@').unwrap_or(("", authority));
        let (user, secret) = user.split_once(':').map_or((user, false), |(user, _)| (user, true));
        let (host, port) = match host.rsplit_once(':').filter(|(host, _)| !host.contains(':') || host.ends_with(']')) {
            Some((host, port)) => (host, port),
            None => (host, ""),
        };
        let is_secret = |pair: &&str| SECRET.contains(&pair.split('=').next().unwrap_or_default());
        let has_secret = secret || query.split('&').any(|pair| is_secret(&pair));
        let place = match has_secret {
            false => readable(url.to_owned()),
            true => readable(format!("postgresql://{user}@{host}/{database}")),
        };
        problems.place.clone_from(&place);
        if has_secret {
            problems.add(ServerUrlMessage::Password);
        }
        let mut parts = UrlParts { place, ..UrlParts::default() };
        let mut given = |text: &str| (!text.is_empty()).then(|| decoded(text, problems));
        parts.user = given(user);
        parts.host = given(host.strip_prefix('[').and_then(|host| host.strip_suffix(']')).unwrap_or(host));
        parts.port = given(port);
        parts.database = given(database);
        for pair in query.split('&').filter(|pair| !pair.is_empty() && !is_secret(pair)) {
            let (name, value) = pair.split_once('=').unwrap_or((pair, ""));
            if !PARAMETERS.contains(&name) {
                let advice = match nearest(name, PARAMETERS) {
                    Some(near) => format!("did you mean {near}?"),
                    None => format!("the parameters are {}", PARAMETERS.join(", ")),
                };
                problems.add(ServerUrlMessage::Unknown { name: name.into(), advice });
            } else if value.is_empty() {
                problems.add(ServerUrlMessage::NoValue { name: name.into() });
            } else {
                parts.parameters.push((name.to_owned(), decoded(value, problems)));
            }
        }
        parts
    }

    fn parameter(&self, name: &str) -> Option<&str> {
        self.parameters.iter().rfind(|(known, _)| known == name).map(|(_, value)| value.as_str())
    }
}

/// Percent signs and two digits are bytes.
fn decoded(text: &str, problems: &mut UrlProblems) -> String {
    // No text of the server's has a NUL.
    let Some(bytes) = percent_decoded(text).filter(|bytes| !bytes.contains(&0)) else {
        problems.add(ServerUrlMessage::Percent);
        return String::new();
    };
    String::from_utf8(bytes).unwrap_or_else(|_| {
        problems.add(ServerUrlMessage::NotUtf8);
        String::new()
    })
}

fn number(name: &str, text: Option<String>, usual: u64, range: RangeInclusive<u64>, problems: &mut UrlProblems) -> u64 {
    let Some(text) = text else { return usual };
    text.parse().ok().filter(|number| range.contains(number)).unwrap_or_else(|| {
        let (least, most) = (*range.start(), *range.end());
        problems.add(ServerUrlMessage::Number { name: name.into(), text: text.clone(), least, most });
        usual
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_problems_of_a_url_of_any_length() {
        let long = format!("postgresql://ann@host/homes?{}", "what=1&".repeat(100_000));
        let told = parse(&long).unwrap_err().to_string();
        assert!(told.len() < 20_000 && told.contains("there is no parameter \"what\""), "{} bytes", told.len());
    }

    fn parse(url: &str) -> Result<Server, LogError> {
        Server::parse_with(url, &|name| (name == "USER").then(|| "margaret".into()))
    }

    #[test]
    fn reads_server_user_and_database_of_a_url() {
        let server =
            parse("postgresql://ann%40home@db.example:5433/homes?schema=home1&sslmode=verify-full&run=7").unwrap();
        assert_eq!((server.user.as_str(), server.database.as_str(), server.port), ("ann@home", "homes", 5433));
        assert_eq!(server.host, Host::Name("db.example".into()));
        assert_eq!((server.schema.as_deref(), server.run.as_deref()), (Some("home1"), Some("7")));
        assert_eq!(server.tls, Tls::VerifyFull);
        let socket = parse("ann@/homes?host=/run/sockets").unwrap();
        assert_eq!(socket.host, Host::Socket("/run/sockets".into()));
        assert_eq!(parse("postgresql://%2Frun%2Fs/homes").unwrap().host, Host::Socket("/run/s".into()));
        let six = parse("ann@[::1]:6000/homes").unwrap();
        assert_eq!((six.host, six.port), (Host::Name("::1".into()), 6000));
        let bare = parse("postgresql://db").unwrap();
        assert_eq!((bare.user.as_str(), bare.database.as_str()), ("margaret", "margaret"));
    }

    #[test]
    fn a_password_in_a_url_is_refused_and_not_repeated() {
        for url in [
            "postgresql://ann:s3cr3t-canary@host/homes",
            "postgresql://ann:s3cr3t@canary@host/homes?schema=a",
            "postgresql://ann@host/homes?password=s3cr3t-canary",
            "postgresql://ann@host/homes?schema=A&password=s3cr3t-canary&sslpassword=s3cr3t-canary",
        ] {
            let error = parse(url).unwrap_err();
            let told = format!("{error} {error:?}");
            assert!(told.contains("~/.pgpass") && !told.contains("s3cr3t"), "{told}");
        }
    }

    #[test]
    fn reports_all_problems_at_once() {
        let error =
            parse("postgresql://ann@a,b:99999/homes?schem=x&sslmode=on&schema=pg_x&run=").unwrap_err().to_string();
        for told in [
            "several hosts",
            "port \"99999\"",
            "schem",
            "did you mean schema?",
            "\"on\" is not a valid value of sslmode",
            "pg_x",
            "run has no value",
        ] {
            assert!(error.contains(told), "{told}: {error}");
        }
        for schema in ["a\"; drop table x; --", "A", "1a", "", "\u{e9}", &"a".repeat(64)] {
            assert!(parse(&format!("ann@host/homes?schema={schema}")).is_err(), "{schema}");
        }
    }
}
