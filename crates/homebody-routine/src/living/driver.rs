//! Lives a routine: carries out the day's plan, interrupts it for needs and rules, walks the body from place to place.
//!
//! Three layers decide, the higher over the lower (Brooks 1986): needs that press, rules and what happens to one
//! interrupt; the plan of the day says what is next; and where it says nothing, the time is filled. What is interrupted
//! goes on where it was.

use super::agenda::Agenda;
use super::body::Body;
use super::chores::{self, Errand};
use super::company::Company;
use super::errands::Errands;
use super::item::Item;
use super::life::{DayParameters, Life};
use super::manner::Manner;
use super::needs::Needs;
use super::places::{Places, Spot};
pub(super) use super::playing::{Playing, Walks};
use super::script::{Interruptible, STAYING_OVER, Setting, Step, script};
use super::tally::Tally;
use super::watch::{Sight, Watches};
use crate::routine::Activity;
use homebody_core::drivers::{Driver, MotionSegment, Next, Surroundings};
use homebody_core::event::{MotionState, Need};
use homebody_core::home::Home;
use homebody_core::ids::ResidentId;
use homebody_core::random::Stream;
use homebody_core::role::Role;
use homebody_core::scenario::path::Posture;
use homebody_core::time::{DAY, Micros, SECOND};
use homebody_walk::Wanderers;
use std::any::Any;
use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;

pub(super) const MINUTE: Micros = 60 * SECOND;

/// A resident who lives by a routine.
#[derive(Clone, Debug)]
pub struct RoutineDriver {
    pub(super) life: Arc<Life>,
    pub(super) home: Arc<Home>,
    pub(super) places: Arc<Places>,
    pub(super) body: Body,
    pub(super) parameters: DayParameters,
    pub(super) agenda: Agenda,
    pub(super) next_item: usize,
    pub(super) next_break: usize,
    /// The first item of the plan that was still to come as it was made.
    pub(super) first_item: usize,
    /// What is being done, and under it what was interrupted for it.
    pub(super) scripts: Vec<Playing>,
    /// What comes next before anything is decided: the strides of a walk, facts.
    pub(super) ready: VecDeque<Next>,
    /// What is being done by name, as it was told, and as it is now: what takes no time is not told.
    pub(super) told: String,
    pub(super) name: String,
    pub(super) needs: Needs,
    pub(super) watches: Watches,
    /// How many times today each activity was done that nobody planned.
    pub(super) unplanned: BTreeMap<Activity, u32>,
    /// The conditions that were told last.
    pub(super) shown: Vec<String>,
    pub(super) errands: Errands,
    /// What came of each sentence so far.
    pub(super) tally: Tally,
    /// Whether what filled the time last was an errand.
    pub(super) was_errand: bool,
    /// The hour from which on the mail of today is fetched, until it is.
    pub(super) mail_hour: Option<f64>,
    /// The hour of the day as the last script began.
    pub(super) hour_now: f64,
    /// How much later than planned one gets up for the night before it.
    pub(super) slept_in: Micros,
    /// The instant at which it was asked last.
    pub(super) now: Micros,
    /// When a meal or medicine was over last: what follows it at once is not put off.
    pub(super) at_table: Micros,
    /// From which the hours of the day are counted.
    pub(super) midnight: Micros,
    /// What a visitor, rather than somebody who lives here, is called.
    pub(super) visitor: Option<String>,
    /// The resident whose life it is: of a visitor the host.
    pub(super) host: ResidentId,
    /// Who else is there.
    pub(super) company: Company,
    /// The visitor whom the resident receives.
    pub(super) guest: Option<ResidentId>,
    /// Whether it is a visitor who has a bed there, and is not sent away while the host is out.
    pub(super) stays_over: bool,
    /// Who comes before this one in the scenario's order.
    pub(super) rank: u32,
    /// How often in a row one has waited for somebody in the way, and for a place that is taken.
    pub(super) pauses: u32,
    pub(super) queues: u32,
    /// Whether one has waited so often that one lets nobody stop one.
    pub(super) pushes_through: bool,
    pub(super) sight: Sight,
}

