//! `homebody experiment`: what was measured in the real world, done again.

mod godsey2009;
mod sphere;

use super::{print_json, print_text, write_file};
use crate::failure::Failure;
use homebody_study::picture::png;
use std::path::PathBuf;

/// Sharp on a screen, and in print at half a page.
const PNG_WIDTH_PX: u32 = 2400;

/// Does an experiment again that was done in the real world, and says what agrees.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  homebody experiment godsey2009 --svg firings.svg
  homebody experiment sphere --data sphere_challenge --svg rooms.svg")]
pub struct Arguments {
    #[command(subcommand)]
    experiment: Experiment,
}

#[derive(clap::Subcommand)]
enum Experiment {
    /// One sensor, one person, three paces, two distances: the paper's own experiment
    Godsey2009(godsey2009::Arguments),
    /// A real house whose sensors and whose resident's room were recorded, beside the same walks simulated
    Sphere(sphere::Arguments),
}

#[derive(clap::Args)]
struct Output {
    /// Write all figures as JSON into this file; - is standard output
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Draw the figure as SVG
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// Draw the figure as PNG
    #[arg(long, value_name = "FILE")]
    png: Option<PathBuf>,
    /// Replace files that exist
    #[arg(long)]
    force: bool,
}

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        match self.experiment {
            Experiment::Godsey2009(arguments) => arguments.run(),
            Experiment::Sphere(arguments) => arguments.run(),
        }
    }
}

impl Output {
    /// Draws a figure where one is asked for; a second figure stands beside the first, its name added to the file's.
    fn draw(&self, second: Option<&str>, svg: impl FnOnce() -> String) -> Result<(), Failure> {
        if self.svg.is_none() && self.png.is_none() {
            return Ok(());
        }
        let svg = svg();
        let name = |path: &PathBuf| match second {
            Some(second) => {
                let (stem, extension) = (path.file_stem().unwrap_or_default(), path.extension().unwrap_or_default());
                let stem = path.with_file_name(format!("{}-{second}", stem.display()));
                stem.with_extension(extension)
            }
            None => path.clone(),
        };
        if let Some(path) = &self.svg {
            write_file(&name(path), svg.as_bytes(), self.force)?;
        }
        if let Some(path) = &self.png {
            write_file(&name(path), &png(&svg, PNG_WIDTH_PX).map_err(Failure::usage)?, self.force)?;
        }
        Ok(())
    }

    /// The figures as JSON where that is asked for, else for people.
    fn tell<E: serde::Serialize + std::fmt::Display>(&self, experiment: &E) -> Result<(), Failure> {
        match &self.json {
            Some(path) if path.as_os_str() == "-" => return print_json(experiment),
            Some(path) => {
                let text = serde_json::to_string_pretty(experiment).map_err(Failure::usage)? + "\n";
                write_file(path, text.as_bytes(), self.force)?;
            }
            None => {}
        }
        print_text(&experiment.to_string())
    }
}
