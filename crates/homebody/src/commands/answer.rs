//! What commands that answer a question leave: words for people, figures as JSON, pictures.

use crate::failure::Failure;
use crate::print::{print_json, print_text, write_file};
use homebody_log::fresh::all_can_be_written;
use homebody_study::picture::png;
use serde::Serialize;
use std::fmt::Display;
use std::path::{Path, PathBuf};

/// Where an answer goes, besides standard output.
#[derive(clap::Args)]
pub struct Answer {
    /// Write all figures as one JSON object into this file, or on standard output without one
    #[arg(long, value_name = "FILE", num_args = 0..=1, default_missing_value = "-")]
    json: Option<PathBuf>,
    #[command(flatten)]
    pictures: Pictures,
}

/// Where pictures go.
#[derive(clap::Args)]
pub struct Pictures {
    /// Draw it as SVG
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// Draw it as PNG
    #[arg(long, value_name = "FILE")]
    png: Option<PathBuf>,
    /// Width of the PNG in pixels
    #[arg(long, value_name = "PIXELS", default_value_t = 1600, value_parser = clap::value_parser!(u32).range(200..=8000))]
    width: u32,
    /// Replace files that exist
    #[arg(long)]
    force: bool,
}

/// A picture by what its file's name ends in: nothing for the first of an answer.
pub type Picture<'a> = (&'static str, &'a dyn Fn() -> String);

impl Answer {
    /// Makes sure that all files can be written, before anybody waits for the answer; `pictures` by their names.
    pub fn check(&self, pictures: &[&str]) -> Result<(), Failure> {
        self.pictures.check(pictures, self.json_file())
    }

    /// Draws the pictures that are asked for, and tells the figures: as JSON where that is asked for, else to people.
    pub fn give(&self, answer: &(impl Serialize + Display), pictures: &[Picture]) -> Result<(), Failure> {
        self.pictures.draw(pictures)?;
        match self.json_file() {
            Some(path) => {
                let text = serde_json::to_string_pretty(answer).map_err(Failure::usage)? + "\n";
                write_file(path, text.as_bytes(), self.pictures.force)?;
                print_text(&answer.to_string())
            }
            None if self.json.is_some() => print_json(answer),
            None => print_text(&answer.to_string()),
        }
    }

    fn json_file(&self) -> Option<&Path> {
        self.json.as_deref().filter(|path| path.as_os_str() != "-")
    }
}

impl Pictures {
    /// Whether no picture is asked for.
    pub fn is_empty(&self) -> bool {
        self.svg.is_none() && self.png.is_none()
    }

    /// Makes sure that all pictures can be written, and a file beside them.
    pub fn check(&self, pictures: &[&str], beside: Option<&Path>) -> Result<(), Failure> {
        let paths = self.svg.iter().chain(&self.png);
        let files: Vec<PathBuf> = paths.flat_map(|path| pictures.iter().map(|name| named(path, name))).collect();
        let all: Vec<&Path> = files.iter().map(PathBuf::as_path).chain(beside).collect();
        Ok(all_can_be_written(&all, self.force)?)
    }

    /// Draws what is asked for.
    pub fn draw(&self, pictures: &[Picture]) -> Result<(), Failure> {
        if self.is_empty() {
            return Ok(());
        }
        for (name, picture) in pictures {
            let svg = picture();
            if let Some(path) = &self.svg {
                write_file(&named(path, name), svg.as_bytes(), self.force)?;
            }
            if let Some(path) = &self.png {
                let bytes = png(&svg, self.width).map_err(Failure::usage)?;
                write_file(&named(path, name), &bytes, self.force)?;
            }
        }
        Ok(())
    }
}

/// The file of a picture beside the first one.
fn named(path: &Path, name: &str) -> PathBuf {
    if name.is_empty() {
        return path.to_owned();
    }
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let extension = path.extension().map(|extension| format!(".{}", extension.to_string_lossy())).unwrap_or_default();
    path.with_file_name(format!("{stem}-{name}{extension}"))
}
