//! Said, where, how often and how long: the parts of a sentence that stand in any order. Each fills a slot, once.

use super::words::TextSpan;
use crate::routine::{
    Activity, DayEpisode, DayKind, DaySelection, FallEnds, FallsFrom, HabitChance, PartOfDay, PhaseDay, Weather,
};
use homebody_core::fuzzy::Fuzzy;

/// A time of the day in seconds since midnight. An open one is of either half of the day, and below twelve hours.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClockTime {
    pub s: f64,
    pub open: bool,
    /// Whether the half of the day was named.
    pub half: bool,
    pub span: TextSpan,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeOfDay {
    pub clock: ClockTime,
    /// How far the time varies, in seconds.
    pub spread_s: f64,
}

/// Said something is done, with open times.
#[derive(Clone, Debug, PartialEq)]
pub enum Said {
    At(TimeOfDay),
    Between(TimeOfDay, TimeOfDay),
    FromTo(TimeOfDay, TimeOfDay),
    By(TimeOfDay),
    Within(PartOfDay),
    After(Activity, Option<Fuzzy>),
    Before(Activity, Option<Fuzzy>),
    With(Activity),
    Then,
}

/// A probability; a rate counts on all days of a period, whatever the days of the sentence.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chance {
    pub chance: HabitChance,
    pub is_rate: bool,
}

/// The amount of a change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measure {
    pub of: Of,
    pub by: Fuzzy,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Of {
    Later,
    LongerBy,
    Longer,
    Oftener,
    Much,
    Faster,
    FasterBy { each_week: bool },
    Active,
    Restless,
    Beats,
    Breaths,
    Some,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Slot<T> {
    pub value: T,
    pub span: TextSpan,
    /// Whether the sentence itself says it, and no heading.
    pub own: bool,
}

/// The kind of a slot, for sentences that do without some of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SlotKind {
    Chance,
    Days,
    Part,
    Said,
    Lasts,
    Until,
    Times,
    Phase,
    Place,
    Measure,
    Fall,
    Visit,
    Meanwhile,
}

