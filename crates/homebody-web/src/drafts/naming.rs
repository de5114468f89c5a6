//! Names in all files of a scenario: their uses, and the changes when a thing is renamed or deleted.
//!
//! In JSON files a name counts where it refers to a thing, and in routines where it is used as a name: "in the armchair", but not
//! "to bed". If another thing of the home has the same name, sentences may mean that one and stay unchanged.

use super::DraftService;
use super::entries::{Entry, entries, without};
use crate::wire::{Draft, Forget, MendView, MentionView, Named, NamesView, Rename};
use homebody_core::scenario::load::{Files, Overlay};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

/// The words before a name in a sentence.
const ARTICLES: [&str; 9] = ["the", "her", "his", "their", "its", "a", "an", "my", "your"];

/// The lists of `home.json` whose names occur in sentences and paths.
const SPOKEN_OF: [&str; 4] = ["rooms", "doors", "furniture", "places"];

/// A sensor that wakes another, in `home.json`.
const WAKER: [&str; 4] = ["sensors", "*", "woken_by", "*"];

struct Mention {
    /// A JSON string with its quotes, or words.
    name: Range<usize>,
    /// The part to remove with the thing; `None` if the rest would make no sense.
    whole: Option<Range<usize>>,
}

#[derive(Clone, Copy, PartialEq)]
enum LinkedFileKind {
    Home,
    Logger,
    Link,
    Resident,
    Routine,
    Path,
    Script,
}

struct LinkedFiles<'a> {
    files: &'a Overlay<'a>,
    kinds: Vec<(String, LinkedFileKind)>,
    /// The names of the home's things, with their lists.
    names: BTreeMap<String, Vec<&'static str>>,
    /// Whether sentences count that may mean another thing of the name.
    even_shared: bool,
}

impl DraftService {
    /// Renames a thing: all texts that change. None if another of its kind has the old or new name, in any case of letters: sentences
    /// would be ambiguous.
    pub fn rename(&self, asked: Rename) -> NamesView {
        let Rename { draft, kind, from, to } = &asked;
        let files = self.with(draft.clone());
        let linked = LinkedFiles::new(&files, &self.folders.entry);
        if linked.are_several(*kind, from, to) {
            return NamesView { is_shared: true, ..NamesView::default() };
        }
        let view = self.renamed(&asked, false);
        let is_shared = *kind != Named::Resident && linked.others(*kind, from) > 0;
        if !is_shared {
            return view;
        }
        // Ambiguous sentences stay, unless they become invalid.
        let wrong = |texts: &BTreeMap<String, String>| {
            let mut draft = draft.clone();
            draft.texts.extend(texts.clone());
            self.check(draft).problems.len()
        };
        if wrong(&view.texts) > wrong(&BTreeMap::new()) { self.renamed(&asked, true) } else { view }
    }

    fn renamed(&self, Rename { draft, kind, from, to }: &Rename, even_shared: bool) -> NamesView {
        let files = self.with(draft.clone());
        let linked = LinkedFiles { even_shared, ..LinkedFiles::new(&files, &self.folders.entry) };
        let mut view = NamesView::default();
        for (file, of) in &linked.kinds {
            let Ok(text) = files.read(file) else { continue };
            let found = linked.mentions(&text, *of, *kind, from);
            let mut fresh = text.clone();
            for Mention { name, .. } in found.iter().rev() {
                let said = &text[name.clone()];
                let is_quoted = said.starts_with('"');
                let written = if is_quoted { Value::from(to.as_str()).to_string() } else { as_said(said, to) };
                fresh.replace_range(name.clone(), &written);
            }
            view.add(file, &text, &found, fresh);
        }
        view
    }

