//! The text of the CASAS smart homes: `2009-03-02 07:12:03.250000<TAB>BedroomMotion<TAB>ON`.
//!
//! Always local time. A sensor's name is one word there: `bedroom motion` becomes `BedroomMotion`.

use super::Opening;
use crate::clock::Clock;
use crate::error::LogError;
use crate::fresh::FreshFile;
use crate::mapping::{Shown, apart};
use crate::messages::Row;
use crate::writer::Sink;
use homebody_core::scenario::logger::TimeFormat;
use homebody_core::time::Micros;
use std::path::Path;

/// A text file of a row a line.
pub(crate) struct Casas {
    file: FreshFile,
    clock: Clock,
    sensors: Vec<String>,
    shown: Shown,
    value: String,
    line: Vec<u8>,
}

impl Casas {
    pub fn open(path: &Path, opening: &Opening) -> Result<Casas, LogError> {
        let shown = opening.shown;
        let sensors = shown.sensors.iter().map(|name| one_word(name)).collect();
        apart(&shown.sensors, &sensors)?;
        let clock = Clock::new(opening.calendar, TimeFormat::Local);
        // Values are one word, too.
        let mut shown = shown.clone();
        shown.texts.iter_mut().for_each(|text| *text = one_word(text));
        Ok(Casas {
            file: FreshFile::create(path, opening.force)?,
            clock,
            sensors,
            shown: shown.clone(),
            value: String::new(),
            line: Vec::new(),
        })
    }
}

impl Sink for Casas {
    type Row = Row;

    fn path(&self) -> &Path {
        self.file.path()
    }

    fn write(&mut self, rows: &[Row]) -> Result<(), LogError> {
        for row in rows {
            self.line.clear();
            self.line.extend_from_slice(self.clock.text(row.at).as_bytes());
            self.line.push(b'\t');
            self.line.extend_from_slice(self.sensors[row.sensor.index()].as_bytes());
            self.line.push(b'\t');
            self.line.extend_from_slice(self.shown.value(row.value, &mut self.value).as_bytes());
            self.line.push(b'\n');
            self.file.write(&self.line)?;
        }
        Ok(())
    }

    fn settle(&mut self) -> Result<(), LogError> {
        self.file.flush()
    }

    fn finish(self: Box<Self>, _end: Micros) -> Result<(), LogError> {
        self.file.finish()
    }
}

/// A name without blanks; where it has some, each word begins with a capital.
pub(crate) fn one_word(name: &str) -> String {
    let words: Vec<&str> =
        name.split(|c: char| c.is_whitespace() || c.is_control()).filter(|w| !w.is_empty()).collect();
    match words[..] {
        [] => "_".into(),
        [word] => word.into(),
        _ => words.into_iter().map(capitalised).collect(),
    }
}

fn capitalised(word: &str) -> String {
    let mut letters = word.chars();
    letters.next().map(|first| first.to_uppercase().chain(letters).collect()).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_become_one_word() {
        for (name, word) in [
            ("bedroom motion", "BedroomMotion"),
            ("M001", "M001"),
            ("a\tb\nc", "ABC"),
            (" door ", "door"),
            ("über bett", "ÜberBett"),
            (" ", "_"),
        ] {
            assert_eq!(one_word(name), word);
        }
    }
}
