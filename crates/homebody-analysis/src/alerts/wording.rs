use super::rule::AlertMethod;
use crate::measures::{DailyMeasure, Earlier};
use crate::phrases::{in_full, number};
use homebody_core::names::capitalised;
use jiff::civil::Date;

impl DailyMeasure {
    pub(super) fn alert_words(
        &self,
        method: AlertMethod,
        (value, usual): (f64, f64),
        days: &[Date],
    ) -> (String, String) {
        let what = capitalised(self.changed(value > usual));
        let headline = match (method, days) {
            (AlertMethod::Ewma, _) => format!("{what}, building up over several days"),
            (AlertMethod::Cusum, [first, ..]) => format!("{what} since {}", in_full(*first)),
            (_, [] | [_]) => format!("{what} than usual"),
            (_, days) => format!("{what} than usual, {} {}s in a row", number(days.len()), self.occasion),
        };
        (headline, self.compared(value, Earlier::Usual(usual), method != AlertMethod::Deviation))
    }
}

#[cfg(test)]
mod tests {
    use super::AlertMethod::{Cusum, Deviation, Ewma};
    use super::*;
    use crate::alerts::{EXAMPLE, Rules};

    fn alert(name: &str, method: AlertMethod, values: (f64, f64), days: i8) -> String {
        let days: Vec<Date> = (1..=days).map(|day| jiff::civil::date(2024, 1, day)).collect();
        let (headline, numbers) = DailyMeasure::named(name).unwrap().alert_words(method, values, &days);
        format!("{headline}: {numbers}")
    }

    #[test]
    fn an_alert_has_its_values_and_the_usual_ones() {
        for (name, method, values, days, words) in [
            (
                "meals",
                Ewma,
                (2.8, 3.6),
                1,
                "Fewer kitchen meals, building up over several days: 2.8 a day on average, usually 3.6",
            ),
            (
                "rising",
                Deviation,
                (9.0, 7.25),
                3,
                "Getting up later than usual, three days in a row: at 09:00, usually 07:15",
            ),
            (
                "density_morning",
                Ewma,
                (276.0, 451.0),
                1,
                "Less movement in the morning, building up over several days: 39 % lower than usual",
            ),
            ("sleep", Deviation, (6.0, 7.25), 2, "Less sleep than usual, two nights in a row: 6.0 hours, usually 7.2"),
            (
                "bathroom_night",
                Deviation,
                (6.0, 1.5),
                1,
                "More bathroom visits at night than usual: 6 times, usually 1.5",
            ),
            ("pace", Cusum, (0.88, 1.0), 4, "Walking more slowly since 1 January 2024: 12 % more slowly than usual"),
        ] {
            assert_eq!(alert(name, method, values, days), words);
        }
    }

    #[test]
    fn no_rule_is_worded_with_terms_of_sensors_or_statistics() {
        let rules = Rules::read(EXAMPLE).unwrap();
        for (rule, values) in rules.rules.iter().flat_map(|rule| [(rule, (1.0, 2.0)), (rule, (2.0, 1.0))]) {
            let (_, measure) = rule.measure().unwrap();
            let words = alert(measure.name, rule.method, values, 1);
            for jargon in ["ensity", "firing", "sensor", "average of", "_", "bouts", "sd"] {
                assert!(!words.contains(jargon), "{words}");
            }
        }
    }
}
