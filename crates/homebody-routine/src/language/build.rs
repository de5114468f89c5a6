//! The meaning of a complete clause: a habit, a change, or facts about the person.

use super::absence::staying;
use super::adverbs::Adverbs;
use super::amounts::{ABOUT_SHARE, DAY_S};
use super::clause::{Clause, PLACES};
use super::draft::RoutineDraft;
use super::falling::time_of_fall;
use super::meaning::AdverbKind;
use super::measures::{self, AmountPhrase, FASTEST_MPS, Of};
use super::messages::{SentenceMessage, TimeSentenceMessage, WordMessage};
use super::predicate::Predicate;
use super::predicates::IS;
use super::reader::{SentenceReader, Sort};
use super::subjects::SentenceSubject;
use super::times::is_of_next_day;
use super::unknown_word::{is_way, unknown_doing};
use super::words::TextSpan;
use crate::routine::{
    Activity, Effect, Habit, HabitChance, HabitTime, PartOfDay, ResidentKind, RoutineChange, RoutinePerson, Shy, When,
};
use homebody_core::activity::{Help, TimeUse};
use homebody_core::fuzzy::{Fuzzy, Quantifier};

pub fn build(reader: &mut SentenceReader, draft: &mut RoutineDraft, mut clause: Clause) {
    for beside in std::mem::take(&mut clause.beside) {
        draft.routine.remarks.push(draft.said(beside));
    }
    match clause.predicate {
        Predicate::Age(_) | Predicate::Kind(_) | Predicate::Pace(_) => person(reader, draft, &clause),
        Predicate::Visits | Predicate::Own(_) | Predicate::Falls(_) => habit(reader, draft, clause),
        Predicate::Remark => remark(reader, draft, &clause),
        Predicate::Sleeps if clause.measure.is_none() && clause.place.is_some() => sleeps(reader, draft, clause),
        Predicate::Helps(ref activity, help) => {
            let activity = activity.clone();
            helps(reader, draft, clause, activity, help);
        }
        Predicate::VisitedBy(ref who) => {
            let subject = SentenceSubject::Visitor(who.clone());
            habit(reader, draft, Clause { subject, predicate: Predicate::Visits, ..clause });
        }
        Predicate::HelpedBy(ref who, ref activity) => {
            let (subject, activity) = (SentenceSubject::Visitor(who.clone()), activity.clone());
            helps(reader, draft, Clause { subject, ..clause }, activity, Help::Together);
        }
        Predicate::Does(_) if clause.measure.is_none() => habit(reader, draft, clause),
        _ => change(reader, draft, &clause),
    }
}

/// "She sleeps in the recliner": by day a nap, by night where her bed is.
fn sleeps(reader: &mut SentenceReader, draft: &mut RoutineDraft, clause: Clause) {
    let part = clause.adverbs.part.as_ref().map(|part| part.value);
    if part.is_some_and(|part| part != PartOfDay::Night) {
        return habit(reader, draft, Clause { predicate: Predicate::Does(Activity::Nap), ..clause });
    }
    let why = "a sleeping place holds for all nights; for sleep by day, write \"naps\"";
    let is_every = |chance: &HabitChance| chance.quantifier == Some(Quantifier::Every);
    if clause.adverbs.chance.as_ref().is_some_and(|chance| is_every(&chance.value)) {
        only(reader, &clause.adverbs, &[AdverbKind::Chance, AdverbKind::Part], why);
    } else {
        only(reader, &clause.adverbs, &[AdverbKind::Part], why);
    }
    let adverbs = Adverbs::default();
    habit(reader, draft, Clause { predicate: Predicate::Does(Activity::GoToBed), adverbs, ..clause });
}

fn remark(reader: &mut SentenceReader, draft: &mut RoutineDraft, clause: &Clause) {
    if let Some(measure) = &clause.measure {
        misfit(reader, measure, "the sentence states a fact, not a change");
    }
    only(reader, &clause.adverbs, &[AdverbKind::Phase], "this describes the person, not an activity");
    draft.routine.remarks.push(draft.said(clause.span));
}

