//! Sentences that contradict each other: each alone is understood, together they cannot be.

use super::activities::phrase;
use super::calendar::days_between;
use super::canonical::days_words;
use super::draft::RoutineDraft;
use super::faults::Faults;
use super::messages::{CheckMessage, WordMessage};
use crate::routine::{
    Activity, DaySelection, Effect, Habit, HabitTime, Meal, PartOfDay, Phase, PhaseDay, Response, RoutineRule,
    RuleTrigger,
};
use homebody_core::fuzzy::Fuzzy;
use homebody_core::nearest::nearest;
use std::collections::{BTreeMap, BTreeSet};

const USED_BY: [(&str, &[Activity]); 9] = {
    use crate::routine::Meal::{Breakfast, Dinner, Lunch};
    const COOKING: &[Activity] =
        &[Activity::Prepare(Breakfast), Activity::Prepare(Lunch), Activity::Prepare(Dinner), Activity::Drink];
    [
        ("stove", COOKING),
        ("oven", COOKING),
        ("hob", COOKING),
        ("cooker", COOKING),
        ("television", &[Activity::WatchTelevision]),
        ("tv", &[Activity::WatchTelevision]),
        ("washing machine", &[Activity::Laundry]),
        ("dryer", &[Activity::Laundry]),
        ("computer", &[Activity::UseComputer]),
    ]
};

pub fn check(draft: &RoutineDraft, faults: &mut Faults) {
    let all_understood = faults.count() == 0;
    twice_a_day(draft, faults);
    done_and_not_done(draft, faults);
    visitors_nearly_alike(draft, faults);
    bed_before_getting_up(draft, faults);
    if circles(draft, faults) || draft.is_condition || !all_understood {
        return;
    }
    home_while_out(draft, faults);
    too_much_for_a_day(draft, faults);
    home_without_leaving(draft, faults);
    missing_anchors(draft, faults);
    finders_who_never_come(draft, faults);
    idle_rules(draft, faults);
}

fn own_habits(draft: &RoutineDraft) -> impl Iterator<Item = (usize, &Habit)> + Clone {
    draft.routine.habits.iter().enumerate().filter(|(_, habit)| habit.visitor.is_none())
}

fn does(draft: &RoutineDraft, activity: &Activity) -> bool {
    own_habits(draft).any(|(_, habit)| habit.activity == *activity) || draft.usual.contains(activity)
}

fn share_days(draft: &RoutineDraft, a: &Habit, b: &Habit) -> bool {
    let before = |until: Option<PhaseDay>, from: Option<PhaseDay>| match until {
        Some(until) => days_between(from.unwrap_or(PhaseDay::Day(0)), until, draft.first_date).is_some_and(|d| d <= 0),
        None => false,
    };
    let is_other_kind = a.when.days.kind.zip(b.when.days.kind).is_some_and(|(a, b)| a != b);
    let is_other_weather = a.when.days.weather.zip(b.when.days.weather).is_some_and(|(a, b)| a != b);
    !is_other_kind
        && !is_other_weather
        && a.when.days.weekdays & b.when.days.weekdays != 0
        && a.when.days.months & b.when.days.months != 0
        && !before(a.when.phase.until, b.when.phase.from)
        && !before(b.when.phase.until, a.when.phase.from)
}

fn twice_a_day(draft: &RoutineDraft, faults: &mut Faults) {
    let meals = Meal::ALL.map(Activity::Eat);
    for activity in [Activity::GetUp, Activity::GoToBed].into_iter().chain(meals) {
        let timed = |habit: &Habit| matches!(habit.when.time, HabitTime::At(_) | HabitTime::Within(_));
        let list: Vec<_> = own_habits(draft).filter(|(_, habit)| habit.activity == activity && timed(habit)).collect();
        for (later, (index, habit)) in list.iter().enumerate() {
            let both = |other: &Habit| habit.when.chance.probability + other.when.chance.probability > 1.0 + 1e-9;
            let other = list[..later].iter().find(|(_, other)| share_days(draft, habit, other) && both(other));
            if let Some((_, other)) = other {
                let (activity, other_line) = (phrase(&activity).to_string(), other.said.line);
                let help = apart(habit, other);
                faults.add(draft.habit_spans[*index], CheckMessage::TwoTimes { activity, other_line, help });
            }
        }
    }
}

