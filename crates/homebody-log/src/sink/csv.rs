//! Comma-separated values with a header line, quoted as RFC 4180 says; lines end in a line feed alone.

use super::Opening;
use crate::clock::Clock;
use crate::error::LogError;
use crate::fresh::FreshFile;
use crate::mapping::Shown;
use crate::messages::Row;
use crate::writer::Sink;
use homebody_core::time::Micros;
use std::path::Path;

/// A text file of a row a line.
pub(crate) struct Csv {
    file: FreshFile,
    clock: Clock,
    /// Quoted where they need it, as texts are.
    sensors: Vec<String>,
    shown: Shown,
    value: String,
    line: Vec<u8>,
}

impl Csv {
    pub fn open(path: &Path, opening: &Opening) -> Result<Csv, LogError> {
        let (columns, mut shown) = (opening.columns, opening.shown.clone());
        shown.texts.iter_mut().for_each(|text| *text = quoted(text));
        let mut file = FreshFile::create(path, opening.force)?;
        let header = [&columns.seq, &columns.time, &columns.sensor, &columns.value].map(|name| quoted(name));
        file.write(format!("{}\n", header.join(",")).as_bytes())?;
        Ok(Csv {
            file,
            clock: opening.clock(),
            sensors: shown.sensors.iter().map(|name| quoted(name)).collect(),
            shown,
            value: String::new(),
            line: Vec::new(),
        })
    }
}

impl Sink for Csv {
    type Row = Row;

    fn path(&self) -> &Path {
        self.file.path()
    }

    fn write(&mut self, rows: &[Row]) -> Result<(), LogError> {
        for row in rows {
            self.line.clear();
            self.line.extend_from_slice(row.seq.to_string().as_bytes());
            self.line.push(b',');
            self.line.extend_from_slice(self.clock.text(row.at).as_bytes());
            self.line.push(b',');
            self.line.extend_from_slice(self.sensors[row.sensor.index()].as_bytes());
            self.line.push(b',');
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

/// A field, in quotes where it needs them.
fn quoted(field: &str) -> String {
    if field.contains([',', '"', '\n', '\r']) { format!("\"{}\"", field.replace('"', "\"\"")) } else { field.into() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_needs_quotes_has_them() {
        assert_eq!(quoted("bedroom motion"), "bedroom motion");
        assert_eq!(quoted("a,b"), "\"a,b\"");
        assert_eq!(quoted("the \"old\" one"), "\"the \"\"old\"\" one\"");
        assert_eq!(quoted("two\nlines"), "\"two\nlines\"");
    }
}
