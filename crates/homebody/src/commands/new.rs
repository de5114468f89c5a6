//! `homebody new`: a scenario of one's own, from one that works.

use crate::failure::Failure;
use crate::folder::OWN;
use crate::print::tell;
use homebody_core::scenario::schema::schemas;
use include_dir::Dir;
use serde_json::json;
use std::fs;
use std::path::{Path, PathBuf};

/// Begins a scenario of your own in a new folder, from a template that works.
#[derive(clap::Args)]
#[command(after_help = "Example:\n  homebody new my-home --template tigerplace && homebody run my-home")]
pub struct Arguments {
    /// The folder to create
    folder: PathBuf,
    /// The scenario to start from
    #[arg(long, default_value = "tigerplace", value_parser = template)]
    template: &'static Dir<'static>,
}

/// A template by its name.
fn template(name: &str) -> Result<&'static Dir<'static>, String> {
    OWN.get_dir(name).ok_or_else(|| {
        let names: Vec<_> = OWN.dirs().map(|dir| dir.path().display().to_string()).collect();
        format!("there is none of that name; there are: {}", names.join(", "))
    })
}

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        let folder = &self.folder;
        if fs::symlink_metadata(folder).is_ok() {
            return Err(Failure::Io(format!(
                "{} exists already\n  hint: name a folder that does not",
                folder.display()
            )));
        }
        let written = self.write();
        if written.is_err() {
            // Nothing is left half made.
            let _ = fs::remove_dir_all(folder);
        }
        written?;
        tell(format_args!("{} is ready.\n  homebody check {0}\n  homebody run {0}", folder.display()));
        Ok(())
    }

    fn write(&self) -> Result<(), Failure> {
        write(
            &self.folder.join("schemas"),
            schemas().into_iter().map(|(name, schema)| (name, format!("{schema:#}\n").into())),
        )?;
        let template = json!(self.template.path().display().to_string());
        let name = json!(self.folder.file_name().unwrap_or_default().to_string_lossy());
        let files = self.template.files().map(|file| {
            // The schemas of the repository are two folders up, ours are right here; and it has a name of its own.
            let text = String::from_utf8_lossy(file.contents())
                .replace("\"../../schemas/", "\"./schemas/")
                .replace(&format!("\"name\": {template}"), &format!("\"name\": {name}"));
            (file.path().file_name().and_then(|name| name.to_str()).unwrap_or_default(), text.into_bytes())
        });
        write(&self.folder, files)
    }
}

fn write<'a>(folder: &Path, files: impl Iterator<Item = (&'a str, Vec<u8>)>) -> Result<(), Failure> {
    fs::create_dir_all(folder).map_err(|error| Failure::io(folder, error))?;
    for (name, bytes) in files {
        let path = folder.join(name);
        fs::write(&path, bytes).map_err(|error| Failure::io(&path, error))?;
    }
    Ok(())
}
