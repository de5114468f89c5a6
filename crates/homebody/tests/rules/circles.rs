//! Files and folders that need each other in a circle: a reader needs all of them at once.
//!
//! A file needs another of its crate if it names one of its definitions: in a `use`, or in a path such as `crate::time::DAY` or
//! `grid::Corner`. A name from a `pub use` counts to the file of its definition, so a module that only declares and re-exports is in no
//! circle. Code for tests is left out.
//!
//! A folder needs what its files need. A module `name.rs` and its folder `name` are one.

use super::rust::{Import, parted, paths, words};
use super::source::is_for_tests;
use super::{File, expect_none, files, reached};
use std::collections::{BTreeMap, BTreeSet};

#[test]
fn files_do_not_need_each_other_in_circles() {
    let tree = Tree::new(&files());
    expect_none(tree.circles().iter().map(|circle| tree.wrong(circle)).collect());
}

#[test]
fn folders_do_not_need_each_other_in_circles() {
    expect_none(Tree::new(&files()).folder_circles());
}

#[test]
fn finds_a_circle_of_folders_without_a_circle_of_files() {
    let tree = [
        File::new("crates/a/src/one.rs", "pub mod low; pub mod high;"),
        File::new("crates/a/src/one/low.rs", "pub struct Low;"),
        File::new("crates/a/src/one/high.rs", "use crate::two::Two; pub struct High(Two);"),
        File::new("crates/a/src/two.rs", "use crate::one::low::Low; pub struct Two(Low);"),
    ];
    let tree = Tree::new(&tree);
    assert_eq!(tree.circles(), Vec::<Vec<String>>::new());
    let circles = tree.folder_circles();
    assert_eq!(circles.len(), 1, "{circles:?}");
    assert!(circles[0].starts_with("in a/src these need each other: one, two"), "{}", circles[0]);
    assert!(circles[0].contains("a/src/one/high.rs needs a/src/two.rs for Two"), "{}", circles[0]);
}

#[test]
fn a_circle_is_told_with_what_closes_it() {
    let tree = Tree::new(&[
        File::new("crates/a/src/one.rs", "pub struct One(Box<crate::two::Two>);"),
        File::new("crates/a/src/two.rs", "use crate::one::One; pub struct Two(One);"),
    ]);
    let told = ["a/src/one.rs needs a/src/two.rs for Two", "a/src/two.rs needs a/src/one.rs for One"];
    let circle = &tree.circles()[0];
    assert_eq!(tree.why(circle), told);
    assert!(told.iter().all(|why| tree.wrong(circle).contains(why)));
}

/// A crate in which `one.rs` needs the other files, and one of the others is as given.
fn made_up(path: &str, text: &str) -> Vec<Vec<String>> {
    let mut tree = vec![
        File::new("crates/a/src/lib.rs", "//! A crate.\npub mod one;\nmod deep;\npub use deep::two::Two;\n"),
        File::new(
            "crates/a/src/one.rs",
            "use crate::deep::{Two, three};\npub struct One(Two);\nfn f() { three::g() }\n",
        ),
        File::new(
            "crates/a/src/deep/mod.rs",
            "pub mod three;\npub mod two;\npub(crate) use two::{Two, Two as Other};\n",
        ),
        File::new("crates/a/src/deep/two.rs", "pub struct Two;\n"),
        File::new("crates/a/src/deep/three.rs", "pub fn g() {}\n"),
    ];
    tree.retain(|file| file.path != format!("crates/a/src/{path}"));
    tree.push(File::new(&format!("crates/a/src/{path}"), text));
    Tree::new(&tree).circles()
}

