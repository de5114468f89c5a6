//! Visits: the host opens the door, sits with the visitor, and sees them off. Visitors are out until a visit that the host's
//! routine plans, then at the door, with the host, at their work or asleep, and out again.

use super::agenda::Agenda;
use super::current_activity::{GuestOfVisit, VisitorStay};
use super::driver::RoutineDriver;
use super::help;
use super::item::Item;
use super::manner::Manner;
use super::places::HomePlace;
use super::script::{self, ActivitySetting, ActivityStep, DoorParts, Interruptible, STAYING_OVER, StayStep};
use crate::routine::{Activity, Meal};
use homebody_core::activity::{BAKING, HELPING, SLEEPING, VISITING};
use homebody_core::drivers::Next;
use homebody_core::geometry::Point;
use homebody_core::ids::ResidentId;
use homebody_core::motion::{MotionSegment, MotionState};
use homebody_core::posture::Posture;
use homebody_core::role::Role;
use homebody_core::time::{DAY, HOUR, MINUTE, RunTime, SECOND, Span};
use std::collections::VecDeque;

/// Time that a visitor waits for the door to open before leaving (our choice): hosts are on the toilet, or on their way
/// home.
const PATIENCE: Span = HOUR;

/// Time that a visitor who leaves waits for the host at the door (our choice).
const SEEN_OUT: Span = MINUTE;

/// Time that a visitor with a key needs to the bed of a host who sleeps (our choice).
const TO_BEDSIDE: Span = SECOND.times(75);

/// Interval at which a visitor looks what the host does (our choice).
const LOOKS: Span = MINUTE;

/// Largest delay of the end of a visit by a meal in company (our choice), which is at most a tenth of its length.
const MEAL_ENDS: Span = MINUTE.times(30);
const PARTS_OF_VISIT: i64 = 10;

/// Times before and after the planned start of a meal at which a host at the table eats it (our choice).
const BEFORE_MEAL: Span = MINUTE.times(15);
const AFTER_MEAL: Span = MINUTE.times(75);

/// Time between two visits of a guest to the bathroom in the course of a long stay (our choice).
const BATHROOM: Span = MINUTE.times(210);

/// Time that a visitor who opens the front door is in it (our choice).
const IN_DOORWAY: Span = SECOND.times(5);

impl RoutineDriver {
    // The host.

    /// The visitor of a visit.
    pub(super) fn guest_of(&self, item: &Item) -> Option<GuestOfVisit> {
        let who = self.visitor_of(item)?;
        let until = item.until.unwrap_or(self.now.saturating_add(item.lasts));
        Some(GuestOfVisit { who, has_come: self.company.is_here(who), until })
    }

    fn visitor_of(&self, item: &Item) -> Option<ResidentId> {
        let name = item.visitor.as_ref().filter(|_| item.activity == Activity::Visit)?;
        self.company.visitor(self.host.index(), name)
    }

    /// The steps of a visit. A visitor with a key opens the door alone.
    pub(super) fn visit_steps(
        &self,
        item: &Item,
        guest: Option<GuestOfVisit>,
        setting: &mut ActivitySetting,
    ) -> VecDeque<ActivityStep> {
        let door = match (item.has_key, guest.is_some_and(|guest| guest.has_come)) {
            (true, _) => DoorParts::Neither,
            (false, true) => DoorParts::SeesOut,
            (false, false) => DoorParts::Both,
        };
        self.next_to_door(script::visit(item.lasts, item.until, door, setting))
    }

    /// The steps with a place next to the front door, as the doorway is the visitor's.
    fn next_to_door(&self, mut steps: VecDeque<ActivityStep>) -> VecDeque<ActivityStep> {
        let (Some(door), Some(aside)) = (self.places.for_role(Role::FrontDoor), self.beside_the_door()) else {
            return steps;
        };
        for step in &mut steps {
            if let ActivityStep::Go(spot) = step
                && spot.at == door.at
            {
                *spot = aside.clone();
            }
        }
        steps
    }

    /// Whether a visitor who was in time has left again.
    pub(super) fn has_been_missed(&self, item: &Item, now: RunTime) -> bool {
        let is_away = |who| !self.company.is_here(who);
        let is_late = item.is_let_in || now > item.start + PATIENCE - MINUTE;
        is_late && self.visitor_of(item).is_some_and(is_away)
    }

