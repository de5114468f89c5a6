//! A picture of a plan with its scale and position in the home.

use crate::error::ScaffoldError;
use crate::messages::NewMessage;
use homebody_core::geometry::Point;
use homebody_core::problem::{Problem, Problems};
use homebody_log::files::plain;
use homebody_simulation::SimulationError;
use serde_json::json;
use std::path::Path;
use std::str::FromStr;

/// Largest number of bytes of a picture, as in the page (our choice).
const LARGEST_BYTES: u64 = 50_000_000;

/// A point of a picture, in pixels from its upper left corner, and its position in the home, in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KnownPoint {
    pixel: Point,
    at: Point,
}

impl FromStr for KnownPoint {
    type Err = NewMessage;

    /// `120,340=0,0`.
    fn from_str(text: &str) -> Result<KnownPoint, NewMessage> {
        let point = |text: &str| {
            let (x, y) = text.split_once(',')?;
            let number = |text: &str| text.trim().parse().ok().filter(|number: &f64| number.is_finite());
            Some(Point::new(number(x)?, number(y)?))
        };
        let known =
            text.split_once('=').and_then(|(pixel, at)| Some(KnownPoint { pixel: point(pixel)?, at: point(at)? }));
        known.ok_or_else(|| NewMessage::KnownPoint { text: text.to_owned() })
    }
}

pub struct PlanPicture {
    pub bytes: Vec<u8>,
    pub file: &'static str,
    size: Point,
    first: KnownPoint,
    /// Rotation and scale of the picture with y upward, as a complex number, in metres a pixel.
    turn: Point,
}

impl PlanPicture {
    /// Reads a picture with two known points.
    pub fn read(path: &Path, known: &[KnownPoint]) -> Result<PlanPicture, ScaffoldError> {
        let bytes = plain::read(path, LARGEST_BYTES).map_err(|error| SimulationError::io(path, error))?;
        let (file, size) = size(&bytes).ok_or_else(|| {
            let problem = Problem::of_file(&path.display().to_string(), NewMessage::NotAPicture, None);
            ScaffoldError::Source(Problems(vec![problem]))
        })?;
        let unlike = |message: NewMessage| ScaffoldError::Source(Problems(vec![message.into()]));
        let &[first, second] = known else {
            return Err(unlike(NewMessage::KnownPoints { points: known.len() }));
        };
        let on_picture = upward(second.pixel) - upward(first.pixel);
        let in_home = second.at - first.at;
        if on_picture.length() < 1.0 || in_home.length() < 0.01 {
            return Err(unlike(NewMessage::SamePoint));
        }
        // The quotient of both as complex numbers.
        let turn = Point::new(in_home.dot(on_picture), on_picture.perp_dot(in_home)) / on_picture.length_squared();
        Ok(PlanPicture { bytes, file, size, first, turn })
    }

    /// The position of a pixel in the home, in metres.
    pub fn at(&self, pixel: [f64; 2]) -> Point {
        let step = upward(Point::from(pixel)) - upward(self.first.pixel);
        let Point { x, y } = self.turn;
        self.first.at + Point::new(x * step.x - y * step.y, y * step.x + x * step.y)
    }

    pub fn has(&self, pixel: [f64; 2]) -> bool {
        let pixel = Point::from(pixel);
        pixel.cmpge(Point::ZERO).all() && pixel.cmple(self.size).all()
    }

    /// The position of the picture below the plan, in the form of the page.
    pub fn lies(&self) -> String {
        let rounded = |metres: f64| (metres * 1e3).round() / 1e3 + 0.0;
        let middle = self.at((self.size / 2.0).into());
        let text = json!({
            "picture": self.file,
            "at": [rounded(middle.x), rounded(middle.y)],
            "width_m": rounded(self.size.x * self.turn.length()),
            "turn_deg": rounded(self.turn.y.atan2(self.turn.x).to_degrees()),
        });
        format!("{text:#}\n")
    }
}

fn upward(pixel: Point) -> Point {
    Point::new(pixel.x, -pixel.y)
}

/// The name of a picture, its width and height.
fn size(bytes: &[u8]) -> Option<(&'static str, Point)> {
    let long = |at: usize| Some(u32::from_be_bytes(bytes.get(at..at + 4)?.try_into().ok()?));
    let short = |at: usize| Some(u16::from_be_bytes(bytes.get(at..at + 2)?.try_into().ok()?));
    if bytes.starts_with(b"\x89PNG\r\n\x1a\n") {
        return Some(("plan.png", Point::new(long(16)?.into(), long(20)?.into())));
    }
    if !bytes.starts_with(b"\xff\xd8") {
        return None;
    }
    // The segments of a JPEG, up to the one with its size.
    let mut at = 2;
    loop {
        let (mark, kind) = (*bytes.get(at)?, *bytes.get(at + 1)?);
        if mark != 0xff {
            return None;
        }
        if matches!(kind, 0xc0..=0xcf) && ![0xc4, 0xc8, 0xcc].contains(&kind) {
            return Some(("plan.jpg", Point::new(short(at + 7)?.into(), short(at + 5)?.into())));
        }
        at += 2 + usize::from(short(at + 2)?);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn traced(known: [&str; 2]) -> PlanPicture {
        let known = known.map(|known| known.parse().unwrap());
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("plan.png");
        let mut bytes = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR".to_vec();
        bytes.extend([0, 0, 3, 0xe8, 0, 0, 1, 0xf4]);
        std::fs::write(&path, bytes).unwrap();
        PlanPicture::read(&path, &known).unwrap_or_else(|_| panic!("a picture"))
    }

    #[test]
    fn two_points_place_a_picture() {
        let flat = traced(["0,500=0,0", "1000,500=10,0"]);
        assert!(flat.at([500.0, 250.0]).distance(Point::new(5.0, 2.5)) < 1e-9);
        let lies: serde_json::Value = serde_json::from_str(&flat.lies()).unwrap();
        assert_eq!(lies, json!({ "picture": "plan.png", "at": [5.0, 2.5], "width_m": 10.0, "turn_deg": 0.0 }));
        // Turned by a quarter: the picture's right is north.
        let turned = traced(["0,0=1,1", "100,0=1,3"]);
        assert!(turned.at([0.0, 100.0]).distance(Point::new(3.0, 1.0)) < 1e-9, "{}", turned.at([0.0, 100.0]));
        assert!(turned.lies().contains("\"turn_deg\": 90.0"), "{}", turned.lies());
    }

    #[test]
    fn reads_the_size_of_a_jpeg_from_its_segments() {
        let bytes = [0xff, 0xd8, 0xff, 0xe0, 0, 4, 1, 2, 0xff, 0xc0, 0, 11, 8, 1, 0, 2, 0, 3];
        assert_eq!(size(&bytes), Some(("plan.jpg", Point::new(512.0, 256.0))));
        assert_eq!((size(b"GIF89a"), size(b"\xff\xd8\xff")), (None, None));
    }

    #[test]
    fn points_are_pixels_and_metres() {
        assert_eq!(
            "1, 2 = 3,4.5".parse::<KnownPoint>().unwrap(),
            KnownPoint { pixel: Point::new(1.0, 2.0), at: Point::new(3.0, 4.5) }
        );
        for wrong in ["", "1,2", "1=2", "1,2=x,3", "1,2=inf,3"] {
            assert!(wrong.parse::<KnownPoint>().is_err(), "{wrong}");
        }
    }
}
