//! Reasons why pictures do not become a PDF, and the packing of its streams.

use resvg::usvg;

homebody_core::messages! {
    /// Reasons why pictures do not become a PDF.
    pub enum PdfError in "pdf" {
        /// Homebody draws pages as SVG, and makes PDF from them. A program that uses the library can pass SVG of its own, which must be
        /// valid.
        Svg(why: String) error "invalid-svg" ("cannot draw this SVG: {why}");
        /// Pages of a PDF have paths, patterns and letters. The SVG has something else.
        Unknown(what: &'static str) error "not-supported" ("Homebody does not write {what} into a PDF");
        /// A PDF contains the letters of its fonts. They could not be taken out of the font.
        Font(why: String) error "font" ("cannot put a font into the PDF: {why}");
    }
}

impl From<usvg::Error> for PdfError {
    fn from(error: usvg::Error) -> PdfError {
        PdfError::Svg(error.to_string())
    }
}

/// Bytes as a stream that is inflated has them.
pub fn packed(bytes: &[u8]) -> Vec<u8> {
    /// The default of zlib.
    const LEVEL: u8 = 6;
    miniz_oxide::deflate::compress_to_vec_zlib(bytes, LEVEL)
}
