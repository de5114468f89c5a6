//! The activities of a day before their times are settled, some relative to others: before, after, with.

use super::defaults;
use super::item::{Following, Follows, Item};
use super::resident_routine::ResidentRoutine;
use crate::routine::{Activity, HabitTime, Meal};
use homebody_core::fuzzy::Fuzzy;
use homebody_core::time::{HOUR, Interval, MINUTE, RunTime, Span};

const MINUTE_S: f64 = 60.0;
const HOUR_S: f64 = 3600.0;

/// An activity whose start may depend on another's.
pub struct ItemDraft {
    pub item: Item,
    pub start: ItemStart,
    /// Delay of a relative start by changes.
    pub later: Span,
    /// Not done, but others keep their time after it: a meal whose preparation has stopped is still eaten.
    pub is_left_out: bool,
}

#[derive(Clone, Debug, PartialEq)]
pub enum ItemStart {
    Known,
    At(RunTime),
    After(Activity, Span),
    Before(Activity, Span),
    With(Activity),
    /// At the end of the draft with this index.
    Then(usize),
}

impl ItemStart {
    /// The start of a habit that refers to another activity, or to the habit before it.
    pub(super) fn relative(when: &HabitTime, share: f64, before: Option<&ItemStart>) -> Option<ItemStart> {
        let gap = |gap: &Option<Fuzzy>| Span::from_seconds(gap.map_or(0.0, |gap| gap.at(share)));
        Some(match when {
            HabitTime::After(activity, by) => Self::After(activity.clone(), gap(by)),
            HabitTime::Before(activity, by) => Self::Before(activity.clone(), gap(by)),
            HabitTime::With(activity) => Self::With(activity.clone()),
            HabitTime::Then => before?.clone(),
            HabitTime::AnyTime | HabitTime::At(_) | HabitTime::Within(_) => return None,
        })
    }
}

pub struct Drafts<'a> {
    pub life: &'a ResidentRoutine,
    pub day: i32,
    pub up: RunTime,
    pub bed: RunTime,
    pub list: Vec<ItemDraft>,
    /// A bedtime relative to an activity, and its delay by changes.
    pub bedtime: Option<(ItemStart, Span)>,
}

pub struct Resolved {
    pub items: Vec<Item>,
    /// Interrupting activities: help of visitors, and short activities during cooking.
    pub breaks: Vec<Item>,
    /// Keys of the activities after rising, such as washing and dressing.
    pub mornings: Vec<String>,
    /// A bedtime relative to an activity of the day.
    pub bedtime: Option<(RunTime, Option<Follows>)>,
}

/// Longest time that cooking takes in addition, for the ways between stove, sink and fridge (our choice).
pub(super) const TO_AND_FRO: Span = MINUTE.times(4);

/// Longest activity that may be done while food is on the stove (our choice).
pub const SOON_DONE: Span = MINUTE.times(3);

/// Time after a visitor's planned arrival at which an activity with their help begins (our choice).
pub(super) const WELCOMED: Span = MINUTE.times(3);

