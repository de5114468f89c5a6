//! Whose life it is, and how it is on a day: habits, and what conditions have made of them by then.
//!
//! Every random number of a life comes from a stream with the day and the purpose in its name, never from one that was
//! drawn from before. So two lives that differ in one condition draw the same numbers for all that it does not touch.

use super::keys::Keys;
pub use super::parameters::DayParameters;
use super::parameters::{BUSY_DAY, DAY_LIKE, DAY_SPREAD, LEAST_PACE, MOST_MOVEMENT, MOST_WEEKS, QUIET_DAY, Span};
use super::person::{Constitution, Person};
use crate::language::LAST_WEEK;
use crate::routine::{
    Activity, Chance, Change, DayKind, Days, Effect, Habit, Meal, Moment, Phase, Quote, Routine, Rule,
};
use homebody_core::fuzzy::Quantifier;
use homebody_core::numbers::Numbers;
use homebody_core::random::Stream;
use homebody_core::scenario::calendar::Calendar;
use homebody_core::time::{DAY, Micros, micros};
use homebody_walk::Gains;
use std::collections::BTreeMap;
use std::sync::Arc;

/// A person's life as it was written, with the conditions that it shows.
#[derive(Clone, Debug)]
pub struct Life {
    /// The resident's name.
    pub name: String,
    pub calendar: Calendar,
    /// Metres a second, as the resident's file says or, before it, the routine.
    pub pace_mps: f64,
    /// The pace as it is written, and whether it is said exactly, so that it is theirs whoever else there is.
    written_mps: f64,
    has_exact_pace: bool,
    /// Whether they are not quite as they are written.
    is_one_of_many: bool,
    seed: u64,
    /// The routine first, then what it leaves unsaid, then the conditions. Lives of other seeds share it.
    sources: Arc<Vec<Source>>,
    pub constitution: Constitution,
    pub person: Person,
    /// What the scenario sets otherwise in how lives are lived.
    pub numbers: Numbers,
    /// How they wander, as the resident's file says.
    pub gains: Gains,
}

/// A routine or a condition, and when it is in force.
#[derive(Clone, Debug)]
struct Source {
    routine: Routine,
    /// The streams' names of what it says.
    keys: Keys,
    /// The name of the condition, if it is one.
    condition: Option<String>,
    /// What shows it, in the order in which they begin: each through all of its phases, at their severities. A later one
    /// replaces those before it. Empty for what is always so.
    shown: Vec<Vec<(Phase, f64)>>,
}

/// A sentence of a life: a habit, a rule or a change of one of its texts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct SentenceId {
    /// The routine is 0, what it leaves unsaid 1, conditions come after.
    pub source: usize,
    pub kind: SentenceKind,
    /// Its place among those of its kind.
    pub index: usize,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum SentenceKind {
    Habit,
    Rule,
    Change,
}

/// A habit or a rule that is in force on a day.
#[derive(Clone, Copy, Debug)]
pub struct InForce<'a, T> {
    pub said: &'a T,
    /// Of the condition that it comes from; 1 for what the routine itself says.
    pub strength: f64,
    /// What its random streams are called after.
    pub key: &'a str,
    /// Which of the life's texts says it: the routine is 0, what it leaves unsaid 1, conditions come after.
    pub source: usize,
    kind: SentenceKind,
    index: usize,
}

impl<T> InForce<'_, T> {
    /// Which sentence it is.
    pub fn id(&self) -> SentenceId {
        SentenceId { source: self.source, kind: self.kind, index: self.index }
    }
}

/// How many conditions may show each other; deeper is a loop.
const DEPTH: usize = 8;

