//! The time that a clock shows, in digits or in words, and what was probably meant by a slip.

use super::activities;
use super::amounts::{DAY_S, is_unit, number};
use super::calendar::{is_month, is_weekday};
use super::messages::TimeSentenceMessage;
use super::reader::SentenceReader;
use super::visits::visits;
use super::words::{TextSpan, Token};
use crate::routine::{Activity, Meal, PartOfDay};
use homebody_core::problem::Advice;

const HOUR_S: f64 = 3600.0;

#[derive(Clone, Copy, Debug, PartialEq)]
struct Face {
    hours: f64,
    minutes: f64,
    is_clear: bool,
}

/// Seconds since midnight, if a time of day comes next. `bare` says whether a number alone is taken for one.
/// Of what ends after another time, it is the first of the two that may be meant.
pub fn clock(reader: &mut SentenceReader, bare: bool, begin: Option<f64>) -> Option<f64> {
    let from = reader.at;
    if !bare && counts_tablets(reader) {
        return None;
    }
    if reader.eat("noon|midday") || reader.eat("12|twelve noon|midday") {
        return Some(12.0 * HOUR_S);
    }
    if reader.eat("midnight") || reader.eat("12|twelve midnight") {
        return Some(DAY_S);
    }
    if bare && reader.token(0) == Some(Token::Word) && begins_with_slip(reader) {
        return Some(no_time(reader, from));
    }
    let in_words = reader.attempt(|reader| in_words(reader, bare));
    let face = in_words.or_else(|| shown(reader, bare))?;
    let oclock = reader.eat("o'clock");
    let said_half = said_half(reader, face);
    let direct = said_half.or_else(|| half_by_part(reader, face));
    let is_last = bare && !is_unit(reader) && !is_day_of_month(reader);
    if !(in_words.is_some() || face.is_clear || oclock || direct.is_some() || is_last) {
        return None;
    }
    let implied = |reader: &mut SentenceReader| {
        half_by_end(reader, face).or_else(|| half_by_rest(reader, face)).or_else(|| half_by_doing(reader, from, face))
    };
    let next = begin.map(|begin| {
        let after =
            |late: bool| (face.after_twelve_s() + if late { DAY_S / 2.0 } else { 0.0 } - begin).rem_euclid(DAY_S);
        after(true) < after(false)
    });
    let half = direct.or_else(|| if face.is_clear { None } else { next.or_else(|| implied(reader)) });
    let (span, by_twelve) = (reader.span(from), (1.0..=12.0).contains(&face.hours));
    // A whole time with a word right behind it lacks a blank, and no more.
    let lacks_blank = face.is_clear && face.is_time() && reader.token(0) == Some(Token::Word);
    if is_glued(reader) && !lacks_blank || !face.is_time() || said_half.is_some() && !by_twelve {
        return Some(no_time(reader, from));
    }
    if half.is_none() && !face.is_clear {
        let said = reader.said(span);
        let help = face.both(&said);
        reader.fault(span, TimeSentenceMessage::AmbiguousTime { text: said, help });
    }
    Some(match half {
        Some(is_late) if by_twelve => face.after_twelve_s() + if is_late { DAY_S / 2.0 } else { 0.0 },
        _ => face.hours * HOUR_S + face.minutes * 60.0,
    })
}

/// "Her tablets, four in the morning and two at night": so many of them.
fn counts_tablets(reader: &SentenceReader) -> bool {
    const COUNTED: [&str; 9] =
        ["tablets", "pills", "capsules", "puffs", "drops", "units", "cups", "glasses", "spoonfuls"];
    let is_bare = reader.token(0) == Some(Token::Word)
        && !["half", "quarter", "noon", "midday", "midnight"].contains(&reader.peek(0));
    let before = reader.at.checked_sub(1).map(|before| &reader.words[before]);
    let follows = before.is_some_and(|before| before.token == Token::Comma || before.text == "and");
    is_bare && follows && reader.words[..reader.at].iter().any(|word| COUNTED.contains(&word.text.as_str()))
}

impl Face {
    fn is_time(self) -> bool {
        let is_whole = self.hours.fract() == 0.0 && self.minutes < 60.0;
        is_whole && (self.hours < 24.0 || self.hours == 24.0 && self.minutes <= 0.0)
    }

