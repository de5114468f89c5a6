//! HTML pages that need no other file: their head and tables, and the page that compares two logs.

use super::chart::{TotalsLine, totals_chart};
use super::svg::escaped;
use homebody_analysis::realism::{LogSummary, MEASURES, Realism, TellingFigure};
use std::fmt::Write;

const STYLE: &str = "body{font:16px/1.5 sans-serif;max-width:75rem;margin:2rem auto;padding:0 1rem;color:#1c2733}\
    table{border-collapse:collapse;margin:1rem 0}td,th{padding:.2rem .8rem;text-align:left;border-bottom:1px solid #e3e6e9}\
    td.n,th.n{text-align:right;font-variant-numeric:tabular-nums}svg{max-width:100%;height:auto}pre{white-space:pre-wrap}";

pub fn begun(title: &str) -> String {
    format!(
        "<!doctype html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n<title>{0}</title>\n<style>{STYLE}</style>\n<h1>{0}</h1>\n",
        escaped(title)
    )
}

/// A table; cells that begin like numbers stand to the right.
pub fn table(page: &mut String, header: &[&str], rows: &[Vec<String>]) {
    let is_number = |cell: &str| cell.starts_with(|c: char| c.is_ascii_digit() || c == '-');
    page.push_str("<table>\n<tr>");
    for cell in header {
        let _ = write!(page, "<th>{}</th>", escaped(cell));
    }
    page.push_str("</tr>\n");
    for row in rows {
        page.push_str("<tr>");
        for cell in row {
            let class = if is_number(cell) { " class=\"n\"" } else { "" };
            let _ = write!(page, "<td{class}>{}</td>", escaped(cell));
        }
        page.push_str("</tr>\n");
    }
    page.push_str("</table>\n");
}

pub fn realism_page(realism: &Realism) -> String {
    let (a, b) = (&realism.a, &realism.b);
    let title = format!("{} beside {}", b.name, a.name);
    let mut page = begun(&title);
    let header = ["log", "days", "motion sensors", "firings a day"];
    let rows = [("A", a), ("B", b)].map(|(letter, log)| {
        let LogSummary { name, days, motion_sensors, firings_a_day, .. } = log;
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
        let row = |TellingFigure { figure, part, medians: [a, b] }: &TellingFigure| {
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

pub fn realism_chart(realism: &Realism) -> String {
    let line = |log: &LogSummary| TotalsLine {
        label: log.name.clone(),
        points: (0_u32..).zip(log.hours).map(|(hour, count)| (f64::from(hour), count)).collect(),
    };
    totals_chart("Firings by hour of the day", ["hour", "firings an hour"], &[line(&realism.a), line(&realism.b)], None)
}

fn pictures(realism: &Realism) -> Vec<String> {
    let mut pictures = vec![realism_chart(realism)];
    let logs = [&realism.a, &realism.b];
    let mut quantiles = |title: &str, axis: &str, of: fn(&LogSummary) -> &[f64], in_tens: bool| {
        let line = |log: &&LogSummary| TotalsLine {
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