    /// Deletes a thing: its uses, and the texts without them. The thing itself stays in its file.
    pub fn forget(&self, Forget { draft, kind, names }: Forget) -> NamesView {
        let files = self.with(draft);
        let linked = LinkedFiles::new(&files, &self.folders.entry);
        let mut view = NamesView::default();
        // A sensor on a deleted thing is deleted, too, with its uses.
        let mut gone: Vec<(Named, String)> = names.into_iter().map(|name| (kind, name)).collect();
        if kind != Named::Sensor
            && let Some((_, text)) = linked.text_of(LinkedFileKind::Home)
        {
            let all = entries(&text);
            for (_, name) in gone.clone() {
                let on = linked
                    .mentions_in_json(&all, LinkedFileKind::Home, kind, &name)
                    .into_iter()
                    .filter(|entry| entry.path[0] == "sensors")
                    .filter_map(|entry| entry.path.get(1));
                gone.extend(on.filter_map(|index| Some((Named::Sensor, sensor_name(&all, index)?))));
            }
        }
        for (file, of) in &linked.kinds {
            let Ok(text) = files.read(file) else { continue };
            let mut found: Vec<Mention> = Vec::new();
            for (kind, name) in &gone {
                let own = |mention: &Mention| *of == LinkedFileKind::Home && is_own_name(&text, mention);
                found.extend(linked.mentions(&text, *of, *kind, name).into_iter().filter(|mention| !own(mention)));
            }
            let cut: Vec<Range<usize>> = found.iter().filter_map(|mention| mention.whole.clone()).collect();
            let fresh = without(&text, &cut);
            view.add(file, &text, &found, fresh);
        }
        view
    }

    /// The problems that have one solution.
    pub fn mends(&self, draft: Draft) -> Vec<MendView> {
        let files = self.with(draft);
        let linked = LinkedFiles::new(&files, &self.folders.entry);
        let Some((_, home)) = linked.text_of(LinkedFileKind::Home) else { return Vec::new() };
        let home = entries(&home);
        let sensors: BTreeSet<&str> =
            home.iter().filter(|entry| entry.is(&["sensors", "*", "name"])).filter_map(Entry::text).collect();
        if home.is_empty() {
            return Vec::new();
        }
        let mut mends = Vec::new();
        for (kind, one, many) in [
            (LinkedFileKind::Home, "wake-up by", "wake-ups by"),
            (LinkedFileKind::Logger, "id of", "ids of"),
            (LinkedFileKind::Link, "line about", "lines about"),
        ] {
            let Some((file, text)) = linked.text_of(kind) else { continue };
            let all = entries(&text);
            let gone: Vec<(String, Range<usize>)> = all
                .iter()
                .filter_map(|entry| {
                    let (name, whole) = sensor_of(&all, entry, kind)?;
                    (!sensors.contains(name.as_str())).then_some((name, whole))
                })
                .collect();
            let what = match &gone[..] {
                [] => continue,
                [(name, _)] => format!("Remove the {one} the deleted sensor \u{201c}{name}\u{201d}"),
                all => format!("Remove the {} {many} deleted sensors", all.len()),
            };
            let cut: Vec<Range<usize>> = gone.into_iter().map(|(_, whole)| whole).collect();
            mends.push(MendView { what, texts: BTreeMap::from([(file, without(&text, &cut))]) });
        }
        mends
    }
}

impl NamesView {
    fn add(&mut self, file: &str, text: &str, found: &[Mention], fresh: String) {
        for mention in found {
            let line = text[..mention.name.start].matches('\n').count();
            let said = text.lines().nth(line).unwrap_or_default().trim();
            self.mentions.push(MentionView {
                file: file.to_owned(),
                line: line as u32 + 1,
                said: said.chars().take(200).collect(),
                goes: mention.whole.is_some(),
            });
        }
        if fresh != text {
            self.texts.insert(file.to_owned(), fresh);
        }
    }
}

