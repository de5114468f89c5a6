//! Locates people by a log in the plan of their home, and makes a scenario in which they walk the same way.

use crate::error::TrackingError;
use homebody_core::calendar::Calendar;
use homebody_core::drivers::path::form::PathFile;
use homebody_core::geometry::Point;
use homebody_core::problem::counted;
use homebody_core::resident::{DriverFile, ResidentFile};
use homebody_core::scenario::edit::text_of_path;
use homebody_core::scenario::load::Scenario;
use homebody_core::time::{DAY, HOUR, MINUTE, RunTime, Span, WallTime};
use homebody_infer::{
    FaultInterval, Guess, InstantEstimate, LogMessage, MessageKind, ResponseError, Senses, StateKind, Track,
    fault_intervals, translate,
};
use homebody_log::limits::LARGEST_OF_SCENARIO_BYTES;
use homebody_log::{Cancel, Event, Log};
use homebody_simulation::SimulationError;
use homebody_walk::Mesh;
use std::collections::BTreeMap;

#[derive(Debug)]
pub struct Translation {
    /// The calendar of its instants, which begin at midnight before the log's first row.
    pub calendar: Calendar,
    /// The residents, and last a guest if there is one resident.
    pub people: Vec<String>,
    /// The places of each person, in order of time.
    pub whereabouts: Vec<PersonStay>,
    /// The probabilities of the places, in order of time: only changes of [`LEAST_CHANGE`] or more.
    pub doubts: Vec<PlaceChance>,
    pub has_guest: bool,
    /// Sensors and the times in which they could not be believed.
    pub spells: Vec<(String, FaultInterval)>,
    /// By sensor of the log: its name in the home; its id where the home has no such sensor.
    pub names: Vec<String>,
    /// Ids of the log that the home lacks, with their rows.
    pub strangers: Vec<(String, u64)>,
    /// Sensors of the home that the log lacks.
    pub unheard: Vec<String>,
    /// The number of used rows, and of all rows.
    pub rows: [u64; 2],
    pub length: Span,
    /// The length of the paths: less if they are too long for a file.
    pub acted_out: Span,
    /// The files of a scenario in which everybody walks that way, by name, and the name of its own file.
    pub files: BTreeMap<String, String>,
    pub entry: String,
}

/// The place of a person from an instant on.
#[derive(Clone, Debug, PartialEq)]
pub struct PersonStay {
    /// The begin, since the translation's start.
    pub at: RunTime,
    pub who: usize,
    /// `None` between rooms and outside.
    pub room: Option<usize>,
    pub place: Option<Point>,
    /// Their movement there.
    pub kind: StateKind,
    pub chance: f64,
}

/// The probability of a place of a person, from an instant on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaceChance {
    pub at: RunTime,
    pub who: usize,
    pub place: PossiblePlace,
    /// From 0 to 1.
    pub chance: f32,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PossiblePlace {
    Out,
    /// At home but outside the rooms: in a doorway.
    Between,
    Room(usize),
}

/// Change of a probability below which it is not reported again (our choice).
pub const LEAST_CHANGE: f32 = 0.05;

const WALKED_BACK: &str = ", located";

/// Largest number of characters of a scenario's name, by its schema.
const LONGEST_NAME: usize = 100;

/// The name of a person who is not a resident.
const GUEST: &str = "somebody else";