impl RoutineDriver {
    /// A resident at the beginning of a run: in bed before getting up, else up and about.
    pub fn new(
        life: Arc<Life>,
        home: Arc<Home>,
        places: Arc<Places>,
        mut body: Body,
        host: ResidentId,
        company: Company,
    ) -> RoutineDriver {
        let parameters = life.parameters(0);
        let today = Agenda::of(&life, 0, &parameters);
        let in_bed = today.up > 0 || today.bed < 0;
        let agenda = if today.up > 0 { Agenda::of(&life, -1, &life.parameters(-1)) } else { today };
        let role = if in_bed { Role::Bed } else { Role::Armchair };
        let rank = host.0;
        if let Some(spot) = places.of(role) {
            let at = spot.sides_for(rank as usize, company.shares_home()).next().unwrap_or(spot.at);
            let spot = Spot { at, ..spot.clone() };
            let posture = if in_bed { Posture::Lying } else { spot.posture };
            body.place(spot, posture);
        }
        let needs = Needs::new(&life, 0);
        let mut driver = RoutineDriver {
            next_item: if in_bed { agenda.items.len() } else { agenda.items.partition_point(|item| item.start < 0) },
            next_break: agenda.breaks.partition_point(|item| item.start < 0),
            first_item: if in_bed { agenda.items.len() } else { agenda.items.partition_point(|item| item.start < 0) },
            watches: Watches::new(&life, agenda.day),
            scripts: Vec::new(),
            ready: VecDeque::new(),
            told: String::new(),
            name: String::new(),
            unplanned: BTreeMap::new(),
            shown: Vec::new(),
            midnight: life.midnight(agenda.day),
            visitor: None,
            host,
            company,
            guest: None,
            stays_over: false,
            rank,
            pauses: 0,
            queues: 0,
            pushes_through: false,
            sight: Sight::default(),
            errands: Errands::new(),
            tally: Tally::default(),
            was_errand: false,
            mail_hour: None,
            hour_now: 0.0,
            slept_in: 0,
            now: 0,
            at_table: Micros::MIN,
            needs,
            agenda,
            parameters,
            body,
            places,
            home,
            life,
        };
        driver.tell_conditions();
        driver.needs.waking(0, &driver.life, driver.agenda.day, &driver.parameters);
        if in_bed {
            driver.sleep(0, true);
        }
        driver
    }

    /// Somebody who comes to visit the one whose life this is.
    pub fn visitor(
        life: Arc<Life>,
        home: Arc<Home>,
        places: Arc<Places>,
        body: Body,
        (host, name): (ResidentId, &str),
        company: Company,
    ) -> RoutineDriver {
        let mut driver = RoutineDriver::new(life, home, places, body, host, company);
        (driver.scripts, driver.ready, driver.visitor) = (Vec::new(), VecDeque::new(), Some(name.into()));
        // Neither the host's rules nor the host's illness are theirs.
        (driver.watches, driver.parameters) = (Watches::none(), DayParameters::ordinary());
        driver
    }

    /// What came of each sentence of the life so far.
    pub fn tally(&self) -> &Tally {
        &self.tally
    }

    /// Whether it is somebody who comes to visit, by the routine of whom they visit.
    pub fn is_visitor(&self) -> bool {
        self.visitor.is_some()
    }

    /// The resident whose life it is: of a visitor the host.
    pub fn host(&self) -> ResidentId {
        self.host
    }

    pub fn life(&self) -> &Life {
        &self.life
    }

    fn step(&mut self, now: Micros) -> Next {
        (self.now, self.hour_now) = (now, self.hour(now));
        loop {
            self.make_way(now);
            if let Some(next) = self.ready.front() {
                if matches!(next, Next::Segment(_) | Next::Use(_)) && self.told != self.name {
                    self.told.clone_from(&self.name);
                    return Next::Activity((!self.name.is_empty()).then(|| self.name.clone()));
                }
                if let Next::Segment(next) = next {
                    self.body.follow(next);
                }
            }
            if let Some(next) = self.ready.pop_front() {
                return next;
            }
            let Some(playing) = self.scripts.last_mut() else {
                match &self.visitor {
                    None => self.decide(now),
                    Some(_) => self.await_visit(now),
                }
                continue;
            };
            if playing.is_interrupted && self.essential().is_some_and(|(_, due)| due <= now) {
                // Between cooking and eating nobody goes back to what was interrupted for both.
                self.interrupt(now);
                continue;
            }
            let Some(playing) = self.scripts.last_mut() else { continue };
            if playing.is_interrupted && playing.is_nearly_over(now) {
                playing.steps.clear();
            }
            if std::mem::take(&mut playing.is_interrupted) && !playing.steps.is_empty() {
                let name = Step::Name(playing.name.clone());
                // Who has gone to bed sat down on its edge first, and lies there since.
                let lies = matches!(playing.steps.front(), Some(Step::Stay(stay)) if stay.posture == Posture::Lying);
                match playing.spot.clone() {
                    // Who walks back to bed does not sleep yet: the way is a part of what they got up for.
                    Some(back) if lies || back.posture == Posture::Lying => {
                        playing.steps.push_front(name);
                        playing.steps.push_front(Step::Go(back));
                    }
                    back => {
                        if let Some(back) = back {
                            playing.steps.push_front(Step::Go(back));
                        }
                        playing.steps.push_front(name);
                    }
                }
            }
            match playing.steps.front() {
                None => self.end_script(now),
                Some(Step::Stay(_)) => self.stay(now),
                Some(_) => {
                    if let Some(step) = playing.steps.pop_front() {
                        self.take(step, now);
                    }
                }
            }
        }
    }