#[test]
fn every_way_of_naming_closes_a_circle() {
    let (two, three) = ([["a/src/deep/two.rs", "a/src/one.rs"]], [["a/src/deep/three.rs", "a/src/one.rs"]]);
    assert_eq!(made_up("deep/two.rs", "use crate::one::One;\npub struct Two(One);"), two);
    assert_eq!(made_up("deep/two.rs", "pub struct Two(Box<super::super::one::One>);"), two);
    assert_eq!(made_up("deep/two.rs", "use crate::one;\npub struct Two(one::One);"), two);
    assert_eq!(made_up("deep/two.rs", "use crate::{one::{self as first, One}};\npub struct Two(first::One);"), two);
    assert_eq!(made_up("deep/three.rs", "pub fn g() { crate::one::f() }"), three);
    // Through what the module passes on, and through a module that does more than that.
    let both = [["a/src/deep/three.rs", "a/src/deep/two.rs"]];
    let tree = "use super::three::g;\npub struct Two; fn f() { g() }";
    assert_eq!(made_up("deep/two.rs", tree), Vec::<Vec<String>>::new());
    let tree = "pub mod three { use super::two::Two; }\npub mod two; pub use two::Two; fn h(_: Two) {}";
    assert_eq!(made_up("deep/mod.rs", tree), Vec::<Vec<String>>::new());
    let tree = [
        File::new("crates/a/src/deep/mod.rs", "mod two; mod three; pub use two::Two;"),
        File::new("crates/a/src/deep/two.rs", "pub struct Two(super::three::Three);"),
        File::new("crates/a/src/deep/three.rs", "use super::Two; pub struct Three(Box<Two>);"),
    ];
    assert_eq!(Tree::new(&tree).circles(), both);
    let tree = [
        File::new("crates/a/src/deep/mod.rs", "mod two; pub use two::Two; pub struct Deep(Two);"),
        File::new("crates/a/src/deep/two.rs", "pub struct Two(Box<super::Deep>);"),
    ];
    assert_eq!(Tree::new(&tree).circles(), [["a/src/deep/mod.rs", "a/src/deep/two.rs"]]);
}

#[test]
fn a_path_without_a_definition_closes_no_circle() {
    let none = Vec::<Vec<String>>::new();
    assert_eq!(made_up("deep/two.rs", "pub struct Two;"), none);
    assert_eq!(made_up("deep/two.rs", "// use crate::one::One;\n/* crate::one::One */ pub struct Two;"), none);
    assert_eq!(
        made_up(
            "deep/two.rs",
            "pub struct Two<'a>(&'a str); const A: char = '\"'; const B: &str = \"crate::one::One\";"
        ),
        none
    );
    assert_eq!(made_up("deep/two.rs", "pub struct Two; const A: &str = r#\"\"crate::one::One\"#;"), none);
    assert_eq!(
        made_up("deep/two.rs", "pub struct Two;\n#[cfg(test)]\nmod tests { use crate::one::One; fn a() {} }"),
        none
    );
    assert_eq!(made_up("deep/two.rs", "pub struct Two;\n#[cfg(test)]\nuse crate::one::One;"), none);
    assert_eq!(made_up("deep/two.rs", "pub use crate::one::One; pub struct Two;"), none);
    assert_eq!(made_up("deep/two.rs", "use other::one::One; pub struct Two(One);"), none);
}

/// For what a file needs each of the others.
type Needs = BTreeMap<usize, BTreeSet<String>>;

/// The modules of one folder that need each other, by name, with the reasons.
type Neighbours = BTreeMap<String, BTreeMap<String, Vec<String>>>;

struct Tree {
    sources: Vec<Source>,
    /// By crate and module, such as `a` and `deep`, `two`.
    modules: BTreeMap<Vec<String>, usize>,
}

struct Source {
    /// Below `crates/`.
    path: String,
    /// Its crate, then its module.
    module: Vec<String>,
    imports: Vec<Import>,
    /// The words and signs of the file without imports and declarations of modules.
    body: Vec<String>,
}

