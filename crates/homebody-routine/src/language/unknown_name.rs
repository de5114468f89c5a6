//! Sentences whose subject nobody here is: a name that is not the person's, or nobody at all.

use super::activities;
use super::adverbs::Adverbs;
use super::draft::RoutineDraft;
use super::faults::did_you_mean;
use super::messages::WordMessage;
use super::predicate_tail::slip;
use super::reader::{SentenceReader, begins_adverb, is_determiner};
use super::subjects::SentenceSubject;
use super::visits::visits;
use super::words::{TextSpan, Token};

pub fn stranger(reader: &mut SentenceReader) -> Option<SentenceSubject> {
    const LONGEST: usize = 4;
    let from = reader.at;
    let is_capital =
        |span: TextSpan| reader.text.get(span.start..).is_some_and(|text| text.starts_with(char::is_uppercase));
    let here = reader.here();
    if !is_capital(here) && reader.peek(1) != "is" {
        return None;
    }
    let is_known =
        reader.ahead(|reader| activities::activity(reader).is_some() || super::amounts::number(reader).is_some());
    let is_name = |reader: &SentenceReader| {
        let pronoun = ["she", "he", "they", "it"].contains(&reader.peek(0));
        reader.token(0) == Some(Token::Word) && !pronoun && !begins_adverb(reader)
    };
    while !is_known && reader.at < from + LONGEST && is_name(reader) {
        reader.at += 1;
        let is_verb = |reader: &mut SentenceReader| {
            Adverbs::default().all(reader);
            reader.eat("is|walks|shows") || visits(reader) || activities::activity(reader).is_some()
        };
        if reader.ahead(is_verb) {
            return Some(SentenceSubject::Stranger(reader.said(reader.span(from))));
        }
    }
    reader.at = from;
    None
}

pub fn is_introduced(reader: &mut SentenceReader, draft: &mut RoutineDraft, name: &str, who: TextSpan) -> bool {
    if reader.ahead(visits) {
        reader.fault(who, WordMessage::UnknownVisitor { name: name.to_owned() });
        return false;
    }
    if let Some(person) = reader.names.person.clone() {
        let hint = did_you_mean(name, [person.as_str()].into_iter()).filter(|advice| advice.fix.is_some());
        let help = hint.unwrap_or_else(|| "each person has a routine of their own".into());
        reader.fault(who, WordMessage::OtherPerson { person, name: name.to_owned(), help });
        return false;
    }
    if draft.is_condition {
        reader.fault(who, WordMessage::ConditionName { name: name.to_owned() });
        return false;
    }
    if reader.peek(0) != "is" {
        reader.fault(who, WordMessage::UnknownPerson { name: name.to_owned() });
        return false;
    }
    draft.name = Some(name.to_owned());
    true
}

pub fn no_subject(reader: &mut SentenceReader) {
    let from = reader.at;
    if activities::activity(reader).is_some() {
        let span = reader.span(from);
        let help = format!("write \"she {}\"", activities::in_third_person(&reader.said(span).to_lowercase()));
        return reader.fault(span, WordMessage::NoSubject { help });
    }
    if is_determiner(reader.peek(0)) && reader.token(1) == Some(Token::Word) {
        reader.at += 2;
        let span = reader.span(from);
        return reader.fault(span, WordMessage::UnknownAction { text: reader.said(span) });
    }
    let (here, word) = (reader.here(), reader.peek(0).to_owned());
    if reader.faults.is_trial {
        return reader.fault(here, WordMessage::NotUnderstood { text: word, help: None });
    }
    if begins_adverb(reader) {
        reader.at = (from + 3).min(reader.words.len());
        let (span, text) = (reader.span(from), reader.said(reader.span(from)));
        let help = "expected when or where: \"in the morning\", \"on Monday\", \"from week 6\", \"in the kitchen\"";
        return reader.fault(span, WordMessage::NotUnderstood { text, help: Some(help.into()) });
    }
    let help = slip(&word).unwrap_or_else(|| {
        "a sentence says who does what: \"she gets up at about 06:45\", \"her daughter visits on Sunday\"".into()
    });
    reader.fault(here, WordMessage::NotUnderstood { text: reader.said(here), help: Some(help) });
}
