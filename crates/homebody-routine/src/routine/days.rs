//! Days, parts of days, and phases.

use homebody_core::calendar::Calendar;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The days of a habit or change.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(into = "DayNames", from = "DayNames")]
#[schemars(with = "DayNames")]
pub struct DaySelection {
    /// Bit 0 is Monday, bit 6 Sunday.
    pub weekdays: u8,
    /// Bit 0 is January, bit 11 December.
    pub months: u16,
    /// Every this many days from the first; 1 is every day. With a single weekday, every this many weeks from the Monday of the
    /// first.
    pub every: u32,
    /// First and last day of the month: from 1 to 7 with Mondays selects the first Monday, from 0 to 7 the last week.
    pub of_month: (u8, u8),
    pub kind: Option<DayKind>,
    pub weather: Option<Weather>,
    pub episode: Option<DayEpisode>,
    /// Least number of poor nights in a row before.
    pub poor_nights: u32,
}

impl Default for DaySelection {
    fn default() -> DaySelection {
        DaySelection::ALL
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
enum WeekdayName {
    Monday,
    Tuesday,
    Wednesday,
    Thursday,
    Friday,
    Saturday,
    Sunday,
}

impl WeekdayName {
    const ALL: [WeekdayName; 7] = [
        WeekdayName::Monday,
        WeekdayName::Tuesday,
        WeekdayName::Wednesday,
        WeekdayName::Thursday,
        WeekdayName::Friday,
        WeekdayName::Saturday,
        WeekdayName::Sunday,
    ];
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
enum MonthName {
    January,
    February,
    March,
    April,
    May,
    June,
    July,
    August,
    September,
    October,
    November,
    December,
}

impl MonthName {
    const ALL: [MonthName; 12] = [
        MonthName::January,
        MonthName::February,
        MonthName::March,
        MonthName::April,
        MonthName::May,
        MonthName::June,
        MonthName::July,
        MonthName::August,
        MonthName::September,
        MonthName::October,
        MonthName::November,
        MonthName::December,
    ];
}

/// A selection of days with names for the bits; what is left out selects all.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
struct DayNames {
    #[serde(skip_serializing_if = "Vec::is_empty")]
    weekdays: Vec<WeekdayName>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    months: Vec<MonthName>,
    /// Every this many days from the first; with a single weekday, every this many weeks from the Monday of the first.
    #[serde(skip_serializing_if = "Option::is_none")]
    every: Option<u32>,
    /// First and last day of the month; from 0 to 7 is the last week.
    #[serde(skip_serializing_if = "Option::is_none")]
    of_month: Option<(u8, u8)>,
    #[serde(skip_serializing_if = "Option::is_none")]
    kind: Option<DayKind>,
    #[serde(skip_serializing_if = "Option::is_none")]
    weather: Option<Weather>,
    /// Days in a row that begin at random.
    #[serde(skip_serializing_if = "Option::is_none")]
    episode: Option<DayEpisode>,
    /// Least number of poor nights in a row before.
    #[serde(skip_serializing_if = "super::is_usual")]
    poor_nights: u32,
}

impl From<DaySelection> for DayNames {
    fn from(days: DaySelection) -> DayNames {
        let all = DaySelection::ALL;
        let is_set = |bits: u16, index: usize| bits & 1 << index != 0;
        let weekdays =
            WeekdayName::ALL.into_iter().enumerate().filter(|(index, _)| is_set(days.weekdays.into(), *index));
        let months = MonthName::ALL.into_iter().enumerate().filter(|(index, _)| is_set(days.months, *index));
        DayNames {
            weekdays: weekdays.map(|(_, day)| day).filter(|_| days.weekdays != all.weekdays).collect(),
            months: months.map(|(_, month)| month).filter(|_| days.months != all.months).collect(),
            every: Some(days.every).filter(|every| *every != all.every),
            of_month: Some(days.of_month).filter(|of| *of != all.of_month),
            kind: days.kind,
            weather: days.weather,
            episode: days.episode,
            poor_nights: days.poor_nights,
        }
    }
}

impl From<DayNames> for DaySelection {
    fn from(names: DayNames) -> DaySelection {
        let all = DaySelection::ALL;
        let weekdays = names.weekdays.iter().fold(0, |bits, day| bits | 1 << *day as u8);
        let months = names.months.iter().fold(0, |bits, month| bits | 1 << *month as u16);
        DaySelection {
            weekdays: if weekdays == 0 { all.weekdays } else { weekdays },
            months: if months == 0 { all.months } else { months },
            every: names.every.unwrap_or(all.every),
            of_month: names.of_month.unwrap_or(all.of_month),
            kind: names.kind,
            weather: names.weather,
            episode: names.episode,
            poor_nights: names.poor_nights,
        }
    }
}

/// The weather of a day.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Weather {
    Dry,
    /// With rain or snow.
    Rainy,
    /// With a high of 32 °C or more.
    Hot,
    /// With a low of 0 °C or less.
    Frosty,
}

impl Weather {
    pub(crate) fn word(self) -> &'static str {
        match self {
            Weather::Dry => "dry",
            Weather::Rainy => "rainy",
            Weather::Hot => "hot",
            Weather::Frosty => "frosty",
        }
    }
}

/// Days in a row that begin at random.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DayEpisode {
    /// Mean number of days from one beginning to the next.
    pub every_days: u32,
    /// Length in days.
    pub lasts_days: u32,
}

