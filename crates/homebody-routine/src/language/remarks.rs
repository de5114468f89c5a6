//! What somebody is, has or likes: understood as a remark, which is kept and not lived.
//!
//! Only what is clearly no action is one: its verb says a state, and nothing in it names an activity or a time. A sentence
//! that might be lived is never a remark.

use super::activities;
use super::adverbs::Adverbs;
use super::amounts::number;
use super::lexicon::third_person;
use super::person_word::person_called;
use super::reader::{SentenceReader, Sort, is_beginning, is_determiner};
use super::visits::visits;
use super::words::Token;

#[derive(Clone, Copy, PartialEq, Eq)]
enum Rest {
    Plain,
    Any,
}

const STATES: &[(&str, Rest)] = &[
    ("used to", Rest::Any),
    ("worked|lived|moved|retired|died|married|emigrated|raised|fell|broke|served", Rest::Any),
    ("never married", Rest::Any),
    ("gave up", Rest::Any),
    ("is|are independent|dependent", Rest::Any),
    ("grew up", Rest::Any),
    ("had", Rest::Any),
    ("was|were", Rest::Any),
    ("has|have withdrawn|retired|resigned|given|moved|grown|developed|learned|learnt", Rest::Any),
    ("needs|need|takes|take more|longer|extra time", Rest::Any),
    ("does|do not go upstairs|downstairs|abroad", Rest::Any),
    ("refuses|refuse|declines|accepts personal", Rest::Any),
    ("refuses|refuse|declines|accepts|resists help|care|support|assistance|treatment", Rest::Any),
    ("has|have declined|deteriorated|improved|worsened|changed|fallen|broken|stayed|remained|been", Rest::Any),
    ("can|cannot|can't|could|couldn't", Rest::Any),
    ("would rather|sooner", Rest::Any),
    ("wants|want|wishes|hopes", Rest::Any),
    ("would like|love", Rest::Any),
    ("misses|miss her|him|them|home|company", Rest::Any),
    ("fears|worries|worry|dreads", Rest::Any),
    ("is|are afraid|scared|frightened|fearful|worried|anxious|fond|proud", Rest::Any),
    ("needs|need|requires|require help|assistance|support|supervision|prompting|reminding|encouragement", Rest::Any),
    ("needs|need to be reminded|prompted|encouraged|helped|supervised", Rest::Any),
    ("needs|need a lot of help", Rest::Any),
    ("has|have difficulty|trouble|problems", Rest::Any),
    ("has|have no|some|great|much difficulty|trouble|problems", Rest::Any),
    ("struggles|struggle", Rest::Any),
    ("finds|find it hard|difficult", Rest::Any),
    ("relies|rely|depends|depend on", Rest::Plain),
    ("needs|need|requires|require", Rest::Plain),
    ("likes|like|loves|love|enjoys|enjoy|prefers|prefer|dislikes|dislike|hates|hate", Rest::Plain),
    ("feels|feel|seems|seem|appears|appear", Rest::Plain),
    ("believes|believe|thinks|think|knows|know|understands|understand|remembers|remember|trusts|trust", Rest::Plain),
    ("owns|own|weighs|weigh|lacks|lack|values|value|hears|hear|sees|see|wears|wear|misses|miss", Rest::Plain),
    ("lives|live", Rest::Plain),
    ("works|work as", Rest::Plain),
    ("suffers|suffer from", Rest::Plain),
    ("identifies|identify as", Rest::Plain),
    ("has|have lost|gained|become|undergone|suffered|had|never", Rest::Plain),
];

const NOT_SO: &str = "like|want|understand|know|remember|see|hear|believe|speak|need|feel|have|recognise|recognize|trust|mind|seem|own|join|\
    participate|engage|socialise|socialize|mix|drive|climb|manage|cope|complain|smoke|initiate|respond";

const BEHAVIOUR: &str = "out|away|up|awake|asleep|back|off|outside|outdoors|indoors|inside|upstairs|downstairs|home|busy|here|there|\
    to|in|on|at|by|with|for|from|until|after|before|less|more|taken|driven|visited|helped|washed|fed|seen|given|put|often|active|\
    restless|agitated|slower|faster|later|earlier|unwell|ill|sick|gone|going";

