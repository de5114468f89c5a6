//! Priorities: activities with a time, then other stated ones, then unstated ones; and activities relative to others.

use super::drafts::TO_AND_FRO;
use super::driver::{GRACE, RoutineDriver};
use super::item::{Following, Follows, Item};
use super::resident_routine::SentenceId;
use super::rising::within_the_day;
use super::tally::LATE;
use crate::routine::{Activity, Meal};
use homebody_core::time::{MINUTE, RunTime, Span};

/// Longest time that cooked food waits for the stated time of the meal (our choice).
const KEEPS_WARM: Span = MINUTE.times(30);

/// Longest chain of activities that follow each other (our choice).
const MOST_LINKS: u32 = 8;

/// The time at the table after cooking: cooked food is eaten at once.
fn time_at_table(next: &Item, rest: &[Item]) -> Span {
    let meal = next.activity.of_same_meal().filter(|_| matches!(next.activity, Activity::Prepare(_)));
    let is_eaten = |item: &&Item| meal.as_ref() == Some(&item.activity) && item.visitor.is_none();
    rest.iter().find(is_eaten).map_or(Span::ZERO, |meal| TO_AND_FRO + meal.lasts)
}

impl RoutineDriver {
    /// Unstated activities wait if they would delay stated ones, and flexible ones if they would delay those with a time.
    /// No one goes out just before a meal.
    pub(super) fn prefer_stated(&mut self, now: RunTime) {
        let bed = self.agenda.bed;
        let may_wait =
            |next: &Item| next.visitor.is_none() && !next.has_its_time && !next.is_essential() && next.until.is_none();
        let next = self.agenda.items.get(self.next_item);
        if next.is_none_or(|next| next.start > now + MINUTE || !next.waits && !may_wait(next)) {
            return;
        }
        let are_free: Vec<bool> = self.agenda.items[self.next_item..]
            .iter()
            .map(|item| self.may_begin(item, now) && !self.has_been_missed(item, now))
            .collect();
        let (breaks, rest) = (&self.agenda.breaks[self.next_break..], &mut self.agenda.items[self.next_item..]);
        let next = &rest[0];
        let (is_outing, gives_way) = (next.activity == Activity::Leave, next.activity.gives_way_to_meals());
        // With walks, it takes somewhat longer than planned.
        let end = now + next.lasts + if is_outing { 4 * MINUTE } else { 2 * MINUTE };
        let at_table = time_at_table(next, rest);
        // A visitor is let in from the table.
        let end_before = |item: &Item| if item.visitor.is_some() { end } else { end + at_table };
        let fits_after = |item: &Item| item.start + item.lasts + next.lasts + at_table < bed;
        let is_timed = |item: &Item| {
            item.has_its_time && item.follows.is_none() && !(gives_way && item.is_essential()) && fits_after(item)
        };
        let is_said = |item: &Item| {
            // A stated activity delays other stated ones only at its time, except for medicine.
            let is_late = next.waits || item.activity == Activity::TakeMedicine;
            let is_due = item.start >= now - GRACE || is_late && item.latest >= now;
            !item.waits && item.start < end_before(item) && is_due && (next.waits || is_timed(item))
        };
        let is_meal = |item: &Item| {
            let reach = if next.is_unsaid && item.is_awaited { next.lasts } else { 2 * GRACE };
            is_outing && item.is_essential() && item.start < now + reach
        };
        let is_first = |item: &Item| is_said(item) || is_meal(item) && item.latest >= now;
        let first = rest.iter().zip(&are_free).skip(1).position(|(item, &is_free)| is_free && is_first(item));
        if let Some(said) = first.map(|said| said + 1) {
            rest[0].latest = rest[0].latest.max(rest[said].latest);
            rest[..=said].rotate_right(1);
            return;
        }
        // After an outing it is too late for interruptions of that time.
        let timed = breaks.iter().find(|item| item.has_its_time && (now..end).contains(&item.start));
        if let Some(timed) = timed.filter(|timed| is_outing && (next.waits || fits_after(timed))) {
            rest[0].start = timed.start + timed.lasts;
            rest[0].latest = rest[0].latest.max(rest[0].start);
            rest.sort_by_key(|item| item.start);
        }
    }