homebody_core::messages! {
    /// Problems with locating the residents of a log in a home.
    pub enum TranslationMessage in "locate" {
        /// Homebody locates the residents that the scenario names, with the size of their bodies and their pace.
        NoResidents error "no-residents" ("the scenario has no residents to locate")
            hint ("add a file to \"residents\" in scenario.json");
        /// To locate residents, Homebody first simulates how the sensors of the home answer to a body in each place. That was not possible.
        Unlearnable { why: String } error "unlearnable" ("cannot compute how the sensors of the home respond: {why}")
            hint ("run homebody check on the scenario");
        /// Residents are located by the rows of their sensors.
        NoRows error "no-rows" ("the log has no rows")
            hint ("name a log with rows of the home's sensors");
        /// The first row of the log is before or after all dates that Homebody can compute with, or the time zone of the scenario is not valid.
        Calendar { why: String } error "calendar" ("cannot read the dates of the log: {why}")
            hint ("check the dates in the log, and the time zone in scenario.json");
        /// Homebody recognises the sensors of a log by their names in the home, or by the ids in the logger's file:
        ///
        /// ```json
        /// "ids": { "bedroom motion": "M001" }
        /// ```
        OtherHome { ids: Vec<String> } error "other-home" ("no sensor of the log is a sensor of the home")
            hint ("the log has {ids}; write the id of each sensor of the home into \"ids\" in logger.json", ids = ids.join(", "));
    }
}

fn cannot(message: TranslationMessage) -> TrackingError {
    TrackingError::Translation(message.into())
}

/// The bodies that may be in a home with their names: its residents, and a guest if there is one resident.
pub(crate) fn bodies(scenario: &Scenario) -> Result<(Vec<Senses>, Vec<String>), TrackingError> {
    let learn = |body| {
        Senses::learn(scenario, body).map_err(|error| {
            cannot(match error {
                ResponseError::Nobody => TranslationMessage::NoResidents,
                error => TranslationMessage::Unlearnable { why: error.to_string() },
            })
        })
    };
    let mut bodies = (0..scenario.residents.len()).map(learn).collect::<Result<Vec<_>, _>>()?;
    let mut people: Vec<String> = scenario.residents.iter().map(|resident| resident.file.name.clone()).collect();
    if let [alone] = &bodies[..] {
        bodies.push(alone.for_visitor());
        people.push(GUEST.into());
    }
    Ok((bodies, people))
}

/// Walks a log back through the home of a scenario, which is only read. `progress` gets the share that is done, from 0 to 1.
///
/// The log's sensors are those whose names the home has, or whose ids its logger says.
pub fn locate(
    log: &Log,
    scenario: &Scenario,
    cancel: &Cancel,
    mut progress: impl FnMut(f64),
) -> Result<Translation, TrackingError> {
    let names: Vec<String> = scenario.home.placed_sensors().iter().map(|sensor| sensor.name.clone()).collect();
    let heard = HomeMessages::new(log, scenario, &names)?;
    let residents = scenario.residents.len();
    let (bodies, people) = bodies(scenario)?;
    // A person without further messages leaves soon.
    let messages = || heard.messages.iter().copied().take_while(|_| !cancel.is_cancelled());
    let ill = fault_intervals(messages(), names.len(), heard.end);
    let mut told = TrackRecorder::new(bodies.len());
    let length = heard.end.since_zero();
    translate(&bodies, &ill, messages(), heard.end, |instant| {
        told.take(&instant);
        progress(instant.at.since_zero().ratio(length.max(Span::MICROSECOND)));
    });
    if cancel.is_cancelled() {
        return Err(SimulationError::Cancelled.into());
    }
    let TrackRecorder { tracks, whereabouts, doubts, .. } = told;
    let has_guest = people.len() > residents && tracks[residents].is_ever_home();
    let (files, entry, acted_out) = acted_out(scenario, &tracks, &heard, has_guest)?;
    Ok(Translation {
        has_guest,
        people,
        whereabouts,
        doubts,
        spells: ill.into_iter().map(|spell| (names[spell.sensor].clone(), spell)).collect(),
        names: heard.names,
        strangers: heard.strangers,
        unheard: heard.unheard,
        rows: [heard.messages.len() as u64, log.events.len() as u64],
        length,
        calendar: heard.calendar,
        acted_out,
        files,
        entry,
    })
}