    /// What was interrupted for the script that has ended goes on.
    fn end_script(&mut self, now: Micros) {
        let mut still = None;
        if let Some(over) = self.scripts.pop() {
            still = over.answers.map(|rank| (rank, over.still)).filter(|(_, still)| !still.is_empty());
            self.watches.has_done(&over.label, now, &self.life);
            self.tally.end(over.of, now - over.since);
            if over.is_essential {
                self.at_table = now;
            }
            // The host does what comes after a stay.
            if self.visitor.is_none() {
                self.let_follow(over.of, now);
            }
        }
        self.watches.leave_behind();
        if let Some((rank, still)) = still {
            return self.go_on_answering(rank, still, now);
        }
        if let Some(below) = self.scripts.last_mut() {
            below.is_interrupted = !below.steps.is_empty();
        }
    }

    /// Does a step that is no stay.
    fn take(&mut self, step: Step, now: Micros) {
        match step {
            Step::Name(name) => {
                if let Some(playing) = self.scripts.last_mut() {
                    playing.name.clone_from(&name);
                }
                self.name = name;
            }
            Step::Go(spot) => self.go(spot, now),
            Step::Act(thing, on) => self.act(thing, on, now),
            Step::Away { lasts, until } => self.away(lasts, until, now),
            Step::Wander { kind, lasts } => {
                let hour = self.hour(now);
                let others = self.company.places();
                let who = Wanderers { gains: self.parameters.gains(self.life.gains), others: &others };
                if let Some(playing) = self.scripts.last_mut() {
                    let moves =
                        self.body.wander(kind, lasts, now, hour, self.parameters.pace, who, &mut playing.stream);
                    self.ready.extend(moves.into_iter().map(Next::Segment));
                }
            }
            Step::LieDown => self.lie_down(now),
            Step::Meet(need) => self.meet(need, now),
            Step::Wake => self.wake(now),
            Step::Await { arrival, left } => self.await_visitor(arrival, left),
            Step::Ring { left } => self.ring(left, now),
            Step::AwaitMeal { left } => self.await_meal(left),
            Step::AlongFloor { to, mps } => self.along_floor(to, mps, now),
            Step::LieUntilFound { left } => self.lie_until_found(left),
            Step::Stay(_) => {}
        }
    }

    /// Stays for as long as nothing ends it, one movement or rest after the other.
    fn stay(&mut self, now: Micros) {
        let interrupted_at = self.interrupted_at(now);
        let rules_at = self.rules_at().min(self.accident_at()).max(now);
        let breaks_at = self.breaks_into_cooking_at(now);
        let next_start =
            self.agenda.items.get(self.next_item).map_or(self.agenda.bed, |item| item.start.min(self.agenda.bed));
        let active = self.activity(now);
        let is_left_alone = self.visits_nobody();
        let Some(playing) = self.scripts.last_mut() else { return };
        if is_left_alone {
            // What is left is the way out.
            let out = playing.steps.iter().rposition(|step| matches!(step, Step::Go(_))).unwrap_or(0);
            playing.steps.drain(..out);
            playing.steps.retain(|step| !matches!(step, Step::Stay(_)));
            return;
        }
        let Some(Step::Stay(stay)) = playing.steps.front_mut() else { return };
        let mut end = now.saturating_add(stay.left).min(stay.until.unwrap_or(Micros::MAX));
        if stay.may == Interruptible::Yield {
            end = end.min(next_start);
        }
        if end <= now {
            playing.steps.pop_front();
            return;
        }
        let interrupted_at = match stay.may {
            Interruptible::Nothing => Micros::MAX,
            Interruptible::Rules => rules_at,
            Interruptible::Breaks => rules_at.min(breaks_at),
            Interruptible::Interrupt | Interruptible::Yield => interrupted_at,
        };
        if interrupted_at < Micros::MAX {
            if interrupted_at <= now {
                return self.interrupt(now);
            }
            end = end.min(interrupted_at);
        }
        let active = active(&stay.manner);
        let span = match playing.stirs {
            true => stay.manner.bout(&mut playing.stream),
            false => stay.manner.gap(active.max(1.0), &mut playing.stream),
        };
        // Who moves less leaves movements out.
        let moves = playing.stirs && (active >= 1.0 || playing.stream.chance(active));
        let until = end.min(now.saturating_add(span));
        let at = self.body.at();
        let doing = match moves {
            true => MotionState::InPlace { at, amplitude_m: stay.manner.amplitude_m },
            false => MotionState::Rest { at },
        };
        playing.stirs = !playing.stirs;
        stay.left -= until - now;
        self.ready.push_back(Next::Segment(MotionSegment { begin: now, end: until, doing, posture: stay.posture }));
    }