impl Tree {
    fn new(files: &[File]) -> Tree {
        let mut sources = Vec::new();
        for file in files.iter().filter(|file| !is_for_tests(&file.path, files)) {
            let Some((folder, below)) = file.path.strip_prefix("crates/").and_then(|path| path.split_once("/src/"))
            else {
                continue;
            };
            let Some(name) = below.strip_suffix(".rs") else { continue };
            let parts = name.split('/').filter(|part| !["lib", "main", "mod"].contains(part));
            let module = [folder].into_iter().chain(parts).map(String::from).collect();
            let (imports, body) = parted(words(&file.text));
            sources.push(Source { path: format!("{folder}/src/{below}"), module, imports, body });
        }
        let modules = sources.iter().enumerate().map(|(index, source)| (source.module.clone(), index)).collect();
        Tree { sources, modules }
    }

    /// The circles of all crates, the files of each in order.
    fn circles(&self) -> Vec<Vec<String>> {
        let needs: Vec<Needs> = (0..self.sources.len()).map(|source| self.needs(source)).collect();
        let needed = |source: &usize| needs[*source].keys().copied().collect();
        let reached: Vec<BTreeSet<usize>> = (0..needs.len()).map(|source| reached(source, needed)).collect();
        let mut circles = BTreeSet::new();
        for source in 0..needs.len() {
            let circle = reached[source].iter().filter(|&&other| reached[other].contains(&source));
            let circle: BTreeSet<String> = circle.map(|&other| self.sources[other].path.clone()).collect();
            if circle.len() > 1 {
                circles.insert(circle.into_iter().collect());
            }
        }
        circles.into_iter().collect()
    }

    /// The modules of each folder that need each other in a circle, and why.
    fn folder_circles(&self) -> Vec<String> {
        let mut folders: BTreeMap<String, Neighbours> = BTreeMap::new();
        for (from, source) in self.sources.iter().enumerate() {
            for (to, names) in self.needs(from) {
                let other = &self.sources[to];
                let (one, two): (Vec<&str>, Vec<&str>) =
                    (source.path.split('/').collect(), other.path.split('/').collect());
                let common = one.iter().zip(&two).take_while(|(one, two)| one == two).count();
                let [one, two] = [one[common], two[common]].map(|name| name.trim_end_matches(".rs").to_owned());
                if one != two {
                    let folder = source.path.split('/').take(common).collect::<Vec<_>>().join("/");
                    let names: Vec<String> = names.into_iter().collect();
                    let why = format!("{} needs {} for {}", source.path, other.path, names.join(", "));
                    let neighbours = folders.entry(folder).or_default().entry(one).or_default();
                    neighbours.entry(two).or_default().push(why);
                }
            }
        }
        let mut circles = Vec::new();
        for (folder, neighbours) in &folders {
            let needed =
                |module: &String| neighbours.get(module).into_iter().flat_map(BTreeMap::keys).cloned().collect();
            let reached: BTreeMap<&String, BTreeSet<String>> =
                neighbours.keys().map(|module| (module, reached(module.clone(), needed))).collect();
            let circle = |module: &String| -> BTreeSet<&String> {
                let is_in = |other: &&String| reached.get(other).is_some_and(|back| back.contains(module));
                reached[module].iter().filter(is_in).collect()
            };
            let all: BTreeSet<BTreeSet<&String>> = neighbours.keys().map(circle).filter(|all| all.len() > 1).collect();
            for circle in all {
                let needs = circle.iter().filter_map(|one| neighbours.get(*one)).flatten();
                let why: Vec<&str> = needs
                    .filter(|(other, _)| circle.contains(other))
                    .flat_map(|(_, why)| why.iter().map(String::as_str))
                    .collect();
                let modules: Vec<&str> = circle.iter().map(|module| module.as_str()).collect();
                circles.push(format!("in {folder} these need each other: {} ({})", modules.join(", "), why.join("; ")));
            }
        }
        circles
    }