    /// The index of the next visitor who rings in this part of the day.
    fn bell(&self, now: RunTime) -> Option<usize> {
        if self.visitor.is_some() || !self.company.has_visitors() {
            return None;
        }
        let rings = |item: &Item| {
            !item.has_key
                && !item.is_let_in
                && !self.has_been_missed(item, now)
                && self.visitor_of(item).is_some_and(|who| !self.company.is_here(who))
        };
        let items = self.agenda.items.get(self.next_item..)?;
        items.iter().position(|item| item.visitor.is_some() && rings(item)).map(|index| self.next_item + index)
    }

    pub(super) fn bell_at(&self, now: RunTime) -> RunTime {
        self.bell(now).map_or(RunTime::NEVER, |index| self.agenda.items[index].start.max(now))
    }

    /// Opens the door. A host who cooks or eats returns to that, and sits with the visitor afterwards.
    pub(super) fn answer_the_bell(&mut self, now: RunTime) {
        let Some(index) = self.bell(now) else { return };
        let is_busy = |label: &str| label.starts_with("preparing_") || label.starts_with("eating_") || label == BAKING;
        if !self.scripts.last().is_some_and(|playing| is_busy(&playing.label)) {
            let item = self.agenda.items.remove(index);
            self.tally.plan_item(&item);
            // A nap is over.
            if self.scripts.last().is_some_and(|playing| playing.label == Activity::Nap.label()) {
                self.end_script(now);
            }
            return self.begin_at(&item, now);
        }
        let item = &mut self.agenda.items[index];
        item.is_let_in = true;
        let item = item.clone();
        let guest = self.guest_of(&item);
        let mut stream = self.life.stream_of_day(self.agenda.day, &format!("{}/door", item.key));
        let places = self.places.clone();
        let (at, forgotten, spared) = (self.body.at(), Vec::new(), Vec::new());
        let mut setting =
            ActivitySetting { places: &places, at, stream: &mut stream, forgotten, spared, movement: 1.0 };
        let steps = self.next_to_door(script::let_in(&mut setting));
        self.play(steps, stream, Activity::Visit.label());
        if let Some(playing) = self.scripts.last_mut() {
            playing.guest = guest;
        }
    }

    /// Ends the visit of a guest who has left. An open door is shut first.
    pub(super) fn end_visit_without_guest(&mut self) {
        let Some(playing) = self.scripts.last_mut() else { return };
        let Some(guest) = &mut playing.guest else { return };
        let is_here = self.company.is_here(guest.who);
        if is_here || !guest.has_come {
            guest.has_come |= is_here;
            return;
        }
        let is_left_open = !playing.steps.iter().any(|step| matches!(step, ActivityStep::Act(_, true)));
        playing.steps.retain(|step| is_left_open && matches!(step, ActivityStep::Act(..)));
    }

    /// When a visitor wakes a host who would rise at `up`: by the bell, or at the bed.
    pub(super) fn woken_at(&self, day: i32, up: RunTime, now: RunTime) -> RunTime {
        if self.visitor.is_some() || !self.company.has_visitors() {
            return up;
        }
        let agenda = Agenda::new(&self.life, day, &self.life.parameters(day));
        let visits = agenda.items.iter().filter(|item| item.visitor.is_some() && item.start > now + MINUTE);
        let wakes = visits.map(|item| item.start + if item.has_key { TO_BEDSIDE } else { Span::ZERO });
        wakes.min().map_or(up, |wakes| wakes.min(up))
    }

    // The visitor.

    pub(super) fn await_visit(&mut self, now: RunTime) {
        let name = self.visitor.clone();
        for _ in 0..400 {
            let visit =
                self.agenda.items.iter().skip(self.next_item).position(|item| item.visitor == name && item.start > now);
            if let Some(visit) = visit {
                self.next_item += visit + 1;
                return self.come_to_visit(self.next_item - 1);
            }
            self.plan_day(self.agenda.day + 1);
        }
        let end = now.saturating_add(30 * DAY);
        self.ready.push_back(Next::Segment(MotionSegment {
            begin: now,
            end,
            doing: MotionState::Away,
            posture: Posture::Standing,
        }));
    }

