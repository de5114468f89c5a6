//! Things that are on during something else, or from one time until another.

use super::driver::RoutineDriver;
use super::item::{Following, Follows, HeldThing, Item, Turning};
use super::manner::Manner;
use super::places::HomePlace;
use super::script::{ActivityStep, Interruptible, StayStep};
use crate::routine::{Activity, Effect, HabitTime};
use homebody_core::activity;
use homebody_core::drivers::Next;
use homebody_core::event::ThingUse;
use homebody_core::ids::ThingId;
use homebody_core::posture::Posture;
use homebody_core::role::Role;
use homebody_core::time::{DAY, MINUTE, RunTime, SECOND, Span};
use std::collections::VecDeque;

/// Time that turning a thing on or off takes at its place (our choice).
const TURNING: Span = SECOND.times(2);

/// Time before bed at which a thing is turned on for the night (our choice).
const BEFORE_BED: Span = MINUTE.times(5);

/// Time after rising until a thing that was on at night is turned off (our choice).
const AFTER_RISING: Span = MINUTE.times(3);

/// Time after the start of watching television at which what is done meanwhile begins (our choice).
const SETTLED: Span = MINUTE.times(2);

impl RoutineDriver {
    /// The stated place, or that of the activity meanwhile, or a seat within sight of the thing that is on.
    pub(super) fn place_of(&self, item: &Item) -> Option<HomePlace> {
        let stated = item.place.as_deref().and_then(|place| self.places.named(place));
        let seated = item.activity.roles().first().filter(|role| matches!(role, Role::Armchair | Role::DiningSeat));
        let here = self.body.spot().filter(|spot| item.is_meanwhile && spot.posture == Posture::Sitting);
        let in_sight = || {
            let thing = self.places.thing_named(item.thing_on.as_deref()?)?;
            let room = self.home.plan.room_at(self.home.plan.things[thing as usize].at);
            let usual = self.places.for_role(*seated?)?;
            let others = self.places.substitutes_for(usual);
            others.into_iter().find(|spot| usual.room != room && spot.room == room)
        };
        stated.or(here.filter(|_| seated.is_some())).or_else(in_sight).cloned()
    }

    /// Adds turning the thing on at the place, and off at the end, unless it is on already.
    pub(super) fn turn_on_meanwhile(&self, item: &Item, forgotten: &[u32], steps: &mut VecDeque<ActivityStep>) {
        let Some(thing) = item.thing_on.as_deref().and_then(|thing| self.places.thing_named(thing)) else { return };
        let is_it = |step: &ActivityStep| matches!(step, ActivityStep::Act(of, true) if *of == thing);
        if self.watches.is_on(thing) || steps.iter().any(is_it) {
            return;
        }
        let is_there = |step: &ActivityStep| matches!(step, ActivityStep::Stay(_) | ActivityStep::Wander { .. });
        steps.insert(steps.iter().position(is_there).unwrap_or(steps.len()), ActivityStep::Act(thing, true));
        if !forgotten.contains(&thing) {
            steps.push_back(ActivityStep::Act(thing, false));
        }
    }

    /// The steps of turning a thing on or off at its place.
    pub(super) fn turning_steps(&mut self, turning: Turning) -> Vec<ActivityStep> {
        let Turning { thing, on, until } = turning;
        self.held.retain(|held| held.thing != thing);
        if let Some(until) = until.filter(|_| on) {
            self.held.push(HeldThing { thing, until });
            self.plan_turning_off(HeldThing { thing, until });
        }
        let at = self.places.named(self.places.thing_name(thing)).cloned();
        let turns = (on != self.watches.is_on(thing) || until.is_none()).then_some(ActivityStep::Act(thing, on));
        let moment = ActivityStep::Stay(StayStep {
            posture: Posture::Standing,
            manner: Manner::BUSY,
            left: TURNING,
            until: None,
            may: Interruptible::Nothing,
        });
        at.map(ActivityStep::Go).into_iter().chain(turns).chain([moment]).collect()
    }

    /// On or open if true, else off or closed. A thing that is kept on stays on.
    pub(super) fn act(&mut self, thing: u32, on: bool, at: RunTime) {
        if !on && self.held.iter().any(|held| held.thing == thing) {
            return;
        }
        self.watches.turn(thing, on, at, &self.life, &self.places);
        self.ready.push_back(Next::Use(ThingUse { thing: ThingId(thing), on }));
    }