    /// The problem with a circle, and the dependencies that close it.
    fn wrong(&self, circle: &[String]) -> String {
        let (files, why) = (circle.join(", "), self.why(circle).join("; "));
        format!("these need each other: {files}; move what they share into a file below them ({why})")
    }

    fn why(&self, circle: &[String]) -> Vec<String> {
        let is_of = |source: &usize| circle.contains(&self.sources[*source].path);
        let mut why = Vec::new();
        for from in (0..self.sources.len()).filter(is_of) {
            for (to, names) in self.needs(from).into_iter().filter(|(to, _)| is_of(to)) {
                let names: Vec<String> = names.into_iter().collect();
                let [from, to] = [from, to].map(|file| self.sources[file].path.as_str());
                why.push(format!("{from} needs {to} for {}", names.join(", ")));
            }
        }
        why
    }

    fn needs(&self, from: usize) -> Needs {
        let source = &self.sources[from];
        let is_said = |name: &String| source.body.contains(name);
        // An imported module is needed where one of its items is named.
        let imports = source.imports.iter().filter(|import| !import.is_public || is_said(&import.name));
        let mut named: Vec<Vec<String>> = imports.filter_map(|import| self.from(source, &import.path)).collect();
        for path in paths(&source.body) {
            let mut modules = source.imports.iter().filter(|import| import.name == path[0]);
            let brought_in = modules.find_map(|import| self.from(source, &import.path));
            named.extend(match brought_in {
                Some(module) => Some([&module[..], &path[1..]].concat()),
                None => self.from(source, &path),
            });
        }
        let mut needs = Needs::new();
        for path in named {
            if let Some((file, name)) = self.item(&path, 0)
                && file != from
                && !self.sources[file].body.is_empty()
            {
                needs.entry(file).or_default().insert(name);
            }
        }
        needs
    }

    /// A path in a file, from its crate on.
    fn from(&self, source: &Source, path: &[String]) -> Option<Vec<String>> {
        let up = path.iter().take_while(|part| *part == "super").count();
        let (begin, rest) = match path.first()?.as_str() {
            "crate" => (&source.module[..1], &path[1..]),
            "self" => (&source.module[..], &path[1..]),
            "super" => (source.module.get(..source.module.len().checked_sub(up)?)?, &path[up..]),
            child => {
                let module = [&source.module[..], &[child.to_owned()]].concat();
                self.modules.contains_key(&module).then_some((&source.module[..], path))?
            }
        };
        Some([begin, rest].concat())
    }

    /// The file that defines what a path from its crate on names, and the name; none if that is a module.
    fn item(&self, path: &[String], depth: usize) -> Option<(usize, String)> {
        let length = (1..=path.len()).rev().find(|&length| self.modules.contains_key(&path[..length]))?;
        let index = self.modules[&path[..length]];
        let source = &self.sources[index];
        let [name, rest @ ..] = &path[length..] else { return None };
        if depth > 8 || name == "*" || source.defines(name) {
            return Some((index, name.clone()));
        }
        let whole = |import: &Import, rest: &[String]| Some([&self.from(source, &import.path)?[..], rest].concat());
        if let Some(import) = source.imports.iter().find(|import| import.name == *name) {
            return self.item(&whole(import, rest)?, depth + 1);
        }
        let mut all = source.imports.iter().filter(|import| import.name == "*").filter_map(|import| {
            let mut path = whole(import, &[])?;
            path.pop();
            path.push(name.clone());
            self.item(&path, depth + 1).filter(|(other, _)| self.sources[*other].defines(name))
        });
        all.next().or(Some((index, name.clone())))
    }
}

impl Source {
    fn defines(&self, name: &str) -> bool {
        const KEYWORDS: [&str; 9] = ["struct", "enum", "fn", "const", "type", "trait", "static", "mod", "union"];
        self.body.windows(2).any(|pair| KEYWORDS.contains(&pair[0].as_str()) && pair[1] == name)
    }
}