impl Drafts<'_> {
    pub fn resolve(mut self) -> Resolved {
        self.leave_uneaten_meals();
        self.tie();
        self.resolve_starts(&|_| false);
        self.come_home();
        self.cook_before_eating();
        // Activities relative to a meal move with it.
        self.resolve_starts(&|activity| matches!(activity, Activity::Prepare(_) | Activity::Eat(_)));
        self.eat_out();
        let bedtime = self.bedtime();
        self.list.retain(|draft| !draft.is_left_out);
        let mornings = self.list.iter().filter(|draft| matches!(draft.start, ItemStart::After(Activity::GetUp, _)));
        let mornings = mornings.map(|draft| draft.item.key.clone()).collect();
        let is_done = |activity: &Activity| self.list.iter().any(|draft| draft.item.activity == *activity);
        // A skipped meal needs no washing up.
        let is_idle = |draft: &ItemDraft| match &draft.start {
            ItemStart::After(meal, _) => draft.item.activity == Activity::WashUp && !is_done(meal),
            _ => false,
        };
        // The helper is there first.
        let is_helped =
            |draft: &&ItemDraft| draft.start == ItemStart::With(Activity::Visit) && draft.item.visitor.is_none();
        let helped = self.list.iter().filter(is_helped).map(|draft| {
            let start = draft.item.start + WELCOMED;
            Item { start, latest: start + HOUR, ..draft.item.clone() }
        });
        let breaks_in = |draft: &&ItemDraft| self.breaks_into_cooking(draft);
        // Interruptions of the cooking delay the meal by their length and the walks.
        let while_cooking = self.list.iter().filter(breaks_in).map(|draft| {
            let start = draft.item.start + draft.item.lasts + TO_AND_FRO / 2;
            Item { start, ..draft.item.clone() }
        });
        let breaks = helped.chain(while_cooking).collect();
        let items = self.list.iter().filter(|draft| !is_idle(draft) && !is_helped(draft) && !breaks_in(draft));
        Resolved { breaks, items: items.map(|draft| draft.item.clone()).collect(), mornings, bedtime }
    }

    /// A meal that is not eaten today is not prepared.
    fn leave_uneaten_meals(&mut self) {
        for meal in Meal::ALL {
            let is_own =
                |draft: &ItemDraft, activity: Activity| draft.item.activity == activity && draft.item.visitor.is_none();
            if !self.list.iter().any(|draft| is_own(draft, Activity::Eat(meal))) {
                let cooking = self.list.iter_mut().filter(|draft| is_own(draft, Activity::Prepare(meal)));
                cooking.for_each(|draft| draft.is_left_out = true);
            }
        }
    }

    /// An activity with or after another inherits its firmness, and later ones wait for it.
    fn tie(&mut self) {
        for index in 0..self.list.len() {
            let Some(anchor) = self.anchor(index) else { continue };
            let Item { of, ref activity, .. } = self.list[anchor].item;
            let cooked = match *activity {
                Activity::Eat(meal) => Some(Activity::Prepare(meal)),
                _ => None,
            };
            let is_same_meal = activity.of_same_meal().as_ref() == Some(&self.list[index].item.activity);
            let draft = &mut self.list[index];
            // A change of a meal has moved its preparation.
            draft.later = if is_same_meal { Span::ZERO } else { draft.later };
            let later = draft.later;
            let how = match &draft.start {
                ItemStart::After(_, gap) => Some(Following::After(*gap + later)),
                ItemStart::Then(_) => Some(Following::After(later)),
                ItemStart::With(of) if of.leaves_hands_free() && draft.item.activity.is_done_meanwhile() => {
                    Some(Following::Meanwhile)
                }
                ItemStart::With(_) if later == Span::ZERO => Some(Following::With),
                _ => None,
            };
            let how = how.filter(|how| !matches!(how, Following::After(gap) if *gap < Span::ZERO));
            let is_before = matches!(draft.start, ItemStart::Before(..));
            if !draft.item.is_unsaid && !is_before {
                let is_for_it = |item: &Item| item.of == of || Some(&item.activity) == cooked.as_ref();
                let firm = self.list.iter_mut().map(|draft| &mut draft.item).filter(|item| is_for_it(item));
                firm.for_each(|item| item.waits = false);
            }
            let follows = of.zip(how).map(|(of, how)| Follows { of, how });
            self.list[index].item.follows = follows.filter(|_| !self.list[anchor].is_left_out);
        }
    }

    /// The draft that another depends on.
    fn anchor(&self, index: usize) -> Option<usize> {
        let of = |wanted: &Activity| {
            let is_it = |draft: &ItemDraft| draft.item.activity == *wanted && draft.item.visitor.is_none();
            self.list.iter().position(is_it).filter(|of| *of != index)
        };
        match &self.list[index].start {
            ItemStart::After(Activity::ComeHome, _) => of(&Activity::Leave),
            ItemStart::After(activity, _) | ItemStart::Before(activity, _) | ItemStart::With(activity) => of(activity),
            ItemStart::Then(of) => Some(*of),
            ItemStart::Known | ItemStart::At(_) => None,
        }
    }

    /// Settles the starts of drafts that depend on others, except those settled before.
    fn resolve_starts(&mut self, is_settled: &dyn Fn(&Activity) -> bool) {
        let is_known = |draft: &ItemDraft| matches!(draft.start, ItemStart::Known) || is_settled(&draft.item.activity);
        let mut known: Vec<bool> = self.list.iter().map(is_known).collect();
        // Each pass settles at least one draft.
        for last in (0..=self.list.len()).rev() {
            for index in 0..self.list.len() {
                if !known[index]
                    && let Some(start) = self.start_of(index, &known, last == 0)
                {
                    let item = &mut self.list[index].item;
                    (item.start, item.latest) = (start, start + Span::from_seconds(4.0 * HOUR_S));
                    known[index] = true;
                }
            }
            if known.iter().all(|&known| known) {
                break;
            }
        }
        self.await_meals();
    }

    /// Marks the meals that stated activities come before.
    fn await_meals(&mut self) {
        let stated = self.list.iter().filter(|draft| !draft.item.is_unsaid && !draft.is_left_out);
        let meals: Vec<Meal> = stated
            .filter_map(|draft| match draft.start {
                ItemStart::Before(Activity::Eat(meal), _) => Some(meal),
                _ => None,
            })
            .collect();
        let is_it =
            |of: &Activity| meals.iter().any(|&meal| [Activity::Prepare(meal), Activity::Eat(meal)].contains(of));
        let items = self.list.iter_mut().map(|draft| &mut draft.item);
        items.filter(|item| item.visitor.is_none() && is_it(&item.activity)).for_each(|item| item.is_awaited = true);
    }

    /// A meal is prepared before it is eaten, and eaten soon after; of the two, the unstated one moves.
    fn cook_before_eating(&mut self) {
        for meal in Meal::ALL {
            let of = |activity: Activity| {
                self.list.iter().position(|draft| draft.item.activity == activity && draft.item.visitor.is_none())
            };
            let (Some(cook), Some(eat)) = (of(Activity::Prepare(meal)), of(Activity::Eat(meal))) else { continue };
            if self.list[cook].is_left_out {
                continue;
            }
            let (cooking, eating) = (self.list[cook].item.clone(), self.list[eat].item.clone());
            let ready = cooking.start + cooking.lasts;
            let just_before = (eating.start - cooking.lasts - TO_AND_FRO).max(self.up);
            if cooking.is_unsaid && !eating.is_unsaid {
                let item = &mut self.list[cook].item;
                (item.start, item.latest, item.is_unsaid, item.waits) = (just_before, eating.latest, false, false);
                let late = just_before + cooking.lasts + TO_AND_FRO - eating.start;
                if late > Span::ZERO {
                    self.list[eat].item.start += late;
                }
            } else if eating.is_unsaid && (eating.start < ready || !cooking.is_unsaid) {
                let item = &mut self.list[eat].item;
                item.latest += ready - item.start;
                (item.start, item.is_unsaid, item.waits) = (ready, cooking.is_unsaid, cooking.waits);
            } else if cooking.is_unsaid && ready < just_before {
                let item = &mut self.list[cook].item;
                (item.start, item.latest) = (just_before, item.latest + (just_before - item.start));
            }
            let how = if eating.is_unsaid { Following::After(Span::ZERO) } else { Following::NotBefore };
            let follows = cooking.of.map(|of| Follows { of, how });
            let item = &mut self.list[eat].item;
            item.follows = item.follows.or(follows);
        }
    }

    /// A meal in the time of an outing with a meal is eaten there. Activities that wait for it keep their time.
    fn eat_out(&mut self) {
        let end = |item: &Item| item.until.unwrap_or(item.start + item.lasts);
        let outings = self.list.iter().map(|draft| &draft.item).filter(|item| item.eats_out);
        let outings: Vec<Interval<RunTime>> = outings.map(|item| Interval::new(item.start, end(item))).collect();
        let is_there = |item: &Item| {
            let meal = Interval::new(item.start, end(item));
            outings.iter().any(|outing| outing.overlap(meal) > Span::ZERO)
        };
        for meal in Meal::ALL {
            let of = [Activity::Eat(meal), Activity::Prepare(meal)];
            let is_own = |item: &Item| item.visitor.is_none() && of.contains(&item.activity);
            let is_eaten = |draft: &&ItemDraft| draft.item.activity == of[0] && is_own(&draft.item);
            if !self.list.iter().filter(is_eaten).any(|draft| is_there(&draft.item)) {
                continue;
            }
            let mut left_out = Vec::new();
            for draft in self.list.iter_mut().filter(|draft| is_own(&draft.item)) {
                draft.is_left_out = true;
                left_out.push(draft.item.of);
            }
            for draft in &mut self.list {
                draft.item.follows = draft.item.follows.filter(|follows| !left_out.contains(&Some(follows.of)));
            }
        }
    }

    fn is_prepared(&self, meal: Meal) -> bool {
        let is_cooking = |draft: &ItemDraft| {
            draft.item.activity == Activity::Prepare(meal) && draft.item.visitor.is_none() && !draft.is_left_out
        };
        self.list.iter().any(is_cooking)
    }

    /// The bedtime relative to the last time that its activity is done today; `None` if that is not done.
    fn bedtime(&self) -> Option<(RunTime, Option<Follows>)> {
        let (start, later) = self.bedtime.as_ref()?;
        let last = |wanted: &Activity| {
            let of = if *wanted == Activity::ComeHome { &Activity::Leave } else { wanted };
            let done = self.list.iter().filter(|draft| draft.item.activity == *of && !draft.is_left_out);
            done.max_by_key(|draft| draft.item.start)
        };
        let end = |item: &Item| item.until.unwrap_or(item.start + item.lasts);
        let (anchor, gap) = match start {
            ItemStart::At(at) => return Some((*at + *later, None)),
            ItemStart::After(Activity::GetUp, gap) => return Some((self.up + *gap + *later, None)),
            ItemStart::After(activity, gap) => (last(activity)?, *gap + *later),
            ItemStart::Then(index) => (&self.list[*index], *later),
            ItemStart::Before(activity, gap) => return Some((last(activity)?.item.start - *gap + *later, None)),
            ItemStart::With(activity) => return Some((last(activity)?.item.start + *later, None)),
            ItemStart::Known => return None,
        };
        let follows = anchor.item.of.filter(|_| gap >= Span::ZERO).map(|of| Follows { of, how: Following::After(gap) });
        Some((end(&anchor.item) + gap, follows))
    }

    /// A short activity shortly before a meal falls into the cooking.
    fn breaks_into_cooking(&self, draft: &ItemDraft) -> bool {
        let (ItemStart::Before(Activity::Eat(meal), _), Item { start, lasts, visitor: None, .. }) =
            (&draft.start, &draft.item)
        else {
            return false;
        };
        let is_cooking = |other: &ItemDraft| {
            let cook = &other.item;
            let over = cook.start + cook.lasts + TO_AND_FRO;
            cook.activity == Activity::Prepare(*meal) && cook.visitor.is_none() && (cook.start..over).contains(start)
        };
        *lasts <= SOON_DONE && self.list.iter().any(is_cooking)
    }

    /// A stated time of coming home ends the outing before it.
    fn come_home(&mut self) {
        let homes = self.list.iter().filter(|draft| draft.item.activity == Activity::ComeHome);
        let homes: Vec<_> = homes.map(|draft| (draft.item.start, draft.item.of)).collect();
        for (home, of) in homes {
            let outings = self.list.iter_mut().map(|draft| &mut draft.item);
            let outings = outings.filter(|item| item.activity == Activity::Leave && item.start < home);
            if let Some(outing) = outings.max_by_key(|item| item.start) {
                (outing.until, outing.home) = (Some(home), of);
            }
        }
        // It is part of the outing.
        self.list.iter_mut().filter(|draft| draft.item.activity == Activity::ComeHome).for_each(|draft| {
            draft.item.latest = RunTime::MIN;
        });
    }

    /// The start of a draft whose reference is settled. With `at_last`, an unsettled reference is guessed.
    fn start_of(&self, index: usize, known: &[bool], at_last: bool) -> Option<RunTime> {
        let ItemDraft { item, start, later, .. } = &self.list[index];
        let span = |activity: &Activity| self.span_of(activity, known, at_last);
        match start {
            ItemStart::Known => Some(item.start),
            ItemStart::At(start) => Some(*start),
            ItemStart::After(activity, gap) => Some(span(activity)?.end + *gap + *later),
            ItemStart::Before(activity, gap) => {
                let begin = span(activity)?.begin - *gap;
                // Food does not wait for an activity before the meal.
                let cooked = match activity {
                    Activity::Eat(meal) if item.lasts > SOON_DONE && self.is_prepared(*meal) => {
                        span(&Activity::Prepare(*meal))?.begin.min(begin)
                    }
                    _ => begin,
                };
                Some(cooked - item.lasts + *later)
            }
            // One microsecond before, so that it comes first.
            ItemStart::With(activity) => Some(span(activity)?.begin - Span::MICROSECOND + *later),
            ItemStart::Then(of) => {
                let of_item = &self.list[*of].item;
                known[*of].then_some(of_item.start + of_item.lasts + *later)
            }
        }
    }

    /// The time of an activity today, or its usual time if it is not done.
    fn span_of(&self, activity: &Activity, known: &[bool], at_last: bool) -> Option<Interval<RunTime>> {
        match activity {
            Activity::GetUp => return Some(Interval::starting(self.up, MINUTE)),
            Activity::GoToBed => return Some(Interval::starting(self.bed, MINUTE)),
            Activity::ComeHome => {
                let outing = self.span_of(&Activity::Leave, known, at_last)?;
                return Some(Interval { begin: RunTime::START, ..outing });
            }
            _ => {}
        }
        let mut of = self.list.iter().zip(known).filter(|(draft, _)| draft.item.activity == *activity);
        match of.next() {
            Some((draft, true)) => Some(Interval::starting(draft.item.start, draft.item.lasts)),
            Some((_, false)) if !at_last => None,
            _ => {
                let usual = defaults::clock(activity, &self.life.numbers).map_or(12.0 * HOUR_S, |clock| clock.mean());
                let start = self.life.instant(self.day, usual);
                let lasts_s = defaults::length(activity, &self.life.numbers).median_min * MINUTE_S;
                Some(Interval::starting(start, Span::from_seconds(lasts_s)))
            }
        }
    }
}
