//! The answer of a model: JSON with a line for each sentence of the text, read with all the liberties that models take.

use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

/// Most lines and most statements of an answer (our choice): a text of the longest kind has fewer.
pub const MOST_LINES: usize = 500;

/// Longest entry of a list, in characters (our choice). A longer one is cut, and a longer statement is refused for that.
pub const LONGEST_ENTRY: usize = 400;

/// Most places of an answer where its JSON may begin (our choice): a model may think aloud before.
const MOST_BEGINNINGS: usize = 200;

/// A line of an answer: a source in the text, and what the model makes of it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct AnswerLine {
    /// A sentence of the text.
    pub source: String,
    /// Sentences of the routine language.
    pub statements: Vec<String>,
    /// Choices of the model where the text leaves something open.
    pub assumed: Vec<String>,
    /// The parts of the text that the language cannot say.
    pub cannot_be_said: Vec<String>,
}

/// The JSON Schema of an answer.
pub fn schema() -> Value {
    let texts = json!({ "type": "array", "items": { "type": "string" } });
    json!({
        "type": "object",
        "additionalProperties": false,
        "required": ["lines"],
        "properties": { "lines": { "type": "array", "items": {
            "type": "object",
            "additionalProperties": false,
            "required": ["source", "statements", "assumed", "cannot_be_said"],
            "properties": {
                "source": { "type": "string" },
                "statements": texts,
                "assumed": texts,
                "cannot_be_said": texts,
            },
        } } },
    })
}

/// The lines of an answer, which may stand between other words. A line that is repeated counts once.
///
/// # Errors
///
/// The reason why there are none.
pub fn lines_of(answer: &str) -> Result<Vec<AnswerLine>, String> {
    let mut has_lines = false;
    for (at, _) in answer.match_indices(['{', '[']).take(MOST_BEGINNINGS) {
        let Some(Ok(value)) = serde_json::Deserializer::from_str(&answer[at..]).into_iter::<Value>().next() else {
            continue;
        };
        has_lines |= value.get("lines").is_some();
        let list = value.get("lines").unwrap_or(&value).as_array();
        let lines: Vec<AnswerLine> = list.into_iter().flatten().take(MOST_LINES).filter_map(line_of).collect();
        if !lines.is_empty() {
            return Ok(without_repetitions(lines));
        }
    }
    let why = match answer {
        _ if answer.trim().is_empty() => "it is empty",
        _ if has_lines => "its JSON has no lines with a source",
        // The parts of a JSON that was cut are JSON, too.
        _ if answer.contains("\"lines\"") => "its JSON is incomplete",
        _ => "it has no JSON with lines",
    };
    Err(why.to_owned())
}

fn line_of(value: &Value) -> Option<AnswerLine> {
    let source = short(value.get("source")?.as_str()?);
    let texts = |name: &str| match value.get(name) {
        Some(Value::Array(texts)) => texts.iter().filter_map(Value::as_str).map(short).collect(),
        Some(Value::String(text)) => vec![short(text)],
        _ => Vec::new(),
    };
    let kept = |texts: Vec<String>| texts.into_iter().filter(|text| !text.is_empty()).collect();
    Some(AnswerLine {
        source,
        statements: kept(texts("statements")),
        assumed: kept(texts("assumed")),
        cannot_be_said: kept(texts("cannot_be_said")),
    })
}

/// One line of the text without its end, if it is very long.
fn short(text: &str) -> String {
    let line = text.split_whitespace().collect::<Vec<_>>().join(" ");
    match line.char_indices().nth(LONGEST_ENTRY) {
        Some((end, _)) => line[..end].to_owned() + "…",
        None => line,
    }
}

fn without_repetitions(lines: Vec<AnswerLine>) -> Vec<AnswerLine> {
    let mut all: Vec<AnswerLine> = Vec::new();
    for line in lines {
        if !all.contains(&line) {
            all.push(line);
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    const ANSWER: &str = r#"{"lines":[{"source":"She naps.","statements":["She naps at 14:00 for 30 minutes."],
        "assumed":["the time"],"cannot_be_said":[]}]}"#;

    #[test]
    fn finds_json_among_other_words() {
        let line = AnswerLine {
            source: "She naps.".into(),
            statements: vec!["She naps at 14:00 for 30 minutes.".into()],
            assumed: vec!["the time".into()],
            cannot_be_said: Vec::new(),
        };
        for answer in [
            ANSWER.to_owned(),
            format!("<think>{{ \"a\": 1 }} or [1, 2]</think>\nHere you are:\n```json\n{ANSWER}\n```\nAnything else?"),
            ANSWER.trim_start_matches("{\"lines\":").trim_end_matches('}').to_owned() + "}",
            ANSWER.replace("[\"the time\"]", "\"the time\"").replace("[]", "null"),
        ] {
            assert_eq!(lines_of(&answer).as_deref(), Ok(&[line.clone()][..]), "{answer}");
        }
    }

    #[test]
    fn says_why_there_are_no_lines() {
        let why = |answer: &str| lines_of(answer).unwrap_err();
        assert_eq!(why(" \n"), "it is empty");
        assert_eq!(why("I am sorry, I cannot help with that."), "it has no JSON with lines");
        assert_eq!(why("{\"lines\":[]}"), "its JSON has no lines with a source");
        assert_eq!(why(&ANSWER[..ANSWER.len() - 3]), "its JSON is incomplete");
        assert_eq!(why(&"{[".repeat(100_000)), "it has no JSON with lines");
    }

    #[test]
    fn repeated_and_endless_lines_are_cut() {
        let line = |text: &str| format!("{{\"source\":\"{text}\",\"statements\":[\"{}\"]}}", "x ".repeat(5_000));
        let same = vec![line("a"); 900].join(",");
        let lines = lines_of(&format!("{{\"lines\":[{same}]}}")).unwrap();
        assert_eq!(lines.len(), 1);
        assert_eq!(lines[0].statements[0].chars().count(), LONGEST_ENTRY + 1);
        let all: Vec<String> = (0..900).map(|number| line(&number.to_string())).collect();
        assert_eq!(lines_of(&format!("[{}]", all.join(","))).unwrap().len(), MOST_LINES);
    }
}
