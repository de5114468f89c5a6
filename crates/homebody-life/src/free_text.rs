//! The free text, sentence by sentence.

use crate::messages::FreeTextError;

/// Longest text (our choice): with the card and a home, it fits into the 16,000 tokens that a small model reads.
pub const MOST_CHARACTERS: usize = 20_000;

/// Share of the words of a sentence that answers must quote (our choice): models correct spelling and punctuation.
const QUOTED: f64 = 0.6;

/// Shortest quotation of a part of a sentence, in words (our choice).
const LEAST_WORDS: usize = 2;

/// Words before a full stop that ends no sentence, in lower case.
const ABBREVIATIONS: &[&str] =
    &["mr", "mrs", "ms", "dr", "st", "no", "e.g", "i.e", "approx", "ca", "a.m", "p.m", "vs", "etc", "nr", "z.b", "ggf"];

/// A text about a person's days.
#[derive(Clone, Debug)]
pub struct FreeText {
    /// As it was given.
    pub text: String,
    /// Its sentences in order, each on one line.
    pub sentences: Vec<String>,
}

impl FreeText {
    /// Splits a text into sentences.
    ///
    /// # Errors
    ///
    /// [`FreeTextError::TooLong`] and [`FreeTextError::Empty`].
    pub fn read(text: &str) -> Result<FreeText, FreeTextError> {
        let characters = text.chars().count();
        if characters > MOST_CHARACTERS {
            return Err(FreeTextError::TooLong { characters, most: MOST_CHARACTERS });
        }
        let sentences: Vec<String> = paragraphs(text).iter().flat_map(|paragraph| sentences_of(paragraph)).collect();
        if sentences.is_empty() {
            return Err(FreeTextError::Empty);
        }
        Ok(FreeText { text: text.to_owned(), sentences })
    }

    /// Whether a line's source is a sentence of the text, or a part of one.
    pub fn has(&self, source: &str) -> bool {
        let source = words_of(source);
        self.sentences.iter().any(|sentence| share_quoted(&words_of(sentence), &source) > 0.0)
    }

    /// The sentences that no source quotes.
    pub fn left_out<'a>(&self, sources: impl Iterator<Item = &'a str>) -> Vec<String> {
        let sources: Vec<Vec<String>> = sources.map(words_of).collect();
        let is_left_out = |sentence: &&String| {
            let words = words_of(sentence);
            sources.iter().map(|source| share_quoted(&words, source)).sum::<f64>() < QUOTED
        };
        self.sentences.iter().filter(is_left_out).cloned().collect()
    }
}

/// The share of a sentence that a source quotes: all of it, a part without a gap, or most of its words.
fn share_quoted(sentence: &[String], source: &[String]) -> f64 {
    if sentence.is_empty() || source.is_empty() {
        return 0.0;
    }
    let has = |whole: &[String], part: &[String]| whole.windows(part.len()).any(|window| window == part);
    if has(source, sentence) {
        return 1.0;
    }
    let share = |count: usize| count as f64 / sentence.len() as f64;
    if source.len() >= LEAST_WORDS && has(sentence, source) {
        return share(source.len());
    }
    let common = share(sentence.iter().filter(|word| source.contains(word)).count());
    let is_near = common >= QUOTED && source.iter().filter(|word| !sentence.contains(word)).count() * 2 <= source.len();
    if is_near { common } else { 0.0 }
}

/// The words in lower case, without punctuation.
fn words_of(text: &str) -> Vec<String> {
    let words = text.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty());
    words.map(str::to_lowercase).collect()
}

/// Marks of an item of a list.
const BULLETS: [char; 5] = ['-', '*', '•', '#', '>'];

/// Shortest line that an editor may have broken, in characters (our choice).
const BROKEN_LINE: usize = 60;

/// The lines of a text, joined where a sentence continues on the next line.
fn paragraphs(text: &str) -> Vec<String> {
    let mut all: Vec<String> = Vec::new();
    // The line before, if it ends within a sentence.
    let mut open = "";
    for line in text.lines().map(str::trim) {
        let is_broken = open.chars().count() >= BROKEN_LINE && !line.is_empty() && !line.starts_with(BULLETS);
        let continues = !open.is_empty() && (is_broken || line.starts_with(char::is_lowercase));
        match all.last_mut() {
            Some(before) if continues => *before += &format!(" {line}"),
            _ => all.push(line.to_owned()),
        }
        open = if line.split_whitespace().next_back().is_some_and(ends_sentence) { "" } else { line };
    }
    all
}