    /// Seconds since noon or midnight.
    fn after_twelve_s(self) -> f64 {
        (self.hours * HOUR_S + self.minutes * 60.0).rem_euclid(DAY_S / 2.0)
    }

    fn full_hours(self) -> f64 {
        if self.minutes < 0.0 { self.hours - 1.0 } else { self.hours }
    }

    fn both(self, said: &str) -> String {
        let (hours, is_whole) = (self.hours, self.minutes == 0.0);
        let early = if (3.0..12.0).contains(&self.full_hours()) { "in the morning" } else { "at night" };
        let late = if (6.0..12.0).contains(&self.full_hours()) { "in the evening" } else { "in the afternoon" };
        match hours {
            1.0..=12.0 if is_whole => format!("write \"{hours} am\" or \"{hours} pm\""),
            1.0..=12.0 => format!("write \"{said} {early}\" or \"{said} {late}\""),
            _ => format!("write \"{hours}:00\""),
        }
    }
}

/// "half past seven", "a quarter to eight", "ten past 8", "20 minutes to noon".
fn in_words(reader: &mut SentenceReader, bare: bool) -> Option<Face> {
    let (from, in_digits) = (reader.at, reader.token(0) != Some(Token::Word));
    let half = reader.eat("half");
    let quarter = !half && (reader.eat("quarter") || reader.eat("a quarter"));
    let minutes = match (half, quarter) {
        (true, _) => 30.0,
        (_, true) => 15.0,
        _ => number(reader).filter(|minutes| minutes.fract() == 0.0 && (1.0..60.0).contains(minutes))?,
    };
    let says_minutes = !half && !quarter && reader.eat("minutes|minute|min|mins");
    let Some(is_to) = reader.eat_any(&[("past", false), ("to", true)]) else {
        return if half && bare { half_past(reader) } else { None };
    };
    // "From 10 to 12" is a stretch of time.
    if is_to && (half || in_digits && !says_minutes) {
        return None;
    }
    // Nor is "from ten to six" ten minutes to six, unless it goes on.
    let begins =
        from.checked_sub(1).and_then(|before| reader.words.get(before)).is_some_and(|word| word.text == "from");
    if is_to && begins && !quarter && !says_minutes && !["to", "until", "till"].contains(&reader.peek(1)) {
        return None;
    }
    let noon = reader.eat("noon|midday");
    let midnight = !noon && reader.eat("midnight");
    let hours = match (noon, midnight) {
        (true, _) => 12.0,
        (_, true) => 24.0,
        _ => number(reader).filter(|hours| hours.fract() == 0.0 && (1.0..=24.0).contains(hours))?,
    };
    if is_to && !(noon || midnight || quarter || says_minutes || is_last_of_its_kind(reader)) {
        return None;
    }
    let is_clear = noon || midnight || hours > 12.0;
    let hours = if midnight && !is_to { 0.0 } else { hours };
    Some(Face { hours, minutes: if is_to { -minutes } else { minutes }, is_clear })
}

/// "Half eight" is half past eight.
fn half_past(reader: &mut SentenceReader) -> Option<Face> {
    let hours = number(reader).filter(|hours| hours.fract() == 0.0 && (1.0..=12.0).contains(hours))?;
    Some(Face { hours, minutes: 30.0, is_clear: false })
}

/// "7:30", "7.30", "7", "seven", "seven thirty".
fn shown(reader: &mut SentenceReader, bare: bool) -> Option<Face> {
    if let Token::Clock(hours, minutes) = reader.token(0)? {
        reader.at += 1;
        return Some(Face { hours: hours.into(), minutes: minutes.into(), is_clear: true });
    }
    if let Some((hours, minutes)) = dotted(reader.peek(0)) {
        reader.at += 1;
        let is_time = bare || is_last_of_its_kind(reader) || ["am", "pm"].contains(&reader.peek(0));
        return is_time.then_some(Face { hours, minutes, is_clear: true });
    }
    if let Some((hours, minutes)) = of_four_digits(reader) {
        reader.at += 1;
        reader.eat("hrs|hours|h");
        return Some(Face { hours, minutes, is_clear: true });
    }
    let in_words = reader.token(0) == Some(Token::Word);
    let hours = number(reader)?;
    let minutes = reader.attempt(|reader| {
        let minutes = if in_words && reader.token(0) == Some(Token::Word) { number(reader) } else { None };
        minutes.filter(|minutes| (10.0..60.0).contains(minutes) && !is_unit(reader))
    });
    Some(Face { hours, minutes: minutes.unwrap_or(0.0), is_clear: false })
}

