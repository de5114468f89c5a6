//! The words for the person, such as "the resident".

use super::reader::SentenceReader;
use super::visits::visits;
use super::words::Token;

/// "Mum", "the resident", "Mr. Hill", "I": what the person is called by those who write about them.
pub fn person_called(reader: &mut SentenceReader) -> bool {
    const WHO: [&str; 8] = ["she", "he", "her", "him", "his", "mum", "dad", "they"];
    let called = |reader: &mut SentenceReader| {
        if reader.peek(0) == "i" {
            let others = reader.words.iter().any(|word| WHO.contains(&word.text.as_str()));
            reader.at += 1;
            return (!others && !reader.ahead(visits)).then_some(());
        }
        reader.eat("mr and");
        let has_title =
            ["mr", "mrs", "ms", "miss", "auntie", "aunty"].contains(&reader.peek(0)) && reader.names.person.is_some();
        if has_title && reader.token(1) == Some(Token::Word) {
            reader.at += 2;
            return (!reader.passed(reader.at - 1).ends_with("'s") && !reader.ahead(visits)).then_some(());
        }
        reader.eat("my|our|the|this");
        let lexicon = reader.names.lexicon.clone();
        reader.at += lexicon.list("PERSON", |ahead| reader.peek(ahead))?;
        (!reader.ahead(visits)).then_some(())
    };
    reader.attempt(called).is_some()
}
