//! Finds activities among the words of a sentence, by the ways of saying them that the lexicon has.

use super::calendar;
pub use super::lexicon::third_person;
use super::lexicon::{Lexicon, LexiconPhrase, PhrasePiece, PieceKind};
use super::person_word::person_called;
use super::reader::{SentenceReader, is_beginning, is_determiner};
use super::words::Token;
use crate::routine::{Activity, Meal};
use std::collections::BTreeSet;
use std::sync::LazyLock;

pub const MEALS: [(&str, Meal); 3] =
    [("breakfast", Meal::Breakfast), ("lunch", Meal::Lunch), ("dinner|supper", Meal::Dinner)];

pub fn activity(reader: &mut SentenceReader) -> Option<Activity> {
    let lexicon = reader.names.lexicon.clone();
    let ways = lexicon.beginning(reader.peek(0));
    let fits = ways.filter_map(|(way, activity)| fits(reader, way).map(|end| (end, activity)));
    let (end, activity) = fits.max_by_key(|(end, _)| *end)?;
    reader.at = end;
    Some(activity.clone())
}

pub fn event(reader: &mut SentenceReader) -> Option<Activity> {
    reader.attempt(|reader| {
        let back = reader.at;
        reader.skip_determiners();
        if let Some(event) = noun(reader) {
            return Some(event);
        }
        reader.at = back;
        if reader.eat("she|he|they|it") || person_called(reader) || reader.person() == Some(false) {
            reader.eat("has|have");
        }
        activity(reader)
    })
}

pub fn noun(reader: &mut SentenceReader) -> Option<Activity> {
    let lexicon = reader.names.lexicon.clone();
    let found = lexicon.nouns.iter().filter_map(|(noun, activity)| fits(reader, noun).map(|end| (end, activity)));
    let (end, activity) = found.max_by_key(|(end, _)| *end)?;
    reader.at = end;
    Some(activity.clone())
}

pub fn fits(reader: &SentenceReader, way: &LexiconPhrase) -> Option<usize> {
    let mut at = 0;
    for piece in &way.pieces {
        let mut ahead = at;
        while ahead > 0 && is_determiner(reader.peek(ahead)) {
            ahead += 1;
        }
        if piece.after_others {
            ahead += adjectives(reader, ahead, piece);
        }
        let after_determiners = length(reader, piece, ahead, at).map(|length| ahead + length);
        // "Her" may be the word that is wanted.
        let end = after_determiners.or_else(|| length(reader, piece, at, at).map(|length| at + length));
        match (end, piece.optional) {
            (Some(end), _) => at = end,
            (None, true) => {}
            (None, false) => return None,
        }
    }
    Some(reader.at + at)
}

fn length(reader: &SentenceReader, piece: &PhrasePiece, ahead: usize, from: usize) -> Option<usize> {
    let word = reader.peek(ahead);
    let is_one = |found: bool| found.then_some(1);
    match &piece.is {
        PieceKind::Verb(forms) => is_one(forms.contains(word)),
        PieceKind::Word(either) => is_one(either.iter().any(|wanted| wanted == word)),
        PieceKind::List(name) => reader.names.lexicon.list(name, |at| reader.peek(ahead + at)),
        PieceKind::Oneself => is_one(["herself", "himself", "themselves", "themself", "itself"].contains(&word)),
        PieceKind::Whom => somebody(reader, ahead, from),
        PieceKind::Host => somebody(reader, ahead, from).filter(|_| !is_here(reader, word)),
        PieceKind::More => more(reader, ahead),
    }
}

