//! Messages about unknown words: the probable meaning, near words, other ways to say it.

use super::activities;
use super::faults::did_you_mean;
use super::messages::WordMessage;
use super::reader::{SentenceReader, Sort, begins_adverb, is_determiner};
use super::words::{TextSpan, Token};
use homebody_core::nearest::nearest;
use homebody_core::problem::Advice;

pub type UnknownWordMessage = fn(String, Option<Advice>) -> WordMessage;

pub fn no_place(text: String, help: Option<Advice>) -> WordMessage {
    WordMessage::UnknownPlace { text, help }
}

pub fn no_place_or_time(text: String, help: Option<Advice>) -> WordMessage {
    WordMessage::UnknownPlaceOrTime { text, help }
}

pub fn no_thing(text: String, help: Option<Advice>) -> WordMessage {
    WordMessage::UnknownThing { text, help }
}

pub fn unknown_name(reader: &mut SentenceReader, sorts: &[Sort], unknown: UnknownWordMessage) -> String {
    unknown_name_or(reader, sorts, unknown, None)
}

pub fn unknown_name_or(
    reader: &mut SentenceReader,
    sorts: &[Sort],
    unknown: UnknownWordMessage,
    far: Option<&str>,
) -> String {
    reader.skip_determiners();
    let from = reader.at;
    let ends = |reader: &SentenceReader| ["she", "he", "they", "when", "if", "where"].contains(&reader.peek(0));
    let stops =
        |reader: &SentenceReader| reader.is_over() || reader.token(0) != Some(Token::Word) || begins_adverb(reader);
    while !stops(reader) && !ends(reader) && reader.at < from + 4 {
        reader.at += 1;
    }
    let span = if reader.at == from { reader.here() } else { reader.span(from) };
    let said = reader.said(span);
    if reader.faults.is_trial {
        reader.fault(span, unknown(said.clone(), None));
        return said;
    }
    let known = did_you_mean(&said.to_lowercase(), reader.names.of(sorts));
    let near = known.filter(|advice| far.is_none() || advice.fix.is_some());
    let is_weather = |word: &str| ["weather", "rain", "rainy", "sunny", "wet", "snow"].contains(&word);
    if said.to_lowercase().split(' ').any(is_weather) {
        reader.fault(span, unknown(said.clone(), Some(NO_WEATHER.into())));
        return said;
    }
    reader.fault(span, unknown(said.clone(), near.or(far.map(Advice::from))));
    said
}

pub const NO_WEATHER: &str =
    "Homebody has no weather: write the season, \"in winter\", or how often, \"on 60 % of days\"";

pub fn unknown_verb(reader: &mut SentenceReader, words: &str, span: TextSpan) {
    unknown_doing(reader, words, span, None);
}

pub fn unknown_doing(reader: &mut SentenceReader, words: &str, span: TextSpan, example: Option<String>) {
    let said = reader.said(span);
    let unknown = |help: Option<Advice>| WordMessage::UnknownVerb { text: said.clone(), help };
    if reader.faults.is_trial {
        return reader.fault(span, unknown(None));
    }
    let known = match (meant(words), goes_with(words)) {
        (Some(phrase), _) => return reader.fault(span, unknown(Some(Advice::meant(&phrase)))),
        (None, Some(known)) => Some(format!("known activities are {known}")),
        (None, None) => None,
    };
    let is_new = |_: &String| looks_like_doing(words);
    let own = example.filter(is_new).or_else(|| own_example(reader, words).filter(|_| known.is_none())).map(|example| {
        format!("a new activity needs a place and a duration: {example:?}; out of the home, write \"she goes out for 2 hours\"")
    });
    let hint = match (known, own) {
        (Some(known), Some(own)) => Some(format!("{known}; {own}")),
        (known, own) => known.or(own),
    };
    reader.fault(span, unknown(hint.map(Advice::from)));
}

fn own_example(reader: &SentenceReader, words: &str) -> Option<String> {
    const SEATS: [&str; 3] = ["armchair", "sofa", "dining chair"];
    if !looks_like_doing(words) {
        return None;
    }
    let seat = SEATS.iter().find(|seat| reader.names.has(seat, Sort::Place)).map(|seat| format!("in the {seat}"));
    let place = seat.or_else(|| reader.names.of(&[Sort::Room]).next().map(|room| format!("in the {room}")));
    Some(format!("she {words} {} for 20 minutes", place.unwrap_or_else(|| "in the kitchen".to_owned())))
}

pub fn looks_like_doing(words: &str) -> bool {
    const NO_DOING: &str = "is goes comes walks moves gets likes wants needs becomes has seems feels knows leaves returns arrives \
        does follows manages describes spends misses shares holds limits treats benefits copes insists gives takes puts brings \
        carries finds uses means looks stares says says asks tells tries keeps stops starts begins appears remains stays lives shows suffers hardly always";
    const TURNING: &str = "not no never without when because if while so that which who she he they and or but more less too as than \
        lot lots of any much many her him them me us you it this up down out off back away cannot it's slowly well badly";
    let mut list = words.split(' ');
    let verb = list.next().unwrap_or_default();
    let is_verb = verb.len() > 3
        && verb.ends_with('s')
        && !verb.ends_with("ss")
        && !NO_DOING.split_whitespace().any(|other| other == verb);
    is_verb
        && words.split(' ').count() <= 5
        && !list.any(|word| TURNING.split_whitespace().any(|other| other == word) || word.ends_with("ly"))
}