/// How to write two sentences so that they share no day. One that holds for a time or on few days is an exception of the other.
fn apart(habit: &Habit, other: &Habit) -> String {
    let is_always = |habit: &Habit| habit.when.phase.from.is_none() && habit.when.phase.until.is_none();
    let (exception, usual) = if is_always(habit) && !is_always(other) { (other, habit) } else { (habit, other) };
    let line = usual.said.line;
    let begins = exception.when.phase.from.filter(|_| is_always(usual)).map(String::from);
    let ends = exception.when.phase.until.filter(|_| is_always(usual)).map(String::from);
    let rest = usual.when.days.weekdays & !exception.when.days.weekdays;
    match (begins, ends) {
        (Some(from), Some(until)) => {
            format!(
                "write the sentence of line {line} twice, once with \"until {from}\" and once with \"from {until}\""
            )
        }
        (Some(from), None) => format!("add \"until {from}\" to the sentence of line {line}"),
        (None, Some(until)) => format!("add \"from {until}\" to the sentence of line {line}"),
        (None, None) if rest != 0 => {
            let days = days_words(&DaySelection { weekdays: rest, ..usual.when.days }).join(", ");
            format!("add {days:?} to the sentence of line {line}")
        }
        (None, None) => {
            "write on which days each sentence holds: \"on weekdays\", \"at weekends\", \"until day 100\"".to_owned()
        }
    }
}

/// Shortest and longest sleep by day of a person who goes to bed in the morning (our choice).
const SHORTEST_NIGHT_S: f64 = 3.0 * 3600.0;
const LONGEST_NIGHT_S: f64 = 12.0 * 3600.0;

fn visitors_nearly_alike(draft: &RoutineDraft, faults: &mut Faults) {
    const SHORTEST: usize = 5;
    let mut seen: Vec<&str> = Vec::new();
    for (index, habit) in draft.routine.habits.iter().enumerate() {
        let Some(name) = habit.visitor.as_deref().filter(|name| !seen.contains(name)) else { continue };
        let is_plural = |other: &str| name.strip_suffix('s') == Some(other) || other.strip_suffix('s') == Some(name);
        let near = nearest(name, seen.iter().copied()).filter(|near| near.len() >= SHORTEST && !is_plural(near));
        let is_slip = near.is_some_and(|near| {
            let sorted = |name: &str| {
                let mut letters: Vec<char> = name.chars().collect();
                letters.sort_unstable();
                letters
            };
            near.len().abs_diff(name.len()) == 1 || sorted(near) == sorted(name)
        });
        if let Some(near) = near.filter(|_| is_slip) {
            let (name, other) = (name.to_owned(), near.to_owned());
            faults.add(draft.habit_spans[index], WordMessage::SimilarVisitors { name, other });
        }
        seen.push(name);
    }
}

/// Smallest probability of an activity that is certain and cannot be left out (our choice).
const CERTAIN: f64 = 0.97;

