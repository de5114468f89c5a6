//! Outputs of silhouettes: films, tables, and folders of pictures. Each gets its name once it is complete.

use super::messages::SilhouettesMessage;
use crate::commands::messages::undrawn;
use crate::failure::Failure;
use crate::print::not_written;
use homebody_analysis::falls::single;
use homebody_core::body::ground::Ground;
use homebody_core::camera::lens::Lens;
use homebody_core::camera::outlook::Outlook;
use homebody_core::camera::silhouette::Silhouette;
use homebody_core::problem::{Diagnostic, counted};
use homebody_core::sensors::camera::CameraFile;
use homebody_core::time::{RunTime, SECOND, Span};
use homebody_log::LogError;
use homebody_log::files::fresh::FreshFile;
use homebody_log::run::places::can_be_written;
use homebody_log::silhouettes::KeptSilhouettes;
use homebody_log::text::escaped;
use homebody_picture::{FilmFrame, silhouette_film, silhouette_png};
use homebody_query::RunSilhouettes;
use serde::Serialize;
use std::fs;
use std::path::{Path, PathBuf};

/// Most frames of a film (our choice): ten minutes of five a second.
const MOST_FRAMES: u64 = 3000;

/// Most pictures of a folder (our choice): systems become slow with more.
const MOST_PICTURES: u64 = 200_000;

/// Longest time of a frame in a film, whatever the time to the next one.
const LONGEST_FRAME: Span = SECOND;

#[derive(Clone, Copy, Debug, PartialEq)]
enum SilhouetteForm {
    Film,
    Csv,
    JsonLines,
    Folder,
}

pub struct SilhouetteOutput {
    form: SilhouetteForm,
    path: PathBuf,
}

impl SilhouetteOutput {
    /// Fails if an output cannot be written or is one of the `sources`.
    pub fn check_all(paths: &[PathBuf], sources: &[PathBuf], force: bool) -> Result<Vec<SilhouetteOutput>, Failure> {
        let (mut outputs, mut wrong) = (Vec::new(), Vec::<Diagnostic>::new());
        for path in paths {
            match form(path) {
                Ok(form) => outputs.push(SilhouetteOutput { form, path: path.clone() }),
                Err(message) => wrong.push(message.into()),
            }
        }
        if !wrong.is_empty() {
            return Err(Failure::all(wrong));
        }
        let is_file = |output: &&SilhouetteOutput| output.form != SilhouetteForm::Folder;
        let files: Vec<&Path> = outputs.iter().filter(is_file).map(|output| output.path.as_path()).collect();
        can_be_written(&files, sources, force)?;
        Ok(outputs)
    }
}

fn form(path: &Path) -> Result<SilhouetteForm, SilhouettesMessage> {
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    match extension.as_str() {
        "apng" => Ok(SilhouetteForm::Film),
        "csv" => Ok(SilhouetteForm::Csv),
        "jsonl" => Ok(SilhouetteForm::JsonLines),
        "png" | "svg" => Err(SilhouettesMessage::NotAFilm { path: path.to_owned(), extension }),
        "gif" | "mp4" | "webm" | "avi" | "mkv" | "mov" | "json" | "jpg" | "jpeg" | "webp" | "tsv" | "txt" => {
            Err(SilhouettesMessage::Form { path: path.to_owned(), extension })
        }
        _ => {
            let is_full = path.is_file() || path.read_dir().is_ok_and(|mut entries| entries.next().is_some());
            if is_full {
                Err(SilhouettesMessage::NotEmpty { path: path.to_owned() })
            } else {
                Ok(SilhouetteForm::Folder)
            }
        }
    }
}

#[derive(Clone, Copy)]
pub struct SilhouetteCount {
    pub pictures: u64,
    pub instants: u64,
}

#[derive(Serialize)]
pub struct WrittenOutput {
    pub path: String,
    pub what: String,
}

pub struct SilhouetteOutputs<'a> {
    open: Vec<(PathBuf, OpenOutput)>,
    kept: &'a RunSilhouettes<'a>,
    /// The places of seats and beds.
    ground: Ground,
    cameras: Vec<(&'a CameraFile, Lens)>,
    scale: u32,
    force: bool,
}

/// An instant, and the packed silhouette of each camera.
type Instant = (RunTime, Vec<Option<Vec<u8>>>);

enum OpenOutput {
    Film(Vec<Instant>),
    Table(SilhouetteForm, FreshFile, u64),
    /// The temporary folder, and the number of pictures.
    Folder(PathBuf, u64),
}

