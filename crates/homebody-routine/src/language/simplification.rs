//! Hints that are held to what they say: a sentence that a hint proposes is understood. Where a hint proposes none, the sentence
//! is tried without the words that stand in the way, and what is understood of it then is proposed.

use super::activities::{self, fits};
use super::adverbs::Adverbs;
use super::calendar::is_weekday;
use super::draft::RoutineDraft;
use super::faults::Faults;
use super::lexicon::third_person;
use super::parts::parts_of;
use super::reader::{HomeNames, SentenceReader, denies, is_beginning, is_determiner};
use super::single_sentence::read_alone;
use super::synonym::reworded;
use super::words::{self, SentenceWord, TextSpan, Token};
use crate::routine::{Activity, Routine};

/// Largest number of ways of leaving words out that are tried for a sentence.
const MOST_TRIES: usize = 120;
/// Length above which no words of a sentence are left out.
const LONGEST: usize = 40;

/// Largest number of problems of a text whose hints are searched for (our choice).
const MOST_SEARCHED: usize = 20;

const KEPT: &str = "to keep it as a comment, put a # before it";

pub fn hints(faults: &mut Faults, since: usize, names: &HomeNames, draft: &RoutineDraft, words: &[SentenceWord]) {
    let mut shorter: Option<Option<String>> = None;
    let mut clearer: Option<Option<String>> = None;
    let mut gist: Option<Option<String>> = None;
    for fault in faults.since(since) {
        let proposed = fault.message.hint.as_deref().map(sentences_in).unwrap_or_default();
        let is_sound = proposed.iter().all(|sentence| understood(names, draft, sentence).is_some());
        if !is_sound {
            (fault.message.hint, fault.message.fix) = (None, None);
        }
        if since >= MOST_SEARCHED {
            continue;
        }
        let is_certain = fault.message.fix.is_some();
        if !is_certain && let Some(clearer) = clearer.get_or_insert_with(|| clearer_than(names, draft, words)).clone() {
            let before = fault.message.hint.take().filter(|hint| !is_sound || !is_general(hint));
            let clearer = format!("write it as in {clearer:?}");
            fault.message.hint = Some(before.map_or(clearer.clone(), |before| format!("{before}; {clearer}")));
            continue;
        }
        let is_example = fault.message.hint.as_deref().is_some_and(is_general);
        if (proposed.is_empty() || is_example) && !is_certain || !is_sound {
            let without = shorter.get_or_insert_with(|| without(names, draft, words, fault.span)).clone();
            let part =
                |gist: &mut Option<Option<String>>| gist.get_or_insert_with(|| gist_of(names, draft, words)).clone();
            let without = match without {
                Some(without) => format!("without it: {without:?}"),
                None => match part(&mut gist) {
                    Some(gist) => format!("the part that can be simulated: {gist:?}"),
                    None if is_certain => continue,
                    None => KEPT.to_owned(),
                },
            };
            fault.message.hint =
                Some(fault.message.hint.take().map_or(without.clone(), |hint| format!("{hint}; {without}")));
        }
    }
}

fn is_general(hint: &str) -> bool {
    ["expected", "there are", "known activities are", "each person", "a sentence says", "write \"after breakfast"]
        .iter()
        .any(|begin| hint.starts_with(begin))
}

fn sentences_in(hint: &str) -> Vec<String> {
    let quoted = hint.split('"').skip(1).step_by(2);
    let is_whole = |quoted: &&str| {
        let first = quoted.split(' ').next().unwrap_or_default();
        ["she", "he", "her", "his"].contains(&first) && quoted.contains(' ') && !quoted.contains("...")
    };
    quoted.filter(is_whole).map(str::to_owned).collect()
}

fn understood(names: &HomeNames, draft: &RoutineDraft, text: &str) -> Option<Routine> {
    let words = reworded(names, text, &words::of_name(text));
    let empty = |routine: &Routine| *routine == Routine::default();
    read_alone(names, draft, text, &words).filter(|routine| !empty(routine))
}

