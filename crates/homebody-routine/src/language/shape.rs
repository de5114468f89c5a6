//! What notes leave out or put elsewhere: a sentence that is not understood as it stands is read in the shape that it stands for,
//! "she gets up at 7 am" for "Gets up at 7 am". Nothing is left out but a label such as "Sleep:".

use super::activities;
use super::adverbs::Adverbs;
use super::amounts::number;
use super::calendar::is_weekday;
use super::clause::place;
use super::draft::RoutineDraft;
use super::faults::Faults;
use super::lexicon::{third_person, words_of};
use super::predicate::named;
use super::reader::{HomeNames, SentenceReader, begins_adverb, is_determiner};
use super::single_sentence::read_alone;
use super::subjects;
use super::synonym::reworded;
use super::times;
use super::words::{SentenceWord, TextSpan, Token};

/// Number of words above which a sentence is read literally.
const LONGEST: usize = 60;

pub fn in_shape(
    names: &HomeNames,
    draft: &RoutineDraft,
    words: &[SentenceWord],
) -> (Vec<SentenceWord>, Vec<SentenceWord>) {
    let known = |words: &[SentenceWord]| reworded(names, draft.text, words);
    let reads = |words: &[SentenceWord]| read_alone(names, draft, draft.text, words).is_some();
    let plain = known(words);
    if words.len() > LONGEST || reads(&plain) {
        return (words.to_vec(), plain);
    }
    let mut tried = shapes(names, draft.text, words);
    let found = tried.iter().position(|words| reads(&known(words)));
    let found = found.or(tried.iter().position(|words| words.first().is_some_and(SentenceWord::is_put_in)));
    let found = found.or(tried.iter().position(|words| !words.iter().any(SentenceWord::is_put_in)));
    match found {
        Some(found) => {
            let words = tried.swap_remove(found);
            let reworded = known(&words);
            (words, reworded)
        }
        None => (words.to_vec(), plain),
    }
}

fn shapes(names: &HomeNames, text: &str, words: &[SentenceWord]) -> Vec<Vec<SentenceWord>> {
    let mut all: Vec<Vec<SentenceWord>> = Vec::new();
    let mut base = words.to_vec();
    for change in [
        without_label,
        contracted,
        taking_place,
        with_is,
        reported,
        without_length,
        with_both_days,
        by_now,
        counted,
        slept,
        when_then,
    ] {
        if let Some(changed) = change(names, text, &base) {
            base = changed;
            all.push(base.clone());
        }
    }
    all.extend(done_by(names, text, &base));
    all.extend(turned(names, text, &base));
    let completed = completed(names, text, &base);
    let listed: Vec<Vec<SentenceWord>> = completed.iter().filter_map(|words| listed(names, text, words)).collect();
    all.extend(completed);
    all.extend(listed);
    if base.len() < words.len() && words.iter().any(|word| word.text == ":") {
        all.push(put_in(&base, 0, "she is"));
    }
    all
}

/// "Up at 7, breakfast at 8, walk at 9": each piece is one more thing that she does.
fn listed(names: &HomeNames, text: &str, words: &[SentenceWord]) -> Option<Vec<SentenceWord>> {
    let mut found: Vec<SentenceWord> = Vec::with_capacity(words.len());
    let mut is_other = false;
    for (at, word) in words.iter().enumerate() {
        let noun = |from: usize| {
            try_out(names, text, words, |reader| {
                reader.at = from;
                (0..3).any(|_| {
                    let is_noun = reader.ahead(|reader| activities::noun(reader).is_some());
                    reader.at += 1;
                    is_noun
                })
            })
        };
        let begins_verb = words.get(at + 1).is_some_and(|next| names.lexicon.is_third_person(&next.text));
        if word.text == "," && !begins_verb && noun(at + 1) {
            let to_bed = words.get(at + 1).is_some_and(|next| next.text == "bed");
            let said = words_of(if to_bed { "and she goes to" } else { "and she has" }, word);
            let end = TextSpan { start: word.span.end, end: word.span.end };
            found.extend(said.into_iter().map(|word| SentenceWord { span: end, ..word }));
            is_other = true;
        } else {
            found.push(word.clone());
        }
    }
    is_other.then_some(found)
}

