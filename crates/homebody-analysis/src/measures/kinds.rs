//! The measures: what each is, in which unit, by which definition, and how it is taken from a day.

use super::of_day::OfDay;
use crate::dates::clock_of_hours;
use serde::Serialize;

/// The unit of times of day: hours since midnight, in which 24.5 is half past midnight.
const CLOCK: &str = "h of day";

/// A measure of a day.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Measure {
    /// What it is called in tables and JSON.
    pub name: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// What it is called in a picture.
    pub title: &'static str,
    /// How it is taken.
    pub definition: &'static str,
    /// Where the definition is from.
    pub source: &'static str,
    /// Its value on a day; `None` where it is not known.
    #[serde(skip)]
    pub of: fn(&OfDay) -> Option<f64>,
}

macro_rules! measures {
    ($($name:ident ($unit:literal, $title:literal) $definition:literal, $source:literal;)*) => {
        /// All measures. Those of a night are of the one that ends on the day; numbers without a source are ours.
        pub static MEASURES: &[Measure] = &[$(Measure {
            name: stringify!($name),
            unit: $unit,
            title: $title,
            definition: $definition,
            source: $source,
            of: |day| day.$name(),
        }),*];
    };
}

measures! {
    time_in_bed ("h", "Time in bed")
        "Hours in bed in the night: by the bed's sensor, or else in stays in the bedroom that have a silence of 20 min and more, from coming to bed to leaving it, without the times in other rooms",
        "Rantz et al. 2015, time in bed; the rule for motion sensors is ours";
    bedtime ("h of day", "To bed at")
        "When the night begins, in hours of the day before: 24.5 is half past midnight", "ours";
    rising ("h of day", "Up at")
        "When the night ends, in hours of the day", "ours";
    sleep ("h", "Sleep")
        "Hours of the time in bed that lie in stretches of 5 min and more without a movement in the bedroom",
        "actigraphy's scoring of sleep by rest; the 5 min are ours";
    restlessness ("bouts/h", "Restlessness")
        "Bouts of movement in bed an hour in bed; movements more than 30 s apart are two bouts",
        "Rantz et al. 2015, bed restlessness; the bouts are ours";
    bathroom_night ("visits", "Bathroom by night")
        "Stays in the bathroom of 20 s and more between going to bed and getting up, with gaps of 60 s at most; whom several sensors see at once is in the room of most of them", "Rantz et al. 2015, bathroom activity";
    bathroom_day ("visits", "Bathroom by day")
        "Stays in the bathroom of 20 s and more on the day, but for those of the night, with gaps of 60 s at most", "Rantz et al. 2015, bathroom activity";
    showers ("times", "Showers")
        "Where the shower has a sensor, spans of its movements of 3 min and more; else, as a guess and where a motion sensor sees the bathroom, stays there of 10 min and more by day with a sign every minute",
        "ours";
    meals ("times", "Meals")
        "Times around the kitchen with 15 min and more in it, with gaps of 15 min at most", "ours";
    time_out ("h", "Out")
        "Hours of the day with nobody at home, as far as that is known when the day ends", "Wang and Skubic 2008, time away from home";
    outings ("times", "Outings")
        "How often somebody was out for half an hour, each time on the day on which the half hour was over", "Wang and Skubic 2008, time away from home";
    room_changes ("times", "Room changes")
        "How often somebody went from one room to another on the day", "Petersen et al. 2014, room transitions";
    pace ("of usual", "Walking pace")
        "The median over the day's ways from sensor to sensor of how fast each was gone, beside the median of the times before, of the first 100 at most",
        "Hagler et al. 2010, walking speed by sensors in a line; relative times are ours";
    pace_slow ("of usual", "Slowest walks")
        "How fast the slowest tenth of the day's ways from sensor to sensor was gone at most, beside the median of the times before, of the first 100 at most", "Hagler et al. 2010, the distribution of walking speeds";
    walking_speed ("m/s", "Walking speed")
        "The median speed of the day's walks from sensor to sensor, by how far it is between them on the ways of the home; without a home it is not known",
        "Hagler et al. 2010, walking speed by sensors in a line; ways of a home instead of a line are ours";
    walking_speed_slow ("m/s", "Slow walks")
        "The speed that a tenth of the day's walks from sensor to sensor do not reach, by the ways of the home", "Hagler et al. 2010, the distribution of walking speeds";
    walking_speed_fast ("m/s", "Fast walks")
        "The speed that a tenth of the day's walks from sensor to sensor exceed, by the ways of the home", "Hagler et al. 2010, the distribution of walking speeds";
    company ("h", "Company")
        "Hours of the day with somebody besides the resident, as a guess: from use to use of the front door's contact, of 10 min to 5 h, with somebody at home before and after, and 1.3 times the signs or more between that are usual of the 28 days up to the day",
        "Petersen et al. 2012, visitors by sensors; the rule is ours";
    visits ("times", "Visitors")
        "How often somebody besides the resident came on the day, as a guess: see company", "Petersen et al. 2012, visitors by sensors; the rule is ours";
    pacing ("times", "Pacing")
        "Ways back and forth between two rooms, three times and more, with no stay over a minute",
        "Martino-Saltzman et al. 1991; three times are ours";
    lapping ("times", "Lapping")
        "Ways round by three rooms and more, three times and more, with no stay over a minute",
        "Martino-Saltzman et al. 1991; three times are ours";
    sedentary ("h", "Sitting")
        "Hours of the day in stays of 30 min and more in one room, out of the bed of the night",
        "ours, after the 30-min bouts of sedentary time in actigraphy";
    density_night ("firings/h", "Density 0-6")
        "Firings of motion sensors an hour at home, from midnight to 06:00", "Wang and Skubic 2008";
    density_morning ("firings/h", "Density 6-12")
        "Firings of motion sensors an hour at home, from 06:00 to noon", "Wang and Skubic 2008";
    density_afternoon ("firings/h", "Density 12-18")
        "Firings of motion sensors an hour at home, from noon to 18:00", "Wang and Skubic 2008";
    density_evening ("firings/h", "Density 18-24")
        "Firings of motion sensors an hour at home, from 18:00 to midnight", "Wang and Skubic 2008";
    density_distance ("0-2.24", "Density distance")
        "How far the density map of the seven days that end with the day is from that of the seven before, in levels as high as the first 14 whole days of the log make them", "Wang and Skubic 2008, dissimilarity of density maps";
    interdaily_stability ("0-1", "Evenness of days")
        "The variance of the mean firings by hour of day beside that of all hours, over the seven days that end with the day",
        "Witting et al. 1990, interdaily stability";
    intradaily_variability ("ratio", "Fragmentation")
        "The mean squared difference of firings from hour to hour beside the variance of all hours, over the seven days that end with the day",
        "Witting et al. 1990, intradaily variability";
}

impl Measure {
    /// The measure of this name.
    pub fn named(name: &str) -> Option<&'static Measure> {
        MEASURES.iter().find(|measure| measure.name == name)
    }

    /// Whether its values are times of day, in hours since midnight.
    pub fn is_clock(&self) -> bool {
        self.unit == CLOCK
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
