//! Pictures: floor plans, coverage and firings, as SVG text and, from the same text, as PNG bytes and pages of a PDF.
//!
//! A picture is right without its colours: whatever a colour says, a shape, a hatch, a number or a
//! step of lightness says too. Colours are those of Okabe & Ito and of viridis, which colour-blind
//! people tell apart.
//!
//! A picture is the same bytes for the same input, and knows no file and no machine: it is drawn
//! with the fonts in this program. A character they lack is left blank in a PNG; SVG takes the reader's.

mod chart;
mod coverage_map;
mod day_chart;
mod density_map;
mod film_strip;
mod floor_plan;
mod font;
mod install_sheet;
mod label;
mod layers;
mod legend;
mod look_map;
mod measures_picture;
mod page;
mod paint;
mod pdf;
mod shade;
mod sheet;
mod silhouettes;
mod svg;

use resvg::{tiny_skia, usvg};

pub use chart::{
    FiringLane, HourShares, Lane, Panel, RangeFigure, Reference, TotalsLine, firing_chart, hour_chart, range_chart,
    span_chart, totals_chart,
};
pub use coverage_map::coverage_map;
pub use day_chart::{BandContent, DayBand, DayChart, Ticks, day_chart};
pub use density_map::density_map;
pub use film_strip::film_strip;
pub use floor_plan::floor_plan;
pub use install_sheet::installing;
pub use look_map::{look_map, look_page};
pub use measures_picture::measures_picture;
pub use page::{realism_chart, realism_page};
pub use pdf::{PdfError, pdf};
pub use silhouettes::{FilmFrame, SilhouetteStrip, StripMoment, silhouette_film, silhouette_png, silhouette_strip};

homebody_core::messages! {
    /// Reasons why a picture does not become a PNG.
    pub enum PngError in "picture" {
        /// Homebody draws pictures as SVG, and makes PNG from them. A program that uses the library can pass SVG of its own, which must be
        /// valid.
        Svg(why: String) error "invalid-svg" ("cannot draw this SVG: {why}");
        /// The limit of a picture protects the memory. The height of a picture follows from its width.
        Size { width: u32, height: u32 } error "size" ("cannot draw {width} x {height} pixels: each side must have 1 to {MOST_PIXELS} pixels");
        /// The encoder of PNG did not accept the pixels.
        Encoding(why: String) error "encoding" ("cannot write the picture as PNG: {why}");
    }
}

impl From<usvg::Error> for PngError {
    fn from(error: usvg::Error) -> PngError {
        PngError::Svg(error.to_string())
    }
}

/// The messages of this crate, for lists of all messages.
pub mod catalogue {
    use crate::{PdfError, PngError};
    use homebody_core::messages::{Catalogue, CatalogueEntry};

    pub const MESSAGES: &[&[CatalogueEntry]] = &[PngError::ENTRIES, PdfError::ENTRIES];
}

/// Largest number of pixels on a side of a picture (our choice): more would take too much memory.
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
