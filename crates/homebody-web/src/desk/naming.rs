//! Names of things in all files of a scenario: where they stand, and what becomes of them when a thing is called otherwise or goes.
//!
//! In files of JSON a name counts where it leads to a thing; in routines where it stands as one, such as "in the armchair" and not
//! "to bed". Where another thing of the home has the same name, sentences may mean that one and are left as they are.

use super::Desk;
use super::entries::{Entry, entries, without};
use crate::wire::{Draft, Forget, MendView, MentionView, Named, NamesView, Rename};
use homebody_core::scenario::load::{Files, Overlay};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

/// Words before which a name stands as one.
const ARTICLES: [&str; 9] = ["the", "her", "his", "their", "its", "a", "an", "my", "your"];

/// The lists of `home.json` whose things sentences and paths may speak of.
const SPOKEN_OF: [&str; 4] = ["rooms", "doors", "furniture", "places"];

/// Where `home.json` names a sensor that wakes another.
const WAKER: [&str; 4] = ["sensors", "*", "woken_by", "*"];

/// A place where a name stands.
struct Mention {
    /// What is written otherwise: a JSON string with its quotes, or words.
    name: Range<usize>,
    /// What goes where the thing goes; nothing where that would leave no sense.
    whole: Option<Range<usize>>,
}

/// What kind of file it is, as the scenario links it.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Home,
    Logger,
    Link,
    Resident,
    Routine,
    Path,
    Script,
}

/// The scenario's files as far as they can be read.
struct Linked<'a> {
    files: &'a Overlay<'a>,
    kinds: Vec<(String, Kind)>,
    /// The names of the home's things that are spoken of, and in which lists each is.
    names: BTreeMap<String, Vec<&'static str>>,
    /// Whether sentences count that may mean another thing of the name.
    even_shared: bool,
}

impl Desk {
    /// A thing is called otherwise: all texts in which that changes something. None where another of its kind has one of both
    /// names, whatever the case of its letters: nobody could tell then which of them a sentence means.
    pub fn rename(&self, asked: Rename) -> NamesView {
        let Rename { draft, kind, from, to } = &asked;
        let files = self.with(draft.clone());
        let linked = Linked::of(&files, &self.shelf.entry);
        if linked.are_several(*kind, from, to) {
            return NamesView { is_shared: true, ..NamesView::default() };
        }
        let view = self.renamed(&asked, false);
        let is_shared = *kind != Named::Resident && linked.others(*kind, from) > 0;
        if !is_shared {
            return view;
        }
        // Sentences that may mean another thing of the name are left, unless they mean nothing then.
        let wrong = |texts: &BTreeMap<String, String>| {
            let mut draft = draft.clone();
            draft.texts.extend(texts.clone());
            self.check(draft).problems.len()
        };
        if wrong(&view.texts) > wrong(&BTreeMap::new()) { self.renamed(&asked, true) } else { view }
    }