/// "She naps every day", and "she never naps".
fn done_and_not_done(draft: &RoutineDraft, faults: &mut Faults) {
    for (index, habit) in own_habits(draft) {
        let never = draft.routine.changes.iter().find(|change| {
            let none = |factor: &Fuzzy| factor.high <= 0.0;
            let is_never = match &change.effect {
                Effect::Oftener { activity, factor } => {
                    *activity == habit.activity && change.when.part().is_none() && none(factor)
                }
                Effect::Skips { activity } => *activity == habit.activity && change.when.chance.probability >= 1.0,
                _ => false,
            };
            let from = change.when.phase.from.unwrap_or(PhaseDay::Day(0));
            let begins = habit.when.phase.from.unwrap_or(PhaseDay::Day(0));
            let is_before = days_between(from, begins, draft.first_date).is_some_and(|days| days >= 0);
            let all_days = change.when.days.weekdays & habit.when.days.weekdays == habit.when.days.weekdays
                && change.when.days.months & habit.when.days.months == habit.when.days.months
                && change.when.days.of_month == DaySelection::ALL.of_month
                && (change.when.days.kind.is_none() || change.when.days.kind == habit.when.days.kind)
                && change.when.days.every == 1
                && change.when.days.weather.is_none()
                && change.when.days.episode.is_none();
            is_never && is_before && all_days && change.when.phase.until.is_none() && change.when.phase.over_days == 0.0
        });
        if let Some(never) = never {
            let (other_line, other) = (never.said.line, never.said.text.trim().to_owned());
            faults.add(draft.habit_spans[index], CheckMessage::Contradiction { other_line, other });
        }
    }
}

/// From when to when a habit goes on for certain, in seconds of the day; nothing where that is open.
fn surely_from_to(habit: &Habit) -> Option<(f64, f64)> {
    let HabitTime::At(at) = habit.when.time else { return None };
    let is_certain =
        habit.when.chance.probability >= CERTAIN && habit.when.chance.becomes.is_none() && habit.when.times == (1, 1);
    let end = habit.when.until.map(|until| until.low).or(habit.when.lasts.map(|lasts| at.low + lasts.low))?;
    (is_certain && end > at.high).then_some((at.high, end))
}

fn home_while_out(draft: &RoutineDraft, faults: &mut Faults) {
    let is_of_days = |habit: &Habit| habit.when.lasts.is_some_and(|lasts| lasts.low >= 86_400.0);
    let outings: Vec<(usize, &Habit)> =
        own_habits(draft).filter(|(_, habit)| habit.activity == Activity::Leave && !is_of_days(habit)).collect();
    for (index, habit) in own_habits(draft) {
        let HabitTime::At(at) = habit.when.time else { continue };
        let is_meal = matches!(habit.activity, Activity::Eat(_) | Activity::Nap | Activity::Prepare(_));
        for (_, outing) in outings.iter().filter(|(_, outing)| share_days(draft, habit, outing)) {
            let is_within = surely_from_to(outing).is_some_and(|(from, to)| from < at.low && at.high < to);
            let on_its_days = habit.when.days.weekdays & outing.when.days.weekdays == habit.when.days.weekdays
                && (outing.when.days.kind.is_none() || outing.when.days.kind == habit.when.days.kind);
            let comes_home = habit.activity == Activity::ComeHome
                && (outing.when.lasts.is_some() || outing.when.until.is_some())
                && surely_from_to(outing).is_some();
            let (other_line, other) = (outing.said.line, outing.said.text.trim().to_owned());
            let message =
                match (comes_home, is_within && is_meal && on_its_days && habit.when.chance.probability >= CERTAIN) {
                    (true, _) => CheckMessage::HomeTwice { other_line, other },
                    (_, true) => CheckMessage::OutThen { other_line, other },
                    _ => continue,
                };
            faults.add(draft.habit_spans[index], message);
            break;
        }
    }
}

