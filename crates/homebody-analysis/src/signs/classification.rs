use super::evidence::{Classification, Evidence};
use super::meanings::{Meanings, OwnWords};
use super::names::{NamedKind, is_of_program, is_room_letter_place, is_seat, known_and_named};
use super::tally::SensorTally;
use homebody_core::languages::room_use;
use homebody_core::sensed::{Kind, Meaning, domain_of, meaning};
use homebody_log::{Log, SaidBy, SensorInfo};

/// In a home with motion sensors, more than one row of so many is theirs.
const FEWER: u64 = 10;

pub struct LogSensors {
    pub called: Vec<String>,
    pub kinds: Vec<Kind>,
}

impl LogSensors {
    pub fn from_log(log: &Log) -> LogSensors {
        LogSensors { called: log.called(), kinds: kinds(log) }
    }
}

pub fn kinds(log: &Log) -> Vec<Kind> {
    taken(log).into_iter().map(|taken| taken.kind).collect()
}

pub fn taken(log: &Log) -> Vec<Classification> {
    let meanings = Meanings::from_log(log);
    let mut tallies = vec![SensorTally::default(); log.sensors.len()];
    for event in log.in_order() {
        let Some((says, is_number)) = meanings.said(event) else { continue };
        tallies[event.sensor as usize].take(event.at, says, is_number, &log.gaps);
    }
    Beforehand::from_log(log).taken(&tallies.iter().collect::<Vec<_>>())
}

/// The names, kinds and units of the sensors of a log, each looked up once.
pub struct Beforehand {
    sensors: Vec<SensorDescription>,
    own: OwnWords,
}

impl Beforehand {
    pub fn from_log(log: &Log) -> Beforehand {
        Beforehand {
            sensors: log.sensors.iter().map(|id| SensorDescription::from_log(log, id)).collect(),
            own: OwnWords::from_log(log),
        }
    }

    pub fn taken(&self, tallies: &[&SensorTally]) -> Vec<Classification> {
        let sensors: Vec<SensorEvidence> =
            self.sensors.iter().zip(tallies).map(|(known, tally)| SensorEvidence { known, tally }).collect();
        taken_by(&sensors, &self.own)
    }
}

fn taken_by(sensors: &[SensorEvidence], own: &OwnWords) -> Vec<Classification> {
    let sure: Vec<Option<Classification>> = sensors.iter().map(SensorEvidence::surely).collect();
    let says_motion = sure.iter().flatten().any(|taken| taken.kind == Kind::Motion);
    let mut all: Vec<Classification> =
        sure.into_iter().zip(sensors).map(|(sure, sensor)| sure.unwrap_or_else(|| sensor.guess(says_motion))).collect();
    // A sensor at a door or a fridge may be its contact.
    let may_look = |(sensor, taken): &(&SensorEvidence, &Classification)| {
        taken.kind == Kind::Motion && (taken.by < Evidence::Guess || !sensor.is_at_thing())
    };
    let looking: u64 = sensors.iter().zip(&all).filter(may_look).map(|(sensor, _)| sensor.tally.signs()).sum();
    if looking * FEWER < sensors.iter().map(|sensor| sensor.tally.signs()).sum() {
        for (sensor, taken) in sensors.iter().zip(&mut all) {
            if taken.kind == Kind::Motion && taken.by == Evidence::Guess {
                *taken = sensor.used();
            }
        }
    }
    for (sensor, taken) in all.iter_mut().enumerate() {
        if let Some(because) = own.because(sensor) {
            *taken = Classification::new(taken.kind, Evidence::Guess, format!("{}; {because}", taken.because));
        }
    }
    all
}

pub fn kind_in_home(kind: &str, gives_readings: bool) -> Kind {
    match meaning(kind, "") {
        Some(Meaning::Is(kind)) => kind,
        Some(Meaning::PresenceByName) => Kind::Motion,
        Some(Meaning::UseOrReading | Meaning::ReadingOnly) if gives_readings => Kind::Reading,
        Some(Meaning::UseOrReading | Meaning::ReadingOnly) | None => Kind::Used,
    }
}

