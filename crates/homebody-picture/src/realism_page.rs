//! A page that holds one log against another: every measure, what gives the one away, and the pictures beside.

use super::chart::{TotalsLine, totals_chart};
use super::page::{begun, table};
use super::svg::escaped;
use homebody_analysis::realism::{MEASURES, Realism, Sign, Summary};
use std::fmt::Write;

/// One HTML page that needs nothing besides itself.
pub fn realism_page(realism: &Realism) -> String {
    let (a, b) = (&realism.a, &realism.b);
    let title = format!("{} beside {}", b.name, a.name);
    let mut page = begun(&title);
    let header = ["log", "days", "motion sensors", "firings a day"];
    let rows = [("A", a), ("B", b)].map(|(letter, log)| {
        let Summary { name, days, motion_sensors, firings_a_day, .. } = log;
        vec![format!("{letter}: {name}"), days.to_string(), motion_sensors.to_string(), format!("{firings_a_day:.0}")]
    });
    table(&mut page, &header, &rows);
    let shown = |value: Option<f64>| value.map_or("-".into(), |value| format!("{value:.3}"));
    let rows: Vec<Vec<String>> = realism
        .measures()
        .into_iter()
        .map(|(name, what, measure)| {
            let each = measure.of.map(|of| of.map(shown)).unwrap_or_default();
            let [of_a, of_b] = each;
            vec![name.into(), shown(measure.value), shown(measure.floor), of_a, of_b, what.into()]
        })
        .collect();
    table(&mut page, &["measure", "value", "floor", "A", "B", "what"], &rows);
    for (what, signs) in [("Days", &realism.days_told_by), ("Hours", &realism.hours_told_by)] {
        if signs.is_empty() {
            continue;
        }
        let _ = writeln!(page, "<h2>{what} are told apart by</h2>");
        let row = |Sign { figure, part, medians: [a, b] }: &Sign| {
            vec![figure.clone(), format!("{:.1} %", part * 100.0), format!("{a:.2}"), format!("{b:.2}")]
        };
        table(&mut page, &["figure", "part", "median of A", "of B"], &signs.iter().map(row).collect::<Vec<_>>());
    }
    for svg in pictures(realism) {
        let _ = writeln!(page, "<figure>{svg}</figure>");
    }
    let _ = writeln!(page, "<pre>{}</pre>\n</html>", escaped(MEASURES));
    page
}

/// The hours of the day of both logs.
pub fn realism_chart(realism: &Realism) -> String {
    let line = |log: &Summary| TotalsLine {
        label: log.name.clone(),
        points: (0_u32..).zip(log.hours).map(|(hour, count)| (f64::from(hour), count)).collect(),
    };
    totals_chart("Firings by hour of the day", ["hour", "firings an hour"], &[line(&realism.a), line(&realism.b)], None)
}

fn pictures(realism: &Realism) -> Vec<String> {
    let mut pictures = vec![realism_chart(realism)];
    let logs = [&realism.a, &realism.b];
    let mut quantiles = |title: &str, axis: &str, of: fn(&Summary) -> &[f64], in_tens: bool| {
        let line = |log: &&Summary| TotalsLine {
            label: log.name.clone(),
            points: (1_u32..)
                .zip(of(log))
                .map(|(step, &s)| (f64::from(step) * 5.0, if in_tens { s.max(0.01).log10() } else { s }))
                .collect(),
        };
        if logs.iter().all(|log| !of(log).is_empty()) {
            pictures.push(totals_chart(title, ["percent of all", axis], &logs.each_ref().map(line), None));
        }
    };
    quantiles("Times from any firing to the next", "seconds, as powers of ten", |log| &log.gaps_s, true);
    quantiles("How long an ON lasts", "seconds", |log| &log.on_s, false);
    pictures
}
