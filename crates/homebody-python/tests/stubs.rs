//! The type stubs for Python agree with the functions of this crate. As a test of cargo's, it also makes cargo build the library that
//! `python/tests` needs.

use std::fs;
use std::path::Path;

/// The names of the functions of Python in a source file: those below `#[pyfunction]`, and those in `#[pymethods]`.
fn called(source: &str) -> Vec<String> {
    let mut names = Vec::new();
    let (mut in_methods, mut is_function) = (false, false);
    for line in source.lines() {
        in_methods = (in_methods || line == "#[pymethods]") && line != "}";
        is_function |= line == "#[pyfunction]";
        let indent = if in_methods { "    " } else { "" };
        let rest = line.strip_prefix(indent).map(|line| line.trim_start_matches("pub "));
        if let Some(rest) = rest.and_then(|line| line.strip_prefix("fn ")).filter(|_| in_methods || is_function) {
            is_function = false;
            let end = rest.find(['(', '<']).unwrap_or(rest.len());
            names.push(rest[..end].to_owned());
        }
    }
    names
}

/// The names that the stubs lack.
fn missing<'n>(names: &'n [String], types: &str) -> Vec<&'n str> {
    let is_named = |name: &str| types.contains(&format!("def {name}(")) || name == "new" && types.contains("__init__");
    names.iter().map(String::as_str).filter(|name| !is_named(name)).collect()
}

#[test]
fn stubs_name_all_functions() {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let types = fs::read_to_string(here.join("../../python/homebody/_homebody.pyi")).unwrap();
    let mut names = Vec::new();
    for entry in fs::read_dir(here.join("src")).unwrap() {
        names.extend(called(&fs::read_to_string(entry.unwrap().path()).unwrap()));
    }
    assert!(names.len() > 40 && names.iter().any(|name| name == "run_member"), "{names:?}");
    assert_eq!(missing(&names, &types), [""; 0]);
}

#[test]
fn finds_a_function_without_a_stub() {
    let names =
        called("#[pyfunction]\npub fn one(\n}\n#[pymethods]\nimpl A {\n    fn two<'py>(\n    fn new(\n}\nfn three(");
    assert_eq!(names, ["one", "two", "new"]);
    assert_eq!(missing(&names, "def one(a): ...\ndef __init__(self): ...\n"), ["two"]);
}
