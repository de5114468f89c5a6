//! Live input: times that run forward, keys that are held once.

use super::Report;
use crate::problem::Problem;
use crate::scenario::input::InputFile;
use crate::scenario::source::Source;

pub fn check(source: &Source, file: &InputFile, problems: &mut Vec<Problem>) {
    let report = &mut Report { source, problems };
    for (index, pair) in file.keys.windows(2).enumerate() {
        let (before, after) = (pair[0].at_s, pair[1].at_s);
        if after < before {
            let what = format!("time runs backward, from {before} s to {after} s");
            report.hinted(&format!("/keys/{}/at_s", index + 1), what, "put the changes in order of time");
        }
    }
    for (index, change) in file.keys.iter().enumerate() {
        for (second, key) in change.held.iter().enumerate() {
            if change.held[..second].contains(key) {
                report.add(&format!("/keys/{index}/held/{second}"), "this key is held twice");
            }
        }
    }
}