pub fn remark(reader: &mut SentenceReader) -> Option<()> {
    reader.attempt(|reader| {
        let from = reader.at;
        let rest = state(reader)?;
        if reader.is_over()
            && reader.at < from + 2
            && reader.ahead(|reader| {
                reader.at = from;
                reader.names.lexicon.list("VOICES", |ahead| reader.peek(ahead)).is_none()
            })
        {
            return None;
        }
        to_the_end(reader, rest)
    })
}

/// "are hoping she can stay": what somebody who writes of her thinks.
pub fn of_mind(reader: &mut SentenceReader) -> bool {
    let thinks = reader
        .eat("are|am|have|hope|think|worry|feel|believe|want|would|wish|know|find|need|cannot|can|do|had|were|was");
    if thinks {
        reader.at = reader.words.len();
    }
    thinks
}

/// "Nobody visits", "no allergies", "years ago she walked to work": nothing that is lived now.
pub fn of_nobody_or_past(reader: &mut SentenceReader) -> bool {
    let is_none =
        reader.ahead(is_fact) || reader.ahead(of_nobody) || reader.ahead(of_no_concern) || is_long_ago(reader);
    if is_none {
        reader.at = reader.words.len();
    }
    is_none
}

/// "Preferred name: Dolly": who somebody is.
fn is_fact(reader: &mut SentenceReader) -> bool {
    let length = reader.names.lexicon.list("FACTS", |ahead| reader.peek(ahead));
    length.is_some_and(|length| reader.peek(length) == ":")
}

fn of_nobody(reader: &mut SentenceReader) -> bool {
    reader.eat("nobody|none") || reader.eat("no one|visitors|family|relatives")
}

fn of_no_concern(reader: &mut SentenceReader) -> bool {
    reader.eat("no|nil|none")
        && reader.peek(0) != "longer"
        && reader.names.lexicon.list("CONCERNS", |ahead| reader.peek(ahead)).is_some()
}

fn is_long_ago(reader: &SentenceReader) -> bool {
    let lexicon = &reader.names.lexicon;
    let word = |at: usize| reader.words.get(at).map_or("", |word| word.text.as_str());
    let is_said = |from: usize| lexicon.list("LONGAGO", |ahead| word(from + ahead)).is_some();
    let is_past = |word: &str| word.ends_with("ed") || lexicon.verb_of_past(word).is_some();
    (0..reader.words.len()).any(is_said) && reader.words.iter().any(|word| is_past(&word.text))
}

pub fn of_topic(reader: &mut SentenceReader) -> Option<()> {
    reader.attempt(|reader| {
        reader.eat("is|are|has|have|can|remains|varies|seems|was|fluctuates|gets|becomes").then_some(())?;
        to_the_end(reader, Rest::Any)
    })
}

fn to_the_end(reader: &mut SentenceReader, rest: Rest) -> Option<()> {
    reader.attempt(|reader| {
        let from = reader.at;
        while !reader.is_over() {
            if reader.at > from && begins_clause(reader) {
                break;
            }
            if rest == Rest::Plain && is_lived(reader) {
                return None;
            }
            reader.at += 1;
        }
        Some(())
    })
}

fn feels(reader: &mut SentenceReader) -> Option<()> {
    let verb =
        reader.eat("is|are|becomes|become|gets|get|feels|feel|seems|seem|appears|appear|looks|look|remains|stays");
    if !verb {
        return None;
    }
    let _ = reader.eat("a little|bit") || reader.eat("more and more");
    while reader
        .eat("often|usually|sometimes|always|very|rather|quite|easily|more|increasingly|mostly|generally|still|so|too")
    {
    }
    let lexicon = reader.names.lexicon.clone();
    reader.at += lexicon.list("FEELINGS", |ahead| reader.peek(ahead))?;
    Some(())
}

fn state(reader: &mut SentenceReader) -> Option<Rest> {
    let goes_on = |reader: &mut SentenceReader| {
        (reader.eat("has|have been") && activities::activity(reader).is_some())
            || reader.eat("can|could|may|might be up|awake|restless")
    };
    if reader.ahead(goes_on) {
        return None;
    }
    let end = |reader: &mut SentenceReader, found: bool| if found { reader.at } else { 0 };
    let lived = reader.ahead(|reader| {
        let found = activities::activity(reader).is_some();
        end(reader, found)
    });
    let voice = reader.names.lexicon.list("VOICES", |ahead| reader.peek(ahead)).map_or(0, |length| reader.at + length);
    if lived > 0 && lived >= voice {
        return known_state(reader);
    }
    if reader.ahead(unaccompanied) {
        reader.at += 1;
        return Some(Rest::Any);
    }
    if reader.attempt(feels).is_some() {
        return Some(Rest::Any);
    }
    let voiced = |reader: &mut SentenceReader| {
        reader.eat("often|sometimes|usually|always|rarely");
        let lexicon = reader.names.lexicon.clone();
        reader.at += lexicon.list("VOICES", |ahead| reader.peek(ahead))?;
        Some(())
    };
    if reader.attempt(voiced).is_some() {
        return Some(Rest::Any);
    }
    known_state(reader)
}

