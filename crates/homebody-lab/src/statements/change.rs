//! Drawn changes. A change is measured before and after its beginning, or against a twin run without it.

use super::bounds::{self, count_bounds, mean, mean_error, spread};
use super::days::DrawnPhase;
use super::field::{FieldResult, LifeView};
use super::homes::LifeContext;
use super::homes::{DrawnHome, clock};
use super::numbers::Draw;
use crate::claims::{Filter, Occurrence, Subject, WEEKDAYS};
use homebody_core::activity::{
    AWAY, DRINKING, EATING_DINNER, EATING_LUNCH, EXERCISING, GETTING_UP, GOING_TO_BED, HAVING_A_SNACK, NAPPING,
    PREPARING_DINNER, PREPARING_LUNCH, SHOWERING, TAKING_MEDICINE, USING_BATHROOM,
};

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DrawnEffect {
    Pace(f64),
    PaceEachWeek(f64),
    /// In minutes.
    Later(f64),
    Longer(f64),
    LongerBy(f64),
    Oftener(f64),
    /// Of a need, against the twin run; at night if true.
    NeedOftener(f64, bool),
    Skips(f64),
    Irregular(f64),
    Active(f64),
    Restless(f64),
    /// Of this day of the week.
    QuietDay(u8),
    BusyDay(u8),
    DaysDiffer,
    Forgets(f64),
    SleepsIn,
    Shows,
    Pulse,
    Respiration,
}

#[derive(Clone, Debug, PartialEq)]
pub struct DrawnChange {
    pub kind: &'static str,
    words: String,
    pub carriers: Vec<String>,
    pub about: Vec<&'static str>,
    pub phase: DrawnPhase,
    pub effect: DrawnEffect,
}

/// A habit that is changed: its words without an ending, its carrier, and its label.
const CHANGED: [(&str, &str, &str); 4] = [
    ("exercises", "she exercises at 10:00 for 20 minutes.", EXERCISING),
    ("naps", "she naps at 14:30 for 40 minutes.", NAPPING),
    ("eats lunch", "she eats lunch at 12:45 for 30 minutes.", EATING_LUNCH),
    ("takes a shower", "she takes a shower at 09:30 for 15 minutes.", SHOWERING),
];

/// Allowed difference of two values apart from chance, relative to the value (our choice).
const NEAR: f64 = 0.05;

