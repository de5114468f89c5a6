//! The subjects of claims, their days and hours, and the reading of numbers.

#[derive(Clone, Debug, PartialEq)]
pub enum Subject {
    /// An activity, by its label.
    Activity(String),
    /// A door, a piece of furniture or a lamp, while it is open or on.
    Thing(String),
    Room(String),
    Lamps,
    /// A value of a sensor, such as `OPEN`.
    Says(String),
    Metres,
    /// Of long strides.
    Pace,
    /// Of all strides.
    Speed,
    /// Seconds of movement in bed an hour asleep.
    Turning,
    Severity(String),
    Firings,
}

pub type Range = (f64, f64);

#[derive(Clone, Debug, Default, PartialEq)]
pub struct Filter {
    /// The first and the last day, counted from 1.
    pub days: Option<(i32, i32)>,
    /// Bit 0 is Monday.
    pub weekdays: Option<u8>,
    pub every: Option<i32>,
    /// Starts between these minutes of the day; the second may be of the next day.
    pub between: Option<Range>,
    pub at_least: Option<f64>,
}

pub const WEEKDAYS: [&str; 7] = ["Monday", "Tuesday", "Wednesday", "Thursday", "Friday", "Saturday", "Sunday"];

impl Subject {
    pub fn read(text: &str) -> Subject {
        match text.split_once(' ').unwrap_or((text, "")) {
            ("room", name) => Subject::Room(name.to_owned()),
            ("thing", name) => Subject::Thing(name.to_owned()),
            ("says", value) => Subject::Says(value.to_owned()),
            ("severity", name) => Subject::Severity(name.to_owned()),
            ("lamps", "") => Subject::Lamps,
            ("metres", "") => Subject::Metres,
            ("pace", "") => Subject::Pace,
            ("speed", "") => Subject::Speed,
            ("turning", "") => Subject::Turning,
            ("firings", "") => Subject::Firings,
            _ => Subject::Activity(text.to_owned()),
        }
    }
}

impl Filter {
    pub fn read(text: &str) -> Result<(&str, Filter), String> {
        let mut filter = Filter::default();
        let mut rest = text;
        loop {
            let Some((before, said)) = rest.rsplit_once(" | ") else { return Ok((rest, filter)) };
            rest = before;
            let words: Vec<&str> = said.split(' ').collect();
            match *words {
                ["days", span] => {
                    let (from, to) = range(span)?;
                    filter.days = Some((from as i32, to as i32));
                }
                ["every", every] => filter.every = Some(number(every)? as i32),
                ["from", clocks] => filter.between = Some(clock_range(clocks).ok_or("no times of day")?),
                ["over", minutes, "min"] => filter.at_least = Some(number(minutes)?),
                ["not", ..] => filter.weekdays = Some(!weekdays(&words[1..])? & 0x7F),
                _ => filter.weekdays = Some(weekdays(&words)?),
            }
        }
    }

    pub fn is_day(&self, day: i32, weekday: u8) -> bool {
        self.days.is_none_or(|(from, to)| (from - 1..to).contains(&day))
            && self.weekdays.is_none_or(|days| days >> weekday & 1 == 1)
            && self.every.is_none_or(|every| day % every == 0)
    }
}

fn weekdays(words: &[&str]) -> Result<u8, String> {
    let bit = |name: &&str| {
        WEEKDAYS.iter().position(|day| day == name).map(|at| 1 << at).ok_or(format!("there is no filter {name:?}"))
    };
    words.iter().map(bit).try_fold(0, |all, bit| Ok(all | bit?))
}

pub fn number(text: &str) -> Result<f64, String> {
    text.parse().map_err(|_| format!("{text:?} is no number"))
}

pub fn range(text: &str) -> Result<Range, String> {
    match text.split_once("..") {
        Some((from, to)) => Ok((number(from)?, number(to)?)),
        None => Ok((number(text)?, number(text)?)),
    }
}

pub fn scaled(text: &str, unit: &str) -> Result<Range, String> {
    let (from, to) = range(text)?;
    let minutes = match unit {
        "min" => 1.0,
        "h" => 60.0,
        "days" => 1440.0,
        _ => return Err(format!("there is no unit {unit:?}")),
    };
    Ok((from * minutes, to * minutes))
}

/// A range of times of day in minutes; a smaller end is on the next day.
pub fn clock_range(text: &str) -> Option<Range> {
    let clock = |text: &str| {
        let (hours, minutes) = text.split_once(':')?;
        Some(hours.parse::<f64>().ok()? * 60.0 + minutes.parse::<f64>().ok()?)
    };
    let (from, to) = text.split_once("..").map(|(from, to)| (clock(from), clock(to)))?;
    let (from, to) = (from?, to?);
    Some((from, if to < from { to + 1440.0 } else { to }))
}