/// "Mum's up at seven": she is.
fn contracted(names: &HomeNames, _text: &str, words: &[SentenceWord]) -> Option<Vec<SentenceWord>> {
    let first = words.first()?;
    let who = first.text.strip_suffix("'s")?;
    let is_person = names.lexicon.list("PERSON", |at| if at == 0 { who } else { "" }).is_some()
        || names.person.as_ref().is_some_and(|name| name.to_lowercase() == who);
    is_person.then_some(())?;
    let is = SentenceWord { text: "is".to_owned(), ..first.clone() };
    Some([&[SentenceWord { text: who.to_owned(), ..first.clone() }, is], &words[1..]].concat())
}

/// "Bathing takes place on Tuesday": she bathes then.
fn taking_place(names: &HomeNames, _text: &str, words: &[SentenceWord]) -> Option<Vec<SentenceWord>> {
    const TAKES: [&[&str]; 5] =
        [&["takes", "place"], &["happens"], &["occurs"], &["is", "carried", "out"], &["is", "done"]];
    let from = usize::from(words.first().is_some_and(|word| is_determiner(&word.text)));
    let doing = words.get(from)?;
    let verb = names.lexicon.verb_of_gerund(&doing.text)?;
    let rest = &words[from + 1..];
    let fits =
        |takes: &&&[&str]| takes.iter().enumerate().all(|(at, one)| rest.get(at).is_some_and(|word| word.text == *one));
    let takes = TAKES.iter().find(fits)?;
    let done = [SentenceWord { text: third_person(&verb), ..doing.clone() }];
    Some(put_in(&[&done, &rest[takes.len()..]].concat(), 0, "she"))
}

/// "Mrs. Hill able to wash herself", "insulin given by the nurse", "Mum up at seven": is.
fn with_is(names: &HomeNames, text: &str, words: &[SentenceWord]) -> Option<Vec<SentenceWord>> {
    const LONGEST: usize = 4;
    let at = try_out(names, text, words, |reader| {
        (subjects::called(reader) || activities::noun(reader).is_some()).then_some(reader.at)
    })?;
    let next = words.get(at).filter(|_| at < LONGEST)?;
    let lexicon = &names.lexicon;
    let is_state = lexicon.list("STATES", |ahead| words.get(at + ahead).map_or("", |word| &word.text)).is_some()
        || STATES.split(' ').any(|state| state == next.text && !["in", "at", "on"].contains(&state));
    let is_given =
        words.iter().skip(at + 1).any(|by| by.text == "by") && lexicon.verb_of_participle(&next.text).is_some();
    (is_state || is_given).then(|| put_in(words, at, "is"))
}

