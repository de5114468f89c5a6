//! Names as parts of topics and as ids: letters, digits, `_` and `-` only, and different names stay different.
//!
//! A space becomes `_`. A character other than an ASCII letter or digit gets a `-` before it, so that the original can be read back: `--`
//! for `-`, `-_` for `_`, and `-e9-` for the letter é, by its number.

use sha2::{Digest, Sha256};

/// Levels below a home that are not sensors (see `place.rs`). A sensor of such a name has its first letter by its number.
const TAKEN: [&str; 5] = ["bridge", "command", "run", "running", "status"];

/// Length of a name above which it is cut and ends in a digest (our choice): a topic has at most 65,535 bytes.
const LONGEST_BYTES: usize = 200;

pub(crate) fn level(name: &str) -> String {
    let mut level = String::with_capacity(name.len());
    let is_taken = TAKEN.contains(&name);
    for (index, letter) in name.chars().enumerate() {
        match letter {
            letter if letter.is_ascii_alphanumeric() && !(is_taken && index == 0) => level.push(letter),
            ' ' => level.push('_'),
            '-' => level.push_str("--"),
            '_' => level.push_str("-_"),
            letter => level.push_str(&format!("-{:x}-", u32::from(letter))),
        }
    }
    if level.is_empty() {
        // No name has this form: after a `-` come only hexadecimal digits.
        return "-none".into();
    }
    if level.len() > LONGEST_BYTES {
        let digest = Sha256::digest(name.as_bytes());
        level.truncate(LONGEST_BYTES - 40);
        level.push_str("-h");
        digest.iter().take(16).for_each(|byte| level.push_str(&format!("{byte:02x}")));
    }
    level
}

/// The id of a home below a prefix, `studio-in-homebody`: no two prefixes and homes have the same.
pub(crate) fn id_of_home(prefix: &str, home: &str) -> String {
    below(prefix).fold(level(home), |id, level| format!("{id}-in-{level}"))
}

/// The ending of the ids of all homes below a prefix.
pub(crate) fn end_of_ids(prefix: &str) -> String {
    below(prefix).map(|level| format!("-in-{level}")).collect()
}

/// The levels of a prefix, the innermost first, as ids have them.
fn below(prefix: &str) -> impl Iterator<Item = String> {
    prefix.rsplit('/').map(level)
}

pub(crate) fn is_level(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_' || byte == b'-')
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn usual_names_stay_readable() {
        assert_eq!(level("bedroom motion"), "bedroom_motion");
        assert_eq!(level("MainEntryway"), "MainEntryway");
        assert_eq!(level("hall-door"), "hall--door");
        assert_eq!(level("caf\u{e9}"), "caf-e9-");
        assert_eq!(level("command"), "-63-ommand");
        assert_eq!(id_of_home("homebody", "my studio"), "my_studio-in-homebody");
        assert_eq!(id_of_home("care/north", "studio"), "studio-in-north-in-care");
        assert!(id_of_home("care/north", "studio").ends_with(&end_of_ids("care")));
    }

    /// 200 names, most of them made to get out: no topic has a part that MQTT reads as anything but text, and no two are one.
    #[test]
    fn two_hundred_names_stay_inside_and_apart() {
        let bad = "+,#,/,\0,$SYS,..,-,_, ,\u{e9},\u{1f600},a,A,1,--,-2f-,\n".split(',');
        let mut names: BTreeSet<String> = TAKEN.map(String::from).into();
        names.extend(["".into(), "x".repeat(300), "x".repeat(301), "x".repeat(70_000), "\u{e9}".repeat(100)]);
        for first in bad.clone() {
            for second in bad.clone() {
                names.insert(format!("{first}{second}"));
                names.insert(format!("{first} {second}/"));
            }
        }
        let names: Vec<String> = names.into_iter().take(200).collect();
        assert_eq!(names.len(), 200);
        let levels: BTreeSet<String> = names.iter().map(|name| level(name)).collect();
        assert_eq!(levels.len(), names.len(), "two names became one");
        for level in &levels {
            assert!(is_level(level) && level.len() <= LONGEST_BYTES, "{level:?}");
            assert!(!TAKEN.contains(&level.as_str()), "{level:?}");
        }
        // The control: to replace what is wrong by one letter makes several of them one.
        let plain = |name: &String| name.replace(|letter: char| !letter.is_ascii_alphanumeric(), "_");
        assert!(names.iter().map(plain).collect::<BTreeSet<_>>().len() < names.len());
    }

    #[test]
    fn homes_below_prefixes_have_ids_of_their_own() {
        let (prefixes, homes) = (["a", "a/b", "b", "a-in-b", "a_b", "b/a"], ["a", "b", "a b", "b/a", "a-in-b", "in"]);
        let ids: BTreeSet<_> = prefixes.iter().flat_map(|prefix| homes.map(|home| id_of_home(prefix, home))).collect();
        assert_eq!(ids.len(), prefixes.len() * homes.len());
    }
}
