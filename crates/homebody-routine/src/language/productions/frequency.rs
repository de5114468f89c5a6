//! How often: quantifiers, shares of days, times a week, times a day.

use super::arguments::{Arguments, Production, parts};
use super::days::{as_moment, as_weekdays};
use super::numbers::as_range;
use super::times::as_part;
use crate::language::messages::TimeSentenceMessage;
use crate::language::parts::{Chance, Parts};
use crate::language::value::{PhraseValue, Range};
use crate::routine::{HabitChance, PartOfDay};
use homebody_core::fuzzy::Quantifier;

/// Hours in which somebody is awake, to turn "every two hours" into a number of times (our choice).
const AWAKE_H: f64 = 16.0;

pub fn named(name: &str) -> Option<Production> {
    Some(match name {
        "quantifier" => |a| {
            let name = a.constant(0);
            let quantifier = Quantifier::ALL.into_iter().find(|quantifier| format!("{quantifier:?}") == name)?;
            Some(PhraseValue::Chance(Chance { chance: HabitChance::from_quantifier(quantifier), is_rate: false }))
        },
        "day_noun" => |a| {
            let part = a.one(as_part).and_then(|part| part.first().copied());
            let is_day = a.words.len() == 1 && ["day", "days"].contains(&a.words[0].text.as_str());
            if is_day && part.is_some() {
                return None;
            }
            Some(PhraseValue::DayNoun(a.one(as_weekdays), part))
        },
        "often" => |a| {
            const ONE: [&str; 5] = ["day", "night", "morning", "afternoon", "evening"];
            let chance = a.one(as_chance)?;
            // "All day" is a stretch of it.
            let is_stretch = a.words.len() > 1
                && !a.words.iter().any(|word| ["every", "each"].contains(&word.text.as_str()))
                && ONE.contains(&a.words[a.words.len() - 1].text.as_str());
            if is_stretch { None } else { on_days(a, chance) }
        },
        "every_parts" => |a| {
            let list = a.all(as_part).concat();
            let chance = Chance { chance: HabitChance::from_quantifier(Quantifier::Every), is_rate: false };
            parts(Parts { chance: a.slot(chance), part: a.slot(list), ..Parts::default() })
        },
        "share" => |a| {
            let range = a.one(as_range)?;
            let span = a.kids[0].span;
            if range.to > 100.0 {
                a.fault(span, TimeSentenceMessage::MoreThanAll { text: a.said(span) });
            } else if range.to <= 0.0 {
                a.fault(span, TimeSentenceMessage::Never { text: a.said(span) });
            }
            on_days(a, of_probability((range.from + range.to) / 200.0))
        },
        "one_in" => |a| {
            let (some, of) = (a.numbers()[0], a.numbers()[1]);
            a.one(as_day_noun)?;
            if !(some > 0.0 && some <= of) {
                a.fault(a.span, TimeSentenceMessage::NotAShare { text: a.said(a.span) });
            }
            on_days(a, of_probability((some / of).clamp(0.0, 1.0)))
        },
        "every_days" => |a| every(a, 1.0),
        "every_weeks" => |a| every(a, 7.0),
        "every_nth_weekday" => |a| {
            let nth =
                a.numbers().first().copied().or(if a.spoken().contains("alternate") { Some(2.0) } else { None })?;
            let weekdays = a.one(as_weekdays)?;
            if weekdays.count_ones() > 1 {
                a.fault(a.span, TimeSentenceMessage::SeveralWeekdays { text: a.said(a.span) });
            }
            let part = a.one(as_part).and_then(|part| a.slot(part));
            parts(Parts { every: a.slot(nth as u32 * 7), weekdays: a.slot(weekdays), part, ..Parts::default() })
        },
        "every_weeks_on" => |a| {
            let (weeks, day) = (a.numbers()[0], a.numbers()[1]);
            let weekdays = a.slot(1_u8 << day as u8);
            let is_whole = weeks.fract() == 0.0 && (1.0..=52.0).contains(&weeks);
            is_whole.then(|| parts(Parts { every: a.slot(weeks as u32 * 7), weekdays, ..Parts::default() }))?
        },
        "each_period" => |a| {
            let days = [a.number_constants(), a.numbers()].concat()[0];
            rated(a, Range { from: 1.0, to: 1.0, about: false }, days)
        },
        "every_hours" => |a| {
            let hours = a.numbers().last().copied().unwrap_or(1.0);
            let times_a_day = (AWAKE_H / hours.max(1.0)).round().max(1.0);
            a.fault(a.span, TimeSentenceMessage::EveryHours { text: a.said(a.span), times_a_day });
            Some(PhraseValue::Parts(Box::default()))
        },
        "about_every" => |a| {
            let days = a.numbers()[0] * a.number_constants()[0];
            rated(a, Range { from: 1.0, to: 1.0, about: true }, days)
        },
        "rate" => rate,
        "rate_of" => |a| {
            let range = a.one(as_range)?;
            // "Once every two weeks" is every two weeks.
            if (range.from, range.to, range.about) == (1.0, 1.0, false) {
                return None;
            }
            let days: f64 = a.numbers().iter().chain(&a.number_constants()).product();
            rated(a, range, days)
        },
        "total" => |a| parts(Parts { total: a.slot(()), ..Parts::default() }),
        "count" => count,
        "count_in_parts" => |a| {
            let (range, list) = (a.one(as_range)?, a.all(as_part).concat());
            let is_once_each = range.from == range.to && range.from == list.len() as f64;
            is_once_each.then(|| parts(Parts { part: a.slot(list), ..Parts::default() }))?
        },
        "part_of_each_day" => |a| {
            a.fault(a.span, TimeSentenceMessage::PartOfEachDay { text: a.said(a.span) });
            Some(PhraseValue::Parts(Box::default()))
        },
        "becoming" => |a| {
            let both = a.all(as_parts_box);
            let chances: Vec<Chance> = match both[..] {
                [] => a.all(as_chance),
                _ => both.iter().filter_map(|parts| parts.chance.as_ref().map(|slot| slot.value)).collect(),
            };
            let (day, _) = a.one(as_moment)?;
            let (first, then) = (*chances.first()?, *chances.get(1)?);
            let front = both.first().cloned().unwrap_or_default();
            let chance = a.slot(Chance {
                chance: HabitChance { becomes: Some((then.chance.probability, day)), ..first.chance },
                ..first
            });
            parts(Parts { chance, ..front })
        },
        "becomes" => |a| {
            let then = a.one(as_parts_box)?.chance?.value;
            let (day, _) = a.one(as_moment)?;
            parts(Parts { becomes: a.slot((then.chance.probability, day)), ..Parts::default() })
        },
        "at_first" => |a| {
            let span = a.words[a.words.len() - 1].span;
            a.fault(span, TimeSentenceMessage::AtFirst);
            Some(PhraseValue::Parts(Box::default()))
        },
        "by_when" => |a| {
            let span = a.kids[1].span;
            a.fault(span, TimeSentenceMessage::ByWhen);
            Some(PhraseValue::Parts(Box::default()))
        },
        _ => return None,
    })
}

