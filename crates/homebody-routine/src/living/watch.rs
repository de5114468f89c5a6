//! What is on or open, and the rules that wait for something to have lasted long enough.

use super::life::{InForce, Life, SentenceId};
use super::places::Places;
use crate::routine::{Response, Rule, Trigger};
use homebody_core::drivers::MotionSegment;
use homebody_core::home::plan::Plan;
use homebody_core::time::{Micros, NEVER, micros};

/// The things that this resident has left on, and the rules that watch.
#[derive(Clone, Debug)]
pub struct Watches {
    on: Vec<Left>,
    rules: Vec<Watch>,
    /// What the script that is being played will leave on.
    forgotten: Vec<u32>,
    /// Whether any of the rules waits for what others do, or for the light.
    looks: bool,
}

#[derive(Clone, Debug)]
struct Left {
    thing: u32,
    /// Whether whoever turned it on has gone on to other things.
    behind: bool,
}

#[derive(Clone, Debug)]
struct Watch {
    rule: Rule,
    id: SentenceId,
    key: String,
    /// What it waits for goes on.
    holds: bool,
    due: Micros,
    /// It was forgotten, and comes to mind later.
    is_late: bool,
    /// Whether what it waits for was looked at before.
    is_seen: bool,
}

/// What is on, whoever uses it, and the rest of what is being done.
#[derive(Clone, Debug, Default)]
pub struct Sight {
    pub(super) on: Vec<bool>,
    pub(super) rest: Option<MotionSegment>,
}

impl Watches {
    pub fn new(life: &Life, day: i32) -> Watches {
        let mut watches = Watches::none();
        watches.wake(day, life);
        watches
    }

    /// Nothing is on, and nobody watches.
    pub fn none() -> Watches {
        Watches { on: Vec::new(), rules: Vec::new(), forgotten: Vec::new(), looks: false }
    }

    /// The rules of a new day; those that go on go on waiting.
    pub fn wake(&mut self, day: i32, life: &Life) {
        let mut before = std::mem::take(&mut self.rules);
        for in_force in life.rules(day) {
            let InForce { said: rule, strength, key, .. } = in_force;
            if strength * life.phase(&rule.phase, day) > 0.0 {
                let kept = before.iter().position(|watch| watch.key == key).map(|index| before.swap_remove(index));
                let new = || Watch {
                    rule: rule.clone(),
                    id: in_force.id(),
                    key: key.to_owned(),
                    holds: false,
                    due: NEVER,
                    is_late: false,
                    is_seen: false,
                };
                self.rules.push(kept.unwrap_or_else(new));
            }
        }
        self.end(&|trigger| *trigger == Trigger::InBed);
        self.looks = self.rules.iter().any(|watch| watch.rule.whenever.is_looked_for());
    }

    /// Whether what others do, and the light, has to be looked out for.
    pub fn looks(&self) -> bool {
        self.looks
    }

    /// Whether any rule asks for what others do, or for the light.
    pub fn needs_sight(&self) -> bool {
        self.looks || self.rules.iter().any(|watch| !watch.rule.only_if.is_empty())
    }

    /// Looks at what rules wait for: `is_so` says what is so now.
    pub fn look(&mut self, is_so: impl Fn(&Trigger) -> bool, now: Micros, life: &Life) {
        for index in 0..self.rules.len() {
            let watch = &self.rules[index];
            if !watch.rule.whenever.is_looked_for() {
                continue;
            }
            // What is so as the looking begins does not begin then.
            let was_so = watch.is_seen || watch.rule.lasts.high > 0.0;
            self.rules[index].is_seen = true;
            let watch = &self.rules[index];
            match (is_so(&watch.rule.whenever), watch.holds) {
                (true, false) if !was_so => self.rules[index].holds = true,
                (true, false) => self.begin_one(index, now, life),
                (false, true) => {
                    // A bell that has rung has rung.
                    let watch = &mut self.rules[index];
                    watch.holds = false;
                    if watch.rule.lasts.high > 0.0 {
                        watch.due = NEVER;
                    }
                }
                _ => {}
            }
        }
    }

    /// Something is begun, or over.
    pub fn does(&mut self, label: &str, at: Micros, life: &Life) {
        self.begin(&|trigger| matches!(trigger, Trigger::Doing(activity) if activity.label() == label), at, life);
    }

    /// Something is over.
    pub fn has_done(&mut self, label: &str, at: Micros, life: &Life) {
        let lasts = |watch: &Watch| watch.rule.lasts.high > 0.0;
        for watch in &mut self.rules {
            if matches!(&watch.rule.whenever, Trigger::Doing(activity) if activity.label() == label) {
                watch.holds = false;
                watch.due = if lasts(watch) { NEVER } else { watch.due };
            }
        }
        self.happen(
            &|watch| matches!(&watch.rule.whenever, Trigger::Done(activity) if activity.label() == label),
            at,
            life,
        );
    }

