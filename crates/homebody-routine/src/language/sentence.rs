//! One sentence: who does what, where, when, and how that changes.

use super::activities::{self, MEALS};
use super::adverbs::{Adverbs, Slot};
use super::build;
use super::calendar;
use super::clause::{Clause, ClauseJoin, place};
use super::conjunction;
use super::day_sentence::says_kinds;
use super::draft::RoutineDraft;
use super::help;
use super::indirect;
use super::messages::{SentenceMessage, WordMessage};
use super::person_word::person_called;
use super::predicate::{self, Predicate};
use super::predicate_tail::tail;
use super::predicates;
use super::reader::{SentenceReader, Sort, begins_adverb, is_determiner};
use super::remarks;
use super::rules;
use super::subjects::{self, SentenceSubject};
use super::unknown_name::{is_introduced, no_subject, stranger};
use super::unknown_word;
use super::words::{TextSpan, Token};
use crate::routine::{Activity, HabitTime};

/// Largest number of activities in a sequence. More need several sentences.
const MOST_CLAUSES: usize = 12;

pub fn sentence(reader: &mut SentenceReader, draft: &mut RoutineDraft, heading: Option<&Adverbs>) -> Option<Adverbs> {
    let (mut adverbs, mut at) = (Adverbs::default(), None);
    let mut beside = Vec::new();
    loop {
        reader.skip_commas();
        if let Some(why) = reader.attempt(why_in_front) {
            beside.push(why);
        }
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
    if at.is_none() && says_kinds(reader, draft, adverbs.clone(), heading) {
        return None;
    }
    if reader.eat("whenever|when|if") || reader.eat("each|every time") {
        if let Some((_, span)) = at {
            reader.fault(span, SentenceMessage::BeforeRule { text: reader.said(span) });
        }
        rules::rule(reader, draft, &adverbs);
        return None;
    }
    let from = reader.at;
    if remarks::of_nobody_or_past(reader) {
        draft.routine.remarks.push(draft.said(reader.span(0)));
        return None;
    }
    let Some(subject) = subjects::subject(reader).or_else(|| stranger(reader)) else {
        no_subject(reader);
        return None;
    };
    let who = reader.span(from);
    if let SentenceSubject::Stranger(name) = &subject
        && !is_introduced(reader, draft, name, who)
    {
        return None;
    }
    clauses(reader, draft, SentenceStart { subject, who, adverbs, place: at, beside }, heading);
    None
}

struct SentenceStart {
    subject: SentenceSubject,
    who: TextSpan,
    adverbs: Adverbs,
    place: Option<(String, TextSpan)>,
    beside: Vec<TextSpan>,
}

/// "The resident", "Margaret", as who does something.
fn begins_with_person(reader: &mut SentenceReader) -> bool {
    person_called(reader) || reader.person() == Some(false)
}

/// "Since the fall", "because of her knees", in front of who does what: a remark.
fn why_in_front(reader: &mut SentenceReader) -> Option<TextSpan> {
    const MOST: usize = 14;
    let from = reader.at;
    reader.eat("ever");
    let since = reader.eat("since")
        && (is_determiner(reader.peek(0))
            || !reader.ahead(|reader| calendar::moment(reader).is_some() || calendar::months(reader).is_some()))
        || reader.eat("now that");
    let after = !since
        && reader
            .attempt(|reader| {
                reader.eat("after her|his|the|a|an").then_some(())?;
                reader.ahead(|reader| activities::noun(reader).is_none()).then_some(())
            })
            .is_some();
    (since || after || reader.eat("because of") || reader.eat("due|owing to") || reader.eat("despite|following"))
        .then_some(())?;
    while reader.at < from + MOST && reader.token(0) == Some(Token::Word) {
        let who =
            ["she", "he", "they"].contains(&reader.peek(0)) || reader.at > from + 2 && reader.ahead(begins_with_person);
        if who && reader.at > from + 1 {
            return Some(reader.span(from));
        }
        reader.at += 1;
    }
    (reader.at > from && reader.token(0) == Some(Token::Comma)).then(|| reader.span(from))
}

fn clauses(reader: &mut SentenceReader, draft: &mut RoutineDraft, front: SentenceStart, heading: Option<&Adverbs>) {
    let SentenceStart { mut subject, mut who, mut adverbs, mut place, mut beside } = front;
    let (mut start, mut cooked) = (0, None);
    let (mut follows, mut count): (Option<Adverbs>, usize) = (None, 0);
    let (mut group, mut joined): (Vec<Clause>, Option<ClauseJoin>) = (Vec::new(), None);
    loop {
        let before = group.last();
        let next = before.and_then(|last| again(reader, last, &mut adverbs));
        let said = ClauseStart { subject: &subject, who, cooked: cooked.as_ref(), before };
        let next = next.or_else(|| clause(reader, said, adverbs, place.take(), start));
        let Some(mut next) = next else { return };
        next.beside.append(&mut beside);
        let Some(goes_on) = tail(reader, &mut next) else { return };
        group.push(next);
        let Some(clause) = group.last_mut() else { return };
        clause.span = reader.span(start);
        if let Some((_, join)) = goes_on {
            let before = reader.words.iter().map(|word| word.span).rev().filter(|word| word.end <= join.start);
            let mut before = before.filter(|word| reader.text.get(word.start..word.end) != Some(","));
            clause.span.end = before.next().map_or(join.start, |word| word.end);
        }
        if let Predicate::Does(Activity::Prepare(meal)) = clause.predicate {
            cooked = Some(meal);
        }
        count += 1;
        if let Some((_, join)) = goes_on.filter(|_| count == MOST_CLAUSES) {
            return reader.fault(join, SentenceMessage::TooManyActivities { most: MOST_CLAUSES });
        }
        adverbs = Adverbs::default();
        start = reader.at;
        match goes_on {
            Some((join @ (ClauseJoin::And | ClauseJoin::Or), span)) => {
                if joined.is_some_and(|joined| joined != join) {
                    return reader.fault(span, SentenceMessage::AndOr);
                }
                joined = Some(join);
                let from = reader.at;
                if let Some(other) = reader.attempt(subjects::subject) {
                    (subject, who) = (other, reader.span(from));
                }
            }
            _ => {
                if !finish(reader, draft, &mut group, joined.take(), (&mut follows, heading)) {
                    return;
                }
                let Some((_, then)) = goes_on else { return };
                adverbs.when = Some(Slot { value: HabitTime::Then, span: then, own: true });
                start = reader.words.iter().position(|word| word.span.start == then.start).unwrap_or(start);
                reader.eat("she|he|they|it");
            }
        }
    }
}

fn finish(
    reader: &mut SentenceReader,
    draft: &mut RoutineDraft,
    group: &mut Vec<Clause>,
    joined: Option<ClauseJoin>,
    (follows, heading): (&mut Option<Adverbs>, Option<&Adverbs>),
) -> bool {
    conjunction::without_waking(group);
    conjunction::without_count(group);
    if let Some(unclear) = conjunction::share(group, joined) {
        reader.fault(unclear, SentenceMessage::SharedPart { text: reader.said(unclear) });
        return false;
    }
    let first = follows.clone();
    for clause in group.drain(..) {
        let own = clause.adverbs.clone();
        let merged = match (&first, heading) {
            (Some(first), _) => own.under(&days_of(first)),
            (None, Some(heading)) => own.under(heading),
            (None, None) => own,
        };
        follows.get_or_insert_with(|| merged.clone());
        build::build(reader, draft, Clause { adverbs: merged, ..clause });
    }
    true
}

struct ClauseStart<'s> {
    subject: &'s SentenceSubject,
    who: TextSpan,
    cooked: Option<&'s crate::routine::Meal>,
    before: Option<&'s Clause>,
}

