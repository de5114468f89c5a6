//! Live input: times that run forward, keys that are held once, things that are there.

use super::{Report, Surroundings};
use crate::problem::{MOST_PER_FILE, Problem};
use crate::scenario::input::InputFile;
use crate::scenario::nearest::nearest;
use crate::scenario::source::Source;

pub fn check(source: &Source, file: &InputFile, surroundings: &Surroundings, problems: &mut Vec<Problem>) {
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
        let Some(plan) = surroundings.plan else { continue };
        for (number, used) in change.uses.iter().enumerate() {
            if plan.thing(&used.thing).is_none() {
                let things = plan.things.iter().map(|thing| thing.name.as_str());
                let near = if report.count() < MOST_PER_FILE { nearest(&used.thing, things) } else { None };
                let hint = match near {
                    Some(near) => format!("did you mean {near:?}?"),
                    None => "name a door, a piece of furniture or a room".into(),
                };
                let what = format!("there is no {:?} to use in this home", used.thing);
                report.hinted(&format!("/keys/{index}/uses/{number}/thing"), what, hint);
            }
        }
    }
}
