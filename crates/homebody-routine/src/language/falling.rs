//! Falls: from what, how slowly, and what becomes of it: "falls on the way to the bathroom, and lies there until somebody comes".

use super::adverbs::Adverbs;
use super::clause::Clause;
use super::messages::TimeSentenceMessage;
use super::predicate::Predicate;
use super::reader::{SentenceReader, begins_adverb};
use super::times;
use super::words::{TextSpan, Token};
use crate::routine::{Activity, FallEnds, Falling, FallsFrom, HabitTime, PartOfDay};

const BED: &str = "bed";
const SEAT: &str = "chair|armchair|recliner|sofa|seat|couch|wheelchair";
const TOILET: &str = "bathroom|toilet|loo|commode";
const COMES: &str = "comes|come|visits|visit|arrives|arrive|helps|calls|call";
const ANYBODY: &str = "somebody|someone|anybody|anyone|help";

pub fn falls(reader: &mut SentenceReader) -> Option<Predicate> {
    if let Some(found) = reader.attempt(nearly) {
        return Some(found);
    }
    reader.attempt(|reader| {
        let start = reader.at;
        let slips = reader.eat("slips|slip|rolls|roll");
        let slowly = !slips && reader.eat("slides|slide|sinks|sink|slumps|slump");
        if !(slips || slowly) {
            return None;
        }
        reader.eat("slowly");
        reader.eat("down");
        let plain = Falling { slowly, ..Falling::default() };
        let is_down =
            reader.passed(start).ends_with("down") && !reader.ahead(|reader| reader.eat("in|into|on|onto|to|at"));
        if slowly && (floor(reader) || is_down) {
            return Some(Predicate::Falls(plain));
        }
        let from = out_of(reader)?;
        floor(reader);
        Some(Predicate::Falls(Falling { from, ..plain }))
    })
}

/// "nearly falls", "stumbles but does not fall".
fn nearly(reader: &mut SentenceReader) -> Option<Predicate> {
    let stumbles = Some(Predicate::Does(Activity::Stumble));
    if reader.eat("nearly|almost falls|fall|trips|trip|slips|slip") {
        reader.eat("over|down");
        return stumbles;
    }
    reader.eat("stumbles|stumble|trips|trip|staggers|stagger").then_some(())?;
    reader.eat("and|but");
    let catches = reader.eat("does|do not fall")
        || reader.eat("doesn't|don't fall")
        || reader.eat("catches|catch herself|himself|themselves");
    if catches { stumbles } else { None }
}

pub fn says_fall(reader: &mut SentenceReader, clause: &mut Clause) -> bool {
    let mut falling = match clause.predicate {
        Predicate::Does(Activity::Fall) => Falling::default(),
        Predicate::Falls(falling) => falling,
        _ => return false,
    };
    let (mostly_then, bed) = (mostly_before(reader, clause), in_bed(reader, clause));
    falling.mostly = mostly_then.or(falling.mostly);
    falling.from = bed.unwrap_or(falling.from);
    let is_before = mostly_then.is_some() || bed.is_some();
    let found = is_before.then_some(()).or_else(|| {
        reader.attempt(|reader| {
            reader.skip_commas();
            let found = from(reader, &mut falling) || mostly(reader, &mut falling);
            (found || lies(reader, &mut falling, &mut clause.finder)).then_some(())
        })
    });
    if found.is_some() {
        clause.predicate = Predicate::Falls(falling);
    }
    found.is_some()
}