    /// How many times the usual movement there is now, for each manner of staying.
    fn activity(&self, now: Micros) -> impl Fn(&Manner) -> f64 + use<> {
        let (restless, awake) = (self.parameters.restless, self.parameters.activity(self.hour(now)));
        move |manner| if manner.is_of_bed() { restless } else { awake }
    }

    /// Begins what was planned.
    pub(super) fn begin_at(&mut self, item: &Item, now: Micros) {
        self.tally.begin(item, now);
        // How long it still is until it has to end.
        let lasts = item.until.map_or(item.lasts, |until| (until - now).max(SECOND));
        // Visitors leave when they leave, whatever the host had to do meanwhile.
        let is_visit = item.activity == Activity::Visit && lasts < STAYING_OVER;
        let until = if is_visit { Some(now + lasts) } else { item.until };
        self.begin(&Item { lasts, until, ..item.clone() });
        let gives_way =
            item.activity.gives_way_to_meals() && !(item.activity == Activity::Visit && lasts <= SHORT_VISIT);
        if let Some(playing) = self.scripts.last_mut() {
            (playing.of, playing.since) = (item.of, now);
            (playing.gives_way, playing.is_essential) = (gives_way, item.is_essential());
        }
    }

    /// Begins a script on top of what goes on.
    pub(super) fn begin(&mut self, item: &Item) {
        let Item { key, activity, place, lasts, until, .. } = item;
        if let Some(visitor) = &item.visitor {
            self.guest = self.company.visitor(self.host.index(), visitor);
        }
        let place = place.as_deref().and_then(|place| self.places.named(place));
        let mut stream = self.life.stream_of_day(self.agenda.day, &format!("{key}/doing"));
        let mut forgotten = Vec::new();
        for (name, chance) in self.parameters.forgotten() {
            let mut stream = self.life.stream_of_day(self.agenda.day, &format!("{key}/forgets/{name}"));
            let thing = self.places.thing_named(name);
            forgotten.extend(thing.filter(|_| stream.chance(chance)));
        }
        let left = forgotten.clone();
        let movement = self.parameters.activity(self.hour_now);
        let mut setting =
            Setting { places: &self.places, at: self.body.at(), stream: &mut stream, forgotten, movement };
        let mut steps = match item.is_errand() {
            true => {
                let is_mail = self.mail_hour.take_if(|hour| *hour <= self.hour_now).is_some();
                chores::errand(if is_mail { Errand::Mail } else { Errand::Any }, *lasts, &mut setting)
            }
            false if *activity == Activity::Fall => self.fall_steps(item, place, &mut setting),
            false => script(activity, place, *lasts, *until, &mut setting),
        };
        let first = match activity {
            Activity::Wander | Activity::Pace | Activity::Lap => place.cloned(),
            Activity::Stumble => place.cloned().or_else(|| self.station(&mut setting)),
            _ => None,
        };
        if let Some(first) = first {
            steps.push_front(Step::Go(first));
        }
        self.watches.forget(left);
        let walks = self.walks_for(item);
        self.play(steps, stream, activity.label());
        self.watches.does(activity.label(), self.now, &self.life);
        if let Some(playing) = self.scripts.last_mut() {
            playing.walks = walks;
        }
    }

    /// What the ways of something are walked for. Who sits down after an errand comes back from it.
    fn walks_for(&mut self, item: &Item) -> Walks {
        let was_errand = std::mem::take(&mut self.was_errand);
        match item.activity {
            Activity::Housework if item.is_errand() => {
                self.errands.run();
                self.was_errand = true;
                Walks::Errand
            }
            Activity::Prepare(_) | Activity::Housework => Walks::Cooking,
            Activity::Wander | Activity::Pace | Activity::Lap => Walks::Roaming,
            _ if item.is_filler() && was_errand => Walks::Back,
            _ => Walks::Need,
        }
    }

