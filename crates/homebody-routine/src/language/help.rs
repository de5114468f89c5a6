//! The activities of visitors: with the person, or instead of them.

use super::activities::{self, activity, event};
use super::adverbs::Adverbs;
use super::person_word::person_called;
use super::predicate::Predicate;
use super::reader::SentenceReader;
use super::visits::visits;
use super::words::Token;
use crate::routine::{Activity, Meal};
use homebody_core::activity::Help;

pub fn visiting(reader: &mut SentenceReader) -> Option<Predicate> {
    let from = reader.at;
    if visits(reader) {
        let comes_to_help = reader.passed(from).contains("help");
        let more = reader.attempt(|reader| match comes_to_help {
            true => helped(reader),
            false if reader.eat("for") => meal_shared(reader),
            false => reader.eat("to|and").then_some(()).and_then(|()| doing(reader)),
        });
        return Some(more.unwrap_or(Predicate::Visits));
    }
    reader.attempt(doing)
}

/// "does her legs", "fills her pill box": whatever it is, who does it is there.
pub fn seeing_to(reader: &mut SentenceReader) -> Option<Predicate> {
    const MOST: usize = 7;
    reader.attempt(|reader| {
        let from = reader.at;
        let lexicon = reader.names.lexicon.clone();
        reader.at += lexicon.list("SEEING", |ahead| reader.peek(ahead))?;
        while reader.token(0) == Some(Token::Word)
            && !(reader.ahead(|reader| Adverbs::default().next(reader))
                || ["and", "but", "or"].contains(&reader.peek(0)))
            && reader.at < from + MOST
        {
            reader.at += 1;
        }
        // At which time, or how often, says that they come.
        let mut more = Adverbs::default();
        let comes = reader.ahead(|reader| more.next(reader));
        (reader.at > from + 1 && (comes || reader.is_over())).then_some(Predicate::Visits)
    })
}

/// "for coffee", "for Sunday lunch".
pub fn meal_shared(reader: &mut SentenceReader) -> Option<Predicate> {
    reader.skip_determiners();
    if reader.eat("chat|talk|gossip|visit|tea|coffee|drink") || reader.eat("cup of tea|coffee") {
        return Some(Predicate::Visits);
    }
    let meal = activities::MEALS.into_iter().find(|(name, _)| reader.eat(name))?.1;
    Some(Predicate::Helps(Activity::Eat(meal), Help::Together))
}

/// "help her wash", "cook dinner", "take her to church": whatever the form of the verb.
pub fn doing(reader: &mut SentenceReader) -> Option<Predicate> {
    if reader
        .attempt(|reader| ((reader.eat("checks|check on") || reader.eat("sees|see")) && person(reader)).then_some(()))
        .is_some()
        || reader.attempt(|reader| (reader.eat("see|keep|sits|sit with") && person(reader)).then_some(())).is_some()
    {
        return Some(Predicate::Visits);
    }
    for read in [helping, giving, taking, bringing, handling, other] {
        if let Some(found) = reader.attempt(read) {
            return Some(found);
        }
    }
    None
}

fn person(reader: &mut SentenceReader) -> bool {
    reader.eat("her|him|them|me") || person_called(reader) || reader.person() == Some(false)
}

fn helping(reader: &mut SentenceReader) -> Option<Predicate> {
    let helps = reader.eat("helps|help|assists|assist|supports|support|supervises|supervise");
    if !helps {
        return None;
    }
    person(reader);
    Some(helped(reader).unwrap_or(Predicate::Visits))
}

/// "wash", "with her shower", "to get dressed".
fn helped(reader: &mut SentenceReader) -> Option<Predicate> {
    reader.attempt(|reader| {
        reader.eat("with|to|in");
        event(reader).map(|activity| Predicate::Helps(activity, Help::Together))
    })
}

/// "gives her her medication", "reminds her to take her pills".
fn giving(reader: &mut SentenceReader) -> Option<Predicate> {
    if !reader.eat("gives|give|administers|administer|reminds|remind|prompts|prompt") {
        return None;
    }
    if !reader.ahead(|reader| reader.eat("her|his|their") && activities::noun(reader).is_some()) {
        person(reader);
    }
    reader.eat("to|about|with");
    // A hot lunch is one, and a warm bath too.
    let adjective = |reader: &mut SentenceReader| {
        reader.skip_determiners();
        reader.at += 1;
        activities::noun(reader)
    };
    let activity = reader.attempt(event).or_else(|| reader.attempt(adjective))?;
    Some(Predicate::Helps(activity, Help::Together))
}

