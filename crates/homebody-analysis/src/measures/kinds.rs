//! The measures: name, unit, definition and words of each, and the function that takes it from a day.

use super::of_day::OfDay;
use crate::dates::clock_of_hours;
use serde::Serialize;

/// A measure of a day.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Measure {
    /// Its name in tables and JSON.
    pub name: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// Its name in pictures and, with a small letter, in sentences.
    pub title: &'static str,
    /// How it is taken.
    pub definition: &'static str,
    /// The source of the definition.
    pub source: &'static str,
    /// `night` for a measure of the night that ends on the day, else `day`.
    #[serde(skip)]
    pub occasion: &'static str,
    /// A higher value in words, such as `more sleep`.
    #[serde(skip)]
    pub more: &'static str,
    /// A lower value in words.
    #[serde(skip)]
    pub less: &'static str,
    /// The predicate of a sentence about the resident, with `{}` for the value; empty where values have no sentence.
    #[serde(skip)]
    pub did: &'static str,
    /// The same for the value 0, if it has words of its own.
    #[serde(skip)]
    pub did_not: &'static str,
    /// Its value on a day; `None` where it is not known.
    #[serde(skip)]
    pub of: fn(&OfDay) -> Option<f64>,
}

/// How sentences write the values of a measure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// Hours.
    Hours,
    /// A time of day, in hours since midnight: 24.5 is half past midnight.
    Clock,
    /// A count.
    Times,
    /// Multiples of the usual value.
    OfUsual,
    /// Metres a second.
    MetresASecond,
    /// Any other amount: sentences give the difference in per cent.
    Amount,
}

macro_rules! measures {
    ($($name:ident ($unit:literal, $title:literal) $definition:literal, $source:literal,
        $occasion:ident: $more:literal, $less:literal $(; $did:literal $($did_not:literal)?)?;)*) => {
        /// All measures. Those of a night are of the one that ends on the day; figures without a source are our choice.
        pub static MEASURES: &[Measure] = &[$(Measure {
            name: stringify!($name),
            unit: $unit,
            title: $title,
            definition: $definition,
            source: $source,
            occasion: stringify!($occasion),
            more: $more,
            less: $less,
            did: concat!($($did)?),
            did_not: concat!($($($did_not)?)?),
            of: |day| day.$name(),
        }),*];
    };
}

