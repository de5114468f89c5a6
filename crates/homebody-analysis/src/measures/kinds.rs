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
        /// All measures. Those of a night are of the one that ends on the day; figures without a source are our choice.
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
        "Hours in bed in the night: from going to bed to getting up, without the time in other rooms. From the bed's sensor, or else from stays in the bedroom with a silence of 20 min or more",
        "Rantz et al. 2015, time in bed; the rule for motion sensors is our choice";
    bedtime ("h of day", "To bed at")
        "Beginning of the night, in hours of the day before: 24.5 is half past midnight",
        "our definition";
    rising ("h of day", "Up at")
        "End of the night, in hours of the day",
        "our definition";
    sleep ("h", "Sleep")
        "Hours of the time in bed in stretches of 5 min or more without movement in the bedroom",
        "sleep scoring by rest in actigraphy; the 5 min are our choice";
    restlessness ("bouts/h", "Restlessness")
        "Bouts of movement in bed per hour in bed; movements more than 30 s apart are two bouts",
        "Rantz et al. 2015, bed restlessness; the definition of a bout is our choice";
    bathroom_night ("visits", "Bathroom by night")
        "Stays in the bathroom of 20 s or more between going to bed and getting up; gaps of up to 60 s do not end a stay. If several sensors see a person at once, the room of most of them counts",
        "Rantz et al. 2015, bathroom activity";
    bathroom_day ("visits", "Bathroom by day")
        "Stays in the bathroom of 20 s or more on the day, without those of the night; gaps of up to 60 s do not end a stay",
        "Rantz et al. 2015, bathroom activity";
    showers ("times", "Showers")
        "With a sensor at the shower: spans of its movements of 3 min or more. Otherwise an estimate, if a motion sensor sees the bathroom: stays there by day of 10 min or more with a sign of presence every minute",
        "our definition";
    meals ("times", "Meals")
        "Periods around the kitchen with 15 min or more in it; gaps of up to 15 min do not end a period",
        "our definition";
    time_out ("h", "Out")
        "Hours of the day in which the home is empty, as far as known at the end of the day",
        "Wang and Skubic 2008, time away from home";
    outings ("times", "Outings")
        "Absences of half an hour or more, counted on the day on which the half hour ended",
        "Wang and Skubic 2008, time away from home";
    room_changes ("times", "Room changes")
        "Changes from one room to another on the day",
        "Petersen et al. 2014, room transitions";
    pace ("of usual", "Walking pace")
        "Median of the relative pace over the day's walks between sensors: the usual time of a walk, which is the median of the earlier times (the first 100 at most), divided by its time",
        "Hagler et al. 2010, walking speed by sensors in a line; relative times are our choice";
    pace_slow ("of usual", "Slowest walks")
        "Relative pace that the slowest tenth of the day's walks between sensors does not exceed; the usual time of a walk is that of pace",
        "Hagler et al. 2010, the distribution of walking speeds";
    walking_speed ("m/s", "Walking speed")
        "Median speed of the day's walks between sensors, by the length of the walkable path in the home; not known without a home",
        "Hagler et al. 2010, walking speed by sensors in a line; paths of a home in place of a line are our choice";
    walking_speed_slow ("m/s", "Slow walks")
        "10th percentile of the speed of the day's walks between sensors, by the length of the path in the home",
        "Hagler et al. 2010, the distribution of walking speeds";
    walking_speed_fast ("m/s", "Fast walks")
        "90th percentile of the speed of the day's walks between sensors, by the length of the path in the home",
        "Hagler et al. 2010, the distribution of walking speeds";
    company ("h", "Company")
        "Estimate of the hours of the day with another person besides the resident: between two uses of the front door's contact, 10 min to 5 h apart, with a person at home before and after, and with 1.3 times or more the usual signs of presence of the 28 days up to the day",
        "Petersen et al. 2012, visitors by sensors; the rule is our choice";
    visits ("times", "Visitors")
        "Estimate of the arrivals of other people on the day: see company",
        "Petersen et al. 2012, visitors by sensors; the rule is our choice";
    pacing ("times", "Pacing")
        "Walks back and forth between two rooms, three times or more, without a stay of over a minute",
        "Martino-Saltzman et al. 1991; the three times are our choice";
    lapping ("times", "Lapping")
        "Walks round three rooms or more, three times or more, without a stay of over a minute",
        "Martino-Saltzman et al. 1991; the three times are our choice";
    sedentary ("h", "Sitting")
        "Hours of the day in stays of 30 min or more in one room, outside the bed of the night",
        "our definition, after the 30-min bouts of sedentary time in actigraphy";
    density_night ("firings/h", "Density 0-6")
        "Firings of motion sensors per hour at home, from midnight to 06:00",
        "Wang and Skubic 2008";
    density_morning ("firings/h", "Density 6-12")
        "Firings of motion sensors per hour at home, from 06:00 to noon",
        "Wang and Skubic 2008";
    density_afternoon ("firings/h", "Density 12-18")
        "Firings of motion sensors per hour at home, from noon to 18:00",
        "Wang and Skubic 2008";
    density_evening ("firings/h", "Density 18-24")
        "Firings of motion sensors per hour at home, from 18:00 to midnight",
        "Wang and Skubic 2008";
    density_distance ("0-2.24", "Density distance")
        "Distance between the density map of the seven days that end with the day and that of the seven days before; the first 14 whole days of the log set the height of the levels",
        "Wang and Skubic 2008, dissimilarity of density maps";
    interdaily_stability ("0-1", "Evenness of days")
        "Variance of the mean firings per hour of day, divided by the variance of all hours, over the seven days that end with the day",
        "Witting et al. 1990, interdaily stability";
    intradaily_variability ("ratio", "Fragmentation")
        "Mean squared difference of firings between consecutive hours, divided by the variance of all hours, over the seven days that end with the day",
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
