//! The needs of one resident: rates, and responses.

use super::agenda::Agenda;
use super::need::NeedLevel;
use super::resident_routine::{DayParameters, ResidentRoutine};
use super::traits::Constitution;
use crate::routine::{Activity, PartOfDay};
use homebody_core::event::BodilyNeed as Kind;
use homebody_core::numbers::Numbers;
use homebody_core::random::Stream;
use homebody_core::time::RunTime;

#[derive(Clone, Debug)]
pub struct BodilyNeeds {
    toilet: NeedLevel,
    thirst: NeedLevel,
    hunger: NeedLevel,
    tiredness: NeedLevel,
    asleep: bool,
    constitution: Constitution,
    /// Probability of a response to thirst and to hunger; below 1 if the routine says less often.
    answers: [f64; 2],
    /// Additional thirst and hunger if the routine says more often, and the probability of a response.
    more: [NeedLevel; 2],
    more_answers: [f64; 2],
    more_streams: [Stream; 2],
    rates: NeedRates,
    /// A stream for each kind, so that a skipped meal does not change the toilet's thresholds.
    streams: [Stream; 4],
}

homebody_core::numbers! {
    /// Mean waking time from a drink to the next one, apart from meals.
    static THIRST_H = "need.thirst": 4.0, "h", [0.25, 48.0];
    /// Mean time from a meal to a snack.
    static HUNGER_H = "need.hunger": 7.0, "h", [0.25, 48.0];
    /// Mean time from getting up to tiredness: naps peak at 14:30-15:00.
    static TIREDNESS_H = "need.tiredness": 7.2, "h", [0.5, 48.0];
    /// Earliest time of day of a nap from tiredness.
    static NAPS_FROM_H = "need.naps_from": 12.5, "h", [0.0, 24.0];
    /// Latest time of day of a nap from tiredness.
    static NAPS_UNTIL_H = "need.naps_until": 17.5, "h", [0.0, 24.0];
    /// Shape of the gamma distribution of the thresholds of needs.
    static SHAPE = "need.shape": 3.0, "1", [0.5, 50.0];
    /// Waking hours that the visits to the toilet by day refer to.
    static WAKING_H = "need.waking": 15.5, "h", [1.0, 23.0];
    /// Hours of sleep that the visits to the toilet by night refer to.
    static SLEEPING_H = "need.sleeping": 7.8, "h", [1.0, 23.0];
    /// Number of visits to the toilet by day that come without a need, first thing in the morning and before bed.
    static ANYWAY = "need.anyway": 2.0, "1", [0.0, 5.0];
}

/// The parameters of needs, looked up once.
#[derive(Clone, Copy, Debug)]
struct NeedRates {
    /// Times per day awake.
    thirst: f64,
    hunger: f64,
    tiredness: f64,
    /// In hours.
    naps_from_h: f64,
    naps_until_h: f64,
    shape: f64,
    waking_h: f64,
    sleeping_h: f64,
    anyway: f64,
}

impl NeedRates {
    fn new(numbers: &Numbers) -> NeedRates {
        let of = |number| numbers.of(number);
        NeedRates {
            thirst: 24.0 / of(&THIRST_H),
            hunger: 24.0 / of(&HUNGER_H),
            tiredness: 24.0 / of(&TIREDNESS_H),
            naps_from_h: of(&NAPS_FROM_H),
            naps_until_h: of(&NAPS_UNTIL_H),
            shape: of(&SHAPE),
            waking_h: of(&WAKING_H),
            sleeping_h: of(&SLEEPING_H),
            anyway: of(&ANYWAY),
        }
    }
}

const KINDS: [Kind; 4] = [Kind::Toilet, Kind::Thirst, Kind::Hunger, Kind::Tiredness];

const MORE: [Kind; 2] = [Kind::Thirst, Kind::Hunger];

impl BodilyNeeds {
    pub fn new(life: &ResidentRoutine, now: RunTime) -> BodilyNeeds {
        // A planned nap replaces naps from tiredness.
        let plans_naps =
            life.habits(0).any(|habit| habit.said.activity == Activity::Nap && habit.said.visitor.is_none());
        let naps = if plans_naps { 0.0 } else { life.constitution.naps };
        let constitution = Constitution { naps, ..life.constitution };
        let mut streams = KINDS.map(|kind| life.stream(&format!("needs/{kind:?}")));
        let rates = NeedRates::new(&life.numbers);
        let mut more_streams = MORE.map(|kind| life.stream(&format!("needs/{kind:?}/more")));
        let fresh = |stream: &mut Stream| NeedLevel::new(now, stream.gamma(rates.shape, 1.0));
        let [toilet, thirst, hunger, _] = streams.each_mut().map(fresh);
        let more = more_streams.each_mut().map(fresh);
        BodilyNeeds {
            toilet,
            thirst,
            hunger,
            tiredness: NeedLevel::new(now, 1.0),
            asleep: false,
            constitution,
            answers: [1.0; 2],
            more,
            more_answers: [0.0; 2],
            more_streams,
            rates,
            streams,
        }
    }

    pub fn asleep(&self) -> bool {
        self.asleep
    }

