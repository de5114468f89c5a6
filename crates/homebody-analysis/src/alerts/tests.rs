use super::*;
use crate::measures::SilentSensor;
use crate::sample::days;
use jiff::civil::date;

fn days_of(name: &str, values: &[Option<f64>]) -> Measures {
    days(&[(name, values.to_vec())])
}

fn rules(rule: &str) -> Rules {
    Rules::read(&format!(r#"{{ "rules": [{rule}] }}"#)).unwrap()
}

/// Fourteen days of one and two visits, then these.
fn then(values: &[f64]) -> Vec<Option<f64>> {
    let before = (0..14).map(|day| Some(f64::from(1 + day % 2)));
    before.chain(values.iter().copied().map(Some)).collect()
}

const NIGHTS: &str = r#"{ "name": "nights", "measure": "bathroom_night", "when": "more", "days": 2, "least_sd": 0.5 }"#;

#[test]
fn unusual_days_in_a_row_give_one_alert() {
    let found = alerts(&days_of("bathroom_night", &then(&[6.0, 2.0, 6.0, 5.0, 6.0])), &rules(NIGHTS));
    let [alert] = &found.alerts[..] else { panic!("{found}") };
    assert_eq!((alert.date, alert.shown_by.len()), (date(2024, 1, 18), 2));
    assert!(
        alert.words.contains("More bathroom visits at night than usual, two nights in a row: 5 times, usually "),
        "{found}"
    );
    // Less is not more.
    assert!(alerts(&days_of("bathroom_night", &then(&[0.0, 0.0, 0.0])), &rules(NIGHTS)).alerts.is_empty());
}

#[test]
fn alerts_show_times_of_day_and_numbers_of_days() {
    let values: Vec<Option<f64>> = [22.0, 22.5, 22.0, 22.5, 22.0, 22.5, 22.0, 24.5].into_iter().map(Some).collect();
    let found =
        alerts(&days_of("bedtime", &values), &rules(r#"{ "name": "late", "measure": "bedtime", "when": "either" }"#));
    let [alert] = &found.alerts[..] else { panic!("{found}") };
    let words = "A later bedtime than usual: at 00:30, usually 22:13";
    assert_eq!(alert.words, words);
}

#[test]
fn without_enough_days_nothing_is_usual() {
    let short: Vec<Option<f64>> = vec![Some(1.0), Some(2.0), Some(9.0), Some(9.0)];
    let found = alerts(&days_of("bathroom_night", &short), &rules(NIGHTS));
    assert!(found.alerts.is_empty());
    assert!(found.remarks[0].contains("needed to know what is usual"), "{found}");
}

#[test]
fn days_that_are_not_known_do_not_count() {
    let mut gap = then(&[6.0, 6.0]);
    gap.splice(14..14, vec![None; 6]);
    assert_eq!(alerts(&days_of("bathroom_night", &gap), &rules(NIGHTS)).alerts.len(), 1);
    gap.splice(14..14, vec![None; 30]);
    assert!(alerts(&days_of("bathroom_night", &gap), &rules(NIGHTS)).alerts.is_empty());
}

#[test]
fn a_slow_change_is_found_by_the_moving_average() {
    let slowly: Vec<f64> = (0..21).map(|day| 1.5 + f64::from(day % 2) + 0.12 * f64::from(day)).collect();
    let rule = r#"{ "name": "slow", "measure": "bathroom_night", "when": "more", "method": "ewma" }"#;
    let found = alerts(&days_of("bathroom_night", &then(&slowly)), &rules(rule));
    assert!(found.alerts.first().is_some_and(|alert| alert.date < date(2024, 1, 29)), "{found}");
    let steady: Vec<f64> = (0..60).map(|day| f64::from(1 + day % 2)).collect();
    assert!(alerts(&days_of("bathroom_night", &then(&steady)), &rules(rule)).alerts.is_empty());
}

#[test]
fn a_change_is_found_with_the_day_since_when_it_is_so() {
    let rule = r#"{ "name": "change", "measure": "bathroom_night", "when": "more", "method": "cusum", "k_sd": 5 }"#;
    let changed: Vec<f64> = (0..30).map(|day| f64::from(1 + day % 2) + if day < 12 { 0.0 } else { 1.2 }).collect();
    let found = alerts(&days_of("bathroom_night", &then(&changed)), &rules(rule));
    let [alert] = &found.alerts[..] else { panic!("{found}") };
    let since = alert.shown_by[0];
    assert!((date(2024, 1, 26)..=date(2024, 1, 28)).contains(&since), "{found}");
    assert!(
        alert.date < date(2024, 2, 3) && alert.words.starts_with("More bathroom visits at night since 2"),
        "{found}"
    );
    let steady: Vec<f64> = (0..60).map(|day| f64::from(1 + day % 2)).collect();
    assert!(alerts(&days_of("bathroom_night", &then(&steady)), &rules(rule)).alerts.is_empty());
    // Less is not more.
    let less: Vec<f64> = (0..30).map(|_| 0.0).collect();
    assert!(alerts(&days_of("bathroom_night", &then(&less)), &rules(rule)).alerts.is_empty());
}

#[test]
fn silent_sensor_gives_an_alert() {
    let mut measures = days_of("meals", &then(&[2.0; 5]));
    measures.silent.push(SilentSensor {
        sensor: "kitchen motion".into(),
        since: date(2024, 1, 15),
        told: date(2024, 1, 17),
        until: None,
    });
    let found = alerts(&measures, &rules(NIGHTS));
    let [alert] = &found.alerts[..] else { panic!("{found}") };
    assert_eq!((alert.rule.as_str(), alert.date), ("sensor", date(2024, 1, 17)));
}
