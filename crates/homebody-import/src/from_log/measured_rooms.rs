//! Rooms by measured positions of sensors: a rectangle around all of them, cut so that the sensors of each room are together.

use super::shape::{Rect, cut};
use homebody_core::geometry::{Point, bounds};

/// Distance from the outermost sensors to the end of the home (our choice).
const MARGIN_M: f64 = 1.3;
/// Smallest width of a part (our choice).
const LEAST_M: f64 = 1.3;

/// The rectangles of rooms by the places of their sensors; `None` for a room without a sensor.
pub fn rectangles(places: &[Vec<Point>]) -> Vec<Option<Rect>> {
    let (least, most) = bounds(places.iter().flatten().copied());
    let whole = Rect { least: least - Point::splat(MARGIN_M), most: most + Point::splat(MARGIN_M) };
    let mut rects = vec![None; places.len()];
    let rooms: Vec<usize> = (0..places.len()).filter(|&room| !places[room].is_empty()).collect();
    part(whole, rooms, places, &mut rects);
    rects
}

fn part(rect: Rect, rooms: Vec<usize>, places: &[Vec<Point>], rects: &mut [Option<Rect>]) {
    let [_, _, ..] = rooms[..] else {
        rooms.into_iter().for_each(|room| rects[room] = Some(rect));
        return;
    };
    let ways = [true, false].into_iter().filter_map(|is_upright| best_cut(&rect, &rooms, places, is_upright));
    let Some(best) = ways.min_by(|a, b| a.wrong.cmp(&b.wrong).then(b.gap_m.total_cmp(&a.gap_m))) else {
        // Too small to be divided: the first room takes all of it.
        rects[rooms[0]] = Some(rect);
        return;
    };
    let [a, b] = cut(&rect, best.is_upright, best.at);
    part(a, best.before, places, rects);
    part(b, best.behind, places, rects);
}

struct RoomCut {
    is_upright: bool,
    at: f64,
    before: Vec<usize>,
    behind: Vec<usize>,
    /// The number of places on the wrong side.
    wrong: usize,
    /// The distance between the places of both sides.
    gap_m: f64,
}

fn best_cut(rect: &Rect, rooms: &[usize], places: &[Vec<Point>], is_upright: bool) -> Option<RoomCut> {
    let along = |p: Point| if is_upright { p.x } else { p.y };
    let (least, most) = (along(rect.least) + LEAST_M, along(rect.most) - LEAST_M);
    if least > most {
        return None;
    }
    let mean = |room: usize| places[room].iter().map(|&at| along(at)).sum::<f64>() / places[room].len() as f64;
    let mut sorted = rooms.to_vec();
    sorted.sort_by(|&a, &b| mean(a).total_cmp(&mean(b)));
    let cuts = (1..sorted.len()).map(|count| {
        let (before, behind) = sorted.split_at(count);
        let of = |rooms: &[usize]| {
            rooms.iter().flat_map(|&room| places[room].iter().map(|&at| along(at))).collect::<Vec<_>>()
        };
        let (first, second) = (of(before), of(behind));
        let end = first.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let begin = second.iter().copied().fold(f64::INFINITY, f64::min);
        let at = f64::midpoint(end, begin).clamp(least, most);
        let wrong =
            first.iter().filter(|&&place| place > at).count() + second.iter().filter(|&&place| place < at).count();
        RoomCut { is_upright, at, before: before.to_vec(), behind: behind.to_vec(), wrong, gap_m: begin - end }
    });
    cuts.min_by(|a, b| a.wrong.cmp(&b.wrong).then(b.gap_m.total_cmp(&a.gap_m)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sensors_of_one_room_are_together() {
        let at = |x: f64, y: f64| Point::new(x, y);
        let places = [vec![at(0.0, 0.0), at(2.0, 1.0)], vec![at(5.0, 0.0)], vec![], vec![at(0.0, 6.0), at(6.0, 7.0)]];
        let rects = rectangles(&places);
        assert!(rects[2].is_none());
        for (room, rect) in rects.iter().enumerate() {
            for (other, places) in places.iter().enumerate() {
                let inside = |place: &Point| rect.is_some_and(|rect| rect.has(*place));
                assert!(places.iter().all(|place| inside(place) == (room == other)), "{room} and {other}");
            }
        }
    }
}