    /// Sets the rates while awake on a day; needs with a stated frequency do not rise.
    pub fn waking(&mut self, now: RunTime, life: &ResidentRoutine, day: i32, parameters: &DayParameters) {
        self.asleep = false;
        let is_planned = |activity: &Activity| life.says_how_often(activity, day, false);
        // A renewal process that begins anew loses a third of a visit at this shape.
        let often = parameters.oftener(&Activity::UseBathroom, Some(PartOfDay::Day));
        let visits = (self.constitution.toilet_by_day * often - self.rates.anyway + 0.33).max(0.1);
        let toilet = visits * 24.0 / self.rates.waking_h;
        let [drinks, snacks] = [Activity::Drink, Activity::Snack].map(|activity| match is_planned(&activity) {
            true => 0.0,
            false => parameters.oftener(&activity, None),
        });
        self.answers = [drinks, snacks];
        self.toilet.rise(now, if is_planned(&Activity::UseBathroom) { 0.0 } else { toilet });
        self.thirst.rise(now, self.rates.thirst);
        self.hunger.rise(now, self.rates.hunger);
        for (index, (often, rate)) in [(drinks, self.rates.thirst), (snacks, self.rates.hunger)].into_iter().enumerate()
        {
            let (more, times) = ((often - 1.0).max(0.0), libm::ceil(often - 1.0).max(0.0));
            self.more[index].rise(now, rate * times);
            self.more_answers[index] = more / times.max(1.0);
        }
        self.tiredness.rise(now, self.rates.tiredness);
    }

    pub fn sleeping(&mut self, now: RunTime, life: &ResidentRoutine, agenda: &Agenda, parameters: &DayParameters) {
        self.asleep = true;
        let is_planned = agenda.says_visits_of_night || life.says_how_often(&Activity::UseBathroom, agenda.day, true);
        let visits = self.constitution.toilet_at_night + 0.33;
        let toilet =
            visits * 24.0 / self.rates.sleeping_h * parameters.oftener(&Activity::UseBathroom, Some(PartOfDay::Night));
        self.toilet.rise(now, if is_planned { 0.0 } else { toilet });
        for need in [&mut self.thirst, &mut self.hunger, &mut self.tiredness].into_iter().chain(&mut self.more) {
            need.rise(now, 0.0);
        }
    }

    /// Only tiredness rises while away, because other places have toilets and meals, but no beds.
    pub fn pause(&mut self, now: RunTime) {
        for need in [&mut self.toilet, &mut self.thirst, &mut self.hunger].into_iter().chain(&mut self.more) {
            need.rise(now, 0.0);
        }
    }

    /// Sleep meets tiredness.
    pub fn wake(&mut self, now: RunTime) {
        self.tiredness.meet(now, 1.0);
    }

    pub fn presses_at(&self) -> RunTime {
        let awake = [&self.thirst, &self.hunger, &self.tiredness].into_iter().chain(&self.more);
        let awake = awake.map(NeedLevel::presses_at).min();
        let awake = if self.asleep { None } else { awake };
        self.toilet.presses_at().min(awake.unwrap_or(RunTime::NEVER))
    }

    /// The response to the most urgent pressing need; one without a response presses later.
    pub fn pressing(&mut self, now: RunTime, hour: f64) -> Option<Activity> {
        if self.toilet.presses_at() <= now {
            return Some(Activity::UseBathroom);
        }
        if self.asleep {
            return None;
        }
        let [drinks, snacks] = self.answers;
        for (kind, often, activity) in
            [(Kind::Thirst, drinks, Activity::Drink), (Kind::Hunger, snacks, Activity::Snack)]
        {
            let need = if kind == Kind::Thirst { &self.thirst } else { &self.hunger };
            if need.presses_at() > now {
                continue;
            }
            if often >= 1.0 || self.streams[kind as usize].chance(often) {
                return Some(activity);
            }
            self.put_off(kind, now);
        }
        for (index, activity) in [Activity::Drink, Activity::Snack].into_iter().enumerate() {
            if self.more[index].presses_at() > now {
                continue;
            }
            if self.more_streams[index].chance(self.more_answers[index]) {
                return Some(activity);
            }
            self.meet_more(index, now);
        }
        if self.tiredness.presses_at() > now {
            return None;
        }
        if (self.rates.naps_from_h..self.rates.naps_until_h).contains(&hour)
            && self.streams[Kind::Tiredness as usize].chance(self.constitution.naps)
        {
            return Some(Activity::Nap);
        }
        // Overcome until tomorrow.
        self.tiredness.meet(now, 1.5);
        None
    }

    /// Returns its strength before.
    pub fn meet(&mut self, kind: Kind, now: RunTime) -> f64 {
        if let Some(index) = MORE.iter().position(|of| *of == kind) {
            let need = if kind == Kind::Thirst { &self.thirst } else { &self.hunger };
            let presses = [need, &self.more[index]].map(|need| need.presses_at() <= now);
            // A meal meets all hunger; otherwise only the pressing one is met.
            if presses[1] || !presses[0] {
                self.meet_more(index, now);
            }
            if presses[1] && !presses[0] {
                return 1.0;
            }
        }
        let threshold =
            if kind == Kind::Tiredness { 1.5 } else { self.streams[kind as usize].gamma(self.rates.shape, 1.0) };
        let need = match kind {
            Kind::Toilet => &mut self.toilet,
            Kind::Thirst => &mut self.thirst,
            Kind::Hunger => &mut self.hunger,
            Kind::Tiredness => &mut self.tiredness,
        };
        let strength = need.strength(now);
        need.meet(now, threshold);
        strength.min(1.0)
    }

    fn meet_more(&mut self, index: usize, now: RunTime) {
        let threshold = self.more_streams[index].gamma(self.rates.shape, 1.0);
        self.more[index].meet(now, threshold);
    }

    /// Without a possible response, the need restarts.
    pub fn put_off(&mut self, kind: Kind, now: RunTime) {
        self.meet(kind, now);
    }
}