impl Life {
    /// A life of a routine; `ordinary` fills in what it does not mention, `conditions` are those it shows, by name. One of
    /// many is not quite as it is written.
    #[expect(clippy::too_many_arguments, reason = "they are the whole of what a life is made of")]
    pub fn new(
        name: &str,
        seed: u64,
        calendar: &Calendar,
        pace_mps: f64,
        routine: Routine,
        ordinary: Routine,
        conditions: &BTreeMap<String, Routine>,
        is_one_of_many: bool,
        numbers: &Numbers,
    ) -> Life {
        let pace = routine.person.as_ref().and_then(|person| person.pace_mps);
        let written_mps = pace.map_or(pace_mps, |pace| pace.mean());
        let mut life = Life {
            name: name.into(),
            calendar: calendar.clone(),
            pace_mps: written_mps,
            written_mps,
            has_exact_pace: pace.is_some_and(|pace| pace.low >= pace.high),
            is_one_of_many,
            seed,
            sources: Arc::default(),
            constitution: Constitution::draw(numbers, &mut Life::constitution_of(name, seed)),
            person: Person::AS_WRITTEN,
            numbers: numbers.clone(),
            gains: Gains::USUAL,
        };
        life.draw();
        life.add_conditions(&routine.changes.clone(), &[], conditions, 0);
        for source in Arc::make_mut(&mut life.sources) {
            let begins = |shown: &Vec<(Phase, f64)>| {
                shown.iter().filter_map(|(phase, _)| phase.from).map(|from| day_in(calendar, from)).max()
            };
            source.shown.sort_by_key(begins);
        }
        let (own_keys, ordinary_keys) = (Keys::of(&routine, "own"), Keys::of(&ordinary, "ordinary"));
        let always = |routine, keys| Source { routine, keys, condition: None, shown: Vec::new() };
        let ordinary = always(ordinary, ordinary_keys);
        Arc::make_mut(&mut life.sources).splice(0..0, [always(routine, own_keys), ordinary]);
        life
    }

    /// The life that another seed makes of the same words.
    pub fn of_seed(&self, seed: u64) -> Life {
        let mut life = Life { seed, ..self.clone() };
        life.draw();
        life
    }

    /// Draws what is theirs and in no words.
    fn draw(&mut self) {
        self.constitution = Constitution::draw(&self.numbers, &mut Life::constitution_of(&self.name, self.seed));
        self.person = match self.is_one_of_many {
            true => Person::draw(&self.numbers, &mut self.stream("person")),
            false => Person::AS_WRITTEN,
        };
        // A pace that is said exactly is theirs, whoever else there is.
        let factor = if self.has_exact_pace { 1.0 } else { self.person.pace };
        self.pace_mps = self.written_mps * factor;
    }

    fn constitution_of(name: &str, seed: u64) -> Stream {
        Stream::named(seed, &format!("resident/{name}/constitution"))
    }

    fn add_conditions(
        &mut self,
        changes: &[Change],
        shown: &[(Phase, f64)],
        conditions: &BTreeMap<String, Routine>,
        depth: usize,
    ) {
        for change in changes {
            let Effect::Shows { condition, severity } = &change.effect else { continue };
            let Some(routine) = conditions.get(condition).filter(|_| depth < DEPTH) else { continue };
            let shown: Vec<(Phase, f64)> = shown.iter().copied().chain([(change.phase, *severity)]).collect();
            self.add_conditions(&routine.changes, &shown, conditions, depth + 1);
            let sources = Arc::make_mut(&mut self.sources);
            if let Some(known) = sources.iter_mut().find(|source| source.condition.as_ref() == Some(condition)) {
                known.shown.push(shown);
                continue;
            }
            let (keys, condition, shown) = (Keys::of(routine, condition), Some(condition.clone()), vec![shown]);
            sources.push(Source { routine: routine.clone(), keys, condition, shown });
        }
    }

    /// The place among the texts of the routine itself, and of what it leaves unsaid.
    pub const OWN: usize = 0;
    pub const UNSAID: usize = 1;

    /// What fills in what the routine never mentions.
    pub fn unsaid(&self) -> Routine {
        let ordinary = &self.sources[Life::UNSAID].routine;
        let own = &self.sources[Life::OWN].routine.habits;
        let is_unsaid = |habit: &&Habit| !own.iter().any(|said| said.stands_for(habit));
        Routine { habits: ordinary.habits.iter().filter(is_unsaid).cloned().collect(), ..ordinary.clone() }
    }

