use super::{FieldRow, FieldVerdict, StatementsExperiment};
use homebody::shared::TextTable;
use std::collections::BTreeMap;
use std::fmt;

/// Number of reasons for refusals that the text lists (our choice).
const MOST_REASONS: usize = 12;

impl fmt::Display for StatementsExperiment {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let StatementsExperiment { seed, statements, unmeasured, happened, told, neither, false_alarms, fields } = self;
        writeln!(
            f,
            "{statements} random statements (seed {seed}), {unmeasured} of them without an occasion; one true field in {:.0} fails by chance",
            1.0 / false_alarms
        )?;
        let table = TextTable::new("-24 kind|-44 field|8 fields|8 happened|6 told|7 neither");
        write!(f, "\n  {}", table.heading())?;
        let mut groups: BTreeMap<(&str, &str), [usize; 3]> = BTreeMap::new();
        for row in fields {
            let place = match row.verdict {
                FieldVerdict::Happened => 0,
                FieldVerdict::Told => 1,
                FieldVerdict::Neither => 2,
            };
            groups.entry((&row.kind, &row.field)).or_default()[place] += 1;
        }
        for ((kind, field), [happened, told, neither]) in &groups {
            write!(f, "  {}", table.row(&[kind, field, &(happened + told + neither), happened, told, neither]))?;
        }
        write!(f, "  {}", table.row(&[&"all", &"", &fields.len(), happened, told, neither]))?;
        let mut reasons: BTreeMap<&str, usize> = BTreeMap::new();
        for row in fields.iter().filter(|row| row.field == "refused") {
            *reasons.entry(&row.told).or_default() += 1;
        }
        let mut reasons: Vec<(&str, usize)> = reasons.into_iter().collect();
        reasons.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
        if !reasons.is_empty() {
            writeln!(f, "\nRefused:\n")?;
        }
        for (reason, count) in reasons.iter().take(MOST_REASONS) {
            writeln!(f, "  {count} times: {}", reason.lines().next().unwrap_or_default())?;
        }
        let of = |verdict: FieldVerdict| fields.iter().filter(move |row| row.verdict == verdict);
        if *neither > 0 {
            writeln!(f, "\nNeither happened nor told:\n")?;
        }
        for FieldRow { index, kind, field, text, expected, measured, home, days, .. } in of(FieldVerdict::Neither) {
            writeln!(f, "  {index}: {kind}, {field}: {}", text.replace('\n', " "))?;
            writeln!(f, "    expected: {expected}; measured: {measured}\n    {days} days in {home}")?;
        }
        Ok(())
    }
}