    /// The host's plan of a day, for the visitor.
    fn plan_day(&mut self, day: i32) {
        self.agenda = Agenda::new(&self.life, day, &self.life.parameters(day));
        self.midnight = self.life.midnight(day);
        self.next_item = 0;
    }

    fn come_to_visit(&mut self, item: usize) {
        let item = self.agenda.items[item].clone();
        let stream = self.life.stream_of_day(self.agenda.day, &format!("{}/visitor", item.key));
        let door = self.places.for_role(Role::FrontDoor).cloned();
        if let Some(door) = &door {
            self.body.place(door.clone(), Posture::Standing);
        }
        let begin = item.start;
        let end = item.until.unwrap_or(begin.saturating_add(item.lasts));
        let stays_over = end - begin >= STAYING_OVER;
        self.stay = VisitorStay {
            until: None,
            said_until: if stays_over { Some(end) } else { item.until },
            visit: Some(item.clone()),
            lasts: item.lasts,
            stays_over,
            has_key: item.has_key,
            bathroom_at: begin + BATHROOM,
            work: help::work(&item, end, (&self.agenda.items, &self.agenda.breaks), &self.life.numbers),
            helps: false,
        };
        let mut steps = VecDeque::from([
            ActivityStep::Away { lasts: Span::ZERO, until: Some(begin) },
            ActivityStep::Ring { left: PATIENCE },
            ActivityStep::Name(VISITING.into()),
            talk(Posture::Standing, if item.has_key { IN_DOORWAY } else { 40 * SECOND }),
            ActivityStep::KeepCompany,
            ActivityStep::Name(VISITING.into()),
        ]);
        steps.extend(door.map(ActivityStep::Go));
        steps.push_back(ActivityStep::Depart { left: if item.has_key { Span::ZERO } else { SEEN_OUT } });
        // Being out has no label.
        steps.push_back(ActivityStep::Name(String::new()));
        self.play(steps, stream, VISITING);
    }

    /// The stay begins as the visitor is let in.
    fn begin_stay(&mut self, now: RunTime) {
        let Some(visit) = self.stay.visit.take() else { return };
        if let Some(playing) = self.scripts.last_mut() {
            (playing.of, playing.since) = (visit.of, now);
            self.tally.begin(&visit, now);
        }
    }

    /// Whether the host of a visitor is away, and the visitor leaves therefore.
    pub(super) fn is_host_away(&self) -> bool {
        let stays = self.stay.stays_over || self.stay.has_key;
        self.visitor.is_some() && !stays && !self.company.is_here(self.host)
    }

    /// A visitor with a key, or of a host who cannot come to the door.
    pub(super) fn opens_the_door(&self) -> bool {
        self.visitor.is_some() && (self.stay.has_key || self.company.lies(self.host))
    }

    /// The next part of a visit. At its end, the way out follows.
    pub(super) fn keep_company(&mut self, now: RunTime) {
        let VisitorStay { until, said_until, lasts, .. } = self.stay;
        let is_first = until.is_none();
        let until = until.or(said_until).unwrap_or(now.saturating_add(lasts));
        self.stay.until = Some(until);
        self.stay.helps = false;
        self.begin_stay(now);
        let latest = until + if said_until.is_some() { Span::ZERO } else { MEAL_ENDS.min(lasts / PARTS_OF_VISIT) };
        let meal = self.meal_of_host(now).filter(|_| now < latest);
        if now >= until && meal.is_none() || self.is_host_away() {
            return;
        }
        let steps = match is_first && self.stay.has_key {
            true => self.go_to_host(),
            false => self.part_of_visit(now, until.max(now + LOOKS), meal),
        };
        let Some(playing) = self.scripts.last_mut() else { return };
        playing.steps.push_front(ActivityStep::KeepCompany);
        steps.into_iter().rev().for_each(|step| playing.steps.push_front(step));
    }