    pub(super) fn play(&mut self, mut steps: VecDeque<Step>, stream: Stream, name: &str) {
        for step in steps.iter_mut().filter(|_| self.life.numbers.are_set()) {
            if let Step::Stay(stay) = step {
                stay.manner = stay.manner.by(&self.life.numbers);
            }
        }
        let spot = None;
        // What is interrupted is resumed where it is.
        let here = self.body.spot().cloned();
        if let Some(below) = self.scripts.last_mut() {
            below.spot = below.spot.take().or(here);
        }
        self.scripts.push(Playing {
            steps,
            stream,
            label: name.into(),
            name: name.into(),
            spot,
            is_interrupted: false,
            of: None,
            since: 0,
            walks: Walks::Need,
            gives_way: false,
            is_essential: false,
            answers: None,
            still: Vec::new(),
            stirs: true,
        });
    }

    /// How many times today something was done that nobody planned: each time has random numbers of its own, whatever else
    /// was done. What fills the time is counted as relaxing.
    pub(super) fn times(&mut self, activity: &Activity) -> u32 {
        let times = self.unplanned.entry(activity.clone()).or_default();
        *times += 1;
        *times
    }

    /// Nothing is being done: what is next?
    fn decide(&mut self, now: Micros) {
        if now >= self.agenda.next_up {
            // The night was spent elsewhere.
            self.begin_day(now);
        }
        if self.interrupted_at(now) <= now {
            let before = self.next_break;
            self.interrupt(now);
            if !self.scripts.is_empty() || self.next_break != before {
                return;
            }
        }
        // What is too late, or would be over before it has begun, is left out.
        let is_over = |item: &Item| item.latest < now || item.until.is_some_and(|until| until < now + 5 * MINUTE);
        // What nobody says keeps nobody from going to bed.
        let bed = self.agenda.bed + GRACE;
        let is_too_long =
            |item: &Item| item.is_unsaid && !item.is_essential() && item.start.max(now) + item.lasts > bed;
        let is_past = |item: &Item| is_over(item) || is_too_long(item);
        while self.agenda.items.get(self.next_item).is_some_and(is_past) {
            self.next_item += 1;
        }
        self.let_the_said_go_first(now);
        let next = self.agenda.items.get(self.next_item).cloned();
        if now >= self.agenda.bed && next.as_ref().is_none_or(|item| !item.can_wait_for_bed(self.agenda.bed)) {
            return self.go_to_bed(now);
        }
        match next {
            Some(item) if item.start <= now + MINUTE => {
                self.next_item += 1;
                self.begin_at(&item, now);
            }
            Some(item) => self.fill(item.start.min(self.agenda.bed), now),
            None => self.fill(self.agenda.bed, now),
        }
    }

    /// The time of day, in hours.
    pub(super) fn hour(&self, now: Micros) -> f64 {
        (now - self.midnight).rem_euclid(DAY) as f64 / (3600 * SECOND) as f64
    }

    fn meet(&mut self, need: Need, now: Micros) {
        let before = self.needs.meet(need, now);
        self.ready.push_back(Next::Need(need, before));
        self.ready.push_back(Next::Need(need, 0.0));
    }
}

/// Longest visit without a meal of the host alone (our choice).
const SHORT_VISIT: Micros = 45 * MINUTE;

/// Largest delay of a meal before it interrupts an activity of leisure (our choice).
pub(super) const GRACE: Micros = 10 * MINUTE;

impl Item {
    /// Whether it is still done before bed although it is late.
    fn can_wait_for_bed(&self, bed: Micros) -> bool {
        self.start < bed && self.lasts <= 20 * MINUTE
    }
}

impl Driver for RoutineDriver {
    fn next(&mut self, around: &Surroundings) -> Next {
        self.company.look(around, &self.places);
        self.look(around);
        match self.held_back(around.now()) {
            Some(next) => next,
            None => {
                let next = self.step(around.now());
                self.hold_back(next)
            }
        }
    }

    fn falls(&mut self, around: &Surroundings, lies: Micros) -> bool {
        self.fall_now(around, lies)
    }

    fn copy(&self) -> Box<dyn Driver> {
        Box::new(self.clone())
    }

    fn as_any(&self) -> Option<&dyn Any> {
        Some(self)
    }
}
