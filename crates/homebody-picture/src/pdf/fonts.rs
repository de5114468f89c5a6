//! The fonts of a PDF: of each only the letters that are on its pages, with what they mean.

use super::error::{PdfError, packed};
use crate::font;
use pdf_writer::types::{CidFontType, FontFlags, SystemInfo, UnicodeCmap};
use pdf_writer::{Filter, Finish, Name, Pdf, Rect, Ref, Str};
use resvg::usvg::fontdb;
use skrifa::instance::{LocationRef, Size};
use skrifa::{FontRef, GlyphId, MetadataProvider};
use std::collections::BTreeMap;
use subsetter::GlyphRemapper;

#[derive(Default)]
pub struct Fonts(Vec<Font>);

struct Font {
    id: fontdb::ID,
    /// From the numbers of letters in the font to those in the file.
    numbers: GlyphRemapper,
    /// The text of each glyph, by its number.
    means: BTreeMap<u16, String>,
}

/// Glyphs are numbered by two bytes.
const SYSTEM: SystemInfo<'static> = SystemInfo { registry: Str(b"Adobe"), ordering: Str(b"Identity"), supplement: 0 };

impl Fonts {
    /// The numbers of a font and of a glyph in the file.
    pub fn glyph(&mut self, id: fontdb::ID, glyph: u16, text: &str) -> (usize, u16) {
        let known = self.0.iter().position(|font| font.id == id);
        let number = known.unwrap_or_else(|| {
            self.0.push(Font { id, numbers: GlyphRemapper::new(), means: BTreeMap::new() });
            self.0.len() - 1
        });
        let font = &mut self.0[number];
        let glyph = font.numbers.remap(glyph);
        font.means.entry(glyph).or_insert_with(|| text.to_owned());
        (number, glyph)
    }

    /// Writes them into the file, whose next free number is `next`; their references in order.
    pub fn write(self, pdf: &mut Pdf, next: &mut i32) -> Result<Vec<Ref>, PdfError> {
        let mut fresh = || {
            *next += 1;
            Ref::new(*next - 1)
        };
        self.0
            .into_iter()
            .enumerate()
            .map(|(number, font)| font.write(number, pdf, [(); 5].map(|()| fresh())))
            .collect()
    }
}

impl Font {
    fn write(self, number: usize, pdf: &mut Pdf, ids: [Ref; 5]) -> Result<Ref, PdfError> {
        let [font, cid, descriptor, file, unicode] = ids;
        let mut told = Err(PdfError::Font("the font is missing".into()));
        font::with_data(self.id, |bytes, index| told = FontMetrics::from_data(bytes, index, &self.numbers));
        let told = told?;
        // Six letters in front say that it is a part of the font.
        let letter = char::from(b'A' + (number % 26) as u8);
        let name = format!("HOMEB{letter}+Letters{number}");
        let name = Name(name.as_bytes());
        let mut whole = pdf.type0_font(font);
        whole.base_font(name).encoding_predefined(Name(b"Identity-H")).descendant_font(cid).to_unicode(unicode);
        whole.finish();
        let mut letters = pdf.cid_font(cid);
        letters.subtype(CidFontType::Type2).base_font(name).system_info(SYSTEM).font_descriptor(descriptor);
        letters.default_width(0.0).cid_to_gid_map_predefined(Name(b"Identity"));
        letters.widths().consecutive(0, told.widths.iter().copied());
        letters.finish();
        let mut describes = pdf.font_descriptor(descriptor);
        describes.name(name).flags(FontFlags::SYMBOLIC).bbox(told.bounds).italic_angle(0.0);
        describes.ascent(told.ascent).descent(told.descent).cap_height(told.ascent).stem_v(80.0).font_file2(file);
        describes.finish();
        pdf.stream(file, &packed(&told.subset)).filter(Filter::FlateDecode);
        let mut means = UnicodeCmap::new(Name(b"Letters"), SYSTEM);
        for (number, text) in &self.means {
            means.pair_with_multiple(*number, text.chars());
        }
        let means = packed(&means.finish());
        pdf.cmap(unicode, &means).filter(Filter::FlateDecode);
        Ok(font)
    }
}

/// The metrics of a font, in thousandths of its size.
struct FontMetrics {
    subset: Vec<u8>,
    widths: Vec<f32>,
    bounds: Rect,
    ascent: f32,
    descent: f32,
}

impl FontMetrics {
    fn from_data(bytes: &[u8], index: u32, numbers: &GlyphRemapper) -> Result<FontMetrics, PdfError> {
        let wrong = |error: &dyn std::fmt::Display| PdfError::Font(error.to_string());
        let font = FontRef::from_index(bytes, index).map_err(|error| wrong(&error))?;
        let metrics = font.metrics(Size::unscaled(), LocationRef::default());
        let of_size = |units: f32| units * 1000.0 / f32::from(metrics.units_per_em);
        let glyphs = font.glyph_metrics(Size::unscaled(), LocationRef::default());
        let width = |glyph: u16| of_size(glyphs.advance_width(GlyphId::from(glyph)).unwrap_or(0.0));
        let bounds = metrics.bounds.unwrap_or_default();
        Ok(FontMetrics {
            subset: subsetter::subset(bytes, index, numbers).map_err(|error| wrong(&error))?,
            widths: numbers.remapped_gids().map(width).collect(),
            bounds: Rect::new(
                of_size(bounds.x_min),
                of_size(bounds.y_min),
                of_size(bounds.x_max),
                of_size(bounds.y_max),
            ),
            ascent: of_size(metrics.ascent),
            descent: of_size(metrics.descent),
        })
    }
}
