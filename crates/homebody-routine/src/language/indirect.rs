//! Indirect statements of activities: likes, tendencies, duties, afternoons spent with something, inability, and help.

use super::activities;
use super::adverbs::{Adverbs, Slot};
use super::amounts::amount;
use super::measures::measure;
use super::predicate::{Predicate, named, own_words};
use super::reader::{SentenceReader, Sort, begins_adverb};
use super::remarks::remark;
use super::words::Token;
use crate::routine::{Activity, HabitChance, HabitTime, PartOfDay};
use homebody_core::fuzzy::{Fuzzy, Quantifier};

pub fn tends(reader: &mut SentenceReader) -> bool {
    reader
        .attempt(|reader| {
            let to = reader.eat("likes|like|loves|love|prefers|prefer|tends|tend to")
                || reader.eat("is|are known|inclined|prone to")
                || reader.eat("has|have a habit of")
                || reader.eat("is|are in the habit of");
            let doing = !to && reader.eat("likes|like|loves|love|enjoys|enjoy|prefers|prefer");
            let begins = |reader: &mut SentenceReader| {
                let is_gerund = reader.peek(0).ends_with("ing");
                let start = reader.at;
                reader.skip_determiners();
                let named = reader.at > start || !is_gerund;
                reader.at = start;
                match (to, doing) {
                    (true, _) => true,
                    (_, true) if is_gerund => activities::activity(reader).is_some() || own_words(reader).is_some(),
                    (_, true) if named => {
                        noun_with_adjective(reader).is_some()
                            && (reader.is_over() || reader.token(0) != Some(Token::Word) || begins_adverb(reader))
                    }
                    _ => false,
                }
            };
            reader.ahead(begins).then_some(())
        })
        .is_some()
}

/// "her crossword", "a long soak".
pub fn noun_with_adjective(reader: &mut SentenceReader) -> Option<Activity> {
    reader.skip_determiners();
    reader.attempt(activities::noun).or_else(|| {
        reader.attempt(|reader| {
            ["long", "good", "short", "little", "quick", "nice", "hot", "warm", "daily"]
                .contains(&reader.peek(0))
                .then_some(())?;
            reader.at += 1;
            activities::noun(reader)
        })
    })
}

/// Passes over "needs to" and "has to": who has to do it does it.
pub fn needs_to(reader: &mut SentenceReader) -> bool {
    reader
        .attempt(|reader| {
            let to = reader.eat("needs|need|has|have|ought to")
                || reader.eat("should|must|shall|will")
                || reader.eat("is|are advised|encouraged|supposed|expected|meant|due to")
                || reader.eat("is|are to")
                || reader.eat("continues|continue|manages|manage to")
                || reader.eat("continues|continue with");
            let does = |reader: &mut SentenceReader| {
                Adverbs::default().all(reader);
                activities::activity(reader).is_some() || activities::noun(reader).is_some()
            };
            (to && !reader.ahead(|reader| reader.eat("be")) && reader.ahead(does)).then_some(())
        })
        .is_some()
}

/// "spends the afternoon knitting", "spends most of the day in her armchair".
pub fn spends(reader: &mut SentenceReader, adverbs: &mut Adverbs) -> Option<Predicate> {
    if !reader.eat("spends|spend") {
        return None;
    }
    if let Some(found) = reader.attempt(|reader| spends_length(reader, adverbs)) {
        return Some(found);
    }
    let start = reader.at;
    let most_of_day = ["most of the day", "much of the day", "all day", "her|his|their days|day", "the day"];
    let is_day = most_of_day.iter().any(|day| reader.eat(day));
    let part = if is_day {
        None
    } else {
        let _ = reader.eat("most|much of") || reader.eat("all");
        reader.eat("the|her|his|each|every|most");
        Some(reader.eat_any(&super::times::PARTS).filter(|part| *part != PartOfDay::Night)?)
    };
    let span = reader.span(start);
    let activity = match activities::activity(reader) {
        Some(activity) => activity,
        None if reader.attempt(in_garden).is_some() => Activity::Everyday(homebody_core::activity::GARDENING),
        None => reader
            .ahead(|reader| reader.eat("in|on|at|by") && reader.name(&[Sort::Place]).is_some())
            .then_some(Activity::Relax)?,
    };
    match part {
        Some(part) => {
            let (from, to) = part.hours();
            let around = |at: f64| Fuzzy::around(at, super::times::ABOUT_TIME_S);
            adverbs.when = Some(Slot { value: HabitTime::At(around(from)), span, own: true });
            adverbs.until_time = Some(Slot { value: around(to), span, own: true });
        }
        None => {
            adverbs.times = Some(Slot { value: DAY_TIMES, span, own: true });
            adverbs.lasts = Some(Slot { value: DAY_LASTS_S, span, own: true });
            adverbs.part = Some(Slot { value: PartOfDay::Day, span, own: true });
        }
    }
    Some(Predicate::Does(activity))
}