fn helps(reader: &mut SentenceReader, draft: &mut RoutineDraft, clause: Clause, activity: Activity, help: Help) {
    let done = draft.routine.habits.len();
    habit(reader, draft, Clause { predicate: Predicate::Visits, ..clause.clone() });
    let Some(visit) = draft.routine.habits.get(done).cloned() else { return };
    // "Does the floors and the bathroom" is one visit.
    let is_same = |other: &Habit| Habit { said: visit.said.clone(), ..other.clone() } == visit;
    if clause.again && draft.routine.habits[..done].iter().any(is_same) {
        draft.routine.habits.truncate(done);
        draft.habit_spans.truncate(done);
    }
    match help {
        Help::Together => {
            let is_of_day = matches!(activity, Activity::GetUp | Activity::GoToBed);
            if is_of_day && !matches!(visit.when.time, HabitTime::At(_)) {
                return reader.fault(clause.predicate_span, SentenceMessage::WhenHelped);
            }
            let time = if is_of_day { visit.when.time.clone() } else { HabitTime::With(Activity::Visit) };
            let when = When { time, lasts: None, until: None, ..visit.when };
            draft.routine.habits.push(Habit { visitor: None, activity, when, place: None, ..visit });
            draft.habit_spans.push(clause.predicate_span);
        }
        Help::Instead => {
            let factor = Fuzzy::exactly(1.0 - visit.when.chance.probability);
            let effect = Effect::Oftener { activity, factor };
            let when = When { days: visit.when.days, phase: visit.when.phase, ..When::default() };
            draft.routine.changes.push(RoutineChange { said: visit.said, when, effect });
        }
    }
}

pub fn only(reader: &mut SentenceReader, adverbs: &Adverbs, allowed: &[AdverbKind], why: &str) {
    let others: Vec<AdverbKind> = AdverbKind::ALL.into_iter().filter(|kind| !allowed.contains(kind)).collect();
    for span in adverbs.spans(&others) {
        reader.fault(span, SentenceMessage::DoesNotFit { text: reader.said(span), reason: why.to_owned() });
    }
}

fn person(reader: &mut SentenceReader, draft: &mut RoutineDraft, clause: &Clause) {
    let span = clause.predicate_span;
    if draft.is_condition {
        return reader.fault(span, WordMessage::ConditionFact { text: reader.said(span) });
    }
    only(reader, &clause.adverbs, &[], "a fact about the person holds at all times");
    no_place(reader, clause);
    if let Some(measure) = &clause.measure {
        misfit(reader, measure, "the sentence states a fact, not a change");
    }
    let name = draft.name.clone().or_else(|| reader.names.person.clone()).unwrap_or_default();
    let said = draft.said(clause.span);
    let person = draft.routine.person.get_or_insert(RoutinePerson {
        said: said.clone(),
        name,
        kind: ResidentKind::default(),
        age_years: None,
        pace_mps: None,
        age_said: None,
        pace_said: None,
    });
    let again = match &clause.predicate {
        Predicate::Age(age) => {
            person.age_years = Some(*age);
            person.age_said.replace(said).is_some()
        }
        Predicate::Pace(pace) => {
            person.pace_mps = Some(pace.as_pace());
            person.pace_said.replace(said).is_some()
        }
        Predicate::Kind(kind) => std::mem::replace(&mut person.kind, *kind) != ResidentKind::default(),
        _ => false,
    };
    if again {
        reader.fault(span, SentenceMessage::SaidBefore { text: reader.said(span) });
    }
    if let Predicate::Pace(pace) = &clause.predicate
        && !(pace.from >= 0.05 && pace.to <= FASTEST_MPS)
    {
        reader.fault(pace.span, TimeSentenceMessage::Pace { text: reader.said(pace.span) });
    }
}

