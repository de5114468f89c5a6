//! Rectangles along the axes.

use homebody_core::geometry::{At, Point, bounds};

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rect {
    pub least: Point,
    pub most: Point,
}

impl Rect {
    pub fn around(middle: Point, size: Point) -> Rect {
        Rect { least: middle - size / 2.0, most: middle + size / 2.0 }
    }

    pub fn around_all(rects: &[Rect]) -> Rect {
        let (least, most) = bounds(rects.iter().flat_map(|rect| [rect.least, rect.most]));
        Rect { least, most }
    }

    pub fn size(&self) -> Point {
        self.most - self.least
    }

    pub fn middle(&self) -> Point {
        (self.least + self.most) / 2.0
    }

    /// The same, smaller by a margin on each side.
    pub fn inset(&self, margin: f64) -> Rect {
        Rect { least: self.least + Point::splat(margin), most: self.most - Point::splat(margin) }
    }

    pub fn clipped(&self, to: &Rect) -> Rect {
        Rect { least: self.least.max(to.least), most: self.most.min(to.most) }
    }

    pub fn has(&self, p: Point) -> bool {
        p.cmpge(self.least).all() && p.cmple(self.most).all()
    }

    pub fn contains(&self, other: &Rect) -> bool {
        self.has(other.least) && self.has(other.most)
    }

    pub fn overlaps(&self, other: &Rect) -> bool {
        let common = self.clipped(other);
        common.least.cmplt(common.most).all()
    }

    /// The distance between two rectangles; 0 if they touch.
    pub fn gap(&self, other: &Rect) -> f64 {
        (other.least - self.most).max(self.least - other.most).max(Point::ZERO).length()
    }

    /// The common side of two rectangles, from one end to the other.
    pub fn common_side(&self, other: &Rect) -> Option<(Point, Point)> {
        /// Sides nearer than this are one.
        const NEAR_M: f64 = 1e-6;
        let common = self.clipped(other);
        let touches = |a: f64, b: f64| (a - b).abs() < NEAR_M;
        if touches(self.most.x, other.least.x) || touches(self.least.x, other.most.x) {
            let x = if touches(self.most.x, other.least.x) { self.most.x } else { self.least.x };
            return (common.most.y > common.least.y)
                .then(|| (Point::new(x, common.least.y), Point::new(x, common.most.y)));
        }
        if touches(self.most.y, other.least.y) || touches(self.least.y, other.most.y) {
            let y = if touches(self.most.y, other.least.y) { self.most.y } else { self.least.y };
            return (common.most.x > common.least.x)
                .then(|| (Point::new(common.least.x, y), Point::new(common.most.x, y)));
        }
        None
    }

    /// Counter-clockwise.
    pub fn corners(&self) -> Vec<At> {
        let (a, b) = (self.least, self.most);
        [[a.x, a.y], [b.x, a.y], [b.x, b.y], [a.x, b.y]].map(rounded).to_vec()
    }

    pub fn sides(&self) -> [(Point, Point); 4] {
        let (a, c) = (self.least, self.most);
        let (b, d) = (Point::new(c.x, a.y), Point::new(a.x, c.y));
        [(a, b), (b, c), (d, c), (a, d)]
    }
}

/// To the centimetre.
pub fn rounded(at: At) -> At {
    at.map(|metres| (metres * 100.0).round() / 100.0 + 0.0)
}

/// A rectangle cut in two at a place along an axis.
pub fn cut(rect: &Rect, is_upright: bool, at: f64) -> [Rect; 2] {
    let (mut first, mut second) = (*rect, *rect);
    if is_upright {
        (first.most.x, second.least.x) = (at, at);
    } else {
        (first.most.y, second.least.y) = (at, at);
    }
    [first, second]
}