    /// What waits for something that happens and does not last.
    fn happen(&mut self, of: &dyn Fn(&Watch) -> bool, at: Micros, life: &Life) {
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

    /// A thing is turned on or opened, or off or closed.
    pub fn turn(&mut self, thing: u32, on: bool, at: Micros, life: &Life, places: &Places) {
        let name = places.thing_name(thing);
        let is_it = |trigger: &Trigger| matches!(trigger, Trigger::On(of) if of.to_lowercase() == name);
        if on == self.is_on(thing) {
            return;
        }
        if on {
            self.on.push(Left { thing, behind: false });
            self.begin(&is_it, at, life);
        } else {
            self.on.retain(|left| left.thing != thing);
            self.end(&is_it);
        }
    }

    /// This time these things will stay on.
    pub fn forget(&mut self, things: Vec<u32>) {
        self.forgotten.extend(things);
    }

    /// The script is over: what it has forgotten stays behind.
    pub fn leave_behind(&mut self) {
        for thing in self.forgotten.drain(..) {
            self.on.iter_mut().filter(|left| left.thing == thing).for_each(|left| left.behind = true);
        }
    }

    /// What stays on although nobody uses it.
    pub fn left_on(&self) -> Vec<u32> {
        self.on.iter().filter(|left| left.behind).map(|left| left.thing).collect()
    }

    /// The resident has come to a place.
    pub fn arrive(&mut self, room: Option<usize>, spot: &str, plan: &Plan, at: Micros, life: &Life) {
        let room = room.map(|room| plan.rooms[room].name.to_lowercase());
        let is_here = |place: &str| {
            let place = place.to_lowercase();
            place == spot || room.as_ref() == Some(&place)
        };
        self.end(&|trigger| matches!(trigger, Trigger::At(place) if !is_here(place)));
        self.begin(&|trigger| matches!(trigger, Trigger::At(place) if is_here(place)), at, life);
    }

    /// The resident is out until `end`, or until a rule brings them home.
    pub fn leave(&mut self, now: Micros, end: Micros, life: &Life) -> Micros {
        self.end(&|trigger| matches!(trigger, Trigger::At(_)));
        self.begin(&|trigger| *trigger == Trigger::Away, now, life);
        let home = self.rules.iter().filter(|watch| watch.rule.whenever == Trigger::Away).map(|watch| watch.due).min();
        let end = end.min(home.unwrap_or(NEVER));
        let comes_home = |watch: &mut Watch| {
            // What was due in the meantime happens at home.
            if watch.rule.whenever == Trigger::Away && watch.due > end {
                (watch.holds, watch.due) = (false, NEVER);
            }
        };
        self.rules.iter_mut().for_each(comes_home);
        end
    }

    pub fn lie_down(&mut self, now: Micros, life: &Life) {
        self.begin(&|trigger| *trigger == Trigger::InBed, now, life);
    }

    /// When the first rule is due that stands before `rank` in the text: what it asks for goes before what later ones do.
    pub fn due_before(&self, rank: usize) -> Micros {
        self.rules.iter().take(rank).map(|watch| watch.due).min().unwrap_or(NEVER)
    }

    /// What is to be done now, by which rule, and where that stands, if one is due before `rank` and nothing that was said stands
    /// against it; it is not due again before what it waits for has ended and begun anew.
    pub fn due(
        &mut self,
        rank: usize,
        now: Micros,
        is_so: impl Fn(&Trigger) -> bool,
        life: &Life,
    ) -> Option<(SentenceId, usize, Vec<Response>)> {
        let at = self.rules.iter().take(rank).position(|watch| watch.due <= now)?;
        let watch = &mut self.rules[at];
        let was_due = std::mem::replace(&mut watch.due, NEVER);
        if watch.rule.whenever == Trigger::Away {
            watch.holds = false;
        }
        if !watch.rule.only_if.iter().all(|one| is_so(&one.state) == one.holds) {
            return None;
        }
        if let Some(lapse) = watch.rule.lapse.filter(|_| !watch.is_late) {
            let mut stream = life.stream(&format!("{}/forgets/{was_due}", watch.key));
            if stream.chance(lapse.probability) {
                if let Some(later) = lapse.later {
                    watch.due = now.saturating_add(micros(later.draw(&mut stream)));
                    watch.is_late = true;
                }
                return None;
            }
        }
        watch.is_late = false;
        let (id, answers) = (watch.id, watch.rule.answers().cloned().collect());
        let follows = |watch: &Watch| {
            watch.rule.whenever == Trigger::Follows && watch.id.source == id.source && watch.id.index == id.index + 1
        };
        self.happen(&follows, now, life);
        Some((id, at, answers))
    }

    fn begin(&mut self, of: &dyn Fn(&Trigger) -> bool, at: Micros, life: &Life) {
        for index in 0..self.rules.len() {
            let watch = &self.rules[index];
            if !watch.holds && of(&watch.rule.whenever) {
                self.begin_one(index, at, life);
            }
        }
    }

    fn begin_one(&mut self, index: usize, at: Micros, life: &Life) {
        let watch = &mut self.rules[index];
        let mut stream = life.stream(&format!("{}/at/{at}", watch.key));
        let lasts = micros(watch.rule.lasts.draw(&mut stream));
        watch.holds = true;
        watch.due = if stream.chance(watch.rule.probability) { at.saturating_add(lasts) } else { NEVER };
    }

    fn end(&mut self, of: &dyn Fn(&Trigger) -> bool) {
        for watch in self.rules.iter_mut().filter(|watch| of(&watch.rule.whenever)) {
            (watch.holds, watch.due) = (false, NEVER);
        }
    }
}
