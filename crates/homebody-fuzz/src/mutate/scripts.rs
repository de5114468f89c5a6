//! Scripts: parts of the language put where they may not belong.

use super::numbers;
use crate::dice::Dice;

/// What is put anywhere.
const PARTS: [&str; 46] = [
    "loop { }",
    "while true { wait(1); }",
    "for i in 0..1000000 { }",
    "this",
    "this.n",
    "around",
    "around.",
    "return",
    "return [];",
    "return ();",
    "fn next(around) { next(around) }",
    "fn begin() { 5 }",
    "fn notice(around) { go(\"bed\") }",
    "go(\"bed\")",
    "go(around.room)",
    "step(0, 0.5)",
    "wander(1e300)",
    "wait(0.1)",
    "wait(-1)",
    "rest(0)",
    "leave_home()",
    "come_home()",
    "instead([go(\"sofa\"), instead([])])",
    "turn_on(\"hall\")",
    "use(\"bed\", 1)",
    "activity(\"\\u{1F600}\")",
    "random(\"a\" + this.n)",
    "pick(\"p\", [])",
    "around.free(1e308)",
    "around.others[0].name",
    "#{ a: #{ } }",
    "[[[[[[[[[[]]]]]]]]]]",
    "\"x\".pad(1000000, \"y\")",
    "1 / 0",
    "9223372036854775807 + 1",
    "0.0 / 0.0",
    "|x| x",
    "`${this}`",
    "throw this",
    "try { loop { } } catch { }",
    "const A = 1;",
    "let a = this; this.a = a;",
    "eval(\"1\")",
    "import \"x\" as x;",
    "switch this { _ => wait(1) }",
    "((((((((((((((((((((",
];

/// Changes a script: half of them in one or two places in which it stays one, the others anyhow, in one to eight places.
pub fn script(text: &mut String, others: &[&str], dice: &mut Dice) {
    if dice.below(2) == 0 {
        for _ in 0..dice.size(2) {
            match dice.below(3) {
                0 => number(text, dice),
                1 => call_for_call(text, dice),
                _ => statement(text, dice),
            }
        }
        return;
    }
    for _ in 0..dice.size(8) {
        match dice.below(5) {
            0 => {
                let part = *dice.one(&PARTS);
                let places: Vec<usize> = text.char_indices().map(|(at, _)| at).chain([text.len()]).collect();
                text.insert_str(*dice.one(&places), part);
            }
            1 => number(text, dice),
            2 => lines(text, dice),
            3 => call_for_call(text, dice),
            _ => part_of_another(text, others, dice),
        }
    }
}

/// A statement more stands where one may stand.
fn statement(text: &mut String, dice: &mut Dice) {
    let statements: Vec<&str> = PARTS.into_iter().filter(|part| part.ends_with([';', '}'])).collect();
    let ends = |line: &str| line.trim_end().ends_with([';', '{']);
    let mut lines: Vec<&str> = text.lines().collect();
    let places: Vec<usize> = (1..=lines.len()).filter(|&at| ends(lines[at - 1])).collect();
    if !places.is_empty() {
        lines.insert(*dice.one(&places), *dice.one(&statements));
        *text = lines.join("\n");
    }
}

/// A number is another one.
fn number(text: &mut String, dice: &mut Dice) {
    let is_digit = |at: usize| text.as_bytes()[at].is_ascii_digit();
    let begins: Vec<usize> = (0..text.len()).filter(|&at| is_digit(at) && (at == 0 || !is_digit(at - 1))).collect();
    if begins.is_empty() {
        return;
    }
    let begin = *dice.one(&begins);
    let end = text[begin..].find(|c: char| !c.is_ascii_digit()).map_or(text.len(), |length| begin + length);
    let other = numbers::other(text[begin..end].parse().unwrap_or(0.0), dice);
    text.replace_range(begin..end, &other);
}

/// Some lines of another script stand somewhere in this one.
fn part_of_another(text: &mut String, others: &[&str], dice: &mut Dice) {
    if others.is_empty() {
        return;
    }
    let taken: Vec<&str> = dice.one(others).lines().collect();
    let part = dice.part(taken.len());
    let mut lines: Vec<&str> = text.lines().collect();
    let at = dice.below(lines.len() + 1);
    lines.splice(at..at, taken[part].iter().copied());
    *text = lines.join("\n");
}

/// A line goes, comes twice, or stands elsewhere.
fn lines(text: &mut String, dice: &mut Dice) {
    let mut lines: Vec<String> = text.lines().map(String::from).collect();
    if lines.is_empty() {
        return;
    }
    let line = lines.remove(dice.below(lines.len()));
    for _ in 0..dice.below(3) {
        lines.insert(dice.below(lines.len() + 1), line.clone());
    }
    *text = lines.join("\n");
}

/// What is called is another thing: a word for a word.
fn call_for_call(text: &mut String, dice: &mut Dice) {
    const WORDS: [&str; 16] = [
        "go", "sit", "lie", "stand", "step", "wander", "wait", "rest", "use", "turn_on", "random", "chance", "pick",
        "free", "is_on", "who",
    ];
    let calls: Vec<usize> = text.match_indices('(').map(|(at, _)| at).collect();
    if calls.is_empty() {
        return;
    }
    let end = *dice.one(&calls);
    let is_of_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let begin = text[..end]
        .rfind(|c: char| !is_of_word(c))
        .map_or(0, |at| at + text[at..].chars().next().map_or(1, char::len_utf8));
    text.replace_range(begin..end, dice.one::<&str>(&WORDS));
}
