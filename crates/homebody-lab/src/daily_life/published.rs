//! Published figures of older adults at home and of the sensors there, with the derivation of ours.
//!
//! A range is that of the source, or follows from the rules of the module above: half a standard deviation to each side of a mean, 15 %
//! of a number, half of a spread.

use super::PersonFigures;
use homebody_core::activity::TimeUse;

#[derive(Clone, Copy)]
pub struct PublishedFigure {
    pub of: &'static str,
    pub what: &'static str,
    pub unit: &'static str,
    pub says: &'static str,
    pub source: &'static str,
    pub range: Option<[f64; 2]>,
    pub guess: &'static str,
    pub figure: FigureSource,
}

#[derive(Clone, Copy)]
pub enum FigureSource {
    Mean(fn(&PersonFigures) -> Option<f64>),
    Spread(fn(&PersonFigures) -> Option<f64>),
    Whole(fn(&[PersonFigures]) -> Option<f64>),
}

use FigureSource::{Mean, Spread, Whole};

/// The columns of the table: group, name, unit, published value, source, range, figure, and reason for a difference.
macro_rules! lines {
    ($($of:expr, $what:expr, $unit:expr, $says:expr, $source:expr, $range:expr, $figure:expr, $guess:expr;)*) => {
        [$(PublishedFigure {
            of: $of, what: $what, unit: $unit, says: $says, source: $source, range: $range, figure: $figure, guess: $guess,
        }),*]
    };
}

const SLEEP: &str = "sleep";
const TOILET: &str = "toilet";
const DAY: &str = "the day";
const WAYS: &str = "ways";
const SENSORS: &str = "sensors";

const CLOCK: &str = "actigraphs of healthy older adults, Scientific Reports 2015";
const PSG: &str = "polysomnography at 73.9 years";
const ACTIGRAPH: &str = "actigraphs at 62-90 years, US";
const THUMB: &str = "a rule of thumb; no norm found";
const NONE: &str = "no norm found";
const NOCTURIA: &str = "surveys of 60 years and more";
const NOCTURIA_FIT: &str = "Poisson fit to surveys of 60 years and more";
const ATUS: &str = "American Time Use Survey, 75 and more";
const ATUS_2013: &str = "American Time Use Survey 2013, 75 and more";
const NAPS: &str = "survey of naps by age, 75-84 years";
const KAYE: &str = "Kaye 2012, 76 homes, mean age 86";
const STANDS: &str = "healthy older adults in the community";
const CASAS: &str = "CASAS homes of one older adult";
const BOSCH: &str = "a CASAS home with Bosch units";

const NO_GUESS: &str = "";
const SAME_HOLD: &str = "the hold is the same for every ON";
const LONG_GAPS: &str = "whoever rises 46 times a day sits down as often and is then hardly seen: that makes long gaps, and units that fire \
    again after 5 to 9 s make fewer short ones beside them than Control4 units, which do after 2 s";
const DIARY: &str = "diaries give whole stretches to one thing; what ours do outside the home has no name";