    /// Plans what is turned on today, and off what is still on.
    pub(super) fn plan_turnings(&mut self, now: RunTime) {
        for held in self.held.clone() {
            self.plan_turning_off(HeldThing { until: held.until.max(now + AFTER_RISING), ..held });
        }
        for (rank, (change, chance)) in self.parameters.kept_on.clone().into_iter().enumerate() {
            let Effect::KeepsOn { thing: name } = &change.effect else { continue };
            let Some(thing) = self.places.thing_named(name) else { continue };
            let day = self.agenda.day;
            let mut stream = self.life.stream_of_day(day, &format!("keeps on/{}/{rank}", name.to_lowercase()));
            if !stream.chance(chance) {
                continue;
            }
            let last = self.agenda.bed - BEFORE_BED;
            let (from, until) = match (&change.when.time, &change.when.until) {
                (HabitTime::At(from), Some(until)) => {
                    let [from, until] = [from, until].map(|time| self.life.instant(day, time.draw(&mut stream)));
                    (from, if until <= from { until + DAY } else { until })
                }
                _ => (last, self.agenda.next_up),
            };
            let from = from.min(last).max(self.agenda.up);
            if until > from.max(now) + MINUTE {
                self.plan_turning(Turning { thing, on: true, until: Some(until) }, from.max(now), until);
            }
        }
    }

    /// One that ends while the person sleeps is turned off after rising.
    fn plan_turning_off(&mut self, held: HeldThing) {
        if held.until < self.agenda.bed {
            let off = Turning { thing: held.thing, on: false, until: None };
            self.plan_turning(off, held.until, RunTime::MAX);
        }
    }

    fn plan_turning(&mut self, turning: Turning, start: RunTime, latest: RunTime) {
        let label = activity::turning(self.places.thing_name(turning.thing), turning.on);
        let item = Item::now(format!("turning/{label}"), Activity::Other(label), TURNING);
        self.add_break(Item { start, latest, turns: Some(turning), ..item });
    }

    fn add_break(&mut self, item: Item) {
        let ahead = &self.agenda.breaks[self.next_break..];
        let at = self.next_break + ahead.partition_point(|of| of.start <= item.start);
        self.agenda.breaks.insert(at, item);
    }

    /// Plans the activities that are done while this one lasts.
    pub(super) fn begin_meanwhile(&mut self, item: &Item, now: RunTime) {
        let Some(of) = item.of.filter(|_| item.activity.leaves_hands_free()) else { return };
        let with = Some(Follows { of, how: Following::Meanwhile });
        let meanwhile: Vec<Item> =
            self.agenda.items.extract_if(self.next_item.., |other| other.follows == with).collect();
        let most = item.until.map_or(item.lasts, |until| (until - now).max(MINUTE)) - SETTLED - SETTLED;
        for other in meanwhile {
            let is_stated = other.of.and_then(|of| self.life.habit(of)).is_some_and(|habit| habit.when.lasts.is_some());
            let is_whole = !is_stated && other.activity.gives_way_to_meals();
            let lasts = if is_whole { most } else { other.lasts.min(most) }.max(MINUTE);
            let start = now + SETTLED;
            self.add_break(Item {
                start,
                latest: now + most.max(SETTLED),
                lasts,
                follows: None,
                is_meanwhile: true,
                ..other
            });
        }
    }

    /// The activity below has lasted through what was done meanwhile.
    pub(super) fn pass_meanwhile(&mut self, passed: Span) {
        let below = self.scripts.last_mut().and_then(|below| below.steps.front_mut());
        if let Some(ActivityStep::Stay(stay)) = below {
            stay.left = (stay.left - passed).max(Span::ZERO);
        }
    }
}

impl Activity {
    /// Whether something else can be done in the same place meanwhile.
    pub(super) fn leaves_hands_free(&self) -> bool {
        let is = |label: &str| [activity::LISTENING, activity::LOOKING_OUT].contains(&label);
        matches!(self, Activity::WatchTelevision | Activity::Relax) || is(self.label())
    }

    /// Whether it can be done while another activity lasts. A meal has a table and a time of its own.
    pub(super) fn is_done_meanwhile(&self) -> bool {
        use Activity::{ComeHome, Eat, GetUp, GoToBed, Leave, Prepare, Visit};
        !matches!(self, ComeHome | Eat(_) | GetUp | GoToBed | Leave | Prepare(_) | Visit)
    }
}