fn habit(reader: &mut SentenceReader, draft: &mut RoutineDraft, clause: Clause) {
    let (activity, is_own) = match &clause.predicate {
        Predicate::Visits => (Activity::Visit, false),
        Predicate::Does(Activity::Everyday(_)) if clause.place.is_some() && clause.adverbs.lasts.is_some() => {
            let own = own_said(reader, clause.predicate_span);
            (Activity::Other(own), false)
        }
        Predicate::Does(activity) => (activity.clone(), false),
        Predicate::Falls(_) => (Activity::Fall, false),
        Predicate::Own(words) => (Activity::Other(words.clone()), true),
        _ => return,
    };
    let adverbs = &clause.adverbs;
    if only_goes(reader, &clause) {
        return;
    }
    let own = match &activity {
        Activity::Other(label) => reader.names.lexicon.own.get(label).cloned(),
        _ => None,
    };
    let (is_own, own) = (is_own || own.is_some(), own.unwrap_or_default());
    let place = clause.place.clone().map(|(name, _)| name).or(own.place);
    let usual_lasts = own.minutes.map(|minutes| Fuzzy::around(minutes * 60.0, minutes * 60.0 * ABOUT_SHARE));
    let lasts = adverbs.lasts.as_ref().map(|slot| slot.value).or(usual_lasts.filter(|_| adverbs.until_time.is_none()));
    let lacks = place.is_none() || lasts.is_none() && adverbs.until_time.is_none();
    if is_own && lacks {
        return lacks_place_or_time(reader, &clause);
    }
    if matches!(activity, Activity::GetUp | Activity::GoToBed) {
        once_a_day(reader, &clause);
    }
    if let Some(measure) = &clause.measure {
        misfit(reader, measure, "the sentence adds an activity, and changes none");
    }
    every_few_weeks(reader, adverbs);
    let when = time_of_fall(reader, &clause, adverbs.time_meant(activity == Activity::GoToBed));
    check_times(reader, adverbs, &when);
    if when == HabitTime::Then && draft.routine.habits.is_empty() {
        let span = adverbs.when.as_ref().map_or(clause.span, |slot| slot.span);
        reader.fault(span, SentenceMessage::NothingBeforeThen);
    }
    let until = adverbs.until_meant(&when);
    if let (Some(lasts), false) = (&adverbs.lasts, matches!(activity, Activity::Leave | Activity::Visit))
        && lasts.own
        && lasts.value.from > DAY_S
    {
        reader.fault(lasts.span, TimeSentenceMessage::LongerThanADay { text: reader.said(lasts.span) });
    }
    let inherited_then = when == HabitTime::Then && adverbs.chance.as_ref().is_some_and(|chance| !chance.own);
    let chance = adverbs.chance.as_ref().filter(|_| !inherited_then).map_or(HabitChance::ALWAYS, |slot| slot.value);
    let chance =
        if clause.tends && adverbs.chance.is_none() { HabitChance::from_quantifier(Quantifier::Most) } else { chance };
    let phase = adverbs.phase_meant(reader, draft.is_condition);
    draft.phase(reader, &phase, adverbs, clause.span);
    let stay = staying(reader, draft, &clause, &activity, &phase);
    let (when, phase, lasts) = match stay {
        Some(stay) => stay,
        None => (when, phase, adverbs.lasts.as_ref().map(|slot| slot.value)),
    };
    let habit = Habit {
        said: draft.said(clause.span),
        visitor: match clause.subject {
            SentenceSubject::Visitor(name) => Some(name),
            _ => None,
        },
        activity,
        place,
        when: When {
            phase,
            days: adverbs.days_meant(),
            chance,
            time: when,
            lasts,
            until,
            nights: 0,
            times: adverbs.times.as_ref().map_or((1, 1), |slot| slot.value),
            is_total: false,
        },
        key: false,
        does: Vec::new(),
        falling: match clause.predicate {
            Predicate::Falls(falling) => Some(falling),
            _ => None,
        },
    };
    draft.routine.habits.push(habit);
    draft.habit_spans.push(clause.predicate_span);
    draft.finders.extend(clause.finder);
}

fn only_goes(reader: &mut SentenceReader, clause: &Clause) -> bool {
    let (Predicate::Own(words), Some((name, place))) = (&clause.predicate, &clause.place) else { return false };
    if !is_way(words) {
        return false;
    }
    let at = if reader.names.has(&name.to_lowercase(), Sort::Room) { "in" } else { "at" };
    let span = clause.predicate_span.to(*place);
    reader.fault(span, SentenceMessage::OnlyGoes { text: reader.said(span), at, place: name.clone() });
    true
}

