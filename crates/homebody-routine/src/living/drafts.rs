//! What is to be done on a day, some of it beside something else: before it, after it, with it.

use super::item::Item;
use super::life::Life;
use super::usual;
use crate::routine::{Activity, Meal};
use homebody_core::time::{Micros, SECOND, micros};

const MINUTE: f64 = 60.0;
const HOUR: f64 = 3600.0;

/// An item whose start may hang on another's.
pub struct Draft {
    pub item: Item,
    pub start: Start,
}

/// What a start hangs on.
#[derive(Clone, Debug, PartialEq)]
pub enum Start {
    Known,
    At(Micros),
    After(Activity, Micros),
    Before(Activity, Micros),
    With(Activity),
    /// The end of the draft of this index.
    Then(usize),
}

/// The drafts of a day.
pub struct Drafts<'a> {
    pub life: &'a Life,
    pub day: i32,
    pub up: Micros,
    pub bed: Micros,
    pub list: Vec<Draft>,
}

/// Drafts whose starts are all known.
pub struct Resolved {
    pub items: Vec<Item>,
    /// What interrupts: what a visitor helps with, and what is soon done while a meal is cooked.
    pub breaks: Vec<Item>,
    /// What is done after getting up, by key: washing, dressing.
    pub mornings: Vec<String>,
}

/// Longest time that cooking takes in addition, for the ways between stove, sink and fridge (our choice).
const TO_AND_FRO: Micros = 4 * 60 * SECOND;

/// Longest activity that may be done while food is on the stove (our choice).
pub const SOON_DONE: Micros = 3 * 60 * SECOND;

/// Time after a visitor's planned arrival at which an activity with their help begins (our choice).
const WELCOMED: Micros = 3 * 60 * SECOND;

