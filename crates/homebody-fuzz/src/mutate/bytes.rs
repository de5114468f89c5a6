//! Any bytes: flipped, cut, moved, repeated.

use crate::choices::Choices;

/// Bytes with a meaning in formats, apart from the `|` between them. The last are é, marks of direction and of a line's end, an emoji,
/// and an accent.
const MARKS: &[u8] = b"{|}|[|]|,|:|\"|'|-|.|e|\\|\n|\r\n|\r|\t| |\0|#|;|=|<|>|&|/|//|/*|..|null|true|\xff|\xc3\x28|\xed\xa0\x80|\xef\xbb\xbf\
    |\x1b[31m|\xc3\xa9|\xe2\x80\xae|\xe2\x80\xa8|\xf0\x9f\x91\xb4|\xcc\x81";

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
        3 => {
            let marks: Vec<&[u8]> = MARKS.split(|&byte| byte == b'|').collect();
            bytes.splice(at..at, choices.one(&marks).iter().copied());
        }
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
            if let Some(digit) = (at..bytes.len()).find(|&at| bytes[at].is_ascii_digit()) {
                bytes[digit] = *choices.one(b"0123456789-.e");
            }
        }
    }
}