macro_rules! parts {
    ($($(#[$doc:meta])* $name:ident: $type:ty, $kind:ident, $meaning:literal;)*) => {
        #[derive(Clone, Debug, Default, PartialEq)]
        pub struct Parts {
            $($(#[$doc])* pub $name: Option<Slot<$type>>,)*
        }

        impl Parts {
            /// Both together, and what is said twice: the second and the first words, and their meaning.
            pub fn and(&self, other: &Parts) -> (Parts, Vec<(TextSpan, TextSpan, &'static str)>) {
                let (mut all, mut twice) = (self.clone(), Vec::new());
                $(match (&self.$name, &other.$name) {
                    (Some(first), Some(second)) => twice.push((second.span, first.span, $meaning)),
                    (None, Some(slot)) => all.$name = Some(slot.clone()),
                    _ => {}
                })*
                (all, twice)
            }

            /// The kinds and the places of what the sentence itself says.
            pub fn slots(&self) -> Vec<(SlotKind, TextSpan)> {
                let mut slots = Vec::new();
                $(if let Some(slot) = self.$name.as_ref().filter(|slot| slot.own) {
                    slots.push((SlotKind::$kind, slot.span));
                })*
                slots
            }

            fn fill(&mut self, other: &Parts, own: bool, wanted: impl Fn(&str) -> bool) {
                $(if self.$name.is_none() && wanted(stringify!($name)) {
                    self.$name = other.$name.clone().map(|slot| Slot { own: own && slot.own, ..slot });
                })*
            }
        }
    };
}

parts! {
    chance: Chance, Chance, "both say how often";
    /// A later probability, and from which day on.
    becomes: (f64, PhaseDay), Chance, "both say how often";
    weekdays: u8, Days, "both say on which days";
    except_days: u8, Days, "both say on which days";
    months: u16, Days, "both say in which months";
    except_months: u16, Days, "both say in which months";
    every: u32, Days, "both say on which days";
    of_month: (u8, u8), Days, "both say on which days";
    kind: DayKind, Days, "both say on which days";
    weather: Weather, Days, "both say in which weather";
    episode: DayEpisode, Days, "both say on which days";
    poor_nights: u32, Days, "both say after which nights";
    part: Vec<PartOfDay>, Part, "both say at which time of the day";
    when: Vec<Said>, Said, "both say at which time";
    lasts: Fuzzy, Lasts, "both say how long";
    until: Said, Until, "both say until when";
    times: (u32, u32), Times, "both say how many times";
    /// Timed repetitions count, too: "twice a night in all".
    total: (), Times, "both say how many times";
    from: PhaseDay, Phase, "both say from when";
    /// From the end of the clause before.
    follows: (), Phase, "both say from when";
    until_day: PhaseDay, Phase, "both say until when";
    for_days: f64, Phase, "both say for how long";
    nights: u32, Phase, "both say for how long";
    key: (), Visit, "both say how the visitor comes in";
    thing_on: String, Meanwhile, "both say what is on meanwhile";
    over: f64, Phase, "both say over which time";
    fading: f64, Phase, "both say over which time";
    place: String, Place, "both say where";
    measure: Measure, Measure, "both say how it changes";
    fall_from: FallsFrom, Fall, "both say how she falls";
    /// To the floor, or there.
    floor: (), Fall, "both say how she falls";
    slowly: (), Fall, "both say how she falls";
    fall_ends: (FallEnds, Option<String>), Fall, "both say what follows the fall";
    mostly: PartOfDay, Fall, "both say at which time of the day";
}

impl Parts {
    /// Whether nothing is said.
    pub fn is_empty(&self) -> bool {
        *self == Parts::default()
    }

    /// What is said here, and of the rest what a heading says.
    pub fn under(mut self, heading: &Parts) -> Parts {
        let (says_part, says_days, says_end) = (
            self.part.is_some(),
            self.says_weekdays(),
            self.until_day.is_some() || self.for_days.is_some() || self.nights.is_some(),
        );
        self.fill(heading, false, |name| match name {
            "when" => !says_part,
            "weekdays" | "every" => !says_days,
            "until_day" | "for_days" | "nights" => !says_end,
            _ => true,
        });
        self
    }

    /// What is said here, with days and phase of another clause.
    pub fn on_days_of(mut self, other: &Parts) -> Parts {
        let says_days = self.says_weekdays();
        self.fill(other, false, |name| match name {
            "chance" | "becomes" | "weekdays" | "every" | "of_month" => !says_days,
            "except_days" | "months" | "except_months" | "kind" | "weather" | "episode" | "poor_nights" | "from"
            | "until_day" | "for_days" | "nights" | "over" | "fading" => true,
            _ => false,
        });
        self
    }

    /// What is said here, and all of the rest that another clause says.
    pub fn with_rest_of(mut self, other: &Parts) -> Parts {
        self.fill(other, true, |_| true);
        self
    }

    /// "About once every 2 months, for a week": the days in a row of an episode that begins at random.
    pub fn with_episode(mut self) -> Parts {
        /// Smallest ratio of the time between two beginnings to the length (our choice).
        const LEAST_APART: f64 = 1.5;
        let is_open = self.from.is_none() && self.until_day.is_none() && self.episode.is_none();
        let (Some(chance), Some(for_days), true) = (&self.chance, &self.for_days, is_open) else { return self };
        let (every_days, lasts_days) = ((1.0 / chance.value.chance.probability).round(), for_days.value);
        if chance.value.is_rate && chance.value.chance.becomes.is_none() && every_days >= LEAST_APART * lasts_days {
            let episode = DayEpisode { every_days: every_days as u32, lasts_days: lasts_days as u32 };
            let (span, own) = (chance.span.to(for_days.span), chance.own);
            self.episode = Some(Slot { value: episode, span, own });
            (self.chance, self.for_days) = (None, None);
        }
        self
    }

    fn says_weekdays(&self) -> bool {
        self.weekdays.is_some() || self.every.is_some() || self.of_month.is_some()
    }

    /// Where the sentence says on which days, from when, or how often.
    pub fn days_span(&self) -> Option<TextSpan> {
        let phase = |slot: &Option<Slot<PhaseDay>>| slot.as_ref().map(|slot| slot.span);
        [
            self.weekdays.as_ref().map(|slot| slot.span),
            self.chance.as_ref().map(|slot| slot.span),
            self.months.as_ref().map(|slot| slot.span),
            self.every.as_ref().map(|slot| slot.span),
            self.of_month.as_ref().map(|slot| slot.span),
            self.kind.as_ref().map(|slot| slot.span),
            phase(&self.from),
            phase(&self.until_day),
        ]
        .into_iter()
        .flatten()
        .next()
    }

    pub fn says_time(&self) -> bool {
        self.when.is_some() || self.part.is_some() || self.until.is_some() || self.times.is_some()
    }

    pub fn days(&self) -> DaySelection {
        let every = self.every.as_ref().map_or(1, |slot| slot.value);
        let except_days = self.except_days.as_ref().map_or(0, |slot| slot.value);
        let except_months = self.except_months.as_ref().map_or(0, |slot| slot.value);
        let weekdays = self.weekdays.as_ref().map_or(DaySelection::ALL.weekdays, |slot| slot.value);
        // A weekday comes round on days that lie seven apart, so every 14 days are every two weeks.
        let is_of_weeks = weekdays.count_ones() == 1 && every.is_multiple_of(7);
        DaySelection {
            weekdays: weekdays & !except_days,
            months: self.months.as_ref().map_or(DaySelection::ALL.months, |slot| slot.value) & !except_months,
            every: if is_of_weeks { every / 7 } else { every },
            of_month: self.of_month.as_ref().map_or(DaySelection::ALL.of_month, |slot| slot.value),
            kind: self.kind.as_ref().map(|slot| slot.value),
            weather: self.weather.as_ref().map(|slot| slot.value),
            episode: self.episode.as_ref().map(|slot| slot.value),
            poor_nights: self.poor_nights.as_ref().map_or(0, |slot| slot.value),
        }
    }
}
