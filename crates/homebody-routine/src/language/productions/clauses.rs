//! Parts, clauses, and how clauses are joined.

use super::arguments::{Arguments, Production, parts};
use super::days::as_kind;
use super::times::{as_part, as_parts};
use super::verbs::{act_of, as_verb};
use crate::language::messages::TimeSentenceMessage;
use crate::language::parts::{Measure, Of, Parts, Said, Slot};
use crate::language::value::{Act, Clause, Join, PhraseValue, SentenceSubject, SpokenStatement, Verb};
use crate::language::words::TextSpan;
use crate::routine::{Activity, DayKind, HabitChance, PartOfDay};
use homebody_core::fuzzy::{Fuzzy, Quantifier};

/// Largest number of activities in a sequence. More need several sentences.
pub const MOST_CLAUSES: usize = 12;

const PREPOSITIONS: [&str; 6] = ["from", "every", "each", "twice", "once", "except"];

pub fn named(name: &str) -> Option<Production> {
    Some(match name {
        "and_parts" => |a| {
            let both = a.all(as_parts);
            let all = merged(a, &both[0], &both[1]);
            parts(all)
        },
        "clause" => |a| clause(a, None),
        // The first constant says what is done, which no phrase says: the words of it stand apart.
        "clause_of" => |a| {
            // None of the words stands for the activity alone.
            let span = TextSpan { start: a.span.end, ..a.span };
            let act = || Some(act_of(Activity::from_label(a.constant(0))?, span));
            let verb = match a.constant(0) {
                "Visits" => Verb::Visits,
                "Skips" => Verb::Skips(a.act()?),
                _ if a.has("not") => Verb::Not(act()?),
                _ => Verb::Does(act()?),
            };
            let subject = a.one(|value| match value {
                PhraseValue::Subject(subject) => Some(subject.clone()),
                _ => None,
            });
            if !fits(subject.as_ref(), &verb) {
                return None;
            }
            let all = a.all(as_parts).iter().fold(Parts::default(), |all, more| merged(a, &all, more));
            let subject = subject.unwrap_or(SentenceSubject::Days);
            let clause = Clause { parts: all.clone(), behind: all, ..plain(a, subject, verb) };
            Some(PhraseValue::Clause(Box::new(clause)))
        },
        "clause_then" => |a| {
            let then = a.words.iter().find(|word| word.text == "then").map(|word| word.span)?;
            clause(a, Some(then))
        },
        // "Gets up twice a night to go to the toilet": that is done at night.
        "clause_at_night" => |a| {
            let act = a.act()?;
            let both = a.all(as_parts);
            let (behind, front) = both.split_last()?;
            let front = front.first().cloned().unwrap_or_default();
            let all = merged(a, &front, behind);
            let at_night = all.part.as_ref().is_some_and(|slot| slot.value == [PartOfDay::Night]);
            let clause = plain(a, SentenceSubject::Person, Verb::Does(act));
            at_night.then(|| PhraseValue::Clause(Box::new(Clause { parts: all, behind: behind.clone(), ..clause })))
        },
        // "Usually falls at night": that is when most falls are.
        "clause_mostly" => |a| {
            let verb = a.one(as_verb)?;
            let is_fall =
                matches!(&verb, Verb::Falls(_)) || matches!(&verb, Verb::Does(act) if act.activity == Activity::Fall);
            let at = a.kids.iter().position(|kid| matches!(*kid.value, PhraseValue::PartOfDay(_)))?;
            let part = a.one(as_part)?;
            let mostly = Slot { value: part[0], span: a.kids[at].span, own: true };
            let behind = Parts { mostly: Some(mostly), ..Parts::default() };
            let behind = a.one(as_parts).map_or(behind.clone(), |parts| merged(a, &behind, &parts));
            let clause = plain(a, SentenceSubject::Person, verb);
            is_fall.then(|| PhraseValue::Clause(Box::new(Clause { parts: behind.clone(), behind, ..clause })))
        },
        "first_clause" => |a| {
            let clause = a.one(as_clause)?;
            if clause.verb == Verb::Eats {
                return None;
            }
            Some(PhraseValue::Clauses(vec![(Join::Then, clause)]))
        },
        "join" => join,
        "again" => |a| {
            let more = a.all(as_parts);
            let mut clauses = a.one(as_clauses)?;
            let (_, last) = clauses.last()?.clone();
            // "On Fridays in July and on Mondays" leaves open whether those are in July.
            let is_limited =
                last.behind.months.is_some() || last.behind.from.is_some() || last.behind.until_day.is_some();
            if is_limited && more.iter().any(|one| one.weekdays.is_some()) {
                return None;
            }
            // "Every third Monday and Friday" leaves open which Fridays.
            let begins = |kid: &super::arguments::Kid| a.words.iter().find(|word| word.span.start == kid.span.start);
            if a.kids[1..].iter().any(|kid| {
                begins(kid).is_some_and(|word| {
                    word.text.len() > 2
                        && !PREPOSITIONS.contains(&word.text.as_str())
                        && as_parts(&kid.value).is_some_and(|parts| parts.weekdays.is_some())
                })
            }) {
                return None;
            }
            if clauses.len() + more.len() > MOST_CLAUSES || more.iter().any(|one| one.is_empty() || one.place.is_some())
            {
                return None;
            }
            let starts: Vec<TextSpan> = a.kids[1..].iter().map(|kid| kid.span).collect();
            for (one, span) in more.into_iter().zip(starts) {
                let again = Clause { parts: one.clone(), behind: one, span, ..last.clone() };
                clauses.push((Join::Again, again));
            }
            Some(PhraseValue::Clauses(clauses))
        },
        "again_noun" => |a| {
            let mut clauses = a.one(as_clauses)?;
            let (_, last) = clauses.last()?.clone();
            let (noun, parts) = (a.act()?, a.one(as_parts)?);
            // "Takes a tablet in the morning and a statin at night": the same is done.
            // "Does the laundry and the ironing on Monday" leaves open when the first is done.
            let is_same =
                matches!(&last.verb, Verb::Does(act) if act.activity == noun.activity) && !last.parts.is_empty();
            let start = a.kids[1].span.start;
            let again = Clause { parts: parts.clone(), behind: parts, span: TextSpan { start, ..a.span }, ..last };
            clauses.push((Join::Again, again));
            is_same.then_some(PhraseValue::Clauses(clauses))
        },
        "heading" => |a| Some(PhraseValue::Statement(Box::new(SpokenStatement::Heading(a.one(as_parts)?)))),
        "statement" => |a| statement(a, None),
        "statement_then" => |a| {
            let end = a.kids[0].span.start;
            let then = a.words.iter().map(|word| word.span).take_while(|span| span.start < end).reduce(TextSpan::to)?;
            statement(a, Some(then))
        },
        "statement_then_behind" => |a| {
            let (front, clauses) = (a.kids[0].span.end, a.kids[1].span.start);
            let then = a.words.iter().map(|word| word.span).find(|span| front <= span.start && span.start < clauses)?;
            statement(a, Some(then))
        },
        "days_are" => |a| {
            let (mut front, mut kind) = (a.one(as_parts)?, a.all(as_kind));
            let very = a.has("very") || a.words.iter().any(|word| word.text == "very");
            let kind = kind.pop()?;
            if front.chance.as_ref().is_some_and(|slot| slot.value.chance.quantifier == Some(Quantifier::Every)) {
                front.chance = None;
            }
            let clause = days_are(a, kind, very, a.span);
            Some(PhraseValue::Statement(Box::new(SpokenStatement::Clauses(front, vec![(Join::Then, clause)]))))
        },
        "days_are_both" => |a| {
            let (fronts, kinds) = (a.all(as_parts), a.all(as_kind));
            let clauses = fronts.iter().zip(kinds).map(|(front, kind)| {
                let clause = days_are(a, kind, false, a.span);
                (Join::Then, Clause { parts: front.clone(), ..clause })
            });
            Some(PhraseValue::Statement(Box::new(SpokenStatement::Clauses(Parts::default(), clauses.collect()))))
        },
        "some_and_some" => |a| {
            let kinds = a.all(as_kind);
            let clauses = kinds.into_iter().map(|kind| (Join::Then, days_are(a, kind, false, a.span)));
            Some(PhraseValue::Statement(Box::new(SpokenStatement::Clauses(Parts::default(), clauses.collect()))))
        },
        "days_differ" => |a| {
            let measure = a.slot(Measure { of: Of::Much, by: Fuzzy::exactly(2.0) });
            let clause = plain(a, SentenceSubject::Hours, Verb::Differ);
            let clause = Clause { parts: Parts { measure, ..Parts::default() }, ..clause };
            Some(PhraseValue::Statement(Box::new(SpokenStatement::Clauses(
                Parts::default(),
                vec![(Join::Then, clause)],
            ))))
        },
        "sleeps_in" => |a| {
            let clause = plain(a, SentenceSubject::Person, Verb::SleepsIn);
            Some(PhraseValue::Statement(Box::new(SpokenStatement::Clauses(
                Parts::default(),
                vec![(Join::Then, clause)],
            ))))
        },
        _ => return None,
    })
}