impl DrawnChange {
    pub fn draw(draw: &mut Draw, context: &LifeContext) -> DrawnChange {
        use DrawnEffect as Effect;
        let days = f64::from(context.days);
        let from = draw.between(0.3 * days, 0.5 * days) as i32;
        let phase = match draw.below(4) {
            0 => DrawnPhase { from: Some(from), over: draw.between(3.0, 0.2 * days) as i32, ..DrawnPhase::default() },
            1 => DrawnPhase { from: Some(from), until: Some(from + (0.3 * days) as i32), ..DrawnPhase::default() },
            _ => DrawnPhase { from: Some(from), ..DrawnPhase::default() },
        };
        let always = DrawnPhase::default();
        let percent = 10.0 * f64::from(1 + draw.below(5));
        let minutes = 15.0 * f64::from(1 + draw.below(5));
        let (changed, carrier, label) = CHANGED[draw.below(4) as usize];
        let changed_carrier = vec![context.base.in_its_morning(carrier)];
        let times = [0.5, 2.0][draw.below(2) as usize];
        let times_words = if times < 1.0 { "half" } else { "twice" };
        let weekday = draw.below(7) as u8;
        let weekday_name = WEEKDAYS[usize::from(weekday)];
        let new = |kind, words: String, carriers: Vec<String>, about: &[&'static str], phase, effect| DrawnChange {
            kind,
            words,
            carriers,
            about: about.to_vec(),
            phase,
            effect,
        };
        match draw.below(20) {
            0 => new(
                "pace",
                format!("she walks {percent} % slower"),
                vec![],
                &["pace"],
                phase,
                Effect::Pace(1.0 - percent / 100.0),
            ),
            1 => new(
                "pace each week",
                "she walks 0.02 m/s slower every week".into(),
                vec![],
                &["pace"],
                DrawnPhase { from: Some(from), ..always },
                Effect::PaceEachWeek(-0.02),
            ),
            2 | 3 => {
                let (is_later, sign) = if draw.one_in(2) { ("later", 1.0) } else { ("earlier", -1.0) };
                let (words, carriers, about) = match draw.below(5) {
                    0 => ("gets up", vec![format!("she gets up at {}.", clock(context.base.up_min))], GETTING_UP),
                    1 => (
                        "goes to bed",
                        vec![format!("she goes to bed at {}.", clock(context.base.bed_min))],
                        GOING_TO_BED,
                    ),
                    _ => (changed, changed_carrier, label),
                };
                new(
                    "time",
                    format!("she {words} {minutes} minutes {is_later}"),
                    carriers,
                    &[about],
                    phase,
                    Effect::Later(sign * minutes),
                )
            }
            4 => new(
                "length by a factor",
                format!("she {changed} {percent} % longer"),
                changed_carrier,
                &[label],
                phase,
                Effect::Longer(1.0 + percent / 100.0),
            ),
            5 => new(
                "length by a factor",
                format!("she {changed} half as long"),
                changed_carrier,
                &[label],
                phase,
                Effect::Longer(0.5),
            ),
            6 => {
                let by = 5.0 * f64::from(1 + draw.below(4));
                new(
                    "length by minutes",
                    format!("she {changed} {by} minutes longer"),
                    changed_carrier,
                    &[label],
                    phase,
                    Effect::LongerBy(by),
                )
            }
            7 => new(
                "length by minutes",
                "she is out 1 hour less".into(),
                vec!["she goes out at 14:00 for 3 hours.".into()],
                &[AWAY],
                phase,
                Effect::LongerBy(-60.0),
            ),
            8 => new(
                "frequency",
                format!("she exercises {times_words} as often"),
                vec![context.base.in_its_morning("on 40 % of days she exercises at 10:00.")],
                &[EXERCISING],
                phase,
                Effect::Oftener(times),
            ),
            9 => {
                let need = [("has a drink", DRINKING), ("has a snack", HAVING_A_SNACK)][draw.below(2) as usize];
                new(
                    "frequency of a need",
                    format!("she {} {times_words} as often", need.0),
                    vec![],
                    &[need.1],
                    always,
                    Effect::NeedOftener(times, false),
                )
            }
            10 => new(
                "frequency of a need",
                "she goes to the bathroom twice as often at night".into(),
                vec![],
                &[USING_BATHROOM],
                always,
                Effect::NeedOftener(2.0, true),
            ),
            11 | 12 => {
                let (words, carrier, about) = match draw.below(3) {
                    0 => ("skips lunch", CHANGED[2].1, EATING_LUNCH),
                    1 => ("skips dinner", "she eats dinner at 18:00 for 30 minutes.", EATING_DINNER),
                    _ => ("does not take her pills", "she takes her pills at 09:00.", TAKING_MEDICINE),
                };
                new(
                    "skipping",
                    format!("she {words} on {percent} % of days"),
                    vec![context.base.in_its_morning(carrier)],
                    &[about],
                    phase,
                    Effect::Skips(percent / 100.0),
                )
            }
            13 => new(
                "hours",
                "her hours vary twice as much".into(),
                vec![context.base.in_its_morning("she exercises at 10:00, give or take 30 minutes.")],
                &[EXERCISING, "everything"],
                DrawnPhase { from: Some(from), ..always },
                Effect::Irregular(2.0),
            ),
            14 => new(
                "movement",
                format!("she is {percent} % less active"),
                vec![],
                &["everything"],
                always,
                Effect::Active(1.0 - percent / 100.0),
            ),
            15 => new(
                "movement in bed",
                format!("she turns in bed {percent} % more"),
                vec![],
                &["everything"],
                always,
                Effect::Restless(1.0 + percent / 100.0),
            ),
            16 if draw.one_in(2) => new(
                "kinds of days",
                format!("{weekday_name}s are quiet days"),
                vec![],
                &["everything"],
                always,
                Effect::QuietDay(weekday),
            ),
            16 => new(
                "kinds of days",
                format!("{weekday_name} is a busy day"),
                vec![],
                &["everything"],
                always,
                Effect::BusyDay(weekday),
            ),
            17 if draw.one_in(2) => new(
                "difference of days",
                "her days differ a lot".into(),
                vec![],
                &["everything"],
                always,
                Effect::DaysDiffer,
            ),
            17 => new(
                "rising after late nights",
                "when she goes to bed late she gets up late".into(),
                vec![
                    format!("she gets up at {}.", clock(context.base.up_min)),
                    format!("she goes to bed at {}.", clock(context.base.bed_min)),
                    "on Saturday she goes out at 19:00 for 7 hours.".into(),
                ],
                &[GETTING_UP, GOING_TO_BED, AWAY],
                always,
                Effect::SleepsIn,
            ),
            // Others turn off what they use.
            18 if !context.home.has_two() => new(
                "things left on",
                format!("she forgets the stove on {percent} % of occasions"),
                vec![],
                &["stove"],
                phase,
                Effect::Forgets(percent / 100.0),
            ),
            _ if context.home.has_bed_sensor && draw.one_in(2) => match draw.one_in(2) {
                true => new(
                    "pulse",
                    "her pulse rises by 40 beats".into(),
                    vec![],
                    &["everything"],
                    DrawnPhase { from: Some(from), ..always },
                    Effect::Pulse,
                ),
                false => new(
                    "respiration",
                    "she breathes 16 breaths a minute faster".into(),
                    vec![],
                    &["everything"],
                    DrawnPhase { from: Some(from), ..always },
                    Effect::Respiration,
                ),
            },
            _ => new(
                "condition",
                "she shows moderate frailty".into(),
                vec![],
                &["everything", "condition"],
                phase,
                Effect::Shows,
            ),
        }
    }

