//! The form of source files: length, names, the head of a sensor's file, unwraps, and tests that belong to a program.

use super::{File, expect_none, files, numbered, paths};

const LONGEST_LINES: usize = 600;

/// The source files that may be longer, and why.
const LONG: [(&str, &str); 1] = [("web/src/wire.ts", "made from the types of the server, which are in several files")];

const SENSORS: &str = "crates/homebody-core/src/sensors/";

/// Names that say nothing of what is inside.
const EMPTY_NAMES: [&str; 6] = ["util", "utils", "common", "misc", "helper", "helpers"];

#[test]
fn no_source_file_is_too_long() {
    let files = files();
    expect_none(files.iter().filter_map(too_long).collect());
    let needless = LONG.iter().filter(|(path, _)| files.iter().all(|file| file.path != *path || !is_long(file)));
    expect_none(needless.map(|(path, _)| format!("{path} is short now, or gone: LONG need not name it")).collect());
}

#[test]
fn a_long_source_file_is_found() {
    assert!(too_long(&File::new("a.rs", &"\n".repeat(600))).is_none());
    assert!(too_long(&File::new("a.rs", &"\n".repeat(601))).is_some());
    assert!(too_long(&File::new("a.json", &"\n".repeat(601))).is_none());
}

#[test]
fn every_sensor_opens_with_what_assumptions_how_and_limits() {
    let files = files();
    let sensors: Vec<&File> = files.iter().filter(|file| is_sensor(&file.path)).collect();
    assert!(sensors.len() >= 2, "the sensors are in {SENSORS}");
    expect_none(sensors.into_iter().filter_map(opens_wrongly).collect());
}

#[test]
fn a_sensor_that_opens_otherwise_is_found() {
    let head = "//! A mat.\n//!\n//! The device is stood on.\n//!\n//! We assume\n//! weight.\n//!\n//! By area.\n//!\n//! Left out: wear.\n";
    let wrong = |text: &str| opens_wrongly(&File::new("mat.rs", text)).is_some();
    assert!(!wrong(&format!("{head}\nuse a::b;\n")));
    assert!(wrong("use a::b;\n"));
    assert!(wrong(&head.replace("//! By area.\n//!\n", "")));
    assert!(wrong(&head.replace("We assume", "Somebody has")));
    assert!(wrong(&head.replace("Left out: wear", "It wears")));
}

#[test]
fn no_name_is_empty_or_counts_versions() {
    expect_none(paths().iter().filter(|path| is_badly_named(path)).cloned().collect());
    expect_none(files().iter().flat_map(badly_named_modules).collect());
}

#[test]
fn a_name_that_is_empty_or_counts_versions_is_found() {
    for path in ["crates/common/", "src/util.rs", "web/src/Helpers.ts", "src/misc/mod.rs", "sinks/V2/", "src/v3.rs"] {
        assert!(is_badly_named(path), "{path}");
    }
    for path in ["src/utility_meter.rs", "src/v.rs", "src/commons_room.json", "crates/homebody-core/"] {
        assert!(!is_badly_named(path), "{path}");
    }
    assert_eq!(badly_named_modules(&File::new("a.rs", "mod a;\npub(crate) mod utils {\n}\nmod helpers;")).len(), 2);
}

#[test]
fn no_source_file_is_called_mod() {
    expect_none(paths().iter().filter(|path| is_called_mod(path)).cloned().collect());
}

#[test]
fn finds_a_source_file_called_mod() {
    assert!(is_called_mod("crates/a/src/sink/mod.rs"));
    for path in ["crates/a/src/sink.rs", "crates/a/src/model.rs", "crates/a/tests/folder/mod.rs"] {
        assert!(!is_called_mod(path), "{path}");
    }
}

#[test]
fn code_outside_tests_says_why_it_cannot_fail() {
    let files = files();
    let wrong = files.iter().filter(|file| is_code(&file.path) && !is_for_tests(&file.path, &files)).flat_map(unwraps);
    expect_none(wrong.collect());
}

