use super::measured_day::VISIT;
use super::rooms::Purpose;
use super::signs::{RoomSign, agreed};
use super::timeline::{MeasureTimeline, RoomStay};
use super::walking::walks;
use super::ways::Ways;
use crate::holds::HoldTimes;
use crate::signs::Kind;
use homebody_core::names::words;
use homebody_core::time::{Interval, MINUTE, SECOND, Span, WallTime, joined, without};
use homebody_core::vocabulary::{WINDOW_WORDS, has_any};
use homebody_timeline::Episode;

/// Time without firings after which a person in a bedroom is in bed, and after which a person in bed sleeps (our
/// choice).
const LIES_STILL: Span = MINUTE.times(20);
const SLEEPS: Span = MINUTE.times(5);
/// Shortest silence of a person at rest in the bedroom. Rest before and after a time in bed belongs to it (our choice).
const RESTS: Span = MINUTE.times(5);
/// Time out of the bedroom at night that still has a stay in bed before and after it, and time from going to bed to
/// falling asleep (our choice).
const UP_AT_NIGHT: Span = MINUTE.times(30);
const FALLS_ASLEEP: Span = MINUTE.times(40);
/// The part of the time out of the bedroom at night that may be in other rooms than the bathroom (our choice): a cook is not in bed.
const UP_ELSEWHERE: Span = MINUTE.times(5);
/// Time after a long silence within which leaving the bedroom counts as getting up (our choice).
const WAKES: Span = MINUTE.times(30);
/// Time between firings in bed that separates two bouts (our choice).
const BOUT: Span = SECOND.times(30);
/// Longest stay in a room with one firing on the way to another (our choice).
const GLIMPSE: Span = SECOND.times(5);
/// Time within which several firings, and the next one of another room, count as one glimpse (our choice).
const SEEN_PASSING: Span = SECOND.times(10);
/// Shortest time between a stray firing and the firings before and after it, and most stray firings in a row (our choice).
const STRAY_APART: Span = MINUTE.times(5);
const MOST_STRAYS: usize = 3;
/// Longest time between firings of a shower's own sensor in one shower, and shortest shower (our choice).
const SHOWER_APART: Span = MINUTE.times(3);
const SHOWER_LASTS: Span = MINUTE.times(3);
/// Duration after which an activity with no observed end is over (our choice).
const SHOWER_LONGEST: Span = MINUTE.times(60);
/// Time in the bathroom by day, with a firing every minute, that is a shower if the shower has no sensor (our choice).
/// A person on the toilet causes fewer firings.
const BATHROOM_LONG: Span = MINUTE.times(10);
const BATHROOM_LIVELY: Span = MINUTE;
/// Longest time between stays in the kitchen that belong to one meal, and shortest meal (our choice).
const MEAL_APART: Span = MINUTE.times(15);
const MEAL_LASTS: Span = MINUTE.times(15);
/// Length of a gap of the recording below which it ends no stay.
const BRIDGED: Span = MINUTE.times(10);

/// A log of some days, up to the end of the last of them.
pub struct LogExcerpt<'a> {
    pub ids: &'a [String],
    pub kinds: &'a [Kind],
    pub spans: &'a dyn Fn(usize) -> Vec<Interval<WallTime>>,
    pub ways: Option<&'a Ways>,
    pub named: &'a NamedSensors,
    /// A bed's sensor has been on so far.
    pub has_bed: bool,
    pub has_spoken: &'a [bool],
    pub holds: &'a HoldTimes,
    pub until: WallTime,
}

/// The beds and showers among sensors, by their names.
pub struct NamedSensors {
    bed: Vec<bool>,
    shower: Vec<bool>,
    window: Vec<bool>,
}

impl NamedSensors {
    pub fn from_names(called: &[String]) -> NamedSensors {
        let all = |words: &[&str]| called.iter().map(|name| is_named(name, words)).collect();
        let window = called.iter().map(|name| has_any(&words(name), WINDOW_WORDS)).collect();
        NamedSensors { bed: all(&BEDS), shower: all(&SHOWERS), window }
    }

    pub fn is_bed(&self, sensor: usize, kind: Kind) -> bool {
        self.bed[sensor] && kind == Kind::Used
    }
}

impl MeasureTimeline {
    /// Adds stays in rooms, times in bed, showers and meals by a log. Days, rooms and absences are known before.
    pub(super) fn hear(&mut self, heard: &LogExcerpt, signs: &[RoomSign]) {
        let seen = || signs.iter().filter(|sign| sign.is_seen).copied().collect::<Vec<RoomSign>>();
        self.walks = heard.ways.map(|ways| walks(&seen(), heard.ids, ways));
        let away = self.away.as_deref().unwrap_or_default();
        self.stays = known_stays(stays(&agreed(signs), away, heard.until), &self.unknown);
        self.lie_down(heard, signs);
        self.wash_and_eat(heard, signs);
    }

