//! The probable meaning of words that the language does not read: the section MEANT of a lexicon.
//!
//! The left side has the words as written: `a|b` is either, `[a]` may be missing, `^` is the beginning of the sentence,
//! `$` the end of a clause, "," a comma, `CAP` a word with a capital, `...` the rest of the clause, which is left out. Kept are `NUM`, a number
//! in digits, `TIME`, the words of a time of day, and `_`, one to six words. `DO` and `DOING` are forms of a known verb. The right side has
//! the words of the language: `_` is the next of the kept ones, `_2` the second, `DOES` the verb as she does it.

use super::grammar::Grammar;
use super::verb_forms::{gerund, third_person};
use super::words::TextSpan;

/// A word of a sentence that is rewritten.
#[derive(Clone, Debug, PartialEq)]
pub struct RewritingWord {
    /// In small letters.
    pub text: String,
    pub shown: String,
    /// Whether a comma stands before it.
    pub comma: bool,
    /// Whether a sentence without it says something else.
    pub counts: bool,
    /// Its place in the text; `None` for a word that was put in.
    pub span: Option<TextSpan>,
}

impl RewritingWord {
    fn of(word: &str) -> RewritingWord {
        RewritingWord { text: word.to_owned(), shown: word.to_owned(), comma: false, counts: false, span: None }
    }
}

#[derive(Clone, Debug)]
enum WordPattern {
    Start,
    End,
    Comma,
    Capital,
    Kept,
    Number,
    Time,
    Do,
    Doing,
    Rest,
    Words(Vec<String>),
}

#[derive(Clone, Debug)]
pub struct Rewriting {
    left: Vec<(WordPattern, bool)>,
    right: Vec<String>,
    /// Whether the right side has a number that the left side lacks.
    pub assumes: bool,
}

/// Largest number of words that "_" and "TIME" stand for (our choice).
const MOST_KEPT: usize = 6;

impl Rewriting {
    pub fn new(said: &str, meant: &str) -> Rewriting {
        let is_number = |word: &&str| word.contains(|c: char| c.is_ascii_digit());
        let pattern = |word: &str| {
            let optional = word.starts_with('[');
            let pattern = match word.trim_matches(['[', ']']) {
                "^" => WordPattern::Start,
                "$" => WordPattern::End,
                "," => WordPattern::Comma,
                "CAP" => WordPattern::Capital,
                "_" => WordPattern::Kept,
                "NUM" => WordPattern::Number,
                "TIME" => WordPattern::Time,
                "DO" => WordPattern::Do,
                "DOING" => WordPattern::Doing,
                "..." => WordPattern::Rest,
                words => WordPattern::Words(words.split('|').map(str::to_owned).collect()),
            };
            (pattern, optional)
        };
        Rewriting {
            left: said.split_whitespace().map(pattern).collect(),
            right: meant.split_whitespace().map(str::to_owned).collect(),
            assumes: meant
                .split_whitespace()
                .filter(is_number)
                .any(|number| !number.starts_with('_') && !said.contains(number)),
        }
    }

    /// Whether its left side has the word.
    pub fn has(&self, word: &str) -> bool {
        self.left
            .iter()
            .any(|(pattern, _)| matches!(pattern, WordPattern::Words(words) if words.iter().any(|one| one == word)))
    }

    /// Rewrites the first place that fits.
    pub fn apply(
        &self,
        pieces: &[RewritingWord],
        grammar: &Grammar,
        is_word: &dyn Fn(&str, &str) -> bool,
    ) -> Option<Vec<RewritingWord>> {
        let fitting = Fitting { pieces, grammar, is_word };
        (0..pieces.len()).find_map(|at| {
            let mut kept: Vec<KeptWords> = Vec::new();
            let end = fitting.end(&self.left, at, at, &mut kept)?;
            let verb = kept.iter().find_map(|kept| kept.does.clone());
            let said: Vec<&[RewritingWord]> =
                kept.iter().filter(|kept| kept.does.is_none()).map(|kept| &pieces[kept.words.clone()]).collect();
            let mut next = 0..said.len();
            let mut made: Vec<RewritingWord> = Vec::new();
            for word in &self.right {
                let numbered = word.strip_prefix('_').and_then(|number| number.parse::<usize>().ok());
                match (word.as_str(), numbered) {
                    ("_", _) => made.extend_from_slice(said[next.next()?]),
                    (_, Some(number)) => made.extend_from_slice(said.get(number.checked_sub(1)?)?),
                    ("DOES", _) => made.push(RewritingWord::of(verb.as_ref()?)),
                    (word, _) => made.push(RewritingWord::of(word)),
                }
            }
            // Commas belong to the left side, and words that are put in stand for all of it.
            let whole = pieces[at..end].iter().filter_map(|piece| piece.span).reduce(TextSpan::to);
            for piece in &mut made {
                piece.comma = false;
                piece.span = piece.span.or(whole);
            }
            let comma = pieces[at].comma && !matches!(self.left[0].0, WordPattern::Comma);
            if let Some(first) = made.first_mut() {
                first.comma = comma;
            }
            Some([&pieces[..at], &made, &pieces[end..]].concat())
        })
    }
}

