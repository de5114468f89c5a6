//! The output of a result: text for people, JSON for programs, pictures, and a table.

use super::messages::{PictureMessage, undrawn};
use crate::failure::Failure;
use crate::print::{json_text, print_json, print_text, tell, write_file};
use homebody_log::run::places::can_be_written;
use homebody_picture::png;
use serde::Serialize;
use std::fmt::Display;
use std::path::{Path, PathBuf};

/// The output of a result with pictures.
#[derive(clap::Args)]
#[command(next_help_heading = "Output")]
pub struct ResultOutput {
    /// Print the result as JSON instead of text. With FILE, write the JSON there and print the text. Without FILE, put --json last
    #[arg(long, value_name = "FILE", num_args = 0..=1, default_missing_value = "-")]
    json: Option<PathBuf>,
    #[command(flatten)]
    pictures: PictureOutput,
}

/// The output of a result without pictures.
#[derive(clap::Args)]
#[command(next_help_heading = "Output")]
pub struct JsonOutput {
    /// Print the result as JSON instead of text. With FILE, write the JSON there and print the text. Without FILE, put --json last
    #[arg(long, value_name = "FILE", num_args = 0..=1, default_missing_value = "-")]
    json: Option<PathBuf>,
    /// Replace existing files
    #[arg(short, long)]
    force: bool,
}

impl JsonOutput {
    /// Fails if the file cannot be written or is one of the `sources`, before the work starts.
    pub fn check(&self, sources: &[PathBuf]) -> Result<CheckedOutput<'_, 0>, Failure> {
        let json = self.json.as_deref();
        can_be_written(&Vec::from_iter(file_of(json)), sources, self.force)?;
        Ok(CheckedOutput { json, replaces: self.force, pictures: None, table: None, is_silent: false })
    }

    pub fn is_empty(&self) -> bool {
        self.json.is_none()
    }

    pub fn replaces(&self) -> bool {
        self.force
    }
}

/// The file of the JSON, if it is not standard output.
fn file_of(json: Option<&Path>) -> Option<&Path> {
    json.filter(|path| path.as_os_str() != "-")
}

/// The files of pictures.
#[derive(clap::Args)]
#[command(next_help_heading = "Output")]
pub struct PictureOutput {
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

pub type Picture<'a> = &'a dyn Fn() -> String;

pub struct CheckedOutput<'a, const N: usize> {
    json: Option<&'a Path>,
    replaces: bool,
    /// With the ends of the file names; `None` for commands without pictures.
    pictures: Option<(&'a PictureOutput, [&'static str; N])>,
    table: Option<&'a Path>,
    is_silent: bool,
}

impl ResultOutput {
    /// Fails if a file cannot be written or is one of the `sources`, before the work starts. `names` are the ends of the pictures' file
    /// names; that of the first is empty.
    pub fn check<const N: usize>(
        &self,
        names: [&'static str; N],
        sources: &[PathBuf],
    ) -> Result<CheckedOutput<'_, N>, Failure> {
        self.check_with_table(names, None, sources)
    }

    /// The same with a table, if it has a file.
    pub fn check_with_table<'a, const N: usize>(
        &'a self,
        names: [&'static str; N],
        table: Option<&'a Path>,
        sources: &[PathBuf],
    ) -> Result<CheckedOutput<'a, N>, Failure> {
        let json = self.json.as_deref();
        let files: Vec<&Path> = file_of(json).into_iter().chain(table).collect();
        self.pictures.check(names, &files, sources)?;
        let pictures = Some((&self.pictures, names));
        Ok(CheckedOutput { json, replaces: self.replaces(), pictures, table, is_silent: false })
    }

    pub fn has_pictures(&self) -> bool {
        !self.pictures.is_empty()
    }

    pub fn replaces(&self) -> bool {
        self.pictures.force
    }
}

impl<const N: usize> CheckedOutput<'_, N> {
    /// Prints nothing if something else goes to standard output.
    pub fn silent_if(self, is_silent: bool) -> Self {
        CheckedOutput { is_silent, ..self }
    }

    /// Writes all files, then prints the result: as JSON if `--json` has no file, else as text. Writes no file unless all pictures can be
    /// drawn.
    pub fn write(&self, result: &(impl Serialize + Display), pictures: [Picture; N]) -> Result<(), Failure> {
        self.write_with_table(result, pictures, &String::new)
    }

    /// The same with a table, if it has a file.
    pub fn write_with_table(
        &self,
        result: &(impl Serialize + Display),
        pictures: [Picture; N],
        table: &dyn Fn() -> String,
    ) -> Result<(), Failure> {
        if let Some((output, names)) = &self.pictures {
            output.draw(*names, pictures)?;
        }
        if let Some(path) = self.table {
            write_file(path, table().as_bytes(), self.replaces)?;
        }
        match (self.json, file_of(self.json)) {
            (_, Some(path)) => write_file(path, json_text(result)?.as_bytes(), self.replaces)?,
            (Some(_), None) if !self.is_silent => return print_json(result),
            _ => {}
        }
        if self.is_silent { Ok(()) } else { print_text(&result.to_string()) }
    }
}

impl PictureOutput {
    pub fn is_empty(&self) -> bool {
        self.svg.is_none() && self.png.is_none()
    }

    /// Fails if a picture or one of the `others` cannot be written, or would replace one of the `sources`.
    pub fn check<const N: usize>(
        &self,
        names: [&str; N],
        others: &[&Path],
        sources: &[PathBuf],
    ) -> Result<(), Failure> {
        for (path, form) in [(&self.svg, "svg"), (&self.png, "png")] {
            path.as_ref().map_or(Ok(()), |path| check_extension(path, form))?;
        }
        let paths = self.svg.iter().chain(&self.png);
        let files: Vec<PathBuf> = paths.flat_map(|path| names.map(|name| picture_file(path, name))).collect();
        let all: Vec<&Path> = files.iter().map(PathBuf::as_path).chain(others.iter().copied()).collect();
        Ok(can_be_written(&all, sources, self.force)?)
    }

    pub fn draw<const N: usize>(&self, names: [&str; N], pictures: [Picture; N]) -> Result<(), Failure> {
        if self.is_empty() {
            return Ok(());
        }
        let mut files: Vec<(PathBuf, Vec<u8>)> = Vec::new();
        for (name, picture) in names.into_iter().zip(pictures) {
            let svg = picture();
            if let Some(path) = &self.png {
                let png = png(&svg, self.width).map_err(|error| undrawn(&error, "--width"))?;
                files.push((picture_file(path, name), png));
            }
            if let Some(path) = &self.svg {
                files.push((picture_file(path, name), svg.into_bytes()));
            }
        }
        for (path, bytes) in &files {
            write_file(path, bytes, self.force)?;
            tell(format_args!("wrote {}", path.display()));
        }
        Ok(())
    }
}

/// Refuses a file with the extension of another form of pictures.
fn check_extension(path: &Path, form: &'static str) -> Result<(), Failure> {
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    if extension == form || !["svg", "png", "jpg", "jpeg", "gif", "webp", "pdf", "bmp", "tiff"].contains(&&*extension) {
        return Ok(());
    }
    Err(Failure::asked(PictureMessage::Form { form, extension, path: path.to_owned() }))
}

fn picture_file(path: &Path, name: &str) -> PathBuf {
    if name.is_empty() {
        return path.to_owned();
    }
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let extension = path.extension().map(|extension| format!(".{}", extension.to_string_lossy())).unwrap_or_default();
    path.with_file_name(format!("{stem}-{name}{extension}"))
}
