//! The meaning of a routine, sentence by sentence, in numbers and in words.

use crate::language::LAST_WEEK;
use crate::language::activities::phrase;
use crate::routine::{
    Activity, DayKind, DaySelection, Effect, Habit, HabitChance, HabitTime, PartOfDay, Phase, PhaseDay, Quote,
    Response, Routine, RoutineChange, RoutinePerson, RoutineRule, Shy, USUAL_SHARE,
};
use homebody_core::fuzzy::Fuzzy;
use serde::Serialize;
use words::{clock, join, lasts_words, number, numbers, sentence, span_words};

mod rules;
pub(crate) mod words;

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Explanation {
    pub file: String,
    pub sentences: Vec<ExplanationRow>,
    /// The rules as layers, the upper before the lower; empty without rules.
    pub layers: String,
}

/// The meaning of one sentence or part of one.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ExplanationRow {
    pub line: u32,
    pub said: String,
    pub kind: ExplanationKind,
    /// The person with the activity, or the change.
    pub what: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub place: Option<String>,
    /// Days, and the probability on each.
    pub days: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub probability: Option<f64>,
    pub when: String,
    /// Seconds since midnight.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub start: Option<Spread>,
    /// Seconds that a trigger must last before the rule holds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub waits: Option<Spread>,
    /// Duration in seconds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lasts: Option<Spread>,
    pub phase: String,
    /// The meaning as one sentence.
    pub in_words: String,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ExplanationKind {
    Person,
    Habit,
    Rule,
    Change,
    Remark,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Spread {
    pub least: f64,
    pub p5: f64,
    pub mean: f64,
    pub p95: f64,
    pub most: f64,
}

impl Spread {
    fn from_fuzzy(fuzzy: &Fuzzy) -> Spread {
        Spread { least: fuzzy.low, p5: fuzzy.at(0.05), mean: fuzzy.mean(), p95: fuzzy.at(0.95), most: fuzzy.high }
    }
}

pub fn explain(routine: &Routine) -> Explanation {
    let mut rows: Vec<(u32, ExplanationRow)> = Vec::new();
    rows.extend(routine.person.iter().map(|person| (person.said.column, person_row(person))));
    rows.extend(routine.habits.iter().map(|habit| (habit.said.column, habit_row(habit))));
    rows.extend(routine.rules.iter().map(|rule| (rule.said.column, rule_row(rule))));
    rows.extend(routine.changes.iter().map(|change| (change.said.column, change_row(change))));
    rows.extend(routine.remarks.iter().map(|remark| (remark.column, remark_row(remark))));
    rows.sort_by_key(|(column, row)| (row.line, *column));
    let sentences = rows.into_iter().map(|(_, row)| row).collect();
    Explanation { file: routine.file.clone(), sentences, layers: rules::layers(routine) }
}

impl Explanation {
    /// A table, then all sentences in words.
    pub fn to_text(&self) -> String {
        let head = ["line", "what", "on", "when", "lasts", "from"].map(str::to_owned);
        let lasts = |row: &ExplanationRow| {
            row.lasts.as_ref().map_or_else(String::new, |lasts| span_words(lasts.least, lasts.most))
        };
        let cells = |row: &ExplanationRow| {
            let what = row.place.as_ref().map_or(row.what.clone(), |place| format!("{} ({place})", row.what));
            [row.line.to_string(), what, row.days.clone(), row.when.clone(), lasts(row), row.phase.clone()]
        };
        let table: Vec<[String; 6]> = std::iter::once(head).chain(self.sentences.iter().map(cells)).collect();
        let width = |column: usize| table.iter().map(|cells| cells[column].chars().count()).max().unwrap_or(0);
        let widths: Vec<usize> = (0..6).map(width).collect();
        let mut text = String::new();
        for cells in &table {
            let padded = cells.iter().zip(&widths).map(|(cell, width)| format!("{cell:<width$}", width = *width));
            text += padded.collect::<Vec<_>>().join("  ").trim_end();
            text += "\n";
        }
        for row in &self.sentences {
            text += &format!("\n{}:{}: {}\n  {}\n", self.file, row.line, row.said, row.in_words);
        }
        if !self.layers.is_empty() {
            text += &format!("\n{}", self.layers);
        }
        text
    }
}

fn person_row(person: &RoutinePerson) -> ExplanationRow {
    let mut facts = Vec::new();
    if let Some(age) = person.age_years {
        facts.push(format!("{} years old", number(age)));
    }
    match person.kind {
        crate::routine::ResidentKind::Cat => facts.push("a cat".into()),
        crate::routine::ResidentKind::Dog => facts.push("a dog".into()),
        crate::routine::ResidentKind::Person => {}
    }
    if let Some(pace) = person.pace_mps {
        facts.push(format!("walks at {} m/s", numbers(pace.low, pace.high)));
    }
    let facts = facts.join(", ");
    let in_words = format!("{}: {facts}.", person.name);
    ExplanationRow { in_words, ..row(person.said.line, &person.said.text, ExplanationKind::Person, facts) }
}

fn row(line: u32, said: &str, kind: ExplanationKind, what: String) -> ExplanationRow {
    ExplanationRow {
        line,
        said: said.split_whitespace().collect::<Vec<_>>().join(" "),
        kind,
        what,
        place: None,
        days: String::new(),
        probability: None,
        when: String::new(),
        start: None,
        waits: None,
        lasts: None,
        phase: String::new(),
        in_words: String::new(),
    }
}

fn habit_row(habit: &Habit) -> ExplanationRow {
    let who = habit.visitor.as_deref().unwrap_or("the person");
    let doing = match habit.falling.map(|falling| falling.words()).filter(|words| !words.is_empty()) {
        Some(words) => format!("{}: {words}", phrase(&habit.activity)),
        None => phrase(&habit.activity),
    };
    let what = match &habit.visitor {
        Some(visitor) => format!("{visitor} {doing}"),
        None => doing.clone(),
    };
    let start = match &habit.when.time {
        HabitTime::At(at) => Some(Spread::from_fuzzy(at)),
        _ => None,
    };
    let lasts = habit.when.lasts.as_ref().map(Spread::from_fuzzy);
    let times = match habit.when.times {
        (1, 1) => String::new(),
        (least, most) if least == most => format!("{least} times"),
        (least, most) => format!("{least} to {most} times"),
    };
    let mostly = habit.falling.and_then(|falling| falling.mostly);
    let when = match mostly {
        Some(part) => {
            let when = when_words(&HabitTime::Within(part), &habit.activity);
            format!("{} times out of 4 {}, else at another time", 4.0 * USUAL_SHARE, when.trim_start_matches("start "))
        }
        None => when_words(&habit.when.time, &habit.activity),
    };
    let place = habit.place.as_ref().map(|place| format!("at the {place}"));
    let lasting = habit.when.lasts.as_ref().map(|lasts| format!("lasts {}", lasts_words(lasts)));
    let until = habit.when.until.as_ref().map(|until| format!("until {}", clock_words(until)));
    let said = [
        Some(format!("{} {who} {doing}", days_words(&habit.when.days, &habit.when.chance))),
        place,
        Some(times.clone()),
        Some(when.clone()),
        lasting,
        until.clone(),
        Some(phase_words(&habit.when.phase)),
    ];
    let short_mostly = mostly.map_or_else(|| short_when(&habit.when.time), |part| format!("mostly {}", part.word()));
    let short_when = [times, short_mostly, until.unwrap_or_default()];
    ExplanationRow {
        place: habit.place.clone(),
        days: short_days(&habit.when.days, &habit.when.chance),
        probability: Some(habit.when.chance.probability),
        when: join(short_when.into_iter(), " "),
        start,
        lasts,
        phase: phase_words(&habit.when.phase),
        in_words: sentence(said.into_iter().flatten()),
        ..row(habit.said.line, &habit.said.text, ExplanationKind::Habit, what)
    }
}

fn rule_row(rule: &RoutineRule) -> ExplanationRow {
    let whenever = rules::whenever(rule);
    let response = rules::answers(rule);
    let lasts = match &rule.response {
        Response::Do { lasts, .. } => lasts.as_ref().map(Spread::from_fuzzy),
        Response::Turn { .. } => None,
    };
    let chance = format!("with probability {}", number(rule.when.chance.probability));
    let said = [format!("{whenever}, {chance} the person {response}"), phase_words(&rule.when.phase)];
    ExplanationRow {
        probability: Some(rule.when.chance.probability),
        when: whenever,
        waits: Some(Spread::from_fuzzy(&rule.lasts)),
        lasts,
        days: format!("p {}", number(rule.when.chance.probability)),
        phase: phase_words(&rule.when.phase),
        in_words: sentence(said.into_iter()),
        ..row(rule.said.line, &rule.said.text, ExplanationKind::Rule, response)
    }
}

fn remark_row(remark: &Quote) -> ExplanationRow {
    let in_words = format!("Remark, not lived: {}.", remark.text.trim());
    ExplanationRow { in_words, ..row(remark.line, &remark.text, ExplanationKind::Remark, "remark: not lived".into()) }
}

fn change_row(change: &RoutineChange) -> ExplanationRow {
    let what = effect_words(change);
    let phase = phase_words(&change.when.phase);
    let on = if change.when.days == DaySelection::ALL { String::new() } else { which_days(&change.when.days) };
    ExplanationRow {
        in_words: sentence([what.clone(), on.clone(), phase.clone()].into_iter()),
        days: on,
        phase,
        ..row(change.said.line, &change.said.text, ExplanationKind::Change, what)
    }
}

fn effect_words(change: &RoutineChange) -> String {
    let factor = |factor: &Fuzzy| format!("{} times", numbers(factor.low, factor.high));
    let part = change.when.part().map_or(String::new(), |part| format!(" ({})", part.word()));
    let chance = number(change.when.chance.probability);
    match &change.effect {
        Effect::Shows { condition, severity } => format!("{condition}, {}", severity_words(*severity)),
        Effect::Pace(by) => format!("walking speed {}", factor(by)),
        Effect::PaceEachWeek(by) => format!("walking speed {} m/s more each week", numbers(by.low, by.high)),
        Effect::Later { activity, by } => shift(&phrase(activity), by, "later", "earlier"),
        Effect::Longer { activity, factor: by } => format!("{} {} as long", phrase(activity), factor(by)),
        Effect::LongerBy { activity, by } => shift(&phrase(activity), by, "longer", "shorter"),
        Effect::Oftener { activity, factor: by } if by.high <= 0.0 => format!("never {}{part}", phrase(activity)),
        Effect::Oftener { activity, factor: by } => format!("{}{part} {} as often", phrase(activity), factor(by)),
        Effect::Skips { activity } => {
            format!("{}: left out on a day with probability {chance}", phrase(activity))
        }
        Effect::Irregular(by) => format!("times and durations vary {} as much", factor(by)),
        Effect::Active { factor: by } => format!("movement while awake at home{part} {}", factor(by)),
        Effect::DaysDiffer(by) => format!("days differ {} as much in how lively they are", factor(by)),
        Effect::DaysAre { kind, very } => {
            let very = if *very { "very " } else { "" };
            format!("{very}{} days, with probability {chance}", kind.word())
        }
        Effect::SleepsIn => "after a late night gets up as much later".into(),
        Effect::Restless(by) => format!("turning in bed {}", factor(by)),
        Effect::Forgets { thing } => format!("{thing}: left on or open after use with probability {chance}"),
        Effect::Shy { of: Shy::OpenFloor, gain } => {
            format!("wandering: keeps close to the walls, gain {}", number(*gain))
        }
        Effect::Shy { of: Shy::People, gain } => format!("wandering: keeps away from others, gain {}", number(*gain)),
        Effect::Shy { of: Shy::GoingOn, gain } => format!("wandering: stops {} times a minute", number(*gain)),
        Effect::Pulse(by) => format!("pulse {} beats a minute more", numbers(by.low, by.high)),
        Effect::Respiration(by) => format!("breathing {} breaths a minute more", numbers(by.low, by.high)),
    }
}

fn severity_words(severity: f64) -> String {
    match severity {
        1.0 => "a moderate case".into(),
        0.5 => "a mild case, 0.5 of a moderate one".into(),
        1.5 => "a severe case, 1.5 times a moderate one".into(),
        2.0 => "twice a moderate case".into(),
        less if less < 1.0 => format!("{} of a moderate case", number(less)),
        more => format!("{} times a moderate case", number(more)),
    }
}

fn shift(what: &str, by: &Fuzzy, more: &str, less: &str) -> String {
    match by.high <= 0.0 {
        true => format!("{what} {} {less}", span_words(-by.high, -by.low)),
        false => format!("{what} {} {more}", span_words(by.low, by.high)),
    }
}

const WEEKDAYS: [&str; 7] = ["Monday", "Tuesday", "Wednesday", "Thursday", "Friday", "Saturday", "Sunday"];
const MONTHS: [&str; 12] = [
    "January",
    "February",
    "March",
    "April",
    "May",
    "June",
    "July",
    "August",
    "September",
    "October",
    "November",
    "December",
];

/// `None` if all are set.
fn named(bits: u16, names: &[&str]) -> Option<String> {
    let all = (1_u32 << names.len()) - 1;
    let set: Vec<&str> = names.iter().enumerate().filter(|(i, _)| bits & 1 << i != 0).map(|(_, name)| *name).collect();
    (u32::from(bits) & all != all).then(|| set.join(", "))
}

/// Without probability.
fn which_days(days: &DaySelection) -> String {
    let every = match days.every {
        0 | 1 => "on each day".into(),
        2 => "on every other day".into(),
        every => format!("every {every} days"),
    };
    let mut words = match named(days.weekdays.into(), &WEEKDAYS) {
        Some(weekdays) if days.every <= 1 => format!("on each {weekdays}"),
        Some(weekdays) => format!("{every}, if it is {weekdays},"),
        None => every,
    };
    if let Some(months) = named(days.months, &MONTHS) {
        words += &format!(" in {months}");
    }
    match days.of_month {
        LAST_WEEK => words += ", in the last 7 days of the month,",
        (first, last) if days.of_month != DaySelection::ALL.of_month => {
            words += &format!(", from day {first} to {last} of the month,")
        }
        _ => {}
    }
    if let Some(kind) = days.kind {
        words += &format!(", if it is a {} one,", kind.word());
    }
    words
}

impl DayKind {
    pub(crate) fn word(self) -> &'static str {
        match self {
            DayKind::Quiet => "quiet",
            DayKind::Busy => "busy",
        }
    }
}