/// The hours and minutes of "0730" and of "1430 hrs".
fn of_four_digits(reader: &SentenceReader) -> Option<(f64, f64)> {
    let text = reader.peek(0);
    let is_time = text.starts_with('0') || ["hrs", "hours", "h"].contains(&reader.peek(1));
    if text.len() != 4 || !is_time || !text.bytes().all(|digit| digit.is_ascii_digit()) {
        return None;
    }
    let (hours, minutes) = (text.get(..2)?.parse::<u8>().ok()?, text.get(2..)?.parse::<u8>().ok()?);
    (hours < 24 && minutes < 60).then_some((hours.into(), minutes.into()))
}

/// The hours and minutes of "7.30".
fn dotted(text: &str) -> Option<(f64, f64)> {
    let (hours, minutes) = text.split_once('.')?;
    let (hours, minutes) = (hours.parse::<u8>().ok()?, minutes.parse::<u8>().ok().filter(|_| minutes.len() == 2)?);
    (hours <= 24 && minutes < 60).then_some((hours.into(), minutes.into()))
}

fn is_last_of_its_kind(reader: &SentenceReader) -> bool {
    const NEXT: [&str; 16] = [
        "and", "for", "on", "in", "until", "till", "then", "every", "give", "with", "to", "from", "at", "o'clock",
        "am", "pm",
    ];
    reader.is_over() || reader.token(0) == Some(Token::Comma) || NEXT.contains(&reader.peek(0))
}

fn is_day_of_month(reader: &SentenceReader) -> bool {
    ["st", "nd", "rd", "th", "of"].contains(&reader.peek(0)) || is_month(reader.peek(0))
}

fn said_half(reader: &mut SentenceReader, face: Face) -> Option<bool> {
    let is_pm = reader.eat_any(&[("am", false), ("pm", true)])?;
    Some(is_pm != (face.hours == 12.0 && face.minutes < 0.0))
}

fn half_by_part(reader: &SentenceReader, face: Face) -> Option<bool> {
    match (reader.peek(0), reader.peek(1), reader.peek(2)) {
        ("in", "the", "morning") => Some(false),
        ("in", "the", "afternoon" | "evening") => Some(true),
        ("at", "night", _) if (9.0..12.0).contains(&face.full_hours()) => Some(true),
        ("at", "night", _) if !face.is_clear && (face.full_hours() < 6.0 || face.full_hours() == 12.0) => Some(false),
        _ => None,
    }
}

fn half_by_end(reader: &mut SentenceReader, face: Face) -> Option<bool> {
    reader.ahead(|reader| {
        if !reader.eat("to|and|until|till") {
            return None;
        }
        let end = reader.attempt(|reader| in_words(reader, false)).or_else(|| shown(reader, true))?;
        reader.eat("o'clock");
        let half = said_half(reader, end).or_else(|| half_by_part(reader, end))?;
        Some(if face.after_twelve_s() < end.after_twelve_s() { half } else { !half })
    })
}

fn half_by_rest(reader: &SentenceReader, face: Face) -> Option<bool> {
    const BEFORE: [&str; 7] = ["every", "each", "most", "some", "many", "almost", "all"];
    let words: Vec<&str> = reader.words.iter().map(|word| word.text.as_str()).collect();
    let joins = |at: usize| ["and", "then", "or", "but"].contains(&words[at]) || words[at] == ";";
    let begin = (0..reader.at.min(words.len())).rev().find(|&at| joins(at)).map_or(0, |at| at + 1);
    let end = (reader.at..words.len()).find(|&at| joins(at)).unwrap_or(words.len());
    let verb = words.iter().position(|word| ["she", "he", "they"].contains(word)).unwrap_or(0);
    let mut found = words.iter().enumerate().filter(|(at, _)| *at < verb || (begin..end).contains(at));
    let mut found = found.by_ref().filter_map(|(at, word)| {
        let before = |back: usize| at.checked_sub(back).and_then(|at| words.get(at)).copied().unwrap_or_default();
        let is_when = BEFORE.contains(&before(1)) || is_weekday(before(1)) || before(1) == "the" && before(2) == "in";
        match word.trim_end_matches('s') {
            "morning" if is_when => Some(false),
            "afternoon" | "evening" if is_when => Some(true),
            "night" | "weeknight" if is_when || before(1) == "at" || word.ends_with('s') => {
                Some((6.0..12.0).contains(&face.full_hours()))
            }
            _ => None,
        }
    });
    match (found.next(), reader.part) {
        (Some(half), _) => found.all(|other| other == half).then_some(half),
        (None, Some(PartOfDay::Morning)) => Some(false),
        (None, Some(PartOfDay::Afternoon | PartOfDay::Evening)) => Some(true),
        (None, _) => None,
    }
}

