//! `docs/reference/parameters.md` has every number of ours: those that a scenario may set, and the fixed ones.
//!
//! `HOMEBODY_REWRITE=1 cargo test -p homebody --test rules numbers` writes it anew.

use super::generated::is_generated;
use super::source::is_for_tests;
use super::{File, expect_none, files, has_word};
use homebody_core::numbers::Number;
use homebody_simulation::numbers;

const HEAD: &str = "\
# Parameters of the models

This page lists the parameters of Homebody's models, with their values, units and ranges, and the fixed constants of the program.

A value without a source in its description is our choice, and the results of a run may depend on it. To measure how much, do a
sensitivity analysis: simulate the same scenario with several values of the parameter, and compare the logs.

```sh
homebody run scenarios/tigerplace --for 28d --out sqlite:usual.db
for gap in 150 300 600; do
  homebody run scenarios/tigerplace --for 28d --set stay.still.gap=$gap --out sqlite:gap-$gap.db
  homebody compare usual.db gap-$gap.db
done
```

All runs have the same seed, so that the differences come from the parameter. To tell them from the effect of chance, compare runs with
several seeds as well. To set a parameter in every run of a scenario, write it in `scenario.json`:
`\"numbers\": { \"gait.slowest\": 0.25 }`. A recording contains the values that were set.

`homebody parameters` prints the first part of this page. The page is made from the code by the test in
`crates/homebody/tests/rules/numbers.rs`.
";

const FIXED: &str = "\
## Fixed constants

Tolerances, meanings of words, and sizes in pictures that are our choice. They cannot be set for a run, and most do not affect a
simulation. [Limits](limits.md) have their own page. The unit follows from the end of the name; `1` is a count, a share or a factor.
";

/// Ends of names, and the units that they stand for.
const UNITS: [(&str, &str); 16] = [
    ("_PER_S", "1/s"),
    ("_MPS2", "m/s2"),
    ("_MPS", "m/s"),
    ("_M2", "m2"),
    ("_CM", "cm"),
    ("_M", "m"),
    ("_US", "µs"),
    ("_MS", "ms"),
    ("_S", "s"),
    ("_MIN", "min"),
    ("_H", "h"),
    ("_DAYS", "days"),
    ("_DEG", "°"),
    ("_C", "°C"),
    ("_LUX", "lx"),
    ("_BYTES", "bytes"),
];

const LIMITS: [&str; 4] = ["MOST", "LARGEST", "LONGEST", "GREATEST"];

/// Folder of the files whose fields are keys of a scenario's files, with defaults of ours: they are set there.
const FORMS: &str = "crates/homebody-core/src/";

/// A constant that is a limit, or whose comment says that it is ours.
#[derive(Debug, PartialEq)]
pub(super) struct Fixed {
    pub path: String,
    pub name: String,
    pub value: String,
    pub unit: &'static str,
    pub what: String,
}

#[test]
fn the_table_of_numbers_is_that_of_the_code() {
    is_generated("docs/reference/parameters.md", &document(&numbers(), &files()));
}

#[test]
fn every_number_of_ours_is_in_a_list() {
    let files = files();
    expect_none(code(&files).flat_map(|file| judged(file).1).collect());
    let known = numbers();
    expect_none(code(&files).flat_map(|file| unlisted(file, &known)).collect());
}

#[test]
fn a_number_that_is_in_no_list_is_found() {
    let file = |text: &str| File::new("crates/a/src/a.rs", text);
    let wrong = |text: &str| judged(&file(text)).1.len();
    assert_eq!(wrong("/// So many (ours).\nconst MOST: u32 = 3;\n"), 0);
    assert_eq!(wrong("/// So many (ours).\nfn most() -> u32 {\n"), 1);
    assert_eq!(wrong("/// So many (our choice).\nfn most() -> u32 {\n"), 1);
    assert_eq!(wrong("// So many\n// at once (ours, after all).\nlet most = 3;\n"), 1);
    assert_eq!(wrong("let most = 3; // (ours)\n"), 1);
    assert_eq!(wrong("/// So many.\nconst MOST: u32 = 3;\n"), 0);
    assert_eq!(wrong("const MOST: u32 = 3;\n"), 1);
    assert_eq!(wrong("const FEW: u32 = 3;\n"), 0);
    assert_eq!(wrong("fn a() {\n    const MOST: u32 = 3;\n}\n"), 0);
    assert_eq!(wrong("//! A wait of 2 s (ours).\n\nuse a::b;\n"), 0);
    assert_eq!(wrong("#[cfg(test)]\nmod tests {\n    let most = 3; // (ours)\n}\n"), 0);
    let key = File::new("crates/homebody-core/src/link/form.rs", "/// 0.1 (ours).\n#[serde]\npub share: f64,\n");
    assert_eq!(judged(&key).1.len(), 0);
    assert_eq!(judged(&file(&key.text)).1.len(), 1);

    let declared = file("numbers! {\n    /// A.\n    static A = \"a.a\": 1.0, \"1\", [0.0, 1.0];\n}\n");
    let a = Number::new("a.a", 1.0, "1", [0.0, 1.0], " A.", "crates/a/src/a.rs");
    assert_eq!(unlisted(&declared, &[]).len(), 1);
    assert_eq!(unlisted(&declared, std::slice::from_ref(&a)), [""; 0]);
    assert_eq!(unlisted(&declared, &[Number { file: "crates/b/src/b.rs", ..a }]).len(), 1);
}