    /// Begins an activity with some leeway later, so that another one after it is in time, too.
    pub(super) fn let_both_be_in_time(&mut self, now: RunTime) {
        let rest = &self.agenda.items[self.next_item..];
        let Some(next) = rest.first().filter(|next| next.start <= now + MINUTE) else { return };
        if next.waits || next.visitor.is_some() || next.until.is_some() {
            return;
        }
        let end = now + next.lasts + time_at_table(next, rest);
        let over = |item: &Item| item.start + item.lasts + TO_AND_FRO;
        let is_squeezed = |item: &&Item| {
            let is_own = !item.waits && item.has_its_time && item.visitor.is_none() && !item.is_essential();
            is_own && item.start > now && item.start + LATE < end && over(item) <= next.stated_by + LATE
        };
        let Some(first) = rest.iter().skip(1).filter(is_squeezed).find(|item| self.may_begin(item, now)) else {
            return;
        };
        let start = over(first);
        let next = &mut self.agenda.items[self.next_item];
        (next.latest, next.start) = (next.latest + (start - next.start), start);
        self.agenda.items[self.next_item..].sort_by_key(|item| item.start);
    }

    /// Leaves out the next items of the plan.
    pub(super) fn pass_over(&mut self, count: usize, now: RunTime) {
        for item in self.agenda.items.iter().skip(self.next_item).take(count) {
            self.tally.leave_out(item, now);
        }
        self.next_item += count;
    }

    /// Whether a stated activity with a time begins before an instant.
    pub(super) fn is_stated_before(&self, end: RunTime) -> bool {
        let ahead = self.agenda.items.iter().skip(self.next_item).take_while(|item| item.start < end);
        ahead.into_iter().any(|item| item.has_its_time && !item.waits)
    }

    /// The activity of a sentence that is still ahead.
    fn ahead(&self, of: SentenceId) -> Option<&Item> {
        let Self { agenda, next_item, next_break, .. } = self;
        let ahead = agenda.items.iter().skip(*next_item).chain(agenda.breaks.iter().skip(*next_break));
        ahead.into_iter().find(|item| item.of == Some(of))
    }

    /// The start of an activity ahead, by those that it waits for.
    fn expected_start(&self, item: &Item, now: RunTime, links: u32) -> RunTime {
        let anchor = item.follows.filter(|_| links < MOST_LINKS);
        let Some((anchor, how)) = anchor.and_then(|follows| Some((self.ahead(follows.of)?, follows.how))) else {
            return item.start;
        };
        let begin = self.expected_start(anchor, now, links + 1);
        let end = anchor.until.unwrap_or(begin.max(now) + anchor.lasts);
        match how {
            Following::After(gap) => end + gap,
            Following::NotBefore => item.start.max(end),
            Following::With => begin - Span::MICROSECOND,
            Following::Meanwhile => begin + Span::MICROSECOND,
        }
    }

    /// Whether no other activity has to be over before.
    pub(super) fn may_begin(&self, item: &Item, now: RunTime) -> bool {
        let Some(follows) = item.follows else { return true };
        match (self.ahead(follows.of), follows.how) {
            (_, Following::Meanwhile) => false,
            // The other does not wait itself, as a meal does for its cooking.
            (Some(with), Following::With) => {
                let is_over = |before: Follows| before.how == Following::With || self.ahead(before.of).is_none();
                with.follows.is_none_or(is_over) && self.expected_start(item, now, 0) <= now + GRACE
            }
            (None, Following::With) => true,
            (Some(_), _) => false,
            (None, _) => item.activity.of_same_meal().is_some(),
        }
    }

