//! The XML of a plan as a tree, after a check of the features that plans use.
//!
//! The parser counts nodes and refuses custom entities. It compares all attributes of a tag with each other, and all
//! namespaces in scope with those of each tag, so these are bounded before.

use crate::error::ImportError;
use roxmltree::{Document, ParsingOptions};

/// Largest number of tags, comments and the like (our choice): a large house has some ten thousand.
const MOST_NODES: usize = 1_000_000;

/// Largest number of all attributes together (our choice).
const MOST_ATTRIBUTES: usize = 4_000_000;

/// Largest number of attributes of one tag (our choice): pieces of furniture have some fifty.
const MOST_ATTRIBUTES_OF_ONE: usize = 256;

/// Largest depth of groups within groups (our choice): plans have a handful.
const GREATEST_DEPTH: usize = 100;

pub fn parse(text: &str) -> Result<Document<'_>, ImportError> {
    look_over(text)?;
    let options = ParsingOptions { allow_dtd: false, nodes_limit: MOST_NODES as u32, ..ParsingOptions::default() };
    Document::parse_with_options(text, options).map_err(|error| ImportError::Disorder(error.to_string()))
}

/// Refuses features that no plan uses. Invalid XML is left to the parser.
fn look_over(text: &str) -> Result<(), ImportError> {
    let count = |wanted: u8| text.bytes().filter(|&byte| byte == wanted).count();
    if count(b'<') > MOST_NODES || count(b'=') > MOST_ATTRIBUTES {
        return Err(ImportError::ManyParts);
    }
    let (mut rest, mut depth) = (text, 0_usize);
    while let Some(at) = rest.find('<') {
        rest = &rest[at..];
        let end = if rest.starts_with("<!--") {
            after(rest, "<!--", "-->")
        } else if rest.starts_with("<![CDATA[") {
            after(rest, "<![CDATA[", "]]>")
        } else if rest.starts_with("<?") {
            after(rest, "<?", "?>")
        } else if rest.starts_with("<!") {
            return Err(ImportError::DocumentType);
        } else {
            let Some(tag) = tag(rest) else { return Ok(()) };
            if tag.attributes > MOST_ATTRIBUTES_OF_ONE {
                return Err(ImportError::ManyAttributes);
            }
            if tag.has_namespace {
                return Err(ImportError::Namespace);
            }
            match tag.kind {
                TagKind::Open => depth += 1,
                TagKind::Close => depth = depth.saturating_sub(1),
                TagKind::Empty => {}
            }
            if depth > GREATEST_DEPTH {
                return Err(ImportError::Nested { most: GREATEST_DEPTH });
            }
            Some(tag.length)
        };
        let Some(end) = end else { return Ok(()) };
        rest = &rest[end..];
    }
    Ok(())
}

/// The position after an item that begins with one mark and ends with another. The marks share no character: in
/// `<!-->`, the comment has only begun.
fn after(text: &str, begin: &str, end: &str) -> Option<usize> {
    text[begin.len()..].find(end).map(|at| begin.len() + at + end.len())
}

struct Tag {
    kind: TagKind,
    length: usize,
    attributes: usize,
    has_namespace: bool,
}

enum TagKind {
    Open,
    Close,
    Empty,
}

fn tag(text: &str) -> Option<Tag> {
    let (mut attributes, mut has_namespace, mut quote) = (0, false, None);
    let bytes = text.as_bytes();
    for (at, &byte) in bytes.iter().enumerate() {
        match (quote, byte) {
            (Some(open), _) if byte == open => quote = None,
            (Some(_), _) => {}
            (None, b'"' | b'\'') => quote = Some(byte),
            (None, b'=') => attributes += 1,
            (None, b'x') => has_namespace |= bytes[at..].starts_with(b"xmlns"),
            (None, b'>') => {
                let kind = match () {
                    () if text.starts_with("</") => TagKind::Close,
                    () if text[..at].ends_with('/') => TagKind::Empty,
                    () => TagKind::Open,
                };
                return Some(Tag { kind, length: at + 1, attributes, has_namespace });
            }
            _ => {}
        }
    }
    None
}
