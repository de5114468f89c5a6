//! Files of other forms than Sweet Home 3D: names each by its first bytes, with a command for it.

use crate::error::ImportError;

/// Number of bytes at the beginning that decide the form (our choice).
const LOOKED_AT: usize = 64 << 10;

/// The command for a picture in a form that the command reads.
const PICTURE: &str = "homebody new my-home --image plan.png --known X,Y=EAST,NORTH --known X,Y=EAST,NORTH takes images, with two \
     points in pixels and in metres; homebody serve my-home then draws over it. Where you have a log of its sensors, add --from-log LOG";

/// The command for a picture in a form that only the page reads.
const IN_PAGE: &str = "homebody serve takes images in PNG, JPEG and SVG: \"New home\", from an image, and draw over it";

/// The command for a picture in another form.
const AS_PICTURE: &str = "save it as an image in PNG; homebody new my-home --image plan.png, or \"New home\" in homebody serve, takes \
     that to draw over";

/// The command for a building or a plan of another program.
const OTHER_PROGRAM: &str = "draw the plan in Sweet Home 3D and name the .sh3d file, or save it as an image in PNG, which homebody new \
     my-home --image plan.png takes to draw over in the page";

/// The command for a home of this program.
const OWN: &str =
    "it needs no import: put it into the folder of a scenario, and name that folder: homebody check FOLDER";

const PACKED: &str = "unpack it, and name the .sh3d file or the Home.xml that is in it";

const SIGNS: [(&[u8], &str, &str); 14] = [
    (b"\x89PNG\r\n\x1a\n", "an image in PNG", PICTURE),
    (b"\xff\xd8\xff", "an image in JPEG", PICTURE),
    (b"GIF8", "an image in GIF", AS_PICTURE),
    (b"BM", "an image in BMP", AS_PICTURE),
    (b"II*\0", "an image in TIFF", AS_PICTURE),
    (b"MM\0*", "an image in TIFF", AS_PICTURE),
    (b"%PDF-", "a PDF", AS_PICTURE),
    (b"%!PS", "a page in PostScript", AS_PICTURE),
    (b"AC10", "a drawing of AutoCAD (DWG)", OTHER_PROGRAM),
    (b"AutoCAD Binary DXF", "a drawing in DXF", OTHER_PROGRAM),
    (b"glTF", "a model in glTF", OTHER_PROGRAM),
    (b"\x1f\x8b", "packed with gzip", PACKED),
    (b"7z\xbc\xaf\x27\x1c", "packed with 7-Zip", PACKED),
    (b"Rar!", "packed with RAR", PACKED),
];

pub fn refused(bytes: &[u8]) -> ImportError {
    let looked_at = &bytes[..bytes.len().min(LOOKED_AT)];
    let found = SIGNS.iter().find(|(sign, ..)| looked_at.starts_with(sign));
    let by_sign = found.map(|(_, form, hint)| (*form, *hint));
    match by_sign.or_else(|| container_form(looked_at)).or_else(|| text_form(&String::from_utf8_lossy(looked_at))) {
        Some((form, hint)) => ImportError::OtherForm { form, hint },
        None => ImportError::NoArchive,
    }
}

/// The error for an archive without `Home.xml`, by the names of its entries.
pub fn archive_error(names: impl Iterator<Item = String>) -> ImportError {
    let form = |name: String| {
        let name = name.to_lowercase();
        let ends = |end: &str| name.ends_with(end);
        match () {
            () if [".sh3d", ".sh3x"].iter().any(|end| ends(end)) => {
                Some(("an archive with a plan of Sweet Home 3D in it", PACKED))
            }
            () if ends("catalog.properties") || ends("catalog.json") => {
                Some(("a catalogue of furniture of Sweet Home 3D, which has no plan", OTHER_PROGRAM))
            }
            () if ends(".usdc") || ends(".usda") => Some(("a scan in USDZ", OTHER_PROGRAM)),
            () if ends(".ifc") || ends(".ifcxml") => Some(("a building in IFC, packed", OTHER_PROGRAM)),
            () if [".png", ".jpg", ".jpeg"].iter().any(|end| ends(end)) => {
                Some(("an archive of images", PACKED_PICTURES))
            }
            () => None,
        }
    };
    match names.filter_map(form).next() {
        Some((form, hint)) => ImportError::OtherForm { form, hint },
        None => ImportError::NoHomeXml,
    }
}

