//! Text to sentences, and sentences to words: each with its place in the file.

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct TextSpan {
    pub start: usize,
    pub end: usize,
}

impl TextSpan {
    pub fn to(self, other: TextSpan) -> TextSpan {
        TextSpan { start: self.start.min(other.start), end: self.end.max(other.end) }
    }
}

#[derive(Clone, Debug, PartialEq)]
pub struct SentenceWord {
    pub text: String,
    pub token: Token,
    pub span: TextSpan,
}

impl SentenceWord {
    pub fn is_put_in(&self) -> bool {
        self.span.start == self.span.end
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Token {
    Word,
    Number(f64),
    /// Hours and minutes as written, be there such a time or not.
    Clock(u32, u32),
    Date(u32, u32, u32),
    Comma,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Sentence {
    pub indented: bool,
    pub colon: bool,
    pub goes_on: bool,
    pub words: Vec<SentenceWord>,
}

impl Sentence {
    pub fn span(&self) -> TextSpan {
        match (self.words.first(), self.words.last()) {
            (Some(first), Some(last)) => first.span.to(last.span),
            _ => TextSpan::default(),
        }
    }
}

#[derive(Clone, Copy, Debug)]
pub struct TextLine<'t> {
    pub start: usize,
    pub text: &'t str,
}

impl TextLine<'_> {
    pub fn is_indented(&self) -> bool {
        self.text.starts_with([' ', '\t', '\u{a0}'])
    }
}

pub fn lines(text: &str) -> Vec<TextLine<'_>> {
    let bytes = text.as_bytes();
    let mut lines = Vec::new();
    let (mut start, mut at) = (0, 0);
    while at < bytes.len() {
        let ends = bytes[at] == b'\n' || bytes[at] == b'\r';
        if ends {
            lines.push(TextLine { start, text: &text[start..at] });
            at += usize::from(bytes[at] == b'\r' && bytes.get(at + 1) == Some(&b'\n'));
            start = at + 1;
        }
        at += 1;
    }
    lines.push(TextLine { start, text: &text[start..] });
    lines
}

/// The sentences of a line. A full stop between a number and some words, such as months of some languages, ends none.
pub fn sentences(line: TextLine, follows_ordinal: &dyn Fn(&str) -> bool) -> Vec<Sentence> {
    let indented = line.is_indented();
    let text = line.text.split('#').next().unwrap_or_default();
    let mut lexer = Lexer {
        chars: text.char_indices().collect(),
        text,
        at: 0,
        start: line.start,
        words: Vec::new(),
        follows_ordinal,
    };
    let mut sentences = Vec::new();
    let mut after_semicolon = false;
    loop {
        let is_more = lexer.sentence();
        let ended_by = lexer.before(lexer.at);
        let mut words = std::mem::take(&mut lexer.words);
        let is_sign = |word: &SentenceWord| word.token == Token::Comma;
        let colon = words.last().is_some_and(|word| word.text == ":");
        while words.last().is_some_and(is_sign) {
            words.pop();
        }
        if !words.is_empty() {
            sentences.push(Sentence { indented, colon, goes_on: after_semicolon, words });
        }
        if !is_more {
            return sentences;
        }
        after_semicolon = ended_by == Some(';');
    }
}

pub fn of_name(name: &str) -> Vec<SentenceWord> {
    sentences(TextLine { start: 0, text: name }, &|_| false).into_iter().flat_map(|sentence| sentence.words).collect()
}

struct Lexer<'t> {
    text: &'t str,
    chars: Vec<(usize, char)>,
    at: usize,
    start: usize,
    words: Vec<SentenceWord>,
    follows_ordinal: &'t dyn Fn(&str) -> bool,
}

