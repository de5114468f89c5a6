//! A clause: who does what, with what stands behind the verb in any order.

use super::activities;
use super::adverbs::{Adverbs, Slot};
use super::amounts::{Unit, amount};
use super::calendar::is_weekday;
use super::faults::did_you_mean;
use super::helping;
use super::measures::{Measure, measure};
use super::predicates::IS;
use super::reader::{Reader, Sort, begins_adverb, is_determiner};
use super::remarks::is_lived;
use super::said::Predicate;
use super::subjects::Subject;
use super::unknown;
use super::words::{Span, Token};
use crate::routine::{Activity, PartOfDay};

/// What a habit may be said to be done at.
pub const PLACES: [Sort; 3] = [Sort::Place, Sort::Room, Sort::Thing];

/// A clause with all that was said in it.
#[derive(Clone, Debug)]
pub struct Clause {
    pub span: Span,
    pub subject: Subject,
    pub predicate: Predicate,
    pub predicate_span: Span,
    pub place: Option<(String, Span)>,
    pub measure: Option<Measure>,
    pub adverbs: Adverbs,
    /// Whether it is what somebody likes to do, or mostly does.
    pub tends: bool,
    /// Whether it goes on with the verb of the clause before it.
    pub again: bool,
    /// What is said beside it and not lived: why it is so, or what stands between brackets.
    pub beside: Vec<Span>,
}

/// What joins a clause with another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Join {
    Then,
    And,
    Or,
}

/// Reads the rest of a clause. Nothing if it is not understood; else how another clause follows, and where that is said.
pub fn tail(reader: &mut Reader, clause: &mut Clause) -> Option<Option<(Join, Span)>> {
    loop {
        if says_beside(reader, clause) || stays_on(reader, clause) {
            continue;
        }
        if let Some(join) = in_list(reader, clause) {
            let span = reader.here();
            reader.skip_commas();
            return Some(Some((join, span)));
        }
        reader.skip_commas();
        if reader.is_over() {
            return Some(None);
        }
        let at = reader.at;
        if matches!(clause.predicate, Predicate::Remark | Predicate::Age(_) | Predicate::Kind(_)) && reader.eat("who") {
            return Some(Some((Join::And, reader.span(at))));
        }
        // What is said to be done is done as it is said, and not besides.
        if matches!(clause.predicate, Predicate::Does(_)) && reader.eat("only") {
            continue;
        }
        if reader.eat("and then") || reader.eat("then") {
            return Some(Some((Join::Then, reader.span(at))));
        }
        if let Some(join) = reader.eat_any(&[("and also", Join::And), ("and|but", Join::And), ("or", Join::Or)]) {
            return Some(Some((join, reader.span(at))));
        }
        if matches!(clause.predicate, Predicate::Remark) {
            not_understood(reader, clause);
            return None;
        }
        // "sees her at home"
        if matches!(clause.predicate, Predicate::Visits | Predicate::Helps(..)) && reader.eat("at home") {
            continue;
        }
        let more = [
            says_purpose,
            says_doing,
            says_alone,
            says_outside,
            says_company,
            says_meal,
            says_errand,
            says_late,
            counts_cups,
        ];
        if more.iter().any(|more| more(reader, clause)) {
            continue;
        }
        if let Some(measure) = measure(reader) {
            if clause.measure.is_some() {
                let what = format!("{:?} is a second change in one sentence", reader.said(measure.span));
                reader.fault(measure.span, what, "make two sentences".to_owned());
            }
            clause.measure = Some(measure);
            continue;
        }
        if put_place(reader, clause) || clause.adverbs.next(reader) {
            continue;
        }
        not_understood(reader, clause);
        return None;
    }
}

