//! The notes of a log from which activities follow.

use homebody_core::time::{Interval, Span, WallTime};
use homebody_timeline::Episode;

/// Puts together what a log notes apart: that an activity begins, and that it ends; or that each row is of one.
#[derive(Default)]
pub(crate) struct ActivityNotes {
    /// Those that have begun.
    open: Vec<OpenActivity>,
    /// That of the rows that have come last.
    label: Option<(String, WallTime)>,
    /// Notes whose other end is not there.
    pub alone: u64,
}

/// Largest number of activities at once (our choice).
const MOST_OPEN: usize = 1000;

/// An activity that has begun.
struct OpenActivity {
    name: String,
    begin: WallTime,
    /// Whether it has begun once more meanwhile, so that two ends may come.
    is_doubled: bool,
    /// Its first end, of one that has begun twice.
    end: Option<WallTime>,
}

impl ActivityNotes {
    /// A note; gives the activity that it ends, or that is over by it. An end without a beginning is
    /// passed over. An activity that begins twice lasts to its second end, if that comes before it begins anew.
    pub fn take(&mut self, name: &str, begins: bool, at: WallTime) -> Option<Episode<WallTime>> {
        let known = self.open.iter().position(|open| open.name == name);
        match (known, begins) {
            (None, true) if self.open.len() < MOST_OPEN => self.begin(name, at),
            (Some(index), true) => match self.open[index].end {
                None => {
                    self.open[index].is_doubled = true;
                    self.alone += 1;
                }
                Some(end) => {
                    let over = self.open.swap_remove(index);
                    self.begin(name, at);
                    return Some(over.until(end));
                }
            },
            (Some(index), false) if self.open[index].is_doubled && self.open[index].end.is_none() => {
                self.open[index].end = Some(at);
            }
            (Some(index), false) => {
                let over = self.open.swap_remove(index);
                // The note that it began once more has its other end by now.
                self.alone -= u64::from(over.is_doubled);
                return Some(over.until(at));
            }
            (None, _) => self.alone += 1,
        }
        None
    }

    fn begin(&mut self, name: &str, begin: WallTime) {
        self.open.push(OpenActivity { name: name.into(), begin, is_doubled: false, end: None });
    }

    /// Whether any note or label has come that is not over.
    pub fn has_any(&self) -> bool {
        self.alone > 0 || self.label.is_some() || !self.open.is_empty()
    }

    /// The label of a row, if it has one; gives the activity that was that of the rows before it.
    pub fn label(&mut self, name: Option<&str>, at: WallTime) -> Option<Episode<WallTime>> {
        match (&self.label, name) {
            (None, None) => return None,
            (Some((known, _)), Some(name)) if known == name => return None,
            _ => {}
        }
        let before = self.label.take();
        self.label = name.map(|name| (name.to_owned(), at));
        // A row is an instant: of one that is alone at its own there would be nothing left.
        before.map(|(name, begin)| Episode::new(name, Interval::new(begin, at.max(begin + Span::MICROSECOND))))
    }

    /// The activities that the last row ends: that of its label, and those that lack a second end. All others that have
    /// begun have no end.
    pub fn end(&mut self, last: WallTime) -> Vec<Episode<WallTime>> {
        let mut over = Vec::new();
        for open in std::mem::take(&mut self.open) {
            match open.end {
                Some(end) => over.push(open.until(end)),
                None => self.alone += 1,
            }
        }
        over.extend(self.label(None, last + Span::MICROSECOND));
        over
    }
}

impl OpenActivity {
    fn until(self, end: WallTime) -> Episode<WallTime> {
        Episode::new(self.name, Interval::new(self.begin, end.max(self.begin)))
    }
}