/// "does not go out alone": what is done with somebody is not denied.
fn unaccompanied(reader: &mut SentenceReader) -> bool {
    let denies = |reader: &mut SentenceReader| {
        let not = reader.eat("does|do|should|must|may|can|is|are not")
            || reader.eat("doesn't|don't|cannot|can't|shouldn't|never")
            || reader.eat("is|are unable to")
            || reader.eat("no longer");
        not.then_some(())
    };
    reader.attempt(denies).is_some() && {
        let alone = ["alone", "unaided", "unsupervised", "unaccompanied", "independently", "unattended"];
        let rest = reader.words.get(reader.at..).unwrap_or_default().iter().map(|word| word.text.as_str());
        let rest: Vec<&str> = rest.take_while(|word| !["and", "but", "then", ",", ";"].contains(word)).collect();
        let own = rest.windows(3).any(|three| matches!(three, ["on", "her" | "his", "own"]))
            || rest.windows(2).any(|two| matches!(two, ["by", "herself" | "himself"] | ["without", _]));
        own || rest.iter().any(|word| alone.contains(word))
    }
}

/// One of the verbs of states, or "is", "has" or "can".
fn known_state(reader: &mut SentenceReader) -> Option<Rest> {
    if let Some(rest) = reader.attempt(|reader| STATES.iter().find(|(verb, _)| reader.eat(verb)).map(|(_, rest)| *rest))
    {
        return Some(rest);
    }
    if reader.attempt(needs_help).is_some() {
        return Some(Rest::Any);
    }
    if reader.eat("does|do not") || reader.eat("doesn't|don't") {
        if reader.eat("use|wear|tolerate|carry") {
            return (has_of(reader, "AIDS") || has_of(reader, "EQUIPMENT")).then_some(Rest::Any);
        }
        return reader.eat(NOT_SO).then_some(Rest::Plain);
    }
    if reader.eat("no longer") {
        let is_so = |verb: &&str| third_person(verb) == reader.peek(0);
        let found = NOT_SO.split('|').any(|verb| is_so(&verb));
        reader.at += usize::from(found);
        return found.then_some(Rest::Plain);
    }
    if reader.eat("cannot|can't")
        || reader.eat("can not")
        || reader.eat("can no longer")
        || reader.eat("is|are unable to")
        || reader.eat("is|are not able to")
    {
        return Some(Rest::Plain);
    }
    if reader.eat("can|could") || reader.eat("is|are able to") {
        return (!["only", "not", "no"].contains(&reader.peek(0))).then_some(Rest::Any);
    }
    if reader.eat("speaks|speak") {
        return (!["to", "with", "on", "by", "about"].contains(&reader.peek(0))).then_some(Rest::Any);
    }
    let is_ill = |reader: &mut SentenceReader| {
        reader.eat("has|have").then_some(())?;
        has_of(reader, "ILLS").then_some(())
    };
    if reader.attempt(is_ill).is_some() {
        return Some(Rest::Any);
    }
    if reader.eat("has|have|uses|use") || reader.eat("walks|walk with|using") {
        return has(reader).then_some(Rest::Plain);
    }
    if reader.eat("is|are") {
        let _ = reader.eat("no longer") || reader.eat("not|very|quite|still|now|rather|also|always");
        return is(reader).then_some(Rest::Plain);
    }
    None
}

/// "needs some help", "requires verbal prompting": who helps, and when, is not said.
fn needs_help(reader: &mut SentenceReader) -> Option<()> {
    const NEAR: usize = 3;
    reader.eat("needs|need|requires|require").then_some(())?;
    let help = |reader: &mut SentenceReader| {
        reader.eat("help|assistance|support|supervision|prompt|prompts|prompting|reminding|encouragement|guidance")
    };
    (0..=NEAR).find_map(|_| {
        let found = help(reader);
        reader.at += usize::from(!found);
        found.then_some(())
    })
}

