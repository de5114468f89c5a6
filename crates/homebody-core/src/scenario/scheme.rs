//! The kinds of places that a log can go to and come from: one table, for the check, the command line and the page.

use crate::messages::Diagnose;
use crate::nearest::nearest;
use crate::problem::{Diagnostic, readable};
use std::borrow::Cow;
use std::error::Error;
use std::fmt;

/// The properties of a kind of place: all that the check, the command, the page and the log ask of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SchemeRow {
    /// The kind itself.
    pub scheme: Scheme,
    /// The text before the colon, such as `sqlite`.
    pub name: &'static str,
    /// A description in words.
    pub what: &'static str,
    /// The part after the colon, in words for a hint.
    pub at: &'static str,
    /// The usual name of a log there; empty for servers.
    pub usual: &'static str,
    /// Extensions of its files. A path without a kind is of the kind of its extension; `.txt` is in no row, since every kind of
    /// text has it.
    pub extensions: &'static [&'static str],
    /// Text, a file or a server.
    pub stands: Stands,
    /// The placement of several tables, such as those of a truth.
    pub tables: TablePlacement,
    /// Whether it holds the sensors of a log itself. Other files have a table of sensors next to them.
    pub has_sensors: bool,
    /// Whether it reports how many rows it holds. Rows that other places confirm are noted in the run's folder.
    pub reports_rows: bool,
    /// Whether a fleet can write its homes there.
    pub takes_fleets: bool,
    /// The feature of the build without which only its name is known; None where every build has it.
    pub feature: Option<&'static str>,
}

/// The placement of several tables in a kind of place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TablePlacement {
    /// It holds one table, whose rows may have notes of activities.
    OneWithNotes,
    /// It holds one table.
    One,
    /// Each table has a file of its own: `truth.csv` becomes `truth.room.csv` and so on.
    FileEach,
    /// All are in one database.
    Together,
}

/// The nature of a kind of place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stands {
    /// In a file of text, or on standard output.
    Text,
    /// In a file, or a folder of files.
    File,
    /// Elsewhere, on a server.
    Server,
}

/// The name of standard output, where text may go.
pub const OUTPUT: &str = "-";

