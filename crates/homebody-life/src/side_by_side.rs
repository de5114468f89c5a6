//! The table of a draft: sources and statements side by side.

use crate::life_draft::{DraftLine, LifeDraft};

/// Widths of the columns in characters (our choice): together, they fit into a terminal of 120.
const WIDTHS: [usize; 4] = [32, 42, 20, 20];

const BETWEEN: &str = " | ";

impl LifeDraft {
    /// The table for a terminal.
    pub fn table(&self) -> String {
        let headings = ["text", "statements", "assumed", "cannot be said"].map(|heading| vec![heading.to_owned()]);
        let rule: Vec<String> = WIDTHS.iter().map(|width| "-".repeat(*width)).collect();
        let rule = rule.join("-+-") + "\n";
        let mut text = format!("{}{rule}", row(&headings));
        for line in &self.lines {
            text += &format!("{}{rule}", line.row());
        }
        for sentence in &self.left_out {
            let cells = [vec![sentence.clone()], vec!["(left out by the model)".to_owned()], Vec::new(), Vec::new()];
            text += &format!("{}{rule}", row(&cells));
        }
        text
    }
}

impl DraftLine {
    /// Its row of the table.
    pub fn row(&self) -> String {
        let statements = self.statements.iter().map(|statement| match (&statement.refused, &statement.difference) {
            (Some(_), _) => format!("(refused) {}", statement.text),
            (None, Some(of)) => format!("{} (simulated {})", statement.text, of.lived),
            (None, None) => statement.text.clone(),
        });
        let statements = statements.map(|statement| match self.stands_under {
            Some(list) => format!("(under {list:?}) {statement}"),
            None => statement,
        });
        let source = if self.is_in_text { self.source.clone() } else { format!("(not in the text) {}", self.source) };
        row(&[vec![source], statements.collect(), self.assumed.clone(), self.cannot_be_said.clone()])
    }
}

fn row(cells: &[Vec<String>; 4]) -> String {
    let columns: Vec<Vec<String>> = cells
        .iter()
        .zip(WIDTHS)
        .map(|(texts, width)| texts.iter().flat_map(|text| wrapped(text, width)).collect())
        .collect();
    let height = columns.iter().map(Vec::len).max().unwrap_or(0);
    let line = |at: usize| {
        let cells = columns.iter().zip(WIDTHS).map(|(lines, width)| {
            let cell = lines.get(at).map(String::as_str).unwrap_or_default();
            format!("{cell:width$}")
        });
        cells.collect::<Vec<_>>().join(BETWEEN).trim_end().to_owned() + "\n"
    };
    (0..height).map(line).collect()
}

/// A text in lines of a width; longer words are cut.
fn wrapped(text: &str, width: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    let mut used = 0;
    let words = text.split_whitespace().flat_map(|word| {
        let letters: Vec<char> = word.chars().collect();
        letters.chunks(width).map(|part| part.iter().collect::<String>()).collect::<Vec<_>>()
    });
    for word in words {
        let length = word.chars().count();
        if used > 0 && used + 1 + length > width {
            lines.push(String::new());
            used = 0;
        }
        if let Some(line) = lines.last_mut() {
            if used > 0 {
                line.push(' ');
                used += 1;
            }
            line.push_str(&word);
            used += length;
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::life_draft::DraftStatement;

    #[test]
    fn wraps_cells_and_keeps_every_word() {
        let source = "She gets up at seven and then sits by the window for a good while before she eats.";
        let statement = |text: &str, refused: Option<&str>| DraftStatement {
            text: text.to_owned(),
            refused: refused.map(str::to_owned),
            ..DraftStatement::default()
        };
        let line = DraftLine {
            source: source.to_owned(),
            is_in_text: true,
            statements: vec![statement("She gets up at 07:00.", None), statement("She sits.", Some("where"))],
            assumed: vec!["x".repeat(50)],
            ..DraftLine::default()
        };
        let row = line.row();
        assert!(row.lines().all(|line| line.chars().count() <= 123), "{row}");
        assert!(row.contains("| (refused) She sits."), "{row}");
        let first: Vec<&str> = row.lines().map(|line| line.split('|').next().unwrap().trim()).collect();
        assert_eq!(first.join(" ").trim(), source);
        assert_eq!(row.matches('x').count(), 50);
        let draft = LifeDraft { lines: vec![line], left_out: vec!["She knits.".into()], ..LifeDraft::default() };
        assert!(draft.table().contains("She knits.") && draft.table().contains("(left out by the model)"));
    }
}
