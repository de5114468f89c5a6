//! Each target runs its seeds and then mutants for some seconds. Controls show that each kind of failure is found.

use homebody_fuzz::case;
use homebody_fuzz::target::{CaseFiles, ReadVerdict, Target};
use homebody_fuzz::targets::{TARGETS, named};
use proptest::collection::vec;
use proptest::prelude::{Just, Strategy, any};
use proptest::test_runner::{Config, RngSeed, TestCaseError, TestError, TestRunner};
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use std::time::{Duration, Instant};
use std::{env, fs};

/// The same cases in each run (our choice). `PROPTEST_RNG_SEED` and `PROPTEST_CASES` give others, and more.
const SEED: u64 = 1;

/// Time after which a target gets no more mutants, without `HOMEBODY_FUZZ_S` (our choice).
const SECONDS: u64 = 5;

/// Time after which a case hangs (our choice): a debug build is slow, and other tests run at the same time.
const HANGS_AFTER_MS: u32 = if cfg!(debug_assertions) { 60_000 } else { 10_000 };

/// Largest number of bytes from which a mutant is made (our choice).
const MOST_BYTES: usize = 1024;

/// The folder that a test and its child processes share.
fn notes(test: &str) -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join(test.replace("::", "-"))
}

/// Runs cases in a child process; the simplest value that fails, and why. The verdicts are noted as files.
fn run<S: Strategy>(
    test: &'static str,
    config: Config,
    values: &S,
    case: impl Fn(S::Value) -> Result<ReadVerdict, String>,
) -> Result<(), (String, Option<S::Value>)> {
    let notes = notes(test);
    let is_parent = env::var_os("_PROPTEST_FORKFILE").is_none();
    if is_parent {
        let _ = fs::remove_dir_all(&notes);
        fs::create_dir_all(&notes).unwrap();
    }
    let seed = if let RngSeed::Random = config.rng_seed { RngSeed::Fixed(SEED) } else { config.rng_seed };
    let config = Config {
        fork: true,
        test_name: Some(test),
        failure_persistence: None,
        rng_seed: seed,
        max_shrink_iters: 64,
        ..config
    };
    let done = TestRunner::new(config).run(values, |value| match case(value) {
        Ok(verdict) => {
            let note = notes.join(format!("{verdict:?}"));
            if !note.exists() {
                fs::write(note, "").unwrap();
            }
            Ok(())
        }
        Err(why) => {
            fs::write(notes.join("failure"), &why).unwrap();
            Err(TestCaseError::fail(why))
        }
    });
    let why = |reason: String| fs::read_to_string(notes.join("failure")).unwrap_or(reason);
    match done {
        Ok(()) => Ok(()),
        Err(TestError::Fail(reason, value)) => Err((why(reason.to_string()), Some(value))),
        Err(TestError::Abort(reason)) => Err((why(reason.to_string()), None)),
    }
}

fn save(folder: &Path, files: &CaseFiles) {
    fs::create_dir_all(folder).unwrap();
    files.iter().for_each(|(name, bytes)| fs::write(folder.join(name), bytes).unwrap());
}

/// All seeds; with `HOMEBODY_CASE`, the files of that folder instead.
fn seeds(target: &Target) -> Vec<CaseFiles> {
    let Some(folder) = env::var_os("HOMEBODY_CASE") else { return (target.seeds)() };
    let files = fs::read_dir(folder).unwrap().flatten();
    vec![files.map(|file| (file.file_name().into_string().unwrap(), fs::read(file.path()).unwrap())).collect()]
}

fn read_seeds(test: &'static str, name: &str) {
    let target = named(name).unwrap();
    let config = Config { cases: 1, timeout: HANGS_AFTER_MS, ..Config::default() };
    let all = |()| {
        let verdicts = seeds(&target).into_iter().enumerate().map(|(number, files)| {
            case::run(&target, &files, !cfg!(debug_assertions)).map_err(|why| format!("seed {number}: {why}"))
        });
        verdicts.collect::<Result<Vec<_>, _>>().map(|verdicts| verdicts[0])
    };
    if let Err((why, _)) = run(test, config, &Just(()), all) {
        panic!("{name}: {why}");
    }
}

fn read_mutants(test: &'static str, name: &str) {
    static BEGUN: OnceLock<Instant> = OnceLock::new();
    static SEEDS: OnceLock<Vec<CaseFiles>> = OnceLock::new();
    let target = named(name).unwrap();
    let seconds = env::var("HOMEBODY_FUZZ_S").map_or(SECONDS, |seconds| seconds.parse().unwrap());
    let default = Config::default();
    let cases = if env::var_os("PROPTEST_CASES").is_some() { default.cases } else { target.cases };
    let config = Config { cases, timeout: HANGS_AFTER_MS, ..default };
    let mutant = |bytes: &[u8]| target.mutant(SEEDS.get_or_init(target.seeds), bytes);
    let case = |bytes: Vec<u8>| {
        if BEGUN.get_or_init(Instant::now).elapsed() > Duration::from_secs(seconds) {
            return Ok(ReadVerdict::Refused);
        }
        case::run(&target, &mutant(&bytes), !cfg!(debug_assertions))
    };
    if let Err((why, bytes)) = run(test, config, &vec(any::<u8>(), 0..=MOST_BYTES), case) {
        let folder = notes(test).join("case");
        bytes.iter().for_each(|bytes| save(&folder, &mutant(bytes)));
        panic!("{name}: {why}\n  hint: repeat it with HOMEBODY_CASE={} for the seeds of this target", folder.display());
    }
    for verdict in [ReadVerdict::Accepted, ReadVerdict::Refused] {
        assert!(notes(test).join(format!("{verdict:?}")).exists(), "{name}: no mutant is {verdict:?}");
    }
}

macro_rules! each {
    ($($test:ident: $target:literal,)*) => {
        $(mod $test {
            #[test]
            fn seeds() {
                super::read_seeds(concat!(module_path!(), "::seeds"), $target);
            }

            #[test]
            fn mutants() {
                super::read_mutants(concat!(module_path!(), "::mutants"), $target);
            }
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

/// A case of the target `trial`, which fails on purpose.
fn trial(test: &'static str, way: &str) -> Result<(), String> {
    let target = named("trial").unwrap();
    let files = CaseFiles::from([("way".to_owned(), way.as_bytes().to_vec())]);
    let config = Config { cases: 1, timeout: 5_000, ..Config::default() };
    run(test, config, &Just(()), |()| case::run(&target, &files, true)).map_err(|(why, _)| why)
}

macro_rules! controls {
    ($($test:ident: $way:literal, $expected:literal;)*) => {
        $(#[test]
        fn $test() {
            let found = trial(concat!(module_path!(), "::", stringify!($test)), $way);
            assert!(found.as_ref().is_err_and(|why| why.contains($expected)), "{found:?}");
        })*
    };
}

controls! {
    a_panic_is_found: "panic", "a panic";
    a_panic_of_another_thread_is_found: "panic elsewhere", "a panic of another thread";
    a_broken_invariant_is_found: "break", "an invariant";
    a_hang_is_found: "hang", "other process";
    too_much_memory_is_found: "eat", "MiB";
    memory_that_would_fill_the_machine_is_found: "devour", "other process";
    an_abort_is_found: "die", "other process";
}

#[test]
fn working_readers_pass() {
    assert_eq!(trial(concat!(module_path!(), "::working_readers_pass"), "accept"), Ok(()));
}