struct KeptWords {
    words: std::ops::Range<usize>,
    /// Of a verb: its form with "she".
    does: Option<String>,
}

struct Fitting<'p> {
    pieces: &'p [RewritingWord],
    grammar: &'p Grammar,
    /// Whether a list of the lexicon has a word.
    is_word: &'p dyn Fn(&str, &str) -> bool,
}

impl Fitting<'_> {
    fn of_bare(&self, word: &str) -> Option<String> {
        let does = third_person(word);
        let is_verb = |word: &str| self.grammar.known_word(word).is_some();
        (is_verb(word) && is_verb(&does) && !(self.is_word)("determiners", word)).then_some(does)
    }

    fn of_gerund(&self, word: &str) -> Option<String> {
        let stem = word.strip_suffix("ing")?;
        let undoubled = stem.char_indices().next_back().map_or("", |(end, _)| &stem[..end]);
        let verbs = [stem.to_owned(), format!("{stem}e"), undoubled.to_owned()];
        verbs.iter().filter(|verb| gerund(verb) == word).find_map(|verb| self.of_bare(verb))
    }

    /// The end of the longest time of day that begins at a word.
    fn end_of_time(&self, at: usize) -> Option<usize> {
        let is_digit = |word: &str| word.starts_with(|c: char| c.is_ascii_digit());
        let fits = |piece: &&RewritingWord| is_digit(&piece.text) || (self.is_word)("clock", &piece.text);
        let words = self.pieces[at..].iter().take(MOST_KEPT).take_while(fits);
        let words = words.enumerate().take_while(|(index, piece)| *index == 0 || !piece.comma).count();
        let is_time = self.pieces[at..at + words]
            .iter()
            .any(|piece| is_digit(&piece.text) || (self.is_word)("hours", &piece.text));
        is_time.then_some(at + words)
    }

    /// The end of the pattern that begins at a word.
    fn end(&self, left: &[(WordPattern, bool)], start: usize, at: usize, kept: &mut Vec<KeptWords>) -> Option<usize> {
        let Some(((pattern, optional), rest)) = left.split_first() else { return Some(at) };
        let piece = self.pieces.get(at);
        let count = kept.len();
        let mut keep = |end: usize, does: Option<String>| {
            kept.push(KeptWords { words: at..end, does });
            let found = self.end(rest, start, end, kept);
            if found.is_none() {
                kept.truncate(count);
            }
            found
        };
        let ends = |at: usize| {
            self.pieces.get(at).is_none_or(|piece| at > start && piece.comma || (self.is_word)("joins", &piece.text))
        };
        let found = match pattern {
            WordPattern::Start => (at == 0).then(|| self.end(rest, start, at, kept))?,
            WordPattern::End => ends(at).then(|| self.end(rest, start, at, kept))?,
            WordPattern::Do => {
                piece.and_then(|piece| self.of_bare(&piece.text)).and_then(|does| keep(at + 1, Some(does)))
            }
            WordPattern::Doing => {
                piece.and_then(|piece| self.of_gerund(&piece.text)).and_then(|does| keep(at + 1, Some(does)))
            }
            WordPattern::Time => piece.and_then(|_| self.end_of_time(at)).and_then(|end| keep(end, None)),
            WordPattern::Comma => piece.filter(|piece| piece.comma).and_then(|_| self.end(rest, start + 1, at, kept)),
            WordPattern::Rest => {
                let end = (at..=self.pieces.len()).find(|end| ends(*end))?;
                let loses = self.pieces[at..end].iter().any(|piece| piece.counts);
                (!loses).then(|| self.end(rest, start, end, kept))?
            }
            WordPattern::Kept => (1..=MOST_KEPT).find_map(|count| {
                let has_end = (at..at + count).any(|within| self.pieces.len() <= within || within > at && ends(within));
                if has_end { None } else { keep(at + count, None) }
            }),
            WordPattern::Number => piece
                .filter(|piece| piece.text.starts_with(|c: char| c.is_ascii_digit()))
                .and_then(|_| keep(at + 1, None)),
            WordPattern::Capital => piece
                .filter(|piece| at > 0 && piece.shown.starts_with(char::is_uppercase))
                .filter(|piece| !piece.counts && !(self.is_word)("months", &piece.text))
                .and_then(|_| self.end(rest, start, at + 1, kept)),
            WordPattern::Words(words) => {
                piece.filter(|piece| words.contains(&piece.text)).and_then(|_| self.end(rest, start, at + 1, kept))
            }
        };
        found.or_else(|| optional.then(|| self.end(rest, start, at, kept))?)
    }
}
