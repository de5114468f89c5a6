//! Pages of a PDF, each from an SVG of ours: shapes stay shapes, and words can be searched and copied.
//!
//! Each picture is scaled onto a sheet of A4, upright or lying, whichever it fills better.
//!
//! Left out: gradients, images, masks and filters, which our pictures do not have; a picture that has one is refused.

mod error;
mod fonts;

use super::font;

pub use error::PdfError;
use error::packed;
use fonts::Fonts;
use pdf_writer::types::{LineCapStyle, LineJoinStyle, PaintType, TextRenderingMode, TilingType};
use pdf_writer::{Content, Filter, Finish, Name, Pdf, Rect, Ref, Str, TextStr};
use resvg::usvg::tiny_skia_path::{Path as Outline, PathSegment, Transform};
use resvg::usvg::{self, FillRule, Group, LineCap, LineJoin, Node, Paint, Path, Pattern, Stroke, Text, Tree};

/// A sheet of A4, in points of 1/72 inch: its short and its long side.
const A4: [f32; 2] = [595.28, 841.89];
/// Margin around the picture, in points (our choice): 9 mm, which printers can print.
const MARGIN: f32 = 25.5;

/// A PDF of this title with a page for each SVG. The same pages are the same bytes.
pub fn pdf(title: &str, pages: &[String]) -> Result<Vec<u8>, PdfError> {
    let mut book = Book::new();
    let mut all = Vec::new();
    for page in pages {
        let tree = Tree::from_str(page, &font::options())?;
        all.push(book.page(&tree)?);
    }
    book.finish(title, &all)
}

struct Book {
    pdf: Pdf,
    next: i32,
    fonts: Fonts,
    /// Opacities of fills and strokes, in thousandths.
    alphas: Vec<(u16, u16)>,
    patterns: Vec<Ref>,
}

struct PageContent {
    content: Ref,
    size: [f32; 2],
}

/// The content that is drawn into, with its place on the page and its opacity.
struct Canvas {
    content: Content,
    at: Transform,
    opacity: f32,
}

impl Book {
    fn new() -> Book {
        Book { pdf: Pdf::new(), next: 1, fonts: Fonts::default(), alphas: Vec::new(), patterns: Vec::new() }
    }

    fn fresh(&mut self) -> Ref {
        let fresh = Ref::new(self.next);
        self.next += 1;
        fresh
    }

    fn page(&mut self, tree: &Tree) -> Result<PageContent, PdfError> {
        let picture = [tree.size().width(), tree.size().height()];
        let scale =
            |sheet: [f32; 2]| f32::min((sheet[0] - 2.0 * MARGIN) / picture[0], (sheet[1] - 2.0 * MARGIN) / picture[1]);
        let (upright, lying) = (A4, [A4[1], A4[0]]);
        let size = if scale(lying) > scale(upright) { lying } else { upright };
        let scale = scale(size);
        // From the top left corner down, as in pictures.
        let (x, y) = ((size[0] - picture[0] * scale) / 2.0, size[1] - MARGIN);
        let at = Transform::from_row(scale, 0.0, 0.0, -scale, x, y);
        let mut canvas = Canvas { content: Content::new(), at, opacity: 1.0 };
        canvas.content.save_state();
        canvas.content.transform(matrix(at));
        self.group(tree.root(), &mut canvas)?;
        canvas.content.restore_state();
        let content = self.fresh();
        self.stream(content, &canvas.content.finish());
        Ok(PageContent { content, size })
    }

    fn stream(&mut self, id: Ref, bytes: &[u8]) {
        let packed = packed(bytes);
        self.pdf.stream(id, &packed).filter(Filter::FlateDecode);
    }

    fn group(&mut self, group: &Group, canvas: &mut Canvas) -> Result<(), PdfError> {
        if group.clip_path().is_some() || group.mask().is_some() || !group.filters().is_empty() {
            return Err(PdfError::Unknown("masks and filters"));
        }
        let (at, opacity) = (canvas.at, canvas.opacity);
        let is_moved = !group.transform().is_identity();
        if is_moved {
            canvas.content.save_state();
            canvas.content.transform(matrix(group.transform()));
            canvas.at = at.pre_concat(group.transform());
        }
        // Exact for what is filled or stroked; ours that do both are never seen through.
        canvas.opacity *= group.opacity().get();
        for node in group.children() {
            match node {
                Node::Group(group) => self.group(group, canvas)?,
                Node::Path(path) => self.path(path, canvas)?,
                Node::Text(text) => self.text(text, canvas)?,
                Node::Image(_) => return Err(PdfError::Unknown("images")),
            }
        }
        if is_moved {
            canvas.content.restore_state();
        }
        (canvas.at, canvas.opacity) = (at, opacity);
        Ok(())
    }