fn half_by_doing(reader: &mut SentenceReader, from: usize, face: Face) -> Option<bool> {
    let hour = face.full_hours();
    let word = |at: Option<usize>| at.and_then(|at| reader.words.get(at)).map_or("", |word| word.text.as_str());
    let back = if ["about", "around"].contains(&word(from.checked_sub(1))) { 2 } else { 1 };
    if ["until", "till"].contains(&word(from.checked_sub(back))) {
        let to_bed = (1..from).any(|at| word(Some(at)) == "bed" && word(Some(at - 1)) == "to");
        if to_bed {
            return half_of(&Activity::GoToBed, hour);
        }
        let in_bed = (0..from).any(|at| ["bed", "sleeps", "sleep", "dressed"].contains(&word(Some(at))));
        return (in_bed && (4.0..12.0).contains(&hour)).then_some(false);
    }
    let rises = ["her", "him", "them", "me"].iter().all(|whom| *whom != word(from.checked_sub(back + 2)));
    match word(from.checked_sub(back + 1)) {
        "up" | "awake" if (4.0..12.0).contains(&hour) && rises => return Some(false),
        "asleep" if (7.0..12.0).contains(&hour) => return Some(true),
        _ => {}
    }
    /// Further away, something else is meant.
    const NEAR: usize = 20;
    let near = |reader: &mut SentenceReader, named: fn(&mut SentenceReader) -> Option<Activity>| {
        let at = |reader: &mut SentenceReader, at: usize| {
            reader.ahead(|reader| {
                reader.at = at;
                named(reader)
            })
        };
        let before = (from.saturating_sub(NEAR)..from).rev().find_map(|from| at(reader, from));
        before.or_else(|| (from..reader.words.len().min(from + NEAR)).find_map(|from| at(reader, from)))
    };
    // Of "naps on the bed" the nap.
    let doing = near(reader, activities::activity).or_else(|| near(reader, activities::noun));
    let comes = |reader: &mut SentenceReader| {
        (0..from).any(|at| {
            reader.at = at;
            visits(reader)
        })
    };
    let doing = doing.or_else(|| reader.ahead(comes).then_some(Activity::Visit))?;
    half_of(&doing, hour)
}

/// Hours of the clock at which an activity takes place in the first half of the day, and in the second (our choice).
const HALVES: [(&[Activity], [f64; 2], [f64; 2]); 9] = [
    (&[Activity::GetUp], [4.0, 12.0], NONE),
    (&[Activity::Eat(Meal::Breakfast), Activity::Prepare(Meal::Breakfast), Activity::Dress], [5.0, 12.0], NONE),
    (&[Activity::Eat(Meal::Lunch), Activity::Prepare(Meal::Lunch)], [11.0, 12.0], [0.0, 3.0]),
    (&[Activity::Eat(Meal::Dinner), Activity::Prepare(Meal::Dinner)], NONE, [4.0, 10.0]),
    (&[Activity::GoToBed], [0.0, 4.0], [7.0, 12.0]),
    (&[Activity::WatchTelevision], NONE, [0.0, 11.0]),
    (&[Activity::TakeMedicine], [6.0, 10.0], [0.0, 6.0]),
    (
        &[Activity::Leave, Activity::Visit, Activity::Exercise, Activity::Housework, Activity::Laundry],
        [8.0, 12.0],
        [0.0, 6.0],
    ),
    (&[Activity::Drink, Activity::Nap], [9.0, 12.0], [0.0, 6.0]),
];

const NONE: [f64; 2] = [0.0, 0.0];

/// Hours of the clock at which daytime activities do not take place (our choice).
const BY_DAY: [f64; 2] = [1.0, 6.0];