pub fn unknown_not(reader: &mut SentenceReader, span: TextSpan) {
    let said = reader.said(span);
    if reader.faults.is_trial {
        return reader.fault(span, WordMessage::UnknownVerb { text: said, help: None });
    }
    let help = match meant(&activities::in_third_person(&said.to_lowercase())) {
        Some(phrase) => Advice::meant(&phrase),
        None => "leave the sentence out; to end a new activity, write until when it happens: \"until week 12 she whittles in the \
            armchair for 1 hour\""
            .into(),
    };
    reader.fault(span, WordMessage::UnknownVerb { text: said, help: Some(help) });
}

pub fn is_way(words: &str) -> bool {
    !words.contains(' ') && ["go", "walk", "move", "come"].iter().any(|verb| activities::is_form(verb, words))
}

fn goes_with(words: &str) -> Option<String> {
    const FEW: usize = 4;
    let verb = words.split(' ').next()?;
    let known = activities::all_phrases().iter().filter(|phrase| phrase.split(' ').next() == Some(verb));
    let known: Vec<String> = known.take(FEW).map(|phrase| format!("{phrase:?}")).collect();
    (!known.is_empty()).then(|| known.join(", "))
}

fn is_known_verb(verb: &str) -> bool {
    activities::all_phrases().iter().any(|phrase| phrase.split(' ').next() == Some(verb))
}

pub fn meant(words: &str) -> Option<String> {
    let words: Vec<&str> = words.split(' ').filter(|word| !is_determiner(word)).collect();
    let verb = words.first().copied().unwrap_or_default();
    let is_verb = is_known_verb(verb);
    let phrases = activities::all_phrases();
    let verbs = ["shows", "skips", "forgets", "sleeps", "breathes", "walks", "turns in bed", "prepares", "visits"];
    let all = phrases.iter().map(String::as_str).chain(verbs);
    // As many words of what was said as the phrase has; the longest phrase that is near wins.
    let said: Vec<String> = (0..=words.len()).map(|length| words[..length].join(" ")).collect();
    let mut best: Option<(usize, &str)> = None;
    let is_of_verb = |phrase: &&str| {
        !is_verb || phrase.strip_prefix(verb).is_some_and(|rest| rest.is_empty() || rest.starts_with(' '))
    };
    for phrase in all.filter(is_of_verb) {
        let length = phrase.split(' ').count();
        let slips = if length < words.len() { 1 } else { 2 };
        let said = said.get(length).filter(|said| said.len().abs_diff(phrase.len()) <= 2);
        let is_near = said.is_some_and(|said| is_slip(said, phrase, slips) && nearest(said, [phrase]).is_some());
        if is_near && best.is_none_or(|(longest, _)| length > longest) {
            best = Some((length, phrase));
        }
    }
    best.map(|(_, phrase)| phrase.to_owned())
}

fn is_slip(said: &str, phrase: &str, slips: usize) -> bool {
    let (same, longer) = same_letters(said, phrase);
    same + slips >= longer
}

pub fn is_slip_of(said: &str, known: &str) -> bool {
    said.as_bytes().first() == known.as_bytes().first() && is_slip(said, known, 1)
}

pub fn is_nearly_known(words: &str) -> bool {
    let words: Vec<&str> = words.split(' ').filter(|word| !is_determiner(word)).collect();
    let near = |(said, known): (&&str, &str)| {
        // Slips are seldom in the first letter: who sings does not ring. And who does a puzzle does not doze.
        if said.as_bytes().first() != known.as_bytes().first() || said.len().abs_diff(known.len()) > 1 {
            return false;
        }
        let (same, longer) = same_letters(said, known);
        **said == *known || *said != "does" && longer >= 4 && same + 1 >= longer
    };
    let first = words.first().and_then(|word| word.as_bytes().first());
    let is_near = |phrase: &String| {
        if phrase.as_bytes().first() != first {
            return false;
        }
        let count = phrase.split(' ').count();
        // Many short verbs differ by a letter: who stops does not shop.
        let is_long = count > 1 || phrase.len() >= 6;
        is_long && count <= words.len() && words.iter().zip(phrase.split(' ')).all(near)
    };
    activities::all_phrases().iter().any(is_near)
}

fn same_letters(a: &str, b: &str) -> (usize, usize) {
    let (longer, shorter) = if a.len() < b.len() { (b.as_bytes(), a.as_bytes()) } else { (a.as_bytes(), b.as_bytes()) };
    let front = longer.iter().zip(shorter).take_while(|(a, b)| a == b).count();
    let back =
        longer.iter().rev().zip(shorter.iter().rev()).take(shorter.len() - front).take_while(|(a, b)| a == b).count();
    (front + back, longer.len())
}
