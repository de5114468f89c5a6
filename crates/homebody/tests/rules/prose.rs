//! Plain words: how often the project's sentences have habits that make readers stop, by channel. Documents, messages and the page may
//! have as many per 1,000 sentences as well-written projects have; comments and texts in code may only get better.
//!
//! The rates of the models were measured on the comments of jiff, tokio and typst in November 2026: the highest of the three.

use super::markdown::Document;
use super::{File, expect_none, files, numbered};
use homebody::messages::all;

/// A habit, and how many of 1,000 sentences may have it.
struct Habit {
    name: &'static str,
    rate: f64,
    has: fn(&[&str]) -> bool,
}

const HABITS: [Habit; 12] = [
    Habit { name: "opens with What, Who or Where", rate: 1.9, has: |words| opens(words, &FUSED) },
    Habit { name: "opens with How", rate: 6.5, has: |words| opens(words, &["how"]) },
    Habit { name: "opens with Whether", rate: 25.6, has: |words| opens(words, &["whether"]) },
    Habit { name: "is told, is said", rate: 0.1, has: |words| pair(words, &BE, &["told", "said"]) },
    Habit { name: "goes on", rate: 0.3, has: |words| pair(words, &["go", "goes", "gone", "going", "went"], &["on"]) },
    Habit { name: "live for simulate", rate: 3.4, has: lives },
    Habit {
        name: "somebody, nobody",
        rate: 0.1,
        has: |words| any(words, &["somebody", "nobody", "anybody", "whoever"]),
    },
    Habit { name: "beside", rate: 0.1, has: |words| any(words, &["beside"]) },
    Habit { name: "(ours)", rate: 0.0, has: |words| any(words, &["(ours)"]) },
    Habit {
        name: "of which, in whom",
        rate: 8.2,
        has: |words| pair(words, &PREPOSITIONS, &["which", "whom", "whose"]),
    },
    Habit { name: "is none, is no x", rate: 11.5, has: |words| pair(words, &["is", "are"], &["none", "no"]) },
    Habit { name: "as it is", rate: 1.0, has: as_it_is },
];

const FUSED: [&str; 8] = ["what", "who", "whoever", "whatever", "whose", "whichever", "where", "wherever"];
const BE: [&str; 6] = ["is", "are", "was", "were", "be", "been"];
const PREPOSITIONS: [&str; 7] = ["of", "by", "in", "with", "for", "from", "to"];

/// So many habits may be in the comments of the code, and in the texts that it holds. A change that makes them fewer lowers the number.
const MOST_IN_COMMENTS: usize = 892;
const MOST_IN_TEXTS: usize = 275;

#[test]
fn documents_are_in_plain_words() {
    let of = |file: &File| {
        let lines =
            Document::new(&file.text).prose.into_iter().filter(|(_, line)| !line.trim_start().starts_with(['|', '#']));
        sentences(&file.path, lines)
    };
    let documents: Vec<File> = files().into_iter().filter(|file| file.is("md")).collect();
    expect_none(too_often(&documents.iter().flat_map(of).collect::<Vec<_>>()));
}

#[test]
fn messages_are_in_plain_words() {
    let texts =
        all().flat_map(|entry| [Some(entry.text), entry.hint, Some(entry.about)].map(|text| (entry.code, text)));
    let of = |(code, text): (&str, Option<&'static str>)| {
        sentences(code, text.into_iter().flat_map(numbered).map(|(number, line)| (number, line.to_owned())))
    };
    expect_none(too_often(&texts.flat_map(of).collect::<Vec<_>>()));
}

#[test]
fn the_page_is_in_plain_words() {
    let is_page = |file: &File| (file.is("svelte") || file.is("ts")) && file.path.starts_with("web/src/");
    let page: Vec<File> = files().into_iter().filter(|file| is_page(file) && !is_test(&file.path)).collect();
    expect_none(too_often(
        &page.iter().flat_map(|file| sentences(&file.path, texts(file).into_iter())).collect::<Vec<_>>(),
    ));
}

#[test]
fn comments_and_texts_of_the_code_only_get_plainer() {
    let code: Vec<File> =
        files().into_iter().filter(|file| ["rs", "ts", "svelte", "py"].iter().any(|end| file.is(end))).collect();
    let comments: Vec<Sentence> =
        code.iter().flat_map(|file| sentences(&file.path, comments(file).into_iter())).collect();
    let is_program = |file: &&File| file.is("rs") && file.path.contains("/src/") && !is_test(&file.path);
    let texts: Vec<Sentence> =
        code.iter().filter(is_program).flat_map(|file| sentences(&file.path, texts(file).into_iter())).collect();
    let all = [("comments", found(&comments), MOST_IN_COMMENTS), ("texts", found(&texts), MOST_IN_TEXTS)];
    let more = all.into_iter().filter(|(_, found, most)| found.len() > *most);
    let names = HABITS.map(|habit| habit.name).join("; ");
    let told = |(of, found, most): (&str, Vec<_>, usize)| {
        format!("{of} have {} habits, and may have {most}. Search the lines that you added for: {names}", found.len())
    };
    expect_none(more.map(told).collect());
}