pub fn as_chance(value: &PhraseValue) -> Option<Chance> {
    match value {
        PhraseValue::Chance(chance) => Some(*chance),
        _ => None,
    }
}

fn as_parts_box(value: &PhraseValue) -> Option<Parts> {
    super::times::as_parts(value)
}

fn as_day_noun(value: &PhraseValue) -> Option<(Option<u8>, Option<PartOfDay>)> {
    match value {
        PhraseValue::DayNoun(days, part) => Some((*days, *part)),
        _ => None,
    }
}

fn of_probability(probability: f64) -> Chance {
    Chance { chance: HabitChance { quantifier: None, probability, becomes: None, days_a_week: None }, is_rate: false }
}

fn on_days(a: &mut Arguments, chance: Chance) -> Option<PhraseValue> {
    let (weekdays, part) = a.one(as_day_noun).unwrap_or_default();
    let (weekdays, part) = (weekdays.and_then(|days| a.slot(days)), part.and_then(|part| a.slot(vec![part])));
    parts(Parts { chance: a.slot(chance), weekdays, part, ..Parts::default() })
}

fn every(a: &mut Arguments, unit: f64) -> Option<PhraseValue> {
    let unit = a.number_constants().first().copied().unwrap_or(unit);
    let is_weeks = a.words.last().is_some_and(|word| ["weeks", "week"].contains(&word.text.as_str()));
    let days = a.numbers().first().copied().unwrap_or(1.0) * if is_weeks { 7.0 } else { unit };
    if days.fract() != 0.0 || !(1.0..=365.0).contains(&days) {
        let text = a.said(a.span).split_whitespace().skip(1).collect::<Vec<_>>().join(" ");
        a.fault(a.span, TimeSentenceMessage::EveryDays { text });
    }
    let part = a.one(as_part);
    if part.as_deref() == Some(&[PartOfDay::Day]) {
        return None;
    }
    let part = part.and_then(|part| a.slot(part));
    parts(Parts { every: a.slot(days.clamp(1.0, 365.0) as u32), part, ..Parts::default() })
}