/// "spends an hour a day on the phone", "spends hours at the window watching the birds".
fn spends_length(reader: &mut SentenceReader, adverbs: &mut Adverbs) -> Option<Predicate> {
    /// "Hours" are so many (ours).
    const HOURS_S: Fuzzy = Fuzzy { low: 5_400.0, from: 7_200.0, to: 10_800.0, high: 12_600.0 };
    let from = reader.at;
    let length = if reader.eat("hours|ages") {
        HOURS_S
    } else {
        amount(reader).filter(|amount| amount.unit == super::amounts::AmountUnit::Second)?.as_duration()
    };
    let span = reader.span(from);
    let mut rest = adverbs.clone();
    rest.all(reader);
    let at_place = reader.attempt(|reader| {
        (reader.eat("in|on|at|by") && reader.name(&[Sort::Place, Sort::Room]).is_some()).then_some(())
    });
    let activity = match reader.attempt(activities::activity) {
        Some(activity) => activity,
        None if at_place.is_some() => return None,
        None => {
            reader.eat("on|with|at").then_some(())?;
            activities::event(reader)?
        }
    };
    rest.lasts.get_or_insert(Slot { value: length, span, own: true });
    *adverbs = rest;
    Some(Predicate::Does(activity))
}

fn in_garden(reader: &mut SentenceReader) -> Option<()> {
    reader.eat("in|on|at").then_some(())?;
    reader.skip_determiners();
    reader.eat("garden|greenhouse|allotment|yard|patio").then_some(())
}

/// Number of periods of an activity that takes most of the day (our choice): meals and the toilet come between them.
const DAY_TIMES: (u32, u32) = (4, 4);
const DAY_LASTS_S: Fuzzy = Fuzzy { low: 5_400.0, from: 7_200.0, to: 7_200.0, high: 9_000.0 };

/// "tends not to eat breakfast": mostly it is left out.
pub fn tends_not(reader: &mut SentenceReader, adverbs: &mut Adverbs) -> Option<Predicate> {
    let from = reader.at;
    if !(reader.eat("tends|tend|prefers|prefer|likes|like not to")) {
        return None;
    }
    let span = reader.span(from);
    let activity = activities::activity(reader)?;
    adverbs.chance.get_or_insert(Slot { value: HabitChance::from_quantifier(Quantifier::Most), span, own: true });
    Some(Predicate::Skips(activity))
}

