//! The examples in the documents about destinations run, with other names of servers.

use crate::folder::{Folder, ROOT};
use crate::mosquitto::Broker;
use crate::postgres::Server;
use std::fs;
use std::path::Path;
use std::process::Command;

/// The lines of a document's blocks of code in one of these languages, each with its block.
fn blocks(document: &str, languages: &[&str]) -> Vec<Vec<String>> {
    let text = fs::read_to_string(Path::new(ROOT).join(document)).unwrap();
    let (mut blocks, mut open) = (Vec::new(), None::<(bool, Vec<String>)>);
    for line in text.lines() {
        match (line.trim().strip_prefix("```"), open.as_mut()) {
            (Some(language), None) => open = Some((languages.contains(&language), Vec::new())),
            (Some(_), Some(_)) => {
                blocks.extend(open.take().filter(|(is_wanted, _)| *is_wanted).map(|(_, lines)| lines))
            }
            (None, Some((_, lines))) => lines.push(line.to_owned()),
            (None, None) => {}
        }
    }
    blocks
}

/// The commands of a document, in their order.
fn commands(document: &str) -> Vec<String> {
    let lines = blocks(document, &["sh", "text"]).concat();
    let of_program = lines.iter().filter_map(|line| line.strip_prefix("homebody "));
    of_program.map(|line| line.replace(['"', '\''], "")).collect()
}

/// A folder with the scenarios of the repository, as those have it who try an example.
fn as_in_the_repository() -> Folder {
    let folder = Folder::new();
    fs::create_dir(folder.path("scenarios")).unwrap();
    for name in ["tigerplace", "studio"] {
        folder.copy_scenario(name);
        fs::rename(folder.path(name), folder.path(&format!("scenarios/{name}"))).unwrap();
        let scenario = format!("scenarios/{name}/scenario.json");
        folder.edit_json(&scenario, |json| json["days"] = 2.into());
    }
    folder
}

#[test]
fn examples_of_parquet_run() {
    let folder = as_in_the_repository();
    let commands = commands("docs/how-to/parquet.md");
    let here: Vec<&String> = commands.iter().filter(|command| !command.contains("s3://")).collect();
    assert!(here.len() > 3, "{commands:?}");
    for command in here {
        folder.run(command).ok();
    }
    let python = blocks("docs/how-to/parquet.md", &["python"]).concat().join("\n");
    assert!(python.contains("duckdb"));
    let has = Command::new("python3").args(["-c", "import duckdb, polars"]).output();
    if !has.is_ok_and(|done| done.status.success()) {
        let required = std::env::var("HOMEBODY_READERS").is_ok_and(|wanted| wanted == "required");
        assert!(!required, "python3 has no duckdb and polars");
        println!("skipped: python3 has no duckdb and polars (pip install duckdb polars)");
        return;
    }
    let done = Command::new("python3").args(["-c", &python]).current_dir(folder.path("")).output().unwrap();
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
}

#[test]
fn examples_of_postgresql_run() {
    let Some(server) = Server::shared() else { return };
    let (folder, database) = (as_in_the_repository(), server.database("examples"));
    let url = server.url("postgres", &database, "");
    let mut id = String::new();
    for command in commands("docs/how-to/postgresql.md") {
        // A run's id is what the run has, and further parts of a URL stand behind those of the socket.
        let command = command.replace("postgresql://ann@db.example/homes?run=4711", &format!("{url}&run={id}"));
        let command = command.replace("postgresql://ann@db.example/homes", &url);
        if command.contains("--mapping logger.json") {
            fs::copy(folder.path("scenarios/tigerplace/logger.json"), folder.path("logger.json")).unwrap();
        }
        folder.run(&command).ok();
        id = server.psql(&database, "SELECT run_id FROM homebody_run").trim().to_owned();
    }
    assert!(!id.is_empty());
    let queries = blocks("docs/how-to/postgresql.md", &["sql"]);
    assert!(queries.len() > 1);
    for query in queries {
        let rows = server.psql(&database, &query.join("\n"));
        assert!(!rows.trim().is_empty(), "{query:?}");
    }
}

#[test]
fn examples_of_mqtt_run() {
    let Some(broker) = Broker::start() else { return };
    let folder = as_in_the_repository();
    folder.run("new my-home --template studio").ok();
    // A command in real time, or with another broker, is only read.
    let all = commands("docs/how-to/mqtt-and-home-assistant.md");
    let fast: Vec<&String> = all.iter().filter(|command| command.contains("allow-fast=true")).collect();
    assert!(!fast.is_empty(), "{all:?}");
    for command in fast {
        let command = command.replace("mqtt://localhost", &format!("mqtt://localhost:{}", broker.port));
        // A shorter run has messages of the same kinds.
        folder.run(&command.replace("--for 28d", "--for 1d")).ok();
    }
}

/// The control: a command that is not as the program has it fails.
#[test]
#[should_panic(expected = "--nowhere")]
fn an_example_that_does_not_run_is_found() {
    as_in_the_repository().run("run scenarios/tigerplace --nowhere parquet:lives").ok();
}
