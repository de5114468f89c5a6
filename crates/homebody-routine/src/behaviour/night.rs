//! The night: going to bed, falling asleep, waking, rising.

use super::agenda::Agenda;
use super::chores::mail_hour;
use super::defaults;
use super::driver::{GRACE, RoutineDriver};
use super::item::Item;
use super::manner::Manner;
use super::places::HomePlace;
use super::rising;
use super::script::{ActivityStep, Interruptible, StayStep};
use crate::routine::{Activity, PartOfDay};
use homebody_core::activity::SLEEPING;
use homebody_core::drivers::Next;
use homebody_core::event::{BodilyNeed, Vitals};
use homebody_core::posture::Posture;
use homebody_core::role::Role;
use homebody_core::time::{HOUR, MINUTE, RunTime, Span};
use std::collections::VecDeque;

homebody_core::numbers! {
    /// Mean time to fall asleep (19.7 with a standard deviation of 11, polysomnography at 73.9 years).
    static LATENCY_MIN = "night.latency": 19.7, "min", [0.5, 180.0];
    /// Shape of the gamma distribution of the time to fall asleep.
    static LATENCY_SHAPE = "night.latency_shape": 3.2, "1", [0.5, 50.0];
    /// Mean duration of one period awake at night.
    static AWAKE_BOUT_MIN = "night.awake_bout": 10.0, "min", [1.0, 120.0];
}

/// Delay of getting up after which the person was not at home for the activities before it (our choice).
const LATE: Span = HOUR.times(2);

impl RoutineDriver {
    pub(super) fn go_to_bed(&mut self, now: RunTime) {
        self.pass_over(self.agenda.items.len().saturating_sub(self.next_item), now);
        if let Some(of) = self.agenda.bed_of {
            let due = self.agenda.bed.max(self.agenda.bed_by);
            let bed = Item { of: Some(of), start: due, ..Item::now("bed".into(), Activity::GoToBed, Span::ZERO) };
            self.tally.plan_item(&bed);
            self.tally.begin(&bed, now);
        }
        if self.agenda.bathroom_last {
            let bathroom = defaults::length(&Activity::UseBathroom, &self.life.numbers);
            let mut stream = self.life.stream_of_day(self.agenda.day, "before bed");
            let lasts = stream.lognormal(bathroom.median_min * 60.0, 0.4);
            self.begin(&Item::now("before bed".into(), Activity::UseBathroom, Span::from_seconds(lasts)));
        }
        self.sleep(now, false);
        // There is nothing to return to before the night.
        self.scripts.reverse();
    }

    /// Steps of the night: falling asleep, waking now and then, rising.
    pub(super) fn sleep(&mut self, now: RunTime, already: bool) {
        let mut stream = self.life.stream_of_day(self.agenda.day, "night");
        let tomorrow = self.agenda.day + 1;
        self.slept_in = if already { Span::ZERO } else { self.sleeps_in(now) };
        self.agenda.next_up += self.slept_in;
        let up = rising::up(&self.life, tomorrow, &self.life.parameters(tomorrow)) + self.slept_in;
        let up = self.woken_at(tomorrow, up, now).max(now + MINUTE);
        // A change that begins tomorrow does not affect tonight.
        let usual_up = rising::up(&self.life, tomorrow, &self.parameters) + self.slept_in;
        let stay = |manner, left, until| {
            ActivityStep::Stay(StayStep { posture: Posture::Lying, manner, left, until, may: Interruptible::Interrupt })
        };
        let mut steps = VecDeque::new();
        let mut asleep = now;
        if !already {
            steps.push_back(ActivityStep::Name(Activity::GoToBed.label().into()));
            // On the edge of the bed first.
            let edge =
                self.places.for_role(Role::Bed).map(|bed| HomePlace { posture: Posture::Sitting, ..bed.clone() });
            steps.extend(edge.map(ActivityStep::Go));
            let sitting = Span::from_seconds(stream.lognormal(75.0, 0.4));
            let turning = StayStep {
                posture: Posture::Sitting,
                manner: Manner::TURNING,
                left: sitting,
                until: Some(up),
                may: Interruptible::Nothing,
            };
            steps.push_back(ActivityStep::Stay(turning));
            steps.push_back(ActivityStep::LieDown);
            let [shape, mean_min] = [&LATENCY_SHAPE, &LATENCY_MIN].map(|number| self.life.numbers.of(number));
            let latency = Span::from_seconds(stream.gamma(shape, mean_min * 60.0));
            steps.push_back(stay(Manner::AWAKE_IN_BED, latency, Some(up)));
            asleep += sitting + latency;
        } else {
            steps.push_back(ActivityStep::LieDown);
        }
        // A stated frequency of lying awake replaces random wakings, also in the nights without.
        let is_said =
            [true, false].iter().any(|&night| self.life.says_how_often(&Activity::LieAwake, self.agenda.day, night));
        let often = self.parameters.oftener(&Activity::LieAwake, Some(PartOfDay::Night));
        let awake_min = if is_said { 0.0 } else { self.life.constitution.awake_min * often };
        let bout_min = self.life.numbers.of(&AWAKE_BOUT_MIN);
        let mut wakings: Vec<f64> = (0..stream.poisson(awake_min / bout_min)).map(|_| stream.unit()).collect();
        wakings.sort_by(f64::total_cmp);
        for share in wakings {
            let at = asleep + (usual_up - asleep).max(Span::ZERO).share(share);
            steps.push_back(ActivityStep::Name(SLEEPING.into()));
            steps.push_back(stay(Manner::ASLEEP, Span::MAX / 4, Some(at)));
            steps.push_back(ActivityStep::Name(Activity::LieAwake.label().into()));
            steps.push_back(stay(
                Manner::AWAKE_IN_BED,
                Span::from_seconds(stream.gamma(2.0, bout_min * 60.0)),
                Some(up),
            ));
        }
        steps.push_back(ActivityStep::Name(SLEEPING.into()));
        steps.push_back(stay(Manner::ASLEEP, Span::MAX / 4, Some(up)));
        steps.push_back(ActivityStep::Wake);
        self.play(steps, stream, SLEEPING);
    }