impl Lexer<'_> {
    fn sentence(&mut self) -> bool {
        while let Some(c) = self.peek(0) {
            let from = self.at;
            self.at += 1;
            match c {
                '.' if self.is_title() || self.is_ordinal() => {}
                '.' | '!' | '?' => return true,
                ';' if !self.parts_digits(from) => return true,
                '\u{2022}' | '*' => {}
                ',' | ';' | ':' | '(' | ')' | '\u{2014}' => self.push(from, Token::Comma),
                '-' | '\u{2013}' | '\u{2010}' | '\u{2011}' if self.parts_numbers(from) => {
                    self.push(from, Token::Word);
                    self.rename("to");
                }
                '-' | '\u{2212}' if self.peek(0).is_some_and(|next| next.is_ascii_digit()) && !self.joins(from) => {
                    self.push(from, Token::Word);
                }
                '-' | '\u{2013}' | '\u{2010}' | '\u{2011}' | '"' | '\u{201c}' | '\u{201d}' => {}
                _ if c.is_whitespace() => {}
                '0'..='9' => self.number(from),
                _ if c.is_alphabetic() => {
                    if self.letters(from) {
                        return true;
                    }
                }
                _ => self.push(from, Token::Word),
            }
        }
        false
    }

    fn peek(&self, ahead: usize) -> Option<char> {
        self.chars.get(self.at + ahead).map(|&(_, c)| c)
    }

    fn before(&self, at: usize) -> Option<char> {
        at.checked_sub(1).and_then(|at| self.chars.get(at)).map(|&(_, c)| c)
    }

    fn joins(&self, dash: usize) -> bool {
        self.before(dash).is_some_and(char::is_alphanumeric)
    }

    fn parts_digits(&self, at: usize) -> bool {
        let is_digit = |c: Option<char>| c.is_some_and(|c| c.is_ascii_digit());
        is_digit(self.before(at)) && is_digit(self.peek(0))
    }

    fn parts_numbers(&self, dash: usize) -> bool {
        let mut before = self.chars[..dash].iter().rev().map(|&(_, c)| c).skip_while(|&c| c == ' ');
        let mut after = self.chars[dash + 1..].iter().map(|&(_, c)| c).skip_while(|&c| c == ' ');
        let tight = self.joins(dash) == self.peek(0).is_some_and(char::is_alphanumeric);
        let is_digit = |c: Option<char>| c.is_some_and(|c| c.is_ascii_digit());
        is_digit(before.next()) && is_digit(after.next()) && tight
    }

    fn is_title(&self) -> bool {
        let is_title = |word: &SentenceWord| matches!(word.text.as_str(), "mr" | "mrs" | "ms" | "dr" | "st" | "pt");
        self.words.last().is_some_and(is_title)
    }

    fn is_ordinal(&self) -> bool {
        let is_number = self.before(self.at - 1).is_some_and(|c| c.is_ascii_digit());
        let rest = self.chars[self.at..].iter().map(|&(_, c)| c).skip_while(|c| *c == ' ');
        let next: String = rest.take_while(|c| c.is_alphabetic()).flat_map(char::to_lowercase).collect();
        is_number && (self.follows_ordinal)(&next)
    }

    fn number(&mut self, from: usize) {
        self.digits();
        if let Some(date) = self.date(from) {
            return self.push(from, date);
        }
        let is_digit = |c: Option<char>| c.is_some_and(|c| c.is_ascii_digit());
        match self.peek(0) {
            Some(':') if is_digit(self.peek(1)) => {
                let hours = self.slice(from).parse().unwrap_or(u32::MAX);
                self.at += 1;
                let minutes_from = self.at;
                self.digits();
                let written = self.slice(minutes_from);
                let minutes = if written.len() == 2 { written.parse().unwrap_or(u32::MAX) } else { u32::MAX };
                self.push(from, Token::Clock(hours, minutes));
            }
            Some('.') if is_digit(self.peek(1)) => {
                self.at += 1;
                self.digits();
                self.push_number(from);
            }
            // A decimal comma is not taken for the end of a part of the sentence.
            Some(',') if is_digit(self.peek(1)) => {
                self.at += 1;
                self.digits();
                self.push(from, Token::Word);
            }
            _ => self.push_number(from),
        }
    }

    fn digits(&mut self) {
        while self.peek(0).is_some_and(|c| c.is_ascii_digit()) {
            self.at += 1;
        }
    }

    fn date(&mut self, from: usize) -> Option<Token> {
        let back = self.at;
        let mut parts = [self.slice(from).parse().ok()?, 0, 0];
        if self.at - from != 4 {
            return None;
        }
        for part in &mut parts[1..] {
            let start = self.at + 1;
            let begins = self.peek(0) == Some('-');
            self.at = start;
            self.digits();
            if !begins || self.at == start || self.at > start + 2 {
                self.at = back;
                return None;
            }
            *part = self.slice(start).parse().ok()?;
        }
        Some(Token::Date(parts[0], parts[1], parts[2]))
    }

    fn letters(&mut self, from: usize) -> bool {
        while let Some(c) = self.peek(0) {
            let goes_on = self.peek(1).is_some_and(char::is_alphabetic);
            if !(c.is_alphanumeric() || goes_on && matches!(c, '\'' | '\u{2019}' | '/')) {
                break;
            }
            self.at += 1;
        }
        if self.is_count(from) {
            self.at = from + 1;
            self.number(self.at);
            self.push(from, Token::Word);
            self.rename("times");
            return false;
        }
        if let Some(sign) = self.slice(from).find('/').filter(|&sign| is_day(&self.slice(from)[..sign])) {
            self.at = from + sign;
            self.push(from, Token::Word);
            self.at += 1;
            self.push(self.at - 1, Token::Word);
            self.rename("and");
            return false;
        }
        let is_half_day = matches!(self.slice(from), "a" | "p" | "A" | "P");
        let is_m = self.peek(0) == Some('.') && matches!(self.peek(1), Some('m' | 'M'));
        if is_half_day && is_m && !self.peek(2).is_some_and(char::is_alphanumeric) {
            self.at += 2;
            let stops = self.peek(0) == Some('.');
            self.push(from, Token::Word);
            self.rename(if self.slice(from).starts_with(['a', 'A']) { "am" } else { "pm" });
            self.at += usize::from(stops);
            let mut rest = self.chars[self.at..].iter().map(|&(_, c)| c).skip_while(|c| c.is_whitespace());
            return stops && rest.next().is_none_or(char::is_uppercase);
        }
        self.push(from, Token::Word);
        self.part_contraction();
        false
    }

    /// "She's" is "she is", and "he'll" is "he will"; "she's had" is "she has had".
    fn part_contraction(&mut self) {
        const HAD: [&str; 10] =
            ["had", "been", "got", "stopped", "started", "become", "begun", "lost", "taken", "given"];
        if let [.., who, is, had] = &mut self.words[..]
            && is.text == "is"
            && is.span == who.span
            && HAD.contains(&had.text.as_str())
        {
            is.text = "has".to_owned();
        }
        const WHO: [&str; 12] = ["she", "he", "it", "they", "we", "i", "that", "there", "who", "mum", "dad", "you"];
        let Some(word) = self.words.last_mut() else { return };
        let Some((who, rest)) = word.text.split_once('\'').filter(|(who, _)| WHO.contains(who)) else { return };
        let is = match rest {
            "s" if ["mum", "dad"].contains(&who) => return,
            "s" => "is",
            "ll" => "will",
            "d" => "would",
            "re" => "are",
            "ve" => "have",
            "m" => "am",
            _ => return,
        };
        let second = SentenceWord { text: is.to_owned(), ..word.clone() };
        word.text = who.to_owned();
        self.words.push(second);
    }

    fn is_count(&self, from: usize) -> bool {
        let count = self.slice(from).strip_prefix(['x', 'X']);
        count.is_some_and(|count| matches!(count.len(), 1 | 2) && count.bytes().all(|digit| digit.is_ascii_digit()))
    }

    fn slice(&self, from: usize) -> &str {
        let end = self.chars.get(self.at).map_or(self.text.len(), |&(at, _)| at);
        &self.text[self.chars[from].0..end]
    }

    fn push_number(&mut self, from: usize) {
        let value = self.slice(from).parse().unwrap_or(f64::INFINITY);
        self.push(from, Token::Number(value));
    }

    fn push(&mut self, from: usize, token: Token) {
        let text = self.slice(from);
        let start = self.start + self.chars[from].0;
        let span = TextSpan { start, end: start + text.len() };
        let text = text.replace('\u{2019}', "'").to_lowercase();
        self.words.push(SentenceWord { text, token, span });
    }

    fn rename(&mut self, text: &str) {
        if let Some(word) = self.words.last_mut() {
            word.text = text.into();
        }
    }
}

