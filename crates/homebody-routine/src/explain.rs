//! The meaning of a routine, sentence by sentence, in numbers and in words.

use crate::completion::is_about_him;
use crate::language::activities::phrase;
use crate::language::canonical::{MONTHS, WEEKDAYS};
use crate::routine::{
    DayKind, DaySelection, Effect, Habit, HabitChance, HabitTime, Phase, Quote, ResidentKind, Response, Routine,
    RoutineChange, RoutinePerson, RoutineRule, Shy,
};
use crate::statement::{Statement, statements};
use homebody_core::fuzzy::Fuzzy;
use serde::Serialize;
use words::{clock, join, number, numbers, span_words};

mod dates;
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
    /// In a run: its first day if days are counted, its last day, or that it has none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub dates: Option<String>,
    /// The canonical sentence.
    pub in_words: String,
    pub statement: Statement,
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
    let mut sentences: Vec<ExplanationRow> = statements(routine).iter().map(explain_statement).collect();
    sentences.sort_by_key(|row| row.line);
    Explanation { file: routine.file.clone(), sentences, layers: rules::layers(routine) }
}

fn explain_statement((said, statement): &(Quote, Statement)) -> ExplanationRow {
    let mut row = ExplanationRow {
        line: said.line,
        said: said.text.split_whitespace().collect::<Vec<_>>().join(" "),
        kind: ExplanationKind::Person,
        what: String::new(),
        place: None,
        days: String::new(),
        probability: None,
        when: String::new(),
        start: None,
        waits: None,
        lasts: None,
        phase: String::new(),
        dates: None,
        in_words: in_the_same_voice(&said.text, statement.sentences().join(" ")),
        statement: statement.clone(),
    };
    match statement {
        Statement::Person(person) => row.what = person_words(person),
        Statement::Habit(habit)
        | Statement::Sleep(habit)
        | Statement::Away(habit)
        | Statement::Visit(habit)
        | Statement::Event(habit) => habit_cells(&mut row, habit),
        Statement::Change(change) | Statement::Thing(change) => {
            row.kind = ExplanationKind::Change;
            row.what = effect_words(change);
            row.days =
                if change.when.days == DaySelection::ALL { String::new() } else { which_days(&change.when.days) };
            row.phase = phase_words(&change.when.phase);
        }
        Statement::Rule(rule) => rule_cells(&mut row, rule),
        Statement::Note { .. } => {
            (row.kind, row.what) = (ExplanationKind::Remark, "note, without effect".to_owned());
        }
    }
    row
}

/// A canonical sentence says "she"; of a man, whom the text calls "he", it says "he".
fn in_the_same_voice(said: &str, sentence: String) -> String {
    let mut words = said.split(|c: char| !c.is_alphabetic()).map(str::to_lowercase);
    match words.any(|word| ["he", "his", "him", "himself"].contains(&word.as_str())) {
        true => about_him(&sentence),
        false => sentence,
    }
}

/// A canonical sentence for a routine, which may be about a man.
pub fn in_the_voice_of(routine: &str, sentence: &str) -> String {
    if is_about_him(routine) { about_him(sentence) } else { sentence.to_owned() }
}

fn about_him(sentence: &str) -> String {
    let as_he = |word: &str| match word {
        "she" => Some("he"),
        "She" => Some("He"),
        "her" => Some("his"),
        "Her" => Some("His"),
        "herself" => Some("himself"),
        _ => None,
    };
    let words = sentence.split_inclusive(|c: char| !c.is_alphabetic()).map(|piece| {
        let word = piece.trim_end_matches(|c: char| !c.is_alphabetic());
        as_he(word).map_or_else(|| piece.to_owned(), |other| format!("{other}{}", &piece[word.len()..]))
    });
    words.collect()
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
            text += &row.dates.as_ref().map_or_else(String::new, |dates| format!("  In this run: {dates}.\n"));
        }
        if !self.layers.is_empty() {
            text += &format!("\n{}", self.layers);
        }
        text
    }
}