/// Declares the kinds of places, and a row for each.
macro_rules! schemes {
    ($($(#[$doc:meta])* $scheme:ident { $($column:ident: $value:expr,)* })*) => {
        /// A kind of place.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Scheme {
            $($(#[$doc])* $scheme,)*
        }

        /// All kinds, in the order of help texts.
        pub const SCHEMES: [SchemeRow; [$(Scheme::$scheme),*].len()] =
            [$(SchemeRow { scheme: Scheme::$scheme, $($column: $value,)* },)*];
    };
}

schemes! {
    /// A database file of SQLite.
    Sqlite {
        name: "sqlite",
        what: "an SQLite database file, with the table and columns of the network",
        at: "FILE",
        usual: "log.db",
        extensions: &["db", "sqlite", "sqlite3"],
        stands: Stands::File,
        tables: TablePlacement::Together,
        has_sensors: true,
        reports_rows: true,
        takes_fleets: false,
        feature: None,
    }
    /// Comma-separated values with a header line.
    Csv {
        name: "csv",
        what: "comma-separated values with a header line",
        at: "FILE",
        usual: "log.csv",
        extensions: &["csv"],
        stands: Stands::Text,
        tables: TablePlacement::FileEach,
        has_sensors: false,
        reports_rows: false,
        takes_fleets: false,
        feature: None,
    }
    /// The text that the CASAS smart homes write.
    Casas {
        name: "casas",
        what: "the text format of the CASAS homes: time, sensor and message, separated by tabs",
        at: "FILE",
        usual: "log.txt",
        extensions: &[],
        stands: Stands::Text,
        tables: TablePlacement::OneWithNotes,
        has_sensors: false,
        reports_rows: false,
        takes_fleets: false,
        feature: None,
    }
    /// A JSON object a line.
    Jsonl {
        name: "jsonl",
        what: "one JSON object a line, with the column names as keys",
        at: "FILE",
        usual: "log.jsonl",
        extensions: &["jsonl"],
        stands: Stands::Text,
        tables: TablePlacement::FileEach,
        has_sensors: false,
        reports_rows: false,
        takes_fleets: true,
        feature: None,
    }
    /// Parquet: a file, or a folder of files by run and day.
    Parquet {
        name: "parquet",
        what: "Parquet: one file if the name ends in .parquet, else a folder of files by run and day",
        at: "FOLDER",
        usual: "log.parquet",
        extensions: &["parquet"],
        stands: Stands::File,
        tables: TablePlacement::FileEach,
        has_sensors: true,
        reports_rows: false,
        takes_fleets: false,
        feature: Some("parquet"),
    }
    /// A file of Arrow IPC.
    Arrow {
        name: "arrow",
        what: "an Arrow IPC file, also known as Feather",
        at: "FILE",
        usual: "log.arrow",
        extensions: &["arrow"],
        stands: Stands::File,
        tables: TablePlacement::FileEach,
        has_sensors: true,
        reports_rows: false,
        takes_fleets: false,
        feature: Some("parquet"),
    }
    /// A database of PostgreSQL.
    Postgresql {
        name: "postgresql",
        what: "a PostgreSQL database, with the table and columns of the network",
        at: "//USER@HOST/DATABASE",
        usual: "",
        extensions: &[],
        stands: Stands::Server,
        tables: TablePlacement::Together,
        has_sensors: true,
        reports_rows: true,
        takes_fleets: true,
        feature: Some("postgresql"),
    }
    /// A broker of MQTT.
    Mqtt {
        name: "mqtt",
        what: "an MQTT broker, with a topic for each sensor",
        at: "//HOST/PREFIX",
        usual: "",
        extensions: &[],
        stands: Stands::Server,
        tables: TablePlacement::One,
        has_sensors: false,
        reports_rows: false,
        takes_fleets: true,
        feature: Some("mqtt"),
    }
    /// A broker of MQTT, over TLS.
    Mqtts {
        name: "mqtts",
        what: "the same over TLS",
        at: "//HOST/PREFIX",
        usual: "",
        extensions: &[],
        stands: Stands::Server,
        tables: TablePlacement::One,
        has_sensors: false,
        reports_rows: false,
        takes_fleets: true,
        feature: Some("mqtt"),
    }
}

/// The endings of compressed text.
const PACKED: [&str; 2] = [".gz", ".zst"];

/// The default place of a log.
pub const USUAL: &str = "sqlite:log.db";

/// Why a text names no place, and what to write instead.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NoPlace {
    /// The problem of the text, as a part of a sentence.
    pub what: String,
    /// A text to write instead.
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

    /// The row whose files have this extension.
    pub fn by_extension(extension: &str) -> Option<&'static SchemeRow> {
        SCHEMES.iter().find(|row| row.extensions.contains(&extension))
    }

    /// The rows of places with a file for each of several tables.
    pub fn with_files_of_tables() -> impl Iterator<Item = &'static SchemeRow> {
        SCHEMES.iter().filter(|row| row.tables == TablePlacement::FileEach)
    }

    /// The row of a path without a kind before it, such as `week.csv` or `week.csv.gz`, by its extension.
    pub fn by_path(path: &str) -> Option<&'static SchemeRow> {
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
    // A password may hold a question mark that was not written as %3F: behind a real one there are names and values.
    let user_ends = rest.rfind('@').unwrap_or(0);
    let is_real = |at: &usize| *at > user_ends || rest[*at..user_ends].contains('=');
    let question = rest.match_indices('?').map(|(at, _)| at).find(is_real);
    let (main, query) = question.map_or((rest, None), |at| (&rest[..at], Some(&rest[at + 1..])));
    // The user's part may hold a stroke that was not written as %2F.
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
        const ROWS: &[SchemeRow] = &SCHEMES;
        &ROWS[self as usize]
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
            return Err(nowhere(match (nearest(scheme, SCHEMES.map(|row| row.name)), SchemeRow::by_path(place)) {
                (Some(near), _) if at.is_empty() => {
                    let form = SchemeRow::named(near).map_or("FILE", |row| row.at);
                    format!("did you mean \"{near}:{form}\"?")
                }
                (Some(near), _) => format!("did you mean \"{near}:{at}\"?"),
                (None, Some(row)) => format!("did you mean \"{}:{told}\"?", row.name),
                (None, None) if is_text => format!("did you mean \"casas:{told}\", or \"csv:{told}\"?"),
                (None, None) => format!("write {}; a path alone ends in {}", forms(), known_extensions()),
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
        SchemeRow::by_path(place).filter(|_| is_path)
    }

    /// The proper place of a password.
    fn instead_of_password(self) -> &'static str {
        match self {
            Scheme::Postgresql => {
                "leave the password out, and write HOST:PORT:DATABASE:USER:PASSWORD into ~/.pgpass, which nobody else may read \
                 (chmod 600), or set PGPASSWORD; ?passfile=FILE names another file"
            }
            _ => "leave the password out; the document of this kind of place says where to put it",
        }
    }

    /// The kinds that a scenario's file may name: a scenario never writes to a server.
    pub fn of_scenarios() -> impl Iterator<Item = &'static SchemeRow> {
        SCHEMES.iter().filter(|row| row.stands != Stands::Server)
    }
}

