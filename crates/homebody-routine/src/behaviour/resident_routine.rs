//! A resident's routine with its conditions, and its state on each day.
//!
//! Every random number comes from a stream with the day and the purpose in its name, never from one that was drawn from
//! before. So two runs that differ in one condition draw the same numbers for all that it does not affect.

use super::keys::Keys;
pub use super::parameters::DayParameters;
use super::parameters::{
    BUSY_DAY, ChangeCourse, DAY_LIKE, DAY_SPREAD, LEAST_PACE, MOST_MOVEMENT, MOST_WEEKS, QUIET_DAY,
};
use super::traits::{Constitution, MemberDifference};
use crate::routine::{
    Activity, DayKind, DaySelection, Effect, Habit, HabitChance, HabitTime, Meal, Phase, PhaseDay, Quote, Routine,
    RoutineChange, RoutineRule, WalkRests,
};
use homebody_core::calendar::Calendar;
use homebody_core::fuzzy::Quantifier;
use homebody_core::numbers::Numbers;
use homebody_core::random::Stream;
use homebody_core::time::{DAY, Interval, RunTime, Span};
use homebody_walk::Gains;
use std::collections::BTreeMap;
use std::sync::Arc;

#[derive(Clone, Debug)]
pub struct ResidentRoutine {
    pub name: String,
    pub calendar: Calendar,
    /// In metres per second, from the resident's file or else the routine.
    pub pace_mps: f64,
    /// The stated pace; if exact, it does not vary between people.
    written_mps: f64,
    has_exact_pace: bool,
    /// Rests on the way.
    pub rests: Option<WalkRests>,
    /// Whether it varies around the routine, as a member of a cohort.
    is_one_of_many: bool,
    seed: u64,
    /// The routine, then usual habits that it leaves unsaid, then conditions; shared by all seeds.
    sources: Arc<Vec<RoutineSource>>,
    pub constitution: Constitution,
    pub person: MemberDifference,
    pub numbers: Numbers,
    /// From the resident's file.
    pub gains: Gains,
}

/// A routine or a condition, with the time in which it applies.
#[derive(Clone, Debug)]
struct RoutineSource {
    routine: Routine,
    keys: Keys,
    condition: Option<String>,
    /// Phases and severities of the sentences that show it, in order of their start. A later one replaces those before it.
    /// Empty if it always applies.
    shown: Vec<Vec<(Phase, f64)>>,
}

/// A sentence: a habit, a rule or a change of one of the texts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct SentenceId {
    /// 0 for the routine, 1 for the usual habits, then conditions.
    pub source: usize,
    pub kind: SentenceKind,
    /// Among those of its kind.
    pub index: usize,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum SentenceKind {
    Habit,
    Rule,
    Change,
}

/// A habit or a rule that applies on a day.
#[derive(Clone, Copy, Debug)]
pub struct InForce<'a, T> {
    pub said: &'a T,
    /// Severity of its condition; 1 for the routine itself.
    pub strength: f64,
    /// Name of its random streams.
    pub key: &'a str,
    /// 0 for the routine, 1 for the usual habits, then conditions.
    pub source: usize,
    kind: SentenceKind,
    index: usize,
}

impl<T> InForce<'_, T> {
    pub fn id(&self) -> SentenceId {
        SentenceId { source: self.source, kind: self.kind, index: self.index }
    }
}

/// Largest depth of conditions that show each other; deeper is a loop.
const DEPTH: usize = 8;