    pub fn has_twin(&self) -> bool {
        use DrawnEffect::{Active, BusyDay, DaysDiffer, NeedOftener, QuietDay, Restless};
        matches!(self.effect, Active(_) | Restless(_) | QuietDay(_) | BusyDay(_) | DaysDiffer | NeedOftener(..))
    }

    pub fn words(&self, home: &DrawnHome) -> String {
        let text = home.of_person(&format!("{}{}", self.phase.words(), self.words));
        let mut text = text;
        text[..1].make_ascii_uppercase();
        format!("{text}.")
    }

    pub fn judge(&self, view: &LifeView, twin: Option<&LifeView>) -> Vec<FieldResult> {
        use DrawnEffect as Effect;
        let days = view.days;
        let from = self.phase.from.unwrap_or(0);
        let full = (from + self.phase.over).min(days);
        let end = self.phase.until.unwrap_or(days).min(days);
        let over = |first: i32, last: i32| Filter { days: Some((first + 1, last)), ..Filter::default() };
        let (before, during, after) = (over(0, from), over(full, end), over(end, days));
        let label = self.about[0];
        let of = |filter: &Filter| {
            view.life.occurrences(view.who, &Subject::Activity(label.to_owned()), filter, label == GOING_TO_BED)
        };
        let daily = |view: &LifeView, subject: Subject, filter: &Filter| view.life.daily(view.who, &subject, filter);
        let mut fields = Vec::new();
        let mut add = |field: &str, low: f64, high: f64, value: f64, unit: &str| {
            fields.push(FieldResult::range(field, low, high, value, unit));
        };
        let near = |value: f64, error: f64| (value - error, value + error);
        match self.effect {
            Effect::Pace(factor) => {
                let ratio = |filter: &Filter| {
                    mean(&daily(view, Subject::Speed, filter)) / mean(&daily(view, Subject::Speed, &before))
                };
                add("size", factor - NEAR, factor + NEAR, ratio(&during), "of the pace before");
                if self.phase.until.is_some() && end < days {
                    add("until", 1.0 - NEAR, 1.0 + NEAR, ratio(&after), "of the pace before");
                }
            }
            Effect::PaceEachWeek(by) => {
                let weeks = f64::from((days - 1 - from) / 7);
                let last = over(days - 7, days);
                let expected = by * (weeks - 0.5).max(0.0);
                let moved = mean(&daily(view, Subject::Speed, &last)) - mean(&daily(view, Subject::Speed, &before));
                add("size", expected - 0.03, expected + 0.03, moved, "m/s");
            }
            Effect::Later(by) => {
                // Times after midnight follow those before.
                let base = of(&before).first().map_or(0.0, |one| one.clock_min);
                let around = |minute: f64| (minute - base + 720.0).rem_euclid(1440.0) - 720.0;
                let starts = |filter: &Filter| trimmed(of(filter).iter().map(|one| around(one.clock_min)).collect());
                let (first, then) = (starts(&before), starts(&during));
                let error = mean_error(spread(&first), first.len()) + mean_error(spread(&then), then.len());
                let (low, high) = near(by, error + 5.0);
                add("size", low, high, mean(&then) - mean(&first), "min later");
                if self.phase.until.is_some() && end < days {
                    let rest = starts(&after);
                    let error = mean_error(spread(&first), first.len()) + mean_error(spread(&rest), rest.len());
                    add("until", -error - 5.0, error + 5.0, mean(&rest) - mean(&first), "min later");
                }
            }
            Effect::Longer(_) | Effect::LongerBy(_) => {
                let lengths = |filter: &Filter| minutes(&of(filter));
                let (first, then) = (lengths(&before), lengths(&during));
                let error = mean_error(spread(&first), first.len()) + mean_error(spread(&then), then.len());
                let expected = match self.effect {
                    Effect::Longer(factor) => mean(&first) * factor,
                    Effect::LongerBy(by) => mean(&first) + by,
                    _ => f64::NAN,
                };
                let (low, high) = near(expected, error + 2.0 * NEAR * expected + 1.0);
                add("size", low, high, mean(&then), "min");
                if self.phase.until.is_some() && end < days {
                    let rest = lengths(&after);
                    let (low, high) = near(mean(&first), error + NEAR * mean(&first) + 1.0);
                    add("until", low, high, mean(&rest), "min");
                }
            }
            Effect::Oftener(factor) | Effect::Skips(factor) => {
                let usual = if label == EXERCISING { 0.4 } else { 1.0 };
                let chance = match self.effect {
                    Effect::Skips(chance) => usual * (1.0 - chance),
                    _ => usual * factor,
                };
                let count = |first: i32, last: i32, chance: f64| {
                    let last = last.min(days - 1);
                    let (low, high) = count_bounds(&vec![chance; (last - first).max(0) as usize]);
                    let mut on: Vec<i32> = of(&over(first, last)).iter().map(|one| one.day).collect();
                    on.dedup();
                    (low as f64, high as f64, on.len() as f64)
                };
                let (low, high, value) = count(full, end, chance);
                add("size", low, high, value, "days");
                if self.phase.until.is_some() && end < days {
                    let (low, high, value) = count(end, days, usual);
                    add("until", low, high, value, "days");
                }
            }
            Effect::NeedOftener(factor, at_night) => {
                let Some(twin) = twin else { return fields };
                let count = |view: &LifeView| {
                    let hours = if at_night { Some((1380.0, 1800.0)) } else { None };
                    let filter = Filter { between: hours, ..over(0, days - 1) };
                    view.life.occurrences(view.who, &Subject::Activity(label.to_owned()), &filter, false).len() as f64
                };
                let (own, other) = (count(view), count(twin));
                // Counts of renewals vary less than those of a Poisson process.
                let error = 3.89 * factor * (1.0 / (factor * other).max(1.0) + 1.0 / other.max(1.0)).sqrt();
                let (low, high) = near(factor, 0.15 * factor + error);
                add("size", low.max(0.0), high, own / other, "times the twin's");
            }
            Effect::Irregular(factor) => {
                let starts = |filter: &Filter| spread(&of(filter).iter().map(|one| one.clock_min).collect::<Vec<_>>());
                let (first, then) = (of(&before).len() as f64, of(&during).len() as f64);
                let error = 3.89 * factor * (0.4 / first.max(2.0) + 0.4 / then.max(2.0)).sqrt();
                let (low, high) = near(factor, 0.1 * factor + error);
                add("size", low.max(0.0), high, starts(&during) / starts(&before), "times the spread before");
            }
            Effect::Active(factor) => {
                let Some(twin) = twin else { return fields };
                let metres = |view: &LifeView| mean(&daily(view, Subject::Metres, &over(0, days)));
                add(
                    "size",
                    factor - NEAR - 0.02,
                    factor + NEAR + 0.02,
                    metres(view) / metres(twin),
                    "of the twin's metres",
                );
            }
            Effect::QuietDay(weekday) | Effect::BusyDay(weekday) => {
                let Some(twin) = twin else { return fields };
                let factor = if matches!(self.effect, Effect::QuietDay(_)) { 0.5 } else { 1.5 };
                let on = |view: &LifeView, days: u8| {
                    daily(view, Subject::Metres, &Filter { weekdays: Some(days), ..over(0, view.days) })
                };
                let ratio = |days: u8| mean(&on(view, days)) / mean(&on(twin, days));
                let (own, of_twin) = (on(view, 1 << weekday), on(twin, 1 << weekday));
                let ratios: Vec<f64> = own.iter().zip(&of_twin).map(|(own, twin)| own / twin).collect();
                let (low, high) = near(factor, 0.1 * factor + mean_error(spread(&ratios), ratios.len()));
                add("size", low, high, ratio(1 << weekday), "of the twin's metres");
                add("days of the week", 0.9, 1.1, ratio(!(1 << weekday) & 0x7f), "of the twin's metres on other days");
            }
            Effect::DaysDiffer => {
                let Some(twin) = twin else { return fields };
                let differ = |view: &LifeView| {
                    spread(
                        &daily(view, Subject::Metres, &over(0, days))
                            .iter()
                            .map(|metres| metres.max(1.0).ln())
                            .collect::<Vec<_>>(),
                    )
                };
                add("size", 1.2, 2.8, differ(view) / differ(twin), "times the twin's spread");
            }
            Effect::Restless(factor) => {
                let Some(twin) = twin else { return fields };
                let turning = |view: &LifeView| mean(&daily(view, Subject::Turning, &over(1, days)));
                let (low, high) = near(factor, 0.15 * factor);
                add("size", low, high, turning(view) / turning(twin), "times the twin's");
            }
            Effect::Forgets(chance) => {
                let left = |first: i32, last: i32, chance: f64| {
                    let cooked = [PREPARING_LUNCH, PREPARING_DINNER].map(|label| {
                        view.life.occurrences(
                            view.who,
                            &Subject::Activity(label.to_owned()),
                            &over(first, last.min(days - 1)),
                            false,
                        )
                    });
                    let cooked = cooked.concat();
                    let left = cooked
                        .iter()
                        .filter(|one| view.life.is_on("stove", one.time.end + 3 * super::field::MINUTE))
                        .count();
                    let (low, high) = count_bounds(&vec![chance; cooked.len()]);
                    // Cooking that is interrupted continues.
                    let high = high + bounds::allowed(cooked.len() as f64, bounds::LEFT_OUT);
                    (low as f64, high as f64, left as f64)
                };
                let (low, high, value) = left(full, end, chance);
                add("size", low, high, value, "of the meals");
                let (low, high, value) = left(0, from, 0.0);
                add("from", low, high, value, "of the meals before");
            }
            Effect::SleepsIn => {
                let up = |days: u8, filter: Filter| {
                    mean(
                        &view
                            .life
                            .occurrences(
                                view.who,
                                &Subject::Activity(GETTING_UP.into()),
                                &Filter { weekdays: Some(days), ..filter },
                                false,
                            )
                            .iter()
                            .map(|one| one.clock_min)
                            .collect::<Vec<_>>(),
                    )
                };
                let nights = view.life.occurrences(
                    view.who,
                    &Subject::Activity(GOING_TO_BED.into()),
                    &Filter { weekdays: Some(0x20), ..over(0, days - 1) },
                    true,
                );
                let bed = mean(&nights.iter().map(|one| (one.clock_min + 720.0) % 1440.0 + 720.0).collect::<Vec<_>>());
                let late = bed - view.bed_min;
                let expected = if late < 30.0 { 0.0 } else { late };
                add(
                    "size",
                    expected - 20.0,
                    expected + 20.0,
                    up(0x40, over(7, days)) - up(0x1f, over(7, days)),
                    "min later",
                );
            }
            Effect::Shows => {
                let severity = |filter: &Filter| mean(&daily(view, Subject::Severity("frailty".into()), filter));
                add("size", 0.95, 1.05, severity(&over(full + 1, end)), "severity");
                add("from", 0.0, 0.0, severity(&before), "severity before");
            }
            Effect::Pulse | Effect::Respiration => {
                let value = if self.effect == Effect::Pulse { "PULSE_HIGH" } else { "RESPIRATION_HIGH" };
                let count = |filter: &Filter| {
                    view.life.occurrences(view.who, &Subject::Says(value.into()), filter, false).len() as f64
                };
                let (first, then) =
                    (count(&before) / f64::from(from.max(1)), count(&during) / f64::from((end - full).max(1)));
                add("size", first + 1.0, f64::INFINITY, then, "messages of the bed a day");
            }
        }
        fields
    }
}

fn minutes(all: &[Occurrence]) -> Vec<f64> {
    all.iter().map(|one| one.lasted.seconds() / 60.0).collect()
}

/// Minutes of the day around their middle, without the twentieth that is farthest from it.
fn trimmed(values: Vec<f64>) -> Vec<f64> {
    let Some(first) = values.first().copied() else { return values };
    let mut values: Vec<f64> =
        values.iter().map(|value| (value - first + 720.0).rem_euclid(1440.0) - 720.0 + first).collect();
    values.sort_by(f64::total_cmp);
    let middle = values[values.len() / 2];
    values.sort_by(|a, b| (a - middle).abs().total_cmp(&(b - middle).abs()));
    values.truncate(values.len() - bounds::allowed(values.len() as f64, bounds::OFF));
    values
}
