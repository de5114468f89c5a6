//! The days of a drawn statement: their words, and the probability of each.

use super::numbers::Draw;
use crate::claims::WEEKDAYS;
use homebody_core::calendar::Calendar;
use homebody_core::fuzzy::Quantifier;

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

#[derive(Clone, Debug, PartialEq)]
pub enum DrawnDays {
    All,
    /// Bit 0 is Monday.
    Weekdays(u8),
    Every(i32),
    /// Every second such day of the week, by weeks of the run.
    EveryOther(u8),
    Month(u8),
    /// The first, counted from 1, or the last such day of the week in a month.
    OfMonth(u8, Option<u8>),
}

#[derive(Clone, Debug, PartialEq)]
pub enum DrawnChance {
    Every,
    Word(Quantifier),
    Percent(u32),
    DaysAWeek(u8),
    /// Evenly from the first to the second by a day.
    Becomes(Quantifier, Quantifier, i32),
}

/// Days are counted from 0.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DrawnPhase {
    pub from: Option<i32>,
    pub over: i32,
    /// The first day without it.
    pub until: Option<i32>,
    pub fading: i32,
}

impl DrawnDays {
    pub fn draw(draw: &mut Draw, calendar: &Calendar, days: i32) -> DrawnDays {
        match draw.below(12) {
            0..=4 => DrawnDays::All,
            5..=7 => {
                let mut days = 0;
                for _ in 0..=draw.below(3) {
                    days |= 1 << draw.below(7);
                }
                DrawnDays::Weekdays(days)
            }
            8 => DrawnDays::Weekdays(if draw.one_in(2) { 0x1f } else { 0x60 }),
            9 => DrawnDays::Every(2 + draw.below(3) as i32),
            10 => DrawnDays::EveryOther(draw.below(7) as u8),
            _ if draw.one_in(2) => DrawnDays::Month(calendar.date(draw.below(days as u32) as i32).1),
            _ => DrawnDays::OfMonth(draw.below(7) as u8, Some(1 + draw.below(3) as u8).filter(|_| !draw.one_in(3))),
        }
    }

    pub fn field(&self) -> Option<&'static str> {
        match self {
            DrawnDays::All => None,
            DrawnDays::Weekdays(_) => Some("days of the week"),
            DrawnDays::Every(_) | DrawnDays::EveryOther(_) => Some("every so many days"),
            DrawnDays::Month(_) => Some("months"),
            DrawnDays::OfMonth(..) => Some("days of the month"),
        }
    }

    pub fn words(&self) -> String {
        match self {
            DrawnDays::All => String::new(),
            DrawnDays::Weekdays(0x1f) => " on weekdays".to_owned(),
            DrawnDays::Weekdays(0x60) => " at weekends".to_owned(),
            DrawnDays::Weekdays(days) => {
                let names: Vec<&str> = (0..7).filter(|day| days >> day & 1 == 1).map(|day| WEEKDAYS[day]).collect();
                let (last, others) = names.split_last().unwrap_or((&"", &[]));
                match others {
                    [] => format!(" on {last}"),
                    others => format!(" on {} and {last}", others.join(", ")),
                }
            }
            DrawnDays::Every(2) => " every other day".to_owned(),
            DrawnDays::Every(days) => format!(" every {days} days"),
            DrawnDays::EveryOther(day) => format!(" every other {}", WEEKDAYS[usize::from(*day)]),
            DrawnDays::Month(month) => format!(" in {}", MONTHS[usize::from(*month) - 1]),
            DrawnDays::OfMonth(day, which) => {
                let which = which.map_or("last", |which| ["first", "second", "third"][usize::from(which) - 1]);
                format!(" on the {which} {} of the month", WEEKDAYS[usize::from(*day)])
            }
        }
    }

    /// Whether a day is meant. Every other such day of the week is in the first week, which begins on a Monday, and every second after.
    pub fn holds(&self, calendar: &Calendar, day: i32) -> bool {
        let (_, month, day_of_month) = calendar.date(day);
        let weekday = calendar.weekday(day);
        match *self {
            DrawnDays::All => true,
            DrawnDays::Weekdays(days) => days >> weekday & 1 == 1,
            DrawnDays::Every(days) => day % days == 0,
            DrawnDays::EveryOther(wanted) => weekday == wanted && (day + i32::from(calendar.weekday(0))) / 7 % 2 == 0,
            DrawnDays::Month(wanted) => month == wanted,
            DrawnDays::OfMonth(wanted, which) => {
                let is_it = match which {
                    Some(which) => (day_of_month - 1) / 7 + 1 == which,
                    None => calendar.date(day + 7).1 != month,
                };
                weekday == wanted && is_it
            }
        }
    }
}

impl DrawnChance {
    pub fn draw(draw: &mut Draw, days: &DrawnDays) -> DrawnChance {
        let words = [Quantifier::Rarely, Quantifier::Sometimes, Quantifier::Often, Quantifier::Most];
        match (draw.below(8), days) {
            (0, DrawnDays::All) => DrawnChance::Percent(10 * (1 + draw.below(9))),
            (1, DrawnDays::All) => DrawnChance::DaysAWeek(2 + draw.below(4) as u8),
            (2 | 3, _) => DrawnChance::Word(words[draw.below(4) as usize]),
            _ => DrawnChance::Every,
        }
    }