impl Translation {
    /// An instant on the clock on the wall, as logs have it.
    pub fn wall(&self, at: RunTime) -> WallTime {
        self.calendar.local(at).datetime().into()
    }

    /// Date and time on the wall, as logs write them.
    pub fn wall_clock(&self, at: RunTime) -> String {
        self.calendar.local(at).strftime("%Y-%m-%d %H:%M:%S%.6f").to_string()
    }

    /// The mismatches of the log and the home, in sentences.
    pub fn misfits(&self) -> Vec<String> {
        let mut said = misfits(self.rows, &self.strangers, &self.unheard);
        if self.acted_out < self.length {
            let days = self.acted_out / DAY;
            said.push(format!("a path has no room for all of it: the first {days} days are lived again"));
        }
        said
    }
}

/// The mismatches of a log and its home: the number of rows that were taken, and of all; ids that the home lacks, with their rows; sensors
/// of the home that the log lacks.
pub(crate) fn misfits([taken, all]: [u64; 2], strangers: &[(String, u64)], unheard: &[String]) -> Vec<String> {
    let mut said = Vec::new();
    let of_strangers: u64 = strangers.iter().map(|(_, rows)| rows).sum();
    if of_strangers > 0 {
        let ids: Vec<&str> = strangers.iter().take(5).map(|(id, _)| id.as_str()).collect();
        let more = if strangers.len() > ids.len() { " and others" } else { "" };
        let share = 100.0 * of_strangers as f64 / all.max(1) as f64;
        let ids = ids.join(", ");
        said.push(format!("{share:.1} % of the rows are of sensors that the home does not have: {ids}{more}"));
    }
    let numbers = all - taken - of_strangers;
    if numbers > 0 {
        let rows = counted(numbers as usize, "row", "rows");
        said.push(format!("{rows} with numbers say nothing of where anybody is"));
    }
    if !unheard.is_empty() {
        said.push(format!("nothing comes from {}", unheard.join(", ")));
    }
    said
}

/// Records the places of all people.
struct TrackRecorder {
    tracks: Vec<Track>,
    whereabouts: Vec<PersonStay>,
    /// By body: its last movement, and the place.
    last: Vec<Option<(StateKind, Option<Point>)>>,
    doubts: Vec<PlaceChance>,
    /// By body: the recorded chances of being out, between the rooms, and in each of them.
    chances: Vec<Vec<f32>>,
}

impl TrackRecorder {
    fn new(bodies: usize) -> TrackRecorder {
        TrackRecorder {
            tracks: vec![Track::default(); bodies],
            whereabouts: Vec::new(),
            last: vec![None; bodies],
            doubts: Vec::new(),
            chances: vec![Vec::new(); bodies],
        }
    }

    fn take(&mut self, instant: &InstantEstimate) {
        let bodies = self.tracks.len();
        let mut guesses = Vec::with_capacity(2 * bodies);
        instant.report(|guess, chances| {
            if guesses.len() < bodies {
                self.doubt(instant.at, guesses.len(), chances);
            }
            guesses.push(guess);
        });
        let mover = mover(instant, &guesses);
        for (who, guess) in guesses.iter().enumerate().take(bodies) {
            self.tracks[who].add(instant.at, guess, mover == Some(who));
            let (kind, place) = (guess.state.kind, guess.state.at);
            if self.last[who].replace((kind, place)) != Some((kind, place)) {
                let (at, room, chance) = (instant.at, guess.state.room, guess.chance);
                self.whereabouts.push(PersonStay { at, who, room, place, kind, chance });
            }
        }
    }

