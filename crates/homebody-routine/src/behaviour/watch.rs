//! Things that are on or open, and rules that wait until a state has lasted long enough.

use super::places::HomePlaces;
use super::resident_routine::{InForce, ResidentRoutine, SentenceId};
use crate::routine::{Response, RoutineRule, RuleTrigger};
use homebody_core::motion::MotionSegment;
use homebody_core::plan::Plan;
use homebody_core::time::{RunTime, Span};

/// The things that a resident left on, and the rules.
#[derive(Clone, Debug)]
pub struct Watches {
    on: Vec<ThingLeftOn>,
    rules: Vec<RuleWatch>,
    /// Things that the current activity will leave on.
    forgotten: Vec<u32>,
    /// Whether a rule polls others' actions or the light.
    looks: bool,
}

#[derive(Clone, Debug)]
struct ThingLeftOn {
    thing: u32,
    /// Whether the user has continued with other activities.
    behind: bool,
}

#[derive(Clone, Debug)]
struct RuleWatch {
    rule: RoutineRule,
    id: SentenceId,
    key: String,
    /// Its trigger holds.
    holds: bool,
    due: RunTime,
    /// It was forgotten, and is remembered later.
    is_late: bool,
    /// Whether its state was polled before.
    is_seen: bool,
}

/// Things that are on, regardless of the user, and the rest of the current segment.
#[derive(Clone, Debug, Default)]
pub struct WatchInput {
    pub(super) on: Vec<bool>,
    pub(super) rest: Option<MotionSegment>,
}

impl Watches {
    pub fn new(life: &ResidentRoutine, day: i32) -> Watches {
        let mut watches = Watches::none();
        watches.wake(day, life);
        watches
    }

    pub fn none() -> Watches {
        Watches { on: Vec::new(), rules: Vec::new(), forgotten: Vec::new(), looks: false }
    }

    /// Sets the rules of a new day; those that wait continue.
    pub fn wake(&mut self, day: i32, life: &ResidentRoutine) {
        let mut before = std::mem::take(&mut self.rules);
        for in_force in life.rules(day) {
            let InForce { said: rule, strength, key, .. } = in_force;
            if strength * life.phase(&rule.when.phase, day) > 0.0 {
                let kept = before.iter().position(|watch| watch.key == key).map(|index| before.swap_remove(index));
                let new = || RuleWatch {
                    rule: rule.clone(),
                    id: in_force.id(),
                    key: key.to_owned(),
                    holds: false,
                    due: RunTime::NEVER,
                    is_late: false,
                    is_seen: false,
                };
                self.rules.push(kept.unwrap_or_else(new));
            }
        }
        self.end(&|trigger| *trigger == RuleTrigger::InBed);
        self.looks = self.rules.iter().any(|watch| watch.rule.whenever.is_polled());
    }

    pub fn looks(&self) -> bool {
        self.looks
    }

    pub fn needs_sight(&self) -> bool {
        self.looks || self.rules.iter().any(|watch| !watch.rule.only_if.is_empty())
    }

    /// Polls states with `is_so`.
    pub fn look(&mut self, is_so: impl Fn(&RuleTrigger) -> bool, now: RunTime, life: &ResidentRoutine) {
        for index in 0..self.rules.len() {
            let watch = &self.rules[index];
            if !watch.rule.whenever.is_polled() {
                continue;
            }
            // A state at the first poll is not a change.
            let was_so = watch.is_seen || watch.rule.lasts.high > 0.0;
            self.rules[index].is_seen = true;
            let watch = &self.rules[index];
            match (is_so(&watch.rule.whenever), watch.holds) {
                (true, false) if !was_so => self.rules[index].holds = true,
                (true, false) => self.begin_one(index, now, life),
                (false, true) => {
                    // A ring is over at once.
                    let watch = &mut self.rules[index];
                    watch.holds = false;
                    if watch.rule.lasts.high > 0.0 {
                        watch.due = RunTime::NEVER;
                    }
                }
                _ => {}
            }
        }
    }

    pub fn does(&mut self, label: &str, at: RunTime, life: &ResidentRoutine) {
        self.begin(&|trigger| matches!(trigger, RuleTrigger::Doing(activity) if activity.label() == label), at, life);
    }

    pub fn has_done(&mut self, label: &str, at: RunTime, life: &ResidentRoutine) {
        let lasts = |watch: &RuleWatch| watch.rule.lasts.high > 0.0;
        for watch in &mut self.rules {
            if matches!(&watch.rule.whenever, RuleTrigger::Doing(activity) if activity.label() == label) {
                watch.holds = false;
                watch.due = if lasts(watch) { RunTime::NEVER } else { watch.due };
            }
        }
        self.happen(
            &|watch| matches!(&watch.rule.whenever, RuleTrigger::Done(activity) if activity.label() == label),
            at,
            life,
        );
    }

    pub fn wakes(&mut self, at: RunTime, life: &ResidentRoutine) {
        self.happen(&|watch| watch.rule.whenever == RuleTrigger::Wakes, at, life);
    }

    /// Triggers that are events without duration.
    fn happen(&mut self, of: &dyn Fn(&RuleWatch) -> bool, at: RunTime, life: &ResidentRoutine) {
        for index in 0..self.rules.len() {
            if of(&self.rules[index]) {
                self.begin_one(index, at, life);
                self.rules[index].holds = false;
            }
        }
    }

    pub fn is_on(&self, thing: u32) -> bool {
        self.on.iter().any(|left| left.thing == thing)
    }