fn days_words(days: &DaySelection, chance: &HabitChance) -> String {
    let mut words = which_days(days);
    words += &format!(" with probability {}", number(chance.probability));
    if let Some((becomes, by)) = chance.becomes {
        words += &format!(" at first and {} by {}", number(becomes), moment_words(by));
    }
    words + ","
}

fn short_days(days: &DaySelection, chance: &HabitChance) -> String {
    let short = |names: String| names.split(", ").map(|name| &name[..3]).collect::<Vec<_>>().join(" ");
    let every = if days.every > 1 { format!("every {} days", days.every) } else { String::new() };
    let of_month = match days.of_month {
        LAST_WEEK => "last week".to_owned(),
        days if days == DaySelection::ALL.of_month => String::new(),
        (first, last) => format!("{first}.-{last}."),
    };
    let becomes = chance.becomes.map_or_else(String::new, |(becomes, _)| format!(" to {}", number(becomes)));
    let parts = [
        named(days.weekdays.into(), &WEEKDAYS).map(short).unwrap_or_default(),
        named(days.months, &MONTHS).map(short).unwrap_or_default(),
        of_month,
        days.kind.map_or(String::new(), |kind| kind.word().to_owned()),
        every,
        format!("p {}{becomes}", number(chance.probability)),
    ];
    join(parts.into_iter(), " ")
}

