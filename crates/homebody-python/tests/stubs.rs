//! The type stubs for Python agree with the functions and classes of this crate. As a test of cargo's, it also makes cargo build the library
//! that `python/tests` needs.

use std::fs;
use std::path::Path;

/// The stubs of a source file: of each function below `#[pyfunction]` or in `#[pymethods]`, and of each class by its name in Python.
fn stubs(source: &str) -> Vec<String> {
    let mut stubs = Vec::new();
    let (mut in_methods, mut is_function, mut class) = (false, false, None);
    for line in source.lines() {
        in_methods = (in_methods || line == "#[pymethods]") && line != "}";
        is_function |= line == "#[pyfunction]";
        if let Some(arguments) = line.strip_prefix("#[pyclass") {
            let named = arguments.split_once("name = \"").and_then(|(_, name)| name.split_once('"'));
            class = Some(named.map(|(name, _)| name.to_owned()));
        }
        let indent = if in_methods { "    " } else { "" };
        let Some(line) = line.strip_prefix(indent).map(|line| line.trim_start_matches("pub ")) else { continue };
        let name = |rest: &str| rest[..rest.find(['(', '<', ' ', ';']).unwrap_or(rest.len())].to_owned();
        if let Some(rest) = line.strip_prefix("struct ")
            && let Some(named) = class.take()
        {
            stubs.push(format!("class {}:", named.unwrap_or_else(|| name(rest))));
        } else if let Some(rest) = line.strip_prefix("fn ").filter(|_| in_methods || is_function) {
            is_function = false;
            let name = name(rest);
            stubs.push(format!("def {}(", if name == "new" { "__init__" } else { &name }));
        }
    }
    stubs
}

fn missing<'s>(stubs: &'s [String], types: &str) -> Vec<&'s str> {
    stubs.iter().map(String::as_str).filter(|stub| !types.contains(stub)).collect()
}

#[test]
fn stubs_name_all_functions_and_classes() {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let types = fs::read_to_string(here.join("../../python/homebody/_homebody.pyi")).unwrap();
    let sources =
        fs::read_dir(here.join("src")).unwrap().map(|entry| fs::read_to_string(entry.unwrap().path()).unwrap());
    let all: Vec<String> = sources.flat_map(|source| stubs(&source)).collect();
    assert!(
        all.len() > 45 && ["def run_member(", "class Log:"].iter().all(|stub| all.iter().any(|one| one == stub)),
        "{all:?}"
    );
    assert_eq!(missing(&all, &types), [""; 0]);
}

#[test]
fn finds_a_function_and_a_class_without_a_stub() {
    let all = stubs(
        "#[pyfunction]\npub fn one(\n}\n#[pyclass(frozen, name = \"A\")]\npub struct PythonA {\n#[pyclass]\nstruct B;\n#[pymethods]\nimpl A {\n    \
         fn two<'py>(\n    fn new(\n}\nfn three(",
    );
    assert_eq!(all, ["def one(", "class A:", "class B:", "def two(", "def __init__("]);
    assert_eq!(missing(&all, "class A:\n    def __init__(self): ...\ndef one(a): ...\n"), ["class B:", "def two("]);
}