/// Whether a comma stands for the "and" or "or" that comes later: "washes, dresses and has breakfast".
fn in_list(reader: &mut Reader, clause: &Clause) -> Option<Join> {
    if reader.token(0) != Some(Token::Comma) {
        return None;
    }
    let says_who = reader.ahead(|reader| {
        reader.skip_commas();
        Adverbs::default().all(reader);
        reader.eat("she|he") && !reader.is_over()
    });
    if says_who && !matches!(clause.predicate, Predicate::Remark) {
        return Some(Join::And);
    }
    let goes_on = reader.ahead(|reader| {
        reader.skip_commas();
        let is_verb = reader.names.lexicon.is_third_person(reader.peek(0));
        is_verb && activities::activity(reader).is_some()
    });
    let rest = reader.words.get(reader.at..).unwrap_or_default();
    let has = |word: &str| rest.iter().any(|one| one.text == word);
    if goes_on && !has("or") && !has("then") && !matches!(clause.predicate, Predicate::Remark) {
        return Some(Join::And);
    }
    let joins = |word: &str| rest.iter().any(|one| one.text == word);
    let join = if joins("or") { Join::Or } else { Join::And };
    if !(joins("or") || joins("and")) || rest.iter().any(|one| one.text == "then") {
        return None;
    }
    let goes_on = reader.ahead(|reader| {
        reader.skip_commas();
        let from = reader.at;
        let verb = activities::activity(reader).is_some();
        reader.at = from;
        let again = clause.adverbs.when.is_some() && {
            let mut more = Adverbs::default();
            more.next(reader) && more.when.is_some()
        };
        reader.at = from;
        let object = activities::noun(reader).is_some() && matches!(clause.predicate, Predicate::Does(_));
        verb || again || object
    });
    goes_on.then_some(join)
}

/// "gets up to use the toilet", "goes to the kitchen to make tea": what for is what is done.
fn says_purpose(reader: &mut Reader, clause: &mut Clause) -> bool {
    let from = reader.at;
    let found = reader.attempt(|reader| {
        if matches!(&clause.predicate, Predicate::Own(words) if unknown::is_way(words)) && clause.place.is_some() {
            let kind =
                [("something to eat", true), ("a snack", true), ("something to drink", false), ("a drink", false)];
            let found = reader.attempt(|reader| if reader.eat("for") { reader.eat_any(&kind) } else { None });
            if let Some(is_snack) = found {
                return Some(Predicate::Does(if is_snack { Activity::Snack } else { Activity::Drink }));
            }
        }
        let for_toilet = reader.attempt(|reader| {
            reader.eat("for").then_some(())?;
            reader.skip_determiners();
            reader.eat("toilet|bathroom|loo|commode|wee").then_some(())
        });
        if for_toilet.is_some() {
            let is_up = matches!(clause.predicate, Predicate::Does(Activity::GetUp | Activity::LieAwake));
            return is_up.then_some(Predicate::Does(Activity::UseBathroom));
        }
        if !reader.eat("in order to") && !reader.eat("to") {
            return None;
        }
        if clause.predicate == Predicate::Visits {
            return helping::doing(reader);
        }
        let purpose = activities::activity(reader)?;
        let goes = matches!(&clause.predicate, Predicate::Own(words) if unknown::is_way(words) || words == "stands");
        match &clause.predicate {
            Predicate::Does(Activity::GetUp | Activity::Relax | Activity::LieAwake) => Some(Predicate::Does(purpose)),
            Predicate::Own(_) if goes && clause.place.is_some() => Some(Predicate::Does(purpose)),
            Predicate::Does(Activity::Leave) => Some(Predicate::Does(Activity::Leave)),
            _ => None,
        }
    });
    let Some(found) = found else { return false };
    let is_new = matches!(&found, Predicate::Does(activity) if Predicate::Does(activity.clone()) != clause.predicate);
    // Who gets up for something and says no time does so in the night.
    if clause.predicate == Predicate::Does(Activity::GetUp) && is_new {
        clause.adverbs.all(reader);
        if clause.adverbs.when.is_none() && clause.adverbs.part.is_none() {
            clause.adverbs.part = Some(Slot { value: PartOfDay::Night, span: reader.span(from), own: true });
        }
    }
    clause.predicate = found;
    true
}

/// "plays bingo at the community centre": what is done out of the home is being out.
fn says_outside(reader: &mut Reader, clause: &mut Clause) -> bool {
    if !matches!(clause.predicate, Predicate::Does(_) | Predicate::Own(_)) || clause.place.is_some() {
        return false;
    }
    let found = reader.attempt(|reader| {
        if !reader.eat("at|in") {
            return None;
        }
        reader.skip_determiners();
        if reader.ahead(|reader| reader.name(&PLACES).is_some()) {
            return None;
        }
        let lexicon = reader.names.lexicon.clone();
        let length = (0..3).find_map(|before| {
            let length = lexicon.list("OUTSIDE", |ahead| reader.peek(before + ahead))?;
            Some(before + length)
        });
        reader.at += length?;
        (reader.is_over()
            || reader.token(0) != Some(Token::Word)
            || begins_adverb(reader)
            || reader.ahead(|reader| Adverbs::default().next(reader))
            || is_weekday(reader.peek(0)))
        .then_some(())
    });
    if found.is_some() {
        clause.predicate = Predicate::Does(Activity::Leave);
    }
    found.is_some()
}