/// The command for pictures that are packed.
const PACKED_PICTURES: &str =
    "unpack it; homebody new my-home --image plan.png takes an image to draw over in the page";

/// Forms with their name behind the first bytes.
fn container_form(bytes: &[u8]) -> Option<(&'static str, &'static str)> {
    match (bytes.get(..4)?, bytes.get(4..8)?, bytes.get(8..12)?) {
        (b"RIFF", _, b"WEBP") => Some(("an image in WebP", AS_PICTURE)),
        (_, b"ftyp", b"heic" | b"heix" | b"mif1" | b"avif") => Some(("an image in HEIC or AVIF", AS_PICTURE)),
        _ => None,
    }
}

fn text_form(text: &str) -> Option<(&'static str, &'static str)> {
    let text = text.trim_start_matches('\u{feff}').trim_start();
    let is_markup = text.starts_with('<');
    match text {
        _ if is_markup && has_tag(text, "svg") => Some((svg_form(text), IN_PAGE)),
        _ if text.starts_with("ISO-10303-21") => Some(("a building in IFC", OTHER_PROGRAM)),
        _ if is_markup && text.contains("ifcXML") => Some(("a building in IFC", OTHER_PROGRAM)),
        _ if is_markup && text.contains("gbxml") => Some(("a building in gbXML", OTHER_PROGRAM)),
        _ if is_markup && text.contains("CityGML") => Some(("a building in CityGML", OTHER_PROGRAM)),
        _ if is_markup && has_tag(text, "html") => Some(("a page in HTML", AS_PICTURE)),
        _ if is_dxf(text) => Some(("a drawing in DXF", OTHER_PROGRAM)),
        _ if text.starts_with(['{', '[']) => Some(json_form(text)),
        _ if is_yaml(text) => Some(yaml_form(text)),
        _ if text.starts_with("version https://git-lfs") => Some(("a pointer of Git LFS, not the file itself", LFS)),
        _ => None,
    }
}

/// The command that brings the file behind a pointer.
const LFS: &str = "fetch the file itself with: git lfs pull";

fn svg_form(text: &str) -> &'static str {
    /// Prefixes of entities of Home Assistant in a floor plan.
    const ENTITIES: [&str; 5] = ["binary_sensor.", "light.", "sensor.", "switch.", "area."];
    let has_entity = ENTITIES.iter().any(|entity| text.contains(&format!("id=\"{entity}")));
    match () {
        () if has_entity => "a floor plan of Home Assistant in SVG",
        () if text.contains("class=\"Wall") && text.contains("class=\"Space") => "a floor plan of CubiCasa in SVG",
        () => "an image in SVG",
    }
}

fn json_form(text: &str) -> (&'static str, &'static str) {
    let has = |keys: &[&str]| keys.iter().all(|key| text.contains(&format!("\"{key}\"")));
    match () {
        () if has(&["rooms", "outline"]) => ("a home of Homebody", OWN),
        () if has(&["asset", "meshes"]) => ("a model in glTF", OTHER_PROGRAM),
        () if has(&["type", "features"]) => ("a map in GeoJSON", OTHER_PROGRAM),
        () if ["walls", "rooms", "floorplan", "floors"].iter().any(|key| has(&[key])) => {
            ("a plan in JSON, in a form that is not read here", OTHER_PROGRAM)
        }
        () => ("data in JSON", OTHER_PROGRAM),
    }
}

fn yaml_form(text: &str) -> (&'static str, &'static str) {
    let has = |key: &str| text.lines().any(|line| line.trim_start_matches([' ', '-']).starts_with(key));
    if has("floors:") && has("rooms:") || has("rooms:") && has("points:") {
        return ("a floor plan of ESPresense in YAML", OTHER_PROGRAM);
    }
    ("settings in YAML", OTHER_PROGRAM)
}

