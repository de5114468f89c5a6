//! The bench scene: 10 x 9 m, 30 walls, 20 pieces of furniture, 12 wall sensors of 32 beams, 4 ceiling
//! areas; and the two schedules of one resident, `walk` and `day`.

use homebody_core::geometry::Point;
use homebody_core::home::form::HomeFile;
use homebody_core::motion::{MotionSegment, MotionState};
use homebody_core::plan::form::{FurnitureFile, PlaceFile, RoomFile, WallFile};
use homebody_core::posture::Posture;
use homebody_core::random::{SpanRange, Stream};
use homebody_core::sensors::kinds::SensorFile;
use homebody_core::time::{HOUR, RunTime, SECOND, Span};
use serde_json::json;

/// Three by three rooms, each door open.
pub fn home() -> HomeFile {
    let (xs, ys) = ([0.0, 3.5, 7.0, 10.0], [0.0, 3.0, 6.0, 9.0]);
    let mut home = HomeFile {
        schema: None,
        name: "bench scene".into(),
        latitude_deg: 38.95,
        about: String::new(),
        rooms: Vec::new(),
        walls: Vec::new(),
        doors: Vec::new(),
        furniture: Vec::new(),
        places: Vec::<PlaceFile>::new(),
        sensors: Vec::new(),
    };
    let wall = |from, to| WallFile { from, to, thickness_m: 0.1 };
    for row in 0..3 {
        for column in 0..3 {
            let (x0, x1, y0, y1) = (xs[column], xs[column + 1], ys[row], ys[row + 1]);
            let name = format!("room {row}{column}");
            home.rooms.push(RoomFile::new(name, vec![[x0, y0], [x1, y0], [x1, y1], [x0, y1]]));
            // The wall below and the wall to the left; inner ones have a door of 0.9 m in the middle.
            for (from, to, inner) in [([x0, y0], [x1, y0], row > 0), ([x0, y0], [x0, y1], column > 0)] {
                home.walls.push(wall(from, to));
                if inner {
                    let middle = [(from[0] + to[0]) / 2.0, (from[1] + to[1]) / 2.0];
                    let along = if from[0] == to[0] { [0.0, 0.45] } else { [0.45, 0.0] };
                    home.doors.push(
                        serde_json::from_value(json!({
                            "name": format!("door {}", home.doors.len()),
                            "from": [middle[0] - along[0], middle[1] - along[1]],
                            "to": [middle[0] + along[0], middle[1] + along[1]],
                        }))
                        .expect("a door"),
                    );
                }
            }
            for (corner, size, height_m) in
                [([x0 + 0.5, y0 + 0.4], [0.8, 0.5], 0.75), ([x1 - 0.5, y1 - 0.4], [0.6, 0.6], 0.5)]
            {
                home.furniture.push(piece(home.furniture.len(), corner, size, height_m));
            }
        }
    }
    home.furniture.push(piece(18, [5.2, 0.4], [0.6, 0.6], 1.8));
    home.furniture.push(piece(19, [9.6, 4.5], [0.5, 1.2], 2.2));
    for row in 0..3 {
        home.walls.push(wall([10.0, ys[row]], [10.0, ys[row + 1]]));
        home.walls.push(wall([xs[row], 9.0], [xs[row + 1], 9.0]));
    }
    for index in 0..6 {
        let x = xs[index % 3] + 0.1;
        let y = ys[index / 2] + 2.4;
        home.walls.push(wall([x, y], [x + 0.4, y]));
    }
    for index in 0..12 {
        let (row, column) = ((index / 3) % 3, index % 3);
        let low = index < 9;
        let at = if low { [xs[column] + 0.05, ys[row] + 0.05] } else { [xs[column + 1] - 0.05, ys[row + 1] - 0.05] };
        home.sensors.push(sensor(json!({
            "kind": "motion", "name": format!("motion {index}"), "at": at, "facing_deg": if low { 45 } else { -135 },
        })));
    }
    for (index, [x, y]) in [[1.5, 1.5], [8.5, 1.5], [5.2, 4.5], [8.5, 7.5]].into_iter().enumerate() {
        sensor_area(&mut home, index, x, y);
    }
    home
}

fn sensor_area(home: &mut HomeFile, index: usize, x: f64, y: f64) {
    home.sensors.push(sensor(json!({
        "kind": "ceiling_motion", "name": format!("ceiling {index}"),
        "area": [[x - 0.5, y - 0.4], [x + 0.5, y - 0.4], [x + 0.5, y + 0.4], [x - 0.5, y + 0.4]],
    })));
}