/// "falls asleep": for the night where it is late, else a nap.
pub fn falls_asleep(reader: &mut SentenceReader, adverbs: &Adverbs) -> Option<Predicate> {
    /// Hours of the evening after which it is late, and of the morning before which it is (our choice).
    const LATE_S: f64 = 20.0 * 3600.0;
    const EARLY_S: f64 = 5.0 * 3600.0;
    let is_asleep = |reader: &mut SentenceReader| {
        reader.eat("is|are").then_some(())?;
        Adverbs::default().all(reader);
        reader.eat("asleep|dozing|snoozing|napping").then_some(())
    };
    let falls = reader.eat("falls|fall|falling|drifts|drift asleep|off") || reader.attempt(is_asleep).is_some();
    if !falls || reader.ahead(|reader| reader.eat("in front")) {
        return None;
    }
    let mut rest = adverbs.clone();
    let has_place = reader.ahead(|reader| {
        rest.all(reader);
        reader.eat("in|on|at") && reader.name(&[Sort::Place]).is_some()
    });
    let is_late = match rest.when.as_ref().map(|slot| &slot.value) {
        Some(HabitTime::At(at)) => at.from >= LATE_S || at.from < EARLY_S,
        _ => false,
    };
    match (has_place, is_late, rest.part.as_ref().map(|slot| slot.value)) {
        (false, true, _) => Some(Predicate::Does(Activity::GoToBed)),
        (true, false, _)
        | (_, false, Some(PartOfDay::Morning | PartOfDay::Afternoon | PartOfDay::Evening | PartOfDay::Day)) => {
            Some(Predicate::Does(Activity::Nap))
        }
        _ => None,
    }
}

/// "is visited by a nurse": who comes.
pub fn visited(reader: &mut SentenceReader) -> Option<Predicate> {
    if !(reader.eat("is|are visited|seen") && reader.eat("by")) {
        return None;
    }
    reader.skip_determiners();
    named(reader).map(Predicate::VisitedBy)
}

/// "takes an hour to get dressed".
pub fn takes_long(reader: &mut SentenceReader, adverbs: &mut Adverbs) -> Option<Predicate> {
    reader.eat("takes|take|needs|need").then_some(())?;
    let from = reader.at;
    let length = amount(reader).filter(|amount| amount.unit == super::amounts::AmountUnit::Second)?;
    let span = reader.span(from);
    reader.eat("to|over").then_some(())?;
    let activity = activities::event(reader)?;
    adverbs.lasts.get_or_insert(Slot { value: length.as_duration(), span, own: true });
    Some(Predicate::Does(activity))
}

/// "rarely has visitors".
pub fn has_visitors(reader: &mut SentenceReader) -> Option<Predicate> {
    let from_whom = reader.attempt(|reader| {
        reader.eat("has|have|receives|receive|gets|get").then_some(())?;
        reader.eat("regular|daily|weekly|frequent|a");
        reader.eat("visits|visit from|by").then_some(())?;
        reader.skip_determiners();
        named(reader).map(Predicate::VisitedBy)
    });
    // "has carers four times a day"
    let with_carers = reader.attempt(|reader| {
        reader.eat("has|have").then_some(())?;
        reader.skip_determiners();
        let start = reader.at;
        let lexicon = reader.names.lexicon.clone();
        reader.at += lexicon.list("PEOPLE", |ahead| reader.peek(ahead))?;
        reader.ahead(|reader| Adverbs::default().next(reader)).then(|| Predicate::VisitedBy(reader.passed(start)))
    });
    if with_carers.is_some() {
        return with_carers;
    }
    if from_whom.is_some() {
        return from_whom;
    }
    (reader.eat("has|have") && (reader.eat("few|regular|many"), reader.eat("visitors|company|guests")).1)
        .then(|| Predicate::VisitedBy("visitor".to_owned()))
}

/// "is helped with washing", "is given her pills", "is toileted": it is done, by whom may follow.
pub fn cared(reader: &mut SentenceReader) -> Option<Predicate> {
    reader.eat("is|are").then_some(())?;
    let _ = reader.eat("being") || reader.eat("always|usually|often");
    if reader.eat("given|administered|offered") {
        let adjective = |reader: &mut SentenceReader| {
            reader.skip_determiners();
            reader.at += 1;
            activities::noun(reader)
        };
        reader.skip_determiners();
        return reader.attempt(activities::noun).or_else(|| reader.attempt(adjective)).map(Predicate::Does);
    }
    if reader.eat("helped|assisted|supported|supervised|encouraged|prompted|reminded") {
        reader.eat("with|to|in|into");
        return activities::event(reader).map(Predicate::Does);
    }
    let done = [
        ("washed|cleaned", Activity::Wash),
        ("bathed|showered", Activity::Shower),
        ("dressed|undressed", Activity::Dress),
        ("toileted", Activity::UseBathroom),
        ("weighed", Activity::Everyday(homebody_core::activity::CHECKING_HEALTH)),
    ];
    let found = done.into_iter().find(|(said, _)| reader.eat(said)).map(|(_, activity)| activity)?;
    Some(Predicate::Does(found))
}

