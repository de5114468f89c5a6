//! The measures: one row for each, with everything that texts, alerts, summaries, the page and the Python package know of it.
//!
//! A new measure is a row here and a function of [`MeasuredDay`](super::MeasuredDay).

use super::measure::*;
use super::rooms::Purpose;
use homebody_core::activity::LAPPING;

/// All measures. Figures without a source are our choice.
pub static MEASURES: &[DailyMeasure] = &[
    DailyMeasure {
        name: "time_in_bed",
        unit: HOURS,
        title: "Time in bed",
        definition: "Hours in bed in the night: from going to bed to getting up, without the time in other rooms. Taken from the bed sensor. Without one, taken from stays in the bedroom with a silence of 5 min or more, if one of the stays of the night has a silence of 20 min or more",
        source: "Rantz et al. 2015, time in bed; the rule for motion sensors is our choice",
        more: "more time in bed",
        less: "less time in bed",
        did: "was in bed {}",
        needs: Needs::Room(Purpose::Bedroom),
        noted: Some(NoteMeaning::Bed),
        summary: Some(SummaryUse { rank: 4, subject: "night", range: Some((0.0, 16.0)) }),
        is_observed: true,
        group: MeasureGroup::Night,
        least_sd: 0.4,
        of: |day| day.time_in_bed(),
        ..NIGHT
    },
    DailyMeasure {
        name: "bedtime",
        unit: CLOCK,
        title: "Bedtime",
        definition: "Beginning of the night, in hours of the day before: 24.5 is half past midnight",
        source: "our definition",
        more: "a later bedtime",
        less: "an earlier bedtime",
        did: "went to bed {}",
        needs: Needs::Room(Purpose::Bedroom),
        noted: Some(NoteMeaning::Bed),
        summary: Some(SummaryUse { rank: 1, subject: "bedtime", range: Some((18.0, 30.0)) }),
        is_observed: true,
        group: MeasureGroup::Night,
        least_sd: 0.4,
        of: |day| day.bedtime(),
        ..NIGHT
    },
    DailyMeasure {
        name: "rising",
        unit: CLOCK,
        title: "Getting up",
        definition: "End of the night, in hours of the day",
        source: "our definition",
        more: "getting up later",
        less: "getting up earlier",
        did: "got up {}",
        needs: Needs::Room(Purpose::Bedroom),
        noted: Some(NoteMeaning::Bed),
        summary: Some(SummaryUse { rank: 2, subject: "getting up", range: Some((3.0, 14.0)) }),
        is_observed: true,
        group: MeasureGroup::Night,
        least_sd: 0.4,
        of: |day| day.rising(),
        ..DAY
    },
    DailyMeasure {
        name: "sleep",
        unit: HOURS,
        title: "Sleep",
        definition: "Hours in bed without movement in the bedroom, counting only stretches of 5 min or more",
        source: "sleep scoring by rest in actigraphy; the 5 min are our choice",
        more: "more sleep",
        less: "less sleep",
        did: "slept {}",
        needs: Needs::Room(Purpose::Bedroom),
        summary: Some(SummaryUse { rank: 3, subject: "night", range: Some((0.0, 14.0)) }),
        group: MeasureGroup::Night,
        least_sd: 0.4,
        instead_of: Some("time_in_bed"),
        of: |day| day.sleep(),
        ..NIGHT
    },
    DailyMeasure {
        name: "restlessness",
        unit: BOUTS_AN_HOUR,
        title: "Restlessness in bed",
        definition: "Bouts of movement in bed per hour in bed; movements more than 30 s apart are two bouts",
        source: "Rantz et al. 2015, bed restlessness; the definition of a bout is our choice",
        more: "more restless in bed",
        less: "less restless in bed",
        needs: Needs::Room(Purpose::Bedroom),
        summary: Some(SummaryUse { rank: 5, subject: "restlessness", range: None }),
        is_observed: true,
        group: MeasureGroup::Night,
        least_sd: 0.7,
        of: |day| day.restlessness(),
        ..NIGHT
    },
    DailyMeasure {
        name: "bathroom_night",
        unit: VISITS,
        title: "Bathroom visits at night",
        definition: "Stays in the bathroom of 20 s or more between going to bed and getting up; gaps of up to 60 s do not end a stay. If several sensors see a person at once, the person counts as in the room with most of these sensors",
        source: "Rantz et al. 2015, bathroom activity",
        more: "more bathroom visits at night",
        less: "fewer bathroom visits at night",
        did: "got up for the bathroom {}",
        did_not: "did not get up for the bathroom",
        needs: Needs::Room(Purpose::Bathroom),
        noted: Some(NoteMeaning::Bathroom),
        summary: Some(SummaryUse { rank: 6, subject: "bathroom at night", range: Some((0.0, 8.0)) }),
        goal: Some("Bathroom visits at night"),
        is_observed: true,
        group: MeasureGroup::Bathroom,
        least_sd: 0.7,
        of: |day| day.bathroom_night(),
        ..NIGHT
    },
    DailyMeasure {
        name: "bathroom_day",
        unit: VISITS,
        title: "Bathroom visits by day",
        definition: "Stays in the bathroom of 20 s or more on the day, without those of the night; gaps of up to 60 s do not end a stay",
        source: "Rantz et al. 2015, bathroom activity",
        more: "more bathroom visits by day",
        less: "fewer bathroom visits by day",
        did: "used the bathroom {} by day",
        did_not: "did not use the bathroom by day",
        needs: Needs::Room(Purpose::Bathroom),
        noted: Some(NoteMeaning::Bathroom),
        summary: Some(SummaryUse { rank: 7, subject: "bathroom by day", range: None }),
        is_observed: true,
        group: MeasureGroup::Bathroom,
        least_sd: 1.5,
        of: |day| day.bathroom_day(),
        ..DAY
    },
    DailyMeasure {
        name: "showers",
        unit: TIMES,
        title: "Showers",
        definition: "With a sensor at the shower: periods of 3 min or more in which it reports movement. Otherwise an estimate, which needs a motion sensor in the bathroom: daytime stays of 10 min or more with a sign of presence in every minute",
        source: "our definition",
        more: "more showers",
        less: "fewer showers",
        did: "showered {}",
        did_not: "did not shower",
        needs: Needs::Room(Purpose::Bathroom),
        noted: Some(NoteMeaning::Shower),
        summary: Some(SummaryUse { rank: 8, subject: "showers", range: Some((0.0, 3.0)) }),
        group: MeasureGroup::Bathroom,
        least_sd: 0.5,
        of: |day| day.showers(),
        ..DAY
    },
    DailyMeasure {
        name: "meals",
        unit: TIMES,
        title: "Kitchen meals",
        definition: "Periods with 15 min or more in the kitchen; times outside it of up to 15 min do not end a period",
        source: "our definition",
        more: "more kitchen meals",
        less: "fewer kitchen meals",
        did: "had a meal in the kitchen {}",
        did_not: "had no meal in the kitchen",
        needs: Needs::Room(Purpose::Kitchen),
        noted: Some(NoteMeaning::Meal),
        summary: Some(SummaryUse { rank: 9, subject: "meals", range: Some((0.0, 6.0)) }),
        is_observed: true,
        group: MeasureGroup::Meals,
        least_sd: 0.6,
        of: |day| day.meals(),
        ..DAY
    },
    DailyMeasure {
        name: "time_out",
        unit: HOURS,
        title: "Time out of the home",
        definition: "Hours of the day in which the home is empty, computed from the rows up to the end of the day",
        source: "Wang and Skubic 2008, time away from home",
        more: "more time out of the home",
        less: "less time out of the home",
        did: "was out {}",
        did_not: "did not go out",
        needs: Needs::Entrance,
        noted: Some(NoteMeaning::Leaves),
        summary: Some(SummaryUse { rank: 10, subject: "outings", range: Some((0.0, 16.0)) }),
        goal: Some("Time away from home"),
        is_observed: true,
        group: MeasureGroup::Out,
        least_sd: 0.7,
        of: |day| day.time_out(),
        ..DAY
    },
    DailyMeasure {
        name: "outings",
        unit: TIMES,
        title: "Outings",
        definition: "Absences of half an hour or more. An absence counts on the day on which its first half hour ends",
        source: "Wang and Skubic 2008, time away from home",
        more: "more outings",
        less: "fewer outings",
        did: "went out {}",
        did_not: "did not go out",
        needs: Needs::Entrance,
        noted: Some(NoteMeaning::Leaves),
        summary: Some(SummaryUse { rank: 11, subject: "outings", range: Some((0.0, 6.0)) }),
        is_observed: true,
        group: MeasureGroup::Out,
        least_sd: 0.7,
        of: |day| day.outings(),
        ..DAY
    },
    DailyMeasure {
        name: "room_changes",
        unit: TIMES,
        title: "Room changes",
        definition: "Changes from one room to another on the day",
        source: "Petersen et al. 2014, room transitions",
        more: "moving about more at home",
        less: "moving about less at home",
        summary: Some(SummaryUse { rank: 13, subject: "movement", range: None }),
        is_observed: true,
        group: MeasureGroup::Moving,
        least_sd: 15.0,
        of: |day| day.room_changes(),
        ..DAY
    },
    DailyMeasure {
        name: "pace",
        unit: OF_USUAL,
        title: "Walking pace",
        definition: "Median relative pace of the day's walks between sensors. The relative pace of a walk is its usual time (the median of up to 100 earlier times) divided by its actual time",
        source: "Hagler et al. 2010, walking speed by sensors in a line; relative times are our choice",
        more: "walking faster",
        less: "walking more slowly",
        summary: Some(SummaryUse { rank: 16, subject: "walking", range: None }),
        group: MeasureGroup::Moving,
        least_sd: 0.03,
        of: |day| day.pace(),
        ..DAY
    },
    DailyMeasure {
        name: "pace_slow",
        unit: OF_USUAL,
        title: "Pace of the slowest walks",
        definition: "10th percentile of the relative pace of the day's walks between sensors (see pace)",
        source: "Hagler et al. 2010, the distribution of walking speeds",
        more: "a faster pace on the slowest walks",
        less: "a slower pace on the slowest walks",
        group: MeasureGroup::Moving,
        least_sd: 0.04,
        of: |day| day.pace_slow(),
        ..DAY
    },
    DailyMeasure {
        name: "walking_speed",
        unit: METRES_A_SECOND,
        title: "Walking speed",
        definition: "Median speed of the day's walks between sensors, by the length of the walkable path in the home; not known without a home",
        source: "Hagler et al. 2010, walking speed by sensors in a line; paths of a home in place of a line are our choice",
        more: "walking faster",
        less: "walking more slowly",
        did: "walked {}",
        group: MeasureGroup::Moving,
        least_sd: 0.03,
        instead_of: Some("pace"),
        of: |day| day.speed(0.5),
        ..DAY
    },
    DailyMeasure {
        name: "walking_speed_slow",
        unit: METRES_A_SECOND,
        title: "Speed of slow walks",
        definition: "10th percentile of the speed of the day's walks between sensors, by the length of the path in the home",
        source: "Hagler et al. 2010, the distribution of walking speeds",
        more: "faster slow walks",
        less: "slower slow walks",
        group: MeasureGroup::Moving,
        least_sd: 0.03,
        of: |day| day.speed(0.1),
        ..DAY
    },
    DailyMeasure {
        name: "walking_speed_fast",
        unit: METRES_A_SECOND,
        title: "Speed of fast walks",
        definition: "90th percentile of the speed of the day's walks between sensors, by the length of the path in the home",
        source: "Hagler et al. 2010, the distribution of walking speeds",
        more: "faster fast walks",
        less: "slower fast walks",
        group: MeasureGroup::Moving,
        least_sd: 0.04,
        of: |day| day.speed(0.9),
        ..DAY
    },
    DailyMeasure {
        name: "company",
        unit: HOURS,
        title: "Time with visitors",
        definition: "Estimate of the hours of the day with a visitor. A visit lies between two uses of the front door's contact, 10 min to 5 h apart. A person is at home before and after it, and the signs of presence are at least 1.3 times the median of the last 28 days",
        source: "Petersen et al. 2012, visitors by sensors; the rule is our choice",
        more: "more time with visitors",
        less: "less time with visitors",
        did: "had visitors {}",
        did_not: "had no visitors",
        group: MeasureGroup::Out,
        least_sd: 0.5,
        of: |day| day.company(),
        ..DAY
    },
    DailyMeasure {
        name: "visits",
        unit: TIMES,
        title: "Visitors",
        definition: "Estimate of the arrivals of other people on the day: see company",
        source: "Petersen et al. 2012, visitors by sensors; the rule is our choice",
        more: "more visitors",
        less: "fewer visitors",
        group: MeasureGroup::Out,
        least_sd: 0.5,
        of: |day| day.visits(),
        ..DAY
    },
    DailyMeasure {
        name: "pacing",
        unit: TIMES,
        title: "Pacing",
        definition: "Walks back and forth between two rooms, three times or more, without a stay of over a minute",
        source: "Martino-Saltzman et al. 1991; the threshold of three is our choice",
        more: "more pacing to and fro",
        less: "less pacing to and fro",
        summary: Some(SummaryUse { rank: 17, subject: "pacing", range: None }),
        group: MeasureGroup::Moving,
        least_sd: 1.0,
        of: |day| day.pacing(),
        ..DAY
    },
    DailyMeasure {
        name: LAPPING,
        unit: TIMES,
        title: "Lapping",
        definition: "Walks round three rooms or more, three times or more, without a stay of over a minute",
        source: "Martino-Saltzman et al. 1991; the threshold of three is our choice",
        more: "more walking in circles",
        less: "less walking in circles",
        group: MeasureGroup::Moving,
        least_sd: 1.0,
        of: |day| day.lapping(),
        ..DAY
    },
    DailyMeasure {
        name: "sedentary",
        unit: HOURS,
        title: "Sitting and resting",
        definition: "Hours of the day in stays of 30 min or more in one room, without the night in bed",
        source: "our definition, after the 30-min bouts of sedentary time in actigraphy",
        more: "more sitting and resting by day",
        less: "less sitting and resting by day",
        did: "sat or rested {} by day",
        summary: Some(SummaryUse { rank: 12, subject: "movement", range: Some((0.0, 18.0)) }),
        group: MeasureGroup::Moving,
        least_sd: 0.8,
        of: |day| day.sedentary(),
        ..DAY
    },
    DailyMeasure {
        name: "density_night",
        unit: FIRINGS_AN_HOUR,
        title: "Movement at night",
        definition: "Firings of motion sensors per hour at home, from midnight to 06:00",
        source: "Wang and Skubic 2008",
        first_hour: Some(0),
        more: "more movement at night",
        less: "less movement at night",
        summary: Some(SummaryUse { rank: 15, subject: "movement at night", range: None }),
        is_observed: true,
        group: MeasureGroup::Night,
        least_sd: 8.0,
        of: |day| day.density(0..6),
        ..NIGHT
    },
    DailyMeasure {
        name: "density_morning",
        unit: FIRINGS_AN_HOUR,
        title: "Movement in the morning",
        definition: "Firings of motion sensors per hour at home, from 06:00 to noon",
        source: "Wang and Skubic 2008",
        first_hour: Some(6),
        more: "more movement in the morning",
        less: "less movement in the morning",
        summary: Some(SummaryUse { rank: 14, subject: "movement", range: None }),
        is_observed: true,
        group: MeasureGroup::Moving,
        least_sd: 10.0,
        of: |day| day.density(6..12),
        ..DAY
    },
    DailyMeasure {
        name: "density_afternoon",
        unit: FIRINGS_AN_HOUR,
        title: "Movement in the afternoon",
        definition: "Firings of motion sensors per hour at home, from noon to 18:00",
        source: "Wang and Skubic 2008",
        first_hour: Some(12),
        more: "more movement in the afternoon",
        less: "less movement in the afternoon",
        is_observed: true,
        group: MeasureGroup::Moving,
        least_sd: 10.0,
        of: |day| day.density(12..18),
        ..DAY
    },
    DailyMeasure {
        name: "density_evening",
        unit: FIRINGS_AN_HOUR,
        title: "Movement in the evening",
        definition: "Firings of motion sensors per hour at home, from 18:00 to midnight",
        source: "Wang and Skubic 2008",
        first_hour: Some(18),
        more: "more movement in the evening",
        less: "less movement in the evening",
        is_observed: true,
        group: MeasureGroup::Moving,
        least_sd: 10.0,
        of: |day| day.density(18..24),
        ..DAY
    },
    DailyMeasure {
        name: "density_distance",
        unit: PATTERN_DISTANCE,
        title: "Change of daily pattern",
        definition: "Distance between the density map of the seven days that end with the day and that of the seven days before; the eight colour levels of the map follow from the first 14 whole days of the log",
        source: "Wang and Skubic 2008, dissimilarity of density maps",
        more: "more change in the daily pattern",
        less: "less change in the daily pattern",
        group: MeasureGroup::Rhythm,
        least_sd: 0.05,
        of: |day| day.density_distance(),
        ..DAY
    },
    DailyMeasure {
        name: "interdaily_stability",
        unit: SHARE,
        title: "Regularity of days",
        definition: "Variance of the mean firings per hour of day, divided by the variance of all hours, over the seven days that end with the day",
        source: "Witting et al. 1990, interdaily stability",
        more: "more regular days",
        less: "less regular days",
        group: MeasureGroup::Rhythm,
        least_sd: 0.05,
        of: |day| day.interdaily_stability(),
        ..DAY
    },
    DailyMeasure {
        name: "intradaily_variability",
        unit: RATIO,
        title: "Fragmentation of days",
        definition: "Mean squared difference of firings between consecutive hours, divided by the variance of all hours, over the seven days that end with the day",
        source: "Witting et al. 1990, intradaily variability",
        more: "more fragmented days",
        less: "less fragmented days",
        group: MeasureGroup::Rhythm,
        least_sd: 0.1,
        of: |day| day.intradaily_variability(),
        ..DAY
    },
];

