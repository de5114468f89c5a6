//! `homebody coverage`: where in the home the sensors see.

use super::{print_json, print_text, write_file};
use crate::failure::Failure;
use crate::folder;
use homebody_core::geometry::Point;
use homebody_core::home::plan::Plan;
use homebody_core::home::{Build, Home};
use homebody_core::scenario::path::Posture;
use homebody_log::fresh::all_can_be_written;
use homebody_study::coverage::{Coverage, STEP_M, coverage};
use homebody_study::picture;
use std::path::{Path, PathBuf};

/// Says which share of the floor is seen by no, one, two, three or more sensors, where the dead zones are, and how
/// sensors overlap; from the very fields that a run senses with.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  homebody coverage scenarios/tigerplace
  homebody coverage my-home --png map.png --json coverage.json")]
pub struct Arguments {
    /// The scenario's folder, or its scenario.json
    scenario: PathBuf,
    /// Write all figures as one JSON object into this file, or on standard output without one
    #[arg(long, value_name = "FILE", num_args = 0..=1, default_missing_value = "-")]
    json: Option<PathBuf>,
    /// Draw the map as SVG
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// Draw the map as PNG
    #[arg(long, value_name = "FILE")]
    png: Option<PathBuf>,
    /// Width of the PNG in pixels
    #[arg(long, value_name = "PIXELS", default_value_t = 1600, value_parser = clap::value_parser!(u32).range(200..=8000))]
    width: u32,
    /// Replace files that exist
    #[arg(long)]
    force: bool,
}

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        let json = self.json.as_deref().filter(|path| path.as_os_str() != "-");
        let files: Vec<&Path> = [json, self.svg.as_deref(), self.png.as_deref()].into_iter().flatten().collect();
        all_can_be_written(&files, self.force)?;
        let (scenario, _) = folder::load(&self.scenario)?;
        // Without residents, an adult: the defaults of a resident's file.
        let adult = || Build { radius_m: 0.22, height_m: 1.65 };
        let build = scenario.residents.first().map_or_else(adult, |resident| Build::of(&resident.file));
        let home = Home::bake(&scenario.home, &[build]);
        let names: Vec<String> = home.sensors.iter().map(|sensor| sensor.name.clone()).collect();
        let field = home.field(0, Posture::Standing);
        let coverage = coverage(&Plan::new(&scenario.home), build.radius_m, &names, STEP_M, &|p| field.seen_at(p));
        if self.svg.is_some() || self.png.is_some() {
            let map = picture::coverage_map(&scenario.home, &coverage, &beams(&home));
            if let Some(path) = &self.svg {
                write_file(path, map.as_bytes(), self.force)?;
            }
            if let Some(path) = &self.png {
                write_file(path, &picture::png(&map, self.width).map_err(Failure::usage)?, self.force)?;
            }
        }
        self.tell(&coverage)
    }

    fn tell(&self, coverage: &Coverage) -> Result<(), Failure> {
        match &self.json {
            Some(path) if path.as_os_str() == "-" => return print_json(coverage),
            Some(path) => {
                let text = serde_json::to_string_pretty(coverage).map_err(Failure::usage)? + "\n";
                write_file(path, text.as_bytes(), self.force)?;
            }
            None => {}
        }
        print_text(&coverage.to_string())
    }
}

/// The wall sensors' beams on a standing body, to draw.
fn beams(home: &Home) -> Vec<(usize, Point, Point)> {
    let field = home.field(0, Posture::Standing);
    let walls = (0..home.sensors.len()).filter(|&sensor| home.sensors[sensor].is_on_wall());
    walls
        .flat_map(|sensor| field.beams[field.range(sensor)].iter().map(move |beam| (sensor, beam.start, beam.end())))
        .collect()
}