fn every_few_weeks(reader: &mut SentenceReader, adverbs: &Adverbs) {
    if let (Some(every), Some(weekdays)) = (&adverbs.every, &adverbs.weekdays)
        && every.value % 7 == 0
        && weekdays.value.count_ones() > 1
    {
        reader.fault(every.span, TimeSentenceMessage::SeveralWeekdays { text: reader.said(every.span) });
    }
}

fn own_said(reader: &SentenceReader, span: TextSpan) -> String {
    let words = reader.words.iter().filter(|word| span.start <= word.span.start && word.span.end <= span.end);
    words.map(|word| word.text.as_str()).collect::<Vec<_>>().join(" ")
}

fn lacks_place_or_time(reader: &mut SentenceReader, clause: &Clause) {
    let span = clause.predicate_span;
    let words = reader.said(span).to_lowercase();
    let named = reader.names.of(&PLACES).find(|name| words.ends_with(&format!(" {}", name.to_lowercase())));
    let named = named.map(|name| format!("at the {name}"));
    let place = clause.place.as_ref().map(|(_, span)| reader.said(*span)).or(named);
    let lasts =
        clause.adverbs.lasts.as_ref().map_or_else(|| "for 20 minutes".to_owned(), |slot| reader.said(slot.span));
    let example = place.map(|place| format!("she {words} {place} {lasts}"));
    unknown_doing(reader, &words, span, example);
}

fn once_a_day(reader: &mut SentenceReader, clause: &Clause) {
    let at_night = clause.adverbs.part.as_ref().filter(|part| part.value == PartOfDay::Night);
    let gets_up = clause.predicate == Predicate::Does(Activity::GetUp);
    let span = clause.adverbs.times.as_ref().filter(|times| times.value != (1, 1)).map(|times| times.span);
    if let Some(span) = span.or(at_night.filter(|_| gets_up).map(|part| part.span)) {
        reader.fault(span, SentenceMessage::OnceADay { text: reader.said(span) });
    }
}

fn check_times(reader: &mut SentenceReader, adverbs: &Adverbs, when: &HabitTime) {
    if let (Some(part), HabitTime::At(at)) = (adverbs.part.as_ref().filter(|part| part.own), when) {
        let (from, to) = match part.value {
            PartOfDay::Morning => (3.0, 12.5),
            PartOfDay::Noon => (11.0, 14.5),
            PartOfDay::Afternoon => (11.5, 18.5),
            PartOfDay::Evening => (16.0, 24.0),
            PartOfDay::Night => (19.0, 33.0),
            PartOfDay::Day => (5.0, 22.0),
        };
        if at.to < from * 3600.0 || at.from > to * 3600.0 {
            let time = adverbs.when.as_ref().map_or(part.span, |slot| slot.span);
            let (text, part_text) = (reader.said(time), reader.said(part.span));
            reader.fault(time, TimeSentenceMessage::PartOfDay { text, part: part.value.word().to_string(), part_text });
        }
    }
    if let (Some(lasts), Some(until)) = (&adverbs.lasts, &adverbs.until_time) {
        let (text, other) = (reader.said(lasts.span), reader.said(until.span));
        reader.fault(until.span, TimeSentenceMessage::TwoEnds { text, other });
    }
    if let (HabitTime::At(at), Some(until)) = (when, &adverbs.until_time)
        && until.value.from <= at.from
        && !is_of_next_day(until.value.from, at.from)
    {
        reader.fault(until.span, TimeSentenceMessage::EndBeforeBegin { text: reader.said(until.span) });
    }
}

