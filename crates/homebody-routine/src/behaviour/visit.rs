//! Visitors: out until a visit that the host's routine plans, then at the door, on a seat, and out again.

use super::agenda::Agenda;
use super::driver::RoutineDriver;
use super::manner::Manner;
use super::places::HomePlace;
use super::script::{ActivitySetting, ActivityStep, Interruptible, STAYING_OVER, StayStep, script};
use crate::routine::Activity;
use homebody_core::activity::{SLEEPING, VISITING};
use homebody_core::drivers::Next;
use homebody_core::motion::{MotionSegment, MotionState};
use homebody_core::posture::Posture;
use homebody_core::random::Stream;
use homebody_core::role::Role;
use homebody_core::time::{DAY, HOUR, MINUTE, RunTime, SECOND, Span};
use std::collections::VecDeque;

/// Time that a visitor waits for the door to open before leaving (our choice): hosts are on the toilet, or on their way
/// home.
const PATIENCE: Span = HOUR;

impl RoutineDriver {
    pub(super) fn await_visit(&mut self, now: RunTime) {
        let name = self.visitor.clone();
        for _ in 0..400 {
            let visit =
                self.agenda.items.iter().skip(self.next_item).position(|item| item.visitor == name && item.start > now);
            if let Some(visit) = visit {
                self.next_item += visit + 1;
                return self.come_to_visit(self.next_item - 1);
            }
            let day = self.agenda.day + 1;
            self.agenda = Agenda::new(&self.life, day, &self.life.parameters(day));
            self.midnight = self.life.midnight(day);
            self.next_item = 0;
        }
        let end = now.saturating_add(30 * DAY);
        self.ready.push_back(Next::Segment(MotionSegment {
            begin: now,
            end,
            doing: MotionState::Away,
            posture: Posture::Standing,
        }));
    }

    pub(super) fn come_to_visit(&mut self, item: usize) {
        let item = self.agenda.items[item].clone();
        let mut stream = self.life.stream_of_day(self.agenda.day, &format!("{}/visitor", item.key));
        let door = self.places.for_role(Role::FrontDoor).cloned();
        if let Some(door) = &door {
            self.body.place(door.clone(), Posture::Standing);
        }
        self.stays_over = item.lasts >= STAYING_OVER;
        let begin = item.start;
        let mut steps = VecDeque::from([
            ActivityStep::Away { lasts: Span::ZERO, until: Some(begin) },
            ActivityStep::Ring { left: PATIENCE },
        ]);
        steps.push_back(ActivityStep::Name(VISITING.into()));
        steps.push_back(talk(Posture::Standing, 40 * SECOND));
        if item.lasts >= STAYING_OVER {
            self.stay_over(begin, item.start + item.lasts, &mut steps, &mut stream);
        } else if let Some(seat) = self.places.for_role(Role::GuestSeat) {
            steps.push_back(ActivityStep::Go(seat.clone()));
            steps.push_back(talk(seat.posture, item.lasts));
        }
        steps.extend(door.map(ActivityStep::Go));
        steps.push_back(talk(Posture::Standing, 40 * SECOND));
        // Being out has no label.
        steps.push_back(ActivityStep::Name(String::new()));
        self.play(steps, stream, VISITING);
        if let Some(playing) = self.scripts.last_mut().filter(|_| self.stays_over) {
            (playing.of, playing.since) = (item.of, begin);
            self.tally.begin(&item, begin);
        }
    }

