//! Those who come to visit: out until a visit that the routine of whom they visit has planned, then at the door, on a seat, and
//! out again.

use super::agenda::Agenda;
use super::driver::{MINUTE, RoutineDriver};
use super::manner::Manner;
use super::places::Spot;
use super::script::{Interruptible, STAYING_OVER, Setting, Stay, Step, script};
use crate::routine::Activity;
use homebody_core::activity::{SLEEPING, VISITING};
use homebody_core::drivers::{MotionSegment, Next};
use homebody_core::event::MotionState;
use homebody_core::random::Stream;
use homebody_core::role::Role;
use homebody_core::scenario::path::Posture;
use homebody_core::time::{Micros, SECOND};
use std::collections::VecDeque;

/// Time that a visitor waits for the door to open before leaving (our choice): hosts are on the toilet, or on their way
/// home.
const PATIENCE: Micros = 60 * MINUTE;

impl RoutineDriver {
    /// A visitor is out until the next visit.
    pub(super) fn await_visit(&mut self, now: Micros) {
        let name = self.visitor.clone();
        for _ in 0..400 {
            let visit =
                self.agenda.items.iter().skip(self.next_item).position(|item| item.visitor == name && item.start > now);
            if let Some(visit) = visit {
                self.next_item += visit + 1;
                return self.come_to_visit(self.next_item - 1);
            }
            let day = self.agenda.day + 1;
            self.agenda = Agenda::of(&self.life, day, &self.life.parameters(day));
            self.midnight = self.life.midnight(day);
            self.next_item = 0;
        }
        let end = now.saturating_add(30 * 1440 * MINUTE);
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
        let door = self.places.of(Role::FrontDoor).cloned();
        if let Some(door) = &door {
            self.body.place(door.clone(), Posture::Standing);
        }
        self.stays_over = item.lasts >= STAYING_OVER;
        let begin = item.start;
        let mut steps = VecDeque::from([Step::Away { lasts: 0, until: Some(begin) }, Step::Ring { left: PATIENCE }]);
        steps.push_back(Step::Name(VISITING.into()));
        steps.push_back(talk(Posture::Standing, 40 * SECOND));
        if item.lasts >= STAYING_OVER {
            self.stay_over(begin, item.start + item.lasts, &mut steps, &mut stream);
        } else if let Some(seat) = self.places.of(Role::GuestSeat) {
            steps.push_back(Step::Go(seat.clone()));
            steps.push_back(talk(seat.posture, item.lasts));
        }
        steps.extend(door.map(Step::Go));
        steps.push_back(talk(Posture::Standing, 40 * SECOND));
        // Out of the home is no activity of theirs.
        steps.push_back(Step::Name(String::new()));
        self.play(steps, stream, VISITING);
        if let Some(playing) = self.scripts.last_mut().filter(|_| self.stays_over) {
            (playing.of, playing.since) = (item.of, begin);
            self.tally.begin(&item, begin);
        }
    }

    /// Days and nights of who stays over: by the hours of the host they sleep, eat and go to the bathroom; in between they
    /// sit. The table is set by the host.
    fn stay_over(&self, begin: Micros, end: Micros, steps: &mut VecDeque<Step>, stream: &mut Stream) {
        let (bed, seat) = (self.guest_bed(), self.places.of(Role::GuestSeat));
        let chairs = self.places.anybodys(Role::DiningSeat);
        let own = self.places.of(Role::DiningSeat);
        let chair = chairs.into_iter().find(|chair| own.is_none_or(|own| own.at != chair.at)).or(seat);
        let mut day = self.agenda.day;
        let mut now = begin;
        while now < end {
            let agenda = Agenda::of(&self.life, day, &self.life.parameters(day));
            let mut hours: Vec<(Micros, Activity, Micros)> = Vec::new();
            for item in agenda.items.iter().filter(|item| item.visitor.is_none()) {
                if matches!(item.activity, Activity::Eat(_)) {
                    hours.push((item.start, item.activity.clone(), item.lasts));
                }
            }
            let bathroom = |at: Micros| (at, Activity::UseBathroom, 5 * MINUTE);
            let awake = agenda.bed - agenda.up;
            hours.extend((0..=BATHROOMS).map(|visit| bathroom(agenda.up + awake * visit / BATHROOMS)));
            hours.sort_by_key(|(at, ..)| *at);
            for (at, activity, lasts) in hours.into_iter().filter(|(at, ..)| (begin..end).contains(at)) {
                self.sit_until(at, seat, steps);
                match activity {
                    Activity::UseBathroom => {
                        let (places, at) = (&*self.places, self.body.at());
                        let mut setting = Setting { places, at, stream, forgotten: Vec::new(), movement: 1.0 };
                        let mut visit = script(&activity, None, lasts, None, &mut setting);
                        visit.retain(|step| !matches!(step, Step::Meet(_)));
                        steps.extend(visit);
                    }
                    _ => {
                        steps.push_back(Step::Name(activity.label().into()));
                        let posture = chair.map_or(Posture::Standing, |chair| chair.posture);
                        steps.extend(chair.cloned().map(Step::Go));
                        steps.push_back(rest(posture, Manner::EATING, lasts, None));
                    }
                }
            }
            if agenda.bed < end && agenda.next_up > begin {
                self.sit_until(agenda.bed.max(begin), seat, steps);
                let posture = bed.as_ref().map_or(Posture::Sitting, |bed| bed.posture);
                steps.extend(bed.clone().map(Step::Go));
                steps.push_back(Step::Name(SLEEPING.into()));
                steps.push_back(rest(posture, Manner::ASLEEP, Micros::MAX / 4, Some(agenda.next_up.min(end))));
            }
            (now, day) = (agenda.next_up, day + 1);
        }
        self.sit_until(end, seat, steps);
    }

    /// Sits with the host, or where guests sit, until then.
    fn sit_until(&self, until: Micros, seat: Option<&Spot>, steps: &mut VecDeque<Step>) {
        steps.push_back(Step::Name(VISITING.into()));
        steps.extend(seat.cloned().map(Step::Go));
        let posture = seat.map_or(Posture::Standing, |seat| seat.posture);
        steps.push_back(rest(posture, Manner::TALKING, Micros::MAX / 4, Some(until)));
    }

    /// Where a guest sleeps: a bed that is not the host's, a sofa, a chair.
    fn guest_bed(&self) -> Option<Spot> {
        let own = self.places.of(Role::Bed);
        let mut beds = self.places.anybodys(Role::Bed).into_iter();
        if let Some(bed) = beds.find(|bed| own.is_none_or(|own| own.at != bed.at)) {
            return Some(bed.clone());
        }
        let sofa = self.places.anybodys(Role::Sofa).into_iter().next();
        sofa.map(|sofa| Spot { posture: Posture::Lying, ..sofa.clone() })
            .or_else(|| self.places.anybodys(Role::Armchair).into_iter().next().cloned())
            .or_else(|| self.places.of(Role::GuestSeat).cloned())
    }
}

/// Intervals between a visitor's visits to the bathroom in a day, the first on getting up, the last before bed (our
/// choice).
const BATHROOMS: Micros = 5;

fn talk(posture: Posture, left: Micros) -> Step {
    rest(posture, Manner::TALKING, left, None)
}

fn rest(posture: Posture, manner: Manner, left: Micros, until: Option<Micros>) -> Step {
    Step::Stay(Stay { posture, manner, left, until, may: Interruptible::Nothing })
}