impl Drafts<'_> {
    /// Puts what hangs on something beside it.
    pub fn resolve(mut self) -> Resolved {
        self.tie();
        self.settle(&|_| false);
        self.come_home();
        self.cook_before_eating();
        // What hangs on a meal goes with it.
        self.settle(&|activity| matches!(activity, Activity::Prepare(_) | Activity::Eat(_)));
        let mornings = self.list.iter().filter(|draft| matches!(draft.start, Start::After(Activity::GetUp, _)));
        let mornings = mornings.map(|draft| draft.item.key.clone()).collect();
        let is_done = |activity: &Activity| self.list.iter().any(|draft| draft.item.activity == *activity);
        // There is nothing to wash up after a meal that was skipped.
        let is_idle = |draft: &Draft| match &draft.start {
            Start::After(meal, _) => draft.item.activity == Activity::WashUp && !is_done(meal),
            _ => false,
        };
        // Whoever helps is there first.
        let is_helped = |draft: &&Draft| draft.start == Start::With(Activity::Visit) && draft.item.visitor.is_none();
        let helped = self.list.iter().filter(is_helped).map(|draft| {
            let start = draft.item.start + WELCOMED;
            Item { start, latest: start + 3600 * SECOND, ..draft.item.clone() }
        });
        let breaks_in = |draft: &&Draft| self.breaks_into_cooking(draft);
        // The meal is later by what breaks into the cooking, and by the ways there.
        let while_cooking = self.list.iter().filter(breaks_in).map(|draft| {
            let start = draft.item.start + draft.item.lasts + TO_AND_FRO / 2;
            Item { start, ..draft.item.clone() }
        });
        let breaks = helped.chain(while_cooking).collect();
        let items = self.list.iter().filter(|draft| !is_idle(draft) && !is_helped(draft) && !breaks_in(draft));
        Resolved { breaks, items: items.map(|draft| draft.item.clone()).collect(), mornings }
    }

    /// What is said to come with or after something makes that as firm as it is itself, and what comes after it waits
    /// for its end.
    fn tie(&mut self) {
        for index in 0..self.list.len() {
            let gap = match self.list[index].start {
                Start::After(_, gap) => Some(gap),
                Start::Then(_) => Some(0),
                _ => None,
            };
            let Some(anchor) = self.anchor(index) else { continue };
            let is_before = matches!(self.list[index].start, Start::Before(..));
            let of = self.list[anchor].item.of;
            if !self.list[index].item.is_unsaid && !is_before {
                let cooked = match self.list[anchor].item.activity {
                    Activity::Eat(meal) => Some(Activity::Prepare(meal)),
                    _ => None,
                };
                let is_for_it = |item: &Item| item.of == of || Some(&item.activity) == cooked.as_ref();
                let firm = self.list.iter_mut().map(|draft| &mut draft.item).filter(|item| is_for_it(item));
                firm.for_each(|item| item.waits = false);
            }
            self.list[index].item.follows = of.zip(gap);
        }
    }

    /// The draft that another hangs on.
    fn anchor(&self, index: usize) -> Option<usize> {
        let of = |wanted: &Activity| {
            let is_it = |draft: &Draft| draft.item.activity == *wanted && draft.item.visitor.is_none();
            self.list.iter().position(is_it).filter(|of| *of != index)
        };
        match &self.list[index].start {
            Start::After(Activity::ComeHome, _) => of(&Activity::Leave),
            Start::After(activity, _) | Start::Before(activity, _) | Start::With(activity) => of(activity),
            Start::Then(of) => Some(*of),
            Start::Known | Start::At(_) => None,
        }
    }

    /// Finds the starts of all that hang on others, but of those that are settled before.
    fn settle(&mut self, is_settled: &dyn Fn(&Activity) -> bool) {
        let is_known = |draft: &Draft| matches!(draft.start, Start::Known) || is_settled(&draft.item.activity);
        let mut known: Vec<bool> = self.list.iter().map(is_known).collect();
        // Each pass settles at least one, or none is left that can be.
        for last in (0..=self.list.len()).rev() {
            for index in 0..self.list.len() {
                if !known[index]
                    && let Some(start) = self.start_of(index, &known, last == 0)
                {
                    let item = &mut self.list[index].item;
                    (item.start, item.latest) = (start, start + micros(4.0 * HOUR));
                    known[index] = true;
                }
            }
            if known.iter().all(|&known| known) {
                break;
            }
        }
    }

    /// What is eaten is prepared first; which of the two moves is the one that is not said.
    fn cook_before_eating(&mut self) {
        for meal in Meal::ALL {
            let of = |activity: Activity| {
                self.list.iter().position(|draft| draft.item.activity == activity && draft.item.visitor.is_none())
            };
            let (Some(cook), Some(eat)) = (of(Activity::Prepare(meal)), of(Activity::Eat(meal))) else { continue };
            let (cooking, eating) = (self.list[cook].item.clone(), self.list[eat].item.clone());
            let ready = cooking.start + cooking.lasts;
            if cooking.is_unsaid && !eating.is_unsaid {
                let start = (eating.start - cooking.lasts - TO_AND_FRO).max(self.up);
                let item = &mut self.list[cook].item;
                (item.start, item.latest, item.is_unsaid, item.waits) = (start, eating.latest, false, false);
                let late = start + cooking.lasts + TO_AND_FRO - eating.start;
                if late > 0 {
                    self.list[eat].item.start += late;
                }
            } else if eating.start < ready && eating.is_unsaid {
                let item = &mut self.list[eat].item;
                item.latest += ready - item.start;
                (item.start, item.is_unsaid, item.waits) = (ready, cooking.is_unsaid, cooking.waits);
            }
        }
    }

    /// Whether something is to be done so shortly before a meal that it falls into the cooking, and is soon done.
    fn breaks_into_cooking(&self, draft: &Draft) -> bool {
        let (Start::Before(Activity::Eat(meal), _), Item { start, lasts, visitor: None, .. }) =
            (&draft.start, &draft.item)
        else {
            return false;
        };
        let is_cooking = |other: &Draft| {
            let cook = &other.item;
            let over = cook.start + cook.lasts + TO_AND_FRO;
            cook.activity == Activity::Prepare(*meal) && cook.visitor.is_none() && (cook.start..over).contains(start)
        };
        *lasts <= SOON_DONE && self.list.iter().any(is_cooking)
    }

    /// Coming home at a time ends the outing before it.
    fn come_home(&mut self) {
        let homes = self.list.iter().filter(|draft| draft.item.activity == Activity::ComeHome);
        let homes: Vec<Micros> = homes.map(|draft| draft.item.start).collect();
        for home in homes {
            let outings = self.list.iter_mut().map(|draft| &mut draft.item);
            let outings = outings.filter(|item| item.activity == Activity::Leave && item.start < home);
            if let Some(outing) = outings.max_by_key(|item| item.start) {
                outing.until = Some(home);
            }
        }
        // It is in the outing.
        self.list.iter_mut().filter(|draft| draft.item.activity == Activity::ComeHome).for_each(|draft| {
            draft.item.latest = Micros::MIN;
        });
    }

    /// The start of a draft whose reference is known; `at_last` it is guessed where the reference is never.
    fn start_of(&self, index: usize, known: &[bool], at_last: bool) -> Option<Micros> {
        let Draft { item, start } = &self.list[index];
        let span = |activity: &Activity| self.span_of(activity, known, at_last);
        match start {
            Start::Known => Some(item.start),
            Start::At(start) => Some(*start),
            Start::After(activity, gap) => Some(span(activity)?.1 + gap),
            Start::Before(activity, gap) => Some(span(activity)?.0 - gap - item.lasts),
            // One microsecond before, so that it comes first.
            Start::With(activity) => Some(span(activity)?.0 - 1),
            Start::Then(of) => {
                let of_item = &self.list[*of].item;
                known[*of].then_some(of_item.start + of_item.lasts)
            }
        }
    }

    /// From when to when something is done today; where it is not done, when it usually would be.
    fn span_of(&self, activity: &Activity, known: &[bool], at_last: bool) -> Option<(Micros, Micros)> {
        match activity {
            Activity::GetUp => return Some((self.up, self.up + 60 * SECOND)),
            Activity::GoToBed => return Some((self.bed, self.bed + 60 * SECOND)),
            Activity::ComeHome => return Some((0, self.span_of(&Activity::Leave, known, at_last)?.1)),
            _ => {}
        }
        let mut of = self.list.iter().zip(known).filter(|(draft, _)| draft.item.activity == *activity);
        match of.next() {
            Some((draft, true)) => Some((draft.item.start, draft.item.start + draft.item.lasts)),
            Some((_, false)) if !at_last => None,
            _ => {
                let usual = usual::clock(activity, &self.life.numbers).map_or(12.0 * HOUR, |clock| clock.mean());
                let start = self.life.instant(self.day, usual);
                Some((start, start + micros(usual::length(activity, &self.life.numbers).median_min * MINUTE)))
            }
        }
    }
}