fn when_words(when: &HabitTime, of: &Activity) -> String {
    let gap = |gap: &Option<Fuzzy>, word: &str| match gap {
        Some(gap) => format!("{} {word}", lasts_words(gap)),
        None => format!("right {word}"),
    };
    match when {
        HabitTime::AnyTime => "whenever it fits".into(),
        HabitTime::At(at) => format!("start {}", clock_words(at)),
        HabitTime::Within(PartOfDay::Night) if of.is_of_the_night() => "at any time of the night, while in bed".into(),
        HabitTime::Within(PartOfDay::Night) => "in the hours before bed".into(),
        HabitTime::Within(part) => {
            let (from, to) = part.hours();
            format!("start at any time from {} to {}", clock(from), clock(to))
        }
        HabitTime::After(activity, by) => format!("{} after the person {}", gap(by, "").trim(), phrase(activity)),
        HabitTime::Before(activity, by) => format!("{} before the person {}", gap(by, "").trim(), phrase(activity)),
        HabitTime::With(activity) => format!("as the person begins: {}", phrase(activity)),
        HabitTime::Then => "once the one before is done, and only then".into(),
    }
}

fn short_when(when: &HabitTime) -> String {
    match when {
        HabitTime::AnyTime => String::new(),
        HabitTime::At(at) => format!("{}-{}", clock(at.low), clock(at.high)),
        HabitTime::Within(part) => part.word().into(),
        HabitTime::After(activity, _) => format!("after: {}", phrase(activity)),
        HabitTime::Before(activity, _) => format!("before: {}", phrase(activity)),
        HabitTime::With(activity) => format!("with: {}", phrase(activity)),
        HabitTime::Then => "then".into(),
    }
}

