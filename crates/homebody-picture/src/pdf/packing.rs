//! How the streams of a PDF are packed, and why there is none.

use resvg::usvg;

/// Why there is no PDF.
#[derive(Debug, thiserror::Error)]
pub enum PdfError {
    /// A text is no SVG, or one that the reader does not take.
    #[error("this is no SVG that can be drawn: {0}")]
    Svg(#[from] usvg::Error),
    /// A picture has something that pages do not know.
    #[error("a page cannot have {0}")]
    Unknown(&'static str),
    /// A font cannot be made smaller; the text says why.
    #[error("a font cannot be put into the file: {0}")]
    Font(String),
}

/// Bytes as a stream that is inflated has them.
pub fn packed(bytes: &[u8]) -> Vec<u8> {
    /// As zlib has it where nothing else is said.
    const LEVEL: u8 = 6;
    miniz_oxide::deflate::compress_to_vec_zlib(bytes, LEVEL)
}