fn clearer_than(names: &HomeNames, draft: &RoutineDraft, words: &[SentenceWord]) -> Option<String> {
    if words.len() > LONGEST {
        return None;
    }
    let lexicon = names.lexicon.clone();
    let (mut said, mut is_other): (Vec<String>, bool) = (Vec::new(), false);
    let mut faults = Faults::of_trial();
    let mut reader = SentenceReader { words, at: 0, names, faults: &mut faults, text: draft.text, part: None };
    while let Some(word) = words.get(reader.at) {
        let ways = lexicon
            .hinted(&word.text)
            .chain(lexicon.roughly(&word.text))
            .filter_map(|(way, meant)| Some((fits(&reader, way)?, meant)));
        if let Some((end, meant)) = ways.max_by_key(|(end, _)| *end) {
            said.extend(meant.split(' ').filter(|word| !word.is_empty()).map(str::to_owned));
            is_other = true;
            reader.at = end;
            continue;
        }
        let written = draft.text.get(word.span.start..word.span.end).unwrap_or_default();
        let written = if written.to_lowercase() == word.text { written } else { &word.text };
        let past = lexicon.verb_of_past(&word.text);
        is_other |= past.is_some();
        said.push(past.map_or(written.to_owned(), |verb| third_person(&verb)));
        reader.at += 1;
    }
    let text = said.join(" ").replace(" ,", ",").replace(" ;", ";");
    let text = text.trim_matches([',', ' ']);
    let mut chars = text.chars();
    let text = chars.next().map_or(String::new(), |first| first.to_lowercase().chain(chars).collect());
    let begins = ["she ", "he ", "her ", "his ", "in ", "on ", "at ", "from ", "for ", "every ", "since "]
        .iter()
        .any(|first| text.starts_with(first));
    (is_other && begins && understood(names, draft, &text).is_some()).then_some(text)
}

fn is_sentence(text: &str) -> bool {
    const BEFORE: [&str; 10] =
        ["often", "usually", "always", "never", "sometimes", "rarely", "seldom", "also", "mostly", "occasionally"];
    let mut after = text.split(' ').skip_while(|word| !["she", "he"].contains(&word.to_lowercase().as_str())).skip(1);
    after.find(|word| !BEFORE.contains(word)).is_none_or(|verb| verb.ends_with('s') && !verb.ends_with("ss"))
}

fn gist_of(names: &HomeNames, draft: &RoutineDraft, words: &[SentenceWord]) -> Option<String> {
    let of_part = |part: &[SentenceWord]| gist(names, draft, part);
    of_part(words).or_else(|| parts_of(names, words).into_iter().find_map(of_part))
}

fn gist(names: &HomeNames, draft: &RoutineDraft, words: &[SentenceWord]) -> Option<String> {
    const MOST: usize = 3;
    if words.len() > LONGEST || words.iter().any(|word| denies(&word.text)) {
        return None;
    }
    let words = &reworded(names, draft.text, words);
    let mut faults = Faults::of_trial();
    let mut reader = SentenceReader { words, at: 0, names, faults: &mut faults, text: draft.text, part: None };
    let (mut doing, mut when): (Option<String>, Vec<String>) = (None, Vec::new());
    let mut comes: Option<String> = None;
    let lexicon = names.lexicon.clone();
    while !reader.is_over() {
        let from = reader.at;
        // "Tea" and "the bathroom" may be anything's.
        let is_doing = |activity: &Activity| {
            !matches!(activity, Activity::UseBathroom | Activity::Drink | Activity::GoToBed | Activity::Fall)
        };
        let named = |reader: &mut SentenceReader| {
            activities::activity(reader).or_else(|| activities::noun(reader).filter(is_doing))
        };
        if doing.is_none()
            && let Some(activity) = reader.attempt(named)
        {
            doing = Some(activities::phrase(&activity)).filter(|phrase| !phrase.is_empty());
            continue;
        }
        let somebody = ["PEOPLE", "RELATIVES"].iter().find_map(|list| lexicon.list(list, |ahead| reader.peek(ahead)));
        if let Some(length) = somebody.filter(|_| comes.is_none()) {
            reader.at += length;
            comes = Some(format!("her {} visits", reader.passed(from)));
            continue;
        }
        let before = reader.faults.count();
        let mut adverbs = Adverbs::default();
        if when.len() < MOST && adverbs.next(&mut reader) && reader.faults.count() == before {
            let said = reader.passed(from);
            let before = match reader.words[from].token {
                Token::Clock(..) => "at ",
                _ if ["midnight", "noon"].contains(&reader.words[from].text.as_str()) => "at ",
                _ if is_weekday(&reader.words[from].text) => "on ",
                _ => "",
            };
            if adverbs.says_when() && !said.starts_with("with") {
                when.push(format!("{before}{said}"));
            }
            continue;
        }
        reader.faults.forget_since(before);
        reader.at = from + 1;
    }
    let comes = comes.filter(|_| !when.is_empty());
    let what = doing.map(|doing| format!("she {doing}")).or(comes)?;
    (0..=when.len()).rev().find_map(|count| {
        let text = [std::slice::from_ref(&what), &when[..count]].concat().join(" ");
        understood(names, draft, &text).map(|_| text)
    })
}