fn clause(
    reader: &mut SentenceReader,
    said: ClauseStart,
    mut adverbs: Adverbs,
    place: Option<(String, TextSpan)>,
    start: usize,
) -> Option<Clause> {
    let now = |reader: &mut SentenceReader| (reader.eat("now") && reader.peek(0) != "and").then_some(());
    while reader.eat("also|still|again|only|just|either|both") || reader.attempt(now).is_some() {}
    adverbs.all(reader);
    let is_person = *said.subject == SentenceSubject::Person;
    // "She likes to read and knit": both are liked.
    let goes_on_liking = said.before.is_some_and(|before| before.tends) && !is_third_person(reader.peek(0));
    let needs_to = is_person && indirect::needs_to(reader);
    let tends = is_person && !needs_to && indirect::tends(reader) || goes_on_liking;
    adverbs.all(reader);
    let is_who = said.before.is_some_and(|before| matches!(before.predicate, Predicate::Age(_) | Predicate::Remark));
    let from = reader.at;
    if is_who && ["a", "an", "the"].contains(&reader.peek(0)) {
        while reader.token(0) == Some(Token::Word) && !["and", "but", "who"].contains(&reader.peek(0)) {
            reader.at += 1;
        }
        let (predicate, predicate_span) = (Predicate::Remark, reader.span(from));
        let (span, subject) = (reader.span(start), said.subject.clone());
        return Some(Clause {
            span,
            subject,
            predicate,
            predicate_span,
            place,
            measure: None,
            adverbs,
            tends,
            again: false,
            beside: Vec::new(),
            finder: None,
        });
    }
    let noun = if tends || needs_to { noun_liked(reader) } else { None };
    let negated = said.before.is_some_and(|before| matches!(before.predicate, Predicate::Not(_)))
        && !is_third_person(reader.peek(0));
    let (found, predicate_span) = match noun {
        Some(noun) => noun,
        None => predicate(reader, said.subject, said.who, &mut adverbs, said.cooked)?,
    };
    let found = match found {
        // "She does not cook or clean": neither is done.
        Predicate::Does(activity) if negated => Predicate::Not(activity),
        Predicate::Own(words) if tends || needs_to => Predicate::Own(activities::in_third_person(&words)),
        other => other,
    };
    // The person is who goes out, or is on the phone, whoever makes them.
    let does_person = matches!(found, Predicate::Does(_) | Predicate::HelpedBy(..) | Predicate::VisitedBy(_));
    let subject = if does_person && !is_person { SentenceSubject::Person } else { said.subject.clone() };
    let beside =
        if found == Predicate::Visits && !is_visit(reader, predicate_span) { vec![predicate_span] } else { Vec::new() };
    Some(Clause {
        span: reader.span(start),
        subject,
        predicate: found,
        predicate_span,
        place,
        measure: None,
        adverbs,
        tends,
        again: false,
        beside,
        finder: None,
    })
}

