//! A writer of SVG: shapes in, well-formed text out.

use std::fmt::{Display, Write};

use homebody_core::geometry::Point;

use super::paint::{Paint, WHITE};

/// The fonts of an SVG. A reader without the first takes a similar one; labels leave room for that.
const FAMILY: &str = "Ubuntu, 'Helvetica Neue', Arial, sans-serif";

/// A picture being drawn. Points are pixels from the top left; later shapes cover earlier ones.
pub struct Svg {
    title: String,
    description: String,
    body: String,
}

#[derive(Clone, Copy)]
pub struct Type {
    pub size: f64,
    pub fill: &'static str,
    pub anchor: Anchor,
    /// Heavier than usual.
    pub strong: bool,
    /// With a white rim, to be read on top of a drawing.
    pub halo: bool,
    /// Turned to read upwards.
    pub upright: bool,
}

/// The part of a text that lies at its point.
#[derive(Clone, Copy, PartialEq)]
pub enum Anchor {
    Start,
    Middle,
    End,
}

pub type Attribute<'a> = (&'a str, &'a dyn Display);

impl Svg {
    /// Title and description are for people who do not see the picture.
    pub fn new(title: &str, description: &str) -> Svg {
        Svg { title: title.to_owned(), description: description.to_owned(), body: String::new() }
    }

    /// The picture's text, on white paper of this size in pixels.
    pub fn finish(self, width: f64, height: f64) -> String {
        let (w, h) = (Px(width), Px(height));
        let mut whole = Svg::new("", "");
        whole.open(
            "svg",
            &[
                ("xmlns", &"http://www.w3.org/2000/svg"),
                ("viewBox", &format!("0 0 {w} {h}")),
                ("width", &w),
                ("height", &h),
                ("role", &"img"),
                ("font-family", &FAMILY),
            ],
        );
        for (name, words) in [("title", &self.title), ("desc", &self.description)] {
            if !words.is_empty() {
                let _ = writeln!(whole.body, "<{name}>{}</{name}>", escaped(words));
            }
        }
        whole.element("rect", &[("width", &w), ("height", &h), ("fill", &WHITE)]);
        whole.body + &self.body + "</svg>\n"
    }

    pub fn polygon(&mut self, corners: &[Point], paint: &Paint) {
        self.path(&rings([corners]), paint);
    }

    pub fn line(&mut self, from: Point, to: Point, paint: &Paint) {
        self.path(&polyline(&[from, to]), paint);
    }

    /// A path in SVG's own notation, as `rings` and `polyline` write it.
    pub fn path(&mut self, d: &str, paint: &Paint) {
        self.shape("path", &[("d", &d)], paint);
    }

    pub fn rectangle(&mut self, corner: Point, size: Point, paint: &Paint) {
        let (x, y, w, h) = (Px(corner.x), Px(corner.y), Px(size.x), Px(size.y));
        self.shape("rect", &[("x", &x), ("y", &y), ("width", &w), ("height", &h)], paint);
    }

    pub fn circle(&mut self, middle: Point, radius: f64, paint: &Paint) {
        self.shape("circle", &[("cx", &Px(middle.x)), ("cy", &Px(middle.y)), ("r", &Px(radius))], paint);
    }

    /// A line of text whose letters are centred vertically on the point.
    pub fn text(&mut self, words: &str, at: Point, set: &Type) {
        // Capitals are 0.7 of the size high, small letters 0.5: their common middle.
        let drop = 0.33 * set.size;
        let at = if set.upright { at + Point::new(drop, 0.0) } else { at + Point::new(0.0, drop) };
        let (x, y, size) = (Px(at.x), Px(at.y), Px(set.size));
        let turn = format!("rotate(-90 {x} {y})");
        let anchor = match set.anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let mut attributes: Vec<Attribute> = vec![("x", &x), ("y", &y), ("font-size", &size), ("fill", &set.fill)];
        if set.anchor != Anchor::Start {
            attributes.push(("text-anchor", &anchor));
        }
        if set.upright {
            attributes.push(("transform", &turn));
        }
        let rim = Px(0.34 * set.size);
        if set.halo {
            let mut under = attributes.clone();
            under.extend::<[Attribute; 5]>([
                ("stroke", &WHITE),
                ("stroke-width", &rim),
                ("stroke-linejoin", &"round"),
                ("stroke-opacity", &0.92),
                ("aria-hidden", &true),
            ]);
            self.words(&under, words);
        }
        // The text's font has one weight, a light one: a stroke makes it a regular or a bold.
        let weight = Px(set.size * if set.strong { 0.05 } else { 0.015 });
        attributes.extend::<[Attribute; 2]>([("stroke", &set.fill), ("stroke-width", &weight)]);
        self.words(&attributes, words);
    }