    fn renamed(&self, Rename { draft, kind, from, to }: &Rename, even_shared: bool) -> NamesView {
        let files = self.with(draft.clone());
        let linked = Linked { even_shared, ..Linked::of(&files, &self.shelf.entry) };
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

    /// A thing goes: what speaks of it, and the texts without that. The thing itself stays in its file.
    pub fn forget(&self, Forget { draft, kind, names }: Forget) -> NamesView {
        let files = self.with(draft);
        let linked = Linked::of(&files, &self.shelf.entry);
        let mut view = NamesView::default();
        // A sensor that hangs on what goes goes as well, and so does what is said of that.
        let mut gone: Vec<(Named, String)> = names.into_iter().map(|name| (kind, name)).collect();
        if kind != Named::Sensor
            && let Some((_, text)) = linked.text_of(Kind::Home)
        {
            let all = entries(&text);
            for (_, name) in gone.clone() {
                let on = linked
                    .mentions_in_json(&all, Kind::Home, kind, &name)
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
                let own = |mention: &Mention| *of == Kind::Home && is_own_name(&text, mention);
                found.extend(linked.mentions(&text, *of, *kind, name).into_iter().filter(|mention| !own(mention)));
            }
            let cut: Vec<Range<usize>> = found.iter().filter_map(|mention| mention.whole.clone()).collect();
            let fresh = without(&text, &cut);
            view.add(file, &text, &found, fresh);
        }
        view
    }

    /// What is wrong and has one answer.
    pub fn mends(&self, draft: Draft) -> Vec<MendView> {
        let files = self.with(draft);
        let linked = Linked::of(&files, &self.shelf.entry);
        let Some((_, home)) = linked.text_of(Kind::Home) else { return Vec::new() };
        let home = entries(&home);
        let sensors: BTreeSet<&str> =
            home.iter().filter(|entry| entry.is(&["sensors", "*", "name"])).filter_map(Entry::text).collect();
        if home.is_empty() {
            return Vec::new();
        }
        let mut mends = Vec::new();
        for (kind, one, many) in [
            (Kind::Home, "wake-up by", "wake-ups by"),
            (Kind::Logger, "id of", "ids of"),
            (Kind::Link, "line about", "lines about"),
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

impl<'a> Linked<'a> {
    fn of(files: &'a Overlay<'a>, entry: &str) -> Linked<'a> {
        let json = |name: &str| {
            files.read(name).ok().and_then(|text| serde_json::from_str::<Value>(&text).ok()).unwrap_or_default()
        };
        let root = json(entry);
        let mut kinds: Vec<(String, Kind)> = Vec::new();
        let mut add = |name: &Value, kind: Kind| {
            if let Some(name) = name.as_str().filter(|name| kinds.iter().all(|(known, _)| known != name)) {
                kinds.push((name.to_owned(), kind));
            }
        };
        add(&root["home"], Kind::Home);
        add(&root["logger"], Kind::Logger);
        add(&root["link"], Kind::Link);
        for file in root["residents"].as_array().into_iter().flatten() {
            add(file, Kind::Resident);
            let driver = &json(file.as_str().unwrap_or_default())["driver"];
            add(&driver["routine"], Kind::Routine);
            add(&driver["path"], Kind::Path);
            add(&driver["script"], Kind::Script);
            add(&driver["live"]["keys"], Kind::Path);
        }
        let home = json(root["home"].as_str().unwrap_or_default());
        let mut names: BTreeMap<String, Vec<&'static str>> = BTreeMap::new();
        for list in SPOKEN_OF {
            for name in home[list].as_array().into_iter().flatten().filter_map(|thing| thing["name"].as_str()) {
                names.entry(name.to_lowercase()).or_default().push(list);
            }
        }
        Linked { files, kinds, names, even_shared: false }
    }

    /// The first file of a kind.
    fn text_of(&self, kind: Kind) -> Option<(String, String)> {
        let (file, _) = self.kinds.iter().find(|(_, of)| *of == kind)?;
        Some((file.clone(), self.files.read(file).ok()?))
    }

    /// Where a thing is named in a text, in order.
    fn mentions(&self, text: &str, of: Kind, named: Named, name: &str) -> Vec<Mention> {
        // Of several things of a name sentences and paths may mean another.
        let is_alone = named == Named::Resident || self.even_shared || self.others(named, name) == 0;
        match of {
            Kind::Routine if named != Named::Sensor && is_alone => self.in_sentences(text, named, name),
            Kind::Script if is_alone => {
                let quoted = format!("{name:?}");
                let found = text.match_indices(&quoted);
                found.map(|(at, _)| Mention { name: at..at + quoted.len(), whole: None }).collect()
            }
            Kind::Path if named == Named::Sensor || named == Named::Resident || !is_alone => Vec::new(),
            Kind::Routine | Kind::Script => Vec::new(),
            of => {
                let all = entries(text);
                let mention = |entry: &Entry| {
                    let cut = match of {
                        Kind::Logger => Some(entry.whole.clone()),
                        Kind::Link if entry.path[0] == "sensors" => Some(entry.whole.clone()),
                        Kind::Home if entry.is(&WAKER) => Some(entry.whole.clone()),
                        Kind::Link | Kind::Home => whole_of(&all, &entry.path[..2]),
                        _ => None,
                    };
                    Mention { name: entry.name_range(), whole: cut }
                };
                self.mentions_in_json(&all, of, named, name).into_iter().map(mention).collect()
            }
        }
    }

    /// Whether several of a kind are called so, or another one has the new name.
    fn are_several(&self, named: Named, from: &str, to: &str) -> bool {
        let (kind, path) = match named {
            Named::Resident => (Kind::Resident, &["name"][..]),
            named => (Kind::Home, &[list_of(named), "*", "name"][..]),
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

    /// How many other things of the home have the name of one.
    fn others(&self, named: Named, name: &str) -> usize {
        let all = self.names.get(&name.to_lowercase()).map_or(&[][..], Vec::as_slice);
        all.len() - usize::from(all.contains(&list_of(named)))
    }

    /// The entries of a file of JSON that name the thing.
    fn mentions_in_json<'e>(&self, all: &'e [Entry], of: Kind, named: Named, name: &str) -> Vec<&'e Entry> {
        let list = list_of(named);
        let says = |entry: &Entry| entry.text() == Some(name);
        let has = |list: &str| all.iter().any(|entry| entry.is(&[list, "*", "name"]) && says(entry));
        let is_it = |entry: &&Entry| match (of, named) {
            (Kind::Logger, Named::Sensor) => entry.is(&["ids", "*"]) && entry.path[1] == name,
            (Kind::Link, Named::Sensor) => {
                entry.is(&["sensors", "*"]) && entry.path[1] == name
                    || entry.is(&["faults", "*", "sensor"]) && says(entry)
            }
            (Kind::Home, Named::Resident) => false,
            (Kind::Home, named) => {
                // What a sensor hangs on is a piece or a door before it is a room.
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
            (Kind::Resident, Named::Resident) => entry.is(&["name"]) && says(entry),
            (Kind::Path, _) => says(entry) && !entry.path.iter().any(|part| part == "about" || part == "$schema"),
            _ => false,
        };
        all.iter().filter(is_it).collect()
    }

    /// Where a routine's sentences have the name as one.
    fn in_sentences(&self, text: &str, named: Named, name: &str) -> Vec<Mention> {
        let mut found = Vec::new();
        let mut begin = 0;
        let sought = name.to_lowercase();
        let longer: Vec<&String> =
            self.names.keys().filter(|other| other.contains(&sought) && **other != sought).collect();
        for line in text.split_inclusive('\n') {
            let said = line.split('#').next().unwrap_or_default();
            let low = said.to_lowercase();
            // Where letters are of another length in small, places are not the same.
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

/// The list of `home.json` that things of a kind are in.
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

/// The name of the sensor of an index of the home's list.
fn sensor_name(all: &[Entry], index: &str) -> Option<String> {
    let name = all.iter().find(|entry| entry.is(&["sensors", "*", "name"]) && entry.path[1] == index);
    name.and_then(Entry::text).map(str::to_owned)
}

/// Which sensor an entry of a file is about that names sensors of the home's list, and all that is said there.
fn sensor_of(all: &[Entry], entry: &Entry, kind: Kind) -> Option<(String, Range<usize>)> {
    if kind == Kind::Home {
        return entry.is(&WAKER).then(|| Some((entry.text()?.to_owned(), entry.whole.clone())))?;
    }
    let by_key = if kind == Kind::Logger { "ids" } else { "sensors" };
    if entry.is(&[by_key, "*"]) {
        return Some((entry.path[1].clone(), entry.whole.clone()));
    }
    let is_fault = kind == Kind::Link && entry.is(&["faults", "*", "sensor"]);
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

/// A name in the letters of the one that stood there: a sentence that began with it still begins so.
fn as_said(said: &str, to: &str) -> String {
    let is_capital = |text: &str| text.chars().next().is_some_and(char::is_uppercase);
    let mut letters = to.chars();
    match letters.next() {
        Some(first) if is_capital(said) => first.to_uppercase().chain(letters).collect(),
        _ => to.to_owned(),
    }
}
