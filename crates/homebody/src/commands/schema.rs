//! `homebody schema`: the JSON Schemas of the scenario files and of statements.

use crate::failure::Failure;
use crate::print::{json_text, tell, write_file};
use homebody_core::scenario::schema::schemas;
use homebody_log::LogError;
use homebody_routine::statement::Statement;
use std::fs;
use std::path::PathBuf;

/// Write the JSON Schemas of the scenario files, for text editors
///
/// One more schema describes statements, the sentences of a routine as data.
#[derive(clap::Args)]
#[command(
    after_long_help = "Example:\n  homebody schema schemas\n\nMost editors use the schema named by the \"$schema\" key of a file."
)]
pub struct SchemaArguments {
    /// Folder for the schemas; Homebody creates it if necessary
    folder: PathBuf,
}

impl SchemaArguments {
    pub fn run(self) -> Result<(), Failure> {
        fs::create_dir_all(&self.folder).map_err(|error| LogError::file(&self.folder, error))?;
        for (name, schema) in schemas().into_iter().chain([Statement::list_schema()]) {
            let path = self.folder.join(name);
            // Schemas are made, never written by hand: newer ones replace them.
            write_file(&path, json_text(&schema)?.as_bytes(), true)?;
            tell(path.display());
        }
        Ok(())
    }
}