    /// Draws inside a group, which programs that show the picture can find by its class and name.
    pub fn group(&mut self, class: &str, name: &str, draw: impl FnOnce(&mut Svg)) {
        self.open("g", &[("class", &class), ("data-name", &name)]);
        draw(self);
        self.body.push_str("</g>\n");
    }

    /// Draws without soft edges: cells side by side then show no seams.
    pub fn crisp(&mut self, draw: impl FnOnce(&mut Svg)) {
        self.open("g", &[("shape-rendering", &"crispEdges")]);
        draw(self);
        self.body.push_str("</g>\n");
    }

    /// A pattern of slanted lines, to fill shapes with as `url(#id)`.
    pub fn hatch(&mut self, id: &str, ground: &str, ink: &str) {
        self.body.push_str("<defs>");
        self.open(
            "pattern",
            &[
                ("id", &id),
                ("width", &7),
                ("height", &7),
                ("patternUnits", &"userSpaceOnUse"),
                ("patternTransform", &"rotate(45)"),
            ],
        );
        self.rectangle(Point::ZERO, Point::splat(7.0), &Paint::fill(ground));
        self.rectangle(Point::ZERO, Point::new(1.8, 7.0), &Paint::fill(ink));
        self.body.push_str("</pattern></defs>\n");
    }

    fn shape(&mut self, name: &str, attributes: &[Attribute], paint: &Paint) {
        let (width, opacity) = (Px(paint.width), Px(paint.opacity));
        let mut attributes = attributes.to_vec();
        attributes.push(("fill", &paint.fill));
        if paint.width > 0.0 {
            attributes.extend::<[Attribute; 2]>([("stroke", &paint.stroke), ("stroke-width", &width)]);
            attributes.push(("stroke-linejoin", &"round"));
        }
        if !paint.dash.is_empty() {
            attributes.push(("stroke-dasharray", &paint.dash));
        }
        if paint.opacity < 1.0 {
            attributes.push(("opacity", &opacity));
        }
        if name == "path" && paint.fill != "none" {
            attributes.push(("fill-rule", &paint.rule));
        }
        self.element(name, &attributes);
    }

    fn words(&mut self, attributes: &[Attribute], words: &str) {
        self.open("text", attributes);
        // Taken back: white space inside a text is part of it.
        self.body.truncate(self.body.trim_end().len());
        let _ = writeln!(self.body, "{}</text>", escaped(words));
    }

    fn element(&mut self, name: &str, attributes: &[Attribute]) {
        self.open(name, attributes);
        self.body.truncate(self.body.trim_end().len() - 1);
        self.body.push_str("/>\n");
    }

    fn open(&mut self, name: &str, attributes: &[Attribute]) {
        let _ = write!(self.body, "<{name}");
        for (key, value) in attributes {
            let _ = write!(self.body, " {key}=\"{}\"", escaped(&value.to_string()));
        }
        self.body.push_str(">\n");
    }
}

impl Type {
    pub const fn new(size: f64, fill: &'static str) -> Type {
        Type { size, fill, anchor: Anchor::Start, strong: false, halo: false, upright: false }
    }

    pub const fn anchored(self, anchor: Anchor) -> Type {
        Type { anchor, ..self }
    }

    pub const fn strong(self) -> Type {
        Type { strong: true, ..self }
    }
}

/// Closed rings as one path.
pub fn rings<'a>(rings: impl IntoIterator<Item = &'a [Point]>) -> String {
    rings.into_iter().map(|ring| polyline(ring) + "Z").collect()
}

/// Points joined by straight lines, as a path.
pub fn polyline(points: &[Point]) -> String {
    let mut path = String::new();
    for (i, p) in points.iter().enumerate() {
        let _ = write!(path, "{}{} {}", if i == 0 { 'M' } else { 'L' }, Px(p.x), Px(p.y));
    }
    path
}

/// A number in an SVG: hundredths are finer than the eye sees, and keep the file small.
pub struct Px(pub f64);

impl Display for Px {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        let hundredths = (self.0 * 100.0).round();
        // Adding zero turns a negative zero into a plain one.
        write!(f, "{}", (hundredths + 0.0) / 100.0)
    }
}

/// Text as it may stand in XML: markup escaped, and characters that XML forbids replaced.
pub fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\'' => escaped.push_str("&apos;"),
            '\t' | '\n' | '\r' => escaped.push(' '),
            '\0'..='\u{1f}' | '\u{fffe}' | '\u{ffff}' => escaped.push('\u{fffd}'),
            c => escaped.push(c),
        }
    }
    escaped
}