/// A sensor by its name, its kind and its unit, without its rows.
struct SensorDescription {
    /// The source's word for its kind, after the evidence that the word is.
    kind: (Evidence, String),
    meaning: Option<Meaning>,
    /// The domain of its id, where only the id tells its kind.
    domain: Option<String>,
    unit: Option<String>,
    named: Option<(NamedKind, String)>,
    is_seat: bool,
    is_room_letter_place: bool,
    /// Its id is that of an entity of Home Assistant, and its name and room tell of no person: many are of programs.
    is_entity: bool,
    is_of_program: bool,
}

impl SensorDescription {
    fn from_log(log: &Log, id: &str) -> SensorDescription {
        let (known, named) = known_and_named(log, id);
        let (kind, said_by) = known.map_or(("", SaidBy::Source), |known| (known.kind.as_str(), known.said_by));
        let (by, of_id) = match said_by {
            SaidBy::Table => (Evidence::Table, ""),
            SaidBy::Home => (Evidence::Home, ""),
            SaidBy::Source => (Evidence::Source, id),
        };
        SensorDescription {
            kind: (by, kind.to_owned()),
            meaning: meaning(kind, of_id),
            domain: domain_of(of_id).map(str::to_owned),
            unit: known.and_then(|known| known.unit.clone()),
            named,
            is_seat: known.is_some_and(|known| is_seat(&known.name)) || is_seat(id),
            is_room_letter_place: is_room_letter_place(id),
            is_entity: domain_of(id).is_some(),
            is_of_program: domain_of(id).is_some_and(|domain| tells_of_no_person(known, id, domain)),
        }
    }
}

fn tells_of_no_person(known: Option<&SensorInfo>, id: &str, domain: &str) -> bool {
    let name = known.filter(|known| known.name != id).map_or(&id[domain.len() + 1..], |known| &known.name);
    let has_room = known.is_some_and(|known| known.room.is_some()) || room_use(name).is_some();
    !has_room || is_of_program(name)
}

struct SensorEvidence<'a> {
    known: &'a SensorDescription,
    tally: &'a SensorTally,
}

