//! The tables in `docs/reference/truth.md` agree with those of the truth.
//!
//! `HOMEBODY_REWRITE=1 cargo test -p homebody-log --test all truth_tables::` writes it anew. That its queries run, and what they
//! answer, is tested with the command.

use crate::generated::is_generated_between;
use homebody_log::table::truth::tables;
use homebody_log::table::{Column, ColumnKind, Table};

/// Sentences about columns that another page has.
const ELSEWHERE: [(&str, &str, &str); 1] = [("activity", "name", "; the labels are in [activities](activities.md)")];

fn document(tables: &[Table]) -> String {
    tables.iter().map(section).collect()
}

fn section(table: &Table) -> String {
    let Table { name, about, columns, .. } = table;
    let rows: String = columns.iter().map(|column| row(name, column)).collect();
    format!(
        "\n## `{name}`\n\n{}.\n\n| column | type | unit | description |\n|---|---|---|---|\n{rows}",
        sentence(about)
    )
}

fn row(table: &str, column: &Column) -> String {
    let Column { name, kind, unit, about } = column;
    let kind = match kind {
        ColumnKind::Instant => "instant",
        ColumnKind::Integer => "whole number",
        ColumnKind::Real => "number",
        ColumnKind::Text => "text",
    };
    let unit = if unit.is_empty() { " ".to_owned() } else { format!(" {unit} ") };
    let elsewhere =
        ELSEWHERE.iter().find(|(of, column, _)| (*of, *column) == (table, name)).map_or("", |(.., more)| more);
    format!("| `{name}` | {kind} |{unit}| {about}{elsewhere} |\n")
}

/// Words as the beginning of a sentence.
fn sentence(words: &str) -> String {
    let mut letters = words.chars();
    letters.next().map(|first| first.to_uppercase().chain(letters).collect()).unwrap_or_default()
}

#[test]
fn the_document_describes_the_tables() {
    let text = document(&tables());
    is_generated_between("docs/reference/truth.md", "<!-- made from the tables -->", &format!("{text}\n"));
    // The control: another column makes another page.
    let mut others = tables();
    others[0].columns.pop();
    assert!(document(&others) != text);
}
