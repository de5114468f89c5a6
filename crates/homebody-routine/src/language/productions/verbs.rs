//! Who does what.

use super::arguments::{Arguments, Production, parts};
use super::days::as_kind;
use super::numbers::{as_range, duration};
use super::times::{as_part, as_parts};
use crate::language::amounts::ABOUT_PACE_SHARE;
use crate::language::messages::{SentenceMessage, TimeSentenceMessage, WordMessage};
use crate::language::parts::Parts;
use crate::language::productions::measures::FASTEST_MPS;
use crate::language::value::{Act, PhraseValue, Range, SentenceSubject, Verb};
use crate::language::words::TextSpan;
use crate::routine::{Activity, DayKind, FallEnds, Falling, FallsFrom, Meal, ResidentKind, Shy};
use homebody_core::activity::Help;
use homebody_core::fuzzy::Fuzzy;
use homebody_core::role::Role;

/// Shortest and longest stretch of a person who rests on the way, in metres (our choice).
const SHORTEST_STRETCH_M: f64 = 1.0;
const LONGEST_STRETCH_M: f64 = 1_000.0;

pub fn named(name: &str) -> Option<Production> {
    Some(match name {
        "said" => |a| Some(PhraseValue::Name(name_of(a))),
        "named" => |a| Some(PhraseValue::Name(a.constants.join(" "))),
        "person" => |_| Some(PhraseValue::Subject(SentenceSubject::Person)),
        "visitor" => |a| {
            let name = a.name().unwrap_or_else(|| name_of(a));
            Some(PhraseValue::Subject(SentenceSubject::Visitor(name)))
        },
        "visitor_count" => |a| Some(PhraseValue::Subject(SentenceSubject::Visitor(a.spoken()))),
        "stranger" => |a| Some(PhraseValue::Subject(SentenceSubject::Stranger(a.name()?))),
        "subject" => |a| {
            Some(PhraseValue::Subject(match a.constant(0) {
                "Pulse" => SentenceSubject::Pulse,
                "Breathing" => SentenceSubject::Breathing,
                _ => SentenceSubject::Hours,
            }))
        },
        "adjective" => |a| {
            let seconds = *a.numbers().first()?;
            Some(PhraseValue::Range(Range { from: seconds, to: seconds, about: false }))
        },
        "adjective_range" => |a| {
            let numbers = a.numbers();
            let unit = *numbers.last()?;
            Some(PhraseValue::Range(Range { from: numbers[0] * unit, to: numbers[1] * unit, about: false }))
        },
        "condition" => |a| {
            let severity = a.number_constants()[0];
            Some(PhraseValue::Verb(Verb::Shows(a.name()?, severity)))
        },
        "condition_times" => |a| Some(PhraseValue::Verb(Verb::Shows(a.name()?, a.numbers()[0]))),
        "stops" => |a| Some(PhraseValue::Verb(Verb::Stops(a.numbers()[0]))),
        "shows" => |a| a.one(as_verb).map(PhraseValue::Verb),
        "verb" => |a| {
            Some(PhraseValue::Verb(match a.constant(0) {
                "Walks" => Verb::Walks,
                "Is" => Verb::Is,
                "Sleeps" => Verb::Sleeps,
                "SleepsIn" => Verb::SleepsIn,
                "Breathes" => Verb::Breathes,
                "Vary" => Verb::Vary,
                "Differ" => Verb::Differ,
                _ => Verb::Visits,
            }))
        },
        "first_verb" => |a| a.all(as_verb).pop().map(PhraseValue::Verb),
        "does" => |a| Some(PhraseValue::Verb(Verb::Does(a.act()?))),
        "act" => |a| {
            let activity = Activity::from_label(a.constant(0))?;
            Some(PhraseValue::Verb(Verb::Does(act_of(activity, a.span))))
        },
        "eats" => |_| Some(PhraseValue::Verb(Verb::Eats)),
        "not_of" => |a| {
            let activity = if a.has("GetUp") { Activity::GetUp } else { Activity::Leave };
            let act = act_of(activity, TextSpan { end: a.span.start, ..a.span });
            Some(PhraseValue::Verb(Verb::Not(act)))
        },
        "not" => |a| Some(PhraseValue::Verb(Verb::Not(a.act()?))),
        "skips" => |a| Some(PhraseValue::Verb(Verb::Skips(a.act()?))),
        "forgets_activity" => |a| {
            let act = a.act()?;
            matches!(act.activity, Activity::TakeMedicine | Activity::Eat(_))
                .then_some(PhraseValue::Verb(Verb::Skips(act)))
        },
        "forgets" => |a| Some(PhraseValue::Verb(Verb::Forgets(a.name()?))),
        "keeps_on" => |a| Some(PhraseValue::Verb(Verb::KeepsOn(a.name()?, a.has("night")))),
        "keeps_to" => |a| Some(PhraseValue::Verb(Verb::Range(a.name()?, a.has("inside")))),
        "spares" => |a| Some(PhraseValue::Verb(Verb::Spares(a.name()?))),
        "uses_for" => |a| Some(PhraseValue::Verb(Verb::Does(Act { place: a.name(), ..a.act()? }))),
        "age" => |a| {
            let age = a.numbers()[0];
            if age <= 0.0 || age > 130.0 {
                let span = TextSpan { start: a.kids[0].span.start, ..a.span };
                a.fault(span, TimeSentenceMessage::Age { text: a.said(span) });
            }
            Some(PhraseValue::Verb(Verb::Age(age)))
        },
        "a_kind" => |a| {
            Some(PhraseValue::Verb(Verb::Kind(match a.constant(0) {
                "Cat" => ResidentKind::Cat,
                "Dog" => ResidentKind::Dog,
                _ => ResidentKind::Person,
            })))
        },
        "pace" => |a| {
            let range = a.one(as_range)?;
            if !(range.from >= 0.05 && range.to <= FASTEST_MPS) {
                let span = a.kids[0].span;
                a.fault(span, TimeSentenceMessage::Pace { text: a.said(span) });
            }
            let share = if range.about { ABOUT_PACE_SHARE } else { 0.0 };
            let (low, high) = (range.from * (1.0 - share), range.to * (1.0 + share));
            Some(PhraseValue::Verb(Verb::Pace(Fuzzy { low, from: range.from, to: range.to, high })))
        },
        "rests" => |a| {
            let metres = a.numbers()[0];
            if !(SHORTEST_STRETCH_M..=LONGEST_STRETCH_M).contains(&metres) {
                let text = a.said(a.kids[0].span);
                let reason = format!("a stretch has {SHORTEST_STRETCH_M} to {LONGEST_STRETCH_M} m");
                a.fault(a.kids[0].span, SentenceMessage::DoesNotFit { text, reason });
            }
            Some(PhraseValue::Verb(Verb::Rests(metres)))
        },
        "stays" => {
            |a| Some(PhraseValue::Verb(Verb::Stays(if a.has("GetUp") { Activity::GetUp } else { Activity::GoToBed })))
        }
        "lively" => |a| {
            let very = a.words.iter().any(|word| word.text == "very") || a.has("very");
            Some(PhraseValue::Verb(Verb::Lively(a.one(as_kind).unwrap_or(DayKind::Quiet), very)))
        },
        "differ_much" => |_| Some(PhraseValue::Verb(Verb::Differ)),
        "shy" => |a| {
            Some(PhraseValue::Verb(Verb::Shy(match a.constant(0) {
                "OpenFloor" => Shy::OpenFloor,
                "People" => Shy::People,
                _ => Shy::GoingOn,
            })))
        },
        "stumbles" => |a| Some(PhraseValue::Verb(Verb::Does(act_of(Activity::Stumble, a.span)))),
        "falls" => |a| {
            let from = a.one(as_parts).and_then(|parts| parts.fall_from).map(|slot| slot.value).unwrap_or_default();
            Some(PhraseValue::Verb(Verb::Falls(Falling { from, slowly: a.has("slowly"), ..Falling::default() })))
        },
        "own_words" => |a| Some(PhraseValue::Name(a.spoken())),
        "own" => |a| Some(PhraseValue::Verb(Verb::Own(a.name()?))),
        "goes" => |_| Some(PhraseValue::Verb(Verb::Goes)),
        "speed_spread" => |a| {
            let mut numbers = a.numbers();
            let spread = numbers.pop()?;
            let (from, to) = (*numbers.first()?, *numbers.last()?);
            let pace = Fuzzy { low: from - spread, from, to, high: to + spread };
            Some(PhraseValue::Verb(Verb::Pace(pace)))
                .filter(|_| (0.05..=FASTEST_MPS).contains(&from) && to <= FASTEST_MPS)
        },
        "visited_by" => |a| Some(PhraseValue::Verb(Verb::VisitedBy(a.name()?))),
        "visitor_does" => |a| {
            let act = a.act()?;
            Some(PhraseValue::Verb(match &act.activity {
                Activity::Phone => Verb::Does(act),
                Activity::Leave | Activity::ComeHome | Activity::GetUp | Activity::GoToBed => return None,
                activity => {
                    let help = activity.row()?.help?;
                    Verb::Helps(act, help)
                }
            }))
        },
        "helps" => |a| Some(PhraseValue::Verb(Verb::Helps(a.act()?, Help::Together))),
        "helps_act" => |a| {
            let activity = Activity::from_label(a.constant(0))?;
            Some(PhraseValue::Verb(Verb::Helps(act_of(activity, a.span), Help::Together)))
        },
        "meal" => |a| {
            let meal = Meal::ALL.into_iter().find(|meal| format!("{meal:?}") == a.constant(0))?;
            Some(PhraseValue::Act(act_of(Activity::Prepare(meal), a.span)))
        },
        "brings" => |a| Some(PhraseValue::Verb(Verb::Helps(a.act()?, Help::Instead))),
        "place" => |a| {
            let name = a.name()?;
            parts(Parts { place: a.slot(name), ..Parts::default() })
        },
        "meanwhile_on" => |a| parts(Parts { thing_on: a.slot(a.name()?), ..Parts::default() }),
        "no_thing" => |a| {
            let thing = a.words.iter().find(|word| a.has(&word.text))?.text.clone();
            a.fault(a.span, WordMessage::NoThing { thing });
            parts(Parts::default())
        },
        "before_screen" => |a| {
            let name = a.name().filter(|name| Role::Television.is_called(&name.to_lowercase()))?;
            parts(Parts { thing_on: a.slot(name), ..Parts::default() })
        },
        "key" => |a| parts(Parts { key: a.slot(()), ..Parts::default() }),
        "floor" => |a| parts(Parts { floor: a.slot(()), ..Parts::default() }),
        "slowly" => |a| parts(Parts { slowly: a.slot(()), ..Parts::default() }),
        "fall_from" => |a| {
            let from = match a.constant(0) {
                "Bed" => FallsFrom::Bed,
                "Seat" => FallsFrom::Seat,
                "WayToToilet" => FallsFrom::WayToToilet,
                "Rising" => FallsFrom::Rising,
                _ => FallsFrom::Walking,
            };
            parts(Parts { fall_from: a.slot(from), ..Parts::default() })
        },
        "fall_ends" => |a| {
            let ends = match a.constant(0) {
                "Found" => FallEnds::Found,
                "Phone" => FallEnds::Phone,
                _ => FallEnds::Rises,
            };
            let finder = a.name();
            parts(Parts { fall_ends: a.slot((ends, finder)), ..Parts::default() })
        },
        "mostly" => |a| {
            let part = a.one(as_part)?[0];
            parts(Parts { mostly: a.slot(part), ..Parts::default() })
        },
        // The way of saying an activity; its place and length are among the phrases.
        "way" => |a| {
            let activity =
                Activity::from_label(a.constant(0)).unwrap_or_else(|| Activity::Other(a.constant(0).to_owned()));
            let lasts = a.one(as_range).map(duration);
            let is_place = a.has("place");
            Some(PhraseValue::Act(Act { activity, place: a.name().filter(|_| is_place), lasts, span: a.span }))
        },
        _ => return None,
    })
}

pub fn as_verb(value: &PhraseValue) -> Option<Verb> {
    match value {
        PhraseValue::Verb(verb) => Some(verb.clone()),
        _ => None,
    }
}

pub fn act_of(activity: Activity, span: TextSpan) -> Act {
    Act { activity, place: None, lasts: None, span }
}

/// The words of a name without "her" and the like in front.
fn name_of(a: &Arguments) -> String {
    const DETERMINERS: [&str; 7] = ["a", "an", "the", "her", "his", "their", "my"];
    let words = a.words.iter().map(|word| word.text.as_str()).skip_while(|word| DETERMINERS.contains(word));
    words.collect::<Vec<_>>().join(" ")
}
