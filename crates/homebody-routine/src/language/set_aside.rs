//! Remarks within a sentence that change nothing a home could show: "with a slice of lemon", "sitting very straight". If
//! the sentence is understood without the remark, it is used without it, and a message names the remark.
//!
//! Nothing is set aside that says when, how often, how long, whether, who else or where, that holds something Homebody knows,
//! or that may be a slip of it. What is denied, ends or changes is never read without a part of it.

use super::activities::fits;
use super::calendar::is_weekday;
use super::clause::PLACES;
use super::draft::RoutineDraft;
use super::faults::Faults;
use super::predicate_tail::vocabulary;
use super::reader::{HomeNames, SentenceReader, Sort, denies, is_beginning, is_determiner};
use super::remarks::is_lived;
use super::single_sentence::read_alone;
use super::synonym::reworded;
use super::unknown_word;
use super::words::{SentenceWord, TextSpan, Token};
use crate::routine::Routine;
use std::collections::BTreeSet;
use std::sync::LazyLock;

/// Largest number of words set aside: more are another sentence.
const LONGEST: usize = 12;
/// Largest number of ways of setting words aside that are tried for a sentence.
const MOST_TRIES: usize = 30;
/// Length above which no words of a sentence are set aside: too many ways would have to be tried.
const LONGEST_SENTENCE: usize = 40;

pub static TELLING: LazyLock<BTreeSet<&str>> = LazyLock::new(|| {
    "not no never none nor neither without nothing nobody hardly barely scarcely except unless only \
    instead rather refuses declines cannot unable if when whenever while until till once since before after during more \
    less fewer than longer shorter later sooner earlier faster slower better worse again increasingly gradually always \
    often usually sometimes rarely seldom occasionally regularly frequently constantly continually continuously repeatedly \
    intermittently periodically infrequently sporadically mostly mainly nearly almost every each daily weekly fortnightly \
    monthly yearly hourly nightly twice thrice times most all any both half quarter day days night nights week weeks month \
    months year years hour hours minute minutes second seconds morning mornings afternoon afternoons evening evenings \
    weekend weekends weekday weekdays today tomorrow yesterday tonight spring summer autumn winter january february march \
    april may june july august september october november december noon midday midnight lunchtime bedtime teatime mealtimes \
    dinnertime suppertime dusk dawn sunrise sunset late early lately recently soon then already yet am pm o'clock \
    christmas easter holiday holidays weeknight weeknights ages forever starts stops begins ends becomes becoming \
    increasing decreasing growing one two three four five six seven eight nine ten dozen couple several few many much \
    little lot lots plenty others somebody someone everybody everyone together upstairs downstairs outside outdoors away \
    first last next alternate weather rain rains raining rainy snow snows snowing snowy wet".split_whitespace().collect()
});

pub static BEGINNING: LazyLock<BTreeSet<&str>> = LazyLock::new(|| {
    "with for from to into of about among against using over through in on at by near under along across like as \
    because although though so which who that where despite due owing even very quite rather fairly really just simply"
        .split_whitespace()
        .collect()
});

pub const WHERE: &str = "in on at by near under along across";

pub struct Aside {
    pub words: Vec<SentenceWord>,
    pub left_out: Vec<TextSpan>,
}

pub fn set_aside(names: &HomeNames, draft: &RoutineDraft, words: &[SentenceWord]) -> Option<Aside> {
    if words.len() > LONGEST_SENTENCE || words.iter().any(|word| denies(&word.text)) {
        return None;
    }
    let windows = windows(names, draft, words);
    let shorter = |window: &(usize, usize), words: &[SentenceWord]| [&words[..window.0], &words[window.1..]].concat();
    let span = |window: &(usize, usize)| words[window.0].span.to(words[window.1 - 1].span);
    let one = windows.iter().take(MOST_TRIES).find(|window| is_done(names, draft, &shorter(window, words)));
    if let Some(window) = one {
        return Some(Aside { words: shorter(window, words), left_out: vec![span(window)] });
    }
    let pairs = windows.iter().flat_map(|first| {
        let after = windows.iter().filter(move |second| first.1 <= second.0);
        after.map(move |second| (first, second))
    });
    let (first, second) = pairs.take(MOST_TRIES).find(|(first, second)| {
        let without_second = shorter(second, words);
        is_done(names, draft, &shorter(first, &without_second))
    })?;
    Some(Aside { words: shorter(first, &shorter(second, words)), left_out: vec![span(first), span(second)] })
}

fn windows(names: &HomeNames, draft: &RoutineDraft, words: &[SentenceWord]) -> Vec<(usize, usize)> {
    let mut found = Vec::new();
    for from in 0..words.len() {
        // In front of who does it stands only what a comma parts from it.
        let is_in_front = from == 0;
        if !(begins(names, words, from) || is_in_front && begins_in_front(words)) {
            continue;
        }
        for to in from + 1..=words.len().min(from + LONGEST) {
            let ends = match is_in_front {
                true => words.get(to - 1).is_some_and(|word| word.token == Token::Comma),
                false => ends(words, to),
            };
            let is_clause = words[from..to].iter().any(|word| ["she", "he", "they"].contains(&word.text.as_str()));
            let is_whole = !is_clause || words.get(to).is_none_or(|next| next.token == Token::Comma);
            let is_loose = to == from + 1 && BEGINNING.contains(words[from].text.as_str());
            if ends && is_whole && !is_loose && is_beside_the_point(names, draft, words, from, to) {
                found.push((from, to));
            }
        }
    }
    found.sort_by_key(|(from, to)| (to - from, *from));
    found
}

