//! The input of a script: the surroundings at an instant, and its random streams.

use crate::cast::Cast;
use crate::messages::ScriptMessage;
use crate::step::ScriptStep;
use homebody_core::drivers::Surroundings;
use homebody_core::geometry::Point;
use homebody_core::nearest::nearest;
use homebody_core::plan::Plan;
use homebody_core::posture::Posture;
use homebody_core::problem::{Advice, Diagnostic};
use homebody_core::random::Stream;
use homebody_core::time::{RunTime, Span};
use homebody_walk::manner::Manner;
use homebody_walk::places::HomePlace;
use rhai::{Dynamic, EvalAltResult, Map, Position};
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

pub type Streams = BTreeMap<String, Stream>;

/// Largest number of streams of a resident's script (our choice).
const MOST_STREAMS: usize = 1_000;

/// Longest step, in seconds (our choice): a hundred years.
const LONGEST_S: f64 = 100.0 * 365.25 * 86_400.0;

/// Shortest duration of a step (our choice): more frequent decisions change nothing that a sensor detects.
pub const SHORTEST_S: f64 = 0.1;

/// Distance that a script can look ahead for obstacles, in metres (our choice).
pub const LOOKS_M: f64 = 5.0;

pub type Constants = Arc<BTreeMap<String, Dynamic>>;

/// A message of Homebody, raised at the call.
pub type ScriptError = Box<EvalAltResult>;

/// The position is added later.
pub fn wrong(message: ScriptMessage) -> ScriptError {
    EvalAltResult::ErrorRuntime(Dynamic::from(Diagnostic::from(message)), Position::NONE).into()
}

/// `around` of scripts. Copies share the moment, which ends once the script has decided.
#[derive(Clone)]
pub struct Around(Arc<Mutex<ScriptMoment>>);

pub struct ScriptMoment {
    pub cast: Arc<Cast>,
    pub constants: Constants,
    pub now: RunTime,
    /// `None` while the resident is out.
    pub body: Option<(Point, Posture)>,
    pub place: String,
    /// At home.
    pub others: Vec<OtherResident>,
    /// By thing of the plan.
    pub on: Vec<bool>,
    pub streams: Streams,
}

#[derive(Clone, Debug, PartialEq)]
pub struct OtherResident {
    pub index: usize,
    pub at: Point,
    pub posture: Posture,
}

impl Around {
    pub fn new(moment: ScriptMoment) -> Around {
        Around(Arc::new(Mutex::new(moment)))
    }

    pub fn moment(&self) -> MutexGuard<'_, ScriptMoment> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl ScriptMoment {
    pub fn new(
        cast: Arc<Cast>,
        constants: Constants,
        around: &Surroundings,
        place: &str,
        streams: Streams,
    ) -> ScriptMoment {
        let others = around.others();
        let other = |body: homebody_core::drivers::PlacedBody| OtherResident {
            index: body.resident.index(),
            at: body.at,
            posture: body.posture,
        };
        ScriptMoment {
            now: around.now(),
            body: around.body().map(|body| (body.at, body.posture)),
            place: place.into(),
            others: others.map(other).collect(),
            on: (0..cast.home.plan.things.len() as u32)
                .map(|thing| around.is_on(homebody_core::ids::ThingId(thing)))
                .collect(),
            streams,
            constants,
            cast,
        }
    }

    fn plan(&self) -> &Plan {
        &self.cast.home.plan
    }

    fn room_name(&self, at: Point) -> String {
        self.plan().room_at(at).map(|room| self.plan().rooms[room].name.clone()).unwrap_or_default()
    }

    pub fn room(&self) -> String {
        self.body.map(|(at, _)| self.room_name(at)).unwrap_or_default()
    }

