//! The kinds of places that a log can go to and come from: one table, for the check, the command line and the page.

use crate::messages::Diagnose;
use crate::nearest::nearest;
use crate::problem::{Diagnostic, readable};
use std::borrow::Cow;
use std::error::Error;
use std::fmt;

/// A kind of place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Scheme {
    /// A database file of SQLite.
    Sqlite,
    /// Comma-separated values with a header line.
    Csv,
    /// The text that the CASAS smart homes write.
    Casas,
    /// A JSON object a line.
    Jsonl,
    /// Parquet: a file, or a folder of files by run and day.
    Parquet,
    /// A file of Arrow IPC.
    Arrow,
    /// A database of PostgreSQL.
    Postgresql,
    /// A broker of MQTT.
    Mqtt,
    /// A broker of MQTT, over TLS.
    Mqtts,
}

/// What there is to know of a kind of place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SchemeRow {
    /// The kind of place that the row is about.
    pub scheme: Scheme,
    /// What stands before the colon, such as `sqlite`.
    pub name: &'static str,
    /// What it is, in words.
    pub what: &'static str,
    /// What comes after the colon, in words for a hint.
    pub at: &'static str,
    /// What a log is usually called there; empty for servers.
    pub usual: &'static str,
    /// Where it is.
    pub stands: Stands,
    /// The feature of the build without which it is only known by name; None where every build has it.
    pub feature: Option<&'static str>,
}

/// Where a kind of place is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stands {
    /// In a file of text, or on standard output.
    Text,
    /// In a file, or a folder of files.
    File,
    /// Elsewhere, on a server.
    Server,
}

/// What stands for standard output, where text may go.
pub const OUTPUT: &str = "-";

/// All kinds, in the order in which people are told of them.
pub const SCHEMES: [SchemeRow; 9] = [
    SchemeRow {
        scheme: Scheme::Sqlite,
        name: "sqlite",
        what: "an SQLite database file, with the table and columns of the network",
        at: "FILE",
        usual: "log.db",
        stands: Stands::File,
        feature: None,
    },
    SchemeRow {
        scheme: Scheme::Csv,
        name: "csv",
        what: "comma-separated values with a header line",
        at: "FILE",
        usual: "log.csv",
        stands: Stands::Text,
        feature: None,
    },
    SchemeRow {
        scheme: Scheme::Casas,
        name: "casas",
        what: "the text format of the CASAS homes: time, sensor and message, separated by tabs",
        at: "FILE",
        usual: "log.txt",
        stands: Stands::Text,
        feature: None,
    },
    SchemeRow {
        scheme: Scheme::Jsonl,
        name: "jsonl",
        what: "one JSON object a line, with the column names as keys",
        at: "FILE",
        usual: "log.jsonl",
        stands: Stands::Text,
        feature: None,
    },
    SchemeRow {
        scheme: Scheme::Parquet,
        name: "parquet",
        what: "Parquet: one file if the name ends in .parquet, else a folder of files by run and day",
        at: "FOLDER",
        usual: "log.parquet",
        stands: Stands::File,
        feature: Some("parquet"),
    },
    SchemeRow {
        scheme: Scheme::Arrow,
        name: "arrow",
        what: "an Arrow IPC file, also known as Feather",
        at: "FILE",
        usual: "log.arrow",
        stands: Stands::File,
        feature: Some("parquet"),
    },
    SchemeRow {
        scheme: Scheme::Postgresql,
        name: "postgresql",
        what: "a PostgreSQL database, with the table and columns of the network",
        at: "//USER@HOST/DATABASE",
        usual: "",
        stands: Stands::Server,
        feature: Some("postgresql"),
    },
    SchemeRow {
        scheme: Scheme::Mqtt,
        name: "mqtt",
        what: "an MQTT broker, with a topic for each sensor",
        at: "//HOST/PREFIX",
        usual: "",
        stands: Stands::Server,
        feature: Some("mqtt"),
    },
    SchemeRow {
        scheme: Scheme::Mqtts,
        name: "mqtts",
        what: "the same over TLS",
        at: "//HOST/PREFIX",
        usual: "",
        stands: Stands::Server,
        feature: Some("mqtt"),
    },
];

/// The extensions of each kind of place, for paths alone.
const EXTENSIONS: [(Scheme, &[&str]); 5] = [
    (Scheme::Sqlite, &["db", "sqlite", "sqlite3"]),
    (Scheme::Csv, &["csv"]),
    (Scheme::Jsonl, &["jsonl"]),
    (Scheme::Parquet, &["parquet"]),
    (Scheme::Arrow, &["arrow"]),
];

