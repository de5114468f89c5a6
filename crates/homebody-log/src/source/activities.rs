//! What somebody did when, and the notes of a log that tell it.

use homebody_core::time::Micros;

/// What somebody did over a span; the end is no part of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Activity {
    /// Its label, such as `sleeping`; of a span in a room, the room's name.
    pub name: String,
    /// From when, in microseconds: of a log since 1970 on its clock, of a truth since the run's start.
    pub begin: Micros,
    /// Until when.
    pub end: Micros,
}

/// Puts together what a log notes apart: that an activity begins, and that it ends; or that each row is of one.
#[derive(Default)]
pub(crate) struct Notes {
    /// Those that have begun.
    open: Vec<(String, Micros)>,
    /// That of the rows that have come last.
    label: Option<(String, Micros)>,
    /// Notes whose other end is not there.
    pub alone: u64,
}

/// So many activities go on at once at most (ours): more notes than that are of no use to anybody.
const MOST_OPEN: usize = 1000;

impl Notes {
    /// A note; gives the activity that it ends. What ends without having begun is passed over, and what begins
    /// again before it has ended goes on.
    pub fn take(&mut self, name: &str, begins: bool, at: Micros) -> Option<Activity> {
        let known = self.open.iter().position(|(open, _)| open == name);
        match known {
            None if begins && self.open.len() < MOST_OPEN => self.open.push((name.into(), at)),
            Some(index) if !begins => {
                let (name, begin) = self.open.swap_remove(index);
                return Some(Activity { name, begin, end: at.max(begin) });
            }
            _ => self.alone += 1,
        }
        None
    }

    /// The label of a row, if it has one; gives the activity that was that of the rows before it.
    pub fn label(&mut self, name: Option<&str>, at: Micros) -> Option<Activity> {
        match (&self.label, name) {
            (None, None) => return None,
            (Some((known, _)), Some(name)) if known == name => return None,
            _ => {}
        }
        let before = self.label.take();
        self.label = name.map(|name| (name.to_owned(), at));
        // A row is an instant: of one that is alone at its own there would be nothing left.
        before.map(|(name, begin)| Activity { name, begin, end: at.max(begin + 1) })
    }

    /// What still goes on after the last row: the activity of its label. What else has begun has no end.
    pub fn end(&mut self, last: Micros) -> Option<Activity> {
        self.alone += self.open.len() as u64;
        self.open.clear();
        self.label(None, last + 1)
    }
}
