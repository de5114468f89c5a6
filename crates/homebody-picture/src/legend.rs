//! The column next to a plan with the meanings of its marks.

use homebody_core::geometry::Point;

use super::font;
use super::paint::{HAIRLINE, INK, MUTED, Paint};
use super::sheet;
use super::svg::{Anchor, Svg, Type};

pub struct Legend {
    y: f64,
}

/// Width of the column of samples to the left of the words.
const SAMPLE: Point = Point::new(26.0, 15.0);
const TEXT: Type = Type::new(13.0, INK);

impl Legend {
    pub fn new() -> Legend {
        Legend { y: sheet::TOP + 8.0 }
    }

    pub fn end(&self) -> f64 {
        self.y
    }

    pub fn heading(&mut self, svg: &mut Svg, words: &str) {
        if self.y > sheet::TOP + 8.0 {
            self.y += 14.0;
        }
        svg.text(words, Point::new(sheet::LEGEND.0, self.y), &Type::new(14.0, INK).strong());
        self.y += 12.0;
        let from = Point::new(sheet::LEGEND.0, self.y);
        svg.line(from, from + Point::new(sheet::LEGEND.1, 0.0), &Paint::line(HAIRLINE, 1.0));
        self.y += 15.0;
    }

    /// A sample with its meaning; `draw` gets the least and the greatest corner of the sample.
    pub fn entry(&mut self, svg: &mut Svg, words: &str, draw: impl FnOnce(&mut Svg, Point, Point)) {
        let middle = Point::new(sheet::LEGEND.0 + SAMPLE.x / 2.0, self.y);
        draw(svg, middle - SAMPLE / 2.0, middle + SAMPLE / 2.0);
        let left = sheet::LEGEND.0 + SAMPLE.x + 10.0;
        for line in wrapped(words, TEXT.size, sheet::LEGEND.1 - SAMPLE.x - 10.0) {
            svg.text(&line, Point::new(left, self.y), &TEXT);
            self.y += 17.0;
        }
        self.y += 6.0;
    }

    /// A row of a table: a name to the left, numbers to the right, each column `wide` pixels.
    pub fn row(&mut self, svg: &mut Svg, name: &str, numbers: &[String], wide: f64, set: Type) {
        let room = sheet::LEGEND.1 - wide * numbers.len() as f64 - 4.0;
        svg.text(&font::shortened(name, set.size, room), Point::new(sheet::LEGEND.0, self.y), &set);
        for (column, number) in numbers.iter().rev().enumerate() {
            let right = sheet::LEGEND.0 + sheet::LEGEND.1 - column as f64 * wide;
            svg.text(number, Point::new(right, self.y), &set.anchored(Anchor::End));
        }
        self.y += 18.0;
    }

    pub fn note(&mut self, svg: &mut Svg, words: &str) {
        self.y += 4.0;
        for line in wrapped(words, 12.0, sheet::LEGEND.1) {
            svg.text(&line, Point::new(sheet::LEGEND.0, self.y), &Type::new(12.0, MUTED));
            self.y += 16.0;
        }
    }
}

/// The words in lines of at most this width, unless a single word is wider.
pub fn wrapped(words: &str, size: f64, room: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in words.split(' ') {
        let longer = lines.last().map(|line| format!("{line} {word}"));
        match longer.filter(|line| font::width(line, size) <= room) {
            Some(longer) => *lines.last_mut().expect("a line that became longer") = longer,
            None => lines.push(word.to_owned()),
        }
    }
    lines
}