fn change(reader: &mut SentenceReader, draft: &mut RoutineDraft, clause: &Clause) {
    // Where she does not go any more she does not go: nothing is left to live of it.
    if matches!(clause.predicate, Predicate::Not(_)) && names_one_outing(reader, clause) {
        draft.routine.remarks.push(draft.said(clause.span));
        return;
    }
    let Some((effect, allowed)) = effect(reader, clause) else { return };
    let why = "a change holds for whole days, from its first day on";
    only(reader, &clause.adverbs, &allowed, why);
    no_place(reader, clause);
    let phase = clause.adverbs.phase_meant(reader, draft.is_condition);
    draft.phase(reader, &phase, &clause.adverbs, clause.span);
    let days = clause.adverbs.days_meant();
    if let (Effect::DaysAre { .. }, Some(kind)) = (&effect, &clause.adverbs.kind) {
        return reader.fault(kind.span, SentenceMessage::WhichDays);
    }
    let part = clause.adverbs.part.as_ref().map(|slot| slot.value);
    let time = match effect {
        Effect::Oftener { .. } | Effect::Active { .. } => part.map_or(HabitTime::AnyTime, HabitTime::Within),
        _ => HabitTime::AnyTime,
    };
    let chance = match effect {
        Effect::DaysAre { .. } => days_chance(clause),
        Effect::Skips { .. } | Effect::Forgets { .. } if chance(clause).is_some() => {
            clause.adverbs.chance.as_ref().map_or(HabitChance::ALWAYS, |slot| slot.value)
        }
        _ => HabitChance::ALWAYS,
    };
    let when = When { phase, days, chance, time, ..When::default() };
    draft.routine.changes.push(RoutineChange { said: draft.said(clause.span), when, effect });
}

/// Strength of a shy person's avoidance of others, where the goal has 1 (our choice).
const SHY: f64 = 1.5;

/// Stops a minute of a person who always stops (our choice).
const STOPS_PER_MIN: f64 = 6.0;

/// How much of its usual time is spent on what is not brought to its end (ours).
const UNFINISHED: Fuzzy = Fuzzy { low: 0.5, from: 0.5, to: 0.8, high: 0.8 };

const PHASE_ALONE: &[AdverbKind] = &[AdverbKind::Phase];
const PHASE: &[AdverbKind] =
    &[AdverbKind::Phase, AdverbKind::Weekdays, AdverbKind::Months, AdverbKind::Every, AdverbKind::Lively];
const PHASE_AND_PART: &[AdverbKind] = &[
    AdverbKind::Phase,
    AdverbKind::Weekdays,
    AdverbKind::Months,
    AdverbKind::Every,
    AdverbKind::Lively,
    AdverbKind::Part,
];
const PHASE_AND_CHANCE: &[AdverbKind] = &[
    AdverbKind::Phase,
    AdverbKind::Weekdays,
    AdverbKind::Months,
    AdverbKind::Every,
    AdverbKind::Lively,
    AdverbKind::Chance,
];
const DAYS_AND_CHANCE: &[AdverbKind] =
    &[AdverbKind::Phase, AdverbKind::Weekdays, AdverbKind::Months, AdverbKind::Every, AdverbKind::Chance];