const AT_ANY_HOUR: [Activity; 10] = [
    Activity::UseBathroom,
    Activity::LieAwake,
    Activity::Wander,
    Activity::Pace,
    Activity::Lap,
    Activity::Fall,
    Activity::Stumble,
    Activity::ComeHome,
    Activity::Snack,
    Activity::Relax,
];

fn half_of(doing: &Activity, hour: f64) -> Option<bool> {
    let of_doing = HALVES.iter().find(|(activities, ..)| activities.contains(doing));
    let usual = (!AT_ANY_HOUR.contains(doing)).then_some((NONE, BY_DAY));
    let (first, second) = &of_doing.map(|(_, first, second)| (*first, *second)).or(usual)?;
    let is_in = |[from, to]: &[f64; 2]| (*from..*to).contains(&(hour % 12.0));
    if is_in(first) { Some(false) } else { is_in(second).then_some(true) }
}

fn is_glued(reader: &SentenceReader) -> bool {
    let follows = |at: usize| {
        let before = at.checked_sub(1).and_then(|before| reader.words.get(before));
        matches!((before, reader.words.get(at)), (Some(before), Some(word)) if before.span.end == word.span.start)
    };
    match reader.token(0) {
        Some(Token::Comma) if reader.peek(0) == "," => false,
        Some(Token::Comma) => follows(reader.at) && follows(reader.at + 1) && is_digit(reader.peek(1)),
        Some(Token::Word) => follows(reader.at) && reader.peek(0) != "to",
        _ => false,
    }
}

fn is_digit(word: &str) -> bool {
    word.starts_with(|first: char| first.is_ascii_digit())
}

fn skip_glued(reader: &mut SentenceReader) {
    reader.at += 1;
    while is_glued(reader) || reader.at > 0 && is_digit(reader.peek(0)) && reader.here().start == last_end(reader) {
        reader.at += 1;
    }
}

fn last_end(reader: &SentenceReader) -> usize {
    reader.words.get(reader.at.saturating_sub(1)).map_or(0, |word| word.span.end)
}

fn begins_with_slip(reader: &mut SentenceReader) -> bool {
    let from = reader.at;
    let has_digit = reader.peek(0).contains(|c: char| c.is_ascii_digit());
    has_digit
        && reader.ahead(|reader| {
            skip_glued(reader);
            meant(&written(reader, reader.span(from))).is_some()
        })
}

fn written(reader: &SentenceReader, span: TextSpan) -> String {
    reader.text.get(span.start..span.end).unwrap_or_default().to_owned()
}

fn no_time(reader: &mut SentenceReader, from: usize) -> f64 {
    if reader.at == from || is_glued(reader) {
        skip_glued(reader);
    }
    let span = reader.span(from);
    let text = written(reader, span);
    let meant = meant(&text);
    let help = match meant {
        Some((hours, minutes)) => Advice::meant(&format!("{hours}:{minutes:02}")),
        None if text.split_once(':').is_some_and(|(_, minutes)| minutes.len() >= 2) || text.contains(' ') => {
            "times go from 00:00 to 24:00, or from 1 am to 12 pm".into()
        }
        None => "write a colon between hours and minutes: \"06:45\"".into(),
    };
    reader.fault(span, TimeSentenceMessage::NoTime { text: reader.said(span), help });
    meant.map_or(12.0 * HOUR_S, |(hours, minutes)| f64::from(hours) * HOUR_S + f64::from(minutes) * 60.0)
}

/// The hours and minutes that were meant where letters stand for digits, or another sign for the colon.
fn meant(text: &str) -> Option<(u8, u8)> {
    let mended: String = text
        .chars()
        .map(|c| match c {
            'o' | 'O' => '0',
            'l' | 'I' | 'i' => '1',
            ';' | '.' | ',' | 'h' | '\'' => ':',
            other => other,
        })
        .collect();
    let (hours, minutes) = match mended.split_once(':') {
        Some(parts) => parts,
        None if matches!(mended.len(), 3 | 4) => mended.split_at_checked(mended.len() - 2)?,
        None => return None,
    };
    let two = |digits: &str| digits.len() <= 2 && digits.chars().all(|c| c.is_ascii_digit());
    if !(two(hours) && two(minutes) && minutes.len() == 2) {
        return None;
    }
    let (hours, minutes) = (hours.parse().ok()?, minutes.parse().ok()?);
    (hours < 24 && minutes < 60).then_some((hours, minutes))
}
