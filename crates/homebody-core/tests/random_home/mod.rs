//! Random homes, and random movements in them. The same number always gives the same home.

use homebody_core::event::{ThingUse, Vitals};
use homebody_core::geometry::Point;
use homebody_core::home::Home;
use homebody_core::home::form::HomeFile;
use homebody_core::ids::ThingId;
use homebody_core::motion::{MotionSegment, MotionState};
use homebody_core::posture::Posture;
use homebody_core::random::{SpanRange, Stream};
use homebody_core::resident::Build;
use homebody_core::time::{RunTime, SECOND, Span};
use serde_json::{Value, json};

/// A source of choices.
pub struct Dice(Stream);

impl Dice {
    pub fn new(case: u64, what: &str) -> Dice {
        Dice(Stream::named(case, what))
    }

    /// A whole number from 0 to `count` - 1.
    pub fn below(&mut self, count: i64) -> i64 {
        self.0.span(SpanRange { least: Span::ZERO, most: Span::from_micros(count - 1) }).micros()
    }

    /// An instant of a run of this length.
    pub fn instant(&mut self, length: Span) -> RunTime {
        RunTime::from_micros(self.below(length.micros()))
    }

    /// A number between `least` and `most`, in steps of a ten-thousandth of their difference.
    pub fn between(&mut self, least: f64, most: f64) -> f64 {
        least + (most - least) * self.below(10_001) as f64 / 10_000.0
    }

    pub fn one_in(&mut self, count: i64) -> bool {
        self.below(count) == 0
    }
}

/// The part of the model that a random home uses.
#[allow(dead_code, reason = "each test that shares this file uses a part of it")]
#[derive(Clone, Copy, PartialEq)]
pub enum Model {
    /// The part of the paper's own loop: `paper` sensors, furniture that is as high as they hang.
    Paper,
    /// Everything.
    Whole,
}

/// A rectangle cut into rooms, with furniture and sensors; of whole models one in fifty has more sensors than a mask has bits.
#[allow(dead_code, reason = "each test that shares this file uses a part of it")]
pub fn home(case: u64, model: Model) -> HomeFile {
    let is_crowded = model == Model::Whole && case % 50 == 7;
    crowded(case, model, if is_crowded { 130 + Dice::new(case, "how crowded").below(100) } else { 0 })
}

/// Such a home with so many sensors more, which look for movement. They come after the others that do.
pub fn crowded(case: u64, model: Model, more: i64) -> HomeFile {
    let dice = &mut Dice::new(case, "home");
    let (width, depth) = (dice.between(4.0, 12.0), dice.between(3.0, 9.0));
    let cut = dice.between(0.3, 0.7) * width;
    let rooms = json!([
        { "name": "west", "outline": [[0, 0], [cut, 0], [cut, depth], [0, depth]] },
        { "name": "east", "outline": [[cut, 0], [width, 0], [width, depth], [cut, depth]] },
    ]);
    let walls = json!([
        { "from": [0, 0], "to": [width, 0] }, { "from": [width, 0], "to": [width, depth] },
        { "from": [width, depth], "to": [0, depth] }, { "from": [0, depth], "to": [0, 0] },
        { "from": [cut, 0], "to": [cut, depth], "thickness_m": 0.15 },
    ]);
    let jamb = dice.between(0.1, depth - 1.0);
    let doors = json!([{ "name": "door", "from": [cut, jamb], "to": [cut, jamb + 0.9], "open": !dice.one_in(4) }]);
    let mut furniture: Vec<Value> = (0..dice.below(6))
        .map(|index| {
            json!({
                "name": format!("piece {index}"), "at": [dice.between(0.5, width - 0.5), dice.between(0.5, depth - 0.5)],
                "size_m": [dice.between(0.2, 1.5), dice.between(0.2, 1.0)], "turn_deg": dice.between(-90.0, 90.0),
                "height_m": if model == Model::Paper { 3.0 } else { dice.between(0.3, 2.4) },
                "enterable": dice.one_in(3),
            })
        })
        .collect();
    let mut sensors: Vec<Value> =
        (0..1 + dice.below(6)).map(|index| sensor(dice, index, width, depth, model)).collect();
    let crowd = &mut Dice::new(case, "crowd");
    sensors.extend((0..more).map(|index| sensor(crowd, 1000 + index, width, depth, model)));
    if model == Model::Whole {
        let dice = &mut Dice::new(case, "devices");
        let (x, y) = (dice.between(1.0, width - 1.0), dice.between(1.0, depth - 1.0));
        furniture.push(json!({ "name": "bed", "at": [x, y], "size_m": [dice.between(1.0, 4.0), 2], "height_m": 0.5,
            "turn_deg": dice.between(-90.0, 90.0), "enterable": true }));
        furniture.push(json!({ "name": "rug", "at": [width / 2.0, depth / 2.0], "size_m": [1.5, 1], "height_m": 0.01,
            "turn_deg": dice.between(-90.0, 90.0), "enterable": true }));
        sensors.extend((0..dice.below(12)).map(|index| device(dice, index, width, depth)));
        let dice = &mut Dice::new(case, "cameras");
        if dice.one_in(3) {
            sensors.push(camera(dice));
        }
    }
    let home = json!({ "name": format!("home {case}"), "rooms": rooms, "walls": walls, "doors": doors,
        "furniture": furniture, "sensors": sensors });
    serde_json::from_value(home).expect("a home")
}

