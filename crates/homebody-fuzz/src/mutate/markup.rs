//! Plans of Sweet Home 3D: their XML, and its archive.

use super::{numbers, texts};
use crate::choices::Choices;
use std::io::{Cursor, Write};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

/// The plan with a tag more or fewer, a number moved a little or onto another, or an odd attribute.
pub fn markup(xml: &mut String, choices: &mut Choices) {
    for _ in 0..choices.size(4) {
        match choices.below(5) {
            0 => tags(xml, choices),
            1 if choices.is(0.1) => deeper(xml, choices),
            2 => attributes(xml, choices, |was, choices| texts::other(was, choices).replace('\'', "")),
            _ => attributes(xml, choices, number),
        }
    }
}

fn tags(xml: &mut String, choices: &mut Choices) {
    let mut parts: Vec<String> = xml.split('<').map(str::to_owned).collect();
    let (tag, place) = (choices.one(&parts).clone(), choices.below(parts.len()));
    match choices.below(4) {
        0 => drop(parts.remove(place)),
        1 => drop(parts.splice(place..place, (0..choices.size(super::times(tag.len(), 3_000))).map(|_| tag.clone()))),
        _ => parts.insert(place, tag),
    }
    *xml = parts.join("<");
}

/// Groups in groups, or entities in entities.
fn deeper(xml: &mut String, choices: &mut Choices) {
    if choices.is(0.5) {
        let depth = choices.size(20_000);
        let open = "<furnitureGroup name='a'>".repeat(depth);
        *xml = xml.replacen("</home>", &format!("{open}{}</home>", "</furnitureGroup>".repeat(depth)), 1);
        return;
    }
    let mut head = String::from("<!DOCTYPE home [<!ENTITY a0 'aaaaaaaaaa'>");
    for number in 1..choices.size(20) {
        head += &format!("<!ENTITY a{number} '{}'>", format!("&a{};", number - 1).repeat(10));
    }
    *xml = format!("{head}<!ENTITY f SYSTEM 'file:///etc/hostname'>]>{xml}").replacen("name='", "name='&a9;&f;", 1);
}

fn attributes(xml: &mut String, choices: &mut Choices, other: impl Fn(&str, &mut Choices) -> String) {
    // Every other part is between quotes.
    let mut parts: Vec<String> = xml.split('\'').map(str::to_owned).collect();
    let values = parts.len() / 2;
    if values == 0 {
        return;
    }
    let (at, from) = (2 * choices.below(values) + 1, 2 * choices.below(values) + 1);
    parts[at] = if choices.is(0.2) { parts[from].clone() } else { other(&parts[at], choices) };
    *xml = parts.join("'");
}

fn number(was: &str, choices: &mut Choices) -> String {
    let Ok(number) = was.parse::<f64>() else { return was.to_owned() };
    if choices.is(0.5) {
        return numbers::other(number, choices);
    }
    let step = choices.one(&[0.05, 0.2, 1.0, 10.0, 100.0]) * choices.one(&[1.0, -1.0]);
    (number + step).to_string()
}

/// An archive in the form of Sweet Home 3D, with this plan.
pub fn archive(xml: &[u8]) -> Vec<u8> {
    packed(&[("Home.xml", xml)], CompressionMethod::Deflated)
}

/// An archive with a deviation from that form.
pub fn odd_archive(xml: &[u8], choices: &mut Choices) -> Vec<u8> {
    let method = *choices.one(&[CompressionMethod::Stored, CompressionMethod::Deflated]);
    match choices.below(7) {
        0 => packed(&[("home.xml", xml)], method),
        1 => packed(&[("../Home.xml", xml), ("Home.xml", b"<home/>")], method),
        2 => packed(&[], method),
        3 if choices.is(0.1) => {
            packed(&[("Home.xml", &vec![b' '; choices.size(80 << 20)])], CompressionMethod::Deflated)
        }
        4 => {
            let names: Vec<String> = (0..choices.size(3_000)).map(|number| format!("{number}")).collect();
            let others = names.iter().map(|name| (name.as_str(), &b"a"[..]));
            packed(&others.chain([("Home.xml", xml)]).collect::<Vec<_>>(), method)
        }
        _ => packed(&[("Home.xml", xml), ("Home", b"\xac\xed\0\x05"), ("0", b"a")], method),
    }
}

fn packed(entries: &[(&str, &[u8])], method: CompressionMethod) -> Vec<u8> {
    let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
    let options = SimpleFileOptions::default().compression_method(method);
    for (name, bytes) in entries {
        writer.start_file(*name, options).expect("the names differ and are short");
        writer.write_all(bytes).expect("memory can be written");
    }
    writer.finish().expect("memory can be written").into_inner()
}