    /// Records changes in the chances of places.
    fn doubt(&mut self, at: RunTime, who: usize, chances: &[f32]) {
        let last = &mut self.chances[who];
        // Nobody has no rooms to be in.
        last.resize(last.len().max(chances.len()), 0.0);
        let rest = std::iter::repeat(&0.0);
        for (number, &chance) in chances.iter().chain(rest).take(last.len()).enumerate() {
            if (chance - last[number]).abs() < LEAST_CHANGE {
                continue;
            }
            last[number] = chance;
            let place = match number {
                0 => PossiblePlace::Out,
                1 => PossiblePlace::Between,
                room => PossiblePlace::Room(room - 2),
            };
            self.doubts.push(PlaceChance { at, who, place, chance });
        }
    }
}

/// The person whose movement a sensor most likely detected.
fn mover(instant: &InstantEstimate, guesses: &[Guess]) -> Option<usize> {
    instant.said.filter(|heard| heard.said == MessageKind::On)?;
    let best = guesses.iter().enumerate().max_by(|a, b| a.1.says.total_cmp(&b.1.says));
    best.filter(|(_, guess)| guess.says > 0.0).map(|(who, _)| who)
}

/// By sensor of a log: the index of the sensor of the home, by its name or by the id that the logger gives it.
pub fn sensors_of_home(log: &Log, scenario: &Scenario) -> Vec<Option<usize>> {
    let sensors = scenario.home.placed_sensors().iter().map(|sensor| &sensor.name).enumerate();
    let id = |name: &String| scenario.logger.ids.get(name).unwrap_or(name).to_lowercase();
    let known: BTreeMap<String, usize> =
        sensors.flat_map(|(number, name)| [(name.to_lowercase(), number), (id(name), number)]).collect();
    log.sensors.iter().map(|id| known.get(&id.to_lowercase()).copied()).collect()
}

/// A log as messages of a home's sensors.
pub(crate) struct HomeMessages {
    pub calendar: Calendar,
    /// The end of its last hour.
    pub end: RunTime,
    pub messages: Vec<LogMessage>,
    names: Vec<String>,
    pub strangers: Vec<(String, u64)>,
    pub unheard: Vec<String>,
}

impl HomeMessages {
    pub fn new(log: &Log, scenario: &Scenario, names: &[String]) -> Result<HomeMessages, TrackingError> {
        let sensor_of = sensors_of_home(log, scenario);
        let mut rows = vec![0u64; log.sensors.len()];
        log.events.iter().for_each(|event| rows[event.sensor as usize] += 1);
        let strangers: Vec<(String, u64)> = (0..log.sensors.len())
            .filter(|&sensor| sensor_of[sensor].is_none())
            .map(|sensor| (log.sensors[sensor].clone(), rows[sensor]))
            .collect();
        let first = log.events.iter().map(|event| event.at).min().ok_or_else(|| cannot(TranslationMessage::NoRows))?;
        let zone = &scenario.file.time_zone;
        let calendar = Calendar::new(&first.date().to_string(), zone)
            .map_err(|error| cannot(TranslationMessage::Calendar { why: error.to_string() }))?;
        let mut wall = WallReader { calendar: &calendar, midnight: first - first.time_of_day(), last: RunTime::START };
        let said: Vec<Option<MessageKind>> = log.values.iter().map(|value| MessageKind::from_value(value)).collect();
        let message = |event: &Event| {
            let (sensor, said) = (sensor_of[event.sensor as usize]?, said[event.value as usize]?);
            Some(LogMessage { at: wall.instant(event.at), sensor, said })
        };
        let mut messages: Vec<LogMessage> = log.events.iter().filter_map(message).collect();
        if messages.is_empty() {
            let ids = strangers.iter().take(5).map(|(id, _)| id.clone()).collect();
            return Err(cannot(TranslationMessage::OtherHome { ids }));
        }
        messages.sort_by_key(|message| message.at);
        let is_heard = |number: usize| sensor_of.contains(&Some(number));
        let unheard =
            (0..names.len()).filter(|&number| !is_heard(number)).map(|number| names[number].clone()).collect();
        let end = |last: RunTime| RunTime::START + (last.since_zero() / HOUR + 1) * HOUR;
        let end = messages.last().map_or(RunTime::START, |last| end(last.at));
        let name =
            |sensor: usize| sensor_of[sensor].map_or_else(|| log.sensors[sensor].clone(), |of| names[of].clone());
        let names = (0..log.sensors.len()).map(name).collect();
        Ok(HomeMessages { calendar, end, messages, names, strangers, unheard })
    }
}

