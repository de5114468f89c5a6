//! What measures are taken from, as a log tells it.

use super::company::company;
use super::known::Known;
use super::rooms::{Purpose, Rooms};
use super::signs::{Sign, agreed, signs};
use super::timeline::{Span, Stay, Timeline, joined, without};
use super::walking::{passages, walks};
use crate::dates::midnight;
use crate::density::{Absence, Asked, Map, NoMap};
use crate::signs::{Kind, LogSensors, says};
use homebody_core::names::words;
use homebody_core::time::{DAY, Micros, SECOND};
use homebody_log::Log;

const MINUTE: Micros = 60 * SECOND;

/// Who is in a bedroom and gives no sign for so long is in bed (ours); who is in bed and gives none for so long sleeps.
const LIES_STILL: Micros = 20 * MINUTE;
const SLEEPS: Micros = 5 * MINUTE;
/// Who is out of the bedroom for so long at night lies in bed before and after; who comes to bed is still after so long (ours).
const UP_AT_NIGHT: Micros = 30 * MINUTE;
const FALLS_ASLEEP: Micros = 40 * MINUTE;
/// Who leaves the bedroom so soon after a long silence got up as they left it (ours).
const WAKES: Micros = 30 * MINUTE;
/// Signs in bed farther apart than this are two bouts (ours).
const BOUT: Micros = 30 * SECOND;
/// Who is seen once in a room on the way to another is there for so long at most (ours).
const GLIMPSE: Micros = 5 * SECOND;
/// It is a glimpse, too, if several signs come within that time and the next one, of another room, no later than this (ours).
const SEEN_PASSING: Micros = 10 * SECOND;
/// Signs of a shower's own sensor no farther apart belong to one shower, which lasts at least so long (ours).
const SHOWER_APART: Micros = 3 * MINUTE;
const SHOWER_LASTS: Micros = 3 * MINUTE;
/// What is said to go on for longer has ended, and nobody heard of it (ours).
const SHOWER_LONGEST: Micros = 60 * MINUTE;
/// Where a shower has no sensor of its own, who stays in the bathroom for so long by day, with a sign every minute, showers (ours):
/// who sits on the toilet gives fewer.
const BATHROOM_LONG: Micros = 10 * MINUTE;
const BATHROOM_LIVELY: Micros = MINUTE;
/// Times in the kitchen no farther apart belong to one meal; for a meal somebody is there for so long (ours).
const MEAL_APART: Micros = 15 * MINUTE;
const MEAL_LASTS: Micros = 15 * MINUTE;
impl Timeline {
    /// As a log tells it. `known` is what a home tells; `asked` from when to when.
    ///
    /// # Errors
    ///
    /// Those of the log's density map.
    pub(super) fn heard(
        log: &Log,
        sensors: &LogSensors,
        known: &Known,
        asked: &Asked,
    ) -> Result<(Timeline, Map), NoMap> {
        let rooms = Rooms::of(&log.sensors, known.rooms);
        let told = || {
            let signs = signs(log, &sensors.kinds, &rooms);
            let seen: Vec<Sign> = signs.iter().filter(|sign| sign.is_seen).copied().collect();
            let walks = known.ways.and_then(|ways| walks(&seen, &log.sensors, ways));
            (agreed(&signs), passages(&seen), walks, 2 * seen.len() < signs.len(), signs)
        };
        // They know nothing of each other, and take as long.
        let (map, (agreed, passages, walks, is_unwatched, signs)) =
            rayon::join(|| Map::of_any("", log, sensors, asked), told);
        let map = map?;
        let begin = midnight(map.from);
        let end = begin + map.cells.len() as Micros * DAY;
        let away: Vec<Span> = map.absences.iter().map(|Absence { begin, end, .. }| (*begin, *end)).collect();
        let last = signs.last().map_or(end, |sign| sign.at).min(end);
        let stays = stays(&agreed, &away, last);
        let door = used_door(log, &sensors.kinds, &map.entrance.sensors);
        let mut timeline = Timeline {
            first: map.from,
            begin,
            recorded_h: map.cells.iter().map(|day| day.map(|cell| cell.recorded_h)).collect(),
            away: (!map.entrance.sensors.is_empty()).then_some(away),
            is_unwatched,
            passages,
            walks,
            company: company(&signs, &door),
            cells: (map.motion_sensors > 0).then(|| map.cells.clone()),
            stays,
            rooms,
            ..Timeline::default()
        };
        timeline.lie_down(sensors, &signs);
        timeline.wash_and_eat(sensors, &signs);
        Ok((timeline, map))
    }

