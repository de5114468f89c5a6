//! The words of a sentence, with its commas apart.

use super::words::{SentenceWord, TextSpan, Token};

/// A sentence without its commas.
pub struct Tokens {
    pub words: Vec<SentenceWord>,
    /// Whether a comma stands before each word.
    pub commas: Vec<bool>,
}

impl Tokens {
    pub fn new(words: &[SentenceWord]) -> Tokens {
        let mut tokens = Tokens { words: Vec::new(), commas: Vec::new() };
        let mut comma = false;
        for (at, word) in words.iter().enumerate() {
            let before = tokens.words.last();
            let is_glued = |to: Option<&SentenceWord>| to.is_some_and(|to| to.span.start == word.span.end);
            let digit = |text: &str| text.contains(|c: char| c.is_ascii_digit());
            let follows = before.is_some_and(|before| before.span.end == word.span.start && digit(&before.text));
            let is_sign = word.token == Token::Comma;
            // A slip within a time is one word: "7;40", "7:4o".
            let joins_digits = is_sign
                && follows
                && is_glued(words.get(at + 1))
                && words.get(at + 1).is_some_and(|next| digit(&next.text));
            let is_slip = !is_sign
                && follows
                && before.is_some_and(|before| before.token == Token::Comma || is_odd(before, word));
            if joins_digits || is_slip {
                if let Some(last) = tokens.words.last_mut() {
                    last.text += &word.text;
                    last.span.end = word.span.end;
                    last.token = Token::Comma;
                }
                continue;
            }
            if is_sign && !["(", ")"].contains(&word.text.as_str()) {
                comma = true;
                continue;
            }
            tokens.words.push(word.clone());
            tokens.commas.push(std::mem::take(&mut comma) && tokens.words.len() > 1);
        }
        tokens
    }
}

/// Whether a word stands right behind a number or a time, and is no unit.
fn is_odd(before: &SentenceWord, word: &SentenceWord) -> bool {
    match before.token {
        Token::Clock(_, minutes) => minutes == u32::MAX || word.token != Token::Word,
        Token::Number(_) => {
            word.text.len() == 1 && "ol".contains(&word.text)
                || word.text.starts_with('h')
                    && word.text.len() > 1
                    && word.text[1..].bytes().all(|byte| byte.is_ascii_digit())
        }
        _ => false,
    }
}

pub fn span_of(words: &[SentenceWord]) -> TextSpan {
    match (words.first(), words.last()) {
        (Some(first), Some(last)) => first.span.to(last.span),
        _ => TextSpan::default(),
    }
}