/// "has two naps a day": naps, two times a day.
fn counted(names: &HomeNames, text: &str, words: &[SentenceWord]) -> Option<Vec<SentenceWord>> {
    (1..words.len()).find_map(|from| {
        let (count, noun) = try_out(names, text, words, |reader| {
            reader.at = from;
            reader.eat("about|around");
            let _ = reader.attempt(|reader| {
                number(reader)?;
                reader.eat("to|or").then_some(())
            });
            number(reader)?;
            let count = reader.at;
            const MOST: usize = 3;
            while reader.token(0) == Some(Token::Word) && !begins_adverb(reader) && reader.at < count + MOST {
                if reader.peek(0).ends_with('s') && ["a", "per", "each", "every"].contains(&reader.peek(1)) {
                    reader.at += 1;
                    break;
                }
                reader.at += 1;
            }
            let noun = reader.at;
            let is_had =
                from > 0 && ["has", "takes", "drinks", "eats", "have"].contains(&words[from - 1].text.as_str());
            let is_end = reader.is_over() || begins_adverb(reader) || reader.token(0) == Some(Token::Comma);
            let is_counted = noun > count
                && (is_had && is_end || reader.eat("a|per|each|every") && reader.eat("day|night|week|morning|evening"));
            let is_unit =
                ["times", "days", "hours", "minutes", "nights", "meals", "afternoons", "mornings", "evenings"];
            (is_counted && !is_unit.contains(&words[noun - 1].text.as_str())).then_some((count, noun))
        })?;
        let named = words[count..noun].iter().map(|word| {
            let one = word.text.strip_suffix('s').filter(|one| one.len() > 2);
            SentenceWord { text: one.unwrap_or(&word.text).to_owned(), ..word.clone() }
        });
        let named: Vec<SentenceWord> = named.collect();
        let mut shaped = [&words[..from], &named, &words[from..count]].concat();
        let at = shaped.len();
        shaped.extend_from_slice(&words[noun..]);
        Some(put_in(&shaped, at, "times"))
    })
}

/// "The client reports that he sleeps badly": what is said is what follows.
fn reported(_names: &HomeNames, _text: &str, words: &[SentenceWord]) -> Option<Vec<SentenceWord>> {
    const SAYS: [&str; 16] = [
        "reports",
        "says",
        "states",
        "tells",
        "admits",
        "explains",
        "mentions",
        "note",
        "notes",
        "recommended",
        "observed",
        "reported",
        "said",
        "noticed",
        "noted",
        "confirms",
    ];
    const NEAR: usize = 6;
    let said = words.iter().take(NEAR).position(|word| SAYS.contains(&word.text.as_str()))?;
    let rest = words.get(said + 1..)?;
    let rest = if rest.first()?.text == "that" { &rest[1..] } else { rest };
    let is_whole = rest.first().is_some_and(|first| ["she", "he", "they", "her", "his"].contains(&first.text.as_str()));
    is_whole.then(|| rest.to_vec())
}

/// "rises at 7, when she makes tea": and then.
fn when_then(_names: &HomeNames, _text: &str, words: &[SentenceWord]) -> Option<Vec<SentenceWord>> {
    let is = |at: usize, one: &[&str]| words.get(at).is_some_and(|word| one.contains(&word.text.as_str()));
    let at =
        (2..words.len()).find(|&at| is(at - 1, &[","]) && is(at, &["when"]) && is(at + 1, &["she", "he", "they"]))?;
    let mut shaped = words.to_vec();
    "then".clone_into(&mut shaped[at].text);
    Some(shaped)
}

/// "sleeps from 10 pm to 6 am": goes to bed at the one time and gets up at the other.
fn slept(names: &HomeNames, text: &str, words: &[SentenceWord]) -> Option<Vec<SentenceWord>> {
    let sleeps = words.iter().position(|word| word.text.starts_with("sleep"))?;
    let (to, end) = try_out(names, text, words, |reader| {
        reader.at = sleeps + 1;
        reader.eat("usually|mostly");
        reader.eat("from|between").then_some(())?;
        let begin = reader.at;
        let (_, end) = times::time_range(reader, "to|until|till|and").map(|range| (range, reader.at))?;
        (begin..end).find(|&at| ["to", "until", "till", "and"].contains(&words[at].text.as_str())).map(|to| (to, end))
    })?;
    let begin = (sleeps..to).find(|&at| ["from", "between"].contains(&words[at].text.as_str()))? + 1;
    let bed = put_in(&[&words[..sleeps], &words[begin..to]].concat(), sleeps, "goes to bed at");
    let at = bed.len();
    let shaped = [&bed, &words[to + 1..end]].concat();
    let shaped = put_in(&shaped, at, "and gets up at");
    Some([&shaped, &words[end..]].concat())
}

