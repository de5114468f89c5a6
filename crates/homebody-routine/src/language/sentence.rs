//! One sentence: who does what, where, when, and how that changes.

use super::Draft;
use super::activities::{self, MEALS};
use super::adverbs::{Adverbs, Slot};
use super::amounts::{Unit, amount};
use super::build;
use super::faults::did_you_mean;
use super::measures::{Measure, measure};
use super::predicates::{self, Predicate, Subject};
use super::reader::{Reader, Sort, is_determiner};
use super::rules;
use super::words::{Span, Token};
use crate::routine::{Activity, When};

/// What a habit may be said to be done at.
pub const PLACES: [Sort; 3] = [Sort::Place, Sort::Room, Sort::Thing];

/// More things done one after another take more sentences.
const MOST_CLAUSES: usize = 12;

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
}

/// Reads a sentence into the draft. If it has no verb, it is a heading: what it says is returned.
pub fn sentence(reader: &mut Reader, draft: &mut Draft, heading: Option<&Adverbs>) -> Option<Adverbs> {
    let (mut adverbs, mut at) = (Adverbs::default(), None);
    loop {
        reader.skip_commas();
        // A place goes first, since a room may be named after a part of the day.
        let here = if at.is_none() { place(reader) } else { None };
        if here.is_some() {
            at = here;
        } else if !adverbs.next(reader) {
            break;
        }
    }
    if reader.is_over() && at.is_none() {
        return Some(adverbs);
    }
    if reader.eat("whenever|when|if") || reader.eat("each|every time") {
        if let Some((_, span)) = at {
            let hint = "write \"whenever she has been in the kitchen for 20 minutes\"".to_owned();
            reader.fault(span, format!("{:?} does not fit before a rule", reader.said(span)), hint);
        }
        rules::rule(reader, draft, &adverbs);
        return None;
    }
    let from = reader.at;
    let Some(subject) = predicates::subject(reader).or_else(|| stranger(reader)) else {
        no_subject(reader);
        return None;
    };
    let who = reader.span(from);
    if let Subject::Stranger(name) = &subject
        && !is_introduced(reader, draft, name, who)
    {
        return None;
    }
    clauses(reader, draft, Start { subject, who, adverbs, place: at }, heading);
    None
}

/// What stands before the verb.
struct Start {
    subject: Subject,
    who: Span,
    adverbs: Adverbs,
    place: Option<(String, Span)>,
}

fn clauses(reader: &mut Reader, draft: &mut Draft, front: Start, heading: Option<&Adverbs>) {
    let Start { subject, who, mut adverbs, mut place } = front;
    let (mut start, mut cooked) = (None, None);
    let (mut follows, mut clauses): (Option<Adverbs>, usize) = (None, 0);
    loop {
        reader.eat("also|still|again");
        adverbs.all(reader);
        let Some((predicate, predicate_span)) = predicate(reader, &subject, who, &mut adverbs, cooked.as_ref()) else {
            return;
        };
        let mut clause = Clause {
            span: reader.span(start.unwrap_or(0)),
            subject: subject.clone(),
            predicate,
            predicate_span,
            place: place.take(),
            measure: None,
            adverbs,
        };
        let Some(goes_on) = tail(reader, &mut clause) else { return };
        clause.span = reader.span(start.unwrap_or(0));
        if let Some(then) = goes_on {
            let before = reader.words.iter().map(|word| word.span).rev().filter(|word| word.end <= then.start);
            let mut before = before.filter(|word| reader.text.get(word.start..word.end) != Some(","));
            clause.span.end = before.next().map_or(then.start, |word| word.end);
        }
        if let Predicate::Does(Activity::Prepare(meal)) = clause.predicate {
            cooked = Some(meal);
        }
        let merged = match (&follows, heading) {
            (Some(first), _) => clause.adverbs.clone().under(&days_of(first)),
            (None, Some(heading)) => clause.adverbs.clone().under(heading),
            (None, None) => clause.adverbs.clone(),
        };
        follows.get_or_insert_with(|| merged.clone());
        build::build(reader, draft, Clause { adverbs: merged, ..clause });
        let Some(then) = goes_on else { return };
        clauses += 1;
        if clauses == MOST_CLAUSES {
            let what = format!("a sentence says at most {MOST_CLAUSES} things");
            return reader.fault(then, what, "begin a new sentence with \"Then she\"".to_owned());
        }
        adverbs = Adverbs { when: Some(Slot { value: When::Then, span: then, own: true }), ..Adverbs::default() };
        start = reader.words.iter().position(|word| word.span.start == then.start);
        reader.eat("she|he|they|it");
    }
}

