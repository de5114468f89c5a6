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
    /// What a log is usually called there.
    pub usual: &'static str,
}

/// All kinds, in the order in which people are told of them.
pub const SCHEMES: [SchemeRow; 3] = [
    SchemeRow {
        scheme: Scheme::Sqlite,
        name: "sqlite",
        what: "a database file, with a table as the network has it",
        at: "FILE",
        usual: "log.db",
    },
    SchemeRow {
        scheme: Scheme::Csv,
        name: "csv",
        what: "comma-separated values with a header line",
        at: "FILE",
        usual: "log.csv",
    },
    SchemeRow {
        scheme: Scheme::Casas,
        name: "casas",
        what: "the text of the CASAS homes: time, sensor and message, parted by tabs",
        at: "FILE",
        usual: "log.txt",
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
        match at.trim().is_empty() {
            true => Err(NoPlace {
                what: readable(format!("{place:?} names no file")),
                hint: format!("write {}:{}", row.name, row.at),
            }),
            false => Ok((row.scheme, at)),
        }
    }
}

/// `sqlite:FILE, csv:FILE or casas:FILE`.
pub fn forms() -> String {
    let forms = SCHEMES.map(|row| format!("{}:{}", row.name, row.at));
    match &forms[..] {
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
            assert_eq!(Scheme::split(&format!("{}:{}", row.name, row.usual)), Ok((row.scheme, row.usual)));
        }
        assert!(Scheme::split(USUAL).is_ok());
    }

    #[test]
    fn a_wrong_place_says_what_is_known() {
        for (place, told) in [
            ("log.db", "write sqlite:FILE, csv:FILE or casas:FILE"),
            ("C:\\log.db", "write sqlite:FILE"),
            ("mysql:log", "write sqlite:FILE, csv:FILE or casas:FILE"),
            ("sqlit:log", "did you mean \"sqlite:log\"?"),
            ("csv:", "write csv:FILE"),
        ] {
            let error = Scheme::split(place).unwrap_err().to_string();
            assert!(error.contains(told), "{error}");
        }
    }
}