    /// An activity that follows another waits for it. Without the other it is left out, except for a meal without its
    /// preparation, and what goes with a meal.
    pub(super) fn wait_for_others(&mut self, now: RunTime) {
        for _ in self.next_item..self.agenda.items.len() {
            let Some(next) = self.agenda.items.get(self.next_item).filter(|next| next.follows.is_some()) else { break };
            let (is_free, start) = (self.may_begin(next, now), self.expected_start(next, now, 0));
            let is_ahead = next.follows.is_some_and(|follows| self.ahead(follows.of).is_some());
            let next = &mut self.agenda.items[self.next_item];
            if is_free {
                next.follows = next.follows.filter(|_| is_ahead);
                break;
            }
            if !is_ahead {
                self.next_item += 1;
                continue;
            }
            (next.latest, next.start) = (next.latest + (start - next.start).max(Span::ZERO), start);
            self.agenda.items[self.next_item..].sort_by_key(|item| item.start);
        }
        self.delay_bed(now);
    }

    /// A bedtime after an activity that is late moves with it.
    fn delay_bed(&mut self, now: RunTime) {
        let Some(Follows { of, how: Following::After(gap) }) = self.agenda.bed_follows else { return };
        match self.ahead(of).filter(|item| item.latest >= now) {
            Some(item) => {
                let over = item.until.unwrap_or(self.expected_start(item, now, 0).max(now) + item.lasts);
                let bed = self.agenda.bed.max(over + gap);
                self.agenda.bed = within_the_day(bed, self.agenda.up, self.agenda.next_up);
            }
            None => self.agenda.bed_follows = None,
        }
    }

    /// Starts a following activity the stated delay after the actual end.
    pub(super) fn let_follow(&mut self, over: Option<SentenceId>, label: &str, now: RunTime) {
        let Some(over) = over else { return };
        if let Some(Follows { of, how: Following::After(gap) }) = self.agenda.bed_follows
            && of == over
            && self.ahead(over).is_none()
        {
            self.agenda.bed = within_the_day(now + gap, self.agenda.up, self.agenda.next_up);
            self.agenda.bed_follows = None;
        }
        let mut moved: Vec<(SentenceId, RunTime)> = Vec::new();
        for item in &mut self.agenda.items[self.next_item..] {
            let waits = |how: Following| !matches!(how, Following::With | Following::Meanwhile);
            let waited = item.follows.take_if(|follows| follows.of == over && waits(follows.how));
            let Some(Follows { how, .. }) = waited else { continue };
            let start = if let Following::After(gap) = how { now + gap } else { item.start.max(now) };
            (item.latest, item.start) = (item.latest + (start - item.start).max(Span::ZERO), start);
            moved.extend(item.of.map(|of| (of, start)));
            let is_cooked = Meal::ALL
                .iter()
                .any(|&meal| item.activity == Activity::Eat(meal) && Activity::Prepare(meal).label() == label);
            if is_cooked && start <= now + KEEPS_WARM {
                self.served = Some(item.key.clone());
            }
        }
        for (of, start) in &moved {
            let with = Some(Follows { of: *of, how: Following::With });
            for item in self.agenda.items[self.next_item..].iter_mut().filter(|item| item.follows == with) {
                (item.latest, item.start) = (item.latest.max(*start), *start - Span::MICROSECOND);
            }
        }
        if !moved.is_empty() {
            self.agenda.items[self.next_item..].sort_by_key(|item| item.start);
        }
    }

    /// Nothing comes between the cooking and the meal, except for what goes with the meal.
    pub(super) fn serve(&mut self, now: RunTime) {
        let Some(key) = &self.served else { return };
        let rest = &mut self.agenda.items[self.next_item..];
        let Some(meal) = rest.iter().position(|item| item.key == *key && item.latest >= now) else {
            self.served = None;
            return;
        };
        let of = rest[meal].of;
        let goes_with =
            |item: &Item| item.follows.is_some_and(|follows| Some(follows.of) == of && follows.how == Following::With);
        rest[..=meal].sort_by_key(|item| item.key != *key && !goes_with(item));
    }
}