fn effect(reader: &mut SentenceReader, clause: &Clause) -> Option<(Effect, Vec<AdverbKind>)> {
    let measure = clause.measure.as_ref();
    if names_one_outing(reader, clause) {
        let text = reader.said(clause.predicate_span);
        reader.fault(clause.predicate_span, SentenceMessage::OneOuting { text });
        return None;
    }
    let found = match (&clause.predicate, measure.map(|measure| (measure.of, measure.by))) {
        (Predicate::Does(activity), Some((of, by))) => {
            return of_activity(reader, clause, activity, of, by);
        }
        (Predicate::Walks | Predicate::Is, Some((Of::Faster, by))) => (Effect::Pace(by), PHASE),
        (Predicate::Walks, Some((Of::FasterBy { each_week: true }, by))) => (Effect::PaceEachWeek(by), PHASE),
        (Predicate::Is, Some((Of::Active, factor))) => (Effect::Active { factor }, PHASE_AND_PART),
        (Predicate::Sleeps, Some((Of::Restless | Of::Much, by))) => (Effect::Restless(by), PHASE),
        (Predicate::Sleeps, Some((Of::Later | Of::LongerBy, by))) => {
            (Effect::Later { activity: Activity::GetUp, by }, PHASE)
        }
        (Predicate::Sleeps, Some((Of::Longer | Of::Some, by))) if by.from != by.to => {
            let (least, most) = measures::UNSAID_LATER_S;
            let by = if by.from > 1.0 { Fuzzy::between(least, most) } else { Fuzzy::between(-most, -least) };
            (Effect::Later { activity: Activity::GetUp, by }, PHASE)
        }
        (Predicate::Vary, Some((Of::Much, by))) => (Effect::Irregular(by), PHASE),
        (Predicate::Differ, Some((Of::Much, by))) => (Effect::DaysDiffer(by), PHASE),
        (Predicate::SleepsIn, None) => (Effect::SleepsIn, PHASE_ALONE),
        (Predicate::Lively(kind, very), None) => (Effect::DaysAre { kind: *kind, very: *very }, DAYS_AND_CHANCE),
        (Predicate::Breathes, Some((Of::Breaths, by))) => (Effect::Respiration(by), PHASE),
        (Predicate::Rises(AmountPhrase { of: Of::Beats, by, .. }), None) => (Effect::Pulse(*by), PHASE),
        (Predicate::Rises(AmountPhrase { of: Of::Breaths, by, .. }), None) => (Effect::Respiration(*by), PHASE),
        (Predicate::Shy(Shy::GoingOn), None) => {
            let often = chance(clause).unwrap_or(Quantifier::Sometimes.probability());
            (Effect::Shy { of: Shy::GoingOn, gain: STOPS_PER_MIN * often }, PHASE_AND_CHANCE)
        }
        (Predicate::Shy(of), None) => (Effect::Shy { of: *of, gain: SHY }, PHASE_ALONE),
        (Predicate::Shows(condition, severity), None) => {
            (Effect::Shows { condition: condition.clone(), severity: *severity }, PHASE_ALONE)
        }
        (Predicate::Not(activity), None) => match chance(clause) {
            Some(_) => (Effect::Skips { activity: activity.clone() }, PHASE_AND_CHANCE),
            None => {
                let factor = Fuzzy::exactly(0.0);
                (Effect::Oftener { activity: activity.clone(), factor }, PHASE_AND_PART)
            }
        },
        (Predicate::Unfinished(activity), None) => {
            (Effect::Longer { activity: activity.clone(), factor: UNFINISHED }, PHASE)
        }
        (Predicate::Skips(activity), None) if says_weekdays(clause) && chance(clause).is_none() => {
            (Effect::Skips { activity: activity.clone() }, PHASE)
        }
        (Predicate::Skips(activity), None) => {
            let example =
                format!("she skips {} on 30 % of days", reader.said(last_word(clause.predicate_span, reader)));
            needed_chance(reader, clause, &example)?;
            (Effect::Skips { activity: activity.clone() }, PHASE_AND_CHANCE)
        }
        (Predicate::Forgets(thing), None) => {
            needed_chance(reader, clause, &format!("she forgets the {thing} on 5 % of occasions"))?;
            (Effect::Forgets { thing: thing.clone() }, PHASE_AND_CHANCE)
        }
        _ => {
            not_a_change(reader, clause);
            return None;
        }
    };
    Some((found.0, found.1.to_vec()))
}

fn days_chance(clause: &Clause) -> HabitChance {
    let adverbs = &clause.adverbs;
    let said = [adverbs.weekdays.is_some(), adverbs.months.is_some(), adverbs.every.is_some()];
    let unsaid =
        if said.contains(&true) { HabitChance::ALWAYS } else { HabitChance::from_quantifier(Quantifier::Sometimes) };
    adverbs.chance.as_ref().map_or(unsaid, |slot| slot.value)
}

fn says_weekdays(clause: &Clause) -> bool {
    clause.adverbs.weekdays.as_ref().is_some_and(|slot| slot.own)
}

fn names_one_outing(reader: &SentenceReader, clause: &Clause) -> bool {
    const GENERAL: [&str; 8] = ["apartment", "flat", "home", "house", "building", "out", "outside", "away"];
    let (Predicate::Does(activity) | Predicate::Not(activity) | Predicate::Skips(activity)) = &clause.predicate else {
        return false;
    };
    let said = own_said(reader, clause.predicate_span);
    let last = said.split_whitespace().last().unwrap_or_default();
    *activity == Activity::Leave && !GENERAL.contains(&last)
}