fn is_day(word: &str) -> bool {
    let word = word.to_lowercase();
    ["mon", "tue", "wed", "thu", "fri", "sat", "sun"].iter().any(|day| word.starts_with(day))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(line: &str) -> Vec<Vec<String>> {
        let words = |sentence: Sentence| sentence.words.into_iter().map(|word| word.text).collect();
        sentences(TextLine { start: 0, text: line }, &|_| false).into_iter().map(words).collect()
    }

    #[test]
    fn full_stops_end_sentences_but_not_numbers_or_half_days() {
        assert_eq!(
            texts("She is 82. She walks at 0.65 m/s."),
            [vec!["she", "is", "82"], vec!["she", "walks", "at", "0.65", "m/s"]]
        );
        assert_eq!(texts("at 8 p.m. on Friday"), [vec!["at", "8", "pm", "on", "friday"]]);
        assert_eq!(texts("at 8 p.m. She reads"), [vec!["at", "8", "pm"], vec!["she", "reads"]]);
    }

    #[test]
    fn contractions_are_parted() {
        assert_eq!(texts("She's had a nap"), [["she", "has", "had", "a", "nap"]]);
        assert_eq!(texts("She's out, and he'll go"), [["she", "is", "out", ",", "and", "he", "will", "go"]]);
    }

    #[test]
    fn dashes_part_numbers_and_join_words() {
        assert_eq!(
            texts("2-3 hours, 14:00\u{2013}16:00 washing-up 2009-05-01"),
            [["2", "to", "3", "hours", ",", "14:00", "to", "16:00", "washing", "up", "2009-05-01"]]
        );
        assert_eq!(texts("-5 minutes"), [["-", "5", "minutes"]]);
    }

    #[test]
    fn numbers_clocks_and_dates_are_told_apart() {
        let tokens = |line| -> Vec<Token> {
            of_name(line).into_iter().map(|word| word.token).filter(|token| *token != Token::Word).collect()
        };
        assert_eq!(
            tokens("30% 8pm 7:75 6:5 2009-05-01"),
            [
                Token::Number(30.0),
                Token::Number(8.0),
                Token::Clock(7, 75),
                Token::Clock(6, u32::MAX),
                Token::Date(2009, 5, 1)
            ]
        );
    }

    #[test]
    fn lines_end_in_any_way() {
        let texts: Vec<&str> = lines("a\nb\r\nc\rd\n").iter().map(|line| line.text).collect();
        assert_eq!(texts, ["a", "b", "c", "d", ""]);
    }
}