/// "with her daughter", of who is out: who else is there no sensor of the home sees. "With help from a carer": who comes.
fn says_company(reader: &mut Reader, clause: &mut Clause) -> bool {
    let Predicate::Does(activity) = clause.predicate.clone() else { return false };
    let from = reader.at;
    let is_passive = ["is", "are"].iter().any(|is| reader.said(clause.predicate_span).to_lowercase().starts_with(is));
    let by = is_passive && reader.eat("by|from");
    if !by && !reader.eat("with") {
        return false;
    }
    let helped = by || reader.eat("the help|assistance of|from") || reader.eat("help|assistance from");
    let starts = reader.at;
    let with_determiner = is_determiner(reader.peek(0));
    reader.skip_determiners();
    let start = reader.at;
    while reader.token(0) == Some(Token::Word)
        && !begins_adverb(reader)
        && !is_weekday(reader.peek(0))
        && reader.at < start + 3
    {
        reader.at += 1;
    }
    let lexicon = reader.names.lexicon.clone();
    let is_people = (start..reader.at).any(|at| {
        let word = |ahead: usize| reader.words.get(at + ahead).map_or("", |word| word.text.as_str());
        ["PEOPLE", "RELATIVES", "PET"].iter().any(|list| lexicon.list(list, word).is_some())
    });
    let is_who = reader.at > start && (is_people || helped && with_determiner);
    if helped && is_who {
        clause.predicate = Predicate::HelpedBy(reader.passed(start), activity);
        return true;
    }
    if is_who && starts > from && activity == Activity::Leave {
        return true;
    }
    reader.at = from;
    false
}

/// "because she is tired", "due to her knees", "(with a carer)": why, and what stands between brackets, is a remark.
fn says_beside(reader: &mut Reader, clause: &mut Clause) -> bool {
    if matches!(clause.predicate, Predicate::Not(_)) && reader.peek(0) == "unless" {
        return false;
    }
    let from = reader.at;
    if reader.peek(0) == "(" {
        let Some(length) = (1..reader.words.len() - from).find(|&ahead| reader.peek(ahead) == ")") else {
            return false;
        };
        let is_plain = reader.ahead(|reader| {
            reader.at += 1;
            while reader.at < from + length {
                if is_lived(reader) || matches!(reader.token(0), Some(Token::Number(_))) || denies(reader.peek(0)) {
                    return false;
                }
                reader.at += 1;
            }
            true
        });
        if is_plain && length > 1 {
            reader.at = from + 1;
            clause.beside.push(reader.words[from + 1].span.to(reader.words[from + length - 1].span));
            reader.at = from + length + 1;
        }
        return is_plain;
    }
    reader.skip_commas();
    let start = reader.at;
    let is_why = reader.eat("because|owing|due")
        || reader.eat("so that|as")
        || reader.eat("on account of")
        || reader.eat("for fear of")
        || reader.eat("rather than")
        || reader.eat("instead of")
        || reader.eat("since her|his|the|a|an|being|having|moving|coming")
        || reader.eat("since she|he|they")
        || reader.eat("as|since she|he is|has|gets|finds|feels|cannot|likes");
    if !is_why || reader.is_over() {
        reader.at = from;
        return false;
    }
    while !(reader.is_over()
        || [";", "(", ")"].contains(&reader.peek(0))
        || reader.at > start + 2 && begins_again(reader))
    {
        reader.at += 1;
    }
    clause.beside.push(reader.span(start));
    true
}

/// Whether "and she", or the like, begins another clause.
fn begins_again(reader: &mut Reader) -> bool {
    reader.ahead(|reader| {
        let comma = reader.token(0) == Some(Token::Comma);
        reader.skip_commas();
        (reader.eat("and|but|so|then") || comma) && {
            reader.eat("she|he|they");
            Adverbs::default().all(reader);
            activities::activity(reader).is_some()
        }
    })
}