fn clock_words(at: &Fuzzy) -> String {
    let spread = Spread::from_fuzzy(at);
    let most_often = match at.from == at.to {
        true => format!("{}, ", clock(at.from)),
        false => String::new(),
    };
    let (low, high, mean) = (clock(at.low), clock(at.high), clock(spread.mean));
    let (p5, p95) = (clock(spread.p5), clock(spread.p95));
    format!("{most_often}between {low} and {high} (mean {mean}, 5 % before {p5}, 5 % after {p95})")
}

fn phase_words(phase: &Phase) -> String {
    let days = |days: f64| format!("{} days", number(days));
    let over = (phase.over_days > 0.0).then(|| format!("fully there after {}", days(phase.over_days)));
    let fading = (phase.fading_days > 0.0).then(|| format!("gone after {} more", days(phase.fading_days)));
    let from = phase.from.map(|from| format!("from {}", moment_words(from)));
    let until = phase.until.map(|until| format!("until the beginning of {}", moment_words(until)));
    join([from, over, until, fading].into_iter().flatten(), ", ")
}

fn moment_words(moment: PhaseDay) -> String {
    match moment {
        PhaseDay::Day(day) => format!("day {}", i64::from(day) + 1),
        PhaseDay::Date(year, month, day) => format!("{year:04}-{month:02}-{day:02}"),
    }
}
