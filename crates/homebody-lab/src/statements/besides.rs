//! The measures of what a statement says besides its time: a key, a night, the work of a visitor, a thing that is on.

use super::field::{FieldResult, LifeView, MINUTE, minutes};
use super::habit::{DrawnDetail, DrawnHabit};
use super::judge::Occasion;
use crate::claims::{Occurrence, Subject};
use homebody_core::time::{Interval, Span};

/// Least share of an activity in which the thing is on (our choice): it is turned on and off within the activity.
const MEANWHILE: f64 = 0.8;

impl DrawnHabit {
    pub fn besides(&self, view: &LifeView, occasions: &[Occasion]) -> Option<FieldResult> {
        let held = occasions.iter().filter(|of| of.chance > 0.0).filter_map(|of| self.meant(of));
        let (field, what) = match self.besides {
            DrawnDetail::Nothing => return None,
            DrawnDetail::Key => ("key", "the host is not at the door"),
            DrawnDetail::Overnight => ("night", "the visitor is there at three in the morning"),
            DrawnDetail::Work(..) => ("work", "the visitor does it"),
            DrawnDetail::Help(..) => ("help", "the host does it during the visit"),
            DrawnDetail::Meanwhile(..) => ("meanwhile", "it is on for four fifths of the time"),
        };
        let cases: Vec<(bool, String)> =
            held.map(|one| (self.has_detail(view, one), view.clock(one.time.begin))).collect();
        FieldResult::most(field, what, &cases)
    }

    fn has_detail(&self, view: &LifeView, one: &Occurrence) -> bool {
        let overlap = |who: usize, subject: Subject| {
            view.life.spans(who, &subject).iter().map(|of| of.time.overlap(one.time)).sum::<Span>()
        };
        let visitor = || view.life.body(Some(&format!("{}'s {}", view.person, self.visitor?)), view.who);
        match self.besides {
            DrawnDetail::Nothing => true,
            DrawnDetail::Key => {
                let coming = Interval::new(one.time.begin - MINUTE, one.time.begin + MINUTE);
                view.life.time_at(view.who, "front door", coming) == Span::ZERO
            }
            DrawnDetail::Overnight => one.time.contains(view.at(view.life.day_of(one.time.begin) + 1, 180.0)),
            DrawnDetail::Work(_, label) => {
                visitor().is_some_and(|body| overlap(body, Subject::Activity(label.to_owned())) > Span::ZERO)
            }
            DrawnDetail::Help(_, label) => overlap(view.who, Subject::Activity(label.to_owned())) > Span::ZERO,
            DrawnDetail::Meanwhile(_, thing) => {
                let on = overlap(view.who, Subject::Thing(thing.to_owned()));
                minutes(on) >= MEANWHILE * minutes(one.time.length())
            }
        }
    }
}