    /// Whether the routine itself says on this day what else goes as usual.
    pub fn says(&self, usual: &Habit, day: i32) -> bool {
        let own = &self.sources[Life::OWN].routine.habits;
        own.iter().any(|said| {
            said.stands_for(usual)
                && self.phase(&said.phase, day) > 0.0
                && (!said.is_of_every_day() || self.is_on(&said.days, day))
        })
    }

    /// Whether a habit is meant for a day, be it drawn on it or not.
    pub fn is_meant(&self, habit: &Habit, day: i32) -> bool {
        self.is_on(&habit.days, day) && self.phase(&habit.phase, day) > 0.0
    }

    /// All sentences of the life: the text that says each, and its words.
    pub fn sentences(&self) -> impl Iterator<Item = (SentenceId, &str, &Quote)> {
        self.sources.iter().enumerate().flat_map(|(source, of)| {
            let Routine { file, habits, rules, changes, .. } = &of.routine;
            let id = move |kind, index| SentenceId { source, kind, index };
            let habits = habits.iter().enumerate().map(move |(i, habit)| (id(SentenceKind::Habit, i), &habit.said));
            let rules = rules.iter().enumerate().map(move |(i, rule)| (id(SentenceKind::Rule, i), &rule.said));
            let changes =
                changes.iter().enumerate().map(move |(i, change)| (id(SentenceKind::Change, i), &change.said));
            habits.chain(rules).chain(changes).map(|(id, said)| (id, file.as_str(), said))
        })
    }

    /// The routine's own file.
    pub fn file(&self) -> &String {
        &self.sources[Life::OWN].routine.file
    }

    /// A habit by its sentence.
    pub fn habit(&self, id: SentenceId) -> Option<&Habit> {
        let source = self.sources.get(id.source).filter(|_| id.kind == SentenceKind::Habit)?;
        source.routine.habits.get(id.index)
    }

    /// A rule by its sentence.
    pub fn rule(&self, id: SentenceId) -> Option<&Rule> {
        let source = self.sources.get(id.source).filter(|_| id.kind == SentenceKind::Rule)?;
        source.routine.rules.get(id.index)
    }

    /// A change by its sentence.
    pub fn change(&self, id: SentenceId) -> Option<&Change> {
        let source = self.sources.get(id.source).filter(|_| id.kind == SentenceKind::Change)?;
        source.routine.changes.get(id.index)
    }

    /// A stream of random numbers of this life, for one purpose.
    pub fn stream(&self, purpose: &str) -> Stream {
        Stream::named(self.seed, &format!("resident/{}/{purpose}", self.name))
    }

    /// The stream of one purpose on one day.
    pub fn stream_of_day(&self, day: i32, purpose: &str) -> Stream {
        self.stream(&format!("day/{day}/{purpose}"))
    }

    /// The instant from which the hours of a day are counted: a whole number of days before noon, so that they are right from
    /// the morning on also on days on which clocks change.
    pub fn midnight(&self, day: i32) -> Micros {
        self.calendar.instant(day, DAY / 2) - DAY / 2
    }

    /// The instant of a time of day, in seconds since midnight.
    pub fn instant(&self, day: i32, time_s: f64) -> Micros {
        self.calendar.instant(day, micros(time_s))
    }