fn sensor(dice: &mut Dice, index: i64, width: f64, depth: f64, model: Model) -> Value {
    let timing = match dice.below(3) {
        // No randomness, and times that tie with those of strides.
        0 => json!({ "first_fire_s": [1, 1], "refire_s": [6, 6], "persist_s": 1 }),
        1 => json!({ "preset": (["paper", "casas_pulse", "casas_follow", "x10_ms16a"][dice.below(4) as usize]) }),
        _ => json!({ "first_fire_s": [0, dice.between(0.0, 1.0)], "refire_s": [1.5, 1.5 + dice.between(0.0, 3.0)] }),
    };
    let mut sensor = if dice.one_in(4) {
        let (x, y) = (dice.between(0.3, width - 1.5), dice.between(0.3, depth - 1.5));
        let (dx, dy) = (dice.between(0.3, 1.2), dice.between(0.3, 1.2));
        json!({ "kind": "ceiling_motion", "area": [[x, y], [x + dx, y], [x + dx, y + dy], [x, y + dy]] })
    } else {
        let level = match (model, dice.below(3)) {
            (Model::Paper, _) | (_, 0) => json!("paper"),
            (_, 1) => json!({ "sensitivity": { "threshold_deg": dice.between(1.0, 12.0) } }),
            _ => json!({ "zones": { "pulses": 1 + dice.below(3) } }),
        };
        let (at, facing) = match dice.below(4) {
            0 => ([0.05, dice.between(0.2, depth - 0.2)], 0.0),
            1 => ([width - 0.05, dice.between(0.2, depth - 0.2)], 180.0),
            2 => ([dice.between(0.2, width - 0.2), 0.05], 90.0),
            _ => ([dice.between(0.2, width - 0.2), depth - 0.05], -90.0),
        };
        json!({ "kind": "motion", "at": at, "facing_deg": facing + dice.between(-15.0, 15.0), "level": level,
            "beams": 1 + dice.below(32), "height_m": dice.between(1.5, 2.4), "reach_m": dice.between(2.0, 12.0) })
    };
    let fields = sensor.as_object_mut().expect("an object");
    fields.insert("name".into(), json!(format!("sensor {index}")));
    if model != Model::Whole {
        fields.insert("notice".into(), json!("all"));
    }
    fields.extend(timing.as_object().expect("an object").clone());
    sensor
}

/// A device on any of the things that every home has. Its times tie with those of movements.
pub fn device(dice: &mut Dice, index: i64, width: f64, depth: f64) -> Value {
    let thing = ["door", "bed", "rug", "west"][dice.below(4) as usize];
    let often = [1.0, 2.5, 7.3][dice.below(3) as usize];
    let delay = if dice.one_in(2) { 0.0 } else { 0.5 };
    let mut device = match dice.below(9) {
        0 => json!({ "kind": "contact", "on": thing }),
        1 | 2 => json!({ "kind": "bed", "on": "bed", "levels_s": [delay, 1, 1.5, 4], "vitals_every_s": often,
            "still_s": delay }),
        3 => json!({ "kind": "stove_temperature", "on": thing, "hot_c": 1000, "on_above_c": 150,
            "off_below_c": 149, "readings_every_s": often }),
        4 => json!({ "kind": "pressure", "on": (["bed", "rug"][dice.below(2) as usize]), "delay_s": delay }),
        5 => {
            let (x, y) = (dice.between(0.0, width - 2.0), dice.between(0.0, depth - 2.0));
            json!({ "kind": "pressure", "area": [[x, y], [x + 2.0, y], [x + 2.0, y + 2.0]], "delay_s": delay })
        }
        6 => json!({ "kind": "power", "on": thing, "watts": 60, "readings_every_s": often }),
        7 if dice.one_in(2) => json!({ "kind": "flow", "on": thing, "runs_s": often }),
        7 => json!({ "kind": "flow", "on": thing }),
        _ if dice.one_in(2) => json!({ "kind": "light", "room": "west", "every_s": often }),
        _ => json!({ "kind": "temperature", "room": "east", "step_c": 0.02, "every_s": often }),
    };
    device.as_object_mut().expect("an object").insert("name".into(), json!(format!("device {index}")));
    device
}