impl<'a> SilhouetteOutputs<'a> {
    /// Starts all outputs. Refuses outputs that are too large before any output starts.
    pub fn begin(
        outputs: Vec<SilhouetteOutput>,
        kept: &'a RunSilhouettes,
        cameras: &[usize],
        all: SilhouetteCount,
        scale: u32,
        force: bool,
    ) -> Result<SilhouetteOutputs<'a>, Failure> {
        for SilhouetteOutput { form, path } in &outputs {
            let (count, most, what) = match form {
                SilhouetteForm::Film => (all.instants, MOST_FRAMES, "frames"),
                SilhouetteForm::Folder => (all.pictures, MOST_PICTURES, "pictures"),
                SilhouetteForm::Csv | SilhouetteForm::JsonLines => continue,
            };
            if count > most {
                return Err(Failure::asked(SilhouettesMessage::TooMany { path: path.clone(), count, what, most }));
            }
        }
        let camera = |&camera: &usize| {
            let file = &kept.silhouettes.cameras[camera].file;
            (file, file.lens())
        };
        let ground = Outlook::new(kept.scenario.home.plan()).ground;
        let cameras = cameras.iter().map(camera).collect();
        let mut begun = SilhouetteOutputs { open: Vec::new(), kept, ground, cameras, scale, force };
        for SilhouetteOutput { form, path } in outputs {
            let open = match form {
                SilhouetteForm::Film => OpenOutput::Film(Vec::new()),
                SilhouetteForm::Csv | SilhouetteForm::JsonLines => {
                    OpenOutput::Table(form, FreshFile::create(&path, force)?, 0)
                }
                SilhouetteForm::Folder => {
                    let part = part_of(&path);
                    begun.cameras.iter().enumerate().try_for_each(|(number, _)| {
                        let folder = part.join(begun.folder_of(number));
                        fs::create_dir_all(&folder).map_err(|error| LogError::file(&folder, error))
                    })?;
                    OpenOutput::Folder(part, 0)
                }
            };
            begun.open.push((path, open));
        }
        Ok(begun)
    }

    pub fn is_empty(&self) -> bool {
        self.open.is_empty()
    }

    /// The folder of a camera's pictures: its name in characters that all systems accept, with a number if it is not unique.
    fn folder_of(&self, camera: usize) -> String {
        let plain = |camera: usize| {
            let name = self.cameras[camera].0.name.chars().take(80);
            let name: String = name.map(|c| if c.is_alphanumeric() { c } else { '-' }).collect();
            name.split('-').filter(|part| !part.is_empty()).collect::<Vec<_>>().join("-")
        };
        let name = plain(camera);
        let is_taken = (0..self.cameras.len()).any(|other| other != camera && plain(other) == name);
        if is_taken || name.is_empty() { format!("{name}-{}", camera + 1) } else { name }
    }

    pub fn take(&mut self, camera: usize, kept: &KeptSilhouettes) -> Result<(), Failure> {
        let folder = self.folder_of(camera);
        let local = self.kept.scenario.calendar.local(kept.at);
        for (_, open) in &mut self.open {
            match open {
                OpenOutput::Film(frames) => {
                    if frames.last().is_none_or(|(at, _)| *at != kept.at) {
                        frames.push((kept.at, vec![None; self.cameras.len()]));
                    }
                    let seen = frames.last_mut().and_then(|(_, seen)| seen.get_mut(camera));
                    seen.into_iter().for_each(|seen| *seen = Some(kept.silhouette.packed()));
                }
                OpenOutput::Table(form, file, rows) => {
                    let at = local.strftime("%Y-%m-%dT%H:%M:%S%.3f%:z").to_string();
                    let (CameraFile { name, .. }, lens) = &self.cameras[camera];
                    let name = if *form == SilhouetteForm::Csv { escaped(name) } else { name.into() };
                    file.write(&row(*form, &SilhouetteRow::new(at, &name, (lens, &self.ground), kept), *rows == 0)?)?;
                    *rows += 1;
                }
                OpenOutput::Folder(part, pictures) => {
                    let name = local.strftime("%Y-%m-%dT%H-%M-%S%.3f%z.png").to_string();
                    let path = part.join(&folder).join(name);
                    let png =
                        silhouette_png(&kept.silhouette, self.scale).map_err(|error| undrawn(&error, "--scale"))?;
                    fs::write(&path, png).map_err(|error| LogError::file(&path, error))?;
                    *pictures += 1;
                }
            }
        }
        Ok(())
    }

    pub fn finish(mut self) -> Result<Vec<WrittenOutput>, Failure> {
        let mut written = Vec::new();
        while !self.open.is_empty() {
            let (path, open) = self.open.remove(0);
            let what = match open {
                OpenOutput::Film(frames) => {
                    FreshFile::write_whole(&path, &self.film(&frames)?, self.force)?;
                    format!("a film of {}", counted(frames.len(), "frame", "frames"))
                }
                OpenOutput::Table(form, file, rows) => {
                    file.finish()?;
                    match form {
                        SilhouetteForm::Csv => counted(rows as usize, "row", "rows"),
                        _ => counted(rows as usize, "object", "objects"),
                    }
                }
                OpenOutput::Folder(part, pictures) => {
                    if path.is_dir() {
                        fs::remove_dir(&path).map_err(|error| LogError::file(&path, error))?;
                    }
                    fs::rename(&part, &path).map_err(|error| LogError::file(&path, error))?;
                    counted(pictures as usize, "picture", "pictures")
                }
            };
            written.push(WrittenOutput { path: path.display().to_string(), what });
        }
        Ok(written)
    }

    fn film(&self, frames: &[Instant]) -> Result<Vec<u8>, Failure> {
        let sizes: Vec<[u32; 2]> = self.cameras.iter().map(|(file, _)| file.pixels).collect();
        let shortest = self.cameras.iter().map(|(file, _)| file.period()).min().unwrap_or(SECOND);
        let frame = |(index, (at, seen)): (usize, &Instant)| {
            let lasts = frames.get(index + 1).map_or(shortest, |(next, _)| *next - *at).min(LONGEST_FRAME);
            let unpacked = |(packed, [columns, rows]): (&Option<Vec<u8>>, &[u32; 2])| {
                Silhouette::unpacked(packed.as_ref()?, *columns, *rows)
            };
            FilmFrame {
                silhouettes: seen.iter().zip(&sizes).map(unpacked).collect(),
                lasts_ms: u16::try_from(lasts / Span::from_millis(1)).unwrap_or(u16::MAX),
            }
        };
        let frames: Vec<FilmFrame> = frames.iter().enumerate().map(frame).collect();
        silhouette_film(&sizes, &frames, self.scale).map_err(|error| undrawn(&error, "--scale"))
    }
}