fn without(names: &HomeNames, draft: &RoutineDraft, words: &[SentenceWord], at: TextSpan) -> Option<String> {
    let first = words.iter().position(|word| word.span.end > at.start).filter(|_| words.len() <= LONGEST)?;
    // Without "alone", "she does not go out alone" says something else.
    if words.iter().any(|word| denies(&word.text)) {
        return None;
    }
    let last = words.iter().rposition(|word| word.span.start < at.end).unwrap_or(first);
    let text_of = |left_out: std::ops::Range<usize>| -> String {
        let kept = words.iter().enumerate().filter(|(index, _)| !left_out.contains(index)).map(|(_, word)| word);
        let mut text = String::new();
        for word in kept {
            let written = draft.text.get(word.span.start..word.span.end).unwrap_or_default();
            let written = if word.is_put_in() { &word.text } else { written };
            let joins = text.is_empty() || word.token == Token::Comma;
            text += if joins { "" } else { " " };
            let begins = words.first().is_some_and(SentenceWord::is_put_in);
            text += &if begins { written.to_lowercase() } else { written.to_owned() };
        }
        text.trim_matches([',', ' ']).to_owned()
    };
    let mut windows: Vec<(usize, usize)> =
        (0..=last).flat_map(|from| (first.max(from) + 1..=words.len()).map(move |to| (from, to))).collect();
    // Something has to be left of who does what.
    windows.retain(|(from, to)| words.len() - (to - from) >= 2 && to - from <= words.len() * 2 / 3 + 1);
    // No "a" or "her" without its noun.
    let is_determiner = |index: usize| words.get(index).is_some_and(|word| is_determiner(&word.text));
    windows.retain(|(from, _)| from.checked_sub(1).is_none_or(|before| !is_determiner(before)));
    // Nor "at" or "every", and best up to where something else begins.
    let is_loose = |index: usize| words.get(index).is_some_and(|word| is_beginning(&word.text));
    windows.retain(|(from, _)| from.checked_sub(1).is_none_or(|before| !is_loose(before)));
    // Nor a time without its "after".
    windows.retain(|(_, to)| words.get(*to).is_none_or(|word| matches!(word.token, Token::Word | Token::Comma)));
    // Nor a subject without its verb, or "weekend" without its "every".
    let is_subject =
        |index: usize| words.get(index).is_some_and(|word| ["she", "he", "they"].contains(&word.text.as_str()));
    windows.retain(|(from, to)| *from == 0 || *to == words.len() || !(*from..*to).any(is_subject));
    windows.retain(|(from, to)| *from > 0 || is_subject(*to) || is_loose(*to) || is_determiner(*to));
    let is_natural = |to: usize| words.get(to).is_none_or(|word| word.token != Token::Word || is_beginning(&word.text));
    windows.sort_by_key(|(from, to)| (!is_natural(*to), to - from, std::cmp::Reverse(*from)));
    windows.into_iter().take(MOST_TRIES).find_map(|(from, to)| {
        let text = text_of(from..to);
        if !is_sentence(&text) || text.contains(['(', ')']) {
            return None;
        }
        let falls = |routine: &Routine| routine.habits.iter().any(|habit| habit.activity == Activity::Fall);
        understood(names, draft, &text).filter(|routine| routine.remarks.is_empty() && !falls(routine)).map(|_| text)
    })
}