fn too_much_for_a_day(draft: &RoutineDraft, faults: &mut Faults) {
    /// Longest time awake of a person who still goes to bed (our choice).
    const MOST_AWAKE_S: f64 = 20.0 * 3600.0;
    let is_daily = |habit: &Habit| {
        habit.when.days == DaySelection::ALL
            && habit.when.phase == Phase::default()
            && habit.when.chance.probability >= CERTAIN
            && habit.when.chance.becomes.is_none()
            && habit.when.time != HabitTime::Within(PartOfDay::Night)
            && habit.activity != Activity::LieAwake
    };
    let length = |habit: &Habit| {
        let asked = habit.when.lasts.map(|lasts| lasts.low * f64::from(habit.when.times.0));
        asked.or_else(|| surely_from_to(habit).map(|(from, to)| to - from)).unwrap_or(0.0)
    };
    let time_of = |wanted: Activity| {
        own_habits(draft).map(|(_, habit)| habit).filter(|habit| habit.activity == wanted && is_daily(habit)).find_map(
            |habit| match habit.when.time {
                HabitTime::At(at) => Some(at),
                _ => None,
            },
        )
    };
    let awake_s = match (time_of(Activity::GetUp), time_of(Activity::GoToBed)) {
        (Some(up), Some(bed)) if bed.high > up.low => bed.high - up.low,
        _ => MOST_AWAKE_S,
    };
    let mut sum = 0.0;
    let mut lines: Vec<u32> = Vec::new();
    for (index, habit) in own_habits(draft).filter(|(_, habit)| is_daily(habit) && length(habit) > 0.0) {
        sum += length(habit);
        if sum > awake_s {
            let message = CheckMessage::FullDay { other_lines: lines.clone(), awake_h: awake_s / 3600.0 };
            faults.add(draft.habit_spans[index], message);
            return;
        }
        lines.push(habit.said.line);
    }
}

fn bed_before_getting_up(draft: &RoutineDraft, faults: &mut Faults) {
    let at = |habit: &Habit| match habit.when.time {
        HabitTime::At(at) => Some((at.from + at.to) / 2.0),
        _ => None,
    };
    let up: Vec<_> = own_habits(draft).filter(|(_, habit)| habit.activity == Activity::GetUp).collect();
    for (index, bed) in own_habits(draft).filter(|(_, habit)| habit.activity == Activity::GoToBed) {
        let Some(time) = at(bed) else { continue };
        let is_nap = |up: f64| !(SHORTEST_NIGHT_S..LONGEST_NIGHT_S).contains(&(up - time));
        let early = |up: &Habit| at(up).is_some_and(|up| time <= up && is_nap(up)) && share_days(draft, bed, up);
        if let Some((_, up)) = up.iter().find(|(_, up)| early(up)) {
            faults.add(draft.habit_spans[index], CheckMessage::BedBeforeUp { other_line: up.said.line });
        }
    }
}

fn home_without_leaving(draft: &RoutineDraft, faults: &mut Faults) {
    if does(draft, &Activity::Leave) {
        return;
    }
    for (index, _) in own_habits(draft).filter(|(_, habit)| habit.activity == Activity::ComeHome) {
        faults.add(draft.habit_spans[index], CheckMessage::HomeWithoutLeaving);
    }
}

fn anchor(habit: &Habit) -> Option<&Activity> {
    match &habit.when.time {
        HabitTime::After(activity, _) | HabitTime::Before(activity, _) | HabitTime::With(activity) => Some(activity),
        _ => None,
    }
}

fn missing_anchors(draft: &RoutineDraft, faults: &mut Faults) {
    for (index, habit) in draft.routine.habits.iter().enumerate() {
        let Some(other) = anchor(habit) else { continue };
        let is_done = match other {
            Activity::GetUp | Activity::GoToBed => true,
            Activity::Visit => draft.routine.habits.iter().any(|habit| habit.activity == Activity::Visit),
            Activity::Eat(meal) => does(draft, other) || does(draft, &Activity::Prepare(*meal)),
            Activity::ComeHome => does(draft, other) || does(draft, &Activity::Leave),
            other => does(draft, other),
        };
        if !is_done {
            let time = match other {
                Activity::Eat(Meal::Breakfast) => "8:00",
                Activity::Eat(Meal::Dinner) => "18:00",
                _ => "12:00",
            };
            let (activity, time) = (phrase(other).to_string(), time.to_owned());
            faults.add(draft.habit_spans[index], CheckMessage::NoAnchor { activity, time });
        }
    }
}

