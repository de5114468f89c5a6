//! What commands that answer a question leave: words for people, figures as JSON, pictures.

use super::messages::{PictureMessage, undrawn};
use crate::failure::Failure;
use crate::print::{json_text, print_json, print_text, tell, write_file};
use homebody_log::run::places::can_be_written;
use homebody_picture::png;
use serde::Serialize;
use std::fmt::Display;
use std::path::{Path, PathBuf};

/// Where an answer goes, besides standard output.
#[derive(clap::Args)]
#[command(next_help_heading = "Output")]
pub struct Answer {
    /// Print the result as JSON instead of text. With FILE, write the JSON there and print the text. Without FILE, put --json last
    #[arg(long, value_name = "FILE", num_args = 0..=1, default_missing_value = "-")]
    json: Option<PathBuf>,
    #[command(flatten)]
    pictures: Pictures,
}

/// Where an answer goes of which there is no picture, besides standard output.
#[derive(clap::Args)]
#[command(next_help_heading = "Output")]
pub struct Figures {
    /// Print the result as JSON instead of text. With FILE, write the JSON there and print the text. Without FILE, put --json last
    #[arg(long, value_name = "FILE", num_args = 0..=1, default_missing_value = "-")]
    json: Option<PathBuf>,
    /// Replace existing files
    #[arg(short, long)]
    force: bool,
}

impl Figures {
    /// Makes sure that the file can be written, before anybody waits for the answer, over none of the `sources`.
    pub fn check(&self, sources: &[PathBuf]) -> Result<Checked<'_, 0>, Failure> {
        let json = self.json.as_deref();
        can_be_written(&Vec::from_iter(file_of(json)), sources, self.force)?;
        Ok(Checked { json, replaces: self.force, pictures: None, table: None })
    }

    /// Whether nothing is asked for besides words.
    pub fn is_empty(&self) -> bool {
        self.json.is_none()
    }

    /// Whether files that exist are replaced.
    pub fn replaces(&self) -> bool {
        self.force
    }
}

/// Where figures go that are not printed.
fn file_of(json: Option<&Path>) -> Option<&Path> {
    json.filter(|path| path.as_os_str() != "-")
}

/// Where pictures go.
#[derive(clap::Args)]
#[command(next_help_heading = "Output")]
pub struct Pictures {
    /// Write the picture as SVG
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// Write the picture as PNG
    #[arg(long, value_name = "FILE")]
    png: Option<PathBuf>,
    /// Width of the PNG in pixels
    #[arg(long, value_name = "PIXELS", default_value_t = 1600, value_parser = clap::value_parser!(u32).range(200..=8000))]
    width: u32,
    /// Replace existing files
    #[arg(short, long)]
    force: bool,
}

/// Draws a picture as SVG.
pub type Picture<'a> = &'a dyn Fn() -> String;

/// An answer whose files can be written.
pub struct Checked<'a, const N: usize> {
    json: Option<&'a Path>,
    replaces: bool,
    /// None where no picture can be asked for.
    pictures: Option<CheckedPictures<'a, N>>,
    table: Option<&'a Path>,
}

/// Pictures whose files can be written.
pub struct CheckedPictures<'a, const N: usize> {
    pictures: &'a Pictures,
    names: [&'static str; N],
}

impl Answer {
    /// Makes sure that all files can be written, before anybody waits for the answer. Pictures are named by what their
    /// files' names end in: nothing for the first. `sources` are what the command reads, which nothing replaces.
    pub fn check<const N: usize>(
        &self,
        names: [&'static str; N],
        sources: &[PathBuf],
    ) -> Result<Checked<'_, N>, Failure> {
        self.check_beside(names, None, sources)
    }

    /// The same with a table beside them, if its file is named.
    pub fn check_beside<'a, const N: usize>(
        &'a self,
        names: [&'static str; N],
        table: Option<&'a Path>,
        sources: &[PathBuf],
    ) -> Result<Checked<'a, N>, Failure> {
        let json = self.json.as_deref();
        let files: Vec<&Path> = file_of(json).into_iter().chain(table).collect();
        let pictures = self.pictures.check_beside(names, &files, sources)?;
        Ok(Checked { json, replaces: self.replaces(), pictures: Some(pictures), table })
    }

    /// Whether a picture is asked for.
    pub fn draws(&self) -> bool {
        !self.pictures.is_empty()
    }

    /// Whether files that exist are replaced.
    pub fn replaces(&self) -> bool {
        self.pictures.force
    }
}