    /// Days and nights of a visitor who stays over: sleep, meals and bathroom at the host's hours, sitting in between. The
    /// host sets the table.
    fn stay_over(&self, begin: RunTime, end: RunTime, steps: &mut VecDeque<ActivityStep>, stream: &mut Stream) {
        let (bed, seat) = (self.guest_bed(), self.places.for_role(Role::GuestSeat));
        let chairs = self.places.all_for(Role::DiningSeat);
        let own = self.places.for_role(Role::DiningSeat);
        let chair = chairs.into_iter().find(|chair| own.is_none_or(|own| own.at != chair.at)).or(seat);
        let mut day = self.agenda.day;
        let mut now = begin;
        while now < end {
            let agenda = Agenda::new(&self.life, day, &self.life.parameters(day));
            let mut hours: Vec<(RunTime, Activity, Span)> = Vec::new();
            for item in agenda.items.iter().filter(|item| item.visitor.is_none()) {
                if matches!(item.activity, Activity::Eat(_)) {
                    hours.push((item.start, item.activity.clone(), item.lasts));
                }
            }
            let bathroom = |at: RunTime| (at, Activity::UseBathroom, 5 * MINUTE);
            let awake = agenda.bed - agenda.up;
            hours.extend((0..=BATHROOMS).map(|visit| bathroom(agenda.up + awake * visit / BATHROOMS)));
            hours.sort_by_key(|(at, ..)| *at);
            for (at, activity, lasts) in hours.into_iter().filter(|(at, ..)| (begin..end).contains(at)) {
                self.sit_until(at, seat, steps);
                match activity {
                    Activity::UseBathroom => {
                        let (places, at) = (&*self.places, self.body.at());
                        let mut setting = ActivitySetting { places, at, stream, forgotten: Vec::new(), movement: 1.0 };
                        let mut visit = script(&activity, None, lasts, None, &mut setting);
                        visit.retain(|step| !matches!(step, ActivityStep::Meet(_)));
                        steps.extend(visit);
                    }
                    _ => {
                        steps.push_back(ActivityStep::Name(activity.label().into()));
                        let posture = chair.map_or(Posture::Standing, |chair| chair.posture);
                        steps.extend(chair.cloned().map(ActivityStep::Go));
                        steps.push_back(rest(posture, Manner::EATING, lasts, None));
                    }
                }
            }
            if agenda.bed < end && agenda.next_up > begin {
                self.sit_until(agenda.bed.max(begin), seat, steps);
                let posture = bed.as_ref().map_or(Posture::Sitting, |bed| bed.posture);
                steps.extend(bed.clone().map(ActivityStep::Go));
                steps.push_back(ActivityStep::Name(SLEEPING.into()));
                steps.push_back(rest(posture, Manner::ASLEEP, Span::MAX / 4, Some(agenda.next_up.min(end))));
            }
            (now, day) = (agenda.next_up, day + 1);
        }
        self.sit_until(end, seat, steps);
    }

    /// With the host, or on a guest's seat.
    fn sit_until(&self, until: RunTime, seat: Option<&HomePlace>, steps: &mut VecDeque<ActivityStep>) {
        steps.push_back(ActivityStep::Name(VISITING.into()));
        steps.extend(seat.cloned().map(ActivityStep::Go));
        let posture = seat.map_or(Posture::Standing, |seat| seat.posture);
        steps.push_back(rest(posture, Manner::TALKING, Span::MAX / 4, Some(until)));
    }

    /// A bed other than the host's, a sofa or a chair.
    fn guest_bed(&self) -> Option<HomePlace> {
        let own = self.places.for_role(Role::Bed);
        let mut beds = self.places.all_for(Role::Bed).into_iter();
        if let Some(bed) = beds.find(|bed| own.is_none_or(|own| own.at != bed.at)) {
            return Some(bed.clone());
        }
        let sofa = self.places.all_for(Role::Sofa).into_iter().next();
        sofa.map(|sofa| HomePlace { posture: Posture::Lying, ..sofa.clone() })
            .or_else(|| self.places.all_for(Role::Armchair).into_iter().next().cloned())
            .or_else(|| self.places.for_role(Role::GuestSeat).cloned())
    }
}

/// Intervals between a visitor's visits to the bathroom in a day, the first on getting up, the last before bed (our
/// choice).
const BATHROOMS: i64 = 5;

fn talk(posture: Posture, left: Span) -> ActivityStep {
    rest(posture, Manner::TALKING, left, None)
}

fn rest(posture: Posture, manner: Manner, left: Span, until: Option<RunTime>) -> ActivityStep {
    ActivityStep::Stay(StayStep { posture, manner, left, until, may: Interruptible::Nothing })
}