impl DailyMeasure {
    pub fn named(name: &str) -> Option<&'static DailyMeasure> {
        MEASURES.iter().find(|measure| measure.name == name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    /// `HOMEBODY_REWRITE` writes the table anew.
    #[test]
    fn the_page_of_measures_has_the_table_and_the_example_of_rules() {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/reference/measures.md");
        let page = std::fs::read_to_string(&path).unwrap();
        let (before, rest) = page.split_once("| measure | unit | definition | source |\n|---|---|---|---|\n").unwrap();
        let (table, after) = rest.split_once("\n\n").unwrap();
        let row = |DailyMeasure { name, unit, definition, source, .. }: &DailyMeasure| {
            format!("| `{name}` | {unit} | {definition} | {source} |")
        };
        let rows: Vec<String> = MEASURES.iter().map(row).collect();
        if std::env::var_os("HOMEBODY_REWRITE").is_some() {
            let heading = &page[before.len()..page.len() - rest.len()];
            std::fs::write(&path, format!("{before}{heading}{}\n\n{after}", rows.join("\n"))).unwrap();
        } else {
            assert_eq!(table, rows.join("\n"), "docs/reference/measures.md: HOMEBODY_REWRITE=1 writes the table anew");
        }
        let rules = crate::alerts::EXAMPLE.trim();
        assert!(page.contains(rules), "docs/reference/measures.md lacks the example of rules as it is:\n{rules}");
    }
}