fn person_words(person: &RoutinePerson) -> String {
    let age = person.age_years.map(|age| format!("{} years old", number(age)));
    let kind = match person.kind {
        ResidentKind::Cat => Some("a cat".to_owned()),
        ResidentKind::Dog => Some("a dog".to_owned()),
        ResidentKind::Person => None,
    };
    let pace = person.pace_mps.map(|pace| format!("walks at {} m/s", numbers(pace.low, pace.high)));
    let rests = person.rests.map(|rests| format!("rests after {} m", number(rests.after_m)));
    join([age, kind, pace, rests].into_iter().flatten(), ", ")
}

fn habit_cells(row: &mut ExplanationRow, habit: &Habit) {
    let doing = match habit.falling.map(|falling| falling.words()).filter(|words| !words.is_empty()) {
        Some(words) => format!("{}: {words}", phrase(&habit.activity)),
        None => phrase(&habit.activity),
    };
    row.kind = ExplanationKind::Habit;
    row.what = habit.visitor.as_ref().map_or(doing.clone(), |visitor| format!("{visitor} {doing}"));
    row.what += if habit.eats_out { ", with a meal" } else { "" };
    row.what += &habit.thing_on.as_ref().map(|thing| format!(", with the {thing} on")).unwrap_or_default();
    row.place.clone_from(&habit.place);
    row.days = short_days(&habit.when.days, &habit.when.chance);
    row.probability = Some(habit.when.chance.probability);
    row.start = match &habit.when.time {
        HabitTime::At(at) => Some(Spread::from_fuzzy(at)),
        _ => None,
    };
    row.lasts = habit.when.lasts.as_ref().map(Spread::from_fuzzy);
    row.phase = phase_words(&habit.when.phase);
    let in_all = if habit.when.is_total { " in all" } else { "" };
    let times = match habit.when.times {
        (1, 1) if habit.when.is_total => "once in all".to_owned(),
        (1, 1) => String::new(),
        (least, most) if least == most => format!("{least} times{in_all}"),
        (least, most) => format!("{least} to {most} times{in_all}"),
    };
    let mostly = habit.falling.and_then(|falling| falling.mostly);
    let time = mostly.map_or_else(|| short_when(&habit.when.time), |part| format!("mostly {}", part.word()));
    let until = habit.when.until.as_ref().map(|until| format!("until {}-{}", clock(until.low), clock(until.high)));
    let nights = match habit.when.nights {
        0 => String::new(),
        1 => "1 night".to_owned(),
        nights => format!("{nights} nights"),
    };
    row.when = join([times, time, until.unwrap_or_default(), nights].into_iter(), " ");
}

fn rule_cells(row: &mut ExplanationRow, rule: &RoutineRule) {
    row.kind = ExplanationKind::Rule;
    row.what = rules::answers(rule);
    row.when = rules::whenever(rule);
    row.probability = Some(rule.when.chance.probability);
    row.days = format!("p {}", number(rule.when.chance.probability));
    row.waits = Some(Spread::from_fuzzy(&rule.lasts));
    row.lasts = match &rule.response {
        Response::Do { lasts, .. } => lasts.as_ref().map(Spread::from_fuzzy),
        Response::Turn { .. } => None,
    };
    row.phase = phase_words(&rule.when.phase);
}