    pub fn posture(&self) -> &'static str {
        self.body.map_or("out", |(_, posture)| posture.name())
    }

    pub fn hour(&self) -> f64 {
        self.cast.hour(self.now)
    }

    pub fn day(&self) -> i64 {
        self.cast.calendar.day(self.now).into()
    }

    pub fn weekday(&self) -> &'static str {
        const DAYS: [&str; 7] = ["Monday", "Tuesday", "Wednesday", "Thursday", "Friday", "Saturday", "Sunday"];
        DAYS[usize::from(self.cast.calendar.weekday(self.cast.calendar.day(self.now))) % 7]
    }

    pub fn is_dark(&self) -> bool {
        self.cast.home.is_dark(self.now)
    }

    pub fn now_s(&self) -> f64 {
        self.now.seconds()
    }

    /// The origin while the resident is out.
    pub fn at(&self) -> Point {
        self.body.map_or(Point::ZERO, |(at, _)| at)
    }

    pub fn others(&self) -> Vec<Dynamic> {
        let other = |other: &OtherResident| {
            let name = self.cast.names.get(other.index).cloned().unwrap_or_default();
            let map: Map = [
                ("name", Dynamic::from(name)),
                ("room", self.room_name(other.at).into()),
                ("posture", Dynamic::from(other.posture.name().to_owned())),
                ("x", other.at.x.into()),
                ("y", other.at.y.into()),
                ("distance", self.at().distance(other.at).into()),
            ]
            .into_iter()
            .map(|(name, value)| (name.into(), value))
            .collect();
            Dynamic::from(map)
        };
        self.others.iter().map(other).collect()
    }

    pub fn who(&self, room: &str) -> Result<Vec<Dynamic>, ScriptError> {
        let room = self.room_named(room)?;
        let there = self.others.iter().filter(|other| self.plan().room_at(other.at) == Some(room));
        Ok(there.map(|other| Dynamic::from(self.cast.names.get(other.index).cloned().unwrap_or_default())).collect())
    }

    fn room_named(&self, name: &str) -> Result<usize, ScriptError> {
        let rooms = || self.plan().rooms.iter();
        let room = rooms().position(|room| room.name.eq_ignore_ascii_case(name));
        room.ok_or_else(|| unknown("room", name, rooms().map(|room| room.name.as_str())))
    }

    pub fn thing(&self, name: &str) -> Result<u32, ScriptError> {
        let thing = self.cast.places.thing_named(name);
        thing.ok_or_else(|| unknown("thing", name, self.plan().things.iter().map(|thing| thing.name.as_str())))
    }

    pub fn is_on(&self, name: &str) -> Result<bool, ScriptError> {
        Ok(self.on[self.thing(name)? as usize])
    }

    pub fn is_light(&self, room: &str) -> Result<bool, ScriptError> {
        let room = self.room_named(room)?;
        Ok(!self.is_dark() || self.on[self.cast.places.lamp(room) as usize])
    }

    pub fn spot(&self, name: &str) -> Result<HomePlace, ScriptError> {
        if let Some(spot) = self.cast.places.named(name) {
            return Ok(spot.clone());
        }
        let rooms = self.plan().rooms.iter().map(|room| room.name.as_str());
        let known = self.plan().places.iter().map(|(name, _)| name.as_str());
        let things = self.plan().things.iter().map(|thing| thing.name.as_str());
        Err(unknown("place", name, known.chain(things).chain(rooms)))
    }

    pub fn seat(&self, name: &str, posture: Posture) -> Result<ScriptStep, ScriptError> {
        let spot = self.spot(name)?;
        if spot.posture == Posture::Standing {
            return Err(wrong(ScriptMessage::NotASeat { verb: verb(posture).to_owned(), place: name.to_owned() }));
        }
        Ok(ScriptStep::Go(HomePlace { posture, ..spot }))
    }

    pub fn distance(&self, place: &str) -> Result<f64, ScriptError> {
        Ok(self.spot(place)?.at.distance(self.at()))
    }

    pub fn can_reach(&self, place: &str) -> Result<bool, ScriptError> {
        let to = self.spot(place)?.at;
        Ok(self.body.is_some_and(|(at, _)| self.cast.mesh.can_reach(at, to)))
    }

    pub fn toward(&self, place: &str) -> Result<f64, ScriptError> {
        let (at, to) = (self.at(), self.spot(place)?.at);
        let path = self.body.and_then(|_| self.cast.mesh.path(at, to)).unwrap_or_default();
        let corner = path.into_iter().find(|corner| corner.distance(at) > 0.05).unwrap_or(to);
        let ahead = corner - at;
        Ok(libm::atan2(ahead.y, ahead.x).to_degrees().rem_euclid(360.0))
    }

    pub fn free(&self, degrees: f64) -> f64 {
        self.body.map_or(0.0, |(at, _)| self.cast.mesh.free_way(at, degrees, LOOKS_M))
    }

    /// A stream of this script alone.
    pub fn stream(&mut self, name: &str) -> Result<&mut Stream, ScriptError> {
        if self.streams.len() >= MOST_STREAMS && !self.streams.contains_key(name) {
            return Err(wrong(ScriptMessage::TooManyStreams { most: MOST_STREAMS }));
        }
        let cast = &self.cast;
        Ok(self.streams.entry(name.into()).or_insert_with(|| cast.stream(name)))
    }
}