    /// A motion sensor has seen a movement in a room for this.
    fn is_seen(&self, heard: &LogExcerpt, purpose: Purpose) -> bool {
        let rooms = self.rooms.of_sensors.iter().enumerate();
        let mut of_purpose = rooms.filter(|(_, room)| room.is_some_and(|room| self.rooms.purpose(room) == purpose));
        of_purpose.any(|(sensor, _)| heard.kinds[sensor] == Kind::Motion && heard.has_spoken[sensor])
    }

    /// The longest hold time of a motion sensor of a room for this; 0 where all report the end of movement.
    fn hold(&self, heard: &LogExcerpt, purpose: Purpose) -> Span {
        let rooms = self.rooms.of_sensors.iter().enumerate();
        let of_purpose = rooms.filter(|(_, room)| room.is_some_and(|room| self.rooms.purpose(room) == purpose));
        of_purpose.filter_map(|(sensor, _)| heard.holds.hold(sensor)).max().unwrap_or_default()
    }

    /// Finds the times in bed: by a bed's sensor, or else by silence in the bedroom.
    fn lie_down(&mut self, heard: &LogExcerpt, signs: &[RoomSign]) {
        if !heard.has_bed && !self.rooms.has(Purpose::Bedroom) {
            return;
        }
        let in_bedroom: Vec<&RoomSign> =
            signs.iter().filter(|sign| self.rooms.purpose(sign.room) == Purpose::Bedroom).collect();
        let sees_bedroom = self.is_seen(heard, Purpose::Bedroom);
        let mut lain: Vec<Interval<WallTime>> = Vec::new();
        if heard.has_bed {
            for sensor in (0..heard.ids.len()).filter(|&sensor| heard.named.is_bed(sensor, heard.kinds[sensor])) {
                lain.extend((heard.spans)(sensor).into_iter().filter(|span| !span.is_empty()));
            }
            lain.sort();
        } else {
            self.guesses_nights = !sees_bedroom;
            lain = self.nights(&in_bedroom);
        }
        let lain = joined(lain, Span::ZERO);
        let (mut asleep, mut stirs) = (Vec::new(), Vec::new());
        for &span in &lain {
            let of = within(&in_bedroom, span);
            let mut before = span.begin;
            for at in of.iter().map(|sign| sign.at).chain([span.end]) {
                if at - before >= SLEEPS {
                    asleep.push(Interval::new(before, at));
                }
                if at < span.end && at - before > BOUT {
                    stirs.push(at);
                }
                before = at;
            }
        }
        self.in_bed = Some(lain);
        // Without a movement in the bedroom, or in bed, waking is unknown.
        let hold = self.hold(heard, Purpose::Bedroom);
        self.asleep = (sees_bedroom && hold < SLEEPS).then_some(asleep);
        self.stirs = (sees_bedroom && hold <= BOUT).then_some(stirs);
        self.hides_stirs = sees_bedroom && hold > BOUT;
    }

    /// The times in bed, by the stays in the bedroom with silences. Stays with short times out of the bedroom between them belong together,
    /// and are in bed if one of them has a long silence. A person who is back from the bathroom at night lies down at once, until they go
    /// again. A person who comes to bed lies down at once, unless it takes them too long to rest.
    fn nights(&self, signs: &[&RoomSign]) -> Vec<Interval<WallTime>> {
        let mut nights: Vec<Vec<Rest>> = Vec::new();
        let mut elsewhere = Span::ZERO;
        for stay in &self.stays {
            let purpose = self.rooms.purpose(stay.label);
            let rest = Rest::in_stay(stay.time, signs).filter(|_| purpose == Purpose::Bedroom);
            let Some(rest) = rest else {
                let is_elsewhere = matches!(purpose, Purpose::Kitchen | Purpose::Other);
                elsewhere += if is_elsewhere { stay.length() } else { Span::ZERO };
                continue;
            };
            let last = nights.last_mut().filter(|_| elsewhere <= UP_ELSEWHERE);
            match last.filter(|night| night.last().is_some_and(|last| rest.stay.begin - last.stay.end <= UP_AT_NIGHT)) {
                Some(night) => night.push(rest),
                None => nights.push(vec![rest]),
            }
            elsewhere = Span::ZERO;
        }
        let lain = nights.iter().filter(|night| night.iter().any(|rest| rest.lies)).flat_map(|night| {
            let last = night.len() - 1;
            night.iter().enumerate().map(move |(number, rest)| rest.in_bed(number == 0, number == last))
        });
        lain.collect()
    }