/// The extensions that a path alone may have, for a hint: `.csv, .csv.gz` and so on. Those of text come first.
pub fn known_extensions() -> String {
    let (texts, others): (Vec<&SchemeRow>, Vec<&SchemeRow>) =
        SCHEMES.iter().partition(|row| row.stands == Stands::Text);
    let texts =
        texts.iter().flat_map(|row| row.extensions).flat_map(|text| [format!(".{text}"), format!(".{text}.gz")]);
    let others = others.iter().flat_map(|row| row.extensions).map(|file| format!(".{file}"));
    listed(&texts.chain(others).collect::<Vec<_>>())
}

/// The kinds of text on standard output: `csv:-, casas:-` and so on.
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

/// Alternatives in words.
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
    fn splits_the_usual_place_of_each_scheme() {
        for row in &SCHEMES {
            let at = if row.stands == Stands::Server { row.at } else { row.usual };
            assert_eq!(Scheme::split(&format!("{}:{at}", row.name)), Ok((row.scheme, at)));
        }
        assert!(Scheme::split(USUAL).is_ok());
    }

    #[test]
    fn a_wrong_place_lists_the_known_forms() {
        for (place, told) in [
            ("log", "write sqlite:FILE, csv:FILE, casas:FILE, jsonl:FILE, "),
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
            ("sqlite:-", "csv:-, casas:-"),
        ] {
            let error = Scheme::split(place).unwrap_err().to_string();
            assert!(error.contains(told), "{error}");
        }
    }

    #[test]
    fn a_path_alone_has_the_kind_of_its_extension() {
        #[rustfmt::skip]
        let cases = [
            ("log.db", Scheme::Sqlite), ("runs/a.b/log.sqlite3", Scheme::Sqlite), ("a.sqlite", Scheme::Sqlite),
            ("week.CSV", Scheme::Csv), ("week.csv.gz", Scheme::Csv), ("week.jsonl.zst", Scheme::Jsonl),
            ("C:\\log.db", Scheme::Sqlite), ("./a:b.csv", Scheme::Csv),
        ];
        for (place, scheme) in cases {
            assert_eq!(Scheme::split(place), Ok((scheme, place)), "{place}");
        }
        assert!(Scheme::split("//ann:s3cr3t@host/log.csv").is_err(), "a server without its kind");
        let known = known_extensions();
        assert!(known.starts_with(".csv, .csv.gz, ") && known.ends_with(" or .arrow"), "{known}");
        for (row, extension) in
            SCHEMES.iter().flat_map(|row| row.extensions.iter().map(move |extension| (row, extension)))
        {
            assert_eq!(SchemeRow::by_path(&format!("week.{extension}")), Some(row));
            let is_text = row.stands == Stands::Text;
            assert_eq!(SchemeRow::by_path(&format!("week.{extension}.gz")), is_text.then_some(row));
            assert_eq!(known.contains(&format!(".{extension}.gz")), is_text);
            assert!(known.contains(&format!(".{extension}")), "{known}");
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