fn plain(a: &Arguments, subject: SentenceSubject, verb: Verb) -> Clause {
    Clause { subject, verb, verb_span: a.span, parts: Parts::default(), behind: Parts::default(), span: a.span }
}

fn days_are(a: &Arguments, kind: DayKind, very: bool, span: TextSpan) -> Clause {
    Clause { span, ..plain(a, SentenceSubject::Person, Verb::Lively(kind, very)) }
}

/// Both together; what is said twice is a problem.
pub fn merged(a: &mut Arguments, first: &Parts, second: &Parts) -> Parts {
    let (mut all, twice) = first.and(second);
    for (span, first, meaning) in twice {
        let (text, first, meaning) = (a.said(span), a.said(first), meaning.to_owned());
        a.fault(span, TimeSentenceMessage::Twice { text, first, meaning });
    }
    // "Rarely at first": the first probability becomes the second.
    if let (Some(chance), Some(becomes)) = (&mut all.chance, all.becomes.clone())
        && chance.value.chance.becomes.is_none()
    {
        chance.value.chance.becomes = Some(becomes.value);
        all.becomes = None;
    }
    all
}

fn clause(a: &mut Arguments, then: Option<TextSpan>) -> Option<PhraseValue> {
    let at = a.kids.iter().position(|kid| matches!(*kid.value, PhraseValue::Verb(_)))?;
    let (mut verb, verb_span) = (a.one(as_verb)?, a.kids[at].span);
    let subject = a.one(|value| match value {
        PhraseValue::Subject(subject) => Some(subject.clone()),
        _ => None,
    });
    let before = a.kids[..at].iter().find_map(|kid| as_parts(&kid.value)).unwrap_or_default();
    let mut behind = a.kids[at + 1..].iter().find_map(|kid| as_parts(&kid.value)).unwrap_or_default();
    if let Verb::Does(act) = &mut verb {
        let Act { place, lasts, .. } = act;
        let slot = |span| span;
        let more = Parts {
            place: place.take().map(|value| Slot { value, span: slot(verb_span), own: true }),
            lasts: lasts.take().map(|value| Slot { value, span: slot(verb_span), own: true }),
            ..Parts::default()
        };
        behind = merged(a, &more, &behind);
    }
    if let Some(span) = then {
        let when = Parts { when: Some(Slot { value: vec![Said::Then], span, own: true }), ..Parts::default() };
        behind = merged(a, &when, &behind);
    }
    let all = merged(a, &before, &behind);
    let is_visitor = matches!(subject, Some(SentenceSubject::Visitor(_)));
    if !(is_visitor && matches!(verb, Verb::Does(_)) || fits(subject.as_ref(), &verb)) {
        return None;
    }
    // The person is on the phone or out, whoever takes part.
    let subject = match (subject, &verb) {
        (_, Verb::Does(_)) if is_visitor => SentenceSubject::Person,
        (Some(subject), _) => subject,
        (None, _) => SentenceSubject::Days,
    };
    Some(PhraseValue::Clause(Box::new(Clause { subject, verb, verb_span, parts: all, behind, span: a.span })))
}