measures! {
    time_in_bed ("h", "Time in bed")
        "Hours in bed in the night: from going to bed to getting up, without the time in other rooms. Taken from the bed sensor. Without one, taken from stays in the bedroom with 20 min or more without events",
        "Rantz et al. 2015, time in bed; the rule for motion sensors is our choice",
        night: "more time in bed", "less time in bed"; "was in bed {}";
    bedtime ("h of day", "Bedtime")
        "Beginning of the night, in hours of the day before: 24.5 is half past midnight",
        "our definition",
        night: "a later bedtime", "an earlier bedtime"; "went to bed {}";
    rising ("h of day", "Getting up")
        "End of the night, in hours of the day",
        "our definition",
        day: "getting up later", "getting up earlier"; "got up {}";
    sleep ("h", "Sleep")
        "Hours in bed without movement in the bedroom, counting only stretches of 5 min or more",
        "sleep scoring by rest in actigraphy; the 5 min are our choice",
        night: "more sleep", "less sleep"; "slept {}";
    restlessness ("bouts/h", "Restlessness in bed")
        "Bouts of movement in bed per hour in bed; movements more than 30 s apart are two bouts",
        "Rantz et al. 2015, bed restlessness; the definition of a bout is our choice",
        night: "more restless in bed", "less restless in bed";
    bathroom_night ("visits", "Bathroom visits at night")
        "Stays in the bathroom of 20 s or more between going to bed and getting up; gaps of up to 60 s do not end a stay. If several sensors see a person at once, the person counts as in the room with most of these sensors",
        "Rantz et al. 2015, bathroom activity",
        night: "more bathroom visits at night", "fewer bathroom visits at night"; "got up for the bathroom {}" "did not get up for the bathroom";
    bathroom_day ("visits", "Bathroom visits by day")
        "Stays in the bathroom of 20 s or more on the day, without those of the night; gaps of up to 60 s do not end a stay",
        "Rantz et al. 2015, bathroom activity",
        day: "more bathroom visits by day", "fewer bathroom visits by day"; "used the bathroom {} by day" "did not use the bathroom by day";
    showers ("times", "Showers")
        "With a sensor at the shower: periods of 3 min or more in which it reports movement. Otherwise an estimate, which needs a motion sensor in the bathroom: daytime stays of 10 min or more with a sign of presence in every minute",
        "our definition",
        day: "more showers", "fewer showers"; "showered {}" "did not shower";
    meals ("times", "Kitchen meals")
        "Periods with 15 min or more in the kitchen; times outside it of up to 15 min do not end a period",
        "our definition",
        day: "more kitchen meals", "fewer kitchen meals"; "had a meal in the kitchen {}" "had no meal in the kitchen";
    time_out ("h", "Time out of the home")
        "Hours of the day in which the home is empty, computed from the rows up to the end of the day",
        "Wang and Skubic 2008, time away from home",
        day: "more time out of the home", "less time out of the home"; "was out {}" "did not go out";
    outings ("times", "Outings")
        "Absences of half an hour or more. An absence counts on the day on which its first half hour ends",
        "Wang and Skubic 2008, time away from home",
        day: "more outings", "fewer outings"; "went out {}" "did not go out";
    room_changes ("times", "Room changes")
        "Changes from one room to another on the day",
        "Petersen et al. 2014, room transitions",
        day: "moving about more at home", "moving about less at home";
    pace ("of usual", "Walking pace")
        "Median relative pace of the day's walks between sensors. The relative pace of a walk is its usual time (the median of up to 100 earlier times) divided by its actual time",
        "Hagler et al. 2010, walking speed by sensors in a line; relative times are our choice",
        day: "walking faster", "walking more slowly";
    pace_slow ("of usual", "Pace of the slowest walks")
        "10th percentile of the relative pace of the day's walks between sensors (see pace)",
        "Hagler et al. 2010, the distribution of walking speeds",
        day: "a faster pace on the slowest walks", "a slower pace on the slowest walks";
    walking_speed ("m/s", "Walking speed")
        "Median speed of the day's walks between sensors, by the length of the walkable path in the home; not known without a home",
        "Hagler et al. 2010, walking speed by sensors in a line; paths of a home in place of a line are our choice",
        day: "walking faster", "walking more slowly"; "walked {}";
    walking_speed_slow ("m/s", "Speed of slow walks")
        "10th percentile of the speed of the day's walks between sensors, by the length of the path in the home",
        "Hagler et al. 2010, the distribution of walking speeds",
        day: "faster slow walks", "slower slow walks";
    walking_speed_fast ("m/s", "Speed of fast walks")
        "90th percentile of the speed of the day's walks between sensors, by the length of the path in the home",
        "Hagler et al. 2010, the distribution of walking speeds",
        day: "faster fast walks", "slower fast walks";
    company ("h", "Time with visitors")
        "Estimate of the hours of the day with a visitor. A visit lies between two uses of the front door's contact, 10 min to 5 h apart. A person is at home before and after it, and the signs of presence are at least 1.3 times the median of the last 28 days",
        "Petersen et al. 2012, visitors by sensors; the rule is our choice",
        day: "more time with visitors", "less time with visitors"; "had visitors {}" "had no visitors";
    visits ("times", "Visitors")
        "Estimate of the arrivals of other people on the day: see company",
        "Petersen et al. 2012, visitors by sensors; the rule is our choice",
        day: "more visitors", "fewer visitors";
    pacing ("times", "Pacing")
        "Walks back and forth between two rooms, three times or more, without a stay of over a minute",
        "Martino-Saltzman et al. 1991; the threshold of three is our choice",
        day: "more pacing to and fro", "less pacing to and fro";
    lapping ("times", "Lapping")
        "Walks round three rooms or more, three times or more, without a stay of over a minute",
        "Martino-Saltzman et al. 1991; the threshold of three is our choice",
        day: "more walking in circles", "less walking in circles";
    sedentary ("h", "Sitting and resting")
        "Hours of the day in stays of 30 min or more in one room, without the night in bed",
        "our definition, after the 30-min bouts of sedentary time in actigraphy",
        day: "more sitting and resting by day", "less sitting and resting by day"; "sat or rested {} by day";
    density_night ("firings/h", "Movement at night")
        "Firings of motion sensors per hour at home, from midnight to 06:00",
        "Wang and Skubic 2008",
        night: "more movement at night", "less movement at night";
    density_morning ("firings/h", "Movement in the morning")
        "Firings of motion sensors per hour at home, from 06:00 to noon",
        "Wang and Skubic 2008",
        day: "more movement in the morning", "less movement in the morning";
    density_afternoon ("firings/h", "Movement in the afternoon")
        "Firings of motion sensors per hour at home, from noon to 18:00",
        "Wang and Skubic 2008",
        day: "more movement in the afternoon", "less movement in the afternoon";
    density_evening ("firings/h", "Movement in the evening")
        "Firings of motion sensors per hour at home, from 18:00 to midnight",
        "Wang and Skubic 2008",
        day: "more movement in the evening", "less movement in the evening";
    density_distance ("0-2.24", "Change of daily pattern")
        "Distance between the density map of the seven days that end with the day and that of the seven days before; the eight colour levels of the map follow from the first 14 whole days of the log",
        "Wang and Skubic 2008, dissimilarity of density maps",
        day: "more change in the daily pattern", "less change in the daily pattern";
    interdaily_stability ("0-1", "Regularity of days")
        "Variance of the mean firings per hour of day, divided by the variance of all hours, over the seven days that end with the day",
        "Witting et al. 1990, interdaily stability",
        day: "more regular days", "less regular days";
    intradaily_variability ("ratio", "Fragmentation of days")
        "Mean squared difference of firings between consecutive hours, divided by the variance of all hours, over the seven days that end with the day",
        "Witting et al. 1990, intradaily variability",
        day: "more fragmented days", "less fragmented days";
}