impl ResidentRoutine {
    /// `ordinary` fills in what the routine does not mention, `conditions` are those it shows, by name. With
    /// `is_one_of_many`, it varies as people do.
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
    ) -> ResidentRoutine {
        let pace = routine.person.as_ref().and_then(|person| person.pace_mps);
        let written_mps = pace.map_or(pace_mps, |pace| pace.mean());
        let mut life = ResidentRoutine {
            name: name.into(),
            calendar: calendar.clone(),
            pace_mps: written_mps,
            written_mps,
            rests: routine.person.as_ref().and_then(|person| person.rests),
            has_exact_pace: pace.is_some_and(|pace| pace.low >= pace.high),
            is_one_of_many,
            seed,
            sources: Arc::default(),
            constitution: Constitution::draw(numbers, &mut ResidentRoutine::constitution_of(name, seed)),
            person: MemberDifference::AS_WRITTEN,
            numbers: numbers.clone(),
            gains: Gains::USUAL,
        };
        life.draw();
        life.add_conditions(&routine.changes.clone(), &[], conditions, 0);
        for source in Arc::make_mut(&mut life.sources) {
            let begins = |shown: &Vec<(Phase, f64)>| {
                shown.iter().filter_map(|(phase, _)| phase.from).map(|from| from.of_run(calendar)).max()
            };
            source.shown.sort_by_key(begins);
        }
        let (own_keys, ordinary_keys) = (Keys::new(&routine, "own"), Keys::new(&ordinary, "ordinary"));
        let always = |routine, keys| RoutineSource { routine, keys, condition: None, shown: Vec::new() };
        let ordinary = always(ordinary, ordinary_keys);
        Arc::make_mut(&mut life.sources).splice(0..0, [always(routine, own_keys), ordinary]);
        life
    }

    /// The same texts with another seed.
    pub fn with_seed(&self, seed: u64) -> ResidentRoutine {
        let mut life = ResidentRoutine { seed, ..self.clone() };
        life.draw();
        life
    }

    /// Draws the traits that no text states.
    fn draw(&mut self) {
        self.constitution =
            Constitution::draw(&self.numbers, &mut ResidentRoutine::constitution_of(&self.name, self.seed));
        self.person = match self.is_one_of_many {
            true => MemberDifference::draw(&self.numbers, &mut self.stream("person")),
            false => MemberDifference::AS_WRITTEN,
        };
        // An exact pace does not vary between people.
        let factor = if self.has_exact_pace { 1.0 } else { self.person.pace };
        self.pace_mps = self.written_mps * factor;
    }

    fn constitution_of(name: &str, seed: u64) -> Stream {
        Stream::named(seed, &format!("resident/{name}/constitution"))
    }

    fn add_conditions(
        &mut self,
        changes: &[RoutineChange],
        shown: &[(Phase, f64)],
        conditions: &BTreeMap<String, Routine>,
        depth: usize,
    ) {
        for change in changes {
            let Effect::Shows { condition, severity } = &change.effect else { continue };
            let Some(routine) = conditions.get(condition).filter(|_| depth < DEPTH) else { continue };
            let shown: Vec<(Phase, f64)> = shown.iter().copied().chain([(change.when.phase, *severity)]).collect();
            self.add_conditions(&routine.changes, &shown, conditions, depth + 1);
            let sources = Arc::make_mut(&mut self.sources);
            if let Some(known) = sources.iter_mut().find(|source| source.condition.as_ref() == Some(condition)) {
                known.shown.push(shown);
                continue;
            }
            let (keys, condition, shown) = (Keys::new(routine, condition), Some(condition.clone()), vec![shown]);
            sources.push(RoutineSource { routine: routine.clone(), keys, condition, shown });
        }
    }

    /// The sources of the routine itself, and of the usual habits.
    pub const OWN: usize = 0;
    pub const UNSAID: usize = 1;

    /// Usual habits that the routine never mentions.
    pub fn unsaid(&self) -> Routine {
        let ordinary = &self.sources[ResidentRoutine::UNSAID].routine;
        let own = &self.sources[ResidentRoutine::OWN].routine.habits;
        let is_unsaid = |habit: &&Habit| !own.iter().any(|said| said.stands_for(habit));
        Routine { habits: ordinary.habits.iter().filter(is_unsaid).cloned().collect(), ..ordinary.clone() }
    }

    /// Whether the routine states on this day what is otherwise usual.
    pub fn says(&self, usual: &Habit, day: i32) -> bool {
        let own = &self.sources[ResidentRoutine::OWN].routine.habits;
        let is_from_start = |said: &Habit| said.when.phase.from.is_none();
        let of_usual = || own.iter().filter(|said| said.stands_for(usual));
        // A club that begins in the course of a run comes on top of the usual outings, on other days.
        let is_added = |said: &Habit| {
            usual.activity.is_of_choice() && said.when.time != HabitTime::AnyTime && !of_usual().any(is_from_start)
        };
        let replaces = |said: &Habit| {
            self.phase(&said.when.phase, day) > 0.0
                && (!usual.activity.is_of_every_day() && !is_added(said) || self.is_on(&said.when.days, day))
        };
        of_usual().any(replaces) || self.has_ended(&usual.activity, day)
    }

    /// Whether a sentence said an activity of choice from the first day on until a day that is past: nothing replaces it.
    /// Meals, washing and housework come back as usual.
    pub fn has_ended(&self, activity: &Activity, day: i32) -> bool {
        let own = &self.sources[ResidentRoutine::OWN].routine.habits;
        let is_past = |phase: &Phase| {
            let until = phase.until.map(|until| self.day_of(until));
            phase.from.is_none() && until.is_some_and(|until| until <= day) && self.phase(phase, day) == 0.0
        };
        let of_it = own.iter().filter(|habit| habit.activity == *activity && habit.visitor.is_none());
        activity.is_of_choice() && { of_it }.any(|habit| is_past(&habit.when.phase))
    }

    /// Whether the routine gives a time of visits to the bathroom in a night that begins on a day: it has no others.
    pub fn says_visits_in(&self, night: Interval<RunTime>, day: i32) -> bool {
        let own = &self.sources[ResidentRoutine::OWN].routine.habits;
        let is_visit = |habit: &&Habit| habit.activity == Activity::UseBathroom && habit.visitor.is_none();
        let is_in_it = |habit: &Habit, day: i32| match &habit.when.time {
            HabitTime::At(time) => self.is_meant(habit, day) && night.contains(self.instant(day, time.mean())),
            _ => false,
        };
        own.iter().filter(is_visit).any(|habit| is_in_it(habit, day) || is_in_it(habit, day + 1))
    }

    /// Whether a habit applies to a day, drawn or not.
    pub fn is_meant(&self, habit: &Habit, day: i32) -> bool {
        self.is_on(&habit.when.days, day) && self.phase(&habit.when.phase, day) > 0.0
    }

    /// All sentences, each with its source and words.
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

    pub fn file(&self) -> &String {
        &self.sources[ResidentRoutine::OWN].routine.file
    }

    pub fn habit(&self, id: SentenceId) -> Option<&Habit> {
        let source = self.sources.get(id.source).filter(|_| id.kind == SentenceKind::Habit)?;
        source.routine.habits.get(id.index)
    }

    pub fn rule(&self, id: SentenceId) -> Option<&RoutineRule> {
        let source = self.sources.get(id.source).filter(|_| id.kind == SentenceKind::Rule)?;
        source.routine.rules.get(id.index)
    }

    pub fn change(&self, id: SentenceId) -> Option<&RoutineChange> {
        let source = self.sources.get(id.source).filter(|_| id.kind == SentenceKind::Change)?;
        source.routine.changes.get(id.index)
    }

    pub fn stream(&self, purpose: &str) -> Stream {
        Stream::named(self.seed, &format!("resident/{}/{purpose}", self.name))
    }

    /// The same for all residents.
    pub(super) fn stream_of_home(&self, purpose: &str) -> Stream {
        Stream::named(self.seed, purpose)
    }

    pub fn stream_of_day(&self, day: i32, purpose: &str) -> Stream {
        self.stream(&format!("day/{day}/{purpose}"))
    }

    /// The start of a day's hours: whole days before noon, so that hours are right from the morning on even when clocks
    /// change.
    pub fn midnight(&self, day: i32) -> RunTime {
        self.calendar.instant(day, DAY / 2) - DAY / 2
    }

    /// In seconds since midnight.
    pub fn instant(&self, day: i32, time_s: f64) -> RunTime {
        self.calendar.instant(day, Span::from_seconds(time_s))
    }

    /// In the order of the texts.
    pub fn habits(&self, day: i32) -> impl Iterator<Item = InForce<'_, Habit>> {
        self.in_force(day).flat_map(move |(index, strength)| {
            let source = &self.sources[index];
            each(&source.routine.habits, &source.keys.habits, strength, index, SentenceKind::Habit)
        })
    }

    pub fn rules(&self, day: i32) -> impl Iterator<Item = InForce<'_, RoutineRule>> {
        self.in_force(day).flat_map(move |(index, strength)| {
            let source = &self.sources[index];
            each(&source.routine.rules, &source.keys.rules, strength, index, SentenceKind::Rule)
        })
    }

    /// Whether the routine states how often a need is met, by day or at night: the need then does not rise. An activity
    /// with a time, or after another, is additional, as is that of a condition.
    pub fn says_how_often(&self, activity: &Activity, day: i32, at_night: bool) -> bool {
        let own = &self.sources[ResidentRoutine::OWN].routine.habits;
        own.iter().any(|habit| habit.is_how_often(activity, at_night) && self.is_meant(habit, day))
    }

    pub fn visitors(&self) -> Vec<String> {
        let habits = self.sources.iter().flat_map(|source| &source.routine.habits);
        let mut visitors: Vec<String> = habits.filter_map(|habit| habit.visitor.clone()).collect();
        visitors.sort();
        visitors.dedup();
        visitors
    }

    /// The texts that apply on a day, with strength.
    fn in_force(&self, day: i32) -> impl Iterator<Item = (usize, f64)> {
        let strengths = self.sources.iter().map(move |source| self.strength(source, day)).enumerate();
        strengths.filter(|(_, strength)| *strength > 0.0)
    }

    fn strength(&self, source: &RoutineSource, day: i32) -> f64 {
        if source.shown.is_empty() {
            return 1.0;
        }
        // As far as one has grown, those before it are replaced.
        source.shown.iter().fold(0.0, |before, shown| {
            let come: f64 = shown.iter().map(|(phase, _)| self.phase(phase, day)).product();
            let severity: f64 = shown.iter().map(|(_, severity)| severity).product();
            before * (1.0 - come) + severity * come
        })
    }

    /// 1 is a moderate case.
    pub fn severity(&self, condition: &str, day: i32) -> f64 {
        let of_it =
            self.in_force(day).filter(|(source, _)| self.sources[*source].condition.as_deref() == Some(condition));
        of_it.map(|(_, strength)| strength).sum()
    }

    /// From 0 before it to 1 at full strength.
    pub fn phase(&self, phase: &Phase, day: i32) -> f64 {
        let day_of = |moment: PhaseDay| f64::from(self.day_of(moment));
        let day = f64::from(day);
        let ramp = |from: f64, over: f64| if over > 0.0 { ((day - from + 1.0) / over).min(1.0) } else { 1.0 };
        let risen = match phase.from.map(day_of) {
            Some(from) if day < from => 0.0,
            Some(from) => ramp(from, phase.over_days),
            None => ramp(0.0, phase.over_days),
        };
        let left = match phase.until.map(day_of) {
            // After `until` only the fading rest remains.
            Some(until) if day >= until => {
                let faded = (day - until + 1.0) / phase.fading_days;
                if phase.fading_days > 0.0 { (1.0 - faded).max(0.0) } else { 0.0 }
            }
            _ => 1.0,
        };
        risen * left
    }

    /// The run's first day is 0.
    pub fn day_of(&self, moment: PhaseDay) -> i32 {
        moment.of_run(&self.calendar)
    }

    pub fn is_on(&self, days: &DaySelection, day: i32) -> bool {
        days.has_date(&self.calendar, day)
            && days.kind.is_none_or(|kind| self.is_of_kind(kind, day))
            && self.is_such_a_day(days, day)
    }

    /// The probability on a day that the habit applies to.
    pub fn chance(&self, habit: &Habit, strength: f64, day: i32) -> f64 {
        (self.chance_by(&habit.when.chance, &habit.when.phase, day) * strength * self.phase(&habit.when.phase, day))
            .min(1.0)
    }

    /// The probability of a changing chance by a day.
    fn chance_by(&self, of: &HabitChance, phase: &Phase, day: i32) -> f64 {
        let mut chance = of.probability;
        if let Some((later, moment)) = of.becomes {
            let from = phase.from.map_or(0, |moment| self.day_of(moment));
            let whole = f64::from(self.day_of(moment) - from).max(1.0);
            chance += (later - chance) * (f64::from(day - from) / whole).clamp(0.0, 1.0);
        }
        chance
    }

    ///
    /// The activity level of a day: an autoregression of the first order of its logarithm, cut off after a week.
    ///
    /// If days differ more, the mean stays.
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

    /// The share of days quieter than this one; for busy days, of those busier.
    fn share_beyond(&self, kind: DayKind, day: i32) -> f64 {
        let like = self.numbers.of(&DAY_LIKE);
        let lively = libm::sqrt(1.0 - like * like) * self.remembered(day);
        let beyond = if kind == DayKind::Quiet { -lively } else { lively };
        libm::erfc(beyond / std::f64::consts::SQRT_2) / 2.0
    }

    /// The kind of a day by sentences, and its factor on movement. The quietest days become the quiet ones, the busiest the
    /// busy ones.
    fn said_kind(&self, day: i32) -> Option<(DayKind, f64)> {
        self.kinds_said(day).find_map(|(change, strength)| {
            let Effect::DaysAre { kind, very } = &change.effect else { return None };
            let chance = &change.when.chance;
            let is_one = self.is_on(&change.when.days, day)
                && match chance.days_a_week {
                    Some(days) => strength > 0.0 && self.is_among(*kind, days, &change.when.days, day),
                    None => self.share_beyond(*kind, day) < self.chance_by(chance, &change.when.phase, day) * strength,
                };
            let times = self.numbers.of(if *kind == DayKind::Quiet { &QUIET_DAY } else { &BUSY_DAY });
            is_one.then_some((*kind, if *very { times * times } else { times }))
        })
    }

    /// The sentences about quiet and busy days, with their strength.
    fn kinds_said(&self, day: i32) -> impl Iterator<Item = (&RoutineChange, f64)> {
        self.in_force(day).flat_map(move |(source, strength)| {
            let changes = &self.sources[source].routine.changes;
            let of_days = changes.iter().enumerate().filter(|(_, of)| matches!(of.effect, Effect::DaysAre { .. }));
            of_days.map(move |(index, change)| (change, strength * self.left_of(changes, index, day)))
        })
    }

    /// Whether a day is among the quietest or busiest of its week.
    fn is_among(&self, kind: DayKind, days: u8, of: &DaySelection, today: i32) -> bool {
        let own = self.share_beyond(kind, today);
        let before = self.week_of(today).filter(|&day| day != today && self.is_on(of, day));
        before.filter(|&day| self.share_beyond(kind, day) < own).count() < usize::from(days)
    }

    /// Monday to Sunday.
    pub fn week_of(&self, day: i32) -> std::ops::Range<i32> {
        let monday = day - i32::from(self.calendar.weekday(day));
        monday..monday + 7
    }

    /// The place of a day among the days of its week that a sentence may be on, in drawn order, and the number of these days.
    pub fn place_in_week(&self, days: &DaySelection, key: &str, today: i32) -> (f64, f64) {
        let meant: Vec<i32> = self.week_of(today).filter(|&day| self.is_on(days, day)).collect();
        let share = |day: i32| self.stream_of_day(day, &format!("{key}/of the week")).unit();
        let own = share(today);
        let before = meant.iter().filter(|&&day| day != today && share(day) < own).count();
        (before as f64, meant.len() as f64)
    }

    /// Without a sentence about them, some days are of each kind.
    fn is_of_kind(&self, kind: DayKind, day: i32) -> bool {
        let is_said = |(change, strength): (&RoutineChange, f64)| {
            strength > 0.0 && matches!(change.effect, Effect::DaysAre { kind: of, .. } if of == kind)
        };
        match self.kinds_said(day).any(is_said) {
            true => self.said_kind(day).is_some_and(|(of, _)| of == kind),
            false => self.share_beyond(kind, day) < Quantifier::Sometimes.probability(),
        }
    }

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
                if full > 0.0 && self.is_on(&change.when.days, day) {
                    let share = self.stream(key).unit();
                    // Counted from the start of the change, or else of the condition.
                    let phases = source.shown.iter().flatten().map(|(phase, _)| phase);
                    let shown = phases.filter_map(|phase| phase.from).map(|from| self.day_of(from));
                    let shown = shown.filter(|&from| from <= day).max();
                    let from = change.when.phase.from.map(|from| self.day_of(from)).or(shown).unwrap_or(0);
                    let weeks = (f64::from(day - from) / 7.0).clamp(0.0, most_weeks);
                    let chance = match change.when.chance.days_a_week.filter(|_| change.effect.is_of_a_day()) {
                        Some(days) => {
                            (f64::from(days) - self.place_in_week(&change.when.days, key, day).0).clamp(0.0, 1.0)
                        }
                        None => self.chance_by(&change.when.chance, &change.when.phase, day),
                    };
                    let course = ChangeCourse { weeks, chance, pace_mps: self.pace_mps, least_pace };
                    parameters.change(change, full, share, course);
                }
            }
        }
        parameters.level = self.level(day, parameters.differ);
        if let Some((_, times)) = self.said_kind(day) {
            parameters.active.push((None, times));
        }
        parameters
    }

    /// Whether the routine leaves out an activity on a day by chance.
    pub fn skips(&self, parameters: &DayParameters, activity: &Activity, day: i32) -> bool {
        let share = self.stream_of_day(day, &format!("skip/{}", activity.label())).unit();
        share < parameters.skips(activity)
    }

    /// Whether the routine leaves out the rising of a day.
    pub fn stays_in_bed(&self, parameters: &DayParameters, day: i32) -> bool {
        self.skips(parameters, &Activity::GetUp, day) || parameters.oftener(&Activity::GetUp, None) <= 0.0
    }

    pub fn changes(&self, day: i32) -> impl Iterator<Item = SentenceId> {
        self.in_force(day).flat_map(move |(source, strength)| {
            let changes = &self.sources[source].routine.changes;
            let holds = move |index: &usize| strength * self.left_of(changes, *index, day) > 0.0;
            let id = move |index| SentenceId { source, kind: SentenceKind::Change, index };
            (0..changes.len()).filter(holds).map(id)
        })
    }

    /// The remaining strength of a change: a later sentence of the same text on the same subject replaces it as it grows.
    fn left_of(&self, changes: &[RoutineChange], index: usize, day: i32) -> f64 {
        let change = &changes[index];
        let begins = |change: &RoutineChange| change.when.phase.from.map_or(i32::MIN, |from| self.day_of(from));
        let later = changes.iter().enumerate().filter(|(other, of)| {
            (begins(of), *other) > (begins(change), index)
                && of.is_of_the_same(change)
                && self.is_on(&of.when.days, day)
        });
        later.fold(self.phase(&change.when.phase, day), |left, (_, of)| left * (1.0 - self.phase(&of.when.phase, day)))
    }
}

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