/// The endings of compressed text.
const PACKED: [&str; 2] = [".gz", ".zst"];

/// The extensions that a path alone may have, for a hint.
pub const KNOWN_EXTENSIONS: &str = ".csv, .csv.gz, .jsonl, .jsonl.gz, .db, .sqlite, .sqlite3, .parquet or .arrow";

/// Where a log goes if nobody says otherwise.
pub const USUAL: &str = "sqlite:log.db";

/// Why a text names no place, and what to write instead.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NoPlace {
    /// What is wrong with the text, as a part of a sentence.
    pub what: String,
    /// What to write instead.
    pub hint: String,
}

impl fmt::Display for NoPlace {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}\n  hint: {}", self.what, self.hint)
    }
}

impl Error for NoPlace {}

crate::messages! {
    /// Problems with the places of logs.
    pub enum PlaceMessage in "place" {
        /// The place of a log is a form, a colon and a file, such as `csv:week.csv`, or the URL of a server.
        Invalid { what: String, hint: String } error "invalid" ("{what}") hint ("{hint}");
    }
}

impl Diagnose for NoPlace {
    fn diagnostic(&self) -> Diagnostic {
        PlaceMessage::Invalid { what: self.what.clone(), hint: self.hint.clone() }.diagnostic()
    }
}

impl SchemeRow {
    /// The row of a name. `postgres` is what many call PostgreSQL.
    pub fn named(name: &str) -> Option<&'static SchemeRow> {
        let name = if name == "postgres" { "postgresql" } else { name };
        SCHEMES.iter().find(|row| row.name == name)
    }

    /// The row whose files have this extension. `.txt` is in no row: every kind of text has it.
    pub fn by_extension(extension: &str) -> Option<&'static SchemeRow> {
        let of = |(scheme, names): &(Scheme, &[&str])| names.contains(&extension).then(|| scheme.row());
        EXTENSIONS.iter().find_map(of)
    }

    /// The row of a path without a kind before it, such as `week.csv` or `week.csv.gz`, by its extension.
    fn of_path(path: &str) -> Option<&'static SchemeRow> {
        let name = path.rsplit(['/', '\\']).next()?.to_ascii_lowercase();
        let (packed, is_packed) = match PACKED.iter().find_map(|ending| name.strip_suffix(ending)) {
            Some(stem) => (stem, true),
            None => (name.as_str(), false),
        };
        let (stem, extension) = packed.rsplit_once('.')?;
        let row = SchemeRow::by_extension(extension).filter(|_| !stem.is_empty())?;
        (!is_packed || row.stands == Stands::Text).then_some(row)
    }
}

/// A place as it may be repeated to people: what stands as a password in it is left out.
pub fn without_password(place: &str) -> Cow<'_, str> {
    // A stroke is easily forgotten: what a server is named by begins behind the colon all the same.
    let is_server = |name: &&str| SchemeRow::named(name).is_some_and(|row| row.stands == Stands::Server);
    let scheme = place.split_once(':').map(|(name, _)| name).filter(is_server);
    let Some(begin) = place.find("//").map(|at| at + 2).or(scheme.map(|name| name.len() + 1)) else {
        return place.into();
    };
    let (before, rest) = place.split_at(begin);
    // A password may hold a question mark, where somebody has not written it as %3F: behind a real one there are names and values.
    let user_ends = rest.rfind('@').unwrap_or(0);
    let is_real = |at: &usize| *at > user_ends || rest[*at..user_ends].contains('=');
    let question = rest.match_indices('?').map(|(at, _)| at).find(is_real);
    let (main, query) = question.map_or((rest, None), |at| (&rest[..at], Some(&rest[at + 1..])));
    // What belongs to a user may hold a stroke, where somebody has not written it as %2F.
    let (user, host) = main.rsplit_once('@').map_or((None, main), |(user, host)| (Some(user), host));
    let name = user.map(|user| user.split_once(':').map_or(user, |(name, _)| name));
    let is_open = |pair: &&str| !pair.split('=').next().is_some_and(|name| name.ends_with("password"));
    let open: Option<Vec<&str>> = query.map(|query| query.split('&').filter(is_open).collect());
    let pairs = |query: &str| query.split('&').count();
    if user == name && open.as_ref().map(Vec::len) == query.map(pairs) {
        return place.into();
    }
    let name = name.map_or(String::new(), |name| format!("{name}@"));
    let open = open.filter(|open| !open.is_empty()).map_or(String::new(), |open| format!("?{}", open.join("&")));
    format!("{before}{name}{host}{open}").into()
}

