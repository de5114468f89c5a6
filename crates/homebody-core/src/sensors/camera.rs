//! A camera that keeps silhouettes and nothing else.
//!
//! The device takes a picture now and then, subtracts the background, and keeps the pixels of people. It sleeps until
//! one of the sensors that it is tied to sends a message, and sleeps again once they have all been quiet for a while.
//!
//! We assume that it has learned its background in an empty home, that it takes its pictures at whole multiples of
//! their period since the run's start, so that several cameras take theirs together, and that it is awake at the next
//! of them.
//!
//! It gets the movements of bodies, and follows each in three dimensions ([`BodyTrack`]); a frame paints those that are
//! in view and disturbs the picture as a real background subtraction would. Its messages are that it woke, that it sees
//! a person, and that it sleeps. Pictures with a person are kept separately from the log.
//!
//! Left out: lenses that distort, darkness, moving the camera, what becomes of pictures on their way.

use super::entities::EntityRow;
use super::meaning::{Kind, Meaning};
use super::messages::SensorMessage;
use super::outbox::{Change, DeviceModel, Outbox};
use crate::body::figure::Figure;
use crate::body::track::{BodyTrack, Durations};
use crate::camera::lens::Lens;
use crate::camera::noise::{LIGHT_S, Noise};
use crate::camera::outlook::Outlook;
use crate::camera::painter::paint;
use crate::camera::scenery::Scenery;
use crate::camera::silhouette::{Picture, Silhouette};
use crate::event::{Trigger, Value};
use crate::geometry::At;
use crate::ids::{ResidentId, ThingId};
use crate::numbers::Numbers;
use crate::plan::sun::Sun;
use crate::random::{Marks, Stream};
use crate::sensors::form::{Colour, FormProblem, KindRow, Mount, Orientation, SensorForm, Shape, Site};
use crate::time::{RunTime, Span};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

crate::numbers! {
    /// Share of the picture below which a silhouette counts as noise.
    static LEAST_SHARE = "camera.least_share": 0.002, "1", [0.0, 0.5];
}

/// The row of the kind.
pub static ROW: KindRow = KindRow {
    key: "camera",
    label: "camera, silhouettes only",
    mount: Mount::Free,
    unit: None,
    values: &[Value::Woke, Value::Seen, Value::Slept],
    shape: Shape::Eye,
    colour: Colour::Purple,
    casas: "C",
    meaning: Meaning::Is(Kind::Used),
    entities: &[EntityRow::TEXT],
};

/// A camera that keeps silhouettes only. Its events are `WOKE`, `SEEN` and `SLEPT`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "camera")]
pub struct CameraFile {
    /// Name of the sensor, unique in the home. The log uses it unless `logger.json` gives another id.
    #[schemars(length(min = 1, max = 100))]
    pub name: String,
    /// Position seen from above: in a room, and not in a wall.
    #[schemars(inner(range(min = -10_000, max = 10_000)))]
    pub at: At,
    /// Height of the lens above the floor.
    #[serde(default = "mounting_height")]
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 10))]
    pub height_m: f64,
    /// Direction of the lens: 0 is east, 90 is north.
    #[schemars(range(min = -360, max = 360))]
    pub facing_deg: f64,
    /// Downward tilt of the lens axis. A positive angle looks down.
    #[serde(default = "tilt")]
    #[schemars(range(min = -90, max = 90))]
    pub tilt_deg: f64,
    /// Horizontal angle of view. The vertical one follows from the picture's shape.
    #[serde(default = "field")]
    #[schemars(range(min = 5, max = 150))]
    pub field_deg: f64,
    /// Columns and rows of a picture.
    #[serde(default = "pixels")]
    #[schemars(inner(range(min = 16, max = 640)))]
    pub pixels: [u32; 2],
    /// Number of pictures a second while the camera is awake.
    #[serde(default = "frames")]
    #[schemars(range(min = 0.1, max = 30))]
    pub frames_per_s: f64,
    /// Names of the sensors that wake the camera.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[schemars(length(max = 64))]
    pub woken_by: Vec<String>,
    /// Time from the last event of these sensors until the camera sleeps again.
    #[serde(default = "sleeps_after")]
    #[schemars(range(min = 0.1, max = 86_400))]
    pub sleeps_after_s: f64,
    /// Whether the camera never sleeps. No sensor wakes it then.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub always: bool,
}

