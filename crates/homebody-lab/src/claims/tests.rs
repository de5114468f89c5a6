//! The table can be parsed, a small part of it holds, and wrong claims are found.

use super::text::CLAIMS;
use super::{ClaimCase, ClaimRow, ClaimsExperiment, Verdict};

fn rows_of(text: &str) -> Vec<ClaimRow> {
    let cases = ClaimCase::read(text).unwrap();
    cases.iter().flat_map(|case| case.simulate(14, 11)).collect()
}

#[test]
fn the_table_holds_hundreds_of_claims() {
    let cases = ClaimCase::read(CLAIMS).unwrap();
    let claims: usize = cases.iter().map(|case| case.claims.len()).sum();
    assert!(claims > 300, "{claims} claims");
    assert!(cases.iter().all(|case| !case.form.is_empty()));
}

#[test]
fn each_condition_is_measured_and_each_size_has_its_source() {
    let cases = ClaimCase::read(super::CONDITIONS).unwrap();
    let forms: Vec<&str> = cases.iter().map(|case| case.form.as_str()).collect();
    let known: Vec<&str> = homebody_routine::household::CONDITIONS.iter().map(|(name, _)| *name).collect();
    assert_eq!(forms, known);
    assert!(cases.iter().flat_map(|case| &case.claims).all(|claim| !claim.source.is_empty()));
}

#[test]
fn some_sentences_of_each_part_of_the_table_hold_or_are_told() {
    /// Tests one of this many cases.
    const OF: usize = 25;
    let cases = ClaimCase::read(CLAIMS).unwrap();
    let short = cases.iter().filter(|case| case.days.is_none());
    let rows: Vec<ClaimRow> = short.step_by(OF).flat_map(|case| case.simulate(60, 11)).collect();
    let neither: Vec<&ClaimRow> = rows.iter().filter(|row| row.verdict == Verdict::Neither).collect();
    assert!(rows.len() > 20 && neither.is_empty(), "of {} claims: {neither:?}", rows.len());
}

#[test]
fn a_claim_that_is_wrong_is_found() {
    let rows = rows_of(
        "She takes a shower at 07:30.\n= showering: begins 09:00..09:30\n= showering: on 30 % of days\n= showering: never\n\
         = showering: lasts 60..70 min\n= showering: in kitchen\n= eating_lunch: times 1.5..2 of the twin\n= told: no shower\n",
    );
    assert_eq!(rows.len(), 7);
    assert!(rows.iter().all(|row| row.verdict == Verdict::Neither), "{rows:?}");
    let experiment = ClaimsExperiment::from_rows(rows, 14, 11);
    assert_eq!((experiment.claims.len(), experiment.lived, experiment.told, experiment.neither), (7, 0, 0, 7));
    assert!(experiment.to_string().contains("Neither lived nor told:"));
}

#[test]
fn refusals_and_remarks_count_as_told() {
    let rows =
        rows_of("She showerrs.\n= showering: every day\n\nNote: She was a nurse.\n= told: remark\n= reading: never\n");
    assert_eq!(rows.iter().map(|row| row.verdict).collect::<Vec<_>>(), [Verdict::Told; 3]);
}

#[test]
fn a_table_that_cannot_be_read_names_the_line() {
    for (text, why) in [
        ("She naps.\n= napping: sometimes\n", "line 2: \"sometimes\" is no number"),
        ("She naps.\n", "claims nothing"),
        ("= napping: every day\n", "says nothing"),
        ("@ upside down\nShe naps.\n", "line 1: there is no such setting"),
        ("She naps.\n= napping: every day | Someday\n", "there is no filter \"Someday\""),
    ] {
        let error = ClaimCase::read(text).unwrap_err();
        assert!(error.contains(why), "{error}");
    }
}