fn try_out<T>(names: &HomeNames, text: &str, words: &[SentenceWord], what: impl FnOnce(&mut SentenceReader) -> T) -> T {
    let mut faults = Faults::of_trial();
    what(&mut SentenceReader { words, at: 0, names, faults: &mut faults, text, part: None })
}

fn put_in(words: &[SentenceWord], at: usize, said: &str) -> Vec<SentenceWord> {
    let start = words.get(at).map_or(words.last().map_or(0, |word| word.span.end), |word| word.span.start);
    let new = SentenceWord { text: String::new(), token: Token::Word, span: TextSpan { start, end: start } };
    [&words[..at], &words_of(said, &new), &words[at..]].concat()
}

/// "Sleep: wakes twice a night."
fn without_label(names: &HomeNames, _text: &str, words: &[SentenceWord]) -> Option<Vec<SentenceWord>> {
    let length = names.lexicon.list("LABELS", |at| words.get(at).map_or("", |word| &word.text))?;
    let ends = words.get(length).is_some_and(|word| word.text == ":") && words.len() > length + 1;
    ends.then(|| words[length + 1..].to_vec())
}

fn lists(word: &SentenceWord) -> bool {
    let is_part = ["morning", "afternoon", "evening", "night"].contains(&word.text.trim_end_matches('s'));
    matches!(word.token, Token::Clock(..)) || is_weekday(&word.text) || is_part
}

/// "a 20 minute walk every day": a walk every day for 20 minutes.
fn without_length(names: &HomeNames, text: &str, words: &[SentenceWord]) -> Option<Vec<SentenceWord>> {
    (0..words.len()).find_map(|from| {
        let length = try_out(names, text, words, |reader| {
            reader.at = from;
            let half = reader.eat("half an|a") || reader.eat("half");
            (half || reader.eat("an") || number(reader).is_some()).then_some(())?;
            reader.eat("to|or").then(|| number(reader));
            reader.eat("minute|minutes|min|mins|hour|hours|hour's|minutes'|hours'").then_some(())?;
            let length = reader.at - from;
            reader.eat("long");
            let names_doing = reader.token(0) == Some(Token::Word) && !begins_adverb(reader);
            names_doing.then_some((length, reader.at))
        });
        let (length, rest) = length?;
        let joins = |word: &SentenceWord| {
            word.token == Token::Comma || ["and", "then", "or", "but"].contains(&word.text.as_str())
        };
        // "on Monday, Wednesday, and Friday": a list of days or times goes through.
        let is_end = |at: usize| joins(&words[at]) && !words[at..].iter().find(|word| !joins(word)).is_some_and(lists);
        let end = (rest..words.len()).find(|&at| is_end(at)).unwrap_or(words.len());
        let mut said = words[from..from + length].to_vec();
        if let Some(unit) = said.last_mut() {
            unit.text = unit.text.replace('\'', "");
        }
        let mut shaped = [&words[..from], &words[rest..end]].concat();
        let at = shaped.len();
        shaped.extend(said);
        shaped.extend_from_slice(&words[end..]);
        Some(put_in(&shaped, at, "for"))
    })
}

/// "on the first and third Tuesday of the month she goes out": on the first, and on the third.
fn with_both_days(_names: &HomeNames, _text: &str, words: &[SentenceWord]) -> Option<Vec<SentenceWord>> {
    const WHICH: [&str; 9] = ["first", "second", "third", "fourth", "last", "1st", "2nd", "3rd", "4th"];
    let is_which = |at: usize| words.get(at).is_some_and(|word| WHICH.contains(&word.text.as_str()));
    let and = (1..words.len()).find(|&at| words[at].text == "and" && is_which(at - 1))?;
    let second = (and + 1..words.len().min(and + 3)).find(|&at| is_which(at))?;
    let of = (second..words.len()).find(|&at| words[at].text == "of")?;
    let end = of + 3;
    let day = words.get(second + 1..end)?;
    if words[end..].iter().any(|word| ["and", "then", "or", "but"].contains(&word.text.as_str())) {
        return None;
    }
    let mut shaped = [&words[..and], day, &words[end..]].concat();
    let at = shaped.len();
    shaped.extend_from_slice(&words[second..end]);
    Some(put_in(&shaped, at, "and on the"))
}