/// "cannot cook", "is unable to wash": what is not done.
pub fn unable(reader: &mut SentenceReader) -> Option<Predicate> {
    let not = reader.eat("cannot|can't")
        || reader.eat("can not")
        || reader.eat("can no longer")
        || reader.eat("is|are unable to")
        || reader.eat("is|are not able to")
        || reader.eat("is|are no longer able to")
        || reader.eat("refuses|refuse to");
    if !not { None } else { activities::activity(reader).map(Predicate::Not) }
}

/// "does not finish her lunch".
pub fn unfinished(reader: &mut SentenceReader) -> Option<Predicate> {
    let not = reader.eat("does|do not finish") || reader.eat("doesn't|don't finish") || reader.eat("rarely finishes");
    if !not { None } else { activities::event(reader).map(Predicate::Unfinished) }
}

/// "needs help from her daughter to wash": somebody comes for it.
pub fn is_helped(reader: &mut SentenceReader) -> Option<Predicate> {
    let help = "help|assistance|support|supervision";
    if !(reader.eat("needs|need|requires|require|gets|get|receives|receive|has|have") && reader.eat(help)) {
        return None;
    }
    let from = |reader: &mut SentenceReader| -> Option<String> {
        if !reader.eat("from|of") {
            return None;
        }
        reader.skip_determiners();
        named(reader)
    };
    let before = reader.attempt(from);
    if !reader.eat("with|to|in") {
        return None;
    }
    let activity = activities::event(reader)?;
    let who = before.or_else(|| reader.attempt(from))?;
    Some(Predicate::HelpedBy(who, activity))
}

pub fn is_doing(reader: &mut SentenceReader, adverbs: &mut Adverbs) -> Option<Activity> {
    // "is up twice a night for the toilet".
    let mut rest = adverbs.clone();
    let up_for = reader.attempt(|reader| {
        reader.eat("is|are").then_some(())?;
        rest.all(reader);
        reader.eat("up").then_some(())?;
        rest.all(reader);
        let toilet = reader.eat("for") && {
            reader.skip_determiners();
            reader.eat("toilet|bathroom|loo|commode|wee")
        };
        if toilet {
            return Some(Activity::UseBathroom);
        }
        reader.eat("to").then_some(())?;
        activities::activity(reader)
    });
    if let Some(activity) = up_for {
        *adverbs = rest;
        return Some(activity);
    }
    // "is usually up by 7:00", "is asleep by 23:00".
    let mut rest = adverbs.clone();
    let by_clock = reader.attempt(|reader| {
        reader.eat("is|are|be").then_some(())?;
        rest.all(reader);
        let state = reader.eat_any(&[("up", true), ("out of bed", true), ("asleep", false), ("in bed", false)])?;
        ["by", "at", "before", "around", "until", "from"].contains(&reader.peek(0)).then_some(state)
    });
    if let Some(is_up) = by_clock.filter(|_| !reader.ahead(|reader| reader.eat("at night"))) {
        *adverbs = rest;
        return Some(if is_up { Activity::GetUp } else { Activity::GoToBed });
    }
    activities::activity(reader)
}

pub fn is_remark(reader: &mut SentenceReader) -> Option<()> {
    if reader.ahead(|reader| {
        reader.eat("is|are")
            && (amount(reader).is_some() || measure(reader).is_some() || {
                reader.skip_determiners();
                reader.eat("cat|dog|person|woman|man|lady|gentleman|human")
            })
    }) {
        return None;
    }
    remark(reader)
}