super::form::usual! {
    /// Just below a ceiling of 2.4 m.
    fn mounting_height() -> f64 = 2.3;
    /// From 2.3 m its axis meets the floor after 4 m.
    fn tilt() -> f64 = 30.0;
    /// Of a common web camera.
    fn field() -> f64 = 75.0;
    fn pixels() -> [u32; 2] = [160, 120];
    /// The voxel person of Anderson et al. 2009 was made of about three a second.
    fn frames() -> f64 = 5.0;
    /// Ours.
    fn sleeps_after() -> f64 = 10.0;
}

impl CameraFile {
    /// The camera as it projects.
    pub fn lens(&self) -> Lens {
        let at = crate::geometry::point(self.at).extend(self.height_m);
        let [facing, tilt, field] = [self.facing_deg, self.tilt_deg, self.field_deg].map(f64::to_radians);
        Lens::new(at, facing, tilt, field, self.pixels)
    }

    /// From one picture to the next.
    pub fn period(&self) -> Span {
        Span::from_seconds(1.0 / self.frames_per_s).max(Span::MICROSECOND)
    }
}

impl SensorForm for CameraFile {
    fn spot(&self) -> Option<At> {
        Some(self.at)
    }

    fn orientation(&self) -> Option<Orientation> {
        let [columns, rows] = self.pixels.map(f64::from);
        let half_across = (self.field_deg / 2.0).to_radians();
        let down_deg = 2.0 * libm::atan(libm::tan(half_across) * rows / columns).to_degrees();
        let CameraFile { at, height_m, facing_deg, tilt_deg, .. } = *self;
        let field_deg = [self.field_deg, libm::round(down_deg * 100.0) / 100.0];
        Some(Orientation { at, height_m, facing_deg, tilt_deg, field_deg, reach_m: None })
    }

    fn woken_by(&self) -> &[String] {
        &self.woken_by
    }

    fn wrong(&self) -> Vec<FormProblem> {
        let mut wrong = Vec::new();
        if self.woken_by.is_empty() && !self.always {
            wrong.push(FormProblem::new("", SensorMessage::NeverWakes { camera: self.name.clone() }));
        }
        if !self.woken_by.is_empty() && self.always {
            wrong.push(FormProblem::new("/woken_by", SensorMessage::NeverSleeps { camera: self.name.clone() }));
        }
        wrong
    }
}

/// A camera.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    lens: Lens,
    period: Span,
    stays_awake: Span,
    always: bool,
    woken_by: Vec<String>,
    lamp: ThingId,
    outlook: Arc<Outlook>,
    /// Of a run that has begun.
    scenery: Option<Arc<Scenery>>,
    noise: Noise,
    marks: Marks,
    durations: Durations,
    light_lasts: Span,
    least_px: u32,
    bodies: Vec<BodyTrack>,
    /// The figures in its last picture, and that picture before the noise: a still body is painted once.
    painted: Option<(Vec<Figure>, Silhouette)>,
    /// Its next picture; `NEVER` while it sleeps.
    next: RunTime,
    awake_until: RunTime,
    sees: Option<ResidentId>,
    lit_until: RunTime,
}

impl Camera {
    /// A camera at a site.
    pub fn new(file: &CameraFile, site: &Site) -> Camera {
        let numbers = Numbers::default();
        Camera {
            lens: file.lens(),
            period: file.period(),
            stays_awake: Span::from_seconds(file.sleeps_after_s),
            always: file.always,
            woken_by: file.woken_by.clone(),
            lamp: site.thing,
            outlook: site.outlook.clone(),
            scenery: None,
            noise: Noise::NONE,
            marks: Marks::named(0, ""),
            durations: Durations::new(&numbers),
            light_lasts: Span::ZERO,
            least_px: 1,
            bodies: Vec::new(),
            painted: None,
            next: RunTime::NEVER,
            awake_until: RunTime::START,
            sees: None,
            lit_until: RunTime::START,
        }
    }

    fn picture_from(&self, at: RunTime) -> RunTime {
        RunTime::START + (at + self.period - Span::MICROSECOND).since_zero() / self.period * self.period
    }

    fn wake(&mut self, at: RunTime, outbox: &mut Outbox) {
        if self.next == RunTime::NEVER {
            outbox.send(Value::Woke, None, at, Trigger::Reading);
            self.next = self.picture_from(at);
        }
        self.awake_until = self.awake_until.max(at.saturating_add(self.stays_awake));
    }