impl SensorEvidence<'_> {
    /// Its kind by any evidence but the time that it is on.
    fn surely(&self) -> Option<Classification> {
        self.by_its_kind().or_else(|| self.by_values()).or_else(|| self.by_name())
    }

    fn by_its_kind(&self) -> Option<Classification> {
        let (by, kind) = (self.known.kind.0, self.known.kind.1.as_str());
        let Some(kind_of) = self.known.meaning.and_then(|meaning| self.kind(meaning)) else {
            let is_reading = || self.tally.signs() == 0 || self.tally.says_numbers();
            let unit = self.known.unit.as_ref().filter(|_| is_reading())?;
            return Some(Classification::new(Kind::Reading, by, format!("its unit {unit}")));
        };
        // A source may name a reading after what it belongs to; what a person writes holds.
        if by != Evidence::Table && kind_of != Kind::Other && kind_of != Kind::Reading && self.tally.says_numbers() {
            return Some(self.reading());
        }
        let because = match by {
            Evidence::Table => format!("{kind:?} in the table of sensors beside the log"),
            Evidence::Home => format!("{kind:?} in its home"),
            _ if kind.is_empty() => {
                format!("its id begins with {}", self.known.domain.as_deref().unwrap_or_default())
            }
            _ => format!("{kind:?} in its source"),
        };
        Some(Classification::new(kind_of, by, because))
    }

    /// The kind of a meaning; `None` where its values do not fit.
    fn kind(&self, meaning: Meaning) -> Option<Kind> {
        match meaning {
            Meaning::Is(kind) => Some(kind),
            Meaning::PresenceByName if self.known.is_seat => Some(Kind::Used),
            Meaning::PresenceByName => Some(Kind::Motion),
            Meaning::UseOrReading if self.tally.says_numbers() => Some(Kind::Reading),
            Meaning::UseOrReading => Some(Kind::Used),
            Meaning::ReadingOnly => (self.tally.says_numbers() || self.tally.signs() == 0).then_some(Kind::Reading),
        }
    }

    fn by_values(&self) -> Option<Classification> {
        match () {
            () if self.tally.says_numbers() => Some(self.reading()),
            () if self.tally.signs() == 0 => {
                Some(Classification::new(Kind::Reading, Evidence::Values, "it says no word of sensors"))
            }
            // Some alarm systems say of a motion sensor that it is open.
            () if self.tally.says_open() && !matches!(self.known.named, Some((NamedKind::Motion, _))) => {
                Some(Classification::new(Kind::Contact, Evidence::Values, "it says OPEN and CLOSE"))
            }
            () => None,
        }
    }

    fn reading(&self) -> Classification {
        Classification::new(Kind::Reading, Evidence::Values, "it says numbers")
    }

    fn by_name(&self) -> Option<Classification> {
        let (named, word) = self.known.named.as_ref()?;
        let kind = match named {
            NamedKind::Motion => Kind::Motion,
            NamedKind::Contact => Kind::Contact,
            NamedKind::Thing => Kind::Used,
            NamedKind::Device => Kind::Other,
            NamedKind::Door | NamedKind::Seat | NamedKind::Place => return None,
        };
        Some(Classification::new(kind, Evidence::Name, format!("{word:?} in its name")))
    }

    /// It is at a door or a thing, and its rows show how long it is on.
    fn is_at_thing(&self) -> bool {
        let is_at = matches!(self.known.named, Some((NamedKind::Door | NamedKind::Seat | NamedKind::Place, _)));
        is_at && self.tally.has_spans()
    }

    /// Its kind by its name and by the time that it is on; `says_motion` if a sensor of the log is surely a motion sensor.
    fn guess(&self, says_motion: bool) -> Classification {
        let motion = |because: &str| Classification::new(Kind::Motion, Evidence::Guess, because);
        let Some((named, word)) = &self.known.named else {
            return match self.tally.says_words() {
                _ if self.known.is_of_program => Classification::new(
                    Kind::Other,
                    Evidence::Guess,
                    "no word of its name is of a room or a sensor of movement",
                ),
                true => {
                    Classification::new(Kind::Reading, Evidence::Guess, "most of what it says are no words of sensors")
                }
                false => motion("it says that something begins"),
            };
        };
        let is_as_brief = if *named == NamedKind::Seat { self.tally.is_brief() } else { self.tally.blinks() };
        let looks = match self.known.is_room_letter_place {
            true => self.tally.is_brief(),
            false => is_as_brief && !says_motion,
        };
        match named {
            // A log of a few rows may end while a door is open: another sensor with a word for motion shows how sensors are named.
            NamedKind::Door if self.tally.only_begins() && !says_motion && !self.known.is_entity => {
                motion("it says that something begins, and never that it ends")
            }
            _ if looks => motion(&format!("{word:?} in its name, and it is ON for moments")),
            _ => self.used(),
        }
    }

    /// Its kind unless it is a motion sensor: a contact at a door, or else a thing that is used.
    fn used(&self) -> Classification {
        match &self.known.named {
            Some((NamedKind::Door, word)) => {
                Classification::new(Kind::Contact, Evidence::Name, format!("{word:?} in its name"))
            }
            Some((_, word)) => Classification::new(Kind::Used, Evidence::Name, format!("{word:?} in its name")),
            None => Classification::new(
                Kind::Used,
                Evidence::Guess,
                "no sensor of the log is ON for moments, as motion sensors are",
            ),
        }
    }
}