impl Measure {
    /// The measure of this name.
    pub fn named(name: &str) -> Option<&'static Measure> {
        MEASURES.iter().find(|measure| measure.name == name)
    }

    /// How sentences write its values.
    pub fn kind(&self) -> Unit {
        match self.unit {
            "h" => Unit::Hours,
            "h of day" => Unit::Clock,
            "visits" | "times" => Unit::Times,
            "of usual" => Unit::OfUsual,
            "m/s" => Unit::MetresASecond,
            _ => Unit::Amount,
        }
    }

    /// Whether its values are times of day, in hours since midnight.
    pub fn is_clock(&self) -> bool {
        self.kind() == Unit::Clock
    }

    /// A value with its unit, or as the time of day that it is.
    pub fn told(&self, value: f64, decimals: usize) -> String {
        if self.is_clock() { clock_of_hours(value) } else { format!("{value:.decimals$} {}", self.unit) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_measures_and_the_usual_rules_are_in_the_documents() {
        let document = include_str!("../../../../docs/reference/measures.md");
        for Measure { name, unit, definition, source, .. } in MEASURES {
            let row = format!("| `{name}` | {unit} | {definition} | {source} |");
            assert!(document.contains(&row), "docs/reference/measures.md lacks this row:\n{row}");
        }
        let rules = crate::alerts::USUAL.trim();
        assert!(document.contains(rules), "docs/reference/measures.md lacks the usual rules as they are:\n{rules}");
    }
}