impl<const N: usize> Checked<'_, N> {
    /// Writes the pictures and figures that are asked for into files, then tells the answer: to scripts where figures are
    /// asked for but no file of them is, else to people. No file is written unless all pictures can be drawn.
    pub fn give(&self, answer: &(impl Serialize + Display), pictures: [Picture; N]) -> Result<(), Failure> {
        self.give_beside(answer, pictures, &String::new)
    }

    /// The same with the table, where it is asked for.
    pub fn give_beside(
        &self,
        answer: &(impl Serialize + Display),
        pictures: [Picture; N],
        table: &dyn Fn() -> String,
    ) -> Result<(), Failure> {
        self.give_to_files(answer, pictures, table)?;
        match self.json.is_some() && file_of(self.json).is_none() {
            true => print_json(answer),
            false => print_text(&answer.to_string()),
        }
    }

    /// Writes what goes into files, and tells nothing: standard output is taken.
    pub fn give_to_files(
        &self,
        answer: &impl Serialize,
        pictures: [Picture; N],
        table: &dyn Fn() -> String,
    ) -> Result<(), Failure> {
        if let Some(checked) = &self.pictures {
            checked.draw(pictures)?;
        }
        if let Some(path) = self.table {
            write_file(path, table().as_bytes(), self.replaces)?;
        }
        file_of(self.json).map_or(Ok(()), |path| write_file(path, json_text(answer)?.as_bytes(), self.replaces))
    }
}

impl Pictures {
    /// Whether no picture is asked for.
    pub fn is_empty(&self) -> bool {
        self.svg.is_none() && self.png.is_none()
    }

    /// Makes sure that all pictures can be written, over none of the `sources`.
    pub fn check<const N: usize>(
        &self,
        names: [&'static str; N],
        sources: &[PathBuf],
    ) -> Result<CheckedPictures<'_, N>, Failure> {
        self.check_beside(names, &[], sources)
    }

    fn check_beside<const N: usize>(
        &self,
        names: [&'static str; N],
        others: &[&Path],
        sources: &[PathBuf],
    ) -> Result<CheckedPictures<'_, N>, Failure> {
        for (path, form) in [(&self.svg, "svg"), (&self.png, "png")] {
            path.as_ref().map_or(Ok(()), |path| is_named_as(path, form))?;
        }
        let paths = self.svg.iter().chain(&self.png);
        let files: Vec<PathBuf> = paths.flat_map(|path| names.map(|name| named(path, name))).collect();
        let all: Vec<&Path> = files.iter().map(PathBuf::as_path).chain(others.iter().copied()).collect();
        can_be_written(&all, sources, self.force)?;
        Ok(CheckedPictures { pictures: self, names })
    }
}

impl<const N: usize> CheckedPictures<'_, N> {
    /// Draws what is asked for: all of it, then writes it.
    pub fn draw(&self, pictures: [Picture; N]) -> Result<(), Failure> {
        let asked = self.pictures;
        if asked.is_empty() {
            return Ok(());
        }
        let mut files: Vec<(PathBuf, Vec<u8>)> = Vec::new();
        for (name, picture) in self.names.iter().zip(pictures) {
            let svg = picture();
            if let Some(path) = &asked.png {
                files.push((named(path, name), png(&svg, asked.width).map_err(|error| undrawn(&error, "--width"))?));
            }
            if let Some(path) = &asked.svg {
                files.push((named(path, name), svg.into_bytes()));
            }
        }
        for (path, bytes) in &files {
            write_file(path, bytes, asked.force)?;
            tell(format_args!("wrote {}", path.display()));
        }
        Ok(())
    }
}

/// Refuses a file whose extension is that of another form of pictures.
fn is_named_as(path: &Path, form: &'static str) -> Result<(), Failure> {
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    if extension == form || !["svg", "png", "jpg", "jpeg", "gif", "webp", "pdf", "bmp", "tiff"].contains(&&*extension) {
        return Ok(());
    }
    Err(Failure::asked(PictureMessage::Form { form, extension, path: path.to_owned() }))
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
