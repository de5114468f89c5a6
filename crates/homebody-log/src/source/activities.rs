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

/// Puts together what a log notes apart: that an activity begins, and that it ends.
#[derive(Default)]
pub(crate) struct Notes {
    /// Those that have begun.
    open: Vec<(String, Micros)>,
}

impl Notes {
    /// A note; gives the activity that it ends. What ends without having begun is passed over, and what begins
    /// again before it has ended goes on.
    pub fn take(&mut self, name: &str, begins: bool, at: Micros) -> Option<Activity> {
        let known = self.open.iter().position(|(open, _)| open == name);
        match known {
            None if begins => self.open.push((name.into(), at)),
            Some(index) if !begins => {
                let (name, begin) = self.open.swap_remove(index);
                return Some(Activity { name, begin, end: at });
            }
            _ => {}
        }
        None
    }
}