fn finders_who_never_come(draft: &RoutineDraft, faults: &mut Faults) {
    let comes = |who: &str| draft.routine.habits.iter().any(|habit| habit.visitor.as_deref() == Some(who));
    for (who, span) in draft.finders.iter().filter(|(who, _)| !comes(who)) {
        faults.add(*span, CheckMessage::FinderNeverComes { visitor: who.to_owned() });
    }
}

fn circles(draft: &RoutineDraft, faults: &mut Faults) -> bool {
    // Activities that are only ever said to be before, after or with others.
    let mut relative: BTreeMap<&Activity, BTreeSet<&Activity>> = BTreeMap::new();
    for (_, habit) in own_habits(draft) {
        if let Some(other) = anchor(habit) {
            relative.entry(&habit.activity).or_default().insert(other);
        }
    }
    for (_, habit) in own_habits(draft).filter(|(_, habit)| anchor(habit).is_none()) {
        relative.remove(&habit.activity);
    }
    loop {
        let timed = |others: &BTreeSet<&Activity>| others.iter().any(|other| !relative.contains_key(*other));
        let next = relative.iter().find(|(_, others)| timed(others)).map(|(activity, _)| *activity);
        let Some(next) = next else { break };
        relative.remove(next);
    }
    let mut any = false;
    for (index, habit) in own_habits(draft).filter(|(_, habit)| relative.contains_key(&habit.activity)) {
        let Some(other) = anchor(habit) else { continue };
        let back = own_habits(draft).find(|(_, back)| back.activity == *other);
        let line = back.map_or(habit.said.line, |(_, back)| back.said.line);
        let message = match *other == habit.activity {
            true => CheckMessage::AfterItself { activity: phrase(other).to_string() },
            false => CheckMessage::Circle { other_line: line },
        };
        faults.add(draft.habit_spans[index], message);
        any = true;
    }
    any
}

fn idle_rules(draft: &RoutineDraft, faults: &mut Faults) {
    for (rule, (trigger, lasts)) in draft.routine.rules.iter().zip(&draft.rule_spans) {
        match &rule.whenever {
            RuleTrigger::On(thing) => {
                let folded = format!(" {} ", thing.to_lowercase());
                let used = USED_BY.iter().find(|(name, _)| folded.contains(&format!(" {name} ")));
                let Some((_, activities)) = used else { continue };
                if !activities.iter().any(|activity| does(draft, activity)) {
                    let (thing, activity) = (thing.to_string(), phrase(&activities[0]).to_string());
                    faults.add(*trigger, CheckMessage::NeverUsed { thing, activity });
                }
            }
            RuleTrigger::Away => {
                let outings: Vec<&Habit> =
                    own_habits(draft).map(|(_, habit)| habit).filter(|h| h.activity == Activity::Leave).collect();
                if outings.is_empty() && !does(draft, &Activity::Leave) {
                    faults.add(*trigger, CheckMessage::NeverOut);
                } else if !outings.is_empty()
                    && outings.iter().all(|habit| longest(habit).is_some_and(|most| most < rule.lasts.low))
                {
                    faults.add(*lasts, CheckMessage::NeverOutSoLong);
                }
            }
            RuleTrigger::Doing(activity) | RuleTrigger::Done(activity)
                if !does(draft, activity) && !is_answered(draft, activity) =>
            {
                faults.add(*trigger, CheckMessage::NeverDone { activity: phrase(activity).to_string() });
            }
            _ => {}
        }
    }
}

fn is_answered(draft: &RoutineDraft, activity: &Activity) -> bool {
    let is_it = |answer: &Response| matches!(answer, Response::Do { activity: done, .. } if done == activity);
    draft.routine.rules.iter().flat_map(RoutineRule::answers).any(is_it)
}

fn longest(habit: &Habit) -> Option<f64> {
    match (habit.when.lasts, habit.when.until, &habit.when.time) {
        (Some(Fuzzy { high, .. }), _, _) => Some(high),
        (None, Some(until), HabitTime::At(at)) => Some(until.high - at.low),
        _ => None,
    }
}