/// Whether who it is can do that. Without a subject, it is that of the clause before.
fn fits(subject: Option<&SentenceSubject>, verb: &Verb) -> bool {
    let of_body = matches!(verb, Verb::Vary | Verb::Differ | Verb::Rises(_));
    match (subject, verb) {
        (None, _) => true,
        (Some(SentenceSubject::Stranger(_)), Verb::Visits) => true,
        (Some(SentenceSubject::Person | SentenceSubject::Stranger(_)), Verb::Visits | Verb::Helps(..)) => false,
        (Some(SentenceSubject::Person | SentenceSubject::Stranger(_)), _) => !of_body,
        (Some(SentenceSubject::Visitor(_)), verb) => matches!(verb, Verb::Visits | Verb::Helps(..)),
        (Some(SentenceSubject::Hours | SentenceSubject::Days), verb) => matches!(verb, Verb::Vary | Verb::Differ),
        (Some(SentenceSubject::Pulse | SentenceSubject::Breathing), verb) => matches!(verb, Verb::Rises(_) | Verb::Is),
    }
}

pub fn as_clause(value: &PhraseValue) -> Option<Clause> {
    match value {
        PhraseValue::Clause(clause) => Some(Clause::clone(clause)),
        _ => None,
    }
}

fn as_clauses(value: &PhraseValue) -> Option<Vec<(Join, Clause)>> {
    match value {
        PhraseValue::Clauses(clauses) => Some(clauses.clone()),
        _ => None,
    }
}