    fn in_view(&self, at: RunTime) -> (Vec<ResidentId>, Vec<Figure>) {
        let near =
            |track: &&BodyTrack| track.place_at(at).is_some_and(|place| self.lens.may_see(place, track.reach_m()));
        let seen = self.bodies.iter().filter(near);
        seen.filter_map(|track| Some((track.resident(), track.figure_at(at)?))).unzip()
    }

    /// The picture of these figures, before the noise.
    fn painted(&mut self, figures: &[Figure], scenery: &Scenery) -> Silhouette {
        if let Some((_, picture)) = self.painted.as_ref().filter(|(last, _)| last == figures) {
            return picture.clone();
        }
        let mut picture = Silhouette::new(self.lens.columns, self.lens.rows);
        figures.iter().for_each(|figure| paint(figure, &self.lens, scenery, &mut picture));
        self.painted = Some((figures.to_vec(), picture.clone()));
        picture
    }

    /// Takes a picture. The first one with a person, or without, is a message.
    fn take(&mut self, at: RunTime, outbox: &mut Outbox) {
        let Some(scenery) = self.scenery.clone() else { return };
        let (residents, figures) = self.in_view(at);
        let lit = (self.lit_until - at).ratio(self.light_lasts.max(Span::MICROSECOND));
        if figures.is_empty() && lit <= 0.0 {
            self.sees = None;
            return;
        }
        let mut picture = self.painted(&figures, &scenery);
        if picture.area_px() == 0 && lit <= 0.0 {
            self.sees = None;
            return;
        }
        let frame = (at.since_zero() / self.period) as u64;
        self.noise.disturb(&mut picture, &figures, (&self.lens, &scenery), (self.marks, frame), lit.max(0.0));
        let Some(features) = picture.features().filter(|features| features.area_px >= self.least_px) else {
            self.sees = None;
            return;
        };
        let whose = residents.first().copied();
        if self.sees.is_none() {
            outbox.send(Value::Seen, whose, at, Trigger::Movement);
        }
        self.sees = whose;
        outbox.pictures.push(Picture { packed: picture.packed(), features });
    }
}

impl DeviceModel for Camera {
    fn begin(&self, stream: Stream, _sun: Sun, numbers: &Numbers) -> Camera {
        let pixels = f64::from(self.lens.columns * self.lens.rows);
        Camera {
            scenery: Some(Arc::new(Scenery::new(&self.lens, &self.outlook.prisms))),
            noise: Noise::new(numbers),
            marks: stream.marks(),
            durations: Durations::new(numbers),
            light_lasts: Span::from_seconds(numbers.of(&LIGHT_S)),
            least_px: (numbers.of(&LEAST_SHARE) * pixels).max(1.0) as u32,
            next: if self.always { RunTime::START } else { RunTime::NEVER },
            awake_until: if self.always { RunTime::NEVER } else { RunTime::START },
            ..self.clone()
        }
    }

    fn sees_bodies(&self) -> bool {
        true
    }

    fn woken_by(&self) -> &[String] {
        &self.woken_by
    }

    fn is_awake(&self) -> bool {
        self.next != RunTime::NEVER
    }

    fn on_event(&mut self, at: RunTime, change: &Change, outbox: &mut Outbox) {
        match *change {
            Change::Fired => self.wake(at, outbox),
            Change::Use { thing, .. } if thing == self.lamp => self.lit_until = at + self.light_lasts,
            Change::Use { .. } | Change::Vitals { .. } => {}
            Change::Body { resident, stature, ref segment, chance } => {
                let known = self.bodies.iter().position(|body| body.resident() == resident);
                let index = known.unwrap_or_else(|| {
                    self.bodies.push(BodyTrack::new(resident, stature, self.durations));
                    self.bodies.len() - 1
                });
                self.bodies[index].begin(at, segment, chance, &self.outlook.ground);
            }
        }
    }

    fn timer(&self) -> RunTime {
        self.next
    }