    fn path(&mut self, path: &Path, canvas: &mut Canvas) -> Result<(), PdfError> {
        if !path.is_visible() {
            return Ok(());
        }
        canvas.content.save_state();
        self.paint(path.fill(), path.stroke(), canvas)?;
        outline(path.data(), &mut canvas.content);
        let rule = path.fill().map(|fill| fill.rule());
        let content = &mut canvas.content;
        match (rule, path.stroke().is_some()) {
            (Some(FillRule::NonZero), true) => content.fill_nonzero_and_stroke(),
            (Some(FillRule::NonZero), false) => content.fill_nonzero(),
            (Some(FillRule::EvenOdd), true) => content.fill_even_odd_and_stroke(),
            (Some(FillRule::EvenOdd), false) => content.fill_even_odd(),
            (None, true) => content.stroke(),
            (None, false) => content.end_path(),
        };
        canvas.content.restore_state();
        Ok(())
    }

    fn paint(
        &mut self,
        fill: Option<&usvg::Fill>,
        stroke: Option<&Stroke>,
        canvas: &mut Canvas,
    ) -> Result<(), PdfError> {
        let opacity = canvas.opacity;
        let alpha = |own: f32| (own * opacity * 1000.0).round() as u16;
        let alphas = (fill.map_or(1000, |fill| alpha(fill.opacity().get())), {
            stroke.map_or(1000, |stroke| alpha(stroke.opacity().get()))
        });
        if alphas != (1000, 1000) {
            let known = self.alphas.iter().position(|known| *known == alphas);
            let number = known.unwrap_or_else(|| {
                self.alphas.push(alphas);
                self.alphas.len() - 1
            });
            canvas.content.set_parameters(Name(format!("G{number}").as_bytes()));
        }
        match fill.map(usvg::Fill::paint) {
            Some(Paint::Color(colour)) => {
                let [r, g, b] = parts(colour);
                canvas.content.set_fill_rgb(r, g, b);
            }
            Some(Paint::Pattern(pattern)) => {
                let number = self.pattern(pattern, canvas.at)?;
                canvas.content.set_fill_color_space(pdf_writer::types::ColorSpaceOperand::Pattern);
                canvas.content.set_fill_pattern([], Name(format!("P{number}").as_bytes()));
            }
            Some(_) => return Err(PdfError::Unknown("gradients")),
            None => {}
        }
        let Some(stroke) = stroke else { return Ok(()) };
        let Paint::Color(colour) = stroke.paint() else {
            return Err(PdfError::Unknown("strokes with more than one colour"));
        };
        let [r, g, b] = parts(colour);
        canvas.content.set_stroke_rgb(r, g, b);
        canvas.content.set_line_width(stroke.width().get());
        canvas.content.set_line_cap(match stroke.linecap() {
            LineCap::Butt => LineCapStyle::ButtCap,
            LineCap::Round => LineCapStyle::RoundCap,
            LineCap::Square => LineCapStyle::ProjectingSquareCap,
        });
        canvas.content.set_line_join(match stroke.linejoin() {
            LineJoin::Round => LineJoinStyle::RoundJoin,
            LineJoin::Bevel => LineJoinStyle::BevelJoin,
            LineJoin::Miter | LineJoin::MiterClip => LineJoinStyle::MiterJoin,
        });
        if let Some(dashes) = stroke.dasharray() {
            canvas.content.set_dash_pattern(dashes.iter().copied(), stroke.dashoffset());
        }
        Ok(())
    }

    /// The number of a pattern that is laid from `at` on: PDF lays patterns on the page, not on the filled shape.
    fn pattern(&mut self, pattern: &Pattern, at: Transform) -> Result<usize, PdfError> {
        let rect = pattern.rect();
        let at = at.pre_concat(pattern.transform());
        let mut canvas = Canvas { content: Content::new(), at, opacity: 1.0 };
        self.group(pattern.root(), &mut canvas)?;
        let id = self.fresh();
        let packed = packed(&canvas.content.finish());
        let mut tiling = self.pdf.tiling_pattern(id, &packed);
        tiling.filter(Filter::FlateDecode);
        tiling.tiling_type(TilingType::ConstantSpacing).paint_type(PaintType::Colored);
        tiling.bbox(Rect::new(rect.x(), rect.y(), rect.x() + rect.width(), rect.y() + rect.height()));
        tiling.x_step(rect.width()).y_step(rect.height());
        tiling.matrix(matrix(at));
        tiling.resources();
        tiling.finish();
        self.patterns.push(id);
        Ok(self.patterns.len() - 1)
    }