    fn part_of_visit(&mut self, now: RunTime, until: RunTime, meal: Option<Meal>) -> VecDeque<ActivityStep> {
        while self.stay.stays_over && now >= self.agenda.next_up {
            self.plan_day(self.agenda.day + 1);
        }
        let look = LOOKS.min(until - now);
        let next_up = self.agenda.next_up.min(until);
        if self.stay.stays_over && now >= self.agenda.bed && now + HOUR < next_up {
            let bed = self.guest_bed();
            let posture = bed.as_ref().map_or(Posture::Sitting, |bed| bed.posture);
            return self.at(SLEEPING, bed, |_| rest(posture, Manner::ASLEEP, Span::MAX / 4, Some(next_up)));
        }
        if let Some(steps) = self.work_of_visit(until, now) {
            return steps;
        }
        if let Some(meal) = meal {
            let sits_there = self.body.posture() == Posture::Sitting && self.is_at_table();
            let table = self.places.for_role(Role::DiningSeat).cloned().filter(|_| !sits_there);
            let seat = table.and_then(|table| self.free_spot(table));
            return self.at(Activity::Eat(meal).label(), seat, |posture| rest(posture, Manner::EATING, look, None));
        }
        if self.stay.stays_over && now >= self.stay.bathroom_at {
            self.stay.bathroom_at = now + BATHROOM;
            return self.act_out(&Activity::UseBathroom, 5 * MINUTE);
        }
        let is_seated = self.body.posture() == Posture::Sitting && !self.is_at_table();
        let seat = self.places.for_role(Role::GuestSeat).cloned().filter(|_| !is_seated);
        self.at(VISITING, seat, |posture| talk(posture, look))
    }

    /// A label, the way to a place unless the body stays, and a stay there.
    fn at(
        &self,
        label: &str,
        spot: Option<HomePlace>,
        stay: impl Fn(Posture) -> ActivityStep,
    ) -> VecDeque<ActivityStep> {
        let posture = spot.as_ref().map_or(self.body.posture(), |spot| spot.posture);
        let name = ActivityStep::Name(label.into());
        [Some(name), spot.map(ActivityStep::Go), Some(stay(posture))].into_iter().flatten().collect()
    }

    fn is_at_table(&self) -> bool {
        self.body.spot().is_some_and(|spot| spot.is_of(Role::DiningSeat))
    }

    /// The steps of the visitor's own activity.
    fn act_out(&mut self, activity: &Activity, lasts: Span) -> VecDeque<ActivityStep> {
        let places = self.places.clone();
        let at = self.body.at();
        let Some(playing) = self.scripts.last_mut() else { return VecDeque::new() };
        let (forgotten, spared) = (Vec::new(), Vec::new());
        let stream = &mut playing.stream;
        let mut setting = ActivitySetting { places: &places, at, stream, forgotten, spared, movement: 1.0 };
        let mut steps = script::script(activity, None, lasts, None, &mut setting);
        // The needs of visitors are not simulated.
        steps.retain(|step| !matches!(step, ActivityStep::Meet(_)));
        steps
    }

    /// The work that is due now, a part of it for help.
    fn work_of_visit(&mut self, until: RunTime, now: RunTime) -> Option<VecDeque<ActivityStep>> {
        let work = self.stay.work.front().filter(|work| work.start <= now).cloned()?;
        if !work.is_help {
            self.stay.work.pop_front();
            let next = self.stay.work.front().map_or(until - help::PUTTING_AWAY, |next| next.start);
            return Some(self.act_out(&work.activity, work.lasts.min(next - now).max(MINUTE)));
        }
        let role = work.activity.roles().first().copied().unwrap_or(Role::Washbasin);
        let room = self.places.for_role(role).and_then(|spot| spot.room);
        let host = self.company.body(self.host).map(|host| host.at);
        let is_with = room.is_some() && host.is_some_and(|at| self.home.plan.room_at(at) == room);
        if now > work.start + work.lasts || work.has_begun && !is_with {
            self.stay.work.pop_front();
            return None;
        }
        let (true, Some(host)) = (is_with, host) else { return None };
        if let Some(work) = self.stay.work.front_mut() {
            work.has_begun = true;
        }
        self.stay.helps = true;
        let is_near = self.body.room() == room && self.company.has_room(self.body.at());
        let spot = if is_near { None } else { self.place_near(host, room?) };
        Some(self.at(HELPING, spot, |_| rest(Posture::Standing, Manner::BUSY, LOOKS / 3, None)))
    }