    fn wash_and_eat(&mut self, heard: &LogExcerpt, signs: &[RoomSign]) {
        let is_shower = |sensor: &usize| heard.named.shower[*sensor] && heard.kinds[*sensor] != Kind::Reading;
        let showers: Vec<usize> = (0..heard.ids.len()).filter(is_shower).collect();
        let begins = |spans: Vec<Interval<WallTime>>, least: Span| {
            let long = spans.into_iter().filter(|span| span.length() >= least);
            Some(long.map(|span| span.begin).collect())
        };
        let hold = self.hold(heard, Purpose::Bathroom);
        self.hides_visits = hold > VISIT;
        if !showers.is_empty() {
            // Water flows from its beginning to its end, and some motion sensors say when they see nothing more.
            let ended = |span: Interval<WallTime>| {
                if span.length() <= SHOWER_LONGEST { span } else { Interval::instant(span.begin) }
            };
            let mut seen: Vec<Interval<WallTime>> =
                showers.iter().flat_map(|&sensor| (heard.spans)(sensor)).map(ended).collect();
            seen.sort_unstable();
            self.showers = begins(joined(seen, SHOWER_APART), SHOWER_LASTS);
        } else if hold > BATHROOM_LIVELY {
            self.hides_showers = true;
        } else if self.is_seen(heard, Purpose::Bathroom) {
            let in_bathroom: Vec<&RoomSign> =
                signs.iter().filter(|sign| self.rooms.purpose(sign.room) == Purpose::Bathroom).collect();
            let in_bed = self.in_bed.as_deref().unwrap_or_default();
            let mut by_day = without(&self.visits(Purpose::Bathroom, MINUTE), in_bed);
            by_day.retain(|&span| within(&in_bathroom, span).len() as i64 * BATHROOM_LIVELY >= span.length());
            self.showers = begins(by_day, BATHROOM_LONG);
            self.guesses_showers = true;
        }
        // An open window does not show cooking.
        let in_kitchen = |room: &Option<usize>| room.is_some_and(|room| self.rooms.purpose(room) == Purpose::Kitchen);
        let tells_cooking = |(sensor, room): (usize, &Option<usize>)| in_kitchen(room) && !heard.named.window[sensor];
        if self.rooms.of_sensors.iter().enumerate().any(tells_cooking) {
            let cooked = self.visits(Purpose::Kitchen, Span::ZERO);
            let mut meals = Vec::new();
            for meal in joined(cooked.iter().copied(), MEAL_APART) {
                let from = cooked.partition_point(|stay| stay.begin < meal.begin);
                let within = cooked[from..].iter().take_while(|stay| stay.begin <= meal.end);
                let there: Span = within.filter(|stay| stay.end <= meal.end).map(|stay| stay.length()).sum();
                if there >= MEAL_LASTS {
                    meals.push(meal.begin);
                }
            }
            self.meals = Some(meals);
        }
    }
}

/// Words that tell of beds and showers.
const BEDS: [&str; 2] = ["bed", "mattress"];
const SHOWERS: [&str; 3] = ["shower", "bathtub", "tub"];

fn is_named(name: &str, as_one_of: &[&str]) -> bool {
    words(name).iter().any(|word| as_one_of.contains(&word.as_str()))
}

/// The signs without stray ones: a few signs of other rooms between two of one room, each far from the signs before and after it. A person
/// who goes from room to room and back gives signs on the way.
fn without_strays(signs: &[RoomSign]) -> Vec<RoomSign> {
    let mut kept: Vec<RoomSign> = Vec::with_capacity(signs.len());
    let mut index = 0;
    while let Some(sign) = signs.get(index) {
        if let Some(before) = kept.last().filter(|before| before.room != sign.room) {
            let is_far = |pair: &[RoomSign]| pair[1].at - pair[0].at >= STRAY_APART;
            let strays = signs[index - 1..].windows(2).take(MOST_STRAYS + 1).take_while(|pair| is_far(pair)).count();
            let back = (1..=strays.min(MOST_STRAYS)).find(|count| {
                let next = signs.get(index + count);
                next.is_some_and(|next| next.room == before.room) && *count < strays
            });
            let all_seen = |count: usize| signs[index..index + count].iter().all(|sign| sign.is_seen);
            if let Some(count) = back.filter(|count| all_seen(*count)) {
                index += count;
                continue;
            }
        }
        kept.push(*sign);
        index += 1;
    }
    kept
}