fn is_visit(reader: &mut SentenceReader, span: TextSpan) -> bool {
    reader.ahead(|reader| {
        reader.at = reader.words.iter().position(|word| word.span.start >= span.start).unwrap_or(reader.at);
        help::visiting(reader).is_some()
    })
}

/// "enjoys her crossword": the noun stands for what is done.
fn noun_liked(reader: &mut SentenceReader) -> Option<(Predicate, TextSpan)> {
    let from = reader.at;
    let found = if reader.peek(0).ends_with("ing") { None } else { indirect::noun_with_adjective(reader) };
    let Some(found) = found else {
        reader.at = from;
        return None;
    };
    Some((Predicate::Does(found), reader.span(from)))
}

fn is_third_person(word: &str) -> bool {
    word.ends_with('s') && !word.ends_with("ss")
}

fn again(reader: &mut SentenceReader, last: &Clause, adverbs: &mut Adverbs) -> Option<Clause> {
    let ends = |reader: &SentenceReader| {
        reader.is_over() || reader.token(0) == Some(Token::Comma) || ["and", "or", "then"].contains(&reader.peek(0))
    };
    let _ = reader.attempt(|reader| {
        reader.eat("again").then_some(())?;
        reader.ahead(|reader| Adverbs::default().next(reader)).then_some(())
    });
    let from = reader.at;
    let mut more = Adverbs::default();
    reader.skip_commas();
    while more.next(reader) {
        // "at 7:30, 12:30 and 17:00": each is one more.
        let is_another = |reader: &mut SentenceReader| {
            reader.skip_commas();
            let mut another = Adverbs::default();
            another.next(reader) && another.when.is_some()
        };
        if reader.token(0) == Some(Token::Comma) && more.when.is_some() && reader.ahead(is_another) {
            break;
        }
        if !reader.ahead(|reader| {
            reader.skip_commas();
            reader.eat("and|or")
        }) {
            reader.skip_commas();
        }
    }
    if reader.at > from {
        if !ends(reader) {
            *adverbs = more;
            return None;
        }
        let (says_when, chance) = (more.when.is_some(), more.chance.clone());
        let says_days = more.weekdays.is_some() || more.every.is_some() || more.of_month.is_some();
        let mut all = more.under(&last.adverbs);
        all.chance = if says_days { chance } else { all.chance };
        if says_when {
            all.part = None;
        }
        return Some(Clause { adverbs: all, again: true, beside: Vec::new(), ..last.clone() });
    }
    // Another verb begins something else.
    if reader.ahead(|reader| activities::activity(reader).is_some()) {
        return None;
    }
    let verb = reader.words.iter().position(|word| word.span.start == last.predicate_span.start)?;
    let (activity, taken) = (1..=3).find_map(|length| {
        let before = reader.words.get(verb..verb + length).filter(|_| verb + length <= from)?;
        let words: Vec<_> = before.iter().chain(reader.words.get(from..)?).cloned().collect();
        let mut joined = SentenceReader {
            words: &words,
            at: 0,
            names: reader.names,
            faults: &mut *reader.faults,
            text: reader.text,
            part: None,
        };
        let activity = activities::activity(&mut joined)?;
        let taken = joined.at.checked_sub(length).filter(|taken| *taken > 0)?;
        // "Eats lunch and skips dinner" has another verb.
        (taken == 1 || !is_third_person(reader.peek(0))).then_some((activity, taken))
    })?;
    reader.at = from + taken;
    let predicate = match &last.predicate {
        Predicate::Does(_) => Predicate::Does(activity),
        Predicate::Not(_) => Predicate::Not(activity),
        Predicate::Helps(_, help) => Predicate::Helps(activity, *help),
        _ => return None,
    };
    let adverbs = Adverbs::default();
    let predicate_span = last.predicate_span.to(reader.span(from));
    let beside = Vec::new();
    Some(Clause { predicate, predicate_span, adverbs, again: true, place: None, measure: None, beside, ..last.clone() })
}