pub const LINES: [PublishedFigure; 52] = lines! {
    SLEEP, "time in bed", "h", "7.65 (SD 1.03)", PSG, Some([7.13, 8.17]), Mean(|p| p.nights.in_bed_h),
        "the clock times of getting up and going to bed come from another source than the time in bed";
    SLEEP, "to bed", "clock", "23:23 (SEM 10 min)", CLOCK, Some([23.05, 23.72]), Mean(|p| p.nights.to_bed_h),
        "going to bed waits for what is under way";
    SLEEP, "to bed, day to day", "min", "25-45", THUMB,
        Some([25.0, 45.0]), Mean(|p| Some(p.nights.to_bed_sd_h? * 60.0)),
        "how much clock times vary is ours";
    SLEEP, "to bed, between people", "min", "60-75", THUMB,
        Some([60.0, 75.0]), Spread(|p| Some(p.nights.to_bed_h? * 60.0)),
        "how much people differ is ours";
    SLEEP, "up", "clock", "06:44 (SEM 10 min)", CLOCK, Some([6.4, 7.07]), Mean(|p| p.nights.up_h),
        "getting up waits for a visit to the toilet";
    SLEEP, "up, day to day", "min", "25-45", THUMB, Some([25.0, 45.0]), Mean(|p| Some(p.nights.up_sd_h? * 60.0)),
        "how much clock times vary is ours";
    SLEEP, "up, between people", "min", "60-75", THUMB, Some([60.0, 75.0]), Spread(|p| Some(p.nights.up_h? * 60.0)),
        "how much people differ is ours";
    SLEEP, "asleep", "h", "6.2 (PSG) - 7.2 (actigraph)", "polysomnography at 73.9 years; actigraphs at 62-90",
        Some([6.2, 7.2]), Mean(|p| p.nights.asleep_h),
        "time in bed less time awake leaves no more";
    SLEEP, "asleep, between people", "h", "SD 1.1", ACTIGRAPH, Some([0.73, 1.65]), Spread(|p| p.nights.asleep_h),
        "people differ in when they get up and go to bed, not in how much sleep they need";
    SLEEP, "falling asleep", "min", "19.7 (SD 11.0)", PSG, Some([14.2, 25.2]), Mean(|p| p.nights.latency_min),
        "it is drawn as published, but who goes to the toilet meanwhile falls asleep later";
    SLEEP, "awake after that", "min", "39 (actigraph) - 68 (PSG)", "actigraphs at 62-90 years; polysomnography at 73.9",
        Some([39.0, 68.0]), Mean(|p| p.nights.awake_min),
        "trips to the toilet come on top of lying awake";
    TOILET, "trips a night", "", "1.7", NOCTURIA_FIT, Some([1.45, 1.96]), Mean(|p| p.nights.trips),
        "a need that is met late in the night does not press again before morning";
    TOILET, "nights with a trip", "%", "82-85 of people", NOCTURIA,
        Some([79.0, 88.0]), Mean(|p| percent(p.nights.any_trip?)),
        "surveys count people who usually get up, we count nights";
    TOILET, "nights with two", "%", "44-56 of people", NOCTURIA,
        Some([44.0, 56.0]), Mean(|p| percent(p.nights.two_trips?)),
        "surveys count people who usually get up twice, we count nights";
    TOILET, "visits a day", "", "5.0", "daytime voids at 70 and more, Baltimore study",
        Some([4.25, 5.75]), Mean(|p| Some(p.days.toilet)),
        "nobody visits the toilet at home while out";
    TOILET, "length by day", "min", "-", NONE, None, Mean(|p| p.days.toilet_min), NO_GUESS;
    TOILET, "length by night", "min", "-", NONE, None, Mean(|p| p.nights.trip_min), NO_GUESS;
    DAY, "meals", "", "2.5", "three of 51.6 %, two of 33.5 %, 14.9 % irregular; 65-75 years",
        Some([2.1, 2.9]), Mean(|p| Some(p.days.meals)),
        "meals that are missed while out are missed for good";
    DAY, "eating, all told", "", "5.2", "eating occasions at 63 years",
        Some([4.4, 6.0]), Mean(|p| Some(p.days.occasions)),
        "snacks and drinks are counted that people do not tell of";
    DAY, "sleep and care", "h", "10.1", ATUS_2013,
        Some([8.6, 11.6]), Mean(|p| Some(hours(p, TimeUse::Sleep)? + hours(p, TimeUse::Care)?)),
        "diaries have longer nights than actigraphs, which our nights follow";
    DAY, "eating", "h", "1.5", ATUS_2013, Some([1.27, 1.73]), Mean(|p| hours(p, TimeUse::Eating)), DIARY;
    DAY, "household", "h", "2.2", ATUS_2013, Some([1.87, 2.53]), Mean(|p| hours(p, TimeUse::Household)), DIARY;
    DAY, "television", "h", "4.43", ATUS, Some([3.77, 5.1]), Mean(|p| hours(p, TimeUse::Television)), DIARY;
    DAY, "reading", "h", "0.62", ATUS, Some([0.53, 0.71]), Mean(|p| hours(p, TimeUse::Reading)), DIARY;
    DAY, "relaxing, thinking", "h", "0.65", ATUS, Some([0.55, 0.75]), Mean(|p| hours(p, TimeUse::Relaxing)),
        "it also fills the minutes between one thing and the next, which diaries round away";
    DAY, "socialising, phone", "h", "0.56", ATUS, Some([0.48, 0.64]), Mean(|p| hours(p, TimeUse::Company)),
        "much of it is done elsewhere, and who lives alone is visited as their routine says";
    DAY, "games, computer", "h", "0.48", ATUS, Some([0.41, 0.55]), Mean(|p| hours(p, TimeUse::Computer)), DIARY;
    DAY, "out of the home", "h", "3-5", THUMB, Some([3.0, 5.0]), Mean(|p| Some(p.days.away_h)),
        "how often people go out is ours, and at 80 and more it is less";
    DAY, "people who nap", "%", "25", NAPS, Some([21.0, 29.0]), Whole(nappers), "few people make a rough share";
    DAY, "peak of naps", "clock", "14:30-15:00", NAPS, Some([14.0, 15.5]), Whole(nap_peak),
        "tiredness presses a fixed time after getting up";
    WAYS, "room changes a day", "", "-", "reliable from day to day, but no norm found; a nursing home has 6.9 ways out of one's room",
        None, Mean(|p| Some(p.days.rooms)),
        NO_GUESS;
    WAYS, "passes of the hall a day", "", "101 (cognitively well)", "passes of a line of sensors",
        Some([86.0, 117.0]), Mean(|p| Some(p.days.hall)),
        "the line of that study hung where its homes are passed most; in this home living room, kitchen and dining chair are reached without the hall";
    WAYS, "walking speed", "m/s", "0.61 (SD 0.17)", KAYE, Some([0.525, 0.695]), Mean(|p| p.days.pace_mps),
        "long strides only are timed, as a line of sensors does";
    WAYS, "speed, between people", "m/s", "SD 0.17", KAYE, Some([0.11, 0.26]), Spread(|p| p.days.pace_mps),
        "how much people differ is bounded below and above";
    WAYS, "risings a day", "", "46-60", STANDS, Some([46.0, 60.0]), Mean(|p| Some(p.days.rises)),
        "ours sit through what they do";
    SENSORS, "ONs a day", "", "1000-1500", CASAS, Some([1000.0, 1500.0]), Mean(|p| Some(p.sensing.ons)),
        "how often a body that sits or lies stirs is ours";
    SENSORS, "ONs, day to day", "", "SD 150-520", CASAS, Some([150.0, 520.0]), Mean(|p| p.sensing.ons_sd),
        "how much days differ is ours";
    SENSORS, "ONs, next day", "", "correlation 0-0.26", CASAS, Some([0.0, 0.26]), Mean(|p| p.sensing.ons_next_day),
        "over few days a correlation is too low on average, by about one over their number; and ours have no better and worse weeks";
    SENSORS, "gap, median", "s", "3.7-6.0", CASAS, Some([3.7, 6.0]), Mean(|p| p.sensing.gaps_s[0]),
        "homes with Control4 units, which fire again after 2 s, make most of the published range; ours do after 5 to 9";
    SENSORS, "gap, 90 %", "s", "24-56", CASAS, Some([24.0, 56.0]), Mean(|p| p.sensing.gaps_s[1]), LONG_GAPS;
    SENSORS, "gap, 95 %", "s", "54-136", CASAS, Some([54.0, 136.0]), Mean(|p| p.sensing.gaps_s[2]), LONG_GAPS;
    SENSORS, "gap, 99 %", "s", "540-2640", CASAS, Some([540.0, 2640.0]), Mean(|p| p.sensing.gaps_s[3]), LONG_GAPS;
    SENSORS, "gaps over an hour", "%", "0.2-0.8", CASAS,
        Some([0.2, 0.8]), Mean(|p| percent(p.sensing.gaps_over_an_hour?)),
        "beside outings, real sensors miss whole stretches of sleep and sitting; ours see every one of the 10 and more movements an hour of sleep";
    SENSORS, "ON lasts, 5 %", "s", "3.8", BOSCH, Some([3.6, 4.0]), Mean(|p| p.sensing.on_s[0]), SAME_HOLD;
    SENSORS, "ON lasts, median", "s", "4.0", BOSCH, Some([3.8, 4.2]), Mean(|p| p.sensing.on_s[1]), SAME_HOLD;
    SENSORS, "ON lasts, 95 %", "s", "4.5", BOSCH, Some([4.0, 4.7]), Mean(|p| p.sensing.on_s[2]), SAME_HOLD;
    SENSORS, "ON to ON, 5 %", "s", "5.5", BOSCH, Some([5.2, 5.8]), Mean(|p| p.sensing.again_s[0]),
        "the wait before the next firing is ours";
    SENSORS, "ON to ON, 25 %", "s", "6.5", BOSCH, Some([5.5, 7.5]), Mean(|p| p.sensing.again_s[1]),
        "the wait before the next firing is ours";
    SENSORS, "ON to ON, median", "s", "8.8", BOSCH, Some([7.5, 10.1]), Mean(|p| p.sensing.again_s[2]),
        "the wait before the next firing is ours";
    SENSORS, "one sensor ON at once", "%", "78-81", CASAS, Some([78.0, 81.0]), Mean(|p| percent(p.sensing.at_once?[0])),
        "which areas overlap is ours";
    SENSORS, "two at once", "%", "17-18", CASAS, Some([17.0, 18.0]), Mean(|p| percent(p.sensing.at_once?[1])),
        "which areas overlap is ours, and whoever walks faster has more ON at once";
    SENSORS, "three and more at once", "%", "2-5", CASAS, Some([2.0, 5.0]), Mean(|p| percent(p.sensing.at_once?[2])),
        "few of our areas overlap three deep";
};

fn percent(share: f64) -> Option<f64> {
    Some(share * 100.0)
}

fn hours(person: &PersonFigures, of: TimeUse) -> Option<f64> {
    Some(person.days.hours[of as usize])
}

/// The share of people who nap on every other day at least: regular nappers (the bound is ours).
fn nappers(persons: &[PersonFigures]) -> Option<f64> {
    const REGULAR: f64 = 0.5;
    homebody_core::statistics::share(persons, |person| person.days.naps >= REGULAR).map(|share| share * 100.0)
}

/// The middle of the hour and a half in which most time is napped, all people taken together.
fn nap_peak(persons: &[PersonFigures]) -> Option<f64> {
    let napped = |slot: usize| persons.iter().map(|person| person.days.nap_half_hours[slot % 48]).sum::<f64>();
    let around = |slot: usize| napped(slot + 47) + napped(slot) + napped(slot + 1);
    let most = (0..48).map(around).enumerate().max_by(|a, b| a.1.total_cmp(&b.1))?;
    (most.1 > 0.0).then_some(most.0 as f64 / 2.0 + 0.25)
}