fn denies(word: &str) -> bool {
    ["not", "no", "never", "without", "except", "unless", "only", "if", "when"].contains(&word) || word.ends_with("n't")
}

/// "sits in the armchair watching television": that is what is done. "Wanders looking for her husband": a remark.
fn says_doing(reader: &mut Reader, clause: &mut Clause) -> bool {
    let is_doing = matches!(clause.predicate, Predicate::Does(_)) && reader.peek(0).ends_with("ing");
    if !is_doing {
        return false;
    }
    let from = reader.at;
    if let Some(activity) = reader.attempt(activities::activity) {
        let sits = matches!(clause.predicate, Predicate::Does(Activity::Relax));
        if sits {
            clause.predicate = Predicate::Does(activity);
            return true;
        }
        reader.at = from;
        return false;
    }
    const IN_MIND: &str =
        "looking|searching|calling|asking|worrying|thinking|crying|talking|shouting|muttering|feeling|holding|hoping";
    if !reader.eat(IN_MIND) {
        return false;
    }
    reader.attempt(|reader| {
        reader.eat("for|about|to|out").then_some(())?;
        let start = reader.at;
        reader.skip_determiners();
        let named = reader.at > start || reader.eat("herself|himself|something|somebody|someone|help");
        reader.at += usize::from(
            named && reader.at > start && is_determiner(reader.peek(0))
                || is_determiner(&reader.words[reader.at - 1].text),
        );
        named.then_some(())
    });
    clause.beside.push(reader.span(from));
    true
}

/// "walks to the shop for the newspaper": what for does not matter to who is out.
fn says_errand(reader: &mut Reader, clause: &mut Clause) -> bool {
    clause.predicate == Predicate::Does(Activity::Leave)
        && reader
            .attempt(|reader| {
                reader.eat("for").then_some(())?;
                let is_named = is_determiner(reader.peek(0));
                reader.skip_determiners();
                let named = is_named
                    || reader.eat("lunch|dinner|coffee|tea|breakfast|supper|shopping|groceries|bread|milk|company");
                let is_time = reader.ahead(|reader| number_or_unit(reader));
                if !named || is_time {
                    return None;
                }
                if is_named {
                    reader.at += 1;
                }
                Some(())
            })
            .is_some()
}

fn number_or_unit(reader: &mut Reader) -> bool {
    super::amounts::is_unit(reader)
        || super::amounts::number(reader).is_some()
        || ["half", "few", "couple", "while", "quarter"].contains(&reader.peek(0))
}

/// "visits every Sunday for lunch".
fn says_meal(reader: &mut Reader, clause: &mut Clause) -> bool {
    if clause.predicate != Predicate::Visits {
        return false;
    }
    let found = reader.attempt(|reader| if reader.eat("for") { helping::meal_shared(reader) } else { None });
    let is_some = found.is_some();
    clause.predicate = found.unwrap_or(Predicate::Visits);
    is_some
}

/// "visits on Sunday and stays until 16:00".
fn stays_on(reader: &mut Reader, clause: &mut Clause) -> bool {
    matches!(clause.predicate, Predicate::Visits | Predicate::Helps(..))
        && reader
            .attempt(|reader| {
                reader.eat("and");
                (reader.eat("stays|stay|staying|remains") && ["until", "till", "for"].contains(&reader.peek(0)))
                    .then_some(())
            })
            .is_some()
}

/// "goes to bed late, at about 1 am": the time says it.
fn says_late(reader: &mut Reader, clause: &mut Clause) -> bool {
    let has_time = |adverbs: &Adverbs| adverbs.when.is_some() || adverbs.until_time.is_some();
    reader
        .attempt(|reader| {
            reader.eat("quite|very|rather|fairly");
            if !reader.eat("late|early") {
                return None;
            }
            let mut more = Adverbs::default();
            let comes = reader.ahead(|reader| {
                more.all(reader);
                has_time(&more)
            });
            (comes || has_time(&clause.adverbs)).then_some(())
        })
        .is_some()
}