fn of_activity(
    reader: &mut SentenceReader,
    clause: &Clause,
    activity: &Activity,
    of: Of,
    by: Fuzzy,
) -> Option<(Effect, Vec<AdverbKind>)> {
    let activity = activity.clone();
    let effect = match of {
        Of::Later => Effect::Later { activity, by },
        Of::Longer => Effect::Longer { activity, factor: by },
        Of::LongerBy => Effect::LongerBy { activity, by },
        Of::Oftener => return Some((Effect::Oftener { activity, factor: by }, PHASE_AND_PART.to_vec())),
        Of::Some if lasts_long(&activity) => Effect::Longer { activity, factor: by },
        Of::Some => return Some((Effect::Oftener { activity, factor: by }, PHASE_AND_PART.to_vec())),
        Of::Much => {
            let span = clause.measure.as_ref().map_or(clause.span, |measure| measure.span);
            reader.fault(span, SentenceMessage::MoreOrLonger { text: reader.said(span) });
            return None;
        }
        _ => {
            not_a_change(reader, clause);
            return None;
        }
    };
    Some((effect, PHASE.to_vec()))
}

fn lasts_long(activity: &Activity) -> bool {
    matches!(
        TimeUse::from_label(activity.label()),
        TimeUse::Television | TimeUse::Reading | TimeUse::Relaxing | TimeUse::Computer | TimeUse::Eating
    )
}

fn not_a_change(reader: &mut SentenceReader, clause: &Clause) {
    let hint = match &clause.predicate {
        Predicate::Walks => {
            "write \"walks 10 % slower\", \"walks 0.02 m/s slower every week\", \"wanders around\", \
            \"walks up and down\" or \"goes for a walk\""
        }
        Predicate::Is => IS,
        Predicate::Sleeps => {
            "write \"sleeps 30 % more restlessly\", \"goes to bed at 22:30\", \"gets up at 09:00\" or \"naps\""
        }
        Predicate::Vary => "write \"her hours vary twice as much\"",
        Predicate::Differ => "write \"her days differ twice as much\"",
        Predicate::Lively(..) => "write \"one day in three is a quiet day\" or \"on Sunday she has a busy day\"",
        Predicate::Breathes => "write \"breathes 6 breaths a minute faster\"",
        _ => "describe the change as \"later\", \"longer\" or \"more often\"",
    };
    let span = clause.measure.as_ref().map_or(clause.predicate_span, |measure| measure.span);
    let (text, help) = (reader.said(span), hint.to_owned());
    let message = match &clause.measure {
        Some(_) => SentenceMessage::OtherChange { text, help },
        None => SentenceMessage::OpenChange { text, help },
    };
    reader.fault(span, message);
}

fn misfit(reader: &mut SentenceReader, measure: &AmountPhrase, why: &str) {
    let (text, reason) = (reader.said(measure.span), why.to_owned());
    reader.fault(measure.span, SentenceMessage::NotAChange { text, reason });
}

fn no_place(reader: &mut SentenceReader, clause: &Clause) {
    if let Some((_, span)) = &clause.place {
        let (text, reason) = (reader.said(*span), "a change has no place".to_owned());
        reader.fault(*span, SentenceMessage::DoesNotFit { text, reason });
    }
}

fn chance(clause: &Clause) -> Option<f64> {
    let chance = clause.adverbs.chance.as_ref()?;
    let says = chance.own || chance.value.quantifier != Some(Quantifier::Every);
    says.then_some(chance.value.probability)
}

fn needed_chance(reader: &mut SentenceReader, clause: &Clause, example: &str) -> Option<f64> {
    let chance = chance(clause);
    if chance.is_none() {
        let span = clause.predicate_span;
        reader.fault(span, SentenceMessage::HowOften { text: reader.said(span), example: example.to_owned() });
    }
    chance
}

fn last_word(span: TextSpan, reader: &SentenceReader) -> TextSpan {
    reader.words.iter().rev().map(|word| word.span).find(|word| word.end <= span.end).unwrap_or(span)
}