/// What "then" takes over from the first clause: the days.
fn days_of(first: &Adverbs) -> Adverbs {
    Adverbs {
        weekdays: first.weekdays.clone(),
        months: first.months.clone(),
        every: first.every.clone(),
        from: first.from.clone(),
        until: first.until.clone(),
        for_days: first.for_days.clone(),
        over: first.over.clone(),
        fading: first.fading.clone(),
        ..Adverbs::default()
    }
}

fn predicate(
    reader: &mut Reader,
    subject: &Subject,
    who: Span,
    adverbs: &mut Adverbs,
    cooked: Option<&crate::routine::Meal>,
) -> Option<(Predicate, Span)> {
    let from = reader.at;
    let found = match subject {
        Subject::Visitor(_) if predicates::visits(reader) => Some(Predicate::Visits),
        Subject::Visitor(name) if reader.names.has(name, Sort::Thing) => {
            let hint = format!("write what she does: \"she forgets the {name} rarely\"");
            reader.fault(who, format!("{:?} does nothing by itself", reader.said(who)), hint);
            return None;
        }
        Subject::Visitor(_) if activities::activity(reader) == Some(Activity::Phone) => {
            let what = format!("{:?} is nobody who lives here", reader.said(who));
            let hint = format!("write \"she phones {} for 10 minutes\"", reader.said(who).to_lowercase());
            reader.fault(who, what, hint);
            return None;
        }
        Subject::Visitor(name) => {
            let what = format!("{:?} is nobody who lives here: a visitor only visits", reader.said(who));
            reader.fault(who, what, format!("write \"her {name} visits on Sunday for 2 hours\""));
            return None;
        }
        Subject::Hours | Subject::Pulse | Subject::Breathing => {
            let found = predicates::of_body(reader, subject);
            if found.is_none() {
                let hint = "write \"her hours vary twice as much\", \"her pulse rises by 20 beats\" or \
                    \"her breathing rises by 6 breaths a minute\"";
                let what = format!("what is said of {:?} is not understood", reader.said(who));
                reader.fault(reader.span(from), what, hint.to_owned());
                return None;
            }
            found
        }
        _ => predicates::predicate(reader, adverbs),
    };
    if let Some(found) = found {
        return Some((found, reader.span(from)));
    }
    if reader.is_over() {
        reader.fault(who, "the sentence ends before it says what is done", None);
        return None;
    }
    // What is read by now says that the rest is not so.
    let is_negated = reader.at > from;
    if let Some(found) = meal_meant(reader, cooked.filter(|_| !is_negated)) {
        return found.map(|activity| (Predicate::Does(activity), reader.span(from)));
    }
    let own = predicates::own_words(reader);
    if is_negated {
        let span = own.map_or(reader.here(), |(_, span)| span);
        predicates::unknown_not(reader, span);
        return None;
    }
    let Some((words, span)) = own else {
        let span = nothing_of_its_own(reader);
        let words = reader.said(span).to_lowercase();
        predicates::unknown_verb(reader, &words, span);
        return None;
    };
    if predicates::is_nearly_known(&words) {
        predicates::unknown_verb(reader, &words, span);
        return None;
    }
    Some((Predicate::Own(words), span))
}

/// The words of an activity that begins with one that is known to begin something else: "has visitors".
fn nothing_of_its_own(reader: &mut Reader) -> Span {
    let from = reader.at;
    if reader.eat("has|have") {
        predicates::own_words(reader);
        return reader.span(from);
    }
    reader.here()
}