fn days_of(first: &Adverbs) -> Adverbs {
    Adverbs {
        weekdays: first.weekdays.clone(),
        months: first.months.clone(),
        every: first.every.clone(),
        of_month: first.of_month.clone(),
        kind: first.kind.clone(),
        from: first.from.clone(),
        until: first.until.clone(),
        for_days: first.for_days.clone(),
        over: first.over.clone(),
        fading: first.fading.clone(),
        ..Adverbs::default()
    }
}

fn of_visitor(reader: &mut SentenceReader, name: &str, who: TextSpan) -> Option<Predicate> {
    let lexicon = reader.names.lexicon.clone();
    let done = lexicon.nouns.iter().find(|(noun, _)| noun.written.split('|').any(|noun| noun == name));
    let said = reader.said(who);
    let message = if let Some((_, activity)) = done {
        WordMessage::NotAVisitor { text: said, activity: activities::phrase(activity).to_string() }
    } else if reader.names.has(name, Sort::Thing) {
        WordMessage::ThingActs { text: said, thing: name.to_owned() }
    } else if reader.names.lexicon.has_last("TOPICS", name) && remarks::of_topic(reader).is_some()
        || name == subjects::WRITERS && remarks::of_mind(reader)
    {
        return Some(Predicate::Remark);
    } else if let Some(found) = help::visiting(reader) {
        return Some(found);
    } else if remarks::remark(reader).is_some() {
        return Some(Predicate::Remark);
    } else if let Some(found) = help::seeing_to(reader) {
        return Some(found);
    } else {
        let is_somebody = ["PEOPLE", "RELATIVES"].iter().any(|list| lexicon.has_last(list, name));
        if is_somebody {
            WordMessage::VisitorActs { text: said, visitor: name.to_owned() }
        } else {
            WordMessage::NotAPerson { text: said }
        }
    };
    reader.fault(who, message);
    None
}

