//! Times of the day, lengths, and what comes before or after what.

use super::arguments::{Arguments, Production, parts};
use super::numbers::{as_range, duration};
use crate::language::amounts::DAY_S;
use crate::language::messages::TimeSentenceMessage;
use crate::language::parts::{ClockTime, Parts, Said, TimeOfDay};
use crate::language::times::{ABOUT_TIME_S, HOUR_S, PLAIN_TIME_S, is_of_next_day};
use crate::language::value::PhraseValue;
use crate::language::words::TextSpan;
use crate::routine::{Activity, Meal, PartOfDay};
use homebody_core::fuzzy::Fuzzy;
use homebody_core::problem::Advice;

const PARTS: [PartOfDay; 6] =
    [PartOfDay::Morning, PartOfDay::Noon, PartOfDay::Afternoon, PartOfDay::Evening, PartOfDay::Night, PartOfDay::Day];

const HALF_DAY_S: f64 = DAY_S / 2.0;
/// Longest duration, in days (our choice).
const MOST_DAYS: f64 = 400.0;

pub fn named(name: &str) -> Option<Production> {
    Some(match name {
        "clock" => |a| Some(clock(a, a.number_constants()[0] * HOUR_S, false)),
        "hour" => |a| {
            let hour = a.numbers()[0];
            let is_hour = hour.fract() == 0.0 && (0.0..=24.0).contains(&hour);
            let open = (1.0..=12.0).contains(&hour) && !a.has("closed");
            is_hour.then(|| clock(a, if open { hour % 12.0 } else { hour } * HOUR_S, open))
        },
        "digits" => digits,
        "no_time" => |a| {
            no_time(a);
            Some(PhraseValue::Time(TimeOfDay { clock: slip(a), spread_s: 0.0 }))
        },
        "odd_time" => |a| {
            let text = &a.words[0].text;
            let is_dotted = text.contains('.') && dotted(text).is_none();
            (is_dotted || matches!(text.len(), 3 | 4) && !text.contains('.') && meant(text).is_some()).then_some(())?;
            no_time(a);
            Some(PhraseValue::Time(TimeOfDay { clock: slip(a), spread_s: 0.0 }))
        },
        "dotted" => |a| dotted(&a.words[0].text).map(|s| clock(a, s, false)),
        "four_digits" => four_digits,
        "past" => |a| past(a, 1.0),
        "to" => |a| past(a, -1.0),
        "half_hour" => |a| {
            let hour = a.numbers()[0];
            (1.0..=12.0).contains(&hour).then(|| clock(a, (hour % 12.0) * HOUR_S + 1_800.0, true))
        },
        "words" => |a| match a.numbers()[..] {
            [hour, minutes] if (1.0..=12.0).contains(&hour) && (10.0..60.0).contains(&minutes) => {
                Some(clock(a, (hour % 12.0) * HOUR_S + minutes * 60.0, true))
            }
            _ => None,
        },
        "half" => half,
        "time" => |a| {
            let clock = ClockTime { span: a.kids.last()?.span, ..a.one(as_clock)? };
            let spread_s = if a.has("about") { ABOUT_TIME_S } else { PLAIN_TIME_S };
            match a.one(as_time) {
                Some(time) => Some(PhraseValue::Time(TimeOfDay { spread_s: ABOUT_TIME_S, ..time })),
                None => Some(PhraseValue::Time(TimeOfDay { clock, spread_s })),
            }
        },
        "spread" => |a| {
            let (time, spread_s) = (a.one(as_time)?, a.numbers()[0]);
            if spread_s > HALF_DAY_S {
                a.fault(a.span, TimeSentenceMessage::SpreadOfTime);
            }
            Some(PhraseValue::Time(TimeOfDay { spread_s, ..time }))
        },
        "part" => |a| Some(PhraseValue::PartOfDay(vec![part_named(a.constant(0))?])),
        "parts_of_day" => |a| Some(PhraseValue::PartOfDay(a.all(as_part).concat())),
        "at" => |a| {
            // "At noon" is a part of the day.
            let is_part = ["noon", "midday"].contains(&a.spoken().trim_start_matches("at "));
            when(a, |times| match times {
                [at] if !is_part => Some(Said::At(*at)),
                _ => None,
            })
        },
        "within" => |a| {
            let part = a.one(as_part)?;
            parts(Parts { part: a.slot(part), ..Parts::default() })
        },
        "plural" => |a| {
            let part = a.words[0].text.trim_end_matches('s');
            let part = PARTS.into_iter().find(|known| known.word() == part)?;
            parts(Parts { part: a.slot(vec![part]), ..Parts::default() })
        },
        "plural_parts" => |a| parts(Parts { part: a.slot(a.all(as_part).concat()), ..Parts::default() }),
        "list_of_parts" => |a| {
            let list = a.constants.iter().filter_map(|name| part_named(name)).collect();
            parts(Parts { part: a.slot(list), ..Parts::default() })
        },
        "list_of_times" => list_of_times,
        "list_of_clocks" => |a| {
            let times = a.all(as_time);
            // "At 8 and 9 in the evening": the half is that of the last.
            let list = times.iter().map(|time| Said::At(*time)).collect();
            parts(Parts { when: a.slot(list), ..Parts::default() })
        },
        "list_of_ranges" => |a| {
            let times = a.all(as_time);
            let ranges: Option<Vec<Said>> = times.chunks_exact(2).map(|pair| range(a, pair[0], pair[1])).collect();
            let ranges = ranges?.into_iter().map(|when| match when {
                Said::Between(from, to) => Said::FromTo(from, to),
                other => other,
            });
            parts(Parts { when: a.slot(ranges.collect()), ..Parts::default() })
        },
        "meals" => |a| {
            let meal = |meal: Meal| match a.constant(0) {
                "with" => Said::With(Activity::Eat(meal)),
                "after" => Said::After(Activity::Eat(meal), None),
                _ => Said::Before(Activity::Eat(meal), None),
            };
            parts(Parts { when: a.slot(Meal::ALL.map(meal).to_vec()), ..Parts::default() })
        },
        "between" => |a| {
            let times = a.all(as_time);
            let range = range(a, times[0], times[1])?;
            parts(Parts { when: a.slot(vec![range]), ..Parts::default() })
        },
        "from_to" => from_to,
        "from_to_closed" => |a| {
            let times = a.all(as_time);
            if times.iter().any(|time| time.clock.open) { None } else { from_to(a) }
        },
        "until_time" => |a| {
            let time = a.one(as_time)?;
            parts(Parts { until: a.slot(Said::At(time)), ..Parts::default() })
        },
        "by" => |a| {
            when(a, |times| match times {
                [by] => Some(Said::By(*by)),
                _ => None,
            })
        },
        "until_event" => |a| {
            a.one(as_event)?;
            let activity = a.kids.last().map(|kid| a.said(kid.span)).unwrap_or_default();
            a.fault(a.span, TimeSentenceMessage::UntilActivity { text: a.said(a.span), activity });
            Some(PhraseValue::Parts(Box::default()))
        },
        "no_end" => |a| {
            a.one(as_time)?;
            let time = a.kids.last().map(|kid| a.said(kid.span)).unwrap_or_default();
            a.fault(a.span, TimeSentenceMessage::NoEnd { text: a.said(a.span), time });
            Some(PhraseValue::Parts(Box::default()))
        },
        "open_time" => |a| {
            let help =
                "write \"after breakfast\", \"before she goes to bed\", or \"between 20:00 and 22:00\"".to_owned();
            a.fault(a.span, TimeSentenceMessage::OpenTime { text: a.said(a.span), help });
            Some(PhraseValue::Parts(Box::default()))
        },
        "lasts" => |a| lasts(a, None),
        "lasts_about" => |a| lasts(a, Some(a.numbers()[0])),
        "not_a_length" => |a| {
            let text = a.said(a.span).split_whitespace().skip(1).collect::<Vec<_>>().join(" ");
            let span = TextSpan { start: a.words[1].span.start, ..a.span };
            a.fault(span, TimeSentenceMessage::NotALength { text });
            Some(PhraseValue::Parts(Box::default()))
        },
        "after" => |a| order(a, Said::After),
        "before" => |a| order(a, Said::Before),
        "with" => |a| order(a, |event, _| Said::With(event)),
        "with_meal" => |a| match a.one(as_event)? {
            Activity::Eat(_) => order(a, |event, _| Said::With(event)),
            _ => None,
        },
        "when_doing" => |a| {
            order(a, |event, _| match event {
                Activity::GoToBed => Said::Before(event, None),
                Activity::GetUp | Activity::ComeHome => Said::After(event, None),
                _ => Said::With(event),
            })
        },
        "when_done" => |a| order(a, Said::After),
        _ => return None,
    })
}