    /// Finds the times in bed: by what is in the bed, or else by silence in the bedroom.
    fn lie_down(&mut self, LogSensors { called, kinds, spans }: &LogSensors, signs: &[Sign]) {
        let is_bed = |sensor: usize| kinds[sensor] == Kind::Used && is_named(&called[sensor], &BEDS);
        let mut lain: Vec<Span> = Vec::new();
        for (_, spans) in spans.iter().enumerate().filter(|(sensor, _)| is_bed(*sensor)) {
            lain.extend(spans.iter().filter(|span| span.1 > span.0));
        }
        lain.sort();
        let in_bedroom: Vec<&Sign> =
            signs.iter().filter(|sign| self.rooms.purpose(sign.room) == Purpose::Bedroom).collect();
        if lain.is_empty() && !self.rooms.has(Purpose::Bedroom) {
            return;
        }
        let sees_bedroom = in_bedroom.iter().any(|sign| sign.is_seen);
        if lain.is_empty() {
            self.guesses_nights = !sees_bedroom;
            let of_bedroom = self.stays.iter().filter(|stay| self.rooms.purpose(stay.room) == Purpose::Bedroom);
            lain = nights(&of_bedroom.copied().collect::<Vec<Stay>>(), &in_bedroom);
        }
        let lain = joined(lain.into_iter(), 0);
        let (mut asleep, mut stirs) = (Vec::new(), Vec::new());
        for &(begin, end) in &lain {
            let of = within(&in_bedroom, begin, end);
            let mut before = begin;
            for at in of.iter().map(|sign| sign.at).chain([end]) {
                if at - before >= SLEEPS {
                    asleep.push((before, at));
                }
                if at < end && at - before > BOUT {
                    stirs.push(at);
                }
                before = at;
            }
        }
        self.in_bed = Some(lain);
        // Without a movement in the bedroom, or of who lies in bed, nobody knows who is awake.
        if sees_bedroom {
            (self.asleep, self.stirs) = (Some(asleep), Some(stirs));
        }
    }

    /// Finds showers and meals.
    fn wash_and_eat(&mut self, LogSensors { called, kinds, spans }: &LogSensors, signs: &[Sign]) {
        let shower = |(name, kind): (&String, &Kind)| *kind != Kind::Reading && is_named(name, &SHOWERS);
        let is_shower: Vec<bool> = called.iter().zip(kinds).map(shower).collect();
        let begins = |spans: Vec<Span>, least: Micros| {
            let long = spans.into_iter().filter(|span| span.1 - span.0 >= least);
            Some(long.map(|span| span.0).collect())
        };
        let in_bathroom: Vec<&Sign> =
            signs.iter().filter(|sign| self.rooms.purpose(sign.room) == Purpose::Bathroom).collect();
        let is_watched = in_bathroom.iter().any(|sign| sign.is_seen);
        if is_shower.contains(&true) {
            // Water flows from its beginning to its end, and some motion sensors say when they see nothing more.
            let of_shower = spans.iter().zip(&is_shower).filter(|(_, is_shower)| **is_shower);
            let ended =
                |&(begin, end): &Span| if end - begin <= SHOWER_LONGEST { (begin, end) } else { (begin, begin) };
            let mut seen: Vec<Span> = of_shower.flat_map(|(spans, _)| spans).map(ended).collect();
            seen.sort_unstable();
            self.showers = begins(joined(seen.into_iter(), SHOWER_APART), SHOWER_LASTS);
        } else if is_watched {
            let in_bed = self.in_bed.as_deref().unwrap_or_default();
            let mut by_day = without(&self.visits(Purpose::Bathroom, MINUTE), in_bed);
            by_day.retain(|&(begin, end)| {
                within(&in_bathroom, begin, end).len() as Micros * BATHROOM_LIVELY >= end - begin
            });
            self.showers = begins(by_day, BATHROOM_LONG);
            self.guesses_showers = true;
        }
        if self.rooms.has(Purpose::Kitchen) {
            let cooked = self.visits(Purpose::Kitchen, 0);
            let mut meals = Vec::new();
            for (begin, end) in joined(cooked.iter().copied(), MEAL_APART) {
                let from = cooked.partition_point(|stay| stay.0 < begin);
                let within = cooked[from..].iter().take_while(|stay| stay.0 <= end).filter(|stay| stay.1 <= end);
                let there: Micros = within.map(|stay| stay.1 - stay.0).sum();
                if there >= MEAL_LASTS {
                    meals.push(begin);
                }
            }
            self.meals = Some(meals);
        }
    }
}