#[test]
fn constants_are_read_with_value_unit_and_meaning() {
    let text = "/// Nobody is\n/// faster (ours).\npub(crate) const FASTEST_MPS: f64 =\n    3.0;\nconst WAIT: Span = SECOND.times(5);\n\n\
        const ALONE: f64 = 1.0;\n/// Words of ours.\nconst WORDS: [&str; 1] = [\"a\"];\n";
    let fixed = |name: &str, value: &str, unit| Fixed {
        path: "crates/a/src/a.rs".into(),
        name: name.into(),
        value: value.into(),
        unit,
        what: "Nobody is faster.".into(),
    };
    let read = judged(&File::new("crates/a/src/a.rs", text)).0;
    assert_eq!(read, [fixed("FASTEST_MPS", "3.0", "m/s"), fixed("WAIT", "SECOND.times(5)", "µs")]);
}

#[test]
fn names_and_ranges_of_numbers_are_sound() {
    let all = numbers();
    let wrong = |number: &Number| {
        let is_name = |part: &str| !part.is_empty() && part.chars().all(|c| c.is_ascii_lowercase() || c == '_');
        let is_sound = number.name.split('.').count() >= 2 && number.name.split('.').all(is_name);
        let is_once = all.iter().filter(|other| other.name == number.name).count() == 1;
        let is_inside = number.least < number.most && (number.least..=number.most).contains(&number.value);
        let is_said = number.meaning().ends_with(['.', ')']) && !number.unit.is_empty();
        (!(is_sound && is_once && is_inside && is_said)).then(|| format!("{number:?}"))
    };
    expect_none(all.iter().filter_map(wrong).collect());
}

/// The sources of the crates, without those of tests.
fn code(files: &[File]) -> impl Iterator<Item = &File> {
    files.iter().filter(|file| {
        let is_code = file.path.starts_with("crates/") && file.path.contains("/src/") && file.is("rs");
        is_code && !is_for_tests(&file.path, files)
    })
}

/// All constants of ours and all limits, in the order of the files.
pub(super) fn fixed(files: &[File]) -> impl Iterator<Item = Fixed> {
    code(files).flat_map(|file| judged(file).0)
}

/// The lines before the tests within the file.
fn before_tests(text: &str) -> &str {
    text.find("#[cfg(test)]\nmod tests {").map_or(text, |end| &text[..end])
}

/// The constants of a file that are ours, and the comments that say so of something else.
fn judged(file: &File) -> (Vec<Fixed>, Vec<String>) {
    let (mut fixed, mut wrong) = (Vec::new(), Vec::new());
    let mut comment = String::new();
    let text = before_tests(&file.text);
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    // Constants within a function count only if they are our choice.
    let is_inner: Vec<bool> = text.lines().map(|line| line.starts_with(' ')).collect();
    let mut at = 0;
    while let Some(&line) = lines.get(at) {
        at += 1;
        let is_head = line.starts_with("//!");
        if let Some(said) = line.strip_prefix("//").filter(|_| !is_head) {
            comment += said.trim_start_matches('/');
            continue;
        }
        if is_head || line.starts_with("#[") {
            continue;
        }
        let said = std::mem::take(&mut comment);
        let is_ours = ["ours", "our choice", "our estimate"].iter().any(|mark| has_word(&said.to_lowercase(), mark));
        let mut wanted = at - 1;
        while let Some((constant, next)) = constant(&lines, wanted) {
            let is_limit = constant.as_ref().is_some_and(|[name, ..]| is_limit(&file.path, name)) && !is_inner[wanted];
            if !is_ours && !is_limit {
                break;
            }
            if said.is_empty() {
                wrong.push(format!("{}:{at}: a limit; say above it what it bounds: {line}", file.path));
            }
            fixed.extend(constant.map(|[name, kind, value]| Fixed {
                path: file.path.clone(),
                unit: unit(name.as_str(), &kind),
                name,
                value,
                what: meaning(&said),
            }));
            wanted = next;
        }
        let is_key = file.path.starts_with(FORMS) && line.starts_with("pub ") && line.ends_with(',');
        let is_loose = ["(ours", "(our choice", "(our estimate"].iter().any(|mark| said.contains(mark))
            && wanted == at - 1
            && !is_key;
        let is_beside = line.split_once("// ").is_some_and(|(_, beside)| beside.contains("(ours"));
        if is_loose || is_beside {
            wrong.push(format!("{}:{at}: make it a constant, or declare it with `numbers!`: {line}", file.path));
        }
        at = at.max(wanted);
    }
    (fixed, wrong)
}

