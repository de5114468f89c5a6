//! The driver of a resident with a routine: follows the day's plan, interrupts it for needs and rules, and moves the body.
//!
//! Three layers decide, the higher over the lower (Brooks 1986): pressing needs, rules and external events interrupt; the
//! plan of the day gives the next activity; otherwise spare time is filled. An interrupted activity continues where it was.

use super::agenda::Agenda;
use super::body::WalkingBody;
use super::chores::{self, Errand};
use super::company::Company;
pub(super) use super::current_activity::{ActivityPart, BlockedWay, Playing, SleepRecord, VisitorStay, WalkPurpose};
use super::errands::Errands;
use super::item::{Following, HeldThing, Item};
use super::manner::Manner;
use super::needs::BodilyNeeds;
use super::places::{HomePlace, HomePlaces};
use super::resident_routine::{DayParameters, ResidentRoutine};
use super::rising::places_of_night;
use super::script::{ActivitySetting, ActivityStep, Interruptible, STAYING_OVER, script};
use super::tally::SentenceTally;
use super::watch::{WatchInput, Watches};
use crate::routine::Activity;
use homebody_core::drivers::{Driver, Next, Surroundings};
use homebody_core::home::Home;
use homebody_core::ids::ResidentId;
use homebody_core::motion::{MotionSegment, MotionState};
use homebody_core::posture::Posture;
use homebody_core::random::Stream;
use homebody_core::role::Role;
use homebody_core::time::{MINUTE, RunTime, SECOND, Span};
use homebody_walk::Wanderers;
use std::any::Any;
use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;

#[derive(Clone, Debug)]
pub struct RoutineDriver {
    pub(super) life: Arc<ResidentRoutine>,
    pub(super) home: Arc<Home>,
    /// With tonight's place of sleep as the bed.
    pub(super) places: Arc<HomePlaces>,
    pub(super) usual_places: Arc<HomePlaces>,
    pub(super) body: WalkingBody,
    pub(super) parameters: DayParameters,
    pub(super) agenda: Agenda,
    pub(super) next_item: usize,
    pub(super) next_break: usize,
    /// Index of the first item that was still ahead when the plan was made.
    pub(super) first_item: usize,
    /// The current activity on top of the interrupted ones.
    pub(super) scripts: Vec<Playing>,
    /// Answers that need no decision: strides of a walk, facts.
    pub(super) ready: VecDeque<Next>,
    /// The activity last reported, and the current one: those without duration are not reported.
    pub(super) told: String,
    pub(super) name: String,
    pub(super) part: ActivityPart,
    pub(super) needs: BodilyNeeds,
    pub(super) watches: Watches,
    /// Number of unplanned repetitions today.
    pub(super) unplanned: BTreeMap<Activity, u32>,
    /// The conditions last reported.
    pub(super) shown: Vec<String>,
    pub(super) errands: Errands,
    /// By sentence.
    pub(super) tally: SentenceTally,
    /// Whether an errand filled the last spare time.
    pub(super) was_errand: bool,
    /// The hour after which the mail is fetched, until it is.
    pub(super) mail_hour: Option<f64>,
    /// Hour of the day at the start of the last activity.
    pub(super) hour_now: f64,
    /// Delay of rising after a late night.
    pub(super) slept_in: Span,
    /// Instant of the last question.
    pub(super) now: RunTime,
    /// End of the last meal or medicine: activities right after it are not delayed.
    pub(super) at_table: RunTime,
    /// Key of the meal that has just been cooked.
    pub(super) served: Option<String>,
    /// The start of the day's hours.
    pub(super) midnight: RunTime,
    /// The name of a visitor; `None` for a resident.
    pub(super) visitor: Option<String>,
    /// The resident of the routine; for a visitor, the host.
    pub(super) host: ResidentId,
    pub(super) company: Company,
    /// The present visit of a visitor.
    pub(super) stay: VisitorStay,
    /// Number of bodies before this one in the scenario.
    pub(super) rank: u32,
    pub(super) blocked: BlockedWay,
    pub(super) sight: WatchInput,
    /// Things that are kept on.
    pub(super) held: Vec<HeldThing>,
    pub(super) nights: SleepRecord,
    /// Since the last rest.
    pub(super) walked_m: f64,
}

