//! Any bytes: flipped, cut, moved, repeated.

use crate::choices::Choices;

/// Bytes with a meaning in formats.
const MARKS: [&[u8]; 40] = [
    b"{",
    b"}",
    b"[",
    b"]",
    b",",
    b":",
    b"\"",
    b"'",
    b"-",
    b".",
    b"e",
    b"\\",
    b"\n",
    b"\r\n",
    b"\r",
    b"\t",
    b" ",
    b"\0",
    b"#",
    b";",
    b"=",
    b"<",
    b">",
    b"&",
    b"/",
    b"//",
    b"/*",
    b"..",
    b"null",
    b"true",
    b"\xff",
    b"\xc3\x28",
    b"\xed\xa0\x80",
    b"\xef\xbb\xbf",
    b"\x1b[31m",
    "é".as_bytes(),
    "\u{202e}".as_bytes(),
    "\u{2028}".as_bytes(),
    "\u{1f474}".as_bytes(),
    "\u{0301}".as_bytes(),
];

/// Largest length of a mutant in bytes: other tests measure readers with large files.
const LONGEST: usize = 2 << 20;

pub fn bytes(bytes: &mut Vec<u8>, other: &[u8], choices: &mut Choices) {
    for _ in 0..choices.size(4) {
        once(bytes, other, choices);
    }
    bytes.truncate(LONGEST);
}

fn once(bytes: &mut Vec<u8>, other: &[u8], choices: &mut Choices) {
    let at = choices.below(bytes.len());
    let part = choices.part(bytes.len());
    match choices.below(9) {
        0 if !bytes.is_empty() => bytes[at] = choices.below(256) as u8,
        1 if !bytes.is_empty() => bytes[at] ^= 1 << choices.below(8),
        2 => drop(bytes.drain(part)),
        3 => drop(bytes.splice(at..at, choices.one(&MARKS).iter().copied())),
        4 => {
            let copy = bytes[part].to_vec();
            bytes.splice(at..at, copy);
        }
        5 => {
            let more = &other[choices.part(other.len())];
            bytes.splice(part, more.iter().copied());
        }
        6 => {
            // Half of each.
            bytes.truncate(at);
            bytes.extend_from_slice(&other[choices.below(other.len() + 1)..]);
        }
        7 if choices.is(0.2) => {
            let times = choices.size(LONGEST / (part.len() + 1));
            let many = bytes[part].repeat(times);
            bytes.splice(at..at, many);
        }
        8 if choices.is(0.2) => bytes.truncate(at),
        _ => {
            if let Some(digit) = digit_from(bytes, at) {
                bytes[digit] = *choices.one(b"0123456789-.e");
            }
        }
    }
}

fn digit_from(bytes: &[u8], at: usize) -> Option<usize> {
    (at..bytes.len()).find(|&at| bytes[at].is_ascii_digit())
}