/// A person is in the room of the last sign until there is a sign of another room, or until they leave. A single sign of a room is a
/// glimpse of a person who passes: a moment of its own between two other rooms, and nothing within one. A single sign of a sensor that
/// stays on is a stay, unless the next sign comes soon.
fn stays(signs: &[RoomSign], away: &[Interval<WallTime>], last: WallTime) -> Vec<RoomStay> {
    let signs = without_strays(signs);
    let rooms: Vec<&[RoomSign]> = signs.chunk_by(|a, b| a.room == b.room).collect();
    let mut stays: Vec<RoomStay> = Vec::new();
    for (index, of_room) in rooms.iter().enumerate() {
        let next = rooms.get(index + 1);
        let (room, begin) = (of_room[0].room, of_room[0].at);
        let end = next.map_or(last.max(begin), |next| next[0].at);
        let last = of_room[of_room.len() - 1].at;
        // A sensor that stays on reports a whole stay at once, if the next one reports anew and has not been on all the time.
        let is_all = of_room[0].is_held && next.is_none_or(|next| next[0].is_seen);
        let is_alone = of_room.len() == 1 && !is_all;
        let is_glimpse = is_alone || last - begin < GLIMPSE && end - last < SEEN_PASSING;
        match stays.last_mut() {
            Some(before) if before.label == room => before.time.end = end,
            Some(before) if is_glimpse && next.is_some_and(|next| next[0].room == before.label) => {
                before.time.end = end
            }
            Some(before) if is_glimpse && next.is_some() => {
                before.time.end = begin;
                stays.push(Episode::new(room, Interval::new(begin, end.min(begin + GLIMPSE))));
            }
            _ => stays.push(Episode::new(room, Interval::new(begin, end))),
        }
    }
    // The stay after a glimpse has begun when the glimpse is over.
    for index in 1..stays.len() {
        stays[index].time.begin = stays[index].begin().min(stays[index - 1].end());
    }
    let parts = stays.iter().flat_map(|stay| {
        let first = away.partition_point(|absence| absence.end <= stay.begin());
        without(&[stay.time], &away[first..]).into_iter().map(|time| Episode::new(stay.label, time))
    });
    parts.collect()
}

/// Known stays: each ends where a gap begins, unless the gap is short.
fn known_stays(stays: Vec<RoomStay>, unknown: &[Interval<WallTime>]) -> Vec<RoomStay> {
    let known = |stay: RoomStay| {
        let first = unknown.partition_point(|gap| gap.begin < stay.begin());
        let gap = unknown[first..].iter().take_while(|gap| gap.begin < stay.end()).find(|gap| gap.length() > BRIDGED);
        Episode::new(stay.label, Interval { end: gap.map_or(stay.end(), |gap| gap.begin), ..stay.time })
    };
    stays.into_iter().map(known).collect()
}

fn within<'a>(signs: &'a [&'a RoomSign], span: Interval<WallTime>) -> &'a [&'a RoomSign] {
    let before = span.map(|at| signs.partition_point(|sign| sign.at < at));
    &signs[before.begin..before.end.max(before.begin)]
}

/// A stay in the bedroom with rest.
struct Rest {
    stay: Interval<WallTime>,
    /// From the first to the last silence of at least [`RESTS`].
    rest: Interval<WallTime>,
    /// One of the silences lasts for at least [`LIES_STILL`].
    lies: bool,
}

impl Rest {
    /// The time in bed, of the first or the last stay of a night or of one in between.
    fn in_bed(&self, is_first: bool, is_last: bool) -> Interval<WallTime> {
        let Rest { stay, rest, .. } = *self;
        let lies_at_once = !is_first || rest.begin - stay.begin <= FALLS_ASLEEP;
        let lies_on = !is_last || stay.end - rest.end <= WAKES;
        Interval::new(if lies_at_once { stay.begin } else { rest.begin }, if lies_on { stay.end } else { rest.end })
    }

    fn in_stay(stay: Interval<WallTime>, signs: &[&RoomSign]) -> Option<Rest> {
        let times: Vec<WallTime> = within(signs, stay).iter().map(|sign| sign.at).chain([stay.end]).collect();
        let silences = || times.windows(2).map(|pair| Interval::new(pair[0], pair[1]));
        let mut resting = silences().filter(|silence| silence.length() >= RESTS);
        let first = resting.next()?;
        let rest = first.hull(resting.next_back().unwrap_or(first));
        Some(Rest { stay, rest, lies: silences().any(|silence| silence.length() >= LIES_STILL) })
    }
}