impl RoutineDriver {
    /// A resident in bed before rising, else up.
    pub fn new(
        life: Arc<ResidentRoutine>,
        home: Arc<Home>,
        places: Arc<HomePlaces>,
        mut body: WalkingBody,
        host: ResidentId,
        company: Company,
    ) -> RoutineDriver {
        let parameters = life.parameters(0);
        let today = Agenda::new(&life, 0, &parameters);
        let in_bed = today.up > RunTime::START || today.bed < RunTime::START;
        let agenda = if today.up > RunTime::START { Agenda::new(&life, -1, &life.parameters(-1)) } else { today };
        let role = if in_bed { Role::Bed } else { Role::Armchair };
        let rank = host.0;
        let usual_places = places;
        let places = places_of_night(&usual_places, agenda.sleeps_at.as_deref());
        if let Some(spot) = places.for_role(role) {
            let at = spot.sides_for(rank as usize, company.shares_home()).next().unwrap_or(spot.at);
            let spot = HomePlace { at, ..spot.clone() };
            let posture = if in_bed { Posture::Lying } else { spot.posture };
            body.place(spot, posture);
        }
        let needs = BodilyNeeds::new(&life, RunTime::START);
        let is_past = |item: &Item| item.start < RunTime::START;
        let first_item = if in_bed { agenda.items.len() } else { agenda.items.partition_point(is_past) };
        let mut driver = RoutineDriver {
            next_item: first_item,
            next_break: agenda.breaks.partition_point(is_past),
            first_item,
            watches: Watches::new(&life, agenda.day),
            scripts: Vec::new(),
            ready: VecDeque::new(),
            told: String::new(),
            name: String::new(),
            part: ActivityPart::Itself,
            unplanned: BTreeMap::new(),
            shown: Vec::new(),
            midnight: life.midnight(agenda.day),
            visitor: None,
            host,
            company,
            stay: VisitorStay::default(),
            rank,
            blocked: BlockedWay::default(),
            sight: WatchInput::default(),
            held: Vec::new(),
            nights: SleepRecord::default(),
            walked_m: 0.0,
            errands: Errands::new(),
            tally: SentenceTally::default(),
            was_errand: false,
            mail_hour: None,
            hour_now: 0.0,
            slept_in: Span::ZERO,
            now: RunTime::START,
            at_table: RunTime::MIN,
            served: None,
            needs,
            agenda,
            parameters,
            body,
            places,
            usual_places,
            home,
            life,
        };
        driver.keep_to_range();
        driver.plan_turnings(RunTime::START);
        driver.tell_conditions();
        driver.needs.waking(RunTime::START, &driver.life, driver.agenda.day, &driver.parameters);
        if in_bed {
            driver.sleep(RunTime::START, true);
        }
        driver
    }

    /// A visitor of the resident with this routine.
    pub fn visitor(
        life: Arc<ResidentRoutine>,
        home: Arc<Home>,
        places: Arc<HomePlaces>,
        body: WalkingBody,
        (visitor, host, name): (ResidentId, ResidentId, &str),
        company: Company,
    ) -> RoutineDriver {
        let mut driver = RoutineDriver::new(life, home, places, body, host, company);
        driver.rank = visitor.0;
        (driver.scripts, driver.ready, driver.visitor) = (Vec::new(), VecDeque::new(), Some(name.into()));
        // The host's rules and conditions do not apply to visitors.
        (driver.watches, driver.parameters) = (Watches::none(), DayParameters::ordinary());
        driver.places = driver.usual_places.clone();
        driver
    }

    pub fn tally(&self) -> &SentenceTally {
        &self.tally
    }

    pub fn is_visitor(&self) -> bool {
        self.visitor.is_some()
    }

    /// The resident of the routine; for a visitor, the host.
    pub fn host(&self) -> ResidentId {
        self.host
    }

    pub fn life(&self) -> &ResidentRoutine {
        &self.life
    }