pub fn as_clock(value: &PhraseValue) -> Option<ClockTime> {
    match value {
        PhraseValue::Clock(clock) => Some(*clock),
        PhraseValue::Time(time) => Some(time.clock),
        _ => None,
    }
}

pub fn as_time(value: &PhraseValue) -> Option<TimeOfDay> {
    match value {
        PhraseValue::Time(time) => Some(*time),
        _ => None,
    }
}

pub fn as_part(value: &PhraseValue) -> Option<Vec<PartOfDay>> {
    match value {
        PhraseValue::PartOfDay(part) => Some(part.clone()),
        _ => None,
    }
}

pub fn as_event(value: &PhraseValue) -> Option<Activity> {
    match value {
        PhraseValue::Act(act) => Some(act.activity.clone()),
        _ => None,
    }
}

pub fn part_named(name: &str) -> Option<PartOfDay> {
    PARTS.into_iter().find(|part| part.word().eq_ignore_ascii_case(name))
}

fn clock(a: &Arguments, s: f64, open: bool) -> PhraseValue {
    PhraseValue::Clock(ClockTime { s, open, half: false, span: a.span })
}

/// "7:30": a clock of 24 hours.
fn digits(a: &mut Arguments) -> Option<PhraseValue> {
    let range = a.one(as_range)?;
    let is_time = range.to < 60.0 && (range.from < 24.0 || range.from == 24.0 && range.to == 0.0);
    if !is_time {
        no_time(a);
    }
    let s = if is_time { range.from * HOUR_S + range.to * 60.0 } else { HALF_DAY_S };
    Some(clock(a, s, false))
}