fn somebody(reader: &SentenceReader, ahead: usize, from: usize) -> Option<usize> {
    const WHICH: &str = "best|old|younger|elder|older|oldest|youngest|eldest|late|next|two|three|local";
    let word = reader.peek(ahead);
    let is_name = |at: usize| {
        is_capital(reader, at) && !calendar::is_weekday(reader.peek(at)) && !calendar::is_month(reader.peek(at))
    };
    if ahead == from {
        let is_somebody = is_name(ahead)
            || ["friends", "relatives", "family", "neighbours", "neighbors", "her", "him", "them", "me", "us"]
                .contains(&word);
        return is_somebody.then_some(1);
    }
    if word.is_empty() || is_beginning(word) || reader.token(ahead) != Some(Token::Word) || calendar::is_weekday(word) {
        // "Calls her every morning", where her is nobody's.
        let of_it = reader.peek(ahead - 1);
        return (["her", "him", "them"].contains(&of_it)).then_some(0);
    }
    let which =
        usize::from(WHICH.split('|').any(|which| which == word) && reader.token(ahead + 1) == Some(Token::Word));
    let name = usize::from(is_name(ahead + which + 1));
    Some(1 + which + name)
}

fn is_capital(reader: &SentenceReader, ahead: usize) -> bool {
    let word = reader.words.get(reader.at + ahead).filter(|_| reader.at + ahead > 0);
    word.is_some_and(|word| {
        let text = reader.text.get(word.span.start..word.span.end).unwrap_or_default();
        word.token == Token::Word && text.starts_with(char::is_uppercase) && text.to_lowercase() == word.text
    })
}

fn is_here(reader: &SentenceReader, word: &str) -> bool {
    reader.names.has_first(word) || ["bathroom", "toilet", "loo", "restroom"].contains(&word)
}

static TURNING: LazyLock<BTreeSet<&str>> = LazyLock::new(|| {
    "no not never without nothing less fewer more because when so as that which who if unless cannot she he they \
    too lot lots plenty much many little few two three four five six seven eight nine ten only"
        .split_whitespace()
        .collect()
});

static PARTS: LazyLock<BTreeSet<&str>> = LazyLock::new(|| {
    "morning afternoon evening night bedtime nighttime mornings afternoons evenings nights".split(' ').collect()
});
static NAMED_BY_PARTS: LazyLock<BTreeSet<&str>> = LazyLock::new(|| {
    "news programme programmes show shows paper film service prayer prayers meal mass class dress wear"
        .split(' ')
        .collect()
});

fn is_plain(reader: &SentenceReader, ahead: usize) -> bool {
    let word = reader.peek(ahead);
    let is_time = || PARTS.contains(word) && !NAMED_BY_PARTS.contains(reader.peek(ahead + 1));
    let is_manner = word.len() > 4 && word.ends_with("ly") && word != "family";
    reader.token(ahead) == Some(Token::Word)
        && !is_manner
        && !is_determiner(word)
        && !is_beginning(word)
        && !TURNING.contains(word)
        && !is_time()
}

fn adjectives(reader: &SentenceReader, from: usize, piece: &PhrasePiece) -> usize {
    const MOST: usize = 3;
    let is_wanted = |ahead: usize| length(reader, piece, from + ahead, from + ahead).is_some();
    let is_passed = |ahead: usize| (0..ahead).all(|ahead| is_plain(reader, from + ahead));
    // Of "quiz shows", the shows.
    (1..=MOST).rev().find(|&ahead| is_wanted(ahead) && is_passed(ahead)).unwrap_or(0)
}

fn more(reader: &SentenceReader, from: usize) -> Option<usize> {
    const MOST: usize = 4;
    let count = (0..MOST).take_while(|ahead| is_plain(reader, from + ahead)).count();
    (count > 0).then_some(count)
}

pub fn is_form(verb: &str, word: &str) -> bool {
    // All forms of a verb here begin with the same letter, which spares making them.
    let may_be = word.as_bytes().first() == verb.as_bytes().first();
    may_be && Lexicon::built_in().forms(verb).iter().any(|form| form == word)
}

/// "goes to the bathroom" of "go to the bathroom".
pub fn in_third_person(doing: &str) -> String {
    match doing.split_once(' ') {
        Some((verb, rest)) => format!("{} {rest}", third_person(verb)),
        None => third_person(doing),
    }
}

/// The usual way of saying an activity: "watches television".
pub fn phrase(activity: &Activity) -> String {
    match activity {
        Activity::Other(words) => words.clone(),
        known => Lexicon::built_in().usual(known).unwrap_or_default().to_owned(),
    }
}

