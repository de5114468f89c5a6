//! Mutated texts cause no panic, no problem outside of the text, and no long run time.

#![allow(
    clippy::disallowed_methods,
    clippy::disallowed_types,
    reason = "a test may look at the clock; the crate may not"
)]

use crate::home::home;
use homebody_core::random::Stream;
use homebody_routine::explain::explain;
use homebody_routine::language::activities::all_phrases;
use homebody_routine::language::{condition, routine};
use std::time::{Duration, Instant};

/// Split over several tests, which run in parallel.
const MUTANTS: u32 = 1_500;
const PARTS: u32 = 2;

/// Far more than needed, for busy machines.
const LONGEST: Duration = Duration::from_secs(30);

/// Insertions that are difficult for parsers.
const SPICE: &str = "\0|\u{feff}|\n|\r|\t|  |.|..|,|:|#|%|-|\u{2013}|\u{2019}|'|\"|0|-1|99999999999999999999|1e308|25:61|\
    2009-02-30|12:|:|a|the|then|and|every|whenever|for|from|until|at|to|\u{130}|\u{1f600}|\u{301}|\
    e\u{301}";

fn spice(stream: &mut Stream) -> &'static str {
    let all: Vec<&str> = SPICE.split('|').collect();
    all[below(stream, all.len())]
}

/// All forms of sentences.
fn seeds() -> Vec<String> {
    const SENTENCES: usize = 6;
    let lines = include_str!("forms.txt").lines().filter(|line| !line.starts_with("    ") && !line.is_empty());
    let lines: Vec<String> = lines.map(|line| line.replace(" | ", "\n")).collect();
    let headed = "Every day\n  she gets up at 07:00\n  she prepares lunch at 12:00, then eats for 20 minutes\n";
    lines.chunks(SENTENCES).map(|lines| lines.join("\n")).chain([headed.to_owned()]).collect()
}

fn below(stream: &mut Stream, bound: usize) -> usize {
    if bound > 1 { stream.below(bound as u32) as usize } else { 0 }
}

fn mutate(text: &str, other: &str, stream: &mut Stream) -> String {
    let mut bytes = text.as_bytes().to_vec();
    for _ in 0..=below(stream, 6) {
        let at = below(stream, bytes.len() + 1);
        let end = (at + below(stream, 12)).min(bytes.len());
        match below(stream, 7) {
            0 => drop(bytes.drain(at..end)),
            1 => drop(bytes.splice(at..at, spice(stream).bytes())),
            2 => bytes.iter_mut().skip(at).take(1).for_each(|byte| *byte = below(stream, 256) as u8),
            3 => {
                let copy = bytes[at..end].to_vec();
                drop(bytes.splice(at..at, copy.repeat(1 + below(stream, 40))));
            }
            4 => bytes.truncate(at),
            5 => {
                let words: Vec<&str> = other.split_whitespace().collect();
                let word = words.get(below(stream, words.len())).copied().unwrap_or_default();
                drop(bytes.splice(at..at, format!(" {word} ").bytes()));
            }
            _ => bytes[at..end].reverse(),
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

/// Reads the text as a routine and as a condition; returns the run time.
fn read(text: &str) -> Duration {
    let known = home();
    let start = Instant::now();
    let both = [routine("a.routine", text, &known), condition("a.routine", text, &known)];
    let took = start.elapsed();
    for (understood, problems) in both {
        let lines = text.split(['\n', '\r']).count() as u32;
        assert!(problems.len() <= 101 && problems.iter().all(|problem| problem.line <= lines));
        assert!(problems.windows(2).all(|two| two[1].line == 0 || two[0].line <= two[1].line));
        let explanation = explain(&understood);
        assert!(!explanation.to_text().is_empty());
        let changes = understood.habits.len() + understood.rules.len() + understood.changes.len();
        assert!(explanation.sentences.len() >= changes);
        sane(&understood, problems.is_empty());
    }
    took
}

/// A routine without problems can run.
fn sane(routine: &homebody_routine::routine::Routine, is_right: bool) {
    for habit in routine.habits.iter().filter(|_| is_right) {
        assert!((0.0..=1.0).contains(&habit.when.chance.probability), "{habit:?}");
        assert!(
            habit.when.days.every >= 1 && habit.when.days.weekdays != 0 && habit.when.days.months != 0,
            "{habit:?}"
        );
        assert!(habit.when.times.0 >= 1 && habit.when.times.0 <= habit.when.times.1, "{habit:?}");
        if let Some(lasts) = habit.when.lasts {
            assert!(lasts.low >= 0.0 && lasts.low <= lasts.from && lasts.from <= lasts.to && lasts.to <= lasts.high);
        }
    }
}

/// A part of all mutants, with a seed of its own.
fn read_or_refused(seed: u64) {
    let (seeds, mut stream) = (seeds(), Stream::named(seed, "mutations"));
    let mut longest = (Duration::ZERO, String::new());
    for _ in 0..MUTANTS / PARTS {
        let (seed, other) = (below(&mut stream, seeds.len()), below(&mut stream, seeds.len()));
        let text = mutate(&seeds[seed], &seeds[other], &mut stream);
        let took = read(&text);
        if took > longest.0 {
            longest = (took, text);
        }
    }
    assert!(longest.0 < LONGEST, "{:?} for {:?}", longest.0, longest.1);
}

#[test]
fn one_half_of_the_mutants_is_read_or_refused() {
    read_or_refused(1);
}

#[test]
fn the_other_half_of_the_mutants_is_read_or_refused() {
    read_or_refused(3);
}

#[test]
fn words_in_any_order_are_read_or_refused() {
    const TEXTS: usize = 300;
    const MOST_WORDS: usize = 58;
    let (seeds, mut stream) = (seeds().join(" "), Stream::named(4, "mutations"));
    let mut words: Vec<&str> = seeds.split_whitespace().collect();
    words.extend(all_phrases().iter().flat_map(|phrase| phrase.split(' ')));
    for _ in 0..TEXTS {
        let length = 1 + below(&mut stream, MOST_WORDS);
        let text: Vec<&str> = (0..length).map(|_| words[below(&mut stream, words.len())].trim_matches('.')).collect();
        let took = read(&text.join(" "));
        assert!(took < LONGEST, "{took:?} for {text:?}");
    }
}

#[test]
fn rubbish_is_refused() {
    let mut stream = Stream::named(2, "mutations");
    for length in [0, 1, 7, 100, 3_000, 100_000] {
        let bytes: Vec<u8> = (0..length).map(|_| below(&mut stream, 256) as u8).collect();
        assert!(read(&String::from_utf8_lossy(&bytes)) < LONGEST);
        let words: Vec<&str> = (0..length / 4).map(|_| spice(&mut stream)).collect();
        assert!(read(&words.join(" ")) < LONGEST);
    }
}

#[test]
fn long_texts_take_no_longer_than_their_length() {
    let pieces = "a| |\n|\r\n|.|. |,|#|1|1 |at |she |she reads. |then |every day\n|every |\tshe reads\n|whenever |1:|\
        1-|a.m. |\u{2019}|\u{1f600}|and a half |her |she gets up at 7 am\n|she reads after lunch\n|\
        she eats lunch after she reads\n|she flies, then\n";
    for piece in pieces.split('|') {
        assert!(read(&piece.repeat(500_000 / piece.len())) < LONGEST, "{piece:?}");
        let line: String = piece.trim_matches(['\n', '\t', '.']).repeat(1_900 / piece.len());
        assert!(read(&format!("{line}\n").repeat(50)) < LONGEST, "{piece:?}");
    }
}