/// "7.30" in seconds since midnight.
fn dotted(text: &str) -> Option<f64> {
    let (hours, minutes) = text.split_once('.')?;
    let (hours, minutes) = (hours.parse::<f64>().ok()?, minutes.parse::<f64>().ok().filter(|_| minutes.len() == 2)?);
    (hours < 24.0 && minutes < 60.0).then_some(hours * HOUR_S + minutes * 60.0)
}

/// The time that was probably meant by a slip, so that the rest of the sentence is read.
fn slip(a: &Arguments) -> ClockTime {
    let (hours, minutes) = meant(&a.said(a.span)).unwrap_or((12, 0));
    ClockTime { s: f64::from(hours) * HOUR_S + f64::from(minutes) * 60.0, open: false, half: true, span: a.span }
}

fn four_digits(a: &mut Arguments) -> Option<PhraseValue> {
    let text = &a.words[0].text;
    if text.len() != 4
        || !(text.starts_with('0') || a.words.len() == 2)
        || !text.bytes().all(|digit| digit.is_ascii_digit())
    {
        return None;
    }
    let (hours, minutes) = (text.get(..2)?.parse::<f64>().ok()?, text.get(2..)?.parse::<f64>().ok()?);
    (hours < 24.0 && minutes < 60.0).then(|| clock(a, hours * HOUR_S + minutes * 60.0, false))
}

fn past(a: &mut Arguments, sign: f64) -> Option<PhraseValue> {
    let minutes = a.numbers().first().copied().or(a.number_constants().first().copied())? * sign;
    let hour = a.one(as_clock)?;
    if minutes.fract() != 0.0 || !(1.0..60.0).contains(&minutes.abs()) {
        return None;
    }
    let s = hour.s + minutes * 60.0;
    let s = match hour.open {
        true => s.rem_euclid(HALF_DAY_S),
        false => s.rem_euclid(DAY_S),
    };
    Some(clock(a, s, hour.open))
}