    /// On or open if true, else off or closed.
    pub fn turn(&mut self, thing: u32, on: bool, at: RunTime, life: &ResidentRoutine, places: &HomePlaces) {
        let name = places.thing_name(thing);
        let is_it = |trigger: &RuleTrigger| matches!(trigger, RuleTrigger::On(of) if of.to_lowercase() == name);
        if on == self.is_on(thing) {
            return;
        }
        if on {
            self.on.push(ThingLeftOn { thing, behind: false });
            self.begin(&is_it, at, life);
        } else {
            self.on.retain(|left| left.thing != thing);
            self.end(&is_it);
        }
    }

    /// These things will stay on.
    pub fn forget(&mut self, things: Vec<u32>) {
        self.forgotten.extend(things);
    }

    /// At the end of an activity, its forgotten things stay on.
    pub fn leave_behind(&mut self) {
        for thing in self.forgotten.drain(..) {
            self.on.iter_mut().filter(|left| left.thing == thing).for_each(|left| left.behind = true);
        }
    }

    /// Things that are on without a user.
    pub fn left_on(&self) -> Vec<u32> {
        self.on.iter().filter(|left| left.behind).map(|left| left.thing).collect()
    }

    pub fn arrive(&mut self, room: Option<usize>, spot: &str, plan: &Plan, at: RunTime, life: &ResidentRoutine) {
        let room = room.map(|room| plan.rooms[room].name.to_lowercase());
        let is_here = |place: &str| {
            let place = place.to_lowercase();
            place == spot || room.as_ref() == Some(&place)
        };
        self.end(&|trigger| matches!(trigger, RuleTrigger::At(place) if !is_here(place)));
        self.begin(&|trigger| matches!(trigger, RuleTrigger::At(place) if is_here(place)), at, life);
    }

    /// Until `end`, or until a rule brings the resident home.
    pub fn leave(&mut self, now: RunTime, end: RunTime, life: &ResidentRoutine) -> RunTime {
        self.end(&|trigger| matches!(trigger, RuleTrigger::At(_)));
        self.begin(&|trigger| *trigger == RuleTrigger::Away, now, life);
        let home =
            self.rules.iter().filter(|watch| watch.rule.whenever == RuleTrigger::Away).map(|watch| watch.due).min();
        let end = end.min(home.unwrap_or(RunTime::NEVER));
        let comes_home = |watch: &mut RuleWatch| {
            // Rules that became due meanwhile are answered at home.
            if watch.rule.whenever == RuleTrigger::Away && watch.due > end {
                (watch.holds, watch.due) = (false, RunTime::NEVER);
            }
        };
        self.rules.iter_mut().for_each(comes_home);
        end
    }

    pub fn lie_down(&mut self, now: RunTime, life: &ResidentRoutine) {
        self.begin(&|trigger| *trigger == RuleTrigger::InBed, now, life);
    }

    /// When the first rule with a position before `rank` is due; earlier rules take precedence.
    pub fn due_before(&self, rank: usize) -> RunTime {
        self.rules.iter().take(rank).map(|watch| watch.due).min().unwrap_or(RunTime::NEVER)
    }

    /// The response to a due rule with a position before `rank` whose conditions hold, and its position. It is due again
    /// only after its trigger has ended and begun anew.
    pub fn due(
        &mut self,
        rank: usize,
        now: RunTime,
        is_so: impl Fn(&RuleTrigger) -> bool,
        life: &ResidentRoutine,
    ) -> Option<(SentenceId, usize, Vec<Response>)> {
        let at = self.rules.iter().take(rank).position(|watch| watch.due <= now)?;
        let watch = &mut self.rules[at];
        let was_due = std::mem::replace(&mut watch.due, RunTime::NEVER);
        if watch.rule.whenever == RuleTrigger::Away {
            watch.holds = false;
        }
        if !watch.rule.only_if.iter().all(|one| is_so(&one.state) == one.holds) {
            return None;
        }
        if let Some(lapse) = watch.rule.lapse.filter(|_| !watch.is_late) {
            let mut stream = life.stream(&format!("{}/forgets/{was_due}", watch.key));
            if stream.chance(lapse.probability) {
                if let Some(later) = lapse.later {
                    watch.due = now.saturating_add(Span::from_seconds(later.draw(&mut stream)));
                    watch.is_late = true;
                }
                return None;
            }
        }
        watch.is_late = false;
        let (id, answers) = (watch.id, watch.rule.answers().cloned().collect());
        let follows = |watch: &RuleWatch| {
            watch.rule.whenever == RuleTrigger::Follows
                && watch.id.source == id.source
                && watch.id.index == id.index + 1
        };
        self.happen(&follows, now, life);
        Some((id, at, answers))
    }

    fn begin(&mut self, of: &dyn Fn(&RuleTrigger) -> bool, at: RunTime, life: &ResidentRoutine) {
        for index in 0..self.rules.len() {
            let watch = &self.rules[index];
            if !watch.holds && of(&watch.rule.whenever) {
                self.begin_one(index, at, life);
            }
        }
    }

    fn begin_one(&mut self, index: usize, at: RunTime, life: &ResidentRoutine) {
        let watch = &mut self.rules[index];
        let mut stream = life.stream(&format!("{}/at/{at}", watch.key));
        let lasts = Span::from_seconds(watch.rule.lasts.draw(&mut stream));
        watch.holds = true;
        watch.due =
            if stream.chance(watch.rule.when.chance.probability) { at.saturating_add(lasts) } else { RunTime::NEVER };
    }

    fn end(&mut self, of: &dyn Fn(&RuleTrigger) -> bool) {
        for watch in self.rules.iter_mut().filter(|watch| of(&watch.rule.whenever)) {
            (watch.holds, watch.due) = (false, RunTime::NEVER);
        }
    }
}