#[test]
fn habits_are_found() {
    for (line, name) in [
        ("What it does here is long.", "opens with What, Who or Where"),
        ("Then it is said again.", "is told, is said"),
        ("It goes on for days.", "goes on"),
        ("The run is lived again.", "live for simulate"),
        ("A file that nobody reads.", "somebody, nobody"),
        ("The file beside it.", "beside"),
        ("A length (ours).", "(ours)"),
        ("The room in which she sits.", "of which, in whom"),
        ("The file is none of ours.", "is none, is no x"),
        ("It stays as it is then.", "as it is"),
    ] {
        let sentences = sentences("a.md", [(1, line.to_owned())].into_iter());
        assert_eq!(found(&sentences).iter().map(|(habit, _)| *habit).collect::<Vec<_>>(), [name], "{line}");
    }
    for line in [
        "The live view shows the living room.",
        "What does it do?",
        "Run `homebody live`, open *Live*, and see.",
        "Go one room on.",
    ] {
        assert!(found(&sentences("a.md", [(1, line.to_owned())].into_iter())).is_empty(), "{line}");
    }
    let many: Vec<Sentence> =
        (0..600).flat_map(|line| sentences("a.md", [(line, "What it does.".to_owned())].into_iter())).collect();
    assert_eq!(too_often(&many).len(), 1 + 10, "the habit, and the first places");
    assert!(too_often(&sentences("a.md", [(1, "It writes the log.".to_owned())].into_iter())).is_empty());
}

#[test]
fn texts_and_comments_are_told_apart() {
    let file =
        File::new("a.ts", "// A comment of words.\nlet a = \"a text of words\"; // and more of it\nlet b = 'no';\n");
    assert_eq!(comments(&file), [(1, "A comment of words.".into())]);
    assert_eq!(texts(&file), [(2, "a text of words".into()), (2, String::new())]);
    let page = File::new(
        "a.svelte",
        "<script>\nlet a = 1;\n</script>\n<p title=\"A title of words\">Words of {a} the page</p>\n",
    );
    let of_page: Vec<String> = texts(&page).into_iter().map(|(_, text)| text).filter(|text| !text.is_empty()).collect();
    assert_eq!(of_page, ["A title of words", "Words of … the page"]);
}

/// A sentence, and where it begins.
struct Sentence {
    place: String,
    text: String,
}

fn is_test(path: &str) -> bool {
    path.contains("test") || path.contains("/benches/")
}

/// The sentences of lines; an empty line ends one.
fn sentences(path: &str, lines: impl Iterator<Item = (usize, String)>) -> Vec<Sentence> {
    let mut all: Vec<Sentence> = Vec::new();
    let (mut is_open, mut last) = (false, 0);
    for (number, line) in lines {
        let line = line.trim();
        let item = line.trim_start_matches(['-', '*', '>']).trim_start();
        if line.is_empty() || number > last + 1 || item.len() < line.len() {
            is_open = false;
        }
        last = number;
        let mut rest = item;
        while !rest.is_empty() {
            let (part, after) = first_sentence(rest);
            match all.last_mut().filter(|_| is_open) {
                Some(sentence) => sentence.text += &format!(" {part}"),
                None => all.push(Sentence { place: format!("{path}:{number}"), text: part.into() }),
            }
            is_open = !part.ends_with(['.', '!', '?', ':']);
            rest = after;
        }
    }
    all.retain(|sentence| sentence.text.split_whitespace().count() >= 3 && !sentence.text.ends_with('?'));
    all
}

/// The first sentence of a line, and the rest.
fn first_sentence(line: &str) -> (&str, &str) {
    let ends = line.match_indices(['.', '!', '?', ':']).map(|(at, _)| at + 1);
    let is_end = |at: &usize| {
        line[*at..]
            .strip_prefix(' ')
            .is_some_and(|rest| rest.starts_with(|c: char| c.is_uppercase() || "`\"*".contains(c)))
    };
    match ends.into_iter().find(is_end) {
        Some(at) => (&line[..at], line[at..].trim_start()),
        None => (line, ""),
    }
}

/// The habits of sentences, each with its sentence.
fn found(sentences: &[Sentence]) -> Vec<(&'static str, &Sentence)> {
    let of =
        |sentence| HABITS.iter().filter(move |habit| has(habit, sentence)).map(move |habit| (habit.name, sentence));
    sentences.iter().flat_map(of).collect()
}

fn has(habit: &Habit, sentence: &Sentence) -> bool {
    let prose: String = sentence.text.split('`').step_by(2).collect::<Vec<_>>().join("…").to_lowercase();
    // A word in emphasis is the name of a thing, such as *Live*.
    let is_name =
        |word: &&str| word.starts_with('*') && word.trim_end_matches(['.', ',', ':', ';', ')']).ends_with('*');
    let words: Vec<&str> =
        prose.split_whitespace().filter(|word| !is_name(word)).map(trimmed).filter(|word| !word.is_empty()).collect();
    (habit.has)(&words)
}