/// "7 pm", "half past seven in the morning", "3 at night".
fn half(a: &mut Arguments) -> Option<PhraseValue> {
    let number =
        a.numbers().first().map(|&hour| (hour.fract() == 0.0 && (1.0..=12.0).contains(&hour), (hour % 12.0) * HOUR_S));
    let clock = a
        .one(as_clock)
        .map(|clock| (clock.open || (HOUR_S..HALF_DAY_S + HOUR_S).contains(&clock.s), clock.s.rem_euclid(HALF_DAY_S)));
    let (is_of_half, s) = number.or(clock)?;
    let first = &a.words[0].text;
    let to_twelve =
        a.words.windows(2).any(|two| two[0].text == "to" && ["12", "twelve"].contains(&two[1].text.as_str()));
    let said = a.one(as_part).and_then(|part| part.first().copied());
    let late = match (a.constant(0), said) {
        // A quarter to twelve at noon is before it.
        ("am", _) => to_twelve,
        ("pm", _) => !to_twelve,
        ("night", _) => s >= 6.0 * HOUR_S,
        (_, Some(PartOfDay::Morning)) => false,
        _ => true,
    };
    if !is_of_half {
        if number.is_some() && first.parse::<f64>().is_ok_and(|hour| hour > 24.0) {
            return None;
        }
        // "20:00 in the evening" says it twice.
        let closed = a.one(as_clock).filter(|_| !["am", "pm"].contains(&a.constant(0)));
        match closed {
            // Midnight "at night" is that of the evening before.
            Some(closed) if a.constant(0) == "night" && closed.s < HOUR_S => {
                return Some(PhraseValue::Clock(ClockTime { s: closed.s + DAY_S, half: true, span: a.span, ..closed }));
            }
            Some(closed) => return Some(PhraseValue::Clock(ClockTime { half: true, span: a.span, ..closed })),
            None => no_time(a),
        }
    }
    let after_midnight = a.constant(0) == "night" && !late;
    let s = s + if late { HALF_DAY_S } else { 0.0 } + if after_midnight { DAY_S } else { 0.0 };
    Some(PhraseValue::Clock(ClockTime { s, open: false, half: true, span: a.span }))
}

fn no_time(a: &mut Arguments) {
    let text = a.said(a.span);
    let help = match meant(&text) {
        Some((hours, minutes)) => Advice::meant(&format!("{hours}:{minutes:02}")),
        None if text.split_once(':').is_some_and(|(_, minutes)| minutes.len() >= 2) || text.contains(' ') => {
            "times go from 00:00 to 24:00, or from 1 am to 12 pm".into()
        }
        None => "write a colon between hours and minutes: \"06:45\"".into(),
    };
    a.fault(a.span, TimeSentenceMessage::NoTime { text, help });
}