fn has_tag(text: &str, name: &str) -> bool {
    let lower = text.get(..text.len().min(4_096)).unwrap_or(text).to_lowercase();
    lower.match_indices(&format!("<{name}")).any(|(at, begin)| {
        let next = lower[at + begin.len()..].chars().next();
        next.is_none_or(|next| next.is_whitespace() || next == '>' || next == '/')
    })
}

/// True if lines are pairs of a number and a value.
fn is_dxf(text: &str) -> bool {
    let mut lines = text.lines().map(str::trim);
    matches!((lines.next(), lines.next()), (Some("0"), Some("SECTION")) | (Some("999"), Some(_)))
}

/// True if the first line with content is a key, or a list item with one.
fn is_yaml(text: &str) -> bool {
    let said =
        text.lines().map(str::trim_end).find(|line| !line.is_empty() && !line.starts_with('#') && *line != "---");
    said.is_some_and(|line| {
        let key = line
            .trim_start_matches("- ")
            .split_once(':')
            .filter(|(_, value)| value.is_empty() || value.starts_with(' '));
        key.is_some_and(|(key, _)| !key.is_empty() && key.chars().all(|c| c.is_alphanumeric() || "_- ".contains(c)))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn form(bytes: &[u8]) -> &'static str {
        match refused(bytes) {
            ImportError::OtherForm { form, .. } => form,
            error => panic!("{error}"),
        }
    }

    #[test]
    fn names_each_form_by_its_first_bytes() {
        for (bytes, named) in [
            (&b"\x89PNG\r\n\x1a\n\0\0"[..], "an image in PNG"),
            (b"\xff\xd8\xff\xe0", "an image in JPEG"),
            (b"RIFF\0\0\0\0WEBPVP8 ", "an image in WebP"),
            (b"%PDF-1.7", "a PDF"),
            (b"AC1032\0", "a drawing of AutoCAD (DWG)"),
            (b"  0\r\nSECTION\r\n  2\r\nHEADER\r\n", "a drawing in DXF"),
            (b"ISO-10303-21;\nHEADER;", "a building in IFC"),
            (b"<?xml version='1.0'?>\n<!-- a plan -->\n<svg width='9'><rect/></svg>", "an image in SVG"),
            (b"<svg><path id=\"binary_sensor.hall\"/></svg>", "a floor plan of Home Assistant in SVG"),
            (b"<svg><g class=\"Wall External\"/><g class=\"Space Bath\"/></svg>", "a floor plan of CubiCasa in SVG"),
            (
                b"# my home\nfloors:\n  - id: ground\n    rooms:\n      - name: Hall\n",
                "a floor plan of ESPresense in YAML",
            ),
            (b"{ \"name\": \"x\", \"rooms\": [{ \"outline\": [] }] }", "a home of Homebody"),
            (b"{ \"floorplan\": { \"walls\": [] } }", "a plan in JSON, in a form that is not read here"),
        ] {
            assert_eq!(form(bytes), named);
        }
    }

    #[test]
    fn leaves_unknown_forms_unnamed() {
        for bytes in [&b""[..], b"PK", b"<home/>", b"a line of words", &[0; 100], b"<svgs/>", b"http://a"] {
            assert_eq!(refused(bytes), ImportError::NoArchive, "{}", String::from_utf8_lossy(bytes));
        }
    }

    #[test]
    fn names_archives_by_their_entries() {
        let named = |names: &[&'static str]| archive_error(names.iter().map(|name| (*name).to_owned())).to_string();
        assert!(named(&["a.txt", "mine.sh3d"]).contains("a plan of Sweet Home 3D in it\n  hint: unpack it"));
        assert!(named(&["PluginFurnitureCatalog.properties"]).contains("has no plan"));
        assert_eq!(archive_error(["a.txt".to_owned()].into_iter()), ImportError::NoHomeXml);
    }
}