fn verb(posture: Posture) -> &'static str {
    if posture == Posture::Lying { "lie" } else { "sit" }
}

pub fn unknown<'a>(noun: &str, name: &str, known: impl Iterator<Item = &'a str>) -> ScriptError {
    wrong(unknown_name(noun, name, known))
}

pub fn unknown_name<'a>(noun: &str, name: &str, known: impl Iterator<Item = &'a str>) -> ScriptMessage {
    ScriptMessage::UnknownName { noun: noun.to_owned(), name: name.to_owned(), help: nearest_or_all(name, known) }
}

/// The nearest known name, or some of all names.
fn nearest_or_all<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> Advice {
    /// Largest number of names in a list (our choice).
    const LISTED: usize = 12;
    let known: Vec<&str> = known.collect();
    match nearest(name, known.iter().copied()) {
        Some(near) => Advice::meant(near),
        None => {
            let more = if known.len() > LISTED { " and more" } else { "" };
            format!("there are {}{more}", known.iter().take(LISTED).copied().collect::<Vec<_>>().join(", ")).into()
        }
    }
}

pub fn number(value: &Dynamic, what: &str) -> Result<f64, ScriptError> {
    let number = value.as_float().or_else(|_| value.as_int().map(|whole| whole as f64));
    let value = || what.to_owned();
    let number =
        number.map_err(|of| wrong(ScriptMessage::NotANumber { value: value(), found: type_name(of).to_owned() }))?;
    match number.is_finite() {
        true => Ok(number),
        false => Err(wrong(ScriptMessage::NotFinite { value: value(), number: number.to_string() })),
    }
}

pub fn span(value: &Dynamic) -> Result<Span, ScriptError> {
    let seconds = number(value, "the duration")?;
    if seconds <= 0.0 {
        return Err(wrong(ScriptMessage::Duration { duration_s: seconds }));
    }
    Ok(Span::from_seconds(seconds.clamp(SHORTEST_S, LONGEST_S)))
}

pub fn manner(name: &str) -> Result<Manner, ScriptError> {
    Manner::named(name).ok_or_else(|| wrong(unknown_manner(name)))
}

pub fn unknown_manner(name: &str) -> ScriptMessage {
    ScriptMessage::UnknownManner { name: name.to_owned(), help: nearest_or_all(name, Manner::names()) }
}

pub fn type_name(of: &str) -> &str {
    match of {
        "string" | "&str" => "text",
        "i64" | "f64" => "number",
        "bool" => "true or false",
        "()" => "nothing",
        "array" => "list",
        "map" => "map",
        "step" => "step",
        other => other,
    }
}