fn from(reader: &mut SentenceReader, falling: &mut Falling) -> bool {
    if floor(reader) {
        return true;
    }
    if reader.eat("slowly") {
        falling.slowly = true;
        return true;
    }
    let found = reader.attempt(|reader| {
        let way = reader.eat("on the|her|his|their way to|from") || reader.eat("on way to|from");
        if way {
            reader.skip_determiners();
            return reader.eat(TOILET).then_some(FallsFrom::WayToToilet);
        }
        if let Some(from) = out_of(reader) {
            return Some(from);
        }
        let while_ = reader.eat("while|when|as");
        if while_ {
            let _ = reader.eat("she|he|they is|are") || reader.eat("she|he|they");
        }
        if while_ && reader.eat("walking|walks|walk") {
            return Some(FallsFrom::Walking);
        }
        let rises = reader.eat("getting|gets|get|standing|stands|stand up") || reader.eat("rising|rises|rise");
        if rises {
            return Some(out_of(reader).filter(|from| *from == FallsFrom::Bed).unwrap_or(FallsFrom::Rising));
        }
        reader.eat("getting|gets|get").then_some(())?;
        Some(if out_of(reader)? == FallsFrom::Bed { FallsFrom::Bed } else { FallsFrom::Rising })
    });
    falling.from = found.unwrap_or(falling.from);
    found.is_some()
}

/// "out of bed", "from her chair".
fn out_of(reader: &mut SentenceReader) -> Option<FallsFrom> {
    reader.attempt(|reader| {
        (reader.eat("out of") || reader.eat("from|off")).then_some(())?;
        reader.skip_determiners();
        if reader.eat(BED) {
            return Some(FallsFrom::Bed);
        }
        reader.eat(SEAT).then_some(FallsFrom::Seat)
    })
}

/// "She falls in bed": out of it.
fn in_bed(reader: &SentenceReader, clause: &mut Clause) -> Option<FallsFrom> {
    let said = clause.place.as_ref().map(|(_, span)| reader.said(*span).to_lowercase())?;
    (said.starts_with("in ") && said.ends_with(" bed")).then_some(())?;
    clause.place = None;
    Some(FallsFrom::Bed)
}

/// "Mostly at night she falls", "she usually falls at night": what stood before is when it mostly is, not how often.
fn mostly_before(reader: &SentenceReader, clause: &mut Clause) -> Option<PartOfDay> {
    let adverbs = &mut clause.adverbs;
    let is_mostly =
        |span: TextSpan| ["mostly", "usually", "normally"].contains(&reader.said(span).to_lowercase().as_str());
    let chance = adverbs.chance.as_ref().filter(|chance| chance.own && is_mostly(chance.span));
    let begins = chance?.span.end;
    let part = adverbs.part.as_ref().filter(|part| part.own && begins <= part.span.start)?.value;
    (adverbs.chance, adverbs.part) = (None, None);
    Some(part)
}

pub fn time_of_fall(reader: &mut SentenceReader, clause: &Clause, when: HabitTime) -> HabitTime {
    let Predicate::Falls(falling) = clause.predicate else { return when };
    if falling.mostly.is_none() {
        return if falling.from == FallsFrom::Bed && when == HabitTime::AnyTime {
            HabitTime::Within(PartOfDay::Night)
        } else {
            when
        };
    }
    let adverbs = &clause.adverbs;
    let times = [adverbs.when.as_ref().map(|slot| slot.span), adverbs.part.as_ref().map(|slot| slot.span)];
    // Of a clause that is joined with this one it is no matter.
    let own = |span: &TextSpan| clause.span.start <= span.start && span.end <= clause.span.end;
    if let Some(span) = times.into_iter().flatten().find(own) {
        reader.fault(span, TimeSentenceMessage::TwoTimesOfFall { text: reader.said(span) });
    }
    HabitTime::AnyTime
}

/// "mostly at night".
fn mostly(reader: &mut SentenceReader, falling: &mut Falling) -> bool {
    let part = reader.attempt(|reader| {
        reader.eat("mostly|mainly|usually").then_some(())?;
        if reader.eat("in|during") {
            reader.skip_determiners();
        } else {
            reader.eat("at|by").then_some(())?;
        }
        reader.eat_any(&times::PARTS)
    });
    falling.mostly = part.or(falling.mostly);
    part.is_some()
}

fn floor(reader: &mut SentenceReader) -> bool {
    reader.eat("to|onto|on the floor|ground") || reader.eat("to|onto|on floor|ground")
}