/// The hours and minutes that were meant where letters stand for digits, or another sign for the colon.
pub fn meant(text: &str) -> Option<(u8, u8)> {
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

fn when(a: &mut Arguments, make: impl Fn(&[TimeOfDay]) -> Option<Said>) -> Option<PhraseValue> {
    let when = make(&a.all(as_time))?;
    parts(Parts { when: a.slot(vec![when]), ..Parts::default() })
}

fn list_of_times(a: &mut Arguments) -> Option<PhraseValue> {
    let mut list = Vec::new();
    for one in a.all(as_parts) {
        list.extend(one.part.iter().flat_map(|slot| slot.value.iter().map(|part| Said::Within(*part))));
        list.extend(one.when.iter().flat_map(|slot| slot.value.clone()));
    }
    let only_parts: Option<Vec<PartOfDay>> = list
        .iter()
        .map(|when| match when {
            Said::Within(part) => Some(*part),
            _ => None,
        })
        .collect();
    if list.len() < 2 {
        return None;
    }
    match only_parts {
        Some(list) => parts(Parts { part: a.slot(list), ..Parts::default() }),
        None => parts(Parts { when: a.slot(list), ..Parts::default() }),
    }
}

pub fn as_parts(value: &PhraseValue) -> Option<Parts> {
    match value {
        PhraseValue::Parts(parts) => Some(Parts::clone(parts)),
        _ => None,
    }
}

/// Both times of a stretch, of which one may say the half of the day of the other.
fn range(a: &mut Arguments, from: TimeOfDay, to: TimeOfDay) -> Option<Said> {
    /// Times before this hour, written without a half of the day, are often meant in the afternoon (our choice).
    const EARLY_S: f64 = 8.0 * HOUR_S;
    let (mut first, mut last) = (from.clock, to.clock);
    if first.open && !last.open {
        let written = a.text.get(last.span.start..last.span.end).unwrap_or_default();
        if !last.half && last.s < EARLY_S && !written.starts_with('0') {
            let help = format!("write \"{written} am\" or \"{written} pm\"");
            a.fault(last.span, TimeSentenceMessage::AmbiguousTime { text: written.to_owned(), help });
        }
        let late = last.s.rem_euclid(DAY_S) >= HALF_DAY_S;
        let is_before = first.s < last.s.rem_euclid(HALF_DAY_S);
        first = ClockTime { s: first.s + if late == is_before { HALF_DAY_S } else { 0.0 }, open: false, ..first };
    } else if !first.open && last.open {
        last = ClockTime { s: next_after(first.s, last.s), open: false, ..last };
    }
    if !first.open && !last.open {
        if is_of_next_day(last.s, first.s) {
            last.s += DAY_S;
        } else if last.s <= first.s {
            a.fault(a.span, TimeSentenceMessage::ReversedTimes { text: a.said(a.span) });
        }
    }
    Some(Said::Between(TimeOfDay { clock: first, ..from }, TimeOfDay { clock: last, ..to }))
}

/// The first of the two times that an open one may be, after another.
pub fn next_after(begin: f64, open: f64) -> f64 {
    begin + (open - begin).rem_euclid(HALF_DAY_S)
}

fn from_to(a: &mut Arguments) -> Option<PhraseValue> {
    let times = a.all(as_time);
    let Said::Between(from, to) = range(a, times[0], times[1])? else { return None };
    parts(Parts { when: a.slot(vec![Said::FromTo(from, to)]), ..Parts::default() })
}

fn lasts(a: &mut Arguments, spread_s: Option<f64>) -> Option<PhraseValue> {
    let (range, span) = (a.one(as_range)?, a.kids[0].span);
    let is_bare = a.words.first().is_some_and(|word| word.span.start == span.start);
    if is_bare && range.to > DAY_S {
        return None;
    }
    if range.from <= 0.0 {
        a.fault(span, TimeSentenceMessage::NoDuration { text: a.said(span) });
    } else if range.to > MOST_DAYS * DAY_S {
        a.fault(span, TimeSentenceMessage::LongerThanAYear { text: a.said(span) });
    }
    let lasts = match spread_s {
        Some(spread_s) if spread_s >= range.from => {
            a.fault(a.span, TimeSentenceMessage::SpreadOfDuration);
            duration(range)
        }
        Some(spread_s) => Fuzzy::around((range.from + range.to) / 2.0, spread_s),
        None => duration(range),
    };
    parts(Parts { lasts: a.slot(lasts), ..Parts::default() })
}

fn order(a: &mut Arguments, make: impl Fn(Activity, Option<Fuzzy>) -> Said) -> Option<PhraseValue> {
    let event = a.one(as_event)?;
    let gap = a.one(as_range);
    if gap.is_some_and(|gap| gap.to > DAY_S) {
        a.fault(a.kids[0].span, TimeSentenceMessage::LongerThanADay { text: a.said(a.kids[0].span) });
    }
    let spread_s = a.numbers().first().copied();
    let gap = gap.map(|gap| match spread_s {
        Some(spread_s) => Fuzzy::around((gap.from + gap.to) / 2.0, spread_s),
        None => duration(gap),
    });
    let when = make(event, gap);
    parts(Parts { when: a.slot(vec![when]), ..Parts::default() })
}