/// The activity level of a day relative to others.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum DayKind {
    Quiet,
    Busy,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum PartOfDay {
    Morning,
    Noon,
    Afternoon,
    Evening,
    Night,
    Day,
}

/// The course of a change: start, growth, end.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Phase {
    /// `None` from the beginning.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub from: Option<PhaseDay>,
    /// Days from the start to full strength.
    #[serde(skip_serializing_if = "super::is_usual")]
    pub over_days: f64,
    /// The first day without it, or on which it begins to fade.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub until: Option<PhaseDay>,
    /// Days from `until` to zero strength.
    #[serde(skip_serializing_if = "super::is_usual")]
    pub fading_days: f64,
}

/// A day: "day 40" of the run, which begins with day 1, or a date such as "2009-05-01".
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(into = "String", try_from = "String")]
#[schemars(with = "String")]
pub enum PhaseDay {
    /// Since the first, which is 0.
    Day(i32),
    /// Year, month and day.
    Date(i16, u8, u8),
}

impl DaySelection {
    /// `of_month` of the last seven days of the month.
    pub const LAST_WEEK: (u8, u8) = (0, 7);

    pub const ALL: DaySelection = DaySelection {
        weekdays: 0x7f,
        months: 0xfff,
        every: 1,
        of_month: (1, 31),
        kind: None,
        weather: None,
        episode: None,
        poor_nights: 0,
    };

    /// Whether the date of a day of the run is selected. All sentences count weeks from the same Monday, so that every other
    /// Saturday and every other Sunday are one weekend.
    pub fn has_date(&self, calendar: &Calendar, day: i32) -> bool {
        let (_, month, day_of_month) = calendar.date(day);
        let counted = match self.weekdays.is_power_of_two() {
            true => (day + i32::from(calendar.weekday(0))).div_euclid(7),
            false => day,
        };
        self.weekdays >> calendar.weekday(day) & 1 == 1
            && self.months >> (month - 1) & 1 == 1
            && counted.rem_euclid(self.every.max(1) as i32) == 0
            && match self.of_month {
                DaySelection::LAST_WEEK => calendar.date(day + 7).1 != month,
                (first, last) => (first..=last).contains(&day_of_month),
            }
    }
}

impl PhaseDay {
    /// The run's first day is 0.
    pub fn of_run(self, calendar: &Calendar) -> i32 {
        match self {
            PhaseDay::Day(day) => day,
            PhaseDay::Date(year, month, day) => calendar.day_of(year, month, day).unwrap_or(i32::MAX),
        }
    }
}

impl Phase {
    /// Whether it has begun, and is not over, on a day of the run.
    pub fn has_day(&self, calendar: &Calendar, day: i32) -> bool {
        let day_of = |moment: PhaseDay| f64::from(moment.of_run(calendar));
        let day = f64::from(day);
        self.from.is_none_or(|from| day_of(from) <= day)
            && self.until.is_none_or(|until| day < day_of(until) + self.fading_days)
    }
}

impl From<PhaseDay> for String {
    fn from(day: PhaseDay) -> String {
        match day {
            PhaseDay::Day(day) => format!("day {}", i64::from(day) + 1),
            PhaseDay::Date(year, month, day) => format!("{year:04}-{month:02}-{day:02}"),
        }
    }
}

impl TryFrom<String> for PhaseDay {
    type Error = String;

    fn try_from(text: String) -> Result<PhaseDay, String> {
        let day = text.strip_prefix("day ").and_then(|day| day.parse::<i32>().ok()).filter(|day| *day >= 1);
        let mut parts = text.splitn(3, '-');
        let date = (|| {
            let year = parts.next()?.parse().ok()?;
            Some(PhaseDay::Date(year, parts.next()?.parse().ok()?, parts.next()?.parse().ok()?))
        })();
        day.map(|day| PhaseDay::Day(day - 1))
            .or(date)
            .ok_or_else(|| format!("{text:?} is not a day; write \"day 40\" or a date such as \"2009-05-01\""))
    }
}