    /// A place to stand near a point, in its room.
    fn place_near(&mut self, point: Point, room: usize) -> Option<HomePlace> {
        /// Number of points of the room that are tried (our choice).
        const TRIES: usize = 30;
        let mesh = self.body.mesh().clone();
        let stream = &mut self.scripts.last_mut()?.stream;
        let free = (0..TRIES).map(|_| mesh.free_point(room, stream)).filter(|&at| self.company.has_room(at));
        let nearest = free.min_by(|a, b| a.distance(point).total_cmp(&b.distance(point)))?;
        Some(HomePlace::to_stand(nearest, room))
    }

    /// From the door to the host: to the bed of one who sleeps.
    fn go_to_host(&mut self) -> VecDeque<ActivityStep> {
        let host = self.company.body(self.host).map(|host| host.at);
        let room = host.and_then(|at| self.home.plan.room_at(at)).filter(|&room| !self.places.is_bathroom(room));
        let spot = host.zip(room).and_then(|(at, room)| self.place_near(at, room));
        let lasts = if spot.is_some() { 2 * LOOKS } else { SECOND };
        self.at(VISITING, spot, |_| talk(Posture::Standing, lasts))
    }

    /// The meal that the host eats, seen from where the host sits, and when.
    fn meal_of_host(&self, now: RunTime) -> Option<Meal> {
        let is_at_table = |spot: &HomePlace| self.company.sits_at(self.host, spot);
        let table = self.places.for_role(Role::DiningSeat)?;
        if !is_at_table(table) && !self.places.all_for(Role::DiningSeat).into_iter().any(is_at_table) {
            return None;
        }
        let meals = self.agenda.items.iter().filter(|item| item.visitor.is_none());
        meals.filter(|item| (item.start - BEFORE_MEAL..item.start + AFTER_MEAL).contains(&now)).find_map(|item| {
            match item.activity {
                Activity::Eat(meal) => Some(meal),
                _ => None,
            }
        })
    }

    /// Waits to be seen out, but not for long; then opens the door, and shuts it from outside.
    pub(super) fn depart(&mut self, left: Span) {
        let door = self.places.for_role(Role::FrontDoor);
        let thing = self.places.thing(Role::FrontDoor);
        let is_seen_out = door.is_some_and(|door| self.company.is_at_door(self.host, door));
        let posture = self.body.posture();
        let (is_open, Some(thing)) = (self.company.is_door(true), thing) else { return };
        let Some(playing) = self.scripts.last_mut() else { return };
        if is_open {
            return;
        }
        if left > Span::ZERO {
            // The host who is at the door opens it after a word or two.
            let left = left - if is_seen_out { LOOKS_AT_DOOR / 4 } else { LOOKS_AT_DOOR };
            playing.steps.push_front(ActivityStep::Depart { left });
            playing.steps.push_front(talk(posture, LOOKS_AT_DOOR));
            return;
        }
        for step in [ActivityStep::Act(thing, false), talk(posture, IN_DOORWAY), ActivityStep::Act(thing, true)] {
            playing.steps.push_front(step);
        }
    }

    /// A bed other than the host's, a sofa or a chair.
    fn guest_bed(&self) -> Option<HomePlace> {
        let own = self.places.for_role(Role::Bed);
        let mut beds = self.places.all_for(Role::Bed).into_iter();
        if let Some(bed) = beds.find(|bed| own.is_none_or(|own| own.at != bed.at) && !self.company.is_occupied(bed.at))
        {
            return Some(bed.clone());
        }
        let sofa = self.places.all_for(Role::Sofa).into_iter().find(|sofa| !self.company.is_occupied(sofa.at));
        sofa.map(|sofa| HomePlace { posture: Posture::Lying, ..sofa.clone() })
            .or_else(|| {
                self.places.all_for(Role::Armchair).into_iter().find(|seat| !self.company.is_occupied(seat.at)).cloned()
            })
            .or_else(|| self.places.for_role(Role::GuestSeat).cloned())
    }
}

/// Interval at which a visitor at the door looks for the host (our choice).
const LOOKS_AT_DOOR: Span = SECOND.times(4);

fn talk(posture: Posture, left: Span) -> ActivityStep {
    rest(posture, Manner::TALKING, left, None)
}

fn rest(posture: Posture, manner: Manner, left: Span, until: Option<RunTime>) -> ActivityStep {
    ActivityStep::Stay(StayStep { posture, manner, left, until, may: Interruptible::Nothing })
}