fn join(a: &mut Arguments) -> Option<PhraseValue> {
    let (mut clauses, next) = (a.one(as_clauses)?, a.one(as_clause)?);
    let join = match a.constant(0) {
        "And" => Join::And,
        "Or" => Join::Or,
        _ => Join::Then,
    };
    if clauses.len() >= MOST_CLAUSES {
        return None;
    }
    let subject = match next.subject {
        SentenceSubject::Days => clauses.last()?.1.subject.clone(),
        ref other => other.clone(),
    };
    if !fits(Some(&subject), &next.verb) {
        return None;
    }
    let before = a.kids[0].span.end;
    // "Then" belongs to the clause behind it.
    let start = match join {
        Join::Then => a.words.iter().find(|word| word.span.start >= before && word.text != "and")?.span.start,
        _ => next.span.start,
    };
    let then = TextSpan { start, end: a.kids[1].span.start.max(start) };
    let when = match (join, &next.parts.when) {
        (Join::Then, Some(_)) => return None,
        (Join::Then, None) => Some(Slot { value: vec![Said::Then], span: then, own: true }),
        (_, when) => when.clone(),
    };
    // "Does not cook or clean": neither is done.
    let verb = match (join, &clauses.last()?.1.verb, next.verb) {
        (Join::Or, Verb::Not(_), Verb::Does(act)) => Verb::Not(act),
        (_, _, Verb::Eats) => Verb::Does(eats(&clauses, next.verb_span)?),
        (_, _, verb) => verb,
    };
    let span = TextSpan { start, ..next.span };
    // "Comes at noon and makes her lunch" is one visit.
    if let (Join::And, Some((_, last)), true) = (join, clauses.last_mut(), next.parts.is_empty())
        && last.verb == Verb::Visits
        && last.subject == subject
        && matches!(verb, Verb::Helps(..))
    {
        last.verb = verb;
        last.span = last.span.to(next.span);
        return Some(PhraseValue::Clauses(clauses));
    }
    clauses.push((join, Clause { subject, verb, parts: Parts { when, ..next.parts }, span, ..next }));
    Some(PhraseValue::Clauses(clauses))
}

/// Eating the meal that was prepared before.
fn eats(clauses: &[(Join, Clause)], span: TextSpan) -> Option<Act> {
    let meal = clauses.iter().rev().find_map(|(_, clause)| match &clause.verb {
        Verb::Does(Act { activity: Activity::Prepare(meal), .. }) => Some(*meal),
        _ => None,
    })?;
    Some(act_of(Activity::Eat(meal), span))
}

fn statement(a: &mut Arguments, then: Option<TextSpan>) -> Option<PhraseValue> {
    let mut clauses = a.one(as_clauses)?;
    let front = a.one(as_parts).unwrap_or_default();
    if clauses.iter().any(|(_, clause)| clause.subject == SentenceSubject::Days) {
        return None;
    }
    let first = &mut clauses[0].1;
    if let Some(span) = then {
        first.parts.when = match first.parts.when {
            Some(_) => return None,
            None => Some(Slot { value: vec![Said::Then], span, own: true }),
        };
    }
    first.span = TextSpan { start: a.span.start, ..first.span };
    let first = first.clone();
    // The parts in front are about all; with those of the first clause they must not say a thing twice.
    merged(a, &front, &first.parts);
    Some(PhraseValue::Statement(Box::new(SpokenStatement::Clauses(front, clauses))))
}

/// The probability of a kind of days of which none is said.
pub fn unsaid_chance() -> HabitChance {
    HabitChance::from_quantifier(Quantifier::Sometimes)
}