impl<'a> LinkedFiles<'a> {
    fn new(files: &'a Overlay<'a>, entry: &str) -> LinkedFiles<'a> {
        let json = |name: &str| {
            files.read(name).ok().and_then(|text| serde_json::from_str::<Value>(&text).ok()).unwrap_or_default()
        };
        let root = json(entry);
        let mut kinds: Vec<(String, LinkedFileKind)> = Vec::new();
        let mut add = |name: &Value, kind: LinkedFileKind| {
            if let Some(name) = name.as_str().filter(|name| kinds.iter().all(|(known, _)| known != name)) {
                kinds.push((name.to_owned(), kind));
            }
        };
        add(&root["home"], LinkedFileKind::Home);
        add(&root["logger"], LinkedFileKind::Logger);
        add(&root["link"], LinkedFileKind::Link);
        for file in root["residents"].as_array().into_iter().flatten() {
            add(file, LinkedFileKind::Resident);
            let driver = &json(file.as_str().unwrap_or_default())["driver"];
            add(&driver["routine"], LinkedFileKind::Routine);
            add(&driver["path"], LinkedFileKind::Path);
            add(&driver["script"], LinkedFileKind::Script);
            add(&driver["live"]["keys"], LinkedFileKind::Path);
        }
        let home = json(root["home"].as_str().unwrap_or_default());
        let mut names: BTreeMap<String, Vec<&'static str>> = BTreeMap::new();
        for list in SPOKEN_OF {
            for name in home[list].as_array().into_iter().flatten().filter_map(|thing| thing["name"].as_str()) {
                names.entry(name.to_lowercase()).or_default().push(list);
            }
        }
        LinkedFiles { files, kinds, names, even_shared: false }
    }

    fn text_of(&self, kind: LinkedFileKind) -> Option<(String, String)> {
        let (file, _) = self.kinds.iter().find(|(_, of)| *of == kind)?;
        Some((file.clone(), self.files.read(file).ok()?))
    }

    /// The uses of a name in a text, in order.
    fn mentions(&self, text: &str, of: LinkedFileKind, named: Named, name: &str) -> Vec<Mention> {
        // Sentences and paths may mean another thing of the name.
        let is_alone = named == Named::Resident || self.even_shared || self.others(named, name) == 0;
        match of {
            LinkedFileKind::Routine if named != Named::Sensor && is_alone => self.in_sentences(text, named, name),
            LinkedFileKind::Script if is_alone => {
                let quoted = format!("{name:?}");
                let found = text.match_indices(&quoted);
                found.map(|(at, _)| Mention { name: at..at + quoted.len(), whole: None }).collect()
            }
            LinkedFileKind::Path if named == Named::Sensor || named == Named::Resident || !is_alone => Vec::new(),
            LinkedFileKind::Routine | LinkedFileKind::Script => Vec::new(),
            of => {
                let all = entries(text);
                let mention = |entry: &Entry| {
                    let cut = match of {
                        LinkedFileKind::Logger => Some(entry.whole.clone()),
                        LinkedFileKind::Link if entry.path[0] == "sensors" => Some(entry.whole.clone()),
                        LinkedFileKind::Home if entry.is(&WAKER) => Some(entry.whole.clone()),
                        LinkedFileKind::Link | LinkedFileKind::Home => whole_of(&all, &entry.path[..2]),
                        _ => None,
                    };
                    Mention { name: entry.name_range(), whole: cut }
                };
                self.mentions_in_json(&all, of, named, name).into_iter().map(mention).collect()
            }
        }
    }

    /// Whether several things of a kind have the name, or another one has the new name.
    fn are_several(&self, named: Named, from: &str, to: &str) -> bool {
        let (kind, path) = match named {
            Named::Resident => (LinkedFileKind::Resident, &["name"][..]),
            named => (LinkedFileKind::Home, &[list_of(named), "*", "name"][..]),
        };
        let texts = self.kinds.iter().filter(|(_, of)| *of == kind).filter_map(|(file, _)| self.files.read(file).ok());
        let mut called_so = 0;
        let mut is_taken = false;
        for text in texts {
            for entry in entries(&text).iter().filter(|entry| entry.is(path)) {
                let name = entry.text().unwrap_or_default();
                let is_so = name.to_lowercase() == from.to_lowercase();
                called_so += usize::from(is_so);
                is_taken |= !is_so && name.to_lowercase() == to.to_lowercase();
            }
        }
        called_so > 1 || is_taken
    }

    /// The number of other things of the home with the name.
    fn others(&self, named: Named, name: &str) -> usize {
        let all = self.names.get(&name.to_lowercase()).map_or(&[][..], Vec::as_slice);
        all.len() - usize::from(all.contains(&list_of(named)))
    }

    fn mentions_in_json<'e>(&self, all: &'e [Entry], of: LinkedFileKind, named: Named, name: &str) -> Vec<&'e Entry> {
        let list = list_of(named);
        let says = |entry: &Entry| entry.text() == Some(name);
        let has = |list: &str| all.iter().any(|entry| entry.is(&[list, "*", "name"]) && says(entry));
        let is_it = |entry: &&Entry| match (of, named) {
            (LinkedFileKind::Logger, Named::Sensor) => entry.is(&["ids", "*"]) && entry.path[1] == name,
            (LinkedFileKind::Link, Named::Sensor) => {
                entry.is(&["sensors", "*"]) && entry.path[1] == name
                    || entry.is(&["faults", "*", "sensor"]) && says(entry)
            }
            (LinkedFileKind::Home, Named::Resident) => false,
            (LinkedFileKind::Home, named) => {
                // The name of a sensor's place means furniture or a door before a room.
                let on = match named {
                    Named::Furniture | Named::Door => true,
                    Named::Room => !has("furniture") && !has("doors"),
                    _ => false,
                };
                says(entry)
                    && (entry.is(&[list, "*", "name"])
                        || named == Named::Sensor && entry.is(&WAKER)
                        || on && entry.is(&["sensors", "*", "on"])
                        || named == Named::Room && entry.is(&["sensors", "*", "room"]))
            }
            (LinkedFileKind::Resident, Named::Resident) => entry.is(&["name"]) && says(entry),
            (LinkedFileKind::Path, _) => {
                says(entry) && !entry.path.iter().any(|part| part == "about" || part == "$schema")
            }
            _ => false,
        };
        all.iter().filter(is_it).collect()
    }

    /// The uses of a name in the sentences of a routine.
    fn in_sentences(&self, text: &str, named: Named, name: &str) -> Vec<Mention> {
        let mut found = Vec::new();
        let mut begin = 0;
        let sought = name.to_lowercase();
        let longer: Vec<&String> =
            self.names.keys().filter(|other| other.contains(&sought) && **other != sought).collect();
        for line in text.split_inclusive('\n') {
            let said = line.split('#').next().unwrap_or_default();
            let low = said.to_lowercase();
            // If lower case changes the length of a letter, places differ.
            let places: Vec<usize> = if low.len() == said.len() && !sought.is_empty() {
                low.match_indices(&sought).map(|(at, _)| at).collect()
            } else {
                Vec::new()
            };
            for at in places {
                let (before, after) = (&low[..at], &low[at + sought.len()..]);
                let is_word = !before.ends_with(char::is_alphanumeric) && !after.starts_with(char::is_alphanumeric);
                let last =
                    before.trim_end().rsplit(|letter: char| !letter.is_alphanumeric()).next().unwrap_or_default();
                let is_name = named == Named::Resident || sought.contains(' ') || ARTICLES.contains(&last);
                let is_part = longer.iter().any(|other| {
                    other
                        .match_indices(&sought)
                        .any(|(within, _)| at >= within && low[at - within..].starts_with(other.as_str()))
                });
                if is_word && is_name && !is_part {
                    let name = begin + at..begin + at + sought.len();
                    found
                        .push(Mention { name, whole: (named != Named::Resident).then_some(begin..begin + line.len()) });
                }
            }
            begin += line.len();
        }
        found
    }
}