fn predicate(
    reader: &mut SentenceReader,
    subject: &SentenceSubject,
    who: TextSpan,
    adverbs: &mut Adverbs,
    cooked: Option<&crate::routine::Meal>,
) -> Option<(Predicate, TextSpan)> {
    let from = reader.at;
    let found = match subject {
        SentenceSubject::Visitor(name) => Some(of_visitor(reader, name, who)?),
        SentenceSubject::Hours | SentenceSubject::Pulse | SentenceSubject::Breathing => {
            let found = predicates::of_body(reader, subject);
            if found.is_none() {
                reader.fault(reader.span(from), WordMessage::BodyChange { text: reader.said(who) });
                return None;
            }
            found
        }
        _ => {
            if let Some(verb) = past_verb(reader).filter(|_| !reader.ahead(|reader| remarks::remark(reader).is_some()))
            {
                return is_past(reader, &verb);
            }
            predicates::predicate(reader, adverbs)
        }
    };
    if let Some(found) = found {
        return Some((found, reader.span(from)));
    }
    if reader.is_over() {
        reader.fault(who, SentenceMessage::Unfinished);
        return None;
    }
    let is_negated = reader.at > from;
    if let Some(found) = meal_meant(reader, cooked.filter(|_| !is_negated)) {
        return found.map(|activity| (Predicate::Does(activity), reader.span(from)));
    }
    if let Some(verb) = reader.names.lexicon.verb_of_past(reader.peek(0)).filter(|_| !is_negated) {
        return is_past(reader, &verb);
    }
    let own = predicate::own_words(reader);
    if is_negated {
        let span = own.map_or(reader.here(), |(_, span)| span);
        unknown_word::unknown_not(reader, span);
        return None;
    }
    let Some((words, span)) = own else {
        let span = nothing_of_its_own(reader);
        let words = reader.said(span).to_lowercase();
        unknown_word::unknown_verb(reader, &words, span);
        return None;
    };
    if unknown_word::is_nearly_known(&words) {
        unknown_word::unknown_verb(reader, &words, span);
        return None;
    }
    Some((Predicate::Own(words), span))
}

fn past_verb(reader: &SentenceReader) -> Option<String> {
    let word = reader.peek(0);
    // "used to" is a remark.
    let is_past = word.ends_with("ed") && !["need", "feed", "used"].contains(&word);
    reader.names.lexicon.verb_of_past(word).filter(|_| is_past && activities_begin(reader, word))
}

fn activities_begin(reader: &SentenceReader, word: &str) -> bool {
    reader.names.lexicon.beginning(word).next().is_some()
}

fn is_past<T>(reader: &mut SentenceReader, verb: &str) -> Option<T> {
    let (text, verb) = (reader.said(reader.here()), super::lexicon::third_person(verb));
    reader.fault(reader.here(), WordMessage::PastTense { text, verb });
    reader.at = reader.words.len();
    None
}

/// The words of an activity that begins with one that is known to begin something else: "has visitors".
fn nothing_of_its_own(reader: &mut SentenceReader) -> TextSpan {
    let from = reader.at;
    if reader.eat("has|have") {
        predicate::own_words(reader);
        return reader.span(from);
    }
    reader.here()
}

/// "eats" or "cooks" without saying what: the meal just cooked, or a fault.
fn meal_meant(reader: &mut SentenceReader, cooked: Option<&crate::routine::Meal>) -> Option<Option<Activity>> {
    let from = reader.at;
    let eats = reader.eat("eats|eat|has|have");
    if !eats && !reader.eat("cooks|cook|prepares|prepare|makes|make") {
        return None;
    }
    let is_end = reader.is_over() || reader.token(0) != Some(Token::Word) || begins_adverb(reader);
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
            reader.fault(span, WordMessage::WhichMeal { text: reader.said(span), meals });
            Some(None)
        }
    }
}