/// A small camera in a corner of the western room, which the first sensor wakes.
fn camera(dice: &mut Dice) -> Value {
    json!({ "kind": "camera", "name": "camera", "at": [dice.between(0.1, 0.4), dice.between(0.1, 0.4)],
        "facing_deg": dice.between(20.0, 70.0), "tilt_deg": dice.between(20.0, 40.0), "field_deg": dice.between(60.0, 110.0),
        "height_m": dice.between(1.8, 2.4), "pixels": [32, 24], "frames_per_s": 2,
        "woken_by": ["sensor 0"], "sleeps_after_s": dice.between(1.0, 8.0) })
}

/// The uses and vitals of one resident, many at round times.
#[allow(dead_code, reason = "each test that shares this file uses a part of it")]
pub fn doings(case: u64, resident: usize, home: &Home, length: Span) -> Vec<(RunTime, Done)> {
    let dice = &mut Dice::new(case, &format!("doings of {resident}"));
    let mut doings = Vec::new();
    for _ in 0..dice.below(60) {
        let at = dice.instant(length);
        let at = if dice.one_in(2) { RunTime::START + at.since_zero() / (SECOND / 2) * (SECOND / 2) } else { at };
        let done = if dice.one_in(4) {
            Done::Vitals(Vitals { pulse: dice.between(20.0, 120.0), respiration: dice.between(2.0, 40.0) })
        } else {
            // Of all things those that sensors are on, as a rule.
            let name = ["door", "bed", "rug", "west", "piece 0"][dice.below(5) as usize];
            Done::Use(ThingUse { thing: ThingId::new(home.plan.thing(name).unwrap_or(0)), on: dice.one_in(2) })
        };
        doings.push((at, done));
    }
    doings.sort_by_key(|&(at, _)| at);
    doings
}

/// An act without duration.
#[allow(dead_code, reason = "each test that shares this file uses a part of it")]
#[derive(Clone, Copy)]
pub enum Done {
    Use(ThingUse),
    Vitals(Vitals),
}

/// The bodies of one to `most` residents.
pub fn builds(case: u64, most: i64) -> Vec<Build> {
    let dice = &mut Dice::new(case, "bodies");
    let build = |dice: &mut Dice| Build { radius_m: dice.between(0.1, 0.35), height_m: dice.between(0.3, 1.9) };
    (0..1 + dice.below(most)).map(|_| build(dice)).collect()
}

/// The movements of one resident for about `length`: walks, movements on the spot, rests, absences; many at round
/// times.
pub fn life(case: u64, resident: usize, home: &Home, length: Span, slowest_mps: f64) -> Vec<MotionSegment> {
    let dice = &mut Dice::new(case, &format!("life of {resident}"));
    let (least, most) = home.plan.bounds();
    let mut at = (least + most) / 2.0;
    let mut moves = Vec::new();
    let mut now = RunTime::START;
    while now < RunTime::START + length {
        let round = dice.one_in(2);
        let span = |span: f64| -> Span {
            let span = Span::from_micros((span * SECOND.micros() as f64) as i64);
            if round { (span / (SECOND / 2) + 1) * (SECOND / 2) } else { span + Span::MICROSECOND }
        };
        let posture = [Posture::Standing, Posture::Sitting, Posture::Lying][dice.below(3) as usize];
        let (took, doing, posture) = match dice.below(8) {
            0 => (span(dice.between(0.0, 20.0)), MotionState::Rest { at }, posture),
            1 | 2 => (
                span(dice.between(0.0, 9.0)),
                MotionState::InPlace { at, amplitude_m: dice.between(0.01, 0.6) },
                posture,
            ),
            3 if dice.one_in(8) => (span(30.0), MotionState::Away, Posture::Standing),
            _ => {
                let to = Point::new(dice.between(least.x, most.x), dice.between(least.y, most.y));
                let pace = dice.between(slowest_mps, 2.5);
                (span(at.distance(to) / pace), MotionState::Stride { from: at, to }, Posture::Standing)
            }
        };
        moves.push(MotionSegment { begin: now, end: now + took, doing, posture });
        if let MotionState::Stride { to, .. } = doing {
            at = to;
        }
        now += took;
    }
    moves
}
