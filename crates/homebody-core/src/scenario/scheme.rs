//! The kinds of places that a log can go to and come from: one table, for the check, the command line and the page.

use super::nearest::nearest;
use crate::problem::readable;
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
        what: "a database file, with a table as the network has it",
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
        what: "the text of the CASAS homes: time, sensor and message, parted by tabs",
        at: "FILE",
        usual: "log.txt",
        stands: Stands::Text,
        feature: None,
    },
    SchemeRow {
        scheme: Scheme::Jsonl,
        name: "jsonl",
        what: "a JSON object a line, with the names of the columns",
        at: "FILE",
        usual: "log.jsonl",
        stands: Stands::Text,
        feature: None,
    },
    SchemeRow {
        scheme: Scheme::Parquet,
        name: "parquet",
        what: "Parquet: one file where its name ends in .parquet, else a folder of files by run and day",
        at: "FOLDER",
        usual: "log.parquet",
        stands: Stands::File,
        feature: Some("parquet"),
    },
    SchemeRow {
        scheme: Scheme::Arrow,
        name: "arrow",
        what: "a file of Arrow IPC, which is also known as Feather",
        at: "FILE",
        usual: "log.arrow",
        stands: Stands::File,
        feature: Some("parquet"),
    },
    SchemeRow {
        scheme: Scheme::Postgresql,
        name: "postgresql",
        what: "a database of PostgreSQL, with a table as the network has it",
        at: "//USER@HOST/DATABASE",
        usual: "",
        stands: Stands::Server,
        feature: Some("postgresql"),
    },
    SchemeRow {
        scheme: Scheme::Mqtt,
        name: "mqtt",
        what: "a broker of MQTT, a topic for each sensor",
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

impl Scheme {
    /// The row of the table.
    pub fn row(self) -> &'static SchemeRow {
        SCHEMES.iter().find(|row| row.scheme == self).unwrap_or(&SCHEMES[0])
    }

    /// Parts a place such as `csv:week.csv` into its kind and what comes after the colon.
    pub fn split(place: &str) -> Result<(Scheme, &str), NoPlace> {
        let nowhere =
            |hint| NoPlace { what: readable(format!("{place:?} is nowhere a log can go")), hint: readable(hint) };
        // One letter before a colon is a drive, not a scheme.
        let (scheme, at) = place.split_once(':').filter(|(scheme, _)| scheme.len() > 1).unwrap_or((place, ""));
        let Some(row) = SCHEMES.iter().find(|row| row.name == scheme) else {
            return Err(nowhere(match nearest(scheme, SCHEMES.map(|row| row.name)) {
                Some(near) => format!("did you mean \"{near}:{at}\"?"),
                None => format!("write {}", forms()),
            }));
        };
        let form = || format!("write {}:{}", row.name, row.at);
        let none = |what: &str| NoPlace { what: readable(format!("{place:?} names no {what}")), hint: form() };
        match row.stands {
            Stands::Server if at.strip_prefix("//").is_none_or(|at| at.trim().is_empty()) => Err(none("server")),
            Stands::Text | Stands::File if at.trim().is_empty() => Err(none("file")),
            Stands::File if at == OUTPUT => {
                let hint = format!("name a file, or write one of {} to standard output", texts());
                Err(NoPlace { what: readable(format!("{place:?}: {} is no text", row.name)), hint })
            }
            _ => Ok((row.scheme, at)),
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
            ("log.db", "write sqlite:FILE, csv:FILE, casas:FILE, jsonl:FILE, parquet:FOLDER"),
            ("C:\\log.db", "write sqlite:FILE"),
            ("redis:log", "or mqtts://HOST/PREFIX"),
            ("sqlit:log", "did you mean \"sqlite:log\"?"),
            ("csv:", "write csv:FILE"),
            ("postgresql:log", "write postgresql://USER@HOST/DATABASE"),
            ("mqtt://", "write mqtt://HOST/PREFIX"),
            ("sqlite:-", "csv:-, casas:- or jsonl:-"),
        ] {
            let error = Scheme::split(place).unwrap_err().to_string();
            assert!(error.contains(told), "{error}");
        }
    }
}