    pub fn words(&self) -> String {
        match self {
            DrawnChance::Every | DrawnChance::DaysAWeek(_) | DrawnChance::Becomes(..) => String::new(),
            DrawnChance::Word(Quantifier::Most) => "usually ".to_owned(),
            DrawnChance::Word(word) => format!("{} ", word.word()),
            DrawnChance::Percent(percent) => format!("on {percent} % of days "),
        }
    }

    pub fn words_after(&self) -> String {
        match self {
            DrawnChance::DaysAWeek(2) => " twice a week".to_owned(),
            DrawnChance::DaysAWeek(days) => format!(" {days} times a week"),
            DrawnChance::Becomes(first, then, day) => {
                format!(", {} at first, {} by day {}", first.word(), then.word(), day + 1)
            }
            _ => String::new(),
        }
    }

    fn on(&self, from: i32, day: i32) -> f64 {
        match self {
            DrawnChance::Every => 1.0,
            DrawnChance::Word(word) => word.probability(),
            DrawnChance::Percent(percent) => f64::from(*percent) / 100.0,
            DrawnChance::DaysAWeek(days) => f64::from(*days) / 7.0,
            DrawnChance::Becomes(first, then, by) => {
                let share = (f64::from(day - from) / f64::from((by - from).max(1))).clamp(0.0, 1.0);
                first.probability() + (then.probability() - first.probability()) * share
            }
        }
    }
}

impl DrawnPhase {
    pub fn draw(draw: &mut Draw, days: i32) -> DrawnPhase {
        let within =
            |draw: &mut Draw, from: f64, to: f64| draw.between(f64::from(days) * from, f64::from(days) * to) as i32;
        match draw.below(9) {
            0 => DrawnPhase { from: Some(within(draw, 0.2, 0.6)), ..DrawnPhase::default() },
            1 => DrawnPhase { until: Some(within(draw, 0.4, 0.8)), ..DrawnPhase::default() },
            2 => {
                let from = within(draw, 0.1, 0.4);
                DrawnPhase { from: Some(from), until: Some(from + within(draw, 0.2, 0.5)), ..DrawnPhase::default() }
            }
            3 => {
                DrawnPhase { from: Some(within(draw, 0.1, 0.3)), over: within(draw, 0.2, 0.5), ..DrawnPhase::default() }
            }
            4 if draw.one_in(2) => {
                let from = within(draw, 0.1, 0.2);
                let (until, fading) = (Some(from + within(draw, 0.2, 0.3)), within(draw, 0.2, 0.4));
                DrawnPhase { from: Some(from), until, fading, over: 0 }
            }
            _ => DrawnPhase::default(),
        }
    }

    pub fn words(&self) -> String {
        let DrawnPhase { from, over, until, fading } = *self;
        let fades = if fading > 0 { format!(", fading over {fading} days") } else { String::new() };
        match (from, until) {
            (None, None) => String::new(),
            (None, Some(until)) => format!("until day {}, ", until + 1),
            (Some(from), Some(until)) => format!("from day {}, for {} days{fades}, ", from + 1, until - from),
            (Some(from), None) if over > 0 => format!("from day {}, over {over} days, ", from + 1),
            (Some(from), None) => format!("from day {}, ", from + 1),
        }
    }

    /// From 0 to 1.
    pub fn strength(&self, day: i32) -> f64 {
        let risen = match self.from {
            Some(from) if day < from => 0.0,
            Some(from) if self.over > 0 => (f64::from(day - from + 1) / f64::from(self.over)).min(1.0),
            _ => 1.0,
        };
        let left = match self.until {
            Some(until) if day >= until && self.fading == 0 => 0.0,
            Some(until) if day >= until => (1.0 - f64::from(day - until + 1) / f64::from(self.fading)).max(0.0),
            _ => 1.0,
        };
        risen * left
    }

    pub fn fields(&self) -> Vec<&'static str> {
        let parts = [
            (self.from.is_some(), "from"),
            (self.until.is_some(), "until"),
            (self.over > 0, "over"),
            (self.fading > 0, "fading"),
        ];
        parts.into_iter().filter(|(is_drawn, _)| *is_drawn).map(|(_, field)| field).collect()
    }
}

/// When a statement holds.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnWhen {
    pub days: DrawnDays,
    pub chance: DrawnChance,
    pub phase: DrawnPhase,
}

impl DrawnWhen {
    pub const ALWAYS: DrawnWhen = DrawnWhen {
        days: DrawnDays::All,
        chance: DrawnChance::Every,
        phase: DrawnPhase { from: None, over: 0, until: None, fading: 0 },
    };

    pub fn draw(draw: &mut Draw, calendar: &Calendar, days: i32) -> DrawnWhen {
        let of = DrawnDays::draw(draw, calendar, days);
        let chance = DrawnChance::draw(draw, &of);
        // A part of the days in a part of the run leaves too few to measure.
        let phase = if of == DrawnDays::All { DrawnPhase::draw(draw, days) } else { DrawnPhase::default() };
        DrawnWhen { days: of, chance, phase }
    }

    pub fn chance(&self, calendar: &Calendar, day: i32) -> f64 {
        match self.days.holds(calendar, day) {
            true => self.chance.on(self.phase.from.unwrap_or(0), day) * self.phase.strength(day),
            false => 0.0,
        }
    }
}
