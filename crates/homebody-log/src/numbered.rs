//! The numbers of a run's rows: from 0, each once.

use crate::check::Check;
use homebody_core::problem::counted;

/// Numbers that come in the order in which rows are there.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Numbers {
    rows: u64,
    next: i64,
    /// The first number that is missing, and how many are.
    gap: Option<(i64, u64)>,
    /// The first number that came again, and how many did.
    again: Option<(i64, u64)>,
}

impl Numbers {
    /// Takes the number of a row.
    pub fn push(&mut self, number: i64) {
        self.rows += 1;
        let ahead = number.saturating_sub(self.next);
        match ahead {
            0 => {}
            1.. => {
                self.gap =
                    Some((self.gap.map_or(self.next, |gap| gap.0), self.gap.map_or(0, |gap| gap.1) + ahead as u64))
            }
            _ => {
                self.again =
                    Some((self.again.map_or(number, |again| again.0), self.again.map_or(0, |again| again.1) + 1))
            }
        }
        self.next = self.next.max(number.saturating_add(1));
    }

    /// How many rows have come.
    pub fn rows(&self) -> u64 {
        self.rows
    }

    /// What there is to say of the rows of a run; `run` is how it is called, such as `run 5`.
    pub fn check(&self, run: &str) -> Check {
        let of = |some: Option<(i64, u64)>| (some.map_or(0, |(_, count)| count as i64), some.map(|(first, _)| first));
        found_of(run, self.rows as i64, of(self.gap), of(self.again))
    }
}

/// What there is to say of the rows of a run: how many there are, how many are missing and are there again, and the first of these.
pub fn found_of(run: &str, rows: i64, gap: (i64, Option<i64>), again: (i64, Option<i64>)) -> Check {
    const HINT: &str =
        "homebody run --resume FOLDER compares what is there with the run lived again; or write the log anew";
    let count = rows.max(0) as u64;
    let rows = counted(count as usize, "row", "rows");
    let first = |first: Option<i64>| first.map_or_else(String::new, |first| format!(", the first is {first}"));
    let mut wrong = Vec::new();
    if gap.0 > 0 {
        wrong.push(format!("{} missing{}", counted(gap.0 as usize, "number is", "numbers are"), first(gap.1)));
    }
    if again.0 > 0 {
        let what = counted(
            again.0 as usize,
            "row has a number that was there before",
            "rows have numbers that were there before",
        );
        wrong.push(format!("{what}{}", first(again.1)));
    }
    let check = match wrong.is_empty() {
        true => Check::ok("rows", format!("{run}: {rows}, numbered from 0 without a gap")),
        false => Check::wrong("rows", format!("{run}: of {rows}, {}", wrong.join("; ")), HINT),
    };
    Check { rows: Some(count), ..check }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::Verdict;

    fn check(numbers: &[i64]) -> Check {
        let mut all = Numbers::default();
        numbers.iter().for_each(|&number| all.push(number));
        all.check("run 1")
    }

    #[test]
    fn gaps_and_doubles_are_found() {
        let whole = Check::ok("rows", "run 1: 3 rows, numbered from 0 without a gap");
        assert_eq!(check(&[0, 1, 2]), Check { rows: Some(3), ..whole });
        let gap = check(&[1, 2, 5]);
        assert_eq!(gap.verdict, Verdict::Wrong);
        assert_eq!(gap.says, "run 1: of 3 rows, 3 numbers are missing, the first is 0");
        let again = check(&[0, 1, 1, 0, 2]);
        assert_eq!(again.says, "run 1: of 5 rows, 2 rows have numbers that were there before, the first is 1");
        assert_eq!(check(&[i64::MAX, i64::MIN]).verdict, Verdict::Wrong);
    }
}