fn sensor(value: serde_json::Value) -> SensorFile {
    serde_json::from_value(value).expect("a sensor")
}

fn piece(index: usize, at: [f64; 2], size_m: [f64; 2], height_m: f64) -> FurnitureFile {
    FurnitureFile {
        name: format!("piece {index}"),
        at: Some(at),
        size_m: Some(size_m),
        turn_deg: 0.0,
        outline: None,
        height_m,
        enterable: false,
        role: None,
    }
}

/// The movements of the resident.
pub type Schedule = Vec<MotionSegment>;

/// Always walking, through the doors from room to room, for `length`.
pub fn walk(length: Span) -> Schedule {
    let mut walker = Walker::new();
    while walker.now < RunTime::START + length {
        walker.walk();
    }
    walker.schedule
}

/// An ordinary day after the other: 12 hours awake with a stir of 2 s every 20 s and 4 % of the day
/// walking, in walks of about a minute; the rest asleep.
pub fn day(length: Span) -> Schedule {
    let mut walker = Walker::new();
    while walker.now < RunTime::START + length {
        walker.stay(12 * HOUR, None);
        // 48 walks of 72 s are 4 % of a day.
        for _ in 0..48 {
            let until = walker.now + 72 * SECOND;
            while walker.now < until {
                walker.walk();
            }
            walker.stay(828 * SECOND, Some(0.2));
        }
    }
    walker.schedule
}

struct Walker {
    schedule: Schedule,
    now: RunTime,
    at: Point,
    room: (i64, i64),
    stream: Stream,
}

impl Walker {
    fn new() -> Walker {
        let stream = Stream::named(1, "bench/walker");
        Walker { schedule: Vec::new(), now: RunTime::START, at: Point::new(1.75, 1.5), room: (0, 0), stream }
    }

    fn below(&mut self, count: i64) -> i64 {
        self.stream.span(SpanRange { least: Span::ZERO, most: Span::from_micros(count - 1) }).micros()
    }

    /// To a neighbouring room: to the door, through it, and to a point inside.
    fn walk(&mut self) {
        let (row, column) = self.room;
        let (dr, dc) = [(0, 1), (1, 0), (0, -1), (-1, 0)][self.below(4) as usize];
        let (row, column) = (row + dr, column + dc);
        if !(0..3).contains(&row) || !(0..3).contains(&column) {
            return;
        }
        let middle =
            |row: i64, column: i64| Point::new([1.75, 5.25, 8.5][column as usize], [1.5, 4.5, 7.5][row as usize]);
        let (here, there) = (middle(self.room.0, self.room.1), middle(row, column));
        let door = if dr == 0 {
            Point::new([3.5, 7.0][self.room.1.min(column) as usize], here.y)
        } else {
            Point::new(here.x, [3.0, 6.0][self.room.0.min(row) as usize])
        };
        let off = Point::new(self.below(1000) as f64 / 1000.0 - 0.5, self.below(1000) as f64 / 1000.0 - 0.5);
        self.stride(door);
        self.stride(there + off);
        self.room = (row, column);
    }

    fn stride(&mut self, to: Point) {
        let pace = 0.5 + self.below(500) as f64 / 1000.0;
        let micros = (self.at.distance(to) / pace * SECOND.micros() as f64) as i64;
        let end = self.now + Span::from_micros(micros + 1);
        self.push(end, MotionState::Stride { from: self.at, to }, Posture::Standing);
        self.at = to;
    }

    fn stay(&mut self, span: Span, amplitude_m: Option<f64>) {
        let (end, at) = (self.now + span, self.at);
        if let Some(amplitude_m) = amplitude_m {
            while self.now + 20 * SECOND <= end {
                self.push(self.now + 18 * SECOND, MotionState::Rest { at }, Posture::Sitting);
                self.push(self.now + 2 * SECOND, MotionState::InPlace { at, amplitude_m }, Posture::Sitting);
            }
        }
        if self.now < end {
            self.push(end, MotionState::Rest { at }, Posture::Sitting);
        }
    }

    fn push(&mut self, end: RunTime, doing: MotionState, posture: Posture) {
        self.schedule.push(MotionSegment { begin: self.now, end, doing, posture });
        self.now = end;
    }
}