impl Scheme {
    /// The row of the table.
    pub fn row(self) -> &'static SchemeRow {
        SCHEMES.iter().find(|row| row.scheme == self).unwrap_or(&SCHEMES[0])
    }

    /// Parts a place such as `csv:week.csv` into its kind and what comes after the colon. A path alone, such as `week.csv`, is of the
    /// kind that its extension names.
    pub fn split(place: &str) -> Result<(Scheme, &str), NoPlace> {
        let told = without_password(place);
        if let Some(row) = Scheme::of_path_alone(place) {
            return Ok((row.scheme, place));
        }
        let nowhere =
            |hint| NoPlace { what: readable(format!("{told:?} is not a place for a log")), hint: readable(hint) };
        // One letter before a colon is a drive, not a scheme.
        let (scheme, at) = place.split_once(':').filter(|(scheme, _)| scheme.len() > 1).unwrap_or((place, ""));
        let Some(row) = SchemeRow::named(scheme) else {
            let at = without_password(at);
            let is_text = place.to_ascii_lowercase().ends_with(".txt");
            return Err(nowhere(match (nearest(scheme, SCHEMES.map(|row| row.name)), SchemeRow::of_path(place)) {
                (Some(near), _) if at.is_empty() => {
                    let form = SchemeRow::named(near).map_or("FILE", |row| row.at);
                    format!("did you mean \"{near}:{form}\"?")
                }
                (Some(near), _) => format!("did you mean \"{near}:{at}\"?"),
                (None, Some(row)) => format!("did you mean \"{}:{told}\"?", row.name),
                (None, None) if is_text => format!("did you mean \"casas:{told}\", or \"csv:{told}\"?"),
                (None, None) => format!("write {}; a path alone ends in {KNOWN_EXTENSIONS}", forms()),
            }));
        };
        let form = || format!("write {}:{}", row.name, row.at);
        let none = |what: &str| NoPlace { what: readable(format!("{told:?} does not name a {what}")), hint: form() };
        match row.stands {
            Stands::Server if at.strip_prefix("//").is_none_or(|at| at.trim().is_empty()) => Err(none("server")),
            Stands::Server if told != place => {
                let what = readable(format!(
                    "{told:?} had a password in it, which shell histories and lists of processes show"
                ));
                Err(NoPlace { what, hint: row.scheme.instead_of_password().into() })
            }
            Stands::Text | Stands::File if at.trim().is_empty() => Err(none("file")),
            Stands::File if at == OUTPUT => {
                let hint = format!("name a file, or write one of {} to standard output", texts());
                Err(NoPlace {
                    what: readable(format!("{place:?} cannot be standard output: {} is not text", row.name)),
                    hint,
                })
            }
            _ => Ok((row.scheme, at)),
        }
    }

    /// The row of a place that is a path alone, by its extension. A word before a colon is a kind, even one that is not known; a
    /// drive such as `C:` and folders whose names hold a colon are parts of a path.
    fn of_path_alone(place: &str) -> Option<&'static SchemeRow> {
        let is_kind = |(name, _): (&str, &str)| name.len() > 1 && !name.contains(['/', '\\', '.']);
        let is_path = !place.split_once(':').is_some_and(is_kind) && without_password(place) == place;
        SchemeRow::of_path(place).filter(|_| is_path)
    }

    /// Where a password goes that is in no URL.
    fn instead_of_password(self) -> &'static str {
        match self {
            Scheme::Postgresql => {
                "leave the password out, and write HOST:PORT:DATABASE:USER:PASSWORD into ~/.pgpass, which nobody else may read \
                 (chmod 600), or set PGPASSWORD; ?passfile=FILE names another file"
            }
            _ => "leave the password out; the document of this kind of place says where to put it",
        }
    }

    /// The kinds that a scenario's file may name: what it brings along goes to nobody's server.
    pub fn of_scenarios() -> impl Iterator<Item = &'static SchemeRow> {
        SCHEMES.iter().filter(|row| row.stands != Stands::Server)
    }
}

/// `csv:-, casas:- or jsonl:-`.
pub fn texts() -> String {
    let rows = SCHEMES.iter().filter(|row| row.stands == Stands::Text);
    listed(&rows.map(|row| format!("{}:{OUTPUT}", row.name)).collect::<Vec<_>>())
}

/// `sqlite:FILE, csv:FILE` and so on, of all kinds.
pub fn forms() -> String {
    listed(&SCHEMES.map(|row| format!("{}:{}", row.name, row.at)))
}