#[test]
fn an_unwrap_outside_tests_is_found() {
    let wrong = |text: &str| unwraps(&File::new("crates/a/src/a.rs", text));
    assert_eq!(wrong("fn a() {\n    b().unwrap();\n}"), ["crates/a/src/a.rs:2: b().unwrap();"]);
    assert_eq!(wrong("b().expect(\"why\");\n// c().unwrap()\n").len(), 0);
    assert_eq!(wrong("#[cfg(test)]\npub mod tests {\n    b().unwrap();\n}\n").len(), 0);
    assert_eq!(wrong("#[cfg(test)]\nmod tests {\n}\nfn a() {\n    b().unwrap();\n}\n").len(), 1);
    assert_eq!(wrong("#[cfg(test)]\nmod tests;\nb().unwrap();\n").len(), 1);

    let folder = |parent: &str| [File::new(parent, "mod b;\n#[cfg(test)]\nmod real;\n"), File::new("x", "")];
    assert!(is_for_tests("crates/a/src/b/real.rs", &folder("crates/a/src/b.rs")));
    assert!(is_for_tests("crates/a/src/b/real.rs", &folder("crates/a/src/b/mod.rs")));
    assert!(!is_for_tests("crates/a/src/b/b.rs", &folder("crates/a/src/b.rs")));
    assert!(!is_for_tests("crates/a/src/c/real.rs", &folder("crates/a/src/b.rs")));
}

#[test]
fn every_file_of_tests_is_part_of_a_program() {
    expect_none(forgotten_tests(&files()));
}

#[test]
fn finds_a_file_of_tests_that_no_program_has() {
    let files = [
        File::new("crates/a/Cargo.toml", "autotests = false\n[[test]]\nname = \"all\"\n"),
        File::new("crates/a/tests/all.rs", "mod one;\nmod stage;\n"),
        File::new("crates/a/tests/one.rs", ""),
        File::new("crates/a/tests/stage/mod.rs", "pub mod server;"),
        File::new("crates/a/tests/stage/server.rs", ""),
        File::new("crates/a/tests/two.rs", ""),
        File::new("crates/b/Cargo.toml", ""),
        File::new("crates/b/tests/own.rs", ""),
        File::new("crates/b/tests/large/main.rs", "mod part;"),
        File::new("crates/b/tests/large/other.rs", ""),
    ];
    assert_eq!(forgotten_tests(&files), ["crates/a/tests/two.rs", "crates/b/tests/large/other.rs"]);
}

#[test]
fn no_manifest_turns_off_tests_that_there_are() {
    expect_none(tests_turned_off(&files()));
}

#[test]
fn finds_tests_that_a_manifest_turns_off() {
    let wrong = |manifest: &str, code: &str| {
        let files = [File::new("crates/a/Cargo.toml", manifest), File::new("crates/a/src/lib.rs", code)];
        tests_turned_off(&files).len()
    };
    let (unit, example) = ("#[test]\nfn a() {}\n", "/// ```\n/// a();\n/// ```\n");
    assert_eq!((wrong("[lib]\ntest = false\n", unit), wrong("[lib]\ndoctest = false\n", unit)), (1, 0));
    assert_eq!((wrong("[lib]\ndoctest = false\n", example), wrong("[lib]\ntest = false\n", example)), (1, 0));
    assert_eq!(wrong("[lib]\ndoctest = false\n", "/// ```json\n/// {}\n/// ```\n"), 0);
    assert_eq!(wrong("[dependencies]\n", &(unit.to_owned() + example)), 0);
}

fn is_source(file: &File) -> bool {
    ["rs", "py", "ts", "js", "svelte", "css", "html", "sh"].iter().any(|extension| file.is(extension))
}

fn is_long(file: &File) -> bool {
    is_source(file) && file.text.lines().count() > LONGEST_LINES
}

fn too_long(file: &File) -> Option<String> {
    let is_listed = LONG.iter().any(|(path, _)| *path == file.path);
    let lines = file.text.lines().count();
    (is_long(file) && !is_listed).then(|| format!("{}: {lines} lines; cut it, or give LONG a reason", file.path))
}

fn is_sensor(path: &str) -> bool {
    path.strip_prefix(SENSORS).is_some_and(|name| name != "mod.rs" && !name.contains('/') && name.ends_with(".rs"))
}

/// The problem with the head of a sensor's file: a title, then four paragraphs.
fn opens_wrongly(file: &File) -> Option<String> {
    let head: Vec<&str> = file.text.lines().map_while(|line| line.strip_prefix("//!")).map(str::trim).collect();
    let paragraphs: Vec<&[&str]> = head.split(|line| line.is_empty()).collect();
    let is_right = match paragraphs[..] {
        [_title, _device, assumptions, _how, limits] => {
            assumptions.first().is_some_and(|line| line.starts_with("We assume"))
                && limits.first().is_some_and(|line| line.starts_with("Left out"))
        }
        _ => false,
    };
    let wanted = "a title, then a paragraph on what the device does, one that begins with `We assume`, \
        one on how it is computed, and one that begins with `Left out`";
    (!is_right).then(|| format!("{}: it opens with {wanted}", file.path))
}

fn is_badly_named(path: &str) -> bool {
    let counts_versions = |name: &str| name.strip_prefix('v').is_some_and(|rest| rest.parse::<u32>().is_ok());
    path.split('/').any(|name| {
        let name = name.split('.').next().unwrap_or_default().to_lowercase();
        EMPTY_NAMES.contains(&name.as_str()) || counts_versions(&name)
    })
}