/// When contacts among the sensors of the entrance say that a door is opened or closed, in order of time.
fn used_door(log: &Log, kinds: &[Kind], entrance: &[String]) -> Vec<Micros> {
    let is_door: Vec<bool> = (log.sensors.iter().zip(kinds))
        .map(|(sensor, kind)| *kind == Kind::Contact && entrance.contains(sensor))
        .collect();
    let is_used: Vec<bool> = log.values.iter().map(|value| says(value).is_sign()).collect();
    let told = log.events.iter().filter(|event| is_door[event.sensor as usize] && is_used[event.value as usize]);
    let mut used: Vec<Micros> = told.map(|event| event.at).collect();
    used.sort_unstable();
    used
}

/// Words that tell of beds and showers.
const BEDS: [&str; 2] = ["bed", "mattress"];
const SHOWERS: [&str; 3] = ["shower", "bathtub", "tub"];

fn is_named(name: &str, as_one_of: &[&str]) -> bool {
    words(name).iter().any(|word| as_one_of.contains(&word.as_str()))
}

/// Somebody is in the room of the last sign until there is one of another, or until they leave. A single sign of a room is a
/// glimpse of somebody who passes: a moment of its own between two other rooms, and nothing within one.
fn stays(signs: &[Sign], away: &[Span], last: Micros) -> Vec<Stay> {
    let rooms: Vec<&[Sign]> = signs.chunk_by(|a, b| a.room == b.room).collect();
    let mut stays: Vec<Stay> = Vec::new();
    for (index, of_room) in rooms.iter().enumerate() {
        let next = rooms.get(index + 1);
        let (room, begin) = (of_room[0].room, of_room[0].at);
        let end = next.map_or(last.max(begin), |next| next[0].at);
        let last = of_room[of_room.len() - 1].at;
        let is_glimpse = of_room.len() == 1 || last - begin < GLIMPSE && end - last < SEEN_PASSING;
        match stays.last_mut() {
            Some(before) if before.room == room => before.end = end,
            Some(before) if is_glimpse && next.is_some_and(|next| next[0].room == before.room) => before.end = end,
            Some(before) if is_glimpse && next.is_some() => {
                before.end = begin;
                stays.push(Stay { room, begin, end: end.min(begin + GLIMPSE) });
            }
            _ => stays.push(Stay { room, begin, end }),
        }
    }
    // What comes after a glimpse has begun when that is over.
    for index in 1..stays.len() {
        stays[index].begin = stays[index].begin.min(stays[index - 1].end);
    }
    let parts = stays.iter().flat_map(|stay| {
        let first = away.partition_point(|absence| absence.1 <= stay.begin);
        let parts = without(&[(stay.begin, stay.end)], &away[first..]);
        parts.into_iter().map(|(begin, end)| Stay { room: stay.room, begin, end })
    });
    parts.collect()
}

/// The signs within a span.
fn within<'a>(signs: &'a [&'a Sign], begin: Micros, end: Micros) -> &'a [&'a Sign] {
    let from = signs.partition_point(|sign| sign.at < begin);
    let to = signs.partition_point(|sign| sign.at < end);
    &signs[from..to.max(from)]
}

/// When somebody lies in bed, by the stays in the bedroom that have a long silence. Who goes to the bathroom at night lies down at
/// once when they are back, and until they go. Who comes to bed lies down at once, unless it takes them too long to be still.
fn nights(stays: &[Stay], signs: &[&Sign]) -> Vec<Span> {
    let mut lain: Vec<Span> = Vec::new();
    let mut until: Option<Micros> = None;
    for stay in stays {
        let Some((begin, end)) = still(stay, signs) else { continue };
        let end = if stay.end - end <= WAKES { stay.end } else { end };
        let was_up_for = until.map(|until| stay.begin - until);
        match lain.last_mut() {
            Some(last) if was_up_for.is_some_and(|up| up <= UP_AT_NIGHT) => {
                last.1 = until.unwrap_or(last.1);
                lain.push((stay.begin, end));
            }
            _ => lain.push((if begin - stay.begin <= FALLS_ASLEEP { stay.begin } else { begin }, end)),
        }
        until = Some(stay.end);
    }
    lain
}

/// From the first to the last long silence of a stay, if there is one.
fn still(stay: &Stay, signs: &[&Sign]) -> Option<Span> {
    let of = within(signs, stay.begin, stay.end);
    let times: Vec<Micros> = of.iter().map(|sign| sign.at).chain([stay.end]).collect();
    let is_long = |pair: &&[Micros]| pair[1] - pair[0] >= LIES_STILL;
    let mut long = times.windows(2).filter(is_long);
    let first = long.next()?;
    Some((first[0], long.next_back().unwrap_or(first)[1]))
}