/// The same of those that a scenario's file may name.
pub fn forms_of_scenarios() -> String {
    listed(&Scheme::of_scenarios().map(|row| format!("{}:{}", row.name, row.at)).collect::<Vec<_>>())
}

/// What can be said instead of one another.
fn listed(names: &[String]) -> String {
    match names {
        [first @ .., last] if !first.is_empty() => format!("{} or {last}", first.join(", ")),
        all => all.concat(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_scheme_has_one_row() {
        for row in &SCHEMES {
            assert_eq!(row.scheme.row(), row);
            let at = if row.stands == Stands::Server { row.at } else { row.usual };
            assert_eq!(Scheme::split(&format!("{}:{at}", row.name)), Ok((row.scheme, at)));
        }
        assert!(Scheme::split(USUAL).is_ok());
    }

    #[test]
    fn a_wrong_place_says_what_is_known() {
        for (place, told) in [
            ("log", "write sqlite:FILE, csv:FILE, casas:FILE, jsonl:FILE, parquet:FOLDER"),
            ("log", "a path alone ends in .csv, .csv.gz"),
            ("week.xyz", "csv:FILE"),
            ("C:\\x", "csv:FILE"),
            ("log.db.gz", "csv:FILE"),
            (".csv", "csv:FILE"),
            ("log.txt", "did you mean \"casas:log.txt\", or \"csv:log.txt\"?"),
            ("redis:log.db", "did you mean \"sqlite:redis:log.db\"?"),
            ("cvs:log.csv", "did you mean \"csv:log.csv\"?"),
            ("redis:log", "or mqtts://HOST/PREFIX"),
            ("sqlit:log", "did you mean \"sqlite:log\"?"),
            ("csv:", "write csv:FILE"),
            ("postgresql:log", "write postgresql://USER@HOST/DATABASE"),
            ("postgresq://ann@host/homes", "did you mean \"postgresql://ann@host/homes\"?"),
            ("mqtt://", "write mqtt://HOST/PREFIX"),
            ("sqlite:-", "csv:-, casas:- or jsonl:-"),
        ] {
            let error = Scheme::split(place).unwrap_err().to_string();
            assert!(error.contains(told), "{error}");
        }
    }

    #[test]
    fn a_path_alone_goes_by_its_extension() {
        for (place, scheme) in [
            ("log.db", Scheme::Sqlite),
            ("runs/a.b/log.sqlite3", Scheme::Sqlite),
            ("a.sqlite", Scheme::Sqlite),
            ("week.CSV", Scheme::Csv),
            ("week.csv.gz", Scheme::Csv),
            ("week.jsonl", Scheme::Jsonl),
            ("week.jsonl.gz", Scheme::Jsonl),
            ("week.parquet", Scheme::Parquet),
            ("week.arrow", Scheme::Arrow),
            ("C:\\log.db", Scheme::Sqlite),
            ("./a:b.csv", Scheme::Csv),
        ] {
            assert_eq!(Scheme::split(place), Ok((scheme, place)), "{place}");
        }
        assert!(Scheme::split("//ann:s3cr3t@host/log.csv").is_err(), "a server without its kind");
        for (_, extensions) in EXTENSIONS {
            assert!(extensions.iter().all(|extension| KNOWN_EXTENSIONS.contains(extension)), "{extensions:?}");
        }
    }

    #[test]
    fn a_password_is_refused_and_never_repeated() {
        for place in [
            "postgresql://ann:s3cr3t-canary@host/homes",
            "postgres://ann:s3cr3t@canary@host/homes?schema=a",
            "postgresql://ann@host/homes?password=s3cr3t-canary&schema=a",
            "postgresq://ann:s3cr3t-canary@host/homes",
            "mqtt://ann:s3cr3t/canary@host/home",
            "postgresql://ann:s3cr3t?canary@host/homes?schema=a",
            "mqtt:/ann:s3cr3t-canary@host/home",
            "postgresql:ann:s3cr3t-canary@host/homes",
            "redis://ann:s3cr3t-canary@host",
        ] {
            let told = Scheme::split(place).unwrap_err().to_string();
            assert!(told.contains("ann@host") && !told.contains("s3cr3t") && !told.contains("canary"), "{told}");
        }
        for place in [
            "postgresql://ann@host:5432/homes?passfile=secret",
            "postgres://host",
            "mqtt://[::1]:1883/home",
            "postgresql://host:5432/homes?user=ann@home",
        ] {
            assert!(Scheme::split(place).is_ok(), "{place}");
            assert_eq!(without_password(place), place);
        }
    }
}