    /// Delay of rising after a late bedtime.
    fn sleeps_in(&self, now: RunTime) -> Span {
        let by = self.parameters.sleeps_in;
        if by == 0.0 {
            return Span::ZERO;
        }
        rising::late_by(&self.life, self.agenda.day, self.agenda.up, now).share(by)
    }

    pub(super) fn meet(&mut self, need: BodilyNeed, now: RunTime) {
        let before = self.needs.meet(need, now);
        self.ready.push_back(Next::Need(need, before));
        self.ready.push_back(Next::Need(need, 0.0));
    }

    pub(super) fn lie_down(&mut self, now: RunTime) {
        self.needs.sleeping(now, &self.life, &self.agenda, &self.parameters);
        self.put_out_the_lamp(now);
        self.watches.lie_down(now, &self.life);
        let mut stream = self.life.stream_of_day(self.agenda.day, "vitals");
        let body = &self.life.constitution;
        self.ready.push_back(Next::Vitals(Vitals {
            pulse: body.pulse + self.parameters.pulse + stream.normal(0.0, 2.0),
            respiration: body.respiration + self.parameters.respiration + stream.normal(0.0, 0.5),
        }));
    }

    pub(super) fn wake(&mut self, now: RunTime) {
        self.end_night(now);
        self.begin_day(now);
        let day = self.agenda.day;
        // On top of the night, which ends here.
        if self.agenda.bathroom_first {
            let bathroom = Span::from_seconds(self.life.stream_of_day(day, "first thing").lognormal(300.0, 0.5));
            self.begin(&Item::now("first thing".into(), Activity::UseBathroom, bathroom));
        }
        let rising = Span::from_seconds(self.life.stream_of_day(day, "rising").lognormal(120.0, 0.4));
        self.agenda.rise(now + rising);
        self.begin(&Item::now("rising".into(), Activity::GetUp, rising));
    }

    /// Reports the severity of each condition, and the end of past ones.
    pub(super) fn tell_conditions(&mut self) {
        let now = &self.parameters.severities;
        let over = self.shown.iter().filter(|name| now.iter().all(|(of, _)| of != *name));
        let over: Vec<(String, f64)> = over.map(|name| (name.clone(), 0.0)).collect();
        for (name, severity) in over.iter().chain(now) {
            self.ready.push_back(Next::Condition(name.clone(), *severity));
        }
        self.shown = now.iter().map(|(name, _)| name.clone()).collect();
    }

    /// Plans the next day, or today after days away.
    pub(super) fn begin_day(&mut self, now: RunTime) {
        let mut day = self.agenda.day + 1;
        let is_over = |day: i32| rising::up(&self.life, day + 1, &self.life.parameters(day)) <= now;
        while is_over(day) {
            day += 1;
        }
        let was_away = day > self.agenda.day + 1 || now > self.agenda.next_up + LATE;
        self.tally.plan(&self.agenda, self.first_item);
        self.parameters = self.life.parameters(day);
        self.parameters.slept_in = if day == self.agenda.day + 1 { self.slept_in } else { Span::ZERO };
        self.agenda = Agenda::new(&self.life, day, &self.parameters);
        self.leave_out_after_good_nights();
        self.places = rising::places_of_night(&self.usual_places, self.agenda.sleeps_at.as_deref());
        self.keep_to_range();
        self.midnight = self.life.midnight(day);
        self.next_item = if was_away { self.agenda.items.partition_point(|item| item.start < now) } else { 0 };
        self.first_item = self.next_item;
        // A meal that was cooked too late stays uneaten.
        self.served = None;
        self.life.changes(day).for_each(|change| self.tally.hold(change));
        self.unplanned.clear();
        self.errands.wake();
        // One resident of a household fetches it.
        let mail = self.life.stream_of_day(day, "mail");
        self.mail_hour = (self.host.index() == 0).then(|| mail_hour(&mut { mail }, &self.life.numbers));
        self.next_break = self.agenda.breaks.partition_point(|item| item.start < now);
        self.plan_turnings(now);
        self.tell_conditions();
        self.needs.waking(now, &self.life, day, &self.parameters);
        self.needs.wake(now);
        self.watches.wake(day, &self.life);
    }
}

impl Agenda {
    /// Activities after the rising follow the actual one, also if it is early.
    pub(super) fn rise(&mut self, over: RunTime) {
        let late = over - self.up - MINUTE;
        let late = if late < -GRACE { late } else { late.max(Span::ZERO) };
        for item in self.items.iter_mut().filter(|item| self.mornings.contains(&item.key)) {
            (item.start, item.latest) = (item.start + late, item.latest + late);
        }
        self.items.sort_by_key(|item| item.start);
    }
}