/// A word without the marks around it.
fn trimmed(word: &str) -> &str {
    if word.contains("(ours)") { "(ours)" } else { word.trim_matches(|c: char| !c.is_alphanumeric() && c != '…') }
}

/// The habits that are more frequent than in the models, each with its first places.
fn too_often(sentences: &[Sentence]) -> Vec<String> {
    let mut wrong = Vec::new();
    for habit in &HABITS {
        let places: Vec<&Sentence> = sentences.iter().filter(|sentence| has(habit, sentence)).collect();
        let most = (habit.rate * sentences.len() as f64 / 1_000.0).floor() as usize;
        if places.len() > most {
            wrong.push(format!("{}: {} of {} sentences, at most {most}", habit.name, places.len(), sentences.len()));
            wrong.extend(places.iter().take(10).map(|sentence| format!("  {}: {}", sentence.place, sentence.text)));
        }
    }
    wrong
}

/// The comments of a source file that have lines of their own.
fn comments(file: &File) -> Vec<(usize, String)> {
    let mark = if file.is("py") { "#" } else { "//" };
    let of = |(number, line): (usize, &str)| {
        let text = line.trim_start().strip_prefix(mark)?.trim_start_matches(['/', '!']);
        Some((number, text.trim().to_owned()))
    };
    numbered(&file.text).filter_map(of).collect()
}

/// The texts that a source file shows to people: literals of three words and more, and what stands between the tags of a component.
fn texts(file: &File) -> Vec<(usize, String)> {
    let mut all = Vec::new();
    let mut is_markup = false;
    for (number, line) in numbered(&file.text).take_while(|(_, line)| *line != "#[cfg(test)]") {
        let trimmed = line.trim_start();
        if file.is("svelte") {
            is_markup = match trimmed {
                _ if trimmed.starts_with("<script") || trimmed.starts_with("<style") => false,
                _ if trimmed.starts_with("</script") || trimmed.starts_with("</style") => true,
                _ => is_markup,
            };
        }
        if ["//", "/*", "* "].iter().any(|mark| trimmed.starts_with(mark)) {
            continue;
        }
        let quotes: &[char] = if file.is("rs") { &['"'] } else { &['"', '\'', '`'] };
        let mut rest = line;
        while let Some(at) = rest.find(quotes) {
            let quote = rest[at..].chars().next().unwrap_or_default();
            let Some(end) = rest[at + 1..].find(quote) else { break };
            let literal = &rest[at + 1..at + 1 + end];
            if literal.split_whitespace().count() >= 3 {
                all.extend([(number, literal.to_owned()), (number, String::new())]);
            }
            rest = &rest[at + end + 2..];
        }
        if is_markup {
            all.push((number, between_tags(line)));
        }
    }
    all
}

/// A line of markup without its tags and expressions.
fn between_tags(line: &str) -> String {
    let (mut text, mut tags, mut braces) = (String::new(), 0_u32, 0_u32);
    for c in line.chars() {
        match c {
            '<' if braces == 0 => tags += 1,
            '>' if braces == 0 && tags > 0 => tags -= 1,
            '{' if tags == 0 => {
                braces += 1;
                text.push('…');
            }
            '}' if tags == 0 => braces = braces.saturating_sub(1),
            _ if tags == 0 && braces == 0 => text.push(c),
            _ => {}
        }
    }
    let is_prose = text.split_whitespace().count() >= 2 && !text.contains([';', '=']);
    if is_prose { text.trim().to_owned() } else { String::new() }
}

fn opens(words: &[&str], with: &[&str]) -> bool {
    words.first().is_some_and(|word| with.contains(word))
}

fn any(words: &[&str], of: &[&str]) -> bool {
    words.iter().any(|word| of.contains(word))
}

fn pair(words: &[&str], first: &[&str], second: &[&str]) -> bool {
    words.windows(2).any(|pair| first.contains(&pair[0]) && second.contains(&pair[1]))
}

/// True for `live` and its forms, except in the fixed terms of the field.
fn lives(words: &[&str]) -> bool {
    const FORMS: [&str; 4] = ["live", "lives", "lived", "living"];
    const TERMS: [&str; 5] = ["room", "log", "view", "data", "resident"];
    let is_term = |at: usize| words.get(at + 1).is_some_and(|next| TERMS.contains(next));
    words.iter().enumerate().any(|(at, word)| FORMS.contains(word) && !is_term(at))
}

fn as_it_is(words: &[&str]) -> bool {
    const ENDS: [[&str; 2]; 4] = [["it", "is"], ["they", "are"], ["it", "was"], ["they", "were"]];
    words.windows(3).any(|three| three[0] == "as" && ENDS.contains(&[three[1], three[2]]))
}
