//! Pictures: floor plans, coverage and firings, as SVG text and, from the same text, as PNG bytes and pages of a PDF.
//!
//! A picture is right without its colours: whatever a colour says, a shape, a hatch, a number or a
//! step of lightness says too. Colours are those of Okabe & Ito and of viridis, which colour-blind
//! people tell apart.
//!
//! A picture is the same bytes for the same input, and knows no file and no machine: it is drawn
//! with the fonts in this program. A character they lack is left blank in a PNG; SVG takes the reader's.

#![warn(missing_docs)]

mod chart;
mod coverage_map;
mod day_chart;
mod density_map;
mod film_strip;
mod floor_plan;
mod font;
mod installing;
mod label;
mod layers;
mod legend;
mod look_map;
mod measures_picture;
mod page;
mod paint;
mod pdf;
mod realism_page;
mod shade;
mod sheet;
mod silhouettes;
mod svg;

use resvg::{tiny_skia, usvg};

pub use chart::{
    Activity, Hours, Lane, Measured, Panel, Reference, TotalsLine, firing_chart, hour_chart, range_chart, span_chart,
    totals_chart,
};
pub use coverage_map::coverage_map;
pub use day_chart::{Band, DayChart, Holds, Ticks, day_chart};
pub use density_map::density_map;
pub use film_strip::film_strip;
pub use floor_plan::floor_plan;
pub use installing::installing;
pub use look_map::{look_map, look_page};
pub use measures_picture::measures_picture;
pub use pdf::{PdfError, pdf};
pub use realism_page::{realism_chart, realism_page};
pub use silhouettes::{FilmFrame, SilhouetteStrip, StripMoment, silhouette_film, silhouette_png, silhouette_strip};

/// Why an SVG did not become a PNG.
#[derive(Debug, thiserror::Error)]
pub enum PngError {
    /// The text is no SVG, or one that the renderer does not take.
    #[error("this is no SVG that can be drawn: {0}")]
    Svg(#[from] usvg::Error),
    /// The picture would be empty, or longer on one side than is drawn.
    #[error("a picture of {width} x {height} pixels cannot be drawn")]
    Size {
        /// Pixels from left to right.
        width: u32,
        /// Pixels from top to bottom.
        height: u32,
    },
    /// The encoder refused the pixels; the text says why.
    #[error("the picture could not be written as PNG: {0}")]
    Encoding(String),
}

/// Pixels on the longer side above which a picture is refused, to protect the memory.
const MOST_PIXELS: u32 = 16_384;

/// Draws an SVG as a PNG of this width; the height follows.
pub fn png(svg: &str, width_px: u32) -> Result<Vec<u8>, PngError> {
    let tree = usvg::Tree::from_str(svg, &font::options())?;
    let scale = width_px as f32 / tree.size().width();
    let (width, height) = (width_px, (tree.size().height() * scale).round() as u32);
    let refused = PngError::Size { width, height };
    if width.max(height) > MOST_PIXELS {
        return Err(refused);
    }
    let mut pixels = tiny_skia::Pixmap::new(width, height).ok_or(refused)?;
    resvg::render(&tree, tiny_skia::Transform::from_scale(scale, scale), &mut pixels.as_mut());
    pixels.encode_png().map_err(|error| PngError::Encoding(error.to_string()))
}