    fn text(&mut self, text: &Text, canvas: &mut Canvas) -> Result<(), PdfError> {
        let is_rim = |fill: Option<&usvg::Fill>, stroke: Option<&Stroke>| match (fill, stroke) {
            (Some(fill), Some(stroke)) => fill.paint() != stroke.paint(),
            _ => false,
        };
        // A rim of another colour lies below the same words: as a shape, so that who copies them gets them once.
        if text.layouted().iter().any(|span| is_rim(span.fill.as_ref(), span.stroke.as_ref())) {
            return self.group(text.flattened(), canvas);
        }
        for span in text.layouted().iter().filter(|span| span.visible) {
            canvas.content.save_state();
            self.paint(span.fill.as_ref(), span.stroke.as_ref(), canvas)?;
            canvas.content.begin_text();
            canvas.content.set_text_rendering_mode(match (&span.fill, &span.stroke) {
                (Some(_), Some(_)) => TextRenderingMode::FillStroke,
                (None, Some(_)) => TextRenderingMode::Stroke,
                _ => TextRenderingMode::Fill,
            });
            let mut set = None;
            for glyph in &span.positioned_glyphs {
                let (font, number) = self.fonts.glyph(glyph.font, glyph.id.0 as u16, &glyph.text);
                if set != Some(font) {
                    canvas.content.set_font(Name(format!("F{font}").as_bytes()), 1.0);
                    set = Some(font);
                }
                // From units of the font to a font of size 1. Numbers of glyphs in a font have two bytes.
                let of_units = glyph.outline_transform();
                let units = glyph.font_size() / of_units.sx.hypot(of_units.ky);
                canvas.content.set_text_matrix(matrix(of_units.pre_scale(units, units)));
                canvas.content.show(Str(&number.to_be_bytes()));
            }
            canvas.content.end_text();
            canvas.content.restore_state();
        }
        Ok(())
    }

    fn finish(mut self, title: &str, pages: &[PageContent]) -> Result<Vec<u8>, PdfError> {
        let [catalog, tree, resources, info] = [(); 4].map(|()| self.fresh());
        let fonts = std::mem::take(&mut self.fonts).write(&mut self.pdf, &mut self.next)?;
        let alphas: Vec<Ref> = self.alphas.clone().iter().map(|_| self.fresh()).collect();
        for (id, (fill, stroke)) in alphas.iter().zip(&self.alphas) {
            let mut state = self.pdf.ext_graphics(*id);
            state.non_stroking_alpha(f32::from(*fill) / 1000.0).stroking_alpha(f32::from(*stroke) / 1000.0);
        }
        let mut all = self.pdf.indirect(resources).start::<pdf_writer::writers::Resources>();
        let mut named = all.fonts();
        for (number, id) in fonts.iter().enumerate() {
            named.pair(Name(format!("F{number}").as_bytes()), *id);
        }
        named.finish();
        let mut named = all.ext_g_states();
        for (number, id) in alphas.iter().enumerate() {
            named.pair(Name(format!("G{number}").as_bytes()), *id);
        }
        named.finish();
        let mut named = all.patterns();
        for (number, id) in self.patterns.iter().enumerate() {
            named.pair(Name(format!("P{number}").as_bytes()), *id);
        }
        named.finish();
        all.finish();
        let kids: Vec<Ref> = pages.iter().map(|_| self.fresh()).collect();
        for (id, PageContent { content, size: [width, height] }) in kids.iter().zip(pages) {
            let mut page = self.pdf.page(*id);
            page.parent(tree).media_box(Rect::new(0.0, 0.0, *width, *height)).contents(*content);
            page.pair(Name(b"Resources"), resources);
        }
        self.pdf.pages(tree).count(kids.len() as i32).kids(kids.iter().copied());
        self.pdf.catalog(catalog).pages(tree).lang(TextStr("en"));
        self.pdf.document_info(info).title(TextStr(title)).producer(TextStr("Homebody"));
        Ok(self.pdf.finish())
    }
}

/// The operators of an outline.
fn outline(path: &Outline, content: &mut Content) {
    let mut last = (0.0, 0.0);
    for segment in path.segments() {
        match segment {
            PathSegment::MoveTo(p) => {
                content.move_to(p.x, p.y);
                last = (p.x, p.y);
            }
            PathSegment::LineTo(p) => {
                content.line_to(p.x, p.y);
                last = (p.x, p.y);
            }
            PathSegment::QuadTo(c, p) => {
                // As a cubic: two thirds of the way to the one that steers.
                let third = |from: f32, to: f32| from + (to - from) * 2.0 / 3.0;
                let (x1, y1) = (third(last.0, c.x), third(last.1, c.y));
                content.cubic_to(x1, y1, third(p.x, c.x), third(p.y, c.y), p.x, p.y);
                last = (p.x, p.y);
            }
            PathSegment::CubicTo(a, b, p) => {
                content.cubic_to(a.x, a.y, b.x, b.y, p.x, p.y);
                last = (p.x, p.y);
            }
            PathSegment::Close => {
                content.close_path();
            }
        }
    }
}

fn matrix(t: Transform) -> [f32; 6] {
    [t.sx, t.ky, t.kx, t.sy, t.tx, t.ty]
}

fn parts(colour: &usvg::Color) -> [f32; 3] {
    [colour.red, colour.green, colour.blue].map(|part| f32::from(part) / 255.0)
}