    /// The habits in force on a day, in the order of the texts that say them.
    pub fn habits(&self, day: i32) -> impl Iterator<Item = InForce<'_, Habit>> {
        self.in_force(day).flat_map(move |(index, strength)| {
            let source = &self.sources[index];
            each(&source.routine.habits, &source.keys.habits, strength, index, SentenceKind::Habit)
        })
    }

    /// The rules in force on a day.
    pub fn rules(&self, day: i32) -> impl Iterator<Item = InForce<'_, Rule>> {
        self.in_force(day).flat_map(move |(index, strength)| {
            let source = &self.sources[index];
            each(&source.routine.rules, &source.keys.rules, strength, index, SentenceKind::Rule)
        })
    }

    /// Whether the routine itself says how often something is done for which there is a need, in the nights or on the days of
    /// this time: the need then does not rise. What has a time, or comes after something, is one more; so is what a condition
    /// adds.
    pub fn says_how_often(&self, activity: &Activity, day: i32, at_night: bool) -> bool {
        let own = &self.sources[Life::OWN].routine.habits;
        own.iter().any(|habit| habit.is_how_often(activity, at_night) && self.is_meant(habit, day))
    }

    /// Everybody who may come to visit.
    pub fn visitors(&self) -> Vec<String> {
        let habits = self.sources.iter().flat_map(|source| &source.routine.habits);
        let mut visitors: Vec<String> = habits.filter_map(|habit| habit.visitor.clone()).collect();
        visitors.sort();
        visitors.dedup();
        visitors
    }

    /// The texts in force on a day, each with its strength.
    fn in_force(&self, day: i32) -> impl Iterator<Item = (usize, f64)> {
        let strengths = self.sources.iter().map(move |source| self.strength(source, day)).enumerate();
        strengths.filter(|(_, strength)| *strength > 0.0)
    }

    fn strength(&self, source: &Source, day: i32) -> f64 {
        if source.shown.is_empty() {
            return 1.0;
        }
        // As far as one has come, those before it are gone.
        source.shown.iter().fold(0.0, |before, shown| {
            let come: f64 = shown.iter().map(|(phase, _)| self.phase(phase, day)).product();
            let severity: f64 = shown.iter().map(|(_, severity)| severity).product();
            before * (1.0 - come) + severity * come
        })
    }

    /// How severe a condition is on a day; 1 is a moderate case.
    pub fn severity(&self, condition: &str, day: i32) -> f64 {
        let of_it =
            self.in_force(day).filter(|(source, _)| self.sources[*source].condition.as_deref() == Some(condition));
        of_it.map(|(_, strength)| strength).sum()
    }

    /// How far a phase has come on a day: 0 before it, 1 once it is fully there.
    pub fn phase(&self, phase: &Phase, day: i32) -> f64 {
        let day_of = |moment: Moment| f64::from(self.day_of(moment));
        let day = f64::from(day);
        let ramp = |from: f64, over: f64| if over > 0.0 { ((day - from + 1.0) / over).min(1.0) } else { 1.0 };
        let risen = match phase.from.map(day_of) {
            Some(from) if day < from => 0.0,
            Some(from) => ramp(from, phase.over_days),
            None => ramp(0.0, phase.over_days),
        };
        let left = match phase.until.map(day_of) {
            // From `until` on it is no longer so, but for what is left of it.
            Some(until) if day >= until => {
                let faded = (day - until + 1.0) / phase.fading_days;
                if phase.fading_days > 0.0 { (1.0 - faded).max(0.0) } else { 0.0 }
            }
            _ => 1.0,
        };
        risen * left
    }

    /// The day of a moment, the run's first being 0.
    pub fn day_of(&self, moment: Moment) -> i32 {
        day_in(&self.calendar, moment)
    }

    /// Whether a habit is meant for a day at all.
    pub fn is_on(&self, days: &Days, day: i32) -> bool {
        let (_, month, day_of_month) = self.calendar.date(day);
        days.weekdays >> self.calendar.weekday(day) & 1 == 1
            && days.months >> (month - 1) & 1 == 1
            && day.rem_euclid(days.every.max(1) as i32) == 0
            && match days.of_month {
                LAST_WEEK => self.calendar.date(day + 7).1 != month,
                (first, last) => (first..=last).contains(&day_of_month),
            }
            && days.kind.is_none_or(|kind| self.is_of_kind(kind, day))
    }

    /// How likely a habit is on a day that it is meant for.
    pub fn chance(&self, habit: &Habit, strength: f64, day: i32) -> f64 {
        (self.chance_by(&habit.chance, &habit.phase, day) * strength * self.phase(&habit.phase, day)).min(1.0)
    }

    /// What a chance has become by a day.
    fn chance_by(&self, of: &Chance, phase: &Phase, day: i32) -> f64 {
        let mut chance = of.probability;
        if let Some((later, moment)) = of.becomes {
            let from = phase.from.map_or(0, |moment| self.day_of(moment));
            let whole = f64::from(self.day_of(moment) - from).max(1.0);
            chance += (later - chance) * (f64::from(day - from) / whole).clamp(0.0, 1.0);
        }
        chance
    }

    /// How lively a day is: better days and worse ones, each somewhat like the day before. Its logarithm is a normal
    /// autoregression of the first order, of which no more than a week is remembered.
    ///
    /// Where days are said to differ more, the mean stays.
    fn level(&self, day: i32, differ: f64) -> f64 {
        let (spread, like) = (self.numbers.of(&DAY_SPREAD), self.numbers.of(&DAY_LIKE));
        let level = libm::exp(spread * libm::sqrt(1.0 - like * like) * self.remembered(day));
        if differ == 1.0 {
            return level;
        }
        libm::pow(level, differ) * libm::exp(spread * spread * (1.0 - differ * differ) / 2.0)
    }

    fn remembered(&self, day: i32) -> f64 {
        let like = self.numbers.of(&DAY_LIKE);
        let of = |day: i32| self.stream_of_day(day, "level").normal(0.0, 1.0);
        (0..7).map(|ago| libm::pow(like, f64::from(ago)) * of(day - ago)).sum()
    }

    /// The share of days that are quieter than a day; of those that are busier, where it is asked for busy days.
    fn share_beyond(&self, kind: DayKind, day: i32) -> f64 {
        let like = self.numbers.of(&DAY_LIKE);
        let lively = libm::sqrt(1.0 - like * like) * self.remembered(day);
        let beyond = if kind == DayKind::Quiet { -lively } else { lively };
        libm::erfc(beyond / std::f64::consts::SQRT_2) / 2.0
    }

    /// The kind of a day of which a sentence says it, and how many times as much movement there is. Of so many days the quietest
    /// are the quiet ones, and the busiest the busy ones.
    fn said_kind(&self, day: i32) -> Option<(DayKind, f64)> {
        self.kinds_said(day).find_map(|(change, strength)| {
            let Effect::DaysAre { kind, very, chance } = &change.effect else { return None };
            let is_one = self.is_on(&change.days, day)
                && match chance.days_a_week {
                    Some(days) => strength > 0.0 && self.is_among(*kind, days, &change.days, day),
                    None => self.share_beyond(*kind, day) < self.chance_by(chance, &change.phase, day) * strength,
                };
            let times = self.numbers.of(if *kind == DayKind::Quiet { &QUIET_DAY } else { &BUSY_DAY });
            is_one.then_some((*kind, if *very { times * times } else { times }))
        })
    }

    /// The sentences that say which days are quiet or busy, with how far each holds.
    fn kinds_said(&self, day: i32) -> impl Iterator<Item = (&Change, f64)> {
        self.in_force(day).flat_map(move |(source, strength)| {
            let changes = &self.sources[source].routine.changes;
            let of_days = changes.iter().enumerate().filter(|(_, of)| matches!(of.effect, Effect::DaysAre { .. }));
            of_days.map(move |(index, change)| (change, strength * self.left_of(changes, index, day)))
        })
    }

    /// Whether a day is among so many of its week that are the quietest, or the busiest, of those that are meant.
    fn is_among(&self, kind: DayKind, days: u8, of: &Days, today: i32) -> bool {
        let own = self.share_beyond(kind, today);
        let before = self.week_of(today).filter(|&day| day != today && self.is_on(of, day));
        before.filter(|&day| self.share_beyond(kind, day) < own).count() < usize::from(days)
    }

    /// The days from Monday to Sunday around a day.
    pub fn week_of(&self, day: i32) -> std::ops::Range<i32> {
        let monday = day - i32::from(self.calendar.weekday(day));
        monday..monday + 7
    }

    /// Whether a day is of a kind; where no sentence says which are, some are.
    fn is_of_kind(&self, kind: DayKind, day: i32) -> bool {
        let is_said = |(change, strength): (&Change, f64)| {
            strength > 0.0 && matches!(change.effect, Effect::DaysAre { kind: of, .. } if of == kind)
        };
        match self.kinds_said(day).any(is_said) {
            true => self.said_kind(day).is_some_and(|(of, _)| of == kind),
            false => self.share_beyond(kind, day) < Quantifier::Sometimes.probability(),
        }
    }

    /// How things are on a day.
    pub fn parameters(&self, day: i32) -> DayParameters {
        let mut parameters = DayParameters::ordinary();
        let of = |number| self.numbers.of(number);
        let (most_weeks, least_pace) = (of(&MOST_WEEKS), of(&LEAST_PACE));
        parameters.most_movement = of(&MOST_MOVEMENT);
        parameters.irregular = self.person.irregular;
        for (meal, skips) in Meal::ALL.into_iter().zip(self.person.skips) {
            if skips > 0.0 {
                parameters.skips.insert(Activity::Eat(meal), skips);
            }
        }
        if self.person.activity != 1.0 {
            parameters.active.push((None, self.person.activity));
        }
        for (source, strength) in self.in_force(day) {
            let source = &self.sources[source];
            if let Some(condition) = &source.condition {
                match parameters.severities.iter_mut().find(|(name, _)| name == condition) {
                    Some((_, severity)) => *severity += strength,
                    None => parameters.severities.push((condition.clone(), strength)),
                }
            }
            let changes = &source.routine.changes;
            for (index, (change, key)) in changes.iter().zip(&source.keys.changes).enumerate() {
                let full = strength * self.left_of(changes, index, day);
                if full > 0.0 && self.is_on(&change.days, day) {
                    let share = self.stream(key).unit();
                    // Counted from when it began: the change itself, or else the condition that brings it.
                    let phases = source.shown.iter().flatten().map(|(phase, _)| phase);
                    let shown = phases.filter_map(|phase| phase.from).map(|from| self.day_of(from));
                    let shown = shown.filter(|&from| from <= day).max();
                    let from = change.phase.from.map(|from| self.day_of(from)).or(shown).unwrap_or(0);
                    let weeks = (f64::from(day - from) / 7.0).clamp(0.0, most_weeks);
                    let span = Span { weeks, pace_mps: self.pace_mps, least_pace };
                    parameters.change(&change.effect, full, share, span);
                }
            }
        }
        parameters.level = self.level(day, parameters.differ);
        if let Some((_, times)) = self.said_kind(day) {
            parameters.active.push((None, times));
        }
        parameters
    }

    /// The changes that hold on a day.
    pub fn changes(&self, day: i32) -> impl Iterator<Item = SentenceId> {
        self.in_force(day).flat_map(move |(source, strength)| {
            let changes = &self.sources[source].routine.changes;
            let holds = move |index: &usize| strength * self.left_of(changes, *index, day) > 0.0;
            let id = move |index| SentenceId { source, kind: SentenceKind::Change, index };
            (0..changes.len()).filter(holds).map(id)
        })
    }

    /// How much of a change there is on a day: what the same text says later of the same thing replaces it as it comes.
    fn left_of(&self, changes: &[Change], index: usize, day: i32) -> f64 {
        let change = &changes[index];
        let begins = |change: &Change| change.phase.from.map_or(i32::MIN, |from| self.day_of(from));
        let later = changes.iter().enumerate().filter(|(other, of)| {
            (begins(of), *other) > (begins(change), index)
                && of.effect.is_of_the_same(&change.effect)
                && self.is_on(&of.days, day)
        });
        later.fold(self.phase(&change.phase, day), |left, (_, of)| left * (1.0 - self.phase(&of.phase, day)))
    }
}

/// The day of a moment, the run's first being 0.
fn day_in(calendar: &Calendar, moment: Moment) -> i32 {
    match moment {
        Moment::Day(day) => day,
        Moment::Date(year, month, day) => calendar.day_of(year, month, day).unwrap_or(i32::MAX),
    }
}

/// What a text says of one kind, with what goes for all of it.
fn each<'a, T>(
    all: &'a [T],
    keys: &'a [String],
    strength: f64,
    source: usize,
    kind: SentenceKind,
) -> impl Iterator<Item = InForce<'a, T>> + 'a {
    let all = all.iter().zip(keys).enumerate();
    all.map(move |(index, (said, key))| InForce { said, strength, key, source, kind, index })
}