fn is(reader: &mut SentenceReader) -> bool {
    let word = reader.peek(0).to_owned();
    let state = reader.ahead(|reader| {
        reader.eat("from|of")
            || reader.eat("in good|poor|fair|frail|pain|remission")
            || reader.eat("at risk")
            || reader.eat("on oxygen|medication|insulin")
    });
    let is_doing = word.len() > 4
        && word.ends_with("ing")
        && !["willing", "caring", "outgoing", "loving"].contains(&word.as_str());
    let is_word = reader.token(0) == Some(Token::Word);
    state || is_word && !is_doing && !BEHAVIOUR.split('|').any(|other| other.trim() == word)
}

fn has(reader: &mut SentenceReader) -> bool {
    has_of(reader, "HAS")
}

fn has_of(reader: &mut SentenceReader, list: &str) -> bool {
    const NEAR: usize = 5;
    let lexicon = reader.names.lexicon.clone();
    if reader.ahead(|reader| {
        reader.skip_determiners();
        reader.name(&[Sort::Condition]).is_some()
    }) {
        return false;
    }
    let is_over = |reader: &SentenceReader, ahead: usize| {
        reader.token(ahead) != Some(Token::Word) || is_beginning(reader.peek(ahead))
    };
    (0..NEAR)
        .take_while(|ahead| !is_over(reader, *ahead))
        .any(|ahead| lexicon.list(list, |at| reader.peek(ahead + at)).is_some())
}

pub fn is_lived(reader: &mut SentenceReader) -> bool {
    let after_one = reader.at > 0 && is_determiner(&reader.words[reader.at - 1].text);
    let activity = !after_one && reader.ahead(|reader| activities::activity(reader).is_some());
    let before = reader.faults.count();
    let time = reader.ahead(|reader| Adverbs::default().next(reader) && reader.faults.count() == before);
    let clock = reader.ahead(|reader| {
        reader.eat("until|till|before|after|by|at")
            && (matches!(reader.token(0), Some(Token::Clock(..) | Token::Number(_))) || number(reader).is_some())
    });
    activity
        || time
        || clock
        || ["then", "daily", "nightly", "when", "whenever", "every", "each", "while"].contains(&reader.peek(0))
}

fn joins_now(reader: &SentenceReader) -> bool {
    reader.at > 0 && reader.words[reader.at - 1].text == "now" || reader.peek(0) == "now"
}

fn begins_with_somebody(reader: &mut SentenceReader) -> bool {
    if reader.eat("she|he|they|it") || person_called(reader) || reader.person().is_some() {
        return true;
    }
    reader.skip_determiners();
    let lexicon = reader.names.lexicon.clone();
    ["PEOPLE", "RELATIVES"].iter().any(|list| lexicon.list(list, |ahead| reader.peek(ahead)).is_some())
}

fn begins_clause(reader: &mut SentenceReader) -> bool {
    let joins = ["and", "but", "so", "then", "or", "who", "which", "because"].contains(&reader.peek(0));
    let comma = reader.token(0) == Some(Token::Comma);
    joins
        && reader.ahead(|reader| {
            reader.at += 1;
            reader.eat("she|he|they|it|then");
            while reader.eat("now|often|only|just") {}
            Adverbs::default().all(reader);
            let lexicon = reader.names.lexicon.clone();
            let somebody = reader.ahead(|reader| {
                reader.eat("now");
                (reader.eat("her|his|the|a")) && lexicon.list("RELATIVES", |at| reader.peek(at)).is_some()
            });
            (somebody && joins_now(reader))
                || lexicon.is_third_person(reader.peek(0))
                || reader.ahead(begins_with_somebody)
                || activities::activity(reader).is_some()
                || state(reader).is_some()
                || reader.eat("walks|walk|sleeps|sleep|does|do")
                || visits(reader)
        })
        || comma
            && reader.ahead(|reader| {
                reader.at += 1;
                reader.eat("and|but|so");
                let who = reader.eat("she|he|they");
                while !who && reader.eat("just|then|often|usually|now|mostly") {}
                let is_verb = who || reader.names.lexicon.is_third_person(reader.peek(0));
                is_verb && activities::activity(reader).is_some() || who && state(reader).is_some()
            })
}
