//! Live input: times that run forward, keys that are held once, things that are there.

use super::{HomeInCheck, ProblemReport};
use crate::drivers::input::InputFile;
use crate::nearest::nearest;
use crate::problem::{Advice, MOST_PER_FILE, Problem};
use crate::scenario::source::JsonSource;

crate::messages! {
    /// Problems with files of held keys.
    pub enum InputMessage in "input" {
        /// The changes of the held keys follow each other in time.
        Backward { before_s: f64, after_s: f64 }
            error "backward-time" ("time runs backward, from {before_s} s to {after_s} s")
            hint ("put the changes in order of time");
        /// The list of held keys names each key once.
        HeldTwice error "held-twice" ("the list of held keys names this key twice")
            hint ("remove one of them");
        /// A resident uses doors, pieces of furniture and the lamps of rooms, by the names in `home.json`.
        UnknownThing { thing: String, nearest: Option<String> }
            error "unknown-thing" ("this home has no {thing:?} that a resident could use")
            advice (Some(match nearest {
                Some(near) => Advice::meant(near),
                None => "name a door, a piece of furniture or a room".into(),
            }));
    }
}

pub fn check(source: &JsonSource, file: &InputFile, surroundings: &HomeInCheck, problems: &mut Vec<Problem>) {
    let report = &mut ProblemReport { source, problems };
    for (index, pair) in file.keys.windows(2).enumerate() {
        let (before_s, after_s) = (pair[0].at_s, pair[1].at_s);
        if after_s < before_s {
            report.add(&format!("/keys/{}/at_s", index + 1), InputMessage::Backward { before_s, after_s });
        }
    }
    for (index, change) in file.keys.iter().enumerate() {
        for (second, key) in change.held.iter().enumerate() {
            if change.held[..second].contains(key) {
                report.add(&format!("/keys/{index}/held/{second}"), InputMessage::HeldTwice);
            }
        }
        let Some(plan) = surroundings.plan else { continue };
        for (number, used) in change.uses.iter().enumerate() {
            if plan.thing(&used.thing).is_none() {
                let things = plan.things.iter().map(|thing| thing.name.as_str());
                let near = if report.count() < MOST_PER_FILE { nearest(&used.thing, things) } else { None };
                let (thing, nearest) = (used.thing.clone(), near.map(str::to_owned));
                let message = InputMessage::UnknownThing { thing, nearest };
                report.add(&format!("/keys/{index}/uses/{number}/thing"), message);
            }
        }
    }
}