pub fn usual_phrases(lexicon: &Lexicon) -> impl Iterator<Item = String> {
    lexicon.told().map(str::to_owned)
}

pub fn all_phrases() -> &'static [String] {
    static ALL: LazyLock<Vec<String>> = LazyLock::new(spell_out);
    &ALL
}

fn spell_out() -> Vec<String> {
    let mut all = Vec::new();
    for (way, _) in &Lexicon::built_in().ways {
        let said = || way.written.split(' ').filter(|wanted| !wanted.starts_with('[') && *wanted != "...");
        let is_open = |wanted: &str| {
            wanted == "*for" || wanted.trim_start_matches('*').chars().all(|c| c.is_ascii_uppercase() || c == '|')
        };
        if way.written.contains("...") || said().any(is_open) {
            continue;
        }
        let mut phrases = vec![String::new()];
        for wanted in said().map(|wanted| wanted.trim_start_matches('*')) {
            let forms: Vec<String> = match wanted.strip_prefix('~') {
                Some(verbs) => verbs.split('|').map(third_person).collect(),
                None => wanted.split('|').map(str::to_owned).collect(),
            };
            let longer =
                |said: &String| forms.iter().map(|form| format!("{said} {form}").trim().to_owned()).collect::<Vec<_>>();
            phrases = phrases.iter().flat_map(longer).collect();
        }
        all.extend(phrases);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn verbs_are_known_in_their_forms() {
        for (verb, forms) in [
            ("get", "gets getting got"),
            ("watch", "watches watching watched"),
            ("tidy", "tidies tidying tidied"),
            ("take", "takes taking taken"),
            ("go", "goes going gone"),
            ("lie", "lies lying"),
        ] {
            assert!(forms.split(' ').all(|form| is_form(verb, form)), "{verb}");
        }
        assert!(!is_form("wash", "was"));
    }

    #[test]
    fn what_can_be_said_is_in_the_table_of_activities_and_all_else_there_has_a_reason() {
        use homebody_core::activity::{
            ACTIVITIES, AIRING, FETCHING_MAIL, FRESHENING_UP, HELPING, LEAVING_HOME, PUTTING_CLOTHES_AWAY, RESTING,
            ROAMING, SEEING_TO_KITCHEN, SLEEPING, TIDYING, VISITING, WAITING, WALKING,
        };
        let said: Vec<Activity> = Activity::all_of_table().collect();
        let mut labels: Vec<&str> = said.iter().map(Activity::label).collect();
        // The night, parts of outings and visits, and pets.
        labels.extend([SLEEPING, LEAVING_HOME, VISITING, HELPING, RESTING, ROAMING]);
        // Ways and waits belong to the activity that follows.
        labels.extend([WAITING, WALKING]);
        // Small errands, of which nobody speaks: together they are housework.
        labels.extend([TIDYING, SEEING_TO_KITCHEN, PUTTING_CLOTHES_AWAY, AIRING, FETCHING_MAIL, FRESHENING_UP]);
        labels.sort();
        let mut known: Vec<&str> = ACTIVITIES.iter().map(|known| known.label).collect();
        known.sort();
        assert_eq!(labels, known);
        let lexicon = Lexicon::built_in();
        for activity in &said {
            assert!(homebody_core::activity::known(activity.label()).unwrap().usual.is_some(), "{activity:?}");
            assert!(lexicon.usual(activity).is_some(), "{activity:?}");
            assert!(
                lexicon.ways.iter().any(|(_, known)| known == activity) || *activity == Activity::Visit,
                "{activity:?}"
            );
        }
    }

    #[test]
    fn phrases_are_spoken_in_the_third_person() {
        assert_eq!(phrase(&Activity::WatchTelevision), "watches television");
        assert_eq!(phrase(&Activity::Eat(Meal::Dinner)), "eats dinner");
        assert!(all_phrases().contains(&"takes bath".to_owned()));
    }
}