    fn step(&mut self, now: RunTime) -> Next {
        (self.now, self.hour_now) = (now, self.hour(now));
        loop {
            self.make_way(now);
            if let Some(next) = self.ready.front() {
                // The use of a thing takes no time, so a row that begins with it could end with it.
                if matches!(next, Next::Segment(_)) && self.told != self.label() {
                    self.told = self.label().to_owned();
                    return Next::Activity((!self.told.is_empty()).then(|| self.told.clone()));
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
            let is_next = playing.is_interrupted && {
                let is_open = playing.may_be_interrupted();
                self.essential().is_some_and(|(_, due)| due <= now) || is_open && self.next_break_at(now) <= now
            };
            let is_interrupted = self.scripts.last().is_some_and(|playing| playing.is_interrupted);
            if is_next {
                // Between cooking and eating, or two deeds of a night, the interrupted activity does not continue.
                self.interrupt(now);
                continue;
            }
            if is_interrupted && self.bell_at(now) <= now {
                self.answer_the_bell(now);
                continue;
            }
            self.end_visit_without_guest();
            let Some(playing) = self.scripts.last_mut() else { continue };
            if playing.until.is_some_and(|until| until <= now) {
                playing.end_early(|thing| self.watches.is_on(thing));
            }
            if std::mem::take(&mut playing.is_interrupted) && !playing.steps.is_empty() {
                if let Some(back) = playing.spot.clone() {
                    playing.steps.push_front(ActivityStep::Go(back));
                }
                playing.steps.push_front(ActivityStep::Name(playing.name.clone()));
            }
            match playing.steps.front() {
                None => self.end_script(now),
                Some(ActivityStep::Stay(_) | ActivityStep::Wait(_)) => self.stay(now),
                Some(_) => {
                    if let Some(step) = playing.steps.pop_front() {
                        self.take(step, now);
                    }
                }
            }
        }
    }

    /// Continues the activity that the ended one interrupted.
    pub(super) fn end_script(&mut self, now: RunTime) {
        let (mut still, mut is_meanwhile, mut passed) = (None, false, Span::ZERO);
        if let Some(over) = self.scripts.pop() {
            (is_meanwhile, passed) = (over.is_meanwhile, now - over.since);
            self.tally.end(over.of, over.own_time(now), now);
            still = over.answers.map(|rank| (rank, over.still)).filter(|(_, still)| !still.is_empty());
            self.watches.has_done(&over.label, now, &self.life);
            if let Some(below) = self.scripts.last_mut().filter(|_| over.of.is_some()) {
                below.paused += passed;
            }
            if over.is_essential {
                self.at_table = now;
            }
            // The host cleans up after a stay.
            if self.visitor.is_none() {
                self.let_follow(over.of, &over.label, now);
            }
        }
        self.watches.leave_behind();
        if is_meanwhile {
            self.pass_meanwhile(passed);
        }
        if let Some((rank, still)) = still {
            return self.go_on_answering(rank, still, now);
        }
        if let Some(below) = self.scripts.last_mut() {
            below.is_interrupted = !below.steps.is_empty();
        }
    }

    /// Takes a step other than a stay.
    fn take(&mut self, step: ActivityStep, now: RunTime) {
        self.set_part(&step);
        match step {
            ActivityStep::Name(name) => {
                if let Some(playing) = self.scripts.last_mut() {
                    playing.name.clone_from(&name);
                }
                self.note_sleep(&name, now);
                self.name = name;
            }
            ActivityStep::Go(spot) => self.go(spot, now),
            ActivityStep::Act(thing, on) if self.is_done_by_other(thing, on) => {}
            ActivityStep::Act(thing, on) => self.act(thing, on, now),
            ActivityStep::Away { lasts, until } => self.away(lasts, until, now),
            ActivityStep::Wander { kind, lasts } => {
                let hour = self.hour(now);
                let others = self.company.places();
                let who = Wanderers { gains: self.parameters.gains(self.life.gains), others: &others };
                if let Some(playing) = self.scripts.last_mut() {
                    let moves =
                        self.body.wander(kind, lasts, now, hour, self.parameters.pace, who, &mut playing.stream);
                    self.ready.extend(moves.into_iter().map(Next::Segment));
                }
            }
            ActivityStep::LieDown => self.lie_down(now),
            ActivityStep::Meet(need) => self.meet(need, now),
            ActivityStep::Wake => self.wake(now),
            ActivityStep::Await { guest, left } => self.await_visitor(guest, left),
            ActivityStep::Ring { left } => self.ring(left, now),
            ActivityStep::AwaitMeal { left } => self.await_meal(left),
            ActivityStep::AlongFloor { to, mps } => self.along_floor(to, mps, now),
            ActivityStep::LieUntilFound { left } => self.lie_until_found(left),
            ActivityStep::KeepCompany => self.keep_company(now),
            ActivityStep::Depart { left } => self.depart(left),
            ActivityStep::Stay(_) | ActivityStep::Wait(_) => {}
        }
    }

    /// Stays with movements and rests until an end or an interruption.
    fn stay(&mut self, now: RunTime) {
        let interrupted_at = self.interrupted_at(now);
        let rules_at = self.rules_at().min(self.accident_at()).max(now);
        let breaks_at = self.breaks_into_cooking_at(now);
        let next_start =
            self.agenda.items.get(self.next_item).map_or(self.agenda.bed, |item| item.start.min(self.agenda.bed));
        let active = self.activity(now);
        let bell_at = self.bell_at(now);
        let is_left_alone = self.is_host_away();
        let Some(playing) = self.scripts.last_mut() else { return };
        if is_left_alone {
            // Only the way out remains.
            let out = playing.steps.iter().rposition(|step| matches!(step, ActivityStep::Go(_))).unwrap_or(0);
            playing.steps.drain(..out);
            playing.steps.retain(|step| !matches!(step, ActivityStep::Stay(_) | ActivityStep::Wait(_)));
            return;
        }
        let Some(ActivityStep::Stay(stay) | ActivityStep::Wait(stay)) = playing.steps.front_mut() else { return };
        let ends = [stay.until, playing.until].into_iter().flatten();
        let mut end = ends.fold(now.saturating_add(stay.left), RunTime::min);
        if stay.may == Interruptible::Yield {
            end = end.min(next_start).min(bell_at);
        }
        if end <= now {
            playing.steps.pop_front();
            return;
        }
        let interrupted_at = match stay.may {
            Interruptible::Nothing => RunTime::NEVER,
            Interruptible::Rules => rules_at,
            Interruptible::Breaks => rules_at.min(breaks_at),
            Interruptible::Interrupt | Interruptible::Yield => interrupted_at,
        };
        let hears_the_bell = match stay.may {
            Interruptible::Nothing | Interruptible::Yield => false,
            Interruptible::Rules => playing.hears_the_bell,
            Interruptible::Breaks | Interruptible::Interrupt => true,
        };
        if hears_the_bell && bell_at <= now {
            return self.answer_the_bell(now);
        }
        let interrupted_at = if hears_the_bell { interrupted_at.min(bell_at) } else { interrupted_at };
        if interrupted_at < RunTime::NEVER {
            if interrupted_at <= now {
                return self.interrupt(now);
            }
            end = end.min(interrupted_at);
        }
        let active = active(&stay.manner);
        let is_wait = matches!(playing.steps.front(), Some(ActivityStep::Wait(_)));
        (playing.is_there, self.part) = match is_wait {
            true => (playing.is_there, ActivityPart::Wait),
            false => (true, ActivityPart::Itself),
        };
        let Some(ActivityStep::Stay(stay) | ActivityStep::Wait(stay)) = playing.steps.front_mut() else { return };
        let span = match playing.stirs {
            true => stay.manner.bout(&mut playing.stream),
            false => stay.manner.gap(active.max(1.0), &mut playing.stream),
        };
        // Less active residents skip movements.
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
        self.rest_for(until - now);
    }

    /// Factor on the usual movement now, by manner.
    fn activity(&self, now: RunTime) -> impl Fn(&Manner) -> f64 + use<> {
        let (restless, awake) = (self.parameters.restless, self.parameters.activity(self.hour(now)));
        move |manner| if manner.is_in_bed() { restless } else { awake }
    }

    /// Begins a planned activity.
    pub(super) fn begin_at(&mut self, item: &Item, now: RunTime) {
        self.tally.begin(item, now);
        // The time left until its end.
        let lasts = item.until.map_or(item.lasts, |until| (until - now).max(SECOND));
        // Visitors leave on time, whatever delayed the host.
        let is_visit = item.activity == Activity::Visit && lasts < STAYING_OVER;
        let until = if is_visit { Some(now.saturating_add(lasts)) } else { item.until };
        self.begin(&Item { lasts, until, ..item.clone() });
        let gives_way = item.gives_way(lasts);
        if let Some(playing) = self.scripts.last_mut() {
            (playing.of, playing.since) = (item.of, now);
            (playing.gives_way, playing.is_essential) = (gives_way, item.is_essential());
            let is_firm = item.has_its_time && !item.waits && item.visitor.is_none();
            playing.goes_with = item.follows.filter(|follows| follows.how == Following::With).map(|with| with.of);
            playing.undisturbed = if is_firm { now + UNDISTURBED } else { RunTime::MIN };
            playing.is_meanwhile = item.is_meanwhile;
        }
        self.begin_meanwhile(item, now);
    }

    /// Begins an activity on top of the current one.
    pub(super) fn begin(&mut self, item: &Item) {
        let Item { key, activity, lasts, until, .. } = item;
        let guest = self.guest_of(item);
        let place = self.place_of(item);
        let place = place.as_ref();
        let mut stream = self.life.stream_of_day(self.agenda.day, &format!("{key}/doing"));
        let mut forgotten = Vec::new();
        for (name, chance) in self.parameters.forgotten() {
            let mut stream = self.life.stream_of_day(self.agenda.day, &format!("{key}/forgets/{name}"));
            let thing = self.places.thing_named(name);
            forgotten.extend(thing.filter(|_| stream.chance(chance)));
        }
        let left = forgotten.clone();
        let movement = self.parameters.activity(self.hour_now);
        let spared = self.parameters.spares.iter().filter_map(|name| self.places.thing_named(name)).collect();
        let (places, at) = (&self.places, self.body.at());
        let mut setting = ActivitySetting { places, at, stream: &mut stream, forgotten, spared, movement };
        let mut steps = match item.is_errand() {
            true => {
                let is_mail = self.mail_hour.take_if(|hour| *hour <= self.hour_now).is_some();
                chores::errand(if is_mail { Errand::Mail } else { Errand::Any }, *lasts, &mut setting)
            }
            false if *activity == Activity::Fall => self.fall_steps(item, place, &mut setting),
            false if *activity == Activity::Visit => self.visit_steps(item, guest, &mut setting),
            false => script(activity, place, *lasts, *until, &mut setting),
        };
        let first = match activity {
            Activity::Wander | Activity::Pace | Activity::Lap => place.cloned(),
            Activity::Stumble => place.cloned().or_else(|| self.station(&mut setting)),
            _ => None,
        };
        if let Some(first) = first {
            steps.push_front(ActivityStep::Go(first));
        }
        self.turn_on_meanwhile(item, &left, &mut steps);
        if let Some(turning) = item.turns {
            steps.truncate(1);
            steps.extend(self.turning_steps(turning));
        }
        self.watches.forget(left);
        let walks = self.walks_for(item);
        // An outing and a visit have steps after their end.
        let has_a_way_out = steps.iter().any(ActivityStep::is_before_way_out);
        self.play(steps, stream, activity.label());
        self.watches.does(activity.label(), self.now, &self.life);
        if let Some(playing) = self.scripts.last_mut() {
            (playing.walks, playing.guest) = (walks, guest);
            playing.until = until.filter(|_| !has_a_way_out);
            playing.hears_the_bell = matches!(activity, Activity::Eat(_) | Activity::Nap);
        }
    }

    pub(super) fn play(&mut self, mut steps: VecDeque<ActivityStep>, stream: Stream, name: &str) {
        for step in steps.iter_mut().filter(|_| self.life.numbers.are_set()) {
            if let ActivityStep::Stay(stay) = step {
                stay.manner = stay.manner.with_numbers(&self.life.numbers);
            }
        }
        // An interrupted activity resumes at its place.
        let here = self.body.spot().cloned();
        if let Some(below) = self.scripts.last_mut() {
            below.spot = below.spot.take().or(here);
        }
        self.scripts.push(Playing::new(steps, stream, name));
    }

    /// Counts unplanned repetitions, so that each has its own random numbers. Spare time counts as relaxing.
    pub(super) fn times(&mut self, activity: &Activity) -> u32 {
        let times = self.unplanned.entry(activity.clone()).or_default();
        *times += 1;
        *times
    }

    /// Decides on the next activity.
    fn decide(&mut self, now: RunTime) {
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
        if self.bell_at(now) <= now {
            return self.answer_the_bell(now);
        }
        // Activities that are too late, or would end before they begin, are dropped.
        let is_over = |item: &Item| {
            item.latest < now
                || item.until.is_some_and(|until| until < now + 5 * MINUTE)
                || self.has_been_missed(item, now)
        };
        // Unstated activities do not delay bedtime.
        let bed = self.agenda.bed + GRACE;
        let is_too_long =
            |item: &Item| item.is_unsaid && !item.is_essential() && item.start.max(now) + item.lasts > bed;
        let is_past = |item: &Item| is_over(item) || is_too_long(item);
        let rest = self.agenda.items.iter().skip(self.next_item);
        let past = rest.take_while(|item| is_past(item)).count();
        self.pass_over(past, now);
        self.wait_for_others(now);
        self.let_both_be_in_time(now);
        self.prefer_stated(now);
        self.serve(now);
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
}

/// Time that a stated activity at its time has before a meal that no sentence states interrupts it (our choice).
const UNDISTURBED: Span = MINUTE.times(90);

/// Largest delay of a meal before it interrupts an activity of leisure (our choice).
pub(super) const GRACE: Span = MINUTE.times(10);

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

    fn falls(&mut self, around: &Surroundings, lies: Span) -> bool {
        self.fall_now(around, lies)
    }

    fn copy(&self) -> Box<dyn Driver> {
        Box::new(self.clone())
    }

    fn as_any(&self) -> Option<&dyn Any> {
        Some(self)
    }
}