/// The list of `home.json` with things of a kind.
fn list_of(named: Named) -> &'static str {
    match named {
        Named::Room => "rooms",
        Named::Door => "doors",
        Named::Furniture => "furniture",
        Named::Place => "places",
        Named::Sensor => "sensors",
        Named::Resident => "",
    }
}

fn sensor_name(all: &[Entry], index: &str) -> Option<String> {
    let name = all.iter().find(|entry| entry.is(&["sensors", "*", "name"]) && entry.path[1] == index);
    name.and_then(Entry::text).map(str::to_owned)
}

/// The sensor of an entry of a file that refers to sensors of the home, and the range of that reference.
fn sensor_of(all: &[Entry], entry: &Entry, kind: LinkedFileKind) -> Option<(String, Range<usize>)> {
    if kind == LinkedFileKind::Home {
        return entry.is(&WAKER).then(|| Some((entry.text()?.to_owned(), entry.whole.clone())))?;
    }
    let by_key = if kind == LinkedFileKind::Logger { "ids" } else { "sensors" };
    if entry.is(&[by_key, "*"]) {
        return Some((entry.path[1].clone(), entry.whole.clone()));
    }
    let is_fault = kind == LinkedFileKind::Link && entry.is(&["faults", "*", "sensor"]);
    is_fault.then(|| Some((entry.text()?.to_owned(), whole_of(all, &entry.path[..2])?)))?
}

fn whole_of(all: &[Entry], path: &[String]) -> Option<Range<usize>> {
    all.iter().find(|entry| entry.path == path).map(|entry| entry.whole.clone())
}

/// Whether it is the thing's own name in its own list.
fn is_own_name(text: &str, mention: &Mention) -> bool {
    let key = text[..mention.name.start].trim_end().trim_end_matches(':').trim_end();
    key.ends_with("\"name\"")
}

/// Writes a name in the case of the words that it replaces, as at the start of a sentence.
fn as_said(said: &str, to: &str) -> String {
    let is_capital = |text: &str| text.chars().next().is_some_and(char::is_uppercase);
    let mut letters = to.chars();
    match letters.next() {
        Some(first) if is_capital(said) => first.to_uppercase().chain(letters).collect(),
        _ => to.to_owned(),
    }
}