/// "drinks eight cups of tea a day": so many times.
fn counts_cups(reader: &mut Reader, clause: &mut Clause) -> bool {
    if !matches!(clause.predicate, Predicate::Does(Activity::Drink)) || clause.adverbs.times.is_some() {
        return false;
    }
    let from = reader.at;
    let times = reader.attempt(|reader| {
        let times = amount(reader).filter(|amount| amount.unit == Unit::None)?.as_count()?;
        reader.eat("cups|glasses|mugs|pots|beakers|drinks").then_some(())?;
        if reader.eat("of") {
            reader.at += 1;
            let _ = reader.eat("and|or coffee|tea|water|juice|squash");
        }
        (reader.eat("a|per|each|every day") || reader.eat("daily")).then_some(times)
    });
    let Some(times) = times else { return false };
    clause.adverbs.times = Some(Slot { value: times, span: reader.span(from), own: true });
    true
}

/// "On her own" is how everything is done where nobody is named, so it changes nothing but what is denied.
///
/// How it is done, "quietly", "with her frame", is not lived either.
fn says_alone(reader: &mut Reader, clause: &mut Clause) -> bool {
    let is_done =
        matches!(clause.predicate, Predicate::Does(_) | Predicate::Own(_)) && clause.subject == Subject::Person;
    is_done
        && (reader.eat("on her|his|their own")
            || reader.eat("by herself|himself|themselves")
            || reader.eat("alone|independently|unaided|quietly|happily|safely|contentedly|herself|himself|too|indoors")
            || reader.eat("straight|right away")
            || reader.attempt(with_aid).is_some()
            || clause.predicate != Predicate::Does(Activity::Leave) && reader.eat("at home")
            || reader.eat("for herself|himself|both")
            || reader.eat("without help|assistance"))
}

/// "with a stick", "using her frame".
fn with_aid(reader: &mut Reader) -> Option<()> {
    reader.eat("with|using").then_some(())?;
    reader.eat("the help|aid of");
    reader.skip_determiners();
    let lexicon = reader.names.lexicon.clone();
    (0..=2).find_map(|_| {
        let length = lexicon.list("AIDS", |ahead| reader.peek(ahead));
        reader.at += length.unwrap_or(1);
        length.map(|_| ())
    })
}

/// "in the armchair".
pub fn place(reader: &mut Reader) -> Option<(String, Span)> {
    let start = reader.at;
    let name = reader.attempt(|reader| if eat_preposition(reader) { reader.name(&PLACES) } else { None })?;
    Some((name, reader.span(start)))
}

/// A place within the rest of a clause; the kitchen of "cleans the kitchen" is one too.
fn put_place(reader: &mut Reader, clause: &mut Clause) -> bool {
    let start = reader.at;
    let cleans = matches!(&clause.predicate, Predicate::Does(Activity::Housework));
    let found = place(reader).or_else(|| {
        let name = if cleans { reader.name(&PLACES) } else { None }?;
        Some((name, reader.span(start)))
    });
    let Some((name, span)) = found else { return false };
    if let Some((first, _)) = &clause.place {
        let what = format!("{:?} is a second place beside {first:?}", reader.said(span));
        reader.fault(span, what, "leave one of them out, or make two sentences".to_owned());
    }
    clause.place = Some((name, span));
    true
}

pub fn eat_preposition(reader: &mut Reader) -> bool {
    reader.eat("in front of") || reader.eat("next to") || reader.eat("in|on|at|by|near|beside|to|from|into|onto")
}

fn not_understood(reader: &mut Reader, clause: &Clause) {
    let (here, word) = (reader.here(), reader.peek(0).to_owned());
    let at = reader.at;
    if reader.eat("to") && activities::activity(reader).is_some() {
        let (span, doing) = (reader.span(at), reader.said(reader.span(at + 1)));
        if let Predicate::Own(words) = &clause.predicate {
            let what = format!("{:?} says more than what is done", format!("{words} {}", reader.said(span)));
            let is_not = words.split(' ').any(|word| word == "not");
            let hint = format!("write \"she {}\"", activities::in_third_person(&doing));
            return reader.fault(clause.predicate_span.to(span), what, (!is_not).then_some(hint));
        }
        let hint = format!("say what she does, not what for: \"then she {}\"", activities::in_third_person(&doing));
        return reader.fault(span, format!("{:?} is a purpose", reader.said(span)), hint);
    }
    reader.at = at;
    if eat_preposition(reader) && !reader.is_over() && !matches!(reader.token(0), Some(Token::Number(_))) {
        let goes = match &clause.predicate {
            Predicate::Own(words) => unknown::is_way(words),
            other => *other == Predicate::Is,
        };
        let outside = goes.then_some("for what is outside, write \"she goes out at 10:00 for 2 hours\"");
        unknown::unknown_name_or(reader, &PLACES, "no place of this home, and no time", outside);
        return;
    }
    reader.at = at;
    if let Predicate::Own(words) = &clause.predicate {
        return unknown::unknown_verb(reader, words, clause.predicate_span);
    }
    let what = format!("{:?} is not understood here", reader.said(here));
    if reader.faults.is_trial {
        return reader.fault(here, what, None);
    }
    let hint = expected(reader, clause, &word);
    reader.fault(here, what, hint);
}

