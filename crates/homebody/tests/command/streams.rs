//! Rows on standard output, compressed texts, and binary files, for people and pipes.

use crate::flat::flat;
use crate::folder::Folder;
use std::io::{BufRead, BufReader, Read};
use std::process::{Command, Stdio};

fn lived() -> Folder {
    let folder = flat();
    folder.run("run flat --for 10m --quiet --out csv:log.csv --out jsonl:log.jsonl").ok();
    folder
}

#[test]
fn rows_on_standard_output_are_alone_there() {
    let folder = lived();
    for (url, name) in [("jsonl:-", "log.jsonl"), ("csv:-", "log.csv")] {
        let done = folder.run(&format!("run flat --for 10m --out {url}")).ok();
        assert_eq!(done.out, folder.read(name), "{url}");
        assert!(done.err.contains("rows"), "the summary goes to standard error: {}", done.err);
    }
    let done = folder.run("convert log.csv --out jsonl:-").ok();
    assert_eq!(done.out.lines().count() + 1, folder.read("log.csv").lines().count());
    let rows = done.out.lines().all(|line| line.starts_with("{\"seq\":") && line.ends_with('}'));
    assert!(rows && done.err.contains("jsonl:-: "), "{}", done.err);
    folder.run("run flat --for 1m --json --out csv:-").fails(2, "error[result::standard-output]");
}

#[test]
fn a_reader_that_goes_away_ends_the_run_and_is_told() {
    let folder = lived();
    for url in ["jsonl:-", "csv:-"] {
        let mut run = Command::new(env!("CARGO_BIN_EXE_homebody"))
            .args(["run", "flat", "--for", "60d", "--quiet", "--out", url])
            .current_dir(folder.path(""))
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let mut first = String::new();
        BufReader::new(run.stdout.take().unwrap()).read_line(&mut first).unwrap();
        assert!(!first.is_empty());
        let mut said = String::new();
        run.stderr.take().unwrap().read_to_string(&mut said).unwrap();
        assert_eq!(run.wait().unwrap().code(), Some(1), "{said}");
        assert!(said.contains("error[destination::output-closed]"), "{said}");
        assert!(!said.contains("panicked"), "{said}");
    }
}

#[test]
fn all_commands_read_compressed_logs() {
    let folder = lived();
    folder.run("convert log.csv --out csv:log.csv.gz").ok();
    folder.run("convert log.csv.gz --out jsonl:log.jsonl.gz").ok();
    assert!(!folder.run("compare log.csv log.jsonl.gz").ok().out.is_empty());
    let look = |name: &str| folder.run(&format!("inspect {name} --json")).ok().out.replace(name, "LOG");
    let strip = |text: String| text.lines().filter(|line| !line.contains("\"form\"")).collect::<Vec<_>>().join("\n");
    assert_eq!(strip(look("log.csv.gz")), strip(look("log.csv")));
    let whole = std::fs::read(folder.path("log.csv.gz")).unwrap();
    folder.write("cut.csv.gz", &whole[..whole.len() / 2]);
    folder.run("inspect cut.csv.gz").fails(1, "error[packed::damaged]: cut.csv.gz: ");
}

#[test]
#[cfg(feature = "parquet")]
fn columns_are_written_and_read_by_the_command() {
    let folder = flat();
    folder.edit("flat/scenario.json", "T08:00", "T23:00");
    folder.run("run flat --for 2h --quiet --out csv:log.csv --out parquet:log.parquet --out parquet:lives --out arrow:log.arrow --truth parquet:truth").ok();
    for name in ["log.parquet", "lives", "log.arrow"] {
        folder.run(&format!("convert {name} --out csv:back.csv --force")).ok();
        // Instants are in UTC there, or local as the scenario has them.
        let sensors = |name: &str| -> Vec<String> {
            let cells = |line: &str| line.split(',').skip(2).collect::<Vec<_>>().join(",");
            folder.read(name).lines().skip(1).map(cells).collect()
        };
        assert_eq!(sensors("back.csv"), sensors("log.csv"), "{name}");
        folder.run(&format!("inspect {name}")).ok();
        folder.run(&format!("compare {name} log.csv")).ok();
    }
    let files = folder.files();
    assert!(files.iter().any(|name| name.starts_with("truth/movement/run=") && name.ends_with("/part-0.parquet")));
    folder.run("run flat --for 2h --quiet --out parquet:lives").fails(1, "log::exists");
    folder.run("convert lives --out parquet:lives --force").fails(1, "error[log::is-source]");
    folder.run("run flat --for 2h --quiet --out parquet:lives --force").ok();
    assert_eq!(folder.files(), files);
    let whole = std::fs::read(folder.path("log.parquet")).unwrap();
    folder.write("cut.parquet", &whole[..whole.len() / 2]);
    folder.run("inspect cut.parquet").fails(2, "error[parquet::damaged]: cannot read cut.parquet as a log");
}

/// A remote store is reported as remote, and no folder with its name is made.
#[test]
#[cfg(feature = "parquet")]
fn a_store_that_this_build_does_not_have_is_refused() {
    let folder = flat();
    for url in ["parquet:s3://bucket/lives", "parquet:gs://bucket/lives"] {
        folder.run(&format!("run flat --for 1m --quiet --out {url}")).fails(1, "error[destination::no-object-store]");
        assert!(folder.files().iter().all(|name| !name.starts_with("s3:") && !name.starts_with("gs:")));
    }
}