/// "and lies there until somebody comes".
fn lies(reader: &mut SentenceReader, falling: &mut Falling, finder: &mut Option<(String, TextSpan)>) -> bool {
    let joined = reader.eat("and");
    reader.skip_commas();
    reader.eat("then");
    if reader.eat("gets|get up") || reader.eat("rises|rise") {
        reader.eat("again");
        let _ = reader.eat("by herself|himself|themselves")
            || reader.eat("on her|his|their own")
            || reader.eat("without help")
            || reader.eat("alone");
        falling.ends = FallEnds::Rises;
        return joined;
    }
    if reader.eat("crawls|crawl to the phone|telephone") {
        falling.ends = FallEnds::Phone;
        return joined;
    }
    if reader.eat("cannot|can't get up") || reader.eat("is|are unable to get up") {
        falling.ends = FallEnds::Found;
        reader.eat("again");
        reader.eat("alone");
        return joined;
    }
    if joined && reader.eat("is|are found") {
        let _ = reader.eat("there") || floor(reader);
        if reader.eat("by") && !reader.eat(ANYBODY) {
            *finder = somebody(reader);
            if finder.is_none() {
                return false;
            }
        }
        falling.ends = FallEnds::Found;
        is_of_whom(reader);
        return true;
    }
    if joined {
        let lies = reader.eat("lies|lie|stays|stay|remains|remain");
        let there = reader.eat("there") || floor(reader);
        reader.eat("still");
        let lasts = reader.ahead(|reader| reader.eat("for|until|till"));
        if !(lies && (there || lasts)) {
            return false;
        }
    }
    let until = reader.attempt(|reader| until(reader, finder));
    falling.ends = until.unwrap_or(falling.ends);
    joined || until.is_some()
}

/// "until somebody comes", "until her daughter finds her", "until she reaches the phone".
fn until(reader: &mut SentenceReader, finder: &mut Option<(String, TextSpan)>) -> Option<FallEnds> {
    reader.eat("until|till").then_some(())?;
    if reader.eat("found|helped") || reader.eat("she|he|they is|are found|helped") {
        reader.eat("up");
        return Some(FallEnds::Found);
    }
    if reader.eat("she|he|they") {
        let reaches =
            reader.eat("reaches|reach") || reader.eat("gets|get|crawls|crawl to") || reader.eat("has|have reached");
        reaches.then_some(())?;
        reader.skip_determiners();
        return reader.eat("phone|telephone").then_some(FallEnds::Phone);
    }
    let who = if reader.eat(ANYBODY) { None } else { Some(somebody(reader)?) };
    let came = reader.eat("finds|find|helps|help her|him|them") || reader.eat(COMES);
    came.then_some(())?;
    reader.eat("up");
    *finder = who;
    is_of_whom(reader);
    Some(FallEnds::Found)
}

/// "her daughter", up to what she does.
fn somebody(reader: &mut SentenceReader) -> Option<(String, TextSpan)> {
    const MOST: usize = 4;
    let begin = reader.at;
    reader.skip_determiners();
    let from = reader.at;
    let ends = |reader: &mut SentenceReader| {
        reader.token(0) != Some(Token::Word)
            || begins_adverb(reader)
            || reader.eat("and|but|or|then|finds|find|help")
            || reader.eat(COMES)
    };
    while reader.at < from + MOST && !reader.ahead(ends) {
        reader.at += 1;
    }
    (reader.at > from).then(|| (reader.passed(from), reader.span(begin)))
}

fn is_of_whom(reader: &mut SentenceReader) {
    let from = reader.at;
    let mut time = Adverbs::default();
    let says_time = |time: &Adverbs| time.when.is_some() || time.part.is_some();
    if reader.ahead(|reader| time.next(reader)) && says_time(&time) {
        Adverbs::default().next(reader);
        let span = reader.span(from);
        reader.at = reader.words.len();
        reader.fault(span, TimeSentenceMessage::WhoseTime { text: reader.said(span) });
    }
}