impl Drop for SilhouetteOutputs<'_> {
    fn drop(&mut self) {
        for (_, open) in &self.open {
            if let OpenOutput::Folder(part, _) = open {
                let _ = fs::remove_dir_all(part);
            }
        }
    }
}

/// The name of a folder until it is complete.
fn part_of(path: &Path) -> PathBuf {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!("{name}.{}.part", std::process::id()))
}

#[derive(Serialize)]
struct SilhouetteRow<'a> {
    at: String,
    camera: &'a str,
    area_px: u32,
    left_px: u32,
    top_px: u32,
    right_px: u32,
    bottom_px: u32,
    width_px: u32,
    height_px: u32,
    centroid_x_px: f64,
    centroid_y_px: f64,
    orientation_deg: f64,
    elongation: f64,
    /// By this camera alone; `None` beyond the horizon.
    x_m: Option<f64>,
    y_m: Option<f64>,
    height_m: Option<f64>,
}

impl<'a> SilhouetteRow<'a> {
    fn new(at: String, camera: &'a str, (lens, ground): (&Lens, &Ground), kept: &KeptSilhouettes) -> SilhouetteRow<'a> {
        let rounded = |number: f64| (number * 1000.0).round() / 1000.0;
        let features = &kept.features;
        let [left_px, top_px, right_px, bottom_px] = features.box_px;
        let shape = single::shape(lens, &kept.silhouette, ground);
        SilhouetteRow {
            at,
            camera,
            area_px: features.area_px,
            left_px,
            top_px,
            right_px,
            bottom_px,
            width_px: right_px.saturating_sub(left_px) + 1,
            height_px: bottom_px.saturating_sub(top_px) + 1,
            centroid_x_px: rounded(features.centroid_px[0]),
            centroid_y_px: rounded(features.centroid_px[1]),
            orientation_deg: rounded(features.orientation_deg),
            elongation: rounded(features.elongation),
            x_m: shape.map(|shape| rounded(shape.at_m[0])),
            y_m: shape.map(|shape| rounded(shape.at_m[1])),
            height_m: shape.map(|shape| rounded(shape.height_m)),
        }
    }
}

/// A row of a table; the first row of a CSV file follows the names of the columns.
fn row(form: SilhouetteForm, row: &SilhouetteRow, is_first: bool) -> Result<Vec<u8>, Failure> {
    if form == SilhouetteForm::JsonLines {
        let mut bytes = serde_json::to_vec(row).map_err(not_written)?;
        bytes.push(b'\n');
        return Ok(bytes);
    }
    let mut writer = csv::WriterBuilder::new().has_headers(is_first).from_writer(Vec::new());
    writer.serialize(row).map_err(not_written)?;
    writer.into_inner().map_err(not_written)
}
