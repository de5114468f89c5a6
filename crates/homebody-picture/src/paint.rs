//! The colours of pictures, and how shapes are painted with them.

pub const WHITE: &str = "#ffffff";
pub const INK: &str = "#1b1f24";
/// For secondary text; 6:1 on white.
pub const MUTED: &str = "#565d66";
pub const HAIRLINE: &str = "#c9cdd2";
pub const FLOOR: &str = "#f5f2ea";
pub const WALL: &str = "#30363d";
pub const FURNITURE_EDGE: &str = "#8b9199";

/// Okabe & Ito's blue.
pub const SENSOR: &str = "#0072b2";
/// Okabe & Ito's vermilion, for lines; its text is darker, to be read on white.
pub const DEAD: &str = "#d55e00";
pub const DEAD_TEXT: &str = "#8f3f00";
pub const DEAD_GROUND: &str = "#fde9dc";

/// One, two, three and more sensors: viridis from light to dark, so that grey tells them apart too.
pub const SEEN: [&str; 3] = ["#f2e96b", "#4fbf83", "#31688e"];

/// At home, but nothing moves.
pub const QUIET: &str = "#ffffff";
/// Eight levels of motion: viridis from light to dark. Its darkest end would look like black, and its lightest is paler, as
/// most of the nights are.
pub const DENSITY: [&str; 8] = ["#fbf1a9", "#d3e25b", "#8fd14f", "#48c06f", "#22a884", "#21918c", "#2f6c8e", "#414487"];

/// Okabe & Ito's palette in the order in which lines of a chart take it; instead of the yellow, which is too pale for lines, a grey.
pub const SERIES: [&str; 8] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000", "#7d7d7d"];

#[derive(Clone, Copy)]
pub struct Paint<'a> {
    pub fill: &'a str,
    pub stroke: &'a str,
    /// Of the stroke; zero for none.
    pub width: f64,
    pub dash: &'a str,
    pub opacity: f64,
    /// The inside of a path that meets itself.
    pub rule: &'a str,
}

impl<'a> Paint<'a> {
    pub const fn fill(fill: &'a str) -> Paint<'a> {
        Paint { fill, stroke: "none", width: 0.0, dash: "", opacity: 1.0, rule: "evenodd" }
    }

    pub const fn line(stroke: &'a str, width: f64) -> Paint<'a> {
        Paint { stroke, width, ..Paint::fill("none") }
    }

    pub const fn outlined(self, stroke: &'a str, width: f64) -> Paint<'a> {
        Paint { stroke, width, ..self }
    }

    pub const fn dashed(self, dash: &'a str) -> Paint<'a> {
        Paint { dash, ..self }
    }

    pub const fn faint(self, opacity: f64) -> Paint<'a> {
        Paint { opacity, ..self }
    }

    /// Shapes of one path are joined, where they overlap too.
    pub const fn joined(self) -> Paint<'a> {
        Paint { rule: "nonzero", ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn luminance(colour: &str) -> f64 {
        let part = |at: usize| {
            let value = f64::from(u8::from_str_radix(&colour[at..at + 2], 16).expect("two hex digits")) / 255.0;
            if value <= 0.04045 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
        };
        0.2126 * part(1) + 0.7152 * part(3) + 0.0722 * part(5)
    }

    /// WCAG 2's contrast ratio.
    fn contrast(a: &str, b: &str) -> f64 {
        let (a, b) = (luminance(a), luminance(b));
        (a.max(b) + 0.05) / (a.min(b) + 0.05)
    }

    #[test]
    fn text_and_marks_stand_out() {
        for text in [INK, MUTED, DEAD_TEXT, SENSOR] {
            assert!(contrast(text, WHITE) >= 4.5 && contrast(text, FLOOR) >= 4.5, "{text}");
        }
        assert!(contrast(DEAD, WHITE) >= 3.0);
    }

    #[test]
    fn more_motion_is_darker_and_never_black() {
        assert!(DENSITY.map(luminance).is_sorted_by(|a, b| a > b));
        assert!(luminance(QUIET) > luminance(DENSITY[0]) && contrast(DENSITY[7], INK) > 1.8);
    }

    #[test]
    fn more_sensors_are_darker() {
        assert!(SEEN.map(luminance).is_sorted_by(|a, b| a > b));
        assert!(contrast(SEEN[0], SEEN[1]) > 1.5 && contrast(SEEN[1], SEEN[2]) > 2.0);
    }
}
