//! The fonts that pictures are drawn and measured with.

use std::sync::{Arc, LazyLock};

use resvg::usvg::{self, fontdb};

use super::svg::{Svg, Type};

static FONTS: LazyLock<Arc<fontdb::Database>> = LazyLock::new(|| {
    let mut fonts = fontdb::Database::new();
    // The first is the text's; the second stands in for characters that the first lacks.
    for font in [epaint_default_fonts::UBUNTU_LIGHT, epaint_default_fonts::HACK_REGULAR] {
        fonts.load_font_source(fontdb::Source::Binary(Arc::new(font)));
    }
    let family = fonts.faces().next().and_then(|face| face.families.first()).map(|(name, _)| name.clone());
    if let Some(family) = family {
        fonts.set_sans_serif_family(&family);
        // Without a known font, the reader of SVG falls back on the serif.
        fonts.set_serif_family(family);
    }
    Arc::new(fonts)
});

/// Options for reading an SVG with our fonts only.
pub fn options() -> usvg::Options<'static> {
    let sans_serif = FONTS.family_name(&fontdb::Family::SansSerif).to_owned();
    usvg::Options { fontdb: FONTS.clone(), font_family: sans_serif, ..usvg::Options::default() }
}

/// Calls `take` with a font's file and the number of the font in it, if there is such a font.
pub fn with_data(id: fontdb::ID, take: impl FnOnce(&[u8], u32)) {
    FONTS.with_face_data(id, |bytes, index| take(bytes, index));
}

/// The width of a line of text at a font size, in the same unit.
pub fn width(text: &str, size: f64) -> f64 {
    let mut svg = Svg::new("", "");
    // Measured large, where hinting and rounding do not count.
    svg.text(text, homebody_core::geometry::Point::ZERO, &Type::new(100.0, "#000"));
    let tree = usvg::Tree::from_str(&svg.finish(1.0, 1.0), &options());
    let texts = tree.map(|tree| {
        let root = tree.root().children();
        let texts = root.iter().filter(|node| matches!(node, usvg::Node::Text(_)));
        texts.map(|text| f64::from(text.abs_bounding_box().width())).fold(0.0, f64::max)
    });
    texts.unwrap_or(0.0) * size / 100.0
}

/// The words, or their beginning and end as far as `room` is wide: names of things in one home often differ in their ends only.
pub fn shortened(words: &str, size: f64, room: f64) -> String {
    if width(words, size) <= room {
        return words.to_owned();
    }
    let letters: Vec<char> = words.chars().collect();
    let with = |kept: usize| {
        let (head, tail) = (&letters[..kept.div_ceil(2)], &letters[letters.len() - kept / 2..]);
        let (head, tail): (String, String) = (head.iter().collect(), tail.iter().collect());
        format!("{}…{}", head.trim_end(), tail.trim_start())
    };
    // Found by halving: to measure words takes long, and more of them are never narrower.
    let (mut fits, mut too_many) = (2, letters.len());
    while fits + 1 < too_many {
        let middle = fits.midpoint(too_many);
        if width(&with(middle), size) <= room {
            fits = middle;
        } else {
            too_many = middle;
        }
    }
    if letters.len() > 2 { with(fits) } else { words.to_owned() }
}