fn badly_named_modules(file: &File) -> Vec<String> {
    let module = |line: &str| {
        let (before, after) = line.trim().split_once("mod ")?;
        let name = after.split([';', ' ']).next()?;
        (before.is_empty() || before.starts_with("pub")).then(|| name.to_owned())
    };
    let lines = numbered(&file.text).filter(|_| file.is("rs"));
    let wrong = lines.filter(|(_, line)| module(line).is_some_and(|name| is_badly_named(&name)));
    wrong.map(|(number, line)| format!("{}:{number}: {}", file.path, line.trim())).collect()
}

/// A module `name` is in `name.rs`, and its parts are in the folder `name`.
fn is_called_mod(path: &str) -> bool {
    is_code(path) && path.ends_with("/mod.rs")
}

/// True for a source of a crate, without its tests and benchmarks.
fn is_code(path: &str) -> bool {
    path.starts_with("crates/") && path.contains("/src/") && path.ends_with(".rs")
}

/// True for a module that its parent declares for tests only.
pub fn is_for_tests(path: &str, files: &[File]) -> bool {
    let Some((folder, name)) = path.trim_end_matches(".rs").rsplit_once('/') else { return false };
    let parents = [format!("{folder}.rs"), format!("{folder}/mod.rs"), format!("{folder}/lib.rs")];
    let declaration = format!("#[cfg(test)]\nmod {name};");
    files.iter().any(|file| parents.contains(&file.path) && file.text.contains(&declaration))
}

/// The lines outside a file's tests that give up without a reason.
fn unwraps(file: &File) -> Vec<String> {
    let (mut wrong, mut before, mut in_tests) = (Vec::new(), "", false);
    for (number, line) in numbered(&file.text) {
        in_tests = if in_tests { line != "}" } else { before == "#[cfg(test)]" && line.ends_with('{') };
        before = line;
        if !in_tests && line.contains(".unwrap()") && !line.trim().starts_with("//") {
            wrong.push(format!("{}:{number}: {}", file.path, line.trim()));
        }
    }
    wrong
}

/// The files of tests that are neither a program nor declared as a module of one, so that their tests never run.
fn forgotten_tests(files: &[File]) -> Vec<String> {
    let is_forgotten = |file: &&File| {
        let Some((package, rest)) = file.path.split_once("/tests/").filter(|_| file.is("rs")) else { return false };
        let name = rest.trim_end_matches(".rs").trim_end_matches("/mod").trim_end_matches("/main");
        let name = name.rsplit('/').next().unwrap_or(name);
        let manifest = files.iter().find(|other| other.path == format!("{package}/Cargo.toml"));
        let manifest = manifest.map_or("", |manifest| manifest.text.as_str());
        let is_program = match manifest.contains("autotests = false") {
            true => manifest.contains(&format!("name = \"{name}\"")),
            false => !rest.contains('/') || rest.ends_with("/main.rs"),
        };
        let folder = format!("{package}/tests/");
        let declaration = format!("mod {name};");
        let declares = |line: &str| line.trim_start_matches("pub ") == declaration;
        let mut others = files.iter().filter(|other| other.path.starts_with(&folder));
        !is_program && !others.any(|other| other.text.lines().any(declares))
    };
    files.iter().filter(is_forgotten).map(|file| file.path.clone()).collect()
}

/// The files of libraries with tests or examples that their manifest turns off.
fn tests_turned_off(files: &[File]) -> Vec<String> {
    let is_off = |file: &&File| {
        let Some((package, _)) = file.path.split_once("/src/").filter(|_| is_code(&file.path)) else { return false };
        let Some(manifest) = files.iter().find(|other| other.path == format!("{package}/Cargo.toml")) else {
            return false;
        };
        let lib = manifest.text.split("[lib]\n").nth(1).and_then(|rest| rest.split("\n[").next()).unwrap_or_default();
        let says = |setting: &str| lib.lines().any(|line| line == setting);
        says("test = false") && file.text.contains("#[test]") || says("doctest = false") && has_example(&file.text)
    };
    files.iter().filter(is_off).map(|file| file.path.clone()).collect()
}

/// True if doc comments have a block of Rust that runs.
fn has_example(text: &str) -> bool {
    let docs = text.lines().filter_map(|line| line.trim().strip_prefix("//!").or(line.trim().strip_prefix("///")));
    let fences = docs.filter_map(|line| line.trim().strip_prefix("```"));
    fences.step_by(2).any(|language| ["", "rust", "no_run", "should_panic", "compile_fail"].contains(&language))
}