/// The clock on the wall, for the instants of a log.
struct WallReader<'a> {
    calendar: &'a Calendar,
    /// Midnight before the first row.
    midnight: WallTime,
    /// The previous instant.
    last: RunTime,
}

impl WallReader<'_> {
    /// The instant of a row after those before. If the clock goes back, the hour that comes twice is the second where time would run
    /// backward in the first.
    fn instant(&mut self, at: WallTime) -> RunTime {
        /// Largest delay of a row that does not indicate another hour (our choice).
        const LATE: Span = MINUTE.times(30);
        let since = at - self.midnight;
        let (day, time) = (i32::try_from(since.div_euclid(DAY)).unwrap_or(i32::MAX), since.rem_euclid(DAY));
        let first = self.calendar.instant(day, time);
        let is_twice = || self.calendar.local(first).datetime() == self.calendar.local(first + HOUR).datetime();
        let instant = if first < self.last - LATE && is_twice() { first + HOUR } else { first };
        self.last = instant;
        instant
    }
}

/// The files of the scenario in which residents, and a guest, walk their tracks.
fn acted_out(
    scenario: &Scenario,
    tracks: &[Track],
    heard: &HomeMessages,
    has_guest: bool,
) -> Result<(BTreeMap<String, String>, String, Span), TrackingError> {
    let begins = heard.calendar.local(RunTime::START);
    let mut length = heard.end.since_zero();
    let mut edit = scenario.edit().file(|file| {
        file.start = begins.strftime("%Y-%m-%dT%H:%M:%S").to_string();
        let own: String = file.name.chars().take(LONGEST_NAME - WALKED_BACK.len()).collect();
        file.name = format!("{}{WALKED_BACK}", own.trim_end());
    });
    let residents = scenario.residents.len();
    if has_guest {
        let file =
            ResidentFile { name: GUEST.into(), ..ResidentFile::with_driver(DriverFile::Path(PATH_OF_GUEST.into())) };
        edit = edit.add_resident("guest.json", file);
    }
    for (who, track) in tracks.iter().enumerate().take(residents + usize::from(has_guest)) {
        let body = scenario.residents.get(who).or(scenario.residents.first());
        let radius_m = body.map_or(0.2, |resident| resident.file.radius_m);
        let mesh = Mesh::with_numbers(scenario.home.plan(), radius_m, scenario.home.numbers());
        let (path, acted_out) = path_that_is_read(track, &mesh, heard.end);
        length = length.min(acted_out);
        let name = if who < residents { format!("walked-back-{}.path.json", who + 1) } else { PATH_OF_GUEST.into() };
        edit = edit.path(who, &name, &path);
    }
    let loaded = edit.file(|file| file.days = heard.calendar.days_lived(RunTime::START + length)).load()?;
    Ok((loaded.sources, loaded.entry, length))
}

/// The path of a track until `end`, and its length: as many whole days as its file has room for.
fn path_that_is_read(track: &Track, mesh: &Mesh, end: RunTime) -> (PathFile, Span) {
    let (mut path, mut length) = track.path(mesh, end);
    loop {
        let bytes = text_of_path(&path).len() as i64;
        let days = length / DAY * LARGEST_OF_SCENARIO_BYTES as i64 / bytes.max(1);
        if bytes <= LARGEST_OF_SCENARIO_BYTES as i64 || days == 0 {
            return (path, length);
        }
        (path, length) = track.path(mesh, RunTime::START + days * DAY);
    }
}

const PATH_OF_GUEST: &str = "walked-back-guest.path.json";