    fn on_timer(&mut self, at: RunTime, outbox: &mut Outbox) {
        if self.always && at == RunTime::START {
            outbox.send(Value::Woke, None, at, Trigger::Reading);
        }
        if at >= self.awake_until {
            (self.next, self.sees) = (RunTime::NEVER, None);
            outbox.send(Value::Slept, None, at, Trigger::Reading);
            return;
        }
        self.take(at, outbox);
        self.next = at + self.period;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::figure::Stature;
    use crate::geometry::Point;
    use crate::motion::{MotionSegment, MotionState};
    use crate::posture::Posture;
    use crate::time::SECOND;
    use serde_json::json;

    fn camera(more: serde_json::Value) -> Camera {
        let mut file = json!({ "name": "camera", "at": [0.1, 0.1], "facing_deg": 45 });
        file.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
        let file: CameraFile = serde_json::from_value(file).unwrap();
        assert_eq!(file.wrong(), Vec::new());
        Camera::new(&file, &Site { thing: ThingId(9), ..Site::default() }).begin(
            Stream::named(7, "camera"),
            Sun::default(),
            &Numbers::default(),
        )
    }

    fn stands(at: Point) -> Change {
        let doing = MotionState::Rest { at };
        Change::Body {
            resident: ResidentId(0),
            stature: Stature { radius_m: 0.2, height_m: 1.65 },
            segment: MotionSegment { begin: RunTime::START, end: RunTime::NEVER, doing, posture: Posture::Standing },
            chance: Marks::named(7, "bodies").of(0),
        }
    }

    fn at(seconds: i64) -> RunTime {
        RunTime::START + seconds * SECOND
    }

    /// Lives until an instant; what it says, and how many pictures it keeps.
    fn live(camera: &mut Camera, until: RunTime) -> (Vec<(RunTime, Value)>, usize) {
        let (mut said, mut pictures) = (Vec::new(), 0);
        while camera.timer() < until {
            let (at, mut outbox) = (camera.timer(), Outbox::default());
            camera.on_timer(at, &mut outbox);
            said.extend(outbox.messages.iter().map(|(value, _)| (at, *value)));
            pictures += outbox.pictures.len();
        }
        (said, pictures)
    }

    #[test]
    fn it_sleeps_until_a_sensor_fires_and_again_once_it_is_quiet() {
        let mut camera = camera(json!({ "woken_by": ["motion"], "sleeps_after_s": 2 }));
        camera.on_event(at(0), &stands(Point::new(2.0, 2.0)), &mut Outbox::default());
        assert_eq!(live(&mut camera, at(100)), (vec![], 0));
        let mut outbox = Outbox::default();
        camera.on_event(at(100) + Span::MICROSECOND, &Change::Fired, &mut outbox);
        camera.on_event(at(101), &Change::Fired, &mut outbox);
        assert_eq!(outbox.messages.iter().map(|(value, _)| *value).collect::<Vec<_>>(), [Value::Woke]);
        let (said, pictures) = live(&mut camera, at(200));
        // From 100.2 s to 102.8 s, five a second.
        assert_eq!(said, [(at(100) + SECOND / 5, Value::Seen), (at(103), Value::Slept)]);
        assert_eq!(pictures, 14);
    }

    #[test]
    fn a_camera_that_never_sleeps_sees_each_arrival_and_keeps_no_picture_of_an_empty_room() {
        let mut camera = camera(json!({ "always": true, "frames_per_s": 2 }));
        assert_eq!(live(&mut camera, at(10)), (vec![(at(0), Value::Woke)], 0));
        camera.on_event(at(10), &stands(Point::new(2.0, 2.0)), &mut Outbox::default());
        assert_eq!(live(&mut camera, at(15)), (vec![(at(10), Value::Seen)], 10));
        // A person behind it is not seen.
        camera.on_event(at(15), &stands(Point::new(-2.0, -2.0)), &mut Outbox::default());
        assert_eq!(live(&mut camera, at(20)).1, 0);
    }

    #[test]
    fn rejects_cameras_that_never_wake_or_never_sleep() {
        let wrong = |file: serde_json::Value| {
            let file: CameraFile = serde_json::from_value(file).unwrap();
            file.wrong().into_iter().map(|wrong| wrong.message.code).collect::<Vec<_>>()
        };
        let file = json!({ "name": "c", "at": [0, 0], "facing_deg": 0 });
        assert_eq!(wrong(file), ["sensor::camera-never-wakes"]);
        let both = json!({ "name": "c", "at": [0, 0], "facing_deg": 0, "woken_by": ["m"], "always": true });
        assert_eq!(wrong(both), ["sensor::camera-never-sleeps"]);
    }
}