/// What could stand where a word is not understood.
fn expected(reader: &mut Reader, clause: &Clause, word: &str) -> String {
    if word == "when" && (reader.peek(1) == "it" || reader.peek(2) == "weather")
        || ["weather", "rain", "snow"].contains(&reader.peek(1))
    {
        return unknown::NO_WEATHER.into();
    }
    if clause.predicate == Predicate::Walks && ["slowly", "unsteadily", "carefully", "quickly"].contains(&word) {
        return "say how fast, \"she walks at 0.5 m/s\", or how it changes: \"from week 10 she walks 10 % slower\""
            .into();
    }
    if clause.predicate == Predicate::Is && word == "up" {
        return "say what she does then: \"she goes to the bathroom 3 times a night\", \"she lies awake at night\", \"she wanders \
            at night\""
            .into();
    }
    if ["when", "if", "whenever", "because", "unless"].contains(&word) {
        return "what depends on something begins with it: \"whenever she has been in bed for 10 hours, she gets up\""
            .into();
    }
    if word == "late" || word == "early" {
        return format!(
            "say at what time, such as \"at about 9:00\", or by how much: \"1 hour {}\"",
            if word == "late" { "later" } else { "earlier" }
        );
    }
    let known = did_you_mean(word, vocabulary().filter(|known| *known != word));
    if let Some(hint) = known.filter(|hint| hint.starts_with("did")) {
        return hint;
    }
    let length = reader.ahead(amount).filter(|amount| matches!(amount.unit, Unit::Second | Unit::Day));
    if let Some(length) = length {
        return format!("write \"for {}\"", reader.said(length.span));
    }
    if clause.predicate == Predicate::Is {
        return IS.into();
    }
    if word == "to" {
        return "for a stretch of time, write \"from 10:00 to 12:00\"".into();
    }
    if matches!(reader.token(0), Some(Token::Number(_)))
        && reader.token(1) == Some(Token::Word)
        && !reader.ahead(|reader| amount(reader).is_some_and(|amount| amount.unit != Unit::None))
    {
        return format!("say how many times, or for how long: \"{word} times a day\", \"for {word} minutes\"");
    }
    if word == "until" || word == "till" {
        return "write \"until 22:00\" or \"until day 100\"".into();
    }
    if word.contains(',') {
        return format!("a number has a point, not a comma: {:?}", word.replace(',', "."));
    }
    if "later earlier longer shorter more less slower faster".split(' ').any(|more| more == word) {
        if clause.predicate == Predicate::Walks {
            return "say by how much, such as \"10 % slower\"".into();
        }
        return format!("say by how much, such as \"1 hour {word}\" or \"30 % {word}\"");
    }
    "expected where, when, how long or how often: \"in the armchair\", \"at about 19:00\", \"for 20 minutes\"".into()
}

/// Words that slips are looked for among.
pub fn vocabulary() -> impl Iterator<Item = &'static str> + Clone {
    const WORDS: &str = "she he they her his their the about around at on in for from until over after before with \
        between and then every most often sometimes rarely usually always almost never once twice times minutes hours \
        days weeks months morning afternoon evening night noon midnight monday tuesday wednesday thursday friday \
        saturday sunday weekdays weekends january february march april june july august september october november \
        december winter spring summer autumn breakfast lunch dinner bed give take later earlier longer shorter more \
        less slower faster week day whenever first fading percent seldom daily o'clock during half";
    WORDS.split_whitespace()
}
