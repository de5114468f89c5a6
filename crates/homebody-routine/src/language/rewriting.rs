//! The probable meaning of words that the language does not read: the section MEANT of a lexicon.
//!
//! The left side has the words as written: `a|b` is either, `[a]` may be missing, `^` is the beginning of the sentence,
//! "," a comma, `CAP` a word with a capital, `NUM` a number in digits and `_` one to six words that are kept, `...` the rest of the clause, which is left
//! out. The right side has the words of the language.

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
}

#[derive(Clone, Debug)]
enum WordPattern {
    Start,
    Comma,
    Capital,
    Kept,
    Number,
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

/// Largest number of words that "_" stands for (our choice).
const MOST_KEPT: usize = 6;

impl Rewriting {
    pub fn new(said: &str, meant: &str) -> Rewriting {
        let is_number = |word: &&str| word.contains(|c: char| c.is_ascii_digit());
        let pattern = |word: &str| {
            let optional = word.starts_with('[');
            let pattern = match word.trim_matches(['[', ']']) {
                "^" => WordPattern::Start,
                "," => WordPattern::Comma,
                "CAP" => WordPattern::Capital,
                "_" => WordPattern::Kept,
                "NUM" => WordPattern::Number,
                "..." => WordPattern::Rest,
                words => WordPattern::Words(words.split('|').map(str::to_owned).collect()),
            };
            (pattern, optional)
        };
        Rewriting {
            left: said.split_whitespace().map(pattern).collect(),
            right: meant.split_whitespace().map(str::to_owned).collect(),
            assumes: meant.split_whitespace().filter(is_number).any(|number| !said.contains(number)),
        }
    }

    /// Rewrites the first place that fits.
    pub fn apply(&self, pieces: &[RewritingWord], joins: &dyn Fn(&str) -> bool) -> Option<Vec<RewritingWord>> {
        let fitting = Fitting { pieces, joins };
        (0..pieces.len()).find_map(|at| {
            let mut kept = Vec::new();
            let end = fitting.end(&self.left, at, at, &mut kept)?;
            let mut words = kept.iter();
            let mut made: Vec<RewritingWord> = Vec::new();
            for word in &self.right {
                match word.as_str() {
                    "_" => made.extend(words.next().into_iter().flat_map(|kept| pieces[kept.clone()].iter().cloned())),
                    _ => made.push(RewritingWord {
                        text: word.clone(),
                        shown: word.clone(),
                        comma: false,
                        counts: false,
                    }),
                }
            }
            let comma = pieces[at].comma && !matches!(self.left[0].0, WordPattern::Comma);
            if let Some(first) = made.first_mut() {
                first.comma = comma;
            }
            Some([&pieces[..at], &made, &pieces[end..]].concat())
        })
    }
}

struct Fitting<'p> {
    pieces: &'p [RewritingWord],
    joins: &'p dyn Fn(&str) -> bool,
}

impl Fitting<'_> {
    /// The end of the pattern that begins at a word.
    fn end(
        &self,
        left: &[(WordPattern, bool)],
        start: usize,
        at: usize,
        kept: &mut Vec<std::ops::Range<usize>>,
    ) -> Option<usize> {
        let Some(((pattern, optional), rest)) = left.split_first() else { return Some(at) };
        let piece = self.pieces.get(at);
        let ends =
            |at: usize| self.pieces.get(at).is_none_or(|piece| at > start && piece.comma || (self.joins)(&piece.text));
        let found = match pattern {
            WordPattern::Start => (at == 0).then(|| self.end(rest, start, at, kept))?,
            WordPattern::Comma => piece.filter(|piece| piece.comma).and_then(|_| self.end(rest, start + 1, at, kept)),
            WordPattern::Rest => {
                let end = (at..=self.pieces.len()).find(|end| ends(*end))?;
                let loses = self.pieces[at..end].iter().any(|piece| piece.counts);
                (!loses).then(|| self.end(rest, start, end, kept))?
            }
            WordPattern::Kept => (1..=MOST_KEPT).find_map(|count| {
                let has_end = (at..at + count).any(|within| self.pieces.len() <= within || within > at && ends(within));
                if has_end {
                    return None;
                }
                kept.push(at..at + count);
                self.end(rest, start, at + count, kept).or_else(|| {
                    kept.pop();
                    None
                })
            }),
            WordPattern::Number => {
                piece.filter(|piece| piece.text.starts_with(|c: char| c.is_ascii_digit())).and_then(|_| {
                    kept.push(at..at + 1);
                    self.end(rest, start, at + 1, kept)
                })
            }
            WordPattern::Capital => piece
                .filter(|piece| at > 0 && piece.shown.starts_with(char::is_uppercase))
                .and_then(|_| self.end(rest, start, at + 1, kept)),
            WordPattern::Words(words) => {
                piece.filter(|piece| words.contains(&piece.text)).and_then(|_| self.end(rest, start, at + 1, kept))
            }
        };
        found.or_else(|| optional.then(|| self.end(rest, start, at, kept))?)
    }
}