fn effect_words(change: &RoutineChange) -> String {
    let factor = |factor: &Fuzzy| format!("{} times", numbers(factor.low, factor.high));
    let part = change.when.part().map_or(String::new(), |part| format!(" ({})", part.word()));
    let chance = format!("with probability {}", number(change.when.chance.probability));
    let of_a_day = match change.when.chance.days_a_week {
        Some(days) => format!("on {days} days a week"),
        None => format!("on a day {chance}"),
    };
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
            format!("{}: left out {of_a_day}", phrase(activity))
        }
        Effect::Irregular(by) => format!("times and durations vary {} as much", factor(by)),
        Effect::Active { factor: by } => format!("movement while awake at home{part} {}", factor(by)),
        Effect::DaysDiffer(by) => format!("days differ {} as much in how lively they are", factor(by)),
        Effect::DaysAre { kind, very } => {
            let very = if *very { "very " } else { "" };
            format!("{very}{} days, {of_a_day}", kind.word())
        }
        Effect::SleepsIn => "after a late night gets up as much later".into(),
        Effect::Restless(by) => format!("turning in bed {}", factor(by)),
        Effect::Forgets { thing } => format!("{thing}: left on or open after use {chance}"),
        Effect::KeepsOn { thing } => match (&change.when.time, &change.when.until) {
            (HabitTime::At(from), Some(until)) => {
                format!("{thing}: on or open from {} to {}", clock(from.mean()), clock(until.mean()))
            }
            _ => format!("{thing}: on or open all night"),
        },
        Effect::Range { place, inside } => {
            format!("{} the {place} {of_a_day}", if *inside { "does not leave" } else { "does not enter" })
        }
        Effect::Spares { thing } => format!("{thing}: not used"),
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
        Some(weekday) if days.weekdays.is_power_of_two() => format!("every {} weeks on {weekday}", days.every),
        Some(weekdays) => format!("{every}, if it is {weekdays},"),
        None => every,
    };
    if let Some(months) = named(days.months, &MONTHS) {
        words += &format!(" in {months}");
    }
    match days.of_month {
        DaySelection::LAST_WEEK => words += ", in the last 7 days of the month,",
        (first, last) if days.of_month != DaySelection::ALL.of_month => {
            words += &format!(", from day {first} to {last} of the month,")
        }
        _ => {}
    }
    if let Some(kind) = days.kind {
        words += &format!(", if it is a {} one,", kind.word());
    }
    words += &such_days(days).into_iter().map(|such| format!(", {such},")).collect::<String>();
    words
}

/// Days by weather, episode and the nights before.
fn such_days(days: &DaySelection) -> Vec<String> {
    let weather = days.weather.map(|weather| format!("in {} weather", weather.word()));
    let episode = days.episode.map(|of| format!("for {} days about every {} days", of.lasts_days, of.every_days));
    let poor = (days.poor_nights > 0).then(|| format!("poor nights before: {} or more", days.poor_nights));
    [weather, episode, poor].into_iter().flatten().collect()
}

impl DayKind {
    pub(crate) fn word(self) -> &'static str {
        match self {
            DayKind::Quiet => "quiet",
            DayKind::Busy => "busy",
        }
    }
}

fn short_days(days: &DaySelection, chance: &HabitChance) -> String {
    let short =
        |names: String| names.split(", ").map(|name| name.get(..3).unwrap_or(name)).collect::<Vec<_>>().join(" ");
    let unit = if days.weekdays.is_power_of_two() { "weeks" } else { "days" };
    let every = if days.every > 1 { format!("every {} {unit}", days.every) } else { String::new() };
    let of_month = match days.of_month {
        DaySelection::LAST_WEEK => "last week".to_owned(),
        days if days == DaySelection::ALL.of_month => String::new(),
        (first, last) => format!("{first}.-{last}."),
    };
    let becomes = chance.becomes.map_or_else(String::new, |(becomes, _)| format!(" to {}", number(becomes)));
    let parts = [
        named(days.weekdays.into(), &WEEKDAYS).map(short).unwrap_or_default(),
        named(days.months, &MONTHS).map(short).unwrap_or_default(),
        of_month,
        days.kind.map_or(String::new(), |kind| kind.word().to_owned()),
        such_days(days).join(", "),
        every,
        match chance.days_a_week {
            Some(days) => format!("{days} a week"),
            None => format!("p {}{becomes}", number(chance.probability)),
        },
    ];
    join(parts.into_iter(), " ")
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

fn phase_words(phase: &Phase) -> String {
    let days = |days: f64| format!("{} days", number(days));
    let over = (phase.over_days > 0.0).then(|| format!("fully there after {}", days(phase.over_days)));
    let fading = (phase.fading_days > 0.0).then(|| format!("gone after {} more", days(phase.fading_days)));
    let from = phase.from.map(|from| format!("from {}", String::from(from)));
    let until = phase.until.map(|until| format!("until the beginning of {}", String::from(until)));
    join([from, over, until, fading].into_iter().flatten(), ", ")
}