/// "three times a week", "two afternoons a week".
fn rate(a: &mut Arguments) -> Option<PhraseValue> {
    let numbers = [a.numbers(), a.number_constants()].concat();
    let days = *numbers.last()?;
    let range = a.one(as_range).or(match numbers[..] {
        [from, to, _] => Some(Range { from, to, about: false }),
        [from, _] => Some(Range { from, to: from, about: false }),
        _ => None,
    })?;
    rated(a, range, days)
}

fn rated(a: &mut Arguments, range: Range, days: f64) -> Option<PhraseValue> {
    let probability = (range.from + range.to) / 2.0 / days;
    let (span, text) = (a.kids.first().map_or(a.span, |kid| kid.span), a.said(a.span));
    if probability > 1.0 {
        let is_days = a.words.iter().any(|word| ["days", "nights"].contains(&word.text.as_str()));
        match is_days {
            true => a.fault(a.span, TimeSentenceMessage::DaysAWeek { text }),
            false => a.fault(span, TimeSentenceMessage::OftenerThanDaily { text: a.said(span) }),
        }
    } else if range.to <= 0.0 {
        a.fault(span, TimeSentenceMessage::Never { text: a.said(span) });
    }
    let is_whole = range.from == range.to && (1.0..=7.0).contains(&range.from) && range.from.fract() == 0.0;
    let days_a_week = (is_whole && days == 7.0).then_some(range.from as u8);
    let chance = HabitChance { quantifier: None, probability: probability.min(1.0), becomes: None, days_a_week };
    let part = a.one(as_part).and_then(|part| a.slot(part));
    parts(Parts { chance: a.slot(Chance { chance, is_rate: true }), part, ..Parts::default() })
}

/// "Twice a night", "8 times a day".
fn count(a: &mut Arguments) -> Option<PhraseValue> {
    let range = a.one(as_range)?;
    let whole = |value: f64| value.fract() == 0.0 && (1.0..=100.0).contains(&value);
    if !(whole(range.from) && whole(range.to)) {
        let span = a.kids[0].span;
        a.fault(span, TimeSentenceMessage::Count { text: a.said(span) });
    }
    let is_night = a.words.last().is_some_and(|word| word.text == "nightly");
    let part = a.one(as_part).or(is_night.then(|| vec![PartOfDay::Night])).filter(|part| part[0] != PartOfDay::Day);
    let part = part.and_then(|part| a.slot(part));
    let times = (range.from.clamp(1.0, 100.0) as u32, range.to.clamp(1.0, 100.0) as u32);
    parts(Parts { times: a.slot(times), part, ..Parts::default() })
}