fn sentences_of(line: &str) -> Vec<String> {
    let (mut sentences, mut sentence) = (Vec::new(), String::new());
    for word in line.trim_start_matches(|c| BULLETS.contains(&c) || c == ' ').split_whitespace() {
        if !sentence.is_empty() {
            sentence.push(' ');
        }
        sentence.push_str(word);
        if ends_sentence(word) {
            sentences.push(std::mem::take(&mut sentence));
        }
    }
    sentences.push(sentence);
    sentences.retain(|sentence| sentence.chars().any(char::is_alphabetic));
    sentences
}

fn ends_sentence(word: &str) -> bool {
    let bare = word.trim_end_matches(['"', '\'', '”', '’', ')', '»', '“']);
    if bare.ends_with(['!', '?', '…', '。']) {
        return true;
    }
    let Some(before) = bare.strip_suffix('.') else { return false };
    let before = before.trim_start_matches(['"', '\'', '(', '“', '„', '«']);
    // A number before a full stop is an item of a list or a date.
    let is_number = before.chars().all(|c| c.is_ascii_digit());
    !is_number && before.chars().count() > 1 && !ABBREVIATIONS.contains(&before.to_lowercase().as_str())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sentences(text: &str) -> Vec<String> {
        FreeText::read(text).unwrap().sentences
    }

    #[test]
    fn splits_sentences_and_keeps_abbreviations() {
        let text = "Mrs. Hill gets up at 7 a.m. and reads.  She naps!\n\n- Walks at 15.30.\n---\n2. Dr. Ash visits";
        assert_eq!(
            sentences(text),
            ["Mrs. Hill gets up at 7 a.m. and reads.", "She naps!", "Walks at 15.30.", "2. Dr. Ash visits"]
        );
        assert_eq!(
            sentences("Sie steht um 7 Uhr auf. „Dann frühstückt sie.“ 好"),
            ["Sie steht um 7 Uhr auf.", "„Dann frühstückt sie.“", "好"]
        );
    }

    #[test]
    fn joins_lines_that_an_editor_has_broken() {
        let broken =
            "Margaret has lived alone since her husband died, and on Sundays\nHenry comes. She dozes\nafter lunch.";
        let whole = "Margaret has lived alone since her husband died, and on Sundays Henry comes.";
        assert_eq!(sentences(broken), [whole, "She dozes after lunch."]);
        assert_eq!(
            sentences("- Up at seven\n- Porridge\nTablets at eight\n\nbed at ten"),
            ["Up at seven", "Porridge", "Tablets at eight", "bed at ten"]
        );
    }

    #[test]
    fn finds_sentences_that_no_source_quotes() {
        let text =
            FreeText::read("She gets up at seven. She naps after lunch, and then she knits. Her son calls.").unwrap();
        let left_out = |sources: &[&str]| text.left_out(sources.iter().copied());
        assert_eq!(
            left_out(&["she gets up at seven", "She naps after lunch, and then she knits.", "Her son calls"]),
            [""; 0]
        );
        assert_eq!(left_out(&["She gets up at seven. Her son calls."]), ["She naps after lunch, and then she knits."]);
        assert_eq!(left_out(&["She naps after lunch", "then she knits", "Her son calls."]), ["She gets up at seven."]);
        assert_eq!(
            left_out(&["She gets up at 7.", "Her son calls.", "and"]),
            ["She naps after lunch, and then she knits."]
        );
        assert!(text.has("Her son calls.") && !text.has("She drinks wine all day"));
    }

    #[test]
    fn refuses_texts_that_are_too_long_or_empty() {
        assert!(matches!(FreeText::read(&"She naps. ".repeat(20_000)), Err(FreeTextError::TooLong { .. })));
        assert!(matches!(FreeText::read(" \n--- 12.\n"), Err(FreeTextError::Empty)));
    }
}