pub fn is_one_of(list: &str, word: &str) -> bool {
    list.split_whitespace().any(|one| one == word)
}

fn begins(names: &HomeNames, words: &[SentenceWord], from: usize) -> bool {
    let word = &words[from];
    let before = from.checked_sub(1).map(|before| &words[before]);
    // No "a" or "at" is left without its noun.
    let is_loose =
        before.is_none_or(|before| is_determiner(&before.text) || is_beginning(&before.text) && before.text != "and");
    if from == 0 || is_loose || word.token == Token::Comma && before.is_none() {
        return false;
    }
    let first = if word.token == Token::Comma { words.get(from + 1) } else { Some(word) };
    let Some(first) = first else { return false };
    let text = |ahead: usize| words.get(from + ahead).map_or("", |word| word.text.as_str());
    if names.lexicon.list("ASIDES", text).is_some() {
        return true;
    }
    let next = words.get(from + 1).map_or("", |word| &word.text);
    if is_one_of(WHERE, &first.text) && ["the", "a", "an"].contains(&next) {
        return false;
    }
    let is_manner = first.text.len() > 4 && (first.text.ends_with("ly") || first.text.ends_with("ing"));
    BEGINNING.contains(first.text.as_str()) || is_manner || names.lexicon.has_last("MANNERS", &first.text)
}

/// "For her arthritis, she ...", "being a former nurse, she ...".
fn begins_in_front(words: &[SentenceWord]) -> bool {
    const OPENING: &str = "however therefore sadly unfortunately luckily thankfully apparently basically anyway overall previously \
        formerly nowadays please bless following given";
    let first = words.first().map_or("", |word| &word.text);
    BEGINNING.contains(first)
        || is_one_of(OPENING, first)
        || first.len() > 4 && (first.ends_with("ly") || first.ends_with("ing"))
}

fn ends(words: &[SentenceWord], to: usize) -> bool {
    let last = &words[to - 1];
    if last.token == Token::Word && (is_determiner(&last.text) || is_beginning(&last.text)) {
        return false;
    }
    let Some(next) = words.get(to) else { return true };
    last.token == Token::Comma
        || next.token != Token::Word
        || is_beginning(&next.text)
        || is_weekday(&next.text)
        || next.text == "then"
}

pub fn is_beside_the_point(
    names: &HomeNames,
    draft: &RoutineDraft,
    words: &[SentenceWord],
    from: usize,
    to: usize,
) -> bool {
    let mut faults = Faults::of_trial();
    let mut reader = SentenceReader { words, at: from, names, faults: &mut faults, text: draft.text, part: None };
    // "Being a former nurse" names nobody who is there.
    let is_origin = ["being", "having"].contains(&words[from].text.as_str());
    let is_plain = |reader: &mut SentenceReader| {
        let word = &words[reader.at];
        match word.token {
            Token::Comma => return [from, to - 1].contains(&reader.at),
            Token::Word if word.text.chars().all(|c| c.is_alphabetic() || c == '\'') => {}
            _ => return false,
        }
        let next = words.get(reader.at + 1).map_or("", |word| word.text.as_str());
        if ["and", "but", "or", "then", "so"].contains(&word.text.as_str()) && next.ends_with('s') {
            return false;
        }
        let before = reader.at.checked_sub(1).map_or("", |before| words[before].text.as_str());
        let names_somebody = ["with", "by", "to", "from", "of", "and"].contains(&before)
            && draft.text.get(word.span.start..).is_some_and(|text| text.starts_with(char::is_uppercase));
        !(TELLING.contains(word.text.as_str())
            || word.text.ends_with("n't")
            || is_weekday(&word.text)
            || names_somebody
            || is_known(reader, is_origin))
    };
    while reader.at < to {
        if !is_plain(&mut reader) {
            return false;
        }
        reader.at += 1;
    }
    true
}

fn is_known(reader: &mut SentenceReader, is_origin: bool) -> bool {
    let lexicon = reader.names.lexicon.clone();
    let word = reader.peek(0).to_owned();
    let is_somebody = !is_origin && ["PEOPLE", "RELATIVES"].iter().any(|list| lexicon.has_last(list, &word));
    let is_small = is_determiner(&word) || BEGINNING.contains(word.as_str());
    is_somebody
        || lexicon.has_last("ROOMS", &word)
        || reader.ahead(|reader| reader.name(&PLACES).is_some() || reader.name(&[Sort::Condition]).is_some())
        || reader.ahead(|reader| reader.person().is_some())
        || lexicon.meaning(&word).any(|(way, _)| fits(reader, way).is_some())
        || is_lived(reader)
        || !is_small && is_slip(reader, &word)
}

pub fn is_slip(reader: &SentenceReader, word: &str) -> bool {
    const SHORT: usize = 5;
    let is_near = |known: &str| known != word && unknown_word::is_slip_of(word, known);
    word.len() >= SHORT && (vocabulary().any(is_near) || reader.names.of(&PLACES).any(is_near))
}

fn is_done(names: &HomeNames, draft: &RoutineDraft, words: &[SentenceWord]) -> bool {
    let words = reworded(names, draft.text, words);
    read_alone(names, draft, draft.text, &words).is_some_and(|routine| {
        let Routine { habits, changes, rules, .. } = &routine;
        !habits.is_empty() && changes.is_empty() && rules.is_empty()
    })
}