/// True for the name of a limit. Programs for developers are exempt.
pub(super) fn is_limit(path: &str, name: &str) -> bool {
    LIMITS.iter().any(|begin| name.starts_with(begin)) && !path.starts_with("crates/homebody-fuzz/")
}

/// The constant in a line: its name, type and value, if it is a number; and the next line.
fn constant(lines: &[&str], from: usize) -> Option<(Option<[String; 3]>, usize)> {
    let first = lines.get(from)?;
    let (visibility, declared) = first.split_once("const ").or_else(|| first.split_once("static "))?;
    if !(visibility.is_empty() || visibility.starts_with("pub")) || declared.starts_with("fn ") {
        return None;
    }
    let length = 1 + lines[from..].iter().position(|line| line.ends_with(';'))?;
    let whole = lines[from..from + length].join(" ");
    let whole = &whole[visibility.len()..];
    let (name, rest) = whole.split_once(' ')?.1.split_once(':')?;
    let (kind, value) = rest.split_once('=')?;
    let is_number = ["f64", "f32", "u8", "u16", "u32", "u64", "i64", "usize", "Span", "Duration"];
    let is_number = is_number.iter().any(|number| has_word(kind, number)) && !kind.contains("str");
    let parts = [name, kind, value.trim_end_matches(';')].map(|part| part.trim().to_owned());
    Some((is_number.then_some(parts), from + length))
}

fn unit(name: &str, kind: &str) -> &'static str {
    let by_name = UNITS.iter().find(|(end, _)| name.ends_with(end));
    by_name.map_or(if has_word(kind, "Span") { "µs" } else { "1" }, |(_, unit)| unit)
}

/// The text of a comment, without the mark of our choice.
fn meaning(said: &str) -> String {
    let said = said.split_whitespace().collect::<Vec<_>>().join(" ");
    ["ours", "our choice", "our estimate"].iter().fold(said, |said, mark| {
        let said = said.replace(&format!(" ({mark})"), "");
        [": ", ", ", "; "].iter().fold(said, |said, end| said.replace(&format!("({mark}{end}"), "("))
    })
}

/// The numbers that a file declares and that are not in the list, as being of this file.
fn unlisted(file: &File, known: &[Number]) -> Vec<String> {
    let declared = before_tests(&file.text).lines().filter_map(|line| {
        let (before, name) = line.split_once("static ")?.1.split_once(" = \"")?;
        (!before.contains(':')).then(|| name.split('"').next().unwrap_or_default())
    });
    // The macro's own documentation shows how to declare one.
    let declared = declared.filter(|_| !file.path.ends_with("homebody-core/src/numbers.rs"));
    let is_listed = |name: &&str| known.iter().any(|number| number.name == *name && number.file == file.path);
    let unlisted = declared.filter(|name| !is_listed(name));
    unlisted.map(|name| format!("{}: {name} is not in the list of its crate", file.path)).collect()
}

fn document(known: &[Number], files: &[File]) -> String {
    let mut text = format!("{HEAD}\n## Parameters\n");
    let mut group = String::new();
    for number in known {
        let Number { name, value, unit, least, most, file, .. } = number;
        if *file != group {
            group = (*file).to_owned();
            text +=
                &format!("\n`{file}`\n\n| key | value | unit | from | to | description |\n|---|---|---|---|---|---|\n");
        }
        text += &format!("| `{name}` | {value} | {unit} | {least} | {most} | {} |\n", cell(&number.meaning()));
    }
    text += &format!("\n{FIXED}");
    let mut group = String::new();
    for Fixed { path, name, value, unit, what } in fixed(files).filter(|one| !is_limit(&one.path, &one.name)) {
        if path != group {
            text += &format!("\n`{path}`\n\n| name | value | unit | description |\n|---|---|---|---|\n");
            group = path;
        }
        text += &format!("| `{name}` | `{}` | {unit} | {} |\n", cell(&value), cell(&what));
    }
    text
}

pub(super) fn cell(text: &str) -> String {
    text.replace('|', "\\|")
}