/// "takes her to church", "drives her to the doctor", "takes her out for lunch".
fn taking(reader: &mut SentenceReader) -> Option<Predicate> {
    let takes = "takes|take|drives|drive|accompanies|accompany|brings|bring|walks|walk|collects|collect";
    let picks_up = reader.eat("picks|pick") && person(reader) && reader.eat("up");
    if !(picks_up || reader.eat(takes) && person(reader)) {
        return None;
    }
    if reader.eat("home|back") {
        return Some(Predicate::Does(Activity::ComeHome));
    }
    let out = reader.eat("out");
    let somewhere = |reader: &mut SentenceReader| {
        reader.eat("shopping|swimming|dancing").then_some(()).or_else(|| {
            reader.eat("to|for|on").then_some(())?;
            reader.skip_determiners();
            (0..=2).find_map(|_| {
                let lexicon = reader.names.lexicon.clone();
                let length = lexicon.list("OUTSIDE", |ahead| reader.peek(ahead)).or_else(|| {
                    ["lunch", "dinner", "coffee", "meal", "ride", "house", "outing", "appointment", "appointments"]
                        .contains(&reader.peek(0))
                        .then_some(1)
                });
                reader.at += length.unwrap_or(1);
                length.map(|_| ())
            })
        })
    };
    let somewhere = reader.attempt(somewhere).is_some();
    (out || somewhere || picks_up).then_some(Predicate::Does(Activity::Leave))
}

/// "brings her lunch", "delivers her shopping".
fn bringing(reader: &mut SentenceReader) -> Option<Predicate> {
    let verb = reader.eat("brings|bring|delivers|deliver|provides|provide|supplies") || reader.eat("drops|drop off");
    if !verb {
        return None;
    }
    reader.eat("in|round|over|along|up");
    let _ = reader.attempt(|reader| (person(reader) && !reader.is_over()).then_some(()));
    for _ in 0..3 {
        reader.skip_determiners();
        for meal in Meal::ALL {
            let name = activities::MEALS.iter().find(|(_, known)| *known == meal).map_or("", |(name, _)| *name);
            if reader.eat(name) {
                return Some(Predicate::Helps(Activity::Prepare(meal), Help::Instead));
            }
        }
        let goods = "shopping|groceries|food|medicine|medication|medicines|pills|newspaper|paper|mail|post|laundry|meal|meals|\
             milk|prescription|prescriptions|tablets";
        if reader.eat(goods) {
            return Some(Predicate::Visits);
        }
        reader.at += 1;
    }
    None
}

/// "washes her", "puts her to bed", "gets her dressed".
fn handling(reader: &mut SentenceReader) -> Option<Predicate> {
    let to_bed = |reader: &mut SentenceReader| {
        (reader.eat("puts|put|helps|help") && person(reader) && (reader.eat("to|into bed"))).then_some(())
    };
    if reader.attempt(to_bed).is_some() {
        return Some(Predicate::Helps(Activity::GoToBed, Help::Together));
    }
    if reader.eat("gets|get") && person(reader) {
        let up = reader.eat("up");
        let done = if up && !reader.ahead(|reader| reader.eat("and dressed")) {
            Activity::GetUp
        } else if reader.eat("dressed|ready|changed") || reader.eat("ready for bed") || up && reader.eat("and dressed")
        {
            Activity::Dress
        } else {
            return None;
        };
        return Some(Predicate::Helps(done, Help::Together));
    }
    let known = [
        ("washes|wash", Activity::Wash),
        ("bathes|bathe|showers|shower|baths|bath", Activity::Shower),
        ("dresses|dress|undresses|undress", Activity::Dress),
        ("toilets|toilet", Activity::UseBathroom),
    ];
    let found = known.into_iter().find_map(|(verbs, activity)| {
        reader.attempt(|reader| (reader.eat(verbs) && person(reader)).then_some(())).map(|()| activity)
    });
    found.map(|activity| Predicate::Helps(activity, Help::Together))
}

fn other(reader: &mut SentenceReader) -> Option<Predicate> {
    let from = reader.at;
    let found = activity(reader)?;
    let with_whom = reader.passed(from);
    let with_whom = ["her", "him", "them"].iter().any(|whom| with_whom.ends_with(&format!(" {whom}")));
    let mut at_person = |preposition: &str| {
        reader.attempt(|reader| (reader.eat(preposition) && person(reader)).then_some(())).is_some()
    };
    let (for_person, with_person) = (at_person("for"), at_person("with|to") || with_whom);
    let buys = |said: String| {
        ["shop", "errand", "grocer", "prescription", "pension", "food", "bread", "post", "mail"]
            .iter()
            .any(|word| said.contains(word))
    };
    match found {
        Activity::Phone => Some(Predicate::Does(Activity::Phone)),
        Activity::Leave if with_person => Some(Predicate::Does(Activity::Leave)),
        Activity::Leave if for_person || buys(reader.passed(from)) => Some(Predicate::Visits),
        Activity::Leave | Activity::ComeHome | Activity::GetUp | Activity::GoToBed => None,
        _ => {
            let is_shared = (with_person || for_person).then_some(Help::Together);
            let help = found.row().and_then(|row| row.help).or(is_shared)?;
            Some(Predicate::Helps(found, help))
        }
    }
}