/// "has been using a frame": uses one.
fn by_now(names: &HomeNames, _text: &str, words: &[SentenceWord]) -> Option<Vec<SentenceWord>> {
    let is = |at: usize, one: &[&str]| words.get(at).is_some_and(|word| one.contains(&word.text.as_str()));
    let at = (0..words.len()).find(|&at| is(at, &["has", "have"]) && is(at + 1, &["been"]))?;
    let doing = words.get(at + 2)?;
    let verb = names.lexicon.verb_of_gerund(&doing.text)?;
    let mut shaped = words.to_vec();
    shaped.splice(at..at + 3, [SentenceWord { text: third_person(&verb), ..doing.clone() }]);
    Some(shaped)
}

/// "Every morning and evening she reads": she reads then.
fn turned(names: &HomeNames, text: &str, words: &[SentenceWord]) -> Option<Vec<SentenceWord>> {
    let is = |word: &SentenceWord, one: &[&str]| one.contains(&word.text.as_str());
    let who = words.iter().position(|word| is(word, &["she", "he", "they"]))?;
    let (front, rest) = words.split_at(who);
    let has = |words: &[SentenceWord], one: &[&str]| words.iter().any(|word| is(word, one));
    let is_when = try_out(names, text, words, |reader| Adverbs::default().next(reader));
    if !is_when || !has(front, &["and"]) || has(rest, &["and", "or", "then", "but"]) {
        return None;
    }
    let ends = front.iter().rposition(|word| word.token != Token::Comma)?;
    Some([rest, &front[..=ends]].concat())
}

/// "She is bathed by a carer", "medication is given by the nurse": who does it goes first.
fn done_by(names: &HomeNames, text: &str, words: &[SentenceWord]) -> Option<Vec<SentenceWord>> {
    let is = words.iter().position(|word| ["is", "are"].contains(&word.text.as_str()))?;
    let verb = names.lexicon.verb_of_participle(&words.get(is + 1)?.text)?;
    let by = (is + 2..words.len()).find(|&at| words[at].text == "by")?;
    const NOBODY: [&str; 10] = ["phone", "telephone", "hand", "mouth", "bus", "taxi", "car", "train", "alarm", "post"];
    let end = try_out(names, text, words, |reader| {
        reader.at = by + 1;
        reader.skip_determiners();
        if NOBODY.contains(&reader.peek(0)) {
            return None;
        }
        named(reader).map(|_| reader.at)
    })?;
    let (front, about_person) = try_out(names, text, words, |reader| {
        Adverbs::default().all(reader);
        let front = reader.at;
        (front, subjects::subject(reader) == Some(subjects::SentenceSubject::Person) && reader.at == is)
    });
    let mut said = words[by + 1..end].to_vec();
    if said.first().is_some_and(|who| !is_determiner(&who.text)) {
        said = put_in(&said, 0, "the");
    }
    said.push(SentenceWord { text: third_person(&verb), ..words[is + 1].clone() });
    let at = said.len();
    if about_person {
        said = put_in(&said, at, "her");
    } else {
        let what: Vec<SentenceWord> =
            words[front..is].iter().filter(|word| !is_determiner(&word.text)).cloned().collect();
        said = put_in(&said, at, "her");
        said.extend(what);
    }
    Some([&words[..front], &said, &words[is + 2..by], &words[end..]].concat())
}

const BEFORE_NOUNS: [&str; 5] = ["she has", "she goes to", "she takes", "she does", "she watches"];
const STATES: &str = "up asleep awake out unable able independent unsteady incontinent continent in at on";