/// "eats" or "cooks" without saying what: the meal just cooked, or a fault.
fn meal_meant(reader: &mut Reader, cooked: Option<&crate::routine::Meal>) -> Option<Option<Activity>> {
    let from = reader.at;
    let eats = reader.eat("eats|eat|has|have");
    if !eats && !reader.eat("cooks|cook|prepares|prepare|makes|make") {
        return None;
    }
    let is_end = reader.is_over() || reader.token(0) != Some(Token::Word) || predicates::begins_adverb(reader);
    let says_more = !reader.eat("it") && !is_end;
    match cooked {
        Some(meal) if eats && !says_more => Some(Some(Activity::Eat(*meal))),
        _ if says_more => {
            reader.at = from;
            None
        }
        _ => {
            let span = reader.span(from);
            let meals: Vec<String> = MEALS.iter().map(|(name, _)| name.replace('|', " or ")).collect();
            let hint = format!("name the meal: {}", meals.join(", "));
            reader.fault(span, format!("it is not clear what {:?} is about", reader.said(span)), hint);
            Some(None)
        }
    }
}

/// Reads the rest of a clause. Nothing if it is not understood; else the "then" that another clause follows.
pub fn tail(reader: &mut Reader, clause: &mut Clause) -> Option<Option<Span>> {
    loop {
        reader.skip_commas();
        if reader.is_over() {
            return Some(None);
        }
        let at = reader.at;
        if reader.eat("and then") || reader.eat("then") {
            return Some(Some(reader.span(at)));
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

/// "in the armchair".
fn place(reader: &mut Reader) -> Option<(String, Span)> {
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
    if word == "and" || word == "but" || word == "or" {
        let hint = match reader.ahead(|reader| {
            reader.at += 1;
            Adverbs::default().next(reader)
        }) {
            true => "make two sentences, one for each",
            false => "write \"then\" between things done one after another, or make two sentences",
        };
        let hint = hint.to_owned();
        return reader.fault(here, format!("{word:?} joins more than one sentence can say"), hint);
    }
    let at = reader.at;
    if reader.eat("to") && activities::activity(reader).is_some() {
        let (span, doing) = (reader.span(at), reader.said(reader.span(at + 1)));
        if let Predicate::Own(words) = &clause.predicate {
            let what = format!("{:?} says more than what is done", format!("{words} {}", reader.said(span)));
            let hint = format!("write \"she {}\"", activities::in_third_person(&doing));
            return reader.fault(clause.predicate_span.to(span), what, hint);
        }
        let hint = format!("say what she does, not what for: \"then she {}\"", activities::in_third_person(&doing));
        return reader.fault(span, format!("{:?} is a purpose", reader.said(span)), hint);
    }
    reader.at = at;
    if eat_preposition(reader) && !reader.is_over() && !matches!(reader.token(0), Some(Token::Number(_))) {
        let goes = match &clause.predicate {
            Predicate::Own(words) => predicates::is_way(words),
            other => *other == Predicate::Is,
        };
        let outside = goes.then_some("for what is outside, write \"she goes out at 10:00 for 2 hours\"");
        predicates::unknown_name_or(reader, &PLACES, "no place of this home, and no time", outside);
        return;
    }
    reader.at = at;
    if let Predicate::Own(words) = &clause.predicate {
        return predicates::unknown_verb(reader, words, clause.predicate_span);
    }
    let what = format!("{:?} is not understood here", reader.said(here));
    let hint = expected(reader, clause, &word);
    reader.fault(here, what, hint);
}

/// What could stand where a word is not understood.
fn expected(reader: &mut Reader, clause: &Clause, word: &str) -> String {
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
        return build::IS.into();
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

/// A name that nobody here has, in front of a verb.
fn stranger(reader: &mut Reader) -> Option<Subject> {
    const LONGEST: usize = 4;
    let from = reader.at;
    let is_capital =
        |span: Span| reader.text.get(span.start..).is_some_and(|text| text.starts_with(char::is_uppercase));
    let here = reader.here();
    if !is_capital(here) && reader.peek(1) != "is" {
        return None;
    }
    let is_known = reader.ahead(|reader| activities::activity(reader).is_some());
    let is_name = |reader: &Reader| {
        let pronoun = ["she", "he", "they", "it"].contains(&reader.peek(0));
        reader.token(0) == Some(Token::Word) && !pronoun && !predicates::begins_adverb(reader)
    };
    while !is_known && reader.at < from + LONGEST && is_name(reader) {
        reader.at += 1;
        let is_verb = |reader: &mut Reader| {
            Adverbs::default().all(reader);
            reader.eat("is|walks|shows") || predicates::visits(reader) || activities::activity(reader).is_some()
        };
        if reader.ahead(is_verb) {
            return Some(Subject::Stranger(reader.said(reader.span(from))));
        }
    }
    reader.at = from;
    None
}

/// Whether a name may be the person's: nobody has said another, and it is said who that is.
fn is_introduced(reader: &mut Reader, draft: &mut Draft, name: &str, who: Span) -> bool {
    if reader.ahead(predicates::visits) {
        let hint = "write who it is: \"her daughter visits\" or \"a nurse visits\"".to_owned();
        reader.fault(who, format!("{name:?} is nobody that this routine knows"), hint);
        return false;
    }
    if let Some(person) = reader.names.person.clone() {
        let hint = did_you_mean(name, [person.as_str()].into_iter()).filter(|hint| hint.starts_with("did"));
        let hint = hint.unwrap_or_else(|| "each person has a routine of their own".to_owned());
        reader.fault(who, format!("this routine is about {person:?}, not about {name:?}"), hint);
        return false;
    }
    if draft.is_condition {
        let hint = "write \"she\", \"he\", \"they\" or \"the person\"".to_owned();
        reader.fault(who, format!("a condition is about nobody in particular, not about {name:?}"), hint);
        return false;
    }
    if reader.peek(0) != "is" {
        reader.fault(who, format!("{name:?} has not been said to be anybody"), format!("begin with \"{name} is 82.\""));
        return false;
    }
    draft.name = Some(name.to_owned());
    true
}

fn no_subject(reader: &mut Reader) {
    let from = reader.at;
    if activities::activity(reader).is_some() {
        let span = reader.span(from);
        let hint = format!("write \"she {}\"", reader.said(span).to_lowercase());
        return reader.fault(span, "it is not said who does this", hint);
    }
    if is_determiner(reader.peek(0)) && reader.token(1) == Some(Token::Word) {
        reader.at += 2;
        let span = reader.span(from);
        let what = format!("what {:?} does is not understood", reader.said(span));
        let hint = "write \"she reads\" for what the person does, or \"her daughter visits on Sunday\"".to_owned();
        return reader.fault(span, what, hint);
    }
    let (here, word) = (reader.here(), reader.peek(0).to_owned());
    if predicates::begins_adverb(reader) {
        reader.at = (from + 3).min(reader.words.len());
        let what = format!("{:?} is not understood here", reader.said(reader.span(from)));
        let hint = "expected when or where: \"in the morning\", \"on Monday\", \"from week 6\", \"in the kitchen\"";
        return reader.fault(reader.span(from), what, hint.to_owned());
    }
    let known = did_you_mean(&word, vocabulary().filter(|known| *known != word));
    let hint = known.filter(|hint| hint.starts_with("did")).unwrap_or_else(|| {
        "a sentence says who does what: \"she gets up at about 06:45\", \"her daughter visits on Sunday\"".into()
    });
    reader.fault(here, format!("{:?} is not understood here", reader.said(here)), hint);
}

/// Words that slips are looked for among.
fn vocabulary() -> impl Iterator<Item = &'static str> + Clone {
    const WORDS: &str = "she he they her his their the about around at on in for from until over after before with \
        between and then every most often sometimes rarely usually always almost never once twice times minutes hours \
        days weeks months morning afternoon evening night noon midnight monday tuesday wednesday thursday friday \
        saturday sunday weekdays weekends january february march april june july august september october november \
        december winter spring summer autumn breakfast lunch dinner bed give take later earlier longer shorter more \
        less slower faster week day whenever first fading percent seldom daily o'clock during half";
    WORDS.split_whitespace()
}
