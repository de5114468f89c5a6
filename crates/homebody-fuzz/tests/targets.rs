//! Each target for some seconds, its corpus first; and that failures are found.

use homebody_fuzz::supervise::{Outcome, Plan, supervise};
use homebody_fuzz::targets::{TARGETS, named};
use std::time::Duration;

/// Always the same, so that a failure is the same everywhere (ours).
const SEED: u64 = 1;

/// As long as each target is fuzzed here (ours): tests run side by side, and all together take less than two minutes.
const SECONDS: u64 = 10;

fn plan(hangs_after_s: u64) -> Plan {
    Plan {
        program: env!("CARGO_BIN_EXE_homebody-fuzz").into(),
        seed: SEED,
        first: 0,
        cases: u64::MAX,
        until: Some(Duration::from_secs(SECONDS)),
        workers: 1,
        // A build that is not optimised is slow, and other tests run beside it.
        hangs_after: Duration::from_secs(hangs_after_s),
        is_measured: false,
    }
}

fn fuzzed(name: &str) -> Outcome {
    let target = named(name).unwrap();
    let outcome = supervise(&target, &plan(60), &|| ()).unwrap();
    let findings: Vec<String> = outcome
        .findings
        .iter()
        .map(|found| {
            let number = found.number;
            format!(
                "{}\n  cargo run --release -p homebody-fuzz -- --target {name} --seed {SEED} --case {number}",
                found.what
            )
        })
        .collect();
    assert!(findings.is_empty(), "{}", findings.join("\n"));
    assert!(outcome.cases >= (target.corpus)().len() as u64, "{outcome:?}");
    outcome
}

macro_rules! each {
    ($($test:ident: $target:literal,)*) => {
        $(#[test]
        fn $test() {
            let outcome = fuzzed($target);
            // The mutants reach both sides of the border.
            assert!(outcome.accepted > 0 && outcome.refused > 0, "{outcome:?}");
        })*

        #[test]
        fn no_target_is_left_out() {
            assert_eq!(TARGETS.map(|target| target.name), [$($target),*]);
        }
    };
}

each! {
    scenarios: "scenario",
    homes: "home",
    routines: "routine",
    scripts: "script",
    profiles: "profile",
    recordings: "recording",
    lists_of_cohorts: "cohort",
    logs: "log",
    databases: "database",
    columns: "columns",
    sources: "source",
    truths: "truth",
    tables_of_truths: "tables",
    servers: "server",
    plans: "plan",
    texts: "text",
    messages_of_the_page: "wire",
}

#[test]
fn what_panics_breaks_hangs_eats_or_dies_is_found_and_the_rest_is_done() {
    let trial = named("trial").unwrap();
    let plan = Plan { cases: 9, until: None, is_measured: true, ..plan(2) };
    let outcome = supervise(&trial, &plan, &|| ()).unwrap();
    assert_eq!((outcome.cases, outcome.accepted, outcome.refused), (9, 2, 1), "{outcome:?}");
    let said: Vec<(u64, &str)> = outcome.findings.iter().map(|found| (found.number, found.what.as_str())).collect();
    let expected = ["a panic", "a panic of another thread", "an invariant", "hangs", "MiB", "died", "died"];
    assert_eq!(said.len(), expected.len(), "{said:?}");
    for ((number, what), (index, expected)) in said.iter().zip(expected.iter().enumerate()) {
        assert!(*number == index as u64 + 2 && what.contains(expected), "case {number}: {what}");
    }
}

/// The hint is followed, and works.
#[test]
fn without_a_folder_for_temporary_files_it_says_so() {
    let repeat = |folder: &std::path::Path| {
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_homebody-fuzz"));
        command.args(["--target", "database", "--case", "0"]).env("TMPDIR", folder).output().unwrap()
    };
    let folder = tempfile::tempdir().unwrap();
    let done = repeat(&folder.path().join("nowhere"));
    let said = String::from_utf8(done.stderr).unwrap();
    assert_eq!(done.status.code(), Some(1), "{said}");
    assert!(
        said.starts_with("error: no folder for temporary files") && said.contains("hint: let TMPDIR name"),
        "{said}"
    );
    assert_eq!(repeat(folder.path()).status.code(), Some(0));
}