fn completed(names: &HomeNames, text: &str, words: &[SentenceWord]) -> Vec<Vec<SentenceWord>> {
    let at = try_out(names, text, words, |reader| {
        let mut adverbs = Adverbs::default();
        let mut has_place = false;
        loop {
            reader.skip_commas();
            if !has_place && place(reader).is_some() {
                has_place = true;
            } else if !adverbs.next(reader) {
                break;
            }
        }
        let at = reader.at;
        let has_somebody = reader.words.iter().any(|word| ["she", "he", "they", "i"].contains(&word.text.as_str()));
        let is_whole =
            has_somebody || reader.eat("whenever|when|if|then|and|or|but") || subjects::subject(reader).is_some();
        (!is_whole && at < words.len()).then_some(at)
    });
    let Some(mut at) = at else { return Vec::new() };
    let mut words = words.to_vec();
    let word = words[at].text.clone();
    if word == "to" {
        words.remove(at);
        if at >= words.len() {
            return Vec::new();
        }
        if words[at].text == "be" {
            words.remove(at);
            return vec![put_in(&words, at, "she is")];
        }
        return vec![put_in(&words, at, "she has to")];
    }
    let with = |at: usize, said: &str| put_in(&words, at, said);
    let follows = |ahead: usize, said: &str| words.get(at + ahead).is_some_and(|next| next.text == said);
    if word == "no" && follows(1, "longer") && follows(2, "able") {
        return vec![with(at, "she is")];
    }
    if word == "no" && words.get(at + 1).is_some_and(|next| next.text == "longer")
        || ["cannot", "can't", "will", "must", "may", "won't", "can", "doesn't", "should", "never"]
            .contains(&word.as_str())
        || names.lexicon.is_third_person(&word)
    {
        let is_noun = try_out(names, text, &words, |reader| {
            reader.at = at;
            activities::noun(reader).is_some() && reader.at > at + 1
        });
        let begin = if is_noun { "she has" } else { "she" };
        return vec![with(at, begin)];
    }
    if word == "not" && words.get(at + 1).is_some_and(|next| !next.text.ends_with("ing")) {
        return vec![with(at, "she is")];
    }
    // "Dialysis on Monday": she goes there.
    if names.lexicon.list("OUTSIDE", |ahead| words.get(at + ahead).map_or("", |word| &word.text)).is_some() {
        return vec![with(at, "she goes to")];
    }
    // "Carers four times a day": they come.
    let people = names.lexicon.list("PEOPLE", |ahead| words.get(at + ahead).map_or("", |word| &word.text));
    if let Some(people) = people {
        return vec![with(at + people, "come")];
    }
    if STATES.split(' ').any(|state| state == word)
        || names.lexicon.list("STATES", |ahead| words.get(at + ahead).map_or("", |word| &word.text)).is_some()
        || names.lexicon.list("CARED", |ahead| words.get(at + ahead).map_or("", |word| &word.text)).is_some()
    {
        return vec![with(at, "she is")];
    }
    const NEAR: usize = 4;
    let names_doing = try_out(names, text, &words, |reader| {
        (at..words.len().min(at + NEAR)).any(|from| {
            reader.at = from;
            activities::noun(reader).is_some()
        })
    });
    let is_had = |from: usize| {
        let is_in = |list: &&str| {
            names.lexicon.list(list, |ahead| words.get(from + ahead).map_or("", |word| &word.text)).is_some()
        };
        ["ILLS", "TOPICS"].iter().any(is_in)
    };
    let names_had = !is_determiner(&word) && (at..words.len().min(at + NEAR)).any(is_had);
    if !(names_doing || names_had) {
        return Vec::new();
    }
    // "Usually breakfast at 8": how often stands before the verb.
    at = at.min(words.len());
    let nouns = if names_doing { &BEFORE_NOUNS[..] } else { &BEFORE_NOUNS[..1] };
    nouns.iter().map(|before| with(at, before)).collect()
}
